//! What `krawl sweep` writes.

use super::{Answer, At, Bounds, Dimension, Document, Drawing, Objects, Points, Verb};
use super::{all, bounds, points};
use crate::blocks::Account;
use crate::edit::{Frame, Moved, Sweep as Found};
use crate::problem::Problem;
use crate::report::sweep::{obstacle, sweep_in_words};

keys! {
    /// A mechanism that was driven through a range of a dimension.
    Sweep(problem: &Problem, index: usize, sweep: &Found) {
        /// `reached`, or how the edit ended that it did not get over.
        status: String = obstacle(sweep).map_or("reached", |edited| edited.ending.name()).into(),
        /// What is proved.
        words: String = sweep_in_words(problem, index, sweep),
        /// The figures on the way.
        frames: Vec<SweepFrame> = all(&sweep.frames, |frame| SweepFrame::new(problem, frame)),
        /// Of what that is proved.
        account: Account = sweep.account.clone(),
        /// The edit that it did not get over.
        end: Option<Answer> = obstacle(sweep).map(|edited| Answer::new(problem, edited, Moved::default())),
    }
}

keys! {
    /// A figure on the way.
    SweepFrame(problem: &Problem, frame: &Frame) {
        /// The dimension.
        value: Bounds = bounds(&frame.value),
        /// The points.
        points: Points<Bounds> = points(problem, &frame.points),
    } or nothing {
        /// Bodies with joints, and joints.
        joints: Objects<Bounds> = At::joints(problem, &frame.objects, bounds),
    }
}

impl Document {
    /// What came of a sweep of the dimension with this number.
    pub fn sweep(problem: &Problem, index: usize, sweep: &Found) -> Document {
        let drawing = Drawing {
            dimension: Dimension::Driven(problem.dimension_name(index)),
            ..Drawing::new("sweep", problem)
        };
        Document::of(drawing, Verb::Sweep(Sweep::new(problem, index, sweep)))
    }
}
