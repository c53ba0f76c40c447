//! Certificates: the proof of a certified run on disk, and a small checker that trusts nobody.
//!
//! A certificate holds the problem and, for each tube, the little that has to be known to prove
//! it again. [`Writer`] makes one while a run goes on; [`verify`] checks all of its claims in
//! arithmetic of its own: intervals, whole numbers, and floats with a bound on what they lose. The checker uses the problem, the intervals,
//! and the definition of the equations, and nothing of the tracker: who trusts it has few lines
//! to read. The format and the mathematics are in `docs/how/certificates.md`.
//!
//! ```
//! use krawl::certificate::{Outcome, Settings, Writer, verify};
//! use krawl::problem::Problem;
//! use krawl::track::{Control, Options, solve};
//!
//! let problem = Problem::build("triangle", 2)
//!     .point("a", ["0", "0"]).point("b", ["1", "0"]).point("c", ["0.4", "1.1"])
//!     .distance("a", "b", "1").distance("b", "c", "1.2").distance("c", "a", "1.3")
//!     .finish().unwrap();
//! let mut writer = Writer::new(Vec::new(), &problem);
//! let mut control = Control { witness: Some(&mut writer), ..Control::default() };
//! solve(&problem, &Options::certified(), &mut control).unwrap();
//! let certificate = writer.finish().unwrap();
//! let verdict = verify(&certificate[..], &Settings::default(), &mut |_| ()).unwrap();
//! assert_eq!(verdict.outcome, Outcome::Verified);
//! assert!(verdict.is_about(&problem));
//! ```

mod begun;
mod checker;
mod compared;
pub mod complex;
pub mod cover;
mod format;
mod head;
mod reader;
mod verdict;
mod writer;

pub use begun::write_header;
pub use checker::{Settings, Stage, verify};
pub use compared::Compared;
pub use format::{
    ArcClaim, EndClaim, Ending, FoldClaim, FormatError, Header, Record, SolutionClaim, TubeClaim,
    VERSION,
};
pub use head::{Contents, contents};
pub use reader::Reader;
pub use verdict::{Arc, Fault, Flaw, Outcome, Verdict};
pub use writer::{Writer, write_record};

// Not beside the type: the checker's files use nothing but what they check with.
crate::debug_in_words!(FormatError);
