//! The figures of a molecule as a chemist wants to see them.

use super::columns::Grid;
use super::document;
use crate::import::{Conformer, Letter, Skeleton};
use crate::order::InOrder;
use crate::problem::Problem;
use std::collections::BTreeMap;

/// So many torsions are columns of the table.
const COLUMNS: usize = 12;

/// A table of the figures, the one nearest to the file's first; empty where there are none.
pub fn conformers_to_table(problem: &Problem, of: &Skeleton, all: &[Conformer]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let name = |a: usize| problem.points[a].name.as_str();
    let torsions = of.torsions();
    let about = torsions.iter().take(COLUMNS);
    let about = about.map(|[_, b, c, _]| format!("{}-{}", name(*b), name(*c)));
    let mut letters = all.iter().flat_map(|one| &one.letters);
    let has_letters = letters.any(|(_, letter)| letter.is_ok());
    let heading = ["", "RMSD", "nearest atoms", "apart", "beyond radii"];
    let heading = heading.into_iter().chain(has_letters.then_some("R, S"));
    let mut grid = Grid::new(heading.map(str::to_owned).chain(about), |column| {
        [0, 2].contains(&column) || has_letters && column == 5
    });
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.order_by(|&a, &b| all[a].rmsd.total_cmp(&all[b].rmsd));
    for k in order {
        let one = &all[k];
        let mark = if one.is_mirrored { ", mirrored" } else { "" };
        let mut row = vec![
            format!("solution {}{mark}", k + 1),
            format!("{:.3}", one.rmsd),
        ];
        row.extend(match one.contact {
            Some(([a, b], far, beyond)) => [
                format!("{}, {}", name(a), name(b)),
                format!("{far:.2}"),
                format!("{beyond:+.2}"),
            ],
            None => ["", "", ""].map(str::to_owned),
        });
        if has_letters {
            let told = one
                .letters
                .iter()
                .filter_map(|(a, letter)| Some((a, letter.ok()?)));
            let told: Vec<String> = told
                .map(|(a, letter)| format!("{} {letter}", name(*a)))
                .collect();
            row.push(told.join(", "));
        }
        let torsions = one.torsions.iter().take(COLUMNS);
        // Without a sign of zero.
        row.extend(torsions.map(|degrees| format!("{:.1}", (10.0 * degrees).round() / 10.0 + 0.0)));
        grid.push(row);
    }
    let more = match torsions.len() > COLUMNS {
        true => format!(
            " The first {COLUMNS} of {} torsions are shown; --json has all.",
            torsions.len()
        ),
        false => String::new(),
    };
    let rules = match has_letters {
        true => {
            "; R and S by rules 1a, 1b and 2 of Cahn,\nIngold and Prelog, each figure's own, proved"
        }
        false => "",
    };
    let letters = all.iter().flat_map(|one| &one.letters);
    let more = more + &without_letters(problem, letters);
    format!(
        "\nConformers, the nearest to the file first\n{}\
         In \u{e5}ngstr\u{f6}m and degrees, from the middles of the boxes: the root of the mean square of how far atoms are from the file's; the\n\
         nearest atoms three bonds apart or more, measured by van der Waals radii (Bondi), how far apart they are, and how far\n\
         beyond the sum of their radii; torsions about bonds{rules}.{more}\n",
        grid.render()
    )
}

/// Which stereocentres have no letter, and why, as a line of text with a line break before it; empty where all have one.
fn without_letters<'a>(
    problem: &Problem,
    letters: impl Iterator<Item = &'a (usize, Letter)>,
) -> String {
    let mut why: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (a, letter) in letters {
        let (name, Err(reason)) = (problem.points[*a].name.as_str(), letter) else {
            continue;
        };
        let names = why.entry(reason).or_default();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let each = why
        .iter()
        .map(|(reason, names)| format!("{}, as {reason}", names.join(", ")));
    match why.is_empty() {
        true => String::new(),
        false => format!(
            "\nNeither R nor S is said of {}.",
            each.collect::<Vec<_>>().join("; ")
        ),
    }
}

/// The same for JSON, in the order of the solutions, with the atoms of each torsion.
pub fn conformers_told(
    problem: &Problem,
    of: &Skeleton,
    all: &[Conformer],
) -> Vec<document::Conformer> {
    let torsions = of.torsions();
    let told = |one| document::Conformer::new(problem, &torsions, one);
    all.iter().map(told).collect()
}
