//! The check of sets of complex solutions: that each exists, that no two are congruent, which are real, and, of distances, that
//! there is no other, where their number meets the multi-homogeneous Bézout bound, with that of figures at infinity. With other
//! constraints ([`general`]) solutions are zeros of the equations that paths follow, and no bound is known.
//!
//! No path is needed for that: how solutions were found does not matter once each is proved to be one, and a bound says
//! how many there are at most. The equations, the test for one zero and the bound are made here from the problem alone; what
//! is trusted is in this folder, and the intervals and the problem beside it.

mod bezout;
mod figure;
mod general;
pub mod infinity;
mod zero;

use super::Compared;
use super::begun::before_one_record;
use super::format::TAG_COMPLEX_SET;
use super::head::Head;
use super::verdict::are_same;
use crate::interval::Interval;
use crate::problem::Problem;
use figure::Equations;
use general::General;
pub use infinity::Departure;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use zero::Zero;

/// A set. In a certificate all but its problem, which stands in the header, is a record of JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ComplexSet {
    /// The text of the problem's file.
    #[serde(skip)]
    pub problem: String,
    /// The points that stand still, by name: two joined ones in the plane, three mutually joined ones in space. With other
    /// constraints than distances none.
    pub fixed: Vec<String>,
    /// For each solution, each point (in the problem's order) and each coordinate its real and imaginary part, perhaps followed
    /// by what these leave of them: the first fixed point is at the origin, the second on the x axis at its positive distance,
    /// the third in the upper half of the xy plane. In the problem's unit.
    pub solutions: Vec<Vec<Vec<Vec<f64>>>>,
    /// With other constraints than distances, in the place of `solutions`: for each solution every unknown of the equations that paths
    /// follow, likewise, in the problem's unit.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unknowns: Vec<Vec<Vec<f64>>>,
    /// As many isolated solutions there are at most, up to signs, as somebody says that has made the set: that is not checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cited: Option<u64>,
    /// Figures at infinity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at_infinity: Vec<Departure>,
    /// Whether the set is claimed to have all isolated solutions.
    pub complete: bool,
}

/// Why a file cannot be checked.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ComplexSetError(pub String);

/// What a set proves.
#[derive(Debug, Clone, PartialEq)]
pub struct ComplexVerdict {
    /// The problem that it is about.
    pub problem: Problem,
    /// Solutions up to isometry, no two congruent.
    pub isometry: usize,
    /// How many solutions there are up to rotation: mirror images that no rotation brings together are counted
    /// apart.
    pub rotation: usize,
    /// How many of the former are real.
    pub real: usize,
    /// Figures at infinity, no two congruent: for each departure the points that go there, and how many figures there are.
    pub at_infinity: Vec<(Vec<usize>, usize)>,
    /// The bound on those up to rotation, with those at infinity.
    pub bound: Option<u128>,
    /// Whether solutions are zeros of the equations that paths follow, counted up to signs.
    pub is_general: bool,
    /// The bound that the set cites, if it has as many solutions.
    pub cited: Option<u64>,
    /// What is wrong or could not be proved: then nothing is.
    pub flaw: Option<ComplexFlaw>,
}

/// What is wrong with a set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ComplexFlaw {
    /// A claim is false.
    False(String),
    /// A claim may be true, and could not be proved.
    NotProved(String),
}

impl ComplexVerdict {
    /// Whether the solutions are proved to be all isolated ones.
    pub fn proves_all(&self) -> bool {
        let all = self.rotation + self.rotation_at_infinity();
        self.flaw.is_none() && self.bound == Some(all as u128)
    }

    /// How many figures at infinity there are up to rotation: none is its own mirror image.
    pub fn rotation_at_infinity(&self) -> usize {
        2 * self.at_infinity.iter().map(|one| one.1).sum::<usize>()
    }

    /// What is compared where it is held against a problem.
    pub fn compared(&self) -> Compared {
        Compared::of(&self.problem)
    }

    /// Whether this is about a problem: of distances alone about its points and distances, whatever its sketch; otherwise
    /// about all that it says, and the reference.
    pub fn is_about(&self, problem: &Problem) -> bool {
        let is_same_reference = self.problem.homotopy.reference == problem.homotopy.reference;
        are_same(&self.problem, problem) && (is_same_reference || !self.is_general)
    }
}

impl ComplexSet {
    /// The bytes of a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = before_one_record(&self.problem, 0, TAG_COMPLEX_SET);
        serde_json::to_writer(&mut bytes, self).expect("numbers and strings have a form in JSON");
        bytes.push(b'\n');
        bytes
    }

    /// Reads the bytes of a file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ComplexSetError> {
        let opened = Head::of_one_record(bytes, TAG_COMPLEX_SET);
        let (head, json) = opened.map_err(|error| ComplexSetError(error.to_string()))?;
        if head.unit_exponent != 0 {
            return Err(ComplexSetError("the unit of a set is 1".to_owned()));
        }
        let set: ComplexSet = serde_json::from_slice(json)
            .map_err(|error| ComplexSetError(format!("the set: {error}")))?;
        Ok(ComplexSet {
            problem: head.problem,
            ..set
        })
    }
}

/// Checks a set.
pub fn verify_complex_set(bytes: &[u8]) -> Result<ComplexVerdict, ComplexSetError> {
    let set = ComplexSet::from_bytes(bytes)?;
    let problem = Problem::parse(&set.problem, "the set's problem")
        .map_err(|e| ComplexSetError(e.to_string()))?;
    let mut verdict = ComplexVerdict {
        problem,
        isometry: 0,
        rotation: 0,
        real: 0,
        at_infinity: Vec::new(),
        bound: None,
        is_general: false,
        cited: None,
        flaw: None,
    };
    verdict.is_general = !verdict.problem.is_distances_only();
    verdict.flaw = match verdict.is_general {
        false => check(&set, &mut verdict).err(),
        true => check_general(&set, &mut verdict).err(),
    };
    Ok(verdict)
}

fn check(set: &ComplexSet, verdict: &mut ComplexVerdict) -> Result<(), ComplexFlaw> {
    let wrong = |text: String| ComplexFlaw::False(text);
    let doubt = |text: String| ComplexFlaw::NotProved(text);
    let problem = &verdict.problem;
    if !set.unknowns.is_empty() || set.cited.is_some() {
        return Err(doubt(
            "a set of a problem of distances gives the places of points in `solutions`, and neither `unknowns` nor `cited`".to_owned(),
        ));
    }
    let fixed: Option<Vec<usize>> = set
        .fixed
        .iter()
        .map(|name| problem.points.iter().position(|p| p.name == *name))
        .collect();
    let fixed =
        fixed.ok_or_else(|| wrong("a fixed point is no point of the problem".to_owned()))?;
    let equations = Equations::new(problem, &fixed).map_err(doubt)?;
    let zeros = proved(&set.solutions, |places| equations.prove(places))?;
    for (index, zero) in zeros.iter().enumerate() {
        let flat = equations.is_its_own_mirror_image(zero).ok_or_else(|| {
            doubt(format!(
                "whether solution {} is flat is not clear",
                index + 1
            ))
        })?;
        verdict.rotation += if flat { 1 } else { 2 };
    }
    verdict.isometry = zeros.len();
    verdict.real = real(&zeros)?;
    are_apart(
        &zeros,
        |zero| equations.key(zero),
        &equations.changes,
        "they are the same, or mirror images of each other",
    )?;
    verdict.at_infinity = infinity::check(problem, &fixed, &set.at_infinity)?;
    verdict.bound = bezout::bound(problem, &fixed);
    let all = (verdict.rotation + verdict.rotation_at_infinity()) as u128;
    let counts = || match verdict.rotation_at_infinity() {
        0 => format!("{} up to rotation", verdict.rotation),
        away => format!("{} up to rotation and {away} at infinity", verdict.rotation),
    };
    match verdict.bound {
        Some(bound) if bound < all => Err(wrong(format!(
            "solutions are proved, {}, and the bound is {bound}: this is a bug in krawl, please report it",
            counts()
        ))),
        Some(bound) if set.complete && bound != all => Err(doubt(format!(
            "all solutions are claimed, there are {}, and the bound that is checked here is {bound}",
            counts()
        ))),
        None if set.complete => Err(doubt(
            "all solutions are claimed, and no bound is known".to_owned(),
        )),
        _ => Ok(()),
    }
}

/// The solutions, if each is proved to exist.
fn proved<T: Sync>(
    claimed: &[T],
    prove: impl Fn(&T) -> Option<Zero> + Sync,
) -> Result<Vec<Zero>, ComplexFlaw> {
    let proved: Vec<Option<Zero>> = claimed.par_iter().map(&prove).collect();
    let zeros = proved.into_iter().enumerate().map(|(index, zero)| {
        let number = index + 1;
        zero.ok_or_else(|| {
            ComplexFlaw::NotProved(format!("solution {number} is not proved to exist"))
        })
    });
    zeros.collect()
}

/// How many solutions are real.
fn real(zeros: &[Zero]) -> Result<usize, ComplexFlaw> {
    let mut count = 0;
    for (index, zero) in zeros.iter().enumerate() {
        let number = index + 1;
        let real = zero.is_real().ok_or_else(|| {
            ComplexFlaw::NotProved(format!("whether solution {number} is real is not clear"))
        })?;
        count += usize::from(real);
    }
    Ok(count)
}

/// Checks a set with other constraints than distances.
fn check_general(set: &ComplexSet, verdict: &mut ComplexVerdict) -> Result<(), ComplexFlaw> {
    let doubt = |text: String| ComplexFlaw::NotProved(text);
    let is_of_places = !set.solutions.is_empty() || !set.fixed.is_empty();
    if is_of_places || !set.at_infinity.is_empty() || set.complete {
        return Err(doubt(
            "a set of a problem with other constraints than distances gives `unknowns` only, and cannot claim to be complete".to_owned(),
        ));
    }
    let equations = General::new(&verdict.problem).map_err(doubt)?;
    let zeros = proved(&set.unknowns, |unknowns| equations.prove(unknowns))?;
    verdict.real = real(&zeros)?;
    let same = "they are the same, or signs of axes or of directions make one of the other";
    are_apart(&zeros, |zero| equations.key(zero), &equations.changes, same)?;
    (verdict.isometry, verdict.rotation) = (zeros.len(), zeros.len());
    verdict.cited = set.cited.filter(|&cited| cited == zeros.len() as u64);
    match set.cited {
        Some(cited) if cited < zeros.len() as u64 => Err(ComplexFlaw::False(format!(
            "there are said to be at most {cited} solutions, and there are {}",
            zeros.len()
        ))),
        _ => Ok(()),
    }
}

/// Checks that no two solutions are congruent, images of each other under these changes of signs. `key`: a number that congruent ones have in common. `same`: what is said of two that are.
fn are_apart(
    zeros: &[Zero],
    key: impl Fn(&Zero) -> Interval,
    changes: &[Vec<bool>],
    same: &str,
) -> Result<(), ComplexFlaw> {
    // Solutions whose keys are disjoint are not congruent; those that meet come soon after each other.
    let mut keys: Vec<(f64, f64, usize)> = zeros
        .iter()
        .map(&key)
        .enumerate()
        .map(|(index, key)| (key.inf(), key.sup(), index))
        .collect();
    keys.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (k, &(_, high, one)) in keys.iter().enumerate() {
        for &(_, _, other) in keys[k + 1..].iter().take_while(|key| key.0 <= high) {
            let [a, b] = [one.min(other), one.max(other)];
            let numbers = format!("solutions {} and {}", a + 1, b + 1);
            match zeros[a].is_image(&zeros[b], changes) {
                Some(false) => {}
                Some(true) => {
                    return Err(ComplexFlaw::False(format!("{numbers} are not two: {same}")));
                }
                None => {
                    return Err(ComplexFlaw::NotProved(format!(
                        "whether {numbers} are two is not clear"
                    )));
                }
            }
        }
    }
    Ok(())
}
