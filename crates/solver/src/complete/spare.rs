//! More equations than unknowns: as many are used as are needed, chosen where the sketch comes nearest to meeting all.
//!
//! Seen in floats; what is claimed of the equations used does not rest on it, and what was left out is tested for itself.

use crate::blocks::Whose;
use crate::constraint::{Entry, Equation, Form, Lowered, Product, Spare};
use crate::equations::{left_side, slopes};
use crate::interval::Interval;
use crate::linalg::{Span, linearised, nearest};
use crate::order::InOrder;
use crate::problem::Problem;
use crate::system::Gauge;
use nalgebra::DVector;

/// Of more unknowns the sketch is taken as it is.
const MOST_UNKNOWNS: usize = 300;

/// All equations as functions of the unknowns, each unknown and each equation divided by the power of the typical length that it has.
struct Equations<'a> {
    lowered: &'a Lowered,
    gauge: &'a Gauge,
    sketch: &'a [[Interval; 3]],
    unit: f64,
}

impl Equations<'_> {
    fn width(&self) -> usize {
        self.gauge.place.len() + self.lowered.tail.unknowns.len()
    }

    /// The column of an entry, and its number where it is no unknown.
    fn column(&self, entry: Entry) -> Result<usize, f64> {
        match entry {
            Entry::Zero => Err(0.0),
            Entry::Unknown(u) => Ok(self.gauge.place.len() + u),
            Entry::Coordinate { point, axis } => {
                let column = self.gauge.variable[point * self.gauge.dimension + axis];
                match column < self.width().min(self.gauge.place.len()) {
                    true => Ok(column),
                    false => Err(self.sketch[point][axis].mid() / self.unit),
                }
            }
        }
    }

    /// The unknowns in the sketch.
    fn start(&self) -> Vec<f64> {
        let places = self.gauge.place.iter().map(|&place| {
            let (point, axis) = (place / self.gauge.dimension, place % self.gauge.dimension);
            self.sketch[point][axis].mid() / self.unit
        });
        let unknowns = self.lowered.tail.unknowns.iter();
        places
            .chain(unknowns.map(|u| u.sketch.mid() / self.unit.powi(u.power)))
            .collect()
    }

    /// How far an equation is from holding, and its derivatives, told one by one.
    fn row(&self, equation: &Equation, x: &[f64], mut tell: impl FnMut(usize, f64)) -> f64 {
        let value = |entry: Entry| self.column(entry).map_or_else(|fixed| fixed, |c| x[c]);
        let right: f64 = equation.right.iter().map(|e| e.enclose().mid()).sum();
        slopes(&equation.products, value, |entry, slope| {
            self.column(entry).into_iter().for_each(|c| tell(c, slope));
        });
        left_side(&equation.products, value) - right / self.unit.powi(equation.power)
    }

    /// The unknowns where all equations are met as nearly as can be reached from the sketch (Levenberg and Marquardt).
    fn nearest(&self) -> Vec<f64> {
        let x = self.start();
        let m = x.len();
        if m > MOST_UNKNOWNS {
            return x;
        }
        let equations = &self.lowered.tail.equations;
        let linearise = |x: &[f64]| {
            linearised((equations.len(), m), &|e, slope| {
                self.row(&equations[e], x, slope)
            })
        };
        let x = nearest(DVector::from_vec(x), [1e-13, 1.0], &linearise);
        x.data.into()
    }
}

/// Leaves out as many equations as there are more than unknowns: those that say nothing new beside the others. What defines objects and unknowns
/// is used first, then what is `fixed`, dimensions, and constraints without a number, in the order of the file. `Err`: too few say something new.
pub(super) fn make_square(
    lowered: &mut Lowered,
    problem: &Problem,
    gauge: &Gauge,
    sketch: &[[Interval; 3]],
    unit: f64,
) -> Result<Vec<Spare>, String> {
    let rank = |owner: usize| match Whose::of(problem, owner) {
        Whose::Object(_) | Whose::Pin => 0,
        // What is fixed comes before dimensions.
        owner => owner.keep(problem).max(1),
    };
    let equations = Equations {
        lowered,
        gauge,
        sketch,
        unit,
    };
    let (x, width) = (equations.nearest(), equations.width());
    let mut order: Vec<usize> = (0..lowered.owners.len()).collect();
    order.order_by_key(|&e| rank(lowered.owners[e]));
    let mut is_used = vec![false; order.len()];
    let mut span = Span::default();
    for e in order {
        let mut row = vec![0.0; width];
        equations.row(&lowered.tail.equations[e], &x, |c, slope| row[c] += slope);
        is_used[e] = span.take([row]);
    }
    if span.rank() < width {
        return Err(format!(
            "of {} equations for {width} unknowns no more than {} say something new where the sketch comes nearest to meeting all",
            is_used.len(),
            span.rank()
        ));
    }
    let mut spare = Vec::new();
    for e in (0..is_used.len()).rev().filter(|&e| !is_used[e]) {
        let (equation, owner) = (lowered.tail.equations.remove(e), lowered.owners.remove(e));
        lowered.vanishing.remove(e);
        spare.push(Spare { equation, owner });
    }
    spare.reverse();
    // A line is the same with its direction reversed only where all equations say so.
    let twins = std::mem::take(&mut lowered.tail.twins);
    let stays = |twin: &Vec<bool>| spare.iter().all(|spare| is_kept(spare, twin));
    lowered.tail.twins = twins.into_iter().filter(stays).collect();
    Ok(spare)
}

/// Whether it says the same where these auxiliary unknowns change their signs, as far as each product tells.
fn is_kept(spare: &Spare, changes: &[bool]) -> bool {
    let sign = |entry: Entry| matches!(entry, Entry::Unknown(u) if changes[u]);
    let of = |form: Form| match form {
        Form::One => Some(false),
        Form::Difference(a, Entry::Zero) | Form::Difference(Entry::Zero, a) => Some(sign(a)),
        Form::Difference(a, b) => (sign(a) == sign(b)).then(|| sign(a)),
    };
    let both = |p: &Product| Some(of(p.left)? ^ of(p.right)?);
    let mut products = spare.equation.products.iter().map(both);
    let first = products.next().flatten();
    first.is_some_and(|change| {
        let is_zero = spare
            .equation
            .right
            .iter()
            .all(crate::interval::Real::is_zero);
        products.all(|p| p == Some(change)) && (!change || is_zero)
    })
}
