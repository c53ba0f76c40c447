//! Headings: vectors divided by their lengths, as unknowns.
//!
//! A length L of a vector v is told by |v|² = L², and what is said of v is a number times L. Where v may vanish all these
//! equations hold, or nearly, in a whole neighbourhood, and there zeros are singular that no figure is near: a search for all
//! figures cannot decide it. With a heading u, v = L u and |u|² = 1, the same is said of u. For L > 0, as in every figure, both are the same
//! figures; but as L goes to 0, u stays a unit vector that still has to meet what is said of it.
//!
//! The sketch's numbers are those of the vectors, whatever their lengths: equations with headings mean something at t = 1
//! alone.

use super::super::quadratic::{Form, Product, Role, value};
use super::{Arrow, Lowering};
use crate::constraint::frame::length;
use crate::constraint::objects::{Line, Plane};
use crate::interval::Real;
use crate::places::Each as _;

/// A vector the other way round.
fn reversed(forms: [Form; 3]) -> [Form; 3] {
    forms.each(|form| match form {
        Form::Difference(a, b) => Form::Difference(b, a),
        Form::One => Form::One,
    })
}

impl Lowering<'_> {
    /// The heading of a vector, if it has one already; otherwise the vector itself.
    pub fn heading_made(&mut self, of: Arrow) -> Arrow {
        let is_made = [of.forms, reversed(of.forms)]
            .iter()
            .any(|forms| self.headings.contains_key(forms));
        if is_made { self.heading(of) } else { of }
    }

    /// The heading of a vector, where headings are wanted and its length is not known; otherwise the vector itself.
    pub fn heading(&mut self, of: Arrow) -> Arrow {
        let is_known = of.known.is_some() || of.forms.contains(&Form::One);
        if !self.has_headings || is_known {
            return of;
        }
        if let Some(known) = self.headings.get(&of.forms) {
            return known.clone();
        }
        if let Some(opposite) = self.headings.get(&reversed(of.forms)) {
            return Arrow {
                forms: reversed(opposite.forms),
                at: of.at,
                name: of.name,
                ..opposite.clone()
            };
        }
        let (size, name) = (length(&of.at), format!("the heading of {}", of.name));
        let seen = std::array::from_fn(|axis| &self.frame.component(&of.at, axis) / &size);
        let entries = self.coordinates(&name, 0, of.axial, seen);
        let what = format!("the length of {}", of.name);
        let far = self.unknown(what.clone(), Role::Positive, of.power, [false; 3], size);
        let forms = entries.each(value);
        for (whole, part) in of.forms.into_iter().zip(forms).take(self.dimension()) {
            let products = vec![
                Product::new(1, whole, Form::One),
                Product::new(-1, value(far), part),
            ];
            self.equate(&what, products, vec![Real::zero()], of.power);
        }
        let products = self.dot(1, &forms, &forms);
        self.equate(&name, products, vec![Real::whole(1)], 0);
        for forms in [of.forms, reversed(of.forms)] {
            self.lengths.insert(forms, far);
        }
        let heading = Arrow {
            forms,
            at: of.at,
            power: 0,
            axial: of.axial,
            name: of.name,
            known: Some(vec![Real::whole(1)]),
        };
        self.headings.insert(of.forms, heading.clone());
        heading
    }

    /// A line with its heading for its direction.
    pub fn headed_line(&mut self, mut line: Line) -> Line {
        line.along = self.heading(line.along);
        line
    }

    /// A plane with a normal of length 1.
    pub fn headed_plane(&mut self, mut plane: Plane) -> Plane {
        plane.normal = self.heading(plane.normal);
        plane
    }
}
