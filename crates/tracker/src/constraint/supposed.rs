//! Which lengths are supposed to be greater than zero, though no number says so.

use super::arguments::Arguments;
use crate::statement::{Atom, Constraint, Problem};

/// The lengths that `ratios` and `differences` compare or that stand in equations, by the ends, and that are no dimension and not the longer ones of a difference: their
/// equations suppose that they are greater than zero, so that a figure in which one is 0 is none.
pub fn supposed_lengths(problem: &Problem) -> Vec<[usize; 2]> {
    let is_given = |[a, b]: [usize; 2]| {
        let mut given = problem.distances.iter().map(|d| d.points);
        given.any(|ends| ends == [a, b] || ends == [b, a])
    };
    let mut all: Vec<[usize; 2]> = Vec::new();
    for constraint in &problem.constraints {
        let in_equation = constraint.formula.iter().flat_map(|formula| &formula.atoms);
        let in_equation = in_equation.filter_map(|atom| match atom {
            Atom::Length(ends) => Some(*ends),
            _ => None,
        });
        let compared = compared(problem, constraint).into_iter().flatten();
        for [a, b] in compared.chain(in_equation) {
            let ends = [a.min(b), a.max(b)];
            if !is_given(ends) && !all.contains(&ends) {
                all.push(ends);
            }
        }
    }
    all
}

/// The equations with roots, which suppose that what is under a root is greater than zero.
pub fn equations_with_roots(problem: &Problem) -> impl Iterator<Item = &str> {
    let formulas = problem.constraints.iter();
    let formulas = formulas.filter_map(|constraint| constraint.formula.as_ref());
    formulas
        .filter(|formula| {
            let mut atoms = formula.atoms.iter();
            atoms.any(|atom| matches!(atom, Atom::Root(_)))
        })
        .map(|formula| formula.text.as_str())
}

/// The lengths that a constraint compares and that may be 0 as far as its number tells.
fn compared(problem: &Problem, constraint: &Constraint) -> Option<Vec<[usize; 2]>> {
    let is_difference = constraint.kind == "differences";
    if !is_difference && constraint.kind != "ratios" {
        return None;
    }
    let mut items = Arguments::new(problem, &constraint.items);
    let both = [items.segment().ok()?, items.segment().ok()?];
    let value = constraint.value.as_ref()?.value();
    Some(match is_difference {
        true if value.is_positive() => vec![both[1]],
        true if value.is_negative() => vec![both[0]],
        _ => both.to_vec(),
    })
}
