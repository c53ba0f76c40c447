//! A comparison for people.

use super::{Compared, earlier, faults, switched_on};
use crate::compare::{Knob, Row, Verdict, Way};
use crate::report::columns::Grid;
use crate::report::document::RowOf;
use crate::track::Status;

/// The comparison as lines of text, at most about 120 wide.
pub fn comparison_to_table(compared: &Compared) -> String {
    let comparison = &compared.comparison;
    let mut out = format!("{}\n", comparison.problem);
    let beside = comparison.rows.iter().any(|r| compared.beside(r).is_some());
    let mut heading = vec![
        "mode",
        "space",
        "steps",
        "rejected",
        "ms",
        "ratio",
        "solutions",
        "status",
        "box widths",
        "residual",
    ];
    if beside {
        heading.push("published: steps, ms, solutions");
    }
    let mut grid = Grid::new(heading, |c| [0, 1, 7].contains(&c));
    let mut remarks = Vec::new();
    for row in &comparison.rows {
        let told = RowOf::new(compared, row);
        let (place, word) = (format!("{}, {}", told.mode, told.space), &told.status);
        let wrong = matches!(row.verdict, Verdict::Wrong(_));
        let widths = widths(&told);
        let mut cells = vec![
            told.mode,
            told.space,
            dash(told.steps),
            dash(told.rejected),
            dash(told.seconds.map(milliseconds)),
            dash(told.ratio.map(|x| format!("{x:.2}"))),
            dash(told.solutions),
            format!("{word}{}", if wrong { ", WRONG" } else { "" }),
            widths,
            dash(told.residual.map(|r| format!("{r:.1e}"))),
        ];
        if let Some(published) = told.published {
            let [steps, solutions] = [published.steps, published.solutions].map(dash);
            let seconds = dash(published.seconds.map(milliseconds));
            cells.push(format!("{steps}, {seconds}, {solutions}"));
        }
        if let Some(Status::Open(ends)) = row.measured().map(|m| &m.outcome.status) {
            let [one, other] = [&ends[0], &ends[1]].map(|end| {
                let t = 0.5 * (end.t.0 + end.t.1);
                format!("t = {t:.6} ({})", end.kind.name())
            });
            remarks.push(format!(
                "{place}: open: the path ends at {one} and at {other}"
            ));
        }
        if let Some(reason) = told.reason {
            remarks.push(format!("{place}: {word}: {reason}"));
        }
        if row.verdict == Verdict::Unjudged
            && row.measured().is_some()
            && comparison.has_reference()
        {
            remarks.push(format!(
                "{place}: {}",
                match closed(row) {
                    true =>
                        "it closed, with all solutions of the arc proved; whether the path closes beyond the ends of that is \
                         not proved",
                    false =>
                        "it lists figures that are not on the arc proved; they may be beyond its ends",
                }
            ));
        }
        if let Verdict::Earlier(beyond) = row.verdict {
            remarks.push(format!("{place}: {}", earlier(beyond)));
        }
        if wrong {
            remarks.push(format!("{place}: WRONG: {}", faults(&row.verdict)));
        }
        for what in told.switched_on {
            remarks.push(format!("{place}: switched on: {what}"));
        }
        grid.push(cells);
    }
    out += &grid.render();
    if comparison.reference_is_arc() {
        remarks.push(
            "The certified run ended open: what the others list is judged by the solutions on the arc that it proved."
                .to_owned(),
        );
    }
    for remark in remarks {
        out += &format!("  {remark}\n");
    }
    for other in compared.others() {
        let seconds = other.seconds.map_or(String::new(), |s| format!(": {s} s"));
        let found = match other.solutions {
            Some(n) => format!(", {n} real solutions up to reflection"),
            None => String::new(),
        };
        out += &format!("  published: {}{seconds}{found}\n", other.method);
    }
    if !comparison.sweep.is_empty() {
        out += &sweep(compared);
    }
    if comparison.interrupted {
        out += "  interrupted: rows may be missing\n";
    }
    out
}

fn sweep(compared: &Compared) -> String {
    let comparison = &compared.comparison;
    let mut out = format!(
        "\n  Settings, in typical lengths of the problem (here {}), against time and correctness\n",
        comparison.typical_length
    );
    if !comparison.has_reference() {
        out += "  No certified run closed or ended open, so that nothing can be said of what is right.\n";
    }
    let heading = [
        "mode",
        "space",
        "setting",
        "value",
        "steps",
        "rejected",
        "ms",
        "solutions",
        "box widths",
        "verdict",
    ];
    let mut grid = Grid::new(heading, |c| [0, 1, 2, 9].contains(&c));
    for row in &comparison.sweep {
        let Some(setting) = row.setting else { continue };
        let told = RowOf::new(compared, row);
        let (word, widths) = (told.status.clone(), widths(&told));
        let verdict = match &row.verdict {
            Verdict::Right => "right".into(),
            Verdict::Wrong(_) => format!("WRONG: {}", faults(&row.verdict)),
            Verdict::Stopped => word,
            Verdict::Earlier(beyond) => format!("{word}: {}", earlier(*beyond)),
            Verdict::Unjudged if comparison.has_reference() && closed(row) => {
                format!("{word}, beyond the arc")
            }
            Verdict::Unjudged if comparison.has_reference() => {
                format!("{word}, with figures that are not on the arc")
            }
            Verdict::Unjudged => word,
        };
        grid.push([
            told.mode,
            told.space,
            setting.knob.name().into(),
            match setting.knob {
                Knob::MaxStep => setting.relative.to_string(),
                _ => format!("{:e}", setting.relative),
            },
            dash(told.steps),
            dash(told.rejected),
            dash(told.seconds.map(milliseconds)),
            dash(told.solutions),
            widths,
            verdict,
        ]);
    }
    out += &grid.render();
    for way in Way::all() {
        let settings = comparison.sweep.iter().filter(|row| row.way == way);
        let switched = settings.clone().filter(|row| !switched_on(row).is_empty());
        let (switched, settings) = (switched.count(), settings.count());
        if switched > 0 {
            out += &format!(
                "  {}, {}: something was switched on at {switched} of {settings} settings; JSON and CSV say what\n",
                way.method.name(),
                way.space.name()
            );
        }
    }
    out
}

fn closed(row: &Row) -> bool {
    row.measured()
        .is_some_and(|measured| measured.outcome.status == Status::Closed)
}

/// The largest and the smallest width of a certified run's boxes.
fn widths(row: &RowOf) -> String {
    match row.widest.zip(row.narrowest) {
        Some((largest, smallest)) if largest > 0.0 => format!("{largest:.1e}, {smallest:.1e}"),
        _ => "-".into(),
    }
}

/// Three digits.
fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    let decimals = (2.0 - ms.abs().max(1e-9).log10().floor()).clamp(0.0, 3.0);
    format!("{ms:.*}", decimals as usize)
}

/// What is known, or a dash.
fn dash(x: Option<impl ToString>) -> String {
    x.map_or("-".into(), |x| x.to_string())
}
