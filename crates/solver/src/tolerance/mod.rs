//! Tolerances: every dimension is anywhere within its limits, and this is what that does to a figure.
//!
//! For all choices of all dimensions together there is exactly one figure that the given one becomes, by one test of Krawczyk with the
//! dimensions as intervals; and what is measured of it stays between bounds. These are linear in the dimensions but for a part of second
//! order, which is bounded too. Each bound is set beside what the figure has at the corner of the limits that leads there, so that one sees
//! how sharp it is.
//!
//! ```
//! use krawl::edit::Limits;
//! use krawl::problem::Problem;
//! use krawl::tolerance::study;
//! use krawl::track::{Control, Options};
//!
//! // The hypotenuse of a right triangle with sides 3 and 4, each within a tenth.
//! let triangle = Problem::build("triangle", 2)
//!     .point("a", [0, 0]).point("b", [4, 0]).point("c", [0, 3])
//!     .distance("a", "b", 4).distance("b", "c", 5).distance("c", "a", 3)
//!     .finish()?;
//! let within = |index, low: &str, high: &str| Limits {
//!     index,
//!     values: [low, high].map(|x| x.parse().unwrap()),
//! };
//! let limits = [within(0, "3.9", "4.1"), within(2, "2.9", "3.1")];
//! let found = study(&triangle, &limits, &["angle c a b".into()], &Options::certified(), &mut Control::default())?;
//! // By the law of cosines: least where both sides are greatest.
//! let angle = |b: f64, c: f64| ((b * b + c * c - 25.0) / (2.0 * b * c)).acos().to_degrees();
//! let measured = &found.measured[0];
//! assert!(measured.bounds[0].contains(angle(4.1, 3.1)) && measured.bounds[1].contains(angle(3.9, 2.9)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod set;

pub use set::{OfSet, Set, study_all};

use crate::blocks::Account;
use crate::edit::{Limited, Limits, Setting, Within};
use crate::interval::along::Along;
use crate::interval::{Interval, enclose_rational, hull, point};
use crate::motion::{in_place, lengths};
use crate::order::InOrder;
use crate::places::array;
use crate::problem::{Decimal, Problem, Target};
use crate::system::{Quantity, WHOLE_TURN};
use crate::track::{Control, Options};

/// What tolerances do to a figure.
#[derive(Debug)]
pub struct Study {
    /// The limits.
    pub limits: Vec<Limits>,
    /// What is proved of the figures: which constraints of a sketch were left out, which coordinates are held.
    pub account: Account,
    /// The figure with the dimensions as they are given.
    pub figure: Vec<[Interval; 3]>,
    /// A box of each point over all figures, in the coordinates of the problem (as [`crate::edit::Session::points`] places figures).
    pub bands: Vec<[Interval; 3]>,
    /// What was asked for.
    pub measured: Vec<Measured>,
}

/// What tolerances do to something that is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// As it was asked for.
    pub name: String,
    /// `degrees`, `length` or `area`.
    pub unit: &'static str,
    /// With the dimensions as they are given.
    pub nominal: Interval,
    /// Enclosures of the least and the greatest value: no choice of the dimensions goes beyond the outer end of each, and a figure at a
    /// corner of the limits, or the nominal one, reaches the inner end.
    pub bounds: [Interval; 2],
    /// Whether the path to that corner was proved. Otherwise the inner end is the nominal value's.
    pub is_attained: [bool; 2],
    /// Whether it is a dimension that has no limits.
    pub is_given: bool,
    /// The root of the sum of the squares of half of each dimension's effect: a tolerance if the dimensions are independent and lie in their
    /// limits evenly or in a bell. To first order about the nominal figure, in floats; `None` where there is no first order: an angle of 0 or
    /// 180 degrees and an area or a length of 0 are at an end of what they can be.
    pub root_of_squares: Option<f64>,
    /// For each of the limits by how much it grows, about, from the dimension's least value to its greatest: likewise, and empty then.
    pub effects: Vec<f64>,
}

impl Measured {
    /// A bound of the part of a range, which is told by decimals and has the bounds in it, by which it may be too wide; infinite where it has
    /// no width.
    pub fn gap(&self, range: &[String; 2]) -> f64 {
        let exact = |end: &String| {
            end.parse::<Decimal>()
                .map(|end| enclose_rational(end.value()))
        };
        let [Ok(low), Ok(high)] = range.each_ref().map(exact) else {
            return f64::INFINITY;
        };
        let [least, greatest] = &self.bounds;
        let too_wide = (point(least.sup()) - low) + (high - point(greatest.inf()));
        match (high - low).inf() > 0.0 {
            true => (too_wide / (high - low)).sup(),
            false => f64::INFINITY,
        }
    }
}

/// So many lengths that no distance gives are measured where nothing is asked for.
const DEFAULT: usize = 12;

/// What dimensions within limits do to the figure of a problem's sketch; `asked` is what to measure, as `A-B` and `angle A B C`; if
/// nothing, the longest lengths that no distance gives.
///
/// # Errors
/// In words: what is wrong with the limits, that the figure cannot be led to its dimensions, or that it is not proved that there is one figure
/// for each choice, and with which part of the limits it is.
pub fn study(
    problem: &Problem,
    limits: &[Limits],
    asked: &[String],
    options: &Options,
    control: &mut Control,
) -> Result<Study, String> {
    let quantities = checked(problem, limits, asked)?;
    let open = |limits: &[Limits], control: &mut Control| {
        let limited = Limited::open(problem, limits, options, control);
        limited
            .map(Limited::prove)
            .map_err(|error| error.to_string())
    };
    let Some(within) = open(limits, control)? else {
        let part = (1..=10).find_map(|k| {
            let part = scaled(problem, limits, k)?;
            matches!(open(&part, control), Ok(Some(_))).then_some(1u32 << k)
        });
        let with = match part {
            Some(part) => format!("with limits {part} times as narrow it is proved"),
            None => "nor is it with limits a thousand times as narrow: the figure is at a limit of its dimensions, or near one".to_owned(),
        };
        return Err(format!(
            "it is not proved that there is one figure for every choice of the dimensions: it may flip or come apart within the limits; {with}"
        ));
    };
    studied(problem, limits, within, &quantities, control)
}

/// What is to be measured, by default the longest lengths that no distance gives; and whether limits make sense.
fn checked(
    problem: &Problem,
    limits: &[Limits],
    asked: &[String],
) -> Result<Vec<Quantity>, String> {
    let quantities = asked.iter().map(|text| Quantity::parse(problem, text));
    let mut quantities = quantities.collect::<Result<Vec<_>, _>>()?;
    if asked.is_empty() {
        let lengths = lengths(problem, &[]).into_iter().take(DEFAULT);
        quantities.extend(lengths.map(|ends| Quantity::length(problem, ends)));
    }
    if limits.is_empty() {
        return Err(
            "no dimension has a tolerance: give them under [tolerances], or with `--default 0.1`, or `--tolerance a-b=0.1`".to_owned(),
        );
    }
    for limits in limits {
        check(problem, limits)?;
    }
    if !problem.is_absolute()
        && let Some(moved) = quantities.iter().find(|q| !q.is_invariant())
    {
        return Err(format!(
            "--measure \"{}\": no constraint says where the figure is, so a coordinate has no meaning: fix points",
            moved.name
        ));
    }
    Ok(quantities)
}

/// What is measured of a figure for every choice of its dimensions.
fn studied(
    problem: &Problem,
    limits: &[Limits],
    mut within: Within,
    quantities: &[Quantity],
    control: &mut Control,
) -> Result<Study, String> {
    let figure = within.figure();
    let dimensions = problem.dimensions();
    let dimensions = dimensions.filter_map(|index| Some((index, in_place(problem, index)?)));
    let dimensions: Vec<(usize, Quantity)> = dimensions.collect();
    let measured = quantities
        .iter()
        .map(|quantity| {
            let nominal = quantity.of(&figure);
            let mut each = dimensions.iter();
            let itself = each.find(|(_, other)| other.is_same_measure(quantity));
            let own = itself.and_then(|&(index, _)| {
                own_limits(problem, limits, index, (quantity, nominal.mid()))
            });
            measure(&mut within, (quantity, nominal), own, control)
        })
        .collect::<Result<_, _>>()?;
    Ok(Study {
        limits: limits.to_vec(),
        account: within.account(),
        figure,
        bands: within.boxes(),
        measured,
    })
}

/// The limits that a file gives, and those of `named`, which count before them; `default`: so far from what they are down and up are the other
/// distances between points and radii, in place of what the file has for them.
///
/// # Errors
/// In words: a name that none has, a dimension that can have no limits.
pub fn limits(
    problem: &Problem,
    named: &[(String, [Decimal; 2])],
    default: Option<&[Decimal; 2]>,
) -> Result<Vec<Limits>, String> {
    let mut out: Vec<Limits> = Vec::new();
    let mut take = |index: usize, [down, up]: &[Decimal; 2]| -> Result<(), String> {
        if out.iter().any(|other| other.index == index) {
            return Ok(());
        }
        let Some(given) = given(problem, index) else {
            let name = problem.dimension_name(index);
            return Err(format!(
                "{name} is given as a square, which has no limits yet: give the length"
            ));
        };
        let sum = |by: &Decimal| given.plus(by).map_err(|error| error.to_string());
        let values = [sum(down)?, sum(up)?];
        out.push(Limits { index, values });
        Ok(())
    };
    let all = named.iter().chain(&problem.tolerances.named);
    for (name, deviations) in all {
        let index = Setting::find(problem, name);
        take(
            index.map_err(|error| format!("tolerance: {error}"))?,
            deviations,
        )?;
    }
    if let Some(default) = default.or(problem.tolerances.default.as_ref()) {
        for index in problem.dimensions() {
            let is_length = match index.checked_sub(problem.distances.len()) {
                None => given(problem, index).is_some(),
                Some(at) => problem.constraints[at].kind == "radii",
            };
            if is_length {
                take(index, default)?;
            }
        }
    }
    out.order_by_key(|limits| limits.index);
    Ok(out)
}

/// Kinds of constraints, beside distances between points, of which the right-hand sides grow with the value or fall: what coordinates and radii
/// are, and the cosine of an angle.
const MONOTONE: [&str; 8] = ["x", "y", "z", "dx", "dy", "dz", "radii", "angles"];

/// Whether limits make sense.
fn check(problem: &Problem, limits: &Limits) -> Result<(), String> {
    let name = problem.dimension_name(limits.index);
    let [low, high] = &limits.values;
    if low.value() > high.value() {
        return Err(format!(
            "{name}: its least value, {low}, is more than its greatest, {high}"
        ));
    }
    match limits.index.checked_sub(problem.distances.len()) {
        None if !low.is_positive() => Err(format!(
            "{name}: a length must be greater than 0, and its limits go down to {low}"
        )),
        None => Ok(()),
        Some(at) => {
            let kind = problem.constraints[at].kind.as_str();
            match MONOTONE.contains(&kind) {
                true if kind == "angles" && !(low.is_positive() && high.to_f64() < 180.0) => {
                    Err(format!(
                        "{name}: an angle is between 0 and 180 degrees, and its limits are {low} and {high}"
                    ))
                }
                true if kind == "radii" && !low.is_positive() => Err(format!(
                    "{name}: a radius must be greater than 0, and its limits go down to {low}"
                )),
                true => Ok(()),
                false => Err(format!(
                    "{name}: limits are taken of distances between points, of coordinates, radii and angles, not of `{kind}` yet: give it none"
                )),
            }
        }
    }
}

/// The value of a dimension, if it is a decimal.
pub fn given(problem: &Problem, index: usize) -> Option<Decimal> {
    match Setting::now(problem, index).target {
        Target::Length(length) => Some(length),
        Target::SquaredLength(_) => None,
    }
}

/// Limits 2ᵏ times as near to what is given.
fn scaled(problem: &Problem, limits: &[Limits], k: u32) -> Option<Vec<Limits>> {
    let scaled = limits.iter().map(|one| {
        let nominal = given(problem, one.index)?.to_f64();
        let near = |x: &Decimal| {
            let near = nominal + (x.to_f64() - nominal) / f64::from(1u32 << k);
            format!("{near:e}").parse().ok()
        };
        let [low, high] = &one.values;
        Some(Limits {
            index: one.index,
            values: [near(low)?, near(high)?],
        })
    });
    scaled.collect()
}

/// Between which values something measured is that is a dimension itself, of turns and torsions as many whole turns away as is measured
/// (`near`); `None`: its value is a square.
fn own_limits(
    problem: &Problem,
    limits: &[Limits],
    index: usize,
    (quantity, near): (&Quantity, f64),
) -> Option<[Interval; 2]> {
    let limits = limits.iter().find(|one| one.index == index);
    let values = match limits {
        Some(one) => one.values.clone(),
        None => {
            let given = given(problem, index)?;
            [given.clone(), given]
        }
    };
    let turns = match quantity.is_in_degrees() {
        true => 360.0 * ((near - values[0].to_f64()) / 360.0).round(),
        false => 0.0,
    };
    Some(values.map(|x| enclose_rational(x.value()) + point(turns)))
}

fn measure(
    within: &mut Within,
    (quantity, nominal): (&Quantity, Interval),
    own: Option<[Interval; 2]>,
    control: &mut Control,
) -> Result<Measured, String> {
    let middle = quantity.key(|p| within.middle(p), 0.0);
    let over_all = slopes(within, quantity, |p| within.near(p), middle.mid());
    let all = middle + within.change(&over_all);
    let about = slopes(within, quantity, |p| within.middle(p), middle.mid());
    let effects = within.effects(&about);
    if quantity.is_in_degrees() && (all.wid().is_nan() || all.wid() > WHOLE_TURN) {
        return Err(format!(
            "--measure \"{}\": within the limits its points may come together, where an angle has no meaning",
            quantity.name
        ));
    }
    let outer = [all.inf(), all.sup()].map(|key| quantity.of_key(point(key)));
    let mut outer = [outer[0].inf(), outer[1].sup()];
    if let Some([low, high]) = own {
        outer = [outer[0].max(low.inf()), outer[1].min(high.sup())];
    }
    let (mut bounds, mut is_attained) = ([nominal; 2], [false; 2]);
    for side in [0, 1] {
        // The least value is reached where what makes it grow is at its least.
        let grows = side == 1;
        let corner = within.corner(|k| (effects[k] > 0.0) == grows, control);
        is_attained[side] = corner.is_some();
        let inner = corner.map_or(nominal, |figure| {
            // Of angles that differ by whole turns the one between the bounds.
            quantity.of_key(quantity.key(|p| figure[p], all.mid()))
        });
        bounds[side] = match side {
            0 => {
                let inner = inner.sup().min(nominal.sup());
                hull(outer[0].min(inner), inner)
            }
            _ => {
                let inner = inner.inf().max(nominal.inf());
                hull(inner, outer[1].max(inner))
            }
        };
    }
    // What a key grows by is no more than a slope of the quantity itself.
    let scale = slope_of_key(quantity, middle.mid());
    let mut effects: Vec<f64> = effects.iter().map(|effect| effect * scale).collect();
    let is_given = own.is_some_and(|[low, high]| low == high);
    if is_given {
        effects.fill(0.0);
    }
    // Where it turns back, its slope is between two that are far apart.
    let steepest = about
        .iter()
        .map(|(_, slope)| slope.mag())
        .fold(0.0, f64::max);
    let is_smooth = about
        .iter()
        .all(|(_, slope)| slope.wid() <= SMOOTH * steepest);
    let has_first_order = is_given || is_smooth;
    if !has_first_order {
        effects.clear();
    }
    let squares: f64 = effects.iter().map(|effect| (0.5 * effect).powi(2)).sum();
    Ok(Measured {
        name: quantity.name.clone(),
        unit: quantity.unit(),
        nominal,
        bounds,
        is_attained,
        is_given,
        root_of_squares: has_first_order.then_some(squares.sqrt()),
        effects,
    })
}

/// The slope of something smooth is known to this part of the steepest, of one figure.
const SMOOTH: f64 = 1e-6;

/// The derivatives of a quantity's key by the unknowns, over all figures with points there.
fn slopes(
    within: &Within,
    quantity: &Quantity,
    there: impl Fn(usize) -> [Interval; 3],
    near: f64,
) -> Vec<(usize, Interval)> {
    let homotopy = within.homotopy();
    let mut out = Vec::new();
    for &q in quantity.points() {
        for axis in 0..homotopy.dimension {
            let Some(i) = homotopy.coordinate(q, axis) else {
                continue;
            };
            if out.iter().any(|(other, _)| *other == i) {
                continue;
            }
            // An unknown is in the homotopy's unit, and may be the coordinate of several points.
            let along = |p: usize| -> [Along; 3] {
                let at = there(p);
                array(|k| {
                    let moves = homotopy.coordinate(p, k) == Some(i);
                    Along {
                        value: at[k],
                        slope: point(if moves { homotopy.unit } else { 0.0 }),
                    }
                })
            };
            out.push((i, quantity.slope_of_key(along, near)));
        }
    }
    out
}

/// By how much a quantity grows, about, where its key does.
fn slope_of_key(quantity: &Quantity, key: f64) -> f64 {
    const STEP: f64 = 1e-4;
    let at = |key: f64| quantity.of_key(point(key)).mid();
    (at(key + STEP) - at(key - STEP)) / (2.0 * STEP)
}
