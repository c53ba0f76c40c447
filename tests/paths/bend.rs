//! The default bend: the same answer in any unit, and what it finds.

use crate::common::edits::{Random, places, rigid};
use krawl::problem::{Decimal, Problem};
use krawl::track::{Control, Options, Status, solve};

/// A random sketch with targets, as texts of numbers in hundredths or so: multiplied by powers of ten they
/// stay decimals.
struct Draft {
    dimension: usize,
    points: Vec<Vec<i64>>,
    /// Points and length in millionths.
    distances: Vec<([usize; 2], i64)>,
}

/// Targets are the lengths of another figure, whose points are up to `noise` away from the sketch's in every
/// coordinate: there is a solution.
fn draft(random: &mut Random, dimension: usize, points: usize, noise: f64) -> Draft {
    let places = places(random, dimension, points);
    let wanted: Vec<Vec<f64>> = places
        .iter()
        .map(|p| {
            p.iter()
                .map(|&x| x as f64 + 100.0 * random.between(-noise, noise))
                .collect()
        })
        .collect();
    let edges = rigid(random, dimension, points);
    let length = |[a, b]: [usize; 2]| {
        let squared = wanted[a]
            .iter()
            .zip(&wanted[b])
            .map(|(x, y)| (x - y).powi(2));
        (1e4 * squared.sum::<f64>().sqrt()).round() as i64
    };
    Draft {
        dimension,
        distances: edges.iter().map(|&edge| (edge, length(edge))).collect(),
        points: places,
    }
}

impl Draft {
    /// In units of a power of ten, with this bend coefficient for lengths of about 1, or the default.
    fn problem(&self, power: i32, bend: Option<f64>) -> Option<Problem> {
        let name = |p: usize| format!("p{p}");
        let mut builder = Problem::build("random", self.dimension);
        for (p, place) in self.points.iter().enumerate() {
            let place: Vec<String> = place.iter().map(|x| format!("{x}e{}", power - 2)).collect();
            builder = builder.point(&name(p), place.iter().map(|x| x.as_str()));
        }
        for ([a, b], length) in &self.distances {
            let length = format!("{length}e{}", power - 6);
            builder = builder.distance(&name(*a), &name(*b), length.as_str());
        }
        if let Some(c) = bend {
            let c = format!("{c:.6}e{power}").parse::<Decimal>().unwrap();
            builder = builder.bend_coefficient(c);
        }
        builder.finish().ok()
    }

    /// The length of the bend's target, and the mean of all targets, for a unit of 1.
    fn lengths(&self) -> (f64, f64) {
        let all = self.distances.iter().map(|d| d.1 as f64 * 1e-6);
        let mean = all.sum::<f64>() / self.distances.len() as f64;
        (
            self.distances[self.distances.len() - 1].1 as f64 * 1e-6,
            mean,
        )
    }
}

#[test]
fn the_unit_of_length_does_not_change_the_answer() {
    let mut random = Random(1);
    let mut found = 0;
    for _ in 0..20 {
        let (dimension, points) = (2 + random.below(2), 5 + random.below(3));
        let draft = draft(&mut random, dimension, points, 0.3);
        let mut answers = [0, -3, 3, 1].map(|power| {
            let problem = draft.problem(power, None).unwrap();
            let outcome = solve(&problem, &Options::certified(), &mut Control::default()).unwrap();
            (outcome.status == Status::Closed, outcome.solutions.len())
        });
        found += usize::from(answers[0].1 > 0);
        answers.sort_unstable();
        assert_eq!(answers[0], answers[3], "{answers:?}");
    }
    assert!(found > 10, "{found}");
}

/// The table of docs/measured/tried.md.
#[test]
#[ignore = "minutes"]
fn table() {
    type Rule = fn(&Draft, f64) -> f64;
    let rules: [(&str, Rule); 2] = [
        ("bend's target", |draft, factor| factor * draft.lengths().0),
        ("mean target", |draft, factor| factor * draft.lengths().1),
    ];
    let cases = 200;
    for noise in [0.3, 1.0] {
        println!(
            "\n| c, sketches {noise} away | find a solution | solutions | closed | tubes, mean | ms, mean |"
        );
        println!("| --- | --- | --- | --- | --- | --- |");
        let run = |name: String, problem: &dyn Fn(&Draft) -> Option<Problem>| {
            let mut random = Random(77);
            let (mut some, mut all, mut closed, mut tubes, mut seconds) = (0, 0, 0, 0, 0.0);
            for _ in 0..cases {
                let (dimension, points) = (2 + random.below(2), 5 + random.below(5));
                let draft = draft(&mut random, dimension, points, noise);
                let Some(problem) = problem(&draft) else {
                    continue;
                };
                let options = Options {
                    max_steps: 20_000,
                    ..Options::certified()
                };
                let Ok(outcome) = solve(&problem, &options, &mut Control::default()) else {
                    continue;
                };
                some += usize::from(!outcome.solutions.is_empty());
                all += outcome.solutions.len();
                closed += usize::from(outcome.status == Status::Closed);
                tubes += outcome.steps;
                seconds += outcome.seconds;
            }
            println!(
                "| {name} | {some} | {all} | {closed} | {} | {:.2} |",
                tubes / cases,
                1e3 * seconds / cases as f64
            );
        };
        for (name, rule) in rules {
            for factor in [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0] {
                run(format!("{factor} × {name}"), &|draft| {
                    draft.problem(0, Some(rule(draft, factor)))
                });
            }
        }
        for (c, power) in [(0.0, 0), (2.0, -3), (2.0, 0), (2.0, 3)] {
            run(format!("{c}, figures of size 1e{power}"), &|draft| {
                draft.problem(power, Some(c * 10f64.powi(-power)))
            });
        }
        for power in [-3, 0, 3] {
            run(format!("default, figures of size 1e{power}"), &|draft| {
                draft.problem(power, None)
            });
        }
    }
}
