//! Turns: directions that go round with t, by any number of degrees.

use super::super::frame::{cross_in_plane, dot, is_zero, length};
use super::super::polynomial::Polynomial;
use super::super::quadratic::{Form, Product, Role, value};
use super::{Arrow, Fault, Lowering, Parity, Start};
use crate::interval::Real;
use crate::rational::Rational;

/// Of edits: their quarters are at most a quarter turn for a whole one.
const STEPS: usize = 4;
/// By so many degrees an edit turns at most: its quarters have to be less than 180, or they would go the other way round.
pub const MOST_TURN: i32 = 480;
/// A direction is led along a straight line to one that is no further from it, in degrees, and otherwise past one in between.
const STRAIGHT: f64 = 120.0;

impl Lowering<'_> {
    /// Says that v is u turned by so many degrees, counter-clockwise, in the plane, and longer or shorter: with numbers c and s,
    /// which go from the sketch's cosine and sine to those wanted round 0, and m > 0, that `u·v = m c` and `u × v = m s`.
    ///
    /// # Errors
    /// If an edit would turn by too much at once.
    pub fn turn(
        &mut self,
        name: &str,
        u: &Arrow,
        v: &Arrow,
        degrees: &Rational,
    ) -> Result<(), Fault> {
        let power = u.power + v.power;
        let sizes = &length(&u.at) * &length(&v.at);
        let now = [dot(&u.at, &v.at), cross_in_plane(&u.at, &v.at)].map(Real::from);
        let dot = self.dot(1, &u.forms, &v.forms);
        let cross = self.cross_in_plane(1, &u.forms, &v.forms);
        self.turn_by(name, [dot, cross], (now, &sizes, power), degrees)
    }

    /// Says that the half planes at the line of b and c, one through a and the other through d, are at an angle of so many degrees,
    /// greater than 0 where, seen from b, the second is turned clockwise (IUPAC's sign). With the spans p, q, r from a to d, the normals
    /// m = p × q and n = q × r: `m·n` and `|q| (p·n)` are its cosine and its sine, both multiplied by |m| |n|.
    ///
    /// # Errors
    /// If points coincide or are on one line in the sketch, or an edit would turn by too much at once.
    pub fn torsion(
        &mut self,
        name: &str,
        [a, b, c, d]: [usize; 4],
        degrees: &Rational,
    ) -> Result<(), Fault> {
        let [p, q, r] = [self.span(a, b)?, self.span(b, c)?, self.span(c, d)?];
        let [m, n] = [(&p, &q), (&q, &r)].map(|(one, other)| {
            let normal = format!("the normal of {} and {}", one.name, other.name);
            self.cross(one, other, normal)
        });
        if let Some(flat) = [&m, &n].into_iter().find(|normal| is_zero(&normal.at)) {
            return Err(format!(
                "{} is zero, as the points are on one line in the sketch: move one of them",
                flat.name
            ));
        }
        let (triple, power) = (dot(&p.at, &n.at), p.power + n.power);
        let what = format!("{name}, the triple product");
        let height = self.scalar(what.clone(), power, Parity::Odd, triple.clone().into());
        let mut products = self.dot(-1, &p.forms, &n.forms);
        products.push(Product::new(1, value(height), Form::One));
        self.equate(&what, products, vec![Real::zero()], power);
        let axis = self.length(&q);
        let products = [
            self.dot(1, &m.forms, &n.forms),
            vec![Product::new(1, value(axis), value(height))],
        ];
        let along = &length(&q.at) * &Real::from(triple);
        let now = [Real::from(dot(&m.at, &n.at)), along];
        let sizes = &length(&m.at) * &length(&n.at);
        self.turn_by(name, products, (now, &sizes, m.power + n.power), degrees)
    }

    /// Says it of products that are the cosine and the sine of an angle, both multiplied by a size that is greater than 0. `now`: what these
    /// are in the sketch, the size there, and the power of the unit of length that it has.
    pub(super) fn turn_by(
        &mut self,
        name: &str,
        products: [Vec<Product>; 2],
        (now, sizes, power): ([Real; 2], &Real, i32),
        degrees: &Rational,
    ) -> Result<(), Fault> {
        let [cosine, sine] = self.way_round(now, sizes, degrees)?;
        let cosine = self.coefficient(&format!("{name}, the cosine"), 0, Parity::Even, cosine);
        let sine = self.coefficient(&format!("{name}, the sine"), 0, Parity::Odd, sine);
        let what = format!("{name}, the product of the lengths");
        let size = self.unknown(what, Role::Positive, power, [false; 3], sizes.clone());
        for (mut products, number) in products.into_iter().zip([cosine, sine]) {
            products.push(Product::new(-1, value(size), value(number)));
            self.equate(name, products, vec![Real::zero()], power);
        }
        Ok(())
    }

    /// The way of a cosine and a sine: on Bézier's curve of directions that divide the turn evenly, which goes round 0 in the
    /// same sense all the way, as each of them is less than 180 degrees from the one before. On an edit's way from θ by Δ it is
    /// `e^iθ (1 + (e^iΔ/4 − 1) t)⁴`.
    fn way_round(
        &mut self,
        now: [Real; 2],
        sizes: &Real,
        degrees: &Rational,
    ) -> Result<[Polynomial; 2], Fault> {
        let number = |x: f64| Rational::from_float(x).unwrap_or_default();
        let then = Real::from(degrees.clone());
        let before = match self.from {
            Start::Sketch => None,
            Start::Dimensions(record) => {
                let lead = &record.leads[self.record.leads.len()];
                Some(
                    lead.as_rational()
                        .expect("a turn is led in degrees")
                        .clone(),
                )
            }
        };
        self.record.leads.push(then);
        let on_circle = |degrees: Rational| {
            [
                Real::cosine_of_degrees(degrees.clone()),
                Real::sine_of_degrees(degrees),
            ]
        };
        let way = |from: &Rational, steps: usize| -> Vec<[Real; 2]> {
            let part = |k: usize| Rational::new(k.into(), steps.into());
            (0..=steps)
                .map(|k| on_circle(from + part(k) * (degrees - from)))
                .collect()
        };
        let points = match before {
            // Constant, but as long as others.
            Some(before) if before == *degrees => {
                let [cosine, sine] = on_circle(before).map(|x| {
                    let mut constant = vec![Real::zero(); STEPS + 1];
                    constant[0] = x;
                    constant
                });
                return Ok([cosine, sine]);
            }
            Some(before)
                if (degrees - &before).abs() > Rational::from_integer(MOST_TURN.into()) =>
            {
                return Err(format!(
                    "an edit turns by at most {MOST_TURN} degrees: go there in two or more"
                ));
            }
            Some(before) => way(&before, STEPS),
            None => {
                let [x, y] = now.each_ref().map(|x| x.enclose().mid());
                let drawn = y.atan2(x).to_degrees();
                let wanted = degrees.to_f64();
                let turn = (wanted - drawn + 180.0).rem_euclid(360.0) - 180.0;
                let steps = match self.editable {
                    true => STEPS,
                    false if turn.abs() <= STRAIGHT => 1,
                    false => 2,
                };
                // As many whole turns away as the drawing is near; whole degrees will do.
                let from = number((wanted - turn).round());
                let mut points = way(&from, steps);
                points[0] = now.map(|x| &x / sizes);
                points
            }
        };
        Ok([0, 1].map(|k| {
            let points: Vec<Real> = points.iter().map(|p| p[k].clone()).collect();
            power_form(&points)
        }))
    }
}

/// The coefficients of Bézier's polynomial `Σ binom(n, k) (1 − t)ⁿ⁻ᵏ tᵏ bₖ`: of tᵏ it is `binom(n, k)` times the k-th difference.
fn power_form(points: &[Real]) -> Polynomial {
    let n = points.len() - 1;
    let (mut differences, mut binomial) = (points.to_vec(), 1);
    let mut out = Vec::with_capacity(n + 1);
    for k in 0..=n {
        out.push(&Real::whole(binomial) * &differences[0]);
        differences = differences
            .windows(2)
            .map(|pair| &pair[1] - &pair[0])
            .collect();
        binomial = binomial * (n - k) as i64 / (k + 1) as i64;
    }
    out
}
