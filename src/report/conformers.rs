//! The figures of a molecule as a chemist wants to see them.

use super::columns::Grid;
use super::document;
use crate::import::{Conformer, Skeleton};
use crate::order::InOrder;
use crate::problem::Problem;

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
    let heading = ["", "RMSD", "nearest atoms", "apart", "beyond radii"].map(str::to_owned);
    let mut grid = Grid::new(heading.into_iter().chain(about), |column| {
        column == 0 || column == 2
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
    format!(
        "\nConformers, the nearest to the file first\n{}\
         In \u{e5}ngstr\u{f6}m and degrees, from the middles of the boxes: the root of the mean square of how far atoms are from the file's; the\n\
         nearest atoms three bonds apart or more, measured by van der Waals radii (Bondi), how far apart they are, and how far\n\
         beyond the sum of their radii; torsions about bonds.{more}\n",
        grid.render()
    )
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
