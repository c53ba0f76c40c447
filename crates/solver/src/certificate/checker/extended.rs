//! F at points of more than 53 bits, in whole numbers, and finer tubes around such points.
//!
//! Only F at a point needs so many: at the middle of a tube, where it is left, and at a solution.

use super::equations::{Equations, ZERO};
use super::guess::newton;
use super::krawczyk::{LARGE, around, weights};
use super::matrix::{between, power, size};
use super::place::Spot;
use super::tube::Tube;
use crate::certificate::format::TubeClaim;
use crate::certificate::verdict::Fault;
use crate::interval::{Interval, point};
use num_bigint::BigInt;
use num_traits::ToPrimitive;

/// What a point is more than multiples of 2 to minus some bits, in units that are finer by 2 to minus this.
const FINER: i32 = 44;
/// t and what it is more are multiples of 2 to minus these.
const T_BITS: [i32; 2] = [60, 110];
/// Coefficients of E are rounded to multiples of 2 to minus this.
const E_BITS: i32 = 200;

/// What a point is more than its floats, and that in whole numbers.
pub struct Low {
    /// For each unknown, and t.
    pub floats: Vec<f64>,
    /// For each form, exactly: differences of whole numbers below 2⁵¹.
    pub differences: Vec<f64>,
    /// The same in units.
    forms: Vec<i64>,
    t: BigInt,
}

/// t rounded, so that it can be part of a point of more bits.
pub fn rounded_time(t: f64) -> f64 {
    (t * power(T_BITS[0])).round() * power(-T_BITS[0])
}

impl Low {
    /// A multiple of the units near `low`, to be added to a point with this t that has so many bits.
    pub fn near(eq: &Equations, t: f64, bits: i32, low: &[f64]) -> Result<Low, Fault> {
        let unit = |i: usize| if i < eq.m { bits + FINER } else { T_BITS[1] };
        let whole = low.iter().enumerate();
        let whole: Vec<f64> = whole.map(|(i, x)| (x * power(unit(i))).round()).collect();
        let t = t * power(T_BITS[0]);
        let fits = whole[..eq.m].iter().all(|x| x.abs() < power(51));
        let fits = fits && whole[eq.m].abs() < power(62) && t.abs() < power(100);
        if !(fits && t.round() == t) {
            return Err(LARGE);
        }
        let forms = eq.differences(&whole, [0.0; 2]);
        let t = (BigInt::from(t as i128) << (T_BITS[1] - T_BITS[0])) + whole[eq.m] as i64;
        let floats = whole.iter().enumerate().map(|(i, x)| x * power(-unit(i)));
        Ok(Low {
            floats: floats.collect(),
            differences: forms.iter().map(|x| x * power(-bits - FINER)).collect(),
            forms: forms.into_iter().map(|x| x as i64).collect(),
            t,
        })
    }

    /// F_e at the point, whose `forms` have so many bits.
    pub fn value(&self, eq: &Equations, e: usize, bits: i32, forms: &[i64]) -> Interval {
        let (mut coarse, mut mixed, mut fine) = (0i128, 0i128, 0i128);
        for &(factor, [l, r]) in &eq.products[e] {
            let [factor, a, b] = [factor, forms[l], forms[r]].map(i128::from);
            let [x, y] = [self.forms[l], self.forms[r]].map(i128::from);
            coarse += factor * (a * b);
            mixed += factor * (a * y + b * x);
            fine += factor * (x * y);
        }
        let double = (((BigInt::from(coarse) << FINER) + mixed) << FINER) + fine;
        let (all, mut right, mut error) = (E_BITS + 4 * T_BITS[1], BigInt::ZERO, ZERO);
        let t = size(enclosed(self.t.clone(), T_BITS[1]));
        for (k, &(near, radius)) in eq.doubles()[e].iter().enumerate().rev() {
            let whole = fixed(near.hi) + fixed(near.lo);
            right = right * &self.t + (whole << (T_BITS[1] * (4 - k as i32)));
            // Either float may have lost a unit.
            error = error * t + point(radius) + point(power(1 - E_BITS));
        }
        let double_bits = 2 * (bits + FINER) + 1;
        enclosed((double << (all - double_bits)) - right, all) + around(error)
    }
}

/// x in units of 2⁻²⁰⁰, rounded towards zero.
fn fixed(x: f64) -> BigInt {
    let (mantissa, exponent, sign) = num_traits::Float::integer_decode(x);
    let whole = BigInt::from(i128::from(mantissa) * i128::from(sign));
    match i32::from(exponent) + E_BITS {
        shift @ 0.. => whole << shift,
        shift => whole / (BigInt::from(1) << -shift),
    }
}

/// x 2^−bits.
fn enclosed(x: BigInt, bits: i32) -> Interval {
    let dropped = (x.bits() as i32 - 100).max(0);
    let floor = (x >> dropped).to_i128().map_or(f64::NAN, |x| x as f64);
    let unit = power(dropped - bits);
    // Shifting rounds down by less than 1, the conversion by less than a step.
    between(
        (floor.next_down() - 1.0) * unit,
        (floor.next_up() + 1.0) * unit,
    )
}

impl Tube {
    /// The path for all parameters of a range in a tube of its own around the middle of that, with the parameters there. What
    /// the bounds of a tube lose is nearly in proportion to its length, so that those of a short one are finer.
    ///
    /// Both tubes hold curves of zeros of F along which c·z grows, with the same c, and [J; c] is regular. The point where
    /// the finer tube is left, which is a point of its curve, lies on the other curve. So the curves are the same where c·z is
    /// the same.
    pub fn finer(&self, eq: &Equations, range: Interval) -> Option<(Tube, Interval)> {
        let n = eq.m + 1;
        // A guess: whatever it is, the tube is proved.
        let middle = |i: usize| self.beyond(0.0, i, point(range.mid())).mid();
        let near: Vec<f64> = (0..n).map(middle).collect();
        let u = weights(&self.claim.weights);
        let (curve, _) = newton(eq, (&near, true), &self.normal, &u).ok()?;
        let claim = TubeClaim {
            centre: curve.z[0].clone(),
            low: (0..n).map(|i| curve.low_of(i).mid()).collect(),
            h: range.wid() * self.advance.sup(),
            exit: 0.0,
            ..self.claim.clone()
        };
        let tube = Tube::prove(eq, &claim).ok()?;
        self.locate(&tube.exit)?;
        let near = tube.z[0].clone();
        let rest = near.iter().enumerate();
        let rest = rest.map(|(i, &near)| self.beyond(near, i, range)).collect();
        let there = tube.parameter(&Spot { near, rest });
        (there.mag() <= 1.0).then_some((tube, there))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::checker::krawczyk::{Curve, ORDER};
    use crate::equations::Form;
    use crate::interval::rounding::gamma;
    use crate::problem::Problem;
    use crate::random::Random;
    use crate::rational::{Rational, exact};
    use crate::system::Homotopy;

    fn holds(x: Interval, value: &Rational, room: f64) -> bool {
        exact(x.inf()) <= value + exact(room) && value - exact(room) <= exact(x.sup())
    }

    /// F along random polynomials, tails and all, against rational numbers; and a wrong factor is found.
    #[test]
    fn values_are_those_of_rational_numbers() {
        let mut random = Random::new(1);
        for name in ["pentahedron", "3p3l", "3p3l-orthogonal"] {
            let problem = Problem::read(format!("../../problems/constraints/{name}.toml")).unwrap();
            let eq = Equations::new(Homotopy::new(&problem).unwrap());
            let (m, n) = (eq.m, eq.m + 1);
            assert!(!eq.homotopy.tail.is_empty());
            for _ in 0..5 {
                let high: Vec<f64> = (0..n).map(|_| 2.0 * random.symmetric()).collect();
                let low: Vec<f64> = (0..n).map(|_| 1e-17 * random.symmetric()).collect();
                let mut curve = Curve::at_sum(&eq, &high, &low).unwrap();
                for _ in 1..=ORDER {
                    let mut z: Vec<f64> = (0..n).map(|_| 0.1 * random.symmetric()).collect();
                    // E is then a constant.
                    z[m] = 0.0;
                    curve.push(z).unwrap();
                }
                let mut z: Vec<Vec<Rational>> = Vec::new();
                for z_k in &curve.z {
                    z.push(z_k.iter().map(|&x| exact(x)).collect());
                }
                for (i, x) in z[0].iter_mut().enumerate() {
                    *x += exact(curve.low_of(i).mid());
                    let near = exact(high[i]) + exact(low[i]) - &*x;
                    assert!(near < exact(1e-27) && near > exact(-1e-27));
                }
                let zero = || Rational::from_integer(0.into());
                for k in 0..=2 * ORDER {
                    let found = if k == 0 {
                        curve.value()
                    } else {
                        curve.residual(k)
                    };
                    for e in 0..m {
                        let terms = eq.homotopy.terms(e);
                        let form = |form: Form<Option<usize>>, a: usize| match form {
                            Form::One => exact(if a == 0 { 1.0 } else { 0.0 }),
                            Form::Difference(x, y) => {
                                let at =
                                    |i: Option<usize>| i.map_or_else(zero, |i| z[a][i].clone());
                                at(x) - at(y)
                            }
                        };
                        let coefficient = |wrong: i32| {
                            let mut sum = zero();
                            for (index, term) in terms.iter().enumerate() {
                                let factor = term.factor + if index == 0 { wrong } else { 0 };
                                for a in k.saturating_sub(ORDER)..=k.min(ORDER) {
                                    let product = form(term.left, a) * form(term.right, k - a);
                                    sum += product * exact(0.5 * f64::from(factor));
                                }
                            }
                            sum
                        };
                        let (mut right, mut room) = (zero(), 0.0);
                        if k == 0 {
                            for &(near, radius) in eq.doubles()[e].iter().rev() {
                                right = right * &z[0][m] + exact(near.hi) + exact(near.lo);
                                room = 2.0 * room * high[m].abs() + 2.0 * radius + 1e-50;
                            }
                        }
                        // What floats may lose beyond the point itself.
                        let mut size = 0.0;
                        for term in &terms {
                            for a in k.saturating_sub(ORDER)..=k.min(ORDER) {
                                let product = form(term.left, a) * form(term.right, k - a);
                                let half = 0.5 * f64::from(term.factor);
                                size += (half * product.to_f64()).abs();
                            }
                        }
                        let value = coefficient(0) - &right;
                        assert!(
                            holds(found[e], &value, room),
                            "{name} {e} {k}: {:?}",
                            found[e]
                        );
                        let width = found[e].wid();
                        assert!(
                            width
                                <= if k == 0 {
                                    1e-15 * found[e].mag() + 1e-25
                                } else {
                                    2.0 * gamma(terms.len() + ORDER + 12) * size + 1e-200
                                },
                            "{name} {k}: {width:e}"
                        );
                        let wrong = coefficient(1) - right;
                        let shift = &wrong - &value;
                        if shift > exact(1e-10) || shift < exact(-1e-10) {
                            assert!(!holds(found[e], &wrong, room));
                        }
                    }
                }
            }
        }
    }
}
