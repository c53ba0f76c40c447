//! The check of covers of the space of coordinates: for every problem, whatever its constraints.
//!
//! The equations are those of the kernel with t = 1. A figure is a zero of them at which lengths and radii are positive and no vector vanishes that
//! must not. Every figure has an image under the problem's symmetries in the space that the cover begins with
//! ([`symmetry`]). A part's ranges are narrowed without losing any zero ([`space`]), parts are halved, and one that is left is within
//! the distance around a listed zero in which certificates' test for one figure proves that there is no other.

pub mod bounds;
mod format;
mod independent;
pub(crate) mod legs;
mod shared;
mod space;
pub mod sums;
mod symmetry;
mod turns;

pub use format::{
    Block, Body, Case, Change, CoordinateCover, Half, Image, Independent, Mark, Turned,
};
pub use independent::Slice;
pub use legs::Look;
pub use shared::Shared;
pub use space::{Empty, Part, ROUNDS};
pub use symmetry::{changes, signs_changed};
pub use turns::Turn;

use super::{CoverError, CoverStage, CoverVerdict, ENDED};
use crate::certificate::checker::equations::Equations;
use crate::certificate::checker::place::Place;
use crate::constraint::{self, Symmetry};
use crate::interval::{point, upper_half};
use crate::model::Margin;
use crate::problem::Problem;
use crate::system::{Held, Homotopy};
use independent::Apart;
use space::Rows;
use std::rc::Rc;
use sums::Sum;

/// How often parts of a slice are narrowed by what moves with what. (No zero is lost whatever this number is.)
const MOVED: usize = 4;

/// What a cover is about, with all that it says but its marks proved.
pub struct Space {
    eq: Equations,
    allowed: Symmetry,
    /// What figures have a sign of from the sketch, and the ranges in which unknowns are sought.
    held: Vec<Held>,
    rows: Rows,
    not_negative: Vec<usize>,
    blocks: Vec<Block>,
    /// For each block the sums of its equations that narrow parts.
    sums: Vec<Vec<Sum>>,
    bodies: Vec<turns::Body>,
    figures: Vec<Place>,
    images: Vec<Seen>,
    others: Vec<Place>,
    apart: Apart,
}

/// A zero that is a solution seen otherwise.
struct Seen {
    figure: usize,
    /// The unknowns with other signs.
    changes: Vec<bool>,
}

impl Space {
    /// Proves that the zeros listed exist, that the figures among them are figures and no two congruent, and the others none.
    pub fn new(problem: &Problem, cover: &CoordinateCover) -> Result<Space, String> {
        let unit = 2f64.powi(cover.unit_exponent.into());
        let homotopy = Homotopy::for_sets_in(problem, unit).map_err(|error| error.to_string())?;
        let eq = Equations::new(homotopy);
        let held = eq.homotopy.held(problem).map_err(|object| {
            let name = &problem.objects[object].name;
            format!("in which direction {name} is fixed is not certain")
        })?;
        let allowed = constraint::symmetry(problem);
        let not_negative = symmetry::not_negative(&eq.homotopy, (allowed, &held), &cover.halves)?;
        for block in &cover.blocks {
            let fits = |numbers: &[usize]| {
                let mut sorted = numbers.to_vec();
                sorted.sort_unstable();
                sorted.dedup();
                sorted.len() == numbers.len() && numbers.iter().all(|&i| i < eq.m)
            };
            let size = block.unknowns.len();
            let is_square = size > 0 && block.equations.len() == size;
            if !(is_square && fits(&block.equations) && fits(&block.unknowns)) {
                return Err("a block has not as many equations as unknowns".to_owned());
            }
        }
        let single = |&i: &usize| vec![[i, eq.m + 1]];
        let signed = held.iter().map(|held| &held.unknown);
        let signed = signed.chain(&not_negative);
        let conditions = eq.positive.iter().chain(signed).map(single);
        let conditions: Vec<_> = eq.nonzero.iter().cloned().chain(conditions).collect();
        let apart = Apart::new(&eq, &conditions, cover);
        let apart = apart.ok_or("the equations do not fall apart as is said")?;
        let bodies = cover.bodies.iter();
        let bodies = bodies.map(|body| turns::Body::new(problem, &eq, body));
        let mut space = Space {
            bodies: bodies.collect::<Result<_, _>>()?,
            allowed,
            held,
            rows: Rows::new(&eq),
            eq,
            not_negative,
            blocks: cover.blocks.clone(),
            sums: Vec::new(),
            figures: Vec::new(),
            images: Vec::new(),
            others: Vec::new(),
            apart,
        };
        let whole = space.whole();
        let sums = space.blocks.iter();
        space.sums = sums.map(|block| space.rows.sums(block, &whole)).collect();
        for (index, near) in cover.figures.iter().enumerate() {
            let number = index + 1;
            let place = space.zero(near).filter(|place| space.is_figure(place));
            let place = place.ok_or_else(|| format!("solution {number} is not proved to exist"))?;
            let known = space.figures.iter();
            let same = known
                .map(|known| space.are_different(known, &place))
                .position(|different| !different);
            if let Some(same) = same {
                let same = same + 1;
                return Err(format!("the solutions {same} and {number} may be the same"));
            }
            space.figures.push(place);
        }
        if !cover.cases.is_empty() && !space.apart.are_different(&space) {
            return Err("combinations of the solutions of parts may be the same".to_owned());
        }
        for image in &cover.images {
            space.see(image)?;
        }
        for (index, at) in cover.others.iter().enumerate() {
            let place = space.zero(at).filter(|place| space.is_none(place, at));
            let unproved = || {
                format!(
                    "zero {} of those that are called no figures may be one",
                    index + 1
                )
            };
            space.others.push(place.ok_or_else(unproved)?);
        }
        Ok(space)
    }

    /// The only zero near these numbers.
    fn zero(&self, near: &[f64]) -> Option<Place> {
        let test = |extended| Place::at_target(&self.eq, (near, extended), Vec::new());
        (near.len() == self.eq.m)
            .then(|| test(false).or_else(|_| test(true)).ok())
            .flatten()
    }

    /// Whether two solutions are surely neither the same nor congruent.
    fn are_different(&self, one: &Place, other: &Place) -> bool {
        let apart = |i: usize| one.spot.at(i).disjoint(other.spot.at(i));
        (0..self.eq.m).any(apart) && one.is_congruent(other, &self.eq) == Some(false)
    }

    /// Whether lengths and radii are positive at a zero, what is fixed has its sign, unknowns are in their ranges, and no vector vanishes that must not.
    fn is_figure(&self, place: &Place) -> bool {
        let at = |i: usize| match i < self.eq.m {
            true => place.spot.at(i),
            false => point(0.0),
        };
        let is_there = |vector: &Vec<[usize; 2]>| {
            let mut coordinates = vector.iter();
            coordinates.any(|&[i, j]| i != j && !(at(i) - at(j)).contains(0.0))
        };
        self.eq.positive.iter().all(|&i| at(i).inf() > 0.0)
            && self
                .held
                .iter()
                .all(|held| held.admits(at(held.unknown)) == Some(true))
            && self.eq.nonzero.iter().all(is_there)
    }

    /// Whether a zero is exactly at these numbers, and no figure.
    fn is_none(&self, place: &Place, numbers: &[f64]) -> bool {
        let exact: Vec<_> = numbers.iter().map(|&x| point(x)).collect();
        let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
        let vanishes = |vector: &Vec<[usize; 2]>| vector.iter().all(|&[i, j]| at(i) == at(j));
        let is_out = |held: &Held| held.admits(point(at(held.unknown))) == Some(false);
        let is_improper = self.eq.positive.iter().any(|&i| at(i) <= 0.0)
            || self.eq.nonzero.iter().any(vanishes)
            || self.held.iter().any(is_out);
        is_improper && place.covers(&exact) && self.rows.hold_exactly(&self.eq, numbers)
    }

    /// All of the space that has to be looked at: lengths and radii are positive in figures, what is fixed has its sign, and unknowns
    /// are in their ranges.
    pub fn whole(&self) -> Part {
        let positive = self.not_negative.iter().chain(&self.eq.positive);
        let held = self.held.iter().map(|held| (held.unknown, held.range));
        Part::whole(&self.eq, positive.map(|&i| (i, upper_half())).chain(held))
    }

    /// Narrows a part by the equations one by one.
    pub fn narrow(&self, part: &mut Part) -> Result<(), Empty> {
        for _ in 0..MOVED {
            self.apart.narrow(part, &self.figures)?;
            self.rows.narrow(part)?;
        }
        Ok(())
    }

    /// Where the equations fall apart, what is to be looked at one after the other.
    pub fn slices(&self) -> Vec<Slice> {
        self.apart.slices()
    }

    /// Looks at one of these from now on.
    pub fn look_at(&mut self, slice: Slice) {
        self.apart.slice = slice;
    }

    /// How many figures there are; `None` where that has no place in 64 bits.
    pub fn count(&self) -> Option<u64> {
        self.apart.count(self.figures.len())
    }

    /// Narrows a part by sums of two of a block's equations, by all of them together, and then one by one. A block that there is not does
    /// nothing.
    pub fn narrow_together(&self, block: usize, part: &mut Part) -> Result<(), Empty> {
        self.add_up(block, part)?;
        if let Some(block) = self.blocks.get(block) {
            self.rows.together(&self.eq, block, part)?;
        }
        self.narrow(part)
    }

    /// Bounds the unknowns of a block, also by sums of two of its equations, and then narrows the part by the equations one by one.
    pub fn bound(&self, block: usize, part: &mut Part) -> Result<(), Empty> {
        self.add_up(block, part)?;
        if let (Some(block), Some(sums)) = (self.blocks.get(block), self.sums.get(block)) {
            self.rows.bound((block, sums), part)?;
        }
        self.narrow(part)
    }

    /// Narrows a part by sums of two of a block's equations, and one by one.
    fn add_up(&self, block: usize, part: &mut Part) -> Result<(), Empty> {
        match (self.blocks.get(block), self.sums.get(block)) {
            (Some(block), Some(sums)) => self.rows.add_up((block, sums), part),
            _ => Ok(()),
        }
    }

    /// The part with an equation on each of its sides, if it has some.
    pub fn sides(&self, e: usize, part: &Part) -> Option<Vec<Part>> {
        let mut blocks = self.blocks.iter();
        let block = blocks.find(|block| block.equations.contains(&e))?;
        part.sides(&self.eq, block, e)
    }

    /// Puts what linear equations of a block say into the others, in exact numbers, and narrows the part by what comes of it. A block that there
    /// is not does nothing.
    pub fn reduce(&self, block: usize, part: &mut Part) -> Result<(), Empty> {
        if let Some(of) = self.blocks.get(block) {
            part.reduce(&self.eq, (block, of))?;
        }
        self.narrow(part)
    }

    /// Whether it is known in a part about where a body's legs stand, so that its rotations can be looked at.
    pub fn stands(&self, body: usize, part: &Part) -> bool {
        let body = self.bodies.get(body);
        body.is_some_and(|body| body.stands(part))
    }

    /// What a body's legs say of a box of rotations for the figures in a part. `None`: there is none.
    pub fn look(&self, body: usize, part: &Part, turn: &Turn) -> Option<Look> {
        self.bodies[body].look(part, turn)
    }

    /// The part with a body's points where a box of rotations allows. `None`: the linear equations do not tell the body's place.
    pub fn placed(&self, body: usize, part: &Part, look: &Look) -> Option<Result<Part, Empty>> {
        self.bodies[body].placed(&self.eq, part, look)
    }

    /// How large a coordinate of a body's place may be.
    pub fn reach(&self, body: usize) -> f64 {
        self.bodies[body].reach().sup()
    }

    /// The box of rotations with a coordinate of a body's place as one more range.
    pub fn with_height(&self, body: usize, turn: &Turn, axis: usize) -> Option<Turn> {
        turn.with_height(axis, self.bodies[body].reach())
    }

    /// The solution that a change of signs takes the zero in a part to, if it is one.
    pub fn image_in(&self, by: &Change, part: &Part) -> Option<Image> {
        let changes = changes(&self.eq.homotopy, (self.allowed, &self.held), by)?;
        let mut seen = Seen { figure: 0, changes };
        let figure = (0..self.figures.len()).find(|&figure| {
            seen.figure = figure;
            self.shows(&seen, part)
        })?;
        let by = by.clone();
        Some(Image { figure, by })
    }

    /// Adds a zero that is an image of a solution.
    pub fn see(&mut self, image: &Image) -> Result<(), String> {
        if image.figure >= self.figures.len() {
            return Err("an image is said to be of a solution that is not listed".to_owned());
        }
        let changes = changes(&self.eq.homotopy, (self.allowed, &self.held), &image.by);
        let unlike = || {
            format!(
                "what is called an image of solution {} is not so by a symmetry of the problem",
                image.figure + 1
            )
        };
        self.images.push(Seen {
            figure: image.figure,
            changes: changes.ok_or_else(unlike)?,
        });
        Ok(())
    }

    /// Whether all of a part lies so near to a solution that there is no other; of the base, in its unknowns.
    fn is_at(&self, figure: usize, part: &Part) -> bool {
        let place = self.figures.get(figure);
        let place = place.filter(|_| self.apart.takes(figure));
        place.is_some_and(|place| {
            // Solutions have more of the first unknowns in common than of the last ones.
            let mut ranges = part.ranges().iter().enumerate().rev();
            ranges.all(|(i, &x)| match self.apart.is_looked_at(i) {
                true => place.covers_at(i, x),
                false => place.covers_at(i, place.spot.at(i)),
            })
        })
    }

    /// Whether all of a part lies so near to a zero that there is no other.
    fn holds(&self, zero: Option<&Place>, part: &Part) -> bool {
        zero.is_some_and(|zero| zero.covers(part.ranges()))
    }

    /// The same of an image of a solution.
    fn shows(&self, seen: &Seen, part: &Part) -> bool {
        let place = &self.figures[seen.figure];
        let ranges = part.ranges().iter().zip(&seen.changes);
        let mut ranges = ranges.enumerate().rev();
        ranges.all(|(i, (&x, &turn))| place.covers_at(i, if turn { -x } else { x }))
    }

    /// A listed zero to which all of a part lies so near.
    pub fn zero_of(&self, part: &Part) -> Option<Mark> {
        // Nothing is near where any number may be.
        let mut ranges = part.ranges().iter().enumerate();
        if ranges.any(|(i, x)| self.apart.is_looked_at(i) && !x.is_common_interval()) {
            return None;
        }
        let figure = (0..self.figures.len()).find(|&figure| self.is_at(figure, part));
        let figure = figure.map(Mark::Figure);
        let image = || self.images.iter().position(|seen| self.shows(seen, part));
        figure.or_else(|| image().map(Mark::Image)).or_else(|| {
            let mut others = self.others.iter();
            let other = others.position(|zero| self.holds(Some(zero), part));
            other.map(Mark::Other)
        })
    }
}

/// Checks a cover.
pub fn verify(
    bytes: &[u8],
    goes_on: &mut dyn FnMut(CoverStage) -> bool,
) -> Result<CoverVerdict, CoverError> {
    let cover = CoordinateCover::from_bytes(bytes)?;
    let mut verdict = CoverVerdict::about(&cover.problem, cover.figures.len())?;
    verdict.flaw = check(&cover, &mut verdict, goes_on).err();
    Ok(verdict)
}

/// What is still to be looked at.
enum Open {
    /// A part of the space.
    Part(Part),
    /// A box of rotations of a body, for the figures in a part.
    Turn(Rc<Part>, usize, Turn),
}

/// Parts between two words of where the check is.
const BATCH: u64 = 256;

/// The check of the marks, one after the other.
struct Check<'a> {
    cover: &'a CoordinateCover,
    space: Space,
    /// Where the next mark is.
    at: usize,
    stack: Vec<Open>,
}

fn check(
    cover: &CoordinateCover,
    verdict: &mut CoverVerdict,
    goes_on: &mut dyn FnMut(CoverStage) -> bool,
) -> Result<(), String> {
    let space = Space::new(&verdict.problem, cover)?;
    verdict.solutions = space.count();
    let mut check = Check {
        cover,
        space,
        at: 0,
        stack: Vec::new(),
    };
    for slice in check.space.slices() {
        check.space.look_at(slice);
        check.stack.push(Open::Part(check.space.whole()));
        while let Some(open) = check.stack.pop() {
            verdict.parts += 1;
            let undecided = match open {
                Open::Part(part) => check.part(part),
                Open::Turn(part, body, turn) => check.turn(part, body, turn),
            };
            let undecided = undecided.map_err(|flaw| format!("part {}: {flaw}", verdict.parts))?;
            verdict.undecided += u64::from(undecided);
            let stage = || CoverStage::new(verdict.parts, check.at, &cover.marks);
            if verdict.parts.is_multiple_of(BATCH) && !goes_on(stage()) {
                return Err(ENDED.to_owned());
            }
        }
    }
    match check.at == cover.marks.len() {
        true => Ok(()),
        false => Err("there are more marks than parts".to_owned()),
    }
}

const DAMAGED: &str = "the marks end, or are damaged";
const UNPROVED: &str = "what its mark says is not proved";
/// Marks that narrow a part without a word of what comes of it have to narrow it: then the time of a check is bounded by the
/// length of the marks and what there is to narrow.
const IDLE: &str = "a mark of it changes nothing";

impl Check<'_> {
    /// A part of the space: whether it stays undecided.
    fn part(&mut self, mut part: Part) -> Result<bool, &'static str> {
        let space = &self.space;
        let mut left = space.narrow(&mut part);
        // The blocks that were reduced since the ranges were narrowed.
        let (mut reduced, blocks) = (0, self.cover.blocks.len());
        while left.is_ok() {
            let (mark, next) = Mark::read(&self.cover.marks, self.at).ok_or(DAMAGED)?;
            self.at = next;
            let proved = match mark {
                Mark::Block(k) | Mark::Bound(k) | Mark::Reduced(k) if k < blocks => {
                    let (before, again) = (part.ranges().to_vec(), part.is_reduced(k));
                    left = match mark {
                        Mark::Block(_) => space.narrow_together(k, &mut part),
                        Mark::Bound(_) => space.bound(k, &mut part),
                        _ => space.reduce(k, &mut part),
                    };
                    let stays = left.is_ok() && part.ranges() == before;
                    reduced = if stays { reduced + 1 } else { 0 };
                    let anew = !again && matches!(mark, Mark::Reduced(_)) && reduced <= blocks;
                    if stays && !anew {
                        return Err(IDLE);
                    }
                    continue;
                }
                Mark::Halves(unknown) => part.halved(unknown).is_some_and(|[low, high]| {
                    self.stack.extend([high, low].map(Open::Part));
                    true
                }),
                Mark::Figure(k) => space.is_at(k, &part),
                Mark::Image(k) => {
                    let seen = space.images.get(k);
                    seen.is_some_and(|seen| space.shows(seen, &part))
                }
                Mark::Other(k) => space.holds(space.others.get(k), &part),
                Mark::Undecided => return Ok(true),
                Mark::Body(k) if space.stands(k, &part) => {
                    let part = Rc::new(part);
                    let charts = Turn::all().into_iter().rev();
                    let charts = charts.map(|turn| Open::Turn(Rc::clone(&part), k, turn));
                    self.stack.extend(charts);
                    true
                }
                Mark::Sides(e) => space.sides(e, &part).is_some_and(|parts| {
                    self.stack.extend(parts.into_iter().rev().map(Open::Part));
                    true
                }),
                Mark::Block(_) | Mark::Bound(_) | Mark::Body(_) | Mark::Reduced(_) => false,
            };
            return if proved { Ok(false) } else { Err(UNPROVED) };
        }
        Ok(false)
    }

    /// A box of rotations: whether it stays undecided.
    fn turn(&mut self, part: Rc<Part>, body: usize, mut turn: Turn) -> Result<bool, &'static str> {
        let space = &self.space;
        while let Some(look) = space.look(body, &part, &turn) {
            let Some(left) = look.left(Margin::None) else {
                break;
            };
            let mark = Turned::read(&self.cover.marks, self.at).ok_or(DAMAGED)?;
            self.at += 1;
            match mark {
                Turned::Narrowed => turn = turn.within(&left).ok_or(UNPROVED)?,
                Turned::Height(axis) => {
                    turn = space.with_height(body, &turn, axis).ok_or(UNPROVED)?;
                }
                Turned::Halves(i) => {
                    let [low, high] = turn.halved(i).ok_or(UNPROVED)?;
                    let halves = [high, low];
                    let halves = halves.map(|turn| Open::Turn(Rc::clone(&part), body, turn));
                    self.stack.extend(halves);
                    break;
                }
                Turned::Part => {
                    if let Ok(part) = space.placed(body, &part, &look).ok_or(UNPROVED)? {
                        self.stack.push(Open::Part(part));
                    }
                    break;
                }
                Turned::Undecided => return Ok(true),
            }
        }
        Ok(false)
    }
}
