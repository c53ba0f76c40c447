//! What `krawl motion` writes.

use super::{Bounds, Document, Drawing, Points, Verb, all, bounds, names, points};
use crate::blocks::Account;
use crate::edit::WayEnd;
use crate::motion::{self, Measured};
use crate::problem::Problem;
use crate::report::motion::{end_in_words, motion_in_words};

keys! {
    /// A figure that moves.
    Motion(motion: &motion::Motion) {
        /// The dimensions set free.
        freed: Vec<String> = motion.freed.clone(),
        /// The two points whose distance was led along the way.
        driver: Vec<String> = names(&motion.problem, &motion.driver),
        /// `closed`, `open` or `stopped`.
        status: String = match (motion.is_loop(), motion.is_told()) {
            (true, _) => "closed".into(),
            (_, true) => "open".into(),
            _ => "stopped".into(),
        },
        /// What is proved.
        words: String = motion_in_words(motion),
        /// The points that stand still.
        standing: Vec<String> = names(&motion.problem, &motion.standing),
        /// How many tubes the proof has.
        tubes: usize = motion.tubes,
        /// How far the drawing was moved before.
        moved: f64 = motion.moved,
        /// Of what that is proved.
        account: Account = motion.account.clone(),
        /// The ends, each way.
        ends: Vec<MotionEnd> = all(&motion.ends, MotionEnd::new),
        /// What was measured all the way.
        measured: Vec<MotionMeasured> = all(&motion.measured, |measured| MotionMeasured::new(&motion.problem, measured)),
        /// Figures on the way.
        frames: Vec<MotionFrame> = all(&motion.frames, |frame| MotionFrame::new(&motion.problem, frame)),
    }
}

keys! {
    /// An end of a way.
    MotionEnd(end: &WayEnd) {
        /// For programs.
        kind: String = end.kind.into(),
        /// For people.
        words: String = end_in_words(end),
    }
}

keys! {
    /// What was measured.
    MotionMeasured(problem: &Problem, measured: &Measured) {
        /// What it is called.
        name: String = measured.name.clone(),
        /// In what it is measured.
        unit: String = measured.unit.into(),
        /// What it is in the file.
        first: Bounds = bounds(&measured.first),
    } or nothing {
        /// Where it is least.
        least: Option<Extreme> = match &measured.bounds {
            motion::Bounds::Between { least, .. } => Some(Extreme::new(problem, least)),
            _ => None,
        },
        /// Where it is greatest.
        greatest: Option<Extreme> = match &measured.bounds {
            motion::Bounds::Between { most, .. } => Some(Extreme::new(problem, most)),
            _ => None,
        },
        /// How often it turns.
        turns: Option<u64> = match &measured.bounds {
            motion::Bounds::AllTheWay(turns) => Some(*turns as u64),
            _ => None,
        },
    }
}

keys! {
    /// An extreme value of what was measured.
    Extreme(problem: &Problem, found: &motion::Extreme) {
        /// The value.
        value: Bounds = bounds(&found.value),
        /// How far on the way.
        at: f64 = found.at,
        /// The figure there.
        points: Points<Bounds> = points(problem, &found.points),
    }
}

keys! {
    /// A figure on the way.
    MotionFrame(problem: &Problem, frame: &motion::Frame) {
        /// How far on the way.
        at: f64 = frame.at,
        /// The figure.
        points: Points<Bounds> = points(problem, &frame.points),
    }
}

impl Document {
    /// What came of a motion.
    pub fn motion(motion: &motion::Motion) -> Document {
        let drawing = Drawing::new("motion", &motion.problem);
        Document::of(drawing, Verb::Motion(Motion::new(motion)))
    }
}
