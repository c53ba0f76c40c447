//! Equations of a block as sums of monomials, whole multiples of which are added so that monomials cancel exactly.

use super::newton::{KNOWN, Square};
use super::system::{Form, Product, Row};
use crate::interval::{Interval, ZERO, point};
use std::collections::BTreeMap;

/// `Σ q_ij x_i x_j + Σ b_i x_i + c = 0`, the q_ij being quarters.
#[derive(Debug, Clone)]
pub struct Expanded {
    /// Four times q_ij with i ≤ j, not zero.
    pub quadratic: BTreeMap<(usize, usize), i64>,
    /// The b_i.
    pub linear: Vec<Interval>,
    /// c.
    pub constant: Interval,
}

/// Factors of equations beyond this are not looked at.
const LARGEST: i64 = 1 << 40;

impl Expanded {
    /// A row in a block's unknowns, all other entries being known.
    pub fn new(row: &Row, square: &Square, x: &[Interval]) -> Option<Self> {
        let n = square.own.len();
        let mut out = Expanded {
            quadratic: BTreeMap::new(),
            linear: vec![ZERO; n],
            constant: -row.right,
        };
        let of = |entry: usize| match square.place[entry] {
            KNOWN => Err(x[entry]),
            k => Ok(k),
        };
        for p in &row.products {
            let quarters = 4.0 * p.factor.mid();
            let parts = p.expand(of);
            let is_whole =
                p.factor.wid() == 0.0 && quarters == quarters.round() && quarters.abs() <= 1e6;
            if !is_whole && !parts.products.is_empty() {
                return None;
            }
            for (key, sign) in parts.products {
                *out.quadratic.entry(key).or_default() += quarters as i64 * i64::from(sign);
            }
            for (k, by) in parts.linear {
                out.linear[k] += p.factor * by;
            }
            out.constant += p.factor * parts.constant;
        }
        out.quadratic.retain(|_, q| *q != 0);
        Some(out)
    }

    /// The same as a row in these unknowns. `zero`: the entry that is the number 0.
    pub fn row(&self, own: &[usize], zero: usize) -> Row {
        let value = |k: usize| Form::Difference(own[k], zero);
        let quadratic = self.quadratic.iter().map(|(&(i, j), &q)| Product {
            factor: point(0.25 * q as f64),
            left: value(i),
            right: value(j),
        });
        let linear = self.linear.iter().enumerate();
        let linear = linear.filter(|(_, b)| **b != ZERO);
        let linear = linear.map(|(k, &b)| Product {
            factor: b,
            left: value(k),
            right: Form::One,
        });
        Row::new(quadratic.chain(linear).collect(), -self.constant, zero)
    }

    /// `by` times this less `times` times another.
    pub fn less(&self, by: i64, other: &Self, times: i64) -> Option<Self> {
        let mut quadratic = BTreeMap::new();
        for (&key, &q) in &self.quadratic {
            *quadratic.entry(key).or_insert(0i64) += by.checked_mul(q)?;
        }
        for (&key, &q) in &other.quadratic {
            let all = quadratic.entry(key).or_insert(0i64);
            *all = all.checked_sub(times.checked_mul(q)?)?;
        }
        quadratic.retain(|_, q| *q != 0);
        if quadratic.values().any(|q| q.abs() > LARGEST) || by.abs().max(times.abs()) > LARGEST {
            return None;
        }
        let (by, times) = (point(by as f64), point(times as f64));
        let pairs = self.linear.iter().zip(&other.linear);
        Some(Expanded {
            quadratic,
            linear: pairs.map(|(a, b)| by * *a - times * *b).collect(),
            constant: by * self.constant - times * other.constant,
        })
    }
}
