//! Paths that do not come back to the sketch: both ways from it to their two ends.

use super::crossing::Crossing;
use super::pace::MOST;
use super::{Test, Tracker};
use crate::constraint::Role;
use crate::interval::rounding::round_up;
use crate::interval::{hull, point};
use crate::track::ends::{
    Away, DEGENERATE, ENDLESS, EndKind, FAR, OUTSIDE, PathEnd, SETTLED, SMALL, both_ways, farthest,
    in_words, places, vanishing,
};
use crate::track::{Control, Options, Status, Stop, StopKind};

/// Why a run ended before its path was closed, or before t was 1.
#[derive(Debug)]
pub(super) struct Halt {
    pub stop: Stop,
    pub came_to: CameTo,
    /// What is seen there, in words, where the run did not end for want of a proof; its stop begins with it.
    pub what: String,
    /// The vector, by number, that could not be proved not to vanish at the smallest step, if that was what failed.
    pub vanishes: Option<usize>,
}

/// What a run had come to when it ended, as far as one can see.
#[derive(Debug, Clone, Copy)]
pub(super) enum CameTo {
    /// Nothing at which a path ends.
    Nothing,
    /// A point goes away.
    Away(Away),
    /// t or another unknown goes on without end.
    Endless,
    /// A length goes to zero.
    Vanishing,
    /// No step could be proved, however short, or steps led nowhere: perhaps near a place where the Jacobian loses rank.
    Stuck { is_singular: bool },
}

impl From<Stop> for Halt {
    fn from(stop: Stop) -> Self {
        Halt {
            stop,
            came_to: CameTo::Nothing,
            what: String::new(),
            vanishes: None,
        }
    }
}

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// The point that goes away, if one is far from the others, moves away at the last point that is proved, and t
    /// settles. Distances alone cannot let a figure grow beyond bounds while t does not.
    ///
    /// With X(s) the point along the tube, R² = |X|² is enclosed in the exit's box, and X·X' > 0 there by bounds of
    /// X' over the parameters between which the exit is: so dR/ds > 0.
    fn goes_away(&self) -> Option<Away> {
        if self.homotopy.tail.is_empty() {
            return None;
        }
        let (homotopy, tube, m) = (&self.homotopy, &self.now, self.equations.m);
        let (p, size) = farthest(homotopy, &tube.local.z[0])?;
        if size.is_nan() || size <= FAR * self.size_of_sketch {
            return None;
        }
        let exit = |i: usize| tube.exit.enclosure(i);
        let (from, to) = tube.exit_between;
        let slope = |i: usize| {
            let (_, (low, high)) = tube.entry_along(i).bounds(from, to);
            hull(low, high)
        };
        let (mut square, mut outward) = (point(0.0), point(0.0));
        let axes = 0..homotopy.dimension;
        for i in axes.filter_map(|axis| homotopy.coordinate(p, axis)) {
            square += exit(i).sqr();
            outward += exit(i) * slope(i);
        }
        // Bounds that are not numbers prove nothing.
        if outward.inf().is_nan() || outward.inf() <= 0.0 {
            return None;
        }
        // As far as floats tell: what is claimed is where the end is, and that the point moves away there.
        let (_, (low, high)) = tube.time().bounds(from, to);
        let change = (0.5 * (low + high)).abs() * square.mid() / outward.mid();
        let from_one = (tube.exit.centre[m] - 1.0).abs();
        let distance = square.sqrt() * point(homotopy.unit);
        (change < SETTLED && from_one > 10.0 * change).then_some(Away {
            point: p,
            distance: (distance.inf(), distance.sup()),
        })
    }

    /// What has gone too far to be followed, in words, if t or another unknown is far from 0 and moves away at the last point that is
    /// proved. So t goes on where nothing depends on it, as from a sketch that meets all constraints, or all that does is in
    /// proportion to it; it may also come back from there.
    fn runs_on(&self) -> Option<String> {
        match self.arc {
            Some(_) => None,
            None => self.has_passed(ENDLESS),
        }
    }

    /// What goes to infinity as far as one can see, in words: t or another unknown that is far from 0 beside all numbers of the
    /// sketch and moves away at the last point that is proved, where tubes have not become longer with the distance for long.
    /// There the equations' terms differ so much in size that the way to where they would be followed no more
    /// ([`ENDLESS`]) takes millions of tubes. Called once for every tube.
    pub(super) fn gets_nowhere(&mut self) -> Option<String> {
        if self.homotopy.tail.is_empty() || self.arc.is_some() {
            return None;
        }
        if !self.pace.is_slow(self.figure_size()) {
            return None;
        }
        let sketch = self.sketch.centre.iter();
        let outside = OUTSIDE * sketch.fold(1.0, |max: f64, x| max.max(x.abs()));
        let what = self.has_passed(outside)?;
        Some(format!(
            "{what} and moves away from 0, as far as one can see to infinity: it takes more than {MOST} tubes to get twice as far, \
             and the path is not followed farther"
        ))
    }

    /// What is farther from 0 than this, in words, and moves away at the last point that is proved.
    fn has_passed(&self, far: f64) -> Option<String> {
        let (tube, m) = (&self.now, self.equations.m);
        let (from, to) = tube.exit_between;
        let moves_away = |i: usize| {
            let (at, room) = (
                tube.exit.centre[i],
                tube.exit.radius[i] + tube.exit.low[i].abs(),
            );
            let (_, (low, high)) = match i == m {
                true => tube.time().bounds(from, to),
                false => tube.entry_along(i).bounds(from, to),
            };
            let is_far = at.abs() > far && room < 0.5 * far;
            is_far && if at > 0.0 { low > 0.0 } else { high < 0.0 }
        };
        if moves_away(m) {
            let passed = far.copysign(tube.exit.centre[m]);
            return Some(format!("t has passed {passed:.1e}"));
        }
        (0..m)
            .any(moves_away)
            .then(|| format!("an unknown has passed {far:.1e} units of length"))
    }

    /// A length or radius that goes to zero, in words, if one is small beside what it was in the sketch, proved to shrink
    /// at the last point, and if tubes have become so short that it would take a hundred to get to zero: near there the
    /// Jacobian loses rank, and tubes shrink like the square of the length.
    fn loses_leg(&self) -> Option<String> {
        if self.homotopy.tail.is_empty() || self.arc.is_some() {
            return None;
        }
        let (homotopy, tube, m) = (&self.homotopy, &self.now, self.equations.m);
        let (z, first) = (&tube.local.z[0], homotopy.gauge.place.len());
        let (from, to) = tube.exit_between;
        // One that is given is a(t), of which floats tell enough: that a(t) > 0 up to there is proved at the end.
        let t = tube.exit.centre[m];
        let (_, (slow, fast)) = tube.time().bounds(from, to);
        for (length, name) in homotopy.lengths.iter().zip(&homotopy.names) {
            let now = length.value(t);
            if now > SMALL * length.value(0.0).max(length.value(1.0)) {
                continue;
            }
            let ahead = 1e-3 * now.abs() * (0.5 * (slow + fast)).signum();
            let change = (length.value(t + ahead) - now) / ahead.abs();
            let is_far = tube.proof.h * (0.5 * (slow + fast)).abs() * change.abs() < 1e-3 * now;
            if change < 0.0 && is_far && (t - 1.0).abs() > -10.0 * now / change {
                let now = now * homotopy.unit;
                return Some(format!(
                    "the length of {name} goes to zero there ({now:.1e})"
                ));
            }
        }
        let unknowns = homotopy.tail.unknowns.iter().enumerate();
        let lengths = unknowns.filter(|(_, unknown)| unknown.role == Role::Positive);
        lengths.into_iter().find_map(|(k, unknown)| {
            let i = first + k;
            if z[i] > SMALL * self.sketch.centre[i] {
                return None;
            }
            let (_, (low, high)) = tube.entry_along(i).bounds(from, to);
            let most = round_up(
                tube.exit.centre[i] + tube.exit.low[i] + tube.exit.radius[i],
                3,
            );
            let is_shrinking = high < 0.0;
            let is_far = tube.proof.h * low.abs() < 1e-2 * most;
            let (_, (slow, fast)) = tube.time().bounds(from, to);
            let change = (0.5 * (slow + fast)).abs() * most / high.abs();
            let from_one = (tube.exit.centre[m] - 1.0).abs();
            (is_shrinking && is_far && from_one > 10.0 * change).then(|| {
                let most = most * homotopy.unit.powi(unknown.power);
                format!("{} is at most {most:.1e} and shrinks", unknown.name)
            })
        })
    }

    /// The end of the path that the last tube comes to, as far as one can see.
    pub(super) fn sees_end(&self) -> Option<Halt> {
        if let Some(away) = self.goes_away() {
            let what = match self.arc {
                Some(_) => "the figure seems to grow without end: ",
                None => "",
            };
            let words = format!("{what}{}", in_words(&self.homotopy, away));
            return Some(self.halt(StopKind::Infinite, words, CameTo::Away(away)));
        }
        if let Some(what) = self.runs_on() {
            let words = format!("{what} and moves away from 0; the path is not followed farther");
            return Some(self.halt(StopKind::Infinite, words, CameTo::Endless));
        }
        let what = self.loses_leg()?;
        Some(self.halt(StopKind::Undefined, what, CameTo::Vanishing))
    }

    /// A run that ends at the last tube.
    pub(super) fn halt(&self, kind: StopKind, what: String, came_to: CameTo) -> Halt {
        let stop = Stop::new(kind, format!("{what}, {}", self.place()));
        Halt {
            came_to,
            what,
            ..stop.into()
        }
    }

    /// The end of the path, if that is where the run ended; otherwise why it ended again.
    pub(super) fn path_end(&self, halt: Halt) -> Result<PathEnd, Halt> {
        if !self.has_set_out {
            return Err(halt);
        }
        let end = match halt.came_to {
            _ if self.homotopy.tail.is_empty() => None,
            CameTo::Nothing => None,
            CameTo::Away(_) | CameTo::Endless => Some((EndKind::Infinite, halt.what.clone())),
            CameTo::Vanishing => Some((EndKind::Undefined, halt.what.clone())),
            CameTo::Stuck { is_singular } => self.stuck_at(is_singular),
        };
        let stop = halt.stop.kind;
        let goes_on = self.goes_both_ways && stop != StopKind::Interrupted;
        let (kind, stop, what) = match end {
            Some((kind, what)) => (kind, None, what),
            None if goes_on => (EndKind::Stopped, Some(stop), String::new()),
            None => return Err(halt),
        };
        let reason = match halt.stop.starts_with(&what) {
            true => halt.stop.text.clone(),
            false => format!("{what}: {}", halt.stop),
        };
        let away = match halt.came_to {
            CameTo::Away(away) => Some(away),
            _ => None,
        };
        Ok(PathEnd {
            t: self.reached(),
            kind,
            stop,
            what,
            reason,
            away,
            points: places(&self.homotopy, &self.now.local.z[0]),
        })
    }

    /// The end of the path near which no step can be proved, if there is one, and what is said of it before the reason.
    fn stuck_at(&self, is_singular: bool) -> Option<(EndKind, String)> {
        let (homotopy, z) = (&self.homotopy, &self.now.local.z[0]);
        let leg = homotopy.remark_on_lengths(self.reached().0);
        let flat = self.crossing.as_ref().and_then(Crossing::failure);
        let small = vanishing(homotopy, z, &self.sketch.centre, self.size_of_sketch);
        if let Some(name) = small {
            Some((EndKind::Undefined, format!("{name} goes to zero")))
        } else if !leg.is_empty() {
            let what = leg.trim_start_matches("; ");
            Some((EndKind::Undefined, what.to_owned()))
        } else if let Some(why) = flat {
            let what =
                "a degenerate (flat) figure at t = 1, beyond which the path could not be followed";
            Some((EndKind::Degenerate, format!("{what} ({why})")))
        } else if is_singular {
            let flexible = self.flexibility().map(|words| format!("{words}; "));
            let flexible = flexible.unwrap_or_default();
            Some((EndKind::Degenerate, format!("{flexible}{DEGENERATE}")))
        } else {
            None
        }
    }

    /// Goes the other way from the sketch, this run having come to an end of the path. Afterwards the account
    /// is that of both ways.
    pub(super) fn other_way(
        &mut self,
        end: PathEnd,
        options: &Options,
        control: &mut Control,
    ) -> Status {
        let options = Options {
            reverse: !options.reverse,
            ..options.clone()
        };
        let mut back = Tracker::<N, T>::new(self.homotopy.clone(), &options);
        back.crossing = Crossing::new(&self.homotopy);
        back.stands_where(self);
        if let Some(witness) = &mut control.witness {
            witness.turn();
        }
        if let Some(trace) = &mut control.trace {
            trace.turn_back();
        }
        let result = back.run(&options, control);
        if let Some(witness) = &mut control.witness {
            witness.end_turn(result.is_err());
        }
        let other = match result {
            // The loop is closed after all: the way that closed it is the proof.
            Ok(()) if control.witness.is_some() => {
                let what =
                    "the path closes if it is followed the other way (`--reverse`): this way, ";
                let words = format!("{what}{}", end.reason);
                return Status::Stopped(Stop::new(StopKind::OtherWay, words));
            }
            Ok(()) => {
                if let Some(trace) = &mut control.trace {
                    trace.keep_other_way();
                }
                std::mem::swap(&mut self.ledger, &mut back.ledger);
                std::mem::swap(&mut self.steps, &mut back.steps);
                std::mem::swap(&mut self.crossing, &mut back.crossing);
                return Status::Closed;
            }
            Err(halt) => back.path_end(halt).map_err(|halt| halt.stop),
        };
        self.steps += back.steps;
        self.rejected += back.rejected;
        self.shortened += back.shortened;
        self.behind = back.ledger.found().len();
        if let (Some(all), Some(back)) = (&mut self.crossing, &back.crossing) {
            all.add(back);
        }
        if let Err(reason) = self.ledger.go_on_from(back.ledger) {
            return Status::Stopped(Stop::new(StopKind::Undecided, reason));
        }
        both_ways(end, other)
    }
}
