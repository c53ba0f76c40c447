//! Where one step puts its point, as Taylor models.

use super::model::{Factor, Model, Number, combined, rotation, weighted};
use super::node::{Node, Sign};
use super::plan::{HingeNumbers, MeetNumbers, Meeting, Plan};
use super::targets::Targets;
use crate::certificate::cover::{Kind, Radius};
use crate::interval::rounding::UNDERFLOW;
use crate::places::Each as _;

/// A point, or the difference of two.
pub type Place<const D: usize, const S: usize, const M: usize> = [Model<S, M>; D];

/// What is known of a step before the search begins.
#[derive(Debug, Clone, Copy)]
pub enum Known {
    /// An arm's length.
    Length(Number),
    /// A hinge's constants.
    Hinge(HingeNumbers),
    /// A meeting's constants, which of the steps with two places it is, and what it is computed from otherwise.
    Meeting(Meeting, usize, Squares),
}

/// The squared distances of a meeting that are the problem's.
#[derive(Debug, Clone, Copy)]
pub struct Squares {
    /// From the centres to the new point.
    radii: [Option<Number>; 3],
    /// Between the centres: the first two, the first and the third, the last two.
    between: [Option<Number>; 3],
}

impl Squares {
    /// Of a new point and its centres.
    pub fn new(targets: &Targets, new: usize, centres: &[(usize, Radius)]) -> Self {
        let between = |i: usize, j: usize| {
            let square = targets.square(centres.get(i)?.0, centres.get(j)?.0);
            square.map(Number::new)
        };
        let radius = |k: usize| match centres.get(k) {
            Some(&(centre, Radius::Given)) => targets.square(new, centre).map(Number::new),
            _ => None,
        };
        Squares {
            radii: [radius(0), radius(1), radius(2)],
            between: [between(0, 1), between(0, 2), between(1, 2)],
        }
    }
}

/// A number, or a function of the symbols.
#[derive(Clone, Copy)]
enum Quantity<const S: usize, const M: usize> {
    Fixed(Number),
    Moving(Model<S, M>),
}

use Quantity::{Fixed, Moving};

impl<const S: usize, const M: usize> Quantity<S, M> {
    fn model(&self) -> Model<S, M> {
        match self {
            Fixed(x) => Model::constant(*x),
            Moving(f) => *f,
        }
    }

    #[inline]
    fn plus(&self, other: &Self) -> Self {
        match (self, other) {
            (Fixed(x), Fixed(y)) => Fixed(x.plus(1.0, *y)),
            (Fixed(x), Moving(f)) | (Moving(f), Fixed(x)) => Moving(f.shifted(*x)),
            (Moving(f), Moving(g)) => Moving(f.plus(g)),
        }
    }

    #[inline]
    fn minus(&self, other: &Self) -> Self {
        match (self, other) {
            (Fixed(x), Fixed(y)) => Fixed(x.plus(-1.0, *y)),
            (Moving(f), Fixed(x)) => Moving(f.shifted(x.negative())),
            (Moving(f), Moving(g)) => Moving(f.minus(g)),
            (Fixed(x), Moving(f)) => Moving(f.scaled(-1.0).shifted(*x)),
        }
    }

    #[inline]
    fn times(&self, other: &Self) -> Self {
        match (self, other) {
            (Fixed(x), Fixed(y)) => Fixed(x.times(*y)),
            (Fixed(x), Moving(f)) | (Moving(f), Fixed(x)) => Moving(f.by(*x)),
            (Moving(f), Moving(g)) => Moving(f.times(g)),
        }
    }

    fn half(&self) -> Self {
        match self {
            Fixed(x) => Fixed(Number {
                mid: 0.5 * x.mid,
                rad: 0.5 * x.rad + UNDERFLOW,
            }),
            Moving(f) => Moving(f.scaled(0.5)),
        }
    }
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
        pair.each(|x| x.scaled(-1.0))
    } else {
        pair
    }
}

/// A place, coordinate by coordinate. (`std::array::from_fn` is not inlined here, and copies every model twice.)
#[inline(always)]
fn each<const D: usize, const S: usize, const M: usize>(
    mut coordinate: impl FnMut(usize) -> Model<S, M>,
) -> Place<D, S, M> {
    let mut out = [Model::ZERO; D];
    for (k, model) in out.iter_mut().enumerate() {
        *model = coordinate(k);
    }
    out
}

/// The coordinates as factors of products.
#[inline(always)]
fn factors<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
) -> [Factor<'_, S, M>; D] {
    let mut out = [a[0].factor(); D];
    for k in 1..D {
        out[k] = a[k].factor();
    }
    out
}

fn minus<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Place<D, S, M> {
    each(|k| a[k].minus(&b[k]))
}

#[inline(always)]
fn product<const D: usize, const S: usize, const M: usize>(
    a: &[Factor<S, M>; D],
    b: &[Factor<S, M>; D],
) -> Model<S, M> {
    let mut terms = [(1.0, a[0], b[0]); D];
    for k in 1..D {
        terms[k] = (1.0, a[k], b[k]);
    }
    combined::<D, S, M>(&Model::ZERO, terms)
}

#[inline(always)]
fn dot<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Model<S, M> {
    product(&factors(a), &factors(b))
}

/// |a − b|².
pub fn squared_distance<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Model<S, M> {
    let d = minus(a, b);
    let d = factors(&d);
    product(&d, &d)
}

/// a turned by a right angle in the plane, a × b in space. (Inlined, as `dot` is: with calls, which `determinant` brings about, searches
/// take 4 % more instructions.)
#[inline(always)]
fn normal<const D: usize, const S: usize, const M: usize>(
    a: &Place<D, S, M>,
    b: &Place<D, S, M>,
) -> Place<D, S, M> {
    if D == 2 {
        return each(|k| if k == 0 { a[1].scaled(-1.0) } else { a[0] });
    }
    let (a, b) = (factors(a), factors(b));
    each(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        combined(&Model::ZERO, [(1.0, a[i], b[j]), (-1.0, a[j], b[i])])
    })
}

/// The determinant of the sides of a simplex from its first point.
#[inline(never)]
pub fn determinant<const D: usize, const S: usize, const M: usize>(
    points: &[Place<D, S, M>],
    simplex: &[usize],
) -> Model<S, M> {
    let side = |k: usize| minus(&points[simplex[k]], &points[simplex[0]]);
    match D {
        2 => dot(&normal(&side(1), &side(1)), &side(2)),
        _ => dot(&side(1), &normal(&side(2), &side(3))),
    }
}

/// Places the point of a step.
pub fn place<const D: usize, const S: usize, const M: usize>(
    plan: &Plan,
    node: &Node,
    (step, known): (usize, &Known),
    points: &[Place<D, S, M>],
) -> Placed<D, S, M> {
    match (&plan.steps[step].kind, known) {
        (&Kind::Arm(centre, parameter), &Known::Length(length)) => {
            let direction = angle(node, parameter);
            Placed::Here(each(|k| {
                weighted(&points[centre][k], [(length, &direction[k])])
            }))
        }
        (&Kind::Hinge(frame, parameter), &Known::Hinge(numbers)) => {
            let [c1, c2, q] = frame.each(|p| &points[p]);
            let a = minus(c2, c1);
            let (minus_one, minus_foot) = (Number::exact(-1.0), numbers.foot.negative());
            let v: Place<D, S, M> =
                each(|k| weighted(&q[k], [(minus_one, &c1[k]), (minus_foot, &a[k])]));
            let [cos, sin] = angle(node, parameter);
            let (cos, sin) = (cos.by(numbers.side), sin.by(numbers.up));
            let (cos, sin) = (cos.factor(), sin.factor());
            let up = normal(&a, &v);
            Placed::Here(each(|k| {
                let foot = weighted(&c1[k], [(numbers.along, &a[k])]);
                let terms = [(1.0, v[k].factor(), cos), (1.0, up[k].factor(), sin)];
                combined(&foot, terms)
            }))
        }
        (Kind::Meet(centres), Known::Meeting(meeting, index, squares)) => {
            let c1 = &points[centres[0].0];
            let a = minus(&points[centres[1].0], c1);
            let b = match centres.get(2) {
                Some(&(c3, _)) => minus(&points[c3], c1),
                None => a,
            };
            match meeting {
                Meeting::Empty => Placed::None,
                Meeting::Rigid(numbers) => rigid(node, *index, numbers, c1, (&a, &b)),
                Meeting::Moving => moving(plan, node, *index, (centres, squares), c1, (&a, &b)),
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
    let middle = each(|k| match D {
        2 => weighted(&c1[k], [(numbers.first, &a[k])]),
        _ => weighted(&c1[k], [(numbers.first, &a[k]), (numbers.second, &b[k])]),
    });
    let normal = normal(a, b);
    let off = each(|k| normal[k].by(numbers.over));
    match node.sign(index) {
        Some(Sign::Plus) => Placed::Here(each(|k| middle[k].plus(&off[k]))),
        Some(Sign::Minus) => Placed::Here(minus(&middle, &off)),
        _ => Placed::Either { middle, off },
    }
}

fn moving<const D: usize, const S: usize, const M: usize>(
    plan: &Plan,
    node: &Node,
    index: usize,
    (centres, squares): (&[(usize, Radius)], &Squares),
    c1: &Place<D, S, M>,
    (a, b): (&Place<D, S, M>, &Place<D, S, M>),
) -> Placed<D, S, M> {
    // What a distance must be is known better than what the models say.
    let between = |which: usize, x: &Place<D, S, M>, y: &Place<D, S, M>| {
        squares.between[which].map_or_else(|| Moving(dot(x, y)), Fixed)
    };
    let radius = |k: usize| match (squares.radii[k], centres[k].1) {
        (Some(known), _) => Fixed(known),
        (None, Radius::Parameter(parameter)) => {
            assert!(plan.drives[parameter].is_some());
            let (middle, reach) = node.middle(parameter);
            Moving(Model::symbol(parameter, middle, reach))
        }
        (None, Radius::Given) => unreachable!("the problem's distances are known"),
    };
    // With A = |a|², B = |b|², C = a·b, q₁ = a·(p − c₁), q₂ = b·(p − c₁): the new point is
    // c₁ + ((q₁B − q₂C) a + (q₂A − q₁C) b ± √N n)/Δ, Δ = AB − C² = |n|², with
    // N = r₁²Δ − (q₁²B − 2q₁q₂C + q₂²A). In the plane Δ = A, N = r₁²A − q₁².
    let (r1, big_a) = (radius(0), between(0, a, a));
    let q1 = r1.minus(&radius(1)).plus(&big_a).half();
    let (first, second, delta, n) = if D == 2 {
        let n = r1.times(&big_a).minus(&q1.times(&q1));
        (q1, q1, big_a, n)
    } else {
        let big_b = between(1, b, b);
        let c = match squares.between[2] {
            Some(third) => big_a.plus(&big_b).minus(&Fixed(third)).half(),
            None => Moving(dot(a, b)),
        };
        let q2 = r1.minus(&radius(2)).plus(&big_b).half();
        let delta = big_a.times(&big_b).minus(&c.times(&c));
        let first = q1.times(&big_b).minus(&q2.times(&c));
        let second = q2.times(&big_a).minus(&q1.times(&c));
        let off = first.times(&q1).plus(&second.times(&q2));
        (first, second, delta, r1.times(&delta).minus(&off))
    };
    let (delta, n) = (delta.model(), n.model());
    let height = n.range();
    if height.hi < -1e-9 {
        return Placed::None;
    }
    let width = delta.range();
    if !(width.lo > 1e-3 * width.hi) {
        return Placed::Degenerate(delta);
    }
    let sign = node.sign(index);
    let least = if sign.is_some() {
        LEAST_DECIDED
    } else {
        LEAST_OPEN
    };
    let opens = height.lo > least * height.hi && height.lo > 1e-9;
    if sign == Some(Sign::Fold) || opens {
        let over = delta.reciprocal(width);
        let along = first.times(&Moving(over)).model();
        let middle: Place<D, S, M> = if D == 2 {
            each(|k| combined(&c1[k], [(1.0, a[k].factor(), along.factor())]))
        } else {
            let across = second.times(&Moving(over)).model();
            let (along, across) = (along.factor(), across.factor());
            each(|k| {
                let terms = [(1.0, a[k].factor(), along), (1.0, b[k].factor(), across)];
                combined(&c1[k], terms)
            })
        };
        let out = over.factor();
        let normal = normal(a, b);
        let normal: Place<D, S, M> =
            each(|k| combined(&Model::ZERO, [(1.0, normal[k].factor(), out)]));
        let normal = factors(&normal);
        let beside = |sign: f64, height: &Model<S, M>| -> Place<D, S, M> {
            let height = height.factor();
            each(|k| combined(&middle[k], [(sign, normal[k], height)]))
        };
        if sign == Some(Sign::Fold) {
            let symbol = node.fold_symbol(plan.parameters(), index);
            let (centre, reach) = node.middle(symbol);
            let w = Model::symbol(symbol, centre, reach);
            return Placed::Folded(beside(1.0, &w), n.minus(&w.squared()));
        }
        let root = n.square_root(height);
        return match sign {
            Some(Sign::Plus) => Placed::Here(beside(1.0, &root)),
            Some(Sign::Minus) => Placed::Here(beside(-1.0, &root)),
            _ => {
                let height = root.factor();
                let off = each(|k| combined(&Model::ZERO, [(1.0, normal[k], height)]));
                Placed::Either { middle, off }
            }
        };
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
