//! The tail's rows of the Jacobian, as compressed lists: for each entry its unknown and what it is made of.

use super::Tail;

/// A form with its factor.
type Part = (u32, f64);

/// Entries, row by row. Most are one form with a factor, or the sum of two.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    /// Where each equation's entries begin, and where the last one's end.
    starts: Vec<u32>,
    /// The unknown of each entry.
    unknowns: Vec<u32>,
    /// The first and the second part of each entry; where there is no second one, zero times the number 1.
    parts: Vec<[Part; 2]>,
    /// All further parts, with the entries they belong to.
    more: Vec<(u32, Part)>,
}

impl Rows {
    /// From parts by equation, unknown and form, in this order; the tail's equations begin at `first`.
    pub fn new(parts: &[((u32, u32, u32), f64)], first: usize, equations: usize) -> Self {
        let mut rows = Rows::default();
        let mut last = None;
        let mut count = 0;
        let mut counts = vec![0u32; equations];
        for &((equation, unknown, form), factor) in parts {
            if last != Some((equation, unknown)) {
                last = Some((equation, unknown));
                rows.unknowns.push(unknown);
                rows.parts.push([(Tail::ONE as u32, 0.0); 2]);
                count = 0;
                counts[equation as usize - first] += 1;
            }
            let entry = rows.parts.len() - 1;
            match rows.parts[entry].get_mut(count) {
                Some(part) => *part = (form, factor),
                None => rows.more.push((entry as u32, (form, factor))),
            }
            count += 1;
        }
        rows.starts.push(0);
        let mut end = 0;
        for count in counts {
            end += count;
            rows.starts.push(end);
        }
        rows
    }
}

impl Tail {
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

    /// The unknowns of an equation's row, each with what `values` has for its entry; none for distances.
    #[inline(always)]
    pub fn row_with<'a>(
        &'a self,
        equation: usize,
        values: &'a [f64],
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let row = self.row(equation);
        let unknowns = self.rows.unknowns[row.clone()].iter();
        let pairs = unknowns.zip(&values[row]);
        pairs.map(|(&unknown, &value)| (unknown as usize, value))
    }

    /// The unknown of an entry.
    #[inline(always)]
    pub fn unknown(&self, entry: usize) -> usize {
        self.rows.unknowns[entry] as usize
    }

    /// The values of all entries from those of forms.
    pub fn row_values(&self, forms: &[f64], out: &mut [f64]) {
        self.sum_parts(forms, out, |factor| factor);
    }

    /// Bounds on all entries, and on the terms that they are sums of, from bounds on forms.
    pub fn row_sizes(&self, forms: &[f64], out: &mut [f64]) {
        self.sum_parts(forms, out, f64::abs);
    }

    #[inline(always)]
    fn sum_parts(&self, forms: &[f64], out: &mut [f64], factor: impl Fn(f64) -> f64) {
        let part = |(form, by): Part| factor(by) * forms[form as usize];
        for (&[one, other], out) in self.rows.parts.iter().zip(out.iter_mut()) {
            *out = part(one) + part(other);
        }
        for &(entry, more) in &self.rows.more {
            out[entry as usize] += part(more);
        }
    }
}

#[cfg(test)]
impl Rows {
    /// Multiplies the first part of an entry.
    pub fn spoil(&mut self, entry: Option<usize>, by: f64) {
        if let Some(entry) = entry {
            self.parts[entry][0].1 *= by;
        }
    }
}
