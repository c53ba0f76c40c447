//! krawl follows the real homotopy path through a sketch and finds, with proof, the figures on it
//! that meet the dimensions.
//!
//! A [`Problem`](problem::Problem) is a set of points, distances to meet and a rough sketch. All
//! lengths are led from those of the sketch (t = 0) to the targets (t = 1); the sketch moves along
//! a curve, and wherever that curve meets t = 1 there is a solution. In certified mode every step
//! along the curve is proved by a Krawczyk test, so that it cannot have jumped to another curve,
//! and a run that ends [`Closed`](track::Status::Closed) proves that its solutions are exactly
//! those of the path.
//!
//! ```
//! use krawl::problem::Problem;
//! use krawl::track::{Control, Options, Status, solve};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // K3,3 as a linkage in the plane: six points, nine bars.
//! let mut k33 = Problem::build("k33", 2);
//! for (name, sketch) in [
//!     ("a", ["0", "0"]), ("b", ["3.1", "0"]), ("c", ["4.2", "2.1"]),
//!     ("d", ["1.9", "3.8"]), ("e", ["-0.7", "2.4"]), ("f", ["1.2", "1.1"]),
//! ] {
//!     k33 = k33.point(name, sketch);
//! }
//! // Lengths are exact decimals: "3.2" is 32/10.
//! for (one, other, length) in [
//!     ("a", "b", "3.2"), ("a", "d", "4.1"), ("a", "f", "1.7"),
//!     ("c", "b", "2.3"), ("c", "d", "2.9"), ("c", "f", "3.3"),
//!     ("e", "b", "4.4"), ("e", "d", "2.8"), ("e", "f", "2.4"),
//! ] {
//!     k33 = k33.distance(one, other, length);
//! }
//! let outcome = solve(&k33.finish()?, &Options::certified(), &mut Control::default())?;
//!
//! assert_eq!(outcome.status, Status::Closed);
//! for solution in &outcome.solutions {
//!     // Every coordinate is an interval; the boxes hold exactly one solution each.
//!     assert!(solution.width < 1e-12);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! The modules, from the ground up; each knows only those before it:
//!
//! - [`problem`]: points, constraints, sketch, the file format, checks of the input
//! - [`generate`]: large problems made to measure
//! - [`constraint`]: what each kind of constraint means, and its equations
//! - [`interval`]: enclosures of exact numbers, bounds on rounding
//! - [`system`]: the equations H(X, t) = 0
//! - [`linalg`]: dense kernels on small matrices, R-structured linear systems
//! - [`plan`]: construction plans with driving parameters
//! - [`track`]: the trackers, certified and float, in full and in reduced space
//! - [`compare`]: all modes and spaces beside each other, timed and judged
//! - [`report`]: tables, JSON, pictures, progress

pub mod certificate;
pub mod compare;
pub mod constraint;
pub mod generate;
pub mod interval;
pub mod linalg;
pub mod plan;
pub mod problem;
pub mod report;
pub mod system;
pub mod track;
