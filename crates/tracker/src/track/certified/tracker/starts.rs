//! Where the path meets t = 0: at the sketch, and perhaps again.

use super::{Test, Tracker};
use crate::interval::ZERO;
use crate::track::Control;
use crate::track::certified::figures::FigureBox;
use crate::track::certified::solution::{Same, SolutionProver};
use crate::track::events::changes;

/// Pieces of a tube's stretch on which t is looked at.
const PIECES: usize = 16;

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Hands over the figures with t = 0 in the tube that joined the chain last: each is proved to exist, to be
    /// alone in its box, and to be on the path, as the box lies in the tube. That all are found is not claimed.
    pub(super) fn note_starts(&mut self, control: &mut Control) {
        let Some(seen) = &mut control.figures else {
            return;
        };
        let (tube, equations) = (&self.now, &self.equations);
        let (m, h) = (equations.m, tube.proof.h);
        // The sketch itself is at the first tube's entry, known but for rounding.
        let from = (tube.entry.0 - 1e-3 * h).max(-h);
        let to = tube.exit_at;
        // Of t - 1.
        let ((low, high), _) = tube.time().bounds(from, to);
        if low > -1.0 || high < -1.0 {
            return;
        }
        let prover = self
            .at_start
            .get_or_insert_with(|| Box::new(SolutionProver::at_start(&self.homotopy, equations)));
        let mut x = equations.vector();
        let mut room = equations.vector();
        let is_above = |s: f64| {
            tube.local.at(s, &mut room);
            room[m] > 0.0
        };
        for s in changes((from, to), PIECES, is_above) {
            tube.local.at(s, &mut x);
            let Ok(found) = prover.prove(equations, &mut self.inverter, &x, false) else {
                continue;
            };
            let mut ball = super::Ball::new(equations);
            ball.hold(&found.figure, ZERO);
            if tube.locate(&ball).is_none() {
                continue;
            }
            let is_it = |other: &FigureBox| found.is_same(other, |_| false) != Same::No;
            if !seen.start.iter().any(is_it) {
                seen.start.push(found.clone());
            }
        }
    }
}
