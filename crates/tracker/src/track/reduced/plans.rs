//! How many construction plans a run has had, and of how many driving parameters.

use super::structure::layout::Layout;
use crate::track::Driving;
use std::sync::Arc;

/// What is counted of the plans of a run, step by step.
#[derive(Debug, Default)]
pub struct Plans {
    /// Changes of plan.
    pub changes: usize,
    last: Option<Arc<Layout>>,
    steps: usize,
    /// Driving parameters of all steps, and at most.
    driving: usize,
    most: usize,
}

impl Plans {
    /// One step more, with so many driving parameters.
    pub fn count(&mut self, driving: usize) {
        self.steps += 1;
        self.driving += driving;
        self.most = self.most.max(driving);
    }

    /// One step more, through this R-structure: its key unknowns but t are the driving parameters.
    pub fn add(&mut self, layout: &Arc<Layout>) {
        let is_other = |last: &Arc<Layout>| !Arc::ptr_eq(last, layout);
        self.changes += usize::from(self.last.as_ref().is_some_and(is_other));
        self.last = Some(layout.clone());
        self.count(layout.keys() - 1);
    }

    /// The numbers of driving parameters.
    pub fn driving(&self) -> Driving {
        Driving {
            average: self.driving as f64 / self.steps.max(1) as f64,
            max: self.most,
        }
    }
}
