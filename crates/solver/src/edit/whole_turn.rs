//! Angles in the plane that are set beyond 0 or 180 degrees: followed as turns.

use super::computed::{check_given, sources};
use super::setting::{Setting, SettingError, measure_of, number, read};
use super::write::direction;
use crate::constraint::{Arguments, LineName, Measure, is_opposite_nearer, order_of_kind};
use crate::interval::Real;
use crate::order::InOrder;
use crate::places::Each as _;
use crate::problem::expression::{evaluate, with_set};
use crate::problem::{Constraint, Decimal, Item, Problem, Target};
use crate::rational::Rational;
use crate::statement::nearest;
use std::collections::{HashMap, HashSet};

/// What was asked for.
#[derive(Debug, Clone)]
pub struct Asked {
    /// The problem, in which angles that are set beyond 0 or 180 degrees are turns.
    pub problem: Problem,
    /// The settings, of that problem.
    pub settings: Vec<Setting>,
    /// The same settings of the problem that was given.
    pub given: Vec<Setting>,
    /// The parameters as they are then.
    pub parameters: Vec<(String, Decimal)>,
}

/// Dimensions by index, each with a new value.
type Numbers = Vec<(usize, Decimal)>;
/// The parameters of a problem.
type Parameters = Vec<(String, Decimal)>;

/// What of a file follows from parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Follow {
    /// Dimensions that are others then, or else all that are computed.
    Changed,
    /// All that is computed from what is set, whatever it is then; first what is set, if it is a dimension.
    Tied,
}

/// The dimensions that are computed, by index, and what they are where these of the parameters are `set`.
fn following(
    problem: &Problem,
    (parameters, set): (&Parameters, &Parameters),
    follow: Follow,
) -> Result<Numbers, SettingError> {
    let mut out = Vec::new();
    let is_set = |name: &str| set.iter().any(|(other, _)| other == name);
    for index in problem.dimensions() {
        let is_tied = || sources(problem, index).into_iter().any(is_set);
        if follow == Follow::Tied && !is_tied() {
            continue;
        }
        let Some(now) = number(problem, index) else {
            continue;
        };
        let Some(expression) = now.expression() else {
            continue;
        };
        let value = evaluate(expression, parameters);
        let name = || problem.dimension_name(index);
        let value = value.map_err(|why| SettingError::Expression(name(), why))?;
        let target = problem.distances.get(index).map(|d| &d.target);
        if matches!(target, Some(Target::SquaredLength(_))) {
            if value == *now && !is_tied() {
                continue;
            }
            let why =
                "a squared length that is computed cannot be edited: give the length".to_owned();
            return Err(SettingError::Expression(name(), why));
        }
        out.push((index, value));
    }
    let is_other = |(index, value): &(usize, Decimal)| number(problem, *index) != Some(value);
    match follow {
        Follow::Changed if out.iter().any(is_other) => out.retain(is_other),
        Follow::Changed => {}
        Follow::Tied => {
            let label = |index: &usize| problem.labels.get(index);
            out.order_by_key(|(index, _)| !label(index).is_some_and(|name| is_set(name)));
        }
    }
    Ok(out)
}

impl Asked {
    /// Settings of a problem, each the name of a dimension or of a parameter and its new value. What is computed from parameters follows. An
    /// angle in the plane may be set to any number of degrees: 250 and −110 are the same place, and the way there goes up or down. It is counted in the sense in which it is drawn.
    ///
    /// # Errors
    /// As [`Setting::named`].
    pub fn new(problem: &Problem, named: &[(&str, &str)]) -> Result<Self, SettingError> {
        let (given, parameters) = Self::of(problem, named, (Follow::Changed, &mut HashMap::new()))?;
        Self::led(problem, parameters, given)
    }

    /// What settings lead, and the parameters then. `indices`: of dimensions that were found by their names.
    fn of<'n>(
        problem: &Problem,
        named: &[(&'n str, &str)],
        (follow, indices): (Follow, &mut HashMap<&'n str, usize>),
    ) -> Result<(Numbers, Parameters), SettingError> {
        let mut given = Vec::with_capacity(named.len());
        let mut set = Parameters::new();
        for &(name, value) in named {
            if problem.parameters.iter().any(|(other, _)| other == name) {
                check_given(problem, name)?;
                let value = read(value, || name.to_owned())?;
                if set.iter().any(|(other, _)| other == name) {
                    return Err(SettingError::Twice(name.to_owned()));
                }
                set.push((name.to_owned(), value));
                continue;
            }
            let index = match indices.get(name) {
                Some(&index) => index,
                None => Setting::find(problem, name).map_err(|error| {
                    let mut known = problem.parameters.iter().map(|(name, _)| name.as_str());
                    match nearest(name, &mut known) {
                        Some(near) => SettingError::NearParameter(name.to_owned(), near),
                        None => error,
                    }
                })?,
            };
            indices.insert(name, index);
            let value = read(value, || problem.dimension_name(index))?;
            if let Some(expression) = number(problem, index).and_then(Decimal::expression) {
                let name = problem.dimension_name(index);
                return Err(SettingError::Computed(name, expression.to_owned()));
            }
            given.push((index, value));
        }
        let parameters = with_set(&problem.parameters, &set)
            .map_err(|(name, why)| SettingError::Expression(name, why))?;
        if !set.is_empty() {
            let followed = following(problem, (&parameters, &set), follow)?;
            if followed.is_empty() {
                return Err(SettingError::Unused(set.swap_remove(0).0));
            }
            given.extend(followed);
        }
        Ok((given, parameters))
    }

    /// Dimensions by index, each with its new value, and the parameters as they are then.
    ///
    /// # Errors
    /// As [`Setting::new`].
    pub fn led(
        problem: &Problem,
        parameters: Vec<(String, Decimal)>,
        given: Vec<(usize, Decimal)>,
    ) -> Result<Self, SettingError> {
        let beyond = given.iter().filter(|(_, value)| is_beyond(value));
        let beyond: HashSet<usize> = beyond.map(|(index, _)| *index).collect();
        let head = problem.distances.len();
        let (problem, places) = with_turns(problem, |c, _| beyond.contains(&(head + c)));
        let mut asked = Asked {
            problem,
            settings: Vec::new(),
            given: Vec::new(),
            parameters,
        };
        for (index, value) in given {
            let now = index.checked_sub(head).map_or(index, |c| head + places[c]);
            let setting = Setting::new(&asked.problem, now, value)?;
            let target = setting.target.clone();
            asked.given.push(Setting { index, target });
            asked.settings.push(setting);
        }
        Ok(asked)
    }

    /// The dimensions that are set, by index, with their new values.
    pub fn numbers(&self) -> impl Iterator<Item = (usize, Decimal)> {
        self.given.iter().map(|setting| match &setting.target {
            Target::Length(value) | Target::SquaredLength(value) => (setting.index, value.clone()),
        })
    }

    /// Rows of settings, each of `columns` names, as [`Asked::new`]: all rows lead the same dimensions in the same order, those named and all
    /// that are computed from what is. The parameters are those of the last row.
    ///
    /// # Errors
    /// As there.
    pub fn rows(
        problem: &Problem,
        named: &[(&str, &str)],
        columns: usize,
    ) -> Result<Self, SettingError> {
        let (mut given, mut parameters) = (Numbers::new(), problem.parameters.clone());
        let mut indices = HashMap::new();
        for row in named.chunks(columns) {
            let (numbers, now) = Self::of(problem, row, (Follow::Tied, &mut indices))?;
            given.extend(numbers);
            parameters = now;
        }
        Self::led(problem, parameters, given)
    }

    /// The first `count` settings with other values: of the dimension or parameter `name` this one, of the others what is computed then.
    ///
    /// # Errors
    /// As [`Asked::new`].
    pub fn with(
        &self,
        count: usize,
        (name, value): (&str, &Decimal),
    ) -> Result<Vec<Setting>, SettingError> {
        let problem = &self.problem;
        let parameters = with_set(&problem.parameters, &[(name.to_owned(), value.clone())]);
        let parameters = parameters.map_err(|(name, why)| SettingError::Expression(name, why))?;
        let settings = self.settings[..count].iter().map(|setting| {
            let index = setting.index;
            let expression = number(problem, index).and_then(Decimal::expression);
            let value = expression.map_or(Ok(value.clone()), |text| evaluate(text, &parameters));
            let name = || problem.dimension_name(index);
            let value = value.map_err(|why| SettingError::Expression(name(), why))?;
            Setting::new(problem, index, value)
        });
        settings.collect()
    }

    /// The first angle that is set to 0 or 180 degrees and whole turns, or is computed and goes beyond these, by index in `given`: the problem.
    pub fn straight(&self, given: &Problem) -> Option<usize> {
        let straight = Rational::from_integer(180.into());
        let is_so = |setting: &&Setting| {
            let c = setting.index.checked_sub(given.distances.len());
            let is_angle = c.is_some_and(|c| given.constraints[c].kind == "angles");
            match &setting.target {
                Target::Length(degrees) if is_angle => {
                    let turns = degrees.value() / &straight;
                    // What is computed is not written as another angle.
                    let is_beyond = turns.is_negative() || turns > Rational::from_integer(1.into());
                    turns.is_integer() || degrees.expression().is_some() && is_beyond
                }
                _ => false,
            }
        };
        self.given.iter().find(is_so).map(|setting| setting.index)
    }

    /// Which angles are turns, a line each; `given`: the problem.
    pub fn in_words(&self, given: &Problem) -> String {
        let pairs = self.given.iter().zip(&self.settings);
        let names = pairs.map(|(was, is)| {
            [
                given.derived_name(was.index),
                self.problem.derived_name(is.index),
            ]
        });
        let mut lines: Vec<String> = names
            .filter(|[was, is]| was != is)
            .map(|[was, is]| {
                format!("{was} is led beyond 0 or 180 degrees, and so as {is}: how far the leg or line named first is turned, counter-clockwise, to point as the other\n")
            })
            .collect();
        lines.dedup();
        lines.concat()
    }
}

/// A problem with those of its angles as turns that are turns in another one: what edits of it have led beyond 0 or 180 degrees, see [`Asked`].
pub fn with_turns_of(problem: &Problem, other: &Problem) -> Problem {
    with_turns(problem, |_, turn| other.constraints.contains(turn)).0
}

/// A problem with those of its angles as turns that are `wanted`, by the index of the constraint and the turn that it would be; and where each
/// constraint is then, as they are in the order of their kinds.
fn with_turns(
    problem: &Problem,
    wanted: impl Fn(usize, &Constraint) -> bool,
) -> (Problem, Vec<usize>) {
    let head = problem.distances.len();
    let turned = |(c, constraint): (usize, &Constraint)| {
        let turn = as_turn(problem, head + c).filter(|turn| wanted(c, turn));
        (c, turn.unwrap_or_else(|| constraint.clone()))
    };
    let mut all: Vec<(usize, Constraint)> =
        problem.constraints.iter().enumerate().map(turned).collect();
    all.order_by_key(|(_, c)| order_of_kind(&c.kind));
    let mut places = vec![0; all.len()];
    for (now, &(was, _)) in all.iter().enumerate() {
        places[was] = now;
    }
    let mut out = problem.clone();
    out.constraints = all.into_iter().map(|(_, c)| c).collect();
    let labels = problem.labels.iter().map(|(&index, label)| {
        let now = index.checked_sub(head).map_or(index, |c| head + places[c]);
        (now, label.clone())
    });
    out.labels = labels.collect();
    (out, places)
}

fn is_beyond(degrees: &Decimal) -> bool {
    let straight = Rational::from_integer(180.into());
    !degrees.is_positive() || *degrees.value() >= straight
}

/// An angle as a turn, in the sense in which it is drawn. `None`: it is none of two legs or lines in the plane that have a
/// sense in the drawing.
fn as_turn(problem: &Problem, index: usize) -> Option<Constraint> {
    let angle = &problem.constraints[index.checked_sub(problem.distances.len())?];
    let is_angle = angle.kind == "angles" && measure_of(problem, index) == Measure::Degrees;
    if problem.dimension != 2 || !is_angle {
        return None;
    }
    Some(Constraint {
        kind: "turns".to_owned(),
        items: directed(problem, &angle.items, angle.value.as_ref()?)?,
        value: angle.value.clone(),
        formula: None,
    })
}

/// What an angle names, so that the turn from the first to the second is that angle in the drawing.
fn directed(problem: &Problem, items: &[Item], degrees: &Decimal) -> Option<Vec<Item>> {
    let between = |[a, b]: [usize; 2]| direction(problem, LineName::Points([a, b]));
    let cross = |u: &[Rational; 3], v: &[Rational; 3]| &u[0] * &v[1] - &u[1] * &v[0];
    let mut arguments = Arguments::new(problem, items);
    if let [Item::Point(a), at @ Item::Point(b), Item::Point(c)] = *items {
        let sense = cross(&between([b, a])?, &between([b, c])?);
        return match (sense.is_positive(), sense.is_negative()) {
            (true, _) => Some(items.to_vec()),
            (_, true) => Some(vec![Item::Point(c), at, Item::Point(a)]),
            _ => None,
        };
    }
    let lines = [arguments.line().ok()?, arguments.line().ok()?];
    let [mut u, mut v] = [direction(problem, lines[0])?, direction(problem, lines[1])?];
    let mut named = lines.map(|line| match line {
        LineName::Points(ends) => ends.each(Item::Point).to_vec(),
        LineName::Axis(axis) => vec![Item::Axis(axis)],
        LineName::Free(line) => vec![Item::Object(line)],
    });
    let cosine = &u[0] * &v[0] + &u[1] * &v[1];
    if is_opposite_nearer(&cosine, &Real::cosine_of_degrees(degrees.value().clone())) {
        // The one through points is named the other way round.
        let which = lines
            .iter()
            .position(|line| matches!(line, LineName::Points(_)))?;
        named[which].reverse();
        let reversed = if which == 0 { &mut u } else { &mut v };
        *reversed = reversed.each_ref().map(|x| -x);
    }
    let sense = cross(&u, &v);
    let [first, second] = named;
    match (sense.is_positive(), sense.is_negative()) {
        (true, _) => Some([first, second].concat()),
        (_, true) => Some([second, first].concat()),
        _ => None,
    }
}
