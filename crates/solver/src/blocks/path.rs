//! Blocks that no formula solves: their path is followed.

use super::cut::{Cut, Used};
use super::local::is_length;
use super::number::Number;
use crate::constraint::{Entry, Equation, Form, Product, value};
use crate::interval::{Real, point};
use crate::order::{InOrder, add_new};
use crate::rational::Rational;
use crate::system::{Homotopy, Part};
use crate::track::arc::{ArcEnd, Figure};
use crate::track::certified::{Relation, arcs, prove_figure, track};
use crate::track::{Control, FigureBox, FiguresSeen, Options, Space, Status};
use std::collections::HashMap;

/// A block is followed over so many tubes and then given up: those that came to so many ran away.
const MOST_TUBES: usize = 1000;
/// How far the equation that bends does so, as a part of its length times the typical length.
const BEND: f64 = 0.05;

/// What a block's path came to.
pub struct PathRun {
    /// The solutions on it, those that the sketch moves to without a fold first.
    pub solutions: Vec<Vec<Number>>,
    /// Why it could not be followed to its end.
    pub doubt: Option<String>,
    /// Tubes.
    pub tubes: usize,
}

/// Follows the path of a block: its equations are led to their targets, and the numbers of blocks before, which are in
/// them, from the sketch to where they are, in proportion to t. Where one of the equations is about a length it bends, so
/// that the path comes back; where that leads the path away from t = 1, the straight one is followed up to there too.
pub fn follow(
    cut: &Cut,
    block: usize,
    values: &[Option<Number>],
    options: &Options,
    control: &mut Control,
) -> PathRun {
    let given_up = |doubt: String| PathRun {
        solutions: Vec::new(),
        doubt: Some(doubt),
        tubes: 0,
    };
    let bent = match homotopy(cut, block, values, true) {
        Ok(homotopy) => homotopy,
        Err(why) => return given_up(why),
    };
    let options = Options {
        space: Space::Full,
        max_steps: options.max_steps.min(MOST_TUBES),
        ..options.clone()
    };
    let own = &cut.blocks.blocks[block].unknowns;
    let numbers = |found: &FigureBox| -> Vec<Number> {
        let each = own.iter().enumerate();
        each.map(|(k, &u)| {
            let unit = cut.unit.powi(cut.system.unknowns[u].power);
            Number::within(found.figure.enclosure(k) * point(unit))
        })
        .collect()
    };
    if !moves(&bent) {
        // The path is the sketch, for every t.
        let near: Vec<f64> = bent.sketch_of_unknowns().map(|x| x.mid()).collect();
        return match prove_figure(&bent, &near, false) {
            Ok(found) => PathRun {
                solutions: vec![numbers(&found)],
                doubt: None,
                tubes: 0,
            },
            Err(why) => given_up(why),
        };
    }
    let mut seen = FiguresSeen::default();
    let mut watched = Control {
        cancel: control.cancel,
        figures: Some(&mut seen),
        ..Control::default()
    };
    let outcome = track(&bent, &options, &mut watched);
    let mut doubt = match outcome.status {
        Status::Stopped(stop) => Some(stop.text),
        Status::Closed | Status::Open(_) => None,
    };
    if outcome.solutions.len() != seen.solutions.len()
        || outcome.solutions.iter().any(|found| found.is_degenerate)
    {
        return given_up("its solutions could not be told apart".to_owned());
    }
    let mut found: Vec<(bool, FigureBox)> = outcome
        .solutions
        .iter()
        .zip(seen.solutions)
        .map(|(solution, found)| {
            let folds = solution.place.and_then(|place| place.folds);
            (folds != Some(0), found)
        })
        .collect();
    found.order_by_key(|(folded, _)| *folded);
    let mut tubes = outcome.steps;
    if found.first().is_none_or(|(folded, _)| *folded)
        && let Ok(straight) = homotopy(cut, block, values, false)
    {
        let mut follower = arcs(straight, &options);
        let start = Figure::of_sketch(follower.homotopy());
        let mut plain = Control {
            cancel: control.cancel,
            ..Control::default()
        };
        let run = follower.follow(&start, &mut plain);
        tubes += run.steps;
        if let ArcEnd::Reached(figure) = run.end {
            let reached = FigureBox {
                figure,
                alone_within: run.alone_within,
            };
            let relations = found.iter();
            let relations: Vec<Relation> = relations
                .map(|(_, other)| reached.relation(other, &bent))
                .collect();
            let same = relations.iter().position(|r| *r == Relation::Congruent);
            if let Some(k) = same {
                found[..=k].rotate_right(1);
            } else if relations.contains(&Relation::Unknown) {
                let why = "whether a solution is one of the others is not certain";
                doubt.get_or_insert_with(|| why.to_owned());
            } else {
                found.insert(0, (false, reached));
            }
        }
    }
    PathRun {
        solutions: found.iter().map(|(_, found)| numbers(found)).collect(),
        doubt,
        tubes,
    }
}

/// Whether anything changes with t.
fn moves(homotopy: &Homotopy) -> bool {
    let zero = point(0.0);
    let mut rights = homotopy.rights.iter();
    rights.any(|right| right.enclosures()[1..].iter().any(|c| *c != zero))
}

/// The block's equations with the numbers that they need; `bent`: one of them may bend.
fn homotopy(
    cut: &Cut,
    block: usize,
    values: &[Option<Number>],
    bent: bool,
) -> Result<Homotopy, String> {
    let block = &cut.blocks.blocks[block];
    let rows: Vec<usize> = block
        .equations
        .iter()
        .filter_map(|&e| match cut.used[e] {
            Used::Row(row) => Some(row),
            Used::Held(_) => None,
        })
        .collect();
    let mut all = block.unknowns.clone();
    for &row in &rows {
        for &u in &cut.system.rows[row].unknowns {
            add_new(&mut all, u);
        }
    }
    let local: HashMap<usize, usize> = all.iter().enumerate().map(|(k, &u)| (u, k)).collect();
    let known = &all[block.unknowns.len()..];
    let entry = |unknown: Option<usize>| Entry::from(unknown.map(|u| local[&u]));
    let bends = rows
        .iter()
        .rposition(|&row| bent && is_length(&cut.system.rows[row], &block.unknowns));
    let mut equations: Vec<Equation> = Vec::with_capacity(all.len());
    for (k, &row) in rows.iter().enumerate() {
        let row = &cut.system.rows[row];
        let mut right = cut.rights[row.index].clone();
        if bends == Some(k) {
            bend(&mut right, by(cut, row, values)?);
        }
        equations.push(Equation {
            name: cut.name(row.index),
            products: row.products.iter().map(|p| p.map(entry)).collect(),
            right,
            power: cut.powers[row.index],
        });
    }
    for &u in known {
        let unknown = &cut.system.unknowns[u];
        let there = values[u].as_ref().and_then(Number::to_real);
        let there = there.ok_or_else(|| format!("{} is not known", unknown.name))?;
        let here = cut.system.values[u].clone();
        let change = &there - &here;
        equations.push(Equation {
            name: unknown.name.clone(),
            products: vec![Product::new(2, value(entry(Some(u))), Form::One)],
            right: vec![here, change],
            power: unknown.power,
        });
    }
    let d = cut.problem.dimension;
    let coordinates = cut.system.coordinates.iter();
    Ok(Homotopy::of_part(Part {
        dimension: d,
        coordinates: coordinates.map(|u| local.get(u).copied()).collect(),
        unit: cut.unit,
        unknowns: all
            .iter()
            .map(|&u| cut.system.unknowns[u].clone())
            .collect(),
        nonzero: cut.system.nonzero_in(d, &local),
        equations,
        followed: Vec::new(),
        segments: Vec::new(),
        beside: Vec::new(),
    }))
}

/// Adds δ t (1 − t).
fn bend(right: &mut Vec<Real>, delta: Real) {
    while right.len() < 3 {
        right.push(Real::zero());
    }
    right[1] = &right[1] + &delta;
    right[2] = &right[2] - &delta;
}

/// δ by which half the square of a length bends, so that far from t = 0 and t = 1 it would be negative: no path goes there.
/// Any number does for the proof.
fn by(cut: &Cut, row: &super::Row, values: &[Option<Number>]) -> Result<Real, String> {
    let sketch = |u: usize| cut.system.values[u].enclose().mid();
    let now = |u: usize| {
        values[u]
            .as_ref()
            .map_or(sketch(u), |x| x.enclosure().mid())
    };
    let (mut squares, mut growth) = (0.0, 0.0);
    for p in &row.products {
        let before: f64 = p.left.value(|entry| entry.map_or(0.0, sketch));
        let change = p.left.value(|entry| entry.map_or(0.0, now)) - before;
        if p.factor > 0 {
            squares += f64::from(p.factor) * before * before;
        } else {
            growth += 0.5 * f64::from(-p.factor) * change * change;
        }
    }
    if let Some(curve) = cut.rights[row.index].get(2) {
        growth += curve.enclose().mid().abs();
    }
    let delta = BEND * squares.sqrt() * cut.unit + 2.0 * growth;
    Rational::from_float(delta)
        .map(Real::from)
        .ok_or_else(|| "its lengths are too large".to_owned())
}
