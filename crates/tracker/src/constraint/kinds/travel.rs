//! `travels`: how far a joint is drawn out.

use super::prelude::*;

/// See the module.
pub const TRAVELS: Kind = Kind {
    key: "travels",
    meaning: "how far along its axis a prismatic or cylindrical joint is drawn out, or how far apart the planes of a planar one are (with its sign)",
    takes: "a joint that travels",
    measure: Measure::Signed,
    ..Kind::lowered_by(lower)
};

fn lower(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
    let joint = of.items.joint()?;
    of.items.end()?;
    let (entry, at) = low.travel_of_joint(joint)?;
    let products = vec![Product::new(1, value(entry), Form::One)];
    let path = low.lead(at, Real::from(of.number().value().clone()));
    low.equate(of.name, products, path, 1);
    Ok(())
}
