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

    /// Adds the entries of `other`'s row.
    fn merge(&mut self, row: usize, other: usize) {
        for w in 0..self.words {
            self.data[row * self.words + w] |= self.data[other * self.words + w];
        }
    }

    fn entries(&self, row: usize) -> impl Iterator<Item = usize> + '_ {
        self.row(row).iter().enumerate().flat_map(|(w, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                (rest != 0).then(|| {
                    let bit = rest.trailing_zeros() as usize;
                    rest &= rest - 1;
                    w * 64 + bit
                })
            })
        })
    }
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
}

/// As many copies of a value, in the memory that is there.
fn refill<T: Copy>(vector: &mut Vec<T>, len: usize, value: T) {
    vector.clear();
    vector.resize(len, value);
}

/// Beyond this order the lists of what is touched grow as they need.
const RESERVED: usize = 256;

/// A pivot is at least this fraction of the largest entry that could have been it.
const THRESHOLD: f64 = 0.1;

impl Pivots {
    /// Chooses pivots for a matrix: among those large enough, the one that fills in least
    /// (Markowitz's rule). `None`: it is singular in floating point.
    #[inline(never)]
    pub fn choose(&mut self, pattern: &Sparse, values: &[f64], room: &mut Room) -> Option<()> {
        let n = pattern.columns();
        let Room {
            bits,
            a,
            largest,
            count,
            seen,
        } = room;
        bits.reset(n);
        refill(a, n * n, 0.0);
        for column in 0..n {
            for (row, value) in pattern.column(values, column) {
                bits.insert(row, column);
                a[row * n + column] = value;
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
        refill(largest, n, 0.0f64);
        refill(count, n, 0usize);
        for _ in 0..n {
            largest.fill(0.0);
            count.fill(0);
            let free_rows = || (0..n).filter(|&row| pivots.column_of[row] == usize::MAX);
            for row in 0..n {
                let free = pivots.column_of[row] == usize::MAX;
                for column in bits.entries(row) {
                    count[column] += 1;
                    if free {
                        largest[column] = largest[column].max(a[row * n + column].abs());
                    }
                }
            }
            let mut best: Option<(usize, f64, usize, usize)> = None;
            for row in free_rows() {
                let in_row = bits.count(row);
                for column in bits.entries(row) {
                    let size = a[row * n + column].abs();
                    if pivots.row_of[column] != usize::MAX
                        || size == 0.0
                        || size < THRESHOLD * largest[column]
                    {
                        continue;
                    }
                    let fill = (in_row - 1) * (count[column] - 1);
                    let relative = size / largest[column];
                    if best.is_none_or(|(f, r, ..)| fill < f || fill == f && relative > r) {
                        best = Some((fill, relative, row, column));
                    }
                }
            }
            let (_, _, p, k) = best?;
            pivots.order.push(k);
            pivots.row_of[k] = p;
            pivots.column_of[p] = k;
            pivots
                .touched
                .extend(bits.entries(p).filter(|&j| j != k).map(|j| j as u32));
            pivots.starts.push(pivots.touched.len());
            exchange(a, bits, n, p, k);
        }
        pivots.odd = is_odd(&pivots.row_of, seen);
        Some(())
    }
}

/// Whether a permutation is odd: whether it has an odd number of cycles of even length.
fn is_odd(permutation: &[usize], seen: &mut Vec<bool>) -> bool {
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

/// Exchanges the roles of equation `p` and unknown `k`.
fn exchange(a: &mut [f64], bits: &mut Bits, n: usize, p: usize, k: usize) {
    let inverse = 1.0 / a[p * n + k];
    for row in (0..n).filter(|&row| row != p) {
        if !bits.has(row, k) {
            continue;
        }
        let factor = a[row * n + k] * inverse;
        for j in bits.entries(p) {
            a[row * n + j] -= factor * a[p * n + j];
        }
        a[row * n + k] = factor;
        bits.merge(row, p);
    }
    for j in bits.entries(p) {
        a[p * n + j] *= -inverse;
    }
    a[p * n + k] = inverse;
}
