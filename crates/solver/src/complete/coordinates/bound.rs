//! Bounds of a block's unknowns where the equations one by one have none.
//!
//! Circles that touch each other are cones in their centres and radii, and go on for ever; the differences of two such equations are
//! planes. So whole multiples of equations are added until their products of unknowns cancel, exactly. Where as many linear equations
//! come of it as there are unknowns, or one fewer, all unknowns are linear in one of them (none), by elimination in intervals; and one
//! of the equations is then a t² + b t + c = 0 in that unknown t, whence |t| ≤ (|b| + √(b² + 4 |a c|)) / (2 |a|) if a is not 0.
//! Where fewer come of it, those unknowns are bounded that a linear equation tells by itself; and a linear equation of which elimination
//! leaves a number that is not 0 has no zero.

use super::expanded::equations;
use super::newton::Square;
use crate::certificate::cover::coordinates::Empty;
use crate::certificate::cover::coordinates::bounds::{Expanded, eliminate, without_products};
use crate::interval::{Interval, ZERO, checked, point};

/// Ranges of the unknowns of a block, in order, that hold all of its zeros; [`Empty`] where linear equations contradict each other.
pub fn bounds(square: &Square, x: &[Interval]) -> Result<Vec<Interval>, Empty> {
    let n = square.own.len();
    let unknown = || Ok(vec![Interval::ENTIRE; n]);
    let rows = equations(square, x);
    let Some(mut linear) = without_products(&rows) else {
        return unknown();
    };
    // What each of them is solved for.
    let mut pivots: Vec<Option<usize>> = vec![None; linear.len()];
    for k in 0..linear.len() {
        let left = (0..n).filter(|&c| !pivots.contains(&Some(c)));
        let size = |c: usize| linear[k].linear[c].mig();
        let best = left.max_by(|&a, &b| size(a).total_cmp(&size(b)));
        match best.filter(|&c| size(c) > 0.0) {
            Some(best) => {
                eliminate(&mut linear, k, best);
                pivots[k] = Some(best);
            }
            // No unknown is left in it.
            None if linear[k].linear.iter().all(|b| *b == ZERO)
                && !linear[k].constant.contains(0.0) =>
            {
                return Err(Empty);
            }
            None => {}
        }
    }
    let mut free = (0..n).filter(|&c| !pivots.contains(&Some(c)));
    let t = free.next();
    let is_line = free.next().is_none();
    // x = α + β t, if no other unknown that is not eliminated is in its row.
    let line = |i: usize| -> Option<[Interval; 2]> {
        let Some(k) = pivots.iter().position(|&p| p == Some(i)) else {
            return Some([ZERO, point(1.0)]);
        };
        let Expanded {
            linear, constant, ..
        } = &linear[k];
        let others = (0..n).filter(|&c| c != i && linear[c] != ZERO);
        let slope = match t {
            Some(t) if is_line => -(linear[t] / linear[i]),
            _ if others.count() == 0 => ZERO,
            _ => return None,
        };
        Some([-(*constant / linear[i]), slope])
    };
    let lines: Vec<Option<[Interval; 2]>> = (0..n).map(line).collect();
    let whole: Option<Vec<[Interval; 2]>> = lines.iter().copied().collect();
    let range = match (t, whole) {
        (None, _) => ZERO,
        (Some(_), Some(lines)) if is_line => {
            let sizes = rows.iter().filter_map(|row| row.greatest(&lines));
            let most = sizes.min_by(f64::total_cmp);
            most.and_then(|most| checked(-most, most))
                .unwrap_or(Interval::ENTIRE)
        }
        _ => Interval::ENTIRE,
    };
    let range_of = |line: &Option<[Interval; 2]>| match line {
        Some([alpha, beta]) if *beta == ZERO => *alpha,
        Some([alpha, beta]) => *alpha + *beta * range,
        None => Interval::ENTIRE,
    };
    Ok(lines.iter().map(range_of).collect())
}

#[cfg(test)]
mod tests {
    use super::super::newton::KNOWN;
    use super::super::system::{Form, Product, Row};
    use super::*;

    /// (x − p)² + (y − q)² = (r + s)².
    fn cone([p, q, s]: [f64; 3], known: usize, x: &mut Vec<Interval>) -> Row {
        // The unknowns are 0, 1 and 2, `zero` is 3; known numbers follow.
        let at = x.len();
        x.extend([point(p), point(q), point(-s)]);
        let square = |factor, a, b| {
            let form = Form::Difference(a, b);
            Product::new(point(factor), form, form)
        };
        let products = vec![
            square(1.0, 0, at),
            square(1.0, 1, at + 1),
            square(-1.0, 2, at + 2),
        ];
        Row::new(products, ZERO, known)
    }

    #[test]
    fn a_circle_that_touches_three_others_is_not_far() {
        let mut x = vec![Interval::ENTIRE, Interval::ENTIRE, Interval::ENTIRE, ZERO];
        let rows = [[0.0, 0.0, 1.0], [7.0, 0.0, 1.5], [2.0, 6.0, -2.0]];
        let rows = rows.map(|circle| cone(circle, 3, &mut x));
        let mut place = vec![KNOWN; x.len()];
        (0..3).for_each(|k| place[k] = k);
        let square = Square {
            rows: rows.iter().collect(),
            own: vec![0, 1, 2],
            place,
            has_ranges: false,
        };
        let found = bounds(&square, &x).unwrap();
        assert!(found.iter().all(|x| x.mag() < 1000.0), "{found:?}");
        // Newton's method from somewhere comes to a circle, which has to be within.
        let start: Vec<Interval> = x.iter().map(|x| point(x.mid().clamp(-9.0, 9.0))).collect();
        let mut at = start;
        at[0] = point(3.0);
        at[1] = point(2.0);
        at[2] = point(4.0);
        let zero = square.prove(&at).unwrap();
        for (k, range) in found.iter().enumerate() {
            assert!(!range.disjoint(zero.range(k)), "{range:?} {zero:?}");
        }
    }
}
