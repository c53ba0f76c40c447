//! Krawczyk's test: which figures exist, and how far around them there is no other.

use super::geometry::Plan;
use crate::certificate::checker::guess::invert;
use crate::certificate::checker::matrix::{Columns, exact};
use crate::interval::{Interval, hull, point};

/// A figure, proved.
pub struct Figure {
    /// The middle.
    pub centre: Vec<[f64; 3]>,
    /// It is this near to the middle, in each free coordinate.
    pub radius: f64,
    /// No other is this near to the middle, in each free coordinate.
    pub alone: f64,
}

/// Proves that one figure is near `centre`.
///
/// With F_e = ½(|p_a − p_b|² − s_e), J its Jacobian at the middle and Y ≈ J⁻¹, |I − Y J(x + w)| ≤ q₀ + κ|w| in the norm
/// max |w_i|; F is quadratic, so that there is at most one zero for |w| < (1 − q₀)/κ, and one where |Y F| is small enough.
pub fn prove(plan: &Plan, centre: &[[f64; 3]]) -> Option<Figure> {
    let d = plan.dimension;
    let m = plan.edges.len();
    if centre.len() != plan.points {
        return None;
    }
    // The number of each free coordinate.
    let mut free = vec![[None; 3]; plan.points];
    let mut count = 0;
    for p in 0..plan.points {
        let order = plan.cover.base.iter().position(|&b| b == p).unwrap_or(d);
        for k in 0..3 {
            if k < order.min(d) {
                free[p][k] = Some(count);
                count += 1;
            } else if centre[p][k] != 0.0 {
                return None;
            }
        }
    }
    if count != m {
        return None;
    }
    let row = |e: usize| -> Vec<(usize, Interval)> {
        let [a, b] = plan.edges[e];
        let mut out = Vec::new();
        for k in 0..d {
            let difference = point(centre[a][k]) - point(centre[b][k]);
            out.extend(free[a][k].map(|i| (i, difference)));
            out.extend(free[b][k].map(|i| (i, -difference)));
        }
        out
    };
    let rows: Vec<_> = (0..m).map(row).collect();
    let residual: Vec<Interval> = (0..m)
        .map(|e| {
            let [a, b] = plan.edges[e];
            let square = (0..d).fold(point(0.0), |sum, k| {
                sum + (point(centre[a][k]) - point(centre[b][k])).sqr()
            });
            point(0.5) * (square - plan.squares[e])
        })
        .collect();
    // Per row, how much |w| = 1 changes the sum of its entries: an entry's difference is of one or two unknowns.
    let change = |e: usize| -> f64 {
        let [a, b] = plan.edges[e];
        let unknowns = |k: usize| free[a][k].iter().chain(&free[b][k]).count();
        (0..d).map(|k| (unknowns(k) * unknowns(k)) as f64).sum()
    };
    let mut columns: Columns = vec![Vec::new(); m];
    for (e, row) in rows.iter().enumerate() {
        row.iter().for_each(|&(i, x)| columns[i].push((e, x.mid())));
    }
    // Any matrix will do.
    let y = invert(&columns)?;
    let (mut q0, mut kappa, mut step) = (0.0f64, 0.0f64, 0.0f64);
    for i in 0..m {
        let mut product = vec![point(0.0); m];
        product[i] = point(-1.0);
        let (mut varied, mut off) = (point(0.0), point(0.0));
        for e in 0..m {
            let factor = exact(y.entries[e * m + i]);
            for &(k, x) in &rows[e] {
                product[k] += factor * x;
            }
            varied += factor.abs() * point(change(e));
            off += factor.abs() * residual[e].abs();
        }
        let defect = product.iter().fold(point(0.0), |sum, x| sum + x.abs());
        (q0, kappa, step) = (
            q0.max(defect.sup()),
            kappa.max(varied.sup()),
            step.max(off.sup()),
        );
    }
    if !(q0 < 0.5 && kappa > 0.0 && kappa < 1e30 && step < 1e30) {
        return None;
    }
    let alone = (point(0.99) * (point(1.0) - point(q0)) / point(kappa))
        .inf()
        .min(1.0);
    // Where |w| ≤ radius, the test's operator maps into itself: |Y F| + (q₀ + κ radius) radius ≤ radius.
    let radius = (point(step) * point(4.0)).sup();
    let image = point(step) + (point(q0) + point(kappa) * point(radius)) * point(radius);
    let inside = radius == 0.0 || image.sup() < radius;
    // On the positive side of the axes of the base.
    let upper = plan.cover.base.iter().enumerate().skip(1);
    let right = upper
        .map(|(place, &p)| centre[p][place - 1])
        .all(|x| x > radius);
    (inside && radius < 0.5 * alone && right).then(|| Figure {
        centre: centre.to_vec(),
        radius,
        alone,
    })
}

impl Figure {
    /// The mirror image in the base.
    pub fn mirrored(&self, dimension: usize) -> Vec<[f64; 3]> {
        let mut image = self.centre.clone();
        image
            .iter_mut()
            .for_each(|p| p[dimension - 1] = -p[dimension - 1]);
        image
    }

    /// Whether this figure and one whose middle is given and whose radius is this are surely different.
    pub fn is_apart(&self, centre: &[[f64; 3]], radius: f64) -> bool {
        let box_of = |x: f64, r: f64| {
            let (x, r) = (point(x), hull(-r, r));
            x + r
        };
        let pairs = self.centre.iter().flatten().zip(centre.iter().flatten());
        pairs
            .into_iter()
            .any(|(&x, &y)| box_of(x, self.radius).disjoint(box_of(y, radius)))
    }
}
