//! Distances between any two objects, and what else names them: that solutions meet what the words mean to people, measured
//! in the solutions' boxes, and what is said where words cannot be met.

use krawl::interval::Interval;
use krawl::problem::Problem;
use krawl::system::Located;
use krawl::track::{Control, Options, Outcome, Solution, solve};

/// Four points in the plane of which two are known.
const PLANE: &str = "name = \"plane\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4.1, 0.1]\nc = [4.9, 3.1]\nd = [0.6, 3.3]\n";
/// The constraints by which they are known.
const KNOWN: &str = "fixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]\n";
/// A triangle in space and three more points.
const SPACE: &str = "name = \"space\"\ndimension = 3\n[points]\na = [0, 0, 0]\nb = [4.1, 0.1, 0]\nc = [1, 3.1, 0.2]\n\
                     d = [1.1, 1, 2.1]\n";
const MORE: &str = "e = [3.2, 1.3, 2.2]\nf = [1.7, 3.1, 2]\n";
/// The triangle's sides.
const SIDES: &str = "[\"a\", \"b\", 4], [\"b\", \"c\", 4.2], [\"a\", \"c\", 3.2]";

fn run(text: &str) -> (Problem, Outcome) {
    let problem = Problem::parse(text, "test.toml").unwrap_or_else(|e| panic!("{e}\n{text}"));
    let outcome = solve(&problem, &Options::certified(), &mut Control::default());
    let outcome = outcome.unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert!(!outcome.solutions.is_empty(), "no solution\n{text}");
    (problem, outcome)
}

type Vector = [Interval; 3];

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn size(a: Vector) -> Interval {
    (a[0].sqr() + a[1].sqr() + a[2].sqr()).sqrt()
}

fn is_zero(a: Vector) -> bool {
    a.iter().all(|x| x.contains(0.0) && x.wid() < 1e-6)
}

/// A place, or an object.
fn thing(problem: &Problem, solution: &Solution, name: &str) -> Located {
    match solution.point(problem, name) {
        // A point is a circle without extent.
        Some(&center) => Located::Round {
            center,
            radius: krawl::interval::point(0.0),
        },
        None => *solution.object(problem, name).unwrap(),
    }
}

/// How far apart two things are where they are nearest: one of these numbers, that for the side on which they are. Planes, and
/// a line and a plane, are parallel, as far as boxes tell.
fn apart(one: &Located, other: &Located) -> Vec<Interval> {
    use Located::{Line, Plane, Round};
    match (one, other) {
        (
            Round {
                center: c,
                radius: r,
            },
            Round {
                center: k,
                radius: s,
            },
        ) => {
            let off = size(minus(*c, *k));
            vec![off - *r - *s, *r - *s - off, *s - *r - off]
        }
        (Round { center, radius }, Line { point, direction }) => {
            vec![size(cross(minus(*center, *point), *direction)) - *radius]
        }
        (Round { center, radius }, Plane { point, normal }) => {
            let height = dot(minus(*center, *point), *normal);
            vec![height - *radius, -height - *radius]
        }
        (Line { .. } | Plane { .. }, Round { .. }) => apart(other, one),
        (
            Line {
                point: p,
                direction: u,
            },
            Line {
                point: q,
                direction: v,
            },
        ) => {
            let off = minus(*q, *p);
            let normal = cross(*u, *v);
            match is_zero(normal) {
                true => vec![size(cross(off, *u))],
                false => {
                    let off = dot(off, normal) / size(normal);
                    vec![off, -off]
                }
            }
        }
        (
            Plane {
                point: p,
                normal: n,
            },
            Line {
                point: q,
                direction: u,
            },
        ) => {
            let sine = dot(*n, *u);
            assert!(sine.contains(0.0) && sine.wid() < 1e-6, "{sine:?}");
            let height = dot(minus(*q, *p), *n);
            vec![height, -height]
        }
        (Line { .. }, Plane { .. }) => apart(other, one),
        (
            Plane {
                point: p,
                normal: n,
            },
            Plane {
                point: q,
                normal: m,
            },
        ) => {
            assert!(is_zero(cross(*n, *m)));
            let height = dot(minus(*q, *p), *n);
            vec![height, -height]
        }
        _ => panic!("nothing to measure"),
    }
}

/// Every solution has these things so far apart.
fn are_apart(text: &str, wanted: &[(&str, &str, f64)]) {
    let (problem, outcome) = run(text);
    for solution in &outcome.solutions {
        for &(one, other, distance) in wanted {
            let [one, other] = [one, other].map(|name| thing(&problem, solution, name));
            let found = apart(&one, &other);
            let is_so = |x: &Interval| x.contains(distance) && x.wid() < 1e-6;
            assert!(found.iter().any(is_so), "{found:?}\n{text}");
        }
    }
}

#[test]
fn lines_in_the_plane() {
    let lines = "[lines]\nl = [\"a\", \"b\"]\nm = [\"c\", \"d\"]\nf = { point = [0, 2], direction = [5, 1] }\n";
    // f lies where it does in the first of these because of it: two equations, for its two degrees of freedom.
    let rest = "[\"a\", \"b\", 4], [\"c\", \"d\", 4.4], [\"b\", \"c\", 3.2]";
    for (distances, more, wanted) in [
        (
            "[\"l\", \"m\", 3], [\"f\", \"l\", 1.5]",
            "",
            vec![("l", "m", 3.0), ("f", "l", 1.5)],
        ),
        // They are parallel anyway: one equation each.
        (
            "[\"l\", \"m\", 3], [\"f\", \"m\", 1.5]",
            "perpendicular = [[\"m\", \"y-axis\"], [\"f\", \"y-axis\"]]",
            vec![("l", "m", 3.0), ("f", "m", 1.5)],
        ),
        (
            "[\"l\", \"m\", 3], [\"f\", \"m\", 1.5]",
            "parallel = [[\"m\", \"l\"], [\"f\", \"l\"]]",
            vec![("l", "m", 3.0), ("f", "m", 1.5)],
        ),
        (
            "[\"x-axis\", \"m\", 3], [\"c\", \"d\", \"f\", 1.5]",
            "",
            vec![("l", "m", 3.0), ("f", "m", 1.5)],
        ),
    ] {
        let text = format!(
            "{PLANE}{lines}[constraints]\n{KNOWN}{more}\ndistances = [{rest}, {distances}]\n"
        );
        are_apart(&text, &wanted);
    }
}

#[test]
fn circles_in_the_plane() {
    let known = "[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"a\", \"c\", 5.5]";
    for (circles, constraints, wanted) in [
        (
            "k = { center = \"c\", radius = 1 }",
            "[\"a\", \"d\", 3], [\"b\", \"d\", 4.6], [\"k\", \"l\", 1.5]",
            ("k", "l", 1.5),
        ),
        // The line cuts the circle in the sketch.
        (
            "k = { center = \"c\", radius = 4 }",
            "[\"a\", \"d\", 3], [\"b\", \"d\", 4.6], [\"l\", \"k\", 0.5]",
            ("k", "l", 0.5),
        ),
        (
            "k = { center = \"c\", radius = 1 }",
            "[\"a\", \"d\", 3], [\"b\", \"d\", 4.6], [\"k\", \"d\", 2]",
            ("k", "d", 2.0),
        ),
        (
            "k = { center = \"c\", radius = 6 }",
            "[\"a\", \"d\", 3], [\"b\", \"d\", 4.6], [\"d\", \"k\", 2]",
            ("k", "d", 2.0),
        ),
    ] {
        are_apart(
            &format!(
                "{PLANE}[lines]\nl = [\"a\", \"b\"]\n[circles]\n{circles}\n[constraints]\n{KNOWN}distances = [{known}, {constraints}]\n"
            ),
            &[wanted],
        );
    }
    for (k, m, radii, other) in [
        ("1", "0.7", "[\"k\", 1.1], [\"m\", 0.8]", "d"),
        ("6", "0.7", "[\"k\", 6], [\"m\", 0.8]", "d"),
        ("0.7", "6", "[\"k\", 0.8], [\"m\", 6]", "d"),
    ] {
        are_apart(
            &format!(
                "{PLANE}[circles]\nk = {{ center = \"c\", radius = {k} }}\nm = {{ center = \"{other}\", radius = {m} }}\n[constraints]\n\
                 {KNOWN}radii = [{radii}]\ndistances = [{known}, [\"a\", \"d\", 3.2], [\"k\", \"m\", 1.5]]\n"
            ),
            &[("k", "m", 1.5)],
        );
    }
    are_apart(
        &format!(
            "{PLANE}[circles]\nk = {{ center = \"c\", radius = 2 }}\nm = {{ center = \"c\", radius = 1 }}\n[constraints]\n\
             {KNOWN}radii = [[\"k\", 3]]\ndistances = [{known}, [\"a\", \"d\", 3.2], [\"b\", \"d\", 4.6], [\"k\", \"m\", 0.5]]\n"
        ),
        &[("k", "m", 0.5)],
    );
}

#[test]
fn planes_and_lines_in_space() {
    let objects = "[planes]\np = [\"a\", \"b\", \"c\"]\nq = [\"d\", \"e\", \"f\"]\n[lines]\nl = [\"d\", \"e\"]\ng = [\"a\", \"b\"]\n";
    let roof = "[\"d\", \"e\", 2.2], [\"a\", \"d\", 2.5], [\"b\", \"e\", 2.6]";
    let corner = "[\"e\", \"f\", 2.3], [\"d\", \"f\", 2.2], [\"c\", \"f\", 2.1]";
    for (distances, more, wanted) in [
        ("[\"p\", \"q\", 2]", "", ("p", "q", 2.0)),
        (
            "[\"p\", \"q\", 2]",
            "parallel = [[\"q\", \"p\"]]",
            ("p", "q", 2.0),
        ),
        (
            "[\"l\", \"p\", 2], [\"c\", \"e\", 3.6]",
            "",
            ("l", "p", 2.0),
        ),
        (
            "[\"a\", \"b\", \"c\", \"l\", 2], [\"c\", \"e\", 3.6]",
            "parallel = [[\"l\", \"p\"]]",
            ("l", "p", 2.0),
        ),
    ] {
        let text = format!(
            "{SPACE}{MORE}{objects}[constraints]\n{more}\ndistances = [{SIDES}, {roof}, {corner}, {distances}]\n"
        );
        are_apart(&text, &[wanted]);
    }
    let text = format!(
        "{SPACE}e = [3.2, 1.3, 2.2]\n[lines]\nl = [\"d\", \"e\"]\ng = [\"a\", \"b\"]\n[constraints]\nparallel = [[\"l\", \"g\"]]\n\
         distances = [{SIDES}, [\"d\", \"e\", 2.2], [\"a\", \"d\", 2.6], [\"c\", \"d\", 3], [\"l\", \"g\", 2.2]]\n"
    );
    are_apart(&text, &[("l", "g", 2.2)]);
}

#[test]
fn planes_and_lines_of_their_own() {
    let text = format!(
        "{SPACE}[planes]\np = [\"a\", \"b\", \"c\"]\nq = {{ point = [0, 0, 3], normal = [0.1, 0.1, 1] }}\n\
         s = {{ point = [0, 0, 5], normal = [0, 0.2, -1] }}\n[constraints]\n\
         distances = [{SIDES}, [\"a\", \"d\", 2.6], [\"b\", \"d\", 3.7], [\"c\", \"d\", 3], [\"p\", \"q\", 2.5], [\"q\", \"s\", 1.5]]\n"
    );
    are_apart(&text, &[("p", "q", 2.5), ("q", "s", 1.5), ("p", "s", 4.0)]);
}

#[test]
fn spheres() {
    let objects = "[planes]\np = [\"a\", \"b\", \"c\"]\n[lines]\ng = [\"a\", \"b\"]\n[spheres]\ns = { center = \"d\", radius = 0.5 }\n";
    for (constraints, more, wanted) in [
        (
            "[\"s\", \"p\", 1.2], [\"a\", \"d\", 2.6], [\"b\", \"d\", 3.7]",
            "radii = [[\"s\", 0.6]]",
            ("s", "p", 1.2),
        ),
        (
            "[\"s\", \"g\", 1.4], [\"a\", \"d\", 2.6], [\"c\", \"d\", 3]",
            "radii = [[\"s\", 0.6]]",
            ("s", "g", 1.4),
        ),
        (
            "[\"s\", \"c\", 2.2], [\"a\", \"d\", 2.6], [\"b\", \"d\", 3.7]",
            "radii = [[\"s\", 0.6]]",
            ("s", "c", 2.2),
        ),
        (
            "[\"c\", \"d\", 3], [\"a\", \"d\", 2.6], [\"b\", \"d\", 3.7]",
            "tangent = [[\"s\", \"g\"]]",
            ("s", "g", 0.0),
        ),
        (
            "[\"c\", \"d\", 3], [\"a\", \"d\", 2.6], [\"b\", \"d\", 3.7]",
            "tangent = [[\"a\", \"b\", \"s\"]]",
            ("s", "g", 0.0),
        ),
    ] {
        let text = format!(
            "{SPACE}{objects}[constraints]\n{more}\ndistances = [{SIDES}, {constraints}]\n"
        );
        are_apart(&text, &[wanted]);
    }
    let text = format!(
        "{SPACE}[spheres]\ns = {{ center = \"d\", radius = 0.5 }}\nu = {{ center = \"a\", radius = 4 }}\n[constraints]\n\
         radii = [[\"s\", 0.6], [\"u\", 4]]\ndistances = [{SIDES}, [\"c\", \"d\", 3], [\"b\", \"d\", 3.7], [\"s\", \"u\", 0.8]]\n"
    );
    are_apart(&text, &[("s", "u", 0.8)]);
}

#[test]
fn the_angle_of_two_points_with_a_named_line() {
    let text = format!(
        "{PLANE}[lines]\nf = {{ point = [0, 1], direction = [5, 1] }}\n[constraints]\n{KNOWN}on = [[\"d\", \"f\"]]\n\
         angles = [[\"a\", \"b\", \"f\", 20]]\n\
         distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"a\", \"c\", 5.5], [\"a\", \"d\", 3.3], [\"b\", \"d\", 4.8]]\n"
    );
    let (problem, outcome) = run(&text);
    for solution in &outcome.solutions {
        let Located::Line { direction: u, .. } = thing(&problem, solution, "f") else {
            panic!("f is a line");
        };
        let [a, b] = ["a", "b"].map(|name| *solution.point(&problem, name).unwrap());
        let cosine = dot(u, minus(b, a)) / size(minus(b, a));
        let wanted = 20f64.to_radians().cos();
        assert!((cosine.mid().abs() - wanted).abs() < 1e-9, "{cosine:?}");
    }
}

/// What is said of constraints that cannot be.
fn refused(text: &str) -> String {
    Problem::parse(text, "test.toml").unwrap_err().to_string()
}

#[test]
fn what_cannot_be_apart_is_said() {
    let flat = |distance: &str| {
        refused(&format!(
            "{PLANE}[lines]\nl = [\"a\", \"b\"]\nm = [\"b\", \"c\"]\n[circles]\nk = {{ center = \"c\", radius = 1 }}\n\
             n = {{ center = \"c\", radius = 1 }}\n[constraints]\n{KNOWN}distances = [{distance}]\n"
        ))
    };
    for (distance, words) in [
        ("[\"l\", \"m\", 2]", "both go through `b`"),
        ("[\"l\", \"b\", \"a\", 2]", "one and the same"),
        ("[\"c\", \"k\", 2]", "the point is the centre of it"),
        ("[\"k\", \"n\", 2]", "equally large in the sketch"),
        ("[\"k\", \"k\", 2]", "two different ones"),
        ("[\"x-axis\", \"y-axis\", 2]", "axes are where they are"),
    ] {
        let message = flat(distance);
        assert!(message.contains(words), "{distance}: {message}");
    }
    let solid = |constraints: &str| {
        refused(&format!(
            "{SPACE}[planes]\np = [\"a\", \"b\", \"c\"]\nq = [\"b\", \"c\", \"a\"]\nr = [\"b\", \"c\", \"d\"]\n[lines]\nl = [\"a\", \"b\"]\nm = [\"a\", \"d\"]\n\
             [constraints]\n{constraints}\n"
        ))
    };
    for (constraints, words) in [
        (
            "angles = [[\"l\", \"p\", 30]]",
            "the line lies in the plane, as a and b are points of both",
        ),
        (
            "perpendicular = [[\"l\", \"p\"]]",
            "the line lies in the plane",
        ),
        (
            "parallel = [[\"p\", \"b\", \"c\"]]",
            "the line lies in the plane",
        ),
        (
            "distances = [[\"p\", \"l\", 2]]",
            "the line lies in the plane",
        ),
        ("distances = [[\"p\", \"m\", 2]]", "both go through `a`"),
        ("distances = [[\"p\", \"r\", 2]]", "both go through `b`"),
        ("parallel = [[\"p\", \"q\"]]", "one and the same"),
    ] {
        let message = solid(constraints);
        assert!(message.contains(words), "{constraints}: {message}");
    }
}

#[test]
fn a_distance_of_zero_is_said_in_another_way() {
    let message = |names: &str, is_flat: bool| {
        let (start, more, known) = match is_flat {
            true => (
                PLANE,
                "l = [\"a\", \"b\"]\nm = [\"c\", \"d\"]\n[circles]\nk = { center = \"c\", radius = 1 }\nn = { center = \"d\", radius = 1 }\n",
                KNOWN,
            ),
            false => (
                SPACE,
                "l = [\"a\", \"b\"]\nm = [\"c\", \"d\"]\n[planes]\np = [\"a\", \"b\", \"c\"]\nq = { point = [0, 0, 3], normal = [0, 0, 1] }\n\
                 [spheres]\nk = { center = \"d\", radius = 1 }\n",
                "",
            ),
        };
        refused(&format!(
            "{start}[lines]\n{more}[constraints]\n{known}distances = [[{names}, 0.0]]\n"
        ))
    };
    for (names, is_flat, word) in [
        ("\"a\", \"d\"", true, "`coincident`"),
        ("\"a\", \"m\"", true, "`on`"),
        ("\"a\", \"k\"", true, "`on`"),
        ("\"l\", \"k\"", true, "`tangent`"),
        ("\"k\", \"n\"", true, "`tangent`"),
        ("\"l\", \"m\"", true, "`collinear`"),
        ("\"l\", \"x-axis\"", true, "a line on an axis"),
        ("\"d\", \"p\"", false, "`on`"),
        ("\"p\", \"k\"", false, "`tangent`"),
        ("\"m\", \"q\"", false, "a line in a plane"),
        ("\"p\", \"q\"", false, "`coplanar`"),
        ("\"l\", \"m\"", false, "lines that meet"),
    ] {
        let message = message(names, is_flat);
        assert!(
            message.contains("greater than zero") && message.contains(word),
            "{names}: {message}"
        );
    }
    // Where the number is less than zero nothing else is meant.
    let text = format!("{PLANE}[constraints]\ndistances = [[\"a\", \"d\", -1]]\n");
    assert!(!refused(&text).contains("coincident"));
}

#[test]
fn rows_of_points_are_said_back() {
    let flat = |row: &str| format!("{PLANE}[lines]\nl = [\"a\", \"b\"]\n[constraints]\n{row}\n");
    let solid = |row: &str| {
        format!("{SPACE}{MORE}[planes]\np = [\"a\", \"b\", \"c\"]\n[constraints]\n{row}\n")
    };
    for (text, words) in [
        (
            flat("distances = [[\"d\", \"a\", \"b\", 2]]"),
            Some("the point d, and the line through a and b"),
        ),
        (
            flat("distances = [[\"a\", \"b\", \"c\", \"d\", 2]]"),
            Some("the line through a and b, and the line through c and d"),
        ),
        (
            flat("distances = [[\"c\", \"d\", \"l\", 2]]"),
            Some("the line through c and d, and the line through a and b"),
        ),
        (flat("angles = [[\"a\", \"b\", \"c\", 20]]"), None),
        (
            flat("angles = [[\"x-axis\", \"c\", \"d\", 20]]"),
            Some("the x-axis, and the line through c and d"),
        ),
        (flat("distances = [[\"c\", \"l\", 2]]"), None),
        (
            solid("distances = [[\"a\", \"b\", \"c\", \"d\", 2]]"),
            Some("the point a, and the plane through b, c and d"),
        ),
        (
            solid("distances = [[\"d\", \"e\", \"a\", \"b\", \"c\", 2]]"),
            Some("the line through d and e, and the plane through a, b and c"),
        ),
        (
            solid("distances = [[\"d\", \"e\", \"f\", \"a\", \"b\", \"c\", 2]]"),
            Some("the plane through d, e and f, and the plane through a, b and c"),
        ),
        (
            solid("parallel = [[\"d\", \"e\", \"a\", \"b\"]]"),
            Some("the line through d and e, and the line through a and b"),
        ),
        (
            solid("perpendicular = [[\"d\", \"e\", \"a\", \"b\", \"c\"]]"),
            Some("the line through d and e, and the plane through a, b and c"),
        ),
        (
            solid("parallel = [[\"d\", \"e\", \"f\", \"p\"]]"),
            Some("the plane through d, e and f, and the plane through a, b and c"),
        ),
    ] {
        let problem = Problem::parse_loosely(&text, "test.toml").unwrap();
        let read = krawl::constraint::read_as(&problem, 0);
        assert_eq!(read.as_deref(), words, "{text}");
    }
}
