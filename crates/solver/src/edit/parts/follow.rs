//! Following what moves, part by part, and what the parts come to together.

use super::exact::{is_positive, value_at};
use super::{Parts, Used, moves, put};
use crate::constraint::{Entry, Equation, Form, Product, Role, value};
use crate::interval::{Interval, Real, hull, point};
use crate::order::add_new;
use crate::sets::Joined;
use crate::system::{Homotopy, Part, Right, Segment};
use crate::track::arc::{ArcEnd, ArcRun, Figure, Fold};
use crate::track::certified::arcs;
use crate::track::{Control, LARGEST_SQUARE, Stop, StopKind};
use std::collections::{BTreeSet, HashMap};
use std::iter;
use std::ops::Range;

/// What became of one part.
struct PartRun {
    unknowns: Vec<usize>,
    /// What was looked at along it, by place.
    beside: Vec<usize>,
    run: ArcRun,
}

/// The part that was followed least far, of those that were not followed to their ends.
fn worst(runs: &[PartRun]) -> Option<usize> {
    let open = |&k: &usize| !matches!(runs[k].run.end, ArcEnd::Reached(_));
    let ended = (0..runs.len()).filter(open);
    ended.min_by(|&a, &b| runs[a].run.t.0.total_cmp(&runs[b].run.t.0))
}

impl Parts {
    pub(super) fn rights_of(&self, used: Used, rights: &[Vec<Real>]) -> Vec<Real> {
        match used {
            Used::Row(row) => rights[self.cut.system.rows[row].index].clone(),
            Used::Held(u) => {
                let change = self.led.get(&u).cloned();
                iter::once(self.cut.system.values[u].clone())
                    .chain(change)
                    .collect()
            }
        }
    }

    fn power_of(&self, used: Used) -> i32 {
        match used {
            Used::Row(row) => self.cut.powers[self.cut.system.rows[row].index],
            Used::Held(u) => self.cut.system.unknowns[u].power,
        }
    }

    /// Follows all that moves from t = 0 to t = 1.
    pub(super) fn follow(&mut self, rights: &[Vec<Real>], control: &mut Control) -> ArcRun {
        self.follow_with_places(rights, control).0
    }

    /// The same, with the places of what is looked at, in the order of [`ArcRun::beside`].
    pub(super) fn follow_with_places(
        &mut self,
        rights: &[Vec<Real>],
        control: &mut Control,
    ) -> (ArcRun, Vec<usize>) {
        let moving = self.moving(rights);
        let exact = self.exact_polynomials(rights, &moving);
        let groups = self.groups(&moving);
        let mut runs = Vec::new();
        for group in &groups {
            let run = self.follow_group(group, rights, control);
            let is_reached = matches!(run.run.end, ArcEnd::Reached(_));
            runs.push(run);
            if !is_reached && control.is_interrupted() {
                break;
            }
        }
        if let Some(k) = worst(&runs)
            && runs.len() > 1
            && matches!(runs[k].run.end, ArcEnd::Limit(_))
        {
            // All together, so that the whole figure at the limit is enclosed.
            let all: Vec<usize> = groups.concat();
            runs = vec![self.follow_group(&all, rights, control)];
        }
        let worst = worst(&runs);
        let t = worst.map_or((1.0, 1.0), |k| runs[k].run.t);
        let upto = hull(t.0.min(0.0), t.1.min(1.0));
        let mut besides = self.exact_besides((&exact, rights), upto);
        for PartRun { beside, run, .. } in &runs {
            besides.extend(beside.iter().copied().zip(run.beside.iter().copied()));
        }
        let (places, beside) = besides.into_iter().unzip();
        let run = self.combine(runs, worst, &exact, (t, upto));
        (ArcRun { beside, ..run }, places)
    }

    /// Which blocks move.
    pub(super) fn moving(&self, rights: &[Vec<Real>]) -> Vec<bool> {
        let mut moving = vec![false; self.cut.blocks.blocks.len()];
        for (b, block) in self.cut.blocks.blocks.iter().enumerate() {
            moving[b] = block.needs.iter().any(|&need| moving[need])
                || block.equations.iter().any(|&e| match self.cut.used[e] {
                    Used::Row(row) => moves(&rights[self.cut.system.rows[row].index]),
                    Used::Held(u) => self.led.contains_key(&u),
                });
        }
        moving
    }

    /// The moving blocks that have to be followed, in groups that have nothing in common but numbers known exactly.
    fn groups(&self, moving: &[bool]) -> Vec<Vec<usize>> {
        let count = moving.len();
        let mut sets = Joined::new(count);
        let is_open = |b: &usize| !self.cut.is_exact[*b];
        let mut taken: BTreeSet<usize> = (0..count).filter(|&b| moving[b]).collect();
        taken.retain(is_open);
        for of in &self.together {
            if !of.iter().any(|&b| moving[b]) {
                continue;
            }
            let of: Vec<usize> = of.iter().copied().filter(is_open).collect();
            sets.join_all(&of);
            taken.extend(of);
        }
        let with_needs = self.cut.blocks.with_needs(taken);
        let not_exact: Vec<usize> = with_needs.into_iter().filter(is_open).collect();
        for &b in &not_exact {
            let needs = self.cut.blocks.blocks[b].needs.iter().copied();
            for need in needs.filter(is_open) {
                sets.join([b, need]);
            }
        }
        let mut groups: HashMap<usize, Vec<usize>> = HashMap::new();
        for b in not_exact {
            groups.entry(sets.of(b)).or_default().push(b);
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
        let taken = self.cut.blocks.with_needs(group.iter().copied());
        let is_open = |b: &usize| taken.contains(b) && !self.cut.is_exact[*b];
        for of in &self.together {
            if of.iter().any(is_open) {
                blocks.extend(of);
            }
        }
        let blocks = self.cut.blocks.with_needs(blocks);
        let all = || blocks.iter().map(|&b| &self.cut.blocks.blocks[b]);
        let unknowns = all().flat_map(|block| block.unknowns.iter().copied());
        let unknowns: Vec<usize> = unknowns.collect();
        let equations = all().flat_map(|block| &block.equations);
        let used: Vec<Used> = equations.map(|&e| self.cut.used[e]).collect();
        if unknowns.len() > LARGEST_SQUARE {
            let reason = format!(
                "a part has {} unknowns, more than the {LARGEST_SQUARE} of which proofs keep square matrices",
                unknowns.len()
            );
            let run = ArcRun::stopped(Stop::new(StopKind::Refused, reason));
            return PartRun {
                unknowns,
                beside: Vec::new(),
                run,
            };
        }
        let mut follower = match self.ready.0.remove(&blocks) {
            Some(mut follower) => {
                let homotopy = follower.homotopy_mut();
                for (k, &used) in used.iter().enumerate() {
                    let scale = self.cut.unit.powi(self.power_of(used));
                    homotopy.rights[k] = Right::polynomial(&self.rights_of(used, rights), scale);
                }
                follower
            }
            None => arcs(self.homotopy(&unknowns, &used, rights), &self.options),
        };
        let of = |all: &[f64]| unknowns.iter().map(|&u| all[u]).collect();
        let start = Figure {
            centre: of(&self.figure.centre),
            low: of(&self.figure.low),
            radius: of(&self.figure.radius),
        };
        let run = follower.follow(&start, control);
        self.ready.0.insert(blocks, follower);
        PartRun {
            beside: self.looked_at_in(&unknowns).collect(),
            unknowns,
            run,
        }
    }

    fn homotopy(&self, unknowns: &[usize], used: &[Used], rights: &[Vec<Real>]) -> Homotopy {
        let local: HashMap<usize, usize> =
            unknowns.iter().enumerate().map(|(k, &u)| (u, k)).collect();
        let entry = |unknown: Option<usize>| Entry::from(unknown.map(|u| local[&u]));
        let equation = |used: Used| {
            let (name, products) = match used {
                Used::Row(row) => {
                    let row = &self.cut.system.rows[row];
                    let products = row.products.iter().map(|p| p.map(entry));
                    (self.cut.name(row.index), products.collect())
                }
                Used::Held(u) => {
                    let name = format!("{} stays put", self.cut.system.unknowns[u].name);
                    (
                        name,
                        vec![Product::new(2, value(entry(Some(u))), Form::One)],
                    )
                }
            };
            Equation {
                name,
                products,
                right: self.rights_of(used, rights),
                power: self.power_of(used),
            }
        };
        let equations = used.iter().map(|&used| equation(used));
        let beside = self.looked_at_in(unknowns);
        let beside = beside.map(|k| {
            (
                equation(Used::Row(self.cut.redundant[k])),
                self.within(k, rights),
            )
        });
        let d = self.cut.problem.dimension;
        let coordinates = self.cut.system.coordinates.iter();
        let is_here = |points: &[usize], axes: Range<usize>| {
            let mut unknowns = self.places(points, axes);
            unknowns.all(|u| local.contains_key(&u))
        };
        let followed = self.followed.iter().filter(|points| is_here(points, 0..d));
        let segments = self.segments.iter().filter(|segment| {
            let unknowns = self.unknowns_of_extent(&segment.extent);
            unknowns.iter().all(|u| local.contains_key(u))
        });
        let segments = segments.map(|segment| Segment {
            extent: segment.extent.map(|u| local[&u]),
            ..*segment
        });
        let mut homotopy = Homotopy::of_part(Part {
            nonzero: self.cut.system.nonzero_in(d, &local),
            dimension: d,
            unit: self.cut.unit,
            unknowns: unknowns
                .iter()
                .map(|&u| self.cut.system.unknowns[u].clone())
                .collect(),
            equations: equations.collect(),
            followed: followed.cloned().collect(),
            segments: segments.collect(),
            beside: beside.collect(),
            coordinates: coordinates.map(|u| local.get(u).copied()).collect(),
        });
        let names = self.cut.problem.points.iter().map(|p| p.name.clone());
        homotopy.point_names = names.collect();
        homotopy
    }

    /// What the parts come to together.
    fn combine(
        &self,
        runs: Vec<PartRun>,
        worst: Option<usize>,
        exact: &HashMap<usize, Vec<Real>>,
        (t, upto): ((f64, f64), Interval),
    ) -> ArcRun {
        let mut out = ArcRun {
            t,
            orientations: self.exact_orientations(exact, upto),
            segments: self.exact_segments(exact, upto),
            steps: runs.iter().map(|run| run.run.steps).sum(),
            rejected: runs.iter().map(|run| run.run.rejected).sum(),
            length: runs.iter().map(|run| run.run.length).sum(),
            ..ArcRun::stopped(Stop::new(StopKind::Bug, ""))
        };
        for run in &runs {
            for remark in &run.run.switched_on {
                add_new(&mut out.switched_on, remark.clone());
            }
            out.orientations
                .extend(run.run.orientations.iter().cloned());
            out.segments.extend(run.run.segments.iter().cloned());
        }
        // Nothing is said of a piece of path beyond where all of it ends.
        for orientation in &mut out.orientations {
            orientation.lost = orientation.lost.filter(|lost| lost.0 <= t.1);
        }
        let undefined = |out: ArcRun, words: String| ArcRun {
            end: ArcEnd::Stopped(Stop::new(StopKind::Undefined, words)),
            t: (0.0, 0.0),
            ..out
        };
        for (&u, polynomial) in exact {
            if self.cut.system.unknowns[u].role == Role::Positive && !is_positive(polynomial) {
                let name = &self.cut.system.unknowns[u].name;
                let words = format!("{name} does not stay positive");
                return undefined(out, words);
            }
        }
        if let Some(name) = self.vanishes_exactly(exact) {
            let words = format!(
                "{name} may vanish on the way, and what is said of its direction would say nothing there"
            );
            return undefined(out, words);
        }
        let paths = self.paths(exact);
        let at = |time: Interval| {
            let mut figure = self.figure.clone();
            for (&u, path) in &paths {
                put(&mut figure, u, value_at(path, time));
            }
            figure
        };
        let take = |figure: &mut Figure, unknowns: &[usize], found: &Figure| {
            for (k, &u) in unknowns.iter().enumerate() {
                // Numbers known exactly are known better.
                if !exact.contains_key(&u) {
                    figure.centre[u] = found.centre[k];
                    figure.low[u] = found.low[k];
                    figure.radius[u] = found.radius[k];
                }
            }
        };
        let Some(worst) = worst else {
            let mut figure = at(point(1.0));
            for PartRun { unknowns, run, .. } in &runs {
                if let ArcEnd::Reached(found) = &run.end {
                    take(&mut figure, unknowns, found);
                }
            }
            out.end = ArcEnd::Reached(figure);
            return out;
        };
        let PartRun { unknowns, run, .. } = &runs[worst];
        out.end = match &run.end {
            ArcEnd::Limit(fold) => {
                let mut figure = at(fold.t);
                take(&mut figure, unknowns, &fold.figure);
                // What is in no part that is followed has no velocity.
                let of_all = |of: &[f64]| {
                    let mut all = vec![0.0; figure.centre.len()];
                    unknowns.iter().zip(of).for_each(|(&u, &x)| all[u] = x);
                    all
                };
                ArcEnd::Limit(Box::new(Fold {
                    velocity: of_all(&fold.velocity),
                    velocity_radius: of_all(&fold.velocity_radius),
                    normal: of_all(&fold.normal),
                    t: fold.t,
                    // That is told of the part alone.
                    alone_within: 0.0,
                    figure,
                }))
            }
            other => other.clone(),
        };
        out
    }
}
