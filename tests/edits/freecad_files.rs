//! Sketches that FreeCAD made and solved (tests/data/freecad/make.py): after an edit figures are where FreeCAD has them.

use crate::real_files::File;
use crate::real_files::freecad::{archive, constraint, line, sketch as sketch_of};
use krawl::blocks::Figures;
use krawl::edit::{Asked, Ending, Session, Setting, SettingError};
use krawl::problem::Point;
use krawl::track::{Control, Options};
use std::collections::BTreeMap;
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/freecad")
}

fn sketch(name: &str) -> File {
    let bytes = std::fs::read(folder().join(name)).unwrap();
    File::new(name, bytes, Some("Sketch"))
}

/// Angles below 0 and above 180 degrees, of 0, and of arcs, go by FreeCAD's numbers; edges of other objects are where FreeCAD sees them in
/// the sketch's plane; what is beside an ellipse can be edited.
#[test]
fn edits_lead_where_freecad_leads() {
    type Places = BTreeMap<String, [f64; 2]>;
    let seen = std::fs::read_to_string(folder().join("seen.json")).unwrap();
    let seen: BTreeMap<String, BTreeMap<String, Places>> = serde_json::from_str(&seen).unwrap();
    let mut count = 0;
    for (name, settings) in seen {
        let file = sketch(&format!("{name}.FCStd"));
        for (setting, places) in settings {
            let edited = file.edited(&setting);
            for (point, [x, y]) in places {
                let [u, v] = edited.at(&point);
                assert!(
                    (u - x).abs() < 1e-6 && (v - y).abs() < 1e-6,
                    "{name} {setting}: {point} is at {u} {v}, not {x} {y}"
                );
                count += 1;
            }
            // What is written is what was set.
            let (dimension, value) = setting.split_once('=').unwrap();
            let index = Setting::find(&edited.problem, dimension).unwrap();
            let now = Session::open(&edited.problem).unwrap().length(index);
            assert!((now.mid() - value.parse::<f64>().unwrap()).abs() < 1e-9);
        }
    }
    assert_eq!(count, 140);
}

#[test]
fn what_has_no_kind_stays_and_is_named() {
    let file = sketch("kept.FCStd");
    let kept = &file.problem.kept;
    assert_eq!(
        kept.what,
        ["e5", "e11", "e6", "e7", "e8", "e9", "e10.start"]
    );
    let kinds: Vec<_> = kept.kinds.iter().map(|(kind, n)| (&kind[..], *n)).collect();
    let wanted = [
        ("BSplineCurve", 1),
        ("DistanceX", 1),
        ("Ellipse", 1),
        ("InternalAlignment", 4),
        ("PointOnObject", 1),
    ];
    assert_eq!(kinds, wanted);
    let mut session = Session::open(&file.problem).unwrap();
    let before = session.figure();
    let edited = session.edit(&[Setting::parse(&file.problem, "l=14").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    let words = edited.account.clause();
    assert!(
        words.contains("e10.start left as they are because of"),
        "{words}"
    );
    assert!(!edited.account.is_whole());
    let at = |name: &str| file.problem.points.iter().position(|p| p.name == name);
    for name in ["e6.start", "e7.end", "e8", "e10.start"] {
        let p = at(name).unwrap();
        assert_eq!(session.figure()[p], before[p], "{name}");
    }
    let end = at("e10.end").unwrap();
    assert!((session.figure()[end][0] - before[end][0] - 2.0).abs() < 1e-9);
    let problem = &file.problem;
    let unknown = Setting::find(problem, "middle").unwrap_err();
    assert_eq!(unknown, SettingError::Kept("middle".to_owned()));
}

/// FreeCAD's numbers are read, set and written in its own sense: −35 to −50 is no way through 0.
#[test]
fn angles_keep_the_signs_of_the_file() {
    let file = sketch("angles.FCStd");
    let asked = Asked::new(&file.problem, &[("down", "-50"), ("wide", "200")]).unwrap();
    assert!(asked.in_words(&file.problem).is_empty());
    let number = |name: &str| {
        let index = Setting::find(&file.problem, name).unwrap();
        let constraint = &file.problem.constraints[index - file.problem.distances.len()];
        (
            constraint.kind.clone(),
            constraint.value.clone().unwrap().to_string(),
        )
    };
    for (name, value) in [
        ("down", "-35"),
        ("wide", "190"),
        ("level", "0"),
        ("round", "200"),
    ] {
        assert_eq!(number(name), ("turns".to_owned(), value.to_owned()));
    }
}

/// What newer versions of FreeCAD have, too: `Block` of a circle and an arc, lines tangent to each other, a distance of a circle.
#[test]
fn round_things_are_blocked_and_have_distances() {
    let round = |kind: &str, more: &str, [x, y, r]: [f64; 3]| {
        format!(
            "<Geometry type=\"Part::Geom{kind}\"><{kind} CenterX=\"{x}\" CenterY=\"{y}\" NormalZ=\"1\" AngleXU=\"0\" Radius=\"{r}\" {more}/></Geometry>"
        )
    };
    let geometry = round("Circle", "", [0.0, 0.0, 3.0])
        + &round(
            "ArcOfCircle",
            "StartAngle=\"0\" EndAngle=\"2\"",
            [20.0, 0.0, 2.0],
        )
        + &line([-5.0, 7.0, 5.0, 7.0])
        + &line([9.0, 7.0, 13.0, 7.0]);
    let constraints = [
        constraint("", 17, 0.0, &[(0, 0)]),
        constraint("", 17, 0.0, &[(1, 0)]),
        constraint("gap", 6, 4.0, &[(0, 0), (2, 0)]),
        constraint("", 2, 0.0, &[(2, 0)]),
        constraint("", 5, 0.0, &[(2, 0), (3, 0)]),
    ];
    let sketch = sketch_of(&constraints.concat(), &geometry, "");
    let bytes = archive(&[("Sketcher::SketchObject", "Sketch", &sketch)]);
    let file = File::new("round.FCStd", bytes, None);
    assert!(file.problem.kept.what.is_empty());
    let at = |name: &str| {
        let named = |p: &Point| p.name == name;
        file.problem.points.iter().position(named).unwrap()
    };
    let mut session = Session::open(&file.problem).unwrap();
    let before = session.figure();
    let edited = session.edit(&[Setting::parse(&file.problem, "gap=5").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    let after = session.figure();
    for name in ["e1.center", "e2.center", "e2.start"] {
        assert_eq!(after[at(name)], before[at(name)], "{name}");
    }
    // That end is told by how far it is turned from the other, and is not at the mirror image of its place either.
    let (now, then) = (after[at("e2.end")], before[at("e2.end")]);
    assert!((0..2).all(|k| (now[k] - then[k]).abs() < 1e-12));
    let figures = Figures::find(
        &file.problem,
        &Options::certified(),
        &mut Control::default(),
    );
    assert_eq!(figures.unwrap().count(), Some(1));
    for name in ["e3.start", "e3.end", "e4.start", "e4.end"] {
        assert!((after[at(name)][1] - 8.0).abs() < 1e-9, "{name}");
    }
}
