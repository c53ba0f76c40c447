//! Edits of figures with constraints of many kinds, against fine steps of Newton's method on what the constraints mean:
//! code that shares nothing with krawl's equations. In the sketch's own frame (followed part by part) and up to motions
//! (followed as a whole).

use crate::common::edits::Random;
use krawl::certificate::{Outcome, Settings, Writer, verify};
use krawl::edit::{Ending, OpenError, Session, Setting};
use krawl::problem::Problem;
use krawl::track::{Control, Options, Witness};
use nalgebra::{DMatrix, DVector};
use std::fmt::Write;

/// What a constraint is, and of which points.
#[derive(Debug, Clone)]
enum Meaning {
    Distance([usize; 2]),
    /// Of the first point from the line through the others, on its side.
    FromLine([usize; 3]),
    /// At the middle one: its cosine moves linearly.
    Angle([usize; 3]),
    Perpendicular([usize; 4]),
    Parallel([usize; 4]),
    On([usize; 3]),
    Equal([usize; 4]),
    Midpoint([usize; 3]),
}

use Meaning::*;

/// A constraint with its number, in thousandths.
#[derive(Debug, Clone)]
struct Given {
    meaning: Meaning,
    value: Option<i64>,
}

/// Points in hundredths, constraints, and whether the first point and the direction to the second are fixed.
struct Sketch {
    places: Vec<[f64; 2]>,
    texts: Vec<[String; 2]>,
    given: Vec<Given>,
    absolute: bool,
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Meaning {
    /// What is measured, or what has to be zero.
    fn values(&self, at: &dyn Fn(usize) -> [f64; 2]) -> Vec<f64> {
        let to = |a: usize, b: usize| minus(at(b), at(a));
        let size = |v: [f64; 2]| dot(v, v).sqrt();
        match *self {
            Distance([a, b]) => vec![size(to(a, b))],
            FromLine([p, a, b]) => vec![cross(to(a, b), to(a, p)) / size(to(a, b))],
            Angle([a, b, c]) => {
                let (u, v) = (to(b, a), to(b, c));
                vec![dot(u, v) / (size(u) * size(v))]
            }
            Perpendicular([a, b, c, d]) => vec![dot(to(a, b), to(c, d))],
            Parallel([a, b, c, d]) => vec![cross(to(a, b), to(c, d))],
            On([p, a, b]) => vec![cross(to(a, b), to(a, p))],
            Equal([a, b, c, d]) => vec![dot(to(a, b), to(a, b)) - dot(to(c, d), to(c, d))],
            Midpoint([m, a, b]) => {
                let (u, v) = (to(m, a), to(m, b));
                vec![u[0] + v[0], u[1] + v[1]]
            }
        }
    }

    fn key(&self) -> &'static str {
        match self {
            Distance(_) | FromLine(_) => "distances",
            Angle(_) => "angles",
            Perpendicular(_) => "perpendicular",
            Parallel(_) => "parallel",
            On(_) => "on",
            Equal(_) => "equal",
            Midpoint(_) => "midpoint",
        }
    }

    fn points(&self) -> Vec<usize> {
        match self {
            Distance(p) => p.to_vec(),
            FromLine(p) | Angle(p) | On(p) | Midpoint(p) => p.to_vec(),
            Perpendicular(p) | Parallel(p) | Equal(p) => p.to_vec(),
        }
    }
}

/// What a number in thousandths is as a measure.
fn measure(meaning: &Meaning, value: f64, side: f64) -> f64 {
    match meaning {
        Angle(_) => value.to_radians().cos(),
        FromLine(_) => value * side.signum(),
        _ => value,
    }
}

impl Sketch {
    fn random(random: &mut Random, points: usize, absolute: bool) -> Sketch {
        let mut out = Sketch {
            places: Vec::new(),
            texts: Vec::new(),
            given: Vec::new(),
            absolute,
        };
        for p in 0..points {
            let other = |random: &mut Random| random.below(p);
            let two = |random: &mut Random| {
                let a = random.below(p);
                [a, (a + 1 + random.below(p - 1)) % p]
            };
            let mut at = [0, 0].map(|_: i32| random.between(-100.0, 100.0).round() / 100.0);
            if p == 1 && absolute {
                at[1] = out.places[0][1];
            }
            if p < 2 {
                out.push(at, 2);
                if p == 1 {
                    out.add(Distance([0, 1]));
                }
                continue;
            }
            // A place that meets one constraint exactly, or any place.
            let [a, b] = two(random);
            let [c, d] = two(random);
            let (u, v) = (out.places[a], out.places[b]);
            let along = minus(v, u);
            let part = (random.between(-150.0, 150.0).round() / 100.0, out.places[c]);
            let from = |origin: [f64; 2], w: [f64; 2]| {
                [origin[0] + part.0 * w[0], origin[1] + part.0 * w[1]]
            };
            let place = match random.below(6) {
                0 => Some((
                    from(part.1, [-along[1], along[0]]),
                    Perpendicular([a, b, c, p]),
                )),
                1 => Some((from(part.1, along), Parallel([a, b, c, p]))),
                2 => Some((from(u, along), On([p, a, b]))),
                3 => {
                    let middle = [0.5 * (u[0] + v[0]), 0.5 * (u[1] + v[1])];
                    Some((middle, Midpoint([p, a, b])))
                }
                _ => None,
            };
            let mut missing = 2;
            match place {
                Some((at, meaning)) => {
                    out.push(at, 6);
                    missing -= match meaning {
                        Midpoint(_) => 2,
                        _ => 1,
                    };
                    out.given.push(Given {
                        meaning,
                        value: None,
                    });
                }
                None => out.push(at, 2),
            }
            for _ in 0..missing {
                let e = other(random);
                match random.below(6) {
                    0 => out.add(FromLine([p, c, d])),
                    1 => out.add(Angle([p, a, b])),
                    2 => out.add(Angle([a, p, b])),
                    3 if p > 2 => out.given.push(Given {
                        meaning: Equal([p, e, a, b]),
                        value: None,
                    }),
                    _ => out.add(Distance([p, e])),
                }
            }
        }
        out
    }

    fn push(&mut self, at: [f64; 2], digits: usize) {
        let text = at.map(|x| format!("{x:.digits$}"));
        self.places
            .push(text.each_ref().map(|x| x.parse().unwrap()));
        self.texts.push(text);
    }

    fn add(&mut self, meaning: Meaning) {
        let now = meaning.values(&|p| self.places[p])[0];
        let value = match meaning {
            Angle(_) => now.clamp(-1.0, 1.0).acos().to_degrees(),
            _ => now.abs(),
        };
        let value = Some((1e3 * value).round() as i64);
        self.given.push(Given { meaning, value });
    }

    fn toml(&self) -> String {
        let mut text = "name = \"random\"\ndimension = 2\n[points]\n".to_owned();
        for (p, [x, y]) in self.texts.iter().enumerate() {
            let _ = writeln!(text, "p{p} = [{x}, {y}]");
        }
        text += "[constraints]\n";
        if self.absolute {
            text += "fixed = [\"p0\"]\nhorizontal = [[\"p0\", \"p1\"]]\n";
        }
        for key in [
            "distances",
            "angles",
            "perpendicular",
            "parallel",
            "on",
            "equal",
            "midpoint",
        ] {
            let of_key = self.given.iter().filter(|g| g.meaning.key() == key);
            let entries: Vec<String> = of_key
                .map(|g| {
                    let names = g
                        .meaning
                        .points()
                        .iter()
                        .map(|p| format!("\"p{p}\""))
                        .collect::<Vec<_>>();
                    let value = g.value.map_or(String::new(), |v| format!(", {v}e-3"));
                    format!("[{}{value}]", names.join(", "))
                })
                .collect();
            if !entries.is_empty() {
                let _ = writeln!(text, "{key} = [{}]", entries.join(", "));
            }
        }
        text
    }

    /// What has to be zero: measures less what they are led to.
    fn residual(&self, x: &[f64], wanted: &[f64]) -> DVector<f64> {
        let at = |p: usize| [x[2 * p], x[2 * p + 1]];
        let mut out: Vec<f64> = Vec::new();
        for (given, wanted) in self.given.iter().zip(wanted) {
            let values = given.meaning.values(&at).into_iter();
            out.extend(values.map(|v| v - if given.value.is_some() { *wanted } else { 0.0 }));
        }
        if self.absolute {
            out.extend([
                x[0] - self.places[0][0],
                x[1] - self.places[0][1],
                x[3] - x[1],
            ]);
        }
        DVector::from_vec(out)
    }

    fn jacobian(&self, x: &[f64], wanted: &[f64]) -> DMatrix<f64> {
        const H: f64 = 1e-6;
        let columns: Vec<DVector<f64>> = (0..x.len())
            .map(|k| {
                let moved = |by: f64| {
                    let mut y = x.to_vec();
                    y[k] += by;
                    self.residual(&y, wanted)
                };
                (moved(H) - moved(-H)) / (2.0 * H)
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    fn newton(&self, x: &[f64], wanted: &[f64], first: f64) -> Option<Vec<f64>> {
        let mut x = x.to_vec();
        let mut last = f64::INFINITY;
        for k in 0..10 {
            let (f, j) = (self.residual(&x, wanted), self.jacobian(&x, wanted));
            let step = j.transpose() * (&j * j.transpose()).lu().solve(&f)?;
            let size = step.norm();
            if size < 1e-10 {
                return Some(x);
            }
            if size.is_nan() || size > if k == 0 { first } else { 0.3 * last } {
                return (size < 1e-8).then_some(x);
            }
            x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
            last = size;
        }
        None
    }
}

/// Where fine steps come to: the figure, or the t at which they get no further; `None` after too many of them, as where a
/// figure grows without end.
fn truth(
    sketch: &Sketch,
    start: &[f64],
    from: &[f64],
    to: &[f64],
) -> Option<Result<Vec<f64>, f64>> {
    let mut left = 4000;
    let (mut x, mut t, mut step) = (start.to_vec(), 0.0f64, 2e-3f64);
    while t < 1.0 {
        left -= 1;
        if left == 0 {
            return None;
        }
        let next = (t + step).min(1.0);
        let at: Vec<f64> = from
            .iter()
            .zip(to)
            .map(|(a, b)| a + next * (b - a))
            .collect();
        match sketch.newton(&x, &at, 1e-2) {
            Some(y) => {
                (x, t) = (y, next);
                step = (1.5 * step).min(2e-3);
            }
            None => step *= 0.5,
        }
        if step < 1e-9 {
            return Some(Err(t));
        }
    }
    Some(Ok(x))
}

#[derive(Debug, Default)]
struct Counts {
    reached: usize,
    limits: usize,
    others: usize,
    loose: usize,
    unopened: usize,
}

fn compare(seed: u64, rounds: usize, absolute: bool) -> Counts {
    let (mut random, mut counts) = (Random(seed), Counts::default());
    for _ in 0..rounds {
        let points = 4 + random.below(4);
        let sketch = Sketch::random(&mut random, points, absolute);
        let text = sketch.toml();
        let Ok(problem) = Problem::parse(&text, "random.toml") else {
            counts.loose += 1;
            continue;
        };
        let mut session = match Session::open(&problem) {
            Ok(session) => session,
            Err(OpenError::Correction { .. }) => {
                counts.unopened += 1;
                continue;
            }
            Err(error) => panic!("{error}\n{text}"),
        };
        if !session.account().is_whole() {
            counts.loose += 1;
            continue;
        }
        let numbered: Vec<usize> = (0..sketch.given.len())
            .filter(|&g| sketch.given[g].value.is_some())
            .collect();
        for _ in 0..3 {
            let g = numbered[random.below(numbered.len())];
            let given = &sketch.given[g];
            let wanted = given.value.unwrap() as f64 * random.between(0.7, 1.35);
            let name: Vec<String> = given
                .meaning
                .points()
                .iter()
                .map(|p| format!("p{p}"))
                .collect();
            let name = match given.meaning {
                Distance(_) => name.join("-"),
                _ => format!("{}:{}", given.meaning.key(), name.join("-")),
            };
            let set = format!("{name}={}e-3", wanted.round());
            let Ok(setting) = Setting::parse(&problem, &set) else {
                // The same points may have another constraint with the same name.
                continue;
            };
            let start: Vec<f64> = session.figure().iter().flat_map(|p| [p[0], p[1]]).collect();
            let side = |g: &Given| g.meaning.values(&|p| [start[2 * p], start[2 * p + 1]])[0];
            let all = |change: Option<(usize, f64)>| -> Vec<f64> {
                let of = sketch.given.iter().enumerate().map(|(k, given)| {
                    let value = match (change, given.value) {
                        (Some((changed, value)), _) if changed == k => value,
                        (_, value) => value.unwrap_or(0) as f64,
                    };
                    measure(&given.meaning, 1e-3 * value, side(given))
                });
                of.collect()
            };
            let (from, to) = (all(None), all(Some((g, wanted.round()))));
            let edited = session.probe(&[setting], &mut Control::default());
            let Some(truth) = truth(&sketch, &start, &from, &to) else {
                counts.others += 1;
                continue;
            };
            let about = || format!("--set {set}\n{text}\n{edited:?}\n{truth:?}");
            match (&edited.ending, &truth) {
                (Ending::Reached, Ok(x)) => {
                    counts.reached += 1;
                    // Where nothing fixes the figure it is compared up to motions.
                    let near = |p: usize| [edited.points[p][0].mid(), edited.points[p][1].mid()];
                    let far = |p: usize| [x[2 * p], x[2 * p + 1]];
                    let n = sketch.places.len();
                    let off = (0..n)
                        .flat_map(|p| (0..p).flat_map(move |q| (0..q).map(move |r| [p, q, r])))
                        .map(|[p, q, r]| {
                            let area = |at: &dyn Fn(usize) -> [f64; 2]| {
                                cross(minus(at(q), at(p)), minus(at(r), at(p)))
                            };
                            (area(&near) - area(&far)).abs()
                        })
                        .fold(0.0, f64::max);
                    let scale = x.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
                    assert!(off < 1e-5 * scale * scale, "{off} {}", about());
                    for (points, sign) in &edited.orientations.kept {
                        let [a, b, c] = [points[0], points[1], points[2]].map(far);
                        let area = cross(minus(b, a), minus(c, a));
                        assert!(area * f64::from(*sign) > -1e-7, "{points:?} {}", about());
                    }
                }
                (Ending::Limit(_), Err(t)) => {
                    counts.limits += 1;
                    let (low, high) = edited.t;
                    assert!(*t <= high + 1e-6 && *t > low - 1e-3, "{t} {}", about());
                }
                (Ending::Passes(_) | Ending::Stopped(_), _) => counts.others += 1,
                // Fine steps are refused where the figure runs: what is claimed is looked at by itself.
                (Ending::Reached, Err(_)) => {
                    let at = |p: usize| [edited.points[p][0].mid(), edited.points[p][1].mid()];
                    let x: Vec<f64> = (0..sketch.places.len()).flat_map(at).collect();
                    assert!(sketch.residual(&x, &to).amax() < 1e-6, "{}", about());
                    counts.others += 1;
                }
                (Ending::Limit(_), Ok(_)) => panic!("{}", about()),
            }
        }
    }
    counts
}

/// What is proved with a certificate is what is proved without one, and the certificate is verified. Counts edits that are
/// verified, those that come to an end in one of the two ways only, and those that the checker does not prove.
fn certified(seed: u64, rounds: usize, absolute: bool) -> [usize; 3] {
    let (mut random, mut counts) = (Random(seed), [0; 3]);
    for _ in 0..rounds {
        let points = 4 + random.below(3);
        let sketch = Sketch::random(&mut random, points, absolute);
        let text = sketch.toml();
        let Ok(problem) = Problem::parse(&text, "random.toml") else {
            continue;
        };
        let Ok(mut session) = Session::open(&problem) else {
            continue;
        };
        let dimensions: Vec<usize> = problem.dimensions().collect();
        let index = dimensions[random.below(dimensions.len())];
        let now = session.length(index).mid();
        let wanted = (1e3 * now * random.between(0.7, 1.35)).round();
        let wanted = format!("{wanted}e-3").parse().unwrap();
        let Ok(setting) = Setting::new(&problem, index, wanted) else {
            continue;
        };
        let plain = session.edit(std::slice::from_ref(&setting));
        let mut writer = Writer::new(Vec::new(), &problem);
        let mut control = Control {
            witness: Some(&mut writer as &mut dyn Witness),
            ..Control::default()
        };
        let Ok(mut whole) = Session::open_with(&problem, &Options::certified(), &mut control)
        else {
            counts[1] += 1;
            continue;
        };
        let edited = whole.edit_with(&[setting], &mut control);
        let bytes = writer.finish().unwrap();
        let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
        let about = || format!("{text}\n{plain:?}\n{edited:?}\n{:?}", verdict.outcome);
        match (&plain.ending, &edited.ending) {
            (Ending::Reached, Ending::Reached) | (Ending::Limit(_), Ending::Limit(_)) => {
                // Of tubes in more than 53 bits, and of numbers far apart, the checker proves most, not all.
                if matches!(verdict.outcome, Outcome::NotProved(_)) {
                    counts[2] += 1;
                    continue;
                }
                assert_eq!(verdict.outcome, Outcome::Verified, "{}", about());
                assert!(verdict.is_about(&problem), "{}", about());
                let t = verdict.arcs.last().unwrap().t;
                assert!(t.sup() >= plain.t.0 && t.inf() <= plain.t.1, "{}", about());
                // Up to motions the checker's figure stands elsewhere.
                let there = plain
                    .points
                    .iter()
                    .zip(&edited.points)
                    .flat_map(|(a, b)| a.iter().zip(b));
                for (a, b) in there {
                    assert!(
                        (a.mid() - b.mid()).abs() < 1e-7 * (1.0 + a.mid().abs()),
                        "{}",
                        about()
                    );
                }
                counts[0] += 1;
            }
            (Ending::Reached, Ending::Limit(_)) | (Ending::Limit(_), Ending::Reached) => {
                panic!("{}", about())
            }
            (_, Ending::Passes(_) | Ending::Stopped(_)) => {
                assert!(
                    matches!(verdict.outcome, Outcome::Partial(_)),
                    "{}",
                    about()
                );
                counts[1] +=
                    usize::from(matches!(plain.ending, Ending::Reached | Ending::Limit(_)));
            }
            _ => counts[1] += 1,
        }
    }
    counts
}

#[test]
fn certificates_of_edits_are_verified_in_both_frames() {
    for (seed, absolute) in [(19, true), (20, false)] {
        let counts = certified(seed, 60, absolute);
        println!("{counts:?}");
        assert!(
            counts[0] > 15 && counts[1] <= counts[0] / 8 && counts[2] == 0,
            "{counts:?}"
        );
    }
}

#[test]
fn edits_in_the_sketchs_own_frame_are_the_continuation() {
    let counts = compare(15, 70, true);
    println!("{counts:?}");
    assert!(counts.reached > 60 && counts.limits > 5, "{counts:?}");
}

#[test]
fn edits_up_to_motions_are_the_continuation() {
    let counts = compare(16, 70, false);
    println!("{counts:?}");
    assert!(counts.reached > 60 && counts.limits > 5, "{counts:?}");
}

#[test]
#[ignore = "minutes"]
fn edits_of_mixed_constraints_many_times() {
    println!("{:?}", compare(17, 1500, true));
    println!("{:?}", compare(18, 1500, false));
    println!("{:?}", certified(21, 1000, true));
    println!("{:?}", certified(22, 1000, false));
}
