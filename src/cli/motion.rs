//! `krawl motion`: how a figure moves that has one degree of freedom.

use super::measured::Measured;
use super::output::{self, Beside, Refusal, in_file};
use super::pictures::Pictures;
use super::results::Results;
use super::verify::check_written;
use super::{BAD_INPUT, CLOSED, OPEN, STOPPED, input, interrupt};
use krawl::edit::{Setting, held_though_computed};
use krawl::motion::Motion;
use krawl::report::{Document, motion_in_words, motion_to_csv, motion_to_table};
use krawl::track::Options;
use std::path::{Path, PathBuf};

/// Follow a linkage all the way round, with proof: between which bounds lengths and angles stay
///
/// The figure in FILE has one degree of freedom, or has one once --free leaves a dimension out. All figures that it can move through are
/// followed, until it comes back or to its two ends, past every dead centre. Each step is proved, so nothing between is missed, and no
/// branch is taken for another.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl motion problems/mechanisms/crank.toml --free turns:D-A-B
  krawl motion problems/mechanisms/crank.toml --free turns:D-A-B --measure \"angle A D C\" --measure \"turn D A B\"
  krawl motion problems/mechanisms/four-bar.toml --free B-D --html motion.html    a page with a slider
  krawl motion problems/mechanisms/jansen.toml --free M-F --csv leg.csv           the frames, for a plot of the foot's curve
  krawl motion problems/mechanisms/four-bar.toml --free B-D --cert proof.krawl    the proof, for `krawl verify`

Exit codes: 0 it comes back, 5 it has two ends, 1 it could not be followed to an end: what is printed holds as far as it was followed; 3 or 4 the
certificate does not prove the whole way (see `krawl verify --help`); 2 bad input, a figure that cannot move or can move in more than one way, or results that could not be written.")]
pub struct Arguments {
    #[command(flatten)]
    source: input::Source,
    /// Leave this dimension out, so that the figure can move
    ///
    /// Such as a-b or angles:a-b-c; may be given more than once
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write frames as CSV, at equal steps of the way
    ///
    /// How far it is, the coordinates of all points, what is measured; `-` is standard output
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the proof as a certificate, and check it
    ///
    /// It is of the way of the figures, and says nothing of what is measured. `krawl verify` checks it again; where it does not pass, the exit
    /// code is that of `verify`
    #[arg(long, value_name = "FILE")]
    cert: Option<PathBuf>,
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
    let loaded = arguments.source.load()?;
    let problem = &loaded.problem;
    output::say_if_signs_are_not_looked_at(problem);
    // What can be measured is known before anything is followed.
    let measures = arguments.measured.with_meaning(problem)?;
    let file = &arguments.source.file;
    let named = [arguments.json.as_deref(), arguments.csv.as_deref()];
    output::refuse_read([file], arguments.cert.as_deref())?;
    let mut results = Results::open([file], named, &arguments.pictures, arguments.quiet)?;
    let free = arguments.free.iter();
    let free = free.filter_map(|name| Setting::find(problem, name).ok());
    let free: Vec<usize> = free.collect();
    loaded.check_numbers(&free).map_err(in_file(file))?;
    let mut control = interrupt::control();
    let motion = Motion::of(
        problem,
        &arguments.free,
        &arguments.measured.texts(problem),
        &Options::certified(),
        &mut control,
    );
    let mut motion = motion.map_err(|error| Refusal::of_run(file, &error, &control))?;
    // Frames are not all of the way.
    loaded.add_left_out(&mut motion.account, None);
    motion.account.held_though_computed = held_though_computed(problem, &free);
    results.write_csv(|| motion_to_csv(&motion, &measures));
    results.write(|| Document::motion(&motion))?;
    results.print_or_say(|| motion_to_table(&motion), || motion_in_words(&motion));
    let checked = match &arguments.cert {
        Some(path) => certify(&motion, path, arguments.quiet)?,
        None => None,
    };
    Ok(
        results.code(match (checked, motion.is_loop(), motion.is_told()) {
            (Some(code), ..) => code,
            (_, true, _) => CLOSED,
            (_, _, true) => OPEN,
            _ => STOPPED,
        }),
    )
}

/// Writes the certificate of a motion and checks it: the exit code where it does not pass.
fn certify(motion: &Motion, path: &Path, is_quiet: bool) -> Result<Option<u8>, Refusal> {
    let mut options = Options::certified();
    loop {
        let beside = Beside::new(path)?;
        let mut writer = beside.certificate(motion.certified());
        let told = motion.tell(&options, &mut interrupt::witnessed(Some(&mut writer)));
        let is_other = told.map_err(|error| format!("no certificate was written: {error}"))?;
        if is_other && !options.reverse {
            options.reverse = true;
            continue;
        }
        return match beside.commit(writer.finish().map(|_| ())) {
            true => Ok(check_written(Some(path), motion.is_told(), is_quiet)?),
            false => Ok(Some(BAD_INPUT)),
        };
    }
}
