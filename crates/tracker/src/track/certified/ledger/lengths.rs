//! What remains to be proved of a whole path: that lengths are positive on its range of t.

use super::Ledger;
use crate::interval::{Interval, hull, point};
use crate::places::array;
use crate::system::Homotopy;
use crate::track::{Stop, StopKind};

impl Ledger {
    /// What remains to be proved of a closed loop.
    pub fn check_closed(&self, homotopy: &Homotopy) -> Result<(), Stop> {
        // Not needed for the proof: a loop crosses t = 1 as often upwards as downwards.
        let rising = self.places.iter().filter(|place| place.rising).count();
        if 2 * rising != self.found.len() {
            let words = format!(
                "of {} crossings of t = 1 along a closed path, {rising} go upwards: this is a bug in krawl, \
                 please report it",
                self.found.len()
            );
            return Err(Stop::new(StopKind::Bug, words));
        }
        self.lengths_are_positive(homotopy)
    }

    /// What remains to be proved of an arc, claim 3: a_i(t) > 0 on the whole range of t.
    pub fn lengths_are_positive(&self, homotopy: &Homotopy) -> Result<(), Stop> {
        let range = hull(self.t_range.0, self.t_range.1);
        for (index, length) in homotopy.lengths.iter().enumerate() {
            if length.enclose(range).inf() > 0.0 {
                continue;
            }
            let bounds = lower_bounds(|t| length.enclose(t), range);
            if !bounds.iter().all(|&bound| bound > 0.0) {
                let least = bounds.into_iter().fold(f64::INFINITY, f64::min);
                let words = format!(
                    "the length of {} could not be proved positive for t from {:.6} to {:.6}: no more than \
                     that it is above {:.1e}",
                    homotopy.names[index],
                    self.t_range.0,
                    self.t_range.1,
                    least * homotopy.unit
                );
                return Err(Stop::new(StopKind::Undefined, words));
            }
        }
        Ok(())
    }
}

/// Pieces of the range of t on which lengths are bounded.
const PIECES: usize = 64;

/// Lower bounds of a function on the pieces of a range.
fn lower_bounds(enclose: impl Fn(Interval) -> Interval, range: Interval) -> [f64; PIECES] {
    let (lo, width) = (point(range.inf()), point(range.sup()) - point(range.inf()));
    array(|k| {
        let piece = hull(k as f64 / PIECES as f64, (k + 1) as f64 / PIECES as f64);
        enclose((lo + width * piece).intersection(range)).inf()
    })
}
