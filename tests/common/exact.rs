//! Checks of solutions in exact arithmetic.

use krawl::interval::Interval;
use krawl::problem::{Decimal, Problem, Target};
use krawl::rational::Rational;
use krawl::track::Solution;
use nalgebra::{DMatrix, DVector};

pub use krawl::rational::exact;

/// The rational number with few digits as a decimal.
pub fn decimal(value: &Rational) -> Decimal {
    let ten = Rational::from_integer(10.into());
    let mut digits = value.clone();
    let mut shift = 0;
    while !digits.is_integer() {
        digits *= &ten;
        shift += 1;
        assert!(shift < 60, "{value} is no decimal");
    }
    format!("{}e-{shift}", digits.to_integer()).parse().unwrap()
}

/// The square of a target length.
pub fn squared_target(target: &Target) -> Rational {
    match target {
        Target::Length(length) => length.value() * length.value(),
        Target::SquaredLength(squared) => squared.value().clone(),
    }
}

/// All the numbers between two rational ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    pub lo: Rational,
    pub hi: Rational,
}

impl Range {
    pub fn of(x: Interval) -> Self {
        Range {
            lo: exact(x.inf()),
            hi: exact(x.sup()),
        }
    }

    pub fn times(&self, factor: &Rational) -> Self {
        let (a, b) = (&self.lo * factor, &self.hi * factor);
        if a < b {
            Range { lo: a, hi: b }
        } else {
            Range { lo: b, hi: a }
        }
    }

    pub fn contains(&self, x: &Rational) -> bool {
        self.lo <= *x && *x <= self.hi
    }

    pub fn meets(&self, other: &Range) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }

    fn minus(&self, other: &Range) -> Self {
        Range {
            lo: &self.lo - &other.hi,
            hi: &self.hi - &other.lo,
        }
    }

    fn squared(&self) -> Self {
        let (a, b) = (&self.lo * &self.lo, &self.hi * &self.hi);
        let lo = if self.contains(&Rational::zero()) {
            Rational::zero()
        } else {
            a.clone().min(b.clone())
        };
        Range { lo, hi: a.max(b) }
    }
}

/// The values of the squared distance of two points over a box.
pub fn squared_distance(points: &[[Range; 3]], a: usize, b: usize) -> Range {
    let zero = Range {
        lo: Rational::zero(),
        hi: Rational::zero(),
    };
    (0..3).fold(zero, |sum, k| {
        let square = points[a][k].minus(&points[b][k]).squared();
        Range {
            lo: sum.lo + square.lo,
            hi: sum.hi + square.hi,
        }
    })
}

/// A solution's box with exact bounds.
pub fn ranges(solution: &Solution) -> Vec<[Range; 3]> {
    let range = |p: &[Interval; 3]| p.map(Range::of);
    solution.points.iter().map(range).collect()
}

/// The places `(point, axis)` of the coordinates that the reference leaves free.
fn free_places(problem: &Problem) -> Vec<(usize, usize)> {
    let reference = &problem.homotopy.reference;
    (0..problem.points.len())
        .flat_map(|p| {
            let place = reference.iter().position(|&r| r == p);
            (0..place.unwrap_or(problem.dimension)).map(move |axis| (p, axis))
        })
        .collect()
}

/// A figure that meets the dimensions to some thirty digits, by Newton's method with exact
/// residuals from a figure in the gauge. `None` where that does not converge.
pub fn root_near(problem: &Problem, start: &[[f64; 3]]) -> Option<Vec<[Rational; 3]>> {
    let places = free_places(problem);
    let m = places.len();
    let mut figure: Vec<[Rational; 3]> = start.iter().map(|p| p.map(exact)).collect();
    let size = start.iter().flatten().fold(0.0f64, |a, x| a.max(x.abs()));
    for _ in 0..12 {
        let mut jacobian = DMatrix::<f64>::zeros(m, m);
        let mut residual = DVector::<f64>::zeros(m);
        for (e, distance) in problem.distances.iter().enumerate() {
            let [a, b] = distance.points;
            let difference: [Rational; 3] = std::array::from_fn(|k| &figure[a][k] - &figure[b][k]);
            let squared: Rational = difference.iter().map(|d| d * d).sum();
            residual[e] = (squared - squared_target(&distance.target)).to_f64();
            for (column, &(point, axis)) in places.iter().enumerate() {
                let slope = 2.0 * difference[axis].to_f64();
                if point == a {
                    jacobian[(e, column)] += slope;
                } else if point == b {
                    jacobian[(e, column)] -= slope;
                }
            }
        }
        let step = jacobian.lu().solve(&residual)?;
        for (&(point, axis), &x) in places.iter().zip(step.iter()) {
            figure[point][axis] -= Rational::from_float(x)?;
        }
        if step.amax() < 1e-30 * size {
            return Some(figure);
        }
        if step.amax() > 1e3 * size {
            return None;
        }
    }
    None
}

/// The middle of a solution's box; of a float solution, the solution.
pub fn middle(solution: &Solution) -> Vec<[f64; 3]> {
    let middle = |p: &[Interval; 3]| p.map(|x| x.mid());
    solution.points.iter().map(middle).collect()
}
