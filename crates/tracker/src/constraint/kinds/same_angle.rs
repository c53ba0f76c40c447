//! `equal_angles`: two angles are the same, of lines or at points.
//!
//! With the cosines as unknowns, `u·v = k |u| |v|`, `k₁ − k₂` is led to zero; for lines, which have two angles,
//! `k₁ + k₂` where the sketch has one of them sharp and the other one blunt.

use super::prelude::*;

/// See the module.
pub const EQUAL_ANGLES: Kind = Kind {
    key: "equal_angles",
    meaning: "the angle between the first two lines is that between the other two, or the angle at the middle one of three \
         points is that at the middle one of three others",
    takes: "four lines, or six points with the vertices in the middle of three each",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let at_points = of.items.left() == 6 && of.items.points_ahead() == 6;
    let mut cosines = Vec::new();
    for index in 1..=2 {
        let (u, v) = if at_points {
            let [a, b, c] = [of.items.point()?, of.items.point()?, of.items.point()?];
            (low.span(b, a)?, low.span(b, c)?)
        } else {
            let (a, b) = (of.items.line()?, of.items.line()?);
            if a == b {
                return Err("a line has no angle with itself: name two different ones".to_owned());
            }
            if let (LineName::Axis(_), LineName::Axis(_)) = (a, b) {
                return Err("axes lie as they do: name one at most".to_owned());
            }
            (low.line(a)?.along, low.line(b)?.along)
        };
        let (u, v) = (low.heading(u), low.heading(v));
        let now = dot(&u.at, &v.at);
        let at = &Real::from(now.clone()) / &(&length(&u.at) * &length(&v.at));
        let what = format!("{}, cosine {index}", of.name);
        let scale = low.lengths(&[&u, &v]);
        let cosine = low.scalar(what.clone(), 0, Parity::Even, at.clone());
        let mut products = low.dot(1, &u.forms, &v.forms);
        products.push(Product::new(-1, value(cosine), value(scale)));
        low.equate(&what, products, vec![Real::zero()], u.power + v.power);
        cosines.push((cosine, at, now));
    }
    of.items.end()?;
    let [(one, first, sign), (other, second, another)] = &cosines[..] else {
        unreachable!("there are two")
    };
    let opposite = !at_points && (sign * another).is_negative();
    let side = if opposite { 1 } else { -1 };
    let products = vec![
        Product::new(1, value(*one), Form::One),
        Product::new(side, value(*other), Form::One),
    ];
    let start = if opposite {
        first + second
    } else {
        first - second
    };
    low.vanish(of.name, products, start, 0);
    Ok(())
}
