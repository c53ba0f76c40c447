//! Hard cases: `problems/hard` and the families that its files are of. A certified run is right, or
//! says why it stopped; a float run may be wrong, and some are.

use crate::common::boxes::{View, check, float_matching, matching};
use crate::common::hard::boundary::SINES;
use crate::common::hard::{Answer, Family, families};
use crate::common::moves::{ratio, scaled};
use crate::common::{FLOAT_SPACES, closed, numbers_in, solve};
use krawl::plan::boundary::gamma_two;
use krawl::problem::{Distance, Problem, Target};
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
        (Status::Open(_), _) => Err("distances alone have no open paths".to_owned()),
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

const SOME_THRESHOLDS: &[i32] = &[2, 6, 9, 15];

/// Of every member of each family, in both directions or in one: not in the same one in both spaces, nor of the member before.
fn certified_runs_are_right(in_both: bool) {
    let mut wrong = Vec::new();
    for family in families() {
        for k in family.range.clone() {
            // The exact answer of the crowd takes seconds, those of the others a good part of one.
            let some: &[i32] = match family.name {
                "crowd" => &[2, 8],
                "threshold" | "threshold-crossed" => SOME_THRESHOLDS,
                "graze-spheres" | "graze-spheres-stopped" => &[1, 4, 7, 10, 12],
                _ => &[k],
            };
            if !some.contains(&k) {
                continue;
            }
            let (problem, answer) = (family.problem(k), family.answer(k));
            for space in FLOAT_SPACES {
                let options = Options {
                    space,
                    ..limited(Options::certified())
                };
                let ways = [options.clone(), options.reversed()];
                let turn = k + i32::from(space == Space::Full);
                let is_tried = |way: &usize| in_both || (*way as i32 + turn) % 2 == 0;
                for way in (0..2).filter(is_tried) {
                    let outcome = solve(&problem, &ways[way]);
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

#[test]
fn certified_runs_are_right_or_stop() {
    certified_runs_are_right(false);
}

#[test]
#[ignore = "a quarter of a minute"]
fn certified_runs_both_ways_are_right_or_stop() {
    certified_runs_are_right(true);
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
        ("flaps-split", 13, true, &extended),
        ("crossing", 0, true, &extended),
        ("tangent", 0, false, &extended),
    ] {
        let small = family(name).problem(k);
        let large = scaled(&small, &factor);
        for options in ways {
            let numbers = [&small, &large].map(|problem| match solve(problem, options).status {
                Status::Open(_) => panic!("distances alone have no open paths"),
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

/// Near another piece of path a step's two ends do not see the same one; near a fold they do, and what is
/// not known is whether it reaches t = 1.
#[test]
fn float_runs_say_whether_it_is_t_that_stops_them() {
    for (name, k, short) in [
        ("graze", 8, "ends apart"),
        ("flaps-split", 8, "ends apart"),
        ("fold", 8, "t = 1 undecided"),
        ("fold-missed", 8, "t = 1 undecided"),
    ] {
        let run = solve(
            &family(name).problem(k),
            &limited(Options::float(Space::Full)),
        );
        let Status::Stopped(reason) = run.status else {
            panic!("{name}-{k} is closed");
        };
        assert_eq!(in_short(&reason), short, "{name}-{k}: {reason}");
    }
}

/// How near γ (of p and r) and the sine of the angle (of q and s) come to their thresholds: by that much.
#[test]
fn thresholds_are_met_but_for_the_parameter() {
    for (name, sign) in [("threshold", 1.0), ("threshold-crossed", -1.0)] {
        for k in family(name).range.clone() {
            let problem = family(name).problem(k);
            // p, q, r, s: arms to a, b; a, b; a, p; b, q.
            let length = |i: usize, j: usize| {
                let joins = |d: &&Distance| d.points == [i, j] || d.points == [j, i];
                match &problem.distances.iter().find(joins).unwrap().target {
                    Target::Length(length) => length.to_f64(),
                    Target::SquaredLength(_) => unreachable!("lengths are given"),
                }
            };
            // a b is 8 long at t = ½, where it is longest.
            let at = problem.homotopy.bend_coefficient.to_f64() / 4.0;
            let longest = length(0, 1) + at;
            assert_eq!(longest, 8.0);
            let (alpha, delta) = (Options::certified().alpha, sign * 10f64.powi(-k));
            for (point, [c1, c2], base) in [
                (2, [0, 1], longest),
                (3, [0, 1], longest),
                (4, [0, 2], length(0, 2)),
                (5, [1, 3], length(1, 3)),
            ] {
                let (r1, r2) = (length(c1, point), length(c2, point));
                let x = (base * base + r1 * r1 - r2 * r2) / (2.0 * base);
                let y = (r1 * r1 - x * x).sqrt();
                let (value, wanted) = match point {
                    2 | 4 => {
                        let gamma = gamma_two([x, y, 0.0], [0.0; 3], [base, 0.0, 0.0]);
                        (gamma, alpha + delta)
                    }
                    _ => (base * y / (r1 * r2), SINES * alpha + delta),
                };
                // y comes from a difference of squares of about 25, with a few roundings, and is 0.3 or more.
                let rounding = 64.0 * f64::EPSILON * 25.0;
                let off = (value - wanted).abs();
                assert!(
                    off <= rounding,
                    "{name}-{k}, point {point}: {value} and {wanted}"
                );
            }
        }
    }
}

/// What is found does not depend on when plans are changed, in any space or mode.
#[test]
fn any_threshold_gives_the_same() {
    let (mut changes, mut certified_changes) = (Vec::new(), Vec::new());
    for name in ["threshold", "threshold-crossed"] {
        for &k in SOME_THRESHOLDS {
            let (problem, answer) = (family(name).problem(k), family(name).answer(k));
            let full = closed(&problem, &limited(Options::certified()));
            let usual = Options::certified().alpha;
            let delta = 10f64.powi(-k);
            let beside = [usual.next_down(), usual.next_up()];
            for alpha in [usual, usual - 2.0 * delta, usual + 2.0 * delta]
                .into_iter()
                .chain(beside)
            {
                let reduced = |options: Options| Options {
                    space: Space::Reduced,
                    alpha,
                    ..limited(options)
                };
                for options in [Options::certified(), Options::certified().reversed()] {
                    let certified = solve(&problem, &reduced(options));
                    assert_eq!(certified.status, Status::Closed, "{name}-{k}, α = {alpha}");
                    is_right(&problem, answer, &certified).unwrap();
                    matching(&certified.solutions, &View::same(&problem), &full).unwrap();
                    certified_changes.push(certified.plan_changes);
                }
                let float = Options::float(Space::Reduced);
                for options in [float.clone(), float.reversed()] {
                    let float = solve(&problem, &reduced(options));
                    assert_eq!(float.status, Status::Closed, "{name}-{k}, α = {alpha}");
                    float_matching(&problem, &full, &float.solutions).unwrap();
                    changes.push(float.plan_changes);
                }
            }
        }
    }
    // Plans that are changed, and plans that are not, or not as often.
    for mut changes in [changes, certified_changes] {
        changes.sort_unstable();
        changes.dedup();
        println!("changes of plan: {changes:?}");
        assert!(changes.len() > 1, "{changes:?}");
    }
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

/// Why a run stopped, as the legend of the table says; of reasons that are not in it, how they begin.
fn in_short(reason: &str) -> String {
    const REASONS: [(&str, &str); 10] = [
        ("could not be decided", "t = 1 undecided"),
        (
            "cannot be told whether the path meets t = 1",
            "t = 1 undecided",
        ),
        ("two ends do not meet", "ends apart"),
        ("cannot be isolated", "not isolated"),
        ("Krawczyk", "no tube proved"),
        ("linked", "no link"),
        ("the corrector", "corrector fails"),
        ("no step succeeds", "no step"),
        ("the limit o", "too many steps"),
        ("the sketch could not be corrected", "sketch not corrected"),
    ];
    let known = REASONS.iter().find(|(part, _)| reason.contains(part));
    known.map_or_else(
        || {
            let words: Vec<&str> = reason.split_whitespace().take(6).collect();
            words.join(" ")
        },
        |(_, short)| (*short).to_owned(),
    )
}

/// A run in a cell of the table: the count, bold if it is wrong, or why the run stopped.
fn cell(outcome: &Outcome, answer: Answer) -> String {
    let found = outcome.solutions.len();
    match &outcome.status {
        Status::Open(_) => "open".to_owned(),
        Status::Stopped(reason) => format!("stopped: {}", in_short(reason)),
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
#[ignore = "prints the table of docs/measured/figures.md"]
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
            let tubes = match least == most {
                true => least.to_string(),
                false => format!("{least} … {most}"),
            };
            println!(
                "| {} | {delta} | {right} | {plain} | {extended} | {tubes} | {ms:.1} | {full} | {reduced} |",
                family.name
            );
        }
    }
}
