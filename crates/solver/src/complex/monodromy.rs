//! Filling a fibre: from one solution of a generic instance to all that loops of parameters lead to.
//!
//! Between two generic instances A and B there are many ways of moving the parameters, bowed in all directions.
//! Along each of them the solutions of A are taken to those of B, one to one, as no two proved paths can meet. So a
//! solution of A goes to B one way and comes back another, as a solution of A that may be new. In floats paths may
//! jump; then some solutions may be missed along one way, and others be found twice.
//!
//! A random instance may have solutions that are nearly singular, which are hard to come to and hard to prove. So after
//! the ways to B, B is the instance that is filled if more is known of it.

use super::boxes::{SolutionBox, SolutionSet};
use super::exact::{Exact, Parameter, Random, zero};
use super::follow::{Effort, Follower, PathEnd, Ways, follow_all};
use super::start;
use super::system::{Equation, Kind, System, segment};
use super::template::Template;
use super::total_degree::{self, Led};
use crate::interval::DoubleDouble;
use crate::system::Right;

/// The solutions of a generic instance that were found.
#[derive(Debug, Clone)]
pub struct Fibre {
    /// The parameters, one for each equation.
    pub parameters: Vec<Parameter>,
    /// One solution of each orbit under the group of the system.
    pub solutions: SolutionSet,
    /// Ways between two instances that were followed.
    pub ways: usize,
    /// Ways since the last new solution was found.
    pub idle: usize,
    /// What all that took.
    pub effort: Effort,
    /// Paths that were given up, and the last reason.
    pub failed: (usize, Option<String>),
    /// What came of the paths from the zeros of powers, where there were any.
    pub led: Option<Led>,
}

/// Told of the solutions so far, and the effort.
pub type Tell<'a> = dyn Fn(usize, &Effort) + Sync + 'a;

/// When to stop filling.
#[derive(Clone, Copy)]
pub struct Filling<'a> {
    /// The seed of the random numbers.
    pub seed: u64,
    /// Go on from these solutions of a random instance, instead of from one of another.
    pub from: Option<&'a Template>,
    /// So many solutions are all, if that is known.
    pub enough: Option<usize>,
    /// Stop after so many ways in a row without a new solution.
    pub patience: usize,
    /// Called after each way with the solutions so far, and the effort.
    pub progress: Option<&'a Tell<'a>>,
    /// How to follow paths.
    pub ways: Ways<'a>,
}

impl Default for Filling<'_> {
    fn default() -> Self {
        Filling {
            seed: 1,
            from: None,
            enough: None,
            patience: 10,
            progress: None,
            // Where a path is hard to follow another way is taken.
            ways: Ways {
                most_tubes: 1000,
                extended: false,
                ..Ways::default()
            },
        }
    }
}

/// A way from A to B, and what is known of the one-to-one map that it makes.
struct Way {
    rights: [Vec<Right>; 2],
    /// For each solution at either end where it is known to go: `Some(None)` where its path was given up.
    known: [Vec<Option<Option<usize>>>; 2],
}

/// Ways between A and one B, before another B is taken.
const WAYS: usize = 5;

/// Fills the fibre over the parameters of a random figure: of equations without points first by total degree, in floats whatever
/// `filling` says.
///
/// Fails where no start figure can be made.
pub fn fill(system: &System, filling: &Filling) -> Result<Fibre, String> {
    // Who goes on takes other ways than those that were gone.
    let gone = filling.from.map_or(0, |template| template.ways as u64);
    let mut random = Random::new(filling.seed.wrapping_add(gone << 32));
    let (parameters, solutions) = match filling.from {
        Some(template) => (template.parameters.clone(), template.solutions.clone()),
        None => seed(system, &mut random)?,
    };
    let mut fibre = Fibre {
        parameters,
        solutions,
        ways: filling.from.map_or(0, |template| template.ways),
        idle: 0,
        effort: Effort::default(),
        failed: (0, None),
        led: None,
    };
    if filling.from.is_none() {
        fibre.led = total_degree::lead(system, &mut fibre, &mut random, &filling.ways);
    }
    // All paths came to solutions, or went away.
    if fibre.led.is_some_and(|led| led.stopped == 0) {
        return Ok(fibre);
    }
    let is_full = |solutions: &SolutionSet| filling.enough.is_some_and(|n| solutions.len() >= n);
    while !is_full(&fibre.solutions) && fibre.idle < filling.patience && !filling.ways.is_over() {
        let (other, mut there) = seed(system, &mut random)?;
        let mut ways: Vec<Way> = Vec::new();
        let goes_on = |fibre: &Fibre, there: &SolutionSet| {
            !is_full(&fibre.solutions) && !is_full(there) && !filling.ways.is_over()
        };
        while ways.len() < WAYS && goes_on(&fibre, &there) && fibre.idle < filling.patience {
            let bow = bow(system, &mut random);
            ways.push(Way {
                rights: [
                    segment(&fibre.parameters, &other, Some(&bow)),
                    segment(&other, &fibre.parameters, Some(&bow)),
                ],
                known: [Vec::new(), Vec::new()],
            });
            fibre.ways += 1;
            let before = (fibre.solutions.len(), there.len());
            // Until no way has a solution at either end that has not gone along it.
            let mut open = true;
            while open && goes_on(&fibre, &there) {
                open = false;
                for way in &mut ways {
                    for end in 0..2 {
                        open |= exhaust(system, filling, way, end, &mut fibre, &mut there);
                        if let Some(progress) = filling.progress {
                            let most = fibre.solutions.len().max(there.len());
                            progress(most, &fibre.effort);
                        }
                    }
                }
            }
            // One way alone leads nowhere new by itself.
            if ways.len() > 1 {
                let grown = (fibre.solutions.len(), there.len()) != before;
                fibre.idle = if grown { 0 } else { fibre.idle + 1 };
            }
        }
        if there.len() > fibre.solutions.len() {
            (fibre.parameters, fibre.solutions) = (other, there);
        }
    }
    Ok(fibre)
}

/// The parameters of a random figure, and a box around it in which it is alone.
fn seed(system: &System, random: &mut Random) -> Result<(Vec<Parameter>, SolutionSet), String> {
    let mut why = "no figure can be drawn at random: an equation that defines an auxiliary unknown cannot be \
                   solved for it"
        .to_owned();
    for _ in 0..20 {
        let Some(figure) = start::draw(system, random) else {
            continue;
        };
        let rights = segment(&figure.parameters, &figure.parameters, None);
        let values = figure.values.iter().flat_map(|value| value.parts());
        let near: Vec<DoubleDouble> = values.map(|x| x.double().0).collect();
        match Follower::new(system, system.homotopy(), &rights, &Ways::default()).prove(&near) {
            Ok(found) => {
                let mut alone = SolutionSet::default();
                alone.push(found);
                return Ok((figure.parameters, alone));
            }
            Err(reason) => {
                why = format!(
                    "random figures are singular: {reason}; the constraints depend on each other"
                );
            }
        }
    }
    Err(why)
}

/// How far the parameters of a way leave the straight one: about as far as they are from zero.
pub fn bow(system: &System, random: &mut Random) -> Vec<Parameter> {
    let size = Exact::whole(BOW);
    let of = |equation: &Equation| match (&equation.right, equation.bows) {
        (Kind::Parameter(_), true) => random.complex().times(&size).parts(),
        _ => zero(),
    };
    system.equations.iter().map(of).collect()
}

/// Bows are random numbers of up to this size in both parts.
const BOW: i64 = 2;

/// Takes the solutions at one end of a way to the other that have not gone yet. Tells whether there were any.
fn exhaust(
    system: &System,
    filling: &Filling,
    way: &mut Way,
    end: usize,
    fibre: &mut Fibre,
    there: &mut SolutionSet,
) -> bool {
    let (from, to) = match end {
        0 => (&fibre.solutions, &mut *there),
        _ => (&*there, &mut fibre.solutions),
    };
    way.known[end].resize(from.len(), None);
    let open: Vec<usize> = (0..from.len())
        .filter(|&k| way.known[end][k].is_none())
        .collect();
    if open.is_empty() {
        return false;
    }
    let starts: Vec<&SolutionBox> = open.iter().map(|&k| &from.boxes()[k]).collect();
    let (ends, took) = follow_all(system, &way.rights[end], &starts, &filling.ways);
    fibre.effort.add(took);
    for (k, path) in open.into_iter().zip(ends) {
        let arrived = match path {
            PathEnd::Reached(found) => to.enter(found, &system.group),
            PathEnd::Beyond(t, _) => {
                Err(format!("it went beyond the radius allowed at t = {t:.6}"))
            }
            PathEnd::Stopped(reason) => Err(reason),
        };
        match arrived {
            Ok(index) => {
                way.known[end][k] = Some(Some(index));
                let back = &mut way.known[1 - end];
                back.resize(to.len().max(back.len()), None);
                back[index] = Some(Some(k));
            }
            Err(reason) => {
                way.known[end][k] = Some(None);
                fibre.failed.0 += 1;
                fibre.failed.1 = Some(reason);
            }
        }
    }
    true
}
