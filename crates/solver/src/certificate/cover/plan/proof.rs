//! The proof of what marks claim of one part.

use super::construct::{beside, squared_distance};
use super::figure::Figure;
use super::format::{MAX_SYMBOLS, Mark};
use super::geometry::{Model, Node, Place, Plan};
use super::parts::{Claim, Part};
use crate::certificate::checker::matrix::exact;
use crate::interval::rounding::round_up;
use crate::interval::{hull, point};
use crate::model::{Empty, Margin, Number, Range, contract};
use crate::places::Each as _;

/// What claims are proved with.
pub struct Proof<'a> {
    plan: &'a Plan<'a>,
    figures: &'a [Figure],
}

/// Where a proof is within a part.
struct Standing {
    node: Node,
    /// The first step whose point does not stand.
    step: usize,
    /// Of all points: those that do not stand are anywhere.
    points: Vec<Place>,
    /// Of the points that stand.
    equations: Vec<Model>,
}

impl Standing {
    /// What the equations leave of the symbols' ranges.
    fn left(&self) -> Result<[Range; MAX_SYMBOLS], Empty> {
        let mut u = [Range::SYMBOL; MAX_SYMBOLS];
        contract(&self.equations, &mut Vec::new(), &mut u, Margin::None)?;
        Ok(u)
    }
}

/// The number of smaller parts of a part of which a claim is tried, where it is not proved at once of the whole.
const PIECES: usize = 64;

impl Claim {
    /// Whether it is true whatever it is about: that a part is that and its other half, or undecided.
    fn is_true(&self) -> bool {
        match self {
            Claim::Mark(mark) => matches!(mark, Mark::Halves(..) | Mark::Undecided),
            Claim::Sides(_, both) => both.iter().all(Claim::is_true),
        }
    }
}

impl<'a> Proof<'a> {
    pub fn new(plan: &'a Plan<'a>, figures: &'a [Figure]) -> Self {
        Proof { plan, figures }
    }

    /// Proves what is claimed of a part.
    pub fn of(&self, part: &Part) -> Result<(), String> {
        let mut left = PIECES;
        let proved = part.claim.is_true() || self.all_of(&part.claim, &part.node, (0, &mut left));
        let unproved = || match part.claim {
            Claim::Mark(Mark::Figure) => "no solution listed accounts for this part",
            _ => "what the mark says is not proved",
        };
        proved.then_some(()).ok_or_else(|| unproved().to_owned())
    }

    /// Proves a claim of a part of the space, or else of both its halves, as it is about figures wherever they are. (Who searched may have
    /// had bounds that are a little better.)
    fn all_of(&self, claim: &Claim, node: &Node, (depth, left): (usize, &mut usize)) -> bool {
        if self.at_once(claim, node) {
            return true;
        }
        let symbols = node.ranges.len();
        if *left == 0 || symbols == 0 {
            return false;
        }
        let halves = node.halved(depth % symbols);
        halves.is_ok_and(|halves| {
            let mut halves = halves.iter();
            halves.all(|half| {
                *left = left.saturating_sub(1);
                self.all_of(claim, half, (depth + 1, left))
            })
        })
    }

    fn at_once(&self, claim: &Claim, node: &Node) -> bool {
        let mut points = vec![[Model::ZERO; 3]; self.plan.points];
        for (&p, place) in self.plan.cover.base.iter().zip(&self.plan.base) {
            points[p] = place.each(|x| Model::constant(Number::new(x)));
        }
        let mut standing = Standing {
            node: node.clone(),
            step: 0,
            points,
            equations: Vec::new(),
        };
        self.prove(claim, &mut standing).is_some()
    }

    /// Proves a claim from where a proof is. `None`: not proved.
    fn prove(&self, claim: &Claim, at: &mut Standing) -> Option<()> {
        let steps = self.plan.cover.steps.len();
        let (step, stands) = match claim {
            Claim::Mark(mark) => mark.place(steps),
            Claim::Sides(step, _) => (*step, false),
        };
        if claim.is_true() {
            return Some(());
        }
        let upto = step + usize::from(stands);
        // None is about a step that is past.
        if step < at.step || upto > steps {
            return None;
        }
        while at.step < upto {
            self.stand(at)?;
        }
        let proved = match claim {
            Claim::Sides(_, both) => return self.sides(both, at),
            Claim::Mark(Mark::Figure) => self.is_figure(&at.points),
            Claim::Mark(mark) if stands => self.after(step, *mark, at)?,
            Claim::Mark(mark) => self.before(step, *mark, at)?,
        };
        proved.then_some(())
    }

    /// Places the next step's point, its side being decided.
    fn stand(&self, at: &mut Standing) -> Option<()> {
        let (plan, step, node) = (self.plan, at.step, &at.node);
        let (d, points) = (plan.dimension, &mut at.points);
        let new = plan.cover.steps[step].0;
        points[new] = if !plan.is_signed(step) {
            plan.driven(step, node, points)?
        } else {
            let index = plan.sign(step);
            let sign = *node.signs.get(index)?;
            let (places, height) = if sign == 0 {
                let folds = node.signs[..index].iter().filter(|&&s| s == 0).count();
                let w = node.symbol(plan.cover.drives.len() + folds);
                let meeting = plan.meet(step, node, points)?;
                at.equations.push(meeting.square.minus(&w.squared()));
                (meeting.places(&meeting.over()), w)
            } else {
                plan.places(step, node, points)?
            };
            let side = if sign < 0 { -1.0 } else { 1.0 };
            beside(d, &places, side, &height)
        };
        for &e in &plan.closing[step] {
            let [a, b] = plan.edges[e];
            let square = squared_distance(d, &points[a], &points[b]);
            at.equations
                .push(square.shifted(Number::new(-plan.squares[e])));
        }
        at.step += 1;
        Some(())
    }

    /// Both sides of a step's point, one after the other.
    fn sides(&self, both: &[Claim; 2], at: &mut Standing) -> Option<()> {
        let (step, before) = (at.step, at.equations.len());
        for (claim, sign) in both.iter().zip([1, -1]) {
            at.node.signs.push(sign);
            self.prove(claim, at)?;
            at.node.signs.pop();
            at.equations.truncate(before);
            at.step = step;
        }
        Some(())
    }

    /// Claims of a step whose point does not stand. `None` and false: not proved.
    fn before(&self, step: usize, mark: Mark, at: &Standing) -> Option<bool> {
        let square = self.plan.meet(step, &at.node, &at.points)?.square;
        let square = square.range().interval();
        Some(match mark {
            Mark::NoPlace(_) => square.sup() < 0.0,
            // No height is beyond the range of the symbol, on a side that is not decided otherwise.
            Mark::Fold(_, [lo, hi]) => {
                let sign = at.node.signs.get(self.plan.sign(step)).copied();
                let holds = |x: f64| (point(x).sqr()).inf() >= square.sup();
                let low = lo <= 0.0 && (sign == Some(1) || holds(lo));
                let high = hi >= 0.0 && (sign == Some(-1) || holds(hi));
                low && high
            }
            _ => false,
        })
    }

    /// Claims of a step whose point stands. `None` and false: not proved.
    fn after(&self, step: usize, mark: Mark, at: &Standing) -> Option<bool> {
        let (plan, node, symbols) = (self.plan, &at.node, at.node.ranges.len());
        Some(match mark {
            Mark::WrongDistance(_, place) => {
                let first = at.equations.len() - plan.closing[step].len();
                let range = at.equations[first..].get(place)?.range();
                range.lo > 0.0 || range.hi < 0.0
            }
            Mark::WrongPair(_, other) if plan.stands(other, step) => {
                let new = plan.cover.steps[step].0;
                let [a, b] = [new, other].map(|p| &at.points[p]);
                let range = squared_distance(plan.dimension, a, b).range();
                range.interval().disjoint(plan.pairs.square(new, other))
            }
            Mark::Excluded(_) => at.left().is_err(),
            Mark::Within(_, claimed) => {
                let holds = |i: usize, left: Range| {
                    let ([lo, hi], (middle, reach)) = (node.ranges[i], node.middle(i));
                    let left = left.interval();
                    let x = (exact(middle) + exact(reach) * left).intersection(hull(lo, hi));
                    let [least, most] = claimed[i].range;
                    x.is_empty() || least <= x.inf() && x.sup() <= most
                };
                let left = at.left();
                left.map_or(true, |left| (0..symbols).all(|i| holds(i, left[i])))
            }
            _ => false,
        })
    }

    /// Whether all figures of this part lie where one of those listed (or its mirror image) is alone.
    fn is_figure(&self, points: &[Place]) -> bool {
        let d = self.plan.dimension;
        let is_near = |f: &Model, at: f64, alone: f64| {
            round_up((f.middle() - at).abs() + f.reach(), 4) < alone
        };
        let near = |centre: &[[f64; 3]], alone: f64| {
            let mut pairs = points.iter().zip(centre);
            pairs.all(|(p, at)| (0..d).all(|k| is_near(&p[k], at[k], alone)))
        };
        self.figures.iter().any(|figure| {
            near(&figure.centre, figure.alone) || near(&figure.mirrored(d).centre, figure.alone)
        })
    }
}
