//! Drawn lines along an axis and arcs: what of them must not shrink to nothing and come out turned round; and edges of outlines that must
//! not come to touch.

use super::simplices::determinant;
use crate::equations::Ring;
use crate::interval::vector::minus;
use crate::places::Each as _;

/// A line or an arc that is drawn, and keeps its sense as long as it does not vanish.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Segment {
    /// The object that it is, by index.
    pub object: usize,
    /// The other edge of an outline, where it is two that are told.
    pub other: Option<usize>,
    /// Between which points.
    pub extent: Extent,
}

/// What of a segment keeps its sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Extent {
    /// How much further along an axis the second point is than the first, of a line along that axis.
    Along {
        /// The line's ends.
        ends: [usize; 2],
        /// The axis.
        axis: usize,
    },
    /// The angle of an arc, from its start to its end, which is more than 0 and less than 360 degrees as long as the end is not
    /// on the ray from the centre through the start.
    Sweep {
        /// Centre, start and end.
        points: [usize; 3],
    },
    /// Two edges in the plane, which do not touch.
    Apart {
        /// The ends of a line, or centre, start and end of an arc, of the one and then of the other.
        points: Vec<usize>,
        /// How many of these are of the first.
        first: usize,
    },
}

impl Extent {
    /// The points, in order.
    pub fn points(&self) -> &[usize] {
        match self {
            Extent::Along { ends, .. } => ends,
            Extent::Sweep { points } => points,
            Extent::Apart { points, .. } => points,
        }
    }

    /// The sign, as `of` tells it of numbers, where the points are `at`, by place in [`Extent::points`]: of a line's length along its
    /// axis; of an arc that of the sine of its angle, or 1 where that is certain to be about 180 degrees; of edges that are certain to be apart 1.
    /// 0: it is not certain that it does not vanish, or that they are apart.
    #[inline]
    pub fn sign<T: Ring + Copy>(&self, at: impl Fn(usize) -> [T; 3], of: impl Fn(T) -> i8) -> i8 {
        match *self {
            Extent::Along { axis, .. } => of(at(1)[axis] - at(0)[axis]),
            Extent::Sweep { .. } => {
                let points = [0, 1, 2].each(at);
                let [u, v] = [1, 2].each(|k| minus(points[k], points[0]));
                match of(determinant(3, |k| points[k])) {
                    0 if of(u[0] * v[0] + u[1] * v[1]) < 0 => 1,
                    sign => sign,
                }
            }
            Extent::Apart { ref points, first } => {
                let edges = [0..first, first..points.len()];
                let edges = edges.map(|range| range.map(|k| flat(at(k))).collect::<Vec<_>>());
                let hulls = edges.each_ref().map(|edge| hull(edge, &of));
                let [a, b] = &hulls;
                let is_so = are_apart(a, b, &of) || are_apart(b, a, &of) || misses(&edges, &of);
                i8::from(is_so)
            }
        }
    }

    /// Whether a sign is that of an extent that had another one before and did not vanish between.
    pub fn goes_with(&self, before: i8, sign: i8) -> bool {
        match self {
            Extent::Along { .. } => sign == before,
            // An arc grows past half a circle.
            Extent::Sweep { .. } | Extent::Apart { .. } => sign != 0,
        }
    }
}

/// A point in the plane.
type Flat<T> = [T; 2];

fn flat<T: Copy>(p: [T; 3]) -> Flat<T> {
    [p[0], p[1]]
}

fn sub<T: Ring + Copy>(a: Flat<T>, b: Flat<T>) -> Flat<T> {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot<T: Ring + Copy>(a: Flat<T>, b: Flat<T>) -> T {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<T: Ring + Copy>(a: Flat<T>, b: Flat<T>) -> T {
    a[0] * b[1] - a[1] * b[0]
}

/// Whether an edge is certain not to meet the circle of the other one, an arc.
fn misses<T: Ring + Copy>(edges: &[Vec<Flat<T>>; 2], of: impl Fn(T) -> i8) -> bool {
    let round = |arc: &[Flat<T>]| {
        let radius = sub(arc[1], arc[0]);
        (arc[0], dot(radius, radius))
    };
    let line_misses = |line: &[Flat<T>], arc: &[Flat<T>]| {
        let (centre, square) = round(arc);
        let [p, q] = [0, 1].map(|k| sub(line[k], centre));
        let along = sub(q, p);
        let area = cross(p, along);
        let is_off = |p: Flat<T>| of(dot(p, p) - square);
        // All of the line through it; the end that is nearest; all of it inside.
        of(area * area - square * dot(along, along)) > 0
            || of(dot(p, along)) > 0 && is_off(p) > 0
            || of(dot(q, along)) < 0 && is_off(q) > 0
            || is_off(p) < 0 && is_off(q) < 0
    };
    match &edges.each_ref().map(|edge| &edge[..]) {
        [line @ [_, _], arc @ [_, _, _]] | [arc @ [_, _, _], line @ [_, _]] => {
            line_misses(line, arc)
        }
        [one @ [_, _, _], other @ [_, _, _]] => {
            let ((a, r), (b, s)) = (round(one), round(other));
            let way = sub(b, a);
            // d > r + s or d < |r − s|.
            let off = dot(way, way) - r - s;
            of(off * off - T::whole(4) * r * s) > 0
        }
        _ => false,
    }
}

/// Points, in a quarter of the unit, whose convex hull has an edge in it: the two ends of a line; of an arc the corners of
/// a square around its circle, or, where it is certain to have less than 4 atan(5/4) = 205 degrees, its ends and the
/// points 5/4 r behind its start and before its end along the tangents there.
///
/// For the points of an arc of θ are in the polygon of the ends and of any two points on the tangents that are at least r tan(θ/4) away,
/// whose side between these then does not cut the circle; and where the tangents meet before that, tan(θ/2) ≤ 5/4, in the triangle of the ends
/// and that place.
fn hull<T: Ring + Copy>(edge: &[Flat<T>], of: &impl Fn(T) -> i8) -> Vec<Flat<T>> {
    let times = |by: i32, [x, y]: Flat<T>| [T::whole(by) * x, T::whole(by) * y];
    let sum = |a: Flat<T>, b: Flat<T>| [a[0] + b[0], a[1] + b[1]];
    let &[centre, start, end] = edge else {
        return edge.iter().map(|&p| times(4, p)).collect();
    };
    let [u, v] = [start, end].map(|p| sub(p, centre));
    let across = |[x, y]: Flat<T>, by: i32| times(by, [T::whole(0) - y, x]);
    let sine = cross(u, v);
    // sin θ > −2/5, of which the angle is 203.6 degrees.
    let is_half = || of(T::whole(5) * sine + T::whole(2) * dot(u, u)) > 0;
    let is_short = of(sine) > 0 || of(dot(u, v)) < 0 && is_half();
    let [start, end, centre] = [start, end, centre].map(|p| times(4, p));
    match is_short {
        true => vec![
            start,
            sum(start, across(u, 5)),
            sum(end, across(v, -5)),
            end,
        ],
        false => {
            let corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
            let corner = |[a, b]: [i32; 2]| sum(centre, sum(times(4 * a, u), across(u, 4 * b)));
            corners.map(corner).to_vec()
        }
    }
}

/// Whether an axis, or a line through two of the first points, is certain to part two sets of points.
fn are_apart<T: Ring + Copy>(a: &[Flat<T>], b: &[Flat<T>], of: impl Fn(T) -> i8) -> bool {
    let is_beyond = |axis: usize| {
        a.iter()
            .all(|p| b.iter().all(|q| of(q[axis] - p[axis]) > 0))
    };
    if is_beyond(0) || is_beyond(1) {
        return true;
    }
    let places = 0..a.len();
    let pairs = places
        .clone()
        .flat_map(|i| places.clone().map(move |j| (i, j)));
    pairs.filter(|(i, j)| i != j).any(|(i, j)| {
        let side = |p: &Flat<T>| of(cross(sub(a[j], a[i]), sub(*p, a[i])));
        let others = places.clone().filter(|&k| k != i && k != j);
        others.into_iter().all(|k| side(&a[k]) > 0) && b.iter().all(|p| side(p) < 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::point;
    use crate::system::sign_of;

    /// A line, or an arc from an angle on by another one.
    fn edge(mut random: impl FnMut() -> f64, is_arc: bool) -> Vec<[f64; 3]> {
        let at = [6.0 * random(), 6.0 * random()];
        if !is_arc {
            return vec![
                [at[0], at[1], 0.0],
                [at[0] + 3.0 * random(), at[1] + 3.0 * random(), 0.0],
            ];
        }
        let (radius, from, by) = (
            0.3 + random().abs(),
            3.0 * random(),
            3.1 * (1.0 + random()) + 0.01,
        );
        let on = |angle: f64| {
            [
                at[0] + radius * angle.cos(),
                at[1] + radius * angle.sin(),
                0.0,
            ]
        };
        vec![[at[0], at[1], 0.0], on(from), on(from + by)]
    }

    /// Points along it.
    fn along(edge: &[[f64; 3]]) -> Vec<[f64; 2]> {
        let &[centre, start, end] = edge else {
            return edge.iter().map(|&p| flat(p)).collect();
        };
        let angle = |p: [f64; 3]| (p[1] - centre[1]).atan2(p[0] - centre[0]);
        let by = (angle(end) - angle(start)).rem_euclid(std::f64::consts::TAU);
        let radius = (start[0] - centre[0]).hypot(start[1] - centre[1]);
        let on = |k: i32| {
            let angle = angle(start) + by * f64::from(k) / 400.0;
            [
                centre[0] + radius * angle.cos(),
                centre[1] + radius * angle.sin(),
            ]
        };
        (0..=400).map(on).collect()
    }

    fn meet(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
        let parts = |p: &[[f64; 2]], q: &[[f64; 2]]| {
            let side = |x: [f64; 2]| cross(sub(p[1], p[0]), sub(x, p[0]));
            side(q[0]) * side(q[1]) <= 0.0
        };
        a.windows(2)
            .any(|p| b.windows(2).any(|q| parts(p, q) && parts(q, p)))
    }

    #[test]
    fn edges_that_are_said_to_be_apart_do_not_meet() {
        let mut state = 7_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let (mut said, mut apart) = (0, 0);
        for k in 0..3000 {
            let edges = [k % 2, k / 2 % 2].map(|is_arc| edge(&mut random, is_arc == 1));
            let extent = Extent::Apart {
                points: (0..edges[0].len() + edges[1].len()).collect(),
                first: edges[0].len(),
            };
            let all = edges.concat();
            let sign = extent.sign(|k| all[k].map(point), sign_of);
            let [one, other] = edges.each_ref().map(|edge| along(edge));
            let meet = meet(&one, &other);
            assert!(sign == 0 || !meet, "{edges:?}");
            (said, apart) = (said + i32::from(sign), apart + i32::from(!meet));
        }
        assert!(apart > 2000 && said > apart * 24 / 25, "{said} of {apart}");
    }
}
