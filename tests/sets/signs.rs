//! Signs that a problem asks for: sets of figures with them, against signs computed from the set of all figures.

use krawl::certificate::cover::verify_cover;
use krawl::complete::{Complete, Options, Status, all};
use krawl::constraint::Symmetry;
use krawl::problem::{Orientation, Problem};
use krawl::track::{Outcome, Signs, prove};
use std::collections::BTreeSet;

/// The sign of the determinant of a figure, from floats.
fn sign(figure: &[[f64; 3]], points: &[usize]) -> f64 {
    let side = |k: usize| -> [f64; 3] {
        std::array::from_fn(|i| figure[points[k]][i] - figure[points[0]][i])
    };
    let ([a, b], c) = (
        [side(1), side(2)],
        if points.len() == 4 {
            side(3)
        } else {
            [0.0, 0.0, 1.0]
        },
    );
    let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    assert!(determinant.abs() > 1e-6, "{determinant}");
    determinant.signum()
}

fn middles(result: &Complete) -> Vec<Vec<[f64; 3]>> {
    let solutions = result.solutions.iter();
    let middles = solutions.map(|s| s.points.iter().map(|p| p.map(|x| x.mid())).collect());
    middles.collect()
}

fn with(problem: &Problem, signs: &[(&[usize], bool)]) -> Problem {
    let mut problem = problem.clone();
    problem.orientations = signs
        .iter()
        .map(|&(points, is_positive)| Orientation {
            points: points.to_vec(),
            is_positive,
        })
        .collect();
    problem.check().unwrap();
    problem
}

fn found(problem: &Problem) -> Complete {
    let result = all(problem, &Options::default()).unwrap();
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    assert_eq!(result.count, Some(result.solutions.len() as u64));
    result
}

/// All choices of two signs: each set has the figures that the set without signs says, and all figures listed have the signs.
/// Whether mirror images are figures is told by that set.
fn agree(problem: &Problem, sets: [&[usize]; 2]) -> Complete {
    let whole = found(problem);
    let mirrors = whole.symmetry == Symmetry::Isometries;
    let figures = middles(&whole);
    for first in [true, false] {
        for second in [true, false] {
            let wanted = [first, second].map(|is| if is { 1.0 } else { -1.0 });
            let of = |figure: &Vec<[f64; 3]>| {
                let signs = [0, 1].map(|k| sign(figure, sets[k]) * wanted[k]);
                signs == [1.0, 1.0] || mirrors && signs == [-1.0, -1.0]
            };
            let expected = figures.iter().filter(|figure| of(figure)).count();
            let asked = with(problem, &[(sets[0], first), (sets[1], second)]);
            let result = found(&asked);
            assert_eq!(result.solutions.len(), expected, "{first} {second}");
            let signed = result.signed.unwrap();
            assert_eq!((signed.asked, signed.undecided), (2, 0));
            assert_eq!(signed.found, expected as u64 + signed.wrong);
            for figure in middles(&result) {
                assert_eq!([0, 1].map(|k| sign(&figure, sets[k])), wanted);
            }
            assert_ne!(result.symmetry, Symmetry::Isometries);
        }
    }
    whole
}

fn disulfide() -> Problem {
    Problem::read("problems/disulfide.toml").unwrap()
}

#[test]
fn one_sign_leaves_all_figures_up_to_motions() {
    let problem = disulfide();
    for is_positive in [true, false] {
        let result = found(&with(&problem, &[(&[0, 1, 2, 7], is_positive)]));
        assert_eq!(result.solutions.len(), 18);
        assert_eq!(result.symmetry, Symmetry::Motions);
        let signs = middles(&result);
        let wanted = if is_positive { 1.0 } else { -1.0 };
        assert!(
            signs
                .iter()
                .all(|figure| sign(figure, &[0, 1, 2, 7]) == wanted)
        );
    }
}

#[test]
fn two_signs_part_the_figures_of_disulfide() {
    let problem = disulfide();
    let sets: [&[usize]; 2] = [&[0, 1, 2, 7], &[2, 3, 4, 5]];
    let whole = agree(&problem, sets);
    let count = |second| {
        let result = found(&with(&problem, &[(sets[0], true), (sets[1], second)]));
        assert!(result.signed.unwrap().cut > 0 && result.boxes < whole.boxes);
        result.solutions.len()
    };
    assert_eq!(count(true) + count(false), 18);
}

#[test]
fn reflecting_the_sketch_and_all_signs_changes_nothing() {
    let problem = disulfide();
    let mut mirrored = problem.clone();
    for point in &mut mirrored.points {
        point.sketch[2] = point.sketch[2].negative();
    }
    let sets: [&[usize]; 3] = [&[0, 1, 2, 7], &[2, 3, 4, 5], &[4, 5, 6, 7]];
    for signs in 0..8usize {
        let asked = |flip: bool| {
            let all: Vec<(&[usize], bool)> = (0..3)
                .map(|k| (sets[k], (signs >> k & 1 == 1) != flip))
                .collect();
            all
        };
        let one = found(&with(&problem, &asked(false)));
        let other = found(&with(&mirrored, &asked(true)));
        assert_eq!(one.solutions.len(), other.solutions.len(), "{signs}");
    }
}

/// In the plane, by a plan: two triangles in different places, on a frame of bars.
#[test]
fn signs_in_the_plane() {
    let problem = Problem::read("problems/k33.toml").unwrap();
    agree(&problem, [&[0, 1, 2], &[3, 4, 5]]);
}

/// Parts that hang together at sides: a strip of triangles, with signs of points in one part and of points in two.
#[test]
fn signs_of_parts_and_across() {
    let strip = r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [4, 3]
        d = [0, 3]
        e = [-3, 1]
        [constraints]
        distances = [["a", "b", 5], ["b", "c", 3], ["c", "d", 5], ["d", "a", 3.5], ["a", "e", 4], ["d", "e", 4.2], ["a", "c", 5.5]]
    "#;
    let problem = Problem::parse(strip, "strip.toml").unwrap();
    let whole = agree(&problem, [&[0, 1, 2], &[0, 2, 3]]);
    assert_eq!((whole.solutions.len(), whole.parts.len()), (4, 3));
    agree(&problem, [&[0, 1, 4], &[0, 2, 3]]);
    agree(&problem, [&[0, 1, 4], &[1, 2, 4]]);
}

/// A chiral centre: all distances of four points are given, so that there are two figures, mirror images of each other.
#[test]
fn a_chiral_centre_has_one_figure_of_each_hand() {
    let centre = r#"
        dimension = 3
        [points]
        c = [0, 0, 0]
        h = [1, 0, 0]
        f = [0, 1.3, 0.2]
        n = [0.1, -0.5, 1.4]
        [constraints]
        distances = [["c", "h", 1.1], ["c", "f", 1.35], ["c", "n", 1.47], ["h", "f", 2.0], ["h", "n", 2.1], ["f", "n", 2.3]]
        orientation = [["c", "h", "f", "n", "+"]]
    "#;
    let one = Problem::parse(centre, "c.toml").unwrap();
    assert_eq!(
        Problem::parse(&one.to_toml(), "again.toml").unwrap(),
        Problem {
            name: one.name.clone(),
            ..one.clone()
        }
    );
    let other = Problem::parse(&centre.replace("\"+\"", "\"-\""), "c.toml").unwrap();
    for (problem, wanted) in [(one, 1.0), (other, -1.0)] {
        let result = found(&problem);
        assert_eq!(result.solutions.len(), 1);
        assert_eq!(sign(&middles(&result)[0], &[0, 1, 2, 3]), wanted);
    }
}

/// Other constraints than distances, over coordinates: an angle, a distance from a line. With mirror images and without.
#[test]
fn signs_in_a_search_over_coordinates() {
    let text = r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [4, 3]
        d = [0, 3]
        e = [2, 5]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 3], ["c", "d", 4.5], ["d", "e", 3], ["c", "e", 3.2]]
        equal = [["ad", "bc"]]
        angles = [["d", "a", "b", 100]]
        [lines]
        ad = ["a", "d"]
        bc = ["b", "c"]
    "#;
    let problem = Problem::parse(text, "mixed.toml").unwrap();
    let whole = agree(&problem, [&[0, 1, 2], &[2, 3, 4]]);
    assert!(whole.solutions.len() > 1, "{}", whole.solutions.len());
    let fixed = text
        .replace("equal =", "fixed = [\"a\", \"b\"]\n        equal =")
        .replace("[\"a\", \"b\", 4], ", "");
    let fixed = Problem::parse(&fixed, "fixed.toml").unwrap();
    agree(&fixed, [&[0, 1, 2], &[2, 3, 4]]);
}

/// A cover is of all signs, and says so.
#[test]
fn a_cover_is_of_all_signs() {
    let asked = with(
        &disulfide(),
        &[(&[0, 1, 2, 7], true), (&[2, 3, 4, 5], false)],
    );
    let options = Options {
        cover: true,
        ..Options::default()
    };
    let mut result = all(&asked, &options).unwrap();
    let verdict = verify_cover(&result.cover.take().unwrap()).unwrap();
    assert_eq!((verdict.solutions, verdict.proves_all()), (Some(18), true));
    assert!(verdict.problem.orientations.is_empty() && verdict.is_about(&asked));
    assert_eq!(
        result.signed.map(|s| (s.found, s.wrong, s.cut)),
        Some((18, 10, 0))
    );
    assert_eq!((result.count, result.status), (Some(8), Status::Complete));
}

/// A flat figure has no sign: neither one that has its distances exactly, nor one that has them within their digits, alone or
/// as a part of a larger figure.
#[test]
fn a_flat_figure_has_no_sign() {
    let flat = r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [2, 1]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 1.5], ["a", "c", 2.5]]
        orientation = [["a", "b", "c", "+"]]
    "#;
    let result = found(&Problem::parse(flat, "flat.toml").unwrap());
    assert_eq!((result.count, result.signed.unwrap().wrong), (Some(0), 1));
    // To two digits a-c is 2.4, and 2.44 is what the others make it.
    let short = flat.replace("1.5]", "1.56]").replace("2.5]]", "2.4]]");
    let part = short
        .replace("c = [2, 1]", "c = [2, 1]\n        d = [3, 3]")
        .replace("2.4]]", "2.4], [\"b\", \"d\", 3], [\"c\", \"d\", 2]]");
    for nearly in [short, part] {
        let options = Options {
            within_digits: true,
            ..Options::default()
        };
        let count = |text: &str| {
            let result = all(&Problem::parse(text, "nearly.toml").unwrap(), &options).unwrap();
            assert_eq!(result.status, Status::Complete);
            result.count
        };
        let unsigned = nearly.replace("orientation", "# orientation");
        assert!(count(&unsigned) > Some(0));
        assert_eq!(count(&nearly), Some(0));
    }
}

/// With more constraints than unknowns what was left out is looked at in figures that have the signs alone.
#[test]
fn signs_come_before_what_was_left_out() {
    let text = r#"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [4, 3]
        [constraints]
        fixed = ["a", "b"]
        distances = [["a", "c", 5], ["b", "c", 3]]
        dx = [["a", "c", 4]]
        orientation = [["a", "b", "c", "-"]]
    "#;
    let asked = Problem::parse_loosely(text, "over.toml").unwrap();
    let of = |problem: &Problem| {
        let result = found(problem);
        let tested = result.tested.clone().unwrap();
        assert_eq!(tested.figures.len(), result.solutions.len());
        (tested.found, tested.met, result.count, result)
    };
    let whole = of(&asked.unsigned());
    assert_eq!((whole.0, whole.1, whole.2), (Some(2), 2, Some(2)));
    let one = of(&asked);
    assert_eq!((one.0, one.1, one.2), (Some(1), 1, Some(1)));
    assert_eq!(sign(&middles(&one.3)[0], &[0, 1, 2]), -1.0);
}

#[test]
fn bad_signs_are_refused() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [2, 1]\n[constraints]\ndistances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"a\", \"c\", 3]]\norientation = ";
    for (list, says) in [
        (r#"[["a", "b", "c", "0"]]"#, r#""+" or "-""#),
        (r#"[["a", "b", "c", 1]]"#, r#""+" or "-""#),
        (r#"[["a", "b", "c"]]"#, r#""+" or "-""#),
        (r#"["a", "b", "c", "+"]"#, r#""+" or "-""#),
        (r#""+""#, "a list in brackets"),
        (r#"[["a", "b", "x", "+"]]"#, "no point `x`"),
        (r#"[["a", "b", "b", "+"]]"#, "`b` is named twice"),
        (
            r#"[["a", "b", "+"]]"#,
            "three points in the plane, and here are 2",
        ),
        (
            r#"[["a", "b", "c", "a", "+"]]"#,
            "three points in the plane, and here are 4",
        ),
        (
            r#"[["a", "b", "c", "+"], ["b", "a", "c", "+"]]"#,
            "contradicts `orientation: a, b, c, +`",
        ),
        (
            r#"[["a", "b", "c", "+"], ["b", "c", "a", "+"]]"#,
            "says the same",
        ),
    ] {
        let error = Problem::parse(&format!("{text}{list}\n"), "t.toml")
            .unwrap_err()
            .to_string();
        let place = "t.toml:8: constraints.orientation: ";
        assert!(
            error.starts_with(place) && error.contains(says),
            "{list}: {error}"
        );
    }
}

/// Of the figures on a path those that have all signs stay, as they are or as their mirror images, each once.
#[test]
fn a_path_has_the_figures_with_the_signs() {
    let problem = disulfide();
    let sets: [&[usize]; 2] = [&[0, 1, 2, 7], &[2, 3, 4, 5]];
    let whole = prove(&problem).unwrap();
    let classes = |outcome: &Outcome| {
        let classes = outcome.solutions.iter().map(|s| s.class);
        classes.collect::<BTreeSet<usize>>()
    };
    let mut all = BTreeSet::new();
    for second in [true, false] {
        let asked = with(&problem, &[(sets[0], true), (sets[1], second)]);
        let mut outcome = whole.clone();
        Signs::of(&asked).test(&mut outcome, 3);
        let signed = outcome.signed.unwrap();
        assert_eq!((signed.found, signed.undecided), (8, 0));
        for solution in &outcome.solutions {
            let figure: Vec<[f64; 3]> =
                solution.points.iter().map(|p| p.map(|x| x.mid())).collect();
            let wanted = [1.0, if second { 1.0 } else { -1.0 }];
            assert_eq!([0, 1].map(|k| sign(&figure, sets[k])), wanted);
        }
        let own = classes(&outcome);
        assert_eq!(own.len(), outcome.solutions.len());
        assert!(own.is_disjoint(&all));
        all.extend(own);
    }
    assert_eq!(all, classes(&whole));
}
