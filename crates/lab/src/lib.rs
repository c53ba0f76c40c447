//! What the papers behind krawl describe and measure, and krawl itself does not need.
//!
//! - [`rstructure`]: R-structured matrices that are stored as such, with the table of solving times in
//!   `benches/rstructure.rs`

#![warn(missing_docs)]

pub mod rstructure;
