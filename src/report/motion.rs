//! Motions, for people and for programs.

use super::certain_digits;
use super::columns::Grid;
use super::document::names;
use super::measured::Measures;
use super::sweep::frames_to_csv;
use crate::blocks::rounded_up;
use crate::edit::WayEnd;
use crate::interval::{Bound, Interval, point};
use crate::motion::{Bounds, Measured, Motion};
use crate::problem::counted;

/// What kind of motion it is, a sentence.
pub fn motion_in_words(motion: &Motion) -> String {
    let freed = match &motion.freed[..] {
        [] => String::new(),
        freed => format!(", {} set free", freed.join(" and ")),
    };
    let tubes = counted(motion.tubes, "tube");
    let what = match (motion.is_loop(), motion.is_told()) {
        (true, _) => format!(
            "the figure moves through a loop of figures and comes back to the first, proved in {tubes}; nowhere on it could it go another way"
        ),
        (_, true) => format!(
            "the figure moves between two ends, proved in {tubes}; nowhere between them could it go another way, and beyond them it was not followed"
        ),
        _ => format!(
            "the figure moves, and was followed with proof for {tubes}, but not all the way"
        ),
    };
    let account = motion.account.clause_behind();
    format!("{}{freed}: {what}{account}.", motion.problem.name)
}

/// A motion as text: what it is, and what was measured.
pub fn motion_to_table(motion: &Motion) -> String {
    let mut out = motion_in_words(motion) + "\n";
    let coordinates = motion.problem.points.iter().flat_map(|p| &p.sketch);
    let size = coordinates.fold(0.0, |size: f64, x| size.max(x.to_f64().abs()));
    if motion.moved > 1e-9 * size {
        out += &format!(
            "The drawing was moved to a figure that meets its dimensions first: no point moved by more than {}.\n",
            rounded_up(motion.moved)
        );
    }
    for (which, end) in ["One way", "The other way"].iter().zip(&motion.ends) {
        out += &format!("  {which}: {}.\n", end_in_words(end));
    }
    let standing = names(&motion.problem, &motion.standing);
    if !standing.is_empty() {
        out += &format!(
            "Coordinates are those in which {} stand still.\n",
            standing.join(" and ")
        );
    }
    let heading = match motion.is_loop() {
        true => "Over the whole loop",
        false => "As far as it was followed",
    };
    if motion.measured.is_empty() {
        return out;
    }
    let mut grid = Grid::new([heading, "at first", "least", "greatest"], |_| true);
    for measured in &motion.measured {
        grid.push(cells(measured));
    }
    out += "\n";
    out += &grid.render();
    let followed = match motion.is_loop() {
        true => "",
        false => ", as far as it was followed",
    };
    let all_are_sharp = motion
        .measured
        .iter()
        .all(|measured| match &measured.bounds {
            Bounds::Between { least, most } => is_sharp(least.value) && is_sharp(most.value),
            _ => true,
        });
    out += &match all_are_sharp {
        true => format!(
            "\nNo figure of the way is beyond these values, and figures come as near to each as its digits tell, proved{followed}; they differ \
             from the exact ones by at most 1 in the last digit shown. Angles are in degrees.\n"
        ),
        false => format!(
            "\nNo figure of the way is beyond these values, proved{followed}. Where it says at least or at most, figures may come less near to \
             the value; to all others they come as near as the digits tell, and these differ from the exact values by at most 1 in the last \
             digit shown. Angles are in degrees.\n"
        ),
    };
    out
}

fn cells(measured: &Measured) -> [String; 4] {
    let first = certain_digits(measured.first);
    let [least, most] = match &measured.bounds {
        Bounds::Between { least, most } => [
            end_of(least.value, "at least", Bound::Lower),
            end_of(most.value, "at most", Bound::Upper),
        ],
        Bounds::AllTheWay(turns) => {
            let rounds = match turns {
                1 => "a full turn".to_owned(),
                n => format!("{n} full turns"),
            };
            [rounds, String::new()]
        }
        Bounds::Untold => [
            "not told: its points may come together, or the time was over".to_owned(),
            String::new(),
        ],
    };
    [measured.name.clone(), first, least, most]
}

/// Whether a bound is known well enough to be told by its certain digits.
fn is_sharp(value: Interval) -> bool {
    value.wid() <= 1e-4 * value.mag().max(1.0)
}

/// A bound by its certain digits, or by its outer end where few are certain.
fn end_of(value: Interval, word: &str, outer: Bound) -> String {
    match is_sharp(value) {
        true => certain_digits(value),
        false => format!("{word} {}", outer.short(outer.end(value))),
    }
}

/// Where a motion ends, and why.
pub(super) fn end_in_words(end: &WayEnd) -> String {
    let reason = end.words.trim_end_matches('.');
    match end.kind {
        "singular" => format!(
            "it comes to a figure from which it may go more than one way, seen in floats ({reason})"
        ),
        "infinite" => format!("followed until {reason}"),
        _ => reason.to_owned(),
    }
}

/// The frames of a motion as CSV: the way up to each, the coordinates of all points, as floats, and what is measured.
pub fn motion_to_csv(motion: &Motion, measures: &Measures) -> String {
    let frames = motion.frames.iter();
    let frames: Vec<_> = frames
        .map(|frame| ([point(frame.at)], (&frame.points[..], &frame.objects[..])))
        .collect();
    frames_to_csv(&motion.problem, &["way".to_owned()], &frames, measures)
}
