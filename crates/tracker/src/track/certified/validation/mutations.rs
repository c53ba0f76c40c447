//! Faults in the coefficients of equations that are no distances: each is seen by what checks the computed numbers
//! and their bounds against 256 bits, for every kind of constraint.
//!
//! Coefficients are put in place three times: as products in lanes (F, its coefficients along a path, and the bounds
//! of tubes), as rows of the Jacobian (the reduced space), and as a sparse matrix (the full space).

use super::precise::big::{Big, dot, exact};
use super::precise::{Figure, OWN};
use super::*;
use crate::constraint::try_lower;
use crate::track::full::{Forms, Lengths, Part, Tail};
use std::collections::BTreeMap;

/// A coefficient is wrong by that much.
const WRONG: f64 = 1.0 + 1e-9;

/// What the numbers of one equation at one point are checked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Check {
    Residual,
    Direction,
    Bound,
    Row,
    Sparse,
}

/// What is true of one equation at a point: its residual, its row of the Jacobian, and the sum of its terms without signs.
struct Truth {
    residual: Big,
    row: Vec<Big>,
    size: Big,
}

/// Which checks fail for an equation of the tail at a point, along a direction.
fn failures(
    equations: &Equations,
    truth: &Truth,
    e: usize,
    (z, v): (&Vector, &Vector),
) -> Vec<Check> {
    let (m, n, tail) = (equations.m, equations.n(), &equations.tail);
    let (mut d, mut dv, mut none) = (equations.room(), equations.room(), equations.room());
    let mut lengths = Lengths::new(equations);
    let (mut f, mut error) = (equations.vector(), equations.vector());
    let misses = |computed: f64, error: f64, exact: &Big| {
        (exact - &Big::of(computed)).abs() > Big::of(error) + Big::of(OWN)
    };
    let mut out = Vec::new();
    equations.residual_at((z, None), (&mut d, &mut lengths), &mut f, Some(&mut error));
    if misses(f[e], error[e], &truth.residual) {
        out.push(Check::Residual);
    }
    equations.directions(v, &mut dv);
    equations.jacobian_times(&d, &lengths, &dv, v[m], &mut f[..m]);
    // Of the point itself.
    equations.sums(&equations.vector(), &mut none);
    equations.jacobian_times_error((&d, z[m]), (&none, 0.0), (&dv, v[m]), &mut error[..m]);
    if misses(f[e], error[e], &dot(&truth.row, &exact(&v[..n]))) {
        out.push(Check::Direction);
    }
    // The terms of F without signs, as they are added up for tubes.
    let mut bound = equations.per_edge();
    tail.add_squares_abs(1.0, &d.forms, &mut bound);
    if Big::of(bound[e] * (1.0 + 1e-12)) < truth.size {
        out.push(Check::Bound);
    }
    // Entries of the row, each with a bound on its terms.
    let (mut values, mut sizes) = (vec![0.0; tail.entries()], vec![0.0; tail.entries()]);
    tail.row_values(&d.forms, &mut values);
    let mut absolute = Forms::new(tail);
    absolute.set(tail, |form| d.forms[form].abs());
    tail.row_sizes(&absolute, &mut sizes);
    let per_term = gamma(equations.roundings().of_row_at_point());
    let wrong = |entry: usize| {
        let error = round_up(
            per_term * sizes[entry],
            equations.roundings().of_row_bound(),
        );
        misses(values[entry], error, &truth.row[tail.unknown(entry)])
    };
    if tail.row(e).any(wrong) {
        out.push(Check::Row);
    }
    let mut sums: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
    for ([of, column], value) in tail.sparse(&d.forms) {
        if of == e {
            let (sum, size) = sums.entry(column).or_default();
            *sum += value;
            *size += value.abs();
        }
    }
    let wrong = |(&column, &(sum, size)): (&usize, &(f64, f64))| {
        let error = round_up(per_term * size, equations.roundings().of_row_bound());
        misses(sum, error, &truth.row[column])
    };
    if sums.iter().any(wrong) {
        out.push(Check::Sparse);
    }
    out
}

/// By kind of constraint how many faults of each sort were seen.
type Tally = BTreeMap<String, [usize; 4]>;

fn mutate(problem: &Problem, random: &mut Random, tally: &mut Tally) {
    let homotopy = Homotopy::new(problem).unwrap();
    let figure = Figure::new(problem, &homotopy);
    let sound = Equations::new(&homotopy);
    let Ok(lowered) = try_lower(problem) else {
        panic!("{}", problem.to_toml())
    };
    let (m, n) = (sound.m, sound.n());
    let (mut z, mut v) = (sketch(&homotopy, &sound), sound.vector());
    for z in &mut z[..m] {
        *z += random.between(-0.3, 0.3);
    }
    z[m] = random.between(0.0, 1.0);
    v[..n]
        .iter_mut()
        .for_each(|v| *v = random.between(-1.0, 1.0));
    let (mut d, mut dv) = (sound.room(), sound.room());
    sound.differences(&z, &mut d);
    sound.directions(&v, &mut dv);
    let there = exact(&z[..n]);
    let (residuals, rows) = (figure.residual(&there), figure.jacobian(&there));
    let objects = problem.objects.len();
    for e in sound.tail.first()..m {
        let owner = lowered.owners[e - homotopy.edges.len()];
        let kind = match owner.checked_sub(objects) {
            Some(k) => match problem.constraints.get(k) {
                Some(constraint) => constraint.kind.clone(),
                None => "place".to_owned(),
            },
            None => "object".to_owned(),
        };
        let truth = Truth {
            residual: residuals[e].clone(),
            row: rows[e].clone(),
            size: figure.size(e, &there),
        };
        let at = (&z, &v);
        let failed = failures(&sound, &truth, e, at);
        assert_eq!(failed, [], "{}: {}", homotopy.names[e], problem.to_toml());
        let counts = tally.entry(kind).or_default();
        let mut see = |part: Part, k: usize, by: f64, check: Check, sort: usize| {
            let mut wrong = sound.clone();
            wrong.tail.spoil(e, part, k, by);
            let failed = failures(&wrong, &truth, e, at);
            assert!(
                failed.contains(&check),
                "{check:?} saw nothing: {}, {part:?} {k} by {by}: {}",
                homotopy.names[e],
                problem.to_toml()
            );
            counts[sort] += 1;
        };
        // Faults that matter at this point: some products are zero there.
        let products: Vec<(f64, [usize; 2])> = sound.tail.products(e).collect();
        let value = |&(half, [l, r]): &(f64, [usize; 2])| half * d.forms[l] * d.forms[r];
        let change = |&(half, [l, r]): &(f64, [usize; 2])| {
            half * (d.forms[l] * dv.forms[r] + dv.forms[l] * d.forms[r])
        };
        let matters = |of: &dyn Fn(&(f64, [usize; 2])) -> f64, k: usize| {
            let all: f64 = products.iter().map(|p| of(p).abs()).sum();
            of(&products[k]).abs() > 1e-3 * all
        };
        for k in 0..products.len() {
            if matters(&value, k) {
                see(Part::Product, k, WRONG, Check::Residual, 0);
                // A product that a bound leaves out.
                see(Part::Product, k, 0.0, Check::Bound, 1);
            }
            if matters(&change, k) {
                see(Part::Product, k, WRONG, Check::Direction, 0);
            }
        }
        let of_row = |tail: &Tail| {
            let mut values = vec![0.0; tail.entries()];
            tail.row_values(&d.forms, &mut values);
            values
        };
        let of_sparse = |tail: &Tail| -> Vec<f64> {
            let all = tail.sparse(&d.forms).into_iter();
            all.map(|(_, value)| value).collect()
        };
        let changes = |part: Part, k: usize, of: &dyn Fn(&Tail) -> Vec<f64>| {
            let mut wrong = sound.tail.clone();
            wrong.spoil(e, part, k, 2.0);
            let pairs = of(&wrong).into_iter().zip(of(&sound.tail));
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > 1e-3
        };
        for k in 0..sound.tail.row(e).len() {
            if changes(Part::Entry, k, &of_row) {
                see(Part::Entry, k, WRONG, Check::Row, 2);
            }
        }
        let sources = sound.tail.sparse(&d.forms);
        for k in 0..sources.iter().filter(|(at, _)| at[0] == e).count() {
            if changes(Part::Source, k, &of_sparse) {
                see(Part::Source, k, WRONG, Check::Sparse, 3);
            }
        }
    }
}

#[test]
fn wrong_coefficients_are_seen_for_every_kind_of_constraint() {
    let (mut random, mut tally) = (Random::new(23), Tally::new());
    for round in 0..effort(150) {
        let problem = mixed_problem(&mut random, 2 + round % 2);
        mutate(&problem, &mut random, &mut tally)
    }
    println!("{tally:#?}");
    assert!(tally.len() >= 18, "{:?}", tally.keys());
    for (kind, counts) in &tally {
        assert!(counts.iter().all(|&count| count > 0), "{kind}: {counts:?}");
    }
}
