//! The command line: one file per verb.

mod check;
mod compare;
mod generate;
mod interrupt;
mod output;
mod processor;
mod solve;
mod verify;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Exit code of a run that closed, of a check that found nothing wrong, and of a certificate that
/// is verified.
pub const CLOSED: u8 = 0;
/// Exit code of a run that stopped before.
pub const STOPPED: u8 = 1;
/// Exit code of a certificate with a false claim, or about another problem.
pub const REFUTED: u8 = 1;
/// Exit code where the input is bad, or the results could not be written. Usage errors have it too.
pub const BAD_INPUT: u8 = 2;
/// Exit code of a certificate with a claim that may be true but could not be proved.
pub const NOT_PROVED: u8 = 3;
/// Exit code of a certificate whose run stopped: it is true as far as it goes.
pub const INCOMPLETE: u8 = 4;

/// Follows the real homotopy path through a sketch and finds, with proof, the figures on it that
/// meet the dimensions.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit codes: 0 closed or verified, 1 stopped or refuted, 2 bad input or results that \
                  could not be written; of `verify` also 3 not proved and 4 incomplete."
)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Check(check::Arguments),
    Compare(compare::Arguments),
    Generate(generate::Arguments),
    Solve(solve::Arguments),
    Verify(verify::Arguments),
}

/// Runs the program. The exit code is its result.
pub fn run() -> ExitCode {
    if let Err(message) = processor::check() {
        output::complain(&message);
        return ExitCode::from(BAD_INPUT);
    }
    let code = match Arguments::parse().verb {
        Verb::Check(arguments) => check::run(&arguments),
        Verb::Compare(arguments) => compare::run(&arguments),
        Verb::Generate(arguments) => generate::run(&arguments),
        Verb::Solve(arguments) => solve::run(&arguments),
        Verb::Verify(arguments) => verify::run(&arguments),
    };
    ExitCode::from(code)
}
