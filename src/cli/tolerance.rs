//! `krawl tolerance`: every dimension within its limits, and what that does to the figure.

use super::measured::Measured;
use super::output::{self, Refusal};
use super::pictures::Pictures;
use super::results::Results;
use super::{CLOSED, STOPPED, input, interrupt};
use krawl::blocks::Account;
use krawl::complete::{self, Progress};
use krawl::constraint::{Measure, measure_of};
use krawl::edit::{Limits, held_though_computed};
use krawl::problem::{Decimal, Problem, list};
use krawl::report::{
    Document, ProgressLine, tolerance_set_in_words, tolerance_set_to_table, tolerances_in_words,
    tolerances_to_csv, tolerances_to_table,
};
use krawl::tolerance::{limits, study, study_all};
use krawl::track::Options;
use std::path::PathBuf;
use std::time::Instant;

/// Every dimension within its limits: between which bounds lengths, angles and areas then are, with proof
///
/// For all choices of all dimensions together there is exactly one figure that the one in FILE becomes, and what is measured stays within the
/// worst case that is printed; so much of it is due to each dimension. Limits are in FILE, with a number or
/// under [tolerances], or given here.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl tolerance docs/examples/plate.toml --default 0.1
  krawl tolerance docs/examples/plate.toml --default 0.1 --tolerance C-D=-0.2,0.5 --measure D-A --measure \"angle B C D\"
  krawl tolerance docs/examples/plate.toml --default 0.1 --html plate.html    the band in which each point stays
  krawl tolerance docs/examples/platform.toml --default 0.1 --csv platform.csv
  krawl tolerance docs/examples/platform.toml --default 0.1 --all    each figure that the legs allow, and no other

Exit codes: 0 proved, 1 interrupted, or of --all not all decided, 2 bad input, or limits for which it is not proved that there is one figure for each choice, or results that could not be
written.")]
pub struct Arguments {
    #[command(flatten)]
    source: input::Source,
    /// Look for every figure that meets the dimensions, not the one drawn alone
    ///
    /// With a proof that no choice of the dimensions has another one, and what is measured of each (not of figures with lines, planes or bodies of
    /// their own); signs that are asked for are not looked at
    #[arg(long, conflicts_with = "csv")]
    all: bool,
    /// Threads for --all [default: one per processor]; the answer does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), requires = "all", hide_short_help = true)]
    threads: Option<u16>,
    /// The tolerance of all distances between points and radii that have none
    ///
    /// 0.1, or so far down and up, -0.2,0.1. Other dimensions without one are exact: distances from lines, planes and circles, diameters,
    /// coordinates, angles
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    default: Option<String>,
    /// The tolerance of one dimension, a-b=0.1 or a-b=-0.2,0.1
    ///
    /// May be given more than once
    #[arg(long, value_name = "NAME=VALUE")]
    tolerance: Vec<String>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write what is measured as CSV; `-` is standard output
    ///
    /// A row for each measure: its bounds, and what each dimension has to do with it
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    measured: Measured,
    #[command(flatten)]
    pictures: Pictures,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print nothing
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, Refusal> {
    arguments.time.begin();
    let file = &arguments.source.file;
    let loaded = arguments.source.load()?;
    loaded.say_computed(&loaded.problem.dimensions().collect::<Vec<_>>());
    let (problem, made) = input::whole(file, &loaded)?;
    let mut made = made.with_other_numbers();
    output::say_if_signs_are_not_looked_at(&problem);
    let named = [arguments.json.as_deref(), arguments.csv.as_deref()];
    let mut results = Results::open([file], named, &arguments.pictures, arguments.quiet)?;
    let default = arguments.default.as_deref().map(deviations).transpose()?;
    let named = arguments.tolerance.iter().map(|text| {
        let (name, value) = text
            .rsplit_once('=')
            .ok_or_else(|| format!("--tolerance {text}: write NAME=VALUE, such as a-b=0.1"))?;
        Ok((name.trim().to_owned(), deviations(value)?))
    });
    let named = named.collect::<Result<Vec<_>, String>>()?;
    arguments.measured.of(&problem)?;
    let limits = limits(&problem, &named, default.as_ref());
    let limits = limits.map_err(|error| format!("{}: {error}", file.display()))?;
    let limited: Vec<usize> = limits.iter().map(|one| one.index).collect();
    made.held_though_computed = held_though_computed(&problem, &limited);
    if default.is_some() || problem.tolerances.default.is_some() {
        say_exact(&problem, &limited);
    }
    if arguments.all {
        if !results.pictures.is_empty() {
            let what = "pictures are of the figure drawn, and not of all: leave out --all or them";
            return Err(what.to_owned().into());
        }
        return run_all(arguments, (&problem, &made), &limits, results);
    }
    let mut control = interrupt::control();
    let study = study(
        &problem,
        &limits,
        &arguments.measured.texts(&problem),
        &Options::certified(),
        &mut control,
    );
    let mut study = study.map_err(|error| Refusal::of_run(file, &error, &control))?;
    // What was left out of a sketch, and what is held, belongs to what is said.
    study.account.join(&made);
    results.write_csv(|| tolerances_to_csv(&problem, &study));
    results.write(|| Document::tolerance(&problem, &study))?;
    results.print_or_say(
        || tolerances_to_table(&problem, &study),
        || tolerances_in_words(&problem, &study),
    );
    Ok(results.code(CLOSED))
}

/// Says which lengths a default leaves exact: there are limits of some kinds only.
fn say_exact(problem: &Problem, limited: &[usize]) {
    let is_length = |index: usize| match index.checked_sub(problem.distances.len()) {
        None => true,
        Some(c) => match measure_of(problem, c) {
            Measure::Signed => problem.constraints[c].kind != "values",
            other => other == Measure::Length,
        },
    };
    let exact = problem
        .dimensions()
        .filter(|index| !limited.contains(index));
    let exact = exact.filter(|&index| is_length(index));
    let names: Vec<String> = exact.map(|index| problem.dimension_name(index)).collect();
    if !names.is_empty() {
        output::complain(&format!(
            "{}: exact, as the default is for distances between points and radii alone: {}",
            problem.name,
            list(&names, 10)
        ));
    }
}

/// Looks for every figure.
fn run_all(
    arguments: &Arguments,
    (problem, made): (&Problem, &Account),
    limits: &[Limits],
    mut results: Results,
) -> Result<u8, Refusal> {
    let mut control = interrupt::control();
    let line = ProgressLine::new(!arguments.quiet, "");
    let begin = Instant::now();
    let tell = |now: Progress| line.show_search(now, begin.elapsed().as_secs_f64());
    let search = complete::Options {
        cancel: Some(interrupt::flag()),
        threads: arguments.threads.unwrap_or(0).into(),
        progress: Some(&tell),
        ..complete::Options::default()
    };
    let texts = arguments.measured.texts(problem);
    let options = (&Options::certified(), &search);
    let set = study_all(problem, limits, &texts, options, &mut control);
    line.clear();
    let file = &arguments.source.file;
    let mut set = set.map_err(|error| Refusal::of_run(file, &error, &control))?;
    set.account.join(made);
    results.write(|| Document::tolerances(problem, &set))?;
    results.print_or_say(
        || tolerance_set_to_table(problem, &set),
        || tolerance_set_in_words(problem, &set),
    );
    let is_decided = set.undecided.is_empty() && !control.is_interrupted();
    Ok(results.code(if is_decided { CLOSED } else { STOPPED }))
}

/// How far down and up: `0.1` is both.
fn deviations(text: &str) -> Result<[Decimal; 2], String> {
    let number = |text: &str| {
        let text = text.trim();
        let number = text.strip_prefix('+').unwrap_or(text).parse::<Decimal>();
        number.map_err(|error| format!("the tolerance `{text}`: {error}"))
    };
    match text.split_once(',') {
        None => {
            let both = number(text)?;
            match both.to_f64() < 0.0 {
                true => Err(format!(
                    "the tolerance `{text}` is less than 0: write 0.1, or -0.2,0.1"
                )),
                false => Ok([both.negative(), both]),
            }
        }
        Some((a, b)) => {
            let (a, b) = (number(a)?, number(b)?);
            Ok(if a.value() <= b.value() {
                [a, b]
            } else {
                [b, a]
            })
        }
    }
}
