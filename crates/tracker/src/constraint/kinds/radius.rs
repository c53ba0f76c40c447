//! `radii` and `diameters` of circles, spheres and arcs.

use super::prelude::*;

/// A radius, or with `diameter` twice that.
pub struct Size {
    diameter: bool,
}

/// A radius.
pub const RADII: Size = Size { diameter: false };

/// A diameter.
pub const DIAMETERS: Size = Size { diameter: true };

impl Kind for Size {
    fn key(&self) -> &'static str {
        if self.diameter { "diameters" } else { "radii" }
    }

    fn meaning(&self) -> &'static str {
        if self.diameter {
            "the diameter of a circle, sphere or arc"
        } else {
            "the radius of a circle, sphere or arc"
        }
    }

    fn takes(&self) -> &'static str {
        "a circle, sphere or arc"
    }

    fn measure(&self) -> Measure {
        Measure::Length
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        let round = of.items.round()?;
        of.items.end()?;
        let round = low.round(round);
        let factor = if self.diameter { 2 } else { 1 };
        let now = &Real::whole(factor) * &Real::from(round.squared).sqrt();
        let then = Real::from(of.number().value().clone());
        let products = vec![Product::new(factor as i32, value(round.radius), Form::One)];
        let path = low.lead(now, then);
        low.equate(of.name, products, path, 1);
        Ok(())
    }
}
