//! Figures whose whole path is known: points hung on one edge, or on one triangle.
//!
//! Each such point moves on its own; it has two places, mirror images, which meet where its
//! triangle (tetrahedron) becomes flat. So the path runs between the nearest flat figures on
//! either side of t = 0. If the same point is flat at both, it has two passes; otherwise four.

use super::solutions::check_solutions;
use super::*;
use crate::places::Each as _;
use crate::rational::Rational;
use crate::track::events::halved;
use crate::track::{Control, Options, Status, solve};
use num_bigint::BigInt;
use num_traits::Signed;

/// a(t) in exact numbers.
type Length = [Rational; 3];

fn whole(x: i64) -> Rational {
    Rational::from_integer(x.into())
}

fn decimal(text: &str) -> Rational {
    text.parse::<crate::problem::Decimal>()
        .unwrap()
        .value()
        .clone()
}

/// √x to 150 binary digits.
fn root(x: &Rational) -> Rational {
    let scale: BigInt = BigInt::from(1) << 300;
    let scaled = (x * Rational::from(scale)).floor().to_integer();
    Rational::new(scaled.sqrt(), BigInt::from(1) << 150)
}

/// Where a length polynomial that is positive at 0 becomes zero, nearest on either side of it.
fn zeros([c, b, a]: &Length) -> (Option<Rational>, Option<Rational>) {
    let roots = if a.is_zero() {
        if b.is_zero() { vec![] } else { vec![-c / b] }
    } else {
        let discriminant = b * b - whole(4) * a * c;
        if discriminant.is_negative() {
            vec![]
        } else {
            let d = root(&discriminant);
            vec![(-b + &d) / (whole(2) * a), (-b - &d) / (whole(2) * a)]
        }
    };
    let below = roots.iter().filter(|x| x.is_negative()).max().cloned();
    let above = roots.iter().filter(|x| x.is_positive()).min().cloned();
    (below, above)
}

/// What is known of a path.
#[derive(Debug, PartialEq)]
enum Known {
    /// It has so many solutions, and so many of them up to reflection.
    Path(usize, usize),
    /// It is singular, touches t = 1, or does not come back: no run may close.
    NeverClosed,
    /// Too near to one of these for the arithmetic here.
    Unclear,
}

/// From the places, on either side of 0, where each of the points is flat.
fn known(flat: &[(Option<Rational>, Option<Rational>)], exactly: bool) -> Known {
    let tolerance = if exactly {
        Rational::new(1.into(), BigInt::from(1) << 120)
    } else {
        decimal("1e-7")
    };
    let nearest = |values: Vec<(usize, Rational)>| -> Option<Result<(usize, Rational), ()>> {
        let first = values.iter().min_by_key(|v| v.1.abs())?.clone();
        let ties = values
            .iter()
            .filter(|v| (&v.1 - &first.1).abs() < tolerance)
            .count();
        Some(if ties > 1 { Err(()) } else { Ok(first) })
    };
    let side = |pick: &dyn Fn(usize) -> Option<Rational>| {
        nearest(
            (0..flat.len())
                .filter_map(|k| pick(k).map(|x| (k, x)))
                .collect(),
        )
    };
    let (below, above) = (side(&|k| flat[k].0.clone()), side(&|k| flat[k].1.clone()));
    let doubtful = if exactly {
        Known::NeverClosed
    } else {
        Known::Unclear
    };
    match (below, above) {
        (Some(Ok((l, _))), Some(Ok((u, end)))) => {
            if (&end - whole(1)).abs() < tolerance {
                return doubtful;
            }
            if end < whole(1) {
                return Known::Path(0, 0);
            }
            let passes = if l == u { 2 } else { 4 };
            let all_mirrored = flat.len() == 1 || passes == 4 && flat.len() == 2;
            Known::Path(passes, if all_mirrored { passes / 2 } else { passes })
        }
        (Some(Err(())), _) | (_, Some(Err(()))) => doubtful,
        _ => Known::NeverClosed,
    }
}

/// One text for a length near `base`.
fn near(random: &mut Random, base: i64) -> String {
    match random.below(3) {
        0 => format!("{base}"),
        1 => format!("{:.3}", base as f64 * random.between(0.8, 1.2)),
        _ => {
            let (sign, digits) = (random.below(2), 3 + random.below(10));
            let small = Rational::new(1.into(), BigInt::from(10).pow(digits as u32));
            let value = if sign == 0 {
                whole(base) + small
            } else {
                whole(base) - small
            };
            let scaled = (value * Rational::from(BigInt::from(10).pow(14)))
                .to_integer()
                .to_string();
            format!("{scaled}e-14")
        }
    }
}

/// Points over the edge p1 p2 of length 14, at distances 13 and 15 in the sketch.
fn fan(random: &mut Random) -> (Problem, Known) {
    let count = 1 + random.below(3);
    // The sketch's and the target lengths of the edges, the first being the common one.
    let mut sketch = vec![14];
    let mut names = vec![["p1".to_owned(), "p2".to_owned()]];
    let mut builder = Problem::build("fan", 2)
        .point("p1", [0, 0])
        .point("p2", [14, 0]);
    for k in 0..count {
        let (left, name) = (random.below(2) == 0, format!("q{k}"));
        builder = builder.point(
            &name,
            [
                if left { 5 } else { 9 },
                if random.below(2) == 0 { 12 } else { -12 },
            ],
        );
        sketch.extend(if left { [13, 15] } else { [15, 13] });
        names.extend(["p1", "p2"].map(|p| [p.to_owned(), name.clone()]));
    }
    let mut target: Vec<String> = sketch.iter().map(|&s| near(random, s)).collect();
    if random.below(3) == 0 {
        // A target triangle that is flat or nearly so.
        let tiny = [
            "0", "1e-3", "-1e-3", "1e-6", "-1e-6", "1e-9", "-1e-9", "1e-11", "-1e-11",
        ][random.below(9)];
        let sum = decimal("22") + decimal(tiny);
        target[0] = "14".into();
        target[1] = "8".into();
        let rest = (sum - whole(8) - whole(8)) * Rational::from(BigInt::from(10).pow(12));
        target[2] = format!("{}e-12", rest.to_integer());
    }
    let bend = random.below(sketch.len());
    let c = ["2", "20", "0.5", "200", "0", "-1", "13", "1e4"][random.below(8)];
    for (name, target) in names.iter().zip(&target) {
        builder = builder.distance(&name[0], &name[1], target.as_str());
    }
    let reference = &names[if random.below(2) == 0 {
        0
    } else {
        random.below(names.len())
    }];
    let problem = builder
        .bend(&names[bend])
        .bend_coefficient(c)
        .reference(reference)
        .finish()
        .unwrap();

    let length = |e: usize| -> Length {
        let (from, to) = (whole(sketch[e]), decimal(&target[e]));
        let c = if e == bend {
            decimal(c)
        } else {
            Rational::zero()
        };
        [from.clone(), to - from + &c, -c]
    };
    let combine = |signs: [i64; 3], lengths: [&Length; 3]| -> Length {
        std::array::from_fn(|k| {
            (0..3).fold(Rational::zero(), |sum, i| {
                sum + whole(signs[i]) * &lengths[i][k]
            })
        })
    };
    let base = length(0);
    let flat: Vec<_> = (0..count)
        .map(|k| {
            let (a, b) = (length(1 + 2 * k), length(2 + 2 * k));
            let ends = [[1, 1, -1], [1, -1, 1], [-1, 1, 1]]
                .map(|signs| zeros(&combine(signs, [&base, &a, &b])));
            let below = ends.iter().filter_map(|e| e.0.clone()).max();
            let above = ends.iter().filter_map(|e| e.1.clone()).min();
            (below, above)
        })
        .collect();
    (problem, known(&flat, true))
}

/// Points over a triangle in space, whose height above it is followed in floats.
fn tent(random: &mut Random) -> (Problem, Known) {
    let count = 1 + random.below(3);
    let base = [[0.0, 0.0], [2.0, 0.0], [0.7, 1.9]];
    let mut builder = Problem::build("tent", 3);
    for (k, p) in base.iter().enumerate() {
        builder = builder.point(&format!("p{k}"), [p[0], p[1], 0.0]);
    }
    let size = |x: f64, y: f64, z: f64| (x * x + y * y + z * z).sqrt();
    let mut ends = Vec::new();
    let twins = random.below(2) == 0;
    let mut first: Option<[f64; 3]> = None;
    for k in 0..count {
        let tiny = 10f64.powf(random.between(-5.0, -1.0));
        let place = match first {
            Some(p) if twins => [p[0], p[1], random.sign() * p[2] * (1.0 + rounded(tiny, 6))],
            _ => [
                random.between(-1.0, 2.0),
                random.between(-1.0, 2.0),
                random.sign() * random.between(0.2, 2.0),
            ],
        }
        .each(|x| rounded(x, 7));
        first = first.or(Some(place));
        builder = builder.point(&format!("q{k}"), place);
        for (j, p) in base.iter().enumerate() {
            let sketch = size(place[0] - p[0], place[1] - p[1], place[2]);
            ends.push((
                format!("p{j}"),
                format!("q{k}"),
                sketch,
                rounded(sketch * random.between(0.95, 1.05), 4),
            ));
        }
    }
    let sides: Vec<f64> = [(0, 1), (0, 2), (1, 2)]
        .each(|(i, j): (usize, usize)| size(base[i][0] - base[j][0], base[i][1] - base[j][1], 0.0))
        .into();
    for (k, (i, j)) in [("p0", "p1"), ("p0", "p2"), ("p1", "p2")]
        .into_iter()
        .enumerate()
    {
        builder = builder.distance(i, j, rounded(sides[k], 2));
    }
    for (a, b, _, target) in &ends {
        builder = builder.distance(a, b, *target);
    }
    let bend = random.below(ends.len());
    let c = [2.0, 0.5, 10.0, -0.3][random.below(4)];
    let problem = builder
        .bend([&ends[bend].0, &ends[bend].1])
        .bend_coefficient(c)
        .reference(["p0", "p1", "p2"])
        .finish()
        .unwrap();

    let height = |k: usize, t: f64| {
        let side = |i: usize| sides[i] + t * (rounded(sides[i], 2) - sides[i]);
        let length = |e: usize| {
            let (from, to) = (ends[e].2, ends[e].3);
            let c = if e == bend { c } else { 0.0 };
            from + t * (to - from + c - c * t)
        };
        let (a, b, c) = (side(0), side(1), side(2));
        // The base in the plane: (0, 0), (a, 0), (x2, y2).
        let x2 = (a * a + b * b - c * c) / (2.0 * a);
        let y2 = (b * b - x2 * x2).sqrt();
        let [p, q, r] = [0, 1, 2].each(|j| length(3 * k + j));
        let x = (p * p - q * q + a * a) / (2.0 * a);
        let y = (p * p - r * r + b * b - 2.0 * x * x2) / (2.0 * y2);
        // Lengths must stay positive, too, and the base must not turn over.
        if p.min(q).min(r).min(y2) <= 0.0 || y2.is_nan() {
            f64::NAN
        } else {
            p * p - x * x - y * y
        }
    };
    let mut unclear = false;
    let mut nearest = |k: usize, direction: f64| -> Option<Rational> {
        let step = 1e-3;
        let (mut t, mut before, mut falling) = (0.0, height(k, 0.0), f64::INFINITY);
        while t.abs() < 6.0 {
            let now = height(k, t + direction * step);
            if now.is_nan() {
                unclear = true;
                return None;
            }
            if now < 0.0 {
                let piece = (t, t + direction * step);
                let (low, _) = halved(piece, 80, |t| height(k, t) > 0.0);
                return Rational::from_float(low);
            }
            // A low that could dip below zero between two steps.
            if now > before && falling > before && before < 1e-4 {
                unclear = true;
            }
            (falling, before) = (before, now);
            t += direction * step;
        }
        unclear = true;
        None
    };
    let flat: Vec<_> = (0..count)
        .map(|k| (nearest(k, -1.0), nearest(k, 1.0)))
        .collect();
    let known = if unclear {
        Known::Unclear
    } else {
        known(&flat, false)
    };
    (problem, known)
}

/// Runs a problem of which the path is known, with any settings; true if it closed.
fn check(problem: &Problem, known: &Known, random: &mut Random) -> bool {
    let max_step = [None, None, Some(0.1), Some(10.0)][random.below(4)];
    let options = Options {
        max_step,
        reverse: random.below(2) == 0,
        max_steps: 3000,
        ..Options::certified()
    };
    let outcome = solve(problem, &options, &mut Control::default()).unwrap();
    if outcome.status != Status::Closed {
        return false;
    }
    let classes = outcome
        .solutions
        .iter()
        .map(|s| s.class + 1)
        .max()
        .unwrap_or(0);
    let context = || format!("{problem:#?}\nt in {:?}", outcome.t_range);
    match *known {
        Known::Path(solutions, figures) => {
            assert_eq!(
                (outcome.solutions.len(), classes),
                (solutions, figures),
                "{}",
                context()
            )
        }
        Known::NeverClosed => panic!("closed, but the path is not regular: {}", context()),
        Known::Unclear => {}
    }
    check_solutions(problem, &outcome);
    true
}

fn run(make: fn(&mut Random) -> (Problem, Known), seed: u64, rounds: usize) -> [usize; 4] {
    let mut random = Random::new(seed);
    // Closed paths with and without solutions, paths left open, and those that may not close.
    let mut counts = [0; 4];
    for _ in 0..effort(rounds) {
        let (problem, known) = make(&mut random);
        let closed = check(&problem, &known, &mut random);
        match known {
            Known::Path(0, _) if closed => counts[0] += 1,
            Known::Path(..) if closed => counts[1] += 1,
            Known::Path(..) => counts[2] += 1,
            Known::NeverClosed => counts[3] += 1,
            Known::Unclear => {}
        }
    }
    println!(
        "closed without {} and with {} solutions, not closed {}, never closed {}",
        counts[0], counts[1], counts[2], counts[3]
    );
    counts
}

#[test]
fn fans_in_the_plane() {
    let [without, with, open, never] = run(fan, 6, 400);
    assert!(without > 10 && with > 100 && open < with && never > 5);
}

#[test]
fn tents_in_space() {
    let [_, with, open, _] = run(tent, 7, 150);
    assert!(with > 40 && open < with);
}

/// The target is a triangle that is flat, or misses that by little.
#[test]
fn a_fold_at_the_target() {
    let mut closed = 0;
    for exponent in 0..=40 {
        for sign in [-1, 0, 1] {
            let digits = 2 + exponent;
            let base = BigInt::from(10).pow(digits);
            let scaled: BigInt = base * 2 + sign;
            let problem = Problem::build("fold", 2)
                .point("a", ["0", "0"])
                .point("b", ["2", "0"])
                .point("c", ["1", "1"])
                .distance("a", "b", format!("{scaled}e-{digits}").as_str())
                .distance("b", "c", "1")
                .distance("a", "c", "1")
                .bend_coefficient("1")
                .finish()
                .unwrap();
            let outcome = solve(&problem, &Options::certified(), &mut Control::default()).unwrap();
            if outcome.status == Status::Closed {
                closed += 1;
                // Both other sides get shorter as t nears 1, so a longer base folds before.
                match sign {
                    0 => panic!("a tangency with t = 1 was decided"),
                    1 => assert_eq!(outcome.solutions.len(), 0, "10^-{digits}"),
                    _ => assert_eq!(outcome.solutions.len(), 2, "10^-{digits}"),
                }
                check_solutions(&problem, &outcome);
            }
        }
    }
    println!("{closed} closed");
    assert!(closed > 4);
}
