//! Covers of the space of coordinates on disk, the record of a certificate: lines of text, and then as many bytes of marks as the last line says.

use super::super::CoverError;
use super::super::lines::{Lines, error, float, number};
use crate::certificate::begun::before_one_record;
use crate::certificate::format::TAG_COVER_OF_COORDINATES;
use std::fmt::Write;

/// A cover of the space of all unknowns. Unknowns and equations are those of the kernel, numbered from 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CoordinateCover {
    /// The problem's text.
    pub problem: String,
    /// Lengths are in units of two to the power of this.
    pub unit_exponent: i16,
    /// The unknowns that are looked at where they are not negative, in order.
    pub halves: Vec<Half>,
    /// Equations that are taken together.
    pub blocks: Vec<Block>,
    /// Rigid bodies on legs, whose rotations are looked at.
    pub bodies: Vec<Body>,
    /// For each solution about where it is, unknown by unknown.
    pub figures: Vec<Vec<f64>>,
    /// Zeros of the equations that are images of these.
    pub images: Vec<Image>,
    /// Zeros of the equations that are no figures, as a vector vanishes in them that must not: exactly.
    pub others: Vec<Vec<f64>>,
    /// The unknowns that parts have in common, where the equations fall apart.
    pub base: Vec<usize>,
    /// What the others fall apart into, for each zero that these have in a figure; none where the equations do not fall apart.
    pub cases: Vec<Case>,
    /// The marks: those of the base, if it has unknowns, and then of each part of each case; or of the whole.
    pub marks: Vec<u8>,
}

/// What the equations fall apart into where the base is at one of its zeros.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Case {
    /// A solution there.
    pub first: usize,
    /// The parts, of whose zeros every combination is one.
    pub parts: Vec<Independent>,
}

/// A symmetry: changes of the signs of unknowns that take figures to congruent ones.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Change {
    /// The axes that are reversed.
    pub axes: Vec<usize>,
    /// The changes of sign beside, of lines and planes of their own: places in [`crate::constraint::Tail::twins`].
    pub twins: Vec<usize>,
}

impl Change {
    /// With more lines and planes of their own not all sums of changes are looked at.
    pub const MOST_TWINS: usize = 8;

    /// All sums of reversals of so many axes and of so many changes beside; the first changes nothing.
    pub fn all(axes: usize, twins: usize) -> impl Iterator<Item = Change> {
        let bits = |mask: usize, count: usize| (0..count).filter(|k| mask >> k & 1 == 1).collect();
        (0..1usize << (axes + twins)).map(move |mask| Change {
            axes: bits(mask, axes),
            twins: bits(mask >> axes, twins),
        })
    }
}

/// An unknown that is looked at where it is not negative.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Half {
    /// The unknown.
    pub unknown: usize,
    /// What changes its sign, and of none that was halved before.
    pub by: Change,
}

/// A zero that is a listed solution seen otherwise.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// The solution.
    pub figure: usize,
    /// What takes the zero to it.
    pub by: Change,
}

/// As many equations as unknowns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// The equations.
    pub equations: Vec<usize>,
    /// The unknowns.
    pub unknowns: Vec<usize>,
}

/// Equations that are about differences of which no others say anything.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Independent {
    /// The equations.
    pub equations: Vec<usize>,
    /// The solutions that are in all other parts as the first one is, beside that one itself.
    pub figures: Vec<usize>,
}

/// A rigid body on six legs, each from one of its points to where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Body {
    /// Its number among the problem's objects.
    pub object: usize,
    /// The equations of the legs' lengths.
    pub legs: Vec<usize>,
}

/// What is said of a part, after its ranges were narrowed by the equations one by one. Parts in which nothing is left have no mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// 1: the ranges are narrowed by a block's equations together, and then one by one again; more marks follow.
    Block(usize),
    /// 2: an unknown's range is halved; both halves follow, the lower one first.
    Halves(usize),
    /// 3: all of the part lies where this solution is the only zero of the equations.
    Figure(usize),
    /// 4: the same for a zero that is no figure.
    Other(usize),
    /// 5: the same for an image of a solution.
    Image(usize),
    /// 6: a block's unknowns are bounded by its equations together, and then all by one after the other; more marks follow.
    Bound(usize),
    /// 7: nothing is claimed.
    Undecided,
    /// 8: all rotations of a body are looked at, with the part's ranges for all else; marks of rotations follow, chart by chart.
    Body(usize),
    /// 9: an equation is put on each of its sides in turn; a part for each follows.
    Sides(usize),
    /// 10: what linear equations of a block say is put into the others, in exact numbers; more marks follow.
    Reduced(usize),
}

/// What is said of a box of rotations of a body: one byte. Boxes that no pose is in have no mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turned {
    /// 16: the box is narrowed to what the equations leave; another mark of it follows.
    Narrowed,
    /// 32 and the number of the range: it is halved; both halves follow, the lower one first.
    Halves(usize),
    /// 48 and the number of the axis: the coordinate along it becomes one more range of the box, and another mark of it follows.
    Height(usize),
    /// 64: the part with the body's points where the box allows follows, with marks of parts.
    Part,
    /// 80: nothing is claimed.
    Undecided,
}

impl Turned {
    /// Appends the mark.
    pub fn put(self, out: &mut Vec<u8>) {
        out.push(match self {
            Turned::Narrowed => 16,
            Turned::Halves(i) => 32 + i as u8,
            Turned::Height(axis) => 48 + axis as u8,
            Turned::Part => 64,
            Turned::Undecided => 80,
        });
    }

    /// Reads the mark at a place.
    pub fn read(bytes: &[u8], at: usize) -> Option<Turned> {
        let byte = *bytes.get(at)?;
        Some(match byte {
            16 => Turned::Narrowed,
            32..36 => Turned::Halves(usize::from(byte) - 32),
            48..51 => Turned::Height(usize::from(byte) - 48),
            64 => Turned::Part,
            80 => Turned::Undecided,
            _ => return None,
        })
    }
}

fn list(numbers: &[usize]) -> String {
    numbers.iter().map(|x| format!(" {x}")).collect()
}

fn floats(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!(" {x:e}")).collect()
}

/// Whole numbers up to a word, or to the end.
fn until<'a>(
    words: &mut impl Iterator<Item = &'a str>,
    end: Option<&str>,
) -> Result<Vec<usize>, CoverError> {
    let mut out = Vec::new();
    loop {
        match words.next() {
            word if word == end => return Ok(out),
            word => out.push(number(word)?),
        }
    }
}

impl Change {
    fn text(&self) -> String {
        format!("axes{} twins{}", list(&self.axes), list(&self.twins))
    }

    fn read<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Self, CoverError> {
        match words.next() {
            Some("axes") => Ok(Change {
                axes: until(&mut words, Some("twins"))?,
                twins: until(&mut words, None)?,
            }),
            _ => Err(error("the axes of a symmetry")),
        }
    }
}

impl CoordinateCover {
    /// The bytes of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = String::new();
        for half in &self.halves {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "half {} {}", half.unknown, half.by.text());
        }
        for block in &self.blocks {
            let (equations, unknowns) = (list(&block.equations), list(&block.unknowns));
            let _ = writeln!(out, "block{equations} unknowns{unknowns}");
        }
        for body in &self.bodies {
            let _ = writeln!(out, "body {} legs{}", body.object, list(&body.legs));
        }
        for figure in &self.figures {
            let _ = writeln!(out, "figure{}", floats(figure));
        }
        for image in &self.images {
            let _ = writeln!(out, "image {} {}", image.figure, image.by.text());
        }
        for other in &self.others {
            let _ = writeln!(out, "other{}", floats(other));
        }
        if !self.base.is_empty() {
            let _ = writeln!(out, "base{}", list(&self.base));
        }
        for case in &self.cases {
            let _ = writeln!(out, "case {}", case.first);
            for part in &case.parts {
                let (equations, figures) = (list(&part.equations), list(&part.figures));
                let _ = writeln!(out, "independent{equations} figures{figures}");
            }
        }
        let _ = writeln!(out, "marks {}", self.marks.len());
        let tag = TAG_COVER_OF_COORDINATES;
        let mut bytes = before_one_record(&self.problem, self.unit_exponent, tag);
        bytes.extend(out.into_bytes());
        bytes.extend(&self.marks);
        bytes
    }

    /// Reads the bytes of a file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CoverError> {
        let (head, mut lines) = Lines::new(bytes, TAG_COVER_OF_COORDINATES)?;
        let mut cover = CoordinateCover {
            unit_exponent: head.unit_exponent,
            problem: head.problem,
            ..CoordinateCover::default()
        };
        loop {
            let mut words = lines.line()?.split(' ');
            match words.next().unwrap_or_default() {
                "half" => cover.halves.push(Half {
                    unknown: number(words.next())?,
                    by: Change::read(words)?,
                }),
                "image" => cover.images.push(Image {
                    figure: number(words.next())?,
                    by: Change::read(words)?,
                }),
                "block" => cover.blocks.push(Block {
                    equations: until(&mut words, Some("unknowns"))?,
                    unknowns: until(&mut words, None)?,
                }),
                "body" => cover.bodies.push(Body {
                    object: number(words.next())?,
                    legs: match words.next() {
                        Some("legs") => until(&mut words, None)?,
                        _ => return Err(error("the legs of a body")),
                    },
                }),
                "figure" => cover
                    .figures
                    .push(words.map(float).collect::<Result<_, _>>()?),
                "other" => cover
                    .others
                    .push(words.map(float).collect::<Result<_, _>>()?),
                "base" => cover.base = until(&mut words, None)?,
                "case" => cover.cases.push(Case {
                    first: number(words.next())?,
                    parts: Vec::new(),
                }),
                "independent" => {
                    let case = cover.cases.last_mut();
                    let case = case.ok_or_else(|| error("a part of no case"))?;
                    case.parts.push(Independent {
                        equations: until(&mut words, Some("figures"))?,
                        figures: until(&mut words, None)?,
                    });
                }
                "marks" => {
                    cover.marks = lines.marks(words.next())?.to_vec();
                    return Ok(cover);
                }
                _ => return Err(error("an unknown line")),
            }
        }
    }
}

impl Mark {
    /// The greatest number in a mark.
    pub const MOST: usize = u16::MAX as usize;

    /// Appends the mark: a byte, and for all but the last kind a number, of at most [`Mark::MOST`], in two more, the lower
    /// one first.
    pub fn put(self, out: &mut Vec<u8>) {
        let (tag, number) = match self {
            Mark::Block(k) => (1, k),
            Mark::Halves(k) => (2, k),
            Mark::Figure(k) => (3, k),
            Mark::Other(k) => (4, k),
            Mark::Image(k) => (5, k),
            Mark::Bound(k) => (6, k),
            Mark::Undecided => return out.push(7),
            Mark::Body(k) => (8, k),
            Mark::Sides(e) => (9, e),
            Mark::Reduced(k) => (10, k),
        };
        out.push(tag);
        out.extend((number as u16).to_le_bytes());
    }

    /// Reads the mark at a place, and where the next one begins.
    pub fn read(bytes: &[u8], at: usize) -> Option<(Mark, usize)> {
        let tag = *bytes.get(at)?;
        if tag == 7 {
            return Some((Mark::Undecided, at + 1));
        }
        let number = bytes.get(at + 1..at + 3)?;
        let number = usize::from(u16::from_le_bytes([number[0], number[1]]));
        let mark = match tag {
            1 => Mark::Block(number),
            2 => Mark::Halves(number),
            3 => Mark::Figure(number),
            4 => Mark::Other(number),
            5 => Mark::Image(number),
            6 => Mark::Bound(number),
            8 => Mark::Body(number),
            9 => Mark::Sides(number),
            10 => Mark::Reduced(number),
            _ => return None,
        };
        Some((mark, at + 3))
    }
}
