//! What constraints of several kinds say: a number is so much, two vectors are parallel, something stays where it is.

use super::super::frame::{cross_in_plane, dot, length, minus, times};
use super::super::polynomial::{add, multiply};
use super::super::quadratic::{Entry, Form, MAX_DEGREE, Product, value};
use super::{Arrow, Fault, Lowering, Parity};
use crate::interval::Real;
use crate::rational::Rational;

/// What [`Lowering::measure`] takes.
pub struct Measured<'b> {
    /// Products that are the number times the lengths of `arrows`.
    pub products: Vec<Product>,
    /// What they are in the sketch.
    pub now: Rational,
    /// The number wanted.
    pub then: Real,
    /// The number's power of the unit of length: 1 for a distance, 0 for a cosine.
    pub power: i32,
    /// Whether the products change their sign under reflections.
    pub odd: bool,
    /// The vectors, at most two.
    pub arrows: Vec<&'b Arrow>,
}

impl Lowering<'_> {
    /// The equation of a distance between two points, which otherwise is none of the tail's.
    pub fn distance(&mut self, index: usize) {
        let [a, b] = self.problem.distances[index].points;
        let span = self.between(&self.place(a), &self.place(b));
        let products = self.dot(1, &span.forms, &span.forms);
        let length = self.given_length(index);
        let name = self.problem.distance_name(index);
        self.equate(&name, products, multiply(&length, &length), 2);
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
        if left.is_empty() {
            self.equate(name, of.products, right, power);
            return;
        }
        let scale = self.lengths(&left);
        let parity = if of.odd { Parity::Odd } else { Parity::Even };
        let number = format!("{name}, the value");
        let factor = self.coefficient(&number, right_power, parity, right);
        let mut products = of.products;
        products.push(Product::new(-1, value(factor), value(scale)));
        self.equate(name, products, vec![Real::zero()], power);
    }

    /// Whether the lengths of both legs of the angle at the middle one of three points are dimensions of the problem.
    pub fn are_legs_given(&self, [from, at, to]: [usize; 3]) -> Result<bool, Fault> {
        Ok(self.span(at, from)?.known.is_some() && self.span(at, to)?.known.is_some())
    }

    /// Says that the cosine of the angle at a point between two bars of given lengths is led linearly to `then`: by the
    /// cosine rule, that the square of the distance between their other ends is what follows from it. The figures are
    /// those of the bars' product at every t, and the equation is that of a distance. False: a length is not
    /// given, and nothing was said.
    pub fn measure_opposite(
        &mut self,
        name: &str,
        [from, at, to]: [usize; 3],
        then: &Real,
    ) -> Result<bool, Fault> {
        let arrows = [self.span(at, from)?, self.span(at, to)?];
        let [Some(u), Some(v)] = arrows.each_ref().map(|arrow| arrow.known.clone()) else {
            return Ok(false);
        };
        let now = Real::from(dot(&arrows[0].at, &arrows[1].at));
        let product = if then.is_zero() && !self.is_editable() {
            self.way_to_zero(now)
        } else {
            let [a, b] = arrows.each_ref().map(|arrow| length(&arrow.at));
            let cosine = self.lead(&now / &(&a * &b), then.clone());
            multiply(&multiply(&cosine, &u), &v)
        };
        let half = Real::from(Rational::new(1.into(), 2.into()));
        let squares = add(&multiply(&u, &u), &multiply(&v, &v));
        let right = add(
            &multiply(&[half], &squares),
            &multiply(&[Real::whole(-1)], &product),
        );
        self.equate_half_square(name, [from, to], right);
        Ok(true)
    }

    /// Says that an unknown stays what it is in the sketch.
    pub fn hold_unknown(&mut self, name: &str, entry: Entry) {
        let Entry::Unknown(unknown) = entry else {
            unreachable!("an object's unknowns are unknowns")
        };
        let (at, power) = (
            self.values[unknown].clone(),
            self.tail.unknowns[unknown].power,
        );
        self.equate(
            name,
            vec![Product::new(1, value(entry), Form::One)],
            vec![at],
            power,
        );
    }

    /// Says that a coordinate of a point stays where the sketch has it.
    pub fn hold(&mut self, name: &str, point: usize, axis: usize) {
        let place = self.place(point);
        let products = vec![Product::new(1, value(place.entries[axis]), Form::One)];
        let at = Real::from(place.at[axis].clone());
        self.equate(name, products, vec![at], 1);
    }

    /// Says that v = k u for some number k: u and v are parallel. In space, D equations and one unknown;
    /// in the plane, one equation.
    pub fn align(&mut self, name: &str, u: &Arrow, v: &Arrow) {
        let power = u.power + v.power;
        if self.dimension() == 2 {
            let products = self.cross_in_plane(1, &u.forms, &v.forms);
            let start = cross_in_plane(&u.at, &v.at);
            self.vanish(name, products, start.into(), power);
            return;
        }
        // What is left is perpendicular to u.
        let k = dot(&u.at, &v.at) / dot(&u.at, &u.at);
        let left = minus(&v.at, &times(&k, &u.at));
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
                Product::new(1, v.forms[axis], Form::One),
                Product::new(-1, value(factor), u.forms[axis]),
            ];
            let start = self.frame.component(&left, axis);
            self.vanish_linear(name, products, start, v.power);
        }
    }
}
