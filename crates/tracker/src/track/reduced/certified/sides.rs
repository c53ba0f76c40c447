//! Right-hand sides, four at once, and what the preconditioner makes of them at most.

use super::frame::Reduction;
use crate::linalg::LANE;
use crate::linalg::rstructure::{Lane, MAX_KEYS, Row, with_width};
use crate::track::full::Equations;

/// One number per key unknown.
pub type PerKey = [f64; MAX_KEYS];

/// g ≥ 0, and bounds on 𝒴 g: |A⁻¹| g_A for A's unknowns, |Z| g for the key ones.
#[derive(Debug)]
pub struct Sides {
    /// g by equation, the normal's last.
    pub g: Vec<Lane>,
    /// g by row of A, by default the same; and work space.
    pub g_a: Vec<Lane>,
    y_a: Vec<Lane>,
    /// The bounds by column of A, and by key unknown. To be rounded up: see [`Sides::roundings`].
    pub a: Vec<Lane>,
    pub keys: [Lane; MAX_KEYS],
}

impl Sides {
    /// Room for the sides of m equations and the normal's.
    pub fn new(m: usize) -> Self {
        let lanes = |count: usize| vec![[0.0; LANE]; count];
        Sides {
            g: lanes(m + 1),
            g_a: lanes(m),
            y_a: lanes(m),
            a: lanes(m),
            keys: [[0.0; LANE]; MAX_KEYS],
        }
    }

    /// More roundings than there are in a bound, the normal's row included.
    pub fn roundings(y: &Reduction, m: usize) -> usize {
        y.resolvent.roundings() + m + 10
    }

    /// Takes A's rows over from g.
    pub fn gather(&mut self, y: &Reduction) {
        for block in &y.elimination.layout.blocks {
            for r in 0..block.size {
                self.g_a[block.start + r] = self.g[block.rows[r] as usize];
            }
        }
    }

    /// Bounds on 𝒴 g over the tube whose frame is given, with `g` in the ignored equations and in |V| g_A,
    /// and `g_a` in |A⁻¹| g_A.
    pub fn bound(&mut self, equations: &Equations, y: &Reduction) {
        let layout = &y.elimination.layout;
        y.resolvent
            .bound(equations, layout, &self.g_a, &mut self.y_a, &mut self.a);
        with_width!(y.elimination.reduced.width, self.through_z(&y.z_size));
    }

    fn through_z<const W: usize>(&mut self, z: &[Lane]) {
        let rows: &[Row<W>] = z.as_chunks().0;
        let mut sums = [[[0.0; LANE]; LANE]; W];
        for (z, g) in rows.iter().zip(&self.g) {
            for w in 0..W {
                for k in 0..LANE {
                    for i in 0..LANE {
                        sums[w][k][i] = z[w][k].mul_add(g[i], sums[w][k][i]);
                    }
                }
            }
        }
        self.keys[..W * LANE].copy_from_slice(sums.as_flattened());
    }
}

/// Σ |k| κ over a row.
#[inline(always)]
pub fn weigh<const W: usize>(k: &Row<W>, kappa: &Row<W>) -> f64 {
    let mut sums = [0.0; LANE];
    for w in 0..W {
        for l in 0..LANE {
            sums[l] = k[w][l].abs().mul_add(kappa[w][l], sums[l]);
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// The numbers of key unknowns in the lanes of a row.
pub fn row_of<const W: usize>(values: &PerKey) -> Row<W> {
    values.as_chunks::<LANE>().0[..W]
        .try_into()
        .expect("W lanes")
}
