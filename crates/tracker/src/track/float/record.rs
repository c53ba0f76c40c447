//! What a float run has seen so far, in either space.

use super::Stuck;
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::certified::{Congruence, FigureBox, Same, classes, is_congruent};
use crate::track::full::{Equations, Local, Preconditioner};
use crate::track::{
    Control, Mode, Options, Outcome, Progress, Solution, Space, Status, Stop, StopKind,
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

    /// The run's result in the full space. Congruent figures agree to `same`, relative to their size.
    /// Where a length or radius is not positive, or a leg has vanished, there is no figure.
    pub fn into_outcome(mut self, homotopy: &Homotopy, status: Status, same: f64) -> Outcome {
        let m = homotopy.equations;
        if !homotopy.tail.is_empty() {
            self.found.retain(|x| homotopy.is_proper(&x[..m]));
        }
        let about = self.found.iter().map(|x| FigureBox::about(&x[..m], same));
        let mut figures: Vec<FigureBox> = about.collect();
        let classes = classes(&figures, |a, b| relation(homotopy, a, b), |_, _, _| {});
        let all = figures.iter_mut().zip(&self.found).zip(classes);
        let solutions = all.map(|((figure, x), class)| {
            // What is told of it is a point.
            figure.figure.radius.fill(0.0);
            Solution {
                is_degenerate: self.flat.iter().any(|flat| flat[..] == x[..]),
                ..figure.solution(homotopy, class)
            }
        });
        let solutions = solutions.collect();
        Outcome {
            solutions,
            steps: self.steps,
            rejected: self.rejected,
            length: self.length,
            t_range: self.t_range,
            seconds: self.started.elapsed().as_secs_f64(),
            ..Outcome::new(Mode::Float, Space::Full, status)
        }
    }
}

/// Whether two figures are congruent, as far as floats tell: also where they are the same, or differ in nothing but the
/// directions of lines and planes of their own.
fn relation(homotopy: &Homotopy, one: &FigureBox, other: &FigureBox) -> Congruence {
    if one.is_same(other, |_| false) == Same::Yes {
        return Congruence::Yes { mirrored: false };
    }
    match is_congruent(homotopy, one, other) {
        Congruence::Reversed { mirrored } => Congruence::Yes { mirrored },
        relation => relation,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::shipped;

    #[test]
    fn tells_mirror_images_from_moved_figures() {
        for name in ["dodecagon", "octahedron"] {
            let homotopy = Homotopy::new(&shipped(name)).unwrap();
            let (d, m) = (homotopy.dimension, homotopy.equations);
            // With some axes reversed.
            let figure = |reversed: &[usize]| {
                let mut x = Vector::zeros(m + 1);
                for (x, &place) in x.iter_mut().zip(&homotopy.gauge.place) {
                    let sign = if reversed.contains(&(place % d)) {
                        -1.0
                    } else {
                        1.0
                    };
                    *x = sign * homotopy.sketch[place];
                }
                x
            };
            let mut record = Record::new();
            record.found = vec![figure(&[]), figure(&[d - 1]), figure(&[]), figure(&[0, 1])];
            let mut other = figure(&[]);
            other[m - 1] += 1e-3;
            record.found.push(other);
            let outcome = record.into_outcome(&homotopy, Status::Closed, 1e-9);
            let seen = outcome.solutions.iter().map(|s| (s.class, s.mirror_of));
            let wanted = [
                (0, None),
                (0, Some(0)),
                (0, Some(1)),
                (0, Some(1)),
                (1, None),
            ];
            assert!(seen.eq(wanted), "{name}");
        }
    }
}
