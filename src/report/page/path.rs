//! The path of a page, from a document's `samples` and `folds`.

use super::reader::{Reader, ShowError, list, place, wrong};
use super::{Accuracy, Level, Mark, Path, Sample};
use crate::places::Each as _;
use serde_json::Value;

/// The path of homotopy that a document tells of. `None`: it has no samples.
pub(super) fn read(reader: &Reader, document: &Value) -> Result<Option<Path>, ShowError> {
    let Some(given) = document["samples"].as_array() else {
        return Ok(None);
    };
    let mut samples = Vec::with_capacity(given.len());
    let mut within = Vec::with_capacity(given.len());
    for sample in given {
        let at = sample["at"].as_f64().ok_or(wrong("samples"))?;
        let t = sample["t"].as_f64().ok_or(wrong("samples"))?;
        let mut points = Vec::with_capacity(3 * reader.names.len());
        for p in list(sample, "points").map_err(|_| wrong("samples"))? {
            points.extend(reader.there(place(p, reader.dimension, "samples")?));
        }
        if points.len() != 3 * reader.names.len() {
            return Err(wrong("samples"));
        }
        samples.push(Sample {
            at,
            t,
            outlines: reader.seen(&points, &sample["objects"]),
            points,
        });
        within.extend(sample["within"].as_f64());
    }
    if samples.len() < 2 {
        return Ok(None);
    }
    let mut marks = Vec::new();
    for fold in list(document, "folds")? {
        let at = fold["at"].as_f64().ok_or(wrong("folds"))?;
        let t = [0, 1].each(|k| fold["t"][k].as_f64());
        let [Some(low), Some(high)] = t else {
            return Err(wrong("folds"));
        };
        marks.push(Mark {
            at,
            t: 0.5 * (low + high),
        });
    }
    Ok(Some(Path {
        parameter: "t".into(),
        along: "length of the path".into(),
        legend: "The curve is t along the path: 0 at the sketch, 1 where the dimensions are met. \
                 Dots are solutions, coloured by class; diamonds are folds, where the path turns back. \
                 Click or drag in it; the wheel zooms."
            .into(),
        levels: [(0.0, "0"), (1.0, "1")]
            .map(|(t, label)| Level {
                t,
                label: label.into(),
            })
            .into(),
        accuracy: (within.len() == samples.len()).then(|| Accuracy {
            samples: within,
            figures: Vec::new(),
            legend: "How far the path can be from what is drawn, in any coordinate, and the solutions from their digits: \
                     proved bounds, in the lengths of the problem, each line ten thousand times the next."
                .into(),
        }),
        samples,
        marks,
        ..Path::default()
    }))
}

/// Half the width of a figure's widest bounds.
pub(super) fn width(reader: &Reader, points: &Value) -> Option<f64> {
    let points = points.as_object()?.values();
    let bounds = points.filter_map(|p| super::reader::bounds(p, reader.dimension));
    let widths = bounds.flatten().map(|(low, high)| 0.5 * (high - low));
    Some(widths.fold(0.0, f64::max))
}
