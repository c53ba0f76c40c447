//! A figure of which dimensions are anywhere within limits.

use super::ending::{Edited, Keep};
use super::open::OpenError;
use super::setting::{Setting, measure_of};
use super::way::Way as _;
use super::whole::Whole;
use crate::blocks::Account;
use crate::constraint::{Measure, try_lower_apart};
use crate::interval::{Interval, Real, enclose_rational, hull, point};
use crate::problem::{Decimal, Problem, Target};
use crate::rational::Rational;
use crate::system::{Homotopy, Located, Right};
use crate::track::{Control, Options, StartError};
use num_traits::Zero;
use std::f64::consts::PI;
use std::rc::Rc;
use std::slice;

/// Between which values a dimension is.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// The index, as in [`Setting`].
    pub index: usize,
    /// The least and the greatest value.
    pub values: [Decimal; 2],
}

/// A value of a dimension, and what equations say then.
#[derive(Debug)]
pub(crate) struct Value {
    /// The value.
    pub decimal: Decimal,
    /// The right-hand sides of the equations that have it.
    rights: Vec<Interval>,
}

/// For each of the limits between which values the dimension is.
pub(crate) type Part = Vec<[Rc<Value>; 2]>;

/// A figure and its equations, of which dimensions are anywhere within limits.
pub(crate) struct Limited {
    whole: Whole,
    limits: Vec<Limits>,
    /// The right-hand sides with the dimensions as they are given.
    now: Vec<Interval>,
    /// For each of the limits the equations that have the dimension. Of a turn: the one that has its cosine, and the one that has its sine.
    equations: Vec<Vec<usize>>,
    /// All choices.
    pub within: Part,
    /// These and the dimensions as they are given, and all between.
    pub all: Part,
}

impl Limited {
    /// Takes the sketch of a checked problem for the figure, as [`super::Session`] does.
    ///
    /// Limits are those of distances between points and of constraints of which the right-hand side of each equation grows with the
    /// value, or falls, and is that of no other dimension ([`try_lower_apart`]); or of turns, of which one equation has the cosine and one the
    /// sine.
    pub fn open(
        problem: &Problem,
        limits: &[Limits],
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, OpenError> {
        let mut whole = Whole::open_lowered(problem, try_lower_apart, options, control)?;
        let now = whole.rights_now();
        let mut limited = Limited {
            whole,
            limits: limits.to_vec(),
            equations: Vec::new(),
            within: Vec::new(),
            all: Vec::new(),
            now,
        };
        for (k, one) in limits.iter().enumerate() {
            let mut ends = Vec::new();
            for value in &one.values {
                ends.push(limited.rights_with(k, value)?);
            }
            // Those that are not this dimension's stay what they are.
            let changes = |e: &usize| ends.iter().any(|end| end[*e] != limited.now[*e]);
            let own: Vec<usize> = match limited.is_turn(k) {
                true => limited.cosine_and_sine(k)?,
                false => (0..limited.now.len()).filter(changes).collect(),
            };
            if own
                .iter()
                .any(|e| limited.equations.iter().flatten().any(|other| other == e))
            {
                let name = problem.dimension_name(one.index);
                let what = format!(
                    "{name}: an equation has the number of another dimension with limits as well; give one of both none"
                );
                return Err(StartError::Unsupported(what).into());
            }
            limited.equations.push(own);
            let [low, high] = [0, 1].map(|end| limited.value_of(k, &one.values[end], &ends[end]));
            let ends = [low, high];
            let mut all = ends.clone();
            if let Target::Length(given) = Setting::now(problem, one.index).target {
                let now = limited.value_of(k, &given, &limited.now);
                if given.value() < one.values[0].value() {
                    all[0] = now;
                } else if given.value() > one.values[1].value() {
                    all[1] = now;
                }
            }
            limited.within.push(ends);
            limited.all.push(all);
        }
        Ok(limited)
    }

    /// Whether it is a turn, of which cosine and sine go together.
    pub fn is_turn(&self, k: usize) -> bool {
        measure_of(self.whole.problem(), self.limits[k].index) == Measure::Turn
    }

    /// The equation that has the cosine of a turn, and the one that has its sine, and nothing else: those whose right-hand sides change with it,
    /// as they do for some angles together.
    fn cosine_and_sine(&mut self, k: usize) -> Result<Vec<usize>, OpenError> {
        let index = self.limits[k].index;
        let Target::Length(given) = Setting::now(self.whole.problem(), index).target else {
            unreachable!("only distances are given by their squares")
        };
        let mut changed = vec![[false; 3]; self.now.len()];
        // Somewhere on the way to two angles what depends on it is another number.
        for further in [0, 50, 110] {
            let at = given.plus(&Decimal::from(further));
            let at = at.map_err(|error| StartError::Unsupported(error.to_string()))?;
            let circle = on_circle(at.value());
            let rights = self.rights_with(k, &at)?;
            for ((right, now), changed) in rights.iter().zip(&self.now).zip(&mut changed) {
                let is_at = |part: usize| (*right - circle[part]).contains(0.0);
                let known = [right != now, !is_at(0), !is_at(1)];
                for (all, one) in changed.iter_mut().zip(known) {
                    *all |= one;
                }
            }
        }
        let mut own = (0..changed.len()).filter(|&e| changed[e][0]);
        let own = [own.next(), own.next(), own.next()];
        match own {
            [Some(a), Some(b), None] if !changed[a][1] && !changed[b][2] => Ok(vec![a, b]),
            [Some(a), Some(b), None] if !changed[b][1] && !changed[a][2] => Ok(vec![b, a]),
            _ => {
                let name = self.whole.problem().dimension_name(index);
                let what = format!(
                    "{name}: its cosine and sine stand in other equations as well; give it no limits"
                );
                Err(StartError::Unsupported(what).into())
            }
        }
    }

    /// A value of the dimension of one of the limits.
    pub fn value(&mut self, k: usize, decimal: Decimal) -> Result<Rc<Value>, OpenError> {
        let rights = self.rights_with(k, &decimal)?;
        Ok(self.value_of(k, &decimal, &rights))
    }

    /// The same, of which all right-hand sides are known.
    fn value_of(&self, k: usize, decimal: &Decimal, rights: &[Interval]) -> Rc<Value> {
        let own = self.equations[k].iter().map(|&e| rights[e]);
        Rc::new(Value {
            decimal: decimal.clone(),
            rights: own.collect(),
        })
    }

    /// All right-hand sides with another value of the dimension of one of the limits.
    fn rights_with(&mut self, k: usize, decimal: &Decimal) -> Result<Vec<Interval>, OpenError> {
        let setting = Setting::to(self.limits[k].index, decimal.clone());
        self.whole.rights_with(&setting)
    }

    /// The right-hand sides over all choices of a part.
    pub fn rights(&self, part: &Part) -> Vec<Interval> {
        let mut rights = self.now.clone();
        for (k, (own, ends)) in self.equations.iter().zip(part).enumerate() {
            let ranges = self.ranges_of(k, ends);
            for (&e, range) in own.iter().zip(ranges) {
                rights[e] = range;
            }
        }
        rights
    }

    /// The ranges of the right-hand sides of one of the limits as the dimension goes from one value to another.
    fn ranges_of(&self, k: usize, [low, high]: &[Rc<Value>; 2]) -> Vec<Interval> {
        let ends = low.rights.iter().zip(&high.rights);
        let mut ranges: Vec<Interval> = ends.map(|(low, high)| low.convex_hull(*high)).collect();
        if self.is_turn(k) {
            // Each is 1 or −1 at every other right angle between.
            let right = Rational::from_integer(90.into());
            let [from, to] = [low, high].map(|end| end.decimal.value() / &right);
            let mut angle = from.ceil().to_integer();
            while Rational::from_integer(angle.clone()) <= to {
                let corner = on_circle(&(Rational::from_integer(angle.clone()) * &right));
                let is_even = (&angle % 2i32).is_zero();
                let at = usize::from(!is_even);
                ranges[at] = ranges[at].convex_hull(corner[at]);
                angle += 1;
            }
        }
        ranges
    }

    /// The equations that have the dimension of one of the limits, and by how much their right-hand sides grow as it goes through part of these. Of a
    /// turn, both of which go together: by how much they would if each grew all the way as fast as at any place.
    pub fn growth(&self, k: usize, part: &Part) -> Vec<(usize, Interval)> {
        let [low, high] = &part[k];
        if self.is_turn(k) {
            return self.turned(k, &part[k], &self.ranges_of(k, &part[k]));
        }
        let grown = high.rights.iter().zip(&low.rights);
        let grown = grown.map(|(high, low)| *high - *low);
        self.equations[k].iter().copied().zip(grown).collect()
    }

    /// The same over all choices, about; of a turn as fast as at what is given.
    pub fn first_order(&self, k: usize) -> Vec<(usize, Interval)> {
        if !self.is_turn(k) {
            return self.growth(k, &self.within);
        }
        let given = self.equations[k].iter().map(|&e| self.now[e]);
        self.turned(k, &self.within[k], &given.collect::<Vec<_>>())
    }

    /// What cosine and sine of a turn grow by from one value to another, as fast as where they are these all the way.
    fn turned(
        &self,
        k: usize,
        [low, high]: &[Rc<Value>; 2],
        at: &[Interval],
    ) -> Vec<(usize, Interval)> {
        let by = enclose_rational(&(high.decimal.value() - low.decimal.value()));
        let by = by * hull(PI, PI.next_up()) / point(180.0);
        let own = &self.equations[k];
        vec![(own[0], -at[1] * by), (own[1], at[0] * by)]
    }

    /// Where the unknowns are with the dimensions as they are given, in the homotopy's unit, and the right-hand sides.
    pub fn given(&self) -> (Vec<Interval>, Vec<Interval>) {
        let unknowns = 0..self.homotopy().equations;
        (
            unknowns.map(|i| self.nominal(i)).collect(),
            self.now.clone(),
        )
    }

    /// Whether the dimensions as they are given are a choice of a part.
    pub fn is_given_in(&self, part: &Part) -> bool {
        let all = self.now.iter().zip(self.rights(part));
        all.into_iter().all(|(now, range)| now.subset(range))
    }

    /// Whether other equations are the same, with the same ranges.
    pub fn is_same(&self, other: &Limited) -> bool {
        let (one, two) = (self.homotopy(), other.homotopy());
        let mut rows = 0..one.equations;
        let rights = [self, other].map(|limited| limited.rights(&limited.all));
        (one.equations, one.unit) == (two.equations, two.unit)
            && rights[0] == rights[1]
            && rows.all(|e| one.terms(e) == two.terms(e))
    }

    /// The equations' homotopy.
    pub fn homotopy(&self) -> &Homotopy {
        self.whole.homotopy()
    }

    /// The equations with the ranges of their right-hand sides at t = 1.
    pub fn ranges(&self) -> Homotopy {
        let mut homotopy = self.homotopy().clone();
        for (right, range) in homotopy.rights.iter_mut().zip(self.rights(&self.all)) {
            *right = Right::anywhere(range);
        }
        homotopy
    }

    /// What is proved of its figures.
    pub fn account(&self) -> Account {
        self.whole.account()
    }

    /// Where an unknown is in the figure with the dimensions as they are given, in the homotopy's unit.
    pub fn nominal(&self, i: usize) -> Interval {
        self.whole.figure().enclosure(i)
    }

    /// The middle of that.
    pub fn centre(&self) -> &[f64] {
        &self.whole.figure().centre
    }

    /// That figure, in the coordinates of the problem.
    pub fn figure(&self) -> Vec<[Interval; 3]> {
        self.whole.points()
    }

    /// Where objects are in that figure.
    pub fn objects(&self) -> Vec<Located> {
        self.whole.objects_of(self.whole.figure())
    }

    /// A figure in the gauge, in lengths of the problem, in the coordinates of the problem.
    pub fn put(&self, places: &[[Interval; 3]]) -> Vec<[Interval; 3]> {
        self.whole.put(places)
    }

    /// Leads dimensions together, in proportion, from what they are given as to others, by a path that is proved.
    pub fn lead(&mut self, to: &[(usize, Rc<Value>)], control: &mut Control) -> Edited {
        let setting = |(k, value): &(usize, Rc<Value>)| {
            Setting::to(self.limits[*k].index, value.decimal.clone())
        };
        let settings: Vec<Setting> = to.iter().map(setting).collect();
        self.whole.edit(&settings, Keep::Never, control)
    }
}

impl Whole {
    /// The right-hand sides with another value of a dimension.
    fn rights_with(&mut self, setting: &Setting) -> Result<Vec<Interval>, OpenError> {
        self.lead_constraints(slice::from_ref(setting))
            .map_err(StartError::Unsupported)?;
        let distances = &self.problem().distances;
        let now = distances.get(setting.index).map(|d| d.target.clone());
        if now.is_some() {
            self.homotopy_mut().hold(setting.index, &setting.target);
        }
        let found = rights(self.homotopy());
        if let Some(now) = now {
            self.homotopy_mut().hold(setting.index, &now);
        }
        Ok(found)
    }

    /// The right-hand sides as they are now.
    fn rights_now(&mut self) -> Vec<Interval> {
        // What an edit of nothing leads constraints to is what they are.
        let _ = self.lead_constraints(&[]);
        rights(self.homotopy())
    }
}

/// The cosine and the sine of an angle in degrees.
fn on_circle(degrees: &Rational) -> [Interval; 2] {
    [
        Real::cosine_of_degrees(degrees.clone()).enclose(),
        Real::sine_of_degrees(degrees.clone()).enclose(),
    ]
}

/// The right-hand sides at t = 1.
fn rights(homotopy: &Homotopy) -> Vec<Interval> {
    let all = homotopy.rights.iter();
    all.map(|right| right.at_target()).collect()
}
