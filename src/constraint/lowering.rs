//! From constraints to equations: the unknowns and equations so far, and what kinds of constraints
//! build them with.

use super::frame::{Frame, Vector, cross, dot, length, minus, vector};
use super::polynomial::{Polynomial, multiply, ramp};
use super::quadratic::{
    Entry, Equation, Form, MAX_DEGREE, Product, Role, Tail, Unknown, coordinate, difference,
    product, value,
};
use crate::interval::Real;
use crate::problem::{Problem, Target};
use num_rational::BigRational;
use num_traits::Zero;
use std::collections::HashMap;

/// Why a constraint cannot be put to work: what is wrong, and what to do about it.
pub type Fault = String;

/// A point, or the base of a line of its own: what its coordinates are in equations, and where it is
/// in the sketch.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// x, y and z; zero beyond the dimension.
    pub entries: [Entry; 3],
    /// In the coordinates of the file.
    pub at: Vector,
}

/// A vector: the direction of a line, the normal of a plane, or from one point to another.
#[derive(Debug, Clone)]
pub struct Arrow {
    /// Its coordinates.
    pub forms: [Form; 3],
    /// In the sketch, in the coordinates of the file.
    pub at: Vector,
    /// The power of the unit of length that its coordinates have.
    pub power: i32,
    /// Whether a reflection turns it round beside reflecting it, as it does with a cross product.
    pub axial: bool,
    /// What people call it.
    pub name: String,
    /// Its length, where that is known as a polynomial.
    known: Option<Polynomial>,
}

/// How a number that stands for itself changes where an axis is reversed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parity {
    /// It stays.
    Even,
    /// It changes its sign, as a triple product does.
    Odd,
}

/// What [`Lowering::measure`] takes.
pub struct Measured<'b> {
    /// Products that are the number times the lengths of `arrows`.
    pub products: Vec<Product>,
    /// What they are in the sketch.
    pub now: BigRational,
    /// The number wanted.
    pub then: Real,
    /// The number's power of the unit of length: 1 for a distance, 0 for a cosine.
    pub power: i32,
    /// Whether the products change their sign under reflections.
    pub odd: bool,
    /// The vectors, at most two.
    pub arrows: Vec<&'b Arrow>,
}

/// Unknowns and equations, as they come to be.
pub struct Lowering<'a> {
    /// What they are made of.
    pub problem: &'a Problem,
    /// Where coordinates are counted from.
    pub frame: Frame,
    tail: Tail,
    /// The exact values of the unknowns in the sketch.
    values: Vec<Real>,
    /// For each equation whether its right-hand side is zero at t = 1.
    vanishing: Vec<bool>,
    /// What each equation is a part of: a count of objects, then constraints.
    owners: Vec<usize>,
    owner: usize,
    /// Where the path begins.
    from: Start<'a>,
    /// Whether left-hand sides must not depend on the values of dimensions.
    editable: bool,
    /// What dimensions were led to, and which senses were read off the sketch.
    record: Record,
    /// Index of the distance between two points, the lower first.
    distances: HashMap<[usize; 2], usize>,
    /// Lengths that are entries of equations already.
    lengths: HashMap<[Form; 3], Entry>,
    /// Cross products likewise.
    crosses: HashMap<[[Form; 3]; 2], Arrow>,
    /// Unknowns of objects, by index of the object.
    pub(super) objects: HashMap<usize, Vec<Entry>>,
}

/// Where a path begins, at t = 0.
#[derive(Debug, Clone, Copy)]
pub enum Start<'a> {
    /// At the sketch, which need not meet any constraint.
    Sketch,
    /// At a figure that meets all constraints, but has these distances.
    Distances(&'a [Target]),
    /// At a figure that meets all constraints with the dimensions of another lowering of the same problem, but for the
    /// values of dimensions.
    Dimensions(&'a Record),
}

/// What a lowering decided by values: dimensions in the order in which they were met, and senses read off the sketch.
#[derive(Debug, Clone, Default)]
pub struct Record {
    targets: Vec<Target>,
    leads: Vec<Real>,
    senses: Vec<bool>,
}

/// A finished lowering.
pub struct Lowered {
    /// What edits of it begin with.
    pub record: Record,
    /// The unknowns and equations.
    pub tail: Tail,
    /// The exact values of the unknowns in the sketch.
    pub values: Vec<Real>,
    /// For each equation the object, or the number of objects plus the constraint, that it comes from.
    /// Numbers beyond are the problem's own: places that krawl pins.
    pub owners: Vec<usize>,
    /// For each equation whether its right-hand side is zero at t = 1.
    pub vanishing: Vec<bool>,
    /// For each object its unknowns.
    pub object_unknowns: Vec<Vec<Entry>>,
}

impl<'a> Lowering<'a> {
    /// Nothing yet. With `editable`, the left-hand sides will be the same whatever the values of dimensions are.
    pub fn new(problem: &'a Problem, from: Start<'a>, editable: bool) -> Self {
        let pairs = problem.distances.iter().enumerate();
        Lowering {
            problem,
            from,
            editable,
            record: Record {
                targets: problem.distances.iter().map(|d| d.target.clone()).collect(),
                ..Record::default()
            },
            frame: Frame::new(problem),
            tail: Tail::default(),
            values: Vec::new(),
            vanishing: Vec::new(),
            owners: Vec::new(),
            owner: 0,
            distances: pairs
                .map(|(index, d)| {
                    let [a, b] = d.points;
                    ([a.min(b), a.max(b)], index)
                })
                .collect(),
            lengths: HashMap::new(),
            crosses: HashMap::new(),
            objects: HashMap::new(),
        }
    }

    /// From here on equations belong to this object or constraint.
    pub fn begin(&mut self, owner: usize) {
        self.owner = owner;
    }

    /// The result.
    pub fn finish(mut self) -> Lowered {
        self.tail.mirrors = !self.problem.is_absolute()
            && (0..self.problem.dimension).all(|axis| self.is_symmetric(axis));
        Lowered {
            record: self.record,
            tail: self.tail,
            values: self.values,
            owners: self.owners,
            vanishing: self.vanishing,
            object_unknowns: (0..self.problem.objects.len())
                .map(|object| self.objects.remove(&object).unwrap_or_default())
                .collect(),
        }
    }

    /// Whether what satisfies the equations at t = 1 still does with an axis reversed: every equation
    /// stays as it is, or changes its sign and has zero on the right.
    fn is_symmetric(&self, axis: usize) -> bool {
        let entry = |e: &Entry| match *e {
            Entry::Coordinate { axis: k, .. } => k == axis,
            Entry::Unknown(u) => self.tail.unknowns[u].flips[axis],
            Entry::Zero => false,
        };
        let form = |f: &Form| match f {
            Form::One => false,
            Form::Difference(Entry::Zero, e) | Form::Difference(e, _) => entry(e),
        };
        let mut equations = self.tail.equations.iter().zip(&self.vanishing);
        equations.all(|(equation, vanishing)| {
            let mut changes = equation
                .products
                .iter()
                .map(|p| form(&p.left) ^ form(&p.right));
            let first = changes.next().unwrap_or(false);
            changes.all(|change| change == first) && (!first || *vanishing)
        })
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.problem.dimension
    }

    /// The name of a point.
    pub fn name(&self, point: usize) -> &str {
        &self.problem.points[point].name
    }

    // Unknowns and equations.

    /// A new unknown, with its value in the sketch.
    pub fn unknown(
        &mut self,
        name: String,
        role: Role,
        power: i32,
        flips: [bool; 3],
        at: Real,
    ) -> Entry {
        self.tail.unknowns.push(Unknown {
            name,
            role,
            power,
            flips,
            sketch: at.enclose(),
        });
        self.values.push(at);
        Entry::Unknown(self.tail.unknowns.len() - 1)
    }

    /// A new unknown that is a number for itself.
    pub fn scalar(&mut self, name: String, power: i32, parity: Parity, at: Real) -> Entry {
        let flips = std::array::from_fn(|k| k < self.dimension() && parity == Parity::Odd);
        self.unknown(name, Role::Free, power, flips, at)
    }

    /// A new unknown for each coordinate of a vector: a place (`power` 1), a direction or a normal.
    pub fn coordinates(
        &mut self,
        name: &str,
        power: i32,
        axial: bool,
        at: [Real; 3],
    ) -> [Entry; 3] {
        let mut entries = [Entry::Zero; 3];
        for (axis, at) in at.into_iter().enumerate().take(self.dimension()) {
            let flips = std::array::from_fn(|k| k < self.dimension() && (k == axis) != axial);
            let name = format!("{name}, {}", ["x", "y", "z"][axis]);
            entries[axis] = self.unknown(name, Role::Free, power, flips, at);
        }
        entries
    }

    /// The equation Σ products = right, which is zero on the right at t = 1 if `vanishing`.
    fn push(
        &mut self,
        name: String,
        products: Vec<Product>,
        right: Polynomial,
        power: i32,
        vanishing: bool,
    ) {
        assert!(
            right.len() <= MAX_DEGREE + 1,
            "{name}: the degree is too high"
        );
        // Equations have ½ on the left.
        let products = products.into_iter().map(|p| Product {
            factor: 2 * p.factor,
            ..p
        });
        self.tail.equations.push(Equation {
            name,
            products: products.collect(),
            right,
            power,
        });
        self.vanishing.push(vanishing);
        self.owners.push(self.owner);
    }

    /// The equation Σ products = right.
    pub fn equate(&mut self, name: &str, products: Vec<Product>, right: Polynomial, power: i32) {
        let vanishing = right.iter().all(Real::is_zero);
        self.push(name.to_owned(), products, right, power, vanishing);
    }

    /// The equation Σ products = 0 that has to hold at t = 1, where Σ products is `start` in the
    /// sketch: led there linearly, or, where the sketch meets it, kept (see
    /// [`crate::problem::HomotopyChoices::detour`]).
    pub fn vanish(&mut self, name: &str, products: Vec<Product>, start: Real, power: i32) {
        let detour = self.problem.homotopy.detour.value();
        let right = if !matches!(self.from, Start::Sketch) {
            vec![Real::zero()]
        } else if !start.is_zero() {
            let back = -&start;
            vec![start, back]
        } else if detour.is_zero() {
            vec![Real::zero()]
        } else {
            let there = Real::from(detour.clone());
            vec![Real::zero(), there.clone(), -&there]
        };
        self.push(name.to_owned(), products, right, power, true);
    }

    /// The same for linear conditions, which hold all along the path where the sketch meets them: they
    /// are never singular.
    pub fn vanish_linear(&mut self, name: &str, products: Vec<Product>, start: Real, power: i32) {
        let right = if start.is_zero() || !matches!(self.from, Start::Sketch) {
            vec![Real::zero()]
        } else {
            let back = -&start;
            vec![start, back]
        };
        self.push(name.to_owned(), products, right, power, true);
    }

    /// A number's way from what it is in the sketch to what it is wanted to be; where the path begins at a figure
    /// that meets all constraints, from what it is there. The degree is the same for both, so that the equations are.
    pub fn lead(&mut self, now: Real, then: Real) -> Polynomial {
        let before = match self.from {
            Start::Sketch => None,
            Start::Distances(_) => Some(then.clone()),
            Start::Dimensions(record) => Some(record.leads[self.record.leads.len()].clone()),
        };
        self.record.leads.push(then.clone());
        match before {
            None => ramp(now, then),
            Some(before) if before == then => vec![then, Real::zero()],
            Some(before) => ramp(before, then),
        }
    }

    /// A sense that is read off the sketch and the value of a dimension: as `seen` there, and the same in edits of it.
    pub fn sense(&mut self, seen: bool) -> bool {
        let sense = match self.from {
            Start::Dimensions(record) => record.senses[self.record.senses.len()],
            _ => seen,
        };
        self.record.senses.push(sense);
        sense
    }

    /// Whether left-hand sides must not depend on the values of dimensions.
    pub fn is_editable(&self) -> bool {
        self.editable
    }

    /// The equation of a distance between two points, which otherwise is none of the tail's.
    pub fn distance(&mut self, index: usize) {
        let [a, b] = self.problem.distances[index].points;
        let span = self.between(&self.place(a), &self.place(b));
        let products = self.dot(1, &span.forms, &span.forms);
        let length = self.given_length(index);
        let name = self.problem.distance_name(index);
        self.equate(&name, products, multiply(&length, &length), 2);
    }

    /// A new unknown that is the polynomial `of`: a coefficient that varies, or is no whole number.
    pub fn coefficient(&mut self, name: &str, power: i32, parity: Parity, of: Polynomial) -> Entry {
        let entry = self.scalar(name.to_owned(), power, parity, of[0].clone());
        self.equate(name, vec![product(1, value(entry), Form::One)], of, power);
        entry
    }

    // Geometry.

    /// A point of the problem.
    pub fn place(&self, point: usize) -> Place {
        let entry = |axis: usize| {
            if axis < self.dimension() {
                coordinate(point, axis)
            } else {
                Entry::Zero
            }
        };
        Place {
            entries: std::array::from_fn(entry),
            at: vector(&self.problem.points[point].sketch),
        }
    }

    /// From one place to another.
    pub fn between(&self, from: &Place, to: &Place) -> Arrow {
        Arrow {
            forms: std::array::from_fn(|k| difference(to.entries[k], from.entries[k])),
            at: minus(&to.at, &from.at),
            power: 1,
            axial: false,
            name: String::new(),
            known: None,
        }
    }

    /// From one point to another, with its length where that is a dimension of the problem.
    pub fn span(&self, from: usize, to: usize) -> Result<Arrow, Fault> {
        let name = format!("{}-{}", self.name(from), self.name(to));
        let arrow = self.between(&self.place(from), &self.place(to));
        if super::frame::is_zero(&arrow.at) {
            return Err(format!(
                "the points {} coincide in the sketch: move one of them",
                name.replace('-', " and ")
            ));
        }
        Ok(Arrow {
            known: self
                .distances
                .get(&[from.min(to), from.max(to)])
                .map(|&index| self.given_length(index)),
            name,
            ..arrow
        })
    }

    /// A direction of which the length is fixed, made of unknowns.
    pub fn direction(&self, entries: [Entry; 3], at: Vector, name: String) -> Arrow {
        Arrow {
            forms: entries.map(value),
            known: Some(vec![length(&at)]),
            at,
            power: 0,
            axial: false,
            name,
        }
    }

    /// a(t) of a distance of the problem.
    fn given_length(&self, index: usize) -> Polynomial {
        let distance = &self.problem.distances[index];
        let [a, b] = distance
            .points
            .map(|p| vector(&self.problem.points[p].sketch));
        let target = |target: &Target| match target {
            Target::Length(x) => Real::from(x.value().clone()),
            Target::SquaredLength(x) => Real::from(x.value().clone()).sqrt(),
        };
        let end = target(&distance.target);
        let from = match self.from {
            Start::Sketch => None,
            Start::Distances(from) => Some(&from[index]),
            Start::Dimensions(record) => Some(&record.targets[index]),
        };
        let start = match from {
            Some(from) => target(from),
            None => length(&minus(&b, &a)),
        };
        if self.problem.bend() != Some(index) {
            return ramp(start, end);
        }
        let c = Real::from(self.problem.homotopy.bend_coefficient.value().clone());
        if c.is_zero() {
            return ramp(start, end);
        }
        let slope = &(&end - &start) + &c;
        vec![start, slope, -&c]
    }

    /// The length of a vector, as something that equations can hold.
    pub fn length(&mut self, of: &Arrow) -> Entry {
        if let Some(&entry) = self.lengths.get(&of.forms) {
            return entry;
        }
        let name = format!("the length of {}", of.name);
        let entry = match &of.known {
            Some(known) => self.coefficient(&name, of.power, Parity::Even, known.clone()),
            None => {
                let entry = self.unknown(
                    name.clone(),
                    Role::Positive,
                    of.power,
                    [false; 3],
                    length(&of.at),
                );
                let mut products = self.dot(1, &of.forms, &of.forms);
                products.push(product(-1, value(entry), value(entry)));
                self.equate(&name, products, vec![Real::zero()], 2 * of.power);
                entry
            }
        };
        self.lengths.insert(of.forms, entry);
        entry
    }

    /// The cross product of two vectors in space, as unknowns. Where the vectors are parallel in the
    /// sketch it is zero there.
    pub fn cross(&mut self, a: &Arrow, b: &Arrow, name: String) -> Arrow {
        if let Some(known) = self.crosses.get(&[a.forms, b.forms]) {
            return known.clone();
        }
        let (at, power, axial) = (cross(&a.at, &b.at), a.power + b.power, a.axial == b.axial);
        let seen = std::array::from_fn(|axis| self.frame.component(&at, axis));
        let entries = self.coordinates(&name, power, axial, seen);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let products = vec![
                product(1, value(entries[k]), Form::One),
                product(-1, a.forms[i], b.forms[j]),
                product(1, a.forms[j], b.forms[i]),
            ];
            self.equate(&name, products, vec![Real::zero()], power);
        }
        let arrow = Arrow {
            forms: entries.map(value),
            at,
            power,
            axial,
            name,
            known: None,
        };
        self.crosses.insert([a.forms, b.forms], arrow.clone());
        arrow
    }

    /// The products of factor · (a · b).
    pub fn dot(&self, factor: i32, a: &[Form; 3], b: &[Form; 3]) -> Vec<Product> {
        (0..self.dimension())
            .map(|k| product(factor, a[k], b[k]))
            .collect()
    }

    /// The products of factor · (a × b) in the plane.
    pub fn cross_in_plane(&self, factor: i32, a: &[Form; 3], b: &[Form; 3]) -> Vec<Product> {
        vec![product(factor, a[0], b[1]), product(-factor, a[1], b[0])]
    }

    /// Says that `products`, which are a number times the lengths of some vectors, are so with the number
    /// led linearly from what it is in the sketch to what it is wanted to be.
    pub fn measure(&mut self, name: &str, of: Measured) {
        let lengths = of
            .arrows
            .iter()
            .fold(Real::whole(1), |all, arrow| &all * &length(&arrow.at));
        let number = self.lead(&Real::from(of.now) / &lengths, of.then);
        // Known lengths go to the right-hand side where its degree allows, all others to the left.
        let (mut right, mut right_power, mut left) = (number, of.power, Vec::new());
        for arrow in &of.arrows {
            match &arrow.known {
                Some(known) if right.len() + known.len() - 1 <= MAX_DEGREE + 1 => {
                    right = multiply(&right, known);
                    right_power += arrow.power;
                }
                _ => left.push(*arrow),
            }
        }
        let power = right_power + left.iter().map(|arrow| arrow.power).sum::<i32>();
        let scale = match left.as_slice() {
            [] => {
                self.equate(name, of.products, right, power);
                return;
            }
            [arrow] => self.length(arrow),
            [a, b, ..] => {
                let entries = [self.length(a), self.length(b)].map(value);
                let at = &length(&a.at) * &length(&b.at);
                let both = format!("the lengths of {} and {}, multiplied", a.name, b.name);
                let (zero, power) = (vec![Real::zero()], a.power + b.power);
                let entry = self.scalar(both.clone(), power, Parity::Even, at);
                let definition = vec![
                    product(1, value(entry), Form::One),
                    product(-1, entries[0], entries[1]),
                ];
                self.equate(&both, definition, zero, power);
                entry
            }
        };
        let parity = if of.odd { Parity::Odd } else { Parity::Even };
        let number = format!("{name}, the value");
        let factor = self.coefficient(&number, right_power, parity, right);
        let mut products = of.products;
        products.push(product(-1, value(factor), value(scale)));
        self.equate(name, products, vec![Real::zero()], power);
    }

    /// Says that a coordinate of a point stays where the sketch has it.
    pub fn hold(&mut self, name: &str, point: usize, axis: usize) {
        let place = self.place(point);
        let products = vec![product(1, value(place.entries[axis]), Form::One)];
        let at = Real::from(place.at[axis].clone());
        self.equate(name, products, vec![at], 1);
    }

    /// Says that v = k u for some number k: u and v are parallel. In space, D equations and one unknown;
    /// in the plane, one equation.
    pub fn align(&mut self, name: &str, u: &Arrow, v: &Arrow) {
        let power = u.power + v.power;
        if self.dimension() == 2 {
            let products = self.cross_in_plane(1, &u.forms, &v.forms);
            let start = super::frame::cross_in_plane(&u.at, &v.at);
            self.vanish(name, products, start.into(), power);
            return;
        }
        // What is left is perpendicular to u.
        let k = dot(&u.at, &v.at) / dot(&u.at, &u.at);
        let left = minus(&v.at, &super::frame::times(&k, &u.at));
        let parity = if u.axial == v.axial {
            Parity::Even
        } else {
            Parity::Odd
        };
        let factor = self.scalar(
            format!("{name}, the factor"),
            v.power - u.power,
            parity,
            k.into(),
        );
        for axis in 0..3 {
            let products = vec![
                product(1, v.forms[axis], Form::One),
                product(-1, value(factor), u.forms[axis]),
            ];
            let start = self.frame.component(&left, axis);
            self.vanish_linear(name, products, start, v.power);
        }
    }
}
