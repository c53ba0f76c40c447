//! One path on two threads: both ways from the sketch at once, until they meet.
//!
//! Both are chains of proved tubes that set out from the sketch in opposite directions. Where the end of the one lies
//! in a tube of the other, ahead of where that tube is entered, they have met. Say that the component S of the
//! sketch is run through by φ(s), φ(0) the sketch, s growing in the direction of the first: the first has come to φ(p), the second to
//! φ(−q), p and q positive, and these are the same point. A curve that is not closed has no such points, so S is closed, and the
//! two arcs cover all of it. No direction has to be proved there.
//!
//! That they set out in opposite directions is proved in the tubes around the sketch: S is regular there, so that both tangents are
//! the same but for their sign, and they have positive components along a vector and its negative.
//!
//! No place is missed because threads do not wait for each other: each chain makes its end known and reads that of the other in one step,
//! so of the two that pass one another the later one finds the other's end in its newest tube. Where that cannot be
//! proved nothing is lost either: both go on, and come back to the sketch. A chain that is back at the sketch is met no more, as
//! the two arcs would cover the path twice.

use super::super::ledger::Mark;
use super::super::link::{Ball, Frame, Tube};
use super::{Halt, Test, Tracker};
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::{Control, Options};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Why a chain ends because of the other.
pub(super) const OVER: &str = "the other way has come to an end";

/// Where a chain stands.
#[derive(Debug, Clone)]
struct End {
    /// Its end.
    at: Ball,
    /// The account up to there.
    mark: Mark,
    /// Tubes up to there.
    steps: usize,
}

#[derive(Debug, Default)]
struct State {
    /// The vector along which the path is proved to set out, of each chain.
    directions: [Option<Vector>; 2],
    ends: [Option<End>; 2],
    /// The chain whose tube holds the end of the other, and that end.
    met: Option<(usize, End)>,
}

/// What the two chains know of each other.
#[derive(Debug, Default)]
struct Ways {
    state: Mutex<State>,
    is_over: AtomicBool,
}

impl Ways {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn end(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

/// One of the two.
#[derive(Debug)]
pub(super) struct Way {
    ways: Arc<Ways>,
    number: usize,
}

impl Way {
    /// Whether the run is over.
    pub(super) fn is_over(&self) -> bool {
        self.ways.is_over.load(Ordering::Relaxed)
    }

    /// The tube around the sketch is proved, and that the path has a positive component along `normal` there.
    pub(super) fn sets_out(&self, normal: &Vector) {
        self.ways.lock().directions[self.number] = Some(normal.clone());
    }

    /// Makes the end of a tube known that is now the last of this chain, and tells where the other chain ends in it, if that is
    /// proved, and that t rises there or falls: a fold in what both hold would be counted twice.
    pub(super) fn meets<const N: usize, Y: Frame>(
        &self,
        tube: &Tube<N, Y>,
        (mark, steps): (Mark, usize),
    ) -> Option<Meeting> {
        let mut state = self.ways.lock();
        let end = state.ends[self.number].get_or_insert_with(|| End {
            at: tube.exit.clone(),
            mark,
            steps,
        });
        end.at.copy_from(&tube.exit);
        (end.mark, end.steps) = (mark, steps);
        let other = state.ends[1 - self.number].as_ref()?;
        // Most are nowhere near: |z − z₀| ≤ 2 h is generous for a tube that holds z.
        let away = |(z, x): (&f64, &f64)| (z - x).abs() > 2.0 * tube.proof.h;
        if tube.local.z[0].iter().zip(&*other.at.centre).any(away) {
            return None;
        }
        let at = tube.locate(&other.at).filter(|at| at.0 > tube.entry.1)?;
        let (_, (low, high)) = tube.time().bounds(at.0, at.1);
        (low > 0.0 || high < 0.0).then(|| Meeting {
            at,
            end: other.clone(),
        })
    }

    /// The run is over with this meeting, unless it was over before.
    pub(super) fn decide(&self, meeting: Meeting) -> bool {
        let mut state = self.ways.lock();
        let [ahead, back] = &state.directions;
        let opposite = |(a, b): (&Vector, &Vector)| a.iter().zip(&**b).all(|(a, b)| *a == -b);
        let are_opposite = ahead.as_ref().zip(back.as_ref()).is_some_and(opposite);
        let is_first = are_opposite && state.met.is_none() && !self.is_over();
        if is_first {
            state.met = Some((self.number, meeting.end));
            self.ways.end();
        }
        is_first
    }
}

/// Where a chain's newest tube holds the end of the other.
#[derive(Debug)]
pub(super) struct Meeting {
    /// Bounds on the parameter of the point in this tube.
    pub(super) at: (f64, f64),
    end: End,
}

/// Whether a run goes both ways at once: where several threads are wanted, and nobody wants to see the tubes in their order.
/// Paths of other constraints than distances may have two ends, which are told one after the other.
pub(super) fn is_wanted(homotopy: &Homotopy, options: &Options, control: &Control) -> bool {
    options.threads != 1
        && homotopy.tail.is_empty()
        && control.witness.is_none()
        && control.trace.is_none()
        && control.figures.is_none()
}

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Follows the path both ways until they meet, the other way on another thread.
    pub(super) fn run_both_ways(
        &mut self,
        options: &Options,
        control: &mut Control,
    ) -> Result<(), Halt> {
        let ways = Arc::new(Ways::default());
        let way = |number| {
            let ways = Arc::clone(&ways);
            Some(Way { ways, number })
        };
        // Threads that work on one tube together are shared among the two.
        let here = Options {
            threads: options.threads.div_ceil(2),
            ..options.clone()
        };
        let there = Options {
            reverse: !here.reverse,
            ..here.clone()
        };
        let mut back = Tracker::<N, T>::new(self.homotopy.clone(), &there);
        back.stands_where(self);
        (self.way, back.way) = (way(0), way(1));
        let ahead = std::thread::scope(|scope| {
            let other = || back.run(&there, &mut Control::default());
            let other = std::thread::Builder::new().spawn_scoped(scope, other);
            let ahead = self.run(&here, control);
            ways.end();
            // Where no thread could be had this one has gone all the way.
            if let Some(Err(panic)) = other.ok().map(|other| other.join()) {
                std::panic::resume_unwind(panic);
            }
            ahead
        });
        self.rejected += back.rejected;
        self.shortened += back.shortened;
        let met = ways.lock().met.take();
        // A chain whose end was made known has accounted for all up to it. Should it have lost some of that, in accounting for
        // its last tube a second time, the account is not used.
        let is_whole = match met {
            None => return ahead,
            Some((0, end)) => {
                let holds = back.ledger.holds(&end.mark);
                back.ledger.return_to(end.mark);
                back.steps = end.steps;
                holds
            }
            Some((_, end)) => {
                let holds = self.ledger.holds(&end.mark);
                self.ledger.return_to(end.mark);
                self.steps = end.steps;
                holds
            }
        };
        if !is_whole || self.ledger.close_with(back.ledger).is_err() {
            // One way alone does not have to tell the two accounts apart.
            let mut anew = Tracker::new(self.homotopy.clone(), options);
            anew.stands_where(self);
            *self = anew;
            return self.run(options, control);
        }
        self.ways = Some([self.steps, back.steps]);
        self.steps += back.steps;
        Ok(())
    }
}
