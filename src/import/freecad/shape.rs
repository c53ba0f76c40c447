//! Edges and vertices of the shapes in a FreeCAD file, which are stored in Open CASCADE's text format (`BRepTools::Write`, `.brp`).
//!
//! They are numbered from 1 as FreeCAD numbers them, in the order in which `TopExp::MapShapes` finds them: depth first, each once,
//! whatever its orientation.

use crate::interval::vector::{cross, distance, dot, length, minus};
use crate::places::array;
use std::collections::HashSet;
use std::str::{FromStr, SplitAsciiWhitespace};

type Vector = [f64; 3];

/// More parts are not gone through, nor displacements of which their places are products.
const MOST: usize = 4_000_000;
/// No place is the product of as many displacements.
const MOST_FACTORS: u32 = 100;
/// Directions as near as this are parallel, and points as near as this are one: `Precision::Confusion()`.
const CONFUSION: f64 = 1e-7;

/// What can be drawn of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Curve {
    Line {
        at: Vector,
        direction: Vector,
    },
    Circle {
        center: Vector,
        axes: [Vector; 3],
        radius: f64,
    },
    Other,
}

/// An edge in space, with the places where its curve begins and ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Edge {
    Line([Vector; 2]),
    Arc {
        center: Vector,
        axis: Vector,
        radius: f64,
        ends: [Vector; 2],
    },
    /// On another curve.
    Other,
    /// Without a curve.
    Nothing,
}

/// What is seen of an edge or a vertex in a plane, in its coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    Line([[f64; 2]; 2]),
    Point([f64; 2]),
    Circle {
        center: [f64; 2],
        radius: f64,
    },
    /// Its ends in the order in which they are met counter-clockwise.
    Arc {
        center: [f64; 2],
        ends: [[f64; 2]; 2],
    },
}

/// Two ends in the order in which they are met counter-clockwise.
pub fn counter_clockwise<T>([first, last]: [T; 2], is_clockwise: bool) -> [T; 2] {
    match is_clockwise {
        true => [last, first],
        false => [first, last],
    }
}

/// What FreeCAD draws for a part of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// Nothing: an edge without a curve, as at a pole of a sphere.
    Nothing,
    /// An outline that is no line, circle, arc or point.
    Other,
    /// A line, circle, arc or point.
    Outline(Outline),
}

/// The edges and vertices of a shape.
#[derive(Debug, Clone, Default)]
pub struct Shape {
    edges: Vec<Edge>,
    vertices: Vec<Vector>,
}

/// A plane by a point of it and the directions of its axes, the last one at a right angle to it.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    pub origin: Vector,
    pub axes: [Vector; 3],
}

/// A displacement: the images of the axes' directions, and of the origin.
#[derive(Debug, Clone, Copy)]
struct Motion([Vector; 3], Vector);

/// A product of displacements by their numbers in the file, and their powers.
type Word = Vec<(usize, i32)>;

/// A part, with the parts that it has and where they are.
struct Part {
    kind: Kind,
    parts: Vec<(usize, usize)>,
}

#[derive(Clone, Copy)]
enum Kind {
    Vertex(Vector),
    /// The number of the curve, where it is, and between which parameters.
    Edge(Option<(usize, usize, [f64; 2])>),
    Other,
}

struct Tokens<'a>(SplitAsciiWhitespace<'a>);

impl Tokens<'_> {
    fn next<T: FromStr>(&mut self) -> Option<T> {
        self.0.next()?.parse().ok()
    }

    fn skip(&mut self, count: usize) -> Option<()> {
        count
            .checked_sub(1)
            .map_or(Some(()), |last| self.0.nth(last).map(drop))
    }

    /// A curve of a kind that is not drawn, of so many numbers.
    fn other(&mut self, numbers: usize) -> Option<Curve> {
        self.skip(numbers).map(|()| Curve::Other)
    }

    fn vector(&mut self) -> Option<Vector> {
        Some([self.next()?, self.next()?, self.next()?])
    }
}

/// What follows a heading and the number of its entries, with that number.
fn section<'a>(text: &'a str, heading: &str) -> Option<(Tokens<'a>, usize)> {
    let at = text.find(&format!("\n{heading} "))?;
    let mut tokens = Tokens(text[at..].split_ascii_whitespace());
    tokens.skip(1)?;
    let count = tokens.next()?;
    (count <= text.len()).then_some((tokens, count))
}

/// A point so much along directions from another one.
fn along(at: Vector, directions: &[Vector], by: &[f64]) -> Vector {
    array(|k| {
        at[k]
            + directions
                .iter()
                .zip(by)
                .map(|(d, by)| d[k] * by)
                .sum::<f64>()
    })
}

impl Motion {
    const NONE: Motion = Motion(
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [0.0; 3],
    );

    fn of_direction(&self, v: Vector) -> Vector {
        along([0.0; 3], &self.0, &v)
    }

    fn of(&self, p: Vector) -> Vector {
        along(self.1, &self.0, &p)
    }

    /// Of a displacement without a scale.
    fn inverse(&self) -> Motion {
        let axes = array(|k| array(|i| self.0[i][k]));
        let back = Motion(axes, [0.0; 3]).of_direction(self.1);
        Motion(axes, back.map(|x| -x))
    }

    /// This one after another.
    fn after(&self, first: &Motion) -> Motion {
        Motion(
            first.0.map(|axis| self.of_direction(axis)),
            self.of(first.1),
        )
    }
}

/// The product of two, without what cancels.
fn product(first: &[(usize, i32)], second: &[(usize, i32)]) -> Word {
    let mut out = first.to_vec();
    for &(which, power) in second {
        match out.last_mut().filter(|last| last.0 == which) {
            Some(last) => {
                last.1 = last.1.saturating_add(power);
                if last.1 == 0 {
                    out.pop();
                }
            }
            None => out.push((which, power)),
        }
    }
    out
}

/// Where parts are.
struct Locations {
    /// Those that are no products, and nothing for the others.
    given: Vec<Motion>,
    words: Vec<Word>,
}

impl Locations {
    fn read(text: &str) -> Option<Self> {
        let (mut tokens, count) = section(text, "Locations")?;
        let mut all = Locations {
            given: vec![Motion::NONE],
            words: vec![Vec::new()],
        };
        let mut work = 0;
        for number in 1..=count {
            let mut given = Motion::NONE;
            let mut word = vec![(number, 1)];
            match tokens.next::<u8>()? {
                1 => {
                    for row in 0..3 {
                        for axis in &mut given.0 {
                            axis[row] = tokens.next()?;
                        }
                        given.1[row] = tokens.next()?;
                    }
                }
                2 => {
                    word = Vec::new();
                    loop {
                        let which: usize = tokens.next()?;
                        if which == 0 {
                            break;
                        }
                        let power: i32 = tokens.next()?;
                        let factor = all.words.get(which)?.iter();
                        let factor: Word = match power > 0 {
                            true => factor.copied().collect(),
                            false => factor.rev().map(|&(w, p)| (w, -p)).collect(),
                        };
                        let times = if factor.is_empty() {
                            0
                        } else {
                            power.unsigned_abs()
                        };
                        for _ in 0..times {
                            word = product(&factor, &word);
                            work += word.len();
                            let count = word.iter().map(|(_, power)| power.unsigned_abs());
                            if work > MOST || times.max(count.sum()) > MOST_FACTORS {
                                return None;
                            }
                        }
                    }
                }
                _ => return None,
            }
            all.given.push(given);
            all.words.push(word);
        }
        Some(all)
    }

    fn motion(&self, word: &[(usize, i32)]) -> Motion {
        let mut out = Motion::NONE;
        for &(which, power) in word {
            let one = self.given[which];
            let one = if power < 0 { one.inverse() } else { one };
            for _ in 0..power.unsigned_abs() {
                out = out.after(&one);
            }
        }
        out
    }
}

/// A curve, as far as it is a line or a circle.
fn curve(tokens: &mut Tokens) -> Option<Curve> {
    let mut is_offset = false;
    loop {
        let kind = tokens.next::<u8>()?;
        let curve = match kind {
            1 => Curve::Line {
                at: tokens.vector()?,
                direction: tokens.vector()?,
            },
            2 => {
                let (center, z) = (tokens.vector()?, tokens.vector()?);
                let axes = [tokens.vector()?, tokens.vector()?, z];
                Curve::Circle {
                    center,
                    axes,
                    radius: tokens.next()?,
                }
            }
            // A part of the curve that follows, and one beside it.
            8 | 9 => {
                is_offset |= kind == 9;
                tokens.skip(if kind == 8 { 2 } else { 4 })?;
                continue;
            }
            3 | 5 => tokens.other(14)?,
            4 => tokens.other(13)?,
            6 => {
                let (is_rational, degree) = (tokens.next::<usize>()?, tokens.next::<usize>()?);
                tokens.other(
                    degree
                        .saturating_add(1)
                        .saturating_mul(3 + is_rational.min(1)),
                )?
            }
            7 => {
                let is_rational = tokens.next::<usize>()?;
                tokens.skip(2)?;
                let (poles, knots) = (tokens.next::<usize>()?, tokens.next::<usize>()?);
                let poles = poles.saturating_mul(3 + is_rational.min(1));
                tokens.other(knots.saturating_mul(2).saturating_add(poles))?
            }
            _ => return None,
        };
        return Some(if is_offset { Curve::Other } else { curve });
    }
}

/// A vertex, edge or other part, up to its flags.
fn kind(tokens: &mut Tokens, name: &str, is_second_version: bool) -> Option<Kind> {
    Some(match name {
        "Ve" => {
            tokens.skip(1)?;
            let at = tokens.vector()?;
            loop {
                tokens.skip(1)?;
                match tokens.next::<u8>()? {
                    0 => break Kind::Vertex(at),
                    1 => tokens.skip(2)?,
                    _ => tokens.skip(3)?,
                }
            }
        }
        "Ed" => {
            tokens.skip(4)?;
            let mut on = None;
            loop {
                let kind = tokens.next::<u8>()?;
                let points = if is_second_version { 4 } else { 0 };
                match kind {
                    0 => break Kind::Edge(on),
                    1 => {
                        let (curve, at) = (tokens.next()?, tokens.next()?);
                        let range = [tokens.next()?, tokens.next()?];
                        on = on.or(Some((curve, at, range)));
                    }
                    2 => tokens.skip(5 + points)?,
                    3 => {
                        tokens.skip(1)?;
                        // The continuity may stand right behind the number: `2CN`.
                        let is_apart = tokens.0.next()?.ends_with(|c: char| c.is_ascii_digit());
                        tokens.skip(4 + points + usize::from(is_apart))?;
                    }
                    4 => tokens.skip(5)?,
                    5 => tokens.skip(2)?,
                    6 => tokens.skip(3)?,
                    7 => tokens.skip(4)?,
                    _ => return None,
                }
            }
        }
        "Fa" => {
            tokens.skip(4)?;
            Kind::Other
        }
        "Wi" | "Sh" | "So" | "CS" | "Co" => Kind::Other,
        _ => return None,
    })
}

/// Reads the parts, and which is the whole with where it is.
fn parts(text: &str) -> Option<(Vec<Part>, (usize, usize))> {
    let (mut tokens, count) = section(text, "TShapes")?;
    let is_second_version = text.contains("CASCADE Topology V2");
    // They name each other by their places from the end.
    let named = |name: &str| -> Option<usize> {
        let number: usize = name.get(1..)?.parse().ok()?;
        count.checked_sub(number).filter(|_| number > 0)
    };
    let mut all = Vec::new();
    for place in 0..count {
        let name = tokens.0.next()?;
        let kind = kind(&mut tokens, name, is_second_version)?;
        // A face may have triangles.
        if tokens.0.next()? == "2" && name == "Fa" {
            tokens.skip(2)?;
        }
        let mut parts = Vec::new();
        loop {
            match tokens.0.next()? {
                "*" => break,
                name => parts.push((named(name).filter(|&part| part < place)?, tokens.next()?)),
            }
        }
        all.push(Part { kind, parts });
    }
    let whole = (named(tokens.0.next()?)?, tokens.next()?);
    Some((all, whole))
}

impl Shape {
    /// Reads a shape. `None`: it is not in this format.
    pub fn read(text: &str) -> Option<Self> {
        let locations = Locations::read(text)?;
        let (mut tokens, count) = section(text, "Curves")?;
        let curves: Option<Vec<Curve>> = (0..count).map(|_| curve(&mut tokens)).collect();
        let (curves, (parts, root)) = (curves?, parts(text)?);
        let mut shape = Shape::default();
        let mut found: HashSet<(usize, Word)> = HashSet::new();
        let mut open = vec![(root, Word::new())];
        let mut steps = 0;
        while let Some(((number, at), outer)) = open.pop() {
            steps += 1 + outer.len();
            if steps > MOST {
                return None;
            }
            let (part, at) = (
                parts.get(number)?,
                product(&outer, locations.words.get(at)?),
            );
            let is_new = match part.kind {
                Kind::Other => false,
                _ => found.insert((number, at.clone())),
            };
            match part.kind {
                Kind::Vertex(p) if is_new => shape.vertices.push(locations.motion(&at).of(p)),
                Kind::Edge(on) if is_new => {
                    let edge = match on {
                        None => Edge::Nothing,
                        Some((curve, place, range)) => {
                            let at = product(&at, locations.words.get(place)?);
                            let curve = curves.get(curve.checked_sub(1)?)?;
                            Edge::new(curve, range, &locations.motion(&at))
                        }
                    };
                    shape.edges.push(edge);
                }
                _ => {}
            }
            let inner = part.parts.iter().rev();
            open.extend(inner.map(|&part| (part, at.clone())));
        }
        Some(shape)
    }

    /// What is seen in a plane of a part, `Edge3` or `Vertex1`. `None`: it has no such part, or that is no edge or vertex.
    pub fn seen(&self, part: &str, plane: &Plane) -> Option<Seen> {
        let number = |name: &str| -> Option<usize> {
            let number: usize = part.strip_prefix(name)?.parse().ok()?;
            number.checked_sub(1)
        };
        if let Some(vertex) = number("Vertex") {
            let at = plane.seen(*self.vertices.get(vertex)?);
            return Some(Seen::Outline(Outline::Point(at)));
        }
        Some(match *self.edges.get(number("Edge")?)? {
            Edge::Nothing => Seen::Nothing,
            Edge::Other => Seen::Other,
            Edge::Line(ends) => {
                let ends = ends.map(|end| plane.seen(end));
                let far = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
                Seen::Outline(match far < CONFUSION {
                    true => Outline::Point(ends[0]),
                    false => Outline::Line(ends),
                })
            }
            Edge::Arc { axis, .. } if length(cross(axis, plane.axes[2])) > CONFUSION => Seen::Other,
            Edge::Arc {
                center,
                axis,
                radius,
                ends,
            } => {
                let center = plane.seen(center);
                // The square, as there.
                if distance(ends[0], ends[1]).powi(2) < CONFUSION {
                    return Some(Seen::Outline(Outline::Circle { center, radius }));
                }
                let is_clockwise = dot(axis, plane.axes[2]) < 0.0;
                let ends = ends.map(|end| plane.seen(end));
                let ends = counter_clockwise(ends, is_clockwise);
                Seen::Outline(Outline::Arc { center, ends })
            }
        })
    }
}

impl Edge {
    fn new(curve: &Curve, range: [f64; 2], motion: &Motion) -> Self {
        match *curve {
            Curve::Line { at, direction } => {
                Edge::Line(range.map(|t| motion.of(along(at, &[direction], &[t]))))
            }
            Curve::Circle {
                center,
                axes,
                radius,
            } => Edge::Arc {
                center: motion.of(center),
                axis: motion.of_direction(axes[2]),
                radius,
                ends: range.map(|t| {
                    let by = [radius * t.cos(), radius * t.sin()];
                    motion.of(along(center, &axes[..2], &by))
                }),
            },
            Curve::Other => Edge::Other,
        }
    }
}

impl Plane {
    fn seen(&self, p: Vector) -> [f64; 2] {
        let from = minus(p, self.origin);
        array(|k| dot(from, self.axes[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle about (1, 2, 3) and a line along z from there, as Open CASCADE writes them: as they are after they were moved by 10 along y,
    /// and the circle again after it was moved twice.
    const TEXT: &str = "\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 2\n1\n1 0 0 0 \n0 1 0 10 \n0 0 1 0 \n2  1 2 0\nCurve2ds 0\n\
        Curves 3\n2 1 2 3 0 0 1 1 0 0 0 1 0 4\n8 0 5\n1 1 2 3 0 0 1\n7 1 0 1 2 2 0 0 0 1 1 1 1 1 0 2 1 2\nPolygon3D 0\nSurfaces 0\n\nTShapes 5\n\
        Ve\n1e-07\n5 2 3\n0 0\n\n0101101\n*\nEd\n 1e-07 1 1 0\n1  1 0 0 6.283185307179586\n3  1 2CN 1 0 0 1\n0\n\n0101000\n+5 0 -5 0 *\n\
        Ed\n 1e-07 1 1 0\n1  2 0 0 5\n0\n\n0101000\n+5 0 *\nFa\n0  1e-07 1 0\n2  1\n0101000\n+4 0 -4 0 +3 1 *\nCo\n\n1100000\n+2 1 +4 2 *\n\n+1 0 ";

    #[test]
    fn edges_are_numbered_as_they_are_met() {
        let shape = Shape::read(TEXT).unwrap();
        let above = Plane {
            origin: [0.0; 3],
            axes: [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
        };
        let circle = |y: f64| {
            Some(Seen::Outline(Outline::Circle {
                center: [y, 1.0],
                radius: 4.0,
            }))
        };
        assert_eq!(shape.seen("Edge1", &above), circle(12.0));
        assert_eq!(shape.seen("Edge3", &above), circle(22.0));
        assert_eq!(
            shape.seen("Edge2", &above),
            Some(Seen::Outline(Outline::Point([22.0, 1.0])))
        );
        let ahead = Plane {
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
            ..above
        };
        let line = [[1.0, 3.0], [1.0, 8.0]];
        let line = Some(Seen::Outline(Outline::Line(line)));
        assert_eq!(shape.seen("Edge2", &ahead), line);
        assert_eq!(shape.seen("Edge1", &ahead), Some(Seen::Other));
        let vertex = Some(Seen::Outline(Outline::Point([5.0, 3.0])));
        assert_eq!(shape.seen("Vertex1", &ahead), vertex);
        for part in ["Edge4", "Edge0", "Vertex4", "Face1", ""] {
            assert_eq!(shape.seen(part, &ahead), None);
        }
    }

    #[test]
    fn an_edge_without_a_curve_is_nothing() {
        let text = TEXT.replacen("1  2 0 0 5\n", "", 1);
        let ahead = Plane {
            origin: [0.0; 3],
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
        };
        let shape = Shape::read(&text).unwrap();
        assert_eq!(shape.seen("Edge2", &ahead), Some(Seen::Nothing));
    }

    #[test]
    fn broken_texts_are_no_shapes() {
        for end in 0..TEXT.len() - 4 {
            assert!(Shape::read(&TEXT[..end]).is_none(), "{end}");
        }
        for (here, there) in [
            ("+5 0 -5", "+1 0 -5"),
            ("2  1 2 0", "2  7 2 0"),
            ("2  1 2 0", "2  1 1000 0"),
        ] {
            assert!(Shape::read(&TEXT.replacen(here, there, 1)).is_none());
        }
    }
}
