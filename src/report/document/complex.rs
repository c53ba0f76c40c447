//! What `krawl complex` writes.

use super::{Bounds, JSON_VERSION, ManyDigits, Named, all, names};
use crate::complex::infinity::Departure;
use crate::complex::{Bound, Counts, Lowered, Nature, SolutionBox, Solutions};
use crate::interval::Interval;
use crate::problem::Problem;
use crate::report::complex::{coordinate, others, vanishing};

/// Bounds of a real and of an imaginary part.
pub type Parts = [Bounds; 2];

keys! {
    /// The complex solutions of a problem.
    Complex(problem: &Problem, lowered: &Lowered, result: &Solutions) {
        /// Of the format.
        version: u32 = JSON_VERSION,
        /// `complex`.
        verb: String = "complex".into(),
        /// The name of the problem.
        problem: String = problem.name.clone(),
        /// `complete`, `found` or `partial`.
        status: String = result.status.name().into(),
        /// How many there are at most, if that is known.
        bound: Option<BoundOf> = lowered.bound.as_ref().map(BoundOf::new),
        /// From where they are seen.
        gauge: String = lowered.system.gauge.clone(),
        /// How many there are.
        counts: Counts = result.counts,
        /// The real ones, by number.
        real: Vec<usize> = result.real().collect(),
        /// How many paths went beyond the radius.
        infinite: usize = result.infinite.len(),
        /// Figures at infinity.
        at_infinity: Vec<AtInfinity> = all(&result.departures, |one| AtInfinity::new(problem, one)),
        /// Why paths stopped.
        stopped: Vec<String> = result.stopped.clone(),
        /// How many came to where another had come.
        repeated: usize = result.repeated,
        /// How many solutions are conjugates of others, and no path came to them.
        conjugates: usize = result.conjugates,
        /// How many paths were followed.
        paths: usize = result.effort.paths,
        /// In how many tubes.
        tubes: usize = result.effort.tubes,
        /// Whether they were followed with proof.
        paths_proved: bool = result.paths_proved,
        /// In how many steps.
        steps: usize = result.effort.steps,
        /// In how many of them with more digits.
        double_steps: usize = result.effort.double_steps,
        /// How long it took.
        seconds: f64 = result.seconds,
        /// The solutions.
        solutions: Vec<ComplexFigure> = all(result.boxes.boxes().iter().zip(&result.natures), |(one, nature)| {
            ComplexFigure::new(problem, lowered, one, *nature)
        }),
    }
    or nothing {
        /// Each solution to many digits.
        digits: Option<Vec<ManyDigits>> = None,
    }
}

keys! {
    /// How many solutions there are at most.
    BoundOf(bound: &Bound) {
        /// The number.
        count: f64 = bound.count as f64,
        /// Where it comes from.
        source: String = bound.source.clone(),
        /// Whether somebody cites it.
        cited: bool = bound.is_cited,
    }
}

keys! {
    /// Figures at infinity.
    AtInfinity(problem: &Problem, departure: &Departure) {
        /// The points that go there.
        points: Vec<String> = names(problem, &departure.split.inside),
        /// The one cycle among their neighbours, in its order.
        cycle: Vec<String> = names(problem, &departure.split.cycle),
        /// How many there are.
        figures: usize = departure.figures.len(),
    }
}

keys! {
    /// A solution.
    ComplexFigure(problem: &Problem, lowered: &Lowered, one: &SolutionBox, nature: Nature) {
        /// `real`, `self-conjugate`, `pair`, `alone` or `unknown`.
        kind: String = nature.name().into(),
        /// The number of its conjugate, where that is another.
        conjugate: Option<usize> = match nature {
            Nature::Pair(other) => Some(other),
            _ => None,
        },
        /// Its points.
        points: Named<Vec<Parts>> = Named::each(problem, &lowered.system.points, |&unknown| {
            coordinate(lowered, one, nature, unknown).each_ref().map(ends)
        }),
        /// What else was unknown.
        unknowns: Named<Parts> = Named(all(others(lowered), |u| {
            let parts = coordinate(lowered, one, nature, Some(u));
            (lowered.system.unknowns[u].name.clone(), parts.each_ref().map(ends))
        })),
        /// Vectors that vanish in it, as far as its box tells.
        vanishing: Vec<String> = all(vanishing(lowered, one), str::to_owned),
    }
}

/// Bounds as they are.
fn ends(x: &Interval) -> Bounds {
    [x.inf(), x.sup()]
}
