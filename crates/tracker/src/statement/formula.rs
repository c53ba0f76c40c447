//! Equations of one's own, as plain data: polynomials that are to be zero.

use super::{Item, Problem, Shape};
use crate::map::Map;
use crate::rational::Rational;
use num_traits::ToPrimitive;

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
    /// How far a joint is drawn out, by its index among the objects.
    Travel(usize),
    /// By how many degrees a joint is turned, up to whole turns. Where one stands in an equation, that is a sum of whole multiples of turns, and a number.
    Turn(usize),
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
                Atom::Number(object) | Atom::Travel(object) | Atom::Turn(object) => {
                    vec![Item::Object(object)]
                }
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

    /// Whether turns of joints stand in it.
    pub fn has_turns(&self) -> bool {
        let mut atoms = self.atoms.iter();
        atoms.any(|atom| matches!(atom, Atom::Turn(_)))
    }

    /// The joints and how often each of their turns is taken, whole numbers without a common factor, and to how many degrees that adds up, but for
    /// whole turns. `None`: it says something else, or a number is above [`Formula::MOST_TURNS`].
    pub fn turns(&self) -> Option<(Vec<(usize, i64)>, Rational)> {
        let mut degrees = Rational::zero();
        let mut turns = Vec::with_capacity(self.atoms.len());
        for (term, coefficient) in self.zero.iter() {
            match term[..] {
                [] => degrees = -coefficient,
                [atom] => match self.atoms.get(atom)? {
                    Atom::Turn(joint) => turns.push((*joint, coefficient)),
                    _ => return None,
                },
                _ => return None,
            }
        }
        let scale = Rational::to_coprime(turns.iter().map(|(_, coefficient)| *coefficient));
        let whole = |(joint, coefficient): (usize, &Rational)| {
            let times = (coefficient * &scale).to_integer().to_i64()?;
            (times.abs() <= Self::MOST_TURNS).then_some((joint, times))
        };
        let turns: Option<Vec<_>> = turns.into_iter().map(whole).collect();
        Some((turns.filter(|turns| !turns.is_empty())?, degrees * scale))
    }

    /// A turn is taken at most so often.
    pub const MOST_TURNS: i64 = 500;

    /// Whether all that it names is there.
    #[doc(hidden)]
    pub fn is_of(&self, problem: &Problem) -> bool {
        let known =
            |terms: &Terms, before: usize| terms.keys().flatten().all(|&atom| atom < before);
        let shape = |object: usize| problem.objects.get(object).map(|of| &of.shape);
        let atoms = self.atoms.iter().enumerate();
        known(&self.zero, self.atoms.len())
            && (!self.has_turns() || self.turns().is_some())
            && atoms.clone().all(|(k, atom)| match atom {
                Atom::Number(object) => matches!(shape(*object), Some(Shape::Number { .. })),
                Atom::Travel(object) | Atom::Turn(object) => {
                    matches!(shape(*object), Some(Shape::Joint { .. }))
                }
                Atom::Coordinate { point, axis } => {
                    *point < problem.points.len() && *axis < problem.dimension
                }
                Atom::Length([a, b]) => (*a).max(*b) < problem.points.len() && a != b,
                Atom::Root(of) | Atom::Inverse(of) => known(of, k),
            })
    }
}
