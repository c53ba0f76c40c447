//! `on`: a point on a line, plane, circle, sphere or arc.
//!
//! On a line as in `collinear`; in a plane, its signed distance times the length of the normal is led to
//! zero; on a circle or sphere, `|p − c|² − r²` with the radius as an unknown. An arc is the whole circle:
//! how far it reaches does not matter.

use super::prelude::*;

/// See the module.
pub const ON: Kind = Kind {
    key: "on",
    meaning: "a point is on a line, in a plane, or on a circle, sphere or arc (which is as good as its whole circle)",
    takes: "a point and a line, plane, circle, sphere or arc",
    fixes: Fixes::beside_axis,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let point = of.items.point()?;
    let place = low.place(point);
    match (of.items.next(), of.items.left(), low.dimension()) {
        (Sort::Round, _, _) => {
            let round = of.items.round()?;
            of.items.end()?;
            let round = low.round(round);
            if round.center == place {
                return Err("the point is the centre of it".to_owned());
            }
            low.on_round(of.name, &place, &round);
        }
        (Sort::Plane, _, _) | (Sort::Point, 3, 3) => {
            let plane = of.items.plane()?;
            of.items.end()?;
            if let PlaneName::Points(points) = plane
                && points.contains(&point)
            {
                return Err("the plane is one through the point anyway: remove this".to_owned());
            }
            let plane = low.proper_plane(plane)?;
            low.nonzero(&plane.normal);
            let products = plane.height(low, 1, &place);
            let now = plane.height_in_sketch(low, &place);
            low.vanish(of.name, products, now.into(), plane.normal.power + 1);
        }
        _ => {
            let line = of.items.line()?;
            of.items.end()?;
            if let LineName::Points(points) = line
                && points.contains(&point)
            {
                return Err("the line is one through the point anyway: remove this".to_owned());
            }
            let line = low.line(line)?;
            let across = low.between(&line.base, &place);
            low.nonzero(&line.along);
            low.align(of.name, &line.along, &across);
        }
    }
    Ok(())
}
