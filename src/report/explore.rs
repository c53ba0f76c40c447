//! What came of exploring, for people and for programs.

use super::columns::{DIGITS, write_digits, written};
use super::drawing::Drawing;
use super::json::{
    Points, WrittenFold, WrittenSample, text, value, written_folds, written_samples,
};
use crate::explore::{Class, End, Explorer, Finish, PathRecord, intervals};
use crate::interval::Interval;
use crate::interval::vector::{cross, dot};
use crate::places::{Each as _, array};
use crate::problem::{Problem, Published, counted};
use crate::track::{Outcome, Trace};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;

/// What is known of all real solutions, by other means.
#[derive(Debug, Clone, PartialEq)]
pub enum AllReal {
    /// The number of real solutions up to congruence, proved.
    Proved(usize),
    /// The search was not tried, or did not come to its end: why.
    Unknown(String),
}

/// A result of exploring, to be reported.
#[derive(Debug)]
pub struct Explored<'a> {
    /// The process.
    pub explorer: &'a Explorer,
    /// How the run ended. `None`: there was none.
    pub finish: Option<Finish>,
    /// All real solutions.
    pub all_real: AllReal,
    /// Results that others published.
    pub published: &'a [Published],
    /// Paths that were followed once more, to be drawn.
    pub traced: &'a [TracedPath],
    /// The number of figures along each of these that are written.
    pub samples: usize,
}

/// A path that was followed once more ([`crate::track::trace_path`]).
#[derive(Debug)]
pub struct TracedPath {
    /// Its number.
    pub id: u64,
    /// The outcome of following it again.
    pub outcome: Outcome,
    /// The path itself.
    pub trace: Trace,
}

/// A solution of a path followed again is the one found before if no coordinate differs by more than this, in parts of the
/// figure's size: both are known to many more digits.
const SAME: f64 = 1e-6;

impl TracedPath {
    /// Where on the path a solution is, and how many folds are proved to lie before it.
    fn place_of(&self, class: &Class) -> Option<(f64, Option<usize>)> {
        let known: Vec<f64> = middles(intervals(&class.points).iter()).collect();
        let size = known.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let far = |points: &[[Interval; 3]]| {
            let pairs = middles(points.iter()).zip(&known);
            pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        };
        let solutions = self.outcome.solutions.iter();
        let (off, solution) = solutions
            .map(|solution| (far(&solution.points), solution))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let place = solution.place.filter(|_| off <= SAME * size)?;
        Some((place.arc, place.folds))
    }
}

fn middles<'p>(points: impl Iterator<Item = &'p [Interval; 3]>) -> impl Iterator<Item = f64> {
    points.flatten().map(|x| x.mid())
}

/// Numbers of paths by how they ended.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
struct Counts {
    followed: usize,
    closed: usize,
    open: usize,
    stopped: usize,
    recognised: usize,
    unusable: usize,
    repeated: u64,
    waiting: usize,
    in_units: usize,
    degenerate: usize,
    tubes: usize,
}

/// Points are in one plane where none is farther from it, in parts of the figure's size: in floats.
const FLAT: f64 = 1e-9;

impl Explored<'_> {
    fn problem(&self) -> &Problem {
        self.explorer.problem()
    }

    fn counts(&self) -> Counts {
        let contents = self.explorer.contents();
        let mut counts = Counts {
            repeated: contents.state.repeated,
            waiting: contents.queue().len(),
            in_units: contents.out.len(),
            ..Counts::default()
        };
        for path in contents.paths.values() {
            counts.tubes += path.tubes;
            counts.degenerate += path.degenerate;
            match path.end {
                End::Closed => counts.closed += 1,
                End::Open => counts.open += 1,
                End::Stopped => counts.stopped += 1,
                End::Recognised => counts.recognised += 1,
                End::Unusable => counts.unusable += 1,
            }
        }
        counts.followed = counts.closed + counts.open + counts.stopped;
        counts
    }

    fn flat(&self) -> usize {
        let classes = self.explorer.contents().classes.iter();
        classes
            .filter(|class| is_flat(self.problem(), class))
            .count()
    }

    /// What was found, in words that claim no more than was proved.
    fn verdict(&self) -> String {
        let found = self.explorer.contents().classes.len();
        let flat = match self.flat() {
            0 => String::new(),
            flat => format!(", {flat} of them flat"),
        };
        format!(
            "{} found{flat}, each proved, no two congruent. That there are no others is not claimed.",
            counted(found, "solution")
        )
    }

    /// Where a sketch comes from, in words.
    fn origin(&self, id: u64) -> String {
        match self.explorer.contents().sketches.get(&id) {
            Some(sketch) => match sketch.from {
                None => "the drawn sketch".to_owned(),
                Some((class, branch)) => format!("solution {}, branch {branch}", class + 1),
            },
            None => String::new(),
        }
    }

    fn path(&self, id: u64) -> Option<&PathRecord> {
        self.explorer.contents().paths.get(&id)
    }
}

fn is_flat(problem: &Problem, class: &Class) -> bool {
    if problem.dimension == 2 {
        return false;
    }
    let places: Vec<[f64; 3]> = class
        .points
        .iter()
        .map(|p| p.each(|[a, b]| 0.5 * (a + b)))
        .collect();
    let from = |p: usize| -> [f64; 3] { array(|k| places[p][k] - places[0][k]) };
    let n = places.len();
    let size = (1..n)
        .map(|p| dot(from(p), from(p)))
        .fold(0.0, f64::max)
        .sqrt();
    let normals = (1..n).flat_map(|p| (1..p).map(move |q| (p, q)));
    let normal = normals
        .map(|(p, q)| cross(from(p), from(q)))
        .max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))
        .unwrap_or([0.0; 3]);
    let long = dot(normal, normal).sqrt();
    (1..n).all(|p| dot(from(p), normal).abs() <= FLAT * size * long)
}

/// The result as a text of several lines; with the coordinates of all solutions where they are wanted.
pub fn explore_to_table(explored: &Explored, coordinates: bool) -> String {
    written(|out| write_table(out, explored, coordinates))
}

fn write_table(out: &mut String, explored: &Explored, coordinates: bool) -> std::fmt::Result {
    let (problem, contents) = (explored.problem(), explored.explorer.contents());
    let (counts, found) = (explored.counts(), contents.classes.len());
    writeln!(out, "{}: {}", problem.name, explored.verdict())?;
    let waiting = counted(counts.waiting, "sketch");
    match explored.finish {
        Some(Finish::Ended) => {
            let idle = contents.state.idle + 1;
            writeln!(
                out,
                "Nothing new came of the last {}; `--patience` tries more.",
                counted(idle, "way")
            )?
        }
        Some(Finish::Budget) => writeln!(
            out,
            "The budget ended with {waiting} waiting: the same command goes on from here."
        )?,
        Some(Finish::Interrupted) => writeln!(
            out,
            "Interrupted with {waiting} waiting: the same command goes on from here."
        )?,
        Some(Finish::Shared(count)) => writeln!(
            out,
            "{} left in work units: `krawl merge` takes their results, `--take-back` follows them here.",
            counted(count, "sketch")
        )?,
        None => {}
    }
    writeln!(out)?;
    match &explored.all_real {
        AllReal::Proved(all) => writeln!(
            out,
            "of all real ones  {found} of {all} reached (`krawl all` proves that there are {all})"
        )?,
        AllReal::Unknown(why) => writeln!(out, "of all real ones  not known: {why}")?,
    }
    for published in explored.published {
        if let Some(solutions) = published.solutions {
            let seconds = match published.seconds {
                Some(seconds) => format!(", {seconds} s"),
                None => String::new(),
            };
            writeln!(
                out,
                "published         {solutions}: {}{seconds}",
                published.method
            )?;
        }
    }
    writeln!(
        out,
        "paths             {} followed: {} closed, {} open, {} stopped; {} tubes",
        counts.followed, counts.closed, counts.open, counts.stopped, counts.tubes
    )?;
    writeln!(
        out,
        "sketches          {} waiting, {} in work units, {} on proved paths at t = 0, {} unusable, {} drawn before",
        counts.waiting, counts.in_units, counts.recognised, counts.unusable, counts.repeated
    )?;
    if counts.degenerate > 0 {
        writeln!(
            out,
            "degenerate        {} flat figures on paths, with others as near as one likes: not counted as solutions",
            counts.degenerate
        )?;
    }
    if contents.state.undecided > 0 {
        writeln!(
            out,
            "undecided         {} solutions of paths could not be told from others, and are not counted",
            contents.state.undecided
        )?;
    }
    writeln!(
        out,
        "ways              {} (plan, length that bends, coefficient)",
        contents.state.ways
    )?;
    writeln!(out, "seconds           {:.2}", contents.state.seconds)?;
    if found > 0 {
        writeln!(
            out,
            "\n{:>8}  {:>6}  {:<10}  {:<24}  bend",
            "solution", "path", "ends", "sketch from"
        )?;
    }
    for class in &contents.classes {
        let end = explored.path(class.path).map_or("", |path| path.end.name());
        let way = contents
            .sketches
            .get(&class.path)
            .map(|s| explored.explorer.way(s.way));
        let bend = way.map_or(String::new(), |way| {
            format!("{} by {}", problem.distance_name(way.bend), way.coefficient)
        });
        writeln!(
            out,
            "{:>8}  {:>6}  {end:<10}  {:<24}  {bend}",
            class.id + 1,
            class.path,
            explored.origin(class.path)
        )?;
    }
    if coordinates {
        for class in &contents.classes {
            writeln!(out, "\nSolution {}", class.id + 1)?;
            write_digits(out, problem, &intervals(&class.points))?;
        }
        writeln!(out, "\n{DIGITS}")?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    drawing: Drawing<'a>,
    /// `null`: nothing was run.
    status: Option<&'static str>,
    verdict: String,
    solutions: Vec<Entry<'a>>,
    paths: BTreeMap<String, Path<'a>>,
    counts: Counts,
    undecided: u64,
    ways: usize,
    all_real: Option<usize>,
    published: Vec<Value>,
    seconds: f64,
}

#[derive(Serialize)]
struct Entry<'a> {
    points: Points<'a, [Interval; 3]>,
    flat: bool,
    path: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    arc: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    folds: Option<usize>,
}

#[derive(Serialize)]
struct Path<'a> {
    status: &'static str,
    from: Option<Value>,
    sketch: Points<'a, [f64; 3]>,
    bend: String,
    bend_coefficient: String,
    tubes: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    folds: Option<Vec<WrittenFold<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<WrittenSample<'a>>>,
}

/// The result as one line of JSON; docs/using/explore.md and docs/schema/explore.schema.json describe it.
pub fn explore_to_json(explored: &Explored) -> String {
    text(&document(explored))
}

/// What [`explore_to_json`] writes, as a value in memory.
pub fn explore_to_value(explored: &Explored) -> serde_json::Value {
    value(&document(explored))
}

fn document<'a>(explored: &'a Explored) -> Document<'a> {
    let (problem, contents) = (explored.problem(), explored.explorer.contents());
    let traced = |id: u64| explored.traced.iter().find(|path| path.id == id);
    let mut paths = BTreeMap::new();
    for class in &contents.classes {
        let (Some(sketch), Some(path)) = (
            contents.sketches.get(&class.path),
            contents.paths.get(&class.path),
        ) else {
            continue;
        };
        let way = explored.explorer.way(sketch.way);
        let own = problem.points.iter();
        let own = own.map(|p| p.sketch.each_ref().each(|x| x.to_f64()));
        paths.insert(
            class.path.to_string(),
            Path {
                status: path.end.name(),
                from: sketch
                    .from
                    .map(|(solution, branch)| json!({"solution": solution, "branch": branch})),
                sketch: Points(
                    problem,
                    sketch
                        .places()
                        .map_or_else(|| own.collect(), <[[f64; 3]]>::to_vec),
                ),
                bend: problem.distance_name(way.bend),
                bend_coefficient: way.coefficient.to_string(),
                tubes: path.tubes,
                folds: traced(class.path).map(|path| written_folds(problem, &path.trace)),
                samples: traced(class.path)
                    .map(|path| written_samples(problem, &path.trace, explored.samples)),
            },
        );
    }
    Document {
        drawing: Drawing::new("explore", problem),
        status: explored.finish.map(Finish::name),
        verdict: explored.verdict(),
        solutions: contents
            .classes
            .iter()
            .map(|class| {
                let place = traced(class.path).and_then(|path| path.place_of(class));
                Entry {
                    points: Points(problem, intervals(&class.points)),
                    flat: is_flat(problem, class),
                    path: class.path,
                    arc: place.map(|(arc, _)| arc),
                    folds: place.and_then(|(_, folds)| folds),
                }
            })
            .collect(),
        paths,
        counts: explored.counts(),
        undecided: contents.state.undecided,
        ways: contents.state.ways,
        all_real: match explored.all_real {
            AllReal::Proved(all) => Some(all),
            AllReal::Unknown(_) => None,
        },
        published: explored
            .published
            .iter()
            .filter_map(|published| {
                let solutions = published.solutions?;
                let (method, seconds) = (&published.method, published.seconds);
                Some(json!({"method": method, "solutions": solutions, "seconds": seconds}))
            })
            .collect(),
        seconds: contents.state.seconds,
    }
}
