//! `horizontal` and `vertical`: two points at the same height, or one above the other. In the plane.

use super::prelude::*;

/// `horizontal`: two points at the same height, which have the same y.
pub const HORIZONTAL: Kind = Kind {
    key: "horizontal",
    meaning: "a line is horizontal, or two points are at the same height",
    takes: "a line, or two points",
    fixes: Fixes::direction,
    ..Kind::lowered_by(lower::<1>)
};

/// `vertical`: two points one above the other, which have the same x.
pub const VERTICAL: Kind = Kind {
    key: "vertical",
    meaning: "a line is vertical, or one of two points is above the other",
    lower: lower::<0>,
    ..HORIZONTAL
};

/// The two points agree along an axis.
fn lower<const AXIS: usize>(mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
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
    let products = vec![Product::new(1, along.forms[AXIS], Form::One)];
    let start = Real::from(along.at[AXIS].clone());
    low.vanish_linear(of.name, products, start, along.power);
    Ok(())
}
