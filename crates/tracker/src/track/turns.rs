//! The sign of dt/ds along a chain of tubes, and where it changes: the folds of the path.

use super::events::TimeAlong;

/// Whether t rises or falls along the path, and how often that has changed so far.
///
/// A change counts once dt/ds is proved to have one sign before and the other after it. Where the sign is
/// not certain for a stretch, there may be two more changes than are counted, or four, and so on; no
/// changes are claimed only where the sign was certain all along.
#[derive(Debug, Clone, Copy, Default)]
pub struct Turns {
    /// The sign that was certain first: whether t rises.
    pub first: Option<bool>,
    /// The sign that was certain last.
    rising: Option<bool>,
    /// Changes so far.
    pub count: usize,
    /// Whether the sign has not been certain since it was certain last.
    is_open: bool,
    /// Whether it was not certain for some stretch, and the same before and after.
    may_hide: bool,
}

/// What [`Turns::follow`] tells of a piece of a tube.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stretch {
    /// The sign of dt/ds is not certain between these parameters.
    Open(f64, f64),
    /// It is certain from this parameter on, and the same as it was before.
    Same(f64),
    /// It is certain from this parameter on, and the opposite of what it was before: whether t rises.
    Turned(f64, bool),
}

/// Cuts of a tube in half, one after the other: more are not needed, as a piece is not cut where the
/// band around the slope is what hides its sign.
const MAX_DEPTH: usize = 40;

impl Turns {
    /// Whether it is certain that there were no others, if none was counted.
    pub fn is_certain(&self) -> bool {
        !self.may_hide
    }

    /// Whether it is certain all along that t rises, or that it falls.
    pub fn is_steady(&self, rising: bool) -> bool {
        self.first == Some(rising) && self.count == 0 && !self.may_hide && !self.is_open
    }

    /// The path goes on, and it is certain that t rises there, or that it falls.
    pub fn go_on(&mut self, rising: bool) {
        self.be_certain(0.0, rising);
    }

    /// Changes along a path that goes on from here against the direction of `back`, from its end to where it began; and
    /// whether it is certain that there are no others, if these are none.
    pub fn closed_by(&self, back: &Turns) -> (usize, bool) {
        let between = match (self.rising, back.rising) {
            (Some(ahead), Some(back)) => usize::from(ahead == back),
            _ => 0,
        };
        let is_certain = [self, back]
            .iter()
            .all(|t| !t.may_hide && !t.is_open && t.rising.is_some());
        (self.count + between + back.count, is_certain)
    }

    /// Goes on along a tube, from a parameter to another, and tells what it sees, in order.
    pub fn follow(
        &mut self,
        time: &TimeAlong,
        (from, to): (f64, f64),
        mut seen: impl FnMut(Stretch),
    ) {
        self.split(time, (from, to), 0, &mut seen);
    }

    /// Goes on along a tube, from a parameter to another, and tells what it sees, in order, where bounds on dt/ds
    /// are known for the stretch, or for one that holds it: if they have one sign there is nothing to look at.
    pub fn follow_within(
        &mut self,
        time: &TimeAlong,
        (from, to): (f64, f64),
        (low, high): (f64, f64),
        mut seen: impl FnMut(Stretch),
    ) {
        if low > 0.0 || high < 0.0 {
            seen(self.be_certain(from, low > 0.0));
        } else {
            self.split(time, (from, to), 0, &mut seen);
        }
    }

    /// The sign is certain from `a` on.
    fn be_certain(&mut self, a: f64, rising: bool) -> Stretch {
        let turned = self.rising.is_some_and(|before| before != rising);
        self.rising = Some(rising);
        self.first.get_or_insert(rising);
        self.count += usize::from(turned);
        self.may_hide |= self.is_open && !turned;
        self.is_open = false;
        if turned {
            Stretch::Turned(a, rising)
        } else {
            Stretch::Same(a)
        }
    }

    fn split(
        &mut self,
        time: &TimeAlong,
        (a, b): (f64, f64),
        depth: usize,
        seen: &mut impl FnMut(Stretch),
    ) {
        let (_, (low, high)) = time.bounds(a, b);
        if low > 0.0 || high < 0.0 {
            seen(self.be_certain(a, low > 0.0));
        } else if depth == MAX_DEPTH || time.is_flat(a, b) {
            self.is_open = true;
            seen(Stretch::Open(a, b));
        } else {
            let middle = 0.5 * (a + b);
            self.split(time, (a, middle), depth + 1, seen);
            self.split(time, (middle, b), depth + 1, seen);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(at: f64, band: f64) -> TimeAlong {
        // t = (s − at)², so that t falls and then rises.
        TimeAlong::new(&[at * at, -2.0 * at, 1.0, 0.0, 0.0, 0.0], 1.0, 0.0, band)
    }

    #[test]
    fn a_fold_is_counted_once_wherever_it_lies() {
        for at in [-0.3, 0.0, 0.25, 0.5, 0.7] {
            for band in [0.0, 1e-12, 1e-3] {
                let time = parabola(at, band);
                let mut turns = Turns::default();
                let (mut turned, mut open) = (Vec::new(), Vec::new());
                // Cut into two as if these were two tubes.
                for piece in [(-1.0, 0.25), (0.25, 1.0)] {
                    turns.follow(&time, piece, |stretch| match stretch {
                        Stretch::Turned(s, rising) => {
                            assert!(rising);
                            turned.push(s);
                        }
                        Stretch::Open(a, b) => open.push((a, b)),
                        Stretch::Same(_) => {}
                    });
                }
                assert_eq!(
                    (turns.count, turns.first, turns.rising),
                    (1, Some(false), Some(true))
                );
                assert!(
                    turned.len() == 1 && turned[0] >= at,
                    "{at} {band} {turned:?}"
                );
                assert!(open.len() < 200, "{at} {band}: {} pieces", open.len());
                let (first, last) = (open[0].0, open[open.len() - 1].1);
                assert!(first <= at && at <= last && last - first < 4.0 * band + 1e-9);
            }
        }
    }

    #[test]
    fn folds_are_counted_across_a_meeting() {
        let along = |signs: &[bool]| {
            let mut turns = Turns::default();
            signs.iter().for_each(|&rising| turns.go_on(rising));
            turns
        };
        // Ahead t rises and falls; back it falls, seen from there, so that it rises ahead.
        let ahead = along(&[true, false]);
        assert_eq!(ahead.closed_by(&along(&[true])), (1, true));
        assert_eq!(ahead.closed_by(&along(&[false])), (2, true));
        assert_eq!(ahead.closed_by(&along(&[true, false])), (3, true));
        assert_eq!(ahead.closed_by(&Turns::default()), (1, false));
    }

    #[test]
    fn what_is_not_certain_is_not_claimed() {
        // The slope comes down to 0.01, and the band is wider than that.
        let slope = |band| {
            let time = TimeAlong::new(&[0.0, 0.01, 0.0, 1.0 / 3.0, 0.0, 0.0], 1.0, 0.0, band);
            let mut turns = Turns::default();
            turns.follow(&time, (-1.0, 1.0), |_| {});
            (turns.count, turns.is_certain())
        };
        assert_eq!((slope(0.02), slope(0.001)), ((0, false), (0, true)));
    }

    #[test]
    fn no_fold_is_no_fold() {
        let mut turns = Turns::default();
        let time = TimeAlong::new(&[0.0, 1.0, 0.1, 0.0, 0.0, 0.0], 1.0, 0.0, 1e-6);
        turns.follow(&time, (-1.0, 1.0), |seen| {
            assert!(matches!(seen, Stretch::Same(_)))
        });
        assert_eq!((turns.count, turns.rising), (0, Some(true)));
    }
}
