//! Figures that are proved, for those who compare those of several paths.

use super::ledger::{Congruence, is_congruent};
use super::reasons::undecided;
use super::solution::{Same, SolutionBox, SolutionProver};
use crate::interval::Interval;
use crate::linalg::Vector;
use crate::system::Homotopy;
use crate::track::arc::Figure;
use crate::track::full::{Equations, InverseMaker};

/// A box with exactly one figure that meets its equations.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureBox {
    /// The box: one entry per unknown, in the homotopy's unit.
    pub figure: Figure,
    /// Within this distance of the box's middle, in every entry, there is no other such figure.
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
    pub(super) fn of(found: &SolutionBox) -> Self {
        let m = found.centre.len() - 2;
        FigureBox {
            figure: Figure {
                centre: found.centre[..m].to_vec(),
                low: found.low[..m].to_vec(),
                radius: found.radius[..m].to_vec(),
            },
            alone_within: found.alone_within,
        }
    }

    /// A box with one figure, of which it is not known how far others are.
    pub fn around(ranges: impl IntoIterator<Item = Interval>) -> Self {
        let ranges: Vec<Interval> = ranges.into_iter().collect();
        FigureBox {
            figure: Figure {
                centre: ranges.iter().map(|x| x.mid()).collect(),
                low: vec![0.0; ranges.len()],
                radius: ranges.iter().map(|x| x.rad()).collect(),
            },
            alone_within: 0.0,
        }
    }

    /// The coordinates of all points, in the problem's units.
    pub fn points(&self, homotopy: &Homotopy) -> Vec<[Interval; 3]> {
        self.to_solution().points(homotopy)
    }

    fn to_solution(&self) -> SolutionBox {
        let m = self.figure.centre.len();
        let vector = |of: &[f64]| {
            let mut vector = Vector::zeros(m + 2);
            vector[..m].copy_from_slice(of);
            vector
        };
        SolutionBox {
            centre: vector(&self.figure.centre),
            low: vector(&self.figure.low),
            radius: vector(&self.figure.radius),
            alone_within: self.alone_within,
            rising: false,
            // What is told of such boxes rests on `alone_within` alone, which is zero for flat figures.
            is_flat: false,
        }
    }

    /// Whether two boxes of the same equations hold the same figure, with the same signs.
    pub(super) fn same(&self, other: &FigureBox) -> Same {
        self.to_solution().is_same(&other.to_solution(), |_| false)
    }

    /// Whether two boxes of the same equations hold the same figure up to congruence: proved by one's lying where
    /// the other's figure is alone, or by their being disjoint, with all signs of the gauge.
    pub fn relation(&self, other: &FigureBox, homotopy: &Homotopy) -> Relation {
        let fits = |of: &FigureBox| of.figure.centre.len() == homotopy.equations;
        if !(fits(self) && fits(other)) {
            return Relation::Unknown;
        }
        let (one, other) = (self.to_solution(), other.to_solution());
        match one.is_same(&other, |_| false) {
            Same::Yes => Relation::Congruent,
            Same::Unknown => Relation::Unknown,
            Same::No => match is_congruent(homotopy, &one, &other) {
                Congruence::Yes { .. } => Relation::Congruent,
                Congruence::No => Relation::Different,
                Congruence::Unknown | Congruence::Reversed => Relation::Unknown,
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
    match prover.prove(&equations, &mut inverter, &guess, (true, false)) {
        Ok(found) => Ok(FigureBox::of(found)),
        Err(doubt) => Err(undecided(doubt, false, homotopy)),
    }
}
