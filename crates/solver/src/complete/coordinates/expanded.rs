//! Rows multiplied out in some of their entries, as the checker has them.

use super::newton::{KNOWN, Square};
use super::system::Row;
use crate::certificate::cover::coordinates::bounds::Expanded;
use crate::interval::{Interval, ZERO, point};
use std::collections::BTreeMap;

/// Four times a row in n unknowns, where `of` has the place of each among these, or else the range of an entry. `None`: two of them are
/// multiplied by something else than a small number of quarters.
pub fn expanded(
    row: &Row,
    n: usize,
    of: impl Fn(usize) -> Result<usize, Interval>,
) -> Option<Expanded> {
    let four = point(4.0);
    let mut out = Expanded {
        squares: BTreeMap::new(),
        linear: vec![ZERO; n],
        constant: -(four * row.right),
    };
    for p in &row.products {
        let (quarters, parts) = (four * p.factor, p.expand(&of));
        let whole = quarters.mid();
        let is_whole = quarters.wid() == 0.0 && whole == whole.round() && whole.abs() <= 1e6;
        if !is_whole && !parts.products.is_empty() {
            return None;
        }
        for (key, sign) in parts.products {
            *out.squares.entry(key).or_default() += whole as i64 * i64::from(sign);
        }
        for (k, by) in parts.linear {
            out.linear[k] += quarters * by;
        }
        out.constant += quarters * parts.constant;
    }
    out.squares.retain(|_, q| *q != 0);
    Some(out)
}

/// The equations of a block in its unknowns, all other entries being known.
pub fn equations(square: &Square, x: &[Interval]) -> Vec<Expanded> {
    let of = |entry: usize| match square.place[entry] {
        KNOWN => Err(x[entry]),
        k => Ok(k),
    };
    let rows = square.rows.iter();
    rows.filter_map(|row| expanded(row, square.own.len(), of))
        .collect()
}
