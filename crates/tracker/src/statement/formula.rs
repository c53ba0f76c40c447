//! Equations of one's own, as plain data: polynomials that are to be zero.

use super::{Item, Problem};
use crate::map::Map;
use crate::rational::Rational;

/// An equation: what was written, and the polynomial that it says is zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    /// What was written, `x^2 + y^2 = 2`.
    pub text: String,
    /// What the polynomial is made of.
    pub atoms: Vec<Atom>,
    /// The polynomial.
    pub zero: Terms,
}

/// A polynomial multiplied out: for each product of atoms (indices into [`Formula::atoms`], in order, each as often as it is a
/// factor) its coefficient, which is not zero.
pub type Terms = Map<Vec<usize>, Rational>;

/// What polynomials are made of. All of them are numbers: lengths and coordinates are counted in the problem's unit.
#[derive(Debug, Clone, PartialEq)]
pub enum Atom {
    /// An unknown number, an index into [`Problem::objects`].
    Number(usize),
    /// A coordinate of a point.
    Coordinate {
        /// Index of the point.
        point: usize,
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
    },
    /// The distance of two points, by index.
    Length([usize; 2]),
    /// The root that is not negative of a polynomial in the atoms before.
    Root(Terms),
    /// 1 divided by a polynomial in the atoms before.
    Inverse(Terms),
}

impl Formula {
    /// The points and objects that it is about, each once.
    pub fn items(&self) -> Vec<Item> {
        let mut items: Vec<Item> = Vec::new();
        for atom in &self.atoms {
            let of = match *atom {
                Atom::Number(object) => vec![Item::Object(object)],
                Atom::Coordinate { point, .. } => vec![Item::Point(point)],
                Atom::Length([a, b]) => vec![Item::Point(a), Item::Point(b)],
                Atom::Root(_) | Atom::Inverse(_) => Vec::new(),
            };
            for item in of {
                if !items.contains(&item) {
                    items.push(item);
                }
            }
        }
        items
    }

    /// Whether coordinates stand in it, so that it says something of where a figure is.
    pub fn is_placed(&self) -> bool {
        let mut atoms = self.atoms.iter();
        atoms.any(|atom| matches!(atom, Atom::Coordinate { .. }))
    }

    /// Whether all that it names is there.
    #[doc(hidden)]
    pub fn is_of(&self, problem: &Problem) -> bool {
        let known =
            |terms: &Terms, before: usize| terms.keys().flatten().all(|&atom| atom < before);
        let atoms = self.atoms.iter().enumerate();
        known(&self.zero, self.atoms.len())
            && atoms.clone().all(|(k, atom)| match atom {
                Atom::Number(object) => problem
                    .objects
                    .get(*object)
                    .is_some_and(|o| matches!(o.shape, super::Shape::Number { .. })),
                Atom::Coordinate { point, axis } => {
                    *point < problem.points.len() && *axis < problem.dimension
                }
                Atom::Length([a, b]) => (*a).max(*b) < problem.points.len() && a != b,
                Atom::Root(of) | Atom::Inverse(of) => known(of, k),
            })
    }
}
