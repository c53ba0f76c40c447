//! Contraction of a box by one equation after the other.
//!
//! Every step keeps all zeros of the box: from `factor · L · R + rest = right` follows that L · R is in
//! (right − rest) / factor, also where 0 may be the factor, as it is not if right − rest has no 0; from that, where L = R, that |L| is in the root of it, and otherwise that L is in it
//! divided by R; from L = a − b that a is in L + b and b in a − L; and where both factors have an entry in common, (x − a)(x − b), that
//! (x − (a + b)/2)² is L · R + ((a − b)/2)². All are evaluated in intervals, so that they hold
//! for every zero in the box and every value that the numbers of blocks before may have.

use super::system::{Form, Row, product, shared, stands};
use crate::certificate::cover::coordinates::{Empty, ROUNDS};
use crate::interval::{Interval, ZERO, checked, is_narrower, point, upper_half};
use crate::places::Each as _;

/// How often the rows are gone through where one entry became narrower.
const FEW_ROUNDS: usize = 2;

/// Contracts the entries that are free by all rows, again and again while that helps.
pub fn contract(rows: &[&Row], is_free: &[bool], x: &mut [Interval]) -> Result<(), Empty> {
    spread((rows, is_free), vec![true; x.len()], ROUNDS, x)
}

/// Contracts the entries that are free by the rows that have to do with one that became narrower since, and goes not far from these.
pub fn contract_near(
    rows: &[&Row],
    is_free: &[bool],
    entry: usize,
    x: &mut [Interval],
) -> Result<(), Empty> {
    let mut is_dirty = vec![false; x.len()];
    is_dirty[entry] = true;
    spread((rows, is_free), is_dirty, FEW_ROUNDS, x)
}

fn spread(
    (rows, is_free): (&[&Row], &[bool]),
    mut is_dirty: Vec<bool>,
    rounds: usize,
    x: &mut [Interval],
) -> Result<(), Empty> {
    for _ in 0..rounds {
        let mut changed = vec![false; x.len()];
        let mut any = false;
        for row in rows {
            if !row.entries.iter().any(|&e| is_dirty[e] || changed[e]) {
                continue;
            }
            revise(row, is_free, x, |entry| {
                changed[entry] = true;
                any = true;
            })?;
        }
        if !any {
            break;
        }
        is_dirty = changed;
    }
    Ok(())
}

/// Contracts by one row.
fn revise(
    row: &Row,
    is_free: &[bool],
    x: &mut [Interval],
    mut tell: impl FnMut(usize),
) -> Result<(), Empty> {
    let count = row.products.len();
    let values: Vec<Interval> = row
        .products
        .iter()
        .map(|p| p.factor * product(p, x))
        .collect();
    // The sums of all products behind each.
    let mut behind = vec![ZERO; count + 1];
    for k in (0..count).rev() {
        behind[k] = behind[k + 1] + values[k];
    }
    if behind[0].disjoint(row.right) {
        return Err(Empty);
    }
    let mut before = ZERO;
    for (k, p) in row.products.iter().enumerate() {
        let rest = before + behind[k + 1];
        before += values[k];
        if rest.is_entire() {
            continue;
        }
        let wanted = (row.right - rest) / p.factor;
        if wanted.is_entire() {
            continue;
        }
        if p.left == p.right {
            let root = root(wanted)?;
            let (least, most) = (root.inf(), root.sup());
            let within = checked(-most, most).unwrap_or(Interval::ENTIRE);
            narrow(p.left, within, least, is_free, x, &mut tell)?;
            continue;
        }
        if let Some(shared) = shared(p, x)
            && is_free[shared.x]
        {
            let root = root(shared.square(wanted, x))?;
            let (old, middle) = (x[shared.x], shared.middle(x));
            let [low, high] = [-root, root].each(|side| old.intersection(middle + side));
            let new = match (low.is_empty(), high.is_empty()) {
                (true, true) => return Err(Empty),
                (false, true) => low,
                (true, false) => high,
                (false, false) => low.convex_hull(high),
            };
            set(shared.x, new, x, &mut tell);
        }
        for (this, other) in [(p.left, p.right), (p.right, p.left)] {
            if this == Form::One {
                continue;
            }
            let by = other.value(|entry| x[entry]);
            if by.contains(0.0) {
                if wanted.contains(0.0) {
                    continue;
                }
                // |L| is at least the least of |L R| over the greatest |R|.
                if by == ZERO {
                    return Err(Empty);
                }
                let least = point(wanted.mig()) / magnitude(by);
                narrow(this, Interval::ENTIRE, least.inf(), is_free, x, &mut tell)?;
            } else {
                narrow(this, wanted / by, 0.0, is_free, x, &mut tell)?;
            }
        }
    }
    collected(row, is_free, x, &mut tell)
}

/// Contracts each entry that stands in several products of a row by all of these together: where its factor in them, taken in one range, is not 0, it is
/// what the others leave divided by that.
fn collected(
    row: &Row,
    is_free: &[bool],
    x: &mut [Interval],
    tell: &mut impl FnMut(usize),
) -> Result<(), Empty> {
    for &entry in row.repeated.iter().filter(|&&entry| is_free[entry]) {
        let (mut factor, mut rest) = (ZERO, row.right);
        for p in &row.products {
            let ends = [(p.left, p.right), (p.right, p.left)];
            let of = ends.into_iter().find_map(|(form, other)| {
                let mut own = form.entries();
                let sign = own.find_map(|(e, sign)| (e == entry).then_some(sign))?;
                Some((form, sign, other))
            });
            match of.filter(|_| stands(p, entry) == 1) {
                Some((form, sign, other)) => {
                    let by = p.factor * other.value(|e| x[e]);
                    factor += if sign > 0 { by } else { -by };
                    // What is left of the difference without it.
                    rest -= by * form.value(|e| if e == entry { ZERO } else { x[e] });
                }
                None => rest -= p.factor * product(p, x),
            }
        }
        if !factor.contains(0.0) && !rest.is_entire() {
            set(entry, x[entry].intersection(rest / factor), x, tell);
            if x[entry].is_empty() {
                return Err(Empty);
            }
        }
    }
    Ok(())
}

/// The absolute value of a number of which the square is in a range.
fn root(square: Interval) -> Result<Interval, Empty> {
    let square = square.intersection(upper_half());
    match square.is_empty() {
        true => Err(Empty),
        false => Ok(square.sqrt()),
    }
}

/// The greatest absolute value, as an interval that may be unbounded.
fn magnitude(x: Interval) -> Interval {
    match x.mag() {
        size if size.is_finite() => point(size),
        _ => checked(f64::MAX, f64::INFINITY).expect("an interval"),
    }
}

/// Takes away of a range what is nearer to 0 than `least`, where one side of it is left.
fn outside(x: Interval, least: f64) -> Interval {
    // A bound that is no number says nothing.
    if !(least > 0.0) {
        return x;
    }
    let side = |lo, hi| checked(lo, hi).map_or(x, |side| x.intersection(side));
    if x.inf() > -least {
        side(least, f64::INFINITY)
    } else if x.sup() < least {
        side(f64::NEG_INFINITY, -least)
    } else {
        x
    }
}

/// Contracts the entries of a form that is within a range and no nearer to 0 than `least`.
fn narrow(
    form: Form,
    within: Interval,
    least: f64,
    is_free: &[bool],
    x: &mut [Interval],
    tell: &mut impl FnMut(usize),
) -> Result<(), Empty> {
    let Form::Difference(a, b) = form else {
        return Ok(());
    };
    let value = outside(form.value(|entry| x[entry]).intersection(within), least);
    if value.is_empty() {
        return Err(Empty);
    }
    if a == b {
        return Ok(());
    }
    for (entry, to) in [(a, value + x[b]), (b, x[a] - value)] {
        if !is_free[entry] {
            continue;
        }
        let new = x[entry].intersection(to);
        if new.is_empty() {
            return Err(Empty);
        }
        set(entry, new, x, tell);
    }
    Ok(())
}

/// Puts a narrower range in the place of an entry's, and tells it if it is worth it.
fn set(entry: usize, new: Interval, x: &mut [Interval], tell: &mut impl FnMut(usize)) {
    let old = std::mem::replace(&mut x[entry], new);
    if is_narrower(new, old) {
        tell(entry);
    }
}

#[cfg(test)]
mod tests {
    use super::super::system::Product;
    use super::*;
    use crate::interval::hull;

    const ALL: Interval = Interval::ENTIRE;

    fn square(a: usize, b: usize) -> Product {
        let form = Form::Difference(a, b);
        Product::new(point(1.0), form, form)
    }

    #[test]
    fn a_circle_bounds_what_was_unbounded() {
        // x² + y² = 4, entry 2 being 0.
        let row = Row::new(vec![square(0, 2), square(1, 2)], point(4.0), 2);
        let mut x = vec![ALL, upper_half(), ZERO];
        contract(&[&row], &[true, true, false], &mut x).unwrap();
        assert_eq!(x, [hull(-2.0, 2.0), hull(0.0, 2.0), ZERO]);
        // Where x is at least 1.5, y is at most √1.75, and the other way round nothing is lost.
        x[0] = hull(1.5, 2.0);
        contract(&[&row], &[true, true, false], &mut x).unwrap();
        assert!(x[1].contains(1.75f64.sqrt()) && x[1].sup() < 1.33);
        x[1] = hull(1.4, 1.5);
        assert_eq!(contract(&[&row], &[true, true, false], &mut x), Err(Empty));
    }

    /// A right angle at (x, y) between (1, 0) and (3, 2): entries x, y, and the numbers 1, 3, 2 and 0.
    #[test]
    fn a_right_angle_bounds_what_was_unbounded() {
        let product = |i, j, k, l| {
            let [left, right] = [(i, j), (k, l)].map(|(a, b)| Form::Difference(a, b));
            Product::new(point(1.0), left, right)
        };
        for across in [product(0, 2, 0, 3), product(2, 0, 3, 0)] {
            let row = Row::new(vec![across, product(1, 5, 1, 4)], ZERO, 5);
            let start = || [ALL, ALL, point(1.0), point(3.0), point(2.0), ZERO];
            let is_free = [true, true, false, false, false, false];
            // The circle about (2, 1) of which the square of the radius is 2.
            let mut x = start();
            contract(&[&row], &is_free, &mut x).unwrap();
            for (x, middle) in [(x[0], 2.0), (x[1], 1.0)] {
                let range = hull(middle - 2f64.sqrt(), middle + 2f64.sqrt());
                assert!(range.subset(x) && x.wid() < range.wid() + 1e-12);
            }
            // Beside the middle, on either side.
            let mut x = start();
            (x[0], x[1]) = (hull(1.5, 2.5), hull(1.0, 9.0));
            contract(&[&row], &is_free, &mut x).unwrap();
            assert!(x[1].contains(2.4) && x[1].inf() > 2.3 && x[1].sup() < 2.5);
        }
        // (x − 1)(3 − x) is at most 1.
        let row = Row::new(vec![product(0, 2, 3, 0)], point(1.5), 5);
        let mut x = [ALL, ALL, point(1.0), point(3.0), point(2.0), ZERO];
        let is_free = [true, true, false, false, false, false];
        assert_eq!(contract(&[&row], &is_free, &mut x), Err(Empty));
    }

    #[test]
    fn a_product_that_is_not_zero_keeps_its_factors_from_zero() {
        // x y = 6 with y between −2 and 3 and x above −1: x is at least 2 then.
        let [x, y] = [0, 1].map(|entry| Form::Difference(entry, 2));
        let row = Row::new(vec![Product::new(point(2.0), x, y)], point(12.0), 2);
        let mut x = vec![hull(-1.0, 9.0), hull(-2.0, 3.0), ZERO];
        contract(&[&row], &[true, true, false], &mut x).unwrap();
        assert!(x[0].contains(2.0) && x[0].inf() > 1.999 && x[0].sup() == 9.0);
        assert!(x[1].contains(6.0 / 9.0) && x[1].inf() > 0.66);
        // Neither factor may be 0.
        let mut x = vec![ZERO, ALL, ZERO];
        assert_eq!(contract(&[&row], &[true, true, false], &mut x), Err(Empty));
        let mut x = vec![ALL, ALL, ZERO];
        contract(&[&row], &[true, true, false], &mut x).unwrap();
        assert!(x[0].is_entire() && x[1].is_entire());
    }
}
