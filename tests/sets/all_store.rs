//! `krawl all` with a store: ended at any moment, shared and merged, the answer and the cover are those of one run.

use super::explore::checksum;
use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

const DODECAGON: &str = "problems/dodecagon.toml";
pub const NAME: &str = "parts.krawl-all";

pub fn run(arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("krawl").unwrap();
    command.arg("all").args(arguments).arg("--quiet").assert()
}

/// What it prints as JSON, but for the time it took.
pub fn answer(arguments: &[&str], code: i32) -> Value {
    let mut all = arguments.to_vec();
    all.extend(["--json", "-"]);
    let assert = run(&all).code(code);
    let mut value: Value = serde_json::from_slice(&assert.get_output().stdout).unwrap();
    value.as_object_mut().unwrap().remove("seconds");
    value
}

pub fn complaint(arguments: &[&str]) -> String {
    let assert = run(arguments).code(2);
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The lines of a store.
pub fn lines(store: &Path) -> usize {
    let bytes = std::fs::read(store.join(NAME)).unwrap_or_default();
    bytes.iter().filter(|&&b| b == b'\n').count()
}

/// Begins the same search so often, and kills it after a while, later each time: the store never has fewer lines than before.
pub fn killed(times: u64, arguments: &[&str], store: &Path) {
    let mut before = 0;
    for round in 0..times {
        let mut child = Process::new(assert_cmd::cargo::cargo_bin("krawl"))
            .arg("all")
            .args(arguments)
            .args(["--quiet", "--store", text(store)])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(5 + 15 * round));
        // On Unix this is kill -9.
        let _ = child.kill();
        child.wait().unwrap();
        let now = lines(store);
        assert!(now >= before, "{now} lines, and there were {before}");
        before = now;
    }
}

#[test]
fn cut_off_anywhere_it_goes_on_to_the_same_answer() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let once = answer(&[DODECAGON], 0);
    assert_eq!(answer(&[DODECAGON, "--store", text(&store)], 0), once);
    let file = store.join(NAME);
    let whole = std::fs::read(&file).unwrap();
    let count = lines(&store);
    assert!(count > 20, "{count}");
    let first = whole.iter().position(|&b| b == b'\n').unwrap();
    // As a kill leaves it: nothing, half of the first line, the first line alone, half of another line.
    for length in [
        0,
        first / 2,
        first,
        first + 1,
        whole.len() / 2,
        whole.len() - 1,
    ] {
        std::fs::write(&file, &whole[..length]).unwrap();
        let again = answer(&[DODECAGON, "--store", text(&store), "--threads", "1"], 0);
        assert_eq!(again, once, "cut off after {length} bytes");
        assert_eq!(lines(&store), count);
    }
    // A line that is damaged is not believed: it is searched again.
    let mut damaged = whole.clone();
    let at = damaged.len() - 10;
    damaged[at] ^= 1;
    std::fs::write(&file, &damaged).unwrap();
    assert_eq!(answer(&[DODECAGON, "--store", text(&store)], 0), once);
    // What is done is not done again.
    std::fs::write(&file, &whole).unwrap();
    assert_eq!(answer(&[DODECAGON, "--store", text(&store)], 0), once);
    assert_eq!(std::fs::read(&file).unwrap(), whole);
}

#[test]
fn a_killed_process_loses_nothing_that_was_done() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let once = answer(&[DODECAGON], 0);
    killed(12, &[DODECAGON, "--threads", "1"], &store);
    assert_eq!(answer(&[DODECAGON, "--store", text(&store)], 0), once);
}

#[test]
fn shares_are_merged_to_the_same_answer_and_the_same_cover() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (plain, merged) = (at("plain.cover"), at("merged.cover"));
    let once = answer(&[DODECAGON, "--cert", text(&plain)], 0);
    let stores = [at("a"), at("b"), at("c")];
    for (k, store) in stores.iter().enumerate() {
        let share = format!("{}/3", k + 1);
        let part = at("part.cover");
        let one = answer(
            &[
                DODECAGON,
                "--store",
                text(store),
                "--share",
                &share,
                "--cert",
                text(&part),
            ],
            1,
        );
        assert_eq!(one["status"], "partial");
        let open = one["undecided"][0]["share"].as_f64().unwrap();
        assert!(open > 0.0 && open < 1.0, "{open}");
    }
    // In any order, and folders or files alike.
    let file = stores[0].join(NAME);
    let all = answer(
        &[
            DODECAGON,
            "--store",
            text(&stores[2]),
            "--merge",
            text(&stores[1]),
            "--merge",
            text(&file),
            "--cert",
            text(&merged),
            "--threads",
            "3",
        ],
        0,
    );
    assert_eq!(all, once);
    assert_eq!(
        std::fs::read(plain).unwrap(),
        std::fs::read(&merged).unwrap()
    );
    Command::cargo_bin("krawl")
        .unwrap()
        .args(["verify", text(&merged), DODECAGON, "--quiet"])
        .assert()
        .code(0);
}

/// A store whose first line says something else, its checksum in order.
fn with_head(whole: &str, change: impl Fn(&mut Value)) -> String {
    let mut lines = whole.lines();
    let (head, _) = lines.next().unwrap().rsplit_once(' ').unwrap();
    let mut value: Value = serde_json::from_str(head).unwrap();
    change(&mut value);
    // What it is comes first.
    let kind = value.as_object_mut().unwrap().remove("krawl").unwrap();
    let head = format!("{{\"krawl\":{kind},{}", &value.to_string()[1..]);
    let mut out = format!("{head} {}\n", checksum("", &head));
    // The other lines are written behind the first one as krawl writes it.
    for line in lines {
        out += line;
        out.push('\n');
    }
    out
}

#[test]
fn a_first_line_that_is_damaged_or_of_another_search_is_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    let store = folder.path().join("store");
    let once = answer(&[DODECAGON, "--store", text(&store)], 0);
    let file = store.join(NAME);
    let whole = std::fs::read_to_string(&file).unwrap();
    let with = |content: &str| {
        std::fs::write(&file, content).unwrap();
        let said = complaint(&[DODECAGON, "--store", text(&store)]);
        assert_eq!(std::fs::read_to_string(&file).unwrap(), content);
        said
    };
    // The same first line is taken, in whatever order the rest of it is.
    std::fs::write(&file, with_head(&whole, |_| {})).unwrap();
    assert_eq!(answer(&[DODECAGON, "--store", text(&store)], 0), once);
    // One digit of the plan.
    let first = whole.lines().next().unwrap();
    let at = first.find(r#""point":"#).unwrap() + r#""point":"#.len();
    let digit = if &first[at..=at] == "9" { "8" } else { "9" };
    let said = with(&format!("{}{digit}{}", &whole[..at], &whole[at + 1..]));
    assert!(said.contains("first line is damaged"), "{said}");
    // Checksums in order, but not the plan: a distance that does not close, a point that is placed twice, none that
    // is there, a base of another dimension, a parameter left out.
    let step = |head: &mut Value, change: &dyn Fn(&mut Value)| {
        change(&mut head["plan"]["steps"][2]);
    };
    let changes: [&dyn Fn(&mut Value); 6] = [
        &|head| {
            let steps = head["plan"]["steps"].as_array_mut().unwrap();
            let last = steps.last_mut().unwrap();
            assert!(last["closing"].as_array_mut().unwrap().pop().is_some());
        },
        &|head| step(head, &|s| s["point"] = 0.into()),
        &|head| step(head, &|s| s["point"] = 1000.into()),
        &|head| head["plan"]["base"] = serde_json::json!([0, 1, 2]),
        &|head| head["plan"]["base"] = serde_json::json!([0, 4000]),
        &|head| head["plan"]["drives"] = serde_json::json!([]),
    ];
    for (index, change) in changes.iter().enumerate() {
        let said = with(&with_head(&whole, change));
        let right = said.contains("its plan is not one of this problem");
        assert!(right, "change {index}: {said}");
    }
    // Cut into other pieces, as another build might.
    let said = with(&with_head(&whole, |head| head["pieces"] = "ff".into()));
    assert!(said.contains("parts the search otherwise"), "{said}");
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (dodecagon, prism) = (at("dodecagon"), at("prism"));
    answer(&[DODECAGON, "--store", text(&dodecagon)], 0);
    answer(&["problems/prism.toml", "--store", text(&prism)], 0);
    let other = complaint(&["problems/prism.toml", "--store", text(&dodecagon)]);
    assert!(other.contains("another problem"), "{other}");
    let merge = complaint(&[
        DODECAGON,
        "--store",
        text(&dodecagon),
        "--merge",
        text(&prism),
    ]);
    assert!(merge.contains("another search"), "{merge}");
    let missing = complaint(&[
        DODECAGON,
        "--store",
        text(&dodecagon),
        "--merge",
        text(&at("none")),
    ]);
    assert!(missing.contains("none"), "{missing}");
    let cover = at("cover");
    let cert = complaint(&[
        DODECAGON,
        "--store",
        text(&dodecagon),
        "--cert",
        text(&cover),
    ]);
    assert!(
        cert.contains("begun without --cert") && !cover.exists(),
        "{cert}"
    );
    for share in ["0/2", "3/2", "1", "1/0", "a/b"] {
        let wrong = complaint(&[DODECAGON, "--store", text(&dodecagon), "--share", share]);
        assert!(wrong.contains("K/N"), "{wrong}");
    }
    let alone = complaint(&[DODECAGON, "--share", "1/2"]);
    assert!(alone.contains("--store"), "{alone}");
    // Another file of the name.
    let foreign = at("foreign");
    std::fs::create_dir(&foreign).unwrap();
    std::fs::write(foreign.join(NAME), "mine\n").unwrap();
    let kept = complaint(&[DODECAGON, "--store", text(&foreign)]);
    assert!(
        kept.contains("does not begin as `parts of a search"),
        "{kept}"
    );
    assert_eq!(std::fs::read(foreign.join(NAME)).unwrap(), b"mine\n");
    // Another process has it.
    let file = std::fs::File::open(dodecagon.join(NAME)).unwrap();
    file.lock().unwrap();
    let busy = complaint(&[DODECAGON, "--store", text(&dodecagon)]);
    assert!(busy.contains("another krawl process"), "{busy}");
}
