//! The equations of distances between complex points, and proofs of figures that satisfy them.

use super::zero::{Quadratic, Z, Zero};
use crate::equations::Form;
use crate::interval::complex::Complex;
use crate::interval::{DoubleDouble, Interval, point};
use crate::problem::Problem;
use crate::rational::Rational;
use crate::system::Term;

/// The equations |p − q|² = d², where coordinates that the fixed points do not have are zero.
#[derive(Debug)]
pub struct Equations {
    dimension: usize,
    /// For each point the unknowns that are its coordinates.
    places: Vec<Vec<Option<usize>>>,
    system: Quadratic,
    /// The unknowns that are to be positive: the second fixed point's x, the third one's y.
    positive: Vec<usize>,
    /// For each unknown whether its sign is changed: by nothing, and by reflection in the fixed points' line or plane.
    pub changes: [Vec<bool>; 2],
    /// For each unknown whether it is a first coordinate.
    is_first: Vec<bool>,
}

/// Numbers from a file: real and imaginary part, perhaps with what these leave; `None`: there are not two or four of them.
pub fn number(parts: &[f64]) -> Option<Z> {
    match *parts {
        [re, im] => Some(Complex::new(re.into(), im.into())),
        [re, im, a, b] => Some(Complex::new(
            DoubleDouble::sum(re, a),
            DoubleDouble::sum(im, b),
        )),
        _ => None,
    }
}

impl Equations {
    /// For a problem of distances. Fails where the fixed points are not joined, or are in line.
    pub fn new(problem: &Problem, fixed: &[usize]) -> Result<Self, String> {
        let (d, n) = (problem.dimension, problem.points.len());
        if !problem.is_distances_only() {
            return Err("there are other constraints than distances".to_owned());
        }
        let between = |a: usize, b: usize| {
            let joins = |x: &&crate::problem::Distance| x.points == [a, b] || x.points == [b, a];
            let found = problem.distances.iter().find(joins);
            found
                .map(|x| x.target.squared())
                .ok_or_else(|| "the fixed points are not joined by distances".to_owned())
        };
        match (d, fixed) {
            (2, &[a, b]) => drop(between(a, b)?),
            (3, &[a, b, c]) => {
                let (u, v, w) = (between(a, b)?, between(a, c)?, between(b, c)?);
                let twice = &u + &v - w;
                // Sixteen times the squared area. Otherwise the triangle has no proper place, or none with real coordinates.
                let area = Rational::from_integer(4.into()) * u * v - &twice * &twice;
                if !area.is_positive() {
                    return Err("the fixed points are in line".to_owned());
                }
            }
            _ => return Err(format!("{d} points have to be fixed")),
        }
        // Points that are free come first, so that the first unknown tells most figures apart.
        let mut places = vec![vec![None; d]; n];
        let (mut is_last, mut is_first) = (Vec::new(), Vec::new());
        let mut place = |p: usize, axes: usize| {
            for (axis, place) in places[p].iter_mut().enumerate().take(axes) {
                *place = Some(is_last.len());
                is_last.push(axis + 1 == d);
                is_first.push(axis == 0);
            }
            is_last.len()
        };
        let mut free = 0;
        for p in (0..n).filter(|p| !fixed.contains(p)) {
            free = place(p, d);
        }
        // The last coordinate of each fixed point is one of two opposite numbers.
        let (mut unknowns, mut positive) = (free, Vec::new());
        for (rank, &p) in fixed.iter().enumerate().skip(1) {
            unknowns = place(p, rank);
            positive.push(unknowns - 1);
        }
        if problem.distances.len() != unknowns {
            return Err(format!(
                "there are {} distances for {unknowns} coordinates",
                problem.distances.len()
            ));
        }
        let equation = |distance: &crate::problem::Distance| {
            let term = |axis: usize| {
                let [a, b] = distance.points.map(|p| places[p][axis]);
                let form = Form::Difference(a, b);
                Term::new(2, form, form)
            };
            ((0..d).map(term).collect(), distance.target.squared())
        };
        Ok(Equations {
            dimension: d,
            system: Quadratic::new(unknowns, problem.distances.iter().map(equation).collect()),
            positive,
            places,
            changes: [vec![false; unknowns], is_last],
            is_first,
        })
    }

    /// Proves that there is exactly one solution near these places (point by point), and that the fixed points are where they
    /// are said to be, not mirrored.
    pub fn prove(&self, places: &[Vec<Vec<f64>>]) -> Option<Zero> {
        let fits = places.len() == self.places.len()
            && places.iter().all(|place| place.len() == self.dimension);
        if !fits {
            return None;
        }
        let mut near = vec![Z::default(); self.is_first.len()];
        for (place, unknowns) in places.iter().zip(&self.places) {
            for (parts, unknown) in place.iter().zip(unknowns) {
                let number = number(parts)?;
                match *unknown {
                    Some(unknown) => near[unknown] = number,
                    // Where fixed points stand these coordinates are zero.
                    None if parts.iter().any(|&part| part != 0.0) => return None,
                    None => {}
                }
            }
        }
        let zero = self.system.prove(&near)?;
        let is_positive = |&unknown: &usize| zero.part(unknown)[0].inf() > 0.0;
        self.positive.iter().all(is_positive).then_some(zero)
    }

    /// Whether a figure is its own mirror image, which is a solution, too.
    pub fn is_its_own_mirror_image(&self, zero: &Zero) -> Option<bool> {
        zero.is_image(zero, &self.changes[1..])
    }

    /// An enclosure of a number that a figure has in common with its mirror image: a sum of the real parts of first coordinates, each
    /// multiplied by a number without pattern.
    pub fn key(&self, zero: &Zero) -> Interval {
        let mut factor = 0.5f64;
        let mut sum = point(0.0);
        for unknown in (0..self.is_first.len()).filter(|&u| self.is_first[u]) {
            factor = (factor + 0.618_033_988_749_894_9).fract();
            sum += point(0.25 + factor) * zero.part(unknown)[0];
        }
        sum
    }
}
