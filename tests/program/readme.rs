//! What the README shows is what the program prints.

use assert_cmd::Command;
use std::fs;

/// The blocks that begin with a command, with what is printed below it.
fn sessions(text: &str) -> Vec<(Vec<&str>, Vec<&str>)> {
    text.split("```text\n")
        .skip(1)
        .filter_map(|block| {
            let (block, _) = block.split_once("\n```")?;
            let mut lines = block.lines();
            let command = lines.next()?.strip_prefix("$ krawl ")?;
            Some((command.split_whitespace().collect(), lines.collect()))
        })
        .collect()
}

#[test]
fn the_examples_print_what_is_shown() {
    let text = fs::read_to_string("README.md").unwrap();
    let sessions = sessions(&text);
    assert!(sessions.len() >= 3);
    for (arguments, shown) in sessions {
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(&arguments)
            .output()
            .unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let mut printed_lines = printed.lines();
        for line in shown
            .iter()
            .filter(|line| !line.trim().is_empty() && **line != "...")
        {
            // In this order; times differ, and so stand at ends of lines that are cut short.
            assert!(
                printed_lines.any(|printed| printed.starts_with(line)),
                "krawl {}: `{line}` is not printed, or not there:\n{printed}",
                arguments.join(" ")
            );
        }
    }
}

#[test]
fn the_files_it_shows_are_the_files_there_are() {
    let text = fs::read_to_string("README.md").unwrap();
    // The plate's numbers, but for comments and what may be left out.
    let numbers = |text: &str| -> Vec<String> {
        let lines = text
            .lines()
            .map(|line| line.split('#').next().unwrap().trim().to_owned());
        lines
            .filter(|line| !line.is_empty() && !line.starts_with("name"))
            .collect()
    };
    let (_, shown) = text
        .split_once("`docs/examples/plate.toml`:\n\n```toml\n")
        .unwrap();
    let (shown, _) = shown.split_once("\n```").unwrap();
    let file = fs::read_to_string("docs/examples/plate.toml").unwrap();
    assert_eq!(numbers(shown), numbers(&file));
    // Every page that is linked to exists.
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchors = headings.map(|line| line.replace("# ", "#").to_lowercase().replace(' ', "-"));
    let anchors: Vec<String> = anchors.collect();
    let has_heading =
        |link: &str| link.starts_with('#') && anchors.iter().any(|anchor| anchor.ends_with(link));
    for link in text
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'))
    {
        let (link, _) = link;
        assert!(
            link.starts_with("http") || has_heading(link) || fs::exists(link).unwrap(),
            "{link}"
        );
    }
}
