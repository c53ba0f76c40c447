//! What several of the tests need: shipped problems, runs, and checks that share no code with the
//! trackers, but the exact ratios, which the tests of `crates/kernel` compare with others.

pub mod boxes;
pub mod certificate;
pub mod covers;
pub mod edits;
pub mod exact;
pub mod figures;
pub mod hard;
pub mod mixed;
pub mod moves;
pub mod random;
pub mod sketches;

use krawl::problem::Problem;
use krawl::track::{self, Control, Mode, Options, Outcome, Solution, Space, Status};
use std::fmt::Debug;
use std::str::FromStr;

/// The shipped problems with short paths, and how many solutions they have on the path, all of
/// them different up to reflection. The first three counts are published (RR 8705, tables 1 and
/// 2), the last two are those of the complex solutions up to reflection, which bound them.
pub const SHORT: [(&str, usize); 6] = [
    ("octahedron", 4),
    ("disulfide", 8),
    ("dodecagon", 2),
    ("icosahedron-c1", 8),
    ("prism", 12),
    ("k33", 8),
];

/// All float modes and spaces that there are.
pub const FLOAT_SPACES: [Space; 2] = [Space::Full, Space::Reduced];

/// A way to follow a path, for each mode and space that there is.
pub fn ways() -> Vec<Options> {
    let float = FLOAT_SPACES.map(Options::float);
    [vec![Options::certified()], float.to_vec()].concat()
}

/// The arguments of the program that ask for a way.
pub fn arguments(way: &Options) -> [&'static str; 4] {
    let mode = match way.mode {
        Mode::Certified => "certified",
        Mode::Float => "float",
    };
    let space = match way.space {
        Space::Full => "full",
        Space::Reduced => "reduced",
    };
    ["--mode", mode, "--space", space]
}

/// A number that the environment says, such as how often a long test tries, or this one.
pub fn wanted<T: FromStr<Err: Debug>>(name: &str, otherwise: T) -> T {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

/// A problem from `problems/`.
pub fn shipped(name: &str) -> Problem {
    Problem::read(format!("problems/{name}.toml")).unwrap()
}

/// Three points in space, joined: on the path the third falls on the line of the others, and the
/// triangle turns over. Its two solutions are one figure, its two sides up.
pub fn turning_triangle() -> Problem {
    Problem::build("triangle", 3)
        .point("a", ["0", "0", "0"])
        .point("b", ["1", "0", "0"])
        .point("c", ["0", "1", "0"])
        .distance("a", "b", "1.1")
        .distance("b", "c", "1.5")
        .distance("a", "c", "1.2")
        .finish()
        .unwrap()
}

/// The third corner of a triangle on a side, on its left.
pub fn third(p: [f64; 2], q: [f64; 2], from_p: f64, from_q: f64) -> [f64; 2] {
    let to = [q[0] - p[0], q[1] - p[1]];
    let d = to[0].hypot(to[1]);
    let along = (from_p * from_p - from_q * from_q + d * d) / (2.0 * d);
    let height = (from_p * from_p - along * along).sqrt();
    [
        p[0] + (to[0] * along - to[1] * height) / d,
        p[1] + (to[1] * along + to[0] * height) / d,
    ]
}

/// The result of a run.
pub fn solve(problem: &Problem, options: &Options) -> Outcome {
    let outcome = track::solve(problem, options, &mut Control::default()).unwrap();
    no_bug(problem, &outcome);
    outcome
}

/// Fails if a run stopped at what the program itself takes for a fault of its own.
pub fn no_bug(problem: &Problem, outcome: &Outcome) {
    if let Status::Stopped(reason) = &outcome.status {
        assert!(
            !reason.contains("this is a bug"),
            "{reason}\n\n{}",
            problem.to_toml()
        );
    }
}

/// The solutions of a run that must close.
pub fn closed(problem: &Problem, options: &Options) -> Vec<Solution> {
    let outcome = solve(problem, options);
    assert_eq!(
        outcome.status,
        Status::Closed,
        "{}, {options:?}",
        problem.name
    );
    outcome.solutions
}

/// The numbers in a reason for which a certified run stopped, without those of the place: there is
/// one in each that says what was too small.
pub fn numbers_in(reason: &str) -> Vec<f64> {
    let why = reason.split(", at the smallest step").next().unwrap();
    let why = why.split(" (condition").next().unwrap();
    let words = why.split([' ', ',', ';', '(', ')']);
    words
        .filter(|word| word.contains(|c: char| c.is_ascii_digit()) && word.contains('e'))
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// A quadrangle with two angles given. Its bar a-d is led through a length of zero on either side, where the
/// angle at a loses its leg.
pub const QUADRANGLE: &str = r#"
dimension = 2
[points]
a = [0, 0]
b = [4, 0]
c = [4, 3]
d = [0.5, 3]
[constraints]
distances = [["a", "b", 5], ["b", "c", 3.2], ["a", "d", 2.9]]
angles = [["a", "b", "c", 80], ["b", "a", "d", 95]]
[homotopy]
bend = ["a", "d"]
bend_coefficient = 2
"#;
