//! Row echelon form modulo the prime, row by row.

use super::{PRIME, Residues, add, invert, mul, sub};

/// A row without its zeros: columns, ascending, and entries.
type Row = Vec<(usize, u64)>;

/// Rows that were taken so far, in row echelon form.
pub struct Echelon {
    /// For each column the row that begins there; its first entry is 1.
    pivots: Vec<Option<Row>>,
    /// How many rows there are.
    pub rank: usize,
}

impl Echelon {
    /// No rows of a matrix of so many columns.
    pub fn new(columns: usize) -> Self {
        Echelon {
            pivots: vec![None; columns],
            rank: 0,
        }
    }

    /// Subtracts multiples of the rows that there are until the row begins in another column than all of them,
    /// and takes it. False if nothing is left of it. Entries of `row` beyond the columns go along.
    pub fn take(&mut self, row: &mut [u64]) -> bool {
        for column in 0..self.pivots.len() {
            let factor = row[column];
            if factor == 0 {
                continue;
            }
            let Some(pivot) = &self.pivots[column] else {
                let scale = invert(factor);
                let entries = row.iter().enumerate().filter(|&(_, &entry)| entry != 0);
                let scaled = entries.map(|(at, &entry)| (at, mul(scale, entry)));
                self.pivots[column] = Some(scaled.collect());
                self.rank += 1;
                return true;
            };
            let factor = PRIME - factor;
            for &(at, entry) in pivot {
                row[at] = add(row[at], mul(factor, entry));
            }
        }
        false
    }

    /// A random vector that all rows map to zero.
    pub fn null_vector(&self, residues: &mut Residues) -> Vec<u64> {
        let mut out = vec![0; self.pivots.len()];
        for (column, pivot) in self.pivots.iter().enumerate().rev() {
            out[column] = match pivot {
                None => residues.next(),
                Some(row) => row[1..]
                    .iter()
                    .filter(|(at, _)| *at < self.pivots.len())
                    .fold(0, |sum, &(at, entry)| sub(sum, mul(entry, out[at]))),
            };
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_and_null_vectors() {
        let mut residues = Residues::new(5);
        let mut echelon = Echelon::new(6);
        let rows: Vec<Vec<u64>> = (0..4)
            .map(|_| (0..6).map(|_| residues.next()).collect())
            .collect();
        for row in &rows {
            assert!(echelon.take(&mut row.clone()));
        }
        // A sum of rows adds nothing.
        let mut sum: Vec<u64> = (0..6).map(|k| add(rows[0][k], rows[3][k])).collect();
        assert!(!echelon.take(&mut sum));
        assert!(sum.iter().all(|&x| x == 0));
        assert_eq!(echelon.rank, 4);
        let v = echelon.null_vector(&mut residues);
        assert!(v.iter().any(|&x| x != 0));
        for row in &rows {
            let products = row.iter().zip(&v).map(|(&a, &b)| mul(a, b));
            assert_eq!(products.fold(0, add), 0);
        }
    }
}
