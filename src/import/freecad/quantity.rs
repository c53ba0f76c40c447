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

/// The units that are read. FreeCAD's others are neither of lengths nor of angles.
const UNITS: [(&str, Quantity); 18] = [
    ("nm", Quantity::length(1e-6)),
    ("um", Quantity::length(1e-3)),
    ("µm", Quantity::length(1e-3)),
    ("mm", Quantity::length(1.0)),
    ("cm", Quantity::length(10.0)),
    ("dm", Quantity::length(100.0)),
    ("m", Quantity::length(1e3)),
    ("km", Quantity::length(1e6)),
    ("in", Quantity::length(25.4)),
    ("\"", Quantity::length(25.4)),
    ("ft", Quantity::length(304.8)),
    ("'", Quantity::length(304.8)),
    ("thou", Quantity::length(0.0254)),
    ("yd", Quantity::length(914.4)),
    ("deg", Quantity::angle(1.0)),
    ("°", Quantity::angle(1.0)),
    ("rad", Quantity::angle(180.0 / std::f64::consts::PI)),
    ("gon", Quantity::angle(0.9)),
];

impl Quantity {
    const fn new(value: f64, unit: [i32; 2]) -> Self {
        Quantity { value, unit }
    }

    pub const fn plain(value: f64) -> Self {
        Self::new(value, [0, 0])
    }

    pub const fn length(value: f64) -> Self {
        Self::new(value, [1, 0])
    }

    pub const fn angle(value: f64) -> Self {
        Self::new(value, [0, 1])
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
        let unit = UNITS.iter().find(|(unit, _)| *unit == name);
        unit.map(|unit| unit.1)
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
            Some(whole) => {
                let unit = self.unit.map(|power| power.saturating_mul(whole));
                Ok(Self::new(self.value.powf(by.value), unit))
            }
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
    let units = |of: fn(i32, i32) -> i32| [0, 1].map(|k| of(a.unit[k], b.unit[k]));
    let made = match operator {
        "+" => same(a, b).map(|()| a.with(a.value + b.value))?,
        "-" => same(a, b).map(|()| a.with(a.value - b.value))?,
        "*" => Quantity::new(a.value * b.value, units(i32::saturating_add)),
        "/" => Quantity::new(a.value / b.value, units(i32::saturating_sub)),
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
        "sqrt" if a.unit[0] % 2 == 0 && !a.is_angle() => {
            Ok(Quantity::new(a.value.sqrt(), [a.unit[0] / 2, 0]))
        }
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
