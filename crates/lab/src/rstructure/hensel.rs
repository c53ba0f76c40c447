//! Hensel lifting: roots modulo a prime become roots modulo its powers (002, section 6).
//!
//! For a system F with integer coefficients and a root x₀ modulo p at which F' is regular modulo
//! p, there is exactly one root modulo each power of p that agrees with x₀. From x modulo pʲ the
//! next is x + pʲ d with F'(x₀) d = −F(x) / pʲ modulo p: one matrix, factored once through its
//! R-structure, many right-hand sides.
//!
//! The example lifts the triangle of figure 1, whose solution is a vector of fractions, and
//! finds these in their residues.
//!
//! ```
//! use krawl::linalg::rstructure::Ordering;
//! use krawl_lab::rstructure::{Factors, RMatrix, Residue, Structure, hensel};
//! use num_bigint::BigInt;
//! use krawl::rational::Rational;
//!
//! // A'(0, 0), B'(4, 0), C'(1, 5) are fixed; A, B, C are to be found. Each equation says that
//! // two points, unknown (their first coordinate's number) or fixed, are at a given distance.
//! #[derive(Clone, Copy)]
//! enum Point { Unknown(usize), Fixed(i64, i64) }
//! use Point::*;
//! let bars = [
//!     (Unknown(0), Fixed(0, 0)), (Unknown(2), Fixed(4, 0)), (Unknown(0), Unknown(2)),
//!     (Unknown(0), Unknown(4)), (Unknown(2), Unknown(4)), (Unknown(4), Fixed(1, 5)),
//! ];
//! // Squared lengths are chosen so that this is a solution.
//! let fraction = |a: i64, b: i64| Rational::new(a.into(), b.into());
//! let solution = [
//!     fraction(1, 3), fraction(7, 5), fraction(9, 2), fraction(11, 7), fraction(3, 4), fraction(5, 3),
//! ];
//! let place = |p: Point, x: &[Rational]| match p {
//!     Unknown(k) => [x[k].clone(), x[k + 1].clone()],
//!     Fixed(x, y) => [fraction(x, 1), fraction(y, 1)],
//! };
//! let squared = |(p, q): (Point, Point), x: &[Rational]| {
//!     let ([a, b], [c, d]) = (place(p, x), place(q, x));
//!     (&a - &c) * (&a - &c) + (&b - &d) * (&b - &d)
//! };
//! let lengths = bars.map(|bar| squared(bar, &solution));
//!
//! // The root modulo p, which lifting does not find by itself.
//! const P: u64 = 1_000_003;
//! let start: Vec<BigInt> = solution.iter().map(|x| hensel::residue(x, P).unwrap()).collect();
//!
//! // The Jacobian there, xA being the key unknown and CC' ignored.
//! let unknowns = |p: Point| match p { Unknown(k) => vec![k, k + 1], Fixed(..) => vec![] };
//! let equations = bars.map(|(p, q)| [unknowns(p), unknowns(q)].concat());
//! let ordering = Ordering::new(6, &equations, &[0], &[5]).unwrap();
//! let mut jacobian = RMatrix::<Residue<P>>::zeros(Structure::of(&ordering, &equations));
//! let whole: Vec<Rational> = start.iter().map(|x| x.clone().into()).collect();
//! for (e, &(p, q)) in bars.iter().enumerate() {
//!     for (one, other) in [(p, q), (q, p)] {
//!         let Unknown(k) = one else { continue };
//!         let (a, b) = (place(one, &whole), place(other, &whole));
//!         for axis in 0..2 {
//!             let slope = fraction(2, 1) * (&a[axis] - &b[axis]);
//!             let column = ordering.column_of(k + axis);
//!             jacobian.set(ordering.row_of(e), column, hensel::to_residue(&slope.to_integer()));
//!         }
//!     }
//! }
//!
//! // Residuals in the order of rows, cleared of denominators; roots in the order of columns.
//! let residual = |x: &[BigInt]| -> Vec<BigInt> {
//!     let mut at = vec![fraction(0, 1); 6];
//!     for (&u, x) in ordering.unknowns().iter().zip(x) { at[u] = x.clone().into(); }
//!     ordering.equations().iter().map(|&e| {
//!         // The matrix is that of the equations as they are: divide modulo a high power of p.
//!         let f = squared(bars[e], &at) - &lengths[e];
//!         hensel::residue_of_power(&f, P, 40).unwrap()
//!     }).collect()
//! };
//! let mut factors = Factors::new(jacobian).unwrap();
//! let start: Vec<BigInt> = ordering.unknowns().iter().map(|&u| start[u].clone()).collect();
//! let root = hensel::lift(&mut factors, residual, &start, 4).unwrap();
//! for (&u, x) in ordering.unknowns().iter().zip(&root) {
//!     assert_eq!(hensel::fraction(x, &BigInt::from(P).pow(4)).unwrap(), solution[u]);
//! }
//! ```

use super::{Factors, RMatrix, Residue};
use krawl::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::borrow::Borrow;

/// Why a root cannot be lifted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum LiftError {
    /// The residual of an equation is not divisible by the power of p that was reached: the start
    /// is no root modulo p, or the matrix is not that of the equations.
    #[error("equation {equation} is not zero modulo p^{power}")]
    NoRoot {
        /// The row of the equation.
        equation: usize,
        /// The exponent of p.
        power: u32,
    },
}

/// Lifts a root modulo P to one modulo P to the given power, with entries from 0 to that less 1.
///
/// `jacobian` is F' at the root modulo P, factored; `residual` is F, in the matrix's order of rows,
/// or F modulo any multiple of the power wanted. The root has the matrix's order of columns.
pub fn lift<const P: u64, M: Borrow<RMatrix<Residue<P>>>>(
    jacobian: &mut Factors<Residue<P>, M>,
    mut residual: impl FnMut(&[BigInt]) -> Vec<BigInt>,
    root: &[BigInt],
    power: u32,
) -> Result<Vec<BigInt>, LiftError> {
    let p = BigInt::from(P);
    let mut x: Vec<BigInt> = root.iter().map(|x| modulo(x, &p)).collect();
    let mut reached = p.clone();
    for j in 1..=power {
        let f = residual(&x);
        if let Some(equation) = f.iter().position(|f| !(f % &reached).is_zero()) {
            return Err(LiftError::NoRoot { equation, power: j });
        }
        if j == power {
            break;
        }
        // λ = F(x) / pʲ; F' d = −λ.
        let lambda: Vec<Residue<P>> = f.iter().map(|f| to_residue(&-(f / &reached))).collect();
        for (x, d) in x.iter_mut().zip(jacobian.solve(&lambda)) {
            *x += &reached * d.value();
        }
        reached *= &p;
    }
    Ok(x)
}

/// An integer modulo M.
pub fn to_residue<const M: u64>(x: &BigInt) -> Residue<M> {
    let least = modulo(x, &BigInt::from(M)).to_i64();
    Residue::new(least.expect("less than the modulus, which is less than 2⁶³"))
}

/// A fraction modulo p, if p does not divide its denominator.
pub fn residue(x: &Rational, p: u64) -> Option<BigInt> {
    residue_of_power(x, p, 1)
}

/// A fraction modulo a power of p, if p does not divide its denominator.
pub fn residue_of_power(x: &Rational, p: u64, power: u32) -> Option<BigInt> {
    let modulus = BigInt::from(p).pow(power);
    let ([r, _], [s, _]) = euclid(x.denom(), &modulus, &BigInt::zero());
    r.is_one().then(|| modulo(&(x.numer() * s), &modulus))
}

/// The fraction a / b with |a|, b ≤ √(m / 2) that is x modulo m; there is at most one (Wang's
/// reconstruction; Knuth, The Art of Computer Programming 2, 4.5.3, exercise 51).
pub fn fraction(x: &BigInt, m: &BigInt) -> Option<Rational> {
    let bound = (m / BigInt::from(2)).sqrt();
    let ([_, next], [_, s_next]) = euclid(x, m, &bound);
    if s_next.is_zero() || s_next.abs() > bound {
        return None;
    }
    let found = Rational::new(next, s_next.clone());
    // In lowest terms already, or it is not congruent to x.
    (found.denom() == &s_next.abs()).then_some(found)
}

/// Euclid's algorithm for x modulo m, up to the first remainder that is no more than `least`: that and the one before, and what x is multiplied
/// with to come to each modulo m, the one before first.
fn euclid(x: &BigInt, m: &BigInt, least: &BigInt) -> ([BigInt; 2], [BigInt; 2]) {
    let (mut r, mut next) = (m.clone(), modulo(x, m));
    let (mut s, mut s_next) = (BigInt::zero(), BigInt::one());
    while next > *least {
        let q = &r / &next;
        (r, next) = (next.clone(), r - &q * next);
        (s, s_next) = (s_next.clone(), s - q * s_next);
    }
    ([r, next], [s, s_next])
}

fn modulo(x: &BigInt, m: &BigInt) -> BigInt {
    ((x % m) + m) % m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_come_back_from_their_residues() {
        for (a, b) in [
            (0i64, 1i64),
            (1, 1),
            (-1, 1),
            (22, 7),
            (-355, 113),
            (1, 9_998),
        ] {
            let x = Rational::new(a.into(), b.into());
            let residue = residue_of_power(&x, 101, 8).unwrap();
            assert_eq!(fraction(&residue, &BigInt::from(101).pow(8)), Some(x));
        }
        let x = Rational::new(1.into(), 202.into());
        assert_eq!(residue(&x, 101), None);
        assert_eq!(to_residue::<7>(&(-1).into()), Residue::new(6));
    }

    #[test]
    fn the_square_root_of_two_modulo_powers_of_seven() {
        let matrix = RMatrix::from_entries(0, &[1], &[(0, 0, Residue::<7>::new(6))]).unwrap();
        let mut factors = Factors::new(&matrix).unwrap();
        let f = |x: &[BigInt]| vec![&x[0] * &x[0] - BigInt::from(2)];
        let root = lift(&mut factors, f, &[3.into()], 20).unwrap();
        assert!((&root[0] * &root[0] - BigInt::from(2)) % BigInt::from(7).pow(20) == 0.into());
        let error = lift(&mut factors, f, &[2.into()], 20).unwrap_err();
        assert_eq!(
            error,
            LiftError::NoRoot {
                equation: 0,
                power: 1
            }
        );
    }
}
