//! Constraints that follow from others in every figure that meets them, though not from their equations alone: the last
//! of three lines' three parallelisms, a right angle opposite to three others.
//!
//! The sketch, moved a little at random, is led to a figure that meets everything but the dimensions (Gauss and Newton,
//! least changes). Where the Jacobian of all equations is singular there, and is so from several beginnings, it is
//! singular wherever they hold: the run ends where they are met. These are floats: what is said is an observation.

use super::Remark;
use crate::blocks::Whose;
use crate::constraint::try_lower;
use crate::linalg::{Linear, decomposed, linearised, nearest_zero, scaled};
use crate::order::add_new;
use crate::problem::Problem;
use crate::random::Random;
use crate::system::Homotopy;
use crate::track::flexible::Target;

/// More unknowns are not looked at: it would take seconds.
const MANY: usize = 250;
/// Beginnings that have to agree.
const BEGINNINGS: u64 = 3;
/// How far the sketch is moved, as a part of the unit.
const MOVED: f64 = 0.02;
/// Singular values below this part of the largest count as zero.
const ZERO: f64 = 1e-9;
/// Those below this are not clearly more than that: nothing is said.
const CLEAR: f64 = 1e-6;

/// The constraints that follow from each other, if there are such.
pub fn redundant(problem: &Problem) -> Vec<Remark> {
    if problem.is_distances_only() {
        return Vec::new();
    }
    let Ok(lowered) = try_lower(problem) else {
        return Vec::new();
    };
    let Ok(homotopy) = Homotopy::new(problem) else {
        return Vec::new();
    };
    if homotopy.equations > MANY {
        return Vec::new();
    }
    let system = System::new(&homotopy, &lowered.vanishing);
    let mut found: Option<Vec<usize>> = None;
    for seed in 0..BEGINNINGS {
        let rows = system
            .figure(seed)
            .and_then(|x| system.dependent_rows(&x))
            .unwrap_or_default();
        if rows.is_empty() {
            return Vec::new();
        }
        found = Some(match found {
            None => rows,
            Some(before) => before
                .into_iter()
                .filter(|row| rows.contains(row))
                .collect(),
        });
    }
    let head = problem.distances.len();
    let mut names: Vec<String> = Vec::new();
    for row in found.unwrap_or_default() {
        let name = match row.checked_sub(head) {
            None => format!("the distance {}", problem.distance_name(row)),
            Some(e) => match Whose::of(problem, lowered.owners[e]) {
                Whose::Object(o) => problem.objects[o].name.clone(),
                Whose::Constraint(c) => problem.constraint_name(c),
                _ => continue,
            },
        };
        add_new(&mut names, name);
    }
    match names.is_empty() {
        true => Vec::new(),
        false => vec![Remark::Redundant(names)],
    }
}

/// All equations in floats.
struct System<'a> {
    homotopy: &'a Homotopy,
    target: Target,
    /// Whether an equation has to hold with zero on the right.
    vanishes: Vec<bool>,
    sketch: Vec<f64>,
}

impl<'a> System<'a> {
    fn new(homotopy: &'a Homotopy, vanishing: &[bool]) -> Self {
        let head = homotopy.edges.len();
        System {
            homotopy,
            target: Target::new(homotopy),
            vanishes: (0..head)
                .map(|_| false)
                .chain(vanishing.iter().copied())
                .collect(),
            sketch: homotopy.sketch_of_unknowns().map(|x| x.mid()).collect(),
        }
    }

    /// The Jacobian of some equations, rows scaled to length 1, and their scaled values.
    fn linearise(&self, rows: &[usize], x: &[f64]) -> Linear {
        scaled(linearised((rows.len(), x.len()), &|r, slope| {
            self.target.evaluate(rows[r], x, slope)
        }))
    }

    /// A figure near the sketch that meets all equations with zero on the right.
    fn figure(&self, seed: u64) -> Option<Vec<f64>> {
        let rows = (0..self.vanishes.len()).filter(|&e| self.vanishes[e]);
        let rows: Vec<usize> = rows.collect();
        let mut random = Random::new(seed + 1);
        let sketch = self.sketch.iter();
        let moved = sketch.map(|x| x + MOVED * random.symmetric());
        let x = nearest_zero(moved.collect(), 1e-10, &|x| self.linearise(&rows, x))?;
        self.homotopy.is_proper(&x).then_some(x)
    }

    /// The rows of a combination that vanishes, where the Jacobian of all equations is singular. `None`: it is not, or
    /// that cannot be told.
    fn dependent_rows(&self, x: &[f64]) -> Option<Vec<usize>> {
        let all: Vec<usize> = (0..self.vanishes.len()).collect();
        let svd = decomposed(self.linearise(&all, x).0, [true, false]);
        let values = &svd.singular_values;
        let largest = values.max();
        let zeros: Vec<usize> = (0..values.len())
            .filter(|&k| values[k] < ZERO * largest)
            .collect();
        let unclear = values
            .iter()
            .any(|&v| v >= ZERO * largest && v < CLEAR * largest);
        if zeros.is_empty() || unclear {
            return None;
        }
        let u = svd.u?;
        let weight = |row: usize| {
            zeros
                .iter()
                .fold(0.0, |max: f64, &k| max.max(u[(row, k)].abs()))
        };
        Some(all.into_iter().filter(|&row| weight(row) > 1e-6).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(constraints: &str, reference: &str) -> Vec<Remark> {
        let text = format!(
            "name = \"special\"\ndimension = 2\n[points]\na = [0, 0]\nb = [3, 0.1]\nc = [3.2, 2]\nd = [0.1, 2.2]\n\
             e = [0.3, 4]\nf = [3.1, 4.3]\n[constraints]\n{constraints}\n{reference}"
        );
        redundant(&Problem::parse(&text, "special.toml").unwrap_or_else(|e| panic!("{e}")))
    }

    #[test]
    fn the_last_of_three_parallelisms_follows() {
        let distances = "distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2], [\"a\", \"d\", 2], [\"d\", \"c\", 3], \
                         [\"d\", \"e\", 2], [\"c\", \"f\", 2]]";
        let parallel = "parallel = [[\"a\", \"b\", \"d\", \"c\"], [\"d\", \"c\", \"e\", \"f\"], [\"a\", \"b\", \
                        \"e\", \"f\"]]";
        let found = of(&format!("{distances}\n{parallel}"), "");
        let [Remark::Redundant(names)] = &found[..] else {
            panic!("{found:?}")
        };
        assert!(
            names
                .iter()
                .filter(|name| name.starts_with("parallel"))
                .count()
                == 3,
            "{names:?}"
        );
    }

    #[test]
    fn others_do_not() {
        let distances = "distances = [[\"a\", \"b\", 3], [\"b\", \"c\", 2], [\"a\", \"d\", 2], [\"a\", \"c\", 3.5], \
                         [\"d\", \"e\", 2], [\"c\", \"f\", 2], [\"a\", \"e\", 4]]";
        let parallel = "parallel = [[\"a\", \"b\", \"d\", \"c\"], [\"d\", \"c\", \"e\", \"f\"]]";
        assert_eq!(of(&format!("{distances}\n{parallel}"), ""), []);
    }
}
