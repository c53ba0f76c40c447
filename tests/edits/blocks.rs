//! Problems that fall apart into blocks: `solve` answers block by block and combines.

use assert_cmd::Command;
use krawl::report::{Document, Listed};
use serde_json::Value;
use std::fs;

const RECTANGLE: &str = "name = \"rectangle\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n\
    [constraints]\ndistances = [[\"a\", \"b\", 5], [\"b\", \"c\", 3], [\"c\", \"d\", 5], [\"d\", \"a\", 3]]\n\
    squared_distances = [[\"a\", \"c\", 34]]\n";

fn krawl(arguments: &[&str], input: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = command.args(arguments).write_stdin(input).output().unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
    )
}

#[test]
fn a_rectangle_is_solved_by_its_two_triangles() {
    let (code, text) = krawl(&["solve", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("rectangle, block 1 of 2 (a, b and c): Closed, proved"),
        "{text}"
    );
    assert!(
        text.contains("Combined, proved: 2 figures up to motions and reflections"),
        "{text}"
    );
    assert!(
        text.contains("Figure 2: block 1 solution 1, block 2 solution 1 mirrored"),
        "{text}"
    );
    let (code, text) = krawl(&["check", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("blocks\n  2, which share no more than a side\n  1: a, b, c\n  2: a, c, d\n"),
        "{text}"
    );
}

/// The combined figures meet all dimensions, and the rectangle is among them.
#[test]
fn combined_figures_are_in_the_result() {
    let (code, text) = krawl(&["solve", "-", "--json", "-"], RECTANGLE);
    assert_eq!(code, Some(0), "{text}");
    let result: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(result["status"], "stopped");
    let blocks = &result["blocks"];
    assert_eq!(blocks["proved"], true);
    assert_eq!(blocks["count"], 2);
    assert_eq!(blocks["without_mirror_images"], true);
    assert_eq!(blocks["runs"].as_array().unwrap().len(), 2);
    assert_eq!(blocks["runs"][0]["status"], "closed");
    let figures = blocks["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 2);
    let mut rectangles = 0;
    for figure in figures {
        let at = |p: &str| [0, 1].map(|k| figure["points"][p][k][0].as_f64().unwrap());
        let squared = |p: &str, q: &str| {
            let (p, q) = (at(p), at(q));
            (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)
        };
        for (p, q, wanted) in [
            ("a", "b", 25.0),
            ("b", "c", 9.0),
            ("c", "d", 25.0),
            ("d", "a", 9.0),
            ("a", "c", 34.0),
        ] {
            assert!((squared(p, q) - wanted).abs() < 1e-12, "{figure}");
        }
        rectangles += usize::from((squared("b", "d") - 34.0).abs() < 1e-12);
    }
    assert_eq!(rectangles, 1);
}

const SLOT: [&str; 4] = ["solve", "problems/sketches/parts.FCStd", "--sketch", "Slot"];

/// A sketch of another program is solved block by block: each figure is proved, and there is no other but on other paths.
#[test]
fn shipped_sketches_are_solved_by_their_blocks() {
    let (code, text) = krawl(&SLOT, "");
    assert_eq!(code, Some(0), "{text}");
    assert!(text.starts_with("Slot: Combined, proved: "), "{text}");
    assert!(text.contains("\nFigure 1"), "{text}");
    let frame = [
        "solve",
        "problems/sketches/parts.FCStd",
        "--sketch",
        "Frame",
    ];
    let (code, text) = krawl(&frame, "");
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.starts_with(
            "Frame: Complete, proved: 1 figure meets all constraints, and there is no other"
        ),
        "{text}"
    );
    assert!(text.contains("\n  e5: radius 18.793852415718"), "{text}");
    let (code, text) = krawl(
        &["solve", "problems/sketches/bracket.slvs", "--summary"],
        "",
    );
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("4 figures meet all constraints"), "{text}");
}

/// Every figure listed meets what the sketch says, and the first is the one that the sketch has.
#[test]
fn figures_of_sketches_are_in_the_result() {
    let (code, text) = krawl(
        &["solve", "problems/sketches/bracket.slvs", "--json", "-"],
        "",
    );
    assert_eq!(code, Some(0), "{text}");
    let result: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(result["status"], "complete");
    assert_eq!(result["count"], 4);
    let figures = result["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 4);
    let mut turned = 0;
    for figure in figures {
        let at = |p: &str| [0, 1].map(|k| figure["points"][p][k][0].as_f64().unwrap());
        let [a, b, c, d] = ["r007.2", "r004.2", "r006.1", "r006.2"].map(at);
        let apart = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        assert!((apart(a, b) - 50.0).abs() < 1e-12 && (apart(c, d) - 35.0).abs() < 1e-12);
        assert!((apart(a, d) - 40.0).abs() < 1e-12);
        assert!((apart(b, c) - 30.0).abs() < 1e-12);
        turned += usize::from(d[1] < 0.0);
        let hole = &figure["radii"]["r008"];
        assert_eq!((hole[0].as_f64(), hole[1].as_f64()), (Some(5.0), Some(5.0)));
    }
    assert_eq!(turned, 2);
    assert!(figures[0]["points"]["r006.2"][1][0].as_f64().unwrap() > 30.0);
}

/// Points one after the other, each at given distances from two before it: every one of the 2^n figures is found, in a
/// frame of its own, and each meets all distances.
#[test]
fn a_chain_of_intersections_has_all_its_figures() {
    use krawl::blocks::Figures;
    use krawl::problem::Problem;
    use krawl::track::{Control, Options};
    let places: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [4.0, 0.5],
        [1.0, 3.0],
        [5.0, 3.5],
        [2.5, 6.0],
        [6.0, 7.0],
    ];
    let names = ["a", "b", "c", "d", "e", "f"];
    let mut build = Problem::build("chain", 2);
    for (name, at) in names.iter().zip(places) {
        // A sketch that is off by up to a tenth.
        let off = 0.1 * (at[0] * 7.0 + at[1] * 3.0).sin();
        build = build.point(
            name,
            at.map(|x| format!("{:.6}", x + off))
                .iter()
                .map(String::as_str),
        );
    }
    build = build.constraint("fixed", ["a"]).constraint("fixed", ["b"]);
    for k in 2..places.len() {
        for j in [k - 2, k - 1] {
            let apart = (places[k][0] - places[j][0]).hypot(places[k][1] - places[j][1]);
            build = build.distance(names[j], names[k], format!("{apart:.3}").as_str());
        }
    }
    let problem = build.finish().unwrap();
    let find = |problem: &Problem| {
        Figures::find(problem, &Options::certified(), &mut Control::default()).unwrap()
    };
    let figures = find(&problem);
    assert!(figures.doubt().is_none() && !figures.has_paths());
    let count = figures.count().unwrap();
    let mut seen: Vec<Vec<f64>> = Vec::new();
    for number in 0..count {
        let (points, _) = figures.figure(number);
        for distance in &problem.distances {
            let [p, q] = distance.points.map(|p| points[p]);
            let squared = (p[0] - q[0]).sqr() + (p[1] - q[1]).sqr();
            let krawl::problem::Target::Length(length) = &distance.target else {
                panic!()
            };
            assert!(squared.contains(length.to_f64().powi(2)) && squared.wid() < 1e-9);
        }
        let all: Vec<f64> = points.iter().flatten().map(|x| x.mid()).collect();
        assert!(
            seen.iter()
                .all(|other| { other.iter().zip(&all).any(|(x, y)| (x - y).abs() > 1e-6) })
        );
        seen.push(all);
    }
    // By steps of trial: at each point two intersections of circles, or none.
    let lengths: Vec<f64> = problem
        .distances
        .iter()
        .map(|d| match &d.target {
            krawl::problem::Target::Length(length) => length.to_f64(),
            _ => panic!(),
        })
        .collect();
    let fixed: Vec<[f64; 2]> = problem.points[..2]
        .iter()
        .map(|p| [p.sketch[0].to_f64(), p.sketch[1].to_f64()])
        .collect();
    let mut partial = vec![fixed];
    for k in 2..places.len() {
        let mut next = Vec::new();
        for figure in partial {
            let [p, q] = [figure[k - 2], figure[k - 1]];
            let [r, s] = [lengths[2 * (k - 2)], lengths[2 * (k - 2) + 1]];
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            let d = dx.hypot(dy);
            let along = (r * r - s * s + d * d) / (2.0 * d);
            let square = r * r - along * along;
            assert!(square.abs() > 1e-6, "the example must not be in doubt");
            if square > 0.0 {
                for h in [square.sqrt(), -square.sqrt()] {
                    let x = p[0] + (along * dx - h * dy) / d;
                    let y = p[1] + (along * dy + h * dx) / d;
                    let mut longer = figure.clone();
                    longer.push([x, y]);
                    next.push(longer);
                }
            }
        }
        partial = next;
    }
    assert_eq!(count as usize, partial.len());
    // The senses are those of the triangles in floats, far from flat.
    let senses = figures.senses().unwrap();
    let area = |at: &dyn Fn(usize) -> [f64; 2], set: &[usize]| {
        let [a, b, c] = [0, 1, 2].map(|k| at(set[k]));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let sketch = |p: usize| [0, 1].map(|k| problem.points[p].sketch[k].to_f64());
    let mut kept = Vec::new();
    for number in 0..count {
        let (points, _) = figures.figure(number);
        let now = |p: usize| [0, 1].map(|k| points[p][k].mid());
        let compared = figures.compared(number);
        assert!(compared.len() >= places.len() - 2);
        for (sense, compared) in senses.iter().zip(&compared) {
            let index = |name: &str| names.iter().position(|n| *n == name).unwrap();
            let set: Vec<usize> = sense.name.split(", ").map(index).collect();
            let product = area(&sketch, &set) * area(&now, &set);
            let expected = match product > 0.0 {
                true => krawl::blocks::Comparison::Same,
                false => krawl::blocks::Comparison::Other,
            };
            assert!(product.abs() > 1e-6);
            assert_eq!(*compared, expected, "{}", sense.name);
        }
        if compared
            .iter()
            .all(|c| *c == krawl::blocks::Comparison::Same)
        {
            let off = (0..places.len()).map(|p| {
                let (a, b) = (sketch(p), now(p));
                (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)
            });
            kept.push((off.sum::<f64>(), number));
        }
    }
    let with = figures.with_senses().unwrap();
    assert_eq!((with.proved as usize, with.undecided), (kept.len(), 0));
    kept.sort_by(|a, b| a.0.total_cmp(&b.0));
    let first = krawl::blocks::First::Figure {
        number: kept[0].1,
        is_nearest: true,
    };
    assert_eq!(figures.first(), first);
    // The first is the one that is drawn.
    let (points, _) = figures.figure(0);
    for (point, at) in points.iter().zip(places) {
        assert!(
            (0..2).all(|k| (point[k].mid() - at[k]).abs() < 0.5),
            "{points:?}"
        );
    }
    // Impossible lengths are said to be so.
    let mut impossible = problem.clone();
    impossible.distances[0].target = krawl::problem::Target::Length(100.into());
    let none = find(&impossible);
    assert_eq!((none.count(), none.doubt()), (Some(0), None));
    assert_eq!(none.impossible(), Some(1));
}

fn figures_of(text: &str) -> Result<krawl::blocks::Figures, String> {
    let problem = krawl::problem::Problem::parse_loosely(text, "test").unwrap();
    let options = krawl::track::Options::certified();
    krawl::blocks::Figures::find(&problem, &options, &mut krawl::track::Control::default())
}

/// r is where p-q meets the vertical line through p: anywhere on it where q is on it too, as with q = (0, 8). Whether that
/// is seen must not depend on where q was in another figure, in which its block had been solved before.
#[test]
fn a_block_is_solved_with_its_own_numbers() {
    for (x, y) in [(7.2, 6.25), (7.2, 1.75), (6.1, 0.1), (6.1, 7.9)] {
        let figures = figures_of(&format!(
            "name = \"turns\"\ndimension = 2\n[points]\np = [0, 0]\na = [{x}, 0]\nca = [3, 4]\nb = [20, {y}]\n\
             db = [23, 4]\nq = [{x}, {y}]\nr = [0, 0]\n[constraints]\nfixed = [\"p\", \"ca\", \"db\"]\n\
             y = [[\"a\", 0]]\nx = [[\"b\", 20]]\nvertical = [[\"q\", \"a\"], [\"r\", \"p\"]]\n\
             horizontal = [[\"q\", \"b\"]]\non = [[\"r\", \"p\", \"q\"]]\n\
             distances = [[\"a\", \"ca\", 5], [\"b\", \"db\", 5]]\n"
        ))
        .unwrap();
        let words = krawl::report::figures_in_words(&figures);
        assert!(figures.doubt().is_some(), "{x} {y}: {words}");
        assert!(!words.contains("no other"), "{words}");
    }
}

/// c is 5 from a and from b, so that its x is 3, and 2e-8 less than is asked for besides.
#[test]
fn what_is_missed_is_not_said_to_be_met() {
    let figures = figures_of(
        "name = \"near\"\ndimension = 2\n[points]\na = [0, 0]\nb = [6, 0]\nc = [3.00000002, 4]\n[constraints]\n\
         fixed = [\"a\", \"b\"]\nx = [[\"c\", 3.00000002]]\ndistances = [[\"a\", \"c\", 5], [\"b\", \"c\", 5]]\n",
    )
    .unwrap();
    let words = krawl::report::figures_in_words(&figures);
    assert!(!words.contains("Complete"), "{words}");
    assert!(
        figures.count() == Some(0) || words.contains("was left out and is met within 3e-8, proved"),
        "{words}"
    );
    let value = serde_json::to_value(Document::figures(&figures, Listed::Some)).unwrap();
    assert_ne!(value["status"], "complete");
}

/// With b on the left of a there are figures: what is said of none is said of those with b on the right.
#[test]
fn none_is_said_with_what_is_held() {
    let figures = figures_of(
        "name = \"right\"\ndimension = 2\n[points]\na = [0, 0]\nb = [6, 0]\nc = [-6, 3.5]\nd = [-8, 3]\n[constraints]\n\
         fixed = [\"a\", \"d\"]\nhorizontal = [[\"a\", \"b\"]]\n\
         distances = [[\"a\", \"b\", 6], [\"b\", \"c\", 3], [\"c\", \"d\", 2]]\n",
    )
    .unwrap();
    assert_eq!(figures.count(), Some(0));
    let words = krawl::report::figures_in_words(&figures);
    assert!(words.contains("in the direction that they have"), "{words}");
}

/// A line's own direction is the same line with either sign.
#[test]
fn lines_of_their_own_are_not_counted_twice() {
    let refused = figures_of(
        "name = \"free line\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 2]\nc = [1, 3]\n[lines]\n\
         l = { point = [1, 3], direction = [4, 2] }\n[constraints]\nfixed = [\"a\", \"b\", \"c\"]\n\
         on = [[\"c\", \"l\"]]\nparallel = [[\"l\", \"a\", \"b\"]]\n",
    );
    assert!(refused.unwrap_err().contains("direction"));
}

/// Twice the signed area of a triangle of a figure in JSON.
fn turn(figure: &Value, points: [&str; 3]) -> f64 {
    let at = |p: &str| [0, 1].map(|k| figure["points"][p][k][0].as_f64().unwrap());
    let [a, b, c] = points.map(at);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Of each figure it is told which senses are the sketch's: the angle of r006 with r009, and the triangle that r006 and
/// r007 make with the way from one to the other.
#[test]
fn senses_of_figures_are_told() {
    let (code, text) = krawl(
        &["solve", "problems/sketches/bracket.slvs", "--json", "-"],
        "",
    );
    assert_eq!(code, Some(0), "{text}");
    let result: Value = serde_json::from_str(&text).unwrap();
    let figures = result["figures"].as_array().unwrap();
    let angle = |figure: &Value| turn(figure, ["r006.2", "r006.1", "r009.2"]) > 0.0;
    let triangle = |figure: &Value| turn(figure, ["r006.1", "r006.2", "r007.2"]) > 0.0;
    // The first is the one that is drawn.
    let (in_sketch, mut kept) = ((angle(&figures[0]), triangle(&figures[0])), 0);
    for figure in figures {
        let others = figure["senses"]["other"].as_array().unwrap();
        let named = |what: &str| others.iter().any(|o| o.as_str().unwrap().contains(what));
        assert_eq!(named("c011"), angle(figure) != in_sketch.0, "{figure}");
        // Joined to both by a distance each.
        let has_triangle = named("r004.1, r005.2, r006.2");
        assert_eq!(has_triangle, triangle(figure) != in_sketch.1, "{figure}");
        assert_eq!(figure["senses"]["undecided"].as_array().unwrap().len(), 0);
        let all = (angle(figure), triangle(figure)) == in_sketch;
        assert_eq!(figure["senses"]["as_in_sketch"], all);
        kept += usize::from(all);
    }
    assert_eq!(kept, 1);
    assert_eq!(result["senses"]["kept"], 1);
    assert!(
        result["verdict"]
            .as_str()
            .unwrap()
            .contains("1 of them has all senses of the sketch")
    );
}

/// Tangents of a FreeCAD sketch go on at their shared end or come back: told of each figure.
#[test]
fn tangents_that_come_back_are_told() {
    let json = [&SLOT[..], &["--json", "-"]].concat();
    let (code, text) = krawl(&json, "");
    assert_eq!(code, Some(0), "{text}");
    let result: Value = serde_json::from_str(&text).unwrap();
    let goes_on = |figure: &Value| turn(figure, ["e1.end", "e1.start", "e2.center"]) > 0.0;
    let figures = result["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 4);
    let in_sketch = goes_on(&figures[0]);
    for figure in figures {
        let others = figure["senses"]["other"].as_array().unwrap();
        let mut others = others.iter().map(|o| o.as_str().unwrap());
        let comes_back = others.any(|o| o.contains("Constraint1`"));
        assert_eq!(comes_back, goes_on(figure) != in_sketch, "{figure}");
    }
    assert_eq!(result["senses"]["kept"], 1);
    let first = [&SLOT[..], &["--first"]].concat();
    let (code, text) = krawl(&first, "");
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("it is the nearest to the sketch"), "{text}");
    assert!(text.contains("\nFigure 1"), "{text}");
    assert!(!text.contains("\nFigure 2"), "{text}");
}

/// The second line is led to the other direction: no figure has the sketch's sense, and of two that do the nearer one is
/// first.
#[test]
fn the_first_figure_has_all_senses_or_there_is_none() {
    use krawl::blocks::{Comparison, First};
    let none = figures_of(
        "name = \"back\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [3, 3]\nd = [5, 3.1]\n[constraints]\n\
         fixed = [\"a\", \"b\", \"c\"]\ndx = [[\"c\", \"d\", -2]]\nparallel = [[\"a\", \"b\", \"c\", \"d\"]]\n",
    )
    .unwrap();
    assert_eq!(none.count(), Some(1));
    assert_eq!(none.compared(0), [Comparison::Other]);
    assert_eq!(none.first(), First::None { is_proved: true });
    let words = krawl::report::figures_in_words(&none);
    assert!(words.contains("It has not all senses"), "{words}");
    // d on the circle about c and on the line a-b: at (1, 0) or at (7, 0), both in its direction.
    let both = figures_of(
        "name = \"two\"\ndimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\nc = [4, 4]\nd = [6.5, 0.2]\n[constraints]\n\
         fixed = [\"a\", \"b\", \"c\"]\ndistances = [[\"c\", \"d\", 5]]\nparallel = [[\"a\", \"b\", \"a\", \"d\"]]\n",
    )
    .unwrap();
    assert_eq!(both.count(), Some(2));
    assert_eq!(both.with_senses().unwrap().proved, 2);
    let First::Figure { number, is_nearest } = both.first() else {
        panic!("{:?}", both.first())
    };
    assert!(is_nearest);
    assert!(both.figure(number).0[3][0].contains(7.0));
}

/// A page of a sketch that stops as a whole has its figures; so has that of its JSON, and a run for a certificate.
#[test]
fn pages_draw_the_figures_of_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (page, json, shown, cert) = (
        file("a.html"),
        file("a.json"),
        file("b.html"),
        file("a.krawl"),
    );
    let solve = [&SLOT[..], &["--html", &page, "--json", &json]].concat();
    let (code, text) = krawl(&solve, "");
    assert_eq!(code, Some(0), "{text}");
    let (code, text) = krawl(&["show", &json, "--html", &shown], "");
    assert_eq!(code, Some(0), "{text}");
    for page in [page, shown] {
        let html = std::fs::read_to_string(page).unwrap();
        for part in [
            "Figure 4",
            "senses as in the sketch",
            "turned the other way: `Constraint",
        ] {
            assert!(html.contains(part), "{part}");
        }
    }
    let certified = [&SLOT[..], &["--cert", &cert]].concat();
    let (code, text) = krawl(&certified, "");
    // Open: t goes on without end.
    assert_eq!(code, Some(5), "{text}");
    assert!(
        text.contains("of the figures below it says nothing"),
        "{text}"
    );
    assert!(text.contains("\nFigure 4"), "{text}");
    assert!(
        text.contains("The path of the whole, as far as it was followed:\n\nSlot: Open, proved"),
        "{text}"
    );
    let backwards = ["solve", "problems/sketches/bracket.slvs", "--reverse"];
    let (_, text) = krawl(&backwards, "");
    assert!(
        text.starts_with("Followed as a whole, as `--reverse` asks for its path"),
        "{text}"
    );
}

/// Two circles about one centre, and beside them what is given: every radius changes in proportion to t, so that the path is
/// straight, and has an end where one vanishes.
fn shrinking(more: &str, radii: &str) -> String {
    format!(
        "name = \"rings\"\ndimension = 2\n[points]\na = [0, 0]\n[circles]\nc = {{ center = \"a\", radius = 3 }}\n\
         d = {{ center = \"a\", radius = 4.3 }}\n{more}[constraints]\nfixed = [\"a\"]\n\
         radii = [[\"c\", 3.3]{radii}]\ndistances = [[\"c\", \"d\", 1]]\n"
    )
}

#[test]
fn a_straight_path_that_ends_where_a_radius_vanishes_is_answered_by_blocks() {
    // The radius of c vanishes at t = -10, and that of e at t = 5.
    let one = shrinking("", "");
    let both = shrinking("e = { center = \"a\", radius = 5 }\n", ", [\"e\", 4]");
    for text in [&one, &both] {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("rings.toml");
        fs::write(&file, text).unwrap();
        let file = file.to_str().unwrap();
        let (code, said) = krawl(&["solve", file], "");
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("goes to zero"), "{said}");
        assert!(
            said.contains("Complete, proved: 1 figure meets all constraints"),
            "{said}"
        );
        assert!(said.contains("\n  d: radius 4.3"), "{said}");
        // What the path is remains there for programs, and for who asks for a proof of it.
        let (code, line) = krawl(&["solve", file, "--json", "-"], "");
        assert_eq!(code, Some(0));
        let value: Value = serde_json::from_str(&line).unwrap();
        assert_eq!(value["status"], "open");
        assert_eq!(value["ends"][0]["kind"], "undefined");
        assert_eq!(value["solutions"].as_array().unwrap().len(), 1);
        assert_eq!(value["by_blocks"]["status"], "complete");
        assert_eq!(value["by_blocks"]["count"], 1);
        let cert = folder.path().join("rings.krawl");
        let (code, said) = krawl(&["solve", file, "--cert", cert.to_str().unwrap()], "");
        assert_eq!(code, Some(5), "{said}");
        // Who asks for what only a path has is told of the path; floats see nothing else.
        for option in ["--reverse", "--mode=float"] {
            let (code, said) = krawl(&["solve", file, option], "");
            assert_eq!(code, Some(5), "{said}");
            assert!(said.contains(": Open, "), "{said}");
        }
    }
}

/// An open belt about two pulleys: each line touches at the points where it ends, which are on the circles.
#[test]
fn lines_touch_circles_at_the_points_that_are_on_them() {
    let text = "name = \"belt\"\ndimension = 2\n[points]\nP = [0, 0]\nQ = [100, 0]\nu1 = [3, 30]\nu2 = [102, 20]\nv1 = [3, -30]\n\
                v2 = [102, -20]\n[circles]\nbig = { center = \"P\", radius = 30 }\nsmall = { center = \"Q\", radius = 20 }\n[lines]\n\
                up = [\"u1\", \"u2\"]\nlo = [\"v1\", \"v2\"]\n[constraints]\nfixed = [\"P\"]\nhorizontal = [[\"P\", \"Q\"]]\n\
                distances = [[\"P\", \"Q\", 100]]\nradii = [[\"big\", 30], [\"small\", 20]]\n\
                on = [[\"u1\", \"big\"], [\"u2\", \"small\"], [\"v1\", \"big\"], [\"v2\", \"small\"]]\n\
                tangent = [[\"big\", \"up\"], [\"small\", \"up\"], [\"big\", \"lo\"], [\"small\", \"lo\"]]\n";
    let problem = krawl::problem::Problem::parse(text, "test").unwrap();
    let mut session = krawl::edit::Session::open(&problem).unwrap();
    let points = session.figure();
    // The radii are parallel, with cosine (30 − 20) / 100 to the line of centres.
    for (point, centre, radius, side) in [
        (2, 0.0, 30.0, 1.0),
        (3, 100.0, 20.0, 1.0),
        (4, 0.0, 30.0, -1.0),
        (5, 100.0, 20.0, -1.0),
    ] {
        let (x, y) = (centre + 0.1 * radius, side * radius * 0.99f64.sqrt());
        assert!(
            (points[point][0] - x).hypot(points[point][1] - y) < 1e-12,
            "{points:?}"
        );
    }
    let setting = krawl::edit::Setting::parse(&problem, "radii:big=35").unwrap();
    assert_eq!(
        session.edit(&[setting]).ending,
        krawl::edit::Ending::Reached
    );
}
