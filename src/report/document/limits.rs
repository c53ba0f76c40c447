//! What `krawl limits` writes.

use super::{Bounds, Document, Drawing, Named, Points, Verb, all, bounds, names, points};
use crate::blocks::Account;
use crate::edit::{End, Extreme, Moved, Range};
use crate::interval::Interval;
use crate::problem::Problem;
use crate::report::limit_in_words;

keys! {
    /// How far each dimension can go alone.
    Limits(problem: &Problem, ranges: &[Range], moved: Moved) {
        /// How far the sketch was led before.
        moved: f64 = moved.distance,
        /// The dimensions by name.
        ranges: Named<RangeOf> = Named(all(ranges, |range| {
            (problem.dimension_name(range.index), RangeOf::new(problem, range))
        })),
    }
}

keys! {
    /// How far a dimension can go.
    RangeOf(problem: &Problem, range: &Range) {
        /// Its number.
        constraint: usize = range.index,
        /// What it is.
        value: Bounds = bounds(&range.value),
        /// Of what the ends are proved.
        account: Account = range.account.clone(),
        /// Where it shrinks to.
        low: RangeEnd = RangeEnd::of(problem, (&range.low, &range.extremes[0]), &range.low_figure),
        /// Where it grows to.
        high: RangeEnd = RangeEnd::of(problem, (&range.high, &range.extremes[1]), &range.high_figure),
    } or nothing {
        /// No figure has less, by the other distances alone.
        least: Option<f64> = range.reach[0].as_ref().map(|least| least.bound.inf()),
        /// No figure has more, by the other distances alone.
        most: Option<f64> = range.reach[1].as_ref().map(|most| most.bound.sup()),
    }
}

keys! {
    /// An end of a range.
    RangeEnd(status: &str, value: &Interval) {
        /// `limit`, `reached` where none was met, or `stopped`.
        status: String = status.into(),
        /// The dimension there.
        value: Bounds = bounds(value),
    } or nothing {
        /// Points on one line or in one plane at a limit.
        flat: Option<Vec<Vec<String>>> = None,
        /// What is special about a limit.
        words: Option<String> = None,
        /// The figure at a limit.
        points: Option<Points<Bounds>> = None,
        /// Why nothing could be proved beyond.
        reason: Option<String> = None,
        /// The end with nothing held.
        extreme: Option<ExtremeOf> = None,
    }
}

keys! {
    /// A figure at which a dimension is the least, or the greatest, of all figures near it.
    ExtremeOf(problem: &Problem, extreme: &Extreme) {
        /// The dimension there.
        value: Bounds = bounds(&extreme.value),
        /// How far a point is at most from where it is at the end of the way that was followed.
        apart: f64 = extreme.apart,
        /// The figure.
        points: Points<Bounds> = points(problem, &extreme.points),
    }
}

impl RangeEnd {
    fn of(
        problem: &Problem,
        (end, extreme): (&End, &Option<Extreme>),
        figure: &[[Interval; 3]],
    ) -> Self {
        match end {
            End::Limit(value, limit) => RangeEnd {
                flat: Some(all(&limit.flat, |set| names(problem, set))),
                words: Some(limit_in_words(problem, limit)),
                points: Some(points(problem, figure)),
                extreme: extreme.as_ref().map(|found| ExtremeOf::new(problem, found)),
                ..Self::new("limit", value)
            },
            End::Beyond(value) => Self::new("reached", value),
            End::Unknown(value, reason) => RangeEnd {
                reason: Some(reason.to_string()),
                ..Self::new("stopped", value)
            },
        }
    }
}

impl Document {
    /// The ranges of dimensions.
    pub fn limits(problem: &Problem, ranges: &[Range], moved: Moved) -> Document {
        let own = Verb::Limits(Limits::new(problem, ranges, moved));
        Document::of(Drawing::new("limits", problem), own)
    }
}
