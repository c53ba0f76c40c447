//! Paths with two ends, and edits of figures with other constraints than distances.

use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::{Control, EndKind, Options, Outcome, Status, solve};

fn parse(text: &str) -> Problem {
    Problem::parse(text, "test.toml").unwrap()
}

fn run(problem: &Problem, options: &Options) -> Outcome {
    solve(problem, options, &mut Control::default()).unwrap()
}

/// A quadrangle with two angles given. Its bar a-d is led through a length of zero on either side, where the
/// angle at a loses its leg.
const QUADRANGLE: &str = r#"
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

#[test]
fn a_path_whose_angle_loses_its_leg_is_open_both_ways() {
    let problem = parse(QUADRANGLE);
    for reverse in [false, true] {
        let options = Options {
            reverse,
            ..Options::certified()
        };
        let outcome = run(&problem, &options);
        let Status::Open(ends) = &outcome.status else {
            panic!("{:?}", outcome.status);
        };
        // a(t) = −2t² + (2.9 − a₀ + 2) t + a₀ with a₀ = √(0.5² + 3²): its zeros.
        let a0 = 9.25f64.sqrt();
        let slope = 4.9 - a0;
        let root = (slope * slope + 8.0 * a0).sqrt();
        let mut zeros = [(slope - root) / 4.0, (slope + root) / 4.0];
        if reverse {
            zeros.reverse();
        }
        for (end, zero) in ends.iter().zip(zeros) {
            assert_eq!(end.kind, EndKind::Undefined);
            assert!(
                (end.t.0 - zero).abs() < 1e-9 && end.t.0 <= end.t.1,
                "{end:?}"
            );
            assert!(end.reason.contains("a-d"), "{}", end.reason);
        }
        // The one figure: everything is given from a on.
        let [solution] = &outcome.solutions[..] else {
            panic!("{} solutions", outcome.solutions.len());
        };
        let (sin, cos) = 95f64.to_radians().sin_cos();
        let d = solution.points[3];
        assert!((d[0].mid() - 2.9 * cos).abs() < 1e-12 && (d[1].mid() - 2.9 * sin).abs() < 1e-12);
    }
}

#[test]
fn right_angles_stay_while_a_side_is_edited() {
    let problem = parse(
        r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [4, 3]
        d = [0, 3]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 3]]
        angles = [["a", "b", "c", 90], ["b", "c", "d", 90], ["d", "a", "b", 90]]
        "#,
    );
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "a-b=5.5").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    let points = session.figure();
    for (p, wanted) in points
        .iter()
        .zip([[0.0, 0.0], [5.5, 0.0], [5.5, 3.0], [0.0, 3.0]])
    {
        assert!((p[0] - wanted[0]).abs() < 1e-12 && (p[1] - wanted[1]).abs() < 1e-12);
    }
}

/// An angle of 60 degrees whose leg grows: were `u·v` held where it was, the angle would change.
#[test]
fn angles_stay_while_their_legs_are_edited() {
    let problem = parse(
        r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [2, 0]
        c = [0.9, 1.7]
        [constraints]
        distances = [["a", "b", 2], ["a", "c", 2]]
        angles = [["b", "a", "c", 60]]
        "#,
    );
    let mut session = Session::open(&problem).unwrap();
    let settings = ["a-b=3", "a-c=2.5"].map(|text| Setting::parse(&problem, text).unwrap());
    let edited = session.edit(&settings);
    assert_eq!(edited.ending, Ending::Reached);
    let points = session.figure();
    let (sin, cos) = 60f64.to_radians().sin_cos();
    assert!((points[1][0] - 3.0).abs() < 1e-12);
    assert!((points[2][0] - 2.5 * cos).abs() < 1e-12 && (points[2][1] - 2.5 * sin).abs() < 1e-12);
}
