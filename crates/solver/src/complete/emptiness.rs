//! Why there is no figure, where that can be said in words.

use super::targets::Targets;

/// A distance that is longer than a way between its ends: its index, and the points along the way.
pub fn too_long(targets: &Targets) -> Option<(usize, Vec<usize>)> {
    let n = targets.points;
    let mut most = vec![f64::INFINITY; n * n];
    let mut through = vec![usize::MAX; n * n];
    for (edge, length) in targets.edges.iter().zip(&targets.lengths) {
        let [a, b] = *edge;
        most[a * n + b] = length.sup();
        most[b * n + a] = length.sup();
    }
    for k in 0..n {
        for a in 0..n {
            for b in 0..n {
                // Rounded up: a way is surely not longer than this.
                let way = (most[a * n + k] + most[k * n + b]).next_up();
                if k != a && k != b && way < most[a * n + b] {
                    most[a * n + b] = way;
                    through[a * n + b] = k;
                }
            }
        }
    }
    let found = (0..targets.edges.len()).find(|&e| {
        let [a, b] = targets.edges[e];
        targets.lengths[e].inf() > most[a * n + b]
    })?;
    let [a, b] = targets.edges[found];
    let mut way = vec![a];
    unfold(&through, n, a, b, &mut way);
    Some((found, way))
}

/// Appends the points after `a` on the way to `b`.
fn unfold(through: &[usize], n: usize, a: usize, b: usize, way: &mut Vec<usize>) {
    match through[a * n + b] {
        usize::MAX => way.push(b),
        k => {
            unfold(through, n, a, k, way);
            unfold(through, n, k, b, way);
        }
    }
}
