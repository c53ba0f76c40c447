//! Lines, planes, circles, spheres and arcs as they are drawn: each in a few numbers that move with the figure.

use super::{Page, Shape};
use crate::interval::vector::{cross, length};
use crate::places::{Each as _, array};

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
    let foot: [f64; 3] = array(|k| middle[k] - height * normal[k]);
    let far = |p: &[f64]| (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>();
    let reach = figure.chunks_exact(3).map(far).fold(0.0, f64::max).sqrt();
    // The axis that is least along the normal, made to lie in the plane.
    let axis = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
    let axis = axis.expect("three axes");
    let mut u: [f64; 3] = array(|k| f64::from(u8::from(k == axis)) - normal[axis] * normal[k]);
    let size = length(u).max(1e-300);
    u.iter_mut()
        .for_each(|x| *x *= (0.7 + BEYOND) * reach / size);
    let v = cross(normal, u);
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .into_iter()
        .flat_map(|(a, b)| (0..3).map(move |k| foot[k] + a * u[k] + b * v[k]))
        .collect()
}

/// A vector made 1 long; `None` if it has no direction.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let long = length(v);
    (long > 0.0 && long.is_finite()).then(|| v.each(|x| x / long))
}

/// The angle from the start of an arc to its end, counter-clockwise, from 0 to 2π.
fn sweep(numbers: &[f64]) -> f64 {
    let (x, y) = (numbers[0], numbers[1]);
    let (a, b) = (
        [numbers[3] - x, numbers[4] - y],
        [numbers[6] - x, numbers[7] - y],
    );
    let angle = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
    angle.rem_euclid(std::f64::consts::TAU)
}

/// Says which way an arc goes, if it went through the angle `before` shortly before: the nearer of both ways, so that an arc that
/// shrinks to nothing goes on at the other side. Returns the angle.
fn turn(numbers: &mut Vec<f64>, before: f64) -> f64 {
    let there = sweep(numbers);
    let back = there - std::f64::consts::TAU;
    let angle = match (back - before).abs() < (there - before).abs() {
        true => back,
        false => there,
    };
    let radius = (numbers[3] - numbers[0]).hypot(numbers[4] - numbers[1]);
    numbers.push(radius.copysign(angle));
    angle
}

impl Page {
    /// Gives each arc its sense: counter-clockwise in the sketch, and on along paths as the figure moves; in a figure
    /// that is on none, the way that is nearer to the sketch's.
    pub(super) fn turn_arcs(&mut self) {
        let is_arc = |shape: &Shape| shape.kind == "arc";
        let arcs = self.shapes.iter().enumerate();
        let arcs: Vec<usize> = arcs.filter(|(_, s)| is_arc(s)).map(|(k, _)| k).collect();
        for k in arcs {
            let known = |outlines: &[Vec<f64>]| outlines.get(k).is_some_and(|o| o.len() == 9);
            let mut own = std::f64::consts::PI;
            let sketches = self.figures.iter_mut();
            for sketch in sketches.filter(|f| f.kind == "sketch" && known(&f.outlines)) {
                own = turn(&mut sketch.outlines[k], own);
            }
            // Along each path, both ways from where the sketch is.
            let mut angles: Vec<Vec<f64>> = Vec::with_capacity(self.paths.len());
            for path in &mut self.paths {
                let samples = &mut path.samples;
                let count = samples.len();
                let first = samples.partition_point(|s| s.at < 0.0);
                let mut of_path = vec![own; count];
                let mut follow = |range: &mut dyn Iterator<Item = usize>| {
                    let mut angle = own;
                    for n in range {
                        if !known(&samples[n].outlines) {
                            continue;
                        }
                        angle = turn(&mut samples[n].outlines[k], angle);
                        of_path[n] = angle;
                    }
                };
                follow(&mut (first..count));
                follow(&mut (0..first).rev());
                angles.push(of_path);
            }
            for figure in &mut self.figures {
                if figure.kind == "sketch" || !known(&figure.outlines) {
                    continue;
                }
                let on = figure.path.zip(figure.at);
                let before = on.and_then(|(path, at)| {
                    let samples = &self.paths.get(path)?.samples;
                    let next = samples.partition_point(|s| s.at < at);
                    angles[path].get(next.min(samples.len() - 1)).copied()
                });
                turn(&mut figure.outlines[k], before.unwrap_or(own));
            }
        }
    }

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
    /// Part of a circle: both ends, the radius, whether it is more than half of the circle, and whether it goes clockwise
    /// for who looks at the figure.
    Arc([[f64; 2]; 2], f64, [bool; 2]),
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
                let clockwise = numbers.get(9).is_some_and(|radius| *radius < 0.0);
                Drawn::Arc(
                    [start, end],
                    radius,
                    [(turned < 0.0) != clockwise, clockwise],
                )
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
            Drawn::Circle(centre, radius) => {
                // Two halves, whose ends are as far apart as the radius says that is printed.
                let tenths = |x: f64| (10.0 * x).round() / 10.0;
                let ([x, y], radius) = (centre.each(tenths), tenths(*radius));
                let (left, right) = (at([x - radius, y]), at([x + radius, y]));
                format!(
                    "M{left}A{radius:.1} {radius:.1} 0 1 0 {right}A{radius:.1} {radius:.1} 0 1 0 {left}"
                )
            }
            Drawn::Arc([start, end], radius, flags) => {
                let [large, clockwise] = flags.each(u8::from);
                format!(
                    "M{}A{radius:.1} {radius:.1} 0 {large} {clockwise} {}",
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

#[cfg(test)]
mod tests {
    use super::*;

    /// An arc about the origin from one angle to another, in degrees.
    fn arc(start: f64, end: f64) -> Vec<f64> {
        let at = |angle: f64| [angle.to_radians().cos(), angle.to_radians().sin(), 0.0];
        [[0.0; 3], at(start), at(end)].concat()
    }

    #[test]
    fn an_arc_that_shrinks_to_nothing_goes_on_at_the_other_side() {
        let mut angle = 90f64.to_radians();
        for end in [60, 30, 10, -10, -40, -100, -200] {
            let mut numbers = arc(0.0, f64::from(end));
            angle = turn(&mut numbers, angle);
            assert!((angle - f64::from(end).to_radians()).abs() < 1e-12, "{end}");
            assert_eq!(numbers[9] < 0.0, end < 0);
        }
        // And past half a circle it stays what it is.
        for end in [150.0, 179.0, 181.0, 300.0] {
            let mut numbers = arc(0.0, end);
            angle = turn(&mut numbers, if end < 160.0 { 2.0 } else { angle });
            assert!(angle > 0.0 && numbers[9] > 0.0, "{end}");
        }
    }

    #[test]
    fn a_circle_is_drawn_round_whatever_is_rounded() {
        let drawn = Drawn::Circle([125.0, 125.04], 11.248).path();
        assert_eq!(
            drawn,
            "M113.8 125.0A11.2 11.2 0 1 0 136.2 125.0A11.2 11.2 0 1 0 113.8 125.0"
        );
        let drawn = Drawn::Circle([125.0, 125.0], 11.26).path();
        assert_eq!(
            drawn,
            "M113.7 125.0A11.3 11.3 0 1 0 136.3 125.0A11.3 11.3 0 1 0 113.7 125.0"
        );
    }

    #[test]
    fn a_clockwise_arc_is_drawn_clockwise() {
        let shape = Shape {
            name: "k".into(),
            kind: "arc".into(),
            ends: None,
        };
        // On paper the second axis points down.
        let places = [[0.0, 0.0], [10.0, 0.0], [0.0, -10.0]];
        for (radius, path) in [(1.0, "0 0 0"), (-1.0, "0 1 1")] {
            let mut numbers = arc(0.0, 90.0);
            numbers.push(radius);
            let drawn = Drawn::new(&shape, &numbers, &places, 10.0).unwrap();
            assert_eq!(
                drawn.path(),
                format!("M10.0 0.0A10.0 10.0 {path} 0.0 -10.0")
            );
        }
    }
}
