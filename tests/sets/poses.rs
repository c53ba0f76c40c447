//! All poses of rigid bodies on legs: searches over how a body is turned, against published counts, poses that are known because the
//! legs were measured from them, Newton's method from random starts, and the same robot said in other ways; and their covers, which a check
//! with rotations of its own proves.

use krawl::certificate::cover::coordinates::{CoordinateCover, Turned};
use krawl::certificate::cover::verify_cover;
use krawl::complete::{Complete, Options, Status, all};
use krawl::nalgebra::{Quaternion, Rotation3, SMatrix, SVector, UnitQuaternion, Vector3};
use krawl::problem::Problem;

type Points = [Vector3<f64>; 6];

/// The same chance each time.
struct Random(u64);

impl Random {
    /// From −1 to 1.
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }

    fn turn(&mut self) -> UnitQuaternion<f64> {
        let [a, b, c, d] = std::array::from_fn(|_| self.next());
        UnitQuaternion::from_quaternion(Quaternion::new(a, b, c, d))
    }
}

/// A platform: fixed points, a body, and a leg between each two.
#[derive(Debug, Clone)]
struct Platform {
    base: Points,
    body: Points,
    legs: [f64; 6],
    /// The pose from which the legs were measured, as near as they were rounded.
    measured: Points,
}

/// To six decimals: what a file says.
fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

impl Platform {
    /// The platform whose legs are those of a pose of the body.
    fn at(base: Points, body: Points, turn: UnitQuaternion<f64>, place: Vector3<f64>) -> Self {
        let [base, body] = [base, body].map(|points| points.map(|p| p.map(rounded)));
        let measured = body.map(|b| turn * b + place);
        let legs = std::array::from_fn(|k| rounded((measured[k] - base[k]).norm()));
        Platform {
            base,
            body,
            legs,
            measured,
        }
    }

    fn random(random: &mut Random) -> Self {
        let points = |random: &mut Random| std::array::from_fn(|_| random.vector());
        let (base, body) = (points(random), points(random));
        let (turn, place) = (random.turn(), random.vector());
        Platform::at(base, body, turn, place)
    }

    /// A file; the points' numbers in another order, if wanted.
    fn text(&self, order: [usize; 6]) -> String {
        let mut points = String::new();
        let (mut fixed, mut body, mut legs) = (Vec::new(), Vec::new(), Vec::new());
        for k in order {
            let [a, b] = [self.base[k], self.body[k]];
            let at = |p: Vector3<f64>| format!("[{:?}, {:?}, {:?}]", p.x, p.y, p.z);
            points += &format!(
                "A{k} = {}\nB{k} = {}\n",
                at(a),
                at(b + Vector3::repeat(0.25))
            );
            fixed.push(format!("[\"A{k}\"]"));
            body.push(format!("B{k} = {}", at(b)));
            legs.push(format!("[\"A{k}\", \"B{k}\", {:?}]", self.legs[k]));
        }
        format!(
            "name = \"platform\"\ndimension = 3\n[points]\n{points}[bodies]\nbody = {{ {} }}\n[constraints]\nfixed = [{}]\ndistances = [{}]\n",
            body.join(", "),
            fixed.join(", "),
            legs.join(", ")
        )
    }

    fn solved(&self) -> (Problem, Complete) {
        solved(&self.text([0, 1, 2, 3, 4, 5]))
    }

    /// Newton's method for a quaternion and a place from a start, in floats: the pose it comes to.
    fn newton(&self, mut v: SVector<f64, 7>) -> Option<Points> {
        type State = SVector<f64, 7>;
        let pose = |v: &State| {
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(v[0], v[1], v[2], v[3]));
            self.body.map(|b| turn * b + Vector3::new(v[4], v[5], v[6]))
        };
        let residual = |v: &State| -> State {
            let points = pose(v);
            SVector::from_fn(|k, _| match k {
                6 => v.fixed_rows::<4>(0).norm_squared() - 1.0,
                k => (points[k] - self.base[k]).norm_squared() - self.legs[k] * self.legs[k],
            })
        };
        for _ in 0..60 {
            const STEP: f64 = 1e-6;
            let column = |k: usize| {
                let mut step = State::zeros();
                step[k] = STEP;
                (residual(&(v + step)) - residual(&(v - step))) / (2.0 * STEP)
            };
            let jacobian: SMatrix<f64, 7, 7> =
                SMatrix::from_columns(&std::array::from_fn::<State, 7, _>(column));
            let mut step = jacobian.lu().solve(&residual(&v))?;
            let size = step.norm();
            if size > 0.5 {
                step *= 0.5 / size;
            }
            v -= step;
            if size < 1e-11 {
                return (residual(&v).amax() < 1e-10).then(|| pose(&v));
            }
        }
        None
    }
}

fn solved(text: &str) -> (Problem, Complete) {
    let problem =
        Problem::parse(text, "test.toml").unwrap_or_else(|error| panic!("{error}\n{text}"));
    let result = all(&problem, &Options::default()).unwrap();
    (problem, result)
}

/// The middles of the body's points in each solution.
fn poses(problem: &Problem, result: &Complete) -> Vec<Points> {
    let point = |name: &str| problem.points.iter().position(|p| p.name == name).unwrap();
    let names: [usize; 6] = std::array::from_fn(|k| point(&format!("B{k}")));
    let solutions = result.solutions.iter();
    let pose = |points: &[[krawl::interval::Interval; 3]]| {
        names.map(|p| Vector3::from(points[p].map(|x| x.mid())))
    };
    solutions.map(|solution| pose(&solution.points)).collect()
}

fn are_near(one: &Points, other: &Points) -> bool {
    let mut apart = one.iter().zip(other).map(|(a, b)| (a - b).norm());
    apart.all(|d| d < 1e-5)
}

/// All poses of a platform: the set is complete, each is one, and that from which the legs were measured is among them.
fn complete(platform: &Platform) -> Vec<Points> {
    let (problem, result) = platform.solved();
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    let found = poses(&problem, &result);
    check(platform, &found);
    let is_measured = |one: &Points| {
        let mut apart = one
            .iter()
            .zip(&platform.measured)
            .map(|(a, b)| (a - b).norm());
        apart.all(|d| d < 1e-3)
    };
    assert!(found.iter().any(is_measured));
    found
}

/// Each pose has the legs of the file, is the body and not its mirror image, and is no other pose.
fn check(platform: &Platform, found: &[Points]) {
    let volume = |p: &Points| (p[1] - p[0]).cross(&(p[2] - p[0])).dot(&(p[3] - p[0]));
    for (k, pose) in found.iter().enumerate() {
        for p in 0..6 {
            let leg = (pose[p] - platform.base[p]).norm();
            assert!(
                (leg - platform.legs[p]).abs() < 1e-8,
                "{k}: leg {p} is {leg}"
            );
            for q in 0..p {
                let [here, there] = [pose, &platform.body].map(|x| (x[p] - x[q]).norm());
                assert!((here - there).abs() < 1e-8, "{k}: {p}-{q}");
            }
        }
        assert!((volume(pose) - volume(&platform.body)).abs() < 1e-6, "{k}");
        assert!(!found[..k].iter().any(|other| are_near(pose, other)), "{k}");
    }
}

/// All forty, complete, without any theorem about platforms.
#[test]
fn dietmaiers_platform_has_forty_poses_and_no_other() {
    let text = std::fs::read_to_string("problems/mechanisms/dietmaier.toml").unwrap();
    let (problem, result) = solved(&text);
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    assert_eq!((result.count, result.solutions.len()), (Some(40), 40));
    for solution in &result.solutions {
        for (leg, distance) in problem.distances.iter().enumerate() {
            let [a, b] = distance.points.map(|p| solution.points[p]);
            let square = (0..3).fold(krawl::interval::point(0.0), |sum, k| {
                sum + (a[k] - b[k]).sqr()
            });
            let wanted = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071][leg];
            assert!((square.sqrt() - krawl::interval::point(wanted)).mag() < 1e-9);
        }
    }
}

/// The pose from which legs were measured is in the set (as near as legs were rounded), Newton's method finds no other, and their number is
/// even: not real ones come in pairs among forty.
#[test]
fn random_platforms() {
    let mut random = Random(11);
    let mut counts = Vec::new();
    for round in 0..12 {
        let platform = Platform::random(&mut random);
        let found = complete(&platform);
        assert!(
            found.len() >= 2 && found.len().is_multiple_of(2),
            "{round}: {}",
            found.len()
        );
        let mut met = 0;
        for _ in 0..150 {
            let start = SVector::from_fn(|_, _| random.next());
            if let Some(pose) = platform.newton(start) {
                let same = found.iter().filter(|other| are_near(&pose, other)).count();
                assert_eq!(same, 1, "{round}");
                met += 1;
            }
        }
        assert!(met > 10, "{round}: {met}");
        counts.push(found.len());
    }
    println!("{counts:?}");
    assert!(counts.iter().any(|&n| n > 4));
}

/// Said in another order, with the body's own coordinates moved and turned, or with all moved and turned, it is the same robot.
#[test]
fn the_same_platform_in_other_words() {
    let mut random = Random(5);
    let platform = Platform::random(&mut random);
    let (problem, result) = platform.solved();
    let found = poses(&problem, &result);
    let (problem, other) = solved(&platform.text([3, 5, 0, 1, 4, 2]));
    let again = poses(&problem, &other);
    assert_eq!(found.len(), again.len());
    let is_there = |pose: &Points| again.iter().any(|other| are_near(pose, other));
    assert!(found.iter().all(is_there));

    // A turn whose entries are decimals, so that the numbers of the file stay the same exactly.
    let turn = Rotation3::from_matrix_unchecked(krawl::nalgebra::Matrix3::new(
        0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0,
    ));
    let by = Vector3::new(0.5, -0.25, 0.75);
    let moved = |points: Points| points.map(|p| (turn * p + by).map(|x| (x * 1e9).round() / 1e9));
    for (base, body) in [
        (platform.base, moved(platform.body)),
        (moved(platform.base), platform.body),
    ] {
        let is_base = base != platform.base;
        let robot = Platform {
            base,
            body,
            ..platform.clone()
        };
        let (problem, result) = robot.solved();
        assert_eq!(result.status, Status::Complete);
        let again = poses(&problem, &result);
        assert_eq!(again.len(), found.len());
        for pose in &found {
            let wanted = if is_base {
                pose.map(|p| turn * p + by)
            } else {
                *pose
            };
            assert!(again.iter().any(|other| are_near(&wanted, other)));
        }
    }
}

/// A flat body over a flat base: where they are parallel the linear equations do not tell its height. Each pose has its mirror image in the
/// plane of the base, as the body is its own mirror image.
#[test]
fn flat_platforms() {
    let mut random = Random(23);
    for round in 0..6 {
        let platform = flat_platform(&mut random);
        let found = complete(&platform);
        assert!(found.len() >= 2, "{round}");
        for pose in &found {
            let image = pose.map(|p| Vector3::new(p.x, p.y, -p.z));
            assert!(found.iter().any(|other| are_near(&image, other)), "{round}");
        }
    }
}

/// A platform of three points on six legs, said by bars alone and by bodies: the search over a construction plan and that over how the body is
/// turned come to the same figures. Bars allow mirror images, which a flat body allows as well.
#[test]
fn a_platform_by_bars_and_by_bodies() {
    let text = std::fs::read_to_string("docs/examples/platform.toml").unwrap();
    let (_, bars) = solved(&text);
    let bodies = "dimension = 3\n[points]\nb1 = [0, 0, 0]\nb2 = [1000, 0, 0]\nb3 = [500, 866, 0]\np1 = [500, -60, 620]\np2 = [830, 480, 600]\n\
        p3 = [190, 470, 640]\n[bodies]\nplatform = { p1 = [0, 0, 0], p2 = [620, 0, 0], p3 = [310, 536.935750346352, 0] }\n[constraints]\n\
        fixed = [[\"b1\"], [\"b2\"], [\"b3\"]]\n\
        distances = [[\"b1\", \"p1\", 800], [\"b2\", \"p1\", 815], [\"b2\", \"p2\", 790], [\"b3\", \"p2\", 785], [\"b3\", \"p3\", 810], [\"b1\", \"p3\", 805]]\n";
    let (_, result) = solved(bodies);
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    assert_eq!(bars.solutions.len(), 4);
    // Without a reference both sides of the base are told apart.
    assert_eq!(result.solutions.len(), 8);
}

/// No leg is long enough, or one too long: nothing, and no search over a body's height goes on for ever.
#[test]
fn platforms_without_a_pose() {
    let mut random = Random(3);
    let mut platform = Platform::random(&mut random);
    platform.legs = [0.05; 6];
    let (_, result) = platform.solved();
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 0)
    );
    platform.legs = [0.5, 0.5, 0.5, 0.5, 0.5, 30.0];
    let (_, result) = platform.solved();
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 0)
    );
}

/// Legs of one length between equal flat plates let the upper one go round: nothing is claimed, in bounded time.
#[test]
fn a_platform_that_moves_is_not_called_complete() {
    let plate: Points = std::array::from_fn(|k| {
        let angle = std::f64::consts::FRAC_PI_3 * k as f64;
        Vector3::new(angle.cos(), angle.sin(), 0.0)
    });
    let platform = Platform::at(
        plate,
        plate,
        UnitQuaternion::identity(),
        Vector3::new(0.3, 0.2, 0.8),
    );
    let options = Options {
        most_boxes: 300_000,
        ..Options::default()
    };
    let problem = Problem::parse(&platform.text([0, 1, 2, 3, 4, 5]), "test.toml").unwrap();
    let result = all(&problem, &options).unwrap();
    assert_ne!(result.status, Status::Complete);
    assert!(!result.undecided.is_empty());
}

/// The answer does not depend on the number of threads.
#[test]
fn threads_change_nothing() {
    let mut random = Random(17);
    let platform = Platform::random(&mut random);
    let problem = Problem::parse(&platform.text([0, 1, 2, 3, 4, 5]), "test.toml").unwrap();
    let with = |threads| {
        let options = Options {
            threads,
            ..Options::default()
        };
        let result = all(&problem, &options).unwrap();
        let boxes: Vec<String> = result
            .solutions
            .iter()
            .map(|s| format!("{:?}", s.points))
            .collect();
        (result.boxes, boxes)
    };
    assert_eq!(with(1), with(3));
}

/// A flat body over a flat base.
fn flat_platform(random: &mut Random) -> Platform {
    let flat = |random: &mut Random, size: f64| -> Points {
        std::array::from_fn(|k| {
            let angle = std::f64::consts::FRAC_PI_3 * (k as f64 + 0.3 * random.next());
            size * Vector3::new(angle.cos(), angle.sin(), 0.0)
        })
    };
    let (base, body) = (flat(random, 1.0), flat(random, 0.6));
    let turn = UnitQuaternion::from_euler_angles(
        0.3 * random.next(),
        0.3 * random.next(),
        0.5 * random.next(),
    );
    let place = Vector3::new(0.2 * random.next(), 0.2 * random.next(), 0.9);
    Platform::at(base, body, turn, place)
}

/// The check proves the sets complete, by looking at all rotations again with models of its own.
#[test]
fn covers_prove_that_there_is_no_other_pose() {
    let mut random = Random(41);
    let mut texts = vec![std::fs::read_to_string("problems/mechanisms/dietmaier.toml").unwrap()];
    texts.push(Platform::random(&mut random).text([0, 1, 2, 3, 4, 5]));
    texts.push(flat_platform(&mut random).text([0, 1, 2, 3, 4, 5]));
    for (k, text) in texts.iter().enumerate() {
        let problem = Problem::parse(text, "test.toml").unwrap();
        let (result, cover) = crate::common::covers::searched(&problem);
        assert_eq!(result.status, Status::Complete);
        assert_eq!(cover.bodies.len(), 1);
        let verdict = verify_cover(&cover.to_bytes()).unwrap();
        println!(
            "{k}: {} parts, {} bytes of marks",
            verdict.parts,
            cover.marks.len()
        );
        assert_eq!(
            (verdict.flaw.as_deref(), verdict.undecided),
            (None, 0),
            "{k}"
        );
        assert_eq!(
            verdict.solutions,
            Some(result.solutions.len() as u64),
            "{k}"
        );
        assert!(verdict.proves_all() && verdict.is_about(&problem), "{k}");
    }
}

#[test]
fn damaged_covers_prove_nothing_false() {
    let mut random = Random(2);
    let platform = Platform::random(&mut random);
    let problem = Problem::parse(&platform.text([0, 1, 2, 3, 4, 5]), "test.toml").unwrap();
    let (_, cover) = crate::common::covers::searched(&problem);
    assert!(cover.figures.len() >= 2);
    let is_refused = |damaged: &CoordinateCover| {
        verify_cover(&damaged.to_bytes()).map_or(true, |verdict| !verdict.proves_all())
    };
    for k in 0..cover.figures.len() {
        let mut damaged = cover.clone();
        damaged.figures.remove(k);
        assert!(is_refused(&damaged), "without solution {k}");
    }
    // A leg that is none, one leg twice, five legs, a body that is none.
    let legs = &cover.bodies[0].legs;
    for other in [
        vec![legs[0], legs[1], legs[2], legs[3], legs[4], 6],
        vec![legs[0], legs[1], legs[2], legs[3], legs[4], legs[4]],
        legs[..5].to_vec(),
        vec![usize::MAX; 6],
    ] {
        let mut damaged = cover.clone();
        damaged.bodies[0].legs = other;
        assert!(is_refused(&damaged));
    }
    let mut damaged = cover.clone();
    damaged.bodies[0].object = 1;
    assert!(is_refused(&damaged));
    // Marks left out, doubled, or exchanged for others: mostly in front, where what follows is lost.
    let other = [
        Turned::Narrowed,
        Turned::Halves(0),
        Turned::Halves(1),
        Turned::Halves(2),
        Turned::Halves(3),
        Turned::Height(0),
        Turned::Height(2),
        Turned::Part,
        Turned::Undecided,
    ];
    let count = cover.marks.len();
    let mut refused = 0;
    for round in 0..7 {
        let at = match round {
            0..5 => round * count / 500,
            _ => ((random.next() * 0.5 + 0.5) * count as f64) as usize % count,
        };
        let mut changed = vec![cover.clone(); 3];
        changed[0].marks.remove(at);
        changed[1].marks.insert(at, cover.marks[at]);
        changed[2].marks.truncate(at);
        let mark = other[round % other.len()];
        let mut bytes = Vec::new();
        mark.put(&mut bytes);
        let mut exchanged = cover.clone();
        exchanged.marks[at] = bytes[0];
        changed.push(exchanged);
        for damaged in &changed {
            // What it may still prove: the truth, or less.
            let verdict = verify_cover(&damaged.to_bytes()).ok();
            match verdict.filter(|verdict| verdict.proves_all()) {
                Some(verdict) => {
                    let listed = cover.figures.len() as u64;
                    assert_eq!(verdict.solutions, Some(listed), "{round}, at {at}");
                }
                None => refused += 1,
            }
        }
    }
    assert!(refused > 12, "{refused}");
}
