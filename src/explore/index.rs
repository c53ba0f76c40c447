//! Finding numbers again that agree up to rounding.

use std::collections::HashMap;

/// Items by a group and a number.
#[derive(Debug, Default)]
pub struct Index {
    cells: HashMap<(usize, i64), Vec<u64>>,
}

/// Width of a cell, relative to the unit of what is indexed. Far above rounding, and few items fall into one.
const CELL: f64 = 1e-6;

fn cell(at: f64) -> i64 {
    (at / CELL).floor() as i64
}

impl Index {
    /// Enters an item.
    pub fn insert(&mut self, group: usize, at: f64, item: u64) {
        self.cells.entry((group, cell(at))).or_default().push(item);
    }

    /// All items of the group near a number, and some others.
    pub fn near(&self, group: usize, at: f64) -> impl Iterator<Item = u64> + '_ {
        let middle = cell(at);
        (middle.saturating_sub(1)..=middle.saturating_add(1))
            .filter_map(move |cell| self.cells.get(&(group, cell)))
            .flatten()
            .copied()
    }
}

/// Whether two lists of numbers agree entry by entry, relatively.
pub fn agree(one: &[f64], other: &[f64], tolerance: f64) -> bool {
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(a, b)| (a - b).abs() <= tolerance * a.abs().max(b.abs()).max(1e-300))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_neighbours_across_cells() {
        let mut index = Index::default();
        index.insert(0, 1.0, 7);
        for off in [-1e-12, 0.0, 1e-12] {
            assert!(index.near(0, 1.0 + off).any(|x| x == 7));
            assert!(index.near(1, 1.0 + off).next().is_none());
        }
        assert!(index.near(0, 1.1).next().is_none());
    }
}
