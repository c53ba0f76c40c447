//! The problem: points, a sketch, distances to meet, and how to get there.
//!
//! A [`Problem`] is plain data, checked: whatever builds one from a file or from code has made
//! sure that the system of equations is square and that its parts are neither over- nor
//! under-constrained. Numbers are [`Decimal`]s, exactly what the file says.

mod bend;
mod builder;
mod check;
mod cursor;
mod draft;
mod error;
#[doc(hidden)]
pub mod expression;
mod file;
mod formula;
mod joint;
mod limits;
mod published;
mod reference;
mod vocabulary;
mod write;

pub use crate::decimal::{Decimal, DecimalError};
#[doc(hidden)]
pub use crate::statement::most_along;
pub use crate::statement::{
    AXES, Atom, Constraint, DEPENDS, Distance, Formula, HomotopyChoices, Item, JointSort, Kept,
    Object, Orientation, Point, Pose, Problem, Shape, Target, Terms, Tolerances, free_coordinates,
};
#[doc(hidden)]
pub use crate::statement::{counted, either, list};
#[doc(hidden)]
pub use bend::default_coefficient as default_bend;
pub use builder::{Numeral, ProblemBuilder};
pub use check::{Rigidity, rigidity, rigidity_row};
pub use error::{MAX_NAME, MAX_POINTS, Place, ProblemError};
pub use expression::names as names_in;
pub use file::{FileError, MAX_FILE_SIZE};
#[doc(hidden)]
pub use limits::{said_with_limits, toml_with_limits};
pub use published::Published;
#[doc(hidden)]
pub use write::{number as toml_number, unknown as toml_unknown};
