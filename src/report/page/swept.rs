//! The page of a sweep: the mechanism at every value of the dimension that drives it, the frames being the path.

use super::reader::{Reader, digits, middle, nothing};
use super::{Figure, Level, Page, Path, Sample, ShowError, Tone};
use crate::report::document::{Dimension, Sweep, wrong};
use crate::report::edit::behind;

pub(super) fn page(reader: &Reader, sweep: &Sweep) -> Result<Page, ShowError> {
    let mut page = reader.page("In the file", "the figure that the sweep sets out from")?;
    let Dimension::Driven(name) = &reader.drawing.dimension else {
        return Err(wrong("dimension"));
    };
    page.rate(match &sweep.status[..] {
        "reached" => ("proved", Tone::Proved),
        "limit" => ("proved · up to the limit", Tone::Proved),
        _ => ("proved in part", Tone::Stopped),
    });
    page.verdict = reader.words(&sweep.words);
    // The dimension that is driven has no one length.
    let ends = reader.ends_of(name);
    for bar in page.bars.iter_mut().filter(|bar| Some(bar.ends) == ends) {
        bar.target = None;
        bar.label = name.to_owned();
    }
    page.labels = reader.labels(|driven| (driven == name).then(|| name.to_owned()));
    let frames = &sweep.frames;
    let mut samples: Vec<Sample> = Vec::with_capacity(frames.len());
    let mut levels = Vec::new();
    for (k, frame) in frames.iter().enumerate() {
        let value = frame.value;
        let figure = reader.figure(&frame.points, &nothing())?;
        let sample = sample(middle(value), &figure, samples.last());
        if k == 0 || k + 1 == frames.len() {
            let (label, which) = match k {
                0 => (digits(value), "the first frame"),
                _ => (digits(value), "the last frame"),
            };
            page.figures.push(Figure {
                name: format!("{name} = {label}"),
                note: which.into(),
                // Frames are not congruent.
                class: Some(usize::from(k != 0)),
                path: Some(0),
                at: Some(sample.at),
                t: Some(sample.t),
                ..figure
            });
            levels.push(Level { t: sample.t, label });
        }
        samples.push(sample);
    }
    if let Some(end) = sweep.end.as_ref().filter(|_| sweep.status == "limit") {
        page.figures.push(Figure {
            name: "At the limit".into(),
            note: "no further this way".into(),
            class: Some(2),
            ..reader.figure(&end.edit.points, &nothing())?
        });
    }
    page.say(format!(
        "The slider drives {name}. Between two frames too the figure is the one and only continuation{}, without \
         a turn back: what is drawn there is drawn straight from one frame to the next.",
        behind(" ", sweep.account.scope())
    ));
    page.row("frames", frames.len());
    page.paths.extend(path(name, samples, levels));
    Ok(page)
}

/// A frame behind another one, at this value of the parameter.
pub(super) fn sample(t: f64, figure: &Figure, before: Option<&Sample>) -> Sample {
    let way = |last: &Sample| {
        let squares = last.points.iter().zip(&figure.points);
        let squares = squares.map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    };
    Sample {
        at: before.map_or(0.0, |last| last.at + way(last)),
        t,
        points: figure.points.clone(),
        outlines: figure.outlines.clone(),
    }
}

/// The path of frames, along which a dimension changes. `None`: there are too few.
pub(super) fn path(name: &str, samples: Vec<Sample>, levels: Vec<Level>) -> Option<Path> {
    (samples.len() > 1).then(|| Path {
        parameter: name.to_owned(),
        along: "how far the points move".into(),
        legend: format!("How {name} changes as the figure moves."),
        levels,
        samples,
        ..Path::default()
    })
}
