//! All figures of equations whose right-hand sides are anywhere in ranges: a box for each, which holds exactly one for every choice of them.
//!
//! It is the search for the figures of one choice ([`super`]), of which all that is proved holds for every number in a range. What exact numbers tell has no
//! part in it: no equation is taken for one of two linear ones.
//!
//! # Why nothing is missed, and nothing counted twice
//!
//! Take any choice, and a figure of it. Some image of that has no negative pivot ([`symmetry`]), and lies in a part that stays undecided, or where there is
//! exactly one zero with that choice, and then in that zero's box. What is listed has pivots greater than 0 all over its box, so that no other image of the
//! figure is met; and any two listed differ all over their boxes in some unknown.

use super::search::{About, Block, Found, Run, leave, ranges};
use super::system::System;
use super::{Cut, Watched, both_ways, space, symmetry};
use crate::complete::{Options, Part, Why};
use crate::interval::{Interval, ZERO, upper_half};
use crate::order::InOrder;
use crate::problem::Problem;
use crate::system::Homotopy;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// The figures of equations with ranges for right-hand sides.
#[derive(Debug, Default)]
pub struct Ranged {
    /// For each figure the ranges of all unknowns, in the homotopy's unit: for every choice there is exactly one in them.
    pub figures: Vec<Vec<Interval>>,
    /// Lines and planes of their own, by name, whose two directions are told apart: figures with either are counted.
    pub both_ways: Vec<String>,
    /// What stays undecided. If nothing does, no choice has another figure, up to the symmetries of the problem.
    pub undecided: Vec<Part>,
}

/// Searches all figures of a problem whose equations are these, for every choice of right-hand sides within their ranges at t = 1.
///
/// # Errors
/// In words: a line or plane that is fixed in a direction that is not certain.
pub fn ranged(problem: &Problem, homotopy: &Homotopy, options: &Options) -> Result<Ranged, String> {
    let begin = Instant::now();
    let uncertain = |object: usize| {
        let name = &problem.objects[object].name;
        format!("in which direction {name} is fixed is not certain: name two fixed points of it")
    };
    let signs = homotopy.fixed_signs(problem).map_err(uncertain)?;
    let held = homotopy.held(problem).map_err(uncertain)?;
    let mut homotopy = homotopy.clone();
    homotopy.reduce_twins(&signs);
    let homotopy = &homotopy;
    let mut system = System::new(homotopy);
    system.has_ranges = true;
    // All of them together: of a part by itself it is not known which choice the others have made.
    let cut = Cut {
        equations: (0..system.unknowns).collect(),
        unknowns: (0..system.unknowns).collect(),
        needs: Vec::new(),
    };
    let blocks = [cut];
    let halves = symmetry::halves(problem, (homotopy, &held), &blocks);
    let [all] = &blocks;
    let m = system.unknowns;
    // What has a sign all over what is listed.
    let positive = homotopy.positive_unknowns().into_iter();
    let positive = positive.chain(halves.iter().map(|half| half.unknown));
    let signed: Vec<(usize, bool)> = positive
        .map(|i| (i, false))
        .chain(signs.iter().copied())
        .collect();
    let half = |&(i, is_negative): &(usize, bool)| {
        let half = upper_half();
        (i, if is_negative { -half } else { half })
    };
    let (mut x, space) = space(&system, signed.iter().map(half));
    if space.is_err() {
        return Ok(Ranged::default());
    }
    let stop = AtomicBool::new(false);
    let watched = Watched::new(&stop, options, false);
    let run = Run {
        watched: &watched,
        weight: 1.0,
        kept: None,
        is_whole: false,
    };
    let block = Block::new(&system, &all.equations, &all.unknowns, |u| u == m);
    let found = options.watched(&watched, begin, || {
        if block.bound(&mut x).is_err() {
            return Found::default();
        }
        let about = About {
            whole: &block,
            told: Vec::new(),
        };
        block.search_all(&about, Vec::new(), x, &run)
    });
    let mut ranged = Ranged {
        both_ways: both_ways(problem, homotopy),
        undecided: found.undecided,
        ..Ranged::default()
    };
    if !symmetry::keeps_axes(problem, homotopy, &held) && !found.zeros.is_empty() {
        // Figures are told apart for some choices by what is the same for others.
        leave(&mut ranged.undecided, Why::Apart, 1, 0.0);
        return Ok(ranged);
    }
    for zero in &found.zeros {
        let mut x = vec![ZERO; m + 2];
        for (&u, range) in all.unknowns.iter().zip(ranges(zero)) {
            x[u] = range;
        }
        ranged.add(homotopy, &signed, x);
    }
    ranged.undecided.order_by_key(|part| part.why);
    Ok(ranged)
}

impl Ranged {
    /// Lists the box of a zero, if it is a figure for every choice. `signed`: unknowns that are positive in what is listed, or negative.
    fn add(&mut self, homotopy: &Homotopy, signed: &[(usize, bool)], x: Vec<Interval>) {
        let mut signed = signed.iter().copied();
        let seen = |(i, is_negative): (usize, bool)| if is_negative { -x[i] } else { x[i] };
        // No figure, or an image of one that is met elsewhere.
        if signed.clone().any(|sign| seen(sign).sup() < 0.0) {
            return;
        }
        if !signed.all(|sign| seen(sign).inf() > 0.0) {
            // Of some choices it may be a mirror image of a figure, or flat.
            return leave(&mut self.undecided, Why::Apart, 1, 0.0);
        }
        if !homotopy.is_proper_over(|i| x[i]) {
            return leave(&mut self.undecided, Why::Vanishing, 1, 0.0);
        }
        let is_apart = |other: &Vec<Interval>| {
            let apart = |i: usize, reversed: bool| {
                let one = if reversed { -x[i] } else { x[i] };
                one.disjoint(other[i])
            };
            let twins = homotopy.twins();
            (0..homotopy.equations).any(|i| apart(i, false))
                && twins.is_some_and(|twins| !homotopy.may_be_reversed(&twins, apart))
        };
        match self.figures.iter().all(is_apart) {
            true => self.figures.push(x),
            false => leave(&mut self.undecided, Why::Apart, 1, 0.0),
        }
    }
}
