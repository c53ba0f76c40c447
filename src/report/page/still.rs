//! A still picture of the figures, side by side (SVG).

use super::outlines::Drawn;
use super::projection::{Projection, colour, escaped};
use super::{Figure, Page};
use crate::order::InOrder;
use crate::places::Each as _;

/// More figures are not drawn: a picture with hundreds shows none.
const MOST: usize = 12;
/// The side of a figure's field, and the height of the words below it.
const SIDE: f64 = 250.0;
const WORDS: f64 = 44.0;
const COLUMNS: usize = 4;

impl Page {
    /// The first figures of the list, the sketch among them, as one picture: SVG.
    pub fn to_svg(&self) -> String {
        let mut out = String::new();
        let figures: Vec<&Figure> = self.figures.iter().take(MOST).collect();
        let columns = figures.len().clamp(1, COLUMNS);
        let rows = figures.len().div_ceil(columns).max(1);
        let (width, height) = (
            SIDE * columns as f64,
            40.0 + (SIDE + WORDS) * rows as f64 + 10.0,
        );
        // As large as the largest of them may be.
        let extent = |figure: &Figure| self.extent(&figure.points, &figure.outlines);
        let alone = |figure: &&Figure| Projection::of(self, std::iter::once(&extent(figure)[..]));
        let largest = figures.iter().map(alone);
        let largest = largest.max_by(|a, b| a.size().total_cmp(&b.size()));
        begin(&mut out, width, height, &self.title);
        let left = self.figures.len() - figures.len();
        let more = if left > 0 {
            format!(" (and {left} more)")
        } else {
            String::new()
        };
        out += &format!(
            "<text x=\"16\" y=\"27\" font-size=\"17\" font-weight=\"600\">{}{more}</text>\n",
            escaped(&self.title)
        );
        for (k, figure) in figures.iter().enumerate() {
            let x = SIDE * (k % columns) as f64;
            let y = 40.0 + (SIDE + WORDS) * (k / columns) as f64;
            out += &format!("<g transform=\"translate({x},{y})\">\n");
            if let Some(largest) = &largest {
                self.draw(&mut out, &largest.centred(self, &extent(figure)), figure);
            }
            let middle = SIDE / 2.0;
            out += &format!(
                "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-size=\"14\">{}</text>\n",
                SIDE + 12.0,
                escaped(&figure.name)
            );
            out += &format!(
                "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" font-size=\"11.5\" fill=\"#68707a\">{}</text>\n</g>\n",
                SIDE + 29.0,
                escaped(&figure.note)
            );
        }
        out += "</svg>\n";
        out
    }

    fn draw(&self, out: &mut String, projection: &Projection, figure: &Figure) {
        let radius = 0.40 * SIDE;
        let places: Vec<[f64; 3]> = projection
            .places(&figure.points)
            .into_iter()
            .map(|[x, y, z]| [SIDE / 2.0 + radius * x, SIDE / 2.0 + radius * y, z])
            .collect();
        for (shape, numbers) in self.shapes.iter().zip(&figure.outlines) {
            let on_paper = projection.places(numbers).into_iter();
            let on_paper: Vec<[f64; 2]> = on_paper
                .map(|[x, y, _]| [SIDE / 2.0 + radius * x, SIDE / 2.0 + radius * y])
                .collect();
            if let Some(drawn) = Drawn::new(shape, numbers, &on_paper, radius / projection.size()) {
                let style = drawn.style(colour(figure.class));
                *out += &format!("<path d=\"{}\" {style}/>\n", drawn.path());
            }
        }
        let depth = |ends: [usize; 2]| places[ends[0]][2] + places[ends[1]][2];
        let mut bars: Vec<[usize; 2]> = self.bars.iter().map(|bar| bar.ends).collect();
        bars.order_by(|&a, &b| depth(a).total_cmp(&depth(b)));
        let width = (140.0 / bars.len().max(1) as f64).clamp(0.7, 2.6);
        for ends in bars {
            let [a, b] = ends.map(|p| places[p]);
            let near = match self.dimension {
                2 => 1.0,
                _ => 0.68 + 0.16 * depth(ends).clamp(-2.0, 2.0),
            };
            *out += &format!(
                "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"{}\" stroke-width=\"{:.2}\" stroke-opacity=\"{near:.2}\"/>\n",
                a[0],
                a[1],
                b[0],
                b[1],
                colour(figure.class),
                width * near
            );
        }
        let dot = (60.0 / places.len().max(1) as f64).clamp(0.8, 3.4);
        for [x, y, _] in &places {
            *out += &format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{dot:.1}\" fill=\"#fff\" stroke=\"#20252b\"/>\n"
            );
        }
        if places.len() <= 16 {
            let count = places.len() as f64;
            let middle = [0, 1].each(|k| places.iter().map(|p| p[k]).sum::<f64>() / count);
            for (name, [x, y, _]) in self.points.iter().zip(&places) {
                let (dx, dy) = (x - middle[0], y - middle[1]);
                let far = dx.hypot(dy).max(1e-9);
                *out += &format!(
                    "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11.5\">{}</text>\n",
                    x + 12.0 * dx / far,
                    y + 11.0 * dy / far + 4.0,
                    escaped(name)
                );
            }
        }
    }
}

/// The head of a picture on white.
pub(super) fn begin(out: &mut String, width: f64, height: f64, title: &str) {
    *out += &format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" fill=\"#20252b\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fff\"/>\n",
        escaped(title)
    );
}
