//! Which constraints are one too many, each with the few that it depends on.
//!
//! All equations are looked at, those of coincidences too, at the drawing (moved off where it is singular). They are taken in an
//! order in which what can be removed least comes first: what arcs and other objects are, what is fixed, coincidences,
//! other constraints without a number, equalities, and last dimensions, each kind in the order of the file. One that says
//! nothing new after those before is surplus, and the smallest set of these that it depends on is told with it. So far these are
//! floats. Whether it follows or contradicts is proved where an identity tells it, and otherwise seen at the figure near the
//! drawing that meets the rest.

use super::account::half_digit;
use super::choose::PIVOT;
use super::cut::straight;
use super::drawn::{Drawn, Floats, look};
use super::follows::{Given, combination};
use super::whose::Whose;
use super::{Choice, FINE, LEAST_PART, System};
use crate::interval::{enclose_rational, point};
use crate::order::{InOrder, add_new};
use crate::problem::{Problem, list};
use crate::system::typical_length;
use nalgebra::DVector;
use std::collections::{BTreeMap, BTreeSet};

/// More equations or unknowns are not looked at: it would take seconds.
const MANY: usize = 900;
/// With no more equations than these an identity is looked for among all, where it is not found in the smallest set.
const SMALL: usize = 60;
/// Names that are listed before "and n more".
const LISTED: usize = 12;

/// A constraint that is one too many.
#[derive(Debug, Clone, PartialEq)]
pub struct Surplus {
    /// What people call it.
    pub name: String,
    /// Whether others say only a part of what it says.
    pub in_part: bool,
    /// The other constraints of the smallest set that depends on each other: any one of these may be removed as well.
    pub others: Vec<String>,
    /// What belongs to that set besides: arcs, fixed points, coincidences.
    pub besides: Vec<String>,
    /// How it stands to the others.
    pub finding: Finding,
}

/// How a constraint that is one too many stands to the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finding {
    /// It follows from them: proved, by an identity.
    Follows,
    /// It contradicts them: proved, by an identity.
    Contradicts {
        /// By how much its number differs from what they make it.
        by: f64,
    },
    /// Its number is what they make it but for its last digits: proved, by an identity.
    Rounded {
        /// By how much it differs.
        by: f64,
    },
    /// The figure near the drawing that meets all others meets it, too, as far as floats tell.
    Met,
    /// The figure near the drawing that meets all others misses it, as far as floats tell.
    Missed {
        /// By how much.
        by: f64,
    },
    /// Neither could be told.
    Open,
}

/// What a problem has too much and too little of.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Census {
    /// In how many ways it can still move; `None`: it was not looked at, or is singular where it is drawn.
    pub freedom: Option<usize>,
    /// Constraints that are one too many.
    pub surplus: Vec<Surplus>,
}

/// The constraints that are one too many, in the order in which they are found to be so. At a figure that is singular by itself nothing is
/// said, and nothing of very large ones.
///
/// # Errors
/// What is wrong with the problem, in words.
pub fn surplus(problem: &Problem) -> Result<Census, String> {
    let (problem, lowered) = straight(problem)?;
    // No unknowns are merged: what says that two are one is an equation like others here.
    let system = System::new(&problem, &lowered, |_| true);
    let width = system.unknowns.len();
    if system.rows.len().max(width) > MANY {
        return Ok(Census::default());
    }
    // A figure that nothing holds in its place moves and turns as a whole, too.
    let d = problem.dimension;
    let motions = match problem.is_absolute() {
        true => 0,
        false => d * (d + 1) / 2,
    };
    let census = |rank: usize, surplus: Vec<Surplus>| Census {
        freedom: Some((width - rank).saturating_sub(motions)),
        surplus,
    };
    let unit = typical_length(&problem);
    let equations = &lowered.tail.equations;
    let target = |row: usize| equations[system.rows[row].index].target();
    let rows = 0..system.rows.len();
    let owner = |row: usize| Whose::of(&problem, lowered.owners[system.rows[row].index]);
    let owners: Vec<Whose> = rows.clone().map(owner).collect();
    let ranks: Vec<u8> = owners.iter().map(|&owner| rank(&problem, owner)).collect();
    let scale = |row: usize| unit.powi(equations[system.rows[row].index].power);
    let floats = Floats::new(&system, equations, unit);
    let mut at = system.sketch(unit);
    let choice = Choice::new(&system, &at, |_| 0, |_| 0, FINE);
    if choice.redundant.is_empty() {
        return Ok(census(choice.used.len(), Vec::new()));
    }
    let structural: Vec<bool> = ranks.iter().map(|&rank| rank < DIMENSION).collect();
    let mut is_regular = true;
    match look(&floats, &structural, (&at, &choice), 0) {
        Drawn::Regular => {}
        Drawn::Singular { off: Some(off), .. } => (at, is_regular) = (off, false),
        Drawn::Singular { off: None, .. } => return Ok(Census::default()),
    }
    let mut order: Vec<usize> = rows.collect();
    order.order_by_key(|&row| ranks[row]);
    let (independent, circuits) = dependent(&floats, &order, &at);
    // From where a singular drawing was moved off either of several figures continues it, and one says nothing of another.
    let is_looked_for = is_regular && !circuits.is_empty() && at.len() <= super::drawn::MANY;
    let meets_all = || floats.meet(&order, at.clone());
    let figure = match is_looked_for {
        true => meets_all().or_else(|| floats.meet(&independent, at.clone())),
        false => None,
    };
    // How much the right-hand side of an equation grows with its number, and by how much it may be off by the number's last digit.
    let steepest = |row: usize| match distance(&problem, owners[row]) {
        Some(length) => 2.0 * length,
        None => system.rows[row].steepness(&at).0 * scale(row) / unit,
    };
    let slack = |row: usize| steepest(row) * digits_of(&problem, owners[row]);
    let mut found: BTreeMap<Whose, (Surplus, usize)> = BTreeMap::new();
    for (row, circuit) in circuits {
        if ranks[row] == OBJECT {
            continue;
        }
        let identity = |of: &[usize]| {
            let given = of
                .iter()
                .map(|&k| Given::row(&system.rows[k], &[target(k)]));
            let given: Vec<Given> = given.collect();
            let how = combination(&system.rows[row], &given)?;
            let right = vec![target(row)];
            let rights = |i: usize| vec![target(of[i])];
            let holds = how.holds(&right, rights, |k| given[k].constant());
            let off = (&right[0] - &how.value(rights)).enclose();
            let rounded = how.sum.iter().map(|(i, factor)| {
                let factor = enclose_rational(factor).mag();
                factor * slack(of[*i])
            });
            let rounded: f64 = rounded.sum();
            let made_of = how.sum.iter().map(|(i, _)| *i).chain(how.kept);
            let made_of: BTreeSet<usize> = made_of.map(|i| of[i]).collect();
            Some((holds, off, rounded, made_of.into_iter().collect()))
        };
        let rows: Vec<usize> = circuit.iter().map(|&(k, _)| k).collect();
        // At a special drawing rows of an identity may have no part in the combination of derivatives.
        let found_here = identity(&rows);
        let is_small = independent.len() <= SMALL;
        let proved = found_here.or_else(|| is_small.then(|| identity(&independent)).flatten());
        let (identity, rounded, circuit) = match proved {
            Some((holds, off, rounded, made_of)) => (Some((holds, off)), rounded, made_of),
            None => {
                let steep = |k: usize| system.rows[k].steepness(&at).1 * scale(k);
                let of = |&(k, part): &(usize, f64)| part.abs() * slack(k) / steep(k);
                let rounded = circuit.iter().map(of).sum::<f64>() * steep(row);
                (None, rounded, rows)
            }
        };
        let divisor = steepest(row);
        let most = ((slack(row) + rounded) / divisor).max(LEAST_PART * unit);
        let finding = match (identity, &figure) {
            (Some((true, _)), _) => Finding::Follows,
            (Some((false, off)), _) => match (off / point(divisor)).mag() {
                _ if off.contains(0.0) => Finding::Open,
                by if by > most => Finding::Contradicts { by },
                by => Finding::Rounded { by },
            },
            (None, Some(figure)) => {
                let value = system.rows[row].evaluate(figure, |_, _| {}) * scale(row);
                let by = match distance(&problem, owners[row]) {
                    Some(length) => value.max(0.0).sqrt() - length,
                    None => (value - target(row).enclose().mid()) / divisor,
                };
                match by.abs() {
                    by if by > most => Finding::Missed { by },
                    _ => Finding::Met,
                }
            }
            (None, None) => Finding::Open,
        };
        let one = Surplus {
            name: owners[row].name(&problem),
            in_part: false,
            others: Vec::new(),
            besides: Vec::new(),
            finding,
        };
        let (one, count) = found.entry(owners[row]).or_insert((one, 0));
        *count += 1;
        if finding.weight() > one.finding.weight() {
            one.finding = finding;
        }
        for &k in circuit.iter().filter(|&&k| owners[k] != owners[row]) {
            let into = match ranks[k] {
                OBJECT | FIXED | COINCIDENT => &mut one.besides,
                _ => &mut one.others,
            };
            add_new(into, owners[k].name(&problem));
        }
    }
    let all = found.into_iter().map(|(owner, (mut one, count))| {
        one.in_part = owners.iter().filter(|&&other| other == owner).count() > count;
        one
    });
    Ok(census(independent.len(), all.collect()))
}

const OBJECT: u8 = 0;
const FIXED: u8 = 1;
const COINCIDENT: u8 = 2;
const DIMENSION: u8 = 5;

/// Of which kind an equation is: of those that depend on each other the last is said to be one too many.
fn rank(problem: &Problem, owner: Whose) -> u8 {
    let Whose::Constraint(c) = owner else {
        return match owner {
            Whose::Object(_) => OBJECT,
            _ => DIMENSION,
        };
    };
    let constraint = &problem.constraints[c];
    match constraint.kind.as_str() {
        "fixed" => FIXED,
        "coincident" => COINCIDENT,
        _ if constraint.value.is_some() => DIMENSION,
        kind if kind.starts_with("equal") => 4,
        _ => 3,
    }
}

/// The length that an equation is about, if it is one of a distance.
fn distance(problem: &Problem, owner: Whose) -> Option<f64> {
    let Whose::Distance(e) = owner else {
        return None;
    };
    let squared = enclose_rational(&problem.distances[e].target.squared());
    Some(squared.sqrt().mid().max(f64::MIN_POSITIVE))
}

/// Half a unit of the last digit of an equation's number; 0 where it has none, or a squared one.
fn digits_of(problem: &Problem, owner: Whose) -> f64 {
    match owner.number(problem) {
        Some((number, false)) => half_digit(number),
        _ => 0.0,
    }
}

/// Rows that are combinations of others, each with those others and their parts in it.
type Circuits = Vec<(usize, Vec<(usize, f64)>)>;

/// Of rows in this order those that say something new after those before, and each other one with the rows of which it is a
/// combination, all rows scaled to length 1: by the method of Gram and Schmidt, each row twice.
fn dependent(floats: &Floats, order: &[usize], at: &[f64]) -> (Vec<usize>, Circuits) {
    const PART: f64 = 1e-6;
    let (jacobian, _) = floats.linearise(order, at);
    // Directions of length 1 at right angles to each other, and of which of the rows taken each is a combination.
    let mut basis: Vec<(DVector<f64>, Vec<f64>)> = Vec::new();
    let (mut taken, mut circuits) = (Vec::new(), Vec::new());
    for (k, &row) in order.iter().enumerate() {
        let mut rest: DVector<f64> = jacobian.row(k).transpose();
        let mut of = vec![0.0; taken.len()];
        for _ in 0..2 {
            for (direction, parts) in &basis {
                let along = direction.dot(&rest);
                if along != 0.0 {
                    rest.axpy(-along, direction, 1.0);
                    for (sum, part) in of.iter_mut().zip(parts) {
                        *sum -= along * part;
                    }
                }
            }
        }
        let size = rest.norm();
        if size > PIVOT {
            of.push(1.0);
            of.iter_mut().for_each(|part| *part /= size);
            basis.push((rest / size, of));
            taken.push(row);
        } else {
            let all = taken.iter().zip(&of);
            let circuit = all
                .filter(|(_, part)| part.abs() > PART)
                .map(|(&row, &part)| (row, part));
            circuits.push((row, circuit.collect()));
        }
    }
    (taken, circuits)
}

impl Finding {
    /// Which of two of one constraint is the graver.
    fn weight(self) -> u8 {
        match self {
            Finding::Follows => 0,
            Finding::Met => 1,
            Finding::Rounded { .. } => 2,
            Finding::Open => 3,
            Finding::Missed { .. } => 4,
            Finding::Contradicts { .. } => 5,
        }
    }

    /// Whether the constraint contradicts the others, proved or seen.
    pub fn is_contradiction(self) -> bool {
        matches!(self, Finding::Missed { .. } | Finding::Contradicts { .. })
    }
}

impl Surplus {
    /// What is said of it, in sentences.
    pub fn in_words(&self) -> String {
        let part = if self.in_part { "in part " } else { "" };
        let set = match (self.others.as_slice(), self.besides.as_slice()) {
            ([], []) => "nothing: it holds whatever the figure is".to_owned(),
            ([], besides) => list(besides, LISTED),
            (others, []) => list(others, LISTED),
            (others, besides) => {
                format!("{} (with {})", list(others, LISTED), list(besides, 4))
            }
        };
        let how = match self.finding {
            Finding::Follows => format!("{part}follows, proved, from {set}"),
            Finding::Contradicts { by } => {
                format!("contradicts, proved, {set}: it differs by {by:.3e} from what they make it")
            }
            Finding::Rounded { by } => format!(
                "{part}says again what these say: {set}; the numbers differ by {by:.1e}, which is within their digits and no \
                 contradiction"
            ),
            Finding::Met => format!(
                "{part}seems to follow from {set}: a figure near the drawing that meets the others meets it (seen in floats)"
            ),
            Finding::Missed { by } => format!(
                "contradicts {set} near the drawing: the figure there that meets the others misses it by {by:.3e} (seen in \
                 floats)"
            ),
            Finding::Open => format!(
                "{part}depends on {set}: whether these make it hold or contradict it is not certain"
            ),
        };
        let cure = match self.others.is_empty() {
            true => "remove it".to_owned(),
            false => "remove it, or any one of these".to_owned(),
        };
        format!("{} {how}. To cure it, {cure}", self.name)
    }
}
