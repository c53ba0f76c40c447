//! A figure whose dimensions are known within limits: exactly one for every choice of all of them, by one test of Krawczyk.

use super::ending::{Edited, Ending, Keep};
use super::open::OpenError;
use super::setting::Setting;
use super::way::Way as _;
use super::whole::Whole;
use crate::blocks::Account;
use crate::constraint::try_lower_apart;
use crate::elimination::invert;
use crate::interval::{Interval, hull, point};
use crate::problem::{Decimal, Problem};
use crate::system::{Homotopy, Right};
use crate::track::{Control, Options, StartError};
use std::slice;

/// Between which values a dimension is.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// The index, as in [`Setting`].
    pub index: usize,
    /// The least and the greatest value.
    pub values: [Decimal; 2],
}

/// A figure and its equations, of which dimensions are anywhere within limits.
pub(crate) struct Limited {
    whole: Whole,
    limits: Vec<Limits>,
    /// Over all choices of the dimensions, the right-hand sides.
    rights: Vec<Interval>,
    /// For each of the limits by how much each right-hand side grows from the least value to the greatest.
    growth: Vec<Vec<f64>>,
}

/// All figures that a figure becomes as its dimensions go through their limits.
pub(crate) struct Within {
    limited: Limited,
    /// The middle of the figure with the dimensions as they are given, one entry per unknown, in the homotopy's unit.
    centre: Vec<f64>,
    /// Where each unknown of all these figures is, as seen from there.
    pub around: Vec<Interval>,
    /// That, but for the part that is linear in the right-hand sides: of second order in how wide the limits are.
    rest: Vec<Interval>,
    /// About the inverse of the Jacobian in the middle, row by row.
    inverse: Vec<f64>,
    /// What the equations miss in the middle, for all choices.
    missed: Vec<Interval>,
}

/// The test is tried with so many radii, each what the one before came to.
const ROUNDS: usize = 25;

impl Limited {
    /// Takes the sketch of a checked problem for the figure, as [`super::Session`] does.
    ///
    /// Limits are those of distances between points and of constraints of which the right-hand side of each equation grows with the
    /// value, or falls, and is that of no other dimension ([`try_lower_apart`]).
    pub fn open(
        problem: &Problem,
        limits: &[Limits],
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let mut whole = Whole::open_lowered(problem, try_lower_apart, options, control)?;
        let mut rights = rights(whole.homotopy());
        let mut growth = Vec::new();
        let mut is_taken = vec![false; rights.len()];
        for one in limits {
            let mut ends = Vec::new();
            for value in &one.values {
                ends.push(whole.rights_with(&Setting::to(one.index, value.clone()))?);
            }
            let now = whole.rights_now();
            let [low, high] = [&ends[0], &ends[1]];
            let grown = (0..rights.len()).map(|e| high[e].mid() - low[e].mid());
            growth.push(grown.collect());
            for e in 0..rights.len() {
                // Those that are not this dimension's stay what they are.
                if low[e] != now[e] || high[e] != now[e] {
                    rights[e] = rights[e].convex_hull(low[e]).convex_hull(high[e]);
                    if std::mem::replace(&mut is_taken[e], true) {
                        let name = problem.dimension_name(one.index);
                        let what = format!(
                            "{name}: an equation has the number of another dimension with limits as well; give one of both none"
                        );
                        return Err(StartError::Unsupported(what).into());
                    }
                }
            }
        }
        Ok(Limited {
            whole,
            limits: limits.to_vec(),
            rights,
            growth,
        })
    }

    /// Whether other equations are the same, with the same ranges.
    pub fn is_same(&self, other: &Limited) -> bool {
        let (one, two) = (self.whole.homotopy(), other.whole.homotopy());
        let mut rows = 0..one.equations;
        (one.equations, one.unit, &self.rights) == (two.equations, two.unit, &other.rights)
            && rows.all(|e| one.terms(e) == two.terms(e))
    }

    /// The equations with the ranges of their right-hand sides at t = 1.
    pub fn ranges(&self) -> Homotopy {
        let mut homotopy = self.whole.homotopy().clone();
        for (right, &range) in homotopy.rights.iter_mut().zip(&self.rights) {
            *right = Right::anywhere(range);
        }
        homotopy
    }

    /// What is proved of its figures.
    pub fn account(&self) -> Account {
        self.whole.account()
    }

    /// Where an unknown is in the figure with the dimensions as they are given, in the homotopy's unit.
    pub fn nominal(&self, i: usize) -> Interval {
        self.whole.figure().enclosure(i)
    }

    /// A figure in the gauge, in lengths of the problem, in the coordinates of the problem.
    pub fn put(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        self.whole.put(places)
    }

    /// Proves that for every choice of values within the limits there is exactly one figure near the one with the dimensions as they are given,
    /// which these lead to. `None`: that is not proved.
    ///
    /// The equations are quadratic, so that ξ − Y F(ξ) = x − Y F(x) + (I − Y J((ξ + x)/2)) (ξ − x) exactly, and what maps a box X around x into its
    /// inside needs J between x and X alone. Of two zeros in X, F(ξ) − F(η) = J((ξ + η)/2) (ξ − η): with Y J regular all over X there is one.
    pub fn prove(self) -> Option<Within> {
        let (homotopy, rights) = (self.whole.homotopy(), &self.rights);
        let centre = self.whole.figure().centre.clone();
        let at = |i: usize| point(centre[i]);
        let missed: Vec<Interval> = (0..rights.len())
            .map(|e| homotopy.left_side(e, at) - rights[e])
            .collect();
        let m = homotopy.equations;
        let mut inverse = vec![0.0; m * m];
        for e in 0..m {
            for (i, x) in homotopy.slopes(e, at).into_iter().enumerate() {
                inverse[e * m + i] = x.mid();
            }
        }
        if !invert(&mut inverse, m) || inverse.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let row = |i: usize| &inverse[i * m..(i + 1) * m];
        let linear: Vec<Interval> = (0..m)
            .map(|i| -sum(row(i).iter().zip(&missed).map(|(&y, &f)| point(y) * f)))
            .collect();
        let inflated = |images: &[Interval]| -> Vec<f64> {
            let all = images.iter().zip(&centre);
            all.map(|(x, c)| 1.1 * x.mag() + f64::EPSILON * (1.0 + c.abs()))
                .collect()
        };
        // I − Y J over a part of the box of these radii.
        let defect = |radius: &[f64], part: f64| -> Vec<Vec<Interval>> {
            let near = |i: usize| at(i) + point(part) * hull(-radius[i], radius[i]);
            let jacobian: Vec<Vec<Interval>> = (0..m).map(|e| homotopy.slopes(e, near)).collect();
            let entry = |i: usize, j: usize| {
                let pairs = row(i).iter().zip(&jacobian);
                let product = sum(pairs.map(|(&y, row)| point(y) * row[j]));
                point(if i == j { 1.0 } else { 0.0 }) - product
            };
            let line = |i: usize| (0..m).map(|j| entry(i, j)).collect();
            (0..m).map(line).collect()
        };
        let mut radius = inflated(&linear);
        let mut proved = None;
        for _ in 0..ROUNDS {
            let rest = defect(&radius, 0.5).into_iter().map(|line| {
                let pairs = line.into_iter().zip(&radius);
                sum(pairs.map(|(x, &r)| x * hull(-r, r)))
            });
            let rest: Vec<Interval> = rest.collect();
            let image: Vec<Interval> = linear.iter().zip(&rest).map(|(a, b)| *a + *b).collect();
            if image.iter().any(|x| !x.mag().is_finite()) {
                break;
            }
            if image.iter().zip(&radius).all(|(x, r)| x.mag() < *r) {
                // Y J is regular between any two places of the box.
                let is_alone = contracts(&defect(&radius, 1.0), &radius);
                proved = is_alone.then_some((image, rest));
                break;
            }
            // What is within its radius is not made wider: others grow with it.
            radius = inflated(&image);
            if !radius.iter().all(|r| r.is_finite()) {
                break;
            }
        }
        // Beyond, equations have zeros that are no figures.
        let proved = proved.filter(|(around, _)| homotopy.is_proper_over(|i| at(i) + around[i]));
        proved.map(|(around, rest)| Within {
            centre,
            around,
            rest,
            inverse,
            missed,
            limited: self,
        })
    }
}

impl Within {
    /// The equations' homotopy.
    pub fn homotopy(&self) -> &Homotopy {
        self.limited.whole.homotopy()
    }

    /// A point of the figure with the dimensions as they are given, about: in the gauge, in lengths of the problem.
    pub fn middle(&self, p: usize) -> [Interval; 3] {
        self.at(p, |i| point(self.centre[i]))
    }

    /// A box of a point of all figures and all between them and the middle, likewise.
    pub fn near(&self, p: usize) -> [Interval; 3] {
        self.at(p, |i| {
            point(self.centre[i]) + self.around[i].convex_hull(point(0.0))
        })
    }

    fn at(&self, p: usize, unknown: impl Fn(usize) -> Interval) -> [Interval; 3] {
        let homotopy = self.homotopy();
        homotopy.place(p, |i| unknown(i) * point(homotopy.unit))
    }

    /// Boxes of all points of all figures, in the coordinates of the problem.
    pub fn boxes(&self) -> Vec<[Interval; 3]> {
        let places = (0..self.homotopy().points)
            .map(|p| self.at(p, |i| point(self.centre[i]) + self.around[i]));
        self.limited.put(&places.collect::<Vec<_>>())
    }

    /// What is proved of its figures.
    pub fn account(&self) -> Account {
        self.limited.account()
    }

    /// The figure with the dimensions as they are given.
    pub fn figure(&self) -> Vec<[Interval; 3]> {
        self.limited.whole.points()
    }

    /// By how much something changes over all figures, as seen from the middle, of which these are the derivatives by the unknowns that it
    /// depends on over all figures.
    pub fn change(&self, slopes: &[(usize, Interval)]) -> Interval {
        // What is linear in the right-hand sides is taken together, as each of these stands for itself.
        let linear = -sum(self.weights(slopes).zip(&self.missed).map(|(w, f)| w * *f));
        let rest = sum(slopes.iter().map(|&(i, slope)| {
            let middle = point(slope.mid());
            middle * self.rest[i] + (slope - middle) * self.around[i]
        }));
        linear + rest
    }

    /// For each of the limits by how much something grows, about, as that dimension does, of which these are the derivatives.
    pub fn effects(&self, slopes: &[(usize, Interval)]) -> Vec<f64> {
        let weights: Vec<f64> = self.weights(slopes).map(|weight| weight.mid()).collect();
        let of = |growth: &Vec<f64>| weights.iter().zip(growth).map(|(w, grown)| w * grown).sum();
        self.limited.growth.iter().map(of).collect()
    }

    /// How much each right-hand side counts where the derivatives are in the middle of these.
    fn weights(&self, slopes: &[(usize, Interval)]) -> impl Iterator<Item = Interval> {
        let m = self.centre.len();
        let weight = move |e: usize| {
            let terms = slopes.iter();
            sum(terms.map(|(i, slope)| point(slope.mid()) * point(self.inverse[i * m + e])))
        };
        (0..m).map(weight)
    }

    /// The figure with each dimension at its greatest value, or its least, if the path there is proved.
    pub fn corner(
        &mut self,
        greatest: impl Fn(usize) -> bool,
        control: &mut Control,
    ) -> Option<Vec<[Interval; 3]>> {
        let limits = self.limited.limits.iter().enumerate();
        let settings: Vec<Setting> = limits
            .map(|(k, one)| Setting::to(one.index, one.values[usize::from(greatest(k))].clone()))
            .collect();
        let edited = self.limited.whole.edit(&settings, Keep::Never, control);
        match edited {
            Edited {
                ending: Ending::Reached,
                points,
                ..
            } => Some(points),
            _ => None,
        }
    }
}

impl Whole {
    /// The right-hand sides with another value of a dimension.
    fn rights_with(&mut self, setting: &Setting) -> Result<Vec<Interval>, OpenError> {
        self.lead_constraints(slice::from_ref(setting))
            .map_err(StartError::Unsupported)?;
        let distances = &self.problem().distances;
        let now = distances.get(setting.index).map(|d| d.target.clone());
        if now.is_some() {
            self.homotopy_mut().hold(setting.index, &setting.target);
        }
        let found = rights(self.homotopy());
        if let Some(now) = now {
            self.homotopy_mut().hold(setting.index, &now);
        }
        Ok(found)
    }

    /// The right-hand sides as they are now.
    fn rights_now(&mut self) -> Vec<Interval> {
        // What an edit of nothing leads constraints to is what they are.
        let _ = self.lead_constraints(&[]);
        rights(self.homotopy())
    }
}

/// The right-hand sides at t = 1.
fn rights(homotopy: &Homotopy) -> Vec<Interval> {
    homotopy
        .rights
        .iter()
        .map(|right| right.at_target())
        .collect()
}

/// Whether the norm of a matrix of intervals is less than 1 in some norm max |xᵢ| / sᵢ: one is sought from `first` on, as s = first + |D| s.
fn contracts(matrix: &[Vec<Interval>], first: &[f64]) -> bool {
    let image = |s: &[f64], i: usize| {
        let pairs = matrix[i].iter().zip(s);
        sum(pairs.map(|(x, &s)| x.abs() * point(s))).sup()
    };
    let mut s = first.to_vec();
    for _ in 0..ROUNDS {
        if (0..s.len()).all(|i| image(&s, i) < s[i]) {
            return true;
        }
        s = (0..s.len()).map(|i| first[i] + image(&s, i)).collect();
    }
    false
}

fn sum(terms: impl Iterator<Item = Interval>) -> Interval {
    terms.fold(point(0.0), |sum, x| sum + x)
}
