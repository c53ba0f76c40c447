//! The families.

use super::bars::{self, Linkage, Place};
use super::polynomial::root;
use super::{Answer, trees};
use krawl::problem::{Decimal, Problem, ProblemBuilder};
use krawl::rational::Rational;
use num_bigint::BigInt;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::sync::Mutex;

/// Problems that get harder as a parameter gets smaller.
pub struct Family {
    pub name: &'static str,
    /// What is hard about it.
    pub hard: &'static str,
    /// What the parameter is.
    pub parameter: &'static str,
    /// The problem at the parameter 10^-k.
    make: fn(i32) -> Problem,
    /// What must come out.
    answer: fn(&Problem) -> Answer,
    /// The k that make sense.
    pub range: RangeInclusive<i32>,
    /// Certified runs in the default space close up to this k without extended precision. They may close
    /// beyond.
    pub proved_in_53_bits: i32,
    /// The same of runs as they are made unless told otherwise.
    pub proved: i32,
    /// The k of the files in `problems/hard`.
    pub files: &'static [i32],
}

impl Family {
    /// A family of which all but the files and the proved part is said.
    pub const fn new(
        name: &'static str,
        hard: &'static str,
        parameter: &'static str,
        make: fn(i32) -> Problem,
        answer: fn(&Problem) -> Answer,
        range: RangeInclusive<i32>,
    ) -> Self {
        Family {
            name,
            hard,
            parameter,
            make,
            answer,
            range,
            proved_in_53_bits: -1,
            proved: -1,
            files: &[],
        }
    }

    /// With the k up to which certified runs close, in 53 bits and in all, and those of the files.
    pub const fn proved(self, in_53_bits: i32, proved: i32, files: &'static [i32]) -> Self {
        Family {
            proved_in_53_bits: in_53_bits,
            proved,
            files,
            ..self
        }
    }

    /// The problem at the parameter 10^-k.
    pub fn problem(&self, k: i32) -> Problem {
        let mut problem = (self.make)(k);
        problem.name = if self.parameter.is_empty() {
            self.name.to_owned()
        } else {
            format!("{}-{k}", self.name)
        };
        problem.source = "krawl, tests/common/hard".to_owned();
        problem
    }

    /// What must come out of it; worked out once.
    pub fn answer(&self, k: i32) -> Answer {
        static KNOWN: Mutex<BTreeMap<String, Answer>> = Mutex::new(BTreeMap::new());
        let problem = self.problem(k);
        let known = KNOWN.lock().unwrap().get(&problem.name).copied();
        known.unwrap_or_else(|| {
            let answer = (self.answer)(&problem);
            KNOWN.lock().unwrap().insert(problem.name, answer);
            answer
        })
    }
}

pub fn ten_to(exponent: i32) -> Rational {
    let power = Rational::from(BigInt::from(10).pow(exponent.unsigned_abs()));
    if exponent < 0 { power.recip() } else { power }
}

pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The number as a decimal, cut off after so many digits behind the point.
pub fn cut(x: &Rational, digits: i32) -> Decimal {
    let scaled = (x * ten_to(digits)).round().to_integer();
    format!("{scaled}e-{digits}").parse().expect("a decimal")
}

pub fn decimal(x: &Rational) -> Decimal {
    (0..)
        .map(|digits| cut(x, digits))
        .take(150)
        .find(|d| d.value() == x)
        .expect("a number with few digits")
}

pub fn text(x: &str) -> Rational {
    x.parse::<Decimal>().expect("a decimal").value().clone()
}

/// A new point joined to `to`, with its target lengths.
pub fn joined(
    mut builder: ProblemBuilder,
    name: &str,
    place: &[&str],
    to: &[(&str, Rational)],
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
pub fn flaps(k: i32, sign: i64) -> Problem {
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
    let legs = |last: Rational, side: Rational| [("a", side.clone()), ("b", side), ("c", last)];
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
fn platform(name: &str, places: &[Place; 6], target: Rational) -> Problem {
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
        let square = (0..2).fold(Rational::zero(), |sum, k| {
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
        [Rational::zero(), epsilon]
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
    let side = |a: &Place, b: &Place| -> (Place, Rational) {
        let normal: Place = std::array::from_fn(|i| &b[i] - &a[i]);
        let value = (0..2).fold(Rational::zero(), |sum, i| {
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
    let radius = (0..2).fold(Rational::zero(), |sum, i| {
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
pub fn fold(k: i32, sign: i64) -> Problem {
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
pub fn graze(k: i32, sign: i64) -> Problem {
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
        let y = cut(&root(&(&near * &near - &foot * &foot)), 40);
        builder = builder.point(&name, [decimal(&foot), y]);
        // Half of what the sum of the two gains from t = 0 to t = 1.
        let gain = text("4") - text("8") * &at + &epsilon;
        for (other, length) in [("a", near), ("b", far)] {
            builder = builder.distance(other, &name, cut(&(length + &gain), 40));
        }
    }
    builder
        .reference(["a", "c9"])
        .bend(["a", "b"])
        .bend_coefficient(8)
        .finish()
        .expect("a problem")
}

const TWO_PIECES: &str = "two pieces of the path pass each other at the distance of the parameter, and to change \
     over means to lose half of the solutions";
const TWO_PATHS: &str = "another path passes at the distance of the parameter, and to change over means to find twice as \
     many solutions";

pub const FAMILIES: &[Family] = &[
    Family::new(
        "flaps-split",
        TWO_PIECES,
        "distance of the two pieces",
        |k| flaps(k, 1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[3, 8]),
    Family::new(
        "flaps-apart",
        TWO_PATHS,
        "distance of the two paths",
        |k| flaps(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[3]),
    Family::new(
        "tents-split",
        TWO_PIECES,
        "distance of the two pieces",
        |k| tents(k, 1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "tents-apart",
        TWO_PATHS,
        "distance of the two paths",
        |k| tents(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "parallelogram-crank",
        "where the four bars are nearly on a line, which they are twice, another motion of the linkage passes",
        "about the distance of the two paths",
        |k| parallelogram(k, true, 1),
        |p| bars::answer(p, 0),
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "parallelogram-coupler",
        "where the four bars are nearly on a line, which they are twice, two pieces of the motion pass each other",
        "about the distance of the two pieces",
        |k| parallelogram(k, false, 1),
        |p| bars::answer(p, 0),
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "triple",
        "three solutions about to merge: t = 1 is met three times in a row, between two folds",
        "distance of the outer two of three solutions",
        triple,
        |p| {
            // The samples tell those apart that are 1e-3 from one another.
            let together = !["triple-1", "triple-2", "triple-3"].contains(&p.name.as_str());
            bars::answer(p, if together { 3 } else { 0 })
        },
        1..=10,
    )
    .proved(2, 5, &[2, 3]),
    Family::new(
        "fold",
        "two solutions about to merge, on either side of a flat triangle",
        "half the distance of the two solutions",
        |k| fold(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(5, 12, &[5, 8]),
    Family::new(
        "fold-missed",
        "the path turns back just before t = 1, in a flat triangle",
        "how far two solutions would be from there if it went on as long again",
        |k| fold(k, 1),
        trees::answer,
        1..=12,
    )
    .proved(5, 12, &[5]),
    Family::new(
        "peak",
        "two solutions about to merge, on either side of a flat tetrahedron",
        "half the distance of the two solutions",
        |k| peak(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(4, 12, &[4]),
    Family::new(
        "graze",
        "two circles nearly tangent around t = 0.5, and the path of mirror images near",
        "about the distance of the mirror images",
        |k| graze(k, 1),
        trees::answer,
        1..=12,
    )
    .proved(4, 10, &[4]),
    Family::new(
        "graze-stopped",
        "two circles that part just before t = 0.5 and meet again soon after: another path lies on the other side",
        "about the distance of the other path",
        |k| graze(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(4, 10, &[4]),
    Family::new(
        "crowd",
        "ten points, one after the other near a boundary configuration, so that plans must change often, \
         and each time the path with this point on the other side is near",
        "about the distance of the other path, ten times",
        crowd,
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[2]),
];
