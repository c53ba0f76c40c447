//! Problems in a frame of their own: fixed places, coordinates and directions say where the figure is.
//!
//! No motion takes one figure to another, and a mirror image is another figure; so solutions are counted as they are. What
//! may still be reversed is the direction of a line, or the normal of a plane, that goes through no points of the problem:
//! these changes of signs are the group of the system.

use super::lower::Unserved;
use super::system::{Equation, System};
use crate::constraint::{self, Entry};
use crate::equations::Form;
use crate::problem::Problem;
use crate::system::Homotopy;

/// Refuses what zeros of the equations need not meet and figures do: directions that are told by a sign, vectors that must
/// not vanish.
pub fn check(problem: &Problem, homotopy: &Homotopy) -> Result<(), Unserved> {
    if let Some(object) = problem.fixed_directions().next() {
        let object = &problem.objects[object].name;
        return Err(Unserved::Other(format!(
            "`{object}` is fixed and has a direction of its own, of which one component is told by the length only (name two \
             fixed points of it instead)"
        )));
    }
    let vectors = homotopy.nonzero_vectors();
    let mut vectors = vectors.iter().zip(&homotopy.tail.nonzero);
    if let Some((_, vector)) = vectors.find(|(forms, _)| !is_held_apart(homotopy, forms)) {
        return Err(Unserved::Other(format!(
            "{} must not vanish, which zeros of the equations may do (give its length, or name fixed points)",
            vector.name
        )));
    }
    Ok(())
}

/// Whether a vector, per coordinate the unknowns of which it is the difference, goes between places that are told
/// and different.
fn is_held_apart(homotopy: &Homotopy, vector: &[[usize; 2]]) -> bool {
    let head = homotopy.edges.len();
    let told = |unknown: usize| {
        let equations = homotopy.tail.equations.iter().enumerate();
        let mut places = equations.filter(|(_, equation)| is_place(equation));
        let is_its = |e: usize| {
            let terms = homotopy.terms(head + e);
            matches!(terms[0].left, Form::Difference(Some(of), _) if of == unknown)
        };
        let (_, equation) = places.find(|(e, _)| is_its(*e))?;
        super::lower::at_target(&equation.right)
            .as_rational()
            .cloned()
    };
    vector.iter().any(|&[a, b]| match (told(a), told(b)) {
        (Some(a), Some(b)) => a != b,
        _ => false,
    })
}

/// Whether an equation says where a point is along an axis: that is a dimension even where it is zero.
pub fn is_place(equation: &constraint::Equation) -> bool {
    let [product] = &equation.products[..] else {
        return false;
    };
    matches!(
        (product.left, product.right),
        (
            Form::Difference(Entry::Coordinate { .. }, Entry::Zero),
            Form::One
        )
    )
}

/// Refuses problems in which constraints tell the two directions of a line or plane of its own apart, as zeros of the equations may
/// have either, and figures have the one that a path keeps.
pub fn check_directions(
    system: &System,
    problem: &Problem,
    homotopy: &Homotopy,
) -> Result<(), Unserved> {
    let directed = homotopy.directed(|changes| system.keeps(changes, Equation::is_zero));
    match directed.first() {
        None => Ok(()),
        Some(&object) => Err(Unserved::Other(format!(
            "constraints tell the two directions of `{}` apart, which has a direction of its own that a path keeps and the \
             equations do not (name two points of it instead)",
            problem.objects[object].name
        ))),
    }
}
