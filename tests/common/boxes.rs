//! Laws of solution boxes and of sets of them.

use super::exact::{Range, exact, middle, ranges, root_near, squared_distance, squared_target};
use krawl::problem::Problem;
use krawl::rational::Rational;
use krawl::track::Solution;
use num_bigint::BigInt;
use num_traits::Signed;

/// Checks, in exact arithmetic and without the trackers' equations, what a certified run says
/// about its solutions: each box can hold a solution and holds the one that Newton's method finds
/// from its middle; they are disjoint; and the classes are those of congruence up to reflection.
pub fn check(problem: &Problem, solutions: &[Solution]) -> Result<(), String> {
    let boxes: Vec<Vec<[Range; 3]>> = solutions.iter().map(ranges).collect();
    for (index, (solution, box_)) in solutions.iter().zip(&boxes).enumerate() {
        check_gauge(problem, box_).map_err(|e| format!("solution {index}: {e}"))?;
        for (d, distance) in problem.distances.iter().enumerate() {
            let [a, b] = distance.points;
            if !squared_distance(box_, a, b).contains(&squared_target(&distance.target)) {
                let name = problem.distance_name(d);
                return Err(format!("no figure in box {index} has the distance {name}"));
            }
        }
        let root = root_near(problem, &middle(solution))
            .ok_or_else(|| format!("Newton's method fails in box {index}"))?;
        if !holds(box_, &root) {
            return Err(format!("Newton's method leads out of box {index}"));
        }
    }
    for (i, a) in boxes.iter().enumerate() {
        for (j, b) in boxes.iter().enumerate().take(i) {
            if meet(a, b) {
                return Err(format!("the boxes {j} and {i} have points in common"));
            }
            // Equal distances between all pairs of points mean congruence, a mirror image
            // included. Boxes this small tell different distances apart.
            let congruent = (0..a.len()).all(|p| {
                (0..p).all(|q| squared_distance(a, p, q).meets(&squared_distance(b, p, q)))
            });
            if congruent != (solutions[i].class == solutions[j].class) {
                let what = if congruent { "are" } else { "are not" };
                return Err(format!(
                    "the solutions {j} and {i} {what} congruent, but their classes are {} and {}",
                    solutions[j].class, solutions[i].class
                ));
            }
        }
    }
    Ok(())
}

/// The first reference point at the origin, the second on the x axis, the third in the xy plane.
fn check_gauge(problem: &Problem, box_: &[[Range; 3]]) -> Result<(), String> {
    let is_zero = |x: &Range| x.lo.is_zero() && x.hi.is_zero();
    if box_.len() != problem.points.len() {
        return Err(format!("{} points", box_.len()));
    }
    for (p, coordinates) in box_.iter().enumerate() {
        let reference = &problem.homotopy.reference;
        let place = reference.iter().position(|&r| r == p);
        let free = place.unwrap_or(problem.dimension);
        if !coordinates[free..].iter().all(is_zero) {
            return Err(format!("{} is not in the gauge", problem.points[p].name));
        }
    }
    Ok(())
}

/// Whether a figure that is known to some thirty digits ([`root_near`]) is in a box, which may be a single point.
pub fn holds(box_: &[[Range; 3]], figure: &[[Rational; 3]]) -> bool {
    let all = || figure.iter().flatten();
    let size = all().map(|x| x.abs()).max().unwrap_or_else(Rational::zero);
    let known = size / Rational::from_integer(BigInt::from(10).pow(28));
    let inside = |(range, x): (&Range, &Rational)| range.lo <= x + &known && x - &known <= range.hi;
    box_.iter()
        .zip(figure)
        .all(|(ranges, point)| ranges.iter().zip(point).all(inside))
}

fn meet(a: &[[Range; 3]], b: &[[Range; 3]]) -> bool {
    a.iter()
        .zip(b)
        .all(|(p, q)| p.iter().zip(q).all(|(x, y)| x.meets(y)))
}

/// How the points of one problem stand to those of another: how a solution of the one must look
/// to be one of the other.
pub struct View {
    /// The point of the other problem that is this one's p-th.
    pub point: Vec<usize>,
    /// What each axis is multiplied by.
    pub factors: [Rational; 3],
}

impl View {
    /// Nothing changes.
    pub fn same(problem: &Problem) -> Self {
        let one = || Rational::from_integer(1.into());
        View {
            point: (0..problem.points.len()).collect(),
            factors: [one(), one(), one()],
        }
    }

    fn apply(&self, box_: &[[Range; 3]]) -> Vec<[Range; 3]> {
        let mut seen = box_.to_vec();
        for (point, &other) in box_.iter().zip(&self.point) {
            seen[other] = std::array::from_fn(|k| point[k].times(&self.factors[k]));
        }
        seen
    }
}

/// Checks that two certified runs found the same solutions, of which boxes that meet are the
/// sign: the boxes of a run are disjoint. Returns for each of the first its place in the second.
pub fn matching(
    first: &[Solution],
    view: &View,
    second: &[Solution],
) -> Result<Vec<usize>, String> {
    if first.len() != second.len() {
        return Err(format!("{} solutions and {}", first.len(), second.len()));
    }
    let others: Vec<_> = second.iter().map(ranges).collect();
    let mut pairs = Vec::new();
    for (index, solution) in first.iter().enumerate() {
        let box_ = view.apply(&ranges(solution));
        let partners: Vec<usize> = (0..others.len())
            .filter(|&k| meet(&box_, &others[k]))
            .collect();
        match partners[..] {
            [partner] if !pairs.contains(&partner) => pairs.push(partner),
            _ => return Err(format!("solution {index} meets {partners:?}")),
        }
    }
    check_classes(first, second, &pairs)?;
    Ok(pairs)
}

fn check_classes(first: &[Solution], second: &[Solution], pairs: &[usize]) -> Result<(), String> {
    for i in 0..pairs.len() {
        for j in 0..i {
            let together = first[i].class == first[j].class;
            if together != (second[pairs[i]].class == second[pairs[j]].class) {
                return Err(format!("only one run says that {j} and {i} are congruent"));
            }
        }
    }
    Ok(())
}

/// Float solutions may be that far from a box, relative to the size of the figure. The trackers
/// polish them until the corrections stop shrinking, and rounding leaves an error of 53 bits times
/// the condition of the Jacobian, which on the shipped problems is below 1e4 and on random ones
/// reaches 1e6.
pub const FLOAT_ACCURACY: f64 = 1e-9;

/// Checks that float solutions are those in the boxes: one in each, up to [`FLOAT_ACCURACY`], and
/// with further digits by Newton's method inside. Returns for each box the float solution's place.
pub fn float_matching(
    problem: &Problem,
    certified: &[Solution],
    float: &[Solution],
) -> Result<Vec<usize>, String> {
    if certified.len() != float.len() {
        return Err(format!(
            "{} boxes and {} float solutions",
            certified.len(),
            float.len()
        ));
    }
    let mut pairs = Vec::new();
    for (index, solution) in certified.iter().enumerate() {
        let box_ = ranges(solution);
        let size = middle(solution)
            .iter()
            .flatten()
            .fold(0.0f64, |a, x| a.max(x.abs()));
        let slack = exact(FLOAT_ACCURACY * size);
        let inflated: Vec<[Range; 3]> = box_
            .iter()
            .map(|p| {
                p.each_ref().map(|x| Range {
                    lo: &x.lo - &slack,
                    hi: &x.hi + &slack,
                })
            })
            .collect();
        let near: Vec<usize> = (0..float.len())
            .filter(|&k| meet(&inflated, &ranges(&float[k])))
            .collect();
        let [partner] = near[..] else {
            return Err(format!("near box {index} are the float solutions {near:?}"));
        };
        let root = root_near(problem, &middle(&float[partner]))
            .ok_or_else(|| format!("Newton's method fails near box {index}"))?;
        if !holds(&box_, &root) {
            return Err(format!(
                "the float solution {partner} is beside box {index}"
            ));
        }
        if pairs.contains(&partner) {
            return Err(format!("{partner} is near two boxes"));
        }
        pairs.push(partner);
    }
    check_classes(certified, float, &pairs)?;
    Ok(pairs)
}
