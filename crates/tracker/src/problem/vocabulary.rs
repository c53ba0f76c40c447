//! Reading objects and constraints from problem files. Which kinds of constraints there are, and what
//! they take, is not said here: [`crate::constraint::KINDS`] does.

use super::builder::ProblemBuilder;
use super::cursor::{At, TEXT};
use super::file::{FileError, Reader};
use super::{AXES, Decimal, DecimalError, expression, joint, limits};
use crate::constraint::{KINDS, Kind, Measure};

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
        "unknowns" => {
            "a number, where the path begins, or { value = number, within = [number, number] }"
        }
        "joints" => super::joint::WANTED,
        "arcs" => "{ center = \"point\", start = \"point\", end = \"point\" }",
        _ => "points with their coordinates in the body's own frame, { p1 = [...], p2 = [...] }",
    }
}

impl<'a> Reader<'a> {
    /// All tables of objects.
    pub(super) fn objects(&mut self) -> Result<(), FileError> {
        let robots = joint::robots(&self.root)?;
        self.places_of_bodies()?;
        for table in TABLES {
            for robot in &robots {
                self.add(&robot.at.named(table), |builder| {
                    Ok(match table {
                        "bodies" => robot.add_bodies(builder),
                        "joints" => robot.add_joints(builder),
                        _ => builder,
                    })
                })?;
            }
            let Some(objects) = self.root.get(table) else {
                continue;
            };
            for (name, at) in objects.entries()? {
                at.is_in_place(table)?;
                self.add(&at.named(table), |builder| {
                    object(table, name, &at, builder)
                })?;
                self.objects.insert(name);
            }
        }
        Ok(())
    }

    /// All constraints of one kind. Distances between two points are kept apart.
    pub(super) fn kind(&mut self, kind: &Kind, list: &At) -> Result<(), FileError> {
        let wants_number = kind.measure != Measure::Nothing;
        let entry = match wants_number {
            false => "[\"name\", ...]",
            true => "[\"name\", ..., number]",
        };
        let wanted = format!("{entry} with the names of {}", kind.takes);
        for at in list.list(&format!("a list in brackets, each entry {wanted}"))? {
            if let Some(name) = at.item.as_str() {
                self.add(&at, |builder| Ok(builder.constraint(kind.key, [name])))?;
                continue;
            }
            let mut parts = at.list(&wanted)?;
            let is_alone = parts.len() == 1;
            // A number in quotes is no name: it is refused as what it is. And where a file has parameters what stands last is
            // no name, but an expression.
            let is_quoted = |text: &str| {
                let is_number = text.parse::<Decimal>().is_ok() || limits::is_meant(text);
                !self.parameters.is_empty() || is_number && !self.objects.contains(text)
            };
            let number = parts.pop_if(|last| {
                let is_quoted = !is_alone && last.item.as_str().is_some_and(is_quoted);
                wants_number && (last.is_number() || last.item.is_array() || is_quoted)
            });
            let name = format!("a name in quotes, as in {entry}");
            let names = parts.iter().map(|part| part.text(&name));
            let names = names.collect::<Result<Vec<&str>, FileError>>()?;
            if number.is_none() && wants_number {
                return Err(at.is_wrong(&wanted, &format!("a list of {}", names.len())));
            }
            let is_object = |name: &&str| self.objects.contains(name) || AXES.contains(name);
            let between_points =
                kind.key == "distances" && names.len() == 2 && !names.iter().any(is_object);
            let number = number.map(|number| self.number_of(&number, &names));
            let number = number.transpose()?;
            self.add(&at, |builder| {
                Ok(match number {
                    Some(number) if between_points => builder.distance(names[0], names[1], number),
                    Some(number) => builder.dimension(kind.key, names, number),
                    None => builder.constraint(kind.key, names),
                })
            })?;
        }
        Ok(())
    }

    pub(super) fn squared_distances(&mut self, list: &At) -> Result<(), FileError> {
        let wanted = "[\"point\", \"point\", number]";
        for at in list.list(&format!("a list of {wanted} in brackets"))? {
            let parts = at.list(wanted)?;
            let [a, b, number] = &parts[..] else {
                return Err(at.is_wrong(wanted, &format!("a list of {}", parts.len())));
            };
            let [a, b] = [a, b].map(|end| end.text("a point's name in quotes"));
            let (a, b) = (a?, b?);
            let number = self.number_of(number, &[a, b])?;
            self.add(&at, |builder| Ok(builder.squared_distance(a, b, number)))?;
        }
        Ok(())
    }

    /// The number of a constraint, which may have limits, or be an expression where the file has parameters.
    fn number_of(&self, number: &At, names: &[&str]) -> Result<Decimal, FileError> {
        let names = names.iter().map(|n| n.chars().take(40).collect());
        let names = names.collect::<Vec<String>>().join("-");
        let number = number.named(format!("{}: {names}", number.key));
        let has_parameters = !self.parameters.is_empty();
        match number.item.as_str() {
            None if number.item.is_array() => limits::read(&number, has_parameters),
            Some(text) if limits::is_meant(text) => limits::read(&number, has_parameters),
            Some(text) if has_parameters => {
                expression::evaluate(text, &self.parameters).map_err(|why| number.fault(why))
            }
            _ => number.number(),
        }
    }

    /// The keys that may be under `[constraints]`.
    pub(super) fn constraint_keys() -> Vec<&'static str> {
        let mut keys: Vec<&str> = KINDS.iter().map(|kind| kind.key).collect();
        keys.extend(["squared_distances", "orientation"]);
        keys
    }
}

/// An object of a table.
fn object(
    table: &str,
    name: &str,
    at: &At,
    builder: ProblemBuilder,
) -> Result<ProblemBuilder, FileError> {
    let wrong = || at.wrong(wanted(table));
    if table == "unknowns" {
        return unknown(name, at, builder);
    }
    if table == "joints" {
        return joint::joint(name, at, builder);
    }
    if at.item.is_array() {
        let points = at.texts("names of points in brackets, each in quotes")?;
        return match (table, points.as_slice()) {
            ("lines", [a, b]) => Ok(builder.line(name, a, b)),
            ("planes", &[a, b, c]) => Ok(builder.plane(name, [a, b, c])),
            _ => Err(wrong()),
        };
    }
    if !at.item.is_table_like() {
        return Err(wrong());
    }
    let part = |part: &str| at.get(part).ok_or_else(wrong);
    let point = |name: &str| part(name)?.text(TEXT);
    let numbers = |name: &str| -> Result<Vec<Decimal>, FileError> {
        let list = part(name)?.list("").map_err(|_| wrong())?;
        list.iter().map(At::number).collect()
    };
    Ok(match table {
        "lines" => {
            at.known_keys(&["point", "direction"])?;
            builder.free_line(name, numbers("point")?, numbers("direction")?)
        }
        "planes" => {
            at.known_keys(&["point", "normal"])?;
            builder.free_plane(name, numbers("point")?, numbers("normal")?)
        }
        "circles" | "spheres" => {
            at.known_keys(&["center", "radius"])?;
            let (radius, center) = (part("radius")?.number()?, point("center")?);
            match table {
                "circles" => builder.circle(name, center, radius),
                _ => builder.sphere(name, center, radius),
            }
        }
        "arcs" => {
            at.known_keys(&["center", "start", "end"])?;
            builder.arc(name, point("center")?, point("start")?, point("end")?)
        }
        _ => {
            let members = at.entries()?.into_iter();
            let members = members.map(|(point, _)| Ok((point, numbers(point)?)));
            builder.body(name, members.collect::<Result<Vec<_>, FileError>>()?)
        }
    })
}

/// An unknown: its value in the sketch, a range, of which the middle is that, or both.
fn unknown(name: &str, at: &At, builder: ProblemBuilder) -> Result<ProblemBuilder, FileError> {
    let wrong = || at.wrong(wanted("unknowns"));
    let (value, range) = match (at.item.is_table_like(), at.item.is_array()) {
        (true, _) => {
            at.known_keys(&["value", "within"])?;
            (at.get("value"), at.get("within"))
        }
        (_, true) => (None, Some(at.clone())),
        _ if at.item.is_value() => (Some(at.clone()), None),
        _ => return Err(wrong()),
    };
    let ends = range.map(|at| range_of(&at)).transpose()?;
    let ends = ends.unwrap_or_default();
    let value = match (
        value,
        ends.each_ref().map(|end| end.as_ref().map(Decimal::to_f64)),
    ) {
        (Some(value), _) => value.number()?,
        (None, [None, None]) => return Err(wrong()),
        (None, [low, high]) => {
            let [low, high] = [low.or(high.map(|x| x - 2.0)), high.or(low.map(|x| x + 2.0))];
            let middle = 0.5 * (low.unwrap_or_default() + high.unwrap_or_default());
            let middle = middle.to_string().parse();
            middle.map_err(|error: DecimalError| at.fault(error))?
        }
    };
    Ok(builder.unknown_within(name, value, ends))
}

/// The ends of a range; `-inf` and `inf` are none.
fn range_of(at: &At) -> Result<[Option<Decimal>; 2], FileError> {
    let wanted = "a range, [0, 2], or [0, inf] where it has no end";
    let ends = at.list(wanted)?;
    let [low, high] = &ends[..] else {
        return Err(at.wrong(wanted));
    };
    let end = |of: &At, open: f64| match of.item.as_float() {
        Some(x) if x == open => Ok(None),
        _ => of.number().map(Some),
    };
    Ok([end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?])
}
