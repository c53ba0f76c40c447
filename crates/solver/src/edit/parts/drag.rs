//! A figure led so that points come to where they are wanted, or as near as it can.
//!
//! What nothing determines is chosen anew for each leg, the coordinates of these points first, and led straight to where it is in the
//! nearest figure that has them there: of all figures the one that Newton's method with least changes finds. So the rest moves little.
//! That figure is found in floats; what is proved is the way to it.

use super::left_out::at_rest_all;
use super::{Parts, put};
use crate::blocks::{Choice, FINE, FREE_FIRST, Floats};
use crate::constraint::{Equation, try_lower_all};
use crate::edit::drag::{Drag, Dragged};
use crate::edit::ending::Edited;
use crate::edit::way::Way as _;
use crate::interval::{Real, enclose, point};
use crate::places::{Each as _, array};
use crate::problem::Decimal;
use crate::track::arc::{ArcEnd, ArcRun};
use crate::track::{Control, Stop, StopKind};
use std::collections::BTreeSet;
use std::mem;
use std::time::Instant;

/// So often a leg is tried on one way.
const MOST_LEGS: usize = 40;
/// Tubes of a leg.
const MOST_TUBES: usize = 300;
/// Where points are not where they are wanted a leg that brings them nearer by less than this part of what is left is the last.
const LEAST_GAIN: f64 = 1e-6;
/// Points are not led by a smaller part of the way to where they are wanted at once.
const LEAST_PART: f64 = 1e-3;
/// A figure that is nearer than this to the one that is wanted is it, as a part of its size.
const NEAR: f64 = 1e-9;
/// So often points are put to where they are wanted, and the figure is corrected, to find the one nearest to that; and not once more where that
/// brings them nearer by less than this part of what is left.
const ROUNDS: usize = 60;
const LEAST_ROUND: f64 = 1e-12;

/// A way that ends so near to the figure that is wanted ends beside a dead centre, as far as one can see: as a part of its size.
const BESIDE: f64 = 1e-3;

/// A point is where it was wanted if it is no further from there than this, as a part of the figure's size.
const THERE: f64 = 1e-9;

/// A coordinate of a point that is dragged.
struct Wanted {
    unknown: usize,
    value: Real,
    /// The same in floats, in the homotopy's unit.
    near: f64,
}

impl Parts {
    /// Drags points. The figure is then the one that was come to.
    pub fn drag(&mut self, drags: &[Drag], control: &mut Control) -> Edited {
        let clock = Instant::now();
        let size = self.size(drags);
        let (mut legs, mut led): (Vec<Edited>, BTreeSet<String>) = Default::default();
        let stop = self.drag_on(drags, size / self.cut.unit, (&mut legs, &mut led), control);
        let stop = stop.err();
        let mut edited = match legs.split_last() {
            Some((last, before)) => self.joined(last, before, (last, 0.0)),
            None => self.standing_still(),
        };
        edited.account.held.retain(|held| !led.contains(&held.what));
        let off = |drag: &Drag| {
            let to = drag.to.iter().zip(&edited.points[drag.point]);
            let square = to.fold(point(0.0), |sum, (to, at)| sum + (*at - enclose(to)).sqr());
            (drag.clone(), square.sqrt())
        };
        let places: Vec<_> = drags.iter().map(off).collect();
        edited.dragged = Some(Dragged {
            is_there: places.iter().all(|(_, off)| off.sup() <= THERE * size),
            places,
            led: led.into_iter().collect(),
            legs: legs.len(),
            stop,
        });
        edited.seconds = clock.elapsed().as_secs_f64();
        edited
    }

    /// Goes on until the points are where they are wanted, or as near as a figure is found that has them; or why not so far.
    fn drag_on(
        &mut self,
        drags: &[Drag],
        size: f64,
        (legs, led): (&mut Vec<Edited>, &mut BTreeSet<String>),
        control: &mut Control,
    ) -> Result<(), Stop> {
        let undecided = |why: &str| Stop::new(StopKind::Undecided, why);
        let lowered = try_lower_all(&self.cut.problem, Some(&self.cut.record));
        let equations = lowered.map_err(|_| undecided("its equations cannot be made"))?;
        let equations = equations.tail.equations;
        let wanted = self.wanted(drags);
        let mut part = 1.0;
        for _ in 0..MOST_LEGS {
            if control.is_interrupted() {
                return Err(Stop::new(StopKind::Interrupted, "it was interrupted"));
            }
            let away = self.away(&wanted);
            let (near, is_met) = self.nearest(&equations, &wanted, part);
            let far = self.far_from(&near);
            if far < NEAR * size && part == 1.0 {
                return Ok(());
            }
            let mut stop = None;
            // A figure at the end of what can be reached is come near to by halves.
            let steps = if is_met { &[1.0][..] } else { &[1.0, 0.5] };
            let exact = if is_met && part == 1.0 {
                &wanted[..]
            } else {
                &[]
            };
            let found = steps.iter().find_map(|&step| {
                let mut there = self.clone();
                match there.leg(&equations, (&near, step), (&wanted, exact), control) {
                    // Not to another figure with the same numbers, and not nowhere.
                    Ok(leg) => {
                        let is_nearer = there.far_from(&near) <= (1.0 - 0.5 * step) * far;
                        is_nearer.then_some((there, leg))
                    }
                    Err(why) => {
                        stop.get_or_insert(why);
                        None
                    }
                }
            });
            match found {
                Some((there, (leg, names))) => {
                    *self = there;
                    legs.push(leg);
                    led.extend(names);
                    if part == 1.0 && self.away(&wanted) > (1.0 - LEAST_GAIN) * away {
                        return Ok(());
                    }
                    part = f64::min(2.0 * part, 1.0);
                }
                None if part > LEAST_PART => part *= 0.5,
                None => {
                    let is_at_edge =
                        |stop: &Stop| matches!(stop.kind, StopKind::Vanishes | StopKind::Touches);
                    if far < BESIDE * size && !stop.as_ref().is_some_and(is_at_edge) {
                        let words = "the figure seems to be all but at a dead centre";
                        return Err(Stop::new(StopKind::Singular, words));
                    }
                    return Err(
                        stop.unwrap_or_else(|| undecided("no figure near that place was found"))
                    );
                }
            }
        }
        let words = format!("it was given up after {MOST_LEGS} attempts");
        match self.away(&wanted) < NEAR * size {
            true => Ok(()),
            false => Err(Stop::new(StopKind::Limit, words)),
        }
    }

    /// The size of the figure and of the places where points are wanted: how far any of them is from the first along an axis, or, where all are in
    /// one place, from the origin.
    fn size(&self, drags: &[Drag]) -> f64 {
        let points = self.points();
        let points = points.iter().map(|p| p.each(|x| x.mid()));
        let wanted = drags
            .iter()
            .map(|drag| array(|k| drag.to.get(k).map_or(0.0, Decimal::to_f64)));
        let all: Vec<[f64; 3]> = points.chain(wanted).collect();
        let far = |from: [f64; 3]| {
            let off = all
                .iter()
                .flat_map(|p| (0..3).map(move |k| (p[k] - from[k]).abs()));
            off.fold(0.0, f64::max)
        };
        match far(all[0]) {
            0.0 => far([0.0; 3]).max(self.cut.unit),
            size => size,
        }
    }

    /// How far the points are from where they are wanted, in the unit of length.
    fn away(&self, wanted: &[Wanted]) -> f64 {
        let off = wanted
            .iter()
            .map(|w| self.figure.centre[w.unknown] - w.near);
        off.map(|x| x * x).sum::<f64>().sqrt()
    }

    /// How far an unknown is at most from where it is in another figure, in the unit of length.
    fn far_from(&self, near: &[f64]) -> f64 {
        let both = self.figure.centre.iter().zip(near);
        both.fold(0.0, |far: f64, (a, b)| far.max((a - b).abs()))
    }

    /// Coordinates of points that are dragged.
    fn wanted(&self, drags: &[Drag]) -> Vec<Wanted> {
        let d = self.cut.problem.dimension;
        let all = drags.iter().flat_map(|drag| {
            let places = drag.to.iter().take(d).enumerate();
            places.map(|(axis, to)| Wanted {
                unknown: self.cut.coordinate(drag.point, axis),
                value: Real::from(to.value().clone()),
                near: to.to_f64() / self.cut.unit,
            })
        });
        all.collect()
    }

    /// A figure that meets all constraints, in floats, and has points this part of the way to where they are wanted, and whether one was found;
    /// or else one that has them nearer to that than they are, as near as is found.
    fn nearest(&self, equations: &[Equation], wanted: &[Wanted], part: f64) -> (Vec<f64>, bool) {
        let floats = Floats::new(&self.cut.system, equations, self.cut.unit);
        let rows: Vec<usize> = (0..self.cut.system.rows.len()).collect();
        let at = self.figure.centre.clone();
        let goal = |w: &Wanted| at[w.unknown] + part * (w.near - at[w.unknown]);
        let put = |from: &[f64], part: f64| {
            let mut there = from.to_vec();
            for w in wanted {
                there[w.unknown] += part * (goal(w) - there[w.unknown]);
            }
            there
        };
        let exact = floats.zero(put(&at, 1.0), &|x| {
            let (jacobian, off) = floats.linearise(&rows, x);
            let (m, more) = (rows.len(), wanted.len());
            let (mut jacobian, mut off) = (
                jacobian.resize_vertically(m + more, 0.0),
                off.resize_vertically(m + more, 0.0),
            );
            for (k, w) in wanted.iter().enumerate() {
                jacobian[(m + k, w.unknown)] = 1.0;
                off[m + k] = x[w.unknown] - goal(w);
            }
            (jacobian, off)
        });
        if let Some(there) = exact {
            return (there, true);
        }
        let off = |at: &[f64]| {
            let off = wanted.iter().map(|w| (at[w.unknown] - goal(w)).powi(2));
            off.sum::<f64>()
        };
        let mut there = at.clone();
        for _ in 0..ROUNDS {
            // From too far away no figure is found.
            let parts = std::iter::successors(Some(1.0), |part| Some(0.5 * part));
            let mut parts = parts.take_while(|&part| part > LEAST_PART);
            let nearer = |next: &Vec<f64>| off(next) < (1.0 - LEAST_ROUND) * off(&there);
            let next = parts.find_map(|part| floats.meet(&rows, put(&there, part)).filter(nearer));
            match next {
                Some(next) => there = next,
                None => break,
            }
        }
        (there, false)
    }

    /// A step of the way to a figure, on which what nothing determines is led straight to where it is there. `exact`: what is known exactly of
    /// that. The names of what was led; or why the way ends.
    fn leg(
        &mut self,
        equations: &[Equation],
        (near, step): (&[f64], f64),
        (wanted, exact): (&[Wanted], &[Wanted]),
        control: &mut Control,
    ) -> Result<(Edited, Vec<String>), Stop> {
        let undecided = |why: &str| Stop::new(StopKind::Undecided, why);
        let rights: Vec<Vec<Real>> = equations.iter().map(|e| e.right.clone()).collect();
        let rights = at_rest_all(&rights);
        let at = self.figure.centre.clone();
        let later = self.cut.system.later();
        let rank = |u: usize| match wanted.iter().any(|w| w.unknown == u) {
            true => FREE_FIRST,
            false => later(u),
        };
        let first = |row: usize| self.cut.owner(row).keep(&self.cut.problem);
        let choice = Choice::new(&self.cut.system, &at, rank, first, FINE);
        self.take(choice, &rights)
            .ok_or_else(|| undecided("its equations do not match its unknowns"))?;
        let (mut names, mut reached) = (Vec::new(), Vec::new());
        for u in self.cut.free.clone() {
            let unit = self.cut.unit_of(u);
            let to = match exact.iter().find(|w| w.unknown == u && step == 1.0) {
                Some(w) => w.value.clone(),
                None => Real::within(point(at[u] + step * (near[u] - at[u])) * point(unit)),
            };
            let change = &to - &self.cut.system.values[u];
            if !change.is_zero() {
                names.push(self.cut.system.unknowns[u].name.clone());
                self.led.insert(u, change);
                reached.push((u, to, unit));
            }
        }
        let most = mem::replace(&mut self.options.max_steps, MOST_TUBES);
        let mut run = self.follow(&rights, control);
        self.options.max_steps = most;
        let judged = self.judge((&[], &rights), &mut run, control);
        self.led.clear();
        if let Some(astray) = judged.astray {
            return Err(astray.stop);
        }
        let figure = match &run.end {
            ArcEnd::Reached(figure) => figure.clone(),
            ArcEnd::Limit(_) => {
                return Err(Stop::new(
                    StopKind::TurnsBack,
                    "the figure comes to a limit there",
                ));
            }
            ArcEnd::Passes(stop) | ArcEnd::Stopped(stop) => return Err(stop.clone()),
        };
        self.figure = figure;
        for (u, to, unit) in reached {
            // The number that was led there is off `to` by no more than twice what was not known of it before; the box that was reached holds
            // one figure for each such number, and these are one family, so that for `to` continues the old one as well.
            put(&mut self.figure, u, to.enclose() * point(1.0 / unit));
            self.cut.system.values[u] = to;
        }
        self.verdicts = judged.verdicts;
        let end = ArcEnd::Reached(self.figure.clone());
        let run = ArcRun { end, ..run };
        Ok((self.edited(&[], run, judged.account), names))
    }
}
