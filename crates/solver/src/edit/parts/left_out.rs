//! Constraints that are left out because they follow from others at the figure: by proof, or as far as floats tell.

use super::{Parts, Used, moves};
use crate::blocks::{Given, Ruler, Verdict, combination, rounded_down};
use crate::interval::{Interval, Real, point};
use crate::system::Right;
use crate::track::arc::Figure;
use crate::track::{Stop, StopKind};

/// What a right-hand side is at t = 1, for all t.
fn at_rest(right: &[Real]) -> Vec<Real> {
    vec![right.iter().fold(Real::zero(), |sum, c| &sum + c)]
}

/// For each right-hand side what it is at t = 1, for all t: a polynomial in t with a constant term only.
pub(super) fn at_rest_all(rights: &[Vec<Real>]) -> Vec<Vec<Real>> {
    rights.iter().map(|right| at_rest(right)).collect()
}

impl Parts {
    /// Looks for identities by which the equations that were left out follow from the others.
    pub(super) fn find_what_follows(&mut self, rights: &[Vec<Real>]) {
        if self.cut.redundant.is_empty() {
            return;
        }
        let given = |used: &Used| match *used {
            Used::Row(row) => {
                let row = &self.cut.system.rows[row];
                Given::row(row, &at_rest(&rights[row.index]))
            }
            Used::Held(u) => Given::held(u, &self.cut.system.values[u]),
        };
        self.given = self.cut.used.iter().map(given).collect();
        let count = 0..self.cut.redundant.len();
        let how = |k: usize| combination(self.cut.left_out(k), &self.given);
        self.follows = count.clone().map(how).collect();
        let rights = at_rest_all(rights);
        self.proved = count.map(|k| self.is_proved(k, &rights)).collect();
    }

    /// Whether an equation that was left out, by its place among these, is proved to hold wherever the others do, with these
    /// right-hand sides and for every t.
    pub(super) fn is_proved(&self, redundant: usize, rights: &[Vec<Real>]) -> bool {
        let Some(Some(how)) = self.follows.get(redundant) else {
            return false;
        };
        let row = self.cut.left_out(redundant);
        let of = |i: usize| self.rights_of(self.cut.used[i], rights);
        how.holds(&rights[row.index], of, |k| self.given[k].constant())
    }

    /// Notes what is proved to follow with these right-hand sides at rest at t = 1; where one does not any more, looks anew.
    pub(super) fn note_what_follows(&mut self, rights: &[Vec<Real>]) {
        let rights = at_rest_all(rights);
        let all = |parts: &Self| -> Vec<bool> {
            let count = 0..parts.cut.redundant.len();
            count.map(|k| parts.is_proved(k, &rights)).collect()
        };
        let now = all(self);
        if now
            .iter()
            .zip(&self.proved)
            .any(|(now, before)| *before && !now)
        {
            self.find_what_follows(&rights);
            return;
        }
        self.proved = now;
    }

    /// How a figure stands to each equation that was left out, by its place among these. `time`: t there, where that is not 1.
    pub(super) fn verdicts(
        &self,
        figure: &Figure,
        rights: &[Vec<Real>],
        time: Option<Interval>,
    ) -> Vec<Verdict> {
        let rows = self.cut.redundant.iter().enumerate();
        rows.map(|(k, &row)| {
            if self.is_proved(k, rights) {
                return Verdict::Follows;
            }
            let unit = point(self.scale(self.cut.system.rows[row].index));
            let (miss, right) = self.sides(row, figure, rights, time);
            self.ruler(k).verdict(miss * unit, right * unit)
        })
        .collect()
    }

    /// How what was left out is measured.
    pub(super) fn ruler(&self, redundant: usize) -> Ruler {
        self.cut.ruler(redundant, self.options.redundant_tolerance)
    }

    /// By what a figure misses a row, and its right-hand side, in the homotopy's unit. `time`: t there, where that is not 1.
    pub(super) fn sides(
        &self,
        row: usize,
        figure: &Figure,
        rights: &[Vec<Real>],
        time: Option<Interval>,
    ) -> (Interval, Interval) {
        let row = &self.cut.system.rows[row];
        let left = row.over(|u| figure.enclosure(u));
        let right = Right::polynomial(&rights[row.index], self.scale(row.index));
        let right = match time {
            Some(t) => right.enclose(t),
            None => right.at_target(),
        };
        (left - right, right)
    }

    /// The first constraint that was left out and is proved to be missed, by its place, and what to say of it.
    pub(super) fn missed(&self, verdicts: &[Verdict]) -> Option<(usize, Stop)> {
        verdicts.iter().enumerate().find_map(|(k, verdict)| {
            let &Verdict::Missed { by } = verdict else {
                return None;
            };
            let name = self.cut.name_left_out(k);
            let words = format!(
                "{name} contradicts {}: the figure that meets them misses it by at least {}, proved",
                self.cut.others(),
                rounded_down(by)
            );
            Some((k, Stop::new(StopKind::Contradiction, words)))
        })
    }

    /// A dimension that is to move but follows from others, and not so as these move.
    pub(super) fn unmovable(&self, rights: &[Vec<Real>]) -> Option<String> {
        let redundant = self.cut.redundant.iter().enumerate();
        let redundant = redundant.filter(|(k, _)| !self.is_proved(*k, rights));
        let redundant = redundant.map(|(_, &row)| self.cut.system.rows[row].index);
        let mut all = redundant.chain(self.cut.system.implied.iter().copied());
        let fixed = all.find(|&index| moves(&rights[index]))?;
        Some(format!(
            "{} follows from {} at this figure and cannot change by itself, nor otherwise than they make it all along the way",
            self.cut.name(fixed),
            self.cut.others()
        ))
    }
}
