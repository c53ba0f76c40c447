//! Choosing among the distances that a point could be constructed with.

use super::boundary::{gamma_three, gamma_two};
use super::change::place;
use super::derive::Graph;
use super::{Arm, Instruction, Plan};
use crate::places::Each as _;
use crate::system::Homotopy;

/// Shorter arms are taken where they are this far from a boundary configuration in the sketch.
const CLEAR: f64 = 0.2;

/// Other arms are taken too where they make the product of the removed constraints' lengths larger by this factor.
const LONGER: f64 = 2.0;

/// Some arms for a point, and their γ in the sketch.
struct Choice {
    gamma: f64,
    arms: Vec<(usize, usize)>,
}

/// The construction of a point with arms along some distances; driving parameters are the rest.
fn instruction(point: usize, arity: usize, distances: &[(usize, usize)]) -> Instruction {
    let mut arms = [Arm::Driving { place: [0.0; 3] }; 3];
    for (arm, &(centre, edge)) in arms[..arity].iter_mut().zip(distances) {
        *arm = Arm::Edge { centre, edge };
    }
    Instruction {
        point,
        arity,
        arms,
        original: [None; 2],
    }
}

impl Graph {
    /// The plan that constructs the points in this order, with those arms that are farthest from
    /// a boundary configuration in the sketch.
    pub(super) fn plan(&self, homotopy: &Homotopy, order: &[usize]) -> Plan {
        let instructions = self
            .placed(order)
            .into_iter()
            .map(|(point, arity, earlier)| {
                let choices = self.choices(homotopy, point, arity, &earlier);
                match choices.reduce(Choice::clearer) {
                    Some(best) => instruction(point, arity, &best.arms),
                    None => instruction(point, arity, &earlier),
                }
            });
        let mut plan = Plan {
            dimension: homotopy.dimension,
            points: homotopy.points,
            edges: self.lengths.len(),
            instructions: instructions.collect(),
        };
        plan.place_references(&homotopy.sketch);
        plan
    }

    /// Another plan with as many driving parameters, if the removed constraints are longer in it.
    ///
    /// A point that is held by a long bar from far away follows it, off the path, and not the
    /// body that it belongs to; all that is built on it is then turned by as much as the body is
    /// long. With several such bars in a row these factors multiply, and corrections in the
    /// driving parameters converge nowhere but next to the path. So each point is constructed
    /// from the latest that there are, and the longest bars are left over.
    pub(super) fn with_shorter_arms(
        &self,
        homotopy: &Homotopy,
        order: &[usize],
        plan: Plan,
    ) -> Plan {
        let length = |edge: usize| self.lengths[edge];
        let product = |plan: &Plan| -> f64 {
            plan.removed()
                .into_iter()
                .map(|edge| length(edge).ln())
                .sum()
        };
        let order = self.latest_first(order);
        let mut other = self.plan(homotopy, &order);
        for (k, (point, arity, earlier)) in self.placed(&order).into_iter().enumerate() {
            if earlier.len() <= arity {
                continue;
            }
            let sum = |choice: &Choice| {
                choice
                    .arms
                    .iter()
                    .map(|&(_, edge)| length(edge))
                    .sum::<f64>()
            };
            let shortest = self
                .choices(homotopy, point, arity, &earlier)
                .filter(|choice| choice.gamma > CLEAR)
                .min_by(|a, b| sum(a).total_cmp(&sum(b)));
            if let Some(shortest) = shortest {
                other.instructions[k] = instruction(point, arity, &shortest.arms);
            }
        }
        if product(&other) > product(&plan) + LONGER.ln() {
            other
        } else {
            plan
        }
    }

    /// The choices of arms for a point among its earlier neighbours, where it has any: each set
    /// once, in the order with the largest γ in the sketch.
    fn choices<'a>(
        &'a self,
        homotopy: &'a Homotopy,
        point: usize,
        arity: usize,
        earlier: &'a [(usize, usize)],
    ) -> Box<dyn Iterator<Item = Choice> + 'a> {
        let at = |p: usize| place(&homotopy.sketch, self.dimension, p);
        let p = at(point);
        let choice = move |arms: &[(usize, usize)]| {
            let c = |k: usize| at(arms[k].0);
            let mut gamma = gamma_two(p, c(0), c(1));
            if arms.len() == 3 {
                gamma = gamma.min(gamma_three(p, c(0), c(1), c(2)));
            }
            let arms = arms.to_vec();
            Choice { gamma, arms }
        };
        let count = earlier.len();
        if arity < 2 {
            return Box::new(std::iter::empty());
        }
        let pairs = (0..count).flat_map(move |i| (i + 1..count).map(move |j| (i, j)));
        if arity == 2 || count == 2 {
            let choices = pairs.map(move |(i, j)| choice(&[earlier[i], earlier[j]]));
            return Box::new(choices.filter(Choice::is_a_place));
        }
        let triples = pairs.flat_map(move |(i, j)| (j + 1..count).map(move |k| [i, j, k]));
        Box::new(triples.filter_map(move |indices| {
            let [a, b, c] = indices.each(|i| earlier[i]);
            [[a, b, c], [a, c, b], [b, c, a]]
                .iter()
                .map(|arms| choice(arms))
                .filter(Choice::is_a_place)
                .reduce(Choice::clearer)
        }))
    }
}

impl Choice {
    /// Coinciding centres have no γ.
    fn is_a_place(&self) -> bool {
        !self.gamma.is_nan()
    }

    /// The one with the larger γ; of two with the same, the first.
    fn clearer(self, other: Choice) -> Choice {
        if other.gamma > self.gamma {
            other
        } else {
            self
        }
    }
}
