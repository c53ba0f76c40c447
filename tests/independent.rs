//! A second checker of certificates, in Python, written from `certs/README.md` alone and with another
//! method: intervals of whole numbers, and tubes cut into pieces. Left out where there is no Python 3.11.

use std::process::Command;

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
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.krawl");
    std::fs::write(&path, bytes).unwrap();
    if let Some((code, text)) = checked(&path.to_string_lossy()) {
        assert!(matches!(code, Some(2 | 3)), "{text}");
    }
}
