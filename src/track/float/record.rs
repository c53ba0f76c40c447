//! What a float run in the full space has seen so far.

use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::full::{Equations, InverseMaker, Local};
use crate::track::{Driving, Mode, Outcome, Space, Status, observed_solutions};

/// Two figures are the same solution if no coordinate differs by more than this times the
/// figure's size. Newton's method brings them to about 1e-15 times a condition number.
const SAME_FIGURE: f64 = 1e-9;
/// Lengths of congruent figures agree to that, relative to the figure's size.
const SAME_LENGTH: f64 = 1e-9;

/// Solutions and counters of a run.
#[derive(Debug)]
pub struct Record<const D: usize> {
    found: Vec<Vector>,
    corrector: Local<D>,
    /// Accepted and rejected steps.
    pub steps: usize,
    /// See `steps`.
    pub rejected: usize,
    /// Path length.
    pub length: f64,
    /// The least and the largest t met.
    pub t_range: (f64, f64),
}

impl<const D: usize> Record<D> {
    /// Nothing seen yet.
    pub fn new(equations: &Equations<D>) -> Self {
        Record {
            found: Vec::new(),
            corrector: Local::new(equations),
            steps: 0,
            rejected: 0,
            length: 0.0,
            t_range: (f64::INFINITY, f64::NEG_INFINITY),
        }
    }

    /// The number of solutions so far.
    pub fn solutions(&self) -> usize {
        self.found.len()
    }

    /// Corrects `guess` to a solution at t = 1 by Newton's method in X, and keeps it if it is new.
    /// `None`: the method does not converge.
    pub fn solution(
        &mut self,
        equations: &Equations<D>,
        inverter: &mut InverseMaker,
        guess: &[f64],
    ) -> Option<()> {
        let m = equations.m;
        let local = &mut self.corrector;
        local.z[0].copy_from_slice(guess);
        local.polish_at(equations, inverter, 1.0)?;
        let x = &local.z[0];
        let size = x[..m].iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        let is_same =
            |known: &Vector| (0..m).all(|i| (known[i] - x[i]).abs() <= SAME_FIGURE * size);
        if !self.found.iter().any(is_same) {
            self.found.push(x.clone());
        }
        Some(())
    }

    /// Takes note of a t that was met.
    pub fn meet(&mut self, t: f64) {
        self.t_range = (self.t_range.0.min(t), self.t_range.1.max(t));
    }

    /// The run's result.
    pub fn into_outcome(self, homotopy: &Homotopy, status: Status, seconds: f64) -> Outcome {
        let d = homotopy.dimension;
        let figures: Vec<Vec<[f64; 3]>> = self
            .found
            .iter()
            .map(|x| {
                let mut places = vec![0.0; homotopy.points * d];
                homotopy.scatter(&x[..homotopy.equations], &mut places);
                let unit = homotopy.unit;
                places
                    .chunks(d)
                    .map(|p| std::array::from_fn(|k| p.get(k).map_or(0.0, |x| x * unit)))
                    .collect()
            })
            .collect();
        Outcome {
            mode: Mode::Float,
            space: Space::Full,
            status,
            solutions: observed_solutions(figures, SAME_LENGTH),
            steps: self.steps,
            rejected: self.rejected,
            plan_changes: 0,
            driving: Driving::default(),
            length: self.length,
            t_range: self.t_range,
            seconds,
            switched_on: Vec::new(),
        }
    }
}
