//! `krawl explore`, `work` and `merge`: what is found, and that nothing finished is ever lost.

use assert_cmd::Command;
use krawl::complete::{self, all};
use krawl::explore::{End, Explorer, Finish, Options, Share};
use krawl::problem::Problem;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command as Process, Stdio};
use std::time::Duration;

const DISULFIDE: &str = "problems/disulfide.toml";
const K33: &str = "problems/k33.toml";

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

fn explore(problem: &str, store: &Path, arguments: &[&str]) -> Command {
    let mut command = krawl();
    command
        .args(["explore", problem, "--store"])
        .arg(store)
        .args(arguments);
    command
}

/// The JSON of a run, and its exit code.
fn explored(problem: &str, store: &Path, arguments: &[&str]) -> (Value, i32) {
    let run = explore(problem, store, arguments)
        .args(["--json", "-"])
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let value = serde_json::from_str(&text).unwrap_or_else(|_| {
        panic!("{text}\n{}", String::from_utf8_lossy(&run.stderr));
    });
    (value, run.status.code().unwrap())
}

fn solutions(result: &Value) -> usize {
    result["solutions"].as_array().unwrap().len()
}

/// In the background.
fn spawn(problem: &str, store: &Path, arguments: &[&str]) -> Child {
    Process::new(env!("CARGO_BIN_EXE_krawl"))
        .args(["explore", problem, "--quiet", "--all-time", "0", "--store"])
        .arg(store)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// The sketch's own path has four solutions of the octahedron and eight of the disulfide ring; new sketches give the
/// others, and never more than there are.
#[test]
fn new_sketches_give_more_solutions() {
    for (name, first, all_of_them) in [("octahedron", 4, 4), ("disulfide", 8, 18)] {
        let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
        let there = all(&problem, &complete::Options::default()).unwrap();
        assert_eq!(there.status, complete::Status::Complete);
        let folder = tempfile::tempdir().unwrap();
        let mut explorer = Explorer::open(&problem, folder.path()).unwrap();
        let options = Options {
            patience: 2,
            ..Options::default()
        };
        assert_eq!(explorer.run(&options).unwrap(), Finish::Ended);
        let contents = explorer.contents();
        assert_eq!(contents.paths[&0].solutions.len(), first, "{name}");
        let found = contents.classes.len();
        assert_eq!(found, all_of_them, "{name}");
        assert!(found <= there.solutions.len(), "{name}: {found}");
        assert_eq!(contents.state.undecided, 0);
        assert!(contents.queue().is_empty());
        // Every solution is near one of the complete set: distances between points are the same.
        let distances = |points: Vec<[f64; 3]>| -> Vec<f64> {
            let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs
                .map(|(i, j)| {
                    let squares = (0..3).map(|k| (points[i][k] - points[j][k]).powi(2));
                    squares.sum::<f64>().sqrt()
                })
                .collect()
        };
        let known: Vec<Vec<f64>> = there
            .solutions
            .iter()
            .map(|s| distances(s.figure().iter().map(|p| [p.x, p.y, p.z]).collect()))
            .collect();
        let mut met = vec![0; known.len()];
        for class in &contents.classes {
            let middles = class.points.iter().map(|p| p.map(|[a, b]| 0.5 * (a + b)));
            let own = distances(middles.collect());
            let same = |other: &Vec<f64>| own.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-8);
            let k = known.iter().position(same).expect("it is one of all");
            met[k] += 1;
        }
        assert!(met.iter().all(|&times| times <= 1), "{name}: {met:?}");
    }
}

/// Whatever was in the store before a kill is there after it, and the end is the same.
#[test]
fn a_killed_process_loses_no_finished_path() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let problem = Problem::read(DISULFIDE).unwrap();
    let mut known = BTreeMap::new();
    let mut grew = 0;
    for round in 0..6 {
        let mut child = spawn(DISULFIDE, &store, &["--jobs", "2"]);
        std::thread::sleep(Duration::from_millis(300 + 170 * round));
        // On Unix this is kill -9.
        child.kill().unwrap();
        child.wait().unwrap();
        let explorer = Explorer::open(&problem, &store).unwrap();
        let contents = explorer.contents();
        for (id, path) in &known {
            assert_eq!(contents.paths.get(id), Some(path));
        }
        for path in contents.paths.values() {
            // A path and its solutions came in one transaction.
            assert!(contents.sketches.contains_key(&path.id));
        }
        for class in &contents.classes {
            assert!(contents.paths.contains_key(&class.path));
        }
        grew += usize::from(contents.paths.len() > known.len());
        known = contents.paths.clone();
    }
    assert!(grew >= 2, "paths were finished between the kills");
    let quick = ["--patience", "1", "--all-time", "0"];
    let (resumed, code) = explored(DISULFIDE, &store, &quick);
    assert_eq!((code, &resumed["status"]), (0, &"ended".into()));
    let (whole, _) = explored(DISULFIDE, &folder.path().join("other"), &quick);
    assert!(solutions(&resumed) >= solutions(&whole));
    assert!(solutions(&whole) >= 8);
}

#[test]
fn a_store_is_for_one_process_and_one_problem() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let mut child = spawn("problems/icosahedron.toml", &store, &["--jobs", "1"]);
    // It has the store once there is a file; until then this one would get it.
    while !store.join("explored.krawl-store").is_file() {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(200));
    let second = explore("problems/icosahedron.toml", &store, &["--paths", "0"])
        .output()
        .unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(second.status.code(), Some(2));
    let said = String::from_utf8(second.stderr).unwrap();
    assert!(said.contains("another krawl process"), "{said}");
    let other = explore(DISULFIDE, &store, &[]).output().unwrap();
    assert_eq!(other.status.code(), Some(2));
    let said = String::from_utf8(other.stderr).unwrap();
    assert!(
        said.contains("another problem (name = \"icosahedron\")"),
        "{said}"
    );
    krawl()
        .args(["merge", "nowhere", "nothing"])
        .assert()
        .code(2);
}

#[test]
fn budgets_end_and_the_next_run_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let (first, code) = explored(DISULFIDE, &store, &["--paths", "1", "--all-time", "0"]);
    assert_eq!((code, &first["status"]), (4, &"budget".into()));
    assert_eq!(
        (solutions(&first), &first["counts"]["followed"]),
        (8, &1.into())
    );
    assert!(first["counts"]["waiting"].as_u64().unwrap() > 20);
    let (shown, code) = explored(DISULFIDE, &store, &["--paths", "0"]);
    assert_eq!(code, 4);
    assert_eq!(shown["solutions"], first["solutions"]);
    assert_eq!(shown["all_real"], 18);
    let table = explore(DISULFIDE, &store, &["--paths", "1"])
        .output()
        .unwrap();
    let table = String::from_utf8(table.stdout).unwrap();
    for line in [
        "That there are no others is not claimed",
        "of 18 reached",
        "published",
    ] {
        assert!(table.contains(line), "{line}: {table}");
    }
}

/// Certificates on request: each path's problem is a file of its own, whose certificate passes the checker.
#[test]
fn solutions_come_with_certificates() {
    let folder = tempfile::tempdir().unwrap();
    let (store, proofs) = (folder.path().join("store"), folder.path().join("proofs"));
    explore(
        "problems/octahedron.toml",
        &store,
        &["--patience", "1", "--quiet", "--proofs"],
    )
    .arg(&proofs)
    .assert()
    .code(0);
    let cert = proofs.join("path-0.krawl");
    krawl().arg("verify").arg(&cert).assert().code(0);
    let problem = proofs.join("path-0.toml");
    krawl()
        .args(["solve", "--quiet"])
        .arg(problem)
        .assert()
        .code(0);
}

#[test]
fn work_units_come_to_the_same_end() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let quick = ["--patience", "1", "--all-time", "0", "--quiet"];
    let share = ["--paths", "1", "--shard", "3", "--all-time", "0", "--quiet"];
    explore(DISULFIDE, &store, &share).assert().code(4);
    let unit = |k: usize| store.join(format!("unit-{k}.krawl-unit"));
    let result = |k: usize| store.join(format!("unit-{k}.krawl-result"));
    assert!(unit(2).is_file() && !unit(3).is_file());
    // All sketches are out: there is nothing to do here.
    let (out, code) = explored(DISULFIDE, &store, &["--all-time", "0"]);
    assert_eq!((code, &out["status"]), (4, &"shared".into()));
    // One is killed again and again, and goes on.
    for _ in 0..3 {
        let mut child = Process::new(env!("CARGO_BIN_EXE_krawl"))
            .args(["work", "--quiet", "--jobs", "1"])
            .arg(unit(0))
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(250));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    for k in 0..3 {
        krawl()
            .args(["work", "--quiet"])
            .arg(unit(k))
            .assert()
            .code(0);
    }
    let lines = |k: usize| fs::read_to_string(result(k)).unwrap().lines().count();
    let share = |k: usize| Share::read(&fs::read_to_string(unit(k)).unwrap()).unwrap();
    for k in 0..3 {
        assert_eq!(lines(k), 1 + share(k).sketches.len());
    }
    // A line that was being written when the machine went down is no line.
    let text = fs::read_to_string(result(1)).unwrap();
    fs::write(result(1), &text[..text.len() - 7]).unwrap();
    krawl()
        .arg("merge")
        .arg(&store)
        .args([result(0), result(1), result(2)])
        .assert()
        .code(0);
    let problem = Problem::read(DISULFIDE).unwrap();
    let contents_of = || {
        let explorer = Explorer::open(&problem, &store).unwrap();
        let contents = explorer.contents();
        (
            contents.paths.len(),
            contents.out.len(),
            contents.classes.len(),
        )
    };
    assert_eq!(contents_of().1, 1);
    fs::write(result(1), &text).unwrap();
    for _ in 0..2 {
        krawl()
            .arg("merge")
            .arg(&store)
            .args([result(0), result(1)])
            .assert()
            .code(0);
        assert_eq!(contents_of().1, 0);
    }
    let (_, code) = explored(DISULFIDE, &store, &quick[..4]);
    assert_eq!(code, 0);
    let other = folder.path().join("other");
    explore(DISULFIDE, &other, &quick).assert().code(0);
    let plain = Explorer::open(&problem, &other).unwrap();
    assert_eq!(contents_of().2, plain.contents().classes.len());
}

/// Of a line behind another, as krawl writes it.
pub fn checksum(last: &str, line: &str) -> String {
    let digest = Sha256::new().chain_update(last).chain_update(line);
    let bytes = digest.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Files from elsewhere are not believed: boxes are proved again, and other problems are refused.
#[test]
fn wrong_results_add_no_solution() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let share = ["--paths", "1", "--shard", "1", "--all-time", "0", "--quiet"];
    explore(K33, &store, &share).assert().code(4);
    let (unit, result) = (
        store.join("unit-0.krawl-unit"),
        store.join("unit-0.krawl-result"),
    );
    krawl()
        .args(["work", "--quiet"])
        .arg(&unit)
        .assert()
        .code(0);
    let text = fs::read_to_string(&result).unwrap();
    let merge = || krawl().arg("merge").arg(&store).arg(&result).assert();
    let head = text.lines().next().unwrap();
    let other = head.replace("problem\":\"", "problem\":\"#");
    // With its checksum or without.
    let (first, _) = other.rsplit_once(' ').unwrap();
    let signed = format!("{first} {}", checksum("", first));
    for (other, said) in [
        (&other, "first line is damaged"),
        (&signed, "about another problem"),
    ] {
        fs::write(&result, format!("{other}\n")).unwrap();
        let refused = merge().code(2);
        let text = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
        assert!(text.contains(said), "{text}");
    }
    // Solutions moved by a thousandth: Newton's method finds them again, but not where they are said to be.
    let mut moved = 0;
    let mut last = head.rsplit_once(' ').unwrap().0.to_owned();
    let lines = text.lines().skip(1).map(|line| {
        let (_, record) = line.split_once(' ').unwrap();
        let mut record: Value = serde_json::from_str(record).unwrap();
        for solution in record["solutions"].as_array_mut().unwrap() {
            for x in solution["points"].as_array_mut().unwrap() {
                for pair in x.as_array_mut().unwrap() {
                    for bound in pair.as_array_mut().unwrap() {
                        *bound = (bound.as_f64().unwrap() + 1e-3).into();
                    }
                }
            }
            moved += 1;
        }
        let record = record.to_string();
        last = checksum(&last, &record);
        format!("{last} {record}\n")
    });
    let moved_text: String = lines.collect();
    fs::write(&result, format!("{head}\n{moved_text}")).unwrap();
    assert!(moved > 0);
    merge().code(0);
    let problem = Problem::read(K33).unwrap();
    let explorer = Explorer::open(&problem, &store).unwrap();
    assert_eq!(
        explorer.contents().classes.len(),
        8,
        "only the sketch's own"
    );
    let ended = explorer.contents().paths.values();
    assert!(ended.filter(|path| path.end == End::Closed).count() > 1);
}

/// The shipped example, tasks of an array, run here.
#[cfg(unix)]
#[test]
fn the_shipped_rounds_come_to_an_end() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let run = Process::new("examples/explore/rounds.sh")
        .args(["problems/octahedron.toml", store.to_str().unwrap(), "2"])
        .env("KRAWL", env!("CARGO_BIN_EXE_krawl"))
        .env("JOBS", "2")
        .output()
        .unwrap();
    let said = String::from_utf8(run.stdout).unwrap();
    let errors = String::from_utf8(run.stderr).unwrap();
    assert!(said.contains("4 of 4 reached"), "{said}\n{errors}");
    assert!(said.contains("round 1: 2 work units"), "{said}");
}
