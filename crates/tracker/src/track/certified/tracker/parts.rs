//! What a certificate claims of tubes in the reduced space.
//!
//! A checker proves tubes in full coordinates, with polynomials of degree 5 and boxes |w|_u ≤ r. Tubes of the reduced space were
//! proved with polynomials of degree 8 and boxes that are sheared along with the key unknowns, and are often too long
//! for that. So each is told in parts, which are tubes of their own, as long as the witness says that a checker proves them.

use crate::linalg::Vector;
use crate::track::{TubeSeen, Witness};

/// Parts claim so much of the tube's radius: less of the box |w|_u ≤ r is outside of the sheared one that was proved.
const RADII: [f64; 2] = [0.3, 0.08];
/// Weights of parts are at least so much: a checker bounds the point where the path leaves a tube by one number for all entries,
/// and where weights differ by more the next tube is too narrow in some entry to hold it.
pub const LEAST_WEIGHT: f64 = 1.0 / 64.0;
/// The first order that polynomials of degree 5 leave out, and how much of the radius it may move a part's path.
pub const LEFT_OUT: usize = 6;
const REST: f64 = 0.1;
/// So many parts are tried first, at least and at most; and they are halved so often.
const LEAST: f64 = 2.0;
const MOST: f64 = 64.0;
const HALVINGS: usize = 6;
/// A part reaches so many times as far from its middle as its exit.
const LAP: f64 = 1.05;

/// A tube of the reduced space that is told in parts.
pub struct Parts<'a> {
    /// All of it.
    pub tube: TubeSeen<'a>,
    /// ẑ(s).
    pub at: &'a dyn Fn(f64, &mut Vector),
    /// Room for a point.
    pub centre: Vector,
    /// To be told behind the first part.
    pub solutions: Vec<(&'a [f64], Vec<f64>)>,
}

impl Parts<'_> {
    /// Tells the tube between two parameters. `coefficient` is that of s to the power of LEFT_OUT.
    pub fn tell(&mut self, witness: &mut dyn Witness, (from, to): (f64, f64), coefficient: &[f64]) {
        let half = 0.5 * (to - from);
        let sizes = coefficient.iter().zip(self.tube.weights);
        let away = sizes.fold(0.0, |max: f64, (z, u)| max.max(z.abs() / u));
        let ratio = away * half.powi(LEFT_OUT as i32) / (REST * RADII[0] * self.tube.r);
        let count = ratio.powf(1.0 / LEFT_OUT as f64).ceil().clamp(LEAST, MOST);
        let cut = |k: usize| from + 2.0 * half * (k as f64 / count);
        for k in 0..count as usize {
            self.tell_part(witness, (cut(k), cut(k + 1)), HALVINGS);
        }
    }

    fn tell_part(&mut self, witness: &mut dyn Witness, (from, to): (f64, f64), halvings: usize) {
        let (n, half) = (self.tube.centre.len(), 0.5 * (to - from));
        let middle = from + half;
        (self.at)(middle, &mut self.centre);
        for radius in RADII {
            let part = TubeSeen {
                centre: &self.centre[..n],
                h: LAP * half,
                exit: half,
                r: radius * self.tube.r,
                ..self.tube
            };
            if halvings == 0 || witness.is_provable(&part) {
                witness.tube(part);
                for (centre, radius) in self.solutions.drain(..) {
                    witness.solution(centre, &radius);
                }
                return;
            }
        }
        self.tell_part(witness, (from, middle), halvings - 1);
        self.tell_part(witness, (middle, to), halvings - 1);
    }
}
