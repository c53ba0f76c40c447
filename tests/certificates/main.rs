//! Certificates: what checkers take and what they refuse.

use krawl_common as common;

mod certificate_damage;
mod certificate_edits;
mod certificate_false;
mod certificate_jump;
mod certificate_open;
mod certificate_reduced;
mod certificate_scales;
mod certificates;
mod checker_is_small;
mod complex_sets;
mod covers;
mod covers_of_constraints;
mod independent;
mod motions;
