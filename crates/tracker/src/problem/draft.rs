//! Objects and constraints of a problem in the making: names to be looked up, numbers to be checked.

use super::builder::{Number, Numeral, ProblemBuilder, check_name, number};
use super::error::{MAX_NAME, Place, did_you_mean};
use super::formula;
use super::{
    AXES, Constraint, Decimal, DecimalError, Item, JointSort, Object, Point, Pose, Problem,
    ProblemError, Shape,
};
use crate::constraint::{self, EQUATIONS, KINDS};
use crate::order::InOrder;
use crate::statement::nearest;
use std::collections::{HashMap, HashSet};

#[derive(Debug, Clone)]
pub(super) struct DraftObject {
    name: String,
    shape: DraftShape,
}

#[derive(Debug, Clone)]
pub(super) enum DraftShape {
    Line([String; 2]),
    FreeLine([Vec<Number>; 2]),
    Plane([String; 3]),
    FreePlane([Vec<Number>; 2]),
    Circle(String, Number),
    Sphere(String, Number),
    Arc([String; 3]),
    Body(Vec<(String, Vec<Number>)>),
    Joint(JointSort, [String; 2], Box<[Pose; 2]>),
    Number(Number, [Option<Number>; 2]),
}

impl DraftShape {
    /// What it is called, and the dimension where there are such, if not both.
    fn what(&self) -> (&'static str, Option<usize>) {
        match self {
            Self::Line(_) | Self::FreeLine(_) => ("line", None),
            Self::Plane(_) | Self::FreePlane(_) => ("plane", Some(3)),
            Self::Circle(..) => ("circle", Some(2)),
            Self::Sphere(..) => ("sphere", Some(3)),
            Self::Arc(_) => ("arc", Some(2)),
            Self::Body(_) => ("body", None),
            Self::Joint(..) => ("joint", None),
            Self::Number(..) => ("unknown", None),
        }
    }
}

impl DraftShape {
    /// The place of its table among those of a file.
    fn order(&self) -> Option<usize> {
        let (what, _) = self.what();
        let mut tables = super::vocabulary::TABLES.iter();
        tables.position(|table| table.starts_with(&what[..3]))
    }
}

#[derive(Debug, Clone)]
pub(super) struct DraftConstraint {
    kind: String,
    items: Vec<String>,
    value: Option<Number>,
}

impl ProblemBuilder {
    /// Adds the line through two points.
    pub fn line(self, name: &str, a: &str, b: &str) -> Self {
        self.object(name, DraftShape::Line([a, b].map(str::to_owned)))
    }

    /// Adds a line of its own, with a place on it and its direction in the sketch.
    pub fn free_line<N: Numeral>(
        self,
        name: &str,
        point: impl IntoIterator<Item = N>,
        direction: impl IntoIterator<Item = N>,
    ) -> Self {
        let numbers = [numbers(point), numbers(direction)];
        self.object(name, DraftShape::FreeLine(numbers))
    }

    /// Adds the plane through three points.
    pub fn plane(self, name: &str, points: [&str; 3]) -> Self {
        self.object(name, DraftShape::Plane(points.map(str::to_owned)))
    }

    /// Adds a plane of its own, with a place in it and its normal in the sketch.
    pub fn free_plane<N: Numeral>(
        self,
        name: &str,
        point: impl IntoIterator<Item = N>,
        normal: impl IntoIterator<Item = N>,
    ) -> Self {
        let numbers = [numbers(point), numbers(normal)];
        self.object(name, DraftShape::FreePlane(numbers))
    }

    /// Adds a circle in the plane, with its radius in the sketch.
    pub fn circle<N: Numeral>(self, name: &str, center: &str, radius: N) -> Self {
        self.object(name, DraftShape::Circle(center.to_owned(), number(radius)))
    }

    /// Adds a sphere in space, with its radius in the sketch.
    pub fn sphere<N: Numeral>(self, name: &str, center: &str, radius: N) -> Self {
        self.object(name, DraftShape::Sphere(center.to_owned(), number(radius)))
    }

    /// Adds an arc in the plane.
    pub fn arc(self, name: &str, center: &str, start: &str, end: &str) -> Self {
        self.object(
            name,
            DraftShape::Arc([center, start, end].map(str::to_owned)),
        )
    }

    /// Adds a rigid body: points of the problem, with their coordinates in the body's own frame.
    ///
    /// ```
    /// use krawl::problem::Problem;
    /// let problem = Problem::build("plate", 2)
    ///     .point("a", [0, 0]).point("b", [4, 0]).point("c", [1, 2])
    ///     .body("plate", [("a", [0, 0]), ("b", [4, 0]), ("c", [1, 3])])
    ///     .finish().unwrap();
    /// assert_eq!(problem.objects.len(), 1);
    /// ```
    pub fn body<N, P, S, C>(self, name: &str, points: P) -> Self
    where
        N: Numeral,
        S: Into<String>,
        C: IntoIterator<Item = N>,
        P: IntoIterator<Item = (S, C)>,
    {
        let points = points.into_iter().map(|(p, at)| (p.into(), numbers(at)));
        let points = points.collect();
        self.object(name, DraftShape::Body(points))
    }

    /// Adds a number that is sought, with its value in the sketch.
    ///
    /// ```
    /// use krawl::problem::Problem;
    /// let problem = Problem::build("circle and hyperbola", 2)
    ///     .unknown("x", "1.2").unknown("y", "0.5")
    ///     .equation("x^2 + y^2 = 2.5").equation("x*y = 1")
    ///     .finish().unwrap();
    /// assert_eq!(problem.objects.len(), 2);
    /// ```
    pub fn unknown<N: Numeral>(self, name: &str, sketch: N) -> Self {
        self.object(name, DraftShape::Number(number(sketch), [None, None]))
    }

    /// The same of a number of which `all` seeks the solutions between two others, either of which may be left out.
    ///
    /// ```
    /// use krawl::complete::{Options, all};
    /// use krawl::problem::Problem;
    /// let problem = Problem::build("roots", 2)
    ///     .unknown_within("x", 1, [Some("0"), None])
    ///     .equation("x^2 = 2")
    ///     .finish().unwrap();
    /// assert_eq!(all(&problem, &Options::default()).unwrap().solutions.len(), 1);
    /// ```
    pub fn unknown_within<N: Numeral, E: Numeral>(
        self,
        name: &str,
        sketch: N,
        ends: [Option<E>; 2],
    ) -> Self {
        let ends = ends.map(|end| end.map(number));
        self.object(name, DraftShape::Number(number(sketch), ends))
    }

    /// Adds an equation over unknowns, coordinates `A.x` and distances `|A-B|`.
    pub fn equation(self, text: &str) -> Self {
        self.constraint(EQUATIONS, [text])
    }

    pub(super) fn object(mut self, name: &str, shape: DraftShape) -> Self {
        self.objects.push(DraftObject {
            name: name.to_owned(),
            shape,
        });
        self
    }

    /// Adds a constraint without a number, of one of the kinds in [`crate::constraint::KINDS`]. `names`
    /// are those of points and objects, or `x-axis`, `y-axis`, in the order that the kind wants.
    ///
    /// ```
    /// # use krawl::problem::Problem;
    /// let problem = Problem::build("bar", 2)
    ///     .point("a", [1, 1]).point("b", [5, 2])
    ///     .distance("a", "b", 3)
    ///     .constraint("fixed", ["a"]).constraint("horizontal", ["a", "b"])
    ///     .finish().unwrap();
    /// assert!(problem.is_absolute());
    /// ```
    pub fn constraint<S: AsRef<str>>(self, kind: &str, names: impl IntoIterator<Item = S>) -> Self {
        self.with_constraint(kind, names, None)
    }

    /// Adds a constraint with a number.
    pub fn dimension<S: AsRef<str>, N: Numeral>(
        self,
        kind: &str,
        names: impl IntoIterator<Item = S>,
        value: N,
    ) -> Self {
        self.with_constraint(kind, names, Some(number(value)))
    }

    fn with_constraint<S: AsRef<str>>(
        mut self,
        kind: &str,
        names: impl IntoIterator<Item = S>,
        value: Option<Number>,
    ) -> Self {
        self.constraints.push(DraftConstraint {
            kind: kind.to_owned(),
            items: names.into_iter().map(|s| s.as_ref().to_owned()).collect(),
            value,
        });
        self
    }

    /// The name of the body that has a point of this name.
    pub(super) fn body_with(&self, point: &str) -> Option<&str> {
        let mut bodies = self.objects.iter();
        let has = |shape: &DraftShape| match shape {
            DraftShape::Body(points) => points.iter().any(|(name, _)| name == point),
            _ => false,
        };
        bodies
            .find(|draft| has(&draft.shape))
            .map(|draft| &*draft.name)
    }

    /// The objects, with their names looked up.
    pub(super) fn finished_objects(
        &self,
        find: impl Fn(Place, &str, &str) -> Result<usize, ProblemError>,
    ) -> Result<Vec<Object>, ProblemError> {
        // In the order of the tables of a file.
        let mut drafts: Vec<&DraftObject> = self.objects.iter().collect();
        drafts.order_by_key(|draft| draft.shape.order());
        let names: Vec<&str> = drafts.iter().map(|draft| &*draft.name).collect();
        let drafts = drafts.iter().copied().enumerate();
        drafts
            .map(|(index, draft)| {
                let place = Place::Object(index);
                check_name(place, &draft.name)?;
                let (what, only) = draft.shape.what();
                let shown = format!("the {what} `{}`", draft.name);
                if only.is_some_and(|dimension| dimension != self.dimension) {
                    return Err(wrong_space(place, what, &draft.name, self.dimension));
                }
                let find = |name: &str| find(place, &shown, name);
                let given = |number: &Number| {
                    let number = number.clone();
                    number.map_err(ProblemError::number(place, &shown))
                };
                let coordinates = |numbers: &[Number]| {
                    let (given, wanted) = (numbers.len(), self.dimension);
                    if given != wanted {
                        let fault =
                            format!("there are {given} coordinates where {wanted} are needed");
                        return Err(ProblemError::at(place, format!("{shown}: {fault}")));
                    }
                    three(numbers, |_| ProblemError::number(place, &shown))
                };
                let shape = match &draft.shape {
                    DraftShape::Line([a, b]) => Shape::Line([find(a)?, find(b)?]),
                    DraftShape::Plane([a, b, c]) => Shape::Plane([find(a)?, find(b)?, find(c)?]),
                    DraftShape::FreeLine([point, direction]) => Shape::FreeLine {
                        point: coordinates(point)?,
                        direction: coordinates(direction)?,
                    },
                    DraftShape::FreePlane([point, normal]) => Shape::FreePlane {
                        point: coordinates(point)?,
                        normal: coordinates(normal)?,
                    },
                    DraftShape::Circle(center, radius) | DraftShape::Sphere(center, radius) => {
                        Shape::Round {
                            center: find(center)?,
                            radius: given(radius)?,
                        }
                    }
                    DraftShape::Arc([center, start, end]) => Shape::Arc {
                        center: find(center)?,
                        start: find(start)?,
                        end: find(end)?,
                    },
                    DraftShape::Body(members) => {
                        let mut body = (Vec::new(), Vec::new());
                        for (point, local) in members {
                            body.0.push(find(point)?);
                            body.1.push(coordinates(local)?);
                        }
                        Shape::Body {
                            points: body.0,
                            local: body.1,
                            place: None,
                        }
                    }
                    DraftShape::Joint(sort, bodies, frames) => {
                        let body = |name: &String| {
                            let found = names.iter().position(|other| other == name);
                            let name = ("point or object", name.as_str());
                            let known = names.iter().copied();
                            found.ok_or_else(|| ProblemError::unknown(place, &shown, name, known))
                        };
                        Shape::Joint {
                            sort: *sort,
                            bodies: [body(&bodies[0])?, body(&bodies[1])?],
                            frames: frames.clone(),
                        }
                    }
                    DraftShape::Number(sketch, [low, high]) => {
                        let within = [low, high].map(|end| end.as_ref().map(&given).transpose());
                        let [low, high] = within;
                        let within = [low?, high?];
                        check_within(&within)
                            .map_err(|why| ProblemError::at(place, format!("{shown}: {why}")))?;
                        Shape::Number {
                            sketch: given(sketch)?,
                            within,
                        }
                    }
                };
                Ok(Object {
                    name: draft.name.clone(),
                    shape,
                })
            })
            .collect()
    }

    /// Whether a constraint fixes what has this name.
    pub(super) fn is_fixed(&self, name: &str) -> bool {
        let mut constraints = self.constraints.iter();
        constraints.any(|c| c.kind == "fixed" && c.items.iter().any(|item| item == name))
    }

    /// The constraints, with their names looked up, in the order of the kinds.
    pub(super) fn finished_constraints(
        &self,
        points: &[Point],
        objects: &[Object],
    ) -> Result<Vec<Constraint>, ProblemError> {
        let mut items: HashMap<&str, Item> = HashMap::new();
        items.extend(
            points
                .iter()
                .enumerate()
                .map(|(p, point)| (point.name.as_str(), Item::Point(p))),
        );
        items.extend(
            objects
                .iter()
                .enumerate()
                .map(|(o, object)| (object.name.as_str(), Item::Object(o))),
        );
        items.extend(
            AXES.iter()
                .enumerate()
                .map(|(k, &name)| (name, Item::Axis(k))),
        );
        let mut drafts = Vec::with_capacity(self.constraints.len());
        for draft in &self.constraints {
            let order = constraint::order_of_kind(&draft.kind);
            let order = order.ok_or_else(|| {
                let kind: String = draft.kind.chars().take(MAX_NAME).collect();
                let nearest = nearest(&draft.kind, &mut KINDS.iter().map(|kind| kind.key));
                unknown_kind(&kind, nearest)
            })?;
            drafts.push((order, draft));
        }
        drafts.order_by_key(|&(order, _)| order);
        let drafts = drafts.into_iter().enumerate();
        drafts
            .map(|(index, (_, draft))| {
                let place = Place::Constraint(index);
                let what = format!("the constraint `{}`", draft.kind);
                let find = |name: &String| {
                    let unknown = || {
                        let name = ("point or object", name.as_str());
                        ProblemError::unknown(place, &what, name, items.keys().copied())
                    };
                    items.get(name.as_str()).copied().ok_or_else(unknown)
                };
                let value = draft.value.clone().transpose();
                let value = value.map_err(ProblemError::number(place, &what));
                let formula = match draft.items.as_slice() {
                    [text] if draft.kind == EQUATIONS => {
                        let read = formula::read(text, self.dimension, &items, objects);
                        let fault = |fault: String| ProblemError::at(place, fault);
                        Some(Box::new(read.map_err(fault)?))
                    }
                    _ => None,
                };
                let named = match &formula {
                    Some(formula) => formula.items(),
                    None => draft.items.iter().map(find).collect::<Result<_, _>>()?,
                };
                Ok(Constraint {
                    kind: draft.kind.clone(),
                    items: named,
                    formula,
                    value: value?,
                })
            })
            .collect()
    }
}

/// Refuses a range that is empty.
fn check_within(within: &[Option<Decimal>; 2]) -> Result<(), String> {
    match within {
        [Some(low), Some(high)] if low.value() > high.value() => Err(format!(
            "a range goes from the lesser number to the greater one, and not from {low} to {high}"
        )),
        _ => Ok(()),
    }
}

impl Problem {
    /// Has the solutions sought in which an unknown is between two numbers, either of which may be left out.
    ///
    /// # Errors
    /// In words: there is no such unknown, or the range is empty.
    pub fn restrict(&mut self, name: &str, ends: [Option<Decimal>; 2]) -> Result<(), String> {
        check_within(&ends)?;
        let of_name = |object: &&mut Object| object.name == name;
        let found = self.objects.iter_mut().find(of_name);
        if let Some(Shape::Number { within, .. }) = found.map(|object| &mut object.shape) {
            *within = ends;
            return Ok(());
        }
        let unknowns = self.objects.iter();
        let unknowns = unknowns.filter(|object| matches!(object.shape, Shape::Number { .. }));
        let mut names = unknowns.map(|object| object.name.as_str());
        let meant = did_you_mean(nearest(name, &mut names));
        Err(format!("there is no unknown `{name}`{meant}"))
    }
}

fn numbers<N: Numeral>(of: impl IntoIterator<Item = N>) -> Vec<Number> {
    of.into_iter().map(number).collect()
}

/// Coordinates; the third is zero in the plane.
pub(super) fn three<F: FnOnce(DecimalError) -> ProblemError>(
    numbers: &[Number],
    wrong: impl Fn(usize) -> F,
) -> Result<[Decimal; 3], ProblemError> {
    let mut out = [0, 0, 0].map(Decimal::from);
    for (axis, (out, number)) in out.iter_mut().zip(numbers).enumerate() {
        *out = number.clone().map_err(wrong(axis))?;
    }
    Ok(out)
}

fn unknown_kind(kind: &str, nearest: Option<String>) -> ProblemError {
    let nearest = did_you_mean(nearest);
    let text = format!("there is no kind of constraints `{kind}`{nearest}");
    ProblemError::at(Place::Distances, text)
}

/// A kind of object that there is not in this dimension.
fn wrong_space(place: Place, what: &str, name: &str, dimension: usize) -> ProblemError {
    let space = if dimension == 2 { "space" } else { "the plane" };
    let text = format!("the {what} `{name}`: there are {what}s in {space} only");
    ProblemError::at(place, text)
}

impl super::Problem {
    /// An object that cannot be put to work.
    pub(super) fn wrong_object(&self, index: usize, fault: &str) -> ProblemError {
        let object = &self.objects[index];
        let what = object.kind(self.dimension);
        let text = format!("the {what} `{}`: {fault}", object.name);
        ProblemError::at(Place::Object(index), text)
    }

    /// A constraint that cannot be put to work.
    pub(super) fn wrong_constraint(&self, index: usize, name: &str, fault: &str) -> ProblemError {
        let kind = constraint::kind(&self.constraints[index].kind);
        let takes = kind.map_or("", |kind| kind.takes);
        let text = format!("`{name}`: {fault} (it takes {takes})");
        ProblemError::at(Place::Constraint(index), text)
    }
}

/// Names are different, points of objects are, and no constraint is there twice; indices are in range.
pub(super) fn check_names(problem: &super::Problem) -> Result<(), ProblemError> {
    let mut names: HashSet<&str> = AXES.into_iter().collect();
    let taken = |place: Place, what: &str, name: &str| {
        let text = format!("the name `{name}` is taken: rename the {what}");
        Err(ProblemError::at(place, text))
    };
    for (index, point) in problem.points.iter().enumerate() {
        if !names.insert(&point.name) && !problem.is_distances_only() {
            return taken(Place::Point(index), "point", &point.name);
        }
    }
    for (index, object) in problem.objects.iter().enumerate() {
        let (place, what) = (Place::Object(index), object.kind(problem.dimension));
        check_name(place, &object.name)?;
        if !names.insert(&object.name) {
            return taken(place, what, &object.name);
        }
        let fault = |fault: &str| problem.wrong_object(index, fault);
        let points = object.points();
        if let Shape::Body { local, place, .. } = &object.shape {
            if points.len() != local.len() {
                return Err(fault("there are not as many coordinates as points"));
            }
            if place.is_none() && points.len() < problem.dimension {
                return Err(fault(match problem.dimension {
                    2 => "a body without joints has at least two points",
                    _ => "in space a body without joints has at least three points",
                }));
            }
        }
        if points.iter().any(|&p| p >= problem.points.len()) {
            return Err(fault("it has a point that there is not"));
        }
        let different: HashSet<usize> = points.iter().copied().collect();
        if different.len() < points.len() {
            return Err(fault("it has a point twice: remove or replace one"));
        }
        let flat = |v: &[Decimal; 3]| problem.dimension == 3 || v[2] == Decimal::from(0);
        let all_flat = match &object.shape {
            Shape::FreeLine { point, direction } => flat(point) && flat(direction),
            Shape::Body { local, .. } => local.iter().all(flat),
            _ => true,
        };
        let all_flat = all_flat && object.poses().all(|pose| flat(&pose.at) && flat(&pose.x));
        if !all_flat {
            return Err(fault(
                "a third coordinate, of it or of its place, must be zero in the plane",
            ));
        }
        let is_up = |z: &[Decimal; 3]| {
            let zero = Decimal::from(0);
            z[0] == zero && z[1] == zero && z[2].is_positive()
        };
        if problem.dimension == 2 && !object.poses().all(|pose| is_up(&pose.z)) {
            return Err(fault(
                "in the plane z is 0, 0, 1 for all bodies and joints: leave it out",
            ));
        }
        if let Shape::Joint { sort, bodies, .. } = &object.shape {
            let is_body = |&b: &usize| problem.objects.get(b).is_some_and(|o| o.place().is_some());
            if !bodies.iter().all(is_body) || bodies[0] == bodies[1] {
                return Err(fault("a joint is of two bodies: name two"));
            }
            if problem.dimension == 2 && !sort.is_in_plane() {
                return Err(fault(
                    "in the plane there are revolute, prismatic and rigid joints",
                ));
            }
        }
        let there = match &object.shape {
            Shape::Plane(_) | Shape::FreePlane { .. } => problem.dimension == 3,
            Shape::Arc { .. } => problem.dimension == 2,
            _ => true,
        };
        if !there {
            let error = wrong_space(place, what, &object.name, problem.dimension);
            return Err(error);
        }
    }
    if let Err((index, fault)) = constraint::check_joints(problem) {
        return Err(problem.wrong_object(index, &fault));
    }
    let mut seen = HashSet::new();
    for (index, constraint) in problem.constraints.iter().enumerate() {
        let known = |item: &Item| match *item {
            Item::Point(p) => p < problem.points.len(),
            Item::Object(o) => o < problem.objects.len(),
            Item::Axis(k) => k < AXES.len(),
        };
        if constraint::kind(&constraint.kind).is_none() {
            return Err(unknown_kind(&constraint.kind, None));
        }
        let is_whole = constraint.formula.as_ref().is_none_or(|f| f.is_of(problem));
        if !constraint.items.iter().all(known) || !is_whole {
            let fault = "it names something that there is not";
            return Err(problem.wrong_constraint(index, &constraint.kind, fault));
        }
        let text = constraint.formula.as_ref().map(|formula| &formula.text);
        if !seen.insert((constraint.kind.as_str(), &constraint.items, text)) {
            let name = problem.constraint_name(index);
            let text = format!("`{name}` is given twice: remove one of them");
            return Err(ProblemError::at(Place::Constraint(index), text));
        }
    }
    Ok(())
}
