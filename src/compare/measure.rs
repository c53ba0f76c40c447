//! Runs taking turns, so that ratios of their times hold on a machine whose speed drifts.

use super::{Row, Setting, Verdict, Way, residual::residuals};
use crate::interval::rounding::largest;
use crate::order::InOrder;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::{Control, Limit, Options, Outcome, Status, Stop, StopKind, solve};
use std::time::{Duration, Instant};

/// How much is run.
#[derive(Debug, Clone, PartialEq)]
pub struct Effort {
    /// Runs of each way.
    pub repeats: usize,
    /// Whether settings are swept.
    pub sweep: bool,
    /// A run is given up after this many seconds.
    pub limit: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Effort {
            repeats: 5,
            sweep: false,
            limit: 120.0,
        }
    }
}

/// What came of the runs of one way.
#[derive(Debug, Clone)]
pub struct Measured {
    /// The result. It is the same in every run, but for the clock.
    pub outcome: Outcome,
    /// Seconds of each run, in the order in which they were made.
    pub seconds: Vec<f64>,
    /// The median of these.
    pub median: f64,
    /// The largest of `residuals`; none where there is no solution.
    pub residual: Option<f64>,
    /// By how much each solution misses the constraints at most (see `residual.rs`).
    pub residuals: Vec<f64>,
}

impl Measured {
    /// Whether the run closed.
    pub fn is_closed(&self) -> bool {
        self.outcome.status == Status::Closed
    }

    /// Whether the run closed or ended open, so that it has all of what there is to follow.
    pub fn came_to_an_end(&self) -> bool {
        !matches!(self.outcome.status, Status::Stopped(_))
    }

    /// The largest and the smallest relative width of a solution's box.
    pub fn widths(&self) -> Option<(f64, f64)> {
        let widths = || self.outcome.solutions.iter().map(|s| s.width);
        let largest = widths().max_by(f64::total_cmp)?;
        Some((largest, widths().min_by(f64::total_cmp)?))
    }
}

/// Once the runs of a way have taken this many seconds it is not run again.
const ENOUGH: f64 = 5.0;

/// A float run that has jumped to another path may follow it for ever: it is given up when it has
/// gone this many times as far as the certified run.
const TOO_FAR: f64 = 16.0;

/// The runs on one problem.
pub(super) struct Session<'a> {
    problem: &'a Problem,
    homotopy: &'a Homotopy,
    effort: &'a Effort,
    length: f64,
}

impl<'a> Session<'a> {
    pub fn new((problem, homotopy): (&'a Problem, &'a Homotopy), effort: &'a Effort) -> Self {
        Session {
            problem,
            homotopy,
            effort,
            length: f64::INFINITY,
        }
    }

    /// Takes note of how long the path is, if that is known.
    pub fn limit_length(&mut self, length: Option<f64>) {
        self.length = length.map_or(f64::INFINITY, |length| TOO_FAR * length);
    }

    /// Runs everything in turn, as often as wanted. What is broken off leaves no row.
    pub fn run(
        &mut self,
        ways: impl IntoIterator<Item = (Way, Option<Setting>)>,
        control: &mut Control,
    ) -> Vec<Row> {
        let options_of = |way: Way, setting: Option<Setting>| {
            setting.map_or(way.options(), |setting| setting.apply(way.options()))
        };
        let mut rows = Vec::new();
        for (way, setting) in ways {
            let Some(result) = self.once(&options_of(way, setting), control) else {
                break;
            };
            let result = result.map(|outcome| {
                let residuals = residuals(self.problem, self.homotopy, &outcome.solutions);
                Measured {
                    seconds: vec![outcome.seconds],
                    median: 0.0,
                    residual: residuals.iter().copied().reduce(largest),
                    residuals,
                    outcome,
                }
            });
            rows.push(Row {
                way,
                setting,
                result,
                verdict: Verdict::Unjudged,
            });
        }
        'rounds: for _ in 1..self.effort.repeats {
            for row in &mut rows {
                let Ok(measured) = &mut row.result else {
                    continue;
                };
                if measured.seconds.iter().sum::<f64>() > ENOUGH {
                    continue;
                }
                match self.once(&options_of(row.way, row.setting), control) {
                    Some(Ok(outcome)) => measured.seconds.push(outcome.seconds),
                    Some(Err(_)) => {}
                    None => break 'rounds,
                }
            }
        }
        for row in &mut rows {
            if let Ok(measured) = &mut row.result {
                measured.median = median(&measured.seconds);
            }
        }
        rows
    }

    /// One run. Nothing, if it was broken off; an error, if this way cannot take the problem.
    fn once(&self, options: &Options, control: &mut Control) -> Option<Result<Outcome, String>> {
        if control.is_interrupted() {
            return None;
        }
        let started = Instant::now();
        control.limit = Some(Limit {
            length: self.length,
            deadline: started + Duration::from_secs_f64(self.effort.limit),
        });
        control.reported = None;
        let result = solve(self.problem, options, control);
        let mut outcome = match result {
            Ok(outcome) => outcome,
            Err(error) => return Some(Err(error.to_string())),
        };
        if let Status::Stopped(reason) = &mut outcome.status {
            if control.is_interrupted() {
                return None;
            }
            if outcome.length > self.length {
                let words = format!(
                    "given up after {} steps: it went {TOO_FAR} times as far as the path is long",
                    outcome.steps
                );
                *reason = Stop::new(StopKind::Limit, words);
            } else if started.elapsed().as_secs_f64() > self.effort.limit {
                let words = format!(
                    "given up after {} seconds and {} steps",
                    self.effort.limit, outcome.steps
                );
                *reason = Stop::new(StopKind::Limit, words);
            }
        }
        Some(Ok(outcome))
    }
}

/// The middle one, or the mean of the middle two.
fn median(seconds: &[f64]) -> f64 {
    let mut sorted = seconds.to_vec();
    sorted.order_by(f64::total_cmp);
    let half = sorted.len() / 2;
    if sorted.len().is_multiple_of(2) {
        0.5 * (sorted[half - 1] + sorted[half])
    } else {
        sorted[half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(&[7.0]), 7.0);
    }
}
