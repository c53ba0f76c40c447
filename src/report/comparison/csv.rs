//! Comparisons for spreadsheets.

use super::{Compared, faults, status, switched_on, verdict};
use crate::compare::Row;

/// The columns.
const HEADING: [&str; 23] = [
    "problem",
    "mode",
    "space",
    "setting",
    "value",
    "relative",
    "status",
    "verdict",
    "faults",
    "steps",
    "rejected",
    "runs",
    "seconds",
    "ratio",
    "solutions",
    "widest",
    "narrowest",
    "residual",
    "length",
    "switched_on",
    "published_steps",
    "published_seconds",
    "published_solutions",
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
        rows.map(move |row| line(compared, row))
    });
    let heading = HEADING.map(str::to_owned);
    for record in std::iter::once(heading).chain(lines) {
        writer
            .write_record(record)
            .expect("memory can be written to");
    }
    let bytes = writer.into_inner().expect("memory can be written to");
    String::from_utf8(bytes).expect("all of it was text")
}

fn line(compared: &Compared, row: &Row) -> [String; 23] {
    fn text<T: ToString>(x: Option<T>) -> String {
        x.map_or(String::new(), |x| x.to_string())
    }
    let float = |x: Option<f64>| text(x.filter(|x| x.is_finite()).map(|x| format!("{x:e}")));
    let measured = row.measured();
    let outcome = measured.map(|m| &m.outcome);
    let widths = measured.and_then(|m| m.widths());
    let published = compared.beside(row);
    [
        compared.comparison.problem.clone(),
        row.way.method.name().into(),
        row.way.space.name().into(),
        text(row.setting.map(|s| s.knob.name())),
        float(row.setting.map(|s| s.value)),
        float(row.setting.map(|s| s.relative)),
        status(row).0.into(),
        verdict(&row.verdict).into(),
        faults(&row.verdict),
        text(outcome.map(|o| o.steps)),
        text(outcome.map(|o| o.rejected)),
        text(measured.map(|m| m.seconds.len())),
        float(measured.map(|m| m.median)),
        float(measured.and_then(|m| compared.ratio(m))),
        text(outcome.map(|o| o.solutions.len())),
        float(widths.map(|w| w.0)),
        float(widths.map(|w| w.1)),
        float(measured.and_then(|m| m.residual)),
        float(outcome.map(|o| o.length)),
        switched_on(row).join("; "),
        text(published.and_then(|p| p.steps)),
        float(published.and_then(|p| p.seconds)),
        text(published.and_then(|p| p.solutions)),
    ]
}
