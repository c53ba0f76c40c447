//! The equations of one block, all other numbers being known.

use super::Row;
use super::number::Number;
use crate::equations::Form;
use crate::interval::{Interval, point};
use crate::map::Map;

/// `Σ Q_ij x_i x_j / 2 + Σ b_i x_i + c = 0`.
#[derive(Debug, Clone)]
pub struct Local {
    /// Q_ij with i ≤ j, whole numbers that are not zero.
    pub quadratic: Map<(usize, usize), i64>,
    /// b, one for each unknown.
    pub linear: Vec<Number>,
    /// c.
    pub constant: Number,
}

impl Local {
    /// A row as an equation of some unknowns, with the values of all others, and what it is to be.
    pub fn new(row: &Row, own: &[usize], value: impl Fn(usize) -> Number, right: &Number) -> Self {
        let of = |entry: Option<usize>| match entry {
            None => Err(Number::halves(0)),
            Some(u) => own.iter().position(|&o| o == u).ok_or_else(|| value(u)),
        };
        let mut quadratic = Vec::new();
        let mut out = Local {
            quadratic: Map::default(),
            linear: vec![Number::halves(0); own.len()],
            constant: Number::halves(0).minus(right),
        };
        for p in &row.products {
            let parts = p.expand(of);
            let half = Number::halves(p.factor.into());
            let products = parts.products.into_iter();
            quadratic.extend(products.map(|(key, sign)| (key, i64::from(p.factor * sign))));
            for (i, by) in parts.linear {
                out.linear[i] = out.linear[i].plus(&half.times(&by));
            }
            out.constant = out.constant.plus(&half.times(&parts.constant));
        }
        out.quadratic = Map::sums(quadratic);
        out
    }

    /// Q_ij.
    pub fn q(&self, i: usize, j: usize) -> i64 {
        let key = (i.min(j), i.max(j));
        self.quadratic.get(&key).copied().unwrap_or(0)
    }

    /// The left-hand side on a box.
    pub fn value(&self, at: &[Interval]) -> Interval {
        let linear = self.linear.iter().zip(at);
        let sum = linear.fold(self.constant.enclosure(), |sum, (b, x)| {
            sum + b.enclosure() * *x
        });
        self.quadratic.iter().fold(sum, |sum, (&(i, j), &q)| {
            let square = if i == j { at[i].sqr() } else { at[i] * at[j] };
            sum + point(0.5 * q as f64) * square
        })
    }

    /// Its derivatives at numbers: ratios where all of them are.
    pub fn derivatives(&self, at: &[Number]) -> Vec<Number> {
        let mut out = self.linear.clone();
        for (&(i, j), &q) in self.quadratic.iter() {
            let half = Number::halves(q);
            let (of_i, of_j) = (half.times(&at[j]), half.times(&at[i]));
            out[i] = out[i].plus(&of_i);
            out[j] = out[j].plus(&of_j);
        }
        out
    }

    /// Its derivatives on a box.
    pub fn gradient(&self, at: &[Interval]) -> Vec<Interval> {
        let mut out: Vec<Interval> = self.linear.iter().map(Number::enclosure).collect();
        for (&(i, j), &q) in self.quadratic.iter() {
            let half = point(0.5 * q as f64);
            out[i] += half * at[j];
            out[j] += half * at[i];
        }
        out
    }
}

/// Whether a row is the square of one difference: of an unknown and a number, once all others are known.
pub fn is_square(row: &Row) -> bool {
    let [single] = row.products.as_slice() else {
        return false;
    };
    single.left == single.right && single.left != Form::One
}

/// Whether a row says that a sum of squares with unknowns of a block, less squares without, is a number: a distance, or a
/// point on a circle.
pub fn is_length(row: &Row, own: &[usize]) -> bool {
    let mut has_own = false;
    let fits = row.products.iter().all(|p| {
        let is_own = p.entries().flatten().any(|u| own.contains(&u));
        has_own |= is_own;
        p.left == p.right && p.left != Form::One && (p.factor > 0 || !is_own)
    });
    fits && has_own
}
