//! A part of the search space: a box of symbols, and which of two places some points take.

use super::plan::Plan;
use crate::model::{Model, SYMBOLS};

/// Most symbols at a time: driving parameters and folds.
pub const MAX_SYMBOLS: usize = SYMBOLS;
/// Most steps with two places; two bits each.
pub const MAX_SIGNED: usize = 64;

/// Which place a point takes that two are possible for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// On the side of the normal.
    Plus,
    /// On the other.
    Minus,
    /// Either: its signed height over the line or plane through the centres is a symbol.
    Fold,
}

/// A part of the search space.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Lower bounds: of τ of every angle or of the square, then of every fold's symbol.
    pub lo: [f64; MAX_SYMBOLS],
    /// Upper bounds.
    pub hi: [f64; MAX_SYMBOLS],
    /// How many symbols there are.
    pub symbols: u8,
    /// Bit i: the angle of parameter i is in the second half.
    pub halves: u8,
    /// Two bits for each step with two places, in the plan's order: a [`Sign`], as far as decided.
    signs: u128,
    /// How many of these are decided.
    pub decided: u8,
    /// How often the search space was parted to get here.
    pub depth: u16,
    /// The part of the whole search space that this is: halved wherever it is parted.
    pub share: f64,
}

impl Node {
    /// The parts that a search begins with: all of it but for mirror images.
    ///
    /// The mirror image in the base is a figure too, and turns the first point placed after the
    /// base to the other side: it suffices to look at one half of its angle, or at one sign.
    pub fn roots(plan: &Plan) -> Vec<Node> {
        let angles: Vec<usize> = (0..plan.drives.len())
            .filter(|&i| plan.drives[i].is_none())
            .collect();
        let first_is_angle = plan.steps.first().is_some_and(|s| !s.is_signed());
        let free = if first_is_angle {
            &angles[1..]
        } else {
            &angles[..]
        };
        let count = 1usize << free.len();
        let root = |choice: usize| {
            let (mut lo, mut hi) = ([0.0; MAX_SYMBOLS], [0.0; MAX_SYMBOLS]);
            for (i, drive) in plan.drives.iter().enumerate() {
                [lo[i], hi[i]] = drive.unwrap_or([-1.0, 1.0]);
            }
            let bit = |(k, &i): (usize, &usize)| (((choice >> k) & 1) << i) as u8;
            let mut node = Node {
                lo,
                hi,
                symbols: plan.drives.len() as u8,
                halves: free.iter().enumerate().map(bit).sum(),
                signs: 0,
                decided: 0,
                depth: 0,
                share: 1.0 / count as f64,
            };
            if !first_is_angle && !plan.steps.is_empty() {
                node.decide(Sign::Plus);
            }
            node
        };
        (0..count).map(root).collect()
    }

    /// The sign of the `index`-th step with two places, if it is decided.
    pub fn sign(&self, index: usize) -> Option<Sign> {
        (index < self.decided as usize).then(|| match (self.signs >> (2 * index)) & 3 {
            0 => Sign::Plus,
            1 => Sign::Minus,
            _ => Sign::Fold,
        })
    }

    /// Decides the next sign.
    pub fn decide(&mut self, sign: Sign) {
        self.set(self.decided as usize, sign);
        self.decided += 1;
    }

    /// Decides a sign anew.
    pub fn set(&mut self, index: usize, sign: Sign) {
        let code = match sign {
            Sign::Plus => 0u128,
            Sign::Minus => 1,
            Sign::Fold => 2,
        };
        self.signs = self.signs & !(3 << (2 * index)) | code << (2 * index);
    }

    /// Takes back the last sign.
    pub fn forget(&mut self) {
        self.decided -= 1;
        self.signs &= !(3 << (2 * self.decided as usize));
    }

    /// Which symbol a fold has: they come after the parameters, in the order of the steps.
    pub fn fold_symbol(&self, parameters: usize, index: usize) -> usize {
        let before = (0..index).filter(|&k| self.sign(k) == Some(Sign::Fold));
        parameters + before.count()
    }

    /// The middle of a symbol's range, and how far it reaches from there.
    pub fn middle(&self, i: usize) -> (f64, f64) {
        let middle = 0.5 * (self.lo[i] + self.hi[i]);
        let reach = (self.hi[i] - middle).max(middle - self.lo[i]);
        (middle, if reach > 0.0 { reach.next_up() } else { 0.0 })
    }

    /// A symbol.
    pub fn symbol<const S: usize, const M: usize>(&self, i: usize) -> Model<S, M> {
        let (middle, reach) = self.middle(i);
        Model::symbol(i, middle, reach)
    }

    /// Both halves, parted in the middle of a symbol's range.
    pub fn parted(&self, i: usize) -> [Node; 2] {
        let (middle, _) = self.middle(i);
        let mut halves = [self.clone(), self.clone()];
        halves[0].hi[i] = middle;
        halves[1].lo[i] = middle;
        for half in &mut halves {
            half.depth = half.depth.saturating_add(1);
            half.share *= 0.5;
        }
        halves
    }

    /// With a fold's symbol for the sign of the `index`-th step with two places. The signs of later steps stay
    /// decided up to the first fold among them, whose symbol would come after this one.
    pub fn folded(&self, parameters: usize, index: usize, range: [f64; 2]) -> Node {
        let mut node = self.clone();
        while (index..node.decided as usize).any(|k| node.sign(k) == Some(Sign::Fold)) {
            node.forget();
        }
        if index < node.decided as usize {
            node.set(index, Sign::Fold);
        } else {
            node.decide(Sign::Fold);
        }
        let symbol = node.fold_symbol(parameters, index);
        node.symbols = symbol as u8 + 1;
        [node.lo[symbol], node.hi[symbol]] = range;
        node.depth = node.depth.saturating_add(1);
        node
    }
}
