//! Sums of two equations in which products of unknowns cancel: two spheres meet in a plane, which bounds more than either.

use super::bounds::Expanded;
use super::space::{Empty, Part, narrow_form, square};
use crate::interval::Interval;
use crate::system::told::Flat;

/// A whole multiple of one of a block's equations less one of another.
pub struct Sum {
    rows: [usize; 2],
    by: [i64; 2],
}

/// More sums than these are not taken for a block.
const MOST: usize = 200;

impl Sum {
    /// The sum of these equations.
    pub fn of(&self, rows: &[Expanded]) -> Option<Expanded> {
        let [one, other] = self.rows;
        rows[one].combined(self.by[0], &rows[other], self.by[1])
    }
}

/// For every two equations the sum with the fewest products of unknowns, if these are fewer than in either, or by two fewer than in one. (Any sum
/// would do.)
pub fn choose(rows: &[Expanded]) -> Vec<Sum> {
    let pairs = (0..rows.len()).flat_map(|e| (0..e).map(move |f| [e, f]));
    let sums = pairs.filter_map(|pair| {
        let [one, other] = pair.map(|e| &rows[e]);
        let sizes = [one.squares.len(), other.squares.len()];
        let (least, most) = (sizes[0].min(sizes[1]), sizes[0].max(sizes[1]));
        let tried = one.squares.iter().filter_map(|(key, &q)| {
            let by = [*other.squares.get(key)?, q];
            let count = one.combined(by[0], other, by[1])?.squares.len();
            Some((count, by))
        });
        let (count, by) = tried.min_by_key(|(count, _)| *count)?;
        (count < least || count + 2 <= most).then_some(Sum { rows: pair, by })
    });
    sums.take(MOST).collect()
}

/// Narrows a part by an equation: each term is in the opposite of all others together.
pub fn narrow(Flat { terms, constant }: &Flat, part: &mut Part) -> Result<(), Empty> {
    let value = |part: &Part, &(by, u, v): &(Interval, usize, Option<usize>)| {
        let x = part.entries();
        by * match v {
            None => x[u],
            Some(v) if v == u => x[u].sqr(),
            Some(v) => x[u] * x[v],
        }
    };
    // An unknown as a difference: behind the unknowns stand t, the number 0 and the number 1.
    let zero = part.ranges().len() + 1;
    if terms.is_empty() && !constant.contains(0.0) {
        return Err(Empty);
    }
    for (k, term) in terms.iter().enumerate() {
        let others = terms.iter().enumerate().filter(|(j, _)| *j != k);
        let rest = others.fold(*constant, |rest, (_, term)| rest + value(part, term));
        let &(by, u, v) = term;
        if rest.is_entire() || by.contains(0.0) {
            continue;
        }
        let wanted = -(rest / by);
        match v {
            None => narrow_form([u, zero], wanted, part)?,
            Some(v) if v == u => square([u, zero], wanted, part)?,
            Some(v) => {
                for (u, v) in [(u, v), (v, u)] {
                    let other = part.entries()[v];
                    if !other.contains(0.0) {
                        narrow_form([u, zero], wanted / other, part)?;
                    }
                }
            }
        }
    }
    Ok(())
}
