//! Which figures are the same up to rigid motions and reflections.

use super::Solution;
use crate::interval::point;
use crate::interval::vector::{cross, dot, minus};
use crate::places::Each as _;

/// What a float run found, as solutions: thin boxes, with their classes of congruence.
pub fn observed_solutions(figures: Vec<Vec<[f64; 3]>>, tolerance: f64) -> Vec<Solution> {
    let classes = congruence_classes(&figures, tolerance);
    let mirrors: Vec<Option<usize>> = (0..figures.len())
        .map(|k| {
            let same = (0..k).filter(|&j| classes[j] == classes[k]);
            let mut mirrored = same.filter(|&j| is_mirrored(&figures[j], &figures[k]));
            mirrored.next()
        })
        .collect();
    let thin = |((figure, class), mirror_of): ((Vec<[f64; 3]>, usize), Option<usize>)| {
        let points = figure.into_iter().map(|p| p.each(point)).collect();
        Solution {
            mirror_of,
            ..Solution::placed(points, class)
        }
    };
    figures
        .into_iter()
        .zip(classes)
        .zip(mirrors)
        .map(thin)
        .collect()
}

/// Of two congruent figures, whether one is the mirror image of the other and not the other moved: by
/// the sign of the area (in the plane, where all third coordinates are zero) or of the volume that is
/// largest among those spanned by the first point, the one furthest from it, and others.
fn is_mirrored(one: &[[f64; 3]], other: &[[f64; 3]]) -> bool {
    let greatest = |value: &dyn Fn(usize) -> f64| {
        (0..one.len()).max_by(|&i, &j| value(i).abs().total_cmp(&value(j).abs()))
    };
    let from_first = |figure: &[[f64; 3]], i: usize| minus(figure[i], figure[0]);
    let size = |i: usize| dot(from_first(one, i), from_first(one, i));
    let Some(far) = greatest(&size) else {
        return false;
    };
    let normal =
        |figure: &[[f64; 3]], i: usize| cross(from_first(figure, far), from_first(figure, i));
    let area = |i: usize| dot(normal(one, i), normal(one, i));
    let Some(aside) = greatest(&area) else {
        return false;
    };
    let is_flat = |figure: &[[f64; 3]]| figure.iter().all(|p| p[2] == 0.0);
    if is_flat(one) && is_flat(other) {
        return normal(one, aside)[2] * normal(other, aside)[2] < 0.0;
    }
    let volume = |figure: &[[f64; 3]], i: usize| dot(normal(figure, aside), from_first(figure, i));
    let Some(above) = greatest(&|i| volume(one, i)) else {
        return false;
    };
    volume(one, above) * volume(other, above) < 0.0
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

    #[test]
    fn tells_mirror_images_from_moved_figures() {
        let one = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0]];
        let turned = one.each(|[x, y, z]| [-y, x, z]);
        let mirrored = one.each(|[x, y, z]| [x, -y, z]);
        assert!(is_mirrored(&one, &mirrored) && !is_mirrored(&one, &turned));
        let apex = |figure: [[f64; 3]; 3], z| [&figure[..], &[[0.2, 0.3, z]]].concat();
        let (one, other) = (apex(one, 1.0), apex(one, -1.0));
        assert!(is_mirrored(&one, &other) && !is_mirrored(&one, &one));
        let solutions = observed_solutions(vec![one.clone(), other, one], 1e-9);
        let mirrors: Vec<Option<usize>> = solutions.iter().map(|s| s.mirror_of).collect();
        assert_eq!(mirrors, [None, Some(0), Some(1)]);
    }

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
