//! `horizontal` and `vertical`: two points at the same height, or one above the other. In the plane.

use super::prelude::*;

/// Along which axis the two points agree: y for `horizontal`, x for `vertical`.
pub struct Level {
    axis: usize,
}

/// `horizontal`: two points at the same height, which have the same y.
pub const HORIZONTAL: Level = Level { axis: 1 };

/// `vertical`: two points one above the other, which have the same x.
pub const VERTICAL: Level = Level { axis: 0 };

impl Kind for Level {
    fn key(&self) -> &'static str {
        ["vertical", "horizontal"][self.axis]
    }

    fn meaning(&self) -> &'static str {
        [
            "a line is vertical, or one of two points is above the other",
            "a line is horizontal, or two points are at the same height",
        ][self.axis]
    }

    fn takes(&self) -> &'static str {
        "a line, or two points"
    }

    fn fixes(&self, _: &Problem, _: &Constraint) -> Fixes {
        Fixes {
            frame: true,
            ..Fixes::default()
        }
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        if low.dimension() == 3 {
            return Err(
                "this is for problems of dimension 2; in space say `dx`, `dy` or `dz`".to_owned(),
            );
        }
        let line = of.items.line()?;
        of.items.end()?;
        let along = match line {
            // Points in one place are at the same height.
            LineName::Points([a, b]) => low.between(&low.place(a), &low.place(b)),
            LineName::Free(_) => low.line(line)?.along,
            LineName::Axis(_) => {
                return Err("an axis lies as it does: name a line or two points".to_owned());
            }
        };
        let products = vec![Product::new(1, along.forms[self.axis], Form::One)];
        let start = Real::from(along.at[self.axis].clone());
        low.vanish_linear(of.name, products, start, along.power);
        Ok(())
    }
}
