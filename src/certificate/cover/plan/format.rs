//! Covers on disk: what the search for all solutions leaves to be checked (`docs/complete.md`).
//!
//! Lines of text, and then as many bytes of marks as the last line says.

use super::super::CoverError;
use super::super::lines::{Lines, error, float, number};
use std::fmt::Write;

/// The first line of every cover.
pub const FIRST_LINE: &str = "krawl cover";
/// The version of the format.
pub const VERSION: u32 = 2;
/// Most symbols at a time.
pub const MAX_SYMBOLS: usize = 6;

/// How far a new point is from one that stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Radius {
    /// The problem gives the distance.
    Given,
    /// Its square is a driving parameter.
    Parameter(usize),
}

/// How a point is placed (docs/complete.md, "How it works").
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// In the plane, at the given distance from a point, in a driving direction.
    Arm(usize, usize),
    /// In space, on the hinge through two points, turned by a driving angle from a third.
    Hinge([usize; 3], usize),
    /// At distances from as many points as dimensions.
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
    pub unit_exponent: i32,
    /// The marks.
    pub marks: Vec<u8>,
}

/// One mark of the cover (the tags are its bytes).
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
    Within(usize, [[f64; 2]; MAX_SYMBOLS]),
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
        let mut out = format!(
            "{FIRST_LINE}\nversion {VERSION}\nunit {}\n",
            self.unit_exponent
        );
        // Writing to a string cannot fail.
        let _ = write!(out, "problem {}\n{}\n", self.problem.len(), self.problem);
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
        let _ = writeln!(out, "marks {}", self.marks.len());
        let mut out = out.into_bytes();
        out.extend(&self.marks);
        out
    }

    /// Reads the bytes of a file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Cover, CoverError> {
        let mut lines = Lines::new(bytes, FIRST_LINE, VERSION)?;
        let unit_exponent = lines.unit()?;
        let problem = lines.problem()?;
        let mut cover = Cover {
            problem,
            base: Vec::new(),
            steps: Vec::new(),
            drives: Vec::new(),
            figures: Vec::new(),
            unit_exponent,
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
                    cover.marks = lines.marks(words.next())?;
                    return Ok(cover);
                }
                _ => return Err(error("an unknown line")),
            }
        }
    }
}

impl Mark {
    /// Appends the mark; of ranges as many as there are symbols.
    pub fn put(self, symbols: usize, out: &mut Vec<u8>) {
        match self {
            Mark::NoPlace(step) => out.extend([1, step as u8]),
            Mark::Sides(step) => out.extend([2, step as u8]),
            Mark::Fold(step, range) => {
                out.extend([3, step as u8]);
                out.extend(range.iter().flat_map(|x| x.to_le_bytes()));
            }
            Mark::Halves(step, stands, symbol) => {
                out.extend([4, step as u8, stands as u8, symbol as u8]);
            }
            Mark::WrongDistance(step, place) => out.extend([5, step as u8, place as u8]),
            Mark::Excluded(step) => out.extend([6, step as u8]),
            Mark::Within(step, ranges) => {
                out.extend([7, step as u8]);
                out.extend(
                    ranges[..symbols]
                        .iter()
                        .flatten()
                        .flat_map(|x| x.to_le_bytes()),
                );
            }
            Mark::Figure => out.push(8),
            Mark::Undecided => out.push(9),
            Mark::WrongPair(step, other) => out.extend([10, step as u8, other as u8]),
        }
    }

    /// Reads the mark at `at`, with so many symbols, and where the next one begins.
    pub fn read(bytes: &[u8], at: usize, symbols: usize) -> Option<(Mark, usize)> {
        let byte = |k: usize| bytes.get(at + k).map(|&b| usize::from(b));
        let float = |k: usize| {
            let eight = bytes.get(at + k..at + k + 8)?;
            Some(f64::from_le_bytes(eight.try_into().ok()?)).filter(|x| x.is_finite())
        };
        Some(match byte(0)? {
            1 => (Mark::NoPlace(byte(1)?), at + 2),
            2 => (Mark::Sides(byte(1)?), at + 2),
            3 => (Mark::Fold(byte(1)?, [float(2)?, float(10)?]), at + 18),
            4 => (Mark::Halves(byte(1)?, byte(2)? == 1, byte(3)?), at + 4),
            5 => (Mark::WrongDistance(byte(1)?, byte(2)?), at + 3),
            6 => (Mark::Excluded(byte(1)?), at + 2),
            7 => {
                let mut ranges = [[0.0; 2]; MAX_SYMBOLS];
                for (i, range) in ranges[..symbols].iter_mut().enumerate() {
                    *range = [float(2 + 16 * i)?, float(10 + 16 * i)?];
                }
                (Mark::Within(byte(1)?, ranges), at + 2 + 16 * symbols)
            }
            8 => (Mark::Figure, at + 1),
            9 => (Mark::Undecided, at + 1),
            10 => (Mark::WrongPair(byte(1)?, byte(2)?), at + 3),
            _ => return None,
        })
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
