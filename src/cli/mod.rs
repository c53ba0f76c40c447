//! The command line: one file per verb.

mod all;
mod check;
mod compare;
mod complex;
mod digits;
mod edit;
mod explore;
mod export;
mod generate;
mod input;
mod interrupt;
mod limits;
mod measured;
mod merge;
mod motion;
mod output;
mod pictures;
mod processor;
mod results;
mod serve;
mod shell;
mod show;
mod solve;
mod sweep;
mod table;
mod take;
mod template;
mod tolerance;
mod verify;
mod work;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::panic::AssertUnwindSafe;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

/// Exit code of a run that closed, of a check that found nothing wrong, and of a certificate that
/// is verified.
pub const CLOSED: u8 = 0;
/// Exit code of a run whose path came to an end both ways: what lies between is proved.
pub const OPEN: u8 = 5;
/// Exit code of a run that stopped before.
pub const STOPPED: u8 = 1;
/// Exit code of a certificate with a false claim, or about another problem.
pub const REFUTED: u8 = 1;
/// Exit code where the input is bad, or the results could not be written. Usage errors have it too.
pub const BAD_INPUT: u8 = 2;
/// Exit code of a certificate with a claim that may be true but could not be proved.
pub const NOT_PROVED: u8 = 3;
/// Exit code of a certificate whose run stopped: it is true as far as it goes.
pub const INCOMPLETE: u8 = 4;
/// Exit code of an edit that comes to a limit before the new dimensions.
pub const LIMIT: u8 = 3;
/// Exit code of a check that finds constraints that are one too many, whether they follow from others or contradict them.
pub const OVER: u8 = 6;
/// Exit code of an edit that comes to where branches of figures seem to meet.
pub const PASSES: u8 = 4;

/// What the command line is read into.
#[derive(Parser)]
#[command(
    name = "krawl",
    version,
    about = "\
Finds figures that meet given dimensions, with proof: it leads the dimensions of a rough sketch to the wanted ones
and follows the figure as it moves. Reads its own files (TOML), sketches of FreeCAD and SolveSpace, and molecules.",
    after_help = "`krawl VERB -h` has a verb's options on one screen, `krawl --help` and `krawl VERB --help` examples and all the rest.",
    after_long_help = "\
Examples:
  krawl check sketch.toml                   is the input in order, and what was understood?
  krawl solve sketch.toml                   the figures that meet the dimensions
  krawl solve sketch.toml --html page.html  a page to look at
  krawl edit sketch.toml --set a-b=5.2      change a dimension without a flip
  krawl motion sketch.toml --free a-c       a linkage all the way round, past every dead centre
  krawl tolerance sketch.toml --default 0.01  every dimension within its limits
  krawl all sketch.toml                     every figure that there is
  krawl complex sketch.toml                 every complex one
  krawl explore sketch.toml --store DIR     more real ones, from new sketches
  krawl solve sketch.toml --cert proof.krawl && krawl verify proof.krawl

`krawl VERB -h` has a verb's options on one screen, `krawl VERB --help` all there is to say of them. The
format of problem files is in docs/using/problem-files.md.

Exit codes: 0 closed, complete, verified or reached, 1 stopped or refuted, 2 bad input or results that
could not be written, 3 an edit's limit or a certificate not proved, 4 where an edit's branches meet or
an incomplete certificate, or complex solutions that are not proved to be all, or sketches left to explore,
5 open: a path that came to an end both ways, proved between, 6 constraints that are one too many (check)."
)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    All(all::Arguments),
    Check(check::Arguments),
    Compare(compare::Arguments),
    Complex(complex::Arguments),
    Edit(edit::Arguments),
    Explore(explore::Arguments),
    Export(export::Arguments),
    Generate(generate::Arguments),
    Limits(limits::Arguments),
    Merge(merge::Arguments),
    Motion(motion::Arguments),
    Show(show::Arguments),
    Solve(solve::Arguments),
    Sweep(sweep::Arguments),
    Template(template::Arguments),
    Tolerance(tolerance::Arguments),
    Verify(verify::Arguments),
    Work(work::Arguments),
    Completions(shell::Completions),
    Man(shell::Man),
}

/// The verbs by what people want.
const WANTED: [(&str, &[&str]); 4] = [
    (
        "Change a figure, or see how it can move",
        &["edit", "limits", "sweep", "motion", "tolerance"],
    ),
    (
        "Find figures",
        &[
            "solve", "all", "complex", "template", "explore", "work", "merge",
        ],
    ),
    (
        "Look, check, pass on",
        &["check", "show", "verify", "export"],
    ),
    (
        "Experiments and shells",
        &["compare", "generate", "completions", "man", "help"],
    ),
];

/// The command line, with its verbs by what people want.
fn command() -> clap::Command {
    let mut command = Arguments::command();
    command.build();
    let mut verbs = String::new();
    for (what, names) in WANTED {
        verbs.push_str(&format!("{what}:\n"));
        for name in names {
            let verb = command.find_subcommand(name);
            let about = verb.and_then(|verb| verb.get_about());
            let about = about.map(ToString::to_string).unwrap_or_default();
            verbs.push_str(&format!("  {name:<12} {about}\n"));
        }
        verbs.push('\n');
    }
    Arguments::command().help_template(format!(
        "{{about}}\n\n{{usage-heading}} {{usage}}\n\n{verbs}Options:\n{{options}}{{after-help}}"
    ))
}

/// What the command line says; usage errors and help end the program.
fn parse() -> Arguments {
    let first = std::env::args_os().nth(1);
    let is_verb =
        |first: &std::ffi::OsString| *first != "help" && !first.to_string_lossy().starts_with('-');
    // Only a help with the list of verbs needs the list, which takes as long to make as the rest of reading.
    if first.as_ref().is_some_and(is_verb) {
        return Arguments::parse();
    }
    let told = Arguments::from_arg_matches(&command().get_matches());
    told.unwrap_or_else(|error| error.exit())
}

/// Runs the program. The exit code is its result.
pub fn run() -> ExitCode {
    if let Err(message) = processor::check() {
        output::complain(&message);
        return ExitCode::from(BAD_INPUT);
    }
    ExitCode::from(of_verb(parse().verb))
}

/// What came of a verb that another program ran within itself: the exit code, and what it would have printed.
pub struct Called {
    /// The exit code.
    pub code: u8,
    /// What would stand on standard output.
    pub output: String,
    /// What would stand on standard error.
    pub messages: String,
}

/// Runs a verb within another program, with the arguments that the command line would have behind `krawl`. Several at once run one after the other.
pub fn call(arguments: &[String]) -> Called {
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    interrupt::begin();
    output::keep(true);
    let parsed = Arguments::try_parse_from(
        ["krawl"]
            .into_iter()
            .chain(arguments.iter().map(String::as_str)),
    );
    let run = || match (processor::check(), parsed) {
        (Err(message), _) => {
            output::complain(&message);
            BAD_INPUT
        }
        (Ok(()), Ok(arguments)) => of_verb(arguments.verb),
        (Ok(()), Err(error)) if error.use_stderr() => {
            output::complain(error.to_string().trim_end());
            BAD_INPUT
        }
        (Ok(()), Err(help)) => {
            output::print(&help.to_string());
            CLOSED
        }
    };
    let code = std::panic::catch_unwind(AssertUnwindSafe(run));
    let said = output::keep(false);
    Called {
        code: code.unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        output: said.output,
        messages: said.messages,
    }
}

/// Asks for the end of the verb that [`call`] runs, as Ctrl-C does on the command line.
pub fn end_call() {
    interrupt::request();
}

/// Runs a verb: its exit code.
fn of_verb(verb: Verb) -> u8 {
    let done = match verb {
        Verb::All(arguments) => Ok(output::exit_code(all::run(&arguments))),
        Verb::Check(arguments) => check::run(&arguments),
        Verb::Compare(arguments) => compare::run(&arguments),
        Verb::Complex(arguments) => complex::run(&arguments),
        Verb::Edit(arguments) => Ok(output::exit_code(edit::run(&arguments))),
        Verb::Explore(arguments) => explore::run(&arguments),
        Verb::Export(arguments) => export::run(&arguments),
        Verb::Generate(arguments) => generate::run(&arguments),
        Verb::Limits(arguments) => Ok(output::exit_code(limits::run(&arguments))),
        Verb::Merge(arguments) => merge::run(&arguments),
        Verb::Motion(arguments) => Ok(output::exit_code(motion::run(&arguments))),
        Verb::Show(arguments) => show::run(&arguments),
        Verb::Solve(arguments) => solve::run(&arguments),
        Verb::Sweep(arguments) => Ok(output::exit_code(sweep::run(&arguments))),
        Verb::Template(arguments) => template::run(&arguments),
        Verb::Tolerance(arguments) => Ok(output::exit_code(tolerance::run(&arguments))),
        Verb::Verify(arguments) => verify::run(&arguments),
        Verb::Work(arguments) => work::run(&arguments),
        Verb::Completions(arguments) => shell::completions(&arguments),
        Verb::Man(arguments) => shell::man(&arguments),
    };
    output::exit_code(done)
}

/// Runs what follows with a number of threads; `None`: one per processor.
fn in_pool<T: Send>(threads: Option<u16>, work: impl FnOnce() -> T + Send) -> Result<T, String> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0).into())
        .build()
        .map_err(|error| format!("threads cannot be started: {error}"))?;
    Ok(pool.install(work))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verb_stands_where_people_look_for_it() {
        let mut command = Arguments::command();
        command.build();
        let mut listed: Vec<&str> = WANTED
            .iter()
            .flat_map(|(_, names)| names.iter().copied())
            .collect();
        let mut verbs: Vec<&str> = command
            .get_subcommands()
            .map(|verb| verb.get_name())
            .collect();
        listed.sort_unstable();
        verbs.sort_unstable();
        assert_eq!(listed, verbs);
    }
}
