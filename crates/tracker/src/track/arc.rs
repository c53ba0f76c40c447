//! What follows from an arc of path that sets out from a figure at t = 0 with t rising.

use crate::interval::{Interval, hull, point};
use crate::system::Homotopy;
use crate::track::Stop;

/// A figure that is known up to a box, in which it is the only one that meets its equations.
///
/// One entry per unknown (the free coordinates of the gauge come first), in the homotopy's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The middle of the box.
    pub centre: Vec<f64>,
    /// What is to be added to `centre` for the middle, in extended precision; otherwise zero.
    pub low: Vec<f64>,
    /// How far the exact figure may be from the middle, entry by entry.
    pub radius: Vec<f64>,
}

impl Figure {
    /// A box by its middle, in floats, and how far the exact figure may be from it.
    pub fn around(centre: Vec<f64>, radius: Vec<f64>) -> Self {
        let low = vec![0.0; centre.len()];
        Figure {
            centre,
            low,
            radius,
        }
    }

    /// A box by the ranges of its entries.
    pub fn within(ranges: impl IntoIterator<Item = Interval>) -> Self {
        let both = ranges.into_iter().map(|x| (x.mid(), x.rad()));
        let (centre, radius) = both.unzip();
        Self::around(centre, radius)
    }

    /// The sketch as a box.
    pub fn of_sketch(homotopy: &Homotopy) -> Self {
        Self::within(homotopy.sketch_of_unknowns())
    }

    /// An unknown, in the homotopy's unit.
    pub fn enclosure(&self, unknown: usize) -> Interval {
        let radius = self.radius[unknown];
        point(self.centre[unknown]) + point(self.low[unknown]) + hull(-radius, radius)
    }

    /// All points of the figure in the gauge, in the homotopy's unit.
    pub fn points(&self, homotopy: &Homotopy) -> Vec<[Interval; 3]> {
        let points = 0..homotopy.points;
        let unknown = |i: usize| self.enclosure(i);
        points.map(|p| homotopy.place(p, unknown)).collect()
    }
}

/// A fold: the point where an arc stops rising, t' = 0 with t'' < 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Fold {
    /// The figure there.
    pub figure: Figure,
    /// t there.
    pub t: Interval,
    /// The velocity v of the figure at the fold, J v = 0 and c·v = 1, one entry per unknown: how
    /// the figure moves for an instant while all dimensions stand still.
    pub velocity: Vec<f64>,
    /// How far the exact v may be from that, entry by entry.
    pub velocity_radius: Vec<f64>,
    /// The vector c by which v is scaled.
    pub normal: Vec<f64>,
    /// Within this distance of (figure, t, v), in every entry, there is no other zero of
    /// (F(X, t), J(X) v, c·v − 1).
    pub alone_within: f64,
}

/// How an arc ends.
#[derive(Debug, Clone, PartialEq)]
pub enum ArcEnd {
    /// At t = 1, with dt/ds > 0 all the way: the one and only continuation of the figure at t = 0.
    Reached(Figure),
    /// At a fold before t = 1, with dt/ds > 0 up to it: there is no continuation beyond.
    Limit(Box<Fold>),
    /// Near a point where the figure's equations lose rank by more than a fold takes away, so that
    /// branches meet there and none continues the figure more than another: seen in floats, not proved.
    /// Why the proof ended there.
    Passes(Stop),
    /// Why the proof ended before.
    Stopped(Stop),
}

/// A triangle of joined points in the plane, or a tetrahedron in space, and what became of its sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Orientation {
    /// The points, three or four of them.
    pub points: Vec<usize>,
    /// The sign at t = 0 of the determinant of the differences of the others from the first; 0 if it is
    /// not certain there.
    pub sign: i8,
    /// Where along the arc it could not be proved to be the same, if anywhere: the first such range of t.
    pub lost: Option<(f64, f64)>,
}

/// A line or arc of the figure that was followed, and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The object, by index.
    pub object: usize,
    /// The other edge, of two that are not to touch.
    pub other: Option<usize>,
    /// The sign of a line's length along its axis; of an arc, that of the sine of its angle where that was certain last. 0: not
    /// certain at t = 0. Of two edges 1, if they are certain to be apart.
    pub sign: i8,
    /// Where along the path it could not be proved not to vanish, if anywhere: the first such range of t.
    pub lost: Option<(f64, f64)>,
}

/// How far the figures of an arc are off an equation that is not one of its own, in the homotopy's unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Off {
    /// By what its left-hand side is more than its right-hand side, for all figures up to the last that is known to meet it.
    met: Option<Interval>,
    /// The same of figures behind these, which may meet or miss it, and the t of the first.
    doubtful: Option<(Interval, f64)>,
    /// The first piece of the way that is proved to miss it ([`Beside::within`](crate::system::Beside::within)): by what, and a range of t in
    /// which the first figure is that does. Nothing is known of the figures beyond.
    pub missed: Option<(Interval, (f64, f64))>,
}

/// A piece of the way is not halved more often to tell what its figures are off by.
const HALVED: u32 = 50;
/// Nor where what is known of it is no more than so many times as wide as what is known of one figure.
const NARROW: f64 = 1.5;

impl Off {
    /// Looks at the next piece of the way, between two parameters, and its halves, until it can be told whether they meet it. `look`: what
    /// figures between two parameters are off by, and a range of t that holds theirs.
    pub fn follow(
        &mut self,
        between: (f64, f64),
        within: [f64; 2],
        look: &mut impl FnMut((f64, f64)) -> (Interval, (f64, f64)),
    ) {
        self.follow_halves(between, HALVED, within, look);
    }

    fn follow_halves(
        &mut self,
        (a, b): (f64, f64),
        depth: u32,
        [met, missed]: [f64; 2],
        look: &mut impl FnMut((f64, f64)) -> (Interval, (f64, f64)),
    ) {
        if self.missed.is_some() {
            return;
        }
        let (off, t) = look((a, b));
        let half = 0.5 * (a + b);
        let can_halve = depth > 0 && a < half && half < b;
        if off.mag() <= met {
            self.meet(off);
        } else if off.mig() > missed {
            let since = self.doubtful.take().map_or(t.0, |(_, since)| since);
            self.missed = Some((off, (since, t.1)));
        } else if can_halve && off.wid() > NARROW * look((half, half)).0.wid() {
            self.follow_halves((a, half), depth - 1, [met, missed], look);
            self.follow_halves((half, b), depth - 1, [met, missed], look);
        } else {
            let (before, since) = self.doubtful.unwrap_or((off, t.0));
            self.doubtful = Some((before.convex_hull(off), since));
        }
    }

    /// Figures up to here are all off by no more than is known of them.
    fn meet(&mut self, off: Interval) {
        let all = [self.met, self.doubtful.take().map(|(before, _)| before)];
        let all = all.into_iter().flatten();
        self.met = Some(all.fold(off, |all, before| all.convex_hull(before)));
    }

    /// By what all figures are off, or all before the first that may be one that misses it. `None`: there is none.
    pub fn until(&self) -> Option<Interval> {
        match (self.met, self.doubtful) {
            (Some(met), Some((doubtful, _))) => Some(met.convex_hull(doubtful)),
            (met, doubtful) => met.or(doubtful.map(|(off, _)| off)),
        }
    }
}

/// The account of an arc.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcRun {
    /// How it ended.
    pub end: ArcEnd,
    /// Up to where it is proved: bounds on t at the last point of it.
    pub t: (f64, f64),
    /// Orientations, in the same order each time.
    pub orientations: Vec<Orientation>,
    /// Lines and arcs that must not vanish, in the same order each time.
    pub segments: Vec<Kept>,
    /// How far its figures are off each of [`Homotopy::beside`].
    pub beside: Vec<Off>,
    /// Where it reached t = 1: within this distance of the figure's middle, in every entry, there is no other
    /// zero of F(X, a(1)). Otherwise 0.
    pub alone_within: f64,
    /// The unknowns where the last tube ends, in floats: as far as the arc was proved.
    pub last: Vec<f64>,
    /// Tubes.
    pub steps: usize,
    /// Tubes that were tried in vain.
    pub rejected: usize,
    /// Its length, Euclidean in the free coordinates (units of the problem) and t, in floats.
    pub length: f64,
    /// What was switched on beyond the plain run, and why.
    pub switched_on: Vec<String>,
}

impl ArcRun {
    /// One that could not even set out.
    pub fn stopped(reason: Stop) -> Self {
        ArcRun {
            end: ArcEnd::Stopped(reason),
            t: (0.0, 0.0),
            orientations: Vec::new(),
            segments: Vec::new(),
            beside: Vec::new(),
            alone_within: 0.0,
            last: Vec::new(),
            steps: 0,
            rejected: 0,
            length: 0.0,
            switched_on: Vec::new(),
        }
    }
}
