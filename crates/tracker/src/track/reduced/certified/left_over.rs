//! What the preconditioner's rows for the key unknowns leave over: |Z J_A| and |P S − V E − I|.
//!
//! Both are summed over orders in s: what does not get smaller with s, and what does like s³.

use super::along::Along;
use super::frame::{Reduction, SERIES};
use super::series::{SIGNED, Series, add_product};
use crate::linalg::LANE;
use crate::linalg::rstructure::{Row, add};
use crate::places::Each as _;
use crate::track::full::Equations;

/// The two parts of a bound by key unknown.
pub type Parts<const W: usize> = [Row<W>; 2];

/// |Z J_A| ρ_A.
#[inline(never)]
pub fn of_z<const W: usize>(
    equations: &Equations,
    y: &Reduction,
    series: &Series,
    along: &Along,
    rho_a: &[f64],
) -> Parts<W> {
    let hs = &along.powers;
    let [mut constant, mut cubic] = [[[0.0; LANE]; W]; 2];
    let zj = series.zj.each_ref().each(|zj| zj.as_chunks::<W>().0);
    for block in &y.elimination.layout.blocks {
        for &unknown in &block.unknowns[..block.size] {
            let i = unknown as usize;
            let rho = rho_a[i];
            let zj = zj.each(|zj| &zj[i]);
            for w in 0..W {
                for l in 0..LANE {
                    let entry = |q: usize| hs[q] * zj[q][w][l].abs();
                    constant[w][l] += (entry(0) + entry(1) + entry(2)) * rho;
                    cubic[w][l] += entry(3) * rho;
                }
            }
        }
    }
    let zs = y.z.each_ref().each(|z| z.as_chunks::<W>().0);
    for e in 0..equations.tail.first() {
        let mut tails = [0.0; SERIES + 1];
        for axis in 0..equations.dimension() {
            let [i, j] = equations.ends[axis][e];
            let both = rho_a[i as usize] + rho_a[j as usize];
            tails[0] += along.from[4][axis][e] * both;
            tails[1] += along.from[3][axis][e] * both;
            tails[2] += along.from[2][axis][e] * both;
        }
        for (q, (z, tail)) in zs.iter().zip(tails).enumerate() {
            let size = z[e].each(|lane| lane.each(f64::abs));
            add(&mut cubic, hs[q] * tail, &size);
        }
    }
    for e in equations.tail.first()..equations.m {
        let [_, from2, from3, from4, _] = &along.tail.entries;
        for (q, (z, from)) in zs.iter().zip([from4, from3, from2]).enumerate() {
            let size = z[e].each(|lane| lane.each(f64::abs));
            let tail = along.tail.times(equations, e, from, rho_a);
            add(&mut cubic, hs[q] * tail, &size);
        }
    }
    [constant, cubic]
}

/// |P S − V E − I| times the key unknowns' weights, but for what V E has at low orders by rounding.
#[inline(never)]
pub fn of_s<const W: usize>(
    y: &Reduction,
    series: &Series,
    along: &Along,
    kappa: &Row<W>,
) -> Parts<W> {
    let layout = &y.elimination.layout;
    let zs = y.z.each_ref().each(|z| z.as_chunks::<W>().0);
    let keys = layout.keys();
    let m = zs[0].len() - 1;
    let rows_of_s = layout.rows_of_s(m);
    let mut parts = [[[0.0; LANE]; W]; 2];
    for q in 0..=SERIES + SIGNED {
        let mut columns = [[[[0.0; LANE]; W]; LANE]; W];
        for i in q.saturating_sub(SIGNED)..=SERIES.min(q) {
            let jk = series.jk[q - i].as_chunks::<W>().0;
            if q - i > SERIES {
                // E as well has these orders, and its rows and the ignored ones are all.
                add_product(0..m + 1, zs[i], jk, &mut columns);
            } else {
                add_product(rows_of_s[..keys].iter().copied(), zs[i], jk, &mut columns);
            }
        }
        let part = &mut parts[(q > SERIES) as usize];
        for (j, column) in columns.as_flattened_mut()[..keys].iter_mut().enumerate() {
            let (w, l) = (j / LANE, j % LANE);
            if q == 0 {
                column[w][l] -= 1.0;
            }
            let size = column.each(|lane| lane.each(f64::abs));
            add(part, along.powers[q] * kappa[w][l], &size);
        }
    }
    parts
}
