//! What a contraction's bounds prove (`norms.rs`, `Contraction`), in exact numbers.

use super::*;
use crate::track::certified::proof::Contraction;
use crate::track::certified::shortfall::MAX_CONTRACTION;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    /// With |Φ'| ≤ contraction + width · r, and |Φ(0)| ≤ defect.
    #[test]
    fn a_contraction_maps_its_box_into_itself(
        contraction in prop_oneof![0.0f64..1.0, (-60f64..0.0).prop_map(f64::exp2)],
        width in (-30f64..30.0).prop_map(f64::exp2),
        part in (-60f64..1.0).prop_map(f64::exp2),
        largest in prop_oneof![Just(1.0f64), 1e-3f64..10.0],
        radius in prop_oneof![Just(f64::INFINITY), 1e-6f64..1.0],
    ) {
        // What is just about small enough, and what is smaller.
        let room = 1.0 - contraction;
        let defect = part * room * room / (8.0 * width);
        let found = Contraction::new((contraction, width, defect), largest, radius);
        let Ok(Contraction { r, q, nearer_q, distance }) = found else {
            prop_assert!(
                contraction > 0.999 * MAX_CONTRACTION || part > 0.999 || distance_is_large(defect, radius, largest)
            );
            return Ok(());
        };
        let [c, w, d, r, q, near, distance] = [contraction, width, defect, r, q, nearer_q, distance].map(Big::of);
        let one = Big::of(1.0);
        prop_assert!(r <= Big::of(largest) && q < one && near <= q.clone().max(near.clone()));
        prop_assert!(&c + &(&w * &r) <= q);
        prop_assert!(&d + &(&q * &r) < r);
        // The fixed point is no further than η/(1 − q), and there Φ' is smaller.
        let far = &d / &(&one - &q);
        let smaller = &c + &(&w * &(if far < r { far } else { r.clone() }));
        prop_assert!(smaller <= near);
        prop_assert!(&d / &(&one - &near) <= distance && distance < r);
        prop_assert!(!radius.is_finite() || distance <= Big::of(radius));
    }
}

/// Whether it is the wished radius, or the largest box, that a proof fails for.
fn distance_is_large(defect: f64, radius: f64, largest: f64) -> bool {
    defect > 0.01 * radius.min(largest)
}
