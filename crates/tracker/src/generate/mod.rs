//! Large well-constrained structures with few key unknowns, made to measure.
//!
//! A structure is a chain of rigid bodies, each built point by point without driving parameters,
//! with a few *loops* that cannot be built so: bars are left out, which lets the chain move, and
//! as many others close it again. Each loop costs a construction plan one driving parameter and
//! the Jacobian one key unknown ([`Plan::jacobian`](crate::plan::Plan::jacobian)), however large
//! the bodies are.
//!
//! The chain winds round a circle of a few bars' length: levers stay short and the Jacobian's
//! condition grows mildly with the size. All lengths are generic. The bend is the closing bar of
//! the first loop, which starts near its shortest length: the path goes from there to the longest
//! length that the bend reaches, and back the other way, so that it is a closed curve of moderate
//! length whatever the size, with solutions near the sketch.

mod chain;
mod close;
mod frame;
mod strip;
mod tetrahedra;
mod tower;

use crate::problem::{MAX_POINTS, Problem, counted, free_coordinates};
use crate::random::Random;

crate::named! {
    /// A family of structures.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Family {
        /// Triangles in the plane, each on an edge of the one before: hinged chains of such strips,
        /// closed by bars.
        Strip = "strip",
        /// Tetrahedra, each on a face of the one before: hinged chains of such strips, closed by bars.
        Tetrahedra = "tetrahedra",
        /// Octahedra, each sharing an edge with the one before: chains with a few hinges, closed by
        /// bars. The octahedra have one diagonal in place of an edge, so that they can be built.
        Chain = "chain",
        /// Octahedra, each on a face of the one before. A few are octahedra, which cannot be built
        /// point by point (RR 8705, figure 1); the others have one diagonal in place of an edge.
        Tower = "tower",
    }
}

impl Family {
    /// 2 for the plane, 3 for space.
    pub fn dimension(self) -> usize {
        match self {
            Family::Strip => 2,
            _ => 3,
        }
    }

    /// Free coordinates of the smallest structure with so many loops.
    pub fn smallest(self, loops: usize) -> usize {
        match self {
            Family::Strip => 2 * (6 + 8 * loops) - 3,
            Family::Tetrahedra => 3 * (4 + 8 * loops) - 6,
            Family::Chain => 12 * (2 + 2 * loops),
            Family::Tower => 9 * loops + 3,
        }
    }

    /// The number of points with which there are at least so many free coordinates.
    fn points(self, size: usize) -> usize {
        match self {
            Family::Strip => (size + 3).div_ceil(2),
            Family::Tetrahedra => (size + 6).div_ceil(3),
            Family::Chain => 4 * size.div_ceil(12) + 2,
            Family::Tower => 3 * (size.saturating_sub(3).div_ceil(9) + 1),
        }
    }
}

/// What to make.
///
/// ```
/// use krawl::generate::{Family, Recipe};
/// use krawl::{plan::Plan, system::Homotopy};
/// let problem = Recipe::new(Family::Strip, 100).problem().unwrap();
/// assert_eq!(problem.free_coordinates(), 101);
/// let plan = Plan::derive(&Homotopy::new(&problem).unwrap());
/// assert_eq!(plan.driving(), 1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recipe {
    /// Which family.
    pub family: Family,
    /// The least number of free coordinates wanted. The structure is the smallest that has as
    /// many: one more at most for [`Family::Strip`], up to two, 11 and 8 more for
    /// [`Family::Tetrahedra`], [`Family::Chain`] and [`Family::Tower`].
    pub size: usize,
    /// The number of loops, which is that of driving parameters and key unknowns; at least 1.
    pub loops: usize,
    /// Places and lengths are drawn from this: equal seeds, equal problems.
    pub seed: u64,
}

/// Why there is no such structure.
#[derive(Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum GenerateError {
    /// Nothing to close.
    #[error("the number of loops must be at least 1: without one the structure has no key unknown")]
    NoLoops,
    /// No room for the loops.
    #[error(
        "a size of {size} is too small for {}: `{}` needs at least {least}",
        counted(*.loops, "loop"), .family.name()
    )]
    TooSmall {
        /// Which family.
        family: Family,
        /// The size asked for.
        size: usize,
        /// The loops asked for.
        loops: usize,
        /// The least size with as many loops.
        least: usize,
    },
    /// More points than problems have.
    #[error(
        "a size of {size} is too large: `{}` is made up to {largest}, which is {MAX_POINTS} points",
        .family.name()
    )]
    TooLarge {
        /// Which family.
        family: Family,
        /// The size asked for.
        size: usize,
        /// The largest size.
        largest: usize,
    },
}

crate::debug_in_words!(GenerateError);

impl Recipe {
    /// With one loop and the first seed.
    pub fn new(family: Family, size: usize) -> Self {
        Recipe {
            family,
            size,
            loops: 1,
            seed: 1,
        }
    }

    /// Makes the problem.
    ///
    /// # Errors
    /// Where the size does not suit the family or the loops.
    pub fn problem(&self) -> Result<Problem, GenerateError> {
        let &Recipe {
            family,
            size,
            loops,
            ..
        } = self;
        if loops == 0 {
            return Err(GenerateError::NoLoops);
        }
        let largest = free_coordinates(family.dimension(), MAX_POINTS);
        // Before anything is computed with numbers that could overflow.
        if size > largest || family.points(size) > MAX_POINTS {
            return Err(GenerateError::TooLarge {
                family,
                size,
                largest: (0..=largest)
                    .rev()
                    .find(|&size| family.points(size) <= MAX_POINTS)
                    .unwrap_or(0),
            });
        }
        let least = family.smallest(loops.min(MAX_POINTS));
        if size < least {
            return Err(GenerateError::TooSmall {
                family,
                size,
                loops,
                least,
            });
        }
        let mut random = Random::new(self.seed);
        let points = family.points(size);
        let structure = match family {
            Family::Strip => close::close(strip::frame(points, &mut random), loops, &mut random),
            Family::Tetrahedra => {
                close::close(tetrahedra::frame(points, &mut random), loops, &mut random)
            }
            Family::Chain => close::close(chain::frame(points, &mut random), loops, &mut random),
            Family::Tower => tower::structure(points, loops, &mut random),
        };
        let name = format!("{}-{size}-{loops}-{}", family.name(), self.seed);
        Ok(structure.problem(&name, &mut random))
    }
}
