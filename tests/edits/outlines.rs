//! Closed outlines whose edges are to stay apart (`--simple`): where they come to touch, against what geometry says.

use krawl::edit::{End, Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::{Control, Options, StopKind};

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
