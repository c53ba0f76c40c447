//! A sketch as it is read, in krawl's words.

use super::{Imported, Places};
use crate::constraint::order_of_kind;
use crate::order::InOrder;
use crate::places::Each as _;
use crate::problem::{
    Constraint, Decimal, Distance, HomotopyChoices, Item, Kept, Object, Point, Problem, Shape,
    Target,
};
use crate::sets::Joined;
use std::collections::BTreeMap;

/// Coordinates that a constraint makes one and that differ by more than this part of the sketch's size are left as
/// they are drawn; otherwise they are made one. Programs store what their solvers leave, about eight digits.
pub const SNAP: f64 = 1e-5;

/// What constraints and dimensions of a file are: an index into those that were read.
pub type Source = usize;

/// A sketch in the making: points, circles, arcs, constraints, in the order in which they are read.
#[derive(Debug, Default)]
pub struct Drawing {
    places: Vec<(String, [f64; 2])>,
    objects: Vec<Object>,
    distances: Vec<(Distance, Option<Source>)>,
    constraints: Vec<(Constraint, Option<Source>)>,
    names: BTreeMap<Source, String>,
    kept: Kept,
    /// Points and objects that stay where they are, and whether they are said to.
    held: Vec<(Item, bool)>,
    /// Points of one place by constraint.
    joined: Joined,
    tangents: Vec<Tangent>,
}

/// Two edges that touch somewhere.
#[derive(Debug)]
struct Tangent {
    edges: [usize; 2],
    source: Source,
}

impl Drawing {
    /// A point.
    pub fn point(&mut self, name: String, at: [f64; 2]) -> usize {
        self.places.push((name, at));
        self.joined.add()
    }

    /// A point that stays where it is.
    pub fn fixed_point(&mut self, name: String, at: [f64; 2]) -> usize {
        let point = self.point(name, at);
        self.constrain(None, "fixed", vec![Item::Point(point)], None);
        point
    }

    /// Where a point is drawn.
    pub fn at(&self, point: usize) -> [f64; 2] {
        self.places[point].1
    }

    /// A power of two near the largest coordinate so far, 1 if all are zero.
    pub fn size(&self) -> f64 {
        let all = self.places.iter().flat_map(|(_, at)| *at);
        match all.fold(0.0f64, |max, x| max.max(x.abs())) {
            0.0 => 1.0,
            far => 2f64.powi(far.log2().round() as i32),
        }
    }

    fn object(&mut self, name: String, shape: Shape) -> usize {
        self.objects.push(Object { name, shape });
        self.objects.len() - 1
    }

    /// A line, or nothing where its ends are in one place.
    pub fn line(&mut self, name: String, ends: [usize; 2]) -> Option<usize> {
        let [a, b] = ends.each(|p| self.at(p));
        (a != b).then(|| self.object(name, Shape::Line(ends)))
    }

    /// A circle.
    pub fn circle(&mut self, name: String, center: usize, radius: f64) -> Option<usize> {
        let radius = decimal(radius).filter(Decimal::is_positive)?;
        Some(self.object(name, Shape::Round { center, radius }))
    }

    /// An arc.
    pub fn arc(&mut self, name: String, [center, start, end]: [usize; 3]) -> Option<usize> {
        let far = |p: usize| self.at(center) != self.at(p);
        (far(start) && far(end)).then(|| self.object(name, Shape::Arc { center, start, end }))
    }

    /// What an object is.
    pub fn shape(&self, object: usize) -> &Shape {
        &self.objects[object].shape
    }

    /// The object, if it is a line.
    pub fn if_line(&self, object: usize) -> Option<usize> {
        matches!(self.shape(object), Shape::Line(_)).then_some(object)
    }

    /// The object, if it is a circle or an arc.
    pub fn if_round(&self, object: usize) -> Option<usize> {
        (!matches!(self.shape(object), Shape::Line(_))).then_some(object)
    }

    /// A line as an angle takes it: by its ends in the other order where it is the angle with the line reversed.
    pub fn directed(&self, line: usize, reversed: bool) -> Vec<Item> {
        match *self.shape(line) {
            Shape::Line([a, b]) if reversed => vec![Item::Point(b), Item::Point(a)],
            _ => vec![Item::Object(line)],
        }
    }

    /// What a constraint of the file is called there.
    pub fn name(&mut self, source: Source, name: String) {
        self.names.insert(source, name);
    }

    /// A constraint that there is no kind for: these, which it names, stay where they are.
    pub fn keep(&mut self, source: Source, kind: &str, items: impl IntoIterator<Item = Item>) {
        self.kept
            .constraints
            .extend(self.names.get(&source).cloned());
        *self.kept.kinds.entry(kind.to_owned()).or_default() += 1;
        self.held.extend(items.into_iter().map(|item| (item, true)));
    }

    /// What is of another object stays where it is.
    #[cfg(feature = "freecad")]
    pub fn fix(&mut self, item: Item) {
        self.held.push((item, false));
    }

    /// An outline that there is no kind for, which stays as it is.
    #[cfg(feature = "freecad")]
    pub fn keep_outline(&mut self, kind: &str, name: String) {
        *self.kept.kinds.entry(kind.to_owned()).or_default() += 1;
        self.kept.what.push(name);
    }

    /// Holds what stays where it is.
    fn hold(&mut self) {
        for (item, is_said) in std::mem::take(&mut self.held) {
            let (name, points) = match item {
                Item::Point(p) => (&self.places[p].0, vec![p]),
                Item::Object(o) => {
                    let Object { name, shape } = &self.objects[o];
                    let points = match *shape {
                        Shape::Line(ends) => ends.to_vec(),
                        Shape::Arc { center, start, .. } => vec![center, start],
                        // With its centre.
                        _ => Vec::new(),
                    };
                    (name, points)
                }
                Item::Axis(_) => continue,
            };
            if is_said {
                if self.kept.what.contains(name) {
                    continue;
                }
                self.kept.what.push(name.clone());
            }
            for p in points {
                if !self.is_fixed(p) {
                    self.constrain(None, "fixed", vec![Item::Point(p)], None);
                }
            }
            let Item::Object(o) = item else { continue };
            match self.objects[o].shape {
                Shape::Round { .. } => self.constrain(None, "fixed", vec![item], None),
                // As far from the centre as the start, it is told by how far it is turned from there.
                Shape::Arc { center, start, end } if !self.is_fixed(end) => {
                    let [from, to] = [start, end].map(|p| {
                        let ([cx, cy], [x, y]) = (self.at(center), self.at(p));
                        (y - cy).atan2(x - cx).to_degrees()
                    });
                    let items = [start, center, end].each(Item::Point).to_vec();
                    let turned = (to - from).rem_euclid(360.0);
                    self.constrain(None, "turns", items, Some(turned));
                }
                _ => {}
            }
        }
    }

    /// Whether a point stays where it is, or one that is in the same place by constraint.
    fn is_fixed(&self, point: usize) -> bool {
        let place = self.joined.of(point);
        self.constraints.iter().any(|(c, _)| {
            c.kind == "fixed" && matches!(c.items[0], Item::Point(p) if self.joined.of(p) == place)
        })
    }

    /// A constraint.
    pub fn constrain(
        &mut self,
        source: Option<Source>,
        kind: &str,
        items: Vec<Item>,
        value: Option<f64>,
    ) {
        if kind == "coincident"
            && let [Item::Point(a), Item::Point(b)] = items[..]
            && !self.joined.join([b, a])
        {
            // Said before.
            return;
        }
        let value = value.map(|value| decimal(value).unwrap_or_else(|| Decimal::from(0)));
        let constraint = Constraint {
            kind: kind.to_owned(),
            items,
            value,
            formula: None,
        };
        let is_there = |(other, _): &(Constraint, _)| {
            other.kind == constraint.kind && other.items == constraint.items
        };
        if constraint.value.is_none() && self.constraints.iter().any(is_there) {
            return;
        }
        self.constraints.push((constraint, source));
    }

    /// A distance between two points.
    pub fn distance(&mut self, source: Source, points: [usize; 2], length: f64) {
        match decimal(length.abs()).filter(Decimal::is_positive) {
            Some(length) => {
                let target = Target::Length(length);
                let distance = Distance { points, target };
                self.distances.push((distance, Some(source)));
            }
            None => {
                let items = points.each(Item::Point).to_vec();
                self.constrain(Some(source), "coincident", items, None);
            }
        }
    }

    /// Two edges (objects) touch, wherever that is.
    #[cfg(feature = "freecad")]
    pub fn touch(&mut self, source: Source, edges: [usize; 2]) {
        self.tangents.push(Tangent { edges, source });
    }

    /// Says that a line and an arc (or two arcs, or lines) have one direction at a point that both go through: each
    /// side is an object and the point of it.
    pub fn touch_at(&mut self, source: Source, sides: [(usize, usize); 2]) -> bool {
        let [one, other] = sides.each(|(object, point)| match *self.shape(object) {
            Shape::Line(ends) => Some((true, ends)),
            Shape::Arc { center, .. } | Shape::Round { center, .. } => {
                Some((false, [center, point]))
            }
            _ => None,
        });
        let (Some((one_is_line, a)), Some((other_is_line, b))) = (one, other) else {
            return false;
        };
        let kind = if one_is_line == other_is_line {
            "parallel"
        } else {
            "perpendicular"
        };
        let items = a.into_iter().chain(b).map(Item::Point).collect();
        self.constrain(Some(source), kind, items, None);
        true
    }

    /// Points at which two edges meet by constraint: a point of each.
    fn shared(&self, edges: [usize; 2]) -> Option<[usize; 2]> {
        let ends = edges.map(|edge| match *self.shape(edge) {
            Shape::Line(ends) => ends.to_vec(),
            Shape::Arc { start, end, .. } => vec![start, end],
            _ => Vec::new(),
        });
        // Points that are on the other edge by constraint.
        let on = |point: usize, edge: usize| {
            let place = self.joined.of(point);
            self.constraints.iter().any(|(c, _)| {
                c.kind == "on"
                    && c.items.last() == Some(&Item::Object(edge))
                    && matches!(c.items[0], Item::Point(p) if self.joined.of(p) == place)
            })
        };
        let both = ends[0]
            .iter()
            .flat_map(|&a| ends[1].iter().map(move |&b| [a, b]));
        let meet = both
            .clone()
            .find(|&[a, b]| self.joined.of(a) == self.joined.of(b));
        meet.or_else(|| {
            let first = ends[0].iter().find(|&&a| on(a, edges[1]));
            let second = ends[1].iter().find(|&&b| on(b, edges[0]));
            first.or(second).map(|&p| [p, p])
        })
    }

    /// The sketch, of which the numbers stand in these places.
    pub fn finish(mut self, name: String, source: &str, places: Places) -> Imported {
        for Tangent { edges, source } in std::mem::take(&mut self.tangents) {
            if let Some([a, b]) = self.shared(edges)
                && self.touch_at(source, [(edges[0], a), (edges[1], b)])
            {
                continue;
            }
            if let Shape::Line(ends) = *self.shape(edges[1])
                && self.if_line(edges[0]).is_some()
            {
                for end in ends {
                    let items = vec![Item::Point(end), Item::Object(edges[0])];
                    self.constrain(Some(source), "on", items, None);
                }
                continue;
            }
            let items = edges.each(Item::Object).to_vec();
            self.constrain(Some(source), "tangent", items, None);
        }
        self.hold();
        self.snap();
        self.constraints
            .order_by_key(|(c, _)| order_of_kind(&c.kind));
        let coordinate = |x: f64| decimal(x).unwrap_or_else(|| Decimal::from(0));
        let points = self.places.iter().map(|(name, [x, y])| Point {
            name: name.clone(),
            sketch: [coordinate(*x), coordinate(*y), Decimal::from(0)],
        });
        let points = points.collect();
        let sources: Vec<Option<Source>> = self
            .distances
            .iter()
            .map(|d| d.1)
            .chain(self.constraints.iter().map(|c| c.1))
            .collect();
        let names = sources.iter().enumerate();
        let names =
            names.filter_map(|(index, source)| Some((index, self.names.get(&(*source)?)?.clone())));
        let labels = names.collect();
        let distances: Vec<Distance> = self.distances.into_iter().map(|d| d.0).collect();
        let problem = Problem {
            name,
            dimension: 2,
            source: source.to_owned(),
            points,
            objects: self.objects,
            orientations: Vec::new(),
            constraints: self.constraints.into_iter().map(|c| c.0).collect(),
            homotopy: HomotopyChoices {
                reference: Vec::new(),
                bend: distances.len().saturating_sub(1),
                bend_coefficient: Decimal::from(0),
                detour: Decimal::from(0),
            },
            distances,
            labels,
            tolerances: Default::default(),
            measures: Vec::new(),
            parameters: Vec::new(),
            kept: self.kept,
        };
        Imported {
            problem,
            surplus: None,
            skeleton: None,
            notes: Vec::new(),
            tied: Vec::new(),
            places,
            sources,
        }
    }

    /// Makes coordinates equal that coincidences, horizontals, verticals and given coordinates make equal, where they
    /// are so but for what a solver leaves: then those constraints hold exactly and take no equations. None moves by more
    /// than twice [`SNAP`] of the largest coordinate, however many are made equal one after the other.
    fn snap(&mut self) {
        let count = self.places.len();
        let mut equal = Joined::new(2 * count);
        let mut given: BTreeMap<usize, f64> = BTreeMap::new();
        let all = self.places.iter().flat_map(|(_, at)| *at);
        let most = SNAP * all.fold(0.0f64, |max, x| max.max(x.abs()));
        // How far the coordinates that were made equal to one are from it, at most.
        let mut away = vec![0.0f64; 2 * count];
        let ends = |drawing: &Drawing, items: &[Item]| match *items {
            [Item::Point(a), Item::Point(b)] => Some([a, b]),
            [Item::Object(o)] => match drawing.objects[o].shape {
                Shape::Line(ends) => Some(ends),
                _ => None,
            },
            _ => None,
        };
        let value_of = |drawing: &Drawing, place: usize| drawing.places[place / 2].1[place % 2];
        for (constraint, _) in &self.constraints {
            let axes: &[usize] = match constraint.kind.as_str() {
                "horizontal" => &[1],
                "vertical" => &[0],
                "coincident" => &[0, 1],
                _ => &[],
            };
            if let Some([a, b]) = ends(self, &constraint.items) {
                for axis in axes {
                    let [a, b] = [a, b].each(|point| equal.of(2 * point + axis));
                    let moved = away[b] + (value_of(self, a) - value_of(self, b)).abs();
                    if a != b && moved <= most {
                        equal.join([b, a]);
                        away[a] = away[a].max(moved);
                    }
                }
            }
        }
        for (constraint, _) in &self.constraints {
            let &[Item::Point(p)] = constraint.items.as_slice() else {
                continue;
            };
            let places: Vec<(usize, f64)> = match (constraint.kind.as_str(), &constraint.value) {
                ("fixed", _) => vec![
                    (2 * p, self.places[p].1[0]),
                    (2 * p + 1, self.places[p].1[1]),
                ],
                ("x", Some(x)) => vec![(2 * p, x.to_f64())],
                ("y", Some(y)) => vec![(2 * p + 1, y.to_f64())],
                _ => Vec::new(),
            };
            for (place, value) in places {
                let place = equal.of(place);
                if (value_of(self, place) - value).abs() <= most {
                    given.entry(place).or_insert(value);
                }
            }
        }
        let old: Vec<f64> = (0..2 * count).map(|place| value_of(self, place)).collect();
        for place in 0..2 * count {
            let root = equal.of(place);
            let value = given.get(&root).copied().unwrap_or(old[root]);
            self.places[place / 2].1[place % 2] = value;
        }
    }
}

/// The shortest decimal that reads as a double; zero where that is too small for krawl.
pub fn decimal(x: f64) -> Option<Decimal> {
    if x.abs() < 1e-60 {
        return Some(Decimal::from(0));
    }
    // Written as people do where that is not too long.
    if (1e-9..1e15).contains(&x.abs()) {
        return x.to_string().parse().ok();
    }
    Decimal::try_from(x).ok()
}
