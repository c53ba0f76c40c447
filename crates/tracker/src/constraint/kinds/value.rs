//! `values`: what an unknown number is.

use super::prelude::*;

/// See the module.
pub struct Values;

impl Kind for Values {
    fn key(&self) -> &'static str {
        "values"
    }

    fn meaning(&self) -> &'static str {
        "the value of an unknown"
    }

    fn takes(&self) -> &'static str {
        "an unknown"
    }

    fn measure(&self) -> Measure {
        Measure::Signed
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        let object = of.items.number()?;
        of.items.end()?;
        let number = low.unknown_number(object);
        let products = vec![Product::new(1, value(number.entry), Form::One)];
        let path = low.lead(number.at, Real::from(of.number().value().clone()));
        low.equate(of.name, products, path, 0);
        Ok(())
    }
}
