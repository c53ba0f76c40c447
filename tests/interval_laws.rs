//! Every operation on intervals that proofs use encloses the exact rational result.

mod common;

use common::exact::exact;
use krawl::interval::{Interval, hull};
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
                if !b.contains(0.0) {
                    prop_assert!(encloses(a / b, &(x / y)));
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
    }
}
