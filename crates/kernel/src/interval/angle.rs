//! Angles in degrees, enclosed.

use super::{Interval, Real, hull, point};
use crate::rational::Rational;

/// The angles between 0 and 180 degrees with these cosines. What floats say is widened until exact cosines are proved to be beyond.
pub fn degrees_of_cosine(cosines: Interval) -> Interval {
    let near = |x: f64| x.clamp(-1.0, 1.0).acos().to_degrees();
    let (mut low, mut high) = (near(cosines.sup()), near(cosines.inf()));
    let at = |x: f64| {
        let exact = Rational::from_float(x);
        exact.map(|x| Real::cosine_of_degrees(x).enclose())
    };
    let mut step = 1e-13;
    while low > 0.0 && at(low).is_none_or(|c| c.inf() < cosines.sup()) {
        low = (low - step).max(0.0);
        step *= 2.0;
    }
    let mut step = 1e-13;
    while high < 180.0 && at(high).is_none_or(|c| c.sup() > cosines.inf()) {
        high = (high + step).min(180.0);
        step *= 2.0;
    }
    hull(low, high)
}

/// The directions of vectors (x, y), in degrees counter-clockwise from the x axis, between −180 and 180 but for those near the negative one,
/// where the bounds may go a little beyond. All there are where the vector may be 0.
pub fn direction(x: Interval, y: Interval) -> Interval {
    let size = (x.sqr() + y.sqr()).sqrt();
    if size.inf() <= 0.0 || size.sup() == f64::INFINITY {
        return hull(-180.0, 180.0);
    }
    let (straight, right) = (point(180.0), point(90.0));
    let by_cosine = || degrees_of_cosine(x / size);
    let by_sine = || right - degrees_of_cosine(y / size);
    // Each is told best by the one of both that is smaller.
    if y.mid().abs() < x.mid().abs() {
        if x.inf() > 0.0 {
            return by_sine();
        }
        if x.sup() < 0.0 && y.mid() < 0.0 {
            return -straight - by_sine();
        }
        if x.sup() < 0.0 {
            return straight - by_sine();
        }
    }
    match (y.inf() > 0.0, y.sup() < 0.0) {
        (true, _) => by_cosine(),
        (_, true) => -by_cosine(),
        _ => hull(-180.0, 180.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn directions_are_enclosed(degrees in -179.99f64..180.0, size in 1e-6f64..1e6, wide in 0.0f64..1e-9) {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let about = |x: f64| hull(x * size - size * (wide + 1e-15), x * size + size * (wide + 1e-15));
            let found = direction(about(cosine), about(sine));
            prop_assert!(found.inf() <= degrees + 1e-13 && degrees - 1e-13 <= found.sup(), "{found:?}");
            // Coordinates have a part in their own size, so that it is little more than twice as wide as it could be.
            prop_assert!(found.wid() < 4e2 * (wide + 2e-15), "{found:?} {wide}");
        }
    }

    #[test]
    fn right_angles_are_sharp() {
        for (x, y, degrees) in [
            (1.0, 0.0, 0.0),
            (0.0, 1.0, 90.0),
            (-1.0, 0.0, 180.0),
            (0.0, -2.0, -90.0),
            (1.0, 1.0, 45.0),
        ] {
            let found = direction(point(x), point(y));
            assert!(found.contains(degrees) && found.wid() < 1e-11, "{found:?}");
        }
        assert_eq!(
            direction(hull(-1.0, 1.0), hull(-1.0, 1.0)),
            hull(-180.0, 180.0)
        );
    }
}
