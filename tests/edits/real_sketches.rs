//! Real sketches of SolveSpace and FreeCAD, read and edited.
//!
//! The files are not part of the project: the folder `KRAWL_SKETCHES` names, or `../shared/sketches` beside the
//! project's root. Where there is none the test says so and passes.

use krawl::edit::{Ending, Session, Setting};
use krawl::import;
use krawl::problem::{Decimal, Problem};
use krawl::track::StopKind;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// No longer than this for all files together; what is left then is said.
const BUDGET: Duration = Duration::from_secs(240);

fn folder() -> Option<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let named = std::env::var_os("KRAWL_SKETCHES").map(PathBuf::from);
    let places = [
        named,
        Some(root.join("../shared/sketches")),
        Some(root.join("../../shared/sketches")),
    ];
    places.into_iter().flatten().find(|place| place.is_dir())
}

fn files() -> Vec<PathBuf> {
    let Some(folder) = folder() else {
        return Vec::new();
    };
    let mut files = Vec::new();
    for kind in ["slvs", "freecad"] {
        let Ok(entries) = std::fs::read_dir(folder.join(kind)) else {
            continue;
        };
        files.extend(entries.map(|entry| entry.unwrap().path()));
    }
    files.sort();
    files
}

/// A value times a factor, as a decimal of few digits.
fn times(problem: &Problem, index: usize, factor: f64) -> Option<Decimal> {
    let now = match index.checked_sub(problem.distances.len()) {
        None => match &problem.distances[index].target {
            krawl::problem::Target::Length(x) => x.to_f64(),
            krawl::problem::Target::SquaredLength(x) => x.to_f64().sqrt(),
        },
        Some(c) => problem.constraints[c].value.as_ref()?.to_f64(),
    };
    format!("{:.9e}", now * factor).parse().ok()
}

#[derive(Default)]
struct Count {
    sketches: usize,
    supported: usize,
    opened: usize,
    dimensions: usize,
    edits: BTreeMap<&'static str, usize>,
    moved: f64,
}

#[test]
fn real_sketches_load_and_survive_edits() {
    let files = files();
    if files.is_empty() {
        println!("skipped: there is no folder of real sketches (set KRAWL_SKETCHES)");
        return;
    }
    let clock = Instant::now();
    let mut count = Count::default();
    let mut unsupported: BTreeMap<String, usize> = BTreeMap::new();
    let mut troubles: Vec<String> = Vec::new();
    let mut left = 0;
    for file in &files {
        if clock.elapsed() > BUDGET {
            left += 1;
            continue;
        }
        let name = file.file_name().unwrap().to_str().unwrap();
        let bytes = std::fs::read(file).unwrap();
        println!("{name} {:?}", clock.elapsed());
        for listed in import::list(name, &bytes).unwrap() {
            let sketch = import::read(name, &bytes, Some(&listed.name)).unwrap();
            if sketch.problem.points.is_empty() {
                continue;
            }
            count.sketches += 1;
            for (kind, n) in &sketch.problem.kept.kinds {
                *unsupported.entry(kind.clone()).or_default() += n;
            }
            count.supported += usize::from(sketch.problem.kept.kinds.is_empty());
            let what = format!("{name} {}", listed.name);
            let start = Instant::now();
            let mut session = match Session::open(&sketch.problem) {
                Ok(session) => session,
                Err(error) => {
                    troubles.push(format!("{what}: {error}"));
                    continue;
                }
            };
            let opening = start.elapsed();
            count.opened += 1;
            let size = session
                .figure()
                .iter()
                .flatten()
                .fold(0.0f64, |m, x| m.max(x.abs()));
            let moved = session.moved().distance / size.max(1e-9);
            count.moved = count.moved.max(moved);
            if moved > 1e-5 {
                troubles.push(format!("{what}: moved by {moved:.1e} of its size"));
            }
            let problem = session.problem().clone();
            let start = Instant::now();
            let mut edits = 0;
            for index in problem.dimensions() {
                count.dimensions += 1;
                for factor in [0.99, 1.01, 0.9, 1.1] {
                    let Some(value) = times(&problem, index, factor) else {
                        continue;
                    };
                    let Ok(setting) = Setting::new(&problem, index, value) else {
                        continue;
                    };
                    let edited = session.probe(&[setting], &mut Default::default());
                    edits += 1;
                    let name = match &edited.ending {
                        // Where a drawn line shrinks to nothing an edit has an end.
                        Ending::Stopped(stop) if stop.kind == StopKind::Vanishes => "vanishes",
                        ending => ending.name(),
                    };
                    *count.edits.entry(name).or_default() += 1;
                    if let Ending::Stopped(reason) | Ending::Passes(reason) = &edited.ending {
                        let dimension = problem.dimension_name(index);
                        troubles.push(format!(
                            "{what}: {dimension} x {factor}: {} {reason}",
                            edited.ending.name()
                        ));
                    }
                }
            }
            println!(
                "{what}: {} points, blocks {:?}, free {}, redundant {}; open {:.1} ms, {edits} edits {:.2} ms each",
                problem.points.len(),
                session
                    .decomposition()
                    .unwrap()
                    .blocks
                    .iter()
                    .map(Vec::len)
                    .collect::<Vec<_>>(),
                session.account().held.len(),
                session.account().left_out.len(),
                opening.as_secs_f64() * 1e3,
                start.elapsed().as_secs_f64() * 1e3 / f64::from(edits.max(1)),
            );
        }
    }
    println!(
        "{} sketches, {} of supported kinds, {} opened, {} dimensions, edits {:?}",
        count.sketches, count.supported, count.opened, count.dimensions, count.edits
    );
    println!("not supported: {unsupported:?}");
    println!(
        "moved by at most {:.1e} of their size; {left} files left; {:.1} s",
        count.moved,
        clock.elapsed().as_secs_f64()
    );
    for trouble in &troubles {
        println!("  {trouble}");
    }
    // Every sketch loads, and is where its file has it.
    assert!(count.supported > 0, "no sketch is supported");
    assert_eq!(count.opened, count.sketches);
    assert!(count.moved <= 1e-6, "{:e}", count.moved);
    let all: usize = count.edits.values().sum();
    let stopped = count.edits.get("stopped").copied().unwrap_or(0);
    assert!(100 * stopped < all, "{stopped} of {all} edits stopped");
    let passes = count.edits.get("passes").copied().unwrap_or(0);
    assert!(
        100 * passes < all,
        "in {passes} of {all} edits branches seem to meet"
    );
}
