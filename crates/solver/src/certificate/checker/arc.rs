//! Arcs of edits: t rises along them, up to t = 1 or to a fold; and the signs that they keep.

use super::equations::{Equations, ZERO};
use super::guess;
use super::matrix::{exact, size};
use super::place::{HALF, Place, Spot, component};
use super::tube::{Tube, everywhere};
use crate::certificate::format::{ArcClaim, FoldClaim, TubeClaim};
use crate::certificate::verdict::{Fault, Flaw};
use crate::constraint::{Record, try_lower_editable};
use crate::interval::{Interval, point};
use crate::problem::{Problem, Target};
use crate::system::{Homotopy, is_met};

/// A problem with its dimensions as edits have led them, and what its constraints were led to.
pub struct Edits {
    problem: Problem,
    record: Record,
}

impl Edits {
    pub fn new(problem: &Problem) -> Self {
        Edits {
            problem: problem.clone(),
            record: Record::default(),
        }
    }

    /// The equations of the next edit: everything stands still but the dimensions that are led. In the first one they
    /// may be none: then the sketch is led to all of the problem's dimensions, without a bend. `before`: the homotopy
    /// of the edit before, or the problem's. `Err`: the claim that fails, and whether it is false.
    pub fn equations(
        &mut self,
        claim: &ArcClaim,
        number: usize,
        before: &Homotopy,
    ) -> Result<Equations, (bool, Flaw)> {
        let fault = || (false, Flaw::Arc(number));
        let (problem, mut homotopy) = (&mut self.problem, before.clone());
        if number == 1 {
            let met = (0..problem.distances.len()).all(|d| is_met(problem, d));
            if !(claim.dimensions.is_empty() || met && problem.is_distances_only()) {
                return Err((!met, Flaw::Met));
            }
            problem.homotopy.bend_coefficient = 0.into();
            problem.homotopy.detour = 0.into();
            let lowered = try_lower_editable(problem, None).map_err(|_| fault())?;
            let first = Homotopy::with_constraints(problem, before.unit, |_| lowered.tail);
            (homotopy, self.record) = (first.map_err(|_| fault())?, lowered.record);
        }
        if number > 1 || !claim.dimensions.is_empty() {
            let mut edited = problem.clone();
            for (index, value) in &claim.dimensions {
                let index = *index as usize;
                match index.checked_sub(problem.distances.len()) {
                    None => edited.distances[index].target = Target::Length(value.clone()),
                    Some(index) => edited.constraints[index].value = Some(value.clone()),
                }
            }
            let record = homotopy.lead_all(&self.record, (problem, &edited));
            (self.record, self.problem) = (record.ok_or_else(fault)?, edited);
        }
        Ok(Equations::new(homotopy))
    }
}

/// A fold: the zero of F(X, t), J v and c·(v − v₀) in (X, v, t), the only one in a region. There the path's
/// tangent is (v, 0), and as the Jacobian of these equations is regular, t'' ≠ 0 (Moore and Spence, SIAM J. Numer.
/// Anal. 17, 1980).
pub struct Fold {
    place: Place,
    /// c·v₀, not zero.
    along: Interval,
    /// Where it is, in n entries.
    pub spot: Spot,
}

impl Fold {
    /// Proves that there is one in a box; c is the normal of the tube in which the path comes there.
    pub fn prove(eq: &Equations, claim: &FoldClaim, tube: &TubeClaim) -> Result<Fold, Fault> {
        let (m, folds) = (eq.m, eq.of_folds());
        let near = guess::fold(eq, claim, tube)?;
        let mut c = vec![0.0; 2 * m + 1];
        for (c, &along) in c[m..].iter_mut().zip(&tube.normal[..m]) {
            *c = along.into();
        }
        let of = (&c[..], &vec![HALF; 2 * m + 1][..]);
        let place = Place::prove(&folds, (&near, false), of, Vec::new())?;
        let entries = || (0..m).chain([2 * m]);
        let spot = Spot {
            near: entries().map(|i| place.spot.near[i]).collect(),
            rest: entries().map(|i| place.spot.rest[i]).collect(),
        };
        let v: Vec<Interval> = place.spot.near.iter().map(|&x| exact(x)).collect();
        let along = component(&v, &c);
        let figure = spot.is_within(&claim.figure.centre, claim.figure.radius);
        let off = size(spot.at(m) - point(claim.t));
        let inside = figure && off.sup() <= claim.t_radius.into();
        // Otherwise the path would have met the figure wanted by then, and the fold be no limit.
        let early = spot.at(m).sup() < 1.0;
        match inside && early && !along.contains(0.0) {
            true => Ok(Fold { place, along, spot }),
            false => Err(Fault::because(
                "the box is too narrow for the one near it, or t may not be below 1 there",
            )),
        }
    }

    /// Whether this is the only place with dt/dσ = 0 in a range of a tube's parameters, if there is one: such a place,
    /// with φ' scaled to c·φ' = c·v₀, is a zero of this fold's equations, near enough to be this one.
    fn is_alone(&self, tube: &Tube, s: Interval) -> bool {
        let m = self.spot.near.len() - 1;
        let x = (0..m).map(|i| tube.beyond(0.0, i, s));
        let v = (0..m).map(|i| tube.slope(i, s) * self.along / tube.advance);
        let z: Vec<Interval> = x.chain(v).chain([tube.beyond(0.0, m, s)]).collect();
        self.place.covers(&z)
    }
}

/// Proves that t rises in a range of a tube's parameters; where that leads to a fold, up to there. That it rises at its
/// beginning is known. `Err`: a range where it may not, and whether it certainly does not.
pub fn rises(tube: &Tube, range: Interval, fold: Option<&Fold>) -> Result<(), (Interval, bool)> {
    let falls = |s: Interval| tube.time_slope(s).sup() < 0.0;
    let holds = |s: Interval| {
        tube.time_slope(s).inf() > 0.0 || fold.is_some_and(|fold| fold.is_alone(tube, s))
    };
    everywhere(range, holds, falls).map_err(|s| (s, fold.is_none() && falls(s)))
}

/// Proves that triangles or tetrahedra have these signs, (points, whether it is positive), in a range of a tube's
/// parameters. `Err`: a range where one may have another, and whether it certainly has.
pub fn keeps(
    eq: &Equations,
    tube: &Tube,
    range: Interval,
    signs: &[(Vec<u32>, bool)],
) -> Result<(), (Interval, bool)> {
    let all = |s: Interval, test: &dyn Fn(Interval) -> bool| {
        let z: Vec<Interval> = (0..eq.m).map(|i| tube.beyond(0.0, i, s)).collect();
        let mut values = signs.iter().map(|(points, positive)| {
            let value = determinant(eq, &z, points);
            if *positive { value } else { -value }
        });
        values.all(test)
    };
    let fails = |s: Interval| !signs.is_empty() && !all(s, &|x| x.sup() >= 0.0);
    let holds = |s: Interval| signs.is_empty() || all(s, &|x| x.inf() > 0.0);
    everywhere(range, holds, fails).map_err(|s| (s, fails(s)))
}

/// The determinant of the differences of some points from the first of them.
fn determinant(eq: &Equations, z: &[Interval], points: &[u32]) -> Interval {
    let d = |k: usize, axis: usize| {
        let of = |k: usize| {
            let i = eq.homotopy.coordinate(points[k] as usize, axis);
            i.map_or(ZERO, |i| z[i])
        };
        of(k) - of(0)
    };
    let minor = |a: usize, i: usize, j: usize| d(a, i) * d(a + 1, j) - d(a, j) * d(a + 1, i);
    match points.len() {
        3 => minor(1, 0, 1),
        _ => d(1, 0) * minor(2, 1, 2) + d(1, 1) * minor(2, 2, 0) + d(1, 2) * minor(2, 0, 1),
    }
}
