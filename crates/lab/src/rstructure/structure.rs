//! Which entries an R-structured matrix has, and where they are stored.

use super::kernel::CHUNK;
use krawl::linalg::LANE;
use krawl::linalg::rstructure::Ordering;
use std::sync::Arc;

/// The *R-structure* that matrices share (002, section 5): the number k of key unknowns, the
/// sizes of A's diagonal blocks, and the columns that each block row has left of its block.
///
/// Rows are numbered 0 … n − 1 for A's (the equations that are used) and n … n + k − 1 for the
/// ignored equations; columns 0 … k − 1 for the key unknowns and k … n + k − 1 for A's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Structure {
    pub(super) keys: usize,
    /// The order n of A.
    pub(super) order: usize,
    pub(super) blocks: Vec<Block>,
    /// Lanes of a vector in which every block starts a new lane.
    pub(super) lanes: usize,
    /// For each of A's rows or columns its block.
    pub(super) block_of: Vec<u32>,
    /// Lanes of all diagonal blocks, and of all that is left of them.
    pub(super) diagonal_lanes: usize,
    pub(super) left_lanes: usize,
}

/// A diagonal block and what is left of it in its rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Block {
    /// The first of A's rows (and columns) in it.
    pub start: usize,
    pub size: usize,
    /// Its first lane in a vector, and its lanes there or in a column of its own.
    pub at: usize,
    pub lanes: usize,
    /// A's columns that have entries left of the block, in order. Such a column is stored with
    /// all rows of the block.
    pub columns: Vec<u32>,
    /// The first lane of the diagonal block, column by column, and of what is left of it.
    pub diagonal: usize,
    pub left: usize,
}

/// Why entries do not form an R-structure.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StructureError {
    /// A block without rows.
    #[error("diagonal block {0} is empty")]
    EmptyBlock(usize),
    /// A row or column that there is none of.
    #[error("entry ({0}, {1}) is outside of the matrix")]
    Outside(usize, usize),
    /// An entry of A to the right of its row's diagonal block.
    #[error("entry ({0}, {1}) is above diagonal block {2}")]
    Above(usize, usize, usize),
}

/// The parts in which a matrix is stored: columns of H, rows of L, columns of C, the diagonal blocks column by column, and what is left of these
/// (see [`Block::tiles`]).
pub(super) const H: usize = 0;
pub(super) const L: usize = 1;
pub(super) const C: usize = 2;
pub(super) const DIAGONAL: usize = 3;
pub(super) const LEFT: usize = 4;

impl Structure {
    /// The structure with `keys` key unknowns, diagonal blocks of the given sizes and the given
    /// entries (row, column) left of them. Other entries may be listed too: H, C, L and the
    /// diagonal blocks are stored whole.
    ///
    /// ```
    /// use krawl_lab::rstructure::Structure;
    /// let figure_1 = Structure::new(1, &[2, 2, 2], [(3, 1), (3, 2), (4, 1), (4, 2), (5, 3), (5, 4)]);
    /// assert_eq!(figure_1.unwrap().size(), 7);
    /// ```
    pub fn new(
        keys: usize,
        blocks: &[usize],
        entries: impl IntoIterator<Item = (usize, usize)>,
    ) -> Result<Self, StructureError> {
        if let Some(empty) = blocks.iter().position(|&size| size == 0) {
            return Err(StructureError::EmptyBlock(empty));
        }
        let mut structure = Structure {
            keys,
            order: 0,
            blocks: Vec::with_capacity(blocks.len()),
            lanes: 0,
            block_of: Vec::new(),
            diagonal_lanes: 0,
            left_lanes: 0,
        };
        for (index, &size) in blocks.iter().enumerate() {
            let lanes = size.div_ceil(LANE);
            structure.blocks.push(Block {
                start: structure.order,
                size,
                at: structure.lanes,
                lanes,
                columns: Vec::new(),
                diagonal: structure.diagonal_lanes,
                left: 0,
            });
            structure
                .block_of
                .resize(structure.order + size, index as u32);
            structure.order += size;
            structure.lanes += lanes;
            structure.diagonal_lanes += lanes * size;
        }
        let size = structure.size();
        for (row, column) in entries {
            if row >= size || column >= size {
                return Err(StructureError::Outside(row, column));
            }
            if row >= structure.order || column < keys {
                continue;
            }
            let index = structure.block_of[row] as usize;
            let block = &mut structure.blocks[index];
            if column - keys >= block.start + block.size {
                return Err(StructureError::Above(row, column, index));
            }
            if column - keys < block.start {
                block.columns.push((column - keys) as u32);
            }
        }
        for block in &mut structure.blocks {
            block.columns.sort_unstable();
            block.columns.dedup();
            block.left = structure.left_lanes;
            structure.left_lanes += block.lanes * block.columns.len();
        }
        Ok(structure)
    }

    /// The structure of matrices with the pattern of equations, each given by the unknowns that occur in it,
    /// in their order.
    ///
    /// # Panics
    /// If the equations are others than those that were ordered.
    pub fn of(ordering: &Ordering, equations: &[Vec<usize>]) -> Arc<Self> {
        let entries = equations.iter().enumerate().flat_map(|(e, unknowns)| {
            let column_of = |&u| ordering.column_of(u);
            unknowns
                .iter()
                .map(column_of)
                .map(move |column| (ordering.row_of(e), column))
        });
        let structure = Structure::new(ordering.keys(), ordering.block_sizes(), entries);
        Arc::new(structure.expect("the equations that were ordered"))
    }

    /// The order n + k of the whole matrix (which is what table 2 of the paper calls n).
    pub fn size(&self) -> usize {
        self.order + self.keys
    }

    /// Lanes of a column of C.
    pub(super) fn key_lanes(&self) -> usize {
        self.keys.div_ceil(LANE)
    }

    /// Where one of A's rows or columns is in a vector.
    pub(super) fn position(&self, index: usize) -> usize {
        let block = &self.blocks[self.block_of[index] as usize];
        block.at * LANE + index - block.start
    }

    /// Lanes of each part.
    pub(super) fn parts(&self) -> [usize; 5] {
        let vectors = self.keys * self.lanes;
        let of_keys = self.keys * self.key_lanes();
        [
            vectors,
            vectors,
            of_keys,
            self.diagonal_lanes,
            self.left_lanes,
        ]
    }

    /// In which part an entry is stored, and its position there, if it is.
    pub(super) fn place(&self, row: usize, column: usize) -> Option<(usize, usize)> {
        if row >= self.size() || column >= self.size() {
            return None;
        }
        let (n, k) = (self.order, self.keys);
        let in_vector = |vector: usize, at: usize| vector * self.lanes * LANE + self.position(at);
        if row >= n {
            return Some(if column < k {
                (C, column * self.key_lanes() * LANE + row - n)
            } else {
                (L, in_vector(row - n, column - k))
            });
        }
        if column < k {
            return Some((H, in_vector(column, row)));
        }
        let (column, block) = (column - k, &self.blocks[self.block_of[row] as usize]);
        let row = row - block.start;
        if column >= block.start {
            let column = column - block.start;
            let start = (block.diagonal + column * block.lanes) * LANE;
            return (column < block.size).then_some((DIAGONAL, start + row));
        }
        let index = block.columns.binary_search(&(column as u32)).ok()?;
        Some((LEFT, block.left_position(row, index)))
    }
}

impl Block {
    /// What is left of the block is stored in tiles of at most [`CHUNK`] lanes, one after the
    /// other, each column by column: a pass over them reads memory in its order. For each tile
    /// its first lane in the block, its width, and the range of its entries.
    pub fn tiles(&self) -> impl Iterator<Item = (usize, usize, std::ops::Range<usize>)> + use<> {
        let (left, lanes, columns) = (self.left, self.lanes, self.columns.len());
        (0..lanes).step_by(CHUNK).map(move |first| {
            let width = CHUNK.min(lanes - first);
            let start = left + first * columns;
            (first, width, start..start + width * columns)
        })
    }

    /// The position of an entry left of the block, given its row in the block and which of the
    /// block's columns it is in.
    fn left_position(&self, row: usize, index: usize) -> usize {
        let first = row / (CHUNK * LANE) * CHUNK;
        let width = CHUNK.min(self.lanes - first);
        let start = self.left + first * self.columns.len() + index * width;
        start * LANE + row - first * LANE
    }
}
