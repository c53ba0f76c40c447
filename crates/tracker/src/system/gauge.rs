//! The reference: which coordinates are fixed, and the sketch seen from it.

use crate::interval::vector::{Vector, cross, dot, minus, unit};
use crate::interval::{Interval, enclose, point};
use crate::places::{Each as _, array};
use crate::problem::{Problem, free_coordinates};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The coordinates that rigid motions leave: the first reference point at the origin, the second
/// on the x axis, the third (in space) in the xy plane (RR 8705, sections 2.1 and 6).
///
/// Without reference points all coordinates are free, and are those of the problem: then constraints
/// say where the figure is.
#[derive(Debug, Clone)]
pub struct Gauge {
    /// 2 or 3.
    pub dimension: usize,
    /// The reference points.
    pub reference: Vec<usize>,
    /// For each free coordinate its place `point * dimension + axis`.
    pub place: Vec<usize>,
    /// For each place its unknown, or the number m of all unknowns where the coordinate is fixed.
    pub variable: Vec<usize>,
}

/// Why the sketch cannot be seen from the reference.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum GaugeError {
    /// The first two reference points cannot be told apart.
    #[error(
        "the reference points {0} and {1} are too near each other in the sketch to tell a direction from \
             them in 53 bits; choose others, or move the sketch nearer to the origin"
    )]
    Coincident(String, String),
    /// The three reference points cannot be told from points of a line.
    #[error(
        "the reference points {0}, {1} and {2} are too nearly collinear in the sketch to tell a plane from \
             them in 53 bits; choose others"
    )]
    Collinear(String, String, String),
    /// There are constraints that no tracker takes.
    #[error("{0}")]
    Constraints(String),
}

crate::debug_in_words!(GaugeError);

impl Gauge {
    /// The gauge of a problem.
    pub fn new(problem: &Problem) -> Self {
        let dimension = problem.dimension;
        let reference = problem.homotopy.reference.clone();
        let m = if reference.is_empty() {
            dimension * problem.points.len()
        } else {
            free_coordinates(dimension, problem.points.len())
        };
        let mut place = Vec::with_capacity(m);
        let mut variable = vec![m; problem.points.len() * dimension];
        for p in 0..problem.points.len() {
            // The k-th reference point has its first k coordinates free.
            let free = reference.iter().position(|&r| r == p).unwrap_or(dimension);
            for axis in 0..free {
                variable[p * dimension + axis] = place.len();
                place.push(p * dimension + axis);
            }
        }
        assert_eq!(place.len(), m);
        Gauge {
            dimension,
            reference,
            place,
            variable,
        }
    }

    /// Makes room for auxiliary unknowns behind the free coordinates.
    pub(super) fn append(&mut self, unknowns: usize) {
        let free = self.place.len();
        for variable in &mut self.variable {
            if *variable == free {
                *variable = free + unknowns;
            }
        }
    }

    /// How the gauge lies in the coordinates of the problem, as the sketch has it: in the same place where
    /// there is no reference.
    pub fn placement(&self, problem: &Problem) -> Result<Placement, GaugeError> {
        let name = |k: usize| problem.points[self.reference[k]].name.clone();
        let coordinates = |p: usize| problem.points[p].sketch.each_ref().each(enclose);
        if self.reference.is_empty() {
            let one = |axis: usize| array(|k| point(f64::from(u8::from(k == axis))));
            return Ok(Placement {
                origin: [point(0.0); 3],
                axes: array(one),
            });
        }
        let origin = coordinates(self.reference[0]);
        let from_origin = |p: usize| minus(coordinates(p), origin);

        let along = from_origin(self.reference[1]);
        let e1 = unit(along).ok_or_else(|| GaugeError::Coincident(name(0), name(1)))?;
        let zero = point(0.0);
        let (e2, e3) = if self.dimension == 2 {
            ([-e1[1], e1[0], zero], [zero, zero, point(1.0)])
        } else {
            // The normal first: two cross products lose less than a projection.
            let collinear = || GaugeError::Collinear(name(0), name(1), name(2));
            let e3 = unit(cross(e1, from_origin(self.reference[2]))).ok_or_else(collinear)?;
            (cross(e3, e1), e3)
        };
        Ok(Placement {
            origin,
            axes: [e1, e2, e3],
        })
    }

    /// Encloses the coordinates of the sketch in the gauge, point by point.
    ///
    /// With a reference the sketch is moved, not mirrored: p ↦ Rᵀ(p − p₁) with R's columns the unit vectors from
    /// p₁ to p₂, perpendicular to it towards p₃, and their cross product.
    pub fn sketch(&self, problem: &Problem) -> Result<Vec<[Interval; 3]>, GaugeError> {
        let Placement { origin, axes } = self.placement(problem)?;
        Ok((0..problem.points.len())
            .map(|p| {
                let v = minus(problem.points[p].sketch.each_ref().each(enclose), origin);
                let mut out = axes.each(|axis| dot(axis, v));
                for (axis, x) in out.iter_mut().enumerate() {
                    let fixed = axis >= self.dimension
                        || self.variable[p * self.dimension + axis] == self.place.len();
                    if fixed {
                        *x = point(0.0);
                    }
                }
                out
            })
            .collect())
    }
}

/// How the gauge lies in the coordinates of the problem: where the sketch has the first reference point,
/// the direction from it to the second, and (in space) the side of the third.
///
/// Figures come in the gauge, which proofs are about. This brings them back to where the sketch is drawn:
///
/// ```
/// use krawl::problem::Problem;
/// use krawl::system::Placement;
/// use krawl::track::prove;
///
/// # std::env::set_current_dir("../..").unwrap();
/// let problem = Problem::read("problems/k33.toml")?;
/// let outcome = prove(&problem)?;
/// let placement = Placement::of(&problem)?;
///
/// // With proof: an enclosure.
/// let first = outcome.solutions[0].point(&problem, "p4").unwrap();
/// let there = placement.to_problem(first);
/// assert!(there[0].wid() < 1e-12);
///
/// // As a float motion, for what draws or computes on.
/// let motion: krawl::nalgebra::Isometry3<f64> = placement.motion();
/// let p4 = motion * outcome.solutions[0].nearest(&problem, "p4").unwrap();
/// assert!((p4.x - there[0].mid()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The gauge's origin.
    pub origin: [Interval; 3],
    /// The directions of its axes, of length 1 and perpendicular to each other.
    pub axes: [[Interval; 3]; 3],
}

impl Placement {
    /// The placement of a problem's gauge.
    ///
    /// # Errors
    /// If the sketch has the reference points in one place, or three of them on one line.
    pub fn of(problem: &Problem) -> Result<Self, GaugeError> {
        Gauge::new(problem).placement(problem)
    }

    /// The frame of some points, two in the plane and three in space: the first is its origin, the second in the direction of
    /// its first axis, the third on the side of its second. `None`: they have none that can be enclosed.
    pub fn through(dimension: usize, places: &[Vector]) -> Option<Placement> {
        let zero = point(0.0);
        let (&origin, &second) = (places.first()?, places.get(1)?);
        let e1 = unit(minus(second, origin))?;
        let axes = if dimension == 2 {
            [e1, [-e1[1], e1[0], zero], [zero, zero, point(1.0)]]
        } else {
            let e3 = unit(cross(e1, minus(*places.get(2)?, origin)))?;
            [e1, cross(e3, e1), e3]
        };
        Some(Placement { origin, axes })
    }

    /// A point as it is seen in the frame: an enclosure.
    pub fn seen(&self, p: &Vector) -> Vector {
        self.axes.each(|axis| dot(axis, minus(*p, self.origin)))
    }

    /// The motion from the gauge to the coordinates of the problem, in floats: in the plane a turn about
    /// the z axis.
    pub fn motion(&self) -> Isometry3<f64> {
        let axes = self.axes.each(|axis| Vector3::from(axis.each(|x| x.mid())));
        // Columns are perpendicular and of length 1 but for rounding.
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&axes));
        Isometry3::from_parts(
            Translation3::from(self.origin.each(|x| x.mid())),
            UnitQuaternion::from_rotation_matrix(&rotation),
        )
    }

    /// A point of the gauge in the coordinates of the problem: an enclosure.
    pub fn to_problem(&self, p: &[Interval; 3]) -> [Interval; 3] {
        array(|k| {
            let [x, y, z] = self.axes;
            self.origin[k] + x[k] * p[0] + y[k] * p[1] + z[k] * p[2]
        })
    }
}
