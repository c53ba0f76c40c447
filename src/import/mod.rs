//! Files of other programs, in and out: sketches of SolveSpace (`.slvs`) and FreeCAD (`.FCStd`), molecules (`.xyz`,
//! `.mol`, `.sdf`, `.pdb`), robots (`.urdf`) and systems of polynomials, which become problem files.
//!
//! A file may hold several sketches; [`list`] says which, and [`read`] takes one. What it says becomes a
//! [`Problem`] in the sketch's own frame, with the kinds of constraints that krawl has. Where krawl
//! has no such kind, the points and edges that the constraint names stay where they are ([`Problem::kept`] has them).
//!
//! The problem is what the file says and no more: it may be under-constrained, or say a thing twice. Edits take it
//! as it is ([`crate::edit::Session`] says what it held and what it left out).
//!
//! # Numbers
//!
//! Both programs store doubles, and write more digits than anyone typed: 12.7 stands as `12.69999999999999928946` in one
//! and as `12.6999999999999993` in the other. A number is read as a double, and means the *shortest decimal that reads
//! as this double*, 12.7. FreeCAD's angles are radians: the angle meant is the decimal number of degrees with at most nine
//! digits behind the point if that, converted back, is the same double up to its last digit, and else the shortest
//! decimal of the number of degrees.
//!
//! ```
//! use krawl::import;
//! let bytes = std::fs::read("problems/sketches/bracket.slvs")?;
//! let bracket = import::read("bracket.slvs", &bytes, None)?;
//! assert!(bracket.problem.kept.what.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod drawing;
#[cfg(feature = "freecad")]
mod freecad;
mod molecule;
pub mod polynomials;
mod slvs;
#[cfg(feature = "freecad")]
pub mod urdf;

use crate::complete::Surplus;
use crate::edit::Setting;
use crate::problem::{Decimal, Problem};
pub(crate) use molecule::ELEMENTS;
pub use molecule::{Conformer, Letter, Skeleton};

/// The largest file that is read, in bytes.
pub const MAX_SIZE: usize = 256 << 20;

/// A format of another program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// SolveSpace's, `.slvs`.
    SolveSpace,
    /// FreeCAD's, `.FCStd`.
    FreeCad,
    /// Atoms with their coordinates, `.xyz`.
    Xyz,
    /// MDL's molfiles, `.mol` and `.sdf`.
    Sdf,
    /// The Protein Data Bank's files, `.pdb` and `.ent`.
    Pdb,
}

impl Format {
    /// The format that a file's name tells by its extension, in letters of either case.
    pub fn of(file: &str) -> Option<Format> {
        let extension = file.rsplit_once('.')?.1.to_ascii_lowercase();
        match extension.as_str() {
            "slvs" => Some(Format::SolveSpace),
            "fcstd" => Some(Format::FreeCad),
            "xyz" => Some(Format::Xyz),
            "mol" | "sdf" => Some(Format::Sdf),
            "pdb" | "ent" => Some(Format::Pdb),
            _ => None,
        }
    }
}

/// What a program is told whose author left archives and XML out.
#[cfg(not(feature = "freecad"))]
const NO_FREECAD: &str =
    "FreeCAD's files are read by the feature `freecad` of krawl, without which this was built";

/// A sketch that a file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listed {
    /// Its name, for [`read`].
    pub name: String,
    /// What its program shows for the name, where that is something else: also for [`read`], if no other sketch is called so.
    pub label: Option<String>,
    /// How many points, lines, circles and arcs are drawn in it.
    pub drawn: usize,
    /// How many constraints it has that drive it.
    pub constraints: usize,
}

impl Listed {
    /// Its name, and what its program shows for it.
    pub fn title(&self) -> String {
        match &self.label {
            Some(label) => format!("{} (\"{label}\")", self.name),
            None => self.name.clone(),
        }
    }
}

/// A sketch as krawl understands it.
#[derive(Debug, Clone)]
pub struct Imported {
    /// What the sketch says; its labels are what constraints are called in their own program. It need not have as many equations as unknowns, and has not been checked for that.
    pub problem: Problem,
    /// Of a molecule: the distances of bonds and bond angles that [`Imported::problem`] has not, and what it has in place of such.
    pub surplus: Option<Surplus>,
    /// Of a molecule: its atoms and bonds.
    pub skeleton: Option<Skeleton>,
    /// What was left out of what the file has, in words that follow *it was read*, as `without its water (3)`.
    pub notes: Vec<String>,
    /// Dimensions that the file's own program computes.
    pub tied: Vec<Tied>,
    places: Places,
    /// Of a sketch: for each distance, then each constraint, what of the file it is.
    sources: Vec<Option<usize>>,
}

/// A dimension that its own program computes by an expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tied {
    /// The index of the dimension.
    pub index: usize,
    /// The expression.
    pub expression: String,
    /// Why the expression is not followed, where it is not.
    pub fault: Option<String>,
}

/// A dimension that is set as others are, by the expression that it has in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Follower {
    /// The index of the dimension.
    pub index: usize,
    /// What it is then: what the program computes in floats, as the shortest decimal that reads as that float.
    pub value: Decimal,
    /// The expression.
    pub expression: String,
}

/// What goes with dimensions that are set.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Followed {
    /// The dimensions that follow from them.
    pub set: Vec<Follower>,
    /// What does not follow, and what its own program will set anew.
    pub warnings: Vec<String>,
}

/// Where the numbers of a sketch stand in its file.
#[derive(Debug, Clone)]
enum Places {
    SolveSpace(slvs::Places),
    #[cfg(feature = "freecad")]
    FreeCad(freecad::Places),
    Molecule(molecule::Places),
}

/// The new numbers of a sketch.
#[derive(Debug, Clone, Copy)]
pub struct Figure<'a> {
    /// The places of points.
    pub points: &'a [[f64; 3]],
    /// The radii of circles, by object; what is not a circle may have any number.
    pub radii: &'a [f64],
}

/// Why a file gives no sketch.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// The extension tells no format.
    #[error("{0}: is no .slvs, .FCStd, .xyz, .mol, .sdf or .pdb file")]
    Format(String),
    /// It cannot be read as what its extension says.
    #[error("{file}: {what}")]
    Broken {
        /// The file.
        file: String,
        /// What is wrong, and where.
        what: String,
    },
    /// It holds no sketch at all.
    #[error("{0}: there is no sketch in it (a group in a plane, a sketch object, or a molecule)")]
    NoSketch(String),
    /// No sketch has that name, or none was named and there are several.
    #[error("{file}: {what}; name one with --sketch: {names}")]
    Which {
        /// The file.
        file: String,
        /// What is wrong.
        what: String,
        /// The names of all.
        names: String,
    },
}

/// The sketches that a file holds.
///
/// # Errors
/// If it cannot be read.
pub fn list(file: &str, bytes: &[u8]) -> Result<Vec<Listed>, ImportError> {
    match Format::of(file) {
        Some(Format::SolveSpace) => slvs::list(bytes),
        #[cfg(feature = "freecad")]
        Some(Format::FreeCad) => freecad::list(bytes),
        #[cfg(not(feature = "freecad"))]
        Some(Format::FreeCad) => Err(NO_FREECAD.to_owned()),
        Some(format) => molecule::list(bytes, format),
        None => return Err(ImportError::Format(file.to_owned())),
    }
    .map_err(|what| broken(file, what))
}

/// Reads a sketch: the one that is named, or else the only one.
///
/// # Errors
/// If the file cannot be read, or does not say which sketch is meant.
pub fn read(file: &str, bytes: &[u8], sketch: Option<&str>) -> Result<Imported, ImportError> {
    read_with(file, bytes, sketch, false)
}

/// Reads a molecule without its hydrogens: [`rewrite`] turns each as the other bonds of its atom are.
///
/// # Errors
/// As of [`read`], and if the file is not one of molecules.
pub fn read_heavy(file: &str, bytes: &[u8], sketch: Option<&str>) -> Result<Imported, ImportError> {
    read_with(file, bytes, sketch, true)
}

fn read_with(
    file: &str,
    bytes: &[u8],
    sketch: Option<&str>,
    heavy: bool,
) -> Result<Imported, ImportError> {
    let all = list(file, bytes)?;
    let index = match sketch {
        Some(name) => {
            let named = all.iter().position(|listed| listed.name == name);
            let labelled = |listed: &Listed| listed.label.as_deref() == Some(name);
            let only = || {
                let first = all.iter().position(labelled)?;
                let last = all.iter().rposition(labelled)?;
                (first == last).then_some(first)
            };
            named.or_else(only)
        }
        None => (all.len() == 1).then_some(0),
    };
    let index = index.ok_or_else(|| match (sketch, all.is_empty()) {
        (_, true) => ImportError::NoSketch(file.to_owned()),
        (name, _) => ImportError::Which {
            file: file.to_owned(),
            what: match name {
                Some(name) => format!("there is no sketch `{name}`"),
                None => format!("there are {} sketches in it", all.len()),
            },
            names: {
                let names: Vec<String> = all.iter().map(Listed::title).collect();
                names.join(", ")
            },
        },
    })?;
    match Format::of(file) {
        Some(Format::SolveSpace | Format::FreeCad) if heavy => {
            Err("only of molecules hydrogens are left out (--heavy)".to_owned())
        }
        Some(Format::SolveSpace) => slvs::read(bytes, index),
        #[cfg(feature = "freecad")]
        Some(Format::FreeCad) => freecad::read(bytes, index),
        #[cfg(not(feature = "freecad"))]
        Some(Format::FreeCad) => Err(NO_FREECAD.to_owned()),
        Some(format) => molecule::read(bytes, (format, index), heavy),
        None => return Err(ImportError::Format(file.to_owned())),
    }
    .map_err(|what| broken(file, what))
}

/// The file with a sketch's new numbers: the figure, the values of dimensions in `problem` where they are not
/// those that were read, and cells that were set. All else stays as it is: of a `.slvs` file byte for byte; of a `.FCStd` file, which is an
/// archive, all other parts as they are packed, and `Document.xml` byte for byte but for those numbers.
///
/// `problem` is [`Imported::problem`] but for the values of dimensions.
///
/// # Errors
/// If the bytes are not those that the sketch was read from.
pub fn rewrite(
    imported: &Imported,
    bytes: &[u8],
    problem: &Problem,
    figure: &Figure,
) -> Result<Vec<u8>, String> {
    match &imported.places {
        Places::SolveSpace(places) => slvs::rewrite(imported, places, bytes, problem, figure),
        #[cfg(feature = "freecad")]
        Places::FreeCad(places) => freecad::rewrite(imported, places, bytes, problem, figure),
        Places::Molecule(places) => molecule::rewrite(places, bytes, figure),
    }
}

impl Followed {
    /// The dimensions that follow, by index, with their new values.
    pub fn numbers(&self) -> impl Iterator<Item = (usize, Decimal)> {
        let set = self.set.iter();
        set.map(|follower| (follower.index, follower.value.clone()))
    }

    /// Adds what is to be said of a figure that was not reached: the way there is not the expressions'.
    pub fn note_way(&mut self) {
        if !self.set.is_empty() {
            self.warnings.push(
                "on the way lengths that are set or follow go in straight lines to what they are to be, and so do cosines of angles: where \
                 that ends is no limit of the file's, in which numbers go by their expressions"
                    .to_owned(),
            );
        }
    }

    /// Why dimensions cannot be set, with what follows if anything does.
    pub fn in_error(&self, error: &dyn std::fmt::Display) -> String {
        let followers = self.set.iter();
        let by: String = followers
            .map(|follower| format!("; a number follows by the file's `{}`", follower.expression))
            .collect();
        format!("{error}{by}")
    }
}

impl Imported {
    /// The dimensions that follow by the file's expressions where these are set, and all others are what they are in `now`, which is
    /// [`Imported::problem`] but for the values of dimensions; and what is to be said.
    #[cfg_attr(not(feature = "freecad"), allow(unused_variables))]
    pub fn followed(&self, now: &Problem, set: &[Setting]) -> Followed {
        match &self.places {
            #[cfg(feature = "freecad")]
            Places::FreeCad(places) => freecad::followed(self, places, now, set),
            _ => Followed::default(),
        }
    }

    /// Gives a cell of the file's spreadsheets, `Spreadsheet.width`, or a variable, `VarSet.width`, another number, in the unit that it has
    /// there: [`Imported::followed`] says what follows, and [`rewrite`] writes it. `None`: neither has that name.
    #[cfg_attr(not(feature = "freecad"), allow(unused_variables))]
    pub fn set_cell(&mut self, name: &str, value: &str) -> Option<Result<(), String>> {
        match &mut self.places {
            #[cfg(feature = "freecad")]
            Places::FreeCad(places) => places.computed.set_cell(name, value),
            _ => None,
        }
    }

    /// What is to be said where these dimensions are led, and what is tied to them is not: which of all these its own program computes.
    #[cfg_attr(not(feature = "freecad"), allow(unused_variables))]
    pub fn computed(&self, led: &[usize]) -> Option<String> {
        let names: Vec<String> = match &self.places {
            #[cfg(feature = "freecad")]
            Places::FreeCad(places) => freecad::computed(self, places, led),
            _ => Vec::new(),
        };
        (!names.is_empty()).then(|| {
            format!(
                "the file computes {} by expressions, which are not followed here: each is led as if it had none, or stays",
                crate::problem::list(&names, 10)
            )
        })
    }

    /// Whether a dimension, by index, is a number that the file has for this sketch: radii of geometry of other groups and
    /// objects, which stay as they are, are not.
    pub fn has_number(&self, index: usize) -> bool {
        matches!(self.places, Places::Molecule(_))
            || self.sources.get(index).is_some_and(Option::is_some)
    }
}

fn broken(file: &str, what: String) -> ImportError {
    ImportError::Broken {
        file: file.to_owned(),
        what,
    }
}

/// The value of a dimension in floats; zero where it has none.
fn value(problem: &Problem, index: usize) -> f64 {
    match index.checked_sub(problem.distances.len()) {
        None => problem.distances[index].target.to_f64(),
        Some(c) => problem.constraints[c]
            .value
            .as_ref()
            .map_or(0.0, Decimal::to_f64),
    }
}

/// A dimension that has another value than the file.
struct Changed {
    is_angle: bool,
    /// What of the file it is.
    source: usize,
    value: f64,
    before: f64,
}

/// The dimensions that have another value in `now`, of which some are nothing of the file that can be changed.
fn changed(imported: &Imported, now: &Problem) -> impl Iterator<Item = Result<Changed, String>> {
    let before = &imported.problem;
    let lengths = before.distances.iter().zip(&now.distances);
    let lengths = lengths.map(|(a, b)| a.target != b.target);
    let others = before.constraints.iter().zip(&now.constraints);
    let others = others.map(|(a, b)| a.value != b.value);
    let indices = lengths.chain(others).enumerate();
    indices.filter(|(_, is_new)| *is_new).map(move |(index, _)| {
        let source = imported.sources.get(index).copied().flatten();
        let source = source.ok_or_else(|| {
            format!(
                "`{}` is of geometry of another group or object, which stays as it is: there is no number of this sketch to change",
                now.dimension_name(index)
            )
        })?;
        let constraint = index.checked_sub(now.distances.len());
        Ok(Changed {
            is_angle: constraint
                .is_some_and(|c| matches!(&now.constraints[c].kind[..], "angles" | "turns")),
            source,
            value: value(now, index),
            before: value(before, index),
        })
    })
}
