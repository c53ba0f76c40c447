//! What pages of results with figures have in common.

use super::{Bar, Figure, Label, Page, Shape, outlines};
use crate::interval::hull;
use crate::interval::vector::{cross, minus};
use crate::places::array;
use crate::report::certain_digits;
use crate::report::columns::DIGITS;
use crate::report::document::{
    At, Bounds, Choice, Dimension, Drawing, Named, Object, Objects, Points, ShowError, wrong,
};
use crate::report::figures::chosen_in_words;
use std::collections::BTreeMap;

pub(super) fn middle([low, high]: Bounds) -> f64 {
    low + 0.5 * (high - low)
}

/// Whether there is a number between these.
pub(super) fn are_bounds([low, high]: &Bounds) -> bool {
    low <= high && (high - low).is_finite()
}

/// The digits of which bounds leave no doubt.
pub(super) fn digits([low, high]: Bounds) -> String {
    match are_bounds(&[low, high]) {
        true => certain_digits(hull(low, high)),
        false => "?".to_owned(),
    }
}

/// A number, or the middle of bounds.
pub(super) trait Number: Copy {
    fn middle(self) -> f64;
}

impl Number for f64 {
    fn middle(self) -> f64 {
        self
    }
}

impl Number for Bounds {
    fn middle(self) -> f64 {
        middle(self)
    }
}

/// The coordinates of a place, in the first ones of three; none where they are of another dimension.
pub(super) fn place<C: Number>(given: &[C], dimension: usize) -> Option<[f64; 3]> {
    let mut out = [0.0; 3];
    for (out, x) in out.iter_mut().zip(given) {
        *out = x.middle();
    }
    let is_place = given.len() == dimension && out.iter().all(|x| x.is_finite());
    is_place.then_some(out)
}

/// No objects but those that their points tell.
pub(super) fn nothing() -> Objects<f64> {
    Named::default()
}

/// Circles with their radii, as objects of a result have them.
pub(super) fn circles<C: Copy>(radii: &Named<C>) -> Objects<C> {
    let radii = radii.0.iter();
    let circle = |radius: C| At::Round {
        center: Vec::new(),
        radius,
    };
    Named(
        radii
            .map(|(name, radius)| (name.clone(), circle(*radius)))
            .collect(),
    )
}

/// `block 1 solution 1, block 2 solution 3 mirrored`.
pub(super) fn choices(choices: &[Choice]) -> String {
    let each = choices.iter();
    chosen_in_words(each.map(|c| (c.block, c.solution, c.mirrored == Some(true))))
}

/// A decimal as it is written on a bar: not longer than a few digits.
pub(super) fn shown(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(x) if value.len() > 8 => format!("{}", (x * 1e4).round() / 1e4),
        _ => value.to_owned(),
    }
}

/// What a result says of its problem, and the coordinates in which its figures are seen from those of the sketch.
pub(super) struct Reader<'a> {
    pub drawing: &'a Drawing,
    pub dimension: usize,
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl<'a> Reader<'a> {
    pub fn new(drawing: &'a Drawing) -> Result<Self, ShowError> {
        let dimension = match (&drawing.dimension, drawing.sketch.0.first()) {
            (Dimension::Space(dimension), _) => *dimension,
            // Of a sweep it is the name of what is driven.
            (Dimension::Driven(_), Some((_, place))) => place.len(),
            (Dimension::Driven(_), None) => 0,
        };
        if !matches!(dimension, 2 | 3) {
            return Err(wrong("dimension"));
        }
        let mut origin = [0.0; 3];
        let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if let Some(frame) = &drawing.frame {
            let place = |given: &[f64]| place(given, dimension).ok_or_else(|| wrong("frame"));
            origin = place(&frame.origin)?;
            for (own, given) in axes.iter_mut().zip(&frame.axes) {
                *own = place(given)?;
            }
        }
        Ok(Reader {
            drawing,
            dimension,
            origin,
            axes,
        })
    }

    /// A page with the sketch, under a name and with a note, and what holds it together. Digits are taken to be proved.
    pub fn page(&self, name: &str, note: &str) -> Result<Page, ShowError> {
        Ok(Page {
            title: self.drawing.problem.clone(),
            dimension: self.dimension,
            points: self.drawing.names.clone(),
            bars: self.bars()?,
            labels: self.labels(|_| None),
            shapes: self.shapes(),
            figures: vec![Figure {
                name: name.into(),
                note: note.into(),
                ..self.sketch()?
            }],
            digits: format!("{} {DIGITS}", self.gauge()),
            ..Page::default()
        })
    }

    /// In the coordinates of the sketch.
    pub fn there(&self, p: [f64; 3]) -> [f64; 3] {
        array(|k| self.origin[k] + (0..3).map(|axis| self.axes[axis][k] * p[axis]).sum::<f64>())
    }

    /// A direction in the coordinates of the sketch.
    fn turned(&self, v: [f64; 3]) -> [f64; 3] {
        array(|k| (0..3).map(|axis| self.axes[axis][k] * v[axis]).sum())
    }

    /// The words of a result without the name of its problem before them.
    pub fn words(&self, words: &str) -> String {
        let name = format!("{}: ", self.drawing.problem);
        words.trim_start_matches(&name).to_owned()
    }

    /// A figure with bounds of its coordinates, seen as results are, as a solution without a name yet.
    pub fn figure<C: Number>(
        &self,
        points: &Points<Bounds>,
        objects: &Objects<C>,
    ) -> Result<Figure, ShowError> {
        let (mut places, mut read) = (Vec::new(), Vec::new());
        for bounds in self.places(points, "points")? {
            let at = place(bounds, self.dimension).filter(|_| bounds.iter().all(are_bounds));
            places.extend(self.there(at.ok_or_else(|| wrong("points"))?));
            read.push(bounds.iter().copied().map(digits).collect());
        }
        Ok(Figure {
            kind: "solution",
            outlines: self.seen(&places, objects),
            points: places,
            digits: Some(read),
            ..Figure::default()
        })
    }

    /// The places of all points, by number; `key`: under which they stand.
    pub fn places<'p, C>(
        &self,
        points: &'p Points<C>,
        key: &str,
    ) -> Result<Vec<&'p [C]>, ShowError> {
        let known: BTreeMap<&str, &'p Vec<C>> =
            points.0.iter().map(|(name, at)| (&name[..], at)).collect();
        let places = self.drawing.names.iter().map(|name| {
            let place = known.get(&name[..]).map(|place| &place[..]);
            let place = place.filter(|place| place.len() == self.dimension);
            place.ok_or_else(|| ShowError::NotAResult(key.to_owned(), format!(" (`{name}`)")))
        });
        places.collect()
    }

    /// The outlines of a figure in the coordinates of the results.
    pub fn seen<C: Number>(&self, points: &[f64], objects: &Objects<C>) -> Vec<Vec<f64>> {
        self.outlines(points, objects, |p| self.there(p), |v| self.turned(v))
    }

    fn number(&self, name: &str) -> Option<usize> {
        self.drawing.names.iter().position(|known| known == name)
    }

    /// The points of these names, if all are points.
    pub fn numbers(&self, names: &[String]) -> Option<Vec<usize>> {
        names.iter().map(|name| self.number(name)).collect()
    }

    /// The sketch, as it is drawn behind others.
    fn sketch(&self) -> Result<Figure, ShowError> {
        let places = self.places(&self.drawing.sketch, "sketch")?.into_iter();
        let points = places.flat_map(|at| place(at, self.dimension).unwrap_or_default());
        let points: Vec<f64> = points.collect();
        let as_is = |p: [f64; 3]| p;
        let outlines = self.outlines(&points, &self.drawing.sketch_objects, as_is, as_is);
        Ok(Figure {
            kind: "sketch",
            points,
            outlines,
            ..Figure::default()
        })
    }

    /// The ends of a dimension's bar, where it has one.
    pub fn ends_of(&self, name: &str) -> Option<[usize; 2]> {
        let mut all = self.drawing.constraints.iter();
        let constraint = all.find(|constraint| constraint.name.as_deref() == Some(name))?;
        let is_distance = constraint.kind.ends_with("distance");
        let ends = is_distance.then(|| self.numbers(&constraint.items));
        ends??.try_into().ok()
    }

    fn bars(&self) -> Result<Vec<Bar>, ShowError> {
        let mut bars = Vec::new();
        for constraint in &self.drawing.constraints {
            let value = constraint.value.as_deref();
            let target = value.and_then(|value| value.parse::<f64>().ok());
            let (label, target) = match (&constraint.kind[..], value) {
                ("distance", Some(value)) => (shown(value), target),
                ("squared distance", Some(value)) => {
                    (format!("√{}", shown(value)), target.map(f64::sqrt))
                }
                // Other kinds are no lines.
                _ => continue,
            };
            let ends = self
                .numbers(&constraint.items)
                .ok_or(wrong("constraints"))?;
            if let [a, b] = ends[..] {
                bars.push(Bar {
                    ends: [a, b],
                    label,
                    target,
                });
            }
        }
        // Lines through points and rigid bodies hold points together too.
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        for object in &self.drawing.objects {
            let points = object.points.iter();
            let points: Vec<usize> = points.filter_map(|name| self.number(name)).collect();
            match &object.kind[..] {
                "line" => pairs.extend(points.windows(2).map(|w| [w[0], w[1]])),
                "body" => {
                    let with = |(k, &a): (usize, &usize)| {
                        points[..k].iter().map(move |&b| [a, b]).collect::<Vec<_>>()
                    };
                    pairs.extend(points.iter().enumerate().flat_map(with));
                }
                _ => {}
            }
        }
        // Whoever says that two points are level, or that what is between them is parallel to something, has a line in mind.
        for constraint in &self.drawing.constraints {
            if matches!(
                &constraint.kind[..],
                "horizontal" | "vertical" | "parallel" | "perpendicular" | "equal"
            ) {
                let items = constraint.items.iter();
                let points: Vec<usize> = items.map_while(|name| self.number(name)).collect();
                pairs.extend(points.as_chunks().0);
            }
        }
        for ends in pairs {
            let known = |bar: &Bar| bar.ends == ends || bar.ends == [ends[1], ends[0]];
            if !bars.iter().any(known) {
                bars.push(Bar {
                    ends,
                    label: String::new(),
                    target: None,
                });
            }
        }
        Ok(bars)
    }

    /// The dimensions that are no bars, each where the points are that it is about: the text with the number that stands in
    /// the file, or with another one for those that `now` has one for, by name.
    pub fn labels(&self, now: impl Fn(&str) -> Option<String>) -> Vec<Label> {
        let points_of = |item: &String| -> Vec<usize> {
            if let Some(point) = self.number(item) {
                return vec![point];
            }
            let mut objects = self.drawing.objects.iter();
            let object = objects.find(|object| object.name == *item);
            let points = object.into_iter().flat_map(|object| &object.points);
            points.filter_map(|name| self.number(name)).collect()
        };
        let mut labels = Vec::new();
        for constraint in &self.drawing.constraints {
            let (kind, items) = (&constraint.kind[..], &constraint.items);
            let Some(value) = constraint.value.as_deref() else {
                continue;
            };
            let worded = |value: &str| match kind {
                "angles" | "turns" | "torsions" => format!("{value}°"),
                "radii" => format!("r {value}"),
                "diameters" => format!("⌀ {value}"),
                _ => {
                    let what = if kind == "distances" { "" } else { kind };
                    format!("{what} {} {value}", items.join("–"))
                        .trim_start()
                        .to_owned()
                }
            };
            if matches!(kind, "distance" | "squared distance") {
                continue;
            }
            let before = worded(&shown(value));
            let (text, was) = match constraint.name.as_deref().and_then(&now) {
                Some(now) => (worded(&now), Some(before)),
                None => (before, None),
            };
            let mut points: Vec<usize> = items.iter().flat_map(points_of).collect();
            // Of three points the angle is at the second, of four the torsion about the bar between the middle ones.
            match (kind, &points[..]) {
                ("angles" | "turns", &[_, vertex, _]) => points = vec![vertex],
                ("torsions", &[_, b, c, _]) => points = vec![b, c],
                _ => {}
            }
            if !points.is_empty() {
                labels.push(Label { text, was, points });
            }
        }
        labels
    }

    /// The objects that are drawn: all but rigid bodies, which are bars.
    fn objects(&self) -> impl Iterator<Item = &Object> {
        self.drawing
            .objects
            .iter()
            .filter(|object| object.kind != "body")
    }

    fn shapes(&self) -> Vec<Shape> {
        self.objects()
            .map(|object| Shape {
                name: object.name.clone(),
                kind: object.kind.clone(),
                ends: match (&object.kind[..], self.numbers(&object.points).as_deref()) {
                    ("line", Some(&[a, b])) => Some([a, b]),
                    _ => None,
                },
            })
            .collect()
    }

    /// How the objects of a figure are drawn: from what the document says of them, numbers or bounds, in the coordinates
    /// that `there` and `turn` take to those of the sketch, or else from the points that they go through. Empty where
    /// neither tells.
    fn outlines<C: Number>(
        &self,
        points: &[f64],
        objects: &Objects<C>,
        there: impl Fn([f64; 3]) -> [f64; 3],
        turn: impl Fn([f64; 3]) -> [f64; 3],
    ) -> Vec<Vec<f64>> {
        let point =
            |k: usize| -> Option<[f64; 3]> { points.get(3 * k..3 * k + 3)?.try_into().ok() };
        let outline = |object: &Object| -> Option<Vec<f64>> {
            let at = objects.get(&object.name);
            let place = |at: &[C]| place(at, self.dimension);
            let through = self.numbers(&object.points)?.into_iter().map(point);
            let through = through.collect::<Option<Vec<[f64; 3]>>>()?;
            Some(match (&object.kind[..], &through[..], at) {
                ("line", _, Some(At::Line { point, direction })) => {
                    outlines::line(points, there(place(point)?), turn(place(direction)?))
                }
                ("line", &[a, b], None) => outlines::line(points, a, outlines::unit(minus(b, a))?),
                ("plane", _, Some(At::Plane { point, normal })) => {
                    outlines::plane(points, there(place(point)?), turn(place(normal)?))
                }
                ("plane", &[a, b, c], None) => {
                    let normal = cross(minus(b, a), minus(c, a));
                    outlines::plane(points, a, outlines::unit(normal)?)
                }
                ("circle" | "sphere", &[through], Some(At::Round { center, radius })) => {
                    let center = place(center).map_or(through, &there);
                    let mut numbers = center.to_vec();
                    numbers.push(Some(radius.middle()).filter(|x| x.is_finite())?);
                    numbers
                }
                ("arc", ..) => through.concat(),
                _ => return None,
            })
        };
        self.objects()
            .map(|object| outline(object).unwrap_or_default())
            .collect()
    }

    /// The coordinates in which digits are stated, in words.
    pub fn gauge(&self) -> String {
        match &self.drawing.reference[..] {
            [a, b] => format!("In coordinates with {a} at the origin and {b} on the x axis."),
            [a, b, c] => format!(
                "In coordinates with {a} at the origin, {b} on the x axis and {c} in the xy plane."
            ),
            _ => "In the coordinates of the file.".to_owned(),
        }
    }
}
