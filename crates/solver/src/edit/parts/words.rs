//! What people are told of a sketch and its parts, in its own names.

use super::Parts;
use super::contacts::Kept;
use crate::blocks::{Account, Verdict};
use crate::constraint::order_of_kind;
use crate::edit::session::Decomposition;
use crate::interval::point;
use crate::order::InOrder;
use crate::problem::{Constraint, Item, Problem, Shape};
use std::collections::BTreeSet;

impl Parts {
    /// What a claim is proved of, with what is known of each row that was left out, by place.
    pub(super) fn account_of(&self, verdict: impl Fn(usize) -> Verdict) -> Account {
        let singular = self.cut.singular.as_ref();
        let value = |u: usize| self.figure.enclosure(u) * point(self.cut.unit_of(u));
        Account {
            added: self.contacts.iter().map(Kept::equation).collect(),
            drawing: singular.filter(|s| s.moved.is_some()).map(|s| s.in_words()),
            ..self.cut.account(value, verdict)
        }
    }

    /// How the equations fall apart.
    pub fn decomposition(&self) -> Decomposition {
        let blocks = self.cut.blocks.blocks.iter().zip(&self.cut.is_exact);
        Decomposition {
            merged: self.cut.system.merged,
            unknowns: self.cut.system.unknowns.len(),
            blocks: blocks
                .filter(|(_, exact)| !**exact)
                .map(|(block, _)| self.cut.unknowns_of(block))
                .collect(),
            account: Account {
                drawing: None,
                ..self.account_of(|k| match self.proved[k] {
                    true => Verdict::Follows,
                    false => Verdict::NotLookedAt,
                })
            },
            singular: self.cut.singular.clone(),
        }
    }

    /// The sketch as a problem with as many equations as unknowns: what nothing determines is held by constraints on its
    /// coordinates, and what follows from others at the figure is left out. It bends by default.
    pub fn completed(&self) -> Result<Problem, String> {
        let mut problem = self.cut.problem.clone();
        let head = problem.distances.len();
        let out: BTreeSet<usize> = self
            .cut
            .redundant
            .iter()
            .filter_map(|&row| self.cut.owner(row).index(&problem))
            .collect();
        let labels = std::mem::take(&mut problem.labels);
        let label = |index: usize| labels.get(&index).cloned();
        let distances = problem.distances.drain(..).enumerate();
        let distances: Vec<_> = distances
            .filter(|(index, _)| !out.contains(index))
            .map(|(index, distance)| (distance, label(index)))
            .collect();
        let constraints = problem.constraints.drain(..).enumerate();
        let mut constraints: Vec<_> = constraints
            .filter(|(c, _)| !out.contains(&(head + c)))
            .map(|(c, constraint)| (constraint, label(head + c)))
            .collect();
        let d = problem.dimension;
        for &u in &self.cut.free {
            let place = self.cut.system.coordinates.iter().position(|&c| c == u);
            let round = self.cut.numbers.iter().position(|&r| r == Some(u));
            let (kind, item, value) = match (place, round) {
                (Some(place), _) => {
                    let (p, axis) = (place / d, place % d);
                    let at = problem.points[p].sketch[axis].clone();
                    (["x", "y", "z"][axis], Item::Point(p), at)
                }
                (None, Some(o)) => match &problem.objects[o].shape {
                    Shape::Round { radius, .. } => ("radii", Item::Object(o), radius.clone()),
                    Shape::Number { sketch, .. } => ("values", Item::Object(o), sketch.clone()),
                    _ => unreachable!("only circles and numbers have a number of their own"),
                },
                _ => return Err(format!("{} is free", self.cut.system.unknowns[u].name)),
            };
            let held = Constraint {
                kind: kind.to_owned(),
                items: vec![item],
                value: Some(value),
                formula: None,
            };
            constraints.push((held, None));
        }
        constraints.order_by_key(|(c, _)| order_of_kind(&c.kind));
        let named = distances
            .iter()
            .map(|d| &d.1)
            .chain(constraints.iter().map(|c| &c.1));
        let named = named.enumerate();
        problem.labels = named
            .filter_map(|(k, label)| Some((k, label.clone()?)))
            .collect();
        problem.distances = distances.into_iter().map(|d| d.0).collect();
        problem.constraints = constraints.into_iter().map(|c| c.0).collect();
        problem.bend_by_default();
        problem.check().map_err(|error| error.to_string())?;
        Ok(problem)
    }
}
