//! Colours, letters, axes, legends.

use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::{CoordTranslate, Shift};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// What is drawn on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
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
    chart: &mut ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>,
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
        .x_labels(10)
        .y_labels(8)
        .x_label_formatter(&|x| format_x(x))
        .y_label_formatter(&|y| format_y(y))
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT.stroke_width(SCALE))
        .axis_style(GREY.stroke_width(SCALE))
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

/// The same on a logarithmic scale.
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

/// Draws entries in rows from the left; each row is 20 high. `origin` is the first one's middle.
pub fn legend<'a>(
    area: &Area<'a>,
    entries: &[Entry],
    origin: (i32, i32),
) -> Result<(), Failure<'a>> {
    let width = area.dim_in_pixel().0 as i32;
    let (mut x, mut y) = (px(origin.0), px(origin.1));
    for entry in entries {
        let needed = px(28) + width_of(&entry.text, 14) + px(16);
        if x + needed > width && x > px(origin.0) {
            (x, y) = (px(origin.0), y + px(20));
        }
        match entry.sign {
            Sign::Line(colour) => {
                let ends = [(x, y), (x + px(22), y)];
                area.draw(&PathElement::new(ends, colour.stroke_width(3 * SCALE)))?;
            }
            sign => draw_sign(area, (x + px(11), y), sign)?,
        }
        let text = Text::new(entry.text.clone(), (x + px(28), y), left(14, INK));
        area.draw(&text)?;
        x += needed;
    }
    Ok(())
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
            area.draw(&Cross::new(
                at.clone(),
                px(6),
                WHITE.stroke_width(5 * SCALE),
            ))?;
            area.draw(&Cross::new(at, px(5), colour.stroke_width(3 * SCALE)))
        }
    }
}
