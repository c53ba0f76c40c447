//! Figures that are proved, for those who compare those of several paths.

use super::ledger::{Congruence, is_congruent};
use super::reasons::undecided;
use super::solution::{Same, SolutionProver};
use crate::interval::Interval;
use crate::system::Homotopy;
use crate::track::Solution;
use crate::track::arc::Figure;
use crate::track::full::{Equations, InverseMaker};

/// A box with exactly one figure that meets its equations.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureBox {
    /// The box: one entry per unknown, in the homotopy's unit.
    pub figure: Figure,
    /// Within this distance of the box's middle, in every entry, there is no other such figure; 0 of flat figures at which
    /// the equations are dependent, as there are others as near as one likes.
    pub alone_within: f64,
}

/// What a certified run hands over beside its results, all boxes in the unit of its homotopy.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FiguresSeen {
    /// Figures with t = 0 that the path is proved to pass through, the sketch among them. There may be more.
    pub start: Vec<FigureBox>,
    /// The solutions, in the order of the results.
    pub solutions: Vec<FigureBox>,
}

/// What is proved of two figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// They are the same, or congruent up to reflection where reflections keep the constraints.
    Congruent,
    /// They are not.
    Different,
    /// Neither could be proved.
    Unknown,
}

impl FigureBox {
    /// A box with one figure, of which it is not known how far others are.
    pub fn around(ranges: impl IntoIterator<Item = Interval>) -> Self {
        FigureBox {
            figure: Figure::within(ranges),
            alone_within: 0.0,
        }
    }

    /// A figure in floats, taken for the same as others that are as near as this part of its size.
    pub fn about(figure: &[f64], part: f64) -> Self {
        let size = figure.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        FigureBox {
            figure: Figure::around(figure.to_vec(), vec![0.5 * part * size; figure.len()]),
            alone_within: 1.5 * part * size,
        }
    }

    /// As a solution with its class, and the first whose mirror image it is.
    pub fn solution(
        &self,
        homotopy: &Homotopy,
        (class, mirror_of): (usize, Option<usize>),
    ) -> Solution {
        let points = self.points(homotopy);
        let objects = self.objects(homotopy, &points);
        Solution {
            auxiliary: self.auxiliary(homotopy),
            mirror_of,
            is_degenerate: self.alone_within == 0.0,
            ..Solution::located(points, objects, class)
        }
    }

    /// Whether two boxes of the same equations hold the same figure up to congruence: proved by one's lying where
    /// the other's figure is alone, or by their being disjoint, with all signs of the gauge.
    pub fn relation(&self, other: &FigureBox, homotopy: &Homotopy) -> Relation {
        let fits = |of: &FigureBox| of.figure.centre.len() == homotopy.equations;
        if !(fits(self) && fits(other)) {
            return Relation::Unknown;
        }
        match self.is_same(other, |_| false) {
            Same::Yes => Relation::Congruent,
            Same::Unknown => Relation::Unknown,
            Same::No => match is_congruent(homotopy, self, other) {
                Congruence::Yes { .. } => Relation::Congruent,
                Congruence::No => Relation::Different,
                Congruence::Unknown | Congruence::Reversed { .. } => Relation::Unknown,
            },
        }
    }
}

/// Proves a box around the figure with t = 0 (`at_start`) or t = 1 near a point, one entry per unknown.
pub fn prove_figure(
    homotopy: &Homotopy,
    near: &[f64],
    at_start: bool,
) -> Result<FigureBox, String> {
    let equations = Equations::new(homotopy);
    let mut inverter: InverseMaker = equations.inverter();
    let mut prover = match at_start {
        true => SolutionProver::at_start(homotopy, &equations),
        false => SolutionProver::new(homotopy, &equations),
    };
    let m = equations.m;
    let mut guess = equations.vector();
    guess[..m].copy_from_slice(near);
    match prover.prove(&equations, &mut inverter, &guess, false) {
        Ok(found) => Ok(found.clone()),
        Err(doubt) => Err(undecided(doubt, false, homotopy)),
    }
}
