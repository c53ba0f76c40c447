//! Which blocks hang together, and what their figures have to meet beyond the blocks' equations.

use crate::blocks::Verdict;
use crate::blocks::cut::Cut;
use crate::blocks::number::Number;
use crate::constraint::Entry;
use crate::equations::Form;
use crate::interval::Interval;
use crate::sets::Joined;
use std::collections::HashMap;

/// Blocks whose figures hang together, in order, with what is to be looked at once all of them are known.
#[derive(Default)]
pub(super) struct Part {
    pub blocks: Vec<usize>,
    /// Of the rows that were left out, by place.
    pub rows: Vec<usize>,
    /// Vectors that must not vanish, by place.
    pub vectors: Vec<usize>,
}

pub(super) fn parts_of(cut: &Cut, is_fixed: &[bool]) -> Vec<Part> {
    let count = is_fixed.len();
    // One more, for what is about fixed numbers alone.
    let mut sets = Joined::new(count + 1);
    let mut join = |of: &[usize]| {
        sets.join_all(of);
        of.first().copied().unwrap_or(count)
    };
    for b in (0..count).filter(|&b| !is_fixed[b]) {
        let needs = cut.blocks.blocks[b].needs.iter().copied();
        let mut of: Vec<usize> = needs.filter(|&need| !is_fixed[need]).collect();
        of.push(b);
        join(&of);
    }
    let blocks_of = |unknowns: &[usize]| -> Vec<usize> {
        let of = unknowns.iter().map(|&u| cut.blocks.of_unknown[u]);
        of.filter(|&b| !is_fixed[b]).collect()
    };
    let rows = cut.redundant.iter();
    let rows: Vec<usize> = rows
        .map(|&row| join(&blocks_of(&cut.system.rows[row].unknowns)))
        .collect();
    let vectors = cut.system.nonzero.iter();
    let vectors = vectors.map(|v| v.unknowns(cut.problem.dimension).collect::<Vec<_>>());
    let vectors: Vec<usize> = vectors
        .map(|unknowns| join(&blocks_of(&unknowns)))
        .collect();
    let mut parts: Vec<(usize, Part)> = Vec::new();
    let mut part_of = |b: usize| -> usize {
        let root = sets.of(b);
        let place = parts.iter().position(|(r, _)| *r == root);
        place.unwrap_or_else(|| {
            parts.push((root, Part::default()));
            parts.len() - 1
        })
    };
    let of_blocks: Vec<(usize, usize)> = (0..count)
        .filter(|&b| !is_fixed[b])
        .map(|b| (b, part_of(b)))
        .collect();
    let of_rows: Vec<usize> = rows.into_iter().map(&mut part_of).collect();
    let of_vectors: Vec<usize> = vectors.into_iter().map(&mut part_of).collect();
    for (b, part) in of_blocks {
        parts[part].1.blocks.push(b);
    }
    for (k, part) in of_rows.into_iter().enumerate() {
        parts[part].1.rows.push(k);
    }
    for (v, part) in of_vectors.into_iter().enumerate() {
        parts[part].1.vectors.push(v);
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

fn side(form: Form<Option<usize>>, values: &[Option<Number>]) -> Number {
    form.value(|entry| match entry {
        Some(u) => values[u].clone().expect("all numbers are known"),
        None => Number::halves(0),
    })
}

/// Whether a vector that must not vanish does so in a figure; `None` if that is not certain.
pub(super) fn vanishes(cut: &Cut, vector: usize, values: &[Option<Number>]) -> Option<bool> {
    let forms = cut.system.nonzero[vector].forms[..cut.problem.dimension].iter();
    let signs = forms.map(|form| side(form.map(Entry::unknown), values).sign());
    let signs: Vec<Option<i8>> = signs.collect();
    if signs.iter().any(|sign| matches!(sign, Some(1 | -1))) {
        return Some(false);
    }
    signs.iter().all(Option::is_some).then_some(true)
}

/// How a figure stands to a row that was left out.
pub(super) fn verdict(
    cut: &Cut,
    k: usize,
    values: &[Option<Number>],
    tolerance: Option<f64>,
) -> Verdict {
    let row = cut.left_out(k);
    let right = Number::of(&cut.at_target(row.index));
    let off = row
        .products
        .iter()
        .fold(Number::halves(0).minus(&right), |sum, p| {
            let product = side(p.left, values).times(&side(p.right, values));
            sum.plus(&Number::halves(p.factor.into()).times(&product))
        });
    let ruler = cut.ruler(k, tolerance);
    ruler.verdict(off.enclosure(), right.enclosure())
}

/// Whether two of these figures of a part may be one in which lines or planes of their own run the other way: all that
/// people see of a figure, points, radii, lines and planes, may be the same. `fixed`: the numbers of all other parts that
/// have one figure only.
pub(super) fn may_be_reversed(
    cut: &Cut,
    fixed: &[Option<Number>],
    figures: &[&[(usize, Number)]],
) -> bool {
    if cut.own.is_empty() {
        return false;
    }
    let enclosed = |figure: &&[(usize, Number)]| -> HashMap<usize, Interval> {
        let numbers = figure.iter();
        numbers
            .map(|(u, number)| (*u, number.enclosure()))
            .collect()
    };
    let figures: Vec<HashMap<usize, Interval>> = figures.iter().map(enclosed).collect();
    let seen: Vec<usize> = cut
        .system
        .coordinates
        .iter()
        .copied()
        .chain(cut.numbers.iter().flatten().copied())
        .chain(cut.own.iter().flat_map(|[stay, _]| stay.iter().copied()))
        .collect();
    let pairs = figures
        .iter()
        .enumerate()
        .flat_map(|(k, one)| figures[..k].iter().map(move |other| (one, other)));
    let mut alike = pairs.filter(|(one, other)| {
        let apart = |u: usize, reversed: bool| {
            let both = match (one.get(&u), other.get(&u)) {
                (Some(&x), Some(&y)) => Some((x, y)),
                // What is in another part stays.
                _ => fixed[u].as_ref().map(|x| (x.enclosure(), x.enclosure())),
            };
            both.is_some_and(|(x, y)| [x, -x][usize::from(reversed)].disjoint(y))
        };
        let same = |unknowns: &[usize], reversed| !unknowns.iter().any(|&u| apart(u, reversed));
        let mut objects = cut.own.iter().map(|[_, turn]| turn);
        same(&seen, false)
            && objects
                .clone()
                .all(|turn| same(turn, false) || same(turn, true))
            && objects.any(|turn| same(turn, true))
    });
    alike.next().is_some()
}
