//! A dimension led as far as its path goes: past every place where it turns back, until the figure comes back.

use super::open::OpenError;
use super::setting::Setting;
use super::whole::Whole;
use crate::interval::Interval;
use crate::problem::Problem;
use crate::track::certified::track_from;
use crate::track::{Control, Options, Outcome, StartError, Trace};
use std::slice;

/// So far may the path be from the middle of a tube, in typical lengths: what is measured along it is known about that well.
const FINE: f64 = 1e-8;

/// All figures of a path along which one distance changes and all other dimensions stand still.
pub(crate) struct Round {
    whole: Whole,
    /// How the path was followed.
    pub outcome: Outcome,
    /// It.
    pub trace: Trace,
}

impl Round {
    /// Takes the sketch of a checked problem for the figure, as [`super::Session`] does, and follows it while one of its distances is
    /// led towards a value, and on from there, until it comes back.
    pub fn new(
        problem: &Problem,
        setting: &Setting,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let mut whole = Whole::open_with(problem, options, control)?;
        let options = Options {
            tube_radius: Some(FINE * whole.unit()),
            threads: 1,
            ..options.clone()
        };
        let mut trace = Trace::default();
        let outcome = whole.lead_on(setting, |homotopy, figure| {
            let mut control = Control {
                cancel: control.cancel,
                limit: control.limit,
                trace: Some(&mut trace),
                ..Control::default()
            };
            track_from(homotopy, Some(figure), &options, &mut control)
        });
        let outcome = outcome.map_err(StartError::Unsupported)?;
        Ok(Round {
            whole,
            outcome,
            trace,
        })
    }

    /// The figure that it sets out from, in the coordinates of the problem.
    pub fn figure(&self) -> Vec<[Interval; 3]> {
        self.whole.points()
    }

    /// How many equations it was followed by, the one of the distance that is led not among them.
    pub fn equations(&self) -> usize {
        self.whole.homotopy().equations - 1
    }

    /// How far the sketch was from it.
    pub fn moved(&self) -> super::Moved {
        self.whole.moved()
    }

    /// A figure of the trace in the coordinates of the problem.
    pub fn in_problem(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        self.whole.put(places)
    }
}

impl Whole {
    /// Follows the path along which a distance is led towards a value, from this figure.
    fn lead_on<T>(
        &mut self,
        setting: &Setting,
        follow: impl FnOnce(&crate::system::Homotopy, &crate::track::arc::Figure) -> T,
    ) -> Result<T, String> {
        let from = self.problem().distances[setting.index].target.clone();
        let homotopy = self.homotopy_mut();
        homotopy.lead(setting.index, &from, &setting.target);
        let led = self.lead_constraints(slice::from_ref(setting));
        let followed = led.map(|_| follow(self.homotopy(), self.first()));
        self.homotopy_mut().hold(setting.index, &from);
        followed
    }
}
