//! Which dimension is to become how long.

use super::computed::check_given;
use super::ending::Dimension;
use crate::constraint::{self, MOST_TURN, Measure};
use crate::interval::angle::{degrees_of_cosine, direction};
use crate::interval::{Interval, Real, point};
use crate::places::Each as _;
use crate::problem::expression::names;
use crate::problem::{Constraint, Decimal, DecimalError, Item, Problem, Shape, Target};
use crate::rational::Rational;

/// A dimension and its new value.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The index in [`Problem::distances`], or the number of those plus the index in [`Problem::constraints`] of a
    /// constraint with a value.
    pub index: usize,
    /// The new value: of a constraint, its number, in the unit of the problem or in degrees.
    pub target: Target,
}

/// Why a setting makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingError {
    /// Two dimensions of a problem are of the same kind and about the same points and objects.
    #[error("{0} cannot be told from another dimension")]
    LooksTheSame(String),
    /// Not of the form NAME=VALUE.
    #[error("`{0}`: write NAME=VALUE, such as {1}")]
    Form(String, String),
    /// No dimension has that name.
    #[error("there is no dimension `{name}`; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// Those that there are, shortened.
        known: String,
    },
    /// A constraint of another program's file of which there is no kind here.
    #[error(
        "`{0}` is a constraint that krawl has no kind for: what it names stays as it is in the file"
    )]
    Kept(String),
    /// A constraint that has no number.
    #[error(
        "`{name}` is a constraint without a number, `{kind}`: there is nothing to set; dimensions are {known}"
    )]
    NoNumber {
        /// The name.
        name: String,
        /// The kind of the constraint.
        kind: String,
        /// The dimensions that there are, shortened.
        known: String,
    },
    /// More than one has.
    #[error(
        "the name `{0}` may mean more than one dimension: put the kind in front, as in `dx:A-B`, or rename points that have `-` in their names"
    )]
    Ambiguous(String),
    /// Not a decimal.
    #[error("{name}: {error}")]
    Number {
        /// The dimension.
        name: String,
        /// What is wrong.
        error: DecimalError,
    },
    /// A length is positive.
    #[error("{0}: a length must be greater than 0, and {1} is not")]
    NotPositive(String, String),
    /// A ratio is positive.
    #[error("{0}: a ratio must be greater than 0, and {1} is not")]
    NotARatio(String, String),
    /// An angle is between 0 and 180 degrees.
    #[error(
        "{0}: an angle must be between 0 and 180 degrees, and {1} is not: one that goes beyond is given under `turns`"
    )]
    NotAnAngle(String, String),
    /// An angle between a line and a plane is at most 90 degrees.
    #[error(
        "{0}: an angle between a line and a plane must be greater than 0 and at most 90 degrees, and {1} is not"
    )]
    NotASlope(String, String),
    /// Edits turn by somewhat more than a whole turn at most.
    #[error(
        "{0}: from {1} to {2} degrees is more than {MOST_TURN} degrees at once: go there in two steps or more"
    )]
    TurnsTooFar(String, String, String),
    /// A dimension is set twice.
    #[error("{0} is set twice: leave out one of the two")]
    Twice(String),
    /// A dimension is computed from parameters.
    #[error("{0} is computed, by `{1}`: set the parameter in it")]
    Computed(String, String),
    /// A name like that of a parameter.
    #[error("there is no dimension or parameter `{0}`: did you mean `{1}`?")]
    NearParameter(String, String),
    /// A parameter where a dimension is driven.
    #[error("{0} is a parameter, which `krawl edit FILE --set` sets: name a dimension here")]
    Parameter(String),
    /// A parameter that nothing is computed from.
    #[error(
        "nothing is computed from {0}, and it stands in no equation: there is nothing to change"
    )]
    Unused(String),
    /// A parameter, or a dimension, cannot be computed.
    #[error("{0}: {1}")]
    Expression(String, String),
    /// None at all.
    #[error("no dimension is set: name one, such as {0}")]
    None(String),
}

impl Setting {
    /// A value for the dimension `index`.
    ///
    /// # Panics
    /// If the problem has no such dimension.
    pub fn new(problem: &Problem, index: usize, value: Decimal) -> Result<Self, SettingError> {
        let measure = measure_of(problem, index);
        let wrong = match measure {
            _ if measure.allows(&value) => return Ok(Setting::to(index, value)),
            Measure::Ratio => SettingError::NotARatio,
            Measure::Degrees => SettingError::NotAnAngle,
            Measure::Slope => SettingError::NotASlope,
            _ => SettingError::NotPositive,
        };
        Err(wrong(problem.dimension_name(index), value.to_string()))
    }

    /// The same of any value.
    pub(super) fn to(index: usize, value: Decimal) -> Self {
        let target = Target::Length(value);
        Setting { index, target }
    }

    /// What a dimension of a problem is.
    pub(crate) fn now(problem: &Problem, index: usize) -> Self {
        let target = match index.checked_sub(problem.distances.len()) {
            None => problem.distances[index].target.clone(),
            Some(c) => {
                let value = problem.constraints[c].value.clone();
                Target::Length(value.expect("a dimension has a value"))
            }
        };
        Setting { index, target }
    }

    /// The same setting of another problem with the same points and objects, such as [`super::completed`] makes of this
    /// one; `None`: that does not have the dimension.
    ///
    /// # Errors
    /// If either problem has two dimensions that look the same.
    pub fn carried(&self, from: &Problem, to: &Problem) -> Result<Option<Self>, SettingError> {
        let alike = |problem: &Problem, index: usize| -> Vec<usize> {
            let head = problem.distances.len();
            match index.checked_sub(from.distances.len()) {
                None => {
                    let points = from.distances[index].points;
                    let all = 0..head;
                    all.filter(|&d| problem.distances[d].points == points)
                        .collect()
                }
                Some(c) => {
                    let of = |c: &Constraint| (c.kind.clone(), c.items.clone());
                    let wanted = of(&from.constraints[c]);
                    let all = problem.constraints.iter().enumerate();
                    let found = all.filter(|(_, c)| of(c) == wanted && c.value.is_some());
                    found.map(|(c, _)| head + c).collect()
                }
            }
        };
        match (
            alike(from, self.index).as_slice(),
            alike(to, self.index).as_slice(),
        ) {
            ([_], []) => Ok(None),
            ([_], &[index]) => Ok(Some(Setting {
                index,
                target: self.target.clone(),
            })),
            _ => Err(SettingError::LooksTheSame(from.dimension_name(self.index))),
        }
    }

    /// Gives the dimension of a problem this value.
    ///
    /// # Panics
    /// If the problem has no such dimension.
    pub fn apply(&self, problem: &mut Problem) {
        match (
            self.index.checked_sub(problem.distances.len()),
            &self.target,
        ) {
            (None, target) => {
                let own = &mut problem.distances[self.index].target;
                let target = match (&*own, target) {
                    (Target::Length(own), Target::Length(value)) => {
                        Target::Length(value.clone().with_tolerance(own.tolerance()))
                    }
                    (_, target) => target.clone(),
                };
                *own = target;
            }
            (Some(c), Target::Length(value)) => {
                let own = &mut problem.constraints[c].value;
                let tolerance = own.as_ref().and_then(Decimal::tolerance).cloned();
                *own = Some(value.clone().with_tolerance(tolerance.as_ref()));
            }
            (Some(_), Target::SquaredLength(_)) => {
                unreachable!("only distances are given by their squares")
            }
        }
    }

    /// A problem with dimensions set.
    ///
    /// # Panics
    /// If the problem does not have one of them.
    pub fn applied(settings: &[Self], problem: &Problem) -> Problem {
        let mut changed = problem.clone();
        settings.iter().for_each(|one| one.apply(&mut changed));
        changed
    }

    /// An enclosure of the value.
    pub(super) fn value(&self) -> Interval {
        self.target.enclose()
    }

    /// The dimension, which was `from`, where an edit ended before its target, at t, or at it.
    pub(super) fn at(&self, problem: &Problem, from: Interval, t: Option<Interval>) -> Dimension {
        let to = self.value();
        Dimension {
            index: self.index,
            from,
            to,
            value: t.map_or(to, |t| self.between(problem, t)),
        }
    }

    /// What the dimension is at t on its way from what it is in `problem` to the value: what its kind leads linearly is
    /// the number itself, of an angle the cosine, and of one between a line and a plane the sine; turns go round.
    pub(super) fn between(&self, problem: &Problem, t: Interval) -> Interval {
        let before = Setting::now(problem, self.index);
        let linear = |from: Interval, to: Interval| from + t * (to - from);
        let (Target::Length(from), Target::Length(to)) = (&before.target, &self.target) else {
            return linear(before.value(), self.value());
        };
        let led = |of: fn(Rational) -> Real| {
            let [from, to] = [from, to].each(|x| of(x.value().clone()).enclose());
            linear(from, to)
        };
        match measure_of(problem, self.index) {
            Measure::Degrees => degrees_of_cosine(led(Real::cosine_of_degrees)),
            Measure::Slope => point(90.0) - degrees_of_cosine(led(Real::sine_of_degrees)),
            Measure::Turn => turned(from.value(), to.value(), t),
            _ => linear(before.value(), self.value()),
        }
    }

    /// A setting to what the dimension is at t on its way there, rounded; `None`: that is no number.
    pub(super) fn before(&self, problem: &Problem, t: f64) -> Option<Self> {
        let value = self.between(problem, point(t)).mid();
        Some(Setting::to(self.index, format!("{value:e}").parse().ok()?))
    }

    /// From a text such as `a-b=5.2`: the distance between the points a and b, in either order, shall be
    /// exactly 52/10.
    pub fn parse(problem: &Problem, text: &str) -> Result<Self, SettingError> {
        let (name, value) = Self::split(problem, text)?;
        Self::named(problem, name, value)
    }

    /// The name and the value in a text such as `a-b=5.2`.
    pub fn split<'t>(problem: &Problem, text: &'t str) -> Result<(&'t str, &'t str), SettingError> {
        let form = || SettingError::Form(text.to_owned(), example(problem));
        text.rsplit_once('=').ok_or_else(form)
    }

    /// From the name of a dimension and the text of its new value.
    pub fn named(problem: &Problem, name: &str, value: &str) -> Result<Self, SettingError> {
        let name = name.trim();
        let is_led = is_led_alone(problem, name);
        check_given(problem, name)?;
        if problem.parameters.iter().any(|(other, _)| other == name) && !is_led {
            return Err(SettingError::Parameter(name.to_owned()));
        }
        let index = find(problem, name)?;
        if !is_led && let Some(expression) = number(problem, index).and_then(Decimal::expression) {
            let name = problem.dimension_name(index);
            return Err(SettingError::Computed(name, expression.to_owned()));
        }
        Self::new(problem, index, read(value, || name.to_owned())?)
    }

    /// The index of the dimension of that name: its label, if it has one; `a-b` or `b-a` for a distance; for another
    /// constraint its kind and what it names, as in `angles:a-b-c` or `radii:hole`, or the latter alone if only one
    /// dimension has it.
    pub fn find(problem: &Problem, name: &str) -> Result<usize, SettingError> {
        find(problem, name.trim())
    }

    /// Checks that settings go together.
    pub fn check(problem: &Problem, settings: &[Setting]) -> Result<(), SettingError> {
        if settings.is_empty() {
            return Err(SettingError::None(example(problem)));
        }
        for (k, setting) in settings.iter().enumerate() {
            if settings[..k]
                .iter()
                .any(|other| other.index == setting.index)
            {
                return Err(SettingError::Twice(problem.dimension_name(setting.index)));
            }
            if measure_of(problem, setting.index) == Measure::Turn
                && let (Target::Length(now), Target::Length(then)) =
                    (Setting::now(problem, setting.index).target, &setting.target)
                && (then.value() - now.value()).abs() > Rational::from_integer(MOST_TURN.into())
            {
                let name = problem.dimension_name(setting.index);
                let (now, then) = (now.to_string(), then.to_string());
                return Err(SettingError::TurnsTooFar(name, now, then));
            }
        }
        Ok(())
    }
}

/// Whether a parameter is a dimension and nothing else: it stands in equations, and nothing is computed from it.
fn is_led_alone(problem: &Problem, name: &str) -> bool {
    let has = |value: &Decimal| {
        let expression = value.expression();
        expression.is_some_and(|expression| names(expression).any(|other| other == name))
    };
    let own = problem.labels.iter().find(|(_, label)| *label == name);
    let own = own.map(|(index, _)| *index).filter(|index| {
        let constraint = index.checked_sub(problem.distances.len());
        constraint.is_some_and(|c| problem.constraints[c].kind == "values")
    });
    let mut dimensions = problem.dimensions().filter(|&index| Some(index) != own);
    let mut parameters = problem.parameters.iter();
    own.is_some()
        && !dimensions.any(|index| number(problem, index).is_some_and(has))
        && !parameters.any(|(_, value)| has(value))
}

/// The number that a dimension or parameter is set to, from a text.
pub(super) fn read(text: &str, name: impl FnOnce() -> String) -> Result<Decimal, SettingError> {
    let number = text.parse();
    number.map_err(|error| SettingError::Number {
        name: name(),
        error,
    })
}

/// What a turn is at t on its way: θ and four times the argument of `1 + (e^iΔ/4 − 1) t`, as its equations lead it.
fn turned(from: &Rational, to: &Rational, t: Interval) -> Interval {
    let quarter = (to - from) / Rational::from_integer(4.into());
    let cosine = Real::cosine_of_degrees(quarter.clone()).enclose();
    let sine = Real::sine_of_degrees(quarter).enclose();
    let (x, y) = (point(1.0) + (cosine - point(1.0)) * t, sine * t);
    Real::from(from.clone()).enclose() + point(4.0) * direction(x, y)
}

/// What the number of a dimension is.
pub(crate) fn measure_of(problem: &Problem, index: usize) -> Measure {
    match index.checked_sub(problem.distances.len()) {
        None => Measure::Length,
        Some(c) => constraint::measure_of(problem, c),
    }
}

/// The name of an angle of two lines with the names of lines in place of those of their ends: a line that is named by its ends, in
/// the other order, is that line still.
fn named_by_lines(problem: &Problem, index: usize) -> Option<String> {
    let constraint = &problem.constraints[index - problem.distances.len()];
    if constraint.kind != "angles" {
        return None;
    }
    let (mut names, mut rest) = (Vec::new(), &constraint.items[..]);
    while let Some((&item, after)) = rest.split_first() {
        rest = after;
        let ends = match (item, after.first()) {
            (Item::Point(a), Some(&Item::Point(b))) => [[a, b], [b, a]],
            _ => {
                names.push(problem.item_name(item));
                continue;
            }
        };
        let mut objects = problem.objects.iter();
        let line = objects.find(|o| matches!(o.shape, Shape::Line(of) if ends.contains(&of)))?;
        names.push(&line.name);
        rest = &after[1..];
    }
    Some(format!("{}:{}", constraint.kind, names.join("-")))
}

/// The number of a dimension, as it is given.
pub(super) fn number(problem: &Problem, index: usize) -> Option<&Decimal> {
    match index.checked_sub(problem.distances.len()) {
        None => {
            let (Target::Length(number) | Target::SquaredLength(number)) =
                &problem.distances[index].target;
            Some(number)
        }
        Some(c) => problem.constraints[c].value.as_ref(),
    }
}

/// Whether an index is that of a dimension: of a distance, or of a constraint with a number.
fn has_number(problem: &Problem, index: usize) -> bool {
    let constraint = index.checked_sub(problem.distances.len());
    constraint.is_none_or(|c| problem.constraints[c].value.is_some())
}

fn find(problem: &Problem, name: &str) -> Result<usize, SettingError> {
    // One name of another program may stand for several constraints here, of which one has the number.
    let labelled = problem.labels.iter().filter(|(_, label)| *label == name);
    let labelled = labelled.map(|(&index, _)| index);
    let mut labelled = labelled.filter(|&index| has_number(problem, index));
    if let (Some(index), None) = (labelled.next(), labelled.next()) {
        return Ok(index);
    }
    // Where constraints are named in sentences there is a space behind the kind.
    let plain: Vec<&str> = name.split(':').map(str::trim).collect();
    let plain = plain.join(":");
    let mut found = None;
    for index in problem.dimensions() {
        let is = |a: &str, b: &str| {
            name.strip_prefix(a)
                .and_then(|rest| rest.strip_prefix('-'))
                .is_some_and(|rest| rest == b)
        };
        let is_it = match index.checked_sub(problem.distances.len()) {
            None => {
                let [a, b] = problem.distances[index]
                    .points
                    .each(|p| problem.points[p].name.as_str());
                is(a, b) || is(b, a)
            }
            Some(_) => {
                // Without a kind a name is a distance's, if there is one: distances come first.
                let is_open = found.is_none_or(|index| index >= problem.distances.len());
                let is = |own: &str| {
                    let items = own.split_once(':').filter(|_| is_open);
                    own == plain || items.is_some_and(|(_, items)| items == name)
                };
                is(&problem.derived_name(index))
                    || named_by_lines(problem, index).is_some_and(|own| is(&own))
            }
        };
        if is_it {
            if found.is_some() {
                return Err(SettingError::Ambiguous(name.to_owned()));
            }
            found = Some(index);
        }
    }
    found.ok_or_else(|| {
        const SHOWN: usize = 12;
        let all = problem.distances.len()..problem.distances.len() + problem.constraints.len();
        let mut without = all.filter(|&index| !has_number(problem, index));
        let without = without.find(|index| {
            problem.labels.get(index).is_some_and(|label| label == name)
                || problem.derived_name(*index) == name
        });
        let all: Vec<usize> = problem.dimensions().collect();
        let names = all
            .iter()
            .take(SHOWN)
            .map(|&index| problem.dimension_name(index));
        let mut known = names.collect::<Vec<_>>().join(", ");
        if all.len() > SHOWN {
            known += &format!(" and {} more", all.len() - SHOWN);
        }
        if all.is_empty() {
            known = "none".to_owned();
        }
        let short = name.chars().take(64).collect();
        match without {
            Some(index) => SettingError::NoNumber {
                name: short,
                kind: problem.constraints[index - problem.distances.len()]
                    .kind
                    .clone(),
                known,
            },
            None if problem.kept.constraints.iter().any(|kept| kept == name) => {
                SettingError::Kept(short)
            }
            None => SettingError::Unknown { name: short, known },
        }
    })
}

fn example(problem: &Problem) -> String {
    match problem.dimensions().next() {
        None => "a-b=5.2".to_owned(),
        Some(index) => format!("{}=5.2", problem.dimension_name(index)),
    }
}
