//! What a kind of constraint has to say of itself.

use super::arguments::Arguments;
use super::lowering::{Fault, Lowering};
use crate::decimal::Decimal;
use crate::places::array;
use crate::rational::Rational;
use crate::statement::{Constraint, Item, Problem};

/// What the number of a constraint is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// There is none: the constraint holds or does not.
    Nothing,
    /// A length greater than zero.
    Length,
    /// A length with a sign, or a coordinate.
    Signed,
    /// A ratio greater than zero, which has no unit.
    Ratio,
    /// An angle between 0 and 180 degrees, of which the cosine is led.
    Degrees,
    /// An angle with its sense, any number of degrees, of which the direction goes round.
    Turn,
    /// An angle between a line and a plane, at most 90 degrees, of which the sine is led.
    Slope,
}

impl Measure {
    /// Whether it can be this number.
    pub fn allows(self, value: &Decimal) -> bool {
        let less_than = |most: i32| *value.value() < Rational::from_integer(most.into());
        match self {
            Measure::Length | Measure::Ratio => value.is_positive(),
            Measure::Degrees => value.is_positive() && less_than(180),
            Measure::Slope => value.is_positive() && (less_than(90) || *value == Decimal::from(90)),
            _ => true,
        }
    }
}

/// What of the frame a constraint fixes, beyond what is the same for figures that are moved as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fixes {
    /// A direction, or anything below.
    pub frame: bool,
    /// For each axis whether a place along it is fixed.
    pub axes: [bool; 3],
}

impl Fixes {
    /// What is fixed by the distance from a coordinate axis, if one is named: a direction, and the place along all
    /// other axes.
    pub fn beside_axis(_: &Problem, of: &Constraint) -> Self {
        let axis = of.items.iter().find_map(|item| match item {
            Item::Axis(k) => Some(*k),
            _ => None,
        });
        Fixes {
            frame: axis.is_some(),
            axes: array(|k| axis.is_some_and(|axis| axis != k)),
        }
    }

    /// A direction, and no place.
    pub fn direction(_: &Problem, _: &Constraint) -> Self {
        Fixes {
            frame: true,
            ..Fixes::default()
        }
    }

    /// A direction, where a coordinate axis is named, and no place.
    fn named_direction(_: &Problem, of: &Constraint) -> Self {
        Fixes {
            frame: of.items.iter().any(|item| matches!(item, Item::Axis(_))),
            ..Fixes::default()
        }
    }
}

/// A kind of constraint.
#[derive(Clone, Copy)]
pub struct Kind {
    /// The key under `[constraints]` in problem files.
    pub key: &'static str,
    /// What it says, for people, in one sentence.
    pub meaning: &'static str,
    /// What an entry of it names, for messages: `two lines, or two planes`.
    pub takes: &'static str,
    /// What its number is.
    pub measure: Measure,
    /// What the number of one entry is, where that depends on what it names.
    pub measure_of: Option<fn(Arguments) -> Measure>,
    /// What of the frame a constraint of it fixes: unless it says more, directions, where it names a coordinate axis.
    pub fixes: fn(&Problem, &Constraint) -> Fixes,
    /// What to say in place of an entry whose number is zero, where it cannot be: a hint for messages.
    pub instead_of_zero: fn(Arguments) -> Option<&'static str>,
    /// What lines and planes an entry is read as being of, where points stand for them; for people.
    pub read_as: fn(Arguments) -> Option<String>,
    /// Its unknowns and equations.
    pub lower: fn(Given, &mut Lowering) -> Result<(), Fault>,
}

impl Kind {
    /// What most kinds say of themselves, of one with these unknowns and equations.
    pub const fn lowered_by(lower: fn(Given, &mut Lowering) -> Result<(), Fault>) -> Self {
        Kind {
            key: "",
            meaning: "",
            takes: "",
            measure: Measure::Nothing,
            measure_of: None,
            fixes: Fixes::named_direction,
            instead_of_zero: |_| None,
            read_as: |_| None,
            lower,
        }
    }
}

/// One constraint of a kind.
pub struct Given<'a> {
    /// Its name, for its equations.
    pub name: &'a str,
    /// What it names.
    pub items: Arguments<'a>,
    /// Its number; there is one exactly where the kind has a measure.
    pub value: Option<&'a Decimal>,
}

impl Given<'_> {
    /// The number.
    pub fn number(&self) -> &Decimal {
        self.value
            .expect("checked: a number where there is a measure")
    }
}
