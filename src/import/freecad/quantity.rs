//! Numbers with units as FreeCAD's expressions have them: lengths in millimetres, angles in degrees, products and powers of these, and
//! plain numbers.
//!
//! Where FreeCAD's versions differ, or where rounding decides what comes out, there is no number.

use crate::import::drawing::decimal;
use crate::problem::counted;
use std::fmt::{self, Display};

/// A number in millimetres and degrees, each to some power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    pub value: f64,
    /// The powers of millimetres and of degrees.
    unit: [i32; 2],
}

/// The units that are read, as long as one millimetre or degree is 1. FreeCAD's others are of none of both.
const LENGTHS: [(&str, f64); 14] = [
    ("nm", 1e-6),
    ("um", 1e-3),
    ("µm", 1e-3),
    ("mm", 1.0),
    ("cm", 10.0),
    ("dm", 100.0),
    ("m", 1e3),
    ("km", 1e6),
    ("in", 25.4),
    ("\"", 25.4),
    ("ft", 304.8),
    ("'", 304.8),
    ("thou", 0.0254),
    ("yd", 914.4),
];
const ANGLES: [(&str, f64); 4] = [
    ("deg", 1.0),
    ("°", 1.0),
    ("rad", 180.0 / std::f64::consts::PI),
    ("gon", 0.9),
];

/// What is nearer than this to where rounding decides, in parts of the numbers there, is not decided.
const NEAR: f64 = 1e-7;

impl Quantity {
    pub fn plain(value: f64) -> Self {
        Quantity {
            value,
            unit: [0, 0],
        }
    }

    pub fn length(value: f64) -> Self {
        Quantity {
            value,
            unit: [1, 0],
        }
    }

    pub fn angle(value: f64) -> Self {
        Quantity {
            value,
            unit: [0, 1],
        }
    }

    /// The number of that name.
    pub fn constant(name: &str) -> Option<Self> {
        match name {
            "pi" => Some(Self::plain(std::f64::consts::PI)),
            "e" => Some(Self::plain(std::f64::consts::E)),
            _ => None,
        }
    }

    /// The unit of that name.
    pub fn unit(name: &str) -> Option<Self> {
        let of = |all: &[(&str, f64)]| all.iter().find(|(unit, _)| *unit == name).map(|u| u.1);
        let length = of(&LENGTHS).map(Self::length);
        length.or_else(|| of(&ANGLES).map(Self::angle))
    }

    /// Another number with the same unit.
    pub fn with(self, value: f64) -> Self {
        Quantity { value, ..self }
    }

    fn is_plain(self) -> bool {
        self.unit == [0, 0]
    }

    /// Whether degrees are in it.
    pub fn is_angle(self) -> bool {
        self.unit[1] != 0
    }

    fn checked(self) -> Result<Self, String> {
        match self.value.is_finite() {
            true => Ok(self),
            false => Err("there is no such number".to_owned()),
        }
    }

    /// The number as one of the same unit as another: a plain number gets the unit.
    pub fn like(self, other: Self) -> Result<Self, String> {
        match self.is_plain() || self.unit == other.unit {
            true => Ok(other.with(self.value)),
            false => Err(format!(
                "its unit does not fit: {self} is no {}",
                if other.is_angle() { "angle" } else { "length" }
            )),
        }
    }

    /// The negative.
    pub fn negative(self) -> Self {
        self.with(-self.value)
    }

    /// To a power, which with a unit is a whole number.
    fn power(self, by: Self) -> Result<Self, String> {
        let whole = (by.value.fract() == 0.0 && by.value.abs() < 10.0).then_some(by.value as i32);
        let whole = if self.is_plain() { Some(0) } else { whole };
        match whole.filter(|_| by.is_plain()) {
            Some(whole) => Ok(Quantity {
                value: self.value.powf(by.value),
                unit: self.unit.map(|power| power.saturating_mul(whole)),
            }),
            None => Err(format!("{self} cannot be taken to the power of {by}")),
        }
    }
}

impl Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match decimal(self.value) {
            Some(decimal) => write!(f, "{decimal}")?,
            None => write!(f, "{}", self.value)?,
        }
        for (unit, power) in ["mm", "deg"].into_iter().zip(self.unit) {
            match power {
                0 => {}
                1 => write!(f, " {unit}")?,
                _ => write!(f, " {unit}^{power}")?,
            }
        }
        Ok(())
    }
}

/// Two numbers of one unit.
fn same(a: Quantity, b: Quantity) -> Result<(), String> {
    match a.unit == b.unit {
        true => Ok(()),
        false => Err(format!("the units of {a} and {b} do not fit")),
    }
}

/// Refuses what rounding decides: `gap` is how far a number is from where the answer changes. Lengths and plain numbers are computed as there,
/// so that 0 is 0; angles are kept in radians there.
fn decided(gap: f64, size: f64, is_angle: bool) -> Result<(), String> {
    match gap.abs() <= NEAR * size.max(1.0) && (gap != 0.0 || is_angle) {
        true => Err("rounding decides what comes out".to_owned()),
        false => Ok(()),
    }
}

/// The remainder of a division, as C and Python have it, which differ where the signs do.
fn remainder(a: Quantity, b: Quantity) -> Result<f64, String> {
    let parts = a.value / b.value;
    decided(parts - parts.round(), parts.abs(), a.is_angle())?;
    let rest = a.value % b.value;
    match rest != 0.0 && (rest < 0.0) != (b.value < 0.0) {
        true => Err("versions of FreeCAD differ in remainders of negative numbers".to_owned()),
        false => Ok(rest),
    }
}

/// What an operator makes of two numbers.
pub fn operate(operator: &str, a: Quantity, b: Quantity) -> Result<Quantity, String> {
    if matches!(operator, "/" | "%") && b.value == 0.0 {
        return Err("it divides by zero".to_owned());
    }
    let made = match operator {
        "+" => same(a, b).map(|()| a.with(a.value + b.value))?,
        "-" => same(a, b).map(|()| a.with(a.value - b.value))?,
        "*" => Quantity {
            value: a.value * b.value,
            unit: [0, 1].map(|k| a.unit[k].saturating_add(b.unit[k])),
        },
        "/" => Quantity {
            value: a.value / b.value,
            unit: [0, 1].map(|k| a.unit[k].saturating_sub(b.unit[k])),
        },
        "%" => {
            b.like(a)?;
            a.with(remainder(a, b)?)
        }
        "^" => a.power(b)?,
        _ => return Err(format!("`{operator}` is no operator of numbers")),
    };
    made.checked()
}

/// Whether a comparison holds. A plain number is compared with the number of any other.
pub fn compare(operator: &str, a: Quantity, b: Quantity) -> Result<bool, String> {
    if !a.is_plain() && !b.is_plain() {
        same(a, b)?;
    }
    let (a, b, is_angle) = (a.value, b.value, a.is_angle() || b.is_angle());
    decided(a - b, a.abs().max(b.abs()), is_angle)?;
    Ok(match operator {
        "==" => a == b,
        "!=" => a != b,
        "<" => a < b,
        ">" => a > b,
        "<=" => a <= b,
        _ => a >= b,
    })
}

/// What a function makes of numbers.
pub fn call(name: &str, of: &[Quantity]) -> Result<Quantity, String> {
    let count = match name {
        "min" | "max" => 1..=usize::MAX,
        "hypot" | "cath" => 2..=3,
        "atan2" | "mod" | "pow" => 2..=2,
        _ => 1..=1,
    };
    let none = || {
        format!(
            "there is no function `{name}` of {}",
            counted(of.len(), "number")
        )
    };
    let first = of.first().filter(|_| count.contains(&of.len()));
    let a = *first.ok_or_else(none)?;
    let b = of.get(1).copied().unwrap_or(a);
    let of_plain = |f: fn(f64) -> f64| match a.is_plain() {
        true => Ok(Quantity::plain(f(a.value))),
        false => Err(format!("`{name}` takes no number with a unit, as {a}")),
    };
    let of_angle = |f: fn(f64) -> f64| match a.is_plain() || a.unit == [0, 1] {
        true => Ok(Quantity::plain(f(a.value.to_radians()))),
        false => Err(format!("`{name}` takes an angle, and {a} is none")),
    };
    let to_angle = |x: Quantity| Quantity::angle(x.value.to_degrees());
    // Where a number is rounded another way: at whole numbers, or half of one above.
    let rounded = |f: fn(f64) -> f64, above: f64| {
        let x = a.value - above;
        decided(x - x.round(), x.abs(), a.is_angle()).map(|()| a.with(f(a.value)))
    };
    let all_same = || of.iter().try_for_each(|&x| same(a, x));
    let best = |f: fn(f64, f64) -> f64| {
        all_same().map(|()| a.with(of.iter().map(|x| x.value).fold(a.value, f)))
    };
    let squares = |sign: f64| {
        let rest = of[1..].iter().map(|x| sign * x.value.powi(2));
        let sum: f64 = rest.fold(a.value.powi(2), |sum, x| sum + x);
        all_same().map(|()| a.with(sum.sqrt()))
    };
    let made = match name {
        "abs" => Ok(a.with(a.value.abs())),
        "sqrt" if a.unit[0] % 2 == 0 && !a.is_angle() => Ok(Quantity {
            value: a.value.sqrt(),
            unit: [a.unit[0] / 2, 0],
        }),
        "sqrt" => Err(format!("{a} has no root with a unit")),
        "sin" => of_angle(f64::sin),
        "cos" => of_angle(f64::cos),
        "tan" => of_angle(f64::tan),
        "asin" => of_plain(f64::asin).map(to_angle),
        "acos" => of_plain(f64::acos).map(to_angle),
        "atan" => of_plain(f64::atan).map(to_angle),
        "atan2" => same(a, b).map(|()| Quantity::angle(a.value.atan2(b.value).to_degrees())),
        "exp" => of_plain(f64::exp),
        "log" => of_plain(f64::ln),
        "log10" => of_plain(f64::log10),
        "floor" => rounded(f64::floor, 0.0),
        "ceil" => rounded(f64::ceil, 0.0),
        "trunc" => rounded(f64::trunc, 0.0),
        "round" => rounded(f64::round, 0.5),
        "min" => best(f64::min),
        "max" => best(f64::max),
        "hypot" => squares(1.0),
        "cath" => squares(-1.0),
        "pow" => a.power(b),
        "mod" if b.value == 0.0 => Err("it divides by zero".to_owned()),
        "mod" => operate("/", a, b).and_then(|unit| Ok(unit.with(remainder(a, b)?))),
        _ => Err(none()),
    };
    made?.checked()
}
