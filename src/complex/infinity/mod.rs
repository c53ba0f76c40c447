//! Solutions at infinity: figures in space that some dimensions lose, proved one by one and counted.
//!
//! Lengths may be so special that figures which neighbouring lengths have go to infinity. With these lengths there are fewer
//! isolated solutions than a bound for all lengths allows, and how many fewer can be proved.
//!
//! # How a figure goes to infinity
//! Let some points S go away, L be their neighbours and O all others. They go along an isotropic direction n (n·n = 0). A
//! neighbour q keeps its distance only if n·(p − q) goes to zero as fast as |p| grows; so all of L comes to lie in a
//! plane n·q = constant. In such a plane the square of a distance is the square of *one* coordinate's difference, as on
//! a line: the lengths among L have to add up to zero with signs around every cycle. Around one cycle that is one
//! condition on the lengths, which round decimals often meet.
//!
//! # Coordinates in which it is a place like all others
//! Let p = λ n + ν m + σ n', with n and n' isotropic, 2 n·n' = 1 = m·m and n·m = n'·m = 0: squares of distances are
//! Δν² + Δλ Δσ. With one more unknown ε let λ = Λ/ε in S and σ = ε τ in S and L. Then the equations of distances are
//!
//! | edge within | S | S and L | L | L and O | O |
//! | --- | --- | --- | --- | --- | --- |
//! | Δν² plus | ΔΛ Δτ | (Λ − ε λ) Δτ | ε Δλ Δτ | Δλ (ε τ − σ) | Δλ Δσ |
//!
//! which make sense for ε = 0 too: a figure at infinity. All that moves a figure in these coordinates is fixed by
//! λ = ν = τ = 0 at one point of L, ν = 0 and σ = 1 at one of O, ν = 0 and Λ = 1 at one of S.
//!
//! # What is proved of each
//! Let L be connected by its edges with exactly one cycle, and let the lengths add up with signs to zero around it, exactly:
//! then ν is known in L. What remains at ε = 0 are as many quadratic equations as unknowns, without the edges in L; that
//! they have exactly one zero in a box, where their Jacobian is regular, is proved by `ends`. So are Λ ≠ 0 throughout S and
//! σ ≠ 0 throughout O, and Σ Δλ Δτ / Δν ≠ 0 around the cycle. The latter two make the Jacobian of *all* equations
//! regular at this place, ε and ν in L being unknowns: a change of ε has to change Δν by −Δλ Δτ ε / 2 Δν along every
//! edge in L, which cannot be as these do not add up to zero.
//!
//! # What follows
//! By the implicit function theorem there is one figure near that place for all lengths near these, with ε ≠ 0 for general ones: a
//! regular figure, in which the distances between S and O, and no others, grow beyond all bounds as the lengths become
//! these. Figures from two such places are not congruent. If S is another one, so are the pairs whose distances
//! grow: S is told from O by the fixed triangle of the bound, which does not move, and has a corner in O, as no proper triangle lies in
//! an isotropic plane. If S is the same, m is the normal of the plane through the three points that fix the coordinates,
//! n and n' are the isotropic directions in it, and the two figures have coordinates that differ by no more than an
//! exchange of n with n', for which ε would not be small, and the sign of ν, which the lengths in L fix; so the
//! same figure cannot be near two places. For the same reason none is congruent to its mirror image by a rotation.
//!
//! Each isolated solution for the lengths given, on the other hand, has one near it for all lengths near these, where distances do
//! not grow. So the solutions up to rotation, and twice the places at infinity, are together no more than the bound allows.

mod chart;
mod split;

use super::boxes::{Found, SolutionSet};
use super::number::Complex;
use super::system::Signs;
use crate::interval::DoubleDouble;
use crate::problem::{Distance, Problem, Target};
use chart::prove;
use num_rational::BigRational;
pub use split::{Edge, Split};

/// Distances of a problem in space whose figures can go to infinity, in the system's unit.
#[derive(Debug, Clone)]
pub struct Graph {
    /// How many points there are.
    pub points: usize,
    /// The distances.
    pub edges: Vec<Edge>,
    /// The points that stand still.
    pub fixed: Vec<usize>,
}

impl Graph {
    /// Of a problem of distances in space, for the unit of length of a system. `None`: in the plane nothing of the kind
    /// is known.
    pub fn new(problem: &Problem, fixed: &[usize], unit: f64) -> Option<Self> {
        if problem.dimension != 3 || !problem.is_distances_only() {
            return None;
        }
        let unit = BigRational::from_float(unit)?;
        let edge = |distance: &Distance| {
            let length = match &distance.target {
                Target::Length(length) => Some(length.value() / &unit),
                Target::SquaredLength(squared) => root(&(squared.value() / (&unit * &unit))),
            };
            let squared = match (&length, &distance.target) {
                (Some(length), _) => length * length,
                (None, Target::SquaredLength(squared)) => squared.value() / (&unit * &unit),
                (None, Target::Length(_)) => unreachable!("a length is a ratio"),
            };
            Edge {
                points: distance.points,
                squared,
                length,
            }
        };
        Some(Graph {
            points: problem.points.len(),
            edges: problem.distances.iter().map(edge).collect(),
            fixed: fixed.to_vec(),
        })
    }
}

/// Figures at infinity where the same points go away in the same manner.
#[derive(Debug, Clone)]
pub struct Departure {
    /// Which points go, and how.
    pub split: Split,
    /// The figures, proved, no two of them congruent.
    pub figures: SolutionSet,
}

/// Enters the figure at infinity to which a path seems to go, whose last point this is: for each point of the problem its
/// coordinates. Tells whether it could be proved to be one, be it known before or not.
pub(super) fn enter(
    graph: &Graph,
    last: &[[Complex<DoubleDouble>; 3]],
    known: &mut Vec<Departure>,
) -> bool {
    let Some((split, figure)) = prove(graph, last) else {
        return false;
    };
    let index = known.iter().position(|one| one.split == split);
    let index = index.unwrap_or_else(|| {
        known.push(Departure {
            split,
            figures: SolutionSet::default(),
        });
        known.len() - 1
    });
    let figures = &mut known[index].figures;
    let nothing = Signs {
        changes: vec![false; 3 * graph.points],
        mirrors: false,
    };
    match figures.find(&figure, &[nothing], false) {
        Found::New => {
            figures.push(figure);
            true
        }
        Found::Old(_) => true,
        Found::Unknown => false,
    }
}

/// A number's square root, if that is a ratio.
fn root(squared: &BigRational) -> Option<BigRational> {
    let root = |x: &num_bigint::BigInt| {
        let near = x.sqrt();
        (&near * &near == *x).then_some(near)
    };
    Some(BigRational::new(
        root(squared.numer())?,
        root(squared.denom())?,
    ))
}
