//! Which constraints are one too many, each with the few that it depends on.
//!
//! All equations are looked at, those of coincidences too, at a figure near the drawing (`near.rs`). They are taken in an order in
//! which what can be removed least comes first: what arcs and other objects are, what is fixed, coincidences, other constraints
//! without a number, equalities, and last dimensions, each kind in the order of the file. One that says nothing new after those
//! before is surplus if an identity tells so, or if it is seen to hold at figures moved from that one along which the others are met
//! (`tried.rs`): to first order at one figure is not enough. The set that it depends on is told with it. What is no identity is
//! floats: whether it follows or contradicts is then seen at that figure.

use super::account::half_digit;
use super::cure::cures;
use super::cut::straight_apart;
use super::drawn::{Floats, Seen};
use super::follows::{Given, combination};
use super::freedom::Freedom;
use super::near::{LARGE, Near, What};
use super::singular::Singular;
use super::whose::Whose;
use super::{LEAST_PART, Row, System};
use crate::interval::{enclose_rational, point};
use crate::order::{InOrder, add_new, each_once};
use crate::problem::{Problem, list};
use crate::system::typical_length;
use std::collections::{BTreeMap, BTreeSet};

/// More equations or unknowns are not looked at: it would take seconds.
const MANY: usize = 900;
/// With no more equations than these an identity is looked for among all, where it is not found in the smallest set.
const SMALL: usize = 60;
/// Names that are listed before "and n more".
const LISTED: usize = 12;

/// A constraint, or what an object is, of which some equations are too many.
#[derive(Debug, Clone, PartialEq)]
pub struct Surplus {
    /// What people call it.
    pub name: String,
    /// Whether an object says it, which is not to be removed.
    pub is_object: bool,
    /// Whether others say only a part of what it says.
    pub in_part: bool,
    /// The other constraints of a small set that depends on each other.
    pub others: Vec<String>,
    /// What belongs to that set besides: arcs, fixed points, coincidences.
    pub besides: Vec<String>,
    /// Those of all these that can be removed as a whole, each by itself, without the figure having more freedom, itself first; `None`:
    /// that is not known.
    pub cures: Option<Vec<String>>,
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
#[derive(Debug, Clone, PartialEq)]
pub struct Census {
    /// In how many ways it can still move.
    pub freedom: Freedom,
    /// Constraints and objects of which something is too much.
    pub surplus: Vec<Surplus>,
    /// Constraints that depend on each other at a figure near the drawing, though none of them follows from others.
    pub singular: Option<Singular>,
}

/// The constraints that are one too many, in the order in which they are found to be so. Of what depends on each other only to first
/// order at one figure, and of very large ones, nothing is said.
///
/// # Errors
/// What is wrong with the problem, in words.
pub fn surplus(problem: &Problem) -> Result<Census, String> {
    let (problem, lowered) = straight_apart(problem)?;
    // No unknowns are merged: what says that two are one is an equation like others here.
    let system = System::new(&problem, &lowered, |_| true);
    let width = system.unknowns.len();
    if system.rows.len().max(width) > MANY {
        let why = format!("there are more than {MANY} unknowns or equations");
        return Ok(Census {
            freedom: Freedom::open(&problem, &why),
            surplus: Vec::new(),
            singular: None,
        });
    }
    let unit = typical_length(&problem);
    let equations = &lowered.tail.equations;
    let target = |row: usize| equations[system.rows[row].index].target();
    let rows = 0..system.rows.len();
    let owner = |row: usize| Whose::of(&problem, lowered.owners[system.rows[row].index]);
    let owners: Vec<Whose> = rows.clone().map(owner).collect();
    let ranks: Vec<u8> = owners.iter().map(|&owner| rank(&problem, owner)).collect();
    let scale = |row: usize| unit.powi(equations[system.rows[row].index].power);
    let floats = Floats::new(&system, equations, unit);
    let structural: Vec<bool> = ranks.iter().map(|&rank| rank < DIMENSION).collect();
    let mut order: Vec<usize> = rows.collect();
    order.order_by_key(|&row| ranks[row]);
    let near = Near::new(&floats, &order, &structural, system.sketch(unit));
    let (at, independent) = (&near.at, &near.independent);
    // Rows that others are seen to depend on: all that are met, but those found to be too many.
    let is_place =
        matches!(near.what, What::Figure | What::Most { .. }) && at.len() <= super::drawn::MANY;
    let mut kept: Vec<usize> = order
        .iter()
        .copied()
        .filter(|&row| !floats.misses(row, at))
        .collect();
    let mut singular: Vec<usize> = Vec::new();
    // How much the right-hand side of an equation grows with its number, and by how much it may be off by the number's last digit.
    let steepest = |row: usize| match distance(&problem, owners[row]) {
        Some(length) => 2.0 * length,
        None => system.rows[row].steepness(at).0 * scale(row) / unit,
    };
    let slack = |row: usize| steepest(row) * digits_of(&problem, owners[row]);
    // Of each owner: the finding, the rows, and whose rows these depend on.
    let mut found: Vec<(usize, Finding, Vec<usize>)> = Vec::new();
    for (row, circuit) in near.circuits.iter().rev() {
        let row = *row;
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
        let proved = found_here.or_else(|| is_small.then(|| identity(independent)).flatten());
        let was_kept = kept.len();
        kept.retain(|&other| other != row);
        let (identity, rounded, set) = match proved {
            Some((holds, off, rounded, made_of)) => (Some((holds, off)), rounded, made_of),
            None => {
                let set = match near.what {
                    // What depends on what at a singular drawing says nothing.
                    What::Drawing { is_regular: false } => continue,
                    _ if is_place => floats.holds_with(row, &rows, [independent, &kept], at),
                    _ => Some(rows.clone()),
                };
                let Some(set) = set else {
                    if kept.len() < was_kept {
                        kept.push(row);
                    }
                    singular.extend(rows.into_iter().chain([row]));
                    continue;
                };
                let steep = |k: usize| floats.steepness(k, at) * scale(k);
                let of = |&(k, part): &(usize, f64)| part.abs() * slack(k) / steep(k);
                let rounded = circuit.iter().map(of).sum::<f64>() * steep(row);
                (None, rounded, set)
            }
        };
        let divisor = steepest(row);
        let most = ((slack(row) + rounded) / divisor).max(LEAST_PART * unit);
        let finding = match identity {
            Some((true, _)) => Finding::Follows,
            Some((false, off)) => match (off / point(divisor)).mag() {
                _ if off.contains(0.0) => Finding::Open,
                by if by > most => Finding::Contradicts { by },
                by => Finding::Rounded { by },
            },
            None if is_place => {
                let value = system.rows[row].evaluate(at, |_, _| {}) * scale(row);
                let by = match distance(&problem, owners[row]) {
                    Some(length) => value.max(0.0).sqrt() - length,
                    None => (value - target(row).enclose().mid()) / divisor,
                };
                match (by.abs(), near.what) {
                    (by, _) if by <= most => Finding::Met,
                    (_, What::Most { is_one: false }) => Finding::Open,
                    (by, _) => Finding::Missed { by },
                }
            }
            None => Finding::Open,
        };
        found.push((row, finding, set));
    }
    let is_clear = is_place && singular.is_empty();
    let free = width - independent.len();
    let mut all: BTreeMap<Whose, (usize, Finding, BTreeSet<usize>)> = BTreeMap::new();
    for (row, finding, set) in found {
        let one = all
            .entry(owners[row])
            .or_insert((0, finding, BTreeSet::new()));
        one.0 += 1;
        one.2.extend(set);
        if finding.weight() > one.1.weight() {
            one.1 = finding;
        }
    }
    let surplus = all.into_iter().map(|(owner, (count, finding, set))| {
        let mut of: Vec<Whose> = Vec::new();
        set.into_iter()
            .for_each(|row| add_new(&mut of, owners[row]));
        of.retain(|&other| other != owner);
        let names = |of: &mut dyn Iterator<Item = &Whose>| {
            let mut names = Vec::new();
            of.for_each(|owner| add_new(&mut names, owner.name(&problem)));
            names
        };
        let is_beside = |owner: &&Whose| rank(&problem, **owner) <= COINCIDENT;
        let is_object = |owner: &Whose| rank(&problem, *owner) == OBJECT;
        let equations = owners.iter().filter(|&&other| other == owner).count();
        // Points that come apart are no cure.
        let others = of.iter().filter(|owner| !is_beside(owner));
        let among: Vec<Whose> = [owner].into_iter().chain(others.copied()).collect();
        // Of large ones this takes long.
        let most = if at.len() > LARGE { 1 } else { among.len() };
        let can_go = |&owner: &Whose| Some((owner, cures(&problem, owner, (&system, at), free)?));
        let tried: Option<Vec<(Whose, bool)>> = match is_clear {
            true => among.iter().take(most).map(can_go).collect(),
            // What is proved to follow may go.
            false if count == equations && finding == Finding::Follows => Some(vec![(owner, true)]),
            false => None,
        };
        let cures = tried.map(|tried| {
            let good = tried.into_iter().filter(|(_, is_good)| *is_good);
            good.map(|(owner, _)| owner).collect::<Vec<Whose>>()
        });
        // An equation that only says what a number is that it uses is none that is needed.
        let is_of_it = |row: &Row| Whose::of(&problem, lowered.owners[row.index]) == owner;
        let own = system.own_numbers(&lowered.tail.objects, is_of_it);
        let in_part = count + own < equations;
        Surplus {
            name: owner.name(&problem),
            is_object: is_object(&owner),
            in_part,
            others: names(&mut of.iter().filter(|owner| !is_beside(owner))),
            besides: names(&mut of.iter().filter(is_beside)),
            cures: cures.map(|cures| names(&mut cures.iter())),
            finding,
        }
    });
    let surplus = surplus.collect();
    let singular = each_once(singular);
    Ok(Census {
        freedom: match singular.is_empty() {
            true => Freedom::of(&problem, free, near.what),
            false => Freedom::open(&problem, "the figure near the drawing is singular"),
        },
        singular: (!singular.is_empty()).then(|| {
            let names = singular.iter().map(|&row| owners[row].name(&problem));
            Singular::new(&problem, &system, &singular, (names, Seen::FirstOrder))
        }),
        surplus,
    })
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
                format!("{} (with {})", list(others, LISTED), list(besides, LISTED))
            }
        };
        let how = match self.finding {
            Finding::Follows => format!("{part}follows, proved, from {set}"),
            Finding::Contradicts { by } => format!(
                "{part}contradicts, proved, {set}: it differs by {by:.3e} from what they make it"
            ),
            Finding::Rounded { by } => format!(
                "{part}says again what these say: {set}; the numbers differ by {by:.1e}, which is within their digits and no \
                 contradiction"
            ),
            Finding::Met => format!(
                "{part}seems to follow from {set}: figures near the drawing that meet these meet it (seen in floats)"
            ),
            Finding::Missed { by } => format!(
                "{part}contradicts {set} near the drawing: figures there that meet these miss it by {by:.3e} (seen in floats)"
            ),
            Finding::Open => format!(
                "{part}depends on {set}, to first order where it is drawn (seen in floats): whether these make it hold or \
                 contradict it is not certain"
            ),
        };
        format!("{} {how}{}", self.name, self.cure_in_words())
    }

    /// What cures it, in a sentence.
    fn cure_in_words(&self) -> String {
        let Some(cures) = &self.cures else {
            return String::new();
        };
        if self.is_object {
            return ". Objects need not be changed for that".to_owned();
        }
        let others: Vec<&String> = cures.iter().filter(|&cure| *cure != self.name).collect();
        let can_go = others.len() < cures.len();
        match (can_go, others.as_slice()) {
            (true, []) => ". To cure it, remove it".to_owned(),
            (true, others) if others.len() == self.others.len() => {
                ". To cure it, remove it, or any one of these".to_owned()
            }
            (true, others) => format!(
                ". To cure it, remove it, or one of {}",
                list(others, LISTED)
            ),
            (false, []) => ". Removed as a whole it would let the figure move".to_owned(),
            (false, [one]) => format!(". To cure it, remove {one}"),
            (false, others) => format!(". To cure it, remove one of {}", list(others, LISTED)),
        }
    }
}
