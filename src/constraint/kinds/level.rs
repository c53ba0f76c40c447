//! `horizontal` and `vertical`: two points at the same height, or one above the other. In the plane.

use super::prelude::*;

/// Along which axis the two points agree: y for `horizontal`, x for `vertical`.
pub struct Level {
    axis: usize,
}

/// The same height.
pub const HORIZONTAL: Level = Level { axis: 1 };

/// One above the other.
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

    fn example(&self) -> &'static str {
        r#"["p1", "p2"]"#
    }

    fn fixes(&self, _: &Problem, _: &[Item]) -> Fixes {
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
        let line = low.line(line)?;
        let products = vec![product(1, line.along.forms[self.axis], Form::One)];
        let start = Real::from(line.along.at[self.axis].clone());
        low.vanish_linear(of.name, products, start, line.along.power);
        Ok(())
    }
}
