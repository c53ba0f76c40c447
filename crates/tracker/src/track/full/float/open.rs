//! Paths that do not come back to the sketch, in floats: both ways from it to their two ends. Nothing is proved.

use super::{SAME_LENGTH, follow};
use crate::system::Homotopy;
use crate::track::ends::{
    Away, DEGENERATE, EndKind, FAR, PathEnd, SETTLED, SINGULAR, both_ways, farthest, in_words,
    places, size_of, vanishing,
};
use crate::track::float::Record;
use crate::track::full::{Equations, Preconditioner, condition};
use crate::track::{Control, LARGEST_SQUARE, Options, Outcome, Status, Stop, StopKind};

/// Why a run ended before it came back to the sketch.
#[derive(Debug)]
pub enum Halt {
    /// It was stopped.
    Stopped(Stop),
    /// It came to an end of the path.
    Ended(Box<PathEnd>),
}

impl From<Stop> for Halt {
    fn from(stop: Stop) -> Self {
        Halt::Stopped(stop)
    }
}

/// Follows the path, and where it comes to an end the other way from the sketch as well. `record` is that of a run that
/// begins.
pub fn follow_both_ways<Y: Preconditioner>(
    homotopy: &Homotopy,
    (equations, maker): (&Equations, &mut Y::Maker),
    options: &Options,
    control: &mut Control,
    mut record: Record,
) -> Outcome {
    let mut way = |options: &Options, record: &mut Record| {
        follow::<Y>(homotopy, (equations, &mut *maker), options, control, record)
    };
    let status = match way(options, &mut record) {
        Ok(()) => Status::Closed,
        Err(Halt::Stopped(stop)) => Status::Stopped(stop),
        Err(Halt::Ended(end)) => {
            let mut back = Record::new();
            match way(&options.clone().reversed(), &mut back) {
                Ok(()) => {
                    // It came back to the sketch after all.
                    record.give_way_to(back);
                    Status::Closed
                }
                Err(halt) => {
                    record.go_on_from(back, equations.m);
                    both_ways(
                        *end,
                        match halt {
                            Halt::Ended(other) => Ok(*other),
                            Halt::Stopped(stop) => Err(stop),
                        },
                    )
                }
            }
        }
    };
    record.into_outcome(homotopy, status, SAME_LENGTH)
}

/// Watches for the ends of a path. Distances alone have none: they cannot let a figure grow beyond bounds while t does
/// not, and there is nothing in them that must not vanish.
pub struct Ends<'h> {
    homotopy: &'h Homotopy,
    /// All unknowns in the sketch.
    sketch: Vec<f64>,
    size_of_sketch: f64,
    positive: Vec<usize>,
    vectors: Vec<Vec<[usize; 2]>>,
}

impl<'h> Ends<'h> {
    /// For the path through this sketch (all unknowns); `None` for a problem of distances.
    pub fn new(homotopy: &'h Homotopy, sketch: &[f64]) -> Option<Self> {
        (!homotopy.tail.is_empty()).then(|| Ends {
            homotopy,
            sketch: sketch.to_vec(),
            size_of_sketch: size_of(homotopy, sketch),
            positive: homotopy.positive_unknowns(),
            vectors: homotopy.nonzero_vectors(),
        })
    }

    /// What has gone through zero from one point to the next, the points being (X, t): a length or radius, or a vector
    /// that must not vanish. Beyond there is no figure. A vector may also turn by more than a right angle from one point
    /// to the next; if these are near enough to each other it cannot, but near zero.
    pub fn passed(&self, now: &[f64], next: &[f64]) -> Option<&str> {
        let (homotopy, m) = (self.homotopy, self.homotopy.equations);
        let first = homotopy.gauge.place.len();
        if let Some(&i) = self.positive.iter().find(|&&i| next[i] <= 0.0) {
            return Some(&homotopy.tail.unknowns[i - first].name);
        }
        let mut lengths = homotopy.lengths.iter().zip(&homotopy.names);
        if let Some((_, name)) = lengths.find(|(length, _)| length.value(next[m]) <= 0.0) {
            return Some(name);
        }
        let is_reversed = |vector: &Vec<[usize; 2]>| {
            let along = |z: &[f64], [i, j]: [usize; 2]| {
                let at = |i: usize| if i < m { z[i] } else { 0.0 };
                at(i) - at(j)
            };
            let products = vector.iter().map(|&d| along(now, d) * along(next, d));
            products.sum::<f64>() <= 0.0
        };
        let k = self.vectors.iter().position(is_reversed)?;
        Some(&homotopy.tail.nonzero[k].name)
    }

    /// The end of a path on which something goes through zero between two points.
    pub fn undefined(&self, now: &[f64], next: &[f64], reason: String) -> Halt {
        let m = self.homotopy.equations;
        Halt::Ended(Box::new(PathEnd {
            t: (now[m].min(next[m]), now[m].max(next[m])),
            ..self.end(now, EndKind::Undefined, String::new(), reason)
        }))
    }

    /// The point that goes away, if at this point of the path, with this direction there, one is far from the others and
    /// moves away, and t settles.
    pub fn away(&self, z: &[f64], slope: &[f64]) -> Option<Away> {
        let (homotopy, m) = (self.homotopy, self.homotopy.equations);
        let (p, size) = farthest(homotopy, z)?;
        if size.is_nan() || size <= FAR * self.size_of_sketch {
            return None;
        }
        let (mut square, mut outward) = (0.0, 0.0);
        for i in (0..homotopy.dimension).filter_map(|axis| homotopy.coordinate(p, axis)) {
            square += z[i] * z[i];
            outward += z[i] * slope[i];
        }
        let change = slope[m].abs() * square / outward;
        let settles = outward > 0.0 && change < SETTLED && (z[m] - 1.0).abs() > 10.0 * change;
        let distance = square.sqrt() * homotopy.unit;
        settles.then_some(Away {
            point: p,
            distance: (distance, distance),
        })
    }

    /// The end of a path on which a point goes away; `place` says where, in words.
    pub fn infinite(&self, z: &[f64], away: Away, place: &str) -> Halt {
        let what = in_words(self.homotopy, away);
        let words = format!("{what}, {place}");
        Halt::Ended(Box::new(PathEnd {
            away: Some(away),
            ..self.end(z, EndKind::Infinite, what, words)
        }))
    }

    /// What a run has come to that cannot go on at this point of the path, with this normal: the end of the path if
    /// something has nearly vanished there, or if the equations have become dependent.
    pub fn stuck(&self, equations: &Equations, (z, normal): (&[f64], &[f64]), stop: Stop) -> Halt {
        let (homotopy, m) = (self.homotopy, self.homotopy.equations);
        let leg = homotopy.remark_on_lengths(z[m]);
        let small = vanishing(homotopy, z, &self.sketch, self.size_of_sketch);
        // Where matrices would be too large nothing is said of the condition.
        let is_singular = || {
            equations.n() <= LARGEST_SQUARE
                && condition(equations, z, normal).is_none_or(|condition| condition > SINGULAR)
        };
        let (kind, what) = if let Some(name) = small {
            (EndKind::Undefined, format!("{name} goes to zero"))
        } else if !leg.is_empty() {
            let what = leg.trim_start_matches("; ").to_owned();
            (EndKind::Undefined, what)
        } else if is_singular() {
            (EndKind::Degenerate, DEGENERATE.to_owned())
        } else {
            return stop.into();
        };
        let words = format!("{what}: {stop}");
        Halt::Ended(Box::new(self.end(z, kind, what, words)))
    }

    fn end(&self, z: &[f64], kind: EndKind, what: String, reason: String) -> PathEnd {
        let t = z[self.homotopy.equations];
        PathEnd {
            t: (t, t),
            kind,
            stop: None,
            what,
            reason,
            away: None,
            points: places(self.homotopy, z),
        }
    }
}

/// Where t goes on without end: an end of the path if it has any, see [`Ends`].
pub fn endless(ends: Option<&Ends<'_>>, z: &[f64], words: String) -> Halt {
    match ends {
        Some(ends) => {
            let what = String::new();
            Halt::Ended(Box::new(ends.end(z, EndKind::Infinite, what, words)))
        }
        None => Stop::new(StopKind::Infinite, words).into(),
    }
}
