//! What `krawl solve` writes of a path.

use super::{At, Bounds, Choice, Document, Drawing, Objects, Points, Verb};
use super::{all, bounds, middle, names, points};
use crate::blocks::{Combined, CombinedChoice};
use crate::complete::Tested;
use crate::problem::Problem;
use crate::report::marks::Marks;
use crate::report::table::verdict;
use crate::report::{BlockRuns, Run};
use crate::track::{self, Mode, Options, Preset, Signed, Status, Stop, Trace};
use std::ops::Range;

keys! {
    /// The path through the sketch, and the solutions on it.
    Solve(run: &Run, marks: &Marks) {
        /// `certified` or `float`.
        mode: String = run.outcome.mode.name().into(),
        /// `full` or `reduced`.
        space: String = run.outcome.space.name().into(),
        /// What was set.
        options: Set = Set::new(run.problem, run.options),
        /// `closed`, `open` or `stopped`.
        status: String = ended(&run.outcome.status).0.into(),
        /// Why it stopped.
        reason: Option<String> = ended(&run.outcome.status).1.map(|stop| stop.text.clone()),
        /// That for programs.
        stopped_kind: Option<String> = ended(&run.outcome.status).1.map(|stop| stop.kind.name().into()),
        /// What is proved.
        verdict: String = verdict(run.problem, run.outcome, run.tested),
        /// Joined points, and how they turn in the sketch.
        orientations: Vec<Orientation> = all(marks.sets.iter().zip(&marks.signs), |(set, sign)| {
            Orientation::new(run.problem, set, *sign)
        }),
        /// The solutions.
        solutions: Vec<Solution> = all(&run.outcome.solutions, |solution| Solution::new(run.problem, solution, marks)),
        /// Where the path turns back.
        folds: Vec<Fold> = trace(run).map_or(Vec::new(), |trace| Fold::all(run.problem, trace)),
        /// How many steps were made.
        steps: usize = run.outcome.steps,
        /// How many were rejected.
        rejected: usize = run.outcome.rejected,
        /// How often the plan was changed.
        plan_changes: usize = run.outcome.plan_changes,
        /// How many parameters the plan had.
        driving: Driving = Driving::new(run.outcome.driving),
        /// How long the path is.
        length: Option<f64> = Some(run.outcome.length),
        /// Between which values t was.
        t_range: [Option<f64>; 2] = [Some(run.outcome.t_range.0), Some(run.outcome.t_range.1)],
        /// How long it took.
        seconds: f64 = run.outcome.seconds,
        /// What was switched on.
        switched_on: Vec<String> = run.outcome.switched_on.clone(),
    } or nothing {
        /// What came of more constraints than unknowns.
        tested: Option<Tested> = run.tested.cloned(),
        /// What came of the signs that are asked for.
        signed: Option<Signs> = run.outcome.signed.map(Signs::new),
        /// The ends of an open path.
        ends: Option<Vec<PathEnd>> = match &run.outcome.status {
            Status::Open(ends) => Some(all(ends.iter(), |end| PathEnd::new(run.problem, end))),
            _ => None,
        },
        /// Figures along the path.
        samples: Vec<Sample> = trace(run).map_or(Vec::new(), |trace| Sample::all(run.problem, trace, run.samples)),
        /// What came of it block by block, where the path stopped and blocks hang together by sides.
        blocks: Option<Blocks> = None,
        /// What came of it block by block, where the path says nothing.
        by_blocks: Option<Box<Document>> = None,
    }
}

/// How a run ended, and why, if it stopped.
pub(crate) fn ended(status: &Status) -> (&'static str, Option<&Stop>) {
    match status {
        Status::Closed => ("closed", None),
        Status::Open(_) => ("open", None),
        Status::Stopped(stop) => ("stopped", Some(stop)),
    }
}

/// The path, if it was kept and is proved.
fn trace<'a>(run: &Run<'a>) -> Option<&'a Trace> {
    run.trace.filter(|_| run.outcome.mode == Mode::Certified)
}

keys! {
    /// What was set.
    Set(problem: &Problem, options: &Options) {
        /// `default` or `paper`.
        preset: String = match options.preset {
            Preset::Default => "default".into(),
            Preset::Paper => "paper".into(),
        },
        /// Whether the path was followed the other way.
        reverse: bool = options.reverse,
        /// The length that bends.
        bend: Option<[String; 2]> = problem.bend().map(|bend| {
            problem.distances[bend].points.map(|p| problem.points[p].name.clone())
        }),
        /// By how much; as a text, so that it stays exact.
        bend_coefficient: String = problem.homotopy.bend_coefficient.to_string(),
        /// The longest step.
        max_step: Option<f64> = options.max_step,
        /// The radius of tubes.
        tube_radius: Option<f64> = options.tube_radius,
        /// Of a corrector in floats.
        tolerance: Option<f64> = options.tolerance,
        /// Of the plan's test.
        alpha: f64 = options.alpha,
        /// Whether more than 53 bits are used where they are needed.
        extended: bool = options.extended,
        /// The most steps.
        max_steps: usize = options.max_steps,
    }
}

keys! {
    /// What came of the signs that are asked for.
    Signs(signed: Signed) {
        /// How many are.
        asked: usize = signed.asked,
        /// Parts of a search that were given up for them.
        parts_given_up: u64 = signed.cut,
        /// Figures that have others.
        wrong: u64 = signed.wrong,
        /// Figures that were mirrored for them.
        mirrored: usize = signed.mirrored,
        /// Figures of which one cannot be told.
        undecided: u64 = signed.undecided,
    }
}

keys! {
    /// An end of an open path.
    PathEnd(problem: &Problem, end: &track::PathEnd) {
        /// Where.
        t: [Option<f64>; 2] = [Some(end.t.0), Some(end.t.1)],
        /// What end it is.
        kind: String = end.kind.name().into(),
        /// That in words.
        reason: String = end.reason.clone(),
    } or nothing {
        /// A point that goes to infinity.
        away: Option<Away> = end.away.map(|away| Away::new(problem, away)),
    }
}

keys! {
    /// A point that goes to infinity.
    Away(problem: &Problem, away: track::Away) {
        /// Its name.
        point: String = problem.points[away.point].name.clone(),
        /// How far it is.
        distance: [Option<f64>; 2] = [Some(away.distance.0), Some(away.distance.1)],
    }
}

keys! {
    /// How joined points turn.
    Orientation(problem: &Problem, set: &[usize], sign: i8) {
        /// Their names.
        points: Vec<String> = names(problem, set),
        /// The sign in the sketch.
        sketch: i8 = sign,
    }
}

keys! {
    /// A solution.
    Solution(problem: &Problem, solution: &track::Solution, marks: &Marks) {
        /// Its points.
        points: Points<Bounds> = points(problem, &solution.points),
        /// Solutions of one class are congruent.
        class: usize = solution.class,
        /// How narrowly it is enclosed, as a part of its size.
        width: Option<f64> = Some(solution.width),
        /// How many folds are before it.
        folds: Option<usize> = solution.place.and_then(|place| place.folds),
        /// How far on the path it is.
        arc: Option<f64> = solution.place.map(|place| place.arc),
        /// Whether t rises there.
        rising: Option<bool> = solution.place.map(|place| place.rising),
        /// The solution of which it is the mirror image.
        mirror_of: Option<usize> = solution.mirror_of,
        /// How joined points turn.
        signs: Vec<i8> = marks.of(solution),
    } or nothing {
        /// Its objects.
        objects: Objects<Bounds> = At::all(problem, &solution.objects, bounds),
        /// Whether it is flat, with others as near as one likes.
        degenerate: bool = solution.is_degenerate,
    }
}

keys! {
    /// A place where a path turns back.
    Fold(problem: &Problem, fold: track::Fold) {
        /// How far on the path.
        at: f64 = fold.at,
        /// Where.
        t: Bounds = bounds(&fold.t),
        /// Whether t rises behind it.
        rising: bool = fold.rising,
        /// The figure there.
        points: Points<Bounds> = points(problem, &fold.points),
    }
}

impl Fold {
    /// The places where a path turns back.
    pub(crate) fn all(problem: &Problem, trace: &Trace) -> Vec<Self> {
        all(trace.folds(), |fold| Fold::new(problem, fold))
    }
}

keys! {
    /// A figure along a path.
    Sample(problem: &Problem, sample: track::Sample) {
        /// How far on the path.
        at: f64 = sample.at,
        /// Where.
        t: f64 = sample.t,
        /// How far the path may be from it.
        within: Option<f64> = Some(sample.within),
        /// Its points, in the order of their names.
        points: Vec<Vec<f64>> = all(&sample.points, |p| p[..problem.dimension].to_vec()),
    } or nothing {
        /// Its objects.
        objects: Objects<f64> = At::all(problem, &sample.objects, middle),
    }
}

impl Sample {
    /// A number of figures along a path.
    pub(crate) fn all(problem: &Problem, trace: &Trace, count: usize) -> Vec<Self> {
        all(trace.samples(count), |sample| Sample::new(problem, sample))
    }
}

keys! {
    /// How many parameters a plan had.
    Driving(driving: track::Driving) {
        /// Over all steps.
        average: f64 = driving.average,
        /// The most.
        max: usize = driving.max,
    }
}

keys! {
    /// A problem that was followed block by block; `combined`: what its blocks make, of which figures with these numbers are listed.
    Blocks(of: &BlockRuns, combined: Option<&Combined>, numbers: Range<u64>) {
        /// What is proved.
        verdict: String = of.verdict(),
        /// Whether each path was followed with proof.
        proved: bool = of.all_proved(),
        /// How many figures come of it.
        count: Option<u64> = combined.and_then(Combined::count),
        /// Whether mirror images are not counted.
        without_mirror_images: bool = combined.is_some_and(Combined::without_mirror_images),
        /// What came of each block.
        runs: Vec<Document> = all(of.runs, |(block, outcome)| Document::solve(&Run::new(block, of.options, outcome))),
        /// The figures.
        figures: Vec<FigureOfRuns> = combined.map_or(Vec::new(), |combined| {
            all(numbers, |number| FigureOfRuns::new(of.problem, combined, &combined.choices(number)))
        }),
    }
}

keys! {
    /// A figure that is made of solutions of blocks.
    FigureOfRuns(problem: &Problem, combined: &Combined, choices: &[CombinedChoice]) {
        /// Of which.
        choices: Vec<Choice> = all(choices, |c| Choice::new(c.block, c.solution, Some(c.mirrored))),
        /// Its points, where the boxes are not too wide.
        points: Option<Points<Bounds>> = combined.figure(choices).map(|places| points(problem, &places)),
    }
}

impl Solve {
    /// What came of a run.
    pub fn of(run: &Run) -> Self {
        Solve::new(run, &Marks::new(run.problem))
    }

    /// That with what is said of the problem.
    pub fn document(self, problem: &Problem) -> Document {
        Document::of(Drawing::in_gauge("solve", problem), Verb::Solve(self))
    }
}

impl Document {
    /// What came of a run.
    pub fn solve(run: &Run) -> Document {
        Solve::of(run).document(run.problem)
    }
}
