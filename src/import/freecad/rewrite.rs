//! The file with a sketch's new numbers.

use super::followed::{sign, variables};
use super::{DOCUMENT, Number, Places, archive, document};
use crate::import::{Figure, Imported, changed};
use crate::order::InOrder;
use crate::problem::Problem;
use std::io::{Cursor, Write};
use std::ops::Range;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// See [`crate::import::rewrite`].
pub fn rewrite(
    imported: &Imported,
    places: &Places,
    bytes: &[u8],
    problem: &Problem,
    figure: &Figure,
) -> Result<Vec<u8>, String> {
    let mut text = document(bytes)?;
    let mut changes: Vec<(Range<usize>, String)> = Vec::new();
    let variables = variables(imported, places, problem);
    for (content, range) in places.computed.set_cells().chain(&variables) {
        // What stands for itself in a text, and not in an attribute.
        let content = content.replace('&', "&amp;").replace('"', "&quot;");
        changes.push((
            range.clone(),
            content.replace('<', "&lt;").replace('\'', "&apos;"),
        ));
    }
    for (range, number, before) in &places.numbers {
        let now = match *number {
            Number::Coordinate(point, axis) => figure.points[point][axis],
            Number::Radius(object) => figure.radii[object],
            Number::Apart(a, b) => {
                let ([ax, ay, _], [bx, by, _]) = (figure.points[a], figure.points[b]);
                (bx - ax).hypot(by - ay)
            }
            Number::Angle(center, point, turned, clockwise) => {
                let ([ax, ay, _], [bx, by, _]) = (figure.points[center], figure.points[point]);
                let angle = (by - ay).atan2(bx - ax);
                let angle = if clockwise {
                    turned - angle
                } else {
                    angle - turned
                };
                // As near as can be to what it was.
                let turn = std::f64::consts::TAU;
                angle + turn * ((before - angle) / turn).round()
            }
        };
        // Numbers are compared as they are written.
        if format!("{now:.16}") != format!("{before:.16}") {
            changes.push((range.clone(), format!("{now:.16}")));
        }
    }
    for changed in changed(imported, problem) {
        let changed = changed?;
        let range = places.values.get(changed.source).cloned();
        let range = range.unwrap_or(0..0);
        let said: f64 = text
            .get(range.clone())
            .and_then(|x| x.parse().ok())
            .unwrap_or(f64::NAN);
        let value = sign(said, changed.before) * changed.value;
        let value = if changed.is_angle {
            value.to_radians()
        } else {
            value
        };
        changes.push((range, format!("{value:.16}")));
    }
    changes.order_by_key(|change| std::cmp::Reverse(change.0.start));
    for (range, value) in changes {
        if text.get(range.clone()).is_none_or(str::is_empty) {
            return Err("a number is missing: this is another file".to_owned());
        }
        text.replace_range(range, &value);
    }
    let failed = |error: zip::result::ZipError| error.to_string();
    let mut from = archive(bytes)?;
    let mut to = ZipWriter::new(Cursor::new(Vec::with_capacity(bytes.len())));
    to.set_raw_comment(from.comment().to_vec().into_boxed_slice())
        .map_err(failed)?;
    for index in 0..from.len() {
        let part = from.by_index_raw(index).map_err(failed)?;
        if part.name().map_err(failed)? != DOCUMENT {
            to.raw_copy_file(part).map_err(failed)?;
            continue;
        }
        let mut options =
            SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        if let Some(time) = part.last_modified() {
            options = options.last_modified_time(time);
        }
        to.start_file(DOCUMENT, options).map_err(failed)?;
        to.write_all(text.as_bytes()).map_err(|e| e.to_string())?;
    }
    Ok(to.finish().map_err(failed)?.into_inner())
}
