//! Which figures have the signs that a problem asks for ([`Orientation`]).
//!
//! Where constraints say nothing of mirror images, the mirror image of a figure meets them too, and has all signs reversed: a figure counts
//! where it has all signs that are asked for or none of them. Then its mirror image is the figure that is wanted.

use super::{Outcome, Solution};
use crate::constraint::{Symmetry, symmetry};
use crate::interval::Interval;
use crate::interval::vector::Vector;
use crate::problem::{Orientation, Problem};
use crate::system::{Located, orientation};

/// How a figure, or all figures of a part of a search, stand to signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stand {
    /// All signs are as they are asked for.
    Right,
    /// All of them are the other way round, and the mirror image is a figure too: it has all signs.
    Mirrored,
    /// One sign is wrong, in the mirror image as well where that is a figure.
    Wrong,
    /// That cannot be told.
    Unknown,
}

/// Signs that are asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Signs {
    /// The signs.
    pub all: Vec<Orientation>,
    /// Whether mirror images of figures are figures.
    pub mirrors: bool,
}

/// What came of figures by their signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Signed {
    /// How many signs are asked for.
    pub asked: usize,
    /// How many figures were looked at; of a search those of parts that were not given up. Where mirror images are figures, one may be found
    /// with its own.
    pub found: u64,
    /// How many parts of a search were given up as all figures in them have a wrong sign.
    pub cut: u64,
    /// How many figures were proved to have a wrong sign. They are no solutions.
    pub wrong: u64,
    /// How many of the solutions are mirror images of figures that were found.
    pub mirrored: usize,
    /// Of how many figures a sign cannot be told. They are no solutions that are listed.
    pub undecided: u64,
}

impl Signed {
    /// Before any figure is looked at: so many parts of a search were given up.
    pub fn cut(cut: u64) -> Option<Self> {
        (cut > 0).then(|| Signed {
            cut,
            ..Signed::default()
        })
    }
}

impl Signs {
    /// Those of a problem.
    pub fn of(problem: &Problem) -> Self {
        Signs {
            all: problem.orientations.clone(),
            mirrors: !problem.orientations.is_empty() && symmetry(problem) == Symmetry::Isometries,
        }
    }

    /// How something stands to them of which `sign` tells the signs that determinants have: 1, −1, or 0 where that is not certain.
    pub fn stand(&self, mut sign: impl FnMut(&[usize]) -> i8) -> Stand {
        let (mut right, mut wrong, mut unknown) = (false, false, false);
        for one in &self.all {
            match (sign(&one.points), one.is_positive) {
                (0, _) => unknown = true,
                (1, true) | (-1, false) => right = true,
                _ => wrong = true,
            }
            if wrong && (right || !self.mirrors) {
                return Stand::Wrong;
            }
        }
        match (unknown, wrong) {
            (true, _) => Stand::Unknown,
            (false, true) => Stand::Mirrored,
            (false, false) => Stand::Right,
        }
    }

    /// How the figures in a box of all points stand to them.
    pub fn of_figure(&self, points: &[Vector]) -> Stand {
        self.stand(|simplex| orientation(points, simplex))
    }

    /// Takes those of some solutions out that are proved to have a wrong sign, or of which it is not certain, and puts mirror images in the place of
    /// those that have all signs reversed. The other numbers of `Signed` are left as they are. For each solution whether it is still there.
    pub fn choose(
        &self,
        solutions: &mut Vec<Solution>,
        dimension: usize,
        signed: &mut Signed,
    ) -> Vec<bool> {
        let mut is_kept = Vec::with_capacity(solutions.len());
        for mut solution in std::mem::take(solutions) {
            // All points of a degenerate figure are in one plane: it has no signs.
            let stand = match solution.is_degenerate {
                true => Stand::Wrong,
                false => self.of_figure(&solution.points),
            };
            match stand {
                Stand::Wrong => signed.wrong += 1,
                Stand::Unknown => signed.undecided += 1,
                Stand::Right => {}
                Stand::Mirrored => {
                    signed.mirrored += 1;
                    mirror(&mut solution, dimension);
                    // The path comes to the figure, not to its mirror image.
                    solution.place = None;
                }
            }
            is_kept.push(matches!(stand, Stand::Right | Stand::Mirrored));
            if is_kept.ends_with(&[true]) {
                solutions.push(solution);
            }
        }
        is_kept
    }

    /// Does so with the solutions of a path, where signs are asked for. Of a figure and its mirror image, if both are on the path, the one
    /// stays that has the signs as the path comes to it.
    pub fn test(&self, outcome: &mut Outcome, dimension: usize) {
        if self.all.is_empty() {
            return;
        }
        let mut signed = Signed {
            asked: self.all.len(),
            found: outcome.solutions.len() as u64,
            ..Signed::default()
        };
        self.choose(&mut outcome.solutions, dimension, &mut signed);
        let met = outcome.solutions.iter().filter(|s| s.place.is_some());
        let met: Vec<usize> = met.map(|solution| solution.class).collect();
        let mut seen = Vec::new();
        outcome.solutions.retain(|solution| {
            let class = &solution.class;
            let is_image = solution.place.is_none() && met.contains(class);
            let is_kept = !self.mirrors || !is_image && !seen.contains(class);
            if is_kept {
                seen.push(*class);
            }
            is_kept
        });
        for solution in &mut outcome.solutions {
            solution.mirror_of = None;
        }
        outcome.signed = Some(signed);
    }
}

/// Reflects a figure: in the plane in the x axis, in space in the plane of x and y.
fn mirror(solution: &mut Solution, dimension: usize) {
    let k = dimension - 1;
    let flip = |v: &mut [Interval; 3]| v[k] = -v[k];
    solution.points.iter_mut().for_each(flip);
    for object in &mut solution.objects {
        match object {
            Located::Line { point, direction } => [point, direction].into_iter().for_each(flip),
            Located::Plane { point, normal } => {
                flip(point);
                // Of three points counter-clockwise it is so in the image, too.
                normal[..k].iter_mut().for_each(|x| *x = -*x);
            }
            Located::Round { center, .. } => flip(center),
            // What has bodies with joints is no figure with its mirror image; numbers stay as they are.
            _ => {}
        }
    }
}
