//! What a claim about a figure is proved of: how many equations, which constraints were left out, which coordinates are held.
//!
//! Proofs are about as many equations as unknowns. A figure with more constraints has some left out, one with fewer has
//! coordinates held where they are, and a claim about it is true only with both in the same sentence. Every verb says it
//! with the same words, [`Account::clause`], and writes it as the same JSON.

use super::whose::Whose;
use crate::interval::{Interval, hull, point};
use crate::order::add_new;
use crate::problem::{Decimal, Problem, either};
use serde::{Deserialize, Serialize};

/// Names in one list of a sentence; the others are counted.
const LISTED: usize = 12;

/// A constraint without a number, and one whose number is whole or has more digits than drawings keep, is met within this
/// part of the figure's mean length: so many digits programs keep of drawings that say a thing twice.
pub const LEAST_PART: f64 = 1e-7;

/// What a claim is proved of.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Account {
    /// How many equations were used.
    pub equations: usize,
    /// What is said by those of them that are none of the problem's, in words: contacts that are kept.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub added: Vec<String>,
    /// The constraints that are none of these.
    pub left_out: Vec<LeftOut>,
    /// The coordinates (or radii, directions) that are held because nothing determines them.
    pub held: Vec<Held>,
    /// The dimensions that stand still although the file computes them from what is led, or what is led from them, in words.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held_though_computed: Vec<String>,
    /// Where the drawing is singular, so that several figures may continue it and the claim is about one of them: what is so about it, and how far
    /// it was moved off that place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawing: Option<String>,
    /// What is left as it is in the file of another program.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_as_is: Vec<String>,
    /// Because of what, each with its number: `Ellipse (2)`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub without_a_kind: Vec<String>,
    /// How often on the way equations and what is held were chosen anew: each of `held` is then held on a part of the way, and
    /// a constraint may be left out on a part of it.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub chosen_anew: usize,
}

/// A constraint that was left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// What people call it.
    pub name: String,
    /// Why it was left out.
    pub why: Why,
    /// How the figures that are printed stand to it: the worst of them.
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// Why a constraint was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// It follows from those used, by an identity that was proved.
    Follows,
    /// It says nothing new at the figure, as far as floats tell: there are as many others as unknowns.
    NothingNew,
}

/// How figures stand to a constraint that was left out. Numbers are in the unit of its number: a length for a distance, a
/// radius, a coordinate. What has another number (an angle, a ratio) or none is told as a length: how far the two sides of
/// its equation are apart, divided by the power of the figure's mean length that makes a length of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// It holds wherever those used do.
    Follows,
    /// No figure was looked at: these are the constraints of a drawing, or there is no figure.
    NotLookedAt,
    /// Proved to be met within this.
    Met {
        /// At most so far, and no more than counts as met.
        within: f64,
    },
    /// Proved to be missed: no figure of the problem.
    Missed {
        /// By so much at least.
        by: f64,
    },
    /// Of several figures one at least is proved to miss it.
    MissedBySome {
        /// By so much at least.
        by: f64,
    },
    /// It may be met or missed.
    Undecided {
        /// At most so far.
        at_most: f64,
    },
}

/// A coordinate that is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Held {
    /// What people call it: `x of B`, `the radius of c`.
    pub what: String,
    /// Where it is held: bounds, in the unit of the problem.
    pub at: (f64, f64),
}

impl Verdict {
    /// What is known where a constraint is missed by a number in this interval, and met within `epsilon`.
    pub fn of(miss: Interval, epsilon: f64) -> Self {
        let (least, most) = (miss.mig(), miss.mag());
        match (most <= epsilon, least > epsilon) {
            (true, _) => Verdict::Met { within: most },
            (_, true) => Verdict::Missed { by: least },
            _ => Verdict::Undecided { at_most: most },
        }
    }

    /// Of two figures together.
    pub fn beside(self, other: Self) -> Self {
        use Verdict::{Missed, MissedBySome, NotLookedAt};
        match (self, other) {
            (Missed { by: a }, Missed { by: b }) => Missed { by: a.min(b) },
            (
                Missed { by: a } | MissedBySome { by: a },
                Missed { by: b } | MissedBySome { by: b },
            ) => MissedBySome { by: a.max(b) },
            (Missed { by } | MissedBySome { by }, _) | (_, Missed { by } | MissedBySome { by }) => {
                MissedBySome { by }
            }
            (NotLookedAt, _) | (_, NotLookedAt) => NotLookedAt,
            _ => self.and(other),
        }
    }

    /// Of two equations of one constraint together.
    pub fn and(self, other: Self) -> Self {
        use Verdict::{Follows, Met, Missed, MissedBySome, NotLookedAt, Undecided};
        match (self, other) {
            (Follows, that) | (that, Follows) => that,
            (NotLookedAt, that) | (that, NotLookedAt) => that,
            (Missed { by: a }, Missed { by: b }) => Missed { by: a.max(b) },
            (Missed { by }, _) | (_, Missed { by }) => Missed { by },
            (MissedBySome { by: a }, MissedBySome { by: b }) => MissedBySome { by: a.max(b) },
            (MissedBySome { by }, _) | (_, MissedBySome { by }) => MissedBySome { by },
            (Met { within: a }, Met { within: b }) => Met { within: a.max(b) },
            (
                Undecided { at_most: a } | Met { within: a },
                Undecided { at_most: b } | Met { within: b },
            ) => Undecided { at_most: a.max(b) },
        }
    }

    /// Whether it is proved that a figure does not meet the constraint.
    pub fn is_missed(self) -> bool {
        matches!(self, Verdict::Missed { .. } | Verdict::MissedBySome { .. })
    }
}

impl Account {
    /// Of a figure of this problem, in so many equations, with what its file keeps as it is.
    pub fn of(problem: &Problem, equations: usize) -> Self {
        let kinds = problem.kept.kinds.iter();
        Account {
            equations,
            left_as_is: problem.kept.what.clone(),
            without_a_kind: kinds.map(|(kind, n)| format!("{kind} ({n})")).collect(),
            ..Account::default()
        }
    }

    /// Notes a constraint that was left out. A constraint may have several equations: what is worst of them counts.
    pub fn leave_out(&mut self, name: String, verdict: Verdict) {
        self.leave_out_by(name, verdict, Verdict::and);
    }

    /// Notes how another figure stands to a constraint that was left out.
    pub fn leave_out_beside(&mut self, name: String, verdict: Verdict) {
        self.leave_out_by(name, verdict, Verdict::beside);
    }

    fn leave_out_by(
        &mut self,
        name: String,
        verdict: Verdict,
        together: fn(Verdict, Verdict) -> Verdict,
    ) {
        let why = match verdict {
            Verdict::Follows => Why::Follows,
            _ => Why::NothingNew,
        };
        match self.left_out.iter_mut().find(|other| other.name == name) {
            Some(other) => {
                other.verdict = together(other.verdict, verdict);
                if why == Why::NothingNew {
                    other.why = why;
                }
            }
            None => self.left_out.push(LeftOut { name, why, verdict }),
        }
    }

    /// The same of figures whose dimensions have other numbers: what was left out as it follows from the others with the numbers given need not follow
    /// then.
    pub fn with_other_numbers(mut self) -> Self {
        for one in &mut self.left_out {
            if one.verdict == Verdict::Follows {
                (one.why, one.verdict) = (Why::NothingNew, Verdict::NotLookedAt);
            }
        }
        self
    }

    /// The same claim made of other figures, too: with the worse verdict of each constraint, and all that is held in either.
    pub fn join(&mut self, other: &Account) {
        // What was used of the figures of one of both is met by these.
        let by_some = |verdict: Verdict, others: &Account, name: &str| match verdict {
            Verdict::Missed { by }
                if others.equations > 0 && !others.left_out.iter().any(|o| o.name == name) =>
            {
                Verdict::MissedBySome { by }
            }
            verdict => verdict,
        };
        for own in &mut self.left_out {
            own.verdict = by_some(own.verdict, other, &own.name);
        }
        for one in &other.left_out {
            let verdict = by_some(one.verdict, self, &one.name);
            self.leave_out_beside(one.name.clone(), verdict);
        }
        for added in &other.added {
            add_new(&mut self.added, added.clone());
        }
        for held in &other.held {
            if !self.held.iter().any(|own| own.what == held.what) {
                self.held.push(held.clone());
            }
        }
        for held in &other.held_though_computed {
            add_new(&mut self.held_though_computed, held.clone());
        }
        if self.drawing.is_none() {
            self.drawing.clone_from(&other.drawing);
        }
        if self.left_as_is.is_empty() {
            self.left_as_is.clone_from(&other.left_as_is);
            self.without_a_kind.clone_from(&other.without_a_kind);
        }
        self.equations = self.equations.max(other.equations);
        self.chosen_anew = self.chosen_anew.max(other.chosen_anew);
    }

    /// The same of a way in two parts, of which `before` is what the first is proved of.
    pub fn follow_on(&mut self, before: &Account) {
        let anew = self.chosen_anew + before.chosen_anew + 1;
        self.join(before);
        self.chosen_anew = anew;
    }

    /// Whether the claim is about the figure as it is: nothing is held or added, and what was left out follows, proved.
    pub fn is_whole(&self) -> bool {
        self.held.is_empty()
            && self.held_though_computed.is_empty()
            && self.added.is_empty()
            && self.left_as_is.is_empty()
            && self.drawing.is_none()
            && self.meets_all()
    }

    /// Whether all constraints are proved to be met: none was left out but those that follow from the others.
    pub fn meets_all(&self) -> bool {
        self.left_out.iter().all(|one| one.why == Why::Follows)
    }

    /// The names of what was left out.
    pub fn names_left_out(&self) -> Vec<String> {
        self.left_out.iter().map(|one| one.name.clone()).collect()
    }

    /// The names of the coordinates that are held.
    pub fn names_held(&self) -> Vec<String> {
        self.held.iter().map(|held| held.what.clone()).collect()
    }

    /// What is held: `with x of B and y of B held where they are`; empty where nothing is.
    pub fn held_in_words(&self) -> String {
        match self.held.as_slice() {
            [] => String::new(),
            _ if self.chosen_anew > 0 => {
                let names = list(&self.names_held());
                format!("with {names} held on all of the way or a part of it")
            }
            [one] => format!("with {} held where it is", one.what),
            _ => format!("with {} held where they are", list(&self.names_held())),
        }
    }

    /// What stays as it is in the file, and why: `with e7 left as it is because of Ellipse (1), which krawl has no kind for`; empty where nothing does.
    pub fn kept_in_words(&self) -> String {
        let kinds = list(&self.without_a_kind);
        match self.left_as_is.as_slice() {
            [] => String::new(),
            [one] => {
                format!("with {one} left as it is because of {kinds}, which krawl has no kind for")
            }
            all => format!(
                "with {} left as they are because of {kinds}, which krawl has no kind for",
                list(all)
            ),
        }
    }

    /// What was left out and how the figures stand to it: `Q1-Q2 and P2-P3 were left out and are met within 3e-12, proved`;
    /// empty where nothing was.
    pub fn left_out_in_words(&self) -> String {
        let names = |wanted: &dyn Fn(&LeftOut) -> bool| -> Vec<String> {
            let those = self.left_out.iter().filter(|one| wanted(one));
            those.map(|one| one.name.clone()).collect()
        };
        let were = |names: &[String], one: &str, several: &str| {
            format!("{} {}", list(names), either(names.len(), one, several))
        };
        let mut parts = Vec::new();
        let met = names(&|one| matches!(one.verdict, Verdict::Met { .. }));
        if !met.is_empty() {
            let within = self
                .left_out
                .iter()
                .fold(0.0, |most, one| match one.verdict {
                    Verdict::Met { within } => within.max(most),
                    _ => most,
                });
            parts.push(format!(
                "{} met within {}, proved",
                were(&met, "was left out and is", "were left out and are"),
                rounded_up(within)
            ));
        }
        for one in &self.left_out {
            match one.verdict {
                Verdict::Missed { by } => parts.push(format!(
                    "{} was left out and is missed by at least {}, proved",
                    one.name,
                    rounded_down(by)
                )),
                Verdict::MissedBySome { by } => parts.push(format!(
                    "{} was left out and is missed by at least {} in some of these figures, proved",
                    one.name,
                    rounded_down(by)
                )),
                Verdict::Undecided { at_most } if at_most.is_finite() => parts.push(format!(
                    "{} was left out, and is missed by at most {}: whether it is met is not decided",
                    one.name,
                    rounded_up(at_most)
                )),
                Verdict::Undecided { .. } => parts.push(format!(
                    "{} was left out, and whether it is met is not decided",
                    one.name
                )),
                _ => {}
            }
        }
        let follow = names(&|one| one.verdict == Verdict::Follows);
        if !follow.is_empty() {
            parts.push(format!(
                "{} from the others, proved",
                were(
                    &follow,
                    "was left out and follows",
                    "were left out and follow"
                )
            ));
        }
        let unseen = names(&|one| one.verdict == Verdict::NotLookedAt);
        if !unseen.is_empty() {
            parts.push(format!(
                "{} out, and nothing is proved of {}",
                were(&unseen, "was left", "were left"),
                either(unseen.len(), "it", "them")
            ));
        }
        parts.join("; ")
    }

    /// What a claim about the figures is to say of itself, after its verb: `in the 18 equations used, with x of B held where it
    /// is`. Empty where the claim is about the figure as it is.
    pub fn scope(&self) -> String {
        let used = match self.meets_all() && self.added.is_empty() {
            true => String::new(),
            false if self.chosen_anew > 0 => {
                format!("in {} equations at a time", self.equations)
            }
            false => format!("in the {} equations used", self.equations),
        };
        let added = match self.added.is_empty() {
            true => String::new(),
            false => format!("among them {}", list(&self.added)),
        };
        let computed = match self.held_though_computed.is_empty() {
            true => String::new(),
            false => format!("with {}", list(&self.held_though_computed)),
        };
        let (held, kept) = (self.held_in_words(), self.kept_in_words());
        let drawing = match self.drawing {
            None => String::new(),
            Some(_) => {
                "with the first figure one of those to which the singular drawing leads".to_owned()
            }
        };
        joined([used, added, held, computed, kept, drawing], ", ")
    }

    /// All of it as one clause: [`Account::scope`], and what was left out.
    pub fn clause(&self) -> String {
        joined([self.scope(), self.left_out_in_words()], "; ")
    }

    /// The same with what parts it from the words before: a space, or a semicolon where nothing is used or held that has to be said.
    pub fn clause_behind(&self) -> String {
        match (self.scope(), self.clause()) {
            (_, words) if words.is_empty() => words,
            (scope, words) if scope.is_empty() => format!("; {words}"),
            (_, words) => format!(" {words}"),
        }
    }
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

fn list(names: &[String]) -> String {
    list_of(names, LISTED)
}

/// `a, b and c`, or, of more than so many, `a, b and 7 more`.
pub(crate) fn list_of(names: &[String], most: usize) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        all if all.len() > most => {
            format!("{} and {} more", all[..most].join(", "), all.len() - most)
        }
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn joined<const N: usize>(parts: [String; N], between: &str) -> String {
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join(between)
}

/// A number of one digit that is no less than this one.
pub fn rounded_up(x: f64) -> String {
    plain(one_digit(x, |shown| shown >= x, 1))
}

/// A number of two digits that is no more than this one.
pub fn rounded_down(x: f64) -> String {
    let text = format!("{x:.1e}");
    plain(match text.parse::<f64>() {
        Ok(shown) if shown > x => one_digit(x, |shown| shown <= x, -1),
        _ => text,
    })
}

/// The same number without a power of ten, where it has few zeros so.
fn plain(text: String) -> String {
    match text.parse::<f64>() {
        Ok(x) if x == 0.0 || (1e-3..1e4).contains(&x.abs()) => x.to_string(),
        _ => text,
    }
}

/// The nearest number of one digit, or the next in a direction, that `fits`.
fn one_digit(x: f64, fits: impl Fn(f64) -> bool, step: i32) -> String {
    let text = format!("{x:.0e}");
    let parsed = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
    if fits(parsed(&text)) {
        return text;
    }
    let Some((digit, power)) = text.split_once('e') else {
        return text;
    };
    let (digit, power): (i32, i32) = (digit.parse().unwrap_or(1), power.parse().unwrap_or(0));
    match digit + step {
        10 => format!("1e{}", power + 1),
        0 => format!("9e{}", power - 1),
        digit => format!("{digit}e{power}"),
    }
}

/// How an equation that was left out is measured, and within how much it counts as met.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ruler {
    /// Whether it says the square of a length, and is told as that length; otherwise it is divided by `scale`.
    is_square: bool,
    scale: f64,
    /// It is met where it is missed by no more than this.
    pub epsilon: f64,
}

impl Ruler {
    /// For an equation of this `owner`, in a figure of mean length `unit`.
    /// `tolerance`: what counts as met, where that is not told by the digits of numbers.
    pub fn new(
        problem: &Problem,
        owner: Whose,
        (unit, power): (f64, i32),
        tolerance: Option<f64>,
    ) -> Self {
        let is_square = matches!(owner, Whose::Distance(_));
        let least = LEAST_PART * unit;
        let digits = match owner.number(problem) {
            // Of a square s with an error e the root has one of e / (2 √s).
            Some((squared, true)) => half_digit(squared) / (2.0 * squared.to_f64().sqrt()),
            Some((number, false)) if is_square || power == 1 => half_digit(number),
            _ => 0.0,
        };
        Ruler {
            is_square,
            scale: unit.powi(power - 1),
            epsilon: tolerance.unwrap_or(digits.max(least)),
        }
    }

    /// By how much it is missed where its left-hand side is `off` more than its right-hand side, `right`, both in the unit of
    /// the problem.
    pub fn miss(&self, off: Interval, right: Interval) -> Interval {
        if !self.is_square {
            return off / point(self.scale);
        }
        // |p − q| − d = (|p − q|² − d²) / (|p − q| + d).
        let is_square = hull(0.0, f64::MAX);
        let length = (right + off).intersection(is_square).sqrt();
        off / (length + right.intersection(is_square).sqrt())
    }

    /// How far its sides may be apart, in the unit of the problem: up to the first it counts as met, beyond the second as missed.
    pub fn within(&self, right: Interval) -> [f64; 2] {
        let epsilon = point(self.epsilon);
        let [met, missed] = match self.is_square {
            // (d ± ε)² − d² = ε (ε ± 2d), the smaller of the two in size where the length is too small.
            true => {
                let twice = point(2.0) * right.intersection(hull(0.0, f64::MAX)).sqrt();
                [epsilon * (twice - epsilon), epsilon * (twice + epsilon)]
            }
            false => [epsilon * point(self.scale); 2],
        };
        [met.inf().max(0.0), missed.sup()]
    }

    /// What is known of it there.
    pub fn verdict(&self, off: Interval, right: Interval) -> Verdict {
        Verdict::of(self.miss(off, right), self.epsilon)
    }
}

/// Half a unit of a number's last digit. Whole numbers are meant exactly.
pub(super) fn half_digit(number: &Decimal) -> f64 {
    match number.last_digit() {
        place if place < 0 => 0.5 * 10f64.powi(place),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_the_safe_way() {
        assert_eq!(rounded_up(2.9e-12), "3e-12");
        assert_eq!(rounded_up(3.1e-12), "4e-12");
        assert_eq!(rounded_up(9.4e-3), "0.01");
        assert_eq!(rounded_down(2.26), "2");
        assert_eq!(rounded_down(2.24), "2.2");
        assert_eq!(rounded_down(0.84), "0.84");
        assert_eq!(rounded_up(9.7e-4), "0.001");
        assert_eq!(rounded_up(1234.0), "2000");
        assert_eq!(rounded_up(0.0), "0");
    }

    /// Of a constraint with several equations no verdict is better than that of any of them.
    #[test]
    fn what_was_not_looked_at_does_not_follow() {
        use Verdict::{Follows, Met, Missed, NotLookedAt};
        let met = Met { within: 1e-12 };
        for (one, other, both) in [
            (Follows, NotLookedAt, NotLookedAt),
            (Follows, met, met),
            (NotLookedAt, met, met),
            (met, Missed { by: 1.0 }, Missed { by: 1.0 }),
            (Follows, Follows, Follows),
        ] {
            assert_eq!(one.and(other), both);
            assert_eq!(other.and(one), both);
        }
    }

    #[test]
    fn what_is_said_is_the_worst() {
        let mut account = Account {
            equations: 18,
            ..Account::default()
        };
        assert!(account.is_whole() && account.clause().is_empty());
        account.leave_out("a-b".to_owned(), Verdict::Met { within: 1e-12 });
        account.leave_out("c-d".to_owned(), Verdict::Met { within: 2.5e-12 });
        account.leave_out("e".to_owned(), Verdict::Follows);
        account.held.push(Held {
            what: "x of B".to_owned(),
            at: (1.0, 1.0),
        });
        assert_eq!(
            account.clause(),
            "in the 18 equations used, with x of B held where it is; a-b and c-d were left out and are met within 3e-12, \
             proved; e was left out and follows from the others, proved"
        );
        let other = account.clone().with_other_numbers().clause();
        assert!(
            other.ends_with("proved; e was left out, and nothing is proved of it"),
            "{other}"
        );
        account.leave_out("a-b".to_owned(), Verdict::Missed { by: 0.5 });
        assert!(account.left_out[0].verdict.is_missed());
        assert!(!account.meets_all());
    }

    /// What each of several figures misses is said of all of them with the least number, what some miss of some.
    #[test]
    fn of_several_figures_no_more_is_said_than_holds_for_all() {
        let met = Verdict::Met { within: 1e-9 };
        let [near, far] = [0.1, 0.5].map(|by| Verdict::Missed { by });
        assert_eq!(Verdict::NotLookedAt.beside(met), Verdict::NotLookedAt);
        assert_eq!(near.beside(far), near);
        assert_eq!(met.beside(far), Verdict::MissedBySome { by: 0.5 });
        assert_eq!(
            near.beside(met).beside(far),
            Verdict::MissedBySome { by: 0.5 }
        );
        let mut account = Account::default();
        account.leave_out_beside("A-B".to_owned(), far);
        account.leave_out_beside("A-B".to_owned(), near);
        let words = account.left_out_in_words();
        assert_eq!(
            words,
            "A-B was left out and is missed by at least 0.1, proved"
        );
        account.leave_out_beside("A-B".to_owned(), met);
        let words = account.left_out_in_words();
        assert!(
            words.ends_with("by at least 0.1 in some of these figures, proved"),
            "{words}"
        );
        // A constraint that figures before were made with is met by those.
        let mut used = Account {
            equations: 3,
            ..Account::default()
        };
        used.join(&Account {
            left_out: vec![LeftOut {
                name: "C-D".to_owned(),
                why: Why::NothingNew,
                verdict: far,
            }],
            ..Account::default()
        });
        assert_eq!(used.left_out[0].verdict, Verdict::MissedBySome { by: 0.5 });
    }
}
