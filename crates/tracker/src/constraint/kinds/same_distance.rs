//! `equal_distances`: two points as far from a line each. In the plane.
//!
//! With the signed areas `h = u × (p − a)`, unknowns, and the lengths of the lines, `h₁ |u₂| ∓ h₂ |u₁|` is led
//! to zero; the sign is that of the sketch.

use super::prelude::*;

/// See the module.
pub const EQUAL_DISTANCES: Kind = Kind {
    key: "equal_distances",
    meaning: "the first point is as far from the first line as the second point from the second line",
    takes: "a point and a line, and another point and a line (which may be the same), in the plane",
    fixes: Fixes::beside_axis,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    if low.dimension() == 3 {
        return Err("this is for problems of dimension 2".to_owned());
    }
    let mut area = |low: &mut Lowering| -> Result<_, Fault> {
        let point = of.items.point()?;
        let place = low.place(point);
        let name = of.items.line()?;
        let line = low.line(name)?;
        let line = low.headed_line(line);
        let across = low.between(&line.base, &place);
        let at = cross_in_plane(&line.along.at, &across.at);
        if let LineName::Points(ends) = name
            && ends.contains(&point)
        {
            return Err(format!(
                "the line goes through `{}` itself, so that both distances would be zero: say `on` of the other point and \
                     its line",
                low.name(point)
            ));
        }
        if at.is_zero() {
            return Err(format!(
                "`{}` is on the line in the sketch, so that there is no side to keep it on: move it to the side where it is \
                     wanted, or, where both distances are to be zero, say `on` of each point and its line",
                low.name(point)
            ));
        }
        let products = low.cross_in_plane(-1, &line.along.forms, &across.forms);
        Ok((line, at, products))
    };
    let first = area(low)?;
    let second = area(low)?;
    of.items.end()?;
    let mut unknowns = Vec::new();
    for (index, (line, at, products)) in [&first, &second].into_iter().enumerate() {
        let what = format!("{}, area {}", of.name, index + 1);
        let power = line.along.power + 1;
        let entry = low.scalar(what.clone(), power, Parity::Odd, at.clone().into());
        let mut products = products.clone();
        products.push(Product::new(1, value(entry), Form::One));
        low.equate(&what, products, vec![Real::zero()], power);
        unknowns.push((entry, low.length(&line.along)));
    }
    let side = if first.1.is_negative() == second.1.is_negative() {
        1
    } else {
        -1
    };
    let products = vec![
        Product::new(1, value(unknowns[0].0), value(unknowns[1].1)),
        Product::new(-side, value(unknowns[1].0), value(unknowns[0].1)),
    ];
    let one = &Real::from(first.1.clone()) * &length(&second.0.along.at);
    let other = &Real::from(second.1.clone()) * &length(&first.0.along.at);
    let start = &one - &(&Real::whole(side.into()) * &other);
    let power = first.0.along.power + second.0.along.power + 1;
    low.vanish(of.name, products, start, power);
    Ok(())
}
