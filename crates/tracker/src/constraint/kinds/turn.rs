//! `turns` and `torsions`: angles in the plane, of joints, and about a line in space, with their sense, which may be any number of degrees.
//!
//! The cosine and the sine go from those of the sketch to those of the angle on a curve round 0 (`lowering/turn.rs`), so that an edit by 250
//! or by −400 degrees turns as far, and that way round.

use super::angle::{directions, legs};
use super::prelude::*;

/// See the module.
pub const TURNS: Kind = Kind {
    key: "turns",
    meaning: "by how many degrees the leg to the first of three points, or the first of two lines from its first end to its second, is \
         turned counter-clockwise where it points as the other does, or a joint is turned; any number",
    takes: "a joint; or three points with the vertex in the middle, or two lines, in the plane",
    measure: Measure::Turn,
    ..Kind::lowered_by(turn)
};

fn turn(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    if of.items.next() == Sort::Joint {
        let joint = of.items.joint()?;
        of.items.end()?;
        let degrees = of.number().value().clone();
        return low.turn_of_joint(of.name, joint, &degrees);
    }
    if low.problem.dimension != 2 {
        return Err("in space an angle has no sense of turn: say `angles`".to_owned());
    }
    let degrees = of.number().value().clone();
    let (u, v) = match legs(&mut of.items)? {
        Some([a, b, c]) => (low.span(b, a)?, low.span(b, c)?),
        None => {
            let ((first, _), (second, _)) = directions(&mut of.items, low)?;
            (first, second)
        }
    };
    let (u, v) = (low.heading(u), low.heading(v));
    low.turn(of.name, &u, &v, &degrees)
}

/// See the module.
pub const TORSIONS: Kind = Kind {
    key: "torsions",
    meaning: "seen along the line from the second of four points to the third, by how many degrees clockwise the last is turned from the \
         first; any number, with its sign, so that mirror images differ",
    takes: "four points, such as atoms of a chain in order",
    measure: Measure::Turn,
    ..Kind::lowered_by(torsion)
};

fn torsion(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    if low.problem.dimension != 3 {
        return Err("in the plane nothing turns about a line: say `turns`".to_owned());
    }
    let [a, b, c, d] = [
        of.items.point()?,
        of.items.point()?,
        of.items.point()?,
        of.items.point()?,
    ];
    of.items.end()?;
    if a == d {
        return Err("the first and the last of the four are one point: name another".to_owned());
    }
    let degrees = of.number().value().clone();
    low.torsion(of.name, [a, b, c, d], &degrees)
}
