//! `krawl tolerance`: every dimension within its limits, and what that does to the figure.

use super::measured::Measured;
use super::output::{self, Destination, beside};
use super::pictures::Pictures;
use super::{BAD_INPUT, CLOSED, STOPPED, input, interrupt};
use krawl::blocks::Account;
use krawl::complete::{self, Progress};
use krawl::edit::Limits;
use krawl::problem::{Decimal, Problem};
use krawl::report::{
    ProgressLine, tolerance_set_in_words, tolerance_set_to_table, tolerance_set_to_value,
    tolerances_in_words, tolerances_to_csv, tolerances_to_table, tolerances_to_value,
};
use krawl::tolerance::{limits, study, study_all};
use krawl::track::Options;
use std::path::PathBuf;
use std::time::Instant;

/// Every dimension within its limits: between which bounds lengths, angles and areas then are, with proof
///
/// For all choices of all dimensions together there is exactly one figure that the one in FILE becomes, and what is measured stays within the
/// worst case that is printed; so much of it is due to each dimension. Limits are in FILE under [tolerances], or given here.
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
    /// The tolerance of all lengths and radii that have none of their own
    ///
    /// 0.1, or so far down and up, -0.2,0.1
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
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    arguments.time.begin();
    let shown = arguments.source.file.display();
    let loaded = arguments.source.load()?;
    loaded.say_computed(&loaded.problem.dimensions().collect::<Vec<_>>());
    let (problem, made) = input::whole_of(&arguments.source.file, &loaded)?;
    let made = made.with_other_numbers();
    output::say_if_signs_are_not_looked_at(&problem);
    let json = beside([&arguments.source.file], arguments.json.as_deref())?;
    let csv = beside([&arguments.source.file], arguments.csv.as_deref())?;
    let pictures = arguments.pictures.places([&arguments.source.file])?;
    let default = arguments.default.as_deref().map(deviations).transpose()?;
    let named = arguments.tolerance.iter().map(|text| {
        let (name, value) = text
            .rsplit_once('=')
            .ok_or_else(|| format!("--tolerance {text}: write NAME=VALUE, such as a-b=0.1"))?;
        Ok((name.trim().to_owned(), deviations(value)?))
    });
    let named = named.collect::<Result<Vec<_>, String>>()?;
    arguments.measured.of_points(&problem)?;
    let in_file = |error: String| format!("{shown}: {error}");
    let limits = limits(&problem, &named, default.as_ref()).map_err(in_file)?;
    if arguments.all {
        if !pictures.is_empty() {
            return Err(
                "pictures are of the figure drawn, and not of all: leave out --all or them"
                    .to_owned(),
            );
        }
        return run_all(arguments, (&problem, &made), &limits, json.as_ref());
    }
    let mut control = interrupt::control();
    let study = study(
        &problem,
        &limits,
        &arguments.measured.texts(&problem),
        &Options::certified(),
        &mut control,
    );
    let mut study = match study {
        Err(_) if control.is_interrupted() => {
            output::complain(INTERRUPTED);
            return Ok(STOPPED);
        }
        study => study.map_err(in_file)?,
    };
    // What was left out of a sketch, and what is held, belongs to what is said.
    study.account.join(&made);
    let mut written = true;
    if let Some(csv) = &csv {
        written &= csv.write(&tolerances_to_csv(&problem, &study));
    }
    written &= pictures.write_result(json.as_ref(), || tolerances_to_value(&problem, &study))?;
    let standard = Some(Destination::StandardOutput);
    let elsewhere = json == standard || csv == standard || pictures.use_standard_output();
    if elsewhere && !arguments.quiet {
        output::complain(&tolerances_in_words(&problem, &study));
    } else if !arguments.quiet {
        written &= output::print(&tolerances_to_table(&problem, &study));
    }
    Ok(if written { CLOSED } else { BAD_INPUT })
}

const INTERRUPTED: &str = "interrupted before anything was proved";

/// Looks for every figure.
fn run_all(
    arguments: &Arguments,
    (problem, made): (&Problem, &Account),
    limits: &[Limits],
    json: Option<&Destination>,
) -> Result<u8, String> {
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
    let mut set = match set {
        Err(_) if control.is_interrupted() => {
            output::complain(INTERRUPTED);
            return Ok(STOPPED);
        }
        set => set.map_err(|error| format!("{}: {error}", arguments.source.file.display()))?,
    };
    set.account.join(made);
    let mut written = true;
    if let Some(json) = json {
        written &= json.write(&format!("{}\n", tolerance_set_to_value(problem, &set)));
    }
    if !arguments.quiet && json == Some(&Destination::StandardOutput) {
        output::complain(&tolerance_set_in_words(problem, &set));
    } else if !arguments.quiet {
        written &= output::print(&tolerance_set_to_table(problem, &set));
    }
    Ok(match written {
        false => BAD_INPUT,
        true if set.undecided.is_empty() && !control.is_interrupted() => CLOSED,
        true => STOPPED,
    })
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
