//! Enclosures of solutions for interval right-hand sides.

use super::scalar::{Enclosing, Subtract};
use super::{Factors, RMatrix, Singular};
use krawl::interval::{Interval, point};

/// Encloses the solutions of J₀ x = b for a float matrix J₀ and all b in a box: the linear systems
/// of interval Newton steps in the centred form (002, section 7, eq. 21),
/// J₀ Δx = −f(x₀) − ΔJ (B − x₀).
///
/// The middle of the box is solved for in floats; what is left, and the box's width, goes through
/// the R-structure in interval arithmetic. So a thin box comes out a few roundings wide. A thick
/// one grows with the wrapping effect (section 7): widths pass from block to block as |A_ij|
/// times the width before, regardless of signs. `docs/measured/figures.md` has figures.
///
/// ```
/// use krawl::interval::hull;
/// use krawl_lab::rstructure::{Enclosure, RMatrix};
/// let entries = [(0, 0, 1.0), (0, 1, 3.0), (1, 0, 1.0), (1, 1, -3.0)];
/// let matrix = RMatrix::from_entries(1, &[1], &entries).unwrap();
/// // u + 3 x = 1, u − 3 x ∈ [0, 1]: u ∈ [1/2, 1], x ∈ [0, 1/6].
/// let mut enclosure = Enclosure::new(matrix).unwrap();
/// let solution = enclosure.solve(&[hull(1.0, 1.0), hull(0.0, 1.0)]);
/// assert!(solution[0].contains(0.5) && solution[0].contains(1.0));
/// assert!(solution[1].contains(0.0) && solution[1].contains(1.0 / 6.0));
/// ```
#[derive(Debug, Clone)]
pub struct Enclosure {
    floats: Factors<f64>,
    intervals: Factors<Enclosing>,
}

impl Enclosure {
    /// Factors the matrix in floats and in intervals. Where it succeeds, the matrix is proved to
    /// be regular.
    pub fn new(matrix: RMatrix<f64>) -> Result<Self, Singular> {
        assert_finite(&matrix);
        let intervals = Factors::new(matrix.map(|x| Enclosing(point(x))))?;
        let floats = Factors::new(matrix)?;
        Ok(Enclosure { floats, intervals })
    }

    /// A box that holds the solution for every right-hand side in the box given. Order as in
    /// [`Factors::solve`]. Unbounded where floats overflow on the way.
    pub fn solve(&mut self, right_side: &[Interval]) -> Vec<Interval> {
        let middle: Vec<f64> = right_side.iter().map(|b| b.mid()).collect();
        let mut near = self.floats.solve(&middle);
        // Any point will do for the enclosure to hold.
        near.iter_mut()
            .filter(|x| !x.is_finite())
            .for_each(|x| *x = 0.0);
        let mut rest: Vec<Enclosing> = right_side.iter().copied().map(Enclosing).collect();
        self.intervals.matrix().for_each(|row, column, entry| {
            rest[row] = rest[row].minus_product(entry, Enclosing(point(near[column])));
        });
        self.intervals.solve_in_place(&mut rest);
        rest.iter().zip(near).map(|(d, x)| d.0 + point(x)).collect()
    }
}

fn assert_finite(matrix: &RMatrix<f64>) {
    matrix.for_each(|row, column, x| assert!(x.is_finite(), "entry ({row}, {column}) is {x}"));
}
