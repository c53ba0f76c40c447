//! How far each dimension can go alone.

use super::ending::{Edited, Ending, Keep, Limit};
use super::setting::measure_of;
use super::{Extreme, Session, Setting, held_though_computed};
use crate::blocks::Account;
use crate::constraint::Measure;
use crate::interval::Interval;
use crate::problem::Decimal;
use crate::remarks::{Reach, reach};
use crate::track::{Control, StopKind};
use std::slice;

/// Towards zero a dimension is followed down to this part of what it is.
const SMALLEST: f64 = 1.0 / 1024.0;

/// Where a dimension's range ends on one side.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// At a limit: no continuation beyond, proved. The value there is enclosed.
    Limit(Interval, Limit),
    /// No limit was met down (or up) to this value, as far as was tried: proved.
    Beyond(Interval),
    /// Proved up to this value; there branches seem to meet, or the proof stopped, and why.
    Unknown(Interval, String),
}

/// The values over which one dimension can move while all others stand still.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// The index, as in [`Setting`].
    pub index: usize,
    /// What the dimension is.
    pub value: Interval,
    /// How far it can shrink.
    pub low: End,
    /// How far it can grow.
    pub high: End,
    /// The figure at the low end, in the coordinates of the problem: at a limit, and where none was met up to
    /// there, a box that holds exactly one; otherwise the old figure.
    pub low_figure: Vec<[Interval; 3]>,
    /// The figure at the high end, likewise.
    pub high_figure: Vec<[Interval; 3]>,
    /// What both ends are proved of.
    pub account: Account,
    /// Where coordinates are held on the way to an end that is a limit: what the end is with nothing held, if that is proved.
    pub extremes: [Option<Extreme>; 2],
    /// The least and the greatest that no figure goes beyond, by the other distances alone.
    pub reach: [Option<Reach>; 2],
}

impl End {
    /// The value where the range ends, or up to where it is known.
    pub fn value(&self) -> Interval {
        match self {
            End::Limit(value, _) | End::Beyond(value) | End::Unknown(value, _) => *value,
        }
    }
}

impl Session {
    /// The range of one dimension. The figure stays what it is.
    ///
    /// # Panics
    /// If the problem has no such distance.
    pub fn range(&mut self, index: usize, control: &mut Control) -> Range {
        let value = self.length(index);
        let problem = self.problem();
        let reach = match index < problem.distances.len() {
            true => reach(problem, index),
            false => [None, None],
        };
        let way_round = reach[1].as_ref().map(|most| most.bound.sup());
        let (low, high) = match (measure_of(problem, index), way_round) {
            // No figure is that long: the other distances between its ends do not reach.
            (_, Some(longest)) => (SMALLEST * value.mid(), 1.0625 * longest.max(value.sup())),
            (Measure::Degrees, _) => (
                SMALLEST * value.mid(),
                180.0 - SMALLEST * (180.0 - value.mid()),
            ),
            (Measure::Slope, _) => (
                SMALLEST * value.mid(),
                90.0 - SMALLEST * (90.0 - value.mid()),
            ),
            // All the way round.
            (Measure::Turn, _) => (value.mid() - 360.0, value.mid() + 360.0),
            (Measure::Signed, _) => {
                let coordinates = problem.points.iter().flat_map(|p| &p.sketch);
                let far = coordinates.fold(value.mag(), |far, x| far.max(x.to_f64().abs()));
                (value.mid() - far / SMALLEST, value.mid() + far / SMALLEST)
            }
            _ => (SMALLEST * value.mid(), value.mid() / SMALLEST),
        };
        let ends = [low, high].map(|goal| self.end(index, goal, control));
        let [
            (low, low_figure, mut account, least),
            (high, high_figure, other, greatest),
        ] = ends;
        account.join(&other);
        account.held_though_computed = held_though_computed(self.problem(), &[index]);
        // What is left out may be missed by a little, and what is computed from the same parameters is another length then.
        let reach = match account.left_out.is_empty() && account.held_though_computed.is_empty() {
            true => reach,
            false => [None, None],
        };
        Range {
            index,
            value,
            low,
            high,
            low_figure,
            high_figure,
            account,
            extremes: [least, greatest],
            reach,
        }
    }

    /// The ranges of all dimensions.
    pub fn ranges(&mut self, control: &mut Control) -> Vec<Range> {
        let all: Vec<usize> = self.problem().dimensions().collect();
        all.into_iter()
            .map(|index| self.range(index, control))
            .collect()
    }

    /// How far a dimension can go towards a value, and the figure there.
    fn end(
        &mut self,
        index: usize,
        goal: f64,
        control: &mut Control,
    ) -> (End, Vec<[Interval; 3]>, Account, Option<Extreme>) {
        let rounded = match measure_of(self.problem(), index) {
            // So many digits that it stays below 180, or 90.
            angle @ (Measure::Degrees | Measure::Slope) => {
                let most = match angle {
                    Measure::Slope => 90.0,
                    _ => 180.0,
                };
                let digits = 3.0 - goal.min(most - goal).log10().floor();
                format!("{goal:.*}", digits.clamp(0.0, 20.0) as usize)
            }
            Measure::Turn => format!("{goal:.3}"),
            _ => format!("{goal:.3e}"),
        };
        let rounded = rounded.parse::<Decimal>();
        let Ok(goal) = rounded else {
            let reason = format!("{goal:e} is out of the range of lengths");
            let end = End::Unknown(self.length(index), reason);
            return (end, self.points(), self.account(), None);
        };
        let setting = Setting::to(index, goal);
        let Edited {
            ending,
            astray,
            dimensions,
            points,
            account,
            ..
        } = self.follow_to(slice::from_ref(&setting), Keep::Never, control);
        if let Some(astray) = astray {
            let end = End::Unknown(astray.values[0], astray.stop.text);
            return (end, self.points(), astray.account, None);
        }
        let is_contradicted =
            matches!(&ending, Ending::Stopped(stop) if stop.kind == StopKind::Contradiction);
        // What a figure misses that is none is not said of the old one, which is printed in its place.
        let account = match is_contradicted {
            true => self.account(),
            false => account,
        };
        let value = dimensions[0].value;
        let end = match ending {
            Ending::Reached => End::Beyond(value),
            Ending::Limit(limit) => End::Limit(value, limit),
            Ending::Passes(reason) => End::Unknown(
                value,
                format!("branches of figures seem to meet there ({reason})"),
            ),
            Ending::Stopped(reason) => End::Unknown(value, reason.text),
        };
        // Where something else stands still, or an equation was added, it would be that of fewer figures.
        let is_all = self.problem().kept.what.is_empty()
            && account.added.is_empty()
            && account.drawing.is_none()
            && held_though_computed(self.problem(), &[index]).is_empty();
        let extreme = match end {
            End::Limit(..) if is_all && !account.held.is_empty() => self.extreme(&setting, &points),
            _ => None,
        };
        // What was led to is a figure: those that go less far are extreme among others.
        let goes_up = setting.value().mid() > self.length(index).mid();
        let extreme = extreme.filter(|found| match goes_up {
            true => found.value.sup() >= value.inf(),
            false => found.value.inf() <= value.sup(),
        });
        (end, points, account, extreme)
    }
}
