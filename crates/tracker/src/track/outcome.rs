//! What a run reports.

use super::Signed;
use super::{PathEnd, Stop};
use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::Located;
use nalgebra::Point3;

crate::named! {
    /// Whether steps are proved.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Mode {
        /// Every step is proved by a Krawczyk test.
        Certified = "certified",
        /// Plain floating-point tracking: results are observations.
        Float = "float",
    }
}

crate::named! {
    /// Where the path is followed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Space {
        /// In all free coordinates.
        Full = "full",
        /// In the driving parameters of a construction plan.
        Reduced = "reduced",
    }
}

impl Space {
    /// The space in which certified runs are faster, by the number of free coordinates (which is
    /// that of distances): the reduced one from about 70 on (docs/how/tubes.md).
    pub fn for_certified(coordinates: usize) -> Self {
        if coordinates < 70 {
            Space::Full
        } else {
            Space::Reduced
        }
    }
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// The path came back to the sketch. In certified mode that is proved.
    Closed,
    /// The path came to an end both ways from the sketch: the end behind the sketch, in the direction of travel,
    /// first. In certified mode the arc between is proved, and the solutions are exactly those on it; that the path does
    /// not go on beyond is not.
    Open(Box<[PathEnd; 2]>),
    /// The run ended before: where and why.
    Stopped(Stop),
}

/// A figure on the path that meets the dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Coordinates of every point in the gauge, in the units of the problem. Certified: boxes
    /// that hold exactly one solution, or where [`Solution::is_degenerate`] that of the path. Float: `[x, x]`.
    pub points: Vec<[Interval; 3]>,
    /// Where the problem's objects are, in the order of [`Problem::objects`](crate::problem::Problem::objects) and in the
    /// same coordinates; none of problems of distances alone.
    pub objects: Vec<Located>,
    /// With other constraints than distances: the unknowns of the equations beside the points' coordinates, in the order
    /// and the units of [`Homotopy::new`](crate::system::Homotopy::new); of runs along a path, otherwise none.
    pub auxiliary: Vec<Interval>,
    /// Solutions with the same class are congruent up to reflection.
    pub class: usize,
    /// The widest coordinate's width, divided by the size (largest coordinate) of the figure; unknown numbers are among them.
    pub width: f64,
    /// Where the path meets it. Float runs do not tell.
    pub place: Option<Place>,
    /// The first solution of the list (counted from 0) whose mirror image this one is, if there is one
    /// before it.
    pub mirror_of: Option<usize>,
    /// Whether it is a degenerate solution: a flat figure, all points in one plane, at which the constraints' equations
    /// are dependent, as they are at all flat figures of a problem with more conditions on heights than heights. Such
    /// figures come in continua, and this is the one that the path passes through: heights over 1 − t have limits
    /// there. In certified mode that is proved, and that the figure meets all constraints; nothing is claimed of
    /// other flat figures, which are as near as one likes. In float mode it is observed.
    pub is_degenerate: bool,
}

fn middle(place: &[Interval; 3]) -> Point3<f64> {
    Point3::from(place.each(|x| x.mid()))
}

/// The width of the widest coordinate or unknown number, divided by the size of the largest; 0 where all are exactly zero.
pub fn relative_width(points: &[[Interval; 3]], objects: &[Located]) -> f64 {
    let numbers = objects.iter().flat_map(|object| match object {
        Located::Number(number) => std::slice::from_ref(number),
        // Beside an origin that may be 0 its axes tell more.
        Located::Pose { at, axes } if at.iter().all(|x| x.contains(0.0)) => axes.as_flattened(),
        Located::Pose { at, .. } => &at[..],
        _ => &[],
    });
    let all = points.iter().flatten().chain(numbers);
    let (widest, largest) = all.fold((0.0f64, 0.0f64), |(widest, largest), x| {
        (widest.max(x.wid()), largest.max(x.mag()))
    });
    if largest > 0.0 { widest / largest } else { 0.0 }
}

impl Solution {
    /// A figure by the coordinates of its points, of a problem of distances alone, that is no path's.
    #[doc(hidden)]
    pub fn placed(points: Vec<[Interval; 3]>, class: usize) -> Self {
        Self::located(points, Vec::new(), class)
    }

    /// The same of a problem with objects.
    #[doc(hidden)]
    pub fn located(points: Vec<[Interval; 3]>, objects: Vec<Located>, class: usize) -> Self {
        Solution {
            width: relative_width(&points, &objects),
            points,
            objects,
            auxiliary: Vec::new(),
            class,
            place: None,
            mirror_of: None,
            is_degenerate: false,
        }
    }

    /// The coordinates of a point by its name, in the gauge and the units of the problem, the third
    /// being zero in the plane. `None`: there is no such point.
    pub fn point(&self, problem: &Problem, name: &str) -> Option<&[Interval; 3]> {
        let mut points = problem.points.iter();
        self.points
            .get(points.position(|point| point.name == name)?)
    }

    /// Where an object of the problem is, by its name. `None`: there is no such object.
    pub fn object(&self, problem: &Problem, name: &str) -> Option<&Located> {
        let mut objects = problem.objects.iter();
        self.objects
            .get(objects.position(|object| object.name == name)?)
    }

    /// The middle of a point's box, the third coordinate being zero in the plane: floats, for what draws or
    /// computes on. `None`: there is no such point.
    pub fn nearest(&self, problem: &Problem, name: &str) -> Option<Point3<f64>> {
        Some(middle(self.point(problem, name)?))
    }

    /// The middles of all points' boxes, in the order of the problem.
    pub fn figure(&self) -> Vec<Point3<f64>> {
        self.points.iter().map(middle).collect()
    }
}

/// Where on the path a solution is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Length of the path from the sketch to it, as in [`Outcome::length`]: a float, not an enclosure.
    pub arc: f64,
    /// Whether t rises through 1 there, in the direction of travel. Proved.
    pub rising: bool,
    /// How often the sign of dt/ds is proved to change between the sketch and it: folds of the path. Zero
    /// is exact: t goes all the way from 0 to 1 without turning back. Other numbers are lower bounds, as
    /// folds may hide in pairs where the sign is uncertain for a stretch. `None`: none was proved, and
    /// none excluded. (A finer run, [`trace_path`](crate::track::trace_path), tells more.)
    pub folds: Option<usize>,
}

/// Numbers of driving parameters over a run in the reduced space (RR 8705, table 2).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Driving {
    /// Mean over the steps.
    pub average: f64,
    /// The largest.
    pub max: usize,
}

/// The result of following a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Certified or float.
    pub mode: Mode,
    /// Full or reduced.
    pub space: Space,
    /// Closed, or stopped and why.
    pub status: Status,
    /// The solutions, in the order in which the path meets them.
    pub solutions: Vec<Solution>,
    /// What came of them by the signs that the problem asks for, once [`Signs::test`](super::Signs::test) has taken the others out.
    pub signed: Option<Signed>,
    /// Accepted steps (certified: tubes).
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Changes of the construction plan.
    pub plan_changes: usize,
    /// Driving parameters.
    pub driving: Driving,
    /// Length of the path, Euclidean in the free coordinates (units of the problem) and t.
    pub length: f64,
    /// The least and the largest t met; certified: an enclosure of the range.
    pub t_range: (f64, f64),
    /// Wall-clock seconds.
    pub seconds: f64,
    /// What was switched on beyond the plain run, and why.
    pub switched_on: Vec<String>,
}

impl Outcome {
    /// Of a path that has not been followed at all.
    pub fn new(mode: Mode, space: Space, status: Status) -> Self {
        Outcome {
            mode,
            space,
            status,
            solutions: Vec::new(),
            signed: None,
            steps: 0,
            rejected: 0,
            plan_changes: 0,
            driving: Driving::default(),
            length: 0.0,
            t_range: (0.0, 0.0),
            seconds: 0.0,
            switched_on: Vec::new(),
        }
    }
}
