//! `perpendicular`: two lines, two planes, or a line and a plane.
//!
//! The product of directions or normals is led to zero; the direction of a line on a plane is parallel to
//! its normal.

use super::prelude::*;

/// See the module.
pub struct Perpendicular;

impl Kind for Perpendicular {
    fn key(&self) -> &'static str {
        "perpendicular"
    }

    fn meaning(&self) -> &'static str {
        "two lines (which need not meet), two planes, or a line and a plane are at a right angle"
    }

    fn takes(&self) -> &'static str {
        "two lines, two planes, or a line and a plane"
    }

    fn example(&self) -> &'static str {
        r#"["l1", "l2"]"#
    }

    fn lower(&self, mut of: Given, low: &mut Lowering) -> Result<(), Fault> {
        let first = super::angle::direction(&mut of.items, low)?;
        let second = super::angle::direction(&mut of.items, low)?;
        of.items.end()?;
        if first.1 == second.1 {
            orthogonal(of.name, low, &first.0, &second.0);
        } else {
            low.align(of.name, &first.0, &second.0);
        }
        Ok(())
    }
}
