//! Figures that are not rigid at t = 1: what is said of a run that stops there.
//!
//! Seen in floats, and said so: nothing of a proof rests on it.

use crate::equations::{left_side, slopes};
use crate::linalg::{Linear, decomposed, linearised, nearest};
use crate::problem::list;
use crate::system::{Homotopy, Term};
use nalgebra::DVector;

/// A run that stops further from t = 1 than this stops for another reason.
const NEAR: f64 = 1e-2;
/// Larger problems are not looked at: a decomposition into singular values takes the cube.
const MOST: usize = 250;
/// A singular value below this part of the largest counts as zero.
const RANK: f64 = 1e-5;
/// How far a figure is moved to see whether it meets its dimensions still, in the homotopy's unit.
const AWAY: f64 = 1e-2;
/// Residuals below this part of the size of the figure's square count as zero.
const MET: f64 = 1e-12;
/// Names of points that are listed.
const NAMED: usize = 4;

/// How the figure with t = 1 nearest to a point of the path (all unknowns, and t) can move with all its dimensions as they
/// should be, in words; `None` where it seems to be rigid, or the point is not near t = 1.
pub fn in_words(homotopy: &Homotopy, z: &[f64], t: f64) -> Option<String> {
    let m = homotopy.equations;
    if (t - 1.0).abs() > NEAR || m > MOST || m == 0 {
        return None;
    }
    let target = Target::new(homotopy);
    let size = z[..m].iter().fold(1.0, |max: f64, x| max.max(x.abs()));
    let x = target.nearest(DVector::from_column_slice(&z[..m]), size);
    let are_positive = homotopy.positive_unknowns().iter().all(|&i| x[i] > 1e-6);
    if target.off(&x) >= MET.sqrt() * size * size || !are_positive {
        return None;
    }
    let decomposed = decomposed(target.linearise(x.as_slice()).0, [false, true]);
    let largest = decomposed.singular_values.max();
    let rows = decomposed.v_t?;
    let small = |k: &usize| decomposed.singular_values[*k] < RANK * largest;
    let loose: Vec<DVector<f64>> = (0..m)
        .filter(small)
        .map(|k| rows.row(k).transpose())
        .collect();
    if loose.is_empty() {
        return None;
    }
    let really: Vec<&DVector<f64>> = loose.iter().filter(|v| target.moves(&x, v, size)).collect();
    let moving = |motions: &[&DVector<f64>]| list(&names(homotopy, motions), NAMED);
    Some(
        match really.as_slice() {
            [] => format!(
                "at t = 1 the figure appears to be singular: for an instant {} can move with all dimensions as they should be",
                moving(&loose.iter().collect::<Vec<_>>())
            ),
            motions => format!(
                "at t = 1 the figure appears to be flexible: {} can move with all dimensions as they should be, so that no \
             single solution is there",
                moving(motions)
            ),
        } + " (seen in floats)",
    )
}

/// The points that move most, or of a problem without points the unknowns; those first that move by more.
fn names(homotopy: &Homotopy, motions: &[&DVector<f64>]) -> Vec<String> {
    let of_point = |p: usize| -> f64 {
        let coordinates = (0..homotopy.dimension).filter_map(|axis| homotopy.coordinate(p, axis));
        let squares = coordinates.map(|i| motions.iter().map(|v| v[i] * v[i]).sum::<f64>());
        squares.sum::<f64>().sqrt()
    };
    let of_unknown = |u: usize| motions.iter().map(|v| v[u] * v[u]).sum::<f64>().sqrt();
    let mut all: Vec<(usize, f64)> = match homotopy.points {
        0 => (0..homotopy.equations)
            .map(|u| (u, of_unknown(u)))
            .collect(),
        points => (0..points).map(|p| (p, of_point(p))).collect(),
    };
    let most = all.iter().fold(0.0, |max: f64, x| max.max(x.1));
    all.retain(|x| x.1 > 1e-3 * most);
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let name = |&(p, _): &(usize, f64)| match homotopy.points {
        0 => Some(homotopy.tail.unknowns.get(p)?.name.clone()),
        _ => homotopy.point_names.get(p).cloned(),
    };
    all.iter().filter_map(name).collect()
}

/// F(X, 1) in floats.
pub struct Target {
    terms: Vec<Vec<Term>>,
    rights: Vec<f64>,
    m: usize,
}

impl Target {
    /// All equations of a homotopy.
    pub fn new(homotopy: &Homotopy) -> Self {
        let m = homotopy.equations;
        Target {
            terms: (0..m).map(|e| homotopy.terms(e)).collect(),
            rights: homotopy
                .rights
                .iter()
                .map(|r| r.at_target().mid())
                .collect(),
            m,
        }
    }

    /// The left-hand side of an equation, and its derivatives one by one.
    pub fn evaluate(&self, e: usize, x: &[f64], mut slope: impl FnMut(usize, f64)) -> f64 {
        let at = |entry: Option<usize>| entry.map_or(0.0, |i| x[i]);
        slopes(&self.terms[e], at, |entry, by| {
            entry.into_iter().for_each(|i| slope(i, by));
        });
        left_side(&self.terms[e], at)
    }

    fn linearise(&self, x: &[f64]) -> Linear {
        linearised((self.m, self.m), &|e, slope| {
            self.evaluate(e, x, slope) - self.rights[e]
        })
    }

    /// By how much the equations are not met at most.
    fn off(&self, x: &DVector<f64>) -> f64 {
        self.linearise(x.as_slice()).1.amax()
    }

    /// A zero near a point, as far as the method of Levenberg and Marquardt comes.
    fn nearest(&self, x: DVector<f64>, size: f64) -> DVector<f64> {
        nearest(x, [MET * size * size, size], &|x| self.linearise(x))
    }

    /// Whether there is another figure with the same dimensions in this direction, or the opposite one.
    fn moves(&self, x: &DVector<f64>, v: &DVector<f64>, size: f64) -> bool {
        let step = AWAY * size / v.amax();
        [step, -step].into_iter().any(|step| {
            let y = self.nearest(x + v * step, size);
            self.off(&y) < 10.0 * MET * size * size && (y - x).amax() > 0.25 * AWAY * size
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;

    /// Two equal triangles joined by three bars, led to bars of the same length between triangles that are not turned.
    #[test]
    fn a_parallel_motion_is_flexible() {
        let mut build = Problem::build("two triangles", 2);
        for (name, at) in [
            ("a", ["0", "0"]),
            ("b", ["4", "0"]),
            ("c", ["1", "3"]),
            ("d", ["0", "5"]),
            ("e", ["4", "5"]),
            ("f", ["1", "8"]),
        ] {
            build = build.point(
                name,
                at.map(|x| x.parse::<crate::problem::Decimal>().unwrap()),
            );
        }
        for (a, b, squared) in [
            ("a", "b", 16),
            ("b", "c", 18),
            ("c", "a", 10),
            ("d", "e", 16),
            ("e", "f", 18),
            ("f", "d", 10),
            ("a", "d", 25),
            ("b", "e", 25),
            ("c", "f", 25),
        ] {
            build = build.squared_distance(a, b, squared);
        }
        let problem = build.finish().unwrap();
        let homotopy = Homotopy::new(&problem).unwrap();
        let z: Vec<f64> = homotopy.sketch_of_unknowns().map(|x| x.mid()).collect();
        let words = in_words(&homotopy, &z, 1.0).unwrap();
        assert!(words.contains("flexible"), "{words}");
        for name in ["d", "e", "f"] {
            assert!(words.contains(name), "{words}");
        }
        assert_eq!(in_words(&homotopy, &z, 0.5), None);
    }

    #[test]
    fn a_flat_triangle_is_singular_and_a_regular_figure_is_neither() {
        let triangle = |side: i32| {
            let problem = Problem::build("triangle", 2)
                .point("a", [0, 0])
                .point("b", [4, 0])
                .point("c", [2, 0])
                .distance("a", "b", 4)
                .distance("b", "c", side)
                .distance("c", "a", side)
                .finish()
                .unwrap();
            let homotopy = Homotopy::new(&problem).unwrap();
            let mut z: Vec<f64> = homotopy.sketch_of_unknowns().map(|x| x.mid()).collect();
            z[2] = 1e-3;
            in_words(&homotopy, &z, 1.0)
        };
        let words = triangle(2).unwrap();
        assert!(
            words.contains("singular: for an instant c can move"),
            "{words}"
        );
        assert_eq!(triangle(3), None);
    }
}
