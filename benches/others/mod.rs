//! Other programs, where they are installed.

use krawl::complex::Export;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Seconds after which a program is stopped.
const PATIENCE: &str = "600";

/// A program, how its system is written, and what makes it solve it.
struct Program {
    /// What this table calls it: the program's name, and perhaps what it is asked for.
    name: &'static str,
    system: Export,
    /// Written behind the system.
    ending: &'static str,
    /// What stands before the input file on the command line, and whether a file for the results follows it.
    option: Option<&'static str>,
    output: Option<Option<&'static str>>,
}

const PROGRAMS: [Program; 6] = [
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
        name: "M2 certified",
        system: Export::Macaulay2,
        // Total degree in projective space, each step certified, rounding apart (Beltrán, Leykin, 2012).
        ending: "needsPackage \"NumericalAlgebraicGeometry\"\n\
                 S = CC[append(apply(gens R, baseName), getSymbol \"hh\")]\n\
                 T = flatten entries homogenize(sub(gens I, S), last gens S)\n\
                 (G, starts) = totalDegreeStartSystem T\n\
                 ends = track(G, T, starts, gamma => 0.6+0.8*ii, Predictor => Certified, Normalize => true)\n\
                 steps = p -> if p.cache.?NumberOfSteps then p.cache.NumberOfSteps else 0\n\
                 print(#select(ends, p -> p.cache.?SolutionStatus and p.cache.SolutionStatus === Regular), \"solutions\", \
                 sum apply(ends, steps), \"steps\")\nexit 0\n",
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

fn program(name: &str) -> &'static Program {
    let program = PROGRAMS.iter().find(|program| program.name == name);
    program.expect("a program that is known here")
}

/// How a program's systems are written.
pub fn form(name: &str) -> Export {
    program(name).system
}

/// What a program makes of a system in its own form: a line for the table.
pub fn solve(name: &str, system: String) -> String {
    let program = program(name);
    let command = name.split(' ').next().expect("a name");
    let is_there = Command::new(command)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .stdin(Stdio::null())
        .status()
        .is_ok();
    if !is_there {
        return format!("skipped: {command} is not installed");
    }
    let folder = std::env::temp_dir().join(format!("krawl-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let (input, output) = (folder.join("input"), folder.join("output"));
    let _ = std::fs::remove_file(&output);
    std::fs::write(&input, system + program.ending).expect("a file for the system");
    let mut timed = Command::new("timeout");
    timed
        .args([PATIENCE, command])
        .args(program.option)
        .arg(&input);
    if let Some(option) = program.output {
        timed.args(option).arg(&output);
    }
    let begin = Instant::now();
    let run = timed.stdin(Stdio::null()).output().expect("timeout runs");
    let seconds = begin.elapsed().as_secs_f64();
    let said = std::fs::read_to_string(&output);
    let said = said.unwrap_or_else(|_| String::from_utf8_lossy(&run.stdout).into_owned());
    let _ = std::fs::remove_dir_all(&folder);
    let lines = said.lines().filter(|line| line.contains("solutions"));
    // PHCpack says other things of solutions before, and may have lists of several parts.
    let lists: Vec<&str> = lines
        .clone()
        .filter(|line| line.starts_with("A list of"))
        .collect();
    let count = match lists.is_empty() {
        true => lines.take(1).collect::<String>(),
        false => lists.join(" "),
    };
    match run.status.code() {
        Some(0) => format!("{seconds:.2} s, {}", count.trim()),
        Some(124) => format!("stopped after {PATIENCE} s"),
        _ => format!("failed after {seconds:.2} s"),
    }
}
