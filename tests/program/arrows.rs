//! The modules of the library stand in an order, which the documentation of the crate gives, and each uses only those
//! before it. Those of all packages, crates/kernel, crates/tracker, crates/solver and krawl, stand in that one order.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The code without comments and without what is in strings and characters.
fn code(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word_before = code.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let raw = rest.strip_prefix('r').filter(|_| !word_before);
        let marks = raw.map_or(0, |raw| raw.len() - raw.trim_start_matches('#').len());
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").expect("an end of the comment") + 2
        } else if raw.is_some_and(|raw| raw[marks..].starts_with('"')) {
            let end = format!("\"{}", "#".repeat(marks));
            let from = marks + 2;
            from + rest[from..].find(&end).expect("an end of the string") + end.len()
        } else if first == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            1 + end.expect("an end of the string") + 1
        } else if first == '\'' {
            // A character; of a lifetime, only the mark is taken.
            let inside = match rest[1..].starts_with('\\') {
                true => rest[3..].find('\'').map(|end| 3 + end),
                false => rest[1..].chars().next().map(|c| 1 + c.len_utf8()),
            };
            let end = inside.filter(|&end| rest[end..].starts_with('\''));
            end.map_or(1, |end| end + 1)
        } else {
            code.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        code.push(' ');
        rest = &rest[length..];
    }
    code
}

const TESTS: &str = "#[cfg(test)]";

/// The code without what is only there in tests, and the names of the files that are only there in tests.
fn without_tests(mut code: String) -> (String, Vec<String>) {
    let mut files = Vec::new();
    while let Some(start) = code.find(TESTS) {
        let mut depth = 0;
        let end = code[start + TESTS.len()..].find(|c: char| {
            match c {
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth -= 1,
                _ => {}
            }
            depth == 0 && matches!(c, ';' | ',' | '}')
        });
        let end = start + TESTS.len() + end.expect("an end of the item") + 1;
        let item = code[start..end].trim_end_matches(';');
        if let Some((_, name)) = item.rsplit_once("mod ")
            && !item.ends_with('}')
        {
            files.push(name.trim().to_owned());
        }
        code.replace_range(start..end, "");
    }
    (code, files)
}

/// The names that a path goes on with: one, or those in braces.
fn names(rest: &str) -> Vec<&str> {
    let name = |text: &'_ str| {
        text.find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(text.len())
    };
    let Some(list) = rest.strip_prefix('{') else {
        return vec![&rest[..name(rest)]];
    };
    let (mut depth, mut begins, mut names) = (0, true, Vec::new());
    for (at, c) in list.char_indices() {
        match c {
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => begins = true,
            c if begins && !c.is_whitespace() => {
                names.push(&list[at..at + name(&list[at..])]);
                begins = false;
            }
            _ => {}
        }
    }
    names
}

/// The modules that a file's code names, which is so deep below the root: by a path from it, or from the root of the
/// other package, or by one that climbs to it.
fn named(code: &str, depth: usize) -> Vec<String> {
    let up = "super::".repeat(depth);
    let mut all = Vec::new();
    for root in [
        "crate::",
        "krawl::",
        "krawl_kernel::",
        "krawl_tracker::",
        "krawl_solver::",
        &up,
    ] {
        for (at, _) in code.match_indices(root) {
            let before = &code[..at];
            let is_part = before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
            if !is_part {
                all.extend(
                    names(&code[at + root.len()..])
                        .into_iter()
                        .map(str::to_owned),
                );
            }
        }
    }
    all
}

/// All files of a folder, and what lies below, with their code.
fn sources(folder: &Path, found: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let name = path.to_str().unwrap().replace('\\', "/");
            found.insert(name, code(&text));
        }
    }
}

/// Where the packages have their modules.
const PACKAGES: [&str; 4] = [
    "crates/kernel/src",
    "crates/tracker/src",
    "crates/solver/src",
    "src",
];

#[test]
fn modules_use_only_those_before_them() {
    let library = fs::read_to_string("src/lib.rs").unwrap();
    let (_, list) = library
        .split_once("From the ground up; each knows only those before it")
        .expect("the order of the modules");
    let order: Vec<&str> = list
        .lines()
        .skip_while(|line| !line.starts_with("//! - "))
        .map_while(|line| line.strip_prefix("//! "))
        .filter_map(|line| line.strip_prefix("- "))
        .map(|line| line.split('`').nth(1).expect("the name of a module"))
        .collect();
    let place = |module: &str| order.iter().position(|&name| name == module);

    let mut files = BTreeMap::new();
    for folder in PACKAGES {
        sources(Path::new(folder), &mut files);
    }
    let mut only_tests = Vec::new();
    for (path, code) in &mut files {
        let (kept, tests) = without_tests(std::mem::take(code));
        *code = kept;
        let folder = match path.rsplit_once('/').unwrap() {
            (folder, "mod.rs" | "lib.rs") => folder,
            _ => path.strip_suffix(".rs").unwrap(),
        };
        for name in tests {
            only_tests.push(format!("{folder}/{name}.rs"));
            only_tests.push(format!("{folder}/{name}/"));
        }
    }

    let (mut arrows, mut wrong) = (0, Vec::new());
    for (path, code) in &files {
        let is_test = |test: &String| path == test || test.ends_with('/') && path.starts_with(test);
        let inside = PACKAGES.iter().find_map(|folder| path.strip_prefix(folder));
        let parts: Vec<&str> = inside.unwrap().split('/').skip(1).collect();
        let module = parts[0].trim_end_matches(".rs");
        if ["lib", "main"].contains(&module) || only_tests.iter().any(is_test) {
            continue;
        }
        let own = place(module).unwrap_or_else(|| panic!("{module} has no place in src/lib.rs"));
        let depth = parts.len() - usize::from(parts.ends_with(&["mod.rs"]));
        for used in named(code, depth) {
            let Some(other) = place(&used).filter(|&other| other != own) else {
                continue;
            };
            arrows += 1;
            if other > own {
                wrong.push(format!("{path}: {module} -> {used}"));
            }
        }
    }
    wrong.dedup();
    assert!(wrong.is_empty(), "against the order:\n{}", wrong.join("\n"));
    // It looked: these are many, and each module is in a package.
    assert!(order.len() > 15 && arrows > 500, "{arrows} arrows");
    let packages = |module: &str| {
        let is_there = |folder: &&&str| {
            let file = format!("{folder}/{module}");
            fs::exists(format!("{file}.rs")).unwrap() || fs::exists(file).unwrap()
        };
        PACKAGES.iter().filter(is_there).count()
    };
    for module in order {
        assert_eq!(packages(module), 1, "packages with {module}");
    }
}

#[test]
fn arrows_are_found_where_code_has_them() {
    let text = "use crate::{problem::{Item, Problem}, track, interval::*};\n// crate::report\nlet a = \"crate::cli\";\n\
                fn f<'a>(x: &'a crate::system::Right) -> char { let c = '\"'; crate::edit::g(c) }\n\
                #[cfg(test)]\nmod tests { use crate::compare::x; }\n#[cfg(test)]\nmod testing;\nuse super::super::blocks;\n\
                let b = r#\"crate::\"explore\"#; krawl::complex::all(); krawl_solver::order::o()";
    let (code, files) = without_tests(code(text));
    assert_eq!(files, ["testing"]);
    let found = named(&code, 2);
    assert_eq!(
        found,
        [
            "problem", "track", "interval", "system", "edit", "complex", "order", "blocks"
        ]
    );
}
