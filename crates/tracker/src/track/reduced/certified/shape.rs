//! The box |v| ≤ ρ in which a tube is proved, and |w| = |T(s) v| in it.

use super::frame::{Reduction, SERIES};
use super::sides::{PerKey, Sides, row_of, weigh};
use crate::interval::rounding::round_up;
use crate::linalg::rstructure::{Lane, MAX_KEYS, Row};
use crate::linalg::{LANE, Vector};
use crate::places::Each as _;
use crate::track::full::Equations;
use crate::track::reduced::structure::layout::Layout;

/// The box of A's unknowns is so much larger than what was found to be needed.
const ROOM: f64 = 2.5;
/// For what is left of F at a point the box has to be larger, as the defect may be an eighth of it at
/// most where the rest is small (`Contraction`).
const ROOM_FOR_ROUNDING: f64 = 10.0;
/// The box of A's unknowns is at least this part of how far the key unknowns' box moves them.
const LEAST: f64 = 0.25;
/// Unknowns that no key unknown moves count as if one did, by this part of the most that any is moved.
const STILL: f64 = 0.01;
/// The smallest weight of a key unknown beside the largest, 1.
const MIN_WEIGHT: f64 = 0.05;

/// By unknown, t included.
#[derive(Debug)]
pub struct Shape {
    /// Weights of key unknowns for the next tube, and those to return to.
    pub weights: Vector,
    pub kept: Vector,
    /// |K_i| hⁱ times the key unknowns' weights.
    pub moved: [Vector; SERIES + 1],
    /// Their sum, then a bound on |w|.
    pub omega: Vector,
    /// ρ; A's part of it.
    pub rho: Vector,
    pub rho_a: Vector,
}

impl Shape {
    /// Room for one.
    pub fn new(equations: &Equations) -> Self {
        let mut weights = equations.vector();
        weights[..equations.n()].fill(1.0);
        Shape {
            kept: weights.clone(),
            weights,
            moved: std::array::from_fn(|_| equations.vector()),
            omega: equations.vector(),
            rho: equations.vector(),
            rho_a: equations.vector(),
        }
    }

    /// Keeps the weights.
    pub fn keep(&mut self) {
        self.kept.copy_from_slice(&self.weights);
    }

    /// Returns to the weights that were kept.
    pub fn restore(&mut self) {
        self.weights.copy_from_slice(&self.kept);
    }

    /// The weights of the key unknowns.
    pub fn kappa<const W: usize>(&self, layout: &Layout) -> Row<W> {
        let mut kappa: PerKey = [0.0; MAX_KEYS];
        for (kappa, &key) in kappa.iter_mut().zip(&layout.keys) {
            *kappa = self.weights[key as usize];
        }
        row_of(&kappa)
    }

    /// What key unknowns of the given weights take along for |s| ≤ h; and bounds on |K(s)|, |K'(s)| and
    /// |Z(s)| there, into the frame.
    pub fn measure<const W: usize>(&mut self, y: &mut Reduction, kappa: &Row<W>, h: f64) {
        let n = self.weights.len() - 1;
        let h2 = h * h;
        let resize = |rows: &mut Vec<Lane>, count: usize| rows.resize(count * W, [0.0; LANE]);
        resize(&mut y.k_size, n + 1);
        resize(&mut y.k_slope, n + 1);
        resize(&mut y.z_size, n);
        let [k0, k1, k2] =
            [&y.elimination.reduced.k, &y.k[0], &y.k[1]].each(|k| &k.as_chunks::<W>().0[..n]);
        let sizes = &mut y.k_size.as_chunks_mut::<W>().0[..n];
        let slopes = &mut y.k_slope.as_chunks_mut::<W>().0[..n];
        let [m0, m1, m2] = self.moved.each_mut().map(|moved| &mut moved[..n]);
        let omega = &mut self.omega[..n];
        for i in 0..n {
            m0[i] = weigh(&k0[i], kappa);
            m1[i] = h * weigh(&k1[i], kappa);
            m2[i] = h2 * weigh(&k2[i], kappa);
            omega[i] = m0[i] + m1[i] + m2[i];
            for w in 0..W {
                let (k0, k1, k2) = (&k0[i][w], &k1[i][w], &k2[i][w]);
                for l in 0..LANE {
                    let (k0, k1, k2) = (k0[l].abs(), k1[l].abs(), k2[l].abs());
                    sizes[i][w][l] = up(k0 + h * k1 + h2 * k2);
                    slopes[i][w][l] = up(k1 + 2.0 * h * k2);
                }
            }
        }
        let [z0, z1, z2] = y.z.each_ref().each(|z| &z.as_chunks::<W>().0[..n]);
        let sizes = &mut y.z_size.as_chunks_mut::<W>().0[..n];
        for e in 0..n {
            for w in 0..W {
                let (z0, z1, z2) = (&z0[e][w], &z1[e][w], &z2[e][w]);
                for l in 0..LANE {
                    let (z0, z1, z2) = (z0[l].abs(), z1[l].abs(), z2[l].abs());
                    sizes[e][w][l] = up(z0 + h * z1 + h2 * z2);
                }
            }
        }
    }

    /// The box, the key unknowns' being `scale` times their weights, from what `sides` say that A's
    /// unknowns need: what does not get smaller with the box, what does, what does twice, and again what
    /// does not.
    pub fn fill(&mut self, layout: &Layout, sides: &Sides, scale: f64) {
        let n = self.weights.len() - 1;
        let still = STILL * self.omega[..n].iter().fold(0.0, |max: f64, &u| max.max(u));
        self.rho_a.fill(0.0);
        for &key in &layout.keys {
            self.rho[key as usize] = scale * self.weights[key as usize];
        }
        for block in &layout.blocks {
            for c in 0..block.size {
                let i = block.unknowns[c] as usize;
                let [low, cubic, width, high] = sides.a[block.start + c];
                let need = scale * (cubic + scale * width) + high;
                self.rho_a[i] = ROOM * need
                    + ROOM_FOR_ROUNDING * low
                    + LEAST * scale * self.omega[i].max(still);
                self.rho[i] = self.rho_a[i];
            }
        }
        for (omega, rho_a) in self.omega[..n].iter_mut().zip(&self.rho_a[..n]) {
            *omega = round_up(scale * *omega + rho_a, 2 * MAX_KEYS + 20);
        }
    }

    /// Weights for the next tube: towards those for which the width is the same in every key
    /// unknown; A's unknowns, which may be key later, have theirs from the box.
    pub fn set_next_weights(&mut self, layout: &Layout, kappa: &[f64], width: &[f64]) {
        let largest = width.iter().fold(f64::MIN_POSITIVE, |max, &w| max.max(w));
        let mut top = 0.0f64;
        for (i, &key) in layout.keys.iter().enumerate() {
            let weight = (kappa[i] * (width[i] / largest)).sqrt().max(MIN_WEIGHT);
            self.weights[key as usize] = weight;
            top = top.max(weight);
        }
        let widest = layout.keys.iter().fold(f64::MIN_POSITIVE, |max, &key| {
            max.max(self.omega[key as usize])
        });
        for block in &layout.blocks {
            for &unknown in &block.unknowns[..block.size] {
                let i = unknown as usize;
                self.weights[i] = top * (self.omega[i] / widest).clamp(MIN_WEIGHT, 1.0);
            }
        }
        let n = self.weights.len() - 1;
        for weight in &mut self.weights[..n] {
            *weight = (*weight / top).max(MIN_WEIGHT);
        }
    }
}

/// Rounds sums of three products of at most three factors up.
#[inline(always)]
fn up(sum: f64) -> f64 {
    round_up(sum, 6)
}
