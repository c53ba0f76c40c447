//! The path as it was proved, kept to be drawn: the tubes' polynomials, and the folds.

use super::link::{Frame, Tube};
use crate::interval::along::Along;
use crate::interval::{Interval, hull, point};
use crate::places::{Each as _, array};
use crate::system::{Gauge, Homotopy, Located};
use crate::track::events::changes;
use crate::track::full::path_length;
use crate::track::turns::{Stretch, Turns};

/// What a certified run proves of its path, for pictures and files: to be given to
/// [`Control::trace`](crate::track::Control::trace).
///
/// Every tube is a polynomial ẑ(s) from which the path is nowhere further than a proved distance (far
/// less than shows in a picture). So samples are points beside the path, not points of it; folds are
/// enclosed.
///
/// ```
/// use krawl::problem::Problem;
/// use krawl::track::{Control, Options, Trace, solve};
///
/// # std::env::set_current_dir("../..").unwrap();
/// let problem = Problem::read("problems/octahedron.toml")?;
/// let mut trace = Trace::default();
/// let mut control = Control { trace: Some(&mut trace), ..Control::default() };
/// let outcome = solve(&problem, &Options::certified(), &mut control)?;
///
/// let samples = trace.samples(100);
/// assert_eq!(samples.len(), 100);
/// assert!((samples[99].at - outcome.length).abs() < 1e-9);
/// // t of a fold is known as far as the tube around it shows.
/// assert!(trace.folds().iter().all(|fold| fold.t.wid() < 0.05));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Trace {
    homotopy: Option<Homotopy>,
    unit: f64,
    /// Free coordinates, and t.
    width: usize,
    /// Coefficients of each polynomial.
    order: usize,
    /// The polynomials, one after the other, each with its constant terms first.
    coefficients: Vec<f64>,
    pieces: Vec<Piece>,
    turns: Turns,
    folds: Vec<Fold>,
    /// What holds the path since the sign of dt/ds was certain last.
    open: Option<Open>,
    /// The way from the sketch in the other direction, where the path has two ends.
    back: Option<Box<Trace>>,
}

/// The part of a tube that is the path's.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Parameters of the tube.
    from: f64,
    to: f64,
    /// Length of the path up to `from`, and up to `to`.
    at: f64,
    end: f64,
    /// How far the path may be from the tube's polynomial, in any unknown, coordinates in the problem's units.
    within: f64,
    /// Whether nothing is kept of the unknowns beside the coordinates.
    has_places_alone: bool,
}

#[derive(Debug, Clone)]
struct Open {
    /// Length of the path up to where t turns on the polynomial, or else to where this begins.
    at: f64,
    /// Whether it turns there.
    is_turn: bool,
    z: Vec<Interval>,
}

/// A place of the path (or beside it, at a distance that does not show).
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Length of the path from the sketch to here.
    pub at: f64,
    /// t there.
    pub t: f64,
    /// All points, in the gauge and the units of the problem.
    pub points: Vec<[f64; 3]>,
    /// The problem's objects, likewise: floats, as the points are.
    pub objects: Vec<Located>,
    /// The path's point in the cross-section through this place is no further from the middle of its tube, in any
    /// coordinate: proved. What is rounded where `points` are computed from the tube comes on top of it.
    pub within: f64,
}

/// A place where dt/ds changes its sign, and with it the direction in which the dimensions move.
#[derive(Debug, Clone, PartialEq)]
pub struct Fold {
    /// About the length of the path from the sketch to here.
    pub at: f64,
    /// An enclosure of t at the fold.
    pub t: Interval,
    /// Whether t rises after it, in the direction of travel.
    pub rising: bool,
    /// Enclosures of all points, in the gauge and the units of the problem.
    pub points: Vec<[Interval; 3]>,
}

impl Trace {
    /// A run begins: what was seen before is forgotten.
    pub(super) fn begin(&mut self, homotopy: &Homotopy) {
        *self = Trace::of(homotopy.clone());
    }

    /// Nothing seen yet.
    fn of(homotopy: Homotopy) -> Self {
        Trace {
            unit: homotopy.unit,
            width: homotopy.equations + 1,
            homotopy: Some(homotopy),
            ..Trace::default()
        }
    }

    /// The way ahead came to an end: what follows goes the other way from the sketch.
    pub(super) fn turn_back(&mut self) {
        self.back = self.homotopy.clone().map(Trace::of).map(Box::new);
    }

    /// The path, followed the other way from the sketch, came back to it: that way is the whole path, and only it
    /// is kept.
    pub(super) fn keep_other_way(&mut self) {
        if let Some(back) = self.back.take() {
            *self = *back;
        }
    }

    /// A tube joined the chain: the path goes through it between the parameters of `stretch`, whose third
    /// number is the length of the path before it.
    pub(super) fn add<const N: usize, Y: Frame>(
        &mut self,
        tube: &Tube<N, Y>,
        stretch: (f64, f64, f64),
    ) {
        if let Some(back) = &mut self.back {
            return back.add(tube, stretch);
        }
        let n = self.width;
        self.order = N;
        for z in &tube.local.z {
            self.coefficients.extend_from_slice(&z[..n]);
        }
        let (from, to, at) = stretch;
        let mut scratch = tube.weights.clone();
        let mut length = |s: f64| at + path_length(&tube.local, from, s, self.unit, &mut scratch);
        self.pieces.push(Piece {
            from,
            to,
            at,
            end: length(to),
            within: self.within(tube),
            has_places_alone: false,
        });
        let (from, start) = (tube.entry.0.max(-tube.proof.h), tube.entry.1);
        let mut turns = std::mem::take(&mut self.turns);
        turns.follow(&tube.time(), (start, to.max(start)), |seen| match seen {
            Stretch::Same(_) => self.open = None,
            Stretch::Open(a, b) => self.widen(tube, (if a == start { from } else { a }, b)),
            Stretch::Turned(s, rising) => {
                if s == start {
                    self.widen(tube, (from, start));
                }
                if let Some(open) = self.open.take() {
                    self.folds.push(self.fold(open, rising));
                }
            }
        });
        self.turns = turns;
    }

    /// How far the path may be from the middle of a tube, in any unknown.
    fn within<const N: usize, Y: Frame>(&self, tube: &Tube<N, Y>) -> f64 {
        let (distance, unit) = (point(tube.proof.distance), point(self.unit));
        let weights = tube.weights[..self.width - 1].iter();
        let weights = weights.zip(&tube.local.low[..self.width - 1]);
        let bound =
            weights.map(|(&u, &low)| ((distance * point(u) + point(low.abs())) * unit).sup());
        bound.fold(0.0, f64::max)
    }

    /// A piece of path along which t rises throughout, or falls, kept for other equations of the same path, of which the
    /// first unknowns, `places` of them, are the same free coordinates.
    pub(super) fn append(&mut self, piece: &Trace, places: usize, rising: bool) {
        if let Some(back) = &mut self.back {
            return back.append(piece, places, rising);
        }
        let before = self.length();
        for z in piece.coefficients.chunks_exact(piece.width) {
            let auxiliary = self.width - 1 - places;
            self.coefficients.extend_from_slice(&z[..places]);
            self.coefficients
                .extend(std::iter::repeat_n(0.0, auxiliary));
            self.coefficients.push(z[piece.width - 1]);
        }
        self.pieces.extend(piece.pieces.iter().map(|piece| Piece {
            at: before + piece.at,
            end: before + piece.end,
            has_places_alone: true,
            ..*piece
        }));
        self.turns.go_on(rising);
        self.open = None;
    }

    /// The path between two parameters of a tube belongs to what is open.
    fn widen<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, (a, b): (f64, f64)) {
        let (local, s) = (&tube.local, hull(a, b));
        let mut scratch = tube.weights.clone();
        let turn = turning(tube, (a, b));
        let at = self.pieces.last().map_or(0.0, |&Piece { from, at, .. }| {
            let until = turn.unwrap_or(a);
            at + path_length(local, from, until, self.unit, &mut scratch)
        });
        let z = (0..self.width).map(|i| {
            let coefficient = |k: usize| point(local.z[k][i]);
            // The path's point in the cross-section of s is that near ẑ(s).
            let near = (point(tube.proof.distance) * point(tube.weights[i])).sup();
            let start = coefficient(0) + point(local.low[i]);
            enclosed(start, N, coefficient, s).value + hull(-near, near)
        });
        match &mut self.open {
            None => {
                self.open = Some(Open {
                    at,
                    is_turn: turn.is_some(),
                    z: z.collect(),
                });
            }
            Some(open) => {
                if !open.is_turn && turn.is_some() {
                    (open.at, open.is_turn) = (at, true);
                }
                for (all, z) in open.z.iter_mut().zip(z) {
                    *all = all.convex_hull(z);
                }
            }
        }
    }

    fn fold(&self, open: Open, rising: bool) -> Fold {
        let (homotopy, unit) = (self.homotopy.as_ref(), point(self.unit));
        let m = self.width - 1;
        let points = homotopy.map_or(Vec::new(), |homotopy| {
            all_points(&homotopy.gauge, |i| open.z[i] * unit, point(0.0))
        });
        Fold {
            at: open.at,
            t: open.z[m],
            rising,
            points,
        }
    }

    /// The places where the path turns back in t, in its order.
    pub fn folds(&self) -> Vec<Fold> {
        let behind = self.back.iter().flat_map(|back| back.folds.iter().rev());
        let behind = behind.map(|fold| Fold {
            at: -fold.at,
            rising: !fold.rising,
            ..fold.clone()
        });
        behind.chain(self.folds.iter().cloned()).collect()
    }

    /// The way from the sketch in the other direction, where the path has two ends: its lengths are counted from there.
    pub fn back(&self) -> Option<&Trace> {
        self.back.as_deref()
    }

    /// A part of a tube, from `a` to `b` of the path's way through it (0 to 1). Parts that follow each other leave no gap.
    ///
    /// # Panics
    /// If there is no such tube.
    pub fn part(&self, tube: usize, (a, b): (f64, f64)) -> TubePart<'_> {
        let piece = self.pieces[tube];
        let s = |part: f64| match part {
            1.0 => piece.to,
            part => piece.from + (piece.to - piece.from) * part,
        };
        let (a, b) = (s(a), s(b));
        TubePart {
            trace: self,
            tube,
            s: hull(a.min(b), a.max(b)),
        }
    }

    /// The length of the path up to a part of a tube, as in [`Trace::part`].
    pub fn length_at(&self, tube: usize, part: f64) -> f64 {
        let piece = self.pieces[tube];
        piece.at + (piece.end - piece.at) * part
    }

    /// The place of the path where it is about so long.
    pub fn place_at(&self, at: f64) -> Option<TubePart<'_>> {
        if at < 0.0
            && let Some(back) = &self.back
        {
            return back.place_at(-at);
        }
        let (tube, part) = self.part_at(at)?;
        Some(self.part(tube, (part, part)))
    }

    /// The number of tubes.
    pub fn tubes(&self) -> usize {
        self.pieces.len()
    }

    /// The length of the path up to the end of each tube, as far as the path goes through it.
    pub fn ends(&self) -> Vec<f64> {
        self.pieces.iter().map(|piece| piece.end).collect()
    }

    /// Where the path begins, as a length of the path from the sketch: zero, or less where it has an end
    /// behind the sketch.
    pub fn start(&self) -> f64 {
        self.back.as_ref().map_or(0.0, |back| -back.length())
    }

    /// The length of the path from the sketch on.
    pub fn length(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.end)
    }

    /// The free coordinates (in the problem's units) and t at a parameter of a tube, or their derivatives, the first ones.
    fn polynomial(&self, k: usize, s: f64, derivative: usize) -> Vec<f64> {
        let (n, start) = (self.width, k * self.order * self.width);
        let value = |i: usize| {
            let terms = (derivative..self.order).rev();
            terms.fold(0.0, |sum: f64, j| {
                let factor = (j as f64).powi(derivative as i32);
                sum.mul_add(s, factor * self.coefficients[start + j * n + i])
            })
        };
        let units = |i: usize| if i + 1 < n { self.unit } else { 1.0 };
        (0..n).map(|i| units(i) * value(i)).collect()
    }

    /// The free coordinates and t where the path is so long, and its direction there, a unit vector.
    pub fn at(&self, at: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        if at < 0.0
            && let Some(back) = &self.back
        {
            let (z, direction) = back.at(-at)?;
            return Some((z, direction.into_iter().map(|x| -x).collect()));
        }
        let (k, part) = self.part_at(at)?;
        let Piece { from, to, .. } = self.pieces[k];
        let s = from + (to - from) * part;
        let mut direction = self.polynomial(k, s, 1);
        let size = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        direction.iter_mut().for_each(|x| *x /= size);
        Some((self.polynomial(k, s, 0), direction))
    }

    /// How far the path may be from the middle of its tube where it is so long.
    fn within_at(&self, at: f64) -> Option<f64> {
        match &self.back {
            Some(back) if at < 0.0 => back.within_at(-at),
            _ => Some(self.pieces[self.piece(at)?].within),
        }
    }

    /// The number of the piece where the path is so long.
    fn piece(&self, at: f64) -> Option<usize> {
        let k = self.pieces.partition_point(|piece| piece.at <= at);
        k.checked_sub(1).or((!self.pieces.is_empty()).then_some(0))
    }

    /// That number, and which part of the path's way through the tube is behind there (0 to 1).
    fn part_at(&self, at: f64) -> Option<(usize, f64)> {
        let tube = self.piece(at)?;
        let Piece { at: start, end, .. } = self.pieces[tube];
        let part = match end > start {
            true => ((at - start) / (end - start)).clamp(0.0, 1.0),
            false => 0.0,
        };
        Some((tube, part))
    }

    /// The figure where the path is so long.
    pub fn sample(&self, at: f64) -> Option<Sample> {
        let (z, _) = self.at(at)?;
        let homotopy = self.homotopy.as_ref()?;
        let points = all_points(&homotopy.gauge, |i| z[i], 0.0);
        let places: Vec<[Interval; 3]> = points.iter().map(|p| p.each(point)).collect();
        Some(Sample {
            at,
            t: z[self.width - 1],
            points,
            objects: homotopy.locate(&places, &|i| point(z[i] / self.unit)),
            within: self.within_at(at)?,
        })
    }

    /// So many figures along the path, from the sketch (or the end behind it) to where it ends, at equal
    /// lengths.
    pub fn samples(&self, count: usize) -> Vec<Sample> {
        let start = self.start();
        let length = self.length() - start;
        let steps = count.saturating_sub(1).max(1) as f64;
        (0..count)
            .filter_map(|k| self.sample(start + length * (k as f64 / steps)))
            .collect()
    }
}

/// A part of a tube, and the path in it: coordinates are in the gauge and the units of the problem.
#[derive(Debug, Clone, Copy)]
pub struct TubePart<'t> {
    trace: &'t Trace,
    tube: usize,
    s: Interval,
}

impl TubePart<'_> {
    /// The parameter, as seen from the middle.
    pub fn along(&self) -> Interval {
        self.s - point(self.s.mid())
    }

    /// Boxes of all points.
    pub fn points(&self) -> Vec<[Interval; 3]> {
        let Some(homotopy) = &self.trace.homotopy else {
            return Vec::new();
        };
        let unit = point(homotopy.unit);
        let place = |p: usize| homotopy.place(p, |i| self.entry_around(i).value * unit);
        (0..homotopy.points).map(place).collect()
    }

    /// A range of an unknown, in the homotopy's own unit, and of how fast the tube's polynomial moves: the path is beside it, at most so far that the range
    /// holds it.
    pub fn entry_around(&self, i: usize) -> Along {
        self.entry(i, self.s)
    }

    /// A range of an unknown in the middle.
    pub fn entry_in_middle(&self, i: usize) -> Interval {
        self.entry(i, point(self.s.mid())).value
    }

    fn entry(&self, i: usize, s: Interval) -> Along {
        let trace = self.trace;
        let (n, start) = (trace.width, self.tube * trace.order * trace.width);
        let piece = &trace.pieces[self.tube];
        let places = trace.homotopy.as_ref().map_or(0, |of| of.gauge.place.len());
        if piece.has_places_alone && i >= places {
            return Along {
                value: Interval::ENTIRE,
                slope: Interval::ENTIRE,
            };
        }
        let within = (point(piece.within) / point(trace.unit)).sup();
        let coefficient = |k: usize| point(trace.coefficients[start + k * n + i]);
        let Along { value, slope } = enclosed(coefficient(0), trace.order, coefficient, s);
        Along {
            value: value + hull(-within, within),
            slope,
        }
    }
}

/// Where a tube's polynomial of this order is in a range of s, and its slope. A middle, and the mean value theorem: near a fold t
/// hardly changes, and Horner's rule alone would not show it.
fn enclosed(
    start: Interval,
    order: usize,
    coefficient: impl Fn(usize) -> Interval,
    s: Interval,
) -> Along {
    let middle = point(s.mid());
    let (mut value, mut slope) = (point(0.0), point(0.0));
    for k in (1..order).rev() {
        value = (value + coefficient(k)) * middle;
        slope = slope * s + point(k as f64) * coefficient(k);
    }
    Along {
        value: start + value + slope * (s - middle),
        slope,
    }
}

/// All points from the free coordinates.
fn all_points<T: Copy>(gauge: &Gauge, free: impl Fn(usize) -> T, zero: T) -> Vec<[T; 3]> {
    let (d, m) = (gauge.dimension, gauge.place.len());
    let points = gauge.variable.chunks_exact(d);
    points
        .map(|variables| {
            array(|axis| match variables.get(axis) {
                Some(&i) if i < m => free(i),
                _ => zero,
            })
        })
        .collect()
}

/// Where t turns on the tube's polynomial, between two parameters.
fn turning<const N: usize, Y: Frame>(tube: &Tube<N, Y>, between: (f64, f64)) -> Option<f64> {
    const PIECES: usize = 16;
    let t = tube.weights.len() - 2;
    let slope = |s: f64| {
        let terms = (1..N).rev();
        terms.fold(0.0, |sum: f64, k| {
            sum.mul_add(s, k as f64 * tube.local.z[k][t])
        })
    };
    changes(between, PIECES, |s| slope(s) > 0.0).next()
}
