//! What a figure followed as a whole and one followed part by part can both do.

use super::drag::Drag;
use super::ending::{Edited, Ending, Keep, Limit, Orientations};
use super::open::Moved;
use super::parts::Parts;
use super::segments::{Reversed, apart_in_words, first_lost, in_narrower_tubes, stop};
use super::setting::Setting;
use crate::blocks::Account;
use crate::interval::{Interval, hull};
use crate::problem::Problem;
use crate::system::{Located, Segment};
use crate::track::arc::{ArcEnd, ArcRun, Figure, Fold, Orientation};
use crate::track::{Control, Stop};

/// A figure that meets its dimensions, and the way in which it is followed.
pub(super) trait Way: std::fmt::Debug + Send {
    /// The same once more.
    fn copy(&self) -> Box<dyn Way>;

    /// See [`super::Session::problem`].
    fn problem(&self) -> &Problem;

    /// How far the sketch was from the first figure.
    fn moved(&self) -> Moved;

    /// What a dimension is now: an enclosure.
    fn length(&self, index: usize) -> Interval;

    /// The figure as it is now.
    fn figure(&self) -> &Figure;

    /// The figure as it is now, in the coordinates of the problem.
    fn points(&self) -> Vec<[Interval; 3]> {
        self.points_of(self.figure())
    }

    /// A figure in the coordinates of the problem.
    fn points_of(&self, figure: &Figure) -> Vec<[Interval; 3]>;

    /// Where the objects are in a figure.
    fn objects_of(&self, figure: &Figure) -> Vec<Located>;

    /// What is special about a fold's figure.
    fn limit(&self, fold: &Fold, orientations: &[Orientation]) -> Limit;

    /// What is proved of the figure as it is now.
    fn account(&self) -> Account;

    /// What is said of every edit.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    /// The lines along an axis and the arcs, which must not vanish.
    fn segments(&self) -> &[Segment];

    /// The names of edges of closed outlines that are not kept apart, where the others are.
    fn outlines(&self) -> Option<&[String]>;

    /// Whether two points are known to have the same coordinate along an axis.
    fn is_same(&self, a: usize, b: usize, axis: usize) -> bool;

    /// Whether a point's coordinate along an axis is known to be 0 and to stay so.
    fn is_zero(&self, point: usize, axis: usize) -> bool;

    /// See [`super::Session::edit_with`].
    fn edit(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited;

    /// See [`super::Session::follow_to`].
    fn follow_to(&mut self, settings: &[Setting], keep: Keep, control: &mut Control) -> Edited {
        self.edit(settings, keep, control)
    }

    /// See [`super::Session::drag`].
    fn drag(&mut self, _: &[Drag], _: &mut Control) -> Edited {
        panic!("points cannot be dragged in a figure that has no place")
    }

    /// The sketch that is followed part by part, if it is.
    fn parts(&self) -> Option<&Parts> {
        None
    }

    /// What came of an edit that was followed so.
    fn edited(&self, settings: &[Setting], run: ArcRun, account: Account) -> Edited {
        let others = self.outlines().unwrap_or_default();
        let apart = apart_in_words(self.problem(), &run, others);
        let remarks = self.remarks().into_iter().chain(apart);
        let t = hull(run.t.0, run.t.1);
        let t = (!matches!(run.end, ArcEnd::Reached(_))).then_some(t);
        let dimensions = settings
            .iter()
            .map(|s| s.at(self.problem(), self.length(s.index), t));
        let (ending, there) = match run.end {
            ArcEnd::Reached(figure) => (Ending::Reached, Some(figure)),
            ArcEnd::Limit(fold) => {
                let limit = self.limit(&fold, &run.orientations);
                (Ending::Limit(limit), Some(fold.figure))
            }
            ArcEnd::Passes(reason) => (Ending::Passes(reason), None),
            ArcEnd::Stopped(reason) => (Ending::Stopped(reason), None),
        };
        let figure = there.as_ref().unwrap_or(self.figure());
        Edited {
            ending,
            t: run.t,
            dimensions: dimensions.collect(),
            points: self.points_of(figure),
            there: None,
            objects: self.objects_of(figure),
            orientations: Orientations::new(run.orientations),
            tubes: run.steps,
            rejected: run.rejected,
            length: run.length,
            switched_on: remarks.chain(run.switched_on).collect(),
            account,
            singular: None,
            astray: None,
            dragged: None,
            seconds: 0.0,
        }
    }

    /// Ends a run where a line or arc shrinks to nothing. `again`: follows it in tubes of at most such a radius, as a part of the unit of
    /// length.
    fn end_where_segments_vanish(
        &mut self,
        settings: &[Setting],
        run: &mut ArcRun,
        again: impl FnMut(&mut Self, f64) -> ArcRun,
    ) where
        Self: Sized,
    {
        let is_lost = |way: &Self, run: &ArcRun| way.lost_segment(settings, run).is_some();
        in_narrower_tubes(self, run, is_lost, again);
        if let Some((stop, t)) = self.lost_segment(settings, run) {
            (run.end, run.t) = (ArcEnd::Stopped(stop), t);
        }
    }

    /// Why a run ends at a line or arc that shrinks to nothing, and where, if it does.
    fn lost_segment(&self, settings: &[Setting], run: &ArcRun) -> Option<(Stop, (f64, f64))> {
        let problem = self.problem();
        let reversed = settings.iter().filter_map(|s| {
            let constraint = s.index.checked_sub(problem.distances.len())?;
            Reversed::new(problem, constraint, self.length(s.index), s.value())
        });
        let reversed: Vec<Reversed> = reversed.collect();
        let is_same = |a: usize, b: usize, axis: usize| self.is_same(a, b, axis);
        let is_zero = |p: usize, axis: usize| self.is_zero(p, axis);
        let is_asked = |object: usize| {
            let mut segments = self.segments().iter();
            let segment = segments.find(|s| s.object == object && s.other.is_none());
            segment.is_some_and(|s| reversed.iter().any(|r| r.is_of(s, is_same, is_zero)))
        };
        let (kept, t) = first_lost(&run.segments, run.t, is_asked)?;
        Some((stop(problem, kept), t))
    }
}
