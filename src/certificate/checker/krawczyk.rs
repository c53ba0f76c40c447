//! The one test that proves everything: Krawczyk's, with a preconditioner that moves along a
//! polynomial. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Equations, ZERO};
use super::whole::{Columns, J_BITS, LIMIT, Whole, above, exact, power, size, split};
use crate::certificate::format::WEIGHT_UNIT;
use crate::interval::{Interval, point};

/// The degree of ẑ.
pub const ORDER: usize = 5;
/// The largest power of σ in F(ẑ(σ)), in which t occurs to the fourth.
const DEGREE: usize = 4 * ORDER;
/// Weights are multiples of 2 to minus this.
const WEIGHT_BITS: i32 = 16;

/// What fails in a test.
pub type Fault = &'static str;
pub const LARGE: Fault = "its numbers are too large for the test";

/// A polynomial ẑ(σ) = Σ z_k σᵏ, |σ| ≤ 1, whose coefficients are multiples of 2^−bits: differences of
/// coordinates and their products are exact.
pub struct Curve<'a> {
    pub eq: &'a Equations,
    bits: i32,
    /// Its coefficients, each with n entries and a zero.
    pub z: Vec<Vec<Interval>>,
    /// For each coefficient p_i − p_j per distance and axis, in units of 2^−bits.
    differences: Vec<Vec<[i64; 3]>>,
    /// The coefficients of E_e(t₀ + τ) in τ, per distance.
    half_squares: Vec<[Interval; 5]>,
    /// Where τ = Σ t_k σᵏ, k ≥ 1: the coefficients of τʲ.
    powers: [[Interval; DEGREE + 1]; 5],
}

impl<'a> Curve<'a> {
    /// The constant polynomial that is nearest to a point.
    pub fn at(eq: &'a Equations, centre: &[f64]) -> Result<Self, Fault> {
        let largest = centre.iter().fold(1e-9f64, |max, x| max.max(x.abs()));
        let mut curve = Curve {
            eq,
            bits: 51 - largest.min(1e18).log2().ceil() as i32,
            z: Vec::new(),
            differences: Vec::new(),
            half_squares: Vec::new(),
            powers: [[ZERO; DEGREE + 1]; 5],
        };
        curve.push(centre)?;
        let t = curve.z[0][eq.m];
        curve.half_squares = (0..eq.m).map(|e| eq.half_square_at(e, t)).collect();
        Ok(curve)
    }

    /// Adds the next coefficient, rounded.
    pub fn push(&mut self, z: &[f64]) -> Result<(), Fault> {
        let round = |x: &f64| (x * power(self.bits)).round();
        let whole: Vec<f64> = z.iter().map(round).chain([0.0]).collect();
        // Then differences have 53 bits, and the sums of products 112.
        if !whole.iter().all(|x| x.abs() < power(52)) {
            return Err(LARGE);
        }
        let difference = |[i, j]: [usize; 2]| (whole[i] - whole[j]) as i64;
        let ends = self.eq.ends.iter();
        self.differences
            .push(ends.map(|e| e.map(difference)).collect());
        let z: Vec<Interval> = whole.iter().map(|x| point(x * power(-self.bits))).collect();
        let k = self.z.len();
        if k > 0 {
            self.powers[1][k] = z[self.eq.m];
        }
        self.z.push(z);
        // What is known now of the powers of τ: all of them once ẑ is complete.
        let known = k + 1..=if k == ORDER { DEGREE } else { k + 1 };
        for k in known {
            for j in 2..5 {
                let factors =
                    (1..k.min(ORDER + 1)).map(|a| (self.powers[1][a], self.powers[j - 1][k - a]));
                let factors = factors.filter(|&(_, y)| y != ZERO);
                self.powers[j][k] = factors.fold(ZERO, |sum, (x, y)| sum + x * y);
            }
        }
        Ok(())
    }

    /// The coefficient of σᵏ in F(ẑ(σ)).
    pub fn residual(&self, k: usize) -> Vec<Interval> {
        let residual = |e: usize| {
            let mut sum = 0i128;
            for (a, one) in self.differences.iter().enumerate().take(k + 1) {
                if let Some(other) = self.differences.get(k - a) {
                    let products = one[e].iter().zip(&other[e]);
                    sum += products
                        .map(|(&x, &y)| i128::from(x) * i128::from(y))
                        .sum::<i128>();
                }
            }
            // Between the neighbours of the nearest float. Scaling is exact.
            let (near, scale) = (sum as f64, power(-2 * self.bits - 1));
            let half = between(near.next_down() * scale, near.next_up() * scale);
            let l = &self.half_squares[e];
            if k == 0 {
                return half - l[0];
            }
            let powers = (1..=self.eq.homotopy.rights[e].degree).map(|j| (j, self.powers[j][k]));
            let powers = powers.filter(|&(_, power)| power != ZERO);
            powers.fold(half, |sum, (j, power)| sum - l[j] * power)
        };
        // Beyond 2 ORDER there are only powers of t, in the one length that bends.
        let zero = |e: usize| k > 2 * ORDER && self.eq.homotopy.rights[e].degree == 2;
        (0..self.eq.m)
            .map(|e| if zero(e) { ZERO } else { residual(e) })
            .collect()
    }

    /// The coefficient of σᵏ in E_e'(t).
    fn slope(&self, e: usize, k: usize) -> Interval {
        let l = &self.half_squares[e];
        if k == 0 {
            return l[1];
        }
        let terms = (2..=self.eq.homotopy.rights[e].degree)
            .map(|j| point(j as f64) * l[j] * self.powers[j - 1][k]);
        terms.fold(ZERO, |sum, x| sum + x)
    }

    /// The coefficient of σᵏ in J(ẑ(σ)) U, rounded to units of 2⁻⁴⁰. Adds bounds on what every row
    /// of it lost to `rests`.
    fn jacobian(&self, k: usize, u: &[u16], rests: &mut [Interval]) -> Result<Columns, Fault> {
        let m = self.eq.m;
        let shift = self.bits + WEIGHT_BITS - J_BITS;
        if shift < 1 {
            return Err(LARGE);
        }
        let mut columns: Columns = vec![Vec::new(); m + 1];
        for e in 0..m {
            for (ends, &d) in self.eq.ends[e].iter().zip(&self.differences[k][e]) {
                for (&i, d) in ends.iter().zip([d, -d]).filter(|&(&i, _)| i <= m) {
                    let entry = (i128::from(d) * i128::from(u[i]) + (1 << (shift - 1))) >> shift;
                    if entry.unsigned_abs() >= LIMIT as u128 {
                        return Err(LARGE);
                    }
                    columns[i].push((e, entry as i64));
                }
            }
            let (entry, rest) = split(self.slope(e, k) * -weight(u[m])).ok_or(LARGE)?;
            columns[m].push((e, entry));
            // Half a unit for each of six coordinates.
            rests[e] += rest + point(3.0 * power(-J_BITS));
        }
        Ok(columns)
    }

    /// [J(z₀); c] U, rounded in the same way.
    pub fn bordered(&self, c: &[f64], u: &[u16], rests: &mut [Interval]) -> Result<Columns, Fault> {
        let mut columns = self.jacobian(0, u, rests)?;
        for ((column, &c), &u) in columns.iter_mut().zip(c).zip(u) {
            // Normals have 24 bits and weights 16: all is exact up to the rounding to a whole number.
            let entry = (c * f64::from(u) * power(J_BITS - WEIGHT_BITS)).round();
            if entry.abs() >= LIMIT {
                return Err(LARGE);
            }
            column.push((self.eq.m, entry as i64));
            rests[self.eq.m] += point(power(-J_BITS));
        }
        Ok(columns)
    }

    /// Per axis the weights of a distance's two coordinates, added.
    fn widths(&self, e: usize, u: &[u16]) -> [u64; 3] {
        let weight = |i: usize| u.get(i).map_or(0, |&u| u.into());
        self.eq.ends[e].map(|[i, j]| weight(i) + weight(j))
    }

    /// The test on the boxes |w|_u ≤ r around ẑ(σ), in the cross-sections c·w = 0. `y`, near the
    /// inverse of [J(z₀); c] U, is any matrix.
    pub fn test(&self, y: &Whole, c: &[f64], u: &[u16], r: Interval) -> Result<Test, Fault> {
        let (m, n) = (self.eq.m, self.eq.m + 1);
        let order = self.z.len() - 1;
        let mut rests = vec![ZERO; n];
        let mut stiff = y.defect(&self.bordered(c, u, &mut rests)?);
        let (mut moving, mut square) = (point(1.0), ZERO);
        if order > 0 {
            let [j1, j2] = [1, 2].map(|k| self.jacobian(k, u, &mut rests));
            let a = y.moving(&j1?, &j2?).ok_or(LARGE)?;
            stiff += a.rest;
            moving += a.norm;
            square = a.square + a.norm * a.second;
        }
        let t = polynomial(&self.z, m, around(point(1.0))) + around(r * weight(u[m]));
        let (mut wide, mut turn) = (vec![ZERO; n], vec![ZERO; n]);
        let t_slope = (1..=order).fold(ZERO, |sum, k| sum + point(k as f64) * size(self.z[k][m]));
        for e in 0..m {
            let widths = self.widths(e, u);
            let square: u64 = widths.iter().map(|w| w * w).sum();
            let (mut beyond, mut slope) = (0u128, 0u128);
            for (k, differences) in self.differences.iter().enumerate().skip(1) {
                let sizes = differences[e].iter().zip(widths);
                let sizes = sizes.map(|(d, w)| u128::from(d.unsigned_abs()) * u128::from(w));
                let change: u128 = sizes.sum();
                slope += k as u128 * change;
                beyond += if k > 2 { change } else { 0 };
            }
            let degree = self.eq.homotopy.rights[e].degree;
            let slopes = (3..=(degree - 1) * order).map(|k| size(self.slope(e, k)));
            let slopes = slopes.fold(ZERO, |sum, x| sum + x) * weight(u[m]);
            rests[e] += above(beyond, self.bits + WEIGHT_BITS) + slopes;
            let bend = size(self.eq.bend(e, t)) * weight(u[m]);
            wide[e] = above(square.into(), 2 * WEIGHT_BITS) + bend * weight(u[m]);
            turn[e] = above(slope, self.bits + WEIGHT_BITS) + bend * t_slope;
        }

        // The first coefficients of F(ẑ(σ)) are as good as zero: their sizes will do.
        let mut small = vec![ZERO; n];
        let (mut defect, mut defect_slope) = (ZERO, ZERO);
        for k in 0..=if order > 0 { DEGREE } else { 0 } {
            let mut f = self.residual(k);
            if (1..=ORDER).contains(&k) || k > 2 * ORDER {
                small.iter_mut().zip(f).for_each(|(sum, f)| *sum += size(f));
            } else {
                f.resize(n, ZERO);
                let image = y.image(&f);
                defect += image;
                defect_slope += point(k as f64) * image;
            }
        }
        let bound = |v: &[Interval]| {
            let sizes: Vec<Interval> = v.iter().map(|&x| around(x)).collect();
            y.image(&sizes)
        };
        let small = bound(&small);
        Ok(Test {
            stiff: upper(moving * (stiff + bound(&rests)) + square),
            width: upper(moving * bound(&wide)),
            defect: upper(moving * (defect + small)),
            defect_slope: upper(moving * (defect_slope + point(DEGREE as f64) * small)),
            turn: upper(moving * bound(&turn)),
        })
    }
}

/// What is known of a family of cross-sections: on |w|_u ≤ ρ, for ρ up to the r that it was made
/// for, |I − Ỹ DG| ≤ `stiff` + `width` ρ; |Ỹ F(ẑ)| ≤ `defect`, its derivative by σ without that of Ỹ
/// `defect_slope`, and |Ỹ (J(ẑ + w) − J(ẑ)) ẑ'| ≤ `turn` ρ.
pub struct Test {
    pub stiff: Interval,
    pub width: Interval,
    pub defect: Interval,
    defect_slope: Interval,
    turn: Interval,
}

/// That every cross-section has exactly one zero φ(σ) in its box.
pub struct Proof {
    /// It is at most so far from ẑ(σ).
    pub distance: Interval,
    /// And φ'(σ) from ẑ'(σ).
    pub slope_distance: Interval,
    /// 1 − q − η/r.
    pub margin: f64,
}

impl Test {
    /// Whether every cross-section has exactly one zero within r.
    pub fn within(&self, r: Interval) -> Result<Proof, Fault> {
        const EXPANDS: Fault = "the Krawczyk test fails: its map is no contraction of the box";
        let one = point(1.0);
        let q = upper(self.stiff + self.width * r);
        if !(q.sup() < 1.0) {
            return Err(EXPANDS);
        }
        let margin = (one - q - self.defect / r).inf();
        if !(margin > 0.0) {
            return Err("the Krawczyk test fails: the box is not mapped into its inside");
        }
        // |w| ≤ η/(1 − q) first, and then q for boxes of that size.
        let near = upper(self.defect / (one - q));
        let q = upper(self.stiff + self.width * near);
        if !(q.sup() < 1.0) {
            return Err(EXPANDS);
        }
        let distance = upper(self.defect / (one - q));
        let slope_distance = upper((self.defect_slope + self.turn * distance) / (one - q));
        Ok(Proof {
            distance,
            slope_distance,
            margin,
        })
    }
}

/// A weight.
pub fn weight(u: u16) -> Interval {
    point(WEIGHT_UNIT * f64::from(u))
}

/// Σ z_k σᵏ, one of its entries.
pub fn polynomial(z: &[Vec<Interval>], i: usize, s: Interval) -> Interval {
    z.iter().rev().fold(ZERO, |sum, z| sum * s + z[i])
}

/// The same of the derivative.
pub fn derivative(z: &[Vec<Interval>], i: usize, s: Interval) -> Interval {
    let terms = (1..z.len()).rev().map(|k| point(k as f64) * z[k][i]);
    terms.fold(ZERO, |sum, z| sum * s + z)
}

/// [−x, x] for the upper end of a non-negative x.
pub fn around(x: Interval) -> Interval {
    between(-x.sup(), x.sup())
}

/// The upper end.
pub fn upper(x: Interval) -> Interval {
    exact(x.sup())
}

/// From a to b; everything where that is no interval.
pub fn between(a: f64, b: f64) -> Interval {
    inari::interval!(a, b).unwrap_or(Interval::ENTIRE)
}
