//! The equations that are no distances: sums of products of differences.

mod products;
mod rows;

use crate::equations::Form;
use crate::places::Each as _;
use crate::system::Homotopy;
use products::Slots;
use rows::Rows;
use std::collections::HashMap;

pub use products::Forms;

/// Products of *forms*: differences of unknowns, and the number 1.
#[derive(Debug, Clone)]
pub struct Tail {
    /// The entries of z that each form is the difference of.
    ends: Vec<[u32; 2]>,
    /// The products, equation by equation.
    products: Vec<Product>,
    /// The same, for four equations at a time.
    slots: Slots,
    /// Where each equation's products begin in that list, and where the last one's end.
    starts: Vec<u32>,
    /// The number of the first equation of the tail.
    first: usize,
    /// The number of products of the longest equation; zero if there is none.
    longest: usize,
    /// What entries of the Jacobian are made of, by column, then by row.
    sources: Vec<Source>,
    /// Where each column's begin.
    columns: Vec<u32>,
    /// The Jacobian row by row.
    rows: Rows,
}

/// `half · left · right`, added to an equation.
#[derive(Debug, Clone, Copy)]
struct Product {
    equation: u32,
    left: u32,
    right: u32,
    /// Half the factor, which is exact.
    half: f64,
}

/// A form, times a factor, that is part of an entry of the Jacobian.
#[derive(Debug, Clone, Copy)]
pub struct Source {
    row: u32,
    form: u32,
    factor: f64,
    /// Whether it is the first part of its entry.
    begins: bool,
    /// The entry's place among the values of the pattern.
    pub plain: u32,
    /// Its place among those of the bordered pattern.
    pub bordered: u32,
}

impl Tail {
    /// The form that is the number 1.
    pub const ONE: usize = 0;

    /// The equations of a homotopy behind its distances.
    pub fn new(homotopy: &Homotopy) -> Self {
        let (m, first) = (homotopy.equations, homotopy.half_squares().count());
        let zero = m as u32 + 1;
        let mut ends = vec![[zero; 2]];
        let mut known = HashMap::from([(Form::One, Self::ONE as u32)]);
        let mut form = |form: Form<Option<usize>>| {
            *known.entry(form).or_insert_with(|| {
                if let Form::Difference(a, b) = form.map(|i| i.map_or(zero, |i| i as u32)) {
                    ends.push([a, b]);
                }
                ends.len() as u32 - 1
            })
        };
        let (mut products, mut starts, mut longest) = (Vec::new(), vec![0], 0);
        for equation in first..m {
            let terms = homotopy.terms(equation);
            longest = longest.max(terms.len());
            products.extend(terms.iter().map(|term| Product {
                equation: equation as u32,
                left: form(term.left),
                right: form(term.right),
                half: 0.5 * f64::from(term.factor),
            }));
            starts.push(products.len() as u32);
        }
        // The derivative of `half · left · right` by an unknown in one factor has the other one.
        let mut parts: HashMap<(u32, u32, u32), f64> = HashMap::new();
        for p in &products {
            for (of, other) in [(p.left, p.right), (p.right, p.left)] {
                let [plus, minus] = ends[of as usize];
                for (column, sign) in [(plus, 1.0), (minus, -1.0)] {
                    if (column as usize) < m {
                        let part = parts.entry((column, p.equation, other)).or_default();
                        *part += sign * p.half;
                    }
                }
            }
        }
        let mut parts: Vec<_> = parts.into_iter().collect();
        parts.sort_by_key(|&((column, row, form), _)| (row, column, form));
        let by_row: Vec<_> = parts
            .iter()
            .map(|&((column, row, form), factor)| ((row, column, form), factor))
            .collect();
        let rows = Rows::new(&by_row, first, m - first);
        parts.sort_by_key(|&(place, _)| place);
        let mut sources: Vec<Source> = Vec::with_capacity(parts.len());
        let mut columns = vec![0; m + 1];
        let mut last = None;
        for ((column, row, form), factor) in parts {
            sources.push(Source {
                row,
                form,
                factor,
                begins: last != Some((column, row)),
                plain: 0,
                bordered: 0,
            });
            last = Some((column, row));
            columns[column as usize + 1] = sources.len() as u32;
        }
        for column in 0..m {
            columns[column + 1] = columns[column + 1].max(columns[column]);
        }
        if first == m {
            // Problems of distances alone carry nothing along.
            ends.clear();
        }
        let of_equation = |e: usize| match e.checked_sub(first) {
            None => Vec::new(),
            Some(k) => products[starts[k] as usize..starts[k + 1] as usize]
                .iter()
                .map(|p| (p.half, [p.left as usize, p.right as usize]))
                .collect(),
        };
        Tail {
            slots: Slots::new(m, of_equation),
            ends,
            products,
            starts,
            first,
            longest,
            sources,
            columns,
            rows,
        }
    }

    /// Whether there are distances only.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.products.is_empty()
    }

    /// The number of products of its longest equation; zero if there is none. Error bounds take it from
    /// `roundings.rs`.
    pub fn longest(&self) -> usize {
        self.longest
    }

    /// The number of the first of its equations, as many as there are distances.
    #[inline(always)]
    pub fn first(&self) -> usize {
        self.first
    }

    /// The number of forms.
    pub fn forms(&self) -> usize {
        self.ends.len()
    }

    fn of_column(&self, column: usize) -> std::ops::Range<usize> {
        self.columns[column] as usize..self.columns[column + 1] as usize
    }

    /// The rows in which the tail has entries in a column of the Jacobian, from above.
    pub fn rows_of_column(&self, column: usize) -> impl Iterator<Item = usize> + '_ {
        let sources = self.sources[self.of_column(column)].iter();
        sources.filter(|s| s.begins).map(|s| s.row as usize)
    }

    /// Gives the entries in a column their places in the pattern, from `plain` on, and in the bordered
    /// one, in which the normal has an entry in each column before. Returns the number of entries.
    pub fn place_column(&mut self, column: usize, plain: u32) -> u32 {
        let mut entries = 0;
        let range = self.of_column(column);
        for source in &mut self.sources[range] {
            entries += source.begins as u32;
            source.plain = plain + entries - 1;
            source.bordered = source.plain + column as u32;
        }
        entries
    }

    /// The entries of z that a form is the difference of; not for the number 1.
    pub fn ends(&self, form: usize) -> [usize; 2] {
        self.ends[form].each(|end| end as usize)
    }

    /// `Σ |half| |x_left| |y_right|` of one equation, zero for distances.
    pub fn half_products_abs(&self, equation: usize, x: &[f64], y: &[f64]) -> f64 {
        let products = self.products_of(equation).iter();
        let size = |p: &Product| p.half.abs() * (x[p.left as usize] * y[p.right as usize]).abs();
        products.map(size).sum()
    }

    fn products_of(&self, equation: usize) -> &[Product] {
        match equation.checked_sub(self.first) {
            None => &[],
            Some(k) => &self.products[self.starts[k] as usize..self.starts[k + 1] as usize],
        }
    }

    /// The products of an equation: half the factor, and the two forms.
    pub fn products(&self, equation: usize) -> impl Iterator<Item = (f64, [usize; 2])> + '_ {
        let products = self.products_of(equation).iter();
        products.map(|p| (p.half, [p.left as usize, p.right as usize]))
    }

    /// The Jacobian's entries from the values of forms, each at the place that `at` says.
    pub fn values(&self, forms: &[f64], at: impl Fn(&Source) -> usize, out: &mut [f64]) {
        for source in &self.sources {
            let part = source.factor * forms[source.form as usize];
            let out = &mut out[at(source)];
            *out = if source.begins { part } else { *out + part };
        }
    }
}

/// What of an equation tests put a fault into.
#[cfg(test)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The coefficient of a product, in F and in what bounds it.
    Product,
    /// That of an entry of the Jacobian's row.
    Entry,
    /// That of an entry of the Jacobian as a sparse matrix.
    Source,
}

#[cfg(test)]
impl Tail {
    /// Multiplies the coefficients of an equation's k-th product, entry or source; nothing if it has fewer.
    pub fn spoil(&mut self, equation: usize, part: Part, k: usize, by: f64) {
        match part {
            Part::Product => self.slots.spoil(equation, k, by),
            Part::Entry => {
                let row = self.row(equation);
                self.rows.spoil(row.clone().nth(k), by);
            }
            Part::Source => {
                let mut sources = self.sources.iter_mut();
                let of_row = sources.by_ref().filter(|s| s.row as usize == equation);
                of_row.skip(k).take(1).for_each(|s| s.factor *= by);
            }
        }
    }

    /// Row and column of each source of the Jacobian as a sparse matrix, with its value.
    pub fn sparse(&self, forms: &[f64]) -> Vec<([usize; 2], f64)> {
        let columns = (0..self.columns.len() - 1).flat_map(|column| {
            let sources = self.sources[self.of_column(column)].iter();
            sources.map(move |s| ([s.row as usize, column], s.factor * forms[s.form as usize]))
        });
        columns.collect()
    }
}
