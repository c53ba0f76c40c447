//! Sketches that meet their dimensions and move all the same, though they have as many constraints as they need: flexible
//! octahedra, platforms whose legs keep their lengths along a curve.
//!
//! Where the Jacobian at the figure leaves a motion, the figure is moved a little along it and led back to its dimensions, again and
//! again. Only if it gets somewhere is that said, and as an observation: these are floats. A figure that is singular but stays
//! where it is goes back each time.

use crate::blocks::{Floats, System, straight};
use crate::linalg::{decomposed, shortest};
use crate::order::InOrder;
use crate::places::Each as _;
use crate::problem::{Distance, Problem, list};
use crate::system::typical_length;
use nalgebra::{DMatrix, DVector};

/// More unknowns are not looked at: it would take a second.
const MANY: usize = 150;
/// A sketch that misses its dimensions by more, as a part of its unit, does not meet them.
const MET: f64 = 1e-4;
/// One that misses a distance by more, likewise: that is more than [`MET`] of its equation, divided by the length of its gradient.
const FAR: f64 = 4.0 * MET;
/// Figures on the way miss them by no more than this beyond what the first one does.
const KEPT: f64 = 1e-9;
/// Singular values below this part of the largest leave a motion.
const ZERO: f64 = 1e-5;
/// How far a step goes, as a part of the unit, and how many there are.
const STEP: f64 = 0.02;
const STEPS: usize = 12;

/// How a sketch moves while it keeps its dimensions, as far as floats tell.
#[derive(Debug, Clone, PartialEq)]
pub struct Moves {
    /// The points that move most, by index.
    pub points: Vec<usize>,
    /// How far the first of them came at least, in the unit of the problem; it was followed no further.
    pub by: f64,
    /// No figure on the way misses a dimension, or another constraint, by more than about this.
    pub missed: f64,
}

impl Moves {
    /// What is said of it, in a sentence.
    pub fn in_words(&self, problem: &Problem) -> String {
        let points = self.points.iter().map(|&p| problem.points[p].name.as_str());
        let points: Vec<&str> = points.collect();
        format!(
            "It seems to move: from the sketch {} can be moved, the first by {:.2e} and perhaps further, with all constraints kept \
             within {:.0e} (seen in floats, not proved). If it does, its figures fill a curve, so that none of them can be proved \
             to be the only one near it, and they cannot be listed: `krawl motion --free DIMENSION` follows it; a dimension changed, or one more given, may stop it.",
            list(&points, 4),
            self.by,
            self.missed.max(1e-15)
        )
    }
}

/// Whether a sketch meets its dimensions and moves all the same. Nothing is said of sketches that have fewer constraints than
/// they need, of those that do not meet their dimensions, and of large ones.
pub fn moves(problem: &Problem) -> Option<Moves> {
    let unit = typical_length(problem);
    // Most sketches do not meet their dimensions: that is seen before any equation is made.
    if problem
        .distances
        .iter()
        .any(|d| off(problem, d) > FAR * unit)
    {
        return None;
    }
    let (problem, lowered) = straight(problem).ok()?;
    let system = System::new(&problem, &lowered, |_| true);
    let (width, d) = (system.unknowns.len(), problem.dimension);
    let whole = match problem.is_absolute() {
        true => 0,
        false => d * (d + 1) / 2,
    };
    if width > MANY || system.rows.len() + whole < width || width <= whole {
        return None;
    }
    let floats = Floats::new(&system, &lowered.tail.equations, unit);
    let all: Vec<usize> = (0..system.rows.len()).collect();
    let sketch = system.sketch(unit);
    if floats.missed(&all, &sketch) > MET {
        return None;
    }
    let (first, missed) = led(&floats, &all, sketch)?;
    let start = internal(&floats, &all, &first, (&system, d, whole), None)?;
    let most = missed + KEPT;
    let (mut x, mut way, mut worst) = (first.clone(), start, missed);
    for _ in 0..STEPS {
        let beside = x.iter().zip(way.iter()).map(|(x, v)| x + STEP * v);
        let (next, missed) = led(&floats, &all, beside.collect())?;
        let step = DVector::from_iterator(width, next.iter().zip(&x).map(|(a, b)| a - b));
        if missed > most || step.dot(&way) < 0.5 * STEP {
            return None;
        }
        way = internal(&floats, &all, &next, (&system, d, whole), Some(&step))?;
        (x, worst) = (next, worst.max(missed));
    }
    let far = |p: usize| {
        let of = system.coordinates[p * d..(p + 1) * d].iter();
        of.map(|&u| (x[u] - first[u]).powi(2)).sum::<f64>().sqrt()
    };
    let mut points: Vec<usize> = (0..problem.points.len()).collect();
    points.order_by(|&a, &b| far(b).total_cmp(&far(a)));
    let by = far(points[0]);
    points.retain(|&p| far(p) > 0.3 * by);
    points.truncate(3);
    Some(Moves {
        points,
        by: by * unit,
        missed: worst * unit,
    })
}

/// By how much the sketch misses a distance.
fn off(problem: &Problem, distance: &Distance) -> f64 {
    let [a, b] = distance.points.each(|p| &problem.points[p].sketch);
    let square = |k: usize| (a[k].to_f64() - b[k].to_f64()).powi(2);
    let is: f64 = (0..problem.dimension).map(square).sum();
    (is.sqrt() - distance.target.to_f64()).abs()
}

/// A place led to where equations are met as nearly as what is well determined allows, and by how much it misses them.
fn led(floats: &Floats, rows: &[usize], mut at: Vec<f64>) -> Option<(Vec<f64>, f64)> {
    for _ in 0..12 {
        let (jacobian, off) = floats.linearise(rows, &at);
        let svd = decomposed(jacobian, [true, true]);
        let zero = ZERO * svd.singular_values.max();
        let step = shortest(&svd, &off, zero)?;
        at.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        if at.iter().any(|x| !x.is_finite()) {
            return None;
        }
        if step.amax() < 1e-15 {
            break;
        }
    }
    let missed = floats.missed(rows, &at);
    Some((at, missed))
}

/// A motion that keeps all equations for an instant, of length 1, and is none of the whole; rather along `before`.
fn internal(
    floats: &Floats,
    rows: &[usize],
    at: &[f64],
    (system, d, whole): (&System, usize, usize),
    before: Option<&DVector<f64>>,
) -> Option<DVector<f64>> {
    let width = at.len();
    let (jacobian, _) = floats.linearise(rows, at);
    // Rows of zeros, so that all directions come out.
    let tall = jacobian.resize_vertically(width.max(rows.len()), 0.0);
    let svd = decomposed(tall, [false, true]);
    let (values, v) = (&svd.singular_values, svd.v_t.as_ref()?);
    let zero = ZERO * values.max();
    let kept = (0..width).filter(|&k| values[k] < zero);
    let kept: Vec<DVector<f64>> = kept.map(|k| v.row(k).transpose()).collect();
    if kept.len() <= whole {
        return None;
    }
    // Motions of the whole, by what they do to coordinates; also where something is fixed, as a figure that turns about that stays what it is.
    let mut rigid: Vec<DVector<f64>> = Vec::new();
    let axes = (0..d).map(|k| (None, k));
    let turns = (0..d).flat_map(|j| (0..j).map(move |k| (Some(j), k)));
    for (j, k) in axes.chain(turns) {
        let mut motion = DVector::zeros(width);
        for place in system.coordinates.chunks(d) {
            match j {
                None => motion[place[k]] = 1.0,
                Some(j) => {
                    motion[place[j]] = -at[place[k]];
                    motion[place[k]] = at[place[j]];
                }
            }
        }
        for _ in 0..2 {
            for other in &rigid {
                let along = motion.dot(other);
                motion.axpy(-along, other, 1.0);
            }
        }
        let size = motion.norm();
        if size > 1e-9 {
            rigid.push(motion / size);
        }
    }
    let mut is_coordinate = vec![false; width];
    system
        .coordinates
        .iter()
        .for_each(|&u| is_coordinate[u] = true);
    let without = |motion: &DVector<f64>| {
        let mut rest = motion.clone();
        (0..width)
            .filter(|&u| !is_coordinate[u])
            .for_each(|u| rest[u] = 0.0);
        for other in &rigid {
            let along = rest.dot(other);
            rest.axpy(-along, other, 1.0);
        }
        rest
    };
    let own: Vec<DVector<f64>> = kept.iter().map(without).collect();
    let parts = match before {
        // What of the way before is left.
        Some(before) => DVector::from_iterator(kept.len(), own.iter().map(|own| own.dot(before))),
        None => {
            let svd = decomposed(DMatrix::from_columns(&own), [false, true]);
            let most = svd.singular_values.imax();
            if svd.singular_values[most] < 1e-3 {
                return None;
            }
            svd.v_t.as_ref()?.row(most).transpose()
        }
    };
    let zero = DVector::zeros(width);
    let sum = kept
        .iter()
        .zip(parts.iter())
        .fold(zero, |sum, (motion, part)| sum + motion * *part);
    let size = sum.norm();
    (size > 1e-9).then(|| sum / size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn octahedron(last: &str) -> Problem {
        let text = "name = \"bricard\"\ndimension = 3\n[points]\na = [1, 0.2, 0.3]\naa = [-1, -0.2, 0.3]\nb = [0.3, 1.1, -0.4]\n\
                    bb = [-0.3, -1.1, -0.4]\nc = [0.6, -0.7, 0.8]\ncc = [-0.6, 0.7, 0.8]\n[constraints]\n\
                    squared_distances = [[\"a\",\"b\",1.79],[\"b\",\"aa\",3.87],[\"aa\",\"bb\",1.79],[\"bb\",\"a\",3.87],\
                    [\"a\",\"c\",1.22],[\"c\",\"aa\",3.06],[\"aa\",\"cc\",1.22],[\"cc\",\"a\",3.06],[\"b\",\"c\",4.77],\
                    [\"c\",\"bb\",2.41],[\"bb\",\"cc\",4.77],[\"cc\",\"b\",LAST]]\n";
        Problem::parse(&text.replace("LAST", last), "bricard.toml").unwrap()
    }

    #[test]
    fn an_octahedron_of_bricard_moves_and_one_beside_it_does_not() {
        let found = moves(&octahedron("2.41")).unwrap();
        assert!(found.by > 0.1 && found.missed < 1e-9, "{found:?}");
        assert_eq!(moves(&octahedron("2.41003")), None);
        assert_eq!(moves(&octahedron("2.5")), None);
    }

    /// A point on the line between two others can leave it for an instant, and goes back.
    #[test]
    fn what_is_only_singular_does_not_move() {
        let text = "name = \"flat\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [1, 0]\n[constraints]\n\
                    distances = [[\"a\",\"b\",4],[\"a\",\"c\",1],[\"b\",\"c\",3]]\n";
        assert_eq!(moves(&Problem::parse(text, "flat.toml").unwrap()), None);
    }
}
