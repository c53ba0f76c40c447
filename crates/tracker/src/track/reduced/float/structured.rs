//! Float runs in the reduced space where there are other constraints than distances: no construction has a closed
//! form then, so that the path is followed in all coordinates, with elimination through the R-structure in the
//! place of an inverse. The driving parameters are the key unknowns.

use crate::linalg::{Singular, Vector};
use crate::system::Homotopy;
use crate::track::float::Record;
use crate::track::full::float::follow_both_ways;
use crate::track::full::{Differences, Equations, Lengths, Preconditioner};
use crate::track::reduced::plans::Plans;
use crate::track::reduced::structure::elimination::{Elimination, Maker};
use crate::track::reduced::structure::layout::Order;
use crate::track::{Control, Options, Outcome, Space};

/// Follows the path through the sketch.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    let record = Record::new();
    let equations = Equations::new(homotopy);
    let maker = Maker::new(Order::new(homotopy, &equations), options.alpha);
    let mut made = (maker, Plans::default());
    let given = (&equations, &mut made);
    let outcome = follow_both_ways::<Structured>(homotopy, given, options, control, record);
    Outcome {
        space: Space::Reduced,
        plan_changes: made.1.changes,
        driving: made.1.driving(),
        ..outcome
    }
}

#[derive(Debug, Clone)]
struct Structured(Elimination);

impl Preconditioner for Structured {
    /// What makes eliminations, and how they were.
    type Maker = (Maker, Plans);
    const FRESH: bool = false;

    fn new(equations: &Equations) -> Self {
        Structured(Elimination::new(equations))
    }

    fn make(
        &mut self,
        (maker, plans): &mut (Maker, Plans),
        equations: &Equations,
        at: (&Differences, &Lengths, &Vector),
    ) -> Result<bool, Singular> {
        self.0.make(maker, equations, at)?;
        plans.add(&self.0.layout);
        Ok(self.0.is_negative(equations))
    }

    fn obstacle(&self) -> Option<String> {
        self.0.obstacle()
    }

    fn solve(&self, equations: &Equations, f: &[f64], out: &mut Vector) {
        self.0.solve(equations, f, out);
    }
}
