//! The equations of a problem with its dimensions, as the search over coordinates sees them.

use super::oriented::Oriented;
use crate::certificate::cover::coordinates::Shared;
use crate::equations;
use crate::interval::{Interval, ZERO, point};
use crate::order::each_once;
use crate::places::Each as _;
use crate::sets::Joined;
use crate::system::{Homotopy, Term};

/// A difference of two entries, or the number 1.
pub type Form = equations::Form<usize>;

/// A product of two; the factor is a small whole number, or half of one: exact.
pub type Product = equations::Product<usize, Interval>;

/// `Σ products ∈ right`: an equation, of which `right` encloses the right-hand side, or what follows from the equations in figures.
#[derive(Debug, Clone)]
pub struct Row {
    /// The left-hand side.
    pub products: Vec<Product>,
    /// The right-hand side, or bounds of the left one.
    pub right: Interval,
    /// The entries in it, each once.
    pub entries: Vec<usize>,
    /// Those of them that stand once in each of several products.
    pub repeated: Vec<usize>,
}

/// As many equations as unknowns, and what follows from these in figures.
///
/// Entries are numbered: the unknowns first, then the number 0.
#[derive(Debug, Clone)]
pub struct System {
    /// The number of unknowns, and of equations.
    pub unknowns: usize,
    /// The equations, in order, then what follows from them in figures, where lengths are positive.
    pub rows: Vec<Row>,
    /// The unknowns that are positive in figures.
    pub positive: Vec<usize>,
    /// The vectors that vanish in no figure: the entries of which their components are the differences.
    pub nonzero: Vec<Vec<[usize; 2]>>,
    /// The signs that are asked for, if any are.
    pub oriented: Option<Oriented>,
    /// Whether right-hand sides are anywhere in ranges, not known but for roundings.
    pub has_ranges: bool,
}

impl Row {
    /// A row of some products. `zero`: the entry that is the number 0.
    pub fn new(products: Vec<Product>, right: Interval, zero: usize) -> Self {
        let entries = products.iter().flat_map(|p| p.entries());
        let entries = each_once(entries.filter(|&entry| entry != zero));
        let is_repeated = |entry: &&usize| {
            let stands = products.iter().filter(|p| stands(p, **entry) == 1);
            stands.count() > 1
        };
        Row {
            repeated: entries.iter().filter(is_repeated).copied().collect(),
            entries,
            products,
            right,
        }
    }

    /// The left-hand side minus the right-hand one.
    pub fn value(&self, at: &[Interval]) -> Interval {
        self.products
            .iter()
            .fold(-self.right, |sum, p| sum + p.factor * product(p, at))
    }

    /// The same in floats.
    pub fn nearly(&self, at: &[f64]) -> f64 {
        let products = self.products.iter();
        let sum: f64 = products
            .map(|p| p.factor.mid() * p.value(|entry| at[entry]))
            .sum();
        sum - self.right.mid()
    }

    /// Its derivatives: told entry by entry, those of one entry to be added.
    pub fn derivatives(&self, at: &[Interval], mut tell: impl FnMut(usize, Interval)) {
        for p in &self.products {
            for (this, other) in [(p.left, p.right), (p.right, p.left)] {
                let slope = p.factor * other.value(|entry| at[entry]);
                for (entry, sign) in this.entries() {
                    tell(entry, if sign > 0 { slope } else { -slope });
                }
            }
        }
    }

    /// The same in floats.
    pub fn slopes(&self, at: &[f64], mut tell: impl FnMut(usize, f64)) {
        for p in &self.products {
            for (entry, sign, other) in p.derivatives(|entry| at[entry]) {
                tell(entry, f64::from(sign) * (p.factor.mid() * other));
            }
        }
    }
}

/// How often an entry stands in a product.
pub fn stands(p: &Product, entry: usize) -> usize {
    p.entries().filter(|&other| other == entry).count()
}

/// left · right, a square where both are the same.
pub fn product(p: &Product, at: &[Interval]) -> Interval {
    if p.left == p.right {
        return p.left.value(|entry| at[entry]).sqr();
    }
    let product = p.value(|entry| at[entry]);
    match shared(p, at) {
        None => product,
        Some(shared) => product.intersection(shared.product(at)),
    }
}

/// An entry that both factors have in common. `None`: there is none, or it is known.
pub fn shared(p: &Product, at: &[Interval]) -> Option<Shared> {
    let (Form::Difference(i, j), Form::Difference(k, l)) = (p.left, p.right) else {
        return None;
    };
    Shared::of([i, j], [k, l]).filter(|shared| at[shared.x].wid() > 0.0)
}

/// The logarithm of the product of the widths of some entries' ranges.
pub fn volume<'u>(x: &[Interval], entries: impl IntoIterator<Item = &'u usize>) -> f64 {
    let widths = entries.into_iter().map(|&u| x[u].wid().max(1e-300).ln());
    widths.sum()
}

/// How wide a range is, beside the size of its numbers where that is more than 1.
pub fn relative_width(x: Interval) -> f64 {
    x.wid() / (1.0f64).max(x.mag())
}

impl System {
    /// The equations of a homotopy with t = 1.
    pub fn new(homotopy: &Homotopy) -> Self {
        let m = homotopy.equations;
        let row = |terms: Vec<Term>, right: Interval| {
            let products = terms.into_iter().map(|term| {
                let [left, right] = term.forms().each(|form| form.map(|i| i.unwrap_or(m)));
                Product::new(point(0.5 * f64::from(term.factor)), left, right)
            });
            Row::new(products.collect(), right, m)
        };
        let equations = (0..m).map(|e| row(homotopy.terms(e), homotopy.rights[e].at_target()));
        let follow = homotopy.rows_in_figures().into_iter();
        let rows = equations.chain(follow.map(|terms| row(terms, ZERO)));
        let mut system = System {
            unknowns: m,
            rows: rows.collect(),
            positive: homotopy.positive_unknowns(),
            nonzero: homotopy.nonzero_vectors(),
            oriented: None,
            has_ranges: false,
        };
        let names = system.names();
        for ends in system.nonzero.iter_mut().flatten() {
            *ends = ends.each(|end| names[end.min(m)]);
        }
        system
    }

    /// For each entry the one that stands for all that equations say it is equal to, as in the equations themselves: the number 0, or the first of
    /// them.
    pub fn names(&self) -> Vec<usize> {
        let zero = self.unknowns;
        let order = |entry: usize| (entry != zero, entry);
        let mut sets = Joined::new(zero + 1);
        for row in &self.rows[..zero] {
            if let [p] = row.products[..]
                && row.right == ZERO
                && let (Form::Difference(a, b), Form::One) | (Form::One, Form::Difference(a, b)) =
                    (p.left, p.right)
            {
                let [a, b] = [a, b].each(|entry| sets.of(entry));
                sets.join(if order(a) < order(b) { [b, a] } else { [a, b] });
            }
        }
        (0..=zero).map(|entry| sets.of(entry)).collect()
    }

    /// The entry that stands for a coordinate of a point along an axis.
    pub fn coordinates<'h>(
        &self,
        homotopy: &'h Homotopy,
    ) -> impl Fn(usize, usize) -> usize + use<'h> {
        let (names, zero) = (self.names(), self.unknowns);
        move |p, axis| names[homotopy.coordinate(p, axis).unwrap_or(zero)]
    }

    /// Adds bounds of the squared distance of two points, given by the entries of their coordinates.
    pub fn bound(&mut self, ends: &[[usize; 2]], square: Interval) {
        let products = ends.iter().map(|&[a, b]| {
            let form = Form::Difference(a, b);
            Product::new(point(1.0), form, form)
        });
        self.rows
            .push(Row::new(products.collect(), square, self.unknowns));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::system::typical_length;

    /// Equations have the names that the search knows, but for those that say that two entries are equal.
    #[test]
    fn equations_have_one_name_for_what_is_equal() {
        let problem = Problem::parse(
            r#"
            name = "steps"
            dimension = 2
            [points]
            a = [0, 0]
            b = [3, 0]
            b2 = [3, 0]
            c = [4, 2]
            c2 = [4, 2]
            d = [9, 2]
            [constraints]
            fixed = ["a"]
            horizontal = [["a", "b"], ["c", "d"]]
            coincident = [["b", "b2"], ["c2", "c"]]
            distances = [["a", "b", 3], ["b2", "c2", 2], ["a", "c2", 4], ["c", "d", 5]]
            "#,
            "steps.toml",
        )
        .unwrap();
        let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
        let system = System::new(&homotopy);
        let names = system.names();
        let renamed = (0..system.unknowns).filter(|&u| names[u] != u).count();
        // Both coordinates of a, y of b, both of b2 and of c2, and y of d.
        assert_eq!(renamed, 8);
        let is_named = |row: &&Row| row.entries.iter().all(|&e| names[e] == e);
        let others: Vec<&Row> = system.rows.iter().filter(|row| !is_named(row)).collect();
        assert_eq!(others.len(), renamed);
        for row in others {
            assert_eq!((row.products.len(), row.right), (1, ZERO));
        }
    }
}
