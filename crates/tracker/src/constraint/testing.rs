//! Every kind of constraint on small problems: that its equations hold in the sketch, that they are
//! regular, and that what satisfies them at t = 1 meets the constraint as people understand it.

use super::floats::Floats;
use super::frame::Frame;
use super::quadratic::{Entry, Form};
pub use crate::interval::vector::{cross, dot, length as size};
use crate::interval::{Interval, point};
use crate::places::{Each as _, array};
use crate::problem::Problem;
use nalgebra::{DMatrix, DVector};
use std::collections::HashMap;

/// Coordinates of points and values of auxiliary unknowns, by name.
pub struct Figure(HashMap<String, Vec<f64>>);

impl Figure {
    fn at(&self, name: &str) -> [f64; 3] {
        let x = &self.0[name];
        [x[0], x[1], x.get(2).copied().unwrap_or(0.0)]
    }

    /// From one point to another.
    pub fn arrow(&self, from: &str, to: &str) -> [f64; 3] {
        let (a, b) = (self.at(from), self.at(to));
        array(|k| b[k] - a[k])
    }

    /// How far apart two points are.
    pub fn distance(&self, a: &str, b: &str) -> f64 {
        size(self.arrow(a, b))
    }

    /// How far a point is from the line through two others.
    pub fn off_line(&self, p: &str, a: &str, b: &str) -> f64 {
        let (u, v) = (self.arrow(a, b), self.arrow(a, p));
        size(cross(u, v)) / size(u)
    }

    /// How far a point is from the plane through three others.
    pub fn off_plane(&self, p: &str, a: &str, b: &str, c: &str) -> f64 {
        let n = self.normal(a, b, c);
        dot(n, self.arrow(a, p)).abs() / size(n)
    }

    /// A normal of a plane.
    pub fn normal(&self, a: &str, b: &str, c: &str) -> [f64; 3] {
        cross(self.arrow(a, b), self.arrow(a, c))
    }
}

/// The angle between two vectors in degrees.
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    size(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// Reads the text of a problem.
pub fn read(text: &str) -> Problem {
    match Problem::parse(text, "test.toml") {
        Ok(problem) => problem,
        Err(error) => panic!("{error}\n{text}"),
    }
}

/// The equations hold in the sketch, in intervals.
fn holds_in_the_sketch(problem: &Problem) {
    let frame = Frame::new(problem);
    let lowered = super::try_lower(problem).unwrap();
    let value = |entry: Entry| -> Interval {
        match entry {
            Entry::Zero => point(0.0),
            Entry::Coordinate { point, axis } => {
                let at = super::frame::vector(&problem.points[point].sketch);
                frame.coordinate(&at, axis).enclose()
            }
            Entry::Unknown(u) => lowered.tail.unknowns[u].sketch,
        }
    };
    for equation in &lowered.tail.equations {
        let left = equation.products.iter().fold(point(0.0), |sum, p| {
            sum + point(0.5 * f64::from(p.factor)) * p.value(value)
        });
        let off = left - equation.right[0].enclose();
        assert!(off.contains(0.0), "{}: {off:?}", equation.name);
        assert!(off.wid() < 1e-10, "{}: {off:?}", equation.name);
        assert!(equation.right.len() <= super::MAX_DEGREE + 1);
        // Powers of the unit of length agree.
        let power = |form: Form| match form {
            Form::One => 0,
            Form::Difference(Entry::Zero, e) | Form::Difference(e, _) => match e {
                Entry::Unknown(u) => lowered.tail.unknowns[u].power,
                _ => 1,
            },
        };
        for p in &equation.products {
            assert_eq!(
                power(p.left) + power(p.right),
                equation.power,
                "{}",
                equation.name
            );
        }
    }
}

/// Newton's method at t; the smallest singular value of the last Jacobian over the largest.
fn newton(floats: &Floats, x: &mut [f64], t: f64) -> Result<f64, String> {
    let n = floats.equations();
    for _ in 0..30 {
        let rows: Vec<Vec<f64>> = (0..n).map(|e| floats.row(e, x)).collect();
        let jacobian = DMatrix::from_fn(n, n, |e, k| rows[e][floats.free[k]]);
        let residual = DVector::from_fn(n, |e, _| floats.left(e, x) - floats.right(e, t));
        let step = jacobian.clone().lu().solve(&residual).ok_or("singular")?;
        for (k, &column) in floats.free.iter().enumerate() {
            x[column] -= step[k];
        }
        if step.amax() < 1e-12 {
            let singular = jacobian.singular_values();
            return Ok(singular.min() / singular.max());
        }
    }
    Err(format!("no convergence at t = {t}"))
}

/// Follows the path from the sketch to t = 1 in many small steps.
pub fn solution(problem: &Problem) -> Figure {
    let floats = Floats::new(problem).unwrap();
    let mut x = floats.sketch.clone();
    // From a figure that is a little off, too.
    for (k, &column) in floats.free.iter().enumerate() {
        x[column] += 1e-3 * ((k * 7 + 3) as f64).sin();
    }
    let ratio = newton(&floats, &mut x, 0.0).unwrap();
    assert!(
        ratio > 1e-6,
        "{}: singular in the sketch, {ratio:e}",
        problem.name
    );
    for (a, b) in x.iter().zip(&floats.sketch) {
        assert!((a - b).abs() < 1e-9, "{}: another figure", problem.name);
    }
    const STEPS: usize = 50;
    for step in 1..=STEPS {
        let ratio = newton(&floats, &mut x, step as f64 / STEPS as f64);
        let ratio = ratio.unwrap_or_else(|error| panic!("{}: {error}", problem.name));
        assert!(ratio > 1e-7, "{}: singular, {ratio:e}", problem.name);
    }
    let mut values = HashMap::new();
    let d = problem.dimension;
    for (p, point) in problem.points.iter().enumerate() {
        values.insert(point.name.clone(), x[p * d..(p + 1) * d].to_vec());
    }
    for (u, unknown) in floats.lowered.tail.unknowns.iter().enumerate() {
        values.insert(unknown.name.clone(), vec![x[problem.points.len() * d + u]]);
    }
    Figure(values)
}

/// All that is said above of one problem; the solution, to ask what it meets.
pub fn examine(text: &str) -> Figure {
    let problem = read(text);
    assert_eq!(read(&problem.to_toml()), problem, "{}", problem.to_toml());
    problem.check().unwrap();
    holds_in_the_sketch(&problem);
    let figure = solution(&problem);
    for distance in &problem.distances {
        let [a, b] = distance.points.each(|p| problem.points[p].name.as_str());
        if let crate::problem::Target::Length(x) = &distance.target {
            near(figure.distance(a, b), x.to_f64());
        }
    }
    figure
}

/// Two numbers agree but for rounding.
#[track_caller]
pub fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-9, "{found} instead of {wanted}");
}
