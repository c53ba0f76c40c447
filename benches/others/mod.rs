//! Other programs on the systems that `krawl export` writes, where they are installed.

use krawl::complex::{Export, export, lower_in_squares};
use krawl::problem::Problem;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Seconds after which a program is stopped.
const PATIENCE: &str = "600";

/// A program, how its system is written, and what makes it solve it.
struct Program {
    name: &'static str,
    system: Export,
    /// Written behind the system.
    ending: &'static str,
    /// What stands before the input file on the command line, and whether a file for the results follows it.
    option: Option<&'static str>,
    output: Option<Option<&'static str>>,
}

const PROGRAMS: [Program; 5] = [
    Program {
        name: "phc",
        system: Export::PhcPack,
        ending: "",
        option: Some("-b"),
        output: Some(None),
    },
    Program {
        name: "M2",
        system: Export::Macaulay2,
        // Its numerical solver takes inexact coefficients.
        ending: "needsPackage \"NumericalAlgebraicGeometry\"\nS = CC[gens R]\n\
                 sols = solveSystem flatten entries gens sub(I, S)\nprint(#sols, \"solutions\")\nexit 0\n",
        option: Some("--script"),
        output: None,
    },
    Program {
        name: "msolve",
        system: Export::Msolve,
        ending: "",
        option: Some("-f"),
        output: Some(Some("-o")),
    },
    Program {
        name: "ibexsolve",
        system: Export::Ibex,
        ending: "",
        option: None,
        output: None,
    },
    Program {
        name: "realpaver",
        system: Export::RealPaver,
        ending: "",
        option: None,
        output: None,
    },
];

/// What a program makes of a shipped problem: a line for the table.
///
/// `within` is the size up to which programs that search boxes look, in the file's units.
pub fn run(name: &str, problem: &str, within: f64) -> String {
    let program = PROGRAMS.iter().find(|program| program.name == name);
    let program = program.expect("a program that is known here");
    let is_there = Command::new(name)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .stdin(Stdio::null())
        .status()
        .is_ok();
    if !is_there {
        return format!("skipped: {name} is not installed");
    }
    let problem = Problem::read(format!("problems/{problem}.toml")).expect("a shipped problem");
    let lowered = match lower_in_squares(&problem) {
        Ok(lowered) => lowered,
        Err(error) => return format!("skipped: {error}"),
    };
    let text = match export(&lowered.system, program.system, within) {
        Ok(text) => text + program.ending,
        Err(error) => return format!("skipped: {error}"),
    };
    let folder = std::env::temp_dir().join(format!("krawl-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let (input, output) = (folder.join("input"), folder.join("output"));
    let _ = std::fs::remove_file(&output);
    std::fs::write(&input, text).expect("a file for the system");
    let mut command = Command::new("timeout");
    command
        .args([PATIENCE, name])
        .args(program.option)
        .arg(&input);
    if let Some(option) = program.output {
        command.args(option).arg(&output);
    }
    let begin = Instant::now();
    let run = command.stdin(Stdio::null()).output().expect("timeout runs");
    let seconds = begin.elapsed().as_secs_f64();
    let said = std::fs::read_to_string(&output);
    let said = said.unwrap_or_else(|_| String::from_utf8_lossy(&run.stdout).into_owned());
    let _ = std::fs::remove_dir_all(&folder);
    let count = said.lines().find(|line| line.contains("solutions"));
    match run.status.code() {
        Some(0) => format!("{seconds:.2} s, {}", count.unwrap_or("").trim()),
        Some(124) => format!("stopped after {PATIENCE} s"),
        _ => format!("failed after {seconds:.2} s"),
    }
}
