//! Limits with nothing held: figures at which a dimension is the greatest, or the least, of all figures near them, however they move.
//!
//! Where a figure can move with all its dimensions as they are, the way to a limit of one of them holds coordinates, and ends where these hold it.
//! From there the dimension is made extreme in floats, and what comes of that is proved. With the left-hand side G of the dimension's equation and the
//! others F = c, there are multipliers λ with ∇G + Σ λ ∇F = 0 (Lagrange) at a figure that is extreme. They, and the
//! figure, are the zero of a square system of quadratic equations, which the prover of figures proves. Equations whose multipliers
//! are zero hold there, and say nothing of G: without them, G is extreme among more figures.
//!
//! That G is strictly less at all figures near it, but for those that are the same figure moved as a whole, follows from H = ∇²G + Σ λ ∇²F
//! being negative definite on all directions in which the figure can begin to move, but for those motions: as it is if
//! σ JᵀJ + Σ m mᵀ − H is positive definite for some σ, J being the Jacobian of F and m the motions (Finsler's lemma; Nocedal and Wright,
//! Numerical Optimization, 2006, theorem 12.6). Of as many gradients as there are motions nothing need be said: as G and F do not change
//! along them, Σ m ∇ = 0 for each, so that they are zero where the others are.

use super::exact::value_at;
use super::left_out::at_rest_all;
use super::{Parts, Used, moves};
use crate::blocks::{Floats, System};
use crate::constraint::{Entry, Equation, Form, Product, Role, Unknown, try_lower_all, value};
use crate::edit::lowered;
use crate::edit::open::furthest;
use crate::edit::setting::Setting;
use crate::edit::way::Way as _;
use crate::equations::{self, Halved, slopes};
use crate::interval::{Interval, Real, hull, point};
use crate::linalg::{Span, decomposed, is_positive_definite, linearised, shortest};
use crate::order::each_once;
use crate::rational::Rational;
use crate::system::{Homotopy, Part};
use crate::track::arc::Figure;
use crate::track::certified::arcs;
use nalgebra::{DMatrix, DVector};
use std::collections::{HashMap, HashSet};
use std::slice;

/// A figure at which a dimension is the greatest, or the least, of all figures near it, however they move: proved.
#[derive(Debug, Clone, PartialEq)]
pub struct Extreme {
    /// The dimension there.
    pub value: Interval,
    /// The figure, in the coordinates of the problem: a box that holds exactly one.
    pub points: Vec<[Interval; 3]>,
    /// How far a point is at most from where it is at the end of the way that was followed.
    pub apart: f64,
}

/// Larger parts of sketches are not looked at: it would take seconds.
const MOST_UNKNOWNS: usize = 40;
/// Steps towards an extreme.
const STEPS: usize = 100;
/// No step is longer, in a unit in which the figure is of size about 1.
const LONGEST: f64 = 0.2;
/// A curvature, a multiplier or a slope that is less of the greatest one is taken for zero. Nothing that is proved rests on it.
const NONE: f64 = 1e-7;

/// A motion of all points as one.
#[derive(Debug, Clone, Copy)]
enum Motion {
    /// Along an axis.
    Along(usize),
    /// From one axis towards another.
    Turn(usize, usize),
}

/// The equations that a dimension's limit is about.
struct Near<'p> {
    system: &'p System,
    floats: Floats<'p>,
    dimension: usize,
    /// The row of the dimension.
    driven: usize,
    /// The others.
    rows: Vec<usize>,
    /// The unknowns of all, ascending.
    unknowns: Vec<usize>,
    /// 1 where the row's left-hand side is to be the greatest, −1 where the least.
    sense: f64,
}

impl Parts {
    /// A figure near the end of a way that `setting` led the dimension, at which it goes furthest of all figures near, if there is one and that is proved.
    pub(in crate::edit) fn extreme(
        &self,
        setting: &Setting,
        end: &[[Interval; 3]],
    ) -> Option<Extreme> {
        let problem = Setting::applied(slice::from_ref(setting), &self.cut.problem);
        let record = Some(&self.cut.record);
        let lowered = lowered(&problem, |problem| try_lower_all(problem, record)).ok()?;
        let rights = lowered.tail.rights();
        let floats = Floats::new(&self.cut.system, &lowered.tail.equations, self.cut.unit);
        let near = self.near(&rights, floats)?;
        let x = near.climb(self.start(end))?;
        let figure = near.prove(self, &rights, &x)?;
        if self.vanished(&figure).is_some() || !self.is_proper(&figure, &near.unknowns) {
            return None;
        }
        // How far on its way the dimension is.
        let row = &self.cut.system.rows[near.driven];
        let scale = point(self.scale(row.index));
        let reached = row.over(|u| figure.enclosure(u)) * scale;
        let t = when(&rights[row.index], reached)?;
        let points = self.points_of(&figure);
        Some(Extreme {
            value: setting.between(&self.cut.problem, t),
            apart: furthest(end, &points),
            points,
        })
    }

    /// The equations that the dimension that moves stands in one of, with all that they depend on.
    fn near<'p>(&'p self, rights: &[Vec<Real>], floats: Floats<'p>) -> Option<Near<'p>> {
        let system = &self.cut.system;
        let used = self.cut.used.iter().filter_map(|used| match used {
            Used::Row(row) => Some(*row),
            Used::Held(_) => None,
        });
        let used: Vec<usize> = used.collect();
        let right = |row: usize| &rights[system.rows[row].index];
        let all = 0..system.rows.len();
        let driven: Vec<usize> = all.filter(|&row| moves(right(row))).collect();
        let [driven] = driven[..] else { return None };
        if !used.contains(&driven) {
            return None;
        }
        // What an equation of its own says is a number, and leads no further.
        let is_linear = |row: usize| {
            let mut products = system.rows[row].products.iter();
            let one = equations::Form::One;
            products.all(|p| p.left == one || p.right == one)
        };
        let alone = used.iter().filter(|&&row| row != driven && is_linear(row));
        let alone = alone.map(|&row| &system.rows[row].unknowns);
        let numbers: HashSet<usize> = alone.filter(|u| u.len() == 1).map(|u| u[0]).collect();
        let mut unknowns: HashSet<usize> = system.rows[driven].unknowns.iter().copied().collect();
        loop {
            let leads = |u: &usize| unknowns.contains(u) && !numbers.contains(u);
            let of = |row: &usize| system.rows[*row].unknowns.iter();
            let met = used.iter().filter(|&row| of(row).any(leads)).flat_map(of);
            let more: Vec<usize> = met.copied().filter(|u| !unknowns.contains(u)).collect();
            if more.is_empty() {
                break;
            }
            unknowns.extend(more);
        }
        let is_in = |row: &usize| {
            system.rows[*row]
                .unknowns
                .iter()
                .all(|u| unknowns.contains(u))
        };
        let is_near = |row: &usize| {
            let mut of = system.rows[*row].unknowns.iter();
            of.any(|u| unknowns.contains(u) && !numbers.contains(u))
        };
        if unknowns.len() > MOST_UNKNOWNS || self.cut.redundant.iter().any(is_near) {
            return None;
        }
        let rows = used.into_iter().filter(|row| *row != driven && is_in(row));
        let rows: Vec<usize> = rows.collect();
        let grows = right(driven)[1].enclose().mid() > 0.0;
        Some(Near {
            system,
            floats,
            dimension: self.cut.problem.dimension,
            driven,
            rows,
            unknowns: each_once(unknowns),
            sense: if grows { 1.0 } else { -1.0 },
        })
    }

    /// The unknowns where points are in a figure, and others are what they are now.
    fn start(&self, points: &[[Interval; 3]]) -> Vec<f64> {
        let mut at = self.figure.centre.clone();
        for (p, place) in points.iter().enumerate() {
            for (axis, x) in place.iter().enumerate().take(self.cut.problem.dimension) {
                at[self.cut.coordinate(p, axis)] = x.mid() / self.cut.unit;
            }
        }
        at
    }

    /// Whether lengths and radii are certainly positive.
    fn is_proper(&self, figure: &Figure, unknowns: &[usize]) -> bool {
        let role = |u: usize| self.cut.system.unknowns[u].role;
        let mut all = unknowns.iter().copied();
        all.all(|u| role(u) != Role::Positive || figure.enclosure(u).inf() > 0.0)
    }
}

/// When a polynomial that only rises or falls from t = 0 to 1 has a value, by Newton's method with intervals.
/// `None`: it is not known to do either, or may not have it.
fn when(right: &[Real], value: Interval) -> Option<Interval> {
    let at: Vec<Interval> = right.iter().map(Real::enclose).collect();
    let slopes = at.iter().enumerate().skip(1);
    let slopes: Vec<Interval> = slopes.map(|(k, c)| point(k as f64) * *c).collect();
    let ends = [0.0, 1.0].map(|t| value_at(&at, point(t)) - value);
    let is_between = ends[0].sup() <= 0.0 && ends[1].inf() >= 0.0
        || ends[0].inf() >= 0.0 && ends[1].sup() <= 0.0;
    let mut t = is_between.then(|| hull(0.0, 1.0))?;
    loop {
        let slope = value_at(&slopes, t);
        if slope.contains(0.0) {
            return None;
        }
        let middle = point(t.mid());
        let next = t.intersection(middle - (value_at(&at, middle) - value) / slope);
        // As long as it gets narrower by a part that counts.
        let is_narrower = next.wid() < 0.9 * t.wid();
        if !is_narrower {
            return (!next.is_empty()).then_some(next);
        }
        t = next;
    }
}

/// Σ of what rows tell of second derivatives, each times its factor.
fn bent<T: Halved>(near: &Near, unknowns: &[usize], factors: &[(usize, T)]) -> Vec<T> {
    let n = unknowns.len();
    let local = numbered(unknowns);
    let mut out = vec![T::whole(0); n * n];
    for (row, factor) in factors {
        near.system.rows[*row].bends(|[a, b], halves| {
            let cell = &mut out[local[&a] * n + local[&b]];
            *cell = cell.clone() + factor.clone().halves(halves);
        });
    }
    out
}

fn numbered(unknowns: &[usize]) -> HashMap<usize, usize> {
    unknowns.iter().enumerate().map(|(k, &u)| (u, k)).collect()
}

impl Near<'_> {
    /// The Jacobian of rows by some unknowns.
    fn jacobian(&self, rows: &[usize], unknowns: &[usize], at: &[f64]) -> DMatrix<f64> {
        let local = numbered(unknowns);
        let each = |r: usize, tell: &mut dyn FnMut(usize, f64)| {
            self.system.rows[rows[r]].evaluate(at, |u, slope| tell(local[&u], slope))
        };
        linearised((rows.len(), unknowns.len()), &each).0
    }

    /// A place near this one that meets the rows.
    fn meet(&self, at: Vec<f64>) -> Option<Vec<f64>> {
        self.floats.meet_in(&self.rows, &self.unknowns, at)
    }

    /// What is to be the greatest.
    fn height(&self, at: &[f64]) -> f64 {
        self.sense * self.system.rows[self.driven].over(|u| at[u])
    }

    /// The multipliers of the rows at a place, as well as they can be told, and what is left of the gradient.
    fn multipliers(&self, at: &[f64]) -> Option<(Vec<f64>, DVector<f64>)> {
        let jacobian = self.jacobian(&self.rows, &self.unknowns, at);
        let gradient = self.jacobian(&[self.driven], &self.unknowns, at);
        let gradient = gradient.row(0).transpose();
        if self.rows.is_empty() {
            return Some((Vec::new(), gradient));
        }
        let turned = decomposed(jacobian.transpose(), [true, true]);
        let multipliers = shortest(&turned, &-&gradient, 1e-12)?;
        let left = gradient + jacobian.tr_mul(&multipliers);
        Some((multipliers.data.into(), left))
    }

    /// Makes the dimension extreme, in floats, by Newton's method along the figures that meet the others, and by the gradient where it is not
    /// concave.
    fn climb(&self, start: Vec<f64>) -> Option<Vec<f64>> {
        let n = self.unknowns.len();
        let mut at = self.meet(start)?;
        for _ in 0..STEPS {
            let (multipliers, left) = self.multipliers(&at)?;
            let factors = self.rows.iter().copied().zip(multipliers);
            let factors: Vec<(usize, f64)> = factors.chain([(self.driven, 1.0)]).collect();
            let bent = DMatrix::from_vec(n, n, bent(self, &self.unknowns, &factors));
            // In the directions along which the rows stay met; in the others it falls steeply.
            let jacobian = self.jacobian(&self.rows, &self.unknowns, &at);
            let mut across = DMatrix::zeros(n, n);
            if !self.rows.is_empty() {
                let rows = decomposed(jacobian, [false, true]).v_t?;
                across = rows.tr_mul(&rows);
            }
            let along = DMatrix::identity(n, n) - &across;
            let size = 1.0 + bent.amax();
            let bent = self.sense * (&along * bent * &along) - size * &across;
            let eigen = bent.symmetric_eigen();
            let mut step = DVector::zeros(n);
            for (direction, &curvature) in eigen.eigenvectors.column_iter().zip(&eigen.eigenvalues)
            {
                let slope = self.sense * direction.dot(&left);
                let by = match curvature < -NONE * size {
                    true => slope / -curvature,
                    false if slope.abs() > NONE => LONGEST.copysign(slope),
                    // Off a saddle.
                    false if curvature > NONE * size && left.amax() < NONE => 0.1 * LONGEST,
                    false => 0.0,
                };
                step.axpy(by, &direction, 1.0);
            }
            let length = step.norm();
            if length < 1e-13 {
                break;
            }
            step *= (LONGEST / length).min(1.0);
            let here = self.height(&at);
            let better = (0..12).find_map(|k| {
                let mut next = at.clone();
                let shortened = 0.25_f64.powi(k);
                let moves = self.unknowns.iter().zip(step.iter());
                moves.for_each(|(&u, by)| next[u] += shortened * by);
                self.meet(next).filter(|next| self.height(next) > here)
            });
            match better {
                Some(next) => at = next,
                None => break,
            }
        }
        let (_, left) = self.multipliers(&at)?;
        (left.amax() < 1e-6).then_some(at)
    }

    /// For each coordinate of a place its axis and the place, of d unknowns, if points that share a coordinate share all.
    fn places(&self, unknowns: &[usize]) -> Option<HashMap<usize, (usize, &[usize])>> {
        let mut places: HashMap<usize, (usize, &[usize])> = HashMap::new();
        for place in self.system.coordinates.chunks(self.dimension) {
            for (axis, u) in place.iter().enumerate() {
                if unknowns.contains(u)
                    && places
                        .insert(*u, (axis, place))
                        .is_some_and(|known| known != (axis, place))
                {
                    return None;
                }
            }
        }
        Some(places)
    }

    /// The motions of all points as one that change no left-hand side, whatever the unknowns are.
    fn motions(&self, rows: &[usize], unknowns: &[usize]) -> Vec<Motion> {
        let d = self.dimension;
        let coordinates = self.system.coordinates.iter().enumerate();
        let axes: HashMap<usize, HashSet<usize>> =
            coordinates.fold(HashMap::new(), |mut all, (k, &u)| {
                all.entry(u).or_insert_with(HashSet::new).insert(k % d);
                all
            });
        let is_along = |entry: Option<usize>, axis: usize| {
            entry.is_some_and(|u| axes.get(&u).is_some_and(|axes| axes.contains(&axis)))
        };
        let products = || rows.iter().flat_map(|&row| &self.system.rows[row].products);
        let is_same = |form: equations::Form<Option<usize>>, axis: usize| match form {
            equations::Form::One => true,
            equations::Form::Difference(a, b) => is_along(a, axis) == is_along(b, axis),
        };
        let along = (0..d).filter(|&axis| {
            // What is a coordinate along two axes is moved by neither.
            unknowns
                .iter()
                .all(|u| axes.get(u).is_none_or(|axes| axes.len() == 1))
                && products().all(|p| is_same(p.left, axis) && is_same(p.right, axis))
        });
        let mut out: Vec<Motion> = along.map(Motion::Along).collect();
        let Some(places) = self.places(unknowns) else {
            return out;
        };
        // A squared distance of two places.
        let is_distance = |row: &usize| {
            let products = &self.system.rows[*row].products;
            let ends = products.iter().map(|p| match (p.left, p.right) {
                (equations::Form::Difference(Some(a), Some(b)), right) if p.left == right => {
                    let [(k, a), (l, b)] = [places.get(&a)?, places.get(&b)?];
                    (k == l && p.factor == products[0].factor).then_some((*k, *a, *b))
                }
                _ => None,
            });
            let Some(ends) = ends.collect::<Option<Vec<_>>>() else {
                return false;
            };
            let axes: HashSet<usize> = ends.iter().map(|end| end.0).collect();
            ends.len() == d
                && axes.len() == d
                && ends
                    .iter()
                    .all(|end| (end.1, end.2) == (ends[0].1, ends[0].2))
        };
        if rows.iter().all(is_distance) {
            out.extend(
                [(0, 1), (0, 2), (1, 2)]
                    .into_iter()
                    .filter(|ends| ends.1 < d)
                    .map(|(k, l)| Motion::Turn(k, l)),
            );
        }
        out
    }

    /// How fast a motion changes an unknown.
    fn speed<T: Halved>(&self, motion: Motion, u: usize, at: impl Fn(usize) -> T) -> T {
        let places = self.system.coordinates.chunks(self.dimension);
        let own = places.filter_map(|place| Some((place.iter().position(|v| *v == u)?, place)));
        let Some((axis, place)) = own.into_iter().next() else {
            return T::whole(0);
        };
        match motion {
            Motion::Along(k) => T::whole((axis == k).into()),
            Motion::Turn(k, l) if axis == k => T::whole(0) - at(place[l]),
            Motion::Turn(k, l) if axis == l => at(place[k]),
            Motion::Turn(..) => T::whole(0),
        }
    }

    /// Proves that there is an extreme where one is in floats: the figure. Which equations it needs is tried: all; those that have a part in it and those
    /// that say where something is; those that have a part in it.
    fn prove(&self, parts: &Parts, rights: &[Vec<Real>], at: &[f64]) -> Option<Figure> {
        let (multipliers, _) = self.multipliers(at)?;
        let greatest = multipliers.iter().fold(1.0, |max: f64, x| max.max(x.abs()));
        let all: Vec<(usize, f64)> = self.rows.iter().copied().zip(multipliers).collect();
        let has_part = |x: f64| x.abs() > NONE * greatest;
        let is_place = |row: usize| self.system.rows[row].unknowns.len() == 1;
        let tries: [&dyn Fn(usize, f64) -> bool; 3] = [
            &|_, _| true,
            &|row, x| has_part(x) || is_place(row),
            &|_, x| has_part(x),
        ];
        tries.into_iter().find_map(|is_needed| {
            let own = all.iter().copied().filter(|&(row, x)| is_needed(row, x));
            self.prove_with(parts, rights, at, own.unzip())
        })
    }

    /// The same with some of the rows and their multipliers.
    fn prove_with(
        &self,
        parts: &Parts,
        rights: &[Vec<Real>],
        at: &[f64],
        (own, multipliers): (Vec<usize>, Vec<f64>),
    ) -> Option<Figure> {
        let with_driven: Vec<usize> = own.iter().copied().chain([self.driven]).collect();
        let of = with_driven
            .iter()
            .flat_map(|&row| self.system.rows[row].unknowns.iter());
        let unknowns = each_once(of.copied());
        // Of the motions those that are different ones at this figure, and as many unknowns that they move.
        let mut motions = self.motions(&with_driven, &unknowns);
        let speeds = |motion: Motion| -> Vec<f64> {
            let each = unknowns.iter().map(|&u| self.speed(motion, u, |v| at[v]));
            each.collect()
        };
        let mut span = Span::default();
        motions.retain(|&motion| span.take([speeds(motion)]));
        let columns = (0..unknowns.len()).map(|k| {
            let each = motions.iter().map(|&motion| speeds(motion)[k]);
            each.collect::<Vec<f64>>()
        });
        let columns: Vec<Vec<f64>> = columns.collect();
        let moved = Span::default().choose(&columns, motions.len());
        let (silent, told): (Vec<_>, Vec<_>) =
            unknowns.iter().zip(moved).partition(|(_, moved)| *moved);
        let [silent, told]: [Vec<usize>; 2] =
            [silent, told].map(|all| all.into_iter().map(|(&u, _)| u).collect());
        if silent.len() < motions.len() {
            return None;
        }
        let figure = self.critical(parts, rights, (at, &multipliers), (&own, &told))?;
        let x = |u: usize| figure.enclosure(self.unknowns.binary_search(&u).expect("an unknown"));
        let multiplier = |k: usize| figure.enclosure(self.unknowns.len() + k);
        // The gradients of which nothing was said are zero, too.
        let (n, count) = (unknowns.len(), motions.len());
        let speed = |motion: Motion, u: usize| self.speed(motion, u, x);
        let silences = (0..count * count).map(|cell| {
            let [a, b] = [cell / count, cell % count];
            silent.iter().fold(point(0.0), |sum, &u| {
                sum + speed(motions[a], u) * speed(motions[b], u)
            })
        });
        if !is_positive_definite(count, &silences.collect::<Vec<_>>()) {
            return None;
        }
        let factors = own.iter().enumerate().map(|(k, &row)| (row, multiplier(k)));
        let factors: Vec<(usize, Interval)> = factors.chain([(self.driven, point(1.0))]).collect();
        let bent = bent(self, &unknowns, &factors);
        let local = numbered(&unknowns);
        let slopes = own.iter().map(|&row| {
            let mut slopes = vec![point(0.0); n];
            self.system.rows[row].derivatives(x, |u, slope| slopes[local[&u]] += slope);
            slopes
        });
        let slopes: Vec<Vec<Interval>> = slopes.collect();
        let moving = motions
            .iter()
            .map(|&motion| unknowns.iter().map(|&u| speed(motion, u)).collect());
        let moving: Vec<Vec<Interval>> = moving.collect();
        let is_extreme = [1.0, 1e2, 1e4].into_iter().any(|weight| {
            let cells = (0..n * n).map(|cell| {
                let [a, b] = [cell / n, cell % n];
                let squares = |all: &[Vec<Interval>]| {
                    all.iter().fold(point(0.0), |sum, of| sum + of[a] * of[b])
                };
                point(weight) * (squares(&slopes) + squares(&moving))
                    - point(self.sense) * bent[cell]
            });
            is_positive_definite(n, &cells.collect::<Vec<_>>())
        });
        is_extreme.then(|| {
            let mut whole = parts.figure.clone();
            for &u in &self.unknowns {
                super::put(&mut whole, u, x(u));
            }
            whole
        })
    }

    /// The figure and its multipliers, as the zero of their equations: the unknowns first.
    fn critical(
        &self,
        parts: &Parts,
        rights: &[Vec<Real>],
        (at, multipliers): (&[f64], &[f64]),
        (own, told): (&[usize], &[usize]),
    ) -> Option<Figure> {
        let n = self.unknowns.len();
        let local = numbered(&self.unknowns);
        let entry = |u: Option<usize>| Entry::from(u.map(|u| local[&u]));
        let rest = at_rest_all(rights);
        let mut equations: Vec<Equation> = Vec::new();
        for &row in &self.rows {
            let row = &self.system.rows[row];
            equations.push(Equation {
                name: parts.cut.name(row.index),
                products: row.products.iter().map(|p| p.map(entry)).collect(),
                right: rest[row.index].clone(),
                power: parts.cut.powers[row.index],
            });
        }
        let factors = own.iter().enumerate();
        let factors = factors.map(|(k, &row)| (row, value(Entry::Unknown(n + k))));
        let factors: Vec<(usize, Form)> = factors.chain([(self.driven, Form::One)]).collect();
        for &u in told {
            let of = |(row, by): &(usize, Form)| self.system.rows[*row].derived(u, *by, entry);
            equations.push(Equation {
                name: format!("the slope by {}", self.system.unknowns[u].name),
                products: factors.iter().flat_map(of).collect(),
                right: vec![Real::zero()],
                power: 0,
            });
        }
        // What these leave open is held where it is.
        let size = n + own.len();
        let x = |k: usize| match self.unknowns.get(k) {
            Some(&u) => at[u],
            None => multipliers[k - n],
        };
        let slopes = linearised((equations.len(), size), &|e, tell| {
            let products = &equations[e].products;
            let value = |entry: Entry| entry.unknown().map_or(0.0, x);
            slopes(products, value, |entry, slope| {
                entry.unknown().into_iter().for_each(|k| tell(k, slope));
            });
            0.0
        });
        let mut span = Span::default();
        let is_regular = slopes
            .0
            .row_iter()
            .all(|row| span.take([row.iter().copied().collect()]));
        let units = (0..n).map(|k| (0..size).map(|j| f64::from(u8::from(j == k))).collect());
        let held = span.choose(&units.collect::<Vec<_>>(), size);
        if !is_regular || span.rank() < size {
            return None;
        }
        for k in (0..n).filter(|&k| held[k]) {
            let unknown = &self.system.unknowns[self.unknowns[k]];
            let unit = parts.cut.unit.powi(unknown.power);
            equations.push(Equation {
                name: format!("{} stays put", unknown.name),
                products: vec![Product::new(2, value(Entry::Unknown(k)), Form::One)],
                right: vec![Real::from(Rational::from_float(x(k) * unit)?)],
                power: unknown.power,
            });
        }
        let unknown = |k: usize| match self.unknowns.get(k) {
            Some(&u) => self.system.unknowns[u].clone(),
            None => Unknown {
                name: "a multiplier".to_owned(),
                role: Role::Free,
                power: 0,
                flips: [false; 3],
                sketch: point(x(k)),
            },
        };
        let coordinates = self.system.coordinates.iter();
        let homotopy = Homotopy::of_part(Part {
            nonzero: Vec::new(),
            dimension: self.dimension,
            unit: parts.cut.unit,
            unknowns: (0..size).map(unknown).collect(),
            equations,
            followed: Vec::new(),
            segments: Vec::new(),
            beside: Vec::new(),
            coordinates: coordinates.map(|u| local.get(u).copied()).collect(),
        });
        let near: Vec<f64> = (0..size).map(x).collect();
        Some(arcs(homotopy, &parts.options).prove_at_end(&near).ok()?.0)
    }
}
