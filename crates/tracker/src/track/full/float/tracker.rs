//! Predictor and corrector with steps chosen from the corrector's contraction.

use super::crossing::{Crossing as FlatCrossing, distance};
use super::open::{Ends, Halt, endless, follow_both_ways};
use crate::linalg::{Matrix, Vector, dot};
use crate::places::array;
use crate::system::Homotopy;
use crate::track::ends::ENDLESS;
use crate::track::events::{Crossing, TimeAlong, halved};
use crate::track::float::{self, Record, SMALLEST_STEP, Tried};
use crate::track::full::{
    CrossingRoom, Equations, Local, ORDER, Preconditioner, first_normal, path_length, sketch,
};
use crate::track::{Control, Options, Outcome, Stop, StopKind};

/// Points of the path are corrected until the last correction is below this, in the homotopy's
/// unit, if nothing else is asked for; the next would be smaller still by the contraction.
const POINT_TOLERANCE: f64 = 1e-8;
/// The step is chosen so that the corrector's first two corrections shrink by this factor. The
/// factor is about |[J; c]⁻¹ F''| times the prediction's error, Kantorovich's number: it says how
/// deep in the basin of Newton's method the prediction is, whatever the problem's scale.
const CONTRACTION: f64 = 5e-5;
/// A prediction with a larger one is not trusted to be on the same path.
const LARGEST_CONTRACTION: f64 = 1e-3;
/// The tangent turns by at most this angle's cosine in a step.
const LEAST_COSINE: f64 = 0.8;
/// The expansions at either end of a step, from which is read what lies between, may be apart in the
/// middle by this part of the step.
const APART: f64 = 1e-3;
/// The first step, in the homotopy's unit.
const FIRST_STEP: f64 = 0.01;

/// Follows the path in the full space in floating point.
pub fn track(homotopy: &Homotopy, options: &Options, control: &mut Control) -> Outcome {
    let record = Record::new();
    let equations = Equations::new(homotopy);
    let system = (&equations, &mut equations.inverter());
    follow_both_ways::<Matrix>(homotopy, system, options, control, record)
}

/// Follows the path one way with any preconditioner. The error: where and why it ended before it was back.
pub fn follow<Y: Preconditioner>(
    homotopy: &Homotopy,
    (equations, inverter): (&Equations, &mut Y::Maker),
    options: &Options,
    control: &mut Control,
    record: &mut Record,
) -> Result<(), Halt> {
    let (m, n) = (equations.m, equations.n());
    let tolerance = options
        .tolerance_in(homotopy.unit)
        .unwrap_or(POINT_TOLERANCE);
    let (mut now, mut next) = (Path::<Y>::new(equations), Path::<Y>::new(equations));
    let sketch = sketch(homotopy, equations);
    now.z[0].copy_from_slice(&sketch);
    first_normal(equations, inverter, &mut now, options.reverse).map_err(|_| {
        let singular = || "the sketch is a singular point of its path".to_owned();
        Stop::new(StopKind::Sketch, now.y.obstacle().unwrap_or_else(singular))
    })?;
    now.z[0].copy_from_slice(&sketch);
    now.refine(equations, inverter, tolerance, 8).map_err(|_| {
        let words = "the sketch could not be corrected onto its path";
        Stop::new(StopKind::Sketch, words)
    })?;
    now.expand(equations);
    let direction = now.normal.clone();

    let ends = Ends::new(homotopy, &sketch);
    // Where something vanishes is known to that.
    let located = tolerance.max(2.0 * SMALLEST_STEP);
    let longest = options.step_in(homotopy.unit).unwrap_or(f64::INFINITY);
    let mut previous: Option<Vector> = None;
    let mut events = Events::<Y>::new(equations, tolerance);
    let mut crossing = FlatCrossing::new(homotopy);
    let may_try = |step: f64, _| step >= SMALLEST_STEP;
    let stuck = float::follow(FIRST_STEP.min(longest), may_try, |step, _| {
        now.predict(step, previous.as_deref(), &mut next.z[0], &mut next.normal);
        let refined = next.refine(equations, inverter, tolerance, 6).is_ok()
            && next.contraction <= LARGEST_CONTRACTION
            && next.negative == now.negative;
        if refined {
            next.expand(equations);
        }
        let turned = dot(&now.normal[..n], &next.normal[..n]) < LEAST_COSINE;
        // Beyond zero there is no figure.
        let passed = match &ends {
            Some(ends) if refined => ends.passed(&now.z[0], &next.z[0]),
            _ => None,
        };
        if let (Some(ends), Some(name)) = (&ends, passed)
            && step <= located
        {
            let words = format!("{name} goes to zero {}", record.place(now.z[0][m]));
            return Err(ends.undefined(&now.z[0], &next.z[0], words));
        }
        let seen = match refined {
            false => Err("the corrector fails"),
            true if passed.is_some() => Err("something goes to zero"),
            true if turned => Err("the path turns too much"),
            true => events.between((equations, inverter), &now, &next, step, record),
        };
        if let Err(reason) = seen {
            record.rejected += 1;
            return Ok(Tried::Failed(reason));
        }
        record.steps += 1;
        record.meet(next.z[0][m]);
        if let Some(at) = events.passes(&sketch, &direction, &now, &next, step)
            && record.steps > 1
        {
            record.length += events.length(&now, &next, step, at, homotopy.unit);
            return Ok(Tried::Closed);
        }
        record.length += events.length(&now, &next, step, 0.0, homotopy.unit);
        // The contraction grows with the (ORDER + 2)-nd power of the step.
        let growth = (CONTRACTION / next.contraction.max(1e-300)).powf(1.0 / (ORDER + 2) as f64);
        let mut step = (step * growth.clamp(0.5, 1.6)).min(longest);
        match &mut previous {
            Some(previous) => previous.copy_from_slice(&now.z[0]),
            None => previous = Some(now.z[0].clone()),
        }
        std::mem::swap(&mut now, &mut next);
        let crossed = crossing.as_mut().and_then(|crossing| {
            let system = (equations, &mut *inverter);
            crossing.cross(homotopy, system, &now, &mut next, tolerance)
        });
        if let Some(crossed) = crossed {
            record.flat(crossed.flat, m);
            record.steps += 1;
            record.meet(next.z[0][m]);
            let scratch = &mut events.scratch;
            record.length += path_length(&now, 0.0, crossed.advance, homotopy.unit, scratch);
            previous = None;
            step = crossed.advance.min(longest);
            std::mem::swap(&mut now, &mut next);
        }
        if let Some(ends) = &ends
            && let Some(away) = ends.away(&now.z[0], &now.z[1])
        {
            return Err(ends.infinite(&now.z[0], away, &record.place(now.z[0][m])));
        }
        if now.z[0][m].abs() > ENDLESS && now.z[0][m] * now.z[1][m] > 0.0 {
            let words = format!(
                "t has passed {:.1e} and moves away from 0; the path is not followed farther, {}",
                ENDLESS.copysign(now.z[0][m]),
                record.place(now.z[0][m])
            );
            return Err(endless(ends.as_ref(), &now.z[0], words));
        }
        record.go_on(now.z[0][m], options, control)?;
        Ok(Tried::Taken(step))
    })?;
    let Some(stuck) = stuck else {
        return Ok(());
    };
    let stop = record.stuck(homotopy, now.z[0][m], stuck);
    Err(match &ends {
        Some(ends) => ends.stuck(equations, (&now.z[0], &now.normal), stop),
        None => stop.into(),
    })
}

/// A point of the path with its expansion.
type Path<Y> = Local<{ ORDER + 1 }, Y>;

/// Finds what happens between two points of the path.
struct Events<Y> {
    tolerance: f64,
    /// Corrects solutions.
    solution: Path<Y>,
    crossings: Vec<Crossing>,
    room: CrossingRoom,
    scratch: Vector,
    other: Vector,
}

impl<Y: Preconditioner> Events<Y> {
    fn new(equations: &Equations, tolerance: f64) -> Self {
        Events {
            tolerance,
            solution: Path::new(equations),
            crossings: Vec::new(),
            room: CrossingRoom::new(equations),
            scratch: equations.vector(),
            other: equations.vector(),
        }
    }

    /// Records the solutions between two points: the first half of the way is read off the
    /// expansion at one, the second off the other. The error is the reason, for people: these do not
    /// meet in the middle, or the solutions could not be separated.
    fn between(
        &mut self,
        (equations, inverter): (&Equations, &mut Y::Maker),
        now: &Path<Y>,
        next: &Path<Y>,
        step: f64,
        record: &mut Record,
    ) -> Result<(), &'static str> {
        const UNDECIDED: &str = "it cannot be told whether the path meets t = 1";
        // The expansions are off by 2^-(ORDER + 1) of the prediction's error at half the way, and
        // their slopes by (ORDER + 1) / (step / 2) times that.
        let error = next.first_correction / 32.0 + 10.0 * self.tolerance;
        let half = 0.5 * step;
        let back = self.middle(now, next, half);
        // At hairpins that says little of the expansions themselves, as the prediction is better.
        next.at(back, &mut self.other);
        let apart = distance(&self.scratch, &self.other);
        if apart > APART * step {
            return Err("the expansions at a step's two ends do not meet");
        }
        let error = error.max(apart);
        for (local, from, to) in [(now, 0.0, half), (next, back, 0.0)] {
            let z: [f64; ORDER + 1] = array(|k| local.z[k][equations.m]);
            let reach = 2.0 * (to - from);
            let time = TimeAlong::new(&z, reach, error, 12.0 * error / step);
            time.crossings(from, to, &mut self.crossings)
                .map_err(|_| UNDECIDED)?;
            for k in 0..self.crossings.len() {
                let (a, b) = self.crossings[k].between;
                let (at, room) = (0.5 * (a + b), &mut self.room);
                let (guess, solution) = (&mut self.scratch, &mut self.solution);
                local
                    .crossing(equations, at, 1.0, room, guess)
                    .and_then(|()| record.solution((equations, &mut *inverter), solution, guess))
                    .ok_or(UNDECIDED)?;
            }
            let (_, (slope_low, slope_high)) = time.bounds(from, to);
            if slope_low < 0.0 && slope_high > 0.0 {
                record.meet(extreme(local, from, to, equations.m));
            }
        }
        Ok(())
    }

    /// The parameter at `next` of the point where the expansion at `now` is left for its own: the
    /// two have different normals, so it is not just the rest of the step.
    fn middle(&mut self, now: &Path<Y>, next: &Path<Y>, half: f64) -> f64 {
        now.at(half, &mut self.scratch);
        next.parameter_of(&self.scratch)
    }

    /// The path's length from `now` to the parameter `at` of `next`.
    fn length(&mut self, now: &Path<Y>, next: &Path<Y>, step: f64, at: f64, unit: f64) -> f64 {
        let back = self.middle(now, next, 0.5 * step);
        path_length(now, 0.0, 0.5 * step, unit, &mut self.scratch)
            + path_length(next, back, at, unit, &mut self.scratch)
    }

    /// Whether the path, followed in `direction`, passed the sketch between two points: at which
    /// parameter of `next`, if so.
    fn passes(
        &mut self,
        sketch: &[f64],
        direction: &[f64],
        now: &Path<Y>,
        next: &Path<Y>,
        step: f64,
    ) -> Option<f64> {
        let n = sketch.len() - 1;
        let t = n - 1;
        // Far more than t can change in a step along the path.
        if next.z[0][t].abs() > 2.0 * step {
            return None;
        }
        // The normals differ, so `now` is not just a step back.
        let (back, at) = (next.parameter_of(&now.z[0]), next.parameter_of(sketch));
        if !(back..=0.0).contains(&at) || dot(&next.normal[..n], &direction[..n]) <= 0.0 {
            return None;
        }
        // The expansion that is nearer is much the better one.
        if at < 0.5 * back {
            now.at(now.parameter_of(sketch), &mut self.scratch);
        } else {
            next.at(at, &mut self.scratch);
        }
        let away = distance(&self.scratch[..n], sketch);
        (away <= 10.0 * next.first_correction + 100.0 * self.tolerance.max(POINT_TOLERANCE))
            .then_some(at)
    }
}

/// The value of t where its slope vanishes, by bisection.
fn extreme<Y>(local: &Path<Y>, from: f64, to: f64, t: usize) -> f64 {
    let slope = |s: f64| {
        (1..=ORDER)
            .rev()
            .fold(0.0, |sum, k| sum * s + k as f64 * local.z[k][t])
    };
    let rises = slope(from) > 0.0;
    let (a, _) = halved((from, to), 50, |s| (slope(s) > 0.0) == rises);
    (0..=ORDER)
        .rev()
        .fold(0.0, |sum, k| sum * a + local.z[k][t])
}
