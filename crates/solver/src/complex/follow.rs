//! Following solutions while the parameters move from one place to another.

use super::boxes::SolutionBox;
use super::ends::EndProver;
use super::float::{FloatEnd, FloatFollower};
use super::system::System;
use crate::interval::DoubleDouble;
use crate::system::{Homotopy, Right};
use crate::track::arc::ArcEnd;
use crate::track::certified::{FollowArcs, arcs};
use crate::track::{Control, Limit, Options, Space};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// How a path ended.
#[derive(Debug, Clone)]
pub enum PathEnd {
    /// At t = 1, in a box with exactly one solution, which is the continuation of the one at t = 0 if paths are proved.
    Reached(SolutionBox),
    /// It was followed up to this t < 1, where an unknown is larger than the radius allowed, and where it was near this
    /// point: real and imaginary part of every unknown in turn.
    Beyond(f64, Vec<DoubleDouble>),
    /// It could not be followed to its end: why.
    Stopped(String),
}

/// What all paths took together.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Effort {
    /// Paths followed.
    pub paths: usize,
    /// Tubes proved.
    pub tubes: usize,
    /// Tubes tried in vain.
    pub rejected: usize,
    /// Steps in floats.
    pub steps: usize,
    /// Those of them that were in double-doubles.
    pub double_steps: usize,
}

impl Effort {
    /// Adds what others took.
    pub fn add(&mut self, other: Effort) {
        self.paths += other.paths;
        self.tubes += other.tubes;
        self.rejected += other.rejected;
        self.steps += other.steps;
        self.double_steps += other.double_steps;
    }
}

/// How to follow paths.
#[derive(Clone, Copy)]
pub struct Ways<'a> {
    /// Whether every step of a path is proved. Otherwise paths are followed in floats, and may jump from one to another;
    /// what they come to is proved all the same.
    pub proved: bool,
    /// Beyond this size of an unknown, in units of the typical length, a path is given up as one to infinity. In floats
    /// only if it cannot be followed to its end, as it may come back.
    pub radius: f64,
    /// A path that takes more tubes is given up.
    pub most_tubes: usize,
    /// Whether extended precision may be switched on, which takes long.
    pub extended: bool,
    /// Set from outside to end all paths.
    pub cancel: Option<&'a AtomicBool>,
    /// When to give up.
    pub deadline: Option<Instant>,
    /// Called now and then with the number of paths done, of how many.
    pub progress: Option<&'a (dyn Fn(usize, usize) + Sync)>,
}

impl Default for Ways<'_> {
    fn default() -> Self {
        Ways {
            proved: true,
            radius: 1000.0,
            most_tubes: 20_000,
            extended: true,
            cancel: None,
            deadline: None,
            progress: None,
        }
    }
}

impl Ways<'_> {
    /// Whether the time is over, or somebody asked to stop.
    pub fn is_over(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
            || self.deadline.is_some_and(|end| Instant::now() > end)
    }
}

/// Follows paths of one system, one after the other, setting nothing up twice.
#[derive(Debug)]
pub struct Follower {
    system: System,
    arcs: Box<dyn FollowArcs>,
    /// Made where the tracker's own proof of an end fails.
    ends: Option<EndProver>,
}

/// Boxes that are wider, in typical lengths, are tried again with more digits, as they have to be told apart.
const NARROW: f64 = 1e-8;
/// A path that is longer than so many radii is given up.
const LONGEST: f64 = 20.0;

impl Follower {
    /// For a homotopy made by [`System::homotopy`] of this system.
    pub fn new(system: &System, mut homotopy: Homotopy, rights: &[Right], ways: &Ways) -> Self {
        homotopy.rights = rights.to_vec();
        let options = Options {
            space: Space::Full,
            max_steps: ways.most_tubes,
            extended: ways.extended,
            ..Options::certified()
        };
        let mut arcs = arcs(homotopy, &options);
        arcs.set_complex();
        Follower {
            system: system.clone(),
            arcs,
            ends: None,
        }
    }

    /// Follows the path of one solution, proving every step.
    pub fn follow(&mut self, start: &SolutionBox, ways: &Ways, effort: &mut Effort) -> PathEnd {
        let far = Instant::now() + Duration::from_secs(1_000_000);
        let mut control = Control {
            cancel: ways.cancel,
            limit: Some(Limit {
                length: LONGEST * ways.radius,
                deadline: ways.deadline.unwrap_or(far),
            }),
            ..Control::default()
        };
        let run = self.arcs.follow(&start.figure, &mut control);
        effort.add(Effort {
            paths: 1,
            tubes: run.steps,
            rejected: run.rejected,
            ..Effort::default()
        });
        let size = run.last.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        match run.end {
            ArcEnd::Reached(figure) => PathEnd::Reached(SolutionBox::new(figure, run.alone_within)),
            _ if size > ways.radius => {
                let last = run.last.iter().map(|&x| x.into()).collect();
                PathEnd::Beyond(run.t.0, last)
            }
            ArcEnd::Limit(_) => PathEnd::Stopped("the path turns back in t".to_owned()),
            ArcEnd::Passes(stop) | ArcEnd::Stopped(stop) => PathEnd::Stopped(stop.text),
        }
    }

    /// Follows the path of one solution in floats, and proves a box around what it comes to.
    fn follow_in_floats(
        &mut self,
        floats: &mut FloatFollower<'_>,
        start: &SolutionBox,
        ways: &Ways,
        effort: &mut Effort,
    ) -> PathEnd {
        let [steps, double_steps] = floats.steps;
        let end = floats.follow(&start.middle(), ways.radius, ways.most_tubes);
        effort.add(Effort {
            paths: 1,
            steps: floats.steps[0] - steps,
            double_steps: floats.steps[1] - double_steps,
            ..Effort::default()
        });
        match end {
            FloatEnd::Reached(near) => self
                .prove(&near)
                .map_or_else(PathEnd::Stopped, PathEnd::Reached),
            FloatEnd::Beyond(t, last) => PathEnd::Beyond(t, last),
            FloatEnd::Stopped(t, size) => {
                // Near the end it matters how near.
                let at = match 1.0 - t {
                    left if left < 1e-3 => format!("1 - {left:.1e}"),
                    _ => format!("{t:.4}"),
                };
                PathEnd::Stopped(format!(
                    "in floats the path cannot be followed beyond t = {at}, where the largest unknown is {size:.1e} typical \
                     lengths"
                ))
            }
        }
    }

    /// Proves a box around the solution near a point, for the parameters at t = 1: real and imaginary part of every
    /// unknown in turn.
    pub fn prove(&mut self, near: &[DoubleDouble]) -> Result<SolutionBox, String> {
        let rounded: Vec<f64> = near.iter().map(|x| x.hi).collect();
        let proved = self.arcs.prove_at_end(&rounded);
        let found = proved.map(|(figure, alone)| SolutionBox::new(figure, alone));
        if let Ok(found) = &found
            && found.radius() < NARROW
        {
            return Ok(found.clone());
        }
        let (system, rights) = (&self.system, &self.arcs.homotopy_mut().rights);
        let make = || EndProver::new(system, rights);
        let better = self.ends.get_or_insert_with(make).prove(near);
        match (found, better) {
            (Ok(found), Ok(better)) if found.radius() < better.radius() => Ok(found),
            (Ok(found), Err(_)) => Ok(found),
            (_, better) => better,
        }
    }
}

/// Why what was not begun was not done.
const OVER: &str = "the time was over, or it was interrupted";

/// How many paths one follower takes, of all: setting it up costs as much as a few tubes.
fn piece(count: usize) -> usize {
    count.div_ceil(4 * rayon::current_num_threads()).max(1)
}

/// Follows the paths of many solutions on all threads of the pool, as `ways` says. Results come in the solutions' order.
pub fn follow_all(
    system: &System,
    rights: &[Right],
    starts: &[&SolutionBox],
    ways: &Ways,
) -> (Vec<PathEnd>, Effort) {
    let homotopy = system.homotopy();
    let (done, all) = (AtomicUsize::new(0), starts.len());
    let piece = piece(starts.len());
    let results: Vec<(Vec<PathEnd>, Effort)> = starts
        .par_chunks(piece)
        .map(|starts| {
            let mut follower = Follower::new(system, homotopy.clone(), rights, ways);
            let mut floats = (!ways.proved).then(|| FloatFollower::new(system, rights));
            let mut effort = Effort::default();
            let ends = starts.iter().map(|start| {
                if ways.is_over() {
                    return PathEnd::Stopped(OVER.to_owned());
                }
                let end = match &mut floats {
                    None => follower.follow(start, ways, &mut effort),
                    Some(floats) => follower.follow_in_floats(floats, start, ways, &mut effort),
                };
                let count = done.fetch_add(1, Ordering::Relaxed) + 1;
                if let Some(progress) = ways.progress {
                    progress(count, all);
                }
                end
            });
            (ends.collect(), effort)
        })
        .collect();
    let mut effort = Effort::default();
    let mut ends = Vec::with_capacity(starts.len());
    for (some, took) in results {
        ends.extend(some);
        effort.add(took);
    }
    (ends, effort)
}

/// Proves boxes around many points, for the parameters at t = 1, on all threads, until the time of `ways` is over.
pub fn prove_all(
    system: &System,
    rights: &[Right],
    points: &[Vec<DoubleDouble>],
    ways: &Ways,
) -> Vec<Result<SolutionBox, String>> {
    let homotopy = system.homotopy();
    points
        .par_chunks(piece(points.len()))
        .flat_map_iter(|points| {
            let mut follower = Follower::new(system, homotopy.clone(), rights, &Ways::default());
            let proved = points.iter().map(|point| match ways.is_over() {
                true => Err(OVER.to_owned()),
                false => follower.prove(point),
            });
            proved.collect::<Vec<_>>()
        })
        .collect()
}
