//! What brings points onto the path: an approximate inverse of [J; c].

use super::equations::{Differences, Equations, Lengths};
use crate::linalg::{Inverter, Matrix, Singular, Vector};

/// An approximate inverse Y of the Jacobian bordered by the normal, in whatever form.
pub trait Preconditioner {
    /// What makes it, kept from one point to the next.
    type Maker;
    /// Whether it is made anew at refined points, and needs no iterative refinement there.
    const FRESH: bool;

    /// Room for one.
    fn new(equations: &Equations) -> Self;

    /// Makes Y at the point with the given differences, lengths and normal. Tells whether the
    /// determinant is negative, where that is known.
    fn make(
        &mut self,
        maker: &mut Self::Maker,
        equations: &Equations,
        at: (&Differences, &Lengths, &Vector),
    ) -> Result<bool, Singular>;

    /// Why none could be made last, where that is not because the matrix is singular.
    fn obstacle(&self) -> Option<String> {
        None
    }

    /// `out = Y f`; entries of `f` beyond its end are zero.
    fn solve(&self, equations: &Equations, f: &[f64], out: &mut Vector);
}

/// An inverter for [J; c] and room for that matrix's values.
pub type InverseMaker = (Inverter, Vec<f64>);

/// In the full space: the inverse itself.
impl Preconditioner for Matrix {
    type Maker = InverseMaker;
    const FRESH: bool = false;

    fn new(equations: &Equations) -> Self {
        Matrix::zeros(equations.n(), equations.n())
    }

    fn make(
        &mut self,
        (inverter, values): &mut Self::Maker,
        equations: &Equations,
        (d, lengths, normal): (&Differences, &Lengths, &Vector),
    ) -> Result<bool, Singular> {
        equations.bordered_values(d, lengths, normal, values);
        inverter.invert(values, self)?;
        Ok(inverter.is_negative())
    }

    #[inline(always)]
    fn solve(&self, _: &Equations, f: &[f64], out: &mut Vector) {
        self.multiply(f, out);
    }
}
