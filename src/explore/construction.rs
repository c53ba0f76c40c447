//! Construction plans whose branches are new sketches (Imbach, Schreck, Mathis 2014, section 6.1).
//!
//! A plan places point after point. Each is where as many spheres (in the plane circles) and planes meet as there are
//! dimensions: a distance to a point placed before is one, a coplanarity with three of them another. Where a point has
//! fewer, distances are added that are no constraints (the paper's "added parameters"), and for each of these some
//! constraint is not used by any step. All lengths are read off a figure; the two places where spheres and planes
//! meet are the branches.

use crate::interval::vector::{cross, dot, minus};
use crate::order::InOrder;
use crate::places::{Each as _, array};
use crate::problem::{Item, Problem};
use crate::random::Random;

/// What a point lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Locus {
    /// A sphere or circle around a point placed before.
    Round(usize),
    /// The plane through three points placed before.
    Plane([usize; 3]),
}

/// The placing of one point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// The point.
    pub point: usize,
    /// Two loci in the plane, three in space; the first is round.
    pub loci: Vec<Locus>,
}

/// A plan: the first points stay where they are, the others are placed in this order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Construction {
    /// The points that stay.
    pub base: Vec<usize>,
    /// The placings of the points that do not stay, in order.
    pub steps: Vec<Step>,
    /// How many of the distances used are no constraints.
    pub added: usize,
}

/// Plans looked at for those with the fewest added distances.
const TRIES: u64 = 60;

impl Construction {
    /// Different plans with few added distances, the fewest first, at most `most`. The same problem has the same ones.
    pub fn some(problem: &Problem, most: usize) -> Vec<Construction> {
        let mut found: Vec<Construction> = Vec::new();
        for seed in 0..TRIES {
            let plan = Draft::new(problem, seed).finish();
            if !found.contains(&plan) {
                found.push(plan);
            }
        }
        found.order_by_key(|plan| plan.added);
        let least = found.first().map_or(0, |plan| plan.added);
        // One more added distance leaves one more constraint behind, and sketches farther from solutions.
        found.retain(|plan| plan.added <= least + 1);
        found.truncate(most);
        found
    }

    /// The figures on the other branches, at most `most`, as seen from a figure: with each the steps, from the lowest
    /// bit on, that take the other side. The mirror image of the whole figure is not among them.
    pub fn branches(
        &self,
        dimension: usize,
        figure: &[[f64; 3]],
        most: usize,
    ) -> Vec<(u64, Vec<[f64; 3]>)> {
        let mut walk = Walk {
            plan: self,
            dimension,
            figure,
            most,
            found: Vec::new(),
        };
        let mut places = figure.to_vec();
        walk.go(0, 0, &mut places);
        walk.found
    }
}

struct Draft<'a> {
    problem: &'a Problem,
    random: Random,
    seed: u64,
}

impl<'a> Draft<'a> {
    fn new(problem: &'a Problem, seed: u64) -> Self {
        Draft {
            problem,
            random: Random::new(seed),
            seed,
        }
    }

    /// A number that grows with nothing but chance; for the first plan the order of the file decides.
    fn chance(&mut self) -> f64 {
        match self.seed {
            0 => 0.0,
            _ => self.random.symmetric(),
        }
    }

    fn base(&mut self) -> Vec<usize> {
        let problem = self.problem;
        let reference = problem.homotopy.reference.clone();
        if self.seed < TRIES / 4 {
            return reference;
        }
        // Another one of joined points, if chance meets one.
        let n = problem.points.len();
        for _ in 0..20 {
            let mut base: Vec<usize> = Vec::new();
            for _ in 0..problem.dimension {
                let p = ((0.5 * (self.random.symmetric() + 1.0)) * n as f64) as usize;
                let p = p.min(n - 1);
                if !base.contains(&p) && base.iter().all(|&q| problem.are_joined(p, q)) {
                    base.push(p);
                }
            }
            if base.len() == problem.dimension {
                return base;
            }
        }
        reference
    }

    fn finish(mut self) -> Construction {
        let (n, d) = (self.problem.points.len(), self.problem.dimension);
        let base = self.base();
        let mut placed = vec![false; n];
        let mut order = base.clone();
        base.iter().for_each(|&p| placed[p] = true);
        let (mut steps, mut added) = (Vec::new(), 0);
        while order.len() < n {
            let open: Vec<usize> = (0..n).filter(|&p| !placed[p]).collect();
            let mut best: Option<(usize, f64, usize, Vec<Locus>)> = None;
            for p in open {
                let loci = self.loci(p, &placed);
                let (count, chance) = (loci.len().min(d), self.chance());
                if best
                    .as_ref()
                    .is_none_or(|(c, x, ..)| (count, chance) > (*c, *x))
                {
                    best = Some((count, chance, p, loci));
                }
            }
            let (_, _, point, loci) = best.expect("a point is left");
            let (loci, more) = self.choose(loci, &order);
            added += more;
            steps.push(Step { point, loci });
            placed[point] = true;
            order.push(point);
        }
        Construction { base, steps, added }
    }

    /// All loci of a point that the constraints give.
    fn loci(&self, p: usize, placed: &[bool]) -> Vec<Locus> {
        let other = |ends: [usize; 2]| match ends {
            [a, b] if a == p && placed[b] => Some(b),
            [a, b] if b == p && placed[a] => Some(a),
            _ => None,
        };
        let distances = self.problem.distances.iter();
        let mut loci: Vec<Locus> = distances
            .filter_map(|d| other(d.points))
            .map(Locus::Round)
            .collect();
        for constraint in &self.problem.constraints {
            if constraint.kind != "coplanar" {
                continue;
            }
            let points: Vec<usize> = constraint
                .items
                .iter()
                .filter_map(|item| match item {
                    Item::Point(q) => Some(*q),
                    _ => None,
                })
                .collect();
            if !points.contains(&p) {
                continue;
            }
            let there: Vec<usize> = points.into_iter().filter(|&q| placed[q]).collect();
            if let [a, b, c, ..] = there[..] {
                loci.push(Locus::Plane([a, b, c]));
            }
        }
        loci
    }

    /// As many of the loci as there are dimensions, one of them round, and how many had to be added.
    fn choose(&mut self, loci: Vec<Locus>, order: &[usize]) -> (Vec<Locus>, usize) {
        let d = self.problem.dimension;
        let mut drawn: Vec<(f64, Locus)> = loci.into_iter().map(|l| (self.chance(), l)).collect();
        drawn.order_by(|a, b| a.0.total_cmp(&b.0));
        let is_round = |l: &Locus| matches!(l, Locus::Round(_));
        let (round, planes): (Vec<Locus>, Vec<Locus>) =
            drawn.into_iter().map(|(_, l)| l).partition(is_round);
        let mut chosen: Vec<Locus> = Vec::new();
        // A round one first; then whatever comes, planes before spheres as there are fewer of them.
        let mut round = round.into_iter();
        chosen.extend(round.next());
        chosen.extend(
            planes
                .into_iter()
                .chain(round)
                .take(d - chosen.len().min(1)),
        );
        chosen.truncate(d);
        if chosen.first().is_none_or(|l| !is_round(l)) {
            chosen.truncate(d - 1);
        }
        let known = chosen.len();
        for &p in order.iter().rev() {
            if chosen.len() < d && !chosen.contains(&Locus::Round(p)) {
                chosen.push(Locus::Round(p));
            }
        }
        chosen.order_by_key(|l| !is_round(l));
        (chosen, d - known)
    }
}

struct Walk<'a> {
    plan: &'a Construction,
    dimension: usize,
    figure: &'a [[f64; 3]],
    most: usize,
    found: Vec<(u64, Vec<[f64; 3]>)>,
}

impl Walk<'_> {
    fn go(&mut self, k: usize, branch: u64, places: &mut [[f64; 3]]) {
        if self.found.len() >= self.most {
            return;
        }
        let Some(step) = self.plan.steps.get(k) else {
            // The figure itself is on the branch without a change.
            if branch != 0 {
                self.found.push((branch, places.to_vec()));
            }
            return;
        };
        let Some(roots) = meet(self.dimension, step, self.figure, places) else {
            return;
        };
        let own = side(self.dimension, step, self.figure);
        for changed in [false, true] {
            // The other side in all steps would be the mirror image.
            if changed && (k == 0 || k >= 64) {
                continue;
            }
            places[step.point] = roots[usize::from(own != changed)];
            let bit = if changed { 1 << k } else { 0 };
            self.go(k + 1, branch | bit, places);
        }
    }
}

type V = [f64; 3];

fn along(a: V, s: f64, d: V) -> V {
    array(|k| a[k] + s * d[k])
}

/// The linear equations n·(p − c) = h that follow for a step's point, c being the centre of its first sphere.
fn linear(step: &Step, figure: &[V], places: &[V]) -> (V, f64, Vec<(V, f64)>) {
    let Some(&Locus::Round(first)) = step.loci.first() else {
        return ([0.0; 3], f64::NAN, Vec::new());
    };
    let squared = |q: usize| {
        let u = minus(figure[step.point], figure[q]);
        dot(u, u)
    };
    let (c, r) = (places[first], squared(first));
    let rows = step.loci[1..].iter().map(|locus| match *locus {
        Locus::Round(q) => {
            let e = minus(places[q], c);
            (e, 0.5 * (r - squared(q) + dot(e, e)))
        }
        Locus::Plane([a, b, q]) => {
            let n = cross(minus(places[b], places[a]), minus(places[q], places[a]));
            (n, dot(n, minus(places[a], c)))
        }
    });
    (c, r, rows.collect())
}

/// The line on which a step's point is: a point of it, seen from the first centre, and its direction.
fn line(dimension: usize, rows: &[(V, f64)]) -> Option<(V, V)> {
    match (dimension, rows) {
        (2, &[(e, h)]) => {
            let ee = dot(e, e);
            let foot = e.each(|x| x * h / ee);
            Some((foot, [-e[1], e[0], 0.0]))
        }
        (3, &[(e, h), (f, g)]) => {
            let d = cross(e, f);
            let dd = dot(d, d);
            let (a, b) = (cross(f, d), cross(d, e));
            let foot = array(|k| (h * a[k] + g * b[k]) / dd);
            Some((foot, d))
        }
        _ => None,
    }
}

/// Both places of a step's point: against the direction of its line, and in it. `None`: there is none, or both are
/// nearly one.
fn meet(dimension: usize, step: &Step, figure: &[V], places: &[V]) -> Option<[V; 2]> {
    let (c, r, rows) = linear(step, figure, places);
    let (foot, d) = line(dimension, &rows)?;
    let square = (r - dot(foot, foot)) / dot(d, d);
    // Nearly one place: no other branch worth following.
    if !(square.is_finite() && square * dot(d, d) > 1e-12 * r) {
        return None;
    }
    let s = square.sqrt();
    let at = |s: f64| along(array(|k| c[k] + foot[k]), s, d);
    Some([at(-s), at(s)])
}

/// Whether in a figure a step's point is in the direction of its line.
fn side(dimension: usize, step: &Step, figure: &[V]) -> bool {
    let (c, _, rows) = linear(step, figure, figure);
    line(dimension, &rows).is_some_and(|(_, d)| dot(minus(figure[step.point], c), d) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every branch keeps all lengths and planes that the plan uses, and no two are the same.
    #[test]
    fn branches_keep_what_the_plan_uses() {
        for (name, added) in [("octahedron", 1), ("disulfide", 1), ("dodecagon", 2)] {
            let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
            let figure = problem.places();
            let plans = Construction::some(&problem, 8);
            assert_eq!(plans[0].added, added, "{name}");
            let mut seen = 0;
            for plan in &plans {
                for (branch, places) in plan.branches(problem.dimension, &figure, 4096) {
                    assert!(branch != 0);
                    seen += 1;
                    for step in &plan.steps {
                        for locus in &step.loci {
                            let Locus::Round(q) = *locus else { continue };
                            let length = |f: &[V]| {
                                let u = minus(f[step.point], f[q]);
                                dot(u, u).sqrt()
                            };
                            assert!((length(&places) - length(&figure)).abs() < 1e-7);
                        }
                    }
                    let moved = (0..figure.len()).any(|p| {
                        let u = minus(places[p], figure[p]);
                        dot(u, u) > 1e-12
                    });
                    assert!(moved);
                }
            }
            assert!(seen > 4, "{name}: {seen}");
        }
    }

    #[test]
    fn coplanarities_place_points() {
        let problem = Problem::read("problems/constraints/pentahedron.toml").unwrap();
        let plans = Construction::some(&problem, 8);
        let planes = plans[0].steps.iter().flat_map(|step| &step.loci);
        assert!(planes.filter(|l| matches!(l, Locus::Plane(_))).count() > 0);
    }
}
