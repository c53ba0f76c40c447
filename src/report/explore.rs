//! What came of exploring, for people and for programs.

use super::columns::{DIGITS, write_digits};
use super::document::{
    self, Counts, Document, Drawing, FigureFound, Fold, Origin, PathFollowed, Points, Publication,
    Sample, Verb, points,
};
use crate::explore::{Class, End, Explorer, Finish, intervals};
use crate::interval::Interval;
use crate::interval::vector::{cross, dot};
use crate::places::{Each as _, array};
use crate::problem::{Problem, Published, counted};
use crate::track::{Outcome, Trace};

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

    fn traced(&self, id: u64) -> Option<&TracedPath> {
        self.traced.iter().find(|path| path.id == id)
    }

    /// A path that found a solution.
    fn followed(&self, id: u64) -> Option<PathFollowed> {
        let contents = self.explorer.contents();
        let (sketch, path) = (contents.sketches.get(&id)?, contents.paths.get(&id)?);
        let (problem, way) = (self.problem(), self.explorer.way(sketch.way));
        let trace = self.traced(id).map(|path| &path.trace);
        let places = sketch.places();
        let places = places.map_or_else(|| problem.places(), <[[f64; 3]]>::to_vec);
        Some(PathFollowed {
            status: path.end.name().to_owned(),
            from: sketch
                .from
                .map(|(solution, branch)| Origin { solution, branch }),
            sketch: Points::each(problem, &places, |x| x + 0.0),
            bend: problem.distance_name(way.bend),
            bend_coefficient: way.coefficient.to_string(),
            tubes: path.tubes,
            folds: trace.map(|trace| Fold::all(problem, trace)),
            samples: trace.map(|trace| Sample::all(problem, trace, self.samples)),
        })
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
    let (problem, contents) = (explored.problem(), explored.explorer.contents());
    let (counts, found) = (explored.counts(), contents.classes.len());
    let mut out = format!("{}: {}\n", problem.name, explored.verdict());
    let waiting = counted(counts.waiting, "sketch");
    out += &match explored.finish {
        Some(Finish::Ended) => {
            let idle = contents.state.idle + 1;
            format!(
                "Nothing new came of the last {}; `--patience` tries more.\n",
                counted(idle, "way")
            )
        }
        Some(Finish::Budget) => format!(
            "The budget ended with {waiting} waiting: the same command goes on from here.\n"
        ),
        Some(Finish::Interrupted) => {
            format!("Interrupted with {waiting} waiting: the same command goes on from here.\n")
        }
        Some(Finish::Shared(count)) => format!(
            "{} left in work units: `krawl merge` takes their results, `--take-back` follows them here.\n",
            counted(count, "sketch")
        ),
        None => String::new(),
    };
    out.push('\n');
    out += &match &explored.all_real {
        AllReal::Proved(all) => format!(
            "of all real ones  {found} of {all} reached (`krawl all` proves that there are {all})\n"
        ),
        AllReal::Unknown(why) => format!("of all real ones  not known: {why}\n"),
    };
    for published in explored.published {
        if let Some(solutions) = published.solutions {
            let seconds = match published.seconds {
                Some(seconds) => format!(", {seconds} s"),
                None => String::new(),
            };
            out += &format!(
                "published         {solutions}: {}{seconds}\n",
                published.method
            );
        }
    }
    out += &format!(
        "paths             {} followed: {} closed, {} open, {} stopped; {} tubes\n",
        counts.followed, counts.closed, counts.open, counts.stopped, counts.tubes
    );
    out += &format!(
        "sketches          {} waiting, {} in work units, {} on proved paths at t = 0, {} unusable, {} drawn before\n",
        counts.waiting, counts.in_units, counts.recognised, counts.unusable, counts.repeated
    );
    if counts.degenerate > 0 {
        out += &format!(
            "degenerate        {} flat figures on paths, with others as near as one likes: not counted as solutions\n",
            counts.degenerate
        );
    }
    if contents.state.undecided > 0 {
        out += &format!(
            "undecided         {} solutions of paths could not be told from others, and are not counted\n",
            contents.state.undecided
        );
    }
    out += &format!(
        "ways              {} (plan, length that bends, coefficient)\n",
        contents.state.ways
    );
    out += &format!("seconds           {:.2}\n", contents.state.seconds);
    if found > 0 {
        out += &format!(
            "\n{:>8}  {:>6}  {:<10}  {:<24}  bend\n",
            "solution", "path", "ends", "sketch from"
        );
    }
    for class in &contents.classes {
        let Some(path) = explored.followed(class.path) else {
            continue;
        };
        out += &format!(
            "{:>8}  {:>6}  {:<10}  {:<24}  {} by {}\n",
            class.id + 1,
            class.path,
            path.status,
            path.origin(),
            path.bend,
            path.bend_coefficient
        );
    }
    if coordinates {
        for class in &contents.classes {
            out += &format!("\nSolution {}\n", class.id + 1);
            write_digits(&mut out, problem, &intervals(&class.points), |_| true);
        }
        out += &format!("\n{DIGITS}\n");
    }
    out
}

impl Document {
    /// What came of exploring; docs/using/explore.md and docs/schema/explore.schema.json describe it.
    pub fn explore(explored: &Explored) -> Document {
        let (problem, contents) = (explored.problem(), explored.explorer.contents());
        let solutions = contents.classes.iter().map(|class| {
            let place = explored.traced(class.path);
            let place = place.and_then(|path| path.place_of(class));
            let points = points(problem, &intervals(&class.points));
            FigureFound::new(points, is_flat(problem, class), class.path, place)
        });
        let paths = contents.classes.iter();
        let paths = paths.filter_map(|class| Some((class.path, explored.followed(class.path)?)));
        let published = explored.published.iter();
        let published = published
            .filter_map(|published| Some(Publication::new(published, published.solutions?)));
        let own = document::Explored {
            status: explored.finish.map(|finish| finish.name().to_owned()),
            verdict: explored.verdict(),
            solutions: solutions.collect(),
            paths: paths.collect(),
            counts: explored.counts(),
            undecided: contents.state.undecided,
            ways: contents.state.ways,
            all_real: match explored.all_real {
                AllReal::Proved(all) => Some(all),
                AllReal::Unknown(_) => None,
            },
            published: published.collect(),
            seconds: contents.state.seconds,
        };
        Document::of(Drawing::in_gauge("explore", problem), Verb::Explore(own))
    }
}
