//! `ratios` and `differences` of the lengths of two lines, from point to point.
//!
//! With the lengths as unknowns, `|u| = k |v|` and `|u| − |v| = d`, where k and d go linearly from what they are in the
//! sketch to what is wanted.

use super::prelude::*;

/// The first is so many times the second.
pub const RATIOS: Kind = Kind {
    key: "ratios",
    meaning: "the first line is so many times as long as the second, from point to point",
    takes: "two lines through two points each, or pairs of points",
    measure: Measure::Ratio,
    ..Kind::lowered_by(lower::<true>)
};

/// The first is longer by so much.
pub const DIFFERENCES: Kind = Kind {
    key: "differences",
    meaning: "the first line is longer than the second by that much, from point to point (less than zero: shorter)",
    measure: Measure::Signed,
    lower: lower::<false>,
    ..RATIOS
};

fn lower<const RATIO: bool>(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let (first, second) = (of.items.segment()?, of.items.segment()?);
    of.items.end()?;
    if first == second || first == [second[1], second[0]] {
        return Err("the two lines are one and the same".to_owned());
    }
    let (u, v) = (
        low.span(first[0], first[1])?,
        low.span(second[0], second[1])?,
    );
    let (one, other) = (length(&u.at), length(&v.at));
    let then = Real::from(of.number().value().clone());
    let (long, short) = (value(low.length(&u)), value(low.length(&v)));
    if RATIO {
        let path = low.lead(&one / &other, then);
        let ratio = format!("{}, the value", of.name);
        let ratio = value(low.coefficient(&ratio, 0, Parity::Even, path));
        let products = vec![
            Product::new(1, long, Form::One),
            Product::new(-1, ratio, short),
        ];
        low.equate(of.name, products, vec![Real::zero()], 1);
    } else {
        let path = low.lead(&one - &other, then);
        let products = vec![
            Product::new(1, long, Form::One),
            Product::new(-1, short, Form::One),
        ];
        low.equate(of.name, products, path, 1);
    }
    Ok(())
}
