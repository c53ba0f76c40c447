//! In which order the unknowns of a block are found: a few at a time, from the equations in which nothing else is unknown.
//!
//! A step's equations are linear in what it finds, but for one. Where several are quadratic and their products of two unknowns are
//! the same up to a factor, as of two spheres about known points, multiples of one of them make the others linear. So a step intersects spheres, planes,
//! lines and circles, and whatever else has such equations. Where there are fewer equations than unknowns, some of these are
//! parameters that drive the construction; equations that are left over close it.

use super::super::newton::{KNOWN, Square};
use super::super::system::{Form, Row};
use crate::map::Map;
use crate::model::Number;
use crate::order::each_once;

/// Unknowns that one step finds, at most.
const MOST_TOGETHER: u32 = 5;
/// Unknowns of a block that is constructed, at most.
const MOST: usize = 64;
/// Parameters that drive a construction, at most. With three of them the search without a construction is better: three points seen under three
/// angles took 4129 parts and 0.36 s without a construction, and 11 604 parts and 0.51 s with it, and others alike.
const MOST_DRIVES: usize = 2;
/// Orders that are looked at.
const FEW: usize = 16;
/// Whole numbers, quarters and so on with numerators and denominators up to about these are multiplied exactly.
const LARGEST: f64 = (1u64 << 20) as f64;
const FINEST: f64 = (1u64 << 10) as f64;

/// `factor · left · right` in the unknowns of a step.
#[derive(Debug, Clone)]
pub struct Term {
    /// The factor.
    pub factor: Number,
    /// The first factor.
    pub left: Affine,
    /// The second factor.
    pub right: Affine,
}

/// What a form is in the unknowns of a step, each counted from its base: a sum of these, and of what is known.
#[derive(Debug, Clone, Default)]
pub struct Affine {
    /// The unknowns, by their places in the step, with their signs.
    pub own: Vec<(usize, f64)>,
    /// The entries whose difference is known; none for the number 1.
    pub known: Option<[usize; 2]>,
}

/// An equation of a step.
#[derive(Debug, Clone)]
pub struct Equation {
    /// Which one of the block.
    pub row: usize,
    /// Its products.
    pub terms: Vec<Term>,
    /// So many times the step's quadratic equation has to be taken off for it to be linear. (Of that equation itself it says nothing.)
    pub ratio: f64,
}

/// A step.
#[derive(Debug, Clone)]
pub struct Step {
    /// The unknowns that it finds, entries of the system.
    pub unknowns: Vec<usize>,
    /// For each of them an entry that is known before, near which it is.
    pub base: Vec<usize>,
    /// Equations that are linear in them, or so with the quadratic one taken off.
    pub linear: Vec<Equation>,
    /// The quadratic equation, with its products of two unknowns.
    pub quadratic: Option<(Equation, Vec<(usize, usize, f64)>)>,
    /// The equations that have some of these unknowns, and in which nothing is unknown after the step.
    pub rows: Vec<usize>,
}

/// The order of a block's steps.
#[derive(Debug, Clone)]
pub struct Order {
    /// The steps.
    pub steps: Vec<Step>,
    /// The entries that the equations have and that are no unknowns.
    pub outside: Vec<usize>,
    /// How many parameters drive it, where no coefficient vanishes.
    pub drives: usize,
}

/// The products of two unknowns of a set, by their places in the block, with their factors.
type Quadratic = Map<(usize, usize), f64>;

/// What equations tell of a set of unknowns.
struct Usable {
    /// Rows that are linear in them, with how often the quadratic one has to be taken off for that.
    linear: Vec<(usize, f64)>,
    /// A row that is quadratic, and how.
    quadratic: Option<(usize, Quadratic)>,
}

/// A block, sets of whose unknowns are numbers, with a bit for each.
struct Finder<'a> {
    square: &'a Square<'a>,
    /// The unknowns of each row.
    sets: Vec<u64>,
    zero: usize,
}

/// What a step may find.
#[derive(Clone, Copy)]
struct Choice {
    set: u64,
    /// How many of these are parameters.
    drives: usize,
}

/// A way through all steps, as far as it was followed.
#[derive(Clone, Default)]
struct Way {
    known: u64,
    drives: usize,
    /// Drives that no equation has closed yet.
    open: usize,
    /// How many of these each step has, added up.
    cost: usize,
    sets: Vec<u64>,
}

impl Order {
    /// An order with as few parameters as were found that closes early. `None`: no two parameters are enough, or there are too few unknowns, or
    /// too many. `zero`: the entry that is the number 0.
    pub fn new(square: &Square, zero: usize) -> Option<Self> {
        Self::some(square, zero, 1).pop()
    }

    /// The unknowns, in the order in which they are found.
    pub fn unknowns(&self) -> impl Iterator<Item = &usize> + Clone {
        self.steps.iter().flat_map(|step| &step.unknowns)
    }

    /// The best of those that are looked at, so many at the most.
    pub fn some(square: &Square, zero: usize, most: usize) -> Vec<Self> {
        let n = square.own.len();
        if !(2..=MOST).contains(&n) {
            return Vec::new();
        }
        let set = |row: &&Row| {
            let own = row.entries.iter().map(|&e| square.place[e]);
            own.filter(|&k| k != KNOWN)
                .fold(0u64, |set, k| set | 1 << k)
        };
        let finder = Finder {
            square,
            sets: square.rows.iter().map(set).collect(),
            zero,
        };
        let mut ways = Vec::new();
        finder.follow(Way::default(), 1, 1, &mut ways);
        let drives = ways.first().map_or(0, |way| way.drives);
        if drives > 0 {
            ways.clear();
            // Of large blocks they take long.
            let tried = match n {
                ..=24 => FEW,
                25..=40 => FEW / 4,
                _ => 1,
            };
            let wide = match drives {
                1 => FEW,
                2 => 4,
                _ => 2,
            };
            finder.follow(Way::default(), wide, tried, &mut ways);
        }
        ways.sort_by_key(|way| (way.drives, way.cost));
        let least = ways.first().map_or(0, |way| way.drives);
        if least > MOST_DRIVES {
            return Vec::new();
        }
        let entries = square.rows.iter().flat_map(|row| row.entries.clone());
        let outside = entries.filter(|&e| square.place[e] == KNOWN);
        let outside = each_once(outside.chain([zero]));
        let best = ways.into_iter().filter(|way| way.drives == least);
        let orders = best.take(most).map(|way| {
            let mut known = 0;
            let steps = way.sets.into_iter().map(|set| {
                let step = finder.step(known, set);
                known |= set;
                step
            });
            Order {
                steps: steps.collect(),
                outside: outside.clone(),
                drives: way.drives,
            }
        });
        orders.collect()
    }
}

impl Finder<'_> {
    /// The places in the block that a set has.
    fn own(&self, set: u64) -> impl Iterator<Item = usize> + '_ {
        (0..self.square.own.len()).filter(move |k| (set >> k) & 1 == 1)
    }

    /// The steps that are possible, the best ones first.
    fn choices(&self, known: u64) -> Vec<Choice> {
        let open: Vec<u64> = self
            .sets
            .iter()
            .map(|set| set & !known)
            .filter(|set| *set != 0)
            .collect();
        let mut sets: Vec<u64> = open.clone();
        for (k, one) in open.iter().enumerate() {
            sets.extend(
                open[..k]
                    .iter()
                    .filter(|other| *other & one != 0)
                    .map(|other| other | one),
            );
        }
        for u in 0..self.square.own.len() {
            let star = open
                .iter()
                .filter(|set| (*set >> u) & 1 == 1)
                .fold(0, |all, set| all | set);
            sets.push(star);
        }
        sets.retain(|set| *set != 0 && set.count_ones() <= MOST_TOGETHER);
        sets.sort_unstable_by_key(|set| (set.count_ones(), *set));
        sets.dedup();
        // As many unknowns as equations at the most are found without a drive.
        let contained = |set: &u64| open.iter().filter(|row| *row & !set == 0).count();
        let least = |set: &u64| (set.count_ones() as usize).saturating_sub(contained(set));
        let mut sets: Vec<(usize, u64)> = sets.into_iter().map(|set| (least(&set), set)).collect();
        sets.sort_by_key(|(least, set)| (*least, set.count_ones()));
        let mut choices: Vec<Choice> = Vec::new();
        let mut fewest = usize::MAX;
        for (least, set) in sets {
            if least > fewest || fewest == 0 {
                break;
            }
            let usable = self.usable(known, set);
            let told = usable.linear.len() + usize::from(usable.quadratic.is_some());
            let drives = (set.count_ones() as usize).saturating_sub(told);
            fewest = fewest.min(drives);
            choices.push(Choice { set, drives });
        }
        choices.retain(|choice| choice.drives == fewest);
        choices.sort_by_key(|choice| (choice.set.count_ones(), choice.set));
        choices
    }

    /// Follows the best choice of each step, and where there is a drive, that many.
    fn follow(&self, mut way: Way, wide: usize, most: usize, ways: &mut Vec<Way>) {
        while way.drives <= 2 * MOST_DRIVES {
            let choices = self.choices(way.known);
            let Some(&first) = choices.first() else { break };
            if first.drives == 0 {
                self.take(&mut way, first);
                continue;
            }
            let apart = choices.len().div_ceil(wide);
            for &choice in choices.iter().step_by(apart) {
                if ways.len() < most {
                    let mut way = way.clone();
                    self.take(&mut way, choice);
                    self.follow(way, wide, most, ways);
                }
            }
            return;
        }
        // What is in no small set drives.
        for k in 0..self.square.own.len() {
            if (way.known >> k) & 1 == 0 {
                let set = 1 << k;
                self.take(&mut way, Choice { set, drives: 1 });
            }
        }
        ways.push(way);
    }

    fn take(&self, way: &mut Way, choice: Choice) {
        let rows = self.contained(way.known, choice.set).len();
        let found = (choice.set.count_ones() as usize).saturating_sub(choice.drives);
        way.known |= choice.set;
        way.drives += choice.drives;
        way.open += choice.drives;
        way.cost += way.open;
        way.open = way.open.saturating_sub(rows.saturating_sub(found));
        way.sets.push(choice.set);
    }

    /// The rows that have unknowns of a set and no others that are not known.
    fn contained(&self, known: u64, set: u64) -> Vec<usize> {
        let rows = (0..self.sets.len()).filter(|&row| {
            let open = self.sets[row] & !known;
            open != 0 && open & !set == 0
        });
        rows.collect()
    }

    /// The products of two unknowns of a set in a row; `None` if a factor of one is not exact.
    fn quadratic(&self, row: usize, set: u64) -> Option<Quadratic> {
        let mut all = Vec::new();
        let own = |form: Form| -> Vec<(usize, f64)> {
            let entries = form.entries();
            let entries = entries.map(|(e, sign)| (self.square.place[e], sign.into()));
            entries
                .filter(|&(k, _)| k != KNOWN && (set >> k) & 1 == 1)
                .collect()
        };
        for p in &self.square.rows[row].products {
            let (left, right) = (own(p.left), own(p.right));
            if left.is_empty() || right.is_empty() {
                continue;
            }
            let is_exact = p.factor.wid() == 0.0 && is_fine(p.factor.mid());
            is_exact.then_some(())?;
            for &(i, f) in &left {
                for &(j, g) in &right {
                    all.push(((i.min(j), i.max(j)), p.factor.mid() * f * g));
                }
            }
        }
        Some(Map::sums(all))
    }

    /// The rows that tell unknowns of a set: those that are linear, and those that are so with one of them taken off.
    fn usable(&self, known: u64, set: u64) -> Usable {
        let mut linear: Vec<(usize, f64)> = Vec::new();
        let mut groups: Vec<(Quadratic, Vec<(usize, f64)>)> = Vec::new();
        for row in self.contained(known, set) {
            let Some(quadratic) = self.quadratic(row, set) else {
                continue;
            };
            if quadratic.is_empty() {
                linear.push((row, 0.0));
                continue;
            }
            let ratio = |group: &Quadratic| -> Option<f64> {
                if group.len() != quadratic.len() {
                    return None;
                }
                let mut pairs = group.iter().zip(quadratic.iter());
                let (a, b) = pairs.clone().next()?;
                let ratio = b.1 / a.1;
                // Both factors have few digits, so that this is no matter of roundings.
                let is_same = |(a, b): ((&_, &f64), (&_, &f64))| a.0 == b.0 && a.1 * ratio == *b.1;
                (is_fine(ratio) && pairs.all(is_same)).then_some(ratio)
            };
            match groups
                .iter_mut()
                .find_map(|(q, rows)| Some((ratio(q)?, rows)))
            {
                Some((ratio, rows)) => rows.push((row, ratio)),
                None => groups.push((quadratic, vec![(row, 1.0)])),
            }
        }
        // The greatest group gives the most.
        let best = (0..groups.len()).rev().max_by_key(|&k| groups[k].1.len());
        let mut quadratic = None;
        if let Some(k) = best {
            let (q, rows) = groups.swap_remove(k);
            linear.extend(&rows[1..]);
            quadratic = Some((rows[0].0, q));
        }
        Usable { linear, quadratic }
    }

    fn step(&self, known: u64, set: u64) -> Step {
        let own: Vec<usize> = self.own(set).collect();
        let contained = self.contained(known, set);
        let is_known = |entry: usize| match self.square.place[entry] {
            KNOWN => true,
            k => (known >> k) & 1 == 1,
        };
        // Where an unknown less something known is in a product, it is counted from that.
        let base = own.iter().map(|&k| {
            let entry = self.square.own[k];
            let forms = contained
                .iter()
                .flat_map(|&row| &self.square.rows[row].products);
            let mut forms = forms.filter(|p| p.left == p.right).map(|p| p.left);
            let beside = |form: Form| match form {
                Form::Difference(a, b) if a == entry && is_known(b) => Some(b),
                Form::Difference(a, b) if b == entry && is_known(a) => Some(a),
                _ => None,
            };
            forms.find_map(beside).unwrap_or(self.zero)
        });
        let base: Vec<usize> = base.collect();
        let affine = |form: Form| -> Affine {
            let Form::Difference(a, b) = form else {
                return Affine::default();
            };
            let mut out = Affine::default();
            let mut known = [a, b];
            for (known, sign) in known.iter_mut().zip([1.0, -1.0]) {
                let place = own.iter().position(|&k| self.square.own[k] == *known);
                if let Some(i) = place {
                    out.own.push((i, sign));
                    *known = base[i];
                }
            }
            out.known = Some(known);
            out
        };
        let equation = |(row, ratio): (usize, f64)| Equation {
            row,
            ratio,
            terms: self.square.rows[row]
                .products
                .iter()
                .map(|p| Term {
                    factor: Number::new(p.factor),
                    left: affine(p.left),
                    right: affine(p.right),
                })
                .collect(),
        };
        let Usable { linear, quadratic } = self.usable(known, set);
        let place = |k: usize| own.iter().position(|&x| x == k).expect("of the set");
        Step {
            unknowns: own.iter().map(|&k| self.square.own[k]).collect(),
            linear: linear.into_iter().map(equation).collect(),
            quadratic: quadratic.map(|(row, q)| {
                let products = q.into_iter().map(|((i, j), q)| (place(i), place(j), q));
                (equation((row, 1.0)), products.collect())
            }),
            base,
            rows: contained,
        }
    }
}

/// Whether products and sums of a few such numbers are exact.
fn is_fine(x: f64) -> bool {
    x.abs() <= LARGEST && (x * FINEST).fract() == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::Blocks;
    use crate::complete::coordinates::search::Block;
    use crate::complete::coordinates::system::System;
    use crate::problem::Problem;
    use crate::system::{Homotopy, typical_length};

    /// A multiple that is rounded makes nothing linear.
    #[test]
    fn multiples_are_exact() {
        for (x, fine) in [
            (1.0, true),
            (-2.5, true),
            (1.0 / 3.0, false),
            (0.1, false),
            (2e6, false),
            (f64::NAN, false),
            (f64::INFINITY, false),
        ] {
            assert_eq!(is_fine(x), fine, "{x}");
        }
    }

    fn largest(problem: &str) -> Vec<Order> {
        let problem = Problem::read(problem).unwrap();
        let homotopy = Homotopy::for_sets_in(&problem, typical_length(&problem)).unwrap();
        let system = System::new(&homotopy);
        let rows = system.rows[..system.unknowns].iter();
        let rows: Vec<Vec<usize>> = rows.map(|row| row.entries.clone()).collect();
        let blocks = Blocks::new(&rows, system.unknowns).unwrap().blocks;
        let block = blocks
            .iter()
            .max_by_key(|block| block.unknowns.len())
            .unwrap();
        let own = &block.unknowns;
        let block = Block::new(&system, &block.equations, own, |u| !own.contains(&u));
        Order::some(&block.square, block.zero, FEW)
    }

    /// The numbers of parameters are those of plans by hand: a hinge of the disulfide bond and of the octahedron; two points of the dodecagon;
    /// of the pentahedron the quadrangle in a plane and the triangle on top of it.
    #[test]
    fn parameters_are_few() {
        for (problem, drives) in [
            ("octahedron", 1),
            ("disulfide", 1),
            ("dodecagon", 2),
            ("constraints/pentahedron", 2),
            ("constraints/6p7d3a2c-closed", 1),
        ] {
            let orders = largest(&format!("../../problems/{problem}.toml"));
            assert!(!orders.is_empty(), "{problem}");
            for order in &orders {
                assert_eq!(order.drives, drives, "{problem}: {order:?}");
                let missing = |step: &Step| {
                    let told = step.linear.len() + usize::from(step.quadratic.is_some());
                    step.unknowns.len().saturating_sub(told)
                };
                let missing: usize = order.steps.iter().map(missing).sum();
                assert_eq!(missing, drives, "{problem}: {order:?}");
            }
        }
    }

    /// Every unknown is found once, from what is known before; every equation is told of once.
    #[test]
    fn steps_need_what_is_known() {
        for problem in [
            "disulfide",
            "dodecagon",
            "constraints/pentahedron",
            "constraints/6p7d3a2c-closed",
        ] {
            for order in largest(&format!("../../problems/{problem}.toml")) {
                let mut known = order.outside.clone();
                let mut rows: Vec<usize> = Vec::new();
                for step in &order.steps {
                    assert!(step.base.iter().all(|base| known.contains(base)));
                    let quadratic = step.quadratic.iter().map(|(equation, _)| equation);
                    for equation in step.linear.iter().chain(quadratic) {
                        assert!(step.rows.contains(&equation.row));
                        let sides = equation
                            .terms
                            .iter()
                            .flat_map(|term| [&term.left, &term.right]);
                        let entries = sides.filter_map(|side| side.known).flatten();
                        assert!(entries.into_iter().all(|entry| known.contains(&entry)));
                    }
                    assert!(step.unknowns.iter().all(|unknown| !known.contains(unknown)));
                    known.extend(&step.unknowns);
                    rows.extend(&step.rows);
                }
                rows.sort_unstable();
                assert_eq!(rows, (0..rows.len()).collect::<Vec<_>>());
            }
        }
    }
}
