//! What is asked of a file, and how it is followed.

use super::{Arguments, input};
use krawl::blocks::MOST_POINTS;
use krawl::complete::{Surplus, has_equations_to_spare};
use krawl::constraint::fix_frame;
use krawl::problem::{Problem, free_coordinates};
use krawl::track::Mode;
use std::path::Path;

/// What is asked of a file.
pub(super) struct Asked {
    /// What is followed.
    pub problem: Problem,
    /// Whether it is solved block by block from the start: a sketch of another program, or a problem in its own frame that has not as many
    /// equations as unknowns, where nothing is asked for that a path of the whole has alone.
    pub is_by_blocks: bool,
    /// The distances beside those that are followed: of a figure without a frame that has more than it needs, or of a molecule.
    pub surplus: Option<Surplus>,
}

/// Whether a figure without a frame has fewer constraints than it needs.
fn is_loose(problem: &Problem) -> bool {
    let needed = free_coordinates(problem.dimension, problem.points.len());
    problem.distances.len() + problem.constraints.len() < needed
}

impl Arguments {
    /// What is asked of a file.
    pub(super) fn read(&self, file: &Path) -> Result<Asked, String> {
        let which = &self.which;
        let whole = |problem| Asked {
            problem,
            is_by_blocks: false,
            surplus: None,
        };
        let is_whole = self.mode == Mode::Float || self.wants_path().is_some();
        if is_whole && input::is_sketch(file) {
            return input::read(file, which).map(whole);
        }
        let loaded = input::load(file, which)?.with_any_signs(self.any_signs);
        let is_in_its_frame = fix_frame(&loaded.problem);
        if let Some(surplus) = loaded.surplus()
            && (self.mode == Mode::Certified || loaded.fault.is_none())
        {
            let surplus = surplus
                .into_owned()
                .with_tolerance(self.left_out.redundant_tolerance);
            return Ok(Asked {
                problem: surplus.problem.clone(),
                is_by_blocks: false,
                surplus: Some(surplus),
            });
        }
        let Some(fault) = loaded.fault else {
            return Ok(Asked {
                is_by_blocks: input::is_sketch(file),
                ..whole(loaded.problem)
            });
        };
        if is_in_its_frame && !is_whole {
            return Ok(Asked {
                is_by_blocks: true,
                ..whole(loaded.problem)
            });
        }
        let advice = match is_in_its_frame {
            true => "",
            // Of figures with very many points that is not looked for.
            false
                if loaded.problem.points.len() <= MOST_POINTS
                    && has_equations_to_spare(&loaded.problem.clone().up_to_motions()) =>
            {
                "; or see `krawl all`, which finds all figures that have as many as are needed, and tests the others"
            }
            false if is_loose(&loaded.problem) => {
                "; `krawl motion` follows it where it moves in one way, and `krawl edit` changes it as it is"
            }
            false => "",
        };
        Err(fault + advice)
    }

    /// What is asked for that only a path of the whole has.
    pub(super) fn wants_path(&self) -> Option<&'static str> {
        let asked = [
            (self.mode == Mode::Float, "--mode float"),
            (self.reverse, "--reverse"),
            (self.space.is_some(), "--space"),
            (self.samples.is_some(), "--samples"),
            (self.cert.is_some(), "--cert"),
            (self.pictures.has_animation(), "--animation"),
            (self.many.is_wanted(), "--digits"),
        ];
        asked.iter().find(|(is, _)| *is).map(|(_, option)| *option)
    }

    /// What is said before the answer to a sketch of another program that is followed as a whole.
    pub(super) fn whole_in_words(&self, file: &Path) -> String {
        match self.wants_path() {
            Some(option) if input::is_sketch(file) && !self.summary => format!(
                "Followed as a whole, as `{option}` asks for its path: what nothing determines is held, what seems to \
                 follow from other constraints is left out. Without it the figures are found block by block.\n"
            ),
            _ => String::new(),
        }
    }
}
