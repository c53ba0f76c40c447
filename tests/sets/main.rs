//! Sets of all solutions, real and complex, and searches for more.

use krawl_common as common;

mod all_constraints;
mod all_store;
mod all_store_constraints;
mod cases;
mod complete;
mod complete_hard;
mod complex_frames;
mod complex_infinity;
mod complex_solutions;
mod digits;
mod equations;
mod explore;
mod exports;
mod falling_apart;
mod joints;
mod mechanisms;
mod miscounted;
mod more_than_square;
mod poses;
mod sides;
mod signs;
mod tolerances;
mod torsions;
