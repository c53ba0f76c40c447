//! What can be wrong with a problem, wherever it comes from.

use super::DecimalError;
use crate::statement::{counted, nearest};
use std::fmt::Display;

/// Why points, distances and homotopy do not make a problem that krawl takes.
///
/// Every message names the point or the constraint and says what to do; [`ProblemError::place`]
/// says which part of the input is meant, for whoever knows lines or widgets.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error("{text}")]
pub struct ProblemError {
    place: Place,
    is_about_structure: bool,
    text: String,
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
    /// What is wrong with a part of the input.
    pub(super) fn at(place: Place, text: impl Display) -> Self {
        ProblemError {
            place,
            is_about_structure: false,
            text: text.to_string(),
        }
    }

    /// Not as many equations as unknowns, or not where they are needed.
    pub(super) fn structure(place: Place, text: impl Display) -> Self {
        ProblemError {
            is_about_structure: true,
            ..Self::at(place, text)
        }
    }

    /// Neither plane nor space.
    pub(super) fn dimension(given: impl Display) -> Self {
        let text = format!("the dimension is {given}, but must be 2 (plane) or 3 (space)");
        Self::at(Place::Dimension, text)
    }

    /// More points than the arithmetic is made for.
    pub(super) fn too_many_points(given: usize) -> Self {
        let text = format!("there are {given} points, more than the {MAX_POINTS} that are read");
        Self::at(Place::Whole, text)
    }

    /// Not one number per dimension.
    pub(super) fn coordinates(point: usize, name: &str, given: usize, wanted: usize) -> Self {
        let given = counted(given, "coordinate");
        let text = format!("the point `{name}` has {given}, but needs {wanted}");
        Self::at(Place::Point(point), text)
    }

    /// A number that is not a finite decimal of sensible size.
    pub(super) fn number(place: Place, what: impl Display) -> impl FnOnce(DecimalError) -> Self {
        move |error| Self::at(place, format!("{what}: {error}"))
    }

    /// A name that nothing has of what is known.
    pub(super) fn unknown<'a>(
        place: Place,
        what: &str,
        (meant, name): (&str, &str),
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let shown: String = name.chars().take(MAX_NAME).collect();
        let nearest = did_you_mean(nearest(name, &mut known.into_iter()));
        Self::at(
            place,
            format!("{what}: there is no {meant} `{shown}`{nearest}"),
        )
    }

    /// Whether all is in order but that there are not as many equations as unknowns, or not where they are needed.
    pub fn is_about_structure(&self) -> bool {
        self.is_about_structure
    }

    /// The part of the input that is meant.
    pub fn place(&self) -> Place {
        self.place
    }
}

/// `; did you mean ...?`, or nothing.
pub(super) fn did_you_mean(nearest: Option<String>) -> String {
    nearest.map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}
