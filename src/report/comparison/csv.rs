//! Comparisons for spreadsheets.

use super::{Compared, faults};
use crate::compare::Row;
use crate::report::document::RowOf;

/// A column: its name, and what stands in it for a row of a comparison.
type Column = (&'static str, fn(&Compared, &Row, &RowOf) -> String);

/// The columns.
const COLUMNS: [Column; 23] = [
    ("problem", |of, _, _| of.comparison.problem.clone()),
    ("mode", |_, _, row| row.mode.clone()),
    ("space", |_, _, row| row.space.clone()),
    ("setting", |_, _, row| text(row.setting.as_deref())),
    ("value", |_, _, row| float(row.value)),
    ("relative", |_, _, row| float(row.relative)),
    ("status", |_, _, row| row.status.clone()),
    ("verdict", |_, _, row| row.verdict.clone()),
    ("faults", |_, row, _| faults(&row.verdict)),
    ("steps", |_, _, row| text(row.steps)),
    ("rejected", |_, _, row| text(row.rejected)),
    ("runs", |_, row, _| {
        text(row.measured().map(|m| m.seconds.len()))
    }),
    ("seconds", |_, _, row| float(row.seconds)),
    ("ratio", |_, _, row| float(row.ratio)),
    ("solutions", |_, _, row| text(row.solutions)),
    ("widest", |_, _, row| float(row.widest)),
    ("narrowest", |_, _, row| float(row.narrowest)),
    ("residual", |_, _, row| float(row.residual)),
    ("length", |_, _, row| float(row.length)),
    ("switched_on", |_, _, row| row.switched_on.join("; ")),
    ("published_steps", |of, row, _| {
        text(of.beside(row).and_then(|p| p.steps))
    }),
    ("published_seconds", |of, row, _| {
        float(of.beside(row).and_then(|p| p.seconds))
    }),
    ("published_solutions", |of, row, _| {
        text(of.beside(row).and_then(|p| p.solutions))
    }),
];

/// One line per row of each comparison, those of the sweeps after the others, below a heading. The
/// columns are those of [`super::comparisons_to_json`]; `runs` is their number, and what was switched on
/// is divided by semicolons. What is not known
/// is left empty.
pub fn comparisons_to_csv(compared: &[Compared]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let lines = compared.iter().flat_map(|compared| {
        let comparison = &compared.comparison;
        let rows = comparison.rows.iter().chain(&comparison.sweep);
        rows.map(move |row| {
            let entry = RowOf::new(compared, row);
            COLUMNS.map(|(_, cell)| cell(compared, row, &entry))
        })
    });
    let heading = COLUMNS.map(|(name, _)| name.to_owned());
    for record in std::iter::once(heading).chain(lines) {
        writer
            .write_record(record)
            .expect("memory can be written to");
    }
    let bytes = writer.into_inner().expect("memory can be written to");
    String::from_utf8(bytes).expect("all of it was text")
}

fn text<T: ToString>(x: Option<T>) -> String {
    x.map_or(String::new(), |x| x.to_string())
}

fn float(x: Option<f64>) -> String {
    text(x.filter(|x| x.is_finite()).map(|x| format!("{x:e}")))
}
