//! t along the path.

use super::curve::{Curve, draw_signs};
use super::style::{Failure, GREY, SCALE, legend, mesh, picture, plain, px, with_room};
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
    let solutions = format!("solutions ({})", path.solutions.len());
    let body = legend(area, &curve.legend(solutions, "sketch"))?;

    let t_of = |z: &[f64]| z[z.len() - 1];
    let all = curve.points().map(|(_, z)| t_of(z)).chain([0.0, 1.0]);
    let length = path.step_ends.last().map_or(1.0, |s| s.at);
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
    curve.draw(&mut chart, |(at, z)| (*at, t_of(z)))?;
    let solutions: Vec<(f64, f64)> = path.solutions.iter().map(|s| (s.at, 1.0)).collect();
    let back = path.step_ends.last().filter(|_| path.closed);
    let sketch = path.step_ends.iter().take(1).chain(back);
    let sketch = sketch.map(|step_end| (step_end.at, t_of(&step_end.z)));
    draw_signs(&chart, &solutions, sketch)
}
