//! The path as a certified run sees it, for pictures.

use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::{Control, Options, StartError, Status, TubeSeen, Witness, solve};
use std::sync::atomic::AtomicBool;

/// A point of the path, in the problem's lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct PathStation {
    /// Length of the path up to here, Euclidean in the free coordinates and t.
    pub at: f64,
    /// The free coordinates, and t last.
    pub z: Vec<f64>,
    /// The path's direction here, a unit vector.
    pub direction: Vec<f64>,
}

/// A path: the middles of a certified run's tubes.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedPath {
    /// The problem's name.
    pub problem: String,
    /// What the free coordinates are called, such as `x of p5`.
    pub coordinates: Vec<String>,
    /// In order, the sketch first. On a closed path the last one is the sketch again.
    pub stations: Vec<PathStation>,
    /// Where the path meets t = 1.
    pub solutions: Vec<PathStation>,
    /// Whether the path was followed back to the sketch, with proof.
    pub closed: bool,
}

/// Follows the path once more and records it.
///
/// Only certified runs show their tubes, so this is one: nothing of it is in any timing.
pub fn record_path(
    problem: &Problem,
    cancel: Option<&AtomicBool>,
) -> Result<RecordedPath, StartError> {
    let homotopy = Homotopy::new(problem)?;
    let mut recorder = Recorder {
        unit: 1.0,
        stations: Vec::new(),
        solutions: Vec::new(),
    };
    let mut control = Control {
        cancel,
        witness: Some(&mut recorder),
        ..Control::default()
    };
    let outcome = solve(problem, &Options::certified(), &mut control)?;
    let closed = outcome.status == Status::Closed;
    let gauge = &homotopy.gauge;
    let name = |&place: &usize| {
        let (p, axis) = (place / gauge.dimension, place % gauge.dimension);
        format!("{} of {}", ["x", "y", "z"][axis], problem.points[p].name)
    };
    Ok(RecordedPath {
        problem: problem.name.clone(),
        coordinates: gauge.place.iter().map(name).collect(),
        stations: recorder.closed_loop(closed),
        solutions: recorder.solutions,
        closed,
    })
}

struct Recorder {
    unit: f64,
    stations: Vec<PathStation>,
    solutions: Vec<PathStation>,
}

impl Recorder {
    /// In the problem's lengths; t is left as it is.
    fn scaled(&self, z: &[f64]) -> Vec<f64> {
        let mut out: Vec<f64> = z.iter().map(|x| x * self.unit).collect();
        if let (Some(last), Some(t)) = (out.last_mut(), z.last()) {
            *last = *t;
        }
        out
    }

    /// The stations, back to the sketch if the path is closed.
    fn closed_loop(&self, closed: bool) -> Vec<PathStation> {
        let mut stations = self.stations.clone();
        let (true, Some(first)) = (closed, self.stations.first()) else {
            return stations;
        };
        // The middle of the last tube may lie beyond the sketch.
        while let Some(last) = stations.pop() {
            if dot(&difference(&first.z, &last.z), &first.direction) > 0.0 || stations.is_empty() {
                let at = last.at + arc(&last, &first.z, &first.direction);
                stations.push(last);
                stations.push(PathStation {
                    at,
                    ..first.clone()
                });
                break;
            }
        }
        stations
    }
}

impl Witness for Recorder {
    fn begin(&mut self, unit: f64) {
        self.unit = unit;
    }

    fn tube(&mut self, tube: TubeSeen) {
        let z = self.scaled(tube.centre);
        // The normal of the cross-sections is the tangent at the prediction, near enough to draw.
        let mut direction = self.scaled(tube.normal);
        let size = dot(&direction, &direction).sqrt();
        direction.iter_mut().for_each(|x| *x /= size);
        let at = match self.stations.last() {
            None => 0.0,
            Some(last) => last.at + arc(last, &z, &direction),
        };
        self.stations.push(PathStation { at, z, direction });
    }

    fn solution(&mut self, centre: &[f64], _radius: &[f64]) {
        let Some(tube) = self.stations.last() else {
            return;
        };
        let z = self.scaled(&[centre, &[1.0]].concat());
        let along = dot(&difference(&z, &tube.z), &tube.direction);
        self.solutions.push(PathStation {
            at: tube.at + along,
            direction: tube.direction.clone(),
            z,
        });
    }

    fn end(&mut self, _status: &Status, _classes: &[usize]) {}
}

/// The length of the arc between two points of a curve, from its chord and its directions: the
/// chord of an arc that turns by δ is shorter by the part δ²/24.
fn arc(from: &PathStation, to: &[f64], direction: &[f64]) -> f64 {
    let chord = difference(to, &from.z);
    let turn = difference(direction, &from.direction);
    dot(&chord, &chord).sqrt() * (1.0 + dot(&turn, &turn) / 24.0)
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
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
            path.stations.first().unwrap(),
            path.stations.last().unwrap(),
        );
        assert_eq!(first.z, last.z);
        // Lengths by arcs and by the tubes' polynomials agree.
        assert!((last.at / outcome.length - 1.0).abs() < 0.01);
        let mut before = 0.0;
        for station in &path.stations[1..] {
            assert!(station.at > before);
            before = station.at;
        }
        for solution in &path.solutions {
            assert!(solution.at > 0.0 && solution.at < last.at);
        }
    }
}
