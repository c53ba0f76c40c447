//! `distances` between a point and a line or plane, and between two lines.
//!
//! In the plane the distance of a point p from the line through a and b is signed: `(b − a) × (p − a) = ±
//! d |b − a|`. Its sign is read off the sketch, as CAD programs do; so is that of the distance of a point
//! from a plane, and of two lines in space. In space the distance from a line has no sign: with q the length
//! of the projection, `q |u| = (p − a)·u` and `|p − a|² − q² = d²`.

use super::prelude::*;

/// See the module.
pub struct Distances;

impl Kind for Distances {
    fn key(&self) -> &'static str {
        "distances"
    }

    fn meaning(&self) -> &'static str {
        "how far apart two points are, a point and a line or plane, or two lines in space; on the side where \
         the sketch has it"
    }

    fn takes(&self) -> &'static str {
        "two points, a point and a line, a point and a plane, or two lines with names"
    }

    fn example(&self) -> &'static str {
        r#"["p1", "l1", 2]"#
    }

    fn measure(&self) -> Measure {
        Measure::Length
    }

    fn fixes(&self, _: &Problem, items: &[Item]) -> Fixes {
        Fixes::beside_axis(items)
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        let then = Real::from(of.number().value().clone());
        if of.items.next() == Sort::Point {
            let point = of.items.point()?;
            if of.items.points_ahead() == 1 && of.items.left() == 1 {
                return Err(
                    "the distance of two points is not one of these: it belongs to `Problem::distances`"
                        .to_owned(),
                );
            }
            let place = low.place(point);
            return match (of.items.next(), of.items.left(), low.dimension()) {
                (Sort::Plane, _, 3) | (Sort::Point, 3, 3) => {
                    let plane = low.proper_plane(of.items.plane()?)?;
                    of.items.end()?;
                    from_plane(of.name, low, &place, &plane, then)
                }
                _ => {
                    let line = of.items.line()?;
                    of.items.end()?;
                    let line = low.line(line)?;
                    from_line(of.name, low, &place, &line, then)
                }
            };
        }
        let first = of.items.next();
        if first == Sort::Plane
            || matches!(first, Sort::Line | Sort::Axis) && of.items.left() == 2 && {
                let mut rest = of.items.clone();
                rest.line()?;
                rest.next() == Sort::Point
            }
        {
            // The point may stand second.
            let mut rest = of.items.clone();
            let thing = if first == Sort::Plane {
                Thing::Plane(rest.plane()?)
            } else {
                Thing::Line(rest.line()?)
            };
            let place = low.place(rest.point()?);
            rest.end()?;
            return match thing {
                Thing::Plane(plane) => {
                    let plane = low.proper_plane(plane)?;
                    from_plane(of.name, low, &place, &plane, then)
                }
                Thing::Line(line) => {
                    let line = low.line(line)?;
                    from_line(of.name, low, &place, &line, then)
                }
            };
        }
        if low.dimension() == 2 {
            return Err(
                "lines in the plane have a distance only if they are parallel: say `parallel`, and give \
                 the distance of a point of one line from the other"
                    .to_owned(),
            );
        }
        let (a, b) = (of.items.line()?, of.items.line()?);
        of.items.end()?;
        if let (LineName::Axis(_), LineName::Axis(_)) = (a, b) {
            return Err("axes are where they are: name a line".to_owned());
        }
        let (a, b) = (low.line(a)?, low.line(b)?);
        let what = format!("the common normal of {} and {}", a.along.name, b.along.name);
        let normal = low.cross(&a.along, &b.along, what);
        if is_zero(&normal.at) {
            return Err(
                "the lines are parallel in the sketch: turn one of them, or give the distance of a point \
                 of one from the other"
                    .to_owned(),
            );
        }
        let apart = low.between(&a.base, &b.base);
        let products = low.dot(1, &normal.forms, &apart.forms);
        let now = dot(&normal.at, &apart.at);
        let then = with_sign(&now, then).ok_or(
            "the lines meet in the sketch: move one of them to the side where it is wanted",
        )?;
        low.measure(
            of.name,
            Measured {
                products,
                now,
                then,
                power: 1,
                odd: true,
                arrows: vec![&normal],
            },
        );
        Ok(())
    }
}

enum Thing {
    Line(LineName),
    Plane(PlaneName),
}

fn from_plane(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    plane: &Plane,
    then: Real,
) -> Result<(), Fault> {
    let now = plane.height_in_sketch(low, place);
    let then = with_sign(&now, then)
        .ok_or("the point is in the plane in the sketch: move it to the side where it is wanted")?;
    let products = plane.height(low, 1, place);
    low.measure(
        name,
        Measured {
            products,
            now,
            then,
            power: 1,
            odd: plane.normal.axial,
            arrows: vec![&plane.normal],
        },
    );
    Ok(())
}

fn from_line(
    name: &str,
    low: &mut Lowering,
    place: &Place,
    line: &Line,
    then: Real,
) -> Result<(), Fault> {
    let across = low.between(&line.base, place);
    let on_it = "the point is on the line in the sketch: move it to the side where it is wanted, or say `on`";
    if low.dimension() == 2 {
        let products = low.cross_in_plane(1, &line.along.forms, &across.forms);
        let now = cross_in_plane(&line.along.at, &across.at);
        let then = with_sign(&now, then).ok_or(on_it)?;
        low.measure(
            name,
            Measured {
                products,
                now,
                then,
                power: 1,
                odd: true,
                arrows: vec![&line.along],
            },
        );
        return Ok(());
    }
    let along = dot(&line.along.at, &across.at);
    let square =
        dot(&across.at, &across.at) - &along * &along / dot(&line.along.at, &line.along.at);
    if square.is_zero() {
        return Err(on_it.to_owned());
    }
    let unit = low.length(&line.along);
    let at = &Real::from(along) / &length(&line.along.at);
    let what = format!("{name}, the projection");
    let projection = low.scalar(what.clone(), 1, Parity::Even, at);
    let mut products = low.dot(-1, &line.along.forms, &across.forms);
    products.push(product(1, value(projection), value(unit)));
    low.equate(&what, products, vec![Real::zero()], 1 + line.along.power);
    let mut products = low.dot(1, &across.forms, &across.forms);
    products.push(product(-1, value(projection), value(projection)));
    let d = low.lead(Real::from(square).sqrt(), then);
    low.equate(name, products, multiply(&d, &d), 2);
    Ok(())
}
