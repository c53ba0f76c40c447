//! Which condition of Krawczyk's test fails, and by how much.

use crate::interval::rounding::largest;
use std::fmt;

/// At most so much of the contraction may be used up by the length of the tube.
pub const MAX_CONTRACTION: f64 = 0.85;

/// Which condition of Krawczyk's test fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shortfall {
    /// Some bound is no number.
    Overflow,
    /// The contraction without the width of the box.
    Contraction(f64),
    /// How far the residual may move the path, and how far it may at most.
    Defect { defect: f64, room: f64 },
    /// How far the path may be from the tube's middle, and how far it was asked to be.
    Distance { distance: f64, radius: f64 },
    /// How well the path's direction is known.
    Direction(f64),
}

impl Shortfall {
    /// The one that asks for least, of those that there are for several lengths; none if there is a
    /// length without.
    pub fn least(all: impl Iterator<Item = Option<Self>>) -> Option<Self> {
        let mut least: Option<Self> = None;
        for shortfall in all {
            let shortfall = shortfall?;
            if least.is_none_or(|least| shortfall.rank() < least.rank()) {
                least = Some(shortfall);
            }
        }
        least
    }

    /// By how much it misses; what a shorter tube mends comes after all else.
    fn rank(self) -> (bool, f64) {
        let (mended, factor) = match self {
            Shortfall::Overflow => (true, f64::INFINITY),
            Shortfall::Contraction(contraction) => (true, contraction / MAX_CONTRACTION),
            Shortfall::Defect { defect, room } => (false, defect / room),
            Shortfall::Distance { distance, radius } => (false, distance / radius),
            Shortfall::Direction(direction) => (false, direction / 0.5),
        };
        (mended, largest(0.0, factor))
    }

    /// With lengths multiplied.
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Shortfall::Defect { defect, room } => Shortfall::Defect {
                defect: defect * factor,
                room: room * factor,
            },
            Shortfall::Distance { distance, radius } => Shortfall::Distance {
                distance: distance * factor,
                radius: radius * factor,
            },
            Shortfall::Overflow | Shortfall::Contraction(_) | Shortfall::Direction(_) => self,
        }
    }
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Shortfall::Overflow => write!(f, "its bounds are beyond 1e75"),
            Shortfall::Contraction(contraction) => write!(
                f,
                "it contracts by {contraction:.1e} at best, which must be below {MAX_CONTRACTION}"
            ),
            Shortfall::Defect { defect, room } => write!(
                f,
                "the residual may move the path by {defect:.1e}, and there is room for {room:.1e}"
            ),
            Shortfall::Distance { distance, radius } => write!(
                f,
                "the path is known up to {distance:.1e}, not {radius:.1e}"
            ),
            Shortfall::Direction(direction) => write!(
                f,
                "the path's direction is known up to {direction:.1e}, which must be below 0.5"
            ),
        }
    }
}
