//! More distances than free coordinates: all figures that have as many of them as are needed are searched, and each is tested against
//! those that were left out.
//!
//! A figure that has all distances has those used, so that it is among the figures of these. What a box that holds one figure says of a
//! distance that was left out is an enclosure of how far it is missed: within what counts as met, surely beyond it (then it is no figure
//! of the problem), or neither.

use super::{Complete, Options, Unserved, all};
use crate::blocks::{Account, LeftOut, MOST_POINTS, Ruler, Verdict, Whose};
use crate::interval::{Interval, point};
use crate::linalg::Span;
use crate::order::add_new;
use crate::places::Each as _;
use crate::problem::{Distance, Problem, Target, free_coordinates, rigidity, rigidity_row};
use crate::system::typical_length;
use crate::track::{Mode, Outcome};
use serde::{Deserialize, Deserializer, Serialize};

/// A distance that was left out of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct Spare {
    /// What people call it.
    pub name: String,
    /// Between which points it is, and how long it is to be.
    pub distance: Distance,
    /// It counts as met where it is missed by no more than this.
    pub epsilon: f64,
}

/// A figure with more distances than free coordinates.
#[derive(Debug, Clone)]
pub struct Surplus {
    /// The same with as many as are needed.
    pub problem: Problem,
    /// Those that were left out.
    pub spare: Vec<Spare>,
    /// What the problem says beside that, though nobody asked for it.
    pub added: Vec<String>,
}

/// What came of the figures that have the distances used.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Tested {
    /// How many distances (or equations) were used, and how many there are.
    pub used: usize,
    /// Of so many.
    #[serde(rename = "of")]
    pub all: usize,
    /// What is counted: constraints, or equations, of which a constraint may have several.
    #[serde(skip)]
    pub what: &'static str,
    /// How many figures have those used; `None`: more than have a place in 64 bits.
    pub found: Option<u64>,
    /// How many of the figures that were tested meet all others.
    pub met: usize,
    /// How many were proved to miss one. They are no solutions.
    pub missed: usize,
    /// Each of these misses one by at least this; infinity where there are none.
    #[serde(rename = "missed_by", deserialize_with = "infinity")]
    pub by: f64,
    /// All of those that meet them do so within this; minus infinity where there are none.
    #[serde(deserialize_with = "minus_infinity")]
    pub within: f64,
    /// Of how many it is not decided.
    pub undecided: usize,
    /// For each solution how it stands to what was left out.
    #[serde(skip)]
    pub figures: Vec<Vec<LeftOut>>,
    /// What was left out, by name.
    pub left_out: Vec<String>,
    /// What was held beside.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub added: Vec<String>,
}

/// JSON has no infinities, and `null` in their place.
fn infinity<'de, D: Deserializer<'de>>(number: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(number)?.unwrap_or(f64::INFINITY))
}

fn minus_infinity<'de, D: Deserializer<'de>>(number: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(number)?.unwrap_or(f64::NEG_INFINITY))
}

impl Tested {
    /// Whether each figure is proved to meet all that was left out, or to miss something of it.
    pub fn is_decided(&self) -> bool {
        let tested = (self.met + self.missed + self.undecided) as u64;
        self.left_out.is_empty() || self.undecided == 0 && self.found == Some(tested)
    }

    /// Before any figure is looked at: how many constraints are used and how many not, how many figures have those used, what was left out.
    fn begin([used, spare]: [usize; 2], found: Option<u64>, left_out: Vec<String>) -> Self {
        Tested {
            used,
            all: used + spare,
            what: "constraints",
            found,
            by: f64::INFINITY,
            within: f64::NEG_INFINITY,
            left_out,
            ..Tested::default()
        }
    }

    /// Counts a figure by how it stands to what was left out, and keeps that if the figure is a solution: it is none if it was proved to miss something.
    fn is_solution(&mut self, figure: Vec<LeftOut>) -> bool {
        let all = figure.iter().map(|one| one.verdict);
        match all.fold(Verdict::Follows, Verdict::and) {
            Verdict::Missed { by } | Verdict::MissedBySome { by } => {
                self.missed += 1;
                self.by = self.by.min(by);
                return false;
            }
            Verdict::Met { within } => {
                self.met += 1;
                self.within = self.within.max(within);
            }
            Verdict::Undecided { .. } | Verdict::NotLookedAt => self.undecided += 1,
            Verdict::Follows => {
                self.met += 1;
                self.within = self.within.max(0.0);
            }
        }
        self.figures.push(figure);
        true
    }
}

impl Surplus {
    /// Of a problem of more distances than are needed, and nothing else. What is left out is what says nothing new in the sketch beside
    /// those [chosen](Span::choose), and after these what says nothing new in a figure whose distances may be any. `None`: there are no more than needed, or
    /// they do not hold the figure, or it has more than [`MOST_POINTS`] points. `tolerance`: within what a distance counts as met,
    /// where that is not half a unit of the last digit it is given with.
    pub fn of(problem: &Problem, tolerance: Option<f64>) -> Option<Self> {
        let (d, n) = (problem.dimension, problem.points.len());
        let needed = free_coordinates(d, n);
        let edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
        let may_be = problem.is_distances_only() && n <= MOST_POINTS && edges.len() > needed;
        if !may_be || rigidity(d, n, &edges).rank < needed {
            return None;
        }
        let places = problem.places();
        let rows = edges.iter().map(|&edge| rigidity_row(d, &places, edge));
        let rows: Vec<Vec<f64>> = rows.collect();
        let mut is_used = Span::default().choose(&rows, needed);
        for e in 0..edges.len() {
            if is_used.iter().filter(|used| **used).count() == needed {
                break;
            }
            is_used[e] = true;
            let used = edges.iter().zip(&is_used).filter(|(_, used)| **used);
            let used: Vec<[usize; 2]> = used.map(|(edge, _)| *edge).collect();
            is_used[e] = rigidity(d, n, &used).rank == used.len();
        }
        let unit = typical_length(problem);
        let spare = (0..edges.len()).filter(|&e| !is_used[e]).map(|e| Spare {
            name: problem.distance_name(e),
            distance: problem.distances[e].clone(),
            epsilon: Ruler::new(problem, Whose::Distance(e), (unit, 1), tolerance).epsilon,
        });
        let mut used = is_used.iter();
        Some(Surplus {
            spare: spare.collect(),
            problem: problem.with_distances(|_| used.next().copied().unwrap_or(false))?,
            added: Vec::new(),
        })
    }

    /// Takes the distance that may be missed by no more than this for met.
    pub fn with_tolerance(mut self, tolerance: Option<f64>) -> Self {
        for spare in &mut self.spare {
            spare.epsilon = tolerance.unwrap_or(spare.epsilon);
        }
        self
    }

    /// Searches all figures, and tests them: those that were proved to miss a distance are no solutions.
    pub fn search(&self, options: &Options) -> Result<Complete, Unserved> {
        let mut used = self.problem.clone();
        if options.cover {
            // A certificate has nothing else that says so.
            let given = self.used() + self.spare.len();
            used.name += &format!(" (with {} of its {given} constraints)", self.used());
        }
        let mut result = all(&used, options)?;
        let figures = result.solutions.iter();
        let figures: Vec<Vec<LeftOut>> =
            figures.map(|figure| self.account(&figure.points)).collect();
        result.strike_out(
            &self.problem,
            [self.used(), self.spare.len()],
            self.names(),
            figures,
        );
        if let Some(tested) = &mut result.tested {
            tested.added.extend(self.added.iter().cloned());
        }
        Ok(result)
    }

    /// Tests the solutions of a path on which the distances used were led to what they are to be: those that were proved to miss one of the
    /// others are no solutions, and are taken out.
    pub fn test(&self, outcome: &mut Outcome) -> Tested {
        let found = Some(outcome.solutions.len() as u64);
        let mut tested = Tested::begin([self.used(), self.spare.len()], found, self.names());
        tested.added.clone_from(&self.added);
        if outcome.mode == Mode::Float {
            // Nothing is known of floats.
            tested.undecided = outcome.solutions.len();
            return tested;
        }
        let mut places = Vec::new();
        for solution in std::mem::take(&mut outcome.solutions) {
            let is_one = tested.is_solution(self.account(&solution.points));
            places.push(is_one.then_some(outcome.solutions.len()));
            if is_one {
                outcome.solutions.push(solution);
            }
        }
        // A mirror image has the same distances.
        for solution in &mut outcome.solutions {
            solution.mirror_of = solution.mirror_of.and_then(|other| places[other]);
        }
        tested
    }

    /// How many distances and other constraints are used.
    fn used(&self) -> usize {
        self.problem.distances.len() + self.problem.constraints.len()
    }

    /// What was left out, by name.
    fn names(&self) -> Vec<String> {
        self.spare.iter().map(|spare| spare.name.clone()).collect()
    }

    /// Adds to what is said of figures what was left out of them before anything was followed: how `figure`, the one that is printed, stands to it,
    /// or, where there is none, that nothing is proved of it.
    pub fn add_to(&self, account: &mut Account, figure: Option<&[[Interval; 3]]>) {
        if account.equations == 0 {
            account.equations = self.used();
        }
        for added in &self.added {
            add_new(&mut account.added, added.clone());
        }
        let verdicts: Vec<Verdict> = match figure {
            Some(figure) => self.account(figure).iter().map(|one| one.verdict).collect(),
            None => vec![Verdict::NotLookedAt; self.spare.len()],
        };
        for (spare, verdict) in self.spare.iter().zip(verdicts) {
            account.leave_out_beside(format!("`{}`", spare.name), verdict);
        }
    }

    /// How a figure stands to each distance that was left out.
    fn account(&self, figure: &[[Interval; 3]]) -> Vec<LeftOut> {
        let mut account = Account::default();
        for spare in &self.spare {
            let [a, b] = spare.distance.points.each(|p| figure[p]);
            let verdict = Verdict::of(miss(a, b, &spare.distance.target), spare.epsilon);
            account.leave_out(spare.name.clone(), verdict);
        }
        account.left_out
    }
}

/// Of two points the distance less the one wanted: |p − q| − d = (|p − q|² − d²)/(|p − q| + d).
fn miss(a: [Interval; 3], b: [Interval; 3], target: &Target) -> Interval {
    let squared = (0..3).fold(point(0.0), |sum, k| sum + (a[k] - b[k]).sqr());
    (squared - target.enclose_squared()) / (squared.sqrt() + target.enclose())
}

impl Complete {
    /// Takes the figures out that were proved to miss a constraint that was left out, beside those that were before. `figures`: how each stands
    /// to these. Signs that the problem asks for come first: those without them are not looked at.
    pub(super) fn strike_out(
        &mut self,
        problem: &Problem,
        [used, spare]: [usize; 2],
        left_out: Vec<String>,
        mut figures: Vec<Vec<LeftOut>>,
    ) {
        let mut is_kept = self.choose_signed(problem).into_iter();
        figures.retain(|_| is_kept.next().unwrap_or(true));
        let before = self.tested.take().unwrap_or_default();
        let gone = before.left_out.len();
        let left_out = [before.left_out, left_out].concat();
        let mut tested = Tested::begin([used - gone, spare + gone], self.count, left_out);
        tested.added = before.added;
        let mut before = before.figures.into_iter();
        let figures = figures.into_iter().map(|figure| {
            let first = before.next().unwrap_or_default();
            [first, figure].concat()
        });
        let solutions = std::mem::take(&mut self.solutions);
        for (mut solution, figure) in solutions.into_iter().zip(figures) {
            if !tested.is_solution(figure) {
                continue;
            }
            solution.class = self.solutions.len();
            self.solutions.push(solution);
        }
        self.count = self.count.map(|count| count - tested.missed as u64);
        self.tested = Some(tested);
    }
}
