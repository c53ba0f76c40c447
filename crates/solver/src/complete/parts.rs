//! Problems of distances that fall apart: every part is searched by itself, and all figures of the whole are made of theirs.
//!
//! The parts share no more than a side (in space a triangle of sides) of given lengths ([`clusters`]). Where the set of a part
//! is complete, every figure of the whole shows one of its figures there, or its mirror image; the other way round a figure of
//! one part fits to one of the next by exactly one motion, as it is or mirrored in the side. The figures of parts are regular, hence not
//! in one line (plane), so that mirroring a part at a side changes the whole: all combinations are different figures. How
//! many there are is a product, however large.

use super::outcome::{Method, are_apart};
use super::surplus::Tested;
use super::{Complete, Options, Part, Status, Unserved, Why, all, exact};
use crate::blocks::{Combined, LeftOut, clusters};
use crate::order::InOrder;
use crate::problem::{Orientation, Problem};
use crate::track::{Signed, Signs, Solution};
use std::time::Instant;

/// The figures of the whole that are listed at most.
pub(super) const LISTED: u64 = 1000;

/// The figures that are looked at one by one, at most, where signs are asked for of points that are in no part together.
const LOOKED_AT: u64 = 20_000;

/// A part that was searched by itself.
#[derive(Debug, Clone)]
pub struct Searched {
    /// The part.
    pub problem: Problem,
    /// All its figures, or what is known of them.
    pub result: Complete,
}

/// Searches the parts of a problem one after the other. `None`: it does not fall apart, or not all parts are served.
pub fn searched(problem: &Problem, options: &Options) -> Option<Complete> {
    let begin = Instant::now();
    let blocks = clusters(problem);
    if blocks.is_empty() {
        return None;
    }
    let mut parts: Vec<Searched> = Vec::with_capacity(blocks.len());
    let mut boxes = 0;
    for block in &blocks {
        let own = Options {
            time: options
                .time
                .map(|most| most.saturating_sub(begin.elapsed())),
            most_boxes: options.most_boxes.saturating_sub(boxes),
            cancel: options.cancel,
            threads: options.threads,
            ..Options::default()
        };
        let name = |p: usize| &block.points[p].name;
        let has = |block: &Problem, p: usize| block.points.iter().any(|q| q.name == *name(p));
        let is_own = |[a, b]: [usize; 2]| {
            let both = blocks.iter().filter(|block| has(block, a) && has(block, b));
            both.count() == 1
        };
        let result: Result<Complete, Unserved> = match options
            .within_digits
            .then(|| exact::nearly(block, is_own))
            .flatten()
        {
            Some(near) => Ok(Complete::nearly(block, near, begin)),
            None => all(block, &own),
        };
        let result = result.ok().filter(|result| {
            // All that were proved have to be listed.
            result.count == Some(result.solutions.len() as u64)
        })?;
        boxes += result.boxes;
        parts.push(Searched {
            problem: block.clone(),
            result,
        });
    }
    let mut whole = Complete::empty(problem, String::new(), begin);
    (whole.method, whole.boxes) = (Method::Blocks, boxes);
    whole.driving = parts.iter().map(|p| p.result.driving).max().unwrap_or(0);
    whole.reason = None;
    put_together(problem, &blocks, &parts, &mut whole)?;
    let near: Vec<&Tested> = parts
        .iter()
        .filter_map(|p| p.result.tested.as_ref())
        .collect();
    if !near.is_empty() {
        // Of each part the one distance that its one figure has not exactly.
        let figure: Vec<LeftOut> = near.iter().flat_map(|one| one.figures.concat()).collect();
        let names: Vec<String> = figure.iter().map(|one| one.name.clone()).collect();
        let added = near.iter().flat_map(|one| one.added.clone()).collect();
        let figures = vec![figure; whole.solutions.len()];
        let counts = [problem.distances.len() - names.len(), names.len()];
        whole.strike_out(problem, counts, names, figures);
        if let Some(tested) = &mut whole.tested {
            tested.added = added;
        }
    }
    whole.parts = parts;
    whole.seconds = begin.elapsed().as_secs_f64();
    Some(whole)
}

/// The figures of the whole. `None`: the parts do not hang together.
fn put_together(
    problem: &Problem,
    blocks: &[Problem],
    parts: &[Searched],
    whole: &mut Complete,
) -> Option<()> {
    let mut undecided: Vec<Part> = Vec::new();
    for part in parts.iter().flat_map(|part| &part.result.undecided) {
        match undecided.iter_mut().find(|known| known.why == part.why) {
            Some(known) => {
                known.count += part.count;
                known.share = known.share.max(part.share);
            }
            None => undecided.push(part.clone()),
        }
    }
    undecided.order_by_key(|part| part.why);
    let worst = parts.iter().map(|part| part.result.status).max();
    whole.status = worst.unwrap_or(Status::Complete);
    whole.undecided = undecided;
    // A part without any figure is enough.
    let none = |part: &&Searched| {
        part.result.status == Status::Complete && part.result.solutions.is_empty()
    };
    if let Some(empty) = parts.iter().find(none) {
        (whole.status, whole.count) = (Status::Complete, Some(0));
        whole.undecided.clear();
        whole.reason.clone_from(&empty.result.reason);
        return Some(());
    }
    let solutions: Vec<&[Solution]> = parts
        .iter()
        .map(|part| part.result.solutions.as_slice())
        .collect();
    let combined = Combined::new(problem, blocks, solutions)?;
    whole.count = combined.count();
    if !combined.has_all_mirror_images() {
        // Then combinations are not counted once each.
        whole.count = Some(0);
        whole.leave(Why::Apart, 1);
        whole.reason.get_or_insert_with(|| {
            "a part may be flat, so that it is its own mirror image".to_owned()
        });
        return Some(());
    }
    let mut signed = parts_signed(problem, parts);
    signed.found = whole.count.unwrap_or(u64::MAX);
    let across = Signs {
        all: across(problem, blocks),
        mirrors: !combined.is_signed(),
    };
    if !across.all.is_empty() {
        one_by_one(&combined, &across, signed, whole);
        return Some(());
    }
    whole.signed = (signed.asked > 0).then_some(signed);
    for number in 0..whole.count.map_or(LISTED, |count| count.min(LISTED)) {
        // Where boxes of the parts are too wide to put a figure together, or to tell it from one before, the list ends. What is
        // proved of all figures does not rest on it.
        let Some(points) = combined.figure(&combined.choices(number)) else {
            break;
        };
        let solution = Solution::placed(points, number as usize);
        if !whole
            .solutions
            .iter()
            .all(|other| are_apart(&solution, other))
        {
            break;
        }
        whole.solutions.push(solution);
    }
    Some(())
}

/// What the parts have come to by signs of their own, and how many signs are asked for in all.
fn parts_signed(problem: &Problem, parts: &[Searched]) -> Signed {
    let mut all = Signed {
        asked: problem.orientations.len(),
        ..Signed::default()
    };
    for one in parts.iter().filter_map(|part| part.result.signed) {
        all.cut += one.cut;
        all.wrong += one.wrong;
    }
    all
}

/// The signs that are asked for of points that are in no part together.
fn across(problem: &Problem, blocks: &[Problem]) -> Vec<Orientation> {
    let is_in = |block: &Problem, p: usize| {
        let mut points = block.points.iter();
        points.any(|point| point.name == problem.points[p].name)
    };
    let signs = problem.orientations.iter();
    let across = signs.filter(|one| {
        let mut blocks = blocks.iter();
        !blocks.any(|block| one.points.iter().all(|&p| is_in(block, p)))
    });
    across.cloned().collect()
}

/// The figures of the whole that have signs beside those of its parts: each is looked at.
fn one_by_one(combined: &Combined, across: &Signs, mut signed: Signed, whole: &mut Complete) {
    let dimension = whole.reference.len();
    let looked_at = signed.found.min(LOOKED_AT);
    signed.undecided = signed.found - looked_at;
    for number in 0..looked_at {
        let points = combined.figure(&combined.choices(number));
        let solution = points.map(|points| Solution::placed(points, whole.solutions.len()));
        let mut one: Vec<Solution> = solution.into_iter().collect();
        if one.is_empty() {
            signed.undecided += 1;
        }
        across.choose(&mut one, dimension, &mut signed);
        let others = &whole.solutions;
        match one.pop() {
            Some(one) if others.iter().all(|other| are_apart(&one, other)) => {
                whole.solutions.push(one)
            }
            // It is there, and not told from another one.
            Some(_) => signed.undecided += 1,
            None => {}
        }
    }
    whole.count = Some(whole.solutions.len() as u64);
    whole.signed = Some(signed);
    if signed.undecided > 0 {
        whole.leave(Why::Sign, signed.undecided);
    }
}
