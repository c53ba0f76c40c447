//! What a constraint names, taken one thing after the other: a line may be named, or given by two
//! points, a plane by three.

use super::lowering::Fault;
use crate::statement::{AXES, Item, Problem, Shape};

/// A line in a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineName {
    /// Through two points.
    Points([usize; 2]),
    /// A line of its own, by index of the object.
    Free(usize),
    /// A coordinate axis.
    Axis(usize),
}

/// A plane in a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneName {
    /// Through three points.
    Points([usize; 3]),
    /// A plane of its own, by index of the object.
    Free(usize),
}

/// A line or a plane in a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flat {
    /// A line.
    Line(LineName),
    /// A plane.
    Plane(PlaneName),
}

/// Anything in a constraint that is somewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Thing {
    /// A point.
    Point(usize),
    /// A line or a plane.
    Flat(Flat),
    /// A circle, sphere or arc, by index of the object.
    Round(usize),
}

impl Flat {
    /// The points through which it goes by its name, in order of their indices.
    pub fn points(self) -> Vec<usize> {
        let mut points = match self {
            Flat::Line(LineName::Points(points)) => points.to_vec(),
            Flat::Plane(PlaneName::Points(points)) => points.to_vec(),
            _ => Vec::new(),
        };
        points.sort_unstable();
        points
    }

    /// Whether both are one and the same whatever the figure is, by their names.
    pub fn is(self, other: Flat) -> bool {
        let kind = |flat| matches!(flat, Flat::Line(_));
        let (mine, theirs) = (self.points(), other.points());
        self == other || kind(self) == kind(other) && !mine.is_empty() && mine == theirs
    }

    /// What is wrong with a constraint on the directions of two lines or planes that are not two, or of which one lies in
    /// the other.
    pub fn are_apart(self, other: Flat, problem: &Problem) -> Result<(), Fault> {
        if self.is(other) {
            return Err("the two are one and the same: name another one".to_owned());
        }
        let (line, plane) = match (self, other) {
            (Flat::Line(_), Flat::Plane(_)) => (self.points(), other.points()),
            (Flat::Plane(_), Flat::Line(_)) => (other.points(), self.points()),
            _ => return Ok(()),
        };
        if line.is_empty() || !line.iter().all(|point| plane.contains(point)) {
            return Ok(());
        }
        let names: Vec<&str> = line.iter().map(|&p| &*problem.points[p].name).collect();
        Err(format!(
            "the line lies in the plane, as {} are points of both: name another line or plane",
            names.join(" and ")
        ))
    }
}

/// What a kind of constraint takes, item by item.
#[derive(Clone)]
pub struct Arguments<'a> {
    problem: &'a Problem,
    items: &'a [Item],
}

/// What comes next in a list of items.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sort {
    /// A point.
    Point,
    /// A line with a name.
    Line,
    /// A plane with a name.
    Plane,
    /// A circle, sphere or arc.
    Round,
    /// A rigid body.
    Body,
    /// A joint.
    Joint,
    /// An unknown number.
    Number,
    /// A coordinate axis.
    Axis,
    /// Nothing: the list ends.
    End,
}

impl<'a> Arguments<'a> {
    /// The items of a constraint.
    pub fn new(problem: &'a Problem, items: &'a [Item]) -> Self {
        Arguments { problem, items }
    }

    /// The dimension of the problem.
    pub fn dimension(&self) -> usize {
        self.problem.dimension
    }

    /// How many are left.
    pub fn left(&self) -> usize {
        self.items.len()
    }

    /// How many points come next, before anything else.
    pub fn points_ahead(&self) -> usize {
        let points = self.items.iter();
        points
            .take_while(|item| matches!(item, Item::Point(_)))
            .count()
    }

    /// What comes next.
    pub fn next(&self) -> Sort {
        match self.items.first() {
            None => Sort::End,
            Some(Item::Point(_)) => Sort::Point,
            Some(Item::Axis(_)) => Sort::Axis,
            Some(&Item::Object(index)) => match &self.problem.objects[index].shape {
                Shape::Line(_) | Shape::FreeLine { .. } => Sort::Line,
                Shape::Plane(_) | Shape::FreePlane { .. } => Sort::Plane,
                Shape::Round { .. } | Shape::Arc { .. } => Sort::Round,
                Shape::Body { .. } => Sort::Body,
                Shape::Joint { .. } => Sort::Joint,
                Shape::Number { .. } => Sort::Number,
            },
        }
    }

    fn take(&mut self) -> Item {
        let first = self.items[0];
        self.items = &self.items[1..];
        first
    }

    /// `nothing more`, or the name of what comes next and what it is.
    fn found(&self) -> String {
        let Some(&item) = self.items.first() else {
            return "nothing more".to_owned();
        };
        let name = self.problem.item_name(item);
        match self.next() {
            Sort::Point => format!("the point `{name}`"),
            Sort::Line => format!("the line `{name}`"),
            Sort::Plane => format!("the plane `{name}`"),
            Sort::Round => match (&item, self.problem.dimension) {
                (&Item::Object(o), _)
                    if matches!(self.problem.objects[o].shape, Shape::Arc { .. }) =>
                {
                    format!("the arc `{name}`")
                }
                (_, 2) => format!("the circle `{name}`"),
                _ => format!("the sphere `{name}`"),
            },
            Sort::Body => format!("the body `{name}`"),
            Sort::Joint => format!("the joint `{name}`"),
            Sort::Number => format!("the unknown `{name}`"),
            Sort::Axis => format!("`{name}`"),
            Sort::End => "nothing more".to_owned(),
        }
    }

    fn wanted(&self, what: &str) -> Fault {
        format!("{what} is wanted, and there is {}", self.found())
    }

    /// A point.
    pub fn point(&mut self) -> Result<usize, Fault> {
        match self.items.first() {
            Some(&Item::Point(p)) => {
                self.take();
                Ok(p)
            }
            _ => Err(self.wanted("a point")),
        }
    }

    /// An unknown number, by index of the object.
    pub fn number(&mut self) -> Result<usize, Fault> {
        match (self.next(), self.items.first()) {
            (Sort::Number, Some(&Item::Object(object))) => {
                self.take();
                Ok(object)
            }
            _ => Err(self.wanted("an unknown")),
        }
    }

    /// A body with joints, by index of the object.
    pub fn body(&mut self) -> Result<usize, Fault> {
        match (self.next(), self.items.first()) {
            (Sort::Body, Some(&Item::Object(object))) => {
                self.take();
                match self.problem.objects[object].shape {
                    Shape::Body { place: Some(_), .. } => Ok(object),
                    _ => Err("the body has no joints: fix its points".to_owned()),
                }
            }
            _ => Err(self.wanted("a body")),
        }
    }

    /// A joint, by index of the object.
    pub fn joint(&mut self) -> Result<usize, Fault> {
        match (self.next(), self.items.first()) {
            (Sort::Joint, Some(&Item::Object(object))) => {
                self.take();
                Ok(object)
            }
            _ => Err(self.wanted("a joint")),
        }
    }

    /// A line, by name or by two points.
    pub fn line(&mut self) -> Result<LineName, Fault> {
        match self.next() {
            Sort::Line => {
                let Item::Object(index) = self.take() else {
                    unreachable!("lines are objects")
                };
                Ok(match self.problem.objects[index].shape {
                    Shape::Line(points) => LineName::Points(points),
                    _ => LineName::Free(index),
                })
            }
            Sort::Axis => Ok(LineName::Axis(self.axis()?)),
            Sort::Point => {
                let a = self.point()?;
                let b = match self.items.first() {
                    Some(&Item::Point(b)) => b,
                    _ => return Err(self.wanted("the second point of a line")),
                };
                if a == b {
                    let name = &self.problem.points[a].name;
                    return Err(format!(
                        "the point `{name}` is there twice where two points make a line"
                    ));
                }
                self.take();
                Ok(LineName::Points([a, b]))
            }
            _ => Err(self.wanted("a line, or two points,")),
        }
    }

    /// A line through two points: those.
    pub fn segment(&mut self) -> Result<[usize; 2], Fault> {
        let what = self.found();
        match self.line()? {
            LineName::Points(points) => Ok(points),
            LineName::Free(_) | LineName::Axis(_) => Err(format!(
                "{what} has no ends: name a line through two points, or two points"
            )),
        }
    }

    /// A plane, by name or by three points.
    pub fn plane(&mut self) -> Result<PlaneName, Fault> {
        if self.problem.dimension == 2 {
            return Err("planes are for problems of dimension 3".to_owned());
        }
        match self.next() {
            Sort::Plane => {
                let Item::Object(index) = self.take() else {
                    unreachable!("planes are objects")
                };
                Ok(match self.problem.objects[index].shape {
                    Shape::Plane(points) => PlaneName::Points(points),
                    _ => PlaneName::Free(index),
                })
            }
            Sort::Point => {
                let points = [self.point()?, self.point()?, self.point()?];
                if points[0] == points[1] || points[1] == points[2] || points[0] == points[2] {
                    return Err("a point is there twice where three points make a plane".to_owned());
                }
                Ok(PlaneName::Points(points))
            }
            _ => Err(self.wanted("a plane, or three points,")),
        }
    }

    /// A line or a plane. Three points before anything else are a plane, and six are two; otherwise two are a line.
    pub fn flat(&mut self) -> Result<Flat, Fault> {
        let is_plane = match self.next() {
            Sort::Plane => true,
            Sort::Point => self.problem.dimension == 3 && matches!(self.points_ahead(), 3 | 6),
            _ => false,
        };
        Ok(match is_plane {
            true => Flat::Plane(self.plane()?),
            false => Flat::Line(self.line()?),
        })
    }

    /// Two lines or planes, and nothing more.
    pub fn two_flats(&mut self) -> Result<[Flat; 2], Fault> {
        let flats = [self.flat()?, self.flat()?];
        self.end()?;
        Ok(flats)
    }

    /// What two things are, in words: `the line through d and e, and the plane through a, b and c`.
    pub fn in_words(&self, things: [Thing; 2]) -> String {
        let [one, other] = things.map(|thing| self.thing_in_words(thing));
        format!("{one}, and {other}")
    }

    fn thing_in_words(&self, thing: Thing) -> String {
        let point = |p: usize| &*self.problem.points[p].name;
        let object = |o: usize| &*self.problem.objects[o].name;
        match thing {
            Thing::Point(p) => format!("the point {}", point(p)),
            Thing::Flat(Flat::Line(LineName::Points([a, b]))) => {
                format!("the line through {} and {}", point(a), point(b))
            }
            Thing::Flat(Flat::Line(LineName::Axis(k))) => format!("the {}", AXES[k]),
            Thing::Flat(Flat::Plane(PlaneName::Points([a, b, c]))) => format!(
                "the plane through {}, {} and {}",
                point(a),
                point(b),
                point(c)
            ),
            Thing::Flat(Flat::Line(LineName::Free(o))) => format!("the line {}", object(o)),
            Thing::Flat(Flat::Plane(PlaneName::Free(o))) => format!("the plane {}", object(o)),
            Thing::Round(o) => object(o).to_owned(),
        }
    }

    /// Two things, and nothing more. Points before a name, and those behind it, are one thing: a point, a line or a plane.
    /// Of points alone three are a point and a line, four a point and a plane (in the plane two lines), five a line
    /// and a plane, six two planes.
    pub fn two_things(&mut self) -> Result<[Thing; 2], Fault> {
        let (ahead, space) = (self.points_ahead(), self.problem.dimension);
        let first = match ahead {
            _ if self.left() > ahead => ahead.min(space),
            4 if space == 2 => 2,
            5 => 2,
            6 => space,
            _ => 1,
        };
        let first = self.thing(first)?;
        let second = self.thing(self.points_ahead().min(space))?;
        self.end()?;
        Ok([first, second])
    }

    /// Something that has a name, or is made of so many points.
    fn thing(&mut self, points: usize) -> Result<Thing, Fault> {
        Ok(match (self.next(), points) {
            (Sort::Round, _) => Thing::Round(self.round()?),
            (Sort::Line | Sort::Axis, _) | (Sort::Point, 2) => {
                Thing::Flat(Flat::Line(self.line()?))
            }
            (Sort::Plane, _) | (Sort::Point, 3) => Thing::Flat(Flat::Plane(self.plane()?)),
            (Sort::Point, _) => Thing::Point(self.point()?),
            (Sort::Body | Sort::Joint | Sort::Number | Sort::End, _) => {
                return Err(self.wanted("a point, a line, a plane, a circle or a sphere"));
            }
        })
    }

    /// A circle, sphere or arc: the index of the object.
    pub fn round(&mut self) -> Result<usize, Fault> {
        let what = if self.problem.dimension == 2 {
            "a circle or an arc"
        } else {
            "a sphere"
        };
        match (self.next(), self.items.first()) {
            (Sort::Round, Some(&Item::Object(index))) => {
                self.take();
                Ok(index)
            }
            _ => Err(self.wanted(what)),
        }
    }

    /// An axis of the plane or of space.
    pub fn axis(&mut self) -> Result<usize, Fault> {
        match self.items.first() {
            Some(&Item::Axis(k)) if k < self.problem.dimension => {
                self.take();
                Ok(k)
            }
            _ => {
                let axes = &AXES[..self.problem.dimension];
                let axes: Vec<String> = axes.iter().map(|axis| format!("`{axis}`")).collect();
                Err(self.wanted(&axes.join(" or ")))
            }
        }
    }

    /// Nothing more.
    pub fn end(&self) -> Result<(), Fault> {
        match self.next() {
            Sort::End => Ok(()),
            _ => Err(format!("there is {} too much", self.found())),
        }
    }
}
