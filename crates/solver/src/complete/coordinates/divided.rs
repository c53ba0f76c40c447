//! Equations divided by the length of a vector, which is positive in figures.
//!
//! Where c is as far from a as from b, and b − a = L u with a heading u, the difference of the squares of the distances is
//! (b − a)·((b − c) + (a − c)) = L u·((b − c) + (a − c)) = 0. It holds for L = 0 whatever u is, and near there no search over
//! ranges can tell anything; but L > 0 in every figure, so that u·((b − c) + (a − c)) = 0: c is on the bisector.

use super::system::{Form, Product, Row, System};
use crate::interval::{ZERO, point};
use crate::order::each_once;
use crate::system::Homotopy;

/// One component v of a vector with that of its heading u: v = L u.
struct Component {
    /// L.
    length: usize,
    /// v, an entry less another one.
    vector: [usize; 2],
    /// u.
    heading: Form,
}

/// A factor, and the difference of two entries of which it multiplies the square.
type Square = (f64, [usize; 2]);

impl System {
    /// What follows in figures from differences of squares that are 0.
    pub(super) fn divided(&self, homotopy: &Homotopy) -> Vec<Row> {
        let components = self.headings();
        if components.is_empty() {
            return Vec::new();
        }
        let lengths = each_once(components.iter().map(|c| c.length));
        let mut out = Vec::new();
        for sum in self.differences(homotopy) {
            for &length in &lengths {
                let components: Vec<&Component> =
                    components.iter().filter(|c| c.length == length).collect();
                if let Some(products) = divide(sum.clone(), &components) {
                    out.push(Row::new(products, ZERO, self.unknowns));
                }
            }
        }
        out
    }

    /// The components of vectors that are a positive length times a heading's.
    fn headings(&self) -> Vec<Component> {
        let rows = self.rows[..self.unknowns].iter();
        let parallel = rows.filter_map(|row| self.parallel(row));
        let part = parallel.filter_map(|(length, vector, heading)| match vector {
            Form::Difference(a, b) if self.positive.contains(&length) => Some(Component {
                length,
                vector: [a, b],
                heading,
            }),
            _ => None,
        });
        part.collect()
    }

    /// Sums of squares with factors that are exactly 0: an equation, or the difference of two with the same right-hand side.
    fn differences(&self, homotopy: &Homotopy) -> Vec<Vec<Square>> {
        let squares = |row: &Row| -> Option<Vec<Square>> {
            let squares = row.products.iter().map(|p| match (p.left, p.right) {
                (Form::Difference(a, b), Form::Difference(c, d)) if [a, b] == [c, d] => {
                    Some((p.factor.mid(), [a, b]))
                }
                _ => None,
            });
            squares.collect()
        };
        let rows = self.rows[..self.unknowns].iter().enumerate();
        let rows: Vec<_> = rows
            .filter_map(|(e, row)| Some((e, squares(row)?)))
            .collect();
        let mut out = Vec::new();
        for (k, (e, row)) in rows.iter().enumerate() {
            if self.rows[*e].right == ZERO {
                out.push(row.clone());
                continue;
            }
            let right = homotopy.rights[*e].ball_at_target();
            for (other, less) in &rows[..k] {
                if self.rows[*other].right == self.rows[*e].right
                    && homotopy.rights[*other].ball_at_target() == right
                {
                    let less = less.iter().map(|&(factor, ends)| (-factor, ends));
                    out.push(row.iter().copied().chain(less).collect());
                }
            }
        }
        out
    }
}

/// How often a vector's component is in the difference of two entries: 1, −1 or not at all, with its heading.
fn within(difference: [usize; 2], components: &[&Component]) -> Option<(f64, Form)> {
    components.iter().find_map(|part| {
        let [a, b] = part.vector;
        match difference {
            ends if ends == [a, b] => Some((1.0, part.heading)),
            ends if ends == [b, a] => Some((-1.0, part.heading)),
            _ => None,
        }
    })
}

/// A sum of squares divided by a length, if each square has another one with which it makes a multiple of the length:
/// p² − q² = (p − q)(p + q), and p − q is a component of the vector.
fn divide(mut sum: Vec<Square>, components: &[&Component]) -> Option<Vec<Product>> {
    let mut out = Vec::new();
    sum.retain(|(_, [a, b])| a != b);
    let mut tell = |factor: f64, heading: Form, [a, b]: [usize; 2]| {
        out.push(Product {
            factor: point(factor),
            left: heading,
            right: Form::Difference(a, b),
        });
    };
    while let Some((factor, p)) = sum.pop() {
        if let Some((sign, heading)) = within(p, components) {
            tell(factor * sign, heading, p);
            continue;
        }
        let pairs = sum.iter().enumerate().find_map(|(k, &(other, [c, d]))| {
            let both = [[c, d], [d, c]].into_iter();
            let found = both.filter(|_| other == -factor).find_map(|q| {
                let less = match (p[0] == q[0], p[1] == q[1]) {
                    (_, true) => [p[0], q[0]],
                    (true, _) => [q[1], p[1]],
                    _ => return None,
                };
                within(less, components).map(|found| (q, found))
            });
            found.map(|found| (k, found))
        });
        let (k, (q, (sign, heading))) = pairs?;
        sum.swap_remove(k);
        tell(factor * sign, heading, p);
        tell(factor * sign, heading, q);
    }
    (!out.is_empty()).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = b − a along two axes, with entries a 0 1, b 2 3, c 4 5, u 6 7 and L 8; 9 is the number 0.
    fn components() -> [Component; 2] {
        [0, 1].map(|axis| Component {
            length: 8,
            vector: [2 + axis, axis],
            heading: Form::Difference(6 + axis, 9),
        })
    }

    fn squares(factor: f64, from: usize, to: usize) -> [Square; 2] {
        [0, 1].map(|axis| (factor, [from + axis, to + axis]))
    }

    /// The quotient times the length is the sum.
    fn is_quotient(sum: &[Square], products: &[Product]) {
        let (a, u, c, length) = ([0.25, -1.5], [0.5, 2.0], [3.0, 1.25], 1.75);
        let b = [0, 1].map(|k| a[k] + length * u[k]);
        let at: [f64; 10] = [a[0], a[1], b[0], b[1], c[0], c[1], u[0], u[1], length, 0.0];
        let squares = sum.iter().map(|&(f, [i, j])| f * (at[i] - at[j]).powi(2));
        let value = |p: &Product| p.factor.mid() * p.value(|entry| at[entry]);
        let quotient: f64 = products.iter().map(value).sum();
        assert!((squares.sum::<f64>() - length * quotient).abs() < 1e-12);
    }

    #[test]
    fn a_difference_of_squares_is_divided_by_the_length() {
        let components = components();
        let components: Vec<&Component> = components.iter().collect();
        for (first, second) in [([2, 4], [0, 4]), ([4, 2], [0, 4]), ([4, 0], [2, 4])] {
            let one = squares(0.5, first[0], first[1]);
            let other = squares(-0.5, second[0], second[1]);
            let sum = [one, other].concat();
            let products = divide(sum.clone(), &components).unwrap();
            assert_eq!(products.len(), 4);
            is_quotient(&sum, &products);
        }
        let own = squares(-2.0, 0, 2).to_vec();
        is_quotient(&own, &divide(own.clone(), &components).unwrap());
    }

    #[test]
    fn what_is_no_multiple_is_left() {
        let components = components();
        let components: Vec<&Component> = components.iter().collect();
        // Other factors, a sum, one square too many.
        let b_to_c = squares(1.0, 2, 4);
        assert!(divide([b_to_c, squares(-2.0, 0, 4)].concat(), &components).is_none());
        assert!(divide([b_to_c, squares(1.0, 0, 4)].concat(), &components).is_none());
        let more = [b_to_c, squares(-1.0, 0, 4), squares(1.0, 4, 9)].concat();
        assert!(divide(more, &components).is_none());
        assert!(divide(Vec::new(), &components).is_none());
    }
}
