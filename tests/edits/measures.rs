//! The number that a limit is said to be at is what the figure at the limit measures: for every kind of constraint that has
//! a number, on random figures, towards random values.
//!
//! The edited number is a function of a point that goes round a circle: its extreme values are the limits. What
//! the figure measures is computed from its points alone.

use crate::common::edits::Random;
use crate::common::wanted;
use krawl::constraint::{KINDS, Measure};
use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;
use std::fmt::Write;

type Vector = [f64; 3];

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}
fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}
fn size(a: Vector) -> f64 {
    dot(a, a).sqrt()
}
fn apart(a: Vector, b: Vector) -> f64 {
    size(minus(b, a))
}
fn angle(u: Vector, v: Vector) -> f64 {
    size(cross(u, v)).atan2(dot(u, v)).to_degrees()
}
fn turn(u: Vector, v: Vector) -> f64 {
    cross(u, v)[2].atan2(dot(u, v)).to_degrees()
}
/// Of the half planes at the line from b to c through a and through d, measured across that line.
fn torsion(a: Vector, b: Vector, c: Vector, d: Vector) -> f64 {
    let axis = minus(c, b).map(|x| x / apart(b, c));
    let across = |v: Vector| {
        let along = dot(v, axis);
        std::array::from_fn(|k| v[k] - along * axis[k])
    };
    let (from, to) = (across(minus(a, b)), across(minus(d, c)));
    dot(axis, cross(from, to)).atan2(dot(from, to)).to_degrees()
}
fn off_line(p: Vector, a: Vector, b: Vector) -> f64 {
    size(cross(minus(b, a), minus(p, a))) / apart(a, b)
}
fn off_plane(p: Vector, [a, b, c]: [Vector; 3]) -> f64 {
    let n = cross(minus(b, a), minus(c, a));
    dot(n, minus(p, a)).abs() / size(n)
}
/// Of the line from p to q and the plane through three points.
fn slope(p: Vector, q: Vector, [a, b, c]: [Vector; 3]) -> f64 {
    let n = cross(minus(b, a), minus(c, a));
    let sine = dot(n, minus(q, p)).abs() / (size(n) * apart(p, q));
    sine.asin().to_degrees()
}

/// The radius of circles and spheres around p that have a given one, and of those around b.
const RADII: [f64; 2] = [0.03, 0.02];

/// A number of the figure of the points a, b, c and d, which are rigid, p, which goes round a circle, and q.
struct Case {
    kind: &'static str,
    /// What the constraint names.
    items: &'static str,
    /// Dimensions in which there is such a number.
    dimensions: &'static [usize],
    /// Objects and other constraints.
    objects: &'static str,
    others: &'static [(&'static str, &'static str)],
    /// Whether the figure is in a frame of its own because of it.
    absolute: bool,
    /// From a, b, c, d, p and q.
    is: fn([Vector; 6]) -> f64,
}

/// The one kind of case that most are.
const fn case(kind: &'static str, items: &'static str, is: fn([Vector; 6]) -> f64) -> Case {
    Case {
        kind,
        items,
        dimensions: &[2, 3],
        objects: "",
        others: &[],
        absolute: false,
        is,
    }
}

const CIRCLE: &str =
    "[circles]\nk = { center = \"p\", radius = 0.03 }\nj = { center = \"b\", radius = 0.02 }\n";
const SPHERE: &str =
    "[spheres]\nk = { center = \"p\", radius = 0.03 }\nj = { center = \"b\", radius = 0.02 }\n";
const GIVEN: &[(&str, &str)] = &[("radii", "\"k\", 0.03"), ("radii", "\"j\", 0.02")];
/// q is beside p.
const FLATS: &str = "[lines]\nl = [\"p\", \"b\"]\nm = [\"c\", \"d\"]\n[planes]\ne = [\"b\", \"c\", \"d\"]\nf = [\"p\", \"b\", \"a\"]\n";

fn cases() -> Vec<Case> {
    let plane = &[2][..];
    let space = &[3][..];
    let mut all = vec![
        case("distances", "\"p\", \"b\"", |[_, b, _, _, p, _]| {
            apart(p, b)
        }),
        case("squared_distances", "\"p\", \"b\"", |[_, b, _, _, p, _]| {
            apart(p, b)
        }),
        case("distances", "\"p\", \"b\", \"d\"", |[_, b, _, d, p, _]| {
            off_line(p, b, d)
        }),
        case("angles", "\"b\", \"p\", \"d\"", |[_, b, _, d, p, _]| {
            angle(minus(b, p), minus(d, p))
        }),
        case("angles", "\"p\", \"b\", \"d\"", |[_, b, _, d, p, _]| {
            angle(minus(p, b), minus(d, b))
        }),
        case(
            "angles",
            "\"p\", \"b\", \"c\", \"d\"",
            |[_, b, c, d, p, _]| angle(minus(b, p), minus(d, c)),
        ),
        case(
            "along",
            "\"b\", \"p\", \"c\", \"d\"",
            |[_, b, c, d, p, _]| dot(minus(p, b), minus(d, c)) / apart(c, d),
        ),
        case(
            "along",
            "\"c\", \"d\", \"p\", \"b\"",
            |[_, b, c, d, p, _]| dot(minus(d, c), minus(b, p)) / apart(p, b),
        ),
        case(
            "ratios",
            "\"p\", \"b\", \"c\", \"d\"",
            |[_, b, c, d, p, _]| apart(p, b) / apart(c, d),
        ),
        case(
            "ratios",
            "\"p\", \"b\", \"p\", \"d\"",
            |[_, b, _, d, p, _]| apart(p, b) / apart(p, d),
        ),
        case(
            "differences",
            "\"p\", \"b\", \"c\", \"d\"",
            |[_, b, c, d, p, _]| apart(p, b) - apart(c, d),
        ),
        case(
            "differences",
            "\"p\", \"b\", \"p\", \"d\"",
            |[_, b, _, d, p, _]| apart(p, b) - apart(p, d),
        ),
    ];
    // At q between bars of given lengths: the distance between their other ends takes its place.
    all.push(Case {
        dimensions: plane,
        others: &[
            ("distances", "\"q\", \"b\", 0.8"),
            ("distances", "\"q\", \"p\", 0.9"),
        ],
        ..case("angles", "\"b\", \"q\", \"p\"", |[_, b, _, _, p, q]| {
            angle(minus(b, q), minus(p, q))
        })
    });
    let axes: [(&str, &str, fn([Vector; 6]) -> f64); 6] = [
        ("x", "\"p\"", |[.., p, _]| p[0]),
        ("y", "\"p\"", |[.., p, _]| p[1]),
        ("z", "\"p\"", |[.., p, _]| p[2]),
        ("dx", "\"b\", \"p\"", |[_, b, _, _, p, _]| p[0] - b[0]),
        ("dy", "\"b\", \"p\"", |[_, b, _, _, p, _]| p[1] - b[1]),
        ("dz", "\"b\", \"p\"", |[_, b, _, _, p, _]| p[2] - b[2]),
    ];
    for (kind, items, is) in axes {
        let dimensions = if kind.ends_with('z') { space } else { &[2, 3] };
        all.push(Case {
            absolute: true,
            dimensions,
            ..case(kind, items, is)
        });
    }
    all.push(Case {
        absolute: true,
        ..case(
            "angles",
            "\"p\", \"b\", \"x-axis\"",
            |[_, b, _, _, p, _]| angle(minus(b, p), [1.0, 0.0, 0.0]),
        )
    });
    for (objects, dimensions) in [(CIRCLE, plane), (SPHERE, space)] {
        let round = |kind, items, others, is| Case {
            objects,
            dimensions,
            others,
            ..case(kind, items, is)
        };
        let through: &[(&str, &str)] = &[("on", "\"d\", \"k\""), ("radii", "\"j\", 0.02")];
        all.extend([
            round("radii", "\"k\"", through, |[_, _, _, d, p, _]| apart(p, d)),
            round("diameters", "\"k\"", through, |[_, _, _, d, p, _]| {
                2.0 * apart(p, d)
            }),
            round("distances", "\"d\", \"k\"", GIVEN, |[_, _, _, d, p, _]| {
                apart(p, d) - RADII[0]
            }),
            round("distances", "\"k\", \"j\"", GIVEN, |[_, b, _, _, p, _]| {
                apart(p, b) - RADII[0] - RADII[1]
            }),
            round(
                "distances",
                "\"k\", \"b\", \"d\"",
                GIVEN,
                |[_, b, _, d, p, _]| off_line(p, b, d) - RADII[0],
            ),
        ]);
    }
    all.push(Case {
        objects: SPHERE,
        dimensions: space,
        others: GIVEN,
        ..case(
            "distances",
            "\"k\", \"b\", \"c\", \"d\"",
            |[_, b, c, d, p, _]| off_plane(p, [b, c, d]) - RADII[0],
        )
    });
    let flat = |kind, items, is| Case {
        objects: FLATS,
        dimensions: space,
        ..case(kind, items, is)
    };
    all.extend([
        flat("distances", "\"p\", \"e\"", |[_, b, c, d, p, _]| {
            off_plane(p, [b, c, d])
        }),
        flat("distances", "\"l\", \"m\"", |[_, b, c, d, p, _]| {
            let n = cross(minus(b, p), minus(d, c));
            dot(n, minus(c, p)).abs() / size(n)
        }),
        flat("angles", "\"l\", \"m\"", |[_, b, c, d, p, _]| {
            angle(minus(b, p), minus(d, c))
        }),
        Case {
            dimensions: plane,
            ..case("turns", "\"b\", \"p\", \"d\"", |[_, b, _, d, p, _]| {
                turn(minus(b, p), minus(d, p))
            })
        },
        Case {
            dimensions: plane,
            objects: "[lines]\nl = [\"p\", \"b\"]\nm = [\"c\", \"d\"]\n",
            ..case("turns", "\"l\", \"m\"", |[_, b, c, d, p, _]| {
                turn(minus(b, p), minus(d, c))
            })
        },
        Case {
            dimensions: space,
            ..case(
                "torsions",
                "\"p\", \"b\", \"c\", \"d\"",
                |[_, b, c, d, p, _]| torsion(p, b, c, d),
            )
        },
        flat("angles", "\"l\", \"e\"", |[_, b, c, d, p, _]| {
            slope(p, b, [b, c, d])
        }),
        flat("angles", "\"e\", \"l\"", |[_, b, c, d, p, _]| {
            slope(p, b, [b, c, d])
        }),
        flat("angles", "\"m\", \"f\"", |[a, b, c, d, p, _]| {
            slope(c, d, [p, b, a])
        }),
        flat("angles", "\"e\", \"f\"", |[a, b, c, d, p, _]| {
            let normal = |[a, b, c]: [Vector; 3]| cross(minus(b, a), minus(c, a));
            angle(normal([b, c, d]), normal([p, b, a]))
        }),
    ]);
    // An unknown that is half a length, by an equation.
    all.push(Case {
        objects: "[unknowns]\nu = 0.4\n",
        others: &[("equations", "2*u = |p-b|")],
        ..case("values", "\"u\"", |[_, b, _, _, p, _]| apart(p, b) / 2.0)
    });
    // A cart on a rail, and a tool on the cart that has p.
    all.push(Case {
        dimensions: plane,
        absolute: true,
        objects: "[bodies]\ng = {}\ncart = {}\ntool = { p = [0, 0] }\n[joints]\n\
                  s = { prismatic = [\"g\", \"cart\"] }\nt = { prismatic = [\"cart\", \"tool\"], x = [[0, 1], [0, 1]] }\n",
        ..case("travels", "\"s\"", |[_, _, _, _, p, _]| p[0])
    });
    // Parallel lines: that through p and q, and that through b and d.
    all.push(Case {
        dimensions: plane,
        others: &[("distances", "\"p\", \"q\", 0.7")],
        ..case(
            "distances",
            "\"p\", \"q\", \"b\", \"d\"",
            |[_, b, _, d, p, _]| off_line(p, b, d),
        )
    });
    all
}

/// A figure of a case, and the number that it measures.
fn figure(case: &Case, dimension: usize, random: &mut Random) -> (String, f64) {
    let mut place = || -> Vector {
        std::array::from_fn(|k| match k < dimension {
            true => random.between(-100.0, 100.0).round() / 100.0,
            false => 0.0,
        })
    };
    let mut at: [Vector; 6] = std::array::from_fn(|_| place());
    let has_q =
        case.items.contains("\"q\"") || case.others.iter().any(|(_, o)| o.contains("\"q\""));
    if case.kind == "distances" && has_q {
        // In parallel to the other line.
        let u = minus(at[3], at[1]);
        at[5] = std::array::from_fn(|k| at[4][k] + 0.7 * u[k] / size(u));
    }
    let absolute = case.absolute || random.below(2) == 0;
    let mut text = format!("dimension = {dimension}\n[points]\n");
    for (name, at) in "abcdpq".chars().zip(at).take(if has_q { 6 } else { 5 }) {
        writeln!(text, "{name} = {:?}", &at[..dimension]).unwrap();
    }
    let value = (case.is)(at);
    let mut given: Vec<(&str, String)> = Vec::new();
    let mut bar = |a: usize, b: usize| {
        let name = |p: usize| &"abcdpq"[p..=p];
        let names = format!(
            "\"{}\", \"{}\", {:.6}",
            name(a),
            name(b),
            apart(at[a], at[b])
        );
        given.push(("distances", names));
    };
    bar(0, 4);
    if dimension == 3 {
        bar(2, 4);
    }
    if absolute {
        given.extend("abcd".chars().map(|name| ("fixed", format!("\"{name}\""))));
    } else {
        let rigid = [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3], [0, 3]];
        let count = if dimension == 2 { 5 } else { 6 };
        rigid[..count].iter().for_each(|&[a, b]| bar(a, b));
    }
    let number = match case.kind {
        "squared_distances" => value * value,
        _ => value,
    };
    given.push((case.kind, format!("{}, {number:.6}", case.items)));
    given.extend(
        case.others
            .iter()
            .map(|&(kind, entry)| (kind, entry.to_owned())),
    );
    text += case.objects;
    text += "[constraints]\n";
    let mut kinds: Vec<&str> = given.iter().map(|g| g.0).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in kinds {
        let entries = given.iter().filter(|g| g.0 == kind);
        let entries = entries.map(|g| match kind {
            "equations" => format!("\"{}\"", g.1),
            _ => format!("[{}]", g.1),
        });
        let entries: Vec<String> = entries.collect();
        writeln!(text, "{kind} = [{}]", entries.join(", ")).unwrap();
    }
    (text, value)
}

/// Edits a case towards random values until it came to so many limits.
fn come_to_limits(case: &Case, dimension: usize, random: &mut Random, wanted: usize) {
    let mut limits = 0;
    for _ in 0..40 * wanted {
        if limits == wanted {
            return;
        }
        let (text, from) = figure(case, dimension, random);
        // A number may be none that is allowed, such as an angle of 180 degrees.
        let Ok(problem) = Problem::parse(&text, "measures.toml") else {
            continue;
        };
        let Ok(mut session) = Session::open(&problem) else {
            continue;
        };
        // The last one of its kind is edited, or the one about these points.
        let names: String = case.items.replace("\", \"", "-").replace('"', "");
        let Ok(index) = (match names.as_str() {
            "p-b" if case.kind.ends_with("distances") => Setting::find(&problem, "p-b"),
            _ => Setting::find(&problem, &format!("{}:{names}", case.kind)),
        }) else {
            panic!("{names} is no dimension of\n{text}")
        };
        let to = match case.kind {
            "angles" if case.items.contains("\"e\"") || case.items.contains("\"f\"") => {
                random.between(0.1, 89.9)
            }
            "angles" => random.between(1.0, 179.0),
            "turns" | "torsions" => from + random.between(-450.0, 450.0),
            "x" | "y" | "z" | "dx" | "dy" | "dz" | "along" | "differences" => {
                from + random.between(-4.0, 4.0)
            }
            _ => from * (random.between(-2.0, 2.0)).exp(),
        };
        let Ok(setting) = Setting::new(&problem, index, format!("{to:.4}").parse().unwrap()) else {
            continue;
        };
        let edited = session.edit(&[setting]);
        let Ending::Limit(_) = edited.ending else {
            continue;
        };
        limits += 1;
        let mut at = [[0.0; 3]; 6];
        for (at, point) in at.iter_mut().zip(&edited.points) {
            *at = point.map(|x| x.mid());
        }
        let (is, said) = ((case.is)(at), edited.dimensions[0].value);
        // Turns are told up to whole ones.
        let is = match case.kind {
            "turns" | "torsions" => is + 360.0 * ((said.mid() - is) / 360.0).round(),
            _ => is,
        };
        let room = 1e-8 * is.abs().max(1.0);
        assert!(
            said.inf() - room <= is && is <= said.sup() + room && said.wid() < 1e-6,
            "{} {}: said to be {said:?} at the limit, and is {is} there (to {to:.4})\n{text}",
            case.kind,
            case.items
        );
    }
    assert!(limits > 0, "{} {} came to no limit", case.kind, case.items);
}

fn campaign(seed: u64, wanted: usize) {
    let cases = cases();
    for kind in KINDS.iter().filter(|kind| kind.measure != Measure::Nothing) {
        assert!(
            cases.iter().any(|case| case.kind == kind.key),
            "{} is not tried",
            kind.key
        );
    }
    let mut random = Random(seed);
    for case in &cases {
        for &dimension in case.dimensions {
            come_to_limits(case, dimension, &mut random, wanted);
        }
    }
}

#[test]
fn a_limit_is_where_the_figure_there_measures_it() {
    campaign(43, 2);
}

/// The same many times: KRAWL_COUNT limits of each.
#[test]
#[ignore = "minutes"]
fn limits_of_all_kinds_are_where_figures_measure_them() {
    campaign(1, wanted("KRAWL_COUNT", 100));
}
