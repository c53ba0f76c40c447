//! Sketches that fall apart: figures are all combinations of what parts have that do not depend on each other. Counts are those of formulas, and of points constructed one after the
//! other on every side, in floats.

use crate::common::covers::{is_harmless, proved, searched};
use crate::common::edits::Random;
use krawl::certificate::cover::coordinates::{
    Case, CoordinateCover, Independent, Mark, signs_changed,
};
use krawl::certificate::cover::verify_cover;
use krawl::complete::{Options, Status, all};
use krawl::constraint::symmetry;
use krawl::interval::Interval;
use krawl::problem::Problem;
use krawl::system::{Homotopy, typical_length};
use std::collections::BTreeSet;
use std::fmt::Write;

fn parse(text: &str) -> Problem {
    Problem::parse(text, "test.toml").unwrap()
}

/// A point that is constructed from ones before it.
#[derive(Debug, Clone, Copy)]
enum Step {
    /// At a distance from each of two points.
    Compass([usize; 2]),
    /// As high as a point, at a distance from it.
    Level(usize),
    /// Above or below a point, at a distance from it.
    Plumb(usize),
}

/// Points of which the first two are fixed, at (0, 0) and (8, 0), and how each of the others is constructed.
struct Construction {
    places: Vec<[f64; 2]>,
    steps: Vec<Step>,
}

fn length(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

/// A number of a file: hundredths.
fn hundredths(x: f64) -> f64 {
    (100.0 * x).round() / 100.0
}

impl Construction {
    fn random(random: &mut Random, points: usize) -> Self {
        let mut new = Construction {
            places: vec![[0.0, 0.0], [8.0, 0.0]],
            steps: Vec::new(),
        };
        while new.places.len() < points {
            let count = new.places.len();
            let from = random.below(count);
            let near = new.places[from];
            let by = hundredths(random.between(1.0, 6.0));
            let (step, place) = match random.below(3) {
                0 => (Step::Level(from), [near[0] + by, near[1]]),
                1 => (Step::Plumb(from), [near[0], near[1] - by]),
                _ => {
                    let other = random.below(count);
                    if other == from {
                        continue;
                    }
                    let place = [0, 1].map(|_| random.between(-9.0, 9.0));
                    (Step::Compass([from, other]), place)
                }
            };
            new.places.push(place);
            new.steps.push(step);
        }
        new
    }

    /// The distances of a point from those that it is constructed from.
    fn lengths(&self, k: usize) -> Vec<(usize, f64)> {
        let from = match self.steps[k - 2] {
            Step::Compass(both) => both.to_vec(),
            Step::Level(from) | Step::Plumb(from) => vec![from],
        };
        let length = |from| hundredths(length(self.places[k], self.places[from]));
        from.into_iter().map(|from| (from, length(from))).collect()
    }

    fn problem(&self) -> Problem {
        let mut text = String::from("name = \"construction\"\ndimension = 2\n[points]\n");
        for (k, [x, y]) in self.places.iter().enumerate() {
            writeln!(text, "p{k} = [{x:?}, {y:?}]").unwrap();
        }
        text.push_str("[constraints]\nfixed = [\"p0\", \"p1\"]\n");
        let list = |of: &dyn Fn(usize) -> Vec<String>| {
            let all: Vec<String> = (2..self.places.len()).flat_map(of).collect();
            all.join(", ")
        };
        let distances = list(&|k| {
            let lengths = self.lengths(k).into_iter();
            lengths
                .map(|(from, d)| format!("[\"p{from}\", \"p{k}\", {d:?}]"))
                .collect()
        });
        let level = list(&|k| match self.steps[k - 2] {
            Step::Level(from) => vec![format!("[\"p{from}\", \"p{k}\"]")],
            _ => Vec::new(),
        });
        let plumb = list(&|k| match self.steps[k - 2] {
            Step::Plumb(from) => vec![format!("[\"p{from}\", \"p{k}\"]")],
            _ => Vec::new(),
        });
        for (key, list) in [
            ("distances", distances),
            ("horizontal", level),
            ("vertical", plumb),
        ] {
            if !list.is_empty() {
                writeln!(text, "{key} = [{list}]").unwrap();
            }
        }
        parse(&text)
    }

    /// How many figures there are, by constructing them; `None` where that is not clear in floats.
    fn count(&self) -> Option<u64> {
        let mut all = vec![self.places[..2].to_vec()];
        for k in 2..self.places.len() {
            let mut next = Vec::new();
            for figure in all {
                let lengths = self.lengths(k);
                let [x, y] = figure[lengths[0].0];
                let d = lengths[0].1;
                let places = match self.steps[k - 2] {
                    Step::Level(_) => vec![[x - d, y], [x + d, y]],
                    Step::Plumb(_) => vec![[x, y - d], [x, y + d]],
                    Step::Compass([_, other]) => {
                        let [u, v] = figure[other];
                        let (base, r) = (length([x, y], [u, v]), lengths[1].1);
                        if base < 1e-6 {
                            return None;
                        }
                        let along = (base * base + d * d - r * r) / (2.0 * base);
                        let square = d * d - along * along;
                        if square.abs() < 1e-3 {
                            return None;
                        }
                        let (dx, dy) = ((u - x) / base, (v - y) / base);
                        let heights = if square > 0.0 {
                            vec![-1.0, 1.0]
                        } else {
                            Vec::new()
                        };
                        let place = |side: f64| {
                            let h = side * square.sqrt();
                            [x + along * dx - h * dy, y + along * dy + h * dx]
                        };
                        heights.into_iter().map(place).collect()
                    }
                };
                next.extend(places.into_iter().map(|place| {
                    let mut figure = figure.clone();
                    figure.push(place);
                    figure
                }));
            }
            all = next;
        }
        Some(all.len() as u64)
    }
}

#[test]
fn points_constructed_one_after_the_other_have_as_many_places_as_sides() {
    let mut random = Random(13);
    let (mut apart, mut tried) = (0, 0);
    for _ in 0..120 {
        let points = 4 + random.below(6);
        let construction = Construction::random(&mut random, points);
        let Some(count) = construction.count() else {
            continue;
        };
        tried += 1;
        let problem = construction.problem();
        let (result, cover) = searched(&problem);
        let steps = &construction.steps;
        assert_eq!(
            result.status,
            Status::Complete,
            "{steps:?}\n{}",
            problem.to_toml()
        );
        assert_eq!(
            result.count,
            Some(count),
            "{steps:?}\n{}",
            problem.to_toml()
        );
        let verdict = verify_cover(&cover.to_bytes()).unwrap();
        assert!(
            verdict.proves_all(),
            "{:?}\n{}",
            verdict.flaw,
            problem.to_toml()
        );
        assert_eq!(verdict.solutions, Some(count));
        let product: usize = result.choices.iter().map(|choice| choice.count).product();
        assert!(result.choices.is_empty() || product as u64 == count);
        apart += usize::from(!result.choices.is_empty());
        // What is listed is different, and as long as is wanted.
        let mut seen = BTreeSet::new();
        for solution in &result.solutions {
            let near = |x: &Interval| (x.mid() * 1e6).round() as i64;
            let places = solution.points.iter().flatten().map(near);
            assert!(seen.insert(places.collect::<Vec<_>>()), "{steps:?}");
            for (k, (from, d)) in (2..construction.places.len())
                .flat_map(|k| construction.lengths(k).into_iter().map(move |l| (k, l)))
            {
                let [p, q] = [k, from].map(|i| solution.points[i]);
                let square = (p[0] - q[0]).sqr() + (p[1] - q[1]).sqr();
                assert!(square.inf() <= d * d + 1e-9 && d * d - 1e-9 <= square.sup());
                assert!(square.wid() < 1e-9);
            }
        }
    }
    assert!(tried > 90 && apart > 40, "{apart} of {tried}");
}

/// Holes of a plate, each at given distances from two fixed points.
fn holes(count: usize) -> Problem {
    let mut text =
        String::from("name = \"holes\"\ndimension = 2\n[points]\no = [0, 0]\np = [10, 0]\n");
    let mut distances = Vec::new();
    for k in 0..count {
        let (x, y) = (1.0 + 0.1 * k as f64, 2.0 + 0.01 * k as f64);
        writeln!(text, "h{k} = [{x:?}, {y:?}]").unwrap();
        for (from, d) in [("o", x.hypot(y)), ("p", (10.0 - x).hypot(y))] {
            distances.push(format!("[\"{from}\", \"h{k}\", {d:.3}]"));
        }
    }
    let distances = distances.join(", ");
    writeln!(
        text,
        "[constraints]\nfixed = [\"o\", \"p\"]\ndistances = [{distances}]"
    )
    .unwrap();
    parse(&text)
}

#[test]
fn each_hole_doubles_what_the_others_have() {
    for count in [1, 2, 3, 6, 20] {
        let (result, cover) = searched(&holes(count));
        assert_eq!(
            (result.status, result.count),
            (Status::Complete, Some(1 << count))
        );
        // All of them, or the first ones.
        let listed = if count < 20 { 1 << count } else { 1000 };
        assert_eq!(result.solutions.len(), listed);
        // Any two boxes are disjoint along an axis at one of the holes.
        for (k, one) in result.solutions.iter().take(100).enumerate() {
            for other in &result.solutions[..k] {
                let pairs = one.points.iter().zip(&other.points);
                let mut axes = pairs.flat_map(|(p, q)| p.iter().zip(q));
                assert!(axes.any(|(x, y)| x.disjoint(*y)), "{k}");
            }
        }
        // One for the first figure, and one for the other place of each hole.
        let figures = if count > 1 { 1 + count } else { 2 };
        assert_eq!(cover.figures.len(), figures);
        let verdict = verify_cover(&cover.to_bytes()).unwrap();
        assert!(verdict.proves_all());
        assert_eq!(verdict.solutions, Some(1 << count));
        if count > 1 {
            let names: Vec<_> = result
                .choices
                .iter()
                .map(|choice| choice.names.join(" "))
                .collect();
            assert_eq!(
                names,
                (0..count).map(|k| format!("h{k}")).collect::<Vec<_>>()
            );
        }
    }
}

#[test]
fn more_than_can_be_counted() {
    let (result, cover) = searched(&holes(70));
    assert_eq!((result.status, result.count), (Status::Complete, None));
    assert_eq!(result.choices.len(), 70);
    let verdict = verify_cover(&cover.to_bytes()).unwrap();
    assert!(verdict.proves_all());
    assert_eq!(verdict.solutions, None);
    assert_eq!(result.solutions.len(), 1000);
}

/// Points on rays from a, at both sides of a-b, which is given, or fixed by what is said `more`.
fn rays(count: usize, more: &str) -> Problem {
    let mut text =
        String::from("name = \"rays\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\n");
    let (mut distances, mut angles) = (Vec::new(), Vec::new());
    if more.is_empty() {
        distances.push("[\"a\", \"b\", 4]".to_owned());
    }
    for k in 0..count {
        let (angle, d) = (30.0 + 10.0 * k as f64, 2.0 + 0.5 * k as f64);
        let (y, x) = angle.to_radians().sin_cos();
        writeln!(text, "c{k} = [{:?}, {:?}]", d * x, d * y).unwrap();
        distances.push(format!("[\"a\", \"c{k}\", {d:?}]"));
        angles.push(format!("[\"b\", \"a\", \"c{k}\", {angle:?}]"));
    }
    let (distances, angles) = (distances.join(", "), angles.join(", "));
    writeln!(
        text,
        "[constraints]\ndistances = [{distances}]\nangles = [{angles}]\n{more}"
    )
    .unwrap();
    parse(&text)
}

#[test]
fn mirror_images_count_once() {
    for count in 1..7 {
        let (result, _) = proved(&rays(count, ""));
        assert_eq!(result.count, Some(1 << (count - 1)));
        assert!(
            result.choices.len() == count - 1 || count < 3,
            "{:?}",
            result.choices
        );
    }
    // Said where it is, each by itself.
    let (result, _) = proved(&rays(3, "fixed = [\"a\", \"b\"]"));
    assert_eq!(result.count, Some(8));
}

/// Of equal gaps in a row one is given: each of the others goes to either side.
#[test]
fn a_row_of_equal_gaps_falls_apart() {
    for count in [2, 5, 14] {
        let mut text = String::from("name = \"row\"\ndimension = 2\n[points]\n");
        for k in 0..=count {
            writeln!(text, "p{k} = [{:?}, 0.0]", 1.5 * k as f64).unwrap();
        }
        let level = (1..=count).map(|k| format!("[\"p{}\", \"p{k}\"]", k - 1));
        let equal = (2..=count)
            .map(|k| format!("[\"p{}\", \"p{}\", \"p{}\", \"p{k}\"]", k - 2, k - 1, k - 1));
        let (level, equal): (Vec<_>, Vec<_>) = (level.collect(), equal.collect());
        writeln!(
            text,
            "[constraints]\nfixed = [\"p0\"]\nhorizontal = [{}]\nequal = [{}]\ndistances = [[\"p0\", \"p1\", 1.5]]",
            level.join(", "),
            equal.join(", ")
        )
        .unwrap();
        let (result, cover) = searched(&parse(&text));
        assert_eq!(
            (result.status, result.count),
            (Status::Complete, Some(1 << count))
        );
        assert_eq!(cover.figures.len(), 1 + count);
        assert!(verify_cover(&cover.to_bytes()).unwrap().proves_all());
    }
}

/// A midpoint of a fixed point: its differences begin in the base, and its equation is not of the base alone.
#[test]
fn equations_that_begin_in_the_base_are_of_a_part() {
    let problem = parse(
        "dimension = 2\n[points]\no = [0, 0]\np = [10, 0]\nh = [5, 5]\ng = [6, 3]\nc = [-5, -5]\n[constraints]\n\
         fixed = [\"o\", \"p\"]\nmidpoint = [[\"o\", \"h\", \"c\"]]\n\
         distances = [[\"o\", \"h\", 7], [\"p\", \"h\", 7], [\"o\", \"g\", 6.7], [\"p\", \"g\", 5]]",
    );
    let (result, cover) = proved(&problem);
    assert_eq!((result.count, cover.figures.len()), (Some(4), 3));
    // An unknown that equations outside of the base tell, too, is not of it.
    for unknown in 0..cover.figures[0].len() {
        let mut other = cover.clone();
        other.base = vec![unknown];
        let parts = vec![Independent {
            equations: (0..cover.figures[0].len())
                .filter(|&e| e != unknown)
                .collect(),
            figures: vec![1, 2],
        }];
        other.cases = vec![Case { first: 0, parts }];
        assert!(verify_cover(&other.to_bytes()).unwrap().flaw.is_some());
    }
}

/// A part without any zero: no figure, whatever the others have.
#[test]
fn a_part_without_a_zero_leaves_nothing() {
    // On a circle around o, of which all is farther from p.
    let text = r#"
        dimension = 2
        [points]
        o = [0, 0]
        p = [10, 0]
        h = [5, 5]
        g = [6, 3]
        c = [2, 0.5]
        [circles]
        k = { center = "o", radius = 2 }
        [constraints]
        fixed = ["o", "p"]
        radii = [["k", 2]]
        on = [["c", "k"]]
        distances = [["o", "h", 7], ["p", "h", 7], ["o", "g", 6.7], ["p", "g", 5], ["p", "c", 3]]
        "#;
    let result = all(&parse(text), &Options::default()).unwrap();
    assert_eq!(
        (result.status, result.count),
        (Status::Complete, Some(0)),
        "{text}"
    );
    assert!(result.solutions.is_empty() && result.choices.is_empty());
}

/// The first solution is where parts are looked at: a mirror image of it may be where no unknown is looked at.
#[test]
fn the_first_solution_is_in_the_space_that_is_looked_at() {
    let problem = rays(4, "");
    let (_, cover) = proved(&problem);
    let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
    let mirrored = signs_changed(&homotopy, symmetry(&problem), &cover.halves[0].by).unwrap();
    for k in 0..cover.figures.len() {
        let mut other = cover.clone();
        for (x, _) in other.figures[k]
            .iter_mut()
            .zip(&mirrored)
            .filter(|(_, turn)| **turn)
        {
            *x = -*x;
        }
        assert!(verify_cover(&other.to_bytes()).unwrap().flaw.is_some());
    }
}

#[test]
fn damaged_covers_prove_no_other_number() {
    for (problem, count) in [(holes(3), 8), (rays(4, ""), 8)] {
        let (_, cover) = searched(&problem);
        assert!(verify_cover(&cover.to_bytes()).unwrap().proves_all());
        let parts = cover.cases[0].parts.len();
        assert!(parts >= 3);
        let mut refused = 0;
        let mut is_refused = |changed: CoordinateCover| {
            assert!(is_harmless(&changed, count), "{changed:?}");
            let verdict = verify_cover(&changed.to_bytes());
            refused += usize::from(!verdict.is_ok_and(|verdict| verdict.proves_all()));
        };
        for k in 0..parts {
            // A place less, with all that names it.
            let mut fewer = cover.clone();
            if let Some(figure) = fewer.cases[0].parts[k].figures.pop() {
                is_refused(fewer.clone());
                fewer.figures.remove(figure);
                for part in &mut fewer.cases[0].parts {
                    part.figures
                        .iter_mut()
                        .filter(|f| **f > figure)
                        .for_each(|f| *f -= 1);
                }
                is_refused(fewer);
            }
            // The first solution once more.
            let mut twice = cover.clone();
            twice.figures.push(twice.figures[0].clone());
            let last = twice.figures.len() - 1;
            twice.cases[0].parts[k].figures.push(last);
            is_refused(twice.clone());
            // One that differs in several parts: its combinations are others.
            let mixed = (0..twice.figures[0].len()).map(|i| {
                let moved = (1..last).map(|f| cover.figures[f][i] - cover.figures[0][i]);
                cover.figures[0][i] + moved.sum::<f64>()
            });
            twice.figures[last] = mixed.collect();
            is_refused(twice);
            for other in 0..parts {
                if other == k {
                    continue;
                }
                // Two parts as one, whose combinations are not listed; and an equation in the wrong one.
                let mut merged = cover.clone();
                let taken = std::mem::take(&mut merged.cases[0].parts[other]);
                merged.cases[0].parts[k].equations.extend(&taken.equations);
                merged.cases[0].parts[k].figures.extend(&taken.figures);
                merged.cases[0].parts.remove(other);
                is_refused(merged);
                let mut moved = cover.clone();
                if let Some(equation) = moved.cases[0].parts[other].equations.pop() {
                    moved.cases[0].parts[k].equations.push(equation);
                }
                is_refused(moved);
                let mut moved = cover.clone();
                if let Some(figure) = moved.cases[0].parts[other].figures.pop() {
                    moved.cases[0].parts[k].figures.push(figure);
                }
                is_refused(moved);
            }
        }
        let mut without = cover.clone();
        without.cases.clear();
        is_refused(without.clone());
        without.base.clear();
        is_refused(without);
        let mut moved = cover.clone();
        moved.cases[0].parts.push(Independent::default());
        is_refused(moved);
        for unknown in 0..cover.figures[0].len() {
            let mut other = cover.clone();
            match other.base.iter().position(|&i| i == unknown) {
                Some(place) => drop(other.base.remove(place)),
                None => other.base.push(unknown),
            }
            is_refused(other);
        }
        assert!(refused > 30, "{refused}");
        // Any mark in the place of any other.
        let (mut at, mut marks) = (0, Vec::new());
        while at < cover.marks.len() {
            let (mark, next) = Mark::read(&cover.marks, at).unwrap();
            marks.push((at, next, mark));
            at = next;
        }
        for &(from, to, _) in &marks {
            for figure in 0..cover.figures.len() {
                for new in [Some(Mark::Figure(figure)), Some(Mark::Undecided), None] {
                    let mut changed = cover.clone();
                    let mut bytes = changed.marks[..from].to_vec();
                    new.iter().for_each(|mark| mark.put(&mut bytes));
                    bytes.extend(&changed.marks[to..]);
                    changed.marks = bytes;
                    assert!(is_harmless(&changed, count));
                }
            }
        }
    }
}

#[test]
fn any_byte_may_be_wrong() {
    let problem = holes(2);
    let bytes = searched(&problem).1.to_bytes();
    for at in 0..bytes.len() {
        for bit in [0, 2, 5] {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            let Ok(verdict) = verify_cover(&damaged) else {
                continue;
            };
            let is_proved = verdict.is_about(&problem) && verdict.proves_all();
            assert!(!is_proved || verdict.solutions == Some(4), "{at}");
        }
    }
}

/// The answer is the same for any number of threads, and what is listed is in order.
#[test]
fn threads_change_nothing() {
    let problem = holes(9);
    let with = |threads| {
        let options = Options {
            threads,
            ..Options::default()
        };
        all(&problem, &options).unwrap()
    };
    let (one, two) = (with(1), with(2));
    assert_eq!(one.solutions, two.solutions);
    assert_eq!((one.count, one.choices), (two.count, two.choices));
}

/// For people and for programs: of what the figures are combinations.
#[test]
fn the_command_says_of_what_the_figures_are_combinations() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("holes.toml"), holes(13).to_toml()).unwrap();
    let run = |arguments: &[&str]| {
        let mut krawl = assert_cmd::Command::cargo_bin("krawl").unwrap();
        let output = krawl
            .current_dir(folder.path())
            .args(arguments)
            .output()
            .unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = run(&[
        "all",
        "holes.toml",
        "--json",
        "all.json",
        "--cert",
        "all.krawl",
    ]);
    assert!(text.contains("Complete, proved: 8192 solutions"), "{text}");
    assert!(text.contains("The first 1000 are listed."));
    assert!(text.contains("13 parts"), "{text}");
    assert!(text.contains("2^13"));
    let json = std::fs::read_to_string(at("all.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["count"], 8192);
    assert_eq!(json["independent"][3]["names"][0], "h3");
    assert_eq!(json["independent"][3]["count"], 2);
    let text = run(&["verify", "all.krawl", "holes.toml"]);
    assert!(text.contains("exactly 8192 solutions"), "{text}");
}
