//! Bodies with joints: figures beside a second computation of where links are (products of matrices), beside formulas, and beside Newton's method from
//! many starts.

use krawl::complete::{Complete, Options, Status, all};
use krawl::edit::{Ending, Session, Setting};
use krawl::interval::Interval;
use krawl::motion::{Bounds, Motion};
use krawl::problem::{Problem, Shape};
use krawl::system::Located;
use krawl::track::{Control, prove};
use nalgebra::DMatrix;
use proptest::prelude::*;
use std::f64::consts::TAU;

type Matrix = [[f64; 4]; 4];

fn read(text: &str) -> Problem {
    Problem::parse(text, "joints.toml").unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn example(name: &str) -> Problem {
    Problem::read(format!("docs/examples/{name}.toml")).unwrap()
}

/// A row of Denavit and Hartenberg: d, a, alpha in degrees, and whether d is what moves.
type Row = (f64, f64, f64, bool);

/// A link seen from the one before, as textbooks have it.
fn link((d, a, alpha, is_prismatic): Row, moved: f64) -> Matrix {
    let (theta, d) = match is_prismatic {
        true => (0.0, moved),
        false => (moved, d),
    };
    let (s, c) = theta.to_radians().sin_cos();
    let (sa, ca) = alpha.to_radians().sin_cos();
    [
        [c, -s * ca, s * sa, a * c],
        [s, c * ca, -c * sa, a * s],
        [0.0, sa, ca, d],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The hand's frame.
fn hand(rows: &[Row], moved: &[f64]) -> Matrix {
    let identity = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let links = rows.iter().zip(moved);
    links.fold(identity, |all, (&row, &moved)| {
        product(&all, &link(row, moved))
    })
}

fn off(a: &Matrix, b: &Matrix) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// The file of an arm with its hand there.
fn arm(rows: &[Row], sketch: &[f64], target: &Matrix) -> String {
    let row = |(&(d, a, alpha, is_prismatic), moved): (&Row, &f64)| match is_prismatic {
        true => format!("{{ prismatic = true, d = {moved:?}, a = {a:?}, alpha = {alpha:?} }}"),
        false => format!("{{ theta = {moved:?}, d = {d:?}, a = {a:?}, alpha = {alpha:?} }}"),
    };
    let list: Vec<String> = rows.iter().zip(sketch).map(row).collect();
    let column = |k: usize| {
        format!(
            "[{:?}, {:?}, {:?}]",
            target[0][k], target[1][k], target[2][k]
        )
    };
    format!(
        "name = \"arm\"\ndimension = 3\n[robots]\nr = [{}]\n[places]\nr_{n} = {{ at = {}, z = {}, x = {} }}\n[constraints]\nfixed = [\"r_0\", \"r_{n}\"]\n",
        list.join(", "),
        column(3),
        column(2),
        column(0),
        n = rows.len()
    )
}

/// What the joints measure in each solution.
fn ranges(problem: &Problem, found: &Complete) -> Vec<Vec<Interval>> {
    let of = |objects: &[Located]| {
        let number = |located: &Located| match located {
            Located::Joint { turn, travel } => turn.or(*travel),
            _ => None,
        };
        objects.iter().filter_map(number).collect()
    };
    assert!(problem.has_joints());
    found.solutions.iter().map(|s| of(&s.objects)).collect()
}

fn middles(ranges: &[Interval]) -> Vec<f64> {
    ranges.iter().map(|x| x.mid()).collect()
}

/// The middles of what the joints measure in each solution, where none is wide.
fn moved(problem: &Problem, found: &Complete) -> Vec<Vec<f64>> {
    let all = ranges(problem, found);
    assert!(all.iter().flatten().all(|x| x.wid() < 1e-9), "{all:?}");
    all.iter().map(|one| middles(one)).collect()
}

/// By how many units the hand's frame goes, at least, where the joints go by one degree in any way.
fn stiffness(rows: &[Row], angles: &[f64]) -> f64 {
    let step = 1e-4;
    let place = |k: usize, by: f64| {
        let mut there = angles.to_vec();
        there[k] += by;
        hand(rows, &there)
    };
    let jacobian = DMatrix::from_fn(12, angles.len(), |i, k| {
        (place(k, step)[i / 4][i % 4] - place(k, -step)[i / 4][i % 4]) / (2.0 * step)
    });
    jacobian.singular_values().min()
}

/// How far apart two lists of angles in degrees are, up to whole turns.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b).map(|(x, y)| {
        let turn = (x - y).rem_euclid(360.0);
        turn.min(360.0 - turn)
    });
    pairs.fold(0.0, f64::max)
}

/// All axes of bodies are right-handed, and at right angles to each other.
fn are_frames(found: &Complete) {
    for located in found.solutions.iter().flat_map(|s| &s.objects) {
        let Located::Pose { axes, .. } = located else {
            continue;
        };
        let [x, y, z] = axes.each_ref().map(|v| v.each_ref().map(|c| c.mid()));
        let cross: [f64; 3] = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            x[i] * y[j] - x[j] * y[i]
        });
        let far = cross
            .iter()
            .zip(&z)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(far < 1e-9, "{axes:?}");
    }
}

const UR5: [Row; 6] = [
    (0.089159, 0.0, 90.0, false),
    (0.0, -0.425, 0.0, false),
    (0.0, -0.39225, 0.0, false),
    (0.10915, 0.0, 90.0, false),
    (0.09465, 0.0, -90.0, false),
    (0.0823, 0.0, 0.0, false),
];

#[test]
fn the_arm_ur5_reaches_a_place_in_eight_ways() {
    let problem = example("ur5");
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!((found.status, found.solutions.len()), (Status::Complete, 8));
    are_frames(&found);
    let unit = |v: [f64; 3]| {
        let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / size)
    };
    let z = unit([-0.6131, -0.6645, 0.4273]);
    let along = [0.7, -0.6, 0.1];
    let part: f64 = (0..3).map(|k| along[k] * z[k]).sum();
    let x = unit(std::array::from_fn(|k| along[k] - part * z[k]));
    let y: [f64; 3] = std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        z[i] * x[j] - z[j] * x[i]
    });
    let at = [-0.45, -0.25, 0.35];
    let target: Matrix = std::array::from_fn(|i| match i {
        3 => [0.0, 0.0, 0.0, 1.0],
        _ => [x[i], y[i], z[i], at[i]],
    });
    for angles in moved(&problem, &found) {
        assert!(off(&hand(&UR5, &angles), &target) < 1e-9, "{angles:?}");
    }
    // The path through the sketch has some of them, and no other.
    let on_path = prove(&problem).unwrap().solutions;
    assert!(!on_path.is_empty() && on_path.len() <= 8);
}

/// Manseur and Doty, A robot manipulator with 16 real inverse kinematic solution sets (1989).
#[test]
fn manseur_and_doty_s_arm_reaches_a_place_in_sixteen_ways() {
    let rows = [
        (0.0, 0.3, 90.0, false),
        (0.0, 1.0, 1.0, false),
        (0.2, 0.0, 90.0, false),
        (0.0, 1.5, 1.0, false),
        (0.0, 0.0, 90.0, false),
        (0.0, 0.0, 1.0, false),
    ];
    // z and x as published; y is theirs.
    let target = [
        [-0.760117, 0.0, 0.102262, -1.140175],
        [0.133333, 0.0, 0.991071, 0.0],
        [-0.635959, 0.0, 0.085558, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let problem = read(&arm(
        &rows,
        &[10.0, 30.0, -40.0, 60.0, 20.0, 100.0],
        &target,
    ));
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!(
        (found.status, found.solutions.len()),
        (Status::Complete, 16)
    );
    are_frames(&found);
    for angles in moved(&problem, &found) {
        let mut there = hand(&rows, &angles);
        there.iter_mut().for_each(|row| row[1] = 0.0);
        assert!(off(&there, &target) < 2e-6, "{angles:?}");
    }
}

/// Newton's method on six angles from one start, with the Jacobian by differences.
fn newton(rows: &[Row], target: &Matrix, mut angles: Vec<f64>) -> Option<Vec<f64>> {
    let entries = |m: &Matrix| -> Vec<f64> { m[..3].iter().flatten().copied().collect() };
    let wanted = entries(target);
    for _ in 0..60 {
        let now = entries(&hand(rows, &angles));
        let off: Vec<f64> = now.iter().zip(&wanted).map(|(x, y)| x - y).collect();
        if off.iter().all(|x| x.abs() < 1e-12) {
            return Some(angles);
        }
        let step = 1e-6;
        let columns: Vec<Vec<f64>> = (0..6)
            .map(|k| {
                let mut moved = angles.clone();
                moved[k] += step;
                let there = entries(&hand(rows, &moved));
                there
                    .iter()
                    .zip(&now)
                    .map(|(x, y)| (x - y) / step)
                    .collect()
            })
            .collect();
        // Least squares: AᵀA δ = Aᵀ off.
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let mut system: Vec<Vec<f64>> = (0..6)
            .map(|i| {
                let row = (0..6).map(|j| dot(&columns[i], &columns[j]));
                row.chain([dot(&columns[i], &off)]).collect()
            })
            .collect();
        for k in 0..6 {
            let pivot =
                (k..6).max_by(|&a, &b| system[a][k].abs().total_cmp(&system[b][k].abs()))?;
            system.swap(k, pivot);
            if system[k][k].abs() < 1e-14 {
                return None;
            }
            for i in 0..6 {
                if i != k {
                    let factor = system[i][k] / system[k][k];
                    let row = system[k].clone();
                    system[i]
                        .iter_mut()
                        .zip(&row)
                        .for_each(|(x, y)| *x -= factor * y);
                }
            }
        }
        for k in 0..6 {
            angles[k] -= system[k][6] / system[k][k];
        }
    }
    None
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, ..ProptestConfig::default() })]

    /// Arms with axes at right angles or parallel, and others: what Newton's method finds is among the figures, and each of these puts the hand where it is
    /// to be.
    #[test]
    fn arms_reach_a_place_as_newton_s_method_says(
        lengths in prop::collection::vec((-2i32..=2, -2i32..=2, 0usize..5), 6),
        angles in prop::collection::vec(-170.0f64..170.0, 6),
        starts in prop::collection::vec(prop::collection::vec(-180.0f64..180.0, 6), 60),
    ) {
        let twists = [90.0, -90.0, 0.0, 35.0, -60.0];
        let mut rows: Vec<Row> = lengths
            .iter()
            .map(|&(d, a, twist)| (f64::from(d) * 0.25, f64::from(a) * 0.5, twists[twist], false))
            .collect();
        // Of three parallel axes on end there may be a curve of figures.
        rows[1].2 = 90.0;
        rows[3].2 = -90.0;
        rows[4].2 = 90.0;
        let target = hand(&rows, &angles);
        let text = arm(&rows, &starts[0], &target);
        // Where axes are one and the same a link can spin.
        let Ok(problem) = Problem::parse(&text, "arm.toml") else {
            return Ok(());
        };
        let options = Options {
            most_boxes: 6000,
            ..Options::default()
        };
        let found = all(&problem, &options).unwrap();
        let all_ranges = ranges(&problem, &found);
        let all_angles: Vec<Vec<f64>> = all_ranges.iter().map(|one| middles(one)).collect();
        are_frames(&found);
        for (one, ranges) in all_angles.iter().zip(&all_ranges) {
            prop_assert!(off(&hand(&rows, one), &target) < 1e-8, "{one:?}");
            // No wider than what rounding makes of the hand's place.
            let widest = ranges.iter().map(|x| x.wid()).fold(0.0, f64::max);
            prop_assert!(widest * stiffness(&rows, one) < 1e-12, "{widest:e} {rows:?} {one:?}");
        }
        if found.status == Status::Complete {
            let others = starts.iter().filter_map(|start| newton(&rows, &target, start.clone()));
            for known in others.chain([angles]) {
                let is_there = all_angles.iter().any(|one| apart(one, &known) < 1e-5);
                prop_assert!(is_there, "{known:?}: {all_angles:?}");
            }
        }
    }
}

/// An arm that moves in planes, with a spindle: by the law of cosines.
#[test]
fn an_arm_with_a_spindle_reaches_a_place_in_two_ways() {
    let rows = [
        (0.4, 0.3, 0.0, false),
        (0.0, 0.25, 180.0, false),
        (0.0, 0.0, 0.0, true),
        (0.05, 0.0, 0.0, false),
    ];
    let target = hand(&rows, &[20.0, 50.0, 0.1, 35.0]);
    let text = arm(&rows, &[0.0, 40.0, 0.2, 0.0], &target);
    let problem = Problem::parse_loosely(&text, "s.toml").unwrap();
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!(found.solutions.len(), 2);
    let values = moved(&problem, &found);
    for one in &values {
        assert!(off(&hand(&rows, one), &target) < 1e-9, "{one:?}");
    }
    assert!(values.iter().any(|one| (one[1] - 50.0).abs() < 1e-9));
    assert!(values.iter().any(|one| (one[1] + 50.0).abs() < 1e-9));
}

const CARDAN: &str = "
name = \"Cardan\"
dimension = 3
[bodies]
ground = {}
first = {}
second = {}
[joints]
A = { revolute = [\"ground\", \"first\"], sketch = 25 }
B = { revolute = [\"ground\", \"second\"], z = [[0, 0.6427876096865393, 0.7660444431189781], [0, 0, 1]] }
C = { universal = [\"first\", \"second\"], z = [[1, 0, 0], [0, 1, 0]], x = [[0, 1, 0], [1, 0, 0]] }
[constraints]
turns = [[\"A\", 30]]
";

#[test]
fn a_cardan_joint_is_uneven_as_its_formula_says() {
    // More equations than unknowns: what was left out is met.
    let problem = Problem::parse_loosely(CARDAN, "cardan.toml").unwrap();
    let found = all(&problem, &Options::default()).unwrap();
    // The second shaft can be put on the cross either way round.
    let angles = moved(&problem, &found);
    assert_eq!(angles.len(), 2);
    let wanted = (30f64.to_radians().tan() * 40f64.to_radians().cos()).atan();
    for one in &angles {
        let halves = (one[1].to_radians() - wanted) / (TAU / 2.0);
        assert!((halves - halves.round()).abs() < 1e-9, "{angles:?}");
    }
    assert!(apart(&angles[0][1..2], &angles[1][1..2]) > 179.0);
}

#[test]
fn bennett_s_loop_closes_though_it_has_an_equation_too_many() {
    let problem = Problem::parse_loosely(
        &std::fs::read_to_string("docs/examples/bennett.toml").unwrap(),
        "bennett.toml",
    )
    .unwrap();
    let found = all(&problem, &Options::default()).unwrap();
    let angles = moved(&problem, &found);
    assert_eq!(angles.len(), 1);
    // The half angles at the ends of a link have one product of tangents (Bennett 1903).
    let half = |k: usize| (angles[0][k].to_radians() / 2.0).tan();
    let (ab, bc) = ((half(0) * half(1)).abs(), (half(2) * half(3)).abs());
    assert!(
        (ab.recip() - bc).abs() < 1e-9 || (ab - bc).abs() < 1e-9,
        "{angles:?}"
    );
}

#[test]
fn three_faces_put_a_box_in_its_corner() {
    let text = "
name = \"three faces\"
dimension = 3
[bodies]
ground = {}
box = {}
[places]
box = { at = [0.9, 2.1, 1.2], z = [0.1, 0.1, 1], x = [1, 0.1, 0] }
[joints]
floor = { planar = [\"ground\", \"box\"], at = [[0, 0, 0], [0, 0, -1]] }
wall = { planar = [\"ground\", \"box\"], at = [[2, 0, 0], [1, 0, 0]], z = [[1, 0, 0], [1, 0, 0]] }
side = { planar = [\"ground\", \"box\"], at = [[0, 3, 0], [0, 1, 0]], z = [[0, 1, 0], [0, 1, 0]] }
[constraints]
travels = [[\"floor\", 0.5]]
";
    let problem = Problem::parse_loosely(text, "mates.toml").unwrap();
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!(found.solutions.len(), 1);
    let Located::Pose { at, axes } = &found.solutions[0].objects[1] else {
        panic!("a body with joints")
    };
    for (x, wanted) in at.iter().zip([1.0, 2.0, 1.5]) {
        assert!(x.contains(wanted) && x.wid() < 1e-12);
    }
    assert!(axes[0][0].contains(1.0) && axes[2][2].contains(1.0));
}

#[test]
fn a_slider_crank_goes_all_the_way_round_between_its_dead_centres() {
    let problem = example("slider-crank");
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!((found.status, found.solutions.len()), (Status::Complete, 2));
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "O=390").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    let (sine, cosine) = 30f64.to_radians().sin_cos();
    let wanted = cosine + (9.0 - sine * sine).sqrt();
    let travel = edited.objects.iter().find_map(|located| match located {
        Located::Joint { travel, .. } => *travel,
        _ => None,
    });
    assert!((travel.unwrap().mid() - wanted).abs() < 1e-9);
    let free = ["turns:O".to_owned()];
    let asked = ["x H".to_owned()];
    let options = krawl::track::Options::certified();
    let motion = Motion::of(&problem, &free, &asked, &options, &mut Control::default()).unwrap();
    assert!(motion.is_loop());
    let range = &motion.measured[0];
    let Bounds::Between { least, most } = &range.bounds else {
        panic!("{range:?}")
    };
    assert!(least.value.contains(2.0) && most.value.contains(4.0));
    assert!(least.value.wid() < 1e-5 && most.value.wid() < 1e-5);
}

/// Legs of a platform in the plane, as joints, and its places by Newton's method from many starts.
#[test]
fn a_platform_on_three_legs_has_as_many_places_as_newton_s_method_finds() {
    let figures = [
        (
            [[0.0, 0.0], [3.0, 0.0], [1.4, 2.6]],
            [[0.0, 0.0], [1.0, 0.0], [0.5, 0.9]],
            [1.5, 1.7, 1.3],
        ),
        (
            [[0.0, 0.0], [1.6, 0.0], [1.4, 1.3]],
            [[0.0, 0.0], [1.6, 0.0], [0.9, 0.2]],
            [1.2, 1.3, 1.8],
        ),
        (
            [[0.0, 0.0], [1.7, 0.0], [1.0, 0.7]],
            [[0.0, 0.0], [1.6, 0.0], [0.3, 1.3]],
            [1.7, 1.7, 1.3],
        ),
    ];
    let mut most = 0;
    for (feet, heads, lengths) in figures {
        let mut text =
            "name = \"3-RPR\"\ndimension = 2\n[bodies]\nground = {}\nplatform = {}\n".to_owned();
        let (mut joints, mut travels) = ("[joints]\n".to_owned(), Vec::new());
        for (k, ((foot, head), length)) in feet.iter().zip(&heads).zip(lengths).enumerate() {
            text += &format!("a{k} = {{}}\nb{k} = {{}}\n");
            joints += &format!(
                "r{k} = {{ revolute = [\"ground\", \"a{k}\"], at = [{foot:?}, [0, 0]], sketch = {} }}\n\
                 p{k} = {{ prismatic = [\"a{k}\", \"b{k}\"], sketch = 1.6 }}\n\
                 s{k} = {{ revolute = [\"b{k}\", \"platform\"], at = [[0, 0], {head:?}] }}\n",
                [40, 120, -120][k]
            );
            travels.push(format!("[\"p{k}\", {length:?}]"));
        }
        let text = format!(
            "{text}[places]\nplatform = {{ at = [1.2, 1.1], x = [1, 0.1] }}\n{joints}[constraints]\ntravels = [{}]\n",
            travels.join(", ")
        );
        let problem = read(&text);
        let found = all(&problem, &Options::default()).unwrap();
        assert_eq!(found.status, Status::Complete);
        // Legs with negative travels are not among these, as each leg's other end is where the travel says.
        let platform = |s: &krawl::track::Solution| match &s.objects[1] {
            Located::Pose { at, axes } => [
                at[0].mid(),
                at[1].mid(),
                axes[0][1].mid().atan2(axes[0][0].mid()),
            ],
            _ => panic!("a body with joints"),
        };
        let places: Vec<[f64; 3]> = found.solutions.iter().map(platform).collect();
        let by_newton = platforms(&feet, &heads, &lengths);
        assert_eq!(places.len(), by_newton.len(), "{places:?}: {by_newton:?}");
        for place in &by_newton {
            let is_it = |other: &[f64; 3]| {
                let turn = (place[2] - other[2]).rem_euclid(TAU);
                (place[0] - other[0]).abs() < 1e-6
                    && (place[1] - other[1]).abs() < 1e-6
                    && turn.min(TAU - turn) < 1e-6
            };
            assert!(places.iter().any(is_it));
        }
        most = most.max(places.len());
    }
    assert_eq!(most, 6);
}

/// Places of the platform: x, y and its angle, each once.
fn platforms(feet: &[[f64; 2]; 3], heads: &[[f64; 2]; 3], lengths: &[f64; 3]) -> Vec<[f64; 3]> {
    let mut found: Vec<[f64; 3]> = Vec::new();
    for start in 0..1500 {
        let part = |k: usize, n: usize| (start / k % n) as f64 / n as f64;
        let mut at = [
            -1.0 + 5.0 * part(1, 11),
            -1.5 + 5.0 * part(11, 11),
            TAU * part(121, 12),
        ];
        for _ in 0..50 {
            let (sine, cosine) = at[2].sin_cos();
            let mut rows = [[0.0; 4]; 3];
            for (row, ((foot, head), length)) in
                rows.iter_mut().zip(feet.iter().zip(heads).zip(lengths))
            {
                let [hx, hy] = [
                    cosine * head[0] - sine * head[1],
                    sine * head[0] + cosine * head[1],
                ];
                let (x, y) = (at[0] + hx - foot[0], at[1] + hy - foot[1]);
                *row = [
                    2.0 * x,
                    2.0 * y,
                    2.0 * (y * hx - x * hy),
                    x * x + y * y - length * length,
                ];
            }
            let det = |c: [usize; 3]| {
                let m = |i: usize, j: usize| rows[i][c[j]];
                m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
                    - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
                    + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0))
            };
            let all = det([0, 1, 2]);
            let steps = [
                det([3, 1, 2]) / all,
                det([0, 3, 2]) / all,
                det([0, 1, 3]) / all,
            ];
            at.iter_mut().zip(steps).for_each(|(x, step)| *x -= step);
            if rows.iter().all(|row| row[3].abs() < 1e-13) {
                let is_it = |other: &[f64; 3]| {
                    let turn = (at[2] - other[2]).rem_euclid(TAU);
                    (at[0] - other[0]).abs() + (at[1] - other[1]).abs() < 1e-6
                        && turn.min(TAU - turn) < 1e-6
                };
                if !found.iter().any(is_it) {
                    found.push(at);
                }
                break;
            }
        }
    }
    found
}

/// What is written is read back, and joints are what they are wherever the body that stands is.
#[test]
fn joints_are_written_and_do_not_depend_on_where_the_ground_is() {
    for name in ["ur5", "slider-crank"] {
        let problem = example(name);
        let again = read(&problem.to_toml());
        assert_eq!(again.objects, problem.objects);
        assert!(matches!(
            again.objects.last().unwrap().shape,
            Shape::Joint { .. }
        ));
    }
    let text = std::fs::read_to_string("docs/examples/slider-crank.toml").unwrap();
    let elsewhere = text.replace("[places]", "").replace(
        "[joints]",
        "[places]\nground = { at = [2, -1], x = [0.6, 0.8] }\n[joints]",
    );
    let elsewhere = elsewhere.replace(
        "G = [0, 0]\nP = [0.9, 0.5]\nH = [3.8, 0]",
        "G = [2, -1]\nP = [2.1, 0]\nH = [4.3, 2]",
    );
    let values = |text: &str| {
        let problem = read(text);
        let mut values = moved(&problem, &all(&problem, &Options::default()).unwrap());
        values.sort_by(|a, b| a[1].total_cmp(&b[1]));
        values
    };
    let (here, there) = (values(&text), values(&elsewhere));
    assert_eq!(here.len(), there.len());
    for (one, other) in here.iter().zip(&there) {
        assert!(apart(&one[..3], &other[..3]) < 1e-9 && (one[3] - other[3]).abs() < 1e-9);
    }
}

/// What two ways say of one axis or one body is said twice: nothing is taken to agree that does not.
#[test]
fn axes_and_directions_at_odds_have_no_figure() {
    let arm = "[robots]\ns = [{ a = 0.5, d = 0.3 }, { a = 0.4 }, { prismatic = true, d = 0.1 }]\n";
    let tilted = format!(
        "dimension = 3\n{arm}[places]\ns_3 = {{ at = [0.6, 0.3, 0.4], z = [0, 0.6, 0.8], x = [1, 0, 0] }}\n[constraints]\nfixed = [\"s_0\", \"s_3\"]\n"
    );
    let bar = |z: &str| {
        format!(
            "dimension = 3\n[bodies]\ng = {{}}\na = {{}}\nb = {{}}\nc = {{}}\n[joints]\n\
             O = {{ revolute = [\"g\", \"a\"], sketch = 40 }}\n\
             A = {{ revolute = [\"a\", \"b\"], at = [[1, 0, 0], [0, 0, 0]], sketch = -40 }}\n\
             B = {{ revolute = [\"b\", \"c\"], at = [[2, 0, 0], [0, 0, 0]], z = [[0, 0, 1], [0, 0, {z}]], sketch = 60 }}\n\
             C = {{ revolute = [\"c\", \"g\"], at = [[1.5, 0, 0], [2.5, 0, 0]] }}\n[constraints]\nturns = [[\"O\", 50]]\n"
        )
    };
    let twisted = "dimension = 3\n[bodies]\na = {}\nb = {}\n[joints]\n\
        J = { rigid = [\"a\", \"b\"], x = [[1, 0, 0], [0, 1, 0]] }\nK = { prismatic = [\"a\", \"b\"] }\n";
    let flipped = "dimension = 3\n[bodies]\na = {}\nb = {}\n[joints]\n\
        J = { rigid = [\"a\", \"b\"] }\nK = { revolute = [\"a\", \"b\"], z = [[0, 0, 1], [0, 0, -1]] }\n";
    let found = |text: &str| {
        let problem = Problem::parse_loosely(text, "odds.toml").unwrap();
        all(&problem, &Options::default()).unwrap()
    };
    for text in [&tilted, &bar("-1"), twisted, flipped] {
        let none = found(text);
        assert_eq!(
            (none.status, none.solutions.len()),
            (Status::Complete, 0),
            "{text}"
        );
    }
    // The same with one sense all round has its two figures.
    assert_eq!(found(&bar("1")).solutions.len(), 2);
}

/// Slides along directions whose lengths are roots: both frames of a joint have one direction, and none is needed twice.
#[test]
fn slides_go_along_any_direction() {
    for z in ["[1, 1, 0]", "[1, 1, 1]", "[0.3, -0.5, 2]"] {
        let text = format!(
            "dimension = 3\n[bodies]\na = {{}}\nb = {{}}\n[joints]\nS = {{ prismatic = [\"a\", \"b\"], z = [{z}, {z}] }}\n[constraints]\ntravels = [[\"S\", 2]]\n"
        );
        let problem = read(&text);
        let found = all(&problem, &Options::default()).unwrap();
        assert_eq!((found.status, found.solutions.len()), (Status::Complete, 1));
        let Located::Pose { at, .. } = &found.solutions[0].objects[1] else {
            panic!("a body with joints")
        };
        let size = at.iter().map(|x| x.mid() * x.mid()).sum::<f64>().sqrt();
        assert!((size - 2.0).abs() < 1e-12);
    }
}

/// Two bodies that two hinges connect tell the hinges' directions, each by the other; their lengths are 1 all the same. With a point of one body given where no turn
/// brings it there is no figure, and where one does there are two.
#[test]
fn axes_that_tell_each_other_have_the_length_one() {
    let found = |z: &str| {
        let text = format!(
            "dimension = 3\n[points]\nP = [0.3, 0.4, 1.8]\nQ = [1, 0.1, 0.1]\n[bodies]\ng = {{}}\na = {{ P = [0, 0, 2], Q = [1, 0, 0] }}\nb = {{}}\n[joints]\n\
             S = {{ spherical = [\"g\", \"a\"] }}\nH = {{ revolute = [\"a\", \"b\"] }}\n\
             K = {{ revolute = [\"a\", \"b\"], at = [[1, 0, 0], [1, 0, 0]], z = [[0, -0.28, 0.96], [0, -0.28, 0.96]] }}\n\
             [constraints]\nx = [[\"P\", 0.48]]\ny = [[\"P\", 0.64], [\"Q\", 0]]\nz = [[\"P\", {z}]]\n"
        );
        let problem = Problem::parse_loosely(&text, "hinges.toml").unwrap();
        let options = Options {
            most_boxes: 5000,
            ..Options::default()
        };
        let found = all(&problem, &options).unwrap();
        (found.status, found.solutions.len())
    };
    // |P| is 2: 0.48² + 0.64² + z² = 4. What is left out where that does not hold may leave a curve, but no figure.
    assert_eq!(found("1.9").1, 0);
    assert_eq!(found("1.83303028"), (Status::Complete, 2));
}
