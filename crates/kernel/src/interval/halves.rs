//! Ranges of unknowns in a search: what they begin with, what counts as narrower, and their halves.

use super::{Interval, checked};

/// A bounded range counts as narrower where it lost this part of it.
const ENOUGH: f64 = 0.05;

/// All numbers that are not negative.
#[doc(hidden)]
pub fn upper_half() -> Interval {
    checked(0.0, f64::INFINITY).expect("an interval")
}

/// Whether a range that is in an old one is so much narrower that it is worth looking at what follows from that.
#[doc(hidden)]
#[inline]
pub fn is_narrower(new: Interval, old: Interval) -> bool {
    match (old.wid().is_finite(), new.wid().is_finite()) {
        (true, _) => new.wid() < (1.0 - ENOUGH) * old.wid(),
        (false, true) => true,
        // A bound that is new, or moved well.
        (false, false) => [(old.inf(), new.inf()), (old.sup(), new.sup())]
            .iter()
            .any(|&(a, b)| a != b && !(a.is_finite() && (b - a).abs() < 0.5 * a.abs())),
    }
}

/// Two ranges that share a border and together are the range, the lower one first. `None`: no float is between its bounds.
#[doc(hidden)]
pub fn halves(x: Interval) -> Option<[Interval; 2]> {
    let middle = match (x.inf().is_finite(), x.sup().is_finite()) {
        (true, true) => x.mid(),
        (true, false) => (2.0 * x.inf()).max(1.0),
        (false, true) => (2.0 * x.sup()).min(-1.0),
        (false, false) => 0.0,
    };
    if !(x.inf() < middle && middle < x.sup()) {
        return None;
    }
    Some([checked(x.inf(), middle)?, checked(middle, x.sup())?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::hull;

    #[test]
    fn halves_leave_nothing_out() {
        for x in [
            Interval::ENTIRE,
            upper_half(),
            hull(-1.0, 3.0),
            -upper_half(),
        ] {
            let [low, high] = halves(x).unwrap();
            assert_eq!(low.sup(), high.inf());
            assert_eq!(low.convex_hull(high), x);
        }
        assert!(halves(hull(1.0, 1.0f64.next_up())).is_none());
    }
}
