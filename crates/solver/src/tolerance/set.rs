//! Every figure that meets its dimensions, whatever these are within their limits.
//!
//! ```
//! use krawl::complete;
//! use krawl::edit::Limits;
//! use krawl::problem::Problem;
//! use krawl::tolerance::study_all;
//! use krawl::track::{Control, Options};
//!
//! // Two triangles on one side of 4: d on the side of c, and on the other one.
//! let kite = Problem::build("kite", 2)
//!     .point("a", [0, 0]).point("b", [4, 0]).point("c", [0, 3]).point("d", [3, -2])
//!     .distance("a", "b", 4).distance("b", "c", 5).distance("c", "a", 3)
//!     .distance("a", "d", 4).distance("b", "d", 3)
//!     .finish()?;
//! let [low, high] = ["2.9", "3.1"].map(|x| x.parse().unwrap());
//! let limits = [Limits { index: 2, values: [low, high] }];
//! let search = complete::Options::default();
//! let found = study_all(&kite, &limits, &["c-d".into()], (&Options::certified(), &search), &mut Control::default())?;
//! assert!(found.undecided.is_empty());
//! assert_eq!(found.figures.len(), 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::parts::{Failure, Proved};
use super::{INTERRUPTED, Study, checked, studied};
use crate::blocks::Account;
use crate::complete::{self, Part, ranged};
use crate::constraint::{Symmetry, symmetry};
use crate::digits::{drawn, middle};
use crate::edit::{Limited, Limits};
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::track::{Control, Options};

/// A coordinate known as well as this, in units of length, is where it is drawn, if that is there. No proof rests on it: whether the figure so drawn has
/// the same equations is looked at.
const STANDS: f64 = 1e-12;

const NOT_BOUNDED: &str =
    "it is there for every choice, but bounds are proved with narrower limits only";
const OTHERWISE: &str = "it is there for every choice, but drawn as it is it has other equations";
const ELSEWHERE: &str = "it is there for every choice, but drawn as it is the figure that is followed is not certainly in its box";

/// All figures that meet dimensions within limits.
#[derive(Debug)]
pub struct Set {
    /// The limits.
    pub limits: Vec<Limits>,
    /// What is proved of the figures: which constraints of a sketch were left out, which coordinates are held.
    pub account: Account,
    /// Up to what figures are counted once.
    pub symmetry: Symmetry,
    /// The figures: for every choice of all dimensions together each of them is there once, and no two are the same.
    pub figures: Vec<OfSet>,
    /// Lines and planes of their own, by name, whose two directions are told apart: figures with either are counted.
    pub both_ways: Vec<String>,
    /// What of the space is undecided. If nothing is, no choice has any other figure.
    pub undecided: Vec<Part>,
}

/// One of them.
#[derive(Debug)]
pub struct OfSet {
    /// A box of each point over all choices, in the coordinates of the problem.
    pub bands: Vec<[Interval; 3]>,
    /// What is measured of it; or, in words, why that is not told.
    pub study: Result<Study, String>,
}

/// Every figure that meets the dimensions for all choices within limits, and what is measured of each as [`super::study`] does; `options`: how
/// figures are followed, and what the search may take.
///
/// # Errors
/// In words: what is wrong with the limits, or that the sketch cannot be led to its dimensions.
pub fn study_all(
    problem: &Problem,
    limits: &[Limits],
    asked: &[String],
    (options, search): (&Options, &complete::Options),
    control: &mut Control,
) -> Result<Set, String> {
    let quantities = checked(problem, limits, asked)?;
    let open = |problem: &Problem, control: &mut Control| {
        Limited::open(problem, limits, options, control).map_err(|error| error.to_string())
    };
    let limited = open(problem, control)?;
    let homotopy = limited.ranges();
    let found = ranged(problem, &homotopy, search)?;
    let unit = point(homotopy.unit);
    let of_figure = |x: &Vec<Interval>, control: &mut Control| {
        let at = |i: usize| x[i];
        let points = (0..homotopy.points).map(|p| homotopy.place(p, |i| at(i) * unit));
        let points: Vec<[Interval; 3]> = points.collect();
        let bands = limited.put(&points);
        let mut study = || {
            if control.is_interrupted() {
                return Err(INTERRUPTED.to_owned());
            }
            let places = problem.points.iter().zip(&bands);
            // What stands is where it is drawn.
            let places = places.map(|(point, band)| {
                [0, 1, 2].map(|k| {
                    let (sketch, band) = (&point.sketch[k], band[k]);
                    let stands = band.contains(sketch.to_f64()) && band.wid() < STANDS * unit.mid();
                    if stands { sketch.clone() } else { middle(band) }
                })
            });
            let drawn = drawn(problem, places, &homotopy.locate(&points, &at))?;
            let own = open(&drawn, control)?;
            // What it becomes with each choice is the figure of the box, as it is that with one of them.
            if !own.is_same(&limited) {
                return Err(OTHERWISE.to_owned());
            }
            if !(0..homotopy.equations).all(|i| own.nominal(i).subset(x[i])) {
                return Err(ELSEWHERE.to_owned());
            }
            let proved = Proved::new(own, control).map_err(|failed| match failed.1 {
                Failure::Interrupted => INTERRUPTED,
                Failure::Part(_) => NOT_BOUNDED,
            })?;
            studied(&drawn, limits, proved, &quantities, control)
        };
        let study = study();
        OfSet { bands, study }
    };
    let figures = found.figures.iter();
    Ok(Set {
        limits: limits.to_vec(),
        account: limited.account(),
        symmetry: symmetry(problem),
        figures: figures.map(|x| of_figure(x, control)).collect(),
        both_ways: found.both_ways,
        undecided: found.undecided,
    })
}
