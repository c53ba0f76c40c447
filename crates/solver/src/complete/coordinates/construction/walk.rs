//! What a construction makes of a part: unknowns as functions of a few of them.
//!
//! Each step's equations are put together with what is known before as Taylor models ([`Model`]), which hold for all values that the
//! variables have in the part. Linear ones are eliminated; what they leave of the quadratic one, A z² + 2 B z + C = 0, tells one more unknown:
//! z = (−B ± √(B² − A C))/A. Both signs are followed, those that the part's ranges do not exclude. Unknowns that no equation tells become variables, with
//! their ranges in the part; so do those where a coefficient may vanish or the two places come together, and then their equation is one of those that close.
//!
//! # Why no zero is lost
//!
//! Let X be a zero in the part. Its variables have values in their ranges, and all models enclose what X has for these: an equation is divided only by what is not 0 all
//! over the part, and X is at one of the two places. Equations that close are 0 at X, and that every unknown is in its range of the part is
//! true of X as well, so that X is in what [`contract`] leaves of the variables, and in the ranges of the models. (An equation that is not looked at costs
//! sharpness alone.) Every way is followed until it contradicts itself, or to a leaf: where all unknowns stand, where equations leave little
//! of it, or where something is not known well enough to go on. Where there would be too many ways, the part itself is the one leaf.

use super::order::{Affine, Equation, Order, Step};
use crate::complete::coordinates::system::{Form, Row, volume};
use crate::interval::{Interval, hull, point};
use crate::model::{Margin, Model, Number, Range, SYMBOLS, contract};
use crate::places::Each as _;

/// What is divided by has to be at least this part of its greatest size.
const PIVOT: f64 = 0.05;
/// What the root is taken of has to be at least this part of its greatest size.
const RADICAND: f64 = 0.1;
/// And this much.
const LEAST: f64 = 1e-9;
/// A part is looked at anew where equations leave less than this of it.
const SHRUNK: f64 = 0.3;
/// An unknown that may be off by this, beside its size, is nothing to go on from.
const BLURRED: f64 = 0.2;
/// Where two places are farther apart than this, and not told apart, variables are halved; where they are nearer, the unknown becomes one.
const FAR: f64 = 0.35;
/// A variable with a narrower range is not halved for what may vanish.
const FINE: f64 = 1e-3;
/// An unknown known to this much, beside its size, is a number.
const NUMBER: f64 = 1e-13;
/// A range is an equation of its own where a model goes beyond it by this part of it.
const BEYOND: f64 = 0.01;
/// Leaves of a part, at most, and steps that are taken on all ways.
const MOST_LEAVES: usize = 8;
const MOST_TAKEN: usize = 512;
/// Leaves are put together where they make up this part of what holds both. (Less than 1, so that the last digits of logarithms are no matter.)
const TOGETHER: f64 = 0.99;

/// A part that holds some of the zeros of a part.
#[derive(Debug, Clone)]
pub struct Leaf {
    /// The ranges of all entries.
    pub x: Vec<Interval>,
    /// The unknown that it is best to halve.
    pub halve: Option<usize>,
    /// Whether all unknowns were found in it.
    pub is_whole: bool,
}

/// Why a way ends.
enum Stop<const S: usize> {
    /// It has no zero.
    Empty,
    /// More variables are needed.
    MoreSymbols,
    /// What comes next is not known well enough; how much each variable has to do with that.
    Blurred([f64; S]),
}

/// Σ coefficients · unknowns + constant, and in the step's quadratic equation products of two of them besides.
struct Line<const S: usize, const M: usize> {
    row: usize,
    ratio: f64,
    coefficients: Vec<Model<S, M>>,
    constant: Model<S, M>,
}

/// A step's quadratic equation, with its products of two unknowns.
type Quadric<'q, const S: usize, const M: usize> = (&'q Line<S, M>, &'q [(usize, usize, f64)]);

/// The unknowns of a step, each counted from its base: a + b z.
struct Along<const S: usize, const M: usize> {
    a: Vec<Model<S, M>>,
    b: Vec<Model<S, M>>,
}

/// An unknown at the first of these, plus or minus the second.
type Roots<const S: usize, const M: usize> = [Model<S, M>; 2];

/// Constructs the unknowns of a block in a part in which they are bounded, with so many variables: every zero in it is in one
/// of these leaves. `None`: more variables are needed. `rows`: the block's equations.
pub fn walk(symbols: usize, order: &Order, rows: &[&Row], x: &[Interval]) -> Option<Vec<Leaf>> {
    match symbols {
        0 | 1 => Walk::<1, 3>::run(order, rows, x),
        2 => Walk::<2, 6>::run(order, rows, x),
        3 => Walk::<3, 10>::run(order, rows, x),
        4 => Walk::<4, 15>::run(order, rows, x),
        _ => Walk::<6, 28>::run(order, rows, x),
    }
}

/// Where a walk is.
struct Walk<'a, const S: usize, const M: usize> {
    order: &'a Order,
    rows: &'a [&'a Row],
    x: &'a [Interval],
    /// Each entry that is known.
    f: Vec<Model<S, M>>,
    /// The unknowns that are variables.
    symbols: Vec<usize>,
    /// All that has to be zero.
    equations: Vec<Model<S, M>>,
    /// Room for the elimination.
    room: Vec<Model<S, M>>,
    /// The widest unknown that is a number for want of variables.
    wanting: Option<usize>,
    /// Steps taken.
    taken: usize,
    leaves: Vec<Leaf>,
    /// Whether there are more leaves than are kept, or more steps than are taken.
    is_overfull: bool,
}

impl<'a, const S: usize, const M: usize> Walk<'a, S, M> {
    fn run(order: &'a Order, rows: &'a [&'a Row], x: &'a [Interval]) -> Option<Vec<Leaf>> {
        let mut f = vec![Model::<S, M>::ZERO; x.len()];
        for &entry in &order.outside {
            f[entry] = Model::constant(Number::new(x[entry]));
        }
        let mut walk = Walk {
            order,
            rows,
            x,
            f,
            symbols: Vec::new(),
            equations: Vec::new(),
            room: Vec::new(),
            wanting: None,
            taken: 0,
            leaves: Vec::new(),
            is_overfull: false,
        };
        match walk.go(0) {
            Err(Stop::MoreSymbols) => None,
            _ if walk.is_overfull => Some(vec![Leaf {
                x: x.to_vec(),
                halve: None,
                is_whole: false,
            }]),
            _ => Some(walk.leaves),
        }
    }

    /// Goes on from a step to the ends of all ways. An error says that there are too few variables.
    fn go(&mut self, step: usize) -> Result<(), Stop<S>> {
        self.taken += 1;
        if self.leaves.len() >= MOST_LEAVES || self.taken > MOST_TAKEN {
            self.is_overfull = true;
            return Ok(());
        }
        let order = self.order;
        let Some(now) = order.steps.get(step) else {
            self.leaf(step, None);
            return Ok(());
        };
        let before = self.mark();
        let result = self.stand(step, now);
        self.end(step, result, before)
    }

    /// How many variables and equations there are.
    fn mark(&self) -> [usize; 2] {
        [self.symbols.len(), self.equations.len()]
    }

    /// Ends a way at a step, and goes back to what was before.
    fn end(
        &mut self,
        step: usize,
        result: Result<(), Stop<S>>,
        before: [usize; 2],
    ) -> Result<(), Stop<S>> {
        let result = match result {
            Err(Stop::Empty) => Ok(()),
            Err(Stop::Blurred(weights)) => {
                self.leaf(step, Some(weights));
                Ok(())
            }
            other => other,
        };
        self.symbols.truncate(before[0]);
        self.equations.truncate(before[1]);
        result
    }

    /// Finds the unknowns of a step, and goes on.
    fn stand(&mut self, step: usize, now: &Step) -> Result<(), Stop<S>> {
        let size = now.unknowns.len();
        let mut lines: Vec<Line<S, M>> = now.linear.iter().map(|e| self.line(e, size)).collect();
        let quadric = now.quadratic.as_ref();
        let quadric = quadric.map(|(e, products)| (self.line(e, size), products.as_slice()));
        if let Some((quadric, _)) = &quadric {
            lines.iter_mut().for_each(|line| line.less(quadric));
        }
        let pivots = eliminate(&mut lines, size);
        let weights = may_vanish(&lines, &pivots);
        if self.is_movable(&weights) {
            return Err(Stop::Blurred(weights));
        }
        let mut used: Vec<usize> = pivots.iter().map(|&(line, _)| lines[line].row).collect();
        let is_free = |i: &usize| pivots.iter().all(|(_, pivot)| pivot != i);
        let mut free: Vec<usize> = (0..size).filter(is_free).collect();
        let quadric = quadric.as_ref().map(|(line, products)| (line, *products));
        let told = quadric
            .filter(|_| !free.is_empty())
            .map(|quadric| (quadric, self.told(now, &lines, &pivots, &free, quadric)));
        free.retain(|&i| told.is_none_or(|(_, z)| z != i));
        let mut along = Along {
            a: vec![Model::ZERO; size],
            b: vec![Model::ZERO; size],
        };
        for &i in &free {
            let x = self.symbol(now.unknowns[i])?;
            along.a[i] = x.minus(&self.f[now.base[i]]);
        }
        for &(line, pivot) in &pivots {
            let line = &lines[line];
            let beside =
                |sum: Model<S, M>, &i: &usize| sum.minus(&line.coefficients[i].times(&along.a[i]));
            along.a[pivot] = free.iter().fold(line.constant.scaled(-1.0), beside);
            if let Some((_, z)) = told {
                along.b[pivot] = line.coefficients[z].scaled(-1.0);
            }
        }
        let Some((quadric, z)) = told else {
            return self.found(step, &along.a, &used);
        };
        along.b[z] = Model::constant(Number::ONE);
        let Some([middle, half]) = self.roots((now, z), quadric, &along)? else {
            // Its equation is one that closes.
            let y = self.symbol(now.unknowns[z])?.minus(&self.f[now.base[z]]);
            return self.found(step, &along.with(&y), &used);
        };
        used.push(quadric.0.row);
        let before = self.mark();
        for sign in [1.0, -1.0] {
            let x = middle.plus(&half.scaled(sign));
            if meets(x.range(), self.x[now.unknowns[z]]) {
                let y = x.minus(&self.f[now.base[z]]);
                let result = self.found(step, &along.with(&y), &used);
                self.end(step, result, before)?;
            }
        }
        Ok(())
    }

    fn difference(&self, a: usize, b: usize) -> Model<S, M> {
        self.f[a].minus(&self.f[b])
    }

    /// What is known of a form. `None`: nothing but 0.
    fn known(&self, affine: &Affine) -> Option<Model<S, M>> {
        match affine.known {
            None => Some(Model::constant(Number::ONE)),
            Some([a, b]) if a == b => None,
            Some([a, b]) => Some(self.difference(a, b)),
        }
    }

    /// An equation in a step's unknowns.
    fn line(&self, equation: &Equation, size: usize) -> Line<S, M> {
        let mut coefficients = vec![Model::ZERO; size];
        let right = self.rows[equation.row].right;
        let mut constant = Model::constant(Number::new(-right));
        for term in &equation.terms {
            let (left, right) = (self.known(&term.left), self.known(&term.right));
            if let (Some(left), Some(right)) = (&left, &right) {
                let product = match (term.left.known, term.right.known) {
                    (_, None) => *left,
                    (None, _) => *right,
                    _ => left.times(right),
                };
                constant = constant.plus(&product.by(term.factor));
            }
            for (one, other) in [(&term.left, &right), (&term.right, &left)] {
                let Some(other) = other else { continue };
                for &(i, sign) in &one.own {
                    let more = other.by(term.factor).scaled(sign);
                    coefficients[i] = coefficients[i].plus(&more);
                }
            }
        }
        Line {
            row: equation.row,
            ratio: equation.ratio,
            coefficients,
            constant,
        }
    }

    /// An unknown as a variable, or as a number, where it is one or there are no more variables.
    fn symbol(&mut self, unknown: usize) -> Result<Model<S, M>, Stop<S>> {
        let Number { mid, rad } = Number::new(self.x[unknown]);
        if rad < NUMBER * (1.0 + mid.abs()) {
            return Ok(Model::constant(Number { mid, rad }));
        }
        if self.symbols.len() >= SYMBOLS {
            let wider = |other: usize| self.x[other].wid() >= self.x[unknown].wid();
            if !self.wanting.is_some_and(wider) {
                self.wanting = Some(unknown);
            }
            return Ok(Model::constant(Number { mid, rad }));
        }
        if self.symbols.len() == S {
            return Err(Stop::MoreSymbols);
        }
        self.symbols.push(unknown);
        Ok(Model::symbol(self.symbols.len() - 1, mid, rad))
    }

    /// Whether the variable that weighs most is not narrow yet.
    fn is_movable(&self, weights: &[f64; S]) -> bool {
        let pairs = self.symbols.iter().zip(weights);
        let best = pairs.max_by(|a, b| a.1.total_cmp(b.1));
        best.is_some_and(|(&symbol, &weight)| weight > 0.0 && self.x[symbol].wid() > FINE)
    }

    /// How much each variable has to do with some unknowns.
    fn weights<'u>(&self, unknowns: impl IntoIterator<Item = &'u usize>) -> [f64; S] {
        let mut weights = [0.0; S];
        for &u in unknowns {
            self.f[u].weigh(&mut weights);
        }
        weights
    }

    /// Which of the free unknowns a quadratic equation tells best, as floats see it in the middle of the part.
    fn told(
        &self,
        now: &Step,
        lines: &[Line<S, M>],
        pivots: &[(usize, usize)],
        free: &[usize],
        (quadric, products): Quadric<S, M>,
    ) -> usize {
        let size = now.unknowns.len();
        let middle = |i: usize| self.x[now.unknowns[i]].mid() - self.f[now.base[i]].middle();
        let y: Vec<f64> = (0..size).map(middle).collect();
        let mut slopes: Vec<f64> = quadric.coefficients.iter().map(|c| c.middle()).collect();
        for &(i, j, factor) in products {
            slopes[i] += factor * y[j];
            slopes[j] += factor * y[i];
        }
        let along = |i: usize| -> f64 {
            let beside = pivots
                .iter()
                .map(|&(line, pivot)| slopes[pivot] * lines[line].coefficients[i].middle());
            (slopes[i] - beside.sum::<f64>()).abs()
        };
        let best = free
            .iter()
            .copied()
            .max_by(|&i, &j| along(i).total_cmp(&along(j)));
        best.expect("some are free")
    }

    /// Both places of an unknown. `None`: it is better a variable, as the places come together and are near each other or nothing can be halved for that, or
    /// as the quadratic coefficient may vanish.
    fn roots(
        &self,
        (now, z): (&Step, usize),
        (quadric, products): Quadric<S, M>,
        Along { a, b }: &Along<S, M>,
    ) -> Result<Option<Roots<S, M>>, Stop<S>> {
        let (mut first, mut second, mut third) = (Model::ZERO, Model::ZERO, quadric.constant);
        for &(i, j, factor) in products {
            let both = match i == j {
                true => a[i].times(&b[i]).scaled(2.0),
                false => a[i].times(&b[j]).plus(&a[j].times(&b[i])),
            };
            first = first.plus(&b[i].times(&b[j]).scaled(factor));
            second = second.plus(&both.scaled(factor));
            third = third.plus(&a[i].times(&a[j]).scaled(factor));
        }
        for (i, coefficient) in quadric.coefficients.iter().enumerate() {
            second = second.plus(&coefficient.times(&b[i]));
            third = third.plus(&coefficient.times(&a[i]));
        }
        second = second.scaled(0.5);
        if first.middle() < 0.0 {
            [first, second, third] = [first, second, third].each(|x| x.scaled(-1.0));
        }
        let range = first.range();
        if !(range.lo > PIVOT * range.hi) {
            return Ok(None);
        }
        let radicand = second.squared().minus(&first.times(&third));
        let height = radicand.range();
        if height.hi < 0.0 {
            return Err(Stop::Empty);
        }
        if !(height.lo > RADICAND * height.hi && height.lo > LEAST) {
            let mut weights = [0.0; S];
            radicand.weigh(&mut weights);
            let apart = 2.0 * height.hi.sqrt() / range.lo;
            return match !(apart <= FAR) && self.is_movable(&weights) {
                true => Err(Stop::Blurred(weights)),
                false => Ok(None),
            };
        }
        let over = first.reciprocal(range);
        let middle = self.f[now.base[z]].minus(&second.times(&over));
        let half = radicand.square_root(height).times(&over);
        Ok(Some([middle, half]))
    }

    /// The unknowns of a step stand: looks at what that means for the equations, and goes on.
    fn found(&mut self, step: usize, y: &[Model<S, M>], used: &[usize]) -> Result<(), Stop<S>> {
        let order = self.order;
        let now = &order.steps[step];
        let before = self.equations.len();
        let mut is_blurred = false;
        for ((&u, &base), y) in now.unknowns.iter().zip(&now.base).zip(y) {
            let x = self.f[base].plus(y);
            self.f[u] = x;
            let (range, given) = (x.range(), self.x[u]);
            if !meets(range, given) {
                return Err(Stop::Empty);
            }
            is_blurred |= !(x.rest() <= BLURRED * (1.0 + x.middle().abs()));
            let more = BEYOND * given.wid();
            if range.lo < given.inf() - more || range.hi > given.sup() + more {
                self.equations.push(x.shifted(Number::new(-given)));
            }
        }
        if is_blurred {
            return Err(Stop::Blurred(self.weights(&now.unknowns)));
        }
        for &row in now.rows.iter().filter(|row| !used.contains(row)) {
            let equation = self.value(row);
            if equation.range().misses_zero(1.0) {
                return Err(Stop::Empty);
            }
            self.equations.push(equation);
        }
        if self.equations.len() > before {
            let Some(left) = self.contracted() else {
                return Err(Stop::Empty);
            };
            let kept: f64 = left.iter().map(|u| 0.5 * (u.hi - u.lo)).product();
            if kept < SHRUNK {
                self.put(&left, None, step + 1);
                return Ok(());
            }
        }
        self.go(step + 1)
    }

    /// The left-hand side of an equation less its right-hand one.
    fn value(&self, row: usize) -> Model<S, M> {
        let row = self.rows[row];
        let form = |form: Form| match form {
            Form::One => None,
            Form::Difference(a, b) => Some(self.difference(a, b)),
        };
        let start = Model::constant(Number::new(-row.right));
        row.products.iter().fold(start, |sum, p| {
            let product = match (form(p.left), form(p.right)) {
                (Some(left), Some(_)) if p.left == p.right => left.squared(),
                (Some(left), Some(right)) => left.times(&right),
                (Some(one), None) | (None, Some(one)) => one,
                (None, None) => Model::constant(Number::ONE),
            };
            sum.plus(&product.by(Number::new(p.factor)))
        })
    }

    /// What the equations leave of the variables, of −1 to 1 each. `None`: nothing.
    fn contracted(&mut self) -> Option<[Range; S]> {
        let mut left = [Range::SYMBOL; S];
        let result = contract(&self.equations, &mut self.room, &mut left, Margin::Some);
        result.is_ok().then_some(left)
    }

    /// Ends a way before a step. `weights`: how much is gained by halving each variable.
    fn leaf(&mut self, step: usize, weights: Option<[f64; S]>) {
        let Some(left) = self.contracted() else {
            return;
        };
        let weights = weights.unwrap_or_else(|| self.weights(self.order.unknowns()));
        self.put(&left, Some(&weights), step);
    }

    /// Keeps what is left where so many steps stand.
    fn put(&mut self, left: &[Range; S], weights: Option<&[f64; S]>, steps: usize) {
        let mut x = self.x.to_vec();
        for (&u, left) in self.symbols.iter().zip(left) {
            let Number { mid, rad } = Number::new(x[u]);
            x[u] = x[u].intersection(point(mid) + point(rad) * hull(left.lo, left.hi));
            if x[u].is_empty() {
                return;
            }
        }
        for &u in self.order.steps[..steps]
            .iter()
            .flat_map(|step| &step.unknowns)
        {
            let range = self.f[u].range();
            if range.lo.is_finite() && range.hi.is_finite() {
                x[u] = x[u].intersection(hull(range.lo, range.hi));
            }
            if x[u].is_empty() {
                return;
            }
        }
        let halve = weights.and_then(|weights| {
            let pairs = self.symbols.iter().zip(weights);
            let pairs = pairs.filter(|&(&u, _)| x[u].wid() > NUMBER * (1.0 + x[u].mag()));
            let best = pairs.max_by(|a, b| a.1.total_cmp(b.1)).map(|(&u, _)| u);
            self.wanting.or(best)
        });
        self.keep(Leaf {
            x,
            halve,
            is_whole: steps == self.order.steps.len(),
        });
    }

    /// Keeps a leaf, together with those that it overlaps by so much that both are no larger than one of their own.
    fn keep(&mut self, mut leaf: Leaf) {
        while let Some((k, hull)) = self.overlapping(&leaf) {
            let other = self.leaves.swap_remove(k);
            leaf = Leaf {
                x: hull,
                halve: leaf.halve.or(other.halve),
                is_whole: leaf.is_whole && other.is_whole,
            };
        }
        self.leaves.push(leaf);
    }

    /// A leaf that is kept and that another one overlaps by so much, by its place, and what holds both.
    fn overlapping(&self, leaf: &Leaf) -> Option<(usize, Vec<Interval>)> {
        let volume = |x: &[Interval]| volume(x, self.order.unknowns());
        let own = volume(&leaf.x);
        self.leaves.iter().enumerate().find_map(|(k, other)| {
            let pairs = leaf.x.iter().zip(&other.x);
            let hull: Vec<Interval> = pairs.map(|(x, y)| x.convex_hull(*y)).collect();
            let all = volume(&hull);
            let parts = [own, volume(&other.x)].each(|part| (part - all).exp());
            (parts[0] + parts[1] >= TOGETHER).then_some((k, hull))
        })
    }
}

impl<const S: usize, const M: usize> Line<S, M> {
    /// Takes off so many times the quadratic equation as makes it linear.
    fn less(&mut self, quadric: &Line<S, M>) {
        if self.ratio == 0.0 {
            return;
        }
        let ratio = self.ratio;
        let less = |one: &mut Model<S, M>, other: &Model<S, M>| {
            *one = one.minus(&other.scaled(ratio));
        };
        let pairs = self.coefficients.iter_mut().zip(&quadric.coefficients);
        pairs.for_each(|(one, other)| less(one, other));
        less(&mut self.constant, &quadric.constant);
    }
}

impl<const S: usize, const M: usize> Along<S, M> {
    /// The unknowns at a value of z.
    fn with(&self, z: &Model<S, M>) -> Vec<Model<S, M>> {
        let pairs = self.a.iter().zip(&self.b);
        pairs.map(|(a, b)| a.plus(&b.times(z))).collect()
    }
}

/// How much each variable has to do with the coefficients of equations that were not used, as they may vanish in the part: centres may come in line.
fn may_vanish<const S: usize, const M: usize>(
    lines: &[Line<S, M>],
    pivots: &[(usize, usize)],
) -> [f64; S] {
    let mut weights = [0.0; S];
    let is_open = |k: &usize| pivots.iter().all(|pivot| pivot.0 != *k);
    for line in (0..lines.len()).filter(is_open).map(|k| &lines[k]) {
        let places = (0..line.coefficients.len()).filter(|i| pivots.iter().all(|p| p.1 != *i));
        let sizes = places.map(|i| &line.coefficients[i]);
        if let Some(largest) = sizes.max_by(|a, b| a.size().total_cmp(&b.size())) {
            largest.weigh(&mut weights);
        }
    }
    weights
}

/// Whether a function may have values in a range.
fn meets(range: Range, given: Interval) -> bool {
    !(range.lo > given.sup() || range.hi < given.inf())
}

/// Gauss–Jordan elimination: the lines that were used, each with an unknown that has the coefficient 1 in it and 0 in all others. (These 0 and 1 are not
/// written; nobody reads them.)
fn eliminate<const S: usize, const M: usize>(
    lines: &mut [Line<S, M>],
    size: usize,
) -> Vec<(usize, usize)> {
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    while let Some((k, i, range)) = pivot(lines, size, &pivots) {
        let coefficient = lines[k].coefficients[i];
        let over = match coefficient.middle() < 0.0 {
            true => coefficient.scaled(-1.0).reciprocal(range).scaled(-1.0),
            false => coefficient.reciprocal(range),
        };
        pivots.push((k, i));
        let is_open = |j: &usize| pivots.iter().all(|pivot| pivot.1 != *j);
        let open: Vec<usize> = (0..size).filter(is_open).collect();
        let line = &mut lines[k];
        for &j in &open {
            line.coefficients[j] = line.coefficients[j].times(&over);
        }
        line.constant = line.constant.times(&over);
        let (coefficients, constant) = (line.coefficients.clone(), line.constant);
        for (_, line) in lines
            .iter_mut()
            .enumerate()
            .filter(|(other, _)| *other != k)
        {
            let by = line.coefficients[i];
            for &j in &open {
                line.coefficients[j] = line.coefficients[j].minus(&by.times(&coefficients[j]));
            }
            line.constant = line.constant.minus(&by.times(&constant));
        }
    }
    pivots
}

/// The next line and unknown of an elimination, with the range of the coefficient, up to its sign: the largest one of its line. `None`: all others may be
/// 0.
fn pivot<const S: usize, const M: usize>(
    lines: &[Line<S, M>],
    size: usize,
    pivots: &[(usize, usize)],
) -> Option<(usize, usize, Range)> {
    let mut best: Option<(f64, (usize, usize, Range))> = None;
    for (k, line) in lines.iter().enumerate() {
        if pivots.iter().any(|pivot| pivot.0 == k) {
            continue;
        }
        let open = (0..size).filter(|i| pivots.iter().all(|pivot| pivot.1 != *i));
        let sizes = open.clone().map(|i| line.coefficients[i].middle().abs());
        let largest = sizes.fold(0.0, f64::max);
        for i in open {
            let coefficient = &line.coefficients[i];
            let weight = coefficient.middle().abs() / largest;
            if best.is_some_and(|best| best.0 >= weight) {
                continue;
            }
            let range = match coefficient.middle() < 0.0 {
                true => coefficient.scaled(-1.0).range(),
                false => coefficient.range(),
            };
            if range.lo > PIVOT * range.hi && range.lo > LEAST {
                best = Some((weight, (k, i, range)));
            }
        }
    }
    best.map(|best| best.1)
}
