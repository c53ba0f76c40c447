//! Figures seen from where the page sees them first.

use super::Page;
use crate::places::{Each as _, array};

/// Points in space (or the plane) to places on paper, the second axis downwards, and how near they are.
pub(super) struct Projection {
    middle: [f64; 3],
    rows: [[f64; 3]; 3],
    /// Half of what all of it is wide or high, on paper.
    size: f64,
    /// The middle of it on paper.
    centre: [f64; 2],
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
        let middle: [f64; 3] = array(|k| match low[k] <= high[k] {
            true => 0.5 * (low[k] + high[k]),
            false => 0.0,
        });
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
        let mut projection = Projection {
            middle,
            rows,
            size: 1.0,
            centre: [0.0; 2],
        };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in figures.flat_map(|figure| projection.places(figure)) {
            for k in 0..2 {
                low[k] = low[k].min(place[k]);
                high[k] = high[k].max(place[k]);
            }
        }
        let size = (0..2).map(|k| 0.5 * (high[k] - low[k])).fold(0.0, f64::max);
        if size > 0.0 && size.is_finite() {
            projection.size = size;
            projection.centre = array(|k| 0.5 * (low[k] + high[k]));
        }
        projection
    }

    /// Half of what all of it is wide or high.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// A projection of one figure alone, in the middle, with the scale of this one.
    pub fn centred(&self, page: &Page, figure: &[f64]) -> Self {
        Projection {
            size: self.size,
            ..Projection::of(page, std::iter::once(figure))
        }
    }

    /// The places of a figure's points, all of them between -1 and 1.
    pub fn places(&self, figure: &[f64]) -> Vec<[f64; 3]> {
        let place = |p: &[f64]| {
            let [x, y, z] = self.rows.each(|row| {
                let along = (0..3).map(|k| row[k] * (p[k] - self.middle[k]));
                along.sum::<f64>()
            });
            let [a, b] = self.centre;
            [(x - a) / self.size, (-y - b) / self.size, z / self.size]
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
