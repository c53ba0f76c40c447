//! The default way of stepping: adaptive, cubic predictor, exact derivatives.

use super::corrector::Correction;
use super::events::Events;
use super::station::{Piece, distance, dot};
use super::{SMALLEST_STEP, Tracker};
use crate::track::{Control, Status};

pub static mut ST:[usize;6]=[0;6];
/// The first step from the sketch, while there is no history.
const FIRST_STEP: f64 = 0.01;

/// A station may be off its prediction by this part of the step.
use std::sync::LazyLock as L; fn ev(n:&str,d:f64)->f64{std::env::var(n).ok().map_or(d,|x|x.parse().unwrap())}
pub static ERROR: L<f64> = L::new(||ev("ERROR",0.02));

/// And its tangent off the prediction's, as an angle in radians.
pub static NEAR: L<f64> = L::new(||ev("NEAR",0.01));
pub static TURN: L<f64> = L::new(||ev("TURN",0.2));

/// Changes of plan in one step because of what is ahead, at most.
const LOOKS_AHEAD: usize = 3;

/// Original instructions come back when their γ is this many times alpha.
const RESTORE: f64 = 2.0;

/// After so many failures in a row the current tangent is computed anew.
const RENEW_AFTER: usize = 4;

/// Steps between two looks for instructions to restore.
const RESTORE_EVERY: usize = 4;

enum Attempt {
    /// `next` is a station; how far it is from its prediction, and the size of the correction.
    Station { error: f64 },
    /// The predicted figure is near or beyond a boundary configuration.
    Boundary,
    Failed,
}

impl<const D: usize> Tracker<'_, D> {
    pub(super) fn follow(&mut self, control: &mut Control) -> Status {
        let longest = self.options.max_step.unwrap_or(f64::INFINITY);
        let mut h = FIRST_STEP.min(longest);
        let mut looks = 0;
        loop {
            if self.steps >= self.options.max_steps {
                return Status::Stopped(format!("the limit on steps is reached {}", self.place()));
            }
            let attempt = self.attempt(h);
            let near = self.evaluation.is_near_boundary();
            let (length, error) = match attempt {
                Attempt::Station { error } => {
                    let length = self.arc_length();
                    let margin = 0.25 * error + 1e-9;
                    let out_of_order = self.evaluation.is_out_of_order();
                    match self.look_between(length, margin) {
                        Events::None => {}
                        Events::Closed(s) => { #[allow(static_mut_refs)] unsafe{if std::env::var("V").is_ok(){eprintln!("corr {} err {} turn {} bnd {} unclear {}",ST[0],ST[1],ST[2],ST[3],ST[4]);}ST=[0;6];}
                            self.measure(length, s);
                            
                            self.advance(length);
                            return Status::Closed;
                        }
                        Events::Unclear => { unsafe{ST[4]+=1;} dbg_(h,"unclear");
                            if let Some(status) = self.reject(&mut h) {
                                return status;
                            }
                            continue;
                        }
                    }
                    self.measure(length, length);
                    
                    self.advance(length);
                    if near || out_of_order || self.steps.is_multiple_of(RESTORE_EVERY) && self.plan_is_restorable() {
                        self.change_plan(false, RESTORE * self.options.alpha);
                        if !self.settle() {
                            return Status::Stopped(format!(
                                "the changed construction plan cannot be evaluated {}",
                                self.place()
                            ));
                        }
                    }
                    (length, error)
                }
                Attempt::Boundary if looks < LOOKS_AHEAD => {
                    looks += 1;
                    if self.change_plan(true, f64::INFINITY) {
                        if !self.settle() {
                            return Status::Stopped(format!(
                                "the changed construction plan cannot be evaluated {}",
                                self.place()
                            ));
                        }
                    } else if let Some(status) = self.reject(&mut h) {
                        return status;
                    }
                    continue;
                }
                Attempt::Boundary | Attempt::Failed => {
                    if let Some(status) = self.reject(&mut h) {
                        return status;
                    }
                    continue;
                }
            };
            if control.is_cancelled(self.progress()) {
                return Status::Stopped("interrupted".into());
            }
            looks = 0;
            self.failures = 0;
            // The predictor's error grows like h⁴.
            let growth = (0.5 * *ERROR * length / error.max(1e-300)).sqrt().sqrt().clamp(0.5, 2.0);
            let turn = distance(&self.current.tangent, &self.previous.tangent);
            let growth = growth.min(0.8 * *TURN / turn.max(1e-300));
            h = (h * growth).min(longest);
        }
    }

    fn reject(&mut self, h: &mut f64) -> Option<Status> {
        self.rejected += 1;
        *h *= 0.5;
        self.failures += 1;
        if self.failures == RENEW_AFTER {
            // The station's own tangent may be what is wrong.
            self.settle();
        }
        (*h < SMALLEST_STEP)
            .then(|| Status::Stopped(format!("no step of {SMALLEST_STEP:e} succeeds {}", self.place())))
    }

    fn attempt(&mut self, h: f64) -> Attempt {
        match self.behind {
            Some(behind) => Piece { from: &self.previous, to: &self.current, h: behind }
                .at(behind + h, &mut self.predicted),
            None => {
                for ((out, z), u) in self.predicted.iter_mut().zip(&self.current.z).zip(&self.current.tangent) {
                    *out = h.mul_add(*u, *z);
                }
            }
        }
        let places = self.homotopy.sketch.len();
        let (figure, t) = (&self.predicted[..places], self.predicted[places]);
        self.evaluation.parameters(figure, t, &mut self.corrector.q);
        if !self.evaluation.evaluate(&self.corrector.q) || self.evaluation.is_near_boundary() {
            unsafe{ST[3]+=1;} dbg_(h,&format!("bnd {} {}",self.evaluation.gamma(),self.evaluation.is_near_boundary()));
            return Attempt::Boundary;
        }
        let next = &mut self.next;
        let correction =
            self.corrector.correct(&mut self.evaluation, h, &mut next.z, &mut next.tangent);
        let Correction::Done = correction else { unsafe{ST[0]+=1;} dbg_(h,&format!("corr gamma {} d {}",self.evaluation.gamma(),self.evaluation.driving())); return Attempt::Failed };
        let error = distance(&next.z, &self.predicted);
        if !(error <= *ERROR * h) {
            unsafe{ST[1]+=1;} dbg_(h,&format!("err {error:e}"));
            return Attempt::Failed;
        }
        // How the tangent turned; with history, compared with how it was turning before.
        let turn = dot(&next.tangent, &self.current.tangent);
        if !(turn >= 1.0 - 0.5 * *TURN * *TURN) {
            unsafe{ST[2]+=1;} dbg_(h,&format!("turn {turn}"));
            return Attempt::Failed;
        }
        Attempt::Station { error }
    }

    /// The arc length from the current station to the next, from chord and turn.
    fn arc_length(&self) -> f64 {
        let chord = distance(&self.current.z, &self.next.z);
        let turn_squared = 2.0 - 2.0 * dot(&self.current.tangent, &self.next.tangent);
        chord * (1.0 + turn_squared.max(0.0) / 24.0)
    }

    fn plan_is_restorable(&mut self) -> bool {
        if self.plan.instructions.iter().all(|i| i.original == [None; 2]) {
            return false;
        }
        let t = self.current.t();
        for (out, length) in self.lengths.iter_mut().zip(&self.homotopy.lengths) {
            *out = length.value(t);
        }
        let alpha = self.options.alpha;
        self.plan.restorable(&crate::plan::Lookout {
            figure: self.current.figure(),
            ahead: None,
            lengths: &self.lengths,
            alpha,
            restore: RESTORE * alpha,
        })
    }

    /// Path length and range of t of the piece to `next`, up to arc length `s`.
    pub(super) fn measure(&mut self, h: f64, s: f64) {
        let piece = Piece { from: &self.current, to: &self.next, h };
        self.length += piece.length(s, self.homotopy.unit);
        let t = piece.t();
        let (low, high) = &mut self.t_range;
        let mut meet = |t: f64| {
            *low = low.min(t);
            *high = high.max(t);
        };
        meet(t.value(s));
        if t.slope[0] * t.slope[1] < 0.0 {
            let (turns, count) = t.turning_points();
            turns[..count].iter().filter(|&&at| at <= s).for_each(|&at| meet(t.value(at)));
        }
    }
}

fn dbg_(h:f64,s:&str){ if h<1e-7 && std::env::var("V").is_ok(){eprintln!("{h:e} {s}");}}
