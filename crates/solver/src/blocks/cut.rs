//! A sketch in its own frame: merged, made square, and cut into blocks.

use super::drawn::{Drawn, Floats, look};
use super::follows::{Combination, Given, combination};
use super::singular::Singular;
use super::whose::Whose;
use super::{Account, Block, Blocks, COARSE, Choice, Held, Row, Ruler, System, Verdict};
use crate::constraint::{
    Entry, Fault, Lowered, Owner, Posed, Record, Role, Tail, own_number, try_lower_all,
    try_lower_all_apart,
};
use crate::equations::Form;
use crate::interval::{Interval, Real};
use crate::problem::{Decimal, Problem};
use crate::system::typical_length;

/// An equation of the square system.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Used {
    /// A row of the merged system, by position.
    Row(usize),
    /// An unknown stays what it is.
    Held(usize),
}

/// A sketch in its own frame, and the blocks that it falls into. It need not have as many equations as unknowns: what
/// nothing determines is held where it is drawn, what follows from other constraints at the figure is left out.
#[derive(Debug, Clone)]
pub(crate) struct Cut {
    /// The problem, without a bend.
    pub problem: Problem,
    /// Its equations in unknowns of which no two are said to be equal.
    pub system: System,
    /// The equations of the square system.
    pub used: Vec<Used>,
    /// The rows that were left out, by position.
    pub redundant: Vec<usize>,
    /// The unknowns that are held.
    pub free: Vec<usize>,
    /// The blocks of the square system.
    pub blocks: Blocks,
    /// For each block whether it is one linear equation in numbers known exactly.
    pub is_exact: Vec<bool>,
    /// The right-hand sides of the problem's equations, from the sketch at t = 0 to the dimensions at t = 1.
    pub rights: Vec<Vec<Real>>,
    /// The power of the unit of length of each of the problem's equations.
    pub powers: Vec<i32>,
    /// For each object its own unknowns, and of bodies with joints how these tell where they are.
    pub told: (Vec<Vec<Entry>>, Vec<Posed>),
    /// For each object the unknown that is its radius, if it is a circle, or its value, if it is a number.
    pub numbers: Vec<Option<usize>>,
    /// Of each line and plane of its own the unknowns that stay where it is reversed, and those that change their signs.
    pub own: Vec<[Vec<usize>; 2]>,
    /// What edits of it begin with.
    pub record: Record,
    /// A power of two near the mean length.
    pub unit: f64,
    /// Whose equation each of the problem's is.
    pub owners: Vec<Whose>,
    /// Whether the same figure has several solutions, as with a line or plane of its own, whose direction has two signs.
    pub has_twins: bool,
    /// Where the drawing is singular: what is so about it, and how far it was moved off that.
    pub singular: Option<Singular>,
    /// The values of the unknowns as they are drawn, where the drawing was moved.
    pub drawn: Option<Vec<Real>>,
}

/// Whether the same figure has several solutions that differ in signs of unknowns: in changes of sign of which none is that of
/// a length or radius, which is positive. That is so where some sum of the changes in the basis concerns none of these: by
/// elimination modulo 2.
fn has_twins(tail: &Tail) -> bool {
    let mut basis: Vec<Vec<bool>> = Vec::new();
    for twin in &tail.twins {
        let changes = twin.iter().zip(&tail.unknowns);
        let positive = changes.filter(|(_, unknown)| unknown.role == Role::Positive);
        let mut row: Vec<bool> = positive.map(|(&change, _)| change).collect();
        for other in &basis {
            let first = other.iter().position(|&change| change);
            if first.is_some_and(|k| row[k]) {
                row.iter_mut().zip(other).for_each(|(a, b)| *a ^= b);
            }
        }
        if !row.contains(&true) {
            return true;
        }
        basis.push(row);
    }
    false
}

/// A problem without a bend and its equations, or what is at fault in words.
pub(crate) fn straight(problem: &Problem) -> Result<(Problem, Lowered), String> {
    let mut problem = problem.clone();
    problem.homotopy.bend_coefficient = Decimal::from(0);
    problem.homotopy.detour = Decimal::from(0);
    let lowered = try_lower_all(&problem, None).map_err(|fault| in_words(&problem, fault))?;
    Ok((problem, lowered))
}

/// The same, where equations are to be told apart: the numbers of distances are in no other equation, so that each can be left out by itself.
pub(crate) fn straight_apart(problem: &Problem) -> Result<(Problem, Lowered), String> {
    let (problem, lowered) = straight(problem)?;
    let apart = lowered.gives_lengths.then(|| apart(&problem));
    Ok((problem, apart.transpose()?.unwrap_or(lowered)))
}

fn apart(problem: &Problem) -> Result<Lowered, String> {
    try_lower_all_apart(problem).map_err(|fault| in_words(problem, fault))
}

/// What is at fault with a problem's equations, in words.
pub(crate) fn in_words(problem: &Problem, (owner, fault): (Owner, Fault)) -> String {
    match owner {
        Owner::Object(o) => format!("`{}`: {fault}", problem.objects[o].name),
        Owner::Constraint(c) => format!("`{}`: {fault}", problem.constraint_name(c)),
    }
}

/// The blocks of a square system of rows and of unknowns that are held. `None`: there are none, see [`Blocks::new`].
pub(crate) fn blocks_of(used: &[Used], system: &System) -> Option<Blocks> {
    let of = used.iter().map(|used| match *used {
        Used::Row(row) => system.rows[row].unknowns.clone(),
        Used::Held(u) => vec![u],
    });
    Blocks::new(&of.collect::<Vec<_>>(), system.unknowns.len()).ok()
}

/// The equations of a choice, and what is held in it.
pub(crate) fn square(choice: &Choice) -> Vec<Used> {
    let held = choice.free.iter().map(|&u| Used::Held(u));
    let used = choice.used.iter().map(|&row| Used::Row(row));
    used.chain(held).collect()
}

/// For each block whether it is one linear equation in numbers known exactly.
pub(crate) fn is_exact(blocks: &Blocks, used: &[Used], system: &System) -> Vec<bool> {
    let mut exact: Vec<bool> = Vec::with_capacity(blocks.blocks.len());
    for block in &blocks.blocks {
        let known = block.needs.iter().all(|&need| exact[need]);
        let is_linear = || match used[block.equations[0]] {
            Used::Held(u) => !matches!(system.values[u], Real::Within(_)),
            Used::Row(row) => {
                let mut products = system.rows[row].products.iter();
                products.all(|p| p.left == Form::One || p.right == Form::One)
            }
        };
        exact.push(known && block.unknowns.len() == 1 && is_linear());
    }
    exact
}

impl Cut {
    /// Merges, chooses and cuts. The error says what is wrong with the sketch.
    pub fn new(problem: &Problem) -> Result<Self, String> {
        Self::drawn(problem, 0)
    }

    /// The same; a singular drawing is moved off that place in one of several ways, two and two in opposite directions.
    pub fn drawn(problem: &Problem, way: u64) -> Result<Self, String> {
        let (problem, lowered) = straight(problem)?;
        let gives_lengths = lowered.gives_lengths;
        let cut = Self::of((problem, lowered), way)?;
        match gives_lengths && !cut.redundant.is_empty() {
            true => {
                let lowered = apart(&cut.problem)?;
                Self::of((cut.problem, lowered), way)
            }
            false => Ok(cut),
        }
    }

    /// The same of a problem without a bend and its equations.
    fn of((problem, lowered): (Problem, Lowered), way: u64) -> Result<Self, String> {
        let of = |&owner| Whose::of(&problem, owner);
        let owners: Vec<Whose> = lowered.owners.iter().map(of).collect();
        let is_dimension = |index: usize| owners[index].number(&problem).is_some();
        let mut system = System::new(&problem, &lowered, is_dimension);
        let has_twins = has_twins(&lowered.tail);
        let unit = typical_length(&problem);
        let at = system.sketch(unit);
        let later = system.later();
        let kept = |row: usize| owners[system.rows[row].index].keep(&problem);
        let mut choice = Choice::new(&system, &at, &later, kept, COARSE);
        let equations = &lowered.tail.equations;
        let rows = system.rows.iter();
        let structural = rows.map(|row| !is_dimension(row.index));
        let structural: Vec<bool> = structural.collect();
        let floats = Floats::new(&system, equations, unit);
        let mut moved_rights: Vec<(usize, Vec<Real>)> = Vec::new();
        let (mut singular, mut drawn) = (None, None);
        if let Drawn::Singular { rows, seen, off } = look(&floats, &structural, (&at, &choice), way)
        {
            let name = |&row: &usize| owners[system.rows[row].index].name(&problem);
            let names = rows.iter().map(name);
            let mut place = Singular::new(&problem, &system, &rows, (names, seen));
            if let Some(off) = off {
                choice = Choice::new(&system, &off, &later, kept, COARSE);
                place.moved = Some(system.moved(&off, problem.dimension, unit));
                drawn = Some(system.values.clone());
                moved_rights = system.set_off(&off, unit, |index| equations[index].target());
            }
            singular = Some(place);
        }
        let used = square(&choice);
        let blocks = blocks_of(&used, &system)
            .ok_or("its equations do not match its unknowns: the sketch is singular")?;
        let is_exact = is_exact(&blocks, &used, &system);
        let Lowered { tail, record, .. } = lowered;
        let numbers = problem
            .objects
            .iter()
            .zip(&tail.objects)
            .map(|(object, of)| Some(system.auxiliary[own_number(&object.shape, of)?]));
        let numbers = numbers.collect();
        let own = problem.objects.iter().zip(&tail.objects);
        let own = own.filter_map(|(object, of)| {
            let unknowns = |of: &[Entry]| -> Vec<usize> {
                of.iter()
                    .filter_map(|entry| match *entry {
                        Entry::Unknown(k) => Some(system.auxiliary[k]),
                        _ => None,
                    })
                    .collect()
            };
            let split = object.shape.split_direction(of, problem.dimension);
            split.map(|of| of.map(unknowns))
        });
        let own = own.collect();
        let powers = tail.equations.iter().map(|e| e.power).collect();
        let mut rights: Vec<Vec<Real>> = tail.equations.into_iter().map(|e| e.right).collect();
        for (index, right) in moved_rights {
            rights[index] = right;
        }
        let cut = Cut {
            redundant: choice.redundant,
            free: choice.free,
            is_exact,
            problem,
            system,
            used,
            blocks,
            rights,
            powers,
            numbers,
            told: (tail.objects, tail.poses),
            own,
            record,
            unit,
            owners,
            has_twins,
            singular,
            drawn,
        };
        let implied = cut.system.implied.iter();
        let mut contradicted = implied.filter(|&&index| !cut.at_target(index).is_zero());
        if let Some(&index) = contradicted.next() {
            return Err(format!("{} contradicts {}", cut.name(index), cut.others()));
        }
        Ok(cut)
    }

    /// What a constraint may follow from or contradict.
    pub fn others(&self) -> &'static str {
        match self.problem.kept.what.is_empty() {
            true => "the other constraints",
            false => "the other constraints and what is left as it is in the file",
        }
    }

    /// Where an unknown is drawn.
    pub fn drawn_at(&self, unknown: usize) -> &Real {
        let values = self.drawn.as_ref().unwrap_or(&self.system.values);
        &values[unknown]
    }

    /// What the right-hand side of one of the problem's equations is to be.
    pub fn at_target(&self, index: usize) -> Real {
        let right = self.rights[index].iter();
        right.fold(Real::zero(), |sum, c| &sum + c)
    }

    /// For each row that was left out whether it is proved to hold wherever the others do, at t = 1.
    pub fn proved_redundant(&self) -> Vec<bool> {
        if self.redundant.is_empty() {
            return Vec::new();
        }
        let right_of = |used: &Used| match *used {
            Used::Row(row) => self.at_target(self.system.rows[row].index),
            Used::Held(u) => self.system.values[u].clone(),
        };
        let given = |used: &Used| match *used {
            Used::Row(row) => Given::row(&self.system.rows[row], &[right_of(used)]),
            Used::Held(u) => Given::held(u, &self.system.values[u]),
        };
        let given: Vec<Given> = self.used.iter().map(given).collect();
        let rows = self.redundant.iter().map(|&row| &self.system.rows[row]);
        rows.map(|row| {
            let how: Option<Combination> = combination(row, &given);
            how.is_some_and(|how| {
                let of = |i: usize| vec![right_of(&self.used[i])];
                how.holds(&[self.at_target(row.index)], of, |k| given[k].constant())
            })
        })
        .collect()
    }

    /// What a claim about figures is proved of. `verdict`: how they stand to each row that was left out, by place.
    /// `value`: of what is held, in the unit of the problem.
    pub fn account(
        &self,
        value: impl Fn(usize) -> Interval,
        verdict: impl Fn(usize) -> Verdict,
    ) -> Account {
        let mut account = Account::of(&self.problem, 0);
        for used in &self.used {
            match *used {
                Used::Row(_) => account.equations += 1,
                Used::Held(u) => {
                    let at = value(u);
                    account.held.push(Held {
                        what: self.system.unknowns[u].name.clone(),
                        at: (at.inf(), at.sup()),
                    });
                }
            }
        }
        for k in 0..self.redundant.len() {
            account.leave_out(self.name_left_out(k), verdict(k));
        }
        account
    }

    /// What people call a row that was left out, by place: a part of a constraint of which other equations are used.
    pub fn name_left_out(&self, redundant: usize) -> String {
        let index = self.left_out(redundant).index;
        let owner = self.owners[index];
        let all = self.owners.iter().filter(|&&other| other == owner).count();
        let out =
            (0..self.redundant.len()).filter(|&k| self.owners[self.left_out(k).index] == owner);
        let used = all - out.count();
        let is_of_it = |row: &Row| self.owners[row.index] == owner;
        match used > 0 && used > self.system.own_numbers(&self.told.0, is_of_it) {
            true => format!("a part of {}", self.name(index)),
            false => self.name(index),
        }
    }

    /// A row that was left out, by place.
    pub fn left_out(&self, redundant: usize) -> &Row {
        &self.system.rows[self.redundant[redundant]]
    }

    /// Whose equation a row is, see [`Cut::owners`].
    pub fn owner(&self, row: usize) -> Whose {
        self.owners[self.system.rows[row].index]
    }

    /// The power of the unit of length that an unknown has.
    pub fn unit_of(&self, unknown: usize) -> f64 {
        self.unit.powi(self.system.unknowns[unknown].power)
    }

    /// The unknown that a coordinate of a point is.
    pub fn coordinate(&self, point: usize, axis: usize) -> usize {
        self.system.coordinates[point * self.problem.dimension + axis]
    }

    /// How a row that was left out, by place, is measured.
    pub fn ruler(&self, redundant: usize, tolerance: Option<f64>) -> Ruler {
        let index = self.left_out(redundant).index;
        let (unit, power) = (self.unit, self.powers[index]);
        Ruler::new(&self.problem, self.owners[index], (unit, power), tolerance)
    }

    /// The names of a block's unknowns.
    pub fn unknowns_of(&self, block: &Block) -> Vec<String> {
        let unknowns = block.unknowns.iter();
        unknowns
            .map(|&u| self.system.unknowns[u].name.clone())
            .collect()
    }

    /// What people call a constraint, by its index.
    pub fn constraint_name(&self, constraint: usize) -> String {
        Whose::Constraint(constraint).name(&self.problem)
    }

    /// What people call whoever says an equation.
    pub fn name(&self, equation: usize) -> String {
        self.owners[equation].name(&self.problem)
    }
}
