//! Numbers that are known exactly all the way, as polynomials in t, and what can be said of them without any tube.

use super::{Parts, Used};
use crate::constraint::{Entry, Nonzero};
use crate::equations::{Form, Ring as _};
use crate::interval::along::{Along, Quantifiable as _};
use crate::interval::{Interval, Real, hull, point};
use crate::system::{Segment, determinant, sign_of};
use crate::track::arc::{Figure, Kept, Off, Orientation};
use crate::track::{Stop, StopKind};
use std::collections::HashMap;

impl Parts {
    /// The polynomials of moving unknowns that are known exactly.
    pub(super) fn exact_polynomials(
        &self,
        rights: &[Vec<Real>],
        moving: &[bool],
    ) -> HashMap<usize, Vec<Real>> {
        let mut all: HashMap<usize, Vec<Real>> = HashMap::new();
        // What they need that stands still is needed too.
        let wanted = (0..moving.len()).filter(|&b| moving[b] && self.cut.is_exact[b]);
        for b in self.cut.blocks.with_needs(wanted) {
            let block = &self.cut.blocks.blocks[b];
            let (u, used) = (block.unknowns[0], self.cut.used[block.equations[0]]);
            let mut right = self.rights_of(used, rights);
            let mut factor = 0;
            if let Used::Row(row) = used {
                let mut add = |v: usize, by: i32| {
                    if v == u {
                        factor += by;
                        return;
                    }
                    // By halves, as all products are.
                    let by = &Real::whole((-by).into()) / &Real::whole(2);
                    for (k, c) in all[&v].iter().enumerate() {
                        if k == right.len() {
                            right.push(Real::zero());
                        }
                        right[k] = &right[k] + &(&by * c);
                    }
                };
                for p in &self.cut.system.rows[row].products {
                    assert!(p.forms().contains(&Form::One), "an exact block is linear");
                    for (entry, sign) in p.forms().into_iter().flat_map(Form::entries) {
                        if let Some(v) = entry {
                            add(v, sign * p.factor);
                        }
                    }
                }
                let per = &Real::whole(2) / &Real::whole(factor.into());
                right.iter_mut().for_each(|c| *c = &*c * &per);
            }
            all.insert(u, right);
        }
        all.retain(|&u, _| moving[self.cut.blocks.of_unknown[u]]);
        all
    }

    /// Enclosures of the polynomials' coefficients, in the homotopy's unit.
    pub(super) fn paths(&self, exact: &HashMap<usize, Vec<Real>>) -> HashMap<usize, Vec<Interval>> {
        let path = |(&u, polynomial): (&usize, &Vec<Real>)| {
            let scale = self.cut.unit_of(u);
            (u, enclosed(polynomial, scale))
        };
        exact.iter().map(path).collect()
    }

    /// Whether unknowns are all known exactly, and some of them move.
    fn move_exactly(&self, of: &[usize], exact: &HashMap<usize, Vec<Real>>) -> bool {
        let is_exact = |u: &usize| self.cut.is_exact[self.cut.blocks.of_unknown[*u]];
        of.iter().all(is_exact) && of.iter().any(|u| exact.contains_key(u))
    }

    /// An unknown at a time: where its path is, or where it stands.
    fn place_at(
        &self,
        paths: &HashMap<usize, Vec<Interval>>,
        u: usize,
        time: Interval,
    ) -> Interval {
        match paths.get(&u) {
            Some(path) => value_at(path, time),
            None => self.figure.enclosure(u),
        }
    }

    /// The coordinates of a vector, from enclosures of unknowns.
    fn coordinates_of(&self, vector: &Nonzero, at: impl Fn(usize) -> Interval) -> Vec<Interval> {
        let value = |entry: Entry| entry.unknown().map_or(point(0.0), &at);
        let forms = vector.forms[..self.cut.problem.dimension].iter();
        forms.map(|form| form.value(value)).collect()
    }

    /// A vector that must not vanish and may do so in the figure.
    pub(super) fn vanished(&self, figure: &Figure) -> Option<Stop> {
        let mut vectors = self.cut.system.nonzero.iter();
        let vector = vectors.find(|vector| {
            let place = self.coordinates_of(vector, |u| figure.enclosure(u));
            place.iter().all(|x| x.contains(0.0))
        })?;
        let words = format!(
            "{} has no length in this figure, and so no direction that a constraint could be about",
            vector.name
        );
        Some(Stop::new(StopKind::Undefined, words))
    }

    /// A vector that must not vanish, of numbers that are known exactly, and may do so for some t between 0 and 1.
    /// (Others are in a part that is followed.)
    pub(super) fn vanishes_exactly(&self, exact: &HashMap<usize, Vec<Real>>) -> Option<String> {
        let paths = self.paths(exact);
        let mut vectors = self.cut.system.nonzero.iter();
        let vector = vectors.find(|vector| {
            let of: Vec<usize> = vector.unknowns(self.cut.problem.dimension).collect();
            if !self.move_exactly(&of, exact) {
                return false;
            }
            !pieces(1.0).all(|time| {
                let place = self.coordinates_of(vector, |u| self.place_at(&paths, u, time));
                place.iter().any(|x| !x.contains(0.0))
            })
        })?;
        Some(vector.name.clone())
    }

    /// Orientations of points all of whose coordinates are known exactly.
    pub(super) fn exact_orientations(
        &self,
        exact: &HashMap<usize, Vec<Real>>,
        upto: Interval,
    ) -> Vec<Orientation> {
        let d = self.cut.problem.dimension;
        let mut out = Vec::new();
        let paths = self.paths(exact);
        for points in &self.followed {
            let of: Vec<usize> = self.places(points, 0..d).collect();
            if !self.move_exactly(&of, exact) {
                continue;
            }
            let sign = |time: Interval| -> i8 {
                let at = |u: usize| self.place_at(&paths, u, time);
                let places = points.iter().map(|&p| self.place(p, point(0.0), at));
                let places: Vec<[Interval; 3]> = places.collect();
                sign_of(determinant(points.len(), |k| places[k]))
            };
            let first = sign(point(0.0));
            let lost = pieces(upto.sup())
                .find(|&time| sign(time) != first)
                .map(|time| (time.inf().max(0.0), time.sup()));
            out.push(Orientation {
                points: points.clone(),
                sign: first,
                lost: if first == 0 { None } else { lost },
            });
        }
        out
    }

    /// Lines and arcs all of whose coordinates are known exactly.
    pub(super) fn exact_segments(
        &self,
        exact: &HashMap<usize, Vec<Real>>,
        upto: Interval,
    ) -> Vec<Kept> {
        let paths = self.paths(exact);
        let mut out = Vec::new();
        for Segment {
            object,
            other,
            extent,
        } in &self.segments
        {
            let (points, radii) = (extent.points(), extent.radii());
            let of = self.unknowns_of_extent(extent);
            if !self.move_exactly(&of, exact) {
                continue;
            }
            let sign = |time: Interval| {
                let at = |u: usize| self.place_at(&paths, u, time);
                let place = |k: usize| match k.checked_sub(points.len()) {
                    None => self.place(points[k], point(0.0), at),
                    Some(k) => [at(radii[k]); 3],
                };
                extent.sign(place, sign_of)
            };
            let mut last = sign(point(0.0));
            let is_known = last != 0;
            let mut goes_on = |time: Interval| {
                let now = sign(time);
                let goes_on = extent.goes_with(last, now);
                if goes_on {
                    last = now;
                }
                goes_on
            };
            let lost = match is_known {
                true => first_uncertain((0.0, upto.sup()), DEEP, &mut goes_on),
                false => None,
            };
            out.push(Kept {
                object: *object,
                other: *other,
                sign: last,
                lost,
            });
        }
        out
    }

    /// How far figures are off what is looked at and is about numbers that are known exactly alone. (Others are in a part that is followed.)
    pub(super) fn exact_besides(
        &self,
        (exact, rights): (&HashMap<usize, Vec<Real>>, &[Vec<Real>]),
        upto: Interval,
    ) -> Vec<(usize, Off)> {
        let paths = self.paths(exact);
        let is_exact = |u: usize| self.cut.is_exact[self.cut.blocks.of_unknown[u]];
        let looked_at = self.looked_at.iter().copied();
        let alone = looked_at.filter(|&k| self.unknowns_of(k).all(is_exact));
        let off = alone.map(|k| {
            let row = self.cut.left_out(k);
            let right = enclosed(&rights[row.index], self.scale(row.index));
            let off = |time: Interval| {
                let at = |entry: Option<usize>| match entry.map(|u| (u, paths.get(&u))) {
                    None => Along::whole(0),
                    Some((_, Some(path))) => along(path, time),
                    Some((u, None)) => along(&[self.figure.enclosure(u)], time),
                };
                let left = row
                    .products
                    .iter()
                    .map(|p| Along::constant(0.5 * f64::from(p.factor)) * p.value(at));
                left.fold(Along::whole(0), |sum, term| sum + term) - along(&right, time)
            };
            // The mean value theorem.
            let mut look = |(a, b): (f64, f64)| {
                let middle = point(0.5 * (a + b));
                let (all, there) = (off(hull(a, b)), off(middle).value);
                let by_slope = there + all.slope * (hull(a, b) - middle);
                (all.value.intersection(by_slope), (a, b))
            };
            let mut found = Off::default();
            found.follow((0.0, upto.sup()), self.within(k, rights), &mut look);
            (k, found)
        });
        off.collect()
    }
}

/// A polynomial, by enclosures of its coefficients, and its slope for a range of times.
fn along(coefficients: &[Interval], time: Interval) -> Along {
    let slopes = coefficients.iter().enumerate().skip(1);
    let slopes: Vec<Interval> = slopes.map(|(k, c)| point(k as f64) * *c).collect();
    Along {
        value: value_at(coefficients, time),
        slope: value_at(&slopes, time),
    }
}

/// A range of times is cut into so many pieces, as a power of two, to tell where a line or arc vanishes.
const DEEP: u32 = 50;

/// The first piece of a range of times, of which there are 2 to the power of `depth` at most, on which something is not certain.
fn first_uncertain(
    (from, to): (f64, f64),
    depth: u32,
    is_certain: &mut impl FnMut(Interval) -> bool,
) -> Option<(f64, f64)> {
    if is_certain(hull(from, to)) {
        return None;
    }
    let half = 0.5 * (from + to);
    if depth == 0 || !(from < half && half < to) {
        return Some((from, to));
    }
    first_uncertain((from, half), depth - 1, is_certain)
        .or_else(|| first_uncertain((half, to), depth - 1, is_certain))
}

/// Enclosures of a polynomial's coefficients, divided by a power of two.
fn enclosed(polynomial: &[Real], scale: f64) -> Vec<Interval> {
    let per = point(1.0 / scale);
    polynomial.iter().map(|c| c.enclose() * per).collect()
}

/// The value of a polynomial by Horner's rule.
pub(super) fn value_at(coefficients: &[Interval], time: Interval) -> Interval {
    let terms = coefficients.iter().rev();
    terms.fold(point(0.0), |sum, c| sum * time + *c)
}

/// Intervals that cover the times from 0 to `end`. Multiples of 1/64 are floats, and products are rounded outwards.
fn pieces(end: f64) -> impl Iterator<Item = Interval> {
    const PIECES: u32 = 64;
    let at = |k: u32| f64::from(k) / f64::from(PIECES);
    (0..PIECES).map(move |k| hull(at(k), at(k + 1)) * point(end))
}

/// Whether a polynomial is positive on all of [0, 1].
pub(super) fn is_positive(polynomial: &[Real]) -> bool {
    let coefficients = enclosed(polynomial, 1.0);
    pieces(1.0).all(|time| value_at(&coefficients, time).inf() > 0.0)
}
