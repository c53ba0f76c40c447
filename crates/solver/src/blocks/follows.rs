//! Which equations follow from others exactly, at every figure: an identity of polynomials with rational coefficients.
//!
//! With the left-hand sides L of equations L = E and rational numbers c and d,
//!
//! ```text
//! L_r = Σ c_i L_i + Σ d_kj (L_k − E_k) x_j,
//! ```
//!
//! where the k are linear equations with constant rational right-hand sides and the x_j unknowns, means that wherever the
//! others hold L_r is Σ c_i E_i: so the equation r holds if E_r is that, and not otherwise. This is found by elimination over
//! the rational numbers. What follows for another reason (of two lines parallel to a third, by cases) is not found.

use super::Row;
use crate::interval::Real;
use crate::map::Map;
use crate::order::each_once;
use crate::rational::Rational;
use crate::system::Term;
use num_bigint::BigInt;

/// Larger eliminations are not made: nothing is said then.
const MOST: usize = 600;

/// A product of unknowns, none, one or two of them, in order.
type Monomial = Vec<usize>;

/// A polynomial.
type Polynomial = Map<Monomial, Rational>;

/// An equation that holds.
#[derive(Debug, Clone)]
pub struct Given {
    left: Polynomial,
    /// Its right-hand side, if that is a constant ratio and the left-hand side linear.
    constant: Option<Rational>,
}

/// How an equation follows.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The equations i, by their places among those given, with their factors.
    pub sum: Vec<(usize, Rational)>,
    /// The equations k, which must keep their right-hand sides.
    pub kept: Vec<usize>,
}

impl Given {
    /// A row with its right-hand side.
    pub fn row(row: &Row, right: &[Real]) -> Self {
        let left = polynomial(&row.products);
        let is_linear = left.keys().all(|monomial| monomial.len() <= 1);
        Given {
            constant: constant(right).filter(|_| is_linear),
            left,
        }
    }

    /// An unknown that is held at a number.
    pub fn held(unknown: usize, at: &Real) -> Self {
        Given {
            left: Map::sums([(vec![unknown], Rational::one())]),
            constant: at.as_rational().cloned(),
        }
    }

    /// Its right-hand side, if it may be multiplied by unknowns.
    pub fn constant(&self) -> Option<&Rational> {
        self.constant.as_ref()
    }
}

/// The value of a right-hand side that is a constant ratio.
fn constant(right: &[Real]) -> Option<Rational> {
    let (first, rest) = right.split_first()?;
    let stays = rest.iter().all(Real::is_zero);
    first.as_rational().filter(|_| stays).cloned()
}

/// ½ Σ factor · left · right, multiplied out.
fn polynomial(products: &[Term]) -> Polynomial {
    let all = products.iter().flat_map(|p| p.multiplied_out());
    let half = |factor| Rational::new(BigInt::from(factor), 2.into());
    Map::sums(all.map(|(monomial, factor)| (monomial, half(factor))))
}

/// A polynomial, and the given equations, times unknowns or not, that it is made of.
#[derive(Debug, Clone)]
struct Made {
    polynomial: Polynomial,
    of: Map<(usize, Option<usize>), Rational>,
}

impl Made {
    /// Takes a multiple of another away.
    fn reduce(&mut self, other: &Made, factor: &Rational) {
        self.polynomial.add(&-factor, &other.polynomial);
        self.of.add(&-factor, &other.of);
    }
}

/// How the left-hand side of a row is made of those given; `None`: it is not, or nothing can be said.
pub fn combination(row: &Row, given: &[Given]) -> Option<Combination> {
    let target = polynomial(&row.products);
    let mut made: Vec<Made> = Vec::new();
    for (index, one) in given.iter().enumerate() {
        made.push(Made {
            polynomial: one.left.clone(),
            of: Map::sums([((index, None), Rational::one())]),
        });
    }
    // Unknowns that stand beside another one in a product.
    let all = given.iter().map(|one| &one.left).chain([&target]);
    let mut partners: Map<usize, Vec<usize>> = Map::default();
    for monomial in all.flat_map(|left| left.keys()) {
        if let [a, b] = monomial[..] {
            partners.or_insert(a, Vec::new()).push(b);
            partners.or_insert(b, Vec::new()).push(a);
        }
    }
    for (index, one) in given.iter().enumerate() {
        let Some(constant) = &one.constant else {
            continue;
        };
        let unknowns = one.left.keys().flatten();
        let beside = unknowns.filter_map(|u| partners.get(u)).flatten();
        for x in each_once(beside.copied()) {
            let products = one.left.iter().map(|(monomial, factor)| {
                let mut product = [monomial.as_slice(), &[x]].concat();
                product.sort_unstable();
                (product, factor.clone())
            });
            made.push(Made {
                polynomial: Map::sums(products.chain([(vec![x], -constant)])),
                of: Map::sums([((index, Some(x)), Rational::one())]),
            });
        }
    }
    if made.len() > MOST {
        return None;
    }
    let mut basis: Map<Monomial, Made> = Map::default();
    let reduced = |mut one: Made, basis: &Map<Monomial, Made>| {
        let mut done: Option<Monomial> = None;
        loop {
            let next = one
                .polynomial
                .iter()
                .rev()
                .find(|(monomial, _)| done.as_ref().is_none_or(|d| *monomial < d));
            let Some((monomial, factor)) = next.map(|(m, f)| (m.clone(), f.clone())) else {
                return one;
            };
            if let Some(other) = basis.get(&monomial) {
                one.reduce(other, &factor);
            }
            done = Some(monomial);
        }
    };
    for one in made {
        let mut one = reduced(one, &basis);
        let Some((monomial, factor)) = one.polynomial.iter().next_back() else {
            continue;
        };
        let (monomial, per) = (monomial.clone(), factor.recip());
        one.polynomial.values_mut().for_each(|x| *x *= &per);
        one.of.values_mut().for_each(|x| *x *= &per);
        basis.insert(monomial, one);
    }
    let wanted = Made {
        polynomial: target,
        of: Map::default(),
    };
    let left = reduced(wanted, &basis);
    if !left.polynomial.is_empty() {
        return None;
    }
    let (mut sum, mut kept) = (Vec::new(), Vec::new());
    for ((index, times), factor) in left.of {
        match times {
            None => sum.push((index, -factor)),
            Some(_) => kept.push(index),
        }
    }
    let kept = each_once(kept);
    Some(Combination { sum, kept })
}

impl Combination {
    /// Whether the equations that must keep their right-hand sides do so.
    fn are_kept<'r>(
        &self,
        of: impl Fn(usize) -> Vec<Real>,
        before: impl Fn(usize) -> Option<&'r Rational>,
    ) -> bool {
        let mut kept = self.kept.iter();
        kept.all(|&k| constant(&of(k)).as_ref() == before(k))
    }

    /// Whether with these right-hand sides, polynomials in t, the equation holds wherever the given ones do, for every t.
    /// `before`: the right-hand sides with which it was found.
    pub fn holds<'r>(
        &self,
        right: &[Real],
        of: impl Fn(usize) -> Vec<Real>,
        before: impl Fn(usize) -> Option<&'r Rational>,
    ) -> bool {
        if !self.are_kept(&of, before) {
            return false;
        }
        let mut terms: Vec<(Rational, Vec<Real>)> = vec![(-Rational::one(), right.to_vec())];
        terms.extend(self.sum.iter().map(|(i, factor)| (factor.clone(), of(*i))));
        let longest = terms.iter().map(|(_, right)| right.len()).max();
        (0..longest.unwrap_or(0)).all(|power| {
            let at_power = terms
                .iter()
                .filter_map(|(factor, right)| Some((factor, right.get(power)?)));
            is_zero(at_power)
        })
    }

    /// What the right-hand side has to be with these of the given equations, numbers for all t.
    pub fn value(&self, of: impl Fn(usize) -> Vec<Real>) -> Real {
        let terms = self.sum.iter();
        terms.fold(Real::zero(), |sum, (i, factor)| {
            &sum + &(&Real::from(factor.clone()) * &number(&of(*i)))
        })
    }

    /// Whether with these right-hand sides, numbers for all t, it is certain that the equation does not hold where the given
    /// ones do. `before`: see [`Combination::holds`].
    pub fn fails<'r>(
        &self,
        right: &[Real],
        of: impl Fn(usize) -> Vec<Real>,
        before: impl Fn(usize) -> Option<&'r Rational>,
    ) -> bool {
        if !self.are_kept(&of, before) {
            return false;
        }
        let off = &number(right) - &self.value(of);
        match off.as_rational() {
            Some(off) => !off.is_zero(),
            None => !off.enclose().contains(0.0),
        }
    }
}

/// What a right-hand side is at t = 1.
fn number(right: &[Real]) -> Real {
    right.iter().fold(Real::zero(), |sum, c| &sum + c)
}

/// Whether a sum of multiples of numbers is zero; numbers that are no ratios are told apart by how they are written.
fn is_zero<'r>(terms: impl Iterator<Item = (&'r Rational, &'r Real)>) -> bool {
    let mut ratio = Rational::zero();
    let mut others: Vec<(&Real, Rational)> = Vec::new();
    for (factor, number) in terms {
        match number.as_rational() {
            Some(value) => ratio += factor * value,
            None => match others.iter_mut().find(|(other, _)| *other == number) {
                Some((_, sum)) => *sum += factor,
                None => others.push((number, factor.clone())),
            },
        }
    }
    ratio.is_zero() && others.iter().all(|(_, sum)| sum.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::Form;

    fn row(products: Vec<Term>) -> Row {
        // Equations have ½ on the left.
        let twice = |p: Term| Term::new(2 * p.factor, p.left, p.right);
        Row {
            index: 0,
            products: products.into_iter().map(twice).collect(),
            unknowns: Vec::new(),
        }
    }

    fn between(a: usize, b: usize) -> Form<Option<usize>> {
        Form::Difference(Some(a), Some(b))
    }

    fn whole(x: i64) -> Vec<Real> {
        vec![Real::whole(x)]
    }

    #[test]
    fn a_chain_of_differences_gives_the_last_one() {
        let one = row(vec![Term::new(1, between(0, 1), Form::One)]);
        let two = row(vec![Term::new(1, between(1, 2), Form::One)]);
        let sum = row(vec![Term::new(1, between(0, 2), Form::One)]);
        let rights = [whole(3), whole(4)];
        let given = [Given::row(&one, &rights[0]), Given::row(&two, &rights[1])];
        let found = combination(&sum, &given).unwrap();
        let of = |rights: [Vec<Real>; 2]| move |i: usize| rights[i].clone();
        let before = |k: usize| given[k].constant();
        assert!(found.holds(&whole(7), of(rights.clone()), before));
        assert!(!found.holds(&whole(8), of(rights.clone()), before));
        assert!(found.fails(&whole(8), of(rights.clone()), before));
        assert!(!found.fails(&whole(7), of(rights.clone()), before));
        let root = vec![Real::whole(49).sqrt()];
        assert!(!found.fails(&root, of(rights.clone()), before));
        let root = vec![Real::whole(50).sqrt()];
        assert!(found.fails(&root, of(rights.clone()), before));
        // Both move, and the sum with them.
        let moving = |from: i64, by: i64| vec![Real::whole(from), Real::whole(by)];
        let rights = [moving(3, 1), moving(4, 2)];
        assert!(found.holds(&moving(7, 3), of(rights.clone()), before));
        assert!(!found.holds(&moving(7, 2), of(rights), before));
        let other = row(vec![Term::new(1, between(0, 3), Form::One)]);
        assert_eq!(combination(&other, &given), None);
    }

    /// A bar of which both ends have the same y is as long as its ends are apart in x: (x0 − x1)² follows from
    /// x0 − x1 = 5.
    #[test]
    fn a_square_follows_from_what_is_squared() {
        let line = row(vec![Term::new(1, between(0, 1), Form::One)]);
        let square = row(vec![Term::new(1, between(0, 1), between(0, 1))]);
        let given = [Given::row(&line, &whole(5))];
        let found = combination(&square, &given).unwrap();
        // L_r = (x0 − x1 − 5)(x0 − x1) + 5 (x0 − x1).
        assert_eq!(found.kept.len(), 1);
        let before = |k: usize| given[k].constant();
        assert!(found.holds(&whole(25), |_| whole(5), before));
        assert!(!found.holds(&whole(24), |_| whole(5), before));
        // That the length moves is another identity, which was not found.
        assert!(!found.holds(&whole(36), |_| whole(6), before));
    }

    #[test]
    fn equal_squares_add_up() {
        let square = |a: usize, b: usize| Term::new(1, between(a, b), between(a, b));
        let minus = |p: Term| Term::new(-p.factor, p.left, p.right);
        let ab = row(vec![square(0, 1), minus(square(2, 3))]);
        let bc = row(vec![square(2, 3), minus(square(4, 5))]);
        let ac = row(vec![square(0, 1), minus(square(4, 5))]);
        let given = [Given::row(&ab, &whole(0)), Given::row(&bc, &whole(0))];
        let found = combination(&ac, &given).unwrap();
        assert!(found.holds(&whole(0), |_| whole(0), |k| given[k].constant()));
    }
}
