//! Where a piece of path meets t = 1, completely.
//!
//! The path's t is a polynomial ẑ_t(s) up to a distance, its slope ẑ_t'(s) up to another. The
//! range of s is split until on every piece either t ≠ 1 is certain or the sign of t' is. In
//! certified mode the distances are proved; in float mode they are estimates.

use super::full::MAX_ORDER;
use crate::interval::rounding::{gamma, round_up};

/// t along a piece of path, as a polynomial with error bounds.
#[derive(Debug, Clone, Copy)]
pub struct TimeAlong {
    /// Coefficients of ẑ_t(s) − 1, the first rounded, and zeros.
    coefficients: [f64; MAX_ORDER + 1],
    /// How far the path's t may be from the polynomial, rounding included.
    band: f64,
    /// How far the path's dt/ds may be from the polynomial's derivative.
    slope_band: f64,
    /// A bound on the polynomial's second derivative.
    curvature: f64,
    h: f64,
}

/// A stretch in which the path crosses t = 1 exactly once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// The crossing is at a parameter between these.
    pub between: (f64, f64),
    /// Whether t rises through 1.
    pub rising: bool,
}

/// The signs of t − 1 and t' could not be separated, both being known between these bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Undecided {
    /// Of t − 1.
    pub value: (f64, f64),
    /// Of dt/ds.
    pub slope: (f64, f64),
}

/// How t goes along a stretch of path that was proved to have dt/ds > 0 from its start on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rise {
    /// dt/ds > 0 all along.
    Throughout,
    /// dt/ds > 0 up to this parameter, where t > 1.
    Beyond(f64),
    /// dt/ds > 0 could be proved up to this parameter only, and t < 1 was not excluded there.
    Until(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Piece {
    Below,
    Above,
    Rising,
    Falling,
}

/// The part of a range in which a condition ceases to hold that holds at its start, after so many halvings. In floats.
pub fn halved(
    (mut a, mut b): (f64, f64),
    halvings: usize,
    mut holds: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    for _ in 0..halvings {
        let middle = middle_of((a, b));
        match holds(middle) {
            true => a = middle,
            false => b = middle,
        }
    }
    (a, b)
}

/// The middle of a range.
pub fn middle_of((a, b): (f64, f64)) -> f64 {
    0.5 * (a + b)
}

/// Where a condition changes in a range, looked at in so many pieces: in each in which its ends differ, from the first on.
pub fn changes(
    (from, to): (f64, f64),
    pieces: usize,
    mut holds: impl FnMut(f64) -> bool,
) -> impl Iterator<Item = f64> {
    let place = move |k: usize| from + (to - from) * (k as f64 / pieces as f64);
    let pieces = (0..pieces).map(move |k| (place(k), place(k + 1)));
    pieces.filter_map(move |(a, b)| {
        let at_a = holds(a);
        (holds(b) != at_a).then(|| middle_of(halved((a, b), 60, |s| holds(s) == at_a)))
    })
}

/// A piece is not split more often than this: the last are 2⁻⁴⁰ of the tube.
const MAX_DEPTH: usize = 40;
/// There are never more pieces than this: a polynomial with huge coefficients, which no path has, would be cut
/// into pieces without end.
const MAX_PIECES: usize = 10_000;

impl TimeAlong {
    /// t = Σ z_k sᵏ for |s| ≤ `h`, up to `distance`, and dt/ds up to `slope_distance`.
    pub fn new(z: &[f64], h: f64, distance: f64, slope_distance: f64) -> Self {
        Self::with_low(z, 0.0, h, distance, slope_distance)
    }

    /// t = `low` + Σ z_k sᵏ for |s| ≤ `h`, up to `distance`, and dt/ds up to `slope_distance`.
    pub fn with_low(z: &[f64], low: f64, h: f64, distance: f64, slope_distance: f64) -> Self {
        // Near t = 1 the difference is exact (Sterbenz); anywhere its error is relative to itself.
        let from_one = z[0] - 1.0;
        let (mut curvature, mut slope, mut power) = (0.0, 0.0, 1.0);
        let mut size = from_one.abs() + low.abs();
        for k in 1..z.len() {
            slope += k as f64 * z[k].abs() * power;
            if k >= 2 {
                curvature += (k * (k - 1)) as f64 * z[k].abs() * (power / h);
            }
            power *= h;
            // Once in the value; k times in the slope, which reaches over h at most.
            size += (k + 1) as f64 * z[k].abs() * power;
        }
        // Horner's rule and what the first coefficient is made of: fewer than 40 roundings of terms below
        // `size`.
        let rounding = gamma(40);
        let mut coefficients = [0.0; MAX_ORDER + 1];
        coefficients[..z.len()].copy_from_slice(z);
        coefficients[0] = from_one + low;
        TimeAlong {
            coefficients,
            band: round_up(distance + rounding * size, 40),
            slope_band: round_up(slope_distance + rounding * slope, 40),
            curvature: round_up(curvature, 40),
            h,
        }
    }

    /// Bounds of t − 1 and of dt/ds over the parameters from `a` to `b`.
    pub fn bounds(&self, a: f64, b: f64) -> ((f64, f64), (f64, f64)) {
        let c = &self.coefficients;
        let middle = 0.5 * (a + b);
        let half = 0.5 * (b - a) * (1.0 + 4.0 * f64::EPSILON) + 2.0 * f64::EPSILON * middle.abs();
        let (mut value, mut slope) = (c[MAX_ORDER], 0.0);
        for k in (0..MAX_ORDER).rev() {
            slope = slope * middle + value;
            value = value * middle + c[k];
        }
        let spread = self.slope_band + self.curvature * half;
        let reach = slope.abs() * half + 0.5 * self.curvature * half * half + self.band;
        let (spread, reach) = (round_up(spread, 10), round_up(reach, 40));
        let around = |x: f64, r: f64| ((x - r).next_down(), (x + r).next_up());
        (around(value, reach), around(slope, spread))
    }

    /// Whether what hides the sign of dt/ds between two parameters is the band around it: cutting
    /// the stretch would show no more.
    pub fn is_flat(&self, a: f64, b: f64) -> bool {
        self.curvature * (b - a) < self.slope_band
    }

    /// A parameter from `a` to `b`, at which t − 1 has different signs, where it is about zero.
    pub fn zero_between(&self, between: (f64, f64)) -> f64 {
        let value = |s: f64| {
            let terms = self.coefficients.iter().rev();
            terms.fold(0.0, |sum: f64, c| sum.mul_add(s, *c))
        };
        let above = value(between.0) > 0.0;
        middle_of(halved(between, 100, |s| (value(s) > 0.0) == above))
    }

    /// All crossings of t = 1 with parameters from `from` to `to`, and perhaps some a little
    /// outside, with |s| ≤ h.
    pub fn crossings(&self, from: f64, to: f64, out: &mut Vec<Crossing>) -> Result<(), Undecided> {
        out.clear();
        let ((low, high), _) = self.bounds(from, to);
        if low > 0.0 || high < 0.0 {
            return Ok(());
        }
        let (from, above_at_start) = self.clear_end(from, -1.0)?;
        let (to, above_at_end) = self.clear_end(to, 1.0)?;
        let mut scan = Scan {
            above: above_at_start,
            open: None,
            pieces: 0,
            out,
        };
        self.split(from, to, 0, &mut scan)?;
        scan.certain(above_at_end)
            .ok_or_else(|| self.undecided(from, to))
    }

    /// How far dt/ds > 0 can be proved from the parameter `from` on, up to `to` or to where t > 1.
    ///
    /// Pieces are split down to 2⁻`DEPTH` of the stretch, so that what is left out before a fold is short.
    pub fn rise(&self, from: f64, to: f64) -> Rise {
        const DEPTH: usize = 12;
        self.rise_between(from, to, DEPTH)
    }

    fn rise_between(&self, a: f64, b: f64, depth: usize) -> Rise {
        let ((low, _), (slope_low, _)) = self.bounds(a, b);
        if low > 0.0 {
            return Rise::Beyond(a);
        }
        if slope_low > 0.0 {
            return Rise::Throughout;
        }
        let middle = 0.5 * (a + b);
        if depth == 0 || !(a < middle && middle < b) {
            return Rise::Until(a);
        }
        match self.rise_between(a, middle, depth - 1) {
            Rise::Throughout => self.rise_between(middle, b, depth - 1),
            other => other,
        }
    }

    /// A parameter from `from` to h where dt/ds is about zero, having been positive: a guess.
    pub fn turning_point(&self, from: f64) -> Option<f64> {
        let slope = |s: f64| {
            let terms = self.coefficients.iter().enumerate().skip(1).rev();
            terms.fold(0.0, |sum: f64, (k, c)| sum.mul_add(s, k as f64 * c))
        };
        const PIECES: usize = 32;
        let at = |k: usize| from + (self.h - from) * (k as f64 / PIECES as f64);
        let k = (1..=PIECES).find(|&k| slope(at(k)) <= 0.0)?;
        let turn = halved((at(k - 1), at(k)), 60, |s| slope(s) > 0.0);
        Some(middle_of(turn))
    }

    /// Bounds of t over the parameters from `a` to `b`.
    pub fn range(&self, a: f64, b: f64) -> (f64, f64) {
        let (low, high) = self.bounds(a, b).0;
        ((low + 1.0).next_down(), (high + 1.0).next_up())
    }

    pub(super) fn undecided(&self, a: f64, b: f64) -> Undecided {
        let (value, slope) = self.bounds(a, b);
        Undecided { value, slope }
    }

    /// Moves an end outwards until t ≠ 1 is certain there; also tells whether t > 1.
    fn clear_end(&self, end: f64, direction: f64) -> Result<(f64, bool), Undecided> {
        let mut step = 0.0;
        // Enough to get from the first step to h, were it not for steps that underflow or are NaN.
        for _ in 0..64 {
            let at = end + direction * step;
            if at.abs() > self.h {
                break;
            }
            let ((low, high), _) = self.bounds(at, at);
            if low > 0.0 || high < 0.0 {
                return Ok((at, low > 0.0));
            }
            step = if step == 0.0 {
                1e-12 * self.h
            } else {
                2.0 * step
            };
        }
        Err(self.undecided(end, end))
    }

    fn split(&self, a: f64, b: f64, depth: usize, scan: &mut Scan) -> Result<(), Undecided> {
        let ((low, high), (slope_low, slope_high)) = self.bounds(a, b);
        scan.pieces += 1;
        let piece = if low > 0.0 {
            Piece::Above
        } else if high < 0.0 {
            Piece::Below
        } else if slope_low > 0.0 {
            Piece::Rising
        } else if slope_high < 0.0 {
            Piece::Falling
        } else if depth == MAX_DEPTH || scan.pieces >= MAX_PIECES {
            return Err(self.undecided(a, b));
        } else {
            let middle = 0.5 * (a + b);
            self.split(a, middle, depth + 1, scan)?;
            return self.split(middle, b, depth + 1, scan);
        };
        scan.push(piece, a, b).ok_or_else(|| self.undecided(a, b))
    }
}

/// Reads the pieces in their order and pairs the signs before and after each monotone stretch.
struct Scan<'a> {
    /// The last certain sign of t − 1: whether it is positive.
    above: bool,
    /// The monotone stretch being read: its start, its end, and whether t rises.
    open: Option<(f64, f64, bool)>,
    /// How many pieces were looked at.
    pieces: usize,
    out: &'a mut Vec<Crossing>,
}

impl Scan<'_> {
    fn push(&mut self, piece: Piece, a: f64, b: f64) -> Option<()> {
        match piece {
            Piece::Below | Piece::Above => self.certain(piece == Piece::Above),
            Piece::Rising | Piece::Falling => {
                let rising = piece == Piece::Rising;
                match &mut self.open {
                    None => self.open = Some((a, b, rising)),
                    Some((_, end, direction)) if *direction == rising => *end = b,
                    // A fold with t = 1 in reach.
                    Some(_) => return None,
                }
                Some(())
            }
        }
    }

    /// A place where the sign of t − 1 is certain: a monotone stretch before it holds exactly one
    /// crossing if the sign has changed, and none otherwise.
    fn certain(&mut self, above: bool) -> Option<()> {
        if let Some((start, end, rising)) = self.open.take()
            && above != self.above
        {
            if above != rising {
                return None;
            }
            self.out.push(Crossing {
                between: (start, end),
                rising,
            });
        }
        self.above = above;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What t is more than a float counts, and is not lost in the bounds' own rounding.
    #[test]
    fn low_words_tell_t_from_one() {
        for low in [1e-20, -1e-20, 3e-31] {
            let mut z = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            for slope in [0.0, 1.0] {
                z[1] = slope;
                // Rounding is relative to what a tube so short can reach.
                let h = 1e-3 * f64::abs(low);
                let ((lo, hi), _) = TimeAlong::with_low(&z, low, h, 0.0, 0.0).bounds(0.0, 0.0);
                assert!(lo <= low && low <= hi, "{low:e} not in [{lo:e}, {hi:e}]");
                assert!(lo > 0.0 || hi < 0.0, "[{lo:e}, {hi:e}]");
                assert!(hi - lo < 1e-12 * low.abs(), "[{lo:e}, {hi:e}]");
                let ((lo, hi), _) = TimeAlong::new(&z, h, 0.0, 0.0).bounds(0.0, 0.0);
                assert!(lo <= 0.0 && hi >= 0.0);
            }
        }
    }

    /// A crossing is sought where it is with the low word.
    #[test]
    fn low_words_move_crossings() {
        let (z, low, h) = ([1.0, 1.0, 0.0, 0.0, 0.0, 0.0], 1e-20, 1e-19);
        let time = TimeAlong::with_low(&z, low, h, 1e-24, 1e-6);
        let mut found = Vec::new();
        time.crossings(-h, h, &mut found).unwrap();
        let (a, b) = found[0].between;
        assert!(found.len() == 1 && found[0].rising && a <= -low && -low <= b);
        assert!((time.zero_between((a, b)) + low).abs() < 1e-30);
        time.crossings(-0.5 * low, h, &mut found).unwrap();
        assert!(found.is_empty(), "{found:?}");
    }
}
