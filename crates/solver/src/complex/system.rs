//! Complex quadratic equations with parameters, and the real ones that they stand for.

use super::exact::{Exact, Parameter, zero};
use crate::constraint::{self, Entry, Role, Tail};
use crate::equations::{Form, Product, Ring, sign};
use crate::hexadecimal::hexadecimal;
use crate::interval::point;
use crate::system::{Homotopy, Right, Term};
use sha2::{Digest, Sha256};

/// A complex unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// What people call it.
    pub name: String,
    /// The power of the unit of length that it has.
    pub power: i32,
    /// For each axis whether it changes its sign where that axis is reversed.
    pub flips: [bool; 3],
}

/// `½ Σ factor · left · right = E`, with E a parameter, or zero for all figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// What people call it.
    pub name: String,
    /// The terms of twice the left-hand side. Indices from the number of unknowns on stand for zero.
    pub terms: Vec<Term>,
    /// The power of the unit of length that it has.
    pub power: i32,
    /// What stands on the right-hand side.
    pub right: Kind,
    /// Whether loops of parameters lead this one around; otherwise it goes straight.
    pub bows: bool,
}

/// What a right-hand side is.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A dimension, which is another one in another figure: where the target has it.
    Parameter(Parameter),
    /// A constant that is the same in all figures, as in an equation that defines an auxiliary unknown.
    Fixed(Exact),
}

/// A change of signs of unknowns that takes solutions to solutions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signs {
    /// For each unknown whether its sign changes.
    pub changes: Vec<bool>,
    /// Whether it takes a figure to its mirror image; otherwise it moves it.
    pub mirrors: bool,
}

/// Where the unknowns of a start figure are drawn from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Start {
    /// Any figure: unknowns that a fixed equation defines are computed from the others.
    #[default]
    Any,
    /// Any figure whose reference stands on real places: as many of these unknowns, from the first on, as the
    /// number says are its coordinates that are not zero. Unknowns that a fixed equation defines are computed from
    /// the others.
    Placed([usize; 3], usize),
    /// Three lines in general directions, the third of which is told where this coordinate is 0: see `lines`.
    Lines(usize),
}

/// n complex quadratic equations in n complex unknowns, with the parameters of one instance.
#[derive(Debug, Clone, Default)]
pub struct System {
    /// 2 or 3.
    pub dimension: usize,
    /// The unknowns.
    pub unknowns: Vec<Unknown>,
    /// The equations.
    pub equations: Vec<Equation>,
    /// For each point of the problem the unknowns that its coordinates are; `None` where one is zero.
    pub points: Vec<[Option<usize>; 3]>,
    /// The unit of length: a power of two. Parameters are in it.
    pub unit: f64,
    /// Which changes of sign take the solutions of every instance to solutions: a group, the first being
    /// the one that changes nothing.
    pub group: Vec<Signs>,
    /// Which changes of sign take the solutions of this instance to solutions: a group, the first being the one
    /// that changes nothing.
    pub group_of_instance: Vec<Signs>,
    /// How start figures are drawn.
    pub start: Start,
    /// How often each solution of these equations stands in the gauge, turned or mirrored: by signs that the
    /// equations leave out.
    pub positions: usize,
    /// How the figure is placed, in words.
    pub gauge: String,
    /// Whether the problem is in a frame of its own: no motion takes a figure to another one.
    pub is_absolute: bool,
    /// Vectors that must not vanish in a figure, and may in a solution of the equations: the name of each and, for every coordinate, the
    /// two unknowns of which it is the difference. Numbers beyond the last unknown stand for zero.
    pub nonzero: Vec<(String, Vec<[usize; 2]>)>,
}

/// The index of the real part of a complex unknown; the imaginary part comes next.
pub fn real_part(unknown: usize) -> usize {
    2 * unknown
}

impl System {
    /// Whether the points of a solution tell all other unknowns, one after the other by equations in which they stand
    /// times a number: two solutions with the same points are one.
    pub fn is_told_by_points(&self) -> bool {
        let n = self.unknowns.len();
        let mut told = vec![false; n];
        for unknown in self.points.iter().flatten().flatten() {
            told[*unknown] = true;
        }
        loop {
            let mut open = (0..n).filter(|&u| !told[u]);
            let next = open.find(|&u| {
                let others = |e: usize| super::start::unknowns_of(self, e).filter(|&v| v != u);
                (0..n).any(|e| self.stands_alone(e, u) && others(e).all(|v| told[v]))
            });
            match next {
                Some(unknown) => told[unknown] = true,
                None => return told.iter().all(|&told| told),
            }
        }
    }

    /// Whether an unknown stands in an equation times a number that is not zero, and nowhere else in it.
    pub(super) fn stands_alone(&self, equation: usize, unknown: usize) -> bool {
        let mut slope = 0;
        for term in &self.equations[equation].terms {
            let stands = |form: &Form<Option<usize>>| {
                let mut entries = form.entries();
                entries.find_map(|(entry, sign)| (entry == Some(unknown)).then_some(sign))
            };
            match (
                stands(&term.left).or(stands(&term.right)),
                term.left,
                term.right,
            ) {
                (None, ..) => {}
                (Some(sign), Form::Difference(a, b), Form::One)
                | (Some(sign), Form::One, Form::Difference(a, b))
                    if a != b =>
                {
                    slope += sign * term.factor;
                }
                _ => return false,
            }
        }
        slope != 0
    }

    /// Adds the groups to what has been set up. `turns`: the changes of signs that reverse directions of lines and planes and leave every
    /// figure as it is, the first of which changes nothing. Those that do not keep the equations are left out.
    pub(super) fn with_groups(mut self, turns: &[Vec<bool>]) -> Self {
        self.group = self.signs(turns, |equation| equation.is_zero_always());
        self.group_of_instance = self.signs(turns, |equation| equation.is_zero());
        self
    }

    /// The parameters of the instance, one for each equation.
    pub fn target(&self) -> Vec<Parameter> {
        let of = |equation: &Equation| match &equation.right {
            Kind::Parameter(value) => value.clone(),
            Kind::Fixed(value) => value.parts(),
        };
        self.equations.iter().map(of).collect()
    }

    /// Twice the left-hand side of an equation, less the first power of the unit, at a point.
    pub(super) fn evaluate<T: Ring>(&self, equation: usize, at: impl Fn(usize) -> T) -> T {
        let at = |entry: Option<usize>| entry.map_or_else(|| T::whole(0), &at);
        let terms = self.equations[equation].terms.iter();
        terms.fold(T::whole(0), |sum, term| {
            sum + term.value(at) * T::whole(term.factor)
        })
    }

    /// Two numbers whose quotient is the value of an unknown that is multiplied by others only in an equation with this
    /// right-hand side, all others being known.
    pub(super) fn alone<T: Ring>(
        &self,
        equation: usize,
        unknown: usize,
        right: T,
        known: impl Fn(usize) -> T,
    ) -> [T; 2] {
        let at = |x: i32| {
            let value = |u: usize| if u == unknown { T::whole(x) } else { known(u) };
            self.evaluate(equation, value)
        };
        let at_zero = at(0);
        let slope = at(1) - at_zero.clone();
        [right * T::whole(2) - at_zero, slope]
    }

    /// The equations of the real and imaginary parts: two real unknowns and equations for each complex one.
    pub fn real(&self) -> Tail {
        let n = self.unknowns.len();
        let unknowns = (0..2 * n).map(|i| {
            let part = if i % 2 == 0 { "Re" } else { "Im" };
            constraint::Unknown {
                name: format!("{part} {}", self.unknowns[i / 2].name),
                role: Role::Free,
                power: 0,
                flips: [false; 3],
                sketch: point(0.0),
            }
        });
        let mut equations = Vec::with_capacity(2 * n);
        for equation in &self.equations {
            let [re, im] = parts(equation);
            for (part, products) in [("Re", re), ("Im", im)] {
                equations.push(constraint::Equation {
                    name: format!("{part} {}", equation.name),
                    products,
                    right: vec![crate::interval::Real::zero()],
                    power: 0,
                });
            }
        }
        Tail {
            unknowns: unknowns.collect(),
            equations,
            mirrors: false,
            ..Tail::default()
        }
    }

    /// The real homotopy, whose right-hand sides are to be set.
    pub fn homotopy(&self) -> Homotopy {
        Homotopy::of_equations(self.real())
    }

    /// The changes of sign by axes and directions that leave every equation as it is, or reverse one that `vanishes`.
    fn signs(&self, turns: &[Vec<bool>], vanishes: impl Fn(&Equation) -> bool) -> Vec<Signs> {
        let mut group: Vec<Signs> = Vec::new();
        let all = (0..1usize << self.dimension)
            .flat_map(|axes| turns.iter().map(move |turn| (axes, turn)));
        for (axes, turn) in all {
            let unknowns = self.unknowns.iter().zip(turn);
            let changes: Vec<bool> = unknowns
                .map(|(u, turn)| {
                    let reversed =
                        (0..self.dimension).filter(|&k| axes >> k & 1 == 1 && u.flips[k]);
                    (reversed.count() % 2 == 1) ^ turn
                })
                .collect();
            if !self.keeps(&changes, &vanishes) {
                continue;
            }
            let mirrors = axes.count_ones() % 2 == 1;
            // Two sets of axes may change the same signs: a figure in a plane is its own mirror image, turned over.
            match group.iter_mut().find(|s| s.changes == changes) {
                Some(same) => same.mirrors &= mirrors,
                None => group.push(Signs { changes, mirrors }),
            }
        }
        group
    }

    /// Whether a change of signs leaves every equation as it is, or reverses one that `vanishes`.
    pub(super) fn keeps(&self, changes: &[bool], vanishes: impl Fn(&Equation) -> bool) -> bool {
        let mut equations = self.equations.iter();
        equations.all(|equation| {
            let sign = sign(&equation.terms, |entry| entry.map(|i| changes[i]));
            sign.is_some_and(|reversed| !reversed || vanishes(equation))
        })
    }

    /// A text that is the same for all instances of one template, and for no others: hashed.
    pub fn structure(&self) -> String {
        let mut text = format!("{} {:?}\n", self.unknowns.len(), self.start);
        if self.is_absolute {
            text += &format!("in its own frame, {} changes of signs\n", self.group.len());
        }
        let end = |entry: Option<usize>| entry.map_or("0".to_owned(), |i| format!("z{i}"));
        for equation in &self.equations {
            for term in &equation.terms {
                let [left, right] = term.forms().map(|form| match form {
                    Form::One => "1".to_owned(),
                    Form::Difference(a, b) => format!("({}-{})", end(a), end(b)),
                });
                text += &format!("{} {left} {right};", term.factor);
            }
            match &equation.right {
                Kind::Parameter(_) => text += " p\n",
                Kind::Fixed(value) => text += &format!(" {} {}\n", value.re, value.im),
            }
        }
        hexadecimal(&Sha256::digest(text.as_bytes()))
    }
}

impl Equation {
    fn is_zero_always(&self) -> bool {
        matches!(&self.right, Kind::Fixed(value) if value.is_zero())
    }

    /// Whether the right-hand side is zero in the instance.
    pub(super) fn is_zero(&self) -> bool {
        match &self.right {
            Kind::Fixed(value) => value.is_zero(),
            Kind::Parameter(value) => value.iter().all(|part| part.is_zero()),
        }
    }
}

/// The products of the real and the imaginary part of a complex equation in n unknowns:
/// (a + ib)(c + id) = (ac − bd) + i(ad + bc).
fn parts(equation: &Equation) -> [Vec<constraint::Product>; 2] {
    let form = |form: Form<Option<usize>>, part: usize| match (form, part) {
        (Form::One, 0) => Some(Form::One),
        // The number 1 has no imaginary part, and zero has none.
        (Form::One, _) | (Form::Difference(None, None), _) => None,
        (form, part) => Some(form.map(|entry| match entry {
            Some(i) => Entry::Unknown(real_part(i) + part),
            None => Entry::Zero,
        })),
    };
    let (mut re, mut im) = (Vec::new(), Vec::new());
    for term in &equation.terms {
        for left in 0..2 {
            for right in 0..2 {
                let (Some(l), Some(r)) = (form(term.left, left), form(term.right, right)) else {
                    continue;
                };
                let sign = if left + right == 2 { -1 } else { 1 };
                let part = if left + right == 1 { &mut im } else { &mut re };
                part.push(Product::new(sign * term.factor, l, r));
            }
        }
    }
    [re, im]
}

/// The right-hand sides of the real equations for parameters that go from one place to another as t goes from 0
/// to 1, along a + (b − a) t + c t (1 − t): straight where c is zero, otherwise along a bow.
pub fn segment(from: &[Parameter], to: &[Parameter], bow: Option<&[Parameter]>) -> Vec<Right> {
    let none = zero();
    let mut rights = Vec::with_capacity(2 * from.len());
    for (k, (a, b)) in from.iter().zip(to).enumerate() {
        let c = bow.map_or(&none, |bow| &bow[k]);
        for part in 0..2 {
            let (a, b, c) = (&a[part], &b[part], &c[part]);
            let coefficients = [a.clone(), &(b - a) + c, -c];
            rights.push(Right::polynomial(&coefficients, 1.0));
        }
    }
    rights
}
