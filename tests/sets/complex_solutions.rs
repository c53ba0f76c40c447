//! All complex solutions: known counts, agreement with complete real sets, loops, files, sabotage.

use krawl::complete::{self, all};
use krawl::complex::monodromy::bow;
use krawl::complex::system::segment;
use krawl::complex::{
    Effort, Export, Filling, Follower, Found, Lowered, Nature, PathEnd, Random, SolutionBox,
    SolutionSet, Solutions, Status, Template, Ways, draw, export, fill, lower, lower_for, solve,
};
use krawl::interval::{Interval, point};
use krawl::problem::Problem;
use krawl::system::Located;

fn shipped(name: &str) -> (Problem, Lowered) {
    let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
    let lowered = lower(&problem).unwrap();
    (problem, lowered)
}

/// The shipped template of a problem, proved again.
fn template(name: &str, lowered: &Lowered) -> Template {
    let text = std::fs::read_to_string(format!("problems/{name}.krawl-template")).unwrap();
    Template::read(&text, &lowered.system).unwrap()
}

fn solved(name: &str) -> (Problem, Lowered, Solutions) {
    let (problem, lowered) = shipped(name);
    let template = template(name, &lowered);
    let solutions = solve(&lowered, &template, &Ways::default());
    (problem, lowered, solutions)
}

/// Gauge, rotation, isometry, real ones.
fn counts(solutions: &Solutions) -> [usize; 4] {
    let counts = solutions.counts;
    assert!(counts.certain);
    [
        counts.gauge,
        counts.rotation,
        counts.isometry,
        solutions.real().count(),
    ]
}

#[test]
fn known_counts_and_what_is_proved_of_them() {
    for (name, expected, status) in [
        ("octahedron", [64, 16, 8, 4], Status::Complete),
        ("k33", [32, 16, 8, 8], Status::Complete),
        ("prism", [48, 24, 12, 12], Status::Complete),
        // The bound of the graph is 128.
        ("disulfide", [256, 64, 32, 18], Status::Found),
        (
            "constraints/3p3l-orthogonal",
            [960, 240, 120, 4],
            Status::Found,
        ),
    ] {
        let (_, lowered, solutions) = solved(name);
        assert_eq!(counts(&solutions), expected, "{name}");
        assert_eq!(solutions.status, status, "{name}: {:?}", lowered.bound);
        assert!(solutions.stopped.is_empty() && solutions.infinite.is_empty());
        // Conjugates come in pairs, each naming the other.
        for (k, nature) in solutions.natures.iter().enumerate() {
            match nature {
                Nature::Pair(other) => assert_eq!(solutions.natures[*other], Nature::Pair(k)),
                Nature::Real | Nature::SelfConjugate => {}
                _ => panic!("{name}: {nature:?}"),
            }
        }
    }
}

/// Paths in floats come to the same sets, each solution proved: from a template of their own and from the shipped one.
#[test]
fn paths_in_floats_come_to_the_same_solutions() {
    let floats = Ways {
        proved: false,
        ..Ways::default()
    };
    for name in ["octahedron", "k33", "prism", "disulfide"] {
        let (problem, lowered, proved) = solved(name);
        let filling = Filling {
            enough: Some(proved.boxes.len()),
            patience: 30,
            ways: floats,
            ..Filling::default()
        };
        let fibre = fill(&lowered.system, &filling).unwrap();
        assert_eq!(fibre.solutions.len(), proved.boxes.len(), "{name}");
        assert_eq!((fibre.effort.tubes, fibre.effort.steps > 0), (0, true));
        for template in [
            Template::new(&problem.name, fibre),
            template(name, &lowered),
        ] {
            let solutions = solve(&lowered, &template, &floats);
            assert_eq!(counts(&solutions), counts(&proved), "{name}");
            assert_eq!(solutions.status, proved.status, "{name}");
            assert!(!solutions.paths_proved && proved.paths_proved);
            let group = &lowered.system.group_of_instance;
            for one in solutions.boxes.boxes() {
                let known = proved.boxes.find(one, group, false);
                assert!(matches!(known, Found::Old(_)), "{name}: {known:?}");
            }
        }
    }
}

/// Three lines in general directions, two of them 8° apart, with every path proved or in floats: all ways find the same. 960 solutions up to turns and 480
/// up to point inversion are what nine coordinates of points, the height of one line and two coordinates of another have.
fn three_lines_in_general_directions(ways: &[bool]) {
    let (_, lowered) = shipped("constraints/3p3l");
    let template = template("constraints/3p3l", &lowered);
    let mut sets = Vec::new();
    for &proved in ways {
        let ways = Ways {
            proved,
            ..Ways::default()
        };
        let solutions = solve(&lowered, &template, &ways);
        assert_eq!(counts(&solutions), [3840, 960, 480, 16]);
        assert_eq!(solutions.status, Status::Found);
        assert!(solutions.stopped.is_empty() && solutions.infinite.is_empty());
        assert_eq!(solutions.paths_proved, proved);
        sets.push(solutions);
    }
    let group = &lowered.system.group_of_instance;
    for pair in sets.windows(2) {
        for one in pair[1].boxes.boxes() {
            let known = pair[0].boxes.find(one, group, false);
            assert!(matches!(known, Found::Old(_)));
        }
    }
}

#[test]
fn three_points_and_three_lines_in_general_directions() {
    three_lines_in_general_directions(&[false]);
}

#[test]
#[ignore = "a quarter of a minute"]
fn every_path_of_three_lines_in_general_directions_is_proved() {
    three_lines_in_general_directions(&[true, false]);
}

/// A template serves another figure of the same kind in the frame in which it was made, and only there: which two of the three lines come first
/// depends on the angles.
#[test]
fn a_template_of_three_lines_serves_other_angles() {
    let path = "problems/constraints/3p3l";
    let text = std::fs::read_to_string(format!("{path}.krawl-template")).unwrap();
    let other = std::fs::read_to_string(format!("{path}.toml")).unwrap();
    let angles = r#"[["l1", "l2", 8], ["l1", "l3", 88], ["l2", "l3", 86]]"#;
    assert!(other.contains(angles));
    let other = other.replace(
        angles,
        r#"[["l1", "l2", 75], ["l1", "l3", 60], ["l2", "l3", 80]]"#,
    );
    let problem = Problem::parse(&other, "other.toml").unwrap();
    let plain = lower(&problem).unwrap();
    assert!(Template::read(&text, &plain.system).is_err());
    let fitting = lower_for(&problem, &text).unwrap();
    let template = Template::read(&text, &fitting.system).unwrap();
    assert_eq!(template.solutions.len(), 480);
    // What is no template leaves the best frame.
    let none = lower_for(&problem, "{}").unwrap();
    assert_eq!(none.system.structure(), plain.system.structure());
}

/// How many real ones among complex solutions have the squared distances of all pairs of points that each figure of the
/// complete real set has. Every real one has those of one figure.
fn met(problem: &Problem, lowered: &Lowered, solutions: &Solutions) -> Vec<usize> {
    let set = all(problem, &complete::Options::default()).unwrap();
    assert_eq!(set.status, complete::Status::Complete);
    // Enclosures: they meet for congruent figures.
    let pairs = |points: &[[Interval; 3]]| {
        let mut out = Vec::new();
        for a in 0..points.len() {
            for b in 0..a {
                let terms = (0..problem.dimension).map(|k| (points[a][k] - points[b][k]).sqr());
                out.push(terms.fold(point(0.0), |sum, x| sum + x));
            }
        }
        out
    };
    let theirs: Vec<Vec<Interval>> = set.solutions.iter().map(|s| pairs(&s.points)).collect();
    let unit = point(lowered.system.unit);
    let mut met = vec![0; theirs.len()];
    for k in solutions.real() {
        let one = &solutions.boxes.boxes()[k];
        let place = |u: Option<usize>| u.map_or(point(0.0), |u| one.parts[2 * u] * unit);
        let points = lowered.system.points.iter();
        let mine = pairs(&points.map(|p| p.map(place)).collect::<Vec<_>>());
        let same = |theirs: &Vec<Interval>| mine.iter().zip(theirs).all(|(a, b)| !a.disjoint(*b));
        let figures: Vec<usize> = (0..theirs.len()).filter(|&f| same(&theirs[f])).collect();
        assert_eq!(figures.len(), 1, "real solution {k}");
        met[figures[0]] += 1;
    }
    met
}

#[test]
fn the_real_ones_are_the_complete_real_set() {
    for name in ["octahedron", "k33", "prism", "disulfide"] {
        let (problem, lowered, solutions) = solved(name);
        let met = met(&problem, &lowered, &solutions);
        assert!(met.iter().all(|&n| n == 1), "{name}: {met:?}");
    }
}

/// Three points and three lines: the complete real set is searched over all coordinates. Compared are the squares of how far the points are
/// apart along each line.
fn real_ones_of_three_lines(name: &str, ways: &Ways, axes: [usize; 3]) -> usize {
    let (problem, lowered) = shipped(name);
    let solutions = solve(&lowered, &template(name, &lowered), ways);
    let set = all(&problem, &complete::Options::default()).unwrap();
    assert_eq!(set.status, complete::Status::Complete, "{name}");
    let pairs = [[0, 1], [0, 2], [1, 2]];
    let theirs = set.solutions.iter().map(|figure| {
        let along = |line: &Located| match *line {
            Located::Line { direction, .. } => pairs.map(|[a, b]| {
                let (p, q) = (figure.points[a], figure.points[b]);
                let terms = (0..3).map(|k| (p[k] - q[k]) * direction[k]);
                terms.fold(point(0.0), |sum, x| sum + x).sqr()
            }),
            _ => panic!("three lines"),
        };
        figure.objects.iter().flat_map(along).collect::<Vec<_>>()
    });
    let theirs: Vec<Vec<Interval>> = theirs.collect();
    let unit = point(lowered.system.unit);
    let mut met = vec![0; theirs.len()];
    for k in solutions.real() {
        let one = &solutions.boxes.boxes()[k];
        let along = |axis: usize| {
            pairs.map(|pair| {
                let [p, q] = pair.map(|p| lowered.system.points[p][axis].unwrap());
                ((one.parts[2 * p] - one.parts[2 * q]) * unit).sqr()
            })
        };
        // Lines that are no axes in the complex solutions' frame are left out.
        let mine = axes.into_iter().enumerate().filter(|(_, axis)| *axis < 3);
        let mine: Vec<(usize, [Interval; 3])> =
            mine.map(|(line, axis)| (line, along(axis))).collect();
        let same = |theirs: &Vec<Interval>| {
            let all = mine
                .iter()
                .flat_map(|(line, x)| (0..3).map(move |k| (3 * line + k, x[k])));
            all.into_iter().all(|(k, x)| !x.disjoint(theirs[k]))
        };
        let figures: Vec<usize> = (0..theirs.len()).filter(|&f| same(&theirs[f])).collect();
        assert_eq!(figures.len(), 1, "{name}: real solution {k}");
        met[figures[0]] += 1;
    }
    assert!(met.iter().all(|&n| n == 1), "{name}: {met:?}");
    met.len()
}

#[test]
fn the_real_ones_of_orthogonal_lines_are_the_complete_real_set() {
    // The lines are the axes, in order.
    let name = "constraints/3p3l-orthogonal";
    assert_eq!(
        real_ones_of_three_lines(name, &Ways::default(), [0, 1, 2]),
        4
    );
}

#[test]
#[ignore = "half a minute"]
fn the_real_ones_of_lines_in_general_directions_are_the_complete_real_set() {
    let floats = Ways {
        proved: false,
        ..Ways::default()
    };
    // The first line is the x axis.
    let axes = [0, 3, 3];
    assert_eq!(
        real_ones_of_three_lines("constraints/3p3l", &floats, axes),
        16
    );
}

/// In floats, from the shipped templates.
#[test]
fn the_dodecagon_and_the_pentahedron() {
    let floats = Ways {
        proved: false,
        ..Ways::default()
    };
    let (problem, lowered) = shipped("dodecagon");
    let solutions = solve(&lowered, &template("dodecagon", &lowered), &floats);
    assert_eq!(counts(&solutions), [12_360, 6180, 3090, 2]);
    assert_eq!(solutions.status, Status::Complete);
    assert_eq!(met(&problem, &lowered, &solutions), [1, 1]);

    let (problem, lowered) = shipped("constraints/pentahedron");
    let solutions = solve(
        &lowered,
        &template("constraints/pentahedron", &lowered),
        &floats,
    );
    assert_eq!(counts(&solutions), [224, 56, 34, 9]);
    assert_eq!(solutions.status, Status::Found);
    assert_eq!(met(&problem, &lowered, &solutions), [1; 9]);
}

#[test]
fn a_template_is_filled_from_one_random_figure() {
    for (name, count) in [("octahedron", 8), ("k33", 8), ("prism", 12)] {
        let (_, lowered) = shipped(name);
        assert_eq!(lowered.enough(), Some(count));
        for seed in [5, 6] {
            let filling = Filling {
                seed,
                enough: lowered.enough(),
                patience: 20,
                ..Filling::default()
            };
            let fibre = fill(&lowered.system, &filling).unwrap();
            assert_eq!(
                fibre.solutions.len(),
                count,
                "{name} {seed}: {:?}",
                fibre.failed
            );
        }
    }
}

/// Where each solution of a template goes along a bow from its parameters to those of another random figure, and the
/// boxes there.
fn along(
    lowered: &Lowered,
    template: &Template,
    other: &[krawl::complex::Parameter],
    random: &mut Random,
) -> Vec<(SolutionBox, SolutionBox)> {
    let system = &lowered.system;
    let bow = bow(system, random);
    let there = segment(&template.parameters, other, Some(&bow));
    let back = segment(other, &template.parameters, Some(&bow));
    let ways = Ways::default();
    let mut effort = Effort::default();
    let mut out = Follower::new(system, system.homotopy(), &there, &ways);
    let mut home = Follower::new(system, system.homotopy(), &back, &ways);
    let mut pairs = Vec::new();
    for one in template.solutions.boxes() {
        let PathEnd::Reached(far) = out.follow(one, &ways, &mut effort) else {
            continue;
        };
        if let PathEnd::Reached(again) = home.follow(&far, &ways, &mut effort) {
            pairs.push((far, again));
        }
    }
    pairs
}

#[test]
fn there_and_back_is_the_identity_and_loops_are_permutations() {
    for (name, count) in [("octahedron", 8), ("prism", 12)] {
        let (_, lowered) = shipped(name);
        let template = template(name, &lowered);
        let system = &lowered.system;
        let mut random = Random::new(11);
        let other = draw(system, &mut random).unwrap();
        let pairs = along(&lowered, &template, &other.parameters, &mut random);
        assert_eq!(pairs.len(), count, "{name}");
        let mut far = SolutionSet::default();
        for (k, (there, again)) in pairs.iter().enumerate() {
            // Home again, in the same box.
            let only_itself = &system.group[..1];
            assert_eq!(
                template.solutions.find(again, only_itself, false),
                Found::Old(k)
            );
            // No two came to the same place.
            assert_eq!(
                far.find(there, &system.group, false),
                Found::New,
                "{name} {k}"
            );
            far.push(there.clone());
        }
        // Another way back makes a permutation.
        let bow = bow(system, &mut random);
        let rights = segment(&other.parameters, &template.parameters, Some(&bow));
        let mut home = Follower::new(system, system.homotopy(), &rights, &Ways::default());
        let mut hit = vec![false; count];
        for (there, _) in &pairs {
            let mut effort = Effort::default();
            let PathEnd::Reached(end) = home.follow(there, &Ways::default(), &mut effort) else {
                panic!("{name}: a path stopped");
            };
            let Found::Old(k) = template.solutions.find(&end, &system.group, false) else {
                panic!("{name}: a full fibre has no other solution");
            };
            assert!(
                !std::mem::replace(&mut hit[k], true),
                "{name}: two came to {k}"
            );
        }
    }
}

#[test]
fn damaged_templates_are_refused() {
    let (_, lowered) = shipped("octahedron");
    let text = std::fs::read_to_string("problems/octahedron.krawl-template").unwrap();
    let whole: serde_json::Value = serde_json::from_str(&text).unwrap();
    let read = |value: &serde_json::Value| Template::read(&value.to_string(), &lowered.system);
    assert_eq!(read(&whole).unwrap().solutions.len(), 8);

    let mut twice = whole.clone();
    twice["solutions"][3] = whole["solutions"][5].clone();
    let error = read(&twice).unwrap_err().to_string();
    assert!(
        error.contains("solution 6") && error.contains("again"),
        "{error}"
    );

    let mut moved = whole.clone();
    for part in moved["solutions"][2].as_array_mut().unwrap() {
        *part = serde_json::json!(part.as_f64().unwrap() + 50.0);
    }
    assert!(read(&moved).is_err());

    let mut short = whole.clone();
    short["solutions"][0].as_array_mut().unwrap().pop();
    assert!(read(&short).is_err());
    let mut bad = whole.clone();
    bad["parameters"][0][0] = serde_json::json!("1/0");
    assert!(read(&bad).unwrap_err().to_string().contains("1/0"));

    bad["parameters"][0][0] = serde_json::json!(format!("1{}", "0".repeat(600)));
    assert!(read(&bad).is_err());
    let mut huge = whole.clone();
    huge["solutions"][0][0] = serde_json::json!(1e300);
    assert!(read(&huge).is_err());

    // Of another graph.
    let (_, other) = shipped("prism");
    let error = Template::read(&text, &other.system)
        .unwrap_err()
        .to_string();
    assert!(error.contains("octahedron"), "{error}");

    // A path that is dropped is missed: nothing is called complete.
    let mut dropped = whole.clone();
    dropped["solutions"].as_array_mut().unwrap().pop();
    let template = read(&dropped).unwrap();
    let solutions = solve(&lowered, &template, &Ways::default());
    assert_eq!(
        (solutions.boxes.len(), solutions.status),
        (7, Status::Found)
    );
}

#[test]
fn exported_systems_are_what_other_programs_read() {
    let (problem, _) = shipped("octahedron");
    let system = krawl::complex::lower_in_squares(&problem).unwrap().system;
    let phc = export(&system, Export::PhcPack, 1.0).unwrap();
    let mut lines = phc.lines();
    assert_eq!(lines.next(), Some("12"));
    assert_eq!(lines.filter(|line| line.ends_with(';')).count(), 12);
    let msolve = export(&system, Export::Msolve, 1.0).unwrap();
    let first = "x2, x3, y3, x4, y4, z4, x5, y5, z5, x6, y6, z6";
    assert!(msolve.starts_with(&format!("{first}\n0\n")), "{msolve}");
    // The first distance, 1.12, is that of p1 and p2.
    assert!(msolve.contains("-784/625+x2^2,"), "{msolve}");
    for (way, sign) in [
        (Export::Macaulay2, "QQ[x2, "),
        (Export::HomotopyContinuation, "@var x2 "),
        (Export::Ibex, "x2 in ["),
        (Export::RealPaver, "x2 in ["),
    ] {
        assert!(export(&system, way, 20.0).unwrap().contains(sign));
    }
    // A cosine that is no ratio.
    let (problem, _) = shipped("constraints/3p3l");
    let system = krawl::complex::lower_in_squares(&problem).unwrap().system;
    assert!(
        export(&system, Export::Msolve, 1.0)
            .unwrap_err()
            .contains("ratio")
    );
    assert!(export(&system, Export::PhcPack, 1.0).is_ok());
}

/// All complex solutions of the true icosahedron: for dimensions drawn at random 27136 up to isometry, as many as the bound
/// allows; for the lengths that the papers print 25536, of which 308 are real, as 1600 figures are at infinity. Paths are followed in
/// floats; the solutions and their number are the proof.
///
/// ```sh
/// cargo test --release --test sets -- --ignored complex_solutions::the_true_icosahedron
/// ```
#[test]
#[ignore = "half an hour or more"]
fn the_true_icosahedron() {
    let (_, lowered) = shipped("complex/icosahedron-graph");
    assert_eq!(lowered.enough(), Some(27_136));
    let ways = Ways {
        proved: false,
        ..Ways::default()
    };
    let filling = Filling {
        seed: 2,
        enough: lowered.enough(),
        patience: 30,
        ways,
        ..Filling::default()
    };
    let fibre = fill(&lowered.system, &filling).unwrap();
    assert_eq!(fibre.solutions.len(), 27_136);
    let template = Template::new("icosahedron-graph", fibre);
    let solutions = solve(&lowered, &template, &ways);
    assert_eq!(solutions.status, Status::Complete);
    assert_eq!(
        (solutions.boxes.len(), solutions.real().count()),
        (25_536, 308)
    );
    assert_eq!(solutions.at_infinity(), 1600);
}

/// Where one of three lines is at a right angle to both others, these may be reversed together; with one right angle, or none, no
/// line may. And a line that is parallel to the plane on which a template has its place is none for that template.
#[test]
fn two_right_angles_of_three_lines_allow_a_reversal() {
    let shipped = std::fs::read_to_string("problems/constraints/3p3l.toml").unwrap();
    let with = |angles: [f64; 3]| {
        let [a, b, c] = angles;
        let text = shipped.replace(
            r#"["l1", "l2", 8], ["l1", "l3", 88], ["l2", "l3", 86]"#,
            &format!(r#"["l1", "l2", {a}], ["l1", "l3", {b}], ["l2", "l3", {c}]"#),
        );
        assert_ne!(text, shipped);
        Problem::parse(&text, "test.toml").unwrap()
    };
    let reversals = |angles: [f64; 3]| {
        let system = lower(&with(angles)).unwrap().system;
        system.group_of_instance.len() / system.group.len()
    };
    assert_eq!(reversals([80.0, 75.0, 86.0]), 1);
    assert_eq!(reversals([90.0, 88.0, 86.0]), 1);
    assert_eq!(reversals([90.0, 90.0, 86.0]), 2);
    assert_eq!(reversals([86.0, 90.0, 90.0]), 2);
    let text = std::fs::read_to_string("problems/constraints/3p3l.krawl-template").unwrap();
    let fits = |angles: [f64; 3]| {
        let lowered = lower_for(&with(angles), &text).unwrap();
        Template::read(&text, &lowered.system).is_ok()
    };
    assert!(fits([80.0, 75.0, 86.0]) && !fits([90.0, 90.0, 86.0]));
}
