//! `krawl export`: the polynomial system of a problem, for other programs.

use super::CLOSED;
use super::input;
use super::output::{self, Destination, in_file};
use krawl::complex::{Export, export, lower_in_squares, places};
use std::io::Write;
use std::path::PathBuf;

/// Write the polynomial system of a problem for another program
///
/// Figures are seen from the file's reference: its first point at the origin, the second on the x axis, the third in the xy plane; with
/// fixed places they are in the file's coordinates. x4 is the first coordinate of the fourth point. Which unknown is which coordinate of
/// which point is printed beside: on standard output, or where the system goes there, on standard error. Numbers are exact where they
/// are ratios.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl export problems/octahedron.toml --to phcpack --out octahedron.phc && phc -b octahedron.phc out
  krawl export problems/octahedron.toml --to msolve --out octahedron.ms && msolve -f octahedron.ms

Exit codes: 0 written, 2 bad input.")]
pub struct Arguments {
    /// The problem file (TOML), or a system of another program
    file: PathBuf,
    /// The program that is to read it
    #[arg(long, value_enum)]
    to: Program,
    /// Write it to this file [default: standard output]
    #[arg(
        long,
        value_name = "FILE",
        default_value = "-",
        hide_default_value = true
    )]
    out: PathBuf,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Program {
    /// PHCpack
    Phcpack,
    /// Macaulay2
    Macaulay2,
    /// msolve
    Msolve,
    /// HomotopyContinuation.jl
    Hc,
    /// ibexsolve
    Ibex,
    /// RealPaver
    Realpaver,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let file = arguments.file.display();
    let problem = input::of_equations(&arguments.file)?;
    output::refuse_read([&arguments.file], Some(&arguments.out))?;
    let to = match arguments.to {
        Program::Phcpack => Export::PhcPack,
        Program::Macaulay2 => Export::Macaulay2,
        Program::Msolve => Export::Msolve,
        Program::Hc => Export::HomotopyContinuation,
        Program::Ibex => Export::Ibex,
        Program::Realpaver => Export::RealPaver,
    };
    if matches!(to, Export::Ibex | Export::RealPaver) && !problem.is_distances_only() {
        return Err(format!(
            "{file}: a box that holds all solutions is known for distances only, and this program needs one"
        ));
    }
    let lowered = lower_in_squares(&problem).map_err(in_file(&arguments.file))?;
    // Points that bars join are no further apart than all bars together.
    let lengths = problem.distances.iter().map(|d| d.target.to_f64());
    let reach = (1.0 + lengths.sum::<f64>()).ceil();
    let text = export(&lowered.system, to, reach).map_err(in_file(&arguments.file))?;
    let names: Vec<String> = problem.points.iter().map(|p| p.name.clone()).collect();
    let places = places(&lowered.system, &names);
    let to = Destination::new(&arguments.out)?;
    let written = to.write(&text)
        && match to {
            Destination::StandardOutput => {
                // Where nobody listens nothing is lost.
                let _ = std::io::stderr().write_all(places.as_bytes());
                true
            }
            _ => output::print(&places),
        };
    Ok(if written { CLOSED } else { super::BAD_INPUT })
}
