//! How each length goes from the sketch to the target.

use crate::interval::Interval;
#[cfg(test)]
use crate::interval::point;

/// A length a(t) = a₀ + a₁ t + a₂ t² and its half square E(t) = ½ a(t)², with enclosures of all
/// coefficients. a₂ is zero but for the bend (RR 8705, section 3.1: −c t² + (a_so − a_sk + c) t + a_sk).
#[derive(Debug, Clone)]
pub struct Length {
    coefficients: [Interval; 3],
    half_square: [Interval; 5],
    target: Interval,
    /// The middles of the coefficients of a(t), for float use.
    pub a: [f64; 3],
    /// The middles of the coefficients of E(t).
    pub e: [f64; 5],
    /// How far the exact coefficients of E(t) may be from `e`.
    pub e_radius: [f64; 5],
    /// The degree of E(t): 2, or 4 for the bend.
    pub degree: usize,
}

impl Length {
    /// From the length in the sketch, the target length, and the bend's coefficient c if any.
    pub fn new(sketch: Interval, target: Interval, bend: Option<Interval>) -> Self {
        let zero = crate::interval::point(0.0);
        let c = bend.unwrap_or(zero);
        let [a0, a1, a2] = [sketch, target - sketch + c, -c];
        let half = |x: Interval| x * crate::interval::point(0.5);
        let half_square = if bend.is_some() {
            [
                half(a0.sqr()),
                a0 * a1,
                half(a1.sqr()) + a0 * a2,
                a1 * a2,
                half(a2.sqr()),
            ]
        } else {
            [half(a0.sqr()), a0 * a1, half(a1.sqr()), zero, zero]
        };
        Length {
            coefficients: [a0, a1, a2],
            half_square,
            target,
            a: [a0.mid(), a1.mid(), a2.mid()],
            e: half_square.map(|x| x.mid()),
            e_radius: half_square.map(|x| x.rad()),
            degree: if bend.is_some() { 4 } else { 2 },
        }
    }

    /// A length that stays what it is: a target, and half of its square.
    pub fn constant(length: Interval, half_square: Interval) -> Self {
        let zero = crate::interval::point(0.0);
        let half_square = [half_square, zero, zero, zero, zero];
        Length {
            coefficients: [length, zero, zero],
            half_square,
            target: length,
            a: [length.mid(), 0.0, 0.0],
            e: half_square.map(|x| x.mid()),
            e_radius: half_square.map(|x| x.rad()),
            degree: 2,
        }
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

    /// An enclosure of E on a set of t.
    pub fn enclose_half_square(&self, t: Interval) -> Interval {
        let e = &self.half_square;
        e[0] + t * (e[1] + t * (e[2] + t * (e[3] + t * e[4])))
    }

    /// An enclosure of E'' on a set of t.
    pub fn enclose_curvature(&self, t: Interval) -> Interval {
        let [_, _, e2, e3, e4] = self.half_square;
        let point = crate::interval::point;
        point(2.0) * e2 + t * (point(6.0) * e3 + t * (point(12.0) * e4))
    }

    /// Enclosures of the coefficients of E(t).
    pub fn half_square(&self) -> &[Interval; 5] {
        &self.half_square
    }

    /// An enclosure of E(1), straight from the target length.
    pub fn target_half_square(&self) -> Interval {
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
        assert!(
            bend.enclose_half_square(point(0.5))
                .contains(0.5 * bend.value(0.5).powi(2))
        );
        let straight = Length::new(point(1.5), point(2.0), None);
        assert_eq!(straight.degree, 2);
        assert_eq!(straight.enclose(point(0.5)), point(1.75));
    }
}
