//! Start figures: random complex coordinates, and the parameters that they have (Imbach, Schreck, Mathis,
//! *Leading a continuation method by geometry*, 2.4).

use super::exact::{Exact, Parameter, Random};
use super::lines;
use super::system::{Kind, Start, System};
use crate::equations::Form;
use crate::places::Each as _;

/// A figure and its parameters: exactly, or, where these would be long ratios, nearly.
#[derive(Debug, Clone)]
pub struct StartFigure {
    /// The unknowns.
    pub values: Vec<Exact>,
    /// The right-hand sides of all equations.
    pub parameters: Vec<Parameter>,
}

/// Unknowns that are longer ratios are not computed.
const MOST_BITS: u64 = 100_000;

/// Draws a figure. `None` where the equations that define auxiliary unknowns cannot be solved for them one after
/// the other.
pub fn draw(system: &System, random: &mut Random) -> Option<StartFigure> {
    let n = system.unknowns.len();
    let mut values: Vec<Option<Exact>> = vec![None; n];
    match system.start {
        Start::Any => {}
        Start::Lines(across) => lines::draw(system, across, random, &mut values)?,
        Start::Placed(unknowns, count) => {
            for (k, &unknown) in unknowns[..count].iter().enumerate() {
                // The second reference point around (1, 0, 0), the third around (0, 1, 0).
                let from = Exact::whole(if k == 1 { 0 } else { 1 });
                values[unknown] = Some(from.plus(&random.nearly_whole()));
            }
        }
    }
    // An unknown that a fixed equation defines is not drawn: the last that stands in it alone, or, in a frame of its own where
    // there is none, the last that is multiplied by others only, a coordinate of a point if there is one.
    let mut is_coordinate = vec![false; n];
    for &unknown in system.points.iter().flatten().flatten() {
        is_coordinate[unknown] = true;
    }
    let mut defined: Vec<Option<usize>> = vec![None; n];
    for (e, equation) in system.equations.iter().enumerate() {
        if let Kind::Fixed(_) = equation.right {
            let is_open = |&u: &usize| defined[u].is_none() && values[u].is_none();
            let open = || (0..n).rev().filter(is_open);
            let alone = open().find(|&u| system.stands_alone(e, u));
            let multiplied = || {
                let mut affine = open().filter(|&u| system.is_absolute && is_affine(system, e, u));
                let last = affine.clone().next();
                affine.find(|&u| is_coordinate[u]).or(last)
            };
            if let Some(unknown) = alone.or_else(multiplied) {
                defined[unknown] = Some(e);
            }
        }
    }
    for (value, defined) in values.iter_mut().zip(&defined) {
        if value.is_none() && defined.is_none() {
            *value = Some(random.nearly_real());
        }
    }
    loop {
        let open = (0..n).filter(|&u| values[u].is_none());
        let ready = open.clone().find(|&u| {
            defined[u].is_some_and(|e| {
                unknowns_of(system, e).all(|other| other == u || values[other].is_some())
            })
        });
        let Some(unknown) = ready else {
            if open.count() > 0 {
                return None;
            }
            break;
        };
        let equation = defined[unknown]?;
        let Kind::Fixed(right) = &system.equations[equation].right else {
            return None;
        };
        // What is not known does not stand in the equation.
        let known = |u: usize| values[u].clone().unwrap_or_else(Exact::zero);
        let [above, slope] = system.alone(equation, unknown, right.clone(), known);
        let value = above.over(&slope)?;
        if value.bits() > MOST_BITS {
            return None;
        }
        values[unknown] = Some(value);
    }
    let values: Vec<Exact> = values.into_iter().collect::<Option<_>>()?;
    let half = Exact::whole(1).over(&Exact::whole(2))?;
    let mut parameters = Vec::with_capacity(n);
    for (e, equation) in system.equations.iter().enumerate() {
        let value = system.evaluate(e, |u| values[u].clone()).times(&half);
        if let Kind::Fixed(wanted) = &equation.right
            && *wanted != value
        {
            return None;
        }
        let value = match &equation.right {
            Kind::Parameter(_) => value.shortened(),
            Kind::Fixed(_) => value,
        };
        parameters.push(value.parts());
    }
    Some(StartFigure { values, parameters })
}

pub(super) fn unknowns_of(system: &System, equation: usize) -> impl Iterator<Item = usize> + '_ {
    let terms = system.equations[equation].terms.iter();
    terms.flat_map(|term| term.entries()).flatten()
}

/// Whether an unknown stands in an equation, and never times itself.
fn is_affine(system: &System, equation: usize, unknown: usize) -> bool {
    let stands = |form: Form<Option<usize>>| form.entries().any(|e| e.0 == Some(unknown));
    let terms = system.equations[equation].terms.iter();
    let mut found = terms.map(|term| term.forms().each(stands));
    found.clone().all(|both| both != [true, true]) && found.any(|both| both != [false, false])
}
