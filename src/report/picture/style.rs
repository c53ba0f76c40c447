//! Colours, letters, axes, legends.

use crate::places::Each as _;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::{CoordTranslate, Shift};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// What is drawn on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A picture's axes, and what is between them.
pub type Chart<'a, X, Y> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>;
/// What drawing may fail with; into a string it does not.
pub type Failure<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

/// The palette of Okabe and Ito (Color Universal Design, 2008), without its yellow, which is too
/// light for white paper.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
pub const SKY: RGBColor = RGBColor(86, 180, 233);
pub const GREEN: RGBColor = RGBColor(0, 158, 115);
pub const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub const PURPLE: RGBColor = RGBColor(204, 121, 167);

/// Letters and lines that are not data.
pub const INK: RGBColor = RGBColor(40, 40, 40);
const FAINT: RGBColor = RGBColor(228, 228, 228);
pub const GREY: RGBColor = RGBColor(120, 120, 120);

/// From small to large: viridis, from its dark end to its light green, which still shows on white.
const SIZES: [RGBColor; 6] = [
    RGBColor(68, 1, 84),
    RGBColor(64, 67, 135),
    RGBColor(41, 120, 142),
    RGBColor(34, 157, 136),
    RGBColor(83, 197, 104),
    RGBColor(162, 218, 55),
];
/// How many colours there are for sizes.
pub const CLASSES: usize = SIZES.len();

/// The colour of a class of sizes.
pub fn size_colour(class: usize) -> RGBColor {
    SIZES[class.min(CLASSES - 1)]
}

/// plotters rounds coordinates to whole pixels: with this many for one of ours, lines are smooth.
pub const SCALE: u32 = 3;

/// Our pixels in those of the picture.
pub const fn px(x: i32) -> i32 {
    x * SCALE as i32
}

/// Letters of that size in our pixels; plotters makes them smaller by 1.24.
pub fn letters(size: u32, colour: RGBColor) -> TextStyle<'static> {
    ("sans-serif", f64::from(SCALE * size) * 1.24)
        .into_font()
        .color(&colour)
}

/// Anchored at the left, at half its height.
pub fn left(size: u32, colour: RGBColor) -> TextStyle<'static> {
    letters(size, colour).pos(Pos::new(HPos::Left, VPos::Center))
}

/// About how wide a text comes out, in pixels.
pub fn width_of(text: &str, size: u32) -> i32 {
    px((text.chars().count() as f64 * 0.52 * f64::from(size)).ceil() as i32)
}

/// A picture of that many pixels with a title; the closure draws below it.
pub fn picture(
    size: (u32, u32),
    title: &str,
    draw: impl for<'a> FnOnce(&Area<'a>) -> Result<(), Failure<'a>>,
) -> String {
    let mut svg = String::new();
    {
        let root =
            SVGBackend::with_string(&mut svg, (SCALE * size.0, SCALE * size.1)).into_drawing_area();
        let all = root.fill(&WHITE).and_then(|()| {
            let (head, body) = root.split_vertically(px(34));
            head.draw(&Text::new(
                title.to_owned(),
                (px(16), px(20)),
                left(18, INK),
            ))?;
            draw(&body)?;
            root.present()
        });
        all.expect("a string can be drawn into");
    }
    svg
}

/// Draws lines, ticks and labels of a chart's axes.
pub fn mesh<'a, X, Y>(
    chart: &mut Chart<'a, X, Y>,
    (x, format_x): (&str, &dyn Fn(&f64) -> String),
    (y, format_y): (&str, &dyn Fn(&f64) -> String),
) -> Result<(), Failure<'a>>
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    chart
        .configure_mesh()
        .x_desc(x)
        .y_desc(y)
        .axis_desc_style(letters(15, INK))
        .label_style(letters(14, INK))
        .x_labels(9)
        .y_labels(8)
        .x_label_formatter(&|x| format_x(x))
        .y_label_formatter(&|y| format_y(y))
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT.stroke_width(SCALE))
        .axis_style(GREY.stroke_width(SCALE))
        .set_all_tick_mark_size(px(5))
        .draw()
}

/// A linear axis' label: no more digits than are needed.
pub fn plain(x: &f64) -> String {
    let text = format!("{x:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// A logarithmic axis' label.
pub fn power(x: &f64) -> String {
    if (0.000_9..100_000.0).contains(x) {
        plain(x)
    } else {
        format!("{x:.0e}")
    }
}

/// A range with some room at both ends, in proportion to its width. Without values, 0 to 1.
pub fn with_room(values: impl Iterator<Item = f64>, room: f64) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    if low > high {
        return 0.0..1.0;
    }
    let width = (high - low).max(1e-9 * high.abs()).max(1e-300);
    low - room * width..high + room * width
}

/// A range as [`with_room`] has it, on a logarithmic scale.
pub fn with_room_log(values: impl Iterator<Item = f64>, room: f64) -> Range<f64> {
    let exponents = with_room(values.map(f64::log10), room);
    10f64.powf(exponents.start)..10f64.powf(exponents.end)
}

/// An entry of a legend: how its sign is drawn, and what it says.
pub struct Entry {
    pub sign: Sign,
    pub text: String,
}

/// Signs for data.
#[derive(Clone, Copy)]
pub enum Sign {
    Line(RGBColor),
    Disc(RGBColor),
    Ring(RGBColor),
    Cross(RGBColor),
}

/// Draws entries in rows from the left, each 20 high, and returns the area below.
pub fn legend<'a>(all: &Area<'a>, entries: &[Entry]) -> Result<Area<'a>, Failure<'a>> {
    let width = all.dim_in_pixel().0 as i32;
    let needed = |entry: &Entry| px(28) + width_of(&entry.text, 14) + px(14);
    let (mut x, mut y) = (px(18), px(10));
    let mut places = Vec::new();
    for entry in entries {
        if x + needed(entry) > width && x > px(18) {
            (x, y) = (px(18), y + px(20));
        }
        places.push((x, y));
        x += needed(entry);
    }
    let (area, below) = all.split_vertically(y + px(14));
    for (entry, &(x, y)) in entries.iter().zip(&places) {
        match entry.sign {
            Sign::Line(colour) => {
                let ends = [(x, y), (x + px(22), y)];
                area.draw(&PathElement::new(ends, colour.stroke_width(3 * SCALE)))?;
            }
            sign => draw_sign(&area, (x + px(11), y), sign)?,
        }
        let text = Text::new(entry.text.clone(), (x + px(28), y), left(14, INK));
        area.draw(&text)?;
    }
    Ok(below)
}

/// Draws a sign at a place.
pub fn draw_sign<'a, C>(
    area: &DrawingArea<SVGBackend<'a>, C>,
    at: C::From,
    sign: Sign,
) -> Result<(), Failure<'a>>
where
    C: CoordTranslate,
    C::From: Clone + 'static,
{
    match sign {
        Sign::Disc(colour) | Sign::Line(colour) => {
            area.draw(&Circle::new(at, px(4), colour.filled()))
        }
        Sign::Ring(colour) => {
            area.draw(&Circle::new(at.clone(), px(4), WHITE.filled()))?;
            area.draw(&Circle::new(at, px(4), colour.stroke_width(2 * SCALE)))
        }
        Sign::Cross(colour) => {
            area.draw(&Cross::new(at.clone(), px(6), INK.stroke_width(5 * SCALE)))?;
            area.draw(&Cross::new(at, px(5), colour.stroke_width(2 * SCALE)))
        }
    }
}

/// Where numbers stand beside their signs, as offsets in pixels: the first of eight places that no
/// sign and no other number takes, or nowhere.
pub fn places_for_numbers(signs: &[(i32, i32)]) -> Vec<Option<(i32, i32)>> {
    const DIRECTIONS: [(f64, f64); 8] = [
        (-0.8, -0.8),
        (0.8, -0.8),
        (0.8, 0.8),
        (-0.8, 0.8),
        (0.0, -1.0),
        (0.0, 1.0),
        (1.1, 0.0),
        (-1.1, 0.0),
    ];
    let mut taken: Vec<(i32, i32)> = Vec::new();
    let free = |at: (i32, i32), others: &[(i32, i32)], room: (i32, i32)| {
        let hits =
            |other: &(i32, i32)| (at.0 - other.0).abs() < room.0 && (at.1 - other.1).abs() < room.1;
        !others.iter().any(hits)
    };
    signs
        .iter()
        .map(|&(x, y)| {
            let offsets = DIRECTIONS.each(|(dx, dy)| {
                let reach = f64::from(px(14));
                ((dx * reach) as i32, (dy * reach) as i32)
            });
            let offset = offsets.into_iter().find(|&(dx, dy)| {
                let at = (x + dx, y + dy);
                free(at, signs, (px(11), px(10))) && free(at, &taken, (px(17), px(12)))
            })?;
            taken.push((x + offset.0, y + offset.1));
            Some(offset)
        })
        .collect()
}

/// Numbers beside signs at the given places, 1 and up, where there is room.
pub fn number_signs<'a, X, Y>(
    chart: &Chart<'a, X, Y>,
    signs: &[(f64, f64)],
) -> Result<(), Failure<'a>>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    let pixels: Vec<(i32, i32)> = signs.iter().map(|at| chart.backend_coord(at)).collect();
    let style = letters(13, BLUE).pos(Pos::new(HPos::Center, VPos::Center));
    for (k, (&at, offset)) in signs.iter().zip(places_for_numbers(&pixels)).enumerate() {
        if let Some(offset) = offset {
            let number = Text::new(format!("{}", k + 1), offset, style.clone());
            chart
                .plotting_area()
                .draw(&(EmptyElement::at(at) + number))?;
        }
    }
    Ok(())
}
