//! All figures of a sketch in its own frame that its blocks give, one after the other.
//!
//! A block is solved with the blocks that it needs where they are. A block of linear equations, of one unknown, or of two
//! that are like circles and lines, is solved by formula: all its solutions, in intervals. Of any other block the path is
//! followed, with the numbers of blocks before going linearly from the sketch to where they are; these are known up to an
//! interval, and what is proved holds for each number in it, so for the exact one.
//!
//! # What is proved
//!
//! By induction over the blocks: the box of a figure holds exactly one figure that meets all equations that are used. For
//! the numbers of a block are proved to be alone in their box for the exact numbers of the blocks before, which are alone in
//! theirs. And where no block was in doubt, there is no other figure but those that have, in a block that was
//! followed, numbers that are not on its path, those in which the difference of two coordinates has another sign
//! than in the sketch where a block says its size alone (a distance along an axis), and those of the cases that a kind of constraint leaves open
//! (sides, senses) which the sketch is not in. Constraints that only seem to follow from the others are left out: figures miss them by as
//! much as is said.

mod first;
mod parts;
mod search;
mod senses;

use super::cut::Cut;
use super::number::Number;
use super::singular::Singular;
use super::{Account, Verdict};
use crate::interval::{Interval, point};
use crate::places::array;
use crate::problem::Problem;
use crate::system::Located;
use crate::track::{Control, Options};
use parts::{may_be_reversed, parts_of, vanishes, verdict};
use search::Search;
use serde::{Deserialize, Serialize};

pub use first::{First, WithSenses};
pub use senses::{Comparison, Sense};

/// How the solutions of a block are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// By formula: they are all.
    Formula,
    /// On its path.
    Path,
}

/// What became of a block, over all solutions of those that it needs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BlockAccount {
    /// The names of its unknowns.
    pub unknowns: Vec<String>,
    /// How it was solved.
    pub way: Way,
    /// How often: for so many figures of the blocks that it needs.
    pub runs: usize,
    /// The fewest and the most solutions of a run.
    pub solutions: (usize, usize),
    /// Tubes of all runs.
    pub tubes: usize,
    /// Why a run did not find all that it looks for, where one did not.
    pub doubt: Option<String>,
}

/// A solution of a block, by their places.
pub type Chosen = (usize, usize);

/// A figure of a part.
#[derive(Debug)]
struct Figure {
    chosen: Vec<Chosen>,
    numbers: Vec<(usize, Number)>,
}

/// The figures of a sketch in its own frame, block by block.
#[derive(Debug)]
pub struct Figures {
    cut: Cut,
    /// Numbers that are the same in all figures.
    fixed: Vec<Option<Number>>,
    /// The figures of each part that has several, or none.
    parts: Vec<Vec<Figure>>,
    /// The blocks that have to be solved, with their accounts.
    accounts: Vec<(usize, BlockAccount)>,
    account: Account,
    /// What was left out and does not follow, with how many figures of a part were not taken because they miss it.
    refused: Vec<(String, usize)>,
    /// Whether there were too many to look at all.
    truncated: bool,
    /// Whether of a distance along an axis one direction was taken of two.
    keeps_directions: bool,
    /// Figures of a part that were not taken because something has no direction in them.
    vanished: Option<String>,
    /// What constraints leave open and the sketch has; `None` if that is too much to look at.
    senses: Option<Vec<Sense>>,
}

impl Figures {
    /// Looks for the figures of a problem in its own frame, which need not be well constrained.
    ///
    /// ```
    /// use krawl::blocks::Figures;
    /// use krawl::import;
    /// use krawl::track::{Control, Options};
    /// # std::env::set_current_dir("../..").unwrap();
    /// let bytes = std::fs::read("problems/sketches/bracket.slvs").unwrap();
    /// let bracket = import::read("bracket.slvs", &bytes, None).unwrap().problem;
    /// let found = Figures::find(&bracket, &Options::certified(), &mut Control::default()).unwrap();
    /// assert!(found.doubt().is_none());
    /// assert_eq!(found.count(), Some(4));
    /// let (points, _) = found.figure(0);
    /// assert_eq!(points.len(), bracket.points.len());
    /// ```
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn find(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, String> {
        let cut = Cut::new(problem)?;
        if cut.has_twins {
            return Err(
                "a line or plane of its own has a direction, which is the same figure with either sign; figures with \
                 such directions are not counted block by block (name two points of the line instead)"
                    .to_owned(),
            );
        }
        if let Some(object) = problem.fixed_directions().next() {
            let object = &problem.objects[object].name;
            return Err(format!(
                "`{object}` is fixed and has a direction of its own, of which one component is told by the length only; figures \
                 with such directions are not counted block by block (name two fixed points of it instead)"
            ));
        }
        let count = cut.blocks.blocks.len();
        let mut fixed: Vec<Option<Number>> = vec![None; cut.system.unknowns.len()];
        let mut is_fixed = vec![false; count];
        let mut search = Search::new(&cut, options, control);
        for b in 0..count {
            let needs = &cut.blocks.blocks[b].needs;
            for &need in needs.iter().filter(|&&need| !is_fixed[need]) {
                let mut all = search.ancestors[need].clone();
                all.insert(need);
                search.ancestors[b].extend(all);
            }
            if !search.ancestors[b].is_empty() {
                continue;
            }
            let found = search.solve(b, Vec::new(), &fixed);
            if let [only] = found.as_slice() {
                let unknowns = &cut.blocks.blocks[b].unknowns;
                for (&u, number) in unknowns.iter().zip(only) {
                    fixed[u] = Some(number.clone());
                }
                is_fixed[b] = true;
            }
        }
        search.moving = (0..count).filter(|&b| !is_fixed[b]).collect();
        let follow = cut.proved_redundant();
        let mut refused = vec![0; follow.len()];
        let mut verdicts: Vec<Verdict> = follow
            .iter()
            .map(|follows| match follows {
                true => Verdict::Follows,
                false => Verdict::NotLookedAt,
            })
            .collect();
        let mut vanished = None;
        let mut parts: Vec<Vec<Figure>> = Vec::new();
        for part in parts_of(&cut, &is_fixed) {
            let mut values = fixed.clone();
            let mut figures = Vec::new();
            search.enumerate(&part.blocks, &mut Vec::new(), &mut values, &mut figures);
            let mut values = fixed.clone();
            figures.retain(|figure| {
                for (u, number) in &figure.numbers {
                    values[*u] = Some(number.clone());
                }
                for &v in &part.vectors {
                    match vanishes(&cut, v, &values) {
                        Some(false) => {}
                        // Then it is no figure.
                        Some(true) => return false,
                        None => {
                            vanished = Some(cut.system.nonzero[v].name.clone());
                            return false;
                        }
                    }
                }
                let rows = part.rows.iter().filter(|&&k| !follow[k]);
                let found =
                    rows.map(|&k| (k, verdict(&cut, k, &values, options.redundant_tolerance)));
                let found: Vec<(usize, Verdict)> = found.collect();
                if let Some((k, _)) = found.iter().find(|(_, verdict)| verdict.is_missed()) {
                    refused[*k] += 1;
                    return false;
                }
                for (k, verdict) in found {
                    verdicts[k] = verdicts[k].and(verdict);
                }
                true
            });
            let numbers: Vec<_> = figures.iter().map(|figure| &figure.numbers[..]).collect();
            if may_be_reversed(&cut, &fixed, &numbers) {
                return Err(
                    "two figures may differ in nothing but the direction of a line or plane of its own, and be one; \
                     such figures are not counted block by block (name two points of the line instead)"
                        .to_owned(),
                );
            }
            parts.push(figures);
        }
        let (mut accounts, truncated) = (search.accounts, search.truncated);
        let keeps_directions = search.keeps_directions;
        let order = (0..count).filter(|&b| !cut.is_exact[b]);
        let accounts = order
            .filter_map(|b| Some((b, accounts.remove(&b)?)))
            .collect();
        let refused = refused.into_iter().zip(&cut.redundant);
        let refused = refused.map(|(n, &row)| (cut.name(cut.system.rows[row].index), n));
        Ok(Figures {
            refused: refused.collect(),
            account: cut.account(|u| cut.system.values[u].enclose(), |k| verdicts[k]),
            fixed,
            parts,
            accounts,
            truncated,
            keeps_directions,
            vanished,
            senses: senses::senses(&cut),
            cut,
        })
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.cut.problem
    }

    /// The blocks that have to be solved, in an order in which each needs only those before, with what became of them.
    pub fn blocks(&self) -> impl Iterator<Item = &BlockAccount> {
        self.accounts.iter().map(|(_, account)| account)
    }

    /// What it is proved of: what nothing determines is held where it is drawn, and what says nothing new at the sketch was
    /// left out, with how the figures listed stand to it.
    pub fn account(&self) -> &Account {
        &self.account
    }

    /// Where the drawing was singular, though figures near it are not: what was so about it, and how far it was moved off that
    /// place.
    pub fn singular(&self) -> Option<&Singular> {
        self.cut.singular.as_ref()
    }

    /// Constraints that were left out and how many figures of a part were not taken because they are proved to miss it.
    pub fn refused(&self) -> impl Iterator<Item = (&str, usize)> {
        let refused = self.refused.iter().filter(|(_, n)| *n > 0);
        refused.map(|(name, n)| (name.as_str(), *n))
    }

    /// How many figures there are; `None` where that has no place in 64 bits.
    pub fn count(&self) -> Option<u64> {
        let mut numbers = self.parts.iter().map(|part| part.len() as u64);
        if self.parts.iter().any(Vec::is_empty) {
            return Some(0);
        }
        numbers.try_fold(1u64, |product, n| product.checked_mul(n))
    }

    /// Why there may be more figures than are listed, if there may.
    pub fn doubt(&self) -> Option<String> {
        let of_block = self
            .accounts
            .iter()
            .enumerate()
            .find_map(|(k, (_, account))| {
                let doubt = account.doubt.as_ref()?;
                Some(format!("block {}: {doubt}", k + 1))
            });
        let of_vector = self.vanished.as_ref().map(|name| {
            format!("whether {name} has a length, without which its direction says nothing, is not certain in a figure that was left out")
        });
        let of_number = self
            .truncated
            .then(|| "there are too many to look at all of them".to_owned());
        of_block.or(of_vector).or(of_number)
    }

    /// The first block, counted from 1, that has no solution for any figure of those before it.
    pub fn impossible(&self) -> Option<usize> {
        let mut accounts = self.accounts.iter();
        accounts
            .position(|(_, account)| account.solutions.1 == 0)
            .map(|k| k + 1)
    }

    /// Whether some block was followed along its path, so that others of its solutions may be elsewhere.
    pub fn has_paths(&self) -> bool {
        self.blocks().any(|account| account.way == Way::Path)
    }

    /// Whether every constraint is proved to be met: none was left out but those that follow from the others.
    pub fn meets_all(&self) -> bool {
        self.account.meets_all()
    }

    /// Whether it is proved that there are no others.
    pub fn is_complete(&self) -> bool {
        self.doubt().is_none() && !self.has_paths() && self.meets_all()
    }

    /// Whether there are constraints whose words leave more than one case open (docs/using/problem-files.md): sides of lines and
    /// tangency from outside or inside, of which the sketch's is taken; angles, of which the size counts; and directions
    /// that agree, as of tangents at a shared end, which may go on or come back.
    pub fn has_cases(&self) -> bool {
        const OPEN: [&str; 8] = [
            "angles",
            "distances",
            "tangent",
            "equal_angles",
            "equal_distances",
            "along",
            "parallel",
            "perpendicular",
        ];
        let mut constraints = self.cut.problem.constraints.iter();
        constraints.any(|c| OPEN.contains(&c.kind.as_str()))
    }

    /// Whether of a distance along an axis only the direction was taken that the sketch has.
    pub fn keeps_directions(&self) -> bool {
        self.keeps_directions
    }

    /// What the figure of this number is made of: blocks of several solutions (by their place in [`Figures::blocks`])
    /// with the solution taken. Numbers begin with 0, the figure that the sketch moves to.
    pub fn chosen(&self, number: u64) -> Vec<Chosen> {
        let place = |block: usize| self.accounts.iter().position(|(b, _)| *b == block);
        let figures = self.figures_of(number);
        let chosen = figures.flat_map(|figure| figure.chosen.iter());
        let mut chosen: Vec<Chosen> = chosen
            .filter_map(|&(block, solution)| Some((place(block)?, solution)))
            .filter(|&(place, _)| self.accounts[place].1.solutions.1 > 1)
            .collect();
        chosen.sort_unstable();
        chosen
    }

    /// The senses that constraints leave open and the sketch has: which way angles turn, whether directions of parallels
    /// and tangents agree, on which side of each other points joined by distances are. `None`: there are too many to look
    /// at.
    pub fn senses(&self) -> Option<&[Sense]> {
        self.senses.as_deref()
    }

    /// How each of the [`Figures::senses`] of a figure stands to that of the sketch, with proof.
    ///
    /// # Panics
    /// If there are not so many figures.
    pub fn compared(&self, number: u64) -> Vec<Comparison> {
        let values = self.values(number);
        let senses = self.senses.iter().flatten();
        senses
            .map(|sense| sense.compare(&self.cut, &values))
            .collect()
    }

    fn figures_of(&self, mut number: u64) -> impl Iterator<Item = &Figure> {
        self.parts.iter().rev().map(move |part| {
            let n = part.len() as u64;
            let figure = &part[(number % n) as usize];
            number /= n;
            figure
        })
    }

    fn values(&self, number: u64) -> Vec<Option<Number>> {
        let mut values = self.fixed.clone();
        for figure in self.figures_of(number) {
            for (u, number) in &figure.numbers {
                values[*u] = Some(number.clone());
            }
        }
        values
    }

    /// The boxes of all points of a figure, in the problem's own coordinates, and where its objects are.
    ///
    /// # Panics
    /// If there are not so many figures.
    pub fn figure(&self, number: u64) -> (Vec<[Interval; 3]>, Vec<Located>) {
        let values = self.values(number);
        let d = self.cut.problem.dimension;
        let at = |u: usize| {
            let number = values[u].as_ref().expect("a figure has all numbers");
            number.enclosure()
        };
        let points = (0..self.cut.problem.points.len()).map(|p| {
            array(|axis| match axis < d {
                true => at(self.cut.system.coordinates[p * d + axis]),
                false => point(0.0),
            })
        });
        let points: Vec<[Interval; 3]> = points.collect();
        let (problem, told) = (&self.cut.problem, &self.cut.told);
        let objects = self.cut.system.locate(problem, told, &points, 1.0, &at);
        (points, objects)
    }
}
