//! Paths that do not come back to the sketch: both ways from it to their two ends.

use super::{EndKind, FAR, PathEnd, Test, Tracker, vanishing};
use crate::track::{Control, Options, Status};

impl<const D: usize, const N: usize, T: Test<D, N>> Tracker<'_, D, N, T> {
    /// Whether a point of a problem with other constraints than distances is far from the others. Distances alone
    /// cannot let a figure grow beyond bounds while t does not.
    pub(super) fn is_far(&self) -> bool {
        if self.homotopy.tail.is_empty() || self.arc.is_some() {
            return false;
        }
        let coordinates = &self.now.local.z[0][..self.homotopy.gauge.place.len()];
        let near = |x: &f64| x.abs() <= FAR * self.size_of_sketch;
        !coordinates.iter().all(near)
    }

    /// The end of the path, if that is where the run ended; otherwise the reason again.
    pub(super) fn path_end(&self, reason: String) -> Result<PathEnd, String> {
        if self.homotopy.tail.is_empty() || !self.has_set_out {
            return Err(reason);
        }
        let (t, z) = (self.reached(), &self.now.local.z[0]);
        let first = self.homotopy.gauge.place.len();
        let (values, before) = (&z[first..], &self.sketch.centre[first..]);
        let leg = self.homotopy.remark_on_lengths(t.0);
        let (kind, reason) = if self.is_beyond {
            (EndKind::Infinite, reason)
        } else if !self.is_stuck {
            // Interrupted, or at the limit of steps.
            return Err(reason);
        } else if let Some(name) = vanishing(&self.homotopy.tail, values, before) {
            (EndKind::Undefined, format!("{name} goes to zero: {reason}"))
        } else if !leg.is_empty() {
            let what = leg.trim_start_matches("; ");
            (EndKind::Undefined, format!("{what}: {reason}"))
        } else if self.is_singular {
            let what = "the figure becomes degenerate, its constraints dependent on each other";
            (EndKind::Degenerate, format!("{what}: {reason}"))
        } else {
            return Err(reason);
        };
        let homotopy = &self.homotopy;
        let coordinate = |p: usize, axis: usize| {
            let at = homotopy.coordinate(p, axis);
            at.map_or(0.0, |i| z[i] * homotopy.unit)
        };
        let points = (0..homotopy.points).map(|p| std::array::from_fn(|axis| coordinate(p, axis)));
        Ok(PathEnd {
            t,
            kind,
            reason,
            points: points.collect(),
        })
    }

    /// Goes the other way from the sketch, this run having come to an end of the path. Afterwards the account
    /// is that of both ways.
    pub(super) fn other_way(
        &mut self,
        end: PathEnd,
        options: &Options,
        control: &mut Control,
    ) -> Status {
        let options = Options {
            reverse: !options.reverse,
            ..options.clone()
        };
        let mut back = Tracker::<D, N, T>::new(self.homotopy.clone(), &options);
        if let Some(witness) = &mut control.witness {
            witness.turn();
        }
        if let Some(trace) = &mut control.trace {
            trace.turn_back();
        }
        let result = back.run(&options, control);
        if let Some(witness) = &mut control.witness {
            witness.end_turn(result.is_err());
        }
        let other = match result {
            // The loop is closed after all: the way that closed it is the proof.
            Ok(()) if control.witness.is_some() => {
                let what =
                    "the path closes if it is followed the other way (`--reverse`): this way, ";
                return Status::Stopped(format!("{what}{}", end.reason));
            }
            Ok(()) => {
                if let Some(trace) = &mut control.trace {
                    trace.keep_other_way();
                }
                std::mem::swap(&mut self.ledger, &mut back.ledger);
                std::mem::swap(&mut self.steps, &mut back.steps);
                return Status::Closed;
            }
            Err(reason) => back.path_end(reason),
        };
        self.steps += back.steps;
        self.rejected += back.rejected;
        self.shortened += back.shortened;
        self.behind = back.ledger.found().len();
        if let Err(reason) = self.ledger.go_on_from(back.ledger) {
            return Status::Stopped(reason);
        }
        match other {
            Ok(other) => Status::Open(Box::new([other, end])),
            Err(reason) => Status::Stopped(format!(
                "one way from the sketch the path has an end ({}); the other way {reason}",
                end.reason
            )),
        }
    }
}
