//! Two other checkers of certificates, in Python and in JavaScript, written after `docs/how/certificates.md` and with other
//! methods: intervals of whole numbers, or exact values and small differences in floats, and tubes cut into pieces. The one in JavaScript
//! was written by somebody who had that text alone. Each is left out where there is no Python 3.11, or no Node.js 18.

use crate::common::certificate::{self, Certificate};
use krawl::certificate::{self as proofs, Record};
use krawl::edit::Ending;
use krawl::problem::Problem;
use krawl::track::Options;
use std::process::Command;
use std::sync::{Mutex, OnceLock};

/// What a program prints, or nothing where it does not pass a first test with these arguments, made once, `missing` saying why.
fn printed(
    program: &str,
    (passed, test): (&OnceLock<bool>, [&str; 2]),
    missing: &str,
    arguments: &[&str],
) -> Option<(Option<i32>, String)> {
    let run = |arguments: &[&str]| Command::new(program).args(arguments).output().ok();
    if !passed.get_or_init(|| run(&test).is_some_and(|run| run.status.success())) {
        println!("left out: there is no {missing}");
        return None;
    }
    let run = run(arguments)?;
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    Some((run.status.code(), text))
}

/// What the checker in Python prints, or nothing where it cannot be run.
fn checked(certificate: &str) -> Option<(Option<i32>, String)> {
    static PASSED: OnceLock<bool> = OnceLock::new();
    let arguments = ["tests/independent/checker.py", certificate];
    let missing = "python3 with tomllib (3.11)";
    let test = (&PASSED, ["-c", "import tomllib"]);
    printed("python3", test, missing, &arguments)
}

/// What a script in JavaScript prints, or nothing where it cannot be run.
fn scripted(script: &str, arguments: &[&str]) -> Option<(Option<i32>, String)> {
    static PASSED: OnceLock<bool> = OnceLock::new();
    let script = format!("tests/independent/{script}");
    let is_there = "process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)";
    let arguments = [&[&script[..]], arguments].concat();
    printed(
        "node",
        (&PASSED, ["-e", is_there]),
        "node of version 18 or later",
        &arguments,
    )
}

/// What a checker prints of a certificate in memory, by what it prints of a file.
fn of_bytes<T>(bytes: &[u8], check: impl FnOnce(&str) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("certificate.krawl");
    std::fs::write(&path, bytes).unwrap();
    check(&path.to_string_lossy())
}

/// What the checker in Python prints of a certificate in memory.
fn checked_bytes(bytes: &[u8]) -> Option<(Option<i32>, String)> {
    of_bytes(bytes, checked)
}

/// What the checker in JavaScript prints of a certificate in memory.
fn scripted_bytes(bytes: &[u8]) -> Option<(Option<i32>, String)> {
    of_bytes(bytes, |file| scripted("checker.js", &[file]))
}

/// Files and what the checker in JavaScript has to say of them.
fn are_proved_in_javascript(files: &[(&str, &str)]) {
    for (name, all) in files {
        let Some((code, text)) = scripted("checker.js", &[&format!("certs/{name}.krawl")]) else {
            return;
        };
        assert_eq!(code, Some(0), "{name}: {text}");
        assert_eq!(text.trim(), format!("VERIFIED: {all}"), "{name}");
    }
}

#[test]
fn shipped_certificates_are_proved_in_javascript() {
    are_proved_in_javascript(&[
        ("dodecagon", "40 tubes, 2 solutions in 2 classes, closed"),
        ("k33", "120 tubes, 8 solutions in 8 classes, closed"),
        ("octahedron", "96 tubes, 4 solutions in 4 classes, closed"),
        ("plate-reached", "3 tubes, 2 arcs, reached, reached"),
        ("plate-limit", "6 tubes, 2 arcs, reached, fold"),
    ]);
}

#[test]
#[ignore = "a minute"]
fn long_certificates_are_proved_in_javascript() {
    of_problem_is_checked_in_javascript(
        "problems/constraints/6p7d3a2c-undefined.toml",
        0,
        "0 classes, open",
    );
    are_proved_in_javascript(&[
        ("prism", "100 tubes, 12 solutions in 12 classes, closed"),
        ("disulfide", "157 tubes, 8 solutions in 8 classes, closed"),
        (
            "icosahedron-c1",
            "219 tubes, 8 solutions in 8 classes, closed",
        ),
    ]);
}

/// Damaged certificates of a path and of edits, and files that are damaged; and rewritings of them that are true.
#[test]
fn damaged_certificates_are_refused_in_javascript() {
    damaged_are_refused_in_javascript("certs/plate-limit.krawl");
    let (_, bytes) = certificate::of(&kind("two-triangles"), &Options::certified());
    of_bytes(&bytes, damaged_are_refused_in_javascript);
}

#[test]
#[ignore = "half a minute"]
fn long_certificates_damaged_are_refused_in_javascript() {
    damaged_are_refused_in_javascript("certs/k33.krawl");
}

fn damaged_are_refused_in_javascript(file: &str) {
    let Some((code, text)) = scripted("damage.js", &[file]) else {
        return;
    };
    let unexpected: Vec<&str> = text.lines().filter(|l| l.starts_with("!!")).collect();
    assert_eq!((code, unexpected.len()), (Some(0), 0), "{unexpected:#?}");
    let refused = text.lines().filter(|line| {
        ["REFUTED: ", "NO CERTIFICATE: ", "NOT PROVED: "]
            .iter()
            .any(|v| line.contains(v))
    });
    assert!(refused.count() >= 40, "{text}");
}

/// Paths of some of the kinds of constraints that `docs/how/certificates.md` specifies.
#[test]
fn other_constraints_are_proved_in_javascript() {
    kinds_are_proved_in_javascript(&KINDS[..3]);
}

/// Paths of all others.
#[test]
#[ignore = "half a minute"]
fn more_constraints_are_proved_in_javascript() {
    kinds_are_proved_in_javascript(&KINDS[3..]);
}

/// Of problems in `tests/independent/kinds` the number of solutions on the path, and how it ends.
const KINDS: [(&str, usize, &str); 10] = [
    ("lines-and-planes", 0, "closed"),
    ("two-planes", 2, "closed"),
    ("own-frame", 2, "open"),
    ("own-plane", 0, "closed"),
    ("right-angle", 2, "closed"),
    ("detour", 4, "closed"),
    ("corner", 2, "closed"),
    ("coplanar", 2, "closed"),
    ("parallel-line", 0, "closed"),
    ("skew-lines", 2, "closed"),
];

fn kinds_are_proved_in_javascript(kinds: &[(&str, usize, &str)]) {
    for &(name, solutions, end) in kinds {
        let (_, bytes) = certificate::of(&kind(name), &Options::certified());
        let Some((code, text)) = scripted_bytes(&bytes) else {
            return;
        };
        let tubes = Certificate::read(&bytes).tubes();
        let all = format!("VERIFIED: {tubes} tubes, {solutions} solutions in ");
        assert!(code == Some(0) && text.starts_with(&all), "{name}: {text}");
        assert!(text.trim().ends_with(end), "{name}: {text}");
    }
}

/// What stopped on the way is incomplete, paths and edits; and records of other kinds than those of the shipped certificates.
#[test]
fn what_is_rare_is_checked_in_javascript() {
    let stopped = certificate::of_edits(&kind("triangle"), &[&["a-b-c=130"]]).1;
    is_checked_in_javascript("triangle", &stopped, 4, "2 arcs, reached, stopped");
    for (file, code, end) in [
        ("crossing", 4, "1 classes, stopped"),
        ("lengths-6", 4, "0 classes, stopped"),
        ("flaps-split-8", 0, "2 classes, closed"),
    ] {
        let file = format!("problems/hard/{file}.toml");
        of_problem_is_checked_in_javascript(&file, code, end);
    }
}

fn of_problem_is_checked_in_javascript(file: &str, code: i32, end: &str) {
    let (_, bytes) = certificate::of(&Problem::read(file).unwrap(), &Options::certified());
    is_checked_in_javascript(file, &bytes, code, end);
}

fn is_checked_in_javascript(name: &str, bytes: &[u8], code: i32, end: &str) {
    if let Some((found, text)) = scripted_bytes(bytes) {
        assert!(
            found == Some(code) && text.trim().ends_with(end),
            "{name}: {text}"
        );
    }
}

/// One of the problems in `tests/independent/kinds`.
fn kind(name: &str) -> Problem {
    Problem::read(format!("tests/independent/kinds/{name}.toml")).unwrap()
}

/// Of problems in `tests/independent/kinds` edits, how they end (none is given of one that ends at a limit), and the last words of the verdict; which is
/// another one where they are said to lead elsewhere.
fn edits_are_proved_in_javascript(cases: &[(&str, &[&[&str]], &[&Ending], &str)]) {
    for &(name, edits, wanted, all) in cases {
        let (endings, bytes) = certificate::of_edits(&kind(name), edits);
        match wanted {
            [] => assert!(matches!(endings[..], [Ending::Limit(_)]), "{endings:?}"),
            _ => assert_eq!(endings.iter().collect::<Vec<_>>(), wanted),
        }
        let Some((code, text)) = scripted_bytes(&bytes) else {
            return;
        };
        assert!(
            code == Some(0) && text.trim().ends_with(all),
            "{name}: {text}"
        );
        let mut led_elsewhere = Certificate::read(&bytes);
        let arcs = led_elsewhere
            .records
            .iter_mut()
            .filter_map(|record| match record {
                Record::Arc(arc) => arc.dimensions.first_mut(),
                _ => None,
            });
        for (_, value) in arcs {
            *value = (value.to_f64() + 1e-6).try_into().unwrap();
        }
        let (code, text) = scripted_bytes(&led_elsewhere.bytes()).unwrap();
        assert!(matches!(code, Some(1 | 3)), "{name}: {text}");
    }
}

/// Edits of figures with more than distances: of angles, of which some are right ones, distances from a plane of its own, radii and
/// coordinates; two one after the other; and one that ends at a fold. And of a distance that is given by its square.
#[test]
fn edits_of_other_constraints_are_proved_in_javascript() {
    let reached = Ending::Reached;
    edits_are_proved_in_javascript(&[
        (
            "right-angle",
            &[&["angles:a-b-c=80"], &["angles:a-b-c=90", "a-b=3"]],
            &[&reached; 2],
            "reached, reached, reached",
        ),
        (
            "coplanar",
            &[&["a-b=3.05"]],
            &[&reached],
            "reached, reached",
        ),
        (
            "two-planes",
            &[&["distances:a-p=1.15"]],
            &[],
            "reached, fold",
        ),
        (
            "held",
            &[&["a-d=3.5", "radii:k=0.7", "y:c=2.1"]],
            &[&reached],
            "reached, reached",
        ),
    ]);
}

/// Of other angles in the same figures.
#[test]
#[ignore = "some seconds"]
fn more_edits_of_other_constraints_are_proved_in_javascript() {
    let reached = Ending::Reached;
    edits_are_proved_in_javascript(&[
        (
            "right-angle",
            &[&["angles:b-a-a-d=95"]],
            &[&reached],
            "reached, reached",
        ),
        (
            "two-planes",
            &[&["angles:p-a-b-c=25"]],
            &[&reached],
            "reached, reached",
        ),
    ]);
}

/// A path that turns back beyond t = 1 has met the figure wanted before: neither checker takes the fold for a limit.
#[test]
fn a_fold_beyond_the_figure_wanted_is_no_limit() {
    for (off, is_limit) in [(-2e-3, true), (1e-3, false)] {
        let bytes = certificate::plate_led_beside_its_limit(off).bytes();
        for printed in [checked_bytes(&bytes), scripted_bytes(&bytes)] {
            let Some((code, text)) = printed else {
                continue;
            };
            assert_eq!(code, Some(if is_limit { 0 } else { 3 }), "{off}: {text}");
        }
    }
}

/// Neither knows the records of equations with heights divided by 1 − t, and both say so.
#[test]
fn records_of_divided_equations_are_said_to_be_unknown() {
    let problem = Problem::read("tests/data/hexahedron-28.toml").unwrap();
    let (_, bytes) = certificate::of(&problem, &Options::certified());
    let found = [(scripted_bytes(&bytes), 5), (checked_bytes(&bytes), 3)];
    for ((code, text), expected) in found.into_iter().filter_map(|(f, e)| Some((f?, e))) {
        assert_eq!(code, Some(expected), "{text}");
        assert!(text.contains("heights divided by 1 - t"), "{text}");
    }
}

/// Shipped certificates, and what the checker in Python counts in them.
fn shipped_are_proved_another_way(files: &[(&str, &str)]) {
    for (name, tubes) in files {
        let Some((code, text)) = checked(&format!("certs/{name}.krawl")) else {
            return;
        };
        assert_eq!(code, Some(0), "{name}: {text}");
        assert!(text.contains(tubes), "{name}: {text}");
    }
}

#[test]
fn shipped_certificates_are_proved_another_way() {
    shipped_are_proved_another_way(&[
        ("prism", "100 tubes, 12 solutions"),
        ("plate-reached", "2 edits"),
        ("plate-limit", "2 edits"),
    ]);
}

#[test]
#[ignore = "some seconds"]
fn long_certificates_are_proved_another_way() {
    shipped_are_proved_another_way(&[("dodecagon", "40 tubes, 2 solutions")]);
}

/// A bit of a coordinate of some tube, and the path's point is not where it was said to be.
#[test]
fn a_damaged_certificate_is_not_proved() {
    let mut bytes = std::fs::read("certs/dodecagon.krawl").unwrap();
    let middle = bytes.len() / 2;
    bytes[middle..middle + 64].fill(0x3f);
    if let Some((code, text)) = checked_bytes(&bytes) {
        assert!(matches!(code, Some(2 | 3)), "{text}");
    }
}

/// Runs, and has the certificates proved, two at a time: all of each. The numbers of solutions are those of the runs.
fn are_proved_another_way(files: &[(&str, usize)]) {
    let left = Mutex::new(files.iter());
    let work = || {
        while let Some(&(file, solutions)) = { left.lock().unwrap().next() } {
            let problem = Problem::read(file).unwrap();
            let (outcome, bytes) = certificate::of(&problem, &Options::certified());
            assert_eq!(outcome.solutions.len(), solutions, "{file}");
            let read = Certificate::read(&bytes);
            let end = read.records.last();
            assert!(
                matches!(end, Some(Record::End(end)) if end.ending == proofs::Ending::Complete)
            );
            let Some((code, text)) = checked_bytes(&bytes) else {
                return;
            };
            let all = format!("VERIFIED: {} tubes, {solutions} solutions", read.tubes());
            assert_eq!((code, text.trim()), (Some(0), &all[..]), "{file}");
        }
    };
    std::thread::scope(|scope| {
        let threads = [scope.spawn(work), scope.spawn(work)];
        for thread in threads {
            thread.join().unwrap();
        }
    });
}

/// Of a linkage that comes back, with lengths given as squares as well.
#[test]
fn motions_are_proved_another_way() {
    let problem = Problem::read("problems/mechanisms/jansen.toml").unwrap();
    let (motion, bytes) = certificate::of_motion(&problem, &["M-F"]);
    assert!(motion.is_loop());
    let solutions = Certificate::read(&bytes).solutions();
    let tubes = Certificate::read(&bytes).tubes();
    if let Some((code, text)) = checked_bytes(&bytes) {
        let all = format!("VERIFIED: {tubes} tubes, a motion, {solutions} solutions");
        assert_eq!((code, text.trim()), (Some(0), &all[..]));
    }
    if let Some((code, text)) = scripted_bytes(&bytes) {
        assert_eq!(code, Some(5), "{text}");
    }
}

/// Of some of the kinds of constraints that `docs/how/certificates.md` specifies.
#[test]
fn other_constraints_are_proved_another_way() {
    are_proved_another_way(&[
        ("tests/independent/kinds/own-plane.toml", 0),
        ("tests/independent/kinds/right-angle.toml", 2),
        ("tests/independent/kinds/coplanar.toml", 2),
        ("tests/independent/kinds/parallel-line.toml", 0),
    ]);
}

/// Of lines and planes.
#[test]
#[ignore = "some seconds"]
fn more_constraints_are_proved_another_way() {
    are_proved_another_way(&[("tests/independent/kinds/lines-and-planes.toml", 0)]);
}

/// Of all others, and larger ones.
#[test]
#[ignore = "minutes"]
fn shipped_problems_with_constraints_are_proved_another_way() {
    are_proved_another_way(&[
        ("problems/constraints/6p7d3a2c-closed.toml", 4),
        ("tests/independent/kinds/two-planes.toml", 2),
        ("tests/independent/kinds/detour.toml", 4),
        ("problems/constraints/pentahedron.toml", 22),
        ("problems/constraints/3p3l.toml", 4),
        ("problems/constraints/3p3l-orthogonal.toml", 4),
        ("tests/independent/kinds/wedge.toml", 4),
        ("tests/independent/kinds/skew-lines.toml", 2),
    ]);
}

/// Another problem, and claims that are false or cannot be proved, where constraints have unknowns and equations of their own. Each is shown to
/// both checkers, or they take turns.
fn damaged_constraints_are_not_proved(to_both: bool) {
    let of = |name: &str| Certificate::read(&certificate::of(&kind(name), &Options::certified()).1);
    let mut damaged = Vec::new();
    for (name, from, to) in [
        ("right-angle", "90.0", "90.1"),
        ("right-angle", "70.0", "69.0"),
        ("coplanar", "\"e\", \"f\"]", "\"f\"]"),
        ("detour", "detour = 0.5", "detour = 0.25"),
        ("two-planes", "\"c\", 20.0", "\"c\", 21.0"),
        ("two-planes", "[\"a\", \"p\", 1.1]", "[\"a\", \"p\", 1.2]"),
        ("parallel-line", "direction = [1.0", "direction = [2.0"),
    ] {
        let mut other = of(name);
        assert!(other.problem.contains(from), "{name}: {}", other.problem);
        other.problem = other.problem.replace(from, to);
        damaged.push((format!("{name}, {to}"), other));
    }
    let good = of("coplanar");
    let mut change = |what: &str, change: &dyn Fn(&mut Certificate)| {
        let mut other = good.clone();
        change(&mut other);
        damaged.push((what.to_owned(), other));
    };
    // The unknown before t is one of a normal.
    let last = good.clone().solution_mut(0).centre.len() - 1;
    change("a tube's middle", &|c| c.tube_mut(3).centre[last] += 0.1);
    change("the normal in a solution", &|c| {
        c.solution_mut(1).centre[last] *= -1.0;
    });
    change("a missing solution", &|c| {
        let at = c.solution_at(1);
        c.records.remove(at);
        c.classes_mut().pop();
    });
    change("a class", &|c| c.classes_mut()[1] = 0);
    change("a missing tube", &|c| c.keep_tubes(|k| k != 5));
    for (k, (what, certificate)) in damaged.iter().enumerate() {
        let bytes = certificate.bytes();
        if (to_both || k % 2 == 0)
            && let Some((code, text)) = checked_bytes(&bytes)
        {
            assert_eq!(code, Some(3), "{what}: {text}");
        }
        // It also finds that there are not as many equations as unknowns.
        if (to_both || k % 2 == 1)
            && let Some((code, text)) = scripted_bytes(&bytes)
        {
            assert!(matches!(code, Some(1..=3)), "{what}: {text}");
        }
    }
}

#[test]
fn damaged_certificates_of_other_constraints_are_not_proved() {
    damaged_constraints_are_not_proved(false);
}

#[test]
#[ignore = "a quarter of a minute"]
fn more_damaged_certificates_of_other_constraints_are_not_proved() {
    damaged_constraints_are_not_proved(true);
}
