//! `x`, `y`, `z`: a coordinate of a point; `dx`, `dy`, `dz`: by how much the second of two points is further
//! along an axis than the first, with its sign.

use super::prelude::*;
use crate::places::array;

/// A coordinate, or a difference of two.
pub struct Position {
    axis: usize,
    difference: bool,
}

/// All six.
pub const POSITIONS: [Position; 6] = [
    Position {
        axis: 0,
        difference: false,
    },
    Position {
        axis: 1,
        difference: false,
    },
    Position {
        axis: 2,
        difference: false,
    },
    Position {
        axis: 0,
        difference: true,
    },
    Position {
        axis: 1,
        difference: true,
    },
    Position {
        axis: 2,
        difference: true,
    },
];

impl Kind for Position {
    fn key(&self) -> &'static str {
        ["x", "y", "z", "dx", "dy", "dz"][self.axis + 3 * usize::from(self.difference)]
    }

    fn meaning(&self) -> &'static str {
        match self.difference {
            false => "a coordinate of a point is that number",
            true => {
                "the second point is by that much further along the axis than the first (with its sign)"
            }
        }
    }

    fn takes(&self) -> &'static str {
        match self.difference {
            false => "a point",
            true => "two points",
        }
    }

    fn measure(&self) -> Measure {
        Measure::Signed
    }

    fn fixes(&self, _: &Problem, _: &Constraint) -> Fixes {
        let axes = array(|k| k == self.axis && !self.difference);
        Fixes { frame: true, axes }
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        if self.axis >= low.dimension() {
            return Err("this is for problems of dimension 3".to_owned());
        }
        let first = of.items.point()?;
        let (form, now) = if self.difference {
            let second = of.items.point()?;
            if first == second {
                return Err("the two points are one and the same".to_owned());
            }
            let span = low.between(&low.place(first), &low.place(second));
            (span.forms[self.axis], span.at[self.axis].clone())
        } else {
            let place = low.place(first);
            (value(place.entries[self.axis]), place.at[self.axis].clone())
        };
        let then = Real::from(of.number().value().clone());
        of.items.end()?;
        let path = low.lead(now.into(), then);
        low.equate(of.name, vec![Product::new(1, form, Form::One)], path, 1);
        Ok(())
    }
}
