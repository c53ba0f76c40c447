//! The one test that proves everything: Krawczyk's, with a preconditioner that moves along a
//! polynomial. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Equations, ZERO};
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

/// Where curves are cut: the cross-sections c·z = const, the weights u of the norm in them, and by which
/// powers of two the equations and c·z are divided, so that rows of [J; c] U are of about one size.
#[derive(Clone)]
pub struct Section {
    pub c: Vec<f64>,
    pub u: Vec<u16>,
    pub scale: Vec<i32>,
}

/// A polynomial ẑ(σ) = Σ z_k σᵏ, |σ| ≤ 1, whose coordinates are multiples of powers of two: differences of
/// coordinates and their products are exact.
pub struct Curve<'a> {
    pub eq: &'a Equations,
    /// The units of z₀ are 2 to minus the first of these, those of all others 2 to minus the second.
    bits: [i32; 2],
    /// Its coefficients, each with n entries and a zero.
    pub z: Vec<Vec<Interval>>,
    /// For each coefficient all forms, in its units.
    forms: Vec<Vec<i64>>,
    /// The coefficients of E_e(t₀ + τ) in τ, per equation.
    half_squares: Vec<[Interval; 5]>,
    /// Where τ = Σ t_k σᵏ, k ≥ 1: the coefficients of τʲ.
    powers: [[Interval; DEGREE + 1]; 5],
}

impl<'a> Curve<'a> {
    /// The constant polynomial that is nearest to a point.
    pub fn at(eq: &'a Equations, centre: &[f64]) -> Result<Self, Fault> {
        let bits = 51 - magnitude(&centre[..eq.m]);
        let mut curve = Curve {
            eq,
            bits: [bits; 2],
            z: Vec::new(),
            forms: Vec::new(),
            half_squares: Vec::new(),
            powers: [[ZERO; DEGREE + 1]; 5],
        };
        curve.push(centre)?;
        let t = curve.z[0][eq.m];
        curve.half_squares = (0..eq.m).map(|e| eq.half_square_at(e, t)).collect();
        Ok(curve)
    }

    /// The units of coefficient k are 2 to minus this.
    fn bits(&self, k: usize) -> i32 {
        self.bits[k.min(1)]
    }

    /// Adds the next coefficient, its coordinates rounded.
    pub fn push(&mut self, z: &[f64]) -> Result<(), Fault> {
        let (k, m) = (self.z.len(), self.eq.m);
        if k == 1 {
            // All others may be 64 times as large.
            self.bits[1] = (45 - magnitude(&z[..m])).max(self.bits[0]);
        }
        let bits = self.bits(k);
        let whole = z[..m].iter().map(|x| (x * power(bits)).round());
        // t is in no form.
        let whole: Vec<f64> = whole.chain([0.0; 2]).collect();
        // Then differences have 53 bits, and the sums of products 121.
        if !(whole.iter().all(|x| x.abs() < power(52)) && z[m].is_finite()) {
            return Err(LARGE);
        }
        let forms = self.eq.forms.iter();
        self.forms
            .push(forms.map(|&[i, j]| (whole[i] - whole[j]) as i64).collect());
        let coordinates = whole[..m].iter().map(|x| point(x * power(-bits)));
        self.z
            .push(coordinates.chain([point(z[m]), ZERO]).collect());
        if k > 0 {
            self.powers[1][k] = point(z[m]);
        }
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

    /// The coefficient of σᵏ in q_e, from the products of coefficients `from` and above with one another,
    /// that are in units of 2^−`bits`.
    fn products(&self, e: usize, k: usize, from: usize, bits: i32) -> Interval {
        let last = self.forms.len().min(k + 1 - from);
        let mut sum = 0i128;
        for product in &self.eq.products[e] {
            let (left, right) = (product.left, product.right);
            let term = |a: usize| {
                let (x, y) = (self.forms[a][left], self.forms[k - a][right]);
                i128::from(x) * i128::from(y)
            };
            let first = from.max((k + 1).saturating_sub(self.forms.len()));
            let sums = (first..last).map(term).sum::<i128>();
            sum += i128::from(product.factor) * sums;
        }
        nearly(sum, bits + 1)
    }

    /// The coefficient of σᵏ in F(ẑ(σ)).
    pub fn residual(&self, k: usize) -> Vec<Interval> {
        let [coarse, fine] = self.bits;
        let residual = |e: usize| {
            let l = &self.half_squares[e];
            if k == 0 {
                return self.products(e, 0, 0, 2 * coarse) - l[0];
            }
            let mut f = self.products(e, k, 1, 2 * fine);
            if let Some(forms) = self.forms.get(k) {
                let terms = self.eq.products[e].iter().map(|p| {
                    let term = |a: i64, b: i64| i128::from(a) * i128::from(b);
                    let both = term(self.forms[0][p.left], forms[p.right])
                        + term(forms[p.left], self.forms[0][p.right]);
                    i128::from(p.factor) * both
                });
                f += nearly(terms.sum(), coarse + fine + 1);
            }
            let powers = (1..=self.eq.homotopy.lengths[e].degree).map(|j| (j, self.powers[j][k]));
            let powers = powers.filter(|&(_, power)| power != ZERO);
            powers.fold(f, |sum, (j, power)| sum - l[j] * power)
        };
        // Beyond 2 ORDER there are only powers of t, in equations of higher degree.
        let zero = |e: usize| k > 2 * ORDER && self.eq.homotopy.lengths[e].degree == 2;
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
        let terms = (2..=self.eq.homotopy.lengths[e].degree)
            .map(|j| point(j as f64) * l[j] * self.powers[j - 1][k]);
        terms.fold(ZERO, |sum, x| sum + x)
    }

    /// Powers of two near the largest entries of the rows of [J(z₀); c] U. Any would do.
    pub fn section(&self, c: &[f64], u: &[u16]) -> Section {
        let row = |e: usize| {
            let terms = self.eq.gradient[e].iter().filter(|t| t.unknown < c.len());
            let largest = terms.fold(0.0f64, |max, t| {
                let size = (t.factor * self.forms[0][t.form]).unsigned_abs() as f64;
                max.max(size * f64::from(u[t.unknown]))
            });
            let largest = largest * power(-self.bits[0] - WEIGHT_BITS - 1);
            magnitude(&[largest, (self.slope(e, 0) * weight(u[self.eq.m])).mag()])
        };
        let normal: Vec<f64> = c
            .iter()
            .zip(u)
            .map(|(c, &u)| c * WEIGHT_UNIT * f64::from(u))
            .collect();
        Section {
            c: c.to_vec(),
            u: u.to_vec(),
            scale: (0..self.eq.m)
                .map(row)
                .chain([magnitude(&normal)])
                .collect(),
        }
    }

    /// The coefficient of σᵏ in J(ẑ(σ)) U, its rows scaled, in units of 2⁻⁴⁴, rounded. Adds bounds on
    /// what every row of it lost to `rests`.
    fn jacobian(&self, k: usize, at: &Section, rests: &mut [Interval]) -> Result<Columns, Fault> {
        let m = self.eq.m;
        let mut columns: Columns = vec![Vec::new(); m + 1];
        for e in 0..m {
            let bits = self.bits(k) + 1 + WEIGHT_BITS + at.scale[e];
            for term in self.eq.gradient[e].iter().filter(|t| t.unknown <= m) {
                let entry = i128::from(term.factor * self.forms[k][term.form])
                    * i128::from(at.u[term.unknown]);
                let entry = in_units(entry, bits - J_BITS).ok_or(LARGE)?;
                columns[term.unknown].push((e, entry));
            }
            let slope = self.slope(e, k) * -weight(at.u[m]) * point(power(-at.scale[e]));
            let (entry, rest) = split(slope).ok_or(LARGE)?;
            columns[m].push((e, entry));
            // Half a unit for each of the others.
            let terms = self.eq.gradient[e].len() as f64;
            rests[e] += rest + point(terms * power(-J_BITS - 1));
        }
        Ok(columns)
    }

    /// [J(z₀); c] U, scaled and rounded in the same way.
    pub fn bordered(&self, at: &Section, rests: &mut [Interval]) -> Result<Columns, Fault> {
        let mut columns = self.jacobian(0, at, rests)?;
        let m = self.eq.m;
        for ((column, &c), &u) in columns.iter_mut().zip(&at.c).zip(&at.u) {
            // Normals have 24 bits and weights 16: all is exact up to the rounding to a whole number.
            let units = power(J_BITS - WEIGHT_BITS - at.scale[m]);
            let entry = (c * f64::from(u) * units).round();
            if !(entry.abs() < LIMIT) {
                return Err(LARGE);
            }
            column.push((m, entry as i64));
            rests[m] += point(power(-J_BITS));
        }
        Ok(columns)
    }

    /// The test on the boxes |w|_u ≤ r around ẑ(σ), in the cross-sections c·w = 0. `y`, near the
    /// inverse of [J(z₀); c] U with scaled rows, is any matrix.
    pub fn test(&self, y: &Whole, at: &Section, r: Interval) -> Result<Test, Fault> {
        let (m, n, u) = (self.eq.m, self.eq.m + 1, &at.u);
        let order = self.z.len() - 1;
        let mut rests = vec![ZERO; n];
        let mut stiff = y.defect(&self.bordered(at, &mut rests)?);
        let (mut moving, mut square) = (point(1.0), ZERO);
        if order > 0 {
            let [j1, j2] = [1, 2].map(|k| self.jacobian(k, at, &mut rests));
            let a = y.moving(&j1?, &j2?).ok_or(LARGE)?;
            stiff += a.rest;
            moving += a.norm;
            square = a.square + a.norm * a.second;
        }
        let t = polynomial(&self.z, m, around(point(1.0))) + around(r * weight(u[m]));
        let (mut wide, mut turn) = (vec![ZERO; n], vec![ZERO; n]);
        let t_slope = (1..=order).fold(ZERO, |sum, k| sum + point(k as f64) * size(self.z[k][m]));
        let weight_of = |i: usize| u.get(i).map_or(0, |&u| u128::from(u));
        let width = |form: usize| self.eq.forms[form].map(weight_of).iter().sum::<u128>();
        for e in 0..m {
            let (mut square, mut beyond, mut slope) = (0u128, 0u128, 0u128);
            for term in self.eq.gradient[e].iter() {
                let by = u128::from(term.factor.unsigned_abs()) * weight_of(term.unknown);
                square += by * width(term.form);
                let forms = self.forms.iter().skip(3);
                beyond += forms
                    .map(|f| u128::from(f[term.form].unsigned_abs()) * by)
                    .sum::<u128>();
            }
            for product in &self.eq.products[e] {
                for (k, forms) in self.forms.iter().enumerate().skip(1) {
                    let size = |form: usize| u128::from(forms[form].unsigned_abs());
                    let change = size(product.left) * width(product.right)
                        + size(product.right) * width(product.left);
                    slope += k as u128 * u128::from(product.factor.unsigned_abs()) * change;
                }
            }
            let degree = self.eq.homotopy.lengths[e].degree;
            let slopes = (3..=(degree - 1) * order).map(|k| size(self.slope(e, k)));
            let slopes = slopes.fold(ZERO, |sum, x| sum + x) * weight(u[m]);
            let bend = size(self.eq.bend(e, t)) * weight(u[m]);
            let (fine, scale) = (self.bits[1] + WEIGHT_BITS + 1, point(power(-at.scale[e])));
            rests[e] += scale * (above(beyond, fine) + slopes);
            wide[e] = scale * (above(square, 2 * WEIGHT_BITS + 1) + bend * weight(u[m]));
            turn[e] = scale * (above(slope, fine) + bend * t_slope);
        }

        // The first coefficients of F(ẑ(σ)) are as good as zero: their sizes will do.
        let mut small = vec![ZERO; n];
        let (mut defect, mut defect_slope) = (ZERO, ZERO);
        for k in 0..=if order > 0 { DEGREE } else { 0 } {
            let f = scaled(self.residual(k), ZERO, at);
            if (1..=ORDER).contains(&k) || k > 2 * ORDER {
                small.iter_mut().zip(f).for_each(|(sum, f)| *sum += size(f));
            } else {
                let image = upper(y.image(&f));
                defect += image;
                defect_slope += point(k as f64) * image;
            }
        }
        let bound = |v: &[Interval]| {
            let sizes: Vec<Interval> = v.iter().map(|&x| around(x)).collect();
            upper(y.image(&sizes))
        };
        let small = bound(&small);
        Ok(Test {
            stiff: upper(moving * (stiff + bound(&rests)) + square),
            width: upper(moving * bound(&wide)),
            defect: upper(moving * (defect + small)),
            defect_slope: upper(moving * (defect_slope + point(DEGREE as f64) * small)),
            turn: upper(moving * bound(&turn)),
            moving: upper(moving),
        })
    }
}

/// Values of the equations, and of c·z, scaled as the rows of [J; c] U are.
pub fn scaled(f: Vec<Interval>, along: Interval, at: &Section) -> Vec<Interval> {
    let all = f.into_iter().chain([along]).zip(&at.scale);
    all.map(|(f, &scale)| f * point(power(-scale))).collect()
}

/// What is known of a family of cross-sections: on |w|_u ≤ ρ, for ρ up to the r that it was made
/// for, |I − Ỹ DG| ≤ `stiff` + `width` ρ; |Ỹ F(ẑ)| ≤ `defect`, its derivative by σ without that of Ỹ
/// `defect_slope`, |Ỹ (J(ẑ + w) − J(ẑ)) ẑ'| ≤ `turn` ρ, and |Ỹ v| ≤ `moving` |Y v|.
pub struct Test {
    pub stiff: Interval,
    pub width: Interval,
    pub defect: Interval,
    defect_slope: Interval,
    turn: Interval,
    moving: Interval,
}

/// That every cross-section has exactly one zero φ(σ) in its box.
pub struct Proof {
    /// |I − Ỹ DG| in the box.
    pub q: Interval,
    /// It is at most so far from ẑ(σ).
    pub distance: Interval,
    /// And φ'(σ) from ẑ'(σ).
    pub slope_distance: Interval,
    /// 1 − q − η/r.
    pub margin: f64,
    moving: Interval,
}

impl Test {
    /// |I − Ỹ DG| on |w|_u ≤ r.
    pub fn contraction(&self, r: Interval) -> Interval {
        upper(self.stiff + self.width * r)
    }

    /// Whether every cross-section has exactly one zero within r.
    pub fn within(&self, r: Interval) -> Result<Proof, Fault> {
        let one = point(1.0);
        let q = self.contraction(r);
        let margin = (one - q - self.defect / r).inf();
        if !(q.sup() < 1.0 && margin > 0.0) {
            return Err(Fault {
                margin: Some(margin),
                ..Fault::because("the Krawczyk test fails")
            });
        }
        // |w| ≤ η/(1 − q) first, and then q for boxes of that size.
        let near = upper(self.defect / (one - q));
        let nearer = self.contraction(near);
        let distance = upper(self.defect / (one - nearer));
        let slope_distance = upper((self.defect_slope + self.turn * distance) / (one - nearer));
        Ok(Proof {
            q,
            distance,
            slope_distance,
            margin,
            moving: self.moving,
        })
    }
}

impl Proof {
    /// |w|_u at most, for DG(w') U w = x with a w' in the box: as |I − Ỹ DG U| ≤ q that is |Ỹ x| / (1 − q).
    pub fn solved(&self, y: &Whole, x: &[Interval]) -> Interval {
        upper(self.moving * upper(y.image(x)) / (point(1.0) - self.q))
    }
}

/// An exponent e with 2ᵉ ≥ |x| for all of these, within bounds.
fn magnitude(v: &[f64]) -> i32 {
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

/// x 2^−shift, rounded to a whole number. `None`: too large.
fn in_units(x: i128, shift: i32) -> Option<i64> {
    let entry = match shift {
        120.. => 0,
        1..120 => (x + (1 << (shift - 1))) >> shift,
        _ => x.checked_mul(1i128.checked_shl(shift.unsigned_abs()).filter(|&y| y > 0)?)?,
    };
    (entry.unsigned_abs() < LIMIT as u128).then_some(entry as i64)
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
