//! The senses that constraints leave open: which way angles turn, whether directions agree, on which side points are.
//!
//! A sense is the sign of a polynomial in coordinates. It is taken of the sketch where that is certain and not zero, and
//! compared in figures: in intervals, and in exact ratios where these do not tell and all numbers are such.
//!
//! Senses that equations keep whatever the figure is, like the side of a line on which a point at a given distance from it
//! is, are not among them.

use crate::blocks::Whose;
use crate::blocks::cut::Cut;
use crate::blocks::number::Number;
use crate::constraint::{Arguments, Flat, LineName, Sort, Thing};
use crate::interval::{Interval, point};
use crate::order::each_once;
use crate::places::Each as _;
use crate::problem::Shape;
use crate::system::simplices;
use std::collections::BTreeMap;

/// With more senses than this none is looked at.
const MOST: usize = 5000;

/// The sketch has no sense where the sine of the angle (or what stands for it) is not certainly larger than this: programs
/// store what their solvers leave, and so points on one line are off it by some digits. It decides which senses
/// there are to compare, and nothing that is proved of figures.
const FLAT: f64 = 1e-5;

/// How a sense of a figure stands to that of the sketch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// It is proved to be the same.
    Same,
    /// It is proved to be the other one.
    Other,
    /// It is proved that the figure has none: the points are on one line, or in one plane, say.
    Flat,
    /// The boxes of the figure do not tell.
    Undecided,
}

/// A sense that the sketch has and that constraints leave open.
#[derive(Debug)]
pub struct Sense {
    /// What people call the constraint whose sense it is, or the points: `a, b, c`.
    pub name: String,
    quantity: Quantity,
    sign: i8,
    /// The unknowns on which it depends.
    pub(super) unknowns: Vec<usize>,
}

/// A vector.
#[derive(Debug, Clone, Copy)]
enum Arrow {
    /// From one point to another.
    Between(usize, usize),
    /// From the origin to a point.
    To(usize),
    /// Along an axis.
    Axis(usize),
}

/// A polynomial whose sign is a sense.
#[derive(Debug)]
enum Quantity {
    /// The cross product of two vectors in the plane: which way the second is turned from the first.
    Turn(Arrow, Arrow),
    /// The scalar product of two directions: whether they agree.
    Direction(Arrow, Arrow),
    /// The square of one radius less that of another one, of two objects: which circle touches the other from inside.
    Larger(usize, usize),
    /// Six times the volume of a tetrahedron.
    Volume([usize; 4]),
    /// That of a constraint on what no sense is told of, such as lines of their own: it is certain in no figure.
    Untold,
}

type Values<'a> = &'a dyn Fn(usize) -> Number;

impl Arrow {
    fn part(self, cut: &Cut, axis: usize, of: Values) -> Number {
        let d = cut.problem.dimension;
        let place = |p: usize| cut.system.coordinates[p * d + axis];
        match self {
            Arrow::Between(a, b) if place(a) == place(b) => Number::halves(0),
            Arrow::Between(a, b) => of(place(b)).minus(&of(place(a))),
            Arrow::To(p) => of(place(p)),
            Arrow::Axis(k) => Number::halves(if k == axis { 2 } else { 0 }),
        }
    }

    fn dot(self, other: Self, cut: &Cut, of: Values) -> Number {
        let products = (0..cut.problem.dimension)
            .map(|axis| self.part(cut, axis, of).times(&other.part(cut, axis, of)));
        products.fold(Number::halves(0), |sum, x| sum.plus(&x))
    }
}

impl Quantity {
    fn value(&self, cut: &Cut, of: Values) -> Number {
        match *self {
            Quantity::Turn(u, v) => turn(u, v, [0, 1], cut, of),
            Quantity::Direction(u, v) => u.dot(v, cut, of),
            Quantity::Larger(one, other) => {
                let [a, b] = [one, other].map(|object| squared_radius(cut, object, of));
                a.minus(&b)
            }
            Quantity::Untold => Number::within(Interval::ENTIRE),
            Quantity::Volume([p, a, b, c]) => {
                let [u, v, w] = [a, b, c].each(|q| Arrow::Between(p, q));
                (0..3).fold(Number::halves(0), |sum, axis| {
                    let minor = turn(v, w, [(axis + 1) % 3, (axis + 2) % 3], cut, of);
                    sum.plus(&u.part(cut, axis, of).times(&minor))
                })
            }
        }
    }

    /// The sign, if it is certain and the quantity not [`FLAT`] beside the lengths in it.
    fn clear_sign(&self, cut: &Cut, of: Values) -> Option<i8> {
        if let Quantity::Untold = self {
            return Some(1);
        }
        let near = |u: usize| Number::within(of(u).enclosure());
        let squared = |arrow: Arrow| arrow.dot(arrow, cut, &near).enclosure();
        let size = match *self {
            Quantity::Turn(u, v) | Quantity::Direction(u, v) => (squared(u) * squared(v)).sqrt(),
            Quantity::Larger(one, other) => [one, other]
                .each(|object| squared_radius(cut, object, &near).enclosure())
                .into_iter()
                .fold(point(0.0), |sum, x| sum + x),
            Quantity::Volume([p, a, b, c]) => [a, b, c]
                .each(|q| squared(Arrow::Between(p, q)))
                .into_iter()
                .fold(point(1.0), |product, x| product * x)
                .sqrt(),
            Quantity::Untold => point(1.0),
        };
        let value = self.value(cut, &near).enclosure();
        let is_clear = value.mig() > (point(FLAT) * size).sup();
        is_clear.then_some(if value.inf() > 0.0 { 1 } else { -1 })
    }

    fn unknowns(&self, cut: &Cut) -> Vec<usize> {
        let d = cut.problem.dimension;
        let of_point = |p: usize| cut.system.coordinates[p * d..(p + 1) * d].iter().copied();
        let of_arrow = |arrow: Arrow| match arrow {
            Arrow::Between(a, b) => of_point(a).chain(of_point(b)).collect(),
            Arrow::To(p) => of_point(p).collect(),
            Arrow::Axis(_) => Vec::new(),
        };
        each_once(match *self {
            Quantity::Turn(u, v) | Quantity::Direction(u, v) => [of_arrow(u), of_arrow(v)].concat(),
            Quantity::Larger(one, other) => [one, other]
                .into_iter()
                .flat_map(|object| match cut.problem.objects[object].shape {
                    Shape::Arc { center, start, .. } => of_arrow(Arrow::Between(center, start)),
                    _ => cut.numbers[object].into_iter().collect(),
                })
                .collect(),
            Quantity::Volume(points) => points.into_iter().flat_map(of_point).collect(),
            Quantity::Untold => Vec::new(),
        })
    }
}

fn turn(u: Arrow, v: Arrow, [i, j]: [usize; 2], cut: &Cut, of: Values) -> Number {
    let one = u.part(cut, i, of).times(&v.part(cut, j, of));
    let other = u.part(cut, j, of).times(&v.part(cut, i, of));
    one.minus(&other)
}

fn squared_radius(cut: &Cut, object: usize, of: Values) -> Number {
    match (&cut.problem.objects[object].shape, cut.numbers[object]) {
        (Shape::Arc { center, start, .. }, _) => {
            let across = Arrow::Between(*center, *start);
            across.dot(across, cut, of)
        }
        (_, Some(u)) => of(u).times(&of(u)),
        // Nothing is known of it.
        _ => Number::within(Interval::ENTIRE),
    }
}

impl Sense {
    /// How the sense of a figure stands to that of the sketch.
    pub(super) fn compare(&self, cut: &Cut, values: &[Option<Number>]) -> Comparison {
        let now = |u: usize| values[u].clone().expect("a figure has all numbers");
        let near = |u: usize| Number::within(now(u).enclosure());
        let sign = match self.quantity.value(cut, &near).sign() {
            Some(sign) if sign != 0 => Some(sign),
            _ => self.quantity.value(cut, &now).sign(),
        };
        match sign {
            None => Comparison::Undecided,
            Some(0) => Comparison::Flat,
            Some(sign) if sign == self.sign => Comparison::Same,
            Some(_) => Comparison::Other,
        }
    }
}

/// The senses of a sketch; `None` where there are too many to look at.
pub(super) fn senses(cut: &Cut) -> Option<Vec<Sense>> {
    let problem = &cut.problem;
    let sketch = |u: usize| Number::of(cut.drawn_at(u));
    let mut found: Vec<(String, Quantity)> = Vec::new();
    for (c, constraint) in problem.constraints.iter().enumerate() {
        let items = Arguments::new(problem, &constraint.items);
        let quantities = of_constraint(cut, &constraint.kind, items);
        let quantities = quantities.unwrap_or_else(|| vec![Quantity::Untold]);
        let called = || Whose::Constraint(c).name(problem);
        found.extend(quantities.into_iter().map(|quantity| (called(), quantity)));
    }
    // Points in one place are one: the first of them stands for all.
    let d = problem.dimension;
    let mut first = BTreeMap::new();
    let at = |p: usize| &cut.system.coordinates[p * d..(p + 1) * d];
    let one: Vec<usize> = (0..problem.points.len())
        .map(|p| *first.entry(at(p)).or_insert(p))
        .collect();
    let pairs = problem.distances.iter().map(|d| d.points.each(|p| one[p]));
    let pairs: Vec<[usize; 2]> = pairs.filter(|[a, b]| a != b).collect();
    for set in simplices(problem.dimension, problem.points.len(), &pairs) {
        let names: Vec<&str> = set.iter().map(|&p| &*problem.points[p].name).collect();
        let quantity = match set[..] {
            [a, b, c] => Quantity::Turn(Arrow::Between(a, b), Arrow::Between(a, c)),
            [a, b, c, d] => Quantity::Volume([a, b, c, d]),
            _ => continue,
        };
        found.push((names.join(", "), quantity));
    }
    if found.len() > MOST {
        return None;
    }
    let with_sign = found.into_iter().filter_map(|(name, quantity)| {
        Some(Sense {
            sign: quantity.clear_sign(cut, &sketch)?,
            unknowns: quantity.unknowns(cut),
            name,
            quantity,
        })
    });
    Some(with_sign.collect())
}

/// What a constraint leaves open. `None`: it names what no sense is told of, as lines of their own.
fn of_constraint(cut: &Cut, kind: &str, mut items: Arguments) -> Option<Vec<Quantity>> {
    let flat = cut.problem.dimension == 2;
    let legs = |items: &mut Arguments| -> Option<[Arrow; 2]> {
        let (a, b, c) = (
            items.point().ok()?,
            items.point().ok()?,
            items.point().ok()?,
        );
        Some([Arrow::Between(b, a), Arrow::Between(b, c)])
    };
    let both = |items: &mut Arguments| Some([line(items)?, line(items)?]);
    let turn = |items: &mut Arguments, at_point: bool| {
        let [u, v] = match at_point {
            true => legs(items)?,
            false => both(items)?,
        };
        Some(Quantity::Turn(u, v))
    };
    let is_points = |items: &Arguments, n: usize| items.left() == n && items.points_ahead() == n;
    Some(match kind {
        "angles" | "perpendicular" if flat => {
            let at_point = kind == "angles" && is_points(&items, 3);
            vec![turn(&mut items, at_point)?]
        }
        "equal_angles" if flat => {
            let at_points = is_points(&items, 6);
            vec![turn(&mut items, at_points)?, turn(&mut items, at_points)?]
        }
        "parallel" => {
            let is_line = |sort: Sort| matches!(sort, Sort::Line | Sort::Axis);
            // In space points may be those of planes.
            if !flat && !is_line(items.next()) {
                return None;
            }
            let [u, v] = both(&mut items)?;
            vec![Quantity::Direction(u, v)]
        }
        "distances" => {
            use Thing::Flat as Lies;
            match items.clone().two_things().ok()? {
                // Parallel lines and planes.
                [Lies(Flat::Line(_)), Lies(Flat::Line(_))] if flat => {
                    let [u, v] = both(&mut items)?;
                    vec![Quantity::Direction(u, v)]
                }
                [Lies(Flat::Plane(_)), Lies(Flat::Plane(_))] => return None,
                _ => Vec::new(),
            }
        }
        "equal_distances" if flat => {
            // The second point is then on its side too.
            let p = items.point().ok()?;
            vec![side(&mut items, p)?]
        }
        "tangent" => match (items.next(), items.left()) {
            (Sort::Round, 2) => {
                let one = items.round().ok()?;
                match items.next() {
                    Sort::Round => both_round(cut, one, items.round().ok()?),
                    _ if flat => vec![side(&mut items, center(cut, one)?)?],
                    _ => return None,
                }
            }
            (Sort::Round, _) if flat => {
                let one = items.round().ok()?;
                vec![side(&mut items, center(cut, one)?)?]
            }
            (Sort::Line | Sort::Point, _) if flat => {
                let mut rest = items.clone();
                rest.line().ok()?;
                let center = center(cut, rest.round().ok()?)?;
                vec![side(&mut items, center)?]
            }
            _ => return None,
        },
        _ => Vec::new(),
    })
}

fn line(items: &mut Arguments) -> Option<Arrow> {
    match items.line().ok()? {
        LineName::Points([a, b]) => Some(Arrow::Between(a, b)),
        LineName::Axis(k) => Some(Arrow::Axis(k)),
        LineName::Free(_) => None,
    }
}

/// On which side of a line, which comes next, a point is.
fn side(items: &mut Arguments, point: usize) -> Option<Quantity> {
    let along = line(items)?;
    let across = match along {
        Arrow::Between(a, _) => Arrow::Between(a, point),
        Arrow::To(_) | Arrow::Axis(_) => Arrow::To(point),
    };
    Some(Quantity::Turn(along, across))
}

fn center(cut: &Cut, object: usize) -> Option<usize> {
    match cut.problem.objects[object].shape {
        Shape::Round { center, .. } | Shape::Arc { center, .. } => Some(center),
        _ => None,
    }
}

/// Of arcs that touch at an end of both: whether from inside. From inside: which is the larger one.
fn both_round(cut: &Cut, one: usize, other: usize) -> Vec<Quantity> {
    let d = cut.problem.dimension;
    let place = |p: usize| &cut.system.coordinates[p * d..(p + 1) * d];
    let ends = |object: usize| match cut.problem.objects[object].shape {
        Shape::Arc { start, end, .. } => vec![start, end],
        _ => Vec::new(),
    };
    let mut out = vec![Quantity::Larger(one, other)];
    let (mine, theirs) = (ends(one), ends(other));
    let mut shared = mine
        .iter()
        .filter(|&&a| theirs.iter().any(|&b| place(a) == place(b)));
    if let (Some(&end), Some(c), Some(k)) = (shared.next(), center(cut, one), center(cut, other)) {
        let (u, v) = (Arrow::Between(c, end), Arrow::Between(k, end));
        out.push(Quantity::Direction(u, v));
    }
    let sketch = |u: usize| Number::of(cut.drawn_at(u));
    let is_outside = center(cut, one)
        .zip(center(cut, other))
        .is_some_and(|(c, k)| {
            let apart = Arrow::Between(c, k);
            let squares = [one, other].map(|object| squared_radius(cut, object, &sketch));
            let off = apart
                .dot(apart, cut, &sketch)
                .minus(&squares[0])
                .minus(&squares[1]);
            off.sign() == Some(1)
        });
    if is_outside {
        out.remove(0);
    }
    out
}
