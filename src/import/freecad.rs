//! FreeCAD's `.FCStd`: an archive whose `Document.xml` has the sketches' geometry and constraints.
//!
//! Geometry is counted from 0; −1 and −2 are the axes, −3 and below geometry of other objects, which older versions
//! do not store. A constraint names edges, or points of edges: 1 the start, 2 the end, 3 the centre. What constraints
//! mean is that of FreeCAD's `Sketch.cpp` and planegcs. The values of expressions are stored; where a dimension is set, what is tied
//! to it by expressions follows.

mod computed;
mod elsewhere;
mod followed;
mod formula;
mod quantity;
mod rewrite;
mod shape;

use super::drawing::Drawing;
use super::{Imported, Listed, Places as AllPlaces};
use crate::places::Each as _;
use crate::problem::{Item, Shape};
use computed::Numbers;
use elsewhere::Shapes;
pub use followed::{computed, followed};
pub use rewrite::rewrite;
use roxmltree::{Document, Node};
use shape::{Outline, Seen, counter_clockwise};
use std::collections::{HashMap, HashSet};
use std::io::{Cursor, Read};
use std::ops::Range;
use std::str::FromStr;
use zip::ZipArchive;

const DOCUMENT: &str = "Document.xml";
/// Where the centre of a circle or arc stands.
const CENTER: [&str; 2] = ["CenterX", "CenterY"];
/// What stands for "no geometry".
const NONE: i64 = -2000;

fn archive(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, String> {
    ZipArchive::new(Cursor::new(bytes)).map_err(|e| format!("is no FreeCAD file: {e}"))
}

fn document(bytes: &[u8]) -> Result<String, String> {
    let mut archive = archive(bytes)?;
    let part = archive.by_name(DOCUMENT);
    let part = part.map_err(|e| format!("there is no {DOCUMENT} in it: {e}"))?;
    let mut text = String::new();
    part.take(super::MAX_SIZE as u64)
        .read_to_string(&mut text)
        .map_err(|e| format!("{DOCUMENT} in it cannot be read: {e}"))?;
    if text.len() >= super::MAX_SIZE {
        return Err(format!(
            "{DOCUMENT} in it is larger than the {} MiB that are read",
            super::MAX_SIZE >> 20
        ));
    }
    Ok(text)
}

fn parse(text: &str) -> Result<Document<'_>, String> {
    Document::parse(text).map_err(|e| format!("{DOCUMENT} in it: {e}"))
}

/// The objects, with their names and types.
fn objects<'a>(document: &'a Document<'a>) -> Vec<(Node<'a, 'a>, &'a str, Option<&'a str>)> {
    let all = document.descendants();
    let declared = all.filter(|n| n.has_tag_name("Object"));
    let kinds = declared.filter_map(|n| Some((n.attribute("name")?, n.attribute("type")?)));
    let kinds: HashMap<&str, &str> = kinds.collect();
    let data = document
        .descendants()
        .filter(|n| n.has_tag_name("ObjectData"));
    let objects = data.flat_map(|n| n.children().filter(|n| n.has_tag_name("Object")));
    objects
        .filter_map(|object| {
            let name = object.attribute("name")?;
            Some((object, name, kinds.get(name).copied()))
        })
        .collect()
}

/// What a constraint names: edges, each with the position of a point of it, or 0 for all of it.
fn sides(constraint: Node) -> [(i64, i64); 3] {
    let side = |name: &str| {
        let position = format!("{name}Pos");
        (whole(constraint, name), whole(constraint, &position))
    };
    ["First", "Second", "Third"].map(side)
}

/// The sketch objects, with their names.
fn sketches<'a>(document: &'a Document<'a>) -> Vec<(Node<'a, 'a>, String)> {
    let all = objects(document).into_iter();
    let sketches = all.filter(|(_, _, kind)| is_sketch(*kind));
    sketches
        .map(|(object, name, _)| (object, name.to_owned()))
        .collect()
}

fn is_sketch(kind: Option<&str>) -> bool {
    matches!(
        kind,
        Some("Sketcher::SketchObject" | "Sketcher::SketchObjectPython")
    )
}

fn property<'a>(object: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    object
        .descendants()
        .find(|n| n.has_tag_name("Property") && n.attribute("name") == Some(name))
}

/// A number of an attribute; zero where there is none.
fn number<T: FromStr + Default>(node: Node, key: &str) -> T {
    let text = node.attribute(key);
    text.and_then(|x| x.parse().ok()).unwrap_or_default()
}

fn whole(node: Node, key: &str) -> i64 {
    number(node, key)
}

/// The elements of a kind in a property of an object.
fn listed<'a>(object: Node<'a, 'a>, key: &str, tag: &'static str) -> Vec<Node<'a, 'a>> {
    let all = property(object, key).into_iter();
    all.flat_map(|n| n.descendants().filter(|n| n.has_tag_name(tag)))
        .collect()
}

/// What FreeCAD shows for an object's name.
fn label<'a>(object: Node<'a, 'a>) -> Option<&'a str> {
    listed(object, "Label", "String")
        .first()?
        .attribute("value")
}

fn constraints<'a>(object: Node<'a, 'a>) -> Vec<Node<'a, 'a>> {
    listed(object, "Constraints", "Constrain")
}

fn geometry<'a>(object: Node<'a, 'a>, key: &str) -> Vec<Node<'a, 'a>> {
    listed(object, key, "Geometry")
}

fn is_driving(constraint: Node) -> bool {
    constraint.attribute("IsDriving") != Some("0") && constraint.attribute("IsActive") != Some("0")
}

pub fn list(bytes: &[u8]) -> Result<Vec<Listed>, String> {
    let text = document(bytes)?;
    let document = parse(&text)?;
    let listed = sketches(&document)
        .into_iter()
        .map(|(object, name)| Listed {
            label: label(object)
                .filter(|label| *label != name)
                .map(str::to_owned),
            name,
            drawn: geometry(object, "Geometry").len(),
            constraints: constraints(object)
                .into_iter()
                .filter(|c| is_driving(*c))
                .count(),
        });
    Ok(listed.collect())
}

/// An edge, or what else is drawn; nothing of all this where it is of a kind that krawl does not have.
#[derive(Debug, Clone, Copy, Default)]
struct Drawn {
    /// Of a line or an arc.
    ends: Option<[usize; 2]>,
    /// Of a circle or an arc; of a point that is drawn alone, the point.
    center: Option<usize>,
    /// The line, circle or arc, unless it is too small to be one.
    object: Option<usize>,
}

/// Which number of an edge stands in an attribute.
#[derive(Debug, Clone, Copy)]
enum Number {
    Coordinate(usize, usize),
    Radius(usize),
    /// The distance of two points.
    Apart(usize, usize),
    /// The angle at the centre, against the x axis: centre, point, the angle of the arc's own x axis, clockwise.
    Angle(usize, usize, f64, bool),
}

/// Where a sketch's numbers stand.
#[derive(Debug, Clone)]
pub struct Places {
    /// Where they are in `Document.xml`, and what they were.
    numbers: Vec<(Range<usize>, Number, f64)>,
    /// For each constraint of the file where its value is.
    values: Vec<Range<usize>>,
    /// What expressions compute, and from what.
    pub computed: Numbers,
}

/// The angle of an arc's own x axis, and whether its angles are clockwise: about a normal downwards they begin at the left (`gp_Ax2`).
fn turn_of(arc: Node) -> (f64, bool) {
    let turned = number(arc, "AngleXU");
    match number::<f64>(arc, "NormalZ") < 0.0 {
        true => (std::f64::consts::PI - turned, true),
        false => (turned, false),
    }
}

/// What is drawn by an element, if that is of a kind that krawl has.
fn outline(node: Node) -> Option<Outline> {
    let at = |keys: [&str; 2]| keys.each(|key| number(node, key));
    let radius: f64 = number(node, "Radius");
    Some(match node.tag_name().name() {
        "LineSegment" => Outline::Line([at(["StartX", "StartY"]), at(["EndX", "EndY"])]),
        "GeomPoint" => Outline::Point(at(["X", "Y"])),
        "Circle" => Outline::Circle {
            center: at(CENTER),
            radius,
        },
        "ArcOfCircle" => {
            let (center, (turned, clockwise)) = (at(CENTER), turn_of(node));
            let end = |key: &str| {
                let angle: f64 = number(node, key);
                let angle = if clockwise {
                    turned - angle
                } else {
                    turned + angle
                };
                let [x, y] = center;
                [x + radius * angle.cos(), y + radius * angle.sin()]
            };
            // FreeCAD's sketches have the start of an arc where it begins counter-clockwise.
            let ends = counter_clockwise(["StartAngle", "EndAngle"].map(end), clockwise);
            Outline::Arc { center, ends }
        }
        _ => return None,
    })
}

struct Reader {
    drawing: Drawing,
    edges: HashMap<i64, Drawn>,
    numbers: Vec<(Range<usize>, Number, f64)>,
    /// The size of the drawing.
    size: f64,
}

impl Reader {
    fn place(&mut self, node: Node, key: &str, number: Number) {
        if let Some(attribute) = node.attribute_node(key) {
            let before = attribute.value().parse().unwrap_or(f64::NAN);
            self.numbers.push((attribute.range_value(), number, before));
        }
    }

    /// A point, whose coordinates stand in these attributes where it is of this sketch.
    fn point(&mut self, name: String, at: [f64; 2], own: Option<(Node, [&str; 2])>) -> usize {
        let point = self.drawing.point(name, at);
        if let Some((shape, keys)) = own {
            for (axis, key) in keys.into_iter().enumerate() {
                self.place(shape, key, Number::Coordinate(point, axis));
            }
        }
        point
    }

    /// Reads one piece of geometry of this sketch, or one of another object that the sketch keeps.
    fn read(&mut self, id: i64, geometry: Node) {
        let kind = geometry.attribute("type").unwrap_or("");
        let is_own = id >= 0;
        let mut read = geometry
            .children()
            .filter(|_| kind.starts_with("Part::Geom"));
        let read = read.find_map(|node| Some((node, outline(node)?)));
        match read {
            Some((node, outline)) => self.draw(id, outline, is_own.then_some(node)),
            None => {
                self.edges.insert(id, Drawn::default());
                if is_own {
                    let kind = kind.trim_start_matches("Part::Geom");
                    self.drawing.keep_outline(kind, format!("e{}", id + 1));
                }
            }
        }
    }

    /// Draws an outline; `own`: where its numbers stand, of this sketch. Geometry of other objects stays where it is.
    fn draw(&mut self, id: i64, outline: Outline, own: Option<Node>) {
        let name = match own {
            None => format!("external{}", -2 - id),
            Some(_) => format!("e{}", id + 1),
        };
        let (ends, center, object) = match outline {
            Outline::Line([a, b]) => {
                let start = own.map(|node| (node, ["StartX", "StartY"]));
                let end = own.map(|node| (node, ["EndX", "EndY"]));
                let a = self.point(format!("{name}.start"), a, start);
                let b = self.point(format!("{name}.end"), b, end);
                (Some([a, b]), None, self.drawing.line(name, [a, b]))
            }
            Outline::Point(at) => {
                let own = own.map(|node| (node, ["X", "Y"]));
                (None, Some(self.point(name, at, own)), None)
            }
            Outline::Circle { center, radius } => {
                let own_center = own.map(|node| (node, CENTER));
                let center = self.point(format!("{name}.center"), center, own_center);
                let object = self.drawing.circle(name, center, radius);
                if let (Some(object), Some(node)) = (object, own) {
                    self.place(node, "Radius", Number::Radius(object));
                }
                (None, Some(center), object)
            }
            Outline::Arc { center, ends } => {
                let own_center = own.map(|node| (node, CENTER));
                let center = self.point(format!("{name}.center"), center, own_center);
                // The ends are not stored.
                let [a, b] = [("start", ends[0]), ("end", ends[1])]
                    .map(|(which, at)| self.drawing.point(format!("{name}.{which}"), at));
                if let Some(node) = own {
                    let (turned, clockwise) = turn_of(node);
                    let [first, last] = counter_clockwise([a, b], clockwise);
                    let angle = |end| Number::Angle(center, end, turned, clockwise);
                    self.place(node, "Radius", Number::Apart(center, a));
                    self.place(node, "StartAngle", angle(first));
                    self.place(node, "EndAngle", angle(last));
                }
                let object = self.drawing.arc(name, [center, a, b]);
                (Some([a, b]), Some(center), object)
            }
        };
        let drawn = Drawn {
            ends,
            center,
            object,
        };
        self.edges.insert(id, drawn);
        if own.is_none() {
            let items = self.items((id, 0));
            items.into_iter().for_each(|item| self.drawing.fix(item));
        }
    }

    /// The axes, when they are first asked for.
    fn edge(&mut self, id: i64) -> Option<Drawn> {
        if !self.edges.contains_key(&id) && matches!(id, -1 | -2) {
            let other = self.edges.get(&(-3 - id));
            let origin = match other.and_then(|axis| axis.ends) {
                Some(ends) => ends[0],
                None => self.drawing.fixed_point("origin".to_owned(), [0.0, 0.0]),
            };
            let (name, at) = match id {
                -1 => ("x", [self.size, 0.0]),
                _ => ("y", [0.0, self.size]),
            };
            let unit = self.drawing.fixed_point(format!("{name}-unit"), at);
            let object = self.drawing.line(format!("{name}-line"), [origin, unit]);
            let axis = Drawn {
                ends: Some([origin, unit]),
                center: None,
                object,
            };
            self.edges.insert(id, axis);
        }
        self.edges.get(&id).copied()
    }

    fn point_of(&mut self, (id, position): (i64, i64)) -> Option<usize> {
        let drawn = self.edge(id)?;
        match (position, drawn.ends) {
            (1, Some(ends)) => Some(ends[0]),
            (2, Some(ends)) if id != -1 && id != -2 => Some(ends[1]),
            (1 | 2, None) if drawn.object.is_none() => drawn.center,
            (3, _) => drawn.center,
            _ => None,
        }
    }

    fn object_of(&mut self, id: i64) -> Option<usize> {
        self.edge(id)?.object
    }

    /// What a constraint names of what is drawn: a point of an edge, or all of it.
    fn items(&self, (id, position): (i64, i64)) -> Vec<Item> {
        let drawn = self.edges.get(&id).copied().unwrap_or_default();
        let points = match (position, drawn.ends, drawn.center, drawn.object) {
            (1 | 2, Some(ends), ..) => vec![ends[position as usize - 1]],
            (3, _, Some(center), _) => vec![center],
            (.., Some(object)) => return vec![Item::Object(object)],
            // A point, or too small to be an object.
            (_, ends, center, None) => {
                let ends = ends.into_iter().flatten();
                center.into_iter().chain(ends).collect()
            }
        };
        points.into_iter().map(Item::Point).collect()
    }

    fn line_of(&mut self, id: i64) -> Option<usize> {
        let object = self.object_of(id)?;
        self.drawing.if_line(object)
    }

    fn round_of(&mut self, id: i64) -> Option<usize> {
        let object = self.object_of(id)?;
        self.drawing.if_round(object)
    }

    /// Two points: the ends of a line that is named alone, or what is named of two edges.
    fn ends_of(&mut self, first: (i64, i64), second: (i64, i64)) -> Option<[usize; 2]> {
        match (first.1, second.0) {
            (0, NONE) => {
                let drawn = self.edge(first.0)?;
                drawn.ends.filter(|_| drawn.center.is_none())
            }
            _ => self.points_of([first, second]),
        }
    }

    fn points_of(&mut self, both: [(i64, i64); 2]) -> Option<[usize; 2]> {
        Some([self.point_of(both[0])?, self.point_of(both[1])?])
    }

    /// Puts a constraint down; `None` where there is no kind for it.
    fn constraint(&mut self, index: usize, node: Node) -> Option<()> {
        let source = Some(index);
        let [first, second, third] = sides(node);
        let value: f64 = number(node, "Value");
        let has_second = second.0 != NONE;
        let points = |points: [usize; 2]| points.each(Item::Point).to_vec();
        let objects = |objects: [usize; 2]| objects.each(Item::Object).to_vec();
        let mut said = None;
        let (key, items) = match whole(node, "Type") {
            1 => ("coincident", points(self.points_of([first, second])?)),
            kind @ (2 | 3) => {
                let key = if kind == 2 { "horizontal" } else { "vertical" };
                (key, points(self.ends_of(first, second)?))
            }
            4 => {
                let lines = [self.line_of(first.0)?, self.line_of(second.0)?];
                ("parallel", objects(lines))
            }
            5 if third.0 == NONE => return self.tangent(index, first, second),
            6 if has_second && second.1 <= 0 => {
                let other = Item::Object(self.object_of(second.0)?);
                said = (value != 0.0).then_some(value.abs());
                let (one, at_nothing) = match first.1 {
                    0 => (Item::Object(self.object_of(first.0)?), "tangent"),
                    _ => (Item::Point(self.point_of(first)?), "on"),
                };
                let key = if said.is_none() {
                    at_nothing
                } else {
                    "distances"
                };
                (key, vec![one, other])
            }
            6 => {
                let ends = self.ends_of(first, second)?;
                self.drawing.distance(index, ends, value);
                return Some(());
            }
            kind @ (7 | 8) => {
                said = Some(value);
                let is_x = kind == 7;
                if first.1 != 0 && !has_second {
                    let key = if is_x { "x" } else { "y" };
                    (key, vec![Item::Point(self.point_of(first)?)])
                } else {
                    let ends = self.ends_of(first, second)?;
                    (if is_x { "dx" } else { "dy" }, points(ends))
                }
            }
            9 if third.0 == NONE => {
                let degrees = degrees(value);
                said = Some(degrees);
                // Beyond 0 and 180 degrees the sense says which of two angles it is.
                let is_between = degrees > 0.0 && degrees < 180.0;
                let key = if is_between { "angles" } else { "turns" };
                // How far an arc goes round, counter-clockwise.
                let drawn = self.edge(first.0)?;
                if let (Some(ends), Some(center), false) = (drawn.ends, drawn.center, has_second) {
                    (key, [ends[0], center, ends[1]].each(Item::Point).to_vec())
                } else {
                    let one = self.line_of(first.0)?;
                    let other = self.line_of(if has_second { second.0 } else { -1 })?;
                    let legs = match has_second {
                        // Away from the end that the constraint names.
                        true => [
                            self.drawing.directed(one, first.1 == 2),
                            self.drawing.directed(other, second.1 == 2),
                        ]
                        .concat(),
                        false => objects([other, one]),
                    };
                    (key, legs)
                }
            }
            10 if third.0 == NONE => return self.perpendicular(index, first, second),
            kind @ (11 | 18) => {
                said = Some(value);
                let key = if kind == 11 { "radii" } else { "diameters" };
                (key, vec![Item::Object(self.round_of(first.0)?)])
            }
            12 => {
                let edges = [self.object_of(first.0)?, self.object_of(second.0)?];
                let is_line = |edge| matches!(self.drawing.shape(edge), Shape::Line(_));
                let [one, other] = edges.each(is_line);
                if one != other {
                    return None;
                }
                ("equal", objects(edges))
            }
            13 => {
                let (p, edge) = (self.point_of(first)?, self.object_of(second.0)?);
                ("on", vec![Item::Point(p), Item::Object(edge)])
            }
            14 => {
                let [a, b] = self.points_of([first, second])?;
                let mirror = match third {
                    (-1, 0) => Item::Axis(0),
                    (-2, 0) => Item::Axis(1),
                    (id, 0) => Item::Object(self.line_of(id)?),
                    _ => Item::Point(self.point_of(third)?),
                };
                ("symmetric", vec![Item::Point(a), Item::Point(b), mirror])
            }
            17 => {
                let items = self.items((first.0, 0));
                items.into_iter().for_each(|item| self.drawing.fix(item));
                return Some(());
            }
            _ => return None,
        };
        self.drawing.constrain(source, key, items, said);
        Some(())
    }

    /// Says that edges meet, end to end or an end on the other edge: each side is an edge and the point of it.
    fn meet(
        &mut self,
        index: usize,
        [first, second]: [(i64, i64); 2],
        edges: [usize; 2],
    ) -> Option<[(usize, usize); 2]> {
        let source = Some(index);
        if first.1 != 0 && second.1 != 0 {
            let points = self.points_of([first, second])?;
            let items = points.each(Item::Point).to_vec();
            self.drawing.constrain(source, "coincident", items, None);
            return Some([(edges[0], points[0]), (edges[1], points[1])]);
        }
        let (end, [own, other]) = match first.1 {
            0 => (self.point_of(second)?, [edges[1], edges[0]]),
            _ => (self.point_of(first)?, edges),
        };
        let items = vec![Item::Point(end), Item::Object(other)];
        self.drawing.constrain(source, "on", items, None);
        Some([(own, end), (other, end)])
    }

    /// End to end, end to edge, or edge to edge.
    fn tangent(&mut self, index: usize, first: (i64, i64), second: (i64, i64)) -> Option<()> {
        let edges = [self.object_of(first.0)?, self.object_of(second.0)?];
        if (first.1, second.1) == (0, 0) {
            self.drawing.touch(index, edges);
            return Some(());
        }
        let sides = self.meet(index, [first, second], edges)?;
        self.drawing.touch_at(index, sides).then_some(())
    }

    fn perpendicular(&mut self, index: usize, first: (i64, i64), second: (i64, i64)) -> Option<()> {
        let source = Some(index);
        if (first.1, second.1) == (0, 0)
            && let Some(line) = self.line_of(first.0).or(self.line_of(second.0))
        {
            // A line at a right angle to a circle goes through its centre.
            let other = [first.0, second.0].map(|id| self.edge(id));
            for edge in other.into_iter().flatten() {
                if let (Some(center), Some(_)) = (edge.center, edge.object) {
                    let items = vec![Item::Point(center), Item::Object(line)];
                    self.drawing.constrain(source, "on", items, None);
                    return Some(());
                }
            }
        }
        let lines = [self.line_of(first.0)?, self.line_of(second.0)?];
        if (first.1, second.1) != (0, 0) {
            self.meet(index, [first, second], lines)?;
        }
        let items = lines.each(Item::Object).to_vec();
        self.drawing.constrain(source, "perpendicular", items, None);
        Some(())
    }
}

/// An angle in degrees: see the head of [`crate::import`].
fn degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let rounded = (degrees * 1e9).round() / 1e9;
    let back = rounded.to_radians();
    if (back - radians).abs() <= f64::EPSILON * radians.abs() {
        rounded
    } else {
        degrees
    }
}

/// FreeCAD's names of its kinds of constraints, by number.
const KINDS: &str = "None Coincident Horizontal Vertical Parallel Tangent Distance DistanceX DistanceY Angle Perpendicular \
    Radius Equal PointOnObject Symmetric InternalAlignment SnellsLaw Block Diameter Weight";

fn kind_name(kind: i64) -> String {
    let known = usize::try_from(kind).ok();
    let name = known.and_then(|k| KINDS.split_whitespace().nth(k));
    name.map_or_else(|| format!("type {kind}"), str::to_owned)
}

/// What a constraint is called: its name, or its place.
fn constraint_name(index: usize, node: Node) -> String {
    let given = node.attribute("Name").filter(|name| !name.is_empty());
    given.map_or_else(|| format!("Constraint{}", index + 1), str::to_owned)
}

pub fn read(bytes: &[u8], index: usize) -> Result<Imported, String> {
    let text = document(bytes)?;
    let document = parse(&text)?;
    let (object, name) = sketches(&document).swap_remove(index);
    let own = geometry(object, "Geometry");
    let mut reader = Reader {
        drawing: Drawing::default(),
        edges: HashMap::new(),
        numbers: Vec::new(),
        size: 1.0,
    };
    for (id, geometry) in own.iter().enumerate() {
        reader.read(id as i64, *geometry);
    }
    let places = reader
        .numbers
        .iter()
        .filter(|n| matches!(n.1, Number::Coordinate(..)));
    let far = places.fold(0.0f64, |max, n| max.max(n.2.abs()));
    if far > 0.0 {
        reader.size = 2f64.powi(far.log2().round() as i32);
    }
    // Of other objects what constraints name; the first two that are kept are the axes.
    let named: HashSet<i64> = constraints(object)
        .into_iter()
        .filter(|c| is_driving(*c))
        .flat_map(|c| sides(c).map(|(id, _)| id))
        .collect();
    let kept = geometry(object, "ExternalGeo").into_iter().enumerate();
    for (at, geometry) in kept.skip(2) {
        let id = -1 - at as i64;
        if named.contains(&id) {
            reader.read(id, geometry);
        }
    }
    if property(object, "ExternalGeo").is_none()
        && named.iter().any(|&id| id <= -3 && id != NONE)
        && let Some(shapes) = Shapes::new(&document, bytes, object)
    {
        let mut id = -3;
        for link in listed(object, "ExternalGeometry", "Link") {
            match shapes.seen(link) {
                Some(Seen::Nothing) => continue,
                Some(Seen::Outline(outline)) if named.contains(&id) => {
                    reader.draw(id, outline, None)
                }
                Some(_) => {}
                // Neither is it known which are the next.
                None => break,
            }
            id -= 1;
        }
    }
    let mut values = Vec::new();
    for (index, node) in constraints(object).into_iter().enumerate() {
        values.push(
            node.attribute_node("Value")
                .map_or(0..0, |value| value.range_value()),
        );
        if !is_driving(node) {
            continue;
        }
        reader.drawing.name(index, constraint_name(index, node));
        if reader.constraint(index, node).is_none() {
            let sides = sides(node);
            let is_elsewhere =
                |(id, _): &(i64, i64)| *id <= -3 && *id != NONE && !reader.edges.contains_key(id);
            let kind = kind_name(whole(node, "Type"));
            let kind = match sides.iter().any(is_elsewhere) {
                true => format!("{kind} to another object"),
                false => kind,
            };
            // Of what is about directions and curves all of the edges, not the ends alone that it names: tangents, angles, right angles,
            // what belongs to a curve, refraction, weights.
            let is_of_edges = matches!(whole(node, "Type"), 5 | 9 | 10 | 15 | 16 | 19);
            let sides = sides.map(|(id, end)| (id, if is_of_edges { 0 } else { end }));
            let own = sides.into_iter().filter(|(id, _)| *id >= 0);
            let items = own.flat_map(|side| reader.items(side));
            let items: Vec<Item> = items.collect();
            reader.drawing.keep(index, &kind, items);
        }
    }
    let computed = Numbers::read(&document, &name);
    let places = Places {
        numbers: reader.numbers,
        values,
        computed,
    };
    let mut imported = reader
        .drawing
        .finish(name, "a FreeCAD file", AllPlaces::FreeCad(places));
    if let AllPlaces::FreeCad(places) = &imported.places {
        imported.tied = followed::tied(&imported, &places.computed);
    }
    Ok(imported)
}
