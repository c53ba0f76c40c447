//! Where one step puts its point, and what of that a search can decide.

use super::node::{Node, Sign};
use super::search::Search;
use crate::certificate::cover::Kind;
use crate::certificate::cover::construct::{self, Ahead, Known, Meeting, Place};
use crate::model::Model;

/// What placing a point came to.
pub enum Placed<const S: usize, const M: usize> {
    /// Here it is.
    Here(Place<S, M>),
    /// It is at the first place plus or minus the second one, times the height, both being possible.
    Either([Place<S, M>; 2], Model<S, M>),
    /// With a fold's symbol w for its signed height, this has to be zero.
    Folded(Place<S, M>, Model<S, M>),
    /// There is no such point.
    None,
    /// The square of its signed height, times the square of the normal, may be zero and is at most
    /// `height²`: a symbol can take the place of the height. `far` is how far apart the two places may be.
    Near {
        /// The root of the greatest value.
        height: f64,
        /// In the unit of length.
        far: f64,
        /// The square.
        square: Model<S, M>,
    },
    /// The centres may lie in line: this may be zero.
    Degenerate(Model<S, M>),
}

/// Below this part of the greatest, the least squared height is too small for √ to be expanded where both signs
/// are possible (and where one was decided on a larger box).
const LEAST_OPEN: f64 = 0.3;
const LEAST_DECIDED: f64 = 0.03;

/// Places the point of a step.
pub fn place<const S: usize, const M: usize>(
    search: &Search,
    node: &Node,
    step: usize,
    points: &[Place<S, M>],
) -> Placed<S, M> {
    let now = &search.plan.steps[step];
    let angle = |i: usize| construct::angle(i, node.middle(i), (node.halves >> i) & 1 == 1);
    let known = &search.known[step];
    let (Kind::Meet(centres), Known::Meeting(ahead)) = (&now.kind, known) else {
        let here = known.driven(&now.kind, points, angle);
        return Placed::Here(here.expect("what is known of a step is of the step's own kind"));
    };
    let index = search.signed[step];
    match ahead {
        Ahead::Empty => Placed::None,
        Ahead::Rigid(numbers) => {
            let (places, height) = numbers.places(centres, points);
            decided(node.sign(index), places, height, search.targets.dimension)
        }
        Ahead::Moving => {
            let square = |a, b| search.targets.edge(a, b).map(|e| search.squares[e]);
            let meeting = Meeting::new(square, now.point, centres, points, |i| node.symbol(i));
            let meeting = meeting.expect("the problem's distances are known");
            moving(search, node, index, &meeting)
        }
    }
}

/// At one of two places, or at either.
fn decided<const S: usize, const M: usize>(
    sign: Option<Sign>,
    places: [Place<S, M>; 2],
    height: Model<S, M>,
    d: usize,
) -> Placed<S, M> {
    match sign {
        Some(Sign::Plus) => Placed::Here(construct::beside(d, &places, 1.0, &height)),
        Some(Sign::Minus) => Placed::Here(construct::beside(d, &places, -1.0, &height)),
        _ => Placed::Either(places, height),
    }
}

fn moving<const S: usize, const M: usize>(
    search: &Search,
    node: &Node,
    index: usize,
    meeting: &Meeting<S, M>,
) -> Placed<S, M> {
    let d = search.targets.dimension;
    let height = meeting.square.range();
    if height.hi < -1e-9 {
        return Placed::None;
    }
    let width = meeting.width.range();
    if !(width.lo > 1e-3 * width.hi) {
        return Placed::Degenerate(meeting.width);
    }
    let sign = node.sign(index);
    let least = match sign {
        Some(_) => LEAST_DECIDED,
        None => LEAST_OPEN,
    };
    let opens = height.lo > least * height.hi && height.lo > 1e-9;
    if sign == Some(Sign::Fold) || opens {
        let places = meeting.places(&meeting.width.reciprocal(width));
        if sign == Some(Sign::Fold) {
            let w = node.symbol(node.fold_symbol(search.plan.parameters(), index));
            let equation = meeting.square.minus(&w.squared());
            return Placed::Folded(construct::beside(d, &places, 1.0, &w), equation);
        }
        return decided(sign, places, meeting.square.square_root(height), d);
    }
    // A little more, so that who evaluates it with other roundings comes to less.
    let more = 1e-12 * (1.0 + meeting.square.size());
    let greatest = (height.hi.max(0.0) + more).sqrt() * (1.0 + 1e-9);
    Placed::Near {
        height: greatest,
        far: 2.0 * greatest / width.lo.sqrt(),
        square: meeting.square,
    }
}
