//! A figure followed as a whole: one up to motions, or any for a certificate.

use super::ending::{Edited, Keep, Limit};
use super::open::{self, Moved, OpenError};
use super::parts::MOST_TUBES;
use super::parts::senses::senses;
use super::place::Stand;
use super::segments::{is_same_by_constraint, outlines, segments};
use super::setting::Setting;
use super::way::Way;
use crate::blocks::Account;
use crate::constraint::{Entry, Fault, Lowered, Owner, Record, own_number, try_lower_editable};
use crate::interval::{Interval, point};
use crate::places::Each as _;
use crate::problem::{Decimal, Problem};
use crate::system::{Homotopy, Located, Segment, typical_length};
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
    /// The names of edges of closed outlines that are not kept apart, where the others are.
    outlines: Option<Vec<String>>,
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
        let (mut record, mut others) = (None, options.simple.then(Vec::new));
        let homotopy = if problem.is_distances_only() {
            Homotopy::new(&problem)?
        } else {
            let lowered = super::lowered(&problem, lower).map_err(StartError::Unsupported)?;
            record = Some(lowered.record);
            let mut homotopy =
                Homotopy::with_constraints(&problem, typical_length(&problem), |_| lowered.tail)?;
            homotopy.followed = senses(&problem);
            homotopy.segments = segments(&problem, is_same_by_constraint(&problem));
            if options.simple {
                let radius = |object: usize| {
                    let own = &homotopy.tail.objects[object];
                    let own = own_number(&problem.objects[object].shape, own);
                    homotopy.entry(own.map_or(Entry::Zero, Entry::Unknown))
                };
                let found = outlines(&problem, is_same_by_constraint(&problem), radius);
                homotopy.segments.extend(found.pairs);
                others = Some(found.others);
            }
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
        let (figure, moved) = open::correct(&problem, (&mut *arcs, &options), control)?;
        let lengths = problem.distances.iter().map(|d| d.target.enclose());
        Ok(Whole {
            lengths: lengths.collect(),
            problem,
            options,
            arcs,
            stand,
            figure,
            moved,
            record,
            outlines: others,
        })
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
        let mut run = match &record {
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
        // A certificate is of the run that was made.
        let witness = control.witness.take();
        self.end_where_segments_vanish(settings, &mut run, |whole, radius| {
            let homotopy = whole.arcs.homotopy();
            narrower(homotopy, &whole.options, radius).follow(&whole.figure, control)
        });
        control.witness = witness;
        let homotopy = self.arcs.homotopy_mut();
        for setting in distances() {
            let now = &self.problem.distances[setting.index].target;
            homotopy.hold(setting.index, now);
        }
        let figure = match &run.end {
            ArcEnd::Reached(figure) => Some(figure.clone()),
            _ => None,
        };
        let reached = figure.and_then(|figure| Some((figure, record.ok()?)));
        let edited = self.edited(settings, run, self.account());
        let seconds = clock.elapsed().as_secs_f64();
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
        let edited = Setting::applied(settings, &self.problem);
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

    /// A figure of the gauge, in lengths of the problem, in its coordinates.
    pub(super) fn put(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        self.stand.put(self.arcs.homotopy().dimension, places)
    }

    pub(super) fn homotopy(&self) -> &Homotopy {
        self.arcs.homotopy()
    }

    pub(super) fn homotopy_mut(&mut self) -> &mut Homotopy {
        self.arcs.homotopy_mut()
    }
}

/// What follows arcs of a homotopy in tubes of at most such a radius, as a part of the unit of length.
pub(super) fn narrower(homotopy: &Homotopy, options: &Options, radius: f64) -> Box<dyn FollowArcs> {
    let options = Options {
        tube_radius: Some(radius * homotopy.unit),
        ..options.clone()
    };
    arcs(homotopy.clone(), &options)
}

impl Clone for Whole {
    fn clone(&self) -> Self {
        Whole {
            problem: self.problem.clone(),
            options: self.options.clone(),
            arcs: arcs(self.arcs.homotopy().clone(), &self.options),
            stand: self.stand.clone(),
            figure: self.figure.clone(),
            lengths: self.lengths.clone(),
            moved: self.moved,
            record: self.record.clone(),
            outlines: self.outlines.clone(),
        }
    }
}

impl Way for Whole {
    fn copy(&self) -> Box<dyn Way> {
        Box::new(self.clone())
    }

    fn problem(&self) -> &Problem {
        &self.problem
    }

    fn moved(&self) -> Moved {
        self.moved
    }

    fn length(&self, index: usize) -> Interval {
        match self.lengths.get(index) {
            Some(length) => *length,
            None => Setting::now(&self.problem, index).value(),
        }
    }

    fn figure(&self) -> &Figure {
        &self.figure
    }

    fn points_of(&self, figure: &Figure) -> Vec<[Interval; 3]> {
        let homotopy = self.arcs.homotopy();
        let unit = point(homotopy.unit);
        let mut points = figure.points(homotopy);
        for x in points.iter_mut().flatten() {
            *x *= unit;
        }
        self.put(&points)
    }

    fn objects_of(&self, figure: &Figure) -> Vec<Located> {
        let points = self.points_of(figure);
        let homotopy = self.arcs.homotopy();
        homotopy.locate(&points, &|unknown| figure.enclosure(unknown))
    }

    fn limit(&self, fold: &Fold, orientations: &[Orientation]) -> Limit {
        let homotopy = self.arcs.homotopy();
        let places = fold.figure.points(homotopy);
        let velocity = Figure::around(fold.velocity.clone(), vec![0.0; fold.velocity.len()]);
        let velocity = velocity.points(homotopy);
        let d = homotopy.dimension;
        let turned = velocity.iter().map(|v| {
            let v = v.each(|x| x.mid());
            self.stand.turn(d, &places, v)
        });
        Limit::new(&places, orientations, turned.collect())
    }

    fn account(&self) -> Account {
        // As many equations as unknowns, all of them.
        Account::of(&self.problem, self.arcs.homotopy().equations)
    }

    fn segments(&self) -> &[Segment] {
        &self.arcs.homotopy().segments
    }

    fn outlines(&self) -> Option<&[String]> {
        self.outlines.as_deref()
    }

    fn is_same(&self, a: usize, b: usize, axis: usize) -> bool {
        is_same_by_constraint(&self.problem)(a, b, axis)
    }

    fn is_zero(&self, _: usize, _: usize) -> bool {
        false
    }

    fn edit(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited {
        // What would come to pass is no part of a chain of edits.
        let hidden = control.witness.take_if(|_| keep == Keep::Never);
        let (edited, reached) = self.attempt(settings, control);
        control.witness = hidden.or(control.witness.take());
        if let Some((figure, record)) = reached
            && keep.is_taken(&edited)
        {
            self.figure = figure;
            self.record = record;
            for setting in settings {
                setting.apply(&mut self.problem);
                if let Some(old) = self.lengths.get_mut(setting.index) {
                    *old = setting.target.enclose();
                    let homotopy = self.arcs.homotopy_mut();
                    homotopy.hold(setting.index, &setting.target);
                }
            }
        }
        edited
    }
}
