//! `krawl solve`: follows the path of a problem and prints the solutions.

use super::edit::LeftOut;
use super::measured::{Measured, placed};
use super::output::{self, Beside, Destination};
use super::pictures::Pictures;
use super::take::{Candidates, Take, Taken};
use super::verify::check_written;
use super::{BAD_INPUT, CLOSED, LIMIT, OPEN, STOPPED, input, interrupt};
use crate::order::InOrder;
use crate::places::Each as _;
use clap::ValueEnum;
use krawl::blocks::{Figures, First as Nearest, MOST_POINTS, clusters};
use krawl::certificate::Writer;
use krawl::complete::{Among, Surplus, Tested, among, has_equations_to_spare};
use krawl::constraint::fix_frame;
use krawl::edit::{Alone, alone};
use krawl::problem::{Problem, free_coordinates};
use krawl::remarks::{Remark, in_words, moves, remarks};
use krawl::report::page::Page;
use krawl::report::{
    BlockRuns, Listed, ProgressLine, Run, alone_in_words, alone_to_value, among_in_words,
    figures_to_summary, figures_to_table, figures_to_value, first_in_words, part_in_words,
    signed_in_words, to_first_table, to_no_first, to_short_table, to_summary, to_table,
};
use krawl::track::{
    self, Control, EndKind, First, Limit, Options, Outcome, PathEnd, Progress, Signs, Status,
    Trace, Witness,
};
use serde_json::Value;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Follow the path through the sketch and list the figures on it that meet the dimensions
///
/// The solutions come in the order in which the path meets them, in coordinates in which the reference
/// points are fixed: the first at the origin, the second on the x axis. Solutions of the same class are
/// congruent: the same figure, or its mirror image. `reached without a fold` marks the one to which the
/// sketch moves without turning back when its dimensions are led to their targets.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl solve sketch.toml                      the solutions, with proof
  krawl solve sketch.toml --html page.html     a page to look at
  krawl solve sketch.toml --json out.json      for programs (docs/using/programs.md); `krawl show` draws it
  krawl solve a.toml b.toml c.toml --summary   one line for each
  krawl generate strip --size 100 | krawl solve -
  krawl solve sketch.toml --cert proof.krawl   leave the proof; `krawl verify` checks it
  krawl solve problems/sketches/parts.FCStd --sketch Frame  a sketch of FreeCAD or SolveSpace, block by block

A sketch of FreeCAD or SolveSpace is solved block by block, each where the blocks that it needs are; so is a problem in
its own frame that stops as a whole or has not as many equations as unknowns, and one of distances that falls apart
(docs/using/cad.md). A sketch is followed as a whole where a path is asked for: --cert, --animation, --samples, --space,
--reverse, --mode float.

Exit codes: 0 all paths closed, 1 a run stopped (its result says where and why, and keeps what it
found), 2 bad input or results that could not be written, 5 open: a path came to an end both ways, and all between is
proved (with --mode float: observed).")]
pub struct Arguments {
    /// Problem files (TOML; `-` is standard input), sketches or molecules
    ///
    /// Sketches of SolveSpace (.slvs) and FreeCAD (.FCStd); molecules (.xyz, .mol, .sdf, .pdb, .ent)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Which sketch or molecule of a file (`krawl check` lists them)
    #[arg(long, value_name = "NAME")]
    sketch: Option<String>,
    /// Only the solution to which the sketch moves without a fold
    ///
    /// Exit code 0 if there is one, 3 if the path turns back before, 1 if that could not be proved, as in float mode.
    /// Of a sketch of another program: the figure nearest to it in which angles, parallels, tangents and joined
    /// points turn as there; 3 if no figure found is such
    #[arg(long, conflicts_with_all = ["all", "summary", "cert", "reverse"])]
    first: bool,
    /// `certified` proves every step, `float` tracks in plain floats
    #[arg(long, value_enum, hide_possible_values = true, default_value_t = Mode::Certified)]
    mode: Mode,
    /// All free coordinates, or the driving parameters of a plan
    ///
    /// [default: reduced for float, and for certified from 70 free coordinates on; otherwise full]
    #[arg(long, value_enum, hide_short_help = true)]
    space: Option<Space>,
    /// Float mode: steps by rules of our own, or of RR 8705, 7.1 to 7.3
    #[arg(long, help_heading = "For experiments", value_enum, default_value_t = Preset::Default, hide_short_help = true)]
    preset: Preset,
    /// How near a boundary configuration the plan is changed, up to 0.5
    #[arg(long, help_heading = "For experiments", value_name = "X", default_value = "0.1", value_parser = alpha, hide_short_help = true)]
    alpha: f64,
    /// No step is longer than this, along the path
    #[arg(long, help_heading = "For experiments", value_name = "X", value_parser = positive, hide_short_help = true)]
    max_step: Option<f64>,
    /// Certified mode: the radius of tubes
    ///
    /// How far the path may be from the middle of a tube. Extended precision is never switched on for the sake of a
    /// small radius alone
    #[arg(long, help_heading = "For experiments", value_name = "X", value_parser = positive, hide_short_help = true)]
    tube_radius: Option<f64>,
    /// Certified mode: keep to 53 bits, and stop where they do not suffice
    ///
    /// Otherwise extended precision is switched on there (which only the full space has)
    #[arg(long, help_heading = "For experiments", hide_short_help = true)]
    no_extended: bool,
    /// Float mode: points are corrected until a correction is about this small
    #[arg(long, help_heading = "For experiments", value_name = "X", value_parser = positive, hide_short_help = true)]
    tolerance: Option<f64>,
    /// Follow the loop the other way round
    #[arg(long, hide_short_help = true)]
    reverse: bool,
    /// Threads for one run in certified mode; 0 is one for each processor
    ///
    /// With two or more a path of distances alone is followed both ways from the sketch at once, until these meet;
    /// with 127 free coordinates and more in the full space products of matrices take several too. What is proved is
    /// the same, bounds may differ in their last digits. Runs with --cert, --json or a picture go one way, as what
    /// they keep is in the order of the path
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=1024))]
    threads: u16,
    /// Write the proof as a certificate, and check it
    ///
    /// It is checked as `verify` does; only for runs in certified mode. Where a certificate of a closed run does not
    /// pass, the exit code is that of `verify`
    #[arg(long, value_name = "FILE")]
    cert: Option<PathBuf>,
    /// Do not check the certificate that was written
    #[arg(long, requires = "cert", hide_short_help = true)]
    no_verify: bool,
    /// Write the result as JSON; `-` is standard output
    ///
    /// One line for each problem
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Certified mode: the number of figures along the path in the JSON and the page
    #[arg(long, value_name = "N", value_parser = samples, hide_short_help = true)]
    samples: Option<usize>,
    #[command(flatten)]
    take: Take,
    #[command(flatten)]
    measured: Measured,
    #[command(flatten)]
    pictures: Pictures,
    /// Print one line for each problem
    #[arg(long)]
    summary: bool,
    /// Print all solutions, however many lines they take
    #[arg(long, conflicts_with = "summary")]
    all: bool,
    /// Do not say how many of all figures the path has
    ///
    /// That is looked for, with proof, where it takes but some milliseconds: of distances alone, up to 10 points,
    /// with a construction plan of one driving parameter
    #[arg(long, hide_short_help = true)]
    no_count: bool,
    #[command(flatten)]
    left_out: LeftOut,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

/// The figures of a sketch, and the number of the one that `--first` means, if it is there.
struct Found {
    figures: Figures,
    first: Option<u64>,
}

/// Of so many figures of a sketch, which may have many, measures are told.
const MOST_MEASURED: u64 = 1000;

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Mode {
    Certified,
    Float,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Space {
    Full,
    Reduced,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Preset {
    Default,
    Paper,
}

fn alpha(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x < 0.5 => Ok(x),
        _ => Err("must be a number greater than 0 and less than 0.5".to_owned()),
    }
}

pub(super) fn samples(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n) if (2..=100_000).contains(&n) => Ok(n),
        _ => Err("must be a whole number from 2 to 100000".to_owned()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("must be a finite number greater than 0".to_owned()),
    }
}

impl Arguments {
    /// Refuses what does not go together.
    fn check(&self) -> Result<(), String> {
        if self.mode == Mode::Certified && self.preset == Preset::Paper {
            return Err("`--preset paper` is a way of float mode: add `--mode float`".to_owned());
        }
        if self.mode == Mode::Float && self.cert.is_some() {
            return Err(
                "float mode proves nothing: leave out `--cert`, or `--mode float`".to_owned(),
            );
        }
        if self.mode == Mode::Float && self.samples.is_some() {
            return Err(
                "float mode keeps no path: leave out `--samples`, or `--mode float`".to_owned(),
            );
        }
        if self.mode == Mode::Certified && self.tolerance.is_some() {
            return Err(
                "`--tolerance` is for float mode: add `--mode float`, or use `--tube-radius`"
                    .to_owned(),
            );
        }
        if self.mode == Mode::Float && self.tube_radius.is_some() {
            return Err(
                "float mode has no tubes: leave out `--tube-radius`, or use `--tolerance`"
                    .to_owned(),
            );
        }
        if self.mode == Mode::Float && self.no_extended {
            return Err(
                "float mode has no extended precision: leave out `--no-extended`, or `--mode float`"
                    .to_owned(),
            );
        }
        Ok(())
    }

    fn options(&self) -> Options {
        let options = match (self.mode, self.preset) {
            (Mode::Certified, _) => Options::certified(),
            (Mode::Float, Preset::Default) => Options::float(track::Space::Reduced),
            (Mode::Float, Preset::Paper) => Options::paper(track::Space::Reduced),
        };
        Options {
            space: match self.space {
                Some(Space::Full) => track::Space::Full,
                Some(Space::Reduced) => track::Space::Reduced,
                None => options.space,
            },
            max_step: self.max_step,
            tube_radius: self.tube_radius,
            tolerance: self.tolerance,
            reverse: self.reverse,
            alpha: self.alpha,
            extended: !self.no_extended,
            threads: self.threads.into(),
            redundant_tolerance: self.left_out.redundant_tolerance,
            ..options
        }
    }

    /// What is for one problem only, where there are several.
    fn check_count(&self) -> Result<(), String> {
        if self.files.len() > 1 && self.cert.is_some() {
            return Err("`--cert` is for one problem: name one file".to_owned());
        }
        if self.files.len() > 1 && self.take.is_wanted() {
            return Err("`--out` is for one problem: name one file".to_owned());
        }
        for file in &self.files {
            self.take.check(file)?;
        }
        if self.files.len() > 1 && !self.measured.is_empty() {
            return Err("`--measure` is for one problem: name one file".to_owned());
        }
        if self.files.len() > 1 && self.pictures.files().next().is_some() {
            return Err("a page and pictures are of one problem: name one file".to_owned());
        }
        input::only_one_standard_input(self.files.iter().map(PathBuf::as_path))
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> u8 {
    output::exit_code(try_run(arguments))
}

fn try_run(arguments: &Arguments) -> Result<u8, String> {
    arguments.time.begin();
    arguments.check()?;
    arguments.check_count()?;
    // Whatever is wrong is said before anything runs.
    let problems = arguments.files.iter().map(|file| arguments.read(file));
    let problems = problems.collect::<Result<Vec<Asked>, String>>()?;
    let json = arguments
        .json
        .as_deref()
        .map(Destination::new)
        .transpose()?;
    let pictures = arguments.pictures.places(&arguments.files)?;
    let results = [&arguments.json, &arguments.cert].into_iter().flatten();
    for results in results {
        for file in &arguments.files {
            if output::is_same_file(results, file) {
                return Err(format!(
                    "{}: is the problem itself; name another file for the results",
                    results.display()
                ));
            }
        }
    }
    // Before any file is begun, so that an interrupt leaves none behind.
    let cancel = interrupt::flag();
    let cert = arguments.cert.as_deref().map(Beside::new).transpose()?;
    let standard = json == Some(Destination::StandardOutput);
    if standard && pictures.use_standard_output() {
        return Err("only one result can go to standard output".to_owned());
    }
    let silent = arguments.quiet || standard || pictures.use_standard_output();
    let mut lines = String::new();
    let (mut written, mut worst) = (true, CLOSED);
    let named = problems.into_iter().zip(&arguments.files);
    let (count, mut k) = (arguments.files.len(), 0);
    for (asked, file) in named {
        let Asked {
            problem,
            is_by_blocks,
            surplus,
        } = &asked;
        let measures = arguments.measured.of(problem)?;
        let which = output::which_of((k, count), file);
        if !silent
            && !arguments.summary
            && let Some(moves) = moves(problem)
        {
            let words = moves.in_words(problem);
            written &= output::print(&format!("{}: {words}\n\n", problem.name));
        }
        if *is_by_blocks {
            let found = arguments.by_blocks(problem);
            let (text, mut value, code, found) = match found {
                Ok(found) => found,
                // What came of other files is not lost.
                Err(error) => {
                    let all = match input::is_sketch(file) {
                        true => "",
                        false => "; `krawl all` may take it",
                    };
                    output::complain(&format!("{}: {error}{all}", input::name(file)));
                    worst = worse(worst, BAD_INPUT);
                    k += 1;
                    continue;
                }
            };
            written &= arguments.take_of(&found, (problem, file));
            let alone = match value["count"] == 0 && (!silent || json.is_some()) {
                true => arguments.alone(problem),
                false => Vec::new(),
            };
            if !alone.is_empty() {
                value["alone"] = alone_to_value(&alone);
            }
            if !pictures.is_empty() {
                let page = Page::from_result(&value).map_err(|error| error.to_string())?;
                written &= pictures.write(&page);
            }
            if json.is_some() {
                lines += &(value.to_string() + "\n");
            }
            if !silent {
                let gap = arguments.gap_before(k);
                written &= output::print(&format!("{gap}{text}{}", alone_in_words(&alone)));
            }
            worst = worse(worst, code);
            k += 1;
            continue;
        }
        let mut trace = Trace::default();
        let shown = !pictures.is_empty();
        let wants_path = (json.is_some() || shown) && arguments.mode == Mode::Certified;
        let samples = match arguments.samples {
            Some(samples) => samples,
            None if arguments.pictures.want_path() => samples_for(problem),
            None => 0,
        };
        let mut turns_at = None;
        let (mut outcome, well, verdict) = if arguments.first && !shown && samples == 0 {
            let found = follow_first(arguments, problem, &input::name(file), &which)?;
            turns_at = found.turns_at;
            (found.outcome, true, None)
        } else {
            follow(
                arguments,
                problem,
                &input::name(file),
                &which,
                cert.as_ref(),
                wants_path.then_some(&mut trace),
            )?
        };
        written &= well;
        let tested = surplus.as_ref().map(|surplus| surplus.test(&mut outcome));
        let tested = tested.as_ref();
        Signs::of(problem).test(&mut outcome, problem.dimension);
        let unsigned = outcome.signed.unwrap_or_default();
        let struck =
            unsigned.wrong + unsigned.undecided + tested.map_or(0, |tested| tested.missed as u64);
        let unbounded = Unbounded::of(&outcome.status);
        let reason = match &outcome.status {
            Status::Stopped(reason) => Some(&*reason.text),
            _ => unbounded
                .filter(|_| problem.is_absolute())
                .map(|path| path.reason),
        };
        if let Some(reason) = reason
            && arguments.can_be_cut(cancel)
            && tested.is_none()
        {
            if problem.is_absolute()
                && let Some((mut text, value, code, found)) =
                    arguments.instead(problem, reason, unbounded)
            {
                written &= arguments.take_of(&found, (problem, file));
                if arguments.cert.is_some() {
                    // What the certificate is about.
                    let whole = arguments.shown(problem, &outcome, tested);
                    text +=
                        &format!("\nThe path of the whole, as far as it was followed:\n\n{whole}");
                }
                if json.is_some() {
                    let run = Run {
                        problem,
                        options: &arguments.options(),
                        outcome: &outcome,
                        trace: None,
                        samples: 0,
                        tested,
                    };
                    let mut whole = run.to_value();
                    whole["by_blocks"] = value.clone();
                    lines += &(whole.to_string() + "\n");
                }
                if shown {
                    let page = Page::from_result(&value).map_err(|error| error.to_string())?;
                    written &= pictures.write(&page);
                }
                if !silent {
                    let gap = arguments.gap_before(k);
                    written &= output::print(&format!("{gap}{text}"));
                }
                worst = worse(worst, code);
                k += 1;
                continue;
            }
            let blocks = match arguments.cert {
                // What is asked for is a certificate of the whole.
                Some(_) => Vec::new(),
                None if unbounded.is_some() => Vec::new(),
                None => clusters(problem),
            };
            if !blocks.is_empty() {
                let (runs, code) = follow_blocks(arguments, blocks, &input::name(file), &which)?;
                let all = BlockRuns {
                    problem,
                    reason,
                    options: &arguments.options(),
                    runs: &runs,
                };
                if json.is_some() {
                    lines += &(all.to_value(&outcome, arguments.all).to_string() + "\n");
                }
                if shown {
                    let page = Page::from_result(&all.to_value(&outcome, arguments.all));
                    written &= pictures.write(&page.map_err(|error| error.to_string())?);
                }
                if !silent {
                    let gap = arguments.gap_before(k);
                    let hints = hints(problem, &outcome, &input::name(file));
                    written &=
                        output::print(&format!("{gap}{}{hints}", arguments.shown_blocks(&all)));
                }
                if arguments.take.is_wanted() || !arguments.measured.is_empty() {
                    let what = "the solutions listed are of parts of the figure, none of which is written or measured";
                    output::complain(&format!("{}: {what}", input::name(file)));
                    written = false;
                }
                worst = worse(worst, code);
                k += 1;
                continue;
            }
        }
        if wants_path
            && samples > 0
            && let Some(finer) = follow_finely(arguments, problem, &which, &mut outcome)
        {
            trace = finer;
        }
        let first = match arguments.first {
            true => to_first_table(problem, &outcome),
            false => None,
        };
        let mut solutions = outcome.solutions.iter();
        let direct = solutions.position(|s| s.place.is_some_and(|p| p.folds == Some(0)));
        let count = match (arguments.first, direct) {
            (true, None) => 0,
            _ => outcome.solutions.len() as u64,
        };
        let chosen = direct.filter(|_| arguments.first).map(|k| k as u64);
        let from = (file.as_path(), arguments.sketch.as_deref());
        let listed = Candidates {
            count,
            first: chosen,
            is_all: true,
        };
        written &= arguments.take.write(from, problem, listed, |number| {
            Taken::of(problem, &outcome.solutions[number as usize], false)
        });
        let is_undecided = arguments.mode == Mode::Certified
            && (tested.is_some_and(|tested| !tested.is_decided()) || unsigned.undecided > 0);
        worst = match (&outcome.status, worst) {
            _ if arguments.first && struck > 0 => worse(worst, LIMIT),
            _ if first.is_some() && !is_undecided => worst,
            _ if turns_at.is_some() => worse(worst, LIMIT),
            (Status::Stopped(_), _) | (_, STOPPED) => STOPPED,
            // Float runs do not tell which of their solutions is reached without a fold.
            _ if arguments.first && arguments.mode == Mode::Float => STOPPED,
            // The path comes back, or ends, and has no such solution.
            _ if arguments.first => LIMIT,
            _ if is_undecided => STOPPED,
            (Status::Open(_), _) => OPEN,
            // A certificate that does not pass its check.
            (Status::Closed, CLOSED) => verdict.unwrap_or(CLOSED),
            (Status::Closed, worst) => worst,
        };
        let run = Run {
            problem,
            options: &arguments.options(),
            outcome: &outcome,
            trace: wants_path.then_some(&trace),
            samples,
            tested,
        };
        if shown {
            let page = Page::from_result(&run.to_value()).map_err(|error| error.to_string())?;
            written &= pictures.write(&page);
        }
        if !silent {
            let gap = arguments.gap_before(k);
            let text = match (first, arguments.first) {
                (Some(text), _) => text + &arguments.part_in_words(tested),
                // It is there, and no figure of the problem.
                (None, true) if struck > 0 => {
                    format!(
                        "{}: No solution without a fold. {}{}\n",
                        problem.name,
                        arguments.part_in_words(tested),
                        signed_in_words(&outcome).replace(" Of these", "Of the figures there")
                    )
                }
                (None, true) if turns_at.is_some() => to_no_first(problem, turns_at),
                (None, true) if arguments.mode == Mode::Float => format!(
                    "{}: which solution is reached without a fold, if any, is told by certified mode alone: leave out \
                     `--mode float`, or without `--first` see all that floats find ({})\n",
                    problem.name,
                    to_summary(problem, &outcome, tested).trim_end()
                ),
                (None, true) => format!(
                    "{}: no solution without a fold: the path turns back before, or could not be followed that far ({})\n",
                    problem.name,
                    to_summary(problem, &outcome, tested).trim_end()
                ),
                (None, false) => arguments.shown(problem, &outcome, tested),
            };
            let of = match arguments.mode {
                Mode::Certified => "",
                Mode::Float => ", without proof",
            };
            let listed = match (arguments.first, direct) {
                (true, Some(k)) => k..k + 1,
                (true, None) => 0..0,
                _ => 0..outcome.solutions.len(),
            };
            let listed = outcome.solutions[listed].iter().map(placed);
            let text = text + &measures.to_table(of, listed);
            let hints = hints(problem, &outcome, &input::name(file));
            let whole = arguments.whole_in_words(file);
            written &= output::print(&format!("{gap}{whole}{text}{hints}"));
        }
        let alone = match outcome.status == Status::Closed && outcome.solutions.is_empty() {
            true if (!silent || json.is_some()) && struck == 0 && tested.is_none() => {
                arguments.alone(problem)
            }
            _ => Vec::new(),
        };
        if !silent {
            written &= output::print(&alone_in_words(&alone));
        }
        // What the path came to is out by now.
        let is_told = (!silent || json.is_some()) && tested.is_none();
        let among = arguments.among(problem, &outcome, is_told);
        if let Some(among) = among
            && !silent
            && !arguments.summary
        {
            written &= output::print(&among_in_words(among));
        }
        if json.is_some() {
            let figures = outcome.solutions.iter().map(placed);
            let measured = (!measures.is_empty()).then(|| measures.to_value(figures));
            lines += &(run.to_json_among(among, &alone, measured) + "\n");
        }
        k += 1;
        if cancel.load(Ordering::Relaxed) {
            break;
        }
    }
    // With one problem the file is written even where nobody reads the table any more: `print` does not fail
    // for that.
    if let Some(json) = &json {
        written &= json.write(&lines);
    }
    Ok(if written { worst } else { BAD_INPUT })
}

/// What is asked of a file.
struct Asked {
    /// What is followed.
    problem: Problem,
    /// Whether it is solved block by block from the start: a sketch of another program, or a problem in its own frame that has not as many
    /// equations as unknowns, where nothing is asked for that a path of the whole has alone.
    is_by_blocks: bool,
    /// The distances beside those that are followed: of a figure without a frame that has more than it needs, or of a molecule.
    surplus: Option<Surplus>,
}

/// A path with two ends of which neither says anything of the figures with t = 1.
#[derive(Clone, Copy)]
struct Unbounded<'a> {
    /// Why it was left, one of the two ways.
    reason: &'a str,
    /// Whether it goes farther than it is followed, both ways: as from a sketch that meets all constraints, where nothing
    /// depends on t. Otherwise it has an end where a length or radius vanishes, as t makes it larger or smaller for ever.
    both_ways: bool,
}

impl<'a> Unbounded<'a> {
    /// The path of a run that came to two such ends.
    fn of(status: &'a Status) -> Option<Self> {
        let Status::Open(ends) = status else {
            return None;
        };
        let runs_on = |end: &PathEnd| end.kind == EndKind::Infinite && end.away.is_none();
        let vanishes = |end: &PathEnd| end.kind == EndKind::Undefined;
        if !ends.iter().all(|end| runs_on(end) || vanishes(end)) {
            return None;
        }
        let vanishing = ends.iter().rev().find(|end| vanishes(end));
        Some(Unbounded {
            reason: vanishing.map_or(&ends[1].reason, |end| &end.reason),
            both_ways: vanishing.is_none(),
        })
    }
}

/// Whether a figure without a frame has fewer constraints than it needs.
fn is_loose(problem: &Problem) -> bool {
    let needed = free_coordinates(problem.dimension, problem.points.len());
    problem.distances.len() + problem.constraints.len() < needed
}

/// The graver of two exit codes.
fn worse(one: u8, other: u8) -> u8 {
    match (one, other) {
        (STOPPED, _) | (_, STOPPED) => STOPPED,
        (CLOSED, code) => code,
        (code, _) => code,
    }
}

/// Follows the blocks of a problem one by one; what came of each, and the exit code.
fn follow_blocks(
    arguments: &Arguments,
    blocks: Vec<Problem>,
    name: &str,
    which: &str,
) -> Result<(Vec<(Problem, Outcome)>, u8), String> {
    let mut code = CLOSED;
    let mut runs = Vec::with_capacity(blocks.len());
    for block in blocks {
        let (mut outcome, _, _) = follow(arguments, &block, name, which, None, None)?;
        Signs::of(&block).test(&mut outcome, block.dimension);
        code = worse(
            code,
            match &outcome.status {
                Status::Closed => CLOSED,
                Status::Open(_) => OPEN,
                Status::Stopped(_) => STOPPED,
            },
        );
        runs.push((block, outcome));
    }
    Ok((runs, code))
}

/// Where a run stopped: what makes the sketch or the target singular, which may be why.
fn hints(problem: &Problem, outcome: &Outcome, file: &str) -> String {
    const MOST: usize = 3;
    let all = match (problem.is_distances_only(), &outcome.status) {
        (true, Status::Stopped(_)) => remarks(problem),
        // A flat sketch may lead nowhere else than to places where the path ends.
        (false, Status::Stopped(_) | Status::Open(_)) => {
            let mut all = remarks(problem);
            all.retain(|remark| matches!(remark, Remark::FlatSketch { .. }));
            all
        }
        _ => return String::new(),
    };
    let mut warnings: Vec<_> = all.iter().filter(|remark| remark.is_warning()).collect();
    if outcome.steps == 0 {
        // It is the sketch that no run can leave.
        let is_of_sketch = |remark: &Remark| {
            matches!(
                remark,
                Remark::Loose { .. } | Remark::FlatInSketch(_) | Remark::FlatPart { .. }
            )
        };
        warnings.order_by_key(|remark| !is_of_sketch(remark));
    }
    let shown = warnings.iter().take(MOST);
    let mut text: String = shown
        .map(|remark| format!("warning: {}\n", in_words(problem, remark)))
        .collect();
    if warnings.len() > MOST {
        let more = warnings.len() - MOST;
        text += &format!("and {more} more of these: `krawl check {file}` lists them\n");
    }
    text
}

impl Arguments {
    /// What stands between the result before and this one, if there is one before.
    fn gap_before(&self, k: usize) -> &'static str {
        match k == 0 || self.summary {
            true => "",
            false => "\n",
        }
    }

    /// Whether a problem that stops may be followed block by block.
    fn can_be_cut(&self, cancel: &AtomicBool) -> bool {
        self.mode == Mode::Certified && !self.first && !cancel.load(Ordering::Relaxed)
    }

    /// What one dimension can do alone where the path has no figure with all of them; nothing where that is not asked for, or there
    /// are many.
    fn alone(&self, problem: &Problem) -> Vec<Alone> {
        const MOST_DIMENSIONS: usize = 64;
        const MOST_TUBES: usize = 300;
        const LONGEST: Duration = Duration::from_secs(1);
        let is_asked = self.mode == Mode::Certified && !self.summary && !self.first;
        if !is_asked || problem.dimensions().count() > MOST_DIMENSIONS {
            return Vec::new();
        }
        let options = Options {
            max_steps: MOST_TUBES,
            ..self.options()
        };
        let mut control = Control {
            limit: Some(Limit {
                length: f64::INFINITY,
                deadline: Instant::now() + LONGEST,
            }),
            ..interrupt::control()
        };
        alone(problem, &options, &mut control)
    }

    /// What is asked of a file.
    fn read(&self, file: &Path) -> Result<Asked, String> {
        let sketch = self.sketch.as_deref();
        let whole = |problem| Asked {
            problem,
            is_by_blocks: false,
            surplus: None,
        };
        let is_whole = self.mode == Mode::Float || self.wants_path().is_some();
        if is_whole && input::is_sketch(file) {
            return input::read(file, sketch).map(whole);
        }
        let loaded = input::load(file, sketch)?;
        let is_in_its_frame = fix_frame(&loaded.problem);
        if let Some(surplus) = loaded.surplus()
            && (self.mode == Mode::Certified || loaded.fault.is_none())
        {
            let surplus = surplus
                .into_owned()
                .with_tolerance(self.left_out.redundant_tolerance);
            return Ok(Asked {
                problem: surplus.problem.clone(),
                is_by_blocks: false,
                surplus: Some(surplus),
            });
        }
        let Some(fault) = loaded.fault else {
            return Ok(Asked {
                is_by_blocks: input::is_sketch(file),
                ..whole(loaded.problem)
            });
        };
        if is_in_its_frame && !is_whole {
            return Ok(Asked {
                is_by_blocks: true,
                ..whole(loaded.problem)
            });
        }
        let advice = match is_in_its_frame {
            true => "",
            // Of figures with very many points that is not looked for.
            false
                if loaded.problem.points.len() <= MOST_POINTS
                    && has_equations_to_spare(&loaded.problem.clone().up_to_motions()) =>
            {
                "; or see `krawl all`, which finds all figures that have as many as are needed, and tests the others"
            }
            false if is_loose(&loaded.problem) => {
                "; `krawl motion` follows it where it moves in one way, and `krawl edit` changes it as it is"
            }
            false => "",
        };
        Err(fault + advice)
    }

    /// What the first solution is proved of, where constraints were left out.
    fn part_in_words(&self, tested: Option<&Tested>) -> String {
        tested.map_or_else(String::new, |tested| part_in_words(tested) + "\n")
    }

    /// How many of all figures the path has, where that is wanted and costs little.
    fn among(&self, problem: &Problem, outcome: &Outcome, is_told: bool) -> Option<Among> {
        let is_wanted = is_told
            && problem.orientations.is_empty()
            && !self.no_count
            && !self.first
            && self.mode == Mode::Certified;
        is_wanted.then(|| among(problem, outcome))?
    }

    /// What is asked for that only a path of the whole has.
    fn wants_path(&self) -> Option<&'static str> {
        let asked = [
            (self.mode == Mode::Float, "--mode float"),
            (self.reverse, "--reverse"),
            (self.space.is_some(), "--space"),
            (self.samples.is_some(), "--samples"),
            (self.cert.is_some(), "--cert"),
            (self.pictures.has_animation(), "--animation"),
        ];
        asked.iter().find(|(is, _)| *is).map(|(_, option)| *option)
    }

    /// What is said before the answer to a sketch of another program that is followed as a whole.
    fn whole_in_words(&self, file: &Path) -> String {
        match self.wants_path() {
            Some(option) if input::is_sketch(file) && !self.summary => format!(
                "Followed as a whole, as `{option}` asks for its path: what nothing determines is held, what seems to \
                 follow from other constraints is left out. Without it the figures are found block by block.\n"
            ),
            _ => String::new(),
        }
    }

    /// The figures of a sketch in its own frame, with `--first` the nearest one with its senses: as text, as a value for
    /// JSON, and the exit code.
    fn by_blocks(&self, problem: &Problem) -> Result<(String, Value, u8, Found), String> {
        let mut control = interrupt::control();
        let figures = Figures::find(problem, &self.options(), &mut control)?;
        let mut listed = match self.all {
            true => Listed::All,
            false => Listed::Some,
        };
        let mut code = match figures.doubt() {
            Some(_) => STOPPED,
            None => CLOSED,
        };
        let (mut text, mut first) = (String::new(), None);
        if self.first {
            let nearest = figures.first();
            text = first_in_words(&figures, nearest);
            first = match nearest {
                Nearest::Figure { number, .. } => Some(number),
                _ => None,
            };
            (listed, code) = match nearest {
                Nearest::Figure { number, .. } => (Listed::Only(number), CLOSED),
                Nearest::None { is_proved: true } if code == CLOSED => (listed, LIMIT),
                Nearest::None { .. } | Nearest::TooMany => (listed, STOPPED),
            };
        }
        text += &match self.summary {
            true => figures_to_summary(&figures),
            false => figures_to_table(&figures, listed),
        };
        let mut value = figures_to_value(&figures, listed);
        let measures = self.measured.of(problem)?;
        if !measures.is_empty() {
            let numbers = match first {
                Some(number) => number..number + 1,
                None if self.first => 0..0,
                None => 0..figures.count().unwrap_or(u64::MAX).min(MOST_MEASURED),
            };
            let boxes: Vec<_> = numbers.map(|number| figures.figure(number)).collect();
            let boxes = || {
                boxes
                    .iter()
                    .map(|(points, objects)| (&points[..], &objects[..]))
            };
            text += &measures.to_table("", boxes());
            value["measures"] = measures.to_value(boxes());
        }
        Ok((text, value, code, Found { figures, first }))
    }

    /// Writes the figure that is wanted of those found block by block, if one is; whether all went well.
    fn take_of(&self, found: &Found, (problem, file): (&Problem, &Path)) -> bool {
        let Found { figures, first } = found;
        let listed = Candidates {
            count: match (self.first, first) {
                // None that was asked for.
                (true, None) => 0,
                _ => figures.count().unwrap_or(u64::MAX),
            },
            first: *first,
            is_all: true,
        };
        let from = (file, self.sketch.as_deref());
        self.take.write(from, problem, listed, |number| {
            let (points, objects) = figures.figure(number);
            Ok(Taken {
                points: points.iter().map(|p| p.each(|x| x.mid())).collect(),
                objects,
            })
        })
    }

    /// The figures, block by block, of a problem that stopped for `reason` when followed as a whole: as text, as a
    /// value for JSON, and the exit code. `None`: its blocks do not come to an end either, and no certificate is asked for.
    /// `unbounded`: its path has two ends. Where a length or radius vanishes at one of them, what is on the path is said unless
    /// nothing bends, nothing is asked for that a path alone has, and the blocks have all figures.
    fn instead(
        &self,
        problem: &Problem,
        reason: &str,
        unbounded: Option<Unbounded>,
    ) -> Option<(String, Value, u8, Found)> {
        let vanishes = unbounded.is_some_and(|path| !path.both_ways);
        let bends = problem.homotopy.bend < problem.distances.len()
            && !problem.homotopy.bend_coefficient.value().is_zero();
        if vanishes && (bends || self.wants_path().is_some()) {
            return None;
        }
        let (text, value, code, found) = self.by_blocks(problem).ok()?;
        if vanishes && value["status"] != "complete" {
            return None;
        }
        let certificate = match self.cert {
            Some(_) => {
                " The certificate has what was proved of the path of the whole; of the figures below it says nothing."
            }
            None => "",
        };
        let reason = reason.trim_end_matches('.');
        let how = match unbounded {
            Some(Unbounded {
                both_ways: true, ..
            }) => "its path goes farther than it is followed, both ways",
            Some(_) => {
                "its path ends where a length or radius vanishes, or goes farther than it is followed"
            }
            None => "it stops",
        };
        let introduction = match self.summary {
            true => String::new(),
            false => format!(
                "{}: followed as a whole {how} ({reason}). Its equations fall apart into blocks, and these are solved \
                 one by one.{certificate}\n\n",
                problem.name
            ),
        };
        // A certificate of a path that stopped, or is open, proves no more for it.
        let worth = match self.cert {
            Some(_) if unbounded.is_some() => OPEN,
            Some(_) => STOPPED,
            None => code,
        };
        let is_worth_it = code == CLOSED || self.cert.is_some();
        is_worth_it.then(|| (introduction + &text, value, worth, found))
    }

    fn shown_blocks(&self, all: &BlockRuns) -> String {
        let runs = all.runs.iter();
        match self.summary {
            true => {
                let lines = runs.map(|(block, run)| to_summary(block, run, None));
                let lines: String = lines.collect();
                format!("{lines}{}: {}\n", all.problem.name, all.verdict())
            }
            false => {
                let tables = runs.map(|(block, run)| self.shown(block, run, None) + "\n");
                let tables: String = tables.collect();
                format!("{}\n{tables}{}", all.introduction(), all.to_table(self.all))
            }
        }
    }

    fn shown(&self, problem: &Problem, outcome: &Outcome, tested: Option<&Tested>) -> String {
        match (self.summary, self.all) {
            (true, _) => to_summary(problem, outcome, tested),
            (false, true) => to_table(problem, outcome, tested),
            (false, false) => to_short_table(problem, outcome, tested),
        }
    }
}

/// Figures along a path for a page: smooth, and not too much to load.
fn samples_for(problem: &Problem) -> usize {
    (60_000 / problem.points.len().max(1)).clamp(100, 2400)
}

/// Follows the path of one problem. Also tells whether its certificate could be written, and the exit code for
/// one that does not pass its check.
fn follow(
    arguments: &Arguments,
    problem: &Problem,
    name: &str,
    which: &str,
    cert: Option<&Beside>,
    trace: Option<&mut Trace>,
) -> Result<(Outcome, bool, Option<u8>), String> {
    let options = arguments.options();
    let cancel = interrupt::flag();
    let mut witness = cert.map(|beside| Writer::new(BufWriter::new(beside.file()), problem));
    let mut line = ProgressLine::new(!arguments.quiet, which);
    let mut show = |now: Progress| line.show(now);
    let mut control = Control {
        cancel: Some(cancel),
        progress: Some(&mut show),
        witness: witness.as_mut().map(|writer| writer as &mut dyn Witness),
        trace,
        ..Control::default()
    };
    let outcome = match arguments.space {
        Some(_) => track::solve(problem, &options, &mut control),
        // A space that was not asked for may be changed.
        None => track::solve_in_best_space(problem, &options, &mut control),
    };
    line.clear();
    let mut outcome = outcome.map_err(|error| format!("{name}: {error}"))?;
    if arguments.mode == Mode::Certified
        && arguments.space.is_some()
        && outcome.space == track::Space::Reduced
        && options.extended
        // A sketch that no run can leave is singular in any precision.
        && outcome.steps > 0
        && let Status::Stopped(reason) = &mut outcome.status
        && !cancel.load(Ordering::Relaxed)
    {
        reason.text += "; the full space has extended precision (`--space full`)";
    }
    let (mut written, mut verdict) = (true, None);
    if let (Some(beside), Some(writer)) = (cert, witness) {
        written &= beside.commit(writer.finish().map(|_| ()));
        if written && !arguments.no_verify {
            let path = arguments.cert.as_deref();
            let path = path.filter(|_| !cancel.load(Ordering::Relaxed));
            let closed = matches!(outcome.status, Status::Closed);
            verdict = check_written(path, closed, arguments.quiet)?;
        }
    }
    Ok((outcome, written, verdict))
}

/// Follows the first arc of a path, on which t rises.
fn follow_first(
    arguments: &Arguments,
    problem: &Problem,
    name: &str,
    which: &str,
) -> Result<First, String> {
    if arguments.mode == Mode::Float {
        let (outcome, _, _) = follow(arguments, problem, name, which, None, None)?;
        return Ok(First {
            outcome,
            turns_at: None,
        });
    }
    let mut line = ProgressLine::new(!arguments.quiet, which);
    let mut show = |now: Progress| line.show(now);
    let mut control = Control {
        progress: Some(&mut show),
        ..interrupt::control()
    };
    let options = arguments.options();
    let space = arguments.space.map(|_| options.space);
    let found = track::first(problem, space, &options, &mut control);
    line.clear();
    found.map_err(|error| format!("{name}: {error}"))
}

/// Follows the path again in narrow tubes, if that comes to the same end, for pictures and folds: what it
/// tells about the places of the solutions is more.
fn follow_finely(
    arguments: &Arguments,
    problem: &Problem,
    which: &str,
    outcome: &mut Outcome,
) -> Option<Trace> {
    let mut line = ProgressLine::new(!arguments.quiet, format!("{which} picture").trim_start());
    let mut show = |now: Progress| line.show(now);
    let mut control = Control {
        progress: Some(&mut show),
        ..interrupt::control()
    };
    let traced = track::trace_path(problem, &arguments.options(), &mut control);
    line.clear();
    let (mut finer, trace) = traced.ok()?;
    Signs::of(problem).test(&mut finer, problem.dimension);
    let kind = |outcome: &Outcome| std::mem::discriminant(&outcome.status);
    if kind(&finer) != kind(outcome) || finer.solutions.len() != outcome.solutions.len() {
        return None;
    }
    outcome.length = finer.length;
    for (solution, finer) in outcome.solutions.iter_mut().zip(finer.solutions) {
        solution.place = finer.place;
    }
    Some(trace)
}
