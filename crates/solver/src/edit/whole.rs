//! A figure followed as a whole: one up to motions, or any for a certificate.

use super::ending::{Edited, Ending, Limit, Orientations};
use super::open::{self, Moved, OpenError};
use super::parts::MOST_TUBES;
use super::parts::senses::senses;
use super::place::Stand;
use super::segments::{NARROWER, Reversed, first_lost, is_same_by_constraint, segments, stop};
use super::setting::Setting;
use crate::blocks::Account;
use crate::constraint::{Fault, Lowered, Owner, Record, try_lower_editable};
use crate::interval::{Interval, enclose, hull, point};
use crate::places::Each as _;
use crate::problem::{Decimal, Problem, Target};
use crate::system::{Homotopy, Located, typical_length};
use crate::track::arc::{ArcEnd, ArcRun, Figure, Fold, Orientation};
use crate::track::certified::{FollowArcs, arcs};
use crate::track::{Control, LARGEST_SQUARE, Options, Space, StartError, Stop, StopKind};
use std::sync::atomic::Ordering;
use std::time::Instant;

/// A figure that meets its dimensions, and what follows edits of it; set up once for all of them.
#[derive(Debug)]
pub(crate) struct Whole {
    problem: Problem,
    options: Options,
    arcs: Box<dyn FollowArcs>,
    stand: Stand,
    figure: Figure,
    lengths: Vec<Interval>,
    moved: Moved,
    /// What the constraints that are not distances were led to, where there are any.
    record: Option<Record>,
}

impl Whole {
    /// See [`super::Session::open_with`]: options, of which space, the longest step, the radius of tubes, α, extended
    /// precision and the limit of steps matter.
    ///
    /// The space is the full one for small problems and otherwise the reduced one, with the full one where that
    /// stops, unless `options` have the reduced one.
    pub fn open_with(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let lower = |problem: &Problem| try_lower_editable(problem, None);
        Self::open_lowered(problem, lower, options, control)
    }

    /// The same with the equations of constraints as `lower` makes them.
    pub(super) fn open_lowered(
        problem: &Problem,
        lower: impl FnOnce(&Problem) -> Result<Lowered, (Owner, Fault)>,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let mut problem = problem.clone();
        problem.homotopy.bend_coefficient = Decimal::from(0);
        problem.homotopy.detour = Decimal::from(0);
        let mut record = None;
        let homotopy = if problem.is_distances_only() {
            Homotopy::new(&problem)?
        } else {
            let lowered = super::lowered(&problem, lower).map_err(StartError::Unsupported)?;
            record = Some(lowered.record);
            let mut homotopy =
                Homotopy::with_constraints(&problem, typical_length(&problem), |_| lowered.tail)?;
            homotopy.followed = senses(&problem);
            homotopy.segments = segments(&problem, is_same_by_constraint(&problem));
            homotopy
        };
        if homotopy.equations > LARGEST_SQUARE {
            let what = format!(
                "there are {} free coordinates, more than the {LARGEST_SQUARE} of which proofs keep square \
                 matrices",
                homotopy.equations
            );
            return Err(StartError::Unsupported(what).into());
        }
        let placement = homotopy.gauge.placement(&problem);
        let stand = Stand::new(&problem, placement.map_err(StartError::from)?);
        let space = match options.space {
            // The reduced space is that of distances.
            _ if !problem.is_distances_only() => Space::Full,
            // A certificate's tubes are those of the full space.
            _ if control.witness.is_some() => Space::Full,
            Space::Full => Space::for_certified(problem.distances.len()),
            Space::Reduced => Space::Reduced,
        };
        // Figures of distances cannot grow without end as those of angles can.
        let most = match problem.is_distances_only() {
            true => options.max_steps,
            false => options.max_steps.min(MOST_TUBES),
        };
        let options = Options {
            space,
            reverse: false,
            max_steps: most,
            ..options.clone()
        };
        let mut arcs = arcs(homotopy, &options);
        if let Some(witness) = &mut control.witness {
            witness.begin(arcs.homotopy().unit);
        }
        let (figure, moved) = open::correct(&problem, &mut *arcs, control)?;
        let lengths = problem.distances.iter().map(|d| length(&d.target));
        Ok(Whole {
            lengths: lengths.collect(),
            problem,
            options,
            arcs,
            stand,
            figure,
            moved,
            record,
        })
    }

    /// The problem with the dimensions as they are now. Its sketch is the one that was given.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// How far the sketch was from the first figure.
    pub fn moved(&self) -> Moved {
        self.moved
    }

    /// What a dimension is now: an enclosure.
    pub fn length(&self, index: usize) -> Interval {
        match self.lengths.get(index) {
            Some(length) => *length,
            None => Setting::now(&self.problem, index).value(),
        }
    }

    /// The figure, in the coordinates of the problem: a box that holds exactly one with these dimensions. The
    /// first point stays where the sketch has it, the next one that is elsewhere stays on its ray from there, and
    /// in space the next one off that line stays on its side of their plane.
    pub fn points(&self) -> Vec<[Interval; 3]> {
        self.in_problem(&self.figure)
    }

    /// What a claim is proved of: as many equations as unknowns, all of them.
    pub fn scope(&self) -> Account {
        Account {
            equations: self.arcs.homotopy().equations,
            ..Account::default()
        }
    }

    /// Where the objects are.
    pub fn objects(&self) -> Vec<Located> {
        self.objects_of(&self.figure)
    }

    fn objects_of(&self, figure: &Figure) -> Vec<Located> {
        let points = self.in_problem(figure);
        let homotopy = self.arcs.homotopy();
        homotopy.locate(&points, |unknown| figure.enclosure(unknown))
    }

    /// See [`super::Session::edit_with`].
    pub fn edit_with(&mut self, settings: &[Setting], control: &mut Control) -> Edited {
        let (edited, reached) = self.attempt(settings, control);
        if let Some((figure, record)) = reached {
            self.figure = figure;
            self.record = record;
            for setting in settings {
                setting.apply(&mut self.problem);
                if let Some(old) = self.lengths.get_mut(setting.index) {
                    *old = length(&setting.target);
                    let homotopy = self.arcs.homotopy_mut();
                    homotopy.hold(setting.index, &setting.target);
                }
            }
        }
        edited
    }

    /// What an edit would come to; the figure stays what it is.
    pub fn probe(&mut self, settings: &[Setting], control: &mut Control) -> Edited {
        // What would come to pass is no part of a chain of edits.
        let witness = control.witness.take();
        let edited = self.attempt(settings, control).0;
        control.witness = witness;
        edited
    }

    /// An edit, and the figure that was reached if so, with what constraints were led to. The lengths of the homotopy's
    /// distances are as before; right-hand sides of other constraints are set by every edit anew.
    fn attempt(
        &mut self,
        settings: &[Setting],
        control: &mut Control,
    ) -> (Edited, Option<(Figure, Option<Record>)>) {
        let clock = Instant::now();
        let head = self.problem.distances.len();
        let distances = || settings.iter().filter(|setting| setting.index < head);
        let homotopy = self.arcs.homotopy_mut();
        for setting in distances() {
            let from = &self.problem.distances[setting.index].target;
            homotopy.lead(setting.index, from, &setting.target);
        }
        let record = self.lead_constraints(settings);
        let run = match &record {
            Err(fault) => ArcRun::stopped(Stop::new(StopKind::Refused, &**fault)),
            Ok(_) => {
                if let Some(witness) = &mut control.witness {
                    let led = settings.iter().map(|s| (s.index, &s.target));
                    witness.begin_arc(&led.collect::<Vec<_>>());
                }
                let run = self.follow(control);
                if let Some(witness) = &mut control.witness {
                    witness.end_arc(&run);
                }
                run
            }
        };
        let run = self.end_where_segments_vanish(settings, run, control);
        let homotopy = self.arcs.homotopy_mut();
        for setting in distances() {
            let now = &self.problem.distances[setting.index].target;
            homotopy.hold(setting.index, now);
        }
        let (edited, figure) = self.account(settings, run);
        let seconds = clock.elapsed().as_secs_f64();
        let reached = figure.and_then(|figure| Some((figure, record.ok()?)));
        (Edited { seconds, ..edited }, reached)
    }

    /// Leads the constraints that are not distances, in proportion to t, from what they are to what they are to be, once
    /// for an edit. What they are then led to comes back, where they can be edited.
    pub(super) fn lead_constraints(
        &mut self,
        settings: &[Setting],
    ) -> Result<Option<Record>, String> {
        if self.arcs.homotopy().tail.is_empty() {
            return Ok(None);
        }
        let mut edited = self.problem.clone();
        for setting in settings {
            setting.apply(&mut edited);
        }
        let homotopy = self.arcs.homotopy_mut();
        let lowered = super::lowered(&edited, |edited| {
            try_lower_editable(edited, self.record.as_ref())
        })?;
        match homotopy.set_constraints(&lowered.tail) {
            true => Ok(Some(lowered.record)),
            false => Err("with the new dimensions the constraints are other equations".to_owned()),
        }
    }

    /// Follows the arc, in the full space where the reduced one stops.
    fn follow(&mut self, control: &mut Control) -> ArcRun {
        let run = self.arcs.follow(&self.figure, control);
        let is_cancelled = control
            .cancel
            .is_some_and(|flag| flag.load(Ordering::Relaxed));
        let (ArcEnd::Passes(reason) | ArcEnd::Stopped(reason)) = &run.end else {
            return run;
        };
        if self.options.space == Space::Full || is_cancelled {
            return run;
        }
        let full = Options {
            space: Space::Full,
            ..self.options.clone()
        };
        let homotopy = self.arcs.homotopy().clone();
        let mut second = arcs(homotopy, &full).follow(&self.figure, control);
        let remark = format!("full space: in the reduced space the run stopped, {reason}");
        second.switched_on.push(remark);
        second
    }

    /// The run, ended where a line or arc shrinks to nothing.
    fn end_where_segments_vanish(
        &self,
        settings: &[Setting],
        mut run: ArcRun,
        control: &mut Control,
    ) -> ArcRun {
        // A certificate is of the run that was made.
        let witness = control.witness.take();
        for radius in NARROWER {
            if self.lost_segment(settings, &run).is_none() {
                break;
            }
            let homotopy = self.arcs.homotopy();
            let options = Options {
                tube_radius: Some(radius * homotopy.unit),
                ..self.options.clone()
            };
            let again = arcs(homotopy.clone(), &options).follow(&self.figure, control);
            run.steps += again.steps;
            let is_told = matches!(again.end, ArcEnd::Reached(_) | ArcEnd::Limit(_));
            if !is_told && self.lost_segment(settings, &again).is_none() {
                break;
            }
            run.segments = again.segments;
        }
        control.witness = witness;
        match self.lost_segment(settings, &run) {
            Some((stop, t)) => ArcRun {
                end: ArcEnd::Stopped(stop),
                t,
                ..run
            },
            None => run,
        }
    }

    /// Why a run ends at a line or arc that shrinks to nothing, and where, if it does.
    fn lost_segment(&self, settings: &[Setting], run: &ArcRun) -> Option<(Stop, (f64, f64))> {
        let head = self.problem.distances.len();
        let reversed = settings.iter().filter_map(|s| {
            let (from, to) = (self.length(s.index), s.value());
            Reversed::new(&self.problem, s.index.checked_sub(head)?, from, to)
        });
        let reversed: Vec<Reversed> = reversed.collect();
        let is_asked = |object: usize| {
            let mut segments = self.arcs.homotopy().segments.iter();
            let segment = segments.find(|segment| segment.object == object);
            let same = is_same_by_constraint(&self.problem);
            let zero = |_: usize, _: usize| false;
            segment.is_some_and(|s| reversed.iter().any(|r| r.is_of(s, &same, zero)))
        };
        let (kept, t) = first_lost(&run.segments, run.t, is_asked)?;
        Some((stop(&self.problem, kept), t))
    }

    fn account(&self, settings: &[Setting], run: ArcRun) -> (Edited, Option<Figure>) {
        let t = hull(run.t.0, run.t.1);
        let t = (!matches!(run.end, ArcEnd::Reached(_))).then_some(t);
        let dimensions = settings
            .iter()
            .map(|s| s.at(&self.problem, self.length(s.index), t));
        let dimensions = dimensions.collect();
        let (ending, at, figure) = match run.end {
            ArcEnd::Reached(figure) => (Ending::Reached, figure.clone(), Some(figure)),
            ArcEnd::Limit(fold) => {
                let limit = self.limit(&fold, &run.orientations);
                (Ending::Limit(limit), fold.figure, None)
            }
            ArcEnd::Passes(reason) => (Ending::Passes(reason), self.figure.clone(), None),
            ArcEnd::Stopped(reason) => (Ending::Stopped(reason), self.figure.clone(), None),
        };
        let edited = Edited {
            ending,
            t: run.t,
            dimensions,
            points: self.in_problem(&at),
            objects: self.objects_of(&at),
            orientations: Orientations::new(run.orientations),
            tubes: run.steps,
            rejected: run.rejected,
            length: run.length,
            switched_on: run.switched_on,
            account: self.scope(),
            singular: None,
            astray: None,
            dragged: None,
            seconds: 0.0,
        };
        (edited, figure)
    }

    /// What is special about a fold's figure.
    fn limit(&self, fold: &Fold, orientations: &[Orientation]) -> Limit {
        let homotopy = self.arcs.homotopy();
        let places = fold.figure.points(homotopy);
        let velocity = Figure {
            centre: fold.velocity.clone(),
            low: vec![0.0; fold.velocity.len()],
            radius: vec![0.0; fold.velocity.len()],
        };
        let velocity = velocity.points(homotopy);
        let d = homotopy.dimension;
        let turned = velocity.iter().map(|v| {
            let v = v.each(|x| x.mid());
            self.stand.turn(d, &places, v)
        });
        Limit::new(&places, orientations, turned.collect())
    }

    /// A figure in the coordinates and lengths of the problem.
    fn in_problem(&self, figure: &Figure) -> Vec<[Interval; 3]> {
        let homotopy = self.arcs.homotopy();
        let unit = point(homotopy.unit);
        let mut points = figure.points(homotopy);
        for x in points.iter_mut().flatten() {
            *x *= unit;
        }
        self.put(&points)
    }

    /// A figure of the gauge, in lengths of the problem, in its coordinates.
    pub(super) fn put(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        self.stand.put(self.arcs.homotopy().dimension, places)
    }

    /// The homotopy's unit of length.
    pub(super) fn unit(&self) -> f64 {
        self.arcs.homotopy().unit
    }

    pub(super) fn homotopy(&self) -> &Homotopy {
        self.arcs.homotopy()
    }

    pub(super) fn homotopy_mut(&mut self) -> &mut Homotopy {
        self.arcs.homotopy_mut()
    }

    /// The figure as it is now.
    pub(super) fn first(&self) -> &Figure {
        &self.figure
    }
}

/// An enclosure of a target length.
pub(super) fn length(target: &Target) -> Interval {
    match target {
        Target::Length(length) => enclose(length),
        Target::SquaredLength(squared) => enclose(squared).sqrt(),
    }
}
