//! All complex solutions of an instance: from those of a template.

use super::boxes::{Found, Same, SolutionBox, SolutionSet};
use super::count::{Counts, count};
use super::exact::Random;
use super::follow::{Effort, PathEnd, Ways, follow_all, prove_all};
use super::lower::Lowered;
use super::monodromy::bow;
use super::system::{Signs, System, segment};
use super::template::Template;
use crate::problem::counted;
use std::time::Instant;

/// What is proved of a complex solution, and the conjugate of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nature {
    /// It is real: its conjugate is in the same box, which holds one solution only.
    Real,
    /// Its conjugate is congruent to it, and it is not real: some coordinates are real and some imaginary.
    SelfConjugate,
    /// Its conjugate is another solution, up to isometry: the one with this index.
    Pair(usize),
    /// Its conjugate is none of the solutions found: some are missing.
    Alone,
    /// None of these could be proved.
    Unknown,
}

/// How much is proved about all solutions together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// Every isolated complex solution is listed: there are as many as a proved bound allows.
    Complete,
    /// All paths came to solutions or went away, and no bound is known or met: there may be more.
    Found,
    /// Some paths could not be followed to their ends: there may be more.
    Partial,
}

/// The complex solutions of an instance.
#[derive(Debug, Clone)]
pub struct Solutions {
    /// What is proved of them together.
    pub status: Status,
    /// Boxes with exactly one solution each, one of each class of congruent figures: disjoint, also from each
    /// other's images.
    pub boxes: SolutionSet,
    /// For each of them what its conjugate is.
    pub natures: Vec<Nature>,
    /// How many there are.
    pub counts: Counts,
    /// Paths that went beyond the radius allowed, with the greatest t at which they were proved.
    pub infinite: Vec<f64>,
    /// Why other paths stopped.
    pub stopped: Vec<String>,
    /// Paths that came to a solution to which another path had come.
    pub repeated: usize,
    /// Solutions that no path came to: conjugates of others, which are solutions too, as dimensions are real.
    pub conjugates: usize,
    /// Whether every path was proved, step by step.
    pub paths_proved: bool,
    /// What it took.
    pub effort: Effort,
    /// The time it took.
    pub seconds: f64,
}

/// Further ways from the template to the instance, where paths stopped on the straight one.
const DETOURS: usize = 2;

/// Takes the solutions of a template to an instance.
pub fn solve(lowered: &Lowered, template: &Template, ways: &Ways) -> Solutions {
    let clock = Instant::now();
    let system = &lowered.system;
    let target = system.target();
    let mut effort = Effort::default();
    let mut set = SolutionSet::default();
    let (mut infinite, mut stopped) = (Vec::new(), Vec::new());
    let (mut repeated, mut conjugates) = (0, 0);
    let starts: Vec<&SolutionBox> = template.solutions.boxes().iter().collect();
    let mut random = Random::new(0x5eed);
    for attempt in 0..=DETOURS {
        let bow = (attempt > 0).then(|| bow(system, &mut random));
        let rights = segment(&template.parameters, &target, bow.as_deref());
        let (ends, took) = follow_all(system, &rights, &starts, ways);
        effort.add(took);
        infinite.clear();
        stopped.clear();
        repeated = 0;
        let known = set.len();
        // Solutions that this way has come to.
        let mut came = vec![false; known];
        for end in ends {
            match end {
                PathEnd::Reached(found) => {
                    match set.find(&found, &system.group_of_instance, false) {
                        Found::New => {
                            set.push(found);
                            came.push(true);
                        }
                        Found::Old(index) => {
                            repeated += usize::from(std::mem::replace(&mut came[index], true));
                        }
                        Found::Unknown => stopped.push(
                            "two solutions are so near each other that their boxes cannot be told apart"
                                .to_owned(),
                        ),
                    }
                }
                PathEnd::Beyond(t) => infinite.push(t),
                PathEnd::Stopped(reason) => stopped.push(reason),
            }
        }
        // What was found on one way stays proved; another way may come to what this one did not. In floats a path may have
        // jumped to another one's end, or not come back from afar.
        let all_came = stopped.is_empty() && (ways.proved || repeated == 0 && infinite.is_empty());
        conjugates += add_conjugates(system, &mut set);
        let nothing_new = stopped.is_empty() && set.len() == known;
        if all_came || nothing_new || ways.is_over() || is_complete(lowered, &set) {
            break;
        }
    }
    let counts = count(&set, system);
    let natures = natures(&set, &system.group_of_instance);
    let status = if is_complete(lowered, &set) {
        // Whatever stopped: there is nothing else.
        Status::Complete
    } else if stopped.is_empty() {
        Status::Found
    } else {
        Status::Partial
    };
    Solutions {
        status,
        boxes: set,
        natures,
        counts,
        infinite,
        stopped,
        repeated,
        conjugates,
        paths_proved: ways.proved,
        effort,
        seconds: clock.elapsed().as_secs_f64(),
    }
}

/// Adds the conjugates of solutions that are not in the set, each proved by itself. Tells how many.
fn add_conjugates(system: &System, set: &mut SolutionSet) -> usize {
    let group = &system.group_of_instance;
    let is_alone = |one: &&SolutionBox| set.find(one, group, true) == Found::New;
    let alone: Vec<Vec<f64>> = set
        .boxes()
        .iter()
        .filter(is_alone)
        .map(|one| {
            let parts = one.figure.centre.iter().enumerate();
            parts
                .map(|(k, &x)| if k % 2 == 0 { x } else { -x })
                .collect()
        })
        .collect();
    if alone.is_empty() {
        return 0;
    }
    let target = system.target();
    let proved = prove_all(system, &segment(&target, &target, None), &alone);
    let before = set.len();
    for one in proved.into_iter().flatten() {
        if set.find(&one, group, false) == Found::New {
            set.push(one);
        }
    }
    set.len() - before
}

/// Whether there are as many solutions, up to rotation, as a proved bound allows.
fn is_complete(lowered: &Lowered, set: &SolutionSet) -> bool {
    let counts = count(set, &lowered.system);
    let bound = lowered.bound.as_ref();
    counts.certain && bound.is_some_and(|bound| counts.rotation as u128 == bound.count)
}

/// What the conjugates are. The parameters of an instance are real, so the conjugate of a solution is one too.
fn natures(set: &SolutionSet, group: &[Signs]) -> Vec<Nature> {
    let of = |(index, one): (usize, &SolutionBox)| {
        let identity = &group[0];
        match one.is_same(one, identity, true) {
            Same::Yes => return Nature::Real,
            Same::Unknown => return Nature::Unknown,
            Same::No => {}
        }
        match set.find(one, group, true) {
            Found::Old(other) if other == index => Nature::SelfConjugate,
            Found::Old(other) => Nature::Pair(other),
            Found::New => Nature::Alone,
            Found::Unknown => Nature::Unknown,
        }
    };
    set.boxes().iter().enumerate().map(of).collect()
}

impl Solutions {
    /// The indices of the solutions that are proved real.
    pub fn real(&self) -> impl Iterator<Item = usize> + '_ {
        let natures = self.natures.iter().enumerate();
        natures
            .filter(|(_, nature)| **nature == Nature::Real)
            .map(|(k, _)| k)
    }

    /// The counts in words.
    pub fn counts_in_words(&self) -> String {
        let Counts {
            gauge,
            rotation,
            isometry,
            ..
        } = self.counts;
        format!(
            "{} up to isometry, {rotation} up to rotation, {gauge} in the gauge",
            counted(isometry, "complex solution")
        )
    }
}
