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
    /// Where those unknowns are in a vector.
    pub positions: Vec<u32>,
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

/// Where an entry is stored.
pub(super) enum Place {
    /// In H: key unknown, position in a vector.
    H(usize, usize),
    /// In L: ignored equation, position in a vector.
    L(usize, usize),
    /// In C: position in its columns.
    C(usize),
    /// Position in the diagonal blocks.
    Diagonal(usize),
    /// Position left of them.
    Left(usize),
}

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
                positions: Vec::new(),
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
        for index in 0..structure.blocks.len() {
            let mut columns = std::mem::take(&mut structure.blocks[index].columns);
            columns.sort_unstable();
            columns.dedup();
            let positions = columns
                .iter()
                .map(|&column| structure.position(column as usize) as u32);
            let positions = positions.collect();
            let block = &mut structure.blocks[index];
            block.left = structure.left_lanes;
            structure.left_lanes += block.lanes * columns.len();
            (block.columns, block.positions) = (columns, positions);
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

    /// The number k of key unknowns.
    pub fn keys(&self) -> usize {
        self.keys
    }

    /// The order n of A.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The order n + k of the whole matrix (which is what table 2 of the paper calls n).
    pub fn size(&self) -> usize {
        self.order + self.keys
    }

    /// The sizes of the diagonal blocks.
    pub fn block_sizes(&self) -> impl Iterator<Item = usize> + '_ {
        self.blocks.iter().map(|block| block.size)
    }

    /// The numbers that are stored, padding left out: what memory and one pass over A cost.
    pub fn stored(&self) -> usize {
        let rows = |block: &Block| block.size * (block.size + block.columns.len());
        let a: usize = self.blocks.iter().map(rows).sum();
        a + self.keys * (2 * self.order + self.keys)
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

    /// Where an entry is stored, if it is.
    pub(super) fn place(&self, row: usize, column: usize) -> Option<Place> {
        if row >= self.size() || column >= self.size() {
            return None;
        }
        let (n, k) = (self.order, self.keys);
        if row >= n {
            return Some(if column < k {
                Place::C(column * self.key_lanes() * LANE + row - n)
            } else {
                Place::L(row - n, self.position(column - k))
            });
        }
        if column < k {
            return Some(Place::H(column, self.position(row)));
        }
        let (column, block) = (column - k, &self.blocks[self.block_of[row] as usize]);
        let row = row - block.start;
        if column >= block.start {
            let column = column - block.start;
            let start = (block.diagonal + column * block.lanes) * LANE;
            return (column < block.size).then_some(Place::Diagonal(start + row));
        }
        let index = block.columns.binary_search(&(column as u32)).ok()?;
        Some(Place::Left(block.left_position(row, index)))
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
