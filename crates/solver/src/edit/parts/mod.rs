//! A sketch in its own frame, followed part by part.
//!
//! Real sketches fall apart ([`crate::blocks`]). An edit moves the blocks in which its dimensions are and those that
//! need them; what is linear in numbers that are known exactly is computed, as a polynomial in t with exact
//! coefficients; the rest is followed, each connected part for itself with all that it needs, along the same t. Points
//! that nothing determines stay put, and equations that follow from others at the figure are left out and looked at in
//! the end.

mod anew;
mod contacts;
mod drag;
mod exact;
mod extreme;
mod follow;
mod left_out;
mod off;
mod on_the_way;
pub(super) mod senses;
mod standing;
mod words;

use crate::blocks::{Account, Combination, Cut, Given, Used, Verdict};
use crate::constraint::try_lower_all;
use crate::edit::drag::Drag;
use crate::edit::ending::{Astray, Edited, Ending, Keep, Limit};
use crate::edit::lowered;
use crate::edit::open::{Moved, OpenError, furthest, reached};
use crate::edit::segments::{outlines, segments};
use crate::edit::setting::Setting;
use crate::edit::way::Way;
use crate::interval::{Interval, Real, hull, point};
use crate::places::array;
use crate::problem::Problem;
use crate::system::{Extent, Located, Segment};
use crate::track::arc::{ArcEnd, ArcRun, Figure, Fold, Orientation};
use crate::track::certified::FollowArcs;
use crate::track::{Control, Options, StartError, Stop, StopKind};
pub use extreme::Extreme;
use left_out::at_rest_all;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::time::Instant;

/// A part is followed over so many tubes and then given up. Edits of real sketches take a few; those that came to so
/// many had ever longer tubes and ever larger figures, as where two lines become parallel.
pub(super) const MOST_TUBES: usize = 1000;

/// Followers of parts that were needed before, by their blocks. A copy has none yet.
#[derive(Debug, Default)]
struct Followers(HashMap<Vec<usize>, Box<dyn FollowArcs>>);

impl Clone for Followers {
    fn clone(&self) -> Self {
        Followers::default()
    }
}

/// A sketch and its figure.
#[derive(Debug, Clone)]
pub(super) struct Parts {
    options: Options,
    /// Its equations, and how they are cut.
    cut: Cut,
    /// What those used say, and for each redundant row how it follows from them, if that was found.
    given: Vec<Given>,
    follows: Vec<Option<Combination>>,
    /// For each whether that is proved of the figure.
    proved: Vec<bool>,
    /// How the figure stands to each.
    verdicts: Vec<Verdict>,
    /// Blocks that are followed together if any of them moves: those of points of which the orientation is a sense, and
    /// those of vectors that must not vanish.
    together: Vec<BTreeSet<usize>>,
    /// Points of which the orientation is a sense that constraints leave open: followed always.
    senses: Vec<Vec<usize>>,
    /// Those, and points that distances join, which are followed where all of them are in one part.
    followed: Vec<Vec<usize>>,
    /// Lines along an axis and arcs, which must not vanish: followed always.
    segments: Vec<Segment>,
    /// The names of edges of closed outlines that are not kept apart, where the others are.
    outlines: Option<Vec<String>>,
    figure: Figure,
    /// Circles that touch lines by their numbers, which have equations that were added; and the problem without these.
    contacts: Vec<contacts::Kept>,
    plain: Option<Box<Problem>>,
    moved: Moved,
    ready: Followers,
    /// By how much unknowns that are held otherwise change on the way, in the unit of the problem.
    led: HashMap<usize, Real>,
    /// Of what was left out, by place: what is looked at all along the way.
    looked_at: Vec<usize>,
}

/// What is proved of the figures of a run.
struct Judged {
    /// How the last one stands to what was left out.
    verdicts: Vec<Verdict>,
    account: Account,
    astray: Option<Astray>,
}

fn refuse(what: String) -> OpenError {
    OpenError::Start(StartError::Unsupported(what))
}

impl Parts {
    /// Takes the sketch for the figure, after leading it to its own dimensions.
    pub fn open(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let (mut parts, rights) = Self::assemble(problem, options).map_err(refuse)?;
        match parts.lead(&rights, control) {
            Ok(()) if parts.cut.singular.is_some() => {
                parts.find_other(problem, 0, control);
                Ok(parts)
            }
            Ok(()) => Ok(parts),
            Err(error) => parts.lead_otherwise(problem, control).ok_or(error),
        }
    }

    /// Merges, chooses and cuts; the figure is the sketch still, which the right-hand sides that come along lead to its
    /// dimensions.
    pub fn assemble(
        problem: &Problem,
        options: &Options,
    ) -> Result<(Self, Vec<Vec<Real>>), String> {
        Self::assemble_in(problem, options, 0)
    }

    /// The same, moved off a singular drawing in this way.
    pub(super) fn assemble_in(
        problem: &Problem,
        options: &Options,
        way: u64,
    ) -> Result<(Self, Vec<Vec<Real>>), String> {
        let asked = problem;
        let (mut cut, contacts) = contacts::followed(asked, Cut::drawn(asked, way)?, way);
        let rights = std::mem::take(&mut cut.rights);
        let Cut {
            problem,
            system,
            unit,
            ..
        } = &cut;
        let mut plain = problem.clone();
        plain.constraints.truncate(asked.constraints.len());
        let plain = (!contacts.is_empty()).then(|| Box::new(plain));
        let values = system.unknowns.iter().zip(&system.values);
        let figure = Figure::within(values.map(|(unknown, value)| {
            let scale = unit.powi(unknown.power);
            value.enclose() * point(1.0 / scale)
        }));
        let is_same = |a: usize, b: usize, axis: usize| {
            let place = |p: usize| system.coordinates[p * problem.dimension + axis];
            place(a) == place(b)
        };
        let mut segments = segments(problem, is_same);
        let mut others = None;
        if options.simple {
            let found = outlines(problem, is_same, |object| cut.numbers[object]);
            segments.extend(found.pairs);
            others = Some(found.others);
        }
        let mut parts = Parts {
            senses: senses::senses(asked),
            followed: senses::followed(asked),
            contacts,
            plain,
            segments,
            outlines: others,
            options: Options {
                space: crate::track::Space::Full,
                reverse: false,
                max_steps: options.max_steps.min(MOST_TUBES),
                ..options.clone()
            },
            given: Vec::new(),
            follows: Vec::new(),
            proved: Vec::new(),
            verdicts: Vec::new(),
            together: Vec::new(),
            figure,
            moved: Moved::default(),
            ready: Followers::default(),
            led: HashMap::new(),
            looked_at: Vec::new(),
            cut,
        };
        parts.drop_flat_triples();
        parts.together = parts.bound_together();
        parts.find_what_follows(&rights);
        Ok((parts, rights))
    }

    /// Leads the sketch to its own dimensions.
    fn lead(&mut self, rights: &[Vec<Real>], control: &mut Control) -> Result<(), OpenError> {
        let mut run = self.follow(rights, control);
        self.end_in_narrow_tubes((&[], rights), &mut run, control);
        let figure = reached(run.end, run.t)?;
        let distance = self.distance(&figure);
        self.moved = Moved {
            distance,
            tubes: run.steps.max(usize::from(distance > 0.0)),
        };
        self.figure = figure;
        self.verdicts = self.verdicts(&self.figure, &at_rest_all(rights), None);
        match self
            .missed(&self.verdicts)
            .map(|(_, stop)| stop)
            .or_else(|| self.vanished(&self.figure))
        {
            Some(stop) => Err(OpenError::stopped(self.sober(stop))),
            None => Ok(()),
        }
    }

    /// Triples of which two points are one and the same have no orientation.
    fn drop_flat_triples(&mut self) {
        let d = self.cut.problem.dimension;
        let coordinates = &self.cut.system.coordinates;
        let place = |p: usize| &coordinates[p * d..(p + 1) * d];
        let differ = |points: &Vec<usize>| {
            let mut places: Vec<&[usize]> = points.iter().map(|&p| place(p)).collect();
            places.sort_unstable();
            places.windows(2).all(|pair| pair[0] != pair[1])
        };
        self.senses.retain(differ);
        self.followed.retain(differ);
    }

    /// The unknowns that are coordinates of some points along some axes, point by point.
    fn places<'p>(
        &'p self,
        points: &'p [usize],
        axes: Range<usize>,
    ) -> impl Iterator<Item = usize> + 'p {
        let each = points.iter();
        let each = each.flat_map(move |&p| axes.clone().map(move |axis| (p, axis)));
        each.map(|(p, axis)| self.cut.coordinate(p, axis))
    }

    /// A point's coordinates, of unknowns that are told; along an axis that is not there it is at `zero`.
    fn place<T: Copy>(&self, p: usize, zero: T, unknown: impl Fn(usize) -> T) -> [T; 3] {
        array(|axis| match axis < self.cut.problem.dimension {
            true => unknown(self.cut.coordinate(p, axis)),
            false => zero,
        })
    }

    /// The axes along which the points of a line or an arc tell whether it vanishes.
    fn axes(&self, extent: &Extent) -> Range<usize> {
        match *extent {
            Extent::Along { axis, .. } => axis..axis + 1,
            Extent::Sweep { .. } | Extent::Apart { .. } => 0..self.cut.problem.dimension,
        }
    }

    /// The unknowns that tell whether a line or an arc vanishes, or whether two edges touch.
    fn unknowns_of_extent(&self, extent: &Extent) -> Vec<usize> {
        let places = self.places(extent.points(), self.axes(extent));
        places.chain(extent.radii().iter().copied()).collect()
    }

    fn bound_together(&self) -> Vec<BTreeSet<usize>> {
        let d = self.cut.problem.dimension;
        let blocks = |unknowns: Vec<usize>| {
            let blocks = unknowns.into_iter().map(|u| self.cut.blocks.of_unknown[u]);
            blocks.collect()
        };
        let senses = self.senses.iter();
        let senses = senses.map(|points| self.places(points, 0..d).collect());
        let segments = self.segments.iter();
        let segments = segments.map(|segment| self.unknowns_of_extent(&segment.extent));
        let vectors = self.cut.system.nonzero.iter();
        let vectors = vectors.map(|vector| vector.unknowns(d).collect());
        let rows = self
            .looked_at
            .iter()
            .map(|&k| self.unknowns_of(k).collect());
        let all = senses.chain(segments).chain(vectors).chain(rows);
        all.map(blocks).collect()
    }

    fn distance(&self, figure: &Figure) -> f64 {
        let apart = furthest(&self.points(), &self.points_of(figure));
        // Where nothing moved the enclosures are of one and the same point.
        if apart > 1e-15 * self.cut.unit {
            apart
        } else {
            0.0
        }
    }

    /// Follows the figure as its dimensions change.
    fn continued(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited {
        let clock = Instant::now();
        let problem = Setting::applied(settings, &self.cut.problem);
        let mut astray = None;
        let (edited, reached) = match lowered(&problem, |problem| {
            try_lower_all(problem, Some(&self.cut.record))
        }) {
            Err(fault) => {
                let stop = Stop::new(StopKind::Refused, fault);
                (
                    self.edited(settings, ArcRun::stopped(stop), self.account()),
                    None,
                )
            }
            Ok(lowered) => {
                let rights = lowered.tail.rights();
                let mut run = match self.unmovable(&rights) {
                    Some(what) => ArcRun::stopped(Stop::new(StopKind::Contradiction, what)),
                    None => self.follow(&rights, control),
                };
                let judged = self.judge((settings, &rights), &mut run, control);
                astray = judged.astray;
                let figure = match &run.end {
                    ArcEnd::Reached(reached) => {
                        Some((reached.clone(), lowered.record, rights, judged.verdicts))
                    }
                    _ => None,
                };
                (self.edited(settings, run, judged.account), figure)
            }
        };
        let edited = Edited {
            seconds: clock.elapsed().as_secs_f64(),
            astray,
            ..edited
        };
        if let Some((figure, record, rights, verdicts)) = reached
            && keep.is_taken(&edited)
        {
            (self.figure, self.cut.record, self.cut.problem) = (figure, record, problem);
            if let Some(plain) = &mut self.plain {
                settings.iter().for_each(|setting| setting.apply(plain));
            }
            self.verdicts = verdicts;
            self.note_what_follows(&rights);
        }
        edited
    }

    /// Ends a run where a line or arc shrinks to nothing, and where its figure is none, and tells what is proved of it.
    fn judge(
        &mut self,
        (settings, rights): (&[Setting], &[Vec<Real>]),
        run: &mut ArcRun,
        control: &mut Control,
    ) -> Judged {
        self.end_in_narrow_tubes((settings, rights), run, control);
        let verdicts = match &run.end {
            ArcEnd::Reached(reached) => self.verdicts(reached, rights, None),
            ArcEnd::Limit(fold) => {
                self.verdicts(&fold.figure, rights, Some(hull(run.t.0, run.t.1)))
            }
            _ => self.verdicts.clone(),
        };
        let stop = self.missed(&verdicts).map(|(_, stop)| stop);
        let stop = stop.or_else(|| match &run.end {
            ArcEnd::Reached(reached) => self.vanished(reached),
            _ => None,
        });
        let way = self.look_on_the_way(rights, run, control);
        let with_way = |k: usize, verdict: Verdict| match way.verdicts.get(&k) {
            Some(there) => verdict.and(*there),
            None => verdict,
        };
        // Of the figure that is reached past others that miss something its own verdict is said; where it is none itself, how the figure stands
        // from which the edit was to go, and those on the way from there.
        let account = self.account_of(|k| match way.missed.contains_key(&k) {
            _ if stop.is_some() => with_way(k, self.verdicts[k]),
            true => verdicts[k],
            false => with_way(k, verdicts[k]),
        });
        let first = way.missed.values().min_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let astray = first.map(|(t, stop)| {
            let there = hull(t.0.max(0.0), t.1.min(1.0));
            let values = settings.iter();
            Astray {
                t: *t,
                values: values
                    .map(|s| s.between(&self.cut.problem, there))
                    .collect(),
                stop: stop.clone(),
                account: self.account_of(|k| with_way(k, self.verdicts[k])),
            }
        });
        if let Some(what) = stop {
            // Up to where a figure first misses it, if that was told.
            let t = astray.as_ref().map_or(0.0, |astray| astray.t.0.max(0.0));
            (run.end, run.t) = (ArcEnd::Stopped(what), (t, t));
        }
        Judged {
            verdicts,
            account,
            astray,
        }
    }

    /// Ends a run where a line or arc shrinks to nothing.
    fn end_in_narrow_tubes(
        &mut self,
        (settings, rights): (&[Setting], &[Vec<Real>]),
        run: &mut ArcRun,
        control: &mut Control,
    ) {
        self.end_where_segments_vanish(settings, run, |parts, radius| {
            let wide = (parts.options.tube_radius, std::mem::take(&mut parts.ready));
            parts.options.tube_radius = Some(radius * parts.cut.unit);
            let again = parts.follow(rights, control);
            (parts.options.tube_radius, parts.ready) = wide;
            again
        });
    }

    /// What right-hand sides of an equation are divided by. Every product of it has the same power of the unit.
    fn scale(&self, index: usize) -> f64 {
        self.cut.unit.powi(self.cut.powers[index])
    }

    /// An edit that is reached where the figure is.
    fn standing_still(&self) -> Edited {
        let run = ArcRun {
            end: ArcEnd::Reached(self.figure.clone()),
            t: (1.0, 1.0),
            ..ArcRun::stopped(Stop::new(StopKind::Enough, ""))
        };
        self.edited(&[], run, self.account())
    }
}

impl Way for Parts {
    fn copy(&self) -> Box<dyn Way> {
        Box::new(self.clone())
    }

    fn problem(&self) -> &Problem {
        self.plain.as_deref().unwrap_or(&self.cut.problem)
    }

    fn moved(&self) -> Moved {
        self.moved
    }

    fn length(&self, index: usize) -> Interval {
        Setting::now(&self.cut.problem, index).value()
    }

    fn figure(&self) -> &Figure {
        &self.figure
    }

    fn points_of(&self, figure: &Figure) -> Vec<[Interval; 3]> {
        let unit = point(self.cut.unit);
        let place = |p| self.place(p, point(0.0), |u| figure.enclosure(u) * unit);
        (0..self.cut.problem.points.len()).map(place).collect()
    }

    fn objects_of(&self, figure: &Figure) -> Vec<Located> {
        let points = self.points_of(figure);
        let at = |u: usize| figure.enclosure(u);
        let system = &self.cut.system;
        system.locate(
            &self.cut.problem,
            &self.cut.told,
            &points,
            self.cut.unit,
            &at,
        )
    }

    fn limit(&self, fold: &Fold, orientations: &[Orientation]) -> Limit {
        let points = 0..self.cut.problem.points.len();
        let motion = points.map(|p| self.place(p, 0.0, |u| fold.velocity[u]));
        let places = self.points_of(&fold.figure);
        Limit::new(&places, orientations, motion.collect())
    }

    fn account(&self) -> Account {
        self.account_of(|k| {
            self.verdicts
                .get(k)
                .copied()
                .unwrap_or(Verdict::NotLookedAt)
        })
    }

    fn remarks(&self) -> Vec<String> {
        let contacts = self.contacts.iter().map(contacts::Kept::in_words);
        contacts.collect()
    }

    fn segments(&self) -> &[Segment] {
        &self.segments
    }

    fn outlines(&self) -> Option<&[String]> {
        self.outlines.as_deref()
    }

    fn is_same(&self, a: usize, b: usize, axis: usize) -> bool {
        self.cut.coordinate(a, axis) == self.cut.coordinate(b, axis)
    }

    fn is_zero(&self, p: usize, axis: usize) -> bool {
        self.figure.enclosure(self.cut.coordinate(p, axis)) == point(0.0)
    }

    /// Changes dimensions by a path, and where a figure that is singular itself has none, by a figure moved off that place.
    fn edit(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited {
        let edited = self.follow_to(settings, keep, control);
        match edited.ending.is_contradiction() && self.is_singular() {
            true => self.moved_off(settings, keep, control).unwrap_or(edited),
            false => edited,
        }
    }

    /// Changes dimensions by a path, and in no other way.
    fn follow_to(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited {
        let mut edited = self.continued(settings, keep, control);
        if let Some(astray) = edited.astray.as_mut().filter(|_| self.is_singular()) {
            astray.stop = self.sober(astray.stop.clone());
        }
        match &edited.ending {
            Ending::Stopped(stop) if stop.kind == StopKind::Contradiction && self.is_singular() => {
                let ending = Ending::Stopped(self.sober(stop.clone()));
                Edited { ending, ..edited }
            }
            _ => self.go_on(settings, keep, edited, control),
        }
    }

    fn drag(&mut self, drags: &[Drag], control: &mut Control) -> Edited {
        self.drag(drags, control)
    }

    fn parts(&self) -> Option<&Parts> {
        Some(self)
    }
}

/// Makes an unknown of a figure what an interval in the homotopy's unit says.
fn put(figure: &mut Figure, unknown: usize, x: Interval) {
    figure.centre[unknown] = x.mid();
    figure.low[unknown] = 0.0;
    figure.radius[unknown] = x.rad();
}

/// Whether a right-hand side changes with t.
fn moves(right: &[Real]) -> bool {
    right.iter().skip(1).any(|c| !c.is_zero())
}
