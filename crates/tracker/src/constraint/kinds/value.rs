//! `values`: what an unknown number is.

use super::prelude::*;

/// See the module.
pub const VALUES: Kind = Kind {
    key: "values",
    meaning: "the value of an unknown",
    takes: "an unknown",
    measure: Measure::Signed,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let object = of.items.number()?;
    of.items.end()?;
    let number = low.unknown_number(object);
    let products = vec![Product::new(1, value(number.entry), Form::One)];
    let path = low.lead(number.at, Real::from(of.number().value().clone()));
    low.equate(of.name, products, path, 0);
    Ok(())
}
