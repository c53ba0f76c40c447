//! Motions, for people and for programs.

use super::certain_digits;
use super::drawing::Drawing;
use super::edit::{bounds, points_to_value};
use super::measured::Measures;
use super::sweep::frames_to_csv;
use crate::interval::point;
use crate::motion::{Bounds, Extreme, Measured, Motion};
use crate::problem::counted;
use crate::track::{EndKind, PathEnd, Status};
use serde_json::{Value, json};
use std::fmt::Write;

/// What kind of motion it is, a sentence.
pub fn motion_in_words(motion: &Motion) -> String {
    let freed = match &motion.freed[..] {
        [] => String::new(),
        freed => format!(", {} set free", freed.join(" and ")),
    };
    let tubes = counted(motion.outcome.steps, "tube");
    let what = match &motion.outcome.status {
        Status::Closed => format!(
            "the figure moves all the way round and comes back to where it is drawn: a loop of figures, proved in {tubes}, with no place \
             on it where it could go another way"
        ),
        Status::Open(_) => format!(
            "the figure moves between two ends, proved in {tubes}, with no place between them where it could go another way; beyond the \
             ends it was not followed"
        ),
        Status::Stopped(stop) => format!(
            "the figure moves, and was followed with proof for {tubes}, but not to an end: {}",
            stop.text
        ),
    };
    let account = motion.account.clause_behind();
    format!("{}{freed}: {what}{account}.", motion.problem.name)
}

/// A motion as text: what it is, and what was measured.
pub fn motion_to_table(motion: &Motion) -> String {
    let mut out = motion_in_words(motion) + "\n";
    if motion.moved > 1e-9 {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "The drawing was moved to a figure that meets its dimensions first: no point moved by more than {:.1e}.",
            motion.moved
        );
    }
    if let Status::Open(ends) = &motion.outcome.status {
        for (which, end) in ["One end", "The other"].iter().zip(&**ends) {
            let _ = writeln!(out, "  {which}: {}.", end_in_words(end));
        }
    }
    let is_all = matches!(motion.outcome.status, Status::Closed);
    let heading = match is_all {
        true => "Over the whole way round",
        false => "As far as it was followed",
    };
    let rows: Vec<[String; 4]> = motion.measured.iter().map(cells).collect();
    if rows.is_empty() {
        return out;
    }
    let headings = [heading, "at first", "least", "greatest"];
    let width = |k: usize| {
        let cells = rows.iter().map(|row| row[k].chars().count());
        cells.chain([headings[k].len()]).max().unwrap_or(0)
    };
    let widths = [0, 1, 2, 3].map(width);
    let _ = writeln!(out);
    for row in
        std::iter::once(headings).chain(rows.iter().map(|row| row.each_ref().map(String::as_str)))
    {
        let cells = row.iter().zip(widths);
        let padded: Vec<String> = cells
            .map(|(cell, width)| format!("{cell:<width$}"))
            .collect();
        let _ = writeln!(out, "  {}", padded.join("  ").trim_end());
    }
    let _ = writeln!(
        out,
        "\nNo figure of the way is beyond these values, and one reaches each, proved{}; they differ from the exact ones by at most 1 in the \
         last digit shown. Angles are in degrees.",
        if is_all {
            ""
        } else {
            ", as far as it was followed"
        }
    );
    out
}

fn cells(measured: &Measured) -> [String; 4] {
    let first = certain_digits(measured.first);
    let [least, most] = match &measured.bounds {
        Bounds::Between { least, most } => [least, most].map(|end| certain_digits(end.value)),
        Bounds::AllTheWay(turns) => {
            let rounds = match turns.unsigned_abs() {
                1 => "all the way round".to_owned(),
                n => format!("{n} times round"),
            };
            [rounds, String::new()]
        }
        Bounds::Untold => [
            "not told: its points may come together".to_owned(),
            String::new(),
        ],
    };
    [measured.name.clone(), first, least, most]
}

/// Where a motion ends, and why it seems to.
fn end_in_words(end: &PathEnd) -> String {
    let reason = end.reason.trim_end_matches('.');
    match end.kind {
        EndKind::Infinite => format!("followed until {reason}"),
        _ => reason.to_owned(),
    }
}

/// A motion as a value in memory, as `krawl motion --json` writes it (docs/motion.md).
pub fn motion_to_value(motion: &Motion) -> Value {
    let problem = &motion.problem;
    let points = |points: &[_]| points_to_value(problem, points);
    let extreme = |end: &Extreme| json!({"value": bounds(end.value), "at": end.at, "points": points(&end.points)});
    let measured = motion.measured.iter().map(|measured| {
        let mut out =
            json!({"name": measured.name, "unit": measured.unit, "first": bounds(measured.first)});
        match &measured.bounds {
            Bounds::Between { least, most } => {
                out["least"] = extreme(least);
                out["greatest"] = extreme(most);
            }
            Bounds::AllTheWay(turns) => out["turns"] = json!(turns),
            Bounds::Untold => {}
        }
        out
    });
    let (status, ends) = match &motion.outcome.status {
        Status::Closed => ("closed", Vec::new()),
        Status::Open(ends) => (
            "open",
            ends.iter()
                .map(|end| json!({"kind": end.kind.name(), "words": end_in_words(end)}))
                .collect(),
        ),
        Status::Stopped(_) => ("stopped", Vec::new()),
    };
    let frames = motion.frames.iter();
    let frames = frames.map(|frame| json!({"at": frame.at, "points": points(&frame.points)}));
    Drawing::in_place("motion", problem).with(json!({
        "freed": motion.freed,
        "driver": motion.driver.map(|p| &problem.points[p].name),
        "status": status,
        "words": motion_in_words(motion),
        "tubes": motion.outcome.steps,
        "moved": motion.moved,
        "account": motion.account,
        "ends": ends,
        "measured": measured.collect::<Vec<_>>(),
        "frames": frames.collect::<Vec<_>>(),
    }))
}

/// The frames of a motion as CSV: the way up to each, the coordinates of all points, as floats, and what is measured.
pub fn motion_to_csv(motion: &Motion, measures: &Measures) -> String {
    let frames = motion.frames.iter();
    let frames: Vec<_> = frames
        .map(|frame| ([point(frame.at)], &frame.points[..]))
        .collect();
    frames_to_csv(&motion.problem, &["way".to_owned()], &frames, measures)
}
