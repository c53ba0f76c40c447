//! The equations that are no distances: sums of products of differences.

use crate::linalg::{LANE, Vector};
use crate::system::Homotopy;
use std::collections::HashMap;
use std::ops::Deref;

/// Products of *forms*: differences of unknowns, and the number 1.
#[derive(Debug, Clone)]
pub struct Tail {
    /// The entries of z that each form is the difference of.
    ends: Vec<[u32; 2]>,
    /// The products, equation by equation.
    products: Vec<Product>,
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

/// The tail's rows of the Jacobian, as compressed lists: for each entry its unknown and what it is made of.
#[derive(Debug, Clone, Default)]
struct Rows {
    /// Where each equation's entries begin, and where the last one's end.
    starts: Vec<u32>,
    /// The unknown of each entry.
    unknowns: Vec<u32>,
    /// Where the parts of each entry begin, and where the last one's end.
    parts_of: Vec<u32>,
    /// Forms with their factors, entry by entry.
    parts: Vec<(u32, f64)>,
}

impl Rows {
    /// From parts by equation, unknown and form, in this order; the tail's equations begin at `first`.
    fn new(parts: &[((u32, u32, u32), f64)], first: usize, equations: usize) -> Self {
        let mut rows = Rows::default();
        let mut last = None;
        let mut counts = vec![0u32; equations];
        for &((equation, unknown, form), factor) in parts {
            if last != Some((equation, unknown)) {
                last = Some((equation, unknown));
                rows.unknowns.push(unknown);
                rows.parts_of.push(rows.parts.len() as u32);
                counts[equation as usize - first] += 1;
            }
            rows.parts.push((form, factor));
        }
        rows.parts_of.push(rows.parts.len() as u32);
        rows.starts.push(0);
        let mut end = 0;
        for count in counts {
            end += count;
            rows.starts.push(end);
        }
        rows
    }
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

/// The values of all forms, and the two factors of each product as vectors of their own: so products are
/// multiplied four at a time, whatever forms they are of.
#[derive(Debug, Clone)]
pub struct Forms {
    values: Vector,
    /// By product.
    left: Vector,
    /// By product, times half the product's factor.
    right: Vector,
}

impl Forms {
    /// Room for the forms of a tail.
    pub fn new(tail: &Tail) -> Self {
        Forms {
            values: Vector::zeros(tail.forms()),
            left: Vector::zeros(tail.products.len()),
            right: Vector::zeros(tail.products.len()),
        }
    }

    /// Sets all of them.
    #[inline(always)]
    pub fn set(&mut self, tail: &Tail, value: impl Fn(usize) -> f64) {
        for (form, out) in self.values.iter_mut().enumerate() {
            *out = value(form);
        }
        let factors = self.left.iter_mut().zip(self.right.iter_mut());
        for ((left, right), p) in factors.zip(&tail.products) {
            *left = self.values[p.left as usize];
            *right = p.half * self.values[p.right as usize];
        }
    }

    /// The products of this and other forms in a lane of products, added to `sum`.
    #[inline(always)]
    fn times(&self, other: &Self, lane: usize, mut sum: [f64; LANE]) -> [f64; LANE] {
        let (left, right) = (&self.left.lanes()[lane], &other.right.lanes()[lane]);
        for i in 0..LANE {
            sum[i] = left[i].mul_add(right[i], sum[i]);
        }
        sum
    }

    /// The absolute values of the products of this and other forms in a lane of products, added to `sum`.
    #[inline(always)]
    fn times_abs(&self, other: &Self, lane: usize, mut sum: [f64; LANE]) -> [f64; LANE] {
        let (left, right) = (&self.left.lanes()[lane], &other.right.lanes()[lane]);
        for i in 0..LANE {
            sum[i] += (left[i] * right[i]).abs();
        }
        sum
    }
}

impl Deref for Forms {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values
    }
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
        let mut known = HashMap::from([(None, Self::ONE as u32)]);
        let mut form = |form: Option<[usize; 2]>| {
            *known.entry(form).or_insert_with(|| {
                ends.push(form.unwrap_or([m + 1; 2]).map(|end| end as u32));
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
        Tail {
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

    /// The number of entries in all of its rows of the Jacobian, the column of t left out.
    pub fn entries(&self) -> usize {
        self.rows.unknowns.len()
    }

    /// Which of these are in the row of an equation; none for distances.
    #[inline(always)]
    pub fn row(&self, equation: usize) -> std::ops::Range<usize> {
        match equation.checked_sub(self.first) {
            None => 0..0,
            Some(k) => self.rows.starts[k] as usize..self.rows.starts[k + 1] as usize,
        }
    }

    /// The unknown of an entry.
    #[inline(always)]
    pub fn unknown(&self, entry: usize) -> usize {
        self.rows.unknowns[entry] as usize
    }

    /// The entry of an unknown in an equation's row, if there is one.
    pub fn entry(&self, equation: usize, unknown: usize) -> Option<usize> {
        self.row(equation)
            .find(|&entry| self.unknown(entry) == unknown)
    }

    fn parts(&self, entry: usize) -> &[(u32, f64)] {
        let rows = &self.rows;
        &rows.parts[rows.parts_of[entry] as usize..rows.parts_of[entry + 1] as usize]
    }

    /// The values of all entries from those of forms.
    pub fn row_values(&self, forms: &[f64], out: &mut [f64]) {
        for (entry, out) in out.iter_mut().enumerate() {
            let value = |&(form, factor): &(u32, f64)| factor * forms[form as usize];
            *out = self.parts(entry).iter().map(value).sum();
        }
    }

    /// Bounds on all entries, and on the terms that they are sums of, from bounds on forms.
    pub fn row_sizes(&self, forms: &[f64], out: &mut [f64]) {
        for (entry, out) in out.iter_mut().enumerate() {
            let size = |&(form, factor): &(u32, f64)| factor.abs() * forms[form as usize];
            *out = self.parts(entry).iter().map(size).sum();
        }
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

    /// The forms of a point, or of a direction, along which the number 1 does not change: `one` is 0 then.
    #[inline(always)]
    pub fn differences(&self, v: &[f64], one: f64, out: &mut Forms) {
        out.set(self, |form| match form {
            Self::ONE => one,
            _ => {
                let [i, j] = self.ends(form);
                v[i] - v[j]
            }
        });
    }

    /// For each form z_i − z_j the sum z_i + z_j in its place.
    pub fn sums(&self, z: &[f64], out: &mut Forms) {
        out.set(self, |form| self.sum_of(form, z));
    }

    /// z_i + z_j for the form z_i − z_j; zero for the number 1.
    pub fn sum_of(&self, form: usize, z: &[f64]) -> f64 {
        let [i, j] = self.ends(form);
        z[i] + z[j]
    }

    /// The entries of z that a form is the difference of; not for the number 1.
    pub fn ends(&self, form: usize) -> [usize; 2] {
        self.ends[form].map(|end| end as usize)
    }

    /// Adds what each product has to its equation; `value` tells that of four products at a time.
    ///
    /// Fewer roundings than [`Equations::roundings`](super::Equations::roundings) counts: the products of an
    /// equation are added up one after the other.
    #[inline(always)]
    fn add(&self, value: impl Fn(usize) -> [f64; LANE], out: &mut [f64]) {
        for (lane, products) in self.products.chunks(LANE).enumerate() {
            for (p, value) in products.iter().zip(value(lane)) {
                out[p.equation as usize] += value;
            }
        }
    }

    /// Adds `Σ half · x_left · x_right` to the equations.
    pub fn add_squares(&self, x: &Forms, out: &mut [f64]) {
        self.add(|lane| x.times(x, lane, [0.0; LANE]), out);
    }

    /// Adds `factor · Σ half · (x_left · y_right + y_left · x_right)`, factor being 1 or −1: J y at x.
    pub fn add_products(&self, factor: f64, x: &Forms, y: &Forms, out: &mut [f64]) {
        let value = |lane: usize| {
            let sum = x.times(y, lane, [0.0; LANE]);
            y.times(x, lane, sum).map(|sum| factor * sum)
        };
        self.add(value, out);
    }

    /// Adds the coefficient of sᵏ, from products of orders from `least` on, of all forms being polynomials in s.
    pub fn add_coefficient<'a>(
        &self,
        k: usize,
        least: usize,
        order: usize,
        forms: impl Fn(usize) -> &'a Forms,
        out: &mut [f64],
    ) {
        let value = |lane: usize| {
            let mut sum = [0.0; LANE];
            for a in least.max(k.saturating_sub(order))..=k / 2 {
                let (x, y) = (forms(a), forms(k - a));
                sum = x.times(y, lane, sum);
                if 2 * a != k {
                    sum = y.times(x, lane, sum);
                }
            }
            sum
        };
        self.add(value, out);
    }

    /// Adds `factor · Σ |half| |x_left| |x_right|`.
    pub fn add_squares_abs(&self, factor: f64, x: &Forms, out: &mut [f64]) {
        let value = |lane: usize| x.times_abs(x, lane, [0.0; LANE]).map(|sum| factor * sum);
        self.add(value, out);
    }

    /// Adds `factor · Σ |half| (|x_left| |y_right| + |y_left| |x_right|)`.
    pub fn add_products_abs(&self, factor: f64, x: &Forms, y: &Forms, out: &mut [f64]) {
        let value = |lane: usize| {
            let sum = x.times_abs(y, lane, [0.0; LANE]);
            y.times_abs(x, lane, sum).map(|sum| factor * sum)
        };
        self.add(value, out);
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
