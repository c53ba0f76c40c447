//! The least and the greatest that something measured can be.
//!
//! Where it is certain over all figures of a part which way it goes with a dimension, it is greatest at an end of that dimension's limits. What
//! is left of the part is one figure, or it is cut in a dimension of which that is not certain; parts that cannot have more than is reached
//! already are left out.

use super::family::{Family, sum};
use super::parts::{Piece, Proved, is_in};
use super::slopes;
use crate::edit::{Limited, Part};
use crate::interval::{Interval, hull, point};
use crate::problem::Decimal;
use crate::system::Quantity;
use crate::track::Control;
use std::rc::Rc;

/// A bound of the keys of something measured, and a figure that comes near to it.
pub(super) struct Extreme {
    /// No figure goes beyond.
    pub outer: f64,
    /// A figure goes at least so far.
    pub inner: f64,
    /// The values of the dimensions with limits at which it does.
    pub corner: Vec<Decimal>,
}

/// A part of the limits that is still to be looked at.
struct Open {
    part: Part,
    family: Rc<Family>,
    /// No figure of it goes beyond, with the sign of the side.
    bound: f64,
    /// Nothing better is to be had.
    is_done: bool,
}

/// Whatever is measured: of figures of these, near this key.
pub(super) struct Measure<'a> {
    pub quantity: &'a Quantity,
    pub near: f64,
    /// So many products of numbers, about, may be made for each of its bounds.
    pub work: usize,
}

/// Which way something goes with the dimensions of a part.
struct Ways {
    /// The part, with each dimension of which that is certain at the end where it is greatest.
    part: Part,
    /// Where all are at the end where it is greatest, about.
    corner: Part,
    /// The dimension of which it is not certain that may do most, and how much; `None`: it is of each.
    unsure: Option<(usize, f64)>,
    /// How much more than at the corner there may be.
    slack: f64,
}

impl Measure<'_> {
    /// The derivatives of the key by the unknowns, over all figures of a family and all between them and the middle.
    fn slopes(&self, limited: &Limited, family: &Family) -> Vec<(usize, Interval)> {
        let near = |i: usize| family.near(i);
        slopes(limited.homotopy(), self.quantity, near, self.near)
    }

    /// The key over all figures of a family; of an angle at points that may come together, everything.
    pub fn over(&self, limited: &Limited, family: &Family) -> Interval {
        let homotopy = limited.homotopy();
        let place =
            |at: &dyn Fn(usize) -> Interval| self.quantity.key(&homotopy.seen(at), self.near);
        let middle = place(&|i| point(family.middle.centre[i]));
        let by_slopes = middle + family.change(&self.slopes(limited, family));
        let directly = place(&|i| family.enclosure(i));
        match by_slopes.wid().is_finite() {
            true => by_slopes.intersection(directly),
            false if self.quantity.is_in_degrees() => hull(f64::MIN, f64::MAX),
            false => directly,
        }
    }
}

impl Proved {
    /// The greatest key, or the least, over all choices within limits; `keys`: the key over the figures of each piece, `range`: about how far apart
    /// the two are.
    pub(super) fn extreme(
        &mut self,
        (measure, keys): (&Measure, &[Interval]),
        greatest: bool,
        range: f64,
        control: &Control,
    ) -> Extreme {
        /// What is reached is so near to what is possible, of the range.
        const NEAR: f64 = 0.004;
        /// Where all dimensions of which it is not certain which way it goes may do so many times as much together as one, none is cut.
        const MANY: f64 = 8.0;
        /// So many parts are looked at.
        const MOST: usize = 400;
        let sign = if greatest { 1.0 } else { -1.0 };
        let upper = |key: Interval| match if greatest { key.sup() } else { -key.inf() } {
            // Nothing is known then.
            end if end.is_nan() => f64::INFINITY,
            end => end,
        };
        let lower = |key: Interval| if greatest { key.inf() } else { -key.sup() };
        let work = self.pieces.iter().map(|piece| piece.family.work()).max();
        let mut left = (measure.work / work.unwrap_or(0).max(1)).clamp(1, MOST);
        let mut best = Extreme {
            outer: f64::NEG_INFINITY,
            inner: f64::NEG_INFINITY,
            corner: Vec::new(),
        };
        let mut open = Vec::new();
        for (Piece { part, family }, key) in self.pieces.iter().zip(keys) {
            let clipped = clipped(part, &self.limited.within);
            open.extend(clipped.map(|part| Open {
                bound: upper(*key),
                family: family.clone(),
                part,
                is_done: false,
            }));
        }
        let limited = &mut self.limited;
        loop {
            let all = open.iter().enumerate();
            let top = all.max_by(|a, b| a.1.bound.total_cmp(&b.1.bound));
            let Some(at) = top.map(|(at, _)| at) else {
                best.outer = best.inner;
                break;
            };
            let top = open.swap_remove(at);
            best.outer = top.bound;
            if top.is_done || top.bound <= best.inner || left == 0 || control.is_interrupted() {
                break;
            }
            let slopes = measure.slopes(limited, &top.family);
            let Ways {
                part,
                corner,
                unsure,
                slack,
            } = limited.ways(&top, &slopes, sign);
            left -= 1;
            if let Some((figure, _)) = limited.figure_with(&corner, &top.family) {
                let homotopy = limited.homotopy();
                let seen = homotopy.seen(|i| figure[i]);
                let key = measure.quantity.key(&seen, measure.near);
                if lower(key) > best.inner {
                    best.inner = lower(key);
                    best.corner = corner.iter().map(|[low, _]| low.decimal.clone()).collect();
                }
                let bound = (upper(key) + slack).next_up().min(top.bound);
                if unsure.is_none() || left == 0 || bound <= best.inner + NEAR * range {
                    open.push(Open {
                        bound,
                        is_done: true,
                        ..top
                    });
                    continue;
                }
            }
            if top.bound <= best.inner + NEAR * range {
                break;
            }
            let parts = match unsure {
                _ if !is_in(&top.part, &part) => vec![part],
                // Where many dimensions are unsure alike, halves of one are as the whole.
                Some((k, most)) if most.is_infinite() || slack < MANY * most => {
                    limited.halved(&part, k).map_or(Vec::new(), Vec::from)
                }
                _ => Vec::new(),
            };
            let families: Option<Vec<Open>> = parts
                .into_iter()
                .map(|part| {
                    let family = limited.narrower(&part, &top.family)?;
                    let bound = upper(measure.over(limited, &family)).min(top.bound);
                    Some(Open {
                        part,
                        family: Rc::new(family),
                        bound,
                        is_done: false,
                    })
                })
                .collect();
            match families {
                Some(families) if !families.is_empty() => open.extend(families),
                _ => open.push(Open {
                    is_done: true,
                    ..top
                }),
            }
        }
        Extreme {
            outer: sign * best.outer.max(best.inner),
            inner: sign * best.inner,
            corner: best.corner,
        }
    }
}

impl Limited {
    /// Which way `sign` times something goes, of which these are the derivatives by the unknowns.
    fn ways(&self, of: &Open, slopes: &[(usize, Interval)], sign: f64) -> Ways {
        let mut ways = Ways {
            part: of.part.clone(),
            corner: of.part.clone(),
            unsure: None,
            slack: 0.0,
        };
        let speeds = of.family.speeds(slopes);
        for (k, ends) in of.part.iter().enumerate() {
            if ends[0].decimal.value() == ends[1].decimal.value() {
                continue;
            }
            let grown = self.growth(k, &of.part).into_iter();
            let changes = grown.map(|(e, grown)| point(sign) * grown * speeds[e]);
            let mut changes: Vec<Interval> = changes.collect();
            if self.is_turn(k) {
                // Its derivative: cosine and sine go together.
                changes = vec![sum(changes.into_iter())];
            }
            let about: f64 = changes.iter().map(|x| x.mid()).sum();
            let end = usize::from(about > 0.0);
            ways.corner[k] = [ends[end].clone(), ends[end].clone()];
            let is_certain =
                changes.iter().all(|x| x.inf() >= 0.0) || changes.iter().all(|x| x.sup() <= 0.0);
            if is_certain {
                ways.part[k] = ways.corner[k].clone();
                continue;
            }
            // What the other way gives.
            for x in &changes {
                let more = if end == 1 { -x.inf() } else { x.sup() };
                let more = if more.is_nan() { f64::INFINITY } else { more };
                ways.slack = (ways.slack + more.max(0.0)).next_up();
            }
            let size = changes.iter().map(|x| x.mag()).sum();
            if ways.unsure.is_none_or(|(_, most)| size > most) {
                ways.unsure = Some((k, size));
            }
        }
        ways
    }

    /// The figures of a part of a family's choices.
    fn narrower(&self, part: &Part, family: &Family) -> Option<Family> {
        let found = self.family(part, &family.middle)?;
        // As one figure is the family's, with a choice that is a corner, all are.
        let corner: Part = part
            .iter()
            .map(|[low, _]| [low.clone(), low.clone()])
            .collect();
        let (figure, rights) = self.figure_with(&corner, family)?;
        found.has(&figure, &rights).then(|| found.part_of(family))
    }
}

/// What parts have in common.
fn clipped(part: &Part, other: &Part) -> Option<Part> {
    let each = part.iter().zip(other);
    let each = each.map(|([low, high], [least, most])| {
        let value = |x: &Rc<crate::edit::Value>| x.decimal.value().clone();
        let low = if value(low) < value(least) {
            least
        } else {
            low
        };
        let high = if value(high) > value(most) {
            most
        } else {
            high
        };
        (value(low) <= value(high)).then(|| [low.clone(), high.clone()])
    });
    let part: Part = each.collect::<Option<_>>()?;
    Some(part)
}
