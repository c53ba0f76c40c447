//! `equal`: lines (that is, pairs of points) of the same length, circles, arcs or spheres of the same radius.
//!
//! Lengths: `|u|² − |v|²` is led to zero. Radii: `r₁ − r₂`.

use super::prelude::*;

/// See the module.
pub const EQUAL: Kind = Kind {
    key: "equal",
    meaning: "two or more lines through two points each are equally long from point to point, or circles, arcs or \
         spheres have the same radius",
    takes: "lines through two points, or pairs of points; or circles, arcs or spheres",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    if of.items.next() == Sort::Round {
        let mut rounds = Vec::new();
        while of.items.next() != Sort::End {
            rounds.push(of.items.round()?);
        }
        let [first, rest @ ..] = rounds.as_slice() else {
            unreachable!("the first one is a circle")
        };
        if rest.is_empty() || rest.contains(first) {
            return Err("name at least two different ones".to_owned());
        }
        let first = low.round(*first);
        for &other in rest {
            let other = low.round(other);
            let products = vec![Product::new(
                1,
                Form::Difference(first.radius, other.radius),
                Form::One,
            )];
            let start =
                &Real::from(first.squared.clone()).sqrt() - &Real::from(other.squared).sqrt();
            low.vanish_linear(of.name, products, start, 1);
        }
        return Ok(());
    }
    let mut spans = Vec::new();
    while of.items.next() != Sort::End {
        spans.push(of.items.segment()?);
    }
    let [first, rest @ ..] = spans.as_slice() else {
        return Err("name at least two lines".to_owned());
    };
    if rest.is_empty() {
        return Err("name at least two lines".to_owned());
    }
    let u = low.span(first[0], first[1])?;
    for other in rest {
        let v = low.span(other[0], other[1])?;
        let mut products = low.dot(1, &u.forms, &u.forms);
        products.extend(low.dot(-1, &v.forms, &v.forms));
        let start = dot(&u.at, &u.at) - dot(&v.at, &v.at);
        low.vanish(of.name, products, start.into(), 2);
    }
    Ok(())
}
