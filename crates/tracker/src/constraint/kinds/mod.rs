//! The kinds of constraints, one file each.

mod along;
mod angle;
mod coincident;
mod collinear;
mod coplanar;
mod distance;
mod equal;
mod equation;
mod fixed;
mod length;
mod level;
mod midpoint;
mod on;
mod parallel;
mod position;
mod radius;
mod same_angle;
mod same_distance;
mod symmetric;
mod tangent;
mod travel;
mod turn;
mod value;

pub use angle::is_opposite_nearer;
pub use equation::EQUATIONS;

use super::kind::Kind;

/// All kinds of constraints, in the order in which problem files list them.
pub const KINDS: &[Kind] = &[
    distance::DISTANCES,
    angle::ANGLES,
    turn::TURNS,
    turn::TORSIONS,
    travel::TRAVELS,
    radius::RADII,
    radius::DIAMETERS,
    position::coordinate::<0>("x"),
    position::coordinate::<1>("y"),
    position::coordinate::<2>("z"),
    position::difference::<0>("dx"),
    position::difference::<1>("dy"),
    position::difference::<2>("dz"),
    along::ALONG,
    length::RATIOS,
    length::DIFFERENCES,
    fixed::FIXED,
    coincident::COINCIDENT,
    level::HORIZONTAL,
    level::VERTICAL,
    on::ON,
    midpoint::MIDPOINT,
    collinear::COLLINEAR,
    coplanar::COPLANAR,
    parallel::PARALLEL,
    parallel::PERPENDICULAR,
    tangent::TANGENT,
    equal::EQUAL,
    same_distance::EQUAL_DISTANCES,
    same_angle::EQUAL_ANGLES,
    symmetric::SYMMETRIC,
    value::VALUES,
    equation::EQUATION,
];

/// What all of them use.
mod prelude {
    pub use super::super::arguments::{Arguments, Flat, LineName, PlaneName, Sort, Thing};
    pub use super::super::frame::{cross, cross_in_plane, dot, is_zero, length, minus, plus};
    pub use super::super::kind::{Fixes, Given, Kind, Measure};
    pub use super::super::lowering::{Arrow, Fault, Lowering, Measured, Parity, Place};
    pub use super::super::objects::{Line, Plane, Round};
    pub use super::super::polynomial::multiply;
    pub use super::super::quadratic::{Form, Product, value};
    pub use crate::interval::Real;
    pub use crate::rational::Rational;
    pub use crate::statement::{Constraint, Item, Problem};
    pub use num_traits::{Signed, Zero};

    /// All points that are named, each once.
    pub fn distinct(items: &mut Arguments) -> Result<Vec<usize>, Fault> {
        let mut points = Vec::new();
        while items.next() != Sort::End {
            let point = items.point()?;
            if points.contains(&point) {
                return Err("a point is named twice: remove one".to_owned());
            }
            points.push(point);
        }
        Ok(points)
    }

    /// The number with the sign of `like`, unless that is zero.
    pub fn with_sign(like: &Rational, number: Real) -> Option<Real> {
        match (like.is_zero(), like.is_negative()) {
            (true, _) => None,
            (_, true) => Some(-&number),
            _ => Some(number),
        }
    }

    /// Leads the product of two vectors, neither of which may vanish, to zero.
    pub fn orthogonal(name: &str, low: &mut Lowering, u: &Arrow, v: &Arrow) {
        low.nonzero(u);
        low.nonzero(v);
        let products = low.dot(1, &u.forms, &v.forms);
        let start = Real::from(dot(&u.at, &v.at));
        low.vanish(name, products, start, u.power + v.power);
    }
}
