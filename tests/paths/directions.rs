//! A line of its own is one line whichever way its direction runs. Solutions that differ in nothing else are one figure, also
//! where constraints seem to tell the two ways apart and happen not to.

use crate::common::{certificate, solve, ways};
use krawl::blocks::Figures;
use krawl::certificate::{self as certificates, Settings};
use krawl::problem::Problem;
use krawl::system::Located;
use krawl::track::{Control, Options, Solution, Space, Status};

/// l turns about p until it is as far from q as r is from the line a-b. What says where r is comes with the case.
fn turning(points: &str, ab: &str, constraints: &str) -> Problem {
    let text = format!(
        "name = \"turning line\"\ndimension = 2\n[points]\np = [0, 0]\nq = [0.3, -0.1]\na = [0, 3]\nb = [4, 4]\n{points}\n\
         [lines]\nl = {{ point = [0, 0], direction = [2, 1.3] }}\nab = [{ab}]\n\
         [constraints]\nequal_distances = [[\"q\", \"l\", \"r\", \"ab\"]]\n{constraints}\n"
    );
    Problem::parse(&text, "turning.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// r slides on the line a-b: both distances are zero.
fn sliding() -> Problem {
    turning(
        "r = [1.2, 3.9]",
        r#""a", "b""#,
        "fixed = [\"p\", \"q\", \"a\", \"b\"]\non = [[\"p\", \"l\"], [\"r\", \"ab\"]]\ndistances = [[\"a\", \"r\", 1.5]]",
    )
}

/// r is led to a place that happens to be on the line.
fn placed() -> Problem {
    turning(
        "r = [1.2, 3.9]",
        r#""a", "b""#,
        "fixed = [\"p\", \"q\", \"a\", \"b\"]\non = [[\"p\", \"l\"]]\nx = [[\"r\", 2]]\ny = [[\"r\", 3.5]]",
    )
}

/// l is led to the angle with a-b that c-d has with e-f, which is a right one.
fn at_a_right_angle() -> Problem {
    let text = r#"
        name = "right angle"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 1]
        c = [0, 3]
        d = [3, 4]
        e = [6, 3]
        f = [5.6, 4.2]
        [lines]
        l = { point = [0, 0], direction = [1, 1.3] }
        ab = ["a", "b"]
        cd = ["c", "d"]
        ef = ["e", "f"]
        [constraints]
        fixed = ["a", "b", "c", "d", "e"]
        on = [["a", "l"]]
        distances = [["e", "f", 1.2]]
        perpendicular = [["cd", "ef"]]
        equal_angles = [["l", "ab", "ef", "cd"]]
    "#;
    Problem::parse(text, "right.toml").unwrap()
}

fn direction(solution: &Solution) -> [f64; 2] {
    let Located::Line { direction, .. } = solution.objects[0] else {
        panic!("it is a line");
    };
    [direction[0].mid(), direction[1].mid()]
}

/// Whether two solutions are one to people: the same points, and the same line with either direction.
fn are_one(one: &Solution, other: &Solution) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let pairs = one.figure().into_iter().zip(other.figure());
    let [u, v] = [one, other].map(direction);
    let along = |sign: f64| near(u[0], sign * v[0]) && near(u[1], sign * v[1]);
    let points = pairs.fold(true, |same, (a, b)| same && (a - b).norm() < 1e-9);
    points && (along(1.0) || along(-1.0))
}

#[test]
fn both_directions_of_a_line_are_one_figure() {
    for problem in [sliding(), placed(), at_a_right_angle()] {
        for options in ways() {
            let outcome = solve(&problem, &options);
            let name = format!("{}, {options:?}", problem.name);
            assert_eq!(outcome.status, Status::Closed, "{name}");
            let all = &outcome.solutions;
            let mut alike = 0;
            for (k, one) in all.iter().enumerate() {
                for other in &all[..k] {
                    assert_eq!(one.class == other.class, are_one(one, other), "{name}");
                    alike += usize::from(one.class == other.class);
                }
            }
            assert_eq!(alike, 1, "{name}: {} solutions", all.len());
        }
    }
}

/// Distances that are zero at t = 1 and not before are met in a regular figure, in which the equations are independent: r is
/// led onto the line a-b, so that q has to be on p-s, on either side of p and for either place of r.
#[test]
fn equal_distances_may_become_zero() {
    let problem = Problem::parse(
        "name = \"zero\"\ndimension = 2\n[points]\np = [0, 0]\nq = [0.3, -0.1]\na = [0, 3]\nb = [4, 4]\nr = [1.2, 3.9]\n\
         s = [5, 1]\n[constraints]\nfixed = [\"p\", \"a\", \"b\", \"s\"]\non = [[\"r\", \"a\", \"b\"]]\n\
         equal_distances = [[\"q\", \"p\", \"s\", \"r\", \"a\", \"b\"]]\n\
         distances = [[\"a\", \"r\", 1.5], [\"p\", \"q\", 1]]\n",
        "zero.toml",
    )
    .unwrap();
    for options in ways() {
        let outcome = solve(&problem, &options);
        assert_eq!(outcome.status, Status::Closed, "{options:?}");
        assert_eq!(outcome.solutions.len(), 4, "{options:?}");
        for solution in &outcome.solutions {
            let [x, y, _] = *solution.point(&problem, "q").unwrap();
            assert!((5.0 * y.mid() - x.mid()).abs() < 1e-9, "{options:?}");
        }
    }
}

/// The checker comes to the same classes.
#[test]
fn certificates_know_that_both_directions_are_one_figure() {
    for problem in [sliding(), at_a_right_angle()] {
        let (outcome, bytes) = certificate::of(&problem, &Options::certified());
        let verdict = certificates::verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
        assert_eq!(verdict.outcome, certificates::Outcome::Verified);
        let classes: Vec<usize> = verdict.classes.iter().map(|&c| c as usize).collect();
        let found: Vec<usize> = outcome.solutions.iter().map(|s| s.class).collect();
        assert_eq!(classes, found);
    }
}

/// r is where two circles meet, in two places of which one happens to be on the line: no equation says so, and no box tells.
fn meeting() -> Problem {
    turning(
        "r = [0.9, 0.6]\nc = [1, 2]\nd = [4, 0]",
        r#""p", "d""#,
        "fixed = [\"p\", \"q\", \"a\", \"b\", \"c\", \"d\"]\non = [[\"p\", \"l\"]]\n\
         distances = [[\"p\", \"r\", 1], [\"c\", \"r\", 2]]",
    )
}

/// Then nothing is claimed of the two directions there; in floats they are seen to be one.
#[test]
fn what_may_be_one_figure_is_not_counted_as_two() {
    let problem = meeting();
    let outcome = solve(&problem, &Options::certified());
    let Status::Stopped(reason) = &outcome.status else {
        panic!("{:?}", outcome.status);
    };
    assert!(reason.contains("direction of a line"), "{reason}");
    let observed = solve(&problem, &Options::float(Space::Full));
    let all = &observed.solutions;
    let mut alike = 0;
    for (k, one) in all.iter().enumerate() {
        for other in &all[..k] {
            assert_eq!(one.class == other.class, are_one(one, other));
            alike += usize::from(are_one(one, other));
        }
    }
    assert_eq!(alike, 1);
}

/// Nor are they when figures are counted block by block.
#[test]
fn blocks_do_not_count_one_figure_twice() {
    for problem in [sliding(), placed(), meeting()] {
        let found = Figures::find(&problem, &Options::certified(), &mut Control::default());
        let refused = found.map(|figures| figures.count()).unwrap_err();
        assert!(refused.contains("direction"), "{refused}");
    }
}
