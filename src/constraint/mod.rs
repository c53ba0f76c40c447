//! Constraints: what each kind means, and the equations that it becomes.

mod quadratic;

pub use quadratic::{
    Entry, Equation, Form, MAX_DEGREE, Product, Role, Tail, Unknown, coordinate, difference,
    product, value,
};

use crate::interval::Interval;
use crate::problem::Problem;

/// The auxiliary unknowns and the equations of all constraints of a problem that are not distances
/// between points.
///
/// `sketch`: the coordinates of every point of the sketch as the reference sees them, in the
/// problem's unit.
pub fn lower(problem: &Problem, sketch: &[[Interval; 3]]) -> Tail {
    debug_assert_eq!(problem.points.len(), sketch.len());
    Tail::default()
}
