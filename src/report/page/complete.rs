//! The page of a complete set (`krawl all`): every figure in the place of the sketch's reference points, or, where the
//! search had others, in the search's own.

use super::reader::Reader;
use super::{Figure, Page, ShowError, Tone};
use crate::blocks::rounded_up;
use crate::report::document::All;

pub(super) fn page(reader: &Reader, all: &All) -> Result<Page, ShowError> {
    let mut page = reader.page("Sketch", "not a solution: drawn for comparison")?;
    for (k, solution) in all.solutions.iter().enumerate() {
        page.figures.push(Figure {
            name: format!("Solution {}", k + 1),
            note: format!("known up to {} of its size", rounded_up(solution.width)),
            class: Some(k),
            ..reader.figure(&solution.points, &solution.objects)?
        });
    }
    page.rate(match &all.status[..] {
        "complete" => ("proved · all there are", Tone::Proved),
        _ => ("proved in part", Tone::Stopped),
    });
    page.verdict = all.verdict.clone();
    page.say(match &all.method[..] {
        "coordinates" => {
            "All figures with these dimensions were searched, on every path and on none: the coordinates of the points, and \
             what else the constraints need, were divided into boxes, and in each box that is not listed here it is proved \
             that there is no solution. Figures that the constraints do not tell apart are listed once."
        }
        "complex" => {
            "All complex solutions were found, as many as the product of the degrees allows: these are the real ones among them, in \
             the ranges of unknowns, where there are any."
        }
        _ => {
            "All figures with these dimensions were searched, wherever the sketch is: the parameters of a \
             construction plan were divided into boxes, and in each box that is not listed here it is proved that \
             there is no solution. Figures that can be moved or mirrored into one another are listed once."
        }
    });
    page.row("driving parameters", all.driving);
    page.row("boxes", all.boxes);
    page.row("seconds", format!("{:.4}", all.seconds));
    Ok(page)
}
