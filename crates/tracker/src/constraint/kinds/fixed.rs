//! `fixed`: a point stays where the sketch has it; so do a line, plane, circle, sphere or body with joints.
//!
//! Of points, and of the points that a line or plane goes through, all coordinates are held; of a line of its own those of
//! its direction and of its place but for the axis to which it comes nearest, which its own equations then give; of a
//! plane of its own likewise those of its normal, and its level; of a circle the centre and the radius.

use super::prelude::*;
use crate::places::array;
use crate::statement::{Shape, most_along};

/// See the module.
pub const FIXED: Kind = Kind {
    key: "fixed",
    meaning: "a point, line, plane, circle, sphere or body with joints stays where the sketch has it",
    takes: "a point, a line, a plane, a circle, a sphere or a body",
    fixes,
    ..Kind::lowered_by(lower)
};

fn fixes(problem: &Problem, of: &Constraint) -> Fixes {
    let shape = match of.items.first() {
        Some(&Item::Object(o)) => Some(&problem.objects[o].shape),
        _ => None,
    };
    let axes = array(|k| match shape {
        // Along a line of its own figures can still slide, and along a plane of its own.
        Some(Shape::FreeLine { direction, .. }) => k != most_along(direction),
        Some(Shape::FreePlane { normal, .. }) => k == most_along(normal),
        _ => true,
    });
    Fixes { frame: true, axes }
}

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    match of.items.next() {
        Sort::Line => match of.items.line()? {
            LineName::Points(points) => hold(of.name, low, &points),
            LineName::Free(object) => {
                let entries = low.unknowns_of(object);
                let Shape::FreeLine { direction, .. } = &low.problem.objects[object].shape else {
                    unreachable!("a line of its own")
                };
                let most = most_along(direction);
                let dimension = low.dimension();
                for (k, entry) in entries.into_iter().enumerate() {
                    if k % dimension != most {
                        low.hold_unknown(of.name, entry);
                    }
                }
            }
            LineName::Axis(_) => unreachable!("an axis is no object"),
        },
        Sort::Plane => match of.items.plane()? {
            PlaneName::Points(points) => hold(of.name, low, &points),
            PlaneName::Free(object) => {
                let entries = low.unknowns_of(object);
                let Shape::FreePlane { normal, .. } = &low.problem.objects[object].shape else {
                    unreachable!("a plane of its own")
                };
                let most = most_along(normal);
                for (k, entry) in entries.into_iter().enumerate() {
                    if k != most {
                        low.hold_unknown(of.name, entry);
                    }
                }
            }
        },
        // It has no unknowns.
        Sort::Body => {
            of.items.body()?;
        }
        Sort::Round => {
            let object = of.items.round()?;
            let center = match low.problem.objects[object].shape {
                Shape::Round { center, .. } => center,
                _ => {
                    return Err(
                            "say where an arc is by its points: fix its centre and one end, and put the other end \
                             on a line or axis"
                                .to_owned(),
                        );
                }
            };
            hold(of.name, low, &[center]);
            let radius = low.round(object).radius;
            low.hold_unknown(of.name, radius);
        }
        _ => {
            let point = of.items.point()?;
            hold(of.name, low, &[point]);
        }
    }
    of.items.end()
}

/// Says that points stay where the sketch has them.
fn hold(name: &str, low: &mut Lowering, points: &[usize]) {
    for &point in points {
        for axis in 0..low.dimension() {
            low.hold(name, point, axis);
        }
    }
}
