//! How well reported figures meet the dimensions.

use crate::interval::rounding::largest;
use crate::interval::{enclose, point};
use crate::problem::{Problem, Target};
use crate::track::Solution;

/// An upper bound on `| |p_i − p_j|² − a² | / a²` over all distances and all reported figures, in
/// intervals: over the whole box where the solution is a box, at the reported point where it is a
/// point. So a certified run is charged with the width of its boxes, which is what is known of its
/// solutions, and a float run with the defect of its floats, which says nothing about how far the
/// exact solution is. None where there is no solution.
///
/// ```
/// use krawl::compare::residual_bound;
/// use krawl::problem::Problem;
/// use krawl::track::{Control, Options, Space, solve};
/// let problem = Problem::read("problems/k33.toml")?;
/// let outcome = solve(&problem, &Options::float(Space::Full), &mut Control::default())?;
/// assert!(residual_bound(&problem, &outcome.solutions).unwrap() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn residual_bound(problem: &Problem, solutions: &[Solution]) -> Option<f64> {
    let of = |solution: &Solution| {
        let distances = problem.distances.iter().map(|distance| {
            let [p, q] = distance.points.map(|p| &solution.points[p]);
            let squared = (0..3).fold(point(0.0), |sum, k| sum + (p[k] - q[k]).sqr());
            let target = match &distance.target {
                Target::Length(length) => enclose(length).sqr(),
                Target::SquaredLength(squared) => enclose(squared),
            };
            ((squared - target) / target).mag()
        });
        distances.fold(0.0, largest)
    };
    (!solutions.is_empty()).then(|| solutions.iter().map(of).fold(0.0, largest))
}
