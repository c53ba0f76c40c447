//! Bodies with a place of their own, and the joints between them, as plain data.

use crate::decimal::Decimal;

/// A frame: its origin and two of its axes, in the coordinates of what it stands in. The directions need not have the length 1, and only
/// what of `x` is at a right angle to `z` counts; the y axis makes it right-handed. In the plane z is `0, 0, 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// The origin.
    pub at: [Decimal; 3],
    /// Along the z axis.
    pub z: [Decimal; 3],
    /// Along the x axis, or on its side of the z axis.
    pub x: [Decimal; 3],
}

crate::named! {
    /// What a joint leaves of the motion of its second body beside its first: both bodies have a frame of the joint.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum JointSort {
        /// A turn about z, which both frames share with their origins: a hinge.
        Revolute = "revolute",
        /// A travel along z; the frames' axes are parallel, each to each.
        Prismatic = "prismatic",
        /// A turn about z, and a travel along it.
        Cylindrical = "cylindrical",
        /// All turns about the origin.
        Spherical = "spherical",
        /// Turns about the z axes, which are at a right angle to each other and meet in the origin: a Cardan joint.
        Universal = "universal",
        /// The second frame's plane z = 0 lies in that of the first.
        Planar = "planar",
        /// The second frame's origin lies in the plane z = 0 of the first.
        OnPlane = "on_plane",
        /// None: both frames are one.
        Rigid = "rigid",
    }
}

impl JointSort {
    /// Whether it leaves a turn about z as the only one, so that there is an angle.
    pub fn turns(self) -> bool {
        matches!(self, Self::Revolute | Self::Cylindrical | Self::Planar)
    }

    /// Whether there is a travel along z that is not always 0.
    pub fn travels(self) -> bool {
        matches!(self, Self::Prismatic | Self::Cylindrical)
    }

    /// Whether both frames have the same directions.
    pub fn keeps_directions(self) -> bool {
        matches!(self, Self::Prismatic | Self::Rigid)
    }

    /// Whether there are such joints in the plane.
    pub fn is_in_plane(self) -> bool {
        matches!(self, Self::Revolute | Self::Prismatic | Self::Rigid)
    }
}
