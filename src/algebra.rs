//! Systems of equations of one's own, and all their solutions.
//!
//! ```
//! use krawl::algebra::System;
//!
//! let system = System::parse("x^2 + y^2 = 4\nx*y = 1")?;
//! let real = system.real()?;
//! assert!(real.is_complete && real.solutions.len() == 4);
//! for solution in &real.solutions {
//!     for (name, x) in solution {
//!         println!("{name} is between {} and {}", x.inf(), x.sup());
//!     }
//! }
//! # Ok::<(), String>(())
//! ```

use crate::complete::{self, Options, has_equations_to_spare};
use crate::complex::{self, Filling, Template, Ways};
use crate::import::polynomials;
use crate::interval::Interval;
use crate::problem::{Decimal, DecimalError, Numeral, Problem, names_in};
use crate::report::{complete_in_words, complex_in_words, named_numbers};

/// Equations with their unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    problem: Problem,
}

/// Solutions of a system.
#[derive(Debug, Clone, PartialEq)]
pub struct Solutions<V> {
    /// Whether it is proved that there is no other (of complex solutions: no other isolated one).
    pub is_complete: bool,
    /// What is proved, in words.
    pub verdict: String,
    /// For each solution the unknowns by name, in boxes that hold exactly one each.
    pub solutions: Vec<Vec<(String, V)>>,
}

/// The parts of a system; [`Builder::finish`] checks them together.
#[derive(Debug, Clone, Default)]
pub struct Builder {
    equations: Vec<String>,
    unknowns: Vec<(String, Number)>,
    ranges: Vec<(String, [Option<Number>; 2])>,
    parameters: Vec<(String, Number)>,
}

type Number = Result<Decimal, DecimalError>;

fn number<N: Numeral>(value: N) -> Number {
    value.try_into().map_err(Into::into)
}

impl System {
    /// Reads a problem file (docs/using/algebra.md), a system of PHCpack, msolve, Macaulay2 or HomotopyContinuation.jl, or else equations by themselves: one a
    /// line or with `;` between, behind `#` a comment. What has no `=` in it is to be zero, and all names are unknowns.
    ///
    /// # Errors
    /// In words, what is wrong with it, and where.
    pub fn parse(text: &str) -> Result<System, String> {
        let in_file = match polynomials::problem_file(text) {
            Some(file) => Some(file?),
            None => text.contains("equations").then(|| text.to_owned()),
        };
        if let Some(file) = in_file {
            let problem = Problem::parse(&file, "system").map_err(|error| error.to_string())?;
            return Ok(System { problem });
        }
        let lines = text.lines().flat_map(|line| {
            let line = line.split('#').next().unwrap_or_default();
            line.split(';')
        });
        let equations = lines.map(str::trim).filter(|line| !line.is_empty());
        let add = |builder: Builder, equation| builder.equation(equation);
        equations.fold(System::build(), add).finish()
    }

    /// Begins a system that is put together in code.
    ///
    /// ```
    /// use krawl::algebra::System;
    ///
    /// let system = System::build()
    ///     .equation("x^2 + y^2 = a")
    ///     .equation("x*y = 1")
    ///     .parameter("a", "2.5")
    ///     .within("x", Some(0), None::<i32>)
    ///     .finish()?;
    /// let real = system.real()?;
    /// assert!(real.verdict.starts_with("Complete, proved: 2 solutions with x at least 0, and there is no other."));
    /// # Ok::<(), String>(())
    /// ```
    pub fn build() -> Builder {
        Builder::default()
    }

    /// The same as a problem, for all that is not done here: paths, edits, limits, certificates.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// All real solutions.
    ///
    /// # Errors
    /// In words, why it is not served.
    pub fn real(&self) -> Result<Solutions<Interval>, String> {
        self.real_with(&Options::default())
    }

    /// The same with a time limit, threads or progress of one's own.
    ///
    /// # Errors
    /// In words, why it is not served.
    pub fn real_with(&self, options: &Options) -> Result<Solutions<Interval>, String> {
        let found = complete::all(&self.problem, options).map_err(|why| why.to_string())?;
        let solutions = found.solutions.iter().map(|solution| {
            let objects = self.problem.objects.iter().zip(&solution.objects);
            let named = objects.filter_map(|(o, at)| Some((o.name.clone(), at.number()?)));
            named.collect()
        });
        let is_decided = found
            .tested
            .as_ref()
            .is_none_or(complete::Tested::is_decided);
        Ok(Solutions {
            is_complete: found.status == complete::Status::Complete && is_decided,
            verdict: complete_in_words(&self.problem, &found),
            solutions: solutions.collect(),
        })
    }

    /// All complex solutions, of each unknown the real and the imaginary part; those that are real have 0 for the latter.
    ///
    /// # Errors
    /// In words, why it is not served.
    pub fn complex(&self) -> Result<Solutions<[Interval; 2]>, String> {
        let lowered = complex::lower(&self.problem).map_err(|why| why.to_string())?;
        let filling = Filling {
            enough: lowered.enough(),
            ways: Ways {
                proved: false,
                ..Ways::default()
            },
            ..Filling::default()
        };
        let fibre = complex::fill(&lowered.system, &filling)?;
        let template = Template::new(&self.problem.name, fibre);
        let found = complex::solve(&lowered, &template, &filling.ways);
        let solutions = found.boxes.boxes().iter().zip(&found.natures);
        let solutions =
            solutions.map(|(one, &nature)| named_numbers((&self.problem, &lowered), one, nature));
        Ok(Solutions {
            is_complete: found.status == complex::Status::Complete,
            verdict: complex_in_words(&lowered, &found),
            solutions: solutions.collect(),
        })
    }
}

impl Builder {
    /// Adds an equation, `x^2 + y^2 = a`; what has no `=` in it is to be zero. Names of no parameter are unknowns.
    pub fn equation(mut self, text: &str) -> Self {
        self.equations.push(text.to_owned());
        self
    }

    /// Says where a path begins, which is of no account for all solutions.
    pub fn unknown<N: Numeral>(mut self, name: &str, start: N) -> Self {
        self.unknowns.push((name.to_owned(), number(start)));
        self
    }

    /// Has the real solutions sought in which an unknown is between two numbers, either of which may be left out.
    pub fn within<N: Numeral, M: Numeral>(
        mut self,
        name: &str,
        low: Option<N>,
        high: Option<M>,
    ) -> Self {
        let ends = [low.map(number), high.map(number)];
        self.ranges.push((name.to_owned(), ends));
        self
    }

    /// Gives a name in the equations its value.
    pub fn parameter<N: Numeral>(mut self, name: &str, value: N) -> Self {
        self.parameters.push((name.to_owned(), number(value)));
        self
    }

    /// Checks everything and makes the system.
    ///
    /// # Errors
    /// In words, what is wrong with it, and where.
    pub fn finish(self) -> Result<System, String> {
        let wrong = |name: &str| {
            let name = name.to_owned();
            move |error: DecimalError| format!("{name}: {error}")
        };
        let mut builder = Problem::build("system", 2);
        let mut named: Vec<&str> = Vec::new();
        for (name, start) in self.unknowns.iter().chain(&self.parameters) {
            builder = builder.unknown(name, start.clone().map_err(wrong(name))?);
            named.push(name);
        }
        for name in self.equations.iter().flat_map(|text| names_in(text)) {
            if name != "sqrt" && !named.contains(&name) {
                builder = builder.unknown(name, polynomials::start(named.len()));
                named.push(name);
            }
        }
        for (name, value) in &self.parameters {
            builder = builder.dimension("values", [name], value.clone().map_err(wrong(name))?);
        }
        for equation in &self.equations {
            builder = builder.equation(equation);
        }
        let mut problem = match builder.clone().finish() {
            Ok(problem) => problem,
            Err(fault) => {
                let loose = builder
                    .loose()
                    .finish()
                    .map_err(|error| error.to_string())?;
                // More equations than unknowns: solutions are tested on those left out.
                let is_served = has_equations_to_spare(&loose);
                is_served
                    .then_some(loose)
                    .ok_or_else(|| fault.to_string())?
            }
        };
        for (name, ends) in self.ranges {
            let [low, high] = ends.map(|end| end.transpose().map_err(wrong(&name)));
            problem.restrict(&name, [low?, high?])?;
        }
        Ok(System { problem })
    }
}
