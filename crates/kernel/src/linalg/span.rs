//! Which of some vectors say something new, one after the other, in floats.

/// A vector says something new where so much of it, made a unit vector, is left over from those before.
const NEW: f64 = 1e-3;

/// An orthonormal basis of the vectors taken so far.
#[derive(Debug, Clone, Default)]
pub struct Span(Vec<Vec<f64>>);

impl Span {
    /// How many independent vectors were taken.
    pub fn rank(&self) -> usize {
        self.0.len()
    }

    /// Takes vectors that belong together, if each says something new beside those before; otherwise none of them.
    pub fn take(&mut self, vectors: impl IntoIterator<Item = Vec<f64>>) -> bool {
        let before = self.0.len();
        for mut left in vectors {
            normalise(&mut left);
            // Twice, so that what is left is at right angles to all.
            for _ in 0..2 {
                for other in &self.0 {
                    let along: f64 = left.iter().zip(other).map(|(a, b)| a * b).sum();
                    left.iter_mut()
                        .zip(other)
                        .for_each(|(a, b)| *a -= along * b);
                }
            }
            if normalise(&mut left) < NEW {
                self.0.truncate(before);
                return false;
            }
            self.0.push(left);
        }
        true
    }
}

/// Makes a vector one of length 1; its length before.
fn normalise(x: &mut [f64]) -> f64 {
    let size = x.iter().map(|a| a * a).sum::<f64>().sqrt();
    if size > 0.0 {
        x.iter_mut().for_each(|a| *a /= size);
    }
    size
}
