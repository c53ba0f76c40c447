//! How well reported figures meet the constraints.

use crate::interval::rounding::largest;
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::Solution;

/// Of each reported figure an upper bound, over all constraints, on how far they are from being met, in intervals:
/// over the whole box where the solution is a box, at the reported point where it is a point. So a certified run is
/// charged with the width of its boxes, which is what is known of its solutions, and a float run with the defect of
/// its floats, which says nothing about how far the exact solution is.
///
/// Of a distance it is `| |p_i − p_j|² − a² | / a²`. Of all other equations that the constraints come to (see
/// [`crate::constraint`]) it is the difference of both sides divided by the sum of the sizes of what is added up on
/// the left, or by 1 where that is less, lengths being counted in the power of two nearest to the typical one.
///
/// Nothing where a solution does not say what its auxiliary unknowns are ([`Solution::auxiliary`]).
pub(super) fn residuals(
    problem: &Problem,
    homotopy: &Homotopy,
    solutions: &[Solution],
) -> Vec<f64> {
    let all = solutions.iter().map(|solution| {
        let constraints = of_constraints(homotopy, solution)?;
        Some(largest(of_distances(problem, solution), constraints))
    });
    all.collect::<Option<Vec<f64>>>().unwrap_or_default()
}

fn of_distances(problem: &Problem, solution: &Solution) -> f64 {
    let distances = problem.distances.iter().map(|distance| {
        let [p, q] = distance.points.map(|p| &solution.points[p]);
        let squared = (0..3).fold(point(0.0), |sum, k| sum + (p[k] - q[k]).sqr());
        let target = distance.target.enclose_squared();
        ((squared - target) / target).mag()
    });
    distances.fold(0.0, largest)
}

/// Of all equations but those of distances.
fn of_constraints(homotopy: &Homotopy, solution: &Solution) -> Option<f64> {
    let (head, m) = (homotopy.edges.len(), homotopy.equations);
    if solution.auxiliary.len() != homotopy.tail.unknowns.len() {
        return None;
    }
    let d = homotopy.dimension;
    // The unit is a power of two.
    let per_unit = point(1.0 / homotopy.unit);
    let places = homotopy.gauge.place.iter();
    let coordinates = places.map(|&place| solution.points[place / d][place % d] * per_unit);
    let z: Vec<Interval> = coordinates
        .chain(solution.auxiliary.iter().copied())
        .collect();
    let at = |entry: Option<usize>| entry.map_or(point(0.0), |i| z[i]);
    let equations = (head..m).map(|e| {
        let (mut sum, mut size) = (point(0.0), 0.0);
        for term in homotopy.terms(e) {
            let half = point(0.5 * f64::from(term.factor));
            let product = half * term.value(at);
            sum += product;
            size += product.mag();
        }
        (sum - homotopy.rights[e].at_target()).mag() / largest(1.0, size)
    });
    Some(equations.fold(0.0, largest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Located;
    use crate::track::{Control, Options, Space, solve};

    fn worst(problem: &Problem, solutions: &[Solution]) -> Option<f64> {
        let homotopy = Homotopy::new(problem).unwrap();
        let each = residuals(problem, &homotopy, solutions).into_iter();
        each.reduce(largest)
    }

    #[test]
    fn distances_are_met() {
        let problem = Problem::read("problems/k33.toml").unwrap();
        let options = Options::float(Space::Full);
        let outcome = solve(&problem, &options, &mut Control::default()).unwrap();
        assert!(worst(&problem, &outcome.solutions).unwrap() < 1e-13);
    }

    /// Constraints of all kinds count, not distances alone: here only what belongs to lines is off.
    #[test]
    fn constraints_count() {
        let problem = Problem::read("problems/constraints/3p3l.toml").unwrap();
        for options in [Options::certified(), Options::float(Space::Full)] {
            let outcome = solve(&problem, &options, &mut Control::default()).unwrap();
            let bound = |solutions: &[Solution]| worst(&problem, solutions);
            let good = bound(&outcome.solutions).unwrap();
            assert!(good < 1e-12, "{good:e}");
            let mut off = outcome.solutions.clone();
            assert!(matches!(off[2].objects[0], Located::Line { .. }));
            for x in &mut off[2].auxiliary {
                *x += point(1e-3);
            }
            assert!(bound(&off).unwrap() > 1e-4);
            assert_eq!(off[2].points, outcome.solutions[2].points);
            // What is not known is not said.
            off[2].auxiliary.clear();
            assert_eq!(bound(&off), None);
            assert_eq!(bound(&[]), None);
        }
    }

    /// A solution of other dimensions does not meet these.
    #[test]
    fn other_targets_are_not_met() {
        let text = std::fs::read_to_string("problems/constraints/3p3l.toml").unwrap();
        let other = text.replace("[\"l1\", \"l2\", 8]", "[\"l1\", \"l2\", 8.1]");
        assert_ne!(text, other);
        let [problem, other] = [text, other].map(|text| Problem::parse(&text, "a.toml").unwrap());
        let options = Options::float(Space::Full);
        let outcome = solve(&problem, &options, &mut Control::default()).unwrap();
        let residual = worst(&other, &outcome.solutions).unwrap();
        assert!(residual > 1e-4, "{residual:e}");
    }
}
