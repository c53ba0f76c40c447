//! Newton's method, and its like with a preconditioner from before: corrections until one is small enough, or
//! until they do not shrink any more.

/// When corrections end.
#[derive(Debug, Clone, Copy)]
pub struct Until {
    /// A correction of at most this size is the last.
    pub goal: f64,
    /// One that is more than so many times as long as the one before is at the limit of precision, or the start
    /// was too far away.
    pub ratio: f64,
    /// That is said of corrections of at most this size only.
    pub settled: f64,
    /// A correction longer than this leads nowhere.
    pub largest: f64,
    /// Corrections at most.
    pub steps: usize,
    /// Whether the correction that does not shrink is made all the same.
    pub makes_last: bool,
}

/// Corrections of any size, until they are zero or do not shrink at all.
pub const UNTIL: Until = Until {
    goal: 0.0,
    ratio: 1.0,
    settled: f64::INFINITY,
    largest: f64::INFINITY,
    steps: 100,
    makes_last: true,
};

/// Why they ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The last one was small enough.
    Reached,
    /// They did not shrink any more.
    Stagnated,
    /// One was too long, or no number.
    Away,
    /// There were too many.
    Steps,
}

/// What was seen of them.
#[derive(Debug, Clone, Copy)]
pub struct Corrections {
    /// The size of the first.
    pub first: f64,
    /// How much the second was shorter than the first; zero if there was none.
    pub contraction: f64,
    /// The size of the last that shrank.
    pub last: f64,
    /// Why they ended.
    pub end: End,
}

impl Until {
    /// Corrects `state`: `find` computes the next correction and tells its size, `make` makes it, given how many
    /// times as long as the one before it is.
    #[inline(always)]
    pub fn correct<S>(
        self,
        state: &mut S,
        mut find: impl FnMut(&mut S) -> f64,
        mut make: impl FnMut(&mut S, f64),
    ) -> Corrections {
        let mut seen = Corrections {
            first: f64::INFINITY,
            contraction: 0.0,
            last: f64::INFINITY,
            end: End::Steps,
        };
        for step in 0..self.steps {
            let size = find(state);
            let ratio = size / seen.last;
            match step {
                0 => seen.first = size,
                1 => seen.contraction = ratio,
                _ => {}
            }
            // A NaN is no less.
            let is_bounded = size <= self.largest;
            let stagnates = size > self.ratio * seen.last && size <= self.settled;
            if is_bounded && (self.makes_last || !stagnates) {
                make(state, ratio);
            }
            seen.end = match (is_bounded, size <= self.goal, stagnates) {
                (false, ..) => End::Away,
                (true, true, false) => End::Reached,
                (true, true, true) if self.makes_last => End::Reached,
                (true, _, true) => End::Stagnated,
                (true, false, false) => {
                    seen.last = size;
                    continue;
                }
            };
            break;
        }
        seen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// √2 from a start, and the corrections made.
    fn root(until: Until, start: f64) -> (f64, usize, Corrections) {
        let mut state = (start, 0.0, 0);
        let seen = until.correct(
            &mut state,
            |(x, step, _)| {
                *step = 0.5 * (*x - 2.0 / *x);
                step.abs()
            },
            |(x, step, made), _| {
                *x -= *step;
                *made += 1;
            },
        );
        (state.0, state.2, seen)
    }

    #[test]
    fn corrections_end_where_they_are_told_to() {
        let goal = Until {
            goal: 1e-6,
            ..UNTIL
        };
        let (x, _, seen) = root(goal, 1.5);
        assert!(seen.end == End::Reached && (x * x - 2.0).abs() < 1e-11);
        assert!(seen.first > 0.08 && seen.contraction < 0.04 && seen.last > 1e-6);
        // At the limit of floats.
        let (x, made, seen) = root(
            Until {
                ratio: 0.5,
                ..UNTIL
            },
            1.5,
        );
        assert!(matches!(seen.end, End::Reached | End::Stagnated));
        assert!((x * x - 2.0).abs() < 1e-15 && made < 8);
        let few = Until {
            steps: 2,
            goal: 1e-12,
            ..UNTIL
        };
        assert_eq!(root(few, 3.0).2.end, End::Steps);
        // From far away, and from where there is no number.
        let near = Until {
            largest: 1.0,
            ..UNTIL
        };
        let (x, made, seen) = root(near, 1e6);
        assert!(seen.end == End::Away && made == 0 && x == 1e6);
        assert_eq!(root(near, f64::NAN).2.end, End::Away);
    }

    #[test]
    fn a_correction_that_does_not_shrink_is_made_or_not() {
        let sizes = [1.0, 0.1, 0.09, 0.001];
        for (makes_last, made) in [(true, 3), (false, 2)] {
            let until = Until {
                ratio: 0.5,
                makes_last,
                ..UNTIL
            };
            let mut state = (0, 0);
            let seen = until.correct(
                &mut state,
                |(next, _)| {
                    *next += 1;
                    sizes[*next - 1]
                },
                |(_, made), _| *made += 1,
            );
            assert_eq!((seen.end, state.1, seen.last), (End::Stagnated, made, 0.1));
            // They need not shrink while they are long.
            let until = Until {
                settled: 0.01,
                goal: 0.001,
                ..until
            };
            let mut next = 0;
            let seen = until.correct(
                &mut next,
                |next| {
                    *next += 1;
                    sizes[*next - 1]
                },
                |_, _| {},
            );
            assert_eq!((seen.end, next), (End::Reached, 4));
        }
    }
}
