//! Equations divided by an unknown length L, which is positive in figures.
//!
//! A sum of squares that is exactly 0 is an equation, or the difference of two whose right-hand sides are the same number. If v = L u, component by
//! component, and each of its squares either is that of a component of v, or has another one with the opposite factor so that
//! p − q is a component of v, or its opposite, then each summand has the factor L: p² = L u p, p² − q² = L u (p + q). Without it the sum is 0 still.

use crate::certificate::checker::equations::{Equations, Product, ZERO};
use crate::interval::Interval;

/// `v = length · heading`, one component: the length an unknown, the others forms.
pub struct Component {
    /// The length.
    pub length: usize,
    /// v.
    pub vector: usize,
    /// The heading.
    pub heading: usize,
}

/// The products of each sum that is 0 in figures; the equations are `Σ products = right`.
pub fn divided(
    eq: &Equations,
    equations: &[(&[Product], Interval)],
    components: &[Component],
) -> Vec<Vec<Product>> {
    let is_length = |c: &&Component| eq.positive.contains(&c.length);
    let components: Vec<&Component> = components.iter().filter(is_length).collect();
    let mut lengths: Vec<usize> = components.iter().map(|c| c.length).collect();
    lengths.sort_unstable();
    lengths.dedup();
    if lengths.is_empty() {
        return Vec::new();
    }
    let sums = sums(eq, equations);
    let pairs = sums
        .iter()
        .flat_map(|sum| lengths.iter().map(move |&length| (sum, length)));
    let quotients = pairs.filter_map(|(sum, length)| {
        let of = components.iter().filter(|c| c.length == length);
        quotient(eq, sum.clone(), &of.copied().collect::<Vec<_>>())
    });
    quotients.collect()
}

/// Sums of squares of forms, with their factors, that are 0.
fn sums(eq: &Equations, equations: &[(&[Product], Interval)]) -> Vec<Vec<(i64, usize)>> {
    let squares = |products: &[Product]| -> Option<Vec<(i64, usize)>> {
        let squares = products.iter().map(|&(factor, [left, right])| {
            (eq.forms[left] == eq.forms[right]).then_some((factor, left))
        });
        squares.collect()
    };
    let exact = |e: usize| eq.homotopy.rights[e].ball_at_target();
    let mut out = Vec::new();
    for (e, &(products, right)) in equations.iter().enumerate() {
        let Some(sum) = squares(products) else {
            continue;
        };
        // An enclosure of width 0 is exact.
        if right == ZERO {
            out.push(sum);
            continue;
        }
        for (d, &(others, same)) in equations[..e].iter().enumerate() {
            if same == right
                && let Some(others) = squares(others)
                && exact(d) == exact(e)
            {
                let less = others.iter().map(|&(factor, form)| (-factor, form));
                out.push(sum.iter().copied().chain(less).collect());
            }
        }
    }
    out
}

/// A sum of squares without the factor that all components have in common, if it is in it.
fn quotient(
    eq: &Equations,
    mut sum: Vec<(i64, usize)>,
    components: &[&Component],
) -> Option<Vec<Product>> {
    // The heading of the difference of two entries, and with which sign.
    let heading = |[i, j]: [usize; 2]| {
        components.iter().find_map(|c| match eq.forms[c.vector] {
            vector if vector == [i, j] => Some((1, c.heading)),
            vector if vector == [j, i] => Some((-1, c.heading)),
            _ => None,
        })
    };
    let mut out = Vec::new();
    sum.retain(|&(_, form)| eq.forms[form][0] != eq.forms[form][1]);
    while let Some((factor, p)) = sum.pop() {
        let ends = eq.forms[p];
        if let Some((sign, u)) = heading(ends) {
            out.push((factor * sign, [u, p]));
            continue;
        }
        let partner = sum.iter().enumerate().find_map(|(k, &(other, q))| {
            let [i, j] = eq.forms[q];
            let found = [(1, [i, j]), (-1, [j, i])]
                .into_iter()
                .find_map(|(turn, to)| {
                    let difference = match (ends[0] == to[0], ends[1] == to[1]) {
                        (_, true) => [ends[0], to[0]],
                        (true, _) => [to[1], ends[1]],
                        _ => return None,
                    };
                    heading(difference).map(|(sign, u)| (turn, sign, u))
                });
            found.filter(|_| other == -factor).map(|found| (k, found))
        });
        let (k, (turn, sign, u)) = partner?;
        let (_, q) = sum.swap_remove(k);
        out.extend([(factor * sign, [u, p]), (factor * sign * turn, [u, q])]);
    }
    (!out.is_empty()).then_some(out)
}
