//! `fixed`: a point stays where the sketch has it.

use super::prelude::*;

/// See the module.
pub struct Fixed;

impl Kind for Fixed {
    fn key(&self) -> &'static str {
        "fixed"
    }

    fn meaning(&self) -> &'static str {
        "a point stays where the sketch has it"
    }

    fn takes(&self) -> &'static str {
        "a point"
    }

    fn example(&self) -> &'static str {
        r#""p1""#
    }

    fn fixes(&self, _: &Problem, _: &[Item]) -> Fixes {
        Fixes {
            frame: true,
            axes: [true; 3],
        }
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        let point = of.items.point()?;
        of.items.end()?;
        for axis in 0..low.dimension() {
            low.hold(of.name, point, axis);
        }
        Ok(())
    }
}
