//! `krawl compare`: what each mode and space, and each degree of accuracy, costs on problems.

use super::output::{self, Destination, in_file};
use super::results::Results;
use super::{CLOSED, STOPPED, interrupt};
use krawl::compare::{Comparison, Effort, Method, compare, record_path};
use krawl::problem::{Problem, Published};
use krawl::report::{
    Compared, ProgressLine, comparison_to_table, comparisons_to_csv, comparisons_to_json, picture,
};
use krawl::system::Homotopy;
use krawl::track::{Control, Progress};
use std::fs;
use std::path::{Path, PathBuf};

/// Follow the path in every mode and space, several times each, and set them beside each other
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl compare problems/octahedron.toml
  krawl compare problems/*.toml --repeat 9 --csv out.csv
  krawl compare sketch.toml --sweep --output pictures

Exit codes: 0 all ran and the certified runs closed or ended open, 1 one stopped, or interrupted, 2 bad input.")]
pub struct Arguments {
    /// The problem files (TOML)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Runs of each mode, taking turns; the median counts
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u16).range(1..=9999))]
    repeat: u16,
    /// Also with other tube radii, tolerances and longest steps
    ///
    /// Tube radii and tolerances of 1e-4 to 1e-14 and bounds on the step, each judged against the certified run
    #[arg(long)]
    sweep: bool,
    /// Give up a run after so many seconds
    #[arg(long, value_name = "SECONDS", default_value = "120", value_parser = seconds)]
    limit: f64,
    /// Write JSON, CSV and pictures (SVG) into this directory, which is created
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the results as CSV; `-` likewise
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print no tables and no progress
    #[arg(long)]
    quiet: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    let must = "must be a number of seconds greater than 0";
    output::number(text, |x| *x > 0.0 && *x <= 1e9, must)
}

/// A problem to run, and what was published about it.
struct Subject {
    problem: Problem,
    published: Vec<Published>,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    arguments.time.begin();
    // Whatever is wrong is said before anything runs.
    let subjects = arguments.files.iter().map(|file| read(file));
    let subjects = subjects.collect::<Result<Vec<Subject>, String>>()?;
    let named = [arguments.json.as_deref(), arguments.csv.as_deref()];
    let mut results = Results::open(&arguments.files, named, None, arguments.quiet)?;
    let folder = arguments.output.as_deref();
    if let Some(folder) = folder {
        fs::create_dir_all(folder).map_err(in_file(folder))?;
    }

    let effort = Effort {
        repeats: arguments.repeat.into(),
        sweep: arguments.sweep,
        limit: arguments.limit,
    };
    let mut all: Vec<Compared> = Vec::new();
    let count = subjects.len();
    for (k, (subject, file)) in subjects.into_iter().zip(&arguments.files).enumerate() {
        let which = output::which_of((k, count), file);
        output::say_if_signs_are_not_looked_at(&subject.problem);
        let line = ProgressLine::new(!arguments.quiet, &which);
        let mut show = |now: Progress| line.show(now);
        let mut control = Control {
            cancel: Some(interrupt::flag()),
            progress: Some(&mut show),
            ..Control::default()
        };
        let result = compare(&subject.problem, &effort, &mut control);
        line.clear();
        let comparison = result.map_err(in_file(file))?;
        let compared = Compared {
            comparison,
            published: subject.published,
        };
        let gap = if all.is_empty() { "" } else { "\n" };
        results.print(|| gap.to_owned() + &comparison_to_table(&compared));
        if let Some(folder) = folder {
            let stem = stem(file, &arguments.files);
            let comparison = &compared.comparison;
            results.note(draw(folder, &stem, &subject.problem, comparison)?);
        }
        all.push(compared);
        if interrupt::is_requested() {
            break;
        }
    }

    let json_text = || comparisons_to_json(&all) + "\n";
    results.write_json(json_text);
    results.write_csv(|| comparisons_to_csv(&all));
    if let Some(folder) = folder {
        results.note(write(folder, "comparison.json", &json_text())?);
        results.note(write(folder, "comparison.csv", &comparisons_to_csv(&all))?);
    }
    let is_whole = !interrupt::is_requested() && all.iter().all(|c| came_to_an_end(&c.comparison));
    Ok(results.code(if is_whole { CLOSED } else { STOPPED }))
}

/// Reads a problem and makes sure that it can be run.
fn read(file: &Path) -> Result<Subject, String> {
    let (problem, published) =
        Problem::read_with_published(file).map_err(|error| error.to_string())?;
    Homotopy::new(&problem).map_err(in_file(file))?;
    Ok(Subject { problem, published })
}

/// Whether all certified runs closed or ended open.
fn came_to_an_end(comparison: &Comparison) -> bool {
    let mut certified = comparison
        .rows
        .iter()
        .filter(|row| row.way.method == Method::Certified)
        .filter_map(|row| row.measured());
    certified.all(|measured| measured.came_to_an_end())
}

/// What the pictures of a file are called: its stem, with a number where others have the same.
fn stem(file: &Path, files: &[PathBuf]) -> String {
    let stem_of = |file: &Path| {
        file.file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    let stem = stem_of(file);
    let same: Vec<&PathBuf> = files
        .iter()
        .filter(|other| stem_of(other) == stem)
        .collect();
    match same.iter().position(|other| other.as_path() == file) {
        Some(k) if k > 0 => format!("{stem}-{}", k + 1),
        _ => stem,
    }
}

/// Draws the pictures of a problem. The path is followed once more for them.
fn draw(
    folder: &Path,
    stem: &str,
    problem: &Problem,
    comparison: &Comparison,
) -> Result<bool, String> {
    let mut written = true;
    if !comparison.sweep.is_empty() {
        let svg = picture::cost_against_accuracy(comparison);
        written &= write(folder, &format!("{stem}-cost.svg"), &svg)?;
    }
    if comparison.interrupted {
        return Ok(written);
    }
    let path = record_path(problem, Some(interrupt::flag()));
    if let Ok(path) = path
        && path.step_ends.len() > 1
    {
        for (what, svg) in [
            ("time", picture::time_along_path(&path)),
            ("path", picture::projection(&path)),
        ] {
            written &= write(folder, &format!("{stem}-{what}.svg"), &svg)?;
        }
    }
    Ok(written)
}

fn write(folder: &Path, name: &str, text: &str) -> Result<bool, String> {
    Ok(Destination::new(&folder.join(name))?.write(text))
}
