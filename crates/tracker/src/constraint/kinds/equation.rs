//! `equations`: polynomials of one's own that are to be zero, with roots and quotients.

use super::super::lowering::{Number, Sum};
use super::prelude::*;
use crate::statement::{Atom, Terms};

/// The key of the kind.
pub const EQUATIONS: &str = "equations";

/// See the module.
pub const EQUATION: Kind = Kind {
    key: EQUATIONS,
    meaning: "an equation of unknowns, coordinates, distances and what joints do",
    takes: "an equation in quotes, \"x^2 + y^2 = 2\"",
    fixes,
    ..Kind::lowered_by(lower)
};

fn fixes(_: &Problem, of: &Constraint) -> Fixes {
    let is_placed = of
        .formula
        .as_ref()
        .is_some_and(|formula| formula.is_placed());
    Fixes {
        frame: is_placed,
        axes: [is_placed; 3],
    }
}

fn lower(of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let formula = low.problem.constraints[low.constraint()].formula.as_ref();
    let formula = formula.ok_or("it is no equation")?;
    if let Some((turns, degrees)) = formula.turns() {
        return low.turns_add_up(of.name, &turns, &degrees);
    }
    let mut atoms: Vec<Number> = Vec::with_capacity(formula.atoms.len());
    for atom in &formula.atoms {
        let number = match atom {
            &Atom::Number(object) => low.unknown_number(object),
            &Atom::Coordinate { point, axis } => low.coordinate_number(point, axis),
            &Atom::Length(ends) => low.length_number(ends)?,
            &Atom::Travel(joint) => low.travel_number(joint)?,
            Atom::Turn(_) => return Err("turns are added up by themselves".to_owned()),
            Atom::Root(terms) => {
                let (sum, constant) = sum_of(terms, &atoms);
                low.root_number(sum, constant, of.name)?
            }
            Atom::Inverse(terms) => {
                let (sum, constant) = sum_of(terms, &atoms);
                low.inverse_number(sum, constant, of.name)?
            }
        };
        atoms.push(number);
    }
    let (sum, constant) = sum_of(&formula.zero, &atoms);
    low.sum(of.name, sum, &-&Real::from(constant));
    Ok(())
}

/// The terms with what the atoms are, and the number that stands by itself.
fn sum_of(terms: &Terms, atoms: &[Number]) -> (Sum, Rational) {
    let mut constant = Rational::zero();
    let mut sum = Sum::new();
    for (term, coefficient) in terms.iter() {
        match term.is_empty() {
            true => constant = coefficient.clone(),
            false => {
                let factors = term.iter().map(|&atom| atoms[atom].clone());
                sum.push((coefficient.clone(), factors.collect()));
            }
        }
    }
    (sum, constant)
}
