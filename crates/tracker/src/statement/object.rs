//! Objects beside points, and constraints beside distances, as plain data. What they mean is said in
//! [`crate::constraint`].

use super::{Formula, JointSort, Pose, Problem};
use crate::decimal::Decimal;

/// A line, plane, circle, sphere, arc, rigid body, joint, or an unknown number.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// The name used in constraints and results; no point has it.
    pub name: String,
    /// What it is.
    pub shape: Shape,
}

impl Object {
    /// What people call it, in a problem of that dimension: `line`, `plane`, `circle`, `sphere`, `arc`, `body`, `joint` or
    /// `unknown`.
    pub fn kind(&self, dimension: usize) -> &'static str {
        match &self.shape {
            Shape::Line(_) | Shape::FreeLine { .. } => "line",
            Shape::Plane(_) | Shape::FreePlane { .. } => "plane",
            Shape::Round { .. } if dimension == 2 => "circle",
            Shape::Round { .. } => "sphere",
            Shape::Arc { .. } => "arc",
            Shape::Body { .. } => "body",
            Shape::Joint { .. } => "joint",
            Shape::Number { .. } => "unknown",
        }
    }

    /// Where it is in the sketch, of a body with joints.
    pub fn place(&self) -> Option<&Pose> {
        match &self.shape {
            Shape::Body { place, .. } => place.as_deref(),
            _ => None,
        }
    }

    /// The frames that it has: of a body with joints its place in the sketch, of a joint those in both of its bodies.
    pub fn poses(&self) -> impl Iterator<Item = &Pose> {
        let of_joint = match &self.shape {
            Shape::Joint { frames, .. } => &frames[..],
            _ => &[],
        };
        self.place().into_iter().chain(of_joint)
    }

    /// The points that say where it is, as far as points do: of a circle or sphere the centre, of an arc the centre and
    /// both ends.
    pub fn points(&self) -> Vec<usize> {
        match &self.shape {
            Shape::Line(points) => points.to_vec(),
            Shape::Plane(points) => points.to_vec(),
            Shape::FreeLine { .. }
            | Shape::FreePlane { .. }
            | Shape::Number { .. }
            | Shape::Joint { .. } => Vec::new(),
            Shape::Round { center, .. } => vec![*center],
            Shape::Arc { center, start, end } => vec![*center, *start, *end],
            Shape::Body { points, .. } => points.clone(),
        }
    }
}

impl Shape {
    /// In words, between which numbers an unknown is sought: `between 0 and 2`. `None`: it may be any.
    pub fn range(&self) -> Option<String> {
        match self {
            Shape::Number { within, .. } => match within {
                [None, None] => None,
                [Some(low), None] => Some(format!("at least {low}")),
                [None, Some(high)] => Some(format!("at most {high}")),
                [Some(low), Some(high)] => Some(format!("between {low} and {high}")),
            },
            _ => None,
        }
    }

    /// The direction in the sketch of a line or plane of its own.
    #[doc(hidden)]
    pub fn own_direction(&self) -> Option<&[Decimal; 3]> {
        match self {
            Shape::FreeLine { direction, .. } => Some(direction),
            Shape::FreePlane { normal, .. } => Some(normal),
            _ => None,
        }
    }

    /// Of the numbers that say where a line or plane of its own is those that stay where its direction is reversed, and those
    /// that change their signs then. `None` for all other objects.
    #[doc(hidden)]
    pub fn split_direction<'a, T>(
        &self,
        numbers: &'a [T],
        dimension: usize,
    ) -> Option<[&'a [T]; 2]> {
        let stay = match self {
            Shape::FreeLine { .. } => dimension.min(numbers.len()),
            Shape::FreePlane { .. } => 0,
            _ => return None,
        };
        let (stay, turn) = numbers.split_at(stay);
        Some([stay, turn])
    }
}

/// The axis along which a vector goes most.
pub fn most_along(vector: &[Decimal; 3]) -> usize {
    (0..3)
        .max_by_key(|&k| vector[k].value().abs())
        .expect("there are three axes")
}

/// What an object is, and where it is in the sketch. Points are indices into [`Problem::points`].
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// The line through two points.
    Line([usize; 2]),
    /// A line of its own: it need not go through any point of the problem.
    FreeLine {
        /// A place on it in the sketch; the third number is zero in the plane.
        point: [Decimal; 3],
        /// Its direction in the sketch.
        direction: [Decimal; 3],
    },
    /// The plane through three points.
    Plane([usize; 3]),
    /// A plane of its own.
    FreePlane {
        /// A place in it in the sketch.
        point: [Decimal; 3],
        /// Its normal in the sketch.
        normal: [Decimal; 3],
    },
    /// A circle (in the plane) or a sphere (in space).
    Round {
        /// Its centre.
        center: usize,
        /// Its radius in the sketch.
        radius: Decimal,
    },
    /// An arc in the plane.
    Arc {
        /// Its centre.
        center: usize,
        /// One end.
        start: usize,
        /// The end that is not `start`.
        end: usize,
    },
    /// Points that move together, as one rigid body that is not mirrored.
    Body {
        /// The points.
        points: Vec<usize>,
        /// Their coordinates in the body's own frame, in the same order.
        local: Vec<[Decimal; 3]>,
        /// Where the body's frame is in the sketch, of one with joints.
        place: Option<Box<Pose>>,
    },
    /// What is left of the motion of one body beside another.
    Joint {
        /// What is left.
        sort: JointSort,
        /// The bodies, indices into [`Problem::objects`].
        bodies: [usize; 2],
        /// The joint's frame in that of either body.
        frames: Box<[Pose; 2]>,
    },
    /// A number that is sought, for equations of one's own.
    Number {
        /// Its value in the sketch.
        sketch: Decimal,
        /// Between which numbers it is in the solutions that are sought, where that is said; either end may be left out.
        within: [Option<Decimal>; 2],
    },
}

/// A constraint that is not a distance between two points.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// Its kind, by the key it has in problem files; [`crate::constraint::KINDS`] lists them.
    pub kind: String,
    /// What it is about, in the order in which its kind wants it.
    pub items: Vec<Item>,
    /// The value to meet, for kinds that have one: a length in the problem's unit, or degrees.
    pub value: Option<Decimal>,
    /// The equation that it is, of the kind `equations`; no other kind has one.
    pub formula: Option<Box<Formula>>,
}

/// What a constraint is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Item {
    /// A point, an index into [`Problem::points`].
    Point(usize),
    /// An object, an index into [`Problem::objects`].
    Object(usize),
    /// A coordinate axis: 0 for x, 1 for y, 2 for z.
    Axis(usize),
}

/// How the axes are called in constraints. No point or object may have such a name.
pub const AXES: [&str; 3] = ["x-axis", "y-axis", "z-axis"];

impl Problem {
    /// Lines and planes with directions of their own, by number, that are to stay where they are: the equations hold all components
    /// of such a direction but the greatest, of which they know the square, and zeros of them have both of its signs.
    #[doc(hidden)]
    pub fn fixed_directions(&self) -> impl Iterator<Item = usize> + '_ {
        let fixed = self.constraints.iter().filter(|c| c.kind == "fixed");
        fixed
            .filter_map(|c| match c.items.first() {
                Some(&Item::Object(object)) => Some(object),
                _ => None,
            })
            .filter(|&object| self.objects[object].shape.own_direction().is_some())
    }

    /// The name of an item.
    pub fn item_name(&self, item: Item) -> &str {
        match item {
            Item::Point(p) => &self.points[p].name,
            Item::Object(o) => &self.objects[o].name,
            Item::Axis(k) => AXES[k],
        }
    }

    /// A constraint as people read it: its kind, its items, and its value where it has one.
    ///
    /// ```
    /// # use krawl::problem::Problem;
    /// let problem = Problem::build("corner", 2)
    ///     .point("a", [1, 0]).point("b", [0, 0]).point("c", [0, 1])
    ///     .distance("a", "b", 2).distance("b", "c", 1).dimension("angles", ["a", "b", "c"], 60)
    ///     .finish().unwrap();
    /// assert_eq!(problem.constraint_name(0), "angles: a, b, c, 60");
    /// ```
    pub fn constraint_name(&self, index: usize) -> String {
        let constraint = &self.constraints[index];
        if let Some(formula) = &constraint.formula {
            return formula.text.clone();
        }
        let items = constraint.items.iter().map(|&item| self.item_name(item));
        let mut parts: Vec<String> = items.map(str::to_owned).collect();
        parts.extend(constraint.value.as_ref().map(Decimal::to_string));
        format!("{}: {}", constraint.kind, parts.join(", "))
    }

    /// Whether there is nothing but points and distances between them, up to rigid motions: the
    /// problems of RR 8705.
    pub fn is_distances_only(&self) -> bool {
        self.objects.is_empty() && self.constraints.is_empty()
    }

    /// Whether the problem has a frame of its own: a constraint fixes a place, a coordinate or a
    /// direction. Then the reference is empty, all coordinates are unknowns, and results are in the
    /// user's coordinates. Otherwise figures are sought up to rigid motions, and a reference takes
    /// those out.
    pub fn is_absolute(&self) -> bool {
        self.homotopy.reference.is_empty()
    }

    /// Whether there are bodies with joints, of which one stands still.
    pub fn has_joints(&self) -> bool {
        self.objects.iter().any(|object| object.place().is_some())
    }

    /// Bodies with joints that stay where the sketch has them: those that are `fixed`, and if there is none, the first.
    pub fn standing_bodies(&self) -> Vec<usize> {
        let bodies = 0..self.objects.len();
        let bodies = bodies.filter(|&body| self.objects[body].place().is_some());
        let all: Vec<usize> = bodies.collect();
        let is_fixed = |body: usize| {
            let mut constraints = self.constraints.iter();
            constraints.any(|c| c.kind == "fixed" && c.items.contains(&Item::Object(body)))
        };
        let fixed: Vec<usize> = all.iter().copied().filter(|&b| is_fixed(b)).collect();
        match fixed.is_empty() {
            true => all.into_iter().take(1).collect(),
            false => fixed,
        }
    }

    /// Index of the distance that bends, if one does.
    pub fn bend(&self) -> Option<usize> {
        Some(self.homotopy.bend).filter(|&bend| bend < self.distances.len())
    }
}
