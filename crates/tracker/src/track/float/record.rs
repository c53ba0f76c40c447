//! What a float run has seen so far, in either space.

use super::Stuck;
use crate::interval::point;
use crate::linalg::Vector;
use crate::places::array;
use crate::system::Homotopy;
use crate::track::full::{Equations, Local, Preconditioner};
use crate::track::{
    Control, Driving, Mode, Options, Outcome, Progress, Space, Status, Stop, StopKind,
    observed_solutions,
};
use std::time::Instant;

/// Two figures are the same solution if no coordinate differs by more than this times the
/// figure's size. Newton's method brings them to about 1e-15 times a condition number.
const SAME_FIGURE: f64 = 1e-9;

/// Solutions and counters of a run.
#[derive(Debug)]
pub struct Record {
    started: Instant,
    /// All unknowns, and t = 1.
    pub found: Vec<Vector>,
    /// Those of them that are flat figures at which the equations are dependent.
    flat: Vec<Vector>,
    /// Accepted and rejected steps.
    pub steps: usize,
    /// See `steps`.
    pub rejected: usize,
    /// Path length.
    pub length: f64,
    /// The least and the largest t met.
    pub t_range: (f64, f64),
}

impl Record {
    /// Nothing seen yet, the run beginning now.
    pub fn new() -> Self {
        Record {
            started: Instant::now(),
            found: Vec::new(),
            flat: Vec::new(),
            steps: 0,
            rejected: 0,
            length: 0.0,
            t_range: (f64::INFINITY, f64::NEG_INFINITY),
        }
    }

    /// Where the run is, in words.
    pub fn place(&self, t: f64) -> String {
        format!("at t = {t:.9} after {} steps", self.steps)
    }

    /// To be called after each step. The error: all steps are taken, or the run is to end.
    pub fn go_on(&self, t: f64, options: &Options, control: &mut Control) -> Result<(), Stop> {
        // No step makes words, and so allocates.
        let place = || self.place(t);
        if self.steps >= options.max_steps {
            let words = format!(
                "the limit of {} steps was reached {}",
                options.max_steps,
                place()
            );
            return Err(Stop::new(StopKind::Limit, words));
        }
        let progress = Progress {
            t,
            steps: self.steps,
            solutions: self.found.len(),
            length: self.length,
        };
        match control.is_cancelled(progress) {
            true => Err(Stop::new(
                StopKind::Interrupted,
                format!("interrupted {}", place()),
            )),
            false => Ok(()),
        }
    }

    /// Why a run ends that is stuck at t.
    pub fn stuck(&self, homotopy: &Homotopy, t: f64, Stuck { why, step }: Stuck) -> Stop {
        let words = format!(
            "{why} at the smallest step, {:.1e}, {}{}",
            step * homotopy.unit,
            self.place(t),
            homotopy.remark_on_lengths(t)
        );
        Stop::new(StopKind::NoStep, words)
    }

    /// Corrects `guess` to a solution at t = 1 by Newton's method in X, in `local`, and keeps it if it is new.
    /// `None`: the method does not converge.
    pub fn solution<const N: usize, Y: Preconditioner>(
        &mut self,
        (equations, inverter): (&Equations, &mut Y::Maker),
        local: &mut Local<N, Y>,
        guess: &[f64],
    ) -> Option<()> {
        local.z[0].copy_from_slice(guess);
        local.refine_at(equations, inverter, 1.0)?;
        let x = local.z[0].clone();
        self.keep(x, equations.m);
        Some(())
    }

    /// Keeps a flat figure at which the equations are dependent, if it is new.
    pub fn flat(&mut self, x: Vector, m: usize) {
        if self.keep(x.clone(), m) {
            self.flat.push(x);
        }
    }

    /// Tells whether it is new.
    fn keep(&mut self, x: Vector, m: usize) -> bool {
        let size = x[..m].iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        let is_same =
            |known: &Vector| (0..m).all(|i| (known[i] - x[i]).abs() <= SAME_FIGURE * size);
        let is_new = !self.found.iter().any(is_same);
        if is_new {
            self.found.push(x);
        }
        is_new
    }

    /// The other way from the sketch the run came back to it: what was seen there is all there is.
    pub fn give_way_to(&mut self, back: Self) {
        *self = Record {
            started: self.started,
            steps: self.steps + back.steps,
            rejected: self.rejected + back.rejected,
            ..back
        };
    }

    /// Joins what was seen the other way from the sketch: its solutions come first, the last one foremost. Both ways
    /// begin at t = 0.
    pub fn go_on_from(&mut self, back: Self, m: usize) {
        let ahead = std::mem::replace(&mut self.found, back.found);
        self.found.reverse();
        for x in ahead {
            self.keep(x, m);
        }
        self.flat.extend(back.flat);
        self.steps += back.steps;
        self.rejected += back.rejected;
        self.length += back.length;
        let ((low, high), behind) = (self.t_range, back.t_range);
        self.t_range = (low.min(behind.0), high.max(behind.1));
        self.meet(0.0);
    }

    /// Takes note of a t that was met.
    pub fn meet(&mut self, t: f64) {
        self.t_range = (self.t_range.0.min(t), self.t_range.1.max(t));
    }

    /// The run's result in the full space. Lengths of congruent figures agree to `same`, relative to the figure's size.
    /// Where a length or radius is not positive, or a leg has vanished, there is no figure.
    pub fn into_outcome(mut self, homotopy: &Homotopy, status: Status, same: f64) -> Outcome {
        let d = homotopy.dimension;
        if !homotopy.tail.is_empty() {
            self.found
                .retain(|x| homotopy.is_proper(&x[..homotopy.equations]));
        }
        let figures: Vec<Vec<[f64; 3]>> = self
            .found
            .iter()
            .map(|x| {
                let mut places = vec![0.0; homotopy.points * d];
                homotopy.scatter(&x[..homotopy.equations], &mut places);
                let unit = homotopy.unit;
                places
                    .chunks(d)
                    .map(|p| array(|k| p.get(k).map_or(0.0, |x| x * unit)))
                    .collect()
            })
            .collect();
        let mut solutions = observed_solutions(figures, same);
        for (solution, x) in solutions.iter_mut().zip(&self.found) {
            solution.objects = homotopy.locate(&solution.points, &|i| point(x[i]));
            let auxiliary = homotopy.auxiliary_unknowns();
            solution.auxiliary = auxiliary.map(|i| point(x[i])).collect();
        }
        if !homotopy.tail.is_empty() {
            let classes = classes(homotopy, &self.found);
            for (solution, &class) in solutions.iter_mut().zip(&classes) {
                solution.class = class;
                // Points can be mirrored where lines between them are not.
                let same = |&other: &usize| classes[other] == class;
                solution.mirror_of = solution.mirror_of.filter(same);
            }
            let is_flat = |x: &Vector| self.flat.iter().any(|flat| flat[..] == x[..]);
            for (solution, x) in solutions.iter_mut().zip(&self.found) {
                solution.is_degenerate = is_flat(x);
            }
        }
        Outcome {
            signed: None,
            mode: Mode::Float,
            space: Space::Full,
            status,
            solutions,
            steps: self.steps,
            rejected: self.rejected,
            plan_changes: 0,
            driving: Driving::default(),
            length: self.length,
            t_range: self.t_range,
            seconds: self.started.elapsed().as_secs_f64(),
            switched_on: Vec::new(),
        }
    }
}

/// Classes of congruent figures of a problem with other constraints than distances, by all of their unknowns:
/// the isometries that keep the reference change signs. Where a constraint says which way round the figure is
/// only those that do not mirror it count, and without a reference there are none.
fn classes(homotopy: &Homotopy, found: &[Vector]) -> Vec<usize> {
    let (m, d) = (homotopy.equations, homotopy.dimension);
    let turns: Vec<usize> = (0..1usize << d)
        .filter(|&turn| turn == 0 || !homotopy.gauge.reference.is_empty())
        .filter(|turn| homotopy.tail.mirrors || turn.count_ones() % 2 == 0)
        .collect();
    let none = || vec![vec![false; m]];
    let twins = homotopy.twins().unwrap_or_else(none);
    let size = |x: &Vector| x[..m].iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    let differs = |one: &Vector, other: &Vector, turn: usize, i: usize, changed: bool| {
        let flips = (0..d).filter(|&axis| turn >> axis & 1 == 1 && homotopy.flips(i, axis));
        let sign = if (flips.count() % 2 == 1) ^ changed {
            -1.0
        } else {
            1.0
        };
        (sign * one[i] - other[i]).abs() > SAME_FIGURE * size(one)
    };
    let is_image = |one: &Vector, other: &Vector, turn: usize, twin: &[bool]| {
        !(0..m).any(|i| differs(one, other, turn, i, twin[i]))
    };
    let mut classes: Vec<usize> = Vec::new();
    for (k, x) in found.iter().enumerate() {
        let mut before = found[..k].iter();
        let is_same = |y: &Vector, turn: usize| {
            let apart = |i: usize, reversed: bool| differs(x, y, turn, i, reversed);
            twins.iter().any(|twin| is_image(x, y, turn, twin))
                // Or the same but for directions of lines and planes of their own.
                || homotopy.may_be_reversed(&[], apart)
        };
        let same = before.position(|y| turns.iter().any(|&turn| is_same(y, turn)));
        let next = classes.iter().max().map_or(0, |c| c + 1);
        classes.push(same.map_or(next, |j| classes[j]));
    }
    classes
}
