//! The one test that proves everything: Krawczyk's, with a preconditioner that moves along a
//! polynomial. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Equations, ZERO};
use super::extended::{Low, rounded_time};
use super::whole::{Columns, J_BITS, LIMIT, Whole, above, between, exact, power, size, split};
use crate::certificate::format::WEIGHT_UNIT;
use crate::certificate::verdict::Fault;
use crate::interval::{Interval, point};

/// The degree of ẑ.
pub const ORDER: usize = 5;
/// The largest power of σ in F(ẑ(σ)), in which t occurs to the fourth.
const DEGREE: usize = 4 * ORDER;
/// Weights are multiples of 2 to minus this.
const WEIGHT_BITS: i32 = 16;

pub const LARGE: Fault = Fault::because("its numbers are too large or too far apart for the test");

/// Cross-sections c·z = const with the norm's weights u in them, and [J; c] U at a curve's z₀. Its rows are
/// divided by the powers of two to the exponents in `scale`, in units of 2⁻⁴⁴, and rounded.
pub struct Section {
    pub c: Vec<f64>,
    pub u: Vec<u16>,
    pub scale: Vec<i32>,
    pub j0: Columns,
    /// What every row may have lost, undivided.
    rests: Vec<Interval>,
}

/// A polynomial ẑ(σ) = Σ z_k σᵏ, |σ| ≤ 1, whose coordinates are multiples of powers of two: differences of
/// coordinates and their products are exact.
pub struct Curve<'a> {
    pub eq: &'a Equations,
    /// The units of z₀ are 2 to minus the first of these, those of all others 2 to minus the second.
    pub bits: [i32; 2],
    /// Its coefficients.
    pub z: Vec<Vec<f64>>,
    /// What z₀ is more than its floats.
    pub low: Option<Low>,
    /// For each coefficient all forms, in its units.
    pub forms: Vec<Vec<i64>>,
    /// The coefficients of E_e(t₀ + τ) in τ, per equation.
    right: Vec<[Interval; 5]>,
    /// Where τ = Σ t_k σᵏ, k ≥ 1: the coefficients of τʲ.
    powers: [[Interval; DEGREE + 1]; 5],
}

impl<'a> Curve<'a> {
    /// The constant polynomial that is nearest to a point.
    pub fn at(eq: &'a Equations, centre: &[f64]) -> Result<Self, Fault> {
        let mut curve = Curve {
            eq,
            // The number 1 is a multiple of the unit, too.
            bits: [51 - magnitude(&centre[..eq.m]).max(0); 2],
            z: Vec::new(),
            low: None,
            forms: Vec::new(),
            right: Vec::new(),
            powers: [[ZERO; DEGREE + 1]; 5],
        };
        curve.push(centre)?;
        let t = point(curve.z[0][eq.m]);
        curve.right = (0..eq.m).map(|e| eq.right_at(e, t)).collect();
        Ok(curve)
    }

    /// The constant polynomial near the sum `high` + `low` of two points, with more than 53 bits: the field `low`
    /// holds what z₀ is more than its floats.
    pub fn at_sum(eq: &'a Equations, high: &[f64], low: &[f64]) -> Result<Self, Fault> {
        let mut sum: Vec<f64> = high.iter().zip(low).map(|(x, y)| x + y).collect();
        sum[eq.m] = rounded_time(sum[eq.m]);
        let mut curve = Curve::at(eq, &sum)?;
        let pairs = high.iter().zip(low).zip(&curve.z[0]);
        let rest: Vec<f64> = pairs.map(|((x, y), z)| (x - z) + y).collect();
        curve.low = Some(Low::near(eq, curve.z[0][eq.m], curve.bits[0], &rest)?);
        let t = point(curve.z[0][eq.m]) + curve.low_of(eq.m);
        curve.right = (0..eq.m).map(|e| eq.right_at(e, t)).collect();
        Ok(curve)
    }

    /// An entry of what z₀ is more than its floats.
    pub fn low_of(&self, i: usize) -> Interval {
        self.low.as_ref().map_or(ZERO, |low| point(low.floats[i]))
    }

    /// Adds the next coefficient, its coordinates rounded.
    pub fn push(&mut self, z: &[f64]) -> Result<(), Fault> {
        let (k, m) = (self.z.len(), self.eq.m);
        if k == 1 {
            // All others may be 64 times as large, or 4 times where more digits are needed.
            let spare = if self.low.is_some() { 3 } else { 7 };
            self.bits[1] = (52 - spare - magnitude(&z[..m])).max(self.bits[0]);
        }
        let bits = self.bits[k.min(1)];
        let mut whole: Vec<f64> = z[..m].iter().map(|x| (x * power(bits)).round()).collect();
        // Then differences have 53 bits, and the sums of products 121.
        if !(whole.iter().all(|x| x.abs() < power(52)) && z[m].is_finite()) {
            return Err(LARGE);
        }
        let one = if k == 0 { power(bits) } else { 0.0 };
        let of = |i: usize| self.eq.entry(i, |i| whole[i], [0.0, one]);
        let forms = self.eq.forms.iter().map(|&[i, j]| (of(i) - of(j)) as i64);
        self.forms.push(forms.collect());
        whole.iter_mut().for_each(|x| *x *= power(-bits));
        // t is in no form.
        whole.push(z[m]);
        self.z.push(whole);
        if k > 0 {
            self.powers[1][k] = point(z[m]);
        }
        // What is known now of the powers of τ: all of them once ẑ is complete.
        for k in k + 1..=if k == ORDER { DEGREE } else { k + 1 } {
            for j in 2..5 {
                let factors =
                    (1..k.min(ORDER + 1)).map(|a| (self.powers[1][a], self.powers[j - 1][k - a]));
                let factors = factors.filter(|&(_, y)| y != ZERO);
                self.powers[j][k] = factors.fold(ZERO, |sum, (x, y)| sum + x * y);
            }
        }
        Ok(())
    }

    /// The sum of the products of q_e for two coefficients, doubled.
    fn products(&self, e: usize, a: usize, b: usize) -> i128 {
        let (x, y) = (&self.forms[a], &self.forms[b]);
        let product = |&(factor, [left, right]): &(i64, [usize; 2])| {
            i128::from(factor) * (i128::from(x[left]) * i128::from(y[right]))
        };
        self.eq.products[e].iter().map(product).sum()
    }

    /// The coefficient of σᵏ in F(ẑ(σ)).
    pub fn residual(&self, k: usize) -> Vec<Interval> {
        let ([coarse, fine], known) = (self.bits, self.z.len());
        let residual = |e: usize| {
            let (right, degree) = (&self.right[e], self.eq.degree(e));
            if k == 0 {
                return match &self.low {
                    None => nearly(self.products(e, 0, 0), 2 * coarse + 1) - right[0],
                    Some(low) => low.value(self.eq, e, coarse, &self.forms[0]),
                };
            }
            let inner = 1.max((k + 1).saturating_sub(known))..known.min(k);
            let inner: i128 = inner.map(|a| self.products(e, a, k - a)).sum();
            let mut f = nearly(inner, 2 * fine + 1);
            if k < known {
                let outer = self.products(e, 0, k) + self.products(e, k, 0);
                f += nearly(outer, coarse + fine + 1);
                if let Some(low) = &self.low {
                    f += low.product(self.eq, e, [coarse, fine], &self.forms[k]);
                }
            }
            let powers = (1..=degree).map(|j| (right[j], self.powers[j][k]));
            let powers = powers.filter(|&(_, power)| power != ZERO);
            powers.fold(f, |sum, (right, power)| sum - right * power)
        };
        // Beyond 2 ORDER there are only powers of t, in equations of higher degree.
        let zero = |e: usize| k > 2 * ORDER && self.eq.degree(e) <= 2;
        (0..self.eq.m)
            .map(|e| if zero(e) { ZERO } else { residual(e) })
            .collect()
    }

    /// The coefficient of σᵏ in E_e'(t).
    pub fn slope(&self, e: usize, k: usize) -> Interval {
        let right = &self.right[e];
        if k == 0 {
            return right[1];
        }
        let terms = 2..=self.eq.degree(e);
        terms.fold(ZERO, |sum, j| {
            sum + point(j as f64) * right[j] * self.powers[j - 1][k]
        })
    }

    /// The coefficient of σᵏ in J(ẑ(σ)) U. Adds bounds on what every row of it lost to `rests`.
    fn jacobian(
        &self,
        k: usize,
        (u, scale): (&[u16], &[i32]),
        rests: &mut [Interval],
    ) -> Result<Columns, Fault> {
        let m = self.eq.m;
        let mut columns: Columns = vec![Vec::new(); m + 1];
        for (e, &scale) in scale.iter().enumerate().take(m) {
            let bits = self.bits[k.min(1)] + 1 + WEIGHT_BITS + scale;
            for &(i, factor, form) in &self.eq.gradient[e] {
                let entry = i128::from(factor) * i128::from(self.forms[k][form]) * i128::from(u[i]);
                columns[i].push((e, in_units(entry, bits - J_BITS).ok_or(LARGE)?));
            }
            let slope = self.slope(e, k) * -weight(u[m]) * point(power(-scale));
            let (entry, rest) = split(slope).ok_or(LARGE)?;
            columns[m].push((e, entry));
            // Half a unit for each of the others.
            let units = point(self.eq.gradient[e].len() as f64 * power(-J_BITS - 1));
            rests[e] += (rest + units) * point(power(scale));
        }
        Ok(columns)
    }

    /// [J(z₀); c] U.
    pub fn section(&self, c: &[f64], u: &[u16], scale: Vec<i32>) -> Result<Section, Fault> {
        let m = self.eq.m;
        let mut rests = vec![ZERO; m + 1];
        let mut j0 = self.jacobian(0, (u, &scale), &mut rests)?;
        for (e, rest) in rests[..m].iter_mut().enumerate() {
            for &(i, factor, form) in self.low.iter().flat_map(|_| &self.eq.gradient[e]) {
                let change = self.low.as_ref().map(|low| low.change(form, self.bits[0]));
                *rest += point(0.5 * factor.abs() as f64) * change.unwrap_or(ZERO) * weight(u[i]);
            }
        }
        for ((column, &c), &u) in j0.iter_mut().zip(c).zip(u) {
            // Normals have 24 bits and weights 16: all is exact up to the rounding to a whole number.
            let entry = (c * f64::from(u) * power(J_BITS - WEIGHT_BITS - scale[m])).round();
            if !(entry.abs() < LIMIT) {
                return Err(LARGE);
            }
            column.push((m, entry as i64));
            rests[m] += point(power(scale[m] - J_BITS));
        }
        let (c, u) = (c.to_vec(), u.to_vec());
        Ok(Section {
            c,
            u,
            scale,
            j0,
            rests,
        })
    }

    /// The test on the boxes |w|_u ≤ r around ẑ(σ), in the cross-sections c·w = 0. `y`, near the
    /// inverse of [J(z₀); c] U, is any matrix.
    pub fn test(&self, y: &Whole, at: &Section, r: Interval) -> Result<Test, Fault> {
        let (m, n, order, u) = (self.eq.m, self.eq.m + 1, self.z.len() - 1, &at.u);
        let mut rests = at.rests.clone();
        let mut stiff = y.defect(&at.j0);
        let (mut moving, mut square) = (point(1.0), ZERO);
        if order > 0 {
            let [j1, j2] = [1, 2].map(|k| self.jacobian(k, (u, &at.scale), &mut rests));
            let a = y.moving(&j1?, &j2?).ok_or(LARGE)?;
            stiff += a.rest;
            moving += a.norm;
            square = a.square + a.norm * a.second;
        }
        let t = polynomial(&self.z, m, around(point(1.0))) + around(r * weight(u[m]));
        let t = t + self.low_of(m);
        let t_slope = (1..=order).fold(ZERO, |sum, k| {
            sum + point(k as f64) * point(self.z[k][m].abs())
        });
        let weight_of = |i: usize| u.get(i).filter(|_| i < m).map_or(0, |&u| u128::from(u));
        let width = |form: usize| self.eq.forms[form].map(weight_of).iter().sum::<u128>();
        let (mut wide, mut turn) = (vec![ZERO; n], vec![ZERO; n]);
        for e in 0..m {
            let (mut square, mut beyond, mut slope) = (0u128, 0u128, 0u128);
            for &(i, factor, form) in &self.eq.gradient[e] {
                let by = u128::from(factor.unsigned_abs()) * weight_of(i);
                square += by * width(form);
                let forms = self.forms.iter().skip(3).map(|f| f[form].unsigned_abs());
                beyond += by * forms.map(u128::from).sum::<u128>();
            }
            for (k, forms) in self.forms.iter().enumerate().skip(1) {
                for &(factor, [left, right]) in &self.eq.products[e] {
                    let size = |form: usize| u128::from(forms[form].unsigned_abs());
                    let change = size(left) * width(right) + size(right) * width(left);
                    slope += k as u128 * u128::from(factor.unsigned_abs()) * change;
                }
            }
            let slopes = 3..=(self.eq.degree(e).max(2) - 1) * order;
            let slopes = slopes.fold(ZERO, |sum, k| sum + size(self.slope(e, k)));
            let bend = size(self.eq.bend(e, t)) * weight(u[m]);
            let fine = self.bits[1] + WEIGHT_BITS + 1;
            rests[e] += above(beyond, fine) + slopes * weight(u[m]);
            wide[e] = above(square, 2 * WEIGHT_BITS + 1) + bend * weight(u[m]);
            turn[e] = above(slope, fine) + bend * t_slope;
        }

        // The first coefficients of F(ẑ(σ)), and those of t alone, are as good as zero: of them their sizes, and
        // k times these, will do.
        let (mut small, mut small_slope) = (vec![ZERO; n], vec![ZERO; n]);
        let (mut defect, mut defect_slope, mut constant) = (ZERO, ZERO, ZERO);
        for k in 0..=if order > 0 { DEGREE } else { 0 } {
            let (f, times) = (self.residual(k), point(k as f64));
            if k == 0 {
                constant = upper(y.image(&f));
                continue;
            }
            if (ORDER + 1..=2 * ORDER).contains(&k) {
                let image = upper(y.image(&f));
                (defect, defect_slope) = (defect + image, defect_slope + times * image);
                continue;
            }
            for (e, f) in f.into_iter().enumerate().filter(|&(_, f)| f != ZERO) {
                small[e] += size(f);
                small_slope[e] += times * size(f);
            }
        }
        Ok(Test {
            stiff: upper(moving * (stiff + y.bound(&rests)) + square),
            width: upper(moving * y.bound(&wide)),
            constant: upper(moving * constant),
            growing: upper(moving * (defect + y.bound(&small))),
            defect_slope: upper(moving * (defect_slope + y.bound(&small_slope))),
            turn: upper(moving * y.bound(&turn)),
            moving: upper(moving),
        })
    }
}

/// What is known of a family of cross-sections: on |w|_u ≤ ρ, for ρ up to the r that it was made
/// for, |I − Ỹ DG| ≤ `stiff` + `width` ρ; |Ỹ F(ẑ)| ≤ `constant` + |σ| `growing`, its derivative by σ without that of Ỹ
/// `defect_slope`, |Ỹ (J(ẑ + w) − J(ẑ)) ẑ'| ≤ `turn` ρ, and |Ỹ v| ≤ `moving` |Y v|.
pub struct Test {
    pub stiff: Interval,
    pub width: Interval,
    constant: Interval,
    growing: Interval,
    defect_slope: Interval,
    turn: Interval,
    moving: Interval,
}

/// That every cross-section has exactly one zero φ(σ) in its box.
pub struct Proof {
    /// |w|_u is at most so many times |Y x|, for DG(w') U w = x with a w' in the box: as |I − Ỹ DG U| ≤ q
    /// there, it is at most |Ỹ x| / (1 − q).
    pub inverse: Interval,
    /// The zero is at most so far from ẑ(σ); and at most `distances[0] + |σ| distances[1]`.
    pub distance: Interval,
    pub distances: [Interval; 2],
    /// φ'(σ) is at most so far from ẑ'(σ), in the norm |·|_u.
    pub slope_distance: Interval,
    /// 1 − q − η/r.
    pub margin: f64,
}

impl Test {
    /// At least q, the bound of |I − Ỹ DG| on |w|_u ≤ r.
    pub fn contraction(&self, r: Interval) -> Interval {
        upper(self.stiff + self.width * r)
    }

    /// Whether every cross-section has exactly one zero within r.
    pub fn within(&self, r: Interval) -> Result<Proof, Fault> {
        let (one, q) = (point(1.0), self.contraction(r));
        let defect = upper(self.constant + self.growing);
        let margin = (one - q - defect / r).inf();
        if !(q.sup() < 1.0 && margin > 0.0) {
            return Err(Fault::margin(margin));
        }
        // |w| ≤ η/(1 − q) first, and then q for boxes of that size.
        let nearer = self.contraction(upper(defect / (one - q)));
        let distance = upper(defect / (one - nearer));
        Ok(Proof {
            inverse: upper(self.moving / (one - q)),
            slope_distance: upper((self.defect_slope + self.turn * distance) / (one - nearer)),
            distances: [self.constant, self.growing].map(|x| upper(x / (one - nearer))),
            distance,
            margin,
        })
    }
}

/// An exponent e with 2ᵉ ≥ |x| for all of these, within bounds.
pub fn magnitude(v: &[f64]) -> i32 {
    let largest = v.iter().fold(0.0f64, |max, x| max.max(x.abs()));
    largest.clamp(1e-30, 1e30).log2().ceil() as i32
}

/// x 2^−bits, between the neighbours of the nearest float. Scaling is exact.
fn nearly(x: i128, bits: i32) -> Interval {
    let (near, scale) = (x as f64, power(-bits));
    match x.unsigned_abs() < 1 << 53 {
        true => point(near * scale),
        false => between(near.next_down() * scale, near.next_up() * scale),
    }
}

/// x 2^−shift, rounded to a whole number, for |x| below 2¹⁰⁰. `None`: too large.
fn in_units(x: i128, shift: i32) -> Option<i64> {
    let entry = match shift {
        110.. => 0,
        1..110 => (x + (1 << (shift - 1))) >> shift,
        -50..1 => x.checked_mul(1 << -shift)?,
        _ => return None,
    };
    (entry.unsigned_abs() < LIMIT as u128).then_some(entry as i64)
}

/// A weight.
pub fn weight(u: u16) -> Interval {
    point(WEIGHT_UNIT * f64::from(u))
}

/// Σ z_k σᵏ, one of its entries.
pub fn polynomial(z: &[Vec<f64>], i: usize, s: Interval) -> Interval {
    z.iter().rev().fold(ZERO, |sum, z| sum * s + point(z[i]))
}

/// Σ k z_k σᵏ⁻¹, k ≥ 1, the derivative of Σ z_k σᵏ by σ: one of its entries.
pub fn derivative(z: &[Vec<f64>], i: usize, s: Interval) -> Interval {
    let terms = (1..z.len()).rev().map(|k| point(k as f64) * point(z[k][i]));
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
