//! What the search for all solutions reports.

use super::coordinates::leave;
use super::exact::{Nearly, Step};
use super::parts::Searched;
use super::search::{Run, Search, different};
use super::store::{Keep, Piece, Store};
use super::surplus::Tested;
use super::visit::{Found, Why};
use crate::certificate::cover::CoverVerdict;
use crate::constraint::Symmetry;
use crate::interval::vector::{cross, dot, minus, unit as direction};
use crate::interval::{Interval, around, point};
use crate::order::InOrder;
use crate::places::array;
use crate::problem::Problem;
use crate::track::{Signed, Solution};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::{Duration, Instant};

crate::named! {
    /// What is proved of the solutions listed.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Status {
        /// They are all.
        Complete = "complete",
        /// There may be more in the parts that are undecided.
        #[default]
        Partial = "partial",
        /// There may be more in the parts that are undecided, and through some of these goes a curve of
        /// solutions, as far as floats see.
        Flexible = "flexible",
    }
}

impl Status {
    /// Of a search that leaves these parts undecided.
    pub(super) fn of(undecided: &[Part]) -> Self {
        match undecided {
            [] => Status::Complete,
            parts if parts.iter().any(|part| part.why == Why::Flexible) => Status::Flexible,
            _ => Status::Partial,
        }
    }
}

/// Parts of the parameter space that are undecided for one reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Why.
    pub why: Why,
    /// How many parts.
    pub count: u64,
    /// Their share of the parameter space.
    pub share: f64,
}

/// Whether a search that leaves these parts undecided was ended before it came to all.
pub(super) fn is_open(undecided: &[Part]) -> bool {
    undecided.iter().any(|part| part.why == Why::Unfinished)
}

/// The share that a search which leaves these parts undecided did not come to.
pub(super) fn open_share(undecided: &[Part]) -> f64 {
    let parts = undecided.iter();
    let open = parts.filter(|part| part.why == Why::Unfinished);
    open.map(|part| part.share).sum()
}

/// All solutions of a problem, or what is known of them.
#[derive(Debug, Clone, Default)]
pub struct Complete {
    /// What is proved.
    pub status: Status,
    /// How the figures were searched.
    pub method: Method,
    /// Up to what figures are counted once.
    pub symmetry: Symmetry,
    /// How many figures are proved, which may be more than are listed as solutions; `None` where that has no place in 64
    /// bits.
    pub count: Option<u64>,
    /// Lines and planes of their own, by name, whose two directions constraints tell apart: figures with either are counted, so
    /// that what is on one side of them may be on the other.
    pub both_ways: Vec<String>,
    /// Rigid bodies on legs, by name, that were searched over how they are turned.
    pub turned: Vec<String>,
    /// The parts of a problem that falls apart, each with what was found of it; otherwise none.
    pub parts: Vec<Searched>,
    /// Where the equations fall apart into systems beside each other: those that have more than one solution. The figures are all combinations of theirs.
    pub choices: Vec<Choice>,
    /// Where they fall apart once something is decided that has more than one solution: what that is, and its number of solutions. The figures are, for each of these, all
    /// combinations of what the rest falls apart into.
    pub first_choice: Option<Choice>,
    /// The solutions in the problem's gauge and units (where `count` is more, only the first of them, whose boxes were not
    /// compared with those not listed; otherwise each box holding exactly one), the boxes disjoint, no
    /// two solutions congruent.
    pub solutions: Vec<Solution>,
    /// The points that are the gauge: those of the problem, or of the plan where those may be in line.
    pub reference: Vec<usize>,
    /// Of a problem with more constraints than unknowns: how the figures that were found stand to those that were left out. Figures that miss one
    /// are no solutions.
    pub tested: Option<Tested>,
    /// Of a problem that asks for signs: what came of the figures by these.
    pub signed: Option<Signed>,
    /// What is undecided, by reasons.
    pub undecided: Vec<Part>,
    /// Why there is no solution, where that can be said in words; or what stands in the way of the claim.
    pub reason: Option<String>,
    /// Parts of the parameter space looked at.
    pub boxes: u64,
    /// Driving parameters of the plan.
    pub driving: usize,
    /// Of a search over coordinates: the largest block that was searched by constructing its unknowns as functions of a few of them, wherever they are
    /// bounded.
    pub constructed: Option<Constructed>,
    /// Of a search among all complex solutions: how many these are.
    pub complex: Option<usize>,
    /// The order in which the plan places the points.
    pub plan: Vec<usize>,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Of a search that was ended: how many seconds the rest of it may take, if it goes on as in the second half of its time; infinity
    /// where a store keeps nothing of what was done. Otherwise `None`, and where less than a thousandth of the rest was done in that half.
    pub seconds_left: Option<f64>,
    /// The cover of the search space, if it was wanted and there was a search.
    pub cover: Option<Vec<u8>>,
}

impl Complete {
    /// Takes over what the check of the [cover](Complete::cover) proves: it parts the space anew, and may decide what the search left
    /// open. True if the result is complete by that, and was not.
    pub fn settle(&mut self, verdict: &CoverVerdict) -> bool {
        // The cover is of the constraints used.
        let count = self
            .tested
            .as_ref()
            .map_or(self.count, |tested| tested.found);
        let count = self.signed.map_or(count, |signed| Some(signed.found));
        let same = count.is_some() && verdict.solutions == count;
        let settles = self.status != Status::Complete && verdict.proves_all() && same;
        if settles {
            // The cover says nothing of signs.
            self.undecided.retain(|part| part.why == Why::Sign);
            (self.reason, self.seconds_left) = (None, None);
            if self.undecided.is_empty() {
                self.status = Status::Complete;
            }
        }
        settles && self.status == Status::Complete
    }
}

/// Unknowns that are constructed, step by step, as functions of a few of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Constructed {
    /// How many they are.
    pub unknowns: usize,
    /// How many of them drive the construction, where no coefficient vanishes.
    pub parameters: usize,
}

/// What is placed in one of several ways, whatever else there is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Choice {
    /// The points and objects that are placed, beside what they hang on.
    pub names: Vec<String>,
    /// In how many ways.
    pub count: usize,
}

/// Why a problem cannot be searched.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Unserved {
    /// No base.
    #[error(
        "not served yet: the search begins with two joined points in the plane, or three mutually joined \
         points in space that are not in line, and there are none"
    )]
    NoBase,
    /// Too many parameters.
    #[error(
        "not served yet: every construction plan needs more than {} driving parameters, and the work grows \
         exponentially with their number",
        super::choose::MOST_PARAMETERS
    )]
    TooManyParameters,
    /// Too large.
    #[error(
        "not served yet: the problem has more than 250 points, or more than 64 with two places each"
    )]
    Large,
    /// The store cannot be used.
    #[error("{0}")]
    Store(String),
    /// What was asked for cannot be had of this problem: why.
    #[error("{0}")]
    Refused(String),
}

crate::named! {
    /// How the figures were searched.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
    pub enum Method {
        /// Over the driving parameters of a construction plan.
        #[default]
        Plan = "plan",
        /// Over all coordinates.
        Coordinates = "coordinates",
        /// Block by block, the blocks put together.
        Blocks = "blocks",
        /// Among all complex solutions, as many as Bézout's bound allows.
        Complex = "complex",
    }
}

/// Where a search is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The share of the parameter space that is done.
    pub share: f64,
    /// What of the share earlier runs did that left it in a store.
    pub before: f64,
    /// Parts looked at.
    pub boxes: u64,
}

/// What a search may take, and whom it tells.
#[derive(Clone)]
pub struct Options<'a> {
    /// Ends the search from outside.
    pub cancel: Option<&'a AtomicBool>,
    /// Ends the search after so long.
    pub time: Option<Duration>,
    /// Ends the search after so many parts.
    pub most_boxes: u64,
    /// Whether the cover of the search space is kept, for whoever wants to check it.
    pub cover: bool,
    /// Threads; 0 for one per processor.
    pub threads: usize,
    /// Where parts that are done are kept.
    pub store: Option<Keep>,
    /// Whether parts that are no figure for the last digits of a distance alone are taken for flat ones, which meet it within these. They
    /// are so in the result's [`Tested`].
    pub within_digits: bool,
    /// Within what constraints that are left out of a search of all coordinates count as met, where that is not told by the digits of their numbers.
    pub redundant_tolerance: Option<f64>,
    /// Told now and then where the search is.
    #[allow(clippy::type_complexity)]
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options {
            cancel: None,
            time: None,
            most_boxes: 4_000_000_000,
            cover: false,
            threads: 0,
            store: None,
            within_digits: false,
            redundant_tolerance: None,
            progress: None,
        }
    }
}

/// Tells a thread that it is over when it is dropped, and wakes it up.
struct AtTheEnd<'a>(&'a AtomicBool, Thread);

impl Drop for AtTheEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        self.1.unpark();
    }
}

impl Options<'_> {
    /// Opens the store that is wanted, if one is. `cover`: whether parts are kept with their covers.
    pub(super) fn opened<F: Piece>(
        &self,
        problem: &Problem,
        cover: bool,
    ) -> Result<Option<(&Keep, Store<F>)>, Unserved> {
        let open = |keep| Store::open(keep, problem, cover).map(|store| (keep, store));
        let opened = self.store.as_ref().map(open).transpose();
        opened.map_err(Unserved::Store)
    }

    /// Runs a search on as many threads as wanted, beside one that looks at the clock.
    pub(super) fn watched<T: Send>(
        &self,
        run: &Run,
        begin: Instant,
        search: impl FnOnce() -> T + Send,
    ) -> T {
        let pooled = || {
            if self.threads == 0 {
                return search();
            }
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(self.threads)
                .build();
            match pool {
                Ok(pool) => pool.install(search),
                Err(_) => search(),
            }
        };
        if self.cancel.is_none() && self.time.is_none() && self.progress.is_none() {
            return pooled();
        }
        let ended = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let watch = scope.spawn(|| {
                while !ended.load(Ordering::Relaxed) {
                    std::thread::park_timeout(Duration::from_millis(20));
                    let cancelled = self.cancel.is_some_and(|c| c.load(Ordering::Relaxed));
                    if cancelled || self.time.is_some_and(|most| begin.elapsed() > most) {
                        run.stop.store(true, Ordering::Relaxed);
                    }
                    run.note(begin.elapsed().as_secs_f64());
                    if let Some(tell) = self.progress {
                        tell(Progress {
                            share: run.share_done(),
                            before: run.share_before(),
                            boxes: run.boxes.load(Ordering::Relaxed),
                        });
                    }
                }
            });
            // Also where the search panics: else the thread above would never end.
            let _at_the_end = AtTheEnd(&ended, watch.thread().clone());
            pooled()
        })
    }
}

impl Complete {
    /// Whether the search was ended before it came to all.
    pub fn was_ended(&self) -> bool {
        is_open(&self.undecided)
    }

    /// Of a search that was ended: how long the rest may take.
    pub(super) fn tell_what_is_left(&mut self, run: &Run) {
        self.seconds_left = match self.was_ended() {
            true => run.seconds_left(self.seconds),
            false => None,
        };
    }

    /// No solution, for a reason that needs no search.
    pub(super) fn empty(problem: &Problem, reason: String, begin: Instant) -> Self {
        Complete {
            status: Status::Complete,
            count: Some(0),
            reference: problem.homotopy.reference.clone(),
            reason: Some(reason),
            seconds: begin.elapsed().as_secs_f64(),
            ..Complete::default()
        }
    }

    /// What one exact step says.
    pub(super) fn by_one_step(problem: &Problem, step: Step, begin: Instant) -> Self {
        let mut result = Complete::empty(problem, String::new(), begin);
        result.boxes = 1;
        result.plan.clone_from(&result.reference);
        let others = (0..problem.points.len()).filter(|p| !result.reference.contains(p));
        result.plan.extend(others);
        match step {
            Step::Nowhere { point, height } => {
                let of = |points: &[usize]| {
                    let names = points.iter().map(|&p| problem.points[p].name.as_str());
                    names.collect::<Vec<_>>().join(", ")
                };
                let squared = height.to_f64();
                result.reason = Some(format!(
                    "no figure has these distances: {} has no place, as the square of its height over {} would be {squared:.1e}, computed exactly",
                    of(&[point]),
                    of(&result.reference)
                ));
            }
            Step::Figure { points, is_flat } => {
                (result.count, result.reason) = (Some(1), None);
                result.solutions.push(Solution {
                    is_degenerate: is_flat,
                    ..Solution::placed(points, 0)
                });
            }
        }
        result
    }

    /// A flat figure that has all distances but one, which it meets within its digits.
    pub(super) fn nearly(problem: &Problem, near: Nearly, begin: Instant) -> Self {
        let (points, is_flat) = (near.points, true);
        let mut result = Complete::by_one_step(problem, Step::Figure { points, is_flat }, begin);
        let names = vec![near.left_out.name.clone()];
        result.strike_out(
            problem,
            [problem.distances.len() - 1, 1],
            names,
            vec![vec![near.left_out]],
        );
        if let Some(tested) = &mut result.tested {
            tested.added.push(near.held);
        }
        result
    }

    /// From what a search found.
    pub(super) fn new(problem: &Problem, search: &Search, found: Found, begin: Instant) -> Self {
        let dimension = problem.dimension;
        let mut reason = None;
        let mut undecided = found.undecided;
        undecided.order_by_key(|part| part.why);
        let is_searched = undecided.is_empty();
        let figures = different(&found.figures, dimension);
        let apart = figures.is_err();
        let figures = figures.unwrap_or_default();
        let cover = super::cover::file(problem, search, &figures, found.marks);
        let mut solutions = Vec::new();
        let mut reference = problem.homotopy.reference.clone();
        for reference_tried in [&problem.homotopy.reference, &search.plan.base] {
            solutions = figures
                .iter()
                .map_while(|figure| in_gauge(figure, search, reference_tried))
                .collect();
            reference.clone_from(reference_tried);
            if solutions.len() == figures.len() {
                break;
            }
        }
        for (class, solution) in solutions.iter_mut().enumerate() {
            solution.class = class;
        }
        let mut disjoint = true;
        for (i, one) in solutions.iter().enumerate() {
            disjoint &= solutions[..i].iter().all(|other| are_apart(one, other));
        }
        let mut status = Status::Complete;
        if apart || !disjoint {
            status = Status::Partial;
            reason = Some("two solutions are too close to each other to be told apart".to_owned());
            if apart {
                solutions.clear();
                leave(&mut undecided, Why::Apart, 1, 0.0);
            }
        }
        if !is_searched {
            status = Status::of(&undecided);
        }
        if status == Status::Complete && solutions.is_empty() {
            reason = Some(
                "no figure has these distances: every part of the parameter space is excluded"
                    .to_owned(),
            );
        }
        let order = search.plan.base.iter().copied();
        Complete {
            status,
            count: Some(solutions.len() as u64),
            solutions,
            signed: Signed::cut(found.cut),
            reference,
            undecided,
            reason,
            boxes: found.boxes,
            driving: search.plan.parameters(),
            plan: order
                .chain(search.plan.steps.iter().map(|s| s.point))
                .collect(),
            cover,
            ..Complete::empty(problem, String::new(), begin)
        }
    }
}

/// "No figure has these lengths: …"
pub(super) fn too_long(problem: &Problem, edge: usize, way: &[usize]) -> String {
    let name = |p: usize| problem.points[p].name.as_str();
    let parts: Vec<String> = way
        .windows(2)
        .map(|w| format!("{}-{}", name(w[0]), name(w[1])))
        .collect();
    let (last, before) = parts.split_last().expect("a way has two parts at least");
    format!(
        "no figure has these lengths: {} is longer than {} and {last} together",
        problem.distance_name(edge),
        before.join(", ")
    )
}

pub(super) fn are_apart(one: &Solution, other: &Solution) -> bool {
    let pairs = one
        .points
        .iter()
        .flatten()
        .zip(other.points.iter().flatten());
    pairs
        .into_iter()
        .any(|(a, b)| a.sup() < b.inf() || b.sup() < a.inf())
}

/// A figure's box seen from reference points, in the problem's units. `None` if these may be in line.
fn in_gauge(
    figure: &crate::certificate::cover::Figure,
    search: &Search,
    reference: &[usize],
) -> Option<Solution> {
    let d = search.targets.dimension;
    let zero = point(0.0);
    let base = &search.plan.base;
    let place = |p: usize| -> [Interval; 3] {
        let order = base.iter().position(|&b| b == p).unwrap_or(d);
        array(|k| {
            if k >= order.min(d) {
                return zero;
            }
            around(figure.centre[p][k], figure.radius)
        })
    };
    let unit = point(search.targets.unit);
    let same = reference == base.as_slice();
    let origin = place(reference[0]);
    let from = |p: usize| minus(place(p), origin);
    let (e1, e2, e3);
    if same {
        e1 = [point(1.0), zero, zero];
        e2 = [zero, point(1.0), zero];
        e3 = [zero, zero, point(1.0)];
    } else {
        e1 = direction(from(reference[1]))?;
        if d == 2 {
            e2 = [-e1[1], e1[0], zero];
            e3 = [zero, zero, point(1.0)];
        } else {
            e3 = direction(cross(e1, from(reference[2])))?;
            e2 = cross(e3, e1);
        }
    }
    let points = (0..search.targets.points)
        .map(|p| {
            let v = from(p);
            let order = reference.iter().position(|&r| r == p).unwrap_or(d);
            let axes = [e1, e2, e3];
            array(|k| {
                if k < order.min(d) {
                    dot(axes[k], v) * unit
                } else {
                    zero
                }
            })
        })
        .collect();
    Some(Solution::placed(points, 0))
}
