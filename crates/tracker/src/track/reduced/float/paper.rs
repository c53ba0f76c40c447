//! Stepping as in RR 8705, section 7: Euler's predictor along the tangent in the driving
//! parameters and t, Newton's method, finite differences, steps doubled and halved.

use super::Tracker;
use super::steps::Attempt;
use crate::track::float::doubled;

/// δmax in the reduced space (RR 8705, section 7.3.1).
pub const LONGEST_STEP: f64 = 0.05;

impl Tracker<'_> {
    /// The path tracking of section 7.1.
    pub(super) fn attempt_as_in_the_paper(&mut self, delta: f64, longest: f64) -> Attempt {
        let error = self.corrector.predict_and_correct(
            &mut self.evaluation,
            &self.current.z,
            delta,
            &mut self.next,
            &mut self.differences,
        );
        let length = self.arc_length();
        // The cubic on which events are looked for is far better than Euler's predictor.
        error.map_or(Attempt::Failed, |error| Attempt::Point {
            length,
            margin: 0.1 * error.min(length),
            then: doubled(delta, longest),
        })
    }
}
