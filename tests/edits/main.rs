//! Edits, limits and blocks: figures that keep their shape while dimensions change.

use krawl_common as common;

mod blocks;
mod chosen_anew;
mod claims;
mod drag;
mod edit;
mod edit_mixed;
#[cfg(feature = "freecad")]
mod expressions;
#[cfg(feature = "freecad")]
mod freecad_files;
mod measures;
mod motion;
mod not_square;
mod outlines;
mod parameters;
mod real_files;
mod real_sketches;
mod singular_drawings;
mod sketches;
mod tolerance;
mod too_many;
mod whole_turns;
