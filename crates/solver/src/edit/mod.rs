//! Edits: some dimensions change, everything else stays, and the figure goes along, by proof.
//!
//! A [`Session`] holds a figure that meets its dimensions. [`Session::edit`] leads the named dimensions in
//! proportion to t from what they are (t = 0) to what they shall be (t = 1), and proves tube by tube that
//! along the path dt/ds > 0. What comes of it is one of four, an [`Ending`]:
//!
//! - `Reached`: the figure at t = 1 is the one and only continuation of the old one;
//! - `Limit`: the path turns back at a t* < 1, which is enclosed: so far the dimensions can go and no further;
//! - `Passes`: branches seem to meet, so that no continuation is singled out (seen in floats, not proved);
//! - `Stopped`: nothing could be proved from some t on, and why; or a drawn line or arc shrinks to nothing there and would come out
//!   turned round.
//!
//! ```
//! use krawl::edit::{Ending, Session, Setting};
//! use krawl::problem::Problem;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let triangle = Problem::build("triangle", 2)
//!     .point("a", [0, 0]).point("b", [4, 0]).point("c", [0, 3])
//!     .distance("a", "b", 4).distance("b", "c", 5).distance("c", "a", 3)
//!     .finish()?;
//! let mut session = Session::open(&triangle)?;
//! let edited = session.edit(&[Setting::parse(&triangle, "a-b=6")?]);
//! assert_eq!(edited.ending, Ending::Reached);
//! // c is still on the left of the line from a to b.
//! assert!(edited.points[2][1].inf() > 0.0);
//!
//! // No triangle has sides 9, 5 and 3: a-b can grow to 8.
//! let edited = session.edit(&[Setting::parse(&triangle, "a-b=9")?]);
//! let Ending::Limit(limit) = &edited.ending else { panic!("{edited:?}") };
//! assert!((edited.dimensions[0].value.mid() - 8.0).abs() < 1e-12);
//! assert_eq!(limit.flat, [vec![0, 1, 2]]);
//! // The session still has the last figure that was reached.
//! assert_eq!(session.length(0).mid(), 6.0);
//! # Ok(())
//! # }
//! ```

mod alone;
mod computed;
mod drag;
mod ending;
mod flat;
mod limited;
mod limits;
mod open;
mod parts;
mod place;
mod round;
mod segments;
mod session;
mod setting;
mod sweep;
mod way;
mod whole;
mod whole_turn;

mod write;

pub use alone::{Alone, alone};
pub use computed::held_though_computed;
pub use drag::{Drag, Dragged};
use ending::Keep;
pub use ending::{Astray, Dimension, Edited, Ending, Limit, Lost, Orientations};
pub use limited::Limits;
pub(crate) use limited::{Limited, Part, Value};
pub use limits::{End, Range};
pub use open::{Moved, OpenError};
pub use parts::Extreme;
pub(crate) use round::Round;
pub use round::WayEnd;
pub use session::{Decomposition, Session, Standing, TooMany, completed};
pub(crate) use setting::measure_of;
pub use setting::{Setting, SettingError};
pub use sweep::{Frame, Sweep, evenly};
pub use whole_turn::{Asked, with_turns_of};
pub use write::{WriteError, rewrite};

use crate::blocks::in_words;
use crate::constraint::{Fault, Lowered, Owner};
use crate::problem::Problem;

/// The equations of a problem, or what is at fault in words.
fn lowered(
    problem: &Problem,
    lower: impl FnOnce(&Problem) -> Result<Lowered, (Owner, Fault)>,
) -> Result<Lowered, String> {
    lower(problem).map_err(|fault| in_words(problem, fault))
}
