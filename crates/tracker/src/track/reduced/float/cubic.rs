//! The cubic between two points of the path whose tangents are known.

use crate::places::Each as _;
use crate::track::events::{halved, middle_of};

/// The cubic x(s), s from 0 to h, with given values and slopes at both ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic {
    pub h: f64,
    pub x: [f64; 2],
    pub slope: [f64; 2],
}

/// What is known of the places where a function near a cubic takes a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Passages {
    /// Exactly at these s, ascending; only the first so many are meant.
    At([f64; 3], usize),
    /// A turning point is too near the value to tell.
    Unclear,
}

/// Weights of values and slopes (times h) of both ends, at u = s / h; also beyond the ends.
pub(super) fn weights(u: f64) -> [f64; 4] {
    let v = u - 1.0;
    [
        v * v * (1.0 + 2.0 * u),
        u * u * (3.0 - 2.0 * u),
        u * v * v,
        u * u * v,
    ]
}

impl Cubic {
    /// x(s).
    pub fn value(&self, s: f64) -> f64 {
        let w = weights(s / self.h);
        w[0] * self.x[0] + w[1] * self.x[1] + self.h * (w[2] * self.slope[0] + w[3] * self.slope[1])
    }

    /// The turning points strictly between the ends, ascending; only the first so many are meant.
    pub fn turning_points(&self) -> ([f64; 2], usize) {
        // x'(u) = a u² + b u + c
        let [m0, m1] = self.slope.each(|m| m * self.h);
        let rise = self.x[1] - self.x[0];
        let (a, b, c) = (
            3.0 * (m0 + m1 - 2.0 * rise),
            2.0 * (3.0 * rise - 2.0 * m0 - m1),
            m0,
        );
        let discriminant = b * b - 4.0 * a * c;
        let (mut out, mut count) = ([0.0; 2], 0);
        if discriminant > 0.0 {
            let q = -0.5 * (b + discriminant.sqrt().copysign(b));
            for u in [q / a, c / q] {
                if u > 0.0 && u < 1.0 {
                    out[count] = u * self.h;
                    count += 1;
                }
            }
            if count == 2 && out[0] > out[1] {
                out.swap(0, 1);
            }
        }
        (out, count)
    }

    /// Where a function that differs from the cubic by at most `margin` (and has no more turning
    /// points) takes `value`. An end belongs to the side `x >= value`, so that a passage at the
    /// common end of two pieces is counted once.
    pub fn passages(&self, value: f64, margin: f64) -> Passages {
        let (turns, count) = self.turning_points();
        let (mut out, mut found) = ([0.0; 3], 0);
        let mut from = (0.0, self.x[0] - value);
        let inner = turns[..count].iter().map(|&s| (s, self.value(s) - value));
        for (k, to) in inner.chain([(self.h, self.x[1] - value)]).enumerate() {
            if k < count && to.1.abs() <= margin {
                return Passages::Unclear;
            }
            if (from.1 >= 0.0) != (to.1 >= 0.0) {
                let is_like = |s: f64| (self.value(s) - value >= 0.0) == (from.1 >= 0.0);
                out[found] = middle_of(halved((from.0, to.0), 60, is_like));
                found += 1;
            }
            from = to;
        }
        Passages::At(out, found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_passages() {
        // (s - 0.25)(s - 0.5)(s - 1.5) on [0, 1]
        let x = |s: f64| (s - 0.25) * (s - 0.5) * (s - 1.5);
        let slope =
            |s: f64| (s - 0.5) * (s - 1.5) + (s - 0.25) * (s - 1.5) + (s - 0.25) * (s - 0.5);
        let cubic = Cubic {
            h: 1.0,
            x: [x(0.0), x(1.0)],
            slope: [slope(0.0), slope(1.0)],
        };
        assert!((cubic.value(0.7) - x(0.7)).abs() < 1e-15);
        let Passages::At(at, 2) = cubic.passages(0.0, 1e-6) else {
            panic!("two passages")
        };
        assert!((at[0] - 0.25).abs() < 1e-12 && (at[1] - 0.5).abs() < 1e-12);
        let top = cubic.value(cubic.turning_points().0[0]);
        assert_eq!(cubic.passages(top, 1e-6), Passages::Unclear);
        assert_eq!(cubic.passages(5.0, 1e-6), Passages::At([0.0; 3], 0));
    }

    #[test]
    fn an_end_counts_once() {
        let piece = |a: f64, b: f64| Cubic {
            h: b - a,
            x: [a, b],
            slope: [1.0, 1.0],
        };
        let count = |c: Cubic| matches!(c.passages(1.0, 1e-9), Passages::At(_, 1)) as usize;
        assert_eq!(count(piece(0.5, 1.0)) + count(piece(1.0, 1.5)), 1);
        assert_eq!(count(piece(0.5, 1.0)) + count(piece(1.0, 0.5)), 2);
    }
}
