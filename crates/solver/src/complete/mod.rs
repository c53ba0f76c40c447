//! All real solutions of a problem, proved complete.
//!
//! The figures that have the distances wanted are searched over the driving parameters of a construction
//! plan, by branch and bound with Taylor models that are rounded outwards: a part of the
//! parameter space is given up only where a bound proves that it holds no figure, or where all its figures lie
//! where Krawczyk's test in all coordinates has proved exactly one ([`Frame`](crate::certificate::cover::Frame)). What is proved, how, and
//! how fast it is: `docs/how/sets.md`.
//!
//! ```
//! use krawl::complete::{Options, Status, all};
//! use krawl::problem::Problem;
//!
//! // A triangle, and a point on each side of its longest edge: four bars and a diagonal.
//! let kite = Problem::build("kite", 2)
//!     .point("a", ["0", "0"]).point("b", ["3", "0"]).point("c", ["1", "1"]).point("d", ["1", "-1"])
//!     .distance("a", "b", "3").distance("a", "c", "2").distance("c", "b", "2")
//!     .distance("a", "d", "2.2").distance("d", "b", "2.1")
//!     .finish().unwrap();
//! let result = all(&kite, &Options::default()).unwrap();
//! assert_eq!(result.status, Status::Complete);
//! // d on the side of c, and on the other. Mirror images are counted once.
//! assert_eq!(result.solutions.len(), 2);
//! ```

// A bound that is not a number decides nothing: tests say what they need, and `!(a < b)` is not `a >= b`.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod among;
mod by_complex;
mod choose;
mod coordinates;
mod cover;
mod emptiness;
mod exact;
mod newton;
mod node;
mod outcome;
mod parts;
mod pieces;
mod place;
mod plan;
mod search;
mod signs;
mod spare;
mod store;
mod surplus;
mod targets;
mod visit;

use crate::order::InOrder;
pub use among::{Among, among};
pub use coordinates::has_equations_to_spare;
pub(crate) use coordinates::ranged;
pub use outcome::{
    Choice, Complete, Constructed, Method, Options, Part, Progress, Status, Unserved,
};
pub use parts::Searched;
pub use store::Keep;
pub use surplus::{Spare, Surplus, Tested};
pub use visit::Why;

use crate::certificate::cover::Pairs;
use crate::problem::Problem;
use pieces::Outline;
use plan::Plan;
use search::{Run, Search, Unfit};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;
use store::{Head, Piece as _, Store};
use targets::Targets;
use visit::Found;

/// Searches for all figures of a problem, up to its symmetries: of distances alone up to rigid motions and reflections.
///
/// Of distances alone by a construction plan, part by part where they fall apart; of other constraints over all coordinates. The
/// sketch plays a part only where constraints say less than they mean (docs/using/problem-files.md): on which side a point is, which
/// of two angles is meant.
///
/// Where the problem asks for signs, parts of the search in which all figures have a wrong one are given up, and the figures found are those
/// that have all signs, up to rigid motions. A cover is of all figures, whatever their signs.
pub fn all(problem: &Problem, options: &Options) -> Result<Complete, Unserved> {
    let result = match options.cover && !problem.orientations.is_empty() {
        true => unsigned(&problem.unsigned(), options),
        false => unsigned(problem, options),
    };
    result.map(|mut result| {
        result.choose_signed(problem);
        result
    })
}

/// All figures of the search. Those in parts that are left may have any signs.
fn unsigned(problem: &Problem, options: &Options) -> Result<Complete, Unserved> {
    let begin = Instant::now();
    let wants_one_search = options.cover || options.store.is_some();
    if options.within_digits
        && !wants_one_search
        && let Some(near) = exact::nearly(problem, |_| true)
    {
        return Ok(Complete::nearly(problem, near, begin));
    }
    if !problem.is_distances_only() {
        let told = match wants_one_search {
            true => None,
            false => by_complex::all(problem, options),
        };
        return told.unwrap_or_else(|| coordinates::all(problem, options));
    }
    if !wants_one_search && let Some(result) = parts::searched(problem, options) {
        return Ok(result);
    }
    match by_plan(problem, options, wants_one_search) {
        // Where no plan serves.
        Err(Unserved::NoBase | Unserved::TooManyParameters) => coordinates::all(problem, options),
        result => result,
    }
}

/// Searches over the driving parameters of a construction plan; what is one exact step is decided by that, unless all is to be one search.
fn by_plan(
    problem: &Problem,
    options: &Options,
    wants_one_search: bool,
) -> Result<Complete, Unserved> {
    let begin = Instant::now();
    let targets = Targets::new(problem);
    let in_words =
        emptiness::too_long(&targets).map(|(edge, way)| outcome::too_long(problem, edge, &way));
    if !wants_one_search
        && in_words.is_none()
        && let Some(step) = exact::step(problem)
    {
        return Ok(Complete::by_one_step(problem, step, begin));
    }
    let pairs = targets.pairs();
    let plans = match (choose::plans(&targets, &pairs), &in_words) {
        (Ok(plans), None) => plans,
        // A reason in words needs no search, but a cover does.
        (Ok(plans), Some(_)) if options.cover => plans,
        (_, Some(reason)) => return Ok(Complete::empty(problem, reason.clone(), begin)),
        (Err(reason), None) => return Err(reason),
    };
    let stop = AtomicBool::new(false);
    let run = Run::new(&stop, options, options.cover);
    let store = options.opened(problem, options.cover)?;
    let result = options.watched(&run, begin, || match store {
        None => Ok(searched(&targets, &pairs, plans, &run)),
        Some((keep, store)) => kept(problem, (&targets, &pairs, plans), &run, keep, store),
    });
    match result.map_err(Unserved::Store)? {
        Ok((search, found)) => {
            let mut result = Complete::new(problem, &search, found, begin);
            if result.status == Status::Complete && in_words.is_some() {
                result.reason = in_words;
            }
            result.tell_what_is_left(&run);
            Ok(result)
        }
        Err(Unfit::Empty(point)) => {
            let name = &problem.points[point].name;
            let reason = format!("no figure has these distances: there is no place for {name}");
            Ok(Complete::empty(problem, reason, begin))
        }
        Err(Unfit::Large) => Err(Unserved::Large),
        Err(Unfit::Base | Unfit::Hinge) => Err(Unserved::NoBase),
    }
}

/// Runs the search, or goes on with it, with a store.
fn kept(
    problem: &Problem,
    (targets, pairs, plans): (&Targets, &Pairs, Vec<Plan>),
    run: &Run,
    keep: &Keep,
    mut store: Store<Found>,
) -> Result<Result<(Search, Found), Unfit>, String> {
    let search = match &store.head {
        // The plan that the parts were made by.
        Some(head) => match head
            .plan
            .clone()
            .filter(|plan| plan.serves(problem, targets.unit))
        {
            Some(plan) => Search::new(targets, pairs, plan),
            None => {
                return Err(store.at("its plan is not one of this problem; name another folder"));
            }
        },
        None => chosen(targets, pairs, plans, run).map(|(search, _)| search),
    };
    let search = match search {
        Ok(search) => search,
        Err(unfit) => return Ok(Err(unfit)),
    };
    // A choice that was broken off is no choice: another run might make another.
    if store.head.is_none() && run.stop.load(Ordering::Relaxed) {
        let found = search.run(run);
        return Ok(Ok((search, found)));
    }
    let outline = Outline::new(&search, run);
    let digest = outline.digest();
    let plan = Some(&search.plan);
    store.begin(Head::new(problem, plan, run.cover, digest), keep)?;
    let found = search.kept(run, outline, keep, store)?;
    Ok(Ok((search, found)))
}

/// Runs the search by the best plan.
fn searched(
    targets: &Targets,
    pairs: &Pairs,
    plans: Vec<Plan>,
    run: &Run,
) -> Result<(Search, Found), Unfit> {
    let (search, found) = chosen(targets, pairs, plans, run)?;
    let found = found.unwrap_or_else(|| search.run(run));
    Ok((search, found))
}

/// The best plan, and what was found if it came to an end in a trial.
fn chosen(
    targets: &Targets,
    pairs: &Pairs,
    plans: Vec<Plan>,
    run: &Run,
) -> Result<(Search, Option<Found>), Unfit> {
    let mut searches = Vec::new();
    let mut unfit = Unfit::Large;
    for plan in plans.into_iter().take(CANDIDATES) {
        match Search::new(targets, pairs, plan) {
            Ok(search) => searches.push(search),
            Err(Unfit::Empty(point)) => return Err(Unfit::Empty(point)),
            Err(other) => unfit = other,
        }
    }
    if searches.is_empty() {
        return Err(unfit);
    }
    let (order, best) = best_of(&searches);
    // Samples miss what is deep and narrow: the first plan that gets through with few parts wins.
    for budget in BUDGETS {
        for &which in &order {
            let trial = Run {
                boxes: AtomicU64::new(0),
                done: AtomicU64::new(0),
                before: AtomicU64::new(0),
                lost: AtomicU64::new(0),
                history: Mutex::default(),
                most_boxes: budget.min(run.most_boxes),
                ..*run
            };
            let found = searches[which].run(&trial);
            // What a search has looked at when it is through does not depend on the threads.
            if found.is_done() && found.boxes <= trial.most_boxes {
                return Ok((searches.swap_remove(which), Some(found)));
            }
        }
        if budget >= run.most_boxes {
            break;
        }
    }
    Ok((searches.swap_remove(best), None))
}

/// How many parts each of the best plans is tried for, before the one that samples say is best is run to its end.
const BUDGETS: [u64; 4] = [600, 3000, 15_000, 75_000];

/// Plans that are sampled at most.
const CANDIDATES: usize = 64;
/// The rounds of samples: how many plans take part, and how many ways down the tree of each.
const ROUNDS: [(usize, usize); 2] = [(CANDIDATES, 16), (16, 128)];
/// Plans that are tried.
const TRIED: usize = 3;

/// The plans to try: the one guessed to be best, then those that samples say are least work; and which of these
/// samples put first. Sampled are at first all plans by few ways, then the best ones by more.
fn best_of(searches: &[Search]) -> (Vec<usize>, usize) {
    let k = searches[0].plan.parameters();
    let mut order: Vec<usize> = (0..searches.len()).collect();
    match k {
        0 => order.truncate(1),
        1 => order.truncate(8),
        _ => {}
    }
    for (count, ways) in ROUNDS {
        order.truncate(count);
        if order.len() == 1 {
            break;
        }
        let ways = if k == 1 { 4 } else { ways };
        let mut sampled: Vec<(f64, usize)> = order
            .iter()
            .map(|&i| (searches[i].sample(ways), i))
            .collect();
        sampled.order_by(|a, b| a.0.total_cmp(&b.0));
        order = sampled.iter().map(|x| x.1).collect();
        if k == 1 {
            break;
        }
    }
    order.truncate(TRIED);
    let best = order[0];
    // The guess is often right where samples are not.
    order.retain(|&i| i != 0);
    order.insert(0, 0);
    (order, best)
}
