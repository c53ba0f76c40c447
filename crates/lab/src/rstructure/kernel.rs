//! Elimination in one block: columns padded to whole lanes, worked on a few at a time.
//!
//! Everything here comes down to [`reduce`], which subtracts a product from a tile of
//! [`CHUNK`] lanes by [`GROUP`] columns. Tile sizes are constants of the kernels, so that the
//! tile stays in registers while the sums run.

use super::Scalar;
use super::scalar::Subtract;
use krawl::linalg::LANE;
use krawl::linalg::rstructure::{Lane, Row};

/// Lanes in a tile.
pub(super) const CHUNK: usize = 4;
/// Columns in a tile: with four lanes, twelve of the sixteen AVX registers.
const GROUP: usize = 3;
// The sizes that `reduce` and `factor` choose from.
const _: () = assert!(CHUNK == 4 && GROUP == 3);

/// A few columns to work on at a time. All have the same length.
type Group<'a, T, const R: usize> = [&'a mut [Lane<T>]; R];

/// Takes the first `R` columns of `lanes` each.
#[inline(always)]
fn group<T, const R: usize>(data: &mut [Lane<T>], lanes: usize) -> Group<'_, T, R> {
    let mut columns = data.chunks_exact_mut(lanes);
    std::array::from_fn(|_| columns.next().expect("R columns"))
}

/// `v[at ..] −= Σ_j panel_j v[j]` in a tile of `width` lanes, for every column `v` and its numbers j before `count`.
/// Column j of the panel starts at lane `j * stride`.
#[inline(always)]
fn reduce<T: Scalar, const R: usize>(
    panel: &[Lane<T>],
    stride: usize,
    width: usize,
    count: usize,
    v: &mut Group<T, R>,
    at: usize,
) {
    match width {
        1 => tile::<T, 1, R>(panel, stride, count, v, at),
        2 => tile::<T, 2, R>(panel, stride, count, v, at),
        3 => tile::<T, 3, R>(panel, stride, count, v, at),
        _ => tile::<T, 4, R>(panel, stride, count, v, at),
    }
}

#[inline(always)]
fn tile<T: Scalar, const L: usize, const R: usize>(
    panel: &[Lane<T>],
    stride: usize,
    count: usize,
    v: &mut Group<T, R>,
    at: usize,
) {
    let mut sums: [[Lane<T>; L]; R] =
        std::array::from_fn(|r| *v[r][at..].first_chunk().expect("L lanes"));
    for (j, column) in panel.chunks(stride).take(count).enumerate() {
        let a: &[Lane<T>; L] = column.first_chunk().expect("L lanes");
        for r in 0..R {
            let x = v[r].as_flattened()[j];
            for l in 0..L {
                for q in 0..LANE {
                    sums[r][l][q] = sums[r][l][q].minus_product(a[l][q], x);
                }
            }
        }
    }
    for r in 0..R {
        v[r][at..at + L].copy_from_slice(&sums[r]);
    }
}

/// `v −= column x` in rows `from .. to * LANE`.
#[inline(always)]
fn subtract<T: Scalar>(column: &[Lane<T>], x: T, v: &mut [Lane<T>], from: usize, to: usize) {
    let (first, part) = (from / LANE, from % LANE);
    if part > 0 {
        for q in part..LANE {
            v[first][q] = v[first][q].minus_product(column[first][q], x);
        }
    }
    for l in from.div_ceil(LANE)..to {
        for q in 0..LANE {
            v[l][q] = v[l][q].minus_product(column[l][q], x);
        }
    }
}

/// Eliminates with the first `count` columns of a block's unit lower factor in each column of `v`.
/// Rows beyond `count` are reduced by them.
#[inline]
fn forward<T: Scalar, const R: usize>(
    lower: &[Lane<T>],
    lanes: usize,
    count: usize,
    v: &mut Group<T, R>,
) {
    for chunk in (0..lanes).step_by(CHUNK) {
        let width = CHUNK.min(lanes - chunk);
        let before = count.min(chunk * LANE);
        if before > 0 {
            reduce(&lower[chunk..], lanes, width, before, v, chunk);
        }
        for k in before..count.min((chunk + width) * LANE) {
            let column = &lower[k * lanes..(k + 1) * lanes];
            for v in v.iter_mut() {
                let x = v.as_flattened()[k];
                subtract(column, x, v, k + 1, chunk + width);
            }
        }
    }
}

/// Factors a block of order `inverses.len()` in place, P A = L U, with partial pivoting: L below
/// the diagonal (its own is 1), U above, the inverses of its diagonal beside, and in `swaps` the
/// row that each row was exchanged with. `None`: there was a column without a pivot.
///
/// Column groups from left to right, each reduced by all columns before it, so that a tile is
/// written once ("left-looking"; Golub and Van Loan, Matrix Computations, 4th ed., 3.2.11).
pub(super) fn factor<T: Scalar>(
    block: &mut [Lane<T>],
    lanes: usize,
    inverses: &mut [T],
    swaps: &mut [u32],
) -> Option<()> {
    let t = inverses.len();
    for from in (0..t).step_by(GROUP) {
        let width = GROUP.min(t - from);
        let (done, rest) = block.split_at_mut(from * lanes);
        match width {
            1 => forward(done, lanes, from, &mut group::<_, 1>(rest, lanes)),
            2 => forward(done, lanes, from, &mut group::<_, 2>(rest, lanes)),
            _ => forward(done, lanes, from, &mut group::<_, 3>(rest, lanes)),
        }
        for j in from..from + width {
            let column = &block.as_flattened()[j * lanes * LANE..][..t];
            let mut best = (0.0, j);
            for (row, x) in column.iter().enumerate().skip(j) {
                let size = x.pivot_size();
                if size > best.0 {
                    best = (size, row);
                }
            }
            if best.0 <= 0.0 {
                return None;
            }
            swaps[j] = best.1 as u32;
            if best.1 != j {
                for column in block.chunks_exact_mut(lanes) {
                    column.as_flattened_mut().swap(j, best.1);
                }
            }
            let (left, right) = block.split_at_mut((j + 1) * lanes);
            let pivot = &mut left[j * lanes..];
            inverses[j] = pivot.as_flattened()[j].inverse();
            for x in &mut pivot.as_flattened_mut()[j + 1..] {
                *x = x.times(inverses[j]);
            }
            for column in right.chunks_exact_mut(lanes).take(from + width - j - 1) {
                let x = column.as_flattened()[j];
                subtract(pivot, x, column, j + 1, lanes);
            }
        }
    }
    Some(())
}

/// So many rows of W lanes are worked on at a time: eight registers, as many as hide how long a product takes.
const fn strip(width: usize) -> usize {
    if width < 8 { 8 / width } else { 1 }
}

/// `own −= Σ_j panel_j done_j`, row by row, column j of the panel beginning at number `j * stride`: that of the
/// first of these rows.
#[inline(always)]
pub(super) fn reduce_rows<'a, T: Scalar, const W: usize>(
    panel: &[T],
    stride: usize,
    done: impl Iterator<Item = &'a Row<W, T>> + Clone,
    own: &mut [Row<W, T>],
) {
    let tall = strip(W);
    for (index, rows) in own.chunks_mut(tall).enumerate() {
        let panel = panel.get(index * tall..).unwrap_or_default();
        match (W, rows.len()) {
            (1, 8) => strip_of::<T, W, 8>(panel, stride, done.clone(), rows),
            (2, 4) => strip_of::<T, W, 4>(panel, stride, done.clone(), rows),
            (4, 2) => strip_of::<T, W, 2>(panel, stride, done.clone(), rows),
            _ => {
                for (r, row) in rows.chunks_mut(1).enumerate() {
                    let panel = panel.get(r..).unwrap_or_default();
                    strip_of::<T, W, 1>(panel, stride, done.clone(), row);
                }
            }
        }
    }
}

#[inline(always)]
fn strip_of<'a, T: Scalar, const W: usize, const R: usize>(
    panel: &[T],
    stride: usize,
    done: impl Iterator<Item = &'a Row<W, T>>,
    own: &mut [Row<W, T>],
) {
    let own: &mut [Row<W, T>; R] = own.try_into().expect("R rows");
    let mut sums = *own;
    for (column, x) in panel.chunks(stride).zip(done) {
        let a: &[T; R] = column.first_chunk().expect("R rows");
        for r in 0..R {
            for w in 0..W {
                for l in 0..LANE {
                    sums[r][w][l] = sums[r][w][l].minus_product(a[r], x[w][l]);
                }
            }
        }
    }
    *own = sums;
}

/// Solves with a factored block for rows: one for each unknown of the block, with the numbers of several
/// right-hand sides.
#[inline]
pub(super) fn solve_rows<T: Scalar, const W: usize>(
    block: &[Lane<T>],
    lanes: usize,
    (inverses, swaps): (&[T], &[u32]),
    v: &mut [Row<W, T>],
) {
    let (t, stride, tall) = (inverses.len(), lanes * LANE, strip(W));
    let factors = block.as_flattened();
    for (row, &other) in swaps.iter().enumerate() {
        v.swap(row, other as usize);
    }
    let subtract = |sum: &mut Row<W, T>, factor: T, row: &Row<W, T>| {
        for w in 0..W {
            for l in 0..LANE {
                sum[w][l] = sum[w][l].minus_product(factor, row[w][l]);
            }
        }
    };
    for from in (0..t).step_by(tall) {
        let to = t.min(from + tall);
        let (done, own) = v.split_at_mut(from);
        let own = &mut own[..to - from];
        reduce_rows(&factors[from..], stride, done.iter(), own);
        for k in from..to {
            let (before, after) = own.split_at_mut(k - from + 1);
            for (r, row) in after.iter_mut().enumerate() {
                subtract(row, factors[k * stride + k + 1 + r], &before[k - from]);
            }
        }
    }
    for from in (0..t).step_by(tall).rev() {
        let to = t.min(from + tall);
        let (own, done) = v.split_at_mut(to);
        let own = &mut own[from..];
        let panel = factors.get(to * stride + from..).unwrap_or_default();
        reduce_rows(panel, stride, done.iter(), own);
        for k in (from..to).rev() {
            let (before, after) = own.split_at_mut(k - from);
            let row = &mut after[0];
            for x in row.as_flattened_mut() {
                *x = x.times(inverses[k]);
            }
            for (r, other) in before.iter_mut().enumerate() {
                subtract(other, factors[k * stride + from + r], row);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rstructure::Residue;

    fn rows_are_solved<T: Scalar, const W: usize>(
        block: &[Lane<T>],
        lanes: usize,
        factors: (&[T], &[u32]),
        entry: impl Fn(usize, usize) -> T,
        x: &[T],
    ) {
        let t = x.len();
        let mut rows = vec![[[T::zero(); LANE]; W]; t];
        for (i, row) in rows.iter_mut().enumerate() {
            let product = |column: usize| {
                let x = |j: usize| x[(j + column) % t];
                (0..t).fold(T::zero(), |sum, j| sum.plus_product(entry(i, j), x(j)))
            };
            (row[0][0], row[W - 1][3]) = (product(0), product(1));
        }
        solve_rows(block, lanes, factors, &mut rows);
        for (i, row) in rows.iter().enumerate() {
            assert_eq!(row[0][0], x[i], "order {t}, {W} lanes");
            assert_eq!(row[W - 1][3], x[(i + 1) % t], "order {t}, {W} lanes");
            assert_eq!(row[0][1], T::zero());
        }
    }

    #[test]
    fn factors_need_pivoting_and_find_it() {
        // Zeros on the diagonal, every size up to three tiles.
        type Z = Residue<1_000_003>;
        for t in [1usize, 2, 3, 4, 5, 15, 16, 17, 33, 47, 48] {
            let lanes = t.div_ceil(LANE);
            let mut block = vec![[Z::zero(); LANE]; lanes * t];
            let entry = |i: usize, j: usize| {
                let x = (i * i * 31 + j * 17 + i * j * j * 7) % 1009;
                Z::new(if i == j && t > 1 { 0 } else { x as i64 + 1 })
            };
            for (j, column) in block.chunks_exact_mut(lanes).enumerate() {
                for i in 0..t {
                    column.as_flattened_mut()[i] = entry(i, j);
                }
            }
            let mut inverses = vec![Z::zero(); t];
            let mut swaps = vec![0; t];
            factor(&mut block, lanes, &mut inverses, &mut swaps).unwrap();
            let x: Vec<Z> = (0..t).map(|i| Z::new(i as i64 * 5 - 3)).collect();
            // Rows of several right-hand sides, of which two are not zero.
            rows_are_solved::<Z, 1>(&block, lanes, (&inverses, &swaps), entry, &x);
            rows_are_solved::<Z, 2>(&block, lanes, (&inverses, &swaps), entry, &x);
            rows_are_solved::<Z, 4>(&block, lanes, (&inverses, &swaps), entry, &x);
            rows_are_solved::<Z, 8>(&block, lanes, (&inverses, &swaps), entry, &x);
        }
    }
}
