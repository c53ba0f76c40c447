//! Which distances a motion is followed by, where there are more than say something new, and how it stands to the others.

use super::bounds::{Bounds, measure};
use crate::blocks::{Account, Floats, Ruler, System, Verdict, Whose, straight};
use crate::edit::Round;
use crate::interval::{Interval, hull};
use crate::linalg::Span;
use crate::problem::{Problem, free_coordinates, rigidity_row};
use crate::system::{Quantity, typical_length};
use crate::track::Control;

/// In how many ways the points of a problem of distances alone can begin to move as they are drawn, as far as floats tell.
pub(super) fn freedom(problem: &Problem) -> usize {
    let (rank, _) = taken(problem, None, 0);
    free_coordinates(problem.dimension, problem.points.len()).saturating_sub(rank)
}

/// The distances that say nothing new beside others and one more, by index: those written last, or, with another `choice` than 0, those
/// before some other place. `None`: that one says nothing new itself.
pub(super) fn surplus(problem: &Problem, driver: [usize; 2], choice: usize) -> Option<Vec<usize>> {
    let (rank, surplus) = taken(problem, Some(driver), choice);
    (rank == free_coordinates(problem.dimension, problem.points.len())).then_some(surplus)
}

/// How many distances say something new, after a first one, and the indices of the others.
fn taken(problem: &Problem, first: Option<[usize; 2]>, choice: usize) -> (usize, Vec<usize>) {
    let places = problem.places();
    let row = |edge| rigidity_row(problem.dimension, &places, edge);
    let mut span = Span::default();
    if let Some(first) = first {
        span.take([row(first)]);
    }
    let count = problem.distances.len();
    let order = (0..count).map(|k| (k + choice * count / super::CHOICES) % count.max(1));
    let mut surplus: Vec<usize> = order
        .filter(|&index| !span.take([row(problem.distances[index].points)]))
        .collect();
    surplus.sort_unstable();
    (span.rank(), surplus)
}

/// A problem of distances alone with the figure for a sketch that is nearest to it and meets them, in floats, and how far a point was moved at
/// most. Any other problem, and one without such a figure, as it is.
pub(super) fn corrected(problem: &Problem) -> (Problem, f64) {
    let found = match problem.is_distances_only() && problem.points.len() <= MOST_POINTS {
        true => met(problem),
        false => None,
    };
    found.unwrap_or_else(|| (problem.clone(), 0.0))
}

fn met(problem: &Problem) -> Option<(Problem, f64)> {
    let (unit, d) = (typical_length(problem), problem.dimension);
    let (straight, lowered) = straight(problem).ok()?;
    let system = System::new(&straight, &lowered, |_| true);
    let floats = Floats::new(&system, &lowered.tail.equations, unit);
    let all: Vec<usize> = (0..system.rows.len()).collect();
    let near = floats.meet(&all, system.sketch(unit))?;
    let mut out = problem.clone();
    let mut moved: f64 = 0.0;
    for (p, point) in out.points.iter_mut().enumerate() {
        let mut square = 0.0;
        for axis in 0..d {
            let (at, drawn) = (
                unit * near[system.coordinates[p * d + axis]],
                point.sketch[axis].to_f64(),
            );
            if at != drawn {
                point.sketch[axis] = format!("{at:e}").parse().ok()?;
            }
            square += (at - drawn).powi(2);
        }
        moved = moved.max(square.sqrt());
    }
    Some((out, moved))
}

/// Larger figures are led to their dimensions along a path.
const MOST_POINTS: usize = 100;
/// What is proved of the figures of a path: how they stand to the distances that were left out.
pub(super) fn account(
    problem: &Problem,
    left_out: &[usize],
    round: &Round,
    control: &Control,
) -> Account {
    let mut account = Account::of(problem, round.equations());
    let unit = typical_length(problem);
    for &index in left_out {
        let distance = &problem.distances[index];
        let target = distance.target.enclose();
        let epsilon = Ruler::new(problem, Whose::Distance(index), (unit, 2), None).epsilon;
        let quantity = Quantity::length(problem, distance.points);
        let verdict = match measure(round, quantity, control).bounds {
            Bounds::Between { least, most } => {
                verdict((least.value - target, most.value - target), epsilon)
            }
            _ => Verdict::Undecided {
                at_most: f64::INFINITY,
            },
        };
        account.leave_out(problem.distance_name(index), verdict);
    }
    account
}

/// Of a length that is off its target by so much at the least, and by so much at the most.
fn verdict((low, high): (Interval, Interval), epsilon: f64) -> Verdict {
    // A figure reaches into each, and the others are between.
    let all = Verdict::of(hull(low.inf(), high.sup()), epsilon);
    let missed = [low, high].map(|off| Verdict::of(off, epsilon));
    match missed.into_iter().find(|one| one.is_missed()) {
        Some(one) => one.beside(all),
        None => all,
    }
}
