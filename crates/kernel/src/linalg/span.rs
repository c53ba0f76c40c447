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
        self.take_if(NEW, vectors)
    }

    /// Takes of some vectors, until there are `most`, those that say something new: first, in their order, those of which a tenth is new,
    /// then those of which a hundredth is, and so on, so that no equation is used that nearly follows from the others where another would do.
    /// Which of them were taken.
    pub fn choose(&mut self, vectors: &[Vec<f64>], most: usize) -> Vec<bool> {
        let mut is_taken = vec![false; vectors.len()];
        for least in [0.1, 0.01, NEW] {
            for (vector, is_taken) in vectors.iter().zip(&mut is_taken) {
                if !*is_taken && self.rank() < most {
                    *is_taken = self.take_if(least, [vector.clone()]);
                }
            }
        }
        is_taken
    }

    fn take_if(&mut self, least: f64, vectors: impl IntoIterator<Item = Vec<f64>>) -> bool {
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
            if normalise(&mut left) < least {
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
