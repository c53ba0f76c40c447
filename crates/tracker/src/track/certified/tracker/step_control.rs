//! How far from the last tube the next one is placed: it is symmetric, and must reach back.

use crate::linalg::Vector;
use crate::track::certified::link::{Frame, Tube};
use crate::track::certified::reasons::Rejection;
use crate::track::events::halved;
use crate::track::full::Equations;

/// The next tube is expected to reach back over this fraction of its half length, as predicted.
const REACH: f64 = 0.65;
/// It reaches back over this fraction where a rejected tube has shown how long tubes are there.
const REACH_SEEN: f64 = 0.85;
/// A rejection multiplies what is believed of the expected length by this.
const DISTRUST: f64 = 0.93;
/// Each accepted tube after it multiplies it by this.
const RECOVERY: f64 = 1.005;
/// Expectations are believed up to this factor where nothing is rejected, as where a bound on the radius keeps
/// tubes short.
const MOST_TRUST: f64 = 1.3;
/// Tubes are predicted to be longer by no more than this times, or shorter.
const GROWTH: (f64, f64) = (0.3, 1.5);

/// What is known of the next tube's place.
#[derive(Debug)]
pub(super) struct StepControl {
    /// How much of the expectation to believe: less after a rejection, then more again.
    trust: f64,
    /// What rejections taught about this tube: the next one must reach back over less.
    shorter: f64,
    /// The half length of the tube before the last.
    before: f64,
    room: Vector,
}

impl StepControl {
    pub fn new(equations: &Equations) -> Self {
        StepControl {
            trust: 1.0,
            shorter: f64::INFINITY,
            before: f64::INFINITY,
            room: equations.vector(),
        }
    }

    /// How far behind the exit the middle of the next tube is to be, in the parameter of this one;
    /// `limit` bounds half lengths.
    ///
    /// Polynomials converge as far as the nearest singularity lets them, and h is a fraction of that. The
    /// square root: by the time another singularity may be the nearest, and in logarithms half of the change is
    /// the best guess (least squares over 4000 tubes along the icosahedron's path).
    pub fn reach<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, limit: f64) -> f64 {
        let (h, local) = (tube.proof.h, &tube.local);
        let singularities = local.singularities();
        // Behind a narrow place it is mostly the old singularity that is left further and further behind.
        let trend = (h / self.before).sqrt();
        let mut reach = REACH * h;
        for _ in 0..2 {
            let s = tube.exit_at + reach;
            // The next tube's parameter is arc length; in this one's the path is faster as it bends away.
            let speed = local.speed(s, &mut self.room).min(2.0);
            let growth = (singularities.distance(s) * speed).sqrt();
            let growth = if growth.is_nan() { 1.0 } else { growth };
            let growth = growth.max(trend).clamp(GROWTH.0, GROWTH.1);
            reach = REACH * self.trust * (h * growth).min(limit) / speed.max(1.0);
        }
        reach.min(self.shorter)
    }

    /// A tube was accepted behind one of this half length.
    pub fn accept(&mut self, h: f64) {
        self.before = h;
        self.trust = (RECOVERY * self.trust).min(MOST_TRUST);
        self.shorter = f64::INFINITY;
    }

    /// The tube that would have reached back over `reach` was rejected.
    pub fn reject<const N: usize, Y: Frame>(
        &mut self,
        rejection: Rejection,
        tube: &Tube<N, Y>,
        next: &Tube<N, Y>,
        reach: f64,
    ) {
        let is_first = self.is_first();
        if is_first {
            self.trust *= DISTRUST;
        }
        let here = tube.proof.h;
        self.shorter = match rejection {
            Rejection::Undecided(_) => return,
            // How long tubes are there is known, but for a little shift of the middle.
            Rejection::Unlinked if is_first && !next.reaches(&tube.exit) => {
                interpolated((here, next.proof.h), tube.exit_at, reach)
            }
            Rejection::Short(h) if is_first => interpolated((here, h), tube.exit_at, reach),
            _ => 0.5 * reach,
        };
    }

    /// Whether no place for this tube has been tried yet.
    pub fn is_first(&self) -> bool {
        self.shorter.is_infinite()
    }

    /// Nothing is known any more.
    pub fn forget(&mut self) {
        (self.trust, self.shorter) = (1.0, f64::INFINITY);
    }

    /// The least reach that rejections of this tube have left.
    pub fn is_below(&self, smallest: f64) -> bool {
        self.shorter < smallest
    }
}

/// A reach over which a tube should reach back, half lengths being `here` at the middle of the last
/// one, `there` at `reach` behind its exit, and exponential in between.
fn interpolated((here, there): (f64, f64), exit: f64, reach: f64) -> f64 {
    let rate = (there / here).ln() / (exit + reach);
    let is_reached = |s: f64| s < REACH_SEEN * here * (rate * (exit + s)).exp();
    let (lo, _) = halved((0.0, reach), 8, is_reached);
    lo.clamp(0.1 * reach, 0.9 * reach)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rejected_length_tells_where_to_go() {
        // As long there as here: all the reach that there is. Half as long: that much of what is there.
        assert_eq!(interpolated((1.0, 1.0), 0.97, 0.5), 0.9 * 0.5);
        let reach = interpolated((1.0, 0.2), 0.97, 0.5);
        let length = 0.2f64.powf((0.97 + reach) / 1.47);
        assert!(
            (reach - REACH_SEEN * length).abs() < 0.01,
            "{reach} {length}"
        );
        // Whatever was seen, it shrinks, and not to nothing.
        for there in [0.0, 1e-300, 1e-9, f64::INFINITY, f64::NAN] {
            let reach = interpolated((1.0, there), 0.97, 0.5);
            assert!((0.05..=0.45).contains(&reach), "{there}: {reach}");
        }
    }
}
