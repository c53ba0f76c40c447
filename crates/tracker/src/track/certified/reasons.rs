//! Why a run stops: what could not be proved, and the number that was in the way of it.
//!
//! Numbers are taken where something fails, or when the run stops, from what was tried last. Lengths
//! are in the homotopy's unit until they are put into words, which are about the problem's.

use super::link::{Ball, Frame, Tube};
use super::shortfall::Shortfall;
use crate::system::Homotopy;
use crate::track::events::Undecided;
use crate::track::full::{Equations, LARGEST_TANGENT, Local, Preconditioner, RefineError};

/// Why a tube could not be added to the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rejection {
    /// No point of the path was found.
    Refine(RefineError),
    /// The tube would be so short that it could not reach back: the half length that is foreseen.
    Short(f64),
    /// No tube around it could be proved.
    Unproved,
    /// It could not be linked to what comes before.
    Unlinked,
    /// What it holds could not be told.
    Undecided(Doubt),
}

impl Rejection {
    /// What 53 bits cannot do, where extended precision is switched on for it.
    pub fn in_short(self) -> &'static str {
        match self {
            Rejection::Refine(_) => "bring points onto the path",
            Rejection::Unproved => "prove a tube",
            Rejection::Short(_) | Rejection::Unlinked => "link two tubes",
            Rejection::Undecided(_) => "tell whether the path meets t = 1",
        }
    }
}

/// What could not be told of a tube that is proved and linked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Doubt {
    /// Whether t is 1 somewhere.
    Time(Undecided),
    /// Whether t goes on rising.
    Turn(Undecided),
    /// Where the solution is: Newton's method does not converge after a correction so large.
    Newton(f64),
    /// Where the solution is: Newton's method cannot begin, as the smallest pivot of the Jacobian is so many times
    /// the largest.
    Singular(f64),
    /// Whether an auxiliary unknown, of this number, is positive.
    Sign(usize),
    /// Whether a vector of the tail's list, of this number, is not zero.
    Vanishes(usize),
    /// Whether there is exactly one: |I − Y J| at its middle is this.
    Contraction(f64),
    /// Whether there is exactly one: it may be `radius` away from the middle, and is alone within `alone`.
    Wide { radius: f64, alone: f64 },
    /// Whether the solution, known up to `radius`, is in the stretch of the tube, which is so long.
    Outside { radius: f64, stretch: f64 },
    /// Whether it is one that was found before, which is at this distance; both are known up to
    /// `radius`.
    Twin { distance: f64, radius: f64 },
    /// Whether the path comes back to the sketch in the direction in which it left, which is
    /// known up to this.
    Direction(f64),
}

/// Why the path cannot even be set out upon, the Jacobian there having pivots of this ratio.
pub fn no_direction(pivots: f64) -> String {
    format!(
        "the sketch is a singular point of its path: no direction of travel could be computed, as the smallest \
         pivot of the Jacobian is {pivots:.1e} times its largest (whichever coordinate is held, the path moves \
         more than {LARGEST_TANGENT:.0e} times as far, or the matrix cannot be inverted)"
    )
}

/// In which precision that was.
pub fn precision(is_extended: bool) -> &'static str {
    if is_extended {
        ", even in extended precision"
    } else {
        ""
    }
}

/// Why no point was found, with the corrections that did not shrink.
pub fn unrefined<const N: usize, Y: Preconditioner>(
    error: RefineError,
    equations: &Equations,
    local: &mut Local<N, Y>,
    tolerance: f64,
    unit: f64,
) -> String {
    let (first, ratio) = (local.first_correction, local.contraction);
    match error {
        RefineError::Singular => local.y.obstacle().unwrap_or_else(|| {
            format!(
                "the Jacobian cannot be inverted in 53 bits: its smallest pivot is {:.1e} times the largest",
                local.pivot_ratio(equations)
            )
        }),
        RefineError::Diverged if !first.is_finite() => format!(
            "the corrector does not converge: its first correction, from a residual of {:.1e}, overflows",
            local.largest_residual(equations) * unit * unit
        ),
        RefineError::Diverged if ratio > 0.25 || ratio.is_nan() => format!(
            "the corrector does not converge: its first correction is {:.1e}, the next {ratio:.1e} times that",
            first * unit
        ),
        RefineError::Diverged if local.is_extended => format!(
            "the corrector does not converge: its corrections stay at {:.1e}, after a first one of {:.1e}",
            local.find_correction(equations) * unit,
            first * unit
        ),
        RefineError::Diverged => {
            let size = local.correct(equations);
            format!(
                "the corrector does not converge: its corrections stay at {:.1e}, above {:.1e}",
                size * unit,
                tolerance * unit
            )
        }
    }
}

/// Why no tube is proved, or where none of the conditions fails, why one that is has no use.
pub fn unproved<const N: usize, Y>(
    shortfall: Option<Shortfall>,
    tube: &Tube<N, Y>,
    unit: f64,
) -> String {
    let why = match shortfall {
        Some(shortfall) => shortfall.scaled(unit).to_string(),
        None => {
            let widest = tube.weights.iter().fold(0.0, |a: f64, &b| a.max(b));
            format!(
                "where the path leaves it is not known as well as the tube is wide, {:.1e}",
                widest * tube.proof.r * unit
            )
        }
    };
    format!("the Krawczyk test fails however short the tube: {why}")
}

/// Why the point in `ball`, `what`, is not known to be the path's in a tube, or the path not to go on
/// there in the tube's direction, known up to `direction`.
pub fn unlinked<const N: usize, Y: Frame>(
    what: &str,
    ball: &Ball,
    direction: f64,
    tube: &Tube<N, Y>,
    unit: f64,
) -> String {
    const UNLINKED: &str = "the tube could not be linked to what comes before it";
    let n = tube.weights.len() - 1;
    let h = tube.proof.h;
    let s = tube.parameter_near(ball);
    if s.is_nan() || s.abs() > h {
        return format!(
            "{UNLINKED}: {what} is {:.1e} from its middle, and it reaches {:.1e} to either side",
            s.abs() * unit,
            h * unit
        );
    }
    let radius = ball.radius[..n].iter().fold(0.0, |a: f64, &b| a.max(b)) * unit;
    let Some((along, away)) = tube.spread(ball, s) else {
        return format!(
            "{UNLINKED}: {what} is known up to {radius:.1e}, and the tube, which reaches {:.1e} to either side, \
             bends too much",
            h * unit
        );
    };
    let ratio = away / tube.proof.r;
    match tube.locate(ball) {
        None if s.abs() + along > h => format!(
            "{UNLINKED}: {what} is known up to {radius:.1e}, and it may be {:.1e} from the tube's middle, which \
             reaches {:.1e} to either side",
            (s.abs() + along) * unit,
            h * unit
        ),
        None => format!(
            "{UNLINKED}: {what} is known up to {radius:.1e}, and with that {ratio:.2} times as far from the tube's middle \
             as the tube is wide"
        ),
        Some(entry) if entry.1 >= tube.exit_at => format!(
            "{UNLINKED}: {what} is known up to {radius:.1e}, and the tube reaches {:.1e} beyond it",
            (h - s) * unit
        ),
        Some(_) => format!(
            "{UNLINKED}: the path's direction is known up to {direction:.1e} there, too little to tell that it is the same"
        ),
    }
}

/// What could not be told of a tube.
pub fn undecided(doubt: Doubt, is_extended: bool, homotopy: &Homotopy) -> String {
    let unit = homotopy.unit;
    const WHETHER: &str = "it could not be decided whether the path meets t = 1";
    match doubt {
        Doubt::Time(Undecided { value, slope }) => format!(
            "{WHETHER}: a fold is too near, or two solutions are (t − 1 is between {:.1e} and {:.1e}, dt/ds \
             between {:.1e} and {:.1e})",
            value.0, value.1, slope.0, slope.1
        ),
        Doubt::Turn(Undecided { value, slope }) => format!(
            "it could not be decided whether the path turns back (t − 1 is between {:.1e} and {:.1e}, dt/ds \
             between {:.1e} and {:.1e})",
            value.0, value.1, slope.0, slope.1
        ),
        Doubt::Sign(unknown) => format!(
            "{} could not be proved to stay positive; the figure degenerates there, or nearly so",
            homotopy.tail.unknowns[unknown - homotopy.gauge.place.len()].name
        ),
        Doubt::Vanishes(vector) => format!(
            "{} could not be proved not to vanish; the figure degenerates there, or nearly so",
            homotopy.tail.nonzero[vector].name
        ),
        Doubt::Singular(pivots) => format!(
            "{WHETHER}: the Jacobian of a figure there is singular in 53 bits (its smallest pivot is {pivots:.1e} \
             times the largest)"
        ),
        Doubt::Newton(correction) => format!(
            "{WHETHER}: Newton's method does not come to a figure there (it begins with a correction of {:.1e})",
            correction * unit
        ),
        Doubt::Contraction(contraction) => format!(
            "{WHETHER} once: the test of a box around a figure there contracts by {contraction:.1e}, which must \
             be below 0.5{}",
            if is_extended {
                " (its Jacobian is in 53 bits)"
            } else {
                ""
            }
        ),
        Doubt::Wide { radius, alone } => format!(
            "{WHETHER} once: a figure there is known up to {:.1e}, and may have another within {:.1e}",
            radius * unit,
            alone * unit
        ),
        Doubt::Outside { radius, stretch } => format!(
            "{WHETHER} once: a figure there is known up to {:.1e}, too little to place it in a stretch of \
             {:.1e}",
            radius * unit,
            stretch * unit
        ),
        Doubt::Twin { distance, radius } => format!(
            "it could not be decided whether two solutions are one: they are {:.1e} apart, and known up to \
             {:.1e}",
            distance * unit,
            radius * unit
        ),
        Doubt::Direction(known) => format!(
            "it could not be decided whether the path comes back to the sketch in the direction in which it \
             left: that is known up to {known:.1e}"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::system::Homotopy;
    use crate::track::certified::solution::SolutionProver;

    fn problem() -> Problem {
        let file = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../problems/octahedron.toml"
        );
        Problem::read(file).unwrap()
    }

    #[test]
    fn what_cannot_be_refined_has_a_number() {
        let homotopy = Homotopy::new(&problem()).unwrap();
        let equations = Equations::new(&homotopy);
        let mut inverter = equations.inverter();
        let mut local = <Local>::new(&equations);
        let mut reason = |size: f64, normal: f64| {
            for i in 0..equations.m {
                local.z[0][i] = size * (i as f64 + 0.3).sin();
            }
            local.z[0][equations.m] = 0.5;
            local.normal[..equations.n()].fill(normal);
            let error = local
                .refine(&equations, &mut inverter, 1e-9, 8)
                .unwrap_err();
            unrefined(error, &equations, &mut local, 1e-9, homotopy.unit)
        };
        // All points in one.
        assert_eq!(
            reason(0.0, 0.1),
            "the Jacobian cannot be inverted in 53 bits: its smallest pivot is 0.0e0 times the largest"
        );
        // No cross-section.
        assert!(reason(1.0, 0.0).ends_with("its smallest pivot is 0.0e0 times the largest"));
    }

    #[test]
    fn figures_with_a_singular_jacobian_have_a_number() {
        let homotopy = Homotopy::new(&problem()).unwrap();
        let equations = Equations::new(&homotopy);
        let mut inverter = equations.inverter();
        let mut prover = SolutionProver::new(&homotopy, &equations);
        let guess = equations.vector();
        let doubt = prover
            .prove(&equations, &mut inverter, &guess, false)
            .unwrap_err();
        assert_eq!(doubt, Doubt::Singular(0.0));
        let reason = undecided(doubt, false, &homotopy);
        assert!(
            reason.contains("its smallest pivot is 0.0e0 times"),
            "{reason}"
        );
    }
}
