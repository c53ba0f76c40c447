//! The filled generic instance of a graph, to be used for all its instances.

use super::boxes::{Found, SolutionSet};
use super::exact::{Exact, Parameter};
use super::follow::{Ways, prove_all};
use super::monodromy::Fibre;
use super::system::{System, segment};
use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::Zero;
use serde::{Deserialize, Serialize};

/// What [`Template::read`] takes and [`Template::write`] makes.
pub const VERSION: u32 = 1;

/// Solutions are rounded by at most this part of the distance within which they are alone: Newton's method has the rest
/// again, and who reads a template proves it.
const ROUNDED: f64 = 1e-4;
/// Digits behind the point of which floats of the size of a solution have no more.
const MOST_DIGITS: i32 = 15;
/// No parameter takes more characters.
const LONGEST: usize = 1000;
/// No parameter or coordinate, in typical lengths, is larger: far from overflow.
const LARGEST: i64 = 1_000_000_000_000;

/// The file: JSON.
#[derive(Serialize, Deserialize)]
struct File {
    #[serde(rename = "krawl-template")]
    version: u32,
    problem: String,
    structure: String,
    ways: usize,
    idle: usize,
    parameters: Vec<[String; 2]>,
    /// Points near solutions, one of each orbit: real and imaginary part of every unknown in turn.
    solutions: Vec<Vec<f64>>,
}

/// A generic instance with its solutions, one of each orbit under the group of the system.
#[derive(Debug, Clone)]
pub struct Template {
    /// The name of the problem that it was made from.
    pub problem: String,
    /// Parameters of all equations.
    pub parameters: Vec<Parameter>,
    /// The solutions, proved.
    pub solutions: SolutionSet,
    /// Ways that were followed to find them.
    pub ways: usize,
    /// Ways since the last new one was found.
    pub idle: usize,
}

/// Why a file is no template for a problem.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum TemplateError {
    /// It is no template at all.
    #[error("this is not a template that this version reads: {0}")]
    Format(String),
    /// It belongs to other equations.
    #[error(
        "the template was made from `{0}`, whose equations are others: make one with `krawl template FILE --out T.krawl-template`"
    )]
    Other(String),
    /// A claim in it could not be proved.
    #[error("solution {index} of the template: {reason}")]
    Unproved {
        /// Which, counted from 1.
        index: usize,
        /// Why.
        reason: String,
    },
}

crate::debug_in_words!(TemplateError);

/// The digest of the equations that the text of a template was made for; `None` if it is no such text.
pub(super) fn structure_of(text: &str) -> Option<String> {
    Some(serde_json::from_str::<File>(text).ok()?.structure)
}

impl Template {
    /// From a fibre.
    pub fn new(problem: &str, fibre: Fibre) -> Self {
        Template {
            problem: problem.to_owned(),
            parameters: fibre.parameters,
            solutions: fibre.solutions,
            ways: fibre.ways,
            idle: fibre.idle,
        }
    }

    /// The text of the file.
    ///
    /// # Panics
    /// If a parameter is no ratio, which those of a fibre are.
    pub fn write(&self, system: &System) -> String {
        let text = |x: &crate::interval::Real| x.as_rational().expect("a ratio").to_string();
        let near = |solution: &super::boxes::SolutionBox| {
            let digits = -(ROUNDED * solution.alone_within).log10().floor();
            let whole = (digits < f64::from(MOST_DIGITS)).then(|| 10f64.powi(digits as i32));
            let middles = solution.figure.centre.iter();
            let rounded = |&x: &f64| whole.map_or(x, |whole| (x * whole).round() / whole);
            middles.map(rounded).collect()
        };
        let file = File {
            version: VERSION,
            problem: self.problem.clone(),
            structure: system.structure(),
            ways: self.ways,
            idle: self.idle,
            parameters: self
                .parameters
                .iter()
                .map(|p| [text(&p[0]), text(&p[1])])
                .collect(),
            solutions: self.solutions.boxes().iter().map(near).collect(),
        };
        serde_json::to_string(&file).expect("text") + "\n"
    }

    /// Reads a file, and proves again what it claims: that there is exactly one solution near each of its points, and
    /// that all are different, up to the group.
    pub fn read(text: &str, system: &System) -> Result<Self, TemplateError> {
        let file: File =
            serde_json::from_str(text).map_err(|e| TemplateError::Format(e.to_string()))?;
        if file.version != VERSION {
            let what = format!("it has version {}, not {VERSION}", file.version);
            return Err(TemplateError::Format(what));
        }
        if file.structure != system.structure() {
            return Err(TemplateError::Other(file.problem));
        }
        let n = system.unknowns.len();
        let is_whole = file.parameters.len() == n
            && file
                .solutions
                .iter()
                .all(|s| s.len() == 2 * n && s.iter().all(|x| x.abs() <= LARGEST as f64));
        if !is_whole {
            let what = format!("parameters and solutions of {n} unknowns are wanted");
            return Err(TemplateError::Format(what));
        }
        let number = |text: &String| -> Result<Rational, TemplateError> {
            let bad = || TemplateError::Format(format!("`{text}` is no ratio of moderate size"));
            let (above, below) = text.split_once('/').unwrap_or((text, "1"));
            let whole = |digits: &str| digits.parse::<BigInt>().map_err(|_| bad());
            if text.len() > LONGEST || whole(below)?.is_zero() {
                return Err(bad());
            }
            let number = Rational::new(whole(above)?, whole(below)?);
            let is_moderate = number.abs() <= Rational::from_integer(LARGEST.into());
            is_moderate.then_some(number).ok_or_else(bad)
        };
        let mut parameters = Vec::with_capacity(n);
        for (equation, [re, im]) in system.equations.iter().zip(&file.parameters) {
            let value = Exact {
                re: number(re)?,
                im: number(im)?,
            };
            if let super::system::Kind::Fixed(fixed) = &equation.right
                && *fixed != value
            {
                let what = format!("the equation {} has another right-hand side", equation.name);
                return Err(TemplateError::Format(what));
            }
            parameters.push(value.parts());
        }
        let rights = segment(&parameters, &parameters, None);
        let mut solutions = SolutionSet::default();
        let exactly = |point: &Vec<f64>| point.iter().map(|&x| x.into()).collect();
        let points: Vec<_> = file.solutions.iter().map(exactly).collect();
        let proved = prove_all(system, &rights, &points, &Ways::default());
        for (k, proved) in proved.into_iter().enumerate() {
            let fail = |reason: String| TemplateError::Unproved {
                index: k + 1,
                reason,
            };
            let one = proved.map_err(fail)?;
            match solutions.find(&one, &system.group, false) {
                Found::New => solutions.push(one),
                Found::Old(other) => {
                    return Err(fail(format!("it is solution {} again", other + 1)));
                }
                Found::Unknown => {
                    return Err(fail("it cannot be told from another one".to_owned()));
                }
            };
        }
        Ok(Template {
            problem: file.problem,
            parameters,
            solutions,
            ways: file.ways,
            idle: file.idle,
        })
    }
}
