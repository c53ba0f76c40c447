//! Results for programs.

use crate::interval::Interval;
use crate::problem::Problem;
use crate::track::{Outcome, Solution, Status};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The results as one line of JSON:
///
/// ```json
/// {"problem": "...", "mode": "certified", "space": "full", "status": "closed", "reason": null,
///  "solutions": [{"points": {"p1": [[0.0, 0.0], [0.0, 0.0]]}, "class": 0, "width": 1e-14}],
///  "steps": 0, "rejected": 0, "plan_changes": 0, "driving": {"average": 0.0, "max": 0},
///  "length": 0.0, "t_range": [0.0, 0.0], "seconds": 0.0, "switched_on": []}
/// ```
///
/// A point has as many coordinates as the problem has dimensions, each a pair of bounds in the
/// problem's units. Numbers read back as the floats that they were written from. JSON has neither
/// infinities nor NaN: in their place stands `null`.
pub fn to_json(problem: &Problem, outcome: &Outcome) -> String {
    serde_json::to_string(&Document::new(problem, outcome))
        .expect("strings, numbers and lists have a form in JSON")
}

#[derive(serde::Serialize)]
struct Document<'a> {
    problem: &'a str,
    mode: &'static str,
    space: &'static str,
    status: &'static str,
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ends: Option<Vec<End<'a>>>,
    solutions: Vec<Entry<'a>>,
    steps: usize,
    rejected: usize,
    plan_changes: usize,
    driving: Driving,
    length: f64,
    t_range: [f64; 2],
    seconds: f64,
    switched_on: &'a [String],
}

#[derive(serde::Serialize)]
struct Driving {
    average: f64,
    max: usize,
}

#[derive(serde::Serialize)]
struct Entry<'a> {
    points: Points<'a>,
    class: usize,
    width: f64,
}

/// A map from names to coordinates, in the problem's order.
pub(super) struct Points<'a>(pub &'a Problem, pub &'a Solution);

impl<'a> Document<'a> {
    fn new(problem: &'a Problem, outcome: &'a Outcome) -> Self {
        let (status, reason) = match &outcome.status {
            Status::Closed => ("closed", None),
            Status::Open(_) => ("open", None),
            Status::Stopped(reason) => ("stopped", Some(reason.as_str())),
        };
        Document {
            problem: &problem.name,
            mode: outcome.mode.name(),
            space: outcome.space.name(),
            status,
            reason,
            ends: ends(&outcome.status),
            solutions: outcome
                .solutions
                .iter()
                .map(|solution| Entry {
                    points: Points(problem, solution),
                    class: solution.class,
                    width: solution.width,
                })
                .collect(),
            steps: outcome.steps,
            rejected: outcome.rejected,
            plan_changes: outcome.plan_changes,
            driving: Driving {
                average: outcome.driving.average,
                max: outcome.driving.max,
            },
            length: outcome.length,
            t_range: [outcome.t_range.0, outcome.t_range.1],
            seconds: outcome.seconds,
            switched_on: &outcome.switched_on,
        }
    }
}

/// An end of an open path.
#[derive(serde::Serialize)]
struct End<'a> {
    t: [f64; 2],
    kind: &'static str,
    reason: &'a str,
}

fn ends(status: &Status) -> Option<Vec<End<'_>>> {
    let Status::Open(ends) = status else {
        return None;
    };
    let all = ends.iter().map(|end| End {
        t: [end.t.0, end.t.1],
        kind: end.kind.name(),
        reason: &end.reason,
    });
    Some(all.collect())
}

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Points(problem, solution) = self;
        let mut map = serializer.serialize_map(Some(problem.points.len()))?;
        for (point, coordinates) in problem.points.iter().zip(&solution.points) {
            // Adding zero turns -0, which intervals use as a lower bound, into 0.
            let bounds = |x: &Interval| [x.inf() + 0.0, x.sup() + 0.0];
            let pairs: Vec<[f64; 2]> = coordinates
                .iter()
                .take(problem.dimension)
                .map(bounds)
                .collect();
            map.serialize_entry(&point.name, &pairs)?;
        }
        map.end()
    }
}
