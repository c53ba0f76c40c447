//! A homotopy made of equations and unknowns directly: a part of a problem's, or its with some unknowns made one.

use super::{Homotopy, Right, Segment, Term};
use crate::constraint::{Equation, Nonzero, Tail, Unknown};

/// Equations in unknowns that are all listed; [`crate::constraint::Entry::Unknown`] is an index into them.
#[derive(Debug, Clone)]
pub struct Part {
    /// 2 or 3.
    pub dimension: usize,
    /// For each point of the problem and each axis the unknown that its coordinate is, if it is one of these.
    pub coordinates: Vec<Option<usize>>,
    /// The length that 1 stands for: a power of two.
    pub unit: f64,
    /// The unknowns, with their values in the sketch.
    pub unknowns: Vec<Unknown>,
    /// As many equations.
    pub equations: Vec<Equation>,
    /// Vectors that must not vanish along the path.
    pub nonzero: Vec<Nonzero>,
    /// Points of which the orientation is followed: three in the plane, four in space.
    pub followed: Vec<Vec<usize>>,
    /// Lines and arcs that are followed, as they must not vanish.
    pub segments: Vec<Segment>,
    /// Equations that were left out, and [`Beside::within`] of each.
    pub beside: Vec<(Equation, [f64; 2])>,
}

/// An equation that is not one of a homotopy's own, of which is looked how far figures are off it.
#[derive(Debug, Clone)]
pub struct Beside {
    /// Twice its left-hand side.
    pub terms: Vec<Term>,
    /// Its right-hand side.
    pub right: Right,
    /// It is met where it is off by no more than the first, and missed where it is off by more than the second.
    pub within: [f64; 2],
}

impl Homotopy {
    /// The homotopy of a part.
    ///
    /// # Panics
    /// If there are not as many equations as unknowns, or the unit is not a power of two.
    pub fn of_part(part: Part) -> Self {
        let m = part.unknowns.len();
        assert_eq!(part.equations.len(), m, "as many equations as unknowns");
        assert!(part.unit.is_normal() && part.unit > 0.0 && part.unit.to_bits() << 12 == 0);
        let variable = part.coordinates.iter().map(|c| c.unwrap_or(m));
        let tail = Tail {
            unknowns: part.unknowns,
            equations: part.equations,
            nonzero: part.nonzero,
            mirrors: false,
            ..Tail::default()
        };
        let mut homotopy =
            Homotopy::without_distances(part.dimension, variable.collect(), part.unit, tail);
        homotopy.followed = part.followed;
        homotopy.segments = part.segments;
        let beside = part.beside.into_iter().map(|(equation, within)| {
            let (terms, right) = homotopy.terms_of(&equation);
            Beside {
                terms,
                right,
                within,
            }
        });
        homotopy.beside = beside.collect();
        homotopy
    }
}
