//! What comes of the zeros of all parts.

use super::super::{Figures, MOST_FIGURES, entry};
use super::{One, Parts, forms};
use crate::certificate::cover::coordinates::{Change, signs_changed};
use crate::complete::parts::LISTED;
use crate::interval::{Interval, ZERO};
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

    /// The first combinations, or all if they are not too many, each in a box. `None`: it is not certain that these are disjoint, and that none holds another combination.
    pub(super) fn combinations(&self, of: &Parts) -> Option<Vec<FigureBox>> {
        let m = self.system.unknowns;
        let at = |figure: usize, i: usize| entry(&of.representatives[figure], i);
        let moved = |figure: usize, i: usize| at(figure, i) - at(0, i);
        let count = match of.count {
            Some(count) if count <= MOST_FIGURES as u64 => count as usize,
            _ => LISTED as usize,
        };
        // For each part the zero that it has.
        let chosen = (0..count).map(|mut number| {
            // The last part's zeros follow each other first.
            let zeros = of.parts.iter().rev().map(|part| {
                let own = part.figures.len() + 1;
                let zero = number % own;
                number /= own;
                zero
            });
            let mut zeros: Vec<usize> = zeros.collect();
            zeros.reverse();
            zeros
        });
        let chosen: Vec<Vec<usize>> = chosen.collect();
        let listed = chosen.iter().map(|zeros| {
            let other = |(part, &zero): (&One, &usize)| Some(part.figures[zero.checked_sub(1)?]);
            let others: Vec<usize> = of.parts.iter().zip(zeros).rev().filter_map(other).collect();
            let range = |i: usize| {
                let moves = others.iter().map(|&figure| moved(figure, i));
                moves.fold(at(0, i), |sum, x| sum + x)
            };
            match others[..] {
                [] => of.representatives[0].clone(),
                [one] => of.representatives[one].clone(),
                _ => FigureBox::around((0..m).map(range)),
            }
        });
        let listed: Vec<FigureBox> = listed.collect();
        let mut numbers = 0..of.parts.len();
        numbers
            .all(|k| self.are_apart(of, k, (&chosen, &listed)))
            .then_some(listed)
    }

    /// Whether boxes with different zeros of a part are disjoint, and none holds a combination with another one: a difference of the part tells any two zeros
    /// apart, wherever in the boxes it is taken.
    fn are_apart(
        &self,
        of: &Parts,
        k: usize,
        (chosen, listed): (&[Vec<usize>], &[FigureBox]),
    ) -> bool {
        let m = self.system.unknowns;
        let part = &of.parts[k];
        let edges = part.equations.iter();
        let edges: Vec<[usize; 2]> = edges.flat_map(|&e| forms(self.homotopy, e)).collect();
        let values = |figure: &FigureBox| -> Vec<Interval> {
            let at = |i: usize| if i < m { entry(figure, i) } else { ZERO };
            edges.iter().map(|&[a, b]| at(a) - at(b)).collect()
        };
        let own = [0].into_iter().chain(part.figures.iter().copied());
        let own = own.map(|figure| values(&of.representatives[figure]));
        let mut of_zeros: Vec<Vec<Interval>> = own.collect();
        for (zeros, figure) in chosen.iter().zip(listed) {
            let known = of_zeros[zeros[k]].iter_mut();
            known
                .zip(values(figure))
                .for_each(|(x, y)| *x = x.convex_hull(y));
        }
        let differ = |one: &[Interval], other: &[Interval]| {
            let mut pairs = one.iter().zip(other);
            pairs.any(|(x, y)| x.disjoint(*y))
        };
        let mut pairs = (0..of_zeros.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.all(|(i, j)| differ(&of_zeros[i], &of_zeros[j]))
    }
}
