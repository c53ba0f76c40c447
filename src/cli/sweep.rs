//! `krawl sweep`: drives a mechanism through a range of one dimension.

use super::edit::{LeftOut, certified, commit, drawn_in_words, exit_code, open, reason};
use super::measured::Measured;
use super::output::{self, Beside, Refusal, in_file};
use super::pictures::Pictures;
use super::results::Results;
use super::{input, interrupt, table};
use krawl::constraint::MOST_TURN;
use krawl::edit::{Asked, Setting, SettingError, evenly};
use krawl::problem::{Decimal, Problem};
use krawl::report::{Document, sweep_in_words, sweep_to_csv};
use std::path::PathBuf;

/// Drive one dimension through a range: the figure as a function of it, every frame proved
///
/// The figure in FILE is led to the first value, and from there to the last one. Every frame is proved to be the one and
/// only continuation of the one before. Where the mechanism comes to a limit the sweep ends, and the limit is enclosed.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl sweep problems/mechanisms/jansen.toml --vary M-F --from 24 --to 53 --frames 100 --csv leg.csv
  krawl sweep problems/mechanisms/jansen.toml --vary M-F --from 24 --to 53 --html leg.html
  krawl sweep problems/mechanisms/crank.toml --vary turns:D-A-B --from 0 --to 360 --html crank.html
  krawl sweep problems/mechanisms/four-bar.toml --table docs/examples/four-bar.csv --csv frames.csv

Exit codes: 0 all frames were reached; 3 limit, 4 branches meet, 1 stopped: the frames before are written;
2 bad input, or results that could not be written.")]
pub struct Arguments {
    #[command(flatten)]
    pub(super) source: input::Source,
    /// The dimension that is driven, such as a-b, radii:hole or angles:a-b-c, or a parameter
    ///
    /// What a problem file computes from a parameter is driven with it
    #[arg(long, value_name = "NAME", required_unless_present = "table")]
    vary: Option<String>,
    /// Its first value
    #[arg(
        long,
        value_name = "VALUE",
        allow_negative_numbers = true,
        required_unless_present = "table"
    )]
    from: Option<String>,
    /// Its last value
    #[arg(
        long,
        value_name = "VALUE",
        allow_negative_numbers = true,
        required_unless_present = "table"
    )]
    to: Option<String>,
    /// Drive several dimensions together, from row to row of a table
    ///
    /// CSV, the first line names of dimensions or parameters, each other one their values
    #[arg(long, value_name = "FILE", conflicts_with_all = ["vary", "from", "to", "frames", "json", "cert", "html", "svg", "animation", "obj", "dxf", "xyz"])]
    table: Option<PathBuf>,
    /// With --table: write the figure of each row into this folder
    ///
    /// Into the file that it is of, as FILE-1, FILE-2, ...
    #[arg(long, value_name = "DIR", requires = "table")]
    pub(super) out_folder: Option<PathBuf>,
    /// The number of frames, at equal distances, both ends among them
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    frames: u32,
    /// Write the frames as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the frames as CSV; `-` is standard output
    ///
    /// The value, then the coordinates of all points
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
    /// Write the proof as a certificate, and check it
    ///
    /// It is checked as `verify` does. Where it does not pass, the exit code is that of `verify`. The figure is then
    /// followed as a whole, with what nothing determines held where it is
    #[arg(long, value_name = "FILE", conflicts_with = "simple")]
    cert: Option<PathBuf>,
    /// Do not check the certificate that was written
    #[arg(long, requires = "cert", hide_short_help = true)]
    no_verify: bool,
    #[command(flatten)]
    pub(super) measured: Measured,
    #[command(flatten)]
    pictures: Pictures,
    #[command(flatten)]
    pub(super) left_out: LeftOut,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print no summary
    #[arg(long)]
    pub(super) quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, Refusal> {
    arguments.time.begin();
    match (
        &arguments.table,
        &arguments.vary,
        &arguments.from,
        &arguments.to,
    ) {
        (Some(table), ..) => table::run(arguments, table),
        (None, Some(vary), Some(from), Some(to)) => drive(arguments, vary, [from, to]),
        _ => unreachable!("each of the three is required where there is no table"),
    }
}

/// Drives one dimension through a range.
fn drive(arguments: &Arguments, vary: &str, ends: [&str; 2]) -> Result<u8, Refusal> {
    let file = &arguments.source.file;
    let loaded = arguments.source.load()?;
    let problem = &loaded.problem;
    output::say_if_signs_are_not_looked_at(problem);
    let named = ends.map(|value| (vary, value));
    let asked = Asked::rows(problem, &named, 1).map_err(in_file(file))?;
    let count = asked.settings.len() / ends.len();
    let first = &asked.settings[..count];
    Setting::check(&asked.problem, first).map_err(in_file(file))?;
    let led = asked.given[..count].iter().map(|setting| setting.index);
    let led: Vec<usize> = led.collect();
    loaded.check_numbers(&led).map_err(in_file(file))?;
    loaded.say_computed(&led);
    let measures = arguments.measured.of(problem)?;
    let as_turns = asked.in_words(problem);
    let [from, to]: [Decimal; 2] = ends.map(|value| value.parse().expect("it was just parsed"));
    let frames = arguments.frames as usize;
    let rows = || evenly(&from, &to, frames).map(|value| asked.with(count, (vary, &value)));
    check(&asked.problem, rows()).map_err(in_file(file))?;
    let rows = || rows().map(|row| row.expect("it was just checked"));
    let mut problem = asked.problem.clone();
    let mut cert = arguments.cert.as_deref();
    let mut account = None;
    if cert.is_some() {
        match certified(file, (&problem, first), |session| {
            let sweep = session.sweep_through(rows(), &mut interrupt::control());
            let stop = reason(sweep.end.as_ref().unwrap_or(&sweep.approach));
            (sweep.account, stop)
        })? {
            Some(found) => {
                problem = found.problem;
                account = Some(found.account);
            }
            None => cert = None,
        }
    }
    let mut results = arguments.results()?;
    interrupt::flag();
    let begun = cert.map(Beside::new).transpose()?;
    let mut witness = begun.as_ref().map(|beside| beside.certificate(&problem));
    let mut control = interrupt::witnessed(witness.as_mut());
    let options = arguments.left_out.options();
    let mut session = open(&problem, file, &options, &mut control)?;
    // What a certificate leaves out follows from the rest.
    let carried = |setting: &Setting| setting.carried(&asked.problem, &problem).ok().flatten();
    let rows = rows().map(|row| match cert {
        Some(_) => row.iter().filter_map(carried).collect(),
        None => row,
    });
    let mut sweep = session.sweep_through(rows, &mut control);
    let index = sweep.led[0];
    if let Some(account) = account {
        sweep.account = account;
    }
    for frame in &sweep.frames {
        loaded.add_left_out(&mut sweep.account, Some(&frame.points));
    }
    let last = sweep.end.as_ref().unwrap_or(&sweep.approach);
    let (is_written, verdict) = commit(
        (begun.as_ref(), witness),
        (file, last),
        cert.filter(|_| !arguments.no_verify),
        arguments.quiet,
    )?;
    let frames = || {
        sweep
            .frames
            .iter()
            .map(|frame| (&frame.points[..], &frame.objects[..]))
    };
    results.note(is_written);
    results.write(|| {
        let mut document = Document::sweep(&problem, index, &sweep);
        document.beside.measures = measures.told(frames());
        document
    })?;
    results.write_csv(|| sweep_to_csv(&problem, index, &sweep, &measures));
    results.print(|| {
        let words = drawn_in_words(&problem, &session) + &sweep_in_words(&problem, index, &sweep);
        as_turns + &words + "\n" + &measures.over(frames())
    });
    Ok(results.code(verdict.unwrap_or(exit_code(last))))
}

/// Whether each row of settings makes sense, and no turn goes too far from one to the next.
fn check(
    problem: &Problem,
    rows: impl Iterator<Item = Result<Vec<Setting>, SettingError>>,
) -> Result<(), String> {
    let degrees = |setting: &Setting| {
        let c = setting.index.checked_sub(problem.distances.len())?;
        let is_turn = problem.constraints[c].kind == "turns";
        is_turn.then(|| setting.target.to_f64())
    };
    let mut before: Option<Vec<Setting>> = None;
    for row in rows {
        let row = row.map_err(|error| error.to_string())?;
        for (was, is) in before.iter().flatten().zip(&row) {
            let (Some(from), Some(to)) = (degrees(was), degrees(is)) else {
                continue;
            };
            let step = (to - from).abs();
            if step > MOST_TURN.into() {
                let name = problem.dimension_name(is.index);
                return Err(format!(
                    "{name} turns by {step} degrees from one frame to the next; at most {MOST_TURN} are allowed: ask for more `--frames`"
                ));
            }
        }
        before = Some(row);
    }
    Ok(())
}

impl Arguments {
    /// Where results go.
    pub(super) fn results(&self) -> Result<Results<'_>, String> {
        let named = [self.json.as_deref(), self.csv.as_deref()];
        Results::open([&self.source.file], named, &self.pictures, self.quiet)
    }
}
