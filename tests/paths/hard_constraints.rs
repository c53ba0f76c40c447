//! Hard cases with other constraints than distances: families with a δ that goes to zero. Their table is in `docs/measured/figures.md`.

use krawl::problem::Problem;
use krawl::track::{Control, Options, Outcome, Space, Status, solve};

/// A family: the text of a problem by δ, how many solutions its path holds, and how small a power of ten δ may be for
/// a proof to be had.
struct Family {
    name: &'static str,
    text: fn(&str) -> String,
    solutions: usize,
    proved: i32,
}

/// δ = 10^-k in digits, and 1 − δ.
fn delta(k: i32) -> String {
    format!("0.{:0>1$}", 1, k as usize)
}

fn below_one(delta: &str) -> String {
    let digits = delta.len() - 2;
    format!("0.{}", "9".repeat(digits))
}

const FAMILIES: [Family; 11] = [
    // b sees a and c under a right angle, δ away from the line through a: its leg is nearly as short as δ at one
    // of two solutions.
    Family {
        name: "leg",
        text: |delta| {
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                e = [4, 0]
                c = [2, 2.5]
                b = [1.1, {delta}]
                [lines]
                l = ["a", "e"]
                [constraints]
                distances = [["a", "e", 4.2], ["a", "c", 3.3], ["c", "e", 3.1], ["b", "l", {delta}]]
                angles = [["a", "b", "c", 90]]
                [homotopy]
                bend = ["a", "e"]
                bend_coefficient = 2
                "#
            )
        },
        solutions: 4,
        proved: 12,
    },
    // A line that is nearly tangent to a circle: p is where they meet, in two places about √(8 δ) apart.
    Family {
        name: "nearly tangent",
        text: |delta| {
            let away = below_one(delta);
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                b = [4, 0]
                c = [2, 0.5]
                p = [2.8, 0]
                [lines]
                l = ["a", "b"]
                [circles]
                o = {{ center = "c", radius = 1 }}
                [constraints]
                distances = [["a", "b", 4.1], ["a", "c", 2.2], ["c", "l", {away}]]
                radii = [["o", 1]]
                on = [["p", "o"], ["p", "l"]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 0.3
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
    // Two lines that are nearly parallel, at δ degrees.
    Family {
        name: "nearly parallel",
        text: |delta| {
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                b = [2, 0]
                c = [0, 1]
                d = [2, 1.2]
                [lines]
                l = ["a", "b"]
                m = ["c", "d"]
                [constraints]
                distances = [["a", "b", 2.1], ["a", "c", 1.1], ["b", "c", 2.3], ["c", "d", 2.2]]
                angles = [["l", "m", {delta}]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 0.5
                "#
            )
        },
        solutions: 4,
        proved: 10,
    },
    // A point that is δ away from the plane of three others.
    Family {
        name: "nearly flat",
        text: |delta| {
            format!(
                r#"
                dimension = 3
                [points]
                a = [0, 0, 0]
                b = [3, 0, 0]
                c = [1, 2.5, 0]
                d = [1.2, 0.8, 0.6]
                [planes]
                e = ["a", "b", "c"]
                [constraints]
                distances = [["a", "b", 3.1], ["b", "c", 3], ["a", "c", 2.8], ["a", "d", 1.5], ["b", "d", 2], ["d", "e", {delta}]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 1
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
    // The same with δ degrees to a straight angle.
    Family {
        name: "nearly straight",
        text: |delta| {
            let degrees = below_one(delta).replacen("0.", "179.", 1);
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                b = [2, 0]
                c = [3.5, 0.8]
                d = [1, 2]
                [constraints]
                distances = [["a", "b", 2.1], ["b", "c", 1.6], ["a", "d", 2.2], ["b", "d", 2.4]]
                angles = [["a", "b", "c", {degrees}]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 0.5
                "#
            )
        },
        solutions: 4,
        proved: 10,
    },
    // Two circles that nearly touch from outside, and p on both.
    Family {
        name: "circles nearly tangent",
        text: |delta| {
            let apart = below_one(delta).replacen("0.", "2.", 1);
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                b = [2.5, 0]
                p = [1.3, 1.2]
                [circles]
                c = {{ center = "a", radius = 1.7 }}
                o = {{ center = "b", radius = 1.6 }}
                [constraints]
                distances = [["a", "b", {apart}]]
                radii = [["c", 1.6], ["o", 1.4]]
                on = [["p", "c"], ["p", "o"]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 0.3
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
    // A sphere and a plane that nearly touch, and p on both; it and the centre are as far from b as from d.
    Family {
        name: "sphere nearly tangent",
        text: |delta| {
            let away = below_one(delta);
            format!(
                r#"
                dimension = 3
                [points]
                a = [0, 0, 0]
                b = [4, 0, 0]
                d = [0.2, 4, 0]
                c = [1.5, 1.4, 0.9]
                p = [2, 1.9, 0]
                [planes]
                e = ["a", "b", "d"]
                [spheres]
                s = {{ center = "c", radius = 1.1 }}
                [constraints]
                distances = [["a", "b", 4.1], ["a", "d", 4.1], ["b", "d", 5.8], ["a", "c", 2.3], ["c", "e", {away}]]
                radii = [["s", 1]]
                on = [["p", "s"], ["p", "e"]]
                equal = [["p", "b", "p", "d"], ["c", "b", "c", "d"]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 0.5
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
    // Two lines in space that pass each other at δ.
    Family {
        name: "lines nearly meet",
        text: |delta| {
            format!(
                r#"
                dimension = 3
                [points]
                a = [0, 0, 0]
                b = [3, 0, 0]
                c = [1, 2, 0]
                d = [1.5, -1, 1]
                [lines]
                l = ["a", "b"]
                m = ["c", "d"]
                [constraints]
                distances = [["a", "b", 3.1], ["b", "c", 3], ["a", "c", 2.1], ["c", "d", 3.3], ["a", "d", 2.2], ["l", "m", {delta}]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 1
                "#
            )
        },
        solutions: 1,
        proved: 12,
    },
    // A hinge that is nearly shut: two planes at δ degrees.
    Family {
        name: "planes nearly parallel",
        text: |delta| {
            format!(
                r#"
                dimension = 3
                [points]
                a = [0, 0, 0]
                b = [3, 0, 0]
                c = [1, 2, 0]
                d = [1.4, 1.8, 0.7]
                [planes]
                e = ["a", "b", "c"]
                f = ["a", "b", "d"]
                [constraints]
                distances = [["a", "b", 3.1], ["b", "c", 3], ["a", "c", 2.1], ["a", "d", 2.4], ["b", "d", 2.6]]
                angles = [["e", "f", {delta}]]
                [homotopy]
                bend = ["a", "b"]
                bend_coefficient = 1
                "#
            )
        },
        solutions: 2,
        proved: 10,
    },
    // A corner rounded by an arc of radius δ.
    Family {
        name: "small arc",
        text: |delta| {
            format!(
                r#"
                dimension = 2
                [points]
                a = [0, 0]
                s = [3.4, 0.1]
                e = [4.1, 0.7]
                b = [4, 3]
                k = [3.4, 0.8]
                [lines]
                bottom = ["a", "s"]
                right = ["e", "b"]
                [arcs]
                corner = {{ center = "k", start = "s", end = "e" }}
                [constraints]
                fixed = ["a"]
                horizontal = ["bottom"]
                vertical = ["right"]
                dx = [["a", "b", 4.1]]
                dy = [["a", "b", 3.1]]
                radii = [["corner", {delta}]]
                tangent = [["corner", "bottom"], ["corner", "right"]]
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
    // A rigid body that is nearly straight, and a point above it.
    Family {
        name: "thin body",
        text: |delta| {
            format!(
                r#"
                dimension = 3
                [points]
                a = [0, 0, 0]
                b = [4, 0, 0]
                c = [2, 0.6, 0]
                d = [2.1, 0.2, 1.9]
                [bodies]
                rod = {{ a = [0, 0, 0], b = [4, 0, 0], c = [2, {delta}, 0] }}
                [constraints]
                distances = [["a", "d", 2.9], ["b", "d", 2.9], ["c", "d", 2.1]]
                "#
            )
        },
        solutions: 2,
        proved: 12,
    },
];

fn run(problem: &Problem, options: Options) -> Outcome {
    let options = Options {
        max_steps: 20_000,
        ..options
    };
    let outcome = solve(problem, &options, &mut Control::default()).unwrap();
    crate::common::no_bug(problem, &outcome);
    outcome
}

fn in_short(outcome: &Outcome) -> String {
    let count = outcome.solutions.len();
    match &outcome.status {
        Status::Closed => format!("{count}"),
        Status::Open(_) => format!("open, {count}"),
        Status::Stopped(reason) => {
            let undecided = reason.contains("meets t = 1");
            let why = if undecided {
                "t = 1 undecided"
            } else {
                "no tube proved"
            };
            format!("stopped: {why}")
        }
    }
}

#[test]
fn certified_runs_are_right_or_stop() {
    let mut wrong = Vec::new();
    for family in &FAMILIES {
        println!("{}", family.name);
        for k in 1..=12 {
            let text = (family.text)(&delta(k));
            let problem = Problem::parse(&text, "hard.toml").unwrap_or_else(|e| panic!("{e}"));
            let forward = run(&problem, Options::certified());
            let back = run(&problem, Options::certified().reversed());
            let float = run(&problem, Options::float(Space::Full));
            println!(
                "{k} {} {} {}",
                in_short(&forward),
                forward.steps,
                in_short(&float)
            );
            for outcome in [forward, back] {
                let found = outcome.solutions.len();
                let stopped = matches!(outcome.status, Status::Stopped(_));
                if found > family.solutions
                    || !stopped && found != family.solutions
                    || stopped && k <= family.proved
                {
                    wrong.push(format!(
                        "{} {k}: {found}, {:?}",
                        family.name, outcome.status
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
