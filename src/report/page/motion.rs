//! The page of a motion: the linkage all along its way, and where what is measured is least and greatest.

use super::reader::{Reader, digits, nothing};
use super::swept::{path, sample};
use super::{Figure, Page, Sample, ShowError, Text, Tone};
use crate::report::document::{Motion, wrong};

pub(super) fn page(reader: &Reader, motion: &Motion) -> Result<Page, ShowError> {
    let mut page = reader.page("In the file", "as it is drawn")?;
    page.rate(match &motion.status[..] {
        "closed" => ("proved · a loop", Tone::Proved),
        "open" => ("proved · between two ends", Tone::Proved),
        _ => ("proved in part", Tone::Stopped),
    });
    page.verdict = reader.words(&motion.words);
    let Some(&[a, b]) = reader.numbers(&motion.driver).as_deref() else {
        return Err(wrong("driver"));
    };
    let name = format!("{}-{}", page.points[a], page.points[b]);
    let mut samples: Vec<Sample> = Vec::new();
    for frame in &motion.frames {
        let figure = reader.figure(&frame.points, &nothing())?;
        let square = |k: usize| (figure.points[3 * a + k] - figure.points[3 * b + k]).powi(2);
        let length = (0..3).map(square).sum::<f64>().sqrt();
        samples.push(sample(length, &figure, samples.last()));
    }
    let so_far = match motion.status == "closed" {
        true => "",
        false => ", as far as it was followed",
    };
    let mut ranges = Vec::new();
    for measured in &motion.measured {
        let name = &measured.name;
        let mut ends = Vec::new();
        let both = [("least", &measured.least), ("greatest", &measured.greatest)];
        for (which, end) in both {
            let Some(end) = end else { continue };
            let value = digits(end.value);
            page.figures.push(Figure {
                name: format!("{name} = {value}"),
                note: format!("the {which}{so_far}"),
                class: Some(1 + usize::from(which == "greatest")),
                ..reader.figure(&end.points, &nothing())?
            });
            ends.push(value);
        }
        ranges.push(match (&ends[..], measured.turns) {
            ([least, greatest], _) => format!("{name} from {least} to {greatest}"),
            (_, Some(_)) => format!("{name} through a full turn"),
            _ => format!("{name} is not told"),
        });
    }
    if !ranges.is_empty() {
        page.say(format!("Between which bounds it stays{so_far}, proved:"));
        page.text.push(Text::List(ranges));
    }
    page.paths.extend(path(&name, samples, Vec::new()));
    Ok(page)
}
