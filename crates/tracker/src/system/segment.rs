//! Drawn lines along an axis and arcs: what of them must not shrink to nothing and come out turned round.

use super::simplices::determinant;
use crate::equations::Ring;
use crate::interval::vector::minus;
use crate::places::Each as _;

/// A line or an arc that is drawn, and keeps its sense as long as it does not vanish.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Segment {
    /// The object that it is, by index.
    pub object: usize,
    /// Between which points.
    pub extent: Extent,
}

/// What of a segment keeps its sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Extent {
    /// How much further along an axis the second point is than the first, of a line along that axis.
    Along {
        /// The line's ends.
        ends: [usize; 2],
        /// The axis.
        axis: usize,
    },
    /// The angle of an arc, from its start to its end, which is more than 0 and less than 360 degrees as long as the end is not
    /// on the ray from the centre through the start.
    Sweep {
        /// Centre, start and end.
        points: [usize; 3],
    },
}

impl Extent {
    /// The points, in order.
    pub fn points(&self) -> &[usize] {
        match self {
            Extent::Along { ends, .. } => ends,
            Extent::Sweep { points } => points,
        }
    }

    /// The sign, as `of` tells it of numbers, where the points are `at`, by place in [`Extent::points`]: of a line's length along its
    /// axis; of an arc that of the sine of its angle, or 1 where that is certain to be about 180 degrees. 0: it is not certain
    /// that it does not vanish.
    #[inline]
    pub fn sign<T: Ring + Copy>(&self, at: impl Fn(usize) -> [T; 3], of: impl Fn(T) -> i8) -> i8 {
        match *self {
            Extent::Along { axis, .. } => of(at(1)[axis] - at(0)[axis]),
            Extent::Sweep { .. } => {
                let points = [0, 1, 2].each(at);
                let [u, v] = [1, 2].each(|k| minus(points[k], points[0]));
                match of(determinant(3, |k| points[k])) {
                    0 if of(u[0] * v[0] + u[1] * v[1]) < 0 => 1,
                    sign => sign,
                }
            }
        }
    }

    /// Whether a sign is that of an extent that had another one before and did not vanish between.
    pub fn goes_with(&self, before: i8, sign: i8) -> bool {
        match self {
            Extent::Along { .. } => sign == before,
            // An arc grows past half a circle.
            Extent::Sweep { .. } => sign != 0,
        }
    }
}
