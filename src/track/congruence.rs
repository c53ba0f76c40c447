//! Which figures are the same up to rigid motions and reflections.

use super::Solution;
use crate::interval::point;

/// What a float run found, as solutions: thin boxes, with their classes of congruence.
pub fn observed_solutions(figures: Vec<Vec<[f64; 3]>>, tolerance: f64) -> Vec<Solution> {
    let classes = congruence_classes(&figures, tolerance);
    let thin = |(figure, class): (Vec<[f64; 3]>, usize)| Solution {
        points: figure.into_iter().map(|p| p.map(point)).collect(),
        class,
        width: 0.0,
    };
    figures.into_iter().zip(classes).map(thin).collect()
}

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
    // The first figure of each class, as distances.
    let mut classes: Vec<Vec<f64>> = Vec::new();
    figures
        .iter()
        .map(|figure| {
            let distances = distances(figure);
            let found = classes
                .iter()
                .position(|known| agree(known, &distances, tolerance));
            found.unwrap_or_else(|| {
                classes.push(distances);
                classes.len() - 1
            })
        })
        .collect()
}

fn distances(figure: &[[f64; 3]]) -> Vec<f64> {
    let mut out = Vec::with_capacity(figure.len() * figure.len() / 2);
    for (k, a) in figure.iter().enumerate() {
        for b in &figure[..k] {
            out.push(
                (0..3)
                    .map(|axis| (a[axis] - b[axis]).powi(2))
                    .sum::<f64>()
                    .sqrt(),
            );
        }
    }
    out
}

fn agree(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    let size = a.iter().chain(b).fold(0.0f64, |size, &x| size.max(x));
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(x, y)| (x - y).abs() <= tolerance * size)
}
