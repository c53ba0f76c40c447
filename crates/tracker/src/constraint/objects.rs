//! Lines, planes, circles, spheres, arcs and rigid bodies: their unknowns, and the equations that they
//! bring along.

use super::arguments::{LineName, PlaneName};
use super::frame::{
    Vector, cross, cross_in_plane, dot, is_zero, length, minus, plus, times, vector, zero,
};
use super::lowering::{Arrow, Fault, Lowering, Parity, Place};
use super::polynomial::multiply;
use super::quadratic::{Entry, Form, Product, Role, value};
use crate::decimal::Decimal;
use crate::interval::Real;
use crate::places::{Each as _, array};
use crate::rational::Rational;
use crate::statement::Shape;

/// A line as equations see it.
#[derive(Debug, Clone)]
pub struct Line {
    /// A point on it.
    pub base: Place,
    /// Along it.
    pub along: Arrow,
}

/// A plane as equations see it.
#[derive(Debug, Clone)]
pub struct Plane {
    /// Its normal.
    pub normal: Arrow,
    level: Level,
}

#[derive(Debug, Clone)]
enum Level {
    /// It goes through a point.
    Through(Place),
    /// Its points have this product with the normal; and what that is in the sketch.
    Offset(Entry, Rational),
}

/// A circle, sphere or arc as equations see it.
#[derive(Debug, Clone)]
pub struct Round {
    /// Its centre.
    pub center: Place,
    /// Its radius.
    pub radius: Entry,
    /// The square of the radius in the sketch.
    pub squared: Rational,
}

impl Plane {
    /// The products of factor · |normal| · (the signed distance of a place from the plane).
    pub fn height(&self, low: &Lowering, factor: i32, of: &Place) -> Vec<Product> {
        match &self.level {
            Level::Through(base) => {
                low.dot(factor, &self.normal.forms, &low.between(base, of).forms)
            }
            Level::Offset(level, _) => {
                let mut products = low.dot(factor, &self.normal.forms, &of.entries.each(value));
                products.push(Product::new(-factor, value(*level), Form::One));
                products
            }
        }
    }

    /// What those are in the sketch, with factor 1.
    pub fn height_in_sketch(&self, low: &Lowering, of: &Place) -> Rational {
        match &self.level {
            Level::Through(base) => dot(&self.normal.at, &minus(&of.at, &base.at)),
            Level::Offset(_, level) => {
                dot(&self.normal.at, &minus(&of.at, &low.frame.origin)) - level
            }
        }
    }
}

/// The auxiliary unknown that is the radius of a circle or sphere, or the value of an unknown number; `own`: what the object has of its own
/// in [`super::Tail::objects`].
pub fn own_number(shape: &Shape, own: &[Entry]) -> Option<usize> {
    match (shape, own.first()) {
        (Shape::Round { .. } | Shape::Number { .. }, Some(&Entry::Unknown(unknown))) => {
            Some(unknown)
        }
        _ => None,
    }
}

impl Lowering<'_> {
    /// A line.
    pub fn line(&mut self, name: LineName) -> Result<Line, Fault> {
        Ok(match name {
            LineName::Points([a, b]) => Line {
                base: self.place(a),
                along: self.span(a, b)?,
            },
            LineName::Axis(axis) => Line {
                base: Place {
                    entries: [Entry::Zero; 3],
                    at: [zero(), zero(), zero()],
                },
                along: self.axis(axis),
            },
            LineName::Free(object) => {
                let entries = self.objects[&object].clone();
                let (at, direction) = self.free_line(object);
                let name = self.problem.objects[object].name.clone();
                let three = |from: usize| {
                    let entry = |k| entries.get(from + k).copied().unwrap_or(Entry::Zero);
                    array(|k| {
                        if k < self.dimension() {
                            entry(k)
                        } else {
                            Entry::Zero
                        }
                    })
                };
                Line {
                    base: Place {
                        entries: three(0),
                        at,
                    },
                    along: self.direction(three(self.dimension()), direction, name),
                }
            }
        })
    }

    /// The point of a line of its own that is nearest to the origin, and the direction, in the sketch.
    fn free_line(&self, object: usize) -> (Vector, Vector) {
        let Shape::FreeLine { point, direction } = &self.problem.objects[object].shape else {
            unreachable!("only lines of their own are asked for")
        };
        let (point, direction) = (vector(point), vector(direction));
        let from_origin = minus(&point, &self.frame.origin);
        let along = dot(&from_origin, &direction) / dot(&direction, &direction);
        (minus(&point, &times(&along, &direction)), direction)
    }

    /// A plane.
    pub fn plane(&mut self, name: PlaneName) -> Result<Plane, Fault> {
        Ok(match name {
            PlaneName::Points([a, b, c]) => {
                let (u, v) = (self.span(a, b)?, self.span(a, c)?);
                let name = format!(
                    "the normal of {}, {}, {}",
                    self.name(a),
                    self.name(b),
                    self.name(c)
                );
                Plane {
                    normal: self.cross(&u, &v, name),
                    level: Level::Through(self.place(a)),
                }
            }
            PlaneName::Free(object) => {
                let entries = self.objects[&object].clone();
                let Shape::FreePlane { point, normal } = &self.problem.objects[object].shape else {
                    unreachable!("only planes of their own are asked for")
                };
                let (point, normal) = (vector(point), vector(normal));
                let level = dot(&normal, &minus(&point, &self.frame.origin));
                let name = self.problem.objects[object].name.clone();
                Plane {
                    normal: self.direction([entries[0], entries[1], entries[2]], normal, name),
                    level: Level::Offset(entries[3], level),
                }
            }
        })
    }

    /// A plane of which the sketch says which way it lies.
    pub fn proper_plane(&mut self, name: PlaneName) -> Result<Plane, Fault> {
        let plane = self.plane(name)?;
        if is_zero(&plane.normal.at) {
            return Err(format!(
                "the three points of the plane are on one line in the sketch ({}): move one of them",
                plane.normal.name
            ));
        }
        Ok(plane)
    }

    /// A place in a plane: a point of it, or of a plane of its own the nearest one to the origin, f with `|n|² f = l n`, where
    /// l is the level, `n·f`.
    pub fn place_in(&mut self, plane: &Plane) -> Place {
        let (level, at) = match &plane.level {
            Level::Through(base) => return base.clone(),
            Level::Offset(level, at) => (*level, at.clone()),
        };
        let (normal, name) = (&plane.normal, format!("the foot of {}", plane.normal.name));
        let square = dot(&normal.at, &normal.at);
        let from_origin = times(&(at / &square), &normal.at);
        let at = plus(&self.frame.origin, &from_origin);
        let seen = std::array::from_fn(|k| self.frame.coordinate(&at, k));
        let entries = self.coordinates(&name, 1, false, seen);
        let what = format!("{name}, |n|²");
        let square = self.coefficient(&what, 0, Parity::Even, vec![square.into()]);
        for (entry, form) in entries.iter().zip(normal.forms) {
            let products = vec![
                Product::new(1, value(square), value(*entry)),
                Product::new(-1, value(level), form),
            ];
            self.equate(&name, products, vec![Real::zero()], 1);
        }
        Place { entries, at }
    }

    /// A circle, sphere or arc.
    pub fn round(&self, object: usize) -> Round {
        let squared = match &self.problem.objects[object].shape {
            Shape::Round { radius, .. } => radius.value() * radius.value(),
            Shape::Arc { center, start, .. } => {
                let across = minus(&self.place(*start).at, &self.place(*center).at);
                dot(&across, &across)
            }
            _ => unreachable!("only circles, spheres and arcs are asked for"),
        };
        Round {
            center: self.place(self.center(object)),
            radius: self.objects[&object][0],
            squared,
        }
    }

    /// The centre of a circle, sphere or arc.
    pub fn center(&self, object: usize) -> usize {
        let (Shape::Round { center, .. } | Shape::Arc { center, .. }) =
            &self.problem.objects[object].shape
        else {
            unreachable!("only circles, spheres and arcs are asked for")
        };
        *center
    }

    /// The unknowns of an object that has some of its own.
    pub fn unknowns_of(&self, object: usize) -> Vec<Entry> {
        self.objects[&object].clone()
    }

    /// Says that a place is on a circle, sphere or arc.
    pub fn on_round(&mut self, name: &str, place: &Place, round: &Round) {
        let across = self.between(&round.center, place);
        let mut products = self.dot(1, &across.forms, &across.forms);
        products.push(Product::new(-1, value(round.radius), value(round.radius)));
        let start = dot(&across.at, &across.at) - &round.squared;
        self.vanish(name, products, start.into(), 2);
    }

    /// The unknowns and equations of an object that stand whether or not a constraint is on it.
    pub(super) fn object(&mut self, object: usize) -> Result<(), Fault> {
        let name = self.problem.objects[object].name.clone();
        let entries = match &self.problem.objects[object].shape {
            Shape::Line([a, b]) => {
                self.span(*a, *b)?;
                return Ok(());
            }
            Shape::Plane(_) => return Ok(()),
            Shape::FreeLine { direction, .. } => {
                if is_zero(&vector(direction)) {
                    return Err("the direction is zero: give one".to_owned());
                }
                let (at, direction) = self.free_line(object);
                let seen = std::array::from_fn(|k| self.frame.coordinate(&at, k));
                let base = self.coordinates(&format!("the base of {name}"), 1, false, seen);
                let along = self.unit(&format!("the direction of {name}"), &direction);
                let products = self.dot(1, &base.each(value), &along.each(value));
                let what = format!("{name}: its base is its nearest point to the origin");
                self.equate(&what, products, vec![Real::zero()], 1);
                let d = self.dimension();
                [&base[..d], &along[..d]].concat()
            }
            Shape::FreePlane { point, normal } => {
                let (point, normal) = (vector(point), vector(normal));
                if is_zero(&normal) {
                    return Err("the normal is zero: give one".to_owned());
                }
                let mut entries = self
                    .unit(&format!("the normal of {name}"), &normal)
                    .to_vec();
                let level = dot(&normal, &minus(&point, &self.frame.origin));
                let what = format!("the level of {name}");
                entries.push(self.scalar(what, 1, Parity::Even, level.into()));
                entries
            }
            Shape::Round { radius, .. } => {
                if !radius.is_positive() {
                    return Err(format!(
                        "the radius is {radius}, but must be greater than zero"
                    ));
                }
                let at = Real::from(radius.value().clone());
                vec![self.radius(&name, at)]
            }
            Shape::Arc { center, start, end } => {
                let ends = [*start, *end];
                let across = self.span(*center, *start)?;
                self.span(*center, *end)?;
                let radius = self.radius(&name, length(&across.at));
                self.objects.insert(object, vec![radius]);
                let round = self.round(object);
                for end in ends {
                    let what = format!("{name}: {} is on it", self.name(end));
                    let place = self.place(end);
                    self.on_round(&what, &place, &round);
                }
                return Ok(());
            }
            Shape::Number { sketch, .. } => {
                let at = Real::from(sketch.value().clone());
                vec![self.scalar(name, 0, Parity::Even, at)]
            }
            Shape::Body { place: Some(_), .. } | Shape::Joint { .. } => {
                self.assembled()?;
                return Ok(());
            }
            Shape::Body { points, local, .. } => {
                let (points, local) = (points.clone(), local.clone());
                return self.body(&name, &points, &local);
            }
        };
        self.objects.insert(object, entries);
        Ok(())
    }

    /// A direction or normal of fixed length.
    fn unit(&mut self, name: &str, at: &Vector) -> [Entry; 3] {
        let seen = std::array::from_fn(|k| self.frame.component(at, k));
        let entries = self.coordinates(name, 0, false, seen);
        let forms = entries.each(value);
        let products = self.dot(1, &forms, &forms);
        let what = format!("{name} keeps its length");
        self.equate(&what, products, vec![dot(at, at).into()], 0);
        entries
    }

    fn radius(&mut self, name: &str, at: Real) -> Entry {
        let what = format!("the radius of {name}");
        self.unknown(what, Role::Positive, 1, [false; 3], at)
    }

    /// A rigid body: three of its points (two in the plane) have their distances, and all others are
    /// where they are relative to those, on the side where they are.
    fn body(&mut self, name: &str, points: &[usize], local: &[[Decimal; 3]]) -> Result<(), Fault> {
        let local: Vec<Vector> = local.iter().map(vector).collect();
        let at: Vec<Vector> = points.iter().map(|&p| self.place(p).at).collect();
        let base = base_of(self.dimension(), &local, &at)?;
        let ends: Vec<[usize; 2]> = match *base.as_slice() {
            [a, b] => vec![[a, b]],
            [a, b, c] => vec![[a, b], [a, c], [b, c]],
            _ => unreachable!("a base has two or three points"),
        };
        for [i, j] in ends {
            let span = self.between(&self.place(points[i]), &self.place(points[j]));
            let (now, then) = (length(&span.at), length(&minus(&local[j], &local[i])));
            let a = self.lead(now, then);
            let products = self.dot(1, &span.forms, &span.forms);
            let what = format!("{name}: {}-{}", self.name(points[i]), self.name(points[j]));
            self.equate(&what, products, multiply(&a, &a), 2);
        }
        let in_sketch = Coordinates::new(self.dimension(), &base, &at);
        let wanted = Coordinates::new(self.dimension(), &base, &local);
        let origin = self.place(points[base[0]]);
        let edges: Vec<Arrow> = base[1..]
            .iter()
            .map(|&k| self.between(&origin, &self.place(points[k])))
            .collect();
        let rest: Vec<usize> = (0..points.len()).filter(|k| !base.contains(k)).collect();
        for k in rest {
            let what = format!("{name}: {}", self.name(points[k]));
            let span = self.between(&origin, &self.place(points[k]));
            let (now, then) = (in_sketch.of(&at[k]), wanted.of(&local[k]));
            let mut products: Vec<Vec<Product>> = (0..self.dimension())
                .map(|axis| vec![Product::new(1, span.forms[axis], Form::One)])
                .collect();
            // The directions that coordinates are along: in the plane the edge and the same turned by a
            // right angle, in space two edges and their cross product.
            let mut along: Vec<([Form; 3], i32)> = Vec::new();
            if self.dimension() == 2 {
                along.push((edges[0].forms, 0));
                let [x, y, z] = edges[0].forms;
                along.push(([turned(y), x, z], 0));
            } else {
                along.extend(edges.iter().map(|edge| (edge.forms, 0)));
                if now[2] != zero() || then[2] != zero() {
                    let what = format!("{name}: the normal of its base");
                    along.push((self.cross(&edges[0], &edges[1], what).forms, -1));
                }
            }
            for (index, (forms, power)) in along.into_iter().enumerate() {
                let odd = index + 1 == self.dimension();
                if now[index] == zero() && then[index] == zero() {
                    continue;
                }
                let parity = if odd { Parity::Odd } else { Parity::Even };
                let path = self.lead(now[index].clone().into(), then[index].clone().into());
                let what = format!("{what}, coordinate {}", index + 1);
                let entry = self.coefficient(&what, power, parity, path);
                for (axis, products) in products.iter_mut().enumerate() {
                    products.push(Product::new(-1, value(entry), forms[axis]));
                }
            }
            for products in products {
                self.equate(&what, products, vec![Real::zero()], 1);
            }
        }
        Ok(())
    }
}

/// The difference the other way round.
pub(super) fn turned(form: Form) -> Form {
    match form {
        Form::Difference(a, b) => Form::Difference(b, a),
        Form::One => Form::One,
    }
}

/// Indices of the two (in the plane) or three points of a body that are far from coinciding and from
/// being on one line.
pub fn base_of(dimension: usize, local: &[Vector], sketch: &[Vector]) -> Result<Vec<usize>, Fault> {
    let square = |v: &Vector| dot(v, v);
    let far = (1..local.len())
        .filter(|&k| sketch[k] != sketch[0])
        .max_by_key(|&k| square(&minus(&local[k], &local[0])))
        .ok_or("its points coincide in the sketch: move them")?;
    let u = minus(&local[far], &local[0]);
    if is_zero(&u) {
        return Err("its points coincide in its own coordinates".to_owned());
    }
    if dimension == 2 {
        return Ok(vec![0, far]);
    }
    let drawn = minus(&sketch[far], &sketch[0]);
    let off = (1..local.len())
        .filter(|&k| !is_zero(&cross(&drawn, &minus(&sketch[k], &sketch[0]))))
        .max_by_key(|&k| square(&cross(&u, &minus(&local[k], &local[0]))))
        .ok_or("its points are on one line in the sketch: move one of them")?;
    if is_zero(&cross(&u, &minus(&local[off], &local[0]))) {
        return Err(
            "its points are on one line in its own coordinates: in space a body needs three that are not"
                .to_owned(),
        );
    }
    Ok(vec![0, far, off])
}

/// Coordinates relative to the base of a body.
struct Coordinates {
    origin: Vector,
    edges: Vec<Vector>,
}

impl Coordinates {
    fn new(dimension: usize, base: &[usize], places: &[Vector]) -> Self {
        let origin = places[base[0]].clone();
        let edge = |&k: &usize| minus(&places[k], &origin);
        let edges: Vec<Vector> = base[1..].iter().map(edge).collect();
        assert_eq!(edges.len(), dimension - 1);
        Coordinates { origin, edges }
    }

    /// In the plane along the edge and along the edge turned by a right angle; in space along both
    /// edges and their cross product.
    fn of(&self, place: &Vector) -> [Rational; 3] {
        let d = minus(place, &self.origin);
        match self.edges.as_slice() {
            [u] => {
                let square = dot(u, u);
                [
                    dot(u, &d) / &square,
                    cross_in_plane(u, &d) / &square,
                    zero(),
                ]
            }
            [u, v] => {
                let w = cross(u, v);
                let square = dot(&w, &w);
                [
                    dot(&cross(&d, v), &w) / &square,
                    dot(&cross(u, &d), &w) / &square,
                    dot(&d, &w) / &square,
                ]
            }
            _ => unreachable!("a base has one or two edges"),
        }
    }
}
