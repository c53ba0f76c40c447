//! Where a run stopped: what may be why.

use crate::order::InOrder;
use krawl::problem::Problem;
use krawl::remarks::{Remark, in_words, remarks};
use krawl::track::{Outcome, Status};

/// Where a run stopped: what makes the sketch or the target singular, which may be why.
pub(super) fn hints(problem: &Problem, outcome: &Outcome, file: &str) -> String {
    const MOST: usize = 3;
    let all = match (problem.is_distances_only(), &outcome.status) {
        (true, Status::Stopped(_)) => remarks(problem),
        // A flat sketch may lead nowhere else than to places where the path ends.
        (false, Status::Stopped(_) | Status::Open(_)) => {
            let mut all = remarks(problem);
            all.retain(|remark| matches!(remark, Remark::FlatSketch { .. }));
            all
        }
        _ => return String::new(),
    };
    let mut warnings: Vec<_> = all.iter().filter(|remark| remark.is_warning()).collect();
    if outcome.steps == 0 {
        // It is the sketch that no run can leave.
        let is_of_sketch = |remark: &Remark| {
            matches!(
                remark,
                Remark::Loose { .. } | Remark::FlatInSketch(_) | Remark::FlatPart { .. }
            )
        };
        warnings.order_by_key(|remark| !is_of_sketch(remark));
    }
    let shown = warnings.iter().take(MOST);
    let mut text: String = shown
        .map(|remark| format!("warning: {}\n", in_words(problem, remark)))
        .collect();
    if warnings.len() > MOST {
        let more = warnings.len() - MOST;
        text += &format!("and {more} more of these: `krawl check {file}` lists them\n");
    }
    text
}
