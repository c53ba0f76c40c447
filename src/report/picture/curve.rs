//! The path's curve between the ends of its steps, and the sizes of its steps; how it and what is on it are drawn.

use super::style::{
    CLASSES, Chart, Entry, Failure, INK, SCALE, Sign, VERMILION, draw_sign, number_signs,
    size_colour,
};
use crate::compare::RecordedPath;
use crate::order::InOrder;
use plotters::prelude::*;

/// A point of the path: the length up to it, the free coordinates and t.
pub type Point = (f64, Vec<f64>);

/// A stretch of the path along which the steps are of one class of sizes.
struct Piece {
    class: usize,
    /// Its points, the last of the piece before among them.
    points: Vec<Point>,
}

/// The path as it is drawn.
pub struct Curve {
    /// In the order of the path.
    pieces: Vec<Piece>,
    bounds: Vec<f64>,
    step_ends: usize,
}

const SOLUTION: Sign = Sign::Ring(VERMILION);
const SKETCH: Sign = Sign::Disc(INK);

/// So many points are drawn at most, beside the ends of steps.
const POINTS: usize = 6000;

impl Curve {
    /// The path between the ends of its steps, in as many colours as there are classes of steps.
    pub fn new(path: &RecordedPath) -> Self {
        let steps: Vec<f64> = path
            .step_ends
            .windows(2)
            .map(|w| w[1].at - w[0].at)
            .collect();
        let bounds = bounds_of(&steps);
        let parts = (POINTS / steps.len().max(1)).clamp(1, 24);
        let mut pieces: Vec<Piece> = Vec::new();
        for (ends, &step) in path.step_ends.windows(2).zip(&steps) {
            let class = bounds.iter().filter(|&&bound| step > bound).count();
            let points = (1..=parts).filter_map(|k| {
                let part = k as f64 / parts as f64;
                let here = path.point(ends[0].at + part * (ends[1].at - ends[0].at))?;
                Some((here.at, here.z))
            });
            match pieces.last_mut() {
                Some(last) if last.class == class => last.points.extend(points),
                _ => {
                    let first = (ends[0].at, ends[0].z.clone());
                    let points = std::iter::once(first).chain(points).collect();
                    pieces.push(Piece { class, points });
                }
            }
        }
        Curve {
            pieces,
            bounds,
            step_ends: path.step_ends.len(),
        }
    }

    /// All points.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.pieces.iter().flat_map(|piece| &piece.points)
    }

    /// What the signs mean, in these words, and the colours.
    pub fn legend(&self, solutions: String, sketch: &str) -> Vec<Entry> {
        let number = |x: f64| format!("{x:.2}");
        let colours = (0..=self.bounds.len()).map(|class| {
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
                sign: Sign::Line(size_colour(class)),
                text,
            }
        });
        let solutions = Entry {
            sign: SOLUTION,
            text: solutions,
        };
        let sketch = Entry {
            sign: SKETCH,
            text: sketch.into(),
        };
        [solutions, sketch].into_iter().chain(colours).collect()
    }

    /// Draws it, its points at the places given: long paths finely.
    pub fn draw<'a, X, Y>(
        &self,
        chart: &mut Chart<'a, X, Y>,
        place: impl Fn(&Point) -> (f64, f64),
    ) -> Result<(), Failure<'a>>
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let width = if self.step_ends > 2000 {
            SCALE
        } else {
            2 * SCALE
        };
        for piece in &self.pieces {
            let line = piece.points.iter().map(&place);
            let style = size_colour(piece.class).stroke_width(width);
            chart.draw_series(LineSeries::new(line, style))?;
        }
        Ok(())
    }
}

/// Draws the signs of solutions and of the sketch, and numbers the solutions.
pub fn draw_signs<'a, X, Y>(
    chart: &Chart<'a, X, Y>,
    solutions: &[(f64, f64)],
    sketch: impl Iterator<Item = (f64, f64)>,
) -> Result<(), Failure<'a>>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    let area = chart.plotting_area();
    for &at in solutions {
        draw_sign(area, at, SOLUTION)?;
    }
    for at in sketch {
        draw_sign(area, at, SKETCH)?;
    }
    // More would be a black cloud.
    if solutions.len() <= 60 {
        number_signs(chart, solutions)?;
    }
    Ok(())
}

/// Quantiles of the steps: every class has as many.
fn bounds_of(steps: &[f64]) -> Vec<f64> {
    let mut sorted = steps.to_vec();
    sorted.order_by(f64::total_cmp);
    let mut bounds: Vec<f64> = (1..CLASSES)
        .filter_map(|k| sorted.get(k * sorted.len() / CLASSES).copied())
        .collect();
    bounds.dedup();
    bounds
}
