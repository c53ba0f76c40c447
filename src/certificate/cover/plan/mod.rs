//! The check of covers of parameter spaces, which searches by a construction plan leave.
//!
//! A cover says of every part of the parameter space why it holds no figure but those listed. Here each reason is
//! proved again, with models, geometry and Krawczyk's test of their own.

mod figure;
mod format;
mod geometry;
mod model;
mod pairs;

pub use format::{Cover, Kind, MAX_SYMBOLS, Mark, Radius};
pub use model::Model;

use super::{CoverError, CoverVerdict};
use crate::interval::{Interval, hull, point};
use figure::Figure;
use geometry::{Node, Place, Plan, dot, minus};

/// Checks a cover.
pub fn verify(bytes: &[u8]) -> Result<CoverVerdict, CoverError> {
    let cover = Cover::from_bytes(bytes)?;
    let mut verdict = CoverVerdict::about(&cover.problem, cover.figures.len())?;
    verdict.flaw = check(&cover, &mut verdict).err();
    Ok(verdict)
}

fn check(cover: &Cover, verdict: &mut CoverVerdict) -> Result<(), String> {
    if !verdict.problem.is_distances_only() {
        return Err("the problem has other constraints than distances".to_owned());
    }
    let plan = Plan::new(&verdict.problem, cover)?;
    let mut figures: Vec<Figure> = Vec::new();
    for (index, centre) in cover.figures.iter().enumerate() {
        let figure = figure::prove(&plan, centre)
            .ok_or_else(|| format!("solution {} is not proved to exist", index + 1))?;
        let image = figure.mirrored(plan.dimension);
        let apart = |known: &Figure| {
            known.is_apart(centre, figure.radius) && known.is_apart(&image, figure.radius)
        };
        if let Some(same) = figures.iter().position(|known| !apart(known)) {
            return Err(format!(
                "the solutions {} and {} may be the same",
                same + 1,
                index + 1
            ));
        }
        figures.push(figure);
    }
    let mut walk = Walk {
        plan: &plan,
        figures: &figures,
        at: 0,
        stack: plan.roots().into_iter().rev().collect(),
        undecided: 0,
    };
    while let Some(node) = walk.stack.pop() {
        verdict.parts += 1;
        let first = walk.stack.len();
        let zero = std::array::from_fn(|_| Model::constant(node.ranges.len(), point(0.0)));
        let mut points = vec![zero; plan.points];
        for (&p, place) in cover.base.iter().zip(&plan.base) {
            points[p] = place.map(|x| Model::constant(node.ranges.len(), x));
        }
        let mut node = node;
        walk.walk(&mut node, 0, &mut points, &mut Vec::new())
            .map_err(|what| format!("part {}: {what}", verdict.parts))?;
        // The parts that it was parted into follow in their order.
        walk.stack[first..].reverse();
    }
    verdict.undecided = walk.undecided;
    match walk.at == cover.marks.len() {
        true => Ok(()),
        false => Err("there are more marks than parts".to_owned()),
    }
}

struct Walk<'a> {
    plan: &'a Plan<'a>,
    figures: &'a [Figure],
    at: usize,
    stack: Vec<Node>,
    undecided: u64,
}

/// What a mark claims is not proved.
const UNPROVED: &str = "what the mark says is not proved";

impl Walk<'_> {
    /// Follows the marks of one part from a step on, whose point does not stand yet.
    fn walk(
        &mut self,
        node: &mut Node,
        mut step: usize,
        points: &mut [Place],
        equations: &mut Vec<Model>,
    ) -> Result<(), String> {
        let steps = self.plan.cover.steps.len();
        loop {
            let (mark, next) = self.mark(node)?;
            if mark == Mark::Undecided {
                self.at = next;
                self.undecided += 1;
                return Ok(());
            }
            let place = mark.place(steps);
            if (step, false) == place {
                if step == steps && mark == Mark::Figure {
                    self.at = next;
                    return self.figure(points);
                }
                if matches!(mark, Mark::Sides(_)) {
                    self.at = next;
                    return self.sides(node, step, points, equations);
                }
                return self.before(node, step, mark, next, points);
            }
            if step >= place.0 && (step, true) != place || step >= steps {
                return Err("a mark for a step that is past".to_owned());
            }
            self.stand(node, step, points, equations)?;
            if (step, true) == place {
                return self.after(node, step, mark, next, (points, equations));
            }
            step += 1;
        }
    }

    fn mark(&self, node: &Node) -> Result<(Mark, usize), String> {
        let read = Mark::read(&self.plan.cover.marks, self.at, node.ranges.len());
        read.ok_or_else(|| "the marks end, or are damaged".to_owned())
    }

    /// Which of the steps with two places a step is.
    fn index(&self, step: usize) -> usize {
        (0..step).filter(|&s| self.plan.is_signed(s)).count()
    }

    /// Places a step's point, its side being decided.
    fn stand(
        &self,
        node: &Node,
        step: usize,
        points: &mut [Place],
        equations: &mut Vec<Model>,
    ) -> Result<(), String> {
        let unknown = || "a point cannot be placed".to_owned();
        let new = self.plan.cover.steps[step].0;
        if !self.plan.is_signed(step) {
            points[new] = self.plan.driven(step, node, points).ok_or_else(unknown)?;
        } else {
            let index = self.index(step);
            let sign = *node
                .signs
                .get(index)
                .ok_or("a point's side is not decided")?;
            let meeting = self.plan.meet(step, node, points).ok_or_else(unknown)?;
            let (middle, normal) = meeting.middle.zip(meeting.normal).ok_or_else(unknown)?;
            let height = if sign == 0 {
                let folds = node.signs[..index].iter().filter(|&&s| s == 0).count();
                let symbol = self.plan.cover.drives.len() + folds;
                let (centre, reach) = node.middle(symbol);
                let w = Model::symbol(node.ranges.len(), symbol, centre, reach);
                equations.push(meeting.square.plus(point(-1.0), &w.times(&w)));
                w
            } else {
                let root = meeting.square.square_root().ok_or_else(unknown)?;
                root.by(point(f64::from(sign)))
            };
            points[new] =
                std::array::from_fn(|k| middle[k].plus(point(1.0), &normal[k].times(&height)));
        }
        for &e in &self.plan.closing[step] {
            let [a, b] = self.plan.edges[e];
            let d = minus(&points[a], &points[b]);
            let wanted = Model::constant(node.ranges.len(), self.plan.squares[e]);
            equations.push(dot(&d, &d).plus(point(-1.0), &wanted));
        }
        Ok(())
    }

    /// Both sides of a step's point, one after the other.
    fn sides(
        &mut self,
        node: &mut Node,
        step: usize,
        points: &mut [Place],
        equations: &mut Vec<Model>,
    ) -> Result<(), String> {
        if !self.plan.is_signed(step) || node.signs.len() != self.index(step) {
            return Err("a mark for two sides where there are not two".to_owned());
        }
        let before = equations.len();
        for sign in [1, -1] {
            node.signs.push(sign);
            self.walk(node, step, points, equations)?;
            node.signs.pop();
            equations.truncate(before);
        }
        Ok(())
    }

    /// Marks about a step whose point does not stand.
    fn before(
        &mut self,
        node: &Node,
        step: usize,
        mark: Mark,
        next: usize,
        points: &[Place],
    ) -> Result<(), String> {
        self.at = next;
        if let Mark::Halves(_, _, symbol) = mark {
            return self.halves(node, symbol);
        }
        let meeting = self.plan.meet(step, node, points).ok_or(UNPROVED)?;
        let square = meeting.square.range();
        match mark {
            Mark::NoPlace(_) if square.sup() < 0.0 => Ok(()),
            Mark::Fold(_, [lo, hi]) => {
                let index = self.index(step);
                let sign = node.signs.get(index).copied();
                let holds = |x: f64| (point(x).sqr()).inf() >= square.sup();
                let low = lo <= 0.0 && (sign == Some(1) || holds(lo));
                let high = hi >= 0.0 && (sign == Some(-1) || holds(hi));
                if sign == Some(0) || node.signs.len() < index || !low || !high {
                    return Err(UNPROVED.to_owned());
                }
                let mut child = node.clone();
                // The sides of later steps stay decided up to the first fold among them.
                let later = (index..child.signs.len()).find(|&k| child.signs[k] == 0);
                child.signs.truncate(later.unwrap_or(child.signs.len()));
                match child.signs.get_mut(index) {
                    Some(sign) => *sign = 0,
                    None => child.signs.push(0),
                }
                let folds = child.signs.iter().filter(|&&s| s == 0).count();
                child
                    .ranges
                    .truncate(self.plan.cover.drives.len() + folds - 1);
                child.ranges.push([lo, hi]);
                self.push(child)
            }
            _ => Err(UNPROVED.to_owned()),
        }
    }

    fn push(&mut self, node: Node) -> Result<(), String> {
        let order = node.ranges.iter().all(|r| r[0] <= r[1]);
        if node.ranges.len() > MAX_SYMBOLS || !order {
            return Err("more symbols than there may be, or a range that is none".to_owned());
        }
        self.stack.push(node);
        Ok(())
    }

    fn halves(&mut self, node: &Node, symbol: usize) -> Result<(), String> {
        let &[lo, hi] = node.ranges.get(symbol).ok_or("no such symbol")?;
        let middle = 0.5 * (lo + hi);
        if !(lo <= middle && middle <= hi) {
            return Err("a range that cannot be halved".to_owned());
        }
        for half in [[lo, middle], [middle, hi]] {
            let mut child = node.clone();
            child.ranges[symbol] = half;
            self.push(child)?;
        }
        Ok(())
    }

    /// Marks about a step whose point stands.
    fn after(
        &mut self,
        node: &Node,
        step: usize,
        mark: Mark,
        next: usize,
        (points, equations): (&[Place], &[Model]),
    ) -> Result<(), String> {
        self.at = next;
        let symbols = node.ranges.len();
        let proved = match mark {
            Mark::Halves(_, _, symbol) => return self.halves(node, symbol),
            Mark::WrongDistance(_, place) => {
                let first = equations.len() - self.plan.closing[step].len();
                let equation = equations[first..].get(place);
                equation.is_some_and(|e| !e.range().contains(0.0))
            }
            Mark::WrongPair(_, other) if self.plan.stands(other, step) => {
                let new = self.plan.cover.steps[step].0;
                let d = minus(&points[new], &points[other]);
                dot(&d, &d)
                    .range()
                    .disjoint(self.plan.pairs.square(new, other))
            }
            Mark::Excluded(_) => contracted(symbols, equations).is_none(),
            Mark::Within(_, ranges) => match contracted(symbols, equations) {
                None => return self.push(with(node, &ranges)),
                Some(left) => {
                    let holds = |i: usize| {
                        let (middle, reach) = node.middle(i);
                        let x = (point(middle) + point(reach) * left[i])
                            .intersection(hull(node.ranges[i][0], node.ranges[i][1]));
                        x.is_empty() || ranges[i][0] <= x.inf() && x.sup() <= ranges[i][1]
                    };
                    if (0..symbols).all(holds) {
                        return self.push(with(node, &ranges));
                    }
                    false
                }
            },
            _ => false,
        };
        proved.then_some(()).ok_or_else(|| UNPROVED.to_owned())
    }

    /// Whether all figures of this part lie where one of those listed (or its mirror image) is alone.
    fn figure(&self, points: &[Place]) -> Result<(), String> {
        let d = self.plan.dimension;
        let near = |centre: &[[f64; 3]], alone: f64| {
            let mut pairs = points.iter().zip(centre);
            pairs.all(|(p, at)| (0..d).all(|k| p[k].distance(at[k]) < alone))
        };
        let held = |figure: &Figure| {
            near(&figure.centre, figure.alone) || near(&figure.mirrored(d), figure.alone)
        };
        match self.figures.iter().any(held) {
            true => Ok(()),
            false => Err("no solution listed accounts for this part".to_owned()),
        }
    }
}

fn with(node: &Node, ranges: &[[f64; 2]; MAX_SYMBOLS]) -> Node {
    let mut child = node.clone();
    let symbols = child.ranges.len();
    child.ranges.copy_from_slice(&ranges[..symbols]);
    child
}

/// What the equations leave of the symbols' ranges, or nothing: each equation solved for each symbol, then each of the
/// combinations that Gauss–Jordan elimination makes.
pub fn contracted(symbols: usize, equations: &[Model]) -> Option<[Interval; MAX_SYMBOLS]> {
    let mut u = [hull(-1.0, 1.0); MAX_SYMBOLS];
    for equation in equations {
        solve(equation, symbols, &mut u)?;
    }
    let mut rows: Vec<Model> = equations.to_vec();
    let mut used = [false; MAX_SYMBOLS];
    for step in 0..rows.len().min(symbols) {
        let mut best = (1e-9, None);
        for (r, row) in rows.iter().enumerate().skip(step) {
            for i in (0..symbols).filter(|&i| !used[i]) {
                let weight = row.slope(i).mid().abs() / row.blur();
                if weight > 1.001 * best.0 {
                    best = (weight, Some((r, i)));
                }
            }
        }
        let Some((r, i)) = best.1 else {
            rows.truncate(step);
            break;
        };
        used[i] = true;
        rows.swap(step, r);
        let pivot = rows[step];
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row.slope(i).mid() / pivot.slope(i).mid();
            if other != step && factor.is_finite() && factor.abs() > 1e-12 {
                *row = row.plus(point(-factor), &pivot);
            }
        }
    }
    for row in &rows {
        solve(row, symbols, &mut u)?;
    }
    Some(u)
}

/// Narrows the ranges by one equation; `None` if it cannot hold.
fn solve(equation: &Model, symbols: usize, u: &mut [Interval; MAX_SYMBOLS]) -> Option<()> {
    let whole = equation.range_over(&u[..]);
    if !whole.contains(0.0) {
        return None;
    }
    for i in 0..symbols {
        let slope = equation.slope(i);
        if slope.contains(0.0) {
            continue;
        }
        let left = (-equation.range_without(i, &u[..]) / slope).intersection(u[i]);
        if left.is_empty() {
            return None;
        }
        u[i] = left;
    }
    Some(())
}
