//! Paths through sketches: what trackers find, in all modes and spaces, and what answers may depend on.

use krawl_common as common;

mod bar_by_bar;
mod bend;
mod certified_spaces;
mod compare;
mod constraints;
mod degenerate;
mod directions;
mod endless;
mod extended;
mod first_arc;
mod generated;
mod hard_cases;
mod hard_constraints;
mod interval_laws;
mod mixed_kinds;
mod object_distances;
mod objects;
mod open_floats;
mod open_paths;
mod paper;
mod properties;
mod random_problems;
mod solutions;
mod threads;
mod two_ways;
