//! Notices where a path goes far away and its tubes do not get longer with the distance.

/// So many tubes lead to twice the distance from a place, or the path is not followed farther. Where tubes grow with the distance
/// some ten do.
pub const MOST: usize = 1024;

/// How many tubes it takes to get twice as far.
#[derive(Debug, Default, Clone, Copy)]
pub struct Pace {
    from: f64,
    tubes: usize,
}

impl Pace {
    /// Takes account of a tube at whose end the largest unknown has this size. Tells whether too many tubes did not lead to twice
    /// the size, or back to half of it.
    pub fn is_slow(&mut self, size: f64) -> bool {
        self.tubes += 1;
        let is_on_its_way = 0.5 * self.from < size && size < 2.0 * self.from;
        if !is_on_its_way {
            (self.from, self.tubes) = (size, 0);
        }
        self.tubes > MOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_does_not_get_far_is_slow() {
        let is_slow = |size: fn(i32) -> f64| {
            let mut pace = Pace::default();
            (0..20_000).any(|k| pace.is_slow(size(k)))
        };
        // Tubes that grow with the distance, if only a little; there and back, which takes up to three times as many where it turns.
        assert!(!is_slow(|k| 1.001f64.powi(k)));
        assert!(!is_slow(|k| 1.003f64.powi(k.min(20_000 - k))));
        // Tubes of one length.
        assert!(is_slow(f64::from));
    }
}
