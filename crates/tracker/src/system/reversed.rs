//! Changes of signs; figures that may differ in nothing but the directions of lines and planes of their own.

use super::Homotopy;
use crate::constraint::Entry;
use crate::elimination::Echelon;
use crate::equations::{Ring, sign};
use crate::interval::{Interval, ZERO, checked, enclose, point, upper_half};
use crate::problem::{Problem, Shape, most_along};
use crate::residues::Residue;

/// An unknown that is in a range in all figures that are sought: by its sign, which it has from the sketch, or as the problem says.
#[derive(Debug, Clone)]
pub struct Held {
    /// The unknown.
    pub unknown: usize,
    /// All of its range, and perhaps a little more, as ends are rounded.
    pub range: Interval,
    /// What is in its range for certain.
    inner: Interval,
    /// Whether the ends are no part of it.
    is_open: bool,
}

impl Held {
    /// Whether a number of which this is an enclosure is in the range, if that is certain.
    pub fn admits(&self, x: Interval) -> Option<bool> {
        let (inner, outer) = (self.inner, self.range);
        let (is_in, is_out) = match self.is_open {
            true => (
                x.interior(inner),
                x.sup() <= outer.inf() || x.inf() >= outer.sup(),
            ),
            false => (x.subset(inner), x.disjoint(outer)),
        };
        (is_in || is_out).then_some(is_in)
    }
}

impl Homotopy {
    /// Whether the equations at t = 1 hold with these unknowns' signs changed wherever they hold without: each stays as it is, or
    /// changes its sign and has 0 on the right.
    pub fn keeps(&self, changes: &[bool]) -> bool {
        (0..self.equations).all(|e| {
            let sign = sign(&self.terms(e), |entry| entry.map(|i| changes[i]));
            sign.is_some_and(|reversed| !reversed || self.rights[e].at_target() == ZERO)
        })
    }

    /// Keeps, of the changes of sign with which a figure stays as it is and their sums, those with which the equations hold whatever their
    /// right-hand sides now are (where some of these were 0 and are ranges, fewer do), lengths stay positive, and these unknowns what they are.
    #[doc(hidden)]
    pub fn reduce_twins(&mut self, signed: &[(usize, bool)]) {
        let mut fixed = self.positive_unknowns();
        fixed.extend(signed.iter().map(|&(i, _)| i));
        let first = self.gauge.place.len();
        let mut echelon = Echelon::<Residue<2>>::new(self.equations);
        let mut basis = Vec::new();
        for twin in self.twins().unwrap_or_default() {
            let bits = twin.iter().map(|&change| Residue::whole(change.into()));
            let stays = !fixed.iter().any(|&i| twin[i]) && self.keeps(&twin);
            if stays && echelon.take(&mut bits.collect::<Vec<_>>()) {
                basis.push(twin[first..].to_vec());
            }
        }
        self.tail.twins = basis;
    }

    /// Whether two different solutions may be one figure: with the same points and radii, and with lines and planes of
    /// their own that are the same but run the other way in at least one place. Where such a reversal is one of the known
    /// changes of sign (`twins`, of which the callers see whether they lead from one solution to the other) this is
    /// false; it is true where constraints that seem to tell both directions apart may happen to hold with either.
    ///
    /// `apart(i, reversed)`: whether unknown i of the one solution, or with `reversed` its negative, is known to differ
    /// from that of the other. All other unknowns than the ones looked at here follow from these.
    pub fn may_be_reversed(
        &self,
        twins: &[Vec<bool>],
        apart: impl Fn(usize, bool) -> bool,
    ) -> bool {
        let first = self.gauge.place.len();
        if (0..first).any(|i| apart(i, false)) {
            return false;
        }
        // An unknown that shows the direction of an object, and whether that is reversed.
        let mut shown: Vec<(usize, bool)> = Vec::new();
        let mut either = false;
        for (shape, own) in self.shapes.iter().zip(&self.tail.objects) {
            let split = shape.split_direction(own, self.dimension);
            let [stay, turn] = split.unwrap_or([own, &[]]).map(|entries| -> Vec<usize> {
                let unknowns = entries.iter().filter_map(|entry| match *entry {
                    Entry::Unknown(u) => Some(first + u),
                    _ => None,
                });
                unknowns.collect()
            });
            if stay.iter().any(|&i| apart(i, false)) {
                return false;
            }
            if turn.is_empty() {
                continue;
            }
            let tells = |reversed: bool| turn.iter().find(|&&i| apart(i, reversed));
            match (tells(false), tells(true)) {
                (Some(_), Some(_)) => return false,
                (Some(&i), None) => shown.push((i, true)),
                (None, Some(&i)) => shown.push((i, false)),
                (None, None) => either = true,
            }
        }
        let is_shown = |twin: &Vec<bool>| shown.iter().all(|&(i, reversed)| twin[i] == reversed);
        either || shown.iter().any(|shown| shown.1) && !twins.iter().any(is_shown)
    }

    /// Whether a line or plane of its own has a direction that is unknown.
    pub fn has_directions(&self) -> bool {
        let mut objects = self.shapes.iter().zip(&self.tail.objects);
        objects.any(|(shape, own)| {
            let split = shape.split_direction(own, self.dimension);
            split.is_some_and(|[_, turn]| {
                let mut turn = turn.iter();
                turn.any(|entry| matches!(entry, Entry::Unknown(_)))
            })
        })
    }

    /// Lines and planes of their own, by number, whose direction none of the known changes of sign (`twins`) that `keeps` accepts
    /// reverses alone: constraints tell the two directions of each apart, a path keeps one of them by continuity, and zeros of
    /// the equations may have either.
    pub fn directed(&self, keeps: impl Fn(&[bool]) -> bool) -> Vec<usize> {
        let first = self.gauge.place.len();
        // Objects with directions of their own, and the unknowns of these.
        let mut own: Vec<(usize, Vec<usize>)> = Vec::new();
        for (object, entries) in self.tail.objects.iter().enumerate() {
            let split = self.shapes[object].split_direction(entries, self.dimension);
            let turn = split.map_or(&[][..], |[_, turn]| turn);
            if !turn.is_empty() {
                let unknowns = turn.iter().filter_map(|entry| match *entry {
                    Entry::Unknown(u) => Some(first + u),
                    _ => None,
                });
                own.push((object, unknowns.collect()));
            }
        }
        let twins = self.twins().unwrap_or_default();
        let alone = |object: usize| {
            twins.iter().any(|twin| {
                let reverses = |own: &Vec<usize>| own.iter().any(|&i| twin[i]);
                let mut reversed = own.iter().filter(|(_, own)| reverses(own));
                let first = reversed.next().map(|one| one.0);
                first == Some(object) && reversed.next().is_none() && keeps(twin)
            })
        };
        let objects = own.iter().map(|one| one.0);
        objects.filter(|&object| !alone(object)).collect()
    }

    /// The unknowns that have the sign that they have in the sketch, and whether that is negative: of each line or plane of its own
    /// that is fixed the component of its direction of which the equations know the square only. `Err`: the object of one
    /// whose sign in the sketch is not certain.
    pub fn fixed_signs(&self, problem: &Problem) -> Result<Vec<(usize, bool)>, usize> {
        let first = self.gauge.place.len();
        let mut signs = Vec::new();
        for object in problem.fixed_directions() {
            let shape = &problem.objects[object].shape;
            let split = shape.split_direction(&self.tail.objects[object], self.dimension);
            let component = shape
                .own_direction()
                .zip(split)
                .and_then(|(direction, [_, turn])| turn.get(most_along(direction)));
            let Some(&Entry::Unknown(u)) = component else {
                return Err(object);
            };
            let Some(sketch) = self.sketch_of_unknowns().nth(first + u) else {
                return Err(object);
            };
            match (sketch.inf() > 0.0, sketch.sup() < 0.0) {
                (true, _) => signs.push((first + u, false)),
                (_, true) => signs.push((first + u, true)),
                _ => return Err(object),
            }
        }
        Ok(signs)
    }

    /// What figures that are sought are held in: [these signs](Self::fixed_signs), and the ranges that unknowns are to be in.
    pub fn held(&self, problem: &Problem) -> Result<Vec<Held>, usize> {
        let signs = self.fixed_signs(problem)?.into_iter();
        let mut all: Vec<Held> = signs
            .map(|(unknown, is_negative)| {
                let half = upper_half();
                let range = if is_negative { -half } else { half };
                Held {
                    unknown,
                    range,
                    inner: range,
                    is_open: true,
                }
            })
            .collect();
        for (object, of) in problem.objects.iter().enumerate() {
            let Shape::Number { within, .. } = &of.shape else {
                continue;
            };
            if within.iter().all(Option::is_none) {
                continue;
            }
            let unknown = self.object_unknowns(object).next().ok_or(object)?;
            // The unit is a power of two.
            let unit = point(self.unit.powi(-self.power(unknown)));
            let [low, high] = within
                .each_ref()
                .map(|end| end.as_ref().map(|x| enclose(x) * unit));
            let between = |low: Option<f64>, high: Option<f64>| {
                let (low, high) = (
                    low.unwrap_or(f64::NEG_INFINITY),
                    high.unwrap_or(f64::INFINITY),
                );
                checked(low, high).unwrap_or(Interval::EMPTY)
            };
            all.push(Held {
                unknown,
                range: between(low.map(|x| x.inf()), high.map(|x| x.sup())),
                inner: between(low.map(|x| x.sup()), high.map(|x| x.inf())),
                is_open: false,
            });
        }
        Ok(all)
    }
}
