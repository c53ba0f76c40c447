//! One tube more: proved, linked to the last one, and entered into the account.

use super::arc::Joining;
use super::{EXIT, POINT_TOLERANCE, Test, Tracker};
use crate::track::certified::ledger::Ledger;
use crate::track::certified::link::Tube;
use crate::track::certified::reasons::{Doubt, Rejection};

impl<const N: usize, T: Test<N>> Tracker<'_, N, T> {
    /// Adds the tube that is `advance` further on. Tells whether the path ends in it.
    pub(super) fn step(&mut self, advance: f64, limit: f64) -> Result<bool, Rejection> {
        // Far away floats are no nearer to each other. (How large t is has no part in that: what is exact in it stays so.)
        let places = self.now.local.z[0][..self.equations.m].iter();
        let size = places.fold(0.0, |max: f64, x| max.max(x.abs()));
        let tolerance = POINT_TOLERANCE.max(16.0 * f64::EPSILON * size);
        let equations = &self.equations;
        let next = &mut self.next;
        let previous = self.has_previous.then_some(&self.previous[..]);
        let previous = previous.filter(|z| self.extension.trusts(z, &self.now.local, advance));
        self.now.local.predict(
            advance,
            previous,
            &mut next.local.z[0],
            &mut next.local.normal,
        );
        self.test
            .refine(equations, &mut next.local, tolerance)
            .map_err(Rejection::Refine)?;
        #[cfg(test)]
        if crate::track::certified::validation::inject_fault(
            equations,
            &mut self.inverter,
            &self.now.local,
            advance,
            &mut next.local,
        ) {
            // Its preconditioner as well is that of the other point.
            self.test
                .refine(equations, &mut next.local, tolerance)
                .map_err(Rejection::Refine)?;
        }
        self.test
            .expand(equations, &mut next.local)
            .map_err(Rejection::Refine)?;
        let expected = self.typical / next.local.last_root();
        if expected < -next.local.parameter_of(&self.now.exit.centre) {
            return Err(Rejection::Short(expected));
        }
        if !self.test.prove(equations, next, limit) {
            return Err(Rejection::Unproved);
        }
        next.exit_at = EXIT * next.proof.h;
        self.test
            .enclose_exit(equations, next)
            .ok_or(Rejection::Unproved)?;
        next.entry = match self.now.leads_to(next) {
            Some(entry) => entry,
            None if self.now.exit_is_tight || !next.reaches(&self.now.exit) => {
                return Err(Rejection::Unlinked);
            }
            // The next tube may be too narrow for what is known of the exit.
            None => {
                self.test
                    .tighten_exit(equations, &mut self.now)
                    .ok_or(Rejection::Unlinked)?;
                self.now.leads_to(next).ok_or(Rejection::Unlinked)?
            }
        };
        if next.entry.1 >= next.exit_at {
            return Err(Rejection::Unlinked);
        }
        let is_done = self.enter(false)?;
        self.test.accept(&self.next);
        self.previous.copy_from_slice(&self.now.local.z[0]);
        self.has_previous = true;
        self.extension.before_last = self.now.local.is_extended;
        std::mem::swap(&mut self.now, &mut self.next);
        Ok(is_done)
    }

    /// Whether the sketch lies ahead of the entry in a tube, travelled in the same direction as
    /// at the start: where, if so.
    fn closes(&self, tube: &Tube<N, T::Frame>) -> Result<Option<(f64, f64)>, Rejection> {
        let m = self.equations.m;
        let (h, z) = (tube.proof.h, &tube.local.z[0]);
        // Most tubes are nowhere near: |z − z₀| ≤ 2 h is generous for a tube that holds z. (Where this
        // errs the path is followed once more round, and the sketch is met again.)
        let away = |i: usize| (z[i] - self.sketch.centre[i]).abs() - self.sketch.radius[i];
        if z[m].abs() > 2.0 * h || (0..m).any(|i| away(i) > 2.0 * h) {
            return Ok(None);
        }
        match tube.locate(&self.sketch) {
            Some(at) if at.0 > tube.entry.1 => {
                // A regular curve comes back in the direction in which it left. What cannot be
                // proved here is proved in a shorter tube.
                let same_way = tube.goes_along(at, &self.first_normal);
                if same_way {
                    Ok(Some(at))
                } else {
                    Err(Rejection::Undecided(Doubt::Direction(
                        tube.proof.slope_distance,
                    )))
                }
            }
            _ => Ok(None),
        }
    }

    /// Takes the linked tube into account, the `first` one or the next. Tells whether the path ends in it.
    pub(super) fn enter(&mut self, first: bool) -> Result<bool, Rejection> {
        let extended = self.extension.on;
        let tube = if first { &self.now } else { &self.next };
        if let Some(arc) = &mut self.arc {
            let joining = Joining {
                equations: &self.equations,
                homotopy: &self.homotopy,
                tube,
                is_first: first,
                extended,
            };
            return arc.enter(&joining, &mut self.inverter, &mut self.ledger);
        }
        let closing = match first || self.beyond.is_some() {
            true => None,
            false => self.closes(tube)?,
        };
        let between = closing.map_or((tube.exit_at, tube.exit_at), |at| {
            (at.1.max(tube.exit_at), at.1)
        });
        let (equations, inverter) = (&self.equations, &mut self.inverter);
        let mut account = |ledger: &mut Ledger, between| {
            let entered = ledger.enter(equations, inverter, tube, between, extended);
            entered.map_err(Rejection::Undecided)
        };
        let before = self.way.is_some().then(|| self.ledger.mark());
        account(&mut self.ledger, between)?;
        if let (Some(way), Some(before), None) = (&self.way, before, closing) {
            let steps = self.steps + usize::from(!first);
            if let Some(meeting) = way.meets(tube, (self.ledger.mark(), steps)) {
                // What lies beyond is the other's.
                self.ledger.return_to(before);
                let until = meeting.at.1;
                if account(&mut self.ledger, (until, until)).is_ok() && way.decide(meeting) {
                    return Ok(true);
                }
                // The other's account may count on all of it.
                self.ledger.return_to(before);
                account(&mut self.ledger, between)?;
            }
        }
        if let Some(beyond) = &self.beyond {
            return Ok(beyond.is_reached(tube, tube.exit_at));
        }
        Ok(closing.is_some())
    }
}
