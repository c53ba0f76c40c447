//! What others published about a problem: `[[published]]` in its file.

use super::FileError;
use std::path::Path;

/// A published run of some method, to be set beside one's own. It is no part of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// The method, and where and on what it was run.
    pub method: String,
    /// `full` or `reduced`, where the method is the paper's tracker in that space.
    pub space: Option<String>,
    /// Iterations of predictor and corrector.
    pub steps: Option<usize>,
    /// The time taken.
    pub seconds: Option<f64>,
    /// Solutions found, up to reflection.
    pub solutions: Option<usize>,
}

impl Published {
    /// The keys that an entry may have.
    pub(super) const KEYS: [&'static str; 5] = ["method", "space", "steps", "seconds", "solutions"];

    /// What the file of a problem says was published about it.
    ///
    /// Fails where the file is no problem.
    ///
    /// ```
    /// use krawl::problem::Published;
    /// let rows = Published::read("problems/octahedron.toml")?;
    /// assert!(rows.iter().any(|row| row.space.as_deref() == Some("reduced") && row.steps == Some(173)));
    /// # Ok::<(), krawl::problem::FileError>(())
    /// ```
    pub fn read(path: impl AsRef<Path>) -> Result<Vec<Published>, FileError> {
        let (_, published) = super::file::read(path.as_ref())?;
        Ok(published)
    }
}
