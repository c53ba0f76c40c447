//! What `krawl all` writes.

use super::{
    At, Bounds, Document, Drawing, Objects, Points, Signs, Verb, all, all_names, bounds, names,
    points,
};
use crate::blocks::{Account, LeftOut};
use crate::complete::{self, Choice, Complete, Constructed, Searched, Tested};
use crate::problem::Problem;
use crate::report::complete::{complete_in_words, figure, made_in_words, why};
use crate::track::Solution;

keys! {
    /// All figures.
    All(problem: &Problem, result: &Complete, made: &Account) {
        /// `complete`, `partial` or `flexible`.
        status: String = result.status.name().into(),
        /// Why there is none, or what stands in the way of a claim.
        reason: Option<String> = result.reason.clone(),
        /// What is proved.
        verdict: String = format!("{} {}", complete_in_words(problem, result), made_in_words(made)).trim_end().into(),
        /// How they were searched.
        method: String = result.method.name().into(),
        /// How many there are.
        count: Option<u64> = result.count,
        /// The figures.
        solutions: Vec<AllFigure> = all(result.solutions.iter().enumerate(), |(k, solution)| {
            AllFigure::new(problem, solution, figure(result, k))
        }),
        /// What is not decided.
        undecided: Vec<Undecided> = all(&result.undecided, |part| Undecided::new(part, why(part.why))),
        /// How many parts of the space were looked at.
        boxes: u64 = result.boxes,
        /// How long it took.
        seconds: f64 = result.seconds,
        /// How long the rest may take.
        seconds_left: Option<f64> = result.seconds_left,
        /// How many parameters, or unknowns, were searched.
        driving: usize = result.driving,
        /// The order in which the plan places points.
        plan: Vec<String> = names(problem, &result.plan),
    } or nothing {
        /// Of what that is proved, where the sketch was not searched as it is.
        account: Option<Account> = made.clause().chars().next().map(|_| made.clone()),
        /// The parts of a problem that falls apart.
        parts: Vec<Part> = all(&result.parts, Part::new),
        /// Of what the figures are combinations.
        independent: Vec<Choice> = result.choices.clone(),
        /// What is placed before it falls apart.
        decided_first: Option<Choice> = result.first_choice.clone(),
        /// What came of more constraints than unknowns.
        tested: Option<Tested> = result.tested.clone(),
        /// What came of the signs that are asked for.
        signed: Option<Signs> = result.signed.map(Signs::new),
        /// Unknowns that were computed step by step from a few of them.
        constructed: Option<Constructed> = result.constructed,
        /// How many complex solutions there are.
        complex: Option<usize> = result.complex,
        /// Bodies that were searched over how they are turned.
        turned: Vec<String> = result.turned.clone(),
    }
}

keys! {
    /// A part of a problem that falls apart.
    Part(part: &Searched) {
        /// Its points.
        points: Vec<String> = all_names(&part.problem),
        /// What is proved of it.
        status: String = part.result.status.name().into(),
        /// How many solutions it has.
        solutions: usize = part.result.solutions.len(),
        /// How many parts of its space were looked at.
        boxes: u64 = part.result.boxes,
    }
}

keys! {
    /// A figure.
    AllFigure(problem: &Problem, solution: &Solution, left_out: &[LeftOut]) {
        /// Its points.
        points: Points<Bounds> = points(problem, &solution.points),
        /// Figures of one class are congruent.
        class: usize = solution.class,
        /// How narrowly it is enclosed, as a part of its size.
        width: f64 = solution.width,
    } or nothing {
        /// Its objects.
        objects: Objects<Bounds> = At::all(problem, &solution.objects, bounds),
        /// How it stands to what was left out.
        left_out: Vec<LeftOut> = left_out.to_vec(),
    }
}

keys! {
    /// Parts of a search that are not decided.
    Undecided(part: &complete::Part, why: &str) {
        /// Why.
        reason: String = why.into(),
        /// How many.
        parts: u64 = part.count,
        /// Their share of all.
        share: f64 = part.share,
    }
}

impl Document {
    /// All figures of a problem, or what is known of them. `made`: of what that is proved where the problem was made of a sketch.
    pub fn all(problem: &Problem, result: &Complete, made: &Account) -> Document {
        let drawing = Drawing::seen_from("all", problem, &result.reference);
        Document::of(drawing, Verb::All(All::new(problem, result, made)))
    }
}
