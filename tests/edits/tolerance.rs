//! Dimensions within limits: against a great many choices of them, and against closed forms.

use crate::common::random::Dice;
use crate::common::third;
use krawl::edit::Limits;
use krawl::problem::{Decimal, Problem};
use krawl::tolerance::{Study, limits, study};
use krawl::track::{Control, Options};

fn decimal(x: f64) -> Decimal {
    format!("{x}").parse().unwrap()
}

fn run(problem: &Problem, within: &[Limits], asked: &[&str]) -> Result<Study, String> {
    let asked: Vec<String> = asked.iter().map(|&text| text.to_owned()).collect();
    study(
        problem,
        within,
        &asked,
        &Options::certified(),
        &mut Control::default(),
    )
}

/// The plate of docs/examples: A-B, B-C, C-D, D-E, E-A, A-C, B-E.
fn plate(d: &[f64; 7]) -> [[f64; 2]; 5] {
    let (a, b) = ([0.0, 0.0], [d[0], 0.0]);
    let c = third(a, b, d[5], d[1]);
    let e = third(a, b, d[4], d[6]);
    [a, b, c, third(e, c, d[3], d[2]), e]
}

fn length(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

#[test]
fn samples_lie_within_the_worst_cases_and_come_near_them() {
    let problem = Problem::read("docs/examples/plate.toml").unwrap();
    let nominal = [90.0, 40.0, 49.5, 57.0, 60.0, 98.5, 108.2];
    // D is on the far side of C-E from A.
    let far = plate(&nominal);
    assert!((length(far[0], far[3]) - 92.9466).abs() < 1e-3, "{far:?}");
    let mut dice = Dice(11);
    for tolerance in [1.0, 0.2, 0.05, 0.001] {
        let all = limits(
            &problem,
            &[],
            Some(&[decimal(-tolerance), decimal(tolerance)]),
        )
        .unwrap();
        assert_eq!(all.len(), 7);
        let found = run(
            &problem,
            &all,
            &["A-D", "C-E", "angle B C D", "area A B C D E"],
        )
        .unwrap();
        let value = |figure: &[[f64; 2]; 5], k: usize| match k {
            0 => length(figure[0], figure[3]),
            1 => length(figure[2], figure[4]),
            2 => {
                let [_, b, c, d, _] = *figure;
                let (u, v) = ([b[0] - c[0], b[1] - c[1]], [d[0] - c[0], d[1] - c[1]]);
                (u[0] * v[1] - u[1] * v[0])
                    .abs()
                    .atan2(u[0] * v[0] + u[1] * v[1])
                    .to_degrees()
            }
            _ => {
                let twice: f64 = (0..5)
                    .map(|k| {
                        let (p, q) = (figure[k], figure[(k + 1) % 5]);
                        p[0] * q[1] - p[1] * q[0]
                    })
                    .sum();
                0.5 * twice.abs()
            }
        };
        let mut seen = [[f64::MAX, f64::MIN]; 4];
        for round in 0..20_000 {
            let dimensions: [f64; 7] = std::array::from_fn(|k| {
                // Every other choice is a corner.
                let part = if round % 2 == 0 {
                    dice.uniform().round()
                } else {
                    dice.uniform()
                };
                nominal[k] + tolerance * (2.0 * part - 1.0)
            });
            let figure = plate(&dimensions);
            for (k, seen) in seen.iter_mut().enumerate() {
                let x = value(&figure, k);
                *seen = [seen[0].min(x), seen[1].max(x)];
            }
        }
        for (k, (measured, seen)) in found.measured.iter().zip(seen).enumerate() {
            let [low, high] = measured.bounds;
            let slack = 1e-9 * seen[1].abs();
            assert!(
                low.inf() <= seen[0] + slack && high.sup() >= seen[1] - slack,
                "{measured:?} {seen:?}"
            );
            // The inner ends are attained, where it is said.
            for (corner, inner) in measured.corners.iter().zip([low.sup(), high.inf()]) {
                let at: Vec<f64> = corner.iter().map(Decimal::to_f64).collect();
                let at: [f64; 7] = at.try_into().unwrap();
                assert!(
                    at.iter()
                        .zip(nominal)
                        .all(|(x, y)| (x - y).abs() <= tolerance + 1e-12)
                );
                assert!(
                    (value(&plate(&at), k) - inner).abs() <= slack,
                    "{measured:?}"
                );
            }
            let gap = low.wid().max(high.wid()) / (high.sup() - low.inf());
            assert!(gap < 0.01, "{measured:?}");
        }
    }
}

#[test]
fn a_stack_of_plates_adds_up() {
    // Four plates on each other: lengths along one line, which add up exactly.
    let mut text = "dimension = 2\n[points]\nO = [0, 0]\n".to_owned();
    for k in 1..=4 {
        text += &format!("P{k} = [{}, 0]\n", 10 * k);
    }
    text += "[constraints]\nfixed = [\"O\"]\ny = [[\"P1\", 0], [\"P2\", 0], [\"P3\", 0], [\"P4\", 0]]\n\
             dx = [[\"O\", \"P1\", 10], [\"P1\", \"P2\", 10], [\"P2\", \"P3\", 10], [\"P3\", \"P4\", 10]]\n\
             [tolerances]\n\"dx:O-P1\" = 0.1\n\"dx:P1-P2\" = [\"+0.2\", \"-0.1\"]\n\"dx:P2-P3\" = 0.1\n\"dx:P3-P4\" = 0.2\n";
    let problem = Problem::parse(&text, "stack.toml").unwrap();
    let all = limits(&problem, &[], None).unwrap();
    assert_eq!(all.len(), 4);
    let found = run(&problem, &all, &["O-P4", "x P3"]).unwrap();
    let [low, high] = found.measured[0].bounds;
    assert!(
        low.contains(39.5) && high.contains(40.6) && low.wid() < 1e-9 && high.wid() < 1e-9,
        "{:?}",
        found.measured[0]
    );
    let squares: f64 = [0.1f64, 0.15, 0.1, 0.2].iter().map(|x| x * x).sum();
    assert!((found.measured[0].root_of_squares.unwrap() - squares.sqrt()).abs() < 1e-9);
    let [low, high] = found.measured[1].bounds;
    assert!(
        low.contains(29.7) && high.contains(30.4),
        "{:?}",
        found.measured[1]
    );
}

/// Two sides and the angle between them, each with limits or without, against the law of cosines: what has no limits stays what it is,
/// also where its equation could be written with the lengths of both sides.
#[test]
fn angles_stay_what_they_are_or_within_their_limits() {
    let at_points = "angles = [[\"b\", \"a\", \"c\", 80]]\n";
    let of_lines =
        "angles = [[\"l\", \"m\", 80]]\n[lines]\nl = [\"a\", \"b\"]\nm = [\"a\", \"c\"]\n";
    let leg = |k: usize, low: f64, high: f64| Limits {
        index: k,
        values: [decimal(low), decimal(high)],
    };
    let sides = [leg(0, 3.96, 4.04), leg(1, 2.98, 3.02)];
    let angle = leg(2, 79.8, 80.2);
    let opposite = |[b, c, degrees]: [f64; 3]| {
        (b * b + c * c - 2.0 * b * c * degrees.to_radians().cos()).sqrt()
    };
    for angles in [at_points, of_lines] {
        let text = format!(
            "name = \"two sides\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0.5, 3]\n[constraints]\n\
             distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3]]\n{angles}"
        );
        let problem = Problem::parse(&text, "two.toml").unwrap();
        for within in [
            vec![sides[0].clone()],
            sides.to_vec(),
            vec![angle.clone()],
            vec![sides[0].clone(), sides[1].clone(), angle.clone()],
        ] {
            let study = run(&problem, &within, &["b-c", "angle b a c"]).unwrap();
            let ends = |k: usize, given: f64| {
                let limits = within.iter().find(|one| one.index == k);
                limits.map_or([given; 2], |one| one.values.each_ref().map(Decimal::to_f64))
            };
            let [b, c, degrees] = [ends(0, 4.0), ends(1, 3.0), ends(2, 80.0)];
            let steps = |[low, high]: [f64; 2]| {
                (0..=4).map(move |k| low + f64::from(k) * (high - low) / 4.0)
            };
            let [length, turn] = &study.measured[..] else {
                panic!()
            };
            let (mut least, mut most) = (f64::INFINITY, 0.0f64);
            for b in steps(b) {
                for c in steps(c) {
                    for degrees in steps(degrees) {
                        let found = opposite([b, c, degrees]);
                        (least, most) = (least.min(found), most.max(found));
                    }
                }
            }
            // Of lines it is not seen that it is the constraint's angle: bounds are of second order then.
            let more = if angles == at_points { 1e-9 } else { 0.15 };
            let outer = |of: &[krawl::interval::Interval; 2]| [of[0].inf(), of[1].sup()];
            let [low, high] = outer(&length.bounds);
            assert!(low <= least && most <= high, "{low} {least} {most} {high}");
            assert!(
                (high - low) < 1.05 * (most - least),
                "{low} {least} {most} {high}"
            );
            let [low, high] = outer(&turn.bounds);
            assert!(low <= degrees[0] && degrees[1] <= high, "{low} {high}");
            assert!(high - low < degrees[1] - degrees[0] + more, "{low} {high}");
        }
    }
    let text = "name = \"far\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [-3, 0.1]\n[constraints]\n\
                distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3]]\nangles = [[\"b\", \"a\", \"c\", 178]]\n";
    let problem = Problem::parse(text, "far.toml").unwrap();
    let wrong = run(&problem, &[leg(2, 176.0, 180.0)], &["b-c"]).unwrap_err();
    assert!(wrong.contains("between 0 and 180 degrees"), "{wrong}");
}

/// Turns and torsions without limits stay what they are, as many whole turns away as they are measured.
#[test]
fn turns_and_torsions_stay_what_they_are() {
    let plane = "name = \"turn\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0.5, 3]\n[constraints]\n\
                 distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3]]\nturns = [[\"b\", \"a\", \"c\", 440]]\n";
    let space = "name = \"torsion\"\ndimension = 3\n[points]\na = [0, 0, 0]\nb = [1.5, 0, 0]\nc = [2.1, 1.4, 0]\nd = [3, 1.6, 1]\n\
                 [constraints]\ndistances = [[\"a\", \"b\", 1.5], [\"b\", \"c\", 1.5], [\"c\", \"d\", 1.5]]\n\
                 angles = [[\"a\", \"b\", \"c\", 110], [\"b\", \"c\", \"d\", 110]]\n\
                 torsions = [[\"a\", \"b\", \"c\", \"d\", 270]]\n";
    for (text, measure, value) in [
        (plane, "turn b a c", 80.0),
        (space, "torsion a b c d", -90.0),
        (space, "torsion d c b a", -90.0),
        (space, "angle c b a", 110.0),
    ] {
        let problem = Problem::parse(text, "stays.toml").unwrap();
        let length = if text == plane { 3.0 } else { 1.5 };
        let within = Limits {
            index: 1,
            values: [decimal(length - 0.01), decimal(length + 0.01)],
        };
        let study = run(&problem, &[within], &[measure]).unwrap();
        let measured = &study.measured[0];
        assert!(measured.is_given, "{measure}");
        for bound in measured.bounds {
            assert!((bound.mid() - value).abs() < 1e-9, "{measure}: {bound:?}");
        }
        assert!(measured.effects.iter().all(|&effect| effect == 0.0));
    }
}

/// Cosine and sine of a turn go together: across where one of them turns back, too. And of a chain in space.
#[test]
fn turns_and_torsions_have_limits() {
    let mut dice = Dice(11);
    for (turn, low, high) in [
        (440.0, 438.5, 441.0),
        (-2.0, -5.0, 4.0),
        (91.0, 86.0, 97.0),
        (30.0, 20.0, 50.0),
    ] {
        let at: f64 = f64::to_radians(turn);
        let [x, y] = [3.0 * at.cos() + 0.1, 3.0 * at.sin() - 0.05];
        let text = format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [{x}, {y}]\nd = [{}, {y}]\n[constraints]\nfixed = [\"a\", \"b\"]\n\
             distances = [[\"a\", \"c\", \"3 ± 0.1\"]]\nturns = [[\"b\", \"a\", \"c\", \"{turn} {:+} {:+}\"]]\n\
             dx = [[\"c\", \"d\", 1]]\ndy = [[\"c\", \"d\", 0]]\n",
            x + 1.0,
            low - turn,
            high - turn
        );
        let problem = Problem::parse(&text, "turn.toml").unwrap();
        let within = limits(&problem, &[], None).unwrap();
        let asked = ["x c", "y c", "b-d", "turn b a c"];
        let study = run(&problem, &within, &asked).unwrap();
        let value = |length: f64, turn: f64| {
            let (y, x) = turn.to_radians().sin_cos();
            let (x, y) = (length * x, length * y);
            [
                x,
                y,
                (x + 1.0 - 4.0).hypot(y),
                turn - 360.0 * (turn / 360.0).round(),
            ]
        };
        let (mut least, mut greatest) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for round in 0..20_000 {
            let mut part = || match round % 3 {
                0 => dice.uniform().round(),
                _ => dice.uniform(),
            };
            let value = value(2.9 + 0.2 * part(), low + (high - low) * part());
            for ((x, least), greatest) in value.iter().zip(&mut least).zip(&mut greatest) {
                (*least, *greatest) = (least.min(*x), greatest.max(*x));
            }
        }
        for (k, measured) in study.measured.iter().enumerate() {
            let [low, high] = measured.bounds;
            let wide = greatest[k] - least[k];
            let what = || format!("{turn} {measured:?} {} {}", least[k], greatest[k]);
            assert!(
                low.inf() <= least[k] + 1e-9 && greatest[k] - 1e-9 <= high.sup(),
                "{}",
                what()
            );
            let gap = (least[k] - low.inf()).max(high.sup() - greatest[k]);
            assert!(gap < 0.02 * wide, "{}", what());
            for (corner, inner) in measured.corners.iter().zip([low.sup(), high.inf()]) {
                if let [length, turn] = &corner[..] {
                    let there = value(length.to_f64(), turn.to_f64())[k];
                    assert!((there - inner).abs() < 1e-8, "{}", what());
                }
            }
        }
        let effects = |k: usize| study.measured[k].effects.clone();
        let slope = |k: usize| {
            let [ahead, back] = [1e-4, -1e-4].map(|by| value(3.0, turn + by)[k]);
            (ahead - back) / 2e-4 * (high - low)
        };
        assert!((0..3).all(|k| (effects(k)[1] - slope(k)).abs() < 1e-3 * (high - low)));
    }
    let chain = "dimension = 3\n[points]\na = [0, 0, 0]\nb = [1.5, 0, 0]\nc = [2.1, 1.4, 0]\nd = [3, 1.6, 1]\n\
                 [constraints]\ndistances = [[\"a\", \"b\", 1.5], [\"b\", \"c\", 1.5], [\"c\", \"d\", 1.5]]\n\
                 angles = [[\"a\", \"b\", \"c\", 110], [\"b\", \"c\", \"d\", 110]]\n\
                 torsions = [[\"a\", \"b\", \"c\", \"d\", [-75, -65]]]\n";
    let problem = Problem::parse(chain, "chain.toml").unwrap();
    let within = limits(&problem, &[], None).unwrap();
    let study = run(&problem, &within, &["a-d", "torsion a b c d"]).unwrap();
    // Of four points with equal bonds and angles.
    let far = |torsion: f64| {
        let (along, beside) = (
            1.5 * (2.0 * 70f64.to_radians().cos() + 1.0),
            1.5 * 70f64.to_radians().sin(),
        );
        let half = (0.5 * torsion.to_radians()).sin();
        along.hypot(2.0 * beside * half)
    };
    let [low, high] = study.measured[0].bounds;
    assert!(
        low.contains(far(65.0)) && high.contains(far(75.0)),
        "{low:?} {high:?}"
    );
    assert!(low.wid() + high.wid() < 1e-3, "{low:?} {high:?}");
    let [low, high] = study.measured[1].bounds;
    assert!(
        low.contains(-75.0) && high.contains(-65.0),
        "{low:?} {high:?}"
    );
    let wide = chain.replace("[-75, -65]", "[-150, 30]");
    let problem = Problem::parse(&wide, "chain.toml").unwrap();
    let within = limits(&problem, &[], None).unwrap();
    let error = run(&problem, &within, &["a-d"]).unwrap_err();
    assert!(error.contains("180 degrees apart or more"), "{error}");
}

/// Where nothing is asked for, and constraints say where the figure is, the ends of its edges are measured, but for those that stay.
#[test]
fn ends_of_edges_are_measured() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [2, 1]\n[lines]\nbase = [\"a\", \"b\"]\nside = [\"b\", \"c\"]\n\
                [constraints]\nfixed = [\"a\"]\nhorizontal = [\"base\"]\nvertical = [\"side\"]\ndx = [[\"a\", \"b\", \"4 ± 0.25\"], [\"a\", \"d\", 2]]\n\
                dy = [[\"b\", \"c\", [2.5, 3.5]], [\"a\", \"d\", 1]]\n";
    let problem = Problem::parse(text, "edges.toml").unwrap();
    let within = limits(&problem, &[], None).unwrap();
    let study = run(&problem, &within, &[]).unwrap();
    let found = study.measured.iter().map(|measured| {
        let [low, high] = measured.bounds;
        assert!(low.wid() + high.wid() < 1e-9);
        (measured.name.as_str(), low.mid(), high.mid())
    });
    for (found, wanted) in found.zip([
        ("x b", 3.75, 4.25),
        ("y b", 0.0, 0.0),
        ("x c", 3.75, 4.25),
        ("y c", 2.5, 3.5),
    ]) {
        let is_it =
            found.0 == wanted.0 && (found.1 - wanted.1).abs() + (found.2 - wanted.2).abs() < 1e-9;
        assert!(is_it, "{found:?} {wanted:?}");
    }
    assert_eq!(study.measured.len(), 4);
}

/// Of a length given by its square: the length's limits, or with the number those of the square.
#[test]
fn squares_have_limits() {
    let of = |square: &str, rest: &str| {
        let text = format!(
            "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [0, 3]\n[constraints]\n\
             distances = [[\"a\", \"b\", 4], [\"a\", \"c\", 3]]\nsquared_distances = [[\"b\", \"c\", {square}]]\n{rest}"
        );
        Problem::parse(&text, "square.toml").unwrap()
    };
    let angle = |length: f64| ((25.0 - length * length) / 24.0).acos().to_degrees();
    let (root, by) = (20f64.sqrt(), 0.1);
    for (square, rest, low, high) in [
        (
            "20",
            "[tolerances]\ndefault = 0.1\n\"a-b\" = 0\n\"a-c\" = 0\n",
            root - by,
            root + by,
        ),
        ("[19, 21]", "", 19f64.sqrt(), 21f64.sqrt()),
    ] {
        let problem = of(square, rest);
        let within = limits(&problem, &[], None).unwrap();
        let study = run(&problem, &within, &["angle b a c", "b-c"]).unwrap();
        for (bound, length) in study.measured[0].bounds.into_iter().zip([low, high]) {
            let is_there = (bound.mid() - angle(length)).abs() < 1e-3;
            assert!(is_there && bound.wid() < 1e-3, "{bound:?} {length}");
        }
        let [least, greatest] = study.measured[1].bounds;
        assert!(
            least.inf() <= low && high <= greatest.sup(),
            "{least:?} {greatest:?}"
        );
        assert!(least.inf() > low - 1e-12 && greatest.sup() < high + 1e-12);
    }
    let problem = of("20", "[tolerances]\nb-c = [0.1, 0.2]\n");
    let within = limits(&problem, &[], None).unwrap();
    let error = run(&problem, &within, &["b-c"]).unwrap_err();
    assert!(error.contains("given by its square"), "{error}");
}

#[test]
fn what_is_not_proved_or_makes_no_sense_is_said() {
    let problem = Problem::read("docs/examples/plate.toml").unwrap();
    // Where C, D and E are in line the plate comes to an end.
    let [_, _, c, _, e] = plate(&[77.593702509893, 40.0, 49.5, 57.0, 60.0, 98.5, 108.2]);
    assert!((length(c, e) - 49.5 - 57.0).abs() < 1e-9);
    let of = |name: &str, low: &str, high: &str| {
        limits(
            &problem,
            &[(name.to_owned(), [low, high].map(|x| x.parse().unwrap()))],
            None,
        )
    };
    for (within, asked, why) in [
        (
            of("A-B", "-30", "30").unwrap(),
            "A-D",
            "led towards A-B = 60, it turns back at A-B = 77.5937",
        ),
        (
            of("A-B", "-95", "0").unwrap(),
            "A-D",
            "a length or ratio must be greater than 0",
        ),
        (Vec::new(), "A-D", "no dimension has a tolerance"),
        (of("A-B", "-0.1", "0.1").unwrap(), "x D", "fix points"),
        (of("A-B", "-0.1", "0.1").unwrap(), "A-Q", "--measure"),
    ] {
        let error = run(&problem, &within, &[asked]).unwrap_err();
        assert!(error.contains(why), "{error}");
    }
    assert!(of("A-Q", "-1", "1").unwrap_err().contains("no dimension"));
}

/// A point that may come to stand on another one: the length is never less than 0, and the angle has no meaning.
#[test]
fn points_that_may_come_together_are_told() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\nc = [0.01, 0]\n[constraints]\nfixed = [\"a\", \"b\"]\n\
                x = [[\"c\", 0.01]]\ny = [[\"c\", 0]]\n[tolerances]\n\"x:c\" = 0.02\n";
    let problem = Problem::parse(text, "near.toml").unwrap();
    let all = limits(&problem, &[], None).unwrap();
    let found = run(&problem, &all, &["a-c"]).unwrap();
    let [low, high] = found.measured[0].bounds;
    assert!(low.inf() == 0.0 && high.contains(0.03), "{low:?} {high:?}");
    let error = run(&problem, &all, &["angle b a c"]).unwrap_err();
    assert!(error.contains("may come together"), "{error}");
}

/// Two bars almost in line, which come in line within their limits: there the angle between them and the area turn back. What is said to first order
/// is of the nominal figure, where they do not.
#[test]
fn effects_are_those_of_the_nominal_figure() {
    let nominal = [4.0, 4.0, 4.0, 5.657, 5.6];
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [4, 0]\nC = [8, 0.01]\nD = [4, 4]\n[constraints]\n\
                distances = [[\"A\", \"B\", 4], [\"B\", \"C\", 4], [\"B\", \"D\", 4], [\"A\", \"D\", 5.657], [\"C\", \"D\", 5.6]]\n";
    let problem = Problem::parse(text, "near.toml").unwrap();
    // Twice the area of A, B, C, and the angle at B, by the dimensions.
    let value = |d: [f64; 5]| -> [f64; 2] {
        let (a, b) = ([0.0, 0.0], [d[0], 0.0]);
        let at = third(a, b, d[3], d[2]);
        let c = third(at, b, d[4], d[1]);
        let (u, v) = ([-b[0], 0.0], [c[0] - b[0], c[1]]);
        let (cross, dot) = (u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
        [0.5 * cross.abs(), cross.abs().atan2(dot).to_degrees()]
    };
    for tolerance in [0.05, 0.005, 0.0001] {
        let all = limits(
            &problem,
            &[],
            Some(&[decimal(-tolerance), decimal(tolerance)]),
        )
        .unwrap();
        let found = run(&problem, &all, &["area A B C", "angle A B C", "turn A B C"]).unwrap();
        let [area, angle, turn] = &found.measured[..] else {
            panic!("three are measured");
        };
        for (k, measured) in [area, angle].into_iter().enumerate() {
            assert!((measured.nominal.mid() - value(nominal)[k]).abs() < 1e-9);
            let mut squares = 0.0;
            for (i, effect) in measured.effects.iter().enumerate() {
                let by = |h: f64| {
                    let mut d = nominal;
                    d[i] += h;
                    value(d)[k]
                };
                let slope = (by(1e-5) - by(-1e-5)) / 2e-5;
                let right = 2.0 * tolerance * slope;
                assert!(
                    (effect - right).abs() < 1e-3 * right.abs(),
                    "{i}: {effect} {right}"
                );
                squares += (0.5 * right).powi(2);
            }
            let root = measured.root_of_squares.unwrap();
            assert!((root - squares.sqrt()).abs() < 1e-3 * root);
            // What is nominal can be.
            let [low, high] = measured.bounds;
            let slack = 1e-9 * measured.nominal.mag();
            assert!(
                low.sup() <= measured.nominal.sup() && high.inf() >= measured.nominal.inf() - slack
            );
        }
        let both = angle.effects.iter().zip(&turn.effects);
        assert!(
            both.into_iter()
                .all(|(a, b)| (a.abs() - b.abs()).abs() < 1e-6 * a.abs())
        );
    }
    // As flat as can be it has no first order, and that is said.
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [4, 0]\nC = [8, 0]\nD = [4, 3]\n[constraints]\n\
                distances = [[\"A\", \"B\", 4], [\"B\", \"C\", 4], [\"B\", \"D\", 3], [\"A\", \"D\", 5], [\"C\", \"D\", 5]]\n";
    let problem = Problem::parse(text, "flat.toml").unwrap();
    let all = limits(&problem, &[], Some(&[decimal(-0.01), decimal(0.01)])).unwrap();
    let found = run(&problem, &all, &["angle A B C", "area A B C", "A-C"]).unwrap();
    let [angle, area, length] = &found.measured[..] else {
        panic!("three are measured");
    };
    for flat in [angle, area] {
        assert!(
            flat.root_of_squares.is_none() && flat.effects.is_empty(),
            "{flat:?}"
        );
    }
    assert!(length.root_of_squares.is_some_and(|root| root > 0.005));
    let text = krawl::report::tolerances_to_table(&problem, &found);
    assert!(
        text.contains("nothing to first order, as it is at an end"),
        "{text}"
    );
    assert!(!text.contains("squares ±0\n"), "{text}");
}

/// By how much a range may be too wide is said of the range, not of one end: a wide triangle, whose angle is least and greatest at corners.
#[test]
fn how_much_too_wide_a_range_may_be_is_right() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [10, 0]\nC = [5, 0.5]\n[constraints]\n\
                distances = [[\"A\", \"B\", 10], [\"A\", \"C\", 5.03], [\"B\", \"C\", 5.02]]\n";
    let problem = Problem::parse(text, "wide.toml").unwrap();
    let angle = |c: f64, b: f64, a: f64| {
        ((a * a + b * b - c * c) / (2.0 * a * b))
            .acos()
            .to_degrees()
    };
    for tolerance in [0.001, 0.002, 0.005, 0.0072] {
        let all = limits(
            &problem,
            &[],
            Some(&[decimal(-tolerance), decimal(tolerance)]),
        )
        .unwrap();
        let found = run(&problem, &all, &["angle A C B"]).unwrap();
        let at = |sign: f64| {
            let e = sign * tolerance;
            angle(10.0 + e, 5.03 - e, 5.02 - e)
        };
        let right = at(1.0) - at(-1.0);
        let text = krawl::report::tolerances_to_table(&problem, &found);
        let after = |word: &str| -> f64 {
            let (_, behind) = text.split_once(word).unwrap_or_else(|| panic!("{text}"));
            let number = behind.split([' ', ',']).next().unwrap();
            number.parse().unwrap()
        };
        let (low, high) = (after("at worst from "), after(" to "));
        assert!(low <= at(-1.0) && high >= at(1.0));
        let percent = after("no wider by more than ");
        let too_wide = 100.0 * (1.0 - right / (high - low));
        assert!(
            too_wide <= percent && percent < 3.0 * too_wide + 1.0,
            "{too_wide} {percent}"
        );
    }
}

/// A crank that goes through most of its turn, which one test is too few for, against many positions of it.
#[test]
fn wide_limits_are_cut() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nD = [5, 0]\nB = [0, 2]\nC = [3.9, 3.6]\n[constraints]\n\
                fixed = [\"A\", \"D\"]\ndistances = [[\"A\", \"B\", 2], [\"B\", \"C\", 4.2], [\"C\", \"D\", 3.8]]\n\
                angles = [[\"D\", \"A\", \"B\", 90]]\n";
    let problem = Problem::parse(text, "four-bar.toml").unwrap();
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (b, d) = ([2.0 * cos, 2.0 * sin], [5.0, 0.0]);
        third(b, d, 4.2, 3.8)
    };
    assert!((at(90.0)[1] - 3.6).abs() < 0.1, "{:?}", at(90.0));
    for (from, to) in [(80.0, 100.0), (30.0, 150.0), (10.0, 170.0), (95.0, 120.0)] {
        let within = [Limits {
            index: 3,
            values: [decimal(from), decimal(to)],
        }];
        let found = run(&problem, &within, &["x C", "y C"]).unwrap();
        for (k, measured) in found.measured.iter().enumerate() {
            let all = (0..=2000).map(|n| at(from + (to - from) * f64::from(n) / 2000.0)[k]);
            let (least, most) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
            let [low, high] = measured.bounds;
            assert!(
                low.inf() <= least + 1e-9 && high.sup() >= most - 1e-9,
                "{measured:?}"
            );
            assert!(
                low.sup() >= least - 1e-5 && high.inf() <= most + 1e-5,
                "{measured:?}"
            );
            let gap = low.wid().max(high.wid()) / (high.sup() - low.inf());
            assert!(gap < 0.01, "{measured:?}");
        }
    }
    // Beyond, the crank and the rod come in line.
    let within = [Limits {
        index: 3,
        values: [decimal(90.0), decimal(130.0)],
    }];
    let long = Problem::parse(
        &text
            .replace("2], [\"B\"", "2.0], [\"B\"")
            .replace("3.8]", "1.9]")
            .replace("[3.9, 3.6]", "[4, 1.6]"),
        "long.toml",
    )
    .unwrap();
    let error = run(&long, &within, &["x C"]).unwrap_err();
    // |B - D|² = 29 - 20 cos.
    let limit = ((29.0 - 6.1f64.powi(2)) / 20.0).acos().to_degrees();
    assert!(
        error.contains(&format!("it turns back at angles:D-A-B = {limit:.4}")),
        "{error} {limit}"
    );
}

/// A long strip of triangles, in which what small tolerances do adds up, against figures with random dimensions and those of the corners.
#[test]
fn a_long_strip_is_bounded() {
    let mut dice = Dice(5);
    let count = 24usize;
    let places: Vec<[f64; 2]> = (0..count)
        .map(|k| {
            [
                5.0 * k as f64 + dice.uniform(),
                8.0 * (k % 2) as f64 + dice.uniform(),
            ]
        })
        .collect();
    let bars: Vec<[usize; 2]> = (1..count)
        .map(|k| [k - 1, k])
        .chain((2..count).map(|k| [k - 2, k]))
        .collect();
    let nominal: Vec<f64> = bars
        .iter()
        .map(|&[a, b]| (1000.0 * length(places[a], places[b])).round() / 1000.0)
        .collect();
    let mut text = "dimension = 2\n[points]\n".to_owned();
    for (k, p) in places.iter().enumerate() {
        text += &format!("p{k} = [{:.6}, {:.6}]\n", p[0], p[1]);
    }
    let all = bars
        .iter()
        .zip(&nominal)
        .map(|([a, b], d)| format!("[\"p{a}\", \"p{b}\", {d}]"));
    text += &format!(
        "[constraints]\ndistances = [{}]\n",
        all.collect::<Vec<_>>().join(", ")
    );
    let problem = Problem::parse(&text, "strip.toml").unwrap();
    let figure = |d: &[f64]| {
        let of = |a: usize, b: usize| d[bars.iter().position(|bar| *bar == [a, b]).unwrap()];
        let mut points = vec![[0.0, 0.0], [of(0, 1), 0.0]];
        for k in 2..count {
            let (p, q) = (points[k - 2], points[k - 1]);
            // On the side on which it is drawn.
            let drawn = |a: usize, b: usize, c: usize| {
                let (u, v) = (
                    [places[b][0] - places[a][0], places[b][1] - places[a][1]],
                    [places[c][0] - places[a][0], places[c][1] - places[a][1]],
                );
                u[0] * v[1] - u[1] * v[0]
            };
            points.push(match drawn(k - 2, k - 1, k) > 0.0 {
                true => third(p, q, of(k - 2, k), of(k - 1, k)),
                false => third(q, p, of(k - 1, k), of(k - 2, k)),
            });
        }
        points
    };
    for tolerance in [0.001, 0.005] {
        let within = limits(
            &problem,
            &[],
            Some(&[decimal(-tolerance), decimal(tolerance)]),
        )
        .unwrap();
        let found = run(&problem, &within, &["p0-p23", "angle p0 p12 p23"]).unwrap();
        let value = |d: &[f64]| {
            let points = figure(d);
            let (u, v) = [0, 23]
                .map(|k| [points[k][0] - points[12][0], points[k][1] - points[12][1]])
                .into();
            let cross: f64 = u[0] * v[1] - u[1] * v[0];
            [
                length(points[0], points[23]),
                cross.abs().atan2(u[0] * v[0] + u[1] * v[1]).to_degrees(),
            ]
        };
        for round in 0..4000 {
            let d: Vec<f64> = nominal
                .iter()
                .map(|x| {
                    let part = dice.uniform();
                    x + tolerance * (2.0 * if round % 2 == 0 { part.round() } else { part } - 1.0)
                })
                .collect();
            for (measured, x) in found.measured.iter().zip(value(&d)) {
                assert!(
                    measured.bounds[0].inf() <= x + 1e-9 && x <= measured.bounds[1].sup() + 1e-9,
                    "{measured:?} {x}"
                );
            }
        }
        for (k, measured) in found.measured.iter().enumerate() {
            let [low, high] = measured.bounds;
            for (corner, inner) in measured.corners.iter().zip([low.sup(), high.inf()]) {
                let at: Vec<f64> = corner.iter().map(Decimal::to_f64).collect();
                assert!(
                    (value(&at)[k] - inner).abs() < 1e-8,
                    "{measured:?} {:?}",
                    value(&at)
                );
            }
            assert!(
                (low.wid() + high.wid()) < 0.1 * (high.sup() - low.inf()),
                "{measured:?}"
            );
        }
    }
}

/// Near a figure that hardly is one Newton's method goes astray: that is said, without a panic.
#[test]
fn where_newtons_method_goes_astray_nothing_is_proved() {
    let text = "name = \"t\"\ndimension = 2\n[points]\nA = [-0.1741, -0.2296]\nB = [0.2234, -3.8806]\nC = [0.0698, -2.4699]\n\
                D = [-3.4628, 1.794]\nE = [0.5527, 2.6796]\nF = [-1.0723, -0.8131]\nG = [2.8842, 1.7571]\n[constraints]\n\
                fixed = [\"A\"]\ndistances = [[\"A\", \"B\", 3.6726], [\"C\", \"D\", 5.5372], [\"A\", \"D\", 3.8614], [\"E\", \"F\", 3.8522]]\n\
                y = [[\"B\", -3.8806], [\"E\", 2.6796], [\"G\", 1.7571]]\non = [[\"C\", \"A\", \"B\"]]\ndx = [[\"A\", \"C\", 0.2439]]\n\
                angles = [[\"E\", \"D\", \"A\", 44.04]]\nperpendicular = [[\"A\", \"F\", \"D\", \"B\"], [\"A\", \"G\", \"D\", \"B\"]]\n";
    let problem = Problem::parse(text, "astray.toml").unwrap();
    let by = [
        ("A-B", "-0.05791", "0.05791"),
        ("y:B", "-0.04820", "0.04820"),
        ("dx:A-C", "-0.01656", "-0.00497"),
        ("C-D", "-0.09552", "0.09552"),
        ("angles:E-D-A", "-2.42327", "2.42327"),
        ("E-F", "-0.10809", "0.10809"),
        ("y:E", "-0.03551", "0.05212"),
    ];
    let by = by.map(|(name, low, high)| (name.to_owned(), [low, high].map(|x| x.parse().unwrap())));
    let within = limits(&problem, &by, None).unwrap();
    let error = run(&problem, &within, &["D-B"]).unwrap_err();
    assert!(error.contains("within the limits"), "{error}");
}

/// Two bars in line by their numbers, but for a rounding: how the area and the angle between them change has no sign there, so nothing is said of it.
#[test]
fn what_is_flat_has_no_first_order() {
    let text = "name = \"flat\"\ndimension = 2\n[points]\nA = [-0.86, 0.383]\nC = [5.669, 3.6839]\nM = [5.1228, 3.4078]\n[constraints]\n\
                fixed = [\"A\"]\ndistances = [[\"A\", \"C\", 7.316], [\"A\", \"M\", 6.704]]\n\
                angles = [[\"x-axis\", \"A\", \"C\", 26.82], [\"x-axis\", \"A\", \"M\", 26.82]]\n";
    let problem = Problem::parse(text, "flat.toml").unwrap();
    let by = [("angles:x-axis-A-C", "1"), ("A-C", "0.01")];
    let by = by.map(|(name, up)| {
        let up: Decimal = up.parse().unwrap();
        (name.to_owned(), [up.negative(), up])
    });
    let within = limits(&problem, &by, None).unwrap();
    let found = run(&problem, &within, &["area A M C", "angle M A C", "A-M"]).unwrap();
    let most = 0.5 * 6.704 * 7.326 * 1f64.to_radians().sin();
    assert!(found.measured[0].bounds[1].contains(most));
    for flat in &found.measured[..2] {
        assert_eq!(
            (flat.root_of_squares, flat.effects.len()),
            (None, 0),
            "{flat:?}"
        );
    }
    assert_eq!(found.measured[2].root_of_squares, Some(0.0));
}
