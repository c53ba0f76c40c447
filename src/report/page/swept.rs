//! The page of a sweep: the mechanism at every value of the dimension that drives it.

use super::{Figure, Level, Page, Path, Sample, Text, Tone};
use crate::edit::{Ending, Sweep};
use crate::interval::Interval;
use crate::problem::Problem;
use crate::report::{certain_digits, sweep_in_words};

impl Page {
    /// The page of a sweep, with the frames as its path: each is proved to be the one and only continuation of
    /// the one before.
    pub fn of_sweep(problem: &Problem, index: usize, sweep: &Sweep) -> Page {
        let mut page = Page::of_sketch(problem);
        let name = problem.dimension_name(index);
        page.figures[0].name = "In the file".into();
        page.figures[0].note = "the figure that the sweep sets out from".into();
        let end = match &sweep.approach.ending {
            Ending::Reached => sweep.end.as_ref(),
            _ => Some(&sweep.approach),
        };
        (page.badge, page.tone) = match end.map(|edited| &edited.ending) {
            None => ("proved".into(), Tone::Proved),
            Some(Ending::Limit(_)) => ("proved · up to the limit".into(), Tone::Proved),
            Some(_) => ("proved in part".into(), Tone::Stopped),
        };
        page.verdict = sweep_in_words(problem, index, sweep)
            .trim_start_matches(&format!("{}: ", problem.name))
            .to_owned();
        // The dimension that is driven has no one length.
        let ends = problem.distances.get(index).map(|distance| distance.points);
        for bar in page.bars.iter_mut().filter(|bar| Some(bar.ends) == ends) {
            bar.target = None;
            bar.label = name.clone();
        }

        let samples = samples(sweep);
        let figures = sweep.frames.iter().zip(&samples).enumerate();
        for (k, (frame, sample)) in figures {
            if k != 0 && k + 1 != sweep.frames.len() {
                continue;
            }
            page.figures.push(Figure {
                name: format!("{name} = {}", certain_digits(frame.value)),
                note: if k == 0 {
                    "the first frame"
                } else {
                    "the last frame"
                }
                .into(),
                kind: "solution",
                // Frames are not congruent.
                class: Some(usize::from(k != 0)),
                at: Some(sample.at),
                t: Some(sample.t),
                folds: None,
                points: sample.points.clone(),
                outlines: Vec::new(),
                digits: Some(super::figures::digits(problem, &frame.points)),
            });
        }
        if let Some(edited) = end.filter(|edited| matches!(edited.ending, Ending::Limit(_))) {
            page.figures.push(Figure {
                name: "At the limit".into(),
                note: "no further this way".into(),
                kind: "solution",
                class: Some(2),
                at: None,
                t: None,
                folds: None,
                points: flat(&edited.points),
                outlines: Vec::new(),
                digits: Some(super::figures::digits(problem, &edited.points)),
            });
        }
        page.text = vec![Text::Paragraph(format!(
            "The slider drives {name}. Between two frames too the figure is the one and only continuation, without \
             a turn back: what is drawn there is drawn straight from one frame to the next."
        ))];
        page.rows = vec![("frames".into(), sweep.frames.len().to_string())];
        page.digits = "In the coordinates of the file. Every coordinate differs from the exact one by at most 1 \
                       in its last digit shown."
            .into();
        let level = |k: usize| {
            let sample = samples.get(k)?;
            Some(Level {
                t: sample.t,
                label: certain_digits(sweep.frames[k].value),
            })
        };
        let levels = [level(0), level(samples.len().saturating_sub(1))];
        page.path = (samples.len() > 1).then(|| Path {
            parameter: name.clone(),
            along: "how far the points move".into(),
            legend: format!("How {name} changes as the figure moves."),
            levels: levels.into_iter().flatten().collect(),
            samples,
            marks: Vec::new(),
            accuracy: None,
        });
        page
    }
}

fn flat(points: &[[Interval; 3]]) -> Vec<f64> {
    points.iter().flatten().map(|x| x.mid()).collect()
}

/// The frames, and how far all points together have moved up to each.
fn samples(sweep: &Sweep) -> Vec<Sample> {
    let mut out: Vec<Sample> = Vec::with_capacity(sweep.frames.len());
    for frame in &sweep.frames {
        let points = flat(&frame.points);
        let at = out.last().map_or(0.0, |last| {
            let squares = points
                .iter()
                .zip(&last.points)
                .map(|(a, b)| (a - b).powi(2));
            last.at + squares.sum::<f64>().sqrt()
        });
        out.push(Sample {
            at,
            t: frame.value.mid(),
            points,
            outlines: Vec::new(),
        });
    }
    out
}
