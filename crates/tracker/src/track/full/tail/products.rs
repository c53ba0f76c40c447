//! Products of forms, added up for four equations at a time.
//!
//! Vectors over all equations come in lanes. Where equations of a lane have products, these are *slots*: in one
//! slot each of the four equations has one product, or zero times the number 1. An equation's sum is then
//! a lane's, whatever forms its products are of.

use super::super::MAX_ORDER;
use super::Tail;
use crate::linalg::{LANE, Vector};
use crate::places::{Each as _, array};

/// Four numbers, one for each equation of a lane.
type Lane = [f64; LANE];

/// The tail's products in slots.
#[derive(Debug, Clone, Default)]
pub(super) struct Slots {
    lanes: Vec<Products>,
    /// The forms of each slot's products, and half the factors, which are exact.
    left: Vec<[u32; LANE]>,
    right: Vec<[u32; LANE]>,
    half: Vec<Lane>,
}

/// The products of the equations in one lane.
#[derive(Debug, Clone)]
struct Products {
    /// The lane's first equation.
    first: usize,
    /// Its slots.
    slots: std::ops::Range<usize>,
}

impl Slots {
    /// From the products of each equation: their forms, and half their factors.
    pub fn new(equations: usize, products: impl Fn(usize) -> Vec<(f64, [usize; 2])>) -> Self {
        let mut out = Slots::default();
        for first in (0..equations).step_by(LANE) {
            let of_lane: Vec<_> = (first..equations.min(first + LANE))
                .map(&products)
                .collect();
            let longest = of_lane.iter().map(Vec::len).max().unwrap_or(0);
            if longest == 0 {
                continue;
            }
            let begin = out.half.len();
            for slot in 0..longest {
                let (mut left, mut right) = ([Tail::ONE as u32; LANE], [Tail::ONE as u32; LANE]);
                let mut half = [0.0; LANE];
                for (i, products) in of_lane.iter().enumerate() {
                    if let Some(&(factor, [l, r])) = products.get(slot) {
                        (left[i], right[i], half[i]) = (l as u32, r as u32, factor);
                    }
                }
                out.left.push(left);
                out.right.push(right);
                out.half.push(half);
            }
            let slots = begin..out.half.len();
            out.lanes.push(Products { first, slots });
        }
        out
    }
}

/// The values of all forms, and those of either factor of each product, in slots.
#[derive(Debug, Clone)]
pub struct Forms {
    values: Vector,
    left: Vec<Lane>,
    /// Times half the product's factor.
    right: Vec<Lane>,
}

impl Forms {
    /// Room for the forms of a tail.
    pub fn new(tail: &Tail) -> Self {
        let lanes = || vec![[0.0; LANE]; tail.slots.half.len()];
        Forms {
            values: Vector::zeros(tail.forms()),
            left: lanes(),
            right: lanes(),
        }
    }

    /// Sets all of them.
    #[inline(always)]
    pub fn set(&mut self, tail: &Tail, value: impl Fn(usize) -> f64) {
        for (form, out) in self.values.iter_mut().enumerate() {
            *out = value(form);
        }
        self.spread(tail);
    }

    /// Sets all of them, four at a time.
    #[inline(always)]
    pub fn set_lanes(&mut self, tail: &Tail, value: impl Fn(usize) -> Lane) {
        for (lane, out) in self.values.lanes_mut().iter_mut().enumerate() {
            *out = value(lane);
        }
        self.spread(tail);
    }

    /// Their values in lanes.
    pub fn lanes(&self) -> &[Lane] {
        self.values.lanes()
    }

    /// Takes the factors of products from the values.
    fn spread(&mut self, tail: &Tail) {
        let slots = &tail.slots;
        let values = &self.values[..];
        for (left, forms) in self.left.iter_mut().zip(&slots.left) {
            *left = forms.each(|form| values[form as usize]);
        }
        let halves = slots.right.iter().zip(&slots.half);
        for (right, (forms, half)) in self.right.iter_mut().zip(halves) {
            let of_slot = forms.each(|form| values[form as usize]);
            *right = array(|i| half[i] * of_slot[i]);
        }
    }

    /// The products of this and other forms in some slots, added to `sum`.
    #[inline(always)]
    fn times(&self, other: &Self, slots: std::ops::Range<usize>, mut sum: Lane) -> Lane {
        let pairs = self.left[slots.clone()].iter().zip(&other.right[slots]);
        for (left, right) in pairs {
            for i in 0..LANE {
                sum[i] = left[i].mul_add(right[i], sum[i]);
            }
        }
        sum
    }

    /// The absolute values of the products of this and other forms in some slots, added to `sum`.
    #[inline(always)]
    fn times_abs(&self, other: &Self, slots: std::ops::Range<usize>, mut sum: Lane) -> Lane {
        let pairs = self.left[slots.clone()].iter().zip(&other.right[slots]);
        for (left, right) in pairs {
            for i in 0..LANE {
                sum[i] += (left[i] * right[i]).abs();
            }
        }
        sum
    }
}

impl std::ops::Deref for Forms {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values
    }
}

impl Tail {
    /// The forms of a point, or of a direction, along which the number 1 does not change: `one` is 0 then.
    #[inline(always)]
    pub fn differences(&self, v: &[f64], one: f64, out: &mut Forms) {
        for (&[i, j], out) in self.ends.iter().zip(out.values.iter_mut()) {
            *out = v[i as usize] - v[j as usize];
        }
        out.values[Self::ONE] = one;
        out.spread(self);
    }

    /// For each form z_i − z_j the sum z_i + z_j in its place, and zero for the number 1.
    pub fn sums(&self, z: &[f64], out: &mut Forms) {
        for (&[i, j], out) in self.ends.iter().zip(out.values.iter_mut()) {
            *out = z[i as usize] + z[j as usize];
        }
        out.spread(self);
    }

    /// Adds what each lane of equations has, told from its slots.
    ///
    /// Fewer roundings than [`Equations::roundings`](super::super::Equations::roundings) has counts for: a product is
    /// added to those before it with one rounding, and the sum to what is there with one more.
    #[inline(always)]
    fn add(&self, value: impl Fn(std::ops::Range<usize>) -> Lane, out: &mut [f64]) {
        for products in &self.slots.lanes {
            let sum = value(products.slots.clone());
            let out = &mut out[products.first..];
            match out.first_chunk_mut::<LANE>() {
                Some(out) => (0..LANE).for_each(|i| out[i] += sum[i]),
                None => out.iter_mut().zip(sum).for_each(|(out, sum)| *out += sum),
            }
        }
    }

    /// Adds `Σ half · x_left · x_right` to the equations.
    pub fn add_squares(&self, x: &Forms, out: &mut [f64]) {
        self.add(|slots| x.times(x, slots, [0.0; LANE]), out);
    }

    /// Adds `factor · Σ half · (x_left · y_right + y_left · x_right)`, factor being 1 or −1: J y at x.
    pub fn add_products(&self, factor: f64, x: &Forms, y: &Forms, out: &mut [f64]) {
        let value = |slots: std::ops::Range<usize>| {
            let sum = x.times(y, slots.clone(), [0.0; LANE]);
            y.times(x, slots, sum).each(|sum| factor * sum)
        };
        self.add(value, out);
    }

    /// Adds the coefficient of sᵏ, from products of orders from `least` on, of all forms being polynomials in s of
    /// degree `order`.
    pub fn add_coefficient<'a>(
        &self,
        k: usize,
        least: usize,
        order: usize,
        forms: impl Fn(usize) -> &'a Forms,
        out: &mut [f64],
    ) {
        // What is multiplied with what: each order with its other one.
        let mut pairs: [(&[Lane], &[Lane]); MAX_ORDER + 1] = [(&[], &[]); MAX_ORDER + 1];
        let mut count = 0;
        for a in least.max(k.saturating_sub(order))..=k / 2 {
            let (x, y) = (forms(a), forms(k - a));
            pairs[count] = (&x.left, &y.right);
            count += 1;
            if 2 * a != k {
                pairs[count] = (&y.left, &x.right);
                count += 1;
            }
        }
        let pairs = &pairs[..count];
        let value = |slots: std::ops::Range<usize>| {
            let mut sum = [0.0; LANE];
            for slot in slots {
                for (left, right) in pairs {
                    let (left, right) = (&left[slot], &right[slot]);
                    for i in 0..LANE {
                        sum[i] = left[i].mul_add(right[i], sum[i]);
                    }
                }
            }
            sum
        };
        self.add(value, out);
    }

    /// Adds `factor · Σ |half| |x_left| |x_right|`.
    pub fn add_squares_abs(&self, factor: f64, x: &Forms, out: &mut [f64]) {
        let value = |slots| x.times_abs(x, slots, [0.0; LANE]).each(|sum| factor * sum);
        self.add(value, out);
    }

    /// Adds `factor · Σ |half| (|x_left| |y_right| + |y_left| |x_right|)`.
    pub fn add_products_abs(&self, factor: f64, x: &Forms, y: &Forms, out: &mut [f64]) {
        let value = |slots: std::ops::Range<usize>| {
            let sum = x.times_abs(y, slots.clone(), [0.0; LANE]);
            y.times_abs(x, slots, sum).each(|sum| factor * sum)
        };
        self.add(value, out);
    }
}

#[cfg(test)]
impl Slots {
    /// Multiplies the coefficient of an equation's k-th product.
    pub fn spoil(&mut self, equation: usize, k: usize, by: f64) {
        let lane = self
            .lanes
            .iter()
            .find(|lane| lane.first == equation - equation % LANE);
        if let Some(lane) = lane
            && k < lane.slots.len()
        {
            self.half[lane.slots.start + k][equation % LANE] *= by;
        }
    }
}
