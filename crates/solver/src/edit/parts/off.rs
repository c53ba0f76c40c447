//! Away from singular drawings, and from figures that are singular.

use super::Parts;
use crate::blocks::Singular;
use crate::edit::ending::{Dimension, Edited, Keep};
use crate::edit::setting::Setting;
use crate::edit::way::Way as _;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::track::{Control, Stop, StopKind};
use std::time::Instant;

/// Ways to move a singular drawing that are tried, two and two in opposite directions.
const WAYS: u64 = 6;

impl Parts {
    /// What was singular about the drawing.
    pub fn singular(&self) -> Option<&Singular> {
        self.cut.singular.as_ref()
    }

    /// Whether the figure that was drawn is singular itself, so that it was not moved.
    pub(super) fn is_singular_figure(&self) -> bool {
        self.cut
            .singular
            .as_ref()
            .is_some_and(|s| s.moved.is_none())
    }

    /// At a singular figure nothing is said of which constraint contradicts others, and with contacts that are kept nothing of others.
    pub(super) fn sober(&self, stop: Stop) -> Stop {
        match &self.cut.singular {
            Some(singular) if stop.kind == StopKind::Contradiction => Stop::new(
                stop.kind,
                format!(
                    "{}, and from there no figure was found that meets all of them; which of them is one too many, if any, is not \
                     certain (`krawl all` looks for all figures)",
                    singular.place_in_words()
                ),
            ),
            None if stop.kind == StopKind::Contradiction && !self.contacts.is_empty() => {
                let kept = self.contacts.iter().map(|contact| contact.equation());
                let kept: Vec<String> = kept.collect();
                let words = format!(
                    "the contact cannot be kept: with what was added, {}, {stop}; the problem without it is singular here, and may \
                     have figures there",
                    kept.join(", and ")
                );
                Stop::new(stop.kind, words)
            }
            _ => stop,
        }
    }

    /// Whether the figure is singular itself, or would be without what was added for contacts.
    pub(super) fn is_singular(&self) -> bool {
        self.is_singular_figure() || self.plain.is_some()
    }

    /// The drawing, moved off where it is singular in another way than the first, and led to its dimensions.
    pub(super) fn lead_otherwise(&self, problem: &Problem, control: &mut Control) -> Option<Self> {
        self.cut.singular.as_ref()?.moved?;
        (1..WAYS).find_map(|way| {
            let (mut parts, rights) = Self::assemble_in(problem, &self.options, way).ok()?;
            parts.lead(&rights, control).ok()?;
            parts.find_other(problem, way, control);
            Some(parts)
        })
    }

    /// Notes the figure to which the drawing leads where it is moved off in the direction opposite to `way`.
    pub(super) fn find_other(&mut self, problem: &Problem, way: u64, control: &mut Control) {
        if self.is_singular_figure() {
            return;
        }
        let Ok((mut twin, rights)) = Self::assemble_in(problem, &self.options, way ^ 1) else {
            return;
        };
        if twin.lead(&rights, control).is_err() {
            return;
        }
        let (own, others) = (self.points(), twin.points());
        let pairs = self.cut.problem.points.iter().zip(own.iter().zip(&others));
        let elsewhere = pairs.filter(|(_, (a, b))| (0..3).any(|k| a[k].disjoint(b[k])));
        let other = elsewhere.map(|(point, (_, b))| (point.name.clone(), b.each(|x| x.mid())));
        let other = other.collect();
        if let Some(singular) = &mut self.cut.singular {
            singular.other = other;
        }
    }

    /// From a figure that is singular itself no continuation is the one: its points are moved off that place, and led to the
    /// new dimensions from there. `None` if that leads nowhere.
    pub(super) fn moved_off(
        &mut self,
        settings: &[Setting],
        keep: Keep,
        control: &mut Control,
    ) -> Option<Edited> {
        let clock = Instant::now();
        let changed = Setting::applied(settings, self.problem());
        let parts = Self::open(&changed, &self.options, control).ok()?;
        parts.cut.singular.as_ref()?.moved?;
        let dimensions = settings.iter().map(|setting| Dimension {
            index: setting.index,
            from: self.length(setting.index),
            to: setting.value(),
            value: setting.value(),
        });
        let edited = Edited {
            dimensions: dimensions.collect(),
            tubes: parts.moved.tubes,
            switched_on: Vec::new(),
            singular: parts.cut.singular.clone(),
            seconds: clock.elapsed().as_secs_f64(),
            ..parts.standing_still()
        };
        if keep.is_taken(&edited) {
            *self = parts;
        }
        Some(edited)
    }
}
