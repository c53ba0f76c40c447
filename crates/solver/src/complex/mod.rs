//! All complex solutions of a problem, every path proved.
//!
//! A complex unknown is two real ones and a complex quadratic equation two real ones ([`system`]); so the tracker that
//! follows real paths follows complex ones too, tube by tube, and no two paths can merge or swap. A *template* is a
//! generic instance of a problem's equations with its solutions: one random figure, and what loops of complex
//! dimensions make of it ([`monodromy`]), or, of equations without points, what paths in floats from equations of the same degrees
//! come to, each proved. Its solutions are then taken to the dimensions wanted ([`solve()`]).
//!
//! Where a bound is known the number of solutions proves that they are all, however they were found: then paths may be
//! followed in floats ([`Ways::proved`]), ten to twenty times as fast.
//!
//! What is proved: every box holds exactly one complex solution; boxes are disjoint; which solutions are real. That there
//! is no other isolated solution is proved where their number meets a proved bound ([`bound`]), less the figures that are at
//! infinity ([`infinity`]), and not claimed elsewhere.
//!
//! ```
//! use krawl::complex::{Filling, Status, Template, Ways, fill, lower, solve};
//! use krawl::problem::Problem;
//!
//! # std::env::set_current_dir("../..").unwrap();
//! let problem = Problem::read("problems/octahedron.toml")?;
//! let lowered = lower(&problem)?;
//! // Sixteen up to rotation, eight up to isometry.
//! let filling = Filling { enough: Some(8), ..Filling::default() };
//! let template = Template::new(&problem.name, fill(&lowered.system, &filling)?);
//! let solutions = solve(&lowered, &template, &Ways::default());
//! assert_eq!(solutions.status, Status::Complete);
//! assert_eq!((solutions.counts.rotation, solutions.counts.isometry), (16, 8));
//! assert_eq!(solutions.real().count(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bound;
mod boxes;
mod certify;
mod count;
mod ends;
mod exact;
mod export;
mod float;
mod follow;
mod groups;
pub mod infinity;
mod laman;
mod lines;
mod lower;
mod matrix;
pub mod monodromy;
mod own_frame;
mod solve;
mod start;
pub mod system;
mod template;
mod total_degree;
mod unknowns;
mod vector;

pub use crate::track::certified::Same;
pub use bound::Bound;
pub use boxes::{Found, SolutionBox, SolutionSet};
pub use certify::to_certificate;
pub use count::{Counts, count, count_generic};
pub use exact::{Exact, Parameter, Random};
pub use export::{Export, export, places};
pub use follow::{Effort, Follower, PathEnd, Ways, follow_all, prove_all};
pub use lower::{Lowered, Unserved, lower, lower_for, lower_in_squares};
pub use monodromy::{Fibre, Filling, fill};
pub use solve::{Nature, Solutions, Status, solve};
pub use start::{StartFigure, draw};
pub use system::{Signs, System};
pub use template::{Template, TemplateError};
pub use total_degree::Led;
