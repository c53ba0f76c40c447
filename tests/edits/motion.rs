//! How linkages move: against what geometry says of them, and against themselves.

use crate::common::random::Dice;
use crate::common::third;
use krawl::motion::{Bounds, Motion};
use krawl::problem::Problem;
use krawl::track::{Control, Options};

fn motion(text: &str, free: &[&str], asked: &[&str]) -> Result<Motion, String> {
    let problem = Problem::parse_loosely(text, "motion.toml").map_err(|e| e.to_string())?;
    let owned = |texts: &[&str]| texts.iter().map(|&t| t.to_owned()).collect::<Vec<_>>();
    Motion::of(
        &problem,
        &owned(free),
        &owned(asked),
        &Options::certified(),
        &mut Control::default(),
    )
}

/// A four-bar linkage as it is drawn with its crank at an angle, C on the left of the line from B to D or on its right.
fn four_bar([crank, coupler, rocker, ground]: [f64; 4], angle: f64, left: bool) -> Option<String> {
    let b = [crank * angle.cos(), crank * angle.sin()];
    let to = [ground - b[0], -b[1]];
    let d = (to[0] * to[0] + to[1] * to[1]).sqrt();
    let along = (coupler * coupler - rocker * rocker + d * d) / (2.0 * d);
    let height = (coupler * coupler - along * along).max(-1.0);
    if height < 1e-3 {
        return None;
    }
    let height = height.sqrt() * if left { 1.0 } else { -1.0 };
    let c = [0, 1].map(|k| {
        let across = [-to[1], to[0]][k];
        b[k] + (to[k] * along + across * height) / d
    });
    Some(format!(
        "name = \"four-bar\"\ndimension = 2\n[points]\nA = [0, 0]\nD = [{ground}, 0]\nB = [{}, {}]\nC = [{}, {}]\n\
         [constraints]\ndistances = [[\"A\", \"D\", {ground}], [\"A\", \"B\", {crank}], [\"B\", \"C\", {coupler}], [\"C\", \"D\", {rocker}]]\n",
        b[0], b[1], c[0], c[1]
    ))
}

fn ends(bounds: &Bounds) -> [krawl::interval::Interval; 2] {
    match bounds {
        Bounds::Between { least, most } => [least.value, most.value],
        other => panic!("{other:?}"),
    }
}

fn close(found: krawl::interval::Interval, exact: f64) -> bool {
    // Bounds of geometry's number, computed in floats.
    let slack = 1e-9 * exact.abs().max(1.0);
    found.inf() <= exact + slack && found.sup() >= exact - slack && found.wid() < 1e-4
}

#[test]
fn four_bars_move_as_geometry_says() {
    let mut random = Dice(7);
    let (mut turning, mut rocking) = (0, 0);
    while turning < 20 || rocking < 20 {
        let sides: [f64; 4] =
            std::array::from_fn(|_| (100.0 * (1.0 + 3.0 * random.uniform())).round() / 100.0);
        let [crank, coupler, rocker, ground] = sides;
        let sum: f64 = sides.iter().sum();
        let (least, most) = sides
            .iter()
            .fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
        // At Grashof's equality two loops meet, and a side as long as the others leaves nothing to move.
        let spare = 0.5 * sum - (least + most);
        if spare.abs() < 0.1 || most > sum - most - 0.1 {
            continue;
        }
        let is_crank = spare > 0.0 && crank == least;
        let is_double_crank = spare > 0.0 && ground == least;
        let Some(text) = four_bar(sides, 6.3 * random.uniform(), random.uniform() < 0.5) else {
            continue;
        };
        let found = motion(&text, &[], &["B-D", "A-C", "turn D A B", "area A B C D"]).unwrap();
        assert!(found.is_loop(), "{text}");
        // A diagonal is a side of two triangles.
        for (k, [p, q], [r, s]) in [
            (0, [crank, ground], [coupler, rocker]),
            (1, [crank, coupler], [ground, rocker]),
        ] {
            let [low, high] = ends(&found.measured[k].bounds);
            let exact = [(p - q).abs().max((r - s).abs()), (p + q).min(r + s)];
            // Of a linkage that comes in two loops one may have less of a diagonal than there is: never more.
            assert!(low.sup() >= exact[0] - 1e-9 && high.inf() <= exact[1] + 1e-9);
            if spare < 0.0 || is_crank {
                assert!(
                    close(low, exact[0]) && close(high, exact[1]),
                    "{text}: {low:?} {high:?} {exact:?}"
                );
            }
        }
        let turn = &found.measured[2].bounds;
        if is_crank || is_double_crank {
            turning += 1;
            assert!(matches!(turn, Bounds::AllTheWay(1)), "{text}: {turn:?}");
        } else {
            rocking += 1;
            assert!(matches!(turn, Bounds::Between { .. }), "{text}: {turn:?}");
        }
        // Every frame keeps its bounds, and meets its dimensions.
        let area = ends(&found.measured[3].bounds);
        for frame in &found.frames {
            let at = |p: usize| [frame.points[p][0].mid(), frame.points[p][1].mid()];
            let length = |p: usize, q: usize| {
                let (p, q) = (at(p), at(q));
                ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt()
            };
            // A, D, B, C
            for (got, want) in [
                (length(0, 2), crank),
                (length(2, 3), coupler),
                (length(3, 1), rocker),
                (length(0, 1), ground),
            ] {
                assert!((got - want).abs() < 1e-6, "{text}");
            }
            let [a, d, b, c] = [at(0), at(1), at(2), at(3)];
            let outline = [a, b, c, d];
            let twice: f64 = (0..4)
                .map(|k| {
                    let (p, q) = (outline[k], outline[(k + 1) % 4]);
                    p[0] * q[1] - p[1] * q[0]
                })
                .sum();
            let size = 0.5 * twice.abs();
            assert!(
                size > area[0].inf() - 1e-6 && size < area[1].sup() + 1e-6,
                "{text}"
            );
        }
    }
}

#[test]
fn bounds_do_not_depend_on_where_a_loop_is_drawn() {
    let sides = [1.0, 3.5, 3.0, 4.0];
    let asked = ["A-C", "angle A D C", "turn A D C", "x C", "area B C D"];
    let ranges = |text: &str| -> Vec<[f64; 2]> {
        let found = motion(text, &[], &asked).unwrap();
        assert!(found.is_loop());
        found
            .measured
            .iter()
            .map(|m| ends(&m.bounds).map(|x| x.mid()))
            .collect()
    };
    let first = ranges(&four_bar(sides, 0.3, true).unwrap());
    for angle in [1.9, 3.1, 5.0] {
        let other = ranges(&four_bar(sides, angle, true).unwrap());
        for (a, b) in first.iter().flatten().zip(other.iter().flatten()) {
            assert!((a - b).abs() < 1e-5, "{first:?} {other:?}");
        }
    }
    // The other loop is its mirror image.
    let mirrored = ranges(&four_bar(sides, 0.3, false).unwrap());
    assert!(
        (first[2][0] + mirrored[2][1]).abs() < 1e-5 && (first[0][0] - mirrored[0][0]).abs() < 1e-5
    );
}

#[test]
fn a_slider_has_its_dead_centres() {
    let text = r#"
        name = "slider-crank"
        dimension = 2
        [points]
        O = [0, 0]
        P = [1, 0]
        B = [0.6, 0.8]
        S = [3.5, 0]
        [objects]
        [constraints]
        fixed = ["O", "P"]
        y = [["S", 0]]
        distances = [["O", "B", 1], ["B", "S", 3]]
    "#;
    let found = motion(
        &text.replace("        [objects]\n", ""),
        &[],
        &["O-S", "x S", "turn P O B"],
    )
    .unwrap();
    assert!(found.is_loop());
    for k in [0, 1] {
        let [low, high] = ends(&found.measured[k].bounds);
        assert!(close(low, 2.0) && close(high, 4.0), "{low:?} {high:?}");
    }
    assert!(matches!(found.measured[2].bounds, Bounds::AllTheWay(_)));
}

/// All seven diagonals of the ring are alike, and so are the ranges that its pseudorotation gives them.
#[test]
fn cycloheptane_goes_round() {
    let mut text = "name = \"cycloheptane\"\ndimension = 3\n[points]\n".to_owned();
    for (k, z) in [
        -0.36564, 0.34743, 0.26377, -0.24493, -0.00456, -0.05051, 0.15159,
    ]
    .iter()
    .enumerate()
    {
        let angle = std::f64::consts::TAU * k as f64 / 7.0;
        text += &format!(
            "C{k} = [{}, {}, {z}]\n",
            1.763 * angle.cos(),
            1.763 * angle.sin()
        );
    }
    text += "[constraints]\nsquared_distances = [\n";
    for k in 0..7 {
        text += &format!(
            "[\"C{k}\", \"C{}\", 2.3409],\n[\"C{k}\", \"C{}\", 6.660414],\n",
            (k + 1) % 7,
            (k + 2) % 7
        );
    }
    text += "]\n";
    let found = motion(&text, &[], &[]).unwrap();
    assert!(found.is_loop());
    assert_eq!(found.measured.len(), 7);
    let first = ends(&found.measured[0].bounds);
    for measured in &found.measured {
        for (a, b) in ends(&measured.bounds).iter().zip(first) {
            assert!((a.mid() - b.mid()).abs() < 1e-5, "{measured:?}");
        }
    }
}

const BRICARD: &str = r#"
name = "bricard"
dimension = 3
[points]
a = [1, 0.2, 0.3]
aa = [-1, -0.2, 0.3]
b = [0.3, 1.1, -0.4]
bb = [-0.3, -1.1, -0.4]
c = [0.6, -0.7, 0.8]
cc = [-0.6, 0.7, 0.8]
[constraints]
squared_distances = [["a","b",1.79],["b","aa",3.87],["aa","bb",1.79],["bb","a",3.87],
["a","c",1.22],["c","aa",3.06],["aa","cc",1.22],["cc","a",3.06],
["b","c",4.77],["c","bb",2.41],["bb","cc",4.77],["cc","b",2.41]]
"#;

#[test]
fn what_was_left_out_of_a_flexible_octahedron_is_met_all_the_way() {
    let found = motion(BRICARD, &[], &[]).unwrap();
    assert_eq!(found.account.left_out.len(), 1);
    let words = found.account.left_out_in_words();
    assert!(words.contains("left out and is met within"), "{words}");
    assert!(
        found.measured.iter().all(|m| m.changes()),
        "{:?}",
        found.measured
    );
}

#[test]
fn what_does_not_move_is_said() {
    for (text, free, why) in [
        // Moved apart it is as rigid as any other octahedron.
        (
            BRICARD.replace("1.79],[\"b\"", "1.80],[\"b\""),
            &[][..],
            "cannot move",
        ),
        (
            std::fs::read_to_string("problems/k33.toml").unwrap(),
            &[],
            "cannot move",
        ),
        (
            std::fs::read_to_string("problems/k33.toml").unwrap(),
            &["p1-p4", "p2-p5"],
            "can begin to move in 2 ways",
        ),
        (
            std::fs::read_to_string("problems/mechanisms/crank.toml").unwrap(),
            &["turns:D-A-C"],
            "there is no dimension",
        ),
    ] {
        let error = motion(&text, free, &[]).unwrap_err();
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn a_parallelogram_moves_between_the_places_where_it_is_folded_flat() {
    // At both it could go on as a parallelogram, or crossed.
    let found = motion(
        &four_bar([1.5, 2.5, 1.5, 2.5], 1.0, true).unwrap(),
        &[],
        &["turn D A B", "A-C", "B-D"],
    );
    let found = found.unwrap();
    assert!(!found.is_loop() && found.is_told(), "{:?}", found.ends);
    let [low, high] = ends(&found.measured[0].bounds);
    assert!(low.inf() > 0.0 && low.sup() < 0.5 && high.sup() < 180.0 && high.inf() > 179.5);
    // Parallelogram law: the squares of the diagonals are those of the four sides.
    for frame in &found.frames {
        let square = |p: usize, q: usize| {
            let d = [0, 1].map(|k| frame.points[p][k].mid() - frame.points[q][k].mid());
            d[0] * d[0] + d[1] * d[1]
        };
        assert!((square(0, 3) + square(1, 2) - 17.0).abs() < 1e-5);
    }
}

/// The fixed pivot of a linkage with a body has one place only, the coupler's point those of the closed form.
#[test]
fn coordinates_are_those_in_which_the_reference_stands() {
    let text = r#"
        name = "body"
        dimension = 2
        [points]
        A = [0, 0]
        D = [4, 0]
        B = [0.5, 0.86]
        C = [3.34, 2.92]
        P = [1.16, 3.28]
        [constraints]
        fixed = ["A", "D"]
        distances = [["A", "B", 1.0], ["C", "D", 3.0], ["B", "C", 3.5], ["B", "P", 2.5], ["C", "P", 2.2]]
    "#;
    let found = motion(text, &[], &["x P", "x D", "y P"]).unwrap();
    assert!(found.is_loop() && found.standing.is_empty());
    let [low, high] = ends(&found.measured[1].bounds);
    assert!(close(low, 4.0) && close(high, 4.0));
    let (mut x, mut y) = ([f64::MAX, f64::MIN], [f64::MAX, f64::MIN]);
    for k in 0..200_000 {
        let angle = std::f64::consts::TAU * f64::from(k) / 200_000.0;
        let b = [angle.cos(), angle.sin()];
        let c = third(b, [4.0, 0.0], 3.5, 3.0);
        let p = third(b, c, 2.5, 2.2);
        (x, y) = (
            [x[0].min(p[0]), x[1].max(p[0])],
            [y[0].min(p[1]), y[1].max(p[1])],
        );
    }
    for (measured, sampled) in [(0, x), (2, y)] {
        let [low, high] = ends(&found.measured[measured].bounds);
        assert!(
            low.inf() <= sampled[0] && high.sup() >= sampled[1],
            "{low:?} {high:?} {sampled:?}"
        );
        assert!((low.mid() - sampled[0]).abs() < 1e-6 && (high.mid() - sampled[1]).abs() < 1e-6);
    }
}

/// A point that passes another one very near: on which side decides whether its direction turns.
#[test]
fn a_direction_that_nearly_vanishes_is_not_said_to_turn() {
    for (far, g, ag, gf, p) in [
        (
            "1.000039585",
            "0.168,-0.007",
            "0.1681457700925004",
            "0.8320690301933921",
            "-0.15148887232107158,-0.98845896301409",
        ),
        (
            "1.000011517",
            "0.435,-0.138",
            "0.45636498551050125",
            "0.5816201632875542",
            "0.7861199700336632,0.6180739379024749",
        ),
    ] {
        let text = format!(
            "name=\"t\"\ndimension=2\n[points]\nA=[0,0]\nF=[{far},0]\nG=[{g}]\nP=[{p}]\n[constraints]\n\
             distances=[[\"A\",\"F\",{far}],[\"A\",\"P\",1],[\"A\",\"G\",{ag}],[\"G\",\"F\",{gf}]]\n"
        );
        let farthest = (1.0 / far.parse::<f64>().unwrap()).asin().to_degrees();
        for asked in [["G-P", "turn A F P"], ["F-P", "turn A F P"]] {
            let found = motion(&text, &[], &asked).unwrap();
            match &found.measured[1].bounds {
                Bounds::Between { least, most } => {
                    assert!(
                        least.value.inf() <= -farthest + 1e-9
                            && most.value.sup() >= farthest - 1e-9,
                        "{least:?} {most:?}"
                    );
                    assert!(least.value.sup() < -89.0 && most.value.inf() > 89.0);
                }
                Bounds::AllTheWay(_) => panic!("it does not turn"),
                Bounds::Untold => {}
            }
        }
    }
}

#[test]
fn an_angle_that_straightens_is_180_degrees() {
    let found = motion(
        &four_bar([1.0, 3.5, 3.0, 4.0], 1.0, true).unwrap(),
        &[],
        &["angle A B C"],
    )
    .unwrap();
    let [low, high] = ends(&found.measured[0].bounds);
    assert!(low.contains(0.0) || low.inf() < 1e-2, "{low:?}");
    assert!(
        high.contains(180.0) && high.sup() < 180.0 + 1e-6 && high.wid() < 0.1,
        "{high:?}"
    );
}

#[test]
fn what_is_drawn_at_a_dead_centre_is_told_so() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [1, 0]\nC = [2, 0]\n[constraints]\ndistances = [[\"A\", \"B\", 1], [\"B\", \"C\", 1]]\n";
    let error = motion(text, &[], &[]).unwrap_err();
    assert!(error.contains("draw it a little bent"), "{error}");
}
