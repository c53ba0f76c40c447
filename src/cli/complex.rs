//! `krawl complex`: all complex solutions of a problem.

use super::digits::ManyDigits;
use super::output::{self, Beside, in_file};
use super::results::Results;
use super::template::{Search, TemplateText, read};
use super::{CLOSED, INCOMPLETE, STOPPED, in_pool, interrupt};
use crate::report::names;
use krawl::certificate::complex::{ComplexFlaw, verify_complex_set};
use krawl::complex::{Lowered, Nature, Status, Template, Ways, solve, to_certificate};
use krawl::problem::Problem;
use krawl::report::{ProgressLine, complex_to_json, complex_to_table, digits_to_table};
use std::path::{Path, PathBuf};

/// Find all complex solutions, every path proved (unless --float)
///
/// Each box holds exactly one; which are real is proved. "Complete" claims that there is no other isolated solution, and
/// is claimed only where their number meets a proved bound, with figures that these dimensions send to infinity, which are proved and
/// counted too. Without a template one is made first: of equations without points in floats, each solution proved.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl complex problems/octahedron.toml
  krawl complex problems/disulfide.toml --template problems/disulfide.krawl-template --json -
  krawl complex problems/disulfide.toml --bound 64     complete if you know that there are at most 64
  krawl complex problems/mechanisms/dietmaier.toml --float --bound 40     all assembly modes of a robot

Exit codes: 0 complete, by a proved bound or one that you cite, 4 all paths were followed, and that there are no other solutions is
not proved, 1 paths stopped, 2 bad input, or no certificate where one is asked for.")]
pub struct Arguments {
    /// The problem file (TOML) or a system of equations
    ///
    /// Systems of PHCpack, msolve, Macaulay2 or HomotopyContinuation.jl; the text tells which
    file: PathBuf,
    /// The solutions of a generic instance, by `krawl template`
    #[arg(long, value_name = "FILE")]
    template: Option<PathBuf>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the solutions as a certificate, and check it
    ///
    /// That there are no others is in it for problems of distances in space
    #[arg(long, value_name = "FILE")]
    cert: Option<PathBuf>,
    /// Where a path is taken to go to infinity, in typical lengths
    ///
    /// An unknown is so many typical lengths in size (with --float: and the path cannot be followed to its end)
    #[arg(long, value_name = "R", default_value_t = 1000.0, value_parser = super::all::seconds)]
    radius: f64,
    /// A number of solutions that you know from elsewhere to be a bound
    ///
    /// Up to rotation unless fixed places say where the figure is: the result then says that it is complete if this
    /// bound holds. A smaller bound that is proved here is used in its place
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    bound: Option<u64>,
    /// List all solutions, not the real ones only
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    many: ManyDigits,
    #[command(flatten)]
    search: Search,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let file = arguments.file.display();
    let template = arguments.template.as_deref().map(TemplateText::read);
    let template = template.transpose()?;
    let (problem, mut lowered) = read(&arguments.file, template.as_ref())?;
    output::say_if_signs_are_not_looked_at(&problem);
    if let Some(bound) = arguments.bound {
        lowered.cite(bound.into());
    }
    let lowered = lowered;
    let given = || [&arguments.file].into_iter().chain(&arguments.template);
    let named = [arguments.json.as_deref(), None];
    let mut results = Results::open(given(), named, None, arguments.quiet)?;
    output::refuse_read(given(), arguments.cert.as_deref())?;
    let cert = arguments.cert.as_deref().map(Beside::new).transpose()?;
    let line = ProgressLine::new(!arguments.quiet, "");
    let tell = |done: usize, all: usize| {
        line.show_text(format!("{done} of {all} paths"));
    };
    let ways = Ways {
        proved: !arguments.search.float,
        radius: arguments.radius,
        cancel: Some(interrupt::flag()),
        deadline: interrupt::deadline(arguments.search.time),
        progress: Some(&tell),
        ..Ways::default()
    };
    let result = in_pool(arguments.search.threads, || {
        let template = match &template {
            Some(text) => text.prove(&lowered)?,
            None => {
                let fibre = arguments.search.fill(&lowered, None, &line);
                Template::new(&problem.name, fibre.map_err(in_file(&arguments.file))?)
            }
        };
        Ok::<_, String>(solve(&lowered, &template, &ways))
    });
    line.clear();
    let result = result??;
    if let Some(cert) = &cert {
        match to_certificate(&problem, &lowered, &result) {
            Some(set) => {
                let bytes = set.to_bytes();
                results.note(cert.write(&bytes));
                let verdict = in_pool(arguments.search.threads, || verify_complex_set(&bytes))?;
                let verdict = verdict.map_err(in_file(&arguments.file))?;
                if let Some(ComplexFlaw::False(why) | ComplexFlaw::NotProved(why)) = verdict.flaw {
                    output::complain(&format!(
                        "{file}: the certificate is written, but `krawl verify` does not prove it: {why}"
                    ));
                }
            }
            None => {
                results.note(false);
                let why = no_certificate(&problem, &lowered);
                let out = arguments.cert.as_deref().unwrap_or(Path::new("")).display();
                output::complain(&format!(
                    "{file}: no certificate is written ({out} is left as it was): {why}"
                ));
            }
        }
    }
    let many = arguments.many.of_complex((&problem, &lowered), &result);
    results.write_json(|| {
        let digits = arguments.many.told(&problem, &many);
        complex_to_json(&problem, &lowered, &result, digits) + "\n"
    });
    results.print(|| {
        let mut text = complex_to_table(&problem, &lowered, &result, arguments.all);
        let is_real = |k: &usize| result.natures[*k] == Nature::Real;
        for k in (0..many.len()).filter(|k| arguments.all || is_real(k)) {
            text += &digits_to_table(&problem, k + 1, &many[k..=k]);
        }
        text
    });
    Ok(results.code(match result.status {
        Status::Complete => CLOSED,
        Status::Found => INCOMPLETE,
        Status::Partial => STOPPED,
    }))
}

/// Why there is no certificate of a problem's solutions.
fn no_certificate(problem: &Problem, lowered: &Lowered) -> String {
    if !problem.is_distances_only() {
        return "it tells solutions as they are seen from the reference, and in one of them the points of that are in line (name others in \
                `reference`)"
            .to_owned();
    }
    let fixed = lowered.bound.as_ref().map(|bound| bound.fixed.as_slice());
    let names = names(problem, fixed.unwrap_or_default());
    format!(
        "the figures stand on the reference that gives the best bound ({}), and its lengths are those of no real triangle",
        names.join(", ")
    )
}
