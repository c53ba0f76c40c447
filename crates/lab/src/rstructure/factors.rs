//! R-structured matrices that are stored as such: factor once, solve many.

use super::kernel;
use super::scalar::Subtract;
use super::structure::{Block, C, DIAGONAL, H, L, LEFT, Structure};
use super::{RMatrix, Scalar};
use krawl::linalg::LANE;
use krawl::linalg::rstructure::{Blocks, Elimination, Lane, MAX_KEYS, Row, Solves, add, zeros};
use std::borrow::Borrow;

/// Why a matrix could not be factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Singular {
    /// No pivot in a diagonal block of A, counted from 0: with this choice of key unknowns and ignored
    /// equations the system does not fall apart here.
    #[error("diagonal block {0} is singular")]
    Block(usize),
    /// None in C − L A⁻¹ H: A is regular, the whole matrix is not.
    #[error("the Schur complement of the key unknowns is singular")]
    Schur,
    /// So many key unknowns, and how many there may be.
    #[error("{0} key unknowns are more than the {1} there is room for")]
    TooManyKeys(usize, usize),
}

/// A factored R-structured matrix: LU factors of the diagonal blocks, K = −A⁻¹H, and the inverse of the k × k
/// Schur complement C − L A⁻¹ H (002, section 5). What is left of the blocks, and L, are read from the matrix,
/// which this holds or borrows. There may be 31 key unknowns.
///
/// With β the numbers stored left of the blocks, t the size of blocks and n = bt the order of A,
/// factoring costs O(n t²) for the blocks, O(k(β + n t)) for K (step 2) and O(k²n + k³)
/// for the Schur complement (steps 3 and 5); each solution O(β + n t) for step 1 and O(kn)
/// for steps 4, 6 and 7, which are a product with K.
#[derive(Debug, Clone)]
pub struct Factors<T, M = RMatrix<T>> {
    matrix: M,
    storage: Storage<T>,
}

#[derive(Debug, Clone)]
struct Storage<T> {
    diagonal: Diagonal<T>,
    elimination: Elimination<T>,
    /// A right-hand side.
    right: Vec<T>,
}

/// LU factors of the diagonal blocks, see [`kernel::factor`].
#[derive(Debug, Clone)]
struct Diagonal<T> {
    factors: Vec<Lane<T>>,
    inverses: Vec<T>,
    swaps: Vec<u32>,
}

impl<T: Scalar, M: Borrow<RMatrix<T>>> Factors<T, M> {
    /// Factors a matrix.
    ///
    /// ```
    /// use krawl_lab::rstructure::{Factors, RMatrix};
    /// // | 1  2  0 |   u    3
    /// // | 0  1  4 | · x₁ = 5      k = 1, blocks of size 1
    /// // | 3  1  1 |   x₂   5
    /// # let mut entries = vec![(0, 0, 1.0), (0, 1, 2.0)];
    /// # entries.extend([(1, 1, 1.0), (1, 2, 4.0), (2, 0, 3.0), (2, 1, 1.0), (2, 2, 1.0)]);
    /// let matrix = RMatrix::from_entries(1, &[1, 1], &entries).unwrap();
    /// let mut factors = Factors::new(&matrix).unwrap();
    /// assert_eq!(factors.solve(&[3.0, 5.0, 5.0]), [1.0, 1.0, 1.0]);
    /// assert_eq!(factors.solve(&[2.0, 1.0, 1.0]), [0.0, 1.0, 0.0]);
    /// ```
    pub fn new(matrix: M) -> Result<Self, Singular> {
        Self::build(matrix, Storage::default(), None)
    }

    /// Factors a matrix and solves one system with it, as a Newton iteration does. `x` holds the
    /// right-hand side (R, S) before and the solution (U, X) after. A is read once for the key
    /// unknowns' columns and the right-hand side together.
    pub fn solving(matrix: M, x: &mut [T]) -> Result<Self, Singular> {
        Self::build(matrix, Storage::default(), Some(x))
    }

    /// Factors another matrix, solving like [`solving`](Factors::solving) if there is a
    /// right-hand side, in the memory that this used.
    pub fn again(self, matrix: M, x: Option<&mut [T]>) -> Result<Self, Singular> {
        Self::build(matrix, self.storage, x)
    }

    /// The matrix.
    pub fn matrix(&self) -> &RMatrix<T> {
        self.matrix.borrow()
    }

    /// Solves for a right-hand side, the equations of A first, then the ignored ones (R, S). In
    /// the solution the key unknowns come first, then A's (U, X).
    ///
    /// # Panics
    /// If the right-hand side is not as long as the matrix has rows.
    pub fn solve(&mut self, right_side: &[T]) -> Vec<T> {
        let mut x = right_side.to_vec();
        self.solve_in_place(&mut x);
        x
    }

    /// Solves in place: `x` is the right-hand side, the equations of A first, then the ignored ones (R, S); it
    /// becomes the solution, in which the key unknowns come first, then A's (U, X).
    ///
    /// # Panics
    /// If `x` is not as long as the matrix has rows.
    pub fn solve_in_place(&mut self, x: &mut [T]) {
        let Storage {
            diagonal,
            elimination,
            right,
        } = &mut self.storage;
        let matrix = self.matrix.borrow();
        assert_eq!(x.len(), matrix.structure.size(), "one number per row");
        right.clear();
        right.extend_from_slice(x);
        let whole = Whole {
            matrix,
            diagonal,
            right: None,
        };
        elimination.solve(&whole, right, x);
    }

    fn build(matrix: M, mut storage: Storage<T>, x: Option<&mut [T]>) -> Result<Self, Singular> {
        let m = matrix.borrow();
        if let Some(x) = &x {
            assert_eq!(x.len(), m.structure.size(), "one number per row");
        }
        storage.diagonal.factor(m)?;
        let whole = Whole {
            matrix: m,
            diagonal: &storage.diagonal,
            right: x.as_deref(),
        };
        let (keys, right_sides) = (m.structure.keys, usize::from(x.is_some()));
        if keys + right_sides > MAX_KEYS {
            return Err(Singular::TooManyKeys(keys, MAX_KEYS - right_sides));
        }
        let elimination = &mut storage.elimination;
        let made = elimination.make(&whole, right_sides);
        made.map_err(|_| Singular::Schur)?;
        if let Some(x) = x {
            elimination.solution(keys, x);
        }
        Ok(Factors { matrix, storage })
    }
}

impl<T> Default for Storage<T> {
    fn default() -> Self {
        Storage {
            diagonal: Diagonal {
                factors: Vec::new(),
                inverses: Vec::new(),
                swaps: Vec::new(),
            },
            elimination: Elimination::default(),
            right: Vec::new(),
        }
    }
}

/// A block's factors, and its pivots: their inverses, and the row that each row was exchanged with.
type OfBlock<'a, T> = (&'a [Lane<T>], (&'a [T], &'a [u32]));

impl<T: Scalar> Diagonal<T> {
    /// Factors the diagonal blocks.
    fn factor(&mut self, matrix: &RMatrix<T>) -> Result<(), Singular> {
        let structure = &*matrix.structure;
        self.factors.clone_from(&matrix.parts[DIAGONAL]);
        self.inverses.resize(structure.order, T::zero());
        self.swaps.resize(structure.order, 0);
        for (index, block) in structure.blocks.iter().enumerate() {
            let rows = block.start..block.start + block.size;
            let start = block.diagonal;
            kernel::factor(
                &mut self.factors[start..start + block.lanes * block.size],
                block.lanes,
                &mut self.inverses[rows.clone()],
                &mut self.swaps[rows],
            )
            .ok_or(Singular::Block(index))?;
        }
        Ok(())
    }

    /// A block's factors, the inverses of its pivots, and its exchanges of rows.
    fn of(&self, block: &Block) -> OfBlock<'_, T> {
        let rows = block.start..block.start + block.size;
        let factors = &self.factors[block.diagonal..][..block.lanes * block.size];
        (factors, (&self.inverses[rows.clone()], &self.swaps[rows]))
    }
}

/// A matrix with its diagonal blocks factored. The key unknowns come first, then A's.
struct Whole<'a, T> {
    matrix: &'a RMatrix<T>,
    diagonal: &'a Diagonal<T>,
    /// A right-hand side that is eliminated with: a column more, with a minus.
    right: Option<&'a [T]>,
}

impl<T: Scalar> Whole<'_, T> {
    fn structure(&self) -> &Structure {
        &self.matrix.structure
    }

    /// Solves A's equations block by block, for rows that begin as `begin` sets them: that of a block with this number in it.
    #[inline(always)]
    fn through_blocks<const W: usize>(
        &self,
        rows: &mut [Row<W, T>],
        begin: impl Fn(&Block, usize, &mut Row<W, T>),
    ) {
        let keys = self.structure().keys;
        for block in &self.structure().blocks {
            let (done, own) = rows.split_at_mut(keys + block.start);
            let own = &mut own[..block.size];
            for (r, row) in own.iter_mut().enumerate() {
                begin(block, r, row);
            }
            for (first, width, range) in block.tiles() {
                let panel = self.matrix.parts[LEFT][range].as_flattened();
                let done = block.columns.iter().map(|&c| &done[keys + c as usize]);
                let from = first * LANE;
                let to = block.size.min(from + width * LANE);
                kernel::reduce_rows(panel, width * LANE, done, &mut own[from..to]);
            }
            let (factors, pivots) = self.diagonal.of(block);
            kernel::solve_rows(factors, block.lanes, pivots, own);
        }
    }

    /// A row of L.
    fn row_of_l(&self, at: usize) -> &[Lane<T>] {
        let lanes = self.structure().lanes;
        &self.matrix.parts[L][at * lanes..(at + 1) * lanes]
    }
}

impl<T: Scalar> Blocks<T> for Whole<'_, T> {
    fn keys(&self) -> usize {
        self.structure().keys
    }

    fn unknowns(&self) -> usize {
        self.structure().size()
    }

    fn key(&self, at: usize) -> usize {
        at
    }

    fn substitute<const W: usize>(&self, rows: &mut [Row<W, T>]) {
        let (keys, lanes) = (self.keys(), self.structure().lanes);
        self.through_blocks(rows, |block, r, row| {
            let row = row.as_flattened_mut();
            for (key, x) in row[..keys].iter_mut().enumerate() {
                let h = &self.matrix.parts[H][key * lanes + block.at..].as_flattened()[r];
                *x = h.negated();
            }
            if let Some(right) = self.right {
                row[keys] = right[block.start + r];
            }
        });
    }

    fn ignored_row<const W: usize>(&self, at: usize, rows: &[Row<W, T>]) -> Row<W, T> {
        let (keys, structure) = (self.keys(), self.structure());
        // Four sums, so that one need not wait for the other.
        let mut sums = [zeros::<W, T>(); LANE];
        let l = self.row_of_l(at);
        for block in &structure.blocks {
            let of_block = &rows[keys + block.start..][..block.size];
            for (lane, rows) in l[block.at..].iter().zip(of_block.chunks(LANE)) {
                for ((sum, &factor), row) in sums.iter_mut().zip(lane).zip(rows) {
                    add(sum, factor, row);
                }
            }
        }
        let [mut sum, rest @ ..] = sums;
        for rest in &rest {
            add(&mut sum, T::one(), rest);
        }
        let flat = sum.as_flattened_mut();
        let c = self.matrix.parts[C].as_flattened();
        for (key, x) in flat[..keys].iter_mut().enumerate() {
            *x = x.plus(c[key * structure.key_lanes() * LANE + at]);
        }
        if let Some(right) = self.right {
            flat[keys] = flat[keys].minus_product(right[structure.order + at], T::one());
        }
        sum
    }
}

impl<T: Scalar> Solves<T> for Whole<'_, T> {
    fn substitute_one(&self, f: &[T], x: &mut [T]) {
        let mut rows = vec![zeros::<1, T>(); x.len()];
        self.through_blocks(&mut rows, |block, r, row| row[0][0] = f[block.start + r]);
        let keys = self.keys();
        for (x, row) in x[keys..].iter_mut().zip(&rows[keys..]) {
            *x = row[0][0];
        }
    }

    fn ignored_rest(&self, at: usize, f: &[T], x: &[T]) -> T {
        let structure = self.structure();
        let l = self.row_of_l(at);
        let mut rests = [T::zero(); LANE];
        for block in &structure.blocks {
            let x = &x[structure.keys + block.start..][..block.size];
            for (lane, x) in l[block.at..].iter().zip(x.chunks(LANE)) {
                for ((rest, &l), &x) in rests.iter_mut().zip(lane).zip(x) {
                    *rest = rest.minus_product(l, x);
                }
            }
        }
        let rest = rests.into_iter().fold(T::zero(), T::plus);
        f[structure.order + at].plus(rest)
    }
}

/// The most key unknowns where a right-hand side is eliminated with.
const _: () = assert!(MAX_KEYS - 1 == 31);
