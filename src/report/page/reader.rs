//! What results of all verbs with figures have in common, read from their JSON (docs/using/programs.md).

use super::{Bar, Figure, Label, Page, Shape, outlines};
use crate::interval::hull;
use crate::interval::vector::{cross, minus};
use crate::places::array;
use crate::report::certain_digits;
use crate::report::columns::DIGITS;
use crate::report::drawing::{Constraint, Object};
use crate::report::figures::chosen_in_words;
use serde::Deserialize;
use serde_json::{Value, json};

/// Why a document is no result that can be shown.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum ShowError {
    /// It is not JSON.
    #[error("is not JSON: {0}")]
    NotJson(String),
    /// It is not a result of this program.
    #[error(
        "is not a result that `krawl` wrote with `--json`: `{0}` is missing or not what it should be"
    )]
    NotAResult(&'static str),
    /// It is of another version.
    #[error("is of version {0} of the format, and this program reads version {1}")]
    Version(u64, u32),
    /// It is a result without figures in real coordinates.
    #[error("is a result of `krawl {0}`, which has no figure to draw: {1}")]
    NoFigure(&'static str, &'static str),
}

crate::debug_in_words!(ShowError);

pub(super) fn wrong(key: &'static str) -> ShowError {
    ShowError::NotAResult(key)
}

pub(super) fn text<'a>(value: &'a Value, key: &'static str) -> Result<&'a str, ShowError> {
    value[key].as_str().ok_or(wrong(key))
}

pub(super) fn list<'a>(value: &'a Value, key: &'static str) -> Result<&'a Vec<Value>, ShowError> {
    value[key].as_array().ok_or(wrong(key))
}

/// The texts of a list.
pub(super) fn strings(list: &Value) -> Vec<&str> {
    let list = list.as_array().into_iter().flatten();
    list.filter_map(Value::as_str).collect()
}

/// Circles with their radii, as objects of a result have them.
pub(super) fn circles(radii: &Value) -> Value {
    let radii = radii.as_object().into_iter().flatten();
    let all = radii.map(|(name, radius)| (name.clone(), json!({"radius": radius})));
    Value::Object(all.collect())
}

/// `block 1 solution 1, block 2 solution 3 mirrored`.
pub(super) fn choices(choices: &Value) -> Option<String> {
    let each = choices.as_array()?.iter().map(|choice| {
        let number = |key: &str| Some(choice[key].as_u64()? as usize);
        let is_mirrored = choice["mirrored"].as_bool() == Some(true);
        Some((number("block")?, number("solution")?, is_mirrored))
    });
    let each = each.collect::<Option<Vec<_>>>()?;
    Some(chosen_in_words(each.into_iter()))
}

/// What stands under a key, in the form that is wanted.
fn read<'a, T: Deserialize<'a>>(value: &'a Value, key: &'static str) -> Result<T, ShowError> {
    T::deserialize(&value[key]).map_err(|_| wrong(key))
}

/// Numbers, in the first places of three.
pub(super) fn place(
    value: &Value,
    dimension: usize,
    key: &'static str,
) -> Result<[f64; 3], ShowError> {
    let given = value.as_array().filter(|given| given.len() == dimension);
    let mut out = [0.0; 3];
    for (out, x) in out.iter_mut().zip(given.ok_or(wrong(key))?) {
        *out = x.as_f64().ok_or(wrong(key))?;
    }
    Ok(out)
}

/// A lower and an upper bound.
pub(super) fn pair(x: &Value) -> Option<(f64, f64)> {
    let (low, high) = (x[0].as_f64()?, x[1].as_f64()?);
    (low <= high).then_some((low, high))
}

pub(super) fn middle((low, high): (f64, f64)) -> f64 {
    low + 0.5 * (high - low)
}

/// The digits of which bounds leave no doubt.
pub(super) fn digits((low, high): (f64, f64)) -> String {
    certain_digits(hull(low, high))
}

/// Bounds of each coordinate.
pub(super) fn bounds(value: &Value, dimension: usize) -> Option<Vec<(f64, f64)>> {
    let given = value.as_array().filter(|given| given.len() == dimension)?;
    given.iter().map(pair).collect()
}

/// A number, or the middle of two bounds.
fn number_or_middle(x: &Value) -> Option<f64> {
    x.as_f64().or_else(|| pair(x).map(middle))
}

/// For each coordinate the number, or the middle of its bounds, in the first places of three.
fn middles(value: &Value, dimension: usize) -> Option<[f64; 3]> {
    let given = value.as_array().filter(|given| given.len() == dimension)?;
    let mut out = [0.0; 3];
    for (out, x) in out.iter_mut().zip(given) {
        *out = number_or_middle(x)?;
    }
    Some(out)
}

/// A decimal as it is written on a bar: not longer than a few digits.
pub(super) fn shown(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(x) if value.len() > 8 => format!("{}", (x * 1e4).round() / 1e4),
        _ => value.to_owned(),
    }
}

/// A result, and the coordinates in which its figures are seen from those of the sketch.
pub(super) struct Reader<'a> {
    pub result: &'a Value,
    pub dimension: usize,
    pub names: Vec<String>,
    constraints: Vec<Constraint<'a>>,
    objects: Vec<Object<'a>>,
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl<'a> Reader<'a> {
    pub fn new(result: &'a Value) -> Result<Self, ShowError> {
        let given = match &result["dimension"] {
            // Of a sweep it is the name of what is driven.
            Value::String(_) => {
                let places = result["sketch"].as_object().ok_or(wrong("sketch"))?;
                let place = places.values().next().and_then(Value::as_array);
                place.map(|place| place.len() as u64)
            }
            given => given.as_u64(),
        };
        let dimension = match given {
            Some(d @ (2 | 3)) => d as usize,
            _ => return Err(wrong("dimension")),
        };
        let mut origin = [0.0; 3];
        let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if !result["frame"].is_null() {
            let frame = &result["frame"];
            origin = place(&frame["origin"], dimension, "frame")?;
            for (k, axis) in axes.iter_mut().enumerate().take(dimension) {
                *axis = place(&frame["axes"][k], dimension, "frame")?;
            }
        }
        Ok(Reader {
            result,
            dimension,
            names: read(result, "names")?,
            constraints: read(result, "constraints")?,
            objects: read::<Option<_>>(result, "objects")?.unwrap_or_default(),
            origin,
            axes,
        })
    }

    /// A page with the sketch, under a name and with a note, and what holds it together. Digits are taken to be proved.
    pub fn page(&self, name: &str, note: &str) -> Result<Page, ShowError> {
        Ok(Page {
            title: text(self.result, "problem")?.to_owned(),
            dimension: self.dimension,
            points: self.names.clone(),
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
    pub fn words(&self) -> Result<String, ShowError> {
        let name = format!("{}: ", text(self.result, "problem")?);
        let words = text(self.result, "words")?;
        Ok(words.trim_start_matches(&name).to_owned())
    }

    /// A figure with bounds of its coordinates, seen as results are, as a solution without a name yet; `key`: where it stands.
    pub fn figure(
        &self,
        points: &Value,
        objects: &Value,
        key: &'static str,
    ) -> Result<Figure, ShowError> {
        let (mut places, mut read) = (Vec::new(), Vec::new());
        for name in &self.names {
            let bounds = bounds(&points[name.as_str()], self.dimension).ok_or(wrong(key))?;
            let mut at = [0.0; 3];
            for (at, &bounds) in at.iter_mut().zip(&bounds) {
                *at = middle(bounds);
            }
            places.extend(self.there(at));
            read.push(bounds.into_iter().map(digits).collect());
        }
        Ok(Figure {
            kind: "solution",
            outlines: self.seen(&places, objects),
            points: places,
            digits: Some(read),
            ..Figure::default()
        })
    }

    /// The outlines of a figure in the coordinates of the results.
    pub fn seen(&self, points: &[f64], objects: &Value) -> Vec<Vec<f64>> {
        self.outlines(points, objects, |p| self.there(p), |v| self.turned(v))
    }

    fn number(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The points of these names, if all are points.
    fn numbers(&self, names: &[&str]) -> Option<Vec<usize>> {
        names.iter().map(|name| self.number(name)).collect()
    }

    /// The sketch, as it is drawn behind others.
    fn sketch(&self) -> Result<Figure, ShowError> {
        let sketch = &self.result["sketch"];
        let mut points = Vec::new();
        for name in &self.names {
            points.extend(place(&sketch[name.as_str()], self.dimension, "sketch")?);
        }
        let as_is = |p: [f64; 3]| p;
        let outlines = self.outlines(&points, &self.result["sketch_objects"], as_is, as_is);
        Ok(Figure {
            kind: "sketch",
            points,
            outlines,
            ..Figure::default()
        })
    }

    /// The ends of a dimension's bar, where it has one.
    pub fn ends_of(&self, name: &str) -> Option<[usize; 2]> {
        let mut all = self.constraints.iter();
        let constraint = all.find(|constraint| constraint.name.as_deref() == Some(name))?;
        let is_distance = constraint.kind.ends_with("distance");
        let ends = is_distance.then(|| self.numbers(&constraint.items));
        ends??.try_into().ok()
    }

    fn bars(&self) -> Result<Vec<Bar>, ShowError> {
        let mut bars = Vec::new();
        for constraint in &self.constraints {
            let value = constraint.value.as_deref();
            let target = value.and_then(|value| value.parse::<f64>().ok());
            let (label, target) = match (constraint.kind, value) {
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
        for object in &self.objects {
            let points = object.points.iter();
            let points: Vec<usize> = points.filter_map(|name| self.number(name)).collect();
            match object.kind {
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
        for constraint in &self.constraints {
            if matches!(
                constraint.kind,
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
        let points_of = |item: &&str| -> Vec<usize> {
            if let Some(point) = self.number(item) {
                return vec![point];
            }
            let object = self.objects.iter().find(|object| object.name == *item);
            let points = object.into_iter().flat_map(|object| &object.points);
            points.filter_map(|name| self.number(name)).collect()
        };
        let mut labels = Vec::new();
        for constraint in &self.constraints {
            let (kind, items) = (constraint.kind, &constraint.items);
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
    fn objects(&self) -> impl Iterator<Item = &Object<'a>> {
        self.objects.iter().filter(|object| object.kind != "body")
    }

    fn shapes(&self) -> Vec<Shape> {
        self.objects()
            .map(|object| Shape {
                name: object.name.into(),
                kind: object.kind.into(),
                ends: match (object.kind, self.numbers(&object.points).as_deref()) {
                    ("line", Some(&[a, b])) => Some([a, b]),
                    _ => None,
                },
            })
            .collect()
    }

    /// How the objects of a figure are drawn: from what the document says of them, numbers or bounds, in the coordinates
    /// that `there` and `turn` take to those of the sketch, or else from the points that they go through. Empty where
    /// neither tells.
    fn outlines(
        &self,
        points: &[f64],
        objects: &Value,
        there: impl Fn([f64; 3]) -> [f64; 3],
        turn: impl Fn([f64; 3]) -> [f64; 3],
    ) -> Vec<Vec<f64>> {
        let point =
            |k: usize| -> Option<[f64; 3]> { points.get(3 * k..3 * k + 3)?.try_into().ok() };
        let outline = |object: &Object| -> Option<Vec<f64>> {
            let at = &objects[object.name];
            let place = |key: &str| middles(&at[key], self.dimension);
            let through = self.numbers(&object.points)?.into_iter().map(point);
            let through = through.collect::<Option<Vec<[f64; 3]>>>()?;
            Some(match (object.kind, &through[..]) {
                ("line", _) if !at.is_null() => {
                    outlines::line(points, there(place("point")?), turn(place("direction")?))
                }
                ("line", &[a, b]) => outlines::line(points, a, outlines::unit(minus(b, a))?),
                ("plane", _) if !at.is_null() => {
                    outlines::plane(points, there(place("point")?), turn(place("normal")?))
                }
                ("plane", &[a, b, c]) => {
                    let normal = cross(minus(b, a), minus(c, a));
                    outlines::plane(points, a, outlines::unit(normal)?)
                }
                ("circle" | "sphere", &[center]) => {
                    let center = place("center").map_or(center, &there);
                    let mut numbers = center.to_vec();
                    numbers.push(number_or_middle(&at["radius"])?);
                    numbers
                }
                ("arc", _) => through.concat(),
                _ => return None,
            })
        };
        self.objects()
            .map(|object| outline(object).unwrap_or_default())
            .collect()
    }

    /// The coordinates in which digits are stated, in words.
    pub fn gauge(&self) -> String {
        match strings(&self.result["reference"])[..] {
            [a, b] => format!("In coordinates with {a} at the origin and {b} on the x axis."),
            [a, b, c] => format!(
                "In coordinates with {a} at the origin, {b} on the x axis and {c} in the xy plane."
            ),
            _ => "In the coordinates of the file.".to_owned(),
        }
    }
}
