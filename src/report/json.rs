//! Results for programs (docs/using/programs.md, docs/schema/result.schema.json).

use super::complete::signs;
use super::drawing::{Drawing, names};
use super::marks::Marks;
use super::objects::Objects;
use super::table::verdict;
use crate::complete::Tested;
use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::track::{Mode, Options, Outcome, Preset, Solution, Status, Trace};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use serde_json::{Map, Value, json};

/// The version of the format: it grows when a key changes its meaning or goes; new keys alone do not
/// change it.
pub const JSON_VERSION: u32 = 1;

/// A run with all that belongs to it, to be written down.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// The problem that was solved.
    pub problem: &'a Problem,
    /// The options with which it was solved.
    pub options: &'a Options,
    /// The outcome of the run.
    pub outcome: &'a Outcome,
    /// The path, where it was kept: only certified runs have one.
    pub trace: Option<&'a Trace>,
    /// The number of figures along the path that are written.
    pub samples: usize,
    /// Where there are more distances than unknowns, what came of those that were left out.
    pub tested: Option<&'a Tested>,
}

impl<'a> Run<'a> {
    /// A run of which no path was kept, and in which nothing was left out.
    pub fn new(problem: &'a Problem, options: &'a Options, outcome: &'a Outcome) -> Self {
        Run {
            problem,
            options,
            outcome,
            trace: None,
            samples: 0,
            tested: None,
        }
    }

    /// The results as one line of JSON, as docs/using/programs.md describes it.
    ///
    /// Numbers read back as the floats that they were written from. JSON has neither infinities nor
    /// NaN: in their place stands `null`.
    pub fn to_json(&self) -> String {
        text(&Document::new(self))
    }

    /// The same, with what was asked for beside it, under these keys.
    pub fn to_json_with(&self, more: impl IntoIterator<Item = Beside>) -> String {
        text(&Document {
            beside: beside(more),
            ..Document::new(self)
        })
    }

    /// The results as a value in memory, with the keys of [`Run::to_json`].
    pub fn to_value(&self) -> Value {
        value(&Document::new(self))
    }
}

/// What was asked for beside a result, if it was, and its key.
pub type Beside = (&'static str, Option<Value>);

/// The keys of what was asked for.
pub(super) fn beside(more: impl IntoIterator<Item = Beside>) -> Map<String, Value> {
    let asked = more
        .into_iter()
        .filter_map(|(key, value)| Some((key.to_owned(), value?)));
    asked.collect()
}

/// A result as one line of JSON.
pub(super) fn text(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("strings, numbers and lists have a form in JSON")
}

/// A result as a value in memory.
pub(super) fn value(document: &impl Serialize) -> Value {
    serde_json::to_value(document).expect("strings, numbers and lists have a form in JSON")
}

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    drawing: Drawing<'a>,
    mode: &'static str,
    space: &'static str,
    options: Value,
    status: &'static str,
    reason: Option<&'a str>,
    stopped_kind: Option<&'static str>,
    verdict: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    tested: Option<&'a Tested>,
    #[serde(skip_serializing_if = "Option::is_none")]
    signed: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ends: Option<Vec<End<'a>>>,
    orientations: Vec<Value>,
    solutions: Vec<Entry<'a>>,
    folds: Vec<WrittenFold<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    samples: Vec<WrittenSample<'a>>,
    steps: usize,
    rejected: usize,
    plan_changes: usize,
    driving: Value,
    length: f64,
    t_range: [f64; 2],
    seconds: f64,
    switched_on: &'a [String],
    #[serde(flatten)]
    beside: Map<String, Value>,
}

#[derive(Serialize)]
struct Entry<'a> {
    points: Points<'a, [Interval; 3]>,
    #[serde(skip_serializing_if = "Objects::is_empty")]
    objects: Objects<'a, Interval>,
    class: usize,
    width: f64,
    folds: Option<usize>,
    arc: Option<f64>,
    rising: Option<bool>,
    mirror_of: Option<usize>,
    signs: Vec<i8>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    degenerate: bool,
}

#[derive(Serialize)]
pub(super) struct WrittenFold<'a> {
    at: f64,
    t: [f64; 2],
    rising: bool,
    points: Points<'a, [Interval; 3]>,
}

#[derive(Serialize)]
pub(super) struct WrittenSample<'a> {
    at: f64,
    t: f64,
    within: f64,
    points: Vec<Vec<f64>>,
    #[serde(skip_serializing_if = "Objects::is_empty")]
    objects: Objects<'a, f64>,
}

/// A map from names to coordinates, in the problem's order.
pub(super) struct Points<'a, T>(pub &'a Problem, pub Vec<T>);

impl<'a> Document<'a> {
    fn new(run: &Run<'a>) -> Self {
        let Run {
            problem,
            options,
            outcome,
            trace,
            samples,
            tested,
        } = *run;
        let (status, stop) = match &outcome.status {
            Status::Closed => ("closed", None),
            Status::Open(_) => ("open", None),
            Status::Stopped(stop) => ("stopped", Some(stop)),
        };
        let trace = trace.filter(|_| outcome.mode == Mode::Certified);
        let marks = Marks::new(problem);
        let sets = marks.sets.iter().zip(&marks.signs);
        Document {
            // Joined points and the sign of their orientation in the sketch.
            orientations: sets
                .map(|(set, sketch)| json!({"points": names(problem, set), "sketch": sketch}))
                .collect(),
            drawing: Drawing::new("solve", problem),
            mode: outcome.mode.name(),
            space: outcome.space.name(),
            options: written_options(problem, options),
            status,
            reason: stop.map(|stop| stop.text.as_str()),
            stopped_kind: stop.map(|stop| stop.kind.name()),
            verdict: verdict(problem, outcome, tested),
            tested,
            signed: outcome.signed.map(signs),
            ends: ends(problem, &outcome.status),
            solutions: outcome
                .solutions
                .iter()
                .map(|solution| Entry::new(problem, solution, &marks))
                .collect(),
            folds: trace.map_or(Vec::new(), |trace| written_folds(problem, trace)),
            samples: trace.map_or(Vec::new(), |trace| written_samples(problem, trace, samples)),
            steps: outcome.steps,
            rejected: outcome.rejected,
            plan_changes: outcome.plan_changes,
            driving: json!({"average": outcome.driving.average, "max": outcome.driving.max}),
            length: outcome.length,
            t_range: [outcome.t_range.0, outcome.t_range.1],
            seconds: outcome.seconds,
            switched_on: &outcome.switched_on,
            beside: Map::new(),
        }
    }
}

/// An end of an open path.
#[derive(Serialize)]
struct End<'a> {
    t: [f64; 2],
    kind: &'static str,
    reason: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    away: Option<Value>,
}

fn ends<'a>(problem: &'a Problem, status: &'a Status) -> Option<Vec<End<'a>>> {
    let Status::Open(ends) = status else {
        return None;
    };
    let all = ends.iter().map(|end| End {
        t: [end.t.0, end.t.1],
        kind: end.kind.name(),
        reason: &end.reason,
        // A point that goes to infinity.
        away: end.away.map(
            |away| json!({"point": problem.points[away.point].name, "distance": away.distance}),
        ),
    });
    Some(all.collect())
}

/// The places where a path turns back.
pub(super) fn written_folds<'a>(problem: &'a Problem, trace: &Trace) -> Vec<WrittenFold<'a>> {
    let folds = trace.folds().into_iter();
    folds
        .map(|fold| WrittenFold {
            at: fold.at,
            t: bounds(&fold.t),
            rising: fold.rising,
            points: Points(problem, fold.points),
        })
        .collect()
}

/// A number of figures along a path.
pub(super) fn written_samples<'a>(
    problem: &'a Problem,
    trace: &Trace,
    count: usize,
) -> Vec<WrittenSample<'a>> {
    let d = problem.dimension;
    let samples = trace.samples(count).into_iter();
    samples
        .map(|sample| WrittenSample {
            at: sample.at,
            t: sample.t,
            within: sample.within,
            points: sample.points.iter().map(|p| p[..d].to_vec()).collect(),
            objects: Objects::new(problem, &sample.objects, |x| x.mid()),
        })
        .collect()
}

fn written_options(problem: &Problem, options: &Options) -> Value {
    let bend = problem.bend().map(|bend| &problem.distances[bend]);
    json!({
        "preset": match options.preset {
            Preset::Default => "default",
            Preset::Paper => "paper",
        },
        "reverse": options.reverse,
        "bend": bend.map(|bend| bend.points.each(|p| problem.points[p].name.as_str())),
        // As a text, so that it stays exact.
        "bend_coefficient": problem.homotopy.bend_coefficient.to_string(),
        "max_step": options.max_step,
        "tube_radius": options.tube_radius,
        "tolerance": options.tolerance,
        "alpha": options.alpha,
        "extended": options.extended,
        "max_steps": options.max_steps,
    })
}

impl<'a> Entry<'a> {
    fn new(problem: &'a Problem, solution: &Solution, marks: &Marks) -> Self {
        Entry {
            points: Points(problem, solution.points.clone()),
            objects: Objects::new(problem, &solution.objects, |x| *x),
            class: solution.class,
            width: solution.width,
            folds: solution.place.and_then(|place| place.folds),
            arc: solution.place.map(|place| place.arc),
            rising: solution.place.map(|place| place.rising),
            mirror_of: solution.mirror_of,
            signs: marks.of(solution),
            degenerate: solution.is_degenerate,
        }
    }
}

/// Adding zero turns -0, which intervals use as a lower bound, into 0.
fn bounds(x: &Interval) -> [f64; 2] {
    [x.inf() + 0.0, x.sup() + 0.0]
}

/// A coordinate as it is written.
pub(super) trait Coordinate {
    type Written: Serialize;
    fn written(&self) -> Self::Written;
}

impl Coordinate for Interval {
    type Written = [f64; 2];
    fn written(&self) -> [f64; 2] {
        bounds(self)
    }
}

impl Coordinate for f64 {
    type Written = f64;
    fn written(&self) -> f64 {
        *self + 0.0
    }
}

impl<C: Coordinate> Serialize for Points<'_, [C; 3]> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Points(problem, places) = self;
        let mut map = serializer.serialize_map(Some(problem.points.len()))?;
        for (point, place) in problem.points.iter().zip(places) {
            let place = place.iter().take(problem.dimension);
            let place: Vec<C::Written> = place.map(Coordinate::written).collect();
            map.serialize_entry(&point.name, &place)?;
        }
        map.end()
    }
}
