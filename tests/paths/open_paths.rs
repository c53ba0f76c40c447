//! Paths with two ends, and edits of figures with other constraints than distances.

use crate::common::{QUADRANGLE, certificate, solve};
use krawl::certificate::Outcome::Verified;
use krawl::certificate::{Settings, verify};
use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::system::Located;
use krawl::track::{EndKind, Options, Space, Status, StopKind};

fn parse(text: &str) -> Problem {
    Problem::parse(text, "test.toml").unwrap()
}

#[test]
fn a_path_whose_angle_loses_its_leg_is_open_both_ways() {
    let problem = parse(QUADRANGLE);
    for reverse in [false, true] {
        let options = Options {
            reverse,
            ..Options::certified()
        };
        let outcome = solve(&problem, &options);
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

/// What two distances say of n follows from the mirror image, but for the way that one of them takes in between. So the path
/// through the sketch stays at t = 0 until b comes to a, where the line has no direction, and full space and extended precision
/// can prove ever shorter tubes on the way there.
#[test]
fn tubes_that_lead_nowhere_end_the_path() {
    let problem = parse(
        "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [2, 3]\nn = [2, -3]\n[lines]\nab = [\"a\", \"b\"]\n\
         [constraints]\ndistances = [[\"a\", \"c\", 4], [\"b\", \"c\", 3.9], [\"a\", \"n\", 4]]\n\
         symmetric = [[\"c\", \"n\", \"ab\"]]",
    );
    for space in [Space::Full, Space::Reduced] {
        for reverse in [false, true] {
            let options = Options {
                space,
                reverse,
                max_steps: 100_000,
                ..Options::certified()
            };
            let outcome = solve(&problem, &options);
            let Status::Open(ends) = &outcome.status else {
                panic!("{:?}", outcome.status);
            };
            assert!(outcome.solutions.is_empty());
            for end in ends.iter() {
                assert_eq!(end.kind, EndKind::Undefined, "{}", end.reason);
                assert!(end.reason.starts_with("a-b goes to zero"), "{}", end.reason);
                assert!(end.t.0.abs() < 1e-6, "{:?}", end.t);
            }
        }
    }
}

/// Two lines of their own that turn until they are parallel, and the point where they meet.
#[test]
fn a_point_goes_away_where_lines_become_parallel() {
    let problem = parse(
        "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\np = [5, 3]\n[lines]\nbase = [\"a\", \"b\"]\n\
         l1 = { point = [0, 0], direction = [5, 3] }\nl2 = { point = [4, 0], direction = [1, 3] }\n[constraints]\n\
         distances = [[\"a\", \"b\", 4]]\nangles = [[\"base\", \"l1\", 60], [\"base\", \"l2\", 50]]\n\
         on = [[\"a\", \"l1\"], [\"b\", \"l2\"], [\"p\", \"l1\"], [\"p\", \"l2\"]]",
    );
    let outcome = solve(&problem, &Options::certified());
    let Status::Open(ends) = &outcome.status else {
        panic!("{:?}", outcome.status);
    };
    for end in ends.iter() {
        assert_eq!(end.kind, EndKind::Infinite, "{}", end.reason);
        let words = "the lines l1 and l2 become parallel";
        assert!(end.reason.starts_with(words), "{}", end.reason);
    }
}

/// Two circles about one centre, their radii given, and whatever is said of b.
fn rings(b: &str, radius: &str, said_of_b: &str) -> Problem {
    parse(&format!(
        "dimension = 2\n[points]\na = [0, 0]\n{b}[circles]\nc = {{ center = \"a\", radius = {radius} }}\n\
         d = {{ center = \"a\", radius = 4.3 }}\n[constraints]\nfixed = [\"a\"]\nradii = [[\"c\", 3.3]]\n\
         distances = [[\"c\", \"d\", 1]{said_of_b}\n"
    ))
}

/// The path is straight, so that powers of its tubes' length are all that bounds them. It was said to stop at the sketch.
#[test]
fn a_sketch_that_meets_everything_stays_as_it_is() {
    let alone = rings("", "3.3", "]");
    let beside = rings(
        "b = [5.3, 0]\n",
        "3.3",
        ", [\"d\", \"b\", 1]]\nhorizontal = [[\"a\", \"b\"]]",
    );
    for (problem, reverse, space) in [
        (&alone, false, Space::Full),
        (&alone, true, Space::Full),
        (&beside, false, Space::Full),
        (&alone, false, Space::Reduced),
        (&alone, true, Space::Reduced),
        (&beside, false, Space::Reduced),
    ] {
        let options = Options {
            reverse,
            space,
            ..Options::certified()
        };
        let outcome = solve(problem, &options);
        assert_eq!(outcome.space, space);
        let Status::Open(ends) = &outcome.status else {
            panic!("{:?}", outcome.status);
        };
        let [behind, ahead] = match reverse {
            false => [&ends[0], &ends[1]],
            true => [&ends[1], &ends[0]],
        };
        assert!(behind.t.1 < -1e10 && ahead.t.0 > 1e10, "{ends:?}");
        for end in &**ends {
            assert_eq!((end.kind, end.away), (EndKind::Infinite, None));
            assert!(end.reason.contains("t has passed"), "{}", end.reason);
        }
        let [solution] = &outcome.solutions[..] else {
            panic!("{} solutions", outcome.solutions.len());
        };
        let Some(Located::Round { radius, .. }) = solution.object(problem, "d") else {
            panic!("d is a circle");
        };
        assert!(radius.contains(4.3) && radius.wid() < 1e-12, "{radius:?}");
        let (_, bytes) = certificate::of(problem, &options);
        let verdict = verify(&bytes[..], &Settings::default(), &mut |_| ()).unwrap();
        assert_eq!(verdict.outcome, Verified);
        assert!(verdict.is_open && verdict.solutions.len() == 1 && verdict.tubes > 1);
    }
}

#[test]
fn circles_about_one_centre_vanish_one_after_the_other() {
    // The radii are 3 + 0.3 t and that with 1.3 − 0.3 t: 4.3.
    let problem = rings("", "3", "]");
    let outcome = solve(&problem, &Options::certified());
    let Status::Open(ends) = &outcome.status else {
        panic!("{:?}", outcome.status);
    };
    assert_eq!(outcome.solutions.len(), 1);
    assert!((ends[0].t.0 + 10.0).abs() < 1e-9, "{ends:?}");
    assert_eq!(ends[0].kind, EndKind::Undefined);
    assert!(ends[0].reason.contains("the radius of c goes to zero"));
    assert_eq!(ends[1].kind, EndKind::Infinite);
    assert!(ends[1].t.0 > 1e10);
}

/// Distances alone, met by the sketch, and nothing that makes the path turn back.
#[test]
fn a_figure_as_it_should_be_is_found() {
    let problem = parse(
        "dimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nc = [0, 4]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 5], [\"c\", \"a\", 4]]\n[homotopy]\nbend_coefficient = 0\n",
    );
    for space in [Space::Full, Space::Reduced] {
        let options = Options {
            space,
            ..Options::certified()
        };
        let outcome = solve(&problem, &options);
        let Status::Stopped(stop) = &outcome.status else {
            panic!("{:?}", outcome.status);
        };
        assert_eq!(stop.kind, StopKind::Infinite, "{stop}");
        let [solution] = &outcome.solutions[..] else {
            panic!("{} solutions", outcome.solutions.len());
        };
        let [x, y, _] = *solution.point(&problem, "c").unwrap();
        let [p, q, _] = *solution.point(&problem, "b").unwrap();
        let across = (p.mid() - x.mid()).hypot(q.mid() - y.mid());
        assert!((across - 5.0).abs() < 1e-12, "{across}");
    }
}

/// b is on the line a-e and sees a and c under a right angle: at the foot of c, but where b falls on a the equation
/// holds as well, and there is no angle. The path goes through both. The second was once called a solution.
const FOOT: &str = r#"
dimension = 2
[points]
a = [0, 0]
e = [4, 0]
c = [2, 2.5]
b = [1.1, 0]
[lines]
l = ["a", "e"]
[constraints]
distances = [["a", "e", 4.2], ["a", "c", 3.3], ["c", "e", 3.1]]
angles = [["a", "b", "c", 90]]
on = [["b", "l"]]
[homotopy]
bend = ["a", "e"]
bend_coefficient = 2
"#;

#[test]
fn where_a_leg_vanishes_there_is_no_right_angle() {
    let by_name = FOOT.replace(
        r#"angles = [["a", "b", "c", 90]]"#,
        r#"perpendicular = [["a", "b", "b", "c"]]"#,
    );
    for text in [FOOT.to_owned(), by_name] {
        let problem = parse(&text);
        for options in [Options::certified(), Options::certified().reversed()] {
            let outcome = solve(&problem, &options);
            let Status::Open(ends) = &outcome.status else {
                panic!("{:?}", outcome.status);
            };
            for end in ends.iter() {
                assert_eq!(end.kind, EndKind::Undefined, "{}", end.reason);
                assert!((end.t.0 - 1.0).abs() < 1e-6);
            }
            assert_eq!(outcome.solutions.len(), 2);
            for solution in &outcome.solutions {
                let [a, b, c] = ["a", "b", "c"].map(|p| *solution.point(&problem, p).unwrap());
                assert!((0..2).any(|k| (a[k] - b[k]).mig() > 0.1));
                let product = (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]);
                assert!(product.contains(0.0));
            }
        }
        // Floats observe no such figure either.
        let observed = solve(&problem, &Options::float(Space::Full));
        assert!(observed.solutions.len() <= 2);
    }
}

/// A line of its own is the same line with its direction reversed: solutions that differ in nothing else are congruent.
#[test]
fn a_reversed_line_is_the_same_line() {
    let problem = parse(
        r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [2, 2.5]
        [lines]
        l = { point = [1, 1], direction = [1, 0.2] }
        [constraints]
        distances = [["a", "b", 4.2], ["b", "c", 3.3], ["a", "c", 3.1]]
        on = [["a", "l"], ["c", "l"]]
        [homotopy]
        bend = ["a", "b"]
        bend_coefficient = 2
        "#,
    );
    for options in [Options::certified(), Options::float(Space::Full)] {
        let outcome = solve(&problem, &options);
        // One triangle and its mirror image.
        for solution in &outcome.solutions {
            assert_eq!(solution.class, 0, "{:?}", outcome.solutions);
        }
        assert!(!outcome.solutions.is_empty());
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
