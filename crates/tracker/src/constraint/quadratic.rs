//! Equations beyond distances: quadratic, with t on the right-hand side only.
//!
//! Every constraint becomes equations `½ Σ factor · left · right = E(t)`, where left and right are
//! differences of unknowns or the constant 1, factors are small whole numbers, and E is a
//! polynomial of degree at most 4 with exact coefficients. A distance is such an equation too; the
//! trackers keep distances apart, as their *head*, and all others in a list, the *tail*, so that
//! problems of distances alone pay nothing for the rest.

use crate::equations;
use crate::interval::{Interval, Real};

/// The highest degree of a right-hand side in t.
pub const MAX_DEGREE: usize = 4;

/// What a difference is made of, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Entry {
    /// The number 0.
    Zero,
    /// A coordinate of a point, x first. Coordinates that the reference fixes are zero.
    Coordinate {
        /// Index of the point.
        point: usize,
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
    },
    /// An auxiliary unknown, an index into [`Tail::unknowns`].
    Unknown(usize),
}

impl Entry {
    /// The auxiliary unknown that it is.
    pub fn unknown(self) -> Option<usize> {
        match self {
            Entry::Unknown(u) => Some(u),
            _ => None,
        }
    }

    /// Whether it changes its sign where an axis is reversed; the number 0 has both.
    pub fn changes(self, tail: &Tail, axis: usize) -> Option<bool> {
        match self {
            Entry::Zero => None,
            Entry::Coordinate { axis: k, .. } => Some(k == axis),
            Entry::Unknown(u) => Some(tail.unknowns[u].flips[axis]),
        }
    }
}

impl From<Option<usize>> for Entry {
    fn from(unknown: Option<usize>) -> Self {
        unknown.map_or(Entry::Zero, Entry::Unknown)
    }
}

/// A difference of entries, or the number 1.
pub type Form = equations::Form<Entry>;

/// A product of differences of entries.
pub type Product = equations::Product<Entry>;

/// `½ Σ factor · left · right = E(t)`.
///
/// A linear equation `x = 3` is the product of factor 2 of `x − 0` and 1, with E = 3. Several of the
/// products may be alike; an equation needs at least one.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// What people call it, as in "the angle a-b-c".
    pub name: String,
    /// The left-hand side.
    pub products: Vec<Product>,
    /// The coefficients of E, of t⁰ first, at most five.
    pub right: Vec<Real>,
    /// The power of the unit of length that both sides have: 2 for products of lengths, 1 for
    /// `x = 3`, 0 for pure numbers. All products have it.
    pub power: i32,
}

impl Equation {
    /// E at t = 1.
    pub fn target(&self) -> Real {
        self.right.iter().fold(Real::zero(), |sum, c| &sum + c)
    }

    /// The two points of an equation that has half the square of their distance on the left, in so many dimensions:
    /// a product of factor 1 for each axis, in order, of the difference of their coordinates with itself.
    pub fn ends(&self, dimension: usize) -> Option<[usize; 2]> {
        let ends_on = |(axis, product): (usize, &Product)| match (product.left, product.right) {
            (
                Form::Difference(
                    Entry::Coordinate { point: a, axis: k },
                    Entry::Coordinate { point: b, axis: l },
                ),
                right,
            ) if product.factor == 1 && product.left == right && (k, l) == (axis, axis) => {
                Some([a, b])
            }
            _ => None,
        };
        let mut ends = self.products.iter().enumerate().map(ends_on);
        let first = ends.next().flatten()?;
        (self.products.len() == dimension && ends.all(|other| other == Some(first)))
            .then_some(first)
    }
}

/// What has to be proved of an auxiliary unknown along the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Nothing.
    Free,
    /// It is positive: a length or a radius, whose square is in an equation.
    Positive,
}

/// An auxiliary unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// What people call it, as in "the radius of c1".
    pub name: String,
    /// What has to be proved of it.
    pub role: Role,
    /// The power of the unit of length that it has: 1 for a radius, 2 for a cross product, 0 for a cosine.
    pub power: i32,
    /// For each axis whether it changes its sign where that axis is reversed. So do coordinates along
    /// the axis; a cross product's first entry does for the second and third axis.
    pub flips: [bool; 3],
    /// An enclosure of its value in the sketch, seen from the reference, in the problem's unit.
    pub sketch: Interval,
}

/// A vector that must not vanish along the path, as an equation that holds trivially where it does would say
/// nothing there: the leg of a right angle, the normal of a plane that a point is on.
#[derive(Debug, Clone, PartialEq)]
pub struct Nonzero {
    /// What people call it, as in "a-b".
    pub name: String,
    /// Its coordinates.
    pub forms: [Form; 3],
}

impl Nonzero {
    /// The unknowns in its coordinates, of which it has so many.
    pub fn unknowns(&self, dimension: usize) -> impl Iterator<Item = usize> + '_ {
        let entries = self.forms[..dimension]
            .iter()
            .flat_map(|form| form.entries());
        entries.filter_map(|(entry, _)| entry.unknown())
    }
}

/// Where a body with joints is, by its unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Posed {
    /// The body, by number among the objects.
    pub body: usize,
    /// Its origin: unknowns, or where it stands, in the problem's unit.
    pub origin: Result<[Entry; 3], [Interval; 3]>,
    /// The unit vectors by which it is told how it is turned: none of a body that stands, one in the plane, two in space.
    pub along: Vec<[Form; 3]>,
    /// Its axes: of a body that stands their coordinates, in the plane the coordinates along the vector and the same turned counter-clockwise by a
    /// right angle, in space along both vectors and their cross product.
    pub axes: [[Interval; 3]; 3],
}

/// All unknowns and equations beyond coordinates of points and distances. There are as many unknowns
/// and equations in all as the problem has free coordinates and distances, and these.
#[derive(Debug, Clone, PartialEq)]
pub struct Tail {
    /// The auxiliary unknowns.
    pub unknowns: Vec<Unknown>,
    /// The equations.
    pub equations: Vec<Equation>,
    /// The vectors that must not vanish.
    pub nonzero: Vec<Nonzero>,
    /// Changes of sign of auxiliary unknowns that leave the figure as it is, and the equations at t = 1 true: a line
    /// is the same line with its direction reversed. Per change the unknowns concerned; all sums of changes
    /// are such changes too.
    pub twins: Vec<Vec<bool>>,
    /// For each object of the problem its own unknowns: of a line of its own the place nearest to the origin and
    /// the direction, of a plane of its own the normal and the level, of a circle, sphere or arc the radius.
    pub objects: Vec<Vec<Entry>>,
    /// Where bodies with joints are.
    pub poses: Vec<Posed>,
    /// Whether the mirror image of a solution is a solution too. It is not where a constraint says
    /// which way round a figure is.
    pub mirrors: bool,
}

impl Default for Tail {
    fn default() -> Self {
        Tail {
            unknowns: Vec::new(),
            equations: Vec::new(),
            nonzero: Vec::new(),
            twins: Vec::new(),
            objects: Vec::new(),
            poses: Vec::new(),
            mirrors: true,
        }
    }
}

impl Tail {
    /// Whether there are distances only.
    pub fn is_empty(&self) -> bool {
        self.equations.is_empty()
    }

    /// The right-hand sides, in the order of the equations.
    pub fn rights(&self) -> Vec<Vec<Real>> {
        self.equations.iter().map(|e| e.right.clone()).collect()
    }
}

/// The coordinate of a point.
pub fn coordinate(point: usize, axis: usize) -> Entry {
    Entry::Coordinate { point, axis }
}

/// `from − to`, as a factor of a product.
pub fn difference(from: Entry, to: Entry) -> Form {
    Form::Difference(from, to)
}

/// An entry itself, as a factor of a product.
pub fn value(of: Entry) -> Form {
    Form::Difference(of, Entry::Zero)
}
