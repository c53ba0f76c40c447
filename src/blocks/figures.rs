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
//! followed, numbers that are not on its path, and those in which the difference of two coordinates has another sign
//! than in the sketch where a block says its size alone (a distance along an axis).

use super::Row;
use super::cut::{Cut, Used};
use super::formula::{self, Solved};
use super::local::{Local, is_square};
use super::number::Number;
use super::path;
use crate::constraint::{Entry, Form, Role, product};
use crate::interval::{Interval, point};
use crate::problem::Problem;
use crate::track::{Control, Options};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;
use std::sync::atomic::Ordering;

/// Tubes of all paths together, at most, or nearly so.
const MOST_TUBES: usize = 15_000;
/// Figures of a part that are looked at, at most.
const MOST_OF_PART: usize = 2000;
/// Constraints that seem to follow from others may be missed by so much, relative to the sketch's unit: sketches that say
/// a thing twice do so to the digits that they store.
const MISSED: f64 = 1e-7;

/// How the solutions of a block are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// By formula: they are all.
    Formula,
    /// On its path.
    Path,
}

/// What became of a block, over all solutions of those that it needs.
#[derive(Debug, Clone)]
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

/// A constraint that was left out because it seems to follow from the others at the sketch.
#[derive(Debug, Clone)]
pub struct LeftOut {
    /// What people call it.
    pub name: String,
    /// Whether it is proved to hold wherever the others do.
    pub follows: bool,
    /// Otherwise by how much a figure that is listed misses it at most, in its own unit.
    pub missed: f64,
    /// How many figures of a part were not taken because they do not meet it.
    pub refused: usize,
}

/// A solution of a block, by their places.
pub type Chosen = (usize, usize);

/// The solutions of a block for some figure of those before.
#[derive(Debug)]
struct Found {
    solutions: Vec<Vec<Number>>,
}

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
    left_out: Vec<LeftOut>,
    /// Whether there were too many to look at all.
    truncated: bool,
    /// Whether of a distance along an axis one direction was taken of two.
    keeps_directions: bool,
    /// Figures of a part that were not taken because something has no direction in them.
    vanished: Option<String>,
}

/// What goes on while figures are looked for.
struct Search<'a, 'c> {
    cut: &'a Cut,
    options: &'a Options,
    control: &'a mut Control<'c>,
    /// For each block those before that it needs, directly or not, and that are not fixed.
    ancestors: Vec<BTreeSet<usize>>,
    known: HashMap<(usize, Vec<Chosen>), Rc<Found>>,
    accounts: HashMap<usize, BlockAccount>,
    tubes: usize,
    truncated: bool,
    keeps_directions: bool,
}

impl Figures {
    /// Looks for the figures of a problem in its own frame, which need not be well constrained.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn find(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, String> {
        let cut = Cut::new(problem)?;
        let count = cut.blocks.blocks.len();
        let mut fixed: Vec<Option<Number>> = vec![None; cut.system.unknowns.len()];
        let mut is_fixed = vec![false; count];
        let mut search = Search {
            cut: &cut,
            options,
            control,
            ancestors: vec![BTreeSet::new(); count],
            known: HashMap::new(),
            accounts: HashMap::new(),
            tubes: 0,
            truncated: false,
            keeps_directions: false,
        };
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
            if let [only] = found.solutions.as_slice() {
                let unknowns = &cut.blocks.blocks[b].unknowns;
                for (&u, number) in unknowns.iter().zip(only) {
                    fixed[u] = Some(number.clone());
                }
                is_fixed[b] = true;
            }
        }
        let follow = cut.proved_redundant();
        let mut left_out: Vec<LeftOut> = cut
            .redundant
            .iter()
            .zip(follow)
            .map(|(&row, follows)| LeftOut {
                name: cut.name(cut.system.rows[row].index),
                follows,
                missed: 0.0,
                refused: 0,
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
                if let Some(name) = part.vectors.iter().find(|&&v| may_vanish(&cut, v, &values)) {
                    vanished = Some(cut.system.nonzero[*name].name.clone());
                    return false;
                }
                part.rows
                    .iter()
                    .all(|&k| is_met(&cut, k, &values, &mut left_out[k]))
            });
            parts.push(figures);
        }
        let (mut accounts, truncated) = (search.accounts, search.truncated);
        let keeps_directions = search.keeps_directions;
        let order = (0..count).filter(|&b| !cut.is_exact[b]);
        let accounts = order
            .filter_map(|b| Some((b, accounts.remove(&b)?)))
            .collect();
        Ok(Figures {
            fixed,
            parts,
            accounts,
            left_out,
            truncated,
            keeps_directions,
            vanished,
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

    /// The names of what nothing determines wholly: it is held where it is drawn.
    pub fn free(&self) -> Vec<String> {
        self.cut.free_names()
    }

    /// Constraints that were left out.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
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
            format!("a figure in which {name} has no length, so that its direction says nothing, was left out")
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

    /// The boxes of all points of a figure, in the problem's own coordinates, and the radii of circles by object.
    ///
    /// # Panics
    /// If there are not so many figures.
    pub fn figure(&self, number: u64) -> (Vec<[Interval; 3]>, Vec<Option<Interval>>) {
        let values = self.values(number);
        let d = self.cut.problem.dimension;
        let at = |u: usize| {
            let number = values[u].as_ref().expect("a figure has all numbers");
            number.enclosure()
        };
        let points = (0..self.cut.problem.points.len()).map(|p| {
            std::array::from_fn(|axis| match axis < d {
                true => at(self.cut.system.coordinates[p * d + axis]),
                false => point(0.0),
            })
        });
        let radii = self.cut.radii.iter().map(|u| u.map(at));
        (points.collect(), radii.collect())
    }
}

impl Search<'_, '_> {
    /// All figures of the blocks from here on.
    fn enumerate(
        &mut self,
        blocks: &[usize],
        chosen: &mut Vec<Chosen>,
        values: &mut Vec<Option<Number>>,
        out: &mut Vec<Figure>,
    ) {
        let Some((&b, rest)) = blocks.split_first() else {
            let numbers = chosen.iter().flat_map(|(b, _)| {
                let unknowns = self.cut.blocks.blocks[*b].unknowns.iter();
                unknowns.filter_map(|&u| Some((u, values[u].clone()?)))
            });
            let numbers = numbers.collect();
            out.push(Figure {
                chosen: chosen.clone(),
                numbers,
            });
            return;
        };
        let before = chosen.iter().copied();
        let before = before.filter(|(c, _)| self.ancestors[b].contains(c));
        let found = self.solve(b, before.collect(), values);
        for (k, solution) in found.solutions.iter().enumerate() {
            if out.len() >= MOST_OF_PART {
                self.truncated = true;
                return;
            }
            for (&u, number) in self.cut.blocks.blocks[b].unknowns.iter().zip(solution) {
                values[u] = Some(number.clone());
            }
            chosen.push((b, k));
            self.enumerate(rest, chosen, values, out);
            chosen.pop();
        }
    }

    /// The solutions of a block where those before it are chosen.
    fn solve(&mut self, b: usize, before: Vec<Chosen>, values: &[Option<Number>]) -> Rc<Found> {
        let key = (b, before);
        if let Some(found) = self.known.get(&key) {
            return Rc::clone(found);
        }
        let (way, solutions, doubt, tubes) = self.solve_anew(b, values);
        let (solutions, sign_in_doubt) = self.with_signs(b, solutions);
        let doubt = doubt.or(sign_in_doubt);
        let n = solutions.len();
        let cut = self.cut;
        let account = self.accounts.entry(b).or_insert_with(|| BlockAccount {
            unknowns: cut.unknowns_of(&cut.blocks.blocks[b]),
            way,
            runs: 0,
            solutions: (n, n),
            tubes: 0,
            doubt: None,
        });
        account.runs += 1;
        account.tubes += tubes;
        account.solutions = (account.solutions.0.min(n), account.solutions.1.max(n));
        if way == Way::Path {
            account.way = way;
        }
        if account.doubt.is_none() {
            account.doubt = doubt;
        }
        let found = Rc::new(Found { solutions });
        self.known.insert(key, Rc::clone(&found));
        found
    }

    fn solve_anew(
        &mut self,
        b: usize,
        values: &[Option<Number>],
    ) -> (Way, Vec<Vec<Number>>, Option<String>, usize) {
        let cut = self.cut;
        let block = &cut.blocks.blocks[b];
        let mut rows = Vec::with_capacity(block.equations.len());
        for &e in &block.equations {
            match cut.used[e] {
                Used::Held(u) => {
                    let held = vec![vec![Number::of(&cut.system.values[u])]];
                    return (Way::Formula, held, None, 0);
                }
                Used::Row(row) => rows.push(divided(cut, row, values)),
            }
        }
        let now = |u: usize| values[u].clone().expect("blocks before are known");
        let local: Vec<Local> = rows
            .iter()
            .map(|row| {
                let right = Number::of(&cut.at_target(row.index));
                Local::new(row, &block.unknowns, now, &right)
            })
            .collect();
        let sense = {
            let sketch = |u: usize| Number::of(&cut.system.values[u]);
            let zero = Number::halves(0);
            let rows = rows.iter();
            let rows = rows.map(|row| Local::new(row, &block.unknowns, sketch, &zero));
            let at = block.unknowns.iter().map(|&u| sketch(u).enclosure().mid());
            match block.unknowns.len() <= 2 {
                true => formula::sense_at(&rows.collect::<Vec<_>>(), &at.collect::<Vec<_>>()),
                false => None,
            }
        };
        match formula::solve(&local, sense) {
            Solved::All(mut solutions) => {
                // A distance along an axis: on the side where the sketch has it.
                if let [row] = rows.as_slice()
                    && is_square(row)
                    && sense.is_some()
                    && solutions.len() > 1
                {
                    let u = block.unknowns[0];
                    self.keeps_directions |= cut.system.unknowns[u].role != Role::Positive;
                    solutions.truncate(1);
                }
                return (Way::Formula, solutions, None, 0);
            }
            Solved::Doubt(why) => return (Way::Formula, Vec::new(), Some(why), 0),
            Solved::NoFormula => {}
        }
        let cancelled = self.control.cancel;
        if self.tubes >= MOST_TUBES || cancelled.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            self.truncated = true;
            return (Way::Path, Vec::new(), None, 0);
        }
        let run = path::follow(cut, b, values, self.options, self.control);
        self.tubes += run.tubes;
        (Way::Path, run.solutions, run.doubt, run.tubes)
    }

    /// Of solutions of a block those in which lengths and radii are positive.
    fn with_signs(
        &self,
        b: usize,
        mut solutions: Vec<Vec<Number>>,
    ) -> (Vec<Vec<Number>>, Option<String>) {
        let unknowns = &self.cut.blocks.blocks[b].unknowns;
        let mut doubt = None;
        solutions.retain(|solution| {
            unknowns.iter().zip(solution).all(|(&u, number)| {
                let unknown = &self.cut.system.unknowns[u];
                if unknown.role != Role::Positive {
                    return true;
                }
                if number.sign().is_none() {
                    doubt = Some(format!(
                        "whether {} is positive is not certain",
                        unknown.name
                    ));
                }
                number.sign() == Some(1)
            })
        });
        (solutions, doubt)
    }
}

/// Blocks whose figures hang together, in order, with what is to be looked at once all of them are known.
struct Part {
    blocks: Vec<usize>,
    /// Of the rows that were left out, by place.
    rows: Vec<usize>,
    /// Vectors that must not vanish, by place.
    vectors: Vec<usize>,
}

fn parts_of(cut: &Cut, is_fixed: &[bool]) -> Vec<Part> {
    let count = is_fixed.len();
    // One more, for what is about fixed numbers alone.
    let mut parent: Vec<usize> = (0..=count).collect();
    fn root(parent: &[usize], mut x: usize) -> usize {
        while parent[x] != x {
            x = parent[x];
        }
        x
    }
    fn join(parent: &mut [usize], of: &[usize]) -> usize {
        let Some(&first) = of.first() else {
            return parent.len() - 1;
        };
        for &b in of {
            let (a, b) = (root(parent, first), root(parent, b));
            parent[a.max(b)] = a.min(b);
        }
        first
    }
    for b in (0..count).filter(|&b| !is_fixed[b]) {
        let needs = cut.blocks.blocks[b].needs.iter().copied();
        let mut of: Vec<usize> = needs.filter(|&need| !is_fixed[need]).collect();
        of.push(b);
        join(&mut parent, &of);
    }
    let blocks_of = |unknowns: &[usize]| -> Vec<usize> {
        let of = unknowns.iter().map(|&u| cut.blocks.of_unknown[u]);
        of.filter(|&b| !is_fixed[b]).collect()
    };
    let rows = cut.redundant.iter();
    let rows: Vec<usize> = rows
        .map(|&row| join(&mut parent, &blocks_of(&cut.system.rows[row].unknowns)))
        .collect();
    let vectors = 0..cut.system.nonzero.len();
    let vectors: Vec<usize> = vectors
        .map(|v| join(&mut parent, &blocks_of(&unknowns_of_vector(cut, v))))
        .collect();
    let mut parts: Vec<(usize, Part)> = Vec::new();
    let mut part_of = |b: usize| -> usize {
        let root = root(&parent, b);
        let place = parts.iter().position(|(r, _)| *r == root);
        place.unwrap_or_else(|| {
            parts.push((
                root,
                Part {
                    blocks: Vec::new(),
                    rows: Vec::new(),
                    vectors: Vec::new(),
                },
            ));
            parts.len() - 1
        })
    };
    let of_blocks: Vec<(usize, usize)> = (0..count)
        .filter(|&b| !is_fixed[b])
        .map(|b| (b, part_of(b)))
        .collect();
    let of_rows: Vec<usize> = rows.into_iter().map(&mut part_of).collect();
    let of_vectors: Vec<usize> = vectors.into_iter().map(&mut part_of).collect();
    for (b, part) in of_blocks {
        parts[part].1.blocks.push(b);
    }
    for (k, part) in of_rows.into_iter().enumerate() {
        parts[part].1.rows.push(k);
    }
    for (v, part) in of_vectors.into_iter().enumerate() {
        parts[part].1.vectors.push(v);
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

fn unknowns_of_vector(cut: &Cut, vector: usize) -> Vec<usize> {
    let forms = cut.system.nonzero[vector].forms[..cut.problem.dimension].iter();
    let entries = forms.flat_map(|form| match *form {
        Form::One => [Entry::Zero; 2],
        Form::Difference(a, b) => [a, b],
    });
    entries
        .filter_map(|entry| match entry {
            Entry::Unknown(u) => Some(u),
            _ => None,
        })
        .collect()
}

fn side(form: Form, values: &[Option<Number>]) -> Number {
    let Form::Difference(a, b) = form else {
        return Number::halves(2);
    };
    let value = |entry: Entry| match entry {
        Entry::Unknown(u) => values[u].clone().expect("all numbers are known"),
        _ => Number::halves(0),
    };
    match a == b {
        true => Number::halves(0),
        false => value(a).minus(&value(b)),
    }
}

fn may_vanish(cut: &Cut, vector: usize, values: &[Option<Number>]) -> bool {
    let forms = cut.system.nonzero[vector].forms[..cut.problem.dimension].iter();
    forms
        .map(|&form| side(form, values))
        .all(|x| x.sign().is_none_or(|sign| sign == 0))
}

/// A row that says that a product is zero, and one factor of which cannot vanish in a figure, says so of the other factor:
/// the one is the only entry that is not zero of a vector that must not vanish, the direction of a line for one.
fn divided(cut: &Cut, row: usize, values: &[Option<Number>]) -> Row {
    let row = cut.system.rows[row].clone();
    let [single] = row.products.as_slice() else {
        return row;
    };
    if !cut.at_target(row.index).is_zero() {
        return row;
    }
    let is_zero = |form: Form| match form {
        Form::One => false,
        Form::Difference(a, b) => {
            let known = |entry: Entry| match entry {
                Entry::Unknown(u) => values[u].clone(),
                _ => Some(Number::halves(0)),
            };
            let both = known(a).zip(known(b));
            a == b || both.is_some_and(|(a, b)| a.minus(&b).is_zero())
        }
    };
    let is_same = |one: Form, other: Form| match (one, other) {
        (Form::Difference(a, b), Form::Difference(c, d)) => (a, b) == (c, d) || (a, b) == (d, c),
        _ => false,
    };
    let d = cut.problem.dimension;
    let cannot_vanish = |form: Form| {
        let mut vectors = cut.system.nonzero.iter();
        vectors.any(|vector| {
            let forms = &vector.forms[..d];
            forms.iter().any(|&f| is_same(f, form))
                && forms.iter().all(|&f| is_same(f, form) || is_zero(f))
        })
    };
    let left = match (cannot_vanish(single.left), cannot_vanish(single.right)) {
        (true, false) => single.right,
        (false, true) => single.left,
        _ => return row,
    };
    if left == Form::One {
        return row;
    }
    let products = vec![product(2, left, Form::One)];
    Row { products, ..row }
}

/// Whether a figure meets a constraint that was left out, as nearly as sketches do that say a thing twice.
fn is_met(cut: &Cut, k: usize, values: &[Option<Number>], account: &mut LeftOut) -> bool {
    if account.follows {
        return true;
    }
    let row = &cut.system.rows[cut.redundant[k]];
    let right = Number::of(&cut.at_target(row.index));
    let off = row
        .products
        .iter()
        .fold(Number::halves(0).minus(&right), |sum, p| {
            let product = side(p.left, values).times(&side(p.right, values));
            sum.plus(&Number::halves(p.factor.into()).times(&product))
        });
    let scale = cut.unit.powi(cut.powers[row.index]);
    let is_met = off.enclosure().mig() <= MISSED * scale;
    match is_met {
        true => account.missed = account.missed.max(off.enclosure().mag()),
        false => account.refused += 1,
    }
    is_met
}
