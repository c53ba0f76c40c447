//! What an equation in merged unknowns says: its value, and its derivatives.

use super::Row;
use crate::constraint::{Entry, Form, Product};
use crate::equations::{Halved, left_side, slopes};
use crate::map::Map;

impl Row {
    /// Its left-hand side where unknowns have these values.
    pub(crate) fn over<T: Halved>(&self, at: impl Fn(usize) -> T) -> T {
        left_side(&self.products, |entry: Option<usize>| {
            entry.map_or(T::whole(0), &at)
        })
    }

    /// The derivatives of its left-hand side, those of one unknown to be added.
    pub(crate) fn derivatives<T: Halved>(
        &self,
        at: impl Fn(usize) -> T,
        mut tell: impl FnMut(usize, T),
    ) {
        let value = |entry: Option<usize>| entry.map_or(T::whole(0), &at);
        slopes(&self.products, value, |entry, slope| {
            entry.into_iter().for_each(|u| tell(u, slope.clone()));
        });
    }

    /// The second derivatives of its left-hand side, as many halves of 1, those of two unknowns to be added.
    pub(crate) fn bends(&self, mut tell: impl FnMut([usize; 2], i32)) {
        for p in &self.products {
            for (a, f) in p.left.entries() {
                for (b, g) in p.right.entries() {
                    if let (Some(a), Some(b)) = (a, b) {
                        tell([a, b], p.factor * f * g);
                        tell([b, a], p.factor * f * g);
                    }
                }
            }
        }
    }

    /// The products of its derivative by an unknown, times `by`.
    pub(crate) fn derived(
        &self,
        u: usize,
        by: Form,
        entry: impl Fn(Option<usize>) -> Entry,
    ) -> Vec<Product> {
        let mut out = Vec::new();
        for p in &self.products {
            for (this, other) in [(p.left, p.right), (p.right, p.left)] {
                let own = this.entries().filter(|(entry, _)| *entry == Some(u));
                for (_, sign) in own {
                    out.push(Product::new(p.factor * sign, by, other.map(&entry)));
                }
            }
        }
        out
    }

    /// The value of its left-hand side at a place, and its derivatives, those of one unknown to be added.
    pub(crate) fn evaluate(&self, at: &[f64], slope: impl FnMut(usize, f64)) -> f64 {
        self.derivatives(|u| at[u], slope);
        self.over(|u| at[u])
    }

    /// The largest derivative of the left-hand side at a place, and the length of its gradient.
    pub(crate) fn steepness(&self, at: &[f64]) -> (f64, f64) {
        let mut slopes = Vec::new();
        self.evaluate(at, |u, slope| slopes.push((u, slope)));
        let slopes = Map::sums(slopes);
        let slopes = slopes.iter().map(|(_, slope)| slope);
        let steepest = slopes.clone().fold(0.0, |max: f64, s| max.max(s.abs()));
        let squares: f64 = slopes.map(|slope| slope * slope).sum();
        let least = f64::MIN_POSITIVE;
        (steepest.max(least), squares.sqrt().max(least))
    }
}
