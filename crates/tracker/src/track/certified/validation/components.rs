//! Two starting points: on the same component they lead to the same set of solutions, on different
//! ones to sets that have nothing in common.

use super::precise::Figure;
use super::precise::big::{Big, exact};
use super::*;
use crate::track::certified::track;
use crate::track::{Control, Options, Outcome, Solution, Status, TubeSeen, Witness};

/// Keeps the points at which a run's t is near 0.
struct NearZero(Vec<Vec<f64>>);

impl Witness for NearZero {
    fn begin(&mut self, _: f64) {}
    fn tube(&mut self, tube: TubeSeen) {
        let t = tube.centre[tube.centre.len() - 1];
        if t.abs() < tube.h {
            self.0.push(tube.centre.to_vec());
        }
    }
    fn solution(&mut self, _: &[f64], _: &[f64]) {}
    fn end(&mut self, _: &Status, _: &[usize]) {}
}

/// Of how many solutions of the one there is one among those of the other.
fn common(a: &Outcome, b: &Outcome) -> usize {
    let found = |s: &&Solution| b.solutions.iter().any(|other| boxes_meet(s, other));
    a.solutions.iter().filter(found).count()
}

#[derive(Debug, Default)]
struct Tally {
    same: usize,
    different: usize,
    open: usize,
}

/// The homotopy with the figure `z` in place of the sketch at t = 0; its lengths must be those of the sketch.
fn started_at(homotopy: &Homotopy, z: &[Big]) -> Homotopy {
    let mut other = homotopy.clone();
    for (&place, z) in homotopy.gauge.place.iter().zip(z) {
        other.sketch[place] = z.to_f64();
        other.sketch_box[place] = z.enclosure();
    }
    other
}

fn compare(problem: &Problem, random: &mut Random, tally: &mut Tally) {
    let homotopy = Homotopy::new(problem).unwrap();
    let options = Options {
        max_steps: 4000,
        ..Options::certified()
    };
    let mut near = NearZero(Vec::new());
    let first = track(
        &homotopy,
        &options,
        &mut Control {
            witness: Some(&mut near),
            ..Control::default()
        },
    );
    if first.status != Status::Closed {
        tally.open += 1;
        return;
    }
    let figure = Figure::new(problem, &homotopy);
    let n = figure.n;
    let mut normal = vec![0.0; n];
    normal[n - 1] = 1.0;
    // A point of the path itself, and others from around it.
    let mut starts = vec![near.0[random.below(near.0.len())].clone()];
    for spread in [0.3, 0.6, 1.0, 1.0, 1.0, 1.5, 2.0, 3.0] {
        let start = starts[0]
            .iter()
            .map(|x| x + spread * random.between(-1.0, 1.0));
        starts.push(start.collect());
    }
    for (k, start) in starts.into_iter().enumerate() {
        let mut through = exact(&start);
        through[n - 1] = Big::of(0.0);
        let Some((z, _)) = figure.point_near(&through, &normal) else {
            continue;
        };
        let other = started_at(&homotopy, &z);
        let second = track(&other, &options, &mut Control::default());
        if second.status != Status::Closed {
            tally.open += 1;
            continue;
        }
        let shared = common(&first, &second);
        let all = shared == first.solutions.len() && shared == second.solutions.len();
        let context = || format!("start {k}: {shared} shared\n{}", problem.to_toml());
        assert!(all || shared == 0, "{}", context());
        // From the path itself Newton's method does not lead far away.
        let moved = (0..n - 1).any(|i| (z[i].to_f64() - start[i]).abs() > 0.05);
        assert!(all || k > 0 || moved, "{}", context());
        if !first.solutions.is_empty() {
            if all {
                tally.same += 1;
            } else {
                tally.different += 1;
            }
        }
    }
}

#[test]
fn starting_points_share_all_solutions_or_none() {
    let mut random = Random::new(12);
    let mut tally = Tally::default();
    for round in 0..effort(150) {
        let dimension = 2 + round % 2;
        let points = dimension + 2 + random.below(4);
        let change = [0.1, 0.3][random.below(2)];
        let problem = random_problem(&mut random, dimension, points, change);
        compare(&problem, &mut random, &mut tally)
    }
    println!("{tally:?}");
    assert!(tally.same > 40 && tally.different > 10, "{tally:?}");
}
