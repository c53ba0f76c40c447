//! What is measured of the figures that a verb prints.

use krawl::problem::Problem;
use krawl::report::{Measures, Placed};
use krawl::track::Solution;

/// A solution as it is measured.
pub(super) fn placed(solution: &Solution) -> Placed<'_> {
    (&solution.points, &solution.objects)
}

/// What to measure.
#[derive(clap::Args)]
pub(super) struct Measured {
    /// Measure this of every figure, with proof: 'angle A B C', A-B
    ///
    /// May be given several times: `A-B`, `angle A B C`, `turn A B C` (with its sense, from −180 to 180), `torsion A
    /// B C D`, `x A`, `area A B C ...` (of an outline that does not cross itself); of a joint `turn J` and `travel
    /// J`, of a circle, sphere or arc `radius C`, of an unknown `value x` (these four not in `motion` and
    /// `tolerance`)
    #[arg(long = "measure", value_name = "WHAT")]
    measure: Vec<String>,
}

impl Measured {
    /// Whether nothing is to be measured.
    pub fn is_empty(&self) -> bool {
        self.measure.is_empty()
    }

    /// What is to be measured, as it was written.
    pub fn texts(&self) -> &[String] {
        &self.measure
    }

    /// Of the points of a problem.
    pub fn of(&self, problem: &Problem) -> Result<Measures, String> {
        Measures::parse(problem, &self.measure)
    }

    /// Of the points of a problem alone.
    pub fn of_points(&self, problem: &Problem) -> Result<Measures, String> {
        let measures = self.of(problem)?;
        match measures.of_an_object() {
            Some(name) => Err(format!(
                "--measure \"{name}\": numbers of objects are measured by solve, all, edit and sweep; motion and tolerance measure lengths, \
                 angles, coordinates and areas of points"
            )),
            None => Ok(measures),
        }
    }
}
