//! docs/measured/paper.md names files and types of the code: they are there.

use std::fs;
use std::path::Path;

fn walk(folder: &Path, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            walk(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            found.push((name, fs::read_to_string(&path).unwrap()));
        }
    }
}

/// What stands between backticks.
fn spans(text: &str) -> Vec<&str> {
    text.lines()
        .flat_map(|line| line.split('`').skip(1).step_by(2))
        .collect()
}

#[test]
fn what_the_page_about_the_papers_names_is_there() {
    let text = fs::read_to_string("docs/measured/paper.md").unwrap();
    let mut sources = Vec::new();
    for folder in [
        "crates/kernel/src",
        "crates/tracker/src",
        "crates/solver/src",
        "src",
    ] {
        walk(Path::new(folder), &mut sources);
    }
    let (mut files, mut names) = (0, 0);
    for span in spans(&text) {
        let first = span.split_whitespace().next().unwrap_or("");
        if ["krawl", "cargo"].contains(&first) || first.starts_with("--") || first.starts_with('[')
        {
            continue;
        }
        let is_file =
            span.contains('/') || [".rs", ".toml", ".md"].iter().any(|e| span.ends_with(e));
        if is_file {
            let exists = ["", "crates/kernel/src/", "crates/tracker/src/", "crates/solver/src/", "src/"]
                .iter()
                .any(|folder| fs::exists(format!("{folder}{span}")).unwrap())
                // A module beside one that was named in full.
                || (!span.contains('/') && sources.iter().any(|(name, _)| name == span));
            assert!(exists, "`{span}` is nowhere");
            files += 1;
        } else {
            let is_there = sources.iter().any(|(_, text)| text.contains(span));
            let problem = format!("problems/{span}.toml");
            assert!(
                is_there || fs::exists(problem).unwrap(),
                "`{span}` is nowhere"
            );
            names += 1;
        }
    }
    assert!(files > 60 && names > 3, "{files} files, {names} names");
    for link in text.split("](").skip(1).filter_map(|r| r.split_once(')')) {
        assert!(
            fs::exists(format!("docs/measured/{}", link.0)).unwrap(),
            "{}",
            link.0
        );
    }
}

#[test]
fn every_numbered_item_of_the_papers_has_its_row() {
    let text = fs::read_to_string("docs/measured/paper.md").unwrap();
    let section = |from: &str| {
        let (_, rest) = text.split_once(from).unwrap_or_else(|| panic!("{from}"));
        rest.split("\n## ").next().unwrap()
    };
    for (paper, items) in [
        (
            "## RR 8705",
            &[
                "Definition 1",
                "Definition 2",
                "Definition 3",
                "Theorem 1",
                "Corollary 1",
                "Corollary 2",
                "Lemma 1",
                "Remark 1",
                "Proposition 1",
                "Proposition 2",
                "Proposition 3",
                "Algorithm 1",
                "Algorithm 2",
                "Algorithm 3",
                "Algorithm 4",
                "Table 1",
                "Table 2",
            ][..],
        ),
        (
            "## 001",
            &[
                "Definition 1",
                "Definition 2",
                "Proposition 3",
                "Definition 4",
                "Proposition 5",
                "Lemma 6",
                "Table 1",
            ],
        ),
        ("## 002", &["Remark 1", "Table 1", "Table 2"]),
        ("## 004", &["Table 1", "Table 2", "Table 3", "Table 4"]),
    ] {
        let section = section(paper);
        let missing: Vec<_> = items
            .iter()
            .filter(|item| !section.contains(**item))
            .collect();
        assert!(missing.is_empty(), "{paper}: {missing:?}");
    }
}
