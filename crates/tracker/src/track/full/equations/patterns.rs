//! The Jacobian as a sparse matrix, for preconditioners and for products with them.

use super::{Differences, Equations, Lengths};
use crate::linalg::{Inverter, Sparse};
use crate::track::full::preconditioner::InverseMaker;

impl Equations {
    /// An inverter for the Jacobian with its last row, and room for that matrix's values.
    pub fn inverter(&self) -> InverseMaker {
        (
            Inverter::new(&self.bordered),
            vec![0.0; self.bordered.entries()],
        )
    }

    /// The pattern of the Jacobian's derivatives along a curve, whose last row is zero.
    pub fn pattern(&self) -> &Sparse {
        &self.pattern
    }

    /// The pattern of the Jacobian with its last row.
    pub fn bordered_pattern(&self) -> &Sparse {
        &self.bordered
    }

    /// Values for [`Equations::pattern`]: the differences, and minus `time` in the column of t.
    #[inline(always)]
    pub fn pattern_values(&self, d: &Differences, time: &[f64], out: &mut [f64]) {
        for (sources, d) in self.sources.iter().zip(&d.axes) {
            for source in sources {
                out[source.plain as usize] = source.sign * d[source.edge as usize];
            }
        }
        if !self.tail.is_empty() {
            self.tail.values(&d.forms, |at| at.plain as usize, out);
        }
        let last = self.pattern.entries() - self.m;
        for (out, time) in out[last..].iter_mut().zip(time) {
            *out = -time;
        }
    }

    /// Values for [`Equations::bordered_pattern`].
    pub fn bordered_values(
        &self,
        d: &Differences,
        lengths: &Lengths,
        normal: &[f64],
        out: &mut [f64],
    ) {
        for (sources, d) in self.sources.iter().zip(&d.axes) {
            for source in sources {
                out[source.bordered as usize] = source.sign * d[source.edge as usize];
            }
        }
        if !self.tail.is_empty() {
            self.tail.values(&d.forms, |at| at.bordered as usize, out);
        }
        let mut last = 0;
        for (column, normal) in normal[..self.m].iter().enumerate() {
            last += self.bordered.entries_of(column);
            out[last - 1] = *normal;
        }
        let of_time = lengths.terms[1].iter().map(|slope| -slope);
        for (out, value) in out[last..].iter_mut().zip(of_time.chain([normal[self.m]])) {
            *out = value;
        }
    }
}
