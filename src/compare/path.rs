//! The path as certified runs prove it, for pictures.

use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::{Control, Options, StartError, Status, Trace, solve, trace_path};
use std::sync::atomic::AtomicBool;

/// A point of the path, in the problem's lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// Length of the path up to here, Euclidean in the free coordinates and t.
    pub at: f64,
    /// The free coordinates, and t last.
    pub z: Vec<f64>,
    /// The path's direction here, a unit vector.
    pub direction: Vec<f64>,
}

/// A path: where a certified run's tubes end, and what is between.
#[derive(Debug, Clone)]
pub struct RecordedPath {
    /// The problem's name.
    pub problem: String,
    /// What the free coordinates are called, such as `x of p5`.
    pub coordinates: Vec<String>,
    /// In order, the sketch first, and then the end of each tube. On a closed path the last one is the
    /// sketch again.
    pub step_ends: Vec<PathPoint>,
    /// Where the path meets t = 1.
    pub solutions: Vec<PathPoint>,
    /// Whether the path was followed back to the sketch, with proof.
    pub closed: bool,
    /// The path itself, from a run in tubes so narrow that their middles are a picture of it.
    trace: Trace,
}

impl RecordedPath {
    /// The path's point at a length.
    pub fn point(&self, at: f64) -> Option<PathPoint> {
        let (z, direction) = self.trace.at(at)?;
        Some(PathPoint { at, z, direction })
    }
}

/// Follows the path twice more and records it: once for the steps that a certified run takes, and once
/// closely, for the curve.
///
/// Nothing of it is in any timing.
pub fn record_path(
    problem: &Problem,
    cancel: Option<&AtomicBool>,
) -> Result<RecordedPath, StartError> {
    let homotopy = Homotopy::new(problem)?;
    let mut steps = Trace::default();
    let mut control = Control {
        cancel,
        trace: Some(&mut steps),
        ..Control::default()
    };
    let outcome = solve(problem, &Options::certified(), &mut control)?;
    let mut control = Control {
        cancel,
        ..Control::default()
    };
    let (finer, mut trace) = trace_path(problem, &Options::certified(), &mut control)?;
    // Where narrow tubes do not get so far, those of the run are what there is.
    let same = finer.status == Status::Closed || outcome.status != Status::Closed;
    let found = if same { finer } else { outcome.clone() };
    if !same {
        trace = steps.clone();
    }
    let gauge = &homotopy.gauge;
    let name = |&place: &usize| {
        let (p, axis) = (place / gauge.dimension, place % gauge.dimension);
        format!("{} of {}", ["x", "y", "z"][axis], problem.points[p].name)
    };
    // Lengths of the two runs differ a little.
    let scale = trace.length() / steps.length().max(f64::MIN_POSITIVE);
    let ends = steps.ends().into_iter().map(|at| at * scale);
    let mut path = RecordedPath {
        problem: problem.name.clone(),
        coordinates: gauge.place.iter().map(name).collect(),
        step_ends: Vec::new(),
        solutions: Vec::new(),
        closed: outcome.status == Status::Closed,
        trace,
    };
    path.step_ends = std::iter::once(0.0)
        .chain(ends)
        .filter_map(|at| path.point(at))
        .collect();
    if path.closed
        && let [first, .., last] = &mut path.step_ends[..]
    {
        last.z.clone_from(&first.z);
    }
    let places = found.solutions.iter().filter_map(|s| s.place);
    path.solutions = places.filter_map(|place| path.point(place.arc)).collect();
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_the_whole_loop() {
        let problem = Problem::read("problems/octahedron.toml").unwrap();
        let path = record_path(&problem, None).unwrap();
        let outcome = solve(&problem, &Options::certified(), &mut Control::default()).unwrap();
        assert!(path.closed);
        assert_eq!(path.coordinates.len(), problem.free_coordinates());
        assert_eq!(path.solutions.len(), outcome.solutions.len());
        let (first, last) = (
            path.step_ends.first().unwrap(),
            path.step_ends.last().unwrap(),
        );
        assert_eq!(first.z, last.z);
        assert_eq!(path.step_ends.len(), outcome.steps + 2);
        assert!((last.at / outcome.length - 1.0).abs() < 1e-3);
        let mut before = 0.0;
        for step_end in &path.step_ends[1..] {
            assert!(step_end.at > before);
            before = step_end.at;
        }
        for (solution, boxes) in path.solutions.iter().zip(&outcome.solutions) {
            assert!(solution.at > 0.0 && solution.at < last.at);
            assert!((solution.z[solution.z.len() - 1] - 1.0).abs() < 1e-4);
            // x of p6, which is free.
            let x = path
                .coordinates
                .iter()
                .position(|name| name == "x of p6")
                .unwrap();
            assert!((solution.z[x] - boxes.points[5][0].mid()).abs() < 1e-4);
        }
    }

    /// What is drawn is the path: every point of the curve meets the equations, and directions are those of
    /// the curve. On a four-bar with normals of cross-sections for directions they were off by 23 degrees.
    #[test]
    fn what_is_drawn_is_what_was_proved() {
        for file in ["problems/k33.toml", "problems/dodecagon.toml"] {
            let problem = Problem::read(file).unwrap();
            let path = record_path(&problem, None).unwrap();
            let homotopy = Homotopy::new(&problem).unwrap();
            let (length, m) = (path.step_ends.last().unwrap().at, path.coordinates.len());
            for k in 0..=500 {
                let here = path.point(length * f64::from(k) / 500.0).unwrap();
                let t = here.z[m];
                let place = |p: usize, axis: usize| {
                    let i = homotopy.gauge.variable[p * problem.dimension + axis];
                    here.z[..m].get(i).copied().unwrap_or(0.0)
                };
                for (edge, length) in problem.distances.iter().zip(&homotopy.lengths) {
                    let [a, b] = edge.points;
                    let squares =
                        (0..problem.dimension).map(|k| (place(a, k) - place(b, k)).powi(2));
                    let distance = squares.sum::<f64>().sqrt();
                    let wanted = length.enclose(crate::interval::point(t)).mid() * homotopy.unit;
                    assert!(
                        (distance - wanted).abs() < 1e-4,
                        "{file} {k}: {distance} {wanted}"
                    );
                }
                // The direction against a difference quotient.
                let ahead = path.point(here.at + 2e-5 * length);
                if let Some(ahead) = ahead.filter(|_| k < 499) {
                    let along: Vec<f64> = ahead.z.iter().zip(&here.z).map(|(a, b)| a - b).collect();
                    let size = along.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let cosine = along
                        .iter()
                        .zip(&here.direction)
                        .map(|(a, b)| a * b)
                        .sum::<f64>()
                        / size;
                    assert!(cosine > 0.999, "{file} {k}: {cosine}");
                }
            }
        }
    }
}
