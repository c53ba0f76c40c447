//! The solutions of blocks, each with those before it where they are.

use super::{BlockAccount, Chosen, Figure, Way};
use crate::blocks::cut::{Cut, Used};
use crate::blocks::formula::{self, Solved};
use crate::blocks::local::{Local, is_square};
use crate::blocks::number::Number;
use crate::blocks::{Row, path};
use crate::constraint::{Entry, Role};
use crate::equations::Form;
use crate::system::Term;
use crate::track::{Control, Options};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;
use std::sync::atomic::Ordering;

/// Tubes of all paths together, at most, or nearly so.
const MOST_TUBES: usize = 15_000;
/// Figures of a part that are looked at, at most.
const MOST_OF_PART: usize = 2000;

/// The solutions of a block for some figure of those before.
type Solutions = Rc<Vec<Vec<Number>>>;

/// What goes on while figures are looked for.
pub(super) struct Search<'a, 'c> {
    pub cut: &'a Cut,
    pub options: &'a Options,
    pub control: &'a mut Control<'c>,
    /// For each block those before that it needs, directly or not, and that are not fixed.
    pub ancestors: Vec<BTreeSet<usize>>,
    /// The blocks whose numbers are not the same in all figures.
    pub moving: Vec<usize>,
    pub known: HashMap<(usize, Vec<Chosen>), Solutions>,
    pub accounts: HashMap<usize, BlockAccount>,
    pub tubes: usize,
    pub truncated: bool,
    pub keeps_directions: bool,
}

impl<'a, 'c> Search<'a, 'c> {
    pub fn new(cut: &'a Cut, options: &'a Options, control: &'a mut Control<'c>) -> Self {
        Search {
            ancestors: vec![BTreeSet::new(); cut.blocks.blocks.len()],
            cut,
            options,
            control,
            moving: Vec::new(),
            known: HashMap::new(),
            accounts: HashMap::new(),
            tubes: 0,
            truncated: false,
            keeps_directions: false,
        }
    }

    /// All figures of the blocks from here on.
    pub fn enumerate(
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
        for (k, solution) in found.iter().enumerate() {
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
    pub fn solve(&mut self, b: usize, before: Vec<Chosen>, values: &[Option<Number>]) -> Solutions {
        let key = (b, before);
        if let Some(found) = self.known.get(&key) {
            return Rc::clone(found);
        }
        // Only the numbers that the block needs: what is found is kept for all figures with these.
        let mut needed = values.to_vec();
        let others = self
            .moving
            .iter()
            .filter(|c| !self.ancestors[b].contains(c));
        for &other in others {
            let unknowns = self.cut.blocks.blocks[other].unknowns.iter();
            unknowns.for_each(|&u| needed[u] = None);
        }
        let (way, solutions, doubt, tubes) = self.solve_anew(b, &needed);
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
        let found = Rc::new(solutions);
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
            let at = block.unknowns.iter().map(|&u| sketch(u));
            match block.unknowns.len() <= 2 {
                true => formula::sense_at(&rows.collect::<Vec<_>>(), &at.collect::<Vec<_>>()),
                false => None,
            }
        };
        match formula::solve(&local, sense) {
            Solved::All(mut solutions) => {
                // A distance along an axis: on the side where the sketch has it, if it is certain which of the two that
                // is; otherwise both.
                if let [row] = rows.as_slice()
                    && is_square(row)
                    && !is_number(cut, block.unknowns[0])
                    && let Some(sense) = sense
                    && let [first, second] = solutions.as_slice()
                    && formula::sense_at(&local, first) == Some(sense)
                    && formula::sense_at(&local, second) == Some(-sense)
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

/// Whether an unknown is a number that has no direction: both signs of it are solutions.
fn is_number(cut: &Cut, unknown: usize) -> bool {
    let of = &cut.system.unknowns[unknown];
    of.role == Role::Free && !of.flips.contains(&true) && !cut.system.coordinates.contains(&unknown)
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
    let is_zero = |form: Form<Option<usize>>| match form {
        Form::One => false,
        Form::Difference(a, b) => {
            let known = |entry: Option<usize>| {
                entry.map_or_else(|| Some(Number::halves(0)), |u| values[u].clone())
            };
            let both = known(a).zip(known(b));
            a == b || both.is_some_and(|(a, b)| a.minus(&b).is_zero())
        }
    };
    let is_same = |one: Form<Option<usize>>, other| match (one, other) {
        (Form::Difference(a, b), Form::Difference(c, d)) => (a, b) == (c, d) || (a, b) == (d, c),
        _ => false,
    };
    let d = cut.problem.dimension;
    let cannot_vanish = |form: Form<Option<usize>>| {
        let mut vectors = cut.system.nonzero.iter();
        vectors.any(|vector| {
            let forms = vector.forms[..d]
                .iter()
                .map(|form| form.map(Entry::unknown));
            let forms: Vec<_> = forms.collect();
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
    let products = vec![Term::new(2, left, Form::One)];
    Row { products, ..row }
}
