//! Who trusts the checker has few lines to read, and they use nothing of the tracker.

use std::fs;
use std::path::PathBuf;

fn sources() -> Vec<(PathBuf, String)> {
    let files = fs::read_dir("src/certificate/checker").unwrap();
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.extend(
        ["format.rs", "reader.rs", "verdict.rs"].map(|f| PathBuf::from("src/certificate").join(f)),
    );
    let read = |path: PathBuf| (path.clone(), fs::read_to_string(path).unwrap());
    paths.into_iter().map(read).collect()
}

#[test]
fn the_checker_uses_only_the_problem_the_intervals_and_the_equations() {
    const ALLOWED: [&str; 4] = ["problem", "interval", "system", "certificate"];
    for (path, text) in sources() {
        let mut parts = text.split("crate::");
        parts.next();
        for part in parts {
            let module: String = part.chars().take_while(|c| c.is_alphanumeric()).collect();
            assert!(
                ALLOWED.contains(&module.as_str()),
                "{}: crate::{module}",
                path.display()
            );
        }
        // Of its own module, not the writer: that one knows the tracker.
        assert!(!text.contains("writer"), "{}", path.display());
        assert!(!text.contains("unsafe"), "{}", path.display());
    }
    // And what those use: nothing above them.
    for folder in ["problem", "interval", "system"] {
        for file in fs::read_dir(format!("src/{folder}")).unwrap() {
            let path = file.unwrap().path();
            if path.is_file() {
                let text = fs::read_to_string(&path).unwrap();
                for module in ["track", "plan", "linalg", "certificate", "report"] {
                    assert!(
                        !text.contains(&format!("crate::{module}")),
                        "{}",
                        path.display()
                    );
                }
            }
        }
    }
}

#[test]
fn the_checker_is_short() {
    let own = sources()
        .into_iter()
        .filter(|(path, _)| path.starts_with("src/certificate/checker"));
    let code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
    let lines: usize = own.map(|(_, text)| text.lines().filter(code).count()).sum();
    assert!(lines <= 1150, "{lines} lines of code");
}
