//! Limits cut into parts, where the figures of all choices together are too many for one test.

use super::family::{Family, Middle};
use crate::edit::{Limited, Part, Value};
use crate::interval::{Interval, point};
use crate::order::InOrder as _;
use crate::system::Homotopy;
use crate::track::Control;
use std::rc::Rc;

/// A part of the limits, and its figures.
pub(super) struct Piece {
    /// The part.
    pub part: Part,
    /// The figures.
    pub family: Rc<Family>,
}

/// All figures that a figure becomes as its dimensions go through their limits, exactly one for every choice.
///
/// Of two parts that have a side in common the figures on it are the same, if those of one choice on it are: they depend continuously on the
/// choice, and figures with the same choice do not come together where the Jacobian is regular.
pub(super) struct Proved {
    /// The equations.
    pub limited: Limited,
    /// The figure with the dimensions as they are given.
    pub nominal: Middle,
    /// The parts, which together are all choices.
    pub pieces: Vec<Piece>,
}

/// Why it is not proved that there is one figure for each choice.
pub(super) enum Failure {
    /// This part of the limits was not proved.
    Part(Part),
    /// The run was ended before.
    Interrupted,
}

/// So many parts are tried, where the equations are few.
const MOST: usize = 250;
/// Fewer where there are more: the cubes of their numbers add up to no more than this.
const MOST_WORK: usize = 100_000_000;

/// So many parts are tried of a figure with so many equations.
fn most(homotopy: &Homotopy) -> usize {
    (MOST_WORK / homotopy.equations.max(1).pow(3)).clamp(8, MOST)
}

/// What is being cut.
struct Cut<'c, 'a> {
    limited: &'c mut Limited,
    nominal: &'c Middle,
    left: usize,
    control: &'c Control<'a>,
}

impl Proved {
    /// Proves that there is one figure for every choice. The equations come back where it is not proved.
    pub fn new(limited: Limited, control: &Control) -> Result<Self, Box<(Limited, Failure)>> {
        let tries = most(limited.homotopy());
        Self::by(limited, tries, control)
    }

    /// Whether there is one figure for every choice, by one test.
    pub fn by_one_test(limited: Limited, control: &Control) -> bool {
        Self::by(limited, 1, control).is_ok()
    }

    /// The same with so many parts at most.
    fn by(
        mut limited: Limited,
        left: usize,
        control: &Control,
    ) -> Result<Self, Box<(Limited, Failure)>> {
        let Some(nominal) = Middle::at(limited.homotopy(), limited.centre().to_vec()) else {
            let all = limited.all.clone();
            return Err(Box::new((limited, Failure::Part(all))));
        };
        let all = limited.all.clone();
        let mut cut = Cut {
            limited: &mut limited,
            nominal: &nominal,
            left,
            control,
        };
        let pieces = match cut.pieces(all.clone()) {
            Err(failure) => return Err(Box::new((limited, failure))),
            Ok(pieces) => pieces,
        };
        let proved = Proved {
            limited,
            nominal,
            pieces,
        };
        match proved.has_nominal() {
            true => Ok(proved),
            false => Err(Box::new((proved.limited, Failure::Part(all)))),
        }
    }

    /// Boxes of all points of all figures, in the coordinates of the problem.
    pub fn bands(&self) -> Vec<[Interval; 3]> {
        let homotopy = self.limited.homotopy();
        let all = |i: usize| {
            let pieces = self.pieces.iter().map(|piece| piece.family.enclosure(i));
            let all = pieces.reduce(|all, one| all.convex_hull(one));
            all.unwrap_or(point(0.0)) * point(homotopy.unit)
        };
        let places = (0..homotopy.points).map(|p| homotopy.place(p, all));
        self.limited.put(&places.collect::<Vec<_>>())
    }

    /// For each of the limits by how much something grows, about, as that dimension goes through them, of which these are the derivatives by the
    /// unknowns in the figure with the dimensions as they are given.
    pub fn effects(&self, slopes: &[(usize, Interval)]) -> Vec<f64> {
        let m = self.limited.homotopy().equations;
        let weight = |e: usize| -> f64 {
            let terms = slopes.iter();
            terms
                .map(|(i, slope)| slope.mid() * self.nominal.inverse[i * m + e])
                .sum()
        };
        let of = |k: usize| {
            let grown = self.limited.first_order(k).into_iter();
            grown.map(|(e, x)| weight(e) * x.mid()).sum()
        };
        (0..self.limited.within.len()).map(of).collect()
    }

    /// Whether the figure with the dimensions as they are given is one of these.
    fn has_nominal(&self) -> bool {
        let mut pieces = self.pieces.iter();
        pieces.any(|piece| {
            self.limited.is_given_in(&piece.part) && self.limited.has_given(&piece.family)
        })
    }
}

impl Cut<'_, '_> {
    /// The figures of a part, cut where that has to be.
    fn pieces(&mut self, part: Part) -> Result<Vec<Piece>, Failure> {
        if self.control.is_interrupted() {
            return Err(Failure::Interrupted);
        }
        if self.left == 0 {
            return Err(Failure::Part(part));
        }
        self.left -= 1;
        if let Some(family) = self.limited.family(&part, self.nominal) {
            let family = Rc::new(family);
            return Ok(vec![Piece { part, family }]);
        }
        let Some((k, [low, high])) = self.limited.halves(&part, self.nominal) else {
            return Err(Failure::Part(part));
        };
        // A choice that both have, with all other dimensions at their least values.
        let mut common: Part = part
            .iter()
            .map(|[low, _]| [low.clone(), low.clone()])
            .collect();
        common[k] = [low[k][1].clone(), low[k][1].clone()];
        let mut pieces = self.pieces(low)?;
        let others = self.pieces(high)?;
        let mut each = pieces.iter().filter(|piece| is_in(&common, &piece.part));
        let is_one = each.any(|piece| {
            let Some((figure, rights)) = self.limited.figure_with(&common, &piece.family) else {
                return false;
            };
            let mut others = others.iter().filter(|other| is_in(&common, &other.part));
            others.any(|other| other.family.has(&figure, &rights))
        });
        if !is_one {
            return Err(Failure::Part(common));
        }
        pieces.extend(others);
        Ok(pieces)
    }
}

/// Whether all choices of one part are those of another.
pub(super) fn is_in(part: &Part, other: &Part) -> bool {
    part.iter().zip(other).all(|([low, high], [least, most])| {
        least.decimal.value() <= low.decimal.value() && high.decimal.value() <= most.decimal.value()
    })
}

impl Limited {
    /// The figures of a part, if it is proved that there is one for every choice, about the one that Newton's method comes to from a middle.
    pub(super) fn family(&self, part: &Part, from: &Middle) -> Option<Family> {
        let homotopy = self.homotopy();
        let rights = self.rights(part);
        let middle = from.led(homotopy, &rights)?;
        Family::prove(homotopy, middle, &rights)
    }

    /// The one figure of a family with a choice that is all of a part, and its right-hand sides.
    pub(super) fn figure_with(
        &self,
        choice: &Part,
        of: &Family,
    ) -> Option<(Vec<Interval>, Vec<Interval>)> {
        let rights = self.rights(choice);
        Some((of.figure(self.homotopy(), &rights)?, rights))
    }

    /// Whether the figure with the dimensions as they are given is one of a family's.
    fn has_given(&self, family: &Family) -> bool {
        let (figure, rights) = self.given();
        let is_here = || {
            let own = family.figure(self.homotopy(), &rights)?;
            // The figure's box has no other in it.
            let mut all = own.iter().zip(&figure);
            Some(all.all(|(own, known)| own.subset(*known)))
        };
        family.has(&figure, &rights) || is_here() == Some(true)
    }

    /// The dimension that moves the figure most, and the two halves of a part with that dimension cut.
    fn halves(&mut self, part: &Part, about: &Middle) -> Option<(usize, [Part; 2])> {
        let m = self.homotopy().equations;
        let moves = |k: usize| {
            let grown = self.growth(k, part);
            let of = |row: &[f64]| {
                grown
                    .iter()
                    .map(|(e, x)| row[*e] * x.mid())
                    .sum::<f64>()
                    .abs()
            };
            about.inverse.chunks(m.max(1)).map(of).fold(0.0, f64::max)
        };
        let mut all: Vec<(usize, f64)> = (0..part.len()).map(|k| (k, moves(k))).collect();
        all.order_by(|a, b| b.1.total_cmp(&a.1));
        let k = all.first()?.0;
        Some((k, self.halved(part, k)?))
    }

    /// The two halves of a part with a dimension cut.
    pub(super) fn halved(&mut self, part: &Part, k: usize) -> Option<[Part; 2]> {
        let [low, high] = &part[k];
        let middle = 0.5 * low.decimal.to_f64() + 0.5 * high.decimal.to_f64();
        let middle = format!("{middle}").parse().ok()?;
        let middle: Rc<Value> = self.value(k, middle).ok()?;
        let is_between = low.decimal.value() < middle.decimal.value()
            && middle.decimal.value() < high.decimal.value();
        is_between.then(|| {
            [1, 0].map(|end| {
                let mut half = part.clone();
                half[k][end] = middle.clone();
                half
            })
        })
    }
}
