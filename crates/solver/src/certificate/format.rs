//! What a certificate consists of (byte for byte in `docs/how/certificates.md`).

use crate::problem::{Decimal, Problem};

/// The first bytes of every certificate.
pub const MAGIC: &[u8; 18] = b"krawl certificate\n";
/// The version of the format that is written and read.
pub const VERSION: u32 = 3;
/// Longest text that names a program, or gives a reason.
pub const MAX_TEXT: usize = 4096;
/// Longest text of a problem.
pub const MAX_PROBLEM: usize = 1 << 20;
/// Most free coordinates: tubes are proved with square matrices of one more row, which must fit into the
/// memory. No run writes a larger one, which is asserted where they are written.
pub const MAX_FREE_COORDINATES: usize = 6000;
/// Units are between 2⁻²²⁰ and 2²²⁰: lengths in files are between 10⁻⁶⁰ and 10⁶⁰.
pub const MAX_UNIT_EXPONENT: i16 = 220;
/// Longest decimal that is a new value of a dimension.
pub const MAX_DECIMAL: usize = 512;
/// Most signs that an edit claims to keep.
pub const MAX_LISTED: usize = 1 << 20;
/// More solutions than any path of a real problem has.
pub const MAX_SOLUTIONS: usize = 4096;
/// Numbers are smaller than this; the homotopy's unit is a typical length.
pub const MAX_NUMBER: f64 = 1_099_511_627_776.0;
/// What weights are multiples of.
pub const WEIGHT_UNIT: f64 = 1.0 / 65536.0;

/// Tags of the records.
pub const TAG_TUBE: u8 = 1;
/// See [`TAG_TUBE`].
pub const TAG_SOLUTION: u8 = 2;
/// See [`TAG_TUBE`].
pub const TAG_END: u8 = 3;
/// See [`TAG_TUBE`].
pub const TAG_TURN: u8 = 4;
/// See [`TAG_TUBE`].
pub const TAG_ARC: u8 = 5;
/// See [`TAG_TUBE`].
pub const TAG_REACHED: u8 = 6;
/// See [`TAG_TUBE`].
pub const TAG_FOLD: u8 = 7;
/// See [`TAG_TUBE`].
pub const TAG_EXTENDED: u8 = 8;
/// See [`TAG_TUBE`].
pub const TAG_ARC_OF_DIMENSIONS: u8 = 9;
/// See [`TAG_TUBE`].
pub const TAG_DIVIDE: u8 = 10;
/// See [`TAG_TUBE`].
pub const TAG_RETURN: u8 = 11;
/// A cover of the parameters of a construction plan. It is all of a certificate behind its header, as those below are.
pub const TAG_COVER: u8 = 12;
/// A cover of all coordinates.
pub const TAG_COVER_OF_COORDINATES: u8 = 13;
/// A set of complex solutions.
pub const TAG_COMPLEX_SET: u8 = 14;
/// See [`TAG_TUBE`].
pub const TAG_MOTION: u8 = 15;

/// What stands before the chain of tubes.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// The program that wrote the certificate, with its version.
    pub program: String,
    /// The problem.
    pub problem: Problem,
    /// SHA-256 of the problem's text.
    pub hash: [u8; 32],
    /// Lengths in the records are divided by 2 to this power.
    pub unit_exponent: i16,
}

/// A part of the chain.
#[derive(Debug, Clone, PartialEq)]
pub enum Record {
    /// A tube that follows on the one before.
    Tube(TubeClaim),
    /// A point of the path with t = 1, first met in the tube before.
    Solution(SolutionClaim),
    /// What follows are tubes the other way from the sketch.
    Turn,
    /// What follows are tubes of the path in the equations with heights divided by 1 − t, and solutions in their unknowns.
    Divide,
    /// What follows are tubes in the problem's own equations again.
    Return,
    /// An edit: what follows are tubes from the figure at hand, t rising from 0.
    Arc(ArcClaim),
    /// The arc ends with t = 1, in this box, which is then the figure at hand.
    Reached(SolutionClaim),
    /// The arc ends at a fold.
    Fold(FoldClaim),
    /// A motion: what follows are tubes of the path from the figure at hand along which a dimension is led, as far as it goes.
    Motion(ArcClaim),
    /// The last record.
    End(EndClaim),
}

/// The claim that Krawczyk's test with the moving preconditioner proves a tube: for every |s| ≤ h
/// exactly one point of the path in the cross-section through ẑ(s), within r of it in the norm.
#[derive(Debug, Clone, PartialEq)]
pub struct TubeClaim {
    /// z₀: the free coordinates and t.
    pub centre: Vec<f64>,
    /// What z₀ is more than that, of tubes in extended precision; otherwise empty.
    pub low: Vec<f64>,
    /// The normal c of the cross-sections.
    pub normal: Vec<f32>,
    /// The weights u, in units of 2⁻¹⁶.
    pub weights: Vec<u16>,
    /// The half length.
    pub h: f64,
    /// The radius.
    pub r: f32,
    /// Where the path leaves for the next tube.
    pub exit: f64,
}

/// The claim that a box holds exactly one solution.
#[derive(Debug, Clone, PartialEq)]
pub struct SolutionClaim {
    /// The middle, the free coordinates.
    pub centre: Vec<f64>,
    /// How far the solution may be from it, in any entry.
    pub radius: f32,
}

/// What an edit changes, and what it claims to keep.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcClaim {
    /// Whether the problem has more than distances: then the record is of another kind, and so are the equations.
    pub is_general: bool,
    /// The dimensions that are led, by their numbers in the problem, distances first, and their new values. None: the
    /// sketch is led to the problem's own dimensions.
    pub dimensions: Vec<(u32, Decimal)>,
    /// Triangles in the plane, tetrahedra in space, that keep the sign of their area or volume along the arc:
    /// their points, and whether it is positive.
    pub kept: Vec<(Vec<u32>, bool)>,
}

/// The claim that an arc ends at a fold: that t rises up to it, dt/ds = 0 there, and that the path turns back.
#[derive(Debug, Clone, PartialEq)]
pub struct FoldClaim {
    /// The figure and its box.
    pub figure: SolutionClaim,
    /// t there.
    pub t: f64,
    /// How far t may be from that.
    pub t_radius: f32,
}

/// How the chain ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// The last tube leads back to the sketch; or the last arc to its end.
    Complete,
    /// Why the run stopped before.
    Stopped(String),
    /// What happens at the two ends of an open path, in words: that of the tubes before the turn, and that of
    /// those behind it.
    Open([String; 2]),
}

/// The last record: how the chain ends, and what was counted.
#[derive(Debug, Clone, PartialEq)]
pub struct EndClaim {
    /// How it ends.
    pub ending: Ending,
    /// The number of tubes.
    pub tubes: u64,
    /// The class of each solution: the same number for figures that are congruent up to
    /// reflection, counted from 0 in order of first occurrence.
    pub classes: Vec<u32>,
}

/// Why a file is not a certificate.
#[derive(thiserror::Error)]
pub enum FormatError {
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// It starts with something else.
    #[error("does not start as a krawl certificate")]
    NotACertificate,
    /// It was written by a later program.
    #[error("has version {0} of the format; this program reads version {VERSION}")]
    Version(u32),
    /// It ends early.
    #[error("ends in the middle of {0}: it is truncated")]
    Truncated(&'static str),
    /// Something is out of its range.
    #[error("{0}")]
    Malformed(String),
}
