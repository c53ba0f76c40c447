//! Large structures made to measure: what they are, and that small ones are solved.

use assert_cmd::Command;
use krawl::generate::{Family, GenerateError, Recipe};
use krawl::plan::Plan;
use krawl::problem::Problem;
use krawl::system::Homotopy;
use krawl::track::{Control, Options, Outcome, Space, StartError, Status, solve};

fn recipe(family: Family, size: usize, loops: usize, seed: u64) -> Recipe {
    Recipe {
        family,
        size,
        loops,
        seed,
    }
}

/// `problem` has passed all checks, as it was built.
fn is_as_wanted(recipe: &Recipe, problem: &Problem) {
    let m = problem.free_coordinates();
    let most = match recipe.family {
        Family::Strip => 1,
        Family::Tetrahedra => 2,
        Family::Chain => 11,
        Family::Tower => 8,
    };
    assert!(
        (recipe.size..=recipe.size + most).contains(&m),
        "{recipe:?}: {m}"
    );
    assert_eq!(problem.dimension, recipe.family.dimension());
    let homotopy = Homotopy::new(problem).unwrap();
    let plan = Plan::derive(&homotopy);
    assert_eq!(plan.driving(), recipe.loops, "{recipe:?}");
    let jacobian = plan.jacobian(&homotopy, &homotopy.sketch);
    assert_eq!(jacobian.keys.len(), recipe.loops);
    assert_eq!(jacobian.ignored.len(), recipe.loops);
    let ordering = jacobian.ordering();
    assert!(
        ordering
            .block_sizes()
            .iter()
            .all(|&size| size <= problem.dimension)
    );
}

#[test]
fn key_unknowns_do_not_depend_on_the_size() {
    for family in Family::ALL {
        for loops in [1, 2, 3, 5] {
            let least = family.smallest(loops);
            for (size, seed) in [(least, 1), (least, 2), (least + 7, 3), (300, 4)] {
                let recipe = recipe(family, size, loops, seed);
                is_as_wanted(&recipe, &recipe.problem().unwrap());
            }
        }
        let large = recipe(family, 3000, 2, 1);
        is_as_wanted(&large, &large.problem().unwrap());
    }
}

#[test]
fn files_say_the_same_as_the_recipe() {
    for family in Family::ALL {
        let problem = recipe(family, 60, 1, 7).problem().unwrap();
        assert_eq!(recipe(family, 60, 1, 7).problem().unwrap(), problem);
        assert_ne!(recipe(family, 60, 1, 8).problem().unwrap(), problem);
        let again = Problem::parse(&problem.to_toml(), "again.toml").unwrap();
        assert_eq!(again, problem);
        let printed = krawl()
            .args(["generate", family.name(), "--size", "60", "--seed", "7"])
            .assert()
            .code(0)
            .get_output()
            .stdout
            .clone();
        assert_eq!(String::from_utf8(printed).unwrap(), problem.to_toml());
    }
}

fn closed(problem: &Problem, options: &Options) -> Outcome {
    let outcome = solve(problem, options, &mut Control::default()).unwrap();
    assert_eq!(outcome.status, Status::Closed, "{}", problem.name);
    outcome
}

/// All modes see the same path.
fn modes_agree(recipe: &Recipe) {
    let problem = recipe.problem().unwrap();
    let proved = closed(&problem, &Options::certified());
    assert!(!proved.solutions.is_empty(), "{recipe:?} has no solutions");
    for space in [Space::Full, Space::Reduced] {
        let seen = closed(&problem, &Options::float(space));
        assert_eq!(seen.solutions.len(), proved.solutions.len(), "{recipe:?}");
        // Once round, not twice.
        let ratio = seen.length / proved.length;
        assert!((ratio - 1.0).abs() < 1e-3, "{recipe:?}: {ratio}");
    }
}

#[test]
fn small_ones_are_solved_in_all_modes() {
    for family in Family::ALL {
        for (loops, seed) in [(1, 1), (1, 2), (2, 3)] {
            modes_agree(&recipe(family, family.smallest(loops).max(40), loops, seed));
        }
        modes_agree(&recipe(family, 100, 1, 1));
    }
}

/// Their removed constraints are the long bars, which come last: with one of them for an arm within
/// a rigid body, the body would be bent by it off the path.
#[test]
fn closing_bars_are_left_over() {
    for family in [Family::Strip, Family::Tetrahedra, Family::Chain] {
        for seed in 1..4 {
            let problem = recipe(family, 1000, 3, seed).problem().unwrap();
            let plan = Plan::derive(&Homotopy::new(&problem).unwrap());
            let m = problem.free_coordinates();
            assert_eq!(plan.removed(), [m - 3, m - 2, m - 1], "{family:?} {seed}");
        }
    }
}

/// Thousands of coordinates: in the reduced space alone, where a step costs in proportion.
#[test]
fn large_ones_are_followed_in_the_reduced_space() {
    for family in Family::ALL {
        let problem = recipe(family, 3000, 2, 1).problem().unwrap();
        let seen = closed(&problem, &Options::float(Space::Reduced));
        assert!(!seen.solutions.is_empty());
    }
}

#[test]
fn dense_matrices_have_a_limit() {
    let problem = Recipe::new(Family::Chain, 7000).problem().unwrap();
    let reduced = Options {
        space: Space::Reduced,
        ..Options::certified()
    };
    for options in [Options::float(Space::Full), Options::certified(), reduced] {
        let refused = solve(&problem, &options, &mut Control::default());
        assert!(matches!(refused, Err(StartError::Unsupported(text)) if text.contains("reduced")));
    }
}

#[test]
fn what_cannot_be_made_is_refused() {
    assert_eq!(
        recipe(Family::Strip, 100, 0, 1).problem().unwrap_err(),
        GenerateError::NoLoops
    );
    for family in Family::ALL {
        let least = family.smallest(2);
        assert!(recipe(family, least, 2, 1).problem().is_ok());
        let error = recipe(family, least - 1, 2, 1).problem().unwrap_err();
        assert!(matches!(error, GenerateError::TooSmall { least: l, .. } if l == least));
        for size in [50_000, usize::MAX] {
            let error = recipe(family, size, 2, 1).problem().unwrap_err();
            let GenerateError::TooLarge { largest, .. } = error else {
                panic!("{error}")
            };
            assert!(largest > 7_000);
        }
        let huge = recipe(family, 100, usize::MAX, 1).problem();
        assert!(matches!(huge, Err(GenerateError::TooSmall { .. })));
    }
}

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

#[test]
fn the_command_line_says_what_is_wrong() {
    for (arguments, says) in [
        (
            &["generate", "strip", "--size", "3"][..],
            "needs at least 25",
        ),
        (&["generate", "tower", "--size", "99999"], "too large"),
        (
            &["generate", "chain", "--size", "90", "--loops", "0"],
            "at least 1",
        ),
        (&["generate", "chain"], "--size"),
        (&["generate", "cube", "--size", "90"], "cube"),
        (
            &[
                "generate",
                "strip",
                "--size",
                "90",
                "--out",
                "missing/x.toml",
            ],
            "missing",
        ),
    ] {
        let output = krawl()
            .args(arguments)
            .assert()
            .code(2)
            .get_output()
            .clone();
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(text.contains(says), "{text}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_file_is_written_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("strip.toml");
    let make = ["generate", "strip", "--size", "61", "--loops", "2", "--out"];
    krawl().args(make).arg(&file).assert().code(0).stdout("");
    let check = krawl().arg("check").arg(&file).assert().code(0);
    let text = String::from_utf8(check.get_output().stdout.clone()).unwrap();
    assert!(text.contains("driving parameters: k1, k2\n"), "{text}");
    krawl()
        .args(["solve", "--mode", "float", "--quiet"])
        .arg(&file)
        .assert()
        .code(0);
}
