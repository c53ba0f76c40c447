//! K(s) and Z(s): the eliminating transformation and the preconditioner along the path, as
//! polynomials; and what they leave over.

use super::COEFFICIENTS;
use super::frame::{Locals, SERIES};
use crate::linalg::rstructure::{Lane, Row, add};
use crate::linalg::{LANE, Vector};
use crate::places::array;
use crate::track::full::Equations;
use crate::track::reduced::structure::passes::Derivative;

/// Orders of J K that are looked at with their signs: two more than the series have.
pub const SIGNED: usize = SERIES + 2;
/// Orders of Zᵀ J that are looked at with their signs: one more than the series have, as it matters less than J K.
pub const SIGNED_LEFT: usize = SERIES + 1;

/// What is left over, order by order, and work space.
#[derive(Debug, Default)]
pub struct Series {
    /// J K at s⁰ … s⁴: a row per distance, and one for the normal. The ignored ones are S.
    pub jk: [Vec<Lane>; SIGNED + 1],
    /// Zᵀ J at s⁰ … s³: a row per unknown, of which A's count.
    pub zj: [Vec<Lane>; SIGNED_LEFT + 1],
    /// Slopes of the lengths' half squares at s⁰ … s⁴.
    pub slopes: [Vector; SIGNED + 1],
    /// Values of the tail's entries at every order.
    pub entries: [Vec<f64>; COEFFICIENTS],
    t: Vec<Lane>,
}

impl Series {
    /// Room for one.
    pub fn new(equations: &Equations) -> Self {
        Series {
            slopes: std::array::from_fn(|_| equations.per_edge()),
            entries: std::array::from_fn(|_| vec![0.0; equations.tail.entries()]),
            ..Series::default()
        }
    }

    /// Computes the series at a point where the elimination was made.
    pub fn make<const W: usize>(&mut self, equations: &Equations, local: &mut Locals) {
        let (m, n) = (equations.m, equations.n());
        self.set_slopes(equations, local);
        for (entries, d) in self.entries.iter_mut().zip(&local.d) {
            equations.tail.row_values(&d.forms, entries);
        }
        let (d, y) = (&local.d, &mut local.y);
        let normal = &local.normal[..n];
        let jacobians: [Derivative; SIGNED + 1] = array(|q| Derivative {
            ends: &equations.ends,
            d: &d[q],
            slope: &self.slopes[q],
            t: m,
            tail: &equations.tail,
            entries: &self.entries[q],
        });
        let layout = y.elimination.layout.clone();
        let inverses = &y.elimination.inverses;
        let reset = |rows: &mut Vec<Lane>, count: usize| {
            rows.clear();
            rows.resize(count * W, [0.0; LANE]);
        };
        for rows in self.jk.iter_mut() {
            reset(rows, n);
        }
        for rows in self.zj.iter_mut() {
            reset(rows, n + 1);
        }
        for rows in y.k.iter_mut() {
            reset(rows, n + 1);
        }
        for rows in y.z.iter_mut() {
            reset(rows, n);
        }
        // K: order by order, (J K)_q = 0 in the rows of A.
        let [k1, k2] = &mut y.k;
        let k0 = y.elimination.reduced.k.as_chunks::<W>().0;
        let (k1, k2) = (k1.as_chunks_mut::<W>().0, k2.as_chunks_mut::<W>().0);
        let [jk0, jk1, jk2, jk3, jk4] = self.jk.each_mut().map(|rows| rows.as_chunks_mut::<W>().0);
        jacobians[0].times(k0, jk0);
        normal_times(normal, k0, &mut jk0[m]);
        jacobians[1].times(k0, jk1);
        jacobians[0].substitute(&layout, inverses, jk1, k1);
        jacobians[0].times(k1, jk1);
        normal_times(normal, k1, &mut jk1[m]);
        jacobians[2].times(k0, jk2);
        jacobians[1].times(k1, jk2);
        jacobians[0].substitute(&layout, inverses, jk2, k2);
        jacobians[0].times(k2, jk2);
        normal_times(normal, k2, &mut jk2[m]);
        jacobians[3].times(k0, jk3);
        jacobians[2].times(k1, jk3);
        jacobians[1].times(k2, jk3);
        jacobians[4].times(k0, jk4);
        jacobians[3].times(k1, jk4);
        jacobians[2].times(k2, jk4);

        // Z: order by order, first the ignored equations' rows from S, then those of A so that
        // (Zᵀ J)_q = 0 in the columns of A.
        let keys = layout.keys();
        let rows_of_s = layout.rows_of_s(m);
        let p0 = y.elimination.reduced.p.as_chunks::<W>().0;
        for q in 0..=SERIES {
            let (before, after) = y.z.split_at_mut(q);
            let z = after[0].as_chunks_mut::<W>().0;
            if q == 0 {
                for l in 0..keys {
                    z[rows_of_s[l]] = p0[l];
                }
            } else {
                // P_q = −(Σ_{i<q} P_i S_{q−i}) P₀.
                let mut columns = [[[[0.0; LANE]; W]; LANE]; W];
                for (i, z) in before.iter().enumerate() {
                    let z = z.as_chunks::<W>().0;
                    let s = self.jk[q - i].as_chunks::<W>().0;
                    add_product(rows_of_s[..keys].iter().copied(), z, s, &mut columns);
                }
                for l in 0..keys {
                    let p = p0[l];
                    let mut sum = [[0.0; LANE]; W];
                    for (j, column) in columns.as_flattened()[..keys].iter().enumerate() {
                        add(&mut sum, -p[j / LANE][j % LANE], column);
                    }
                    z[rows_of_s[l]] = sum;
                }
            }
            let zj = self.zj[q].as_chunks_mut::<W>().0;
            for (i, z) in before.iter().enumerate() {
                let z = z.as_chunks::<W>().0;
                jacobians[q - i].times_left(&z[..m], zj);
            }
            // Only the ignored rows are there yet; afterwards only A's are to be added.
            jacobians[0].times_left(&z[..m], zj);
            for (c, zj) in normal.iter().zip(zj.iter_mut()) {
                add(zj, *c, &z[m]);
            }
            reset(&mut self.t, n + 1);
            let t = self.t.as_chunks_mut::<W>().0;
            t.copy_from_slice(zj);
            jacobians[0].substitute_left(&layout, inverses, t, z);
            for block in &layout.blocks {
                for r in 0..block.size {
                    let e = block.rows[r] as usize;
                    jacobians[0].add_left(e, &z[e], zj);
                }
            }
        }
        let zj = self.zj[SIGNED_LEFT].as_chunks_mut::<W>().0;
        for (i, z) in y.z.iter().enumerate() {
            let z = z.as_chunks::<W>().0;
            jacobians[SIGNED_LEFT - i].times_left(&z[..m], zj);
        }
    }

    fn set_slopes(&mut self, equations: &Equations, local: &Locals) {
        self.slopes[0].copy_from_slice(&local.lengths.terms[1]);
        for q in 1..=SIGNED {
            let twice = 2.0 * local.z[q][equations.m];
            for (slope, e2) in self.slopes[q].iter_mut().zip(equations.e[2].iter()) {
                *slope = e2 * twice;
            }
            for (b, bend) in equations.bends.iter().enumerate() {
                self.slopes[q][bend.edge] = local.bend_slope(b, q);
            }
        }
    }
}

/// `columns[j] += Σ_l S[l][j] P[l]` over the given rows: the columns of P S, P's rows being transposed,
/// LANE of them at a time.
#[inline(always)]
pub fn add_product<const W: usize>(
    rows: impl Iterator<Item = usize> + Clone,
    p: &[Row<W>],
    s: &[Row<W>],
    columns: &mut [[Row<W>; LANE]; W],
) {
    for (w, columns) in columns.iter_mut().enumerate() {
        let mut sums = *columns;
        for l in rows.clone() {
            let (p, s) = (&p[l], &s[l][w]);
            for (sum, s) in sums.iter_mut().zip(s) {
                add(sum, *s, p);
            }
        }
        *columns = sums;
    }
}

fn normal_times<const W: usize>(normal: &[f64], k: &[Row<W>], out: &mut Row<W>) {
    for (c, row) in normal.iter().zip(k) {
        add(out, *c, row);
    }
}
