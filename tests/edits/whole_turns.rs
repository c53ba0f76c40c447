//! Angles with a sense of turn, which go all the way round: compared with circles that meet, computed in floats.

use krawl::complete::{Status, all};
use krawl::edit::{Asked, End, Ending, Session, Setting, SettingError, rewrite};
use krawl::problem::Problem;
use krawl::track::{Control, Solution, prove};
use proptest::prelude::*;

type Point = [f64; 2];

/// A crank a-b of length 1 that drives a rocker of length 3 by a coupler of length 3.5, as drawn at so many degrees; `what` it is.
fn crank(what: &str, drawn: f64) -> Problem {
    let ([bx, by], [cx, cy]) = crank_at(drawn, 1.0);
    let text = format!(
        "name = \"crank\"\ndimension = 2\n[points]\na = [0, 0]\nd = [4, 0]\nb = [{bx:.3}, {by:.3}]\nc = [{cx:.3}, {cy:.3}]\n\
         [constraints]\nfixed = [\"a\", \"d\"]\n{what}\ndistances = [[\"a\", \"b\", 1], [\"b\", \"c\", 3.5], [\"c\", \"d\", 3]]\n"
    );
    Problem::parse(&text, "crank.toml").unwrap()
}

/// Where b and c are by a plain computation, c on the side of d-b that `side` says.
fn crank_at(degrees: f64, side: f64) -> (Point, Point) {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let (x, y) = (cosine - 4.0, sine);
    let square = x * x + y * y;
    let along = (9.0 - 12.25 + square) / (2.0 * square);
    let off = side * (9.0 / square - along * along).sqrt();
    let c = [4.0 + along * x + off * y, along * y - off * x];
    ([cosine, sine], c)
}

fn near(a: [f64; 3], b: Point) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9
}

#[test]
fn a_crank_goes_round_twice() {
    let mut session = Session::open(&crank("turns = [[\"d\", \"a\", \"b\", 60]]", 60.0)).unwrap();
    let index = Setting::find(session.problem(), "turns:d-a-b").unwrap();
    let ends = ["-90", "630"].map(|value| value.parse().unwrap());
    let sweep = session.sweep(index, (&ends[0], &ends[1]), 61, &mut Control::default());
    assert!(sweep.end.is_none());
    assert_eq!(sweep.frames.len(), 61);
    for (k, frame) in sweep.frames.iter().enumerate() {
        let degrees = -90.0 + 12.0 * k as f64;
        assert!((frame.value.mid() - degrees).abs() < 1e-9);
        let (b, c) = crank_at(degrees, 1.0);
        let at = |p: usize| frame.points[p].map(|x| x.mid());
        assert!(near(at(2), b) && near(at(3), c), "{degrees}: {:?}", at(3));
    }
}

#[test]
fn a_turn_is_what_it_is_whichever_way_it_came() {
    let problem = crank("turns = [[\"d\", \"a\", \"b\", 60]]", 55.0);
    for degrees in [-420, -300, -119, -60, 0, 59, 180, 240, 419, 540] {
        let mut session = Session::open(&problem).unwrap();
        let setting = Setting::parse(&problem, &format!("d-a-b={degrees}")).unwrap();
        Setting::check(&problem, std::slice::from_ref(&setting)).unwrap();
        assert_eq!(session.edit(&[setting]).ending, Ending::Reached);
        let (b, c) = crank_at(f64::from(degrees), 1.0);
        let figure = session.figure();
        assert!(near(figure[2], b) && near(figure[3], c), "{degrees}");
    }
    // Quarters of more than 180 degrees would go the other way round.
    let far = Setting::parse(&problem, "d-a-b=600").unwrap();
    assert!(matches!(
        Setting::check(&problem, std::slice::from_ref(&far)),
        Err(SettingError::TurnsTooFar(..))
    ));
    let mut session = Session::open(&problem).unwrap();
    let before = session.figure();
    let Ending::Stopped(stop) = session.edit(&[far]).ending else {
        panic!("it is refused")
    };
    assert!(stop.text.contains("at most 480 degrees"), "{}", stop.text);
    assert_eq!(session.figure(), before);
    let ends = ["60", "1500"].map(|value| value.parse().unwrap());
    let index = Setting::find(&problem, "d-a-b").unwrap();
    let sweep = session.sweep(index, (&ends[0], &ends[1]), 2, &mut Control::default());
    assert_eq!(sweep.frames.len(), 1);
    let sweep = session.sweep(index, (&ends[0], &ends[1]), 5, &mut Control::default());
    assert_eq!(sweep.frames.len(), 5);
}

#[test]
fn ranges_of_many_turns_are_about_the_value() {
    let problem = crank("turns = [[\"d\", \"a\", \"b\", 12345540]]", 60.0);
    let index = Setting::find(&problem, "d-a-b").unwrap();
    let range = Session::open(&problem)
        .unwrap()
        .range(index, &mut Control::default());
    assert!(matches!(range.low, End::Beyond(value) if value.contains(12345180.0)));
    assert!(matches!(range.high, End::Beyond(value) if value.contains(12345900.0)));
}

/// What a file says of an angle of two lines after edits beyond 180 degrees is what its next reader goes on from.
#[test]
fn angles_written_back_go_on_from_where_they_are() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [2, 0]\nc = [-1.9, 0.7]\n[constraints]\nfixed = [\"a\", \"b\"]\n\
                angles = [[\"b\", \"a\", \"a\", \"c\", 20]]\ndistances = [[\"a\", \"c\", 2]]\n";
    let go = |text: &str, value: &str| {
        let problem = Problem::parse(text, "l.toml").unwrap();
        let asked = Asked::new(&problem, &[("angles:b-a-a-c", value)])
            .or_else(|_| Asked::new(&problem, &[("angles:a-b-a-c", value)]));
        let asked = asked.unwrap();
        let mut session = Session::open(&asked.problem).unwrap();
        assert_eq!(
            session.edit(&asked.settings).ending,
            Ending::Reached,
            "{value}"
        );
        let changed = Setting::applied(&asked.given, &problem);
        let figure = session.figure();
        (rewrite(text, &changed, &figure, &[]).unwrap(), figure[2])
    };
    for (far, near) in [
        ("250", "200"),
        ("270", "280"),
        ("-100", "-30"),
        ("330", "350"),
    ] {
        let (_, at_once) = go(text, near);
        let (there, _) = go(text, far);
        let folded = |value: &str| {
            let rest = value.parse::<f64>().unwrap().rem_euclid(360.0);
            rest.min(360.0 - rest).to_string()
        };
        let (_, by_steps) = go(&there, &folded(near));
        assert!(
            near_to(at_once, by_steps),
            "{far} and {near}: {at_once:?} {by_steps:?}"
        );
    }
}

fn near_to(a: [f64; 3], b: [f64; 3]) -> bool {
    near(a, [b[0], b[1]])
}

#[test]
fn limits_are_all_the_way_round_or_dead_centres() {
    let problem = crank("turns = [[\"d\", \"a\", \"b\", 60]]", 60.0);
    let index = Setting::find(&problem, "d-a-b").unwrap();
    let range = Session::open(&problem)
        .unwrap()
        .range(index, &mut Control::default());
    assert!(matches!(range.low, End::Beyond(value) if value.contains(-300.0)));
    assert!(matches!(range.high, End::Beyond(value) if value.contains(420.0)));
    // With a crank of 3 the coupler and the rocker are stretched where 6.5² = 3² + 4² − 24 cos θ.
    let text = problem.to_toml().replace("\"b\", 1.0]", "\"b\", 3]");
    let text = text.replace("\"b\", 1]", "\"b\", 3]");
    let problem = Problem::parse(&text, "rocker.toml").unwrap();
    let stretched = ((9.0 + 16.0 - 42.25) / 24.0_f64).acos().to_degrees();
    let range = Session::open(&problem)
        .unwrap()
        .range(index, &mut Control::default());
    let End::Limit(value, _) = range.high else {
        panic!("{:?}", range.high)
    };
    assert!(
        (value.mid() - stretched).abs() < 1e-9 && value.wid() < 1e-9,
        "{value:?}"
    );
}

#[test]
fn angles_are_led_beyond_their_range_as_turns() {
    // Drawn below: clockwise, so that it is the turn from b to d that grows.
    let text = crank("angles = [[\"d\", \"a\", \"b\", 60]]", -60.0);
    let asked = Asked::new(&text, &[("angles:d-a-b", "250")]).unwrap();
    let turn = &asked.problem.constraints[asked.settings[0].index - 3];
    assert_eq!(turn.kind, "turns");
    assert!(asked.in_words(&text).contains("turns:b-a-d"));
    let mut session = Session::open(&asked.problem).unwrap();
    assert_eq!(session.edit(&asked.settings).ending, Ending::Reached);
    let (b, c) = crank_at(-250.0, 1.0);
    let figure = session.figure();
    assert!(near(figure[2], b) && near(figure[3], c), "{figure:?}");
    // Inside of the range it stays an angle.
    let asked = Asked::new(&text, &[("angles:d-a-b", "100")]).unwrap();
    assert_eq!(asked.problem, text);
}

#[test]
fn sets_and_paths_have_the_sense() {
    for degrees in [250, -110, 90, 0, 180, 37] {
        let what = format!("turns = [[\"d\", \"a\", \"b\", {degrees}]]");
        let problem = crank(&what, f64::from(degrees) + 17.0);
        let is_so = |solution: &Solution| {
            let b = solution.figure()[2];
            let off = (b.y.atan2(b.x).to_degrees() - f64::from(degrees)).rem_euclid(360.0);
            off.min(360.0 - off) < 1e-9
        };
        let run = prove(&problem).unwrap();
        assert!(!run.solutions.is_empty());
        assert!(run.solutions.iter().all(is_so), "{degrees}");
        // Both sides of d-b, and no mirror image of the crank; `angles` has those too.
        let all = all(&problem, &Default::default()).unwrap();
        assert_eq!(all.status, Status::Complete);
        assert_eq!(all.solutions.len(), 2, "{degrees}");
        assert!(all.solutions.iter().all(is_so), "{degrees}");
    }
}

#[test]
fn there_is_none_in_space() {
    let text = "name = \"s\"\ndimension = 3\n[points]\na = [0, 0, 0]\nb = [1, 0, 0]\nc = [0, 1, 0.2]\n[constraints]\n\
                distances = [[\"a\", \"b\", 1], [\"b\", \"c\", 1.5]]\nturns = [[\"a\", \"b\", \"c\", 40]]\n";
    let error = Problem::parse(text, "s.toml").unwrap_err().to_string();
    assert!(error.contains("say `angles`"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Two legs and the turn between them, with a bar to spare on either: one figure, wherever it is drawn, and its mirror image with
    /// the opposite turn.
    #[test]
    fn a_turn_is_that_of_the_figure(
        degrees in -700i32..700, off in -40.0f64..40.0, x in -5.0f64..5.0, tilt in 0.0f64..6.3, short in 1.0f64..3.0,
    ) {
        let mut figures = Vec::new();
        for (mirror, (x, tilt)) in [(1.0, (0.0, 0.0)), (1.0, (x, tilt)), (-1.0, (x, tilt))] {
            let drawn = (f64::from(degrees) + off).to_radians();
            let place = |r: f64, angle: f64| {
                let angle = mirror * angle + tilt;
                format!("[{:.4}, {:.4}]", x + r * angle.cos(), r * angle.sin())
            };
            let text = format!(
                "name = \"t\"\ndimension = 2\n[points]\na = {}\nb = {}\nc = {}\n[constraints]\nturns = [[\"a\", \"b\", \"c\", {}]]\n\
                 distances = [[\"a\", \"b\", 3], [\"b\", \"c\", {short:.4}]]\n[homotopy]\nreference = [\"b\", \"a\"]\n",
                place(3.1, 0.0), place(0.0, 0.0), place(short + 0.1, drawn), mirror as i32 * degrees
            );
            let problem = Problem::parse(&text, "t.toml").unwrap();
            let found = all(&problem, &Default::default()).unwrap();
            prop_assert_eq!(found.status, Status::Complete);
            prop_assert_eq!(found.solutions.len(), 1);
            let run = prove(&problem).unwrap();
            prop_assert_eq!(run.solutions.len(), 1);
            let c = found.solutions[0].figure()[2];
            prop_assert!((run.solutions[0].figure()[2] - c).norm() < 1e-9);
            figures.push([c.x, mirror * c.y]);
        }
        let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
        for [x, y] in figures {
            prop_assert!((x - short * cosine).hypot(y - short * sine) < 1e-3, "{} {}", x, y);
        }
    }
}
