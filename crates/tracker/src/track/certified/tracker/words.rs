//! Why a run ended, and what was switched on in it, in words.

use super::creep::Creep;
use super::crossing::Crossing;
use super::{CameTo, Halt, POINT_TOLERANCE, Test, Tracker};
use crate::track::certified::reasons::{
    Doubt, Rejection, precision, undecided, unlinked, unproved, unrefined,
};
use crate::track::ends::SINGULAR;
use crate::track::flexible;
use crate::track::full::condition;
use crate::track::{Stop, StopKind};

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    pub(super) fn place(&self) -> String {
        let t = self.now.local.z[0][self.equations.m];
        format!(
            "at t = {t:.9} after {} tubes{}",
            self.steps,
            self.condition()
        )
    }

    fn condition(&self) -> String {
        match self.condition_number() {
            Some(condition) => format!(" (condition of the Jacobian about {condition:.1e})"),
            None => String::new(),
        }
    }

    fn condition_number(&self) -> Option<f64> {
        let now = &self.now.local;
        condition(&self.equations, &now.z[0], &now.normal)
    }

    /// Whether a run that gets no farther is near a place where the Jacobian loses rank.
    fn is_singular(&self) -> bool {
        let condition = self.condition_number();
        condition.is_none_or(|condition| condition > SINGULAR)
    }

    /// Why the run ends here, a tube of about the half length `reach` being the last that was tried.
    pub(super) fn stuck(&mut self, rejection: Rejection, reach: f64, limit: f64) -> Halt {
        let is_singular = self.is_singular();
        let t = self.now.local.z[0][self.equations.m];
        let remark = self.homotopy.remark_on_lengths(t);
        let vanishes = match rejection {
            Rejection::Undecided(Doubt::Vanishes(vector)) => Some(vector),
            _ => None,
        };
        let kind = match rejection {
            _ if is_singular => StopKind::Singular,
            Rejection::Undecided(Doubt::Sign(_) | Doubt::Vanishes(_)) => StopKind::Undefined,
            Rejection::Undecided(_) => StopKind::Undecided,
            _ => StopKind::NoStep,
        };
        let words = format!(
            "{}, at the smallest step, {:.1e}{}, {}{remark}",
            self.why(rejection, false, limit),
            reach * self.homotopy.unit,
            precision(self.extension.on),
            self.place()
        );
        Halt {
            came_to: CameTo::Stuck { is_singular },
            vanishes,
            ..Stop::new(kind, words).into()
        }
    }

    /// Why the run ends where the last tubes lead nowhere.
    pub(super) fn creeps(&self, Creep { tubes, length }: Creep) -> Halt {
        let is_singular = self.is_singular();
        let kind = match is_singular {
            true => StopKind::Singular,
            false => StopKind::NoStep,
        };
        let t = self.now.local.z[0][self.equations.m];
        let words = format!(
            "the path cannot be followed farther in reasonable time: the last {tubes} tubes together are {:.1e} long{}, {}{}",
            length * self.homotopy.unit,
            precision(self.extension.on),
            self.place(),
            self.homotopy.remark_on_lengths(t)
        );
        Halt {
            came_to: CameTo::Stuck { is_singular },
            ..Stop::new(kind, words).into()
        }
    }

    /// The reason why a run ends, after the words for a figure that is not rigid at t = 1, if no step can be proved and that is
    /// what the path comes to.
    pub(super) fn with_flexibility(&self, Halt { stop, came_to, .. }: Halt) -> Stop {
        match came_to {
            CameTo::Stuck { .. } => match self.flexibility() {
                Some(words) => Stop::new(StopKind::Flexible, format!("{words}; {stop}")),
                None => stop,
            },
            _ => stop,
        }
    }

    /// The words for a figure near the last point that is not rigid at t = 1.
    pub(super) fn flexibility(&self) -> Option<String> {
        let (z, m) = (&self.now.local.z[0], self.equations.m);
        flexible::in_words(&self.homotopy, z, z[m])
    }

    /// Why it ends at the sketch.
    pub(super) fn stuck_at_sketch(&mut self, rejection: Rejection, limit: f64) -> Stop {
        let words = format!(
            "at the sketch{}, {}{}",
            precision(self.extension.on),
            self.why(rejection, true, limit),
            self.condition()
        );
        Stop::new(StopKind::Sketch, words)
    }

    /// In words, with numbers of what was tried last: `first`, the tube around the sketch.
    fn why(&mut self, rejection: Rejection, first: bool, limit: f64) -> String {
        let (equations, unit) = (&self.equations, self.homotopy.unit);
        let (tube, before) = match first {
            true => (&mut self.now, None),
            false => (&mut self.next, Some(&self.now)),
        };
        match rejection {
            Rejection::Refine(e) => unrefined(e, equations, &mut tube.local, POINT_TOLERANCE, unit),
            Rejection::Unproved => {
                unproved(self.test.shortfall(equations, tube, limit), tube, unit)
            }
            Rejection::Short(_) | Rejection::Unlinked => match before {
                None => unlinked("the sketch", &self.sketch, 0.0, tube, unit),
                Some(before) => {
                    let direction = match before.exit_is_tight {
                        true => before.exit_slope_radius,
                        false => before.proof.slope_distance,
                    };
                    unlinked("that one's end", &before.exit, direction, tube, unit)
                }
            },
            Rejection::Undecided(doubt) => undecided(doubt, self.extension.on, &self.homotopy),
        }
    }

    pub(super) fn switched_on(&self) -> Vec<String> {
        let mut list = Vec::new();
        if self.shortened > 0 {
            let times = match self.shortened {
                1 => "once".to_owned(),
                n => format!("{n} times"),
            };
            list.push(format!(
                "shorter tubes, {times}: t = 1 could not be separated from a fold or another \
                 solution in the longer ones"
            ));
        }
        if let Some([ahead, back]) = self.ways {
            list.push(format!(
                "two threads: the path was followed both ways from the sketch at once, {ahead} tubes ahead and \
                 {back} back, until these met (several threads were asked for)"
            ));
        }
        list.extend(self.extension.in_words());
        list.extend(self.crossing.iter().filter_map(Crossing::in_words));
        list
    }
}
