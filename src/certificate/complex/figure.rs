//! The equations of distances between complex points, and Krawczyk's test for one solution.

use super::numbers::{Rectangle, about_inverse};
use crate::interval::{Interval, enclose, hull, point};
use crate::problem::{Problem, Target};

/// The equations |p − q|² = d² with some points standing still.
#[derive(Debug)]
pub struct Equations {
    dimension: usize,
    /// Places of fixed points.
    places: Vec<Option<Vec<Rectangle>>>,
    /// For each point the first of its unknowns, where it is free.
    first: Vec<Option<usize>>,
    unknowns: usize,
    /// Points, and the square of their distance.
    distances: Vec<([usize; 2], Interval)>,
}

/// A solution that is proved.
#[derive(Debug)]
pub struct Proved {
    dimension: usize,
    /// A box with exactly one solution.
    outer: Vec<Rectangle>,
    /// It is in here.
    inner: Vec<Rectangle>,
}

fn square(target: &Target) -> Interval {
    match target {
        Target::Length(length) => enclose(length).sqr(),
        Target::SquaredLength(squared) => enclose(squared),
    }
}

impl Equations {
    /// For a problem of distances. Fails where the fixed points are not joined, or may be in line.
    pub fn new(problem: &Problem, fixed: &[usize]) -> Result<Self, String> {
        let (d, n) = (problem.dimension, problem.points.len());
        if !problem.is_distances_only() {
            return Err("there are other constraints than distances".to_owned());
        }
        let between = |a: usize, b: usize| {
            let joins = |x: &&crate::problem::Distance| x.points == [a, b] || x.points == [b, a];
            let found = problem.distances.iter().find(joins);
            found
                .map(|x| square(&x.target))
                .ok_or_else(|| "the fixed points are not joined by distances".to_owned())
        };
        let zero = point(0.0);
        let corners: Vec<Vec<Interval>> = match (d, fixed) {
            (2, &[a, b]) => vec![vec![zero; 2], vec![between(a, b)?.sqrt(), zero]],
            (3, &[a, b, c]) => {
                let (u, v, w) = (between(a, b)?, between(a, c)?, between(b, c)?);
                let length = u.sqrt();
                if length.inf() <= 0.0 {
                    return Err("fixed points may coincide".to_owned());
                }
                let x = (u + v - w) / (point(2.0) * length);
                let height = v - x.sqr();
                // Otherwise the triangle has no proper place, or none with real coordinates.
                if height.inf() <= 0.0 {
                    return Err("the fixed points may be in line".to_owned());
                }
                vec![
                    vec![zero; 3],
                    vec![length, zero, zero],
                    vec![x, height.sqrt(), zero],
                ]
            }
            _ => return Err(format!("{d} points have to be fixed")),
        };
        let mut places = vec![None; n];
        for (&p, corner) in fixed.iter().zip(corners) {
            places[p] = Some(corner.into_iter().map(Rectangle::real).collect());
        }
        let mut unknowns = 0;
        let first = places.iter().map(|place: &Option<Vec<Rectangle>>| {
            place.is_none().then(|| {
                unknowns += d;
                unknowns - d
            })
        });
        let first = first.collect();
        let is_fixed = |p: usize| fixed.contains(&p);
        let distances: Vec<([usize; 2], Interval)> = problem
            .distances
            .iter()
            .filter(|x| !x.points.into_iter().all(is_fixed))
            .map(|x| (x.points, square(&x.target)))
            .collect();
        if distances.len() != unknowns {
            return Err(format!(
                "there are {} distances for {unknowns} coordinates",
                distances.len()
            ));
        }
        Ok(Equations {
            dimension: d,
            places,
            first,
            unknowns,
            distances,
        })
    }

    /// A coordinate of a point, where the unknowns are in a box.
    fn at(&self, p: usize, axis: usize, x: &[Rectangle]) -> Rectangle {
        match (&self.places[p], self.first[p]) {
            (Some(place), _) => place[axis],
            (None, Some(first)) => x[first + axis],
            (None, None) => unreachable!("a point is fixed or free"),
        }
    }

    fn difference(&self, e: usize, axis: usize, x: &[Rectangle]) -> Rectangle {
        let [a, b] = self.distances[e].0;
        self.at(a, axis, x).minus(self.at(b, axis, x))
    }

    /// The entries of a row of the Jacobian that are not zero: unknown and value.
    fn row(&self, e: usize, x: &[Rectangle]) -> Vec<(usize, Rectangle)> {
        let [a, b] = self.distances[e].0;
        let two = Rectangle::real(point(2.0));
        let mut row = Vec::new();
        for axis in 0..self.dimension {
            let slope = two.times(self.difference(e, axis, x));
            row.extend(self.first[a].map(|first| (first + axis, slope)));
            row.extend(self.first[b].map(|first| (first + axis, slope.negative())));
        }
        row
    }

    /// Proves that a box around these places (point by point) holds exactly one solution.
    ///
    /// Krawczyk: K = c − Y F(c) + (I − Y F'(X)) (X − c) inside X, for a box X around c, and Y about F'(c)⁻¹. It holds for
    /// analytic maps of complex boxes as it does for real ones: F(x) − F(c) = M (x − c) with M in F'(X), as F' is
    /// linear and X convex.
    pub fn prove(&self, places: &[Vec<[f64; 2]>]) -> Option<Proved> {
        let n = self.unknowns;
        let fits = places.len() == self.first.len()
            && places.iter().all(|place| {
                place.len() == self.dimension && place.iter().flatten().all(|x| x.is_finite())
            });
        if !fits {
            return None;
        }
        let mut c = vec![[0.0; 2]; n];
        for (place, first) in places.iter().zip(&self.first) {
            if let Some(first) = *first {
                c[first..first + self.dimension].copy_from_slice(place);
            }
        }
        let centre: Vec<Rectangle> = c.iter().map(|&x| Rectangle::point(x)).collect();
        let mut jacobian = vec![vec![[0.0; 2]; n]; n];
        for (e, row) in jacobian.iter_mut().enumerate() {
            for (i, value) in self.row(e, &centre) {
                row[i] = [value.re.mid(), value.im.mid()];
            }
        }
        let y = about_inverse(jacobian)?;
        if !y.iter().flatten().flatten().all(|x| x.is_finite()) {
            return None;
        }
        let zero = Rectangle::point([0.0; 2]);
        let residual: Vec<Rectangle> = (0..n)
            .map(|e| {
                let axes = 0..self.dimension;
                let squares = axes.fold(zero, |sum, axis| {
                    let u = self.difference(e, axis, &centre);
                    sum.plus(u.times(u))
                });
                squares.minus(Rectangle::real(self.distances[e].1))
            })
            .collect();
        let step: Vec<Rectangle> = y
            .iter()
            .map(|row| {
                let terms = row.iter().zip(&residual);
                terms.fold(zero, |sum, (&y, &f)| sum.plus(Rectangle::point(y).times(f)))
            })
            .collect();
        let most = step
            .iter()
            .fold(f64::MIN_POSITIVE, |max, x| max.max(x.size()));
        // As small as it goes: boxes of solutions that are near each other have to be apart.
        [4.0, 100.0].into_iter().find_map(|factor| {
            let radius = factor * most;
            if !radius.is_finite() {
                return None;
            }
            let around = Rectangle {
                re: hull(-radius, radius),
                im: hull(-radius, radius),
            };
            let outer: Vec<Rectangle> = centre.iter().map(|&x| x.plus(around)).collect();
            let rows: Vec<Vec<(usize, Rectangle)>> = (0..n).map(|e| self.row(e, &outer)).collect();
            let mut inner = Vec::with_capacity(n);
            for (i, y) in y.iter().enumerate() {
                let mut defect = vec![zero; n];
                defect[i] = Rectangle::point([1.0, 0.0]);
                for (&y, row) in y.iter().zip(&rows) {
                    for &(k, value) in row {
                        defect[k] = defect[k].minus(Rectangle::point(y).times(value));
                    }
                }
                let spread = defect
                    .into_iter()
                    .fold(zero, |sum, m| sum.plus(m.times(around)));
                inner.push(centre[i].minus(step[i]).plus(spread));
            }
            let is_inside = inner.iter().zip(&outer).all(|(k, x)| k.is_inside(*x));
            is_inside.then_some(Proved {
                dimension: self.dimension,
                outer,
                inner,
            })
        })
    }
}

impl Proved {
    fn mirrored(&self, of: &[Rectangle]) -> Vec<Rectangle> {
        let (d, last) = (self.dimension, self.dimension - 1);
        let entry = |(i, x): (usize, &Rectangle)| match i % d == last {
            true => x.negative(),
            false => *x,
        };
        of.iter().enumerate().map(entry).collect()
    }

    /// Whether the solution is surely not the other one, nor its mirror image.
    pub fn is_apart(&self, other: &Proved) -> bool {
        let apart = |a: &[Rectangle], b: &[Rectangle]| a.iter().zip(b).any(|(a, b)| a.is_apart(*b));
        apart(&self.inner, &other.inner) && apart(&self.mirrored(&self.inner), &other.inner)
    }

    /// Whether an image of the solution that is a solution, too, is the same. `None`: that is not clear.
    fn is_its_own(&self, image: &[Rectangle]) -> Option<bool> {
        let pairs = || image.iter().zip(&self.inner);
        if pairs().any(|(a, b)| a.is_apart(*b)) {
            return Some(false);
        }
        // One solution is in the outer box, so both are that one.
        let is_in = image.iter().zip(&self.outer).all(|(a, x)| a.is_inside(*x));
        is_in.then_some(true)
    }

    /// Whether the figure is its own mirror image.
    pub fn is_its_own_mirror_image(&self) -> Option<bool> {
        self.is_its_own(&self.mirrored(&self.inner))
    }

    /// Whether it is real: the same as its conjugate, which solves the same equations.
    pub fn is_real(&self) -> Option<bool> {
        let conjugate: Vec<Rectangle> = self.inner.iter().map(|x| x.conjugate()).collect();
        self.is_its_own(&conjugate)
    }
}
