//! `krawl work`: follows the sketches of a work unit.

use super::output::{self, in_file};
use super::{CLOSED, INCOMPLETE, interrupt};
use krawl::explore::{Limits, Share, Worked, work};
use krawl::report::ProgressLine;
use std::path::{Path, PathBuf};

/// Follow the sketches of a work unit of `krawl explore --shard`, on this machine
///
/// What comes of each is written as soon as it is done. The same command goes on where the last one ended, however
/// that was.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl work store/unit-0.krawl-unit
  krawl work unit-$SLURM_ARRAY_TASK_ID.krawl-unit --jobs 4 --time 3500

Exit codes: 0 all sketches are done, 4 the time ended before (the same command goes on), 2 bad input, or another
process writes to the same results.")]
pub struct Arguments {
    /// The work unit
    unit: PathBuf,
    /// Write the results to this file
    ///
    /// [default: beside the unit, ending in .krawl-result]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Paths to follow at the same time [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Stop after so many seconds
    #[arg(long, value_name = "S", value_parser = super::all::seconds)]
    time: Option<f64>,
    /// A path that takes more tubes is given up
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_tubes: usize,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Reads a unit.
fn read(path: &Path) -> Result<Share, String> {
    let text = std::fs::read_to_string(path).map_err(in_file(path))?;
    Share::read(&text).map_err(in_file(path))
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let share = read(&arguments.unit)?;
    let beside = || arguments.unit.with_extension("krawl-result");
    let out = arguments.out.clone().unwrap_or_else(beside);
    if output::is_same_file(&out, &arguments.unit) {
        return Err(format!(
            "{}: is the unit itself; name another file for the results",
            out.display()
        ));
    }
    let line = ProgressLine::new(!arguments.quiet, "");
    let tell = |now: Worked| {
        line.show_text(format!("{} of {} paths", now.done, now.of));
    };
    let limits = Limits {
        most_tubes: arguments.max_tubes,
        cancel: Some(interrupt::flag()),
        deadline: interrupt::deadline(arguments.time),
    };
    let jobs = arguments.jobs.unwrap_or(0).into();
    let worked = work(&share, &out, jobs, &limits, &tell);
    line.clear();
    let Worked { done, of } = worked.map_err(|error| error.to_string())?;
    if !arguments.quiet {
        output::print(&format!("{}: {done} of {of} paths\n", out.display()));
    }
    Ok(if done == of { CLOSED } else { INCOMPLETE })
}
