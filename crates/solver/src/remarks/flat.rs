//! Where the sketch is singular because points are on one line or in one plane, exactly.

use super::{Remark, joined, tetrahedra, triangles};
use crate::constraint::{cross, dot, is_zero};
use crate::interval::vector;
use crate::places::Each as _;
use crate::problem::{Object, Problem, Shape};
use crate::rational::Rational;
use crate::system::Homotopy;

type Vector = [Rational; 3];

fn from(problem: &Problem, a: usize, b: usize) -> Vector {
    let [a, b] = [a, b].each(|p| &problem.points[p].sketch);
    std::array::from_fn(|k| b[k].value() - a[k].value())
}

/// Whether some vectors span less than the whole plane or space.
fn are_flat(dimension: usize, vectors: &[Vector]) -> bool {
    let Some(first) = vectors.iter().find(|v| !is_zero(v)) else {
        return true;
    };
    let normals = vectors.iter().map(|v| cross(first, v));
    let mut normals = normals.filter(|n| !is_zero(n));
    match (dimension, normals.next()) {
        (_, None) => true,
        (2, Some(_)) => false,
        (_, Some(normal)) => vectors.iter().all(|v| dot(&normal, v).is_zero()),
    }
}

/// A sketch in space of which all points are in one plane, where the path does not leave it as it does with one height
/// more than conditions on heights.
///
/// In a flat figure the derivatives of conditions that change their sign with the heights are zero but for those by the
/// heights, and those of all other equations are zero by the heights. So the Jacobian has two blocks, and the path's
/// direction, which it takes to zero, is in the plane where there are as many conditions as heights, and so are all points of the
/// path, as the flat figures fill a curve of their own there. Where there are more conditions than heights,
/// or fewer by more than one, one of the blocks has too few independent rows.
pub(super) fn sketch(problem: &Problem) -> Vec<Remark> {
    let vectors: Vec<Vector> = (1..problem.points.len())
        .map(|p| from(problem, 0, p))
        .collect();
    // Those are not where points are.
    let is_own = |o: &Object| matches!(o.shape, Shape::FreeLine { .. } | Shape::FreePlane { .. });
    if problem.dimension != 3 || !are_flat(3, &vectors) || problem.objects.iter().any(is_own) {
        return Vec::new();
    }
    let homotopy = Homotopy::new(problem).ok();
    let counts = homotopy.and_then(|homotopy| homotopy.odd_in_heights());
    let found = counts.filter(|&[conditions, heights]| heights != conditions + 1);
    let remark = found.map(|[conditions, heights]| Remark::FlatSketch {
        conditions,
        heights,
    });
    remark.into_iter().collect()
}

/// Parts of a figure this near to a line or plane, in parts of its size, are looked at exactly.
const NEAR: f64 = 1e-9;
/// Most points of problems in which parts are looked for: it takes their third power.
const MANY: usize = 200;

/// Points that are on one line (in space: in one plane), more than three (four) of them, with more distances among them
/// than can be independent there: n − 1 of n points on a line, 2n − 3 in a plane.
pub(super) fn parts(problem: &Problem) -> Vec<Remark> {
    let (d, n) = (problem.dimension, problem.points.len());
    if n > MANY {
        return Vec::new();
    }
    let joined = joined(problem);
    let mut found: Vec<Vec<usize>> = Vec::new();
    let mut out = Vec::new();
    for middle in 0..n {
        for (k, &(a, _)) in joined[middle].iter().enumerate() {
            let others = match d {
                // A side is a line already.
                2 => &joined[middle][k..=k],
                _ => &joined[middle][k + 1..],
            };
            for &(b, _) in others {
                let seed = [middle, a, b];
                let known = |part: &Vec<usize>| seed.iter().all(|p| part.contains(p));
                if found.iter().any(known) {
                    continue;
                }
                let Some(points) = flat_with(problem, seed) else {
                    continue;
                };
                let inside = |&&[p, q]: &&[usize; 2]| points.contains(&p) && points.contains(&q);
                let pairs: Vec<[usize; 2]> = problem.distances.iter().map(|e| e.points).collect();
                let distances = pairs.iter().filter(inside).count();
                let most = match d {
                    2 => points.len() - 1,
                    _ => 2 * points.len() - 3,
                };
                // Of a triangle (tetrahedron) `in_sketch` speaks.
                if points.len() > d + 1 && distances > most {
                    out.push(Remark::FlatPart {
                        points: points.clone(),
                        distances,
                    });
                }
                found.push(points);
            }
        }
    }
    out
}

/// All points that are in one plane with three of them, or in the plane on one line with two: exactly. `None`: those three are on
/// one line in space.
fn flat_with(problem: &Problem, [middle, a, b]: [usize; 3]) -> Option<Vec<usize>> {
    let d = problem.dimension;
    let places = problem.places();
    let nearly = |p: usize| vector::minus(places[p], places[middle]);
    let (u, v) = (nearly(a), nearly(b));
    let size = vector::length;
    let exact = [from(problem, middle, a), from(problem, middle, b)];
    let normal = match d {
        2 => None,
        _ => Some(cross(&exact[0], &exact[1])).filter(|normal| !is_zero(normal)),
    };
    if d == 3 && normal.is_none() {
        return None;
    }
    let is_in = |p: usize| {
        let w = nearly(p);
        // Most are far from it, which floats tell.
        let far = match d {
            2 => size(vector::cross(u, w)) > NEAR * size(u) * size(w),
            _ => {
                let n = vector::cross(u, v);
                let along = n.iter().zip(w).map(|(a, b)| a * b).sum::<f64>();
                along.abs() > NEAR * size(n) * size(w) && size(n) > NEAR * size(u) * size(v)
            }
        };
        if far {
            return false;
        }
        let w = from(problem, middle, p);
        match &normal {
            None => is_zero(&cross(&exact[0], &w)),
            Some(normal) => dot(normal, &w).is_zero(),
        }
    };
    Some((0..problem.points.len()).filter(|&p| is_in(p)).collect())
}

/// Points that are on one line or in one plane with all those that they are joined to; triangles (tetrahedra) of
/// joined points that are flat and not among these.
pub(super) fn in_sketch(problem: &Problem) -> Vec<Remark> {
    let d = problem.dimension;
    let mut all = Vec::new();
    let mut loose = vec![false; problem.points.len()];
    for (point, joined) in joined(problem).into_iter().enumerate() {
        let joined: Vec<usize> = joined.into_iter().map(|(p, _)| p).collect();
        // A triangle in space cannot but be in a plane; its points are no looser for that.
        if problem.points.len() <= d {
            break;
        }
        let sides: Vec<Vector> = joined.iter().map(|&p| from(problem, point, p)).collect();
        if are_flat(d, &sides) {
            loose[point] = true;
            all.push(Remark::Loose { point, joined });
        }
    }
    let sets: Vec<Vec<usize>> = match d {
        2 => triangles(problem)
            .into_iter()
            .map(|(points, _)| points.to_vec())
            .collect(),
        _ => tetrahedra(problem)
            .into_iter()
            .map(|points| points.to_vec())
            .collect(),
    };
    for points in sets {
        let sides: Vec<Vector> = points[1..]
            .iter()
            .map(|&p| from(problem, points[0], p))
            .collect();
        if are_flat(d, &sides) && !points.iter().any(|&p| loose[p]) {
            all.push(Remark::FlatInSketch(points));
        }
    }
    if d == 3 {
        for ([a, b, c], _) in triangles(problem) {
            let sides = [from(problem, a, b), from(problem, a, c)];
            if is_zero(&cross(&sides[0], &sides[1])) {
                all.push(Remark::FlatInSketch(vec![a, b, c]));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::remarks::{in_words, remarks};

    /// A base of six points in a plane, held by twelve distances, and an apex over it.
    fn tent(heights: [&str; 6]) -> Problem {
        let base = [(0, 0), (4, 0), (6, 3), (4, 6), (0, 6), (-2, 3)];
        let mut build = Problem::build("tent", 3);
        for (k, ((x, y), z)) in base.iter().zip(heights).enumerate() {
            let (x, y) = (x.to_string(), y.to_string());
            build = build.point(&format!("b{k}"), [x.as_str(), y.as_str(), z]);
        }
        build = build.point("top", ["1", "2", "5"]);
        for k in 0..6 {
            for step in [1, 2] {
                let (a, b) = (k, (k + step) % 6);
                build = build.distance(&format!("b{a}"), &format!("b{b}"), "5");
            }
        }
        for k in [0, 2, 4] {
            build = build.distance("top", &format!("b{k}"), "6");
        }
        build.finish().unwrap()
    }

    #[test]
    fn a_flat_base_is_named_as_one_part() {
        let problem = tent(["0"; 6]);
        let found = remarks(&problem);
        let part = Remark::FlatPart {
            points: (0..6).collect(),
            distances: 12,
        };
        assert!(found.contains(&part), "{found:?}");
        let words = in_words(&problem, &part);
        assert!(
            words.contains("b0, b1, b2, b3, b4 and b5 are in one plane, with 12 distances")
                && words.contains("no more than 9")
                && words.contains("[bodies]"),
            "{words}"
        );
        // Not said again of single points of it.
        let loose = |r: &Remark| matches!(r, Remark::Loose { point, .. } if *point < 6);
        assert!(!found.iter().any(loose), "{found:?}");
        // As little as this out of the plane.
        let problem = tent(["0", "0", "0", "0", "0", "1e-12"]);
        let found = remarks(&problem);
        let is_part = |r: &Remark| matches!(r, Remark::FlatPart { points, .. } if points.len() > 5);
        assert!(!found.iter().any(is_part), "{found:?}");
    }

    /// Of one shipped problem the sketch is singular once it is drawn flat, of another one the path stays in the plane, and of
    /// a pyramid with a quadrangle for a base it leaves it.
    #[test]
    fn a_sketch_drawn_flat_is_named() {
        let flat = |mut problem: Problem| {
            assert!(sketch(&problem).is_empty());
            for point in &mut problem.points {
                point.sketch[2] = 0.into();
            }
            let found = sketch(&problem);
            found.first().map(|remark| in_words(&problem, remark))
        };
        let shipped = |name: &str| {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../problems/constraints");
            Problem::read(format!("{folder}/{name}.toml")).unwrap()
        };
        let words = flat(shipped("hexahedron")).unwrap();
        assert!(words.contains("the sketch is singular"), "{words}");
        let words = flat(shipped("pentahedron")).unwrap();
        assert!(words.contains("all figures on it are flat"), "{words}");
        let pyramid = "name = \"pyramid\"\ndimension = 3\n[points]\na = [0, 0, 0]\nb = [2, 0, 0]\nc = [2.1, 1.8, 0]\n\
                       d = [0.1, 1.7, 0]\ne = [1, 0.9, 1.6]\n[constraints]\ncoplanar = [[\"a\", \"b\", \"c\", \"d\"]]\n\
                       distances = [[\"a\", \"b\", 2], [\"b\", \"c\", 2], [\"c\", \"d\", 2.1], [\"d\", \"a\", 1.9], \
                       [\"a\", \"e\", 2], [\"b\", \"e\", 2.1], [\"c\", \"e\", 1.9], [\"a\", \"c\", 2.9]]\n";
        assert_eq!(flat(Problem::parse(pyramid, "pyramid.toml").unwrap()), None);
    }
}
