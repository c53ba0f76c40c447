//! Solutions to many digits: against decimals of known numbers, and against the equations, in ratios.

use krawl::complete::{Options, Status, all};
use krawl::digits::to_digits;
use krawl::problem::Problem;
use krawl::rational::Rational;

fn ratio(text: &str) -> Rational {
    let (before, after) = text.split_once('.').unwrap_or((text, ""));
    let whole = format!("{before}{after}").parse().unwrap();
    let ten = Rational::from_integer(10.into());
    Rational::from_integer(whole) / ten.pow(after.len() as i32)
}

/// What all digits of a figure make of |p − q|² less d², which is to be 0 up to their last ones.
fn missed(of: &[Vec<String>], [p, q]: [usize; 2], d: &Rational) -> Rational {
    let squares = of[p].iter().zip(&of[q]).map(|(a, b)| {
        let difference = ratio(a) - ratio(b);
        &difference * &difference
    });
    squares.fold(Rational::zero(), |sum, x| sum + x) - d * d
}

#[test]
fn roots_are_what_they_are() {
    let text = "name = \"roots\"\ndimension = 2\n[unknowns]\nx = 1\ny = 2\n[constraints]\n\
                equations = [\"x^2 = 2\", \"y^3 = x + 1/3\"]\n";
    let problem = Problem::parse(text, "roots.toml").unwrap();
    let result = all(&problem, &Options::default()).unwrap();
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 2)
    );
    for solution in &result.solutions {
        let found = to_digits(&problem, &solution.points, &solution.objects, 60).unwrap();
        let [x, y] = [0, 1].map(|k| found.numbers[k].1.as_str());
        // Of √2 from tables.
        assert_eq!(
            x.trim_start_matches('-'),
            "1.41421356237309504880168872420969807856967187537694807317668"
        );
        let y = ratio(y);
        let off = &(&y * &y) * &y - ratio(x) - Rational::new(1.into(), 3.into());
        assert!(
            off.abs() < Rational::from_integer(10.into()).pow(-57),
            "{off:?}"
        );
    }
}

/// All figures of the octahedron to 45 digits: lengths of bars in ratios are off by what the last digits are, and figures lie in their boxes.
#[test]
fn figures_meet_their_distances_in_all_digits() {
    let problem = Problem::read("problems/octahedron.toml").unwrap();
    let result = all(&problem, &Options::default()).unwrap();
    assert!(!result.solutions.is_empty());
    let mut seen = problem.clone();
    seen.homotopy.reference.clone_from(&result.reference);
    for solution in &result.solutions {
        let found = to_digits(&seen, &solution.points, &solution.objects, 45).unwrap();
        for distance in &problem.distances {
            let krawl::problem::Target::Length(length) = &distance.target else {
                panic!()
            };
            let off = missed(&found.points, distance.points, length.value()).abs();
            assert!(off < Rational::from_integer(10.into()).pow(-43), "{off:?}");
        }
        for (texts, boxes) in found.points.iter().zip(&solution.points) {
            for (text, x) in texts.iter().zip(boxes) {
                let value: f64 = text.parse().unwrap();
                assert!(x.inf() - 1e-15 <= value && value <= x.sup() + 1e-15);
            }
        }
    }
    // A box beside the figure is not taken for it.
    let mut beside = result.solutions[0].points.clone();
    for point in &mut beside {
        for x in point.iter_mut().filter(|x| x.mag() > 0.0) {
            *x += krawl::interval::point(1e-9);
        }
    }
    let why = to_digits(&seen, &beside, &[], 45).unwrap_err();
    assert!(why.contains("not proved"), "{why}");
}

/// Near a double root digits are told as long as it is proved, and otherwise nothing is.
#[test]
fn near_double_roots() {
    for (gap, is_told) in [("0.000001", true), ("0.0000000000000000000000001", false)] {
        let text = format!(
            "name = \"near\"\ndimension = 2\n[unknowns]\nx = 1.001\n[constraints]\nequations = [\"(x - 1)^2 = {gap}\"]\n"
        );
        let problem = Problem::parse(&text, "near.toml").unwrap();
        let result = all(&problem, &Options::default()).unwrap();
        for solution in &result.solutions {
            let told = to_digits(&problem, &solution.points, &solution.objects, 50);
            if let Ok(found) = &told {
                let x = ratio(&found.numbers[0].1) - Rational::one();
                let off = &x * &x - ratio(gap);
                assert!(
                    off.abs() < Rational::from_integer(10.into()).pow(-48),
                    "{off:?}"
                );
            }
            assert!(told.is_ok() || !is_told, "{told:?}");
        }
        assert!(!is_told || result.solutions.len() == 2);
    }
}

/// Numbers far smaller than others have all their digits, and what is exact lies in boxes that are exact.
#[test]
fn small_numbers_and_exact_ones() {
    let text = "name = \"small\"\ndimension = 2\n[unknowns]\nx = 0.3\ny = 1.4\n[constraints]\n\
                equations = [\"3000000000000000000000*x = 1\", \"y^2 = 2\"]\n";
    let problem = Problem::parse(text, "small.toml").unwrap();
    let result = all(&problem, &Options::default()).unwrap();
    assert!(!result.solutions.is_empty());
    for solution in &result.solutions {
        for digits in [1, 30, 60] {
            let found = to_digits(&problem, &solution.points, &solution.objects, digits).unwrap();
            let expected = format!("0.{}{}", "0".repeat(21), "3".repeat(digits as usize));
            assert_eq!(found.numbers[0].1, expected);
        }
    }
    for file in [
        "problems/mechanisms/four-bar.toml",
        "problems/octahedron.toml",
    ] {
        let problem = Problem::read(file).unwrap();
        let result = all(&problem, &Options::default()).unwrap();
        let mut seen = problem.clone();
        seen.homotopy.reference.clone_from(&result.reference);
        assert!(!result.solutions.is_empty());
        for solution in &result.solutions {
            for digits in [1, 4, 50] {
                to_digits(&seen, &solution.points, &solution.objects, digits).unwrap();
            }
        }
    }
}

/// A rectangle with a constraint too many: nothing is told, as its equations are not as many as its unknowns.
#[test]
fn what_was_left_out_is_no_square_system() {
    let text = "name = \"box\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\n[constraints]\nfixed = [\"a\"]\n\
                horizontal = [[\"a\", \"b\"]]\ndistances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"a\", \"c\", 5]]\n\
                angles = [[\"a\", \"b\", \"c\", 90]]\n";
    let problem = Problem::parse_loosely(text, "box.toml").unwrap();
    let result = all(&problem, &Options::default()).unwrap();
    let solution = &result.solutions[0];
    let why = to_digits(&problem, &solution.points, &solution.objects, 20).unwrap_err();
    assert!(why.contains("not as many equations"), "{why}");
}
