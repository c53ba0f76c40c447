//! `krawl check`: reads a problem and prints what it understood.

use super::{BAD_INPUT, CLOSED, input, output};
use krawl::plan::Plan;
use krawl::problem::{Problem, Target};
use krawl::system::{GaugeError, Homotopy};
use std::fmt::Write;
use std::path::PathBuf;

/// Check a problem file and print what is in it
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  krawl check sketch.toml
  krawl check sketch.toml --pattern
  krawl generate tower --size 60 | krawl check -

Exit codes: 0 in order, 2 not in order, with the line and what to do.")]
pub struct Arguments {
    /// The problem file (TOML); `-` is standard input
    file: PathBuf,
    /// Show where the Jacobian has entries, ordered by the construction plan, however many
    /// coordinates there are (otherwise up to 40)
    #[arg(long)]
    pattern: bool,
}

/// Up to so many free coordinates the pattern is shown without being asked for: it fits a screen.
const PATTERN: usize = 40;

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> u8 {
    let problem = match input::read(&arguments.file) {
        Ok(problem) => problem,
        Err(message) => {
            output::complain(&message);
            return BAD_INPUT;
        }
    };
    let mut text = describe(&problem);
    match construction_plan(&problem, arguments.pattern) {
        Ok(plan) => text += &plan,
        Err(error) => {
            output::complain(&format!("{}: {error}", input::name(&arguments.file)));
            return BAD_INPUT;
        }
    }
    if output::print(&text) {
        CLOSED
    } else {
        BAD_INPUT
    }
}

/// The construction plan with its driving parameters and removed constraints, and the pattern of
/// the Jacobian that comes of it, as lines of text.
fn construction_plan(problem: &Problem, always: bool) -> Result<String, GaugeError> {
    let homotopy = Homotopy::new(problem)?;
    let plan = Plan::derive(&homotopy);
    let indent = |text: &str| text.lines().map(|line| format!("  {line}\n")).collect();
    let described: String = indent(&plan.describe(problem));
    let mut text = format!("construction plan\n{described}");
    if always || homotopy.equations <= PATTERN {
        let pattern: String = indent(&pattern(problem, &homotopy, &plan));
        text += "Jacobian (columns: key unknowns, then what follows from those to the left; \
                 rows: distances, removed constraints last)\n";
        text += &pattern;
    }
    Ok(text)
}

/// The pattern of the Jacobian under the plan: constraints by name, and coordinates.
fn pattern(problem: &Problem, homotopy: &Homotopy, plan: &Plan) -> String {
    let jacobian = plan.jacobian(homotopy, &homotopy.sketch);
    let distances: Vec<String> = (0..problem.distances.len())
        .map(|index| problem.distance_name(index))
        .collect();
    let coordinates: Vec<String> = homotopy
        .gauge
        .place
        .iter()
        .map(|&place| {
            let (point, axis) = (place / homotopy.dimension, place % homotopy.dimension);
            format!("{}.{}", problem.points[point].name, ["x", "y", "z"][axis])
        })
        .collect();
    jacobian
        .ordering()
        .render(&jacobian.equations, &distances, &coordinates)
}

fn describe(problem: &Problem) -> String {
    let mut rows: Vec<(&str, String)> = Vec::new();
    if !problem.source.is_empty() {
        rows.push(("source", problem.source.clone()));
    }
    let space = if problem.dimension == 2 {
        "2, the plane"
    } else {
        "3, space"
    };
    rows.push(("dimension", space.to_owned()));
    rows.push(("points", problem.points.len().to_string()));
    let squared = problem
        .distances
        .iter()
        .filter(|d| matches!(d.target, Target::SquaredLength(_)))
        .count();
    let distances = problem.distances.len();
    rows.push((
        "distances",
        match squared {
            0 => distances.to_string(),
            _ => format!("{distances}, {squared} of them given by their squares"),
        },
    ));
    let free = problem.free_coordinates();
    rows.push(("free coordinates", free.to_string()));
    rows.push((
        "degrees of freedom",
        format!("0 ({free} free coordinates, {distances} independent distances)"),
    ));
    let homotopy = &problem.homotopy;
    let reference = &homotopy.reference;
    let names: Vec<&str> = reference
        .iter()
        .map(|&p| problem.points[p].name.as_str())
        .collect();
    let mutually = reference
        .iter()
        .enumerate()
        .all(|(k, &a)| reference[..k].iter().all(|&b| problem.are_joined(a, b)));
    let mutually = if mutually {
        "mutually constrained"
    } else {
        "not mutually constrained: the coordinates may become singular where the figure is not"
    };
    rows.push(("reference", format!("{} ({mutually})", names.join(", "))));
    let bend = problem.distance_name(homotopy.bend);
    let c = &homotopy.bend_coefficient;
    let remark = if c.is_positive() {
        ""
    } else {
        " (not greater than zero: nothing makes the path turn back)"
    };
    rows.push(("bend", format!("{bend}, c = {c}{remark}")));

    let mut text = format!("{}: the input is in order\n", problem.name);
    for (label, value) in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {label:<20}{value}");
    }
    if let Some(message) = problem.impossible_triangle() {
        let _ = writeln!(text, "  {:<20}{message}", "but");
    }
    text
}
