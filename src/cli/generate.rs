//! `krawl generate`: makes a large problem of a family.

use super::CLOSED;
use super::output::{self, Destination};
use clap::ValueEnum;
use krawl::generate::{Family, Recipe};
use std::path::PathBuf;

/// Make a large well-constrained problem with few key unknowns
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl generate tetrahedra --size 300 --out tetrahedra.toml
  krawl generate strip --size 100 --loops 2 --seed 7 | krawl solve -

Exit codes: 0 written, 2 it could not be made or written.")]
pub struct Arguments {
    /// The family of problems
    #[arg(value_enum)]
    family: FamilyName,
    /// The least number of free coordinates
    ///
    /// The problem is the smallest of its family with as many
    #[arg(long, value_name = "N")]
    size: usize,
    /// The number of loops
    ///
    /// Each costs one driving parameter and one key unknown
    #[arg(long, value_name = "K", default_value_t = 1)]
    loops: usize,
    /// The seed of the random places and lengths: equal seeds make equal problems
    #[arg(long, value_name = "X", default_value_t = 1)]
    seed: u64,
    /// Write the problem to a file [default: standard output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum FamilyName {
    /// Strips of triangles in the plane, hinged, with closing bars
    Strip,
    /// Strips of tetrahedra, hinged, with closing bars
    Tetrahedra,
    /// Octahedra edge to edge, some of them hinged, with closing bars
    Chain,
    /// Octahedra face to face, most of them braced
    Tower,
}

impl From<FamilyName> for Family {
    fn from(name: FamilyName) -> Self {
        match name {
            FamilyName::Strip => Family::Strip,
            FamilyName::Tetrahedra => Family::Tetrahedra,
            FamilyName::Chain => Family::Chain,
            FamilyName::Tower => Family::Tower,
        }
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let out = match &arguments.out {
        Some(file) => Destination::new(file)?,
        None => Destination::StandardOutput,
    };
    let recipe = Recipe {
        family: arguments.family.into(),
        size: arguments.size,
        loops: arguments.loops,
        seed: arguments.seed,
    };
    let problem = recipe.problem().map_err(|error| error.to_string())?;
    Ok(output::code(out.write(&problem.to_toml()), CLOSED))
}
