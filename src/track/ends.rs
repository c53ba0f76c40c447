//! Where a path that does not come back to the sketch ends.

use crate::constraint::Tail;
use crate::problem::{Item, Problem, Shape};

/// One end of an open path: as far as it was proved.
#[derive(Debug, Clone, PartialEq)]
pub struct PathEnd {
    /// t at the last point proved, between these.
    pub t: (f64, f64),
    /// What happens there.
    pub kind: EndKind,
    /// The same in words: what the figure does there, and what stopped the proof.
    pub reason: String,
    /// The figure near the end, point by point, in floats and in the problem's unit.
    pub points: Vec<[f64; 3]>,
}

/// What happens to the figure where a path ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndKind {
    /// Points go beyond any bound, as far as one can see.
    Infinite,
    /// A length that must be positive goes to zero: an angle loses its leg, a radius its circle.
    Undefined,
    /// The equations become dependent: a degenerate figure, from which it may go on in several ways, or
    /// in none.
    Degenerate,
}

impl EndKind {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            EndKind::Infinite => "infinite",
            EndKind::Undefined => "undefined",
            EndKind::Degenerate => "degenerate",
        }
    }
}

/// A path is taken to go to infinity where a coordinate has become so many times the typical length.
pub const FAR: f64 = 1e4;

/// Planes are called parallel, and points on one line, where the sine of the angle is below this.
const NEARLY: f64 = 1e-2;

/// What there is to see in a figure at the end of a path: planes that have become parallel or fallen into
/// one another.
pub fn remarks(problem: &Problem, figure: &[[f64; 3]]) -> Vec<String> {
    if problem.dimension == 2 {
        return Vec::new();
    }
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
            let sine = cross(*u, *v).iter().map(|x| x * x).sum::<f64>().sqrt();
            if sine < NEARLY {
                remarks.push(format!("the planes ({other}) and ({one}) become parallel"));
            }
        }
    }
    remarks
}

/// The unit normal of the widest triangle of some points.
fn normal(figure: &[[f64; 3]], points: &[usize]) -> Option<[f64; 3]> {
    let (&first, rest) = points.split_first()?;
    let from = |p: usize| -> [f64; 3] { std::array::from_fn(|k| figure[p][k] - figure[first][k]) };
    let mut best = ([0.0; 3], 0.0f64);
    for (k, &a) in rest.iter().enumerate() {
        for &b in &rest[..k] {
            let n = cross(from(a), from(b));
            let size = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size > best.1 {
                best = (n, size);
            }
        }
    }
    (best.1 > 0.0).then(|| best.0.map(|x| x / best.1))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// The name of an auxiliary unknown that must be positive and has become small beside what it was in the
/// sketch. `values` are those of the auxiliary unknowns, `sketch` what they were.
pub fn vanishing<'t>(tail: &'t Tail, values: &[f64], sketch: &[f64]) -> Option<&'t str> {
    use crate::constraint::Role;
    let unknowns = tail.unknowns.iter().zip(values).zip(sketch);
    let mut small = unknowns.filter(|((unknown, now), before)| {
        unknown.role == Role::Positive && **now < 1e-3 * **before
    });
    small.next().map(|((unknown, _), _)| unknown.name.as_str())
}
