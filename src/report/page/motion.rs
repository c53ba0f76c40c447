//! The page of a motion: the linkage all along its way, and where what is measured is least and greatest.

use super::reader::{Reader, ShowError, digits, list, pair, text, wrong};
use super::swept::{path, sample};
use super::{Figure, Page, Sample, Text, Tone};
use serde_json::Value;

pub(super) fn page(reader: &Reader) -> Result<Page, ShowError> {
    let result = reader.result;
    let mut page = reader.page("In the file", "as it is drawn")?;
    page.rate(match text(result, "status")? {
        "closed" => ("proved · a loop", Tone::Proved),
        "open" => ("proved · between two ends", Tone::Proved),
        _ => ("proved in part", Tone::Stopped),
    });
    page.verdict = reader.words()?;
    let names = list(result, "driver")?.iter().map(|name| {
        let name = name.as_str()?;
        page.points.iter().position(|point| point == name)
    });
    let driver: Vec<usize> = names.collect::<Option<_>>().ok_or(wrong("driver"))?;
    let &[a, b] = &driver[..] else {
        return Err(wrong("driver"));
    };
    let name = format!("{}-{}", page.points[a], page.points[b]);
    let mut samples: Vec<Sample> = Vec::new();
    for frame in list(result, "frames")? {
        let figure = reader.figure(&frame["points"], &Value::Null, "frames")?;
        let square = |k: usize| (figure.points[3 * a + k] - figure.points[3 * b + k]).powi(2);
        let length = (0..3).map(square).sum::<f64>().sqrt();
        samples.push(sample(length, &figure, samples.last()));
    }
    let mut ranges = Vec::new();
    for measured in list(result, "measured")? {
        let name = text(measured, "name")?;
        let mut ends = Vec::new();
        for which in ["least", "greatest"] {
            let end = &measured[which];
            if end.is_null() {
                continue;
            }
            let value = digits(pair(&end["value"]).ok_or(wrong("measured"))?);
            page.figures.push(Figure {
                name: format!("{name} = {value}"),
                note: format!("the {which}"),
                class: Some(1 + usize::from(which == "greatest")),
                ..reader.figure(&end["points"], &Value::Null, "measured")?
            });
            ends.push(value);
        }
        ranges.push(match (&ends[..], measured["turns"].as_i64()) {
            ([least, greatest], _) => format!("{name} from {least} to {greatest}"),
            (_, Some(_)) => format!("{name} through a full turn"),
            _ => format!("{name} is not told"),
        });
    }
    page.text = vec![
        Text::Paragraph("Between which bounds it stays, proved:".into()),
        Text::List(ranges),
    ];
    page.paths.extend(path(&name, samples, Vec::new()));
    Ok(page)
}
