//! The path's curve between its stations, and the sizes of its steps.

use super::style::{CLASSES, Entry, SCALE, Sign, size_colour};
use crate::compare::{PathStation, RecordedPath};
use plotters::style::RGBColor;

/// Pieces of the path of the same colour, as points (length of path, free coordinates and t).
pub struct Curve {
    /// The size class of a piece and its points.
    pub pieces: Vec<(usize, Vec<(f64, Vec<f64>)>)>,
    bounds: Vec<f64>,
    stations: usize,
}

/// So many points are drawn at most, beside the stations.
const POINTS: usize = 6000;

impl Curve {
    /// Cubics through the stations, in as many colours as there are classes of steps.
    pub fn new(path: &RecordedPath) -> Self {
        let steps: Vec<f64> = path
            .stations
            .windows(2)
            .map(|w| w[1].at - w[0].at)
            .collect();
        let bounds = bounds_of(&steps);
        let parts = (POINTS / steps.len().max(1)).clamp(1, 24);
        let mut pieces: Vec<(usize, Vec<(f64, Vec<f64>)>)> = Vec::new();
        for (ends, &step) in path.stations.windows(2).zip(&steps) {
            let class = bounds.iter().filter(|&&bound| step > bound).count();
            let points = (1..=parts).map(|k| between(&ends[0], &ends[1], k as f64 / parts as f64));
            match pieces.last_mut() {
                Some((last, known)) if *last == class => known.extend(points),
                _ => {
                    let first = (ends[0].at, ends[0].z.clone());
                    pieces.push((class, std::iter::once(first).chain(points).collect()));
                }
            }
        }
        Curve {
            pieces,
            bounds,
            stations: path.stations.len(),
        }
    }

    /// All points.
    pub fn points(&self) -> impl Iterator<Item = &(f64, Vec<f64>)> {
        self.pieces.iter().flat_map(|(_, points)| points)
    }

    /// How wide to draw it: long paths finely.
    pub fn width(&self) -> u32 {
        if self.stations > 2000 {
            SCALE
        } else {
            2 * SCALE
        }
    }

    /// What the colours mean.
    pub fn legend(&self) -> Vec<Entry> {
        let number = |x: f64| format!("{x:.2}");
        (0..=self.bounds.len())
            .map(|class| {
                let text = match (
                    class.checked_sub(1).map(|k| self.bounds[k]),
                    self.bounds.get(class),
                ) {
                    (None, None) => "all steps".to_owned(),
                    (None, Some(high)) => format!("steps up to {}", number(*high)),
                    (Some(_), Some(high)) => format!("to {}", number(*high)),
                    (Some(low), None) => format!("above {}", number(low)),
                };
                Entry {
                    sign: Sign::Line(self.colour(class)),
                    text,
                }
            })
            .collect()
    }

    /// The colour of a class.
    pub fn colour(&self, class: usize) -> RGBColor {
        size_colour(class)
    }
}

/// Quantiles of the steps: every class has as many.
fn bounds_of(steps: &[f64]) -> Vec<f64> {
    let mut sorted = steps.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut bounds: Vec<f64> = (1..CLASSES)
        .filter_map(|k| sorted.get(k * sorted.len() / CLASSES).copied())
        .collect();
    bounds.dedup();
    bounds
}

/// Hermite's cubic between two stations.
fn between(from: &PathStation, to: &PathStation, u: f64) -> (f64, Vec<f64>) {
    let h = to.at - from.at;
    let (v, w) = (u * u, u * u * u);
    let (a, b) = (2.0 * w - 3.0 * v + 1.0, 3.0 * v - 2.0 * w);
    let (c, d) = (h * (w - 2.0 * v + u), h * (w - v));
    let z = (0..from.z.len())
        .map(|k| a * from.z[k] + b * to.z[k] + c * from.direction[k] + d * to.direction[k]);
    (from.at + u * h, z.collect())
}
