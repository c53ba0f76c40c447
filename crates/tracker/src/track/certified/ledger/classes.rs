//! The solutions in the end, with their classes of congruence.

use super::Ledger;
use crate::interval::rounding::round_up;
use crate::system::Homotopy;
use crate::track::certified::figures::FigureBox;
use crate::track::certified::solution::Same;
use crate::track::{Solution, Stop, StopKind};

impl Ledger {
    /// The solutions with their classes; the reason, if a claim about them could not be proved.
    pub fn solutions(&self, homotopy: &Homotopy) -> Result<Vec<Solution>, (Stop, Vec<Solution>)> {
        let mut reason = None;
        let relation = |one: &FigureBox, other: &FigureBox| is_congruent(homotopy, one, other);
        let classes = classes(&self.found, relation, |j, k, undecided| {
            let help = match undecided {
                Congruence::Reversed { .. } => {
                    "they may differ in nothing but the direction of a line or plane of its own, \
                     which are one figure; name points of it instead"
                }
                _ => "another reference may help",
            };
            let (found, other) = (&self.found[k], &self.found[j]);
            reason.get_or_insert(format!(
                "it could not be decided whether solutions {} and {}, known up to {:.1e}, \
                 are congruent; {help}",
                j + 1,
                k + 1,
                found.greatest_radius().max(other.greatest_radius()) * homotopy.unit
            ));
        });
        let all = self.found.iter().zip(&self.places).zip(classes);
        let solutions = all.map(|((found, &place), class)| Solution {
            place: Some(place),
            ..found.solution(homotopy, class)
        });
        let solutions = solutions.collect();
        match reason {
            None => Ok(solutions),
            Some(reason) => Err((Stop::new(StopKind::Undecided, reason), solutions)),
        }
    }
}

/// The class of each of some figures, counted from 0 in the order in which they first occur, and the first before it whose
/// mirror image it is. Pairs of which `relation` does not tell whether they are congruent are `undecided`.
pub fn classes(
    figures: &[FigureBox],
    relation: impl Fn(&FigureBox, &FigureBox) -> Congruence,
    mut undecided: impl FnMut(usize, usize, Congruence),
) -> Vec<(usize, Option<usize>)> {
    let mut classes: Vec<(usize, Option<usize>)> = Vec::new();
    for (k, figure) in figures.iter().enumerate() {
        let (mut class, mut mirror) = (None, None);
        for (j, other) in figures[..k].iter().enumerate() {
            match relation(figure, other) {
                Congruence::Yes { mirrored } => {
                    class = Some(classes[j].0);
                    mirror = mirror.or(mirrored.then_some(j));
                }
                Congruence::No => {}
                other => undecided(j, k, other),
            }
        }
        let next = classes.iter().map(|(class, _)| class + 1).max();
        classes.push((class.unwrap_or(next.unwrap_or(0)), mirror));
    }
    classes
}

/// What is proved of two different solutions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Congruence {
    /// They are congruent up to reflection: one is the mirror image of the other, or otherwise the other one moved.
    Yes { mirrored: bool },
    /// They are not.
    No,
    /// Neither could be proved.
    Unknown,
    /// Neither could be proved, as they may be one figure, or its mirror image, in which lines or planes of their own run
    /// the other way.
    Reversed { mirrored: bool },
}

/// Whether two different solutions are congruent up to reflection.
///
/// The isometries that keep the gauge change the signs of coordinates. The second reference
/// point's first coordinate and the third's second one tell which signs they must change;
/// that of the last coordinate is free, unless a constraint says which way round the figure is. Where
/// constraints fix the figure in its frame no isometry is left. Each of them goes with the changes of
/// sign that leave a figure as it is, of the directions of lines of their own. Figures that differ in such directions
/// alone are one to people, whether or not the change of sign is known as one: then nothing is said.
pub fn is_congruent(homotopy: &Homotopy, one: &FigureBox, other: &FigureBox) -> Congruence {
    let gauge = &homotopy.gauge;
    let mut turned = [false; 3];
    for (axis, &p) in gauge.reference.iter().skip(1).enumerate() {
        let i = gauge.variable[p * homotopy.dimension + axis];
        let side = |FigureBox { figure: s, .. }: &FigureBox| {
            let spread = round_up(s.radius[i] + s.low[i].abs(), 1);
            (s.centre[i].abs() > spread).then_some(s.centre[i] > 0.0)
        };
        match (side(one), side(other)) {
            (Some(a), Some(b)) => turned[axis] = a != b,
            _ => return Congruence::Unknown,
        }
    }
    let twins = homotopy.twins();
    // A motion first: a flat figure in space is its own mirror image.
    let odd = turned.iter().filter(|&&turned| turned).count() % 2 == 1;
    let last = match gauge.reference.is_empty() {
        true => &[false][..],
        false => &[odd, !odd][..],
    };
    for &last in last {
        turned[homotopy.dimension - 1] = last;
        let reversed = turned.iter().filter(|&&turned| turned).count();
        let mirrored = reversed % 2 == 1;
        if mirrored && !homotopy.tail.mirrors {
            continue;
        }
        let flips = |i: usize| {
            let flips =
                (0..homotopy.dimension).filter(|&axis| turned[axis] && homotopy.flips(i, axis));
            flips.count() % 2 == 1
        };
        let Some(twins) = &twins else {
            // They are too many to try all: figures differ where points do.
            if one.may_be(other, flips, gauge.place.len()) {
                return Congruence::Unknown;
            }
            continue;
        };
        for twin in twins {
            // Without any change of sign they are known to differ.
            if reversed == 0 && !twin.contains(&true) {
                continue;
            }
            match one.is_same(other, |i| flips(i) ^ twin[i]) {
                Same::No => {}
                Same::Unknown => return Congruence::Unknown,
                Same::Yes => return Congruence::Yes { mirrored },
            }
        }
        let apart = |i: usize, reversed: bool| one.differs(other, i, flips(i) ^ reversed);
        if homotopy.may_be_reversed(twins, apart) {
            return Congruence::Reversed { mirrored };
        }
    }
    Congruence::No
}
