//! Points that are one more than there are dimensions, each joined to each: a triangle in the plane, a tetrahedron in space. All but
//! one are the base, and the last has two places or one or none, by the sign of its squared height over the base. That is a ratio of the numbers in the
//! file, so that its sign is certain however near to 0 it is.
//!
//! With a = c₂ − c₁ and b = c₃ − c₁, A = a·a, B = b·b, C = a·b, q₁ = a·(p − c₁), q₂ = b·(p − c₁) and r = |p − c₁|², all of which are
//! halves of sums of squared distances, and Δ = AB − C² > 0, the squared height is N/Δ with N = rΔ − (q₁²B − 2q₁q₂C + q₂²A); in the
//! plane Δ = A and N = rA − q₁².

use crate::blocks::{Account, LeftOut, Ruler, Verdict, Whose, seen};
use crate::interval::vector::Vector;
use crate::interval::{Interval, ZERO};
use crate::places::Each as _;
use crate::problem::Problem;
use crate::rational::Rational;
use crate::system::told::range;
use crate::system::typical_length;
use num_bigint::BigInt;

/// What the exact numbers say.
pub enum Step {
    /// One figure up to rigid motions and reflections; seen from the reference points.
    Figure {
        /// The points.
        points: Vec<Vector>,
        /// Whether all of them are on one line (in space: in one plane).
        is_flat: bool,
    },
    /// None: this point has no place.
    Nowhere {
        /// The point.
        point: usize,
        /// Its squared height over the others would be this.
        height: Rational,
    },
}

/// The squared distance of two points, if the problem gives it.
fn square(problem: &Problem, a: usize, b: usize) -> Option<Rational> {
    let is_it = |ends: [usize; 2]| ends == [a, b] || ends == [b, a];
    let mut distances = problem.distances.iter();
    let distance = distances.find(|distance| is_it(distance.points))?;
    Some(distance.target.squared())
}

/// Decides a problem that is one exact step. `None`: it is not, or the base may be degenerate.
pub fn step(problem: &Problem) -> Option<Step> {
    let d = problem.dimension;
    let base = &problem.homotopy.reference;
    if !problem.is_distances_only() || problem.points.len() != d + 1 || base.len() != d {
        return None;
    }
    let new = (0..=d).find(|p| !base.contains(p))?;
    let of = |a: usize, b: usize| square(problem, a, b);
    let half = |x: Rational| x / Rational::from(BigInt::from(2));
    let root = |x: &Rational| range(x).sqrt();
    let (a, r) = (of(base[0], base[1])?, of(base[0], new)?);
    let q1 = half(&r - of(base[1], new)? + &a);
    let mut points = vec![[ZERO; 3]; d + 1];
    points[base[1]][0] = root(&a);
    points[new][0] = range(&q1) / root(&a);
    let (delta, n) = if d == 2 {
        (a.clone(), &r * &a - &q1 * &q1)
    } else {
        let b = of(base[0], base[2])?;
        let c = half(&a + &b - of(base[1], base[2])?);
        let q2 = half(&r - of(base[2], new)? + &b);
        let delta = &a * &b - &c * &c;
        if !delta.is_positive() {
            return None;
        }
        let across = root(&(&a * &delta));
        points[base[2]][0] = range(&c) / root(&a);
        points[base[2]][1] = root(&(&delta / &a));
        points[new][1] = range(&(&q2 * &a - &q1 * &c)) / across;
        let two = Rational::one() + Rational::one();
        let off = &q1 * &q1 * &b - two * &q1 * &q2 * &c + &q2 * &q2 * &a;
        let n = &r * &delta - off;
        (delta, n)
    };
    let height = n / delta;
    if height.is_negative() {
        return Some(Step::Nowhere { point: new, height });
    }
    points[new][d - 1] = root(&height);
    let is_bounded = |x: &Interval| x.mag().is_finite();
    let is_known = points.iter().flatten().all(is_bounded);
    is_known.then_some(Step::Figure {
        points,
        is_flat: height.is_zero(),
    })
}

/// A flat figure in the place of one that does not exist, for the last digits of a distance alone.
pub struct Nearly {
    /// Its points, seen from the reference.
    pub points: Vec<Vector>,
    /// The distance that it has not exactly, and by how much it misses that.
    pub left_out: LeftOut,
    /// What it is the only figure of, beside the other distances, in words.
    pub held: String,
}

/// Of a problem that is one exact step and has no figure: the flat one that has all distances but one, which is met within its digits: it is as long (or
/// short) as the others let it be. `is_own`: the distances of which that may be one.
pub fn nearly(problem: &Problem, is_own: impl Fn([usize; 2]) -> bool) -> Option<Nearly> {
    if !matches!(step(problem), Some(Step::Nowhere { .. })) {
        return None;
    }
    let unit = typical_length(problem);
    let mut best: Option<(f64, Nearly)> = None;
    for (e, distance) in problem.distances.iter().enumerate() {
        if !is_own(distance.points) {
            continue;
        }
        for turned in [false, true] {
            let Some(places) = in_one_plane(problem, distance.points, turned) else {
                continue;
            };
            let [a, b] = distance.points.each(|p| places[p]);
            let length = (0..3).fold(ZERO, |sum, k| sum + (a[k] - b[k]).sqr()).sqrt();
            let epsilon = Ruler::new(problem, Whose::Distance(e), (unit, 1), None).epsilon;
            let miss = length - distance.target.enclose();
            let verdict = Verdict::of(miss, epsilon);
            let share = miss.mag() / epsilon;
            let is_better = best.as_ref().is_none_or(|(least, _)| share < *least);
            if let (Verdict::Met { .. }, true) = (verdict, is_better)
                && let Some(points) = flat(problem, &places)
            {
                let mut account = Account::default();
                account.leave_out(problem.distance_name(e), verdict);
                let left_out = account.left_out.remove(0);
                let held = held(problem, distance.points, turned);
                let near = Nearly {
                    points,
                    left_out,
                    held,
                };
                best = Some((share, near));
            }
        }
    }
    best.map(|best| best.1)
}

/// The points on one line (in space: in one plane) with all distances but that of two of them, which are on either side of the others or
/// (`turned`) on the same.
fn in_one_plane(problem: &Problem, [i, j]: [usize; 2], turned: bool) -> Option<Vec<Vector>> {
    let others: Vec<usize> = (0..problem.points.len())
        .filter(|p| ![i, j].contains(p))
        .collect();
    let sign = |x: Interval| if turned { x } else { -x };
    let mut places = vec![[ZERO; 3]; problem.points.len()];
    match *others.as_slice() {
        [h] => {
            places[i][0] = range(&square(problem, h, i)?).sqrt();
            places[j][0] = sign(range(&square(problem, h, j)?).sqrt());
        }
        [h, k] => {
            let a = square(problem, h, k)?;
            places[k][0] = range(&a).sqrt();
            for p in [i, j] {
                let (r, s) = (square(problem, h, p)?, square(problem, k, p)?);
                let q = (&r - s + &a) / Rational::from(BigInt::from(2));
                let height = r - &q * &q / &a;
                if height.is_negative() {
                    return None;
                }
                let height = range(&height).sqrt();
                places[p][0] = range(&q) / range(&a).sqrt();
                places[p][1] = if p == j { sign(height) } else { height };
            }
        }
        _ => return None,
    }
    Some(places)
}

/// That a figure is flat, and on which side of the others the ends of the distance that was left out are: of these there is one.
fn held(problem: &Problem, ends: [usize; 2], turned: bool) -> String {
    let name = |p: usize| problem.points[p].name.as_str();
    let all: Vec<&str> = (0..problem.points.len()).map(name).collect();
    let others = (0..problem.points.len()).filter(|p| !ends.contains(p));
    let others: Vec<&str> = others.map(name).collect();
    let [a, b] = ends.map(name);
    let on = match problem.dimension {
        2 => "on one line",
        _ => "in one plane",
    };
    let side = match turned {
        true => "on the same side",
        false => "on opposite sides",
    };
    format!(
        "{} {on} with {a} and {b} {side} of {}, as no figure has these distances exactly",
        all.join(", "),
        others.join("-")
    )
}

/// Flat places as the reference sees them.
fn flat(problem: &Problem, places: &[Vector]) -> Option<Vec<Vector>> {
    let mut seen = seen(problem, places)?;
    // As all are in one plane.
    let last = problem.dimension - 1;
    seen.iter_mut().for_each(|p| p[last] = ZERO);
    Some(seen)
}
