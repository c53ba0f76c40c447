//! Points and vectors, as equations see them: places, spans, lengths, cross products.

use super::super::frame::{self, Vector, cross, length, minus, vector};
use super::super::polynomial::{Polynomial, ramp};
use super::super::quadratic::{Entry, Form, Nonzero, Product, Role, coordinate, difference, value};
use super::{Fault, Lowering, Parity, Start};
use crate::interval::Real;
use crate::places::{Each as _, array};
use crate::rational::Rational;
use crate::statement::{AXES, Target};

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
    pub(super) known: Option<Polynomial>,
}

impl Lowering<'_> {
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
            entries: array(entry),
            at: vector(&self.problem.points[point].sketch),
        }
    }

    /// From one place to another.
    pub fn between(&self, from: &Place, to: &Place) -> Arrow {
        Arrow {
            forms: array(|k| difference(to.entries[k], from.entries[k])),
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
        if frame::is_zero(&arrow.at) {
            return Err(format!(
                "the points {} coincide in the sketch: move one of them",
                name.replace('-', " and ")
            ));
        }
        Ok(Arrow {
            known: self
                .distances
                .get(&[from.min(to), from.max(to)])
                .map(|&index| {
                    self.gives_lengths.set(true);
                    self.given_length(index)
                }),
            name,
            ..arrow
        })
    }

    /// A direction of which the length is fixed, made of unknowns.
    pub fn direction(&self, entries: [Entry; 3], at: Vector, name: String) -> Arrow {
        Arrow {
            forms: entries.each(value),
            known: Some(vec![length(&at)]),
            at,
            power: 0,
            axial: false,
            name,
        }
    }

    /// A unit vector along an axis of the user's frame.
    pub fn axis(&self, axis: usize) -> Arrow {
        let one = Rational::one;
        let is_it = |k: usize| k == axis;
        Arrow {
            forms: array(|k| {
                if is_it(k) {
                    Form::One
                } else {
                    value(Entry::Zero)
                }
            }),
            at: std::array::from_fn(|k| if is_it(k) { one() } else { frame::zero() }),
            power: 0,
            axial: false,
            name: AXES[axis].to_owned(),
            known: Some(vec![Real::whole(1)]),
        }
    }

    /// a(t) of a distance of the problem.
    pub(super) fn given_length(&self, index: usize) -> Polynomial {
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
                products.push(Product::new(-1, value(entry), value(entry)));
                self.equate(&name, products, vec![Real::zero()], 2 * of.power);
                entry
            }
        };
        self.lengths.insert(of.forms, entry);
        entry
    }

    /// Says that a vector must not vanish along the path. Where its length is known, that is proved positive anyway.
    pub fn nonzero(&mut self, of: &Arrow) {
        let mut others = self.tail.nonzero.iter();
        if of.known.is_some() || others.any(|other| other.forms == of.forms) {
            return;
        }
        self.tail.nonzero.push(Nonzero {
            name: of.name.clone(),
            forms: of.forms,
        });
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
                Product::new(1, value(entries[k]), Form::One),
                Product::new(-1, a.forms[i], b.forms[j]),
                Product::new(1, a.forms[j], b.forms[i]),
            ];
            self.equate(&name, products, vec![Real::zero()], power);
        }
        let arrow = Arrow {
            forms: entries.each(value),
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
            .map(|k| Product::new(factor, a[k], b[k]))
            .collect()
    }

    /// The products of factor · (a × b) in the plane.
    pub fn cross_in_plane(&self, factor: i32, a: &[Form; 3], b: &[Form; 3]) -> Vec<Product> {
        vec![
            Product::new(factor, a[0], b[1]),
            Product::new(-factor, a[1], b[0]),
        ]
    }

    /// The length of a vector, or the product of those of two.
    pub fn lengths(&mut self, of: &[&Arrow]) -> Entry {
        let [a, b] = match *of {
            [arrow] => return self.length(arrow),
            [a, b] => [a, b],
            _ => unreachable!("at most two vectors"),
        };
        let entries = [self.length(a), self.length(b)].each(value);
        let at = &length(&a.at) * &length(&b.at);
        let both = format!("the lengths of {} and {}, multiplied", a.name, b.name);
        let (zero, power) = (vec![Real::zero()], a.power + b.power);
        let entry = self.scalar(both.clone(), power, Parity::Even, at);
        let definition = vec![
            Product::new(1, value(entry), Form::One),
            Product::new(-1, entries[0], entries[1]),
        ];
        self.equate(&both, definition, zero, power);
        entry
    }
}
