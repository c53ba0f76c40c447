//! Linear algebra with numbers of 256 bits.

pub use super::float::Big;

pub type Rows = Vec<Vec<Big>>;

pub fn dot(a: &[Big], b: &[Big]) -> Big {
    let parts = nonzero(a).into_iter();
    parts.map(|(i, x)| x * &b[i]).sum()
}

/// A vector of floats, exactly.
pub fn exact(x: &[f64]) -> Vec<Big> {
    x.iter().map(|&x| Big::of(x)).collect()
}

/// Σ c_k sᵏ.
pub fn horner(coefficients: &[f64], s: &Big) -> Big {
    let mut out = Big::of(0.0);
    for &c in coefficients.iter().rev() {
        out = &out * s + Big::of(c);
    }
    out
}

/// Its derivative by s.
pub fn horner_slope(coefficients: &[f64], s: &Big) -> Big {
    let mut out = Big::of(0.0);
    for (k, &c) in coefficients.iter().enumerate().skip(1).rev() {
        out = &out * s + Big::of(k as f64) * Big::of(c);
    }
    out
}

/// What is not zero in a row, with where it stands.
fn nonzero(row: &[Big]) -> Vec<(usize, Big)> {
    let zero = Big::of(0.0);
    let entries = row.iter().cloned().enumerate();
    entries.filter(|(_, x)| *x != zero).collect()
}

/// X with A X = G, by Gauss's elimination with row pivots. `None`: A is singular.
pub fn solve(mut a: Rows, mut g: Rows) -> Option<Rows> {
    let n = a.len();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| {
            let sizes = a[i][k].abs().partial_cmp(&a[j][k].abs());
            sizes.expect("numbers")
        })?;
        a.swap(k, best);
        g.swap(k, best);
        if a[k][k] == Big::of(0.0) {
            return None;
        }
        let scale = Big::of(1.0) / &a[k][k];
        let (row, right) = (nonzero(&a[k][k + 1..]), nonzero(&g[k]));
        for i in k + 1..n {
            if a[i][k] == Big::of(0.0) {
                continue;
            }
            let factor = &a[i][k] * &scale;
            for (j, y) in &row {
                a[i][k + 1 + j] -= &factor * y;
            }
            for (j, y) in &right {
                g[i][*j] -= &factor * y;
            }
        }
    }
    for k in (0..n).rev() {
        let scale = Big::of(1.0) / &a[k][k];
        let mut row = g[k].clone();
        for (j, factor) in nonzero(&a[k][k + 1..]) {
            for (x, y) in row.iter_mut().zip(&g[k + 1 + j]) {
                *x -= &factor * y;
            }
        }
        g[k] = row.iter().map(|x| x * &scale).collect();
    }
    Some(g)
}
