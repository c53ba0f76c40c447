//! Parts of the space of all unknowns, and what the equations leave of them.
//!
//! A part has a range for every unknown. All that is done to it keeps every zero of the equations that is in it and has positive lengths, as
//! figures have, so that a part in which a range becomes empty has no figure.

use super::bounds::{Expanded, bounds, far};
use super::format::Block;
use super::shared::Shared;
use super::sums::{self, Sum};
use crate::certificate::checker::equations::{Equations, ZERO, ends};
use crate::certificate::checker::guess::invert;
use crate::interval::{Interval, checked, halves, is_narrower, point, upper_half};
use crate::system::Term;
use crate::system::told::{self, Flat, Side, Told, View};
use std::rc::Rc;

/// How often all equations are gone through at most. (No zero is lost whatever this number is.)
pub const ROUNDS: usize = 12;

/// How often sums of equations are gone through. (No zero is lost whatever this number is.)
const SUMMED: usize = 2;

/// A part in which nothing is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Empty;

/// A part of the space.
#[derive(Debug, Clone)]
pub struct Part {
    /// The range of each unknown; then that of t, which is 1, and of the numbers 0 and 1.
    x: Vec<Interval>,
    /// Which of them were narrowed since the equations were gone through.
    fresh: Vec<bool>,
    /// What is known exactly.
    exact: Rc<Exact>,
}

/// What is known exactly in a part.
#[derive(Debug, Clone, Default)]
struct Exact {
    told: Told,
    /// Equations that are on a side, what each says there, and whether that may stand in its place.
    sides: Vec<(usize, Flat, bool)>,
    /// The block whose linear equations were put into the others, since the last equation was put on a side, and what came of it.
    reduced: Option<(usize, Vec<Flat>)>,
}

impl Exact {
    /// What all this says.
    fn rows(&self) -> impl Iterator<Item = &Flat> {
        let reduced = self.reduced.iter().flat_map(|(_, rows)| rows);
        self.sides.iter().map(|side| &side.1).chain(reduced)
    }
}

/// A factor, and the two differences of entries that it multiplies: the number 1 is that of it and 0.
pub type Product = (i64, [[usize; 2]; 2]);

/// Σ products = right.
struct Row {
    products: Vec<Product>,
    right: Interval,
    /// The unknowns in it.
    unknowns: Vec<usize>,
}

/// The equations at t = 1.
pub struct Rows {
    /// Per equation 2 q_e = 2 E_e(1), and then what follows for figures.
    rows: Vec<Row>,
}

impl Part {
    /// All of the space where some unknowns are in ranges.
    pub fn whole(eq: &Equations, ranges: impl Iterator<Item = (usize, Interval)>) -> Part {
        let mut x = vec![Interval::ENTIRE; eq.m];
        for (i, range) in ranges {
            x[i] = x[i].intersection(range);
        }
        x.extend([point(1.0), ZERO, point(1.0)]);
        Part {
            fresh: vec![true; x.len()],
            x,
            exact: Rc::default(),
        }
    }

    /// The ranges of the unknowns.
    pub fn ranges(&self) -> &[Interval] {
        &self.x[..self.x.len() - 3]
    }

    /// The ranges of all entries: also of t and of the numbers 0 and 1.
    pub fn entries(&self) -> &[Interval] {
        &self.x
    }

    /// Whether what linear equations of a block say was put into the others in this part, since an equation was put on a side.
    pub fn is_reduced(&self, block: usize) -> bool {
        let reduced = self.exact.reduced.as_ref();
        reduced.is_some_and(|(last, _)| *last == block)
    }

    fn view<'a>(&'a self, eq: &'a Equations, block: &'a Block) -> View<'a> {
        View {
            homotopy: &eq.homotopy,
            equations: &block.equations,
            unknowns: &block.unknowns,
            ranges: self.ranges(),
        }
    }

    /// The part with an equation of a block on each of its sides, if it has some: every zero is on one of them.
    pub fn sides(&self, eq: &Equations, block: &Block, e: usize) -> Option<Vec<Part>> {
        let sides = self.exact.told.sides(&self.view(eq, block), e)?;
        let on = |side: Side| {
            // Newton's step takes it to be linear.
            let is_linear = side.says.terms.iter().all(|term| term.2.is_none());
            is_linear.then_some(())?;
            let mut sides = self.exact.sides.clone();
            sides.push((e, side.says, side.is_whole));
            let mut part = self.clone();
            part.fresh.fill(true);
            part.exact = Rc::new(Exact {
                told: side.told,
                sides,
                reduced: None,
            });
            Some(part)
        };
        sides.into_iter().map(on).collect()
    }

    /// What an equation says that is on a side, if that may stand in its place.
    fn side(&self, e: usize) -> Option<&Flat> {
        let mut sides = self.exact.sides.iter();
        sides.find(|side| side.0 == e && side.2).map(|side| &side.1)
    }

    /// Puts what linear equations of a block say into the others, in exact numbers.
    pub fn reduce(&mut self, eq: &Equations, (b, block): (usize, &Block)) -> Result<(), Empty> {
        let mut exact = (*self.exact).clone();
        let view = self.view(eq, block);
        let reduced = exact.told.reduced(&view).map_err(|_| Empty)?;
        let rows = reduced.rows.iter().map(|row| exact.told.flat(&view, row));
        exact.reduced = Some((b, rows.collect()));
        for (i, value) in exact.told.values() {
            self.narrow(i, told::range(value))?;
        }
        self.exact = Rc::new(exact);
        self.narrow_by_exact()
    }

    /// Narrows by what was put together in exact numbers.
    fn narrow_by_exact(&mut self) -> Result<(), Empty> {
        let exact = Rc::clone(&self.exact);
        exact.rows().try_for_each(|flat| sums::narrow(flat, self))
    }

    /// The part with an unknown in the lower and in the upper half of its range, which share a border.
    pub fn halved(&self, unknown: usize) -> Option<[Part; 2]> {
        let with = |range| {
            let mut part = self.clone();
            part.x[unknown] = range;
            part.fresh[unknown] = true;
            part
        };
        Some(halves(*self.ranges().get(unknown)?)?.map(with))
    }

    /// Narrows one range to what it has in common with another one.
    pub fn narrow(&mut self, i: usize, to: Interval) -> Result<(), Empty> {
        let old = self.x[i];
        let new = old.intersection(to);
        if new.is_empty() {
            return Err(Empty);
        }
        self.fresh[i] |= is_narrower(new, old);
        self.x[i] = new;
        Ok(())
    }
}

/// The difference of two entries: an entry less itself is zero, whatever it is.
pub fn difference(x: &[Interval], [i, j]: [usize; 2]) -> Interval {
    if i == j { ZERO } else { x[i] - x[j] }
}

/// factor · left · right, where each is a difference.
fn value((factor, [left, right]): Product, x: &[Interval]) -> Interval {
    let value = difference(x, left);
    let product = match left == right {
        true => value.sqr(),
        false => {
            let product = value * difference(x, right);
            match Shared::of(left, right) {
                None => product,
                Some(shared) => product.intersection(shared.product(x)),
            }
        }
    };
    point(factor as f64) * product
}

impl Rows {
    /// Of the equations.
    pub fn new(eq: &Equations) -> Rows {
        let row = |terms: Vec<Term>, right| {
            let products = terms.into_iter().map(|term| {
                let forms = term.forms().map(|form| ends(form, eq.m));
                (term.factor.into(), forms)
            });
            let products: Vec<Product> = products.collect();
            let entries = products.iter().flat_map(|product| product.1.as_flattened());
            let mut unknowns: Vec<usize> = entries.copied().filter(|&i| i < eq.m).collect();
            unknowns.sort_unstable();
            unknowns.dedup();
            Row {
                products,
                right,
                unknowns,
            }
        };
        let right = |e: usize| point(2.0) * eq.right_at(e, point(1.0))[0];
        let own = (0..eq.m).map(|e| row(eq.homotopy.terms(e), right(e)));
        let follow = eq.homotopy.rows_in_figures().into_iter();
        Rows {
            rows: own.chain(follow.map(|terms| row(terms, ZERO))).collect(),
        }
    }

    /// Whether all equations hold for these numbers, reckoned without any rounding.
    pub fn hold_exactly(&self, eq: &Equations, at: &[f64]) -> bool {
        let ends = [1.0, 0.0, 1.0];
        let x: Vec<Interval> = at.iter().chain(&ends).map(|&x| point(x)).collect();
        self.rows[..eq.m].iter().all(|row| {
            let sum = row.products.iter().fold(-row.right, |sum, &product| {
                // Where a range is one number nothing was rounded.
                sum + value(product, &x)
            });
            sum == ZERO
        })
    }

    /// Narrows a part by the equations one after the other, again and again while that helps.
    pub fn narrow(&self, part: &mut Part) -> Result<(), Empty> {
        for _ in 0..ROUNDS {
            let before = std::mem::replace(&mut part.fresh, vec![false; part.x.len()]);
            if !before.contains(&true) {
                break;
            }
            for row in &self.rows {
                if row.unknowns.iter().any(|&i| before[i] || part.fresh[i]) {
                    narrow_by(row, part)?;
                }
            }
            part.narrow_by_exact()?;
        }
        part.fresh.fill(false);
        Ok(())
    }

    /// The sums of a block's equations that narrow parts beside these.
    pub fn sums(&self, block: &Block, part: &Part) -> Vec<Sum> {
        sums::choose(&self.expanded(block, part))
    }

    /// The equations of a block in its unknowns, all other entries being numbers in their ranges.
    fn expanded(&self, block: &Block, part: &Part) -> Vec<Expanded> {
        let expanded = block.equations.iter().map(|&e| {
            let side = part.side(e);
            let side = side.and_then(|flat| Expanded::of(flat, &block.unknowns, part.entries()));
            side.unwrap_or_else(|| self.whole(e, block, part))
        });
        expanded.collect()
    }

    /// An equation on no side.
    fn whole(&self, e: usize, block: &Block, part: &Part) -> Expanded {
        let row = (self.rows[e].products.as_slice(), self.rows[e].right);
        Expanded::new(row, &block.unknowns, part.entries())
    }

    /// Sums of a block's equations, which `sums` says.
    fn added(&self, (block, sums): (&Block, &[Sum]), part: &Part) -> Vec<Flat> {
        let rows = block.equations.iter().map(|&e| self.whole(e, block, part));
        let rows: Vec<Expanded> = rows.collect();
        let sums = sums.iter().filter_map(|sum| sum.of(&rows));
        sums.map(|sum| sum.flat(&block.unknowns)).collect()
    }

    /// Narrows by sums of a block's equations, which `sums` says, and by the equations one by one.
    pub fn add_up(&self, (block, sums): (&Block, &[Sum]), part: &mut Part) -> Result<(), Empty> {
        let sums = self.added((block, sums), part);
        for _ in 0..SUMMED {
            for sum in &sums {
                sums::narrow(sum, part)?;
            }
            self.narrow(part)?;
        }
        Ok(())
    }

    /// Narrows by a block's equations together, where its unknowns are bounded; all others are numbers in their ranges.
    ///
    /// With c in the middle and F the block's equations, which are quadratic, F(x) = F(c) + J((x + c)/2)(x − c) exactly.
    /// Each row of Y F(x) = 0, Y any matrix of floats, is solved for one unknown.
    pub fn together(&self, eq: &Equations, block: &Block, part: &mut Part) -> Result<(), Empty> {
        let n = block.unknowns.len();
        let is_bounded = |&u: &usize| part.x[u].is_common_interval();
        if !block.unknowns.iter().all(is_bounded) {
            return Ok(());
        }
        let middle: Vec<f64> = block.unknowns.iter().map(|&u| part.x[u].mid()).collect();
        let with = |of: &dyn Fn(usize) -> Interval| {
            let mut x = part.x.clone();
            (0..n).for_each(|k| x[block.unknowns[k]] = of(k));
            x
        };
        let slopes = |x: &[Interval]| -> Vec<Vec<(usize, Interval)>> {
            let row = |&e: &usize| {
                if let Some(flat) = part.side(e) {
                    let own = |u: usize| block.unknowns.iter().position(|&v| v == u);
                    let terms = flat.terms.iter();
                    return terms
                        .filter_map(|&(by, u, _)| Some((own(u)?, by)))
                        .collect();
                }
                let terms = eq.gradient[e].iter().filter_map(|&(i, factor, form)| {
                    let k = block.unknowns.iter().position(|&u| u == i)?;
                    let slope = point(factor as f64) * difference(x, eq.forms[form]);
                    Some((k, slope))
                });
                terms.collect()
            };
            block.equations.iter().map(row).collect()
        };
        let at = with(&|k| point(middle[k]));
        let near = slopes(&at);
        let mut columns = vec![Vec::new(); n];
        for (e, row) in near.iter().enumerate() {
            row.iter().for_each(|(k, x)| columns[*k].push((e, x.mid())));
        }
        let Some(y) = invert(&columns).filter(|y| y.entries.iter().all(|y| y.is_finite())) else {
            return Ok(());
        };
        let values = block.equations.iter().map(|&e| {
            if let Some(flat) = part.side(e) {
                let terms = flat.terms.iter();
                return terms.fold(flat.constant, |sum, &(by, u, _)| sum + by * at[u]);
            }
            let row = &self.rows[e];
            let products = row.products.iter();
            products.fold(-row.right, |sum, &product| sum + value(product, &at))
        });
        let values: Vec<Interval> = values.collect();
        let half = point(0.5);
        let between = slopes(&with(&|k| {
            (part.x[block.unknowns[k]] + point(middle[k])) * half
        }));
        for i in 0..n {
            let (mut line, mut constant) = (vec![ZERO; n], ZERO);
            for e in 0..n {
                let by = point(y.entries[e * n + i]);
                constant += by * values[e];
                between[e]
                    .iter()
                    .for_each(|&(k, slope)| line[k] += by * slope);
            }
            if line[i].contains(0.0) {
                continue;
            }
            let rest = (0..n).filter(|&k| k != i).fold(constant, |sum, k| {
                sum + line[k] * (part.x[block.unknowns[k]] - point(middle[k]))
            });
            part.narrow(block.unknowns[i], point(middle[i]) - rest / line[i])?;
        }
        Ok(())
    }
}

impl Rows {
    /// Bounds the unknowns of a block ([`bounds`]).
    pub fn bound(&self, (block, sums): (&Block, &[Sum]), part: &mut Part) -> Result<(), Empty> {
        let found = bounds(&self.expanded(block, part), block.unknowns.len());
        let ranges = block.unknowns.iter().zip(found.into_iter().flatten());
        for (&u, range) in ranges {
            part.narrow(u, range)?;
        }
        let unbounded = block.unknowns.iter().copied();
        let unbounded: Vec<usize> = unbounded
            .filter(|&u| !part.x[u].is_common_interval())
            .collect();
        let is_about = |row: &&Row| row.unknowns.iter().any(|u| unbounded.contains(u));
        let rows = self.rows.iter().filter(is_about);
        let rows = rows.map(|row| {
            let row = (row.products.as_slice(), row.right);
            Expanded::new(row, &unbounded, part.entries())
        });
        let more = self.added((block, sums), part);
        let more = more.iter().chain(part.exact.rows());
        let more = more.filter_map(|flat| Expanded::of(flat, &unbounded, part.entries()));
        for (k, range) in far(rows.chain(more), unbounded.len()) {
            part.narrow(unbounded[k], range)?;
        }
        Ok(())
    }
}

/// Narrows by one row: factor · L · R = right − rest, and all on the right is in a range.
fn narrow_by(row: &Row, part: &mut Part) -> Result<(), Empty> {
    let values: Vec<Interval> = row
        .products
        .iter()
        .map(|&product| value(product, &part.x))
        .collect();
    if values
        .iter()
        .fold(ZERO, |sum, &x| sum + x)
        .disjoint(row.right)
    {
        return Err(Empty);
    }
    // The sums of all products behind each.
    let mut behind = vec![ZERO; values.len() + 1];
    for k in (0..values.len()).rev() {
        behind[k] = behind[k + 1] + values[k];
    }
    let mut before = ZERO;
    for (k, &(factor, [left, right])) in row.products.iter().enumerate() {
        let rest = before + behind[k + 1];
        before += values[k];
        let wanted = (row.right - rest) / point(factor as f64);
        if left == right {
            square(left, wanted, part)?;
            continue;
        }
        if let Some(shared) = Shared::of(left, right) {
            shared.narrow(wanted, part)?;
        }
        for (this, other) in [(left, right), (right, left)] {
            let by = difference(&part.x, other);
            // If 0 may be the product and the other factor, this one may be anything. If 0 is not
            // the product, it is not the other factor, and the quotient is of all others.
            if !(by.contains(0.0) && wanted.contains(0.0)) {
                narrow_form(this, wanted / by, part)?;
            }
        }
    }
    Ok(())
}

/// Narrows by L² in a range.
pub fn square(form: [usize; 2], range: Interval, part: &mut Part) -> Result<(), Empty> {
    let both = roots(range, difference(&part.x, form))?;
    narrow_form(form, both, part)
}

/// A range of a number in which it is, as its square is in another one.
pub fn roots(square: Interval, now: Interval) -> Result<Interval, Empty> {
    let square = square.intersection(upper_half());
    if square.is_empty() {
        return Err(Empty);
    }
    let root = square.sqrt();
    let most = root.sup();
    // Of −root and root what may be.
    let sides = [-root, root].map(|side| side.intersection(now));
    match (sides[0].is_empty(), sides[1].is_empty()) {
        (true, true) => Err(Empty),
        (true, false) => Ok(sides[1]),
        (false, true) => Ok(sides[0]),
        (false, false) => Ok(checked(-most, most).unwrap_or(Interval::ENTIRE)),
    }
}

/// Narrows by L = a − b in a range: a is in L + b, and b in a − L.
pub fn narrow_form([a, b]: [usize; 2], range: Interval, part: &mut Part) -> Result<(), Empty> {
    let range = range.intersection(difference(&part.x, [a, b]));
    if range.is_empty() {
        return Err(Empty);
    }
    if a == b {
        return Ok(());
    }
    let unknowns = part.x.len() - 3;
    if a < unknowns {
        part.narrow(a, range + part.x[b])?;
    }
    if b < unknowns {
        part.narrow(b, part.x[a] - range)?;
    }
    Ok(())
}
