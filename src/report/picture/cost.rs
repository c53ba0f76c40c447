//! What accuracy costs.

use super::style::{
    BLUE, Entry, Failure, GREEN, GREY, INK, ORANGE, PURPLE, SCALE, SKY, Sign, VERMILION, draw_sign,
    legend, mesh, picture, power, px, with_room_log,
};
use crate::compare::{Comparison, Knob, Method, Row, Verdict, Way};
use crate::track::Space;
use plotters::prelude::*;
use std::ops::Range;

/// Time against accuracy, from a sweep: on the left over the radius of tubes and the tolerance of
/// points, on the right over the bound on the step, both axes logarithmic. A curve for each mode and
/// space; settings that gave a wrong answer, judged against the certified run, are crossed. SVG.
pub fn cost_against_accuracy(comparison: &Comparison) -> String {
    let title = format!("{}: what accuracy costs", comparison.problem);
    picture((1080, 560), &title, |area| draw(area, comparison))
}

fn draw<'a>(area: &super::style::Area<'a>, comparison: &Comparison) -> Result<(), Failure<'a>> {
    let ways: Vec<Way> = Way::all()
        .filter(|way| points(comparison, *way, |_| true).next().is_some())
        .collect();
    let mut entries: Vec<Entry> = ways
        .iter()
        .map(|way| Entry {
            sign: Sign::Line(colour(*way)),
            text: format!("{}, {}", way.method.name(), way.space.name()),
        })
        .collect();
    let right = match comparison.has_reference() {
        true => "right (as the certified run)",
        false => "closed or open, but there is no certified run to judge it by",
    };
    for (sign, text) in [
        (Sign::Disc(GREY), right),
        (
            Sign::Cross(INK),
            "wrong: lost solutions, jumped, or closed wrongly",
        ),
        (Sign::Ring(GREY), "stopped, and said so"),
    ] {
        entries.push(Entry {
            sign,
            text: text.into(),
        });
    }
    let body = legend(area, &entries)?;
    let times = comparison.sweep.iter().filter_map(milliseconds);
    let times = with_room_log(times, 0.05);
    let (one, other) = body.split_horizontally(px(550));
    panel(
        &one,
        comparison,
        &ways,
        "tube radius (certified) or tolerance (float), in typical lengths",
        |knob| knob != Knob::MaxStep,
        times.clone(),
    )?;
    panel(
        &other,
        comparison,
        &ways,
        "longest step allowed, in typical lengths",
        |knob| knob == Knob::MaxStep,
        times,
    )
}

fn panel<'a>(
    area: &super::style::Area<'a>,
    comparison: &Comparison,
    ways: &[Way],
    label: &str,
    knobs: impl Fn(Knob) -> bool + Copy,
    times: Range<f64>,
) -> Result<(), Failure<'a>> {
    let values = ways.iter().flat_map(|way| points(comparison, *way, knobs));
    let values = with_room_log(values.map(|(x, _, _)| x), 0.04);
    let mut chart = ChartBuilder::on(area)
        .margin(px(10))
        .x_label_area_size(px(42))
        .y_label_area_size(px(62))
        .build_cartesian_2d(values.log_scale(), times.log_scale())?;
    mesh(&mut chart, (label, &power), ("median time, ms", &power))?;
    for &way in ways {
        let colour = colour(way);
        // Times of runs that gave up, or went astray, do not lie on one curve with those of others.
        let all: Vec<(f64, f64, &Row)> = points(comparison, way, knobs).collect();
        for stretch in all.split(|&(_, _, row)| !is_good(row)) {
            let line = stretch.iter().map(|&(x, y, _)| (x, y));
            chart.draw_series(LineSeries::new(line, colour.stroke_width(2 * SCALE)))?;
        }
    }
    let area = chart.plotting_area();
    for &way in ways {
        for (x, y, row) in points(comparison, way, knobs) {
            let sign = match row.verdict {
                Verdict::Wrong(_) => Sign::Cross(colour(way)),
                _ if is_good(row) => Sign::Disc(colour(way)),
                _ => Sign::Ring(colour(way)),
            };
            draw_sign(area, (x, y), sign)?;
        }
    }
    Ok(())
}

/// Where the settings of a way are: value, milliseconds, row.
fn points(
    comparison: &Comparison,
    way: Way,
    knobs: impl Fn(Knob) -> bool,
) -> impl Iterator<Item = (f64, f64, &Row)> {
    let rows = comparison.sweep.iter().filter(move |row| row.way == way);
    rows.filter_map(move |row| {
        let setting = row.setting.filter(|setting| knobs(setting.knob))?;
        Some((setting.relative, milliseconds(row)?, row))
    })
}

/// Whether a row closed or ended open, and rightly, as far as that is known.
fn is_good(row: &Row) -> bool {
    let whole = row.measured().is_some_and(|m| m.came_to_an_end());
    whole && !matches!(row.verdict, Verdict::Wrong(_))
}

fn milliseconds(row: &Row) -> Option<f64> {
    row.measured().map(|m| 1e3 * m.median.max(1e-9))
}

fn colour(way: Way) -> RGBColor {
    match (way.method, way.space) {
        (Method::Certified, Space::Full) => BLUE,
        (Method::Certified, Space::Reduced) => SKY,
        (Method::Float, Space::Full) => VERMILION,
        (Method::Float, Space::Reduced) => ORANGE,
        (Method::Paper, Space::Full) => GREEN,
        (Method::Paper, Space::Reduced) => PURPLE,
    }
}
