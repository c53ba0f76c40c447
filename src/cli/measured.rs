//! What is measured of the figures that a verb prints.

use krawl::problem::Problem;
use krawl::report::{Measures, Placed};
use krawl::system::Quantity;
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
    /// May be given several times, and with a name, "gap = A-B": `A-B`, `angle A B C`, `turn A B C` (with its sense, from −180 to 180), `torsion A
    /// B C D`, `x A`, `area A B C ...` (of an outline that does not cross itself); of a joint `turn J` and `travel
    /// J`, of a circle, sphere or arc `radius C`, of an unknown `value x`
    #[arg(long = "measure", value_name = "WHAT")]
    measure: Vec<String>,
}

impl Measured {
    /// Whether nothing is asked for beside what files want measured.
    pub fn is_empty(&self) -> bool {
        self.measure.is_empty()
    }

    /// What is to be measured of a problem: what the file wants, by its names, and what was asked for.
    pub fn texts(&self, problem: &Problem) -> Vec<String> {
        let own = of_file(problem);
        let has_meaning = |found: Quantity| problem.is_absolute() || found.is_invariant();
        let own = own.filter(|text| Quantity::parse(problem, text).is_ok_and(has_meaning));
        own.chain(self.measure.iter().cloned()).collect()
    }

    /// Of the points and objects of a problem.
    pub fn of(&self, problem: &Problem) -> Result<Measures, String> {
        let own: Vec<String> = of_file(problem).collect();
        for ((name, _), text) in problem.measures.iter().zip(&own) {
            Measures::parse(problem, std::slice::from_ref(text)).map_err(|error| {
                format!(
                    "[measures] {name}: {}",
                    error.trim_start_matches("--measure ")
                )
            })?;
        }
        Measures::parse(problem, &[&own[..], &self.measure].concat())
    }

    /// The same without what of the file's own has no meaning where no constraint says where the figure is.
    pub fn with_meaning(&self, problem: &Problem) -> Result<Measures, String> {
        self.of(problem)?;
        Measures::parse(problem, &self.texts(problem))
    }
}

/// What a file wants measured.
fn of_file(problem: &Problem) -> impl Iterator<Item = String> {
    let all = problem.measures.iter();
    all.map(|(name, what)| format!("{name} = {what}"))
}
