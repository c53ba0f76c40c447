//! Joints on the command line: what is wrong with them is said with its place, and figures are written into the file.

use crate::krawl;
use std::fs;

fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let (code, text, error) = krawl(arguments);
    (code, text + &error)
}

const SLIDER: &str = "docs/examples/slider-crank.toml";

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("linkage.toml");
    let file = file.to_str().unwrap();
    let text = fs::read_to_string(SLIDER).unwrap();
    for (old, new, words) in [
        (
            "A = { revolute",
            "A = { hinge",
            "linkage.toml:18: joints.A: must be { revolute",
        ),
        (
            "[\"rod\", \"slide\"]",
            "[\"rod\", \"slid\"]",
            "linkage.toml:19: joints: the joint `B`: there is no point or object `slid`; did you mean `slide`?",
        ),
        (
            "[points]\n",
            "[points]\nZ = [0, 0]\n# ",
            "there is no point `G`; a point of the body `ground` stands under `points` as well, where it is drawn",
        ),
        (
            "[\"rod\", \"slide\"]",
            "[\"rod\"]",
            "joints.B: must be { revolute",
        ),
        (
            "[\"rod\", \"slide\"]",
            "[\"rod\", \"rod\"]",
            "linkage.toml:19: joints: the joint `B`: a joint is of two bodies",
        ),
        (
            "[\"rod\", \"slide\"]",
            "[\"rod\", \"A\"]",
            "a joint is of two bodies",
        ),
        (
            "prismatic",
            "cylindrical",
            "in the plane there are revolute, prismatic and rigid joints",
        ),
        (
            "[[3, 0], [0, 0]]",
            "[[3, 0]]",
            "joints.B: must be { revolute",
        ),
        ("[[3, 0], [0, 0]]", "[[3, 0], [0, \"a\"]]", "joints.B.at"),
        (
            "sketch = 3.8 }",
            "sketch = 3.8, x = [[0, 0], [1, 0]] }",
            "the joint `S`: its z axis and its x axis are parallel, or one of them is zero",
        ),
        (
            "[[\"O\", 30]]",
            "[[\"S\", 30]]",
            "the joint does not turn about one axis",
        ),
        (
            "turns = [[\"O\", 30]]",
            "travels = [[\"O\", 30]]",
            "the joint does not travel",
        ),
        ("[constraints]", "[constraints]\nfixed = [\"O\"]", "fixed"),
        (
            "[joints]",
            "[places]\nslid = { at = [1, 2] }\n[joints]",
            "linkage.toml:17: the table of places: there is no body `slid`; did you mean `slide`?",
        ),
        (
            "[joints]",
            "[places]\nG = { at = [1, 2] }\n[joints]",
            "linkage.toml:17: the table of places: there is no body `G`",
        ),
        (
            "[joints]",
            "[places]\nslide = { to = [1, 2] }\n[joints]",
            "places.slide.to: there is no such key",
        ),
        (
            "[joints]",
            "[robots]\nr = []\n[joints]",
            "robots.r: must be a row for each joint",
        ),
        (
            "[joints]",
            "[robots]\nr = [{ e = 2 }]\n[joints]",
            "robots.r.e: there is no such key",
        ),
        (
            "crank = { P = [1, 0] }",
            "crank = { Q = [1, 0] }",
            "there is no point `Q`",
        ),
    ] {
        assert!(text.contains(old), "{old}");
        fs::write(file, text.replacen(old, new, 1)).unwrap();
        for verb in ["check", "all", "solve", "edit"] {
            let arguments = match verb {
                "edit" => vec![verb, file, "--set", "turns:O=40"],
                _ => vec![verb, file],
            };
            let (code, said) = run(&arguments);
            assert_eq!(code, Some(2), "{new}: {said}");
            if verb == "check" {
                assert!(said.contains(words), "{new}: {said}");
            }
        }
    }
}

#[test]
fn a_figure_that_is_taken_is_the_sketch_of_the_file() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out.toml");
    let out = out.to_str().unwrap();
    let (code, said) = run(&["all", SLIDER, "--pick", "1", "--out", out]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("joint O: turned by 30."), "{said}");
    let written = fs::read_to_string(out).unwrap();
    assert!(
        written.contains("[places]\ncrank = { at = [0.0, 0.0"),
        "{written}"
    );
    // The places there are the places read: nothing has to move, and they are put in place of each other.
    let (code, said) = run(&["edit", out, "--set", "O=60", "--out", out]);
    assert_eq!(code, Some(0), "{said}");
    let moved = said.split("moved by more than ").nth(1);
    assert!(
        moved.is_none_or(|by| by.contains("e-15") || by.contains("e-16")),
        "{said}"
    );
    let again = fs::read_to_string(out).unwrap();
    assert_eq!(again.matches("[places]").count(), 1);
    assert!(again.contains("turns = [[\"O\", 60.0]]"), "{again}");
    assert_eq!(run(&["check", out]).0, Some(0));
    // The sketch is that figure, and so it is the nearest one.
    let (code, said) = run(&["all", out, "--nearest", "--out", out]);
    assert_eq!(code, Some(0), "{said}");
    let taken = fs::read_to_string(out).unwrap();
    let slide = |text: &str| {
        text.lines()
            .find(|l| l.starts_with("slide = { at"))
            .map(|l| l[..24].to_owned())
    };
    assert!(
        slide(&taken).is_some() && slide(&taken) == slide(&again),
        "{taken}"
    );
    // Places that are written in another way are not written wrongly.
    for (old, new) in [
        ("[places]", "[ places ] # here"),
        ("crank = { at", "crank.at"),
        ("[places]\n", "[places.rod]\nx = [1, 0]\n[places.slide]\n"),
    ] {
        let text = again.replacen(old, new, 1);
        fs::write(out, text).unwrap();
        let (code, _) = run(&["edit", out, "--set", "O=50", "--out", out]);
        assert!(
            code == Some(0) || fs::read_to_string(out).unwrap().contains(new),
            "{new}"
        );
        if code == Some(0) {
            assert_eq!(run(&["check", out]).0, Some(0), "{new}");
        }
    }
}

/// A robot in URDF is what the same arm is as a table of Denavit and Hartenberg, and is written as a problem file.
#[test]
fn a_robot_in_urdf_is_read() {
    let directory = tempfile::tempdir().unwrap();
    let (urdf, out) = (
        directory.path().join("arm.urdf"),
        directory.path().join("arm.toml"),
    );
    let (urdf, out) = (urdf.to_str().unwrap(), out.to_str().unwrap());
    let joint = |k: usize, kind: &str, origin: &str, axis: &str| {
        format!(
            "<joint name=\"j{k}\" type=\"{kind}\"><parent link=\"l{}\"/><child link=\"l{k}\"/><origin {origin}/><axis xyz=\"{axis}\"/></joint>\n",
            k - 1
        )
    };
    let links: String = (0..4).map(|k| format!("<link name=\"l{k}\"/>\n")).collect();
    let joints = [
        joint(1, "revolute", "xyz=\"0 0 0.4\"", "0 0 1"),
        joint(2, "revolute", "xyz=\"0 0 0\" rpy=\"1.5708 0 0\"", "0 0 1"),
        joint(3, "revolute", "xyz=\"0.3 0 0\"", "0 0 1"),
    ];
    fs::write(
        urdf,
        format!("<robot name=\"arm\">\n{links}{}</robot>", joints.concat()),
    )
    .unwrap();
    let set = ["--set", "j1=30", "--set", "j2=20", "--set", "j3=-50"];
    let (code, said) = run(&[&["edit", urdf][..], &set, &["--out", out]].concat());
    assert_eq!(code, Some(0), "{said}");
    let table = directory.path().join("table.toml");
    let table = table.to_str().unwrap();
    let text = "name = \"arm\"\ndimension = 3\n[robots]\nl = [{ d = 0.4, alpha = 90 }, { a = 0.3 }]\n\
        [constraints]\nturns = [[\"l_j1\", 30], [\"l_j2\", 20]]\n";
    fs::write(table, text).unwrap();
    let (_, other) = run(&["all", table]);
    // Where the second link of the table ends the third one of the other begins.
    let place = |text: &str, body: &str| -> Vec<f64> {
        let line = text
            .lines()
            .find(|line| line.contains(&format!("body {body}: at ")))
            .unwrap();
        let numbers = line.split(['(', ')']).nth(1).unwrap();
        numbers.split(", ").map(|x| x.parse().unwrap()).collect()
    };
    let (a, b) = (place(&said, "l3"), place(&other, "l_2"));
    assert!(
        a.iter().zip(&b).all(|(x, y)| (x - y).abs() < 1e-9),
        "{said}\n{other}"
    );
    assert_eq!(run(&["check", out]).0, Some(0));
    let (code, said) = run(&["edit", urdf, "--set", "j1=30", "--out", urdf]);
    assert!(
        code == Some(2) && said.contains("give it the ending .toml"),
        "{said}"
    );
    fs::write(urdf, "<robot><link name=\"a\"/></robot>").unwrap();
    let (code, said) = run(&["check", urdf]);
    assert!(
        code == Some(2) && said.contains("there is no joint in it"),
        "{said}"
    );
}

/// Of a planetary gear three turns of four are told by Willis's equation; the fourth may be any of as many as it is taken in quarters.
#[test]
fn gears_turn_as_often_as_their_teeth_say() {
    let file = "docs/examples/planetary-gear.toml";
    let (code, said) = run(&["all", file]);
    assert!(code == Some(0) && said.contains("4 solutions"), "{said}");
    for carrier in ["10.0000", "100.0000", "-80.0000", "-170.0000"] {
        let joint = format!("joint carrier: turned by {carrier}");
        assert!(said.contains(&joint), "{carrier}: {said}");
    }
    // With the sun once round the carrier goes a quarter further, and not anywhere else.
    let (code, said) = run(&["edit", file, "--set", "sun=400", "--set", "ring=-20"]);
    assert!(
        code == Some(0) && said.contains("joint carrier: turned by 85.0000"),
        "{said}"
    );
}

/// A five-bar linkage of which one crank goes twice round, backwards, for each turn of the other one.
#[test]
fn a_geared_linkage_moves_as_its_cranks_do() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("geared.toml");
    let text = "dimension = 2\nequations = [\"10*turn(A) = -20*turn(D)\"]\n[points]\nP = [0, 1]\nQ = [3.5, 1]\nC = [1.8, 3]\n\
        [bodies]\nground = {}\nleft = { P = [1, 0] }\nright = { Q = [1, 0] }\n[joints]\n\
        A = { revolute = [\"ground\", \"left\"], sketch = 80 }\n\
        D = { revolute = [\"ground\", \"right\"], at = [[3, 0], [0, 0]], sketch = -40 }\n\
        [constraints]\ndistances = [[\"P\", \"C\", 2.5], [\"Q\", \"C\", 2.5]]\n";
    fs::write(&file, text).unwrap();
    let apart = |degrees: f64| {
        let (a, d) = ((-2.0 * degrees).to_radians(), degrees.to_radians());
        f64::hypot(3.0 + d.cos() - a.cos(), d.sin() - a.sin())
    };
    let all = (0..360_000).map(|k| apart(f64::from(k) / 1000.0));
    let [least, most] = all.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], x| {
        [low.min(x), high.max(x)]
    });
    let (code, said, _) = krawl(&["motion", file.to_str().unwrap(), "--json", "-"]);
    assert_eq!(code, Some(0), "{said}");
    let result: serde_json::Value = serde_json::from_str(&said).unwrap();
    let is_near = |key: &str, wanted: f64| {
        let bounds = &result["measured"][0][key]["value"];
        (0..2).all(|k| (bounds[k].as_f64().unwrap() - wanted).abs() < 1e-6)
    };
    assert!(
        is_near("least", least) && is_near("greatest", most),
        "{least} {most}: {said}"
    );
}

/// Of a gripper one finger follows the other one, and a slide another slide; nothing follows what moves in another way.
#[test]
fn joints_of_urdf_follow_others() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("gripper.urdf");
    let file = file.to_str().unwrap();
    let joint = |name: &str, kind: &str, ends: [&str; 2], mimic: &str| {
        let [parent, child] = ends;
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <axis xyz=\"1 0 0\"/>{mimic}</joint>\n"
        )
    };
    let gripper = |of_slide: &str| {
        let links = ["palm", "f1", "f2", "s1", "s2"];
        let links: String = links
            .map(|link| format!("<link name=\"{link}\"/>"))
            .concat();
        let finger = "<mimic joint=\"left\" multiplier=\"-0.5\" offset=\"1.5708\"/>";
        let joints = [
            joint("left", "revolute", ["palm", "f1"], ""),
            joint("right", "revolute", ["palm", "f2"], finger),
            joint("out", "prismatic", ["f1", "s1"], ""),
            joint("with", "prismatic", ["f2", "s2"], of_slide),
        ];
        let text = format!("<robot>{links}\n{}</robot>", joints.concat());
        fs::write(file, text).unwrap();
    };
    gripper("<mimic joint=\"out\" multiplier=\"2\" offset=\"0.01\"/>");
    let (code, said) = run(&["edit", file, "--set", "left=30", "--set", "out=0.1"]);
    assert_eq!(code, Some(0), "{said}");
    for wanted in ["right: turned by 75.0000", "with: drawn out by 0.21000"] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    for (mimic, words) in [
        ("<mimic joint=\"left\"/>", "a screw"),
        ("<mimic joint=\"lost\"/>", "no joint that moves by itself"),
        ("<mimic joint=\"out\" offset=\"x\"/>", "offset=\"x\""),
    ] {
        gripper(mimic);
        let (code, said) = run(&["check", file]);
        assert!(code == Some(2) && said.contains(words), "{said}");
        assert!(said.contains("line 5"), "{said}");
    }
}

/// Axes that are parallel but for the fortieth digit are no reason to fail.
#[test]
fn nearly_parallel_axes_are_survived() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("near.toml");
    let near = format!("[1, 1, 1e-{}]", 40);
    let text = format!(
        "dimension = 3\n[bodies]\ng = {{}}\na = {{}}\nb = {{}}\nc = {{}}\n[joints]\n\
         A = {{ spherical = [\"g\", \"a\"] }}\n\
         B = {{ revolute = [\"a\", \"b\"], z = [[1, 1, 0], [1, 1, 0]] }}\n\
         C = {{ revolute = [\"a\", \"c\"], at = [[1, 0, 0], [0, 0, 0]], z = [{near}, {near}] }}\n\
         D = {{ revolute = [\"b\", \"c\"], at = [[0, 1, 0], [0, 1, 0]], z = [{near}, [1, 1, 0]] }}\n"
    );
    fs::write(&file, text).unwrap();
    for verb in ["check", "solve", "all"] {
        let (code, said) =
            run(&[verb, file.to_str().unwrap(), "--time", "2"]
                [..if verb == "check" { 2 } else { 4 }]);
        assert!(code.is_some_and(|code| code != 101), "{said}");
    }
}

/// Paths and sets of figures with joints leave certificates as all others do.
#[test]
fn certificates_of_joints_are_verified() {
    let directory = tempfile::tempdir().unwrap();
    let certificate = directory.path().join("joints.krawl");
    let certificate = certificate.to_str().unwrap();
    for (verb, file) in [
        ("solve", SLIDER),
        ("solve", "docs/examples/ur5.toml"),
        ("all", "docs/examples/ur5.toml"),
    ] {
        let (code, said) = run(&[verb, file, "--cert", certificate]);
        assert_eq!(code, Some(0), "{said}");
        let (code, said) = run(&["verify", certificate, file]);
        assert!(code == Some(0) && said.contains("VERIFIED"), "{said}");
    }
}

/// What a joint, a circle or an unknown has is measured, and stands in the CSV of a sweep: beside formulas.
#[test]
fn numbers_of_objects_are_measured() {
    let (code, said) = run(&[
        "all",
        SLIDER,
        "--measure",
        "travel S",
        "--measure",
        "turn A",
    ]);
    // cos 30° + √(9 − sin² 30°), and −30° − arcsin 1/6.
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("3.82406529") && said.contains("-39.5940682"),
        "{said}"
    );
    let (code, said) = run(&[
        "sweep",
        SLIDER,
        "--vary",
        "turns:O",
        "--from",
        "30",
        "--to",
        "60",
        "--frames",
        "2",
        "--csv",
        "-",
        "--measure",
        "travel S",
    ]);
    let last = said.lines().last().and_then(|line| line.rsplit_once(','));
    let (_, travel) = last.unwrap_or_else(|| panic!("{said}"));
    let travel: f64 = travel.parse().unwrap();
    // cos 60° + √(9 − sin² 60°).
    assert!(
        code == Some(0) && (travel - 3.372281323269014).abs() < 1e-9,
        "{said}"
    );
    let (_, said) = run(&[
        "edit",
        "docs/examples/bracket.toml",
        "--set",
        "width=100",
        "--measure",
        "radius hole",
    ]);
    assert!(said.lines().any(|line| line.trim() == "7.5"), "{said}");
    let (_, said) = run(&[
        "edit",
        "docs/examples/circle-hyperbola.toml",
        "--set",
        "a=5",
        "--measure",
        "value x",
    ]);
    // x² + 1/x² = 5.
    assert!(said.contains("2.1889010593"), "{said}");
    // All the way round the slide goes from 3 − 1 to 3 + 1, and the pin between crank and rod turns once.
    let measures = ["--measure", "turn A", "--measure", "travel S"];
    let motion = [&["motion", SLIDER, "--free", "turns:O"][..], &measures].concat();
    let (code, said) = run(&motion);
    assert!(code == Some(0) && said.contains("a full turn"), "{said}");
    let travel = said
        .lines()
        .find(|line| line.trim().starts_with("travel S"));
    let travel = travel.unwrap_or_else(|| panic!("{said}"));
    let ends: Vec<f64> = travel
        .split_whitespace()
        .skip(2)
        .map(|x| x.parse().unwrap())
        .collect();
    assert!(
        (ends[1] - 2.0).abs() < 1e-6 && (ends[2] - 4.0).abs() < 1e-6,
        "{said}"
    );
    // With the crank's length in its limits the slide's place is the sum of two square roots.
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [1, 0]\nC = [1, 2]\n[circles]\nk = { center = \"C\", radius = 1 }\n\
        [constraints]\nfixed = [\"A\"]\nhorizontal = [[\"A\", \"B\"]]\nvertical = [[\"B\", \"C\"]]\n\
        distances = [[\"A\", \"B\", 1], [\"B\", \"C\", 2], [\"A\", \"k\", 1]]\n[tolerances]\nA-B = 0.1\n\"distances:A-k\" = 0.05\n";
    fs::write(file.path(), text).unwrap();
    let (code, said) = run(&[
        "tolerance",
        file.path().to_str().unwrap(),
        "--measure",
        "radius k",
        "--json",
        "-",
    ]);
    assert_eq!(code, Some(0), "{said}");
    let result: serde_json::Value = serde_json::from_str(said.lines().next().unwrap()).unwrap();
    let told = &result["measured"][0];
    let worst = [f64::hypot(0.9, 2.0) - 1.05, f64::hypot(1.1, 2.0) - 0.95];
    let bounds = |key: &str, k: usize| told[key][k].as_f64().unwrap_or_else(|| panic!("{said}"));
    let [low, high] = [bounds("least", 0), bounds("greatest", 1)];
    assert!(low <= worst[0] && high >= worst[1], "{worst:?}: {said}");
    assert!(
        low > worst[0] - 3e-3 && high < worst[1] + 3e-3,
        "{worst:?}: {said}"
    );
    for (measure, words) in [
        ("turn G", "there is no joint that turns about one axis `G`"),
        (
            "travel O",
            "there is no joint that travels along its axis `O`",
        ),
        ("value O", "there is no unknown `O`"),
    ] {
        let (code, said) = run(&["all", SLIDER, "--measure", measure]);
        assert!(code == Some(2) && said.contains(words), "{said}");
    }
}
