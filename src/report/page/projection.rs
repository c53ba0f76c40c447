//! Figures seen from where the page sees them first.

use super::Page;

/// Points in space (or the plane) to places on paper, the second axis downwards, and how near they are.
pub(super) struct Projection {
    middle: [f64; 3],
    rows: [[f64; 3]; 3],
    /// The distance of the furthest point from the middle.
    size: f64,
}

impl Projection {
    /// Shows all of these figures.
    pub fn of<'a>(page: &Page, figures: impl Iterator<Item = &'a [f64]> + Clone) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for p in figures.clone().flat_map(|f| f.chunks_exact(3)) {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        let middle: [f64; 3] = std::array::from_fn(|k| match low[k] <= high[k] {
            true => 0.5 * (low[k] + high[k]),
            false => 0.0,
        });
        let distance = |p: &[f64]| {
            let squares = (0..3).map(|k| (p[k] - middle[k]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let all = figures.flat_map(|f| f.chunks_exact(3));
        let size = all.map(distance).fold(0.0, f64::max);
        // The third axis upwards, from the front, a little from the right and from above.
        let (s, c) = (-0.5f64).sin_cos();
        let (tilt, level) = (-1.22f64).sin_cos();
        let rows = match page.dimension {
            2 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            _ => [
                [c, -s, 0.0],
                [level * s, level * c, -tilt],
                [tilt * s, tilt * c, level],
            ],
        };
        Projection {
            middle,
            rows,
            size: if size > 0.0 { size } else { 1.0 },
        }
    }

    /// The places of a figure's points, as if all were in a circle of radius 1.
    pub fn places(&self, figure: &[f64]) -> Vec<[f64; 3]> {
        let place = |p: &[f64]| {
            let [x, y, z] = self.rows.map(|row| {
                let along = (0..3).map(|k| row[k] * (p[k] - self.middle[k]));
                along.sum::<f64>() / self.size
            });
            [x, -y, z]
        };
        figure.chunks_exact(3).map(place).collect()
    }
}

/// The palette of Okabe and Ito, as on the page, for classes of congruent figures.
const COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

/// The colour of a class; grey for none.
pub(super) fn colour(class: Option<usize>) -> &'static str {
    class.map_or("#8a9198", |class| COLOURS[class % COLOURS.len()])
}

/// A text without what means something in XML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
