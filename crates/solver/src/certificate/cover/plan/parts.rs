//! The parts of the search space, as the marks of a cover cut it: which there are is read before anything is proved.

use super::format::{Left, MAX_SYMBOLS, Mark};
use super::geometry::{Node, Plan};

/// The greatest number of steps whose sides are decided at a time: claims of sides stand within each other no deeper than that.
const MOST_SIDES: usize = 64;

/// A part, and what its marks claim.
pub struct Part {
    pub node: Node,
    pub claim: Claim,
}

/// What marks claim of a part, or of a part with some sides decided.
pub enum Claim {
    Mark(Mark),
    /// The point of this step has two places, of which these are claimed: with its height in the direction of the normal, and in the other.
    Sides(usize, Box<[Claim; 2]>),
}

/// All parts, one after the other.
pub struct Parts<'a> {
    plan: &'a Plan<'a>,
    marks: &'a [u8],
    /// How many of the marks' bytes are read.
    pub at: usize,
    /// Parts whose marks are to come, the next one last.
    stack: Vec<Node>,
    /// Parts of which nothing is claimed, so far.
    pub undecided: u64,
}

impl<'a> Parts<'a> {
    pub fn new(plan: &'a Plan<'a>, marks: &'a [u8]) -> Self {
        let stack = plan.roots().into_iter().rev().collect();
        let (at, undecided) = (0, 0);
        Parts {
            plan,
            marks,
            at,
            stack,
            undecided,
        }
    }

    fn claim(&mut self, node: &mut Node) -> Result<Claim, String> {
        let read = Mark::read(self.marks, self.at, &node.ranges);
        let (mark, next) = read.ok_or("the marks end, or are damaged")?;
        self.at = next;
        match mark {
            Mark::Sides(step) => {
                if !self.plan.is_signed(step) || node.signs.len() != self.plan.sign(step) {
                    return Err("a mark for two sides where there are not two".to_owned());
                }
                if node.signs.len() >= MOST_SIDES {
                    return Err("more sides than there may be".to_owned());
                }
                let mut side = |sign| {
                    node.signs.push(sign);
                    let claim = self.claim(node);
                    node.signs.pop();
                    claim
                };
                return Ok(Claim::Sides(step, Box::new([side(1)?, side(-1)?])));
            }
            Mark::Halves(_, _, symbol) => {
                for half in node.halved(symbol)? {
                    self.push(half)?;
                }
            }
            Mark::Fold(step, range) => self.push(self.plan.folded(node, step, range)?)?,
            Mark::Within(_, left) => self.push(node.within(&left)?)?,
            Mark::Undecided => self.undecided += 1,
            _ => {}
        }
        Ok(Claim::Mark(mark))
    }

    fn push(&mut self, node: Node) -> Result<(), String> {
        let order = node.ranges.iter().all(|r| r[0] <= r[1]);
        if node.ranges.len() > MAX_SYMBOLS || !order {
            return Err("more symbols than there may be, or a range that is none".to_owned());
        }
        self.stack.push(node);
        Ok(())
    }
}

/// The parts that a part is parted into follow it in their order.
impl Iterator for Parts<'_> {
    type Item = Result<Part, String>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut node = self.stack.pop()?;
        let first = self.stack.len();
        let claim = self.claim(&mut node);
        self.stack[first..].reverse();
        Some(claim.map(|claim| Part { node, claim }))
    }
}

impl Node {
    /// Both halves of a symbol's range, which share a border, the lower one first.
    pub fn halved(&self, symbol: usize) -> Result<[Node; 2], String> {
        let &[lo, hi] = self.ranges.get(symbol).ok_or("no such symbol")?;
        let middle = 0.5 * (lo + hi);
        if !(lo <= middle && middle <= hi) {
            return Err("a range that cannot be halved".to_owned());
        }
        Ok([[lo, middle], [middle, hi]].map(|half| {
            let mut child = self.clone();
            child.ranges[symbol] = half;
            child
        }))
    }

    fn within(&self, left: &[Left; MAX_SYMBOLS]) -> Result<Node, String> {
        let mut child = self.clone();
        for (range, Left { range: to, .. }) in child.ranges.iter_mut().zip(left) {
            if !(range[0] <= to[0] && to[1] <= range[1]) {
                return Err("ranges that are not within those before".to_owned());
            }
            *range = *to;
        }
        Ok(child)
    }
}

impl Plan<'_> {
    /// Which of the steps with two places a step is.
    pub fn sign(&self, step: usize) -> usize {
        (0..step).filter(|&s| self.is_signed(s)).count()
    }

    /// The part in which the height of a step's point is a symbol.
    fn folded(&self, node: &Node, step: usize, range: [f64; 2]) -> Result<Node, String> {
        let index = self.sign(step);
        if !self.is_signed(step) || node.signs.len() < index || node.signs.get(index) == Some(&0) {
            return Err("a mark for a height where there is none".to_owned());
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
        child.ranges.truncate(self.cover.drives.len() + folds - 1);
        child.ranges.push(range);
        Ok(child)
    }
}
