//! The page of `explore`: every solution found, with the path that found it first.

use super::reader::{Reader, nothing};
use super::{Figure, Page, ShowError, Tone, path};
use crate::report::document::{Explored, wrong};
use std::collections::BTreeMap;

pub(super) fn page(reader: &Reader, result: &Explored) -> Result<Page, ShowError> {
    let note = "of the problem; solutions have been found from others too";
    let mut page = reader.page("Sketch", note)?;
    let solutions = &result.solutions;
    // Paths that are drawn, in the order in which solutions ask for them.
    let mut drawn: BTreeMap<u64, usize> = BTreeMap::new();
    let mut widths: Vec<Option<f64>> = vec![None];
    for (k, solution) in solutions.iter().enumerate() {
        let id = solution.path;
        let found = result.paths.get(&id).ok_or_else(|| wrong("paths"))?;
        let from = found.origin();
        let samples = found.samples.as_deref().unwrap_or_default();
        let folds = found.folds.as_deref().unwrap_or_default();
        if !drawn.contains_key(&id)
            && let Some(mut read) = path::read(reader, samples, folds)?
        {
            read.name = format!("path {id}, from {from}");
            read.has_own_sketch = true;
            drawn.insert(id, page.paths.len());
            page.paths.push(read);
        }
        let on = drawn.get(&id).copied();
        let (bend, c) = (&found.bend, &found.bend_coefficient);
        let flat = if solution.flat { "; flat" } else { "" };
        page.figures.push(Figure {
            name: format!("Solution {}", k + 1),
            note: format!("on path {id}, from {from}, {bend} bent by {c}{flat}"),
            class: Some(k),
            path: on,
            at: solution.arc.filter(|_| on.is_some()),
            t: on.map(|_| 1.0),
            folds: solution.folds,
            ..reader.figure(&solution.points, &nothing())?
        });
        widths.push(path::width(&solution.points));
    }
    for path in &mut page.paths {
        if let Some(accuracy) = &mut path.accuracy {
            accuracy.figures.clone_from(&widths);
        }
    }
    let all = result.all_real == Some(solutions.len());
    page.rate(match all {
        true => ("proved · all there are", Tone::Proved),
        false => ("each proved; there may be more", Tone::Observed),
    });
    page.verdict = result.verdict.clone();
    page.say(
        "From every solution found, the branches of a construction plan give new sketches, and the path through each \
         was followed with proof. A solution of the list lies within the digits shown, alone, and no two are \
         congruent. The path is the one that found the solution first.",
    );
    page.say(match page.paths.is_empty() {
        true => "Paths are drawn where they are asked for: `krawl explore` with `--html`, or `--json` with \
                 `--samples N`.",
        false => "The pictures are drawn from the tubes that were proved; they are pictures, the digits are the \
                  result.",
    });
    let counts = &result.counts;
    for (label, value) in [
        ("paths followed", Some(counts.followed)),
        ("of these closed", Some(counts.closed)),
        ("stopped", Some(counts.stopped)),
        ("sketches that wait", Some(counts.waiting)),
        ("tubes", Some(counts.tubes)),
        (
            "ways (plan, length that bends, coefficient)",
            Some(result.ways),
        ),
        ("real solutions, proved to be all", result.all_real),
    ] {
        value.into_iter().for_each(|value| page.row(label, value));
    }
    Ok(page)
}
