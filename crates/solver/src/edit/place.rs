//! Where figures stand in the coordinates of the problem.

use crate::interval::point;
use crate::interval::vector::{Vector, minus, unit};
use crate::places::{Each as _, array};
use crate::problem::Problem;
use crate::system::Placement;

/// Where figures are put: the first point of the problem stays where the sketch has it, the next one that is
/// elsewhere stays on its ray from there, and in space the next one off that line stays on its side of their
/// plane.
#[derive(Debug, Clone)]
pub(super) struct Stand {
    /// These points.
    points: Vec<usize>,
    /// Their frame in the sketch.
    there: Placement,
    /// The gauge's frame in the sketch, for figures in which those points have no frame.
    gauge: Placement,
}

impl Stand {
    /// For a problem with the placement of its gauge. Where constraints say where the figure is, it stays there.
    pub fn new(problem: &Problem, gauge: Placement) -> Self {
        if problem.homotopy.reference.is_empty() {
            return Stand {
                points: Vec::new(),
                there: gauge,
                gauge,
            };
        }
        let places: Vec<Vector> = problem
            .points
            .iter()
            .map(|p| p.sketch.each_ref().each(crate::interval::enclose))
            .collect();
        let mut points = vec![0];
        let mut there = None;
        for p in 1..places.len() {
            points.push(p);
            let frame = frame(problem.dimension, &points, &places);
            // In space two points give no frame yet; a third on their line does not either.
            let is_begun = points.len() == 2
                && problem.dimension == 3
                && unit(minus(places[p], places[0])).is_some();
            if frame.is_some() {
                there = frame;
                break;
            }
            if !is_begun {
                points.pop();
            }
        }
        Stand {
            points,
            there: there.unwrap_or(gauge),
            gauge,
        }
    }

    /// The figure with these places in the gauge, in the coordinates of the problem.
    pub fn put(&self, dimension: usize, places: &[Vector]) -> Vec<Vector> {
        let frame = frame(dimension, &self.points, places);
        let Some(frame) = frame else {
            return places.iter().map(|p| self.gauge.to_problem(p)).collect();
        };
        let put = |(index, p): (usize, &Vector)| {
            let mut inside = frame.seen(p);
            // Exactly where they are by choice.
            for (k, &chosen) in self.points.iter().enumerate() {
                if index == chosen {
                    inside[k..].fill(point(0.0));
                }
            }
            self.there.to_problem(&inside)
        };
        places.iter().enumerate().map(put).collect()
    }

    /// A vector of the gauge in the directions of the problem, where the points have these places. In floats.
    pub fn turn(&self, dimension: usize, places: &[Vector], v: [f64; 3]) -> [f64; 3] {
        let frame = frame(dimension, &self.points, places);
        let turned = match frame {
            Some(frame) => frame
                .axes
                .each(|axis| (0..3).map(|k| axis[k].mid() * v[k]).sum::<f64>()),
            None => v,
        };
        let axes = match frame {
            Some(_) => self.there.axes,
            None => self.gauge.axes,
        };
        array(|k| (0..3).map(|axis| axes[axis][k].mid() * turned[axis]).sum())
    }
}

/// The frame of some points, two in the plane and three in space: the first is its origin, the second in the
/// direction of its first axis, the third on the side of its second. `None`: they have none that can be
/// enclosed.
fn frame(dimension: usize, points: &[usize], places: &[Vector]) -> Option<Placement> {
    let here: Vec<Vector> = points.iter().map(|&p| places[p]).collect();
    let found = Placement::through(dimension, &here)?;
    // Where that is known only roughly it is of no use.
    let is_known = found.axes.iter().flatten().all(|x| x.rad() < 1e-6);
    is_known.then_some(found)
}
