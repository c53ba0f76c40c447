//! `coincident`: two or more points are in one place.

use super::prelude::*;

/// See the module.
pub const COINCIDENT: Kind = Kind {
    key: "coincident",
    meaning: "two or more points are in one place",
    takes: "two or more points",
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let points = distinct(&mut of.items)?;
    if points.len() < 2 {
        return Err("name at least two points".to_owned());
    }
    for &other in &points[1..] {
        let apart = low.between(&low.place(points[0]), &low.place(other));
        for axis in 0..low.dimension() {
            let start = low.frame.component(&apart.at, axis);
            let products = vec![Product::new(1, apart.forms[axis], Form::One)];
            low.vanish_linear(of.name, products, start, 1);
        }
    }
    Ok(())
}
