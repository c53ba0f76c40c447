//! Float runs in the reduced space where there are other constraints than distances: no construction has a closed
//! form then, so that the path is followed in all coordinates, with elimination through the R-structure in the
//! place of an inverse. The driving parameters are the key unknowns.

use crate::linalg::{Singular, Vector};
use crate::system::Homotopy;
use crate::track::full::float::follow_both_ways;
use crate::track::full::{Differences, Equations, Lengths, Preconditioner};
use crate::track::reduced::structure::elimination::{Elimination, Maker};
use crate::track::reduced::structure::layout::{Layout, Order};
use crate::track::{Control, Driving, Options, Outcome, Space};
use std::sync::Arc;
use std::time::Instant;

/// Follows the path through the sketch.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    let clock = Instant::now();
    let equations = Equations::new(homotopy);
    let mut plans = Plans {
        maker: Maker::new(Order::new(homotopy, &equations), options.alpha),
        last: None,
        changes: 0,
        made: 0,
        keys: 0,
        most: 0,
    };
    let given = (&equations, &mut plans);
    let (status, record) = follow_both_ways::<Structured>(homotopy, given, options, control);
    let outcome = record.into_outcome(homotopy, status, clock.elapsed().as_secs_f64());
    Outcome {
        signed: None,
        space: Space::Reduced,
        plan_changes: plans.changes,
        driving: Driving {
            average: plans.keys as f64 / plans.made.max(1) as f64,
            max: plans.most,
        },
        ..outcome
    }
}

/// What makes eliminations, and how they were.
#[derive(Debug)]
struct Plans {
    maker: Maker,
    last: Option<Arc<Layout>>,
    changes: usize,
    made: usize,
    /// Key unknowns besides t, of all of them and at most.
    keys: usize,
    most: usize,
}

#[derive(Debug, Clone)]
struct Structured(Elimination);

impl Preconditioner for Structured {
    type Maker = Plans;
    const FRESH: bool = false;

    fn new(equations: &Equations) -> Self {
        Structured(Elimination::new(equations))
    }

    fn make(
        &mut self,
        plans: &mut Plans,
        equations: &Equations,
        at: (&Differences, &Lengths, &Vector),
    ) -> Result<bool, Singular> {
        self.0.make(&mut plans.maker, equations, at)?;
        let layout = &self.0.layout;
        let keys = layout.keys() - 1;
        let is_other = |last: &Arc<Layout>| !Arc::ptr_eq(last, layout);
        plans.changes += usize::from(plans.last.as_ref().is_some_and(is_other));
        plans.last = Some(layout.clone());
        plans.made += 1;
        plans.keys += keys;
        plans.most = plans.most.max(keys);
        Ok(self.0.is_negative(equations))
    }

    fn obstacle(&self) -> Option<String> {
        self.0.obstacle()
    }

    fn solve(&self, equations: &Equations, f: &[f64], out: &mut Vector) {
        self.0.solve(equations, f, out);
    }
}
