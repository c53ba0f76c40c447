//! `krawl sweep`: drives a mechanism through a range of one dimension.

use super::edit::{beside, exit_code, open};
use super::output::{self, Destination};
use super::{BAD_INPUT, CLOSED, input, interrupt};
use krawl::edit::{Ending, Setting};
use krawl::problem::Decimal;
use krawl::report::{sweep_in_words, sweep_to_csv, sweep_to_json};
use krawl::track::Control;
use std::path::PathBuf;

/// Drive one dimension through a range: the figure as a function of it, every frame proved
///
/// The figure in FILE is led to the first value, and from there to the last one. Every frame is proved to be the one and
/// only continuation of the one before. Where the mechanism comes to a limit the sweep ends, and the limit is enclosed.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  krawl sweep problems/mechanisms/jansen.toml --vary M-F --from 24 --to 53 --frames 100 --csv leg.csv

Exit codes: 0 all frames were reached; 3 limit, 4 branches meet, 1 stopped: the frames before are written;
2 bad input, or results that could not be written.")]
pub struct Arguments {
    /// The problem file (TOML), or a sketch of SolveSpace (.slvs) or FreeCAD (.FCStd)
    file: PathBuf,
    /// Which sketch of a .slvs or .FCStd file, where it holds several
    #[arg(long, value_name = "NAME")]
    sketch: Option<String>,
    /// The dimension that is driven, such as a-b
    #[arg(long, value_name = "NAME")]
    vary: String,
    /// Its first value
    #[arg(long, value_name = "VALUE")]
    from: String,
    /// Its last value
    #[arg(long, value_name = "VALUE")]
    to: String,
    /// How many figures, at equal distances, both ends among them
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    frames: u32,
    /// Write the frames as JSON; `-` writes them to standard output in place of the summary
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the frames as CSV: the value, then the coordinates of all points; `-` likewise
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print no summary
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> u8 {
    output::exit_code(try_run(arguments))
}

fn try_run(arguments: &Arguments) -> Result<u8, String> {
    let shown = arguments.file.display();
    let problem = input::load(&arguments.file, arguments.sketch.as_deref())?.problem;
    let in_file = |error: &dyn std::fmt::Display| format!("{shown}: {error}");
    let [from, to] =
        [&arguments.from, &arguments.to].map(|value| -> Result<(usize, Decimal), String> {
            let setting =
                Setting::named(&problem, &arguments.vary, value).map_err(|e| in_file(&e))?;
            let value = value.parse().expect("it was just parsed");
            Ok((setting.index, value))
        });
    let ((index, from), (_, to)) = (from?, to?);
    let json = beside(&arguments.file, arguments.json.as_deref())?;
    let csv = beside(&arguments.file, arguments.csv.as_deref())?;
    let mut control = Control {
        cancel: Some(interrupt::flag()),
        ..Control::default()
    };
    let mut session = match open(&problem, &arguments.file, true, &mut control)? {
        Ok(session) => session,
        Err(code) => return Ok(code),
    };
    let sweep = session.sweep(index, (&from, &to), arguments.frames as usize, &mut control);
    let mut written = true;
    if let Some(json) = &json {
        written &= json.write(&(sweep_to_json(&problem, index, &sweep) + "\n"));
    }
    if let Some(csv) = &csv {
        written &= csv.write(&sweep_to_csv(&problem, index, &sweep));
    }
    let is_piped = [&json, &csv]
        .iter()
        .any(|d| **d == Some(Destination::StandardOutput));
    if !arguments.quiet && !is_piped {
        written &= output::print(&(sweep_in_words(&problem, index, &sweep) + "\n"));
    }
    Ok(match (written, &sweep.end) {
        (false, _) => BAD_INPUT,
        (true, Some(end)) => exit_code(end),
        (true, None) if sweep.approach.ending != Ending::Reached => exit_code(&sweep.approach),
        (true, None) => CLOSED,
    })
}
