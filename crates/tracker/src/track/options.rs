//! Tuning and limits of a run.

use super::{Mode, Space};

/// What to do, how carefully, and when to give up.
///
/// ```
/// use krawl::track::{Mode, Options, Space};
/// let options = Options::float(Space::Full).with_max_step(0.05).reversed();
/// assert_eq!(options.mode, Mode::Float);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Certified or float.
    pub mode: Mode,
    /// Full or reduced.
    pub space: Space,
    /// How float mode steps.
    pub preset: Preset,
    /// Steps are never longer than this, in arc length, in the lengths of the problem. `None`: as
    /// long as the step control allows.
    pub max_step: Option<f64>,
    /// Float mode: a point counts as one of the path when Newton's correction is about this small,
    /// in the lengths of the problem. Solutions are corrected to the end of precision whatever it
    /// is. `None`: 1e-8 typical lengths (in the reduced space 1e-6, or less where steps are short).
    pub tolerance: Option<f64>,
    /// Certified mode: every point of the path is proved to be no further than this from the middle
    /// of its tube, coordinate by coordinate, in the lengths of the problem. `None`: as far as a proof
    /// goes. A radius too small for 53 bits ends the run: where it is all that keeps tubes from being
    /// proved, extended precision is not switched on for it.
    pub tube_radius: Option<f64>,
    /// Follow the loop the other way round.
    pub reverse: bool,
    /// Certified mode: whatever stops the run one way, but an interrupt, it is followed the other way as well, and both are ends of
    /// the path ([`super::EndKind::Stopped`]).
    pub both_ways: bool,
    /// Edits of sketches in the plane: edges of closed outlines that are apart stay so, and a run ends where they come to touch.
    pub simple: bool,
    /// The threshold α on the distance to a boundary configuration (RR 8705, section 4.2) at
    /// which the construction plan is changed. Between 0 and ½.
    pub alpha: f64,
    /// Whether certified mode in the full space may switch extended precision on where 53 bits do not
    /// suffice; otherwise it stops there. Where they do suffice this changes nothing.
    pub extended: bool,
    /// Threads for one certified run; 0 means one for each processor. With two or more a path of distances alone is followed
    /// both ways from the sketch at once, until these meet, unless the [`Control`](crate::track::Control) keeps what is in the
    /// order of the path (a certificate, samples); and tubes of the full space with 127 free coordinates or more, whose
    /// tests are products of large matrices, take several. What is proved is the same; bounds may differ in
    /// their last digits, and from run to run.
    pub threads: usize,
    /// The run ends `stopped` after so many steps.
    pub max_steps: usize,
    /// Constraints that were left out, as there are more than unknowns, count as met within this, in the unit of their
    /// numbers; `None`: within half a unit of the last digit of their numbers (see [`crate::blocks::Account`]).
    pub redundant_tolerance: Option<f64>,
}

/// How float mode steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Preset {
    /// High-order predictor, steps chosen from the predictor's error, exact derivatives.
    Default,
    /// As in RR 8705, sections 7.1 to 7.3: Euler predictor, finite differences, steps doubled and
    /// halved in [1e-10, δmax] with δmax 0.1 (full) and 0.05 (reduced) in the lengths of the problem,
    /// or in typical lengths where those are far from 1 ([`Homotopy::for_the_paper`]).
    ///
    /// [`Homotopy::for_the_paper`]: crate::system::Homotopy::for_the_paper
    Paper,
}

impl Options {
    /// Certified mode in the full space.
    pub fn certified() -> Self {
        Options {
            mode: Mode::Certified,
            space: Space::Full,
            preset: Preset::Default,
            max_step: None,
            tolerance: None,
            tube_radius: None,
            reverse: false,
            both_ways: false,
            simple: false,
            alpha: 0.1,
            extended: true,
            threads: 1,
            max_steps: 10_000_000,
            redundant_tolerance: None,
        }
    }

    /// Float mode in the given space.
    pub fn float(space: Space) -> Self {
        Options {
            mode: Mode::Float,
            space,
            ..Self::certified()
        }
    }

    /// Float mode as in the paper.
    pub fn paper(space: Space) -> Self {
        Options {
            preset: Preset::Paper,
            ..Self::float(space)
        }
    }

    /// With a bound on the step.
    pub fn with_max_step(self, max_step: f64) -> Self {
        Options {
            max_step: Some(max_step),
            ..self
        }
    }

    /// With a tolerance for the points of a float run.
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Options {
            tolerance: Some(tolerance),
            ..self
        }
    }

    /// With a bound on the radius of a certified run's tubes.
    pub fn with_tube_radius(self, tube_radius: f64) -> Self {
        Options {
            tube_radius: Some(tube_radius),
            ..self
        }
    }

    /// The bound on the step in homotopies' units.
    #[doc(hidden)]
    pub fn step_in(&self, unit: f64) -> Option<f64> {
        self.max_step.map(|step| step / unit)
    }

    /// The tolerance in homotopies' units.
    #[doc(hidden)]
    pub fn tolerance_in(&self, unit: f64) -> Option<f64> {
        self.tolerance.map(|tolerance| tolerance / unit)
    }

    /// The tubes' radius in homotopies' units.
    #[doc(hidden)]
    pub fn radius(&self, unit: f64) -> f64 {
        self.tube_radius
            .map_or(f64::INFINITY, |radius| radius / unit)
    }

    /// In 53 bits only.
    pub fn without_extended(self) -> Self {
        Options {
            extended: false,
            ..self
        }
    }

    /// On several threads, where that helps; 0 means one for each processor: see [`Options::threads`].
    pub fn with_threads(self, threads: usize) -> Self {
        Options { threads, ..self }
    }

    /// In the other direction.
    pub fn reversed(self) -> Self {
        Options {
            reverse: !self.reverse,
            ..self
        }
    }
}
