//! `distances` between any two of points, lines, planes, circles, arcs and spheres, but for two points.
//!
//! Sides and senses are read off the sketch, as CAD programs do: on which side of a line in the plane, or of a plane, a
//! point is, which of two lines in space passes on which side of the other, and whether a point or circle is
//! inside another circle. What has a distance only where it is parallel (lines in the plane, planes, a line and a
//! plane) is parallel because of it, unless other constraints say so ([`Directions`]).

mod flat;
mod place;
mod round;

use super::prelude::*;
pub use place::off_line;

/// What is said where a centre is on the line or plane from which its circle or sphere is to be apart.
pub const CENTRE: &str =
    "the centre is on it in the sketch: move one of them to the side where it is wanted";

/// See the module.
pub const DISTANCES: Kind = Kind {
    key: "distances",
    meaning: "how far apart two of points, lines, planes, circles, arcs and spheres are where they are nearest, on the side where \
         the sketch has it; two lines in the plane, two planes, and a line and a plane are parallel then",
    takes: "two of points, lines, planes, circles, arcs and spheres; a line may be two points, and a plane three",
    measure: Measure::Length,
    fixes: Fixes::beside_axis,
    instead_of_zero,
    read_as,
    ..Kind::lowered_by(lower)
};

fn instead_of_zero(mut items: Arguments) -> Option<&'static str> {
    use LineName::Axis;
    Some(match items.two_things().ok()? {
        [Thing::Point(_), Thing::Point(_)] => "for two points in one place say `coincident`",
        [Thing::Point(_), _] | [_, Thing::Point(_)] => "for a point on it say `on`",
        [Thing::Round(_), _] | [_, Thing::Round(_)] => {
            "where they are to touch say `tangent`, or `equal` of two about one centre"
        }
        [Thing::Flat(Flat::Plane(_)), Thing::Flat(Flat::Plane(_))] => {
            "for one plane in the other say `on` of three points of the one and the other, or `coplanar` of the points"
        }
        [Thing::Flat(Flat::Plane(_)), _] | [_, Thing::Flat(Flat::Plane(_))] => {
            "for a line in a plane say `on` of two points of the line and the plane"
        }
        [Thing::Flat(Flat::Line(Axis(_))), _] | [_, Thing::Flat(Flat::Line(Axis(_)))] => {
            "for a line on an axis say `on` of two points of the line and the axis"
        }
        _ if items.dimension() == 2 => {
            "for one line on the other say `on` of two points of the one and the other, or `collinear` of the points"
        }
        _ => "for lines that meet say `on` of one point and both",
    })
}

fn read_as(mut items: Arguments) -> Option<String> {
    let names = items.clone();
    items.two_things().ok().map(|things| names.in_words(things))
}

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let then = Real::from(of.number().value().clone());
    let things = of.items.two_things()?;
    match things {
        [Thing::Point(_), Thing::Point(_)] => Err(
            "the distance of two points is not one of these: it belongs to `Problem::distances`"
                .to_owned(),
        ),
        [Thing::Point(point), Thing::Flat(flat)] | [Thing::Flat(flat), Thing::Point(point)] => {
            let place = low.place(point);
            place::from_flat(of.name, low, &place, flat, then)
        }
        [Thing::Flat(one), Thing::Flat(other)] => flat::between(of.name, low, one, other, then),
        [Thing::Point(point), Thing::Round(round)] | [Thing::Round(round), Thing::Point(point)] => {
            round::from_point(of.name, low, round, point, then)
        }
        [Thing::Round(round), Thing::Flat(flat)] | [Thing::Flat(flat), Thing::Round(round)] => {
            round::from_flat(of.name, low, round, flat, then)
        }
        [Thing::Round(one), Thing::Round(other)] => round::between(of.name, low, one, other, then),
    }
}
