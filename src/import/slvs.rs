//! SolveSpace's `.slvs`: lines `Thing.key=value`, things ended by `AddThing`.
//!
//! A sketch is a group in a plane (type 5001). Its points are requests' points 1, 2, ... with the parameters
//! `16 + 3k` of their requests; what other groups made (handles with the top bit set, or of requests of other
//! groups) stays where it is, seen in the group's work plane. Zero values are left out of the file. What constraints
//! mean is that of SolveSpace's `constrainteq.cpp`.

use super::drawing::{Drawing, SNAP};
use super::{Figure, Imported, Listed, Places as AllPlaces};
use crate::interval::vector::{cross, dot, minus};
use crate::order::each_once;
use crate::places::{Each as _, array};
use crate::problem::{Item, Problem, Shape};
use std::collections::HashMap;

/// A handle: `h.v`.
type Handle = u32;

/// A group in a plane.
const IN_PLANE: u32 = 5001;
const POINT_IN_3D: u32 = 2000;
const POINT_IN_2D: u32 = 2001;
const LINE: u32 = 11000;
const NORMALS: std::ops::RangeInclusive<u32> = 3000..=3012;
const WORKPLANE: u32 = 10000;
const CIRCLE: u32 = 13000;
const ARC: u32 = 14000;
/// Requests of single points number their entities from 0, all others from 1.
const DATUM_POINT: u32 = 101;

/// One thing of a file.
#[derive(Debug, Default)]
struct Record<'a> {
    /// `Param`, `Entity`, ...
    kind: &'a str,
    /// Keys without the thing's name, values, and the line where each stands.
    fields: Vec<(&'a str, &'a str, usize)>,
    /// The line of `AddThing`.
    end: usize,
}

impl<'a> Record<'a> {
    fn text(&self, key: &str) -> Option<&'a str> {
        let mut fields = self.fields.iter();
        fields.find(|field| field.0 == key).map(|field| field.1)
    }

    fn hex(&self, key: &str) -> Handle {
        let text = self.text(key).unwrap_or("0");
        Handle::from_str_radix(text, 16).unwrap_or(0)
    }

    fn whole(&self, key: &str) -> u32 {
        self.text(key).and_then(|x| x.parse().ok()).unwrap_or(0)
    }

    fn number(&self, key: &str) -> f64 {
        self.text(key).and_then(|x| x.parse().ok()).unwrap_or(0.0)
    }

    fn handle(&self) -> Handle {
        match self.kind {
            "Param" => self.hex("h.v."),
            _ => self.hex("h.v"),
        }
    }
}

/// All things of a file that matter here.
struct Contents<'a> {
    records: Vec<Record<'a>>,
    /// Where a record of a kind and a handle is.
    places: HashMap<(&'a str, Handle), usize>,
}

/// The lines of a file, without their ends; the first one is not text in the files of all versions.
fn lines(bytes: &[u8]) -> Vec<&str> {
    let lines = bytes.split(|&b| b == b'\n');
    lines
        .map(|line| {
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            std::str::from_utf8(line).unwrap_or("")
        })
        .collect()
}

impl<'a> Contents<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self, String> {
        let head = &bytes[..bytes.len().min(64)];
        if !head.windows(10).any(|w| w == b"SolveSpace") {
            return Err("is no SolveSpace file: its first line says otherwise".to_owned());
        }
        let mut contents = Contents {
            records: Vec::new(),
            places: HashMap::new(),
        };
        let mut record = Record::default();
        for (at, line) in lines(bytes).into_iter().enumerate() {
            if let Some((key, value)) = line.split_once('=')
                && let Some((kind, key)) = key.split_once('.')
            {
                record.kind = kind;
                record.fields.push((key, value, at));
            } else if let Some(kind) = line.strip_prefix("Add") {
                record.kind = kind;
                record.end = at;
                let (index, handle) = (contents.records.len(), record.handle());
                contents.places.insert((kind, handle), index);
                contents.records.push(std::mem::take(&mut record));
            }
        }
        Ok(contents)
    }

    fn record(&self, kind: &'static str, handle: Handle) -> Option<&Record<'a>> {
        let index = self.places.get(&(kind, handle))?;
        Some(&self.records[*index])
    }

    fn entity(&self, handle: Handle) -> Option<&Record<'a>> {
        self.record("Entity", handle)
    }

    fn param(&self, handle: Handle) -> f64 {
        let record = self.record("Param", handle);
        record.map_or(0.0, |record| record.number("val"))
    }

    /// The groups in a plane, with their names made different.
    fn sketches(&self) -> Vec<(&Record<'a>, String)> {
        let groups = self.records.iter().filter(|record| record.kind == "Group");
        let groups: Vec<&Record> = groups.filter(|g| g.whole("type") == IN_PLANE).collect();
        let name = |group: &Record| group.text("name").unwrap_or("sketch").to_owned();
        let names: Vec<String> = groups.iter().map(|group| name(group)).collect();
        let named = groups.iter().zip(&names).map(|(group, name)| {
            let alike = names.iter().filter(|other| *other == name).count();
            let name = match alike {
                1 => name.clone(),
                _ => format!("{name}#{:x}", group.handle()),
            };
            (*group, name)
        });
        named.collect()
    }

    /// The work plane of a group in a plane: the active one, or where none is, as after "sketch in 3d", the one in which its
    /// points are drawn, if that is one.
    fn workplane_of(&self, group: &Record) -> Option<Handle> {
        let active = group.hex("activeWorkplane.v");
        if active != 0 {
            return Some(active);
        }
        let entities = self.records.iter().filter(|record| {
            record.kind == "Entity"
                && record.whole("type") == POINT_IN_2D
                && self.request(record.handle(), group.handle()).is_some()
        });
        match each_once(entities.map(|record| record.hex("workplane.v")))[..] {
            [plane] if plane != 0 => Some(plane),
            _ => None,
        }
    }

    /// The request that made an entity, if one of `group` did.
    fn request(&self, entity: Handle, group: Handle) -> Option<&Record<'a>> {
        if entity & 0x8000_0000 != 0 {
            return None;
        }
        let request = self.record("Request", entity >> 16);
        request.filter(|request| request.hex("group.v") == group)
    }

    /// The parameters of a point that a request made.
    fn params_of_point(&self, point: Handle, request: &Record) -> [Handle; 2] {
        let index = point & 0xffff;
        let first = u32::from(request.whole("type") != DATUM_POINT);
        let base = (point & !0xffff) | (16 + 3 * index.saturating_sub(first));
        [base, base + 1]
    }

    fn place_in_space(&self, point: Handle) -> Option<[f64; 3]> {
        let point = self.entity(point)?;
        matches!(point.whole("type"), 2000..=2012)
            .then(|| ["actPoint.x", "actPoint.y", "actPoint.z"].each(|key| point.number(key)))
    }
}

/// A work plane.
#[derive(Debug, Clone, Copy)]
struct Plane {
    origin: [f64; 3],
    u: [f64; 3],
    v: [f64; 3],
}

impl Plane {
    fn new(contents: &Contents, handle: Handle) -> Option<Self> {
        let plane = contents.entity(handle)?;
        let normal = contents.entity(plane.hex("normal.v"))?;
        let origin = contents.place_in_space(plane.hex("point[0].v"))?;
        Some(Self::turned(origin, normal))
    }

    /// Through a place, turned like a normal.
    fn turned(origin: [f64; 3], normal: &Record) -> Self {
        let quaternion = ["w", "vx", "vy", "vz"].each(|k| normal.number(&format!("actNormal.{k}")));
        // What SolveSpace's solver leaves is of length 1 to few digits, and what it means is a rotation.
        let squared: f64 = quaternion.iter().map(|x| x * x).sum();
        let long = match (squared - 1.0).abs() > 4.0 * f64::EPSILON && squared > 0.0 {
            true => squared.sqrt(),
            false => 1.0,
        };
        let [w, x, y, z] = quaternion.each(|x| x / long);
        Plane {
            origin,
            u: [
                w * w + x * x - y * y - z * z,
                2.0 * (w * z + x * y),
                2.0 * (x * z - w * y),
            ],
            v: [
                2.0 * (x * y - w * z),
                w * w - x * x + y * y - z * z,
                2.0 * (w * x + y * z),
            ],
        }
    }

    /// The direction at a right angle to it.
    fn normal(&self) -> [f64; 3] {
        cross(self.u, self.v)
    }

    fn seen(&self, place: [f64; 3]) -> [f64; 2] {
        let from = minus(place, self.origin);
        [self.u, self.v].each(|axis| dot(axis, from))
    }

    fn in_space(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        array(|k| self.origin[k] + u * self.u[k] + v * self.v[k])
    }
}

/// Where a sketch's numbers stand.
#[derive(Debug, Clone)]
pub struct Places {
    plane: Plane,
    /// For each point that can move its parameters and its entity.
    points: Vec<Option<([Handle; 2], Handle)>>,
    /// For each circle, by object, the parameter and the entity of its radius.
    radii: HashMap<usize, (Handle, Handle)>,
}

pub fn list(bytes: &[u8]) -> Result<Vec<Listed>, String> {
    let contents = Contents::new(bytes)?;
    let sketches = contents.sketches().into_iter().map(|(group, name)| {
        let handle = group.handle();
        let of_group =
            |record: &&Record, kind: &str| record.kind == kind && record.hex("group.v") == handle;
        let constraints = contents
            .records
            .iter()
            .filter(|record| of_group(record, "Constraint"))
            .filter(|c| c.whole("reference") == 0 && c.whole("type") != COMMENT);
        Listed {
            name,
            label: None,
            drawn: contents
                .records
                .iter()
                .filter(|r| of_group(r, "Request"))
                .count(),
            constraints: constraints.count(),
        }
    });
    Ok(sketches.collect())
}

const COMMENT: u32 = 1000;

/// SolveSpace's kinds of constraints: numbers and names.
const KINDS: &str = "20 POINTS_COINCIDENT 30 PT_PT_DISTANCE 31 PT_PLANE_DISTANCE 32 PT_LINE_DISTANCE 33 PT_FACE_DISTANCE 34 \
    PROJ_PT_DISTANCE 41 PT_IN_PLANE 42 PT_ON_LINE 43 PT_ON_FACE 50 EQUAL_LENGTH_LINES 51 LENGTH_RATIO 52 \
    EQ_LEN_PT_LINE_D 53 EQ_PT_LN_DISTANCES 54 EQUAL_ANGLE 55 EQUAL_LINE_ARC_LEN 56 LENGTH_DIFFERENCE 60 SYMMETRIC 61 \
    SYMMETRIC_HORIZ 62 SYMMETRIC_VERT 63 SYMMETRIC_LINE 70 AT_MIDPOINT 80 HORIZONTAL 81 VERTICAL 90 DIAMETER 100 \
    PT_ON_CIRCLE 110 SAME_ORIENTATION 120 ANGLE 121 PARALLEL 122 PERPENDICULAR 123 ARC_LINE_TANGENT 124 \
    CUBIC_LINE_TANGENT 125 CURVE_CURVE_TANGENT 130 EQUAL_RADIUS 200 WHERE_DRAGGED";

fn kind_name(kind: u32) -> String {
    let number = kind.to_string();
    let mut words = KINDS
        .split_whitespace()
        .skip_while(|word| **word != *number);
    words
        .nth(1)
        .map_or_else(|| format!("type {kind}"), str::to_owned)
}

/// Products of unit vectors that are rounded differ from exact ones by less than this.
const ROUNDED: f64 = 1e-12;

/// A part of a unit vector, exactly along an axis or across it where it is so but for rounding.
fn straightened(x: f64) -> f64 {
    match x.abs() {
        small if small <= ROUNDED => 0.0,
        large if (large - 1.0).abs() <= ROUNDED => x.signum(),
        _ => x,
    }
}

/// What a constraint names in one of its fields.
#[derive(Clone, Copy)]
enum Sort {
    Point,
    Line,
    /// A circle or an arc.
    Round,
}

/// What a constraint of a kind names, in the order in which krawl's kind has it, and in which field: but for work planes and normals.
/// `None`: there is no such kind.
fn named(kind: u32, has_entity: bool) -> Option<&'static [(Sort, &'static str)]> {
    const A: (Sort, &str) = (Sort::Point, "ptA");
    const B: (Sort, &str) = (Sort::Point, "ptB");
    const LINE_A: (Sort, &str) = (Sort::Line, "entityA");
    const LINE_B: (Sort, &str) = (Sort::Line, "entityB");
    const LINE_C: (Sort, &str) = (Sort::Line, "entityC");
    const LINE_D: (Sort, &str) = (Sort::Line, "entityD");
    const ROUND_A: (Sort, &str) = (Sort::Round, "entityA");
    const ROUND_B: (Sort, &str) = (Sort::Round, "entityB");
    Some(match kind {
        80 | 81 if has_entity => &[LINE_A],
        20 | 30 | 34 | 60..=62 | 80 | 81 => &[A, B],
        31 | 41 | 200 => &[A],
        32 | 42 | 70 => &[A, LINE_A],
        50 | 51 | 56 | 120..=122 => &[LINE_A, LINE_B],
        53 => &[A, LINE_A, B, LINE_B],
        54 => &[LINE_A, LINE_B, LINE_C, LINE_D],
        63 => &[A, B, LINE_A],
        90 => &[ROUND_A],
        100 => &[A, ROUND_A],
        123 => &[ROUND_A, LINE_B],
        125 | 130 => &[ROUND_A, ROUND_B],
        _ => return None,
    })
}

/// A sketch as it is read.
struct Reader<'a> {
    contents: &'a Contents<'a>,
    group: Handle,
    workplane: Handle,
    plane: Plane,
    drawing: Drawing,
    /// The points of entities.
    points: HashMap<Handle, usize>,
    /// The objects of entities: lines, circles, arcs.
    objects: HashMap<Handle, usize>,
    places: Vec<Option<([Handle; 2], Handle)>>,
    radii: HashMap<usize, (Handle, Handle)>,
    /// The drawing's size once all is read, if that is known.
    size: Option<f64>,
}

impl<'a> Reader<'a> {
    /// A sketch with all its constraints, of which the points are all read only in the end: those of other groups are where
    /// constraints name them. `size`: see there.
    fn filled(
        contents: &'a Contents<'a>,
        (group, workplane): (Handle, Handle),
        plane: Plane,
        size: Option<f64>,
    ) -> Self {
        let mut reader = Reader {
            contents,
            group,
            workplane,
            plane,
            drawing: Drawing::default(),
            points: HashMap::new(),
            objects: HashMap::new(),
            places: Vec::new(),
            radii: HashMap::new(),
            size,
        };
        // In the order of the file.
        for record in &contents.records {
            let handle = record.handle();
            if record.kind != "Entity" || contents.request(handle, group).is_none() {
                continue;
            }
            match record.whole("type") {
                POINT_IN_2D => drop(reader.point(handle)),
                LINE | CIRCLE | ARC => drop(reader.object(handle)),
                _ => {}
            }
        }
        for (index, record) in contents.records.iter().enumerate() {
            let is_driving = record.whole("reference") == 0 && record.whole("type") != COMMENT;
            if record.kind != "Constraint" || record.hex("group.v") != group || !is_driving {
                continue;
            }
            reader
                .drawing
                .name(index, format!("c{:03x}", record.handle()));
            if reader.constraint(index).is_none() {
                let named = ["ptA", "ptB", "entityA", "entityB", "entityC", "entityD"];
                let named = named.map(|key| record.hex(&format!("{key}.v")));
                let items: Vec<Item> = named.into_iter().flat_map(|h| reader.items(h)).collect();
                let kind = kind_name(record.whole("type"));
                reader.drawing.keep(index, &kind, items);
            }
        }
        reader
    }

    /// The point that an entity is, in this sketch or outside.
    fn point(&mut self, handle: Handle) -> Option<usize> {
        if let Some(&point) = self.points.get(&handle) {
            return Some(point);
        }
        let entity = self.contents.entity(handle)?;
        let own = self.contents.request(handle, self.group);
        let name = match handle & 0x8000_0000 {
            0 => format!("r{:03x}.{}", handle >> 16, handle & 0xffff),
            _ => format!("x{handle:08x}"),
        };
        let point = match (own, entity.whole("type")) {
            (Some(request), POINT_IN_2D) if entity.hex("workplane.v") == self.workplane => {
                let params = self.contents.params_of_point(handle, request);
                let at = params.each(|param| self.contents.param(param));
                self.places.push(Some((params, handle)));
                self.drawing.point(name, at)
            }
            // A point in space of this very group moves, and is not in its plane.
            (Some(_), POINT_IN_3D) => return None,
            _ => {
                let place = self.contents.place_in_space(handle)?;
                self.places.push(None);
                self.drawing.fixed_point(name, self.plane.seen(place))
            }
        };
        self.points.insert(handle, point);
        Some(point)
    }

    /// The line, circle or arc that an entity is.
    fn object(&mut self, handle: Handle) -> Option<usize> {
        if let Some(&object) = self.objects.get(&handle) {
            return Some(object);
        }
        let entity = self.contents.entity(handle)?;
        let name = match handle & 0x8000_0000 {
            0 => format!("r{:03x}", handle >> 16),
            _ => format!("e{handle:08x}"),
        };
        let point = |k: usize| entity.hex(&format!("point[{k}].v"));
        let own = self.contents.request(handle, self.group).is_some();
        let object = match entity.whole("type") {
            LINE => {
                let ends = [self.point(point(0))?, self.point(point(1))?];
                self.drawing.line(name, ends)?
            }
            ARC => {
                let points = [
                    self.point(point(0))?,
                    self.point(point(1))?,
                    self.point(point(2))?,
                ];
                self.drawing.arc(name, points)?
            }
            CIRCLE => {
                let center = self.point(point(0))?;
                let of_radius = entity.hex("distance.v");
                let param = (handle & !0xffff) | 64;
                let radius = match own {
                    true => self.contents.param(param),
                    false => self.contents.entity(of_radius)?.number("actDistance"),
                };
                let circle = self.drawing.circle(name, center, radius)?;
                if own {
                    self.radii.insert(circle, (param, of_radius));
                } else {
                    let items = vec![Item::Object(circle)];
                    self.drawing.constrain(None, "radii", items, Some(radius));
                }
                circle
            }
            _ => return None,
        };
        self.objects.insert(handle, object);
        Some(object)
    }

    /// What of this sketch an entity is: a point, a line, a circle or an arc, or else the points of an outline of another kind.
    fn items(&self, handle: Handle) -> Vec<Item> {
        let own = self.contents.request(handle, self.group);
        let Some(entity) = own.and_then(|_| self.contents.entity(handle)) else {
            return Vec::new();
        };
        let point = |handle: Handle| self.points.get(&handle).copied().map(Item::Point);
        let object = self.objects.get(&handle).copied().map(Item::Object);
        match object.or_else(|| point(handle)) {
            Some(item) => vec![item],
            None => (0..12)
                .filter_map(|k| point(entity.hex(&format!("point[{k}].v"))))
                .collect(),
        }
    }

    /// A line that stays where it is.
    fn fixed_line(&mut self, name: &str, ends: [[f64; 2]; 2]) -> Option<usize> {
        let [a, b] = [("1", ends[0]), ("2", ends[1])].each(|(which, at)| {
            self.places.push(None);
            self.drawing.fixed_point(format!("{name}.{which}"), at)
        });
        self.drawing.line(name.to_owned(), [a, b])
    }

    /// The line in which a work plane of another group cuts that of the sketch, and whether it does so at a right angle.
    /// A point of the sketch is in the plane where it is on the line.
    fn trace(&mut self, handle: Handle) -> Option<(usize, bool)> {
        let entity = self.contents.entity(handle)?;
        let is_own = self.contents.request(handle, self.group).is_some();
        if is_own || entity.whole("type") != WORKPLANE {
            return None;
        }
        let plane = Plane::new(self.contents, handle)?;
        let normal = plane.normal();
        let from = minus(plane.origin, self.plane.origin);
        let across = [self.plane.u, self.plane.v].each(|axis| straightened(dot(normal, axis)));
        let is_right = dot(normal, self.plane.normal()).abs() <= ROUNDED;
        if let Some(&line) = self.objects.get(&handle) {
            return Some((line, is_right));
        }
        let [a, b] = across;
        let squared = a * a + b * b;
        // Parallel planes have no line in common, and nearly parallel ones none that is known well.
        if squared < 1e-6 {
            return None;
        }
        let off = dot(normal, from) / squared;
        let base = [a * off, b * off].each(|x| if x.abs() <= ROUNDED { 0.0 } else { x });
        let far = self.drawing.size() / squared.sqrt();
        let ends = [base, [base[0] - b * far, base[1] + a * far]];
        let line = self.fixed_line(&format!("w{handle:08x}"), ends)?;
        self.objects.insert(handle, line);
        Some((line, is_right))
    }

    /// A line along a normal of another group, if that lies in the plane of the sketch.
    fn along_normal(&mut self, handle: Handle) -> Option<usize> {
        if let Some(&line) = self.objects.get(&handle) {
            return Some(line);
        }
        let entity = self.contents.entity(handle)?;
        let is_own = self.contents.request(handle, self.group).is_some();
        if is_own || !NORMALS.contains(&entity.whole("type")) {
            return None;
        }
        let normal = Plane::turned([0.0; 3], entity).normal();
        if dot(normal, self.plane.normal()).abs() > ROUNDED {
            return None;
        }
        let far = self.drawing.size();
        let end = [self.plane.u, self.plane.v].each(|axis| straightened(dot(normal, axis)) * far);
        let line = self.fixed_line(&format!("n{handle:08x}"), [[0.0; 2], end])?;
        self.objects.insert(handle, line);
        Some(line)
    }

    /// Whether a line is one of the sketch's own, or parallel to its plane.
    fn is_in_plane(&self, handle: Handle) -> bool {
        if self.contents.request(handle, self.group).is_some() {
            return true;
        }
        let ends = self.contents.entity(handle).and_then(|entity| {
            let end = |key: &str| self.contents.place_in_space(entity.hex(key));
            Some([end("point[0].v")?, end("point[1].v")?])
        });
        let Some([from, to]) = ends else {
            return false;
        };
        let along = minus(to, from);
        dot(along, self.plane.normal()).abs() <= ROUNDED * dot(along, along).sqrt()
    }

    /// Whether all that a constraint is about lies in the sketch's plane.
    fn is_about_plane(&self, record: &Record) -> bool {
        let keys = ["ptA", "ptB", "entityA", "entityB", "entityC", "entityD"];
        let named = keys.each(|key| record.hex(&format!("{key}.v")));
        named
            .into_iter()
            .filter(|&handle| handle != 0)
            .all(|handle| {
                if self.contents.request(handle, self.group).is_some() {
                    return true;
                }
                let Some(entity) = self.contents.entity(handle) else {
                    return false;
                };
                let points: Vec<Handle> = match entity.whole("type") {
                    LINE => [0, 1]
                        .each(|k| entity.hex(&format!("point[{k}].v")))
                        .to_vec(),
                    2000..=2012 => vec![handle],
                    _ => return false,
                };
                points.into_iter().all(|point| {
                    let normal = self.plane.normal();
                    self.contents.place_in_space(point).is_some_and(|place| {
                        let from = dot(normal, minus(place, self.plane.origin));
                        let size = place.iter().fold(1.0f64, |most, x| most.max(x.abs()));
                        from.abs() <= ROUNDED * size
                    })
                })
            })
    }

    /// The direction of a line, as it is drawn.
    fn direction(&self, line: usize) -> Option<[f64; 2]> {
        let Shape::Line(ends) = *self.drawing.shape(line) else {
            return None;
        };
        let [from, to] = ends.each(|p| self.drawing.at(p));
        Some([to[0] - from[0], to[1] - from[1]])
    }

    /// The cosine of the angle from one line to another, as they are drawn, if that is so far from zero that coordinates
    /// that are made equal do not change its sign.
    fn clear_cosine(&self, one: usize, other: usize) -> Option<f64> {
        let ([a, b], [c, d]) = (self.direction(one)?, self.direction(other)?);
        let (long, short) = (a.hypot(b), c.hypot(d));
        let cosine = (a * c + b * d) / (long * short);
        // An end moves by no more than twice SNAP of the largest coordinate, along each axis; `size` is no less than that
        // divided by the root of 2.
        let size = self.size.unwrap_or_else(|| self.drawing.size());
        let moved = 4.0 * size * SNAP;
        (cosine.abs() > 4.0 * moved * (1.0 / long + 1.0 / short)).then_some(cosine)
    }

    fn line(&mut self, handle: Handle) -> Option<usize> {
        let object = self.object(handle)?;
        self.drawing.if_line(object)
    }

    fn round(&mut self, handle: Handle) -> Option<usize> {
        let object = self.object(handle)?;
        self.drawing.if_round(object)
    }

    /// Puts a constraint down; `None` where there is no kind for it.
    fn constraint(&mut self, index: usize) -> Option<()> {
        let record = &self.contents.records[index];
        let source = Some(index);
        let handle = |key: &str| record.hex(&format!("{key}.v"));
        let (value, kind) = (record.number("valA"), record.whole("type"));
        let is_other = record.whole("other") != 0;
        let workplane = handle("workplane");
        if workplane != self.workplane && !matches!(kind, 20 | 50 | 90 | 130 | 200) {
            // In space, of things that are all in the sketch's plane, these say what they say there.
            let is_same_in_space = matches!(kind, 30 | 32 | 42 | 51 | 54 | 56 | 70 | 120..=122);
            if workplane != 0 || !is_same_in_space || !self.is_about_plane(record) {
                return None;
            }
        }
        if kind == 34 && value == 0.0 {
            // Of zero the figure does not tell which sign is the file's, so it could not be given back.
            return None;
        }
        let named = named(kind, handle("entityA") != 0)?;
        let (mut numbers, mut items) = (Vec::new(), Vec::new());
        for &(sort, key) in named {
            let number = match sort {
                Sort::Point => self.point(handle(key))?,
                Sort::Line => self.line(handle(key))?,
                Sort::Round => self.round(handle(key))?,
            };
            numbers.push(number);
            items.push(match sort {
                Sort::Point => Item::Point(number),
                _ => Item::Object(number),
            });
        }
        let mut said = None;
        let key = match (kind, &numbers[..]) {
            (20, _) => "coincident",
            (30, &[a, b]) => {
                self.drawing.distance(index, [a, b], value);
                return Some(());
            }
            (32, _) if value != 0.0 => {
                said = Some(value.abs());
                "distances"
            }
            (32 | 42 | 100, _) => "on",
            (31 | 41 | 60, _) => {
                let (line, is_right) = self.trace(handle("entityA"))?;
                items.push(Item::Object(line));
                match (kind, value) {
                    (31, 0.0) | (41, _) => "on",
                    // About a plane at another angle only points in it are mirror images of points of the sketch, and the
                    // distance in the plane of the sketch is another.
                    _ if !is_right => return None,
                    (60, _) => "symmetric",
                    _ => {
                        said = Some(value.abs());
                        "distances"
                    }
                }
            }
            (34, &[a, b]) => {
                let along = handle("entityA");
                let line = match self.line(along) {
                    Some(line) if self.is_in_plane(along) => line,
                    // The distance along a line that leaves the sketch's plane is another than that along its image there.
                    Some(_) => return None,
                    None => self.along_normal(along)?,
                };
                let [dx, dy] = self.direction(line)?;
                let Shape::Line(ends) = *self.drawing.shape(line) else {
                    return None;
                };
                let [from, to] = [a, b].each(|p| self.drawing.at(p));
                let apart = [to[0] - from[0], to[1] - from[1]];
                // Along a line that stays where it is, parallel to an axis.
                let is_fixed = ends.iter().all(|&p| self.places[p].is_none());
                let (key, now) = match (dx, dy) {
                    (_, 0.0) if is_fixed => ("dx", apart[0]),
                    (0.0, _) if is_fixed => ("dy", apart[1]),
                    _ => {
                        items.push(Item::Object(line));
                        ("along", dx * apart[0] + dy * apart[1])
                    }
                };
                // The sign in the file goes by the line's direction; what it means is seen in the figure.
                said = Some(if now < 0.0 { -value.abs() } else { value.abs() });
                key
            }
            (50 | 130, _) => "equal",
            (51 | 56, &[a, b]) => {
                if a == b || (kind == 51 && value <= 0.0) {
                    return None;
                }
                said = Some(value);
                if kind == 51 { "ratios" } else { "differences" }
            }
            (53, _) => "equal_distances",
            (54, &[a, b, c, d]) => {
                let sign = if is_other { -1.0 } else { 1.0 };
                let (one, other) = (sign * self.clear_cosine(a, b)?, self.clear_cosine(c, d)?);
                // Which of the angles of lines are equal is read off the figure, which has to tell that, as the file does.
                let is_told = one * other > 0.0;
                if !is_told || a == b || c == d {
                    return None;
                }
                "equal_angles"
            }
            (61 | 62, _) => {
                items.push(Item::Axis(usize::from(kind == 61)));
                "symmetric"
            }
            (63, _) => "symmetric",
            (70, _) => "midpoint",
            (80, _) => "horizontal",
            (81, _) => "vertical",
            (90, _) => {
                said = Some(value);
                "diameters"
            }
            (120, &[a, b]) => match value.abs() {
                0.0 | 180.0 => "parallel",
                angle if angle < 180.0 => {
                    // Which of both angles it is the file says at a right angle too.
                    items = [self.drawing.directed(a, is_other), vec![Item::Object(b)]].concat();
                    said = Some(angle);
                    "angles"
                }
                _ => return None,
            },
            (121, _) => "parallel",
            (122, _) => "perpendicular",
            (123, &[arc, line]) => {
                let end = self.end(arc, is_other)?;
                let sides = [(line, end), (arc, end)];
                return self.drawing.touch_at(index, sides).then_some(());
            }
            (125, &[a, b]) => {
                let one = self.end(a, is_other)?;
                let other = self.end(b, record.whole("other2") != 0)?;
                let sides = [(a, one), (b, other)];
                return self.drawing.touch_at(index, sides).then_some(());
            }
            (200, _) => "fixed",
            _ => return None,
        };
        self.drawing.constrain(source, key, items, said);
        Some(())
    }

    /// The end of an arc, its last if `last`.
    fn end(&self, arc: usize, last: bool) -> Option<usize> {
        match *self.drawing.shape(arc) {
            Shape::Arc { start, end, .. } => Some(if last { end } else { start }),
            _ => None,
        }
    }
}

pub fn read(bytes: &[u8], index: usize) -> Result<Imported, String> {
    let contents = Contents::new(bytes)?;
    let sketches = contents.sketches();
    let (group, name) = &sketches[index];
    let workplane = contents.workplane_of(group);
    let workplane = workplane.ok_or_else(|| {
        format!("{name}: the group has no active work plane, and nothing in it is drawn in one: it is a sketch in space, which krawl does not read")
    })?;
    let plane = Plane::new(&contents, workplane).ok_or_else(|| {
        format!("{name}: its work plane, the entity {workplane:08x}, is not in the file, or has no origin or normal there")
    })?;
    let filled = |size| Reader::filled(&contents, (group.handle(), workplane), plane, size);
    // How far coordinates move depends on the largest of all, and with it which signs are certain: what the first
    // reading finds of that is there for the second.
    let size = filled(None).drawing.size();
    let reader = filled(Some(size));
    let Reader {
        drawing,
        places,
        radii,
        ..
    } = reader;
    let places = AllPlaces::SolveSpace(Places {
        plane,
        points: places,
        radii,
    });
    Ok(drawing.finish(name.clone(), "a SolveSpace file", places))
}

pub fn rewrite(
    imported: &Imported,
    places: &Places,
    bytes: &[u8],
    problem: &Problem,
    figure: &Figure,
) -> Result<Vec<u8>, String> {
    let contents = Contents::new(bytes)?;
    let mut edits = Edits::default();
    let missing = |what: &str| format!("{what} is missing: this is another file");
    for (place, &[x, y, _]) in places.points.iter().zip(figure.points) {
        let Some((params, entity)) = place else {
            continue;
        };
        let mut moves = false;
        for (param, value) in params.iter().zip([x, y]) {
            let record = contents.record("Param", *param);
            let record = record.ok_or_else(|| missing("a parameter"))?;
            moves |= record.number("val") != value;
            edits.number(record, "val", value);
        }
        // What stays where it is in the plane stays where the file has it in space.
        if !moves {
            continue;
        }
        let record = contents.entity(*entity).ok_or_else(|| missing("a point"))?;
        let there = places.plane.in_space([x, y]);
        for (axis, value) in ["x", "y", "z"].iter().zip(there) {
            edits.number(record, &format!("actPoint.{axis}"), value);
        }
    }
    for (object, &radius) in figure.radii.iter().enumerate() {
        let Some((param, entity)) = places.radii.get(&object) else {
            continue;
        };
        let record = contents.record("Param", *param);
        let record = record.ok_or_else(|| missing("a radius"))?;
        edits.number(record, "val", radius);
        if let Some(record) = contents.entity(*entity) {
            edits.number(record, "actDistance", radius);
        }
    }
    for changed in super::changed(imported, problem) {
        let changed = changed?;
        let record = contents.records.get(changed.source);
        let record = record.ok_or_else(|| missing("a constraint"))?;
        let value = match changed.is_angle {
            // Without a sense of turn, which the places of points tell.
            true => 180.0 - (changed.value.rem_euclid(360.0) - 180.0).abs(),
            false => changed.value,
        };
        // A distance from a line has a sign in the file, a projection that of its line.
        let sign = if record.number("valA") * changed.before < 0.0 {
            -1.0
        } else {
            1.0
        };
        edits.number(record, "valA", sign * value);
    }
    Ok(edits.apply(bytes))
}

/// Changes of lines.
#[derive(Default)]
struct Edits {
    /// New texts of lines, `None` to leave the line out.
    replaced: HashMap<usize, Option<String>>,
    /// New lines before a line.
    inserted: HashMap<usize, Vec<String>>,
}

impl Edits {
    /// Sets a number, unless it is that already as a double.
    fn number(&mut self, record: &Record, key: &str, value: f64) {
        if record.number(key) == value {
            return;
        }
        // Zeros are left out, as SolveSpace does.
        let line = format!("{}.{key}={value:.20}", record.kind);
        let field = record.fields.iter().find(|field| field.0 == key);
        match field {
            Some(&(_, _, at)) => drop(self.replaced.insert(at, (value != 0.0).then_some(line))),
            None if value != 0.0 => self.inserted.entry(record.end).or_default().push(line),
            None => {}
        }
    }

    fn apply(&self, bytes: &[u8]) -> Vec<u8> {
        let mut out = Vec::with_capacity(bytes.len() + 64);
        for (at, line) in bytes.split_inclusive(|&b| b == b'\n').enumerate() {
            let end: &[u8] = if line.ends_with(b"\r\n") {
                b"\r\n"
            } else {
                b"\n"
            };
            for new in self.inserted.get(&at).into_iter().flatten() {
                out.extend_from_slice(new.as_bytes());
                out.extend_from_slice(end);
            }
            match self.replaced.get(&at) {
                None => out.extend_from_slice(line),
                Some(None) => {}
                Some(Some(new)) => {
                    out.extend_from_slice(new.as_bytes());
                    out.extend_from_slice(end);
                }
            }
        }
        out
    }
}
