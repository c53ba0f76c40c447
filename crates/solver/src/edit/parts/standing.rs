//! What becomes of the constraints that a sketch has too many of: whether they follow from the others or contradict them.

use super::left_out::at_rest_all;
use super::{Parts, Used};
use crate::edit::open::OpenError;
use crate::edit::session::{Standing, TooMany};
use crate::interval::Real;
use crate::track::Control;

impl Parts {
    /// Leads the sketch to its dimensions, as edits begin, and looks at what was left out. `rights`: see [`Parts::assemble`].
    pub fn standing(&mut self, rights: &[Vec<Real>], control: &mut Control) -> Standing {
        let at_rest = at_rest_all(rights);
        let count = self.cut.redundant.len();
        let contradicts = (0..count).find(|&k| self.is_contradiction(k, &at_rest));
        let contradict = |parts: &Self, k: usize, is_proved: bool| TooMany::Contradict {
            name: parts.cut.name(parts.cut.left_out(k).index),
            is_proved,
        };
        if let Some(k) = contradicts {
            return Standing {
                is_taken: false,
                too_many: contradict(self, k, true),
            };
        }
        let all_proved = self.proved.iter().all(|&proved| proved);
        let led = self.lead(rights, control);
        let is_taken = led.is_ok();
        let broken = match led {
            Err(OpenError::Correction { ending, .. }) if ending.is_contradiction() => {
                self.missed(&self.verdicts).map(|(k, _)| k)
            }
            _ => None,
        };
        let too_many = match broken {
            _ if count == 0 => TooMany::None,
            // At a singular drawing what is left out need not be what is one too many.
            Some(_) if self.cut.singular.is_some() => TooMany::Undecided,
            Some(k) => contradict(self, k, false),
            None if all_proved => TooMany::Follow,
            None => TooMany::Undecided,
        };
        Standing { is_taken, too_many }
    }

    /// Whether an equation that was left out fails wherever the others hold: it is a combination of these, and its right-hand
    /// side is not. What is held only because nothing determines it says nothing of that.
    fn is_contradiction(&self, redundant: usize, rights: &[Vec<Real>]) -> bool {
        let Some(Some(how)) = self.follows.get(redundant) else {
            return false;
        };
        let is_held = |i: &usize| matches!(self.cut.used[*i], Used::Held(_));
        if how.sum.iter().map(|(i, _)| i).chain(&how.kept).any(is_held) {
            return false;
        }
        let row = self.cut.left_out(redundant);
        let of = |i: usize| self.rights_of(self.cut.used[i], rights);
        how.fails(&rights[row.index], of, |k| self.given[k].constant())
    }
}
