//! Filling a fibre by total degree: from the zeros of powers of the unknowns to those of all equations.
//!
//! Let p(x) = 0 be n equations of degrees d in n unknowns. The zeros of x_kᵈ = b_k, with b_k not zero, are told by roots of
//! unity; there are as many as the product of the degrees says, and each is regular. As s goes from 0 to 1 along a curve in
//! the complex plane that avoids finitely many places, as almost all do, each of them is continued on
//!
//! ```text
//! x_kᵈ + s v_k = b_k,    v_k = p_k(x) − x_kᵈ + b_k,
//! ```
//!
//! and every isolated zero of p is the end of one of these paths; the others go to infinity (Sommese, Wampler, *The Numerical
//! Solution of Systems of Polynomials*, 2005, 8.4). s and all v_k are unknowns, so that the equations are quadratic with
//! parameters on the right, as all others are, and so are powers of the unknowns.
//!
//! Paths are followed in floats: each solution that they come to is proved by itself, and that these are all by their number alone.
//!
//! Equations that define an unknown, those of products and of coefficients, are kept as they are: the degrees are those in the
//! other unknowns.

use super::boxes::SolutionBox;
use super::exact::{Exact, Parameter, Random, zero};
use super::follow::{PathEnd, Ways, follow_all, prove_all};
use super::monodromy::Fibre;
use super::start::unknowns_of;
use super::system::{Equation, Kind, System, Unknown, segment};
use super::vector::Z;
use crate::equations::Form;
use crate::interval::DoubleDouble;
use crate::system::Term;
use std::collections::HashSet;
use std::f64::consts::TAU;

/// More paths are not followed: loops of parameters then find the solutions one by one.
const MOST_PATHS: usize = 50_000;
/// Beyond this size of an unknown a path goes to infinity: values of equations are unknowns too, and larger than what they
/// are values of.
const RADIUS: f64 = 1e6;

/// Before this t no path goes to infinity, for almost all curves of s: one that is lost far away there is not at its end.
const LATE: f64 = 0.9;

/// What came of all paths.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Led {
    /// Paths that were followed: the product of the degrees.
    pub paths: usize,
    /// Those that went beyond the radius allowed.
    pub infinite: usize,
    /// Those that could not be followed to an end, or came to where another one had come.
    pub stopped: usize,
}

/// What is what in a system of equations.
struct Degrees {
    /// The unknowns that an equation defines, with it, in the order in which they can be computed from the others.
    told: Vec<(usize, usize)>,
    /// The other unknowns.
    free: Vec<usize>,
    /// The other equations, as many, each with its degree.
    open: Vec<(usize, usize)>,
}

impl Degrees {
    /// `None` where equations that define unknowns go in a circle, or their number is not that of the unknowns they leave.
    fn of(system: &System) -> Option<Self> {
        let n = system.unknowns.len();
        let mut by: Vec<Option<usize>> = vec![None; n];
        for (e, equation) in system.equations.iter().enumerate() {
            let is_alone = |u: &usize| by[*u].is_none() && system.stands_alone(e, *u);
            match &equation.right {
                Kind::Fixed(_) => {
                    let unknown = (0..n).rev().find(is_alone)?;
                    by[unknown] = Some(e);
                }
                // A coefficient.
                Kind::Parameter(_) => {
                    let mut stand = unknowns_of(system, e);
                    let unknown = stand.next()?;
                    if stand.all(|other| other == unknown) && is_alone(&unknown) {
                        by[unknown] = Some(e);
                    }
                }
            }
        }
        let free: Vec<usize> = (0..n).filter(|&u| by[u].is_none()).collect();
        let mut degrees: Vec<Option<usize>> =
            by.iter().map(|by| by.is_none().then_some(1)).collect();
        let mut told = Vec::new();
        while told.len() + free.len() < n {
            let (unknown, equation, degree) = (0..n).find_map(|u| {
                let equation = by[u].filter(|_| degrees[u].is_none())?;
                let rest = |other: usize| if other == u { Some(0) } else { degrees[other] };
                Some((u, equation, degree(system, equation, rest)?))
            })?;
            degrees[unknown] = Some(degree);
            told.push((unknown, equation));
        }
        let others = (0..n).filter(|e| !by.contains(&Some(*e)));
        let open = others.map(|e| Some((e, degree(system, e, |u| degrees[u])?)));
        let open: Vec<(usize, usize)> = open.collect::<Option<_>>()?;
        (open.len() == free.len()).then_some(Degrees { told, free, open })
    }

    /// The product of the degrees, unless it is zero or too large.
    fn paths(&self) -> Option<usize> {
        let mut degrees = self.open.iter().map(|&(_, degree)| degree);
        let product = degrees.try_fold(1usize, usize::checked_mul)?;
        (1..=MOST_PATHS).contains(&product).then_some(product)
    }
}

/// The degree of an equation, where unknowns have these.
fn degree(system: &System, equation: usize, of: impl Fn(usize) -> Option<usize>) -> Option<usize> {
    let form = |form: Form<Option<usize>>| {
        let unknowns = form.entries().filter_map(|(entry, _)| entry);
        unknowns.map(&of).try_fold(0, |max, of| Some(of?.max(max)))
    };
    let mut terms = system.equations[equation].terms.iter();
    terms.try_fold(0, |max: usize, term| {
        Some(max.max(form(term.left)? + form(term.right)?))
    })
}

/// A system that is being written.
struct Leading {
    system: System,
    /// Right-hand sides at the start.
    from: Vec<Parameter>,
    /// Unknowns with the equations that tell them, in the order in which they can be computed.
    order: Vec<(usize, usize)>,
}

impl Leading {
    fn unknown(&mut self, name: String) -> usize {
        self.system.unknowns.push(Unknown {
            name,
            power: 0,
            flips: [false; 3],
        });
        self.system.unknowns.len() - 1
    }

    /// An equation whose right-hand side is this at the start.
    fn equation(&mut self, terms: Vec<Term>, right: Parameter) {
        self.system.equations.push(Equation {
            name: format!("equation {}", self.from.len() + 1),
            terms,
            power: 0,
            right: Kind::Parameter(right.clone()),
            bows: false,
        });
        self.from.push(right);
    }

    /// An equation that tells an unknown.
    fn define(&mut self, unknown: usize, terms: Vec<Term>, right: Parameter) {
        self.order.push((unknown, self.from.len()));
        self.equation(terms, right);
    }

    /// The two forms of which a power of an unknown is the product. `known` has the powers that are unknowns, the first power
    /// first, and those that are made for it.
    fn power(&mut self, known: &mut Vec<(usize, usize)>, power: usize) -> [Form<Option<usize>>; 2] {
        let (unknown, half) = (known[0].1, power / 2);
        if half == 0 {
            return [value(unknown), Form::One];
        }
        [half, power - half].map(|part| {
            if let Some(&(_, unknown)) = known.iter().find(|(power, _)| *power == part) {
                return value(unknown);
            }
            let [left, right] = self.power(known, part);
            let name = format!("{}^{part}", self.system.unknowns[unknown].name);
            let unknown = self.unknown(name);
            known.push((part, unknown));
            let terms = vec![
                Term::new(2, value(unknown), Form::One),
                Term::new(-2, left, right),
            ];
            self.define(unknown, terms, zero());
            value(unknown)
        })
    }

    /// All unknowns at the start, where these of the free ones are known.
    fn complete(&self, values: &mut [Z]) {
        for &(unknown, equation) in &self.order {
            let right = near(&self.from[equation]);
            let at = |u: usize| values[u];
            let [above, slope] = self.system.alone(equation, unknown, right, at);
            values[unknown] = above / slope;
        }
    }
}

fn value(unknown: usize) -> Form<Option<usize>> {
    Form::Difference(Some(unknown), None)
}

fn near([re, im]: &Parameter) -> Z {
    Z::new(re.double().0, im.double().0)
}

/// A number of which the unknown's power is at the start.
struct Root {
    unknown: usize,
    degree: usize,
    right: Z,
}

impl Root {
    /// One of its roots.
    fn turned(&self, turns: usize) -> Z {
        let Z { re, im } = self.right;
        let angle = im.hi.atan2(re.hi) + TAU * turns as f64;
        let size = self.right.norm_sqr().powf(0.5 / self.degree as f64);
        let (sine, cosine) = (angle / self.degree as f64).sin_cos();
        Z::new((size * cosine).into(), (size * sine).into())
    }
}

/// The equations that lead the zeros of powers to those of an instance with these parameters: s is told by the last one. With the numbers
/// of which the powers are.
fn equations(
    system: &System,
    degrees: &Degrees,
    parameters: &[Parameter],
    random: &mut Random,
) -> (Leading, Vec<Root>) {
    let mut leading = Leading {
        system: System {
            equations: Vec::new(),
            ..system.clone()
        },
        from: Vec::new(),
        order: Vec::new(),
    };
    let along = leading.unknown("s".to_owned());
    for &(unknown, equation) in &degrees.told {
        let terms = system.equations[equation].terms.clone();
        leading.define(unknown, terms, parameters[equation].clone());
    }
    let mut roots = Vec::with_capacity(degrees.free.len());
    for (&unknown, &(equation, degree)) in degrees.free.iter().zip(&degrees.open) {
        let right = random.apart_from_zero().parts();
        roots.push(Root {
            unknown,
            degree,
            right: near(&right),
        });
        let [left, other] = leading.power(&mut vec![(1, unknown)], degree);
        let rest = leading.unknown(format!("rest of {}", system.equations[equation].name));
        let of = system.equations[equation].terms.iter();
        let mut terms = vec![
            Term::new(2, value(rest), Form::One),
            Term::new(2, left, other),
        ];
        terms.extend(of.map(|term| Term::new(-term.factor, term.left, term.right)));
        let [b, c] = [&right, &parameters[equation]];
        leading.define(rest, terms, [&b[0] - &c[0], &b[1] - &c[1]]);
        let terms = vec![
            Term::new(2, left, other),
            Term::new(2, value(along), value(rest)),
        ];
        leading.equation(terms, right);
    }
    leading.equation(vec![Term::new(2, value(along), Form::One)], zero());
    let n = leading.from.len();
    leading.system = leading.system.with_groups(&[vec![false; n]]);
    (leading, roots)
}

/// Leads the zeros of powers to those of a fibre's instance, and adds what is new to it. `None`, and nothing is done, where equations
/// have no degrees, or the product of these is too large.
pub fn lead(system: &System, fibre: &mut Fibre, random: &mut Random, ways: &Ways) -> Option<Led> {
    if !system.points.is_empty() {
        return None;
    }
    let degrees = Degrees::of(system)?;
    let paths = degrees.paths()?;
    let (leading, roots) = equations(system, &degrees, &fibre.parameters, random);
    let (n, from) = (leading.from.len(), &leading.from);
    // Every choice of a root for each unknown.
    let start = |mut choice: usize| {
        let mut values = vec![Z::default(); n];
        for root in &roots {
            values[root.unknown] = root.turned(choice % root.degree);
            choice /= root.degree;
        }
        leading.complete(&mut values);
        values.iter().flat_map(|z| [z.re, z.im]).collect()
    };
    let starts: Vec<Vec<DoubleDouble>> = (0..paths).map(start).collect();
    let proved = prove_all(&leading.system, &segment(from, from, None), &starts, ways);
    let starts: Vec<SolutionBox> = proved.into_iter().flatten().collect();
    let starts: Vec<&SolutionBox> = starts.iter().collect();
    let ways = Ways {
        proved: false,
        radius: RADIUS,
        ..*ways
    };
    let [mut to, mut bow] = [from.clone(), vec![zero(); n]];
    (to[n - 1], bow[n - 1]) = (Exact::whole(1).parts(), random.complex().parts());
    let rights = segment(from, &to, Some(&bow));
    let (ends, took) = follow_all(&leading.system, &rights, &starts, &ways);
    fibre.effort.add(took);
    let (infinite, came) = enter(system, fibre, ends, &ways);
    let stopped = paths - infinite - came;
    fibre.failed.0 = stopped;
    Some(Led {
        paths,
        infinite,
        stopped,
    })
}

/// Enters the ends of all paths. Tells how many went to infinity, and to how many solutions the others came.
fn enter(system: &System, fibre: &mut Fibre, ends: Vec<PathEnd>, ways: &Ways) -> (usize, usize) {
    let (mut infinite, mut near) = (0, Vec::new());
    let why = &mut fibre.failed.1;
    for end in ends {
        match end {
            PathEnd::Reached(found) => {
                near.push(found.middle()[..2 * system.unknowns.len()].to_vec());
            }
            PathEnd::Beyond(t, _) if t > LATE => infinite += 1,
            PathEnd::Beyond(t, _) => *why = Some(format!("unknowns are large at t = {t:.4}")),
            PathEnd::Stopped(reason) => *why = Some(reason),
        }
    }
    let rights = segment(&fibre.parameters, &fibre.parameters, None);
    let mut came = HashSet::new();
    for found in prove_all(system, &rights, &near, ways) {
        match found.and_then(|found| fibre.solutions.enter(found, &system.group)) {
            Ok(index) => drop(came.insert(index)),
            Err(reason) => *why = Some(reason),
        }
    }
    (infinite, came.len())
}
