//! Where a path that does not come back to the sketch ends.

use super::{Status, Stop, StopKind};
use crate::constraint::Role;
use crate::interval::vector::{cross, length, minus};
use crate::places::{Each as _, array};
use crate::problem::{Item, Problem, Shape};
use crate::system::Homotopy;

/// One end of an open path: as far as it was proved, or, in float mode, followed.
#[derive(Debug, Clone, PartialEq)]
pub struct PathEnd {
    /// t at the last point proved, between these. In float mode that of the last point seen, or, where something
    /// vanishes, those of the last point before that and of the first behind it.
    pub t: (f64, f64),
    /// What happens there.
    pub kind: EndKind,
    /// What stopped a run there that is followed both ways whatever does.
    pub stop: Option<StopKind>,
    /// In words what happens there; empty where nothing is known but what stopped the run.
    pub what: String,
    /// The same, and what stopped the proof or the run.
    pub reason: String,
    /// At an end at infinity where a point goes there: which, and how far it was followed.
    pub away: Option<Away>,
    /// The figure near the end, point by point, in floats and in the problem's unit.
    pub points: Vec<[f64; 3]>,
}

impl PathEnd {
    /// What happens there, or where that is not known what stopped the run; without a full stop.
    pub fn in_words(&self) -> &str {
        match self.what.is_empty() {
            true => self.reason.trim_end().trim_end_matches('.'),
            false => &self.what,
        }
    }
}

/// A point that goes away. In certified mode it is proved that at the path's last point it is so far away, and that it
/// goes on moving away there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Away {
    /// The point, by index.
    pub point: usize,
    /// Its distance from the first point of the reference (in a frame of the user's own: from the origin), between
    /// these, in the problem's unit.
    pub distance: (f64, f64),
}

crate::named! {
    /// What happens to the figure where a path ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum EndKind {
        /// Points go away, ever farther as far as one can see: see [`PathEnd::away`]. Or t does, or goes too far to be followed.
        Infinite = "infinite",
        /// A length that must be positive goes to zero: an angle loses its leg, a radius its circle.
        Undefined = "undefined",
        /// The equations become dependent: a degenerate figure, from which it may go on in several ways, or
        /// in none.
        Degenerate = "degenerate",
        /// The run stopped, and is one that is followed both ways whatever stops it ([`super::Options::both_ways`]).
        Stopped = "stopped",
    }
}

/// A path is taken to go to infinity where a point has come so many times as far as any is in the sketch, moves away,
/// and t settles.
pub const FAR: f64 = 30.0;

/// t settles: it changes by less than this while the distance grows by a factor of e, and 1 is ten times as far as
/// that. (Where t has a limit at infinity it nears that like a negative power of the distance.)
pub const SETTLED: f64 = 1e-2;

/// Beyond this t, or another unknown, is not followed, if it moves away from 0 there: such a path may go on without end, or come
/// back. Certificates hold no numbers much larger.
pub const ENDLESS: f64 = (1u64 << 36) as f64;

/// Where t or another unknown is so many times as large as any coordinate of the sketch, tubes have to grow with it; where
/// they do not, the path is not followed farther.
pub const OUTSIDE: f64 = 256.0;

/// No tube is tried that is longer than this to either side: far more than any path needs that is not straight, and
/// so that the next point of one that has not come to [`ENDLESS`] fits into a certificate.
pub const LONGEST: f64 = (1u64 << 33) as f64;

/// A length or radius has nearly vanished where it is this part of what it was in the sketch.
pub const SMALL: f64 = 1e-3;

/// Where the Jacobian with the normal has a larger condition, in floats, a run that is stuck is near a place
/// where it loses rank: where branches meet.
pub const SINGULAR: f64 = 1e7;

/// What is said of such a place where a path ends.
pub const DEGENERATE: &str =
    "the figure becomes degenerate, its constraints dependent on each other";

/// Planes are called parallel, and points on one line, where the sine of the angle is below this.
const NEARLY: f64 = 1e-2;
/// Legs of an angle, which are long where an end is at infinity, are called parallel below this sine.
const LEGS: f64 = 5e-2;

/// What there is to see in a figure at the end of a path: legs of an angle, or lines, that have become parallel, planes that have
/// become so or fallen into one another.
pub fn remarks(problem: &Problem, figure: &[[f64; 3]]) -> Vec<String> {
    let mut remarks = parallel_legs(problem, figure);
    remarks.extend(parallel_lines(problem, figure));
    if problem.dimension == 3 {
        remarks.extend(parallel_planes(problem, figure));
    }
    remarks
}

/// Angles at a point of which the legs have become parallel.
fn parallel_legs(problem: &Problem, figure: &[[f64; 3]]) -> Vec<String> {
    let mut remarks = Vec::new();
    for constraint in problem.constraints.iter().filter(|c| c.kind == "angles") {
        let [Item::Point(a), Item::Point(b), Item::Point(c)] = constraint.items[..] else {
            continue;
        };
        let leg = |end: usize| -> [f64; 3] { array(|k| figure[end][k] - figure[b][k]) };
        let (u, v) = (leg(a), leg(c));
        // Legs that vanish have no direction.
        let sine = length(cross(u, v)) / (length(u) * length(v));
        if sine < LEGS && length(u).min(length(v)) > NEARLY * length(u).max(length(v)) {
            let [a, b, c] = [a, b, c].each(|p| problem.points[p].name.as_str());
            remarks.push(format!(
                "the legs of the angle at {b} between {a} and {c} become parallel"
            ));
        }
    }
    remarks
}

/// Lines that have become parallel and are clearly not so in the sketch. The direction of a line of its own is that between
/// two points that are said to be on it; without two it is not looked at.
fn parallel_lines(problem: &Problem, figure: &[[f64; 3]]) -> Vec<String> {
    let sketch = problem.places();
    let between = |figure: &[[f64; 3]], a: usize, b: usize| minus(figure[b], figure[a]);
    let lines = problem.objects.iter().enumerate();
    let lines = lines.filter_map(|(index, object)| match &object.shape {
        &Shape::Line([a, b]) => {
            let directions = [&sketch[..], figure].each(|figure| between(figure, a, b));
            Some((object.name.as_str(), directions))
        }
        Shape::FreeLine { direction, .. } => {
            let on_it = points_on(problem, index);
            let pairs = on_it.iter().enumerate();
            let pairs = pairs.flat_map(|(k, &a)| on_it[..k].iter().map(move |&b| (a, b)));
            let apart = pairs.map(|(a, b)| between(figure, a, b));
            let longest = apart.max_by(|u, v| length(*u).total_cmp(&length(*v)))?;
            let before = direction.each_ref().each(|x| x.to_f64());
            Some((object.name.as_str(), [before, longest]))
        }
        _ => None,
    });
    let lines: Vec<(&str, [[f64; 3]; 2])> = lines.collect();
    let mut remarks = Vec::new();
    for (k, (one, of_one)) in lines.iter().enumerate() {
        for (other, of_other) in &lines[..k] {
            // Not a number where a direction vanishes.
            let [before, now] = [0, 1].each(|at| {
                let (u, v) = (of_one[at], of_other[at]);
                length(cross(u, v)) / (length(u) * length(v))
            });
            if before > LEGS && now < NEARLY {
                remarks.push(format!("the lines {other} and {one} become parallel"));
            }
        }
    }
    remarks
}

/// The points that are said to be on an object.
fn points_on(problem: &Problem, object: usize) -> Vec<usize> {
    let on = problem.constraints.iter().filter(|c| c.kind == "on");
    let points = on.filter_map(|constraint| match constraint.items[..] {
        [Item::Point(point), Item::Object(index)] if index == object => Some(point),
        _ => None,
    });
    points.collect()
}

fn parallel_planes(problem: &Problem, figure: &[[f64; 3]]) -> Vec<String> {
    let name = |p: usize| problem.points[p].name.as_str();
    let mut planes: Vec<(String, [f64; 3])> = Vec::new();
    for object in &problem.objects {
        if let Shape::Plane(points) = &object.shape
            && let Some(normal) = normal(figure, points)
        {
            planes.push((object.name.clone(), normal));
        }
    }
    for constraint in problem.constraints.iter().filter(|c| c.kind == "coplanar") {
        let point = |item: &Item| match item {
            Item::Point(p) => Some(*p),
            _ => None,
        };
        let points: Vec<usize> = constraint.items.iter().filter_map(point).collect();
        if let Some(normal) = normal(figure, &points) {
            let names: Vec<&str> = points.iter().map(|&p| name(p)).collect();
            planes.push((names.join(", "), normal));
        }
    }
    let mut remarks = Vec::new();
    for (k, (one, u)) in planes.iter().enumerate() {
        for (other, v) in &planes[..k] {
            if length(cross(*u, *v)) < NEARLY {
                remarks.push(format!("the planes ({other}) and ({one}) become parallel"));
            }
        }
    }
    remarks
}

/// The unit normal of the widest triangle of some points.
fn normal(figure: &[[f64; 3]], points: &[usize]) -> Option<[f64; 3]> {
    let (&first, rest) = points.split_first()?;
    let from = |p: usize| minus(figure[p], figure[first]);
    let mut best = ([0.0; 3], 0.0f64);
    for (k, &a) in rest.iter().enumerate() {
        for &b in &rest[..k] {
            let n = cross(from(a), from(b));
            let size = length(n);
            if size > best.1 {
                best = (n, size);
            }
        }
    }
    (best.1 > 0.0).then(|| best.0.each(|x| x / best.1))
}

/// The point with the largest coordinate, and that. `z` are all unknowns.
pub fn farthest(homotopy: &Homotopy, z: &[f64]) -> Option<(usize, f64)> {
    let unknowns =
        |p: usize| (0..homotopy.dimension).filter_map(move |k| homotopy.coordinate(p, k));
    let sizes = (0..homotopy.points).flat_map(|p| unknowns(p).map(move |i| (p, z[i].abs())));
    sizes.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The largest coordinate of a figure, or 1 if that is more.
pub fn size_of(homotopy: &Homotopy, figure: &[f64]) -> f64 {
    farthest(homotopy, figure).map_or(1.0, |(_, size)| size.max(1.0))
}

/// The places of all points, in the problem's unit.
pub fn places(homotopy: &Homotopy, z: &[f64]) -> Vec<[f64; 3]> {
    let place = |p: usize| homotopy.place(p, |i| z[i] * homotopy.unit);
    (0..homotopy.points).map(place).collect()
}

/// What is said of a point that goes away, but for where that is seen.
pub fn in_words(homotopy: &Homotopy, Away { point, distance }: Away) -> String {
    let name = homotopy.point_names.get(point).map(String::as_str);
    format!(
        "{} is {:.4} away and moves away, ever farther as far as one can see",
        name.unwrap_or("a point"),
        distance.0
    )
}

/// How a run ended that came to one end of its path, and the other way from the sketch to another, or stopped.
pub fn both_ways(end: PathEnd, other: Result<PathEnd, Stop>) -> Status {
    match other {
        Ok(other) => Status::Open(Box::new([other, end])),
        Err(stop) => {
            let words = format!(
                "one way from the sketch the path has an end ({}); the other way {stop}",
                end.reason
            );
            Status::Stopped(stop.in_words(words))
        }
    }
}

/// The name of what must not vanish and has nearly done so: of an auxiliary unknown that must be positive and is small
/// beside what it was in the sketch, or of a vector that is small beside `size`. `z` and `sketch` are all unknowns.
pub fn vanishing<'h>(
    homotopy: &'h Homotopy,
    z: &[f64],
    sketch: &[f64],
    size: f64,
) -> Option<&'h str> {
    let first = homotopy.gauge.place.len();
    let (tail, values) = (&homotopy.tail, z[first..].iter().zip(&sketch[first..]));
    let mut small = tail
        .unknowns
        .iter()
        .zip(values)
        .filter(|(unknown, (now, before))| {
            unknown.role == Role::Positive && **now < SMALL * **before
        });
    let unknown = small.next().map(|(unknown, _)| unknown.name.as_str());
    unknown.or_else(|| vanishing_vector(homotopy, z, size))
}

/// The name of a vector all of whose coordinates are small beside `size`.
fn vanishing_vector<'h>(homotopy: &'h Homotopy, z: &[f64], size: f64) -> Option<&'h str> {
    let at = |i: usize| if i < homotopy.equations { z[i] } else { 0.0 };
    let vectors = homotopy.nonzero_vectors().into_iter();
    let mut small = vectors.zip(&homotopy.tail.nonzero).filter(|(vector, _)| {
        vector
            .iter()
            .all(|&[i, j]| (at(i) - at(j)).abs() < SMALL * size)
    });
    small.next().map(|(_, vector)| vector.name.as_str())
}
