//! `krawl verify`: checks a certificate and prints the theorem that it proves.

use super::{BAD_INPUT, CLOSED, STOPPED, output};
use krawl::certificate::{Outcome, Settings, Stage, verify};
use krawl::problem::Problem;
use krawl::report::{ProgressLine, theorem};
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::time::Instant;

/// Prove all claims of a certificate again
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  krawl verify proof.krawl
  krawl verify proof.krawl sketch.toml    and it is about this problem

Exit codes: 0 verified, 1 refuted or incomplete, 2 not a certificate.")]
pub struct Arguments {
    /// The certificate, as `solve --cert` writes it
    cert: PathBuf,
    /// A problem file (TOML) that the certificate has to be about
    file: Option<PathBuf>,
    /// Threads to use [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Print nothing: the exit code tells
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> u8 {
    output::exit_code(try_run(arguments))
}

fn try_run(arguments: &Arguments) -> Result<u8, String> {
    let name = arguments.cert.display();
    let problem = arguments.file.as_ref().map(Problem::read).transpose();
    let problem = problem.map_err(|error| error.to_string())?;
    let file = File::open(&arguments.cert).map_err(|e| format!("{name}: cannot be read: {e}"))?;
    let settings = Settings {
        threads: arguments.threads.unwrap_or(0).into(),
    };
    let clock = Instant::now();
    let mut line = ProgressLine::new(!arguments.quiet, "");
    let mut show = |stage: Stage| line.show_check(stage.tubes, stage.solutions);
    let verdict = verify(BufReader::new(file), &settings, &mut show);
    line.clear();
    let verdict = verdict.map_err(|error| format!("{name}: {error}"))?;
    let same = problem
        .as_ref()
        .is_none_or(|problem| verdict.is_about(problem));
    let mut text = theorem(&verdict, clock.elapsed());
    if let Some(file) = &arguments.file {
        text += &match same {
            true => format!("The problem is the one in {}, exactly.\n", file.display()),
            false => format!(
                "REFUTED: the problem is not the one in {}.\n",
                file.display()
            ),
        };
    }
    if !arguments.quiet && !output::print(&text) {
        return Ok(BAD_INPUT);
    }
    Ok(match verdict.outcome {
        Outcome::Verified if same => CLOSED,
        _ => STOPPED,
    })
}
