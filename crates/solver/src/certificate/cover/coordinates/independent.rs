//! Equations that fall apart into parts, of whose zeros every combination is one.
//!
//! Unknowns of the *base* have as many equations of their own. All others are nodes of a graph, with one node more for the base and the number 0.
//! An equation is made of differences of entries, which are edges of it. If the edges of a part's equations have as many nodes less components as the part has
//! equations, and the edges of all parts join all nodes, then the differences of one part say nothing of those of another, and those of all of them say
//! where every unknown is, beside the base: in them, the equations are systems beside each other. So, where the base is at one of its zeros (a *case*),
//!
//! - any zeros of the parts are together one of the whole;
//! - every figure has a zero in common, in the differences of a part, with one whose differences of the other parts are those of the case's first solution; as that one is in
//!   the space that is looked at, where some unknowns are not negative, this one is, too. The check looks at each part's zeros there (its *slice*), so that a
//!   figure is a combination of what is listed.
//!
//! Conditions on figures (what is positive, has a sign, or must not vanish) have to be about the differences of one part, or about the base. The base is looked at by itself, in all of the
//! space: its matrix is a block of the whole matrix, which is regular where a case's first solution is alone, so that the base has one zero there. So each figure's base is that of a
//! case, of one alone as these differ, and all figures are the combinations of all cases.
//!
//! Combinations that differ, differ in unknowns. They are different figures, as the points tell all auxiliary unknowns: lengths and radii are positive, and what has two signs is among the
//! twins of the problem or the directions that lines and planes have of their own, of which there have to be none.

use super::format::{Case, Change, CoordinateCover, Independent};
use super::space::{Empty, Part};
use super::symmetry::signs_changed;
use super::{Place, Space};
use crate::certificate::checker::equations::{Equations, ZERO};
use crate::interval::{Interval, point};
use std::rc::Rc;

/// The greatest number of cases, any two of which are compared.
const MOST_CASES: usize = 1024;

/// Sets of nodes that are joined: each node leads to another one of its set, or to itself.
struct Joined(Vec<usize>);

impl Joined {
    fn of(&self, mut node: usize) -> usize {
        while self.0[node] != node {
            node = self.0[node];
        }
        node
    }

    /// Joins the sets of two nodes; whether they were two.
    fn join(&mut self, [a, b]: [usize; 2]) -> bool {
        let [a, b] = [self.of(a), self.of(b)];
        // The last node, the base, stays the one that stands for its set.
        self.0[a.min(b)] = a.max(b);
        a != b
    }
}

/// What is looked at by itself.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Slice {
    /// All unknowns.
    Whole,
    /// Those of the base.
    Base,
    /// Those that a part's differences move, by the numbers of its case and its own.
    Part(usize, usize),
}

/// Equations that fall apart.
pub struct Apart {
    in_base: Vec<bool>,
    cases: Vec<One>,
    /// The slice that is looked at.
    pub slice: Slice,
}

/// A case.
struct One {
    first: usize,
    parts: Rc<[Edges]>,
    /// For each part the solutions that are the first one in all other parts, that one before all others.
    figures: Vec<Vec<usize>>,
}

/// The equations of a part.
struct Edges {
    /// The entries of their differences.
    own: Vec<[usize; 2]>,
    /// For each unknown another one that it moves with in the part's slice, or itself; behind all of them stands the base.
    moved_with: Vec<usize>,
}

impl Apart {
    /// Proves that the equations fall apart as a cover says.
    pub fn new(
        eq: &Equations,
        conditions: &[Vec<[usize; 2]>],
        cover: &CoordinateCover,
    ) -> Option<Apart> {
        let mut apart = Apart {
            in_base: (0..eq.m).map(|i| cover.base.contains(&i)).collect(),
            cases: Vec::new(),
            slice: Slice::Whole,
        };
        if cover.cases.is_empty() {
            return cover.base.is_empty().then_some(apart);
        }
        let of_parts = || cover.cases.iter().flat_map(|case| &case.parts);
        let figures = of_parts().flat_map(|part| part.figures.iter().copied());
        let firsts = cover.cases.iter().map(|case| case.first);
        // Each solution is of one part, but for the first ones of cases; unknowns of the base are named once.
        let fits = cover.cases.len() <= MOST_CASES
            && cover.base.len() == apart.in_base.iter().filter(|is| **is).count()
            && is_each_once(firsts.chain(figures).collect(), cover.figures.len())
            && cover.images.is_empty()
            && eq.homotopy.tail.twins.is_empty()
            && !eq.homotopy.has_directions();
        if !fits {
            return None;
        }
        let mut before: Option<(&Case, Rc<[Edges]>)> = None;
        for case in &cover.cases {
            let same = before.as_ref().filter(|(known, _)| {
                let mut pairs = known.parts.iter().zip(&case.parts);
                known.parts.len() == case.parts.len()
                    && pairs.all(|(a, b)| a.equations == b.equations)
            });
            let parts = match same {
                Some((_, parts)) => Rc::clone(parts),
                None => apart.parts(eq, conditions, &case.parts)?,
            };
            before = Some((case, Rc::clone(&parts)));
            let figures = case.parts.iter();
            let figures = figures.map(|part| [&[case.first], &part.figures[..]].concat());
            apart.cases.push(One {
                first: case.first,
                parts,
                figures: figures.collect(),
            });
        }
        Some(apart)
    }

    /// Proves that equations fall apart into these parts beside the base.
    fn parts(
        &self,
        eq: &Equations,
        conditions: &[Vec<[usize; 2]>],
        parts: &[Independent],
    ) -> Option<Rc<[Edges]>> {
        let edges: Vec<Vec<[usize; 2]>> = (0..eq.m)
            .map(|e| {
                let forms = eq.products[e].iter().flat_map(|(_, forms)| forms);
                forms.map(|&form| eq.forms[form]).collect()
            })
            .collect();
        let base = |e: &usize| edges[*e].iter().all(|edge| self.edge(*edge) == [eq.m; 2]);
        let in_base = self.in_base.iter().filter(|is| **is).count();
        let is_square = (0..eq.m).filter(base).count() == in_base;
        // Each equation is of the base or of one part.
        let equations = parts.iter().flat_map(|part| part.equations.iter().copied());
        let all = equations.chain((0..eq.m).filter(base));
        // No more parts than equations.
        let fits = is_square
            && parts.iter().all(|part| !part.equations.is_empty())
            && is_each_once(all.collect(), eq.m);
        if !fits {
            return None;
        }
        let joined = |parts: &mut dyn Iterator<Item = &Independent>| {
            let mut joined = Joined((0..=eq.m).collect());
            let equations = parts.flat_map(|part| &part.equations);
            let of_equations = equations.flat_map(|&e| &edges[e]);
            let count = of_equations.filter(|edge| joined.join(self.edge(**edge)));
            (count.count(), joined)
        };
        let nodes = eq.m - in_base;
        let own: Vec<(usize, Joined)> = parts
            .iter()
            .map(|part| joined(&mut [part].into_iter()))
            .collect();
        let mut counts = own.iter().zip(parts);
        let is_direct = counts.all(|((count, _), part)| *count == part.equations.len())
            && joined(&mut parts.iter()).0 == nodes;
        let mut same = Joined((0..=eq.m).collect());
        for e in 0..eq.m {
            let is_zero = eq.right_at(e, point(1.0))[0] == ZERO;
            if let ([(_, [form, one])], true) = (eq.products[e].as_slice(), is_zero)
                && eq.forms[*one] == [eq.m + 2, eq.m + 1]
            {
                same.join(eq.forms[*form].map(|i| i.min(eq.m)));
            }
        }
        let is_of_a_part = |condition: &Vec<[usize; 2]>| {
            // What is zero in all figures says nothing.
            let is_left = |edge: &&[usize; 2]| {
                let [a, b] = edge.map(|i| same.of(i.min(eq.m)));
                a != b
            };
            let mut left = condition.iter().filter(is_left);
            let of_base = |edge: &[usize; 2]| self.edge(*edge) == [eq.m; 2];
            let is_joined = |joined: &Joined| {
                let ends = condition.iter().filter(is_left);
                let mut ends = ends.map(|edge| self.edge(*edge));
                ends.all(|[a, b]| joined.of(a) == joined.of(b))
            };
            left.all(of_base) || own.iter().any(|(_, joined)| is_joined(joined))
        };
        if !(is_direct && conditions.iter().all(is_of_a_part)) {
            return None;
        }
        let told = parts.iter().enumerate().map(|(k, part)| {
            let others = parts.iter().enumerate().filter(|(other, _)| *other != k);
            let (_, joined) = joined(&mut others.map(|(_, part)| part));
            let moved_with = (0..eq.m).map(|i| joined.of(self.edge([i, i])[0]));
            Edges {
                own: part
                    .equations
                    .iter()
                    .flat_map(|&e| edges[e].clone())
                    .collect(),
                moved_with: moved_with.collect(),
            }
        });
        Some(told.collect())
    }

    /// The nodes of a difference.
    fn edge(&self, entries: [usize; 2]) -> [usize; 2] {
        let m = self.in_base.len();
        entries.map(|i| match self.in_base.get(i) {
            Some(false) => i,
            _ => m,
        })
    }

    /// The slices to be looked at, one after the other.
    pub fn slices(&self) -> Vec<Slice> {
        if self.cases.is_empty() {
            return vec![Slice::Whole];
        }
        let base = self.in_base.contains(&true).then_some(Slice::Base);
        let cases = self.cases.iter().enumerate();
        let parts =
            cases.flat_map(|(c, case)| (0..case.parts.len()).map(move |k| Slice::Part(c, k)));
        base.into_iter().chain(parts).collect()
    }

    /// How many figures there are; `None` where that has no place in 64 bits.
    pub fn count(&self, figures: usize) -> Option<u64> {
        let of_case = |case: &One| {
            let mut figures = case.figures.iter();
            figures.try_fold(1u64, |all, own| all.checked_mul(own.len() as u64))
        };
        let mut cases = self.cases.iter();
        match self.cases.is_empty() {
            true => Some(figures as u64),
            false => cases.try_fold(0u64, |all, case| all.checked_add(of_case(case)?)),
        }
    }

    /// Whether what is said of a part of the slice may be said with this solution; in the base, of its unknowns alone.
    pub fn takes(&self, figure: usize) -> bool {
        match self.slice {
            Slice::Whole => true,
            Slice::Base => self.cases.iter().any(|case| case.first == figure),
            Slice::Part(c, k) => self.cases[c].figures[k].contains(&figure),
        }
    }

    /// Whether an unknown is looked at in the slice.
    pub fn is_looked_at(&self, i: usize) -> bool {
        self.slice != Slice::Base || self.in_base[i]
    }

    /// Narrows a part of the slice: all that the slice's differences do not move is where it is in the case's first solution, or moves with something else.
    pub fn narrow(&self, part: &mut Part, figures: &[Place]) -> Result<(), Empty> {
        let Slice::Part(c, k) = self.slice else {
            return Ok(());
        };
        let first = &figures[self.cases[c].first];
        let m = self.in_base.len();
        for (i, &with) in self.cases[c].parts[k].moved_with.iter().enumerate() {
            let at = |i: usize| first.spot.at(i);
            if with == m {
                part.narrow(i, at(i))?;
            } else if with != i {
                let apart = at(i) - at(with);
                part.narrow(i, part.ranges()[with] + apart)?;
                part.narrow(with, part.ranges()[i] - apart)?;
            }
        }
        Ok(())
    }

    /// Whether the solutions of each part are surely different in its differences, all are in the space that is looked at, those of a case have the same base and those of
    /// different cases different ones, and no combination is another one seen in a mirror.
    pub fn are_different(&self, space: &Space) -> bool {
        let cases = || self.cases.iter();
        let pairs = cases().enumerate();
        let mut pairs = pairs.flat_map(|(c, case)| cases().take(c).map(move |other| (case, other)));
        let mut places = space.figures.iter();
        // All of them are in the space that is looked at.
        let is_inside = |place: &Place| {
            let mut not_negative = space.not_negative.iter();
            not_negative.all(|&i| place.spot.at(i).inf() >= 0.0)
        };
        places.all(is_inside)
            && cases().all(|case| self.is_told(case, space))
            && pairs.all(|(one, other)| self.differ(space, one, other, &|_| false))
            && self.are_no_images(space)
    }

    /// An entry in a solution.
    fn at(&self, space: &Space, figure: usize, i: usize) -> Interval {
        match i < self.in_base.len() {
            true => space.figures[figure].spot.at(i),
            false => ZERO,
        }
    }

    /// Whether any two solutions of a part of a case are different in its differences, and all have the case's base.
    fn is_told(&self, case: &One, space: &Space) -> bool {
        let m = self.in_base.len();
        let value = |figure: usize, [a, b]: [usize; 2]| {
            self.at(space, figure, a) - self.at(space, figure, b)
        };
        let first = &space.figures[case.first];
        let is_based = |&figure: &usize| {
            (0..m).all(|i| match self.in_base[i] {
                true => first.covers_at(i, space.figures[figure].spot.at(i)),
                false => first.covers_at(i, first.spot.at(i)),
            })
        };
        let mut parts = case.parts.iter().zip(&case.figures);
        parts.all(|(part, figures)| {
            let differ = |one: usize, other: usize| {
                let mut edges = part.own.iter();
                edges.any(|&edge| value(one, edge).disjoint(value(other, edge)))
            };
            let pairs = figures.iter().enumerate();
            let mut pairs =
                pairs.flat_map(|(k, &one)| figures[..k].iter().map(move |&other| (one, other)));
            figures.iter().all(is_based) && pairs.all(|(one, other)| differ(one, other))
        })
    }

    /// Whether the base is surely not in the same place in two cases, the signs of these unknowns being changed in one of them.
    fn differ(
        &self,
        space: &Space,
        one: &One,
        other: &One,
        turned: &dyn Fn(usize) -> bool,
    ) -> bool {
        let mut base = (0..self.in_base.len()).filter(|&i| self.in_base[i]);
        base.any(|i| {
            let x = self.at(space, one.first, i);
            let x = if turned(i) { -x } else { x };
            x.disjoint(self.at(space, other.first, i))
        })
    }

    /// Whether no combination, of any case, is another one seen in a mirror: some unknown of the base has another value then, or a difference that has the same sign in all of both
    /// cases the other one.
    fn are_no_images(&self, space: &Space) -> bool {
        let mut changes = Change::all(space.eq.homotopy.dimension, 0)
            .filter_map(|by| signs_changed(&space.eq.homotopy, space.allowed, &by))
            .filter(|changes| changes.contains(&true));
        let sign = |x: Interval| (!x.contains(0.0)).then_some(x.inf() > 0.0);
        changes.all(|changes| {
            let zero = space.eq.m + 1;
            let turn = |i: usize| changes.get(i).copied().unwrap_or(i == zero);
            // The differences of a case that are turned and have one sign in all of it.
            let signed = |case: &One| -> Vec<([usize; 2], bool)> {
                let parts = case.parts.iter().zip(&case.figures);
                let each = parts.flat_map(|(part, figures)| {
                    let edges = part.own.iter().filter(|[a, b]| turn(*a) && turn(*b));
                    edges.filter_map(|&[a, b]| {
                        let of = |figure: usize| {
                            sign(self.at(space, figure, a) - self.at(space, figure, b))
                        };
                        let all = of(figures[0])?;
                        let is_same = figures.iter().all(|&figure| of(figure) == Some(all));
                        is_same.then_some(([a, b], all))
                    })
                });
                let mut all: Vec<_> = each.collect();
                all.sort_unstable();
                all.dedup();
                all
            };
            let signed: Vec<_> = self.cases.iter().map(signed).collect();
            let cases = || self.cases.iter().zip(&signed);
            cases().enumerate().all(|(c, (one, of_one))| {
                cases().take(c + 1).all(|(other, of_other)| {
                    self.differ(space, one, other, &turn)
                        || of_one
                            .iter()
                            .any(|edge| of_other.binary_search(edge).is_ok())
                })
            })
        })
    }
}

/// Whether a list has each of so many numbers once.
fn is_each_once(mut list: Vec<usize>, count: usize) -> bool {
    list.sort_unstable();
    list.into_iter().eq(0..count)
}
