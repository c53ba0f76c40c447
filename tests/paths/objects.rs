//! Where lines, planes, circles, spheres and arcs are: in results, in JSON, on pages and in pictures.

use krawl::interval::Interval;
use krawl::problem::Problem;
use krawl::report::page::Page;
use krawl::report::{Document, Run, to_table};
use krawl::system::Located;
use krawl::track::{Control, Options, Outcome, Space, Status, Trace, solve};

const PLANE: &str = r#"
name = "in the plane"
dimension = 2

[points]
a = [0, 0]
b = [4, 0.1]
c = [1.2, 2.1]
d = [3.1, 1.4]
e = [0.1, 1.2]

[lines]
base = ["a", "b"]
own = { point = [0.2, 2.3], direction = [4, -2.1] }

[circles]
hole = { center = "c", radius = 0.7 }

[arcs]
bow = { center = "a", start = "e", end = "d" }

[constraints]
distances = [["a", "b", 4.2], ["a", "c", 2.5], ["b", "c", 3.4], ["c", "d", 2], ["e", "c", 1.5]]
on = [["d", "own"], ["c", "own"], ["e", "hole"]]
radii = [["bow", 3.3]]
"#;

const SPACE: &str = r#"
name = "in space"
dimension = 3

[points]
a = [0, 0, 0]
b = [3, 0.1, 0]
c = [1, 2.2, 0.1]
d = [1.2, 1, 2]

[planes]
base = ["a", "b", "c"]
own = { point = [0, 0, 1.9], normal = [0.1, 0, 1] }

[spheres]
ball = { center = "d", radius = 1.8 }

[constraints]
distances = [["a", "b", 3.1], ["a", "c", 2.4], ["b", "c", 3], ["a", "d", 2.6], ["b", "d", 2.4], ["d", "base", 1.9]]
on = [["d", "own"]]
parallel = [["base", "own"]]
tangent = [["ball", "base"]]
"#;

type Vector = [Interval; 3];

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: &Vector, b: &Vector) -> Interval {
    (0..3).fold(krawl::interval::point(0.0), |sum, k| sum + a[k] * b[k])
}

fn holds(x: Interval, wanted: f64) -> bool {
    x.contains(wanted) && x.wid() < 1e-9
}

/// What the constraints say of the objects, in intervals.
fn check(problem: &Problem, outcome: &Outcome) {
    assert!(!outcome.solutions.is_empty());
    for solution in &outcome.solutions {
        let at = |name: &str| *solution.point(problem, name).unwrap();
        let object = |name: &str| *solution.object(problem, name).unwrap();
        if problem.dimension == 2 {
            let Located::Round { center, radius } = object("bow") else {
                panic!("an arc")
            };
            assert!(holds(radius, 3.3) && center == at("a"));
            let Located::Round { radius, .. } = object("hole") else {
                panic!("a circle")
            };
            assert!(holds(radius, 1.5), "{radius:?}");
            let Located::Line { point, direction } = object("own") else {
                panic!("a line")
            };
            assert!(holds(dot(&direction, &direction), 1.0));
            for name in ["c", "d"] {
                let across = minus(&at(name), &point);
                let area = direction[0] * across[1] - direction[1] * across[0];
                assert!(holds(area, 0.0), "{name}: {area:?}");
            }
        } else {
            let Located::Round { radius, .. } = object("ball") else {
                panic!("a sphere")
            };
            assert!(holds(radius, 1.9), "{radius:?}");
            let normals = ["own", "base"].map(|name| match object(name) {
                Located::Plane { point, normal } => {
                    let on_it = if name == "own" { "d" } else { "c" };
                    let height = dot(&normal, &minus(&at(on_it), &point));
                    assert!(holds(height, 0.0), "{name}: {height:?}");
                    normal
                }
                other => panic!("{other:?}"),
            });
            assert!(holds(dot(&normals[0], &normals[1]).abs(), 1.0));
        }
    }
}

fn run(problem: &Problem, options: &Options) -> (Outcome, Trace) {
    let mut trace = Trace::default();
    let mut control = Control {
        trace: Some(&mut trace),
        ..Control::default()
    };
    let outcome = solve(problem, options, &mut control).unwrap();
    (outcome, trace)
}

#[test]
fn results_enclose_objects() {
    for text in [PLANE, SPACE] {
        let problem = Problem::parse(text, "objects.toml").unwrap_or_else(|e| panic!("{e}"));
        let (outcome, trace) = run(&problem, &Options::certified());
        assert!(
            !matches!(outcome.status, Status::Stopped(_)),
            "{:?}",
            outcome.status
        );
        check(&problem, &outcome);

        let table = to_table(&problem, &outcome, None);
        let lines: &[&str] = match problem.dimension {
            2 => &[
                "circle hole: centre c, radius 1.50",
                "arc bow: centre a, radius 3.30",
                "line own: through (",
            ],
            _ => &["sphere ball: centre d, radius 1.90", "plane own: through ("],
        };
        for line in lines {
            assert!(table.contains(line), "{line}\n{table}");
        }

        let options = Options::certified();
        let written = Document::solve(&Run {
            problem: &problem,
            options: &options,
            outcome: &outcome,
            trace: Some(&trace),
            samples: 30,
            tested: None,
        });
        let json = serde_json::to_value(&written).unwrap();
        let round = ["hole", "ball"][problem.dimension - 2];
        let radius = [1.5, 1.9][problem.dimension - 2];
        let bounds = &json["solutions"][0]["objects"][round]["radius"];
        let (low, high) = (bounds[0].as_f64().unwrap(), bounds[1].as_f64().unwrap());
        assert!(low <= radius && radius <= high);
        // The first sample is the sketch.
        let sketch = [0.7, 1.8][problem.dimension - 2];
        let first = json["samples"][0]["objects"][round]["radius"]
            .as_f64()
            .unwrap();
        assert!(outcome.status != Status::Closed || (first - sketch).abs() < 1e-9);
        // A float, which the problem's unit may have rounded once.
        let drawn = json["sketch_objects"][round]["radius"].as_f64().unwrap();
        assert!((drawn - sketch).abs() <= f64::EPSILON * sketch);
        let schema = std::fs::read_to_string("docs/schema/result.schema.json").unwrap();
        let schema: serde_json::Value = serde_json::from_str(&schema).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        let faults: Vec<String> = validator
            .iter_errors(&json)
            .map(|e| e.to_string())
            .collect();
        assert!(faults.is_empty(), "{faults:?}");

        let page = Page::of(&written).unwrap();
        let kinds: Vec<&str> = page
            .shapes
            .iter()
            .map(|shape| shape.kind.as_str())
            .collect();
        let wanted: &[&str] = match problem.dimension {
            2 => &["line", "line", "circle", "arc"],
            _ => &["plane", "plane", "sphere"],
        };
        assert_eq!(kinds, wanted);
        for figure in &page.figures {
            assert_eq!(figure.outlines.len(), kinds.len(), "{}", figure.name);
        }
        let path = &page.paths[0];
        assert!(
            path.samples
                .iter()
                .all(|sample| sample.outlines.len() == kinds.len())
        );
        // One path for each outline of each figure, beside bars.
        let svg = page.to_svg();
        let strokes = svg.matches("<path").count();
        let bars = page.bars.len() * page.figures.len();
        assert_eq!(strokes, bars + kinds.len() * page.figures.len());
        let moving = page.to_moving_svg().unwrap();
        assert!(moving.matches("attributeName=\"d\"").count() >= page.bars.len() + kinds.len());
    }
}

#[test]
fn float_runs_find_them_in_the_same_places() {
    for text in [PLANE, SPACE] {
        let problem = Problem::parse(text, "objects.toml").unwrap();
        let (proved, _) = run(&problem, &Options::certified());
        let (seen, _) = run(&problem, &Options::float(Space::Full));
        for solution in &seen.solutions {
            let radius = |located: &Located| match located {
                Located::Round { radius, .. } => Some(radius.mid()),
                _ => None,
            };
            let radii: Vec<f64> = solution.objects.iter().filter_map(radius).collect();
            let known: Vec<f64> = proved.solutions[0]
                .objects
                .iter()
                .filter_map(radius)
                .collect();
            assert_eq!(radii.len(), known.len());
            assert!(radii.iter().zip(&known).all(|(x, y)| (x - y).abs() < 1e-9));
        }
    }
}
