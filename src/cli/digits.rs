//! Solutions to many digits, where these are asked for.

use krawl::complex::{Lowered, Nature, Solutions};
use krawl::digits::{Digits, MOST_DIGITS, complex_to_digits, to_digits};
use krawl::problem::Problem;
use krawl::report::document::ManyDigits as Told;
use krawl::track::Solution;

/// How many digits are wanted.
#[derive(clap::Args)]
pub(super) struct ManyDigits {
    /// Tell points, unknowns and radii to so many digits, up to 60, with proof
    ///
    /// Of figures that are told by points, circles, spheres and unknowns; coordinates have as many digits behind the
    /// point as the largest one
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_DIGITS as i64), hide_short_help = true)]
    digits: Option<u32>,
}

impl ManyDigits {
    /// Solutions for JSON, where they are asked for.
    pub fn told(&self, problem: &Problem, all: &[Result<Digits, String>]) -> Option<Vec<Told>> {
        self.is_wanted().then(|| Told::all(problem, all))
    }

    /// Whether they are asked for.
    pub fn is_wanted(&self) -> bool {
        self.digits.is_some()
    }

    /// Complex solutions, each to so many digits or why it is not; none where that is not asked for.
    pub fn of_complex(
        &self,
        problem: (&Problem, &Lowered),
        found: &Solutions,
    ) -> Vec<Result<Digits, String>> {
        let Some(digits) = self.digits else {
            return Vec::new();
        };
        let all = found.boxes.boxes().iter().zip(&found.natures);
        all.map(|(one, nature)| complex_to_digits(problem, one, *nature == Nature::Real, digits))
            .collect()
    }

    /// Solutions whose points are seen from `reference`, each to so many digits or why it is not; none where that is not
    /// asked for.
    pub fn of<'s>(
        &self,
        problem: &Problem,
        reference: &[usize],
        solutions: impl IntoIterator<Item = &'s Solution>,
    ) -> Vec<Result<Digits, String>> {
        let Some(digits) = self.digits else {
            return Vec::new();
        };
        let mut seen = problem.clone();
        seen.homotopy.reference = reference.to_vec();
        let all = solutions.into_iter();
        all.map(|s| to_digits(&seen, &s.points, &s.objects, digits))
            .collect()
    }
}
