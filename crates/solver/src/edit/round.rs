//! A dimension led as far as its path goes: past every place where it turns back, until the figure comes back.

use super::open::OpenError;
use super::setting::Setting;
use super::way::Way as _;
use super::whole::Whole;
use crate::interval::{Interval, point};
use crate::places::Each as _;
use crate::problem::{Point, Problem};
use crate::system::{Homotopy, Located, Placement};
use crate::track::certified::track_from;
use crate::track::{Control, Options, Outcome, PathEnd, StartError, Status, Stop, StopKind, Trace};
use std::slice;

/// So far may the path be from the middle of a tube, in typical lengths: what is measured along it is known about that well.
const FINE: f64 = 1e-8;

/// All figures of a path along which one distance changes and all other dimensions stand still.
pub(crate) struct Round {
    whole: Whole,
    /// From the trace's coordinates to those of the drawing: one motion for all figures, so that the reference's points stand still, the
    /// first where it is drawn and the next ones on the ray, and in the plane, in which they are.
    pub placement: Placement,
    /// It.
    pub trace: Trace,
    /// Where it ends one way and the other; none of a loop.
    pub ends: Vec<WayEnd>,
    /// The tubes.
    pub tubes: usize,
}

/// Where a path ends, or was followed no further.
#[derive(Debug, Clone, PartialEq)]
pub struct WayEnd {
    /// Why, as a word for programs: [`crate::track::EndKind::name`] or [`crate::track::StopKind::name`].
    pub kind: &'static str,
    /// Whether it is a place of the figure's own, past which it was not to be followed, and not one where time or the proof came to an end.
    pub is_told: bool,
    /// Why, in words.
    pub words: String,
}

impl From<&PathEnd> for WayEnd {
    fn from(end: &PathEnd) -> Self {
        WayEnd {
            kind: end.stop.map_or(end.kind.name(), StopKind::name),
            is_told: end.stop.is_none_or(|stop| stop == StopKind::Singular),
            words: end.reason.clone(),
        }
    }
}

impl From<&Stop> for WayEnd {
    fn from(stop: &Stop) -> Self {
        WayEnd {
            kind: stop.kind.name(),
            is_told: stop.kind == StopKind::Singular,
            words: stop.text.clone(),
        }
    }
}

impl Round {
    /// Takes the sketch of a checked problem for the figure, as [`super::Session`] does, and follows it while one of its distances is
    /// led towards a value, and on from there, until it comes back; or else both ways as far as it goes. `drawn`: the points as they are drawn,
    /// where those of the sketch were moved.
    pub fn new(
        (problem, drawn): (&Problem, &[Point]),
        setting: &Setting,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let mut whole = Whole::open_with(problem, options, control)?;
        let drawing = Problem {
            points: drawn.to_vec(),
            ..problem.clone()
        };
        let placement = Placement::of(&drawing).map_err(StartError::from)?;
        let radius = Some(FINE * whole.homotopy().unit);
        let options = Options {
            tube_radius: radius,
            ..round(options)
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
            placement,
            trace,
            ends: ends(&outcome),
            tubes: outcome.steps,
        })
    }

    /// Follows the same path again for the witness of `control`, and tells how that ended.
    pub fn tell(
        problem: &Problem,
        setting: &Setting,
        options: &Options,
        control: &mut Control,
    ) -> Result<Status, OpenError> {
        let mut whole = Whole::open_with(problem, options, control)?;
        let told = whole.lead_on(setting, |homotopy, figure| {
            if let Some(witness) = &mut control.witness {
                witness.begin_motion(&[(setting.index, &setting.target)]);
            }
            track_from(homotopy, Some(figure), &round(options), control).status
        });
        Ok(told.map_err(StartError::Unsupported)?)
    }

    /// Whether the path comes back to the figure that it sets out from.
    pub fn is_loop(&self) -> bool {
        self.ends.is_empty()
    }

    /// The equations that it was followed by.
    pub fn homotopy(&self) -> &Homotopy {
        self.whole.homotopy()
    }

    /// An unknown of the figure that it sets out from, in the homotopy's own unit.
    pub fn unknown(&self, i: usize) -> Interval {
        self.whole.figure().enclosure(i)
    }

    /// Where objects are in that figure.
    pub fn objects(&self) -> Vec<Located> {
        self.homotopy().locate(&self.figure(), &|i| self.unknown(i))
    }

    /// The figure that it sets out from, in the coordinates of the problem, as all others of the way.
    pub fn figure(&self) -> Vec<[Interval; 3]> {
        let homotopy = self.whole.homotopy();
        let unit = point(homotopy.unit);
        let places = self.whole.figure().points(homotopy);
        let places: Vec<_> = places.iter().map(|p| p.each(|x| x * unit)).collect();
        self.in_problem(&places)
    }

    /// How many equations it was followed by, the one of the distance that is led not among them.
    pub fn equations(&self) -> usize {
        self.whole.homotopy().equations - 1
    }

    /// How far the sketch was from it.
    pub fn moved(&self) -> super::Moved {
        self.whole.moved()
    }

    /// A figure of the trace in the coordinates of the drawing.
    pub fn in_problem(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        places
            .iter()
            .map(|p| self.placement.to_problem(p))
            .collect()
    }

    /// The points that stand still so; none where constraints say where the figure is.
    pub fn standing(&self) -> &[usize] {
        &self.whole.problem().homotopy.reference
    }
}

/// Options for a path that is followed as far as it goes.
fn round(options: &Options) -> Options {
    Options {
        threads: 1,
        both_ways: true,
        ..options.clone()
    }
}

/// Where a run ended.
fn ends(outcome: &Outcome) -> Vec<WayEnd> {
    match &outcome.status {
        Status::Closed => Vec::new(),
        Status::Open(ends) => ends.iter().map(WayEnd::from).collect(),
        Status::Stopped(stop) => vec![WayEnd::from(stop)],
    }
}

impl Whole {
    /// Follows the path along which a distance is led towards a value, from this figure.
    fn lead_on<T>(
        &mut self,
        setting: &Setting,
        follow: impl FnOnce(&Homotopy, &crate::track::arc::Figure) -> T,
    ) -> Result<T, String> {
        let from = self.problem().distances[setting.index].target.clone();
        let homotopy = self.homotopy_mut();
        homotopy.lead(setting.index, &from, &setting.target);
        let led = self.lead_constraints(slice::from_ref(setting));
        let followed = led.map(|_| follow(self.homotopy(), self.figure()));
        self.homotopy_mut().hold(setting.index, &from);
        followed
    }
}
