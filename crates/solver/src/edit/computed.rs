//! What a file computes by expressions of parameters.

use super::setting::{Setting, SettingError, number};
use crate::order::add_new;
use crate::problem::expression::names;
use crate::problem::{Decimal, Problem};

/// The expression that a file computes a parameter by, if it is no number there.
fn of_parameter<'p>(problem: &'p Problem, name: &str) -> Option<&'p str> {
    let mut parameters = problem.parameters.iter();
    let (_, value) = parameters.find(|(other, _)| other == name)?;
    value.expression()
}

/// Refuses to set a parameter that a file computes.
pub(super) fn check_given(problem: &Problem, name: &str) -> Result<(), SettingError> {
    match of_parameter(problem, name) {
        Some(expression) => Err(SettingError::Computed(name.into(), expression.into())),
        None => Ok(()),
    }
}

/// The parameters that a dimension's number comes from, those in the expressions of others among them.
pub(super) fn sources(problem: &Problem, index: usize) -> Vec<&str> {
    let expression = number(problem, index).and_then(Decimal::expression);
    let mut found: Vec<&str> = expression.map_or(Vec::new(), |text| names(text).collect());
    let mut next = 0;
    while let Some(name) = found.get(next) {
        for name in of_parameter(problem, name).into_iter().flat_map(names) {
            add_new(&mut found, name);
        }
        next += 1;
    }
    found
}

/// What stands still although the file ties it to dimensions, by index, that are led by themselves: what it computes from the same parameters,
/// and those of these that stand in equations. Each with what it is held at, in words.
pub fn held_though_computed(problem: &Problem, led: &[usize]) -> Vec<String> {
    if problem.parameters.is_empty() {
        return Vec::new();
    }
    let moving = led.iter().flat_map(|&index| sources(problem, index));
    let moving: Vec<&str> = moving.collect();
    let others = problem.dimensions().filter(|index| !led.contains(index));
    let tied = others.filter_map(|index| {
        let own = sources(problem, index);
        let common = own.iter().find(|name| moving.contains(name))?;
        let (name, at) = (problem.dimension_name(index), Setting::now(problem, index));
        let expression = match number(problem, index)?.expression()? {
            parameter if parameter == name => of_parameter(problem, parameter),
            other => Some(other),
        };
        let why = match expression {
            Some(expression) => format!("which the file computes by `{expression}`"),
            None => {
                let mut led = led.iter();
                let from = led.find(|&&index| sources(problem, index).contains(common))?;
                format!(
                    "from which the file computes {}",
                    problem.dimension_name(*from)
                )
            }
        };
        Some(format!("{name} held at {} ({why})", at.target.to_f64()))
    });
    tied.collect()
}
