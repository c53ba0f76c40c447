//! Sums of two equations in which products of unknowns cancel: two spheres meet in a plane, which bounds more than either.

pub use super::bounds::Expanded;
use super::space::{Empty, Part};
use crate::certificate::checker::equations::{Equations, Product, ZERO};
use crate::interval::{Interval, checked, point};

/// A whole multiple of one of a block's equations less one of another.
pub struct Sum {
    rows: [usize; 2],
    by: [i64; 2],
}

/// More sums than these are not taken for a block.
const MOST: usize = 200;

/// Equations in a block's unknowns, all other entries being in their ranges.
pub fn expanded<'a>(
    eq: &Equations,
    rows: impl Iterator<Item = (&'a [Product], Interval)>,
    unknowns: &[usize],
    part: &Part,
) -> Vec<Expanded> {
    let x = part.entries();
    rows.map(|row| Expanded::new(eq, row, unknowns, x))
        .collect()
}

/// For every two equations the sum with the fewest products of unknowns, if these are fewer than in either. (Any sum would do.)
pub fn choose(rows: &[Expanded]) -> Vec<Sum> {
    let mut sums = Vec::new();
    for (e, one) in rows.iter().enumerate() {
        for (f, other) in rows[..e].iter().enumerate() {
            let least = one.squares.len().min(other.squares.len());
            let tried = one.squares.iter().filter_map(|(key, &q)| {
                let by = [*other.squares.get(key)?, q];
                let count = one.combined(by[0], other, by[1])?.squares.len();
                Some((count, by))
            });
            let best = tried.min_by_key(|(count, _)| *count);
            if let Some((_, by)) = best.filter(|(count, _)| *count < least) {
                sums.push(Sum { rows: [e, f], by });
            }
        }
    }
    sums.truncate(MOST);
    sums
}

/// Narrows a part by sums of equations.
pub fn narrow(
    sums: &[Sum],
    rows: &[Expanded],
    unknowns: &[usize],
    part: &mut Part,
) -> Result<(), Empty> {
    for Sum { rows: [e, f], by } in sums {
        if let Some(sum) = rows[*e].combined(by[0], &rows[*f], by[1]) {
            narrow_by(&sum, unknowns, part)?;
        }
    }
    Ok(())
}

/// Each term is in the opposite of all others together.
fn narrow_by(sum: &Expanded, unknowns: &[usize], part: &mut Part) -> Result<(), Empty> {
    // q x_k x_l, or b x_k.
    let squares = sum.squares.iter();
    let squares = squares.map(|(&(k, l), &q)| (point(q as f64), unknowns[k], Some(unknowns[l])));
    let linear = sum.linear.iter().zip(unknowns);
    let linear = linear.map(|(&b, &u)| (b, u, None));
    let terms: Vec<_> = squares
        .chain(linear.filter(|term| term.0 != ZERO))
        .collect();
    let value = |part: &Part, &(by, u, v): &(Interval, usize, Option<usize>)| {
        let x = part.entries();
        by * match v {
            None => x[u],
            Some(v) if v == u => x[u].sqr(),
            Some(v) => x[u] * x[v],
        }
    };
    for (k, term) in terms.iter().enumerate() {
        let others = terms.iter().enumerate().filter(|(j, _)| *j != k);
        let rest = others.fold(sum.constant, |rest, (_, term)| rest + value(part, term));
        let &(by, u, v) = term;
        if rest.is_entire() || by.contains(0.0) {
            continue;
        }
        let wanted = -(rest / by);
        match v {
            None => part.narrow(u, wanted)?,
            Some(v) if v == u => {
                let root = wanted.intersection(checked(0.0, f64::INFINITY).ok_or(Empty)?);
                if root.is_empty() {
                    return Err(Empty);
                }
                let root = root.sqrt();
                let [low, high] = [-root, root].map(|side| side.intersection(part.entries()[u]));
                part.narrow(u, low.convex_hull(high))?;
            }
            Some(v) => {
                for (u, v) in [(u, v), (v, u)] {
                    let other = part.entries()[v];
                    if !other.contains(0.0) {
                        part.narrow(u, wanted / other)?;
                    }
                }
            }
        }
    }
    Ok(())
}
