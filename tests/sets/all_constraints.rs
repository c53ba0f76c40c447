//! All solutions of problems with other constraints than distances, and of those that fall apart: against counts by formula,
//! against the paths of random problems, and where nothing may be claimed.

use crate::common::edits::Random;
use crate::common::mixed::Spec;
use crate::common::sketches::{ARC, LEG, PLATE, apollonius_text, isosceles_text};
use crate::common::wanted;
use krawl::complete::{Complete, Method, Options, Status, Unserved, Why, all};
use krawl::constraint::{Symmetry, symmetry};
use krawl::problem::Problem;
use krawl::track::{Control, Options as PathOptions, Solution, Status as Ended, solve};

fn parse(text: &str) -> Problem {
    Problem::parse(text, "test.toml").unwrap()
}

fn searched(problem: &Problem) -> Complete {
    all(problem, &Options::default()).unwrap()
}

/// The number of solutions of a set that has to be complete.
fn count(text: &str) -> usize {
    let result = searched(&parse(text));
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    assert_eq!(result.method, Method::Coordinates);
    assert_eq!(result.count, Some(result.solutions.len() as u64));
    result.solutions.len()
}

/// A triangle by two sides and an angle that is not between them: c is on a ray from a, as far from b as said.
#[test]
fn a_triangle_by_two_sides_and_an_angle_has_two_figures_one_or_none() {
    let with = |side: &str| {
        count(&format!(
            r#"
            name = "triangle"
            dimension = 2
            [points]
            a = [0, 0]
            b = [4, 0]
            c = [3, 2]
            [constraints]
            distances = [["a", "b", 4], ["b", "c", {side}]]
            angles = [["b", "a", "c", 30]]
            "#
        ))
    };
    // The distance of b from the ray is 2.
    assert_eq!(with("2.5"), 2);
    assert_eq!(with("5"), 1);
    assert_eq!(with("1.9"), 0);
}

/// Where the ray touches the circle the solution is singular, and nothing is claimed.
#[test]
fn a_double_solution_stays_undecided() {
    let problem = parse(
        r#"
        name = "touching"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [3, 2]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 2]]
        angles = [["b", "a", "c", 30]]
        "#,
    );
    let result = searched(&problem);
    assert_eq!(result.status, Status::Partial);
    assert!(result.solutions.is_empty());
    assert!(result.undecided.iter().all(|part| part.why == Why::Small));
    assert!(result.boxes < 20_000, "{}", result.boxes);
}

/// A circle that touches three given circles, all apart: one for each choice of sides.
#[test]
fn the_problem_of_apollonius_has_eight_solutions() {
    let touching = |center: &str, radius: &str| count(&apollonius_text(center, radius));
    // Sides are those of the sketch: from outside all three, and round all three.
    let mut found = touching("[3, 2.2]", "2.3");
    assert_eq!(found, 1);
    // Each circle has its distance from the centre more or less its own radius: |m - p| = r + s_i r_i.
    for sides in 1..8u32 {
        let signs = [0, 1, 2].map(|k| if sides >> k & 1 == 1 { -1.0 } else { 1.0 });
        let (center, radius) = apollonius(signs);
        found += touching(
            &format!("[{}, {}]", center[0], center[1]),
            &radius.to_string(),
        );
    }
    assert_eq!(found, 8);
}

/// The circle that touches the three from these sides, to some digits: by elimination of the squares.
fn apollonius(signs: [f64; 3]) -> ([f64; 2], f64) {
    let given = [([0.0, 0.0], 1.0), ([7.0, 0.0], 1.5), ([2.0, 6.0], 2.0)];
    // (x - a)² + (y - b)² = (r + s)²: less the first one, linear in x, y and r.
    let [(_, first), (p, second), (q, third)] = given;
    let (s, t, u) = (signs[0] * first, signs[1] * second, signs[2] * third);
    let row = |at: [f64; 2], v: f64| {
        (
            [-2.0 * at[0], -2.0 * at[1]],
            2.0 * (v - s),
            v * v - s * s - at[0] * at[0] - at[1] * at[1],
        )
    };
    let ((a, c, d), (b, e, f)) = (row(p, t), row(q, u));
    let det = a[0] * b[1] - a[1] * b[0];
    // x = x0 + x1 r, y = y0 + y1 r.
    let solve = |v: f64, w: f64| [(v * b[1] - w * a[1]) / det, (a[0] * w - b[0] * v) / det];
    let (zeroth, linear) = (solve(d, f), solve(c, e));
    let quadratic = linear[0].powi(2) + linear[1].powi(2) - 1.0;
    let half = zeroth[0] * linear[0] + zeroth[1] * linear[1] - s;
    let constant = zeroth[0].powi(2) + zeroth[1].powi(2) - s * s;
    let root = (half * half - quadratic * constant).sqrt();
    let radii = [(-half + root) / quadratic, (-half - root) / quadratic];
    let fits = |r: &f64| {
        let at = [zeroth[0] + linear[0] * r, zeroth[1] + linear[1] * r];
        *r > 0.0
            && given.iter().zip(signs).all(|((p, own), sign)| {
                let d = (at[0] - p[0]).hypot(at[1] - p[1]);
                (d - (r + sign * own)).abs() < 1e-9
            })
    };
    let r = radii.into_iter().find(fits).expect("the circles are apart");
    ([zeroth[0] + linear[0] * r, zeroth[1] + linear[1] * r], r)
}

/// A right angle of which a leg may vanish: where it does there is no angle, and no figure.
#[test]
fn a_figure_without_a_leg_is_none() {
    // c is on the circle over a-b, and 3 from d, as a is.
    let problem = parse(LEG);
    let result = searched(&problem);
    // c = a meets all equations, and so does one more place.
    for solution in &result.solutions {
        let [a, c] = [0, 3].map(|p| solution.points[p]);
        assert!((0..2).any(|k| !(c[k] - a[k]).contains(0.0)));
    }
    assert_eq!(result.solutions.len(), 1);
    match result.status {
        Status::Complete => {}
        _ => assert!(
            result
                .undecided
                .iter()
                .all(|part| part.why == Why::Vanishing)
        ),
    }
}

/// A strip of triangles: twice as many figures with each.
#[test]
fn parts_that_share_a_side_are_searched_by_themselves() {
    sides_are_shared(16);
}

#[test]
#[ignore = "half a minute"]
fn many_parts_that_share_a_side_are_searched_by_themselves() {
    sides_are_shared(22);
}

/// In a strip through so many points.
fn sides_are_shared(count: usize) {
    let mut build = Problem::build("strip", 2);
    for k in 0..count {
        let (x, y) = (k as f64 / 2.0, if k % 2 == 0 { 0.0 } else { 0.9 });
        build = build.point(&format!("p{k}"), [x, y]);
    }
    for k in 1..count {
        build = build.distance(&format!("p{}", k - 1), &format!("p{k}"), "1");
        if k > 1 {
            let length = format!("1.{:02}", k);
            build = build.distance(&format!("p{}", k - 2), &format!("p{k}"), length.as_str());
        }
    }
    let strip = build.finish().unwrap();
    let result = searched(&strip);
    assert_eq!(
        (result.status, result.method),
        (Status::Complete, Method::Blocks)
    );
    // The first triangle is one figure up to reflection, each further one has two sides.
    assert_eq!(result.count, Some(1 << (count - 3)));
    assert_eq!(result.parts.len(), count - 2);
    assert_eq!(result.solutions.len(), 1000);
    crate::common::boxes::check(&strip, &result.solutions[..50]).unwrap();
}

/// Bounds of the squared distances of all pairs of points.
fn pairs(solution: &Solution) -> Vec<[f64; 2]> {
    let p = &solution.points;
    let pairs = (0..p.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    pairs
        .map(|(a, b)| {
            let s = (0..3).fold(krawl::interval::point(0.0), |sum, k| {
                sum + (p[a][k] - p[b][k]).sqr()
            });
            [s.inf(), s.sup()]
        })
        .collect()
}

/// Where a point is, in the middle of its box.
fn place(solution: &Solution, point: usize) -> [f64; 2] {
    std::array::from_fn(|k| solution.points[point][k].mid())
}

/// Every solution on the path is in a complete set.
fn holds_the_path(problem: &Problem, result: &Complete) -> Result<usize, String> {
    let options = PathOptions {
        max_steps: 1500,
        ..PathOptions::certified()
    };
    let outcome = solve(problem, &options, &mut Control::default()).unwrap();
    let mut found = 0;
    for solution in outcome.solutions.iter().filter(|s| !s.is_degenerate) {
        let own = pairs(solution);
        let meets = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        let is_in = |other: &Solution| match symmetry(problem) {
            Symmetry::Identity => {
                let places = other.points.iter().flatten();
                let mut places = places.zip(solution.points.iter().flatten());
                places.all(|(a, b)| !a.disjoint(*b))
            }
            _ => pairs(other).iter().zip(&own).all(|(a, b)| meets(a, b)),
        };
        if !result.solutions.iter().any(is_in) {
            return Err(format!("a solution on the path is not in the set: {own:?}"));
        }
        found += 1;
    }
    let classes = outcome.solutions.iter().map(|s| s.class + 1).max();
    if matches!(outcome.status, Ended::Closed) && classes.unwrap_or(0) > result.solutions.len() {
        return Err("more classes on the path than in the set".to_owned());
    }
    Ok(found)
}

#[derive(Debug, Default)]
struct Tally {
    tried: usize,
    complete: usize,
    solutions: usize,
    on_paths: usize,
}

/// Random problems of mixed kinds: in complete sets are all solutions of the path, and every figure listed meets what the
/// constraints mean to people.
fn mixed(dimension: usize, tries: usize, seed: u64, most_boxes: u64) -> Tally {
    let mut random = Random(seed);
    let mut tally = Tally::default();
    for number in 0..tries {
        let Some((spec, problem)) = Spec::random(dimension, &mut |n| random.below(n)) else {
            continue;
        };
        tally.tried += 1;
        let options = Options {
            most_boxes,
            ..Options::default()
        };
        let result = match all(&problem, &options) {
            Err(Unserved::Refused(_)) => continue,
            result => result.unwrap(),
        };
        for solution in &result.solutions {
            let points: Vec<[f64; 3]> =
                solution.points.iter().map(|p| p.map(|x| x.mid())).collect();
            match spec.holds(&points) {
                Err(what) if what.ends_with("of its own vanishes") => {}
                told => {
                    told.unwrap_or_else(|what| panic!("{number}: {what}\n{}", problem.to_toml()))
                }
            }
        }
        if result.status != Status::Complete {
            if let Some(folder) = std::env::var_os("KRAWL_KEEP") {
                let file = std::path::Path::new(&folder).join(format!("{number}.toml"));
                let text = format!("# {:?}\n{}", result.undecided, problem.to_toml());
                std::fs::write(file, text).unwrap();
            }
            continue;
        }
        tally.complete += 1;
        tally.solutions += result.solutions.len();
        tally.on_paths += holds_the_path(&problem, &result)
            .unwrap_or_else(|what| panic!("{number}: {what}\n{}", problem.to_toml()));
    }
    tally
}

#[test]
fn random_problems_of_mixed_kinds_hold_their_paths() {
    let tally = mixed(2, 40, 13, 3000);
    assert!(tally.complete > 5 && tally.on_paths > 10, "{tally:?}");
    let tally = mixed(3, 15, 7, 3000);
    assert!(tally.complete > 5 && tally.on_paths > 10, "{tally:?}");
}

#[test]
#[ignore = "minutes: KRAWL_COUNT problems (1000) of KRAWL_DIMENSION (2), those of KRAWL_SEED; in KRAWL_KEEP those not complete"]
fn many_random_problems_of_mixed_kinds_hold_their_paths() {
    let tally = mixed(
        wanted("KRAWL_DIMENSION", 2),
        wanted("KRAWL_COUNT", 1000),
        wanted("KRAWL_SEED", 1),
        20_000,
    );
    println!("{tally:?}");
}

/// Three equal cranks on a line, joined by bars as long as the crank pins are apart: they turn together. Fixed points, and one
/// equation follows from the others, so that all solutions are singular.
#[test]
fn a_flexible_linkage_in_its_own_frame_is_not_called_complete() {
    let problem = parse(
        r#"
        name = "cranks"
        dimension = 2
        [points]
        a = [0, 0]
        b = [2, 0]
        c = [1, 3]
        p = [0.5, 0.8]
        q = [2.6, 0.9]
        r = [1.5, 3.8]
        [constraints]
        fixed = ["a", "b", "c"]
        distances = [["a", "p", 1], ["b", "q", 1], ["c", "r", 1], ["p", "q", 2]]
        squared_distances = [["p", "r", 10], ["q", "r", 10]]
        "#,
    );
    let options = Options {
        most_boxes: 100_000,
        ..Options::default()
    };
    let result = all(&problem, &options).unwrap();
    assert_eq!(result.status, Status::Flexible, "{:?}", result.undecided);
}

/// Two places of c that are 2√δ apart: told apart as long as that is more than some roundings, and otherwise left open.
#[test]
fn two_figures_near_each_other_are_two_or_left_open() {
    for (digits, is_told) in [
        ("000001", true),
        ("0000000001", true),
        ("00000000000000000001", false),
    ] {
        let problem = parse(&format!(
            r#"
            name = "near"
            dimension = 2
            [points]
            a = [0, 0]
            b = [4, 0]
            c = [3, 2]
            [constraints]
            distances = [["a", "b", 4], ["b", "c", 2.{digits}]]
            angles = [["b", "a", "c", 30]]
            "#
        ));
        let result = searched(&problem);
        match is_told {
            true => assert_eq!(
                (result.status, result.solutions.len()),
                (Status::Complete, 2)
            ),
            false => assert_ne!(result.status, Status::Complete),
        }
    }
}

/// A chain of triangles by formula: each point has two places, as `solve` counts them block by block.
#[test]
fn blocks_by_formula_have_as_many_figures_as_solve_counts() {
    let problem = parse(
        r#"
        name = "chain"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [2, 3]
        d = [5, 3]
        e = [6, 1]
        [constraints]
        fixed = ["a", "b"]
        distances = [["a", "c", 3.5], ["b", "c", 3.3], ["c", "d", 3], ["b", "d", 3.2], ["d", "e", 2.5], ["b", "e", 2.2]]
        "#,
    );
    let figures =
        krawl::blocks::Figures::find(&problem, &PathOptions::certified(), &mut Control::default())
            .unwrap();
    assert!(figures.doubt().is_none() && !figures.has_paths());
    let result = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    assert_eq!(figures.count(), result.count);
    assert!(result.count >= Some(4));
}

/// The pentahedron: nine figures up to reflection, those that are published on its path, and no other.
/// The papers' problem with angles, in its three valuations. Places where a leg vanishes, and where it has no end, are excluded.
#[test]
fn figures_with_angles_are_complete() {
    for (name, count) in [("closed", 3), ("infinite", 6), ("undefined", 4)] {
        let path = format!("problems/constraints/6p7d3a2c-{name}.toml");
        let problem = Problem::read(path).unwrap();
        let result = searched(&problem);
        assert_eq!(result.status, Status::Complete, "{name}");
        assert_eq!(result.solutions.len(), count, "{name}");
        assert!(result.boxes < 2000, "{name}: {}", result.boxes);
        holds_the_path(&problem, &result).unwrap();
    }
}

/// In space one angle leaves a leg of length 0 any heading of a cone: a curve of zeros at one place, and of no figures. As two
/// sides are equal, the length is a factor of what is known.
#[test]
fn headings_of_no_leg_are_no_curve_of_figures() {
    let problem = parse(
        r#"
        name = "isosceles"
        dimension = 3
        [points]
        a = [0, 0, 0]
        b = [4, 0, 0]
        c = [3, 2, 0]
        d = [2, 1, 3]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 4], ["d", "a", 3.5], ["d", "b", 3], ["d", "c", 3.5]]
        angles = [["b", "a", "c", 35]]
        "#,
    );
    let result = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    assert_eq!(result.solutions.len(), 1);
    assert!(result.boxes < 500, "{}", result.boxes);
}

/// Triangles with two equal sides and an angle at the base: its equations also hold without a base.
#[test]
fn triangles_with_two_equal_sides_are_complete() {
    let triangle = |sides: &str, angle: f64| {
        let result = searched(&parse(&isosceles_text(sides, angle)));
        assert_eq!(result.status, Status::Complete, "{sides} {angle}");
        assert!(result.boxes < 200, "{sides} {angle}: {}", result.boxes);
        result.solutions
    };
    let given = r#"distances = [["a", "c", 5.3], ["b", "c", 5.3]]"#;
    // Equal to each other, and one of them given by its square.
    let equal = r#"distances = [["a", "c", 5.3]]
                   equal = [["c", "b", "a", "c"]]"#;
    let squared = r#"distances = [["a", "c", 5.3]]
                     squared_distances = [["c", "b", 28.09]]"#;
    for sides in [given, equal, squared] {
        for angle in [0.5f64, 40.0, 89.5] {
            let found = triangle(sides, angle);
            assert_eq!(found.len(), 1);
            let [a, b] = [0, 1].map(|p| &found[0].points[p]);
            let side = (a[0].mid() - b[0].mid()).hypot(a[1].mid() - b[1].mid());
            assert!((side - 10.6 * angle.to_radians().cos()).abs() < 1e-9);
        }
        for angle in [90.5, 170.0] {
            assert!(triangle(sides, angle).is_empty());
        }
    }
    // Nearly equal is not equal: with the longer one opposite the base angle there is one, with the other there are two.
    let longer = r#"distances = [["a", "c", 5.3], ["b", "c", 5.3000001]]"#;
    assert_eq!(triangle(longer, 40.0).len(), 1);
    let shorter = r#"distances = [["a", "c", 5.3], ["b", "c", 5.2999999]]"#;
    assert_eq!(triangle(shorter, 40.0).len(), 2);
}

/// Right angles at points that are sought bound these; and what is horizontal and what is vertical tells where centres are.
#[test]
fn arcs_between_lines_are_complete() {
    let result = searched(&parse(ARC));
    assert_eq!(result.status, Status::Complete);
    // With x and y for the ends along the lines, x² + y² + 15 (x + y) = 0 and 3 x² + 40 x = y² + 10 y, the centre between them.
    let end = |s: &Solution, p: usize| s.points[p][0].mid();
    let ends = result.solutions.iter().map(|s| (end(s, 1), end(s, 2)));
    let ends: Vec<(f64, f64)> = ends.collect();
    for (x, y) in &ends {
        assert!((x * x + y * y + 15.0 * (x + y)).abs() < 1e-9);
        assert!((3.0 * x * x + 40.0 * x - y * y - 10.0 * y).abs() < 1e-9);
    }
    // Two conics meet in no more than four places.
    assert_eq!(ends.len(), 4);
    let result = searched(&parse(PLATE));
    assert_eq!(result.status, Status::Complete);
    // Either direction of two lines, and either side of a line for each of eight ends of arcs.
    assert_eq!(result.solutions.len(), 1 << 10);
    assert_eq!(result.count, Some(1 << 10));
    assert!(result.boxes < 2000, "{}", result.boxes);
}

/// A rhombus by its sides and an angle at a diagonal: the other two corners are on either side of it, or at one place.
#[test]
fn a_rhombus_is_complete() {
    let problem = parse(
        r#"
        name = "rhombus"
        dimension = 2
        [points]
        a = [0, 0]
        b = [8, 0.3]
        c = [4, 2]
        d = [4, -2]
        [constraints]
        distances = [["a", "c", 5.3]]
        equal = [["a", "c", "c", "b"], ["a", "c", "b", "d"], ["d", "a", "a", "c"]]
        angles = [["b", "a", "c", 30]]
        "#,
    );
    let result = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    assert_eq!(result.solutions.len(), 2);
}

/// Polygons by angles whose legs have no given lengths: one figure, found at once.
#[test]
fn polygons_by_angles_are_complete() {
    let quadrangle = |constraints: &str| {
        let text = format!(
            r#"
            name = "quadrangle"
            dimension = 2
            [points]
            a = [0, 0]
            b = [3, 0]
            c = [3.5, 2]
            d = [0.5, 2.5]
            [constraints]
            {constraints}
            "#
        );
        let result = searched(&parse(&text));
        assert_eq!(result.status, Status::Complete, "{constraints}");
        assert!(result.boxes < 1000, "{constraints}: {}", result.boxes);
        result.solutions.len()
    };
    let count = quadrangle(
        r#"distances = [["a", "b", 3]]
           angles = [["a", "b", "c", 75], ["b", "c", "d", 100], ["c", "d", "a", 95]]
           equal = [["b", "c", "c", "d"]]"#,
    );
    assert_eq!(count, 1);
    let count = quadrangle(
        r#"distances = [["a", "b", 3], ["b", "d", 3.5]]
           angles = [["a", "b", "c", 75], ["b", "c", "d", 80], ["c", "d", "a", 95]]"#,
    );
    assert_eq!(count, 1);
}

/// Three points seen from a fourth under three angles: as many figures as there are lengths s, t, u of the lines of sight with
/// s² + t² − 2 s t cos = |ab|² and so on, counted along s with either root for t and u. So many times; in how many of these the set is complete
/// at least, and with how many figures in all.
fn seen_under_three_angles(times: usize, [least, some]: [usize; 2]) {
    let mut random = Random(11);
    let (mut complete, mut figures) = (0, 0);
    for _ in 0..times {
        let mut tenth =
            |low: i64, high: i64| (low + random.below((high - low) as usize) as i64) as f64 / 10.0;
        let sides = [tenth(25, 35), tenth(25, 35), tenth(25, 35)];
        let angles = [tenth(300, 800), tenth(300, 800), tenth(300, 800)];
        let [ab, ac, bc] = sides;
        let x = (ab * ab + ac * ac - bc * bc) / (2.0 * ab);
        let y = (ac * ac - x * x).sqrt();
        let [adb, adc, bdc] = angles;
        let problem = parse(&format!(
            r#"
            name = "seen"
            dimension = 3
            [points]
            a = [0, 0, 0]
            b = [{ab}, 0, 0]
            c = [{x}, {y}, 0]
            d = [1.2, 1, 2]
            [constraints]
            distances = [["a", "b", {ab}], ["a", "c", {ac}], ["b", "c", {bc}]]
            angles = [["a", "d", "b", {adb}], ["a", "d", "c", {adc}], ["b", "d", "c", {bdc}]]
            "#
        ));
        let options = Options {
            most_boxes: 30_000,
            ..Options::default()
        };
        let result = all(&problem, &options).unwrap();
        if result.status != Status::Complete {
            continue;
        }
        complete += 1;
        figures += result.solutions.len();
        assert_eq!(result.solutions.len(), sights(sides, angles), "{angles:?}");
    }
    assert!(
        complete >= least && figures >= some,
        "{complete}, {figures}"
    );
}

#[test]
fn three_points_seen_under_three_angles() {
    seen_under_three_angles(6, [4, 3]);
}

#[test]
#[ignore = "a quarter of a minute"]
fn many_points_seen_under_three_angles() {
    seen_under_three_angles(12, [9, 6]);
}

/// How often the last equation changes its sign along s.
fn sights([ab, ac, bc]: [f64; 3], degrees: [f64; 3]) -> usize {
    let [p, q, r] = degrees.map(|d| d.to_radians().cos());
    // No three lines of sight have such angles.
    if 1.0 + 2.0 * p * q * r <= p * p + q * q + r * r {
        return 0;
    }
    let root = |s: f64, side: f64, cosine: f64, sign: f64| {
        let rest = side * side - s * s * (1.0 - cosine * cosine);
        (rest >= 0.0).then(|| s * cosine + sign * rest.sqrt())
    };
    let longest = ab / (1.0 - p * p).sqrt();
    let shortest = longest.min(ac / (1.0 - q * q).sqrt());
    let mut count = 0;
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let mut before: Option<f64> = None;
        const STEPS: usize = 200_000;
        for k in 1..STEPS {
            let s = shortest * k as f64 / STEPS as f64;
            let (t, u) = (root(s, ab, p, signs[0]), root(s, ac, q, signs[1]));
            let now = match (t, u) {
                (Some(t), Some(u)) if t > 0.0 && u > 0.0 => {
                    Some(t * t + u * u - 2.0 * t * u * r - bc * bc)
                }
                _ => None,
            };
            if let (Some(a), Some(b)) = (before, now) {
                count += usize::from((a < 0.0) != (b < 0.0));
            }
            before = now;
        }
    }
    count
}

#[test]
fn the_pentahedron_is_complete() {
    let problem = Problem::read("problems/constraints/pentahedron.toml").unwrap();
    let result = searched(&problem);
    assert_eq!((result.status, result.count), (Status::Complete, Some(9)));
    assert_eq!(result.symmetry, Symmetry::Isometries);
    let constructed = result.constructed.unwrap();
    assert_eq!((constructed.unknowns, constructed.parameters), (16, 2));
    assert!(holds_the_path(&problem, &result).unwrap() >= 9);
}

/// A fixed line of its own: the equations know the square of one component of its direction, and with the other sign it is
/// another line.
#[test]
fn a_fixed_direction_has_the_sign_of_the_sketch() {
    let problem = parse(
        r#"
        name = "line"
        dimension = 2
        [points]
        a = [0, 1]
        b = [2, 3]
        [lines]
        l = { point = [1.24, -0.59], direction = [-3.3, 1.02] }
        [constraints]
        fixed = ["a", "l"]
        distances = [["a", "b", 3]]
        on = [["b", "l"]]
        "#,
    );
    let result = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    assert!(result.both_ways.is_empty());
    // Where the line meets the circle of radius 3 about a.
    let (p, d) = ([1.24, -0.59], [-3.3f64, 1.02]);
    let size = (d[0] * d[0] + d[1] * d[1]).sqrt();
    let d = d.map(|x| x / size);
    let from = [p[0], p[1] - 1.0];
    let along = from[0] * d[0] + from[1] * d[1];
    let root = (along * along - from[0] * from[0] - from[1] * from[1] + 9.0).sqrt();
    let mut wanted = [-1.0, 1.0].map(|sign| {
        let s = sign * root - along;
        [p[0] + s * d[0], p[1] + s * d[1]]
    });
    wanted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut found: Vec<[f64; 2]> = result.solutions.iter().map(|s| place(s, 1)).collect();
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(found.len(), 2);
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((found[0] - wanted[0]).hypot(found[1] - wanted[1]) < 1e-9);
    }
}

/// A line of its own whose direction is known up to its sign, and a circle that it touches on one side; and one whose reversal is
/// another zero of equal angles that both are right: figures with both directions are counted, those that differ in nothing
/// but the direction once.
#[test]
fn directions_that_constraints_tell_apart_are_both_counted() {
    let touches = r#"
        name = "touches"
        dimension = 2
        [points]
        m = [1, 2]
        n = [5, 2.5]
        c = [4, 4]
        [lines]
        l = { point = [0, 0.5], direction = [1, 0] }
        [circles]
        k = { center = "m", radius = 1.1 }
        [constraints]
        fixed = ["m", "n"]
        horizontal = ["l"]
        radii = [["k", 1]]
        tangent = [["k", "l"]]
        on = [["c", "l"]]
        distances = [["c", "n", 3]]
    "#;
    let right = r#"
        name = "right"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [0.1, 3]
        d = [4.1, 3]
        [lines]
        l = { point = [0, 0], direction = [0.03, 1] }
        [constraints]
        distances = [["a", "b", 4], ["a", "c", 3], ["b", "d", 3]]
        on = [["a", "l"]]
        perpendicular = [["l", "a", "b"]]
        equal_angles = [["l", "a", "b", "a", "b", "b", "d"]]
        angles = [["b", "a", "c", 80]]
    "#;
    let result = searched(&parse(touches));
    assert_eq!((result.status, result.count), (Status::Complete, Some(4)));
    assert_eq!(result.both_ways, ["l"]);
    // The line is a unit above or below m, and c on it and 3 from n.
    let mut found: Vec<[f64; 2]> = result.solutions.iter().map(|s| place(s, 2)).collect();
    found.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    let root = |y: f64| (9.0 - (y - 2.5) * (y - 2.5)).sqrt();
    let wanted = [
        [5.0 - root(1.0), 1.0],
        [5.0 + root(1.0), 1.0],
        [5.0 - root(3.0), 3.0],
        [5.0 + root(3.0), 3.0],
    ];
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((found[0] - wanted[0]).hypot(found[1] - wanted[1]) < 1e-9);
    }
    // d on the side of c, and on the other; the line is the same with either direction.
    let result = searched(&parse(right));
    assert_eq!((result.status, result.count), (Status::Complete, Some(2)));
    assert!(result.both_ways.is_empty());
    let side = |solution: &Solution| place(solution, 3)[1] * place(solution, 2)[1] > 0.0;
    let sides: Vec<bool> = result.solutions.iter().map(side).collect();
    assert!(sides.contains(&true) && sides.contains(&false), "{sides:?}");
}

/// A chord through the middle of its circle, at a right angle to a slanted line: however the radii are said to be equal, there are two figures, and
/// no curve of chords without length is taken for figures.
#[test]
fn chords_through_the_middle_are_complete() {
    let with = |radii: &str, c: &str| {
        format!(
            r#"
            name = "chord"
            dimension = 2
            [points]
            p = [3, 0.1]
            q = [-1, 0]
            c = {c}
            m = [2, 5]
            [lines]
            chord = ["p", "q"]
            axis = ["c", "m"]
            [constraints]
            fixed = ["c", "m"]
            on = [["c", "chord"]]
            perpendicular = [["chord", "axis"]]
            {radii}
            "#
        )
    };
    let both = r#"distances = [["c", "p", 2], ["q", "c", 2]]"#;
    let one = "equal = [[\"c\", \"p\", \"c\", \"q\"]]\ndistances = [[\"c\", \"q\", 2]]";
    for radii in [both, one] {
        for c in ["[1, 0]", "[0, 0]"] {
            assert_eq!(count(&with(radii, c)), 2, "{radii}, {c}");
        }
    }
    // Radii that are not the same: a chord that is none, with c between its ends or beyond them.
    let other = r#"distances = [["c", "p", 2], ["q", "c", 3]]"#;
    assert_eq!(count(&with(other, "[1, 0]")), 4);
}

/// A bar of no length, p = q, has no direction that a spoke could be parallel to, so that the spoke may turn: that is no curve of figures.
#[test]
fn a_spoke_along_a_bar_of_no_length_is_not_called_flexible() {
    let problem = parse(
        r#"
        name = "spoke"
        dimension = 2
        [points]
        c = [0, 0]
        a = [4, 0]
        m = [1, 5]
        p = [2, 1]
        q = [2.1, 1.2]
        z = [0.5, -0.6]
        [lines]
        bar = ["p", "q"]
        axis = ["c", "m"]
        spoke = ["c", "z"]
        [constraints]
        fixed = ["c", "m", "a"]
        perpendicular = [["bar", "axis"]]
        parallel = [["bar", "spoke"]]
        distances = [["c", "p", 3], ["c", "q", 3], ["a", "p", 2.5], ["c", "z", 1]]
        "#,
    );
    let result = searched(&problem);
    assert_eq!(result.status, Status::Partial);
    assert_eq!(result.solutions.len(), 4);
    let mut undecided = result.undecided.iter();
    assert!(
        undecided.all(|part| part.why == Why::Vanishing),
        "{:?}",
        result.undecided
    );
}
