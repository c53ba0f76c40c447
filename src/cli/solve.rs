//! `krawl solve`: follows the path of a problem and prints the solutions.

use super::output::{self, Beside, Destination};
use super::{BAD_INPUT, CLOSED, NOT_PROVED, OPEN, REFUTED, STOPPED, interrupt};
use clap::ValueEnum;
use krawl::certificate::{Outcome as Verdict, Settings, Stage, Writer, verify};
use krawl::problem::Problem;
use krawl::report::{ProgressLine, to_json, to_table};
use krawl::track::{self, Control, Options, Outcome, Progress, Status, Witness};
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Follow the path through the sketch and list the figures on it that meet the dimensions
#[derive(clap::Args)]
pub struct Arguments {
    /// The problem file (TOML)
    file: PathBuf,
    /// Prove every step, or track in floating-point arithmetic
    #[arg(long, value_enum, default_value_t = Mode::Certified)]
    mode: Mode,
    /// Track in all free coordinates, or in the driving parameters of a construction plan
    /// [default: reduced for float, and for certified from 70 free coordinates on; otherwise full]
    #[arg(long, value_enum)]
    space: Option<Space>,
    /// How float mode steps: well, or as in the paper (RR 8705, 7.1 to 7.3)
    #[arg(long, value_enum, default_value_t = Preset::Default)]
    preset: Preset,
    /// Distance to a boundary configuration at which the plan is changed, between 0 and 0.5
    #[arg(long, value_name = "X", default_value = "0.1", value_parser = alpha)]
    alpha: f64,
    /// Longest step allowed, in arc length
    #[arg(long, value_name = "X", value_parser = positive)]
    max_step: Option<f64>,
    /// Certified mode: how far the path may be from the middle of a tube. Extended precision is never
    /// switched on for the sake of a small radius alone
    #[arg(long, value_name = "X", value_parser = positive)]
    tube_radius: Option<f64>,
    /// Certified mode: keep to 53 bits, and stop where they do not suffice, instead of switching extended
    /// precision on there (which only the full space has)
    #[arg(long)]
    no_extended: bool,
    /// Float mode: points are corrected until a correction is about this small
    #[arg(long, value_name = "X", value_parser = positive)]
    tolerance: Option<f64>,
    /// Follow the loop the other way round
    #[arg(long)]
    reverse: bool,
    /// Write a certificate, and check it as `verify` does; only for runs in certified mode. Where a
    /// certificate of a closed run does not pass, the exit code is that of `verify`
    #[arg(long, value_name = "FILE")]
    cert: Option<PathBuf>,
    /// Do not check the certificate that was written
    #[arg(long, requires = "cert")]
    no_verify: bool,
    /// Write the results as JSON; `-` writes them to standard output in place of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

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

    fn options(&self, problem: &Problem) -> Options {
        let space = self.space(problem);
        let options = match (self.mode, self.preset) {
            (Mode::Certified, _) => Options {
                space,
                ..Options::certified()
            },
            (Mode::Float, Preset::Default) => Options::float(space),
            (Mode::Float, Preset::Paper) => Options::paper(space),
        };
        Options {
            max_step: self.max_step,
            tube_radius: self.tube_radius,
            tolerance: self.tolerance,
            reverse: self.reverse,
            alpha: self.alpha,
            extended: !self.no_extended,
            ..options
        }
    }

    fn space(&self, problem: &Problem) -> track::Space {
        match (self.space, self.mode) {
            (Some(Space::Full), _) => track::Space::Full,
            (Some(Space::Reduced), _) | (None, Mode::Float) => track::Space::Reduced,
            // A certificate's tubes are those of the full space.
            (None, Mode::Certified) if self.cert.is_some() => track::Space::Full,
            (None, Mode::Certified) => track::Space::for_certified(problem.distances.len()),
        }
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> u8 {
    output::exit_code(try_run(arguments))
}

fn try_run(arguments: &Arguments) -> Result<u8, String> {
    arguments.check()?;
    let problem = Problem::read(&arguments.file).map_err(|error| error.to_string())?;
    let options = arguments.options(&problem);
    let json = arguments
        .json
        .as_deref()
        .map(Destination::new)
        .transpose()?;

    for results in [&arguments.json, &arguments.cert].into_iter().flatten() {
        if output::is_same_file(results, &arguments.file) {
            return Err(format!(
                "{}: is the problem itself; name another file for the results",
                results.display()
            ));
        }
    }
    // Before any file is begun, so that an interrupt leaves none behind.
    let cancel = interrupt::flag();
    let cert = arguments.cert.as_deref().map(Beside::new).transpose()?;
    let mut witness = cert
        .as_ref()
        .map(|beside| Writer::new(BufWriter::new(beside.file()), &problem));
    let mut line = ProgressLine::new(!arguments.quiet);
    let mut show = |now: Progress| line.show(now);
    let mut control = Control {
        cancel: Some(cancel),
        progress: Some(&mut show),
        witness: witness.as_mut().map(|writer| writer as &mut dyn Witness),
        ..Control::default()
    };
    let mut outcome = track::solve(&problem, &options, &mut control);
    // What was not asked for is not insisted on.
    if arguments.mode == Mode::Certified
        && arguments.space.is_none()
        && options.space == track::Space::Reduced
        && let Ok(Outcome {
            status: Status::Stopped(reason),
            ..
        }) = &outcome
        && !cancel.load(Ordering::Relaxed)
    {
        let remark = format!("full space: in the reduced space the run stopped, {reason}");
        let full = Options {
            space: track::Space::Full,
            ..options
        };
        // Where the full space is not to be had, the first run is the result.
        if let Ok(mut second) = track::solve(&problem, &full, &mut control) {
            second.switched_on.push(remark);
            outcome = Ok(second);
        }
    }
    line.clear();
    let mut outcome = outcome.map_err(|error| format!("{}: {error}", arguments.file.display()))?;
    if arguments.mode == Mode::Certified
        && arguments.space.is_some()
        && outcome.space == track::Space::Reduced
        && options.extended
        // A sketch that no run can leave is singular in any precision.
        && outcome.steps > 0
        && let Status::Stopped(reason) = &mut outcome.status
        && !cancel.load(Ordering::Relaxed)
    {
        *reason += "; the full space has extended precision (`--space full`)";
    }

    // The file first: a table that nobody reads any more must not cost it.
    let (mut written, mut verdict) = (true, None);
    if let (Some(beside), Some(writer)) = (&cert, witness) {
        let cut = writer.is_cut();
        written &= beside.commit(writer.finish().map(|_| ()));
        if written && !arguments.no_verify {
            verdict = check_certificate(arguments, !cancel.load(Ordering::Relaxed))?;
        }
        if cut && written {
            output::complain(
                "the certificate holds the beginning of the proof only: the tubes that follow were proved \
                 in extended precision, which certificates cannot hold",
            );
        }
    }
    if let Some(json) = &json {
        written &= json.write(&(to_json(&problem, &outcome) + "\n"));
    }
    if !arguments.quiet && json != Some(Destination::StandardOutput) {
        written &= output::print(&to_table(&problem, &outcome));
    }
    Ok(match outcome.status {
        _ if !written => BAD_INPUT,
        Status::Closed => verdict.unwrap_or(CLOSED),
        Status::Open(_) => OPEN,
        Status::Stopped(_) => STOPPED,
    })
}

/// Checks the certificate that was written, on all processors, and says on standard error whether it does
/// not pass: then the result is the exit code for that.
fn check_certificate(arguments: &Arguments, wanted: bool) -> Result<Option<u8>, String> {
    let Some(path) = arguments.cert.as_ref().filter(|_| wanted) else {
        return Ok(None);
    };
    let name = path.display();
    let file = File::open(path).map_err(|e| format!("{name}: cannot be read again: {e}"))?;
    let mut line = ProgressLine::new(!arguments.quiet);
    let mut show = |stage: Stage| line.show_check(stage.tubes, stage.solutions);
    let verdict = verify(BufReader::new(file), &Settings::default(), &mut show);
    line.clear();
    let verdict = verdict.map_err(|error| format!("{name}: {error}; please report this"))?;
    let (what, code) = match &verdict.outcome {
        Verdict::Verified | Verdict::Partial(_) => return Ok(None),
        Verdict::NotProved(flaw) => (format!("NOT PROVED: {flaw}"), NOT_PROVED),
        Verdict::Refuted(flaw) => (format!("REFUTED, please report this: {flaw}"), REFUTED),
    };
    output::complain(&format!(
        "{name}: the certificate does not pass the checker. {what}"
    ));
    Ok(Some(code))
}
