//! How many figures have all senses of the sketch, and which of these is the nearest to it.
//!
//! Parts of a sketch with a sense in common make a group. A figure has all senses of the sketch if each group has its own, and
//! the square of its distance from the sketch is the sum over groups: so groups are looked at one after the other.

use super::senses::Comparison;
use super::{Figures, Number};
use crate::interval::{Interval, point};
use crate::order::each_once;
use crate::sets::Joined;

/// Choices of figures of the parts of a group that are looked at, at most.
const MOST: usize = 4000;

/// The figure nearest to the sketch of those with all its senses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum First {
    /// There is one.
    Figure {
        /// Its number.
        number: u64,
        /// Whether it is proved that no other one listed that is proved to have all senses is as near.
        is_nearest: bool,
    },
    /// No figure listed is proved to have all senses of the sketch.
    None {
        /// Whether it is proved that none of them has.
        is_proved: bool,
    },
    /// There are too many figures or senses to look at all.
    TooMany,
}

/// How many figures have all senses of the sketch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WithSenses {
    /// Proved to have all.
    pub proved: u64,
    /// None of their senses is proved to be another, but for some that is not certain.
    pub undecided: u64,
}

/// Parts with senses in common, and what becomes of them.
struct Group {
    /// Parts, by place.
    parts: Vec<usize>,
    /// Choices with all senses of the sketch: a figure of each part, and the square of how far they are from the sketch.
    kept: Vec<(Vec<usize>, Interval)>,
    /// Choices of which that is not certain.
    undecided: u64,
}

impl Figures {
    /// How many figures are proved to have all senses of the sketch; `None` where there are too many to look at.
    pub fn with_senses(&self) -> Option<WithSenses> {
        let groups = self.groups()?;
        let of = |number: &dyn Fn(&Group) -> u64| {
            let mut numbers = groups.iter().map(number);
            numbers.try_fold(1u64, |product, n| product.checked_mul(n))
        };
        let proved = of(&|group| group.kept.len() as u64)?;
        let possible = of(&|group| group.kept.len() as u64 + group.undecided)?;
        Some(WithSenses {
            proved,
            undecided: possible - proved,
        })
    }

    /// The figure nearest to the sketch of those that are proved to have all its senses.
    pub fn first(&self) -> First {
        let (Some(groups), Some(_)) = (self.groups(), self.count()) else {
            return First::TooMany;
        };
        if groups.iter().any(|group| group.kept.is_empty()) {
            let mut groups = groups.iter();
            return First::None {
                is_proved: groups.any(|group| group.kept.is_empty() && group.undecided == 0),
            };
        }
        let mut of_part = vec![0; self.parts.len()];
        let mut is_nearest = true;
        for group in &groups {
            let by_middle = |a: &&(Vec<usize>, Interval), b: &&(Vec<usize>, Interval)| {
                a.1.mid().total_cmp(&b.1.mid())
            };
            let kept = || group.kept.iter();
            let best = kept().min_by(by_middle).expect("it is not empty");
            // Which one is taken is a choice; that it is the nearest is said where the bounds tell.
            is_nearest &= kept().all(|one| one.0 == best.0 || best.1.sup() < one.1.inf());
            for (&part, &figure) in group.parts.iter().zip(&best.0) {
                of_part[part] = figure;
            }
        }
        let number = self
            .parts
            .iter()
            .zip(&of_part)
            .fold(0u64, |number, (part, &k)| {
                number * part.len() as u64 + k as u64
            });
        First::Figure { number, is_nearest }
    }

    /// The groups, each looked at; `None` where one has too many choices, or there are too many senses. What depends on
    /// numbers that are the same in all figures is in the first group, with no parts of its own.
    fn groups(&self) -> Option<Vec<Group>> {
        let senses = self.senses()?;
        let mut part_of = vec![None; self.fixed.len()];
        for (k, part) in self.parts.iter().enumerate() {
            for (u, _) in part.first().iter().flat_map(|figure| &figure.numbers) {
                part_of[*u] = Some(k);
            }
        }
        if self.parts.iter().any(Vec::is_empty) {
            return Some(vec![Group {
                parts: Vec::new(),
                kept: Vec::new(),
                undecided: 0,
            }]);
        }
        let parts_of = |unknowns: &[usize]| each_once(unknowns.iter().filter_map(|&u| part_of[u]));
        // Which group each part is in, by a part of it.
        let mut group_of = Joined::new(self.parts.len());
        for sense in senses {
            group_of.join_all(&parts_of(&sense.unknowns));
        }
        let group_of_sense = |unknowns: &[usize]| {
            let parts = parts_of(unknowns);
            parts.first().map(|&part| group_of.of(part))
        };
        let fixed = (None, Vec::new());
        let groups = (0..self.parts.len()).filter(|&k| group_of.of(k) == k);
        let groups = groups.map(|k| {
            let parts = (0..self.parts.len()).filter(|&part| group_of.of(part) == k);
            (Some(k), parts.collect::<Vec<usize>>())
        });
        let groups = std::iter::once(fixed).chain(groups);
        groups
            .map(|(of, parts)| {
                let own: Vec<usize> = (0..senses.len())
                    .filter(|&s| group_of_sense(&senses[s].unknowns) == of)
                    .collect();
                self.looked_at(parts, &own)
            })
            .collect()
    }

    fn looked_at(&self, parts: Vec<usize>, own: &[usize]) -> Option<Group> {
        let numbers = parts.iter().map(|&part| self.parts[part].len());
        let count = numbers.clone().try_fold(1usize, usize::checked_mul);
        let count = count.filter(|&count| count <= MOST)?;
        let senses = self.senses()?;
        let weights = self.weights();
        let mut values = self.fixed.clone();
        let (mut kept, mut undecided) = (Vec::new(), 0);
        for choice in 0..count {
            let mut left = choice;
            let mut chosen = Vec::with_capacity(parts.len());
            let mut squared = point(0.0);
            for (&part, number) in parts.iter().zip(numbers.clone()) {
                chosen.push(left % number);
                let figure = &self.parts[part][left % number];
                left /= number;
                for (u, number) in &figure.numbers {
                    values[*u] = Some(number.clone());
                    if weights[*u] > 0 {
                        let sketch = Number::of(self.cut.drawn_at(*u)).enclosure();
                        let off = number.enclosure() - sketch;
                        squared += point(weights[*u] as f64) * off.sqr();
                    }
                }
            }
            let mut is_certain = true;
            let all = own
                .iter()
                .all(|&s| match senses[s].compare(&self.cut, &values) {
                    Comparison::Same => true,
                    Comparison::Undecided => {
                        is_certain = false;
                        true
                    }
                    Comparison::Other | Comparison::Flat => false,
                });
            match (all, is_certain) {
                (true, true) => kept.push((chosen, squared)),
                (true, false) => undecided += 1,
                (false, _) => {}
            }
        }
        Some(Group {
            parts,
            kept,
            undecided,
        })
    }

    /// For each unknown of how many coordinates of points it is the value.
    fn weights(&self) -> Vec<usize> {
        let mut out = vec![0; self.fixed.len()];
        for &u in &self.cut.system.coordinates {
            out[u] += 1;
        }
        out
    }
}
