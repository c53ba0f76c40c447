//! Where the steps of a construction plan put their points, as functions of the driving parameters and of folds' heights.

use super::format::{Kind, Radius};
use crate::interval::{Interval, checked, point};
use crate::model::{Factor, Margin, Model, Number, combined, rotation, weighted};
use crate::places::Each as _;

/// A point, or the difference of two; coordinates beyond the dimension are 0.
pub type Place<const S: usize, const M: usize> = [Model<S, M>; 3];

/// The squared distance that a problem gives two points.
pub type Squares<'a> = &'a dyn Fn(usize, usize) -> Option<Interval>;

/// A place, coordinate by coordinate. (`std::array::from_fn` is not inlined here, and copies every model twice.)
#[inline(always)]
fn each<const S: usize, const M: usize>(
    d: usize,
    mut coordinate: impl FnMut(usize) -> Model<S, M>,
) -> Place<S, M> {
    let mut out = [Model::ZERO; 3];
    for (k, model) in out[..d].iter_mut().enumerate() {
        *model = coordinate(k);
    }
    out
}

/// a − b.
pub fn minus<const S: usize, const M: usize>(
    d: usize,
    a: &Place<S, M>,
    b: &Place<S, M>,
) -> Place<S, M> {
    each(d, |k| a[k].minus(&b[k]))
}

#[inline(always)]
fn product<const S: usize, const M: usize>(
    d: usize,
    a: [Factor<S, M>; 3],
    b: [Factor<S, M>; 3],
) -> Model<S, M> {
    let term = |k: usize| (1.0, a[k], b[k]);
    match d {
        2 => combined(&Model::ZERO, [term(0), term(1)]),
        _ => combined(&Model::ZERO, [term(0), term(1), term(2)]),
    }
}

/// The coordinates as factors of products.
#[inline(always)]
fn factors<const S: usize, const M: usize>(a: &Place<S, M>) -> [Factor<'_, S, M>; 3] {
    [a[0].factor(), a[1].factor(), a[2].factor()]
}

fn dot<const S: usize, const M: usize>(d: usize, a: &Place<S, M>, b: &Place<S, M>) -> Model<S, M> {
    product(d, factors(a), factors(b))
}

/// |a − b|².
pub fn squared_distance<const S: usize, const M: usize>(
    d: usize,
    a: &Place<S, M>,
    b: &Place<S, M>,
) -> Model<S, M> {
    let difference = minus(d, a, b);
    let factors = factors(&difference);
    product(d, factors, factors)
}

/// a turned by a right angle in the plane, a × b in space.
fn normal<const S: usize, const M: usize>(
    d: usize,
    a: &Place<S, M>,
    b: &Place<S, M>,
) -> Place<S, M> {
    if d == 2 {
        return [a[1].negative(), a[0], Model::ZERO];
    }
    let (a, b) = (factors(a), factors(b));
    each(3, |k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        combined(&Model::ZERO, [(1.0, a[i], b[j]), (-1.0, a[j], b[i])])
    })
}

/// The determinant of the sides of a simplex from its first point.
pub fn determinant<const S: usize, const M: usize>(
    d: usize,
    points: &[Place<S, M>],
    simplex: &[usize],
) -> Model<S, M> {
    let side = |k: usize| minus(d, &points[simplex[k]], &points[simplex[0]]);
    match d {
        2 => dot(2, &normal(2, &side(1), &side(1)), &side(2)),
        _ => dot(3, &side(1), &normal(3, &side(2), &side(3))),
    }
}

/// What of a number that rounding leaves below 0 may be the square of a length; anything where nothing is known.
pub(super) fn not_negative(x: Interval) -> Interval {
    let known = checked(x.inf().max(0.0), x.sup().max(0.0));
    known.unwrap_or_else(|| Interval::ENTIRE.abs())
}

/// The coordinates of a base: the first point in the origin, the second on the first axis, the third on the positive side of it.
/// `None`: it may be degenerate, or lacks a distance.
pub fn base(square: Squares, base: &[usize], margin: Margin) -> Option<Vec<[Interval; 3]>> {
    let zero = point(0.0);
    let ab = square(base[0], base[1])?;
    let length = ab.sqrt();
    let mut out = vec![[zero; 3], [length, zero, zero]];
    if let Some(&c) = base.get(2) {
        let (r1, r2) = (square(base[0], c)?, square(base[1], c)?);
        let x = (r1 - r2 + ab) / (point(2.0) * length);
        let height = r1 - x.sqr();
        if !(height.inf() > margin.of(1.0)) {
            return None;
        }
        out.push([x, height.sqrt(), zero]);
    }
    (ab.inf() > 0.0).then_some(out)
}

/// Cosine and sine of a driving angle, from where its parameter is and how far it reaches, in the first half of all angles or in the second.
pub fn angle<const S: usize, const M: usize>(
    parameter: usize,
    (middle, reach): (f64, f64),
    is_second: bool,
) -> [Model<S, M>; 2] {
    let pair = rotation(parameter, middle, reach);
    match is_second {
        true => pair.each(|x| x.negative()),
        false => pair,
    }
}

/// The constants of a hinge: the new point lies at
/// `c₁ + along (c₂ − c₁) + cos θ · side · v + sin θ · up · (c₂ − c₁) × v`, where
/// `v = (q − c₁) − foot (c₂ − c₁)` is perpendicular to the hinge.
#[derive(Debug, Clone, Copy)]
pub struct Hinge {
    /// Where the new point's foot lies on the hinge, as a part of it.
    along: Number,
    /// Where the third point's foot lies.
    foot: Number,
    /// The new point's distance from the hinge over that of the third point.
    side: Number,
    /// That over the length of the hinge.
    up: Number,
}

impl Hinge {
    /// For a new point on a hinge. `None` if the third point may lie in line with the hinge, or a distance is not given; `Err`
    /// if no point has the distances wanted.
    pub fn new(
        square: Squares,
        new: usize,
        [c1, c2, q]: [usize; 3],
        margin: Margin,
    ) -> Option<Result<Hinge, ()>> {
        let a = square(c1, c2)?;
        let part = |p: usize| -> Option<(Interval, Interval)> {
            let (r1, r2) = (square(c1, p)?, square(c2, p)?);
            let part = (r1 - r2 + a) / (point(2.0) * a);
            // The squared distance from the hinge.
            Some((part, r1 - part.sqr() * a))
        };
        let ((along, new_height), (foot, height)) = (part(new)?, part(q)?);
        if !(height.inf() > margin.of(1.0)) {
            return None;
        }
        if new_height.sup() < 0.0 {
            return Some(Err(()));
        }
        let side = (not_negative(new_height) / height).sqrt();
        Some(Ok(Hinge {
            along: Number::new(along),
            foot: Number::new(foot),
            side: Number::new(side),
            up: Number::new(side / a.sqrt()),
        }))
    }

    /// Where the new point is.
    fn place<const S: usize, const M: usize>(
        &self,
        [c1, c2, q]: [&Place<S, M>; 3],
        [cos, sin]: &[Model<S, M>; 2],
    ) -> Place<S, M> {
        let a = minus(3, c2, c1);
        let (minus_one, minus_foot) = (Number::exact(-1.0), self.foot.negative());
        let v = each(3, |k| {
            weighted(&q[k], [(minus_one, &c1[k]), (minus_foot, &a[k])])
        });
        let (cos, sin) = (cos.by(self.side), sin.by(self.up));
        let (cos, sin) = (cos.factor(), sin.factor());
        let up = normal(3, &a, &v);
        each(3, |k| {
            let foot = weighted(&c1[k], [(self.along, &a[k])]);
            combined(
                &foot,
                [(1.0, v[k].factor(), cos), (1.0, up[k].factor(), sin)],
            )
        })
    }
}

/// What is known of a step before any part is looked at.
#[derive(Debug, Clone, Copy)]
pub enum Known {
    /// An arm's length.
    Length(Number),
    /// A hinge's constants.
    Hinge(Hinge),
    /// What is known of a meeting.
    Meeting(Ahead),
}

impl Known {
    /// Of a step that places the point `new`. `None` and `Err`: of a hinge as [`Hinge::new`] says, or an arm's length is not given.
    pub fn new(
        square: Squares,
        new: usize,
        kind: &Kind,
        margin: Margin,
    ) -> Option<Result<Known, ()>> {
        Some(Ok(match kind {
            Kind::Arm(centre, _) => Known::Length(Number::new(square(new, *centre)?.sqrt())),
            Kind::Hinge(frame, _) => {
                return Some(Hinge::new(square, new, *frame, margin)?.map(Known::Hinge));
            }
            Kind::Meet(centres) => Known::Meeting(Ahead::new(square, new, centres)),
        }))
    }

    /// The place of an arm's or a hinge's point, by the cosine and sine of driving angles. `None`: a meeting has two places.
    pub fn driven<const S: usize, const M: usize>(
        &self,
        kind: &Kind,
        points: &[Place<S, M>],
        angle: impl Fn(usize) -> [Model<S, M>; 2],
    ) -> Option<Place<S, M>> {
        match (kind, self) {
            (&Kind::Arm(centre, parameter), &Known::Length(length)) => {
                let (centre, direction) = (&points[centre], angle(parameter));
                Some(each(2, |k| weighted(&centre[k], [(length, &direction[k])])))
            }
            (&Kind::Hinge(frame, parameter), Known::Hinge(hinge)) => {
                Some(hinge.place(frame.each(|p| &points[p]), &angle(parameter)))
            }
            _ => None,
        }
    }
}

/// The constants of a meeting of spheres (or circles) whose centres have given distances from each other:
/// the new point lies at `c₁ + first (c₂ − c₁) + second (c₃ − c₁) ± over n`, n = (c₂ − c₁) × (c₃ − c₁) or
/// (c₂ − c₁) turned by a right angle.
#[derive(Debug, Clone, Copy)]
pub struct Rigid {
    /// The multiple of c₂ − c₁ in the new point.
    first: Number,
    /// The multiple of c₃ − c₁ in the new point.
    second: Number,
    /// The multiple of n in the new point, up to its sign.
    over: Number,
}

/// What is known of a meeting before any part is looked at.
#[derive(Debug, Clone, Copy)]
pub enum Ahead {
    /// Nothing: the centres move, or the new point may lie between them.
    Moving,
    /// All but the place of the centres.
    Rigid(Rigid),
    /// There is no such point.
    Empty,
}

impl Ahead {
    /// Of a new point and its centres.
    pub fn new(square: Squares, new: usize, centres: &[(usize, Radius)]) -> Self {
        Self::of(square, new, centres).unwrap_or(Ahead::Moving)
    }

    fn of(square: Squares, new: usize, centres: &[(usize, Radius)]) -> Option<Self> {
        let radius = |k: usize| match centres[k] {
            (centre, Radius::Given) => square(new, centre),
            (_, Radius::Parameter(_)) => None,
        };
        let between = |a: usize, b: usize| square(centres[a].0, centres[b].0);
        let (a, r1, r2) = (between(0, 1)?, radius(0)?, radius(1)?);
        let half = point(0.5);
        let q1 = (r1 - r2 + a) * half;
        let (first, second, delta, n) = if centres.len() == 2 {
            (q1, point(0.0), a, r1 * a - q1.sqr())
        } else {
            let (b, d, r3) = (between(0, 2)?, between(1, 2)?, radius(2)?);
            let c = (a + b - d) * half;
            let q2 = (r1 - r3 + b) * half;
            let delta = a * b - c.sqr();
            let (first, second) = (q1 * b - q2 * c, q2 * a - q1 * c);
            (
                first,
                second,
                delta,
                r1 * delta - (first * q1 + second * q2),
            )
        };
        if delta.inf() <= 1e-9 {
            return None;
        }
        if n.sup() < -1e-9 {
            return Some(Ahead::Empty);
        }
        if n.inf() <= 1e-9 {
            return None;
        }
        Some(Ahead::Rigid(Rigid {
            first: Number::new(first / delta),
            second: Number::new(second / delta),
            over: Number::new(n.sqrt() / delta),
        }))
    }
}

impl Rigid {
    /// The middle of both places, the normal, and how many times that the places are from there.
    pub fn places<const S: usize, const M: usize>(
        &self,
        centres: &[(usize, Radius)],
        points: &[Place<S, M>],
    ) -> ([Place<S, M>; 2], Model<S, M>) {
        let d = centres.len();
        let at = |k: usize| &points[centres[k].0];
        let (from, a) = (at(0), minus(d, at(1), at(0)));
        let b = if d == 2 { a } else { minus(d, at(2), from) };
        let middle = each(d, |k| match d {
            2 => weighted(&from[k], [(self.first, &a[k])]),
            _ => weighted(&from[k], [(self.first, &a[k]), (self.second, &b[k])]),
        });
        ([middle, normal(d, &a, &b)], Model::constant(self.over))
    }
}

/// A point at given distances from as many centres as there are dimensions: at a middle, plus or minus √N times a normal.
///
/// With A = |a|², B = |b|², C = a·b of the centres' differences a, b from the first one, q₁ = a·(p − c₁), q₂ = b·(p − c₁):
/// p = c₁ + ((q₁B − q₂C) a + (q₂A − q₁C) b ± √N n)/Δ, Δ = AB − C² = |n|², n = a × b, with
/// N = r₁²Δ − (q₁²B − 2q₁q₂C + q₂²A). In the plane Δ = A, N = r₁²A − q₁², and n is a turned by a right angle.
pub struct Meeting<'p, const S: usize, const M: usize> {
    d: usize,
    from: &'p Place<S, M>,
    a: Place<S, M>,
    b: Place<S, M>,
    along: Model<S, M>,
    across: Model<S, M>,
    /// Δ.
    pub width: Model<S, M>,
    /// N.
    pub square: Model<S, M>,
}

impl<'p, const S: usize, const M: usize> Meeting<'p, S, M> {
    /// Of the point `new`, whose radii that are no distances of the problem are parameters. What a distance must be is
    /// known better than what the models say.
    pub fn new(
        square: impl Fn(usize, usize) -> Option<Number>,
        new: usize,
        centres: &[(usize, Radius)],
        points: &'p [Place<S, M>],
        parameter: impl Fn(usize) -> Model<S, M>,
    ) -> Option<Self> {
        let d = centres.len();
        let at = |k: usize| &points[centres[k].0];
        let radius = |k: usize| match centres[k] {
            (centre, Radius::Given) => square(new, centre).map(Model::constant),
            (_, Radius::Parameter(i)) => Some(parameter(i)),
        };
        let given = |i: usize, j: usize| square(centres[i].0, centres[j].0).map(Model::constant);
        let from = at(0);
        let a = minus(d, at(1), from);
        let (r1, big_a) = (radius(0)?, given(0, 1).unwrap_or_else(|| dot(d, &a, &a)));
        let part = |r: Model<S, M>, big: &Model<S, M>| r1.minus(&r).plus(big).scaled(0.5);
        let q1 = part(radius(1)?, &big_a);
        if d == 2 {
            return Some(Meeting {
                d,
                from,
                a,
                b: a,
                along: q1,
                across: Model::ZERO,
                width: big_a,
                square: r1.times(&big_a).minus(&q1.squared()),
            });
        }
        let b = minus(d, at(2), from);
        let big_b = given(0, 2).unwrap_or_else(|| dot(d, &b, &b));
        let c = match given(1, 2) {
            Some(third) => big_a.plus(&big_b).minus(&third).scaled(0.5),
            None => dot(d, &a, &b),
        };
        let q2 = part(radius(2)?, &big_b);
        let width = big_a.times(&big_b).minus(&c.squared());
        let along = q1.times(&big_b).minus(&q2.times(&c));
        let across = q2.times(&big_a).minus(&q1.times(&c));
        let off = along.times(&q1).plus(&across.times(&q2));
        let square = r1.times(&width).minus(&off);
        Some(Meeting {
            d,
            from,
            a,
            b,
            along,
            across,
            width,
            square,
        })
    }

    /// 1/Δ, which may be unknown.
    pub fn over(&self) -> Model<S, M> {
        self.width.reciprocal(self.width.range())
    }

    /// The middle and the normal, where 1/Δ is `over`.
    pub fn places(&self, over: &Model<S, M>) -> [Place<S, M>; 2] {
        let (a, out) = (factors(&self.a), over.factor());
        let along = self.along.times(over);
        let along = along.factor();
        let middle = if self.d == 2 {
            each(2, |k| combined(&self.from[k], [(1.0, a[k], along)]))
        } else {
            let (b, across) = (factors(&self.b), self.across.times(over));
            let across = across.factor();
            each(3, |k| {
                combined(&self.from[k], [(1.0, a[k], along), (1.0, b[k], across)])
            })
        };
        let normal = normal(self.d, &self.a, &self.b);
        let normal = each(self.d, |k| {
            combined(&Model::ZERO, [(1.0, normal[k].factor(), out)])
        });
        [middle, normal]
    }
}

/// middle + normal · height, or middle − normal · height.
pub fn beside<const S: usize, const M: usize>(
    d: usize,
    [middle, normal]: &[Place<S, M>; 2],
    sign: f64,
    height: &Model<S, M>,
) -> Place<S, M> {
    let height = height.factor();
    each(d, |k| {
        combined(&middle[k], [(sign, normal[k].factor(), height)])
    })
}
