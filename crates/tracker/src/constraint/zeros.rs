//! Auxiliary unknowns that are zero in every figure that meets the constraints.
//!
//! The signed area of a point and a line that it is on by another constraint is such an unknown, and so is the cosine of an
//! angle that is said to be right elsewhere. An equation that has a sign of its own for them tells nothing, and changes of
//! sign that it seems to forbid are allowed ([`super::twins`]).
//!
//! Equations say of sums of products of two unknowns that they are zero, or a number. Where elimination over the rational
//! numbers leaves one product alone it is zero, and so is one factor if the other one is not: a length, which is positive, or
//! a number that is given. Where it leaves one unknown and a number, or the difference of two unknowns, these are equal. What
//! is known is then put in the place of its name, and so on.

use super::quadratic::{Entry, Equation, Form, Product, Role, Tail};
use crate::interval::{Interval, Real};
use crate::map::Map;
use crate::rational::Rational;
use num_bigint::BigInt;

/// Larger eliminations are not made: no unknown is known to be zero then.
const MOST: usize = 200;

/// None, one or two factors, in order.
type Monomial = Vec<Entry>;
type Sum = Map<Monomial, Rational>;

/// What stands for a coordinate or unknown.
#[derive(Clone)]
enum Value {
    Number(Rational),
    /// Itself, or another one that is equal.
    Name(Entry),
}

/// What is known of coordinates and unknowns.
#[derive(Default)]
struct Known(Map<Entry, Value>);

impl Known {
    fn value(&self, of: Entry) -> Value {
        let mut name = of;
        loop {
            match self.0.get(&name) {
                Some(&Value::Name(other)) => name = other,
                Some(number) => return number.clone(),
                None => return Value::Name(name),
            }
        }
    }

    fn is_open(&self, of: Entry) -> bool {
        !self.0.contains_key(&of)
    }
}

/// The unknowns that are zero at t = 1 wherever the equations hold and lengths and radii are positive. `vanishing`: for
/// each equation whether its right-hand side is known to be zero there, which sums of irrational numbers do not tell.
pub fn zeros(tail: &Tail, vanishing: &[bool]) -> Vec<bool> {
    let mut known = Known::default();
    let nonzero = nonzero(tail, vanishing);
    let mut goes_on = tail.equations.len() <= MOST;
    while goes_on {
        goes_on = false;
        let equations = tail.equations.iter().zip(vanishing);
        let rows = equations.filter_map(|(equation, &vanishing)| {
            let right = at_target(equation, vanishing).as_rational()?.clone();
            let right = right * Rational::from(BigInt::from(-2));
            let mut row = sum(&equation.products, &known);
            row.add(&Rational::one(), &Sum::sums([(Monomial::new(), right)]));
            Some(row)
        });
        for row in reduced(rows) {
            let terms: Vec<(&[Entry], &Rational)> =
                row.iter().map(|(m, x)| (m.as_slice(), x)).collect();
            let (of, is) = match terms[..] {
                [([], x), ([other], _)] => (*other, Value::Number(-x)),
                [([one], x), ([other], y)] if *x == -y => (*other, Value::Name(*one)),
                [(product, _)] => {
                    let mut others: Vec<Entry> = product.to_vec();
                    others.retain(|entry| entry.unknown().is_none_or(|u| !nonzero[u]));
                    others.dedup();
                    match others[..] {
                        [only] => (only, Value::Number(Rational::zero())),
                        _ => continue,
                    }
                }
                _ => continue,
            };
            // Rows before this one may have told.
            let is_new = known.is_open(of)
                && match is {
                    Value::Name(is) => known.is_open(is),
                    Value::Number(_) => true,
                };
            if is_new {
                known.0.insert(of, is);
                goes_on = true;
            }
        }
    }
    let unknowns = 0..tail.unknowns.len();
    let is_zero = |u| matches!(known.value(Entry::Unknown(u)), Value::Number(x) if x.is_zero());
    unknowns.map(is_zero).collect()
}

/// The right-hand side at t = 1.
pub(super) fn at_target(equation: &Equation, vanishing: bool) -> Real {
    if vanishing {
        return Real::zero();
    }
    let coefficients = equation.right.iter();
    coefficients.fold(Real::zero(), |sum, x| &sum + x)
}

/// The unknowns that are not zero at t = 1: those that must be positive, those that are given, and products of such.
fn nonzero(tail: &Tail, vanishing: &[bool]) -> Vec<bool> {
    let unknowns = tail.unknowns.iter();
    let mut nonzero: Vec<bool> = unknowns.map(|u| u.role == Role::Positive).collect();
    loop {
        let before = nonzero.clone();
        for (equation, &vanishing) in tail.equations.iter().zip(vanishing) {
            let at_target = at_target(equation, vanishing);
            let left = sum(&equation.products, &Known::default());
            let terms: Vec<&Monomial> = left.keys().collect();
            let is_nonzero = |monomial: &Monomial| {
                let mut factors = monomial.iter();
                factors.all(|entry| entry.unknown().is_some_and(|u| before[u]))
            };
            let single = |monomial: &Monomial| match monomial[..] {
                [Entry::Unknown(u)] => Some(u),
                _ => None,
            };
            match terms[..] {
                // x = E with E not zero.
                [only] => {
                    let is_given = |x: Interval| x.inf() > 0.0 || x.sup() < 0.0;
                    if let Some(u) = single(only) {
                        nonzero[u] |= is_given(at_target.enclose());
                    }
                }
                // x = y z with neither of these zero.
                [one, other] if at_target.is_zero() => {
                    for (one, other) in [(one, other), (other, one)] {
                        if let Some(u) = single(one) {
                            nonzero[u] |= is_nonzero(other);
                        }
                    }
                }
                _ => {}
            }
        }
        if nonzero == before {
            return nonzero;
        }
    }
}

/// Σ factor · left · right, multiplied out, with what is known in the place of names.
fn sum(products: &[Product], known: &Known) -> Sum {
    let parts = |form: Form| -> Vec<(Option<Entry>, Rational)> {
        if form == Form::One {
            return vec![(None, Rational::one())];
        }
        let entries = form.entries().filter(|part| part.0 != Entry::Zero);
        let parts = entries.map(|(entry, sign)| {
            let sign = Rational::from(BigInt::from(sign));
            match known.value(entry) {
                Value::Number(number) => (None, number * sign),
                Value::Name(name) => (Some(name), sign),
            }
        });
        parts.collect()
    };
    let mut all = Vec::new();
    for p in products {
        let factor = Rational::from(BigInt::from(p.factor));
        for (a, by) in parts(p.left) {
            for (b, times) in parts(p.right) {
                let mut monomial: Monomial = [a, b].into_iter().flatten().collect();
                monomial.sort_unstable();
                all.push((monomial, &factor * &by * times));
            }
        }
    }
    Sum::sums(all)
}

/// The reduced echelon form: in each row the last product has the factor 1 and is in no other row. A product that is a sum of
/// multiples of the rows is one of the rows then.
fn reduced(rows: impl Iterator<Item = Sum>) -> Vec<Sum> {
    let mut basis: Map<Monomial, Sum> = Map::default();
    for mut row in rows {
        // No row of the basis has another one's last product: what is taken away brings none in.
        let known = row.iter().filter_map(|(m, x)| Some((-x, basis.get(m)?)));
        for (by, other) in known.collect::<Vec<_>>() {
            row.add(&by, other);
        }
        let Some((last, value)) = row.iter().next_back().map(|(m, x)| (m.clone(), x.clone()))
        else {
            continue;
        };
        row.values_mut().for_each(|x| *x = &*x / &value);
        for other in basis.values_mut() {
            if let Some(by) = other.get(&last).map(|x| -x) {
                other.add(&by, &row);
            }
        }
        assert!(row.get(&last).is_some_and(Rational::is_one));
        basis.insert(last, row);
    }
    basis.into_iter().map(|(_, row)| row).collect()
}
