//! What can be measured of a figure: lengths, angles, coordinates and areas that no constraint has to give.

use crate::equations::Ring;
use crate::interval::along::{Along, Quantifiable};
use crate::interval::angle::direction;
use crate::interval::vector::{cross, dot, minus};
use crate::interval::{Interval, hull, point};
use crate::places::Each as _;
use crate::problem::{Problem, Shape};
use crate::system::{Homotopy, Located, Numbers};
use std::rc::Rc;

/// Something that is measured of figures of a problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// As it was asked for.
    pub name: String,
    what: What,
    points: Vec<usize>,
}

/// Where things are: a place for each point, and numbers for each object.
pub struct Seen<P, N> {
    /// Where a point is.
    pub point: P,
    /// What numbers an object has.
    pub numbers: N,
}

impl Homotopy {
    /// Where things are, in the unit of the problem, where the unknowns are these, in the homotopy's own.
    pub fn seen<T: Quantifiable + Ring>(
        &self,
        unknown: impl Fn(usize) -> T,
    ) -> Seen<impl Fn(usize) -> [T; 3], impl Fn(usize) -> Numbers<T>> {
        let unit = T::constant(self.unit);
        let unknown = Rc::new(unknown);
        let of_numbers = unknown.clone();
        Seen {
            point: move |p: usize| self.place(p, |i| unknown(i) * unit),
            numbers: move |object: usize| self.numbers(object, &*of_numbers),
        }
    }
}

/// Which number of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    /// By how many degrees a joint is turned.
    Turn,
    /// How far a joint is drawn out.
    Travel,
    /// The radius of a circle, sphere or arc.
    Radius,
    /// The value of an unknown number.
    Value,
}

impl Part {
    /// The part that a word names, and what has it.
    fn named(word: &str) -> Option<(Part, &'static str)> {
        Some(match word {
            "turn" => (Part::Turn, "joint that turns about one axis"),
            "travel" => (Part::Travel, "joint that travels along its axis"),
            "radius" => (Part::Radius, "circle, sphere or arc"),
            "value" => (Part::Value, "unknown"),
            _ => return None,
        })
    }

    fn is_of(self, shape: &Shape) -> bool {
        match (self, shape) {
            (Part::Turn, Shape::Joint { sort, .. }) => sort.turns(),
            (Part::Travel, Shape::Joint { sort, .. }) => sort.travels(),
            (Part::Radius, Shape::Round { .. } | Shape::Arc { .. })
            | (Part::Value, Shape::Number { .. }) => true,
            _ => false,
        }
    }

    fn of(self, object: &Located) -> Option<Interval> {
        match (self, object) {
            (Part::Turn, Located::Joint { turn, .. }) => *turn,
            (Part::Travel, Located::Joint { travel, .. }) => *travel,
            (Part::Radius | Part::Value, object) => object.number(),
            _ => None,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum What {
    Distance,
    Angle,
    Turn,
    Torsion,
    Coordinate(usize),
    Area,
    /// A number of an object.
    Number(Part, usize),
}

/// The forms, for messages.
const FORMS: &str = "`A-B`, `angle A B C`, `turn A B C`, `torsion A B C D`, `x A`, `y A`, `z A` or `area A B C ...`, with points of the problem, or of objects `turn J`, `travel J`, `radius C` or `value x`";

impl Quantity {
    /// Whether another one is the same length, angle, turn or torsion, whatever both are called.
    pub fn is_same_measure(&self, other: &Quantity) -> bool {
        let is_either_way = matches!(self.what, What::Distance | What::Angle | What::Torsion);
        let turned = self.points.iter().rev();
        self.what == other.what
            && (self.points == other.points || is_either_way && turned.eq(&other.points))
    }

    /// The length between two points.
    pub fn length(problem: &Problem, points: [usize; 2]) -> Self {
        Quantity {
            name: points.each(|p| problem.points[p].name.as_str()).join("-"),
            what: What::Distance,
            points: points.to_vec(),
        }
    }

    /// The two points between which it is the length, if it is one.
    pub fn ends(&self) -> Option<[usize; 2]> {
        match (self.what, &self.points[..]) {
            (What::Distance, &[a, b]) => Some([a, b]),
            _ => None,
        }
    }

    /// From a text such as `A-B` and `angle A B C`, or with a name of its own, as `gap = A-B`.
    ///
    /// # Errors
    /// That it is none, and why.
    pub fn parse(problem: &Problem, text: &str) -> Result<Self, String> {
        let text = text.trim();
        // Names of points may have anything in them.
        Self::unnamed(problem, text).or_else(|why| {
            let (name, text) = text.split_once('=').ok_or(why)?;
            Ok(Quantity {
                name: name.trim().to_owned(),
                ..Self::unnamed(problem, text.trim())?
            })
        })
    }

    fn unnamed(problem: &Problem, text: &str) -> Result<Self, String> {
        // Names of points may be anything.
        let why = match Self::of_points(problem, text) {
            Ok(quantity) => return Ok(quantity),
            Err(why) => why,
        };
        let named = text.split_once(char::is_whitespace);
        let Some((part, what, name)) = named.and_then(|(word, name)| {
            let (part, what) = Part::named(word)?;
            Some((part, what, name.trim()))
        }) else {
            return Err(why);
        };
        let mut objects = problem.objects.iter();
        match objects.position(|o| o.name == name && part.is_of(&o.shape)) {
            Some(object) => Ok(Quantity {
                name: text.to_owned(),
                what: What::Number(part, object),
                points: Vec::new(),
            }),
            // `turn A B C` is of points.
            None if part == Part::Turn && name.contains(char::is_whitespace) => Err(why),
            None => Err(format!("--measure \"{text}\": there is no {what} `{name}`")),
        }
    }

    fn of_points(problem: &Problem, text: &str) -> Result<Self, String> {
        let point = |name: &str| problem.points.iter().position(|p| p.name == name);
        let fail = |why: String| Err(format!("--measure \"{text}\": {why}"));
        let named = |what, points| {
            let name = text.to_owned();
            Ok(Quantity { name, what, points })
        };
        // Names may have a minus in them.
        let pairs = text
            .match_indices('-')
            .map(|(at, _)| (&text[..at], &text[at + 1..]));
        let pairs = pairs.filter_map(|(a, b)| Some(vec![point(a)?, point(b)?]));
        let pairs: Vec<Vec<usize>> = pairs.collect();
        if let [pair] = &pairs[..]
            && pair[0] != pair[1]
        {
            return named(What::Distance, pair.clone());
        }
        let mut words = text.split_whitespace();
        let (what, wanted) = match words.next() {
            Some("angle") => (What::Angle, 3),
            Some("turn") if problem.dimension == 2 => (What::Turn, 3),
            Some("torsion") if problem.dimension == 3 => (What::Torsion, 4),
            Some("x") => (What::Coordinate(0), 1),
            Some("y") => (What::Coordinate(1), 1),
            Some("z") if problem.dimension == 3 => (What::Coordinate(2), 1),
            Some("area") if problem.dimension == 2 => (What::Area, 0),
            Some("turn" | "area") => return fail("is for figures in the plane".to_owned()),
            Some("torsion" | "z") => return fail("is for figures in space".to_owned()),
            _ => return fail(format!("write {FORMS}")),
        };
        let mut points = Vec::new();
        for name in words {
            match point(name) {
                Some(p) => points.push(p),
                None => return fail(format!("there is no point `{name}`")),
            }
        }
        let is_twice = |(k, p): (usize, &usize)| points[..k].contains(p);
        if what != What::Area && points.iter().enumerate().any(is_twice) {
            return fail("a point is named twice".to_owned());
        }
        match (what, points.len()) {
            (What::Area, 0..3) => fail("an outline has three points at least".to_owned()),
            (What::Area, _) => named(what, points),
            (_, count) if count == wanted => named(what, points),
            (_, count) => fail(format!("takes {wanted} points, and there are {count}")),
        }
    }

    /// An enclosure, in the unit of the problem, its square, or degrees; of an object that is nowhere told of anything.
    pub fn of(&self, points: &[[Interval; 3]], objects: &[Located]) -> Interval {
        if let What::Number(part, object) = self.what {
            let number = objects.get(object).and_then(|object| part.of(object));
            return number.unwrap_or(Interval::ENTIRE);
        }
        let unknown = |_: usize| unreachable!("it is of points");
        match self.found(&Seen {
            point: |p: usize| points[p],
            numbers: unknown,
        }) {
            Found::Number(x) => x,
            Found::Direction(x, y) => direction(x, y),
        }
    }

    /// A number that grows with the quantity and takes no time to speak of: of angles that have a sense of turn one that grows by
    /// [`WHOLE_TURN`] over a whole turn, the one nearest to `near` of all that differ by whole turns. [`Quantity::of_key`] says of what it is.
    pub fn key<T: Quantifiable>(
        &self,
        seen: &Seen<impl Fn(usize) -> [T; 3], impl Fn(usize) -> Numbers<T>>,
        near: f64,
    ) -> Interval {
        self.whole(self.found(seen), near).0
    }

    /// The key along a stretch of a curve, of which the second number is the parameter as seen from the middle: of things as `around` has
    /// them there, with a slope each, and as `middle` has them in the middle.
    pub fn key_along(
        &self,
        (around, along): (
            &Seen<impl Fn(usize) -> [Along; 3], impl Fn(usize) -> Numbers<Along>>,
            Interval,
        ),
        middle: &Seen<impl Fn(usize) -> [Interval; 3], impl Fn(usize) -> Numbers<Interval>>,
        near: f64,
    ) -> Interval {
        let (key, slope) = self.whole(self.found(around), near);
        let by_slope = self.key(middle, key.mid()) + slope * along;
        key.intersection(by_slope)
    }

    /// The derivative of the key, of things that move with slopes.
    pub fn slope_of_key(
        &self,
        seen: &Seen<impl Fn(usize) -> [Along; 3], impl Fn(usize) -> Numbers<Along>>,
        near: f64,
    ) -> Interval {
        self.whole(self.found(seen), near).1
    }

    /// The object that it is a number of, if it is one.
    pub fn object(&self) -> Option<usize> {
        match self.what {
            What::Number(_, object) => Some(object),
            _ => None,
        }
    }

    /// The points that it is measured of.
    pub fn points(&self) -> &[usize] {
        &self.points
    }

    /// The key and its slope.
    fn whole<T: Quantifiable>(&self, found: Found<T>, near: f64) -> (Interval, Interval) {
        match (found, self.what) {
            (Found::Number(x), _) => (x.value(), x.slope()),
            (Found::Direction(x, y), What::Angle) => {
                let (key, slope) = quarters(x, y);
                (key.intersection(hull(0.0, 2.0)), slope)
            }
            (Found::Direction(x, y), _) => {
                let (key, slope) = quarters(x, y);
                let turns = ((near - key.mid()) / WHOLE_TURN).round();
                (key + point(turns * WHOLE_TURN), slope)
            }
        }
    }

    /// The quantity with this key.
    pub fn of_key(&self, key: Interval) -> Interval {
        // What has no sign is 0 at least, and an angle without a sense 180 degrees at most, whatever bounds its key.
        let most = if self.what == What::Angle {
            2.0
        } else {
            f64::INFINITY
        };
        let key = match self.what {
            What::Angle | What::Distance | What::Area | What::Number(Part::Radius, _) => {
                hull(key.inf().clamp(0.0, most), key.sup().clamp(0.0, most))
            }
            What::Turn | What::Torsion | What::Coordinate(_) | What::Number(..) => key,
        };
        if !self.is_in_degrees() {
            return key;
        }
        let [low, high] = [key.inf(), key.sup()].each(degrees);
        low.convex_hull(high)
    }

    /// Whether it is an angle with a sense of turn, which grows from turn to turn.
    pub fn is_direction(&self) -> bool {
        matches!(
            self.what,
            What::Turn | What::Torsion | What::Number(Part::Turn, _)
        )
    }

    /// Whether it is an angle.
    pub fn is_in_degrees(&self) -> bool {
        self.unit() == "degrees"
    }

    /// What it is measured in: `degrees`, `length`, `area`, or `number` of an unknown.
    pub fn unit(&self) -> &'static str {
        match self.what {
            What::Angle | What::Turn | What::Torsion | What::Number(Part::Turn, _) => "degrees",
            What::Distance | What::Coordinate(_) => "length",
            What::Number(Part::Radius | Part::Travel, _) => "length",
            What::Number(Part::Value, _) => "number",
            What::Area => "area",
        }
    }

    /// Whether it is the same wherever the figure stands as a whole.
    pub fn is_invariant(&self) -> bool {
        !matches!(self.what, What::Coordinate(_))
    }

    fn found<T: Quantifiable>(
        &self,
        seen: &Seen<impl Fn(usize) -> [T; 3], impl Fn(usize) -> Numbers<T>>,
    ) -> Found<T> {
        let at = |k: usize| (seen.point)(self.points[k]);
        let between = |a: usize, b: usize| minus(at(b), at(a));
        let size = |v: [T; 3]| T::length(v);
        Found::Number(match self.what {
            What::Distance => size(between(0, 1)),
            What::Angle => {
                let (u, v) = (between(1, 0), between(1, 2));
                return Found::Direction(dot(u, v), size(cross(u, v)));
            }
            What::Turn => {
                let (u, v) = (between(1, 0), between(1, 2));
                return Found::Direction(dot(u, v), cross(u, v)[2]);
            }
            What::Torsion => {
                let [u, v, w] = [between(0, 1), between(1, 2), between(2, 3)];
                let across = cross(v, w);
                return Found::Direction(dot(cross(u, v), across), size(v) * dot(u, across));
            }
            What::Coordinate(axis) => at(0)[axis],
            What::Area => {
                let rest = 1..self.points.len() - 1;
                let twice = rest.fold(T::constant(0.0), |sum, k| {
                    sum + cross(between(0, k), between(0, k + 1))[2]
                });
                twice.abs() * T::constant(0.5)
            }
            What::Number(part, object) => {
                let of = (seen.numbers)(object);
                let number = match (part, of.turn) {
                    (Part::Turn, Some([x, y])) => return Found::Direction(x, y),
                    (Part::Travel, _) => of.travel,
                    _ => of.number,
                };
                // What is nowhere told may be anything.
                number.unwrap_or(T::fixed(Interval::ENTIRE))
            }
        })
    }
}

enum Found<T> {
    Number(T),
    /// A vector in the direction of the angle.
    Direction(T, T),
}

/// A whole turn in [`Quantity::key`]s.
pub const WHOLE_TURN: f64 = 4.0;

/// A number from −2 to 2 that grows with the direction of a vector, by 1 for each quarter of a turn: where the ray meets the square
/// |x| + |y| = 1; and its slope, (x y' − y x') / (|x| + |y|)² in each quarter. It may go a little beyond near the negative x axis.
fn quarters<T: Quantifiable>(x: T, y: T) -> (Interval, Interval) {
    let (a, b) = (x.value(), y.value());
    let slope = (a * y.slope() - b * x.slope()) * (point(1.0) / (a.abs() + b.abs())).sqr();
    let key = if a.inf() > 0.0 {
        quarter(a, b)
    } else if b.inf() > 0.0 {
        point(1.0) + quarter(b, -a)
    } else if b.sup() < 0.0 {
        quarter(-b, a) - point(1.0)
    } else if a.sup() < 0.0 {
        point(2.0) + quarter(-a, -b)
    } else {
        return (hull(-2.0, 2.0), Interval::ENTIRE);
    };
    (key, slope)
}

/// y / (x + |y|) where x > 0, as sharp as can be: it grows with y, and with x towards 0.
fn quarter(x: Interval, y: Interval) -> Interval {
    let at = |x: f64, y: f64| {
        let (x, y) = (point(x), point(y));
        y / (x + y.abs())
    };
    let near = |y: f64| if y < 0.0 { x.inf() } else { x.sup() };
    let far = |y: f64| if y < 0.0 { x.sup() } else { x.inf() };
    at(near(y.inf()), y.inf()).convex_hull(at(far(y.sup()), y.sup()))
}

/// The angle in degrees with this number of quarters, as in [`quarters`].
fn degrees(quarters: f64) -> Interval {
    // So that the rest is more than −2, and at most 2: straight on is 180 degrees.
    let turns = (quarters / WHOLE_TURN - 0.5).ceil();
    // Both exact: turns are few, and the rest is no greater than half of one.
    let [whole, rest] = [turns * 360.0, quarters - turns * WHOLE_TURN].each(point);
    let (x, y) = match rest.mid() {
        q if q > 1.0 => (point(1.0) - rest, point(2.0) - rest),
        q if q < -1.0 => (point(1.0) + rest, -rest - point(2.0)),
        _ => (point(1.0) - rest.abs(), rest),
    };
    whole + direction(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_grow_with_the_direction() {
        let mut before = -2.0;
        for k in -179..=180 {
            let angle = f64::from(k).to_radians();
            let (found, _) = quarters(point(angle.cos() * 3.0), point(angle.sin() * 3.0));
            assert!(
                found.wid() < 1e-14 && found.mid() > before,
                "{k}: {found:?}"
            );
            before = found.mid();
            let back = degrees(found.mid() + 8.0);
            assert!(
                (back.mid() - f64::from(k) - 720.0).abs() < 1e-11,
                "{k}: {back:?}"
            );
            // A box around it.
            let around = |x: f64| hull(x - 1e-3, x + 1e-3);
            let (wide, _) = quarters(around(angle.cos()), around(angle.sin()));
            assert!(
                wide.wid() < 0.01 && (wide.contains(found.mid()) || k == 180),
                "{k}: {wide:?}"
            );
        }
        for (quarters, angle) in [
            (2.0, 180.0),
            (-2.0, -180.0),
            (6.0, 540.0),
            (-6.0, -540.0),
            (0.0, 0.0),
            (1.0, 90.0),
        ] {
            assert!(
                degrees(quarters).contains(angle) && degrees(quarters).wid() < 1e-11,
                "{quarters}"
            );
        }
    }

    /// Wide boxes too: no wider than half a turn where they leave out half a plane, whatever their shape.
    #[test]
    fn quarters_of_wide_boxes_are_sharp() {
        for (x, y) in [
            (hull(1.0, 1.0), hull(9.0, 58.0)),
            (hull(1e-6, 3.0), hull(-50.0, 70.0)),
            (hull(-70.0, 3.0), hull(1e-3, 5.0)),
            (hull(-4.0, 9.0), hull(-7.0, -0.1)),
        ] {
            let (key, _) = quarters(x, y);
            assert!(key.wid() <= 2.0 + 1e-12, "{key:?}");
            let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
            for i in 0..=20 {
                for j in 0..=20 {
                    let at = |x: Interval, k: i32| {
                        point(x.inf() + (x.sup() - x.inf()) * f64::from(k) / 20.0)
                    };
                    let (one, _) = quarters(at(x, i), at(y, j));
                    ends = (ends.0.min(one.mid()), ends.1.max(one.mid()));
                }
            }
            assert!(
                (key.inf() - ends.0).abs() < 1e-12 && (key.sup() - ends.1).abs() < 1e-12,
                "{key:?} {ends:?}"
            );
        }
    }

    /// What is turned by less than half a turn is never taken for the other way round.
    #[test]
    fn wide_boxes_are_unwrapped_from_where_they_begin() {
        let text = "dimension = 2\n[points]\na = [1, 0]\nb = [0, 0]\nc = [1, 9]\n[constraints]\ndistances = [[\"a\", \"b\", 1]]\n";
        let problem = Problem::parse_loosely(text, "t.toml").unwrap();
        let turn = Quantity::parse(&problem, "turn a b c").unwrap();
        let at = |y: Interval| Seen {
            point: move |p: usize| {
                [
                    [point(1.0), point(0.0), point(0.0)],
                    [point(0.0); 3],
                    [point(1.0), y, point(0.0)],
                ][p]
            },
            numbers: |_: usize| -> Numbers<Interval> { unreachable!("it is of points") },
        };
        let key = turn.key(&at(hull(9.0, 58.0)), 0.9);
        assert!(key.inf() > 0.85 && key.sup() < 1.0, "{key:?}");
        let key = turn.key(&at(hull(9.0, 58.0)), 4.9);
        assert!(key.inf() > 4.85 && key.sup() < 5.0, "{key:?}");
    }
}
