//! Short arrays, made place by place.

/// What [`std::array::from_fn`] does, for values that can be copied: one function for each closure, where the standard
/// library's makes five, and ten for each [`map`](array::map).
///
/// An array of no places asks for the first one all the same.
#[inline]
pub fn array<T: Copy, const N: usize>(mut value: impl FnMut(usize) -> T) -> [T; N] {
    let mut out = [value(0); N];
    for k in 1..N {
        out[k] = value(k);
    }
    out
}

/// Arrays of values that can be copied, turned into others.
pub trait Each<T: Copy, const N: usize> {
    /// What [`map`](array::map) does, for N > 0; see [`array`].
    fn each<U: Copy>(self, value: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[inline]
    fn each<U: Copy>(self, mut value: impl FnMut(T) -> U) -> [U; N] {
        const { assert!(N > 0) }
        let mut out = [value(self[0]); N];
        for k in 1..N {
            out[k] = value(self[k]);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_standard_library_does() {
        let square = |k: usize| (k * k) as f64;
        assert_eq!(
            array::<_, 4>(square),
            std::array::from_fn::<_, 4, _>(square)
        );
        assert_eq!([3, 1, 2].each(|k| 2 * k), [3, 1, 2].map(|k| 2 * k));
        let mut order = Vec::new();
        [3, 1, 2].each(|k| order.push(k));
        assert_eq!(order, [3, 1, 2]);
    }
}
