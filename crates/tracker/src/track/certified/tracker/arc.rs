//! Runs that end at t = 1: from a figure at t = 0, with dt/ds > 0 proved on every tube.

use super::{CameTo, Test, Tracker};
use crate::system::Homotopy;
use crate::track::arc::{ArcEnd, ArcRun, Figure};
use crate::track::certified::FollowArcs;
use crate::track::certified::beside::Besides;
use crate::track::certified::fold::{self, FoldProver};
use crate::track::certified::ledger::Ledger;
use crate::track::certified::link::{Ball, Frame, Tube};
use crate::track::certified::orientation::Orientations;
use crate::track::certified::reasons::{Doubt, Rejection, undecided};
use crate::track::events::Rise;
use crate::track::full::{Equations, InverseMaker};
use crate::track::{Control, Options, Stop, StopKind};
use std::borrow::Cow;

/// No tube of an arc reaches further to either side, in the homotopy's unit: t goes from 0 to 1, and
/// where nothing curves a tube would have no end.
pub(super) const LONGEST: f64 = 4.0;
/// What a run to t = 1 keeps beside what every run does.
#[derive(Debug)]
pub(super) struct Arc {
    orientations: Orientations,
    /// Where there are such.
    beside: Option<Besides>,
    prover: FoldProver,
    /// Whether the equations are those of the real and imaginary parts of complex ones.
    is_complex: bool,
    /// How it ended, once it has.
    end: Option<ArcEnd>,
}

/// A linked tube as it joins the chain.
pub(super) struct Joining<'t, const N: usize, Y> {
    pub equations: &'t Equations,
    pub homotopy: &'t Homotopy,
    pub tube: &'t Tube<N, Y>,
    /// Whether it is the one around the figure at t = 0.
    pub is_first: bool,
    pub extended: bool,
}

impl Arc {
    fn new(homotopy: &Homotopy, equations: &Equations) -> Self {
        Arc {
            orientations: Orientations::new(homotopy, &equations.vector()),
            beside: (!homotopy.beside.is_empty())
                .then(|| Besides::new(homotopy, &equations.vector())),
            prover: FoldProver::new(equations),
            is_complex: false,
            end: None,
        }
    }

    /// Sets out from a figure.
    pub fn begin(&mut self, start: &Figure) {
        self.orientations.begin(start);
        if let Some(beside) = &mut self.beside {
            beside.begin();
        }
        self.end = None;
    }

    /// Takes a linked tube into account: t rises from its entry to its exit, or to t = 1, or to a fold. Tells
    /// whether the arc ends in it. If it fails nothing is changed.
    pub fn enter<const N: usize, Y: Frame>(
        &mut self,
        joining: &Joining<N, Y>,
        inverter: &mut InverseMaker,
        ledger: &mut Ledger,
    ) -> Result<bool, Rejection> {
        if self.is_complex {
            return self.enter_complex(joining, inverter, ledger);
        }
        let tube = joining.tube;
        let time = tube.time();
        let from = tube.entry.0.max(-tube.proof.h);
        let to = match time.rise(from, tube.exit_at) {
            Rise::Throughout => tube.exit_at,
            Rise::Beyond(s) => s,
            Rise::Until(s) => return self.turn(joining, ledger, (from, s)),
        };
        let before = ledger.mark();
        ledger
            .enter(
                joining.equations,
                inverter,
                tube,
                (to, to),
                joining.extended,
            )
            .map_err(Rejection::Undecided)?;
        // The chain up to here has t < 1, or it would have ended.
        let Some(found) = ledger.found().last() else {
            if to < tube.exit_at {
                ledger.return_to(before);
                return Err(Rejection::Undecided(Doubt::Time(time.undecided(from, to))));
            }
            self.look_along(tube, (from, tube.exit_at));
            return Ok(false);
        };
        // It may be a little behind the exit.
        let at = ledger.last_crossing;
        if let Rise::Until(_) = time.rise(from, at) {
            ledger.return_to(before);
            return Err(Rejection::Undecided(Doubt::Time(time.undecided(from, at))));
        }
        self.end = Some(ArcEnd::Reached(found.figure.clone()));
        self.look_along(tube, (from, at));
        Ok(true)
    }

    /// Takes a linked tube into account where the equations are the real and imaginary parts of complex equations
    /// G(Z, t) = 0: then dt/ds has the same sign all along a chain of tubes, and it is enough that t has risen in
    /// the first. Tells whether the arc ends in it. If it fails nothing is changed.
    ///
    /// For if G_Z were singular at a point of a tube's path, the real Jacobian F_X would have a rank of at most
    /// 2n − 2, and [F_X F_t] one of at most 2n − 1. But that of a tube has the rank 2n, as it is invertible with the
    /// normal added. So F_X is invertible, and dt/ds, which is zero only where it is not, has no zero.
    fn enter_complex<const N: usize, Y: Frame>(
        &mut self,
        joining: &Joining<N, Y>,
        inverter: &mut InverseMaker,
        ledger: &mut Ledger,
    ) -> Result<bool, Rejection> {
        let tube = joining.tube;
        let time = tube.time();
        let (from, h) = (tube.entry.0.max(-tube.proof.h), tube.proof.h);
        let doubt = || Rejection::Undecided(Doubt::Time(time.undecided(from, h)));
        // Of t − 1; the figure at the start has t = 0.
        let ((low, high), _) = time.bounds(tube.exit_at, tube.exit_at);
        if joining.is_first && (low <= -1.0 || low.is_nan()) {
            return Err(doubt());
        }
        if high < 0.0 {
            ledger
                .pass(tube, (from, tube.exit_at))
                .map_err(Rejection::Undecided)?;
            return Ok(false);
        }
        let ((low, _), _) = time.bounds(h, h);
        if low <= 0.0 || low.is_nan() {
            return Err(doubt());
        }
        // The chain has t < 1 up to the entry, and beyond it t rises: it is 1 once.
        ledger
            .enter_crossing(
                joining.equations,
                inverter,
                tube,
                (from, h),
                joining.extended,
            )
            .map_err(Rejection::Undecided)?;
        let found = ledger.found().last().expect("it was just entered");
        self.end = Some(ArcEnd::Reached(found.figure.clone()));
        Ok(true)
    }

    /// The arc's end at a fold in a tube in which dt/ds > 0 from its entry, `from`, to `until`.
    fn turn<const N: usize, Y: Frame>(
        &mut self,
        joining: &Joining<N, Y>,
        ledger: &mut Ledger,
        (from, until): (f64, f64),
    ) -> Result<bool, Rejection> {
        let (equations, tube) = (joining.equations, joining.tube);
        let time = tube.time();
        let doubt = || Rejection::Undecided(Doubt::Turn(time.undecided(until, tube.exit_at)));
        // That dt/ds > 0 at the entry is known of all tubes but the first.
        if joining.is_first && until <= tube.entry.1 {
            return Err(doubt());
        }
        let at = time.turning_point(from).ok_or_else(doubt)?;
        let (mut x, mut v) = (equations.vector(), equations.vector());
        tube.local.at(at, &mut x);
        tube.local.slope(at, &mut v);
        let normal = &tube.local.normal;
        let found = self
            .prover
            .prove(equations, joining.homotopy, (&x, &v), normal);
        let found = found.ok_or_else(doubt)?;
        let mut ball = Ball::new(equations);
        ball.hold(&found.figure, found.t);
        let (lo, hi) = tube.locate(&ball).ok_or_else(doubt)?;
        // Where t = 1 cannot be told from the fold, that is where the arc ends.
        // Between `until` and the fold dt/ds is not 0 if the fold is alone there.
        let is_here = lo > from
            && until <= hi
            && found.t.inf() <= 1.0
            && fold::is_alone(&found, tube, (until, hi));
        if !is_here {
            return Err(doubt());
        }
        ledger
            .pass(tube, (from, hi))
            .map_err(Rejection::Undecided)?;
        self.end = Some(ArcEnd::Limit(Box::new(found)));
        self.look_along(tube, (from, hi));
        Ok(true)
    }

    /// Notes what becomes, on a part of a tube that is proved, of all that is followed along the path.
    fn look_along<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, between: (f64, f64)) {
        self.orientations.follow(tube, between);
        if let Some(beside) = &mut self.beside {
            beside.follow(tube, between);
        }
    }
}

/// Follows arcs of one problem's equations, one after the other, setting nothing up twice.
#[derive(Debug)]
pub struct Arcs<const N: usize, T: Test<N>> {
    tracker: Tracker<'static, N, T>,
    options: Options,
}

impl<const N: usize, T: Test<N>> Arcs<N, T> {
    /// For the equations of a homotopy.
    pub fn new(homotopy: Homotopy, options: &Options) -> Self {
        let mut tracker = Tracker::new(Cow::Owned(homotopy), options);
        tracker.arc = Some(Arc::new(&tracker.homotopy, &tracker.equations));
        Arcs {
            tracker,
            options: options.clone(),
        }
    }
}

impl<const N: usize, T: Test<N>> FollowArcs for Arcs<N, T>
where
    Self: Send,
{
    fn homotopy(&self) -> &Homotopy {
        &self.tracker.homotopy
    }

    fn homotopy_mut(&mut self) -> &mut Homotopy {
        self.tracker.homotopy.to_mut()
    }

    fn set_complex(&mut self) {
        let arc = self.tracker.arc.as_mut();
        arc.expect("a run to t = 1").is_complex = true;
    }

    fn prove_at_end(&mut self, near: &[f64]) -> Result<(Figure, f64), String> {
        let tracker = &mut self.tracker;
        let m = tracker.equations.m;
        tracker.equations.set_rights(&tracker.homotopy);
        tracker.ledger.begin(&tracker.homotopy);
        let mut guess = tracker.equations.vector();
        guess[..m].copy_from_slice(near);
        guess[m] = 1.0;
        // Where 53 bits do not suffice, more may.
        for extended in [false, true] {
            if extended {
                tracker.equations.extend(&tracker.homotopy);
            }
            let (equations, inverter) = (&tracker.equations, &mut tracker.inverter);
            let prover = &mut tracker.ledger.prover;
            let proved = prover.prove(equations, inverter, &guess, extended);
            match proved {
                Ok(found) => return Ok((found.figure.clone(), found.alone_within)),
                Err(doubt) if extended => return Err(undecided(doubt, false, &tracker.homotopy)),
                Err(_) => {}
            }
        }
        unreachable!("the second round returns")
    }

    fn follow(&mut self, start: &Figure, control: &mut Control) -> ArcRun {
        let tracker = &mut self.tracker;
        tracker.begin(start);
        let result = tracker.run(&self.options, control);
        // What was proved last: the exit of the last tube, or where the arc ends.
        let t = tracker.reached();
        let steps = tracker.steps + usize::from(tracker.has_set_out);
        let arc = tracker.arc.as_mut().expect("a run to t = 1");
        let mut vanishes = None;
        let end = match (result, arc.end.take()) {
            (Ok(()), Some(end)) => end,
            (Ok(()), None) => {
                ArcEnd::Stopped(Stop::new(StopKind::Bug, "it ended nowhere: a bug in krawl"))
            }
            (Err(halt), _) => {
                vanishes = halt.vanishes;
                match halt.came_to {
                    CameTo::Stuck { is_singular: true } => ArcEnd::Passes(halt.stop),
                    _ => ArcEnd::Stopped(halt.stop),
                }
            }
        };
        let t = match &end {
            ArcEnd::Reached(_) => (1.0, 1.0),
            ArcEnd::Limit(fold) => (fold.t.inf(), fold.t.sup()),
            _ => t,
        };
        let alone_within = match &end {
            ArcEnd::Reached(_) => tracker
                .ledger
                .found()
                .last()
                .map_or(0.0, |found| found.alone_within),
            _ => 0.0,
        };
        let last = match tracker.has_set_out {
            true => &tracker.now.exit.centre,
            false => &tracker.sketch.centre,
        };
        ArcRun {
            t,
            alone_within,
            last: last[..tracker.equations.m].to_vec(),
            orientations: arc.orientations.account(),
            segments: {
                let homotopy = &*tracker.homotopy;
                let vector = vanishes.map(|k: usize| (&homotopy.tail.nonzero[k], t.0));
                arc.orientations.segments(vector, homotopy)
            },
            beside: arc.beside.as_ref().map_or(Vec::new(), Besides::account),
            end,
            steps,
            rejected: tracker.rejected,
            length: tracker.ledger.length,
            switched_on: tracker.switched_on(),
        }
    }
}
