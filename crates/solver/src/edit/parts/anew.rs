//! Other equations, and other coordinates held, where those that were chosen at the first figure are singular and all together are
//! not.
//!
//! A sketch that is loose or has more constraints than unknowns is followed in as many equations as unknowns, chosen where
//! it starts. Where these end the figure need not: with other coordinates held, or other constraints left out, it goes on.
//! So the way is followed to shortly before that place, equations and what is held are chosen anew there, and the rest
//! of the way is followed in these. Every leg is proved as all edits are. What is newly held stays where the box of the figure
//! says it is, whichever of its numbers that may be; and a constraint that was left out and is used now is led from what the figure
//! misses it by to its number.

use super::left_out::at_rest_all;
use super::{Followers, MOST_TUBES, Parts};
use crate::blocks::{Choice, FINE, LAST, Whose, blocks_of, is_exact, rounded_up, square};
use crate::constraint::try_lower_all;
use crate::edit::ending::{Edited, Ending, Keep};
use crate::edit::setting::Setting;
use crate::edit::way::Way as _;
use crate::interval::{Real, point};
use crate::track::arc::ArcEnd;
use crate::track::{Control, StopKind};

/// So often equations are chosen anew on one way.
const MOST_LEGS: usize = 12;
/// Before a place where the equations are singular they are chosen anew after one of these parts of the way there: the first that is
/// reached, and where others are chosen.
const BEFORE: [f64; 5] = [0.98, 0.999, 0.99999, 0.9, 0.6];
/// A leg that goes less than this part of the way so far beyond the last one's end is the last.
const LEAST_GAIN: f64 = 1e-5;

impl Parts {
    /// Where an edit ended before its dimensions were met, and coordinates are held or constraints left out: the same edit with others held
    /// or left out from shortly before on. What came of `first` otherwise.
    pub(super) fn go_on(
        &mut self,
        settings: &[Setting],
        keep: Keep,
        first: Edited,
        control: &mut Control,
    ) -> Edited {
        if self.cut.free.is_empty() && self.cut.redundant.is_empty()
            || !can_go_on(&first.ending)
            || first.astray.is_some()
        {
            return first;
        }
        let mut ahead = self.clone();
        // How far on the whole way it is, and what came of the legs so far.
        let (mut done, mut legs): (f64, Vec<Edited>) = (0.0, Vec::new());
        let mut last = first.clone();
        let mut best: Option<Edited> = None;
        for _ in 0..MOST_LEGS {
            let spent: usize = legs.iter().map(|leg| leg.tubes).sum();
            if control.is_interrupted() || spent > MOST_TUBES {
                break;
            }
            let next = match last.t.0 > 0.0 {
                true => BEFORE.iter().find_map(|part| {
                    let t = part * last.t.0;
                    let between = settings.iter().map(|s| s.before(&ahead.cut.problem, t));
                    let between: Vec<Setting> = between.collect::<Option<_>>()?;
                    let mut there = ahead.clone();
                    let leg = there.continued(&between, Keep::Always, control);
                    let is_reached = leg.ending == Ending::Reached;
                    let moved = is_reached.then(|| there.choose_anew(settings, control))??;
                    Some((there, t, Some(leg), moved))
                }),
                false => {
                    let mut there = ahead.clone();
                    let moved = there.choose_anew(settings, control);
                    moved.map(|moved| (there, 0.0, None, moved))
                }
            };
            let Some((there, t, leg, moved)) = next else {
                break;
            };
            ahead = there;
            let leg = leg.map(|mut leg| {
                if let Some(astray) = &mut leg.astray {
                    astray.t = along((done, done + t * (1.0 - done)), astray.t);
                }
                leg
            });
            done += t * (1.0 - done);
            legs.extend(leg);
            last = ahead.continued(settings, Keep::Always, control);
            let reached = (done + last.t.0 * (1.0 - done)).min(1.0);
            let so_far = best.as_ref().unwrap_or(&first);
            let leg = legs.last_mut().unwrap_or(&mut last);
            leg.switched_on.push(in_words(done, moved));
            let is_reached = last.ending == Ending::Reached;
            let is_limit = |ending: &Ending| matches!(ending, Ending::Limit(_));
            let is_more = is_limit(&last.ending) && !is_limit(&so_far.ending)
                || reached > so_far.t.0 * (1.0 + LEAST_GAIN);
            if !is_reached && !is_more {
                break;
            }
            best = Some(self.joined(&first, &legs, (&last, done)));
            if is_reached || !can_go_on(&last.ending) {
                break;
            }
        }
        let Some(best) = best else { return first };
        if keep.is_taken(&best) {
            *self = ahead;
        }
        best
    }

    /// Chooses equations and what is held anew where the figure is now. How far the figure moved to meet constraints that were left out
    /// and are used now; `None`: nothing else can be chosen, or the figure could not be led to it.
    fn choose_anew(&mut self, settings: &[Setting], control: &mut Control) -> Option<f64> {
        let lowered = try_lower_all(&self.cut.problem, Some(&self.cut.record)).ok()?;
        let rights = at_rest_all(&lowered.tail.rights());
        let is_driven = |owner: Whose| {
            let index = owner.index(&self.cut.problem);
            settings.iter().any(|setting| Some(setting.index) == index)
        };
        let first = |row: usize| match self.cut.owner(row) {
            // Where a path turns back the others are independent by themselves.
            owner if is_driven(owner) => LAST,
            owner => owner.keep(&self.cut.problem),
        };
        let later = self.cut.system.later();
        let at = &self.figure.centre;
        let choice = Choice::new(&self.cut.system, at, later, first, FINE);
        let new: Vec<usize> = {
            let is_new = |row: &&usize| self.cut.redundant.contains(row);
            choice.used.iter().filter(is_new).copied().collect()
        };
        let is_other = !new.is_empty() || choice.free != self.cut.free;
        if !is_other || choice.free.len() > self.cut.free.len() {
            return None;
        }
        // From what the figure misses of constraints that are used now to none of it.
        let mut led = rights.clone();
        for &row in &new {
            let place = self.cut.redundant.iter().position(|&other| other == row)?;
            if !self.is_proved(place, &rights) {
                let index = self.cut.system.rows[row].index;
                let miss = Real::within(
                    self.sides(row, &self.figure, &rights, None).0 * point(self.scale(index)),
                );
                led[index] = vec![&led[index][0] + &miss, -&miss];
            }
        }
        self.take(choice, &rights)?;
        let mut moved = 0.0;
        if led.iter().any(|right| right.len() > 1) {
            let ArcEnd::Reached(figure) = self.follow(&led, control).end else {
                return None;
            };
            moved = self.distance(&figure);
            self.figure = figure;
        }
        self.verdicts = self.verdicts(&self.figure, &rights, None);
        self.missed(&self.verdicts).is_none().then_some(moved)
    }

    /// Goes on in other equations, or with other coordinates held, where the figure is now. `None`: they are no square system.
    pub(super) fn take(&mut self, choice: Choice, rights: &[Vec<Real>]) -> Option<()> {
        for &u in &choice.free {
            if !self.cut.free.contains(&u) {
                let unit = point(self.cut.unit_of(u));
                self.cut.system.values[u] = Real::within(self.figure.enclosure(u) * unit);
            }
        }
        self.cut.used = square(&choice);
        self.cut.blocks = blocks_of(&self.cut.used, &self.cut.system)?;
        self.cut.is_exact = is_exact(&self.cut.blocks, &self.cut.used, &self.cut.system);
        (self.cut.redundant, self.cut.free) = (choice.redundant, choice.free);
        self.together = self.bound_together();
        self.ready = Followers::default();
        self.find_what_follows(rights);
        Some(())
    }

    /// Legs and what came of the last one, as one edit. `done`: how far on the way the last one began.
    pub(super) fn joined(
        &self,
        first: &Edited,
        legs: &[Edited],
        (last, done): (&Edited, f64),
    ) -> Edited {
        let whole = |t| along((done, 1.0), t);
        let mut edited = last.clone();
        if let Some(astray) = &mut edited.astray {
            astray.t = whole(astray.t);
        }
        let gone = legs.iter().position(|leg| leg.astray.is_some());
        if let Some(leg) = gone {
            edited.astray = legs[leg].astray.clone();
        }
        if let Some(astray) = &mut edited.astray {
            let before = legs[..gone.unwrap_or(legs.len())].iter().rev();
            before.for_each(|leg| astray.account.follow_on(&leg.account));
        }
        edited.t = whole(last.t);
        for (dimension, before) in edited.dimensions.iter_mut().zip(&first.dimensions) {
            dimension.from = before.from;
        }
        if !matches!(last.ending, Ending::Reached | Ending::Limit(_)) {
            edited.points = self.points();
            edited.objects = self.objects_of(&self.figure);
        }
        for lost in &mut edited.orientations.lost {
            lost.t = whole(lost.t);
        }
        for leg in legs.iter().rev() {
            edited.tubes += leg.tubes;
            edited.rejected += leg.rejected;
            edited.length += leg.length;
            let mut remarks = leg.switched_on.clone();
            remarks.append(&mut edited.switched_on);
            remarks.dedup();
            edited.switched_on = remarks;
            edited.account.follow_on(&leg.account);
            edited.orientations.follow_on(&leg.orientations);
        }
        edited
    }
}

/// A range of t of a leg that is this part of the whole way.
fn along((from, to): (f64, f64), t: (f64, f64)) -> (f64, f64) {
    let place = |t: f64| match t {
        1.0 => to,
        t => from + t * (to - from),
    };
    (place(t.0), place(t.1))
}

/// Whether the equations that were chosen may be why an edit ended so.
fn can_go_on(ending: &Ending) -> bool {
    match ending {
        Ending::Reached => false,
        Ending::Limit(_) | Ending::Passes(_) => true,
        Ending::Stopped(stop) => matches!(
            stop.kind,
            StopKind::NoStep | StopKind::Singular | StopKind::Undecided | StopKind::TurnsBack
        ),
    }
}

fn in_words(done: f64, moved: f64) -> String {
    let beside = match moved > 0.0 {
        true => format!(
            "; points moved by at most {} to meet what was left out before",
            rounded_up(moved)
        ),
        false => String::new(),
    };
    format!(
        "other equations, or other coordinates held, from {:.4} of the way on: those before are singular further on{beside}",
        done
    )
}
