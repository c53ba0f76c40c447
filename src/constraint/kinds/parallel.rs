//! `parallel`: two lines, two planes, or a line and a plane.
//!
//! In the plane the cross product of two directions is led to zero; in space `v = k u` with an unknown k, for
//! directions or normals; for a line and a plane the product of direction and normal.

use super::prelude::*;

/// See the module.
pub struct Parallel;

impl Kind for Parallel {
    fn key(&self) -> &'static str {
        "parallel"
    }

    fn meaning(&self) -> &'static str {
        "two lines, two planes, or a line and a plane are parallel"
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
            low.align(of.name, &first.0, &second.0);
        } else {
            orthogonal(of.name, low, &first.0, &second.0);
        }
        Ok(())
    }
}
