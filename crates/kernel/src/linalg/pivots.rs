//! The order of pivots for inverting sparse matrices of one pattern.

use super::matrix::Sparse;

/// Rows of bits: where a matrix under elimination has entries.
#[derive(Debug, Clone, Default)]
struct Bits {
    words: usize,
    data: Vec<u64>,
}

impl Bits {
    fn reset(&mut self, n: usize) {
        self.words = n.div_ceil(64);
        refill(&mut self.data, self.words * n, 0);
    }

    fn row(&self, row: usize) -> &[u64] {
        &self.data[row * self.words..(row + 1) * self.words]
    }

    fn has(&self, row: usize, column: usize) -> bool {
        self.row(row)[column / 64] >> (column % 64) & 1 == 1
    }

    fn insert(&mut self, row: usize, column: usize) {
        self.data[row * self.words + column / 64] |= 1 << (column % 64);
    }

    fn count(&self, row: usize) -> usize {
        self.row(row).iter().map(|w| w.count_ones() as usize).sum()
    }

    /// Adds the entries of `other`'s row, and tells of each that is new.
    fn merge(&mut self, row: usize, other: usize, mut new: impl FnMut(usize)) {
        for w in 0..self.words {
            let more = self.data[other * self.words + w] & !self.data[row * self.words + w];
            self.data[row * self.words + w] |= more;
            ones(w, more).for_each(&mut new);
        }
    }

    fn entries(&self, row: usize) -> impl Iterator<Item = usize> + '_ {
        self.row(row)
            .iter()
            .enumerate()
            .flat_map(|(w, &word)| ones(w, word))
    }

    /// Where the blocks of [`BLOCK`] columns begin in which a row has entries.
    fn blocks(&self, row: usize) -> impl Iterator<Item = usize> + '_ {
        let blocks = |(w, &word): (usize, &u64)| {
            let all = 0..64 / BLOCK;
            let filled = all.filter(move |b| word >> (b * BLOCK) & ((1 << BLOCK) - 1) != 0);
            filled.map(move |b| w * 64 + b * BLOCK)
        };
        let words = self.row(row).iter().enumerate();
        words.filter(|(_, word)| **word != 0).flat_map(blocks)
    }
}

/// The places of the bits of the word of this number.
fn ones(number: usize, word: u64) -> impl Iterator<Item = usize> {
    let mut rest = word;
    std::iter::from_fn(move || {
        (rest != 0).then(|| {
            let bit = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            number * 64 + bit
        })
    })
}

/// Which row is the pivot of which column, in which order, and what each exchange touches.
#[derive(Debug, Clone, Default)]
pub(super) struct Pivots {
    /// The columns, in the order of their exchange.
    pub order: Vec<usize>,
    /// For each column its pivot row.
    pub row_of: Vec<usize>,
    /// For each row the column whose pivot it is.
    pub column_of: Vec<usize>,
    /// For each exchange, where the columns that it changes start in `touched`.
    pub starts: Vec<usize>,
    /// The columns changed, beside the pivot's own.
    pub touched: Vec<u32>,
    /// Whether the permutation that takes columns to their pivot rows is odd.
    pub odd: bool,
}

/// Work space for choosing, kept so that a choice along a path costs no memory.
#[derive(Debug, Clone, Default)]
pub(super) struct Room {
    bits: Bits,
    a: Vec<f64>,
    largest: Vec<f64>,
    count: Vec<usize>,
    seen: Vec<bool>,
    free_rows: Vec<usize>,
    free_columns: Vec<u64>,
}

/// As many copies of a value, in the memory that is there.
fn refill<T: Copy>(vector: &mut Vec<T>, len: usize, value: T) {
    vector.clear();
    vector.resize(len, value);
}

/// Beyond this order the lists of what is touched grow as they need.
const RESERVED: usize = 256;

/// Values are looked at in blocks of so many columns.
const BLOCK: usize = 8;

/// A pivot is at least this fraction of the largest entry that could have been it.
const THRESHOLD: f64 = 0.1;

impl Pivots {
    /// Chooses pivots for a matrix: among those large enough, the one that fills in least
    /// (Markowitz's rule). `None`: it is singular in floating point.
    #[inline(never)]
    pub fn choose(&mut self, pattern: &Sparse, values: &[f64], room: &mut Room) -> Option<()> {
        let n = pattern.columns();
        // Where there is no entry there is a zero.
        let stride = n.next_multiple_of(BLOCK);
        let Room {
            bits,
            a,
            largest,
            count,
            seen,
            free_rows,
            free_columns,
        } = room;
        bits.reset(n);
        refill(a, n * stride, 0.0);
        refill(count, n, 0usize);
        for column in 0..n {
            for (row, value) in pattern.column(values, column) {
                count[column] += usize::from(!bits.has(row, column));
                bits.insert(row, column);
                a[row * stride + column] = value;
            }
        }
        let pivots = self;
        pivots.order.clear();
        pivots.order.reserve(n);
        refill(&mut pivots.row_of, n, usize::MAX);
        refill(&mut pivots.column_of, n, usize::MAX);
        pivots.starts.clear();
        pivots.starts.reserve(n + 1);
        pivots.starts.push(0);
        pivots.touched.clear();
        pivots.touched.reserve(n * n.min(RESERVED));
        refill(largest, stride, 0.0f64);
        free_rows.clear();
        free_rows.extend(0..n);
        refill(free_columns, bits.words, u64::MAX);
        let mut is_known = false;
        for _ in 0..n {
            if !is_known {
                largest.fill(0.0);
                for &row in &*free_rows {
                    for at in bits.blocks(row) {
                        let values: &[f64; BLOCK] = block(a, row * stride + at);
                        let tops: &mut [f64; BLOCK] = block_mut(largest, at);
                        for (top, x) in tops.iter_mut().zip(values) {
                            *top = top.max(x.abs());
                        }
                    }
                }
            }
            let mut best: Option<(usize, f64, usize, usize)> = None;
            for &row in &*free_rows {
                let in_row = bits.count(row);
                for (w, (&word, &free)) in bits.row(row).iter().zip(&*free_columns).enumerate() {
                    for column in ones(w, word & free) {
                        let fill = (in_row - 1) * (count[column] - 1);
                        if best.is_some_and(|(f, ..)| fill > f) {
                            continue;
                        }
                        let size = a[row * stride + column].abs();
                        if size == 0.0 || size < THRESHOLD * largest[column] {
                            continue;
                        }
                        let relative = size / largest[column];
                        if best.is_none_or(|(f, r, ..)| fill < f || fill == f && relative > r) {
                            best = Some((fill, relative, row, column));
                        }
                    }
                }
            }
            let (_, _, p, k) = best?;
            pivots.order.push(k);
            pivots.row_of[k] = p;
            pivots.column_of[p] = k;
            free_rows.retain(|&row| row != p);
            free_columns[k / 64] &= !(1 << (k % 64));
            pivots
                .touched
                .extend(bits.entries(p).filter(|&j| j != k).map(|j| j as u32));
            pivots.starts.push(pivots.touched.len());
            exchange((a, stride), bits, count, (p, k));
            // An exchange changes columns in which the pivot's row has entries, and no others. Where these are many, all are looked at again, row by row.
            is_known = bits.words > 1 && bits.count(p) * BLOCK < n;
            if is_known {
                for column in bits.entries(p) {
                    let rows = free_rows.iter();
                    let sizes = rows.map(|&row| a[row * stride + column].abs());
                    largest[column] = sizes.fold(0.0, f64::max);
                }
            }
        }
        pivots.odd = is_odd(&pivots.row_of, seen);
        Some(())
    }
}

/// Whether a permutation is odd: whether it has an odd number of cycles of even length.
pub fn is_odd(permutation: &[usize], seen: &mut Vec<bool>) -> bool {
    refill(seen, permutation.len(), false);
    let mut odd = false;
    for start in 0..permutation.len() {
        let (mut at, mut length) = (start, 0);
        while !seen[at] {
            seen[at] = true;
            at = permutation[at];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

fn block(values: &[f64], at: usize) -> &[f64; BLOCK] {
    values[at..]
        .first_chunk()
        .expect("rows are padded to whole blocks")
}

fn block_mut(values: &mut [f64], at: usize) -> &mut [f64; BLOCK] {
    values[at..]
        .first_chunk_mut()
        .expect("rows are padded to whole blocks")
}

/// Exchanges the roles of equation `p` and unknown `k`, and keeps the number of entries in each column.
fn exchange(
    (a, stride): (&mut [f64], usize),
    bits: &mut Bits,
    count: &mut [usize],
    (p, k): (usize, usize),
) {
    let inverse = 1.0 / a[p * stride + k];
    for row in (0..count.len()).filter(|&row| row != p) {
        if !bits.has(row, k) {
            continue;
        }
        let factor = a[row * stride + k] * inverse;
        for at in bits.blocks(p) {
            let from = *block(a, p * stride + at);
            for (x, pivots) in block_mut(a, row * stride + at).iter_mut().zip(from) {
                *x -= factor * pivots;
            }
        }
        a[row * stride + k] = factor;
        bits.merge(row, p, |column| count[column] += 1);
    }
    for j in bits.entries(p) {
        a[p * stride + j] *= -inverse;
    }
    a[p * stride + k] = inverse;
}

#[cfg(test)]
mod tests {
    #[test]
    fn permutations_are_even_or_odd() {
        let is_odd = |permutation: [usize; 4]| super::is_odd(&permutation, &mut Vec::new());
        assert!(!is_odd([0, 1, 2, 3]));
        assert!(is_odd([1, 0, 2, 3]));
        assert!(!is_odd([1, 2, 0, 3]));
        assert!(is_odd([1, 2, 3, 0]));
        assert!(!is_odd([1, 0, 3, 2]));
    }
}
