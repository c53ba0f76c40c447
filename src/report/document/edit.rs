//! What `krawl edit` writes, and what it answers.

use super::{At, Bounds, Document, Drawing, JSON_VERSION, Named, Objects, Points, Verb};
use super::{all, bounds, middle, names, points, text};
use crate::blocks::Account;
use crate::edit::{self, Drag, Edited, Ending, Limit, Moved, Session};
use crate::import::{self, Follower};
use crate::interval::Interval;
use crate::problem::{Decimal, Problem};
use crate::report::edit::{edit_in_words, numbers_of};
use crate::report::supposed::signs_in_words;
use crate::track::Stop;

keys! {
    /// An edit.
    Edit(problem: &Problem, edited: &Edited, moved: Moved) {
        /// How it ended: `reached`, `limit`, `passes` or `stopped`.
        status: String = edited.ending.name().into(),
        /// What is proved.
        words: String = edit_in_words(problem, edited),
        /// Why it stopped.
        reason: Option<String> = stop(edited).map(|stop| stop.text.clone()),
        /// That for programs.
        stopped_kind: Option<String> = stop(edited).map(|stop| stop.kind.name().into()),
        /// How far on the way.
        t: Bounds = edited.t.into(),
        /// The dimensions that were led, by name.
        dimensions: Named<Bounds> = Named(all(&edited.dimensions, |d| {
            (problem.dimension_name(d.index), bounds(&d.value))
        })),
        /// The figure, in the coordinates of the problem.
        points: Points<Bounds> = points(problem, &edited.points),
        /// Joined points whose orientation is kept.
        kept: Vec<Vec<String>> = all(&edited.orientations.kept, |(set, _)| names(problem, set)),
        /// Those of which that is not proved.
        lost: Vec<Lost> = all(&edited.orientations.lost, |lost| Lost::new(problem, lost)),
        /// Those that have none.
        flat: Vec<Vec<String>> = all(&edited.orientations.flat, |set| names(problem, set)),
        /// What is special about a limit.
        limit: Option<AtLimit> = match &edited.ending {
            Ending::Limit(limit) => Some(AtLimit::new(problem, limit)),
            _ => None,
        },
        /// How far the sketch was led before.
        moved: f64 = moved.distance,
        /// The tubes of the proof.
        tubes: usize = edited.tubes,
        /// Tubes that were rejected.
        rejected: usize = edited.rejected,
        /// How long the path is.
        length: f64 = edited.length,
        /// How long it took.
        seconds: f64 = edited.seconds,
        /// What was switched on.
        switched_on: Vec<String> = edited.switched_on.clone(),
        /// Of what it is proved.
        account: Account = edited.account.clone(),
    } or nothing {
        /// How the figure stands to the signs that the problem asks for, in words, proved.
        signs: Option<String> = signs_in_words(problem, &edited.points),
        /// Where `points` are the figure shortly before an edge vanishes or two come to touch: the values of the dimensions there.
        points_at: Option<Named<Bounds>> = edited.there.as_ref().map(|values| Named(all(edited.dimensions.iter().zip(values), |(d, value)| {
            (problem.dimension_name(d.index), bounds(value))
        }))),
        /// What came of dragging.
        dragged: Option<Dragged> = edited.dragged.as_ref().map(|dragged| Dragged::new(problem, dragged)),
        /// The values of unknown numbers.
        unknowns: Named<f64> = numbers_of(problem, &edited.objects, true, middle),
        /// Bodies with joints, and joints.
        joints: Objects<f64> = At::joints(problem, &edited.objects, middle),
        /// The radii of circles, where the session's figure is the new one.
        radii: Option<Named<f64>> = None,
        /// Dimensions that are led with those set, by expressions of the file.
        followed: Vec<Followed> = Vec::new(),
        /// What is to be said of such expressions.
        warnings: Option<Vec<String>> = None,
        /// Whether a session has the figure from now on.
        committed: Option<bool> = None,
    }
}

keys! {
    /// An edit, where nothing is said of its problem but the name; `moved`: how far the sketch was from the old figure.
    Answer(problem: &Problem, edited: &Edited, moved: Moved) {
        /// Of the format.
        version: u32 = JSON_VERSION,
        /// The name of the problem.
        problem: String = problem.name.clone(),
        /// The edit.
        #[serde(flatten)]
        edit: Edit = Edit::new(problem, edited, moved),
    }
}

keys! {
    /// Joined points whose orientation is not proved to be kept.
    Lost(problem: &Problem, lost: &edit::Lost) {
        /// Their names.
        points: Vec<String> = names(problem, &lost.points),
        /// Where on the way it may be lost.
        t: Bounds = lost.t.into(),
    }
}

keys! {
    /// What is special about the figure at a limit.
    AtLimit(problem: &Problem, limit: &Limit) {
        /// Points that are on one line or in one plane.
        flat: Vec<Vec<String>> = all(&limit.flat, |set| names(problem, set)),
        /// Up to this.
        flat_within: f64 = limit.flat_within,
        /// How the points can move for an instant.
        motion: Points<f64> = Points::each(problem, &limit.motion, |x| *x),
    }
}

keys! {
    /// What came of dragging points.
    Dragged(problem: &Problem, dragged: &edit::Dragged) {
        /// The points by name.
        places: Named<DraggedTo> = Named(all(&dragged.places, |(drag, off)| {
            (problem.points[drag.point].name.clone(), DraggedTo::new(drag, off))
        })),
        /// Whether they are where they were wanted.
        is_there: bool = dragged.is_there,
        /// What was led.
        led: Vec<String> = dragged.led.clone(),
        /// In so many straight legs.
        legs: usize = dragged.legs,
        /// Why no way further was found.
        reason: Option<String> = dragged.stop.as_ref().map(|stop| stop.text.clone()),
    }
}

keys! {
    /// What came of a point that was dragged.
    DraggedTo(drag: &Drag, off: &Interval) {
        /// Where it was wanted.
        to: Vec<f64> = all(&drag.to, Decimal::to_f64),
        /// How far from there it is.
        off: Bounds = bounds(off),
    }
}

keys! {
    /// A dimension that an expression of the file computes.
    Followed(problem: &Problem, follower: &Follower) {
        /// Its name.
        dimension: String = problem.dimension_name(follower.index),
        /// Its value, in floats.
        value: f64 = follower.value.to_f64(),
        /// The expression.
        expression: String = follower.expression.clone(),
    }
}

keys! {
    /// The figure of a session and its dimensions.
    Standing(session: &Session) {
        /// The name of the problem.
        problem: String = session.problem().name.clone(),
        /// `figure`.
        status: String = "figure".into(),
        /// The dimensions by name.
        dimensions: Named<Bounds> = Named(all(session.problem().dimensions(), |index| {
            (session.problem().dimension_name(index), bounds(&session.length(index)))
        })),
        /// The points.
        points: Points<Bounds> = points(session.problem(), &session.points()),
        /// How far the sketch was led before.
        moved: f64 = session.moved().distance,
    }
}

/// Why an edit stopped, if it did.
fn stop(edited: &Edited) -> Option<&Stop> {
    match &edited.ending {
        Ending::Passes(stop) | Ending::Stopped(stop) => Some(stop),
        Ending::Reached | Ending::Limit(_) => None,
    }
}

impl Edit {
    /// Says what follows from dimensions that were set.
    pub fn follow(&mut self, problem: &Problem, followed: &import::Followed) {
        self.followed = all(&followed.set, |follower| Followed::new(problem, follower));
        self.warnings = Some(followed.warnings.clone());
    }
}

impl Answer {
    /// What came of an edit of a session.
    pub fn of(session: &Session, edited: &Edited) -> Self {
        Self::new(session.problem(), edited, session.moved())
    }

    /// It as one line of JSON.
    pub fn to_json(&self) -> String {
        text(self)
    }
}

impl Document {
    /// What came of an edit of a problem, with what the session knows besides, and what follows from what was set in the problem of the file.
    pub fn edit(
        problem: &Problem,
        edited: &Edited,
        session: &Session,
        (in_file, followed): (&Problem, &import::Followed),
    ) -> Document {
        let mut own = Edit::new(problem, edited, session.moved());
        // The session's figure is the new one where that was reached.
        if edited.ending == Ending::Reached {
            own.radii = Some(numbers_of(problem, &session.objects(), false, middle));
        }
        own.follow(in_file, followed);
        Document::of(Drawing::new("edit", problem), Verb::Edit(own))
    }
}
