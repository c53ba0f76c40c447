//! The order of rows and columns: key unknowns, then the blocks.

use super::super::decompose::{Block, Blocks};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// An order of equations and unknowns in which a Jacobian has R-structure (002, sections 3 and 5):
/// equations block by block, then the ignored ones; key unknowns first, then the other unknowns
/// block by block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ordering {
    equations: Vec<usize>,
    unknowns: Vec<usize>,
    blocks: Vec<usize>,
    keys: usize,
    row_of: Vec<usize>,
    column_of: Vec<usize>,
}

/// Why there is no such order.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum OrderingError {
    /// An unknown that there is none of, in an equation or among the key unknowns.
    #[error("there is no unknown {0}")]
    NoUnknown(usize),
    /// An ignored equation that there is none of.
    #[error("there is no equation {0}")]
    NoEquation(usize),
    /// More or fewer equations than unknowns, once key unknowns and ignored equations are left out.
    #[error("{equations} equations are left for {unknowns} unknowns")]
    NotSquare {
        /// Equations that are not ignored.
        equations: usize,
        /// Unknowns that are not key unknowns.
        unknowns: usize,
    },
    /// No matching covers all: whatever the values of its entries, A is singular.
    #[error(
        "structurally singular: equations {equations:?} have no unknowns left to solve for, unknowns {unknowns:?} no equations"
    )]
    Singular {
        /// Equations that a maximum matching leaves over.
        equations: Vec<usize>,
        /// Unknowns that it leaves over.
        unknowns: Vec<usize>,
    },
}

impl Ordering {
    /// Orders equations, given by the unknowns that occur in each, and `unknowns` unknowns.
    ///
    /// Among the orders of [`Blocks`] that are triangular, the one is taken that follows
    /// the given order of unknowns most closely; in a block, rows and columns keep their order.
    pub fn new(
        unknowns: usize,
        equations: &[Vec<usize>],
        keys: &[usize],
        ignored: &[usize],
    ) -> Result<Self, OrderingError> {
        if let Some(&u) = equations
            .iter()
            .flatten()
            .chain(keys)
            .find(|&&u| u >= unknowns)
        {
            return Err(OrderingError::NoUnknown(u));
        }
        if let Some(&e) = ignored.iter().find(|&&e| e >= equations.len()) {
            return Err(OrderingError::NoEquation(e));
        }
        let is_key = |&u: &usize| keys.contains(&u);
        let (key_unknowns, left): (Vec<usize>, Vec<usize>) = (0..unknowns).partition(is_key);
        let is_ignored = |&e: &usize| ignored.contains(&e);
        let (ignored, rows): (Vec<usize>, Vec<usize>) = (0..equations.len()).partition(is_ignored);
        let columns = left.len();
        if rows.len() != columns || unknowns != equations.len() {
            return Err(OrderingError::NotSquare {
                equations: rows.len(),
                unknowns: columns,
            });
        }

        // By their places among those that are left. The matching tries the last of a row first: where it leaves something over, the
        // first unknowns of each equation are solved for.
        let column = |u: &usize| left.binary_search(u).ok();
        let used = rows
            .iter()
            .map(|&e| equations[e].iter().rev().filter_map(column));
        let used: Vec<Vec<usize>> = used.map(Iterator::collect).collect();
        let cut = Blocks::new(&used, columns).map_err(|over| OrderingError::Singular {
            equations: over.equations.into_iter().map(|e| rows[e]).collect(),
            unknowns: over.unknowns.into_iter().map(|u| left[u]).collect(),
        })?;

        let mut ordering = Ordering {
            equations: Vec::with_capacity(unknowns),
            unknowns: key_unknowns,
            blocks: Vec::with_capacity(cut.blocks.len()),
            keys: unknowns - columns,
            row_of: vec![0; unknowns],
            column_of: vec![0; unknowns],
        };
        for block in in_order(&cut.blocks) {
            ordering
                .equations
                .extend(block.equations.iter().map(|&e| rows[e]));
            ordering
                .unknowns
                .extend(block.unknowns.iter().map(|&u| left[u]));
            ordering.blocks.push(block.unknowns.len());
        }
        ordering.equations.extend(ignored);
        for (row, &e) in ordering.equations.iter().enumerate() {
            ordering.row_of[e] = row;
        }
        for (column, &u) in ordering.unknowns.iter().enumerate() {
            ordering.column_of[u] = column;
        }
        Ok(ordering)
    }

    /// The number k of key unknowns.
    pub fn keys(&self) -> usize {
        self.keys
    }

    /// The equation of each row: the ignored ones last.
    pub fn equations(&self) -> &[usize] {
        &self.equations
    }

    /// The unknown of each column: the key unknowns first.
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    /// The sizes of A's diagonal blocks.
    pub fn block_sizes(&self) -> &[usize] {
        &self.blocks
    }

    /// The row of an equation.
    pub fn row_of(&self, equation: usize) -> usize {
        self.row_of[equation]
    }

    /// The column of an unknown.
    pub fn column_of(&self, unknown: usize) -> usize {
        self.column_of[unknown]
    }

    /// The pattern as text, X for an entry and a point for none, with names above the columns
    /// (from top to bottom) and before the rows. Brackets hold the diagonal blocks; a bar
    /// separates the key unknowns, a line the ignored equations.
    ///
    /// ```
    /// use krawl::linalg::rstructure::Ordering;
    /// // Figure 1 of 002 with u = AB' as key unknown: the table of eq. 8.
    /// let equations = [
    ///     vec![0, 1, 2], vec![1, 2], vec![3, 4], vec![1, 2, 3, 4],
    ///     vec![1, 2, 5, 6], vec![3, 4, 5, 6], vec![5, 6],
    /// ];
    /// let ordering = Ordering::new(7, &equations, &[0], &[6]).unwrap();
    /// let text = ordering.render(
    ///     &equations,
    ///     &["AB'", "A'A", "B'B", "AB", "AC", "BC", "C'C"],
    ///     &["u", "xA", "yA", "xB", "yB", "xC", "yC"],
    /// );
    /// assert_eq!("\n".to_owned() + &text, "
    ///      u | x y x y x y
    ///        | A A B B C C
    /// AB'  X |[X X]. . . .
    /// A'A  . |[X X]. . . .
    /// B'B  . | . .[X X]. .
    /// AB   . | X X[X X]. .
    /// AC   . | X X . .[X X]
    /// BC   . | . . X X[X X]
    ///     ---+-------------
    /// C'C  . | . . . . X X
    /// ");
    /// ```
    pub fn render(
        &self,
        equations: &[Vec<usize>],
        equation_names: &[impl AsRef<str>],
        unknown_names: &[impl AsRef<str>],
    ) -> String {
        let size = self.unknowns.len();
        let width = |name: &str| name.chars().count();
        let margin = equation_names
            .iter()
            .map(|n| width(n.as_ref()))
            .max()
            .unwrap_or(0)
            + 1;
        let height = unknown_names
            .iter()
            .map(|n| width(n.as_ref()))
            .max()
            .unwrap_or(0);
        let mut lines = Vec::new();
        // A line of cells; before column c comes `border(c)`, and `border(size)` at the end.
        let line = |name: &str, cell: &dyn Fn(usize) -> char, border: &dyn Fn(usize) -> char| {
            let mut text = format!("{name:<margin$}");
            for column in 0..size {
                if column == self.keys && self.keys > 0 {
                    text.push_str(" |");
                }
                text.push(border(column));
                text.push(cell(column));
            }
            text.push(border(size));
            text.truncate(text.trim_end().len());
            text
        };
        for row in 0..height {
            let letter = |column: usize| {
                let name = unknown_names[self.unknowns[column]].as_ref();
                name.chars().nth(row).unwrap_or(' ')
            };
            lines.push(line("", &letter, &|_| ' '));
        }
        let mut borders = Vec::with_capacity(size);
        let mut start = self.keys;
        for &block in &self.blocks {
            borders.extend(std::iter::repeat_n(Some((start, start + block)), block));
            start += block;
        }
        borders.resize(size, None);
        for (row, &equation) in self.equations.iter().enumerate() {
            let mut cells = vec!['.'; size];
            for &unknown in &equations[equation] {
                cells[self.column_of[unknown]] = 'X';
            }
            if row == size - self.keys {
                let keys = if self.keys > 0 { "-" } else { "" };
                lines.push(format!(
                    "{}{}{keys}+{}",
                    " ".repeat(margin),
                    "-".repeat(2 * self.keys),
                    "-".repeat(2 * (size - self.keys) + 1),
                ));
            }
            let border = |column: usize| match borders[row] {
                Some((from, _)) if column == from => '[',
                Some((_, to)) if column == to => ']',
                _ => ' ',
            };
            let name = equation_names[equation].as_ref();
            lines.push(line(name, &|column| cells[column], &border));
        }
        lines.iter().map(|line| format!("{line}\n")).collect()
    }
}

/// Blocks after all those that they need, else by their first unknowns.
fn in_order(blocks: &[Block]) -> impl Iterator<Item = &Block> {
    let mut waiting: Vec<usize> = blocks.iter().map(|block| block.needs.len()).collect();
    let mut needed_by = vec![Vec::new(); blocks.len()];
    for (b, block) in blocks.iter().enumerate() {
        block.needs.iter().for_each(|&need| needed_by[need].push(b));
    }
    let entry = |b: usize| Reverse((blocks[b].unknowns[0], b));
    let mut ready: BinaryHeap<_> = (0..blocks.len())
        .filter(|&b| waiting[b] == 0)
        .map(entry)
        .collect();
    std::iter::from_fn(move || {
        let Reverse((_, b)) = ready.pop()?;
        for &next in &needed_by[b] {
            waiting[next] -= 1;
            if waiting[next] == 0 {
                ready.push(entry(next));
            }
        }
        Some(&blocks[b])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the equations have no entries above the diagonal blocks.
    fn is_triangular(ordering: &Ordering, equations: &[Vec<usize>]) -> bool {
        // For each row the end of its block's columns; the ignored equations have all.
        let ends = ordering.blocks.iter().scan(ordering.keys, |end, &size| {
            *end += size;
            Some(std::iter::repeat_n(*end, size))
        });
        let mut ends: Vec<usize> = ends.flatten().collect();
        ends.resize(ordering.unknowns.len(), usize::MAX);
        let mut rows = equations.iter().enumerate();
        rows.all(|(e, unknowns)| {
            let end = ends[ordering.row_of[e]];
            unknowns.iter().all(|&u| ordering.column_of[u] < end)
        })
    }

    /// Table 1 of 002: names of unknowns, and equations with their unknowns, in its order.
    fn hexahedron() -> (Vec<String>, Vec<(String, Vec<usize>)>) {
        let mut names: Vec<String> = ["l12", "l24", "l41", "x1", "x2", "y2"]
            .map(Into::into)
            .into();
        for vertex in 3..8 {
            names.extend(["x", "y", "z"].map(|axis| format!("{axis}{vertex}")));
        }
        let of = |vertices: &[usize]| -> Vec<usize> {
            let is = |name: &str, v: usize| !name.starts_with('l') && name[1..] == v.to_string();
            (0..names.len())
                .filter(|&u| vertices.iter().any(|&v| is(&names[u], v)))
                .collect()
        };
        let equation = |kind: char, vertices: &[usize], key: Option<usize>| {
            let list: Vec<String> = vertices.iter().map(|v| v.to_string()).collect();
            let mut unknowns: Vec<usize> = key.into_iter().collect();
            unknowns.extend(of(vertices));
            (format!("{kind}({})", list.join(",")), unknowns)
        };
        let equations = vec![
            equation('D', &[0, 1], None),
            equation('D', &[0, 2], None),
            equation('D', &[1, 2], Some(0)),
            equation('D', &[1, 3], None),
            equation('D', &[2, 3], None),
            equation('C', &[0, 1, 2, 3], None),
            equation('D', &[0, 4], None),
            equation('D', &[1, 4], Some(2)),
            equation('D', &[2, 4], Some(1)),
            equation('D', &[1, 5], None),
            equation('D', &[4, 5], None),
            equation('C', &[0, 1, 4, 5], None),
            equation('D', &[2, 6], None),
            equation('D', &[4, 6], None),
            equation('C', &[0, 2, 4, 6], None),
            equation('C', &[1, 3, 5, 7], None),
            equation('C', &[2, 3, 6, 7], None),
            equation('C', &[4, 5, 6, 7], None),
            equation('D', &[3, 7], None),
            equation('D', &[5, 7], None),
            equation('D', &[6, 7], None),
        ];
        (names, equations)
    }

    #[test]
    fn the_hexahedron_comes_out_as_in_table_1() {
        let (names, equations) = hexahedron();
        let patterns: Vec<Vec<usize>> = equations.iter().map(|e| e.1.clone()).collect();
        let ordering = Ordering::new(21, &patterns, &[0, 1, 2], &[18, 19, 20]).unwrap();
        assert_eq!(ordering.block_sizes(), [1, 2, 3, 3, 3, 3, 3]);
        // The table is in block lower triangular order already.
        let given: Vec<usize> = (0..21).collect();
        assert_eq!(ordering.equations(), given);
        assert_eq!(ordering.unknowns(), given);

        // From any other order the same blocks come out, as sets.
        let shuffled = |i: usize| (i * 8 + 5) % 21;
        let mut other = vec![Vec::new(); 21];
        for (i, pattern) in patterns.iter().enumerate() {
            other[shuffled(i)] = pattern.iter().map(|&u| shuffled(u)).rev().collect();
        }
        let keys = [0, 1, 2].map(shuffled);
        let reordered = Ordering::new(21, &other, &keys, &[18, 19, 20].map(shuffled)).unwrap();
        let sets = |unknowns: &[usize], sizes: &[usize]| {
            let mut rest = &unknowns[3..];
            let mut sets: Vec<Vec<usize>> = Vec::new();
            for &size in sizes {
                let (block, next) = rest.split_at(size);
                let mut block = block.to_vec();
                block.sort_unstable();
                sets.push(block);
                rest = next;
            }
            sets.sort();
            sets
        };
        let expected: Vec<usize> = given.iter().map(|&u| shuffled(u)).collect();
        assert_eq!(
            sets(reordered.unknowns(), reordered.block_sizes()),
            sets(&expected, ordering.block_sizes())
        );
        assert!(is_triangular(&reordered, &other));

        let labels: Vec<&String> = equations.iter().map(|e| &e.0).collect();
        let text = ordering.render(&patterns, &labels, &names);
        let expected = "
            l l l | x x y x y z x y z x y z x y z x y z
            1 2 4 | 1 2 2 3 3 3 4 4 4 5 5 5 6 6 6 7 7 7
            2 4 1 |
D(0,1)      . . . |[X]. . . . . . . . . . . . . . . . .
D(0,2)      . . . | .[X X]. . . . . . . . . . . . . . .
D(1,2)      X . . | X[X X]. . . . . . . . . . . . . . .
D(1,3)      . . . | X . .[X X X]. . . . . . . . . . . .
D(2,3)      . . . | . X X[X X X]. . . . . . . . . . . .
C(0,1,2,3)  . . . | X X X[X X X]. . . . . . . . . . . .
D(0,4)      . . . | . . . . . .[X X X]. . . . . . . . .
D(1,4)      . . X | X . . . . .[X X X]. . . . . . . . .
D(2,4)      . X . | . X X . . .[X X X]. . . . . . . . .
D(1,5)      . . . | X . . . . . . . .[X X X]. . . . . .
D(4,5)      . . . | . . . . . . X X X[X X X]. . . . . .
C(0,1,4,5)  . . . | X . . . . . X X X[X X X]. . . . . .
D(2,6)      . . . | . X X . . . . . . . . .[X X X]. . .
D(4,6)      . . . | . . . . . . X X X . . .[X X X]. . .
C(0,2,4,6)  . . . | . X X . . . X X X . . .[X X X]. . .
C(1,3,5,7)  . . . | X . . X X X . . . X X X . . .[X X X]
C(2,3,6,7)  . . . | . X X X X X . . . . . . X X X[X X X]
C(4,5,6,7)  . . . | . . . . . . X X X X X X X X X[X X X]
           -------+-------------------------------------
D(3,7)      . . . | . . . X X X . . . . . . . . . X X X
D(5,7)      . . . | . . . . . . . . . X X X . . . X X X
D(6,7)      . . . | . . . . . . . . . . . . X X X X X X
";
        assert_eq!(text, expected.trim_start_matches('\n'));
    }

    #[test]
    fn figure_1_with_and_without_the_length_as_key_unknown() {
        // Eq. 8: u, xA, yA, xB, yB, xC, yC, as in the table, from the paper's own order (1) to (7).
        let eq8 = [
            vec![0, 1, 2],
            vec![1, 2],
            vec![3, 4],
            vec![1, 2, 3, 4],
            vec![1, 2, 5, 6],
            vec![3, 4, 5, 6],
            vec![5, 6],
        ];
        let ordering = Ordering::new(7, &eq8, &[0], &[6]).unwrap();
        assert_eq!(ordering.block_sizes(), [2, 2, 2]);
        assert_eq!(ordering.equations(), [0, 1, 2, 3, 4, 5, 6]);
        // Eq. 9: xA instead of u. Its first block is yA alone.
        let eq9: Vec<Vec<usize>> = eq8[1..]
            .iter()
            .map(|e| e.iter().map(|&u| u - 1).collect())
            .collect();
        let ordering = Ordering::new(6, &eq9, &[0], &[5]).unwrap();
        assert_eq!(ordering.block_sizes(), [1, 2, 2]);
        assert_eq!(ordering.unknowns(), [0, 1, 2, 3, 4, 5]);
        assert_eq!(ordering.equations(), [0, 1, 2, 3, 4, 5]);
        // "By symmetry, any of the unknowns can be used as the key unknown."
        for key in 0..6 {
            // A and CC', B and CC', C and BB'.
            let ignored = [5, 5, 1][key / 2];
            let ordering = Ordering::new(6, &eq9, &[key], &[ignored]).unwrap();
            assert_eq!(ordering.block_sizes(), [1, 2, 2]);
            assert!(is_triangular(&ordering, &eq9));
        }
        // Without key unknowns the system is irreducible.
        let whole = Ordering::new(6, &eq9, &[], &[]).unwrap();
        assert_eq!(whole.block_sizes(), [6]);
    }

    #[test]
    fn what_cannot_be_ordered_is_named() {
        // Figure 4 of 002: F2 and F3 both in z alone.
        let singular = Ordering::new(3, &[vec![0, 1, 2], vec![2], vec![2]], &[], &[]);
        assert_eq!(
            singular,
            Err(OrderingError::Singular {
                equations: vec![2],
                unknowns: vec![1]
            })
        );
        let not_square = Ordering::new(2, &[vec![0], vec![1]], &[0], &[]);
        assert_eq!(
            not_square,
            Err(OrderingError::NotSquare {
                equations: 2,
                unknowns: 1
            })
        );
        let none = Ordering::new(1, &[vec![1]], &[], &[]);
        assert_eq!(none, Err(OrderingError::NoUnknown(1)));
        assert_eq!(
            Ordering::new(1, &[vec![0]], &[0], &[3]),
            Err(OrderingError::NoEquation(3))
        );
        let empty = Ordering::new(0, &[], &[], &[]).unwrap();
        assert!(empty.block_sizes().is_empty());
    }

    #[test]
    fn figure_3_falls_into_two_blocks() {
        // ax + by, cx + dy, ey + fz (eq. 10).
        let ordering = Ordering::new(3, &[vec![1, 2], vec![0, 1], vec![0, 1]], &[], &[]).unwrap();
        assert_eq!(ordering.block_sizes(), [2, 1]);
        assert_eq!(ordering.equations(), [1, 2, 0]);
    }
}
