//! The path from one side.

use super::curve::{Curve, draw_signs};
use super::style::{Failure, legend, mesh, picture, plain, px, with_room};
use crate::compare::RecordedPath;
use plotters::prelude::*;

/// The path in two of the free coordinates, with the sketch and the solutions marked, and the steps
/// of the certified run coloured by their length. SVG.
///
/// The coordinates are the one that varies most along the path, and the one that varies most once
/// what follows linearly from the first is taken away. So the projection is a picture of places of
/// points.
pub fn projection(path: &RecordedPath) -> String {
    let curve = Curve::new(path);
    let axes = two_coordinates(path);
    let title = format!("{}: the path, seen in two coordinates", path.problem);
    picture((760, 640), &title, |area| draw(area, path, &curve, axes))
}

fn draw<'a>(
    area: &super::style::Area<'a>,
    path: &RecordedPath,
    curve: &Curve,
    [a, b]: [usize; 2],
) -> Result<(), Failure<'a>> {
    let solutions = format!("solutions, t = 1 ({})", path.solutions.len());
    let body = legend(area, &curve.legend(solutions, "sketch, t = 0"))?;

    let along = |k: usize| with_room(curve.points().map(move |(_, z)| z[k]), 0.05);
    let mut chart = ChartBuilder::on(&body)
        .margin(px(12))
        .x_label_area_size(px(42))
        .y_label_area_size(px(62))
        .build_cartesian_2d(along(a), along(b))?;
    mesh(
        &mut chart,
        (&path.coordinates[a], &plain),
        (&path.coordinates[b], &plain),
    )?;
    curve.draw(&mut chart, |(_, z)| (z[a], z[b]))?;
    let solutions: Vec<(f64, f64)> = path.solutions.iter().map(|s| (s.z[a], s.z[b])).collect();
    let sketch = path.step_ends.iter().take(1).map(|s| (s.z[a], s.z[b]));
    draw_signs(&chart, &solutions, sketch)
}

/// See [`projection`].
fn two_coordinates(path: &RecordedPath) -> [usize; 2] {
    let m = path.coordinates.len();
    let count = path.step_ends.len() as f64;
    let mean = |k: usize| path.step_ends.iter().map(|s| s.z[k]).sum::<f64>() / count;
    let means: Vec<f64> = (0..m).map(mean).collect();
    let covariance = |i: usize, j: usize| -> f64 {
        let terms = path.step_ends.iter();
        terms
            .map(|s| (s.z[i] - means[i]) * (s.z[j] - means[j]))
            .sum()
    };
    let best = |value: &dyn Fn(usize) -> f64| {
        (0..m)
            .max_by(|&i, &j| value(i).total_cmp(&value(j)))
            .unwrap_or(0)
    };
    let first = best(&|k| covariance(k, k));
    let rest = |k: usize| {
        let shared = covariance(first, k).powi(2) / covariance(first, first).max(f64::MIN_POSITIVE);
        covariance(k, k) - shared
    };
    let second = best(&|k| {
        if k == first {
            f64::NEG_INFINITY
        } else {
            rest(k)
        }
    });
    // The one that comes first in the problem goes along the x axis.
    [first.min(second), first.max(second)]
}
