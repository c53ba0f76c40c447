//! t along the path.

use super::curve::Curve;
use super::style::{
    Entry, Failure, GREY, INK, SCALE, Sign, VERMILION, draw_sign, legend, mesh, number_signs,
    picture, plain, px, size_colour, with_room,
};
use crate::compare::RecordedPath;
use plotters::prelude::*;

/// t over the length of the path, the solutions marked where it meets t = 1, and the steps of the
/// certified run coloured by their length. SVG.
pub fn time_along_path(path: &RecordedPath) -> String {
    let end = if path.closed {
        "back to the sketch"
    } else {
        "as far as it was followed"
    };
    let title = format!("{}: t along the path, {end}", path.problem);
    let curve = Curve::new(path);
    picture((960, 440), &title, |area| draw(area, path, &curve))
}

fn draw<'a>(
    area: &super::style::Area<'a>,
    path: &RecordedPath,
    curve: &Curve,
) -> Result<(), Failure<'a>> {
    let mut entries = vec![
        Entry {
            sign: Sign::Ring(VERMILION),
            text: format!("solutions ({})", path.solutions.len()),
        },
        Entry {
            sign: Sign::Disc(INK),
            text: "sketch".into(),
        },
    ];
    entries.extend(curve.legend());
    let body = legend(area, &entries)?;

    let t_of = |z: &[f64]| z[z.len() - 1];
    let all = curve.points().map(|(_, z)| t_of(z)).chain([0.0, 1.0]);
    let length = path.stations.last().map_or(1.0, |s| s.at);
    let mut chart = ChartBuilder::on(&body)
        .margin(px(12))
        .x_label_area_size(px(42))
        .y_label_area_size(px(58))
        .build_cartesian_2d(-0.01 * length..1.01 * length, with_room(all, 0.12))?;
    mesh(
        &mut chart,
        (
            "length of the path (free coordinates and t, in the problem's lengths)",
            &plain,
        ),
        ("t", &plain),
    )?;
    for level in [0.0, 1.0] {
        let line = [(0.0, level), (length, level)];
        chart.draw_series(DashedLineSeries::new(
            line,
            SCALE * 4,
            SCALE * 4,
            GREY.stroke_width(SCALE),
        ))?;
    }
    for piece in &curve.pieces {
        let line = piece.points.iter().map(|(at, z)| (*at, t_of(z)));
        chart.draw_series(LineSeries::new(
            line,
            size_colour(piece.class).stroke_width(curve.width()),
        ))?;
    }
    let area = chart.plotting_area();
    for solution in &path.solutions {
        draw_sign(area, (solution.at, 1.0), Sign::Ring(VERMILION))?;
    }
    for station in path
        .stations
        .iter()
        .take(1)
        .chain(path.stations.last().filter(|_| path.closed))
    {
        draw_sign(area, (station.at, t_of(&station.z)), Sign::Disc(INK))?;
    }
    // More would be a black cloud.
    if path.solutions.len() <= 60 {
        let places: Vec<(f64, f64)> = path.solutions.iter().map(|s| (s.at, 1.0)).collect();
        number_signs(&chart, &places)?;
    }
    Ok(())
}
