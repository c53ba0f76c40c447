//! `krawl solve`: follows the path of a problem and prints the solutions.

mod asked;
mod blocks;
mod hints;
mod path;
mod told;

use super::digits::ManyDigits;
use super::edit::LeftOut;
use super::measured::Measured;
use super::output::{self, Beside, number};
use super::pictures::Pictures;
use super::results::Results;
use super::take::Take;
use super::{BAD_INPUT, CLOSED, input, interrupt};
use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use krawl::track::{Mode, Options, Space};
use std::path::PathBuf;
use told::Told;

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
    #[command(flatten)]
    which: super::input::Which,
    /// Only the solution to which the sketch moves without a fold
    ///
    /// Exit code 0 if there is one, 3 if the path turns back before, 1 if that could not be proved, as in float mode.
    /// Of a sketch of another program: the figure nearest to it in which angles, parallels, tangents and joined
    /// points turn as there; 3 if no figure found is such
    #[arg(long, conflicts_with_all = ["all", "summary", "cert", "reverse"])]
    first: bool,
    /// `certified` proves every step, `float` tracks in plain floats
    #[arg(long, value_parser = one_of(Mode::ALL, Mode::name), hide_possible_values = true, default_value = "certified")]
    mode: Mode,
    /// All free coordinates, or the driving parameters of a plan
    ///
    /// [default: reduced for float, and for certified from 70 free coordinates on; otherwise full]
    #[arg(long, value_parser = one_of(Space::ALL, Space::name), hide_short_help = true)]
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
    many: ManyDigits,
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
    /// Look for figures whatever their signs are
    ///
    /// Whatever `orientation` asks for, and the chirality that a molecule has in its file
    #[arg(long, hide_short_help = true)]
    any_signs: bool,
    #[command(flatten)]
    left_out: LeftOut,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Preset {
    Default,
    Paper,
}

/// Takes one of these by its name.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name)).map(move |text| {
        let mut all = all.into_iter();
        all.find(|&one| name(one) == text).expect("one of these")
    })
}

fn alpha(text: &str) -> Result<f64, String> {
    let must = "must be a number greater than 0 and less than 0.5";
    number(text, |x| *x > 0.0 && *x < 0.5, must)
}

pub(super) fn samples(text: &str) -> Result<usize, String> {
    let must = "must be a whole number from 2 to 100000";
    number(text, |n| (2..=100_000).contains(n), must)
}

fn positive(text: &str) -> Result<f64, String> {
    let must = "must be a finite number greater than 0";
    number(text, |x: &f64| *x > 0.0 && x.is_finite(), must)
}

impl Arguments {
    /// Refuses what does not go together.
    fn check(&self) -> Result<(), String> {
        let (is_float, is_one) = (self.mode == Mode::Float, self.files.len() == 1);
        let refused = [
            (
                !is_float && self.preset == Preset::Paper,
                "`--preset paper` is a way of float mode: add `--mode float`",
            ),
            (
                is_float && self.cert.is_some(),
                "float mode proves nothing: leave out `--cert`, or `--mode float`",
            ),
            (
                is_float && self.samples.is_some(),
                "float mode keeps no path: leave out `--samples`, or `--mode float`",
            ),
            (
                is_float && self.many.is_wanted(),
                "float mode proves no digits: leave out `--digits`, or `--mode float`",
            ),
            (
                !is_float && self.tolerance.is_some(),
                "`--tolerance` is for float mode: add `--mode float`, or use `--tube-radius`",
            ),
            (
                is_float && self.tube_radius.is_some(),
                "float mode has no tubes: leave out `--tube-radius`, or use `--tolerance`",
            ),
            (
                is_float && self.no_extended,
                "float mode has no extended precision: leave out `--no-extended`, or `--mode float`",
            ),
        ];
        if let Some((_, why)) = refused.into_iter().find(|(is_so, _)| *is_so) {
            return Err(why.to_owned());
        }
        let has_pictures = self.pictures.files().next().is_some();
        let of_one = [
            (self.many.is_wanted(), "`--digits` is for"),
            (self.cert.is_some(), "`--cert` is for"),
            (self.take.is_wanted(), "`--out` is for"),
            (!self.measured.is_empty(), "`--measure` is for"),
            (has_pictures, "a page and pictures are of"),
        ];
        if let Some((_, what)) = of_one.into_iter().find(|(is_so, _)| *is_so && !is_one) {
            return Err(format!("{what} one problem: name one file"));
        }
        for file in &self.files {
            self.take.check(file)?;
        }
        input::only_one_standard_input(self.files.iter().map(PathBuf::as_path))
    }

    fn options(&self) -> Options {
        let options = match (self.mode, self.preset) {
            (Mode::Certified, _) => Options::certified(),
            (Mode::Float, Preset::Default) => Options::float(Space::Reduced),
            (Mode::Float, Preset::Paper) => Options::paper(Space::Reduced),
        };
        Options {
            space: self.space.unwrap_or(options.space),
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
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    arguments.time.begin();
    arguments.check()?;
    // Whatever is wrong is said before anything runs; of several files one that cannot be read costs only itself.
    let mut problems = Vec::with_capacity(arguments.files.len());
    let mut worst = CLOSED;
    for (k, file) in arguments.files.iter().enumerate() {
        match arguments.read(file) {
            Ok(asked) => problems.push((k, asked)),
            Err(text) if arguments.files.len() > 1 => {
                output::complain(&text);
                worst = BAD_INPUT;
            }
            Err(text) => return Err(text),
        }
    }
    if problems.is_empty() {
        return Ok(worst);
    }
    let (files, named) = (&arguments.files, [arguments.json.as_deref(), None]);
    let results = Results::open(files, named, &arguments.pictures, arguments.quiet)?;
    output::refuse_read(files, arguments.cert.as_deref())?;
    // Before any file is begun, so that an interrupt leaves none behind.
    interrupt::flag();
    let cert = arguments.cert.as_deref().map(Beside::new).transpose()?;
    let mut told = Told {
        arguments,
        results,
        cert,
        lines: String::new(),
        worst,
    };
    for &(k, ref asked) in &problems {
        if told.answer(k, asked, &arguments.files[k])? {
            break;
        }
    }
    // With one problem the file is written even where nobody reads the table any more: `print` does not fail
    // for that.
    told.results.write_json(|| told.lines);
    Ok(told.results.code(told.worst))
}
