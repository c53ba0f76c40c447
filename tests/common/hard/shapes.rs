//! Families that are ill-conditioned, and figures that are degenerate on purpose.

use super::families::{self, decimal, joined, ratio, ten_to, text};
use super::{Answer, Family, trees};
use crate::moves::scaled;
use crate::shipped;
use krawl::problem::{Decimal, Problem, ProblemBuilder};
use krawl::rational::Rational;

/// Lengths from 10^-k to 10^k: a triangle that long and so high beside one of equal sides.
fn lengths_apart(k: i32) -> Problem {
    let (long, short) = (ten_to(k), ten_to(-k));
    let times = |x: &Rational, factor: &str| decimal(&(x * text(factor)));
    Problem::build(&format!("lengths-{k}"), 2)
        .point("a", [Decimal::from(0), Decimal::from(0)])
        .point("b", [decimal(&long), Decimal::from(0)])
        .point("c", [times(&short, "0.3"), decimal(&short)])
        .point("d", [times(&long, "0.4"), times(&long, "0.9")])
        .distance("a", "b", decimal(&long))
        .distance("a", "d", decimal(&long))
        .distance("b", "d", times(&long, "1.1"))
        .distance("b", "c", decimal(&(&long + &short * text("0.1"))))
        .distance("a", "c", times(&short, "1.2"))
        .reference(["a", "b"])
        .bend(["a", "c"])
        .bend_coefficient(times(&short, "2"))
        .finish()
        .expect("a problem")
}

/// A reference triangle of height 10^-k, with two apexes.
fn sliver(k: i32) -> Problem {
    let height = ten_to(-k);
    let square = decimal(&(ratio(1, 1) + &height * &height));
    let builder = Problem::build(&format!("sliver-{k}"), 3)
        .point("a", ["0", "0", "0"])
        .point("b", ["2", "0", "0"])
        .point("c", [Decimal::from(1), decimal(&height), Decimal::from(0)]);
    // Over so thin a base the lengths of an apex must nearly fit: those of a point above the middle
    // of a b, changed by a fraction of the base's height.
    let apex = |builder: ProblemBuilder, name, height_of: &str| {
        let z = text(height_of);
        let side = &z * &z + ratio(1, 1) + &height * ratio(1, 5);
        let middle = &z * &z + &height * &height + &height * ratio(1, 10);
        builder
            .point(name, ["1", "0", height_of])
            .squared_distance("a", name, decimal(&side))
            .squared_distance("b", name, decimal(&side))
            .squared_distance("c", name, decimal(&middle))
    };
    let builder = apex(apex(builder, "p", "1.3"), "q", "-1");
    builder
        .distance("a", "b", 2)
        .squared_distance("a", "c", square.clone())
        .squared_distance("b", "c", square)
        .reference(["a", "b", "c"])
        .bend(["c", "q"])
        .bend_coefficient(decimal(&height))
        .finish()
        .expect("a problem")
}

/// Dixon's K(3, 3), three points on each of two lines at right angles, which is flexible; but the
/// squared lengths are up to 10^-k longer or shorter.
fn dixon(k: i32) -> Problem {
    let sketch = [
        ["0.36", "0.53"],
        ["-0.72", "0.37"],
        ["2.42", "-0.99"],
        ["-0.57", "1.72"],
        ["0.88", "-1.51"],
        ["0.46", "1.87"],
    ];
    // Changes of one sign all over leave no solution near the flexible figures.
    let changes = [["0", "1", "0"], ["-1", "0", "0.5"], ["0.3", "-0.7", "1"]];
    let (x, y) = (["1", "-1.6", "2.5"], ["1.1", "-2", "1.4"]);
    let mut builder = Problem::build(&format!("dixon-{k}"), 2);
    for (p, place) in sketch.iter().enumerate() {
        builder = builder.point(&format!("p{p}"), *place);
    }
    for (i, x) in x.iter().enumerate() {
        for (j, y) in y.iter().enumerate() {
            let mut square = text(x) * text(x) + text(y) * text(y);
            square += ten_to(-k) * text(changes[i][j]);
            let (a, b) = (format!("p{i}"), format!("p{}", j + 3));
            builder = builder.squared_distance(&a, &b, decimal(&square));
        }
    }
    builder
        .reference(["p0", "p3"])
        .bend(["p1", "p4"])
        .bend_coefficient("0.02")
        .finish()
        .expect("a problem")
}

fn octahedron_at(exponent: i32) -> Problem {
    let mut problem = scaled(&shipped("octahedron"), &ten_to(exponent));
    problem.name = format!("octahedron-e{exponent}");
    problem
}

/// Two triangles on a b, with these sketches of the first and these targets.
fn two_triangles(name: &str, c: [&str; 2], sides: [&str; 2]) -> Problem {
    Problem::build(name, 2)
        .point("a", [0, 0])
        .point("b", [6, 0])
        .point("c", c)
        .point("d", ["3", "-4"])
        .distance("a", "b", 6)
        .distance("a", "c", sides[0])
        .distance("b", "c", sides[1])
        .distance("a", "d", 5)
        .distance("b", "d", 5)
        .reference(["a", "b"])
        .bend(["b", "d"])
        .bend_coefficient(3)
        .finish()
        .expect("a problem")
}

/// A tetrahedron whose apex would have to be below its own base.
fn no_tetrahedron(_: i32) -> Problem {
    let base = Problem::build("no-tetrahedron", 3)
        .point("a", [0, 0, 0])
        .point("b", [3, 0, 0])
        .point("c", [0, 4, 0])
        .distance("a", "b", 3)
        .distance("a", "c", 4)
        .distance("b", "c", 5);
    let legs = ["a", "b", "c"].map(|p| (p, text("2.4")));
    joined(base, "p", &["1.5", "2", "6"], &legs)
        .reference(["a", "b", "c"])
        .bend(["c", "p"])
        .bend_coefficient(1)
        .finish()
        .expect("a problem")
}

/// Three sides of a square and the spokes to its middle: equal lengths, a symmetric sketch, and
/// a target that is as symmetric.
fn wheel(_: i32) -> Problem {
    Problem::build("wheel", 2)
        .point("a", [0, 0])
        .point("b", [2, 0])
        .point("e", [1, 1])
        .point("d", [0, 2])
        .point("c", [2, 2])
        .distance("a", "b", 2)
        .distance("a", "e", "1.5")
        .distance("b", "e", "1.5")
        .distance("a", "d", 2)
        .distance("d", "e", "1.5")
        .distance("b", "c", 2)
        .distance("c", "e", "1.5")
        .reference(["a", "b"])
        .bend(["c", "e"])
        .bend_coefficient(1)
        .finish()
        .expect("a problem")
}

/// The regular octahedron from itself, one edge longer: all lengths equal.
fn regular_octahedron(_: i32) -> Problem {
    let mut builder = Problem::build("regular-octahedron", 3);
    let places = [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [-1, 0, 0],
        [0, -1, 0],
        [0, 0, -1],
    ];
    for (p, place) in places.iter().enumerate() {
        builder = builder.point(&format!("p{p}"), *place);
    }
    for a in 0..6 {
        for b in (a + 1..6).filter(|b| b - a != 3) {
            builder = builder.squared_distance(&format!("p{a}"), &format!("p{b}"), 2);
        }
    }
    builder
        .reference(["p0", "p1", "p2"])
        .bend(["p3", "p4"])
        .bend_coefficient(-1)
        .finish()
        .expect("a problem")
}

const OCTAHEDRON: Answer = Answer::Path {
    solutions: 4,
    classes: 4,
};

/// A single figure, of which a certified run closes if `proved` is 0.
const fn single(
    name: &'static str,
    hard: &'static str,
    make: fn(i32) -> Problem,
    answer: fn(&Problem) -> Answer,
    proved: i32,
) -> Family {
    Family::new(name, hard, "", make, answer, 0..=0).proved(proved, proved, &[0])
}

pub const FAMILIES: &[Family] = &[
    Family::new(
        "lengths",
        "a long thin triangle beside a large one: lengths from the parameter to its inverse in one problem",
        "the shortest length; the longest is its inverse",
        lengths_apart,
        trees::answer,
        1..=6,
    )
    .proved(2, 3, &[1, 6]),
    Family::new(
        "sliver",
        "reference points that are nearly collinear",
        "height of the reference triangle over its base of 2",
        sliver,
        trees::answer,
        1..=8,
    )
    .proved(3, 4, &[3]),
    Family::new(
        "dixon",
        "the target is nearly flexible: a whole curve of figures meets it but for the parameter",
        "what squared lengths differ by from those of a flexible figure",
        dixon,
        |_| Answer::Unknown,
        1..=12,
    )
    .proved(4, 11, &[3]),
    single(
        "octahedron-large",
        "the octahedron, 10^8 times as large",
        |_| octahedron_at(8),
        |_| OCTAHEDRON,
        0,
    ),
    single(
        "octahedron-small",
        "the octahedron, 10^8 times as small",
        |_| octahedron_at(-8),
        |_| OCTAHEDRON,
        0,
    ),
    single(
        "sketch-on-a-fold",
        "the sketch is flat: t does not change at first, and the path starts where it turns back",
        |_| two_triangles("sketch-on-a-fold", ["2", "0"], ["3.2", "4"]),
        trees::answer,
        0,
    ),
    single(
        "sketch-is-target",
        "the sketch meets the target already: lengths do not change at all, but for the bend",
        |_| two_triangles("sketch-is-target", ["3", "4"], ["5", "5"]),
        trees::answer,
        0,
    ),
    single(
        "no-triangle",
        "no real triangle meets the target",
        |_| two_triangles("no-triangle", ["3", "4"], ["2.9", "3"]),
        trees::answer,
        0,
    ),
    single(
        "no-tetrahedron",
        "no real tetrahedron meets the target",
        no_tetrahedron,
        trees::answer,
        0,
    ),
    single(
        "wheel",
        "equal lengths, a symmetric sketch and a symmetric target",
        wheel,
        trees::answer,
        0,
    ),
    single(
        "regular-octahedron",
        "equal lengths, a symmetric sketch that meets the target, and only the bend to move it",
        regular_octahedron,
        |_| Answer::Unknown,
        -1,
    ),
    single(
        "crossing",
        "two paths cross: two triangles are flat at the same t",
        |_| families::flaps(0, 0),
        trees::answer,
        -1,
    ),
    single(
        "tangent",
        "the target is a flat triangle: the path touches t = 1 and turns back",
        |_| families::fold(0, 0),
        trees::answer,
        -1,
    ),
    single(
        "tangent-circles",
        "two circles touch at t = 0.5: the path crosses its mirror image",
        |_| families::graze(0, 0),
        trees::answer,
        -1,
    ),
];
