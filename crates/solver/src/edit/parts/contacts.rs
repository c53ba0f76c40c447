//! Circles and arcs that touch a line at a point by their numbers.
//!
//! A point that is on a line and on a circle which only touches that line is determined twice over: the equations are singular, as
//! two figures fall into one there. What stays along such figures is that the radius to the point is at a right angle to the line.
//! So that is taken for an equation, and that the point is on the circle is left out and enclosed at every figure, as whatever
//! is left out.

use crate::blocks::Cut;
use crate::places::Each as _;
use crate::problem::{Constraint, Item, Problem, Shape};

/// More contacts are not looked for.
const MANY: usize = 40;
/// The cosine of the angle between radius and line is at most so much where they touch: what drawings keep of a right angle.
const RIGHT: f64 = 1e-6;

/// A point at which a circle or an arc about `center` touches a line.
struct Contact {
    /// What people call what says that the point is on the circle.
    name: String,
    circle: String,
    center: usize,
    point: usize,
    line: Vec<Item>,
}

/// A contact that is followed, in names.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    circle: String,
    point: String,
    /// See [`Contact::name`].
    name: String,
}

impl Kept {
    /// What its equation says.
    pub fn equation(&self) -> String {
        format!(
            "that the radius of `{}` at {} is at a right angle to the line it touches there",
            self.circle, self.point
        )
    }

    /// What was done, and why.
    pub fn in_words(&self) -> String {
        format!(
            "`{}` touches a line at {} by its numbers, where its equations are singular: that contact is kept, the radius at a \
             right angle to the line, with {} left out",
            self.circle, self.point, self.name
        )
    }
}

/// The sketch cut as before, or where it is singular at such contacts with these followed: each of which has an equation that is added.
pub(super) fn followed(problem: &Problem, cut: Cut, way: u64) -> (Cut, Vec<Kept>) {
    let (mut best, mut kept) = (cut, Vec::new());
    let mut problem = problem.clone();
    for contact in all(&best) {
        let Some(singular) = best.singular.as_ref().filter(|s| s.moved.is_none()) else {
            break;
        };
        if kept.len() >= MANY || !singular.constraints.contains(&contact.name) {
            continue;
        }
        let mut more = problem.clone();
        let radius = [Item::Point(contact.center), Item::Point(contact.point)];
        more.constraints.push(Constraint {
            kind: "perpendicular".to_owned(),
            items: radius.into_iter().chain(contact.line).collect(),
            value: None,
            formula: None,
        });
        let Ok(cut) = Cut::drawn(&more, way) else {
            continue;
        };
        let is_better = match &cut.singular {
            None => true,
            Some(now) => !now.constraints.contains(&contact.name),
        };
        if is_better {
            kept.push(Kept {
                circle: contact.circle,
                point: problem.points[contact.point].name.clone(),
                name: contact.name,
            });
            (best, problem) = (cut, more);
        }
    }
    (best, kept)
}

/// The contacts of the sketch.
fn all(cut: &Cut) -> Vec<Contact> {
    let problem = &cut.problem;
    if problem.dimension != 2 || cut.singular.as_ref().is_none_or(|s| s.moved.is_some()) {
        return Vec::new();
    }
    let place = |p: usize| [0, 1].each(|axis| cut.system.coordinates[2 * p + axis]);
    let at = |p: usize| [0, 1].each(|axis| problem.points[p].sketch[axis].to_f64());
    let along = |line: &[Item]| -> Option<[f64; 2]> {
        let ends = match *line {
            [Item::Axis(axis)] => return Some([0, 1].each(|k| f64::from(u8::from(k == axis)))),
            [Item::Point(a), Item::Point(b)] => [a, b],
            [Item::Object(o)] => match problem.objects[o].shape {
                Shape::Line(ends) => ends,
                _ => return None,
            },
            _ => return None,
        };
        let [a, b] = ends.each(at);
        Some([b[0] - a[0], b[1] - a[1]])
    };
    // Lines, each with the points that are on it.
    let mut lines: Vec<(Vec<usize>, Vec<Item>)> = Vec::new();
    for (o, object) in problem.objects.iter().enumerate() {
        if let Shape::Line(ends) = object.shape {
            lines.push((ends.to_vec(), vec![Item::Object(o)]));
        }
    }
    // What says that points are on circles: its name, the circle, the point.
    let mut round: Vec<(String, usize, usize)> = Vec::new();
    for (c, constraint) in problem.constraints.iter().enumerate() {
        match (constraint.kind.as_str(), &*constraint.items) {
            ("on", &[Item::Point(p), Item::Object(o)]) => match problem.objects[o].shape {
                Shape::Line(_) => lines.push((vec![p], vec![Item::Object(o)])),
                _ => round.push((cut.constraint_name(c), o, p)),
            },
            ("on", &[Item::Point(p), axis @ Item::Axis(_)]) => lines.push((vec![p], vec![axis])),
            ("horizontal" | "vertical", line @ &[Item::Point(a), Item::Point(b)]) => {
                lines.push((vec![a, b], line.to_vec()));
            }
            _ => {}
        }
    }
    for (o, object) in problem.objects.iter().enumerate() {
        if let Shape::Arc { start, end, .. } = object.shape {
            round.extend([start, end].map(|p| (format!("`{}`", object.name), o, p)));
        }
    }
    let mut out = Vec::new();
    for (name, o, point) in round {
        let (Shape::Round { center, .. } | Shape::Arc { center, .. }) = problem.objects[o].shape
        else {
            continue;
        };
        for (on, line) in &lines {
            let Some(along) = along(line).filter(|_| on.iter().any(|&p| place(p) == place(point)))
            else {
                continue;
            };
            let (m, p) = (at(center), at(point));
            let radius = [p[0] - m[0], p[1] - m[1]];
            let dot = radius[0] * along[0] + radius[1] * along[1];
            let sizes = radius[0].hypot(radius[1]) * along[0].hypot(along[1]);
            if dot.abs() <= RIGHT * sizes && sizes > 0.0 {
                out.push(Contact {
                    name: name.clone(),
                    circle: problem.objects[o].name.clone(),
                    center,
                    point,
                    line: line.clone(),
                });
            }
        }
    }
    out
}
