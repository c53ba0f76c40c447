//! Where one step puts its point, as Taylor models.

use super::model::{Model, Number, rotation};
use super::node::{Node, Sign};
use super::plan::{Drive, HingeNumbers, Kind, MeetNumbers, Meeting, Plan, Radius};
use super::targets::Targets;

/// A point, or the difference of two.
pub type Place<const D: usize, const S: usize, const M: usize> = [Model<S, M>; D];

/// What is known of a step before the search begins.
#[derive(Debug, Clone, Copy)]
pub enum Known {
    /// An arm's length.
    Length(Number),
    /// A hinge's constants.
    Hinge(HingeNumbers),
    /// A meeting's constants, and which of the steps with two places it is.
    Meeting(Meeting, usize),
}

/// What placing a point came to.
pub enum Placed<const D: usize, const S: usize, const M: usize> {
    /// Here it is.
    Here(Place<D, S, M>),
    /// It is at `middle` plus or minus `off`, both being possible.
    Either {
        /// The middle.
        middle: Place<D, S, M>,
        /// The way from there on the side of the normal.
        off: Place<D, S, M>,
    },
    /// With a fold's symbol w for its signed height, this has to be zero.
    Folded(Place<D, S, M>, Model<S, M>),
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

/// The models of a driving angle's cosine and sine, or of a squared distance.
pub fn angle<const S: usize, const M: usize>(node: &Node, parameter: usize) -> [Model<S, M>; 2] {
    let (middle, reach) = node.middle(parameter);
    let pair = rotation(parameter, middle, reach, true);
    if (node.halves >> parameter) & 1 == 1 {
        pair.map(|x| x.scaled(-1.0))
    } else {
        pair
    }
}

fn minus<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Place<D, S, M> {
    std::array::from_fn(|k| a[k].minus(&b[k]))
}

fn plus<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Place<D, S, M> {
    std::array::from_fn(|k| a[k].plus(&b[k]))
}

fn by<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    factor: Number,
) -> Place<D, S, M> {
    a.each_ref().map(|x| x.by(factor))
}

fn times<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    factor: &Model<S, M>,
) -> Place<D, S, M> {
    a.each_ref().map(|x| x.times(factor))
}

fn dot<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Model<S, M> {
    let mut sum = a[0].times(&b[0]);
    for k in 1..D {
        sum = sum.plus(&a[k].times(&b[k]));
    }
    sum
}

/// |a − b|².
pub fn squared_distance<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Model<S, M> {
    let d = minus(a, b);
    dot(&d, &d)
}

/// a turned by a right angle in the plane, a × b in space.
fn normal<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Place<D, S, M> {
    std::array::from_fn(|k| {
        if D == 2 {
            if k == 0 { a[1].scaled(-1.0) } else { a[0] }
        } else {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i].times(&b[j]).minus(&a[j].times(&b[i]))
        }
    })
}

/// Places the point of a step.
pub fn place<const D: usize, const S: usize, const M: usize>(
    targets: &Targets,
    plan: &Plan,
    node: &Node,
    (step, known): (usize, &Known),
    points: &[Place<D, S, M>],
) -> Placed<D, S, M> {
    match (&plan.steps[step].kind, known) {
        (&Kind::Arm { centre, parameter }, &Known::Length(length)) => {
            let direction = angle(node, parameter);
            Placed::Here(std::array::from_fn(|k| {
                points[centre][k].plus(&direction[k].by(length))
            }))
        }
        (&Kind::Hinge { frame, parameter }, &Known::Hinge(numbers)) => {
            let [c1, c2, q] = frame.map(|p| &points[p]);
            let a = minus(c2, c1);
            let v = minus(&minus(q, c1), &by(&a, numbers.foot));
            let [cos, sin] = angle(node, parameter);
            let foot = plus(c1, &by(&a, numbers.along));
            let side = times(&v, &cos.by(numbers.side));
            let up = times(&normal(&a, &v), &sin.by(numbers.up));
            Placed::Here(plus(&foot, &plus(&side, &up)))
        }
        (Kind::Meet { centres, radii }, Known::Meeting(meeting, index)) => {
            let c1 = &points[centres[0]];
            let a = minus(&points[centres[1]], c1);
            let b = match centres.get(2) {
                Some(&c3) => minus(&points[c3], c1),
                None => a,
            };
            match meeting {
                Meeting::Empty => Placed::None,
                Meeting::Rigid(numbers) => rigid(node, *index, numbers, c1, (&a, &b)),
                Meeting::Moving => {
                    moving(targets, plan, node, *index, (centres, radii), c1, (&a, &b))
                }
            }
        }
        _ => unreachable!("what is known of a step is of the step's own kind"),
    }
}

fn rigid<const D: usize, const S: usize, const M: usize>(
    node: &Node,
    index: usize,
    numbers: &MeetNumbers,
    c1: &Place<D, S, M>,
    (a, b): (&Place<D, S, M>, &Place<D, S, M>),
) -> Placed<D, S, M> {
    let mut middle = plus(c1, &by(a, numbers.first));
    if D == 3 {
        middle = plus(&middle, &by(b, numbers.second));
    }
    sided(node, index, middle, by(&normal(a, b), numbers.over))
}

fn sided<const D: usize, const S: usize, const M: usize>(
    node: &Node,
    index: usize,
    middle: Place<D, S, M>,
    off: Place<D, S, M>,
) -> Placed<D, S, M> {
    match node.sign(index) {
        Some(Sign::Plus) => Placed::Here(plus(&middle, &off)),
        Some(Sign::Minus) => Placed::Here(minus(&middle, &off)),
        _ => Placed::Either { middle, off },
    }
}

fn moving<const D: usize, const S: usize, const M: usize>(
    targets: &Targets,
    plan: &Plan,
    node: &Node,
    index: usize,
    (centres, radii): (&[usize], &[Radius]),
    c1: &Place<D, S, M>,
    (a, b): (&Place<D, S, M>, &Place<D, S, M>),
) -> Placed<D, S, M> {
    let square = |one: usize, other: usize, d: &Place<D, S, M>| {
        match targets.edge(centres[one], centres[other]) {
            // What the distance must be is known better than what the models say.
            Some(edge) => Model::constant(Number::new(targets.squares[edge])),
            None => dot(d, d),
        }
    };
    let radius = |k: usize| match radii[k] {
        Radius::Edge(edge) => Model::constant(Number::new(targets.squares[edge])),
        Radius::Parameter(parameter) => {
            debug_assert!(matches!(plan.drives[parameter], Drive::Square(_)));
            let (middle, reach) = node.middle(parameter);
            let mut out = Model::symbol(parameter, middle, reach);
            // Above zero, and rounding of the middle is in the reach.
            out.r = 0.0;
            out
        }
    };
    // With A = |a|², B = |b|², C = a·b, q₁ = a·(p − c₁), q₂ = b·(p − c₁): the new point is
    // c₁ + ((q₁B − q₂C) a + (q₂A − q₁C) b ± √N n)/Δ, Δ = AB − C² = |n|², with
    // N = r₁²Δ − (q₁²B − 2q₁q₂C + q₂²A). In the plane Δ = A, N = r₁²A − q₁².
    let (r1, big_a) = (radius(0), square(0, 1, a));
    let q1 = r1.minus(&radius(1)).plus(&big_a).scaled(0.5);
    let (first, second, delta, n) = if D == 2 {
        let n = r1.times(&big_a).minus(&q1.squared());
        (q1, Model::ZERO, big_a, n)
    } else {
        let big_b = square(0, 2, b);
        let c = match targets.edge(centres[1], centres[2]) {
            Some(edge) => big_a
                .plus(&big_b)
                .minus(&Model::constant(Number::new(targets.squares[edge])))
                .scaled(0.5),
            None => dot(a, b),
        };
        let q2 = r1.minus(&radius(2)).plus(&big_b).scaled(0.5);
        let delta = big_a.times(&big_b).minus(&c.squared());
        let first = q1.times(&big_b).minus(&q2.times(&c));
        let second = q2.times(&big_a).minus(&q1.times(&c));
        let n = r1
            .times(&delta)
            .minus(&first.times(&q1).plus(&second.times(&q2)));
        (first, second, delta, n)
    };
    let height = n.range();
    if height.hi < -1e-9 {
        return Placed::None;
    }
    let width = delta.range();
    if !(width.lo > 1e-3 * width.hi) {
        return Placed::Degenerate(delta);
    }
    let over = delta.reciprocal(width);
    let mut middle = plus(c1, &times(a, &first.times(&over)));
    if D == 3 {
        middle = plus(&middle, &times(b, &second.times(&over)));
    }
    let n_vector = times(&normal(a, b), &over);
    let sign = node.sign(index);
    if sign == Some(Sign::Fold) {
        let symbol = node.fold_symbol(plan.parameters(), index);
        let (centre, reach) = node.middle(symbol);
        let w = Model::symbol(symbol, centre, reach);
        let here = plus(&middle, &times(&n_vector, &w));
        return Placed::Folded(here, n.minus(&w.squared()));
    }
    let least = if sign.is_some() {
        LEAST_DECIDED
    } else {
        LEAST_OPEN
    };
    if height.lo > least * height.hi && height.lo > 1e-9 {
        let off = times(&n_vector, &n.square_root(height));
        return sided(node, index, middle, off);
    }
    // A little more, so that who evaluates it with other roundings comes to less.
    let more = 1e-12 * (1.0 + n.size());
    let greatest = (height.hi.max(0.0) + more).sqrt() * (1.0 + 1e-9);
    Placed::Near {
        height: greatest,
        far: 2.0 * greatest / width.lo.sqrt(),
        square: n,
    }
}
