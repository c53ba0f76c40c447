//! What comes of an edit.

use super::drag::Dragged;
use crate::blocks::{Account, Singular};
use crate::interval::Interval;
use crate::system::Located;
use crate::track::arc::Orientation;
use crate::track::{Stop, StopKind};

crate::named! {
    /// How an edit ended.
    #[derive(Debug, Clone, PartialEq)]
    pub enum Ending {
        /// All new dimensions are met, by the one and only continuation of the old figure: between the two there
        /// is exactly one figure for every t, and none of them is singular.
        Reached = "reached",
        /// The path turns back before: there is no continuation beyond.
        Limit(Limit) = "limit",
        /// Near a figure where branches seem to meet: seen in floats, not proved. What the proof met there.
        Passes(Stop) = "passes",
        /// The proof ended before, and why.
        Stopped(Stop) = "stopped",
    }
}

/// The figure at which a path turns back.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Triples of joined points that are on one line there (in the plane), quadruples that are in one plane (in
    /// space), as far as the boxes of the points tell: the sine of the angle between them, or what stands for it,
    /// is at most [`Limit::flat_within`].
    pub flat: Vec<Vec<usize>>,
    /// See `flat`; proved.
    pub flat_within: f64,
    /// How the figure can move there for an instant while all dimensions stand still: per point, in the
    /// coordinates of the problem, the largest of length 1. In floats.
    pub motion: Vec<[f64; 3]>,
}

/// One dimension in an edit.
#[derive(Debug, Clone, PartialEq)]
pub struct Dimension {
    /// The index, as in [`Setting`](super::Setting).
    pub index: usize,
    /// What it was, in the unit of the problem or in degrees.
    pub from: Interval,
    /// What it was to be.
    pub to: Interval,
    /// What it is where the edit ended.
    pub value: Interval,
}

/// An orientation that was not proved to be kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Lost {
    /// The points, three in the plane and four in space.
    pub points: Vec<usize>,
    /// The first t at which its sign may be another: bounds.
    pub t: (f64, f64),
}

/// Signs of triangles (in the plane) or tetrahedra (in space) of a point and others joined to it.
///
/// A sign is that of the determinant of the differences of the others from the first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Orientations {
    /// Proved to be the same all the way from the old figure to where the edit ended, with their signs.
    pub kept: Vec<(Vec<usize>, i8)>,
    /// Those with a sign in the old figure that is not proved to be kept.
    pub lost: Vec<Lost>,
    /// Those without a sign in the old figure: points on one line, or in one plane, or too near to tell.
    pub flat: Vec<Vec<usize>>,
}

/// An edit and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Edited {
    /// How it ended.
    pub ending: Ending,
    /// Up to where it was proved: bounds on t, 1 if it was reached, that of the fold at a limit.
    pub t: (f64, f64),
    /// The dimensions that were edited.
    pub dimensions: Vec<Dimension>,
    /// The figure in the coordinates of the problem: a box that holds exactly one figure with the dimensions of
    /// `t`, where it was reached and at a limit; shortly before, where there is a [`Edited::there`]; otherwise the old figure.
    pub points: Vec<[Interval; 3]>,
    /// Where it ended at an edge that vanishes, or at two that come to touch: the values, shortly before, of the dimensions that were edited,
    /// with which `points` are the one and only continuation.
    pub there: Option<Vec<Interval>>,
    /// Where the problem's objects are in that figure.
    pub objects: Vec<Located>,
    /// What is proved of the orientations.
    pub orientations: Orientations,
    /// Tubes that the proof took.
    pub tubes: usize,
    /// Tubes that were tried in vain.
    pub rejected: usize,
    /// The path's length, Euclidean in the free coordinates (units of the problem) and t, in floats.
    pub length: f64,
    /// What was switched on beyond the plain run, and why.
    pub switched_on: Vec<String>,
    /// What it is proved of: how many equations, what was left out and how the figures stand to that, what is held.
    pub account: Account,
    /// Where the old figure was singular itself, so that no continuation is the one: what was so about it, and how far it was moved
    /// off that place before it was led to the new dimensions.
    pub singular: Option<Singular>,
    /// Where on the way figures first miss a constraint that was left out, proved, if any do: the figure where the edit ended may meet it.
    pub astray: Option<Astray>,
    /// Of points that were dragged: where they are.
    pub dragged: Option<Dragged>,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// Whether a figure that is reached is taken for the session's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// No.
    Never,
    /// Yes.
    Always,
    /// If no figure on the way there is known to miss a constraint.
    OnTheWay,
}

impl Keep {
    /// Whether it is, after such an edit.
    pub fn is_taken(self, edited: &Edited) -> bool {
        edited.ending == Ending::Reached
            && match self {
                Keep::Never => false,
                Keep::Always => true,
                Keep::OnTheWay => edited.astray.is_none(),
            }
    }
}

/// The first place on the way where figures miss a constraint that was left out, and so are none of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Astray {
    /// Bounds on t there.
    pub t: (f64, f64),
    /// The values there of the dimensions that are edited, in their order.
    pub values: Vec<Interval>,
    /// Which constraint is missed, and by how much.
    pub stop: Stop,
    /// What the way up to there is proved of.
    pub account: Account,
}

impl Astray {
    /// As a remark on an edit whose figure meets all constraints, past this place.
    pub fn in_words(&self) -> String {
        format!(
            "other figures on the way: at t = {:.6}, {}",
            self.t.1, self.stop
        )
    }
}

impl Ending {
    /// Whether it is where an edge vanishes, or two come to touch.
    pub fn is_at_an_edge(&self) -> bool {
        matches!(self, Ending::Stopped(stop) if matches!(stop.kind, StopKind::Vanishes | StopKind::Touches))
    }

    /// Whether the proof ended at a constraint that contradicts others.
    pub(super) fn is_contradiction(&self) -> bool {
        matches!(self, Ending::Stopped(stop) if stop.kind == StopKind::Contradiction)
    }
}

impl Orientations {
    /// The same of a way in two parts, of which these are the second's and `before` the first's. A sign is kept that is proved to be so
    /// in both; what was followed in one of them only may have lost it in the other, at any t.
    pub(super) fn follow_on(&mut self, before: &Orientations) {
        let then = std::mem::take(self);
        self.flat = before.flat.clone();
        let (kept, gone): (Vec<_>, Vec<_>) = before
            .kept
            .iter()
            .cloned()
            .partition(|one| then.kept.contains(one));
        self.kept = kept;
        let is_told = |points: &Vec<usize>| {
            self.flat.contains(points) || before.lost.iter().any(|lost| lost.points == *points)
        };
        let later = then.lost.into_iter().filter(|lost| !is_told(&lost.points));
        self.lost = later.collect();
        let once = gone.into_iter().chain(then.kept).map(|(points, _)| points);
        let once = before
            .lost
            .iter()
            .map(|lost| lost.points.clone())
            .chain(once);
        for points in once.chain(then.flat) {
            let told = self.kept.iter().map(|(own, _)| own).chain(&self.flat);
            let mut told = told.chain(self.lost.iter().map(|lost| &lost.points));
            if !told.any(|own| *own == points) {
                let t = (0.0, 1.0);
                self.lost.push(Lost { points, t });
            }
        }
    }

    pub(super) fn new(all: Vec<Orientation>) -> Self {
        let mut out = Orientations::default();
        for Orientation { points, sign, lost } in all {
            match (sign, lost) {
                (0, _) => out.flat.push(points),
                (_, Some(t)) => out.lost.push(Lost { points, t }),
                (sign, None) => out.kept.push((points, sign)),
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_is_kept_that_is_kept_in_both_parts_of_a_way() {
        let lost = |points: usize, t| Lost {
            points: vec![points],
            t,
        };
        let before = Orientations {
            kept: vec![(vec![1], 1), (vec![2], -1), (vec![3], 1)],
            lost: vec![lost(4, (0.1, 0.2))],
            flat: vec![vec![5]],
        };
        let mut both = Orientations {
            kept: vec![(vec![1], 1), (vec![4], 1), (vec![5], 1), (vec![6], 1)],
            lost: vec![lost(2, (0.7, 0.8))],
            flat: Vec::new(),
        };
        both.follow_on(&before);
        assert_eq!(both.kept, [(vec![1], 1)]);
        assert_eq!(both.flat, [vec![5]]);
        // 4 was lost before, 3 and 6 were followed in one part only.
        let anywhere = (0.0, 1.0);
        let all = [
            lost(2, (0.7, 0.8)),
            lost(4, anywhere),
            lost(3, anywhere),
            lost(6, anywhere),
        ];
        assert_eq!(both.lost, all);
    }
}
