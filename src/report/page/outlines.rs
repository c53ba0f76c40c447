//! Lines, planes, circles, spheres and arcs as they are drawn: each in a few numbers that move with the figure.

use super::{Page, Shape};

/// How far drawn lines and planes go beyond the figure, as a part of it.
const BEYOND: f64 = 0.12;

/// A line as long as the figure: both ends.
pub(super) fn line(figure: &[f64], point: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
    let along = |p: &[f64]| {
        (0..3)
            .map(|k| direction[k] * (p[k] - point[k]))
            .sum::<f64>()
    };
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for at in figure.chunks_exact(3).map(along) {
        (low, high) = (low.min(at), high.max(at));
    }
    let more = BEYOND * (high - low).max(f64::MIN_POSITIVE);
    let ends = [low - more, high + more].into_iter();
    ends.flat_map(|at| (0..3).map(move |k| point[k] + at * direction[k]))
        .collect()
}

/// A square in a plane, below and above the middle of the figure: its corners.
pub(super) fn plane(figure: &[f64], point: [f64; 3], normal: [f64; 3]) -> Vec<f64> {
    let count = (figure.len() / 3).max(1) as f64;
    let mut middle = [0.0; 3];
    for p in figure.chunks_exact(3) {
        (0..3).for_each(|k| middle[k] += p[k] / count);
    }
    let height: f64 = (0..3).map(|k| normal[k] * (middle[k] - point[k])).sum();
    let foot: [f64; 3] = std::array::from_fn(|k| middle[k] - height * normal[k]);
    let far = |p: &[f64]| (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>();
    let reach = figure.chunks_exact(3).map(far).fold(0.0, f64::max).sqrt();
    // The axis that is least along the normal, made to lie in the plane.
    let axis = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
    let axis = axis.expect("three axes");
    let mut u: [f64; 3] =
        std::array::from_fn(|k| f64::from(u8::from(k == axis)) - normal[axis] * normal[k]);
    let size = u.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-300);
    u.iter_mut()
        .for_each(|x| *x *= (0.7 + BEYOND) * reach / size);
    let v: [f64; 3] = std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        normal[i] * u[j] - normal[j] * u[i]
    });
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .into_iter()
        .flat_map(|(a, b)| (0..3).map(move |k| foot[k] + a * u[k] + b * v[k]))
        .collect()
}

impl Page {
    /// The points of a figure, and how far its circles and spheres reach: all that has to be seen.
    pub(super) fn extent(&self, points: &[f64], outlines: &[Vec<f64>]) -> Vec<f64> {
        let mut all = points.to_vec();
        for (shape, outline) in self.shapes.iter().zip(outlines) {
            let round = matches!(shape.kind.as_str(), "circle" | "sphere");
            if let (true, &[x, y, z, radius]) = (round, &outline[..]) {
                for side in [-radius, radius] {
                    all.extend([x + side, y, z, x, y + side, z]);
                    if self.dimension == 3 {
                        all.extend([x, y, z + side]);
                    }
                }
            }
        }
        all
    }
}

/// A shape on paper.
pub(super) enum Drawn {
    /// A stroke from one place to another.
    Line([[f64; 2]; 2]),
    /// A closed field.
    Field(Vec<[f64; 2]>),
    /// A full circle: the middle and the radius.
    Circle([f64; 2], f64),
    /// Part of a circle, counter-clockwise for who looks at the figure: both ends, the radius, and whether it is more
    /// than half of the circle.
    Arc([[f64; 2]; 2], f64, bool),
}

impl Drawn {
    /// An outline whose places are on paper already (the second axis downwards), with the length that 1 has there.
    pub(super) fn new(
        shape: &Shape,
        numbers: &[f64],
        places: &[[f64; 2]],
        unit: f64,
    ) -> Option<Self> {
        Some(match (shape.kind.as_str(), places) {
            ("line", &[a, b]) => Drawn::Line([a, b]),
            ("plane", corners) if corners.len() == 4 => Drawn::Field(corners.to_vec()),
            ("circle" | "sphere", &[centre]) => Drawn::Circle(centre, numbers.get(3)? * unit),
            ("arc", &[centre, start, end]) => {
                let from = |p: [f64; 2]| [p[0] - centre[0], centre[1] - p[1]];
                let (a, b) = (from(start), from(end));
                // The angle from start to end, counter-clockwise.
                let turned = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
                // In a sketch the end may be nearer to the centre than the start, or further from it.
                let radius = a[0].hypot(a[1]);
                let scale = radius / b[0].hypot(b[1]).max(f64::MIN_POSITIVE);
                let end = [centre[0] + scale * b[0], centre[1] - scale * b[1]];
                Drawn::Arc([start, end], radius, turned < 0.0)
            }
            _ => return None,
        })
    }

    /// The `d` of an SVG path.
    pub(super) fn path(&self) -> String {
        let at = |[x, y]: [f64; 2]| format!("{x:.1} {y:.1}");
        match self {
            Drawn::Line([a, b]) => format!("M{}L{}", at(*a), at(*b)),
            Drawn::Field(corners) => {
                let corners: Vec<String> = corners.iter().map(|&p| at(p)).collect();
                format!("M{}Z", corners.join("L"))
            }
            Drawn::Circle([x, y], radius) => {
                let (left, right) = (at([x - radius, *y]), at([x + radius, *y]));
                format!(
                    "M{left}A{radius:.1} {radius:.1} 0 1 0 {right}A{radius:.1} {radius:.1} 0 1 0 {left}"
                )
            }
            Drawn::Arc([start, end], radius, large) => {
                let large = u8::from(*large);
                format!(
                    "M{}A{radius:.1} {radius:.1} 0 {large} 0 {}",
                    at(*start),
                    at(*end)
                )
            }
        }
    }

    /// How it is drawn, in a colour.
    pub(super) fn style(&self, colour: &str) -> String {
        match self {
            Drawn::Line(_) => format!(
                "fill=\"none\" stroke=\"{colour}\" stroke-width=\"1\" stroke-dasharray=\"7 4\" stroke-opacity=\"0.8\""
            ),
            Drawn::Field(_) => format!(
                "fill=\"{colour}\" fill-opacity=\"0.08\" stroke=\"{colour}\" stroke-width=\"0.8\" \
                 stroke-opacity=\"0.5\""
            ),
            Drawn::Circle(..) | Drawn::Arc(..) => {
                format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"")
            }
        }
    }
}
