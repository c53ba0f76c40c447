//! Sums of two equations in which products of unknowns cancel.
//!
//! Two spheres about given points meet in a plane, and so do other quadrics that have most products in common. Each by itself
//! bounds a point badly where it holds for many places; the plane does not. So of every two equations of a block the sum of whole multiples in
//! which most products cancel is taken, if it has fewer than either, and narrows ranges beside them. It is 0 at every zero.

use super::contract::Empty;
use super::expanded::Expanded;
use super::newton::Square;
use crate::interval::{Interval, checked, point};

/// `Σ terms + constant = 0`.
#[derive(Debug, Clone)]
pub struct Combined {
    terms: Vec<(Interval, Term)>,
    constant: Interval,
}

/// What a factor is multiplied by: entries of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Term {
    One(usize),
    Square(usize),
    Product(usize, usize),
}

/// The greatest number of sums taken, so that they cost no more than all else.
const MOST: usize = 200;

/// The sums of a block's equations, entries of blocks before being in their ranges.
pub fn combined(square: &Square, x: &[Interval]) -> Vec<Combined> {
    let rows = square.rows.iter();
    let rows: Vec<Option<Expanded>> = rows.map(|row| Expanded::new(row, square, x)).collect();
    let mut out = Vec::new();
    for (e, one) in rows.iter().enumerate() {
        for other in &rows[..e] {
            let (Some(one), Some(other)) = (one, other) else {
                continue;
            };
            let least = one.quadratic.len().min(other.quadratic.len());
            let sums = one.quadratic.iter().filter_map(|(key, &q)| {
                let p = *other.quadratic.get(key)?;
                let by = gcd(p.unsigned_abs(), q.unsigned_abs()) as i64;
                one.less(p / by, other, q / by)
            });
            let best = sums.min_by_key(|sum| sum.quadratic.len());
            if let Some(best) = best.filter(|best| best.quadratic.len() < least)
                && out.len() < MOST
            {
                out.push(Combined::new(&best, &square.own));
            }
        }
    }
    out
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl Combined {
    fn new(sum: &Expanded, own: &[usize]) -> Self {
        let quadratic = sum.quadratic.iter().map(|(&(i, j), &q)| {
            let term = match i == j {
                true => Term::Square(own[i]),
                false => Term::Product(own[i], own[j]),
            };
            (point(0.25 * q as f64), term)
        });
        let linear = sum.linear.iter().zip(own);
        let linear = linear.filter(|(b, _)| b.mag() > 0.0);
        let linear = linear.map(|(&b, &u)| (b, Term::One(u)));
        Combined {
            terms: quadratic.chain(linear).collect(),
            constant: sum.constant,
        }
    }

    /// Narrows the ranges of its unknowns. Tells which became narrower.
    pub fn narrow(&self, x: &mut [Interval], mut tell: impl FnMut(usize)) -> Result<(), Empty> {
        let value = |term: Term, x: &[Interval]| match term {
            Term::One(u) => x[u],
            Term::Square(u) => x[u].sqr(),
            Term::Product(u, v) => x[u] * x[v],
        };
        let count = self.terms.len();
        let values = self.terms.iter().map(|&(by, term)| by * value(term, x));
        let values: Vec<Interval> = values.collect();
        // The sums of all terms behind each.
        let mut behind = vec![self.constant; count + 1];
        for k in (0..count).rev() {
            behind[k] = behind[k + 1] + values[k];
        }
        if !behind[0].contains(0.0) {
            return Err(Empty);
        }
        let mut before = point(0.0);
        for (k, &(by, term)) in self.terms.iter().enumerate() {
            let rest = before + behind[k + 1];
            before += values[k];
            if rest.is_entire() || by.contains(0.0) {
                continue;
            }
            let wanted = -rest / by;
            let mut to = |u: usize, range: Interval, x: &mut [Interval]| {
                let new = x[u].intersection(range);
                if new.is_empty() {
                    return Err(Empty);
                }
                if new != x[u] {
                    let (old, now) = (x[u].wid(), new.wid());
                    x[u] = new;
                    // As where ranges are narrowed by single equations.
                    if now < 0.95 * old || old.is_infinite() && now.is_finite() {
                        tell(u);
                    }
                }
                Ok(())
            };
            match term {
                Term::One(u) => to(u, wanted, x)?,
                Term::Square(u) => {
                    let Some(upper) = checked(0.0, f64::INFINITY) else {
                        continue;
                    };
                    let square = wanted.intersection(upper);
                    if square.is_empty() {
                        return Err(Empty);
                    }
                    let root = square.sqrt();
                    // Of −root and root what may be.
                    let [low, high] = [-root, root].map(|side| side.intersection(x[u]));
                    to(u, low.convex_hull(high), x)?;
                }
                Term::Product(u, v) => {
                    for (u, v) in [(u, v), (v, u)] {
                        if !x[v].contains(0.0) {
                            to(u, wanted / x[v], x)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
