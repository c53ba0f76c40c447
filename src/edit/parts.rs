//! A sketch in its own frame, followed part by part.
//!
//! Real sketches fall apart ([`crate::blocks`]). An edit moves the blocks in which its dimensions are and those that
//! need them; what is linear in numbers that are known exactly is computed, as a polynomial in t with exact
//! coefficients; the rest is followed, each connected part for itself with all that it needs, along the same t. Points
//! that nothing determines stay put, and equations that follow from others at the figure are left out and looked at in
//! the end.

use super::ending::{Dimension, Edited, Ending, Limit, Orientations};
use super::open::{Moved, OpenError};
use super::session::Decomposition;
use super::setting::Setting;
use super::whole::sine;
use crate::blocks::{Block, Blocks, Choice, Row, System};
use crate::constraint::{
    Entry, Equation, Form, KINDS, Lowered, Nonzero, Owner, Product, Record, Role, try_lower_all,
    value,
};
use crate::interval::{Interval, Real, hull, point};
use crate::problem::{Constraint, Decimal, Item, Problem, Shape};
use crate::system::{Homotopy, Part, Right, typical_length};
use crate::track::arc::{ArcEnd, ArcRun, Figure, Fold, Orientation};
use crate::track::certified::{FollowArcs, arcs};
use crate::track::{Control, LARGEST_SQUARE, Options, StartError};
use std::collections::{BTreeSet, HashMap};
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Points are said to be on one line where the sine of the angle is at most this.
const FLAT: f64 = 1e-9;

/// A part is followed over so many tubes. Edits of real sketches take a few; one that takes so many runs off
/// to infinity, as where two lines become parallel.
const MOST_TUBES: usize = 1000;

/// An equation of the square system.
#[derive(Debug, Clone, Copy)]
enum Used {
    /// A row of the merged system, by position.
    Row(usize),
    /// An unknown stays what it is.
    Held(usize),
}

/// A number that is known up to a radius, in the homotopy's unit.
#[derive(Debug, Clone, Copy)]
struct Known {
    centre: f64,
    low: f64,
    radius: f64,
}

impl Known {
    fn new(x: Interval) -> Self {
        Known {
            centre: x.mid(),
            low: 0.0,
            radius: x.rad(),
        }
    }

    fn enclosure(self) -> Interval {
        point(self.centre) + point(self.low) + hull(-self.radius, self.radius)
    }
}

/// A sketch and its figure.
#[derive(Debug)]
pub(super) struct Parts {
    problem: Problem,
    options: Options,
    record: Record,
    /// The power of the unit of length of each of the problem's equations.
    powers: Vec<i32>,
    system: System,
    used: Vec<Used>,
    redundant: Vec<usize>,
    free: Vec<usize>,
    blocks: Blocks,
    /// Blocks of one equation that is linear in exactly known numbers.
    is_exact: Vec<bool>,
    /// Whose equation each of the problem's is: objects, constraints, none, distances.
    owners: Vec<usize>,
    /// For each object its radius, if it is a circle.
    radii: Vec<Option<usize>>,
    /// Points of which the orientation is a sense that constraints leave open: followed always.
    senses: Vec<Vec<usize>>,
    /// Those, and points that distances join, which are followed where all of them are in one part.
    followed: Vec<Vec<usize>>,
    figure: Vec<Known>,
    unit: f64,
    moved: Moved,
    /// Followers of parts that were needed before, by their blocks.
    ready: HashMap<Vec<usize>, Box<dyn FollowArcs>>,
}

/// A path of the whole sketch.
struct Run {
    end: End,
    t: (f64, f64),
    orientations: Vec<Orientation>,
    tubes: usize,
    rejected: usize,
    length: f64,
    switched_on: Vec<String>,
}

enum End {
    Reached(Vec<Known>),
    /// The figure there and the velocity of each unknown.
    Limit(Vec<Known>, Vec<f64>),
    Passes(String),
    Stopped(String),
}

/// What became of one part.
struct PartRun {
    unknowns: Vec<usize>,
    run: ArcRun,
}

fn refuse(what: String) -> OpenError {
    OpenError::Start(StartError::Unsupported(what))
}

impl Parts {
    /// Takes the sketch for the figure, after leading it to its own dimensions.
    pub fn open(
        problem: &Problem,
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let (mut parts, rights) = Self::assemble(problem, options).map_err(refuse)?;
        parts.lead(&rights, control)?;
        Ok(parts)
    }

    /// Merges, chooses and cuts; the figure is the sketch still, which the right-hand sides that come along lead to its
    /// dimensions.
    pub fn assemble(
        problem: &Problem,
        options: &Options,
    ) -> Result<(Self, Vec<Vec<Real>>), String> {
        let mut problem = problem.clone();
        problem.homotopy.bend_coefficient = Decimal::from(0);
        problem.homotopy.detour = Decimal::from(0);
        let problem = &problem;
        let lowered = lowered(problem, None)?;
        let owner_is_dimension = |owner: usize| {
            let (objects, all) = (problem.objects.len(), problem.constraints.len());
            match owner.checked_sub(objects) {
                None => false,
                Some(c) if c < all => problem.constraints[c].value.is_some(),
                Some(c) => c > all,
            }
        };
        let system = System::new(problem, &lowered, |index| {
            owner_is_dimension(lowered.owners[index])
        });
        let unit = typical_length(problem);
        let scaled: Vec<Interval> = system
            .unknowns
            .iter()
            .zip(&system.values)
            .map(|(unknown, value)| value.enclose() * point(1.0 / unit.powi(unknown.power)))
            .collect();
        let at: Vec<f64> = scaled.iter().map(|x| x.mid()).collect();
        let coordinates: BTreeSet<usize> = system.coordinates.iter().copied().collect();
        let choice = Choice::new(&system, &at, |u| coordinates.contains(&u));
        let held = choice.free.iter().map(|&u| Used::Held(u));
        let used: Vec<Used> = choice
            .used
            .iter()
            .map(|&r| Used::Row(r))
            .chain(held)
            .collect();
        let of: Vec<Vec<usize>> = used
            .iter()
            .map(|used| match *used {
                Used::Row(row) => system.rows[row].unknowns.clone(),
                Used::Held(u) => vec![u],
            })
            .collect();
        let blocks = Blocks::new(&of, system.unknowns.len())
            .ok_or("its equations do not match its unknowns: the sketch is singular")?;
        let radii = problem.objects.iter().enumerate().map(|(o, object)| {
            let entry = lowered.object_unknowns[o].first();
            match (&object.shape, entry) {
                (Shape::Round { .. }, Some(&Entry::Unknown(k))) => Some(system.auxiliary[k]),
                _ => None,
            }
        });
        let radii = radii.collect();
        let mut parts = Parts {
            problem: problem.clone(),
            options: Options {
                space: crate::track::Space::Full,
                reverse: false,
                max_steps: options.max_steps.min(MOST_TUBES),
                ..options.clone()
            },
            record: lowered.record.clone(),
            powers: lowered.tail.equations.iter().map(|e| e.power).collect(),
            used,
            redundant: choice.redundant,
            free: choice.free,
            is_exact: Vec::new(),
            owners: lowered.owners.clone(),
            radii,
            senses: senses(problem),
            followed: followed(problem),
            figure: scaled.into_iter().map(Known::new).collect(),
            unit,
            moved: Moved::default(),
            ready: HashMap::new(),
            blocks,
            system,
        };
        parts.drop_flat_triples();
        parts.find_exact();
        let rights: Vec<Vec<Real>> = lowered
            .tail
            .equations
            .into_iter()
            .map(|e| e.right)
            .collect();
        for &index in &parts.system.implied {
            if !rights[index]
                .iter()
                .fold(Real::zero(), |sum, c| &sum + c)
                .is_zero()
            {
                return Err(format!(
                    "{} contradicts the other constraints",
                    parts.name(index)
                ));
            }
        }
        Ok((parts, rights))
    }

    /// Leads the sketch to its own dimensions.
    fn lead(&mut self, rights: &[Vec<Real>], control: &mut Control) -> Result<(), OpenError> {
        let run = self.follow(rights, control);
        let failed = |ending: Ending, what: String| OpenError::Correction {
            what,
            ending: Box::new(ending),
        };
        let figure = match run.end {
            End::Reached(figure) => figure,
            End::Limit(..) => {
                let what = format!(
                    "on the way there, at t = {:.6}, the figure comes to a limit and turns back",
                    run.t.0
                );
                return Err(failed(Ending::Stopped(what.clone()), what));
            }
            End::Passes(reason) => {
                let what = format!("on the way there branches seem to meet ({reason})");
                return Err(failed(Ending::Passes(reason), what));
            }
            End::Stopped(reason) => {
                return Err(failed(Ending::Stopped(reason.clone()), reason));
            }
        };
        let distance = self.distance(&figure);
        self.moved = Moved {
            distance,
            tubes: run.tubes.max(usize::from(distance > 0.0)),
        };
        self.figure = figure;
        match self.broken(rights).or_else(|| self.vanished()) {
            Some(what) => Err(failed(Ending::Stopped(what.clone()), what)),
            None => Ok(()),
        }
    }

    /// Triples of which two points are one and the same have no orientation.
    fn drop_flat_triples(&mut self) {
        let d = self.problem.dimension;
        let coordinates = &self.system.coordinates;
        let place = |p: usize| &coordinates[p * d..(p + 1) * d];
        let differ = |points: &Vec<usize>| {
            let mut places: Vec<&[usize]> = points.iter().map(|&p| place(p)).collect();
            places.sort_unstable();
            places.windows(2).all(|pair| pair[0] != pair[1])
        };
        self.senses.retain(differ);
        self.followed.retain(differ);
    }

    fn find_exact(&mut self) {
        self.is_exact = vec![false; self.blocks.blocks.len()];
        for b in 0..self.is_exact.len() {
            let block = &self.blocks.blocks[b];
            let known = block.needs.iter().all(|&need| self.is_exact[need]);
            self.is_exact[b] = known
                && block.unknowns.len() == 1
                && match self.used[block.equations[0]] {
                    Used::Held(_) => true,
                    Used::Row(row) => self.system.rows[row]
                        .products
                        .iter()
                        .all(|p| p.left == Form::One || p.right == Form::One),
                };
        }
    }

    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    pub fn moved(&self) -> Moved {
        self.moved
    }

    /// What stays put because nothing determines it, and what was left out because it follows from the rest at the
    /// figure: names.
    pub fn free(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for &u in &self.free {
            let points = self.system.coordinates.iter().position(|&c| c == u);
            let name = match points {
                Some(place) => self.problem.points[place / self.problem.dimension]
                    .name
                    .clone(),
                None => self.system.unknowns[u].name.clone(),
            };
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// See [`Parts::free`].
    pub fn redundant(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for &row in &self.redundant {
            let name = self.name(self.system.rows[row].index);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// How the equations fall apart.
    pub fn decomposition(&self) -> Decomposition {
        let blocks = self.blocks.blocks.iter().zip(&self.is_exact);
        let names = |block: &Block| {
            let unknowns = block.unknowns.iter();
            unknowns
                .map(|&u| self.system.unknowns[u].name.clone())
                .collect()
        };
        Decomposition {
            merged: self.system.merged,
            unknowns: self.system.unknowns.len(),
            blocks: blocks
                .filter(|(_, exact)| !**exact)
                .map(|(block, _)| names(block))
                .collect(),
            free: self.free(),
            redundant: self.redundant(),
        }
    }

    /// The sketch as a problem with as many equations as unknowns: what nothing determines is held by constraints on its
    /// coordinates, and what follows from others at the figure is left out. It bends by default.
    pub fn completed(&self) -> Result<Problem, String> {
        let mut problem = self.problem.clone();
        let (objects, all) = (problem.objects.len(), problem.constraints.len());
        let head = problem.distances.len();
        let out: BTreeSet<usize> = self
            .redundant
            .iter()
            .filter_map(|&row| match self.owners[self.system.rows[row].index] {
                owner if owner < objects => None,
                owner if owner < objects + all => Some(head + owner - objects),
                owner => Some(owner - objects - all - 1),
            })
            .collect();
        let labels = std::mem::take(&mut problem.labels);
        let label = |index: usize| labels.get(&index).cloned();
        let distances = problem.distances.drain(..).enumerate();
        let distances: Vec<_> = distances
            .filter(|(index, _)| !out.contains(index))
            .map(|(index, distance)| (distance, label(index)))
            .collect();
        let constraints = problem.constraints.drain(..).enumerate();
        let mut constraints: Vec<_> = constraints
            .filter(|(c, _)| !out.contains(&(head + c)))
            .map(|(c, constraint)| (constraint, label(head + c)))
            .collect();
        let d = problem.dimension;
        for &u in &self.free {
            let place = self.system.coordinates.iter().position(|&c| c == u);
            let round = self.radii.iter().position(|&r| r == Some(u));
            let (kind, item, value) = match (place, round) {
                (Some(place), _) => {
                    let (p, axis) = (place / d, place % d);
                    let at = problem.points[p].sketch[axis].clone();
                    (["x", "y", "z"][axis], Item::Point(p), at)
                }
                (None, Some(o)) => match &problem.objects[o].shape {
                    Shape::Round { radius, .. } => ("radii", Item::Object(o), radius.clone()),
                    _ => unreachable!("only circles have radii of their own"),
                },
                _ => return Err(format!("{} is free", self.system.unknowns[u].name)),
            };
            let held = Constraint {
                kind: kind.to_owned(),
                items: vec![item],
                value: Some(value),
            };
            constraints.push((held, None));
        }
        let order = |kind: &str| KINDS.iter().position(|k| k.key() == kind);
        constraints.sort_by_key(|(c, _)| order(&c.kind));
        let named = distances
            .iter()
            .map(|d| &d.1)
            .chain(constraints.iter().map(|c| &c.1));
        let named = named.enumerate();
        problem.labels = named
            .filter_map(|(k, label)| Some((k, label.clone()?)))
            .collect();
        problem.distances = distances.into_iter().map(|d| d.0).collect();
        problem.constraints = constraints.into_iter().map(|c| c.0).collect();
        problem.bend_by_default();
        problem.check().map_err(|error| error.to_string())?;
        Ok(problem)
    }

    /// What people call the source of one of the problem's equations.
    fn name(&self, equation: usize) -> String {
        let (objects, all) = (self.problem.objects.len(), self.problem.constraints.len());
        let owner = self.owners[equation];
        match owner.checked_sub(objects) {
            None => format!("`{}`", self.problem.objects[owner].name),
            Some(c) if c < all => {
                let index = self.problem.distances.len() + c;
                match self.problem.labels.get(&index) {
                    Some(label) => format!("`{label}` ({})", self.problem.constraint_name(c)),
                    None => format!("`{}`", self.problem.constraint_name(c)),
                }
            }
            Some(c) => format!("`{}`", self.problem.dimension_name(c - all - 1)),
        }
    }

    /// The figure in the coordinates of the problem.
    pub fn points(&self) -> Vec<[Interval; 3]> {
        self.points_of(&self.figure)
    }

    fn points_of(&self, figure: &[Known]) -> Vec<[Interval; 3]> {
        let (d, unit) = (self.problem.dimension, point(self.unit));
        let coordinate = |p: usize, axis: usize| match axis < d {
            true => figure[self.system.coordinates[p * d + axis]].enclosure() * unit,
            false => point(0.0),
        };
        (0..self.problem.points.len())
            .map(|p| std::array::from_fn(|axis| coordinate(p, axis)))
            .collect()
    }

    /// The radii of circles, by object, in floats; zero for what is none.
    pub fn radii(&self) -> Vec<f64> {
        let radius = |u: &Option<usize>| u.map_or(0.0, |u| self.figure[u].centre * self.unit);
        self.radii.iter().map(radius).collect()
    }

    fn distance(&self, figure: &[Known]) -> f64 {
        let (old, new) = (self.points(), self.points_of(figure));
        let apart = old.iter().zip(&new).map(|(a, b)| {
            let sum = (0..3).fold(point(0.0), |sum, k| sum + (a[k] - b[k]).sqr());
            sum.sqrt().sup()
        });
        // Where nothing moved the enclosures are of one and the same point.
        let apart = apart.fold(0.0, f64::max);
        if apart > 1e-15 * self.unit {
            apart
        } else {
            0.0
        }
    }

    pub fn edit(&mut self, settings: &[Setting], keep: bool, control: &mut Control) -> Edited {
        let clock = Instant::now();
        let mut problem = self.problem.clone();
        for setting in settings {
            setting.apply(&mut problem);
        }
        let (edited, figure) = match lowered(&problem, Some(&self.record)) {
            Err(fault) => (self.account(settings, stopped(fault)), None),
            Ok(lowered) => {
                let rights: Vec<Vec<Real>> = lowered
                    .tail
                    .equations
                    .into_iter()
                    .map(|e| e.right)
                    .collect();
                let mut run = match self.unmovable(&rights) {
                    Some(what) => stopped(what),
                    None => self.follow(&rights, control),
                };
                let mut figure = None;
                if let End::Reached(reached) = &run.end {
                    let old = std::mem::replace(&mut self.figure, reached.clone());
                    match self.broken(&rights).or_else(|| self.vanished()) {
                        Some(what) => {
                            run.end = End::Stopped(what);
                            run.t = (0.0, 0.0);
                        }
                        None => figure = Some((reached.clone(), lowered.record)),
                    }
                    self.figure = old;
                }
                (self.account(settings, run), figure)
            }
        };
        if let (Some((figure, record)), true) = (figure, keep) {
            (self.figure, self.record, self.problem) = (figure, record, problem);
        }
        Edited {
            seconds: clock.elapsed().as_secs_f64(),
            ..edited
        }
    }

    /// A dimension that is to move but follows from others.
    fn unmovable(&self, rights: &[Vec<Real>]) -> Option<String> {
        let redundant = self
            .redundant
            .iter()
            .map(|&row| self.system.rows[row].index);
        let mut all = redundant.chain(self.system.implied.iter().copied());
        let fixed = all.find(|&index| moves(&rights[index]))?;
        Some(format!(
            "{} follows from the other constraints at this figure and cannot change by itself",
            self.name(fixed)
        ))
    }

    /// An equation that was left out and does not hold at the figure.
    fn broken(&self, rights: &[Vec<Real>]) -> Option<String> {
        let side = |form: Form| match form {
            Form::One => point(1.0),
            Form::Difference(a, b) => {
                let [a, b] = [a, b].map(|entry| match entry {
                    Entry::Unknown(u) => self.figure[u].enclosure(),
                    _ => point(0.0),
                });
                a - b
            }
        };
        for &row in &self.redundant {
            let Row {
                index, products, ..
            } = &self.system.rows[row];
            let left = products.iter().fold(point(0.0), |sum, p| {
                sum + point(0.5 * f64::from(p.factor)) * side(p.left) * side(p.right)
            });
            let right = Right::polynomial(&rights[*index], self.scale(*index)).at_target();
            let off = (left - right).mig();
            if off > 1e-7 {
                return Some(format!(
                    "{} seemed to follow from the other constraints, but contradicts them",
                    self.name(*index)
                ));
            }
        }
        None
    }

    /// What right-hand sides of an equation are divided by. Every product of it has the same power of the unit.
    fn scale(&self, index: usize) -> f64 {
        self.unit.powi(self.powers[index])
    }

    fn rights_of(&self, used: Used, rights: &[Vec<Real>]) -> Vec<Real> {
        match used {
            Used::Row(row) => rights[self.system.rows[row].index].clone(),
            Used::Held(u) => vec![self.system.values[u].clone()],
        }
    }

    fn power_of(&self, used: Used) -> i32 {
        match used {
            Used::Row(row) => self.powers[self.system.rows[row].index],
            Used::Held(u) => self.system.unknowns[u].power,
        }
    }

    /// Follows all that moves from t = 0 to t = 1.
    fn follow(&mut self, rights: &[Vec<Real>], control: &mut Control) -> Run {
        let count = self.blocks.blocks.len();
        let mut moving = vec![false; count];
        for (b, block) in self.blocks.blocks.iter().enumerate() {
            moving[b] = block.needs.iter().any(|&need| moving[need])
                || block.equations.iter().any(|&e| match self.used[e] {
                    Used::Row(row) => moves(&rights[self.system.rows[row].index]),
                    Used::Held(_) => false,
                });
        }
        let exact = self.exact_polynomials(rights, &moving);
        let groups = self.groups(&moving);
        let mut runs = Vec::new();
        for group in &groups {
            let run = self.follow_group(group, rights, control);
            let is_reached = matches!(run.run.end, ArcEnd::Reached(_));
            runs.push(run);
            let is_cancelled = control
                .cancel
                .is_some_and(|flag| flag.load(Ordering::Relaxed));
            if !is_reached && is_cancelled {
                break;
            }
        }
        let worst = (0..runs.len())
            .filter(|&k| !matches!(runs[k].run.end, ArcEnd::Reached(_)))
            .min_by(|&a, &b| runs[a].run.t.0.total_cmp(&runs[b].run.t.0));
        if let Some(k) = worst
            && runs.len() > 1
            && matches!(runs[k].run.end, ArcEnd::Limit(_))
        {
            // All together, so that the whole figure at the limit is enclosed.
            let all: Vec<usize> = groups.concat();
            runs = vec![self.follow_group(&all, rights, control)];
        }
        let worst = (0..runs.len())
            .filter(|&k| !matches!(runs[k].run.end, ArcEnd::Reached(_)))
            .min_by(|&a, &b| runs[a].run.t.0.total_cmp(&runs[b].run.t.0));
        let t = worst.map_or((1.0, 1.0), |k| runs[k].run.t);
        self.combine(runs, worst, &exact, t)
    }

    /// The polynomials of moving unknowns that are known exactly.
    fn exact_polynomials(
        &self,
        rights: &[Vec<Real>],
        moving: &[bool],
    ) -> HashMap<usize, Vec<Real>> {
        let mut all: HashMap<usize, Vec<Real>> = HashMap::new();
        // What they need that stands still is needed too.
        let wanted = (0..moving.len()).filter(|&b| moving[b] && self.is_exact[b]);
        for b in self.blocks.with_needs(wanted) {
            let block = &self.blocks.blocks[b];
            let (u, used) = (block.unknowns[0], self.used[block.equations[0]]);
            let mut right = self.rights_of(used, rights);
            let mut factor = 0;
            if let Used::Row(row) = used {
                let mut add = |v: usize, by: i32| {
                    if v == u {
                        factor += by;
                        return;
                    }
                    // By halves, as all products are.
                    let by = &Real::whole((-by).into()) / &Real::whole(2);
                    for (k, c) in all[&v].iter().enumerate() {
                        if k == right.len() {
                            right.push(Real::zero());
                        }
                        right[k] = &right[k] + &(&by * c);
                    }
                };
                for p in &self.system.rows[row].products {
                    match (p.left, p.right) {
                        (Form::Difference(a, b), Form::One)
                        | (Form::One, Form::Difference(a, b)) => {
                            for (entry, by) in [(a, p.factor), (b, -p.factor)] {
                                if let Entry::Unknown(v) = entry {
                                    add(v, by);
                                }
                            }
                        }
                        _ => unreachable!("an exact block is linear"),
                    }
                }
                let per = &Real::whole(2) / &Real::whole(factor.into());
                right.iter_mut().for_each(|c| *c = &*c * &per);
            }
            all.insert(u, right);
        }
        all.retain(|&u, _| moving[self.blocks.of_unknown[u]]);
        all
    }

    /// The moving blocks that have to be followed, in groups that have nothing in common but numbers known exactly.
    fn groups(&self, moving: &[bool]) -> Vec<Vec<usize>> {
        let count = moving.len();
        let mut parent: Vec<usize> = (0..count).collect();
        fn root(parent: &[usize], mut x: usize) -> usize {
            while parent[x] != x {
                x = parent[x];
            }
            x
        }
        let mut join = |a: usize, b: usize| {
            let (a, b) = (root(&parent, a), root(&parent, b));
            parent[a.max(b)] = a.min(b);
        };
        let mut taken: BTreeSet<usize> = (0..count)
            .filter(|&b| moving[b] && !self.is_exact[b])
            .collect();
        // Points of which the orientation is a sense are followed together.
        let d = self.problem.dimension;
        for points in &self.senses {
            let places = points.iter().flat_map(|p| (p * d)..(p * d + d));
            let of = places.map(|place| self.blocks.of_unknown[self.system.coordinates[place]]);
            let of: BTreeSet<usize> = of.filter(|&b| !self.is_exact[b]).collect();
            if of.iter().any(|b| moving[*b]) {
                let first = *of.first().expect("it has one");
                of.iter().for_each(|&b| join(first, b));
                taken.extend(of);
            }
        }
        // So are the unknowns of vectors that must not vanish, if any of them moves.
        for vector in &self.system.nonzero {
            let of = self.unknowns_of_vector(vector).into_iter();
            let of: BTreeSet<usize> = of.map(|u| self.blocks.of_unknown[u]).collect();
            if !of.iter().any(|&b| moving[b]) {
                continue;
            }
            let of: Vec<usize> = of.into_iter().filter(|&b| !self.is_exact[b]).collect();
            if let Some(&first) = of.first() {
                of.iter().for_each(|&b| join(first, b));
                taken.extend(of);
            }
        }
        let with_needs = self.blocks.with_needs(taken);
        let not_exact: Vec<usize> = with_needs
            .into_iter()
            .filter(|&b| !self.is_exact[b])
            .collect();
        for &b in &not_exact {
            for &need in &self.blocks.blocks[b].needs {
                if !self.is_exact[need] {
                    join(b, need);
                }
            }
        }
        let mut groups: HashMap<usize, Vec<usize>> = HashMap::new();
        for b in not_exact {
            groups.entry(root(&parent, b)).or_default().push(b);
        }
        let mut groups: Vec<Vec<usize>> = groups.into_values().collect();
        groups.sort();
        groups
    }

    fn follow_group(
        &mut self,
        group: &[usize],
        rights: &[Vec<Real>],
        control: &mut Control,
    ) -> PartRun {
        let mut blocks: Vec<usize> = group.to_vec();
        // The coordinates of points that have a sense, whatever they need.
        let d = self.problem.dimension;
        let taken = self.blocks.with_needs(group.iter().copied());
        for points in &self.senses {
            let places = points.iter().flat_map(|p| (p * d)..(p * d + d));
            let of: Vec<usize> = places
                .map(|place| self.blocks.of_unknown[self.system.coordinates[place]])
                .collect();
            if of.iter().any(|b| taken.contains(b) && !self.is_exact[*b]) {
                blocks.extend(of);
            }
        }
        for vector in &self.system.nonzero {
            let of = self.unknowns_of_vector(vector).into_iter();
            let of: Vec<usize> = of.map(|u| self.blocks.of_unknown[u]).collect();
            if of.iter().any(|b| taken.contains(b) && !self.is_exact[*b]) {
                blocks.extend(of);
            }
        }
        let blocks = self.blocks.with_needs(blocks);
        let unknowns: Vec<usize> = blocks
            .iter()
            .flat_map(|&b| self.blocks.blocks[b].unknowns.iter().copied())
            .collect();
        let used: Vec<Used> = blocks
            .iter()
            .flat_map(|&b| {
                self.blocks.blocks[b]
                    .equations
                    .iter()
                    .map(|&e| self.used[e])
            })
            .collect();
        if unknowns.len() > LARGEST_SQUARE {
            let reason = format!(
                "a part has {} unknowns, more than the {LARGEST_SQUARE} of which proofs keep square matrices",
                unknowns.len()
            );
            let run = ArcRun {
                end: ArcEnd::Stopped(reason),
                t: (0.0, 0.0),
                orientations: Vec::new(),
                alone_within: 0.0,
                last: Vec::new(),
                steps: 0,
                rejected: 0,
                length: 0.0,
                switched_on: Vec::new(),
            };
            return PartRun { unknowns, run };
        }
        let polynomials: Vec<Vec<Real>> = used
            .iter()
            .map(|&used| self.rights_of(used, rights))
            .collect();
        let mut follower = match self.ready.remove(&blocks) {
            Some(mut follower) => {
                let homotopy = follower.homotopy_mut();
                for (k, polynomial) in polynomials.iter().enumerate() {
                    let scale = self.unit.powi(self.power_of(used[k]));
                    homotopy.rights[k] = Right::polynomial(polynomial, scale);
                }
                follower
            }
            None => arcs(self.homotopy(&unknowns, &used, polynomials), &self.options),
        };
        let start = Figure {
            centre: unknowns.iter().map(|&u| self.figure[u].centre).collect(),
            low: unknowns.iter().map(|&u| self.figure[u].low).collect(),
            radius: unknowns.iter().map(|&u| self.figure[u].radius).collect(),
        };
        let run = follower.follow(&start, control);
        self.ready.insert(blocks, follower);
        PartRun { unknowns, run }
    }

    fn homotopy(&self, unknowns: &[usize], used: &[Used], rights: Vec<Vec<Real>>) -> Homotopy {
        let local: HashMap<usize, usize> =
            unknowns.iter().enumerate().map(|(k, &u)| (u, k)).collect();
        let entry = |e: Entry| match e {
            Entry::Unknown(u) => Entry::Unknown(local[&u]),
            other => other,
        };
        let form = |f: Form| match f {
            Form::One => Form::One,
            Form::Difference(a, b) => Form::Difference(entry(a), entry(b)),
        };
        let equations = used.iter().zip(rights).map(|(&used, right)| {
            let (name, products) = match used {
                Used::Row(row) => {
                    let row = &self.system.rows[row];
                    let products = row.products.iter().map(|p| Product {
                        factor: p.factor,
                        left: form(p.left),
                        right: form(p.right),
                    });
                    (self.name(row.index), products.collect())
                }
                Used::Held(u) => {
                    let name = format!("{} stays put", self.system.unknowns[u].name);
                    let held = Product {
                        factor: 2,
                        left: value(Entry::Unknown(local[&u])),
                        right: Form::One,
                    };
                    (name, vec![held])
                }
            };
            Equation {
                name,
                products,
                right,
                power: self.power_of(used),
            }
        });
        let d = self.problem.dimension;
        let coordinates = self
            .system
            .coordinates
            .iter()
            .map(|u| local.get(u).copied());
        let coordinates: Vec<Option<usize>> = coordinates.collect();
        let is_here = |points: &&Vec<usize>| {
            let mut places = points.iter().flat_map(|p| (p * d)..(p * d + d));
            places.all(|place| coordinates[place].is_some())
        };
        let nonzero = self.system.nonzero.iter().filter(|vector| {
            let of = self.unknowns_of_vector(vector);
            of.iter().all(|u| local.contains_key(u))
        });
        let nonzero = nonzero.map(|vector| Nonzero {
            name: vector.name.clone(),
            forms: std::array::from_fn(|axis| match axis < d {
                true => form(vector.forms[axis]),
                false => Form::Difference(Entry::Zero, Entry::Zero),
            }),
        });
        Homotopy::of_part(Part {
            nonzero: nonzero.collect(),
            dimension: d,
            unit: self.unit,
            unknowns: unknowns
                .iter()
                .map(|&u| self.system.unknowns[u].clone())
                .collect(),
            equations: equations.collect(),
            followed: self.followed.iter().filter(is_here).cloned().collect(),
            coordinates,
        })
    }

    /// What the parts come to together.
    fn combine(
        &self,
        runs: Vec<PartRun>,
        worst: Option<usize>,
        exact: &HashMap<usize, Vec<Real>>,
        t: (f64, f64),
    ) -> Run {
        let upto = hull(t.0.min(0.0), t.1.min(1.0));
        let mut out = Run {
            end: End::Stopped(String::new()),
            t,
            orientations: self.exact_orientations(exact, upto),
            tubes: runs.iter().map(|run| run.run.steps).sum(),
            rejected: runs.iter().map(|run| run.run.rejected).sum(),
            length: runs.iter().map(|run| run.run.length).sum(),
            switched_on: Vec::new(),
        };
        for run in &runs {
            for remark in &run.run.switched_on {
                if !out.switched_on.contains(remark) {
                    out.switched_on.push(remark.clone());
                }
            }
            out.orientations
                .extend(run.run.orientations.iter().cloned());
        }
        // Nothing is said of a piece of path beyond where all of it ends.
        for orientation in &mut out.orientations {
            orientation.lost = orientation.lost.filter(|lost| lost.0 <= t.1);
        }
        for (&u, polynomial) in exact {
            if self.system.unknowns[u].role == Role::Positive && !is_positive(polynomial) {
                let name = &self.system.unknowns[u].name;
                out.end = End::Stopped(format!("{name} does not stay positive"));
                out.t = (0.0, 0.0);
                return out;
            }
        }
        if let Some(name) = self.vanishes_exactly(exact) {
            out.end = End::Stopped(format!(
                "{name} may vanish on the way, and what is said of its direction would say nothing there"
            ));
            out.t = (0.0, 0.0);
            return out;
        }
        let at = |time: Interval| -> Vec<Known> {
            let mut figure = self.figure.clone();
            for (&u, polynomial) in exact {
                let scale = self.unit.powi(self.system.unknowns[u].power);
                let right = enclosed(polynomial, scale);
                figure[u] = Known::new(match time.inf() == 1.0 {
                    true => right.iter().fold(point(0.0), |sum, c| sum + *c),
                    false => right
                        .iter()
                        .rev()
                        .fold(point(0.0), |sum, c| sum * time + *c),
                });
            }
            figure
        };
        let put = |figure: &mut Vec<Known>, unknowns: &[usize], found: &Figure| {
            for (k, &u) in unknowns.iter().enumerate() {
                // Numbers known exactly are known better.
                if !exact.contains_key(&u) {
                    figure[u] = Known {
                        centre: found.centre[k],
                        low: found.low[k],
                        radius: found.radius[k],
                    };
                }
            }
        };
        let Some(worst) = worst else {
            let mut figure = at(point(1.0));
            for PartRun { unknowns, run } in &runs {
                if let ArcEnd::Reached(found) = &run.end {
                    put(&mut figure, unknowns, found);
                }
            }
            out.end = End::Reached(figure);
            return out;
        };
        let PartRun { unknowns, run } = &runs[worst];
        out.end = match &run.end {
            ArcEnd::Limit(fold) => {
                let Fold {
                    figure: found,
                    velocity,
                    t,
                    ..
                } = &**fold;
                let mut figure = at(*t);
                put(&mut figure, unknowns, found);
                let mut all = vec![0.0; figure.len()];
                for (k, &u) in unknowns.iter().enumerate() {
                    all[u] = velocity[k];
                }
                End::Limit(figure, all)
            }
            ArcEnd::Passes(reason) => End::Passes(reason.clone()),
            ArcEnd::Stopped(reason) => End::Stopped(reason.clone()),
            ArcEnd::Reached(_) => unreachable!("it is not reached"),
        };
        out
    }

    /// Orientations of points all of whose coordinates are known exactly.
    /// The unknowns in a vector.
    fn unknowns_of_vector(&self, vector: &Nonzero) -> Vec<usize> {
        let entries = vector.forms[..self.problem.dimension].iter();
        let entries = entries.flat_map(|form| match *form {
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

    /// The coordinates of a vector, from enclosures of unknowns.
    fn coordinates_of(&self, vector: &Nonzero, at: impl Fn(usize) -> Interval) -> Vec<Interval> {
        let value = |entry: Entry| match entry {
            Entry::Unknown(u) => at(u),
            _ => point(0.0),
        };
        let forms = vector.forms[..self.problem.dimension].iter();
        forms
            .map(|form| match *form {
                Form::One => point(1.0),
                // The same number twice: no difference, however widely it is enclosed.
                Form::Difference(a, b) if a == b => point(0.0),
                Form::Difference(a, b) => value(a) - value(b),
            })
            .collect()
    }

    /// A vector that must not vanish and may do so in the figure.
    fn vanished(&self) -> Option<String> {
        let mut vectors = self.system.nonzero.iter();
        let vector = vectors.find(|vector| {
            let place = self.coordinates_of(vector, |u| self.figure[u].enclosure());
            place.iter().all(|x| x.contains(0.0))
        })?;
        Some(format!(
            "{} has no length in this figure, and so no direction that a constraint could be about",
            vector.name
        ))
    }

    /// A vector that must not vanish, of numbers that are known exactly, and may do so for some t between 0 and 1.
    /// (Others are in a part that is followed.)
    fn vanishes_exactly(&self, exact: &HashMap<usize, Vec<Real>>) -> Option<String> {
        const PIECES: u32 = 64;
        let enclosures: HashMap<usize, Vec<Interval>> = exact
            .iter()
            .map(|(&u, polynomial)| {
                let scale = self.unit.powi(self.system.unknowns[u].power);
                (u, enclosed(polynomial, scale))
            })
            .collect();
        let mut vectors = self.system.nonzero.iter();
        let vector = vectors.find(|vector| {
            let of = self.unknowns_of_vector(vector);
            let is_exact = |u: &usize| self.is_exact[self.blocks.of_unknown[*u]];
            if !of.iter().all(is_exact) || !of.iter().any(|u| exact.contains_key(u)) {
                return false;
            }
            let step = 1.0 / f64::from(PIECES);
            // The ends of pieces are multiples of 1/64, exactly.
            !(0..PIECES).all(|k| {
                let time = hull(f64::from(k) * step, f64::from(k + 1) * step);
                let place = self.coordinates_of(vector, |u| match enclosures.get(&u) {
                    Some(p) => p.iter().rev().fold(point(0.0), |sum, c| sum * time + *c),
                    None => self.figure[u].enclosure(),
                });
                place.iter().any(|x| !x.contains(0.0))
            })
        })?;
        Some(vector.name.clone())
    }

    fn exact_orientations(
        &self,
        exact: &HashMap<usize, Vec<Real>>,
        upto: Interval,
    ) -> Vec<Orientation> {
        let d = self.problem.dimension;
        let mut out = Vec::new();
        let enclosures: HashMap<usize, Vec<Interval>> = exact
            .iter()
            .map(|(&u, polynomial)| {
                let scale = self.unit.powi(self.system.unknowns[u].power);
                (u, enclosed(polynomial, scale))
            })
            .collect();
        for points in &self.followed {
            let of: Vec<usize> = points
                .iter()
                .flat_map(|p| (p * d)..(p * d + d))
                .map(|place| self.system.coordinates[place])
                .collect();
            let all_exact = of.iter().all(|&u| self.is_exact[self.blocks.of_unknown[u]]);
            if !all_exact || d != 2 || !of.iter().any(|u| exact.contains_key(u)) {
                continue;
            }
            let sign = |time: Interval| -> i8 {
                let x = |k: usize| match enclosures.get(&of[k]) {
                    Some(p) => p.iter().rev().fold(point(0.0), |sum, c| sum * time + *c),
                    None => self.figure[of[k]].enclosure(),
                };
                let determinant = (x(2) - x(0)) * (x(5) - x(1)) - (x(3) - x(1)) * (x(4) - x(0));
                match (determinant.inf() > 0.0, determinant.sup() < 0.0) {
                    (true, _) => 1,
                    (_, true) => -1,
                    _ => 0,
                }
            };
            const PIECES: u32 = 64;
            let first = sign(point(0.0));
            let step = upto.sup() / f64::from(PIECES);
            let lost = (0..PIECES).find_map(|k| {
                // Beyond the ends by a little, so that rounding leaves no gap.
                let (a, b) = (f64::from(k) * step - 1e-12, f64::from(k + 1) * step + 1e-12);
                (sign(hull(a, b)) != first).then_some((a.max(0.0), b))
            });
            out.push(Orientation {
                points: points.clone(),
                sign: first,
                lost: if first == 0 { None } else { lost },
            });
        }
        out
    }

    fn account(&self, settings: &[Setting], run: Run) -> Edited {
        let t = hull(run.t.0, run.t.1);
        let is_reached = matches!(run.end, End::Reached(_));
        let dimensions = settings.iter().map(|setting| {
            let (from, to) = (self.value(setting.index), setting.value());
            let value = match is_reached {
                true => to,
                false => setting.between(&self.problem, t),
            };
            Dimension {
                index: setting.index,
                from,
                to,
                value,
            }
        });
        let dimensions = dimensions.collect();
        let (ending, points) = match run.end {
            End::Reached(figure) => (Ending::Reached, self.points_of(&figure)),
            End::Limit(figure, velocity) => {
                let limit = self.limit(&figure, &velocity, &run.orientations);
                (Ending::Limit(limit), self.points_of(&figure))
            }
            End::Passes(reason) => (Ending::Passes(reason), self.points()),
            End::Stopped(reason) => (Ending::Stopped(reason), self.points()),
        };
        Edited {
            ending,
            t: run.t,
            dimensions,
            points,
            orientations: Orientations::new(run.orientations),
            tubes: run.tubes,
            rejected: run.rejected,
            length: run.length,
            switched_on: run.switched_on,
            seconds: 0.0,
        }
    }

    fn limit(&self, figure: &[Known], velocity: &[f64], orientations: &[Orientation]) -> Limit {
        let places = self.points_of(figure);
        let (mut flat, mut flat_within) = (Vec::new(), 0.0f64);
        for orientation in orientations.iter().filter(|o| o.sign != 0) {
            let sine = sine(&places, &orientation.points);
            if sine <= FLAT {
                flat.push(orientation.points.clone());
                flat_within = flat_within.max(sine);
            }
        }
        let d = self.problem.dimension;
        let mut motion: Vec<[f64; 3]> = (0..self.problem.points.len())
            .map(|p| {
                std::array::from_fn(|axis| match axis < d {
                    true => velocity[self.system.coordinates[p * d + axis]],
                    false => 0.0,
                })
            })
            .collect();
        let size = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let largest = motion.iter().map(size).fold(f64::MIN_POSITIVE, f64::max);
        for v in &mut motion {
            *v = v.map(|x| x / largest);
        }
        Limit {
            flat,
            flat_within,
            motion,
        }
    }

    /// What a dimension is now: an enclosure.
    pub fn value(&self, index: usize) -> Interval {
        Setting::now(&self.problem, index).value()
    }
}

fn stopped(reason: String) -> Run {
    Run {
        end: End::Stopped(reason),
        t: (0.0, 0.0),
        orientations: Vec::new(),
        tubes: 0,
        rejected: 0,
        length: 0.0,
        switched_on: Vec::new(),
    }
}

/// The equations of a problem, or what is at fault.
fn lowered(problem: &Problem, from: Option<&Record>) -> Result<Lowered, String> {
    try_lower_all(problem, from).map_err(|(owner, fault)| match owner {
        Owner::Object(o) => format!("`{}`: {fault}", problem.objects[o].name),
        Owner::Constraint(c) => format!("`{}`: {fault}", problem.constraint_name(c)),
    })
}

/// Enclosures of a polynomial's coefficients, divided by a power of two.
fn enclosed(polynomial: &[Real], scale: f64) -> Vec<Interval> {
    let per = point(1.0 / scale);
    polynomial.iter().map(|c| c.enclose() * per).collect()
}

/// Whether a right-hand side changes with t.
fn moves(right: &[Real]) -> bool {
    right.iter().skip(1).any(|c| !c.is_zero())
}

/// Whether a polynomial is positive on all of [0, 1].
fn is_positive(polynomial: &[Real]) -> bool {
    const PIECES: u32 = 64;
    let c = enclosed(polynomial, 1.0);
    let step = 1.0 / f64::from(PIECES);
    (0..PIECES).all(|k| {
        let time = hull(f64::from(k) * step, f64::from(k + 1) * step);
        c.iter()
            .rev()
            .fold(point(0.0), |sum, c| sum * time + *c)
            .inf()
            > 0.0
    })
}

/// Triples of points, in order, each once.
#[derive(Default)]
struct Triples(BTreeSet<Vec<usize>>);

impl Triples {
    fn put(&mut self, mut points: Vec<usize>) {
        points.sort_unstable();
        points.dedup();
        if points.len() == 3 {
            self.0.insert(points);
        }
    }
}

/// Points of which the orientation tells a sense that constraints in the plane leave open: both legs of an angle, the ends
/// of a line and the centre of what touches it.
fn senses(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out = Triples::default();
    let points_of = |item: &Item| match *item {
        Item::Point(p) => vec![p],
        Item::Object(o) => match problem.objects[o].shape {
            Shape::Line(ends) => ends.to_vec(),
            Shape::Round { center, .. } | Shape::Arc { center, .. } => vec![center],
            _ => Vec::new(),
        },
        Item::Axis(_) => Vec::new(),
    };
    let kinds = ["angles", "tangent", "perpendicular", "distances"];
    let all = problem.constraints.iter();
    for constraint in all.filter(|c| problem.dimension == 2 && kinds.contains(&c.kind.as_str())) {
        let points: Vec<usize> = constraint.items.iter().flat_map(points_of).collect();
        match *points.as_slice() {
            [a, b, c] => out.put(vec![a, b, c]),
            // A point of one line with the other line.
            [a, b, c, d] => {
                out.put(vec![a, b, c]);
                out.put(vec![a, b, d]);
            }
            _ => {}
        }
    }
    out.0.into_iter().collect()
}

/// The same, and three points joined by two distances.
fn followed(problem: &Problem) -> Vec<Vec<usize>> {
    let mut out = Triples(senses(problem).into_iter().collect());
    let plane = problem.dimension == 2;
    for (index, distance) in problem.distances.iter().enumerate().filter(|_| plane) {
        let [a, b] = distance.points;
        for other in &problem.distances[index + 1..] {
            let [c, d] = other.points;
            if [c, d].contains(&a) || [c, d].contains(&b) {
                out.put(vec![a, b, c, d]);
            }
        }
    }
    out.0.into_iter().collect()
}
