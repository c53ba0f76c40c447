//! Bounds of a block's unknowns where the equations one by one have none: circles that touch are cones in centres and radii.
//!
//! Whole multiples of equations are added until products of unknowns cancel, exactly. Where all unknowns but one follow from the linear
//! equations that come of it, x_k = α_k + β_k t, any equation is a t² + b t + c = 0; if a is not 0 then
//! |t| ≤ (|b| + √(b² + 4 |a c|)) / (2 |a|).

use super::space::{Product, difference};
use crate::interval::{Interval, ZERO, checked, point};
use crate::system::told::Flat;
use std::collections::BTreeMap;

/// Whole numbers beyond this are not reckoned with: all below are floats, exactly.
const LARGEST: u64 = 1 << 40;

/// `Σ squares_kl x_k x_l + Σ linear_k x_k + constant = 0` in a block's unknowns.
#[derive(Clone)]
pub struct Expanded {
    /// squares_kl with k ≤ l, not zero.
    pub squares: BTreeMap<(usize, usize), i64>,
    /// linear_k.
    pub linear: Vec<Interval>,
    /// constant.
    pub constant: Interval,
}

impl Expanded {
    /// Σ products = right, all entries that are not unknowns of the block being numbers in their ranges.
    pub fn new(
        (products, right): (&[Product], Interval),
        unknowns: &[usize],
        x: &[Interval],
    ) -> Self {
        let mut out = Expanded {
            squares: BTreeMap::new(),
            linear: vec![ZERO; unknowns.len()],
            constant: -right,
        };
        // The unknowns in a form, with their signs, and the rest of it.
        let split = |[i, j]: [usize; 2]| {
            let own = |entry: usize| unknowns.iter().position(|&u| u == entry);
            let rest = match (i == j, own(i), own(j)) {
                (true, ..) => return (Vec::new(), ZERO),
                (_, None, None) => difference(x, [i, j]),
                (_, Some(_), None) => -x[j],
                (_, None, Some(_)) => x[i],
                (_, Some(_), Some(_)) => ZERO,
            };
            let first = own(i).map(|k| (k, 1));
            let second = own(j).map(|k| (k, -1));
            (first.into_iter().chain(second).collect(), rest)
        };
        for &(factor, [left, right]) in products {
            let (l, r): ((Vec<(usize, i64)>, _), (Vec<(usize, i64)>, _)) =
                (split(left), split(right));
            for &(k, s) in &l.0 {
                for &(j, t) in &r.0 {
                    *out.squares.entry((k.min(j), k.max(j))).or_default() += factor * s * t;
                }
            }
            for (one, other) in [(&l, &r), (&r, &l)] {
                for &(k, s) in &one.0 {
                    out.linear[k] += point((factor * s) as f64) * other.1;
                }
            }
            out.constant += point(factor as f64) * l.1 * r.1;
        }
        out.squares.retain(|_, q| *q != 0);
        out
    }

    /// The same of terms and a constant that are 0 together, each term a factor, an unknown, and perhaps another one. `None`: two of these
    /// unknowns are multiplied.
    pub fn of(flat: &Flat, unknowns: &[usize], x: &[Interval]) -> Option<Self> {
        let mut out = Expanded {
            squares: BTreeMap::new(),
            linear: vec![ZERO; unknowns.len()],
            constant: flat.constant,
        };
        let own = |u: usize| unknowns.iter().position(|&v| v == u);
        for &(by, u, v) in &flat.terms {
            match (own(u), v.map(|v| (own(v), x[v]))) {
                (Some(_), Some((Some(_), _))) => return None,
                (Some(k), None) => out.linear[k] += by,
                (Some(k), Some((None, other))) => out.linear[k] += by * other,
                (None, Some((Some(k), _))) => out.linear[k] += by * x[u],
                (None, Some((None, other))) if v == Some(u) => out.constant += by * other.sqr(),
                (None, Some((None, other))) => out.constant += by * x[u] * other,
                (None, None) => out.constant += by * x[u],
            }
        }
        Some(out)
    }

    /// Its terms, with the unknowns' own numbers.
    pub fn flat(&self, unknowns: &[usize]) -> Flat {
        let squares = self.squares.iter();
        let squares =
            squares.map(|(&(k, l), &q)| (point(q as f64), unknowns[k], Some(unknowns[l])));
        let linear = self.linear.iter().zip(unknowns);
        let linear = linear.map(|(&b, &u)| (b, u, None));
        let terms = squares.chain(linear.filter(|term| term.0 != ZERO));
        Flat {
            terms: terms.collect(),
            constant: self.constant,
        }
    }

    /// This times a whole number less another one times one.
    pub fn combined(&self, by: i64, other: &Self, times: i64) -> Option<Self> {
        let mut squares = BTreeMap::new();
        for (row, factor) in [(self, by), (other, times.checked_neg()?)] {
            for (&key, &q) in &row.squares {
                let sum = squares.entry(key).or_insert(0i64);
                *sum = sum.checked_add(factor.checked_mul(q)?)?;
            }
        }
        squares.retain(|_, q| *q != 0);
        let is_large = |q: &i64| q.unsigned_abs() > LARGEST;
        if squares.values().any(is_large) || is_large(&by) || is_large(&times) {
            return None;
        }
        let (by, times) = (point(by as f64), point(times as f64));
        let pairs = self.linear.iter().zip(&other.linear);
        Some(Expanded {
            linear: pairs.map(|(&a, &b)| by * a - times * b).collect(),
            constant: by * self.constant - times * other.constant,
            squares,
        })
    }

    /// The greatest |t| if all unknowns are α + β t.
    pub fn greatest(&self, lines: &[[Interval; 2]]) -> Option<f64> {
        let (mut a, mut b, mut c) = (ZERO, ZERO, self.constant);
        for (&(k, l), &q) in &self.squares {
            let (q, [alpha, beta], [gamma, delta]) = (point(q as f64), lines[k], lines[l]);
            // A square is never negative.
            let product = |x: Interval, y: Interval| if k == l { x.sqr() } else { x * y };
            a += q * product(beta, delta);
            b += q * (alpha * delta + beta * gamma);
            c += q * product(alpha, gamma);
        }
        for (&by, [alpha, beta]) in self.linear.iter().zip(lines) {
            b += by * *beta;
            c += by * *alpha;
        }
        let is_bounded = [a, b, c].iter().all(|x| x.is_common_interval());
        if !is_bounded || a.contains(0.0) {
            return None;
        }
        let (least, a, b, c) = (
            point(a.mig()),
            point(a.mag()),
            point(b.mag()),
            point(c.mag()),
        );
        let most = (b + (b.sqr() + point(4.0) * a * c).sqrt()) / (point(2.0) * least);
        Some(most.sup()).filter(|most| most.is_finite())
    }
}

/// Takes an unknown out of all rows but one, by multiples of that one (Gauss and Jordan, in intervals).
pub fn eliminate(rows: &mut [Expanded], one: usize, unknown: usize) {
    let pivot = rows[one].clone();
    for (j, row) in rows.iter_mut().enumerate() {
        if j == one || row.linear[unknown] == ZERO {
            continue;
        }
        let by = row.linear[unknown] / pivot.linear[unknown];
        let pairs = row.linear.iter_mut().zip(&pivot.linear);
        pairs.for_each(|(x, y)| *x -= by * *y);
        // The same numbers in both, so that nothing is left of this one.
        row.linear[unknown] = ZERO;
        row.constant -= by * pivot.constant;
    }
}

/// Ranges that hold n unknowns at every zero in a part, from the equations that are linear in them where all else is a number in its
/// range: each with its place among the unknowns.
pub fn far(rows: impl Iterator<Item = Expanded>, n: usize) -> Vec<(usize, Interval)> {
    let is_bounded = |row: &Expanded| {
        let all = || row.linear.iter().chain([&row.constant]);
        row.squares.is_empty() && all().all(|x| x.is_common_interval())
    };
    let mut rows: Vec<Expanded> = rows.filter(is_bounded).collect();
    // What each is solved for.
    let mut solved: Vec<Option<usize>> = vec![None; rows.len()];
    // How certain it is that an unknown stands in a row, beside all others.
    let share = |row: &Expanded, k: usize| {
        let sum: f64 = row.linear.iter().map(|x| x.mag()).sum();
        row.linear[k].mig() / sum
    };
    loop {
        let open = (0..rows.len()).filter(|&e| solved[e].is_none());
        let pairs = open.flat_map(|e| (0..n).map(move |k| (e, k)));
        let pairs = pairs.filter(|&(_, k)| !solved.contains(&Some(k)));
        let best = pairs
            .map(|(e, k)| (share(&rows[e], k), e, k))
            .filter(|(share, ..)| *share > 0.0)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, e, k)) = best else { break };
        solved[e] = Some(k);
        eliminate(&mut rows, e, k);
    }
    let found = rows.iter().zip(solved).filter_map(|(row, k)| {
        let k = k?;
        let is_alone = (0..n).all(|j| j == k || row.linear[j] == ZERO);
        is_alone.then(|| (k, -(row.constant / row.linear[k])))
    });
    found.collect()
}

/// The linear equations that come of these by adding whole multiples of others.
pub fn without_products(rows: &[Expanded]) -> Option<Vec<Expanded>> {
    let (mut linear, mut curved): (Vec<Expanded>, Vec<Expanded>) = (Vec::new(), Vec::new());
    for row in rows {
        let mut row = row.clone();
        for pivot in &curved {
            let (key, &p) = pivot.squares.first_key_value()?;
            if let Some(&q) = row.squares.get(key) {
                row = row.combined(p, pivot, q)?;
            }
        }
        match row.squares.is_empty() {
            true => linear.push(row),
            false => curved.push(row),
        }
    }
    Some(linear)
}

/// Ranges that hold the n unknowns of a block at every zero of its equations in a part. `None`: nothing follows.
pub fn bounds(rows: &[Expanded], n: usize) -> Option<Vec<Interval>> {
    let mut linear = without_products(rows)?;
    linear.truncate(n);
    if linear.len() + 1 < n {
        return None;
    }
    // For each row the unknown that it is solved for.
    let mut solved: Vec<usize> = Vec::new();
    for k in 0..linear.len() {
        let size = |c: usize| linear[k].linear[c].mig();
        let others = (0..n).filter(|c| !solved.contains(c));
        let best = others.max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        if linear[k].linear[best].contains(0.0) {
            return None;
        }
        eliminate(&mut linear, k, best);
        solved.push(best);
    }
    let free = (0..n).find(|c| !solved.contains(c));
    let line = |k: usize| match solved.iter().position(|&c| c == k) {
        None => [ZERO, point(1.0)],
        Some(row) => {
            let (row, by) = (&linear[row], linear[row].linear[k]);
            let beta = free.map_or(ZERO, |t| -(row.linear[t] / by));
            [-(row.constant / by), beta]
        }
    };
    let lines: Vec<[Interval; 2]> = (0..n).map(line).collect();
    let range = match free {
        None => ZERO,
        Some(_) => {
            let all = rows.iter().filter_map(|row| row.greatest(&lines));
            let most = all.min_by(f64::total_cmp)?;
            checked(-most, most)?
        }
    };
    let of = |[alpha, beta]: &[Interval; 2]| *alpha + *beta * range;
    Some(lines.iter().map(of).collect())
}
