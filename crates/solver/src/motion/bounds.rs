//! Between which bounds something stays along a path.

use crate::edit::Round;
use crate::interval::along::Along;
use crate::interval::{Interval, hull, point};
use crate::places::{Each as _, array};
use crate::system::{Placement, Quantity, Seen, WHOLE_TURN};
use crate::track::{Control, Trace};

/// What is measured along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// As it was asked for.
    pub name: String,
    /// What it is measured in: `degrees`, `length`, `area` or `number`.
    pub unit: &'static str,
    /// What it is at the figure that the path sets out from.
    pub first: Interval,
    /// Between which bounds it stays, proved.
    pub bounds: Bounds,
}

/// Bounds that are met.
#[derive(Debug, Clone, PartialEq)]
pub enum Bounds {
    /// It is least here and greatest there.
    Between {
        /// The least.
        least: Extreme,
        /// The greatest.
        most: Extreme,
    },
    /// An angle that is another by so many whole turns once the figure has come back.
    AllTheWay(u32),
    /// It cannot be told, as points may come to be in one place, where an angle has no meaning; or the time was over.
    Untold,
}

/// An extreme value.
#[derive(Debug, Clone, PartialEq)]
pub struct Extreme {
    /// An enclosure: no figure of the path is beyond it, and one reaches into it.
    pub value: Interval,
    /// About the length of the path up to there, as in [`super::Frame::at`].
    pub at: f64,
    /// A box around the figure of the path that reaches into it.
    pub points: Vec<[Interval; 3]>,
}

impl Measured {
    /// Whether it is proved not to be the same all along.
    pub fn changes(&self) -> bool {
        match &self.bounds {
            Bounds::Between { least, most } => least.value.sup() < most.value.inf(),
            Bounds::AllTheWay(_) => true,
            Bounds::Untold => false,
        }
    }

    /// Whether nothing tells it from another, as far as they are known.
    pub(super) fn is_like(&self, other: &Measured) -> bool {
        let alike = |a: Interval, b: Interval| !a.intersection(b).is_empty();
        match (&self.bounds, &other.bounds) {
            (Bounds::Between { least: a, most: b }, Bounds::Between { least: c, most: d }) => {
                alike(self.first, other.first) && alike(a.value, c.value) && alike(b.value, d.value)
            }
            _ => false,
        }
    }
}

/// A part of a tube.
#[derive(Debug, Clone, Copy)]
struct Part {
    /// Whether it belongs to the way from the sketch in the other direction.
    is_behind: bool,
    tube: usize,
    between: (f64, f64),
    /// What the quantity's key is there.
    key: Interval,
}

/// Keys wider than this do not tell how far an angle turns.
const TELLS: f64 = 0.25 * WHOLE_TURN;
/// A part is not halved more often than this.
const DEPTH: u32 = 24;
/// Nor are so many looked at for one bound.
const MOST: usize = 40_000;

struct Look<'r, 'c> {
    round: &'r Round,
    quantity: &'r Quantity,
    /// Of what depends on where the figure stands.
    placement: Option<Placement>,
    control: &'r Control<'c>,
}

impl Look<'_, '_> {
    fn trace(&self, is_behind: bool) -> &Trace {
        let trace = &self.round.trace;
        match is_behind {
            true => trace.back().unwrap_or(trace),
            false => trace,
        }
    }

    fn figure(&self, part: &Part, between: (f64, f64)) -> Vec<[Interval; 3]> {
        let here = self.trace(part.is_behind).part(part.tube, between);
        self.round.in_problem(&here.points())
    }

    fn key(&self, part: &Part, between: (f64, f64), near: f64) -> Interval {
        let here = self.trace(part.is_behind).part(part.tube, between);
        let homotopy = self.round.homotopy();
        let middle = self.placed(homotopy.seen(|i| here.entry_in_middle(i)), |place, at| {
            place.to_problem(&at)
        });
        if between.0 >= between.1 {
            return self.quantity.key(&middle, near);
        }
        let around = self.placed(homotopy.seen(|i| here.entry_around(i)), along);
        self.quantity
            .key_along((&around, here.along()), &middle, near)
    }

    /// What is seen in the trace as the quantity wants it: in the coordinates of the problem if it depends on where the figure stands.
    fn placed<T: Copy, N>(
        &self,
        seen: Seen<impl Fn(usize) -> [T; 3], N>,
        moved: impl Fn(&Placement, [T; 3]) -> [T; 3],
    ) -> Seen<impl Fn(usize) -> [T; 3], N> {
        let point = move |p: usize| match &self.placement {
            Some(placement) => moved(placement, (seen.point)(p)),
            None => (seen.point)(p),
        };
        Seen {
            point,
            numbers: seen.numbers,
        }
    }

    /// Cuts a part until it tells how the quantity goes on, which is `near` where it begins. What it is where it ends.
    fn go_on(&self, part: Part, depth: u32, near: f64, out: &mut Vec<Part>) -> Option<f64> {
        if self.control.is_interrupted() {
            return None;
        }
        let (a, b) = part.between;
        let key = self.key(&part, (a, b), near);
        if self.quantity.is_direction() && key.wid() > TELLS {
            if depth == DEPTH {
                return None;
            }
            let middle = 0.5 * (a + b);
            let [first, second] =
                [(a, middle), (middle, b)].map(|between| Part { between, ..part });
            let near = self.go_on(first, depth + 1, near, out)?;
            return self.go_on(second, depth + 1, near, out);
        }
        out.push(Part { key, ..part });
        Some(self.key(&part, (b, b), key.mid()).mid())
    }

    /// All tubes of one way from the sketch, and what the quantity is in the end.
    fn way(&self, is_behind: bool, start: f64, out: &mut Vec<Part>) -> Option<f64> {
        let mut near = start;
        for tube in 0..self.trace(is_behind).tubes() {
            let part = Part {
                is_behind,
                tube,
                between: (0.0, 1.0),
                key: hull(near, near),
            };
            near = self.go_on(part, 0, near, out)?;
        }
        Some(near)
    }

    /// The least key, times `sign`.
    fn least(&self, parts: &[Part], sign: f64) -> Option<Extreme> {
        let signed = |x: Interval| if sign < 0.0 { -x } else { x };
        let mut active: Vec<Part> = parts.to_vec();
        // No key is below the first, and one is not above the second.
        let (mut low, mut best) = (f64::INFINITY, f64::INFINITY);
        let mut place: Option<(Part, f64)> = None;
        let mut floor = f64::INFINITY;
        for round in 0..=DEPTH {
            for part in &active {
                let middle = 0.5 * (part.between.0 + part.between.1);
                let here = signed(self.key(part, (middle, middle), part.key.mid()));
                if here.sup() < best {
                    (best, place) = (here.sup(), Some((*part, middle)));
                    floor = here.wid();
                }
            }
            // What cannot be less than the best is done with; so is what is not told better by halving.
            let is_done = |part: &Part| {
                let key = signed(part.key);
                key.inf() >= best || best - key.inf() <= 1.5 * floor
            };
            let (done, rest): (Vec<Part>, Vec<Part>) =
                active.iter().partition(|part| is_done(part));
            for part in done {
                low = low.min(signed(part.key).inf());
            }
            let is_over = self.control.is_interrupted();
            if rest.is_empty() || round == DEPTH || 2 * rest.len() > MOST || is_over {
                low = rest
                    .iter()
                    .fold(low, |low, part| low.min(signed(part.key).inf()));
                break;
            }
            active = rest
                .iter()
                .flat_map(|part| {
                    let (a, b) = part.between;
                    let middle = 0.5 * (a + b);
                    [(a, middle), (middle, b)].map(|between| Part {
                        between,
                        key: self.key(part, between, part.key.mid()),
                        ..*part
                    })
                })
                .collect();
        }
        let (part, middle) = place?;
        let at = self.trace(part.is_behind).length_at(part.tube, middle);
        // A part holds the best, so this cannot be.
        if low > best {
            return None;
        }
        let key = signed(hull(low, best));
        Some(Extreme {
            value: self.quantity.of_key(key),
            at: if part.is_behind { -at } else { at },
            points: self.figure(&part, (middle, middle)),
        })
    }
}

/// A place along a curve in the coordinates of the problem.
fn along(placement: &Placement, at: [Along; 3]) -> [Along; 3] {
    let turn = Placement {
        origin: [point(0.0); 3],
        ..*placement
    };
    let values = placement.to_problem(&at.each(|x| x.value));
    let slopes = turn.to_problem(&at.each(|x| x.slope));
    array(|k| Along {
        value: values[k],
        slope: slopes[k],
    })
}

/// Between which bounds a quantity stays along a path.
pub(super) fn measure(round: &Round, quantity: Quantity, control: &Control) -> Measured {
    let first = quantity.of(&round.figure(), &round.objects());
    let look = Look {
        round,
        quantity: &quantity,
        placement: (!quantity.is_invariant()).then_some(round.placement),
        control,
    };
    let found = || {
        let seen = round.homotopy().seen(|i| round.unknown(i));
        let start = look.placed(seen, |place, at| place.to_problem(&at));
        let start = quantity.key(&start, 0.0).mid();
        let mut parts = Vec::new();
        let end = look.way(false, start, &mut parts)?;
        if round.trace.back().is_some() {
            look.way(true, start, &mut parts)?;
        }
        let turns = ((end - start) / WHOLE_TURN).round();
        if round.is_loop() && quantity.is_direction() && turns != 0.0 {
            return Some(Bounds::AllTheWay(turns.abs() as u32));
        }
        Some(Bounds::Between {
            least: look.least(&parts, 1.0)?,
            most: look.least(&parts, -1.0)?,
        })
    };
    Measured {
        bounds: found().unwrap_or(Bounds::Untold),
        first,
        unit: quantity.unit(),
        name: quantity.name,
    }
}
