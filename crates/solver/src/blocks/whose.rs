//! Whose an equation is.

use crate::problem::{Decimal, Problem, Target};

/// Whose an equation of a problem is, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Whose {
    /// It says what an object is.
    Object(usize),
    /// A constraint says it.
    Constraint(usize),
    /// It pins the figure where it is; nothing in the problem says so.
    Pin,
    /// A distance says it.
    Distance(usize),
}

impl Whose {
    /// Of an owner as equations name it, a count of objects, constraints, pins (as one), and distances.
    pub fn of(problem: &Problem, owner: usize) -> Self {
        let constraints = problem.constraints.len();
        match owner.checked_sub(problem.objects.len()) {
            None => Whose::Object(owner),
            Some(c) if c < constraints => Whose::Constraint(c),
            Some(c) if c == constraints => Whose::Pin,
            Some(c) => Whose::Distance(c - constraints - 1),
        }
    }

    /// Which of the problem's distances and constraints says it, counted in this order.
    pub fn index(self, problem: &Problem) -> Option<usize> {
        match self {
            Whose::Distance(e) => Some(e),
            Whose::Constraint(c) => Some(problem.distances.len() + c),
            Whose::Object(_) | Whose::Pin => None,
        }
    }

    /// The number that it says something about, if any, and whether it is the square of a length.
    pub fn number(self, problem: &Problem) -> Option<(&Decimal, bool)> {
        match self {
            Whose::Distance(e) => Some(match &problem.distances[e].target {
                Target::Length(length) => (length, false),
                Target::SquaredLength(squared) => (squared, true),
            }),
            Whose::Constraint(c) => Some((problem.constraints[c].value.as_ref()?, false)),
            Whose::Object(_) | Whose::Pin => None,
        }
    }

    /// What people call whoever says it.
    pub fn name(self, problem: &Problem) -> String {
        match self {
            Whose::Object(o) => format!("`{}`", problem.objects[o].name),
            Whose::Constraint(c) => {
                let name = problem.constraint_name(c);
                match problem.labels.get(&(problem.distances.len() + c)) {
                    Some(label) => format!("`{label}` ({name})"),
                    None => format!("`{name}`"),
                }
            }
            Whose::Pin => "a pin".to_owned(),
            Whose::Distance(e) => format!("`{}`", problem.dimension_name(e)),
        }
    }

    /// Whether it is rather used than left out where not all equations are needed: the less the rather. What is fixed is left
    /// out last, dimensions after what has no number.
    pub fn keep(self, problem: &Problem) -> u8 {
        match self {
            Whose::Object(_) => 1,
            Whose::Constraint(c) if problem.constraints[c].kind == "fixed" => 0,
            Whose::Constraint(c) if problem.constraints[c].value.is_none() => 3,
            _ => 2,
        }
    }
}
