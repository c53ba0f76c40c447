//! Reading objects and constraints from problem files. Which kinds of constraints there are, and what
//! they take, is not said here: [`crate::constraint::KINDS`] does.

use super::builder::ProblemBuilder;
use super::file::{FileError, Line, Places, Reader};
use super::{AXES, Decimal};
use crate::constraint::{KINDS, Kind, Measure};
use std::collections::HashSet;
use toml_edit::{Item, Key, TableLike, Value};

/// The tables of objects.
pub(super) const TABLES: [&str; 8] = [
    "lines", "planes", "circles", "spheres", "arcs", "bodies", "joints", "unknowns",
];

/// How an object may be written, by table.
fn wanted(table: &str) -> &'static str {
    match table {
        "lines" => "[\"point\", \"point\"], or { point = [...], direction = [...] }",
        "planes" => "[\"point\", \"point\", \"point\"], or { point = [...], normal = [...] }",
        "circles" | "spheres" => "{ center = \"point\", radius = number }",
        "unknowns" => "a number, where the path begins",
        "joints" => super::joint::WANTED,
        "arcs" => "{ center = \"point\", start = \"point\", end = \"point\" }",
        _ => "points with their coordinates in the body's own frame, { p1 = [...], p2 = [...] }",
    }
}

impl Reader<'_> {
    /// All tables of objects; the names of the objects.
    pub(super) fn objects(
        &self,
        root: &dyn TableLike,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<(ProblemBuilder, HashSet<String>), FileError> {
        let mut names = HashSet::new();
        let robots = self.robots(root)?;
        builder = self.places_of_bodies(root, builder, &mut places.poses)?;
        for table in TABLES {
            builder = robots.iter().fold(builder, |builder, robot| match table {
                "bodies" => {
                    places
                        .objects
                        .extend(vec![(table, robot.line); robot.len() + 1]);
                    robot.add_bodies(builder)
                }
                "joints" => {
                    places
                        .objects
                        .extend(vec![(table, robot.line); robot.len()]);
                    robot.add_joints(builder)
                }
                _ => builder,
            });
            let Some((line, item)) = self.get(root, table) else {
                continue;
            };
            let objects = self.table(line, table, item)?;
            for (name, item) in objects.iter() {
                let line = self.line(objects.key(name).and_then(Key::span)).or(line);
                let key = format!("{table}.{}", name.chars().take(60).collect::<String>());
                self.is_in_place(line, table, name, item)?;
                builder = self.object(table, line, &key, name, item, builder)?;
                places.objects.push((table, line));
                names.insert(name.to_owned());
            }
        }
        Ok((builder, names))
    }

    fn object(
        &self,
        table: &str,
        line: Line,
        key: &str,
        name: &str,
        item: &Item,
        builder: ProblemBuilder,
    ) -> Result<ProblemBuilder, FileError> {
        let wrong = || self.wrong_kind(line, key, wanted(table), item);
        if table == "unknowns" {
            let value = item.as_value().ok_or_else(wrong)?;
            return Ok(builder.unknown(name, self.number(line, key, value)?));
        }
        if table == "joints" {
            return self.joint(line, key, name, item, builder);
        }
        if item.is_array() {
            let points = self.point_names(line, key, item)?;
            return match (table, points.as_slice()) {
                ("lines", [a, b]) => Ok(builder.line(name, a, b)),
                ("planes", [a, b, c]) => Ok(builder.plane(name, [a, b, c])),
                _ => Err(wrong()),
            };
        }
        let parts = item.as_table_like().ok_or_else(wrong)?;
        let numbers = |part: &str| -> Result<Vec<Decimal>, FileError> {
            let item = parts.get(part).ok_or_else(wrong)?;
            let numbers = item.as_array().ok_or_else(wrong)?;
            let key = format!("{key}.{part}");
            numbers.iter().map(|n| self.number(line, &key, n)).collect()
        };
        let point = |part: &str| -> Result<String, FileError> {
            let item = parts.get(part).ok_or_else(wrong)?;
            self.string(line, &format!("{key}.{part}"), item)
        };
        let known = |known: &[&str]| self.known_keys(parts, &format!("{key}."), known);
        Ok(match table {
            "lines" => {
                known(&["point", "direction"])?;
                builder.free_line(name, numbers("point")?, numbers("direction")?)
            }
            "planes" => {
                known(&["point", "normal"])?;
                builder.free_plane(name, numbers("point")?, numbers("normal")?)
            }
            "circles" | "spheres" => {
                known(&["center", "radius"])?;
                let item = parts.get("radius").ok_or_else(wrong)?;
                let value = item.as_value().ok_or_else(wrong)?;
                let radius = self.number(line, &format!("{key}.radius"), value)?;
                if table == "circles" {
                    builder.circle(name, &point("center")?, radius)
                } else {
                    builder.sphere(name, &point("center")?, radius)
                }
            }
            "arcs" => {
                known(&["center", "start", "end"])?;
                builder.arc(name, &point("center")?, &point("start")?, &point("end")?)
            }
            _ => {
                let mut members = Vec::new();
                for (point, _) in parts.iter() {
                    members.push((point.to_owned(), numbers(point)?));
                }
                builder.body_of(name, members)
            }
        })
    }

    /// All constraints of one kind. Distances between two points are kept apart.
    pub(super) fn kind(
        &self,
        kind: &Kind,
        table: &dyn TableLike,
        objects: &HashSet<String>,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        let key = format!("constraints.{}", kind.key);
        let Some((line, item)) = self.get(table, kind.key) else {
            return Ok(builder);
        };
        let entry = match kind.measure {
            Measure::Nothing => "[\"name\", ...]",
            _ => "[\"name\", ..., number]",
        };
        let wanted = format!("{entry} with the names of {}", kind.takes);
        let Some(array) = item.as_array() else {
            let wanted = format!("a list in brackets, each entry {wanted}");
            return Err(self.wrong_kind(line, &key, &wanted, item));
        };
        for value in array {
            let line = self.line(value.span()).or(line);
            if let Some(name) = value.as_str() {
                builder = builder.constraint(kind.key, [name]);
                places.constraints_of_kinds.push((kind.key, line));
                continue;
            }
            let Some(parts) = value.as_array() else {
                return Err(self.wrong_value(line, &key, &wanted, value));
            };
            let mut parts: Vec<&Value> = parts.iter().collect();
            let is_number = |value: &&Value| value.is_integer() || value.is_float();
            let wants_number = kind.measure != Measure::Nothing;
            // A number in quotes is no name: it is refused as what it is.
            let quoted = |value: &&Value| {
                value
                    .as_str()
                    .is_some_and(|text| text.parse::<Decimal>().is_ok() && !objects.contains(text))
            };
            // Where a file has parameters what stands last is no name, but an expression.
            let computed = |value: &&Value| !places.parameters.is_empty() && value.is_str();
            let number = match parts.len() {
                0 | 1 => parts.pop_if(|last| wants_number && is_number(last)),
                _ => parts.pop_if(|last| {
                    wants_number && (is_number(last) || quoted(last) || computed(last))
                }),
            };
            let mut names = Vec::with_capacity(parts.len());
            for part in parts {
                let name = part.as_str().ok_or_else(|| {
                    let wanted = format!("a name in quotes, as in {entry}");
                    self.wrong_value(line, &key, &wanted, part)
                })?;
                names.push(name);
            }
            if number.is_none() && wants_number {
                let found = format!("a list of {}", names.len());
                return Err(self.wrong(line, &key, &wanted, found));
            }
            let between_points = kind.key == "distances"
                && names.len() == 2
                && !names
                    .iter()
                    .any(|&n| objects.contains(n) || AXES.contains(&n));
            let shown: Vec<String> = names.iter().map(|n| n.chars().take(40).collect()).collect();
            let here = format!("{key}: {}", shown.join("-"));
            let number = number
                .map(|n| self.number_of(line, &here, n, places))
                .transpose()?;
            builder = match (number, between_points) {
                (Some(number), true) => {
                    places.distances.push(("constraints.distances", line));
                    builder.distance(names[0], names[1], number)
                }
                (Some(number), false) => {
                    places.constraints_of_kinds.push((kind.key, line));
                    builder.dimension(kind.key, names, number)
                }
                (None, _) => {
                    places.constraints_of_kinds.push((kind.key, line));
                    builder.constraint(kind.key, names)
                }
            };
        }
        Ok(builder)
    }

    /// The keys that may be under `[constraints]`.
    pub(super) fn constraint_keys() -> Vec<&'static str> {
        let mut keys: Vec<&str> = KINDS.iter().map(|kind| kind.key).collect();
        keys.extend(["squared_distances", "orientation"]);
        keys
    }
}
