//! Certified mode in the reduced space says the same as in the full space.

use crate::common::boxes::{View, check, matching};
use crate::common::random::{Recipe, recipe, same_each_time};
use crate::common::{SHORT, shipped, solve};
use krawl::generate;
use krawl::problem::Problem;
use krawl::track::{Options, Outcome, Solution, Space, Status};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

#[derive(Debug, Default)]
struct Tally {
    problems: usize,
    closed: usize,
    with_solutions: usize,
    stopped: Vec<String>,
}

fn reduced(alpha: f64) -> Options {
    Options {
        space: Space::Reduced,
        alpha,
        max_steps: 20_000,
        ..Options::certified()
    }
}

/// Those found before a run stopped are among those of the closed one.
fn some_of(problem: &Problem, all: &[Solution], some: &[Solution]) -> Result<(), String> {
    for (k, solution) in some.iter().enumerate() {
        let meets = |other: &&Solution| {
            let pairs = other
                .points
                .iter()
                .flatten()
                .zip(solution.points.iter().flatten());
            pairs.into_iter().all(|(x, y)| !x.disjoint(*y))
        };
        if all.iter().filter(meets).count() != 1 {
            return Err(format!(
                "solution {k} is not on the path of {}",
                problem.name
            ));
        }
    }
    Ok(())
}

fn compare(problem: &Problem, alphas: &[f64], tally: &mut Tally) -> Result<(), String> {
    let full = solve(
        problem,
        &Options {
            max_steps: 20_000,
            ..Options::certified()
        },
    );
    if full.status != Status::Closed {
        return Ok(());
    }
    tally.problems += 1;
    tally.with_solutions += usize::from(!full.solutions.is_empty());
    for (k, &alpha) in alphas.iter().enumerate() {
        let forward = reduced(alpha);
        let options = if k % 2 == 0 {
            forward
        } else {
            forward.reversed()
        };
        let outcome: Outcome = solve(problem, &options);
        let context = |e| format!("alpha {alpha}, direction {k}: {e}");
        check(problem, &outcome.solutions).map_err(context)?;
        match &outcome.status {
            Status::Open(_) => panic!("distances alone have no open paths"),
            Status::Closed => {
                tally.closed += 1;
                let view = View::same(problem);
                matching(&full.solutions, &view, &outcome.solutions).map_err(context)?;
            }
            Status::Stopped(reason) => {
                some_of(problem, &full.solutions, &outcome.solutions).map_err(context)?;
                tally
                    .stopped
                    .push(format!("alpha {alpha}: {reason}\n{}", problem.to_toml()));
            }
        }
    }
    Ok(())
}

fn random_problems(strategy: impl Strategy<Value = Recipe>, cases: usize, rng: TestRng) -> Tally {
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut tally = Tally::default();
    let alphas = [0.05, 0.1, 0.2, 0.4];
    for case in 0..cases {
        let recipe = strategy.new_tree(&mut runner).unwrap().current();
        let Ok(problem) = recipe.build() else {
            continue;
        };
        let [a, b] = [alphas[case % 4], alphas[(case / 4 + case + 1) % 4]];
        if let Err(reason) = compare(&problem, &[a, b], &mut tally) {
            panic!("{reason}\n\n{}", problem.to_toml());
        }
    }
    println!(
        "{} problems, {} runs closed, {} stopped\n{}",
        tally.problems,
        tally.closed,
        tally.stopped.len(),
        tally.stopped.join("\n")
    );
    assert!(tally.stopped.len() * 100 <= 3 * tally.closed, "{tally:#?}");
    assert!(tally.with_solutions * 8 >= cases, "{tally:#?}");
    tally
}

#[test]
fn spaces_agree_in_the_plane() {
    random_problems(recipe(2, 2..=9), 250, same_each_time());
}

#[test]
fn spaces_agree_in_space() {
    random_problems(recipe(3, 4..=9), 250, same_each_time());
}

#[test]
#[ignore = "takes long, and tries other problems each time"]
fn spaces_agree_on_many() {
    let seed = || TestRng::from_seed(RngAlgorithm::ChaCha, &rand_seed());
    random_problems(recipe(2, 2..=9), 4000, seed());
    random_problems(recipe(3, 4..=9), 3000, seed());
}

fn rand_seed() -> [u8; 32] {
    let now = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .unwrap()
        .as_nanos();
    println!("seed {now}");
    std::array::from_fn(|k| (now >> (8 * (k % 16))) as u8)
}

#[test]
fn spaces_agree_on_the_shipped_problems() {
    let mut tally = Tally::default();
    for (name, count) in SHORT {
        let problem = shipped(name);
        compare(&problem, &[0.05, 0.1, 0.4], &mut tally).unwrap_or_else(|e| panic!("{name}: {e}"));
        let outcome = solve(&problem, &reduced(0.1));
        if outcome.status == Status::Closed {
            assert_eq!(outcome.solutions.len(), count, "{name}");
        }
    }
    assert!(tally.stopped.is_empty(), "{tally:#?}");
}

#[test]
fn spaces_agree_on_generated_structures() {
    let mut tally = Tally::default();
    for family in generate::Family::ALL {
        for (size, loops, seed) in [(30, 1, 1), (40, 2, 2)] {
            let recipe = generate::Recipe {
                family,
                size: size.max(family.smallest(loops)),
                loops,
                seed,
            };
            let problem = recipe.problem().unwrap();
            compare(&problem, &[0.1, 0.3], &mut tally)
                .unwrap_or_else(|e| panic!("{recipe:?}: {e}"));
        }
    }
    println!("{tally:?}");
    assert!(tally.closed > 0, "{tally:#?}");
}

/// In the larger ones boxes are about 1e-8 wide, and rounding fills a good part of them: whether tubes can be linked
/// depends on where they happen to lie. (Of 300 coordinates one or two in eight are proved: too few to ask for.)
#[test]
fn towers_with_five_loops_are_proved_in_the_reduced_space() {
    for (size, least) in [(100, 8), (200, 5)] {
        let (mut closed, mut stopped) = (0, Vec::new());
        for seed in 1..=8 {
            let recipe = generate::Recipe {
                family: generate::Family::Tower,
                size,
                loops: 5,
                seed,
            };
            let problem = recipe.problem().unwrap();
            let (outcome, float) = (
                solve(&problem, &reduced(0.1)),
                solve(&problem, &Options::float(Space::Reduced)),
            );
            match outcome.status {
                Status::Open(_) => panic!("distances alone have no open paths"),
                Status::Closed => {
                    closed += 1;
                    assert_eq!(outcome.solutions.len(), float.solutions.len(), "{recipe:?}");
                }
                Status::Stopped(reason) => stopped.push((recipe, reason)),
            }
        }
        println!("{size}: {closed} of 8, {stopped:#?}");
        assert!(closed >= least, "{stopped:#?}");
    }
}

/// Two folds of t and t = 1 within 1e-5: the derivative of the residual has to be bounded well.
#[test]
fn near_folds_are_proved_in_the_reduced_space() {
    for (name, count) in [("fold-5", 2), ("fold-missed-5", 0)] {
        let outcome = solve(&shipped(&format!("hard/{name}")), &reduced(0.1));
        assert_eq!(outcome.status, Status::Closed, "{name}");
        assert_eq!(outcome.solutions.len(), count, "{name}");
    }
}
