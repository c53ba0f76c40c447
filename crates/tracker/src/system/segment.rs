//! Drawn lines along an axis and arcs: what of them must not shrink to nothing and come out turned round; and edges of outlines, circles
//! among them, that must not come to touch.

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
        /// The ends of a line, or centre, start and end of an arc, or the centre of a circle, of the one and then of the other.
        points: Vec<usize>,
        /// How many of these are of the first.
        first: usize,
        /// The unknowns that are the radii of those that are circles, in order.
        radii: Vec<usize>,
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

    /// The unknowns, beside coordinates of points, that it depends on.
    pub fn radii(&self) -> &[usize] {
        match self {
            Extent::Apart { radii, .. } => radii,
            _ => &[],
        }
    }

    /// The same of other unknowns, in the place of those that are [`Extent::radii`].
    pub fn map(&self, unknown: impl Fn(usize) -> usize) -> Self {
        let mut out = self.clone();
        if let Extent::Apart { radii, .. } = &mut out {
            radii.iter_mut().for_each(|u| *u = unknown(*u));
        }
        out
    }

    /// The sign, as `of` tells it of numbers, where the points are `at`, by place in [`Extent::points`]; behind these the radii, as first
    /// coordinates: of a line's length along its axis; of an arc that of the sine of its angle, or 1 where that is certain to be about 180 degrees; of edges that are certain to be apart 1.
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
            Extent::Apart {
                ref points, first, ..
            } => {
                let mut radii = (points.len()..).map(|k| at(k)[0]);
                let edges = [0..first, first..points.len()].map(|range| {
                    let points = range.map(|k| flat(at(k))).collect::<Vec<_>>();
                    match points[..] {
                        [centre] => Edge::Circle(centre, radii.next().expect("it has a radius")),
                        [a, b] => Edge::Line([a, b]),
                        _ => Edge::Arc([points[0], points[1], points[2]]),
                    }
                });
                i8::from(are_apart(edges, &of))
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

/// An edge in the plane.
enum Edge<T> {
    /// Its ends.
    Line([Flat<T>; 2]),
    /// Centre, start and end, counter-clockwise.
    Arc([Flat<T>; 3]),
    /// Centre and radius.
    Circle(Flat<T>, T),
}

impl<T: Ring + Copy> Edge<T> {
    /// The centre and the square of the radius of the circle that it is (a part of).
    fn round(&self) -> Option<(Flat<T>, T)> {
        match *self {
            Edge::Line(_) => None,
            Edge::Arc([centre, start, _]) => {
                let radius = sub(start, centre);
                Some((centre, dot(radius, radius)))
            }
            Edge::Circle(centre, radius) => Some((centre, radius * radius)),
        }
    }

    /// Whether it is certain not to meet a circle, of which the centre and the square of the radius are given.
    fn misses(&self, (centre, square): (Flat<T>, T), of: impl Fn(T) -> i8) -> bool {
        if let Edge::Line(ends) = self {
            let [p, q] = ends.map(|p| sub(p, centre));
            let along = sub(q, p);
            let area = cross(p, along);
            let is_off = |p: Flat<T>| of(dot(p, p) - square);
            // All of the line through it; the end that is nearest; all of it inside.
            return of(area * area - square * dot(along, along)) > 0
                || of(dot(p, along)) > 0 && is_off(p) > 0
                || of(dot(q, along)) < 0 && is_off(q) > 0
                || is_off(p) < 0 && is_off(q) < 0;
        }
        let Some((own, r)) = self.round() else {
            return false;
        };
        let way = sub(centre, own);
        let far = dot(way, way);
        // d > r + s or d < |r − s|.
        let off = far - r - square;
        if of(off * off - T::whole(4) * r * square) > 0 {
            return true;
        }
        let Edge::Arc([_, start, end]) = *self else {
            return false;
        };
        let [u, v] = [start, end].map(|p| sub(p, own));
        // A point of the arc, w from its centre, is outside where 2 w·way < d² + r − s, and inside where it is more. Of all of these w·way is
        // largest at an end, if the way is not in the arc's angle, and smallest at one, if the opposite way is not.
        let level = far + r - square;
        let sides = [u, v].map(|w| of(level - T::whole(2) * dot(w, way)));
        let is_short = of(cross(u, v)) > 0;
        let [before, behind] = [of(cross(u, way)), of(cross(way, v))];
        let is_beside = |sign: i8| {
            before * sign < 0 && behind * sign < 0
                || is_short && (before * sign < 0 || behind * sign < 0)
        };
        match sides {
            [1, 1] => is_beside(1),
            [-1, -1] => is_beside(-1),
            _ => false,
        }
    }

    /// Points, in a sixteenth of the unit, whose convex hull it is in, but of a circle.
    fn hull(&self, of: &impl Fn(T) -> i8) -> Option<Vec<Flat<T>>> {
        match self {
            Edge::Line(ends) => Some(ends.map(|p| times(16, p)).to_vec()),
            Edge::Arc(points) => Some(hull(points, of)),
            Edge::Circle(..) => None,
        }
    }

    /// An arc in parts that are quarters of its circle, and what is left, of which it is certain that it is less than a half; all of
    /// its circle where it is not certain how far the end is from the start. Any other edge as it is.
    fn parts(self, of: &impl Fn(T) -> i8) -> Vec<Edge<T>> {
        let Edge::Arc([centre, start, end]) = self else {
            return vec![self];
        };
        let [u, v] = [start, end].map(|p| sub(p, centre));
        let quarters = match (of(cross(u, v)), of(dot(u, v))) {
            (1, 1 | 0) => 0,
            (1, -1) | (0, -1) => 1,
            (-1, -1 | 0) => 2,
            (-1, 1) => 3,
            _ => 4,
        };
        let zero = T::whole(0);
        let turned = |[x, y]: Flat<T>| [zero - y, x];
        let (mut from, mut parts) = (u, Vec::with_capacity(4));
        for _ in 0..quarters {
            let to = turned(from);
            parts.push(Edge::Arc([centre, sum(centre, from), sum(centre, to)]));
            from = to;
        }
        if quarters < 4 {
            parts.push(Edge::Arc([centre, sum(centre, from), end]));
        }
        parts
    }
}

/// Whether edges are certain not to meet: as wholes, or each part of an arc and each of the other.
fn are_apart<T: Ring + Copy>(edges: [Edge<T>; 2], of: impl Fn(T) -> i8) -> bool {
    if are_apart_as_wholes(&edges[0], &edges[1], &of) {
        return true;
    }
    if !edges.iter().any(|edge| matches!(edge, Edge::Arc(_))) {
        return false;
    }
    let [one, other] = edges.map(|edge| edge.parts(&of));
    let mut pairs = one.iter().flat_map(|a| other.iter().map(move |b| (a, b)));
    pairs.all(|(a, b)| are_apart_as_wholes(a, b, &of))
}

fn are_apart_as_wholes<T: Ring + Copy>(
    one: &Edge<T>,
    other: &Edge<T>,
    of: &impl Fn(T) -> i8,
) -> bool {
    let are_parted = match [one, other].map(|edge| edge.hull(of)) {
        [Some(a), Some(b)] => is_parted(&a, &b, of) || is_parted(&b, &a, of),
        _ => false,
    };
    let misses = |a: &Edge<T>, b: &Edge<T>| b.round().is_some_and(|round| a.misses(round, of));
    are_parted || misses(one, other) || misses(other, one)
}

fn times<T: Ring + Copy>(by: i32, [x, y]: Flat<T>) -> Flat<T> {
    [T::whole(by) * x, T::whole(by) * y]
}

fn sum<T: Ring + Copy>(a: Flat<T>, b: Flat<T>) -> Flat<T> {
    [a[0] + b[0], a[1] + b[1]]
}

/// Points, in a sixteenth of the unit, whose convex hull has an arc in it: where it is certain to be less than half a circle the rectangle on its chord, and
/// otherwise the corners of a square around its circle.
///
/// For an arc of θ at most 180 degrees is above its chord, and no higher than tan(θ/4)/2 times the chord: a half, and less than 1/4 where cos θ > 0, than 1/8
/// where it is above 3/5, and than 1/16 where it is above 9/10.
fn hull<T: Ring + Copy>(
    &[centre, start, end]: &[Flat<T>; 3],
    of: &impl Fn(T) -> i8,
) -> Vec<Flat<T>> {
    let [u, v] = [start, end].map(|p| sub(p, centre));
    let (square, cosine) = (dot(u, u), dot(u, v));
    let is_above = |part: [i32; 2]| of(T::whole(part[1]) * cosine - T::whole(part[0]) * square) > 0;
    let height = match of(cross(u, v)) > 0 {
        true if is_above([9, 10]) => 1,
        true if is_above([3, 5]) => 2,
        true if is_above([0, 1]) => 4,
        true => 8,
        false => {
            let across = [T::whole(0) - u[1], u[0]];
            let corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
            let corner = |[a, b]: [i32; 2]| {
                let off = sum(times(16 * a, u), times(16 * b, across));
                sum(times(16, centre), off)
            };
            return corners.map(corner).to_vec();
        }
    };
    let [x, y] = sub(end, start);
    let off = times(height, [y, T::whole(0) - x]);
    let [start, end] = [start, end].map(|p| times(16, p));
    vec![start, sum(start, off), sum(end, off), end]
}

/// Whether an axis, or a line through two of the first points, is certain to part two sets of points.
fn is_parted<T: Ring + Copy>(a: &[Flat<T>], b: &[Flat<T>], of: impl Fn(T) -> i8) -> bool {
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

    /// A line, an arc from an angle on by another one, or a circle, of which the radius is the first coordinate of its second place.
    fn edge(mut random: impl FnMut() -> f64, kind: usize) -> Vec<[f64; 3]> {
        let at = [6.0 * random(), 6.0 * random()];
        let centre = [at[0], at[1], 0.0];
        if kind == 0 {
            let end = [at[0] + 3.0 * random(), at[1] + 3.0 * random(), 0.0];
            return vec![centre, end];
        }
        let (radius, from, by) = (
            0.3 + 4.0 * random().abs(),
            3.0 * random(),
            3.1 * (1.0 + random()) + 0.01,
        );
        let on = |angle: f64| {
            let [sin, cos] = [angle.sin(), angle.cos()];
            [at[0] + radius * cos, at[1] + radius * sin, 0.0]
        };
        match kind {
            1 => vec![centre, on(from), on(from + by)],
            _ => vec![centre, [radius, 0.0, 0.0]],
        }
    }

    /// Points along it.
    fn along(edge: &[[f64; 3]], kind: usize) -> Vec<[f64; 2]> {
        let centre = edge[0];
        let angle = |p: [f64; 3]| (p[1] - centre[1]).atan2(p[0] - centre[0]);
        let (radius, from, by) = match kind {
            0 => return edge.iter().map(|&p| flat(p)).collect(),
            1 => {
                let [start, end] = [edge[1], edge[2]];
                let by = (angle(end) - angle(start)).rem_euclid(std::f64::consts::TAU);
                let radius = (start[0] - centre[0]).hypot(start[1] - centre[1]);
                (radius, angle(start), by)
            }
            _ => (edge[1][0], 0.0, std::f64::consts::TAU),
        };
        let on = |k: i32| {
            let angle = from + by * f64::from(k) / 400.0;
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
        for kinds in [[0, 0], [0, 1], [1, 1], [0, 2], [1, 2], [2, 2], [2, 0]] {
            let (mut said, mut apart) = (0, 0);
            for _ in 0..500 {
                let edges = kinds.map(|kind| edge(&mut random, kind));
                let points = [0, 1].map(|k| match kinds[k] {
                    2 => &edges[k][..1],
                    _ => &edges[k][..],
                });
                let first = points[0].len();
                let radii = (0..2).filter(|&k| kinds[k] == 2).map(|k| edges[k][1]);
                let all: Vec<[f64; 3]> = [points.concat(), radii.collect()].concat();
                let extent = Extent::Apart {
                    points: (0..first + points[1].len()).collect(),
                    first,
                    radii: (0..all.len() - first - points[1].len()).collect(),
                };
                let sign = extent.sign(|k| all[k].map(point), sign_of);
                let [one, other] = [0, 1].map(|k| along(&edges[k], kinds[k]));
                let meet = meet(&one, &other);
                assert!(sign == 0 || !meet, "{edges:?}");
                (said, apart) = (said + i32::from(sign), apart + i32::from(!meet));
            }
            assert!(apart > 150, "{kinds:?}: {apart}");
            // Whether an edge meets a whole circle is told exactly.
            let least = if kinds.contains(&2) {
                apart - 2
            } else {
                apart * 99 / 100
            };
            assert!(said >= least, "{kinds:?}: {said} of {apart}");
        }
    }
}
