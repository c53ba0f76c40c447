//! Filling a fibre by degrees: from the zeros of equations of the same degrees whose zeros are known to those of all equations.
//!
//! Let p(x) = 0 be n equations of degrees d in n unknowns. The zeros of q_k = x_kᵈ − b_k, with b_k not zero, are told by roots of
//! unity; there are as many as the product of the degrees says, and each is regular. As s goes from 0 to 1 along a curve in
//! the complex plane that avoids finitely many places, as almost all do, each of them is continued on
//!
//! ```text
//! q_k(x) + s v_k = 0,    v_k = p_k(x) − q_k(x),
//! ```
//!
//! and every isolated zero of p is the end of one of these paths; the others go to infinity (Sommese, Wampler, *The Numerical
//! Solution of Systems of Polynomials*, 2005, 8.4). s and all v_k are unknowns, so that the equations are quadratic with
//! parameters on the right, as all others are, and so are powers of the unknowns.
//!
//! Where the unknowns are cut into groups in which degrees are lower ([`groups`]), q_k is a product of linear functions, each
//! of the unknowns of one group, as many for each group as p_k's degree in it (the same, 8.4.3). At a zero of all q one factor of
//! each is zero, for each group as many as it has unknowns.
//!
//! Paths are followed in floats: each solution that they come to is proved by itself, and that these are all by their number alone.
//!
//! Equations that define an unknown, those of products and of coefficients, are kept as they are: the degrees are those in the
//! other unknowns.
//!
//! [`groups`]: super::groups

use super::boxes::SolutionBox;
use super::exact::{Exact, Parameter, Random, zero};
use super::follow::{PathEnd, Ways, follow_all, prove_all};
use super::groups::Groups;
use super::monodromy::Fibre;
use super::start::unknowns_of;
use super::system::{Equation, Kind, System, Unknown, segment};
use super::vector::Z;
use crate::elimination::invert;
use crate::equations::Form;
use crate::interval::DoubleDouble;
use crate::rational::Rational;
use crate::system::Term;
use std::collections::HashSet;
use std::f64::consts::TAU;

/// More paths are not followed: loops of parameters then find the solutions one by one.
const MOST_PATHS: usize = 50_000;
/// Beyond this size a path goes to infinity, the size being taken to the degree of the equations, as their values are unknowns too, but no
/// further than is well within floats' digits.
const RADIUS: f64 = 1e2;
const BOUNDS_OF_RADIUS: [f64; 2] = [1e6, 1e12];
/// Where paths are lost all are led again, on another curve of s: so often at most.
const CURVES: usize = 3;

/// Before this t no path goes to infinity, for almost all curves of s: one that is lost far away there is not at its end.
const LATE: f64 = 0.9;

/// What came of all paths.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Led {
    /// Paths that were followed: as many as the multi-homogeneous Bézout number says.
    pub paths: usize,
    /// Those that went beyond the radius allowed.
    pub infinite: usize,
    /// Those that could not be followed to an end, or came to where another one had come.
    pub stopped: usize,
}

/// What is what in a system of equations.
pub struct Degrees {
    /// The unknowns that an equation defines, with it, in the order in which they can be computed from the others.
    told: Vec<(usize, usize)>,
    /// The other unknowns.
    free: Vec<usize>,
    /// The other equations, as many.
    open: Vec<usize>,
    /// Groups of the other unknowns, with the degrees of the other equations.
    pub groups: Groups,
}

impl Degrees {
    /// `None` where equations that define unknowns go in a circle, or their number is not that of the unknowns they leave.
    pub fn of(system: &System) -> Option<Self> {
        let n = system.unknowns.len();
        let mut by: Vec<Option<usize>> = vec![None; n];
        for (e, equation) in system.equations.iter().enumerate() {
            let is_alone = |u: &usize| by[*u].is_none() && system.stands_alone(e, *u);
            match &equation.right {
                Kind::Fixed(_) => {
                    if let Some(unknown) = (0..n).rev().find(is_alone) {
                        by[unknown] = Some(e);
                    }
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
        let mut is_known: Vec<bool> = by.iter().map(Option::is_none).collect();
        let mut told = Vec::new();
        while told.len() + free.len() < n {
            let next = (0..n).find_map(|u| {
                let equation = by[u].filter(|_| !is_known[u])?;
                let mut others = unknowns_of(system, equation).filter(|&other| other != u);
                others.all(|other| is_known[other]).then_some((u, equation))
            })?;
            is_known[next.0] = true;
            told.push(next);
        }
        let open: Vec<usize> = (0..n).filter(|e| !by.contains(&Some(*e))).collect();
        let degrees_in = |marked: &[bool]| {
            let mut degrees = vec![0; n];
            let marked = free.iter().zip(marked);
            marked.for_each(|(&u, &is_in)| degrees[u] = usize::from(is_in));
            for &(unknown, equation) in &told {
                // Its own is still 0.
                degrees[unknown] = degree(system, equation, &degrees);
            }
            let open = open.iter();
            open.map(|&e| degree(system, e, &degrees)).collect()
        };
        let groups = Groups::least(free.len(), degrees_in)?;
        (open.len() == free.len()).then_some(Degrees {
            told,
            free,
            open,
            groups,
        })
    }
}

/// The degree of an equation, where unknowns have these.
fn degree(system: &System, equation: usize, of: &[usize]) -> usize {
    let form = |form: Form<Option<usize>>| {
        let unknowns = form.entries().filter_map(|(entry, _)| entry);
        unknowns.map(|u| of[u]).max().unwrap_or(0)
    };
    let terms = system.equations[equation].terms.iter();
    terms
        .map(|term| form(term.left) + form(term.right))
        .max()
        .unwrap_or(0)
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

/// Of what the equations at the start are made.
enum StartSystem {
    /// Of each free unknown a power is this number: the unknown, the power, the number.
    Roots(Vec<(usize, usize, Z)>),
    /// Of each equation one of these linear functions is zero.
    Products(Vec<Vec<Linear>>),
}

/// Whole multiples of a group's unknowns and a number, summed up.
struct Linear {
    group: usize,
    /// One for each unknown of the group.
    factors: Vec<i32>,
    constant: Z,
}

/// A root of a number, one of as many as the degree says.
fn root(of: Z, degree: usize, turns: usize) -> Z {
    let angle = of.im.hi.atan2(of.re.hi) + TAU * turns as f64;
    let size = of.norm_sqr().powf(0.5 / degree as f64);
    let (sine, cosine) = (angle / degree as f64).sin_cos();
    Z::new((size * cosine).into(), (size * sine).into())
}

/// The equations that lead zeros that are known to those of an instance with these parameters: s is told by the last one.
fn equations(
    system: &System,
    degrees: &Degrees,
    parameters: &[Parameter],
    random: &mut Random,
) -> (Leading, StartSystem) {
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
    let groups = &degrees.groups;
    let is_one = groups.of.iter().all(|group| *group == 0);
    let (mut roots, mut products) = (Vec::new(), Vec::new());
    let open = degrees.free.iter().zip(&degrees.open);
    for ((&unknown, &equation), of) in open.zip(&groups.degrees) {
        // The start's equation is start = right.
        let (start, right) = if is_one {
            let right = random.apart_from_zero().parts();
            roots.push((unknown, of[0], near(&right)));
            (leading.power(&mut vec![(1, unknown)], of[0]), right)
        } else {
            let (forms, linears) = leading.linears(degrees, of, random);
            products.push(linears);
            (leading.product(&forms), zero())
        };
        let name = &system.equations[equation].name;
        let rest = leading.unknown(format!("rest of {name}"));
        let p = system.equations[equation].terms.iter();
        let mut terms = vec![
            Term::new(2, value(rest), Form::One),
            Term::new(2, start[0], start[1]),
        ];
        terms.extend(p.map(|term| Term::new(-term.factor, term.left, term.right)));
        let [b, c] = [&right, &parameters[equation]];
        leading.define(rest, terms, [&b[0] - &c[0], &b[1] - &c[1]]);
        let terms = vec![
            Term::new(2, start[0], start[1]),
            Term::new(2, value(along), value(rest)),
        ];
        leading.equation(terms, right);
    }
    leading.equation(vec![Term::new(2, value(along), Form::One)], zero());
    let n = leading.from.len();
    leading.system = leading.system.with_groups(&[vec![false; n]]);
    let start = match is_one {
        true => StartSystem::Roots(roots),
        false => StartSystem::Products(products),
    };
    (leading, start)
}

impl Leading {
    /// For an equation of these degrees in the groups as many linear functions of each, as unknowns, and what they are.
    fn linears(
        &mut self,
        degrees: &Degrees,
        of: &[usize],
        random: &mut Random,
    ) -> (Vec<usize>, Vec<Linear>) {
        let groups = &degrees.groups;
        let each = of.iter().enumerate();
        let each = each.flat_map(|(group, &degree)| vec![group; degree]);
        let made = each.map(|group| {
            let members = degrees.free.iter().zip(&groups.of);
            let members = members.filter(|(_, own)| **own == group);
            let members: Vec<usize> = members.map(|(&u, _)| u).collect();
            // From −9 to 9, and not 0.
            let draw = |_: &usize| match random.bits() % 18 {
                k @ 0..9 => k as i32 - 9,
                k => k as i32 - 8,
            };
            let factors: Vec<i32> = members.iter().map(draw).collect();
            let constant = random.apart_from_zero().parts();
            let form = self.unknown(format!("linear function {}", self.from.len() + 1));
            let mut terms = vec![Term::new(2, value(form), Form::One)];
            let sum = members.iter().zip(&factors);
            terms.extend(sum.map(|(&u, f)| Term::new(-2 * f, value(u), Form::One)));
            let linear = Linear {
                group,
                factors,
                constant: near(&constant),
            };
            self.define(form, terms, constant);
            (form, linear)
        });
        made.unzip()
    }

    /// The two forms of which a product of unknowns is the product.
    fn product(&mut self, unknowns: &[usize]) -> [Form<Option<usize>>; 2] {
        match *unknowns {
            [] => [Form::One; 2],
            [one] => [value(one), Form::One],
            [one, other] => [value(one), value(other)],
            [ref first @ .., last] => {
                let [left, right] = self.product(first);
                let of_first = self.unknown(format!("product {}", self.from.len() + 1));
                let terms = vec![
                    Term::new(2, value(of_first), Form::One),
                    Term::new(-2, left, right),
                ];
                self.define(of_first, terms, zero());
                [value(of_first), value(last)]
            }
        }
    }
}

impl StartSystem {
    /// The zeros at the start: a value for each of the free unknowns.
    fn zeros(&self, degrees: &Degrees) -> Vec<Vec<Z>> {
        match self {
            // Every choice of a root for each unknown.
            StartSystem::Roots(roots) => {
                let zero = |mut choice: usize| {
                    let of = roots.iter().map(|&(_, degree, right)| {
                        let turns = choice % degree;
                        choice /= degree;
                        root(right, degree, turns)
                    });
                    of.collect()
                };
                (0..degrees.groups.count as usize).map(zero).collect()
            }
            StartSystem::Products(products) => {
                let chosen = degrees.groups.chosen(|e, group| {
                    let linears = products[e].iter();
                    linears.filter(|linear| linear.group == group).collect()
                });
                let zeros = chosen.iter();
                zeros
                    .filter_map(|linears| common_zero(linears, &degrees.groups.of))
                    .collect()
            }
        }
    }
}

/// Where linear functions of unknowns in these groups, for each group as many as it has unknowns, are all zero.
fn common_zero(linears: &[&Linear], groups: &[usize]) -> Option<Vec<Z>> {
    let mut zero = vec![Z::default(); groups.len()];
    for group in 0..=groups.iter().max().copied()? {
        let members: Vec<usize> = (0..groups.len()).filter(|&u| groups[u] == group).collect();
        let own: Vec<&&Linear> = linears.iter().filter(|l| l.group == group).collect();
        let factors = own.iter().flat_map(|linear| &linear.factors);
        let mut inverse: Vec<f64> = factors.map(|&f| f.into()).collect();
        invert(&mut inverse, members.len()).then_some(())?;
        for (&u, row) in members.iter().zip(inverse.chunks(members.len())) {
            let terms = row.iter().zip(&own);
            zero[u] = terms.fold(Z::default(), |sum, (&y, l)| sum - Z::real(y) * l.constant);
        }
    }
    Some(zero)
}

/// Leads zeros that are known to those of a fibre's instance, and adds what is new to it. `None`, and nothing is done, where equations
/// have no degrees, or there would be too many paths.
pub fn lead(system: &System, fibre: &mut Fibre, random: &mut Random, ways: &Ways) -> Option<Led> {
    if !system.points.is_empty() {
        return None;
    }
    let degrees = Degrees::of(system)?;
    let paths = usize::try_from(degrees.groups.count).ok()?;
    (paths <= MOST_PATHS).then_some(())?;
    let (leading, start) = equations(system, &degrees, &fibre.parameters, random);
    let (n, from) = (leading.from.len(), &leading.from);
    let starts = start.zeros(&degrees).into_iter().map(|free| {
        let mut values = vec![Z::default(); n];
        let free = degrees.free.iter().zip(free);
        free.for_each(|(&unknown, value)| values[unknown] = value);
        leading.complete(&mut values);
        values.iter().flat_map(|z| [z.re, z.im]).collect()
    });
    let starts: Vec<Vec<DoubleDouble>> = starts.collect();
    let proved = prove_all(&leading.system, &segment(from, from, None), &starts, ways);
    let starts: Vec<SolutionBox> = proved.into_iter().flatten().collect();
    let starts: Vec<&SolutionBox> = starts.iter().collect();
    let each = degrees.groups.degrees.iter();
    let degree = each.map(|of| of.iter().sum::<usize>()).max()?;
    let [least, most] = BOUNDS_OF_RADIUS;
    let ways = Ways {
        proved: false,
        radius: RADIUS.powi(degree as i32).clamp(least, most),
        ..*ways
    };
    let [mut to, mut bow] = [from.clone(), vec![zero(); n]];
    to[n - 1] = Exact::whole(1).parts();
    // Far from the real line, where leading coefficients of both may cancel.
    let up = Exact {
        re: Rational::zero(),
        im: Rational::from_integer(2.into()),
    };
    let mut led = Led::default();
    for _ in 0..CURVES {
        bow[n - 1] = random.complex().plus(&up).parts();
        let rights = segment(from, &to, Some(&bow));
        let (ends, took) = follow_all(&leading.system, &rights, &starts, &ways);
        fibre.effort.add(took);
        let (infinite, came) = enter(system, fibre, ends, &ways);
        led = Led {
            paths,
            infinite,
            stopped: paths - infinite - came,
        };
        if led.stopped == 0 || ways.is_over() {
            break;
        }
    }
    fibre.failed.0 = led.stopped;
    Some(led)
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
