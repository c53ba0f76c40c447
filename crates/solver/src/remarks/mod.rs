//! What can be told of a problem before any path is followed, by the names of its points: target lengths that no
//! figure has, places where the sketch or the target is singular, parts that can be mirrored.
//!
//! Everything here is decided exactly, on the decimals of the problem, but for [`Remark::Redundant`]; what is not said is
//! not excluded.
//!
//! ```
//! use krawl::problem::Problem;
//! use krawl::remarks::{in_words, remarks};
//! let problem = Problem::build("impossible", 2)
//!     .point("a", [0, 0]).point("b", [4, 0]).point("c", [0, 3])
//!     .distance("a", "b", 200).distance("b", "c", 90).distance("c", "a", 70)
//!     .finish().unwrap();
//! let found = remarks(&problem);
//! let text = in_words(&problem, &found[0]);
//! assert_eq!(text, "no figure has these target lengths: a-b is 200, and a-c-b is only 160 long");
//! ```

mod flat;
mod mirror;
mod moving;
mod redundant;
mod target;
mod twins;
mod words;

use crate::problem::{Item, Object, Problem};
use crate::statement::neighbours;

pub use moving::{Moves, moves};
pub use target::Reach;
pub(crate) use target::reach;
pub use words::in_words;

/// Something to know about a problem. Numbers are indices of points, but for `distance`.
#[derive(Debug, Clone, PartialEq)]
pub enum Remark {
    /// No figure meets the targets: a distance is longer than a way around it, which is given by its points and
    /// a bound on its length.
    TooLong {
        /// The index of the distance.
        distance: usize,
        /// The way from its one end to the other.
        way: Vec<usize>,
        /// No way is longer than this.
        length: f64,
    },
    /// No figure meets the targets: four points that are all joined would need a tetrahedron of negative volume.
    NoTetrahedron([usize; 4]),
    /// In every figure that meets the targets these three points are on one line, in this order: the figure
    /// is singular.
    LineInTarget([usize; 3]),
    /// In every figure that meets the targets these four points are in one plane: the figure is singular.
    PlaneInTarget([usize; 4]),
    /// In the sketch a point is on one line (in space: in one plane) with all points that it is joined to, so that it
    /// can move away from it for an instant: the sketch is singular.
    Loose {
        /// The point.
        point: usize,
        /// Those that it is joined to.
        joined: Vec<usize>,
    },
    /// In the sketch three points that are all joined are on one line (in space: four in one plane): the sketch
    /// is singular.
    FlatInSketch(Vec<usize>),
    /// In the sketch these points are on one line (in space: in one plane), with more distances among them than can be
    /// independent there: the sketch is singular.
    FlatPart {
        /// The points.
        points: Vec<usize>,
        /// The number of distances among them.
        distances: usize,
    },
    /// In the sketch all points are in one plane, and so many conditions hold in every figure in that plane as tell above
    /// from below (coplanarities, most of them), for so many heights over it: but for one condition less than heights,
    /// the sketch is singular, or the path stays in the plane.
    FlatSketch {
        /// The conditions.
        conditions: usize,
        /// The heights, and what else changes its sign with them.
        heights: usize,
    },
    /// Two triangles on a common side have the same sides at every t: where the path brings one onto a line
    /// it does so with the other, and branches meet.
    Twins {
        /// The common side.
        side: [usize; 2],
        /// The corner of each triangle that is not on the common side.
        corners: [usize; 2],
    },
    /// Some points are joined to the others only through two points (in space: three), so that they can be
    /// mirrored: every figure comes in two forms, mirror images of the whole apart.
    Mirrored {
        /// Those that can be mirrored.
        part: Vec<usize>,
        /// Those that stay.
        hinge: Vec<usize>,
    },
    /// These constraints follow from each other in every figure that meets them: figures are singular. Observed in
    /// floats.
    Redundant(Vec<String>),
}

impl Remark {
    /// Whether the path may end there, or cannot begin: everything but what can be mirrored.
    pub fn is_warning(&self) -> bool {
        !matches!(self, Remark::Mirrored { .. })
    }
}

/// Most points of problems that are looked at for what takes long.
const MANY: usize = 200;

/// Everything that is found, the gravest first. Of problems with other constraints than distances only whether the sketch is
/// flat, and which of them follow from each other.
pub fn remarks(problem: &Problem) -> Vec<Remark> {
    if !problem.is_distances_only() {
        // From a flat sketch one comes to flat figures, at which conditions depend on each other that do not elsewhere.
        let flat = flat::sketch(problem);
        return match flat.is_empty() {
            true => redundant::redundant(problem),
            false => flat,
        };
    }
    let mut all = target::too_long(problem);
    all.extend(target::flat(problem));
    all.extend(flat::parts(problem));
    all.extend(flat::in_sketch(problem));
    all.extend(twins::twins(problem));
    if problem.points.len() <= MANY {
        all.extend(mirror::parts(problem));
    }
    // What is said of a part need not be said of its points one by one.
    let parts: Vec<Vec<usize>> = all
        .iter()
        .filter_map(|remark| match remark {
            Remark::FlatPart { points, .. } => Some(points.clone()),
            _ => None,
        })
        .collect();
    let in_part = |points: &mut dyn Iterator<Item = &usize>| {
        let points: Vec<&usize> = points.collect();
        parts
            .iter()
            .any(|part| points.iter().all(|p| part.contains(p)))
    };
    all.retain(|remark| match remark {
        Remark::Loose { point, joined } => !in_part(&mut joined.iter().chain([point])),
        Remark::FlatInSketch(points) => !in_part(&mut points.iter()),
        _ => true,
    });
    let touched = touched(problem);
    // Distances are not all that holds these.
    all.retain(|remark| match remark {
        Remark::Loose { point, .. } => !touched[*point],
        Remark::Mirrored { part, .. } => !part.iter().any(|&p| touched[p]),
        _ => true,
    });
    all
}

/// The points that constraints other than distances are about, by themselves or through objects.
fn touched(problem: &Problem) -> Vec<bool> {
    let mut touched = vec![false; problem.points.len()];
    let of_objects = problem.objects.iter().flat_map(Object::points);
    let items = problem.constraints.iter().flat_map(|c| &c.items);
    let of_constraints = items.filter_map(|item| match item {
        Item::Point(p) => Some(*p),
        _ => None,
    });
    of_constraints
        .chain(of_objects)
        .for_each(|p| touched[p] = true);
    touched
}

/// For each point the points joined to it, in order, with the index of the distance.
fn joined(problem: &Problem) -> Vec<Vec<(usize, usize)>> {
    let pairs = problem.distances.iter().map(|d| d.points);
    let mut joined = neighbours(problem.points.len(), pairs);
    for all in &mut joined {
        all.sort_unstable();
    }
    joined
}

/// All sets of three points that are all joined, with the distances opposite to them.
fn triangles(problem: &Problem) -> Vec<([usize; 3], [usize; 3])> {
    let joined = joined(problem);
    let mut all = Vec::new();
    for (c_side, distance) in problem.distances.iter().enumerate() {
        let [a, b] = distance.points;
        for &(c, b_side) in &joined[a] {
            let Some(&(_, a_side)) = joined[b].iter().find(|&&(p, _)| p == c) else {
                continue;
            };
            // Each turns up once for each of its sides.
            if c_side > b_side && c_side > a_side {
                all.push(([a, b, c], [a_side, b_side, c_side]));
            }
        }
    }
    all
}

/// All sets of four points that are all joined.
fn tetrahedra(problem: &Problem) -> Vec<[usize; 4]> {
    let joined = joined(problem);
    let are_joined = |a: usize, b: usize| joined[a].iter().any(|&(p, _)| p == b);
    let mut all = Vec::new();
    for ([a, b, c], _) in triangles(problem) {
        let largest = a.max(b).max(c);
        for &(d, _) in &joined[a] {
            if d > largest && are_joined(b, d) && are_joined(c, d) {
                let mut points = [a, b, c, d];
                points.sort_unstable();
                all.push(points);
            }
        }
    }
    all
}
