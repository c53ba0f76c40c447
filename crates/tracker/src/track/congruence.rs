//! Which figures are the same up to rigid motions and reflections.

/// Classes of figures that are congruent up to reflection: for each figure the number of its
/// class, counted from 0 in order of first occurrence.
///
/// Figures are congruent if and only if all distances between their points agree. Here they agree
/// if they differ by at most `tolerance` times the larger figure's largest distance: a
/// floating-point observation.
///
/// ```
/// use krawl::track::congruence_classes;
/// let figure = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.7, 0.0]];
/// let mirrored = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, -0.7, 0.0]];
/// let other = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.7, 0.0]];
/// assert_eq!(congruence_classes(&[figure, other, mirrored], 1e-8), [0, 1, 0]);
/// ```
pub fn congruence_classes(figures: &[Vec<[f64; 3]>], tolerance: f64) -> Vec<usize> {
    // The first figure of each class.
    let mut classes: Vec<(&[[f64; 3]], Spread)> = Vec::new();
    figures
        .iter()
        .map(|figure| {
            let spread = Spread::of(figure);
            let found = classes.iter().position(|(known, known_spread)| {
                known_spread.may_agree(&spread, figure.len(), tolerance)
                    && agree(known, figure, tolerance)
            });
            found.unwrap_or_else(|| {
                classes.push((figure, spread));
                classes.len() - 1
            })
        })
        .collect()
}

/// What tells most figures apart in time proportional to their points.
struct Spread {
    /// The sum of all squared distances.
    squares: f64,
    /// No distance is larger.
    largest: f64,
}

impl Spread {
    fn of(figure: &[[f64; 3]]) -> Self {
        let n = figure.len() as f64;
        let mut centre = [0.0; 3];
        for p in figure {
            for axis in 0..3 {
                centre[axis] += p[axis] / n;
            }
        }
        let squares = figure.iter().map(|p| squared_distance(p, &centre));
        Spread {
            // Lagrange's identity.
            squares: n * squares.clone().sum::<f64>(),
            largest: 2.0 * squares.fold(0.0, f64::max).sqrt(),
        }
    }

    /// False only where the sums differ by more than they can if all distances agree, and by more
    /// than rounding.
    fn may_agree(&self, other: &Spread, points: usize, tolerance: f64) -> bool {
        let largest = self.largest.max(other.largest);
        let pairs = (points * points) as f64 / 2.0;
        let most = 2.0 * largest * (tolerance * largest) * pairs;
        (self.squares - other.squares).abs() <= most + 1e-12 * (self.squares + other.squares)
    }
}

fn agree(a: &[[f64; 3]], b: &[[f64; 3]], tolerance: f64) -> bool {
    let size = squared_distances(a)
        .chain(squared_distances(b))
        .fold(0.0, f64::max)
        .sqrt();
    a.len() == b.len()
        && squared_distances(a)
            .zip(squared_distances(b))
            .all(|(x, y)| (x.sqrt() - y.sqrt()).abs() <= tolerance * size)
}

fn squared_distances(figure: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    figure
        .iter()
        .enumerate()
        .flat_map(|(k, a)| figure[..k].iter().map(move |b| squared_distance(a, b)))
}

fn squared_distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The quick test never parts what the slow one joins.
        #[test]
        fn quick_and_slow_agree(
            figure in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 2..9),
            moved in prop::array::uniform3(-3.0f64..3.0),
            angle in -3.0f64..3.0,
            noise in 0.0f64..2e-6,
            seed in any::<u8>(),
        ) {
            let (sin, cos) = angle.sin_cos();
            let mut sign = f64::from(seed);
            let other: Vec<[f64; 3]> = figure
                .iter()
                .map(|p| {
                    sign = (12.9898 * sign + 1.0).sin() * 437.5;
                    let off = noise * sign.fract();
                    [
                        cos * p[0] - sin * p[1] + moved[0] + off,
                        sin * p[0] + cos * p[1] + moved[1],
                        moved[2] - p[2],
                    ]
                })
                .collect();
            let slow = agree(&figure, &other, 1e-6);
            let classes = congruence_classes(&[figure, other], 1e-6);
            prop_assert_eq!(classes == [0, 0], slow);
        }
    }
}
