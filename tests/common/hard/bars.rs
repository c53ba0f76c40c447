//! Platforms on three bars (the graph of `problems/prism.toml`) of which all lengths but one keep
//! their values, so that the path is a component of a four-bar linkage's motion.
//!
//! Base a b f, platform c d e, bars a-c, b-d, e-f. The four bars a b d c move with one degree of
//! freedom, and e goes along. The length of e-f, which is that of the sketch at t = 0 and the target
//! at t = 1, goes linearly between and beyond them (a bend with the coefficient 0): it says what t
//! is. So the path is the sketch's component of the linkage's motion, once round.

use super::Answer;
use super::polynomial::root;
use krawl::problem::{Problem, Target};
use krawl::rational::Rational;
use std::f64::consts::PI;

pub type Place = [Rational; 2];

fn squared(a: &Place, b: &Place) -> Rational {
    let d: Place = std::array::from_fn(|k| &a[k] - &b[k]);
    &d[0] * &d[0] + &d[1] * &d[1]
}

/// The linkage of a sketch, in the frame that has a at the origin and b on the first axis.
#[derive(Debug, Clone)]
pub struct Linkage {
    /// |ab|, |ac|, |cd|, |bd|, in this order.
    sides: [Rational; 4],
    /// e in the frame of c and d.
    e: Place,
    /// f.
    f: Place,
    /// Where c is in the sketch, in that frame, and on which side of the line from c to b d is.
    c: Place,
    left: bool,
}

/// One place of the linkage.
pub struct Figure {
    pub c: Place,
    pub d: Place,
    pub e: Place,
}

fn cross(u: &Place, v: &Place) -> Rational {
    &u[0] * &v[1] - &u[1] * &v[0]
}

fn dot(u: &Place, v: &Place) -> Rational {
    &u[0] * &v[0] + &u[1] * &v[1]
}

fn minus(a: &Place, b: &Place) -> Place {
    std::array::from_fn(|k| &a[k] - &b[k])
}

/// `p` in the frame with the origin `o` and the first axis towards `x`, to 250 binary digits.
fn in_frame(o: &Place, x: &Place, p: &Place) -> Place {
    let axis = minus(x, o);
    let length = root(&dot(&axis, &axis));
    let p = minus(p, o);
    [dot(&axis, &p) / &length, cross(&axis, &p) / &length]
}

impl Linkage {
    /// From the sketch [a, b, c, d, e, f].
    pub fn new(sketch: &[Place; 6]) -> Self {
        let [a, b, c, d, e, f] = sketch;
        let length = |p: &Place, q: &Place| root(&squared(p, q));
        Linkage {
            sides: [length(a, b), length(a, c), length(c, d), length(b, d)],
            e: in_frame(c, d, e),
            f: in_frame(a, b, f),
            c: in_frame(a, b, c),
            left: cross(&minus(b, c), &minus(d, c)).is_positive(),
        }
    }

    pub fn f(&self) -> &Place {
        &self.f
    }

    /// The tangent of half the crank's angle in the sketch.
    pub fn half_tangent(&self) -> Rational {
        &self.c[1] / (&self.sides[1] + &self.c[0])
    }

    /// The place with the given tangent of half the crank's angle, d on the side of the sketch.
    pub fn figure(&self, half_tangent: &Rational) -> Figure {
        let [ab, ac, cd, bd] = &self.sides;
        let (one, u) = (Rational::one(), half_tangent);
        let scale = (&one + u * u).recip();
        let two = &one + &one;
        let c: Place = [ac * (&one - u * u) * &scale, ac * &two * u * &scale];
        let b: Place = [ab.clone(), Rational::zero()];
        // d from the circles around c and b.
        let axis = minus(&b, &c);
        let q = dot(&axis, &axis);
        let along = (&q + cd * cd - bd * bd) / (&two * &q);
        let height = root(&(cd * cd / &q - &along * &along));
        let height = if self.left { height } else { -height };
        let d: Place = [
            &c[0] + &along * &axis[0] - &height * &axis[1],
            &c[1] + &along * &axis[1] + &height * &axis[0],
        ];
        let axis = minus(&d, &c).map(|x| x / cd);
        let e: Place = [
            &c[0] + &axis[0] * &self.e[0] - &axis[1] * &self.e[1],
            &c[1] + &axis[1] * &self.e[0] + &axis[0] * &self.e[1],
        ];
        Figure { c, d, e }
    }

    /// |ef| at `samples` places once round the sketch's component of the motion, in floats.
    ///
    /// c goes round where the diagonal b-c is long and short enough for the triangle b c d.
    /// If it goes all the way round, d keeps to its side; otherwise d changes sides where c
    /// turns back.
    fn once_round(&self, samples: usize) -> Option<Vec<f64>> {
        let [ab, ac, cd, bd] = &self.sides;
        let shortest = (cd - bd).abs();
        let longest = cd + bd;
        let (near, far) = ((ab - ac).abs(), ab + ac);
        // Flat triangles at the ends of the diagonal's range: a crossing of two motions.
        if near == shortest || far == longest {
            return None;
        }
        let cosine = |diagonal: &Rational| {
            let two = Rational::from_integer(2.into());
            ((ab * ab + ac * ac - diagonal * diagonal) / (two * ab * ac)).to_f64()
        };
        let inner = near < shortest;
        let outer = far > longest;
        // The angles that the crank can have, if not all.
        let least = if inner { cosine(&shortest).acos() } else { 0.0 };
        let most = if outer { cosine(&longest).acos() } else { PI };
        let upper = self.c[1].is_positive();
        let arc = match (inner, outer) {
            (false, false) => None,
            // Through 0, through π, or on one side of the line a b.
            (false, true) => Some((-most, most)),
            (true, false) => Some((least, 2.0 * PI - least)),
            (true, true) if upper => Some((least, most)),
            (true, true) => Some((-most, -least)),
        };
        let at = |k: usize| {
            let turn = 2.0 * PI * (k as f64 + 0.5) / samples as f64;
            match arc {
                None => self.distance_at(turn, self.left),
                Some((lo, hi)) => {
                    let angle = 0.5 * (lo + hi) - 0.5 * (hi - lo) * turn.cos();
                    self.distance_at(angle, turn < PI)
                }
            }
        };
        Some((0..samples).map(at).collect())
    }

    fn distance_at(&self, angle: f64, left: bool) -> f64 {
        let [ab, ac, cd, bd] = self.sides.each_ref().map(|x| x.to_f64());
        let [ex, ey] = self.e.each_ref().map(|x| x.to_f64());
        let [fx, fy] = self.f.each_ref().map(|x| x.to_f64());
        let (cx, cy) = (ac * angle.cos(), ac * angle.sin());
        let (ux, uy) = (ab - cx, -cy);
        let q = ux * ux + uy * uy;
        let along = (q + cd * cd - bd * bd) / (2.0 * q);
        let height = (cd * cd / q - along * along).max(0.0).sqrt();
        let height = if left { height } else { -height };
        let (vx, vy) = (
            (along * ux - height * uy) / cd,
            (along * uy + height * ux) / cd,
        );
        (cx + vx * ex - vy * ey - fx).hypot(cy + vx * ey + vy * ex - fy)
    }
}

/// What must come out of such a problem, whose points are a, b, c, d, e, f in this order.
/// `close`: so many solutions lie closer together than the samples, which see them as one if their
/// number is odd and as none if it is even.
pub fn answer(problem: &Problem, close: usize) -> Answer {
    const SAMPLES: usize = 20_000;
    let sketch: [Place; 6] = std::array::from_fn(|p| {
        let [x, y, _] = &problem.points[p].sketch;
        [x.value().clone(), y.value().clone()]
    });
    let linkage = Linkage::new(&sketch);
    let Some(lengths) = linkage.once_round(SAMPLES) else {
        return Answer::NeverCloses;
    };
    let bend = &problem.distances[problem.homotopy.bend];
    let target = match &bend.target {
        Target::Length(x) => x.to_f64(),
        Target::SquaredLength(x) => x.to_f64().sqrt(),
    };
    assert!(
        problem.homotopy.bend_coefficient.value().is_zero(),
        "t must be a function of |ef|"
    );
    let signs: Vec<bool> = lengths.iter().map(|x| *x > target).collect();
    let seen = (0..SAMPLES)
        .filter(|&k| signs[k] != signs[(k + 1) % SAMPLES])
        .count();
    let solutions = seen + close / 2 * 2;
    Answer::Path {
        solutions,
        classes: solutions,
    }
}
