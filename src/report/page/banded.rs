//! The page of `tolerance`: the figure, with the band in which each point stays.

use super::reader::{Reader, digits, middle, nothing};
use super::{Figure, Page, Shape, ShowError, Text, Tone};
use crate::interval::Bound;
use crate::order::InOrder;
use crate::report::document::{Bounds, Tolerance};
use crate::report::tolerance::squares_in_words;

/// The widest band is drawn about so wide, as a part of the figure.
const SEEN: f64 = 0.15;

pub(super) fn page(reader: &Reader, study: &Tolerance) -> Result<Page, ShowError> {
    let mut page = reader.page("In the file", "as it is drawn")?;
    (page.badge, page.tone) = ("proved".into(), Tone::Proved);
    page.verdict = reader.words(&study.words) + ".";
    let figure = reader.figure(&study.figure, &nothing())?;
    let bands = reader.places(&study.bands, "bands")?;
    let widths = bands.iter().copied().flatten();
    let (sizes, widths) = (spans(&figure.points), widths.map(|[low, high]| high - low));
    let (size, widest) = (sizes.fold(0.0, f64::max), widths.fold(0.0, f64::max));
    let times = match widest > 0.0 {
        true => times(SEEN * size / widest),
        false => 1.0,
    };
    let mut outlines = Vec::new();
    for (name, band) in page.points.iter().zip(bands) {
        // A point that stays where it is has no band.
        if band.iter().all(|[low, high]| high - low < 1e-9 * size) {
            continue;
        }
        let side = |sign: f64| -> Vec<f64> {
            let end =
                |&[low, high]: &Bounds| middle([low, high]) + 0.5 * sign * times * (high - low);
            band.iter().map(end).collect()
        };
        for corners in faces(&side(-1.0), &side(1.0)) {
            page.shapes.push(Shape {
                name: format!("band of {name}"),
                kind: "plane".into(),
                ends: None,
            });
            outlines.push(
                corners
                    .into_iter()
                    .flat_map(|at| reader.there(at))
                    .collect::<Vec<f64>>(),
            );
        }
    }
    page.figures[0]
        .outlines
        .extend(outlines.iter().map(|_| Vec::new()));
    page.figures.push(Figure {
        name: "Nominal".into(),
        note: match times {
            1.0 => "with the band in which each point stays".into(),
            n => format!("with the band in which each point stays, {n} times as wide"),
        },
        class: Some(0),
        outlines: figure.outlines.iter().cloned().chain(outlines).collect(),
        ..figure
    });
    let mut due = Vec::new();
    for measured in &study.measured {
        let name = &measured.name;
        let [low, high] = Bound::of_range(measured.least[0], measured.greatest[1]);
        page.rows.push((
            name.to_owned(),
            format!(
                "{}; at worst from {low} to {high}; {}",
                digits(measured.nominal),
                squares_in_words(measured.root_of_squares)
            ),
        ));
        let effects = measured.effects.iter().map(|x| x.abs());
        let names = study.limits.iter().map(|limits| &limits.name);
        let mut effects: Vec<(f64, &String)> = effects.zip(names).collect();
        let all: f64 = effects.iter().map(|(effect, _)| effect).sum();
        effects.order_by(|a, b| b.0.total_cmp(&a.0));
        let most = effects
            .iter()
            .take(3)
            .filter(|(effect, _)| *effect > 0.005 * all);
        let most =
            most.map(|(effect, dimension)| format!("{dimension} {:.0} %", 100.0 * effect / all));
        let most = most.collect::<Vec<_>>().join(", ");
        if !most.is_empty() {
            due.push(format!("{name}: {most}"));
        }
    }
    page.text = vec![
        Text::Paragraph("What it is due to, most first (to first order, in floats):".into()),
        Text::List(due),
    ];
    Ok(page)
}

/// How far apart points are along each axis.
fn spans(points: &[f64]) -> impl Iterator<Item = f64> {
    (0..3).map(|k| {
        let along = points.iter().skip(k).step_by(3);
        let (low, high) = along.fold((f64::MAX, f64::MIN), |(low, high), &x| {
            (low.min(x), high.max(x))
        });
        high - low
    })
}

/// The greatest of 1, 2, 5, 10, 20, ... up to a number; 1 below.
fn times(most: f64) -> f64 {
    let steps = (0..12).flat_map(|k| [1.0, 2.0, 5.0].map(|x| x * 10f64.powi(k)));
    steps.take_while(|x| *x <= most).last().unwrap_or(1.0)
}

/// The sides of a box, by their corners: of a rectangle itself.
fn faces(low: &[f64], high: &[f64]) -> Vec<[[f64; 3]; 4]> {
    let at = |k: usize, side: bool| {
        if side { high.get(k) } else { low.get(k) }
            .copied()
            .unwrap_or(0.0)
    };
    let around = [(false, false), (true, false), (true, true), (false, true)];
    let face = |fixed: usize, side: bool| {
        let (i, j) = ((fixed + 1) % 3, (fixed + 2) % 3);
        around.map(|(u, v)| {
            let mut corner = [0.0; 3];
            (corner[fixed], corner[i], corner[j]) = (at(fixed, side), at(i, u), at(j, v));
            corner
        })
    };
    match low.len() {
        2 => vec![face(2, false)],
        _ => (0..3)
            .flat_map(|fixed| [face(fixed, false), face(fixed, true)])
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_drawn_as_wide_as_can_be_seen() {
        assert_eq!(
            [0.3, 1.0, 4.9, 79.0, 5e4].map(times),
            [1.0, 1.0, 2.0, 50.0, 5e4]
        );
        let [corners] = faces(&[1.0, 2.0], &[3.0, 5.0]).try_into().unwrap();
        assert_eq!(
            corners,
            [
                [1.0, 2.0, 0.0],
                [3.0, 2.0, 0.0],
                [3.0, 5.0, 0.0],
                [1.0, 5.0, 0.0]
            ]
        );
        assert_eq!(faces(&[0.0; 3], &[1.0; 3]).len(), 6);
    }
}
