//! All equations of a problem in floats: to look at, not to prove with.

use super::lowering::{Fault, Lowered};
use super::quadratic::{Entry, Form, Product};
use super::{Owner, frame::Frame, frame::vector, try_lower};
use crate::equations::{left_side, slopes};
use crate::interval::Real;
use crate::places::Each as _;
use crate::problem::{Problem, Target};

/// Coordinates of all points (fixed ones among them), then auxiliary unknowns.
pub struct Floats<'a> {
    problem: &'a Problem,
    /// The equations beyond distances.
    pub lowered: Lowered,
    /// All values in the sketch.
    pub sketch: Vec<f64>,
    /// The columns that are free.
    pub free: Vec<usize>,
    /// For each distance the coefficients of a(t).
    lengths: Vec<[f64; 3]>,
    /// For each other equation the coefficients of its right-hand side.
    rights: Vec<Vec<f64>>,
}

impl<'a> Floats<'a> {
    /// The equations of a problem of which the names have been checked.
    pub fn new(problem: &'a Problem) -> Result<Self, (Owner, Fault)> {
        let lowered = try_lower(problem)?;
        let (d, frame) = (problem.dimension, Frame::new(problem));
        let float = |real: &Real| real.double().0.hi;
        let mut sketch = Vec::new();
        let mut free = Vec::new();
        for (index, point) in problem.points.iter().enumerate() {
            let reference = &problem.homotopy.reference;
            let fixed_from = reference.iter().position(|&r| r == index).unwrap_or(d);
            for axis in 0..d {
                if axis < fixed_from {
                    free.push(sketch.len());
                }
                sketch.push(float(&frame.coordinate(&vector(&point.sketch), axis)));
            }
        }
        for value in &lowered.values {
            free.push(sketch.len());
            sketch.push(float(value));
        }
        let lengths = problem
            .distances
            .iter()
            .enumerate()
            .map(|(index, distance)| {
                let [a, b] = distance
                    .points
                    .each(|p| problem.points[p].sketch.each_ref().each(|x| x.to_f64()));
                let start = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
                let end = match &distance.target {
                    Target::Length(x) => x.to_f64(),
                    Target::SquaredLength(x) => x.to_f64().sqrt(),
                };
                let c = match problem.bend() == Some(index) {
                    true => problem.homotopy.bend_coefficient.to_f64(),
                    false => 0.0,
                };
                [start, end - start + c, -c]
            });
        let equations = lowered.tail.equations.iter();
        Ok(Floats {
            rights: equations
                .map(|equation| equation.right.iter().map(float).collect())
                .collect(),
            lengths: lengths.collect(),
            problem,
            sketch,
            free,
            lowered,
        })
    }

    /// How many equations there are.
    pub fn equations(&self) -> usize {
        self.problem.distances.len() + self.lowered.tail.equations.len()
    }

    /// The place of an entry among the values.
    pub fn place(&self, entry: Entry) -> Option<usize> {
        match entry {
            Entry::Zero => None,
            Entry::Coordinate { point, axis } => Some(point * self.problem.dimension + axis),
            Entry::Unknown(u) => Some(self.problem.points.len() * self.problem.dimension + u),
        }
    }

    fn products(&self, equation: usize) -> Vec<Product> {
        let distances = self.problem.distances.len();
        if equation >= distances {
            return self.lowered.tail.equations[equation - distances]
                .products
                .clone();
        }
        let [a, b] = self.problem.distances[equation].points;
        (0..self.problem.dimension)
            .map(|axis| {
                let [from, to] = [a, b].each(|point| Entry::Coordinate { point, axis });
                let form = Form::Difference(from, to);
                Product::new(1, form, form)
            })
            .collect()
    }

    /// E(t) of an equation.
    pub fn right(&self, equation: usize, t: f64) -> f64 {
        let distances = self.problem.distances.len();
        let horner = |all: f64, x: f64| all * t + x;
        if equation < distances {
            let a = self.lengths[equation]
                .iter()
                .rev()
                .copied()
                .fold(0.0, horner);
            return 0.5 * a * a;
        }
        let right = &self.rights[equation - distances];
        right.iter().rev().copied().fold(0.0, horner)
    }

    fn at(&self, x: &[f64]) -> impl Fn(Entry) -> f64 {
        move |entry| self.place(entry).map_or(0.0, |k| x[k])
    }

    /// The left-hand side of an equation.
    pub fn left(&self, equation: usize, x: &[f64]) -> f64 {
        left_side(&self.products(equation), self.at(x))
    }

    /// The derivatives of an equation's left-hand side by all values, those that are fixed among them.
    pub fn row(&self, equation: usize, x: &[f64]) -> Vec<f64> {
        let mut row = vec![0.0; x.len()];
        slopes(&self.products(equation), self.at(x), |entry, slope| {
            if let Some(k) = self.place(entry) {
                row[k] += slope;
            }
        });
        row
    }
}
