//! Which dimension is to become how long.

use crate::problem::{Decimal, DecimalError, Problem, Target};

/// A dimension and its new value.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The index in [`Problem::distances`].
    pub index: usize,
    /// The new value.
    pub target: Target,
}

/// Why a setting makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingError {
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
    /// More than one has.
    #[error(
        "the name `{0}` may mean more than one dimension: rename the points, without `-` in their names"
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
    /// The same dimension twice.
    #[error("{0} is set twice: leave out one of the two")]
    Twice(String),
    /// None at all.
    #[error("no dimension is set: name one, such as {0}")]
    None(String),
}

impl Setting {
    /// A length for the distance `index`.
    ///
    /// # Panics
    /// If the problem has no such distance.
    pub fn new(problem: &Problem, index: usize, length: Decimal) -> Result<Self, SettingError> {
        let name = problem.distance_name(index);
        if !length.is_positive() {
            return Err(SettingError::NotPositive(name, length.to_string()));
        }
        Ok(Setting {
            index,
            target: Target::Length(length),
        })
    }

    /// From a text such as `a-b=5.2`: the distance between the points a and b, in either order, shall be
    /// exactly 52/10.
    pub fn parse(problem: &Problem, text: &str) -> Result<Self, SettingError> {
        let form = || SettingError::Form(text.to_owned(), example(problem));
        let (name, value) = text.rsplit_once('=').ok_or_else(form)?;
        Self::named(problem, name, value)
    }

    /// From the name of a dimension and the text of its new value.
    pub fn named(problem: &Problem, name: &str, value: &str) -> Result<Self, SettingError> {
        let name = name.trim();
        let index = find(problem, name)?;
        let length = value.parse::<Decimal>();
        let length = length.map_err(|error| SettingError::Number {
            name: name.to_owned(),
            error,
        })?;
        Self::new(problem, index, length)
    }

    /// The index of the distance of that name: `a-b`, or `b-a`.
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
                return Err(SettingError::Twice(problem.distance_name(setting.index)));
            }
        }
        Ok(())
    }
}

fn find(problem: &Problem, name: &str) -> Result<usize, SettingError> {
    let mut found = None;
    for (index, distance) in problem.distances.iter().enumerate() {
        let [a, b] = distance.points.map(|p| problem.points[p].name.as_str());
        let is = |a: &str, b: &str| {
            name.strip_prefix(a)
                .and_then(|rest| rest.strip_prefix('-'))
                .is_some_and(|rest| rest == b)
        };
        if is(a, b) || is(b, a) {
            if found.is_some() {
                return Err(SettingError::Ambiguous(name.to_owned()));
            }
            found = Some(index);
        }
    }
    found.ok_or_else(|| {
        const SHOWN: usize = 12;
        let count = problem.distances.len();
        let names = (0..count.min(SHOWN)).map(|index| problem.distance_name(index));
        let mut known = names.collect::<Vec<_>>().join(", ");
        if count > SHOWN {
            known += &format!(" and {} more", count - SHOWN);
        }
        SettingError::Unknown {
            name: name.chars().take(64).collect(),
            known,
        }
    })
}

fn example(problem: &Problem) -> String {
    match problem.distances.is_empty() {
        true => "a-b=5.2".to_owned(),
        false => format!("{}=5.2", problem.distance_name(0)),
    }
}
