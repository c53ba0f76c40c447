//! Equations less others that are in them, for sets of figures.
//!
//! Where one of two equal lengths is given, the other one is, too: |r − s|² = |p − q|² less |p − q|² = d² is |r − s|² = d². The first form ties r and s to
//! p and q, and in a row of equal gaps everything to everything; the second one is a distance by itself, so that sketches with rows of equal gaps fall apart.
//!
//! Zeros are the same: the equation that is taken away stays. At t = 1 alone.

use super::diameters::{Key, keys};
use super::factors::Equal;
use super::quadratic::{Product, Tail};
use crate::interval::Real;
use crate::rational::Rational;
use num_integer::Integer;
use std::collections::VecDeque;

/// Takes from each equation those of which all products are in it, as long as some are left.
///
/// `rights`: the right-hand sides at t = 1. `is_kept`: equations that stay as they are.
pub fn subtract(tail: &mut Tail, rights: &mut [Real], equal: &Equal, is_kept: &[bool]) {
    let keyed = tail.equations.iter().map(|equation| {
        let products = equal.left(&equation.products).copied();
        keys(equation, equal).into_iter().zip(products).collect()
    });
    let mut all: Vec<Vec<(Key, Product)>> = keyed.collect();
    // Whatever is given is taken from all others at once: these become no longer, so that nothing else comes of it later.
    let mut open: VecDeque<usize> = (0..all.len()).collect();
    while let Some(given) = open.pop_front() {
        if !is_given(&all[given], &rights[given]) {
            continue;
        }
        for e in 0..all.len() {
            if e == given || is_kept[e] || all[given].len() >= all[e].len() {
                continue;
            }
            let Some((by, left)) = multiple(&all[e], &all[given]) else {
                continue;
            };
            let right = &rights[e] - &(&Real::whole(by.into()) * &rights[given]);
            // In the form of one that was said by itself.
            let common = left
                .iter()
                .fold(0, |common: i32, (key, _)| common.gcd(&key.0));
            let common = common * left.first().map_or(1, |(key, _)| key.0.signum());
            let part = Rational::new(1.into(), common.into());
            rights[e] = &Real::from(part) * &right;
            let left = left.into_iter().map(|((factor, one, other), mut product)| {
                product.factor /= common;
                ((factor / common, one, other), product)
            });
            all[e] = left.collect();
            let equation = &mut tail.equations[e];
            equation.products = all[e].iter().map(|(_, product)| *product).collect();
            equation.right = vec![rights[e].clone()];
            open.push_back(e);
        }
    }
}

/// Whether what an equation says may be put into others: its right-hand side is a ratio, and so is the root, if it is of one square. (The root of each equation is a
/// symbol by itself where exact numbers are looked at, so that it would not be known to be the same one any more.)
fn is_given(products: &[(Key, Product)], right: &Real) -> bool {
    let Some(right) = right.as_rational() else {
        return false;
    };
    match products {
        [] => false,
        // Products are of twice the left-hand side.
        [((factor, one, other), _)] if one == other => {
            let square = right * Rational::new(2.into(), (*factor).into());
            square.sqrt().is_some()
        }
        _ => true,
    }
}

/// If all products of an equation are so many times in another one: how many times, and what else is in that.
fn multiple(of: &[(Key, Product)], given: &[(Key, Product)]) -> Option<(i32, Vec<(Key, Product)>)> {
    let mut left = of.to_vec();
    let mut times = None;
    for ((factor, one, other), _) in given {
        let place = left
            .iter()
            .position(|(key, _)| (&key.1, &key.2) == (one, other))?;
        let found = left.remove(place).0.0;
        let by = found / factor;
        let is_same = found == by * factor && times.is_none_or(|times| times == by);
        times = Some(is_same.then_some(by)?);
    }
    Some((times?, left))
}

#[cfg(test)]
mod tests {
    use crate::constraint::try_lower_for_sets;
    use crate::problem::Problem;

    /// The distances and equal lengths of points on a line, each equation by its products and twice its right-hand side.
    fn equations(distance: &str) -> Vec<(usize, f64)> {
        let text = format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\nc = [2, 0]\nd = [3, 0]\n[constraints]\nfixed = [\"a\"]\n\
             horizontal = [[\"a\", \"b\"], [\"b\", \"c\"], [\"c\", \"d\"]]\n\
             equal = [[\"a\", \"b\", \"b\", \"c\"], [\"b\", \"c\", \"c\", \"d\"]]\n{distance}"
        );
        let problem = Problem::parse(&text, "test.toml").unwrap();
        let (tail, _) = try_lower_for_sets(&problem, |_| Ok(Vec::new())).unwrap();
        let told = tail
            .equations
            .iter()
            .filter(|e| e.products[0].left == e.products[0].right);
        let right =
            |e: &crate::constraint::Equation| e.right.iter().map(|x| 2.0 * x.enclose().mid()).sum();
        told.map(|e| (e.products.len(), right(e))).collect()
    }

    #[test]
    fn what_is_as_long_as_a_given_length_has_that_length() {
        let given = equations("distances = [[\"a\", \"b\", 1.5]]\n");
        assert_eq!(given, [(1, 2.25), (1, 2.25), (1, 2.25)]);
    }

    #[test]
    fn a_root_that_is_no_ratio_stays_one_number() {
        let given = equations("squared_distances = [[\"a\", \"b\", 2]]\n");
        assert_eq!(given, [(1, 2.0), (2, 0.0), (2, 0.0)]);
    }
}
