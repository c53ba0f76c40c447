//! A second checker of certificates, in Python, written after `certs/README.md` and with another
//! method: intervals of whole numbers, and tubes cut into pieces. Left out where there is no Python 3.11.

mod common;

use common::certificate::{self, Certificate};
use krawl::certificate::{Ending, Record};
use krawl::problem::Problem;
use krawl::track::Options;
use std::process::Command;
use std::sync::Mutex;

/// What the checker prints, or nothing where it cannot be run.
fn checked(certificate: &str) -> Option<(Option<i32>, String)> {
    let run = |arguments: &[&str]| Command::new("python3").args(arguments).output().ok();
    if !run(&["-c", "import tomllib"]).is_some_and(|run| run.status.success()) {
        println!("left out: there is no python3 with tomllib (3.11)");
        return None;
    }
    let run = run(&["tests/independent/checker.py", certificate])?;
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    Some((run.status.code(), text))
}

/// The same of a certificate in memory.
fn checked_bytes(bytes: &[u8]) -> Option<(Option<i32>, String)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("certificate.krawl");
    std::fs::write(&path, bytes).unwrap();
    checked(&path.to_string_lossy())
}

#[test]
fn shipped_certificates_are_proved_another_way() {
    for (name, tubes) in [
        ("dodecagon", "40 tubes, 2 solutions"),
        ("prism", "100 tubes, 12 solutions"),
        ("plate-reached", "2 edits"),
        ("plate-limit", "2 edits"),
    ] {
        let Some((code, text)) = checked(&format!("certs/{name}.krawl")) else {
            return;
        };
        assert_eq!(code, Some(0), "{name}: {text}");
        assert!(text.contains(tubes), "{name}: {text}");
    }
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
            assert!(matches!(end, Some(Record::End(end)) if end.ending == Ending::Complete));
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

/// Of every kind of constraint that `certs/README.md` specifies.
#[test]
fn other_constraints_are_proved_another_way() {
    are_proved_another_way(&[
        ("problems/constraints/6p7d3a2c-closed.toml", 4),
        ("tests/independent/kinds/lines-and-planes.toml", 0),
        ("tests/independent/kinds/own-plane.toml", 0),
        ("tests/independent/kinds/two-planes.toml", 2),
        ("tests/independent/kinds/detour.toml", 4),
        ("tests/independent/kinds/right-angle.toml", 2),
        ("tests/independent/kinds/coplanar.toml", 2),
        ("tests/independent/kinds/parallel-line.toml", 0),
    ]);
}

/// Larger ones.
#[test]
#[ignore = "minutes"]
fn shipped_problems_with_constraints_are_proved_another_way() {
    are_proved_another_way(&[
        ("problems/constraints/pentahedron.toml", 22),
        ("problems/constraints/3p3l.toml", 4),
        ("problems/constraints/3p3l-orthogonal.toml", 4),
        ("tests/independent/kinds/wedge.toml", 4),
        ("tests/independent/kinds/skew-lines.toml", 2),
    ]);
}

/// Another problem, and claims that are false or cannot be proved, where constraints have unknowns and equations of their own.
#[test]
fn damaged_certificates_of_other_constraints_are_not_proved() {
    let of = |name: &str| {
        let problem = Problem::read(format!("tests/independent/kinds/{name}.toml")).unwrap();
        Certificate::read(&certificate::of(&problem, &Options::certified()).1)
    };
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
    for (what, certificate) in damaged {
        if let Some((code, text)) = checked_bytes(&certificate.bytes()) {
            assert_eq!(code, Some(3), "{what}: {text}");
        }
    }
}
