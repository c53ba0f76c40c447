//! How each length goes from the sketch to the target.

use crate::interval::Interval;
#[cfg(test)]
use crate::interval::point;

/// A length a(t) = a₀ + a₁ t + a₂ t², with enclosures of its coefficients. a₂ is zero but for the
/// bend (RR 8705, section 3.1: −c t² + (a_so − a_sk + c) t + a_sk).
#[derive(Debug, Clone)]
pub struct Length {
    coefficients: [Interval; 3],
    target: Interval,
    /// The middles of the coefficients of a(t), for float use.
    pub a: [f64; 3],
    bends: bool,
}

impl Length {
    /// From the length in the sketch, the target length, and the bend's coefficient c if any.
    pub fn new(sketch: Interval, target: Interval, bend: Option<Interval>) -> Self {
        let zero = crate::interval::point(0.0);
        let c = bend.unwrap_or(zero);
        let [a0, a1, a2] = [sketch, target - sketch + c, -c];
        Length {
            coefficients: [a0, a1, a2],
            target,
            a: [a0.mid(), a1.mid(), a2.mid()],
            bends: bend.is_some(),
        }
    }

    /// Enclosures of the coefficients of E(t) = ½ a(t)².
    pub(super) fn half_square(&self) -> [Interval; 5] {
        let half = |x: Interval| x * crate::interval::point(0.5);
        let zero = crate::interval::point(0.0);
        let [a0, a1, a2] = self.coefficients;
        if self.bends {
            [
                half(a0.sqr()),
                a0 * a1,
                half(a1.sqr()) + a0 * a2,
                a1 * a2,
                half(a2.sqr()),
            ]
        } else {
            [half(a0.sqr()), a0 * a1, half(a1.sqr()), zero, zero]
        }
    }

    /// A length that stays what it is.
    pub fn constant(length: Interval) -> Self {
        let zero = crate::interval::point(0.0);
        Length {
            coefficients: [length, zero, zero],
            target: length,
            a: [length.mid(), 0.0, 0.0],
            bends: false,
        }
    }

    /// The degree of E(t): 2, or 4 for the bend.
    pub(super) fn degree_of_square(&self) -> usize {
        if self.bends { 4 } else { 2 }
    }

    /// An enclosure of the values that a takes on a set of t.
    ///
    /// Evaluated around the middle of the set, so that narrow sets give narrow values.
    pub fn enclose(&self, t: Interval) -> Interval {
        let [a0, a1, a2] = self.coefficients;
        let middle = crate::interval::point(t.mid());
        let dt = t - middle;
        let centred = (a0 + middle * (a1 + middle * a2))
            + dt * (a1 + crate::interval::point(2.0) * middle * a2)
            + a2 * dt.sqr();
        centred.intersection(a0 + t * (a1 + t * a2))
    }

    /// An enclosure of E(1), straight from the target length.
    pub(super) fn target_half_square(&self) -> Interval {
        self.target.sqr() * crate::interval::point(0.5)
    }

    /// a(t) in floats.
    pub fn value(&self, t: f64) -> f64 {
        self.a[0] + t * (self.a[1] + t * self.a[2])
    }

    /// a'(t) in floats.
    pub fn slope(&self, t: f64) -> f64 {
        self.a[1] + 2.0 * t * self.a[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_at_the_sketch_and_ends_at_the_target() {
        let bend = Length::new(point(1.5), point(2.0), Some(point(2.0)));
        assert_eq!(bend.enclose(point(0.0)), point(1.5));
        assert_eq!(bend.enclose(point(1.0)), point(2.0));
        assert_eq!(bend.value(0.5), 1.5 + 2.5 * 0.5 - 2.0 * 0.25);
        let straight = Length::new(point(1.5), point(2.0), None);
        assert_eq!(straight.degree_of_square(), 2);
        assert_eq!(straight.enclose(point(0.5)), point(1.75));
    }
}
