//! `krawl template`: fills a generic instance of a problem's equations with its complex solutions.

use super::input;
use super::output::{self, Destination, in_file};
use super::{CLOSED, INCOMPLETE, in_pool, interrupt};
use krawl::complex::{Effort, Fibre, Filling, Lowered, Template, Ways, fill, lower, lower_for};
use krawl::problem::{Problem, counted};
use krawl::report::ProgressLine;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Find the complex solutions of a random instance, to be used for all instances
///
/// A random complex figure with the same constraints has dimensions of its own. Loops of complex dimensions make other
/// figures with the same dimensions of it, every path proved (unless --float), until there are as many as a proved
/// bound allows or no loop finds another one. Solutions of equations without points are first led there from equations of the
/// same degrees whose solutions are known, in floats; each is proved. `krawl complex FILE --template T` then takes all to any dimensions.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl template problems/octahedron.toml --out octahedron.krawl-template
  krawl complex problems/octahedron.toml --template octahedron.krawl-template

Exit codes: 0 full, by a proved bound, 4 written, and that it is full is not proved, 2 bad input.")]
pub struct Arguments {
    /// The problem file (TOML); its dimensions play no part
    file: PathBuf,
    /// Write the template to this file
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Go on from a template of the same constraints that is not full yet
    #[arg(long, value_name = "TEMPLATE")]
    from: Option<PathBuf>,
    #[command(flatten)]
    search: Search,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// How to fill a template.
#[derive(clap::Args)]
pub struct Search {
    /// The seed of the random numbers: equal seeds make equal runs
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Stop after so many ways in a row that find nothing new
    ///
    /// [default: 10; 50 for equations of one's own while there are fewer solutions than the bound]
    #[arg(long, value_name = "N")]
    patience: Option<usize>,
    /// Stop when there are so many, up to signs of axes
    ///
    /// A number that you know from elsewhere; nothing is proved by it
    #[arg(long, value_name = "N")]
    enough: Option<usize>,
    /// Follow paths in floats, many times as fast
    ///
    /// Without proof of the steps; every solution that they come to is still proved, and so is "complete" or "full",
    /// which rests on their number alone
    #[arg(long)]
    pub float: bool,
    /// Stop looking after so many seconds
    #[arg(long, value_name = "S", value_parser = super::all::seconds)]
    pub time: Option<f64>,
    /// Threads to use [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

impl Search {
    /// Fills a fibre.
    ///
    /// `from` are solutions that are known already.
    pub fn fill(
        &self,
        lowered: &Lowered,
        from: Option<&Template>,
        line: &ProgressLine,
    ) -> Result<Fibre, String> {
        let tell = |found: usize, effort: &Effort| {
            let paths = effort.paths;
            line.show_text(format!("template: {found} solutions   {paths} paths"));
        };
        let tell_paths = |done: usize, all: usize| {
            line.show_text(format!("template: {done} of {all} paths"));
        };
        let plain = Filling::default();
        let filling = Filling {
            seed: self.seed,
            from,
            enough: self.enough.or(lowered.enough()),
            patience: self.patience.unwrap_or(match lowered.is_of_numbers() {
                true => 5 * plain.patience,
                false => plain.patience,
            }),
            progress: Some(&tell),
            ways: Ways {
                proved: !self.float,
                cancel: Some(interrupt::flag()),
                deadline: interrupt::deadline(self.time),
                progress: Some(&tell_paths),
                ..plain.ways
            },
        };
        fill(&lowered.system, &filling)
    }
}

/// A problem, and its complex equations: those of a template, where one is given and has them.
pub(super) fn read(
    file: &Path,
    template: Option<&TemplateText>,
) -> Result<(Problem, Lowered), String> {
    let problem = input::of_equations(file)?;
    let lowered = match template {
        Some(template) => lower_for(&problem, &template.text),
        None => lower(&problem),
    };
    let lowered = lowered.map_err(in_file(file))?;
    Ok((problem, lowered))
}

/// The text of a template's file.
pub(super) struct TemplateText {
    path: PathBuf,
    text: String,
}

impl TemplateText {
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(in_file(path))?;
        Ok(TemplateText {
            path: path.to_owned(),
            text,
        })
    }

    /// The template, for these equations, its solutions proved again.
    pub(super) fn prove(&self, lowered: &Lowered) -> Result<Template, String> {
        Template::read(&self.text, &lowered.system).map_err(in_file(&self.path))
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let from = arguments.from.as_deref().map(TemplateText::read);
    let from = from.transpose()?;
    let (problem, lowered) = read(&arguments.file, from.as_ref())?;
    output::refuse_read([&arguments.file], Some(&arguments.out))?;
    let out = Destination::new(&arguments.out)?;
    let line = ProgressLine::new(!arguments.quiet, "");
    let begin = Instant::now();
    let fibre = in_pool(arguments.search.threads, || {
        let from = from.as_ref().map(|text| text.prove(&lowered)).transpose()?;
        let fibre = arguments.search.fill(&lowered, from.as_ref(), &line);
        fibre.map_err(in_file(&arguments.file))
    })?;
    line.clear();
    let fibre = fibre?;
    let is_full = lowered.enough() == Some(fibre.solutions.len());
    let text = summary(&problem, &lowered, &fibre, begin.elapsed().as_secs_f64());
    let template = Template::new(&problem.name, fibre);
    let mut written = out.write(&template.write(&lowered.system));
    if !arguments.quiet && out != Destination::StandardOutput {
        written &= output::print(&text);
    }
    let code = if is_full { CLOSED } else { INCOMPLETE };
    Ok(output::code(written, code))
}

/// What was found, in words.
fn summary(problem: &Problem, lowered: &Lowered, fibre: &Fibre, seconds: f64) -> String {
    let count = krawl::complex::count_generic(&fibre.solutions, &lowered.system);
    let is_absolute = lowered.system.is_absolute;
    let found = match is_absolute {
        true => counted(count.isometry, "solution"),
        false => format!(
            "{} solutions up to signs of axes, {} up to rotation, {} in the gauge",
            count.isometry, count.rotation, count.gauge
        ),
    };
    let up_to = if is_absolute { "" } else { " up to rotation" };
    let idle = match fibre.ways {
        0 => String::new(),
        _ => format!(
            "; the last {} found nothing new",
            counted(fibre.idle, "way")
        ),
    };
    let full = match (&lowered.bound, lowered.enough()) {
        (Some(bound), Some(enough)) if enough == fibre.solutions.len() => {
            format!(
                "Full, proved: {found}; {} is {}.",
                bound.source, bound.count
            )
        }
        (Some(bound), _) => format!(
            "{found}, each proved. That these are all is not proved: {} is {}{up_to}{idle}.",
            bound.source, bound.count
        ),
        (None, _) => format!(
            "{found}, each proved. That these are all is not proved: no bound is known{idle}."
        ),
    };
    let mut text = format!("{}: {full}\n", problem.name);
    if let Some(led) = fibre.led {
        text += &format!(
            "{} from equations of the same degrees in floats, {} of them to infinity\n",
            counted(led.paths, "path"),
            led.infinite
        );
    }
    let effort = &fibre.effort;
    let took = [
        (effort.tubes, "tube", ""),
        (effort.steps, "step", " in floats"),
    ];
    let took = took.into_iter().filter(|(count, ..)| *count > 0);
    let took: String = took
        .map(|(count, what, how)| format!("{}{how}, ", counted(count, what)))
        .collect();
    text += &format!(
        "{} between random instances, {} paths, {took}{seconds:.2} s\n",
        counted(fibre.ways, "way"),
        effort.paths
    );
    if let (failed, Some(reason)) = &fibre.failed {
        text += &format!("{failed} paths were given up, the last because {reason}\n");
    }
    text
}
