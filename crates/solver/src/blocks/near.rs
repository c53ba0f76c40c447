//! A place near a drawing at which constraints can be compared: a figure that meets them, or as many as can be.

use super::choose::PIVOT;
use super::drawn::{CLEAR, Circuits, Drawn, Floats, MANY, MET, SEEDS, look, moved};

/// Of more unknowns less is tried.
pub(super) const LARGE: usize = 100;

/// What a place is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    /// A figure that meets all rows.
    Figure,
    /// It meets those that are independent there. `is_one`: it continues the drawing, and no other does.
    Most { is_one: bool },
    /// The drawing, too large for figures near it to be looked for.
    Large,
    /// The drawing: no figure was found near it. `is_regular`: places near it that meet what is no dimension are as singular.
    Drawing { is_regular: bool },
}

/// A place near a drawing.
pub(super) struct Near {
    pub at: Vec<f64>,
    pub what: What,
    /// The rows that say something new there, and of which others are combinations there.
    pub independent: Vec<usize>,
    pub circuits: Circuits,
}

impl Near {
    fn of(floats: &Floats, order: &[usize], at: Vec<f64>, what: What) -> Self {
        let (independent, circuits) = floats.independent(order, &at, PIVOT);
        Near {
            at,
            what,
            independent,
            circuits,
        }
    }

    /// The place for a drawing. Rows are in an order in which the first are kept the rather; `structural`: for each whether it is
    /// no dimension.
    pub fn new(floats: &Floats, order: &[usize], structural: &[bool], drawn: Vec<f64>) -> Self {
        let place = |at: Vec<f64>, what: What| Near::of(floats, order, at, what);
        if drawn.len() > MANY {
            let is_met = !order.is_empty() && floats.missed(order, &drawn) < MET;
            let near = place(drawn, What::Large);
            // What depends on each other there need not at figures near it.
            return match is_met && near.circuits.is_empty() {
                true => Near {
                    what: What::Figure,
                    ..near
                },
                false => near,
            };
        }
        let full = order.len().min(drawn.len());
        // That of the greatest rank: what depends on each other at a figure that is singular by chance does not at others.
        let mut found: Option<(Vec<f64>, usize)> = None;
        let ways = if drawn.len() > LARGE { 2 } else { 2 * SEEDS };
        for way in 0..=ways {
            // First where it is drawn.
            let all = if way == 0 { 0 } else { drawn.len() };
            let Some(at) = floats.figure(order, moved(&drawn, 0..all, way)) else {
                continue;
            };
            let rank = floats.independent(order, &at, CLEAR).0.len();
            if found.as_ref().is_none_or(|(_, most)| rank > *most) {
                found = Some((at, rank));
            }
            if rank == full {
                break;
            }
        }
        if let Some((at, _)) = found {
            return place(at, What::Figure);
        }
        let choice = floats.choice(&drawn);
        let (from, is_one) = match look(floats, structural, (&drawn, &choice), 0) {
            Drawn::Regular => (drawn, true),
            // Either of several figures continues it, and one says nothing of another.
            Drawn::Singular { off: Some(off), .. } => (off, false),
            Drawn::Singular { off: None, .. } => {
                return place(drawn, What::Drawing { is_regular: false });
            }
        };
        let most = floats.independent(order, &from, PIVOT).0;
        let Some(at) = floats.meet(&most, from.clone()) else {
            return place(from, What::Drawing { is_regular: true });
        };
        // Those that are met come first, so that others are compared with these alone.
        let (met, missed): (Vec<usize>, Vec<usize>) =
            order.iter().partition(|&&row| !floats.misses(row, &at));
        let mut near = Near::of(
            floats,
            &[met.clone(), missed].concat(),
            at,
            What::Most { is_one },
        );
        near.independent.retain(|row| met.contains(row));
        near.circuits
            .retain(|(_, of)| of.iter().all(|(row, _)| met.contains(row)));
        near
    }
}
