//! Solutions against other arithmetic: another library's dense floats, exact fractions, residues.

use super::scalar::Subtract;
use super::*;
use krawl::interval::{Interval, enclose_rational, hull, point};
use krawl::linalg::rstructure::Ordering;
use krawl::rational::Rational;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// Key unknowns, block sizes, and entries in 1/8 from −8 to 8, diagonally heavy enough to be
/// regular most of the time.
#[derive(Debug, Clone)]
struct Sample {
    keys: usize,
    blocks: Vec<usize>,
    entries: Vec<(usize, usize, i64)>,
    right_side: Vec<i64>,
}

impl Sample {
    fn size(&self) -> usize {
        self.keys + self.blocks.iter().sum::<usize>()
    }

    fn matrix<T: Scalar>(&self, scalar: impl Fn(i64) -> T) -> RMatrix<T> {
        let entries: Vec<(usize, usize, T)> = self
            .entries
            .iter()
            .map(|&(i, j, x)| (i, j, scalar(x)))
            .collect();
        RMatrix::from_entries(self.keys, &self.blocks, &entries).unwrap()
    }

    fn dense<T: Clone>(&self, zero: T, scalar: impl Fn(i64) -> T) -> Vec<Vec<T>> {
        let mut rows = vec![vec![zero; self.size()]; self.size()];
        for &(i, j, x) in &self.entries {
            rows[i][j] = scalar(x);
        }
        rows
    }

    /// The exact solution by Gauss's elimination; `None` where the matrix is singular.
    fn exact(&self) -> Option<Vec<Rational>> {
        let whole = |x: i64| Rational::from_integer(x.into());
        let mut a = self.dense(whole(0), whole);
        let n = a.len();
        for (row, &b) in a.iter_mut().zip(&self.right_side) {
            row.push(whole(b));
        }
        for k in 0..n {
            let pivot = (k..n).find(|&i| !a[i][k].is_zero())?;
            a.swap(k, pivot);
            let upper = a[k].clone();
            for row in &mut a[k + 1..] {
                let factor = &row[k] / &upper[k];
                for j in k..=n {
                    row[j] -= &factor * &upper[j];
                }
            }
        }
        let mut x = vec![whole(0); n];
        for k in (0..n).rev() {
            let rest = (k + 1..n).fold(a[k][n].clone(), |b, j| b - &a[k][j] * &x[j]);
            x[k] = rest / &a[k][k];
        }
        Some(x)
    }
}

fn sample(largest: usize, blocks: usize) -> impl Strategy<Value = Sample> {
    (
        0usize..4,
        prop::collection::vec(1..=largest, 0..=blocks),
        any::<u64>(),
    )
        .prop_filter("something", |(keys, blocks, _)| keys + blocks.len() > 0)
        .prop_map(|(keys, blocks, seed)| random(keys, blocks, seed))
}

fn random(keys: usize, blocks: Vec<usize>, mut seed: u64) -> Sample {
    let mut next = move |n: u64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % n
    };
    let n: usize = blocks.iter().sum();
    let block_of: Vec<usize> = (0..blocks.len())
        .flat_map(|b| std::iter::repeat_n(b, blocks[b]))
        .collect();
    let mut entries = Vec::new();
    for i in 0..n + keys {
        for j in 0..n + keys {
            let in_a = i < n && j >= keys;
            let own = in_a && block_of[i] == block_of[j - keys];
            if in_a && block_of[i] < block_of[j - keys] || in_a && !own && next(3) > 0 {
                continue;
            }
            let mut value = next(17) as i64 - 8;
            // Somewhere off the block's diagonal, so that pivots must be looked for.
            if own
                && i - block_of[..i].partition_point(|&b| b < block_of[i])
                    == (j - keys + 1) % blocks[block_of[i]].max(1)
            {
                value += 20;
            }
            entries.push((i, j, value));
        }
    }
    let right_side = (0..n + keys).map(|_| next(201) as i64 - 100).collect();
    Sample {
        keys,
        blocks,
        entries,
        right_side,
    }
}

proptest! {
    #[test]
    fn floats_agree_with_another_library(sample in sample(20, 6)) {
        let matrix = sample.matrix(|x| x as f64);
        let Ok(mut factors) = Factors::new(&matrix) else { return Err(TestCaseError::reject("singular")) };
        let n = sample.size();
        let dense = sample.dense(0.0, |x| x as f64);
        let dense = DMatrix::from_fn(n, n, |i, j| dense[i][j]);
        let b: Vec<f64> = sample.right_side.iter().map(|&x| x as f64).collect();
        // A is a part of the matrix that may be far worse conditioned than the whole.
        let k = sample.keys;
        let a = dense.view((0, k), (n - k, n - k)).into_owned();
        prop_assume!(condition(&dense) < 1e7 && condition(&a) < 1e7);
        let mut solved = b.clone();
        let again = Factors::solving(&matrix, &mut solved).unwrap();
        let x = factors.solve(&b);
        for (one, other) in x.iter().zip(&solved) {
            prop_assert!((one - other).abs() <= 1e-6 * (1.0 + one.abs()));
        }
        let error = backward_error(&matrix, &x, &b);
        let expected = dense.lu().solve(&DVector::from_column_slice(&b)).unwrap();
        for (got, want) in x.iter().zip(expected.iter()) {
            prop_assert!((got - want).abs() <= 1e-6 * (1.0 + want.abs()), "{got} {want}, backward {error:e}");
        }
        // In memory that was used before.
        let other = again.again(&matrix, None).unwrap().solve(&b);
        prop_assert_eq!(x, other);
    }

    #[test]
    fn enclosures_hold_the_exact_solutions(sample in sample(4, 4), corner in any::<u32>()) {
        let Some(exact) = sample.exact() else { return Err(TestCaseError::reject("singular")) };
        let Ok(mut enclosure) = Enclosure::new(sample.matrix(|x| x as f64)) else { return Err(TestCaseError::reject("singular")) };
        let thin: Vec<Interval> = sample.right_side.iter().map(|&b| point(b as f64)).collect();
        for (x, exact) in enclosure.solve(&thin).iter().zip(&exact) {
            let exact = enclose_rational(exact);
            prop_assert!(exact.subset(*x), "{x:?} {exact:?}");
        }
        // A thick right-hand side: the given one is a member at its boundary.
        let thick: Vec<Interval> = sample.right_side.iter().enumerate().map(|(i, &b)| {
            let (b, other) = (b as f64, b as f64 + if corner >> (i % 32) & 1 == 1 { 1.0 } else { -1.0 });
            hull(b.min(other), b.max(other))
        }).collect();
        for (x, exact) in enclosure.solve(&thick).iter().zip(&exact) {
            prop_assert!(enclose_rational(exact).subset(*x));
        }
    }

    #[test]
    fn residues_are_exact(sample in sample(7, 5)) {
        const M: u64 = 7u64.pow(6);
        type Z = Residue<M>;
        let matrix = sample.matrix(Z::new);
        let b: Vec<Z> = sample.right_side.iter().map(|&b| Z::new(b)).collect();
        let Ok(mut factors) = Factors::new(&matrix) else { return Err(TestCaseError::reject("singular")) };
        let x = factors.solve(&b);
        let mut rest = b.clone();
        matrix.for_each(|row, column, entry| rest[row] = rest[row].minus_product(entry, x[column]));
        prop_assert!(rest.iter().all(|&r| r == Z::zero()));
    }

    #[test]
    fn residues_agree_with_exact_fractions(sample in sample(3, 4)) {
        const P: u64 = 1_000_003;
        let Some(exact) = sample.exact() else { return Err(TestCaseError::reject("singular")) };
        let matrix = sample.matrix(Residue::<P>::new);
        let Ok(mut factors) = Factors::new(&matrix) else { return Err(TestCaseError::reject("singular")) };
        let b: Vec<Residue<P>> = sample.right_side.iter().map(|&b| Residue::new(b)).collect();
        for (x, exact) in factors.solve(&b).iter().zip(&exact) {
            prop_assert_eq!(hensel::residue(exact, P), Some(x.value().into()));
        }
    }

    /// However equations and unknowns are numbered, the ordering makes the same solution of it.
    #[test]
    fn numbering_does_not_matter(sample in sample(4, 5), shift in 0usize..100) {
        const P: u64 = 2_147_483_647;
        let n = sample.size();
        // Another order of rows, and another one of columns.
        let step = |k: usize| (1..).map(|d| d + k).find(|&d| gcd(d, n) == 1).unwrap();
        let (rows, columns) = (step(shift % 7), step(shift % 5 + 3));
        let row = |i: usize| (i * rows + shift) % n;
        let column = |j: usize| (j * columns + 2 * shift) % n;
        let mut equations = vec![Vec::new(); n];
        for &(i, j, _) in &sample.entries {
            equations[row(i)].push(column(j));
        }
        let keys: Vec<usize> = (0..sample.keys).map(column).collect();
        let ignored: Vec<usize> = (n - sample.keys..n).map(row).collect();
        let ordering = Ordering::new(n, &equations, &keys, &ignored).unwrap();
        let mut matrix = RMatrix::zeros(Structure::of(&ordering, &equations));
        for &(i, j, x) in &sample.entries {
            matrix.set(ordering.row_of(row(i)), ordering.column_of(column(j)), Residue::<P>::new(x));
        }
        let given = sample.matrix(Residue::<P>::new);
        let b: Vec<Residue<P>> = sample.right_side.iter().map(|&b| Residue::new(b)).collect();
        let mut moved = b.clone();
        for i in 0..n {
            moved[ordering.row_of(row(i))] = b[i];
        }
        match (Factors::new(&given), Factors::new(&matrix)) {
            (Ok(mut one), Ok(mut other)) => {
                let (x, y) = (one.solve(&b), other.solve(&moved));
                for j in 0..n {
                    prop_assert_eq!(x[j], y[ordering.column_of(column(j))]);
                }
            }
            (one, other) => prop_assert!(one.is_err() && other.is_err()),
        }
    }
}

/// Infinite for a singular matrix; 1 for an empty one.
fn condition(a: &DMatrix<f64>) -> f64 {
    let norm = |a: &DMatrix<f64>| a.row_iter().map(|row| row.abs().sum()).fold(0.0, f64::max);
    match a.clone().try_inverse() {
        None => f64::INFINITY,
        Some(_) if a.is_empty() => 1.0,
        Some(inverse) => norm(&inverse) * norm(a),
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[test]
fn the_smallest_systems() {
    // n = 1 without key unknowns, one key unknown and nothing else, nothing at all.
    let one = RMatrix::from_entries(0, &[1], &[(0, 0, 4.0)]).unwrap();
    assert_eq!(Factors::new(&one).unwrap().solve(&[2.0]), [0.5]);
    let key = RMatrix::from_entries(1, &[], &[(0, 0, 4.0)]).unwrap();
    assert_eq!(Factors::new(&key).unwrap().solve(&[2.0]), [0.5]);
    let mut x = [2.0];
    Factors::solving(&key, &mut x).unwrap();
    assert_eq!(x, [0.5]);
    let nothing = RMatrix::<f64>::from_entries(0, &[], &[]).unwrap();
    assert!(Factors::new(&nothing).unwrap().solve(&[]).is_empty());
}

#[test]
fn entries_come_back_where_they_were_put() {
    // Blocks of one tile, of several, of a part of a lane; some columns left out.
    for (keys, blocks) in [
        (0, vec![1]),
        (2, vec![1, 3, 1]),
        (1, vec![4, 20, 37, 16, 2]),
        (3, vec![]),
    ] {
        let mut sample = random(keys, blocks, 1);
        for (k, entry) in sample.entries.iter_mut().enumerate() {
            entry.2 = k as i64 + 1;
        }
        let matrix = sample.matrix(|x| x as f64);
        let mut seen = Vec::new();
        matrix.for_each(|i, j, x| {
            if x != 0.0 {
                seen.push((i, j, x as i64));
            }
        });
        seen.sort_by_key(|entry| (entry.0, entry.1));
        assert_eq!(seen, sample.entries);
        for (i, j, x) in sample.entries {
            assert_eq!(matrix.get(i, j), x as f64);
        }
    }
}

#[test]
fn large_blocks_and_many_key_unknowns() {
    for (keys, blocks) in [
        (0, vec![100, 50, 3]),
        (10, vec![16, 17, 100, 1, 1]),
        (25, vec![2; 60]),
    ] {
        let sample = random(keys, blocks, 17);
        let matrix = sample.matrix(|x| x as f64);
        let b: Vec<f64> = sample.right_side.iter().map(|&x| x as f64).collect();
        let mut solved = b.clone();
        let mut factors = Factors::solving(&matrix, &mut solved).unwrap();
        assert!(backward_error(&matrix, &solved, &b) < 1e-10);
        assert!(backward_error(&matrix, &factors.solve(&b), &b) < 1e-10);
    }
}

#[test]
fn singular_parts_are_named() {
    let entries = |second: f64, schur: f64| {
        [
            (0, 0, 1.0),
            (1, 0, 1.0),
            (0, 1, 2.0),
            (1, 1, 1.0),
            (1, 2, second),
            (2, 0, schur),
            (2, 2, 1.0),
        ]
    };
    let factor = |second, schur| {
        let matrix = RMatrix::from_entries(1, &[1, 1], &entries(second, schur)).unwrap();
        Factors::new(matrix).map(|_| ())
    };
    assert_eq!(factor(0.0, 0.0), Err(Singular::Block(1)));
    // A⁻¹H = (1/2, 1/2): C − L A⁻¹ H = C − 1/2.
    assert_eq!(factor(1.0, 0.5), Err(Singular::Schur));
    assert_eq!(factor(1.0, 0.0), Ok(()));
    assert_eq!(
        Singular::Block(3).to_string(),
        "diagonal block 3 is singular"
    );
}

#[test]
fn the_wrapping_effect_along_a_chain() {
    // x_{i+1} = b − ½ x_i: true widths stay below 2, and so do those of the enclosure, as the
    // off-diagonal entries are contractions. A rotation by 45° instead grows by √2 per block.
    let width = |a: [[f64; 2]; 2], length: usize| {
        let mut entries = Vec::new();
        for i in 0..length {
            for r in 0..2 {
                entries.push((2 * i + r, 2 * i + r, 1.0));
                for c in 0..2 {
                    if i > 0 {
                        entries.push((2 * i + r, 2 * (i - 1) + c, a[r][c]));
                    }
                }
            }
        }
        let matrix = RMatrix::from_entries(0, &vec![2; length], &entries).unwrap();
        let mut b = vec![point(0.0); 2 * length];
        b[0] = hull(-1.0, 1.0);
        b[1] = hull(-1.0, 1.0);
        Enclosure::new(matrix).unwrap().solve(&b)[2 * length - 1].wid()
    };
    assert!(width([[0.5, 0.0], [0.0, 0.5]], 40) < 1e-10);
    let c = 0.5f64.sqrt();
    let growth = width([[c, -c], [c, c]], 41) / width([[c, -c], [c, c]], 21);
    assert!((growth / 2f64.powi(10) - 1.0).abs() < 1e-6);
}
