//! `midpoint`: a point halfway between two others, `(m − a) + (m − b) = 0`.

use super::prelude::*;

/// See the module.
pub const MIDPOINT: Kind = Kind {
    key: "midpoint",
    meaning: "the first point is halfway between two others, or between the points of a line",
    takes: "a point, and two points or a line through two points",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let middle = of.items.point()?;
    let ends = of.items.segment()?;
    of.items.end()?;
    if ends.contains(&middle) {
        return Err("the point is one of the ends".to_owned());
    }
    halfway(of.name, low, middle, ends);
    Ok(())
}

/// Says that a point is halfway between two others.
pub fn halfway(name: &str, low: &mut Lowering, middle: usize, ends: [usize; 2]) {
    let middle = low.place(middle);
    let [a, b] = ends.map(|end| low.between(&low.place(end), &middle));
    let off = plus(&a.at, &b.at);
    for axis in 0..low.dimension() {
        let products = vec![
            Product::new(1, a.forms[axis], Form::One),
            Product::new(1, b.forms[axis], Form::One),
        ];
        let start = low.frame.component(&off, axis);
        low.vanish_linear(name, products, start, 1);
    }
}
