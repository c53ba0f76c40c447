//! What sketches of other programs mean beside their equations: which of two angles, which way round arcs and lines go, what is tied
//! by expressions, in which plane things are.

use crate::common::wanted;
use krawl::edit::{End, Ending, Session, Setting, rewrite};
use krawl::import::{self, Figure, Imported};
use krawl::problem::{Decimal, Problem, Shape};
use krawl::system::Located;
use krawl::track::{Control, StopKind};
use std::path::PathBuf;

/// A sketch of a file, in whatever format.
pub struct File {
    name: String,
    bytes: Vec<u8>,
    imported: Option<Imported>,
    pub problem: Problem,
}

impl File {
    pub fn new(name: &str, bytes: Vec<u8>, sketch: Option<&str>) -> Self {
        let imported = match name.ends_with("toml") {
            true => None,
            false => Some(import::read(name, &bytes, sketch).unwrap()),
        };
        let problem = match &imported {
            Some(imported) => imported.problem.clone(),
            None => Problem::parse_loosely(std::str::from_utf8(&bytes).unwrap(), name).unwrap(),
        };
        File {
            name: name.to_owned(),
            bytes,
            imported,
            problem,
        }
    }

    fn shipped(name: &str, sketch: Option<&str>) -> Self {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("problems/sketches");
        Self::new(name, std::fs::read(folder.join(name)).unwrap(), sketch)
    }

    /// The file after an edit, read again.
    pub fn edited(&self, set: &str) -> Self {
        let mut session = Session::open(&self.problem).unwrap();
        let setting = [Setting::parse(&self.problem, set).unwrap()];
        let edited = session.edit(&setting);
        assert_eq!(edited.ending, Ending::Reached, "{}: {set}", self.name);
        let (points, objects) = (session.figure(), session.objects());
        let radius = |object: &Located| object.number().map_or(0.0, |radius| radius.mid());
        let radii: Vec<f64> = objects.iter().map(radius).collect();
        let changed = Setting::applied(&setting, &self.problem);
        let bytes = match &self.imported {
            Some(imported) => {
                let figure = Figure {
                    points: &points,
                    radii: &radii,
                };
                import::rewrite(imported, &self.bytes, &changed, &figure).unwrap()
            }
            None => {
                let text = std::str::from_utf8(&self.bytes).unwrap();
                rewrite(text, &changed, &points, &objects)
                    .unwrap()
                    .into_bytes()
            }
        };
        Self::new(
            &self.name,
            bytes,
            Some(&self.problem.name)
                .filter(|_| self.imported.is_some())
                .map(String::as_str),
        )
    }

    fn figure(&self) -> Vec<[f64; 3]> {
        Session::open(&self.problem).unwrap().figure()
    }

    pub fn at(&self, point: &str) -> [f64; 2] {
        let p = self.problem.points.iter().position(|p| p.name == point);
        let [x, y, _] = self.figure()[p.unwrap()];
        [x, y]
    }
}

fn apart(one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
    let pairs = one.iter().flatten().zip(other.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// 90 and then 80 is what 80 at once is: in one session, and through files.
fn right_angle(file: &File, dimension: &str) {
    let set = |degrees: &str| format!("{dimension}={degrees}");
    let at_once = file.edited(&set("80"));
    let on_the_way = file.edited(&set("90"));
    let through_files = on_the_way.edited(&set("80"));
    assert!(
        apart(&at_once.figure(), &through_files.figure()) < 1e-6,
        "{}",
        file.name
    );
    let mut session = Session::open(&file.problem).unwrap();
    for degrees in ["90", "80"] {
        let edited = session.edit(&[Setting::parse(&file.problem, &set(degrees)).unwrap()]);
        assert_eq!(edited.ending, Ending::Reached);
    }
    assert!(
        apart(&at_once.figure(), &session.figure()) < 1e-6,
        "{}",
        file.name
    );
    // From 90 down is not from 90 up.
    let up = on_the_way.edited(&set("100"));
    assert!(apart(&up.figure(), &at_once.figure()) > 1e-3);
}

#[test]
fn a_right_angle_of_solvespace_is_the_one_of_the_file() {
    right_angle(&File::shipped("bracket.slvs", None), "c011");
    // The same with the first line reversed by a flag, so that the angle is the other one.
    let text = String::from_utf8_lossy(
        &std::fs::read(
            PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("problems/sketches/bracket.slvs"),
        )
        .unwrap(),
    )
    .into_owned();
    let at = text.find("Constraint.h.v=00000011").unwrap();
    let (head, tail) = text.split_at(at);
    let tail = tail
        .replacen("valA=60.0", "valA=120.0", 1)
        .replacen("other=0", "other=1", 1);
    let flagged = File::new("bracket.slvs", (head.to_owned() + &tail).into_bytes(), None);
    right_angle(&flagged, "c011");
    let plain = File::shipped("bracket.slvs", None).edited("c011=100");
    let same = flagged.edited("c011=90").edited("c011=80");
    assert!(apart(&plain.figure(), &same.figure()) < 1e-6);
}

#[test]
fn a_right_angle_of_a_problem_file_is_told_by_the_ends() {
    for (line, degrees) in [
        (r#"["a", "b"]"#, "60"),
        (r#"["b", "a"]"#, "120"),
        (r#"["a", "b"]"#, "120"),
    ] {
        for apex in ["[-1, 1.73]", "[1, 1.73]"] {
            let text = format!(
                "name = \"angle\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = {apex}\n[lines]\nl = {line}\nm = [\"a\", \"c\"]\n\
                 [constraints]\nfixed = [\"a\"]\nhorizontal = [\"l\"]\ndistances = [[\"a\", \"b\", 4], [\"a\", \"c\", 2]]\n\
                 angles = [[\"l\", \"m\", {degrees}]]\n"
            );
            right_angle(
                &File::new("angle.toml", text.into_bytes(), None),
                "angles:l-m",
            );
        }
    }
}

const DRIVEN: &str = r#"name = "driven"
dimension = 2
[points]
O = [0, 0]
s = [9.8, 2]
e = [9.2, 4]
a = [1, -3]
b = [5, -3]
[lines]
base = ["a", "b"]
[arcs]
arc = { center = "O", start = "s", end = "e" }
[constraints]
fixed = ["O"]
radii = [["arc", 10]]
dy = [["O", "s", 2], ["O", "e", 4], ["O", "a", -3]]
dx = [["O", "a", 1], ["a", "b", 4]]
horizontal = ["base"]
"#;

/// That an edit ends where an arc or line vanishes, at `value`, and so do limits and sweeps.
fn vanishes(problem: &Problem, dimension: &str, to: &str, value: f64) {
    let mut session = Session::open(problem).unwrap();
    let before = session.figure();
    let setting = Setting::named(problem, dimension, to).unwrap();
    let edited = session.edit(std::slice::from_ref(&setting));
    let Ending::Stopped(stop) = &edited.ending else {
        panic!("{dimension} = {to}: {:?}", edited.ending);
    };
    assert_eq!(stop.kind, StopKind::Vanishes, "{stop}");
    let there = edited.dimensions[0].value;
    assert!((there.mid() - value).abs() < 1e-6, "{there:?}");
    assert_eq!(session.figure(), before, "the figure stays what it is");
    let range = session.range(setting.index, &mut Control::default());
    let ends = [&range.low, &range.high];
    let is_end = |end: &&&End| (end.value().mid() - value).abs() < 1e-6;
    let end = ends.iter().find(is_end).expect("an end of the range");
    assert!(
        matches!(end, End::Unknown(_, why) if why.contains("shrinks to nothing")),
        "{end:?}"
    );
    let from: Decimal = session
        .length(setting.index)
        .mid()
        .to_string()
        .parse()
        .unwrap();
    let swept = session.sweep(
        setting.index,
        (&from, &to.parse().unwrap()),
        12,
        &mut Control::default(),
    );
    let end = swept.end.expect("the sweep ends");
    assert!(matches!(end.ending, Ending::Stopped(stop) if stop.kind == StopKind::Vanishes));
}

#[test]
fn an_arc_that_shrinks_to_nothing_ends_the_edit() {
    let problem = Problem::parse_loosely(DRIVEN, "driven.toml").unwrap();
    vanishes(&problem, "dy:O-s", "5", 4.0);
    vanishes(&problem, "dy:O-e", "-1", 2.0);
    // Drawn the other way round, it is nearly a whole circle, and becomes one.
    let whole = DRIVEN.replace(r#"start = "s", end = "e""#, r#"start = "e", end = "s""#);
    let problem = Problem::parse_loosely(&whole, "driven.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "dy:O-s=5").unwrap()]);
    assert!(
        matches!(&edited.ending, Ending::Stopped(stop) if stop.contains("whole circle")),
        "{:?}",
        edited.ending
    );
    // Through half a circle it goes.
    let half = DRIVEN
        .replace("e = [9.2, 4]", "e = [-9.8, -1.5]")
        .replace(r#"["O", "e", 4]"#, r#"["O", "e", -1.5]"#);
    let problem = Problem::parse_loosely(&half, "driven.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "dy:O-s=1").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
}

#[test]
fn a_line_along_an_axis_that_shrinks_to_nothing_ends_the_edit() {
    // The line's other end stands still: not the line's own length is set.
    let text = DRIVEN.replace(r#"["a", "b", 4]"#, r#"["O", "b", 5]"#);
    let problem = Problem::parse_loosely(&text, "driven.toml").unwrap();
    vanishes(&problem, "dx:O-a", "7", 5.0);
    vanishes(&problem, "dx:O-b", "-2", 1.0);
}

#[test]
fn a_length_with_a_sign_may_be_set_to_the_other() {
    let problem = Problem::parse_loosely(DRIVEN, "driven.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "dx:a-b=-4").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
}

#[test]
fn what_has_no_number_cannot_be_set() {
    let named =
        |problem: &Problem, name: &str| Setting::named(problem, name, "3").unwrap_err().to_string();
    let bracket = File::shipped("bracket.slvs", None).problem;
    let without = bracket.labels.iter().find(|(index, _)| {
        index
            .checked_sub(bracket.distances.len())
            .is_some_and(|c| bracket.constraints[c].value.is_none())
    });
    assert!(named(&bracket, without.unwrap().1).contains("without a number"));
    let driven = Problem::parse_loosely(DRIVEN, "driven.toml").unwrap();
    assert!(named(&driven, "horizontal:base").contains("without a number"));
}

#[test]
fn planes_of_solvespace_are_turned_and_not_stretched() {
    let file = File::shipped("bracket.slvs", None);
    let text = String::from_utf8_lossy(&file.bytes).into_owned();
    // The normal of the work plane, of length 1 to five digits.
    let mut stretched = String::new();
    for line in text.split_inclusive('\n') {
        match line.trim_end().strip_prefix("Entity.actNormal.") {
            Some(rest) => {
                let (key, value) = rest.split_once('=').unwrap();
                let value: f64 = value.parse().unwrap();
                stretched += &format!("Entity.actNormal.{key}={:.20}\n", value * 1.00001);
            }
            None => stretched += line,
        }
    }
    let other = File::new("bracket.slvs", stretched.into_bytes(), None);
    assert!(apart(&file.figure(), &other.figure()) < 1e-12);
    let (before, after) = (
        String::from_utf8_lossy(&other.bytes),
        other.edited("c010=11").bytes,
    );
    let after = String::from_utf8_lossy(&after).into_owned();
    let number = |line: &str| -> f64 { line.split_once('=').unwrap().1.parse().unwrap() };
    let pairs = before.lines().zip(after.lines());
    // What does not move in the plane does not move in space, where its stretched place was another by up to 1e-5 of its size.
    for (a, b) in pairs.filter(|(a, b)| a != b && a.contains("actPoint")) {
        let moved = (number(a) - number(b)).abs();
        assert!(!(1e-9..1e-2).contains(&moved), "{a} is {b} then");
    }
}

#[test]
fn distances_in_space_and_sketches_without_an_active_plane_are_read() {
    let file = File::shipped("bracket.slvs", None);
    let text = String::from_utf8_lossy(&file.bytes).into_owned();
    let at = text.find("Constraint.h.v=0000000a").unwrap();
    let (head, tail) = text.split_at(at);
    let in_space = head.to_owned() + &tail.replacen("Constraint.workplane.v=80020000\n", "", 1);
    let without = text.replace("Group.activeWorkplane.v=80020000\n", "");
    assert!(in_space != text && without != text);
    for text in [in_space, without] {
        let other = File::new("bracket.slvs", text.into_bytes(), None);
        assert!(
            other
                .imported
                .as_ref()
                .unwrap()
                .problem
                .kept
                .kinds
                .is_empty()
        );
        assert_eq!(file.problem.distances, other.problem.distances);
        assert!(
            apart(
                &file.edited("c00a=36").figure(),
                &other.edited("c00a=36").figure()
            ) < 1e-9
        );
    }
}

#[cfg(feature = "freecad")]
pub mod freecad {
    use super::*;
    use std::io::{Cursor, Write};
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    /// A document with these objects: types, names, and what they have.
    pub fn archive(objects: &[(&str, &str, &str)]) -> Vec<u8> {
        let all = |one: &dyn Fn(&(&str, &str, &str)) -> String| -> String {
            objects.iter().map(one).collect()
        };
        let declared = all(&|(kind, name, _)| format!("<Object type=\"{kind}\" name=\"{name}\"/>"));
        let data = all(&|(_, name, of)| {
            format!("<Object name=\"{name}\"><Properties>{of}</Properties></Object>")
        });
        let text = format!(
            "<?xml version='1.0' encoding='utf-8'?><Document><Objects>{declared}</Objects><ObjectData>{data}</ObjectData></Document>"
        );
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        archive
            .start_file("Document.xml", SimpleFileOptions::default())
            .unwrap();
        archive.write_all(text.as_bytes()).unwrap();
        archive.finish().unwrap().into_inner()
    }

    /// What a sketch has.
    pub fn sketch(constraints: &str, geometry: &str, expressions: &str) -> String {
        format!(
            "<Property name=\"Constraints\"><ConstraintList>{constraints}</ConstraintList></Property>\
             <Property name=\"Geometry\"><GeometryList>{geometry}</GeometryList></Property>\
             <Property name=\"ExpressionEngine\"><ExpressionEngine>{expressions}</ExpressionEngine></Property>"
        )
    }

    /// A sketch is found by what FreeCAD shows for its name, if no other one is called so.
    #[test]
    fn sketches_are_found_by_their_labels() {
        let line = "<Geometry type=\"Part::GeomLineSegment\"><LineSegment StartX=\"0\" StartY=\"0\" EndX=\"4\" EndY=\"1\"/></Geometry>";
        let labelled = |label: &str| {
            let label = format!("<Property name=\"Label\"><String value=\"{label}\"/></Property>");
            label + &sketch("", line, "")
        };
        let kind = "Sketcher::SketchObject";
        let [one, other, same] = ["Big Plate", "Lid", "Lid"].map(labelled);
        let bytes = archive(&[(kind, "A", &one), (kind, "B", &other), (kind, "C", &same)]);
        let read = |name: &str| krawl::import::read("f.FCStd", &bytes, Some(name));
        assert_eq!(
            read("Big Plate").unwrap().problem,
            read("A").unwrap().problem
        );
        let error = read("Lid").unwrap_err().to_string();
        assert!(
            error.contains("A (\"Big Plate\"), B (\"Lid\"), C (\"Lid\")"),
            "{error}"
        );
    }

    /// A document with one sketch.
    fn document(constraints: &str, geometry: &str, expressions: &str) -> File {
        let sketch = sketch(constraints, geometry, expressions);
        let bytes = archive(&[("Sketcher::SketchObject", "Sketch", &sketch)]);
        File::new("sketch.FCStd", bytes, None)
    }

    pub fn line([a, b, c, d]: [f64; 4]) -> String {
        format!(
            "<Geometry type=\"Part::GeomLineSegment\"><LineSegment StartX=\"{a}\" StartY=\"{b}\" StartZ=\"0\" EndX=\"{c}\" \
             EndY=\"{d}\" EndZ=\"0\"/></Geometry>"
        )
    }

    /// A constraint: name, type, value, and three pairs of geometry and position.
    pub fn constraint(name: &str, kind: u32, value: f64, on: &[(i32, i32)]) -> String {
        let side = |k: usize| on.get(k).copied().unwrap_or((-2000, 0));
        let ((f, fp), (s, sp), (t, tp)) = (side(0), side(1), side(2));
        format!(
            "<Constrain Name=\"{name}\" Type=\"{kind}\" Value=\"{value:.16}\" First=\"{f}\" FirstPos=\"{fp}\" Second=\"{s}\" \
             SecondPos=\"{sp}\" Third=\"{t}\" ThirdPos=\"{tp}\" IsDriving=\"1\" IsActive=\"1\"/>"
        )
    }

    #[test]
    fn a_right_angle_is_between_the_ends_that_are_named() {
        // The first line begins or ends at the corner, and the angle is named there or at its other end.
        for (ends, corner, named) in [
            ([20.0, 0.0, 0.0, 0.0], 2, 2),
            ([20.0, 0.0, 0.0, 0.0], 2, 1),
            ([0.0, 0.0, 20.0, 0.0], 1, 1),
            ([0.0, 0.0, 20.0, 0.0], 1, 2),
        ] {
            let constraints = [
                constraint("", 1, 0.0, &[(0, corner), (-1, 1)]),
                constraint("", 1, 0.0, &[(1, 1), (-1, 1)]),
                constraint("", 13, 0.0, &[(0, 3 - corner), (-1, 0)]),
                constraint("len", 6, 20.0, &[(0, 0)]),
                constraint("len2", 6, 15.0, &[(1, 0)]),
                constraint(
                    "corner",
                    9,
                    std::f64::consts::FRAC_PI_2,
                    &[(0, named), (1, 1)],
                ),
            ];
            let geometry = line(ends) + &line([0.0, 0.0, 0.0, 15.0]);
            let file = document(&constraints.concat(), &geometry, "");
            let edited = file.edited("corner=80");
            let [x, y] = edited.at("e2.end");
            let degrees = y.atan2(x).to_degrees();
            // Away from the corner it is 80 degrees; towards it, from the other end, what is left of 180.
            let wanted = if named == corner { 80.0 } else { 100.0 };
            assert!(
                (degrees - wanted).abs() < 1e-9,
                "{ends:?} {named}: {degrees}"
            );
            right_angle(&edited, "corner");
        }
    }

    #[test]
    fn an_arc_that_shrinks_to_nothing_ends_the_edit() {
        let (start, end) = (0.2f64.asin(), 0.4f64.asin());
        let geometry = format!(
            "<Geometry type=\"Part::GeomArcOfCircle\"><ArcOfCircle CenterX=\"0\" CenterY=\"0\" CenterZ=\"0\" NormalX=\"0\" NormalY=\"0\" \
             NormalZ=\"1\" AngleXU=\"0\" Radius=\"10\" StartAngle=\"{start:.16}\" EndAngle=\"{end:.16}\"/></Geometry>"
        );
        let constraints = [
            constraint("", 1, 0.0, &[(0, 3), (-1, 1)]),
            constraint("R", 11, 10.0, &[(0, 0)]),
            constraint("lower", 8, 2.0, &[(-1, 1), (0, 1)]),
            constraint("upper", 8, 4.0, &[(-1, 1), (0, 2)]),
        ];
        let file = document(&constraints.concat(), &geometry, "");
        vanishes(&file.problem, "lower", "5", 4.0);
        file.edited("lower=3.9");
    }
}

/// The angle of each arc and the length of each line along its axis, where it has one: what must not change its sign.
fn senses(problem: &Problem, figure: &[[f64; 3]]) -> Vec<Option<f64>> {
    let of = |shape: &Shape| match *shape {
        Shape::Arc { center, start, end } => {
            let [[ux, uy], [vx, vy]] = [start, end].map(|p| {
                let ([x, y, _], [cx, cy, _]) = (figure[p], figure[center]);
                [x - cx, y - cy]
            });
            let angle = (ux * vy - uy * vx).atan2(ux * vx + uy * vy);
            Some(angle.rem_euclid(std::f64::consts::TAU))
        }
        Shape::Line([a, b]) => {
            let [dx, dy] = [0, 1].map(|axis| figure[b][axis] - figure[a][axis]);
            match (dx == 0.0, dy == 0.0) {
                (true, false) => Some(dy),
                (false, true) => Some(dx),
                _ => None,
            }
        }
        _ => None,
    };
    problem
        .objects
        .iter()
        .map(|object| of(&object.shape))
        .collect()
}

/// Every dimension of a sketch out and back, and in two steps: the same figures as in one step, and no arc or line turned round. What
/// was edited, and what is wrong.
fn there_and_back(problem: &Problem, factors: &[f64]) -> (usize, Vec<String>) {
    let Ok(mut session) = Session::open(problem) else {
        return (0, Vec::new());
    };
    let (first, mut wrong, mut count) = (session.figure(), Vec::new(), 0);
    let size = first
        .iter()
        .flatten()
        .fold(1e-9f64, |most, x| most.max(x.abs()));
    let dimensions: Vec<usize> = problem.dimensions().collect();
    for index in dimensions {
        let now = session.length(index).mid();
        if now == 0.0 {
            continue;
        }
        let name = problem.dimension_name(index);
        let decimal = |x: f64| format!("{x:.9e}").parse::<Decimal>().unwrap();
        let is_of_sign = matches!(
            index
                .checked_sub(problem.distances.len())
                .map(|c| problem.constraints[c].kind.as_str()),
            Some("dx" | "dy" | "x" | "y" | "along")
        );
        for &factor in factors {
            if factor < 0.0 && !is_of_sign {
                continue;
            }
            let set = |x: f64| Setting::new(problem, index, decimal(x)).map(|setting| [setting]);
            let (Ok(out), Ok(half), Ok(back)) =
                (set(now * factor), set(0.5 * now * (1.0 + factor)), set(now))
            else {
                continue;
            };
            let at_once = session.edit(&out);
            if at_once.ending != Ending::Reached {
                continue;
            }
            count += 1;
            let there = session.figure();
            let (before, after) = (senses(problem, &first), senses(problem, &there));
            for (k, pair) in before.iter().zip(&after).enumerate() {
                let (&Some(a), &Some(b)) = (&pair.0, &pair.1) else {
                    continue;
                };
                // An arc that comes out on the other side jumps by nearly a whole turn.
                let is_arc = matches!(problem.objects[k].shape, Shape::Arc { .. });
                if (is_arc && (a - b).abs() > 5.5) || (!is_arc && factor > 0.0 && a * b < 0.0) {
                    wrong.push(format!(
                        "{name} x {factor}: {} is turned round",
                        problem.objects[k].name
                    ));
                }
            }
            if session.edit(&back).ending != Ending::Reached
                || apart(&session.figure(), &first) > 1e-6 * size
            {
                wrong.push(format!("{name} x {factor}: does not come back"));
                session = Session::open(problem).unwrap();
                continue;
            }
            let steps = [session.edit(&half), session.edit(&out)];
            let is_reached = steps.iter().all(|step| step.ending == Ending::Reached);
            if !is_reached || apart(&session.figure(), &there) > 1e-6 * size {
                wrong.push(format!(
                    "{name} x {factor}: in two steps it is another figure"
                ));
            }
            if session.edit(&back).ending != Ending::Reached {
                session = Session::open(problem).unwrap();
            }
        }
    }
    (count, wrong)
}

#[test]
fn edits_go_back_and_do_not_depend_on_their_steps() {
    let mut sketches = vec![File::shipped("bracket.slvs", None).problem];
    if cfg!(feature = "freecad") {
        let name = "parts.FCStd";
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("problems/sketches");
        let bytes = std::fs::read(folder.join(name)).unwrap();
        for listed in import::list(name, &bytes).unwrap() {
            let read = import::read(name, &bytes, Some(&listed.name)).unwrap();
            if read.problem.kept.kinds.is_empty() {
                sketches.push(read.problem);
            }
        }
    }
    for problem in sketches {
        let (count, wrong) = there_and_back(&problem, &[1.07, 0.9, 1.6]);
        assert!(
            count > 0 && wrong.is_empty(),
            "{}: {count} edits, {wrong:#?}",
            problem.name
        );
    }
}

/// The same of all sketches in a folder, KRAWL_SKETCHES, of which KRAWL_COUNT are taken.
#[test]
#[ignore = "takes minutes, and a folder of sketches"]
fn edits_of_many_sketches_go_back() {
    let Some(folder) = std::env::var_os("KRAWL_SKETCHES") else {
        println!("skipped: set KRAWL_SKETCHES");
        return;
    };
    let most = wanted("KRAWL_COUNT", usize::MAX);
    let (mut files, mut total, mut troubles) = (Vec::new(), 0, 0);
    for kind in ["slvs", "freecad"] {
        let entries = std::fs::read_dir(PathBuf::from(&folder).join(kind))
            .into_iter()
            .flatten();
        files.extend(entries.map(|entry| entry.unwrap().path()));
    }
    files.sort();
    for file in files.iter().take(most) {
        let (name, bytes) = (file.display().to_string(), std::fs::read(file).unwrap());
        for listed in import::list(&name, &bytes).unwrap_or_default() {
            let Ok(read) = import::read(&name, &bytes, Some(&listed.name)) else {
                continue;
            };
            if !read.problem.kept.kinds.is_empty() || read.problem.objects.len() > 60 {
                continue;
            }
            let (count, wrong) = there_and_back(&read.problem, &[1.07, 0.9, 2.5, 0.2, -0.5]);
            total += count;
            troubles += wrong.len();
            for what in wrong {
                println!("{name}, {}: {what}", listed.name);
            }
        }
    }
    println!("{total} edits, {troubles} troubles");
    assert_eq!(troubles, 0);
}
