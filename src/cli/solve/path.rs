//! Paths of problems that are followed as a whole.

use super::{Arguments, interrupt};
use crate::cli::output::Beside;
use crate::cli::verify::check_written;
use krawl::problem::Problem;
use krawl::report::ProgressLine;
use krawl::track::{self, Control, First, Mode, Outcome, Progress, Signs, Status, Trace};

/// Figures along a path for a page: smooth, and not too much to load.
pub(super) fn samples_for(problem: &Problem) -> usize {
    (60_000 / problem.points.len().max(1)).clamp(100, 2400)
}

/// Follows the path of one problem. Also tells whether its certificate could be written, and the exit code for
/// one that does not pass its check.
pub(super) fn follow(
    arguments: &Arguments,
    problem: &Problem,
    name: &str,
    which: &str,
    cert: Option<&Beside>,
    trace: Option<&mut Trace>,
) -> Result<(Outcome, bool, Option<u8>), String> {
    let options = arguments.options();
    let mut witness = cert.map(|beside| beside.certificate(problem));
    let line = ProgressLine::new(!arguments.quiet, which);
    let mut show = |now: Progress| line.show(now);
    let mut control = Control {
        progress: Some(&mut show),
        trace,
        ..interrupt::witnessed(witness.as_mut())
    };
    let outcome = match arguments.space {
        Some(_) => track::solve(problem, &options, &mut control),
        // A space that was not asked for may be changed.
        None => track::solve_in_best_space(problem, &options, &mut control),
    };
    line.clear();
    let mut outcome = outcome.map_err(|error| format!("{name}: {error}"))?;
    if arguments.mode == Mode::Certified
        && arguments.space.is_some()
        && outcome.space == track::Space::Reduced
        && options.extended
        // A sketch that no run can leave is singular in any precision.
        && outcome.steps > 0
        && let Status::Stopped(reason) = &mut outcome.status
        && !interrupt::is_requested()
    {
        reason.text += "; the full space has extended precision (`--space full`)";
    }
    let (mut written, mut verdict) = (true, None);
    if let (Some(beside), Some(writer)) = (cert, witness) {
        written &= beside.commit(writer.finish().map(|_| ()));
        if written && !arguments.no_verify {
            let path = arguments.cert.as_deref();
            let path = path.filter(|_| !interrupt::is_requested());
            let closed = matches!(outcome.status, Status::Closed);
            verdict = check_written(path, closed, arguments.quiet)?;
        }
    }
    Ok((outcome, written, verdict))
}

/// Follows the first arc of a path, on which t rises.
pub(super) fn follow_first(
    arguments: &Arguments,
    problem: &Problem,
    name: &str,
    which: &str,
) -> Result<First, String> {
    if arguments.mode == Mode::Float {
        let (outcome, _, _) = follow(arguments, problem, name, which, None, None)?;
        return Ok(First {
            outcome,
            turns_at: None,
        });
    }
    let options = arguments.options();
    let space = arguments.space.map(|_| options.space);
    let found = interrupt::shown(!arguments.quiet, which, |control| {
        track::first(problem, space, &options, control)
    });
    found.map_err(|error| format!("{name}: {error}"))
}

/// Follows the path again in narrow tubes, if that comes to the same end, for pictures and folds: what it
/// tells about the places of the solutions is more.
pub(super) fn follow_finely(
    arguments: &Arguments,
    problem: &Problem,
    which: &str,
    outcome: &mut Outcome,
) -> Option<Trace> {
    let what = format!("{which} picture");
    let traced = interrupt::shown(!arguments.quiet, what.trim_start(), |control| {
        track::trace_path(problem, &arguments.options(), control)
    });
    let (mut finer, trace) = traced.ok()?;
    Signs::of(problem).test(&mut finer, problem.dimension);
    let kind = |outcome: &Outcome| std::mem::discriminant(&outcome.status);
    if kind(&finer) != kind(outcome) || finer.solutions.len() != outcome.solutions.len() {
        return None;
    }
    outcome.length = finer.length;
    for (solution, finer) in outcome.solutions.iter_mut().zip(finer.solutions) {
        solution.place = finer.place;
    }
    Some(trace)
}
