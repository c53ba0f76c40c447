//! `krawl tolerance`: every dimension within its limits, and what that does to the figure.

use super::measured::Measured;
use super::output::{self, Destination, beside};
use super::pictures::Pictures;
use super::{BAD_INPUT, CLOSED, STOPPED, input, interrupt};
use krawl::problem::Decimal;
use krawl::report::{
    tolerances_in_words, tolerances_to_csv, tolerances_to_table, tolerances_to_value,
};
use krawl::tolerance::{limits, study};
use krawl::track::Options;
use std::path::PathBuf;

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

Exit codes: 0 proved, 1 interrupted, 2 bad input, or limits for which it is not proved that there is one figure for each choice, or results that could not be
written.")]
pub struct Arguments {
    #[command(flatten)]
    source: input::Source,
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
    let (problem, made) = input::whole_of(&arguments.source.file, &arguments.source.load()?)?;
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
            output::complain("interrupted before anything was proved");
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
