//! How all figures of a way stand to what was left out and is not proved to follow from the others.
//!
//! The way is followed a second time, in tubes so narrow that it can be told.

use super::Parts;
use crate::blocks::{Verdict, rounded_down};
use crate::equations::Form;
use crate::interval::{Interval, Real, hull, point};
use crate::system::Right;
use crate::track::arc::{ArcEnd, ArcRun, Off};
use crate::track::{Control, Stop, StopKind};
use std::collections::{HashMap, HashSet};
use std::mem;

/// Radii of these tubes, as parts of the unit of length.
const NARROW: [f64; 2] = [1e-8, 1e-10];
/// So many of them are taken at most: they are shorter than others.
const MOST_TUBES: usize = 20_000;

/// What was found.
#[derive(Default)]
pub(super) struct OnTheWay {
    /// How the figures stand to what was left out, by place, the worst of them, up to the first that misses it.
    pub verdicts: HashMap<usize, Verdict>,
    /// Where the first figures are that are proved to miss something, by its place: bounds on t, and what to say.
    pub missed: HashMap<usize, ((f64, f64), Stop)>,
}

impl Parts {
    /// Looks along the way of a run, with these right-hand sides. A run that proved no end ends where this one does, if that is before.
    pub(super) fn look_on_the_way(
        &mut self,
        rights: &[Vec<Real>],
        run: &mut ArcRun,
        control: &mut Control,
    ) -> OnTheWay {
        let mut out = OnTheWay::default();
        let moving = self.moving(rights);
        let moves = |u: usize| moving[self.cut.blocks.of_unknown[u]];
        let is_doubtful = |&k: &usize| !self.is_proved(k, rights) && self.unknowns_of(k).any(moves);
        let mut doubtful: Vec<usize> = (0..self.cut.redundant.len()).filter(is_doubtful).collect();
        if run.t.0 <= 0.0 {
            return out;
        }
        for &k in &doubtful {
            let at_most = f64::INFINITY;
            out.verdicts.insert(k, Verdict::Undecided { at_most });
        }
        for radius in NARROW {
            if doubtful.is_empty() {
                break;
            }
            let (again, places) = self.follow_looking(&doubtful, radius, rights, control);
            run.steps += again.steps;
            match run.end {
                ArcEnd::Reached(_) | ArcEnd::Limit(_) if again.t.1 < run.t.0 => break,
                ArcEnd::Reached(_) | ArcEnd::Limit(_) => {}
                _ if again.t.0 < run.t.0 => run.t = again.t,
                _ => {}
            }
            for (k, off) in places.into_iter().zip(again.beside) {
                let (verdict, missed) = self.verdict_on_the_way(k, off, again.t.1, rights);
                let is_told = !matches!(verdict, Verdict::Undecided { .. }) || missed.is_some();
                out.verdicts.insert(k, verdict);
                out.missed.extend(missed.map(|missed| (k, missed)));
                if is_told {
                    doubtful.retain(|&other| other != k);
                }
            }
        }
        out
    }

    /// Follows all that moves, looking at some of what was left out: at what the run tells how far it is off, by place.
    fn follow_looking(
        &mut self,
        looked_at: &[usize],
        radius: f64,
        rights: &[Vec<Real>],
        control: &mut Control,
    ) -> (ArcRun, Vec<usize>) {
        let options = self.options.clone();
        let (ready, together) = (mem::take(&mut self.ready), mem::take(&mut self.together));
        self.options.tube_radius = Some(radius * self.cut.unit);
        self.options.max_steps = MOST_TUBES;
        self.looked_at = looked_at.to_vec();
        self.together = self.bound_together();
        let again = self.follow_with_places(rights, control);
        self.looked_at.clear();
        (self.options, self.ready, self.together) = (options, ready, together);
        again
    }

    /// The verdict on what was left out, up to where a figure is first proved to miss it, and where that is. `end`: a bound on t of all of
    /// them.
    fn verdict_on_the_way(
        &self,
        redundant: usize,
        off: Off,
        end: f64,
        rights: &[Vec<Real>],
    ) -> (Verdict, Option<((f64, f64), Stop)>) {
        let unit = point(self.scale(self.cut.left_out(redundant).index));
        let right = self.right_until(redundant, end, rights);
        let verdict = |off: Interval| self.ruler(redundant).verdict(off * unit, right * unit);
        let until = off.until().map(verdict);
        let undecided = Verdict::Undecided {
            at_most: f64::INFINITY,
        };
        match off.missed.map(|(missed, t)| (verdict(missed), t)) {
            None => (until.unwrap_or(undecided), None),
            Some((Verdict::Missed { by }, t)) => {
                let name = self.cut.name_left_out(redundant);
                let words = format!(
                    "there figures that meet the other constraints miss {name} by at least {}, proved",
                    rounded_down(by)
                );
                let stop = Stop::new(StopKind::Contradiction, words);
                // None is before it but the old figure.
                (until.unwrap_or(self.verdicts[redundant]), Some((t, stop)))
            }
            // Nothing was looked at beyond.
            Some(_) => (undecided, None),
        }
    }

    /// The right-hand side of what was left out for t up to `end`, in the homotopy's unit.
    fn right_until(&self, redundant: usize, end: f64, rights: &[Vec<Real>]) -> Interval {
        let index = self.cut.left_out(redundant).index;
        Right::polynomial(&rights[index], self.scale(index)).enclose(hull(0.0, end.max(0.0)))
    }

    /// How far the sides of what was left out may be apart, in the homotopy's unit.
    pub(super) fn within(&self, redundant: usize, rights: &[Vec<Real>]) -> [f64; 2] {
        let unit = self.scale(self.cut.left_out(redundant).index);
        let right = self.right_until(redundant, 1.0, rights);
        // A power of two.
        let within = self.ruler(redundant).within(right * point(unit));
        within.map(|off| off / unit)
    }

    /// The unknowns in what was left out.
    pub(super) fn unknowns_of(&self, redundant: usize) -> impl Iterator<Item = usize> + '_ {
        let products = self.cut.system.rows[self.cut.redundant[redundant]]
            .products
            .iter();
        let forms = products.flat_map(|product| product.forms());
        forms.flat_map(Form::entries).filter_map(|(entry, _)| entry)
    }

    /// What is looked at and is about some unknowns only.
    pub(super) fn looked_at_in(&self, unknowns: &[usize]) -> impl Iterator<Item = usize> + '_ {
        let known: HashSet<usize> = match self.looked_at.is_empty() {
            true => HashSet::new(),
            false => unknowns.iter().copied().collect(),
        };
        let all = self.looked_at.iter().copied();
        all.filter(move |&k| self.unknowns_of(k).all(|u| known.contains(&u)))
    }
}
