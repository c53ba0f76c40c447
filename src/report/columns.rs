//! Text in columns: tables, and the coordinates of figures.

use super::certain_digits;
use crate::interval::Interval;
use crate::problem::Problem;

/// What is said below coordinates whose digits are proved.
pub(super) const DIGITS: &str =
    "Every coordinate differs from the exact one by at most 1 in its last digit shown.";

/// Cells in columns.
pub(super) struct Grid<L> {
    rows: Vec<Vec<String>>,
    /// Which columns begin at the left; the others end at the right.
    is_left: L,
}

impl<L: Fn(usize) -> bool> Grid<L> {
    /// With a heading, and no other row yet.
    pub fn new<S: ToString>(heading: impl IntoIterator<Item = S>, is_left: L) -> Self {
        let heading = heading.into_iter().map(|cell| cell.to_string());
        Grid {
            rows: vec![heading.collect()],
            is_left,
        }
    }

    pub fn push(&mut self, row: impl Into<Vec<String>>) {
        self.rows.push(row.into());
    }

    /// The rows as lines of text.
    pub fn render(&self) -> String {
        let columns = self.rows[0].len();
        let width = |c: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(c));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut out = String::new();
        for row in &self.rows {
            let cells = row.iter().zip(&widths).enumerate();
            let cells = cells.map(|(c, (cell, &width))| match (self.is_left)(c) {
                true => format!("{cell:<width$}"),
                false => format!("{cell:>width$}"),
            });
            let line = cells.collect::<Vec<_>>().join("  ");
            out += &format!("  {}\n", line.trim_end());
        }
        out
    }
}

/// Points in columns aligned at the decimal point, each coordinate as `digits` has it.
pub(super) fn write_points(
    out: &mut String,
    problem: &Problem,
    points: &[[Interval; 3]],
    digits: impl Fn(&Interval) -> String,
) {
    let rows: Vec<Vec<String>> = points
        .iter()
        .map(|p| p.iter().take(problem.dimension).map(&digits).collect())
        .collect();
    let before = |text: &str| text.find('.').unwrap_or(text.len());
    let width = |axis: usize, part: &dyn Fn(&str) -> usize| {
        rows.iter().map(|row| part(&row[axis])).max().unwrap_or(0)
    };
    let column = |axis| {
        let left = width(axis, &before);
        (left, width(axis, &|text| text.len() - before(text)))
    };
    let columns: Vec<(usize, usize)> = (0..problem.dimension).map(column).collect();
    let names = problem.points.iter().map(|p| p.name.chars().count());
    let names = names.max().unwrap_or(0);
    for (point, row) in problem.points.iter().zip(&rows) {
        let mut line = format!("  {:<names$}", point.name);
        for (text, &(left, right)) in row.iter().zip(&columns) {
            let at = before(text);
            line += &format!("  {:>left$}{:<right$}", &text[..at], &text[at..]);
        }
        *out += &format!("{}\n", line.trim_end());
    }
}

/// Points with their certain digits, a line each, not aligned: those that are shown, by number.
pub(super) fn write_digits(
    out: &mut String,
    problem: &Problem,
    points: &[[Interval; 3]],
    is_shown: impl Fn(usize) -> bool,
) {
    let all = problem.points.iter().zip(points).enumerate();
    for (_, (point, place)) in all.filter(|(p, _)| is_shown(*p)) {
        *out += &format!("  {}", point.name);
        for x in place.iter().take(problem.dimension) {
            *out += &format!("  {:>18}", certain_digits(*x));
        }
        out.push('\n');
    }
}
