//! Equations of a block as sums of monomials, whole multiples of which are added so that monomials cancel exactly.

use super::newton::{KNOWN, Square};
use super::system::{Form, Product, Row};
use crate::equations::Ring;
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
        let side = |form: Form| -> (Vec<(usize, i64)>, Interval) {
            let mut unknowns = Vec::new();
            let mut constant = match form {
                Form::One => point(1.0),
                Form::Difference(..) => ZERO,
            };
            for (entry, sign) in form.entries() {
                match square.place[entry] {
                    KNOWN => constant += Interval::whole(sign) * x[entry],
                    k => unknowns.push((k, sign.into())),
                }
            }
            (unknowns, constant)
        };
        for p in &row.products {
            let quarters = 4.0 * p.factor.mid();
            let (left, right) = (side(p.left), side(p.right));
            let is_whole =
                p.factor.wid() == 0.0 && quarters == quarters.round() && quarters.abs() <= 1e6;
            if !is_whole && !left.0.is_empty() && !right.0.is_empty() {
                return None;
            }
            for &(i, f) in &left.0 {
                for &(j, g) in &right.0 {
                    *out.quadratic.entry((i.min(j), i.max(j))).or_default() +=
                        quarters as i64 * f * g;
                }
            }
            for (one, other) in [(&left, &right), (&right, &left)] {
                for &(i, f) in &one.0 {
                    out.linear[i] += p.factor * point(f as f64) * other.1;
                }
            }
            out.constant += p.factor * left.1 * right.1;
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
