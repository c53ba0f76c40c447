//! `coplanar`: four or more points in one plane.
//!
//! For each point beyond three, the determinant `((b − a) × (c − a))·(p − a)`, through the cross product as
//! an unknown vector, is led to zero. Where the points of the reference are among them, their plane is z = 0
//! and the coordinate z of each other point is led to zero instead: no singular place where they come in line.

use super::prelude::*;

/// See the module.
pub const COPLANAR: Kind = Kind {
    key: "coplanar",
    meaning: "four or more points are in one plane",
    takes: "four or more points",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    if low.dimension() == 2 {
        return Err("all points are in one plane in a problem of dimension 2".to_owned());
    }
    let mut points = distinct(&mut of.items)?;
    if points.len() < 4 {
        return Err("any three points are in one plane: name at least four".to_owned());
    }
    let reference = low.problem.homotopy.reference.clone();
    if !reference.is_empty() && reference.iter().all(|p| points.contains(p)) {
        points.retain(|p| !reference.contains(p));
        for point in points {
            let place = low.place(point);
            let products = vec![Product::new(1, value(place.entries[2]), Form::One)];
            let start = low.frame.coordinate(&place.at, 2);
            low.vanish(of.name, products, start, 1);
        }
        return Ok(());
    }
    // The third of the plane's points is one off the line through the first two, if there is one.
    let off = (2..points.len()).find(|&k| {
        let at = |p: usize| low.place(points[p]).at;
        !is_zero(&cross(&minus(&at(1), &at(0)), &minus(&at(k), &at(0))))
    });
    points.swap(2, off.unwrap_or(2));
    let plane = low.plane(PlaneName::Points([points[0], points[1], points[2]]))?;
    // Where three points are in line any fourth is in one plane with them, but not any two.
    if points.len() > 4 {
        if is_zero(&plane.normal.at) {
            return Err("its points are on one line in the sketch: move one of them".to_owned());
        }
        low.nonzero(&plane.normal);
    }
    for &point in &points[3..] {
        let place = low.place(point);
        let products = plane.height(low, 1, &place);
        let now = plane.height_in_sketch(low, &place);
        low.vanish(of.name, products, now.into(), plane.normal.power + 1);
    }
    Ok(())
}
