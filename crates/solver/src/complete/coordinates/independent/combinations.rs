//! What comes of the zeros of all parts.

use super::super::{Figures, MOST_FIGURES};
use super::{Case, One, Parts, forms};
use crate::certificate::cover::coordinates::{Change, signs_changed};
use crate::complete::parts::LISTED;
use crate::interval::{Interval, ZERO};
use crate::places::Each as _;
use crate::track::FigureBox;

impl Figures<'_> {
    /// An entry of a representative.
    fn entry_of(&self, of: &Parts, figure: usize, i: usize) -> Interval {
        match i < self.system.unknowns {
            true => of.representatives[figure].figure.enclosure(i),
            false => ZERO,
        }
    }

    /// Whether no combination is another one, of another case or with axes reversed, where figures with reversed axes count once.
    pub(super) fn are_different(&self, parts: &Parts) -> bool {
        let (homotopy, m) = (self.homotopy, self.system.unknowns);
        let allowed = crate::constraint::symmetry(self.problem);
        let mut changes = Change::all(homotopy.dimension, 0)
            .filter_map(|by| signs_changed(homotopy, allowed, &by))
            .filter(|changes| changes.contains(&true));
        let sign = |x: Interval| (!x.contains(0.0)).then_some(x.inf() > 0.0);
        // Whether the base is not in the same place in two cases, with these signs changed in one of them.
        let differ = |one: &Case, other: &Case, turn: &dyn Fn(usize) -> bool| {
            let mut base = parts.base.iter();
            base.any(|&i| {
                let [x, y] = [one, other].each(|case| self.entry_of(parts, case.first, i));
                (if turn(i) { -x } else { x }).disjoint(y)
            })
        };
        let cases = || parts.cases.iter();
        let all = cases().enumerate();
        let mut pairs = all.flat_map(|(c, case)| cases().take(c).map(move |other| (case, other)));
        pairs.all(|(one, other)| differ(one, other, &|_| false))
            && changes.all(|changes| {
                let turn = |i: usize| changes.get(i).copied().unwrap_or(i > m);
                // The differences of a case that are turned and have one sign in all of it.
                let signed = |case: &Case| {
                    let each = case.parts.iter().flat_map(|part| {
                        let edges = part.equations.iter().flat_map(|&e| forms(homotopy, e));
                        let edges = edges.filter(|&[a, b]| turn(a) && turn(b));
                        edges.filter_map(|[a, b]| {
                            let of = |figure: usize| {
                                let [x, y] = [a, b].each(|i| self.entry_of(parts, figure, i));
                                sign(x - y)
                            };
                            let all = of(case.first)?;
                            let mut others = part.figures.iter();
                            let is_same = others.all(|&figure| of(figure) == Some(all));
                            is_same.then_some(([a, b], all))
                        })
                    });
                    let mut all: Vec<_> = each.collect();
                    all.sort_unstable();
                    all
                };
                let signed: Vec<_> = cases().map(signed).collect();
                let with = || cases().zip(&signed);
                with().enumerate().all(|(c, (one, of_one))| {
                    with().take(c + 1).all(|(other, of_other)| {
                        let mut of_one = of_one.iter();
                        differ(one, other, &turn)
                            || of_one.any(|edge| of_other.binary_search(edge).is_ok())
                    })
                })
            })
    }

    /// The first combinations, or all if they are not too many, each in a box. `None`: it is not certain that these are disjoint, and that none holds another combination.
    pub(super) fn combinations(&self, of: &Parts) -> Option<Vec<FigureBox>> {
        let most = match of.count {
            Some(count) if count <= MOST_FIGURES as u64 => MOST_FIGURES,
            _ => LISTED as usize,
        };
        let mut all = Vec::new();
        let mut bases: Vec<Vec<Interval>> = Vec::new();
        for case in &of.cases {
            let count = case.count().map_or(usize::MAX, |count| count as usize);
            let chosen = chosen(case, count.min(most - all.len()));
            let listed = self.listed(of, case, &chosen);
            let mut numbers = 0..case.parts.len();
            if !numbers.all(|k| self.are_apart(of, (case, k), (&chosen, &listed))) {
                return None;
            }
            // Nor does a box hold one of another case: the base is elsewhere.
            let base = of.base.iter().map(|&i| {
                let first = self.entry_of(of, case.first, i);
                let boxes = listed.iter().map(|figure| figure.figure.enclosure(i));
                boxes.fold(first, |hull, x| hull.convex_hull(x))
            });
            let base: Vec<Interval> = base.collect();
            let differs = |known: &Vec<Interval>| {
                let mut pairs = known.iter().zip(&base);
                pairs.any(|(x, y)| x.disjoint(*y))
            };
            if !bases.iter().all(differs) {
                return None;
            }
            bases.push(base);
            all.extend(listed);
        }
        Some(all)
    }

    /// Combinations of a case, each in a box.
    fn listed(&self, of: &Parts, case: &Case, chosen: &[Vec<usize>]) -> Vec<FigureBox> {
        let m = self.system.unknowns;
        let at = |figure: usize, i: usize| of.representatives[figure].figure.enclosure(i);
        let moved = |figure: usize, i: usize| at(figure, i) - at(case.first, i);
        let listed = chosen.iter().map(|zeros| {
            let other = |(part, &zero): (&One, &usize)| Some(part.figures[zero.checked_sub(1)?]);
            let others = case.parts.iter().zip(zeros).rev().filter_map(other);
            let others: Vec<usize> = others.collect();
            let range = |i: usize| {
                let moves = others.iter().map(|&figure| moved(figure, i));
                moves.fold(at(case.first, i), |sum, x| sum + x)
            };
            match others[..] {
                [] => of.representatives[case.first].clone(),
                [one] => of.representatives[one].clone(),
                _ => FigureBox::around((0..m).map(range)),
            }
        });
        listed.collect()
    }

    /// Whether boxes with different zeros of a part are disjoint, and none holds a combination with another one: a difference of the part tells any two zeros
    /// apart, wherever in the boxes it is taken.
    fn are_apart(
        &self,
        of: &Parts,
        (case, k): (&Case, usize),
        (chosen, listed): (&[Vec<usize>], &[FigureBox]),
    ) -> bool {
        let m = self.system.unknowns;
        let part = &case.parts[k];
        let edges = part.equations.iter();
        let edges: Vec<[usize; 2]> = edges.flat_map(|&e| forms(self.homotopy, e)).collect();
        let values = |figure: &FigureBox| -> Vec<Interval> {
            let at = |i: usize| {
                if i < m {
                    figure.figure.enclosure(i)
                } else {
                    ZERO
                }
            };
            edges.iter().map(|&[a, b]| at(a) - at(b)).collect()
        };
        let own = [case.first].into_iter().chain(part.figures.iter().copied());
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

/// The first combinations of a case: for each part the zero that it has, the last part's zeros following each other first.
fn chosen(case: &Case, count: usize) -> Vec<Vec<usize>> {
    let chosen = (0..count).map(|mut number| {
        let zeros = case.parts.iter().rev().map(|part| {
            let own = part.figures.len() + 1;
            let zero = number % own;
            number /= own;
            zero
        });
        let mut zeros: Vec<usize> = zeros.collect();
        zeros.reverse();
        zeros
    });
    chosen.collect()
}
