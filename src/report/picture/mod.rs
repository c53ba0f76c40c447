//! Pictures (SVG): what accuracy costs, t along the path, the path from one side.
//!
//! All on white, in colours that the colour-blind can tell apart: those of Okabe and Ito for kinds,
//! and a piece of viridis for sizes, whose brightness grows with them.

mod cost;
mod curve;
mod projection;
mod style;
mod time;

pub use cost::cost_against_accuracy;
pub use projection::projection;
pub use time::time_along_path;
