//! Notices where a path is followed by ever more tubes and does not get anywhere.

/// So many tubes are looked at together.
const TUBES: usize = 4096;
/// They have to be longer than this part of the figure, in all. With shorter ones 10 million, as many as a run has unless it is
/// told otherwise, would not move the figure by a hundredth of its size.
const LEAST: f64 = 4e-6;

/// How far the last tubes lead.
#[derive(Debug, Default)]
pub struct Creep {
    tubes: usize,
    length: f64,
}

impl Creep {
    /// Takes account of a tube of the half length `h`, the figure being of this size. Tells how long the last tubes are together,
    /// and how many they are, if that is too little.
    pub fn add(&mut self, h: f64, size: f64) -> Option<(usize, f64)> {
        self.tubes += 1;
        self.length += 2.0 * h;
        if self.tubes < TUBES {
            return None;
        }
        let Creep { tubes, length } = std::mem::take(self);
        (length < LEAST * size).then_some((tubes, length))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_tubes_that_lead_nowhere_are_told_of() {
        let told = |h: f64| {
            let mut creep = Creep::default();
            (0..3 * TUBES).filter_map(|_| creep.add(h, 10.0)).count()
        };
        assert_eq!(told(1e-3), 0);
        assert_eq!(told(1e-8), 0);
        assert_eq!(told(1e-10), 3);
        // Some short tubes among long ones are what a path near a singular place needs.
        let mut creep = Creep::default();
        let some =
            (0..3 * TUBES).filter_map(|k| creep.add(if k % 1000 == 0 { 0.1 } else { 1e-12 }, 10.0));
        assert_eq!(some.count(), 0);
    }
}
