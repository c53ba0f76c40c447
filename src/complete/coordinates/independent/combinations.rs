//! What comes of the zeros of all parts.

use super::super::{Figures, MOST_FIGURES, entry};
use super::Parts;
use crate::certificate::cover::coordinates::{Change, signs_changed};
use crate::complete::parts::LISTED;
use crate::interval::{Interval, ZERO, hull, point};
use crate::system::Homotopy;
use crate::track::FigureBox;

impl Figures<'_> {
    /// Whether no combination is another one with axes reversed, where figures with reversed axes count once.
    pub(super) fn are_different(&self, parts: &Parts) -> bool {
        let (homotopy, m) = (self.homotopy, self.system.unknowns);
        let allowed = crate::constraint::symmetry(self.problem);
        let changes = Change::all(homotopy.dimension, 0)
            .filter_map(|by| signs_changed(homotopy, allowed, &by))
            .filter(|changes| changes.contains(&true));
        let at = |figure: usize, i: usize| match i < m {
            true => entry(&parts.representatives[figure], i),
            false => ZERO,
        };
        let sign = |x: Interval| (!x.contains(0.0)).then_some(x.inf() > 0.0);
        changes.into_iter().all(|changes| {
            let mut base = parts.base.iter();
            base.any(|&i| changes[i] && sign(at(0, i)).is_some())
                || parts.parts.iter().any(|part| {
                    let turn = |i: usize| changes.get(i).copied().unwrap_or(true);
                    let mut edges = part.equations.iter().flat_map(|&e| forms(homotopy, e));
                    edges.any(|[a, b]| {
                        let of = |figure: usize| sign(at(figure, a) - at(figure, b));
                        let mut others = part.figures.iter();
                        turn(a) && turn(b) && of(0).is_some() && others.all(|&k| of(k) == of(0))
                    })
                })
        })
    }

    /// Whether the boxes of any two combinations ([`Figures::combinations`]) are disjoint, however many there are: in a difference of a part in which they differ.
    pub(super) fn are_apart(&self, of: &Parts) -> bool {
        let m = self.system.unknowns;
        let at = |figure: usize, i: usize| entry(&of.representatives[figure], i);
        let moved = |figure: usize, i: usize| at(figure, i) - at(0, i);
        // No box is wider; twice that, for roundings.
        let width = |i: usize| {
            let each = of.parts.iter().map(|part| {
                let widths = part.figures.iter().map(|&figure| moved(figure, i).wid());
                widths.fold(0.0, f64::max)
            });
            point(at(0, i).wid()) + each.map(point).fold(ZERO, |sum, x| sum + x)
        };
        let widths: Vec<f64> = (0..m).map(|i| (point(2.0) * width(i)).sup()).collect();
        of.parts.iter().all(|part| {
            let all: Vec<usize> = [0]
                .into_iter()
                .chain(part.figures.iter().copied())
                .collect();
            let edges = part.equations.iter().flat_map(|&e| forms(self.homotopy, e));
            let edges: Vec<[usize; 2]> = edges.collect();
            let range = |figure: usize, [a, b]: [usize; 2]| {
                let end = |i: usize| match i < m {
                    true => at(figure, i) + hull(-widths[i], widths[i]),
                    false => ZERO,
                };
                end(a) - end(b)
            };
            let differ = |one: usize, other: usize| {
                let mut edges = edges.iter();
                edges.any(|&edge| range(one, edge).disjoint(range(other, edge)))
            };
            let mut pairs = (0..all.len()).flat_map(|k| (0..k).map(move |j| (k, j)));
            pairs.all(|(k, j)| differ(all[k], all[j]))
        })
    }

    /// The first combinations, or all if they are not too many, each in a box.
    pub(in crate::complete::coordinates) fn combinations(&self, of: &Parts) -> Vec<FigureBox> {
        let m = self.system.unknowns;
        let at = |figure: usize, i: usize| entry(&of.representatives[figure], i);
        let moved = |figure: usize, i: usize| at(figure, i) - at(0, i);
        let count = match of.count {
            Some(count) if count <= MOST_FIGURES as u64 => count as usize,
            _ => LISTED as usize,
        };
        let listed = (0..count).map(|number| {
            let mut number = number;
            let mut chosen: Vec<usize> = Vec::new();
            // The last part's zeros follow each other first.
            for part in of.parts.iter().rev() {
                let own = part.figures.len() + 1;
                chosen.extend((number % own).checked_sub(1).map(|k| part.figures[k]));
                number /= own;
            }
            let range = |i: usize| {
                let moves = chosen.iter().map(|&figure| moved(figure, i));
                moves.fold(at(0, i), |sum, x| sum + x)
            };
            match chosen[..] {
                [] => of.representatives[0].clone(),
                [one] => of.representatives[one].clone(),
                _ => FigureBox::around((0..m).map(range)),
            }
        });
        listed.collect()
    }
}

/// The entries of the differences in an equation.
fn forms(homotopy: &Homotopy, e: usize) -> Vec<[usize; 2]> {
    let terms = homotopy.terms(e).into_iter();
    terms
        .flat_map(|term| [term.left, term.right])
        .flatten()
        .collect()
}
