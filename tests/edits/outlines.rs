//! Closed outlines whose edges are to stay apart (`--simple`): where they come to touch, against what geometry says.

use krawl::edit::{End, Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::{Control, Options, Stop, StopKind};

/// A house whose roof is pushed down through its floor.
const HOUSE: &str = r#"
name = "house"
dimension = 2
[points]
a = [0, 0]
b = [10, 0]
c = [10, 6]
d = [5, 4]
e = [0, 6]
[lines]
ab = ["a", "b"]
bc = ["b", "c"]
cd = ["c", "d"]
de = ["d", "e"]
ea = ["e", "a"]
[constraints]
fixed = ["a", "b", "c", "e"]
x = [["d", 5]]
y = [["d", 4]]
"#;

/// A slot in a plate: where its round end comes to the plate's edge the two touch.
const SLOT: &str = r#"
name = "slot"
dimension = 2
[points]
a = [0, 0]
b = [10, 0]
c = [10, 6]
d = [0, 6]
p = [3, 3]
q = [5, 3]
p1 = [3, 4]
p2 = [3, 2]
q1 = [5, 2]
q2 = [5, 4]
[lines]
ab = ["a", "b"]
bc = ["b", "c"]
cd = ["c", "d"]
da = ["d", "a"]
low = ["p2", "q1"]
high = ["q2", "p1"]
[arcs]
left = { center = "p", start = "p1", end = "p2" }
right = { center = "q", start = "q1", end = "q2" }
[constraints]
fixed = ["a", "b", "c", "d"]
dx = [["p", "q", 2], ["a", "p", 3]]
dy = [["p", "q", 0], ["a", "p", 3]]
radii = [["left", 1]]
vertical = [["p", "p1"], ["p", "p2"], ["q", "q1"], ["q", "q2"]]
horizontal = ["low"]
"#;

fn session(text: &str, simple: bool) -> Session {
    let problem = Problem::parse_loosely(text, "outline.toml").unwrap();
    let options = Options {
        simple,
        ..Options::certified()
    };
    Session::open_with(&problem, &options, &mut Control::default()).unwrap()
}

fn index(session: &Session, name: &str) -> usize {
    Setting::find(session.problem(), name).unwrap()
}

#[test]
fn edges_that_would_cross_end_a_range() {
    for simple in [false, true] {
        let mut session = session(HOUSE, simple);
        let y = index(&session, "y:d");
        let range = session.range(y, &mut Control::default());
        match (simple, &range.low) {
            (false, low) => assert!(low.value().sup() < -1.0, "{low:?}"),
            (true, End::Unknown(value, why)) => {
                assert!(value.inf() > -1e-6 && value.sup() < 1e-6, "{value:?}");
                assert!(why.contains("come to touch") && why.contains("ab"), "{why}");
            }
            other => panic!("{other:?}"),
        }
        // Upwards there is no such place.
        assert!(matches!(range.high, End::Beyond(_)), "{:?}", range.high);
    }
}

#[test]
fn an_arc_comes_to_the_edge_of_the_plate() {
    let mut session = session(SLOT, true);
    let x = index(&session, "dx:a-p");
    let range = session.range(x, &mut Control::default());
    for (end, at, names) in [
        (&range.low, 1.0, ["left", "da"]),
        (&range.high, 7.0, ["right", "bc"]),
    ] {
        let End::Unknown(value, why) = end else {
            panic!("{end:?}");
        };
        assert!((value.mid() - at).abs() < 1e-6, "{value:?}");
        assert!(names.iter().all(|name| why.contains(name)), "{why}");
    }
}

#[test]
fn an_edit_that_keeps_them_apart_says_so() {
    let mut session = session(SLOT, true);
    let to = |text: &str, session: &Session| Setting::parse(session.problem(), text).unwrap();
    let settings = [to("dx:a-p=6", &session)];
    let edited = session.edit(&settings);
    assert_eq!(edited.ending, Ending::Reached);
    let said = edited.switched_on.join("\n");
    assert!(
        said.contains("edges of closed outlines stay apart, proved of"),
        "{said}"
    );
    let settings = [to("dx:a-p=7.5", &session)];
    let Ending::Stopped(stop) = session.edit(&settings).ending else {
        panic!("it is stopped");
    };
    assert_eq!(stop.kind, StopKind::Touches, "{stop}");
}

/// What crosses as it is drawn is named, and the rest is kept apart.
#[test]
fn what_crosses_as_it_is_drawn_is_named() {
    let crossed = HOUSE
        .replace("d = [5, 4]", "d = [5, -1]")
        .replace("[\"d\", 4]", "[\"d\", -1]");
    let mut session = session(&crossed, true);
    let setting = [Setting::parse(session.problem(), "y:d=-2").unwrap()];
    let edited = session.edit(&setting);
    assert_eq!(edited.ending, Ending::Reached);
    let said = session.outlines_in_words().unwrap();
    assert!(said.contains("Not ab and cd"), "{said}");
}

/// The way from the drawing to its own dimensions is looked at as well, part by part and as a whole; ends that coincide in a chain are one.
#[test]
fn no_way_leads_through_an_edge() {
    let text = r#"
name = "pushed through"
dimension = 2
[points]
a = [0, 0]
b = [10, 0]
b2 = [10, 0]
b3 = [10, 0]
c = [10, 6]
d = [5, 4]
e = [0, 6]
[lines]
ab = ["a", "b"]
bc = ["b3", "c"]
cd = ["c", "d"]
de = ["d", "e"]
ea = ["e", "a"]
[constraints]
fixed = ["a", "b", "c", "e"]
coincident = [["b", "b2"], ["b2", "b3"]]
x = [["d", 5]]
y = [["d", -1]]
"#;
    let problem = Problem::parse_loosely(text, "outline.toml").unwrap();
    let options = Options {
        simple: true,
        ..Options::certified()
    };
    let mut writer = krawl::certificate::Writer::new(Vec::new(), &problem);
    let mut witnessed = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    for control in [&mut Control::default(), &mut witnessed] {
        let error = Session::open_with(&problem, &options, control).err();
        let said = error.expect("it is not opened").to_string();
        assert!(said.contains("come to touch"), "{said}");
    }
}

/// A plate with a hole, and a pin beside it.
const PLATE: &str = r#"
name = "plate"
dimension = 2
[points]
A = [0, 0]
B = [80, 0]
C = [80, 50]
D = [0, 50]
H = [40, 25]
P = [110, 25]
[lines]
bottom = ["A", "B"]
right = ["B", "C"]
top = ["C", "D"]
left = ["D", "A"]
[circles]
hole = { center = "H", radius = 6 }
pin = { center = "P", radius = 3 }
[constraints]
fixed = ["A", "P"]
horizontal = ["bottom", "top"]
vertical = ["left", "right"]
dx = [["A", "B", 80], ["A", "H", 40]]
dy = [["A", "D", 50], ["A", "H", 25]]
radii = [["hole", 6], ["pin", 3]]
"#;

/// What stopped an edit, and the first dimension there.
fn stopped(text: &str, set: &[&str]) -> (Stop, f64, krawl::edit::Edited) {
    let mut session = session(text, true);
    let settings = set
        .iter()
        .map(|set| Setting::parse(session.problem(), set).unwrap());
    let edited = session.edit(&settings.collect::<Vec<_>>());
    let Ending::Stopped(stop) = &edited.ending else {
        panic!("{set:?}: {:?}", edited.ending);
    };
    (stop.clone(), edited.dimensions[0].value.mid(), edited)
}

#[test]
fn a_hole_stays_in_its_plate() {
    for (set, at, names) in [
        ("dx:A-H=100", 74.0, ["hole", "right"]),
        ("dx:A-H=-30", 6.0, ["hole", "left"]),
        ("radii:hole=200", 25.0, ["hole", "bottom"]),
        ("radii:pin=200", 30.0, ["pin", "right"]),
        ("dx:A-B=30", 46.0, ["hole", "right"]),
    ] {
        let (stop, value, edited) = stopped(PLATE, &[set]);
        assert_eq!(stop.kind, StopKind::Touches, "{set}: {stop}");
        assert!((value - at).abs() < 1e-6, "{set}: {value}");
        assert!(
            names.iter().all(|name| stop.contains(name)),
            "{set}: {stop}"
        );
        // The figure is that shortly before.
        let there = edited.there.as_ref().expect("it is shown")[0].mid();
        assert!((there - at).abs() < 1e-3, "{set}: {there}");
        if set.starts_with("dx:A-H") {
            assert!((edited.points[4][0].mid() - there).abs() < 1e-9);
        }
    }
    // Outside of the plate two circles come to touch.
    let outside = PLATE
        .replace("H = [40, 25]", "H = [93, 25]")
        .replace("\"H\", 40", "\"H\", 93");
    let (stop, value, _) = stopped(&outside, &["dx:A-H=200"]);
    assert!(stop.contains("hole and pin"), "{stop}");
    assert!((value - 101.0).abs() < 1e-6, "{value}");
}

/// A side of a triangle swings towards a quarter of a circle, whose circle it would touch long before.
#[test]
fn a_side_comes_to_an_arc_and_not_to_its_circle() {
    let text = "name = \"quarter\"\ndimension = 2\n[points]\nP0 = [2,-6]\nP1 = [3,-5]\nP2 = [3,1]\nM = [0,0]\nS = [2,0]\nE = [0,2]\n[lines]\n\
                s0 = [\"P0\",\"P1\"]\ns1 = [\"P1\",\"P2\"]\ns2 = [\"P2\",\"P0\"]\nchord = [\"E\",\"S\"]\n[arcs]\n\
                arc = { center = \"M\", start = \"S\", end = \"E\" }\n[constraints]\nfixed = [\"M\",\"S\"]\n\
                x = [[\"P0\",2],[\"P1\",3],[\"P2\",3],[\"E\",0]]\ny = [[\"P0\",-6],[\"P1\",-5],[\"P2\",1]]\n";
    let (stop, value, _) = stopped(text, &["x:P0=-6"]);
    assert_eq!(stop.kind, StopKind::Touches, "{stop}");
    // On the line through (3, 1) and (2, 0), where the arc begins.
    assert!((value + 4.0).abs() < 1e-6, "{value}");
    assert!(stop.contains("s2"), "{stop}");
}

/// A hole at the end of an arm: its path is no line, and is followed in tubes.
#[test]
fn a_hole_on_an_arm_comes_to_the_edge() {
    let arm = PLATE
        .replace("H = [40, 25]", "O = [20, 10]\nH = [48.284271247, 20]")
        .replace(
            "fixed = [\"A\"",
            "distances = [[\"O\", \"H\", 30]]\nfixed = [\"A\", \"O\"",
        )
        .replace(", [\"A\", \"H\", 40]", "")
        .replace("[\"A\", \"H\", 25]", "[\"O\", \"H\", 10]")
        .replace("radius = 6", "radius = 12")
        .replace("[\"hole\", 6]", "[\"hole\", 12]");
    let (stop, value, _) = stopped(&arm, &["dy:O-H=29"]);
    assert!(stop.contains("hole") && stop.contains("top"), "{stop}");
    assert!((value - 28.0).abs() < 1e-6, "{value}");
}

/// Points along an edge of a frame.
fn line(a: [f64; 2], b: [f64; 2]) -> Vec<[f64; 2]> {
    vec![a, b]
}

fn round([x, y]: [f64; 2], radius: f64, from: f64, by: f64) -> Vec<[f64; 2]> {
    let angle = |k: i32| (from + by * f64::from(k) / 180.0).to_radians();
    let on = |k: i32| [x + radius * angle(k).cos(), y + radius * angle(k).sin()];
    (0..=180).map(on).collect()
}

fn meet(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let side = |p: &[[f64; 2]], x: [f64; 2]| {
        (p[1][0] - p[0][0]) * (x[1] - p[0][1]) - (p[1][1] - p[0][1]) * (x[0] - p[0][0])
    };
    let parts = |p: &[[f64; 2]], q: &[[f64; 2]]| side(p, q[0]) * side(p, q[1]) <= 0.0;
    a.windows(2)
        .any(|p| b.windows(2).any(|q| parts(p, q) && parts(q, p)))
}

/// A hole, in or outside of a slot with round ends in a plate, led somewhere while its radius changes: against frames of the drawing.
#[test]
fn frames_of_a_hole_beside_a_slot() {
    let text = |[x, y, r]: [f64; 3]| {
        SLOT.replace(
            "[arcs]",
            &format!("[circles]\nhole = {{ center = \"h\", radius = {r} }}\n[arcs]"),
        )
        .replace("p = [3, 3]", &format!("h = [{x}, {y}]\np = [3, 3]"))
        .replace(
            "[[\"left\", 1]]",
            &format!("[[\"left\", 1], [\"hole\", {r}]]\nx = [[\"h\", {x}]]\ny = [[\"h\", {y}]]"),
        )
    };
    let fixed = [
        line([0.0, 0.0], [10.0, 0.0]),
        line([10.0, 0.0], [10.0, 6.0]),
        line([10.0, 6.0], [0.0, 6.0]),
        line([0.0, 6.0], [0.0, 0.0]),
        line([3.0, 2.0], [5.0, 2.0]),
        line([5.0, 4.0], [3.0, 4.0]),
        round([3.0, 3.0], 1.0, 90.0, 180.0),
        round([5.0, 3.0], 1.0, -90.0, 180.0),
    ];
    let mut state = 11_u64;
    let mut random = |low: f64, high: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let x = low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64);
        (x * 100.0).round() / 100.0
    };
    let touches = |[x, y, r]: [f64; 3]| {
        let hole = round([x, y], r, 0.0, 360.0);
        fixed.iter().any(|edge| meet(edge, &hole))
    };
    const FRAMES: i32 = 400;
    let (mut reached, mut ended) = (0, 0);
    while reached < 6 || ended < 12 {
        let from = [random(0.5, 9.5), random(0.5, 5.5), random(0.1, 0.8)];
        if touches(from) {
            continue;
        }
        let to = [random(0.5, 9.5), random(0.5, 5.5), random(0.1, 3.0)];
        let at = |k: i32| {
            let t = f64::from(k) / f64::from(FRAMES);
            [0, 1, 2].map(|i| from[i] + t * (to[i] - from[i]))
        };
        let first = (0..=FRAMES).find(|&k| touches(at(k)));
        let mut session = session(&text(from), true);
        let set = [
            format!("x:h={}", to[0]),
            format!("y:h={}", to[1]),
            format!("radii:hole={}", to[2]),
        ];
        let settings = set.map(|set| Setting::parse(session.problem(), &set).unwrap());
        let edited = session.edit(&settings);
        match (&edited.ending, first) {
            (Ending::Reached, None) => reached += 1,
            (Ending::Stopped(stop), Some(first)) => {
                assert_eq!(stop.kind, StopKind::Touches, "{from:?} to {to:?}: {stop}");
                // Polygons of frames are inside of their circles by a little.
                let t = edited.t.0 * f64::from(FRAMES);
                let is_so = f64::from(first) - 2.0 < t && t < f64::from(first) + 0.5;
                assert!(is_so, "{from:?} to {to:?}: {t} and {first}");
                ended += 1;
            }
            // A frame may leave out a touch of less than a step.
            (ending, first) => panic!("{from:?} to {to:?}: {ending:?}, {first:?}"),
        }
    }
}

/// A rectangle with one round corner.
const FILLET: &str = r#"
name = "fillet"
dimension = 2
[points]
a = [0, 0]
c = [60, 0]
e = [60, 30]
m = [50, 30]
g = [50, 40]
d = [0, 40]
[lines]
bottom = ["a", "c"]
side = ["c", "e"]
top = ["g", "d"]
left = ["d", "a"]
[arcs]
f = { center = "m", start = "e", end = "g" }
[constraints]
fixed = ["a"]
horizontal = ["bottom", "top"]
vertical = ["left", "side"]
dx = [["a", "c", 60]]
dy = [["a", "d", 40]]
radii = [["f", 10]]
tangent = [["f", "side"], ["f", "top"]]
"#;

/// A round corner that is too large leaves nothing of the line beside it; the equations say nothing of its direction there.
#[test]
fn a_round_corner_leaves_nothing_of_a_side() {
    for simple in [false, true] {
        let mut session = session(FILLET, simple);
        let setting = [Setting::parse(session.problem(), "radii:f=50").unwrap()];
        let edited = session.edit(&setting);
        let Ending::Stopped(stop) = &edited.ending else {
            panic!("{:?}", edited.ending);
        };
        assert_eq!(stop.kind, StopKind::Vanishes, "{stop}");
        assert!(stop.contains("the line side shrinks to nothing"), "{stop}");
        let value = edited.dimensions[0].value.mid();
        assert!((value - 40.0).abs() < 1e-6, "{value}");
        assert!(edited.there.is_some());
        // What is left of the side.
        let left = edited.points[2][1].mid();
        assert!(left > 0.0 && left < 1e-3, "{left}");
    }
}

/// Where a line vanishes its neighbours come to touch: it is the line that is named.
#[test]
fn the_edge_that_vanishes_is_named() {
    let mut session = session(PLATE, true);
    let settings = ["dx:A-H=-20", "dx:A-B=-40", "radii:hole=0.1"];
    let settings = settings.map(|set| Setting::parse(session.problem(), set).unwrap());
    // The hole leaves the plate before.
    let Ending::Stopped(stop) = session.edit(&settings).ending else {
        panic!("it is stopped");
    };
    assert_eq!(stop.kind, StopKind::Touches, "{stop}");
    let mut session = self::session(
        &PLATE
            .replace(
                "[circles]\nhole = { center = \"H\", radius = 6 }",
                "[circles]",
            )
            .replace("[\"hole\", 6], ", ""),
        true,
    );
    let width = index(&session, "dx:A-B");
    let range = session.range(width, &mut Control::default());
    let End::Unknown(value, why) = &range.low else {
        panic!("{:?}", range.low);
    };
    assert!(value.mid().abs() < 1e-6, "{value:?}");
    assert!(
        why.contains("shrinks to nothing") && (why.contains("bottom") || why.contains("top")),
        "{why}"
    );
}

/// The end of an arc comes to its start at the value at which both are at one height.
#[test]
fn an_arc_vanishes_at_a_value() {
    let text = r#"
name = "arc"
dimension = 2
[points]
o = [0, 0]
s = [9.79795897113271, 2]
e = [9.16515138991168, 4]
[arcs]
arc = { center = "o", start = "s", end = "e" }
[constraints]
fixed = ["o"]
dy = [["o", "s", 2], ["o", "e", 4]]
radii = [["arc", 10]]
"#;
    let mut session = session(text, false);
    let setting = [Setting::parse(session.problem(), "dy:o-e=1").unwrap()];
    let edited = session.edit(&setting);
    let Ending::Stopped(stop) = &edited.ending else {
        panic!("{:?}", edited.ending);
    };
    assert!(stop.contains("the arc arc shrinks to nothing"), "{stop}");
    let value = edited.dimensions[0].value.mid();
    assert!((value - 2.0).abs() < 1e-6, "{value}");
    let there = edited.there.as_ref().expect("there is a figure")[0];
    assert!(there.inf() > 2.0 && there.sup() < 2.00001, "{there:?}");
    assert!((edited.points[2][1].mid() - there.mid()).abs() < 1e-9);
}

#[test]
fn what_edges_are_is_said() {
    let said = |text: &str| session(text, true).outlines_in_words().unwrap();
    let no_edges = HOUSE.replace(
        &HOUSE[HOUSE.find("[lines]").unwrap()..HOUSE.find("[constraints]").unwrap()],
        "",
    );
    let words = said(&no_edges);
    assert!(
        words.contains("under [lines]") && words.contains("here there are none"),
        "{words}"
    );
    let words = said(
        &PLATE
            .replace("left = [\"D\", \"A\"]\n", "")
            .replace("[\"left\", \"right\"]", "[\"right\"]"),
    );
    // Two circles alone.
    assert!(words.contains(": 1 pairs"), "{words}");
}
