//! Distances in figures of floating-point numbers, and what tells figures apart.

/// How far apart two points of a figure are.
pub fn distance(at: &[[f64; 3]], [a, b]: [usize; 2]) -> f64 {
    let squared: f64 = (0..3).map(|k| (at[a][k] - at[b][k]).powi(2)).sum();
    squared.sqrt()
}

/// Whether all points of two figures are as far apart.
pub fn are_congruent(one: &[[f64; 3]], other: &[[f64; 3]], tolerance: f64) -> bool {
    let mut pairs = (0..one.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    pairs.all(|pair| (distance(one, pair) - distance(other, pair)).abs() < tolerance)
}
