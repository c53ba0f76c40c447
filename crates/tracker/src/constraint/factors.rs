//! Equations without what is zero in all figures, and without factors that are zero in none.
//!
//! The right angle between a vertical line and a radius is an equation d_x r_x + d_y r_y = 0 in which d_x is zero, as the line is vertical,
//! and d_y is not, as the line has a direction: r_y = 0. The first form is singular where d_y = 0, and ties r_y to the length of
//! the line; the second one is a coordinate that is another one. For a search for all figures this is the difference between a block
//! of dozens of unknowns with zeros that no figure is near, and blocks of one or two.
//!
//! What is left holds at a figure where the given equations do: each equality that was used stays an equation, so that what
//! was left out of others is zero; and an equation that was divided is the quotient times its factor. At t = 1 alone.

use super::diameters;
use super::quadratic::{Entry, Form, Product, Role, Tail};
use super::subtracted;
use super::zeros::at_target;
use crate::interval::{Interval, Real};
use crate::map::Map;
use crate::order::each_once;
use crate::places::Each as _;

/// What is equal at t = 1: the number 0 stands for all that is zero.
#[derive(Default)]
pub struct Equal(Map<Entry, Entry>);

impl Equal {
    /// What stands for all that is equal to this.
    fn root(&self, mut of: Entry) -> Entry {
        while let Some(&next) = self.0.get(&of) {
            of = next;
        }
        of
    }

    /// A difference, by what stands for its entries. `None`: it is the number 1.
    pub fn ends(&self, form: Form) -> Option<[Entry; 2]> {
        match form {
            Form::One => None,
            Form::Difference(a, b) => Some([a, b].each(|entry| self.root(entry))),
        }
    }

    /// A difference, by what stands for its entries, in order, and its sign. `None`: it is zero, or the number 1.
    pub fn ordered(&self, form: Form) -> Option<([Entry; 2], i32)> {
        let [a, b] = self.ends(form)?;
        match a.cmp(&b) {
            std::cmp::Ordering::Equal => None,
            std::cmp::Ordering::Less => Some(([a, b], -1)),
            std::cmp::Ordering::Greater => Some(([b, a], 1)),
        }
    }

    fn is_zero(&self, form: Form) -> bool {
        form != Form::One && self.ordered(form).is_none()
    }

    /// Products that are not zero.
    pub fn left<'a>(&'a self, products: &'a [Product]) -> impl Iterator<Item = &'a Product> {
        products
            .iter()
            .filter(|p| !self.is_zero(p.left) && !self.is_zero(p.right))
    }

    /// Notes that two are equal; whether that is new.
    fn join(&mut self, a: Entry, b: Entry) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.0.insert(a.max(b), a.min(b));
        }
        a != b
    }
}

/// Takes out of equations what is zero at t = 1, and the factors that are zero in no figure, and calls equal entries by one name.
///
/// `vanishing`: for each equation whether its right-hand side is known to be zero at t = 1. `apart`: pairs of points that have a positive distance.
pub fn take_out(tail: &mut Tail, vanishing: &[bool], apart: &[[usize; 2]], dimension: usize) {
    let mut equal = Equal::default();
    // An equation that is changed has 0 on the right, before and after.
    let rights = rights_at_target(tail, vanishing);
    let vectors = vectors(tail, apart, dimension);
    // Equalities, by which others are changed, stay as they are.
    let mut is_kept = vec![false; tail.equations.len()];
    loop {
        let mut goes_on = false;
        let nonzero = nonzero(tail, &vectors, &equal, &rights);
        for e in 0..tail.equations.len() {
            if !rights[e].is_zero() || is_kept[e] {
                continue;
            }
            let equation = &mut tail.equations[e];
            if let Some((by, products)) = divided(&equation.products, &equal, &nonzero) {
                equation.power -= power(&tail.unknowns, by);
                equation.products = products;
                equation.right = vec![Real::zero()];
                goes_on = true;
            }
            if let [single] = equal.left(&tail.equations[e].products).collect::<Vec<_>>()[..]
                && let (Form::Difference(a, b), Form::One) | (Form::One, Form::Difference(a, b)) =
                    (single.left, single.right)
            {
                let single = *single;
                is_kept[e] = equal.join(a, b);
                goes_on |= is_kept[e];
                tail.equations[e].products = vec![single];
            }
        }
        if !goes_on {
            break;
        }
    }
    if dimension == 2 {
        let is_apart = |[p, q]: [[Entry; 2]; 2]| {
            vectors.iter().any(|forms| {
                let mut axes = forms.iter().zip(p).zip(q);
                axes.all(|((&form, p), q)| [Some([p, q]), Some([q, p])].contains(&equal.ends(form)))
            })
        };
        diameters::halve(tail, &rights, &equal, &is_kept, is_apart);
    }
    // Those of chords are others now.
    let mut rights = rights_at_target(tail, vanishing);
    subtracted::subtract(tail, &mut rights, &equal, &is_kept);
    for (equation, is_kept) in tail.equations.iter_mut().zip(is_kept) {
        let left = equal.left(&equation.products);
        let left: Vec<Product> = left.map(|p| p.map(|e| equal.root(e))).collect();
        // Of one that holds by others nothing would be left.
        if !is_kept && !left.is_empty() {
            equation.products = left;
        }
    }
}

/// The right-hand sides at t = 1.
fn rights_at_target(tail: &Tail, vanishing: &[bool]) -> Vec<Real> {
    let rights = tail.equations.iter().zip(vanishing);
    let rights = rights.map(|(equation, &vanishing)| at_target(equation, vanishing));
    rights.collect()
}

/// The vectors that vanish in no figure, with a difference for each axis: those that are said not to, and those between points that have a distance.
fn vectors(tail: &Tail, apart: &[[usize; 2]], dimension: usize) -> Vec<Vec<Form>> {
    let said = tail.nonzero.iter();
    let said = said.map(|vector| vector.forms[..dimension].to_vec());
    let between = |&[a, b]: &[usize; 2]| {
        let at = |point, axis| Entry::Coordinate { point, axis };
        let form = |axis| Form::Difference(at(a, axis), at(b, axis));
        (0..dimension).map(form).collect()
    };
    said.chain(apart.iter().map(between)).collect()
}

/// The differences that are zero in no figure: lengths, and what alone is left of a vector that must not vanish, or has a length.
fn nonzero(tail: &Tail, vectors: &[Vec<Form>], equal: &Equal, rights: &[Real]) -> Vec<[Entry; 2]> {
    let mut out = Vec::new();
    for (u, unknown) in tail.unknowns.iter().enumerate() {
        if unknown.role == Role::Positive {
            let form = Form::Difference(Entry::Unknown(u), Entry::Zero);
            out.extend(equal.ordered(form).map(|(ends, _)| ends));
        }
    }
    let mut add = |vector: &[Form]| {
        let mut left = vector.iter().filter(|&&form| !equal.is_zero(form));
        if let (Some(&only), None) = (left.next(), left.next()) {
            out.extend(equal.ordered(only).map(|(ends, _)| ends));
        }
    };
    for vector in vectors {
        add(vector);
    }
    // Squares whose sum is not zero.
    for (equation, right) in tail.equations.iter().zip(rights) {
        let is_square = |p: &Product| p.left == p.right && p.left != Form::One;
        let is_given = |x: Interval| x.inf() > 0.0 || x.sup() < 0.0;
        if !right.is_zero() && equation.products.iter().all(is_square) && is_given(right.enclose())
        {
            let forms: Vec<Form> = equation.products.iter().map(|p| p.left).collect();
            add(&forms);
        }
    }
    each_once(out)
}

/// A sum of products that is zero without a factor that all have and that is not zero: the factor, and the rest of each.
fn divided(
    products: &[Product],
    equal: &Equal,
    nonzero: &[[Entry; 2]],
) -> Option<(Form, Vec<Product>)> {
    let left: Vec<Product> = equal.left(products).copied().collect();
    let first = left.first()?;
    let factors = [first.left, first.right].into_iter();
    let mut factors = factors.filter_map(|form| Some((form, equal.ordered(form)?)));
    factors.find_map(|(by, (ends, sign))| {
        nonzero.binary_search(&ends).ok()?;
        let rest = left.iter().map(|p| {
            let both = [(p.left, p.right), (p.right, p.left)].into_iter();
            both.filter(|(_, other)| *other != Form::One)
                .find_map(|(this, other)| {
                    let (own, turn) = equal.ordered(this)?;
                    (own == ends).then(|| Product::new(p.factor * sign * turn, other, Form::One))
                })
        });
        Some((by, rest.collect::<Option<Vec<_>>>()?))
    })
}

/// The power of the unit of length that a difference has.
pub fn power(unknowns: &[super::Unknown], form: Form) -> i32 {
    let of = |entry: Entry| match entry {
        Entry::Zero => None,
        Entry::Coordinate { .. } => Some(1),
        Entry::Unknown(u) => Some(unknowns[u].power),
    };
    match form {
        Form::One => 0,
        Form::Difference(a, b) => of(a).or(of(b)).unwrap_or(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::{Equation, Nonzero, coordinate, difference, value};

    fn equation(products: Vec<Product>, right: i64, power: i32) -> Equation {
        Equation {
            name: "one".to_owned(),
            products,
            right: vec![Real::whole(right)],
            power,
        }
    }

    fn vector(a: usize, b: usize) -> [Form; 2] {
        [0, 1].each(|axis| difference(coordinate(a, axis), coordinate(b, axis)))
    }

    fn dot([a, b]: [Form; 2], [c, d]: [Form; 2]) -> Equation {
        equation(vec![Product::new(2, a, c), Product::new(2, b, d)], 0, 2)
    }

    fn equal(form: Form) -> Equation {
        equation(vec![Product::new(2, form, Form::One)], 0, 1)
    }

    fn taken_out(mut tail: Tail, apart: &[[usize; 2]]) -> Tail {
        let vanishing = vec![false; tail.equations.len()];
        take_out(&mut tail, &vanishing, apart, 2);
        tail
    }

    /// A line p0-p1 that is vertical, and a radius p2-p1 at a right angle to it.
    fn vertical() -> Tail {
        let (line, radius) = (vector(0, 1), vector(2, 1));
        Tail {
            equations: vec![dot(line, radius), equal(line[0])],
            ..Tail::default()
        }
    }

    #[test]
    fn a_radius_at_a_right_angle_to_a_vertical_line_is_horizontal() {
        let [_, y] = vector(2, 1);
        let horizontal = vec![Product::new(2, y, Form::One)];
        // Only if the line has a direction, by what is said of it or by its length.
        let given = vertical();
        let left = taken_out(given.clone(), &[]);
        let rest = vec![Product::new(2, vector(0, 1)[1], y)];
        assert_eq!(left.equations[0].products, rest);
        assert_eq!(left.equations[1], given.equations[1]);
        for apart in [[0, 1], [1, 0]] {
            let left = taken_out(given.clone(), &[apart]);
            assert_eq!(left.equations[0].products, horizontal);
            assert_eq!(left.equations[0].power, 1);
        }
        let mut named = given.clone();
        let [x, y] = vector(1, 0);
        named.nonzero.push(Nonzero {
            name: "p1-p0".to_owned(),
            forms: [x, y, value(Entry::Zero)],
        });
        // The vector is said the other way round.
        assert_eq!(taken_out(named, &[]).equations[0].products, horizontal);
        let mut squared = given;
        let squares = vector(0, 1).each(|form| Product::new(1, form, form));
        squared.equations.push(equation(squares.to_vec(), 8, 2));
        let left = taken_out(squared, &[]);
        assert_eq!(left.equations[0].products, horizontal);
        assert_eq!(left.equations[2].products, [squares[1]]);
    }

    #[test]
    fn what_follows_is_used_and_what_is_used_stays() {
        // The radius is horizontal, so that a line at a right angle to it is vertical: p3-p2.
        let mut tail = vertical();
        tail.equations.insert(0, dot(vector(3, 2), vector(2, 1)));
        let [x, _] = vector(3, 2);
        let apart = [[0, 1], [1, 2]];
        let left = taken_out(tail.clone(), &apart);
        assert_eq!(left.equations[0].products, [Product::new(2, x, Form::One)]);
        // Where that is said, too, nothing would be left of the first one, which stays as it is.
        tail.equations.push(equal(x));
        let left = taken_out(tail.clone(), &apart);
        assert_eq!(left.equations[0], tail.equations[0]);
        assert_eq!(left.equations[3], tail.equations[3]);
    }

    #[test]
    fn what_is_not_zero_or_may_be_stays() {
        let (line, radius) = (vector(0, 1), vector(2, 1));
        // A right-hand side that is not zero; no vertical line; no factor that all products have.
        let mut given = vertical();
        given.equations[0].right = vec![Real::whole(3)];
        let left = taken_out(given.clone(), &[[0, 1]]);
        assert_eq!(
            left.equations[0].products,
            [Product::new(2, line[1], radius[1])]
        );
        let slanted = Tail {
            equations: vec![dot(line, radius)],
            ..Tail::default()
        };
        assert_eq!(taken_out(slanted.clone(), &[[0, 1]]), slanted);
        given = vertical();
        given.equations[0]
            .products
            .push(Product::new(2, radius[0], radius[0]));
        let left = taken_out(given, &[[0, 1]]);
        assert_eq!(left.equations[0].products.len(), 2);
    }
}
