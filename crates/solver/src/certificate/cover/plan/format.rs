//! Covers on disk: what the search for all solutions leaves to be checked (`docs/how/certificates.md`).
//!
//! The record of a certificate: lines of text, and then as many bytes of marks as the last line says.

use super::super::CoverError;
use super::super::lines::{Lines, error, float, number};
use crate::certificate::begun::before_one_record;
use crate::certificate::format::TAG_COVER;
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// Most symbols at a time.
pub const MAX_SYMBOLS: usize = crate::model::SYMBOLS;

/// How far a new point is from one that stands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Radius {
    /// The problem gives the distance.
    Given,
    /// Its square is a driving parameter.
    Parameter(usize),
}

/// How a point is placed (docs/how/sets.md, "Placing points").
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Kind {
    /// In the plane, at the given distance from a point, in a driving direction: that point, and the driving parameter.
    Arm(usize, usize),
    /// In space, on the circle of points at given distances from two joined points, the hinge: these two and a third point joined to both, and
    /// the driving parameter, an angle between the half planes from the hinge towards the point placed and towards the third.
    Hinge([usize; 3], usize),
    /// At distances from as many points as dimensions; two places, on either side of the line or plane through those points.
    Meet(Vec<(usize, Radius)>),
}

/// A cover.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    /// The problem's text.
    pub problem: String,
    /// The points of the base.
    pub base: Vec<usize>,
    /// The points that are not in the base, and how each is placed.
    pub steps: Vec<(usize, Kind)>,
    /// The driving parameters: angles, or squared distances between bounds.
    pub drives: Vec<Option<[f64; 2]>>,
    /// The middles of the solutions' boxes in the base, three coordinates a point, in units of
    /// two to the power of `unit_exponent`.
    pub figures: Vec<Vec<[f64; 3]>>,
    /// The coordinates in `figures` are in units of two to the power of this.
    pub unit_exponent: i16,
    /// The marks.
    pub marks: Vec<u8>,
}

/// The range that is left of a symbol's, which is told in parts of it, in 2¹⁶ths.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Left {
    /// So much is cut off at its lower end, and at its upper end.
    cut: [u16; 2],
    /// What is left, in floats, in and out of the search alike.
    pub range: [f64; 2],
}

impl Left {
    /// Cuts parts off a range.
    fn of([lo, hi]: [f64; 2], cut: [u16; 2]) -> Left {
        let [low, high] = cut.map(|parts| (hi - lo) * (f64::from(parts) / 65536.0));
        let range = [lo + low, hi - high];
        Left { cut, range }
    }

    /// A small one that holds what of a range is in another one.
    pub fn holding(within: [f64; 2], wanted: [f64; 2]) -> Left {
        let width = within[1] - within[0];
        let off = [wanted[0] - within[0], within[1] - wanted[1]];
        // A conversion to whole numbers rounds down, and takes what is no number for 0.
        let mut cut = off.map(|off| (off / width * 65536.0) as u16);
        loop {
            let left = Left::of(within, cut);
            let holds = [left.range[0] <= wanted[0], wanted[1] <= left.range[1]];
            let less = [0, 1].map(|end| cut[end].saturating_sub(u16::from(!holds[end])));
            if less == cut {
                return left;
            }
            cut = less;
        }
    }
}

/// One mark of the cover, by its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// 1: the point of this step has no place.
    NoPlace(usize),
    /// 2: the point of this step has two places.
    Sides(usize),
    /// 3: the height of this step's point becomes a symbol with this range.
    Fold(usize, [f64; 2]),
    /// 4: a symbol's range is halved, before or after this step's point stands.
    Halves(usize, bool, usize),
    /// 5: of the distances that close when this step's point stands, this one is wrong.
    WrongDistance(usize, usize),
    /// 6: the equations exclude each other when this step's point stands.
    Excluded(usize),
    /// 7: the equations leave these ranges when this step's point stands.
    Within(usize, [Left; MAX_SYMBOLS]),
    /// 8: all points stand, and only a figure listed can be here.
    Figure,
    /// 9: undecided.
    Undecided,
    /// 10: when this step's point stands, its distance from this other point is one that no figure has.
    WrongPair(usize, usize),
}

impl Cover {
    /// The bytes of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = self.head(self.marks.len());
        out.extend(&self.marks);
        out
    }

    /// The bytes of the file up to its marks, if these are so many bytes.
    pub fn head(&self, marks: usize) -> Vec<u8> {
        let mut out = String::new();
        let list =
            |points: &[usize]| -> String { points.iter().map(|p| format!(" {p}")).collect() };
        let _ = writeln!(out, "base{}", list(&self.base));
        for drive in &self.drives {
            let _ = match drive {
                None => writeln!(out, "angle"),
                Some([least, most]) => writeln!(out, "square {least:e} {most:e}"),
            };
        }
        for (point, kind) in &self.steps {
            let _ = match kind {
                Kind::Arm(centre, parameter) => writeln!(out, "arm {point} {centre} {parameter}"),
                Kind::Hinge(frame, parameter) => {
                    writeln!(out, "hinge {point}{} {parameter}", list(frame))
                }
                Kind::Meet(centres) => {
                    let centres: String = centres
                        .iter()
                        .map(|(p, radius)| match radius {
                            Radius::Given => format!(" {p} given"),
                            Radius::Parameter(k) => format!(" {p} {k}"),
                        })
                        .collect();
                    writeln!(out, "meet {point}{centres}")
                }
            };
        }
        for figure in &self.figures {
            let numbers: String = figure.iter().flatten().map(|x| format!(" {x:e}")).collect();
            let _ = writeln!(out, "figure{numbers}");
        }
        let _ = writeln!(out, "marks {marks}");
        let mut bytes = before_one_record(&self.problem, self.unit_exponent, TAG_COVER);
        bytes.extend(out.into_bytes());
        bytes
    }

    /// Reads the bytes of a file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Cover, CoverError> {
        let (mut cover, marks) = Cover::read(bytes)?;
        cover.marks = marks.to_vec();
        Ok(cover)
    }

    /// Reads the bytes of a file, all but the marks, and finds those.
    pub(super) fn read(bytes: &[u8]) -> Result<(Cover, &[u8]), CoverError> {
        let (head, mut lines) = Lines::new(bytes, TAG_COVER)?;
        let mut cover = Cover {
            problem: head.problem,
            base: Vec::new(),
            steps: Vec::new(),
            drives: Vec::new(),
            figures: Vec::new(),
            unit_exponent: head.unit_exponent,
            marks: Vec::new(),
        };
        loop {
            let mut words = lines.line()?.split(' ');
            let kind = words.next().unwrap_or_default();
            match kind {
                "base" => cover.base = words.map(|w| number(Some(w))).collect::<Result<_, _>>()?,
                "angle" => cover.drives.push(None),
                "square" => {
                    let mut bound = || float(words.next().unwrap_or_default());
                    cover.drives.push(Some([bound()?, bound()?]));
                }
                "arm" | "hinge" => {
                    let numbers: Vec<usize> =
                        words.map(|w| number(Some(w))).collect::<Result<_, _>>()?;
                    cover.steps.push(match (kind, &numbers[..]) {
                        ("arm", &[p, centre, by]) => (p, Kind::Arm(centre, by)),
                        ("hinge", &[p, a, b, c, by]) => (p, Kind::Hinge([a, b, c], by)),
                        _ => return Err(error("a step")),
                    });
                }
                "meet" => {
                    let point = number(words.next())?;
                    let mut centres = Vec::new();
                    while let Some(word) = words.next() {
                        let radius = match words.next() {
                            Some("given") => Radius::Given,
                            other => Radius::Parameter(number(other)?),
                        };
                        centres.push((number(Some(word))?, radius));
                    }
                    cover.steps.push((point, Kind::Meet(centres)));
                }
                "figure" => {
                    let all: Vec<f64> = words.map(float).collect::<Result<_, _>>()?;
                    if !all.len().is_multiple_of(3) {
                        return Err(error("a figure's coordinates"));
                    }
                    cover
                        .figures
                        .push(all.chunks(3).map(|p| [p[0], p[1], p[2]]).collect());
                }
                "marks" => {
                    let marks = lines.marks(words.next())?;
                    return Ok((cover, marks));
                }
                _ => return Err(error("an unknown line")),
            }
        }
    }
}

/// Steps from this one on have a byte of their own.
const LONG: usize = 24;

impl Mark {
    /// Appends the mark; of ranges as many as there are symbols.
    pub fn put(self, symbols: usize, out: &mut Vec<u8>) {
        let mut head = |number: u8, step: usize| {
            out.push(number - 1 + 10 * step.min(LONG) as u8);
            if step >= LONG {
                out.push(step as u8);
            }
        };
        match self {
            Mark::NoPlace(step) => head(1, step),
            Mark::Sides(step) => head(2, step),
            Mark::Fold(step, range) => {
                head(3, step);
                out.extend(range.iter().flat_map(|x| x.to_le_bytes()));
            }
            Mark::Halves(step, stands, symbol) => {
                head(4, step);
                out.push(2 * symbol as u8 + u8::from(stands));
            }
            Mark::WrongDistance(step, place) => {
                head(5, step);
                out.push(place as u8);
            }
            Mark::Excluded(step) => head(6, step),
            Mark::Within(step, left) => {
                head(7, step);
                let cut = left[..symbols].iter().flat_map(|left| left.cut);
                out.extend(cut.flat_map(u16::to_le_bytes));
            }
            Mark::Figure => head(8, 0),
            Mark::Undecided => head(9, 0),
            Mark::WrongPair(step, other) => {
                head(10, step);
                out.push(other as u8);
            }
        }
    }

    /// Reads the mark at `at` of a part with these ranges, and where the next one begins.
    pub fn read(bytes: &[u8], at: usize, part: &[[f64; 2]]) -> Option<(Mark, usize)> {
        let mut at = at;
        let mut take = |count: usize| {
            let taken = bytes.get(at..at + count);
            at += count;
            taken
        };
        let head = take(1)?[0];
        let step = match usize::from(head / 10) {
            LONG => usize::from(take(1)?[0]),
            step if step < LONG => step,
            _ => return None,
        };
        let mark = match head % 10 + 1 {
            1 => Mark::NoPlace(step),
            2 => Mark::Sides(step),
            3 => {
                let mut end = || Some(f64::from_le_bytes(take(8)?.try_into().ok()?));
                let range = [end()?, end()?];
                range.iter().all(|x| x.is_finite()).then_some(())?;
                Mark::Fold(step, range)
            }
            4 => {
                let of = take(1)?[0];
                Mark::Halves(step, of % 2 == 1, usize::from(of / 2))
            }
            5 => Mark::WrongDistance(step, usize::from(take(1)?[0])),
            6 => Mark::Excluded(step),
            7 => {
                let mut all = [Left::default(); MAX_SYMBOLS];
                for (left, range) in all.iter_mut().zip(part) {
                    let cut = take(4)?;
                    let cut = [[cut[0], cut[1]], [cut[2], cut[3]]].map(u16::from_le_bytes);
                    *left = Left::of(*range, cut);
                }
                Mark::Within(step, all)
            }
            8 if step == 0 => Mark::Figure,
            9 if step == 0 => Mark::Undecided,
            10 => Mark::WrongPair(step, usize::from(take(1)?[0])),
            _ => return None,
        };
        Some((mark, at))
    }

    /// The step that the mark is about, and whether that step's point stands then. `Figure` is about the whole plan, of
    /// `steps` steps, and `Undecided` about whatever stands.
    pub fn place(self, steps: usize) -> (usize, bool) {
        match self {
            Mark::NoPlace(s) | Mark::Sides(s) | Mark::Fold(s, _) => (s, false),
            Mark::Halves(s, stands, _) => (s, stands),
            Mark::WrongDistance(s, _)
            | Mark::WrongPair(s, _)
            | Mark::Excluded(s)
            | Mark::Within(s, _) => (s, true),
            Mark::Figure => (steps, false),
            Mark::Undecided => (0, false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn marks_are_read_as_they_were_written() {
        let part = [[-1.0, 3.0], [0.25, 0.5]];
        let mut left = [Left::default(); MAX_SYMBOLS];
        left[0] = Left::holding(part[0], [-0.3, 2.9]);
        left[1] = Left::holding(part[1], [0.25, 0.4999999]);
        let mut marks = vec![Mark::Figure, Mark::Undecided];
        for step in [0, 1, 9, LONG - 1, LONG, 200, 255] {
            marks.extend([
                Mark::NoPlace(step),
                Mark::Sides(step),
                Mark::Fold(step, [-0.125, 1e-30]),
                Mark::Halves(step, true, 5),
                Mark::Halves(step, false, 0),
                Mark::WrongDistance(step, 255),
                Mark::Excluded(step),
                Mark::Within(step, left),
                Mark::WrongPair(step, 254),
            ]);
        }
        let mut bytes = Vec::new();
        marks.iter().for_each(|mark| mark.put(2, &mut bytes));
        let mut at = 0;
        for mark in marks {
            let (read, next) = Mark::read(&bytes, at, &part).unwrap();
            assert_eq!(read, mark);
            at = next;
        }
        assert_eq!(at, bytes.len());
        assert_eq!(Mark::read(&bytes, at, &part), None);
        let ends = (1..bytes.len()).filter(|&end| {
            let (mut at, mut count) = (0, 0);
            while let Some((_, next)) = Mark::read(&bytes[..end], at, &part) {
                (at, count) = (next, count + 1);
            }
            at == end && count > 0
        });
        // Nothing is read beyond the end.
        assert!(ends.count() < 66);
        for head in 250..=255 {
            assert_eq!(Mark::read(&[head, 0, 0, 0], 0, &part), None);
        }
    }

    #[test]
    fn what_is_left_holds_what_was_wanted_and_little_more() {
        let mut random = Random::new(7);
        let mut random = || 0.5 + 0.5 * random.symmetric();
        for _ in 0..10_000 {
            let lo = 4.0 * random() - 2.0;
            let hi = lo + 2f64.powf(-50.0 * random());
            let [a, b] = [0; 2].map(|_| lo + (hi - lo) * random());
            let wanted = [a.min(b).clamp(lo, hi), a.max(b).clamp(lo, hi)];
            let Left { cut, range } = Left::holding([lo, hi], wanted);
            assert!(lo <= range[0] && range[0] <= wanted[0]);
            assert!(wanted[1] <= range[1] && range[1] <= hi);
            let much = (hi - lo) / 32768.0 + 1e-15;
            assert!(wanted[0] - range[0] <= much && range[1] - wanted[1] <= much);
            assert_eq!(Left::of([lo, hi], cut).range, range);
        }
        for odd in [[0.0, 0.0], [f64::MIN, f64::MAX], [-1e-320, 1e-320]] {
            let Left { range, .. } = Left::holding(odd, odd);
            assert!(!(range[0] > odd[0]) && !(range[1] < odd[1]), "{range:?}");
        }
    }
}
