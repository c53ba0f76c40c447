//! Solutions at infinity: figures in space that some dimensions lose, proved one by one and counted.
//!
//! Lengths may be so special that figures which neighbouring lengths have go to infinity. With these lengths there are
//! fewer isolated solutions than a bound for all lengths allows, and how many fewer can be proved.
//!
//! # How a figure goes to infinity
//! The kind of departure that is treated here: some points S go away, all along one direction n with n·n = 0 and
//! equally fast, L are their neighbours and O all others, and these stay. A neighbour q keeps its distance from p in S
//! only if n·(p − q) goes to zero as fast as |p| grows; so all of L comes to lie in a plane n·q = constant (if S is
//! connected; one plane is the case treated). In such a plane the square of a distance is the square of *one*
//! coordinate's difference, as on a line: the lengths among L have to add up to zero with signs around every cycle.
//! Around one cycle that is one condition on the lengths, which round decimals often meet.
//!
//! # Coordinates in which it is a place like all others
//! Let p = λ n + ν m + σ n', with n and n' isotropic, 2 n·n' = 1 = m·m and n·m = n'·m = 0: squares of distances are
//! Δν² + Δλ Δσ. With one more unknown ε let λ = Λ/ε in S and σ = ε τ in S and L. Then the equations of distances are
//!
//! | edge within | S | S and L | L | L and O | O |
//! | --- | --- | --- | --- | --- | --- |
//! | Δν² plus | ΔΛ Δτ | (Λ − ε λ) Δτ | ε Δλ Δτ | Δλ (ε τ − σ) | Δλ Δσ |
//!
//! which make sense for ε = 0 too: a figure at infinity. Seven more equations fix the six motions and the choice of ε:
//! λ = ν = τ = 0 at one point of L, ν = 0 and σ = 1 at one of O, ν = 0 and Λ = 1 at one of S. For small ε ≠ 0 and
//! bounded λ and τ a figure has few such positions: the three points span the plane of n and n', as 1/ε − ε λ τ ≠ 0 (λ
//! at the point of O, τ at that of S), so that m is this plane's normal, up to its sign, and n and n' are its two
//! isotropic directions, up to an exchange; σ = 1 scales n, and with it n', and Λ = 1 says what ε is.
//!
//! # What is proved of each
//! Let L be connected by its edges with exactly one cycle, let none of their lengths be zero, and let a sign be chosen
//! for each so that around the cycle they add up to zero, exactly: then ν is known in L, up to the mirror image's sign,
//! which is chosen so that the first ν that is not zero is positive. What remains at ε = 0, without the edges in L, are
//! as many quadratic equations as unknowns (3 N for N points with 3 N − 6 edges, ν in L and the other six equations for
//! positions included). That they have exactly one zero in a box, and a regular Jacobian there, is proved by `ends`. So
//! are Λ ≠ 0 throughout S and σ ≠ 0 throughout O, and Σ Δλ Δτ / Δν ≠ 0 around the cycle. And S has no point of the
//! triangle that the bound holds fixed, while O has one: other departures are not counted.
//!
//! # What follows
//! The Jacobian of all equations, with ε and ν in L as unknowns, is regular at this place. For along every edge in L a
//! vector of its kernel has 2 Δν δ(Δν) + Δλ Δτ δε = 0. The δ(Δν) add up to zero around the cycle, while Σ Δλ Δτ / Δν
//! does not, so δε = 0, hence all δ(Δν) are zero, and as L is connected and one of its ν is fixed, so is δν in L; the
//! rest is in the kernel of the equations at ε = 0. By the implicit function theorem there is one zero near that place
//! for all lengths near these. It has ε ≠ 0 for general ones, as ε = 0 makes the sum around the cycle zero. So it is a
//! regular figure, in which the distances between S and O, and no others, grow beyond all bounds as the lengths become
//! these: their squares are about −Λ σ / ε.
//!
//! Figures from two such places are not congruent. If they belong to S, O and to S', O', the same pairs of points grow
//! apart only if S' = S or S' = O, and the latter would have a point of the fixed triangle. If S is the same, both have
//! positions as above, which are the same, or have the other sign of ν, or n and n' exchanged, or both. With the other
//! sign of ν they cannot be the same, as in both places the first ν in L that is not zero is positive. With the same
//! one ν is the same in L, so the lengths' signs are too, and the two places are zeros of the same equations in
//! disjoint boxes: near them positions differ. An exchange takes ε to 1 / (ε τ λ), with τ of a point in S and λ of one
//! in O, which is not small (or there is none, where τ λ = 0). Nor is such a figure flat: it would lie in the plane of
//! the three points, and have ν = 0 in L. So it and its mirror image are two figures up to rotation.
//!
//! Each isolated solution for the lengths given, on the other hand, has at least one near it for all lengths near
//! these, as there are as many equations as unknowns; there no distance grows. The bound holds for those lengths, too,
//! as the fixed triangle stays a proper one. So for general lengths near these there are as many isolated figures as
//! the solutions up to rotation and twice the places at infinity together, or more; and no more than the bound.

mod chart;
mod split;

use super::boxes::SolutionSet;
use super::system::Signs;
use crate::interval::DoubleDouble;
use crate::interval::complex::Complex;
use crate::problem::{Distance, Problem};
use crate::rational::Rational;
use chart::prove;
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
        let unit = Rational::from_float(unit)?;
        let per_square = (&unit * &unit).recip();
        let edge = |distance: &Distance| {
            let squared = distance.target.squared() * &per_square;
            Edge {
                points: distance.points,
                length: squared.sqrt(),
                squared,
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

/// Enters the figure at infinity to which a path seems to go, whose last point this is, if it can be proved: for each point
/// of the problem its coordinates.
pub(super) fn enter(
    graph: &Graph,
    last: &[[Complex<DoubleDouble>; 3]],
    known: &mut Vec<Departure>,
) {
    let Some((split, figure)) = prove(graph, last) else {
        return;
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
    // What cannot be told from another one is none that is known.
    let _ = figures.enter(figure, &[nothing]);
}
