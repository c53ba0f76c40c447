//! All complex solutions of an instance: from those of a template.

use super::Same;
use super::boxes::{Found, SolutionBox, SolutionSet};
use super::count::{Counts, count};
use super::exact::Random;
use super::follow::{Effort, PathEnd, Ways, follow_all, prove_all};
use super::infinity::{Departure, enter};
use super::lower::Lowered;
use super::monodromy::bow;
use super::system::{Signs, System, segment};
use super::template::Template;
use crate::interval::DoubleDouble;
use crate::interval::complex::Complex;
use crate::places::Each as _;
use crate::problem::counted;
use std::time::Instant;

crate::named! {
    /// What is proved of a complex solution, and the conjugate of it.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Nature {
        /// It is real: its conjugate is in the same box, which holds one solution only.
        Real = "real",
        /// Its conjugate is congruent to it, and it is not real: some coordinates are real and some imaginary.
        SelfConjugate = "self-conjugate",
        /// Its conjugate is another solution, up to isometry: the one with this index.
        Pair(usize) = "pair",
        /// Its conjugate is none of the solutions found: some are missing.
        Alone = "alone",
        /// None of these could be proved.
        Unknown = "unknown",
    }
}

crate::named! {
    /// How much is proved about all solutions together.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
    pub enum Status {
        /// Every isolated complex solution is listed: with the figures at infinity there are as many as a proved bound allows.
        Complete = "complete",
        /// All paths came to solutions or went away, and no bound is known or met: there may be more.
        Found = "found",
        /// Some paths could not be followed to their ends: there may be more.
        #[default]
        Partial = "partial",
    }
}

/// The complex solutions of an instance.
#[derive(Debug, Clone, Default)]
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
    /// Figures at infinity, proved: so many fewer solutions there are than for other dimensions.
    pub departures: Vec<Departure>,
    /// Why other paths stopped.
    pub stopped: Vec<String>,
    /// Paths that came to a solution to which another path had come.
    pub repeated: usize,
    /// Solutions that no path came to: conjugates of others, which are solutions too, as dimensions are real.
    pub conjugates: usize,
    /// Whether every path was proved, step by step: otherwise paths were followed in floats, as asked for, or after proved
    /// ones that did not reach all ends.
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
    let mut found = Solutions {
        paths_proved: ways.proved,
        ..Solutions::default()
    };
    let starts: Vec<&SolutionBox> = template.solutions.boxes().iter().collect();
    let mut random = Random::new(0x5eed);
    let mut complete = false;
    for attempt in 0..=DETOURS {
        let bow = (attempt > 0).then(|| bow(system, &mut random));
        let rights = segment(&template.parameters, &target, bow.as_deref());
        let (ends, took) = follow_all(system, &rights, &starts, ways);
        found.effort.add(took);
        let known = found.boxes.len();
        found.take(lowered, ends);
        // What was found on one way stays proved; another way may come to what this one did not. In floats a path may have
        // jumped to another one's end, or not come back from afar.
        let all_came = found.stopped.is_empty()
            && (found.paths_proved || found.repeated == 0 && found.infinite.is_empty());
        let nothing_new = found.stopped.is_empty() && found.boxes.len() == known;
        complete = found.is_complete(lowered);
        if all_came || nothing_new || ways.is_over() || complete {
            break;
        }
    }
    let missing = !found.infinite.is_empty() || !found.stopped.is_empty();
    if ways.proved && missing && lowered.bound.is_some() && !complete && !ways.is_over() {
        // Floats go farther than proved tubes. What they come to is proved by itself, and the bound may be met with it.
        let floats = Ways {
            proved: false,
            ..*ways
        };
        let rights = segment(&template.parameters, &target, None);
        let (ends, took) = follow_all(system, &rights, &starts, &floats);
        found.effort.add(took);
        let mut farther = found.clone();
        farther.take(lowered, ends);
        if farther.figures() > found.figures() {
            complete = farther.is_complete(lowered);
            found = farther;
            found.paths_proved = false;
        }
    }
    found.status = if complete {
        // Whatever stopped: there is nothing else.
        Status::Complete
    } else if found.stopped.is_empty() {
        Status::Found
    } else {
        Status::Partial
    };
    found.counts = count(&found.boxes, system);
    found.natures = natures(&found.boxes, &system.group_of_instance);
    found.seconds = clock.elapsed().as_secs_f64();
    found
}

/// Adds the conjugates of solutions that are not in the set, each proved by itself. Tells how many.
fn add_conjugates(system: &System, set: &mut SolutionSet) -> usize {
    let group = &system.group_of_instance;
    let is_alone = |one: &&SolutionBox| set.find(one, group, true) == Found::New;
    let conjugate = |one: &SolutionBox| {
        let parts = one.middle().into_iter().enumerate();
        parts
            .map(|(k, x)| if k % 2 == 0 { x } else { -x })
            .collect()
    };
    let alone: Vec<Vec<DoubleDouble>> =
        set.boxes().iter().filter(is_alone).map(conjugate).collect();
    if alone.is_empty() {
        return 0;
    }
    let target = system.target();
    let rights = segment(&target, &target, None);
    let proved = prove_all(system, &rights, &alone, &Ways::default());
    let before = set.len();
    for one in proved.into_iter().flatten() {
        // What cannot be told from another one is none that is known.
        let _ = set.enter(one, group);
    }
    set.len() - before
}

/// The places of all points, where the unknowns have these real and imaginary parts.
fn places(system: &System, at: &[DoubleDouble]) -> Vec<[Complex<DoubleDouble>; 3]> {
    let coordinate = |unknown: Option<usize>| match unknown {
        Some(u) => Complex::new(at[2 * u], at[2 * u + 1]),
        None => Complex::default(),
    };
    let places = system.points.iter();
    places.map(|place| place.each(coordinate)).collect()
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
    /// Enters the ends of all paths of a way, and the conjugates of what is new.
    fn take(&mut self, lowered: &Lowered, ends: Vec<PathEnd>) {
        let system = &lowered.system;
        self.infinite.clear();
        self.stopped.clear();
        self.repeated = 0;
        // Solutions that this way has come to.
        let mut came = vec![false; self.boxes.len()];
        for end in ends {
            match end {
                PathEnd::Reached(found) => {
                    match self.boxes.find(&found, &system.group_of_instance, false) {
                        Found::New => {
                            self.boxes.push(found);
                            came.push(true);
                        }
                        Found::Old(index) => {
                            let again = std::mem::replace(&mut came[index], true);
                            self.repeated += usize::from(again);
                        }
                        Found::Unknown => self.stopped.push(
                            "two solutions are so near each other that their boxes cannot be told apart"
                                .to_owned(),
                        ),
                    }
                }
                PathEnd::Beyond(t, last) => {
                    self.infinite.push(t);
                    if let Some(graph) = &lowered.graph {
                        enter(graph, &places(system, &last), &mut self.departures);
                    }
                }
                PathEnd::Stopped(reason) => self.stopped.push(reason),
            }
        }
        self.conjugates += add_conjugates(system, &mut self.boxes);
    }

    /// How many solutions and figures at infinity are known.
    fn figures(&self) -> usize {
        self.boxes.len() + self.at_infinity()
    }

    /// Whether there are as many solutions, up to rotation, as a proved bound allows; figures at infinity are among those that
    /// it allows (see [`infinity`]), and none is congruent to its mirror image by a rotation.
    ///
    /// [`infinity`]: super::infinity
    fn is_complete(&self, lowered: &Lowered) -> bool {
        let counts = count(&self.boxes, &lowered.system);
        let Some(bound) = &lowered.bound else {
            return false;
        };
        // What somebody cites need not be a bound for all dimensions, with multiplicities.
        let at_infinity = match bound.is_cited {
            true => 0,
            false => 2 * self.at_infinity(),
        };
        let all = (counts.rotation + at_infinity) as u128;
        // More would disprove a bound that is proved.
        assert!(
            bound.is_cited || !counts.certain || all <= bound.count,
            "{all} solutions and figures at infinity are more than the bound of {}: a bug in krawl, and nothing of this is proved",
            bound.count
        );
        counts.certain && all == bound.count
    }

    /// How many figures at infinity are proved, up to isometry.
    pub fn at_infinity(&self) -> usize {
        self.departures.iter().map(|one| one.figures.len()).sum()
    }

    /// The indices of the solutions that are proved real.
    pub fn real(&self) -> impl Iterator<Item = usize> + '_ {
        let natures = self.natures.iter().enumerate();
        natures
            .filter(|(_, nature)| **nature == Nature::Real)
            .map(|(k, _)| k)
    }

    /// The counts in words, for solutions of this system.
    pub fn counts_in_words(&self, system: &System) -> String {
        let Counts {
            gauge,
            rotation,
            isometry,
            ..
        } = self.counts;
        let solutions = counted(isometry, "complex solution");
        if system.is_absolute {
            return match gauge == isometry {
                true => solutions,
                false => format!("{solutions}, {gauge} with directions reversed"),
            };
        }
        format!("{solutions} up to isometry, {rotation} up to rotation, {gauge} in the gauge")
    }
}
