//! What a constraint names, taken one thing after the other: a line may be named, or given by two
//! points, a plane by three.

use super::lowering::Fault;
use crate::problem::{AXES, Item, Problem, Shape};

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

    /// What was taken since an earlier state.
    pub fn taken_since(&self, before: &Arguments<'a>) -> &'a [Item] {
        &before.items[..before.items.len() - self.items.len()]
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
