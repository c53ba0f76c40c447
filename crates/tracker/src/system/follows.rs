//! What follows in figures from equations v = k u, component by component, with a number k.
//!
//! From v = k u and w = k x follows v x = w u, which says something where k is not known: vectors that are parallel.
//!
//! If k is a length L, which is positive in figures, a sum of squares that is 0 can be divided by it. Where c is as far from a as from b,
//! and b − a = L u with a heading u, the difference of the squares of the distances is
//! (b − a)·((b − c) + (a − c)) = L u·((b − c) + (a − c)) = 0. It holds for L = 0 whatever u is, and near there no search over
//! ranges can tell anything; but L > 0 in every figure, so that u·((b − c) + (a − c)) = 0: c is on the bisector.
//!
//! Such a sum is an equation with 0 on the right, or the difference of two whose right-hand sides are the same number. If each of its
//! squares either is that of a component v, or has another one with the opposite factor so that p − q is ±v, then each summand has the
//! factor L: p² = L u p, p² − q² = ±L u (p + q). Without it the sum is 0 still.

use super::{Homotopy, Term};
use crate::equations::Form;
use crate::interval::ZERO;
use crate::order::each_once;

/// One component v of a vector with that of its heading u: v = k u.
struct Component {
    /// k.
    length: usize,
    /// v.
    vector: Form<Option<usize>>,
    /// u.
    heading: Form<Option<usize>>,
}

/// A factor, and the entries of whose difference it multiplies the square.
type Square = (i32, [Option<usize>; 2]);

impl Homotopy {
    /// Terms of which the sum is 0 in every figure, as the equations hold with t = 1 and lengths are positive.
    pub fn rows_in_figures(&self) -> Vec<Vec<Term>> {
        let equations: Vec<Vec<Term>> = (0..self.equations).map(|e| self.terms(e)).collect();
        let is_zero = |e: &usize| self.rights[*e].at_target() == ZERO;
        let zero = (0..self.equations).filter(is_zero);
        let components: Vec<Component> = zero.filter_map(|e| component(&equations[e])).collect();
        let positive = self.positive_unknowns();
        let lengths = components.iter().map(|c| c.length);
        let lengths = each_once(lengths.filter(|length| positive.contains(length)));
        let mut rows = parallel(&components);
        if lengths.is_empty() {
            return rows;
        }
        for sum in self.sums_of_squares(&equations) {
            rows.extend(lengths.iter().filter_map(|length| {
                let of = components.iter().filter(|c| c.length == *length);
                divided(sum.clone(), &of.collect::<Vec<_>>())
            }));
        }
        rows
    }

    /// Sums of squares that are exactly 0: an equation, or the difference of two with the same right-hand side.
    fn sums_of_squares(&self, equations: &[Vec<Term>]) -> Vec<Vec<Square>> {
        let rows = equations.iter().map(|terms| squares(terms)).enumerate();
        let rows: Vec<_> = rows
            .filter_map(|(e, squares)| Some((e, squares?)))
            .collect();
        let mut out = Vec::new();
        for (k, (e, row)) in rows.iter().enumerate() {
            let right = &self.rights[*e];
            // An enclosure of width 0 is exact.
            if right.at_target() == ZERO {
                out.push(row.clone());
                continue;
            }
            for (other, less) in &rows[..k] {
                let other = &self.rights[*other];
                if other.at_target() == right.at_target()
                    && other.ball_at_target() == right.ball_at_target()
                {
                    let less = less.iter().map(|&(factor, ends)| (-factor, ends));
                    out.push(row.iter().copied().chain(less).collect());
                }
            }
        }
        out
    }
}

/// What an equation with 0 on the right says, if it is v − k u = 0.
fn component(terms: &[Term]) -> Option<Component> {
    let [one, other] = terms else { return None };
    let Form::Difference(Some(length), None) = other.left else {
        return None;
    };
    (one.right == Form::One && other.factor == -one.factor).then_some(Component {
        length,
        vector: one.left,
        heading: other.right,
    })
}

/// The squares that a sum of terms is, if it is one of squares.
fn squares(terms: &[Term]) -> Option<Vec<Square>> {
    let squares = terms.iter().map(|term| match term.left {
        Form::Difference(a, b) if term.right == term.left => Some((term.factor, [a, b])),
        _ => None,
    });
    squares.collect()
}

/// v x − w u for all v = k u and w = k x.
fn parallel(components: &[Component]) -> Vec<Vec<Term>> {
    let rows = components.iter().enumerate().flat_map(|(i, one)| {
        let same = components[..i].iter();
        let same = same.filter(|other| other.length == one.length);
        same.map(|other| {
            vec![
                Term::new(2, one.vector, other.heading),
                Term::new(-2, other.vector, one.heading),
            ]
        })
    });
    rows.collect()
}

/// The heading of the difference of two entries, if that is a vector's component or (with −1) its opposite.
fn heading(
    [a, b]: [Option<usize>; 2],
    components: &[&Component],
) -> Option<(i32, Form<Option<usize>>)> {
    components.iter().find_map(|c| match c.vector {
        vector if vector == Form::Difference(a, b) => Some((1, c.heading)),
        vector if vector == Form::Difference(b, a) => Some((-1, c.heading)),
        _ => None,
    })
}

/// A sum of squares without the length that all components have in common, if each square has that or is one of two that have it together.
fn divided(mut sum: Vec<Square>, components: &[&Component]) -> Option<Vec<Term>> {
    let mut out = Vec::new();
    sum.retain(|(_, [a, b])| a != b);
    while let Some((factor, p)) = sum.pop() {
        let mut tell = |(sign, heading): (i32, Form<_>), [a, b]: [Option<usize>; 2]| {
            out.push(Term::new(factor * sign, heading, Form::Difference(a, b)));
        };
        if let Some(found) = heading(p, components) {
            tell(found, p);
            continue;
        }
        let pair = sum.iter().enumerate().find_map(|(k, &(other, [c, d]))| {
            let both = [[c, d], [d, c]].into_iter();
            both.filter(|_| other == -factor).find_map(|q| {
                let less = match (p[0] == q[0], p[1] == q[1]) {
                    (_, true) => [p[0], q[0]],
                    (true, _) => [q[1], p[1]],
                    _ => return None,
                };
                heading(less, components).map(|found| (k, q, found))
            })
        });
        let (k, q, found) = pair?;
        sum.swap_remove(k);
        tell(found, p);
        tell(found, q);
    }
    (!out.is_empty()).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = b − a along two axes, with entries a 0 1, b 2 3, c 4 5, u 6 7 and L 8; `None` is the number 0.
    fn components() -> [Component; 2] {
        [0, 1].map(|axis| Component {
            length: 8,
            vector: Form::Difference(Some(2 + axis), Some(axis)),
            heading: Form::Difference(Some(6 + axis), None),
        })
    }

    fn squares(factor: i32, from: usize, to: usize) -> [Square; 2] {
        [0, 1].map(|axis| (factor, [from, to].map(|point| Some(point + axis))))
    }

    /// The quotient times the length is the sum.
    fn is_quotient(sum: &[Square], terms: &[Term]) {
        let (a, u, c, length) = ([0.25, -1.5], [0.5, 2.0], [3.0, 1.25], 1.75);
        let b = [0, 1].map(|k| a[k] + length * u[k]);
        let at: [f64; 9] = [a[0], a[1], b[0], b[1], c[0], c[1], u[0], u[1], length];
        let at = |entry: Option<usize>| entry.map_or(0.0, |i| at[i]);
        let squares = sum
            .iter()
            .map(|&(f, [i, j])| f64::from(f) * (at(i) - at(j)).powi(2));
        let value = |term: &Term| f64::from(term.factor) * term.value(at);
        let quotient: f64 = terms.iter().map(value).sum();
        assert!((squares.sum::<f64>() - length * quotient).abs() < 1e-12);
    }

    #[test]
    fn a_difference_of_squares_is_divided_by_the_length() {
        let components = components();
        let components: Vec<&Component> = components.iter().collect();
        for (first, second) in [([2, 4], [0, 4]), ([4, 2], [0, 4]), ([4, 0], [2, 4])] {
            let one = squares(1, first[0], first[1]);
            let other = squares(-1, second[0], second[1]);
            let sum = [one, other].concat();
            let terms = divided(sum.clone(), &components).unwrap();
            assert_eq!(terms.len(), 4);
            is_quotient(&sum, &terms);
        }
        let own = squares(-4, 0, 2).to_vec();
        is_quotient(&own, &divided(own.clone(), &components).unwrap());
    }

    #[test]
    fn what_is_no_multiple_is_left() {
        let components = components();
        let components: Vec<&Component> = components.iter().collect();
        // Other factors, a sum, one square too many.
        let b_to_c = squares(2, 2, 4);
        assert!(divided([b_to_c, squares(-4, 0, 4)].concat(), &components).is_none());
        assert!(divided([b_to_c, squares(2, 0, 4)].concat(), &components).is_none());
        let alone = [0, 1].map(|axis| (2, [Some(4 + axis), None]));
        let more = [b_to_c, squares(-2, 0, 4), alone].concat();
        assert!(divided(more, &components).is_none());
        assert!(divided(Vec::new(), &components).is_none());
    }
}
