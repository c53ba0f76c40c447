//! What others published about a problem: `[[published]]` in its file.

/// A published run of some method, to be set beside one's own. It is no part of the problem:
/// [`Problem::read_with_published`] gives both.
///
/// [`Problem::read_with_published`]: super::Problem::read_with_published
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
}
