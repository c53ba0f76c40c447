//! A float run that jumped, written down as a certificate as well as one can: it must be refused,
//! and for the jump.

use crate::common::certificate::Certificate;
use crate::common::figures::are_congruent;
use krawl::certificate::{
    EndClaim, Flaw, Outcome, Record, Settings, SolutionClaim, TubeClaim, Verdict, verify,
};
use krawl::problem::Problem;
use krawl::system::Homotopy;
use nalgebra::{DMatrix, DVector};

/// A point with the unit tangent there.
type Point = (DVector<f64>, DVector<f64>);

/// A plain float tracker: tangent predictor with a fixed step, Newton's corrector across it.
struct Plain {
    homotopy: Homotopy,
    n: usize,
}

impl Plain {
    fn new(problem: &Problem) -> Self {
        let homotopy = Homotopy::new(problem).unwrap();
        let n = homotopy.equations + 1;
        Plain { homotopy, n }
    }

    fn sketch(&self) -> DVector<f64> {
        let place = &self.homotopy.gauge.place;
        let x = place.iter().map(|&p| self.homotopy.sketch[p]);
        DVector::from_iterator(self.n, x.chain([0.0]))
    }

    /// A coordinate of a point, which is zero where it is not free.
    fn coordinate(&self, z: &DVector<f64>, place: usize) -> f64 {
        match self.homotopy.gauge.variable[place] {
            i if i < self.n - 1 => z[i],
            _ => 0.0,
        }
    }

    /// F(z), and [J(z); c].
    fn system(&self, z: &DVector<f64>, c: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (h, m, d) = (&self.homotopy, self.n - 1, self.homotopy.dimension);
        let (mut f, mut j) = (DVector::zeros(self.n), DMatrix::zeros(self.n, self.n));
        let value = |place: usize| self.coordinate(z, place);
        for (e, (edge, length)) in h.edges.iter().zip(&h.lengths).enumerate() {
            let a = length.value(z[m]);
            f[e] = -0.5 * a * a;
            j[(e, m)] = -a * length.slope(z[m]);
            for axis in 0..d {
                let [p, q] = edge.points.map(|p| p * d + axis);
                let x = value(p) - value(q);
                f[e] += 0.5 * x * x;
                for (place, x) in [(p, x), (q, -x)] {
                    let i = h.gauge.variable[place];
                    if i < m {
                        j[(e, i)] += x;
                    }
                }
            }
        }
        j.set_row(m, &c.transpose());
        (f, j)
    }

    /// The unit tangent, with a positive component along `c`.
    fn tangent(&self, z: &DVector<f64>, c: &DVector<f64>) -> DVector<f64> {
        let mut last = DVector::zeros(self.n);
        last[self.n - 1] = 1.0;
        let tangent = self.system(z, c).1.lu().solve(&last).unwrap();
        tangent.normalize()
    }

    /// Newton's method in the cross-section through z; `None` if six steps do not do.
    fn correct(&self, z: &DVector<f64>, c: &DVector<f64>) -> Option<DVector<f64>> {
        let mut z = z.clone();
        for _ in 0..6 {
            let (f, j) = self.system(&z, c);
            let step = j.lu().solve(&f)?;
            z -= &step;
            if step.amax() < 1e-12 {
                return Some(z);
            }
        }
        None
    }

    /// One step: half as long until the corrector succeeds.
    fn step(&self, z: &DVector<f64>, c: &DVector<f64>, mut step: f64) -> Point {
        loop {
            if let Some(next) = self.correct(&(z + c * step), c) {
                let tangent = self.tangent(&next, c);
                return (next, tangent);
            }
            step *= 0.5;
        }
    }

    /// The points of a run from the sketch, with their tangents, until it passes the sketch again
    /// in the same direction. `None`: it does not.
    fn run(&self, step: f64) -> Option<Vec<Point>> {
        let sketch = self.sketch();
        let mut up = DVector::zeros(self.n);
        up[self.n - 1] = 1.0;
        let start = self.tangent(&sketch, &up);
        let mut points = vec![(sketch.clone(), start.clone())];
        while points.len() as f64 * step < 1000.0 {
            let (z, c) = &points[points.len() - 1];
            let (next, tangent) = self.step(z, c, step);
            let before = c.dot(&(&sketch - z));
            let behind = tangent.dot(&(&sketch - &next));
            let near = (&sketch - z).norm() < 1.5 * step;
            points.push((next, tangent.clone()));
            if points.len() > 3
                && near
                && before >= 0.0
                && behind < 0.0
                && tangent.dot(&start) > 0.0
            {
                return Some(points);
            }
        }
        None
    }

    /// The solution between two points of a run on either side of t = 1.
    fn solution(&self, a: &DVector<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
        let m = self.n - 1;
        let share = (1.0 - a[m]) / (b[m] - a[m]);
        let mut guess = a + (b - a) * share;
        guess[m] = 1.0;
        let mut up = DVector::zeros(self.n);
        up[m] = 1.0;
        self.correct(&guess, &up)
    }
}

/// How often a run meets t = 1.
fn crossings(points: &[Point]) -> usize {
    let above = |z: &DVector<f64>| z[z.len() - 1] > 1.0;
    points
        .windows(2)
        .filter(|w| above(&w[0].0) != above(&w[1].0))
        .count()
}

/// Steps are cut into pieces of about this length, short enough for tubes around all of them.
const PIECE: f64 = 0.0125;

impl Plain {
    /// The points of the path from one point of a run to the next, the last one left out. `None`:
    /// the path from the one does not lead to the other. The run jumped.
    fn between(&self, from: &Point, to: &Point) -> Option<Vec<Point>> {
        let length = (&to.0 - &from.0).norm();
        let pieces = (length / PIECE).ceil();
        let mut points = vec![from.clone()];
        for _ in 0..4 * pieces as usize {
            let (z, c) = &points[points.len() - 1];
            let next = self.step(z, c, length / pieces);
            if to.1.dot(&(&next.0 - &to.0)) > -0.1 * length / pieces {
                let there = self.correct_across(&next.0, to)?;
                return ((there - &to.0).amax() < 1e-9).then_some(points);
            }
            points.push(next);
        }
        None
    }

    /// The path's point near z in the cross-section through a point.
    fn correct_across(&self, z: &DVector<f64>, at: &Point) -> Option<DVector<f64>> {
        let shift = at.1.dot(&(z - &at.0));
        self.correct(&(z - &at.1 * shift), &at.1)
    }

    /// A run as a certificate, its tubes without a radius, with the number of the first tube behind a jump, if there is one.
    fn certificate(&self, problem: &Problem, run: &[Point]) -> (Certificate, Option<u64>) {
        let mut jumps: Vec<usize> = Vec::new();
        let mut points: Vec<Point> = Vec::new();
        for pair in run.windows(2) {
            match self.between(&pair[0], &pair[1]) {
                Some(more) => points.extend(more),
                None => {
                    jumps.push(points.len());
                    points.push(pair[0].clone());
                }
            }
        }
        points.push(run[run.len() - 1].clone());
        // The last tube holds the sketch.
        let sketch = self.sketch();
        while let [.., (a, c), (b, _)] = &points[..]
            && c.dot(&(&sketch - a)) < 0.6 * c.dot(&(b - a))
        {
            points.pop();
        }

        let mut records = Vec::new();
        let mut figures: Vec<DVector<f64>> = Vec::new();
        // No tube reaches over a jump: beside it they are as long as their neighbours.
        let chord = |k: usize| {
            points
                .get(k + 1)
                .map_or(0.0, |next| (&next.0 - &points[k].0).norm())
        };
        let mut gaps: Vec<f64> = (0..points.len()).map(chord).collect();
        for &jump in &jumps {
            let beside = [jump.wrapping_sub(1), jump + 1].map(|k| gaps.get(k).copied());
            let shortest = beside.into_iter().flatten().fold(gaps[jump], f64::min);
            gaps[jump] = shortest.max(0.5 * PIECE);
        }
        for (k, (z, c)) in points.iter().enumerate() {
            let (before, after) = (if k == 0 { 0.0 } else { gaps[k - 1] }, gaps[k]);
            records.push(Record::Tube(TubeClaim {
                low: Vec::new(),
                centre: z.iter().copied().collect(),
                normal: c.iter().map(|&c| c as f32).collect(),
                weights: vec![u16::MAX; self.n],
                h: 0.7 * f64::max(before, after),
                r: 0.0,
                exit: 0.55 * after,
            }));
            let Some((next, _)) = points.get(k + 1) else {
                continue;
            };
            let m = self.n - 1;
            if (z[m] > 1.0) == (next[m] > 1.0) {
                continue;
            }
            // Over a jump there may be none.
            let Some(solution) = self.solution(z, next) else {
                continue;
            };
            if figures
                .iter()
                .all(|known| (known - &solution).amax() > 1e-9)
            {
                records.push(Record::Solution(SolutionClaim {
                    centre: solution.iter().take(m).copied().collect(),
                    radius: 1e-11,
                }));
                figures.push(solution);
            }
        }
        let h = &self.homotopy;
        let d = h.dimension;
        let places = |figure: &DVector<f64>| -> Vec<[f64; 3]> {
            let at = |place| self.coordinate(figure, place);
            let point = |p| std::array::from_fn(|k| if k < d { at(p * d + k) } else { 0.0 });
            (0..h.points).map(point).collect()
        };
        // The first figure of each class.
        let mut known: Vec<Vec<[f64; 3]>> = Vec::new();
        let classes = figures.iter().map(places).map(|figure| {
            let class = known.iter().position(|k| are_congruent(k, &figure, 1e-8));
            class.unwrap_or_else(|| {
                known.push(figure);
                known.len() - 1
            }) as u32
        });
        let classes = classes.collect();
        records.push(Record::End(EndClaim {
            ending: krawl::certificate::Ending::Complete,
            tubes: points.len() as u64,
            classes,
        }));
        let certificate = Certificate {
            program: "a float run".into(),
            problem: problem.to_toml(),
            unit_exponent: h.unit.log2() as i16,
            records,
        };
        (certificate, jumps.first().map(|&k| k as u64 + 2))
    }
}

/// The verdict on a float run with steps of a length, its tubes tried with several radii; how often
/// the run met t = 1, and the first tube behind a jump.
fn verdict(name: &str, step: f64) -> (Verdict, usize, Option<u64>) {
    let problem = crate::common::shipped(name);
    let plain = Plain::new(&problem);
    let run = plain.run(step).expect("the float run closes");
    let (mut certificate, jump) = plain.certificate(&problem, &run);
    let tries = [1e-3, 1e-4, 1e-5, 1e-6].map(|r| {
        for record in &mut certificate.records {
            if let Record::Tube(tube) = record {
                tube.r = r;
            }
        }
        verify(&certificate.bytes()[..], &Settings::default(), &mut |_| ()).unwrap()
    });
    let best = tries.into_iter().max_by_key(|verdict| verdict.tubes);
    (best.unwrap(), crossings(&run), jump)
}

/// So written down, float runs with short steps are proved: what follows is not the format's fault.
#[test]
fn float_runs_that_stayed_on_their_path_are_proved() {
    for (name, step) in [
        ("k33", 0.05),
        ("prism", 0.1),
        ("octahedron", 0.1),
        ("dodecagon", 0.1),
    ] {
        let solutions = crate::common::SHORT.iter().find(|s| s.0 == name).unwrap().1;
        let (verdict, crossings, jump) = verdict(name, step);
        println!(
            "{name}, steps of {step}: {crossings} solutions, {} tubes, {:?}",
            verdict.tubes, verdict.outcome
        );
        assert_eq!((jump, crossings), (None, solutions), "{name}");
        assert_eq!(verdict.outcome, Outcome::Verified, "{name}");
        assert_eq!(verdict.solutions.len(), solutions, "{name}");
    }
}

/// These runs closed as well, and met t = 1 more or less often than the path does: they jumped.
/// Every tube is true and linked but for the jumps, and the first of these is what is refused.
#[test]
fn float_runs_that_jumped_are_refused_for_the_jump() {
    for (name, step) in [("k33", 0.1), ("prism", 0.5), ("icosahedron-c1", 1.2)] {
        let solutions = crate::common::SHORT.iter().find(|s| s.0 == name).unwrap().1;
        let (verdict, crossings, jump) = verdict(name, step);
        println!(
            "{name}, steps of {step}: {crossings} solutions, {} tubes, jump {jump:?}: {:?}",
            verdict.tubes, verdict.outcome
        );
        assert_ne!(crossings, solutions, "{name}: no jump to test");
        let jump = jump.unwrap();
        assert!(
            matches!(verdict.outcome, Outcome::Refuted(Flaw::Link(k) | Flaw::Direction(k)) if k == jump),
            "{name}: {:?}, and the jump is to tube {jump}",
            verdict.outcome
        );
        assert_eq!(verdict.tubes, jump - 1);
    }
}
