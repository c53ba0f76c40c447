//! Equations of one's own: sets of all solutions beside each other and beside Newton's method from many starts, paths and edits,
//! certificates of them.

use assert_cmd::Command;
use krawl::complete::{Options, Status, all};
use krawl::complex::{Export, export, lower_in_squares};
use krawl::edit::{Ending, Session, Setting};
use krawl::import::polynomials;
use krawl::problem::Problem;
use krawl::system::Located;
use krawl::track::prove;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

fn read(text: &str) -> Problem {
    Problem::parse(text, "equations.toml").unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The numbers of each solution, in the order of the file, and whether there are no others, proved.
fn real(problem: &Problem) -> (Vec<Vec<f64>>, bool) {
    let found = all(problem, &Options::default()).unwrap();
    let numbers = |objects: &[Located]| -> Vec<f64> {
        let number = |object: &Located| match object {
            Located::Number(number) => {
                assert!(number.wid() < 1e-9 * number.mag().max(1.0));
                Some(number.mid())
            }
            _ => None,
        };
        objects.iter().filter_map(number).collect()
    };
    let solutions = found.solutions.iter().map(|s| numbers(&s.objects));
    (solutions.collect(), found.status == Status::Complete)
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(x, y)| (x - y).abs() < 1e-9 * x.abs().max(1.0))
}

/// Each wanted one is there, and no other.
fn are(found: &[Vec<f64>], wanted: &[Vec<f64>]) {
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for one in wanted {
        assert!(
            found.iter().any(|other| near(one, other)),
            "{one:?}: {found:?}"
        );
    }
}

/// 1/x may be as large as it likes until the circle is looked at, and is known to twelve digits as soon as that is so.
#[test]
fn quotients_are_complete() {
    for (ratio, over) in [("1/3", 3.0), ("1/4", 4.0), ("0.42", 1.0 / 0.42), ("2", 0.5)] {
        let text = format!(
            "name = \"quotient\"\nequations = [\"x^2 + y^2 = 4\", \"y/x = {ratio}\"]\n[unknowns]\nx = 1.9\ny = 0.63\n"
        );
        let (found, is_complete) = real(&read(&text));
        let y = 2.0 / 1f64.hypot(over);
        assert!(is_complete, "{ratio}");
        are(&found, &[vec![over * y, y], vec![-over * y, -y]]);
    }
}

#[test]
fn a_circle_and_a_hyperbola_meet_in_four_places() {
    let text = std::fs::read_to_string("docs/examples/circle-hyperbola.toml").unwrap();
    let (found, is_complete) = real(&read(&text));
    assert!(is_complete);
    // (x + y)² = 6 and (x − y)² = 2; x and −x are two numbers.
    let (sum, difference) = (6f64.sqrt(), 2f64.sqrt());
    let places = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[s, d]| {
        vec![
            (s * sum + d * difference) / 2.0,
            (s * sum - d * difference) / 2.0,
            4.0,
        ]
    });
    are(&found, &places);
}

/// Systems for other programs have the solutions of the problems that they were made of: each is read again as what it is.
#[test]
fn what_is_exported_is_read_again() {
    let triangles = "dimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nc = [1, 2]\nd = [2, -2]\n[constraints]\n\
        distances = [[\"a\", \"b\", 3], [\"a\", \"c\", 2], [\"b\", \"c\", 2.5], [\"a\", \"d\", 2.5], [\"b\", \"d\", 2]]\n";
    let curves = std::fs::read_to_string("docs/examples/circle-hyperbola.toml").unwrap();
    // What is seen from its first two points is there four times, with x and y of either sign.
    for (text, times) in [(triangles, 4), (&curves, 1)] {
        let problem = read(text);
        let wanted = times * all(&problem, &Options::default()).unwrap().count.unwrap();
        let system = lower_in_squares(&problem).unwrap().system;
        for to in [
            Export::PhcPack,
            Export::Macaulay2,
            Export::Msolve,
            Export::HomotopyContinuation,
        ] {
            let exported = export(&system, to, 1.0).unwrap();
            let made = polynomials::problem_file(&exported).unwrap().unwrap();
            let (found, is_complete) = real(&read(&made));
            assert!(is_complete, "{made}");
            assert_eq!(found.len() as u64, wanted, "{made}");
        }
    }
}

#[test]
fn higher_degrees_decimals_roots_and_quotients() {
    // Each with its solutions, by formulas.
    let cubic: Vec<Vec<f64>> = (0..3)
        .map(|k| {
            let angle = (0.25f64.acos() + f64::from(k) * std::f64::consts::TAU) / 3.0;
            vec![2.0 * angle.cos()]
        })
        .collect();
    are(
        &real(&read(
            "equations = [\"x^3 - 3*x = 1/2\"]\n[unknowns]\nx = 1.9\n",
        ))
        .0,
        &cubic,
    );
    let root = vec![vec![0.1f64.powf(0.25)], vec![-(0.1f64.powf(0.25))]];
    let (found, is_complete) = real(&read(
        "equations = [\"123.456*x^4 = 12.3456\"]\n[unknowns]\nx = 1\n",
    ));
    are(&found, &root);
    assert!(is_complete);
    // √x is not negative: x = 3 − 2√x has one solution, and x = 9 is none.
    let (found, is_complete) = real(&read(
        "equations = [\"x = 3 - 2*sqrt(x)\"]\n[unknowns]\nx = 2\n",
    ));
    are(&found, &[vec![1.0]]);
    assert!(is_complete);
    // x + 1/x = 5/2.
    let (found, is_complete) = real(&read(
        "equations = [\"x + 1/x == 5/2\"]\n[unknowns]\nx = 1.5\n",
    ));
    are(&found, &[vec![2.0], vec![0.5]]);
    assert!(is_complete);
}

/// √0 = 0 is a solution that the equations of a root do not have: it is said.
#[test]
fn what_is_under_a_root_is_supposed_to_be_positive() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("root.toml");
    let text = "equations = [\"sqrt(x) = y\", \"y*(y - 1) = 0\"]\n[unknowns]\nx = 0.5\ny = 0.6\n";
    std::fs::write(&file, text).unwrap();
    for verb in ["all", "solve"] {
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args([verb, file.to_str().unwrap()])
            .output()
            .unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        let words = "What is under a root in `sqrt(x) = y` is supposed to be greater than 0";
        assert!(said.contains(words), "{verb}: {said}");
    }
}

/// A square has two roots, also where blocks are solved one by one: a number has no side on which it is drawn.
#[test]
fn blocks_take_both_roots_of_a_number() {
    use krawl::track::{Control, Options};
    let problem =
        read("equations = [\"4*x^2 = 123.456\", \"y^2 = x + 10\"]\n[unknowns]\nx = 1\ny = 3\n");
    let figures =
        krawl::blocks::Figures::find(&problem, &Options::certified(), &mut Control::default());
    let figures = figures.unwrap();
    assert_eq!(figures.count(), Some(4));
    let (found, is_complete) = real(&problem);
    assert!(is_complete);
    assert_eq!(found.len(), 4);
    for number in 0..4 {
        let (_, numbers) = figures.figure(number);
        let numbers: Vec<f64> = numbers.iter().map(|x| x.number().unwrap().mid()).collect();
        assert!(found.iter().any(|one| near(one, &numbers)), "{numbers:?}");
    }
}

/// Sixteen of katsura-5's 32 complex solutions are real: counted by two searches that share no step, one of which is checked
/// again by its certificate.
#[test]
fn katsura_5_is_told_by_two_searches() {
    let problem = Problem::read("docs/examples/katsura-5.toml").unwrap();
    let (found, is_complete) = real(&problem);
    assert!(is_complete);
    let lowered = krawl::complex::lower(&problem).unwrap();
    assert_eq!(lowered.bound.as_ref().unwrap().count, 32);
    let filling = krawl::complex::Filling {
        enough: lowered.enough(),
        patience: 100,
        ..Default::default()
    };
    let fibre = krawl::complex::fill(&lowered.system, &filling).unwrap();
    assert_eq!(fibre.solutions.len(), 32);
    let template = krawl::complex::Template::new("katsura-5", fibre);
    let solutions = krawl::complex::solve(&lowered, &template, &Default::default());
    assert_eq!(solutions.status, krawl::complex::Status::Complete);
    let is_real = |nature: &&krawl::complex::Nature| **nature == krawl::complex::Nature::Real;
    assert_eq!(
        solutions.natures.iter().filter(is_real).count(),
        found.len()
    );
    assert_eq!(found.len(), 16);
}

/// The eigenvalues 3 and 3 ± √3 of a matrix are as many as the bound of the groups of unknowns allows, where the product of the degrees is 8.
#[test]
fn a_matrix_has_no_more_eigenvalues_than_rows() {
    let problem = Problem::read("docs/examples/eigenvalues.toml").unwrap();
    let lowered = krawl::complex::lower(&problem).unwrap();
    assert_eq!(lowered.bound.as_ref().unwrap().count, 3);
    let fibre = krawl::complex::fill(&lowered.system, &Default::default()).unwrap();
    let template = krawl::complex::Template::new("eigenvalues", fibre);
    let solutions = krawl::complex::solve(&lowered, &template, &Default::default());
    assert_eq!(solutions.status, krawl::complex::Status::Complete);
    let (mut found, _) = real(&problem);
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let roots = [3.0 - 3f64.sqrt(), 3.0, 3.0 + 3f64.sqrt()];
    assert!(near(
        &found.iter().map(|one| one[0]).collect::<Vec<_>>(),
        &roots
    ));
    assert_eq!(solutions.real().count(), 3);
}

/// From powers of the unknowns, or products of linear functions of groups of them, as many paths as the Bézout numbers say come to all
/// solutions of a random instance; the others go to infinity. Noon-3's number is that published, a matrix has as many eigenvalues as rows, and
/// the others are those of eliminating by hand.
#[test]
fn zeros_that_are_known_lead_to_all_solutions() {
    let cases: [(&str, &[&str], usize, usize); 8] = [
        ("x", &["x^5 - x = 1"], 5, 5),
        ("x y", &["x^2 + 2*y^2 = 3", "x*y + 0.3*x = 1/7"], 4, 4),
        (
            "x y",
            &["x^3 + y^3 + x*y = 2", "x^2*y - 3*y^2 + x = 1"],
            9,
            9,
        ),
        ("x y", &["x^4 + y = 1", "y - 2*x^2 = 3"], 6, 4),
        // A quotient is an unknown, with an equation of degree 2.
        ("x y", &["1/(x + y) + y = 3", "x - y^2 = 1"], 4, 3),
        (
            "x y z",
            &[
                "x*y^2 + x*z^2 - 1.1*x + 1 = 0",
                "y*x^2 + y*z^2 - 1.1*y + 1 = 0",
                "z*x^2 + z*y^2 - 1.1*z + 1 = 0",
            ],
            27,
            21,
        ),
        (
            "l x y z",
            &[
                "2*x + y - z = l*x",
                "x + 3*y + z = l*y",
                "y + 4*z + x = l*z",
                "x + 0.3*y - 0.2*z = 1",
            ],
            3,
            3,
        ),
        // Each in two of the three unknowns, as chances of mixed strategies are.
        (
            "x y z",
            &[
                "1 + 2*y - 3*z + 5*y*z = 0",
                "2 - x + 4*z - 3*x*z = 0",
                "3 + x - 7*y + 2*x*y = 0",
            ],
            2,
            2,
        ),
    ];
    for (unknowns, equations, paths, solutions) in cases {
        let text = format!(
            "equations = {equations:?}\n[unknowns]\n{}",
            unknowns.replace(' ', " = 0.6\n") + " = 0.7\n"
        );
        let lowered = krawl::complex::lower(&read(&text)).unwrap();
        let filling = krawl::complex::Filling {
            enough: lowered.enough(),
            ..Default::default()
        };
        let fibre = krawl::complex::fill(&lowered.system, &filling).unwrap();
        let led = fibre.led.expect("paths from known zeros");
        let found = fibre.solutions.len();
        assert_eq!((led.paths, found), (paths, solutions), "{text} {led:?}");
        assert_eq!(
            (led.infinite, led.stopped),
            (paths - solutions, 0),
            "{text}"
        );
    }
}

/// Where a search of boxes takes long the real solutions are those among as many complex ones as Bézout's bound allows: katsura-7's
/// 44, in boxes that hold what Newton's method finds from them. What has fewer complex solutions is left to the search of boxes.
#[test]
fn real_solutions_are_told_by_all_complex_ones() {
    let size = 7isize;
    let mut equations: Vec<String> = (0..size)
        .map(|m| {
            let products = (-size..=size).filter(|l| (m - l).abs() <= size);
            let terms: Vec<String> = products
                .map(|l| format!("x{}*x{}", l.abs(), (m - l).abs()))
                .collect();
            format!("{} = x{m}", terms.join(" + "))
        })
        .collect();
    equations.push("x0 + 2*x1 + 2*x2 + 2*x3 + 2*x4 + 2*x5 + 2*x6 + 2*x7 = 1".to_owned());
    let unknowns: String = (0..=size).map(|k| format!("x{k} = 0.1\n")).collect();
    let problem = read(&format!(
        "equations = {equations:?}\n[unknowns]\n{unknowns}"
    ));
    let found = all(&problem, &Options::default()).unwrap();
    assert_eq!((found.status, found.complex), (Status::Complete, Some(128)));
    assert_eq!(found.count, Some(44));
    for one in &found.solutions {
        let x: Vec<f64> = one
            .objects
            .iter()
            .map(|x| x.number().unwrap().mid())
            .collect();
        for m in 0..size {
            let products = (-size..=size).filter(|l| (m - l).abs() <= size);
            let sum: f64 = products
                .map(|l| x[l.unsigned_abs()] * x[(m - l).unsigned_abs()])
                .sum();
            assert!((sum - x[m as usize]).abs() < 1e-12, "{x:?}");
        }
    }
    // What a search of boxes ends with undecided, as an unknown may be large.
    let cubic = read("equations = [\"2*x*x + x^3 + 0*x = 3\"]\n[unknowns]\nx = 1\n");
    let cubic = all(&cubic, &Options::default()).unwrap();
    assert_eq!((cubic.status, cubic.count), (Status::Complete, Some(1)));
    // More equations than unknowns are tested as they were.
    for (equations, count) in [
        ("\"x^2 + y^2 = 5\", \"x*y = 2\", \"x + y = 3\"", 2),
        ("\"x^2 + y^2 = 5\", \"x*y = 2\", \"x + y = 4\"", 0),
    ] {
        let text = format!("equations = [{equations}]\n[unknowns]\nx = 1\ny = 2.1\n");
        let problem = Problem::parse_loosely(&text, "equations.toml").unwrap();
        let found = all(&problem, &Options::default()).unwrap();
        assert_eq!(
            (found.status, found.count),
            (Status::Complete, Some(count)),
            "{text}"
        );
    }
    // x^4 + y = 1 and y = 3 + 2 x^2 have no real solution, and four complex ones of at most eight.
    let (found, is_complete) = real(&read(
        "equations = [\"x^4 + y = 1\", \"y - 2*x^2 = 3\"]\n[unknowns]\nx = 1\ny = 2\n",
    ));
    assert!(is_complete && found.is_empty());
}

/// The same points with another number are another solution, and no congruence makes one of them.
#[test]
fn figures_with_other_numbers_are_other_solutions() {
    let problem = read(
        "dimension = 2\nequations = [\"x^2 = 2\", \"|A-B|*x*y = 3\"]\n[points]\nA = [0, 0]\nB = [4, 0]\nC = [1, 2]\n\
         [unknowns]\nx = 1.4\ny = 1\n\
         [constraints]\ndistances = [[\"A\", \"B\", 4], [\"B\", \"C\", 3], [\"A\", \"C\", 3]]\n",
    );
    let (found, is_complete) = real(&problem);
    assert!(is_complete);
    let x = 2f64.sqrt();
    are(&found, &[vec![x, 0.75 / x], vec![-x, -0.75 / x]]);
}

/// What is said of Apollonius' circle of the ratio k: (x − c)² + y² = r².
#[test]
fn points_and_distances_stand_in_equations() {
    let problem = Problem::read("docs/examples/apollonius.toml").unwrap();
    assert!(problem.is_absolute());
    let outcome = prove(&problem).unwrap();
    let places: Vec<f64> = outcome
        .solutions
        .iter()
        .map(|s| s.points[2][0].mid())
        .collect();
    let half = (64.0f64 / 9.0 - 2.25).sqrt();
    assert_eq!(places.len(), 2);
    for wanted in [16.0 / 3.0 - half, 16.0 / 3.0 + half] {
        assert!(
            places.iter().any(|x| (x - wanted).abs() < 1e-12),
            "{places:?}"
        );
    }
}

#[test]
fn parameters_are_dimensions() {
    let problem = Problem::read("docs/examples/circle-hyperbola.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    // It stands in equations, and nothing else is computed from it.
    let setting = Setting::parse(&problem, "a=6.25").unwrap();
    let edited = session.edit(&[setting]);
    assert_eq!(edited.ending, Ending::Reached);
    let numbers: Vec<f64> = edited
        .objects
        .iter()
        .map(|x| x.number().unwrap().mid())
        .collect();
    // (x + y)² = 8.25, (x − y)² = 4.25, x the greater as it was.
    let (sum, difference) = (8.25f64.sqrt(), 4.25f64.sqrt());
    let wanted = [(sum + difference) / 2.0, (sum - difference) / 2.0, 6.25];
    assert!(near(&numbers, &wanted), "{numbers:?}");
    // Where both meet the circle touches: a = 2.
    let setting = Setting::parse(session.problem(), "a=1").unwrap();
    let edited = session.edit(&[setting]);
    let Ending::Limit(_) = edited.ending else {
        panic!("{:?}", edited.ending)
    };
    assert!(edited.dimensions[0].value.contains(2.0), "{edited:?}");
}

#[test]
fn what_is_written_reads_back_equal() {
    for file in ["katsura-5", "apollonius", "circle-hyperbola"] {
        let problem = Problem::read(format!("docs/examples/{file}.toml")).unwrap();
        let again = Problem::parse(&problem.to_toml(), "again.toml").unwrap();
        assert_eq!(again.objects, problem.objects, "{file}");
        assert_eq!(again.constraints, problem.constraints, "{file}");
        assert_eq!(again.points, problem.points, "{file}");
    }
}

#[test]
fn certificates_of_equations_are_verified() {
    let directory = tempfile::tempdir().unwrap();
    let krawl = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_krawl"))
            .args(arguments)
            .output()
            .unwrap();
        String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
    };
    let cert = directory.path().join("set.krawl");
    let cert = cert.to_str().unwrap();
    for (file, count) in [("circle-hyperbola", 4), ("katsura-5", 16)] {
        let file = format!("docs/examples/{file}.toml");
        krawl(&["all", &file, "--cert", cert, "--quiet"]);
        let verdict = krawl(&["verify", cert, &file]);
        let words = format!(
            "VERIFIED: {} has exactly {count} solutions",
            Problem::read(&file).unwrap().name
        );
        assert!(verdict.contains(&words), "{verdict}");
        assert!(verdict.contains("exactly."), "{verdict}");
        krawl(&["solve", &file, "--cert", cert, "--quiet"]);
        let verdict = krawl(&["verify", cert, &file]);
        assert!(verdict.contains("VERIFIED"), "{verdict}");
        // Of another system it proves nothing.
        let other = directory.path().join("other.toml");
        let text = std::fs::read_to_string(&file)
            .unwrap()
            .replacen("= 1\"", "= 1.001\"", 1);
        std::fs::write(&other, text).unwrap();
        let verdict = krawl(&["verify", cert, other.to_str().unwrap()]);
        assert!(!verdict.contains("exactly."), "{verdict}");
    }
}

/// A random system of two equations of degree two, with whole coefficients, of which an ellipse is one.
fn system(of: [i32; 10]) -> String {
    let [a, b, c, d, e, f, g, h, i, j] = of;
    format!(
        "equations = [\"{a}*x^2 + {b}*x*y + {c}*y^2 + {d}*x + {e}*y = 30\", \"{f}*x^2 + {g}*x*y + {h}*y^2 + {i}*x + {j}*y = 2\"]\n\
         [unknowns]\nx = 1.7\ny = -0.6\n"
    )
}

/// Newton's method from many starts finds no solution that is not among those that are said to be all, and comes to each of them.
fn are_all_found(of: [i32; 10]) -> Result<(), TestCaseError> {
    let Ok(problem) = Problem::parse(&system(of), "random.toml") else {
        // The second equation has no x or y.
        return Ok(());
    };
    let (found, is_complete) = real(&problem);
    let [a, b, c, d, e, f, g, h, i, j] = of.map(f64::from);
    let mut seen = vec![false; found.len()];
    for start in 0..400 {
        let (mut x, mut y) = (f64::from(start % 20) - 9.7, f64::from(start / 20) - 9.4);
        for _ in 0..60 {
            let p = a * x * x + b * x * y + c * y * y + d * x + e * y - 30.0;
            let q = f * x * x + g * x * y + h * y * y + i * x + j * y - 2.0;
            let (px, py) = (2.0 * a * x + b * y + d, b * x + 2.0 * c * y + e);
            let (qx, qy) = (2.0 * f * x + g * y + i, g * x + 2.0 * h * y + j);
            let det = px * qy - py * qx;
            (x, y) = (x - (p * qy - q * py) / det, y - (q * px - p * qx) / det);
        }
        let p = a * x * x + b * x * y + c * y * y + d * x + e * y - 30.0;
        let q = f * x * x + g * x * y + h * y * y + i * x + j * y - 2.0;
        if p.is_nan() || q.is_nan() || p.abs() + q.abs() > 1e-11 {
            continue;
        }
        let known = found
            .iter()
            .position(|s| (s[0] - x).abs() + (s[1] - y).abs() < 1e-6);
        prop_assert!(
            known.is_some() || !is_complete,
            "{of:?}: {x} {y} is not among {found:?}"
        );
        known.into_iter().for_each(|k| seen[k] = true);
    }
    prop_assert!(seen.iter().all(|seen| *seen), "{of:?}: {found:?}");
    Ok(())
}

/// So many systems.
fn all_are_found(cases: u32) {
    let rest = prop::array::uniform7(-4..5i32);
    let any = (2..5i32, -1..2i32, 2..5i32, rest);
    let run = TestRunner::new(Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    })
    .run(&any, |(a, b, c, rest)| {
        let [d, e, f, g, h, i, j] = rest;
        are_all_found([a, b, c, d, e, f, g, h, i, j])
    });
    run.unwrap();
}

#[test]
fn all_of_them_are_found() {
    all_are_found(10);
}

#[test]
#[ignore = "half a minute"]
fn all_of_many_are_found() {
    all_are_found(100);
}

/// Powers may be a million times what their root is: roots that stand alone are no curve for that, whether they are found or not.
#[test]
fn single_roots_are_no_curve() {
    for most in [4, 10] {
        let factors: Vec<String> = (1..=most).map(|k| format!("(x - {k})")).collect();
        let problem = read(&format!(
            "equations = [\"{} = 0\"]\n[unknowns]\nx = 0.3\n",
            factors.join("*")
        ));
        let found = all(&problem, &Options::default()).unwrap();
        assert_ne!(found.status, Status::Flexible, "{:?}", found.undecided);
        if most == 4 {
            assert_eq!((found.status, found.count), (Status::Complete, Some(4)));
        }
    }
}

/// Circle and hyperbola have ±x and ±1/x; in a range of x those that lie in it, as closed as it is written.
#[test]
fn solutions_in_ranges_are_those_of_all_that_lie_in_them() {
    let curves = |x: &str, y: &str| {
        read(&format!(
            "equations = [\"x^2 + y^2 = 4\", \"x*y = 1\"]\n[unknowns]\nx = {x}\ny = {y}\n"
        ))
    };
    let (everywhere, _) = real(&curves("1.2", "0.5"));
    assert_eq!(everywhere.len(), 4);
    for (x, y, low, high) in [
        ("[0, 2]", "0.5", 0.0, 2.0),
        ("{ value = 7, within = [-1, 1] }", "0.5", -1.0, 1.0),
        (
            "[-inf, -0.6]",
            "{ within = [-9, inf] }",
            f64::NEG_INFINITY,
            -0.6,
        ),
        ("[0.51, 0.52]", "0.5", 0.51, 0.52),
        ("[3, 4]", "0.5", 3.0, 4.0),
    ] {
        let problem = curves(x, y);
        // Written and read again it is the same.
        assert_eq!(read(&problem.to_toml()).objects, problem.objects);
        let (found, is_complete) = real(&problem);
        let wanted = everywhere
            .iter()
            .filter(|one| (low..=high).contains(&one[0]));
        assert!(
            is_complete && found.len() == wanted.count(),
            "{x}: {found:?}"
        );
        assert!(
            found.iter().all(|one| (low..=high).contains(&one[0])),
            "{x}"
        );
    }
    // At the very end of a range: within where that is certain, undecided where it is not.
    let ends = |equation: &str, x: &str| {
        let text = format!("equations = [\"{equation}\"]\n[unknowns]\nx = {x}\n");
        all(&read(&text), &Options::default()).unwrap()
    };
    let exact = ends("x^2 = 4", "[2, 3]");
    assert!(exact.status == Status::Complete && exact.solutions.len() == 1);
    let open = ends("x^3 = 0.001", "[0.1, 3]");
    assert!(open.status == Status::Partial && open.solutions.is_empty());
    assert_eq!(open.undecided[0].why, krawl::complete::Why::Border);
}

/// The real ones of all complex solutions are told in ranges, too.
#[test]
fn katsura_5_in_a_range() {
    let mut problem = Problem::read("docs/examples/katsura-5.toml").unwrap();
    let name = problem.objects[0].name.clone();
    let (everywhere, _) = real(&problem);
    let [zero, third] = ["0", "0.3"].map(|x| Some(x.parse().unwrap()));
    problem.restrict(&name, [zero, third]).unwrap();
    let (found, is_complete) = real(&problem);
    let wanted = everywhere
        .iter()
        .filter(|one| (0.0..=0.3).contains(&one[0]));
    assert!(is_complete && found.len() == wanted.count());
}

/// Noon-4 has solutions at infinity, and 73 others of which 15 are real: a search of boxes counts them.
#[test]
fn noon_4_is_complete() {
    let equation = |i: usize| {
        let squares = (1..5).filter(|&j| j != i).map(|j| format!("x{j}^2"));
        let squares = squares.collect::<Vec<_>>().join(" + ");
        format!("\"x{i}*({squares}) - 1.1*x{i} + 1\"")
    };
    let equations = (1..5).map(equation).collect::<Vec<_>>().join(", ");
    let text =
        format!("equations = [{equations}]\n[unknowns]\nx1 = 0.3\nx2 = 0.7\nx3 = 1\nx4 = 0.4\n");
    let (found, is_complete) = real(&read(&text));
    assert!(is_complete, "{} found", found.len());
    assert_eq!(found.len(), 15);
}

/// Complex solutions to many digits: the roots of x⁴ = −4, and those of x² = 2.
#[test]
fn complex_solutions_are_told_to_many_digits() {
    use krawl::complex::{Filling, Nature, Template, fill, lower, solve};
    let told = |equation: &str| -> Vec<String> {
        let problem = read(&format!(
            "equations = [\"{equation}\"]\n[unknowns]\nx = 1\n"
        ));
        let lowered = lower(&problem).unwrap();
        let fibre = fill(&lowered.system, &Filling::default()).unwrap();
        let found = solve(
            &lowered,
            &Template::new("roots", fibre),
            &Default::default(),
        );
        let both = found.boxes.boxes().iter().zip(&found.natures);
        let both = both.map(|(one, nature)| {
            let is_real = *nature == Nature::Real;
            let digits =
                krawl::digits::complex_to_digits((&problem, &lowered), one, is_real, 30).unwrap();
            digits.numbers[0].1.clone()
        });
        let mut all: Vec<String> = both.collect();
        all.sort();
        all
    };
    let one = "1.00000000000000000000000000000";
    let mut wanted = vec![];
    for (re, im) in [("", "+"), ("", "-"), ("-", "+"), ("-", "-")] {
        wanted.push(format!("{re}{one} {im} {one}i"));
    }
    wanted.sort();
    assert_eq!(told("x^4 = -4"), wanted);
    let root = "1.41421356237309504880168872421";
    assert_eq!(told("x^2 = 2"), [format!("-{root}"), root.to_owned()]);
}
