//! Changing the plan on the fly (RR 8705, Algorithms 2 and 3, section 4.3).

use super::boundary::{gamma_three, gamma_two};
use super::shift::{shift_from_circle, shift_in_plane, shift_in_space};
use super::vector::{V3, cross, dot, sub};
use super::{Arm, Instruction, Plan};
use crate::places::array;

/// Where the path is, when a plan is to be changed. All lengths are in the homotopy's unit.
#[derive(Debug, Clone, Copy)]
pub struct Situation<'a> {
    /// The current figure.
    pub figure: &'a [f64],
    /// A figure further along the path. What comes near a boundary configuration there, or
    /// passes one on the way, is changed at once.
    pub ahead: Option<&'a [f64]>,
    /// The lengths a(t) of all distances at the current figure.
    pub lengths: &'a [f64],
    /// Instructions are changed where γ ≤ alpha.
    pub alpha: f64,
    /// Original instructions come back where their γ exceeds this (alpha in the paper; somewhat
    /// more keeps a plan from going back and forth).
    pub restore: f64,
}

impl Situation<'_> {
    fn length(&self, arm: &Arm) -> f64 {
        match arm {
            Arm::Edge { edge, .. } => self.lengths[*edge],
            Arm::Driving { .. } => f64::INFINITY,
        }
    }

    /// γ of an elementary instruction with the given arms, the smaller of here and ahead; zero
    /// if the point changes sides in between. `instruction`: point and arity.
    fn gamma(&self, dimension: usize, instruction: (usize, usize), arms: &[Arm]) -> f64 {
        let (point, arity) = instruction;
        let seen = |figure: &[f64]| {
            let p = place(figure, dimension, point);
            let c = |k: usize| match arms[k] {
                Arm::Edge { centre, .. } => place(figure, dimension, centre),
                Arm::Driving { place } => place,
            };
            match arms.len() {
                2 => {
                    let side = cross(sub(c(1), c(0)), sub(p, c(0)))[2];
                    (gamma_two(p, c(0), c(1)), side)
                }
                _ => {
                    let normal = cross(sub(c(1), c(0)), sub(c(2), c(0)));
                    (gamma_three(p, c(0), c(1), c(2)), dot(normal, sub(p, c(0))))
                }
            }
        };
        let (here, side) = seen(self.figure);
        let Some(ahead) = self.ahead else { return here };
        let (there, other_side) = seen(ahead);
        // An interSS has no sides: around the line of its centres there is room.
        let passed = arms.len() == arity && side * other_side < 0.0;
        if passed { 0.0 } else { here.min(there) }
    }
}

/// The place of a point in a figure, third coordinate zero in the plane.
pub(super) fn place(figure: &[f64], dimension: usize, point: usize) -> V3 {
    let at = &figure[point * dimension..][..dimension];
    [at[0], at[1], if dimension == 3 { at[2] } else { 0.0 }]
}

impl Plan {
    /// Algorithm 2: replaces instructions near a boundary configuration, moves reference points,
    /// restores original instructions where they are good again. Returns whether anything changed.
    ///
    /// The figure stays what it is: afterwards γ > alpha holds at the current figure.
    pub fn change(&mut self, at: &Situation) -> bool {
        let dimension = self.dimension;
        self.instructions
            .iter_mut()
            .fold(false, |changed, instruction| {
                (0..instruction.elementary()).fold(changed, |changed, k| {
                    instruction.change(dimension, k, at) | changed
                })
            })
    }

    /// Whether an original instruction could come back (RR 8705, Algorithm 2, line 15).
    pub fn restorable(&self, at: &Situation) -> bool {
        self.instructions.iter().any(|i| {
            (0..i.elementary())
                .any(|k| i.original[k].is_some_and(|arm| i.restores(self.dimension, k, arm, at)))
        })
    }

    /// Gives every driving parameter the reference point that suits the figure best.
    pub fn place_references(&mut self, figure: &[f64]) {
        for instruction in &mut self.instructions {
            for k in 0..instruction.elementary() {
                if instruction.arms[k + 1].is_driving() {
                    instruction.shift(self.dimension, k, figure);
                }
            }
        }
    }
}

impl Instruction {
    /// One turn of the loop of Algorithm 2, for elementary instruction `k`.
    fn change(&mut self, dimension: usize, k: usize, at: &Situation) -> bool {
        let driven = k + 1;
        let mut changed = false;
        if let Some(original) = self.original[k] {
            let out_of_order = k == 0 && at.length(&self.arms[0]) < at.length(&original);
            if self.restores(dimension, k, original, at) {
                self.arms[driven] = original;
                self.original[k] = None;
                return true;
            }
            if !out_of_order {
                if at.gamma(dimension, (self.point, self.arity), &self.arms[..k + 2]) <= at.alpha {
                    self.shift(dimension, k, at.figure);
                    return true;
                }
                return false;
            }
            // Condition (sc1): restored, and at once replaced the other way round.
            self.arms[driven] = original;
            self.original[k] = None;
            changed = true;
        }
        if at.gamma(dimension, (self.point, self.arity), &self.arms[..k + 2]) > at.alpha {
            return changed;
        }
        if !self.arms[driven].is_driving() {
            if k == 0 && at.length(&self.arms[0]) < at.length(&self.arms[1]) {
                self.arms.swap(0, 1);
            }
            self.original[k] = Some(self.arms[driven]);
        }
        self.shift(dimension, k, at.figure);
        true
    }

    fn restores(&self, dimension: usize, k: usize, original: Arm, at: &Situation) -> bool {
        let mut arms = self.arms;
        arms[k + 1] = original;
        // What comes after must stay good as well: interCS depends on the circle.
        let good =
            |n: usize| at.gamma(dimension, (self.point, self.arity), &arms[..n]) > at.restore;
        (k + 2..=self.arity).all(good)
    }

    /// Makes arm `k + 1` a driving one with a well placed reference point.
    fn shift(&mut self, dimension: usize, k: usize, figure: &[f64]) {
        let p = place(figure, dimension, self.point);
        let centre = |arm: &Arm| match arm {
            Arm::Edge { centre, .. } => place(figure, dimension, *centre),
            Arm::Driving { place } => *place,
        };
        let c: [V3; 3] = array(|j| {
            if j < self.arity {
                centre(&self.arms[j])
            } else {
                [0.0; 3]
            }
        });
        let place = match (self.arity, k) {
            (2, _) => shift_in_plane(p, c[0], c[1]),
            (_, 0) => shift_in_space(p, c[0], c[2]),
            _ => shift_from_circle(p, c[0], c[1]),
        };
        self.arms[k + 1] = Arm::Driving { place };
    }
}
