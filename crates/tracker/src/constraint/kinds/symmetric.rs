//! `symmetric`: two points are mirror images in a line, a plane, a point or a coordinate axis.
//!
//! In a line of the plane, `u·(q − p) = 0` and `u × (p − a) + u × (q − a) = 0`; in a plane of space, `q − p = k n`
//! and the sum of both heights is zero; in a point, that is the midpoint; in an axis of the plane, coordinates
//! agree or are opposite.

use super::prelude::*;
use crate::places::Each as _;

/// See the module.
pub const SYMMETRIC: Kind = Kind {
    key: "symmetric",
    meaning: "two points are mirror images of each other in a line or axis (in the plane), a plane (in space) or a point",
    takes: "two points, and a line, `x-axis`, `y-axis`, a plane or a point",
    fixes,
    ..Kind::lowered_by(lower)
};

fn fixes(_: &Problem, of: &Constraint) -> Fixes {
    match of.items.last() {
        // Mirrored in the x axis, heights add up to zero.
        Some(&Item::Axis(k)) => Fixes {
            frame: true,
            axes: [k == 1, k == 0, false],
        },
        _ => Fixes::default(),
    }
}

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let (a, b) = (of.items.point()?, of.items.point()?);
    if a == b {
        return Err("the two points are one and the same".to_owned());
    }
    let (p, q) = (low.place(a), low.place(b));
    let across = low.between(&p, &q);
    match (of.items.next(), of.items.left(), low.dimension()) {
        (Sort::Axis, _, 2) => {
            let axis = of.items.axis()?;
            of.items.end()?;
            let products = vec![Product::new(1, across.forms[axis], Form::One)];
            low.vanish_linear(of.name, products, across.at[axis].clone().into(), 1);
            let other = 1 - axis;
            let products = [&p, &q].each(|at| Product::new(1, value(at.entries[other]), Form::One));
            let start = &p.at[other] + &q.at[other];
            low.vanish_linear(of.name, products.to_vec(), start.into(), 1);
        }
        (Sort::Point, 1, _) => {
            let middle = of.items.point()?;
            if middle == a || middle == b {
                return Err("the middle is one of the two points".to_owned());
            }
            super::midpoint::halfway(of.name, low, middle, [a, b]);
        }
        (_, _, 2) => {
            let line = of.items.line()?;
            of.items.end()?;
            let line = low.line(line)?;
            let [u, v] = [&p, &q].map(|at| low.between(&line.base, at));
            // The two points may be one, on the line.
            low.nonzero(&line.along);
            let products = low.dot(1, &line.along.forms, &across.forms);
            let start = Real::from(dot(&line.along.at, &across.at));
            low.vanish(of.name, products, start, line.along.power + 1);
            let mut products = low.cross_in_plane(1, &line.along.forms, &u.forms);
            products.extend(low.cross_in_plane(1, &line.along.forms, &v.forms));
            let start = cross_in_plane(&line.along.at, &plus(&u.at, &v.at));
            low.vanish(of.name, products, start.into(), line.along.power + 1);
        }
        _ => {
            let plane = of.items.plane()?;
            of.items.end()?;
            let plane = low.proper_plane(plane)?;
            low.nonzero(&plane.normal);
            low.align(of.name, &plane.normal, &across);
            let mut products = plane.height(low, 1, &p);
            products.extend(plane.height(low, 1, &q));
            let start = plane.height_in_sketch(low, &p) + plane.height_in_sketch(low, &q);
            low.vanish(of.name, products, start.into(), plane.normal.power + 1);
        }
    }
    Ok(())
}
