//! The lengths to more than a float's precision, from the exact numbers of the problem.

use crate::interval::{Ball, DoubleDouble, root};
use crate::problem::{Decimal, Target};
use crate::rational::Rational;

/// What a(t) of one distance is made of, exactly as the problem says it.
#[derive(Debug, Clone)]
pub struct ExactLength {
    /// The square of the length in the sketch.
    pub sketch_squared: Rational,
    /// The target length.
    pub target: Target,
    /// The bend's coefficient c, if the distance bends.
    pub bend: Option<Decimal>,
    /// The homotopy's unit.
    pub unit: f64,
}

/// A number and how far the exact one may be from it.
type Approximate = (DoubleDouble, f64);

impl ExactLength {
    /// The coefficients of E(t) = ½ a(t)² (see [`super::Length`]), in the homotopy's unit, with the
    /// errors of their double-doubles.
    pub fn half_square(&self) -> [Approximate; 5] {
        let half = Ball::exactly(Rational::new(1.into(), 2.into()));
        let sketch_squared = &self.sketch_squared * self.per_unit().pow(2);
        let a0 = root(&sketch_squared);
        let to_target = root(&self.target_squared()).plus(&a0.negated());
        let e0 = Ball::exactly(sketch_squared).times(&half);
        let coefficients = match &self.bend {
            None => {
                let zero = Ball::exactly(Rational::zero());
                let straight = to_target.times(&to_target).times(&half);
                [e0, a0.times(&to_target), straight, zero.clone(), zero]
            }
            Some(c) => {
                let c = Ball::exactly(c.value() * self.per_unit());
                let (a1, a2) = (to_target.plus(&c), c.negated());
                [
                    e0,
                    a0.times(&a1),
                    a1.times(&a1).times(&half).plus(&a0.times(&a2)),
                    a1.times(&a2),
                    a2.times(&a2).times(&half),
                ]
            }
        };
        coefficients.map(|e| e.double())
    }

    /// E(1), straight from the target length.
    pub fn target_half_square(&self) -> Ball {
        let half = Rational::new(1.into(), 2.into());
        Ball::exactly(self.target_squared() * half)
    }

    fn per_unit(&self) -> Rational {
        Rational::from_float(1.0 / self.unit).expect("a unit is a power of two")
    }

    /// The square of the target length, in the homotopy's unit.
    fn target_squared(&self) -> Rational {
        self.target.squared() * self.per_unit().pow(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::{enclose, enclose_rational, point};
    use crate::rational::exact;
    use crate::system::Length;

    #[test]
    fn agrees_with_the_intervals_and_is_much_tighter() {
        for (sketch, target, bend) in [
            (1.5, "2", Some("2")),
            (0.1, "0.3", None),
            (3e7, "1e-8", Some("-0.25")),
        ] {
            let decimal = |text: &str| text.parse::<Decimal>().unwrap();
            let length = ExactLength {
                sketch_squared: exact(sketch) * exact(sketch) + exact(1e-9),
                target: Target::Length(decimal(target)),
                bend: bend.map(decimal),
                unit: 4.0,
            };
            let quarter = point(0.25);
            let wide = Length::new(
                enclose_rational(&length.sketch_squared).sqrt() * quarter,
                enclose(&decimal(target)) * quarter,
                bend.map(|c| enclose(&decimal(c)) * quarter),
            );
            for (&(near, radius), around) in length.half_square().iter().zip(&wide.half_square()) {
                assert!(near.hi + radius >= around.inf() && near.hi - radius <= around.sup());
                assert!(radius <= 1e-30 * near.size() + 1e-200, "{radius:e}");
            }
            let (near, _) = length.target_half_square().double();
            assert!(wide.target_half_square().contains(near.hi));
        }
    }
}
