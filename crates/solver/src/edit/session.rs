//! A figure and the edits of it.

use super::drag::Drag;
use super::ending::{Edited, Ending, Keep, Orientations};
use super::open::{Moved, OpenError};
use super::parts::{Extreme, Parts};
use super::segments::kept_apart_in_words;
use super::setting::Setting;
use super::way::Way;
use super::whole::Whole;
use crate::blocks::{Account, Singular};
use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::Located;
use crate::track::{Control, Options, StartError};

/// A figure that meets its dimensions, and what follows edits of it; set up once for all of them.
///
/// Figures up to motions are followed as a whole. A problem in its own frame ([`Problem::is_absolute`]) is followed part by
/// part ([`crate::blocks`]), and need not have as many equations as unknowns: what nothing determines stays put.
#[derive(Debug)]
pub struct Session {
    way: Box<dyn Way>,
}

impl Clone for Session {
    fn clone(&self) -> Self {
        Session {
            way: self.way.copy(),
        }
    }
}

impl Session {
    /// Takes the sketch of a checked problem for the figure, after leading it to the dimensions if it
    /// does not meet them exactly: along a path that is proved as edits are, with all lengths in proportion to t.
    ///
    /// # Errors
    /// If there is no such path, or the problem is too large for proofs.
    pub fn open(problem: &Problem) -> Result<Self, OpenError> {
        Self::open_with(problem, &Options::certified(), &mut Control::default())
    }

    /// Takes the sketch of a checked problem for the figure, led to its dimensions as in [`Session::open`], with
    /// options of one's own, of which space, the longest step, the radius of tubes, α, extended precision and the
    /// limit of steps matter.
    ///
    /// The space is the full one for small problems and otherwise the reduced one, with the full one where that
    /// stops, unless `options` have the reduced one. Problems with more than distances are followed in the full one.
    ///
    /// Where `control` has a witness the figure is followed as a whole, in the full space, whatever its frame: a certificate is
    /// of all of it. Its problem then has to have as many equations as unknowns; [`completed`] makes it so.
    pub fn open_with(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let is_followed_in_parts = problem.is_absolute() && control.witness.is_none();
        if let (true, Err(error)) = (
            problem.is_absolute() && !is_followed_in_parts,
            problem.check(),
        ) {
            let what = format!(
                "a certificate is of a figure with as many equations as unknowns ({error}); `krawl::edit::completed` makes \
                 a problem so"
            );
            return Err(StartError::Unsupported(what).into());
        }
        let way: Box<dyn Way> = match is_followed_in_parts {
            true => Box::new(Parts::open(problem, options, control)?),
            false => Box::new(Whole::open_with(problem, options, control)?),
        };
        Ok(Session { way })
    }

    /// The same of a sketch of which points are to be dragged ([`Session::drag`]): it is followed part by part, wherever it is.
    ///
    /// # Errors
    /// As [`Session::open`].
    pub fn open_to_drag(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let way = Box::new(Parts::open(problem, options, control)?);
        Ok(Session { way })
    }

    /// Whether points can be dragged: the session was opened to do so, or its sketch is in its own frame.
    pub fn can_drag(&self) -> bool {
        self.way.parts().is_some()
    }

    /// Drags points to where they are wanted, all dimensions staying what they are, or as near to that as a figure is found; the rest moves
    /// little. The way is proved as those of edits are: the coordinates that nothing determines are led, on each leg straight to where they are
    /// in the end of it. The session's figure is then the one that was come to.
    ///
    /// # Panics
    /// If the session cannot be dragged in ([`Session::can_drag`]), or a point is none of the problem's.
    pub fn drag(&mut self, drags: &[Drag], control: &mut Control) -> Edited {
        self.way.drag(drags, control)
    }

    /// The problem with the dimensions as they are now. Its sketch is the one that was given.
    pub fn problem(&self) -> &Problem {
        self.way.problem()
    }

    /// How far the sketch was from the first figure.
    pub fn moved(&self) -> Moved {
        self.way.moved()
    }

    /// What a dimension is now, by its index in [`Setting`]: an enclosure, in the unit of the problem or in degrees.
    pub fn length(&self, index: usize) -> Interval {
        self.way.length(index)
    }

    /// The figure, in the coordinates of the problem: a box that holds exactly one with these dimensions. Where
    /// constraints say where the figure is it is there. Otherwise the
    /// first point stays where the sketch has it, the next one that is elsewhere stays on its ray from there, and
    /// in space the next one off that line stays on its side of their plane.
    pub fn points(&self) -> Vec<[Interval; 3]> {
        self.way.points()
    }

    /// The figure in floats, in the coordinates of the problem: the middle of each box of [`Session::points`].
    pub fn figure(&self) -> Vec<[f64; 3]> {
        let points = self.points();
        points.iter().map(|p| p.each(|x| x.mid())).collect()
    }

    /// Where the problem's objects are: enclosures, in the unit of the problem.
    pub fn objects(&self) -> Vec<Located> {
        self.way.objects_of(self.way.figure())
    }

    /// What is proved of the figure as it is now: how many equations were used, which constraints were left out and how the
    /// figure stands to them, which coordinates are held where they are. Of an edit see [`Edited::account`].
    pub fn account(&self) -> Account {
        self.way.account()
    }

    /// Where the drawing of a problem in its own frame was singular, though figures near it are not: what was so about it, and how
    /// far it was moved off that place before it was led to its dimensions.
    pub fn singular(&self) -> Option<&Singular> {
        self.way.parts()?.singular()
    }

    /// Which edges of closed outlines are kept apart in all that the session does, in words, where that was asked for
    /// ([`Options::simple`]).
    pub fn outlines_in_words(&self) -> Option<String> {
        let pairs = self.way.segments().iter().filter(|s| s.other.is_some());
        let others = self.way.outlines()?;
        Some(kept_apart_in_words(self.problem(), pairs.count(), others))
    }

    /// How the equations fall apart, if they are followed part by part.
    pub fn decomposition(&self) -> Option<Decomposition> {
        self.way.parts().map(Parts::decomposition)
    }

    /// Changes dimensions. The session's figure is then the one that was reached; it stays what it is if the
    /// new dimensions were not reached.
    ///
    /// Where a dimension is set twice, the last setting counts.
    ///
    /// # Panics
    /// If a setting is about a dimension that the problem does not have.
    pub fn edit(&mut self, settings: &[Setting]) -> Edited {
        self.edit_with(settings, &mut Control::default())
    }

    /// Changes dimensions as [`Session::edit`] does, with the hooks of `control`.
    pub fn edit_with(&mut self, settings: &[Setting], control: &mut Control) -> Edited {
        let edited = self.way.edit(settings, Keep::Always, control);
        let edited = self.looked_at(edited, false);
        self.with_figure_there(edited, settings, control)
    }

    /// An edit that ended where an edge vanishes or two come to touch, with the figure shortly before, as near as one is proved.
    fn with_figure_there(
        &mut self,
        mut edited: Edited,
        settings: &[Setting],
        control: &mut Control,
    ) -> Edited {
        // By so much of the way: what vanishes is told in narrow tubes, and has to be told again.
        const BEFORE: [f64; 3] = [1e-12, 1e-9, 1e-6];
        if !edited.ending.is_at_an_edge() {
            return edited;
        }
        let there = BEFORE.iter().find_map(|before| {
            let t = Some(edited.t.0 - before).filter(|t| *t > 0.0)?;
            let short = settings.iter().map(|s| s.before(self.problem(), t));
            let short: Vec<Setting> = short.collect::<Option<_>>()?;
            let there = self.follow_to(&short, Keep::Never, control);
            (there.ending == Ending::Reached && there.astray.is_none()).then_some(there)
        });
        if let Some(there) = there {
            (edited.points, edited.objects) = (there.points, there.objects);
            edited.account = there.account;
            edited.there = Some(there.dimensions.iter().map(|d| d.value).collect());
        }
        edited
    }

    /// An edit that goes on past figures that miss what was left out. It ends before them, unless it is reached: that figure meets all
    /// constraints, and what was on the way is said, or, `if_reached`, it ends before them too.
    fn looked_at(&self, mut edited: Edited, if_reached: bool) -> Edited {
        let is_told = match &edited.ending {
            Ending::Reached => !if_reached,
            ending => ending.is_contradiction(),
        };
        let Some(astray) = edited.astray.clone() else {
            return edited;
        };
        if is_told {
            edited.switched_on.push(astray.in_words());
            return edited;
        }
        for (dimension, value) in edited.dimensions.iter_mut().zip(astray.values) {
            dimension.value = value;
        }
        Edited {
            ending: Ending::Stopped(astray.stop),
            t: astray.t,
            points: self.points(),
            objects: self.objects(),
            orientations: Orientations::default(),
            account: astray.account,
            ..edited
        }
    }

    /// Changes dimensions by a path of figures and in no other way, as every claim of the one continuation needs it: [`Session::edit`] of a figure that is
    /// singular itself, which has none, goes to one that is near.
    pub fn lead(&mut self, settings: &[Setting], control: &mut Control) -> Edited {
        let edited = self.follow_to(settings, Keep::OnTheWay, control);
        self.looked_at(edited, true)
    }

    /// Changes dimensions by a path of figures, and where there is none, in no other way, unlike [`Session::edit`] at figures that are
    /// singular themselves: what is said of all values in between needs the path.
    pub(super) fn follow_to(
        &mut self,
        settings: &[Setting],
        keep: Keep,
        control: &mut Control,
    ) -> Edited {
        self.way.follow_to(settings, keep, control)
    }

    /// A figure near the end of a way on which one dimension was led as far as it goes with coordinates held, at which it goes furthest with
    /// nothing held, if one is proved.
    pub(super) fn extreme(&self, setting: &Setting, end: &[[Interval; 3]]) -> Option<Extreme> {
        self.way.parts()?.extreme(setting, end)
    }

    /// What [`Session::edit`] would come to; the figure stays what it is.
    pub fn probe(&mut self, settings: &[Setting], control: &mut Control) -> Edited {
        let edited = self.way.edit(settings, Keep::Never, control);
        let edited = self.looked_at(edited, false);
        self.with_figure_there(edited, settings, control)
    }
}

/// A problem in its own frame, which need not be well constrained, made so: coordinates that nothing determines are held
/// where the sketch has them, and constraints that seem to follow from others there are left out.
///
/// # Errors
/// If it cannot be made so, in words.
pub fn completed(problem: &Problem) -> Result<Problem, String> {
    Parts::assemble(problem, &Options::certified())?
        .0
        .completed()
}

/// How the equations of a sketch fall apart.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Decomposition {
    /// How many coordinates are one with others, by coincidences and the like.
    pub merged: usize,
    /// How many unknowns are left.
    pub unknowns: usize,
    /// The names of the unknowns of each block that has to be solved, in an order in which each needs only those before;
    /// single numbers that are known exactly once those before are come in none of them.
    pub blocks: Vec<Vec<String>>,
    /// What is held and left out. At the drawing, which is no figure: nothing is said of what was left out but whether it
    /// follows from the others.
    pub account: Account,
    /// See [`Session::singular`].
    pub singular: Option<Singular>,
}

/// What becomes of a sketch's constraints where it is led to its dimensions, which may be too many.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Standing {
    /// Whether [`Session::open`] takes the sketch.
    pub is_taken: bool,
    /// What is said of those that were left out.
    pub too_many: TooMany,
}

/// What is said of constraints that were left out, as at the sketch they say nothing new.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TooMany {
    /// There are none.
    None,
    /// They are proved to follow from the others.
    Follow,
    /// One contradicts the others.
    Contradict {
        /// Its name.
        name: String,
        /// Whether that is proved of all figures. Otherwise it is so at the one to which the sketch leads.
        is_proved: bool,
    },
    /// Either may be.
    Undecided,
}

impl Decomposition {
    /// The same as [`Decomposition::of`], and what becomes of the constraints where the sketch is led to its dimensions, as
    /// edits begin. Longer paths than some thousand tubes are not followed.
    ///
    /// # Errors
    /// As there.
    pub fn led(problem: &Problem) -> Result<(Self, Standing), String> {
        const MOST_TUBES: usize = 3000;
        let options = Options {
            max_steps: MOST_TUBES,
            ..Options::certified()
        };
        let (mut parts, rights) = Parts::assemble(problem, &options)?;
        let found = parts.decomposition();
        let standing = parts.standing(&rights, &mut Control::default());
        Ok((found, standing))
    }

    /// How a problem in its own frame falls apart, as its sketch shows it; it need not be well constrained.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn of(problem: &Problem) -> Result<Self, String> {
        Ok(Parts::assemble(problem, &Options::certified())?
            .0
            .decomposition())
    }
}
