//! Results as they are written and read: for each verb one type, in one file here, and what they share.
//!
//! A [`Document`] is filled from what a solver found, written as JSON ([`Document::to_json`]) and read again; pages are made from it
//! ([`crate::report::page::Page::of`]). docs/using/programs.md and docs/schema say what the keys mean.
//!
//! ```
//! use krawl::edit::{Session, Setting};
//! use krawl::problem::Problem;
//! use krawl::report::document::{Document, Verb};
//!
//! let bar = Problem::build("bar", 2)
//!     .point("a", ["0", "0"])
//!     .point("b", ["4", "0"])
//!     .point("c", ["0", "3"])
//!     .distance("a", "b", "4")
//!     .distance("b", "c", "5")
//!     .distance("c", "a", "3")
//!     .finish()?;
//! let ranges = Session::open(&bar)?.ranges(&mut Default::default());
//! let written = Document::limits(&bar, &ranges, Default::default());
//! let read: Document = serde_json::from_str(&written.to_json())?;
//! assert_eq!(read.drawing.names, ["a", "b", "c"]);
//! let Verb::Limits(limits) = read.own else {
//!     panic!("it is of another verb");
//! };
//! assert!(limits.ranges.get("b-c").unwrap().low.status == "limit");
//!
//! // Of what is no result the key is told at which it is none.
//! let mut value = serde_json::to_value(&written)?;
//! value["ranges"]["b-c"]["low"]["value"] = "far".into();
//! let error = Document::try_from(value.clone()).unwrap_err().to_string();
//! assert!(error.contains("`ranges` is missing or not what it should be (invalid type"), "{error}");
//! value.as_object_mut().unwrap().remove("sketch");
//! value["ranges"] = Default::default();
//! let error = Document::try_from(value).unwrap_err().to_string();
//! assert!(error.contains("`ranges` is missing"), "{error}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[macro_use]
mod keys;

mod all;
mod beside;
mod compare;
mod complex;
mod drawing;
mod edit;
mod explore;
mod figures;
mod limits;
mod motion;
mod named;
mod objects;
mod solve;
mod sweep;
mod tolerance;

pub(crate) use drawing::{all_names, names};
pub(crate) use solve::ended;
pub use {
    all::*, beside::*, compare::*, complex::*, drawing::*, edit::*, explore::*, figures::*,
    limits::*, motion::*, named::*, objects::*, solve::*, sweep::*, tolerance::*,
};

use crate::interval::Interval;
use crate::problem::Problem;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The version of the format: it grows when a key changes its meaning or goes; new keys alone do not
/// change it.
pub const JSON_VERSION: u32 = 1;

/// A lower and an upper bound of a number.
pub type Bounds = [f64; 2];

/// Points by name, each with its coordinates.
pub type Points<C> = Named<Vec<C>>;

/// A result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Value")]
pub struct Document {
    /// The problem.
    #[serde(flatten)]
    pub drawing: Drawing,
    /// What came of it.
    #[serde(flatten)]
    pub own: Verb,
    /// What was asked for beside that.
    #[serde(flatten)]
    pub beside: Beside,
}

/// What came of a verb.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
// There is one of them at a time.
#[allow(missing_docs, clippy::large_enum_variant)]
pub enum Verb {
    Solve(Solve),
    /// Of `solve` too, block by block.
    Figures(Figures),
    All(All),
    Edit(Edit),
    Limits(Limits),
    Motion(Motion),
    Sweep(Sweep),
    Tolerance(Tolerance),
    /// Of `tolerance --all`.
    Tolerances(Tolerances),
    Explore(Explored),
}

/// Why a document is no result that can be read, or shown.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum ShowError {
    /// It is not JSON.
    #[error("is not JSON: {0}")]
    NotJson(String),
    /// It is not a result of this program: a key, and what is wrong with what stands there.
    #[error(
        "is not a result that `krawl` wrote with `--json`: `{0}` is missing or not what it should be{1}"
    )]
    NotAResult(String, String),
    /// It is of another version.
    #[error("is of version {0} of the format, and this program reads version {1}")]
    Version(u64, u32),
    /// It is a result without figures in real coordinates.
    #[error("is a result of `krawl {0}`, which has no figure to draw: {1}")]
    NoFigure(&'static str, &'static str),
}

crate::debug_in_words!(ShowError);

pub(super) fn wrong(key: &str) -> ShowError {
    ShowError::NotAResult(key.to_owned(), String::new())
}

impl Document {
    /// A result as one line of JSON.
    ///
    /// Numbers read back as the floats that they were written from. JSON has neither infinities nor
    /// NaN: in their place stands `null`.
    ///
    /// # Panics
    /// Never: strings, numbers and lists have a form in JSON.
    pub fn to_json(&self) -> String {
        text(self)
    }

    pub(crate) fn of(drawing: Drawing, own: Verb) -> Self {
        let beside = Beside::new();
        Document {
            drawing,
            own,
            beside,
        }
    }
}

impl TryFrom<Value> for Document {
    type Error = ShowError;

    fn try_from(value: Value) -> Result<Self, ShowError> {
        let version = value["version"].as_u64().ok_or_else(|| wrong("version"))?;
        if version != u64::from(JSON_VERSION) {
            return Err(ShowError::Version(version, JSON_VERSION));
        }
        // Results of `solve` were the only ones that could be shown before there was this key.
        let verb = match &value["verb"] {
            Value::Null => "solve",
            verb => verb.as_str().unwrap_or_default(),
        };
        let own = match verb {
            "solve" if value["blocks"].is_array() => Verb::Figures(read(&value)?),
            "solve" => Verb::Solve(read(&value)?),
            "all" => Verb::All(read(&value)?),
            "edit" => Verb::Edit(read(&value)?),
            "limits" => Verb::Limits(read(&value)?),
            "motion" => Verb::Motion(read(&value)?),
            "sweep" => Verb::Sweep(read(&value)?),
            "tolerance" if value["figures"].is_array() => Verb::Tolerances(read(&value)?),
            "tolerance" => Verb::Tolerance(read(&value)?),
            "explore" => Verb::Explore(read(&value)?),
            "complex" => {
                return Err(ShowError::NoFigure(
                    "complex",
                    "its coordinates are complex numbers; `krawl all` or `krawl explore` with `--html` show real figures",
                ));
            }
            "compare" => {
                return Err(ShowError::NoFigure(
                    "compare",
                    "it sets runs beside each other; `krawl compare --output DIR` draws them",
                ));
            }
            _ => return Err(wrong("verb")),
        };
        Ok(Document {
            drawing: read(&value)?,
            own,
            beside: read(&value)?,
        })
    }
}

/// What of a result is of a type, or the key at which it is not.
fn read<T: DeserializeOwned>(value: &Value) -> Result<T, ShowError> {
    let complaint = |value: &Value| T::deserialize(value).map_err(|error| error.to_string());
    complaint(value).map_err(|why| {
        let is_other = |changed: &Value| complaint(changed).err().as_ref() != Some(&why);
        // If what is missing were there, or what is wrong were missing, it would not be that which goes wrong.
        let missing = why.strip_prefix("missing field `");
        let missing = missing.map_or("", |rest| rest.trim_end_matches('`'));
        let mut keys = value.as_object().into_iter().flat_map(|keys| keys.keys());
        let mut with = value.clone();
        with[missing] = Value::Null;
        let at_fault = keys.find(|key| {
            let mut without = value.clone();
            without.as_object_mut().and_then(|keys| keys.remove(*key));
            is_other(&without)
        });
        match at_fault {
            Some(key) if !is_other(&with) => {
                ShowError::NotAResult(key.clone(), format!(" ({why})"))
            }
            _ => wrong(missing),
        }
    })
}

/// What can be written as one line of JSON.
pub(super) fn text(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("strings, numbers and lists have a form in JSON")
}

/// What can be made of each of these.
fn all<T, U>(of: impl IntoIterator<Item = T>, make: impl FnMut(T) -> U) -> Vec<U> {
    of.into_iter().map(make).collect()
}

/// Whether there is nothing to say.
fn is_nothing<T: Default + PartialEq>(what: &T) -> bool {
    *what == T::default()
}

/// Adding zero turns -0, which intervals use as a lower bound, into 0.
pub(super) fn bounds(x: &Interval) -> Bounds {
    [x.inf() + 0.0, x.sup() + 0.0]
}

/// The middle of bounds, never -0.
pub(super) fn middle(x: &Interval) -> f64 {
    x.mid() + 0.0
}

/// The points of a problem in a figure.
pub(super) fn points(problem: &Problem, places: &[[Interval; 3]]) -> Points<Bounds> {
    Points::each(problem, places, bounds)
}
