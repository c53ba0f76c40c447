//! Constraints: what each kind means, and the equations that it becomes.
//!
//! A [`Problem`] holds constraints as plain data: the key of a kind, what it names, and a number. What
//! that means is said here, one file for each kind in `kinds/`, and one list of them, [`KINDS`]. Whoever
//! adds a kind writes its file and names it in the list; reading, writing, checking and describing
//! problems go by what it says of itself ([`Kind`]).
//!
//! # Which way a constraint is led from the sketch to its target
//!
//! A number (a distance, the cosine of an angle, a radius, a coordinate) goes linearly from what it is in
//! the sketch to its target. Sides and senses that a number does not tell are read off the sketch: on
//! which side of a line a point is, which of the two angles of lines is meant, on which side of a line a
//! tangent circle is.
//!
//! What holds or does not (parallel, coplanar, on, ...) is a value that is zero where it holds. Where the
//! sketch does not meet it, the value goes linearly to zero, and is not zero in between (Imbach, Mathis,
//! Schreck on tracking with coplanarities, 5.2). Where the sketch meets it exactly, it is kept: the
//! equation has zero on its right-hand side all along the path, because who draws a right angle and
//! changes a length expects a right angle all the way. Some figures that a path through such
//! constraints meets are singular where each constraint by itself is not: faces of a polyhedron that fall into
//! one plane. `detour` in a problem's `[homotopy]` takes the path round them:
//! the values are then `δ t (1 − t)`.

use crate::places::array;

mod arguments;
mod assembly;
mod diameters;
mod directions;
mod factors;
mod frame;
mod heights;
mod kind;
mod kinds;
mod lowering;
mod objects;
mod polynomial;
mod quadratic;
mod structure;
mod subtracted;
mod supposed;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod twins;
mod zeros;

// What krawl's other packages have of the inside.
#[doc(hidden)]
pub use self::{
    arguments::{Arguments, Flat, LineName, Sort, Thing},
    frame::{cross, dot, is_zero, vector},
    kinds::is_opposite_nearer,
    lowering::{Fault, Lowered, MOST_TURN, Record},
    objects::{base_of, own_number},
    structure::check_structure,
};
pub use heights::{Divided, Origin, divide, odd_ones};
pub use kind::{Fixes, Kind, Measure};
pub use kinds::{EQUATIONS, KINDS};
pub use lowering::Spare;
pub use quadratic::{
    Entry, Equation, Form, MAX_DEGREE, Nonzero, Posed, Product, Role, Tail, Unknown, coordinate,
    difference, value,
};
pub use structure::{size, size_in_edits};
pub use supposed::{equations_with_roots, supposed_lengths};

use crate::interval::Interval;
use crate::statement::Problem;
use kind::Given;
use lowering::{Lowering, Start};

/// The kind that has this key in problem files.
pub fn kind(key: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|kind| kind.key == key)
}

/// Where among [`KINDS`] the kind is that has this key: problems have their constraints in this order.
pub fn order_of_kind(key: &str) -> Option<usize> {
    KINDS.iter().position(|kind| kind.key == key)
}

/// What the number of a constraint of a problem is, by the constraint's index.
pub fn measure_of(problem: &Problem, index: usize) -> Measure {
    let constraint = &problem.constraints[index];
    let items = Arguments::new(problem, &constraint.items);
    kind(&constraint.kind).map_or(Measure::Nothing, |kind| match kind.measure_of {
        Some(measure_of) => measure_of(items),
        None => kind.measure,
    })
}

/// What a constraint of a problem is read as being of, where points in it stand for lines or planes: `the line
/// through d and e, and the plane through a, b and c`. `None`: each of its names is one thing, or it cannot be read.
pub fn read_as(problem: &Problem, index: usize) -> Option<String> {
    let constraint = &problem.constraints[index];
    let items = Arguments::new(problem, &constraint.items);
    match items.left() > 2 {
        true => (kind(&constraint.kind)?.read_as)(items),
        false => None,
    }
}

/// The auxiliary unknowns and the equations of all constraints of a problem that are not distances
/// between points.
///
/// `sketch`: the coordinates of every point of the sketch as the reference sees them, in the
/// problem's unit.
///
/// # Panics
/// If the problem has not been checked ([`Problem::check`]).
pub fn lower(problem: &Problem, sketch: &[[Interval; 3]]) -> Tail {
    assert_eq!(problem.points.len(), sketch.len());
    match try_lower(problem) {
        Ok(lowered) => lowered.tail,
        Err((_, fault)) => panic!("the problem has not been checked: {fault}"),
    }
}

/// The same equations for sets of all figures, which know t = 1 alone.
///
/// - Vectors are divided by their lengths, where these are no dimensions (`lowering/heading.rs`).
/// - What is zero in all figures is left out, and factors that are zero in none; what is equal in all has one name (`factors.rs`).
/// - Where the middle of a circle is on a chord, it is the chord's middle (`diameters.rs`).
/// - What is as long as a given length has that length (`subtracted.rs`).
///
/// The equations of distances between points are among them, and come first, if [`has_distances_in_sets`]. `leave_out` takes
/// equations out where there are more than unknowns.
#[doc(hidden)]
pub fn try_lower_for_sets(
    problem: &Problem,
    leave_out: impl Fn(&mut Lowered) -> Result<Vec<Spare>, Fault>,
) -> Result<(Tail, Vec<Spare>), Fault> {
    let low = || Lowering::new(problem, Start::Sketch, false).with_headings();
    let which = match has_distances_in_sets(problem) {
        true => Which::AllForSets,
        false => Which::Constraints,
    };
    let lower = |low| try_lower_from(problem, low, which).map_err(|(_, fault)| fault);
    let mut lowered = lower(low())?;
    let mut spare = leave_out(&mut lowered)?;
    let first = problem.objects.len() + problem.constraints.len() + 1;
    // The number of a distance that is left out is in no other equation.
    if lowered.gives_lengths && spare.iter().any(|spare| spare.owner >= first) {
        lowered = lower(low().with_dimensions_apart())?;
        spare = leave_out(&mut lowered)?;
    }
    // Lengths are positive in a problem that has been checked.
    let is_left_out = |index: usize| spare.iter().any(|spare| spare.owner == first + index);
    let used = problem.distances.iter().enumerate();
    let used = used.filter(|(index, _)| !is_left_out(*index));
    let apart: Vec<[usize; 2]> = used.map(|(_, d)| d.points).collect();
    let (tail, vanishing) = (&mut lowered.tail, &lowered.vanishing);
    factors::take_out(tail, vanishing, &apart, problem.dimension);
    Ok((lowered.tail, spare))
}

/// Whether the equations for sets have the distances between points, too: where constraints may say that some of their coordinates are equal.
pub fn has_distances_in_sets(problem: &Problem) -> bool {
    !problem.constraints.is_empty()
}

/// Which other figures satisfy the constraints where one does: what *congruent* means for solutions of a
/// problem.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Symmetry {
    /// The same figure moved or mirrored.
    #[default]
    Isometries,
    /// The same figure moved: a constraint says which way round it is.
    Motions,
    /// None: constraints say where the figure is.
    Identity,
}

/// The symmetry of a checked problem.
///
/// ```
/// use krawl::constraint::{Symmetry, symmetry};
/// use krawl::problem::Problem;
/// # std::env::set_current_dir("../..").unwrap();
/// let octahedron = Problem::read("problems/octahedron.toml")?;
/// assert_eq!(symmetry(&octahedron), Symmetry::Isometries);
/// # Ok::<(), krawl::problem::FileError>(())
/// ```
pub fn symmetry(problem: &Problem) -> Symmetry {
    if problem.is_absolute() {
        return Symmetry::Identity;
    }
    match try_lower(problem) {
        _ if problem.is_distances_only() => Symmetry::Isometries,
        Ok(lowered) if lowered.tail.mirrors => Symmetry::Isometries,
        _ => Symmetry::Motions,
    }
}

/// What an object or constraint that cannot be put to work is, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Owner {
    /// An object.
    Object(usize),
    /// A constraint.
    Constraint(usize),
}

/// What is wrong with bodies with joints by themselves, and the object at fault.
#[doc(hidden)]
pub fn check_joints(problem: &Problem) -> Result<(), (usize, Fault)> {
    assembly::Assembly::of(problem).map(|_| ())
}

/// The equations of a problem with a reference and known names, or the first object or constraint at fault.
#[doc(hidden)]
pub fn try_lower(problem: &Problem) -> Result<Lowered, (Owner, Fault)> {
    try_lower_from(
        problem,
        Lowering::new(problem, Start::Sketch, false),
        Which::Constraints,
    )
}

/// All equations of a problem in its own frame, distances among them, which come last. Left-hand sides do not depend
/// on the values of dimensions; `from`: a figure that meets all constraints with the dimensions of that lowering is
/// where the path begins, otherwise it is the sketch.
///
/// The problem need not have as many equations as unknowns.
#[doc(hidden)]
pub fn try_lower_all(problem: &Problem, from: Option<&Record>) -> Result<Lowered, (Owner, Fault)> {
    let from = from.map_or(Start::Sketch, Start::Dimensions);
    try_lower_from(problem, Lowering::new(problem, from, true), Which::AllFree)
}

/// The same from the sketch, with the numbers of distances in no other equation: whichever of them are left out, the others say what their
/// constraints say.
#[doc(hidden)]
pub fn try_lower_all_apart(problem: &Problem) -> Result<Lowered, (Owner, Fault)> {
    let low = Lowering::new(problem, Start::Sketch, true).with_dimensions_apart();
    try_lower_from(problem, low, Which::AllFree)
}

/// The equations of all constraints of a problem that are not distances between points, as [`lower`] makes them, but with
/// left-hand sides that do not depend on the values of dimensions: for edits of any of them. `from`: as in
/// [`try_lower_all`].
#[doc(hidden)]
pub fn try_lower_editable(
    problem: &Problem,
    from: Option<&Record>,
) -> Result<Lowered, (Owner, Fault)> {
    let from = from.map_or(Start::Sketch, Start::Dimensions);
    try_lower_from(
        problem,
        Lowering::new(problem, from, true),
        Which::Constraints,
    )
}

/// The same from the sketch with each right-hand side that of one dimension alone, [`Lowering::with_dimensions_apart`]: as much as any of these
/// is changed, together or not, no left-hand side is, and no right-hand side but its own.
#[doc(hidden)]
pub fn try_lower_apart(problem: &Problem) -> Result<Lowered, (Owner, Fault)> {
    let low = Lowering::new(problem, Start::Sketch, true).with_dimensions_apart();
    try_lower_from(problem, low, Which::Constraints)
}

/// Which equations are made.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Which {
    /// Those of constraints that are not distances between points, and what nothing holds is held.
    Constraints,
    /// All, and what nothing holds is held where it is chosen, by whoever asks.
    AllFree,
    /// All, for t = 1 alone, distances first; and what nothing holds is held.
    AllForSets,
}

fn try_lower_from<'a>(
    problem: &'a Problem,
    mut low: Lowering<'a>,
    which: Which,
) -> Result<Lowered, (Owner, Fault)> {
    let objects = problem.objects.len();
    for object in 0..objects {
        low.begin(object);
        let done = low.object(object);
        done.map_err(|fault| (Owner::Object(object), fault))?;
    }
    for (index, constraint) in problem.constraints.iter().enumerate() {
        low.begin(objects + index);
        let fail = |fault| (Owner::Constraint(index), fault);
        let kind = kind(&constraint.kind)
            .ok_or_else(|| fail(format!("there is no kind `{}`", constraint.kind)))?;
        check_value(kind, problem, index).map_err(fail)?;
        let given = Given {
            name: &problem.constraint_name(index),
            items: Arguments::new(problem, &constraint.items),
            value: constraint.value.as_ref(),
        };
        (kind.lower)(given, &mut low).map_err(fail)?;
    }
    let own = objects + problem.constraints.len();
    low.begin(own);
    if which != Which::AllFree {
        pin(problem, &mut low);
    }
    if which != Which::Constraints {
        for index in 0..problem.distances.len() {
            low.begin(own + 1 + index);
            match which {
                Which::AllForSets => low.distance_for_sets(index),
                _ => low.distance(index),
            }
        }
    }
    Ok(low.finish())
}

/// Holds the first point where nothing says where the figure is along an axis of the user's frame.
fn pin(problem: &Problem, low: &mut Lowering) {
    for axis in pinned_axes(problem) {
        let name = format!("{} held where the sketch has it", low.name(0));
        low.hold(&name, 0, axis);
    }
}

/// The axes along which krawl holds the first point: those of a problem in the user's own frame in
/// which no constraint fixes a place.
pub fn pinned_axes(problem: &Problem) -> Vec<usize> {
    if !problem.is_absolute() {
        return Vec::new();
    }
    let fixes = frame_of(problem);
    (0..problem.dimension).filter(|&k| !fixes.axes[k]).collect()
}

/// Whether constraints say where the figure is or how it is turned, as a place or a coordinate does. Otherwise it is a figure up to
/// rigid motions.
pub fn fix_frame(problem: &Problem) -> bool {
    frame_of(problem).frame
}

/// What of the frame the constraints fix together.
#[doc(hidden)]
pub fn frame_of(problem: &Problem) -> Fixes {
    // Of bodies with joints one stands.
    if problem.points.is_empty() || problem.has_joints() {
        return Fixes {
            frame: true,
            axes: [true; 3],
        };
    }
    let kinds = problem.constraints.iter();
    kinds
        .filter_map(|c| Some((kind(&c.kind)?.fixes)(problem, c)))
        .fold(Fixes::default(), |all, one| Fixes {
            frame: all.frame || one.frame,
            axes: array(|k| all.axes[k] || one.axes[k]),
        })
}

/// Whether a constraint has a number where its kind has, in the kind's range.
fn check_value(kind: &Kind, problem: &Problem, index: usize) -> Result<(), Fault> {
    let value = &problem.constraints[index].value;
    let measure = measure_of(problem, index);
    let wanted = match measure {
        Measure::Nothing => None,
        Measure::Length | Measure::Ratio => Some("a number greater than zero"),
        Measure::Signed => Some("a number"),
        Measure::Turn => Some("a number of degrees"),
        Measure::Degrees => Some("an angle between 0 and 180 degrees"),
        Measure::Slope => Some("an angle greater than 0 and at most 90 degrees"),
    };
    match (value, wanted) {
        (None, None) => Ok(()),
        (Some(value), None) => Err(format!(
            "there is a number, {value}, but nothing to measure"
        )),
        (None, Some(wanted)) => Err(format!("there is no number at its end: give {wanted}")),
        (Some(value), Some(wanted)) => {
            let number = value.value();
            if measure.allows(value) {
                let mut ends = value.limits().into_iter().flatten();
                return match ends.find(|end| !measure.allows(end)) {
                    None => Ok(()),
                    Some(end) => Err(format!("a limit is {end}, but must be {wanted}")),
                };
            }
            let items = Arguments::new(problem, &problem.constraints[index].items);
            let hint = match measure {
                Measure::Slope => Some("for 0 degrees say `parallel`, for 90 `perpendicular`"),
                Measure::Degrees if problem.dimension == 2 => Some(
                    "it has no sense of turn; `turns` has one, counter-clockwise from the first leg or line to the second, and takes any \
                     number, in the same words",
                ),
                Measure::Degrees => Some("for 0 and 180 degrees say `parallel` or `collinear`"),
                _ if number.is_zero() => (kind.instead_of_zero)(items),
                _ => None,
            };
            let hint = hint.map(|hint| format!(": {hint}")).unwrap_or_default();
            Err(format!("the number is {value}, but must be {wanted}{hint}"))
        }
    }
}
