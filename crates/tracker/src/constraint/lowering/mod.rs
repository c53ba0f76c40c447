//! From constraints to equations: the unknowns and equations so far, and what kinds of constraints
//! build them with.

mod assembly;
mod geometry;
mod heading;
mod number;
mod relations;
mod symmetry;
mod turn;

pub use assembly::Assembled;
pub use geometry::{Arrow, Place};
pub use number::{Number, Sum};
pub use relations::Measured;
pub use turn::MOST_TURN;

use super::frame::Frame;
use super::polynomial::{Polynomial, ramp};
use super::quadratic::{Entry, Equation, Form, MAX_DEGREE, Product, Role, Tail, Unknown, value};
use crate::interval::Real;
use crate::places::array;
use crate::rational::Rational;
use crate::statement::{Item, Problem, Target};
use std::cell::Cell;
use std::collections::HashMap;
use std::rc::Rc;

/// Why a constraint cannot be put to work: what is wrong, and what to do about it.
pub type Fault = String;

/// How a number that stands for itself changes where an axis is reversed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parity {
    /// It stays.
    Even,
    /// It changes its sign, as a triple product does.
    Odd,
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
    /// See [`Lowered::gives_lengths`].
    gives_lengths: Cell<bool>,
    /// Lengths that are entries of equations already.
    lengths: HashMap<[Form; 3], Entry>,
    /// Whether vectors are divided by their lengths, see `heading`.
    has_headings: bool,
    /// Those that are.
    headings: HashMap<[Form; 3], Arrow>,
    /// Cross products likewise.
    crosses: HashMap<[[Form; 3]; 2], Arrow>,
    /// Numbers that equations of one's own are made of, see `number`.
    numbers: HashMap<number::Made, Number>,
    /// Bodies with joints, once they were asked for.
    assembled: Option<Rc<Assembled>>,
    /// Unknowns of objects, by index of the object.
    pub(super) objects: HashMap<usize, Vec<Entry>>,
}

/// Where a path begins, at t = 0.
#[derive(Debug, Clone, Copy)]
pub enum Start<'a> {
    /// At the sketch, which need not meet any constraint.
    Sketch,
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
    /// See [`Lowering::with_dimensions_apart`].
    has_dimensions_apart: bool,
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
    /// Whether equations of constraints have the numbers of distances in them: they do not say what the constraints say where such a
    /// distance is left out.
    pub gives_lengths: bool,
}

/// An equation that was left out where there are more than unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Spare {
    /// What it says.
    pub equation: Equation,
    /// Whose it is: a count of objects, constraints, none, and distances.
    pub owner: usize,
}

impl<'a> Lowering<'a> {
    /// Nothing yet. With `editable`, the left-hand sides will be the same whatever the values of dimensions are.
    pub fn new(problem: &'a Problem, from: Start<'a>, editable: bool) -> Self {
        let pairs = problem.distances.iter().enumerate();
        let low = Lowering {
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
            gives_lengths: Cell::new(false),
            lengths: HashMap::new(),
            has_headings: false,
            headings: HashMap::new(),
            crosses: HashMap::new(),
            numbers: HashMap::new(),
            assembled: None,
            objects: HashMap::new(),
        };
        match from {
            Start::Dimensions(record) if record.has_dimensions_apart => low.with_dimensions_apart(),
            _ => low,
        }
    }

    /// The same where no right-hand side has the numbers of two dimensions: a length that is a dimension of the problem is an unknown in
    /// all equations but its own, so that the product of two lengths and a cosine is one of unknowns.
    pub fn with_dimensions_apart(mut self) -> Self {
        self.distances.clear();
        self.record.has_dimensions_apart = true;
        self
    }

    /// The same with vectors divided by their lengths, see `heading`: for t = 1 alone.
    pub fn with_headings(mut self) -> Self {
        self.has_headings = true;
        self
    }

    /// From here on equations belong to this object or constraint.
    pub fn begin(&mut self, owner: usize) {
        self.owner = owner;
    }

    /// The index of the constraint to which equations belong.
    pub fn constraint(&self) -> usize {
        self.owner - self.problem.objects.len()
    }

    /// Whether two points are one and the same, or a `coincident` puts them in one place.
    pub fn are_together(&self, a: usize, b: usize) -> bool {
        a == b
            || self.problem.constraints.iter().any(|c| {
                c.kind == "coincident"
                    && c.items.contains(&Item::Point(a))
                    && c.items.contains(&Item::Point(b))
            })
    }

    /// The result.
    pub fn finish(mut self) -> Lowered {
        self.tail.twins = self.twins();
        self.tail.mirrors = !self.problem.is_absolute()
            && (0..self.problem.dimension).all(|axis| self.is_symmetric(axis));
        self.tail.objects = (0..self.problem.objects.len())
            .map(|object| self.objects.remove(&object).unwrap_or_default())
            .collect();
        Lowered {
            record: self.record,
            tail: self.tail,
            values: self.values,
            owners: self.owners,
            vanishing: self.vanishing,
            gives_lengths: self.gives_lengths.get(),
        }
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.problem.dimension
    }

    /// The name of a point.
    pub fn name(&self, point: usize) -> &str {
        &self.problem.points[point].name
    }

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
        let flips = array(|k| k < self.dimension() && parity == Parity::Odd);
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
        let d = self.dimension();
        self.components(name, power, at, |axis| {
            array(|k| k < d && (k == axis) != axial)
        })
    }

    /// The same, with for each of them the axes whose reversal changes its sign.
    fn components(
        &mut self,
        name: &str,
        power: i32,
        at: [Real; 3],
        flips: impl Fn(usize) -> [bool; 3],
    ) -> [Entry; 3] {
        let mut entries = [Entry::Zero; 3];
        for (axis, at) in at.into_iter().enumerate().take(self.dimension()) {
            let name = format!("{name}, {}", ["x", "y", "z"][axis]);
            entries[axis] = self.unknown(name, Role::Free, power, flips(axis), at);
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
        // Equations have ½ on the left. Coordinates of an axis are zero but for one.
        let is_zero = |form: Form| form == value(Entry::Zero);
        let products = products
            .into_iter()
            .filter(|p| !is_zero(p.left) && !is_zero(p.right));
        let products = products.map(|p| Product {
            factor: 2 * p.factor,
            ..p
        });
        let equation = Equation {
            name,
            products: products.collect(),
            right,
            power,
        };
        self.insert(self.tail.equations.len(), equation, vanishing);
    }

    /// Puts an equation in its place among the others.
    fn insert(&mut self, at: usize, equation: Equation, vanishing: bool) {
        self.tail.equations.insert(at, equation);
        self.vanishing.insert(at, vanishing);
        self.owners.insert(at, self.owner);
    }

    /// The equation ½|a − b|² = right of two points, like that of a distance. It comes before all equations of
    /// other forms, so that trackers find such equations next to the distances.
    pub(super) fn equate_half_square(&mut self, name: &str, points: [usize; 2], right: Polynomial) {
        let equation = self.half_square(name.to_owned(), points, right);
        let mut others = self.tail.equations.iter();
        let at = others.position(|other| other.ends(self.dimension()).is_none());
        let at = at.unwrap_or(self.tail.equations.len());
        self.insert(at, equation, false);
    }

    /// The equation of a distance of the problem, for t = 1 alone. Those of all distances come first, in order.
    pub fn distance_for_sets(&mut self, index: usize) {
        let distance = &self.problem.distances[index];
        let half = Rational::new(1.into(), 2.into());
        let right = vec![Real::from(distance.target.squared() * half)];
        let name = self.problem.distance_name(index);
        let equation = self.half_square(name, distance.points, right);
        self.insert(index, equation, false);
    }

    /// The equation ½|a − b|² = right of two points.
    fn half_square(&self, name: String, points: [usize; 2], right: Polynomial) -> Equation {
        let [a, b] = points.map(|point| self.place(point));
        let span = self.between(&a, &b);
        Equation {
            name,
            products: self.dot(1, &span.forms, &span.forms),
            right,
            power: 2,
        }
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
        let right = self.way_to_zero(start);
        self.push(name.to_owned(), products, right, power, true);
    }

    /// The equation Σ products = `target`, likewise.
    pub fn meet(
        &mut self,
        name: &str,
        products: Vec<Product>,
        start: &Real,
        target: Real,
        power: i32,
    ) {
        let mut right = self.way_to_zero(start - &target);
        right[0] = &right[0] + &target;
        self.push(name.to_owned(), products, right, power, target.is_zero());
    }

    /// The way to zero of what is `start` in the sketch, see [`Lowering::vanish`].
    pub(super) fn way_to_zero(&self, start: Real) -> Polynomial {
        let detour = self.problem.homotopy.detour.value();
        if !matches!(self.from, Start::Sketch) {
            vec![Real::zero()]
        } else if !start.is_zero() {
            let back = -&start;
            vec![start, back]
        } else if detour.is_zero() {
            vec![Real::zero()]
        } else {
            let there = Real::from(detour.clone());
            vec![Real::zero(), there.clone(), -&there]
        }
    }

    /// The linear equation Σ products = 0 that has to hold at t = 1, where Σ products is `start` in the sketch:
    /// led there linearly, or, where the sketch meets it, kept all along the path, as linear conditions are never
    /// singular.
    pub fn vanish_linear(&mut self, name: &str, products: Vec<Product>, start: Real, power: i32) {
        let right = if start.is_zero() || !matches!(self.from, Start::Sketch) {
            vec![Real::zero()]
        } else {
            let back = -&start;
            vec![start, back]
        };
        self.push(name.to_owned(), products, right, power, true);
    }

    /// What Σ products is in the sketch.
    pub(super) fn at_sketch(&self, products: &[Product]) -> Real {
        let entry = |entry: Entry| match entry {
            Entry::Zero => Real::zero(),
            Entry::Unknown(unknown) => self.values[unknown].clone(),
            Entry::Coordinate { point, axis } => self.frame.coordinate(&self.place(point).at, axis),
        };
        let form = |form: Form| match form {
            Form::One => Real::whole(1),
            Form::Difference(a, b) => &entry(a) - &entry(b),
        };
        products.iter().fold(Real::zero(), |sum, p| {
            let product = &form(p.left) * &form(p.right);
            &sum + &(&Real::whole(p.factor.into()) * &product)
        })
    }

    /// A number's way from what it is in the sketch to what it is wanted to be; where the path begins at a figure
    /// that meets all constraints, from what it is there. The degree is the same for both, so that the equations are.
    pub fn lead(&mut self, now: Real, then: Real) -> Polynomial {
        let before = match self.from {
            Start::Sketch => None,
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

    /// A new unknown that is the polynomial `of`: a coefficient that varies, or is no whole number.
    pub fn coefficient(&mut self, name: &str, power: i32, parity: Parity, of: Polynomial) -> Entry {
        let entry = self.scalar(name.to_owned(), power, parity, of[0].clone());
        self.equate(
            name,
            vec![Product::new(1, value(entry), Form::One)],
            of,
            power,
        );
        entry
    }
}
