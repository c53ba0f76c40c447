//! The frame of a tube in the reduced space: which box was proved, and in which coordinates.

use super::COEFFICIENTS;
use super::resolvent::Resolvent;
use crate::interval::rounding::{largest, round_up};
use crate::linalg::{LANE, Singular, Vector};
use crate::track::certified::link::{Frame, Tube};
use crate::track::certified::proof::Proof;
use crate::track::full::{Differences, Equations, Lengths, Local, Preconditioner};
use crate::track::reduced::structure::elimination::{Elimination, MAX_KEYS, Maker};
use crate::track::reduced::structure::passes::{Lane, with_width};
use std::cell::RefCell;

/// The degree of K(s), Z(s) in s.
pub const SERIES: usize = 2;

/// A tube of this space, and its polynomial.
pub type Tubes<const D: usize> = Tube<D, COEFFICIENTS, Reduction<D>>;
/// See [`Tubes`].
pub type Locals<const D: usize> = Local<D, COEFFICIENTS, Reduction<D>>;

/// Everything that a tube keeps: see `test.rs` for what it means.
#[derive(Debug, Clone)]
pub struct Reduction<const D: usize> {
    pub elimination: Elimination<D>,
    /// K₁, K₂; K₀ is the elimination's. A row per unknown and one of zeros.
    pub k: [Vec<Lane>; SERIES],
    /// Z₀, Z₁, Z₂: a row per equation, the normal's last.
    pub z: [Vec<Lane>; SERIES + 1],
    /// Bounds on |K(s)|, |K'(s)| and |Z(s)| over the tube.
    pub k_size: Vec<Lane>,
    pub k_slope: Vec<Lane>,
    pub z_size: Vec<Lane>,
    /// The box |v| ≤ ρ, by unknown.
    pub rho: Vector,
    pub resolvent: Resolvent<D>,
    /// How fast the extent of a fixed point changes with s.
    pub speed: f64,
    /// Work space: where a point is, and how well that is known.
    scratch: RefCell<[Vector; 2]>,
}

impl<const D: usize> Preconditioner<D> for Reduction<D> {
    type Maker = Maker<D>;
    const FRESH: bool = true;

    fn new(equations: &Equations<D>) -> Self {
        Reduction {
            elimination: Elimination::new(equations),
            k: Default::default(),
            z: Default::default(),
            k_size: Vec::new(),
            k_slope: Vec::new(),
            z_size: Vec::new(),
            rho: equations.vector(),
            resolvent: Resolvent::new(equations),
            speed: 0.0,
            scratch: RefCell::new(std::array::from_fn(|_| equations.vector())),
        }
    }

    fn make(
        &mut self,
        maker: &mut Maker<D>,
        equations: &Equations<D>,
        at: (&Differences<D>, &Lengths, &Vector),
    ) -> Result<bool, Singular> {
        self.elimination.make(maker, equations, at)?;
        Ok(false)
    }

    fn obstacle(&self) -> Option<String> {
        self.elimination.obstacle()
    }

    fn solve(&self, equations: &Equations<D>, f: &[f64], out: &mut Vector) {
        self.elimination.solve(equations, f, out);
    }
}

impl<const D: usize> Reduction<D> {
    fn extent_of<const W: usize>(&self, s: f64, away: &[f64], error: &[f64]) -> f64 {
        let layout = &*self.elimination.layout;
        let mut keys = [[[0.0; LANE]; W]; 2];
        let mut widest = 0.0f64;
        let mut see = |ratio: f64| {
            widest = largest(widest, ratio);
        };
        for (at, &key) in layout.keys.iter().enumerate() {
            let key = key as usize;
            keys[0][at / LANE][at % LANE] = away[key];
            keys[1][at / LANE][at % LANE] = error[key];
            see((away[key].abs() + error[key]) / self.rho[key]);
        }
        let rows = |k: &'_ [Lane], i: usize| -> [Lane; W] {
            k[i * W..(i + 1) * W].try_into().expect("a row")
        };
        let [key_away, key_error] = keys;
        for block in &layout.blocks {
            for &unknown in &block.unknowns[..block.size] {
                let i = unknown as usize;
                let k0 = rows(&self.elimination.k, i);
                let k1 = rows(&self.k[0], i);
                let k2 = rows(&self.k[1], i);
                let bound = rows(&self.k_size, i);
                let (mut moved, mut hidden) = (0.0, 0.0);
                for w in 0..W {
                    for l in 0..LANE {
                        let k = k2[w][l].mul_add(s, k1[w][l]).mul_add(s, k0[w][l]);
                        moved += k * key_away[w][l];
                        // The error of the away's own, and the rounding of this sum.
                        let known = key_error[w][l] + ROUNDING * key_away[w][l].abs();
                        hidden += bound[w][l] * known;
                    }
                }
                let v = (away[i] - moved).abs();
                see((v + error[i] + hidden + ROUNDING * away[i].abs()) / self.rho[i]);
            }
        }
        // Two sums of a product for each key unknown, and what they go through before and after.
        round_up(widest, 2 * MAX_KEYS + 40)
    }

    /// Bounds on |w| = |T(s) v| from bounds on |v|.
    pub fn take_along(&self, v: &[f64], w: &mut [f64]) {
        let layout = &*self.elimination.layout;
        w.copy_from_slice(v);
        let row = self.elimination.width * LANE;
        let sizes = self.k_size.as_flattened();
        for block in &layout.blocks {
            for &unknown in &block.unknowns[..block.size] {
                let i = unknown as usize;
                let k = &sizes[i * row..(i + 1) * row];
                let along: f64 = layout
                    .keys
                    .iter()
                    .zip(k)
                    .map(|(&key, k)| k * v[key as usize])
                    .sum();
                w[i] = round_up(v[i] + along, layout.keys() + 4);
            }
        }
    }
}

/// More than γ of the roundings in one entry of v: at most 8 LANE products, each of a polynomial
/// of degree SERIES; relative to the bound over the tube, see `Reduction::extent_of`.
const ROUNDING: f64 = 200.0 * f64::EPSILON;

impl<const D: usize> Frame<D> for Reduction<D> {
    /// v = T(s)⁻¹ w: the key unknowns' parts as they are, those of A's unknowns less K(s) times them.
    fn extent(&self, _: &[f64], s: f64, mut entry: impl FnMut(usize) -> (f64, f64)) -> f64 {
        let mut scratch = self.scratch.borrow_mut();
        let [away, error] = &mut *scratch;
        let n = away.len() - 1;
        for i in 0..n {
            (away[i], error[i]) = entry(i);
        }
        with_width!(
            self.elimination.width,
            self.extent_of(s, &away[..n], &error[..n])
        )
    }

    fn speed(&self, _: &Proof) -> f64 {
        self.speed
    }
}
