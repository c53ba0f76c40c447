//! Families near the boundary of a construction: spheres nearly tangent along the path, and points
//! whose distance γ from a boundary configuration stays at the threshold α of plans.

use super::families::{cut, decimal, joined, ratio, ten_to, text};
use super::polynomial::root;
use super::{Family, trees};
use krawl::problem::{Decimal, Problem, ProblemBuilder};
use krawl::rational::{Rational, exact};
use krawl::track::Options;

/// Digits behind the point of lengths that are no decimals.
const DIGITS: i32 = 40;

fn square(x: &Rational) -> Rational {
    x * x
}

/// A tetrahedron over an edge a b that bends so that around t = 0.5 it is nearly as long as the two
/// edges from its ends to the apex p together (`sign` 1), or longer (−1): the spheres around a and b on
/// which p is are nearly tangent, and meet in a circle of about the parameter's radius. The sphere
/// around c goes through its middle there.
fn graze_spheres(k: i32, sign: i64) -> Problem {
    // As `families::graze`: |pa| + |pb| = 10 − 2 t, and |ab| is tangent to it at t = ½, where they
    // are 9. There p is on a b, at 4.75 from a, and by Stewart's theorem |pc|² is
    // (4.25 |ac|² + 4.75 |bc|²) / 9 − 4.75 · 4.25, with |ac| = |bc| = 7.5 in the middle between the
    // sketch's 7.8 and the target's 7.2.
    let epsilon = ten_to(-2 * k) * ratio(sign, 10);
    let middle = root(&(square(&text("7.5")) - text("4.75") * text("4.25")));
    let sketch = root(&text("33.28"));
    let last = middle * ratio(2, 1) - sketch;
    let builder = Problem::build(&format!("graze-spheres-{k}"), 3)
        .point("a", [0, 0, 0])
        .point("b", [6, 0, 0])
        .point("c", ["3", "7.2", "0"])
        .distance("a", "b", 4)
        .distance("a", "c", "7.2")
        .distance("b", "c", "7.2");
    let legs = [("a", text("4.5") + &epsilon), ("b", text("3.5") + &epsilon)];
    joined(builder, "p", &["3", "2.4", "3.2"], &legs)
        .distance("c", "p", cut(&last, DIGITS))
        .reference(["a", "b", "c"])
        .bend(["a", "b"])
        .bend_coefficient(16)
        .finish()
        .expect("a problem")
}

/// How an angle is measured that is to be small.
#[derive(Clone, Copy)]
enum Measure {
    /// γ of the plans: the height of a triangle over its longer arm (which is less than its base).
    Gamma,
    /// The sine of the angle between its arms, by which the certified reduced space chooses.
    Sine,
}

/// The other arm of a flat triangle over `base` with one arm and this γ or sine.
fn other_arm(base: &Rational, arm: &Rational, measure: Measure, value: &Rational) -> Rational {
    let cosine = root(&(ratio(1, 1) - square(value)));
    match measure {
        Measure::Gamma => {
            let foot = arm * cosine;
            root(&(square(&(arm * value)) + square(&(base - foot))))
        }
        // base² = arm² + x² + 2 arm x cosine: the angle is obtuse.
        Measure::Sine => {
            let along = arm * cosine;
            root(&(square(&along) - square(arm) + square(base))) - along
        }
    }
}

/// A place at these distances from two others, to the left of the line between them.
fn apex(a: &[Rational; 2], b: &[Rational; 2], arms: [&Rational; 2]) -> [Rational; 2] {
    let line: [Rational; 2] = std::array::from_fn(|i| &b[i] - &a[i]);
    let base = square(&line[0]) + square(&line[1]);
    let along = (&base + square(arms[0]) - square(arms[1])) / (&base * ratio(2, 1));
    let height = root(&(square(arms[0]) / &base - square(&along)));
    let place = [
        &a[0] + &along * &line[0] - &height * &line[1],
        &a[1] + &along * &line[1] + &height * &line[0],
    ];
    place.map(|x| cut(&x, DIGITS).value().clone())
}

/// Directions of distances are told apart by sines of so many times α (docs/how/tubes.md).
pub const SINES: f64 = 2.5;

/// Four triangles whose γ, or sine of the angle at the apex, comes down to the threshold of plans but for
/// the parameter, from above (`sign` 1) or beyond it (−1).
///
/// The edge a b bends: it is 6 long in the sketch and in the target and 8 at t = ½, where p and q are
/// flattest, p by γ and q by its sine. r and s are so on the whole path, r by γ and s by its sine.
fn threshold(k: i32, sign: i64) -> Problem {
    let off = ten_to(-k) * ratio(sign, 1);
    let alpha = exact(Options::certified().alpha);
    let (gamma, sine) = (&alpha + &off, &alpha * exact(SINES) + &off);
    let longest = ratio(8, 1);
    let (a, b) = ([ratio(0, 1), ratio(0, 1)], [ratio(6, 1), ratio(0, 1)]);
    let short = |x: Rational| cut(&x, DIGITS).value().clone();
    let pa = ratio(5, 1);
    let pb = short(other_arm(&longest, &pa, Measure::Gamma, &gamma));
    let p = apex(&a, &b, [&pa, &pb]);
    let qa = text("4.5");
    let qb = short(other_arm(&longest, &qa, Measure::Sine, &sine));
    // On the other side.
    let [x, y] = apex(&a, &b, [&qa, &qb]);
    let q = [x, -y];
    let ra = ratio(3, 1);
    let rp = short(other_arm(&pa, &ra, Measure::Gamma, &gamma));
    let r = apex(&a, &p, [&ra, &rp]);
    let sb = ratio(2, 1);
    let sq = short(other_arm(&qb, &sb, Measure::Sine, &sine));
    let s = apex(&b, &q, [&sb, &sq]);
    let new = |builder: ProblemBuilder, name, place: [Rational; 2], to: [(&str, &Rational); 2]| {
        let builder = builder.point(name, place.map(|x| decimal(&x)));
        to.iter().fold(builder, |builder, (other, length)| {
            builder.distance(other, name, decimal(length))
        })
    };
    let mut builder = Problem::build(&format!("threshold-{k}"), 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .distance("a", "b", 6);
    builder = new(builder, "p", p, [("a", &pa), ("b", &pb)]);
    builder = new(builder, "q", q, [("a", &qa), ("b", &qb)]);
    builder = new(builder, "r", r, [("a", &ra), ("p", &rp)]);
    builder = new(builder, "s", s, [("b", &sb), ("q", &sq)]);
    builder
        .reference(["a", "b"])
        .bend(["a", "b"])
        .bend_coefficient(Decimal::from(8))
        .finish()
        .expect("a problem")
}

const THRESHOLD: &str = "how much γ is from α";

pub const FAMILIES: &[Family] = &[
    Family::new(
        "graze-spheres",
        "two spheres nearly tangent around t = 0.5, a third through the small circle in which they meet, and the path \
         of mirror images near",
        "about the distance of the mirror images",
        |k| graze_spheres(k, 1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "graze-spheres-stopped",
        "two spheres that part just before t = 0.5 and meet again soon after: another path lies on the other side",
        "about the distance of the other path",
        |k| graze_spheres(k, -1),
        trees::answer,
        1..=12,
    )
    .proved(4, 11, &[4]),
    Family::new(
        "threshold",
        "points whose γ comes down to the threshold α of plans or keeps to it, from above: to change the plan or not is \
         open at each step",
        THRESHOLD,
        |k| threshold(k, 1),
        trees::answer,
        2..=15,
    )
    .proved(15, 15, &[9]),
    Family::new(
        "threshold-crossed",
        "points whose γ keeps just below the threshold α of plans, or goes there and comes back",
        THRESHOLD,
        |k| threshold(k, -1),
        trees::answer,
        2..=15,
    )
    .proved(15, 15, &[9]),
];
