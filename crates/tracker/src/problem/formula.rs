//! Equations of one's own, read: `x^2 + y^2 = a`, over unknowns, coordinates `A.x`, lengths `|A-B|`, and what joints do.

use super::error::did_you_mean;
use super::expression::{Algebra, Reader};
use super::{Decimal, Item};
use crate::rational::Rational;
use crate::statement::{AXES, Atom, Formula, Object, Shape, Terms, nearest};
use std::collections::HashMap;

/// Most terms of an equation that is multiplied out.
const MOST_TERMS: usize = 2000;
/// The highest degree.
const MOST_DEGREE: usize = 24;
/// No coefficient has more bits than this, above or below.
const MOST_BITS: u64 = 4000;

/// The equation that a text says: two expressions with `=` between them, or one that is to be zero.
///
/// # Errors
/// What is wrong with it, in words, and where.
pub(super) fn read(
    text: &str,
    dimension: usize,
    items: &HashMap<&str, Item>,
    objects: &[Object],
) -> Result<Formula, String> {
    let atoms = Vec::new();
    let algebra = Polynomials {
        dimension,
        items,
        objects,
        atoms,
    };
    let mut reader = Reader::new(text, algebra);
    let mut zero = reader.sum()?;
    if reader.take('=') {
        reader.take('=');
        let right = reader.sum()?;
        let right = reader.algebra().negative(right);
        let whole = reader.algebra().sum(zero, right);
        zero = whole.map_err(|why| format!("`{text}`{why}"))?;
    }
    if reader.peek().is_some() {
        return Err(reader.wrong("an operator or `=` was expected"));
    }
    let atoms = std::mem::take(&mut reader.algebra().atoms);
    if let Some(number) = Polynomials::constant(&zero) {
        let why = match number.is_zero() {
            true => "it holds whatever the unknowns are: remove it",
            false => "there is no unknown in it, and it does not hold",
        };
        return Err(format!("`{text}`: {why}"));
    }
    let text = text.trim().to_owned();
    let formula = Formula { text, atoms, zero };
    match formula.has_turns() && formula.turns().is_none() {
        false => Ok(formula),
        true => Err(format!(
            "`{}`: turns are added up, each a whole number of times up to {}, and nothing else stands beside them but a number of degrees, as in \
             \"20*turn(A) + 30*turn(B) = 15\" (what ties a turn to a length, as a screw does, is no equation of polynomials)",
            formula.text,
            Formula::MOST_TURNS
        )),
    }
}

fn too_many_terms() -> String {
    format!(
        " has more than {MOST_TERMS} terms where it is multiplied out: make a part of it an unknown with an equation of its own"
    )
}

/// Polynomials in what names stand for.
struct Polynomials<'a> {
    dimension: usize,
    items: &'a HashMap<&'a str, Item>,
    objects: &'a [Object],
    atoms: Vec<Atom>,
}

impl Polynomials<'_> {
    fn atom(&mut self, atom: Atom) -> Terms {
        let found = self.atoms.iter().position(|other| *other == atom);
        let index = found.unwrap_or_else(|| {
            self.atoms.push(atom);
            self.atoms.len() - 1
        });
        Terms::sums([(vec![index], Rational::one())])
    }

    fn point(&self, name: &str) -> Result<usize, String> {
        match self.items.get(name) {
            Some(&Item::Point(point)) => Ok(point),
            _ => Err(self.unknown(name, "point", |item| matches!(item, Item::Point(_)))),
        }
    }

    fn joint(&self, name: &str) -> Result<usize, String> {
        let is_joint = |item: &Item| match item {
            Item::Object(object) => matches!(self.objects[*object].shape, Shape::Joint { .. }),
            _ => false,
        };
        match self.items.get(name) {
            Some(item @ &Item::Object(joint)) if is_joint(item) => Ok(joint),
            _ => Err(self.unknown(name, "joint", is_joint)),
        }
    }

    fn unknown(&self, name: &str, what: &str, is_meant: impl Fn(&Item) -> bool) -> String {
        let names = self.items.iter().filter(|(_, item)| is_meant(item));
        let meant = did_you_mean(nearest(name, &mut names.map(|(name, _)| *name)));
        format!(": there is no {what} `{name}`{meant}")
    }

    fn checked(terms: Terms) -> Result<Terms, String> {
        if terms.len() > MOST_TERMS {
            return Err(too_many_terms());
        }
        if terms.keys().any(|term| term.len() > MOST_DEGREE) {
            return Err(format!(" has a degree above {MOST_DEGREE}"));
        }
        let large = |c: &Rational| c.numer().bits().max(c.denom().bits()) > MOST_BITS;
        let is_large = terms.iter().any(|(_, c)| large(c));
        match is_large {
            true => Err(" has a number that is too large on the way".to_owned()),
            false => Ok(terms),
        }
    }

    /// The number that it is, if no unknown is in it.
    fn constant(terms: &Terms) -> Option<Rational> {
        let is_constant = terms.keys().all(Vec::is_empty);
        is_constant.then(|| terms.get(&Vec::new()).cloned().unwrap_or_default())
    }
}

impl Algebra for Polynomials<'_> {
    type Value = Terms;

    fn number(&self, number: Decimal) -> Result<Terms, String> {
        Ok(Terms::sums([(Vec::new(), number.value().clone())]))
    }

    fn name(&mut self, name: &str, rest: &str) -> Result<(Terms, usize), String> {
        let of_joint = match name {
            "turn" => Some(Atom::Turn as fn(usize) -> Atom),
            "travel" => Some(Atom::Travel as fn(usize) -> Atom),
            _ => None,
        };
        if let (Some(atom), Some(inner)) = (of_joint, rest.trim_start().strip_prefix('(')) {
            // Names of joints may have a parenthesis in them.
            let mut ends = inner.match_indices(')').map(|(end, _)| end);
            let first = ends.clone().next();
            let end = ends.find(|&end| self.joint(inner[..end].trim()).is_ok());
            let end = end.or(first);
            let end = end.ok_or_else(|| format!(": `)` is missing behind {name}("))?;
            let joint = self.joint(inner[..end].trim())?;
            return Ok((self.atom(atom(joint)), rest.len() - inner.len() + end + 1));
        }
        let mut behind = rest.chars();
        let coordinate = (behind.next() == Some('.'))
            .then(|| behind.next())
            .flatten();
        let ends = !behind
            .next()
            .is_some_and(|c| c.is_alphanumeric() || c == '_');
        if let Some(letter) = coordinate.filter(|_| ends) {
            let point = self.point(name)?;
            let axis = AXES.iter().position(|name| name.starts_with(letter));
            let axis = axis.filter(|&axis| axis < self.dimension);
            let axis = axis.ok_or_else(|| {
                let all = &["x", "y", "z"][..self.dimension];
                format!(
                    ": a point has the coordinates {}, and not `{letter}`",
                    all.join(", "),
                )
            })?;
            return Ok((self.atom(Atom::Coordinate { point, axis }), 2));
        }
        match self.items.get(name) {
            Some(&Item::Object(object)) => match self.objects[object].shape {
                Shape::Number { .. } => Ok((self.atom(Atom::Number(object)), 0)),
                Shape::Joint { .. } => Err(format!(
                    ": `{name}` is a joint: turn({name}) is by how many degrees it is turned, travel({name}) how far it is drawn out"
                )),
                _ => {
                    let kind = self.objects[object].kind(self.dimension);
                    Err(format!(": `{name}` is no number: its kind is {kind}"))
                }
            },
            Some(Item::Point(_)) => Err(format!(
                ": `{name}` is a point: its coordinates are {name}.x and {name}.y, and |{name}-B| is its distance from B"
            )),
            _ => Err(self.unknown(name, "unknown or parameter", |item| {
                matches!(item, Item::Object(_))
            })),
        }
    }

    fn bars(&mut self, inner: &str) -> Result<Terms, String> {
        // Names of points may have a hyphen in them.
        let splits = inner
            .match_indices('-')
            .map(|(at, _)| (&inner[..at], &inner[at + 1..]));
        let mut pairs = splits.map(|(a, b)| [a, b].map(str::trim));
        let known = pairs
            .clone()
            .find(|pair| pair.iter().all(|name| self.point(name).is_ok()));
        let Some([a, b]) = known.or_else(|| pairs.next()) else {
            return Err(format!(
                ": between two bars a length is meant, |A-B|, and not `{inner}`"
            ));
        };
        let ends = [self.point(a)?, self.point(b)?];
        match ends[0] == ends[1] {
            true => Err(format!(": |{a}-{b}| is no distance of two points")),
            false => Ok(self.atom(Atom::Length([ends[0].min(ends[1]), ends[0].max(ends[1])]))),
        }
    }

    fn root(&mut self, of: Terms) -> Result<Terms, String> {
        match Self::constant(&of) {
            Some(number) if number < Rational::zero() => {
                Err(" has the root of a number less than zero".to_owned())
            }
            Some(number) if number.is_zero() => Ok(of),
            _ => Ok(self.atom(Atom::Root(of))),
        }
    }

    fn sum(&self, a: Terms, b: Terms) -> Result<Terms, String> {
        Self::checked(Terms::sums(a.into_iter().chain(b)))
    }

    fn negative(&self, a: Terms) -> Terms {
        a.into_iter()
            .map(|(term, coefficient)| (term, -coefficient))
            .collect()
    }

    fn product(&self, a: &Terms, b: &Terms) -> Result<Terms, String> {
        if a.len() * b.len() > 100 * MOST_TERMS {
            return Err(too_many_terms());
        }
        let pairs = a
            .iter()
            .flat_map(|one| b.iter().map(move |other| (one, other)));
        Self::checked(Terms::sums(pairs.map(|((s, x), (t, y))| {
            let mut term = [&s[..], &t[..]].concat();
            term.sort_unstable();
            (term, x * y)
        })))
    }

    fn quotient(&mut self, a: Terms, b: Terms) -> Result<Terms, String> {
        match Self::constant(&b) {
            Some(number) if number.is_zero() => Err(" divides by zero".to_owned()),
            Some(number) => {
                Self::checked(a.into_iter().map(|(term, c)| (term, c / &number)).collect())
            }
            None => {
                let inverse = self.atom(Atom::Inverse(b));
                self.product(&a, &inverse)
            }
        }
    }

    fn whole(&self, a: &Terms) -> Option<u32> {
        let number = Self::constant(a)?;
        let whole = number.is_integer().then(|| number.to_integer());
        whole.and_then(|whole| u32::try_from(whole).ok())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statement::{JointSort, Pose};
    use proptest::prelude::*;

    fn items() -> HashMap<&'static str, Item> {
        HashMap::from([
            ("A", Item::Point(0)),
            ("B", Item::Point(1)),
            ("p-q", Item::Point(2)),
            ("x", Item::Object(0)),
            ("y", Item::Object(1)),
            ("j", Item::Object(2)),
            ("k 2", Item::Object(3)),
        ])
    }

    fn objects() -> [Object; 4] {
        let of = |name: &str, shape| Object {
            name: name.to_owned(),
            shape,
        };
        let number = || Shape::Number {
            sketch: Decimal::from(1),
            within: [None, None],
        };
        let pose = || Pose {
            at: [0, 0, 0].map(Decimal::from),
            z: [0, 0, 1].map(Decimal::from),
            x: [1, 0, 0].map(Decimal::from),
        };
        let joint = || Shape::Joint {
            sort: JointSort::Revolute,
            bodies: [0, 1],
            frames: Box::new([pose(), pose()]),
        };
        [
            of("x", number()),
            of("y", number()),
            of("j", joint()),
            of("k 2", joint()),
        ]
    }

    /// The polynomial where x and y have these values, and all else is 1.
    fn value(formula: &Formula, x: f64, y: f64) -> f64 {
        let at = |&atom: &usize| match formula.atoms[atom] {
            Atom::Number(0) => x,
            Atom::Number(1) => y,
            _ => 1.0,
        };
        let terms = formula.zero.iter();
        let number = |c: &Rational| c.to_f64();
        terms
            .map(|(term, c)| number(c) * term.iter().map(at).product::<f64>())
            .sum()
    }

    #[test]
    fn equations_are_read() {
        for (text, wanted) in [
            ("x^2 + y^2 = 2", 11.0),
            ("2*(x - 1)**2*y", 32.0),
            ("x/4 == 0.25*y", -0.25),
            ("x*(y - x) - 1e-1 = -0.1", 3.0),
            ("A.x + |A-B| = |A - p-q| * x", -1.0),
            ("x/(y - 1) = 2", 1.0),
            ("sqrt(x) = y", -3.0),
        ] {
            let formula = read(text, 2, &items(), &objects()).unwrap();
            assert_eq!(
                value(&formula, 3.0, 4.0) - if text.starts_with("x^2") { 12.0 } else { 0.0 },
                wanted,
                "{text}"
            );
        }
        let formula = read("|B-A|*A.y = x", 2, &items(), &objects()).unwrap();
        let wanted = [Item::Point(0), Item::Point(1), Item::Object(0)];
        assert_eq!(formula.items(), wanted);
        assert!(formula.is_placed());
    }

    #[test]
    fn turns_of_joints_add_up() {
        for (text, turns, degrees) in [
            ("20*turn(j) = 30*turn( k 2 ) + 15", [(2, 2), (3, -3)], "1.5"),
            ("turn(j)/3 + 0.5*turn(k 2)", [(2, 2), (3, 3)], "0"),
        ] {
            let formula = read(text, 2, &items(), &objects()).unwrap();
            let degrees: Decimal = degrees.parse().unwrap();
            let wanted = (turns.to_vec(), degrees.value().clone());
            assert_eq!(formula.turns(), Some(wanted), "{text}");
            assert_eq!(formula.items(), [Item::Object(2), Item::Object(3)]);
        }
        let formula = read("travel(j) = 2*x", 2, &items(), &objects()).unwrap();
        assert_eq!(formula.turns(), None);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, words) in [
            ("x + z = 1", "no unknown or parameter `z`"),
            ("A + x = 1", "A.x and A.y"),
            ("A.z = 1", "the coordinates x, y"),
            ("A.é = 1", "not `é`"),
            ("C.x = 1", "no point `C`"),
            ("|A-C| = 1", "no point `C`"),
            ("|A| = 1", "|A-B|"),
            ("|A-A| = 1", "no distance"),
            ("x - x = 0", "whatever the unknowns are"),
            ("1 = 2", "does not hold"),
            ("x/(y - y)", "divides by zero"),
            ("x = y = 1", "an operator or `=`"),
            ("(x + y + 1)^20*(x + y - 1)^20", "degree above"),
            (
                "(x+y+A.x+A.y+B.x+B.y)^12",
                "terms where it is multiplied out",
            ),
            ("sqrt(-2) = x", "less than zero"),
            ("x = ", "ends where"),
            ("j = 1", "turn(j)"),
            ("turn(x) = 1", "no joint `x`"),
            ("turn(j = 1", "`)` is missing"),
            ("turn(j) = travel(j)", "turns are added up"),
            ("turn(j)*turn(k 2) = 1", "turns are added up"),
            ("turn(j) = 501*turn(k 2)", "up to 500"),
        ] {
            let error = read(text, 2, &items(), &objects()).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    proptest! {
        /// No text makes it panic.
        #[test]
        fn no_text_panics(text in "[-+*/^().|=0-9xyABsqrt é]{0,30}") {
            let _ = read(&text, 2, &items(), &objects());
        }
    }
}
