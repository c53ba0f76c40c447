//! The check of figures at infinity: how points go there, and that each claimed figure is one of those that the theorem of
//! `src/complex/infinity/mod.rs` is about, whose words and letters are used here.
//!
//! A figure that passes stands for two isolated ones, up to rotation, for general lengths near those given; no two that pass stand for
//! congruent ones. For each departure is checked, exactly:
//!
//! - S, the points that go, has no fixed point, and O, which has neither S nor its neighbours L, has one;
//! - L is connected by its edges, which are as many as its points, so that they have one cycle;
//! - a ratio ν for each point of L, 0 for the first one, rises along every edge by just its length, as claimed, and the first ν that is not zero
//!   is positive;
//! - it is the only one with these S and ν.
//!
//! And for each figure of it: the equations at ε = 0 have exactly one zero near the numbers claimed, with a regular Jacobian; Λ is
//! not zero in S nor σ in O; Σ Δλ Δτ / Δν around the cycle is not zero; no other one of this departure is the same zero.

use super::ComplexFlaw;
use super::figure::number;
use super::zero::{Quadratic, Z, Zero};
use crate::equations::Form;
use crate::interval::{Interval, enclose_rational, point};
use crate::problem::Problem;
use crate::rational::Rational;
use crate::system::Term;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Figures at infinity to which the same points go in the same manner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// The points that go.
    pub away: Vec<String>,
    /// For each distance between neighbours of those its points, first the one with the lower ν.
    pub rises: Vec<[String; 2]>,
    /// For each figure and each point (in the problem's order) Λ or λ, ν, τ or σ: for each real and imaginary part, perhaps followed by
    /// what these leave. For lengths in the problem's unit.
    pub figures: Vec<Vec<Vec<Vec<f64>>>>,
}

/// Unknowns of a point: Λ or λ, ν, τ or σ.
pub const LAMBDA: usize = 0;
/// See [`LAMBDA`].
pub const NU: usize = 1;
/// See [`LAMBDA`].
pub const SIGMA: usize = 2;

/// The number of such an unknown of a point among all.
pub fn unknown(point: usize, which: usize) -> usize {
    3 * point + which
}

/// Where a point is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Part {
    /// In S.
    Goes,
    /// In L.
    Link,
    /// In O.
    Stays,
}

/// How points go, checked, and the equations at ε = 0.
struct Chart {
    parts: Vec<Part>,
    /// ν in L, zero elsewhere.
    heights: Vec<Rational>,
    /// Edges in L from the lower to the upper point: first those of a tree, each of which joins a new point to those before, then the
    /// one that closes the cycle.
    edges: Vec<[usize; 2]>,
    /// The first point of L.
    origin: usize,
    system: Quadratic,
}

fn wrong<T>(text: &str) -> Result<T, ComplexFlaw> {
    Err(ComplexFlaw::False(text.to_owned()))
}

fn doubt<T>(text: &str) -> Result<T, ComplexFlaw> {
    Err(ComplexFlaw::NotProved(text.to_owned()))
}

impl Chart {
    fn new(problem: &Problem, fixed: &[usize], claim: &Departure) -> Result<Self, ComplexFlaw> {
        let n = problem.points.len();
        if problem.dimension != 3 {
            return doubt("figures at infinity are known in space only");
        }
        let find = |name: &String| problem.points.iter().position(|p| p.name == *name);
        let mut parts = vec![Part::Stays; n];
        for name in &claim.away {
            match find(name) {
                Some(p) if parts[p] != Part::Goes => parts[p] = Part::Goes,
                _ => return wrong("a point that goes is no point of the problem, or there twice"),
            }
        }
        for distance in &problem.distances {
            let [a, b] = distance.points;
            for [a, b] in [[a, b], [b, a]] {
                if parts[a] == Part::Goes && parts[b] == Part::Stays {
                    parts[b] = Part::Link;
                }
            }
        }
        if fixed.iter().any(|&p| parts[p] == Part::Goes)
            || !fixed.iter().any(|&p| parts[p] == Part::Stays)
        {
            return doubt("a fixed point goes, or all of them have neighbours that go");
        }
        let first = |part: Part| parts.iter().position(|&other| other == part);
        let (Some(away), Some(origin), Some(near)) =
            (first(Part::Goes), first(Part::Link), first(Part::Stays))
        else {
            return doubt("no point goes, or none has a neighbour that goes, or none stays");
        };
        // Edges in L, upwards, with their lengths.
        let mut among: Vec<([usize; 2], Rational)> = Vec::new();
        for distance in &problem.distances {
            let [a, b] = distance.points;
            if parts[a] != Part::Link || parts[b] != Part::Link {
                continue;
            }
            let is = |rise: &[String; 2], a: usize, b: usize| {
                find(&rise[0]) == Some(a) && find(&rise[1]) == Some(b)
            };
            let ends = match &claim.rises {
                rises if rises.iter().any(|rise| is(rise, a, b)) => [a, b],
                rises if rises.iter().any(|rise| is(rise, b, a)) => [b, a],
                _ => return wrong("it is not said how a distance between neighbours rises"),
            };
            match distance.target.squared().sqrt() {
                Some(length) => among.push((ends, length)),
                None => return doubt("a length between neighbours is no ratio"),
            }
        }
        let link = || (0..n).filter(|&p| parts[p] == Part::Link);
        if among.len() != claim.rises.len() {
            return wrong("something else than the distances between neighbours rises");
        }
        if among.len() != link().count() {
            return doubt("the neighbours' distances do not make one cycle");
        }
        let mut heights: Vec<Option<Rational>> = vec![None; n];
        heights[origin] = Some(Rational::zero());
        let (mut edges, mut rest) = (Vec::new(), among.clone());
        while let Some(k) = rest
            .iter()
            .position(|([low, high], _)| heights[*low].is_some() != heights[*high].is_some())
        {
            let ([low, high], length) = rest.remove(k);
            match (&heights[low], &heights[high]) {
                (Some(height), None) => heights[high] = Some(height + length),
                (None, Some(height)) => heights[low] = Some(height - length),
                _ => unreachable!("one of them has a height"),
            }
            edges.push([low, high]);
        }
        if link().any(|p| heights[p].is_none()) {
            return doubt("the neighbours are not connected by their distances");
        }
        // As many edges as points: one is left, and closes the cycle.
        edges.extend(rest.iter().map(|(ends, _)| *ends));
        let heights: Vec<Rational> = heights.into_iter().map(Option::unwrap_or_default).collect();
        if among
            .iter()
            .any(|([low, high], length)| &heights[*high] - &heights[*low] != *length)
        {
            return wrong("lengths around the cycle do not add up to zero");
        }
        if !link()
            .map(|p| &heights[p])
            .find(|h| !h.is_zero())
            .is_some_and(Rational::is_positive)
        {
            return wrong("the first ν that is not zero is not positive");
        }
        let distances = problem.distances.iter();
        let distances = distances.map(|d| (d.points, d.target.squared()));
        let equations = rows(
            distances,
            |p| parts[p],
            link().map(|p| (p, heights[p].clone())),
            [origin, near, away],
        );
        let system = Quadratic::new(3 * n, equations);
        Ok(Chart {
            system,
            parts,
            heights,
            edges,
            origin,
        })
    }

    fn prove(&self, figure: &[Vec<Vec<f64>>]) -> Option<Zero> {
        let is_whole = figure.iter().all(|place| place.len() == 3);
        let near = figure.iter().flatten().map(|parts| number(parts));
        let near: Vec<Z> = near.collect::<Option<_>>().filter(|_| is_whole)?;
        let zero = self.system.prove(&near)?;
        self.is_regular(&zero).then_some(zero)
    }

    /// Whether Λ is not zero in S, nor σ in O, nor the sum around the cycle.
    fn is_regular(&self, zero: &Zero) -> bool {
        let is_nonzero = |z: [Interval; 2]| z.iter().any(|x| !x.contains(0.0));
        let is_away = |(p, part): (usize, &Part)| match part {
            Part::Goes => is_nonzero(zero.part(unknown(p, LAMBDA))),
            Part::Link => true,
            Part::Stays => is_nonzero(zero.part(unknown(p, SIGMA))),
        };
        // The sum of Δλ Δτ / Δν from the first point along the tree.
        let mut sums: Vec<Option<[Interval; 2]>> = vec![None; self.parts.len()];
        sums[self.origin] = Some([point(0.0); 2]);
        let mut around = None;
        for &[low, high] in &self.edges {
            let difference = |which: usize| {
                let [a, b] = [high, low].map(|p| zero.part(unknown(p, which)));
                [a[0] - b[0], a[1] - b[1]]
            };
            let ([a, b], [c, d]) = (difference(LAMBDA), difference(SIGMA));
            let per_rise = enclose_rational(&(&self.heights[high] - &self.heights[low]).recip());
            let term = [(a * c - b * d) * per_rise, (a * d + b * c) * per_rise];
            match (sums[low], sums[high]) {
                (Some(s), None) => sums[high] = Some([s[0] + term[0], s[1] + term[1]]),
                (None, Some(s)) => sums[low] = Some([s[0] - term[0], s[1] - term[1]]),
                (Some(s), Some(t)) => {
                    around = Some([0, 1].map(|i| s[i] + term[i] - t[i]));
                }
                (None, None) => return false,
            }
        }
        self.parts.iter().enumerate().all(is_away) && around.is_some_and(is_nonzero)
    }
}

/// The equations at ε = 0, with half the sum of their terms on the left: those of distances, given with their squares, and those that
/// say what unknowns are: of the points of L their ν (`heights`), and what is chosen for its first point, one of O and one of S.
pub fn rows(
    distances: impl IntoIterator<Item = ([usize; 2], Rational)>,
    part: impl Fn(usize) -> Part,
    heights: impl IntoIterator<Item = (usize, Rational)>,
    [origin, near, away]: [usize; 3],
) -> Vec<(Vec<Term>, Rational)> {
    let term = |left, right| Term::new(2, left, right);
    let mut rows = Vec::new();
    for ([a, b], squared) in distances {
        let both =
            |which: usize| Form::Difference(Some(unknown(a, which)), Some(unknown(b, which)));
        // The difference of what points of one part have, which stands for nothing at others.
        let only = |which: usize, of: Part| {
            let entry = |p: usize| (part(p) == of).then(|| unknown(p, which));
            Form::Difference(entry(a), entry(b))
        };
        let product = match [part(a), part(b)] {
            [Part::Link, Part::Link] => continue,
            // Λ Δτ
            [Part::Goes, Part::Link] | [Part::Link, Part::Goes] => {
                term(only(LAMBDA, Part::Goes), both(SIGMA))
            }
            // Δλ (0 − σ)
            [Part::Link, Part::Stays] | [Part::Stays, Part::Link] => {
                term(both(LAMBDA), only(SIGMA, Part::Stays))
            }
            _ => term(both(LAMBDA), both(SIGMA)),
        };
        rows.push((vec![term(both(NU), both(NU)), product], squared));
    }
    let known = [
        (unknown(origin, LAMBDA), 0),
        (unknown(origin, SIGMA), 0),
        (unknown(near, NU), 0),
        (unknown(near, SIGMA), 1),
        (unknown(away, NU), 0),
        (unknown(away, LAMBDA), 1),
    ];
    let known = known.map(|(u, value)| (u, Rational::from_integer(value.into())));
    let heights = heights
        .into_iter()
        .map(|(p, height)| (unknown(p, NU), height));
    let only = |unknown: usize| Form::Difference(Some(unknown), None);
    let known = known.into_iter().chain(heights);
    rows.extend(known.map(|(u, value)| (vec![term(only(u), Form::One)], value)));
    rows
}

/// Checks all figures at infinity that are claimed. For each departure the points that go and how many figures there are.
pub fn check(
    problem: &Problem,
    fixed: &[usize],
    claims: &[Departure],
) -> Result<Vec<(Vec<usize>, usize)>, ComplexFlaw> {
    let mut charts: Vec<Chart> = Vec::new();
    let mut counts = Vec::new();
    for claim in claims {
        let chart = Chart::new(problem, fixed, claim)?;
        let is_chart = |one: &Chart| one.parts == chart.parts && one.heights == chart.heights;
        if charts.iter().any(is_chart) {
            return wrong("two departures of figures at infinity are the same");
        }
        let zeros: Vec<Option<Zero>> = claim.figures.par_iter().map(|f| chart.prove(f)).collect();
        let Some(zeros) = zeros.into_iter().collect::<Option<Vec<Zero>>>() else {
            return doubt("a figure at infinity is not proved to be one");
        };
        let pairs = (0..zeros.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        for (a, b) in pairs {
            match zeros[a].is_same(&zeros[b]) {
                Some(false) => {}
                Some(true) => return wrong("two figures at infinity are the same"),
                None => return doubt("two figures at infinity are not clearly apart"),
            }
        }
        let goes = (0..chart.parts.len()).filter(|&p| chart.parts[p] == Part::Goes);
        counts.push((goes.collect(), zeros.len()));
        charts.push(chart);
    }
    Ok(counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Point 0 goes, 1, 2 and 3 are its neighbours at ν = 0, 1, 3, point 4 stays.
    fn is_regular(values: [[i64; 3]; 5]) -> bool {
        let whole = |value: i64| Rational::from_integer(value.into());
        let equation = |(unknown, &value): (usize, &i64)| {
            let term = Term::new(2, Form::Difference(Some(unknown), None), Form::One);
            (vec![term], whole(value))
        };
        let system = values.iter().flatten().enumerate().map(equation);
        let near = values.iter().flatten().map(|&x| Z::real(x as f64));
        let near: Vec<Z> = near.collect();
        let chart = Chart {
            parts: vec![Part::Goes, Part::Link, Part::Link, Part::Link, Part::Stays],
            heights: [0, 0, 1, 3, 0].map(whole).to_vec(),
            edges: vec![[1, 2], [2, 3], [1, 3]],
            origin: 1,
            system: Quadratic::new(15, system.collect()),
        };
        chart.is_regular(&chart.system.prove(&near).unwrap())
    }

    #[test]
    fn what_must_not_vanish_is_looked_at() {
        // 1 · 1 / 1 + 0 − 1 · 1 / 3 around the cycle.
        let good = [[1, 0, 5], [0, 0, 0], [1, 1, 1], [1, 3, 1], [7, 0, 1]];
        assert!(is_regular(good));
        let changed = |p: usize, place: [i64; 3]| {
            let mut values = good;
            values[p] = place;
            values
        };
        assert!(!is_regular(changed(0, [0, 0, 5])), "Λ");
        assert!(!is_regular(changed(4, [7, 0, 0])), "σ");
        // Neither matters elsewhere.
        assert!(is_regular(changed(0, [1, 0, 0])));
        assert!(is_regular(changed(4, [0, 0, 1])));
        // Where λ and τ are ν the sum is that of Δν.
        let sum = [[1, 0, 5], [0, 0, 0], [1, 1, 1], [3, 3, 3], [7, 0, 1]];
        assert!(!is_regular(sum), "the sum around the cycle");
    }
}
