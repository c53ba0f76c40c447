//! Notices where a path is followed by ever more tubes and does not get anywhere.

/// So many tubes are looked at together.
const TUBES: usize = 4096;
/// They have to be longer than this part of the figure, in all. With shorter ones 10 million, as many as a run has unless it is
/// told otherwise, would not move the figure by a hundredth of its size.
const LEAST: f64 = 4e-6;

/// How far the last tubes lead.
#[derive(Debug, Default, Clone, Copy)]
pub struct Creep {
    /// How many they are.
    pub tubes: usize,
    /// How long they are together.
    pub length: f64,
}

impl Creep {
    /// Takes account of a tube of the half length `h`. Every so often it tells of those since it last did.
    pub fn add(&mut self, h: f64) -> Option<Creep> {
        self.tubes += 1;
        self.length += 2.0 * h;
        (self.tubes == TUBES).then(|| std::mem::take(self))
    }

    /// Whether the tubes are too short for a figure of this size.
    pub fn leads_nowhere(self, size: f64) -> bool {
        self.length < LEAST * size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_tubes_that_lead_nowhere_are_told_of() {
        let told = |h: fn(usize) -> f64| {
            let mut creep = Creep::default();
            let seen = (0..3 * TUBES).filter_map(|k| creep.add(h(k)));
            seen.map(|tubes| {
                assert_eq!(tubes.tubes, TUBES);
                usize::from(tubes.leads_nowhere(10.0))
            })
            .sum::<usize>()
        };
        assert_eq!(told(|_| 1e-3), 0);
        assert_eq!(told(|_| 1e-8), 0);
        assert_eq!(told(|_| 1e-10), 3);
        // Some short tubes among long ones are what a path near a singular place needs.
        assert_eq!(told(|k| if k % 1000 == 0 { 0.1 } else { 1e-12 }), 0);
    }
}
