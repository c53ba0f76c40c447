//! Chains of points and bars, and problems made of them.

pub(super) use crate::interval::vector::{cross, distance, dot, minus};
use crate::places::{Each as _, array};
use crate::problem::Problem;
use crate::random::Random;

pub(super) type V3 = [f64; 3];

/// The radius of the circle round which all chains wind, in lengths of a bar: small enough that
/// levers do not make the Jacobian's condition grow, large enough that bars are nearly straight.
pub(super) const RADIUS: f64 = 6.0;

/// How far points are from their regular places, so that nothing is symmetric.
pub(super) const JITTER: f64 = 0.08;

/// The regular lengths change by this fraction, divided by the root of their number: what many
/// small changes add up to then does not depend on the size.
const CHANGE: f64 = 0.1;

/// A rigid chain, its points numbered along it.
pub(super) struct Frame {
    pub dimension: usize,
    pub points: Vec<V3>,
    pub bars: Vec<[usize; 2]>,
    /// Where it can be made to turn, in the order of the chain.
    pub hinges: Vec<Hinge>,
}

impl Frame {
    /// Each point is joined to as many before it as there are dimensions. Without the bar to the last of these, what comes after turns
    /// about the others: a point, or the line through two.
    pub fn of_simplices(dimension: usize, points: Vec<V3>) -> Self {
        let (mut bars, mut hinges) = (Vec::new(), Vec::new());
        for k in 1..points.len() {
            for back in 1..=k.min(dimension) {
                if back == dimension {
                    hinges.push(Hinge {
                        axis: [k - 1, k + 1 - dimension],
                        first: k,
                        bar: bars.len(),
                    });
                }
                bars.push([k - back, k]);
            }
        }
        Frame {
            dimension,
            points,
            bars,
            hinges,
        }
    }
}

/// A bar without which all points from one on turn about an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hinge {
    /// Two points in space; in the plane, twice the same.
    pub axis: [usize; 2],
    /// The first point behind the hinge.
    pub first: usize,
    /// Index of the bar.
    pub bar: usize,
}

/// Points and bars with the lengths that they are to have; the bend last.
pub(super) struct Structure {
    pub dimension: usize,
    pub points: Vec<V3>,
    /// Bars, and by which factor the target is longer than the sketch; none for the regular ones.
    pub bars: Vec<([usize; 2], Option<f64>)>,
    pub bend_coefficient: f64,
}

impl Structure {
    /// Rounds everything to decimals. Lengths are measured between rounded places.
    pub fn problem(mut self, name: &str, random: &mut Random) -> Problem {
        for x in self.points.as_flattened_mut() {
            *x = (*x * 1e4).round() * 1e-4;
        }
        let names: Vec<String> = (1..=self.points.len()).map(|k| format!("p{k}")).collect();
        let mut builder = Problem::build(name, self.dimension).source("krawl generate");
        for (name, place) in names.iter().zip(&self.points) {
            let place = place.iter().take(self.dimension);
            builder = builder.point(name, place.map(|&x| decimal(x, 4)));
        }
        let change = CHANGE / (self.bars.len() as f64).sqrt();
        for &([a, b], factor) in &self.bars {
            let factor = factor.unwrap_or_else(|| 1.0 + change * random.symmetric());
            let length = factor * distance(self.points[a], self.points[b]);
            builder = builder.distance(&names[a], &names[b], decimal(length, 5));
        }
        builder
            .reference(&names[..self.dimension])
            .bend_coefficient(decimal(self.bend_coefficient, 4))
            .finish()
            .expect("a structure is a problem")
    }
}

/// The text of a decimal with so many digits behind the point.
fn decimal(x: f64, digits: usize) -> crate::problem::Decimal {
    format!("{x:.digits$}")
        .parse()
        .expect("a number of moderate size")
}

/// The place at the angle `angle` on the circle, `out` further outside and `up` above it.
pub(super) fn on_circle(angle: f64, out: f64, up: f64) -> V3 {
    let radius = RADIUS + out;
    [radius * angle.cos(), radius * angle.sin(), up]
}

pub(super) fn plus(a: V3, b: V3) -> V3 {
    array(|k| a[k] + b[k])
}

pub(super) fn times(s: f64, a: V3) -> V3 {
    a.each(|x| s * x)
}
