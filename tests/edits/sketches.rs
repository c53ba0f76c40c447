//! Sketches of other programs, in and out, and sketches that are followed part by part.

use krawl::edit::{Decomposition, Edited, Ending, Session, Setting};
use krawl::import::{self, Figure, Imported};
use krawl::problem::Problem;
use krawl::system::Located;

const BRACKET: &str = "problems/sketches/bracket.slvs";
const PARTS: &str = "problems/sketches/parts.FCStd";

fn read(file: &str, sketch: Option<&str>) -> (Imported, Vec<u8>) {
    let bytes = std::fs::read(file).unwrap();
    (import::read(file, &bytes, sketch).unwrap(), bytes)
}

fn edit(session: &mut Session, text: &str) -> Edited {
    let setting = Setting::parse(session.problem(), text).unwrap();
    session.edit(&[setting])
}

fn rewritten(sketch: &Imported, bytes: &[u8], session: &Session) -> Vec<u8> {
    let (points, objects) = (session.figure(), session.objects());
    let radius = |object: &Located| object.number().map_or(0.0, |radius| radius.mid());
    let radii: Vec<f64> = objects.iter().map(radius).collect();
    let figure = Figure {
        points: &points,
        radii: &radii,
    };
    import::rewrite(sketch, bytes, session.problem(), &figure).unwrap()
}

/// The place of a point in the session's figure.
fn place(session: &Session, name: &str) -> [f64; 3] {
    let index = session.problem().points.iter().position(|p| p.name == name);
    session.figure()[index.unwrap()]
}

fn apart(session: &Session, a: &str, b: &str) -> f64 {
    let (a, b) = (place(session, a), place(session, b));
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[test]
fn a_solvespace_sketch_is_edited_and_given_back() {
    let (sketch, bytes) = read(BRACKET, None);
    assert!(sketch.problem.kept.kinds.is_empty());
    let mut session = Session::open(&sketch.problem).unwrap();
    assert!(session.moved().distance < 1e-9, "{:?}", session.moved());
    assert!(session.account().held.is_empty() && session.account().meets_all());
    // What does not change is not touched.
    assert_eq!(
        rewritten(&sketch, &bytes, &Session::open(&sketch.problem).unwrap()).len(),
        bytes.len()
    );
    let edited = edit(&mut session, "c00a=38");
    assert_eq!(edited.ending, Ending::Reached);
    assert!((apart(&session, "r006.1", "r006.2") - 38.0).abs() < 1e-9);
    assert!((apart(&session, "r007.1", "r007.2") - 40.0).abs() < 1e-9);
    // The diameter, which nothing else needs, is a number for itself.
    let edited = edit(&mut session, "c00e=12.5");
    assert_eq!((edited.ending, edited.tubes), (Ending::Reached, 0));
    let out = rewritten(&sketch, &bytes, &session);
    let again = import::read(BRACKET, &out, None).unwrap();
    let session = Session::open(&again.problem).unwrap();
    assert!(session.moved().distance < 1e-9);
    assert_eq!(
        session
            .length(Setting::find(&again.problem, "c00a").unwrap())
            .mid(),
        38.0
    );
    // Only lines with numbers differ.
    let lines = |bytes: &[u8]| -> Vec<Vec<u8>> {
        bytes.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect()
    };
    let (old, new) = (lines(&bytes), lines(&out));
    assert_eq!(old.len(), new.len());
    for (a, b) in old.iter().zip(&new).filter(|(a, b)| a != b) {
        let key = |line: &[u8]| line.split(|b| *b == b'=').next().unwrap().to_vec();
        assert_eq!(key(a), key(b));
    }
}

#[test]
fn a_limit_is_named_in_the_words_of_the_file() {
    let (sketch, _) = read(BRACKET, None);
    let mut session = Session::open(&sketch.problem).unwrap();
    let edited = edit(&mut session, "c00a=10");
    let Ending::Limit(limit) = &edited.ending else {
        panic!("{edited:?}")
    };
    // c and d are on one line with the origin: √(50² + 30²) − 40.
    let wanted = 3400f64.sqrt() - 40.0;
    assert!((edited.dimensions[0].value.mid() - wanted).abs() < 1e-9);
    assert!(
        edited.dimensions[0]
            .value
            .contains(edited.dimensions[0].value.mid())
    );
    assert!(limit.motion.iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn angles_can_be_edited_across_a_right_angle() {
    let (sketch, _) = read(BRACKET, None);
    let mut session = Session::open(&sketch.problem).unwrap();
    for degrees in ["80", "90", "100", "90", "60"] {
        let edited = edit(&mut session, &format!("c011={degrees}"));
        assert_eq!(edited.ending, Ending::Reached, "{degrees}: {edited:?}");
        let [c, d, e] = ["r006.1", "r006.2", "r009.2"].map(|p| place(&session, p));
        let (u, v) = ([d[0] - c[0], d[1] - c[1]], [e[0] - d[0], e[1] - d[1]]);
        let turned = (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]);
        // The sense of turn stays, by proof.
        assert!((turned.to_degrees() + degrees.parse::<f64>().unwrap()).abs() < 1e-9);
        assert!(
            edited.orientations.lost.is_empty(),
            "{:?}",
            edited.orientations
        );
    }
}

#[test]
fn freecad_sketches_are_edited_and_given_back() {
    let bytes = std::fs::read(PARTS).unwrap();
    let names: Vec<String> = import::list(PARTS, &bytes)
        .unwrap()
        .into_iter()
        .map(|s| s.name)
        .collect();
    assert_eq!(names, ["Slot", "Frame"]);
    assert!(import::read(PARTS, &bytes, None).is_err());
    for (name, setting, points, wanted) in [
        ("Slot", "width=6", ["e1.start", "e3.end"], 12.0),
        ("Slot", "reach=31.5", ["e1.start", "e1.end"], 31.5),
        ("Frame", "base=70", ["e3.start", "e3.end"], 70.0),
        ("Frame", "lean=95.5", ["e2.start", "e2.end"], 40.0),
    ] {
        let (sketch, bytes) = read(PARTS, Some(name));
        assert!(
            sketch.problem.kept.kinds.is_empty(),
            "{:?}",
            sketch.problem.kept.kinds
        );
        let mut session = Session::open(&sketch.problem).unwrap();
        assert!(
            session.moved().distance < 1e-9,
            "{name}: {:?}",
            session.moved()
        );
        let edited = edit(&mut session, setting);
        assert_eq!(
            edited.ending,
            Ending::Reached,
            "{name} {setting}: {edited:?}"
        );
        assert!(
            (apart(&session, points[0], points[1]) - wanted).abs() < 1e-9,
            "{name} {setting}"
        );
        assert!(
            edited.orientations.lost.is_empty(),
            "{name}: {:?}",
            edited.orientations
        );
        let out = rewritten(&sketch, &bytes, &session);
        let again = import::read(PARTS, &out, Some(name)).unwrap();
        let second = Session::open(&again.problem).unwrap();
        assert!(
            second.moved().distance < 1e-9,
            "{name} {setting}: {:?}",
            second.moved()
        );
        let index = Setting::find(&again.problem, setting.split('=').next().unwrap()).unwrap();
        let said: f64 = setting.split('=').nth(1).unwrap().parse().unwrap();
        assert!((second.length(index).mid() - said).abs() < 1e-9);
    }
}

#[test]
fn kinds_that_are_not_supported_are_named() {
    let text = String::from_utf8_lossy(&std::fs::read(BRACKET).unwrap()).into_owned();
    let text = text.replacen("Constraint.type=90", "Constraint.type=51", 1);
    let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
    let kinds: Vec<(&str, usize)> = sketch
        .problem
        .kept
        .kinds
        .iter()
        .map(|(k, n)| (k.as_str(), *n))
        .collect();
    assert_eq!(kinds, [("LENGTH_RATIO", 1)]);
    for broken in [&b""[..], b"SolveSpace", b"PK\x03\x04"] {
        assert!(import::read("x.slvs", broken, None).is_err());
        assert!(import::read("x.FCStd", broken, None).is_err());
    }
}

#[test]
fn what_is_free_stays_put() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [9, 9]\n\
                [constraints]\ndistances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3]]\n";
    assert!(Problem::parse(text, "free.toml").is_err_and(|e| e.is_about_structure()));
    let problem = Problem::parse_loosely(text, "free.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = edit(&mut session, "a-b=5");
    assert_eq!(edited.ending, Ending::Reached);
    assert!((apart(&session, "a", "b") - 5.0).abs() < 1e-12);
    assert!((apart(&session, "b", "c") - 3.0).abs() < 1e-12);
    assert_eq!(place(&session, "d"), [9.0, 9.0, 0.0]);
    let held = session.account().names_held();
    assert!(held.contains(&"x of d".to_owned()), "{held:?}");
}

#[test]
fn blocks_are_cut_and_each_needs_those_before() {
    let (sketch, _) = read(BRACKET, None);
    let found = Decomposition::of(&sketch.problem).unwrap();
    // d by two circles, after b and c by one number each.
    let at = |name: &str| {
        found
            .blocks
            .iter()
            .position(|block| block.iter().any(|u| u == name))
    };
    let d = found
        .blocks
        .iter()
        .position(|b| b == &["x of r006.2", "y of r006.2"])
        .unwrap();
    for before in ["x of r004.2", "y of r005.2"] {
        assert!(at(before).is_none_or(|k| k < d), "{found:?}");
    }
    assert!(found.merged >= 12, "{found:?}");
}

/// SolveSpace 1247: cos θ = 100/√(100² + h²) from 60° to 30°; the path reaches h = 57.735…, never −57.735….
#[test]
fn a_height_keeps_its_sign() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [100, 0]\nc = [100, 173.2]\n\
                [constraints]\nfixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]\nvertical = [[\"b\", \"c\"]]\n\
                distances = [[\"a\", \"b\", 100]]\nangles = [[\"b\", \"a\", \"c\", 60]]\n";
    let problem = Problem::parse(text, "height.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = edit(&mut session, "angles:b-a-c=30");
    assert_eq!(edited.ending, Ending::Reached);
    assert!((place(&session, "c")[1] - 100.0 / 3f64.sqrt()).abs() < 1e-9);
    assert_eq!(edited.orientations.kept.len(), 1);
}

/// b on the circle over a-c sees a and c at a right angle, until it is led to a itself: there the angle has no leg, though
/// the equations hold all the way and beyond.
#[test]
fn an_angle_without_a_leg_is_no_figure() {
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [0.5, 1.32]\nc = [4, 0]\n\
                [constraints]\nfixed = [\"a\", \"c\"]\ny = [[\"b\", 1.32]]\nperpendicular = [[\"a\", \"b\", \"b\", \"c\"]]\n";
    let problem = Problem::parse(text, "leg.toml").unwrap();
    for (height, is_reached) in [("1.5", true), ("0.01", true), ("0", false), ("-1", false)] {
        let mut session = Session::open(&problem).unwrap();
        let before = session.figure();
        let edited = edit(&mut session, &format!("y:b={height}"));
        assert_eq!(
            edited.ending == Ending::Reached,
            is_reached,
            "{height}: {edited:?}"
        );
        if !is_reached {
            let (Ending::Passes(what) | Ending::Stopped(what)) = &edited.ending else {
                panic!("{edited:?}");
            };
            assert!(what.contains("a-b"), "{what}");
            assert_eq!(session.figure(), before);
        }
    }
    // A figure that has no leg to begin with is refused when it is read.
    let text = text
        .replace("b = [0.5, 1.32]", "b = [0, 0]")
        .replace("1.32", "0");
    let error = Problem::parse(&text, "leg.toml").unwrap_err().to_string();
    assert!(error.contains("a and b coincide"), "{error}");
}

/// A file in which nothing is drawn, or all points are in one place, is described or refused.
#[test]
fn a_sketch_without_points_or_with_ends_in_one_place_is_described() {
    use assert_cmd::Command;
    let text = String::from_utf8_lossy(&std::fs::read(BRACKET).unwrap()).into_owned();
    let folder = tempfile::tempdir().unwrap();
    let check = |text: &str| {
        let file = folder.path().join("damaged.slvs");
        let mut bytes = b"\xb1\xb2\xb3".to_vec();
        // The first line begins with three bytes that are no UTF-8.
        let begin = text.find("SolveSpace").unwrap();
        bytes.extend(&text.as_bytes()[begin..]);
        std::fs::write(&file, bytes).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let output = command.arg("check").arg(&file).output().unwrap();
        assert!(
            matches!(output.status.code(), Some(0 | 2 | 6)),
            "{output:?}"
        );
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(check(&text).contains("blocks\n"));
    // No requests: nothing is drawn.
    let none: Vec<&str> = text.lines().filter(|l| *l != "AddRequest").collect();
    check(&none.join("\n"));
    // All numbers gone: all points are in one place.
    let flat: Vec<&str> = text
        .lines()
        .filter(|l| !l.starts_with("Param.val="))
        .collect();
    check(&flat.join("\n"));
}

/// The bracket with other constraints in place of some: the handle, and the lines of the new one.
fn bracket_with(new: &[(&str, &str)]) -> String {
    let text = String::from_utf8_lossy(&std::fs::read(BRACKET).unwrap()).into_owned();
    let parts = text.split_inclusive("AddConstraint");
    let parts = parts.map(|part| {
        let replaced = new
            .iter()
            .find(|(handle, _)| part.contains(&format!("Constraint.h.v=000000{handle}\n")));
        match replaced {
            Some((handle, lines)) => {
                let (before, _) = part.split_once("Constraint.h.v=").unwrap();
                let lines: String = lines
                    .split(' ')
                    .map(|line| format!("Constraint.{line}\n"))
                    .collect();
                format!(
                    "{before}Constraint.h.v=000000{handle}\nConstraint.group.v=00000002\n\
                     Constraint.workplane.v=80020000\n{lines}Constraint.reference=0\nAddConstraint"
                )
            }
            None => part.to_owned(),
        }
    });
    parts.collect()
}

/// Kinds of SolveSpace that are about planes, ratios, differences and projections, in place of those of the bracket that
/// say the same.
#[test]
fn planes_ratios_differences_and_projections_are_edited() {
    let text = bracket_with(&[
        // The origin: in both planes.
        ("01", "type=41 ptA.v=00040001 entityA.v=00020000"),
        ("12", "type=41 ptA.v=00040001 entityA.v=00030000"),
        // The hole: 12 above the plane through the x axis, and 15 along the lower edge from its end.
        ("0c", "type=31 valA=12.0 ptA.v=00080001 entityA.v=00030000"),
        (
            "0d",
            "type=34 valA=-15.0 ptA.v=00080001 ptB.v=00040002 entityA.v=00040000",
        ),
        // 35 / 40, and 40 − 10.
        (
            "0a",
            "type=51 valA=0.875 entityA.v=00060000 entityB.v=00070000",
        ),
        (
            "10",
            "type=56 valA=30.0 entityA.v=00070000 entityB.v=00090000",
        ),
    ]);
    let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
    assert!(
        sketch.problem.kept.kinds.is_empty(),
        "{:?}",
        sketch.problem.kept.kinds
    );
    let mut session = Session::open(&sketch.problem).unwrap();
    assert!(session.moved().distance < 1e-6, "{:?}", session.moved());
    for (setting, written) in [
        ("c00c=10", "Constraint.valA=10.0000"),
        ("c00d=20", "Constraint.valA=-20.0000"),
        ("c00a=0.9", "Constraint.valA=0.9000"),
        ("c010=28", "Constraint.valA=28.0000"),
    ] {
        let edited = edit(&mut session, setting);
        assert_eq!(edited.ending, Ending::Reached, "{setting}");
        let out = rewritten(&sketch, text.as_bytes(), &session);
        let out = String::from_utf8_lossy(&out).into_owned();
        assert!(out.contains(written), "{setting}");
    }
    let near = |x: f64, y: f64| (x - y).abs() < 1e-9;
    assert_eq!(place(&session, "r004.1"), [0.0; 3]);
    let hole = place(&session, "r008.1");
    assert!(near(hole[0], 30.0) && near(hole[1], 10.0), "{hole:?}");
    assert!(near(apart(&session, "r006.1", "r006.2"), 36.0));
    assert!(near(apart(&session, "r009.1", "r009.2"), 12.0));
}

/// Equal angles are those of the file where the figure tells which of two angles of lines is meant, and named otherwise. A
/// projection along a normal, and symmetry about a plane, are those along and about the line that is seen of it.
#[test]
fn equal_angles_and_planes_are_read_where_they_are_certain() {
    for (other, is_read) in [(1, true), (0, false)] {
        let lines = format!(
            "type=54 entityA.v=00060000 entityB.v=00090000 entityC.v=00040000 entityD.v=00070000 other={other}"
        );
        let text = bracket_with(&[("11", &lines)]);
        let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
        assert_eq!(sketch.problem.kept.kinds.is_empty(), is_read);
        assert_eq!(
            sketch.problem.kept.kinds.contains_key("EQUAL_ANGLE"),
            !is_read,
            "{:?}",
            sketch.problem.kept.kinds
        );
        if is_read {
            let mut session = Session::open(&sketch.problem).unwrap();
            let edited = edit(&mut session, "c008=50.5");
            assert_eq!(edited.ending, Ending::Reached);
            // Which way both angles turn is followed.
            for names in [
                ["r006.1", "r006.2", "r009.2"],
                ["r004.1", "r004.2", "r007.1"],
            ] {
                let points = names.map(|name| {
                    let mut all = sketch.problem.points.iter();
                    all.position(|p| p.name == name).unwrap()
                });
                let mut kept = edited.orientations.kept.iter();
                assert!(kept.any(|(set, _)| set == &points), "{names:?}");
            }
            let cosine = |[a, b]: [&str; 2], [c, d]: [&str; 2]| {
                let from = |a: &str, b: &str| {
                    let (p, q) = (place(&session, a), place(&session, b));
                    [q[0] - p[0], q[1] - p[1]]
                };
                let (u, v) = (from(a, b), from(c, d));
                (u[0] * v[0] + u[1] * v[1]) / (u[0].hypot(u[1]) * v[0].hypot(v[1]))
            };
            let one = cosine(["r006.1", "r006.2"], ["r009.1", "r009.2"]);
            let two = cosine(["r004.1", "r004.2"], ["r007.1", "r007.2"]);
            assert!((one + two).abs() < 1e-9, "{one} {two}");
        }
    }
    let text = bracket_with(&[
        (
            "0d",
            "type=34 valA=15.0 ptA.v=00080001 ptB.v=00040002 entityA.v=00020020",
        ),
        (
            "01",
            "type=60 ptA.v=00040001 ptB.v=00040002 entityA.v=00020000",
        ),
    ]);
    let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
    assert!(
        sketch.problem.kept.kinds.is_empty(),
        "{:?}",
        sketch.problem.kept.kinds
    );
    let kinds = |kind: &str| {
        let all = sketch.problem.constraints.iter();
        all.filter(|c| c.kind == kind).count()
    };
    assert_eq!((kinds("dx"), kinds("symmetric")), (1, 1));
    // Of zero nothing tells the sign in the file.
    let zero = "type=34 ptA.v=00080001 ptB.v=00040002 entityA.v=00020020";
    let text = bracket_with(&[("0d", zero)]);
    let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
    assert!(sketch.problem.kept.kinds.contains_key("PROJ_PT_DISTANCE"));
}

/// A constraint further down the file names a point of another group that is far away: coordinates that are made equal
/// may move as much farther, and the figure tells of no angle any more which one is meant.
#[test]
fn points_that_are_read_late_count_for_what_is_certain() {
    let angles = "type=54 entityA.v=00060000 entityB.v=00090000 entityC.v=00040000 entityD.v=00070000 other=1";
    let text = bracket_with(&[
        ("11", angles),
        ("12", "type=20 ptA.v=00040001 ptB.v=00990001"),
    ]);
    let read = |x: &str| {
        let far = format!(
            "Entity.h.v=00990001\nEntity.type=2000\nEntity.construction=0\nEntity.actPoint.x={x}\nAddEntity\n"
        );
        let text = format!("{text}\n{far}");
        let sketch = import::read(BRACKET, text.as_bytes(), None).unwrap();
        assert!(!sketch.problem.kept.kinds.contains_key("POINTS_COINCIDENT"));
        sketch.problem.kept.kinds.contains_key("EQUAL_ANGLE")
    };
    assert!(!read("60.0"));
    assert!(read("1000000.0"));
}

const WATER: &str =
    "3\nwater\nO 0.0000 0.0000 0.1173\nH 0.0000 0.7572 -0.4692\nH 0.0000 -0.7572 -0.4692\n";
const CHIRAL: &str = "5\nbromochlorofluoromethane\nC 0 0 0\nH 0.63 0.63 0.63\nF -0.78 -0.78 0.78\n\
                      Cl 1.0 -1.03 -1.0\nBr -1.1 1.1 -1.13\n";
const CHAIR: &str = "6\ncyclohexane, carbon only\nC 1.46400 0.00000 0.25000\nC 0.73200 1.26786 -0.25000\n\
                     C -0.73200 1.26786 0.25000\nC -1.46400 0.00000 -0.25000\nC -0.73200 -1.26786 0.25000\n\
                     C 0.73200 -1.26786 -0.25000\n";

/// Water has two bonds of one length: the path goes round all the same. The chair of cyclohexane is proved where the sketch
/// leads; its path then comes to figures that can move, which is said.
#[test]
fn molecules_are_solved_or_it_is_said_why_not() {
    use assert_cmd::Command;
    let folder = tempfile::tempdir().unwrap();
    let solve = |text: &str, options: &[&str]| {
        let file = folder.path().join("molecule.xyz");
        std::fs::write(&file, text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let command = command.arg("solve").arg(&file).args(options);
        let output = command.output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), text)
    };
    let (code, text) = solve(WATER, &[]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.starts_with("water: Closed, proved"), "{text}");
    let (code, text) = solve(CHAIR, &["--first"]);
    assert_eq!(code, Some(0), "{text}");
    let (code, text) = solve(CHAIR, &[]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("the figure appears to be flexible"), "{text}");
    assert!(text.contains("reached without a fold"), "{text}");
}

/// The four neighbours of a stereo centre keep their handedness in an edit, by proof, and it is said which.
#[test]
fn chirality_is_kept_and_named() {
    let sketch = import::read("chiral.xyz", CHIRAL.as_bytes(), None).unwrap();
    let mut session = Session::open(&sketch.problem).unwrap();
    let edited = edit(&mut session, "C1-Br5=2");
    assert_eq!(edited.ending, Ending::Reached);
    let kept = &edited.orientations.kept;
    assert_eq!((kept.len(), edited.orientations.lost.len()), (5, 0));
    for (points, sign) in kept {
        let at: Vec<[f64; 3]> = points
            .iter()
            .map(|&p| place(&session, &sketch.problem.points[p].name))
            .collect();
        let side = |k: usize| -> [f64; 3] { std::array::from_fn(|axis| at[k][axis] - at[0][axis]) };
        let (u, v, w) = (side(1), side(2), side(3));
        let volume = u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0]);
        assert_eq!(volume > 0.0, *sign > 0);
    }
    // The centre and three of its neighbours are among them.
    assert!(kept.iter().any(|(points, _)| points == &[0, 1, 2, 3]));
}
