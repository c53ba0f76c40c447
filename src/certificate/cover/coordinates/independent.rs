//! Equations that fall apart into parts, of whose zeros every combination is one.
//!
//! Unknowns of the *base* have as many equations of their own. All others are nodes of a graph, with one node more for the base and the number 0.
//! An equation is made of differences of entries, which are edges of it. If the edges of a part's equations have as many nodes less components as the part has
//! equations, and the edges of all parts join all nodes, then the differences of one part say nothing of those of another, and those of all of them say
//! where every unknown is, beside the base: in them, the equations are systems beside each other. So, where the base has one zero,
//!
//! - any zeros of the parts are together one of the whole;
//! - every figure has a zero in common, in the differences of a part, with one whose differences of the other parts are those of the first solution; as that one is in
//!   the space that is looked at, where some unknowns are not negative, this one is, too. The check looks at each part's zeros there (its *slice*), so that a
//!   figure is a combination of what is listed.
//!
//! Conditions on figures (what is positive, has a sign, or must not vanish) have to be about the differences of one part. The base is looked at by itself, in all of the
//! space: its matrix is a block of the whole matrix, which is regular where the first solution is alone, so that the base has one zero there.

use super::format::{Change, CoordinateCover, Independent};
use super::space::{Empty, Part};
use super::symmetry::signs_changed;
use super::{Place, Space};
use crate::certificate::checker::equations::{Equations, ZERO};
use crate::interval::{Interval, point};

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
    /// Those that a part's differences move, by its number.
    Part(usize),
}

/// Equations that fall apart.
pub struct Apart {
    in_base: Vec<bool>,
    /// For each part the entries of its differences, and the solutions that are the first one in all other parts.
    parts: Vec<(Vec<[usize; 2]>, Vec<usize>)>,
    /// For each part, for each unknown another one that it moves with in the part's slice, or itself; behind all of them stands the base.
    moved_with: Vec<Vec<usize>>,
    /// The slice that is looked at.
    pub slice: Slice,
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
            parts: Vec::new(),
            moved_with: Vec::new(),
            slice: Slice::Whole,
        };
        if cover.independent.is_empty() {
            return cover.base.is_empty().then_some(apart);
        }
        let edges: Vec<Vec<[usize; 2]>> = (0..eq.m)
            .map(|e| {
                let forms = eq.products[e].iter().flat_map(|(_, forms)| forms);
                forms.map(|&form| eq.forms[form]).collect()
            })
            .collect();
        let base = |e: &usize| edges[*e].iter().all(|edge| apart.edge(*edge) == [eq.m; 2]);
        let in_base = apart.in_base.iter().filter(|is| **is).count();
        // As many, each named once.
        let is_square = in_base == cover.base.len() && (0..eq.m).filter(base).count() == in_base;
        // Each equation is of the base or of one part, and each solution but the first of one part.
        let of_parts = || cover.independent.iter();
        let equations = of_parts().flat_map(|part| part.equations.iter().copied());
        let all = equations.chain((0..eq.m).filter(base));
        let figures = of_parts().flat_map(|part| part.figures.iter().copied());
        // No more parts than equations.
        let fits = is_square
            && of_parts().all(|part| !part.equations.is_empty())
            && is_each_once(all.collect(), eq.m)
            && is_each_once(figures.chain([0]).collect(), cover.figures.len())
            && cover.images.is_empty()
            && eq.homotopy.tail.twins.is_empty()
            && !eq.homotopy.has_directions();
        if !fits {
            return None;
        }
        let joined = |parts: &mut dyn Iterator<Item = &Independent>| {
            let mut joined = Joined((0..=eq.m).collect());
            let equations = parts.flat_map(|part| &part.equations);
            let of_equations = equations.flat_map(|&e| &edges[e]);
            let count = of_equations.filter(|edge| joined.join(apart.edge(**edge)));
            (count.count(), joined)
        };
        let nodes = eq.m - cover.base.len();
        let own: Vec<(usize, Joined)> = of_parts()
            .map(|part| joined(&mut [part].into_iter()))
            .collect();
        let mut counts = own.iter().zip(of_parts());
        let is_direct = counts.all(|((count, _), part)| *count == part.equations.len())
            && joined(&mut of_parts()).0 == nodes;
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
            let is_joined = |joined: &Joined| {
                let ends = condition.iter().filter(is_left);
                let mut ends = ends.map(|edge| apart.edge(*edge));
                ends.all(|[a, b]| joined.of(a) == joined.of(b))
            };
            own.iter().any(|(_, joined)| is_joined(joined))
        };
        if !(is_direct && conditions.iter().all(is_of_a_part)) {
            return None;
        }
        let moved_with = (0..own.len()).map(|k| {
            let others = of_parts().enumerate().filter(|(other, _)| *other != k);
            let (_, joined) = joined(&mut others.map(|(_, part)| part));
            (0..eq.m)
                .map(|i| joined.of(apart.edge([i, i])[0]))
                .collect()
        });
        apart.moved_with = moved_with.collect();
        let parts = of_parts().map(|part| {
            let edges = part.equations.iter().flat_map(|&e| edges[e].clone());
            let figures = [&[0], &part.figures[..]].concat();
            (edges.collect(), figures)
        });
        apart.parts = parts.collect();
        Some(apart)
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
        let parts = (0..self.parts.len()).map(Slice::Part);
        match (self.parts.is_empty(), self.in_base.contains(&true)) {
            (true, _) => vec![Slice::Whole],
            (false, true) => [Slice::Base].into_iter().chain(parts).collect(),
            (false, false) => parts.collect(),
        }
    }

    /// How many figures there are; `None` where that has no place in 64 bits.
    pub fn count(&self, figures: usize) -> Option<u64> {
        let mut parts = self.parts.iter();
        match self.parts.is_empty() {
            true => Some(figures as u64),
            false => parts.try_fold(1u64, |all, part| all.checked_mul(part.1.len() as u64)),
        }
    }

    /// Whether what is said of a part of the slice may be said with this solution; in the base, of its unknowns alone.
    pub fn takes(&self, figure: usize) -> bool {
        match self.slice {
            Slice::Whole => true,
            Slice::Base => figure == 0,
            Slice::Part(k) => self.parts[k].1.contains(&figure),
        }
    }

    /// Whether an unknown is looked at in the slice.
    pub fn is_looked_at(&self, i: usize) -> bool {
        self.slice != Slice::Base || self.in_base[i]
    }

    /// Narrows a part of the slice: all that the slice's differences do not move is where it is in the first solution, or moves with something else.
    pub fn narrow(&self, part: &mut Part, first: Option<&Place>) -> Result<(), Empty> {
        let (Slice::Part(k), Some(first)) = (self.slice, first) else {
            return Ok(());
        };
        let m = self.in_base.len();
        for (i, &with) in self.moved_with[k].iter().enumerate() {
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

    /// Whether the solutions of each part are surely different in its differences, all are in the space that is looked at and have the same base, and no combination is
    /// another one seen in a mirror.
    pub fn are_different(&self, space: &Space) -> bool {
        let m = self.in_base.len();
        let at = |figure: usize, i: usize| match i < m {
            true => space.figures[figure].spot.at(i),
            false => ZERO,
        };
        let value = |figure: usize, [a, b]: [usize; 2]| at(figure, a) - at(figure, b);
        let is_told = self.parts.iter().all(|(edges, figures)| {
            let differ = |one: usize, other: usize| {
                let mut edges = edges.iter();
                edges.any(|&edge| value(one, edge).disjoint(value(other, edge)))
            };
            let pairs = figures.iter().enumerate();
            let mut pairs =
                pairs.flat_map(|(k, &one)| figures[..k].iter().map(move |&other| (one, other)));
            pairs.all(|(one, other)| differ(one, other))
        });
        // Those of the base are the same in all of them.
        let is_based = |place: &Place| {
            let of = |i: usize| match self.in_base[i] {
                true => place.spot.at(i),
                false => space.figures[0].spot.at(i),
            };
            space.figures[0].covers(&(0..m).map(of).collect::<Vec<_>>())
        };
        // And all of them are in the space that is looked at.
        let is_inside = |place: &Place| {
            let mut not_negative = space.not_negative.iter();
            not_negative.all(|&i| place.spot.at(i).inf() >= 0.0)
        };
        let mut places = space.figures.iter();
        let is_told = is_told && places.all(|place| is_based(place) && is_inside(place));
        let mut changes = Change::all(space.eq.homotopy.dimension, 0)
            .filter_map(|by| signs_changed(&space.eq.homotopy, space.allowed, &by))
            .filter(|changes| changes.contains(&true));
        let sign = |x: Interval| (!x.contains(0.0)).then_some(x.inf() > 0.0);
        is_told
            && changes.all(|changes| {
                let mut base = (0..m).filter(|&i| self.in_base[i] && changes[i]);
                let of_base = base.any(|i| sign(at(0, i)).is_some());
                let mut parts = self.parts.iter();
                of_base
                    || parts.any(|(edges, figures)| {
                        let turn = |i: usize| changes.get(i).copied().unwrap_or(true);
                        let mut edges = edges.iter().filter(|[a, b]| turn(*a) && turn(*b));
                        edges.any(|&edge| {
                            let first = sign(value(0, edge));
                            let mut all = figures.iter().map(|&figure| sign(value(figure, edge)));
                            first.is_some() && all.all(|sign| sign == first)
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
