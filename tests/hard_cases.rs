//! Hard cases: `problems/hard` and the families that its files are of. A certified run is right, or
//! says why it stopped; a float run may be wrong, and some are.

mod common;

use common::boxes::check;
use common::hard::{Answer, Family, families};
use common::moves::{ratio, scaled};
use common::{FLOAT_SPACES, numbers_in, solve};
use krawl::problem::Problem;
use krawl::track::{Options, Outcome, Space, Status};
use std::fs;

const MAX_STEPS: usize = 50_000;

fn limited(options: Options) -> Options {
    Options {
        max_steps: MAX_STEPS,
        ..options
    }
}

fn classes(outcome: &Outcome) -> usize {
    let classes = outcome.solutions.iter().map(|s| s.class + 1);
    classes.max().unwrap_or(0)
}

/// What a certified run says is true.
fn is_right(problem: &Problem, answer: Answer, outcome: &Outcome) -> Result<(), String> {
    check(problem, &outcome.solutions)?;
    let found = outcome.solutions.len();
    match (&outcome.status, answer) {
        (Status::Stopped(reason), _) if numbers_in(reason).is_empty() => {
            Err(format!("stopped without the number: {reason}"))
        }
        (Status::Stopped(_), Answer::Path { solutions, .. }) if found > solutions => {
            Err(format!("stopped with {found} solutions of {solutions}"))
        }
        (Status::Stopped(_), _) => Ok(()),
        (Status::Closed, Answer::NeverCloses) => Err("a path that is no closed curve".to_owned()),
        (Status::Closed, Answer::Unknown) if !found.is_multiple_of(2) => {
            Err(format!("{found} crossings of t = 1"))
        }
        (Status::Closed, Answer::Unknown) => Ok(()),
        (Status::Closed, path) => {
            let found = Answer::Path {
                solutions: found,
                classes: classes(outcome),
            };
            if found == path {
                Ok(())
            } else {
                Err(format!("{found:?}, not {path:?}"))
            }
        }
    }
}

fn family(name: &str) -> &'static Family {
    families().find(|f| f.name == name).expect("a family")
}

#[test]
fn certified_runs_are_right_or_stop() {
    let mut wrong = Vec::new();
    for family in families() {
        for k in family.range.clone() {
            // The exact answer of the crowd takes seconds.
            if family.name == "crowd" && ![2, 8].contains(&k) {
                continue;
            }
            let (problem, answer) = (family.problem(k), family.answer(k));
            for space in FLOAT_SPACES {
                let options = Options {
                    space,
                    ..limited(Options::certified())
                };
                for options in [options.clone(), options.reversed()] {
                    let outcome = solve(&problem, &options);
                    if let Err(what) = is_right(&problem, answer, &outcome) {
                        wrong.push(format!("{}, {space:?}: {what}", problem.name));
                    }
                    // How far runs close is said of the default space only.
                    let must_close = space == Space::Full && k <= family.proved;
                    if must_close && outcome.status != Status::Closed {
                        wrong.push(format!("{}: {:?}", problem.name, outcome.status));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Both spaces name what was too small, in either precision. Lengths are those of the file: a figure 1024
/// times as large, in which all goes the same, has reasons with numbers so many times as large.
#[test]
fn stopped_runs_name_a_number_in_the_lengths_of_the_file() {
    let factor = ratio(1024, 1);
    let mut stopped = 0;
    let [full, reduced] = FLOAT_SPACES.map(|space| Options {
        space,
        ..limited(Options::certified())
    });
    let in_53_bits = [full.clone().without_extended(), reduced];
    let extended = [full];
    for (name, k, is_length, ways) in [
        ("lengths", 6, true, &in_53_bits[..]),
        ("graze", 7, true, &in_53_bits),
        ("flaps-split", 7, true, &in_53_bits),
        ("fold", 8, false, &in_53_bits),
        ("peak", 7, false, &in_53_bits),
        ("lengths", 6, true, &extended),
        ("graze", 12, true, &extended),
        ("flaps-split", 12, true, &extended),
        ("crossing", 0, true, &extended),
        ("tangent", 0, false, &extended),
    ] {
        let small = family(name).problem(k);
        let large = scaled(&small, &factor);
        for options in ways {
            let numbers = [&small, &large].map(|problem| match solve(problem, options).status {
                Status::Closed => panic!("{name}-{k} is closed: try a smaller one"),
                Status::Stopped(reason) => (numbers_in(&reason), reason),
            });
            let [(one, reason), (other, large)] = &numbers;
            println!("{name}-{k}: {reason}\n  {large}");
            assert!(!one.is_empty(), "{reason}");
            assert_eq!(one.len(), other.len(), "{reason}\n{large}");
            let wanted = if is_length { 1024.0 } else { 1.0 };
            for (x, y) in one.iter().zip(other) {
                // Two digits are shown.
                let ratio = y / x / wanted;
                assert!((0.9..1.1).contains(&ratio), "{reason}\n{large}");
            }
            stopped += 1;
        }
    }
    assert_eq!(stopped, 15);
}

/// Float runs that close with a wrong count: which of these do depends on the last bit, that some do
/// does not. The certified run of the same problem closes with the right one, or stops.
#[test]
fn float_runs_jump_where_certified_ones_do_not() {
    let mut wrong = 0;
    for (name, k) in [
        ("crowd", 2),
        ("crowd", 8),
        ("triple", 3),
        ("triple", 6),
        ("triple", 9),
    ] {
        let (problem, answer) = (family(name).problem(k), family(name).answer(k));
        let Answer::Path { solutions, .. } = answer else {
            panic!("{name} has a path");
        };
        for space in FLOAT_SPACES {
            let float = solve(&problem, &limited(Options::float(space)));
            wrong +=
                usize::from(float.status == Status::Closed && float.solutions.len() != solutions);
        }
        let certified = solve(&problem, &limited(Options::certified()));
        is_right(&problem, answer, &certified).unwrap();
    }
    assert!(wrong > 1, "{wrong}");
}

/// What the README of the folder says must come out of a file.
fn in_words(answer: Answer) -> String {
    match answer {
        Answer::Path { solutions: 0, .. } => "0 solutions on the path".to_owned(),
        Answer::Path { solutions, classes } if solutions == classes => {
            format!("{solutions} solutions")
        }
        Answer::Path { solutions, .. } => format!("{solutions} solutions, mirror images in pairs"),
        Answer::NeverCloses => "stopped".to_owned(),
        Answer::Unknown => "an even number, each checked".to_owned(),
    }
}

/// The files as `(name, text, row of the README)`.
fn files() -> Vec<(String, String, String)> {
    let mut files = Vec::new();
    for family in families() {
        for &k in family.files {
            let (problem, answer) = (family.problem(k), family.answer(k));
            let stops = if k <= family.proved || answer == Answer::NeverCloses {
                ""
            } else {
                ", or stopped"
            };
            let out = in_words(answer) + stops;
            let name = problem.name.clone();
            let parameter = if family.parameter.is_empty() {
                String::new()
            } else {
                format!("# Family {}, 10^-{k}: {}.\n", family.name, family.parameter)
            };
            let text = format!(
                "# Hard: {}.\n# Must come out: {out}.\n{parameter}\n{}",
                family.hard,
                problem.to_toml()
            );
            let row = format!("| `{name}.toml` | {} | {out} |", family.hard);
            files.push((name, text, row));
        }
    }
    files
}

#[test]
fn files_are_as_their_families_make_them() {
    let readme = fs::read_to_string("problems/hard/README.md").unwrap();
    for (name, text, row) in files() {
        let path = format!("problems/hard/{name}.toml");
        assert_eq!(
            fs::read_to_string(&path).unwrap_or_default(),
            text,
            "{path}"
        );
        assert!(readme.contains(&row), "the README lacks\n{row}");
    }
    let count = fs::read_dir("problems/hard").unwrap().count();
    assert_eq!(count, files().len() + 1, "files that no family makes");
}

#[test]
#[ignore = "writes the files of problems/hard and prints the rows of its README"]
fn write_files() {
    fs::create_dir_all("problems/hard").unwrap();
    for (name, text, row) in files() {
        fs::write(format!("problems/hard/{name}.toml"), text).unwrap();
        println!("{row}");
    }
}

/// A run in a cell of the table: the count, bold if it is wrong, or why the run stopped.
fn cell(outcome: &Outcome, answer: Answer) -> String {
    let found = outcome.solutions.len();
    match &outcome.status {
        Status::Stopped(reason) => {
            let reasons = [
                ("could not be decided", "stopped: t = 1 undecided"),
                ("Krawczyk", "stopped: no tube proved"),
                ("linked", "stopped: no link"),
                ("limit of", "stopped: too many steps"),
            ];
            let short = reasons.iter().find(|(part, _)| reason.contains(part));
            short.map_or("stopped: no step", |s| s.1).to_owned()
        }
        Status::Closed => match answer {
            Answer::Path { solutions, .. } if found != solutions => format!("**{found}**"),
            Answer::NeverCloses => format!("**{found}**"),
            _ => format!("{found}"),
        },
    }
}

/// A row of the table: parameters of which all that is said is the same.
struct Row {
    from: i32,
    to: i32,
    /// Tubes, rejected ones too, and milliseconds.
    effort: Vec<(usize, f64)>,
    cells: [String; 5],
}

/// `FAMILY=flaps` prints those only whose names begin so.
#[test]
#[ignore = "prints the table of docs/hard.md"]
fn table() {
    let only = std::env::var("FAMILY").unwrap_or_default();
    println!(
        "| family | δ | right | certified, 53 bits | certified, extended | tubes | ms | float full | float reduced |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    for family in families().filter(|f| f.name.starts_with(&only)) {
        let mut rows: Vec<Row> = Vec::new();
        for k in family.range.clone() {
            let (problem, answer) = (family.problem(k), family.answer(k));
            let run = |options| solve(&problem, &limited(options));
            let plain = run(Options::certified().without_extended());
            let certified = run(Options::certified());
            is_right(&problem, answer, &plain).unwrap();
            is_right(&problem, answer, &certified).unwrap();
            if std::env::var("WHY").is_ok() {
                println!("{}: {:?}", problem.name, certified.switched_on);
                println!(
                    "53 bits {:?}, extended {:?}",
                    plain.status, certified.status
                );
            }
            let [full, reduced] =
                FLOAT_SPACES.map(|space| cell(&run(Options::float(space)), answer));
            let right = match answer {
                Answer::Path { solutions, .. } => solutions.to_string(),
                Answer::NeverCloses => "never closes".to_owned(),
                Answer::Unknown => "?".to_owned(),
            };
            let [plain, extended] = [&plain, &certified].map(|outcome| cell(outcome, answer));
            let cells = [right, plain, extended, full, reduced];
            let effort = (
                certified.steps + certified.rejected,
                certified.seconds * 1e3,
            );
            match rows.last_mut() {
                Some(row) if row.cells == cells => {
                    row.to = k;
                    row.effort.push(effort);
                }
                _ => rows.push(Row {
                    from: k,
                    to: k,
                    effort: vec![effort],
                    cells,
                }),
            }
        }
        for Row {
            from,
            to,
            effort,
            cells: [right, plain, extended, full, reduced],
        } in rows
        {
            let delta = match (family.parameter, from == to) {
                ("", _) => String::new(),
                (_, true) => format!("1e-{from}"),
                (_, false) => format!("1e-{from} … 1e-{to}"),
            };
            let tubes = effort.iter().map(|e| e.0);
            let (least, most) = (tubes.clone().min().unwrap(), tubes.max().unwrap());
            let ms = effort.iter().map(|e| e.1).fold(0.0, f64::max);
            println!(
                "| {} | {delta} | {right} | {plain} | {extended} | {least} … {most} | {ms:.1} | {full} | {reduced} |",
                family.name
            );
        }
    }
}
