//! Sketches drawn along axes: equations that are one of two linear ones, and what their linear equations tell in exact numbers. Sets are counted again by
//! trying all signs and solving what is then linear, in whole numbers.

use crate::common::covers::searched;
use crate::common::edits::Random;
use krawl::certificate::cover::verify_cover;
use krawl::complete::{Options, Status, all};
use krawl::problem::Problem;
use num_integer::Integer;
use std::collections::BTreeSet;
use std::fmt::Write;

/// An equation between points of a line, which are numbered; the first two are fixed. Places are in tenths, which floats have not exactly.
enum Said {
    /// |x_i − x_j| is this.
    Length([usize; 2], i64),
    /// |x_i − x_j| = |x_k − x_l|.
    Equal([usize; 2], [usize; 2]),
}

/// What a line is.
struct Line {
    places: Vec<i64>,
    said: Vec<Said>,
}

/// A whole ratio in lowest terms, the denominator positive.
type Ratio = (i128, i128);

fn ratio(a: i128, b: i128) -> Ratio {
    let by = a.gcd(&b).max(1) * b.signum();
    (a / by, b / by)
}

impl Line {
    /// As many equations as points that move, each about one more of them.
    fn random(random: &mut Random, points: usize) -> Line {
        let mut places: Vec<i64> = Vec::new();
        while places.len() < points {
            let x = random.below(97) as i64 - 48;
            if !places.contains(&x) {
                places.push(x);
            }
        }
        let mut said = Vec::new();
        for new in 2..points {
            let first = [new, random.below(new)];
            let other = [random.below(new + 1), random.below(new + 1)];
            let is_other = other[0] != other[1] && other != first && other != [first[1], new];
            said.push(match is_other && random.below(2) == 0 {
                true => Said::Equal(first, other),
                false => Said::Length(first, (places[new] - places[first[1]]).abs()),
            });
        }
        Line { places, said }
    }

    fn problem(&self) -> Problem {
        let tenths = |x: i64| x as f64 / 10.0;
        let mut text = String::from("name = \"line\"\ndimension = 2\n[points]\n");
        for (k, &x) in self.places.iter().enumerate() {
            writeln!(text, "p{k} = [{:?}, 0.0]", tenths(x)).unwrap();
        }
        text.push_str("[constraints]\nfixed = [\"p0\", \"p1\"]\n");
        let level = (2..self.places.len()).map(|k| format!("[\"p0\", \"p{k}\"]"));
        writeln!(
            text,
            "horizontal = [{}]",
            level.collect::<Vec<_>>().join(", ")
        )
        .unwrap();
        let (mut lengths, mut equal) = (Vec::new(), Vec::new());
        for said in &self.said {
            match said {
                Said::Length([i, j], d) => {
                    lengths.push(format!("[\"p{i}\", \"p{j}\", {:?}]", tenths(*d)));
                }
                Said::Equal([i, j], [k, l]) => {
                    equal.push(format!("[\"p{i}\", \"p{j}\", \"p{k}\", \"p{l}\"]"));
                }
            }
        }
        writeln!(text, "distances = [{}]", lengths.join(", ")).unwrap();
        if !equal.is_empty() {
            writeln!(text, "equal = [{}]", equal.join(", ")).unwrap();
        }
        Problem::parse(&text, "line.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
    }

    /// Whether lengths that are equal are none in a figure: the equation is singular there.
    fn is_singular(&self, figure: &[Ratio]) -> bool {
        let at = |p: usize| match p.checked_sub(2) {
            None => ratio(i128::from(self.places[p]), 1),
            Some(k) => figure[k],
        };
        self.said.iter().any(|said| match said {
            Said::Equal([i, j], _) => at(*i) == at(*j),
            Said::Length(..) => false,
        })
    }

    /// The places of the points that move, for all signs; `None` if some signs leave a line of them.
    fn figures(&self) -> Option<BTreeSet<Vec<Ratio>>> {
        let moving = self.places.len() - 2;
        let mut out = BTreeSet::new();
        for signs in 0..1u32 << self.said.len() {
            // Rows of factors of the points that move, and the right-hand side.
            let mut rows: Vec<Vec<i128>> = Vec::new();
            for (e, said) in self.said.iter().enumerate() {
                let sign = if signs >> e & 1 == 1 { -1 } else { 1 };
                let mut row = vec![0i128; moving + 1];
                let mut add = |point: usize, by: i128| match point.checked_sub(2) {
                    Some(k) => row[k] += by,
                    None => row[moving] -= by * i128::from(self.places[point]),
                };
                match said {
                    Said::Length([i, j], d) => {
                        add(*i, 1);
                        add(*j, -1);
                        row[moving] += sign * i128::from(*d);
                    }
                    Said::Equal([i, j], [k, l]) => {
                        add(*i, 1);
                        add(*j, -1);
                        add(*k, sign);
                        add(*l, -sign);
                    }
                }
                rows.push(row);
            }
            match solved(rows, moving) {
                Solved::One(x) => {
                    out.insert(x);
                }
                Solved::None => {}
                Solved::Many => return None,
            }
        }
        Some(out)
    }
}

enum Solved {
    None,
    One(Vec<Ratio>),
    Many,
}

/// Elimination in whole numbers.
fn solved(mut rows: Vec<Vec<i128>>, n: usize) -> Solved {
    let mut done = 0;
    for k in 0..n {
        let Some(pivot) = (done..rows.len()).find(|&r| rows[r][k] != 0) else {
            continue;
        };
        rows.swap(done, pivot);
        for r in (0..rows.len()).filter(|&r| r != done) {
            let (p, q) = (rows[done][k], rows[r][k]);
            if q != 0 {
                for c in 0..=n {
                    rows[r][c] = p * rows[r][c] - q * rows[done][c];
                }
                let by = rows[r].iter().fold(0, |by: i128, x| by.gcd(x)).max(1);
                rows[r].iter_mut().for_each(|x| *x /= by);
            }
        }
        done += 1;
    }
    if rows[done..].iter().any(|row| row[n] != 0) {
        return Solved::None;
    }
    if done < n {
        return Solved::Many;
    }
    Solved::One((0..n).map(|k| ratio(rows[k][n], rows[k][k])).collect())
}

/// Sets of points on a line are those that all signs give, and are proved by their covers; where signs leave a line of figures, nothing is called
/// complete.
#[test]
fn points_on_a_line_are_where_some_signs_put_them() {
    let mut random = Random(11);
    let (mut complete, mut flexible) = (0, 0);
    for k in 0..150 {
        let line = Line::random(&mut random, 4 + k % 5);
        let problem = line.problem();
        let (result, cover) = searched(&problem);
        match line.figures() {
            None => {
                flexible += 1;
                assert_ne!(result.status, Status::Complete, "{}", problem.to_toml());
            }
            Some(figures) if figures.iter().any(|figure| line.is_singular(figure)) => {
                assert!(result.solutions.len() <= figures.len());
            }
            Some(figures) => {
                complete += 1;
                assert_eq!(result.status, Status::Complete, "{}", problem.to_toml());
                assert_eq!(
                    result.solutions.len(),
                    figures.len(),
                    "{}",
                    problem.to_toml()
                );
                let verdict = verify_cover(&cover.to_bytes()).unwrap();
                assert_eq!(verdict.flaw, None);
                assert_eq!(verdict.undecided, 0, "{}", problem.to_toml());
                for solution in &result.solutions {
                    let is_it = |figure: &&Vec<Ratio>| {
                        figure.iter().enumerate().all(|(k, &(a, b))| {
                            let x = a as f64 / b as f64 / 10.0;
                            let range = solution.points[k + 2][0];
                            (range.inf() - 1e-12..=range.sup() + 1e-12).contains(&x)
                        })
                    };
                    assert_eq!(figures.iter().filter(is_it).count(), 1);
                }
            }
        }
    }
    assert!(complete > 100, "{complete} and {flexible}");
}

/// Rows of holes, equal gaps on both sides: several equations of which one sign contradicts the others, exactly.
#[test]
fn equal_gaps_are_few_figures() {
    // Four holes between two edges, 0.4 and 2.3 apart, equally far from both edges: x is a sum of signs.
    let holes = Line {
        places: vec![0, 71, 20, 24, 47, 51],
        said: vec![
            Said::Length([2, 3], 4),
            Said::Length([3, 4], 23),
            Said::Length([4, 5], 4),
            Said::Equal([0, 2], [5, 1]),
        ],
    };
    let problem = holes.problem();
    let (result, cover) = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    // a + d = 7.1, as no signs make d − a = 7.1; two of the eight d − a are met twice, by other figures.
    assert_eq!(result.solutions.len(), 8);
    assert!(result.boxes < 200, "{}", result.boxes);
    assert_eq!(verify_cover(&cover.to_bytes()).unwrap().undecided, 0);
}

/// An arc that goes on in another one, whose centres are level: either circles about one point, which the end of the arc contradicts in exact numbers and
/// not in any others, or the end is level with the centres.
#[test]
fn an_arc_goes_on_in_another_one() {
    let problem = Problem::parse(
        r#"
        name = "wave"
        dimension = 2
        [points]
        c = [-25, 15]
        s = [-25, 25]
        e = [-15, 15]
        d = [-5, 15]
        f = [-5, 5]
        [arcs]
        one = { center = "c", start = "e", end = "s" }
        two = { center = "d", start = "e", end = "f" }
        [constraints]
        fixed = ["c", "s", "f"]
        y = [["d", 15]]
        parallel = [["c", "e", "d", "e"]]
        "#,
        "wave.toml",
    )
    .unwrap();
    let (result, cover) = searched(&problem);
    assert_eq!(result.status, Status::Complete);
    assert_eq!(result.solutions.len(), 2);
    let verdict = verify_cover(&cover.to_bytes()).unwrap();
    assert_eq!((verdict.flaw, verdict.undecided), (None, 0));
}

/// Signs that leave a line of figures end at once.
#[test]
fn a_line_of_figures_is_seen_at_once() {
    let slides = Line {
        places: vec![0, 50, 10, 40],
        said: vec![Said::Length([2, 3], 50), Said::Equal([0, 2], [1, 3])],
    };
    let problem = slides.problem();
    let options = Options::default();
    let result = all(&problem, &options).unwrap();
    assert_eq!(result.status, Status::Flexible);
    assert!(result.boxes < 100, "{}", result.boxes);
}
