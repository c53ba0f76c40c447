//! The figure moving along its path: an animated picture (SVG).

use super::outlines::Drawn;
use super::projection::{Projection, colour, escaped};
use super::still::begin;
use super::{Page, Path, Sample};
use crate::order::InOrder;

/// Pictures a turn, more or less.
const FRAMES: usize = 160;
/// Seconds for the whole path, and for which it stands still at a solution.
const SECONDS: f64 = 9.0;
const REST: f64 = 0.9;
/// More stops than that would take too long.
const MOST_RESTS: usize = 16;
const SIDE: f64 = 360.0;
const CHART: f64 = 110.0;

/// A moment of the film.
struct Frame<'a> {
    seconds: f64,
    at: f64,
    t: f64,
    points: &'a [f64],
    outlines: &'a [Vec<f64>],
}

impl Page {
    /// The figure on its way along the path (the first, if there are several), standing still at solutions, above the picture of t: an SVG
    /// that moves by itself in a browser. `None`: there is no path.
    pub fn to_moving_svg(&self) -> Option<String> {
        let path = self.paths.first()?;
        let mut out = String::new();
        let frames = self.frames(path);
        let total = frames.last().map_or(1.0, |f| f.seconds).max(0.1);
        let times: Vec<String> = frames
            .iter()
            .map(|f| format!("{:.4}", f.seconds / total))
            .collect();
        let times = times.join(";");
        let extents = frames.iter().map(|f| self.extent(f.points, f.outlines));
        let extents: Vec<Vec<f64>> = extents.collect();
        let projection = Projection::of(self, extents.iter().map(Vec::as_slice));
        let on_paper = |numbers: &[f64]| -> Vec<[f64; 2]> {
            let places = projection.places(numbers).into_iter();
            places
                .map(|[x, y, _]| [x, y].map(|x| SIDE / 2.0 + 0.44 * SIDE * x))
                .collect()
        };
        let places: Vec<Vec<[f64; 2]>> = frames.iter().map(|f| on_paper(f.points)).collect();
        begin(&mut out, SIDE, SIDE + CHART, &self.title);
        let animate = |what: &str, values: Vec<String>| {
            format!(
                "<animate attributeName=\"{what}\" dur=\"{total:.2}s\" repeatCount=\"indefinite\" \
                 keyTimes=\"{times}\" values=\"{}\"/>\n",
                values.join(";")
            )
        };
        for (k, shape) in self.shapes.iter().enumerate() {
            let drawn = frames.iter().map(|f| {
                let numbers = f.outlines.get(k)?;
                Drawn::new(
                    shape,
                    numbers,
                    &on_paper(numbers),
                    0.44 * SIDE / projection.size(),
                )
            });
            let Some(drawn) = drawn.collect::<Option<Vec<Drawn>>>() else {
                continue;
            };
            let Some(first) = drawn.first() else {
                continue;
            };
            let style = first.style(colour(Some(0)));
            out += &format!("<path d=\"{}\" {style}>\n", first.path());
            out += &animate("d", drawn.iter().map(Drawn::path).collect());
            out += "</path>\n";
        }
        for bar in &self.bars {
            let [a, b] = bar.ends;
            let line = |p: &Vec<[f64; 2]>| {
                format!(
                    "M{:.1} {:.1}L{:.1} {:.1}",
                    p[a][0], p[a][1], p[b][0], p[b][1]
                )
            };
            out += &format!(
                "<path d=\"{}\" stroke=\"{}\" stroke-width=\"2.6\">\n",
                places.first().map_or(String::new(), line),
                colour(Some(0))
            );
            out += &animate("d", places.iter().map(line).collect());
            out += "</path>\n";
        }
        for k in 0..self.points.len() {
            out += "<circle r=\"4\" fill=\"#fff\" stroke=\"#20252b\" stroke-width=\"1.4\">\n";
            for (axis, what) in ["cx", "cy"].into_iter().enumerate() {
                let values = places.iter().map(|p| format!("{:.1}", p[k][axis]));
                out += &animate(what, values.collect());
            }
            out += "</circle>\n";
        }
        self.write_chart(&mut out, path, &frames, animate);
        out += "</svg>\n";
        Some(out)
    }

    fn frames<'a>(&'a self, path: &'a Path) -> Vec<Frame<'a>> {
        let length = path.samples.last().map_or(1.0, |s| s.at).max(1e-300);
        let step = path.samples.len().div_ceil(FRAMES).max(1);
        type Moment<'b> = (f64, f64, &'b [f64], &'b [Vec<f64>], bool);
        let mut moments: Vec<Moment> = path
            .samples
            .iter()
            .enumerate()
            .filter(|(k, _)| k % step == 0 || k + 1 == path.samples.len())
            .map(|(_, s): (usize, &Sample)| (s.at, s.t, &s.points[..], &s.outlines[..], false))
            .collect();
        let stops = self.figures.iter();
        let stops = stops.filter(|f| f.class.is_some() && f.path == Some(0));
        let rests = stops.clone().count() <= MOST_RESTS;
        for figure in stops {
            if let (Some(at), Some(t)) = (figure.at, figure.t) {
                moments.push((at, t, &figure.points, &figure.outlines, rests));
            }
        }
        moments.order_by(|a, b| a.0.total_cmp(&b.0));
        let mut frames = Vec::new();
        let (mut seconds, mut before) = (0.0, 0.0);
        for (at, t, points, outlines, rest) in moments {
            seconds += SECONDS * (at - before) / length;
            before = at;
            let frame = |seconds| Frame {
                seconds,
                at,
                t,
                points,
                outlines,
            };
            frames.push(frame(seconds));
            if rest {
                seconds += REST;
                frames.push(frame(seconds));
            }
        }
        frames
    }

    fn write_chart(
        &self,
        out: &mut String,
        path: &Path,
        frames: &[Frame],
        animate: impl Fn(&str, Vec<String>) -> String,
    ) {
        let all = || {
            path.samples
                .iter()
                .map(|s| s.t)
                .chain(path.levels.iter().map(|l| l.t))
        };
        let (low, high) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| {
            (low.min(t), high.max(t))
        });
        let length = path.samples.last().map_or(1.0, |s| s.at);
        let x = |at: f64| 34.0 + (SIDE - 50.0) * at / length;
        let y = |t: f64| SIDE + 12.0 + (CHART - 36.0) * (high - t) / (high - low).max(1e-300);
        for level in &path.levels {
            *out += &format!(
                "<path d=\"M34 {0:.1}H{1}\" stroke=\"#dedbd3\" stroke-dasharray=\"4 4\"/>\
                 <text x=\"26\" y=\"{2:.1}\" text-anchor=\"end\" font-size=\"12\" fill=\"#68707a\">{3}</text>\n",
                y(level.t),
                SIDE - 16.0,
                y(level.t) + 4.0,
                escaped(&level.label)
            );
        }
        let curve: Vec<String> = frames
            .iter()
            .map(|f| format!("{:.1} {:.1}", x(f.at), y(f.t)))
            .collect();
        *out += &format!(
            "<path d=\"M{}\" fill=\"none\" stroke=\"#20252b\" stroke-width=\"1.5\"/>\n",
            curve.join("L")
        );
        for figure in self.figures.iter().filter(|f| f.class.is_some()) {
            if let (Some(at), Some(t)) = (figure.at, figure.t) {
                *out += &format!(
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4.5\" fill=\"{}\" stroke=\"#fff\"/>\n",
                    x(at),
                    y(t),
                    colour(figure.class)
                );
            }
        }
        *out += &format!(
            "<text x=\"34\" y=\"{}\" font-size=\"12\" fill=\"#68707a\">{} along the path; dots are \
             solutions</text>\n<circle r=\"4.5\" fill=\"#b35300\">\n",
            SIDE + CHART - 8.0,
            escaped(&path.parameter)
        );
        *out += &animate(
            "cx",
            frames.iter().map(|f| format!("{:.1}", x(f.at))).collect(),
        );
        *out += &animate(
            "cy",
            frames.iter().map(|f| format!("{:.1}", y(f.t))).collect(),
        );
        *out += "</circle>\n";
    }
}
