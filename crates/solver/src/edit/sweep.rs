//! A dimension driven through a range: the figure as a function of it.

use super::{Edited, Ending, Session, Setting};
use crate::blocks::Account;
use crate::interval::Interval;
use crate::problem::Decimal;
use crate::rational::Rational;
use crate::system::Located;
use crate::track::Control;
use num_bigint::BigInt;

/// The figure at one value of the dimension.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The value.
    pub value: Interval,
    /// The figure: a box that holds exactly one.
    pub points: Vec<[Interval; 3]>,
    /// Where the problem's objects are in it.
    pub objects: Vec<Located>,
}

/// What comes of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The way from the figure's own value to where the sweep begins.
    pub approach: Edited,
    /// The frames that were reached, each proved to be the one continuation of the one before, and so of the
    /// figure.
    pub frames: Vec<Frame>,
    /// How the sweep ended before the last frame, if it did: the edit that would have led to the next.
    pub end: Option<Edited>,
    /// The dimensions that are led, by index: frames tell the value of the first, and a file computes the others.
    pub led: Vec<usize>,
    /// What all of it is proved of: how all frames stand to what was left out.
    pub account: Account,
}

impl Session {
    /// Leads a dimension to `from` and then to `to`, with `frames` figures at equal distances, both ends
    /// among them. The session's figure is then that of the last frame.
    ///
    /// # Panics
    /// If the problem has no such distance, or there are fewer than two frames.
    pub fn sweep(
        &mut self,
        index: usize,
        (from, to): (&Decimal, &Decimal),
        frames: usize,
        control: &mut Control,
    ) -> Sweep {
        let values = evenly(from, to, frames);
        self.sweep_through(values.map(|value| vec![Setting::to(index, value)]), control)
    }

    /// Leads dimensions from each of these settings to the next: frames tell the first one's value. All are settings of the same dimensions.
    ///
    /// # Panics
    /// If there are none, or the problem has no such dimension.
    pub fn sweep_through(
        &mut self,
        mut settings: impl Iterator<Item = Vec<Setting>>,
        control: &mut Control,
    ) -> Sweep {
        let first = settings.next().expect("a sweep begins somewhere");
        let index = first[0].index;
        let approach = self.lead(&first, control);
        let mut sweep = Sweep {
            account: approach.account.clone(),
            approach,
            frames: Vec::new(),
            end: None,
            led: first.iter().map(|setting| setting.index).collect(),
        };
        if sweep.approach.ending != Ending::Reached {
            return sweep;
        }
        let frame = |session: &Self| Frame {
            value: session.length(index),
            points: session.points(),
            objects: session.objects(),
        };
        sweep.frames.push(frame(self));
        for settings in settings {
            let edited = self.lead(&settings, control);
            if edited.ending != Ending::Reached {
                sweep.end = Some(edited);
                break;
            }
            sweep.account.join(&edited.account);
            sweep.frames.push(frame(self));
        }
        sweep
    }
}

/// So many numbers at equal distances, both ends among them.
///
/// # Panics
/// If there are fewer than two.
pub fn evenly<'a>(
    from: &'a Decimal,
    to: &'a Decimal,
    count: usize,
) -> impl Iterator<Item = Decimal> + 'a {
    assert!(count >= 2, "a sweep has two frames at least");
    (0..count).map(move |k| between(from, to, k, count - 1))
}

/// `from + (to − from) k / n`, to seventeen digits behind the point of the larger; the ends exactly.
fn between(from: &Decimal, to: &Decimal, k: usize, n: usize) -> Decimal {
    if k == 0 {
        return from.clone();
    }
    if k == n || from.value() == to.value() {
        return to.clone();
    }
    let part = Rational::new(BigInt::from(k), BigInt::from(n));
    let exact = from.value() + (to.value() - from.value()) * part;
    let top = from.to_f64().abs().max(to.to_f64().abs());
    let digits = 17 - top.log10().floor() as i32;
    let power = Rational::from_integer(BigInt::from(10)).pow(digits);
    let scaled = (exact * power).round().to_integer();
    // Written without a power of ten, and without zeros at its end.
    let scaled = scaled.to_string();
    let kept = scaled.trim_end_matches('0');
    let zeros = (scaled.len() - kept.len()) as i32;
    let text = format!(
        "{}e{}",
        if kept.is_empty() { "0" } else { kept },
        zeros - digits
    );
    let value = text
        .parse::<Decimal>()
        .and_then(|value| value.plus(&0.into()));
    value.unwrap_or_else(|_| from.clone())
}
