//! What tolerances do to a figure, for people and for programs.

use super::certain_digits;
use super::complete::{both_ways_in_words, counted_once, why};
use super::sweep::quoted;
use crate::complete::Why;
use crate::edit::Limits;
use crate::interval::{Bound, point};
use crate::order::InOrder;
use crate::problem::{Problem, counted, either};
use crate::tolerance::{Measured, Set, Study};
use std::fmt::Write;

/// What is proved, a sentence.
pub fn tolerances_in_words(problem: &Problem, study: &Study) -> String {
    format!(
        "{}, there is exactly one figure that the one drawn becomes, proved{}",
        for_every_choice(problem, &study.limits),
        study.account.clause_behind()
    )
}

/// Of which choices something is said.
fn for_every_choice(problem: &Problem, limits: &[Limits]) -> String {
    let name = &problem.name;
    match limits.len() {
        1 => format!("{name}: for every choice of the dimension within its limits"),
        n => format!(
            "{name}: for every choice of the {} within their limits, all of them together",
            counted(n, "dimension")
        ),
    }
}

/// The study as text: for each measure its bounds, and what each dimension has to do with it.
pub fn tolerances_to_table(problem: &Problem, study: &Study) -> String {
    let measured = measured_to_table(problem, study);
    format!(
        "{}.\n{measured}\n{WHAT_IS_PROVED}",
        tolerances_in_words(problem, study)
    )
}

const WHAT_IS_PROVED: &str = "\
No choice goes beyond a worst case, proved, and a figure within the limits comes as near to it as is said. The rest is to first order about the \
nominal figure, in floats: what a dimension does alone as it goes through its limits, and the root of the sum of the squares of half of that, which is a \
tolerance if the dimensions are independent.
";

fn measured_to_table(problem: &Problem, study: &Study) -> String {
    let mut out = String::new();
    for measured in &study.measured {
        // Writing to a string cannot fail.
        let _ = write_measured(&mut out, problem, study, measured);
    }
    out
}

/// What is proved of all figures, a sentence.
pub fn tolerance_set_in_words(problem: &Problem, set: &Set) -> String {
    let (up_to, _) = counted_once(problem, set.symmetry);
    let is_all = set.undecided.is_empty();
    let figures = match set.figures.len() {
        0 if is_all => "there is no figure, proved".to_owned(),
        0 => "it is not decided which figures there are".to_owned(),
        n => format!(
            "there {} {} {}{up_to}, proved",
            either(n, "is", "are"),
            if is_all { "exactly" } else { "at least" },
            counted(n, "figure")
        ),
    };
    format!(
        "{}, {figures}{}",
        for_every_choice(problem, &set.limits),
        set.account.clause_behind()
    )
}

/// All figures as text: of each the bounds of what is measured, and what each dimension has to do with it.
pub fn tolerance_set_to_table(problem: &Problem, set: &Set) -> String {
    let mut out = tolerance_set_in_words(problem, set) + ".";
    if !set.figures.is_empty() {
        out += &both_ways_in_words(&set.both_ways);
    }
    out.push('\n');
    for part in &set.undecided {
        let parts = counted(part.count as usize, "part");
        out += &format!(
            "  undecided: {parts} of the space: {}\n",
            why_within(part.why)
        );
    }
    if !set.undecided.is_empty() {
        out += "Narrower limits may decide more.\n";
    }
    for (number, figure) in (1..).zip(&set.figures) {
        out += &match &figure.study {
            Ok(study) => format!("\nFigure {number}\n{}", measured_to_table(problem, study)),
            Err(why) => format!("\nFigure {number} is not measured: {why}.\n"),
        };
    }
    if set.figures.iter().any(|figure| figure.study.is_ok()) {
        out += &format!("\n{WHAT_IS_PROVED}");
    }
    out
}

/// Why it is not decided what figures there are, for some choices of dimensions.
pub(super) fn why_within(reason: Why) -> &'static str {
    match reason {
        Why::Small => {
            "figures may come together or vanish there for some choices, or the limits are too wide for a proof"
        }
        other => why(other),
    }
}

fn write_measured(
    out: &mut String,
    problem: &Problem,
    study: &Study,
    measured: &Measured,
) -> std::fmt::Result {
    let [low, high] = measured.bounds;
    let digits = certain_digits(measured.nominal);
    if measured.is_given {
        return writeln!(
            out,
            "\n{} is {digits}, a dimension without a tolerance",
            measured.name
        );
    }
    let ends = Bound::of_range(low.inf(), high.sup());
    let gap = measured.gap(&ends);
    writeln!(
        out,
        "\n{} is {digits}; at worst from {} to {}{}; {}",
        measured.name,
        ends[0],
        ends[1],
        match gap {
            // A range without a width is as it is said.
            _ if ends[0] == ends[1] => String::new(),
            gap if gap < 1.0 => format!(
                ", and no wider by more than {:.0} % of that",
                (point(100.0) * point(gap)).sup().ceil().max(1.0)
            ),
            _ => ", which may be much too wide".to_owned(),
        },
        squares_in_words(measured.root_of_squares)
    )?;
    let total: f64 = measured.effects.iter().map(|e| e.abs()).sum();
    let mut rows: Vec<usize> = (0..measured.effects.len()).collect();
    rows.order_by(|&a, &b| {
        measured.effects[b]
            .abs()
            .total_cmp(&measured.effects[a].abs())
    });
    // What does nothing is not listed.
    rows.retain(|&k| measured.effects[k].abs() > 1e-9 * total);
    let names = rows
        .iter()
        .map(|&k| problem.dimension_name(study.limits[k].index));
    let names: Vec<String> = names.collect();
    let width = names
        .iter()
        .map(|name| name.chars().count())
        .max()
        .unwrap_or(0);
    for (name, &k) in names.iter().zip(&rows) {
        let [low, high] = &study.limits[k].values;
        let effect = measured.effects[k];
        writeln!(
            out,
            "  {name:<width$}  from {low} to {high} changes it by {}{}, {:.0} %",
            if effect < 0.0 { "" } else { "+" },
            short(effect),
            100.0 * effect.abs() / total
        )?;
    }
    Ok(())
}

/// The root of the sum of the squares, or why there is none.
pub(super) fn squares_in_words(measured: Option<f64>) -> String {
    match measured {
        Some(root) => format!("root of the sum of the squares ±{}", short(root)),
        None => "nothing to first order, as it is at an end of what it can be as drawn".to_owned(),
    }
}

/// A number of four digits, for what is known to first order.
pub(super) fn short(x: f64) -> String {
    let shown = format!("{x:.3e}").parse().unwrap_or(x);
    f64::to_string(&shown)
}

/// The study as CSV: for each measure its value, its worst cases (outer ends, as floats), the root of the sum of the squares, and by how much
/// it grows, about, as each dimension goes from its least value to its greatest.
pub fn tolerances_to_csv(problem: &Problem, study: &Study) -> String {
    let own = [
        "measure",
        "unit",
        "nominal",
        "least",
        "greatest",
        "root of squares",
    ];
    let names = study
        .limits
        .iter()
        .map(|limits| problem.dimension_name(limits.index));
    let names = own.map(str::to_owned).into_iter().chain(names);
    let mut out = names
        .map(|name| quoted(&name))
        .collect::<Vec<_>>()
        .join(",")
        + "\n";
    for measured in &study.measured {
        let [low, high] = measured.bounds;
        let bounds = [measured.nominal.mid(), low.inf(), high.sup()].map(Some);
        let total: f64 = measured.effects.iter().map(|effect| effect.abs()).sum();
        // Six digits are more than is known to first order.
        let short = |effect: &f64| match effect.abs() > 1e-9 * total {
            true => format!("{effect:.5e}").parse().unwrap_or(*effect),
            false => 0.0,
        };
        // None where there is no first order.
        let effects = (0..study.limits.len()).map(|k| measured.effects.get(k).map(short));
        let numbers = bounds.into_iter().chain([measured.root_of_squares]);
        let numbers = numbers.chain(effects);
        let numbers = numbers.map(|x| x.map_or(String::new(), |x| x.to_string()));
        let cells = [quoted(&measured.name), measured.unit.to_owned()]
            .into_iter()
            .chain(numbers);
        out += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    out
}
