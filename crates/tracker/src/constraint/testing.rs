//! Every kind of constraint on small problems: that its equations hold in the sketch, that they are
//! regular, and that what satisfies them at t = 1 meets the constraint as people understand it.

use super::frame::Frame;
use super::quadratic::{Entry, Form};
use crate::equations::{left_side, slopes};
pub use crate::interval::vector::{cross, dot, length as size};
use crate::interval::{Interval, point};
use crate::places::{Each as _, array};
use crate::problem::Problem;
use crate::system::Homotopy;
use nalgebra::{DMatrix, DVector};
use std::collections::HashMap;

/// Coordinates of points, by name.
pub struct Figure(HashMap<String, [f64; 3]>);

impl Figure {
    /// From one point to another.
    pub fn arrow(&self, from: &str, to: &str) -> [f64; 3] {
        let (a, b) = (self.0[from], self.0[to]);
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
fn newton(homotopy: &Homotopy, x: &mut [f64], t: f64) -> Result<f64, String> {
    let n = homotopy.equations;
    for _ in 0..30 {
        let at = |entry: Option<usize>| entry.map_or(0.0, |i| x[i]);
        let (mut jacobian, mut residual) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for e in 0..n {
            let terms = homotopy.terms(e);
            residual[e] = left_side(&terms, at) - homotopy.rights[e].enclose(point(t)).mid();
            slopes(&terms, at, |entry, slope| {
                entry.into_iter().for_each(|i| jacobian[(e, i)] += slope);
            });
        }
        let step = jacobian.clone().lu().solve(&residual).ok_or("singular")?;
        for (x, step) in x.iter_mut().zip(&step) {
            *x -= step;
        }
        if step.amax() < 1e-12 {
            let singular = jacobian.singular_values();
            return Ok(singular.min() / singular.max());
        }
    }
    Err(format!("no convergence at t = {t}"))
}

/// Follows the path from the sketch to t = 1 in many small steps.
fn solution(problem: &Problem) -> Figure {
    let homotopy = Homotopy::with_unit(problem, 1.0).unwrap();
    let sketch: Vec<f64> = homotopy.sketch_of_unknowns().map(|x| x.mid()).collect();
    let mut x = sketch.clone();
    // From a figure that is a little off, too.
    for (k, x) in x.iter_mut().enumerate() {
        *x += 1e-3 * ((k * 7 + 3) as f64).sin();
    }
    let ratio = newton(&homotopy, &mut x, 0.0).unwrap();
    assert!(
        ratio > 1e-6,
        "{}: singular in the sketch, {ratio:e}",
        problem.name
    );
    for (a, b) in x.iter().zip(&sketch) {
        assert!((a - b).abs() < 1e-9, "{}: another figure", problem.name);
    }
    const STEPS: usize = 50;
    for step in 1..=STEPS {
        let ratio = newton(&homotopy, &mut x, step as f64 / STEPS as f64);
        let ratio = ratio.unwrap_or_else(|error| panic!("{}: {error}", problem.name));
        assert!(ratio > 1e-7, "{}: singular, {ratio:e}", problem.name);
    }
    let points = problem.points.iter().enumerate();
    let places = points.map(|(p, point)| (point.name.clone(), homotopy.place(p, |i| x[i])));
    Figure(places.collect())
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
