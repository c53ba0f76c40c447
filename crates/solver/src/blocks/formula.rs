//! Blocks that are solved by formula: all their solutions, in intervals.

use super::local::Local;
use super::number::Number;
use crate::interval::{Interval, point};
use crate::order::InOrder;
use crate::places::Each as _;
use nalgebra::DMatrix;

/// All solutions of a block.
pub enum Solved {
    /// They are these.
    All(Vec<Vec<Number>>),
    /// They could not be told apart, or whether there are any: why.
    Doubt(String),
    /// There is no formula for such a block.
    NoFormula,
}

impl Solved {
    /// From the roots of an equation of one unknown, each of which tells a solution.
    fn from(
        roots: Result<Vec<Number>, &'static str>,
        solution: impl Fn(Number) -> Vec<Number>,
    ) -> Self {
        match roots {
            Ok(roots) => Solved::All(roots.into_iter().map(solution).collect()),
            Err(why) => Solved::Doubt(why.into()),
        }
    }
}

/// The solutions of a block by formula, those first at which the determinant of the derivatives certainly has the given
/// sign.
pub fn solve(rows: &[Local], sense: Option<i8>) -> Solved {
    let is_linear = rows.iter().all(|row| row.quadratic.is_empty());
    let solved = match rows {
        _ if is_linear => linear(rows),
        [row] => {
            let square = Number::halves(2 * row.q(0, 0));
            Solved::from(roots(&square, &row.linear[0], &row.constant), |x| vec![x])
        }
        [one, other] => two(one, other),
        _ => Solved::NoFormula,
    };
    let Solved::All(solutions) = solved else {
        return solved;
    };
    let mut solutions: Vec<Vec<Number>> = solutions
        .into_iter()
        .map(|solution| contracted(rows, solution))
        .collect();
    for (k, one) in solutions.iter().enumerate() {
        let apart = |other: &Vec<Number>| {
            let mut pairs = one.iter().zip(other);
            pairs.any(|(a, b)| a.enclosure().disjoint(b.enclosure()))
        };
        if !solutions[k + 1..].iter().all(apart) {
            return Solved::Doubt(
                "two solutions are too near to each other to be told apart".into(),
            );
        }
    }
    if sense.is_some() {
        solutions.order_by_key(|solution| sense_at(rows, solution) != sense);
    }
    Solved::All(solutions)
}

/// The sign of the determinant of the derivatives of one equation or two: in exact ratios where all numbers are such,
/// otherwise in intervals. `None` where it is not certain or zero, and for more equations.
pub fn sense_at(rows: &[Local], at: &[Number]) -> Option<i8> {
    let gradient = |row: &Local| row.derivatives(at);
    let determinant = match rows {
        [row] => gradient(row).pop()?,
        [one, other] => {
            let (u, v) = (gradient(one), gradient(other));
            u[0].times(&v[1]).minus(&u[1].times(&v[0]))
        }
        _ => return None,
    };
    determinant.sign().filter(|sign| *sign != 0)
}

fn jacobian(rows: &[Local], at: &[f64]) -> DMatrix<f64> {
    let at: Vec<Interval> = at.iter().map(|&x| point(x)).collect();
    let gradients: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| row.gradient(&at).iter().map(|x| x.mid()).collect())
        .collect();
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| gradients[i][j])
}

fn middle(solution: &[Number]) -> Vec<f64> {
    solution.iter().map(|x| x.enclosure().mid()).collect()
}

/// How far a number is at least from zero.
fn size(x: &Number) -> f64 {
    match x.sign() {
        Some(0) | None => 0.0,
        _ => x.enclosure().mig(),
    }
}

/// Elimination: if no pivot may be zero, the equations have exactly one solution.
fn linear(rows: &[Local]) -> Solved {
    let n = rows.len();
    let mut rows: Vec<Vec<Number>> = rows
        .iter()
        .map(|row| {
            let right = Number::halves(0).minus(&row.constant);
            row.linear.iter().cloned().chain([right]).collect()
        })
        .collect();
    for k in 0..n {
        let best = (k..n).max_by(|&a, &b| size(&rows[a][k]).total_cmp(&size(&rows[b][k])));
        rows.swap(k, best.unwrap_or(k));
        let pivot = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let Some(factor) = row[k].over(&pivot[k]) else {
                return Solved::Doubt("its linear equations may be dependent".into());
            };
            for c in k..=n {
                row[c] = row[c].minus(&factor.times(&pivot[c]));
            }
        }
    }
    let mut out = vec![Number::halves(0); n];
    for k in (0..n).rev() {
        let known = (k + 1..n).fold(rows[k][n].clone(), |sum, c| {
            sum.minus(&rows[k][c].times(&out[c]))
        });
        let Some(x) = known.over(&rows[k][k]) else {
            return Solved::Doubt("its linear equations may be dependent".into());
        };
        out[k] = x;
    }
    Solved::All(vec![out])
}

/// The real roots of a x² / 2 + b x + c, or why they are in doubt.
fn roots(a: &Number, b: &Number, c: &Number) -> Result<Vec<Number>, &'static str> {
    let zero = Number::halves(0);
    match a.sign() {
        Some(0) => {
            let root = zero.minus(c).over(b);
            return root
                .map(|x| vec![x])
                .ok_or("its linear equation may say nothing");
        }
        None => return Err("whether it is linear is not certain"),
        Some(_) => {}
    }
    let discriminant = b.times(b).minus(&Number::halves(4).times(a).times(c));
    let root = match discriminant.sign() {
        Some(-1) => return Ok(Vec::new()),
        Some(1) => discriminant.sqrt(),
        _ => None,
    };
    let root = root.ok_or("two solutions fall together, or nearly so")?;
    let minus_b = zero.minus(b);
    let both = [minus_b.minus(&root), minus_b.plus(&root)];
    let both = both.iter().filter_map(|above| above.over(a));
    Ok(both.collect())
}

/// Two equations of two unknowns of which a combination is linear: circles, lines, and what is like them.
fn two(one: &Local, other: &Local) -> Solved {
    let keys = [(0, 0), (0, 1), (1, 1)];
    let [p, q] = [one, other].each(|row| keys.each(|(i, j)| row.q(i, j)));
    let is_multiple = (0..3).all(|i| (0..3).all(|j| p[i] * q[j] == p[j] * q[i]));
    if !is_multiple {
        return Solved::NoFormula;
    }
    // A multiple of one less a multiple of the other is linear.
    let (curved, line) = match (p.iter().position(|&x| x != 0), q.iter().all(|&x| x == 0)) {
        (None, _) => (other, one.clone()),
        (Some(_), true) => (one, other.clone()),
        (Some(k), false) => {
            let (f, g) = (Number::halves(2 * q[k]), Number::halves(2 * p[k]));
            let mix = |a: &Number, b: &Number| f.times(a).minus(&g.times(b));
            let linear = one.linear.iter().zip(&other.linear);
            let line = Local {
                quadratic: Default::default(),
                linear: linear.map(|(a, b)| mix(a, b)).collect(),
                constant: mix(&one.constant, &other.constant),
            };
            (one, line)
        }
    };
    // x_k = s x_l + w.
    let k = usize::from(size(&line.linear[1]) > size(&line.linear[0]));
    let l = 1 - k;
    let zero = Number::halves(0);
    let (Some(s), Some(w)) = (
        zero.minus(&line.linear[l]).over(&line.linear[k]),
        zero.minus(&line.constant).over(&line.linear[k]),
    ) else {
        return Solved::Doubt("its equations may be dependent".into());
    };
    let number = |i: usize, j: usize| Number::halves(2 * curved.q(i, j));
    let half = Number::halves(1);
    let (kk, kl, ll) = (number(k, k), number(k, l), number(l, l));
    // Of Q_kk (s x + w)² / 2 + Q_kl (s x + w) x / 2 + Q_ll x² / 2 + b_k (s x + w) + b_l x + c.
    let a = kk.times(&s).times(&s).plus(&kl.times(&s)).plus(&ll);
    let b = kk
        .times(&s)
        .times(&w)
        .plus(&half.times(&kl).times(&w))
        .plus(&curved.linear[k].times(&s))
        .plus(&curved.linear[l]);
    let c = half
        .times(&kk)
        .times(&w)
        .times(&w)
        .plus(&curved.linear[k].times(&w))
        .plus(&curved.constant);
    Solved::from(roots(&a, &b, &c), |x| {
        let mut solution = vec![zero.clone(); 2];
        solution[k] = s.times(&x).plus(&w);
        solution[l] = x;
        solution
    })
}

/// A solution in a smaller box, by two steps of Krawczyk's operator, which keeps every zero of a box.
fn contracted(rows: &[Local], solution: Vec<Number>) -> Vec<Number> {
    let n = rows.len();
    let Some(y) = jacobian(rows, &middle(&solution)).try_inverse() else {
        return solution;
    };
    if y.iter().any(|x| !x.is_finite()) {
        return solution;
    }
    let mut solution = solution;
    for _ in 0..2 {
        let at: Vec<Interval> = solution.iter().map(Number::enclosure).collect();
        let mid: Vec<Interval> = at.iter().map(|x| point(x.mid())).collect();
        let f: Vec<Interval> = rows.iter().map(|row| row.value(&mid)).collect();
        let slopes: Vec<Vec<Interval>> = rows.iter().map(|row| row.gradient(&at)).collect();
        let image = |i: usize| {
            let newton = (0..n).fold(mid[i], |sum, e| sum - point(y[(i, e)]) * f[e]);
            (0..n).fold(newton, |sum, j| {
                let unit = point(if i == j { 1.0 } else { 0.0 });
                let defect = (0..n).fold(unit, |sum, e| sum - point(y[(i, e)]) * slopes[e][j]);
                sum + defect * (at[j] - mid[j])
            })
        };
        let images: Vec<Interval> = (0..n).map(image).collect();
        let next = solution.iter().zip(images);
        let next: Vec<Number> = next.map(|(x, image)| x.narrowed(image)).collect();
        // It cannot be empty, but for a mistake.
        if next.iter().any(|x| x.enclosure().is_empty()) {
            return solution;
        }
        solution = next;
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Map;
    use crate::rational::Rational;

    fn ratio(a: i64, b: i64) -> Number {
        Number::exactly(Rational::new(a.into(), b.into()))
    }

    /// x² + y² = r² about (cx, cy).
    fn circle(cx: &Number, cy: &Number, squared: &Number) -> Local {
        let zero = Number::halves(0);
        let half = |x: &Number| Number::halves(1).times(x).times(x);
        Local {
            quadratic: Map::sums([((0, 0), 1), ((1, 1), 1)]),
            linear: vec![zero.minus(cx), zero.minus(cy)],
            constant: half(cx)
                .plus(&half(cy))
                .minus(&Number::halves(1).times(squared)),
        }
    }

    #[test]
    fn two_circles_meet_where_they_do() {
        let rows = [
            circle(&ratio(0, 1), &ratio(0, 1), &ratio(25, 1)),
            circle(&ratio(6, 1), &ratio(0, 1), &ratio(25, 1)),
        ];
        let Solved::All(found) = solve(&rows, Some(1)) else {
            panic!()
        };
        assert_eq!(found.len(), 2);
        for solution in &found {
            assert!(solution[0].is_exact() && solution[0].enclosure().contains(3.0));
            assert_eq!(solution[1].enclosure().mag(), 4.0);
        }
        assert_eq!(sense_at(&rows, &found[0]), Some(1));
        assert_eq!(sense_at(&rows, &found[1]), Some(-1));
        // In intervals, and roots that are no ratios.
        let third = Number::within(ratio(1, 3).enclosure());
        let rows = [
            circle(&third, &ratio(0, 1), &ratio(2, 1)),
            circle(&ratio(1, 1), &ratio(1, 1), &ratio(3, 1)),
        ];
        let Solved::All(found) = solve(&rows, Some(-1)) else {
            panic!()
        };
        assert_eq!(found.len(), 2);
        for solution in &found {
            let at: Vec<Interval> = solution.iter().map(Number::enclosure).collect();
            assert!(rows.iter().all(|row| row.value(&at).contains(0.0)));
            assert!(at.iter().all(|x| x.wid() < 1e-14), "{at:?}");
        }
        assert!(found[0][0].enclosure().disjoint(found[1][0].enclosure()));
    }

    /// A sign is not read off a middle: beside the double root it is exact or in doubt.
    #[test]
    fn a_sense_is_certain_or_not_said() {
        let tiny = |sign: i64| {
            let far = Rational::new(sign.into(), num_bigint::BigInt::from(10).pow(40));
            Number::exactly(Rational::from_integer(3.into()) + far)
        };
        // (x − 3)²: the derivative at 3 ± 10⁻⁴⁰, which no float tells from 3.
        let rows = [Local {
            quadratic: Map::sums([((0, 0), 2)]),
            linear: vec![ratio(-6, 1)],
            constant: ratio(5, 1),
        }];
        assert_eq!(sense_at(&rows, &[tiny(1)]), Some(1));
        assert_eq!(sense_at(&rows, &[tiny(-1)]), Some(-1));
        assert_eq!(sense_at(&rows, &[ratio(3, 1)]), None);
        // In an interval around 3 of which the middle is above.
        let around = Number::within(crate::interval::hull(3.0 - 1e-9, 3.0 + 2e-9));
        assert_eq!(sense_at(&rows, &[around]), None);
    }

    #[test]
    fn circles_apart_do_not_meet_and_tangent_ones_are_in_doubt() {
        let at = |squared: i64| {
            solve(
                &[
                    circle(&ratio(0, 1), &ratio(0, 1), &ratio(25, 1)),
                    circle(&ratio(10, 1), &ratio(0, 1), &ratio(squared, 1)),
                ],
                None,
            )
        };
        assert!(matches!(at(16), Solved::All(found) if found.is_empty()));
        assert!(matches!(at(25), Solved::Doubt(_)));
        assert!(matches!(at(26), Solved::All(found) if found.len() == 2));
    }

    #[test]
    fn linear_equations_have_one_solution_or_are_in_doubt() {
        let row = |a: i64, b: i64, c: i64| Local {
            quadratic: Default::default(),
            linear: vec![ratio(a, 1), ratio(b, 3)],
            constant: ratio(c, 1),
        };
        let Solved::All(found) = solve(&[row(0, 3, -1), row(2, 3, -5)], None) else {
            panic!()
        };
        assert!(found[0][0].enclosure().contains(2.0) && found[0][1].enclosure().contains(1.0));
        assert!(matches!(
            solve(&[row(1, 3, 0), row(2, 6, 1)], None),
            Solved::Doubt(_)
        ));
    }
}
