//! The families.

use super::bars::{self, Linkage, Place};
use super::polynomial::root;
use super::{Answer, trees};
use krawl::problem::{Decimal, Problem, ProblemBuilder};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

/// Problems that get harder as a parameter gets smaller.
pub struct Family {
    pub name: &'static str,
    /// What the parameter is.
    pub parameter: &'static str,
    /// The problem at the parameter 10^-k.
    pub make: fn(i32) -> Problem,
    /// What must come out.
    pub answer: fn(&Problem) -> Answer,
    /// The k that make sense.
    pub range: std::ops::RangeInclusive<i32>,
}

impl Family {
    pub fn at(&self, k: i32) -> (Problem, Answer) {
        let problem = (self.make)(k);
        let answer = (self.answer)(&problem);
        (problem, answer)
    }
}

fn ten_to(exponent: i32) -> BigRational {
    let power = BigRational::from(BigInt::from(10).pow(exponent.unsigned_abs()));
    if exponent < 0 { power.recip() } else { power }
}

fn ratio(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// The number as a decimal, cut off after so many digits behind the point.
fn cut(x: &BigRational, digits: i32) -> Decimal {
    let scaled = (x * ten_to(digits)).round().to_integer();
    format!("{scaled}e-{digits}").parse().expect("a decimal")
}

fn decimal(x: &BigRational) -> Decimal {
    (0..)
        .map(|digits| cut(x, digits))
        .take(150)
        .find(|d| d.value() == x)
        .expect("a number with few digits")
}

fn text(x: &str) -> BigRational {
    x.parse::<Decimal>().expect("a decimal").value().clone()
}

/// A new point joined to `to`, with its target lengths.
fn joined(
    mut builder: ProblemBuilder,
    name: &str,
    place: &[&str],
    to: &[(&str, BigRational)],
) -> ProblemBuilder {
    builder = builder.point(name, place.iter().copied());
    for (other, length) in to {
        builder = builder.distance(other, name, decimal(length));
    }
    builder
}

/// Two triangles on one edge that become flat at t = 1.25 but for little: there two pieces of
/// path pass each other at a distance of about 10^-k. `longer`: the first is flat before the
/// second, which is flat below t = 0 too.
fn flaps(k: i32, sign: i64) -> Problem {
    let epsilon = ten_to(-2 * k) * ratio(19, 1000) * ratio(sign, 1);
    let base = Problem::build(&format!("flaps-{k}"), 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .distance("a", "b", 6);
    let side = text("3.4") - epsilon;
    let builder = joined(base, "p", &["3", "4"], &[("a", side.clone()), ("b", side)]);
    let builder = joined(
        builder,
        "q",
        &["3", "-4"],
        &[("a", text("3.65")), ("b", text("3.65"))],
    );
    builder
        .reference(["a", "b"])
        .bend(["b", "q"])
        .bend_coefficient(2)
        .finish()
        .expect("a problem")
}

/// The same with two tetrahedra on a right triangle, with their apexes above the middle of its
/// longest side.
fn tents(k: i32, sign: i64) -> Problem {
    let epsilon = ten_to(-2 * k) * ratio(2, 100) * ratio(sign, 1);
    let base = Problem::build(&format!("tents-{k}"), 3)
        .point("a", [0, 0, 0])
        .point("b", [3, 0, 0])
        .point("c", [0, 4, 0])
        .distance("a", "b", 3)
        .distance("a", "c", 4)
        .distance("b", "c", 5);
    let side = text("3.3") - epsilon;
    let legs = |last: BigRational, side: BigRational| {
        [("a", side.clone()), ("b", side), ("c", last)]
    };
    let builder = joined(base, "p", &["1.5", "2", "6"], &legs(side.clone(), side));
    let builder = joined(
        builder,
        "q",
        &["1.5", "2", "-6"],
        &legs(text("3.8"), text("3.3")),
    );
    builder
        .reference(["a", "b", "c"])
        .bend(["c", "q"])
        .bend_coefficient(2)
        .finish()
        .expect("a problem")
}

/// Places a, b, c, d, e and f of a platform on three bars and the point that it is driven to.
fn platform(name: &str, places: &[Place; 6], target: BigRational) -> Problem {
    let names = ["a", "b", "c", "d", "e", "f"];
    let mut builder = Problem::build(name, 2);
    for (name, place) in names.iter().zip(places) {
        builder = builder.point(name, place.each_ref().map(decimal));
    }
    let edges = [
        [0, 1],
        [1, 5],
        [0, 5],
        [2, 3],
        [3, 4],
        [2, 4],
        [0, 2],
        [1, 3],
    ];
    for [i, j] in edges {
        let square = (0..2).fold(BigRational::zero(), |sum, k| {
            let d = &places[i][k] - &places[j][k];
            sum + &d * &d
        });
        builder = builder.squared_distance(names[i], names[j], decimal(&square));
    }
    builder
        .squared_distance("e", "f", decimal(&target))
        .reference(["a", "b"])
        .bend(["e", "f"])
        .bend_coefficient(0)
        .finish()
        .expect("a problem")
}

/// A parallelogram linkage with one side a little longer, `crank` the one that turns or the one
/// across: where all four points are nearly on a line two motions pass each other.
fn parallelogram(k: i32, crank: bool, sign: i64) -> Problem {
    let epsilon = ten_to(-2 * k) * ratio(sign, 10);
    let change = if crank {
        [BigRational::zero(), epsilon]
    } else {
        [&epsilon * ratio(4, 1), &epsilon * ratio(-3, 1)]
    };
    let d = [text("5.2") + &change[0], text("1.6") + &change[1]];
    let places: [Place; 6] = [
        ["0", "0"].map(text),
        ["4", "0"].map(text),
        ["1.2", "1.6"].map(text),
        d,
        ["3.5", "2.9"].map(text),
        ["2.5", "-1.1"].map(text),
    ];
    platform(&format!("parallelogram-{k}"), &places, text("9.3"))
}

/// Three solutions on 2·10^-k of a platform's path.
fn triple(k: i32) -> Problem {
    let mut places: [Place; 6] = [
        ["0", "0"].map(text),
        ["4", "0"].map(text),
        ["1.2", "1.6"].map(text),
        ["5.6", "2.3"].map(text),
        ["3.5", "3.9"].map(text),
        ["0", "0"].map(text),
    ];
    let linkage = Linkage::new(&places);
    let start = linkage.half_tangent() + ratio(3, 10);
    let [p, q, r] = [0, 1, 2].map(|j| {
        let u = &start + ten_to(-k) * ratio(j, 2);
        linkage.figure(&u).e
    });
    // The circle through three places of e; where the curve is bent the other way there are more.
    let side = |a: &Place, b: &Place| -> (Place, BigRational) {
        let normal: Place = std::array::from_fn(|i| &b[i] - &a[i]);
        let value = (0..2).fold(BigRational::zero(), |sum, i| {
            sum + (&b[i] * &b[i] - &a[i] * &a[i]) * ratio(1, 2)
        });
        (normal, value)
    };
    let ((n, v), (m, w)) = (side(&p, &q), side(&q, &r));
    let det = &n[0] * &m[1] - &n[1] * &m[0];
    let f = [
        (&v * &m[1] - &w * &n[1]) / &det,
        (&n[0] * &w - &m[0] * &v) / &det,
    ];
    places[5] = f.map(|x| cut(&x, 55).value().clone());
    let radius = (0..2).fold(BigRational::zero(), |sum, i| {
        let d = &q[i] - &places[5][i];
        sum + &d * &d
    });
    platform(
        &format!("triple-{k}"),
        &places,
        cut(&radius, 55).value().clone(),
    )
}

/// A triangle that at t = 1 is flat but for little: two solutions 10^-k from one another, or none.
fn fold(k: i32, sign: i64) -> Problem {
    let base = ratio(6, 1) + ten_to(-2 * k) * ratio(sign, 10);
    let builder = Problem::build(&format!("fold-{k}"), 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .point("c", [3, 4])
        .distance("a", "b", decimal(&base))
        .distance("b", "c", 3)
        .distance("c", "a", 3)
        .reference(["a", "b"])
        .bend(["b", "c"])
        .bend_coefficient(1);
    builder.finish().expect("a problem")
}

/// The same with a tetrahedron over a right triangle.
fn peak(k: i32, sign: i64) -> Problem {
    let side = text("2.5") - ten_to(-2 * k) * ratio(sign, 20);
    let base = Problem::build(&format!("peak-{k}"), 3)
        .point("a", [0, 0, 0])
        .point("b", [3, 0, 0])
        .point("c", [0, 4, 0])
        .distance("a", "b", 3)
        .distance("a", "c", 4)
        .distance("b", "c", 5);
    let legs = [("a", side.clone()), ("b", side.clone()), ("c", side)];
    joined(base, "p", &["1.5", "2", "6"], &legs)
        .reference(["a", "b", "c"])
        .bend(["c", "p"])
        .bend_coefficient(1)
        .finish()
        .expect("a problem")
}

/// A triangle over an edge that bends so that around t = 0.5 it is nearly as long as the two other
/// sides together (`sign` 1), or longer (−1): circles nearly tangent, and the mirror image's path
/// at a distance of 10^-k.
fn graze(k: i32, sign: i64) -> Problem {
    // |ac| + |bc| = 10 − 2 t; |ab| = 6 + (c + δ) t − c t² is tangent to it at t = ½ for c = 16,
    // δ = −2.
    let epsilon = ten_to(-2 * k) * ratio(sign, 10);
    Problem::build(&format!("graze-{k}"), 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .point("c", ["3", "4"])
        .distance("a", "b", 4)
        .distance("b", "c", decimal(&(text("3.5") + &epsilon)))
        .distance("c", "a", decimal(&(text("4.5") + &epsilon)))
        .reference(["b", "c"])
        .bend(["a", "b"])
        .bend_coefficient(16)
        .finish()
        .expect("a problem")
}

/// Ten triangles over one bending edge that are nearly flat at different t: near-boundary
/// configurations one after the other.
fn crowd(k: i32) -> Problem {
    let epsilon = ten_to(-2 * k) * ratio(1, 10);
    let mut builder = Problem::build(&format!("crowd-{k}"), 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .distance("a", "b", 6);
    // |ab| = 6 + 8 t − 8 t². Its tangent at t₀ is 6 + 8 t₀² + (8 − 16 t₀) t.
    for j in 0..10 {
        let at = ratio(j + 1, 16);
        let semi = text("3") + text("4") * &at * &at;
        let name = format!("c{j}");
        // A point of the ellipse |ac| + |bc| = 2 semi with the foci a and b.
        let x = ratio(j - 4, 4);
        let [near, far] = [1, -1].map(|s| &semi + text("3") * ratio(s, 1) / &semi * &x);
        let foot = &x + text("3");
        let y = cut(&root(&(&near * &near - &foot * &foot)), 55);
        builder = builder.point(&name, [decimal(&foot), y]);
        // Half of what the sum of the two gains from t = 0 to t = 1.
        let gain = text("4") - text("8") * &at + &epsilon;
        for (other, length) in [("a", near), ("b", far)] {
            builder = builder.distance(other, &name, cut(&(length + &gain), 55));
        }
    }
    builder
        .reference(["a", "c9"])
        .bend(["a", "b"])
        .bend_coefficient(8).finish().expect("a problem")
}

pub const FAMILIES: &[Family] = &[
    Family {
        name: "flaps-split",
        parameter: "distance of two pieces of the path",
        make: |k| flaps(k, 1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "flaps-apart",
        parameter: "distance of two components",
        make: |k| flaps(k, -1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "tents-split",
        parameter: "distance of two pieces of the path",
        make: |k| tents(k, 1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "tents-apart",
        parameter: "distance of two components",
        make: |k| tents(k, -1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "parallelogram-crank",
        parameter: "about the distance of two components",
        make: |k| parallelogram(k, true, 1),
        answer: |p| bars::answer(p, 0),
        range: 1..=12,
    },
    Family {
        name: "parallelogram-coupler",
        parameter: "about the distance of two pieces of the path",
        make: |k| parallelogram(k, false, 1),
        answer: |p| bars::answer(p, 0),
        range: 1..=12,
    },
    Family {
        name: "triple",
        parameter: "distance of three solutions",
        make: triple,
        answer: |p| bars::answer(p, 3),
        range: 1..=10,
    },
    Family {
        name: "fold",
        parameter: "half the distance of two solutions",
        make: |k| fold(k, -1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "fold-missed",
        parameter: "distance of a flat figure",
        make: |k| fold(k, 1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "peak",
        parameter: "half the distance of two solutions",
        make: |k| peak(k, -1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "graze",
        parameter: "distance of mirror images",
        make: |k| graze(k, 1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "graze-stopped",
        parameter: "distance of mirror images",
        make: |k| graze(k, -1),
        answer: trees::answer,
        range: 1..=12,
    },
    Family {
        name: "crowd",
        parameter: "distance of mirror images, ten times",
        make: crowd,
        answer: trees::answer,
        range: 1..=12,
    },
];
