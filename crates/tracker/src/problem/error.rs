//! What can be wrong with a problem, wherever it comes from.

use super::{DecimalError, counted, either};

/// Why points, distances and homotopy do not make a problem that krawl takes.
///
/// Every message names the point or the constraint and says what to do; [`ProblemError::place`]
/// says which part of the input is meant, for whoever knows lines or widgets.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// Neither plane nor space.
    #[error("the dimension is {0}, but must be 2 (plane) or 3 (space)")]
    Dimension(String),
    /// A name that cannot be shown.
    #[error(
        "the name {name:?} cannot be used: a name has 1 to {MAX_NAME} characters, no control characters among them"
    )]
    BadName {
        /// Where the name stands.
        place: Place,
        /// The name, shortened.
        name: String,
    },
    /// More points than the arithmetic is made for.
    #[error("there are {0} points, more than the {MAX_POINTS} that are read")]
    TooManyPoints(usize),
    /// Fewer points than a reference needs.
    #[error(
        "there {} {}, but a problem of dimension {dimension} needs at least {dimension}",
        either(*.given, "is", "are"), counted(*.given, "point")
    )]
    TooFewPoints {
        /// How many there are.
        given: usize,
        /// 2 or 3.
        dimension: usize,
    },
    /// Two points of the same name.
    #[error("the point `{name}` is given twice: rename or remove one")]
    RepeatedPoint {
        /// The second of them.
        index: usize,
        /// The name.
        name: String,
    },
    /// Not one number per dimension.
    #[error("the point `{name}` has {}, but needs {wanted}", counted(*.given, "coordinate"))]
    CoordinateCount {
        /// Which point.
        index: usize,
        /// Its name.
        name: String,
        /// How many numbers there are.
        given: usize,
        /// The dimension.
        wanted: usize,
    },
    /// A number that is not a finite decimal of sensible size.
    #[error("{what}: {source}")]
    Number {
        /// Where the number stands.
        place: Place,
        /// What it is the number of.
        what: String,
        /// What is wrong with it.
        source: DecimalError,
    },
    /// A name that no point has, or, in constraints of other kinds than distances, no object either.
    #[error("{what}: there is no point{} `{name}`{}", if *.objects { " or object" } else { "" }, did_you_mean(.nearest))]
    UnknownPoint {
        /// Whether objects could be named too.
        objects: bool,
        /// Where the name is used.
        place: Place,
        /// What uses it.
        what: String,
        /// The name.
        name: String,
        /// The most similar name that there is.
        nearest: Option<String>,
    },
    /// A name in the table of places that no body has.
    #[error("the table of places: there is no body `{name}`{}", did_you_mean(.nearest))]
    UnknownBody {
        /// Which place, in the order of the names.
        index: usize,
        /// The name.
        name: String,
        /// The most similar name that a body has.
        nearest: Option<String>,
    },
    /// A distance from a point to itself.
    #[error("the distance {name} joins the point to itself: remove it")]
    SelfDistance {
        /// Which distance.
        index: usize,
        /// `p1-p1`.
        name: String,
    },
    /// A distance between points that already have one.
    #[error(
        "the distance {name} is given twice (as length, squared or reversed): remove one of them"
    )]
    RepeatedDistance {
        /// The second of them.
        index: usize,
        /// `p1-p2`.
        name: String,
    },
    /// A length that no two different points have.
    #[error("the {kind} {name} is {value}, but must be greater than zero{}", instead_of_zero(.value))]
    NotPositive {
        /// Which distance.
        index: usize,
        /// `distance` or `squared distance`.
        kind: &'static str,
        /// `p1-p2`.
        name: String,
        /// The number, as written.
        value: String,
    },
    /// Not as many distances as free coordinates.
    #[error("{}", count_message(*.dimension, *.points, *.needed, *.given, .parts))]
    Count {
        /// 2 or 3.
        dimension: usize,
        /// The number of points.
        points: usize,
        /// How many distances are needed.
        needed: usize,
        /// How many there are.
        given: usize,
        /// Which parts have too many or too few.
        parts: String,
    },
    /// The right number of distances, in the wrong places.
    #[error("the distances are as many as needed, but not where they are needed: {parts}")]
    Structure {
        /// The first distance that adds nothing to those before it.
        index: usize,
        /// Which parts have too many or too few.
        parts: String,
    },
    /// A length that would have to start from zero.
    #[error("the points of the distance {name} coincide in the sketch: move one of them")]
    Coincident {
        /// Which distance.
        index: usize,
        /// `p1-p2`.
        name: String,
    },
    /// Not one reference point per dimension.
    #[error("the reference has {}, but needs {wanted}", counted(*.given, "point"))]
    ReferenceCount {
        /// How many there are.
        given: usize,
        /// The dimension.
        wanted: usize,
    },
    /// A point twice in the reference.
    #[error("the reference names the point `{0}` twice: its points must be different")]
    ReferenceRepeated(String),
    /// Two reference points in one place.
    #[error(
        "the reference is degenerate: `{0}` and `{1}` coincide in the sketch. Choose others, or leave the choice to krawl"
    )]
    ReferenceCoincident(String, String),
    /// Three reference points on one line.
    #[error(
        "the reference is degenerate: `{0}`, `{1}` and `{2}` lie on one line in the sketch. Choose others, or leave the choice to krawl"
    )]
    ReferenceCollinear(String, String, String),
    /// No choice of a reference is possible.
    #[error(
        "all points of the sketch lie on one line, so nothing can serve as reference: move at least one point off it"
    )]
    CollinearSketch,
    /// The bend is not two points.
    #[error("the bend has {}, but must be the two points of a distance", counted(*.0, "point"))]
    BendCount(usize),
    /// The bend is not among the distances.
    #[error("the bend {0} is not one of the distances: name the two points of one")]
    BendNotADistance(String),
    /// Nothing to meet.
    #[error("there are no distances")]
    NoDistances,
    /// A name that a point or another object has already, or an axis.
    #[error("the name `{name}` is taken: rename the {what}")]
    RepeatedName {
        /// Where it is given again.
        place: Place,
        /// What it is given to: `line`, `plane`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A kind of object that there is not in the plane, or not in space.
    #[error("the {what} `{name}`: there are {what}s in {space} only")]
    WrongSpace {
        /// Which object.
        index: usize,
        /// What it is.
        what: &'static str,
        /// Its name.
        name: String,
        /// Where there are some.
        space: &'static str,
    },
    /// A kind of constraints that there is not.
    #[error("there is no kind of constraints `{kind}`{}", did_you_mean(.nearest))]
    UnknownKind {
        /// The kind.
        kind: String,
        /// The most similar one that there is.
        nearest: Option<String>,
    },
    /// A constraint given twice.
    #[error("`{name}` is given twice: remove one of them")]
    RepeatedConstraint {
        /// The second of them.
        index: usize,
        /// The constraint.
        name: String,
    },
    /// An object that cannot be put to work.
    #[error("the {what} `{name}`: {fault}")]
    Object {
        /// Which object.
        index: usize,
        /// What it is.
        what: &'static str,
        /// Its name.
        name: String,
        /// What is wrong, and what to do.
        fault: String,
    },
    /// A constraint that cannot be put to work.
    #[error("`{name}`: {fault} (it takes {takes})")]
    Constraint {
        /// Which constraint.
        index: usize,
        /// The constraint.
        name: String,
        /// What is wrong, and what to do.
        fault: String,
        /// What its kind takes.
        takes: &'static str,
    },
    /// An equation that cannot be read.
    #[error("{fault}")]
    Equation {
        /// Which constraint.
        index: usize,
        /// What is wrong, and where.
        fault: String,
    },
    /// A sign that cannot be asked for.
    #[error("`{name}`: {fault}")]
    Orientation {
        /// Which orientation.
        index: usize,
        /// The orientation.
        name: String,
        /// What is wrong, and what to do.
        fault: String,
    },
    /// Not as many equations as unknowns, or not where they are needed.
    #[error("{fault}")]
    System {
        /// The part to point at.
        place: Place,
        /// What is too much or missing.
        fault: String,
    },
    /// A reference where the frame is the user's own.
    #[error(
        "there is a reference, but {0} says where figures are or which way they lie: results are in the coordinates of the sketch, so leave the reference out"
    )]
    ReferenceInOwnFrame(String),
}

crate::debug_in_words!(ProblemError);

/// Most points that are read.
///
/// Large enough for structures of ten thousand free coordinates; small enough that the checks, which
/// for the densest graphs take time like the cube of the number, come to an end.
pub const MAX_POINTS: usize = 4000;

/// Most characters of a name.
pub const MAX_NAME: usize = 64;

/// A part of the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Place {
    /// The problem as a whole.
    Whole,
    /// Its name.
    Name,
    /// The dimension.
    Dimension,
    /// A point, by index.
    Point(usize),
    /// All distances.
    Distances,
    /// A distance, by index (lengths first, then squared lengths).
    Distance(usize),
    /// The reference.
    Reference,
    /// The bend.
    Bend,
    /// The bend's coefficient.
    BendCoefficient,
    /// The detour.
    Detour,
    /// An object, by index.
    Object(usize),
    /// Where a body is drawn, by index in the order of the bodies' names.
    Pose(usize),
    /// A constraint that is no distance between points, by index.
    Constraint(usize),
    /// The sign of some points, by index.
    Orientation(usize),
}

impl ProblemError {
    /// Whether all is in order but that there are not as many equations as unknowns, or not where they are needed.
    pub fn is_about_structure(&self) -> bool {
        matches!(
            self,
            Self::System { .. }
                | Self::Count { .. }
                | Self::Structure { .. }
                | Self::NoDistances
                | Self::TooFewPoints { .. }
        )
    }

    /// The part of the input that is meant.
    pub fn place(&self) -> Place {
        match self {
            Self::Dimension(_) => Place::Dimension,
            Self::UnknownBody { index, .. } => Place::Pose(*index),
            Self::BadName { place, .. }
            | Self::Number { place, .. }
            | Self::UnknownPoint { place, .. } => *place,
            Self::TooManyPoints(_) | Self::TooFewPoints { .. } | Self::CollinearSketch => {
                Place::Whole
            }
            Self::RepeatedPoint { index, .. } | Self::CoordinateCount { index, .. } => {
                Place::Point(*index)
            }
            Self::SelfDistance { index, .. }
            | Self::RepeatedDistance { index, .. }
            | Self::NotPositive { index, .. }
            | Self::Structure { index, .. }
            | Self::Coincident { index, .. } => Place::Distance(*index),
            Self::Count { .. } | Self::NoDistances => Place::Distances,
            Self::ReferenceCount { .. }
            | Self::ReferenceRepeated(_)
            | Self::ReferenceCoincident(..)
            | Self::ReferenceCollinear(..) => Place::Reference,
            Self::BendCount(_) | Self::BendNotADistance(_) => Place::Bend,
            Self::RepeatedName { place, .. } | Self::System { place, .. } => *place,
            Self::WrongSpace { index, .. } | Self::Object { index, .. } => Place::Object(*index),
            Self::UnknownKind { .. } => Place::Distances,
            Self::RepeatedConstraint { index, .. }
            | Self::Constraint { index, .. }
            | Self::Equation { index, .. } => Place::Constraint(*index),
            Self::Orientation { index, .. } => Place::Orientation(*index),
            Self::ReferenceInOwnFrame(_) => Place::Reference,
        }
    }
}

/// `; did you mean ...?`, or nothing.
pub(super) fn did_you_mean(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}

/// What to say in place of a distance of two points that is zero.
fn instead_of_zero(value: &str) -> &'static str {
    match value.parse::<super::Decimal>() {
        Ok(number) if number.value().is_zero() => ": for two points in one place say `coincident`",
        _ => "",
    }
}

fn count_message(
    dimension: usize,
    points: usize,
    needed: usize,
    given: usize,
    parts: &str,
) -> String {
    let (space, formula) = match dimension {
        2 => ("the plane", format!("2·{points} − 3")),
        _ => ("space", format!("3·{points} − 6")),
    };
    let verdict = match needed.abs_diff(given) {
        n if given < needed => format!("{n} {} missing", either(n, "is", "are")),
        n => format!("{n} {} too many", either(n, "is", "are")),
    };
    let are = either(given, "is", "are");
    let parts = if parts.is_empty() {
        String::new()
    } else {
        format!("; {parts}")
    };
    format!(
        "{points} points in {space} need {formula} = {needed} distances, and there {are} {given}: \
         {verdict}{parts}"
    )
}
