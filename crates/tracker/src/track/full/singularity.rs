//! Where the path's expansion has its nearest singularities: they set how far it converges, here and ahead.

use super::local::Local;
use super::preconditioner::Preconditioner;
use crate::linalg::{Vector, dot};

/// A pair of singularities 1/x with x² − p x + w = 0, complex conjugate or real.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Singularities {
    p: f64,
    w: f64,
}

impl Singularities {
    /// How far the nearest is from s, relative to how far the nearest is from 0.
    pub fn distance(self, s: f64) -> f64 {
        let Singularities { p, w } = self;
        let discriminant = p * p - 4.0 * w;
        if discriminant < 0.0 {
            // |1/x − s| |x| for each of the two.
            return (1.0 + s * (s * w - p)).max(0.0).sqrt();
        }
        let larger = 0.5 * (p + discriminant.sqrt().copysign(p));
        let smaller = w / larger;
        let away = |x: f64| ((1.0 - s * x) * (larger / x)).abs();
        away(larger).min(away(smaller))
    }
}

impl<const N: usize, Y: Preconditioner> Local<N, Y> {
    /// The nearest singularities, in least squares from the last coefficients.
    ///
    /// Near a square root's branch point at distance ρ the coefficients are like k^(−3/2) ρ^(−k), times the
    /// cosine of k φ for a pair at angles ±φ: y_k = k^(3/2) z_k then is p y_{k−1} − w y_{k−2} (Hunter and
    /// Guerrieri, SIAM J. Appl. Math. 39, 1980).
    pub fn singularities(&self) -> Singularities {
        const TERMS: usize = 3;
        const {
            assert!(
                N > TERMS + 2,
                "the first of the equations goes back two more"
            )
        };
        let n = self.z[0].len() - 1;
        // y_{N−1−i}·y_{N−1−i−j}
        let mut products = [[0.0; 3]; TERMS + 2];
        for (i, row) in products.iter_mut().enumerate() {
            for (j, product) in row.iter_mut().enumerate().take(TERMS + 2 - i) {
                let (a, b) = (N - 1 - i, N - 1 - i - j);
                let weight = (a * b) as f64;
                *product = weight * weight.sqrt() * dot(&self.z[a][..n], &self.z[b][..n]);
            }
        }
        // The scale in which the first and the last of them are of the same size.
        let ratio = products[TERMS + 1][0] / products[0][0];
        let scale = ratio.powf(-1.0 / (TERMS + 1) as f64);
        let (mut g11, mut g12, mut g22, mut r1, mut r2) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let mut f = 1.0;
        for i in 0..TERMS {
            g11 += f * products[i + 1][0];
            g12 -= f * products[i + 1][1];
            g22 += f * products[i + 2][0];
            r1 += f * products[i][1];
            r2 -= f * products[i][2];
            f *= scale;
        }
        let determinant = g11 * g22 - g12 * g12;
        Singularities {
            p: (r1 * g22 - r2 * g12) / determinant,
            w: (g11 * r2 - g12 * r1) / determinant,
        }
    }

    /// |z_ORDER|^(1/(ORDER − 1)): the inverse of a length, of the order of the radius of convergence.
    pub fn last_root(&self) -> f64 {
        let n = self.z[0].len() - 1;
        dot(&self.z[N - 1][..n], &self.z[N - 1][..n]).powf(0.5 / (N - 2) as f64)
    }

    /// How fast the path moves at s, as far as the polynomial knows; `room` for a vector.
    pub fn speed(&self, s: f64, room: &mut Vector) -> f64 {
        let n = self.z[0].len() - 1;
        self.slope(s, room);
        dot(&room[..n], &room[..n]).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::system::Homotopy;
    use crate::track::full::Equations;
    use nalgebra::Complex;
    use std::path::Path;

    /// What the coefficients k^(−3/2) Re(a xᵏ) tell, the amplitudes a differing from entry to entry.
    fn seen(poles: [Complex<f64>; 2]) -> Singularities {
        let problem = Problem::read(Path::new("../../problems/octahedron.toml")).unwrap();
        let equations = Equations::new(&Homotopy::new(&problem).unwrap());
        let mut local = Local::<9>::new(&equations);
        for k in 1..9 {
            for i in 0..equations.n() {
                let (a, b) = ((i as f64).sin(), (i as f64).cos());
                let y = if poles[0].im == 0.0 {
                    a * poles[0].re.powi(k) + b * poles[1].re.powi(k)
                } else {
                    (Complex::new(a, b) * poles[0].powi(k)).re
                };
                local.z[k as usize][i] = y * f64::from(k).powf(-1.5);
            }
        }
        local.singularities()
    }

    #[test]
    fn singularities_are_found() {
        let complex = Complex::new(0.8, 1.3);
        let pairs = [
            [complex, complex.conj()],
            [Complex::new(-1.7, 0.0), Complex::new(0.9, 0.0)],
        ];
        for pair in pairs {
            let seen = seen(pair);
            let nearest = |s: f64| {
                let away = pair.map(|x| (1.0 / x - s).norm_sqr().sqrt());
                away[0].min(away[1])
            };
            for s in [0.0, 0.3, -0.5, 0.7, 2.0] {
                let (got, want) = (seen.distance(s), nearest(s) / nearest(0.0));
                assert!((got - want).abs() < 1e-9, "{pair:?} at {s}: {got} {want}");
            }
        }
    }
}
