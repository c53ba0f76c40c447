//! Whether two runs report the same figure: by its points, and by the lines, planes and radii of its own.

use crate::constraint::Entry;
use crate::interval::Interval;
use crate::problem::Shape;
use crate::system::{Homotopy, Located};
use crate::track::Solution;

/// How figures of a problem are matched.
pub(super) struct Matching {
    /// For each object whether the figure's points do not tell where it is.
    own: Vec<bool>,
    /// For each known change of signs with which a figure stays as it is the objects whose directions it reverses. The first
    /// one reverses none.
    reversals: Vec<Vec<bool>>,
}

impl Matching {
    /// For the figures of a problem.
    pub fn new(homotopy: &Homotopy) -> Self {
        let own = |shape: &Shape| match shape {
            Shape::Line(_) | Shape::Plane(_) | Shape::Body { .. } | Shape::Joint { .. } => false,
            Shape::FreeLine { .. }
            | Shape::FreePlane { .. }
            | Shape::Round { .. }
            | Shape::Number { .. }
            | Shape::Arc { .. } => true,
        };
        let first = homotopy.gauge.place.len();
        let shapes = || homotopy.shapes.iter();
        let reversed = |twin: &Vec<bool>| -> Vec<bool> {
            let objects = shapes().zip(&homotopy.tail.objects);
            let is_reversed = |(shape, entries): (&Shape, &Vec<Entry>)| {
                let split = shape.split_direction(entries, homotopy.dimension);
                split.is_some_and(|[_, turn]| {
                    turn.iter().any(|entry| match *entry {
                        Entry::Unknown(u) => twin[first + u],
                        _ => false,
                    })
                })
            };
            objects.map(is_reversed).collect()
        };
        // Where there are too many to list, directions are compared as they are.
        let none = || vec![vec![false; homotopy.equations]];
        let mut reversals: Vec<Vec<bool>> = Vec::new();
        for twin in homotopy.twins().unwrap_or_else(none) {
            let reversal = reversed(&twin);
            if !reversals.contains(&reversal) {
                reversals.push(reversal);
            }
        }
        Matching {
            own: shapes().map(own).collect(),
            reversals,
        }
    }

    /// Of some boxes the one in whose place a figure is: the nearest one, if it is no further than `place` times its
    /// size. Lines and planes of their own count with the directions that they have, as the path keeps them; only where no
    /// box is near enough also with others, as far as constraints do not tell them apart.
    pub fn place_of(&self, boxes: &[Solution], figure: &Solution, place: f64) -> Option<usize> {
        let nearest = |reversal: &Vec<bool>| {
            let all = boxes.iter().enumerate();
            let all = all.map(|(k, b)| (k, self.distance(b, figure, reversal)));
            all.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let mut found = self.reversals.iter().filter_map(nearest);
        found.find(|&(_, away)| away <= place).map(|(k, _)| k)
    }

    /// The largest distance of a number's middle from its box, lengths being divided by the size of the box's figure.
    fn distance(&self, boxes: &Solution, figure: &Solution, reversal: &[bool]) -> f64 {
        let size = size(boxes);
        let (mut most, same) = (0.0, 1.0);
        let mut compare = |a: &[Interval; 3], b: &[Interval; 3], sign: f64, unit: f64| {
            for (a, b) in a.iter().zip(b) {
                most = larger(most, gap(a, sign * b.mid()) / unit);
            }
        };
        for (a, b) in boxes.points.iter().zip(&figure.points) {
            compare(a, b, same, size);
        }
        for (k, (a, b)) in boxes.objects.iter().zip(&figure.objects).enumerate() {
            if !self.own[k] {
                continue;
            }
            let sign = if reversal[k] { -1.0 } else { 1.0 };
            match (a, b) {
                (
                    Located::Line {
                        point: p,
                        direction: u,
                    },
                    Located::Line {
                        point: q,
                        direction: v,
                    },
                )
                | (
                    Located::Plane {
                        point: p,
                        normal: u,
                    },
                    Located::Plane {
                        point: q,
                        normal: v,
                    },
                ) => {
                    compare(p, q, same, size);
                    compare(u, v, sign, 1.0);
                }
                // The centre is one of the points.
                (Located::Number(r), Located::Number(s))
                | (Located::Round { radius: r, .. }, Located::Round { radius: s, .. }) => {
                    compare(&[*r; 3], &[*s; 3], same, size);
                }
                _ => {}
            }
        }
        most
    }
}

/// The largest coordinate of a figure's points, places of its objects, and radii.
fn size(figure: &Solution) -> f64 {
    let points = figure.points.iter().flatten();
    let size = points.fold(0.0, |max: f64, x| max.max(x.mag()));
    figure
        .objects
        .iter()
        .fold(size, |max, object| match object {
            Located::Line { point, .. } | Located::Plane { point, .. } => {
                point.iter().fold(max, |max, x| max.max(x.mag()))
            }
            Located::Round { radius: number, .. } | Located::Number(number) => {
                max.max(number.mag())
            }
            Located::Pose { at, .. } => at.iter().fold(max, |max, x| max.max(x.mag())),
            Located::Body | Located::Joint { .. } => max,
        })
}

/// How far a number is from an interval; negative inside.
fn gap(interval: &Interval, x: f64) -> f64 {
    (interval.inf() - x).max(x - interval.sup())
}

/// The larger of two; what is not a number is far away.
fn larger(max: f64, x: f64) -> f64 {
    match x.is_nan() {
        true => f64::INFINITY,
        false => max.max(x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::point;
    use crate::problem::Problem;
    use crate::track::{Control, Options, Space, solve};

    const PLACE: f64 = 1e-6;

    fn solutions(problem: &Problem, options: &Options) -> Vec<Solution> {
        let outcome = solve(problem, options, &mut Control::default()).unwrap();
        outcome.solutions
    }

    /// Only the lines differ among the four: each has its own place.
    #[test]
    fn figures_that_differ_in_lines_alone_are_told_apart() {
        let problem = Problem::read("problems/constraints/3p3l.toml").unwrap();
        let matching = Matching::new(&Homotopy::new(&problem).unwrap());
        let boxes = solutions(&problem, &Options::certified());
        let seen = solutions(&problem, &Options::float(Space::Full));
        let place = |figure: &Solution| matching.place_of(&boxes, figure, PLACE);
        let places: Vec<Option<usize>> = seen.iter().map(place).collect();
        assert_eq!(places, (0..4).map(Some).collect::<Vec<_>>());

        // A line that has moved, or turned, is another figure.
        for moved in [true, false] {
            let mut other = seen[0].clone();
            let Located::Line {
                point: p,
                direction,
            } = &mut other.objects[0]
            else {
                panic!("a line");
            };
            let x = if moved { &mut p[0] } else { &mut direction[0] };
            *x += point(1e-3);
            assert_eq!(place(&other), None);
        }
    }

    /// A distance does not tell the two directions of a line apart, an angle with another line of its own does.
    #[test]
    fn directions_count_where_constraints_tell_them() {
        let reversed = |figure: &Solution| {
            let mut other = figure.clone();
            let Located::Line { direction, .. } = &mut other.objects[0] else {
                panic!("a line");
            };
            *direction = direction.map(|x| -x);
            other
        };
        let undirected = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\n[lines]\n\
            l = { point = [1, 1], direction = [1, 0.2] }\n\
            [constraints]\ndistances = [[\"a\", \"b\", 4.2], [\"a\", \"l\", 1.1], [\"b\", \"l\", 1.9]]\n\
            [homotopy]\nbend = [\"a\", \"b\"]\nbend_coefficient = 2\n";
        let problem = Problem::parse(undirected, "test.toml").unwrap();
        let homotopy = Homotopy::new(&problem).unwrap();
        let matching = Matching::new(&homotopy);
        let boxes = solutions(&problem, &Options::certified());
        assert!(!boxes.is_empty());
        let other = reversed(&boxes[0]);
        let tells = !homotopy.directed(|_| true).is_empty();
        let found = matching.place_of(&boxes[..1], &other, PLACE);
        assert_eq!(found.is_none(), tells);

        let problem = Problem::read("problems/constraints/3p3l.toml").unwrap();
        let homotopy = Homotopy::new(&problem).unwrap();
        assert!(!homotopy.directed(|_| true).is_empty());
        let matching = Matching::new(&homotopy);
        let boxes = solutions(&problem, &Options::certified());
        let other = reversed(&boxes[0]);
        assert_eq!(matching.place_of(&boxes, &other, PLACE), None);
    }
}
