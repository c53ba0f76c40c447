//! Numbers with units as FreeCAD's expressions have them: lengths in millimetres, angles in degrees, products and powers of these, and
//! plain numbers.
//!
//! There are none where rounding decides what comes out, as in `floor` and comparisons: angles are kept in radians there.

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

/// What an operator makes of two numbers.
pub fn operate(operator: &str, a: Quantity, b: Quantity) -> Result<Quantity, String> {
    if operator == "/" && b.value == 0.0 {
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
        "^" => a.power(b)?,
        _ => return Err(format!("`{operator}` is no operator of numbers")),
    };
    made.checked()
}

/// What a function makes of numbers.
pub fn call(name: &str, of: &[Quantity]) -> Result<Quantity, String> {
    let count = match name {
        "min" | "max" => 1..=usize::MAX,
        "hypot" => 2..=3,
        "atan2" | "pow" => 2..=2,
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
    let all_same = || of.iter().try_for_each(|&x| same(a, x));
    let best = |f: fn(f64, f64) -> f64| {
        all_same().map(|()| a.with(of.iter().map(|x| x.value).fold(a.value, f)))
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
        "min" => best(f64::min),
        "max" => best(f64::max),
        "hypot" => {
            let squares = of.iter().map(|x| x.value.powi(2));
            all_same().map(|()| a.with(squares.sum::<f64>().sqrt()))
        }
        "pow" => a.power(b),
        _ => Err(none()),
    };
    made?.checked()
}
