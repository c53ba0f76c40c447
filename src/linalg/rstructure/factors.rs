//! Elimination through the R-structure: factor once, solve many.

use super::kernel::{self, Group, Lane, for_groups};
use super::structure::{Block, Structure};
use super::{RMatrix, Scalar};
use crate::linalg::LANE;
use std::borrow::Borrow;

/// Where elimination found no pivot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Singular {
    /// In a diagonal block of A, counted from 0: with this choice of key unknowns and ignored
    /// equations the system does not fall apart here.
    #[error("diagonal block {0} is singular")]
    Block(usize),
    /// In C − L A⁻¹ H: A is regular, the whole matrix is not.
    #[error("the Schur complement of the key unknowns is singular")]
    Schur,
}

/// A factored R-structured matrix: LU factors of the diagonal blocks and of the k × k Schur
/// complement C − L A⁻¹ H (002, section 5). What is left of the blocks, H and L are read from the
/// matrix, which this holds or borrows.
///
/// With β the numbers stored left of the blocks, t the size of blocks and n = bt the order of A,
/// factoring costs O(n t²) for the blocks, O(k(β + n t)) for K = A⁻¹H (step 2) and O(k²n + k³)
/// for the Schur complement (steps 3 and 5); each solution O(β + n t) for steps 1 and 7 and O(kn)
/// for steps 4 and 6.
#[derive(Debug, Clone)]
pub struct Factors<T, M = RMatrix<T>> {
    matrix: M,
    storage: Storage<T>,
}

#[derive(Debug, Clone)]
struct Storage<T> {
    diagonal: Vec<Lane<T>>,
    inverses: Vec<T>,
    swaps: Vec<u32>,
    schur: Vec<Lane<T>>,
    schur_inverses: Vec<T>,
    schur_swaps: Vec<u32>,
    /// k + 1 vectors.
    vectors: Vec<Lane<T>>,
    /// One column of C.
    key: Vec<Lane<T>>,
}

impl<T: Scalar, M: Borrow<RMatrix<T>>> Factors<T, M> {
    /// Factors a matrix.
    ///
    /// ```
    /// use krawl::linalg::rstructure::{Factors, RMatrix};
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

    /// The same, the solution taking the place of the right-hand side.
    ///
    /// # Panics
    /// If `x` is not as long as the matrix has rows.
    pub fn solve_in_place(&mut self, x: &mut [T]) {
        let matrix = self.matrix.borrow();
        let structure = &*matrix.structure;
        let lanes = structure.lanes;
        let mut vectors = std::mem::take(&mut self.storage.vectors);
        let z = &mut vectors[structure.keys * lanes..];
        if structure.keys > 0 {
            // Step 1; without key unknowns step 7 is all there is.
            pack(structure, x, z);
            self.storage.eliminate(matrix, &mut [&mut *z]);
        }
        self.storage.finish(matrix, x, z);
        self.storage.vectors = vectors;
    }

    fn build(matrix: M, mut storage: Storage<T>, x: Option<&mut [T]>) -> Result<Self, Singular> {
        let m = matrix.borrow();
        storage.factor(m, x.as_deref())?;
        if let Some(x) = x {
            let mut vectors = std::mem::take(&mut storage.vectors);
            let z = &mut vectors[m.structure.keys * m.structure.lanes..];
            storage.finish(m, x, z);
            storage.vectors = vectors;
        }
        Ok(Factors { matrix, storage })
    }
}

/// Spreads R over a vector in which every block starts a new lane.
fn pack<T: Scalar>(structure: &Structure, x: &[T], vector: &mut [Lane<T>]) {
    assert_eq!(x.len(), structure.size(), "one number per row");
    vector.fill([T::zero(); LANE]);
    for block in &structure.blocks {
        let from = &x[block.start..block.start + block.size];
        vector[block.at..].as_flattened_mut()[..block.size].copy_from_slice(from);
    }
}

/// Subtracts what is left of a block from the right-hand sides.
#[inline(always)]
fn reduce<T: Scalar, const R: usize>(matrix: &RMatrix<T>, block: &Block, v: &mut Group<T, R>) {
    if block.columns.is_empty() {
        return;
    }
    for (first, width, range) in block.tiles() {
        let positions = block.positions.iter().map(|&position| position as usize);
        let tile = &matrix.left[range];
        kernel::reduce(tile, width, width, positions, v, block.at + first);
    }
}

impl<T: Scalar> Storage<T> {
    fn default() -> Self {
        Storage {
            diagonal: Vec::new(),
            inverses: Vec::new(),
            swaps: Vec::new(),
            schur: Vec::new(),
            schur_inverses: Vec::new(),
            schur_swaps: Vec::new(),
            vectors: Vec::new(),
            key: Vec::new(),
        }
    }

    /// Steps 2 and 3 of section 5 (and 1, where there is a right-hand side).
    fn factor(&mut self, matrix: &RMatrix<T>, x: Option<&[T]>) -> Result<(), Singular> {
        let structure = &*matrix.structure;
        let (keys, lanes) = (structure.keys, structure.lanes);
        let zero = [T::zero(); LANE];
        self.diagonal.clone_from(&matrix.diagonal);
        self.inverses.resize(structure.order, T::zero());
        self.swaps.resize(structure.order, 0);
        self.schur.clone_from(&matrix.c);
        self.schur_inverses.resize(keys, T::zero());
        self.schur_swaps.resize(keys, 0);
        self.key.resize(structure.key_lanes(), zero);
        self.vectors.clear();
        self.vectors.extend_from_slice(&matrix.h);
        self.vectors.resize((keys + 1) * lanes, zero);
        let mut columns = keys;
        if let Some(x) = x {
            pack(structure, x, &mut self.vectors[keys * lanes..]);
            // Without key unknowns step 7 is all there is.
            columns += usize::from(keys > 0);
        }

        for (index, block) in structure.blocks.iter().enumerate() {
            let rows = block.start..block.start + block.size;
            let start = block.diagonal;
            kernel::factor(
                &mut self.diagonal[start..start + block.lanes * block.size],
                block.lanes,
                &mut self.inverses[rows.clone()],
                &mut self.swaps[rows],
            )
            .ok_or(Singular::Block(index))?;
            let mut vectors = std::mem::take(&mut self.vectors);
            for_groups!(vectors[..columns * lanes], lanes, |group| {
                reduce(matrix, block, &mut group);
                self.solve_block(block, &mut group);
            });
            self.vectors = vectors;
        }

        if keys > 0 {
            let key_lanes = structure.key_lanes();
            for key in 0..keys {
                let k = &self.vectors[key * lanes..(key + 1) * lanes];
                let column = &mut self.schur[key * key_lanes..(key + 1) * key_lanes];
                for (row, entry) in column.as_flattened_mut()[..keys].iter_mut().enumerate() {
                    let l = &matrix.l[row * lanes..(row + 1) * lanes];
                    *entry = kernel::minus_dot(*entry, l, k);
                }
            }
            kernel::factor(
                &mut self.schur,
                key_lanes,
                &mut self.schur_inverses,
                &mut self.schur_swaps,
            )
            .ok_or(Singular::Schur)?;
        }
        Ok(())
    }

    /// Solves `A X = v` for every `v` of the group (steps 1, 2 and 7).
    fn eliminate<const R: usize>(&self, matrix: &RMatrix<T>, v: &mut Group<T, R>) {
        for block in &matrix.structure.blocks {
            reduce(matrix, block, v);
            self.solve_block(block, v);
        }
    }

    /// Solves with a factored diagonal block.
    #[inline(always)]
    fn solve_block<const R: usize>(&self, block: &Block, v: &mut Group<T, R>) {
        let rows = block.start..block.start + block.size;
        let factors = (&self.inverses[rows.clone()], &self.swaps[rows]);
        let diagonal = &self.diagonal[block.diagonal..][..block.lanes * block.size];
        kernel::solve(diagonal, block.lanes, factors, v, block.at);
    }

    /// Steps 4 to 7 of section 5: from (R, S) in `x` and Z = A⁻¹R in `z` to (U, X) in `x`.
    fn finish(&mut self, matrix: &RMatrix<T>, x: &mut [T], z: &mut [Lane<T>]) {
        let structure = &*matrix.structure;
        let (n, keys, lanes) = (structure.order, structure.keys, structure.lanes);
        self.key.fill([T::zero(); LANE]);
        if keys > 0 {
            let key = self.key.as_flattened_mut();
            for (row, u) in key[..keys].iter_mut().enumerate() {
                let l = &matrix.l[row * lanes..(row + 1) * lanes];
                *u = kernel::minus_dot(x[n + row], l, z);
            }
            let factors = (&self.schur_inverses[..], &self.schur_swaps[..]);
            let mut group = [self.key.as_mut_slice()];
            kernel::solve(&self.schur, structure.key_lanes(), factors, &mut group, 0);
        }
        pack(structure, x, z);
        let u = &self.key.as_flattened()[..keys];
        for (key, &u) in u.iter().enumerate() {
            let h = &matrix.h[key * lanes..(key + 1) * lanes];
            for (z, h) in z.iter_mut().zip(h) {
                for q in 0..LANE {
                    z[q] = z[q].minus_product(h[q], u);
                }
            }
        }
        self.eliminate(matrix, &mut [&mut *z]);
        x[..keys].copy_from_slice(u);
        for block in &structure.blocks {
            let from = &z[block.at..].as_flattened()[..block.size];
            x[keys + block.start..][..block.size].copy_from_slice(from);
        }
    }
}
