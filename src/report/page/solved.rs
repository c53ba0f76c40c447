//! The page of a result of `solve`: the path through the sketch, and the solutions on it; or what came of blocks.

use super::reader::{Reader, choices, nothing};
use super::{Figure, Page, ShowError, Text, Tone, path};
use crate::interval::Bound;
use crate::report::document::{Blocks, Solution, Solve, Verb};

pub(super) fn page(reader: &Reader, run: &Solve) -> Result<Page, ShowError> {
    let mut page = reader.page("Sketch", "where the path begins, t = 0")?;
    let mode = &run.mode[..];
    let (closed, open) = (run.status == "closed", run.status == "open");
    page.rate(match (mode, closed) {
        ("certified", false) if open => ("proved · between the ends of the path", Tone::Proved),
        ("certified", true) => ("proved · complete for this path", Tone::Proved),
        (_, true) => ("observed, not proved", Tone::Observed),
        (_, false) if open => (
            "observed between the ends of the path, not proved",
            Tone::Observed,
        ),
        (_, false) => ("stopped", Tone::Stopped),
    });
    page.verdict = run.verdict.clone();
    page.paths
        .extend(path::read(reader, &run.samples, &run.folds)?);
    let sketch = &mut page.figures[0];
    (sketch.path, sketch.at, sketch.t) = (Some(0), Some(0.0), Some(0.0));
    for (k, found) in run.solutions.iter().enumerate() {
        page.figures.push(solution(reader, k, found)?);
    }
    if let Some(accuracy) = page.paths.iter_mut().find_map(|p| p.accuracy.as_mut()) {
        let widths = run.solutions.iter().map(|s| path::width(&s.points));
        accuracy.figures = std::iter::once(None).chain(widths).collect();
    }
    explain(&mut page, run, closed, open);
    if mode != "certified" {
        page.digits = reader.gauge();
    }
    tell(&mut page, reader, run);
    Ok(page)
}

/// Figures of the whole that are made of solutions of its blocks.
pub(super) fn blocks(reader: &Reader, run: &Solve, blocks: &Blocks) -> Result<Page, ShowError> {
    let mut page = reader.page("Sketch", "not a solution: drawn for comparison")?;
    page.rate(match blocks.proved {
        true => (
            "proved · complete for the paths of the blocks",
            Tone::Proved,
        ),
        false => ("proved in part", Tone::Stopped),
    });
    page.verdict = blocks.verdict.clone();
    let mut listed = 0;
    for (k, combined) in blocks.figures.iter().enumerate() {
        listed += 1;
        // Where its boxes are too wide there is nothing to draw.
        let Some(points) = &combined.points else {
            continue;
        };
        page.figures.push(Figure {
            name: format!("Figure {}", k + 1),
            note: choices(&combined.choices),
            class: Some(k),
            ..reader.figure(points, &nothing())?
        });
    }
    page.say(
        "The problem falls apart into blocks that share no more than a side (in space: a triangle of sides). As a \
         whole it could not be followed to the end, so the path of each block was, and the solutions of the blocks are \
         put together in every way, as they are or mirrored in the side by which they hang together.",
    );
    let runs = blocks.runs.iter().filter_map(|run| match &run.own {
        Verb::Solve(own) => Some(format!("{}: {}", run.drawing.names.join(", "), own.verdict)),
        _ => None,
    });
    page.text.push(Text::List(runs.collect()));
    if let Some(reason) = &run.reason {
        page.say(format!("Why the whole stopped: {reason}."));
    }
    let shown = page.figures.len() - 1;
    page.row("blocks", blocks.runs.len());
    let figures = match blocks.count {
        Some(count) if count > listed => {
            format!("{count}, the first {shown} of them here (`--all`: all)")
        }
        Some(count) => count.to_string(),
        None => format!("more than 2^64, the first {shown} of them here"),
    };
    page.row("figures", figures);
    Ok(page)
}

fn solution(reader: &Reader, k: usize, solution: &Solution) -> Result<Figure, ShowError> {
    let &Solution { class, folds, .. } = solution;
    let mut note = match folds {
        Some(0) => "reached without a fold".to_owned(),
        Some(1) => "after a fold".to_owned(),
        Some(n) => format!("after {n} folds"),
        None => format!("class {class}"),
    };
    if let Some(other) = solution.mirror_of {
        note += &format!(", mirror image of {}", other + 1);
    }
    if solution.degenerate {
        note += ", degenerate (flat)";
    }
    Ok(Figure {
        name: format!("Solution {}", k + 1),
        note,
        class: Some(class),
        path: Some(0),
        at: solution.arc,
        t: Some(1.0),
        folds,
        ..reader.figure(&solution.points, &solution.objects)?
    })
}

/// The numbers of the run.
fn tell(page: &mut Page, reader: &Reader, run: &Solve) {
    let shown = |x: Option<f64>| match x.filter(|x| x.is_finite()) {
        Some(x) => format!("{x:.6}"),
        None => "?".to_owned(),
    };
    page.row("mode, space", format!("{}, {}", run.mode, run.space));
    page.row(
        "steps, rejected",
        format!("{}, {}", run.steps, run.rejected),
    );
    page.row("length of the path", shown(run.length));
    let known = |bound: Bound, x: Option<f64>| match x.filter(|x| x.is_finite()) {
        Some(x) => bound.decimals(x, 6),
        None => "?".to_owned(),
    };
    let [low, high] = run.t_range;
    let (low, high) = (known(Bound::Lower, low), known(Bound::Upper, high));
    page.row("range of t", format!("{low} to {high}"));
    page.row("seconds", shown(Some(run.seconds)));
    if let Some(bend) = &run.options.bend {
        let c = &run.options.bend_coefficient;
        page.row("bend", format!("{}, c = {c}", bend.join("-")));
    }
    for text in &run.switched_on {
        page.row("switched on", text);
    }
    page.row("written by", format!("krawl {}", reader.drawing.krawl));
    if !reader.drawing.source.is_empty() {
        page.row("source", &reader.drawing.source);
    }
}

/// The answer explained.
fn explain(page: &mut Page, run: &Solve, closed: bool, open: bool) {
    let mode = &run.mode[..];
    page.say(
        "The sketch's dimensions are led to the wanted ones together: t = 0 is the sketch, and at t = 1 all \
         dimensions are what they should be. As they change the figure moves along a path; wherever that \
         path meets t = 1 there is a solution. Solutions of one colour are congruent: the same figure, or \
         its mirror image.",
    );
    let is_flat = run.solutions.iter().any(|solution| solution.degenerate);
    match (mode, closed) {
        ("certified", true) => {
            page.say(
                "What is proved, for the exact decimals of the problem and with every rounding accounted for:",
            );
            page.text.push(Text::List(vec![
                "The path through the sketch is a closed curve, regular along its whole length, and it was \
                 followed all the way round: no step jumped to another curve."
                    .into(),
                "The solutions listed are exactly the points of that path with t = 1: none is missing and \
                 none is there twice. Each lies within the digits shown, alone."
                    .into(),
                "All lengths stay positive along the path.".into(),
            ]));
            page.say(
                "Other solutions may exist on other paths. The pictures are drawn from the tubes that were \
                 proved; they are pictures, the digits are the result.",
            );
        }
        ("certified", false) if open => page.say(
            "The path seems to have two ends, beyond which it was not followed. What is proved is about the arc between them: it is \
             regular, no step jumped, and the solutions listed are exactly those on it, each alone within the digits shown.",
        ),
        ("certified", false) => page.say(
            "The run stopped before it came back to the sketch. The solutions listed are proved, each alone \
             within the digits shown; there may be more on the rest of the path.",
        ),
        _ => page.say(
            "This run was made in floating-point arithmetic: what it says is observed, not proved.",
        ),
    }
    if is_flat && mode == "certified" {
        page.say(
            "This is different at solutions that are degenerate (flat): there the path is regular in the equations with heights \
             divided by 1 − t, not in the given ones, and other flat figures that meet the constraints are as near as one likes. On \
             the path are only those listed.",
        );
    }
    if let Some(reason) = &run.reason {
        page.say(format!("Why it stopped: {reason}."));
    }
}
