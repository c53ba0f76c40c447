//! `krawl limits`: how far each dimension can go alone.

use super::edit::{LeftOut, drawn_in_words, open};
use super::output::{self, Refusal, in_file};
use super::pictures::Pictures;
use super::results::Results;
use super::{CLOSED, STOPPED, input, interrupt};
use krawl::edit::{End, Setting};
use krawl::report::{Document, ranges_to_table};
use std::path::PathBuf;

/// For every dimension, how far it can go alone, all others standing still, with proof
///
/// The figure is the sketch in FILE, which should meet its dimensions, at least nearly.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl limits problems/mechanisms/four-bar.toml
  krawl limits docs/examples/plate.toml --html limits.html   the figures at the limits

Exit codes: 0 all ranges are known to their ends, 1 some are not, 2 bad input, or results that could not
be written.")]
pub struct Arguments {
    #[command(flatten)]
    source: input::Source,
    /// Only this dimension, such as a-b or radii:hole
    ///
    /// Or angles:a-b-c; may be given more than once
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    pictures: Pictures,
    #[command(flatten)]
    left_out: LeftOut,
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
    let problem = &loaded.problem;
    output::say_if_signs_are_not_looked_at(problem);
    let only = arguments.only.iter();
    let only = only.map(|name| Setting::find(problem, name));
    let only = only.collect::<Result<Vec<_>, _>>();
    let mut only = only.map_err(in_file(file))?;
    loaded.check_numbers(&only).map_err(in_file(file))?;
    if only.is_empty() {
        let all = problem.dimensions();
        only = all.filter(|&index| loaded.has_number(index)).collect();
    }
    loaded.say_computed(&only);
    let named = [arguments.json.as_deref(), None];
    let mut results = Results::open([file], named, &arguments.pictures, arguments.quiet)?;
    let mut control = interrupt::control();
    let options = arguments.left_out.options();
    let mut session = open(problem, file, &options, &mut control)?;
    let ranges = only.iter().map(|&index| session.range(index, &mut control));
    let mut ranges: Vec<_> = ranges.collect();
    for range in &mut ranges {
        loaded.add_left_out(&mut range.account, None);
    }
    results.write(|| Document::limits(problem, &ranges, session.moved()))?;
    results.print(|| {
        let drawn = drawn_in_words(problem, &session);
        drawn + &ranges_to_table(problem, &ranges, session.moved())
    });
    let is_known = |end: &End| !matches!(end, End::Unknown(..));
    let all = ranges
        .iter()
        .all(|range| is_known(&range.low) && is_known(&range.high));
    Ok(results.code(if all { CLOSED } else { STOPPED }))
}
