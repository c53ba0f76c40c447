//! The equations of a block together: what their linear combinations leave of a box, and Krawczyk's test.

use super::system::Row;
use crate::certificate::cover::alone;
use crate::certificate::cover::coordinates::Empty;
use crate::elimination::invert;
use crate::interval::rounding::{largest, round_up};
use crate::interval::{Interval, ZERO, around, point};
use crate::linalg::{decomposed, nearest_zero};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// A block: as many equations as unknowns, all other entries being known.
#[derive(Debug, Clone)]
pub struct Square<'a> {
    /// The equations.
    pub rows: Vec<&'a Row>,
    /// The unknowns, entries of the system.
    pub own: Vec<usize>,
    /// For each entry its place among the unknowns, or [`KNOWN`].
    pub place: Vec<usize>,
    /// Whether numbers are anywhere in ranges: a zero's box is then as wide as they make it, and nearly as wide as where it is alone.
    pub has_ranges: bool,
}

/// An entry that is no unknown of the block.
pub const KNOWN: usize = usize::MAX;

/// A zero of a block.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Zero {
    /// The middle of its box, unknown by unknown.
    pub centre: Vec<f64>,
    /// How far the exact zero may be from it in each unknown.
    pub radius: f64,
    /// No other zero is within this of the middle in every unknown.
    pub alone: f64,
    /// Where numbers are anywhere in ranges: the unit that both are in, unknown by unknown. Otherwise none: all are in the same.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scale: Vec<f64>,
}

impl Square<'_> {
    fn size(&self) -> usize {
        self.own.len()
    }

    /// The entries of the Jacobian at numbers, row by row.
    fn jacobian(&self, at: &[f64]) -> Vec<f64> {
        let n = self.size();
        let mut out = vec![0.0; n * n];
        for (e, row) in self.rows.iter().enumerate() {
            row.slopes(at, |entry, slope| {
                if self.place[entry] != KNOWN {
                    out[e * n + self.place[entry]] += slope;
                }
            });
        }
        out
    }

    /// About its inverse; `None`: there is none.
    fn inverse(&self, at: &[f64]) -> Option<Vec<f64>> {
        let mut y = self.jacobian(at);
        let is_regular = invert(&mut y, self.size()) && y.iter().all(|x| x.is_finite());
        is_regular.then_some(y)
    }

    /// The Jacobian in intervals, row by row.
    pub(super) fn derivatives(&self, at: &[Interval]) -> Vec<Interval> {
        let n = self.size();
        let mut out = vec![ZERO; n * n];
        for (e, row) in self.rows.iter().enumerate() {
            row.derivatives(at, |entry, slope| {
                if self.place[entry] != KNOWN {
                    out[e * n + self.place[entry]] += slope;
                }
            });
        }
        out
    }

    /// The box with its unknowns replaced.
    pub(super) fn with(&self, x: &[Interval], own: impl Fn(usize) -> Interval) -> Vec<Interval> {
        let mut at = x.to_vec();
        for (k, &u) in self.own.iter().enumerate() {
            at[u] = own(k);
        }
        at
    }

    /// The middles of the entries, those of the unknowns replaced.
    fn floats(&self, x: &[Interval], own: &[f64]) -> Vec<f64> {
        let mut at: Vec<f64> = x.iter().map(|x| x.mid()).collect();
        for (&u, &value) in self.own.iter().zip(own) {
            at[u] = value;
        }
        at
    }

    /// Newton's step in a bounded box: the equations are quadratic, so that F(x) = F(c) + J((x + c)/2)(x − c) exactly, and
    /// with any matrix Y the sum Y F(x) is 0 at a zero: each of its lines is solved for one unknown. What comes
    /// back is ‖I − Y S‖, with S for J over the box, or infinity where there is no Y.
    pub fn step(&self, x: &mut [Interval]) -> Result<f64, Empty> {
        let n = self.size();
        let middle: Vec<f64> = self.own.iter().map(|&u| x[u].mid()).collect();
        let near = self.floats(x, &middle);
        let Some(y) = self.inverse(&near) else {
            return Ok(f64::INFINITY);
        };
        let at = self.with(x, |k| point(middle[k]));
        let f: Vec<Interval> = self.rows.iter().map(|row| row.value(&at)).collect();
        let half = point(0.5);
        let between = self.with(x, |k| (x[self.own[k]] + point(middle[k])) * half);
        let slopes = self.derivatives(&between);
        // Most of them are 0.
        let row = |row: &[Interval]| {
            let entries = row.iter().copied().enumerate();
            entries.filter(|(_, slope)| *slope != ZERO).collect()
        };
        let slopes: Vec<Vec<(usize, Interval)>> = slopes.chunks(n).map(row).collect();
        let mut defect: f64 = 0.0;
        let mut line = vec![ZERO; n];
        for i in 0..n {
            line.fill(ZERO);
            let mut constant = ZERO;
            for e in 0..n {
                let by = y[i * n + e];
                if by == 0.0 {
                    continue;
                }
                let by = point(by);
                constant += by * f[e];
                for &(j, slope) in &slopes[e] {
                    line[j] += by * slope;
                }
            }
            let off: f64 = (0..n)
                .map(|j| (point(if i == j { 1.0 } else { 0.0 }) - line[j]).mag())
                .sum();
            defect = largest(defect, off);
            if line[i].contains(0.0) {
                continue;
            }
            let rest = (0..n).filter(|&j| j != i).fold(constant, |sum, j| {
                sum + line[j] * (x[self.own[j]] - point(middle[j]))
            });
            let u = self.own[i];
            let new = x[u].intersection(point(middle[i]) - rest / line[i]);
            if new.is_empty() {
                return Err(Empty);
            }
            x[u] = new;
        }
        Ok(defect)
    }

    /// Newton's method from the middle of a box, then the test that [`alone`] ends, for all values that the known entries may have in
    /// theirs. `None`: no zero was proved.
    pub fn prove(&self, x: &[Interval]) -> Option<Zero> {
        let n = self.size();
        let mut own: Vec<f64> = self.own.iter().map(|&u| x[u].mid()).collect();
        let mut last = f64::INFINITY;
        for _ in 0..30 {
            let at = self.floats(x, &own);
            let y = self.inverse(&at)?;
            let f: Vec<f64> = self.rows.iter().map(|row| row.nearly(&at)).collect();
            let mut size: f64 = 0.0;
            for i in 0..n {
                let step: f64 = (0..n).map(|e| y[i * n + e] * f[e]).sum();
                own[i] -= step;
                size = largest(size, step.abs());
            }
            if !size.is_finite() || own.iter().any(|x| !(x.abs() < 1e15)) {
                return None;
            }
            let done = size < 1e-15 || (size >= 0.5 * last && size < 1e-9);
            last = size;
            if done {
                break;
            }
        }
        if !(last < 1e-6) {
            return None;
        }
        let y = self.inverse(&self.floats(x, &own))?;
        match self.has_ranges {
            true => self.test_in_ranges(x, own, &y),
            false => self.test(x, own, &y),
        }
    }

    fn test(&self, x: &[Interval], own: Vec<f64>, y: &[f64]) -> Option<Zero> {
        let n = self.size();
        let at = self.with(x, |k| point(own[k]));
        let f: Vec<Interval> = self.rows.iter().map(|row| row.value(&at)).collect();
        let jacobian = self.derivatives(&at);
        // How much |w| = 1 changes the entries of each row of J, added up.
        let changes: Vec<f64> = self
            .rows
            .iter()
            .map(|row| {
                let free = |form: super::system::Form| {
                    let entries = form.entries();
                    entries.filter(|(e, _)| self.place[*e] != KNOWN).count() as f64
                };
                let products = row.products.iter();
                let change: f64 = products
                    .map(|p| 2.0 * p.factor.mag() * free(p.left) * free(p.right))
                    .sum();
                round_up(change, row.products.len() + 4)
            })
            .collect();
        let (mut q0, mut kappa, mut step): (f64, f64, f64) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let (mut off, mut change, mut moved) = (ZERO, ZERO, ZERO);
            for e in 0..n {
                let by = point(y[i * n + e]);
                change += point(by.mag()) * point(changes[e]);
                moved += by * f[e];
            }
            for j in 0..n {
                let start = point(if i == j { 1.0 } else { 0.0 });
                let entry = (0..n).fold(start, |sum, e| {
                    sum - point(y[i * n + e]) * jacobian[e * n + j]
                });
                off += entry.abs();
            }
            q0 = largest(q0, off.sup());
            kappa = largest(kappa, change.sup());
            step = largest(step, moved.mag());
        }
        let [radius, alone] = alone([q0, kappa, step], 1e30)?;
        Some(Zero {
            centre: own,
            radius,
            alone,
            scale: Vec::new(),
        })
    }

    /// A zero that equations proved that have all their zeros in common with these, as a zero of these.
    pub fn again(&self, zero: &Zero, x: &[Interval]) -> Option<Zero> {
        let x = self.with(x, |k| zero.range(k));
        self.prove(&x).filter(|again| self.is_alone(again, &x))
    }

    /// Whether the ranges of all its unknowns are bounded.
    pub fn is_bounded(&self, x: &[Interval]) -> bool {
        self.own.iter().all(|&u| x[u].is_common_interval())
    }

    /// Whether a zero is the only one that the box may hold: all of the box lies where it is alone.
    pub fn is_alone(&self, zero: &Zero, x: &[Interval]) -> bool {
        let mut own = self.own.iter().enumerate();
        own.all(|(k, &u)| (x[u] - point(zero.centre[k])).mag() < zero.alone_in(k))
    }

    /// A direction in which a curve of zeros goes on from near the middle of a box, as floats see it: Newton's method with a
    /// pseudoinverse comes to a zero where the Jacobian is singular, and from a place aside in the direction of
    /// its kernel to another one, much nearer to that place than to the first zero. That is no proof of anything. The zero found, unknown by
    /// unknown.
    pub fn on_a_curve(&self, x: &[Interval]) -> Option<Vec<f64>> {
        /// Unknowns up to this are left in their units.
        const LARGE: f64 = 100.0;
        let n = self.size();
        let middle: Vec<f64> = self.own.iter().map(|&u| x[u].mid()).collect();
        if !middle.iter().all(|x| x.abs() < 1e15) {
            return None;
        }
        // Unknowns, such as powers, may be much larger than others: each is told in a unit of its own, and the largest slope of a row is 1.
        let units: Vec<f64> = middle.iter().map(|x| (x.abs() / LARGE).max(1.0)).collect();
        let linearise = |scaled: &[f64]| {
            let own: Vec<f64> = scaled
                .iter()
                .zip(&units)
                .map(|(x, unit)| x * unit)
                .collect();
            let at = self.floats(x, &own);
            let mut jacobian = DMatrix::from_row_slice(n, n, &self.jacobian(&at));
            let mut values = DVector::from_iterator(n, self.rows.iter().map(|row| row.nearly(&at)));
            for (mut column, unit) in jacobian.column_iter_mut().zip(&units) {
                column *= *unit;
            }
            for (mut row, value) in jacobian.row_iter_mut().zip(values.iter_mut()) {
                let over = 1.0 / row.amax().max(1.0);
                row *= over;
                *value *= over;
            }
            (jacobian, values)
        };
        let to_zero = |from| nearest_zero(from, 1e-7, &linearise);
        let scaled = middle.iter().zip(&units).map(|(x, unit)| x / unit);
        let zero = to_zero(scaled.collect())?;
        let svd = decomposed(linearise(&zero).0, [false, true]);
        let v = svd.v_t?;
        let greatest = svd.singular_values.max();
        let kernel = (0..n).filter(|&k| svd.singular_values[k] < 1e-7 * greatest);
        let mut kernel = kernel.collect::<Vec<_>>().into_iter();
        let goes_on = kernel.any(|k| {
            const ASIDE: f64 = 1e-2;
            let aside: Vec<f64> = (0..n).map(|i| zero[i] + ASIDE * v[(k, i)]).collect();
            let Some(there) = to_zero(aside.clone()) else {
                return false;
            };
            let distance = |a: &[f64], b: &[f64]| {
                let pairs = a.iter().zip(b);
                pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            };
            distance(&there, &aside) < 0.1 * ASIDE && distance(&there, &zero) > 0.5 * ASIDE
        });
        goes_on.then(|| zero.iter().zip(&units).map(|(x, unit)| x * unit).collect())
    }
}

impl Zero {
    /// The range of an unknown.
    pub fn range(&self, k: usize) -> Interval {
        around(self.centre[k], self.radius_in(k))
    }

    fn radius_in(&self, k: usize) -> f64 {
        let scaled = |s: &f64| round_up(self.radius * s, 2);
        self.scale.get(k).map_or(self.radius, scaled)
    }

    fn alone_in(&self, k: usize) -> f64 {
        let scaled = |s: &f64| (point(self.alone) * point(*s)).inf();
        self.scale.get(k).map_or(self.alone, scaled)
    }

    /// An order that does not depend on who found them: by their middles, unknown by unknown.
    pub fn order(&self, other: &Zero) -> Ordering {
        let pairs = self.centre.iter().zip(&other.centre);
        let mut order = pairs.map(|(x, y)| x.total_cmp(y));
        order.find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
    }

    /// Whether both are the same zero: the box of one lies where the other is alone.
    pub fn is_same(&self, other: &Zero) -> bool {
        let off = |k: usize| (self.centre[k] - other.centre[k]).abs();
        let is_in = |one: &Zero, other: &Zero| {
            (0..one.centre.len())
                .all(|k| round_up(off(k) + one.radius_in(k), 4) < other.alone_in(k))
        };
        is_in(self, other) || is_in(other, self)
    }
}
