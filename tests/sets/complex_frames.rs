//! Complex solutions of problems in a frame of their own: fixed points, rigid bodies, sliders. Compared with complete real
//! sets, and with numbers that are this file's own.

use assert_cmd::Command;
use krawl::complete::{self, all};
use krawl::complex::{
    Filling, Lowered, Nature, Solutions, Status, Template, Ways, fill, lower, solve,
};
use krawl::interval::{Interval, point};
use krawl::nalgebra::{Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};
use krawl::problem::Problem;

/// Dietmaier's platform: base, platform, lengths of the legs.
const BASE: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [1.107915, 0.0, 0.0],
    [0.549094, 0.756063, 0.0],
    [0.735077, -0.223935, 0.525991],
    [0.514188, -0.526063, -0.368418],
    [0.590473, 0.094733, -0.205018],
];
const PLATFORM: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.542805, 0.0, 0.0],
    [0.956919, -0.528915, 0.0],
    [0.665885, -0.353482, 1.402538],
    [0.478359, 1.158742, 0.107672],
    [-0.137087, -0.235121, 0.353913],
];
const LEGS: [f64; 6] = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];

const DIETMAIER: &str = "problems/mechanisms/dietmaier.toml";

fn floats() -> Ways<'static> {
    Ways {
        proved: false,
        ..Ways::default()
    }
}

fn filled(lowered: &Lowered, patience: usize) -> Template {
    let filling = Filling {
        patience,
        ways: floats(),
        ..Filling::default()
    };
    Template::new("test", fill(&lowered.system, &filling).unwrap())
}

/// The places of all points of a solution, real parts first, as intervals in the problem's unit.
fn places(lowered: &Lowered, solutions: &Solutions, k: usize) -> Vec<[[Interval; 3]; 2]> {
    let one = &solutions.boxes.boxes()[k];
    let unit = point(lowered.system.unit);
    let part = |place: &[Option<usize>; 3], part: usize| {
        place.map(|u| u.map_or(point(0.0), |u| one.parts[2 * u + part] * unit))
    };
    let points = lowered.system.points.iter();
    points.map(|p| [part(p, 0), part(p, 1)]).collect()
}

fn dietmaier(bound: Option<u128>) -> (Lowered, Solutions) {
    let problem = Problem::read(DIETMAIER).unwrap();
    let mut lowered = lower(&problem).unwrap();
    if let Some(bound) = bound {
        lowered.cite(bound);
    }
    let text = std::fs::read_to_string("problems/mechanisms/dietmaier.krawl-template").unwrap();
    let template = Template::read(&text, &lowered.system).unwrap();
    let solutions = solve(&lowered, &template, &floats());
    (lowered, solutions)
}

/// The middles of the platform's points in each real solution.
fn postures(lowered: &Lowered, solutions: &Solutions) -> Vec<[Vector3<f64>; 6]> {
    let of = |k: usize| {
        let points = places(lowered, solutions, k);
        std::array::from_fn(|p| Vector3::from(points[6 + p][0].map(|x| x.mid())))
    };
    solutions.real().map(of).collect()
}

/// The published number, forty, and all real: each one meets the published numbers as they stand in this file.
#[test]
fn dietmaiers_platform_has_forty_real_figures() {
    let (lowered, solutions) = dietmaier(Some(40));
    assert_eq!(solutions.status, Status::Complete);
    let counts = solutions.counts;
    assert!(counts.certain);
    assert_eq!(
        [counts.gauge, counts.rotation, counts.isometry],
        [40, 40, 40]
    );
    assert_eq!(solutions.real().count(), 40);
    let found = postures(&lowered, &solutions);
    let local = PLATFORM.map(Vector3::from);
    let volume = |p: &[Vector3<f64>; 6]| (p[1] - p[0]).cross(&(p[2] - p[0])).dot(&(p[3] - p[0]));
    for (k, posture) in found.iter().enumerate() {
        for p in 0..6 {
            let leg = (posture[p] - Vector3::from(BASE[p])).norm();
            assert!((leg - LEGS[p]).abs() < 1e-8, "{k}: leg {p} is {leg}");
            for q in 0..p {
                let [here, there] = [posture, &local].map(|x| (x[p] - x[q]).norm());
                assert!((here - there).abs() < 1e-8, "{k}: {p}-{q}");
            }
        }
        // Not mirrored.
        assert!((volume(posture) - volume(&local)).abs() < 1e-6, "{k}");
        for other in &found[..k] {
            let apart = (0..6).map(|p| (posture[p] - other[p]).norm());
            assert!(apart.fold(0.0, f64::max) > 1e-3, "{k}");
        }
    }
}

/// The template serves a platform whose fixed points, legs and body are others: forty again, of which few are real.
#[test]
fn the_template_serves_another_platform() {
    let mut text = std::fs::read_to_string(DIETMAIER).unwrap();
    for (old, new) in [
        ("A1 = [0.0, 0.0, 0.0]", "A1 = [0.1, -0.25, 0.05]"),
        ("B6 = [-0.137087,", "B6 = [-0.25,"),
        ("\"B3\", 1.086284", "\"B3\", 1.25"),
    ] {
        assert_eq!(text.matches(old).count(), 1);
        text = text.replace(old, new);
    }
    let lowered = lower(&Problem::parse(&text, "test.toml").unwrap()).unwrap();
    let shipped = std::fs::read_to_string("problems/mechanisms/dietmaier.krawl-template").unwrap();
    let template = Template::read(&shipped, &lowered.system).unwrap();
    let solutions = solve(&lowered, &template, &floats());
    assert_eq!(solutions.boxes.len(), 40);
    let real = solutions.real().count();
    assert!(real < 40 && real.is_multiple_of(2), "{real}");
    let is_settled = |nature: &Nature| matches!(nature, Nature::Real | Nature::Pair(_));
    assert!(solutions.natures.iter().all(is_settled));
}

/// Without a bound nothing is claimed of other solutions, and a bound that is too small is called wrong.
#[test]
fn what_is_said_rests_on_the_bound() {
    assert_eq!(dietmaier(None).1.status, Status::Found);
    assert_eq!(dietmaier(Some(41)).1.status, Status::Found);
    let template = "problems/mechanisms/dietmaier.krawl-template";
    let said = |bound: &str| {
        let arguments = [
            "complex",
            DIETMAIER,
            "--template",
            template,
            "--float",
            "--bound",
        ];
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let output = command.args(arguments).arg(bound).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), text)
    };
    let (code, text) = said("40");
    assert_eq!(code, Some(0));
    assert!(
        text.starts_with(
            "dietmaier: Complete if the bound that you cite holds: 40 complex solutions, each proved. There is no other \
             isolated complex solution if there are at most 40, which is not proved here.\n\
             Each box holds exactly one solution; no two are the same figure. 40 are real, 0 in pairs of conjugates.\n"
        ),
        "{text}"
    );
    // There is no motion to divide by.
    for word in ["isometry", "rotation", "congruent", "mirror"] {
        assert!(!text.contains(word), "{word}: {text}");
    }
    assert!(text.contains("gauge      the coordinates of the file"));
    let (code, text) = said("39");
    assert_eq!(code, Some(4));
    assert!(
        text.contains("The bound that you cite is wrong: at most 39, and 40 complex solutions"),
        "{text}"
    );
}

/// Newton's method for a quaternion and a place, from random starts: what it comes to is among the forty.
#[test]
fn newtons_method_from_random_places_finds_no_other_posture() {
    type State = SVector<f64, 7>;
    let body = PLATFORM.map(Vector3::from);
    let posture = |v: &State| -> [Vector3<f64>; 6] {
        let turn = Quaternion::new(v[0], v[1], v[2], v[3]);
        let turn = UnitQuaternion::from_quaternion(turn);
        let place = Vector3::new(v[4], v[5], v[6]);
        body.map(|b| turn * b + place)
    };
    let residual = |v: &State| -> State {
        let points = posture(v);
        SVector::from_fn(|k, _| match k {
            6 => v.fixed_rows::<4>(0).norm_squared() - 1.0,
            k => (points[k] - Vector3::from(BASE[k])).norm_squared() - LEGS[k] * LEGS[k],
        })
    };
    let jacobian = |v: &State| -> SMatrix<f64, 7, 7> {
        const STEP: f64 = 1e-6;
        let column = |k: usize| {
            let mut step = State::zeros();
            step[k] = STEP;
            (residual(&(v + step)) - residual(&(v - step))) / (2.0 * STEP)
        };
        SMatrix::from_columns(&std::array::from_fn::<State, 7, _>(column))
    };
    let (lowered, solutions) = dietmaier(None);
    let known = postures(&lowered, &solutions);
    let mut met = vec![false; known.len()];
    let mut bits = 7u64;
    let mut random = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for _ in 0..4000 {
        let mut v = State::from_fn(|_, _| random());
        let mut settled = false;
        for _ in 0..60 {
            let Some(mut step) = jacobian(&v).lu().solve(&residual(&v)) else {
                break;
            };
            let size = step.norm();
            if size > 0.5 {
                step *= 0.5 / size;
            }
            v -= step;
            settled = size < 1e-10;
            if settled {
                break;
            }
        }
        if !settled || residual(&v).amax() > 1e-10 {
            continue;
        }
        let points = posture(&v);
        let is_it = |other: &[Vector3<f64>; 6]| {
            let mut apart = points.iter().zip(other).map(|(a, b)| (a - b).norm());
            apart.all(|d| d < 1e-6)
        };
        let same: Vec<usize> = (0..known.len()).filter(|&k| is_it(&known[k])).collect();
        assert_eq!(same.len(), 1, "{points:?}");
        met[same[0]] = true;
    }
    let met = met.iter().filter(|&&met| met).count();
    assert!(met >= 35, "only {met} were met");
}

/// Real solutions and the complete real set: the same figures, one to one. Gives how many.
fn compare(text: &str, template: &Template) -> usize {
    let problem = Problem::parse(text, "test.toml").unwrap();
    let lowered = lower(&problem).unwrap();
    let solutions = solve(&lowered, template, &Ways::default());
    let set = all(&problem, &complete::Options::default()).unwrap();
    assert_eq!(set.status, complete::Status::Complete, "{text}");
    let real: Vec<usize> = solutions.real().collect();
    assert_eq!(real.len(), set.solutions.len(), "{text}");
    let mine: Vec<_> = real
        .iter()
        .map(|&k| places(&lowered, &solutions, k))
        .collect();
    for theirs in &set.solutions {
        let is_it = |mine: &&Vec<[[Interval; 3]; 2]>| {
            let mut points = mine.iter().zip(&theirs.points);
            points.all(|([re, _], place)| re.iter().zip(place).all(|(a, b)| !a.disjoint(*b)))
        };
        assert_eq!(mine.iter().filter(is_it).count(), 1, "{text}");
    }
    // Whatever is not real has its conjugate in the set.
    for (k, nature) in solutions.natures.iter().enumerate() {
        match nature {
            Nature::Real => {}
            Nature::Pair(other) => assert_eq!(solutions.natures[*other], Nature::Pair(k)),
            other => panic!("{other:?}: {text}"),
        }
    }
    real.len()
}

/// Three fixed points and a plate on three legs: at most six assembly modes (Hunt 1983).
fn planar_platform(fixed: [[f64; 2]; 3], legs: [f64; 3]) -> String {
    let [a, b, c] = fixed;
    let [l, m, n] = legs;
    format!(
        "dimension = 2\n[points]\nA1 = {a:?}\nA2 = {b:?}\nA3 = {c:?}\nB1 = [3, 2]\nB2 = [18, 3]\nB3 = [10, 15]\n\
         [bodies]\nplate = {{ B1 = [0, 0], B2 = [15, 0], B3 = [7, 13] }}\n\
         [constraints]\nfixed = [[\"A1\"], [\"A2\"], [\"A3\"]]\n\
         distances = [[\"A1\", \"B1\", {l:?}], [\"A2\", \"B2\", {m:?}], [\"A3\", \"B3\", {n:?}]]\n"
    )
}

#[test]
fn one_template_serves_platforms_whose_fixed_points_are_elsewhere() {
    let first = planar_platform([[0.0, 0.0], [16.0, 0.0], [0.0, 10.0]], [14.98, 15.38, 12.0]);
    let lowered = lower(&Problem::parse(&first, "test.toml").unwrap()).unwrap();
    let template = filled(&lowered, 5);
    assert_eq!(template.solutions.len(), 6);
    assert_eq!(compare(&first, &template), 6);
    let mut counts = std::collections::BTreeSet::new();
    for k in 0..6 {
        let x = f64::from(k);
        let text = planar_platform(
            [[0.5 * x, 0.0], [16.0, 0.25 * x], [1.0 - x, 10.0 + x]],
            [12.0 - x, 11.0 + 0.5 * x, 9.0 + 0.75 * x],
        );
        counts.insert(compare(&text, &template));
    }
    assert!(counts.len() > 1, "{counts:?}");
}

/// A crank that is driven, a rail through two fixed points, and a point of the coupler on either side.
#[test]
fn a_slider_on_a_fixed_rail() {
    let slider = |x: f64, coupler: f64| {
        format!(
            "dimension = 2\n[points]\nO = [0, 0]\nS = [1, -1]\nE = [6, 0.5]\nA = [0.6, 0.8]\nB = [3, -0.4]\nC = [2, 1]\n\
             [lines]\nrail = [\"S\", \"E\"]\n\
             [constraints]\nfixed = [[\"O\"], [\"S\"], [\"E\"]]\nx = [[\"A\", {x:?}]]\n\
             distances = [[\"O\", \"A\", 1.0], [\"A\", \"B\", {coupler:?}], [\"A\", \"C\", 2.0], [\"B\", \"C\", 2.5]]\n\
             on = [[\"B\", \"rail\"]]\n"
        )
    };
    let first = slider(0.6, 3.0);
    let lowered = lower(&Problem::parse(&first, "test.toml").unwrap()).unwrap();
    let template = filled(&lowered, 5);
    assert_eq!(template.solutions.len(), 8);
    assert_eq!(compare(&first, &template), 8);
    assert_eq!(compare(&slider(-0.25, 4.25), &template), 8);
    // The coupler is too short to come to the rail from one of the two places of A.
    assert_eq!(compare(&slider(0.0, 1.25), &template), 4);
}

#[test]
fn the_double_butterfly() {
    let text = std::fs::read_to_string("problems/mechanisms/double-butterfly.toml").unwrap();
    let lowered = lower(&Problem::parse(&text, "test.toml").unwrap()).unwrap();
    let template = filled(&lowered, 5);
    assert_eq!(template.solutions.len(), 18);
    assert_eq!(compare(&text, &template), 6);
}

/// Fixed points on an axis: the mirror image is a figure of its own.
#[test]
fn mirror_images_count() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [5, 0]\nP = [1, 1]\nQ = [1, 3]\n[constraints]\n\
                fixed = [[\"A\"], [\"B\"]]\n\
                distances = [[\"A\", \"P\", 3], [\"B\", \"P\", 4], [\"P\", \"Q\", 2], [\"A\", \"Q\", 4]]\n";
    let lowered = lower(&Problem::parse(text, "test.toml").unwrap()).unwrap();
    assert_eq!(lowered.system.group_of_instance.len(), 1);
    assert_eq!(compare(text, &filled(&lowered, 5)), 4);
}

/// A line of its own has a direction, which is the same line reversed: counted once. The sketch meets its constraints in
/// the first file, where random figures have that symmetry too.
#[test]
fn directions_of_lines_are_not_counted_twice() {
    for (a, in_all) in [("[0, 0]", 2), ("[0.5, 0.25]", 1)] {
        let text = format!(
            "dimension = 2\n[points]\nA = {a}\nB = [5, 0]\nP = [3, 4]\n\
             [lines]\nl = {{ point = [0.0, 0.0], direction = [3.0, 4.0] }}\n\
             [constraints]\nfixed = [[\"A\"], [\"B\"]]\n\
             distances = [[\"B\", \"P\", 4], [\"A\", \"P\", 4.5]]\non = [[\"A\", \"l\"], [\"P\", \"l\"]]\n"
        );
        let lowered = lower(&Problem::parse(&text, "test.toml").unwrap()).unwrap();
        assert_eq!(lowered.system.group.len(), in_all);
        assert_eq!(lowered.system.group_of_instance.len(), 2);
        let template = filled(&lowered, 5);
        assert_eq!(compare(&text, &template), 2);
        let solutions = solve(&lowered, &template, &Ways::default());
        assert_eq!((solutions.counts.gauge, solutions.counts.isometry), (4, 2));
        assert_eq!(
            solutions.counts_in_words(&lowered.system),
            "2 complex solutions, 4 with directions reversed"
        );
        assert!(!lowered.system.is_told_by_points());
    }
}

/// What zeros of the equations need not meet is refused by name.
#[test]
fn what_is_refused() {
    let head = "dimension = 2\n[points]\nA = [0, 0]\nB = [5, 0]\nP = [3, 4]\nQ = [2, 2.5]\n";
    for (rest, why) in [
        // P may come to A, and then any Q is where the equations want it.
        (
            "[lines]\nm = [\"A\", \"P\"]\n[constraints]\nfixed = [[\"A\"], [\"B\"]]\non = [[\"Q\", \"m\"]]\n\
             distances = [[\"B\", \"P\", 4], [\"B\", \"Q\", 3], [\"P\", \"Q\", 1.8]]\n",
            "must not vanish",
        ),
        // Which of the two directions is a matter of its sign.
        (
            "[lines]\nl = { point = [0, 0], direction = [3, 4] }\n[constraints]\nfixed = [[\"A\"], [\"l\"]]\n\
             on = [[\"P\", \"l\"], [\"Q\", \"l\"]]\n\
             distances = [[\"A\", \"B\", 5], [\"B\", \"P\", 4], [\"P\", \"Q\", 2], [\"B\", \"Q\", 3]]\n",
            "direction of its own",
        ),
        // The line passes on one side of both points.
        (
            "[lines]\nl = { point = [0, 1], direction = [1, 0] }\n[constraints]\nfixed = [[\"A\"], [\"B\"]]\n\
             distances = [[\"A\", \"l\", 1], [\"B\", \"l\", 1.5], [\"A\", \"P\", 4.5], [\"B\", \"P\", 4], [\"A\", \"Q\", 3], [\"B\", \"Q\", 4]]\n",
            "two directions of `l` apart",
        ),
    ] {
        let problem = match Problem::parse(&format!("{head}{rest}"), "test.toml") {
            Ok(problem) => problem,
            Err(error) => panic!("{rest}: {error}"),
        };
        let refused = lower(&problem).unwrap_err().to_string();
        assert!(refused.contains(why), "{rest}: {refused}");
    }
}

/// A body with another point beside its base, or one less, has other equations.
#[test]
fn a_template_of_other_equations_is_refused() {
    let text = planar_platform([[0.0, 0.0], [16.0, 0.0], [0.0, 10.0]], [14.98, 15.38, 12.0]);
    let lowered = lower(&Problem::parse(&text, "test.toml").unwrap()).unwrap();
    let shipped = std::fs::read_to_string("problems/mechanisms/dietmaier.krawl-template").unwrap();
    let refused = Template::read(&shipped, &lowered.system).unwrap_err();
    assert!(refused.to_string().contains("dietmaier"));
}
