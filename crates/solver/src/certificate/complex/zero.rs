//! Quadratic equations in complex unknowns, and the proof that there is exactly one zero near a point.
//!
//! With c the point, J = F'(c), Y about J⁻¹, D = I − Y J and Q the quadratic part of F, let N(h) = h − Y F(c + h) =
//! −Y F(c) + D h − Y Q(h). Let r be a vector of radii, and for each unknown
//!
//! - η_k bound |Σ_e Y_ke F_e(c)|,
//! - λ_k(r) bound Σ_u |D_ku| r_u,
//! - κ_k(r) bound Σ_e |Y_ke| q_e(r), where q_e(r) is Q_e with the sizes of its factors, each difference being a sum.
//!
//! If η + λ(r) + κ(r) < r throughout, N maps the polydisc |h_k| ≤ r_k into itself, and has a fixed point there (Brouwer), within
//! η + λ(r) + κ(r). If λ(R) + 2 κ(R) < R throughout, there is at most one in the polydisc of R: with B the symmetric form of which Q is
//! the square, N(h) − N(g) = D (h − g) − Y B(h − g, h + g), which is smaller than h − g where |h − g| is largest beside R, as
//! |h + g| ≤ 2 R. The same inequality makes |I − Y F'(c + h)| < 1 in the norm max |h_k| / R_k, so that Y and
//! the Jacobian are regular: a fixed point of N is a zero of F, and the only one.
//!
//! F(c) is exact but for the right-hand sides: whole numbers of a small unit, with a bound on how far one that is no ratio may be
//! off. D is computed in double-doubles with the bound of [`gamma_double`], all else in floats that are rounded up. Y and c may be
//! anything.

use crate::elimination;
use crate::equations::Form;
use crate::interval::complex::{Complex, Number};
use crate::interval::rounding::{UNDERFLOW, in_range, round_up};
use crate::interval::{Ball, DoubleDouble, Interval, gamma_double, hull, point};
use crate::rational::Rational;
use crate::system::Term;
use num_bigint::BigInt;
use num_traits::{Float, Signed, ToPrimitive};

/// A complex number in double-doubles.
pub type Z = Complex<DoubleDouble>;

/// The unit of whole numbers is two to minus this.
const BITS: i32 = 256;
/// Parts of numbers below this are taken for zero, all others are multiples of the unit.
const TINY: f64 = 6.3e-61;
/// Numbers whose parts are greater are not served.
const HUGE: f64 = 1e30;
/// Corrections of the point by Newton's method.
const CORRECTIONS: usize = 3;
/// Radii are enlarged so often before they are given up.
const ENLARGEMENTS: usize = 8;
/// A zero may be so far from where it is claimed, beside the largest number that is claimed.
const NEAR: f64 = 1e-6;
/// A radius is at least this.
const LEAST_RADIUS: f64 = 1e-100;

/// Equations: half the sum of the terms is the number on the right.
#[derive(Debug)]
pub struct Quadratic {
    unknowns: usize,
    equations: Vec<Row>,
}

/// An equation.
#[derive(Debug)]
struct Row {
    terms: Vec<Term>,
    /// Twice the right-hand side in squared units, rounded down.
    right: BigInt,
    /// How far the exact one may be from that besides, in units.
    off: BigInt,
}

/// A zero that is proved to be there.
#[derive(Debug, Clone)]
pub struct Zero {
    centre: Vec<Z>,
    /// For each unknown how far the zero is from there at most.
    inner: Vec<f64>,
    /// There is no other one so near.
    outer: Vec<f64>,
}

/// |Re| + |Im|, which is not below the size, up to three roundings.
fn size(z: Z) -> f64 {
    z.re.size() + z.im.size()
}

/// The floats' exact sum, but for what is tiny.
fn cut(x: DoubleDouble) -> DoubleDouble {
    let cut = |x: f64| if x.abs() < TINY { 0.0 } else { x };
    DoubleDouble {
        hi: cut(x.hi),
        lo: cut(x.lo),
    }
}

/// A number that was [`cut`], in the unit, exactly.
fn whole(x: DoubleDouble) -> BigInt {
    let whole = |x: f64| {
        let (mantissa, exponent, sign) = Float::integer_decode(x);
        // From TINY on a float's last bit is worth 2⁻²⁵² or more.
        let shift = if x == 0.0 {
            0
        } else {
            BITS + i32::from(exponent)
        };
        let shift = u32::try_from(shift).expect("a number that was cut");
        BigInt::from(i128::from(mantissa) * i128::from(sign)) << shift
    };
    whole(x.hi) + whole(x.lo)
}

impl Quadratic {
    /// Of equations with these terms and right-hand sides.
    pub fn new(unknowns: usize, equations: Vec<(Vec<Term>, Rational)>) -> Self {
        let equations = equations.into_iter();
        let exact = equations.map(|(terms, right)| (terms, Ball::exactly(right)));
        Self::enclosing(unknowns, exact.collect())
    }

    /// The same with right-hand sides that are somewhere in these.
    pub fn enclosing(unknowns: usize, equations: Vec<(Vec<Term>, Ball)>) -> Self {
        let unit = Rational::from_integer(BigInt::from(2) << BITS as u32);
        let scale = Rational::from_integer(BigInt::from(2) << (2 * BITS as u32));
        let row = |(terms, right): (Vec<Term>, Ball)| Row {
            terms,
            right: (right.middle * &scale).floor().to_integer(),
            off: (right.radius * &unit).ceil().to_integer(),
        };
        Quadratic {
            unknowns,
            equations: equations.into_iter().map(row).collect(),
        }
    }

    /// F(c) for a point that was cut: about its value, and a bound on its size.
    fn residual(&self, c: &[Z]) -> Option<Vec<([f64; 2], f64)>> {
        let is_served = |x: &DoubleDouble| x.hi.abs() <= HUGE && x.lo.abs() <= HUGE;
        if !c.iter().all(|z| is_served(&z.re) && is_served(&z.im)) {
            return None;
        }
        let c: Vec<[BigInt; 2]> = c.iter().map(|z| [whole(z.re), whole(z.im)]).collect();
        let part = |entry: Option<usize>, axis: usize| match entry {
            Some(i) => c[i][axis].clone(),
            None => BigInt::ZERO,
        };
        let form = |form: Form<Option<usize>>| match form {
            Form::Difference(a, b) => [0, 1].map(|axis| part(a, axis) - part(b, axis)),
            Form::One => [BigInt::from(1) << BITS as u32, BigInt::ZERO],
        };
        let unit = 2.0.powi(-BITS);
        let of = |row: &Row| {
            let mut twice = [-&row.right, BigInt::ZERO];
            for term in &row.terms {
                let ([a, b], [c, d]) = (form(term.left), form(term.right));
                twice[0] += (&a * &c - &b * &d) * term.factor;
                twice[1] += (a * d + b * c) * term.factor;
            }
            // Rounded down, like the right-hand side before: off by two units at most.
            let about = twice.map(|part: BigInt| part >> BITS as u32);
            let float = |x: &BigInt| x.to_f64().unwrap_or(f64::INFINITY) * (0.5 * unit);
            // Conversions are off by less than the last factor.
            let bound = |x: &BigInt| float(&(x.abs() + 2 + &row.off)) * (1.0 + 1e-10);
            let size = round_up(bound(&about[0]) + bound(&about[1]), 3);
            ([float(&about[0]), float(&about[1])], size)
        };
        Some(self.equations.iter().map(of).collect())
    }

    /// The Jacobian's rows: unknown, value, and the sum of the sizes of the slopes that it is the sum of; with the greatest number of
    /// slopes in a row.
    fn jacobian(&self, c: &[Z]) -> (Vec<Vec<(usize, Z, f64)>>, usize) {
        let at = |entry: Option<usize>| entry.map(|i| c[i]).unwrap_or_default();
        let mut longest = 0;
        let rows = self.equations.iter().map(|Row { terms, .. }| {
            let mut row: Vec<(usize, Z, f64)> = Vec::new();
            let mut slopes = 0;
            for term in terms {
                let half = DoubleDouble::from(0.5 * f64::from(term.factor));
                for (entry, sign, other) in term.derivatives(at) {
                    let Some(unknown) = entry else { continue };
                    let slope = other.times(half);
                    let slope = if sign > 0 { slope } else { -slope };
                    slopes += 1;
                    match row.iter_mut().find(|entry| entry.0 == unknown) {
                        Some(entry) => {
                            entry.1 = entry.1 + slope;
                            entry.2 += size(slope);
                        }
                        None => row.push((unknown, slope, size(slope))),
                    }
                }
            }
            longest = longest.max(slopes);
            row
        });
        (rows.collect(), longest)
    }

    /// Bounds q_e(r) on the quadratic parts where the unknowns are off by these radii.
    fn curved(&self, r: &[f64]) -> Vec<f64> {
        let at = |(entry, _): (Option<usize>, i32)| entry.map_or(0.0, |i| r[i]);
        let form = |form: Form<Option<usize>>| form.entries().map(at).sum::<f64>();
        let of =
            |term: &Term| 0.5 * f64::from(term.factor).abs() * form(term.left) * form(term.right);
        let equations = self.equations.iter();
        equations
            .map(|row| row.terms.iter().map(of).sum())
            .collect()
    }

    /// Proves a zero near a point, with a box around it in which it is the only one; `None`: that could not be proved.
    pub fn prove(&self, near: &[Z]) -> Option<Zero> {
        let fits = near.len() == self.unknowns && self.equations.len() == self.unknowns;
        if !fits {
            return None;
        }
        self.prove_with::<f64>(near)
            .or_else(|| self.prove_with::<DoubleDouble>(near))
            .filter(|zero| zero.is_near(near))
    }

    /// With an inverse that is computed in this precision.
    fn prove_with<T: Number>(&self, near: &[Z]) -> Option<Zero> {
        let n = self.unknowns;
        let mut c: Vec<Z> = near.iter().map(|z| z.map(cut)).collect();
        let mut y = vec![Complex::<T>::default(); n * n];
        for (row, entries) in y.chunks_mut(n).zip(self.jacobian(&c).0) {
            for (unknown, value, _) in entries {
                row[unknown] = value.map(T::near);
            }
        }
        if !elimination::invert(&mut y, n) {
            return None;
        }
        let exactly = |x: T| DoubleDouble::sum(x.rough(), x.rest());
        let exactly = |row: &[Complex<T>]| row.iter().map(|z| z.map(exactly)).collect();
        let y: Vec<Vec<Z>> = y.chunks(n).map(exactly).collect();
        for _ in 0..CORRECTIONS {
            let f = self.residual(&c)?;
            for (x, row) in c.iter_mut().zip(&y) {
                let terms = row.iter().zip(&f);
                let moved = terms.fold(*x, |x, (&y, &([re, im], _))| {
                    x - y * Complex::new(re.into(), im.into())
                });
                *x = moved.map(cut);
            }
        }
        self.contract(c, &y)
    }

    /// The proof of the module's text.
    fn contract(&self, c: Vec<Z>, y: &[Vec<Z>]) -> Option<Zero> {
        let n = self.unknowns;
        if !y
            .iter()
            .flatten()
            .all(|y| in_range(y.re.hi) && in_range(y.im.hi))
        {
            return None;
        }
        let f = self.residual(&c)?;
        let (rows, longest) = self.jacobian(&c);
        // A slope passes through a difference and a product, and is added to others of its row, before it is multiplied with an
        // entry of Y, which takes a product and a difference, and subtracted, one for each equation.
        let error = gamma_double(n + longest + 10);
        // In floats no term of a bound passes through more operations.
        let up = |sum: f64| round_up(sum, 4 * n + 4 * longest + 30);
        let sizes_of = |row: &Vec<Z>| row.iter().map(|&y| size(y)).collect();
        let sizes: Vec<Vec<f64>> = y.iter().map(sizes_of).collect();
        let (mut eta, mut defects) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for k in 0..n {
            let mut defect = vec![Z::default(); n];
            let mut added = vec![0.0; n];
            (defect[k], added[k]) = (Complex::real(1.0), 1.0);
            for (e, row) in rows.iter().enumerate() {
                for &(unknown, value, slopes) in row {
                    defect[unknown] = defect[unknown] - y[k][e] * value;
                    added[unknown] += sizes[k][e] * slopes;
                }
            }
            let bound = |(defect, added): (Z, f64)| up(size(defect) + error * added) + UNDERFLOW;
            defects.push(
                defect
                    .into_iter()
                    .zip(added)
                    .map(bound)
                    .collect::<Vec<f64>>(),
            );
            eta.push(up(sizes[k].iter().zip(&f).map(|(y, f)| y * f.1).sum()));
        }
        let sum = |factors: &[f64], r: &[f64]| factors.iter().zip(r).map(|(a, b)| a * b).sum();
        // λ(r) and κ(r).
        let bounds = |r: &[f64]| -> [Vec<f64>; 2] {
            let curved = self.curved(r);
            [(&defects, r), (&sizes, &curved)]
                .map(|(matrix, r)| matrix.iter().map(|row| up(sum(row, r))).collect())
        };
        let contracts = |r: &[f64]| {
            let [linear, curved] = bounds(r);
            (0..n).all(|k| up(linear[k] + 2.0 * curved[k]) < r[k])
        };
        let mut r: Vec<f64> = eta.iter().map(|eta| 2.0 * eta + LEAST_RADIUS).collect();
        for _ in 0..ENLARGEMENTS {
            let [linear, curved] = bounds(&r);
            let inner: Vec<f64> = (0..n).map(|k| up(eta[k] + linear[k] + curved[k])).collect();
            let is_kept = inner
                .iter()
                .zip(&r)
                .all(|(inner, r)| inner < r && in_range(*r));
            if is_kept && contracts(&r) {
                // About the greatest multiple for which it still contracts.
                let most = (0..n).map(|k| 0.45 * (r[k] - linear[k]) / curved[k]);
                let most = most.fold(HUGE, f64::min);
                let wide: Vec<f64> = r.iter().map(|r| most * r).collect();
                let outer = if most > 1.0 && contracts(&wide) {
                    wide
                } else {
                    r
                };
                return Some(Zero {
                    centre: c,
                    inner,
                    outer,
                });
            }
            r = inner.into_iter().map(|inner| 2.0 * inner).collect();
        }
        None
    }
}

impl Zero {
    /// Intervals that hold the real and the imaginary part of an unknown.
    pub fn part(&self, unknown: usize) -> [Interval; 2] {
        let around = hull(-self.inner[unknown], self.inner[unknown]);
        let Complex { re, im } = self.centre[unknown];
        [re, im].map(|x| point(x.hi) + (point(x.lo) + around))
    }

    /// Whether no part is far from where it is claimed.
    fn is_near(&self, near: &[Z]) -> bool {
        let largest = near
            .iter()
            .fold(0.0, |max: f64, z| max.max(z.re.size()).max(z.im.size()));
        (0..near.len()).all(|k| {
            let parts = self.part(k).into_iter().zip([near[k].re, near[k].im]);
            let mut off = parts.map(|(part, near)| part - point(near.hi) - point(near.lo));
            off.all(|off| off.mag() <= NEAR * largest)
        })
    }

    /// The image under changes of some unknowns' signs, and the conjugate of it.
    pub fn image(&self, changes: impl Fn(usize) -> bool, conjugate: bool) -> Self {
        let mut image = self.clone();
        for (k, z) in image.centre.iter_mut().enumerate() {
            if changes(k) {
                *z = -*z;
            }
            if conjugate {
                z.im = -z.im;
            }
        }
        image
    }

    /// Whether it is real: the conjugate has to be a zero too. `None`: that is not clear.
    pub fn is_real(&self) -> Option<bool> {
        self.is_same(&self.image(|_| false, true))
    }

    /// Whether it is the image of another zero under one of these changes of signs. `None`: that is not clear.
    pub fn is_image(&self, other: &Self, changes: &[Vec<bool>]) -> Option<bool> {
        let mut clear = Some(false);
        for changes in changes {
            match self.is_same(&other.image(|k| changes[k], false)) {
                Some(false) => {}
                Some(true) => return Some(true),
                None => clear = None,
            }
        }
        clear
    }

    /// Whether another zero of the same equations is the same one. `None`: that is not clear.
    pub fn is_same(&self, other: &Self) -> Option<bool> {
        let mut is_near = true;
        for (k, (a, b)) in self.centre.iter().zip(&other.centre).enumerate() {
            let between = [(a.re, b.re), (a.im, b.im)]
                .map(|(a, b)| (point(a.hi) - point(b.hi)) + (point(a.lo) - point(b.lo)));
            let both = round_up(self.inner[k] + other.inner[k], 1);
            if between.iter().any(|x| x.mig() > both) {
                return Some(false);
            }
            let far = between[0].mag() + between[1].mag() + other.inner[k];
            is_near &= round_up(far, 2) <= self.outer[k];
        }
        is_near.then_some(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::exact as ratio;

    /// x² = square.
    fn root(square: Rational) -> Quadratic {
        let x = Form::Difference(Some(0), None);
        Quadratic::new(1, vec![(vec![Term::new(2, x, x)], square)])
    }

    fn at(re: f64, im: f64) -> Vec<Z> {
        vec![Complex::new(re.into(), im.into())]
    }

    #[test]
    fn roots_are_told_apart_and_double_ones_are_refused() {
        // 10¹⁰ + 1 and its opposite, from sixteen digits; imaginary ones; two that are 2⁻³⁹ apart.
        for (square, near) in [
            (ratio(1e10 + 1.0), [1e5, 0.0]),
            (ratio(-7.0), [0.0, 2.6457513]),
            (ratio(2.0.powi(-80)), [2.0.powi(-40) * 1.0000001, 0.0]),
        ] {
            let system = root(square.clone());
            assert!(system.prove(&at(near[0] * 1.01, near[1] * 1.01)).is_none());
            let zero = system.prove(&at(near[0], near[1])).unwrap();
            let [re, im] = zero.part(0);
            assert!(re.wid() <= 1e-10 && im.wid() <= 1e-10);
            // The box of the square holds the square.
            let enclosed = re.sqr() - im.sqr() - crate::interval::enclose_rational(&square);
            assert!(enclosed.contains(0.0) && enclosed.mag() < 1e-4);
            assert_eq!(zero.is_same(&zero), Some(true));
            assert_eq!(zero.is_same(&zero.image(|_| true, false)), Some(false));
            let is_real = square.is_positive();
            assert_eq!(zero.is_same(&zero.image(|_| false, true)), Some(is_real));
            assert_eq!(
                zero.is_same(&zero.image(|_| true, true)),
                Some(!is_real),
                "the opposite of the conjugate"
            );
        }
        for near in [0.0, 1e-30, 1e-9, 0.1] {
            assert!(root(Rational::zero()).prove(&at(near, 0.0)).is_none());
        }
        for near in [f64::NAN, f64::INFINITY, f64::MAX, 1e31] {
            assert!(root(ratio(2.0)).prove(&at(near, 0.0)).is_none());
            assert!(root(ratio(2.0)).prove(&at(1.0, near)).is_none());
        }
    }

    /// Pairs of equations x y = a, x² + x y − y = b with a known zero, of sizes from 10⁻³ to 10⁶.
    #[test]
    fn boxes_hold_the_zero() {
        for k in 1..40 {
            let (x, y) = (
                f64::from(k) * 10f64.powi(k % 7 - 3),
                -f64::from(41 - k) * 10f64.powi(k % 5 - 2),
            );
            let value = |unknown| Form::Difference(Some(unknown), None);
            let term = |factor, left, right| Term::new(factor, value(left), right);
            let (exact_x, exact_y) = (ratio(x), ratio(y));
            let product = &exact_x * &exact_y;
            let equations = vec![
                (vec![term(2, 0, value(1))], product.clone()),
                (
                    vec![
                        term(2, 0, value(0)),
                        term(1, 0, value(1)),
                        term(1, 1, value(0)),
                        term(-2, 1, Form::One),
                    ],
                    &exact_x * &exact_x + product - &exact_y,
                ),
            ];
            let system = Quadratic::new(2, equations);
            let near = [x, y].map(|x| Complex::real(x * (1.0 + 1e-9)));
            let zero = system.prove(&near).unwrap();
            for (unknown, value) in [x, y].into_iter().enumerate() {
                let [re, im] = zero.part(unknown);
                assert!(re.contains(value) && im.contains(0.0));
                assert!(re.wid() <= 1e-12 * value.abs());
                // The inner radius says no less than the exact distance from the middle.
                let middle = zero.centre[unknown].re;
                let off = (ratio(middle.hi) + ratio(middle.lo) - ratio(value)).abs();
                assert!(off <= ratio(zero.inner[unknown]));
            }
        }
    }
}
