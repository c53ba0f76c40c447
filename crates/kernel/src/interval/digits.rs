//! As many digits of a number as are certain, and decimals that bound a number.

use crate::decimal::Decimal;
use crate::interval::Interval;
use crate::rational::Rational;
use num_bigint::BigInt;

/// More digits than a float holds say nothing.
const MOST_DIGITS: i32 = 17;

/// A decimal from which every number of `x` differs by at most one unit of its last digit, with
/// as many digits as that allows. It is decided exactly, so it may be read as part of a proof.
///
/// Where `x` is too wide for a single digit, the decimal is replaced by the bounds; but where it is small, by a
/// zero with so many digits behind the point.
///
/// ```
/// use krawl::interval::hull;
/// use krawl::report::certain_digits;
/// assert_eq!(certain_digits(hull(1.234567896, 1.234567904)), "1.23456790");
/// assert_eq!(certain_digits(hull(0.0, 0.0)), "0");
/// assert_eq!(certain_digits(hull(-3e-9, 2e-9)), "0.00000000");
/// assert_eq!(certain_digits(hull(-1.0, 2.0)), "[-1e0, 2e0]");
/// ```
pub fn certain_digits(x: Interval) -> String {
    // Adding zero turns -0 into 0.
    let (lo, hi) = (x.inf() + 0.0, x.sup() + 0.0);
    if lo == 0.0 && hi == 0.0 {
        return "0".to_owned();
    }
    if lo == hi {
        // One float: the shortest decimal that reads as it differs by far less.
        return if fixed(lo) {
            format!("{lo}")
        } else {
            format!("{lo:e}")
        };
    }
    let bounds = || format!("[{lo:e}, {hi:e}]");
    let exact = (Rational::from_float(lo), Rational::from_float(hi));
    let (Some(exact_lo), Some(exact_hi)) = exact else {
        return bounds();
    };
    if let Some(zero) = zero(x) {
        return zero;
    }
    let magnitude = x.mag().log10().floor() as i32;
    let most = MOST_DIGITS - 1 - magnitude;
    // A first guess that is too fine by a digit or two, then coarser until it is right.
    let guess = (1.0 - x.wid().log10()).ceil();
    let start = if guess < f64::from(most) {
        guess as i32
    } else {
        most
    };
    for decimals in (-magnitude..=start).rev() {
        let shown = if fixed(x.mag()) && decimals >= 0 {
            format!("{:.*}", decimals as usize, x.mid())
        } else {
            format!("{:.*e}", (decimals + magnitude).max(0) as usize, x.mid())
        };
        let Some((value, unit)) = value_and_unit(&shown) else {
            break;
        };
        if (&value - &exact_lo).abs() <= unit && (&exact_hi - &value).abs() <= unit {
            return shown;
        }
    }
    bounds()
}

/// A zero for an interval around it, from which no number of the interval differs by more than one unit of its
/// last digit; `None` where there is no such zero of four to sixteen digits behind the point.
fn zero(x: Interval) -> Option<String> {
    if !x.contains(0.0) {
        return None;
    }
    let largest = Rational::from_float(x.mag())?;
    let shown = (4..=16usize)
        .rev()
        .map(|decimals| format!("{:.*}", decimals, 0.0));
    let mut certain = shown.filter(|shown| {
        let unit = value_and_unit(shown).map(|(_, unit)| unit);
        unit.is_some_and(|unit| largest <= unit)
    });
    certain.next()
}

/// A bound of a number, written as a decimal. On which side the decimal is is decided exactly, so it may be read as part of a proof.
///
/// ```
/// use krawl::interval::Bound;
/// assert_eq!(Bound::Lower.decimals(0.6666667, 6), "0.666666");
/// assert_eq!(Bound::Upper.decimals(0.6666667, 6), "0.666667");
/// // The float nearest to 0.1 is a little more.
/// assert_eq!(Bound::Lower.decimals(0.1, 1), "0.1");
/// assert_eq!(Bound::Upper.decimals(0.1, 1), "0.2");
/// assert_eq!(Bound::Upper.short(-168.2082731), "-168.208");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// Not above the number.
    Lower,
    /// Not below it.
    Upper,
}

impl Bound {
    /// The end of an interval that bounds it on this side.
    pub fn end(self, x: Interval) -> f64 {
        match self {
            Bound::Lower => x.inf(),
            Bound::Upper => x.sup(),
        }
    }

    /// Whether a decimal is such a bound.
    fn holds(self, decimal: &str, x: f64) -> bool {
        match (value_and_unit(decimal), Rational::from_float(x)) {
            (Some((value, _)), Some(exact)) if self == Bound::Lower => value <= exact,
            (Some((value, _)), Some(exact)) => value >= exact,
            // Infinity is written as such.
            _ => true,
        }
    }

    /// The nearest one with so many digits behind the point.
    pub fn decimals(self, x: f64, decimals: usize) -> String {
        // Adding zero turns -0 into 0.
        let shown = format!("{:.*}", decimals, x + 0.0);
        let text = match self.holds(&shown, x) {
            true => shown,
            false => {
                let sign = if self == Bound::Lower { "-" } else { "" };
                let step = format!("{sign}1e-{decimals}").parse::<Decimal>();
                match shown
                    .parse::<Decimal>()
                    .and_then(|shown| shown.plus(&step?))
                {
                    Ok(next) if !next.value().is_zero() => next.text().to_owned(),
                    Ok(_) => format!("{:.*}", decimals, 0.0),
                    // Numbers of 60 digits are none of krawl's.
                    Err(_) => shown,
                }
            }
        };
        match text.strip_prefix('-') {
            Some(zero) if zero.bytes().all(|b| b"0.".contains(&b)) => zero.to_owned(),
            _ => text,
        }
    }

    /// The nearest one with six digits, or, of numbers from a million on, none behind the point.
    pub fn short(self, x: f64) -> String {
        self.decimals(x, decimals(x, 5.0))
    }

    /// Both ends of a range, with six digits, or more where the range is narrow: no end is further out by more than a thousandth of it, down to
    /// 15 decimals.
    pub fn of_range(low: f64, high: f64) -> [String; 2] {
        let each = [decimals(low, 5.0), decimals(high, 5.0)];
        let narrow = if high > low {
            decimals(high - low, 3.0)
        } else {
            0
        };
        let most = each[0].max(each[1]).max(narrow);
        [
            Bound::Lower.decimals(low, most),
            Bound::Upper.decimals(high, most),
        ]
    }
}

/// So many decimals that there are as many digits behind the first one.
fn decimals(x: f64, behind: f64) -> usize {
    let size = x.abs().log10().floor();
    let decimals = if size.is_finite() { behind - size } else { 6.0 };
    decimals.clamp(0.0, 15.0) as usize
}

/// Whether a number is readable without a power of ten.
fn fixed(x: f64) -> bool {
    (1e-4..1e7).contains(&x.abs())
}

/// The exact value of a decimal, and of a 1 in its last digit.
fn value_and_unit(shown: &str) -> Option<(Rational, Rational)> {
    let (mantissa, exponent) = shown.split_once('e').unwrap_or((shown, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().ok()?;
    let exponent = exponent.parse::<i32>().ok()? - i32::try_from(fraction.len()).ok()?;
    let unit = Rational::from(BigInt::from(10)).pow(exponent);
    Some((Rational::from(digits) * &unit, unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::{hull, point};
    use proptest::prelude::*;

    #[test]
    fn shows_what_is_certain() {
        assert_eq!(certain_digits(point(0.1)), "0.1");
        assert_eq!(certain_digits(point(-1e300)), "-1e300");
        assert_eq!(
            certain_digits(hull(-3.541592704, -3.541592696)),
            "-3.54159270"
        );
        assert_eq!(certain_digits(hull(1.0e-9, 1.0004e-9)), "1.000e-9");
        assert_eq!(
            certain_digits(hull(123456789.0, 123456790.0)),
            "1.23456790e8"
        );
        assert_eq!(certain_digits(hull(9.99, 10.01)), "10.00");
        assert_eq!(
            certain_digits(hull(0.0, f64::MAX)),
            format!("[0e0, {:e}]", f64::MAX)
        );
        assert_eq!(certain_digits(Interval::ENTIRE), "[-inf, inf]");
        assert_eq!(certain_digits(hull(-1e-30, 1e-30)), "0.0000000000000000");
        assert_eq!(certain_digits(hull(-1e-12, 0.0)), "0.000000000000");
        assert_eq!(certain_digits(hull(-1e-3, 1e-3)), "[-1e-3, 1e-3]");
    }

    proptest! {
        #[test]
        fn bounds_are_on_their_side(
            x in prop_oneof![
                -1e3f64..1e3,
                -1e-9f64..1e-9,
                -1e15f64..1e15,
                (-9999i32..9999).prop_map(|k| f64::from(k) / 1000.0),
            ],
            decimals in 0usize..16,
        ) {
            let exact = Rational::from_float(x).unwrap();
            let value = |text: &str| text.parse::<Decimal>().unwrap().value().clone();
            let [low, high] = [Bound::Lower, Bound::Upper].map(|bound| bound.decimals(x, decimals));
            prop_assert!(value(&low) <= exact && exact <= value(&high), "{low} {x} {high}");
            let unit = value(&format!("1e-{decimals}"));
            prop_assert!(value(&high) - value(&low) <= unit, "{low} {x} {high}");
            for text in [&low, &high] {
                let behind = text.split_once('.').map_or(0, |(_, digits)| digits.len());
                prop_assert!(behind == decimals && text.parse::<f64>().is_ok(), "{text}");
                prop_assert!(text.parse::<f64>() != Ok(0.0) || !text.starts_with('-'), "{text}");
            }
        }

        #[test]
        fn one_unit_of_the_last_digit_covers_all(middle in -1e3f64..1e3, scale in -12i32..12, width in -17i32..0) {
            prop_assume!(middle != 0.0);
            let middle = middle * 10f64.powi(scale);
            let radius = middle.abs() * 10f64.powi(width);
            let x = hull(middle - radius, middle + radius);
            let shown = certain_digits(x);
            if let Some((value, unit)) = value_and_unit(&shown) {
                for end in [x.inf(), x.sup()] {
                    prop_assert!((Rational::from_float(end).unwrap() - &value).abs() <= unit);
                }
                // And no more than a factor of a few hundred is given away. The shortest decimal
                // of a single float may end early: it is nearer than its last digit says.
                let wide = Rational::from_float(x.wid().max(x.mag() * 1e-16)).unwrap();
                let given_away = unit > wide * Rational::from(BigInt::from(100));
                prop_assert!(x.is_singleton() || !given_away, "{}", shown);
            } else {
                prop_assert!(width >= -2, "{}", shown);
            }
        }
    }
}
