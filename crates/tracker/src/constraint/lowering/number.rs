//! Pure numbers, and polynomials in them: higher degrees become products that are unknowns of their own.

use super::super::quadratic::{Entry, Form, Product, Role, difference, value};
use super::{Fault, Lowering, Parity};
use crate::interval::Real;
use crate::rational::Rational;
use crate::statement::Shape;
use num_traits::ToPrimitive;
use std::cmp::Reverse;
use std::collections::HashMap;

/// A number that equations are made of: an unknown without a unit of length.
#[derive(Debug, Clone)]
pub struct Number {
    /// The unknown.
    pub entry: Entry,
    /// Its value in the sketch.
    pub at: Real,
    name: String,
}

/// A turn: its cosine and its sine.
#[derive(Clone)]
struct Turned {
    name: String,
    parts: [Number; 2],
}

/// A sum of products of numbers, each with a coefficient that is not zero; none is empty.
pub type Sum = Vec<(Rational, Vec<Number>)>;

/// What a number was made of: what is there once has one unknown.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum Made {
    /// A coordinate of a point, counted in the problem's unit.
    Coordinate(usize, usize),
    /// The distance of two points.
    Length([usize; 2]),
    /// How far a joint is drawn out.
    Travel(usize),
    /// The cosine of a joint's turn, 0, or the sine, 1.
    Turn(usize, usize),
    /// The unit in which lengths are counted.
    Unit,
    /// Two numbers multiplied.
    Product([Entry; 2]),
    /// A constant.
    Constant(Rational),
}

/// Whole coefficients up to this are factors of products (those have ½ before them, and go to 1000); all others are constants
/// with an equation of their own.
const LARGEST: i64 = 500;

impl Lowering<'_> {
    /// An unknown of the problem.
    pub fn unknown_number(&self, object: usize) -> Number {
        let of = &self.problem.objects[object];
        let Shape::Number { sketch, .. } = &of.shape else {
            unreachable!("only unknown numbers are asked for")
        };
        Number {
            entry: self.objects[&object][0],
            at: Real::from(sketch.value().clone()),
            name: of.name.clone(),
        }
    }

    /// A coordinate of a point.
    pub fn coordinate_number(&mut self, point: usize, axis: usize) -> Number {
        let place = self.place(point);
        let name = format!("{}.{}", self.name(point), ["x", "y", "z"][axis]);
        let at = self.frame.coordinate(&place.at, axis);
        let entry = place.entries[axis];
        self.measured(Made::Coordinate(point, axis), name, entry, at)
    }

    /// The distance of two points.
    pub fn length_number(&mut self, ends: [usize; 2]) -> Result<Number, Fault> {
        let span = self.span(ends[0], ends[1])?;
        let entry = self.length(&span);
        let name = format!("|{}|", span.name);
        let at = super::super::frame::length(&span.at);
        Ok(self.measured(Made::Length(ends), name, entry, at))
    }

    /// How far a joint is drawn out.
    pub fn travel_number(&mut self, joint: usize) -> Result<Number, Fault> {
        let (entry, at) = self.travel_of_joint(joint)?;
        let name = format!("travel({})", self.problem.objects[joint].name);
        Ok(self.measured(Made::Travel(joint), name, entry, at))
    }

    /// Says that turns of joints, each taken so often, add up to so many degrees and whole turns: of the numbers on the unit circle of which they
    /// are the arguments, the product of these powers is the number with that argument.
    ///
    /// # Errors
    /// If a joint turns about no axis.
    pub fn turns_add_up(
        &mut self,
        name: &str,
        turns: &[(usize, i64)],
        degrees: &Rational,
    ) -> Result<(), Fault> {
        // A factor with a turn the other way round is never the first.
        let all_back = turns.iter().all(|(_, times)| *times < 0);
        let sign = if all_back { -1 } else { 1 };
        let mut turns: Vec<(usize, i64)> = turns.iter().map(|&(j, n)| (j, sign * n)).collect();
        turns.sort_by_key(|(_, times)| Reverse(times.signum()));
        let (last, times) = turns.pop().expect("there is a turn");
        let mut before: Option<Turned> = None;
        for (joint, times) in turns {
            let power = self.power(joint, times)?;
            before = Some(match before {
                None => power,
                Some(all) => self.turned_on(&all, &power, times < 0),
            });
        }
        let last = self.power(last, times)?.parts;
        let products = match before {
            None => last.map(|part| vec![product(&(1, vec![part]))]),
            Some(all) => of_both(&all.parts, &last, times < 0),
        };
        let now = products.each_ref().map(|products| self.at_sketch(products));
        let degrees = degrees * &Rational::from_integer(sign.into());
        self.turn_by(name, products, (now, &Real::whole(1), 0), &degrees)
    }

    /// By how much a joint is turned, taken so often whatever the sign.
    fn power(&mut self, joint: usize, times: i64) -> Result<Turned, Fault> {
        let products = self.turned_products(joint)?;
        let name = format!("turn({})", self.problem.objects[joint].name);
        let one = self.cosine_and_sine(name, products, Some(joint));
        Ok(self.repeated(&one, times.unsigned_abs()))
    }

    /// A turn taken so often, by squares.
    fn repeated(&mut self, one: &Turned, times: u64) -> Turned {
        if times == 1 {
            return one.clone();
        }
        let half = self.repeated(one, times / 2);
        let square = self.turned_on(&half, &half, false);
        match times % 2 {
            0 => square,
            _ => self.turned_on(&square, one, false),
        }
    }

    /// One turn and then another one, or that one back.
    fn turned_on(&mut self, one: &Turned, other: &Turned, is_back: bool) -> Turned {
        let sign = if is_back { '-' } else { '+' };
        let name = format!("{} {sign} {}", one.name, other.name);
        let products = of_both(&one.parts, &other.parts, is_back);
        self.cosine_and_sine(name, products, None)
    }

    /// Numbers that are these sums of products; those of a joint's turn are made once.
    fn cosine_and_sine(
        &mut self,
        name: String,
        products: [Vec<Product>; 2],
        joint: Option<usize>,
    ) -> Turned {
        let mut which = ["cosine", "sine"].into_iter().enumerate();
        let parts = products.map(|mut products| {
            let (k, what) = which.next().expect("there are two");
            let made = joint.map(|joint| Made::Turn(joint, k));
            if let Some(number) = made.as_ref().and_then(|made| self.numbers.get(made)) {
                return number.clone();
            }
            let (name, at) = (format!("the {what} of {name}"), self.at_sketch(&products));
            let entry = self.scalar(name.clone(), 0, Parity::Even, at.clone());
            products.push(Product::new(-1, value(entry), Form::One));
            self.equate(&name, products, vec![Real::zero()], 0);
            let number = Number { entry, at, name };
            match made {
                Some(made) => self.kept(made, number),
                None => number,
            }
        });
        Turned { name, parts }
    }

    /// How often the unit goes into a length with a sign: n · 1 = length, where the 1 is a length.
    fn measured(&mut self, made: Made, name: String, length: Entry, at: Real) -> Number {
        if let Some(number) = self.numbers.get(&made) {
            return number.clone();
        }
        let unit = match self.numbers.get(&Made::Unit) {
            Some(number) => number.clone(),
            None => {
                let (name, at) = ("the unit of length".to_owned(), Real::whole(1));
                let entry = self.coefficient(&name, 1, Parity::Even, vec![at.clone()]);
                self.kept(Made::Unit, Number { entry, at, name })
            }
        };
        let entry = self.scalar(name.clone(), 0, Parity::Even, at.clone());
        let products = vec![
            Product::new(1, value(entry), value(unit.entry)),
            Product::new(-1, value(length), Form::One),
        ];
        self.equate(&name, products, vec![Real::zero()], 1);
        self.kept(made, Number { entry, at, name })
    }

    fn kept(&mut self, made: Made, number: Number) -> Number {
        self.numbers.insert(made, number.clone());
        number
    }

    /// The root, not negative, of a sum and a constant.
    pub fn root_number(
        &mut self,
        mut sum: Sum,
        constant: Rational,
        of: &str,
    ) -> Result<Number, Fault> {
        let inner = &evaluated(&sum) + &Real::from(constant.clone());
        if inner.enclose().inf() <= 0.0 {
            return Err("it has the root of a number that is not greater than zero in the sketch: move the sketch".to_owned());
        }
        let at = inner.sqrt();
        let name = format!("a root in {of}");
        let entry = self.unknown(name.clone(), Role::Positive, 0, [false; 3], at.clone());
        let root = Number { entry, at, name };
        sum.push((-Rational::one(), vec![root.clone(), root.clone()]));
        self.sum(&root.name, sum, &-&Real::from(constant));
        Ok(root)
    }

    /// 1 divided by a sum and a constant: the number by which they are to be multiplied for 1.
    pub fn inverse_number(
        &mut self,
        sum: Sum,
        constant: Rational,
        of: &str,
    ) -> Result<Number, Fault> {
        let divisor = &evaluated(&sum) + &Real::from(constant.clone());
        if divisor.enclose().contains(0.0) {
            return Err("it divides by what is zero in the sketch: move the sketch".to_owned());
        }
        let at = &Real::whole(1) / &divisor;
        let name = format!("a quotient in {of}");
        let entry = self.scalar(name.clone(), 0, Parity::Even, at.clone());
        let inverse = Number { entry, at, name };
        let mut product: Sum = sum;
        for (_, factors) in &mut product {
            factors.push(inverse.clone());
        }
        if !constant.is_zero() {
            product.push((constant, vec![inverse.clone()]));
        }
        self.sum(&inverse.name, product, &Real::whole(1));
        Ok(inverse)
    }

    /// The equation sum = target at t = 1: led there from what the sum is in the sketch.
    pub fn sum(&mut self, name: &str, sum: Sum, target: &Real) {
        let start = evaluated(&sum);
        let scale = scale(&sum);
        let mut terms: Vec<(i64, Vec<Number>)> = Vec::with_capacity(sum.len());
        for (coefficient, mut factors) in sum {
            let scaled = &coefficient * &scale;
            let whole = scaled.is_integer().then(|| scaled.to_integer().to_i64());
            let small = whole.flatten().filter(|whole| whole.abs() <= LARGEST);
            let factor = small.unwrap_or_else(|| {
                factors.push(self.constant(scaled));
                1
            });
            terms.push((factor, factors));
        }
        while let Some(pair) = self.next_pair(&terms) {
            let product = self.product_number(&pair);
            for (_, factors) in &mut terms {
                replace(factors, &pair, &product);
            }
        }
        let products = match self.has_headings {
            true => self.in_common(terms),
            false => terms.iter().map(product).collect(),
        };
        let scale = Real::from(scale);
        self.meet(name, products, &(&start * &scale), target * &scale, 0);
    }

    /// For sets of all figures, where everything is evaluated in ranges: what has a factor in common is multiplied out as little as can be,
    /// x² − 3 x = x (x − 3) and x y − x z = x (y − z), so that ranges are narrower, and bounded where x is not.
    fn in_common(&mut self, mut terms: Vec<(i64, Vec<Number>)>) -> Vec<Product> {
        let mut products = Vec::with_capacity(terms.len());
        // A number with its square first: what is left of these is bounded below.
        let rank = |(_, factors): &(i64, Vec<Number>)| match &factors[..] {
            [a, b] => u8::from(a.entry != b.entry),
            _ => 2,
        };
        terms.sort_by_key(rank);
        while !terms.is_empty() {
            let (factor, factors) = terms.remove(0);
            let [a, b] = &factors[..] else {
                products.push(product(&(factor, factors)));
                continue;
            };
            let partner = terms.iter().enumerate().find_map(|(k, (other, with))| {
                let [common, own] = match with.iter().map(|n| n.entry).collect::<Vec<_>>()[..] {
                    [c] if c == a.entry => [a, b],
                    [c] if c == b.entry => [b, a],
                    [c, d] if *other == -factor && (c == a.entry || d == a.entry) => [a, b],
                    [c, d] if *other == -factor && (c == b.entry || d == b.entry) => [b, a],
                    _ => return None,
                };
                Some((k, common.clone(), own.clone()))
            });
            let Some((k, common, own)) = partner else {
                products.push(product(&(factor, factors)));
                continue;
            };
            let (other, with) = terms.remove(k);
            let less = match &with[..] {
                [_] => self.constant(Rational::new((-other).into(), factor.into())),
                [c, d] if c.entry == common.entry => d.clone(),
                [c, ..] => c.clone(),
                [] => unreachable!("no term is empty"),
            };
            let left = value(common.entry);
            let right = difference(own.entry, less.entry);
            products.push(Product::new(factor as i32, left, right));
        }
        products
    }

    /// The two numbers of a product of more than two that are to be one unknown: a pair that is one already, or the one that stands in most
    /// terms.
    fn next_pair(&self, terms: &[(i64, Vec<Number>)]) -> Option<[Number; 2]> {
        // Of each pair in how many terms it is, and its place among all, so that the first of the best is the same in every run.
        let mut found: HashMap<[Entry; 2], (usize, usize, [&Number; 2])> = HashMap::new();
        let mut last: HashMap<[Entry; 2], usize> = HashMap::new();
        let long = terms.iter().enumerate().filter(|(_, (_, f))| f.len() > 2);
        for (term, (_, factors)) in long {
            for (i, a) in factors.iter().enumerate() {
                for b in &factors[i + 1..] {
                    let pair = key([a, b]);
                    // As often as it stands in a term it is one pair there.
                    if last.insert(pair, term) != Some(term) {
                        let place = found.len();
                        found.entry(pair).or_insert((0, place, [a, b])).0 += 1;
                    }
                }
            }
        }
        let is_there = |pair: &[Entry; 2]| self.numbers.contains_key(&Made::Product(*pair));
        // Of a square more is known in ranges, and where the equations are alike it stands in more of them.
        let is_square = |[a, b]: &[Entry; 2]| self.has_headings && a == b;
        let best = found.iter().max_by_key(|(pair, (count, place, _))| {
            (is_there(pair), *count, is_square(pair), Reverse(*place))
        });
        best.map(|(_, (_, _, pair))| pair.map(Number::clone))
    }

    fn product_number(&mut self, pair: &[Number; 2]) -> Number {
        let [a, b] = pair;
        let made = Made::Product(key([a, b]));
        if let Some(number) = self.numbers.get(&made) {
            return number.clone();
        }
        let (name, at) = (format!("{}*{}", a.name, b.name), &a.at * &b.at);
        let entry = self.scalar(name.clone(), 0, Parity::Even, at.clone());
        let products = vec![
            Product::new(1, value(entry), Form::One),
            Product::new(-1, value(a.entry), value(b.entry)),
        ];
        self.equate(&name, products, vec![Real::zero()], 0);
        self.kept(made, Number { entry, at, name })
    }

    fn constant(&mut self, number: Rational) -> Number {
        let made = Made::Constant(number.clone());
        if let Some(number) = self.numbers.get(&made) {
            return number.clone();
        }
        let (name, at) = (number.to_string(), Real::from(number));
        let entry = self.coefficient(&name, 0, Parity::Even, vec![at.clone()]);
        self.kept(made, Number { entry, at, name })
    }
}

/// Real and imaginary part of a product of two complex numbers, or with the other one's conjugate.
fn of_both([a, b]: &[Number; 2], [c, d]: &[Number; 2], is_back: bool) -> [Vec<Product>; 2] {
    let sign = if is_back { -1 } else { 1 };
    let parts = [[(1, a, c), (-sign, b, d)], [(sign, a, d), (1, b, c)]];
    parts.map(|part| {
        let terms = part.map(|(factor, x, y)| product(&(factor, vec![x.clone(), y.clone()])));
        terms.to_vec()
    })
}

/// A term of at most two numbers.
fn product((factor, factors): &(i64, Vec<Number>)) -> Product {
    let form = |k: usize| factors.get(k).map_or(Form::One, |f| value(f.entry));
    Product::new(*factor as i32, form(0), form(1))
}

/// The entries of a pair, the same in either order.
fn key([a, b]: [&Number; 2]) -> [Entry; 2] {
    let rank = |entry: Entry| entry.unknown().unwrap_or(usize::MAX);
    let [a, b] = [a.entry, b.entry];
    if rank(a) <= rank(b) { [a, b] } else { [b, a] }
}

/// Puts one number for a pair of factors, as often as there is one, in a product of more than two.
fn replace(factors: &mut Vec<Number>, pair: &[Number; 2], by: &Number) {
    let place = |factors: &[Number], of: &Number, but: Option<usize>| {
        let mut all = factors.iter().enumerate();
        let found = all.find(|(k, f)| f.entry == of.entry && Some(*k) != but);
        found.map(|(k, _)| k)
    };
    while factors.len() > 2 {
        let Some(first) = place(factors, &pair[0], None) else {
            return;
        };
        let Some(second) = place(factors, &pair[1], Some(first)) else {
            return;
        };
        factors.remove(first.max(second));
        factors.remove(first.min(second));
        factors.push(by.clone());
    }
}

/// The value in the sketch.
fn evaluated(sum: &Sum) -> Real {
    let one = Real::whole(1);
    sum.iter()
        .fold(Real::zero(), |total, (coefficient, factors)| {
            let product = factors
                .iter()
                .fold(one.clone(), |product, f| &product * &f.at);
            &total + &(&Real::from(coefficient.clone()) * &product)
        })
}

/// By what coefficients are multiplied, so that they are whole numbers without a common factor; 1 where some are too large then.
fn scale(sum: &Sum) -> Rational {
    let scale = Rational::to_coprime(sum.iter().map(|(c, _)| c));
    let most = Rational::from_integer(LARGEST.into());
    match sum.iter().all(|(c, _)| (c * &scale).abs() <= most) {
        true => scale,
        false => Rational::one(),
    }
}
