//! Every operation on intervals that proofs use encloses the exact rational result.

use krawl::interval::{Interval, enclose_rational, hull};
use krawl::rational::Rational;
use num_rational::BigRational;
use num_traits::Signed;
use proptest::prelude::*;

/// Floats of all sizes for which no operation here overflows, subnormal ones among them.
fn float() -> impl Strategy<Value = f64> {
    let of = |(m, e): (f64, i32)| m * 2f64.powi(e);
    prop_oneof![
        4 => (-1f64..1.0, -400i32..400).prop_map(of),
        2 => (-1f64..1.0, -1060i32..-1000).prop_map(of),
        4 => -10f64..10.0,
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, f64::MIN_POSITIVE, 5e-324, 0.1]),
    ]
}

/// An interval and exact points of it: both ends and one between.
/// The number that a float is, as another library has it.
fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("a finite float")
}

fn interval() -> impl Strategy<Value = (Interval, Vec<BigRational>)> {
    (float(), float(), 0u32..=100, any::<bool>()).prop_map(|(a, b, part, thin)| {
        let b = if thin { a.next_up() } else { b };
        let (lo, hi) = (a.min(b), a.max(b));
        let (x, y) = (exact(lo), exact(hi));
        let between = &x + (&y - &x) * BigRational::new(part.into(), 100.into());
        (hull(lo, hi), vec![x, between, y])
    })
}

fn encloses(interval: Interval, x: &BigRational) -> bool {
    let (lo, hi) = (interval.inf(), interval.sup());
    (lo == f64::NEG_INFINITY || exact(lo) <= *x) && (hi == f64::INFINITY || *x <= exact(hi))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn operations_enclose_exact_results((a, xs) in interval(), (b, ys) in interval()) {
        for x in &xs {
            for y in &ys {
                prop_assert!(encloses(a + b, &(x + y)));
                prop_assert!(encloses(a - b, &(x - y)));
                prop_assert!(encloses(a * b, &(x * y)));
                let mut changed = a;
                changed += b;
                prop_assert!(encloses(changed, &(x + y)));
                changed = a;
                changed -= b;
                prop_assert!(encloses(changed, &(x - y)));
                changed = a;
                changed *= b;
                prop_assert!(encloses(changed, &(x * y)));
                if !b.contains(0.0) {
                    prop_assert!(encloses(a / b, &(x / y)));
                    changed = a;
                    changed /= b;
                    prop_assert!(encloses(changed, &(x / y)));
                }
            }
            prop_assert!(encloses(a.sqr(), &(x * x)));
            prop_assert!(encloses(a.abs(), &x.abs()));
            prop_assert!(encloses(-a, &-x.clone()));
            // √x lies between s and t if s² ≤ x ≤ t².
            if !x.is_negative() {
                let root = a.sqrt();
                let (s, t) = (exact(root.inf()), exact(root.sup()));
                prop_assert!(!s.is_negative() && &s * &s <= *x && *x <= &t * &t);
            }
        }
        let middle = exact(a.mid());
        prop_assert!(xs[0] <= middle && middle <= xs[2]);
        let radius = exact(a.rad());
        prop_assert!(&middle - &radius <= xs[0] && xs[2] <= &middle + &radius);
        prop_assert!(exact(a.wid()) >= &xs[2] - &xs[0]);
        prop_assert!(xs.iter().all(|x| x.abs() <= exact(a.mag())));
        prop_assert!(xs.iter().all(|x| x.abs() >= exact(a.mig())));
    }

    /// What the checker and the lengths decide by, and what they put together.
    #[test]
    fn hulls_intersections_and_comparisons_are_those_of_sets((a, xs) in interval(), (b, ys) in interval()) {
        let within = |c: &[BigRational], x: &BigRational| c[0] <= *x && *x <= c[2];
        let all = a.convex_hull(b);
        prop_assert!(xs.iter().chain(&ys).all(|x| encloses(all, x)));
        let both = a.intersection(b);
        for x in &xs {
            prop_assert_eq!(within(&ys, x), within(&xs, x) && !both.is_empty() && encloses(both, x));
        }
        prop_assert_eq!(a.disjoint(b), both.is_empty());
        prop_assert_eq!(a.disjoint(b), xs[2] < ys[0] || ys[2] < xs[0]);
        prop_assert_eq!(a.interior(b), ys[0] < xs[0] && xs[2] < ys[2]);
        for y in [b.inf(), b.mid(), b.sup()] {
            prop_assert_eq!(a.contains(y), within(&xs, &exact(y)));
        }
        // The tightest floats around an exact number that is none.
        let third = &xs[1] / BigRational::from_integer(3.into());
        let box_ = enclose_rational(&Rational::new(third.numer().clone(), third.denom().clone()));
        prop_assert!(encloses(box_, &third) && box_.sup() <= box_.inf().next_up());
    }

    /// (a·b) + … in a row, as the lengths' polynomials are evaluated, and squares of sums.
    #[test]
    fn polynomials_enclose_exact_values(
        (t, ts) in interval(),
        coefficients in prop::collection::vec(interval(), 1..6),
    ) {
        // Sizes for which no power overflows.
        if t.mag() > 1e30 || coefficients.iter().any(|(c, _)| c.mag() > 1e100) {
            return Ok(());
        }
        let value = coefficients.iter().rev().fold(hull(0.0, 0.0), |sum, (c, _)| sum * t + *c);
        for x in &ts {
            for which in 0..3 {
                let zero = BigRational::from_integer(0.into());
                let exact_value = coefficients.iter().rev().fold(zero, |sum, (_, c)| sum * x + &c[which]);
                prop_assert!(encloses(value, &exact_value));
            }
        }
    }
}
