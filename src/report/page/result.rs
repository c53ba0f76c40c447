//! The page of a result of `solve`, from its JSON (docs/json.md).

use super::{Accuracy, Bar, Figure, Level, Mark, Page, Path, Sample, Shape, Text, Tone, outlines};
use crate::interval::hull;
use crate::report::certain_digits;
use serde_json::{Map, Value};

/// Why a document is no result that can be shown.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum ShowError {
    /// It is not JSON.
    #[error("is not JSON: {0}")]
    NotJson(String),
    /// It is not a result of `krawl solve --json`.
    #[error("is not a result of `krawl solve --json`: `{0}` is missing or not what it should be")]
    NotAResult(&'static str),
    /// It is of another version.
    #[error("is of version {0} of the format, and this program reads version {1}")]
    Version(u64, u32),
}

crate::debug_in_words!(ShowError);

impl Page {
    /// The page of a result of `solve`. With samples in it (`--samples`) there is a path to travel.
    pub fn from_json(text: &str) -> Result<Page, ShowError> {
        let value = serde_json::from_str::<Value>(text);
        Self::from_result(&value.map_err(|error| ShowError::NotJson(error.to_string()))?)
    }

    /// The same from a value in memory.
    pub fn from_result(result: &Value) -> Result<Page, ShowError> {
        let version = result["version"].as_u64().ok_or(wrong("version"))?;
        if version != u64::from(crate::report::JSON_VERSION) {
            return Err(ShowError::Version(version, crate::report::JSON_VERSION));
        }
        let reader = Reader::new(result)?;
        let mode = text(result, "mode")?;
        let closed = text(result, "status")? == "closed";
        let open = text(result, "status")? == "open";
        let (badge, tone) = match (mode, closed) {
            ("certified", false) if open => ("proved · between the ends of the path", Tone::Proved),
            ("certified", true) => ("proved · complete for this path", Tone::Proved),
            (_, true) => ("observed, not proved", Tone::Observed),
            (_, false) => ("stopped", Tone::Stopped),
        };
        Ok(Page {
            title: text(result, "problem")?.to_owned(),
            badge: badge.to_owned(),
            tone,
            verdict: text(result, "verdict")?.to_owned(),
            dimension: reader.dimension,
            bars: reader.bars()?,
            shapes: reader.shapes(),
            figures: reader.figures()?,
            path: reader.path()?,
            text: words(mode, closed, open, &reader),
            digits: match mode {
                "certified" => format!(
                    "In coordinates with {} Every coordinate differs from the exact one by at most 1 in \
                     its last digit shown.",
                    reader.gauge()
                ),
                _ => format!("In coordinates with {}", reader.gauge()),
            },
            rows: reader.rows(),
            points: reader.names,
        })
    }
}

struct Reader<'a> {
    result: &'a Value,
    dimension: usize,
    names: Vec<String>,
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

fn wrong(key: &'static str) -> ShowError {
    ShowError::NotAResult(key)
}

fn text<'a>(value: &'a Value, key: &'static str) -> Result<&'a str, ShowError> {
    value[key].as_str().ok_or(wrong(key))
}

fn list<'a>(value: &'a Value, key: &'static str) -> Result<&'a Vec<Value>, ShowError> {
    value[key].as_array().ok_or(wrong(key))
}

/// Numbers, in the first places of three.
fn place(value: &Value, dimension: usize, key: &'static str) -> Result<[f64; 3], ShowError> {
    let given = value.as_array().filter(|given| given.len() == dimension);
    let mut out = [0.0; 3];
    for (out, x) in out.iter_mut().zip(given.ok_or(wrong(key))?) {
        *out = x.as_f64().ok_or(wrong(key))?;
    }
    Ok(out)
}

/// Bounds of each coordinate.
fn bounds(value: &Value, dimension: usize) -> Option<Vec<(f64, f64)>> {
    let given = value.as_array().filter(|given| given.len() == dimension)?;
    let pair = |x: &Value| {
        let (low, high) = (x[0].as_f64()?, x[1].as_f64()?);
        (low <= high).then_some((low, high))
    };
    given.iter().map(pair).collect()
}

/// A number, or the middle of two bounds.
fn number_or_middle(x: &Value) -> Option<f64> {
    match x.as_f64() {
        Some(x) => Some(x),
        None => {
            let (low, high) = (x[0].as_f64()?, x[1].as_f64()?);
            Some(low + 0.5 * (high - low))
        }
    }
}

/// Those of each coordinate, in the first places of three.
fn middles(value: &Value, dimension: usize) -> Option<[f64; 3]> {
    let given = value.as_array().filter(|given| given.len() == dimension)?;
    let mut out = [0.0; 3];
    for (out, x) in out.iter_mut().zip(given) {
        *out = number_or_middle(x)?;
    }
    Some(out)
}

impl<'a> Reader<'a> {
    fn new(result: &'a Value) -> Result<Self, ShowError> {
        let dimension = match result["dimension"].as_u64() {
            Some(d @ (2 | 3)) => d as usize,
            _ => return Err(wrong("dimension")),
        };
        let names = list(result, "names")?.iter();
        let names = names.map(|name| name.as_str().map(str::to_owned).ok_or(wrong("names")));
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
            names: names.collect::<Result<_, _>>()?,
            origin,
            axes,
        })
    }

    /// In the coordinates of the sketch.
    fn there(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| {
            self.origin[k] + (0..3).map(|axis| self.axes[axis][k] * p[axis]).sum::<f64>()
        })
    }

    /// A direction likewise.
    fn turned(&self, v: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| (0..3).map(|axis| self.axes[axis][k] * v[axis]).sum())
    }

    /// The outlines of a figure in the coordinates of the reference.
    fn seen(&self, points: &[f64], objects: &Value) -> Vec<Vec<f64>> {
        self.outlines(points, objects, |p| self.there(p), |v| self.turned(v))
    }

    fn number(&self, name: &Value) -> Option<usize> {
        let name = name.as_str()?;
        self.names.iter().position(|known| known == name)
    }

    fn bars(&self) -> Result<Vec<Bar>, ShowError> {
        let mut bars = Vec::new();
        for constraint in list(self.result, "constraints")? {
            let items = list(constraint, "items").map_err(|_| wrong("constraints"))?;
            let value = constraint["value"].as_str();
            let target = value.and_then(|value| value.parse::<f64>().ok());
            let (label, target) = match (constraint["kind"].as_str(), value) {
                (Some("distance"), Some(value)) => (shown(value), target),
                (Some("squared distance"), Some(value)) => {
                    (format!("√{}", shown(value)), target.map(f64::sqrt))
                }
                // Other kinds are no lines.
                _ => continue,
            };
            let ends: Option<Vec<usize>> = items.iter().map(|name| self.number(name)).collect();
            let ends = ends.ok_or(wrong("constraints"))?;
            if let [a, b] = ends[..] {
                bars.push(Bar {
                    ends: [a, b],
                    label,
                    target,
                });
            }
        }
        // Lines through points and rigid bodies hold points together too.
        for object in self.result["objects"].as_array().into_iter().flatten() {
            let points = object["points"].as_array().into_iter().flatten();
            let points: Vec<usize> = points.filter_map(|name| self.number(name)).collect();
            let pairs: Vec<[usize; 2]> = match object["kind"].as_str() {
                Some("line") => points.windows(2).map(|w| [w[0], w[1]]).collect(),
                Some("body") => points
                    .iter()
                    .enumerate()
                    .flat_map(|(k, &a)| points[..k].iter().map(move |&b| [a, b]))
                    .collect(),
                _ => Vec::new(),
            };
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
        }
        Ok(bars)
    }

    /// The objects that are drawn: all but rigid bodies, which are bars.
    fn objects(&self) -> impl Iterator<Item = (&'a str, &'a str, &'a Value)> {
        let objects = self.result["objects"].as_array().into_iter().flatten();
        objects.filter_map(|object| {
            let (name, kind) = (object["name"].as_str()?, object["kind"].as_str()?);
            (kind != "body").then_some((name, kind, &object["points"]))
        })
    }

    fn shapes(&self) -> Vec<Shape> {
        self.objects()
            .map(|(name, kind, _)| Shape {
                name: name.into(),
                kind: kind.into(),
            })
            .collect()
    }

    /// How the objects of a figure are drawn: what the document says of them, numbers or bounds, in the coordinates
    /// that `there` and `turn` take to those of the sketch. Empty where it does not say it.
    fn outlines(
        &self,
        points: &[f64],
        objects: &Value,
        there: impl Fn([f64; 3]) -> [f64; 3],
        turn: impl Fn([f64; 3]) -> [f64; 3],
    ) -> Vec<Vec<f64>> {
        let point =
            |k: usize| -> Option<[f64; 3]> { points.get(3 * k..3 * k + 3)?.try_into().ok() };
        let outline = |(name, kind, through): (&str, &str, &Value)| {
            let at = &objects[name];
            let place = |key: &str| middles(&at[key], self.dimension);
            Some(match kind {
                "line" => outlines::line(points, there(place("point")?), turn(place("direction")?)),
                "plane" => outlines::plane(points, there(place("point")?), turn(place("normal")?)),
                "circle" | "sphere" => {
                    let mut numbers = there(place("center")?).to_vec();
                    numbers.push(number_or_middle(&at["radius"])?);
                    numbers
                }
                "arc" => {
                    let ends = through.as_array()?.iter();
                    let ends = ends.map(|name| self.number(name).and_then(point));
                    ends.collect::<Option<Vec<_>>>()?.concat()
                }
                _ => return None,
            })
        };
        let all: Option<Vec<Vec<f64>>> = self.objects().map(outline).collect();
        all.unwrap_or_default()
    }

    fn figures(&self) -> Result<Vec<Figure>, ShowError> {
        let sketch = &self.result["sketch"];
        let mut points = Vec::new();
        for name in &self.names {
            points.extend(place(&sketch[name.as_str()], self.dimension, "sketch")?);
        }
        let as_is = |p: [f64; 3]| p;
        let outlines = self.outlines(&points, &self.result["sketch_objects"], as_is, as_is);
        let mut figures = vec![Figure {
            name: "Sketch".into(),
            note: "where the path begins, t = 0".into(),
            kind: "sketch",
            class: None,
            at: Some(0.0),
            t: Some(0.0),
            folds: None,
            points,
            outlines,
            digits: None,
        }];
        for (k, solution) in list(self.result, "solutions")?.iter().enumerate() {
            figures.push(self.solution(k, solution).ok_or(wrong("solutions"))?);
        }
        Ok(figures)
    }

    fn solution(&self, k: usize, solution: &Value) -> Option<Figure> {
        let map: &Map<String, Value> = solution["points"].as_object()?;
        let (mut points, mut digits) = (Vec::new(), Vec::new());
        for name in &self.names {
            let bounds = bounds(map.get(name)?, self.dimension)?;
            let mut middle = [0.0; 3];
            for (middle, (low, high)) in middle.iter_mut().zip(&bounds) {
                *middle = low + 0.5 * (high - low);
            }
            points.extend(self.there(middle));
            let shown = bounds
                .iter()
                .map(|&(low, high)| certain_digits(hull(low, high)));
            digits.push(shown.collect());
        }
        let class = solution["class"].as_u64()? as usize;
        let folds = solution["folds"].as_u64().map(|n| n as usize);
        let mut note = match folds {
            Some(0) => "reached without a fold".to_owned(),
            Some(1) => "after a fold".to_owned(),
            Some(n) => format!("after {n} folds"),
            None => format!("class {class}"),
        };
        if let Some(other) = solution["mirror_of"].as_u64() {
            note += &format!(", mirror image of {}", other + 1);
        }
        if solution["degenerate"].as_bool() == Some(true) {
            note += ", degenerate (flat)";
        }
        Some(Figure {
            name: format!("Solution {}", k + 1),
            note,
            kind: "solution",
            class: Some(class),
            at: solution["arc"].as_f64(),
            t: Some(1.0),
            folds,
            outlines: self.seen(&points, &solution["objects"]),
            points,
            digits: Some(digits),
        })
    }

    fn path(&self) -> Result<Option<Path>, ShowError> {
        let Some(given) = self.result["samples"].as_array() else {
            return Ok(None);
        };
        let mut samples = Vec::with_capacity(given.len());
        let mut within = Vec::with_capacity(given.len());
        for sample in given {
            let at = sample["at"].as_f64().ok_or(wrong("samples"))?;
            let t = sample["t"].as_f64().ok_or(wrong("samples"))?;
            let mut points = Vec::with_capacity(3 * self.names.len());
            for p in list(sample, "points").map_err(|_| wrong("samples"))? {
                points.extend(self.there(place(p, self.dimension, "samples")?));
            }
            if points.len() != 3 * self.names.len() {
                return Err(wrong("samples"));
            }
            samples.push(Sample {
                at,
                t,
                outlines: self.seen(&points, &sample["objects"]),
                points,
            });
            within.extend(sample["within"].as_f64());
        }
        if samples.len() < 2 {
            return Ok(None);
        }
        let mut marks = Vec::new();
        for fold in list(self.result, "folds")? {
            let at = fold["at"].as_f64().ok_or(wrong("folds"))?;
            let t = [0, 1].map(|k| fold["t"][k].as_f64());
            let [Some(low), Some(high)] = t else {
                return Err(wrong("folds"));
            };
            marks.push(Mark {
                at,
                t: 0.5 * (low + high),
            });
        }
        Ok(Some(Path {
            parameter: "t".into(),
            along: "length of the path".into(),
            legend: "The curve is t along the path: 0 at the sketch, 1 where the dimensions are met. \
                     Dots are solutions, coloured by class; diamonds are folds, where the path turns back. \
                     Click or drag in it; the wheel zooms."
                .into(),
            levels: [(0.0, "0"), (1.0, "1")]
                .map(|(t, label)| Level {
                    t,
                    label: label.into(),
                })
                .into(),
            accuracy: (within.len() == samples.len()).then(|| self.accuracy(within)),
            samples,
            marks,
        }))
    }

    /// How narrowly the samples and the figures are enclosed.
    fn accuracy(&self, samples: Vec<f64>) -> Accuracy {
        let width = |solution: &Value| {
            let points = solution["points"].as_object()?.values();
            let bounds = points.filter_map(|p| bounds(p, self.dimension)).flatten();
            Some(bounds.fold(0.0, |most: f64, (low, high)| most.max(0.5 * (high - low))))
        };
        let solutions = self.result["solutions"].as_array().into_iter().flatten();
        Accuracy {
            samples,
            figures: std::iter::once(None).chain(solutions.map(width)).collect(),
            legend: "How far the path can be from what is drawn, in any coordinate, and the solutions from their digits: \
                     proved bounds, in the lengths of the problem, each line ten thousand times the next."
                .into(),
        }
    }

    fn rows(&self) -> Vec<(String, String)> {
        let result = self.result;
        let mut rows = Vec::new();
        let mut row = |label: &str, value: String| rows.push((label.to_owned(), value));
        let plain = |value: &Value| match value {
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        let rounded = |value: &Value| value.as_f64().map_or("?".into(), |x| format!("{x:.6}"));
        row(
            "mode, space",
            format!("{}, {}", plain(&result["mode"]), plain(&result["space"])),
        );
        row(
            "steps, rejected",
            format!("{}, {}", result["steps"], result["rejected"]),
        );
        row("length of the path", rounded(&result["length"]));
        let range = &result["t_range"];
        row(
            "range of t",
            format!("{} to {}", rounded(&range[0]), rounded(&range[1])),
        );
        row("seconds", rounded(&result["seconds"]));
        let options = &result["options"];
        if !options["bend"].is_null() {
            let bend = [0, 1].map(|k| plain(&options["bend"][k])).join("-");
            let c = plain(&options["bend_coefficient"]);
            row("bend", format!("{bend}, c = {c}"));
        }
        for text in result["switched_on"].as_array().into_iter().flatten() {
            row("switched on", plain(text));
        }
        row("written by", format!("krawl {}", plain(&result["krawl"])));
        if let Some(source) = result["source"].as_str() {
            row("source", source.to_owned());
        }
        rows
    }

    /// The coordinates in which digits are stated, in words.
    fn gauge(&self) -> String {
        let names: Vec<&str> = self.result["reference"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
            .collect();
        match names[..] {
            [a, b] => format!("{a} at the origin and {b} on the x axis."),
            [a, b, c] => {
                format!("{a} at the origin, {b} on the x axis and {c} in the xy plane.")
            }
            _ => "the sketch's own axes.".to_owned(),
        }
    }
}

/// A decimal as it is written on a bar: not longer than a few digits.
fn shown(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(x) if value.len() > 8 => format!("{}", (x * 1e4).round() / 1e4),
        _ => value.to_owned(),
    }
}

/// The answer explained.
fn words(mode: &str, closed: bool, open: bool, reader: &Reader) -> Vec<Text> {
    let paragraph = |text: &str| Text::Paragraph(text.to_owned());
    let mut out = vec![paragraph(
        "The sketch's dimensions are led to the wanted ones together: t = 0 is the sketch, and at t = 1 all \
         dimensions are what they should be. As they change the figure moves along a path; wherever that \
         path meets t = 1 there is a solution. Solutions of one colour are congruent: the same figure, or \
         its mirror image.",
    )];
    match (mode, closed) {
        ("certified", true) => {
            out.push(paragraph(
                "What is proved, for the exact decimals of the problem and with every rounding accounted for:",
            ));
            out.push(Text::List(vec![
                "The path through the sketch is a closed curve, regular along its whole length, and it was \
                 followed all the way round: no step jumped to another curve."
                    .into(),
                "The solutions listed are exactly the points of that path with t = 1: none is missing and \
                 none is there twice. Each lies within the digits shown, alone."
                    .into(),
                "All lengths stay positive along the path.".into(),
            ]));
            out.push(paragraph(
                "Other solutions may exist on other paths. The pictures are drawn from the tubes that were \
                 proved; they are pictures, the digits are the result.",
            ));
        }
        ("certified", false) if open => out.push(paragraph(
            "The path has two ends. What is proved is about the arc between them: it is regular, no step jumped, and \
             the solutions listed are exactly those on it, each alone within the digits shown.",
        )),
        ("certified", false) => out.push(paragraph(
            "The run stopped before it came back to the sketch. The solutions listed are proved, each alone \
             within the digits shown; there may be more on the rest of the path.",
        )),
        _ => out.push(paragraph(
            "This run was made in floating-point arithmetic: what it says is observed, not proved.",
        )),
    }
    if let Some(reason) = reader.result["reason"].as_str() {
        out.push(Text::Paragraph(format!("Why it stopped: {reason}.")));
    }
    out
}
