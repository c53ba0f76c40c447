//! What constraints mean, kind by kind.

use super::quadratic::{Entry, Product, difference};
use super::testing::{Figure, angle, cross, dot, examine, near, read, size};
use super::try_lower_for_sets;
use crate::interval::point;
use crate::places::{Each as _, array};
use crate::problem::Problem;
use crate::system::{Edge, Homotopy, typical_length};

/// A problem in the plane.
fn plane(points: &str, rest: &str) -> Figure {
    examine(&format!(
        "name = \"test\"\ndimension = 2\n[points]\n{points}\n{rest}\n\
         [homotopy]\nbend_coefficient = 0"
    ))
}

/// A problem in space.
fn space(points: &str, rest: &str) -> Figure {
    examine(&format!(
        "name = \"test\"\ndimension = 3\n[points]\n{points}\n{rest}\n\
         [homotopy]\nbend_coefficient = 0"
    ))
}

const QUADRANGLE: &str = "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2.9, 2.2]\nd = [0.2, 1.9]";

#[test]
fn angles_at_a_point_between_known_lengths() {
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2.9, 2.2]",
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.5]]\nangles = [[\"a\", \"b\", \"c\", 70]]",
    );
    near(angle(f.arrow("b", "a"), f.arrow("b", "c")), 70.0);
}

/// The right-hand side is that of the cosine rule at every t, lengths and the cosine being led linearly, or for a right
/// angle the bars' product. Lines have two angles, of which the one nearer to the sketch's is meant, whichever way they run.
#[test]
fn angles_between_given_lengths_have_the_form_of_distances() {
    let at_point = r#""a", "b", "c""#;
    let lines = [
        r#""a", "b", "b", "c""#,
        r#""b", "a", "b", "c""#,
        r#""c", "b", "b", "a""#,
    ];
    let all = lines.into_iter().chain([at_point]);
    let all = all.flat_map(|items| [(2, 70.0f64), (3, 110.0), (2, 90.0)].each(|of| (items, of)));
    for (items, (dimension, degrees)) in all {
        let z = if dimension == 3 { ", 0.3" } else { "" };
        let more = match dimension {
            3 => "\nd = [1, 1.1, 1.9]",
            _ => "",
        };
        let joined = match dimension {
            3 => ", [\"a\", \"d\", 2.5], [\"b\", \"d\", 3], [\"c\", \"d\", 2.6]",
            _ => "",
        };
        let problem = read(&format!(
            "name = \"test\"\ndimension = {dimension}\n[points]\na = [0.1, 0{z}]\nb = [3.1, 0.2{z}]\nc = [2.9, 2.2{z}]{more}\n\
             [constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.5]{joined}]\n\
             angles = [[{items}, {degrees}]]\n"
        ));
        let homotopy = Homotopy::new(&problem).unwrap();
        let all: Vec<Edge> = homotopy.half_squares().collect();
        assert_eq!(all.len(), homotopy.equations);
        let mut ends = all[homotopy.equations - 1].points;
        ends.sort_unstable();
        assert_eq!(ends, [0, 2]);
        let at = |p: usize| problem.points[p].place();
        let arrow = |to: usize| -> [f64; 3] { array(|k| at(to)[k] - at(1)[k]) };
        let (u, v) = (arrow(0), arrow(2));
        let product = dot(u, v);
        let cosine = degrees.to_radians().cos();
        let cosine = match items == at_point {
            true => cosine,
            false => cosine.abs() * product.signum(),
        };
        for t in [0.0, 0.25, 0.7, 1.0] {
            let lead = |from: f64, to: f64| from + t * (to - from);
            let bend = problem.bend();
            let c = problem.homotopy.bend_coefficient.to_f64();
            let bent = |d: usize| {
                if bend == Some(d) {
                    c * t * (1.0 - t)
                } else {
                    0.0
                }
            };
            let a = lead(size(u), 3.0) + bent(0);
            let b = lead(size(v), 2.5) + bent(1);
            let inner = match degrees {
                90.0 => lead(product, 0.0),
                _ => a * b * lead(product / (size(u) * size(v)), cosine),
            };
            let unit = homotopy.unit;
            let right = homotopy.rights[homotopy.equations - 1]
                .enclose(point(t))
                .mid();
            near(right * unit * unit, 0.5 * (a * a + b * b) - inner);
        }
    }
}

#[test]
fn angles_between_unknown_lengths() {
    let f = plane(
        QUADRANGLE,
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"c\", \"d\", 2.7]]\n\
         angles = [[\"d\", \"a\", \"b\", 81], [\"b\", \"c\", \"d\", 86], [\"a\", \"b\", \"c\", 92]]",
    );
    near(angle(f.arrow("a", "d"), f.arrow("a", "b")), 81.0);
    near(angle(f.arrow("c", "b"), f.arrow("c", "d")), 86.0);
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2.9, 2.2]\nd = [0.2, 1.3]",
        "[lines]\ng = [\"a\", \"b\"]\nh = [\"c\", \"d\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"c\", \"d\", 2.8], [\"a\", \"d\", 1.4]]\n\
         angles = [[\"g\", \"h\", 16], [\"d\", \"a\", \"b\", 80]]",
    );
    // The sketch's lines run opposite ways: 164 degrees between the directions.
    near(angle(f.arrow("a", "b"), f.arrow("c", "d")), 164.0);
    near(angle(f.arrow("a", "d"), f.arrow("a", "b")), 80.0);
}

#[test]
fn distances_from_lines_in_the_plane() {
    for known in ["[\"a\", \"b\", 3], ", ""] {
        let more = if known.is_empty() {
            "dx = [[\"a\", \"b\", 3]]\nhorizontal = [[\"a\", \"b\"]]"
        } else {
            ""
        };
        let f = plane(
            "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]",
            &format!(
                "[constraints]\ndistances = [[\"a\", \"c\", 2.5], {known}[\"c\", \"a\", \"b\", 1.5]]\n{more}"
            ),
        );
        near(f.off_line("c", "a", "b"), 1.5);
        assert!(cross(f.arrow("a", "b"), f.arrow("a", "c"))[2] > 0.0);
    }
}

#[test]
fn distances_in_space() {
    let points = "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]";
    let f = space(
        points,
        "[lines]\ng = [\"a\", \"b\"]\n[planes]\ne = [\"a\", \"b\", \"c\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
         [\"d\", \"e\", 1.7], [\"d\", \"g\", 2], [\"d\", \"c\", 2.2]]",
    );
    near(f.off_plane("d", "a", "b", "c"), 1.7);
    near(f.off_line("d", "a", "b"), 2.0);
    let f = space(
        points,
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
         [\"d\", \"c\", 2.2], [\"d\", \"a\", 2.4]]\n\
         perpendicular = [[\"a\", \"b\", \"c\", \"d\"]]",
    );
    near(dot(f.arrow("a", "b"), f.arrow("c", "d")), 0.0);
    let f = space(
        points,
        "[lines]\ng = [\"a\", \"b\"]\nh = [\"c\", \"d\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"c\", \"d\", 2.2], [\"g\", \"h\", 1.2], \
         [\"a\", \"c\", 2.2], [\"b\", \"d\", 2.8]]\nangles = [[\"g\", \"h\", 80]]",
    );
    let n = cross(f.arrow("a", "b"), f.arrow("c", "d"));
    near(dot(n, f.arrow("a", "c")).abs() / size(n), 1.2);
    near(angle(f.arrow("a", "b"), f.arrow("c", "d")), 80.0);
}

#[test]
fn planes_and_angles_in_space() {
    let points =
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [1.3, 2.5, 1.6]";
    let f = space(
        points,
        "[planes]\nbase = [\"a\", \"b\", \"c\"]\nroof = [\"c\", \"d\", \"e\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.7], [\"a\", \"c\", 2.2], \
         [\"d\", \"c\", 2.1], [\"d\", \"a\", 2.5], [\"c\", \"e\", 1.5], [\"d\", \"e\", 1.7]]\n\
         angles = [[\"base\", \"roof\", 78], [\"base\", \"a\", \"d\", 48]]",
    );
    let n = f.normal("a", "b", "c");
    let between = angle(n, f.normal("c", "d", "e"));
    near(between.min(180.0 - between), 78.0);
    near((90.0 - angle(n, f.arrow("a", "d"))).abs(), 48.0);
    let f = space(
        points,
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
         [\"d\", \"c\", 2.2], [\"d\", \"a\", 2.4], [\"d\", \"b\", 2.8], [\"c\", \"e\", 1.5]]\n\
         coplanar = [[\"a\", \"c\", \"d\", \"e\"]]\nparallel = [[\"c\", \"e\", \"a\", \"b\", \"d\"]]",
    );
    near(f.off_plane("e", "a", "c", "d"), 0.0);
    near(dot(f.normal("a", "b", "d"), f.arrow("c", "e")), 0.0);
}

#[test]
fn parallel_planes_and_lines_on_planes() {
    let points = "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [2.3, 2.5, 2.2]\nf = [0.3, 2.4, 2.1]";
    let f = space(
        points,
        "[planes]\nbase = [\"a\", \"b\", \"c\"]\nroof = [\"d\", \"e\", \"f\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
         [\"d\", \"base\", 1.8], [\"d\", \"e\", 2], [\"e\", \"f\", 2.1], [\"d\", \"f\", 1.8], [\"c\", \"f\", 2], [\"a\", \"d\", 2.5]]\n\
         parallel = [[\"base\", \"roof\"]]\nperpendicular = [[\"a\", \"b\", \"b\", \"e\"]]",
    );
    near(
        size(cross(f.normal("a", "b", "c"), f.normal("d", "e", "f"))),
        0.0,
    );
    near(dot(f.arrow("a", "b"), f.arrow("b", "e")), 0.0);
    let f = space(
        points,
        "[planes]\nbase = [\"a\", \"b\", \"c\"]\nroof = [\"d\", \"e\", \"f\"]\n[lines]\ng = [\"c\", \"f\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], [\"a\", \"d\", 2.4], \
         [\"d\", \"e\", 2], [\"e\", \"f\", 2.1], [\"d\", \"f\", 1.8], [\"c\", \"f\", 2.1], [\"b\", \"e\", 3.2]]\n\
         perpendicular = [[\"base\", \"g\"], [\"base\", \"d\", \"e\", \"b\"]]",
    );
    near(angle(f.normal("a", "b", "c"), f.arrow("c", "f")), 0.0);
    near(dot(f.normal("a", "b", "c"), f.normal("d", "e", "b")), 0.0);
}

#[test]
fn points_on_lines_planes_and_spheres() {
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]\nd = [1.2, 0.3]\ne = [1, 1]",
        "[lines]\ng = [\"a\", \"b\"]\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.5], [\"a\", \"c\", 2.6], [\"c\", \"d\", 2.3], \
         [\"d\", \"e\", 0.8]]\non = [[\"d\", \"g\"]]\ncollinear = [[\"a\", \"c\", \"e\"]]",
    );
    near(f.off_line("d", "a", "b"), 0.0);
    near(f.off_line("e", "a", "c"), 0.0);
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [1.3, 2.5, 0.6]",
        "[lines]\ng = [\"c\", \"d\"]\n[planes]\np = [\"a\", \"b\", \"c\"]\n[spheres]\ns = { center = \"a\", radius = 2.2 }\n\
         [constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
         [\"d\", \"c\", 2.2], [\"d\", \"b\", 2.6], [\"b\", \"e\", 2.7]]\nradii = [[\"s\", 2.5]]\n\
         on = [[\"d\", \"s\"], [\"e\", \"s\"], [\"e\", \"p\"]]",
    );
    near(f.distance("a", "d"), 2.5);
    near(f.distance("a", "e"), 2.5);
    near(f.off_plane("e", "a", "b", "c"), 0.0);
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [1.1, 1.4, 1.3]\nf = [2, 1, 0.3]",
        "[lines]\ng = [\"c\", \"d\"]\n[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], \
         [\"a\", \"c\", 2.1], [\"d\", \"c\", 2.2], [\"d\", \"a\", 2.4], [\"d\", \"b\", 2.6], [\"c\", \"e\", 1], \
         [\"f\", \"b\", 1.2]]\non = [[\"e\", \"g\"]]\ncollinear = [[\"b\", \"c\", \"f\"]]",
    );
    near(f.off_line("e", "c", "d"), 0.0);
    near(f.off_line("f", "b", "c"), 0.0);
}

#[test]
fn parallel_lines() {
    let f = plane(
        QUADRANGLE,
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"c\", \"d\", 2.5], [\"a\", \"d\", 2], [\"b\", \"c\", 2.1]]\n\
         parallel = [[\"a\", \"b\", \"c\", \"d\"]]",
    );
    near(cross(f.arrow("a", "b"), f.arrow("c", "d"))[2], 0.0);
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [3.2, 2.1, 0.9]",
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], [\"c\", \"d\", 2.2]]\n\
         parallel = [[\"a\", \"b\", \"c\", \"d\"]]",
    );
    near(size(cross(f.arrow("a", "b"), f.arrow("c", "d"))), 0.0);
}

#[test]
fn the_users_own_frame() {
    let f = plane(
        QUADRANGLE,
        "[circles]\nk = { center = \"a\", radius = 2.1 }\n[constraints]\nfixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]\n\
         vertical = [[\"b\", \"c\"]]\ny = [[\"c\", 2]]\ndx = [[\"d\", \"c\", 3]]\ndiameters = [[\"k\", 4]]\n\
         on = [[\"d\", \"k\"]]\ndistances = [[\"a\", \"b\", 3]]",
    );
    near(f.arrow("a", "b")[1], 0.0);
    near(f.arrow("b", "c")[0], 0.0);
    near(f.arrow("d", "c")[0], 3.0);
    near(f.distance("a", "d"), 2.0);
    near(f.arrow("a", "c")[1], 2.0);
    // Nothing is fixed: the first point is held.
    let f = plane(
        "a = [0.5, 0.25]\nb = [3.1, 0.2]\nc = [2.9, 2.2]",
        "[constraints]\nhorizontal = [[\"a\", \"b\"]]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2], [\"a\", \"c\", 3]]",
    );
    near(f.arrow("a", "b")[1], 0.0);
}

#[test]
fn coincident_points() {
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]\nd = [2.1, 2.1]",
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.5], [\"a\", \"d\", 2.6]]\n\
         coincident = [[\"c\", \"d\"]]",
    );
    near(f.distance("c", "d"), 0.0);
}

#[test]
fn lines_and_planes_of_their_own() {
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]",
        "[lines]\ng = { point = [0, 3], direction = [3, 1] }\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.3], [\"c\", \"a\", 2.95], [\"a\", \"g\", 2.7]]\non = [[\"c\", \"g\"]]",
    );
    near(f.distance("a", "b"), 3.0);
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]",
        "[lines]\ng = { point = [1, 1, 1], direction = [1, 0.3, 0.2] }\nh = { point = [0, 1, 2], direction = [0, 1, 0.2] }\n\
         [planes]\np = { point = [0, 0, 3], normal = [0.1, 0, 1] }\n[constraints]\n\
         distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], [\"a\", \"g\", 1], [\"b\", \"g\", 1.7], \
         [\"c\", \"g\", 1.25], [\"a\", \"h\", 1.8], [\"b\", \"h\", 3.4], [\"g\", \"h\", 1.1], [\"a\", \"p\", 2.9], [\"b\", \"p\", 2.6], [\"c\", \"p\", 2.6]]\n\
         angles = [[\"g\", \"h\", 70], [\"h\", \"p\", 11]]\n",
    );
    near(f.distance("a", "b"), 3.0);
}

#[test]
fn bodies() {
    let f = plane(
        "a = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]\nd = [1, 0.9]",
        "[bodies]\np = { a = [0, 0], b = [3, 0], c = [1, 2], d = [1, 1] }\n[constraints]",
    );
    near(f.distance("a", "b"), 3.0);
    near(f.distance("c", "d"), 1.0);
    assert!(cross(f.arrow("a", "b"), f.arrow("a", "c"))[2] > 0.0);
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [1.3, 2.5, 0.6]",
        "[bodies]\np = { a = [0, 0, 0], b = [3, 0, 0], c = [1, 2, 0], d = [1, 1, 2], e = [1.5, 2.5, 0] }\n[constraints]",
    );
    near(f.distance("a", "d"), 6f64.sqrt());
    near(f.distance("b", "e"), 8.5f64.sqrt());
    near(f.distance("d", "e"), (0.25f64 + 2.25 + 4.0).sqrt());
    assert!(dot(f.normal("a", "b", "c"), f.arrow("a", "d")) > 0.0);
}

#[test]
fn arcs() {
    let f = plane(
        "m = [0, 0]\na = [2, 0.1]\nb = [0.2, 2.1]",
        "[arcs]\nk = { center = \"m\", start = \"a\", end = \"b\" }\n[constraints]\nradii = [[\"k\", 3]]\n\
         distances = [[\"a\", \"b\", 4]]",
    );
    near(f.distance("m", "a"), 3.0);
    near(f.distance("m", "b"), 3.0);
}

#[test]
fn the_documents_examples() {
    let text = include_str!("../../../../docs/using/problem-files.md");
    let blocks = text.split("```toml\n").skip(1);
    let problems: Vec<_> = blocks
        .map(|block| block.split("```").next().unwrap())
        .collect();
    assert!(problems.len() >= 4);
    let mut kinds: Vec<String> = Vec::new();
    for problem in &problems {
        examine(&format!("{problem}\n[homotopy]\nbend_coefficient = 0"));
        let problem = super::testing::read(problem);
        kinds.extend(problem.constraints.into_iter().map(|c| c.kind));
    }
    for kind in super::KINDS {
        let (begin, end) = (
            format!("| `{}` | `", kind.key),
            format!("` | {} |", kind.meaning),
        );
        let row = text.lines().find_map(|line| line.strip_prefix(&begin));
        let entry = row.and_then(|row| row.strip_suffix(&end));
        let entry = entry.unwrap_or_else(|| panic!("not in the document: {begin}...{end}"));
        // An entry has a number where its kind has one.
        let entry: toml_edit::Value = entry.parse().unwrap();
        let last = entry.as_array().and_then(|names| names.iter().last());
        let has_number = last.is_some_and(|last| last.is_integer() || last.is_float());
        assert_eq!(
            has_number,
            kind.measure != super::Measure::Nothing,
            "{entry}"
        );
        let tested = ["z", "dz", "dy", "dx"].contains(&kind.key)
            || kinds.iter().any(|used| used == kind.key);
        assert!(tested, "no example has {}", kind.key);
    }
    let table = text.split("<!-- kinds -->").nth(1).unwrap();
    let rows = table.split("<!-- /kinds -->").next().unwrap().lines();
    assert_eq!(
        rows.filter(|line| line.starts_with("| `")).count(),
        super::KINDS.len()
    );
}

#[test]
fn equal_lengths_and_distances() {
    let f = plane(
        "a = [0, 0]\nb = [3, 0.2]\nc = [4, 2.1]\nd = [1.2, 1.8]",
        "[constraints]\ndistances = [[\"a\", \"b\", 3], [\"a\", \"d\", 2.2]]\n\
         equal = [[\"b\", \"c\", \"a\", \"d\"]]\nangles = [[\"a\", \"b\", \"c\", 115]]\n\
         equal_distances = [[\"c\", \"a\", \"b\", \"b\", \"c\", \"d\"]]",
    );
    near(f.distance("b", "c"), f.distance("a", "d"));
    near(f.off_line("c", "a", "b"), f.off_line("b", "c", "d"));
}

/// Which side a point is on cannot be read off a sketch in which it is on its line, and where the line goes through it there is
/// none at all: the words say what to do.
#[test]
fn equal_distances_that_are_zero_in_the_sketch_are_refused() {
    let refused = |d: &str, row: &str| {
        let text = format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nc = [4, 2.1]\nd = {d}\n[constraints]\n\
             distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2], [\"a\", \"d\", 2.2], [\"c\", \"d\", 3]]\n\
             equal_distances = [[{row}]]\n"
        );
        Problem::parse(&text, "test.toml").unwrap_err().to_string()
    };
    let on_it = refused("[1, 0]", r#""d", "a", "b", "a", "b", "c""#);
    assert!(
        on_it.contains("`d` is on the line in the sketch"),
        "{on_it}"
    );
    assert!(
        on_it.contains("say `on` of each point and its line"),
        "{on_it}"
    );
    let own = refused("[1, 2]", r#""d", "a", "b", "b", "b", "c""#);
    assert!(own.contains("the line goes through `b` itself"), "{own}");
    assert!(own.contains("say `on` of the other point"), "{own}");
}

#[test]
fn tangents_of_circles_and_arcs() {
    // From outside and from inside; a line beside both.
    let f = plane(
        "a = [0, 0]\nb = [3.1, 0.2]\nc = [0.3, 0.1]\np = [-1, 1.1]\nq = [3, 1]",
        "[circles]\nk = { center = \"a\", radius = 1 }\nl = { center = \"b\", radius = 2 }\n\
         m = { center = \"c\", radius = 0.6 }\n[constraints]\nradii = [[\"k\", 1.1], [\"l\", 2], [\"m\", 0.7]]\n\
         tangent = [[\"k\", \"l\"], [\"k\", \"m\"], [\"p\", \"q\", \"k\"]]\n\
         distances = [[\"c\", \"b\", 2.8], [\"p\", \"q\", 4], [\"p\", \"a\", 1.5], [\"q\", \"b\", 0.9]]",
    );
    near(f.distance("a", "b"), 3.1);
    near(f.distance("a", "c"), 0.4);
    near(f.off_line("a", "p", "q"), 1.1);
    // At shared ends: a line into an arc into another arc.
    let f = plane(
        "a = [-2, 0]\nb = [0, 0.1]\nm = [0.1, 1]\nc = [1, 1.1]\nn = [1.8, 1]\nd = [1.7, 2]",
        "[arcs]\nk = { center = \"m\", start = \"b\", end = \"c\" }\nl = { center = \"n\", start = \"c\", end = \"d\" }\n\
         [constraints]\nradii = [[\"k\", 1], [\"l\", 0.9]]\ntangent = [[\"k\", \"a\", \"b\"], [\"k\", \"l\"]]\n\
         distances = [[\"a\", \"b\", 2], [\"b\", \"c\", 1.4], [\"c\", \"d\", 1.2]]",
    );
    near(dot(f.arrow("a", "b"), f.arrow("b", "m")), 0.0);
    near(cross(f.arrow("m", "c"), f.arrow("c", "n"))[2], 0.0);
    near(f.distance("m", "n"), 1.9);
}

#[test]
fn tangent_spheres_and_mirrors_in_space() {
    let f = space(
        "a = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [1.2, 0.9, 2]\ne = [1.4, 1, -1.7]",
        "[planes]\nbase = [\"a\", \"b\", \"c\"]\n[spheres]\ns = { center = \"d\", radius = 1.7 }\nt = { center = \"a\", radius = 0.8 }\n\
         [constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.7], [\"a\", \"c\", 2.2], [\"c\", \"d\", 2]]\n\
         radii = [[\"s\", 1.7], [\"t\", 0.8]]\ntangent = [[\"s\", \"base\"], [\"s\", \"t\"]]\n\
         symmetric = [[\"d\", \"e\", \"base\"]]",
    );
    near(f.off_plane("d", "a", "b", "c"), 1.7);
    near(f.distance("a", "d"), 2.5);
    near(f.distance("a", "e"), 2.5);
    near(f.distance("c", "e"), f.distance("c", "d"));
}

#[test]
fn mirrors_in_the_plane() {
    let f = plane(
        "a = [0.1, -2]\nb = [1.4, 0.6]\nc = [0, 1.6]\nd = [-1.5, 0.5]\nm = [0.1, 0.4]",
        "[constraints]\nsymmetric = [[\"b\", \"d\", \"a\", \"c\"], [\"b\", \"d\", \"m\"]]\n\
         distances = [[\"a\", \"b\", 3], [\"a\", \"c\", 3.5], [\"b\", \"c\", 1.8]]",
    );
    near(f.distance("a", "d"), 3.0);
    near(f.distance("c", "d"), 1.8);
    near(f.distance("b", "m"), f.distance("d", "m"));
    near(f.off_line("m", "b", "d"), 0.0);
}

#[test]
fn detours_leave_and_come_back() {
    let text = "name = \"t\"\ndimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nc = [0, 2]\n[constraints]\n\
                distances = [[\"a\", \"b\", 3.5], [\"a\", \"c\", 2]]\nperpendicular = [[\"a\", \"b\", \"a\", \"c\"]]\n";
    let right = |text: &str| {
        let problem = super::testing::read(text);
        super::try_lower(&problem).unwrap().tail.equations[0]
            .right
            .len()
    };
    assert_eq!(right(text), 1);
    let with = format!("{text}[homotopy]\nbend_coefficient = 0\ndetour = 0.5");
    assert_eq!(right(&with), 3);
    let f = examine(&with);
    near(dot(f.arrow("a", "b"), f.arrow("a", "c")), 0.0);
}

#[test]
fn mirror_images_are_solutions_unless_a_side_is_meant() {
    let mirrors = |text: &str| {
        let problem = super::testing::read(text);
        super::try_lower(&problem).unwrap().tail.mirrors
    };
    let three = "dimension = 2\n[points]\na = [0.1, 0]\nb = [3.1, 0.2]\nc = [2, 2.2]\n[constraints]\n\
                 distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.4]";
    assert!(mirrors(&format!(
        "{three}]\nangles = [[\"b\", \"a\", \"c\", 50]]"
    )));
    assert!(mirrors(&format!(
        "{three}]\nperpendicular = [[\"b\", \"a\", \"c\", \"b\"]]"
    )));
    assert!(!mirrors(&format!("{three}, [\"c\", \"a\", \"b\", 2]]")));
    assert!(!mirrors(&format!(
        "{three}]\nhorizontal = [[\"a\", \"b\"]]\ndx = [[\"a\", \"c\", 2]]"
    )));
}

/// With the reference among them, coplanar points cost no unknowns.
#[test]
fn points_in_the_plane_of_the_reference() {
    let text = |reference: &str| {
        format!(
            "dimension = 3\n[points]\na = [0, 0, 0]\nb = [3, 0.2, 0.1]\nc = [1, 2, 0.3]\nd = [2.2, 1.9, 0.2]\n\
             e = [1, 1, 2]\n[constraints]\ndistances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2.8], [\"a\", \"c\", 2.1], \
             [\"d\", \"b\", 2], [\"d\", \"c\", 1.2], [\"a\", \"e\", 2.5], [\"b\", \"e\", 2.9], [\"c\", \"e\", 2]]\n\
             coplanar = [[\"d\", \"a\", \"b\", \"c\"]]\n[homotopy]\nbend_coefficient = 0\nreference = [{reference}]"
        )
    };
    for (reference, unknowns) in [("\"a\", \"b\", \"c\"", 0), ("\"a\", \"b\", \"e\"", 3)] {
        let text = text(reference);
        let problem = super::testing::read(&text);
        let lowered = super::try_lower(&problem).unwrap();
        assert_eq!(lowered.tail.unknowns.len(), unknowns);
        assert!(lowered.tail.mirrors);
        near(examine(&text).off_plane("d", "a", "b", "c"), 0.0);
    }
}

/// In sets of figures what is equal in all of them has one name, in distances, too.
#[test]
fn sets_have_one_name_for_what_is_equal() {
    let problem = read(
        "name = \"test\"\ndimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nb2 = [3, 0]\nc = [4, 2]\nd = [9, 2]\n\
         [constraints]\nfixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"], [\"c\", \"d\"]]\ncoincident = [[\"b\", \"b2\"]]\n\
         distances = [[\"a\", \"b\", 3], [\"b2\", \"c\", 2], [\"a\", \"c\", 4], [\"c\", \"d\", 5]]\n",
    );
    let (tail, _) = try_lower_for_sets(&problem, |_| Ok(Vec::new())).unwrap();
    let left = |e: usize| tail.equations[e].products.clone();
    let at = |point, axis| Entry::Coordinate { point, axis };
    let square = |a, b| Product::new(1, difference(a, b), difference(a, b));
    // a is at the origin, so that b is on the x axis.
    let [ax, bx, cx, cy, dx] = [Entry::Zero, at(1, 0), at(3, 0), at(3, 1), at(4, 0)];
    let is_square = |e: usize, pairs: &[[Entry; 2]]| {
        let all = left(e).into_iter().zip(pairs);
        all.len() == pairs.len()
            && left(e).len() == pairs.len()
            && all
                .into_iter()
                .all(|(one, &[a, b])| one == square(a, b) || one == square(b, a))
    };
    assert!(is_square(0, &[[ax, bx]]), "{:?}", left(0));
    assert!(
        is_square(1, &[[bx, cx], [Entry::Zero, cy]]),
        "{:?}",
        left(1)
    );
    assert!(
        is_square(2, &[[ax, cx], [Entry::Zero, cy]]),
        "{:?}",
        left(2)
    );
    assert!(is_square(3, &[[cx, dx]]), "{:?}", left(3));
    // The search has the same names.
    let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
    assert_eq!(homotopy.edges.len(), 0);
    assert_eq!(homotopy.equations, tail.equations.len());
}
