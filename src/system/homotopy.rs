//! H(X, t), as the trackers see it.

use super::{ExactLength, Gauge, GaugeError, Length};
use crate::interval::{Interval, enclose, enclose_rational, point};
use crate::problem::{Problem, Target};

/// Two points at a given distance, as places: `point * dimension` of either.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// First point and second point.
    pub points: [usize; 2],
}

/// The homotopy H(X, t) = F(X, a(t)) = 0 of a problem (RR 8705, section 2.2), m equations in the
/// m free coordinates and t.
///
/// All lengths and coordinates in here are divided by [`Homotopy::unit`], a power of two near the
/// problem's typical length, so that results do not depend on the scale of the input. A *figure*
/// is a vector of `points * dimension` places, in which fixed coordinates are zero.
#[derive(Debug, Clone)]
pub struct Homotopy {
    /// 2 or 3.
    pub dimension: usize,
    /// The number of points.
    pub points: usize,
    /// The number m of equations and of free coordinates.
    pub equations: usize,
    /// The length that 1 stands for in here: a power of two.
    pub unit: f64,
    /// Which coordinates are free.
    pub gauge: Gauge,
    /// The distances, in the problem's order.
    pub edges: Vec<Edge>,
    /// Their lengths, in the same order.
    pub lengths: Vec<Length>,
    /// What they are made of, exactly.
    pub exact_lengths: Vec<ExactLength>,
    /// Which of them bends.
    pub bend: usize,
    /// What people call the distances.
    pub names: Vec<String>,
    /// An enclosure of the sketch, all places.
    pub sketch_box: Vec<Interval>,
    /// Its middle.
    pub sketch: Vec<f64>,
}

impl Homotopy {
    /// Sets up the homotopy of a checked problem.
    ///
    /// Fails where the sketch cannot be seen from the reference.
    pub fn new(problem: &Problem) -> Result<Self, GaugeError> {
        Self::with_unit(problem, typical_length(problem))
    }

    /// The same as the paper has it, in the lengths of the problem: the steps of RR 8705, section 7,
    /// are in them. Where the typical length is beyond 1/64 or 64 the paper's numbers would make no
    /// sense, and the unit is the typical length.
    pub fn for_the_paper(problem: &Problem) -> Result<Self, GaugeError> {
        let typical = typical_length(problem);
        let unit = if (1.0 / 64.0..=64.0).contains(&typical) {
            1.0
        } else {
            typical
        };
        Self::with_unit(problem, unit)
    }

    /// The same, with a unit of one's own choice.
    ///
    /// # Panics
    /// If `unit` is not a power of two: only divisions by such are exact.
    pub fn with_unit(problem: &Problem, unit: f64) -> Result<Self, GaugeError> {
        assert!(
            unit.is_normal() && unit > 0.0 && unit.to_bits() << 12 == 0,
            "the unit {unit} is not a power of two"
        );
        // No constraint is ever left out.
        if !problem.is_distances_only() {
            let refusal = "only distances between points can be solved for as yet; `krawl check` reads all \
                           other constraints";
            return Err(GaugeError::Constraints(refusal.to_owned()));
        }
        let gauge = Gauge::new(problem);
        let per_unit = point(1.0 / unit);
        let sketch_box: Vec<Interval> = gauge
            .sketch(problem)?
            .into_iter()
            .flat_map(|p| p.into_iter().take(problem.dimension))
            .map(|x| x * per_unit)
            .collect();
        let (lengths, exact_lengths) = problem
            .distances
            .iter()
            .enumerate()
            .map(|(index, distance)| {
                let [a, b] = distance.points.map(|p| &problem.points[p].sketch);
                let squared = (0..3).fold(
                    num_rational::BigRational::from_integer(0.into()),
                    |sum, k| {
                        let d = a[k].value() - b[k].value();
                        sum + &d * &d
                    },
                );
                let sketch = enclose_rational(&squared).sqrt();
                let target = match &distance.target {
                    Target::Length(length) => enclose(length),
                    Target::SquaredLength(squared) => enclose(squared).sqrt(),
                };
                let bend = (index == problem.homotopy.bend)
                    .then(|| enclose(&problem.homotopy.bend_coefficient) * per_unit);
                let exact = ExactLength {
                    sketch_squared: squared,
                    target: distance.target.clone(),
                    bend: (index == problem.homotopy.bend)
                        .then(|| problem.homotopy.bend_coefficient.clone()),
                    unit,
                };
                (
                    Length::new(sketch * per_unit, target * per_unit, bend),
                    exact,
                )
            })
            .unzip();
        Ok(Homotopy {
            dimension: problem.dimension,
            points: problem.points.len(),
            equations: gauge.place.len(),
            unit,
            edges: problem
                .distances
                .iter()
                .map(|d| Edge { points: d.points })
                .collect(),
            lengths,
            exact_lengths,
            bend: problem.homotopy.bend,
            names: (0..problem.distances.len())
                .map(|d| problem.distance_name(d))
                .collect(),
            sketch: sketch_box.iter().map(|x| x.mid()).collect(),
            sketch_box,
            gauge,
        })
    }

    /// F_e = ½(|p_i − p_j|² − a_e(t)²) for all distances, in floats.
    pub fn residual(&self, figure: &[f64], t: f64, out: &mut [f64]) {
        let d = self.dimension;
        for ((edge, length), f) in self.edges.iter().zip(&self.lengths).zip(out) {
            let [i, j] = edge.points.map(|p| p * d);
            let squared: f64 = (0..d)
                .map(|k| (figure[i + k] - figure[j + k]).powi(2))
                .sum();
            *f = 0.5 * (squared - length.value(t).powi(2));
        }
    }

    /// Where a length is nearly zero at t, beside what it is at either end, a remark for people who
    /// wonder why the run ended there: where two joined points coincide the equations are singular.
    pub fn remark_on_lengths(&self, t: f64) -> String {
        let part =
            |length: &Length| length.value(t).abs() / length.value(0.0).max(length.value(1.0));
        let parts = self.lengths.iter().map(part).enumerate();
        match parts.min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((index, part)) if part < 1e-3 => {
                let length = self.lengths[index].value(t).abs() * self.unit;
                format!(
                    "; the length of {} goes to zero there ({length:.1e})",
                    self.names[index]
                )
            }
            _ => String::new(),
        }
    }

    /// Spreads a vector of free coordinates over the places of a figure.
    pub fn scatter(&self, free: &[f64], figure: &mut [f64]) {
        figure.fill(0.0);
        for (&place, &x) in self.gauge.place.iter().zip(free) {
            figure[place] = x;
        }
    }
}

/// The power of two nearest to the mean target length.
fn typical_length(problem: &Problem) -> f64 {
    let lengths = problem.distances.iter().map(|d| match &d.target {
        Target::Length(length) => length.to_f64(),
        Target::SquaredLength(squared) => squared.to_f64().sqrt(),
    });
    let mean = lengths.sum::<f64>() / problem.distances.len().max(1) as f64;
    2f64.powi(mean.log2().round() as i32)
}
