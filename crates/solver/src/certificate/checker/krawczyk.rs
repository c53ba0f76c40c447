//! The one test that proves everything: Krawczyk's, with a preconditioner that moves along a
//! polynomial. The mathematics and its notation are in `docs/how/tubes.md`.

use super::equations::{Equations, ZERO};
use super::extended::{Low, rounded_time};
use super::guess::Inverse;
use super::matrix::{Columns, Matrix, between, enclosed, exact, halves, lost, power};
use super::structure::image_of_product;
use crate::certificate::format::WEIGHT_UNIT;
use crate::certificate::verdict::Fault;
use crate::interval::rounding::{UNDERFLOW, gamma, round_up};
use crate::interval::{Interval, point};

/// The degree of ẑ.
pub const ORDER: usize = 5;
/// The largest power of σ in F(ẑ(σ)), in which t occurs to the fourth.
const DEGREE: usize = 4 * ORDER;
/// No coefficient of τ⁴, where τ = Σ t_k σᵏ, or of the sizes went through more roundings: three times a product and ORDER + 1 sums.
const POWER_ROUNDINGS: usize = 3 * (ORDER + 2);
/// Entries of ẑ's coefficients are smaller: then what underflow takes from powers of τ, 2⁻¹⁰⁷² from the second, is at most
/// 2⁻⁹⁸⁴ of the fourth, far less than γ UNDERFLOW.
const LIMIT: f64 = (1u64 << 41) as f64;

/// From so many unknowns on no product of two dense matrices is made.
pub const MANY: usize = 96;

pub const LARGE: Fault = Fault::because("its numbers are too large or too far apart for the test");

/// Cross-sections c·z = const with the norm's weights u in them, and [J; c] U at a curve's z₀, rounded.
pub struct Section {
    pub c: Vec<f64>,
    pub u: Vec<f64>,
    pub j0: Columns,
    /// What every row may have lost, and what products with it may lose.
    rests: Vec<f64>,
}

/// A polynomial ẑ(σ) = Σ z_k σᵏ, |σ| ≤ 1. The coordinates of z₀ are multiples of a power of two: their differences, and the
/// products of these, are exact.
pub struct Curve<'a> {
    pub eq: &'a Equations,
    /// The units of z₀ are 2 to minus this.
    pub bits: i32,
    /// Its coefficients.
    pub z: Vec<Vec<f64>>,
    /// What z₀ is more than its floats.
    pub low: Option<Low>,
    /// All forms at z₀, in its units.
    whole: Vec<i64>,
    /// For each form its coefficients, those of σ and its powers rounded once.
    pub forms: Vec<[f64; ORDER + 1]>,
    /// E_e(t₀), and the coefficients of τ in E_e(t₀ + τ) with what they may be off by.
    right: Vec<(Interval, [[f64; 2]; 5])>,
    /// Where τ = Σ t_k σᵏ, k ≥ 1: the coefficients of τʲ, rounded; and those where all t_k are replaced with their sizes.
    powers: [[[f64; 2]; DEGREE + 1]; 5],
}

impl<'a> Curve<'a> {
    /// The constant polynomial that is nearest to a point.
    pub fn at(eq: &'a Equations, centre: &[f64]) -> Result<Self, Fault> {
        let m = eq.m;
        // The number 1 is a multiple of the unit, too.
        let bits = 51 - magnitude(&centre[..m]).max(0);
        let whole: Vec<f64> = centre[..m]
            .iter()
            .map(|x| (x * power(bits)).round())
            .collect();
        // Then differences have 53 bits, and the sums of products 121.
        if !(bits >= 0 && whole.iter().all(|x| x.abs() < power(52)) && centre[m].abs() < LIMIT) {
            return Err(LARGE);
        }
        let differences = eq.differences(&whole, [0.0, power(bits)]);
        let form = |x: &f64| std::array::from_fn(|k| if k == 0 { x * power(-bits) } else { 0.0 });
        let z = whole.iter().map(|x| x * power(-bits)).chain([centre[m]]);
        let mut powers = [[[0.0; 2]; DEGREE + 1]; 5];
        powers[0][0] = [1.0; 2];
        let mut curve = Curve {
            eq,
            bits,
            z: vec![z.collect()],
            low: None,
            whole: differences.iter().map(|&x| x as i64).collect(),
            forms: differences.iter().map(form).collect(),
            right: Vec::new(),
            powers,
        };
        curve.expand_right();
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
        curve.low = Some(Low::near(eq, curve.z[0][eq.m], curve.bits, &rest)?);
        curve.expand_right();
        Ok(curve)
    }

    /// Takes the coefficients of all E_e around t₀.
    fn expand_right(&mut self) {
        let t = point(self.z[0][self.eq.m]) + self.low_of(self.eq.m);
        let rights = (0..self.eq.m).map(|e| self.eq.right_at(e, t));
        let rights = rights.map(|c| (c[0], c.map(|c| halves(c).into())));
        self.right = rights.collect();
    }

    /// An entry of what z₀ is more than its floats.
    pub fn low_of(&self, i: usize) -> Interval {
        self.low.as_ref().map_or(ZERO, |low| point(low.floats[i]))
    }

    /// What a form at z₀ is more than its float.
    fn low_form(&self, form: usize) -> f64 {
        self.low.as_ref().map_or(0.0, |low| low.differences[form])
    }

    /// Adds the next coefficient.
    pub fn push(&mut self, z: Vec<f64>) -> Result<(), Fault> {
        let (k, m) = (self.z.len(), self.eq.m);
        if !z.iter().all(|x| x.abs() < LIMIT) {
            return Err(LARGE);
        }
        let differences = self.eq.differences(&z[..m], [0.0; 2]);
        for (form, x) in self.forms.iter_mut().zip(differences) {
            form[k] = x;
        }
        self.powers[1][k] = [z[m], z[m].abs()];
        self.z.push(z);
        // What is known now of the powers of τ: all of them once ẑ is complete.
        for k in k + 1..=if k == ORDER { DEGREE } else { k + 1 } {
            for j in 2..5 {
                self.powers[j][k] = [0, 1].map(|of| {
                    let factors = 1..k.min(ORDER + 1);
                    let product = |a: usize| self.powers[1][a][of] * self.powers[j - 1][k - a][of];
                    factors.map(product).sum::<f64>() + [0.0, UNDERFLOW][of]
                });
            }
        }
        Ok(())
    }

    /// F at z₀: the sums of products are exact.
    pub fn value(&self) -> Vec<Interval> {
        let value = |e: usize| {
            if let Some(low) = &self.low {
                return low.value(self.eq, e, self.bits, &self.whole);
            }
            let product = |&(factor, [left, right]): &(i64, [usize; 2])| {
                i128::from(factor) * (i128::from(self.whole[left]) * i128::from(self.whole[right]))
            };
            let sum = self.eq.products[e].iter().map(product).sum();
            nearly(sum, 2 * self.bits + 1) - self.right[e].0
        };
        (0..self.eq.m).map(value).collect()
    }

    /// The coefficient of σᵏ in F(ẑ(σ)), k ≥ 1.
    pub fn residual(&self, k: usize) -> Vec<Interval> {
        let orders = k.saturating_sub(ORDER)..=k.min(ORDER);
        let residual = |e: usize| {
            let (mut sum, mut sizes) = (0.0, 0.0);
            for &(factor, [left, right]) in &self.eq.products[e] {
                let (x, y, half) = (&self.forms[left], &self.forms[right], 0.5 * factor as f64);
                let (mut product, mut size) = (0.0, 0.0);
                for a in orders.clone() {
                    product += x[a] * y[k - a];
                    size += (x[a] * y[k - a]).abs();
                }
                if self.low.is_some() && k <= ORDER {
                    let [x, y] = [self.low_form(left) * y[k], x[k] * self.low_form(right)];
                    product += x + y;
                    size += x.abs() + y.abs();
                }
                sum += half * product;
                sizes += half.abs() * size;
            }
            let (right, error) = self.right(e, k, 0);
            // Two forms, their product and that with a factor, three sums with what z₀ is more, and E.
            let roundings = orders.clone().count() + self.eq.products[e].len() + 8;
            enclosed(sum - right, lost(sizes + right.abs(), roundings, error))
        };
        // Beyond 2 ORDER there are only powers of t, in equations of higher degree.
        let zero = |e: usize| k > 2 * ORDER && self.eq.degree(e) <= 2;
        (0..self.eq.m)
            .map(|e| if zero(e) { ZERO } else { residual(e) })
            .collect()
    }

    /// The coefficient of σᵏ in E_e(t), without E_e(t₀), or where `derivative` is 1 in E_e'(t); and what that may be off
    /// by.
    fn right(&self, e: usize, k: usize, derivative: usize) -> (f64, f64) {
        let (mut sum, mut sizes, mut errors) = (0.0, 0.0, 0.0);
        for j in 1..=self.eq.degree(e) {
            let ([middle, radius], [power, most]) =
                (self.right[e].1[j], self.powers[j - derivative][k]);
            let times = if derivative == 1 { j as f64 } else { 1.0 };
            sum += times * middle * power;
            sizes += times * middle.abs() * most;
            errors += times * radius * most;
        }
        // With j, with the coefficient, and four sums.
        let roundings = POWER_ROUNDINGS + 6;
        (sum, lost(sizes, roundings, errors))
    }

    /// The coefficient of σᵏ in J(ẑ(σ)) U. Adds bounds on what every row of it lost, and on what its products with Y
    /// may lose, to `rests`.
    fn jacobian(&self, k: usize, u: &[f64], rests: &mut [f64]) -> Columns {
        let (m, mut sizes) = (self.eq.m, vec![0.0; self.eq.m]);
        let mut columns: Columns = vec![Vec::with_capacity(self.eq.longest + 1); m + 1];
        columns[m].reserve(m);
        for e in 0..m {
            for &(i, factor, form) in &self.eq.gradient[e] {
                // Weights have 16 bits and factors 12: this product is exact.
                let by = 0.5 * factor as f64 * u[i];
                let entry = by * self.forms[form][k];
                columns[i].push((e, entry));
                sizes[e] += entry.abs();
                if k == 0 {
                    rests[e] += (by * self.low_form(form)).abs();
                }
            }
            let (slope, error) = self.right(e, k, 1);
            columns[m].push((e, -slope * u[m]));
            sizes[e] += (slope * u[m]).abs();
            rests[e] += error * u[m];
        }
        // A form, its product with weight and factor, that with an entry of Y; and the sums.
        let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
        for (rest, size) in rests.iter_mut().zip(sizes) {
            *rest = round_up(*rest + gamma(longest + 4) * size, self.eq.longest + 5);
        }
        columns
    }

    /// [J(z₀); c] U.
    pub fn section(&self, c: &[f64], u: &[f64]) -> Section {
        let m = self.eq.m;
        let mut rests = vec![0.0; m + 1];
        let mut j0 = self.jacobian(0, u, &mut rests);
        for ((column, &c), &u) in j0.iter_mut().zip(c).zip(u) {
            // Normals have 24 bits and weights 16: this is exact.
            column.push((m, c * u));
            rests[m] += (c * u).abs();
        }
        let longest = j0.iter().map(Vec::len).max().unwrap_or(0);
        rests[m] = round_up(gamma(longest + 4) * rests[m], m + 2);
        Section {
            c: c.to_vec(),
            u: u.to_vec(),
            j0,
            rests,
        }
    }

    /// The test on the boxes |w|_u ≤ r around ẑ(σ), in the cross-sections c·w = 0. `inverse` has a Y near the
    /// inverse of [J(z₀); c] U, any matrix, and guesses what M⁻¹ times others is.
    pub fn test(&self, inverse: &Inverse, at: &Section, r: Interval) -> Test {
        let (m, n, order, u) = (self.eq.m, self.eq.m + 1, self.z.len() - 1, &at.u);
        let y = &inverse.y;
        assert!([0, ORDER].contains(&order) && u.len() == n);
        assert!(y.n == n && y.entries.len() == n * n);
        let mut rests = at.rests.clone();
        let stiff = y.norm_of_product(&at.j0, 1.0);
        let (mut moving, mut square, mut a) = (point(1.0), ZERO, None);
        if order > 0 {
            let [j1, j2] = [1, 2].map(|k| self.jacobian(k, u, &mut rests));
            let moved = y.times(&j1);
            // What Y J₀, Y J₁ and Y J₂ may have lost, and more.
            let (norm, lost) = (moved.norm(), y.bound(&rests));
            moving += norm;
            let (away, second) = match n < MANY {
                true => {
                    let second = y.times(&j2);
                    (moved.square_distance(&second), second.norm())
                }
                false => {
                    let all = [&j1, &j2, &at.j0];
                    let image = |b: &Matrix| inverse.solve(b);
                    let away = image_of_product((y, stiff + lost), all, &moved, image);
                    (away + lost * moving, y.norm_of_product(&j2, 0.0))
                }
            };
            square = away + norm * second;
            a = Some(moved);
        }
        let t = way(&self.z, m, around(point(1.0))) + around(r * point(u[m]));
        let t = t + point(self.z[0][m]) + self.low_of(m);
        let slopes = (1..=order).map(|k| k as f64 * self.z[k][m].abs());
        let t_slope = round_up(slopes.sum(), ORDER + 1);
        // Of each form: how much it changes with w, what is left from order 3 on, and of its derivative by σ.
        let weight_of = |i: usize| if i < m { u[i] } else { 0.0 };
        let change = |([i, j], x): (&[usize; 2], &[f64; ORDER + 1])| {
            let slopes = x.iter().enumerate().map(|(k, x)| k as f64 * x.abs());
            let beyond = x[3..].iter().map(|x| x.abs());
            [weight_of(*i) + weight_of(*j), beyond.sum(), slopes.sum()]
        };
        let changes: Vec<[f64; 3]> = self.eq.forms.iter().zip(&self.forms).map(change).collect();
        let (mut wide, mut turn) = (vec![0.0; n], vec![0.0; n]);
        for e in 0..m {
            let mut all = [0.0; 3];
            for &(i, factor, form) in &self.eq.gradient[e] {
                let by = 0.5 * factor.abs() as f64 * u[i];
                let terms = all.iter_mut().zip(changes[form]);
                terms.for_each(|(all, x)| *all += by * x);
            }
            // Also a rounding of each of the forms.
            let [square, beyond, slope] = all.map(|x| round_up(x, self.eq.longest + ORDER + 5));
            let slopes = 3..=(self.eq.degree(e).max(2) - 1) * order;
            let slopes = slopes.map(|k| self.right(e, k, 1));
            let slopes: f64 = slopes.map(|(slope, error)| slope.abs() + error).sum();
            let slopes = round_up(slopes * u[m], DEGREE);
            let bend = self.eq.bend(e, t).mag() * u[m];
            rests[e] = round_up(rests[e] + beyond + slopes, 2);
            wide[e] = round_up(square + bend * u[m], 3);
            turn[e] = round_up(slope + bend * t_slope, 3);
        }

        let (mut defect, mut defect_slope) = (ZERO, ZERO);
        for k in 1..=if order > 0 { DEGREE } else { 0 } {
            let f = self.residual(k);
            // The first coefficients of F(ẑ(σ)), and those of t alone, are as good as zero: of them their sizes will do.
            let image = match k {
                _ if f.iter().all(|&f| f == ZERO) => continue,
                _ if k > ORDER && k <= 2 * ORDER => y.image(&f),
                _ => y.bound(&f.iter().map(|f| f.mag()).collect::<Vec<f64>>()),
            };
            (defect, defect_slope) = (defect + image, defect_slope + point(k as f64) * image);
        }
        Test {
            stiff: upper(moving * (stiff + y.bound(&rests)) + square),
            width: upper(moving * y.bound(&wide)),
            constant: upper(moving * upper(y.image(&self.value()))),
            growing: upper(moving * defect),
            defect_slope: upper(moving * defect_slope),
            turn: upper(moving * y.bound(&turn)),
            moving: upper(moving),
            a,
        }
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
    /// The A in Ỹ(σ) = (I − σA) Y.
    pub a: Option<Matrix>,
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

/// Weights, exactly.
pub fn weights(u: &[u16]) -> Vec<f64> {
    u.iter().map(|&u| WEIGHT_UNIT * f64::from(u)).collect()
}

/// Σ z_k σᵏ, k ≥ 1, one of its entries.
pub fn way(z: &[Vec<f64>], i: usize, s: Interval) -> Interval {
    range(s, |k| if k > 0 && k < z.len() { z[k][i] } else { 0.0 })
}

/// Σ k z_k σᵏ⁻¹, k ≥ 1, the derivative of that: one of its entries.
pub fn derivative(z: &[Vec<f64>], i: usize, s: Interval) -> Interval {
    range(s, |k| z.get(k + 1).map_or(0.0, |z| (k + 1) as f64 * z[i]))
}

/// Σ c_k σᵏ, k ≤ ORDER, on a range of σ: Taylor's expansion about its middle. The coefficients may have gone through a rounding.
fn range(s: Interval, coefficient: impl Fn(usize) -> f64) -> Interval {
    let (middle, radius) = halves(s);
    let mut c: [f64; ORDER + 1] = std::array::from_fn(coefficient);
    let reach = middle.abs() + radius;
    let sizes = c.iter().rev().fold(0.0, |sum, c| sum * reach + c.abs());
    for from in 0..ORDER {
        for k in (from..ORDER).rev() {
            c[k] += middle * c[k + 1];
        }
    }
    let away = c[1..]
        .iter()
        .rev()
        .fold(0.0, |sum, c| (sum + c.abs()) * radius);
    // A term of an expanded coefficient went through at most ORDER sums where it stands, and a product and a sum on each of ORDER
    // ways down; all of them together are at most `sizes`, a sum of products of as many factors.
    enclosed(c[0], lost(sizes, 4 * ORDER + 1, round_up(away, 2 * ORDER)))
}

/// [−x, x] for the upper end of a non-negative x.
pub fn around(x: Interval) -> Interval {
    between(-x.sup(), x.sup())
}

/// The upper end.
pub fn upper(x: Interval) -> Interval {
    exact(x.sup())
}

#[cfg(test)]
mod tests {
    use super::super::guess::Inverse;
    use super::*;
    use crate::problem::Problem;
    use crate::rational::{Rational, exact as ratio};
    use crate::system::Homotopy;
    use proptest::prelude::*;

    /// A triangle with E_e(t) that floats are: with a bend, of degree 4.
    fn triangle(c: &str) -> Equations {
        let problem = Problem::build("triangle", 2)
            .point("a", ["0", "0"])
            .point("b", ["3", "0"])
            .point("c", ["0", "4"])
            .distance("a", "b", "4")
            .distance("b", "c", "4.5")
            .distance("c", "a", "3.25")
            .bend(["b", "c"])
            .bend_coefficient(c)
            .finish()
            .unwrap();
        let eq = equations(&problem);
        assert!(is_exact(&eq));
        eq
    }

    /// Equations with the number 1 in them, products of two different forms, and a coordinate in no product with another.
    fn right_angle() -> Equations {
        let text = "dimension = 2\n[points]\na = [0, 0]\nb = [3, 0]\nc = [1, 4]\n[constraints]\nfixed = [\"a\"]\n\
                    x = [[\"b\", 3]]\ndy = [[\"a\", \"c\", 4]]\ndistances = [[\"a\", \"b\", 3.5]]\n\
                    perpendicular = [[\"a\", \"b\", \"a\", \"c\"]]\n";
        let eq = equations(&Problem::parse(text, "test.toml").unwrap());
        assert!(eq.forms.iter().any(|form| form[0] == eq.m + 2));
        let is_mixed = |p: &(i64, [usize; 2])| eq.forms[p.1[0]] != eq.forms[p.1[1]];
        assert!(
            eq.products
                .iter()
                .flatten()
                .any(|p| is_mixed(p) && eq.forms[p.1[1]][0] < eq.m)
        );
        eq
    }

    fn equations(problem: &Problem) -> Equations {
        Equations::new(Homotopy::with_unit(problem, 1.0).unwrap())
    }

    /// Whether floats hold all coefficients of E_e(t). Otherwise middles of their enclosures are taken, for which all must be
    /// so too.
    fn is_exact(eq: &Equations) -> bool {
        let mut rights = eq.homotopy.rights.iter().flat_map(|r| r.enclosures());
        rights.all(|e| e.wid() == 0.0)
    }

    type Polynomial = Vec<Rational>;

    fn zero() -> Rational {
        Rational::zero()
    }

    fn times(a: &Polynomial, b: &Polynomial) -> Polynomial {
        let mut out = vec![zero(); a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                out[i + j] += x * y;
            }
        }
        out
    }

    fn plus(a: &Polynomial, b: &Polynomial, factor: f64) -> Polynomial {
        let of = |p: &Polynomial, k: usize| p.get(k).cloned().unwrap_or_else(zero);
        (0..a.len().max(b.len()))
            .map(|k| of(a, k) + of(b, k) * ratio(factor))
            .collect()
    }

    fn value(p: &Polynomial, s: &Rational) -> Rational {
        p.iter().rev().fold(zero(), |sum, x| sum * s + x)
    }

    /// F along z(σ) as polynomials, and the rows of its derivative there.
    fn exactly(eq: &Equations, z: &[Polynomial]) -> Vec<(Polynomial, Vec<Polynomial>)> {
        let of = |i: usize| match i {
            i if i < eq.m => z[i].clone(),
            i => vec![ratio(if i == eq.m + 2 { 1.0 } else { 0.0 })],
        };
        let forms: Vec<Polynomial> = eq
            .forms
            .iter()
            .map(|&[i, j]| plus(&of(i), &of(j), -1.0))
            .collect();
        let row = |e: usize| {
            let mut f = vec![zero()];
            for &(factor, [l, r]) in &eq.products[e] {
                f = plus(&f, &times(&forms[l], &forms[r]), 0.5 * factor as f64);
            }
            let mut j = vec![vec![zero()]; eq.m + 1];
            for &(i, factor, form) in &eq.gradient[e] {
                j[i] = plus(&j[i], &forms[form], 0.5 * factor as f64);
            }
            let mut power = vec![ratio(1.0)];
            for (k, c) in eq.homotopy.rights[e].enclosures().iter().enumerate() {
                f = plus(&f, &power, -c.mid());
                if let Some(next) = eq.homotopy.rights[e].enclosures().get(k + 1) {
                    j[eq.m] = plus(&j[eq.m], &power, -next.mid() * (k + 1) as f64);
                }
                power = times(&power, &z[eq.m]);
            }
            (f, j)
        };
        (0..eq.m).map(row).collect()
    }

    /// Beyond 2⁵¹ the number 1 would be no multiple of the unit that coordinates are rounded to.
    #[test]
    fn the_number_1_is_itself_beside_large_coordinates() {
        let problem = Problem::parse(
            "dimension = 2\n[points]\na = [0, 0]\nb = [3, 4]\n[constraints]\nfixed = [\"a\"]\nx = [[\"b\", 3]]\n\
             distances = [[\"a\", \"b\", 5]]\n",
            "test.toml",
        );
        let eq = Equations::new(Homotopy::with_unit(&problem.unwrap(), 1.0).unwrap());
        let one = eq
            .forms
            .iter()
            .position(|form| form[0] == eq.m + 2)
            .unwrap();
        let mut taken = 0;
        for exponent in 30..60 {
            for factor in [1.0, 1.5, 1.999] {
                let mut centre = vec![factor * power(exponent); eq.m];
                centre.push(0.0);
                if let Ok(curve) = Curve::at(&eq, &centre) {
                    assert_eq!(curve.whole[one] as f64 * power(-curve.bits), 1.0);
                    taken = exponent;
                }
            }
        }
        assert!((45..=51).contains(&taken), "{taken}");
    }

    fn numbers(n: usize) -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(-1.0f64..1.0, n)
    }

    /// No problem of these tests has more unknowns, t among them.
    const MOST: usize = 7;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(192))]
        /// Along any polynomial, with Y near the inverse or not: the coefficients of F, and all bounds of the test at some σ
        /// and some w, against rational numbers. Weights, steps and the size of the figure take extreme values.
        #[test]
        fn what_the_test_claims_is_so(
            (which, size, step) in (0..3usize, -30i32..30, -60i32..4),
            (z0, ahead) in (numbers(MOST), prop::collection::vec(numbers(MOST), ORDER)),
            (c, weights, off) in (numbers(MOST), prop::collection::vec(1u16.., MOST), numbers(MOST)),
            (noise, noisy, s, r) in (numbers(MOST * MOST), -50i32..2, -1.0f64..1.0, -40i32..2),
            (low, has_low) in (numbers(MOST), any::<bool>()),
        ) {
            let eq = [|| triangle("0"), || triangle("0.5"), right_angle][which]();
            let n = eq.m + 1;
            let [z0, c, off, low] = [z0, c, off, low].map(|v| v[..n].to_vec());
            let weights = &weights[..n];
            let ahead: Vec<Vec<f64>> = ahead.iter().map(|v| v[..n].to_vec()).collect();
            let scaled = |v: &[f64], e: i32| v.iter().map(|x| x * power(e)).collect::<Vec<f64>>();
            let mut centre = scaled(&z0, size);
            centre[eq.m] = z0[eq.m];
            // Coefficients with more digits are those of the problem, not of the enclosures' middles.
            let mut curve = match has_low && is_exact(&eq) {
                // What the middle is more than its floats.
                true => Curve::at_sum(&eq, &centre, &scaled(&low, size.max(0) - 56)).unwrap(),
                false => Curve::at(&eq, &centre).unwrap(),
            };
            let c: Vec<f64> = c.iter().map(|&c| f64::from(c as f32)).collect();
            let u = super::weights(weights);
            let at = curve.section(&c, &u);
            let Ok(mut inverse) = Inverse::new(&at) else {
                return Ok(());
            };
            for (y, x) in inverse.y.entries.iter_mut().zip(noise) {
                *y += *y * x * power(noisy);
            }
            for z in &ahead {
                curve.push(scaled(z, step)).unwrap();
            }
            let mut z: Vec<Polynomial> = (0..n).map(|i| curve.z.iter().map(|z| ratio(z[i])).collect()).collect();
            for (i, z) in z.iter_mut().enumerate() {
                z[0] += ratio(curve.low_of(i).inf());
            }
            let rows = exactly(&eq, &z);
            for k in 0..=DEGREE {
                let found = if k == 0 { curve.value() } else { curve.residual(k) };
                for (found, (f, _)) in found.iter().zip(&rows) {
                    let f = f.get(k).cloned().unwrap_or_else(zero);
                    prop_assert!(ratio(found.inf()) <= f && f <= ratio(found.sup()), "{k}: {found:?} {f}");
                }
            }

            let radius = point(power(r));
            let test = curve.test(&inverse, &at, radius);
            let a = test.a.as_ref().unwrap();
            let s = ratio(s);
            // Ỹ(σ), exactly.
            let entry = |m: &Matrix, i: usize, j: usize| ratio(m.entries[j * n + i]);
            let moved = |i: usize, e: usize| {
                let change = (0..n).fold(zero(), |sum, k| sum + entry(a, i, k) * entry(&inverse.y, k, e));
                entry(&inverse.y, i, e) - &s * change
            };
            let y: Vec<Vec<Rational>> = (0..n).map(|i| (0..n).map(|e| moved(i, e)).collect()).collect();
            let most = |v: &dyn Fn(usize) -> Rational| (0..n).map(|i| v(i).abs()).max().unwrap();
            let image = |f: &[Rational]| most(&|i| (0..f.len()).fold(zero(), |sum, e| sum + &y[i][e] * &f[e]));
            let f: Vec<Rational> = rows.iter().map(|(f, _)| value(f, &s)).collect();
            let growing = s.abs() * ratio(test.growing.sup());
            prop_assert!(image(&f) <= ratio(test.constant.sup()) + growing);
            let slopes = |f: &Polynomial| -> Polynomial { f.iter().enumerate().skip(1).map(|(k, x)| x * ratio(k as f64)).collect() };
            let f: Vec<Rational> = rows.iter().map(|(f, _)| value(&slopes(f), &s)).collect();
            prop_assert!(image(&f) <= ratio(test.defect_slope.sup()));

            // At ẑ(σ), and beside it.
            let way = |i: usize| value(&z[i], &s);
            for rho in [0.0, 0.3 * power(r), power(r)] {
                let place: Vec<Polynomial> = (0..n)
                    .map(|i| vec![way(i) + ratio(rho) * ratio(off[i]) * ratio(u[i])])
                    .collect();
                let mut all: Vec<Vec<Rational>> = exactly(&eq, &place)
                    .into_iter()
                    .map(|(_, j)| j.iter().map(|j| value(j, &s)).collect())
                    .collect();
                all.push(c.iter().map(|&c| ratio(c)).collect());
                let defect = |i: usize, k: usize| {
                    let sum = (0..n).fold(zero(), |sum, e| sum + &y[i][e] * &all[e][k] * ratio(u[k]));
                    ratio(f64::from(u8::from(i == k))) - sum
                };
                let norm = most(&|i| (0..n).fold(zero(), |sum, k| sum + defect(i, k).abs()));
                let q = test.contraction(exact(rho));
                prop_assert!(norm <= ratio(q.sup().min(f64::MAX)), "{rho:e}: {:e} {q:?}", norm.to_f64());

                let direction: Vec<Rational> = z.iter().map(|z| value(&slopes(z), &s)).collect();
                let turned: Vec<Rational> = (0..eq.m)
                    .map(|e| {
                        let there = |i: usize| &all[e][i] - value(&rows[e].1[i], &s);
                        (0..n).fold(zero(), |sum, i| sum + there(i) * &direction[i])
                    })
                    .collect();
                prop_assert!(image(&turned) <= ratio((test.turn * exact(rho)).sup()));
            }
        }
    }
}
