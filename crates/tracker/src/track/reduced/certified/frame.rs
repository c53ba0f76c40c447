//! The frame of a tube in the reduced space: which box was proved, and in which coordinates.

use super::COEFFICIENTS;
use super::resolvent::Resolvent;
use crate::interval::rounding::{largest, round_up};
use crate::linalg::rstructure::{Lane, MAX_KEYS, with_width};
use crate::linalg::{LANE, Singular, Vector};
use crate::track::certified::link::{Frame, Tube};
use crate::track::certified::proof::Proof;
use crate::track::full::{Differences, Equations, Lengths, Local, Preconditioner};
use crate::track::reduced::structure::elimination::{Elimination, Maker};

/// The degree of K(s), Z(s) in s.
pub const SERIES: usize = 2;

/// A tube of this space, and its polynomial.
pub type Tubes = Tube<COEFFICIENTS, Reduction>;
/// See [`Tubes`].
pub type Locals = Local<COEFFICIENTS, Reduction>;

/// Everything that a tube keeps: see `test.rs` for what it means.
#[derive(Debug, Clone)]
pub struct Reduction {
    pub elimination: Elimination,
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
    pub resolvent: Resolvent,
    /// How fast the extent of a fixed point changes with s.
    pub speed: f64,
}

impl Preconditioner for Reduction {
    type Maker = Maker;
    const FRESH: bool = true;

    fn new(equations: &Equations) -> Self {
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
        }
    }

    fn make(
        &mut self,
        maker: &mut Maker,
        equations: &Equations,
        at: (&Differences, &Lengths, &Vector),
    ) -> Result<bool, Singular> {
        self.elimination.make(maker, equations, at)?;
        Ok(false)
    }

    fn obstacle(&self) -> Option<String> {
        self.elimination.obstacle()
    }

    fn solve(&self, equations: &Equations, f: &[f64], out: &mut Vector) {
        self.elimination.solve(equations, f, out);
    }
}

impl Reduction {
    fn extent_of<const W: usize>(
        &self,
        n: usize,
        s: f64,
        known: impl Fn(usize) -> (f64, f64),
        mut entry: impl FnMut(usize) -> (f64, f64),
    ) -> f64 {
        let layout = &*self.elimination.layout;
        let mut keys = [[[0.0; LANE]; W]; 2];
        for (at, &key) in layout.keys.iter().enumerate() {
            let (away, error) = known(key as usize);
            keys[0][at / LANE][at % LANE] = away;
            keys[1][at / LANE][at % LANE] = error;
        }
        let rows = |k: &'_ [Lane], i: usize| -> [Lane; W] {
            k[i * W..(i + 1) * W].try_into().expect("a row")
        };
        let [key_away, key_error] = keys;
        let mut widest = 0.0f64;
        for i in 0..n {
            let (away, error) = entry(i);
            if layout.keys.contains(&(i as u32)) {
                widest = largest(widest, (away.abs() + error) / self.rho[i]);
                continue;
            }
            let k0 = rows(&self.elimination.reduced.k, i);
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
            let v = (away - moved).abs();
            let v = v + error + hidden + ROUNDING * away.abs();
            widest = largest(widest, v / self.rho[i]);
        }
        // Two sums of a product for each key unknown, and what they go through before and after.
        round_up(widest, 2 * MAX_KEYS + 40)
    }

    /// Bounds on |w| = |T(s) v| from bounds on |v|.
    pub fn bound_unsheared(&self, v: &[f64], w: &mut [f64]) {
        let layout = &*self.elimination.layout;
        w.copy_from_slice(v);
        let row = self.elimination.reduced.width * LANE;
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

impl Frame for Reduction {
    /// v = T(s)⁻¹ w: the key unknowns' parts as they are, those of A's unknowns less K(s) times them.
    fn extent(
        &self,
        weights: &[f64],
        s: f64,
        known: impl Fn(usize) -> (f64, f64),
        entry: impl FnMut(usize) -> (f64, f64),
    ) -> f64 {
        with_width!(
            self.elimination.reduced.width,
            self.extent_of(weights.len(), s, known, entry)
        )
    }

    fn speed(&self, _: &Proof) -> f64 {
        self.speed
    }
}
