//! Distances written as other equations: the same path, tracked and proved through the tail.

use super::precise::Case;
use super::{Random, boxes_meet, effort, random_problem};
use crate::constraint::{
    Entry, Equation, Form, Product, Role, Tail, Unknown, coordinate, difference, value,
};
use crate::interval::{Interval, Real, point};
use crate::places::Each as _;
use crate::problem::{Distance, Problem, Target};
use crate::system::Homotopy;
use crate::track::certified::track;
use crate::track::{Control, Options, Outcome, Space, Status};

/// A problem with some of its distances taken out, and the equations that say the same.
pub struct Disguised {
    pub plain: Problem,
    pub rest: Problem,
    taken: Vec<(Distance, Option<Real>, usize)>,
}

impl Disguised {
    /// Takes out every distance with the probability `share`.
    pub fn new(plain: &Problem, share: f64, random: &mut Random) -> Self {
        let (mut rest, mut taken) = (plain.clone(), Vec::new());
        rest.distances.clear();
        rest.homotopy.bend = usize::MAX;
        for (index, distance) in plain.distances.iter().enumerate() {
            let bends = index == plain.homotopy.bend;
            let c = bends.then(|| plain.homotopy.bend_coefficient.value().clone().into());
            if random.unit() < share {
                taken.push((distance.clone(), c, random.below(5)));
            } else {
                if bends {
                    rest.homotopy.bend = rest.distances.len();
                }
                rest.distances.push(distance.clone());
            }
        }
        let plain = plain.clone();
        Disguised { plain, rest, taken }
    }

    /// The homotopy that says the same in other words.
    pub fn homotopy(&self) -> Option<Homotopy> {
        let unit = Homotopy::new(&self.plain).ok()?.unit;
        Homotopy::with_constraints(&self.rest, unit, |sketch| self.lower(sketch)).ok()
    }

    /// With the problem that is left.
    pub fn with_homotopy(self) -> Option<(Problem, Homotopy)> {
        let homotopy = self.homotopy()?;
        Some((self.rest, homotopy))
    }

    fn lower(&self, sketch: &[[Interval; 3]]) -> Tail {
        let mut tail = Tail::default();
        let mut before: Option<(Vec<Product>, Vec<Real>)> = None;
        for (distance, c, kind) in &self.taken {
            let length = self.length(distance, c);
            self.add(&mut tail, distance, &length, *kind, sketch, &mut before);
        }
        tail
    }

    /// The coefficients of a(t).
    fn length(&self, distance: &Distance, c: &Option<Real>) -> [Real; 3] {
        let [a, b] = distance.points.each(|p| &self.plain.points[p].sketch);
        let squared = (0..3).fold(Real::zero(), |sum, k| {
            let d = Real::from(a[k].value() - b[k].value());
            &sum + &(&d * &d)
        });
        let from = squared.sqrt();
        let to = match &distance.target {
            Target::Length(length) => Real::from(length.value().clone()),
            Target::SquaredLength(square) => Real::from(square.value().clone()).sqrt(),
        };
        let c = c.clone().unwrap_or_else(Real::zero);
        let slope = &(&to - &from) + &c;
        [from, slope, -&c]
    }

    fn add(
        &self,
        tail: &mut Tail,
        distance: &Distance,
        length: &[Real; 3],
        kind: usize,
        sketch: &[[Interval; 3]],
        before: &mut Option<(Vec<Product>, Vec<Real>)>,
    ) {
        let [i, j] = distance.points;
        let d = self.plain.dimension;
        let forms: Vec<Form> = (0..d)
            .map(|axis| difference(coordinate(i, axis), coordinate(j, axis)))
            .collect();
        let squares = |forms: &[Form]| -> Vec<Product> {
            forms
                .iter()
                .map(|&form| Product::new(1, form, form))
                .collect()
        };
        let right = half_square(length);
        let say = |tail: &mut Tail, products: Vec<Product>, right: Vec<Real>, power: i32| {
            tail.equations.push(Equation {
                name: self.plain.distance_name(0),
                products,
                right,
                power,
            });
        };
        match kind {
            // The same, but not as a distance.
            0 => say(tail, squares(&forms), right.clone(), 2),
            // Added to the one before: E + E' = |p|² / 2 + …
            1 if before.is_some() => {
                let (others, other) = before.as_ref().expect("one before");
                let products = [squares(&forms), others.clone()].concat();
                let sum = (0..5).map(|k| {
                    let zero = Real::zero();
                    right.get(k).unwrap_or(&zero) + other.get(k).unwrap_or(&zero)
                });
                say(tail, products, sum.collect(), 2);
            }
            // With a radius: |p|² − r² = 0, r = a(t).
            2 => {
                let k = tail.unknowns.len();
                let size = (0..d).fold(point(0.0), |sum, a| {
                    sum + (sketch[i][a] - sketch[j][a]).sqr()
                });
                tail.unknowns
                    .push(unknown("r", Role::Positive, 1, [false; 3], size.sqrt()));
                let r = value(Entry::Unknown(k));
                let mut products = squares(&forms);
                products.push(Product::new(-1, r, r));
                say(tail, products, vec![Real::zero()], 2);
                let twice = vec![Product::new(2, r, Form::One)];
                say(tail, twice, length.to_vec(), 1);
            }
            // With a vector of its own: w = p_i − p_j, twisted so that products have different factors.
            3 => {
                let first = tail.unknowns.len();
                for axis in 0..d {
                    let mut flips = [false; 3];
                    flips[axis] = true;
                    let w = sketch[i][axis] - sketch[j][axis];
                    tail.unknowns.push(unknown("w", Role::Free, 1, flips, w));
                    let w = value(Entry::Unknown(first + axis));
                    let products = vec![
                        Product::new(2, w, Form::One),
                        Product::new(-2, forms[axis], Form::One),
                    ];
                    say(tail, products, vec![Real::zero()], 1);
                }
                let w = |axis: usize| value(Entry::Unknown(first + axis));
                let products = (0..d)
                    .map(|axis| Product::new(1, w(axis), forms[axis]))
                    .collect();
                say(tail, products, right.clone(), 2);
            }
            // As (x − y)(x + y) would be: three times the first axis, less it twice.
            _ => {
                let mut products = squares(&forms);
                products.push(Product::new(3, forms[0], forms[0]));
                products.push(Product::new(-3, forms[0], forms[0]));
                say(tail, products, right.clone(), 2);
            }
        }
        *before = Some((squares(&forms), right));
    }
}

/// The problem, every other time in other words.
pub fn every_other_disguised(round: usize, problem: Problem, random: &mut Random) -> Option<Case> {
    if round % 4 < 2 {
        let homotopy = Homotopy::new(&problem).ok()?;
        return Some((problem, homotopy).into());
    }
    let disguised = Disguised::new(&problem, 0.7, random);
    disguised.with_homotopy().map(Case::from)
}

fn unknown(name: &str, role: Role, power: i32, flips: [bool; 3], sketch: Interval) -> Unknown {
    Unknown {
        name: name.to_owned(),
        role,
        power,
        flips,
        sketch,
    }
}

/// The coefficients of ½ a².
fn half_square([a0, a1, a2]: &[Real; 3]) -> Vec<Real> {
    let half = &Real::whole(1) / &Real::whole(2);
    let half = |x: Real| &x * &half;
    vec![
        half(a0 * a0),
        a0 * a1,
        &half(a1 * a1) + &(a0 * a2),
        a1 * a2,
        half(a2 * a2),
    ]
}

pub fn run(homotopy: &Homotopy, reverse: bool) -> Outcome {
    run_in(Space::Full, homotopy, reverse)
}

fn run_in(space: Space, homotopy: &Homotopy, reverse: bool) -> Outcome {
    let options = Options {
        reverse,
        space,
        ..Options::certified()
    };
    track(homotopy, &options, &mut Control::default())
}

/// Whether the solutions of two runs lie in boxes that meet, one by one and in their order.
fn agree(one: &Outcome, other: &Outcome) -> bool {
    let mut pairs = one.solutions.iter().zip(&other.solutions);
    one.solutions.len() == other.solutions.len()
        && pairs.all(|(a, b)| a.class == b.class && boxes_meet(a, b))
}

/// Runs random problems and the same in other words, and compares.
fn compare(space: Space, seed: u64, rounds: usize) {
    let mut random = Random::new(seed);
    let (mut solutions, mut tubes, mut stops) = (0, [0, 0], 0);
    for round in 0..effort(rounds) {
        let dimension = 2 + round % 2;
        let points = dimension + 1 + random.below(5);
        let problem = random_problem(&mut random, dimension, points, 0.1);
        let disguised = Disguised::new(&problem, [0.3, 0.7, 1.0][round % 3], &mut random);
        let Some(homotopy) = disguised.homotopy() else {
            continue;
        };
        let plain = run(&Homotopy::new(&problem).unwrap(), false);
        let other = run_in(space, &homotopy, false);
        if plain.status != Status::Closed {
            continue;
        }
        if space == Space::Reduced && other.status != Status::Closed {
            println!("round {round}: {:?}", other.status);
            stops += 1;
            continue;
        }
        assert_eq!(other.status, Status::Closed, "round {round}: {problem:?}");
        assert!(agree(&plain, &other), "round {round}");
        solutions += plain.solutions.len();
        tubes[0] += plain.steps;
        tubes[1] += other.steps;
    }
    println!("{solutions} solutions, {tubes:?} tubes, {stops} stops");
    assert!(solutions >= 40 && tubes[0] > 1000);
}

#[test]
fn other_words_for_the_same_path_have_the_same_solutions() {
    compare(Space::Full, 77, 80);
}

#[test]
fn in_the_reduced_space_too() {
    compare(Space::Reduced, 78, 80);
}
