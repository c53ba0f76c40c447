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
//! use krawl::track::{Status, prove};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     // A triangle whose side a-b was drawn 4 long and is to become 5. Lengths are exact decimals:
//!     // "3.2" is 32/10.
//!     let triangle = Problem::build("triangle", 2)
//!         .point("a", ["0", "0"])
//!         .point("b", ["4", "0"])
//!         .point("c", ["0.5", "2.9"])
//!         .distance("a", "b", "5")
//!         .distance("b", "c", "4")
//!         .distance("c", "a", "3")
//!         .reference(["a", "b"])
//!         .finish()?;
//!     let outcome = prove(&triangle)?;
//!
//!     assert_eq!(outcome.status, Status::Closed);
//!     for solution in &outcome.solutions {
//!         // Every coordinate is an interval, which the exact one lies in.
//!         let [x, y, _] = *solution.point(&triangle, "c").unwrap();
//!         assert!(x.contains(1.8) && x.wid() < 1e-12);
//!         println!("c: x from {} to {}, y from {} to {}", x.inf(), x.sup(), y.inf(), y.sup());
//!     }
//!     // This is the one that the drawing moves to without turning back.
//!     let straight = outcome.solutions.iter().find(|s| s.place.is_some_and(|p| p.folds == Some(0)));
//!     let [_, y, _] = *straight.unwrap().point(&triangle, "c").unwrap();
//!     assert!(y.contains(2.4));
//!     Ok(())
//! }
//! ```
//!
//! Coordinates are those of the reference: a at the origin, b on the x axis.
//! [`Placement`](system::Placement) brings figures back to where the sketch is drawn, with proof or as a motion
//! of nalgebra's. [`Control`](track::Control) has progress, interrupts and certificates; [`report::page`] makes a
//! page to look at. Errors print as words, `{:?}` too, so that a `main` like this one tells its user what was
//! wrong and where. `examples/` has whole programs.
//!
//! # What it needs
//!
//! Nothing but Rust. On x86-64 it is three to seven times faster, with the same results to the last bit, if the
//! build is for processors with AVX and FMA instructions (Intel Haswell, AMD Zen, or later): a build's target is
//! chosen by the program that is built, so put this into `.cargo/config.toml` beside your `Cargo.toml`:
//!
//! ```toml
//! [target.'cfg(target_arch = "x86_64")']
//! rustflags = ["-Ctarget-cpu=x86-64-v3"]
//! ```
//!
//! Other processors need no flags.
//!
//! Features, all on unless `default-features = false`: `cli` for the program (command line, progress, pictures with axes,
//! CSV), `freecad` to read and write FreeCAD's files, `explore` for [`explore`].
//!
//! # The modules
//!
//! From the ground up; each knows only those before it:
//!
//! - `hexadecimal`: bytes as text
//! - `places`: short arrays, made place by place
//! - `random`: numbers that look random
//! - `order`: sorting by places
//! - `sets`: sets that are joined
//! - [`equations`]: rows of products of differences
//! - `elimination`: row echelon forms and inverses over any field
//! - [`rational`]: exact ratios
//! - `map`: values by key, in one list
//! - `decimal`: exact numbers as they are written
//! - `residues`: numbers modulo a prime
//! - [`interval`]: enclosures of exact numbers, bounds on rounding
//! - `model`: Taylor models of the second order
//! - `linalg`: dense kernels on small matrices, R-structured linear systems
//! - `statement`: points, constraints and sketch of a problem, as plain data
//! - [`constraint`]: what each kind of constraint means, and its equations
//! - [`problem`]: the file format, problems from code, checks of the input; all of the statement is part of it
//! - [`generate`]: large problems made to measure
//! - [`system`]: the equations H(X, t) = 0, and where figures lie
//! - `plan`: construction plans with driving parameters
//! - [`track`]: the trackers, certified and float, in full and in reduced space
//! - `journal`: files of lines that one process appends to
//! - [`blocks`]: how the equations of a sketch fall apart, and its figures block by block
//! - `remarks`: what can be told of a problem before any path is followed
//! - [`edit`]: one dimension changed, the same figure kept, by proof; the limits of dimensions
//! - [`motion`]: all figures of a linkage that moves in one way, and what is measured of them
//! - [`certificate`]: proofs on disk, and the checker that proves them again
//! - [`complex`]: all complex solutions, every path proved
//! - [`complete`]: all real solutions, proved to be all
//! - [`digits`]: solutions to many digits
//! - [`tolerance`]: dimensions within limits, and what they do to a figure
//! - [`import`]: sketches of SolveSpace and FreeCAD and molecules, in and out
//! - [`explore`]: new sketches from solutions, and their paths
//! - [`compare`]: all modes and spaces beside each other, timed and judged
//! - [`report`]: tables, JSON, pictures, progress
//! - [`algebra`]: systems of equations of one's own, and all their solutions
//! - `cli`: the command line of the program
//!
//! From `hexadecimal` to `linalg` they are those of the package `krawl-kernel` in `crates/kernel`, from `statement` to
//! [`track`] those of `krawl-tracker` in `crates/tracker`; [`import`], [`explore`], [`compare`], [`report`] and `cli` are
//! this package's; all others are those of `krawl-solver` in `crates/solver`. Those that have no page here are these
//! packages' own; where they are public they are so for the program, the tests and `crates/lab`, which has what the
//! papers describe and krawl does without.

#![warn(missing_docs)]

// The command line speaks of the library as other programs do.
#[cfg(feature = "cli")]
extern crate self as krawl;

// What computes and proves is in packages of its own, so that they alone are built for speed.
pub use krawl_solver::{
    blocks, certificate, complete, complex, constraint, digits, edit, equations, generate,
    interval, motion, problem, rational, system, tolerance, track,
};
#[doc(hidden)]
pub use krawl_solver::{elimination, linalg, plan, remarks};

use krawl_solver::{debug_in_words, named, order, places, sets};
#[cfg(feature = "explore")]
use krawl_solver::{journal, random};

pub mod algebra;
// In the library, so that what both need of generic code is made once.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod compare;
#[cfg(feature = "explore")]
pub mod explore;
pub mod import;
pub mod report;

/// The library of points and motions that the interface speaks, in the version it speaks.
pub use krawl_solver::nalgebra;
