//! How all figures of a way stand to what was left out and is not proved to follow from the others.
//!
//! The way is followed a second time, in tubes so narrow that it can be told.

use super::{End, Parts, Run};
use crate::blocks::{Verdict, rounded_down};
use crate::edit::ending::Astray;
use crate::equations::Form;
use crate::interval::{Interval, Real, hull, point};
use crate::system::Right;
use crate::track::arc::Off;
use crate::track::{Control, Stop, StopKind};
use std::collections::HashMap;
use std::mem;

/// Radii of these tubes, as parts of the unit of length.
const NARROW: [f64; 2] = [1e-8, 1e-10];
/// So many of them are taken at most: they are shorter than others.
const MOST_TUBES: usize = 20_000;

/// What was found.
#[derive(Default)]
pub(super) struct OnTheWay {
    /// How the figures stand to what was left out, by place, the worst of them, where none is proved to miss it.
    pub verdicts: HashMap<usize, Verdict>,
    /// The first that is proved to miss something.
    pub astray: Option<Astray>,
}

impl Parts {
    /// Looks along the way of a run, with these right-hand sides. A run that proved no end ends where this one does, if that is before.
    pub(super) fn look_on_the_way(
        &mut self,
        rights: &[Vec<Real>],
        run: &mut Run,
        control: &mut Control,
    ) -> OnTheWay {
        let mut out = OnTheWay::default();
        let moving = self.moving(rights);
        let moves = |u: usize| moving[self.blocks.of_unknown[u]];
        let doubtful = 0..self.redundant.len();
        let doubtful = doubtful.filter(|&k| !self.is_proved(k, rights));
        let mut doubtful: Vec<usize> = doubtful
            .filter(|&k| self.unknowns_of(k).any(moves))
            .collect();
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
            let again = self.follow_looking(&doubtful, radius, rights, control);
            run.tubes += again.tubes;
            match run.end {
                End::Reached(_) | End::Limit(..) if again.t.1 < run.t.0 => break,
                End::Reached(_) | End::Limit(..) => {}
                _ if again.t.0 < run.t.0 => run.t = again.t,
                _ => {}
            }
            for (k, off) in again.beside {
                let (verdict, astray) = self.verdict_on_the_way(k, off, again.t.1, rights);
                if !matches!(verdict, Some(Verdict::Undecided { .. })) {
                    doubtful.retain(|&other| other != k);
                }
                match verdict {
                    Some(verdict) => out.verdicts.insert(k, verdict),
                    None => out.verdicts.remove(&k),
                };
                let first = |a: &Astray| out.astray.as_ref().is_none_or(|b| a.t.0 < b.t.0);
                if let Some(astray) = astray.filter(first) {
                    out.astray = Some(astray);
                }
            }
        }
        out
    }

    /// Follows all that moves, looking at some of what was left out.
    fn follow_looking(
        &mut self,
        looked_at: &[usize],
        radius: f64,
        rights: &[Vec<Real>],
        control: &mut Control,
    ) -> Run {
        let options = self.options.clone();
        let (ready, together) = (mem::take(&mut self.ready), mem::take(&mut self.together));
        self.options.tube_radius = Some(radius * self.unit);
        self.options.max_steps = MOST_TUBES;
        self.looked_at = looked_at.to_vec();
        self.together = self.bound_together();
        let again = self.follow(rights, control);
        self.looked_at.clear();
        (self.options, self.ready, self.together) = (options, ready, together);
        again
    }

    /// The verdict on what was left out, or where a figure is first proved to miss it. `end`: a bound on t of all of them.
    fn verdict_on_the_way(
        &self,
        redundant: usize,
        off: Off,
        end: f64,
        rights: &[Vec<Real>],
    ) -> (Option<Verdict>, Option<Astray>) {
        let unit = point(self.scale(self.system.rows[self.redundant[redundant]].index));
        let right = self.right_until(redundant, end, rights);
        let verdict = |off: Interval| self.ruler(redundant).verdict(off * unit, right * unit);
        let Some((missed, t)) = off.missed else {
            return (Some(verdict(off.met)), None);
        };
        let Verdict::Missed { by } = verdict(missed) else {
            // Nothing was looked at beyond.
            let at_most = f64::INFINITY;
            return (Some(Verdict::Undecided { at_most }), None);
        };
        let name = self.name(self.system.rows[self.redundant[redundant]].index);
        let words = format!(
            "from there on the figures that meet the other constraints miss {name}, there by at least {}, proved",
            rounded_down(by)
        );
        let stop = Stop::new(StopKind::Contradiction, words);
        (None, Some(Astray { t, stop }))
    }

    /// The right-hand side of what was left out for t up to `end`, in the homotopy's unit.
    fn right_until(&self, redundant: usize, end: f64, rights: &[Vec<Real>]) -> Interval {
        let index = self.system.rows[self.redundant[redundant]].index;
        Right::polynomial(&rights[index], self.scale(index)).enclose(hull(0.0, end.max(0.0)))
    }

    /// How far the sides of what was left out may be apart, in the homotopy's unit.
    pub(super) fn within(&self, redundant: usize, rights: &[Vec<Real>]) -> [f64; 2] {
        let unit = self.scale(self.system.rows[self.redundant[redundant]].index);
        let right = self.right_until(redundant, 1.0, rights);
        // A power of two.
        let within = self.ruler(redundant).within(right * point(unit));
        within.map(|off| off / unit)
    }

    /// The unknowns in what was left out.
    pub(super) fn unknowns_of(&self, redundant: usize) -> impl Iterator<Item = usize> + '_ {
        let products = self.system.rows[self.redundant[redundant]].products.iter();
        let forms = products.flat_map(|product| product.forms());
        forms.flat_map(Form::entries).filter_map(|(entry, _)| entry)
    }

    /// What is looked at and is about some unknowns only.
    pub(super) fn looked_at_in(&self, unknowns: &[usize]) -> impl Iterator<Item = usize> + '_ {
        let known: std::collections::HashSet<usize> = match self.looked_at.is_empty() {
            true => Default::default(),
            false => unknowns.iter().copied().collect(),
        };
        let all = self.looked_at.iter().copied();
        all.filter(move |&k| self.unknowns_of(k).all(|u| known.contains(&u)))
    }
}
