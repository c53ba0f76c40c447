//! The path of a page, from samples and folds.

use super::reader::{Reader, place};
use super::{Accuracy, Level, Mark, Path, Sample, ShowError};
use crate::report::document::{self, Bounds, Fold, Points, wrong};

/// The path of homotopy that a document tells of. `None`: it has no samples.
pub(super) fn read(
    reader: &Reader,
    given: &[document::Sample],
    folds: &[Fold],
) -> Result<Option<Path>, ShowError> {
    let mut samples = Vec::with_capacity(given.len());
    let mut within = Vec::with_capacity(given.len());
    for sample in given {
        let mut points = Vec::with_capacity(3 * reader.drawing.names.len());
        for p in &sample.points {
            let at = place(p, reader.dimension).ok_or_else(|| wrong("samples"))?;
            points.extend(reader.there(at));
        }
        if points.len() != 3 * reader.drawing.names.len() {
            return Err(wrong("samples"));
        }
        samples.push(Sample {
            at: sample.at,
            t: sample.t,
            outlines: reader.seen(&points, &sample.objects),
            points,
        });
        within.extend(sample.within);
    }
    if samples.len() < 2 {
        return Ok(None);
    }
    let marks = folds.iter().map(|fold| Mark {
        at: fold.at,
        t: 0.5 * (fold.t[0] + fold.t[1]),
    });
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
        marks: marks.collect(),
        ..Path::default()
    }))
}

/// Half the width of a figure's widest bounds.
pub(super) fn width(points: &Points<Bounds>) -> Option<f64> {
    let bounds = points.0.iter().flat_map(|(_, place)| place);
    let widths = bounds.map(|[low, high]| 0.5 * (high - low));
    Some(widths.fold(0.0, f64::max))
}
