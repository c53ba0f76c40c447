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

/// A circle: its centre, and the square of its radius.
type Round<T> = (Flat<T>, T);

impl<T: Ring + Copy> Edge<T> {
    /// The circle that it is (a part of), and the ends of an arc.
    fn round(&self) -> Option<(Round<T>, Option<[Flat<T>; 2]>)> {
        match *self {
            Edge::Line(_) => None,
            Edge::Arc([centre, start, end]) => {
                let radius = sub(start, centre);
                Some(((centre, dot(radius, radius)), Some([start, end])))
            }
            Edge::Circle(centre, radius) => Some(((centre, radius * radius), None)),
        }
    }
}

/// Whether edges are certain not to meet.
///
/// An arc is what of its circle is on one side of its chord: of what meets the circle only what is on that side matters.
fn are_apart<T: Ring + Copy>(edges: [Edge<T>; 2], of: impl Fn(T) -> i8) -> bool {
    match (&edges[0], &edges[1]) {
        (Edge::Line(a), Edge::Line(b)) => is_parted(a, b, &of) || is_parted(b, a, &of),
        (&Edge::Line(line), round) | (round, &Edge::Line(line)) => {
            let (circle, ends) = round.round().expect("it is round");
            misses(line, circle, &of) || ends.is_some_and(|ends| is_beyond(line, circle, ends, &of))
        }
        (one, other) => {
            let [one, other] = [one, other].map(|edge| edge.round().expect("it is round"));
            are_rounds_apart(one, other, &of)
        }
    }
}

/// Whether a line is certain not to meet a circle.
fn misses<T: Ring + Copy>(
    ends: [Flat<T>; 2],
    (centre, square): Round<T>,
    of: &impl Fn(T) -> i8,
) -> bool {
    let [p, q] = ends.map(|p| sub(p, centre));
    let along = sub(q, p);
    let area = cross(p, along);
    let is_off = |p: Flat<T>| of(dot(p, p) - square);
    // All of it is as far out towards one end: that is told of the shortest lines, too.
    let is_behind = |p: Flat<T>, q: Flat<T>| {
        let far = dot(p, q);
        is_off(p) > 0 && of(far) > 0 && of(far * far - square * dot(p, p)) > 0
    };
    // All of the line through it; the end that is nearest; all of it inside.
    of(area * area - square * dot(along, along)) > 0
        || of(dot(p, along)) > 0 && is_off(p) > 0
        || of(dot(q, along)) < 0 && is_off(q) > 0
        || is_off(p) < 0 && is_off(q) < 0
        || is_behind(p, q)
        || is_behind(q, p)
}

/// How far, times the length of an arc's chord, a point is from the chord on the side where the arc is not.
fn beyond<T: Ring + Copy>([start, end]: [Flat<T>; 2], p: Flat<T>) -> T {
    cross(sub(end, start), sub(p, start))
}

/// Whether what of a line is on an arc's side of its chord is certain not to meet the arc's circle.
fn is_beyond<T: Ring + Copy>(
    line: [Flat<T>; 2],
    (centre, square): Round<T>,
    ends: [Flat<T>; 2],
    of: &impl Fn(T) -> i8,
) -> bool {
    let sides = line.map(|p| beyond(ends, p));
    if sides.iter().all(|&side| of(side) > 0) {
        return true;
    }
    // From an end p that is beyond the chord, as q is less so or not, the line crosses it at (w p + a (q − p))/w, a and b being how far they are
    // beyond, w = a − b > 0. What is left of the line is looked at w times as large.
    [[0, 1], [1, 0]].into_iter().any(|[p, q]| {
        let (a, w) = (sides[p], sides[p] - sides[q]);
        let crossing = || sum(scaled(w, line[p]), scaled(a, sub(line[q], line[p])));
        let circle = || (scaled(w, centre), w * w * square);
        of(a) > 0 && of(w) > 0 && misses([crossing(), scaled(w, line[q])], circle(), of)
    })
}

/// Whether circles, or arcs of them, are certain not to meet.
///
/// With d from one centre to the other and A = d² + r² − s², the circles meet where 2 d² (x − c) = A d ± H d', d' being d turned by a right
/// angle, H² = 4 r² d² − A². At each of both places one of the arcs has to be on the other side of its chord.
fn are_rounds_apart<T: Ring + Copy>(
    (one, ends): (Round<T>, Option<[Flat<T>; 2]>),
    (other, others): (Round<T>, Option<[Flat<T>; 2]>),
    of: &impl Fn(T) -> i8,
) -> bool {
    let ((centre, r), (far, s)) = (one, other);
    let way = sub(far, centre);
    let square = dot(way, way);
    let level = square + r - s;
    let height = T::whole(4) * r * square - level * level;
    if of(height) < 0 {
        return true;
    }
    // Times 2 d², how far beyond a chord both places are, about their middle, and by ± H times what.
    let sides: Vec<[T; 2]> = [ends, others]
        .into_iter()
        .flatten()
        .map(|ends| {
            let chord = sub(ends[1], ends[0]);
            let from = scaled(T::whole(2) * square, sub(centre, ends[0]));
            let across = [T::whole(0) - way[1], way[0]];
            [
                cross(chord, sum(from, scaled(level, way))),
                cross(chord, across),
            ]
        })
        .collect();
    // Whether m + H by > 0.
    let is_above = |m: T, by: T| {
        let (is_more, sign) = (of(m * m - height * by * by), of(by));
        of(m) > 0 && (is_more > 0 || sign > 0) || sign > 0 && is_more < 0
    };
    let are_beyond = [1, -1].into_iter().all(|sign| {
        let mut sides = sides.iter();
        sides.any(|&[middle, by]| is_above(middle, T::whole(sign) * by))
    });
    // Arcs of nearly one circle meet it anywhere.
    let pairs = [(ends, far, others), (others, centre, ends)];
    are_beyond
        || pairs.into_iter().any(|(chord, centre, arc)| {
            chord
                .zip(arc)
                .is_some_and(|(chord, arc)| is_all_beyond(chord, centre, arc, of))
        })
}

/// Whether an arc is certain to be all beyond a chord, on the side where the chord's own arc is not: both its ends are, and no other
/// point of it is farther on the other side, as it has none whose radius is at a right angle to the chord there.
fn is_all_beyond<T: Ring + Copy>(
    chord: [Flat<T>; 2],
    centre: Flat<T>,
    arc: [Flat<T>; 2],
    of: &impl Fn(T) -> i8,
) -> bool {
    let [x, y] = sub(chord[1], chord[0]);
    let back = [y, T::whole(0) - x];
    let [u, v] = arc.map(|p| sub(p, centre));
    let [from, to] = [of(cross(u, back)), of(cross(back, v))];
    let is_short = of(cross(u, v)) > 0;
    let is_outside = from < 0 && to < 0 || is_short && (from < 0 || to < 0);
    is_outside && arc.iter().all(|&p| of(beyond(chord, p)) > 0)
}

fn scaled<T: Ring + Copy>(by: T, [x, y]: Flat<T>) -> Flat<T> {
    [by * x, by * y]
}

fn sum<T: Ring + Copy>(a: Flat<T>, b: Flat<T>) -> Flat<T> {
    [a[0] + b[0], a[1] + b[1]]
}

/// Whether an axis, or the line through the first one, is certain to part two lines.
fn is_parted<T: Ring + Copy>(a: &[Flat<T>; 2], b: &[Flat<T>; 2], of: impl Fn(T) -> i8) -> bool {
    let is_beyond = |axis: usize| {
        a.iter()
            .all(|p| b.iter().all(|q| of(q[axis] - p[axis]) > 0))
    };
    let sides = b.map(|p| of(cross(sub(a[1], a[0]), sub(p, a[0]))));
    is_beyond(0) || is_beyond(1) || matches!(sides, [1, 1] | [-1, -1])
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

    /// An end of the line is on the line through an arc's ends, within a rounding, away from the arc.
    #[test]
    fn a_line_that_ends_in_line_with_a_chord_is_apart() {
        let arc = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        for other in [[5.0, 4.0], [-4.0, 3.0], [-1.5, -3.0], [-1.2, -9.0]] {
            let line = [[-1.0, 3.0, 0.0], [other[0], other[1], 0.0]];
            let all = [&arc[..], &line].concat();
            let extent = Extent::Apart {
                points: (0..5).collect(),
                first: 3,
                radii: Vec::new(),
            };
            let around = |x: f64| crate::interval::hull(x - 1e-12, x + 1e-12);
            assert_eq!(extent.sign(|k| all[k].map(around), sign_of), 1, "{other:?}");
        }
    }

    /// Arcs of one circle, of which the one ends before the other begins, or after.
    #[test]
    fn arcs_of_one_circle_are_apart_or_not() {
        let on = |angle: f64| [2.0 * angle.cos() + 1.0, 2.0 * angle.sin() - 3.0, 0.0];
        let centre = [1.0, -3.0, 0.0];
        for (gap, sign) in [(0.3, 1), (-0.3, 0)] {
            for k in 0..20 {
                let (from, half) = (0.3 * f64::from(k), 0.1 * f64::from(k % 7) + 0.2);
                let one = [centre, on(from), on(from + half)];
                let other = [centre, on(from + half + gap), on(from + half + gap + 1.5)];
                let all = [one, other].concat();
                let extent = Extent::Apart {
                    points: (0..6).collect(),
                    first: 3,
                    radii: Vec::new(),
                };
                // Within a rounding.
                let around = |x: f64| crate::interval::hull(x - 1e-12, x + 1e-12);
                assert_eq!(
                    extent.sign(|k| all[k].map(around), sign_of),
                    sign,
                    "{k} {gap}"
                );
            }
        }
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
            // Those that all but touch are left, and lines that are on one line.
            let least = apart - 3;
            assert!(said >= least, "{kinds:?}: {said} of {apart}");
        }
    }
}
