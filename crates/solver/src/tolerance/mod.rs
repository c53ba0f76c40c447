//! Tolerances: every dimension is anywhere within its limits, and this is what that does to a figure.
//!
//! For all choices of all dimensions together there is exactly one figure that the given one becomes, by tests of Krawczyk with the
//! dimensions as intervals, of parts of the limits where one test is too few; and what is measured of it stays between bounds. Where it is
//! certain which way something goes with each dimension, its bounds are what it is at corners of the limits; elsewhere the limits are cut until it is
//! known well, and each bound is set beside what a figure has, so that one sees how sharp it is.
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

mod extreme;
mod family;
mod parts;
mod set;

pub use set::{OfSet, Set, study_all};

use crate::blocks::Account;
use crate::constraint::Measure as Kind;
use crate::edit::{Ending, Limited, Limits, Part, Setting, Value, measure_of};
use crate::interval::along::Along;
use crate::interval::{Interval, certain_digits, enclose_rational, hull, point};
use crate::motion::{in_place, lengths};
use crate::order::{InOrder, add_new};
use crate::problem::{Decimal, DecimalError, Item, Problem, Shape, Target};
use crate::rational::Rational;
use crate::system::{Homotopy, Quantity, WHOLE_TURN};
use crate::track::{Control, Options};
use extreme::{Extreme, Measure};
use parts::{Failure, Proved};
use std::cell::RefCell;
use std::rc::Rc;

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
    /// Enclosures of the least and the greatest value: no choice of the dimensions goes beyond the outer end of each, and a figure within the
    /// limits reaches the inner end.
    pub bounds: [Interval; 2],
    /// For each of both the values of the dimensions, in the order of the limits, with which a figure does; empty: the figure as it is given.
    pub corners: [Vec<Decimal>; 2],
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

/// So many lengths that no distance gives are measured where nothing is asked for, and there are no coordinates.
const DEFAULT: usize = 12;

const INTERRUPTED: &str = "the run was ended before";

/// Limits of a turn are less far apart, in degrees.
const WIDEST: i32 = 180;

/// So many products of numbers, about, are made to bound all that is measured from below, and so many from above, at most: half a second.
const WORK: usize = 200_000_000;

/// What dimensions within limits do to the figure of a problem's sketch; `asked` is what to measure, as `A-B` and `angle A B C`; if
/// nothing, the coordinates of ends of lines and arcs where constraints say where the figure is, and else the longest lengths that no distance
/// gives.
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
        limited.map_err(|error| error.to_string())
    };
    let (mut limited, failure) = match Proved::new(open(limits, control)?, control) {
        Ok(proved) => return studied(problem, limits, proved, &quantities, control),
        Err(failed) => *failed,
    };
    let Failure::Part(part) = failure else {
        return Err(INTERRUPTED.to_owned());
    };
    if let Some(end) = end(problem, limits, (&mut limited, &part), control) {
        return Err(format!(
            "the figure comes to an end before the ends of its limits: {end}"
        ));
    }
    let part = (1..=10).find_map(|k| {
        let part = scaled(problem, limits, k)?;
        let is_proved = Proved::by_one_test(open(&part, control).ok()?, control);
        is_proved.then_some(1u32 << k)
    });
    let with = match part {
        Some(part) => format!("with limits {part} times as narrow it is proved"),
        None => "nor is it with limits a thousand times as narrow: the figure is at a limit of its dimensions, or near one".to_owned(),
    };
    Err(format!(
        "it is not proved that there is one figure for every choice of the dimensions: it may flip or come apart within the limits; {with}"
    ))
}

/// Where the figure comes to an end before the ends of its limits, in words, if a path does that leads the dimensions together to one side of
/// their limits: those that were cut where one figure was not proved to where that is, or all of them down or up.
fn end(
    problem: &Problem,
    limits: &[Limits],
    (limited, part): (&mut Limited, &Part),
    control: &mut Control,
) -> Option<String> {
    let all = limited.all.clone();
    let number = |value: &Rc<Value>| value.decimal.to_f64();
    let cut = limits.iter().zip(part).zip(&all).enumerate();
    let cut = cut.filter_map(|(k, ((one, part), all))| {
        let [low, high] = part.each_ref().map(number);
        let is_cut = low > number(&all[0]) || high < number(&all[1]);
        let given = Setting::now(problem, one.index).target.to_f64();
        let end = usize::from(0.5 * (low + high) > given);
        is_cut.then(|| (k, all[end].clone()))
    });
    let to_end = |end: usize| {
        let each = all.iter().enumerate();
        each.map(|(k, ends)| (k, ends[end].clone())).collect()
    };
    let ways: [Vec<(usize, Rc<Value>)>; 3] = [cut.collect(), to_end(0), to_end(1)];
    let mut ways = ways.iter().filter(|way| !way.is_empty());
    ways.find_map(|way| {
        let edited = limited.lead(way, control);
        matches!(edited.ending, Ending::Limit(_)).then_some(())?;
        let told = |at: &dyn Fn(usize) -> String| {
            let each = way.iter().enumerate().map(|(at_way, (k, _))| {
                let name = problem.dimension_name(limits[*k].index);
                format!("{name} = {}", at(at_way))
            });
            each.collect::<Vec<_>>().join(", ")
        };
        let to = told(&|k| way[k].1.decimal.to_string());
        let at = told(&|k| certain_digits(edited.dimensions[k].value));
        let together = if way.len() > 1 { " together," } else { "" };
        Some(format!(
            "led{together} towards {to}, it turns back at {at}, proved{}",
            edited.account.clause_behind()
        ))
    })
}

/// What is to be measured; and whether limits make sense.
fn checked(
    problem: &Problem,
    limits: &[Limits],
    asked: &[String],
) -> Result<Vec<Quantity>, String> {
    let quantities = asked.iter().map(|text| Quantity::parse(problem, text));
    let mut quantities = quantities.collect::<Result<Vec<_>, _>>()?;
    if asked.is_empty() {
        quantities = coordinates(problem);
    }
    if quantities.is_empty() {
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

/// The coordinates of the ends of lines and arcs, where constraints say where the figure is, but of points that stay where they are.
fn coordinates(problem: &Problem) -> Vec<Quantity> {
    let stays = |point: usize| {
        let mut constraints = problem.constraints.iter();
        constraints.any(|c| c.kind == "fixed" && c.items.contains(&Item::Point(point)))
    };
    let mut ends = Vec::new();
    let edges = problem
        .objects
        .iter()
        .flat_map(|object| match object.shape {
            Shape::Line(ends) => ends.to_vec(),
            Shape::Arc { start, end, .. } => vec![start, end],
            _ => Vec::new(),
        });
    edges
        .filter(|&p| problem.is_absolute() && !stays(p))
        .for_each(|p| {
            add_new(&mut ends, p);
        });
    let axes = ["x", "y", "z"].into_iter().take(problem.dimension);
    let named = ends.iter().flat_map(|&p| {
        let axes = axes.clone();
        axes.map(move |axis| format!("{axis} {}", problem.points[p].name))
    });
    // A name that is read as something else is none of a coordinate.
    named
        .filter_map(|text| Quantity::parse(problem, &text).ok())
        .collect()
}

/// What is measured of a figure for every choice of its dimensions.
fn studied(
    problem: &Problem,
    limits: &[Limits],
    mut proved: Proved,
    quantities: &[Quantity],
    control: &Control,
) -> Result<Study, String> {
    let (figure, objects) = (proved.limited.figure(), proved.limited.objects());
    let dimensions = problem.dimensions();
    let dimensions = dimensions.filter_map(|index| Some((index, in_place(problem, index)?)));
    let dimensions: Vec<(usize, Quantity)> = dimensions.collect();
    let work = WORK / quantities.len().max(1);
    let measured = quantities
        .iter()
        .map(|quantity| {
            let nominal = quantity.of(&figure, &objects);
            let mut each = dimensions.iter();
            let itself = each.find(|(_, other)| other.is_same_measure(quantity));
            let own = itself.and_then(|&(index, _)| {
                own_limits(problem, limits, index, (quantity, nominal.mid()))
            });
            measure(&mut proved, (quantity, nominal, work), own, control)
        })
        .collect::<Result<_, _>>()?;
    Ok(Study {
        limits: limits.to_vec(),
        account: proved.limited.account(),
        figure,
        bands: proved.bands(),
        measured,
    })
}

/// The limits that a file gives, and those of `named`, which count before them; `default`: so far from what they are down and up are the other
/// distances between points and radii, in place of what the file has for them. Of a length given by its square they are those of the length.
///
/// # Errors
/// In words: a name that none has, a dimension whose limits the file gives twice.
pub fn limits(
    problem: &Problem,
    named: &[(String, [Decimal; 2])],
    default: Option<&[Decimal; 2]>,
) -> Result<Vec<Limits>, String> {
    let mut out: Vec<Limits> = Vec::new();
    let mut take = |index: usize, by: Option<&[Decimal; 2]>| -> Result<(), String> {
        let given = Setting::now(problem, index).target;
        let (Target::Length(number) | Target::SquaredLength(number)) = &given;
        let own = [number, number].map(Decimal::clone);
        let ends = match by {
            _ if out.iter().any(|other| other.index == index) => None,
            Some(by) => Some((own, by.clone())),
            None => number
                .limits()
                .map(|ends| (ends, [0, 0].map(Decimal::from))),
        };
        if let Some((ends, by)) = ends {
            let ends = match given {
                Target::Length(_) => Ok(ends),
                Target::SquaredLength(_) => roots(&ends),
            };
            let values = ends.and_then(|[low, high]| Ok([low.plus(&by[0])?, high.plus(&by[1])?]));
            let values = values.map_err(|error| error.to_string())?;
            out.push(Limits { index, values });
        }
        Ok(())
    };
    let find =
        |name: &String| Setting::find(problem, name).map_err(|error| format!("tolerance: {error}"));
    for (name, by) in named {
        take(find(name)?, Some(by))?;
    }
    for (name, by) in &problem.tolerances.named {
        let index = find(name)?;
        let (Target::Length(number) | Target::SquaredLength(number)) =
            Setting::now(problem, index).target;
        if number.tolerance().is_some() {
            return Err(format!(
                "{name} has a tolerance with its number, and another one under [tolerances]: leave out one of them"
            ));
        }
        take(index, Some(by))?;
    }
    problem
        .dimensions()
        .try_for_each(|index| take(index, None))?;
    if let Some(default) = default.or(problem.tolerances.default.as_ref()) {
        for index in problem.dimensions() {
            let constraint = index.checked_sub(problem.distances.len());
            if constraint.is_none_or(|at| problem.constraints[at].kind == "radii") {
                take(index, Some(default))?;
            }
        }
    }
    out.order_by_key(|limits| limits.index);
    Ok(out)
}

/// Decimals below and above the roots of two numbers, near them.
fn roots([low, high]: &[Decimal; 2]) -> Result<[Decimal; 2], DecimalError> {
    let root = |x: &Decimal| enclose_rational(x.value()).sqrt();
    // The shortest decimal that reads as a float is less than the next one.
    let below = root(low).inf().next_down().next_down();
    let above = root(high).sup().next_up().next_up();
    Ok([Decimal::try_from(below)?, Decimal::try_from(above)?])
}

/// Whether limits make sense.
fn check(problem: &Problem, limits: &Limits) -> Result<(), String> {
    let name = problem.dimension_name(limits.index);
    let [low, high] = &limits.values;
    if low.value() > high.value() {
        return Err(format!(
            "{name}: its least value, {low}, is more than its greatest, {high}"
        ));
    }
    if let Target::SquaredLength(square) = Setting::now(problem, limits.index).target
        && !(low.value().pow(2) <= *square.value() && *square.value() <= high.value().pow(2))
    {
        return Err(format!(
            "{name} is given by its square, and has to be between its limits, {low} and {high}: give the length"
        ));
    }
    let most = match measure_of(problem, limits.index) {
        Kind::Signed => return Ok(()),
        Kind::Turn if (high.value() - low.value()) < Rational::from_integer(WIDEST.into()) => {
            return Ok(());
        }
        Kind::Turn | Kind::Nothing => {
            return Err(format!(
                "{name}: its limits, {low} and {high}, are {WIDEST} degrees apart or more: give narrower ones"
            ));
        }
        Kind::Length | Kind::Ratio => f64::INFINITY,
        Kind::Degrees => 180.0,
        Kind::Slope => 90.0,
    };
    match low.is_positive() && high.to_f64() < most {
        true => Ok(()),
        false if most.is_finite() => Err(format!(
            "{name}: it is between 0 and {most} degrees, and its limits are {low} and {high}"
        )),
        false => Err(format!(
            "{name}: a length or ratio must be greater than 0, and its limits go down to {low}"
        )),
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
        let nominal = Setting::now(problem, one.index).target.to_f64();
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
    proved: &mut Proved,
    (quantity, nominal, work): (&Quantity, Interval, usize),
    own: Option<[Interval; 2]>,
    control: &Control,
) -> Result<Measured, String> {
    let homotopy = proved.limited.homotopy();
    let given = |i: usize| proved.limited.nominal(i);
    let middle = quantity.key(&homotopy.seen(given), 0.0);
    let near = middle.mid();
    // Over all of the figure's box: what is flat but for a rounding turns back in it.
    let about = slopes(homotopy, quantity, given, near);
    let effects = proved.effects(&about);
    let what = Measure {
        quantity,
        near,
        work,
    };
    let pieces = proved.pieces.iter();
    let keys = pieces.map(|piece| what.over(&proved.limited, &piece.family));
    let keys: Vec<Interval> = keys.collect();
    let all = keys.iter().fold(middle, |all, key| all.convex_hull(*key));
    // Of turns the nearest to the figure's was taken.
    let is_far = |end: f64| (end - near).abs() >= 0.5 * WHOLE_TURN;
    if quantity.is_in_degrees() && (all.wid().is_nan() || is_far(all.inf()) || is_far(all.sup())) {
        return Err(format!(
            "--measure \"{}\": within the limits it may go by half a turn or more, or its points may come together, where an angle has no meaning: give narrower limits, or leave it out",
            quantity.name
        ));
    }
    let is_nominal_within = proved.limited.is_given_in(&proved.limited.within);
    let mut extreme = |greatest: bool| {
        let found = proved.extreme((&what, &keys), greatest, all.wid(), control);
        let nominal = if greatest { middle.inf() } else { middle.sup() };
        let is_beyond = if greatest {
            nominal > found.inner
        } else {
            nominal < found.inner
        };
        if is_nominal_within && is_beyond {
            return Ok(Extreme {
                inner: nominal,
                corner: Vec::new(),
                ..found
            });
        }
        let nothing = || {
            format!(
                "--measure \"{}\": no figure within the limits was found whose bounds are known",
                quantity.name
            )
        };
        let is_known = found.inner.is_finite() && found.outer.is_finite();
        is_known.then_some(found).ok_or_else(nothing)
    };
    let (least, greatest) = (extreme(false)?, extreme(true)?);
    let [low, high] = [&least, &greatest].map(|one| {
        let of = |key: f64| quantity.of_key(point(key));
        (of(one.outer), of(one.inner))
    });
    let mut outer = [low.0.inf(), high.0.sup()];
    let inner = [low.1.sup(), high.1.inf()];
    if let Some([low, high]) = own {
        outer = [outer[0].max(low.inf()), outer[1].min(high.sup())];
    }
    let bounds = [
        hull(outer[0].min(inner[0]), inner[0]),
        hull(inner[1], outer[1].max(inner[1])),
    ];
    // What a key grows by is no more than a slope of the quantity itself.
    let scale = slope_of_key(quantity, near);
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
    let is_smooth = steepest.is_finite()
        && about
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
        corners: [least.corner, greatest.corner],
        is_given,
        root_of_squares: has_first_order.then_some(squares.sqrt()),
        effects,
    })
}

/// The slope of something smooth is known to this part of the steepest, of one figure.
const SMOOTH: f64 = 1e-6;

/// The derivatives of a quantity's key by the unknowns, over all figures with unknowns there, in the homotopy's unit.
fn slopes(
    homotopy: &Homotopy,
    quantity: &Quantity,
    there: impl Fn(usize) -> Interval,
    near: f64,
) -> Vec<(usize, Interval)> {
    let used = RefCell::new(Vec::new());
    let noting = |i: usize| {
        add_new(&mut used.borrow_mut(), i);
        there(i)
    };
    quantity.key(&homotopy.seen(noting), near);
    let used = used.into_inner().into_iter();
    let slope = |i: usize| {
        let along = |k: usize| Along {
            value: there(k),
            slope: point(f64::from(u8::from(k == i))),
        };
        (i, quantity.slope_of_key(&homotopy.seen(along), near))
    };
    used.map(slope).collect()
}

/// By how much a quantity grows, about, where its key does.
fn slope_of_key(quantity: &Quantity, key: f64) -> f64 {
    const STEP: f64 = 1e-4;
    let at = |key: f64| quantity.of_key(point(key)).mid();
    (at(key + STEP) - at(key - STEP)) / (2.0 * STEP)
}
