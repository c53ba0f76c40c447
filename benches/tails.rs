//! What a certified tube costs where constraints are no distances, beside one of distances with as many
//! unknowns: `cargo bench --bench tails`.
//!
//! Problems of distances are measured beside the same with as many of their distances as possible replaced: in a
//! triangle all of whose sides are given, one side becomes the angle opposite to it, at the point or between the lines of the
//! two other sides, or in the plane the height over another side. The figures wanted are the same, and so is the
//! number of unknowns; the paths differ. Angles between given bars with an end in common have the form of a distance
//! in the equations; heights are sums of products, and only these count as others than distances. Shipped problems
//! with other constraints stand beside a generated strip of about as many unknowns. The times are those of following the
//! path over all tubes tried, medians of several runs that take turns. The goal is 1.3 times at most, by the
//! median of the ratios of problems with equations in the tail; that of the others is printed beside it.
//! `cargo bench --bench tails -- WORD …` measures those problems only whose names contain one of the words, and
//! `cargo bench --bench tails -- --write FOLDER` writes the problems to files instead, to be profiled one by one.

use krawl::generate::{Family, Recipe};
use krawl::problem::{Problem, Target};
use krawl::system::Homotopy;
use krawl::track::{Control, Options, Outcome, Space, Status, solve};

/// The cost of a tube among other constraints may be so many times that among distances.
const GOAL: f64 = 1.3;
/// Runs of each problem.
const RUNS: usize = 9;

fn main() {
    let mut pairs: Vec<(String, Problem, Problem)> = Vec::new();
    let shipped = ["octahedron", "disulfide", "icosahedron-c1", "dodecagon"];
    for name in shipped {
        let plain = Problem::read(format!("problems/{name}.toml")).expect("a shipped problem");
        add(&mut pairs, name, &plain);
    }
    for (family, size) in [
        (Family::Strip, 30),
        (Family::Strip, 60),
        (Family::Strip, 120),
        (Family::Strip, 240),
        (Family::Tetrahedra, 30),
        (Family::Tetrahedra, 60),
        (Family::Chain, 48),
    ] {
        let plain = Recipe::new(family, size).problem().expect("a recipe");
        let name = format!("{} {size}", family.name());
        add(&mut pairs, &name, &plain);
    }
    for name in ["pentahedron", "3p3l", "3p3l-orthogonal"] {
        let file = format!("problems/constraints/{name}.toml");
        let other = Problem::read(file).expect("a shipped problem");
        let unknowns = Homotopy::new(&other).expect("a gauge").equations;
        // The smallest strip has 25.
        let plain = Recipe::new(Family::Strip, unknowns.max(25)).problem();
        let plain = plain.expect("a recipe");
        pairs.push((name.to_owned(), plain, other));
    }
    let mut arguments = std::env::args().skip_while(|argument| argument != "--write");
    if let Some(folder) = arguments.nth(1) {
        return write(&pairs, &folder);
    }
    // `cargo bench` passes options of its own.
    let arguments = std::env::args().skip(1);
    let only: Vec<String> = arguments.filter(|name| !name.starts_with("--")).collect();
    let is_asked = |name: &str| only.is_empty() || only.iter().any(|part| name.contains(part));
    pairs.retain(|(name, ..)| is_asked(name));
    println!(
        "{:<22} {:<8} {:>9} {:>9} {:>13} {:>13} {:>7}  outcome",
        "problem", "space", "unknowns", "tail", "distances, µs", "others, µs", "ratio"
    );
    for space in [Space::Full, Space::Reduced] {
        let mut ratios = [Vec::new(), Vec::new()];
        for (name, plain, other) in &pairs {
            let options = Options {
                space,
                ..Options::certified()
            };
            let (mut times, mut outcome) = ([Vec::new(), Vec::new()], None);
            for _ in 0..RUNS {
                for (times, problem) in times.iter_mut().zip([plain, other]) {
                    let seen = solve(problem, &options, &mut Control::default()).expect("a run");
                    times.push(per_tube(&seen));
                    outcome = Some(seen);
                }
            }
            let [before, after] = times.map(median);
            let homotopy = Homotopy::new(other).expect("a gauge");
            let tail = homotopy.equations - homotopy.half_squares().count();
            let ratio = after / before;
            println!(
                "{name:<22} {:<8} {:>4}, {:>3} {:>9} {before:>13.2} {after:>13.2} {ratio:>7.2}  {}",
                if space == Space::Full {
                    "full"
                } else {
                    "reduced"
                },
                Homotopy::new(plain).expect("a gauge").equations,
                homotopy.equations,
                tail,
                match outcome.map(|seen| seen.status) {
                    Some(Status::Closed) => "closed",
                    Some(Status::Open(_)) => "open",
                    _ => "stopped",
                }
            );
            ratios[usize::from(tail > 0)].push(ratio);
        }
        let [alike, others] = ratios.map(|ratios| (!ratios.is_empty()).then(|| median(ratios)));
        if let Some(middle) = others {
            let seen = if middle <= GOAL { "met" } else { "MISSED" };
            println!("{space:?}: {middle:.2} times by the median, goal {GOAL}: {seen}");
        }
        if let Some(alike) = alike {
            println!("{space:?}: angles in the form of distances {alike:.2}");
        }
    }
}

/// What comes in the place of a distance.
#[derive(Clone, Copy, PartialEq)]
enum Instead {
    /// The angle opposite to it, at the point.
    Angle,
    /// That between the lines of the other sides.
    Lines,
    /// The height of one of its ends over the side at the other.
    Height,
}

/// Adds a problem of distances beside the same with others in their place.
fn add(pairs: &mut Vec<(String, Problem, Problem)>, name: &str, plain: &Problem) {
    for (instead, what) in [
        (Instead::Angle, ""),
        (Instead::Lines, " lines"),
        (Instead::Height, " heights"),
    ] {
        if instead == Instead::Height && plain.dimension == 3 {
            // A distance from a line in space takes unknowns of its own.
            continue;
        }
        let others = with_others(plain, instead).into_iter();
        pairs.extend(others.map(|other| (format!("{name}{what}"), plain.clone(), other)));
    }
}

/// Writes the problems to files instead, so that `krawl solve` can be profiled on each.
fn write(pairs: &[(String, Problem, Problem)], folder: &str) {
    for (name, plain, other) in pairs {
        let name = name.replace(' ', "-");
        for (kind, problem) in [("distances", plain), ("others", other)] {
            let file = format!("{folder}/{name}-{kind}.toml");
            std::fs::write(&file, problem.to_toml()).expect("a folder that can be written to");
        }
    }
}

/// Microseconds for each tube that was tried.
fn per_tube(outcome: &Outcome) -> f64 {
    1e6 * outcome.seconds / (outcome.steps + outcome.rejected) as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The same problem with others in the place of distances; `None` if there is no triangle for one.
fn with_others(problem: &Problem, instead: Instead) -> Option<Problem> {
    let length = |d: usize| match &problem.distances[d].target {
        Target::Length(length) => length.to_f64(),
        Target::SquaredLength(square) => square.to_f64().sqrt(),
    };
    let between = |a: usize, b: usize| {
        let joins = |ends: [usize; 2]| ends == [a, b] || ends == [b, a];
        problem.distances.iter().position(|d| joins(d.points))
    };
    // Legs stay distances.
    let mut is_leg = vec![false; problem.distances.len()];
    let mut angles: Vec<Option<(usize, f64, f64)>> = vec![None; problem.distances.len()];
    for (d, distance) in problem.distances.iter().enumerate() {
        let [a, b] = distance.points;
        if is_leg[d] || d == problem.homotopy.bend {
            continue;
        }
        let legs = (0..problem.points.len()).find_map(|p| {
            let legs = [between(a, p)?, between(b, p)?];
            let free = legs.iter().all(|&leg| angles[leg].is_none());
            let [x, y, z] = [length(legs[0]), length(legs[1]), length(d)];
            let cosine = (x * x + y * y - z * z) / (2.0 * x * y);
            (free && cosine.abs() < 0.99).then_some((p, legs, cosine, y))
        });
        if let Some((p, legs, cosine, leg)) = legs {
            legs.into_iter().for_each(|leg| is_leg[leg] = true);
            let angle = cosine.acos();
            angles[d] = Some((p, angle.to_degrees(), leg * angle.sin()));
        }
    }
    angles.iter().any(Option::is_some).then_some(())?;
    let name = |p: usize| problem.points[p].name.clone();
    let mut builder = Problem::build(&problem.name, problem.dimension);
    for point in &problem.points {
        let sketch = point.sketch.iter().take(problem.dimension).cloned();
        builder = builder.point(&point.name, sketch);
    }
    for (distance, angle) in problem.distances.iter().zip(&angles) {
        let [a, b] = distance.points.map(name);
        builder = match (angle, &distance.target) {
            (Some((p, degrees, height)), _) => match instead {
                Instead::Angle => builder.dimension("angles", [a, name(*p), b], *degrees),
                Instead::Lines => builder.dimension("angles", [name(*p), a, name(*p), b], *degrees),
                Instead::Height => builder.dimension("distances", [b, a, name(*p)], *height),
            },
            (None, Target::Length(length)) => builder.distance(&a, &b, length.clone()),
            (None, Target::SquaredLength(square)) => {
                builder.squared_distance(&a, &b, square.clone())
            }
        };
    }
    let homotopy = &problem.homotopy;
    builder
        .reference(homotopy.reference.iter().map(|&p| name(p)))
        .bend(problem.distances[homotopy.bend].points.map(name))
        .bend_coefficient(homotopy.bend_coefficient.clone())
        .finish()
        .ok()
}
