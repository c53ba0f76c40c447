//! Problems made in code, checked as those from files are.

use super::check::{check_structure, coincide, collinear};
use super::draft::{DraftConstraint, DraftObject, check_names, three};
use super::error::{MAX_NAME, MAX_POINTS, Place};
use super::joint::Drawn;
use super::{
    Decimal, DecimalError, Distance, HomotopyChoices, Orientation, Point, Problem, ProblemError,
    Target, bend, reference,
};
use crate::constraint::{self, Owner};
use crate::places::Each as _;
use crate::statement::{counted, either};
use std::collections::{HashMap, HashSet};

/// Collects the parts of a problem; [`ProblemBuilder::finish`] checks them together.
///
/// Numbers may be [`Decimal`]s, texts (exactly what they say), whole numbers, or floats (the
/// shortest decimal that reads as the float). A bad number is reported by `finish`, too.
///
/// ```
/// use krawl::problem::Problem;
/// let triangle = Problem::build("triangle", 2)
///     .point("a", ["0", "0"])
///     .point("b", ["1", "0"])
///     .point("c", ["0.4", "1.1"])
///     .distance("a", "b", "1")
///     .distance("b", "c", "1.12")
///     .squared_distance("c", "a", 2)
///     .finish()
///     .unwrap();
/// assert_eq!(triangle.free_coordinates(), 3);
/// assert_eq!(triangle.distance_name(triangle.homotopy.bend), "c-a");
/// ```
#[derive(Debug, Clone)]
pub struct ProblemBuilder {
    name: String,
    pub(super) dimension: usize,
    source: String,
    points: Vec<DraftPoint>,
    pub(super) objects: Vec<DraftObject>,
    lengths: Vec<DraftDistance>,
    squared_lengths: Vec<DraftDistance>,
    pub(super) constraints: Vec<DraftConstraint>,
    orientations: Vec<DraftOrientation>,
    pub(super) drawn: Drawn,
    reference: Option<Vec<String>>,
    bend: Option<Vec<String>>,
    bend_coefficient: Option<Number>,
    detour: Option<Number>,
    /// Whether it need not be well constrained.
    loose: bool,
}

/// A number, or what is wrong with it.
pub(super) type Number = Result<Decimal, DecimalError>;

#[derive(Debug, Clone)]
struct DraftPoint {
    name: String,
    coordinates: Vec<Number>,
}

#[derive(Debug, Clone)]
struct DraftOrientation {
    points: Vec<String>,
    is_positive: bool,
}

#[derive(Debug, Clone)]
struct DraftDistance {
    points: [String; 2],
    target: Number,
}

/// What is taken for a number: a [`Decimal`], and all that one can be made of.
pub trait Numeral: TryInto<Decimal, Error: Into<DecimalError>> {}

impl<N: TryInto<Decimal, Error: Into<DecimalError>>> Numeral for N {}

pub(super) fn number<N: Numeral>(value: N) -> Number {
    value.try_into().map_err(Into::into)
}

impl Problem {
    /// Where the sketch has its points, in floats.
    pub fn places(&self) -> Vec<[f64; 3]> {
        self.points.iter().map(Point::place).collect()
    }

    /// A problem of distances with some of them, by index, led in the same way: with the same reference, and the same bend if that is one of them.
    /// `None`: it is not well constrained.
    pub fn with_distances(&self, mut is_kept: impl FnMut(usize) -> bool) -> Option<Problem> {
        let mut builder = Problem::build(&self.name, self.dimension).source(&self.source);
        for point in &self.points {
            let coordinates = point.sketch.iter().take(self.dimension).cloned();
            builder = builder.point(&point.name, coordinates);
        }
        let choices = &self.homotopy;
        let name = |&p: &usize| self.points[p].name.as_str();
        builder = builder.detour(choices.detour.clone());
        for (index, distance) in self.distances.iter().enumerate() {
            let [a, b] = distance.points.each(|p| name(&p));
            if !is_kept(index) {
                continue;
            }
            if index == choices.bend {
                let coefficient = choices.bend_coefficient.clone();
                builder = builder.bend([a, b]).bend_coefficient(coefficient);
            }
            builder = match &distance.target {
                Target::Length(x) => builder.distance(a, b, x.clone()),
                Target::SquaredLength(x) => builder.squared_distance(a, b, x.clone()),
            };
        }
        // It may not be held by those that are left.
        let reference: Vec<&str> = choices.reference.iter().map(name).collect();
        let led = builder.clone().reference(&reference).finish();
        let mut problem = led.or_else(|_| builder.finish()).ok()?;
        problem.orientations.clone_from(&self.orientations);
        problem.measures.clone_from(&self.measures);
        Some(problem)
    }

    /// Starts a problem in the plane (`dimension` 2) or in space (3).
    pub fn build(name: &str, dimension: usize) -> ProblemBuilder {
        ProblemBuilder {
            name: name.to_owned(),
            dimension,
            source: String::new(),
            points: Vec::new(),
            objects: Vec::new(),
            lengths: Vec::new(),
            squared_lengths: Vec::new(),
            constraints: Vec::new(),
            orientations: Vec::new(),
            reference: None,
            bend: None,
            bend_coefficient: None,
            detour: None,
            drawn: Drawn::default(),
            loose: false,
        }
    }

    /// Checks a problem whose fields were set by hand. Those from files and from
    /// [`Problem::build`] have been checked.
    ///
    /// ```
    /// # use krawl::problem::Problem;
    /// # let mut problem = Problem::build("bar", 2).point("a", [0, 0]).point("b", [1, 0])
    /// #     .distance("a", "b", 2).finish().unwrap();
    /// assert!(problem.check().is_ok());
    /// problem.distances.clear();
    /// assert!(problem.check().is_err());
    /// ```
    pub fn check(&self) -> Result<(), ProblemError> {
        check_size(&self.name, self.dimension, self.points.len())?;
        check_points(self.dimension, &self.points)?;
        let in_range = |place, what: &str, index: usize| match index < self.points.len() {
            true => Ok(()),
            false => {
                let name = format!("no. {index}");
                Err(ProblemError::unknown(place, what, ("point", &name), []))
            }
        };
        for (index, distance) in self.distances.iter().enumerate() {
            for point in distance.points {
                in_range(Place::Distance(index), "a distance", point)?;
            }
        }
        check_distances(&self.points, &self.distances)?;
        for (index, orientation) in self.orientations.iter().enumerate() {
            for &point in &orientation.points {
                in_range(Place::Orientation(index), "an orientation", point)?;
            }
        }
        check_orientations(self)?;
        check_names(self)?;
        for &point in &self.homotopy.reference {
            in_range(Place::Reference, "the reference", point)?;
        }
        if self.is_distances_only() && self.homotopy.bend >= self.distances.len() {
            return Err(not_a_distance(&format!("no. {}", self.homotopy.bend)));
        }
        check_sketch(&self.points, &self.distances)?;
        let own = constraint::frame_of(self).frame;
        if own != self.is_absolute() {
            let wanted = if own { 0 } else { self.dimension };
            return Err(reference_count(self.homotopy.reference.len(), wanted));
        }
        if !own {
            check_enough_points(self.dimension, self.points.len())?;
            check_reference(self.dimension, &self.points, &self.homotopy.reference)?;
        }
        self.check_together()
    }

    /// Checks that constraints can be put to work, and that there are as many as needed where they are
    /// needed.
    fn check_together(&self) -> Result<(), ProblemError> {
        if self.is_distances_only() {
            return check_structure(self.dimension, &self.points, &self.distances);
        }
        constraint::check_structure(self).map_err(|(owner, fault)| {
            let place = match owner {
                Some((Owner::Object(index), true)) => return self.wrong_object(index, &fault),
                Some((Owner::Constraint(index), true)) => {
                    return self.wrong_constraint(index, &self.constraint_name(index), &fault);
                }
                Some((Owner::Object(index), false)) => Place::Object(index),
                Some((Owner::Constraint(index), false)) => Place::Constraint(index),
                None => Place::Distances,
            };
            ProblemError::structure(place, fault)
        })
    }
}

impl ProblemBuilder {
    /// Says where the numbers come from.
    pub fn source(mut self, source: &str) -> Self {
        self.source = source.to_owned();
        self
    }

    /// Adds a point at its place in the sketch, with as many coordinates as dimensions.
    pub fn point<N: Numeral>(
        mut self,
        name: &str,
        coordinates: impl IntoIterator<Item = N>,
    ) -> Self {
        self.points.push(DraftPoint {
            name: name.to_owned(),
            coordinates: coordinates.into_iter().map(number).collect(),
        });
        self
    }

    /// Adds a distance to meet.
    pub fn distance<N: Numeral>(mut self, a: &str, b: &str, length: N) -> Self {
        self.lengths.push(DraftDistance {
            points: [a.to_owned(), b.to_owned()],
            target: number(length),
        });
        self
    }

    /// Adds a distance to meet, given by its square. In the finished problem these come after all
    /// those given as lengths, as they do in files.
    pub fn squared_distance<N: Numeral>(mut self, a: &str, b: &str, square: N) -> Self {
        self.squared_lengths.push(DraftDistance {
            points: [a.to_owned(), b.to_owned()],
            target: number(square),
        });
        self
    }

    /// Asks for figures in which points, one more than there are dimensions, are this way round ([`Orientation`](super::Orientation)):
    /// with a determinant greater than 0, or less.
    pub fn orientation<S: AsRef<str>>(
        mut self,
        names: impl IntoIterator<Item = S>,
        is_positive: bool,
    ) -> Self {
        self.orientations.push(DraftOrientation {
            points: names.into_iter().map(|s| s.as_ref().to_owned()).collect(),
            is_positive,
        });
        self
    }

    /// Chooses the reference points. Left out, krawl chooses mutually constrained ones.
    pub fn reference<S: AsRef<str>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.reference = Some(names.into_iter().map(|s| s.as_ref().to_owned()).collect());
        self
    }

    /// Chooses the distance that is bent. Left out, it is the last one.
    pub fn bend<S: AsRef<str>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.bend = Some(names.into_iter().map(|s| s.as_ref().to_owned()).collect());
        self
    }

    /// Sets the bend's coefficient c. Left out, it is a part of the mean target length (docs/using/problem-files.md).
    pub fn bend_coefficient<N: Numeral>(mut self, c: N) -> Self {
        self.bend_coefficient = Some(number(c));
        self
    }

    /// Sets how far constraints that the sketch meets are led off on the way
    /// ([`HomotopyChoices::detour`]). Left out, it is 0: they hold all along.
    pub fn detour<N: Numeral>(mut self, by: N) -> Self {
        self.detour = Some(number(by));
        self
    }

    /// Makes a problem in the sketch's own frame that need not have as many equations as unknowns, for
    /// [`crate::edit::Session`]; a reference is not looked at.
    pub fn loose(mut self) -> Self {
        self.loose = true;
        self
    }

    /// How many there are of each part that problems have several of, and where one of them is.
    pub(super) fn counts(&self) -> [(fn(usize) -> Place, usize); 5] {
        let distances = self.lengths.len() + self.squared_lengths.len();
        [
            (Place::Point, self.points.len()),
            (Place::Object, self.objects.len()),
            (Place::Distance, distances),
            (Place::Constraint, self.constraints.len()),
            (Place::Orientation, self.orientations.len()),
        ]
    }

    /// Checks everything and makes the problem.
    pub fn finish(self) -> Result<Problem, ProblemError> {
        check_size(&self.name, self.dimension, self.points.len())?;
        let points = self.finished_points()?;
        check_points(self.dimension, &points)?;
        let index_of: HashMap<&str, usize> = points
            .iter()
            .enumerate()
            .map(|(i, p)| (p.name.as_str(), i))
            .collect();
        let find = |place: Place, what: &str, name: &str| {
            let unknown = || {
                let known = points.iter().map(|p| p.name.as_str());
                let error = ProblemError::unknown(place, what, ("point", name), known);
                self.body_with(name).map_or(error.clone(), |body| {
                    let text = format!(
                        "{error}; a point of the body `{body}` stands under `points` as well, where it is drawn"
                    );
                    ProblemError::at(place, text)
                })
            };
            index_of.get(name).copied().ok_or_else(unknown)
        };

        let distances = self.finished_distances(find)?;
        check_distances(&points, &distances)?;
        let mut objects = self.finished_objects(find)?;
        self.place_bodies(&points, &mut objects)?;
        let constraints = self.finished_constraints(&points, &objects)?;
        let orientations = self.orientations.iter().enumerate();
        let orientations = orientations.map(|(index, draft)| {
            let place = Place::Orientation(index);
            let shown: Vec<String> = draft
                .points
                .iter()
                .map(|name| name.chars().take(MAX_NAME).collect())
                .collect();
            let what = format!("the orientation {}", shown.join("-"));
            let found = draft.points.iter().map(|name| find(place, &what, name));
            Ok(Orientation {
                points: found.collect::<Result<_, ProblemError>>()?,
                is_positive: draft.is_positive,
            })
        });
        let orientations = orientations.collect::<Result<Vec<_>, ProblemError>>()?;
        let reference = match &self.reference {
            None => None,
            Some(names) => {
                let found = names
                    .iter()
                    .map(|name| find(Place::Reference, "the reference", name));
                let found = found.collect::<Result<Vec<usize>, _>>()?;
                check_reference(self.dimension, &points, &found)?;
                Some(found)
            }
        };
        let bend = match &self.bend {
            // Where there are no distances, nothing bends.
            None => distances.len().saturating_sub(1),
            Some(names) => {
                let [a, b] = names.as_slice() else {
                    let given = counted(names.len(), "point");
                    let text =
                        format!("the bend has {given}, but must be the two points of a distance");
                    return Err(ProblemError::at(Place::Bend, text));
                };
                let (i, j) = (
                    find(Place::Bend, "the bend", a)?,
                    find(Place::Bend, "the bend", b)?,
                );
                let at = distances
                    .iter()
                    .position(|d| d.points == [i, j] || d.points == [j, i]);
                at.ok_or_else(|| not_a_distance(&format!("{a}-{b}")))?
            }
        };
        let choice = |number: &Option<Number>, place, what: &str| {
            let number = number.clone().transpose();
            number.map_err(ProblemError::number(place, what.to_owned()))
        };
        let coefficient = &self.bend_coefficient;
        let coefficient = choice(
            coefficient,
            Place::BendCoefficient,
            "the bend's coefficient",
        )?;
        let bend_coefficient = coefficient.unwrap_or_else(|| bend::default_coefficient(&distances));
        let detour = choice(&self.detour, Place::Detour, "the detour")?;
        let detour = detour.unwrap_or(Decimal::from(0));
        let mut problem = Problem {
            labels: Default::default(),
            tolerances: Default::default(),
            measures: Vec::new(),
            parameters: Vec::new(),
            kept: Default::default(),
            name: self.name,
            dimension: self.dimension,
            source: self.source,
            points,
            objects,
            distances,
            constraints,
            orientations,
            homotopy: HomotopyChoices {
                reference: Vec::new(),
                bend,
                bend_coefficient,
                detour,
            },
        };
        check_orientations(&problem)?;
        if self.loose {
            check_names(&problem)?;
            check_sketch(&problem.points, &problem.distances)?;
            return Ok(problem);
        }
        let own_frame = constraint::frame_of(&problem).frame;
        let count = problem.points.len();
        if !own_frame {
            check_enough_points(problem.dimension, count)?;
        }
        check_names(&problem)?;
        if problem.is_distances_only() {
            problem.check_together()?;
        }
        check_sketch(&problem.points, &problem.distances)?;
        if problem.is_distances_only() && problem.distances.is_empty() {
            let text = "there are no distances";
            return Err(ProblemError::structure(Place::Distances, text));
        }
        problem.homotopy.reference = match (reference, own_frame) {
            (Some(_), true) => {
                let all = 0..problem.constraints.len();
                let fixing =
                    all.map(|index| (index, &problem.constraints[index]))
                        .find(|(_, c)| {
                            let kind = constraint::kind(&c.kind);
                            kind.is_some_and(|kind| (kind.fixes)(&problem, c).frame)
                        });
                let name = fixing.map(|(index, _)| problem.constraint_name(index));
                let name = name.map_or("a body with joints".to_owned(), |name| format!("`{name}`"));
                let text = format!(
                    "there is a reference, but {name} says where figures are or which way they lie: results are in the coordinates of the sketch, so leave the reference out"
                );
                return Err(ProblemError::at(Place::Reference, text));
            }
            (None, true) => Vec::new(),
            (Some(reference), false) => reference,
            (None, false) => reference::choose(
                problem.dimension,
                &problem.points,
                &problem.distances,
                &problem.objects,
                bend,
            )
            .ok_or_else(|| {
                let text = "all points of the sketch lie on one line, so nothing can serve as reference: move at least one point off it";
                ProblemError::at(Place::Whole, text)
            })?,
        };
        if !problem.is_distances_only() {
            problem.check_together()?;
        }
        Ok(problem)
    }

    fn finished_points(&self) -> Result<Vec<Point>, ProblemError> {
        let points = self.points.iter().enumerate().map(|(index, draft)| {
            let DraftPoint { name, coordinates } = draft;
            let (given, wanted) = (coordinates.len(), self.dimension);
            if given != wanted {
                return Err(ProblemError::coordinates(index, name, given, wanted));
            }
            let wrong = |axis: usize| {
                let what = format!("the point `{name}`, coordinate {}", axis + 1);
                ProblemError::number(Place::Point(index), what)
            };
            Ok(Point {
                name: name.clone(),
                sketch: three(coordinates, wrong)?,
            })
        });
        points.collect()
    }

    fn finished_distances(
        &self,
        find: impl Fn(Place, &str, &str) -> Result<usize, ProblemError>,
    ) -> Result<Vec<Distance>, ProblemError> {
        let lengths = self.lengths.iter().map(|draft| (draft, "distance"));
        let squares = self
            .squared_lengths
            .iter()
            .map(|draft| (draft, "squared distance"));
        lengths
            .chain(squares)
            .enumerate()
            .map(|(index, (draft, kind))| {
                let place = Place::Distance(index);
                let shown = |name: &str| name.chars().take(MAX_NAME).collect::<String>();
                let [a, b] = &draft.points;
                let what = format!("the {kind} {}-{}", shown(a), shown(b));
                let points = [find(place, &what, a)?, find(place, &what, b)?];
                let target = draft.target.clone();
                let target = target.map_err(ProblemError::number(place, what))?;
                let target = match kind {
                    "distance" => Target::Length(target),
                    _ => Target::SquaredLength(target),
                };
                Ok(Distance { points, target })
            })
            .collect()
    }
}

fn check_size(name: &str, dimension: usize, points: usize) -> Result<(), ProblemError> {
    check_name(Place::Name, name)?;
    if !matches!(dimension, 2 | 3) {
        return Err(ProblemError::dimension(dimension));
    }
    if points > MAX_POINTS {
        return Err(ProblemError::too_many_points(points));
    }
    Ok(())
}

/// Names of points can be shown and are different, and in the plane points are flat.
fn check_points(dimension: usize, points: &[Point]) -> Result<(), ProblemError> {
    let mut seen = HashSet::new();
    for (index, Point { name, sketch }) in points.iter().enumerate() {
        check_name(Place::Point(index), name)?;
        if !seen.insert(name) {
            let text = format!("the point `{name}` is given twice: rename or remove one");
            return Err(ProblemError::at(Place::Point(index), text));
        }
        if dimension == 2 && sketch[2] != Decimal::from(0) {
            return Err(ProblemError::coordinates(index, name, 3, 2));
        }
    }
    Ok(())
}

/// As many points as a reference needs.
fn check_enough_points(dimension: usize, points: usize) -> Result<(), ProblemError> {
    if points < dimension {
        let (are, given) = (either(points, "is", "are"), counted(points, "point"));
        let text = format!(
            "there {are} {given}, but a problem of dimension {dimension} needs at least {dimension}"
        );
        return Err(ProblemError::structure(Place::Whole, text));
    }
    Ok(())
}

pub(super) fn check_name(place: Place, name: &str) -> Result<(), ProblemError> {
    let length = name.chars().count();
    if name.trim().is_empty() || length > MAX_NAME || name.chars().any(char::is_control) {
        let name: String = name.chars().take(MAX_NAME).collect();
        let text = format!(
            "the name {name:?} cannot be used: a name has 1 to {MAX_NAME} characters, no control characters among them"
        );
        return Err(ProblemError::at(place, text));
    }
    Ok(())
}

/// Lengths are positive, and no pair of points has two of them or is no pair.
fn check_distances(points: &[Point], distances: &[Distance]) -> Result<(), ProblemError> {
    let mut seen = HashSet::new();
    for (index, distance) in distances.iter().enumerate() {
        let [a, b] = distance.points;
        let name = format!("{}-{}", points[a].name, points[b].name);
        let wrong = |text: String| Err(ProblemError::at(Place::Distance(index), text));
        if a == b {
            return wrong(format!(
                "the distance {name} joins the point to itself: remove it"
            ));
        }
        if !seen.insert([a.min(b), a.max(b)]) {
            return wrong(format!(
                "the distance {name} is given twice (as length, squared or reversed): remove one of them"
            ));
        }
        let (kind, value) = match &distance.target {
            Target::Length(length) => ("distance", length),
            Target::SquaredLength(square) => ("squared distance", square),
        };
        if !value.is_positive() {
            let hint = match value.value().is_zero() {
                true => ": for two points in one place say `coincident`",
                false => "",
            };
            return wrong(format!(
                "the {kind} {name} is {value}, but must be greater than zero{hint}"
            ));
        }
        let mut ends = value.limits().into_iter().flatten();
        if let Some(end) = ends.find(|end| !end.is_positive()) {
            return wrong(format!(
                "a limit of the {kind} {name} is {end}, but must be greater than zero"
            ));
        }
    }
    Ok(())
}

/// Each orientation is of different points, one more than there are dimensions, and no two are of the same ones.
fn check_orientations(problem: &Problem) -> Result<(), ProblemError> {
    let mut seen: HashMap<Vec<usize>, (usize, bool)> = HashMap::new();
    for (index, one) in problem.orientations.iter().enumerate() {
        let wrong = |fault: String| {
            let name = problem.orientation_name(index);
            let place = Place::Orientation(index);
            Err(ProblemError::at(place, format!("`{name}`: {fault}")))
        };
        let wanted = problem.dimension + 1;
        if one.points.len() != wanted {
            let of = match problem.dimension {
                2 => "three points in the plane",
                _ => "four points in space",
            };
            return wrong(format!("it is of {of}, and here are {}", one.points.len()));
        }
        let sorted = one.in_order();
        if let Some(pair) = sorted.points.windows(2).find(|pair| pair[0] == pair[1]) {
            let twice = &problem.points[pair[0]].name;
            return wrong(format!(
                "`{twice}` is named twice, and the points must be different"
            ));
        }
        match seen.insert(sorted.points, (index, sorted.is_positive)) {
            None => {}
            Some((before, sign)) => {
                let other = problem.orientation_name(before);
                return wrong(match sign == sorted.is_positive {
                    true => format!("it says the same as `{other}`: remove one of them"),
                    false => format!(
                        "it contradicts `{other}`, of the same points: each swap of two points changes the sign"
                    ),
                });
            }
        }
    }
    Ok(())
}

/// Every distance starts from a length greater than zero.
fn check_sketch(points: &[Point], distances: &[Distance]) -> Result<(), ProblemError> {
    for (index, distance) in distances.iter().enumerate() {
        let [a, b] = distance.points;
        if coincide(&points[a], &points[b]) {
            let (a, b) = (&points[a].name, &points[b].name);
            let text = format!(
                "the points of the distance {a}-{b} coincide in the sketch: move one of them"
            );
            return Err(ProblemError::at(Place::Distance(index), text));
        }
    }
    Ok(())
}

/// The reference points span a line (in the plane) or a plane (in space).
fn check_reference(
    dimension: usize,
    points: &[Point],
    reference: &[usize],
) -> Result<(), ProblemError> {
    if reference.len() != dimension {
        return Err(reference_count(reference.len(), dimension));
    }
    let wrong = |text: String| Err(ProblemError::at(Place::Reference, text));
    let degenerate = "the reference is degenerate";
    let choose = "in the sketch. Choose others, or leave the choice to krawl";
    for (k, &a) in reference.iter().enumerate() {
        for &b in &reference[..k] {
            let [other, name] = [b, a].map(|p| &points[p].name);
            if a == b {
                return wrong(format!(
                    "the reference names the point `{name}` twice: its points must be different"
                ));
            }
            if coincide(&points[a], &points[b]) {
                return wrong(format!(
                    "{degenerate}: `{other}` and `{name}` coincide {choose}"
                ));
            }
        }
    }
    if let [a, b, c] = *reference
        && collinear(&points[a], &points[b], &points[c])
    {
        let [a, b, c] = [a, b, c].map(|p| &points[p].name);
        return wrong(format!(
            "{degenerate}: `{a}`, `{b}` and `{c}` lie on one line {choose}"
        ));
    }
    Ok(())
}

/// Not one reference point per dimension.
fn reference_count(given: usize, wanted: usize) -> ProblemError {
    let given = counted(given, "point");
    let text = format!("the reference has {given}, but needs {wanted}");
    ProblemError::at(Place::Reference, text)
}

/// The bend is not among the distances.
fn not_a_distance(name: &str) -> ProblemError {
    let text = format!("the bend {name} is not one of the distances: name the two points of one");
    ProblemError::at(Place::Bend, text)
}
