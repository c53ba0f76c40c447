//! Stepping as in RR 8705, section 7: Euler's predictor along the tangent in the driving
//! parameters and t, Newton's method, finite differences, steps doubled and halved.

use super::events::Events;
use super::{SMALLEST_STEP, Tracker};
use crate::plan::Differences;
use crate::track::{Control, Status, StopKind};

/// δmax in the reduced space (RR 8705, section 7.3.1).
pub const LONGEST_STEP: f64 = 0.05;

impl Tracker<'_> {
    /// Algorithm 1 with the path tracking of section 7.1.
    pub(super) fn follow_as_in_the_paper(&mut self, control: &mut Control) -> Status {
        let longest = self
            .options
            .step_in(self.homotopy.unit)
            .unwrap_or(LONGEST_STEP);
        let mut differences = Differences::default();
        let mut delta = longest;
        loop {
            match self.step_as_in_the_paper(&mut delta, longest, &mut differences) {
                Err(status) => return status,
                Ok(()) if control.is_cancelled(self.progress()) => {
                    return self.stopped(StopKind::Interrupted, "interrupted");
                }
                Ok(()) => {}
            }
        }
    }

    fn step_as_in_the_paper(
        &mut self,
        delta: &mut f64,
        longest: f64,
        differences: &mut Differences,
    ) -> Result<(), Status> {
        if self.steps >= self.options.max_steps {
            return Err(self.stopped(StopKind::Limit, "the limit on steps is reached"));
        }
        let error = self.corrector.predict_and_correct(
            &mut self.evaluation,
            &self.current.z,
            *delta,
            &mut self.next,
            differences,
        );
        let near = self.evaluation.is_near_boundary() || self.evaluation.is_out_of_order();
        let length = self.arc_length();
        let events = match error {
            // The cubic on which events are looked for is far better than Euler's predictor.
            Some(error) => self.look_between(length, 0.1 * error.min(length)),
            None => Events::Unclear,
        };
        match events {
            Events::None => self.advance(length, length),
            Events::Closed(s) => {
                self.advance(length, s);
                return Err(Status::Closed);
            }
            Events::Unclear => {
                self.rejected += 1;
                *delta *= 0.5;
                if *delta < SMALLEST_STEP {
                    return Err(self.no_step());
                }
                return Ok(());
            }
        }
        if near {
            self.change_plan(false, 1.0)?;
        }
        if 2.0 * *delta <= longest {
            *delta *= 2.0;
        }
        Ok(())
    }
}
