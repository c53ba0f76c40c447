//! What the equations of a block tell in exact numbers, before any range is halved.
//!
//! Sketches are full of equations that are one of two linear ones, either of which may hold: (x − y)² = d² along an axis, (a − b)² = (c − d)² for
//! bars of equal length, a product that is zero. With each of them on one side or the other, much of a block is linear, and can be solved in ratios:
//! unknowns that linear equations tell by others are replaced by these in all other equations, so that products cancel exactly, a contradiction is one
//! and not nearly one, and unknowns get exact values. Intervals can do none of this: there x = y + c is nearly so, and a determinant that is 0 is nearly 0.
//!
//! # Why nothing is lost
//!
//! Every step is an identity in ratios. *Sides*: from L² = s² M², s a ratio, follows L = s M or L = −s M; from L² = r, where r is positive and a ratio or in
//! a range, L = √r or L = −√r; from P Q = 0, and from f P Q + g P T = P (f Q + g T) = 0, that one factor is 0.
//! *Putting in*: an equation c x + rest = 0 with a ratio c ≠ 0 and without products says x = −rest/c, which may stand for x wherever it is. *Taking
//! away*: what is zero at a zero may be subtracted, any number of times. Numbers that are no ratios (an irrational length, what a block before was found
//! to be) are symbols in this, and ranges only where the result is used.

use super::{Homotopy, Term};
use crate::equations::Form;
use crate::interval::{Interval, ZERO, enclose_rational};
use crate::map::Map;
use crate::places::Each as _;
use crate::rational::Rational;
use num_bigint::BigInt;

/// `Σ q_ij z_i z_j + Σ b_i z_i + c`, which is 0. The z are unknowns of the homotopy, and behind these symbols for numbers ([`Told`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Quadratic {
    products: Map<[usize; 2], Rational>,
    linear: Map<usize, Rational>,
    constant: Rational,
}

/// A [`Quadratic`] with ranges for all that are not unknowns of a block: each term is a factor, an unknown, and perhaps another one.
#[derive(Debug, Clone)]
pub struct Flat {
    /// The terms.
    pub terms: Vec<(Interval, usize, Option<usize>)>,
    /// What is added to them.
    pub constant: Interval,
}

/// The equations of a block with what linear ones say put into the others.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// Those that changed: all are 0.
    pub rows: Vec<Quadratic>,
    /// Whether all are linear and fewer than the unknowns that they tell: if they have a zero, they have a line of them.
    pub is_curve: bool,
}

/// A side of an equation.
#[derive(Debug, Clone)]
pub struct Side {
    /// What is known where the equation is on it.
    pub told: Told,
    /// What the equation says there: it has no products.
    pub says: Flat,
    /// Whether that may stand in the place of the equation, where as many equations as unknowns are wanted: not where it was found with the value of an
    /// unknown of the block, as it does not say any more what that unknown has to do with it.
    pub is_whole: bool,
}

/// Equations that contradict each other, or hold only where a vector vanishes that must not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contradiction;

/// What is known exactly where a block is looked at: values of unknowns, and on which side equations are.
///
/// With m unknowns, the number m + e is the symbol of the right-hand side E(1) of equation e, and 2m + e that of the root that a side of it has. (Entries
/// of equations that are not below m stand for the number 0, and get no symbol.)
#[derive(Debug, Clone, Default)]
pub struct Told {
    values: Map<usize, Rational>,
    sides: Map<usize, Quadratic>,
    roots: Map<usize, Interval>,
}

/// A block with its unknowns, and ranges for all entries.
pub struct View<'a> {
    /// The equations.
    pub homotopy: &'a Homotopy,
    /// The equations of the block.
    pub equations: &'a [usize],
    /// Its unknowns.
    pub unknowns: &'a [usize],
    /// The range of every unknown of the homotopy.
    pub ranges: &'a [Interval],
}

impl Quadratic {
    fn constant(c: Rational) -> Self {
        Quadratic {
            products: Map::default(),
            linear: Map::default(),
            constant: c,
        }
    }

    fn symbol(i: usize) -> Self {
        let mut out = Self::constant(Rational::zero());
        out.linear.insert(i, Rational::one());
        out
    }

    fn is_linear(&self) -> bool {
        self.products.is_empty()
    }

    /// Adds `by` times another one.
    fn add(&mut self, by: &Rational, other: &Self) {
        self.products.add(by, &other.products);
        self.linear.add(by, &other.linear);
        self.constant += by * &other.constant;
    }

    /// The product of two without products.
    fn times(&self, other: &Self) -> Self {
        debug_assert!(self.is_linear() && other.is_linear());
        let with = |(&i, b): (&usize, &Rational)| {
            let terms = other.linear.iter();
            terms
                .map(|(&j, d)| ([i.min(j), i.max(j)], b * d))
                .collect::<Vec<_>>()
        };
        let mut out = Self::constant(&self.constant * &other.constant);
        out.products = Map::sums(self.linear.iter().flat_map(with));
        out.linear.add(&other.constant, &self.linear);
        out.linear.add(&self.constant, &other.linear);
        out
    }

    /// Puts a sum without products in the place of z_p; whether z_p was there.
    fn put(&mut self, p: usize, sum: &Self) -> bool {
        let keys: Vec<[usize; 2]> = self.products.keys().copied().collect();
        let mut is_there = false;
        for key in keys.into_iter().filter(|key| key.contains(&p)) {
            let Some(q) = self.products.remove(&key) else {
                continue;
            };
            is_there = true;
            let product = match key {
                [i, j] if i == j => sum.times(sum),
                [i, j] => sum.times(&Self::symbol(if i == p { j } else { i })),
            };
            self.add(&q, &product);
        }
        if let Some(b) = self.linear.remove(&p) {
            is_there = true;
            self.add(&b, sum);
        }
        is_there
    }

    fn has(&self, i: usize) -> bool {
        self.linear.contains_key(&i) || self.products.keys().any(|key| key.contains(&i))
    }

    /// The products of two unknowns of a block, which are what keeps it from being linear.
    fn curved<'a>(
        &'a self,
        view: &'a View,
    ) -> impl Iterator<Item = (&'a [usize; 2], &'a Rational)> {
        let is_own = |i: &usize| view.unknowns.contains(i);
        self.products
            .iter()
            .filter(move |(key, _)| key.iter().all(is_own))
    }
}

/// An interval around a ratio: all numbers, where it is beyond the floats.
pub fn range(x: &Rational) -> Interval {
    match x.to_f64().is_finite() {
        true => enclose_rational(x),
        false => Interval::ENTIRE,
    }
}

impl Told {
    /// The unknowns whose values are known.
    pub fn values(&self) -> impl Iterator<Item = (usize, &Rational)> {
        self.values.iter().map(|(&i, x)| (i, x))
    }

    /// The value of an unknown, if it is known.
    pub fn value(&self, unknown: usize) -> Option<&Rational> {
        self.values.get(&unknown)
    }

    /// All values, in whole numbers that are others where a value is another one.
    pub fn in_numbers(&self) -> Vec<usize> {
        let digits = |n: &BigInt| {
            let (sign, digits) = n.to_u32_digits();
            let count = [sign as usize, digits.len()];
            let digits = digits.into_iter().map(|digit| digit as usize);
            count.into_iter().chain(digits).collect::<Vec<_>>()
        };
        let all = self.values.iter();
        let all = all.flat_map(|(&i, x)| [vec![i], digits(x.numer()), digits(x.denom())]);
        all.flatten().collect()
    }

    /// The values of some unknowns alone.
    pub fn of(&self, is_wanted: impl Fn(usize) -> bool) -> Told {
        let values = self.values.iter().filter(|(i, _)| is_wanted(**i));
        Told {
            values: values.map(|(&i, x)| (i, x.clone())).collect(),
            ..Told::default()
        }
    }

    /// Adds values that were found elsewhere.
    pub fn learn(&mut self, values: impl IntoIterator<Item = (usize, Rational)>) {
        self.values.extend(values);
    }

    /// An entry of the equations.
    fn entry(&self, entry: Option<usize>) -> Quadratic {
        match entry.map(|i| (i, self.values.get(&i))) {
            None => Quadratic::constant(Rational::zero()),
            Some((_, Some(x))) => Quadratic::constant(x.clone()),
            Some((i, None)) => Quadratic::symbol(i),
        }
    }

    /// A factor of a term.
    fn form(&self, form: Form<Option<usize>>) -> Quadratic {
        match form {
            Form::One => Quadratic::constant(Rational::one()),
            Form::Difference(i, j) if i == j => Quadratic::constant(Rational::zero()),
            Form::Difference(i, j) => {
                let mut out = self.entry(i);
                out.add(&-Rational::one(), &self.entry(j));
                out
            }
        }
    }

    /// Twice the right-hand side of an equation.
    fn right(homotopy: &Homotopy, e: usize) -> Quadratic {
        let two = Rational::from(BigInt::from(2));
        let ball = homotopy.rights[e].ball_at_target();
        match ball.radius.is_zero() {
            true => Quadratic::constant(two * ball.middle),
            false => {
                let mut out = Quadratic::constant(Rational::zero());
                out.linear.insert(homotopy.equations + e, two);
                out
            }
        }
    }

    /// The factors of an equation's terms: those whose product is not certainly zero.
    fn terms(&self, homotopy: &Homotopy, e: usize) -> Vec<(Rational, [Quadratic; 2])> {
        let terms = homotopy.terms(e).into_iter().map(|term| {
            let factors = term.forms().map(|form| self.form(form));
            (Rational::from(BigInt::from(term.factor)), factors)
        });
        let nothing = Quadratic::constant(Rational::zero());
        terms
            .filter(|(_, factors)| !factors.contains(&nothing))
            .collect()
    }

    /// An equation, on its side if it is on one.
    fn equation(&self, homotopy: &Homotopy, e: usize) -> Quadratic {
        if let Some(side) = self.sides.get(&e) {
            let mut out = side.clone();
            let known: Vec<usize> = out.linear.keys().copied().collect();
            for i in known {
                if let Some(value) = self.values.get(&i) {
                    out.put(i, &Quadratic::constant(value.clone()));
                }
            }
            return out;
        }
        let mut out = Quadratic::constant(Rational::zero());
        for (factor, [left, right]) in self.terms(homotopy, e) {
            out.add(&factor, &left.times(&right));
        }
        out.add(&-Rational::one(), &Self::right(homotopy, e));
        out
    }

    /// The sides of an equation of a block, if it has some and is on none: every zero is on one of them.
    pub fn sides(&self, view: &View, e: usize) -> Option<Vec<Side>> {
        if self.sides.contains_key(&e) || !view.equations.contains(&e) {
            return None;
        }
        let homotopy = view.homotopy;
        let moves = |sum: &Quadratic| sum.linear.keys().any(|i| view.unknowns.contains(i));
        let (free, known): (Vec<_>, Vec<_>) = self
            .terms(homotopy, e)
            .into_iter()
            .partition(|(_, factors)| factors.iter().any(moves));
        let mut rest = Self::right(homotopy, e);
        for (factor, [left, right]) in &known {
            rest.add(&-factor.clone(), &left.times(right));
        }
        let is_zero = rest == Quadratic::constant(Rational::zero());
        let sum = |one: &Quadratic, by: &Rational, other: &Quadratic| {
            let mut out = one.clone();
            out.add(by, other);
            out
        };
        let mut ends = homotopy
            .terms(e)
            .into_iter()
            .flat_map(Term::entries)
            .flatten();
        let is_whole = !ends.any(|i| self.values.contains_key(&i) && view.unknowns.contains(&i));
        let with = |sides: Vec<Quadratic>, root: Option<Interval>| {
            let sides = sides.into_iter().map(|side| {
                let mut told = self.clone();
                told.roots.extend(root.map(|root| (e, root)));
                let says = told.flat(view, &side);
                told.sides.insert(e, side);
                Side {
                    told,
                    says,
                    is_whole,
                }
            });
            Some(sides.collect())
        };
        let minus = -Rational::one();
        match free.as_slice() {
            [(factor, [left, right])] if left == right => {
                let by = factor.recip();
                let is_ratio = rest.is_linear() && rest.linear.is_empty();
                let square = &by * &rest.constant;
                if is_ratio && square.is_zero() {
                    return with(vec![left.clone()], None);
                }
                let (symbol, range) = match square.sqrt().filter(|_| is_ratio) {
                    Some(root) => (Quadratic::constant(root), None),
                    None => {
                        let number = 2 * homotopy.equations + e;
                        let flat = self.flat(view, &rest);
                        let square = flat.constant * range(&by);
                        let is_good = flat.terms.is_empty() && square.inf() > 0.0;
                        let root = square.sqrt();
                        let is_good = is_good && root.is_common_interval();
                        is_good.then_some((Quadratic::symbol(number), Some(root)))?
                    }
                };
                let sides = [&minus, &Rational::one()].map(|by| sum(left, by, &symbol));
                with(sides.to_vec(), range)
            }
            [(_, [left, right])] if is_zero && moves(left) && moves(right) => {
                with(vec![left.clone(), right.clone()], None)
            }
            [(f, [p, q]), (g, [r, s])] if is_zero => {
                let ratio = -(g / f);
                if p == q && r == s {
                    let root = ratio.sqrt()?;
                    return with(vec![sum(p, &-root.clone(), r), sum(p, &root, r)], None);
                }
                // A factor in common, or its opposite.
                let pairs = [(p, q, r, s), (p, q, s, r), (q, p, r, s), (q, p, s, r)];
                pairs.into_iter().find_map(|(shared, other, again, third)| {
                    let by = match () {
                        () if shared == again => g / f,
                        () if sum(shared, &Rational::one(), again).is_nothing() => -(g / f),
                        () => return None,
                    };
                    let rest = sum(other, &by, third);
                    let is_new = moves(shared) && rest.is_linear();
                    is_new.then(|| with(vec![shared.clone(), rest], None))?
                })
            }
            _ => None,
        }
    }

    /// The equations of a block with what linear ones say put into the others. Values that come of it are learned. `Err`: no figure meets them.
    pub fn reduced(&mut self, view: &View) -> Result<Reduced, Contradiction> {
        let all = view
            .equations
            .iter()
            .map(|&e| self.equation(view.homotopy, e));
        let (mut linear, mut curved) = (Vec::new(), Vec::new());
        for row in all {
            match row.is_linear() {
                true => linear.push(row),
                false => curved.push((row, false)),
            }
        }
        let (mut k, mut pivots) = (0, Vec::new());
        while k < linear.len() {
            while k < linear.len() {
                pivots.push(put_everywhere(k, view, &mut linear, &mut curved));
                k += 1;
            }
            subtract(view, &mut linear, &mut curved);
        }
        if self.is_improper(view, linear.iter().zip(&pivots)) {
            return Err(Contradiction);
        }
        let open = view.unknowns.iter().copied();
        let open: Vec<usize> = open.filter(|i| !self.values.contains_key(i)).collect();
        for row in &linear {
            // Without products: a number, or one of the block's unknowns alone.
            let mut own = row.linear.iter();
            match (own.next(), own.next()) {
                (None, _) if !row.constant.is_zero() => return Err(Contradiction),
                (Some((&i, b)), None) if open.contains(&i) => {
                    self.values.insert(i, -(&row.constant / b));
                }
                _ => {}
            }
        }
        let is_open = |row: &Quadratic| open.iter().any(|&i| row.has(i));
        let told = linear.iter().filter(|row| is_open(row)).count();
        let is_linear = !curved.iter().any(|(row, _)| is_open(row));
        let is_curve = is_linear && told < open.len();
        let changed = curved.into_iter().filter(|(_, changed)| *changed);
        let all = linear.into_iter().chain(changed.map(|(row, _)| row));
        Ok(Reduced {
            rows: all.filter(|row| !row.is_nothing()).collect(),
            is_curve,
        })
    }

    /// Whether a vector vanishes that must not, or a length or radius is not positive, wherever these equations hold, each of which tells one unknown
    /// that is in no other: then there is no figure.
    fn is_improper<'r>(
        &self,
        view: &View,
        rows: impl Iterator<Item = (&'r Quadratic, &'r Option<usize>)> + Clone,
    ) -> bool {
        let homotopy = view.homotopy;
        let told = |ends: [usize; 2]| {
            let [a, b] = ends.each(|i| (i < homotopy.equations).then_some(i));
            let mut sum = self.form(Form::Difference(a, b));
            for (row, pivot) in rows.clone() {
                let pivot = pivot
                    .and_then(|pivot| Some((sum.linear.get(&pivot)?, row.linear.get(&pivot)?)));
                if let Some(by) = pivot.map(|(a, b)| -(a / b)) {
                    sum.add(&by, row);
                }
            }
            sum
        };
        let is_here = |ends: &[usize; 2]| ends.iter().any(|i| view.unknowns.contains(i));
        let vectors = homotopy.nonzero_vectors().into_iter();
        let mut vectors = vectors.filter(|vector| vector.iter().any(is_here));
        let positive = homotopy.positive_unknowns().into_iter();
        let mut positive = positive.filter(|i| view.unknowns.contains(i));
        vectors.any(|vector| vector.into_iter().all(|ends| told(ends).is_nothing()))
            || positive.any(|i| {
                let sum = told([i, homotopy.equations]);
                sum.is_linear() && sum.linear.is_empty() && !sum.constant.is_positive()
            })
    }

    /// An equation with ranges for all that are not unknowns of the block.
    pub fn flat(&self, view: &View, of: &Quadratic) -> Flat {
        let is_own = |i: usize| view.unknowns.contains(&i) && !self.values.contains_key(&i);
        let m = view.homotopy.equations;
        let range_of = |i: usize| match self.values.get(&i) {
            Some(x) => range(x),
            None if i < m => view.ranges[i],
            None if i < 2 * m => view.homotopy.rights[i - m].at_target(),
            None => self
                .roots
                .get(&(i - 2 * m))
                .copied()
                .unwrap_or(Interval::ENTIRE),
        };
        let mut linear: Map<usize, Interval> = Map::default();
        let mut add = |i: usize, by: Interval| {
            *linear.or_insert(i, ZERO) += by;
        };
        let mut terms = Vec::new();
        let mut constant = range(&of.constant);
        for (&[i, j], q) in of.products.iter() {
            let q = range(q);
            match (is_own(i), is_own(j)) {
                (true, true) => terms.push((q, i, Some(j))),
                (true, false) => add(i, q * range_of(j)),
                (false, true) => add(j, q * range_of(i)),
                (false, false) if i == j => constant += q * range_of(i).sqr(),
                (false, false) => constant += q * range_of(i) * range_of(j),
            }
        }
        for (&i, b) in of.linear.iter() {
            let b = range(b);
            match is_own(i) {
                true => add(i, b),
                false => constant += b * range_of(i),
            }
        }
        // Where ranges are numbers that cancel nothing is left: no term, as others divide by factors.
        let linear = linear.into_iter().filter(|(_, b)| *b != ZERO);
        terms.extend(linear.map(|(i, b)| (b, i, None)));
        Flat { terms, constant }
    }
}

impl Quadratic {
    fn is_nothing(&self) -> bool {
        self.is_linear() && self.linear.is_empty() && self.constant.is_zero()
    }
}

/// Puts what a linear equation says of one of the unknowns into all others; of which.
fn put_everywhere(
    k: usize,
    view: &View,
    linear: &mut [Quadratic],
    curved: &mut [(Quadratic, bool)],
) -> Option<usize> {
    let mut row = linear[k].clone();
    // One that is in few products, so that what is left is of as few unknowns.
    let is_in = |i: usize| curved.iter().filter(|(row, _)| row.has(i)).count();
    let own = row.linear.keys().copied();
    let own = own.filter(|i| view.unknowns.contains(i));
    let pivot = own.min_by_key(|&i| is_in(i))?;
    let by = row.linear.remove(&pivot)?;
    let mut sum = Quadratic::constant(Rational::zero());
    sum.add(&-by.recip(), &row);
    for (_, other) in linear.iter_mut().enumerate().filter(|(j, _)| *j != k) {
        other.put(pivot, &sum);
    }
    for (other, changed) in curved {
        *changed |= other.put(pivot, &sum);
    }
    Some(pivot)
}

/// Takes multiples of equations from others so that products of unknowns cancel; those of which no product is left are linear.
fn subtract(view: &View, linear: &mut Vec<Quadratic>, curved: &mut Vec<(Quadratic, bool)>) {
    for (mut row, mut changed) in std::mem::take(curved) {
        for (pivot, _) in curved.iter() {
            let Some((key, p)) = pivot.curved(view).next() else {
                continue;
            };
            let Some(q) = row.products.get(key) else {
                continue;
            };
            let mut less = row.clone();
            less.add(&-(q / p), pivot);
            if less.curved(view).count() < row.curved(view).count() {
                (row, changed) = (less, true);
            }
        }
        match row.is_linear() {
            true => linear.push(row),
            false => curved.push((row, changed)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::checked;
    use crate::problem::Problem;
    use crate::system::typical_length;

    fn ratio(a: i64, b: i64) -> Rational {
        Rational::new(BigInt::from(a), BigInt::from(b))
    }

    #[test]
    fn what_is_put_in_is_an_identity() {
        // x y + x² − 3 y with x = 2 z − 1/3, at y = 5 and z = 7/2.
        let (x, y, z) = (0, 1, 2);
        let mut sum = Quadratic::constant(ratio(-1, 3));
        sum.add(&ratio(2, 1), &Quadratic::symbol(z));
        let symbol = Quadratic::symbol;
        let mut row = symbol(x).times(&symbol(y));
        row.add(&ratio(1, 1), &symbol(x).times(&symbol(x)));
        row.add(&ratio(-3, 1), &symbol(y));
        assert!(row.put(x, &sum) && !row.has(x));
        for (i, value) in [(y, ratio(5, 1)), (z, ratio(7, 2))] {
            assert!(row.put(i, &Quadratic::constant(value)));
        }
        let at = ratio(20, 3);
        let wanted = &at * ratio(5, 1) + &at * &at - ratio(15, 1);
        assert_eq!(row, Quadratic::constant(wanted));
    }

    /// Every choice of sides, one after the other, of all equations in one block: how many contradict each other, and the values where they do not.
    fn choices(text: &str) -> (usize, Vec<Vec<(usize, Rational)>>) {
        let problem = Problem::parse(text, "test.toml").unwrap();
        let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
        let all: Vec<usize> = (0..homotopy.equations).collect();
        let ranges = vec![checked(f64::NEG_INFINITY, f64::INFINITY).unwrap(); all.len()];
        let view = View {
            homotopy: &homotopy,
            equations: &all,
            unknowns: &all,
            ranges: &ranges,
        };
        let (mut contradictions, mut found) = (0, Vec::new());
        let mut open = vec![Told::default()];
        while let Some(mut told) = open.pop() {
            if told.reduced(&view).is_err() {
                contradictions += 1;
                continue;
            }
            match all.iter().find_map(|&e| told.sides(&view, e)) {
                Some(sides) => open.extend(sides.into_iter().map(|side| side.told)),
                None => {
                    let values = told.values();
                    found.push(values.map(|(i, x)| (i, x.clone())).collect());
                }
            }
        }
        (contradictions, found)
    }

    /// A factor that is the number 0 is none: whoever divides by it would find that nothing can be there.
    #[test]
    fn factors_that_are_zero_leave_no_term() {
        let text = "name = \"bar\"\ndimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\n[constraints]\n\
                    fixed = [\"a\"]\ny = [[\"b\", 0]]\ndistances = [[\"a\", \"b\", 1]]\n";
        let problem = Problem::parse(text, "bar.toml").unwrap();
        let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
        let m = homotopy.equations;
        let view = View {
            homotopy: &homotopy,
            equations: &[0],
            unknowns: &[0],
            ranges: &vec![crate::interval::point(2.0); m],
        };
        // x y − x z + 3, with 2 for y and for z.
        let symbol = Quadratic::symbol;
        let mut row = symbol(0).times(&symbol(1));
        row.add(&ratio(-1, 1), &symbol(0).times(&symbol(2)));
        row.add(&ratio(3, 1), &Quadratic::constant(ratio(1, 1)));
        let flat = Told::default().flat(&view, &row);
        assert!(flat.terms.is_empty());
        assert!(flat.constant.contains(3.0));
    }

    #[test]
    fn each_side_gives_exact_values() {
        let (contradictions, found) = choices(
            r#"
            name = "line"
            dimension = 2
            [points]
            e = [0.4, 0]
            a = [0.3, 0]
            [constraints]
            fixed = ["e"]
            y = [["a", 0]]
            distances = [["a", "e", 0.1]]
            "#,
        );
        assert_eq!((contradictions, found.len()), (0, 2));
        // All unknowns have values, and the two differ in one.
        let pairs = found[0].iter().zip(&found[1]);
        let differ: Vec<_> = pairs.filter(|(a, b)| a != b).collect();
        let [(a, b)] = differ[..] else {
            panic!("{differ:?}");
        };
        // 0.5 and 0.3, in some unit.
        assert_eq!(
            a.1.clone().max(b.1.clone()) / a.1.clone().min(b.1.clone()),
            ratio(5, 3)
        );
    }

    #[test]
    fn products_cancel_exactly() {
        // Equal gaps on both sides of a bar: a² = (1 − b)² with b = a ± 0.3, linear on either side.
        let text = |gap: &str, bar: &str| {
            choices(&format!(
                r#"
                name = "gaps"
                dimension = 2
                [points]
                o = [0, 0]
                e = [{gap}, 0]
                a = [0.3, 0]
                b = [0.6, 0]
                [constraints]
                fixed = ["o", "e"]
                y = [["a", 0], ["b", 0]]
                distances = [["a", "b", {bar}]]
                equal = [["o", "a", "b", "e"]]
                "#
            ))
        };
        let (contradictions, found) = text("1", "0.3");
        assert_eq!((contradictions, found.len()), (0, 2));
        let counts = found.iter().map(Vec::len);
        assert_eq!(counts.clone().min(), counts.max());
        // As long as what it is in: on one side all places serve.
        let (contradictions, found) = text("0.3", "0.3");
        assert_eq!((contradictions, found.len()), (0, 3));
        let fewest = found.iter().map(Vec::len).min();
        assert!(fewest < found.iter().map(Vec::len).max());
    }
}
