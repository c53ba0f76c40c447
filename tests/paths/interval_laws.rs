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

/// The number that a float is, as another library has it.
fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("a finite float")
}

/// An interval and exact points of it: both ends and one between.
fn interval() -> impl Strategy<Value = (Interval, Vec<BigRational>)> {
    (float(), float(), 0u32..=100, any::<bool>()).prop_map(|(a, b, part, thin)| {
        let b = if thin { a.next_up() } else { b };
        let (lo, hi) = (a.min(b), a.max(b));
        let (x, y) = (exact(lo), exact(hi));
        let between = &x + (&y - &x) * BigRational::new(part.into(), 100.into());
        (hull(lo, hi), vec![x, between, y])
    })
}

/// Whether an interval encloses all of some numbers.
fn encloses(interval: Interval, all: &[BigRational]) -> bool {
    let [lo, hi] = [interval.inf(), interval.sup()];
    let is_above = lo == f64::NEG_INFINITY || {
        let lo = exact(lo);
        all.iter().all(|x| lo <= *x)
    };
    is_above
        && (hi == f64::INFINITY || {
            let hi = exact(hi);
            all.iter().all(|x| *x <= hi)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn operations_enclose_exact_results((a, xs) in interval(), (b, ys) in interval()) {
        let pairs = || xs.iter().flat_map(|x| ys.iter().map(move |y| (x, y)));
        let all = |of: fn((&BigRational, &BigRational)) -> BigRational| pairs().map(of).collect::<Vec<_>>();
        let [sums, differences, products] =
            [all(|(x, y)| x + y), all(|(x, y)| x - y), all(|(x, y)| x * y)];
        prop_assert!(encloses(a + b, &sums));
        prop_assert!(encloses(a - b, &differences));
        prop_assert!(encloses(a * b, &products));
        let mut changed = a;
        changed += b;
        prop_assert!(changed == a + b || encloses(changed, &sums));
        changed = a;
        changed -= b;
        prop_assert!(changed == a - b || encloses(changed, &differences));
        changed = a;
        changed *= b;
        prop_assert!(changed == a * b || encloses(changed, &products));
        if !b.contains(0.0) {
            let ratios = all(|(x, y)| x / y);
            prop_assert!(encloses(a / b, &ratios));
            changed = a;
            changed /= b;
            prop_assert!(changed == a / b || encloses(changed, &ratios));
        }
        prop_assert!(encloses(a.sqr(), &xs.iter().map(|x| x * x).collect::<Vec<_>>()));
        prop_assert!(encloses(a.abs(), &xs.iter().map(|x| x.abs()).collect::<Vec<_>>()));
        prop_assert!(encloses(-a, &xs.iter().map(|x| -x).collect::<Vec<_>>()));
        if xs.iter().any(|x| !x.is_negative()) {
            // √x lies between s and t if s² ≤ x ≤ t².
            let root = a.sqrt();
            let (s, t) = (exact(root.inf()), exact(root.sup()));
            let (below, above) = (&s * &s, &t * &t);
            let mut roots = xs.iter().filter(|x| !x.is_negative());
            prop_assert!(!s.is_negative() && roots.all(|x| below <= *x && *x <= above));
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
        prop_assert!(encloses(all, &[&xs[..], &ys[..]].concat()));
        let both = a.intersection(b);
        for x in &xs {
            prop_assert_eq!(within(&ys, x), within(&xs, x) && !both.is_empty() && encloses(both, std::slice::from_ref(x)));
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
        prop_assert!(encloses(box_, std::slice::from_ref(&third)) && box_.sup() <= box_.inf().next_up());
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
        let zero = BigRational::from_integer(0.into());
        let exact_value = |x: &BigRational, which: usize| {
            coefficients.iter().rev().fold(zero.clone(), |sum, (_, c)| sum * x + &c[which])
        };
        let values = ts.iter().flat_map(|x| (0..3).map(move |which| (x, which)));
        let values: Vec<_> = values.map(|(x, which)| exact_value(x, which)).collect();
        prop_assert!(encloses(value, &values));
    }
}
