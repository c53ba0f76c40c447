//! A tube of the reduced space in exact numbers: ẑ, K, 𝒴, T and Φ' of `reduced/test.rs`.

use super::big::{horner, horner_slope};
use super::*;
use crate::linalg::LANE;
use crate::places::Each as _;
use crate::track::reduced::certified::Block;

/// A tube of the reduced space, its numbers taken for exact.
pub struct View<'a> {
    pub figure: &'a Figure,
    pub tube: &'a ReducedTube,
    /// Key unknowns, A's unknowns, A's rows.
    pub keys: Vec<usize>,
    pub unknowns: Vec<usize>,
    pub rows: Vec<usize>,
}

impl<'a> View<'a> {
    pub fn new(figure: &'a Figure, tube: &'a ReducedTube) -> Self {
        let layout = &tube.local.y.elimination.layout;
        let of = |list: fn(&Block) -> &[u32]| {
            let blocks = layout.blocks.iter();
            blocks
                .flat_map(|b| list(b)[..b.size].iter().map(|&i| i as usize))
                .collect::<Vec<_>>()
        };
        View {
            figure,
            tube,
            keys: layout.keys.iter().map(|&k| k as usize).collect(),
            unknowns: of(|b| &b.unknowns[..]),
            rows: of(|b| &b.rows[..]),
        }
    }

    /// ẑ(s) and ẑ'(s).
    pub fn at(&self, s: &Big) -> (Vec<Big>, Vec<Big>) {
        at(self.tube, s)
    }

    /// Coefficients of row i, entry l of a series.
    fn series(&self, rows: [&[[f64; LANE]]; 3], i: usize, l: usize) -> [f64; 3] {
        let width = self.tube.local.y.elimination.reduced.width;
        rows.each(|rows| rows[i * width + l / LANE][l % LANE])
    }

    fn k_of(&self, i: usize, l: usize) -> [f64; 3] {
        let y = &self.tube.local.y;
        self.series([&y.elimination.reduced.k, &y.k[0], &y.k[1]], i, l)
    }

    pub fn z_of(&self, e: usize, l: usize) -> [f64; 3] {
        let y = &self.tube.local.y;
        self.series([&y.z[0], &y.z[1], &y.z[2]], e, l)
    }

    /// K(s): a row per unknown of A.
    pub fn k(&self, s: &Big) -> Rows {
        let row = |&i: &usize| {
            let keys = 0..self.keys.len();
            keys.map(|l| horner(&self.k_of(i, l), s)).collect()
        };
        self.unknowns.iter().map(row).collect()
    }

    pub fn k_slope(&self, s: &Big) -> Rows {
        let row = |&i: &usize| {
            let keys = 0..self.keys.len();
            keys.map(|l| horner_slope(&self.k_of(i, l), s)).collect()
        };
        self.unknowns.iter().map(row).collect()
    }

    /// T(s) v, or with `back` its inverse times v.
    pub fn sheared(&self, k: &Rows, v: &[Big], back: bool) -> Vec<Big> {
        let moved: Vec<Big> = self.keys.iter().map(|&key| v[key].clone()).collect();
        let mut out = v.to_vec();
        for (&i, row) in self.unknowns.iter().zip(k) {
            let along = dot(row, &moved);
            out[i] = if back {
                &out[i] - along
            } else {
                &out[i] + along
            };
        }
        out
    }

    /// |v|_ρ.
    pub fn norm(&self, v: &[Big]) -> Big {
        norm(&self.tube.local.y.rho, v)
    }

    /// A(s).
    pub fn a(&self, s: &Big) -> Rows {
        let jacobian = self.figure.jacobian(&self.at(s).0);
        let row = |e: usize| {
            self.unknowns
                .iter()
                .map(|&i| jacobian[e][i].clone())
                .collect()
        };
        self.rows.iter().map(|&e| row(e)).collect()
    }

    /// 𝒴(s) G, G having a row per equation, the normal's last.
    pub fn preconditioned(&self, s: &Big, g: &Rows) -> Option<Rows> {
        let g_a = self.rows.iter().map(|&e| g[e].clone()).collect();
        let inner = solve(self.a(s), g_a)?;
        let mut out = vec![vec![Big::of(0.0); g[0].len()]; self.figure.n];
        for (&i, row) in self.unknowns.iter().zip(inner) {
            out[i] = row;
        }
        for (e, g) in g.iter().enumerate() {
            for (l, &key) in self.keys.iter().enumerate() {
                let z = horner(&self.z_of(e, l), s);
                for (out, g) in out[key].iter_mut().zip(g) {
                    *out += &z * g;
                }
            }
        }
        Some(out)
    }

    /// Φ'(v) = I − 𝒴(s) DG_s(T v) T, as a matrix.
    pub fn derivative(&self, s: &Big, v: &[Big]) -> Option<Rows> {
        let (n, k) = (self.figure.n, self.k(s));
        let w = self.sheared(&k, v, false);
        let z: Vec<Big> = self.at(s).0.iter().zip(&w).map(|(z, w)| z + w).collect();
        let mut rows = self.figure.bordered(&z, &self.tube.local.normal);
        for row in &mut rows {
            for (&i, k) in self.unknowns.iter().zip(&k) {
                if row[i] == Big::of(0.0) {
                    continue;
                }
                let entry = row[i].clone();
                for (k, &key) in k.iter().zip(&self.keys) {
                    row[key] += &entry * k;
                }
            }
        }
        let product = self.preconditioned(s, &rows)?;
        assert_eq!(product.len(), n);
        Some(identity_minus(product))
    }

    /// |M|_ρ.
    pub fn norm_of(&self, m: &Rows) -> Big {
        norm_of(&self.tube.local.y.rho, m)
    }

    /// A point in the box of the given size.
    pub fn in_box(&self, random: &mut Random, size: f64) -> Vec<Big> {
        in_box(random, &self.tube.local.y.rho[..self.figure.n], size)
    }
}
