//! How a figure moves that has one degree of freedom: all figures that it comes through, and between which bounds what is measured
//! of them stays.
//!
//! The figures that meet all dimensions are then a curve. It is the path along which some distance, which no constraint gives, changes while
//! everything else stands still; that path is followed past every place where the distance turns back, until the figure is the first
//! one again. Each step is proved, as those of [`crate::track`] are, so a loop is the whole of it: no other figure can be reached from
//! the drawing without taking the linkage apart.
//!
//! ```
//! use krawl::motion::{Bounds, Motion};
//! use krawl::problem::Problem;
//! use krawl::track::{Control, Options};
//!
//! // A four-bar linkage, of which the crank can turn all the way round.
//! let linkage = Problem::parse_loosely(
//!     r#"
//!     name = "four-bar"
//!     dimension = 2
//!     [points]
//!     A = [0, 0]
//!     D = [4, 0]
//!     B = [0.5, 0.86]
//!     C = [3.34, 2.92]
//!     [constraints]
//!     distances = [["A", "D", 4], ["A", "B", 1], ["B", "C", 3.5], ["C", "D", 3]]
//!     "#,
//!     "four-bar.toml",
//! )?;
//! let asked = ["turn D A B", "angle A D C"].map(String::from);
//! let motion = Motion::of(&linkage, &[], &asked, &Options::certified(), &mut Control::default())?;
//! assert!(motion.is_loop());
//! assert_eq!(motion.measured[0].bounds, Bounds::AllTheWay(1));
//! // The rocker's ends, where crank and coupler are in line: 3² + 4² - 2·3·4·cos = (3.5 ± 1)².
//! let Bounds::Between { least, most } = &motion.measured[1].bounds else { panic!() };
//! let dead = |reach: f64| ((25.0 - reach * reach) / 24.0_f64).acos().to_degrees();
//! assert!((least.value.mid() - dead(2.5)).abs() < 1e-6 && least.value.wid() < 1e-5);
//! assert!((most.value.mid() - dead(4.5)).abs() < 1e-6 && most.value.wid() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bounds;
mod surplus;

pub use bounds::{Bounds, Extreme, Measured};

use crate::blocks::Account;
use crate::edit::{Round, Setting, WayEnd};
use crate::interval::Interval;
use crate::interval::vector::distance;
use crate::order::InOrder;
use crate::order::each_once;
use crate::problem::{Decimal, Distance, Item, Point, Problem, Target, counted, list};
use crate::system::{Located, Quantity};
use crate::track::{Control, Options, Status, StopKind};
use std::collections::{BTreeMap, HashSet};

/// All figures of a linkage that moves in one way.
#[derive(Debug)]
pub struct Motion {
    /// The problem without the dimensions that were set free.
    pub problem: Problem,
    /// The names of those.
    pub freed: Vec<String>,
    /// The points whose distance, which no constraint gives, was led along the path.
    pub driver: [usize; 2],
    /// Where it ends one way and the other: nowhere if it is a loop.
    pub ends: Vec<WayEnd>,
    /// The tubes in which it is proved.
    pub tubes: usize,
    /// What is proved of its figures: which distances were left out, and how all figures stand to them.
    pub account: Account,
    /// No point was moved further than this from where the sketch has it to the figure that the motion sets out from (its reference
    /// standing still where no constraint says where it is).
    pub moved: f64,
    /// That figure.
    pub figure: Vec<[Interval; 3]>,
    /// What was asked for, in that order.
    pub measured: Vec<Measured>,
    /// The points that stand still in all coordinates that are given: the first where it is drawn, the next one on its ray from there, and in
    /// space a third in their plane. None where constraints say where the figure is.
    pub standing: Vec<usize>,
    /// Figures along the path at equal lengths of it, beginning with the first one (or with the end behind it); of a loop the last one is
    /// the first.
    pub frames: Vec<Frame>,
    /// The problem with the length that was led, as it is drawn, and what it was led to.
    driven: (Problem, Setting),
}

/// A figure along the way.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The length of the path up to it, Euclidean in all coordinates and the driven length's part of the way.
    pub at: f64,
    /// A box around its points, in the coordinates of the problem.
    pub points: Vec<[Interval; 3]>,
    /// What numbers objects have in it: turns and travels of joints, radii, unknowns. (Where lines and planes of their own are is told as the path was
    /// followed, and not in the coordinates of the problem.)
    pub objects: Vec<Located>,
}

/// So many lengths are tried, one after the other, until the path along which one of them changes closes: one that comes to be 0
/// leads nowhere.
const TRIED: usize = 8;

/// Where there are more distances than say something new, which are left out is chosen in so many ways.
const CHOICES: usize = 4;

/// And for each of these so many lengths are tried.
const EACH: usize = 2;

/// Names in one list of a message.
const LISTED: usize = 12;

/// So many lengths are measured where nothing was asked for.
const DEFAULT: usize = 12;

/// Frames for pictures and tables.
const FRAMES: usize = 181;

impl Motion {
    /// Follows the figure of a problem's sketch, which has one degree of freedom once some dimensions, `free`, are left out.
    ///
    /// `asked` is what to measure, as `A-B` and `angle A B C`; if it is nothing, the dimensions that were left out and the lengths
    /// that change.
    ///
    /// # Errors
    /// Where there is no such motion, or none was found: why, in words.
    pub fn of(
        problem: &Problem,
        free: &[String],
        asked: &[String],
        options: &Options,
        control: &mut Control,
    ) -> Result<Self, String> {
        if problem.points.is_empty() {
            let what = match problem.has_joints() {
                true => NO_LENGTHS,
                false => {
                    "there are no points: what moves is measured by lengths, angles and coordinates of points, and not of unknown numbers yet"
                }
            };
            return Err(what.to_owned());
        }
        let (problem, freed, mut quantities) = without(problem, free)?;
        if !asked.is_empty() {
            quantities.clear();
        }
        for text in asked {
            quantities.push(Quantity::parse(&problem, text)?);
        }
        let (led, corrected) = surplus::corrected(&problem);
        let lengths = lengths(&led, &quantities);
        if lengths.is_empty() && problem.has_joints() {
            return Err(NO_LENGTHS.to_owned());
        }
        let Followed {
            round,
            driver,
            left_out,
            mut driven,
        } = follow((&led, &problem.points), &lengths, options, control)?;
        let account = surplus::account(&problem, &left_out, &round, control);
        if account.left_out.iter().any(|one| one.verdict.is_missed()) {
            return Err(format!(
                "the figure cannot move while all its dimensions stand still: without {} it could, and somewhere on that way {}",
                list(&account.names_left_out(), LISTED),
                account.left_out_in_words()
            ));
        }
        driven.0.name = match &account.names_left_out()[..] {
            [] => format!("the motion of {}", problem.name),
            without => format!(
                "the motion of {} without {}",
                problem.name,
                list(without, LISTED)
            ),
        };
        let is_by_default = asked.is_empty();
        if is_by_default {
            let known: Vec<_> = quantities.iter().filter_map(Quantity::ends).collect();
            let others = lengths.iter().filter(|ends| !known.contains(ends));
            quantities.extend(others.map(|&ends| Quantity::length(&problem, ends)));
        }
        let frames = frames(&round);
        let mut measured = Vec::new();
        for quantity in quantities {
            if is_by_default && !changes(&frames, &quantity) {
                continue;
            }
            let found = bounds::measure(&round, quantity, control);
            // Of all lengths those that change are meant, and points in one place count as one.
            if !is_by_default
                || found.changes() && !measured.iter().any(|other| found.is_like(other))
            {
                measured.push(found);
            }
            if is_by_default && measured.len() == DEFAULT {
                break;
            }
        }
        Ok(Motion {
            driver,
            account,
            freed,
            frames,
            standing: round.standing().to_vec(),
            moved: corrected + round.moved().distance,
            figure: round.figure(),
            tubes: round.tubes,
            ends: round.ends,
            measured,
            problem,
            driven,
        })
    }

    /// What a certificate of the motion is about: the problem without dimensions that are free or were left out, and with the length that is led.
    pub fn certified(&self) -> &Problem {
        &self.driven.0
    }

    /// Follows the motion once more for the witness of `control`, the writer of a certificate of [`Motion::certified`]. Whether it has to be told the
    /// other way (`reverse` of the options): this way the proof stops, and that way the figure comes back.
    ///
    /// # Errors
    /// Where that does not begin: why, in words.
    pub fn tell(&self, options: &Options, control: &mut Control) -> Result<bool, String> {
        let (problem, setting) = &self.driven;
        let told = Round::tell(problem, setting, options, control);
        let told = told.map_err(|error| error.to_string())?;
        Ok(matches!(told, Status::Stopped(stop) if stop.kind == StopKind::OtherWay))
    }

    /// Whether the figure comes back to where it set out from.
    pub fn is_loop(&self) -> bool {
        self.ends.is_empty()
    }

    /// Whether it is known where its way ends, if it is no loop: both ends are places of its own.
    pub fn is_told(&self) -> bool {
        self.is_loop() || self.ends.len() == 2 && self.ends.iter().all(|end| end.is_told)
    }
}

/// A problem without some dimensions, their names as they are written, and what can be measured in their place.
fn without(
    problem: &Problem,
    free: &[String],
) -> Result<(Problem, Vec<String>, Vec<Quantity>), String> {
    let mut indices = Vec::new();
    for name in free {
        indices.push(Setting::find(problem, name).map_err(|error| error.to_string())?);
    }
    let indices = each_once(indices);
    let names = indices.iter().map(|&index| problem.dimension_name(index));
    let quantities = indices.iter().filter_map(|&index| in_place(problem, index));
    let (names, quantities) = (names.collect(), quantities.collect());
    Ok((leave_out(problem, &indices), names, quantities))
}

/// A problem without some dimensions.
fn leave_out(problem: &Problem, indices: &[usize]) -> Problem {
    let mut out = problem.clone();
    let is_kept = |index: usize| !indices.contains(&index);
    let head = problem.distances.len();
    let mut at = 0..head;
    out.distances.retain(|_| at.next().is_some_and(is_kept));
    let mut at = head..;
    out.constraints.retain(|_| at.next().is_some_and(is_kept));
    let before = |index: usize| indices.iter().filter(|&&freed| freed < index).count();
    let labels = problem.labels.iter();
    let labels = labels.filter(|(index, _)| is_kept(**index));
    out.labels = labels
        .map(|(&index, label)| (index - before(index), label.clone()))
        .collect::<BTreeMap<_, _>>();
    // None of those that are left is bent.
    out.homotopy.bend = out.distances.len();
    out
}

/// What is measured of a dimension that is free.
pub(crate) fn in_place(problem: &Problem, index: usize) -> Option<Quantity> {
    let Some(constraint) = index
        .checked_sub(problem.distances.len())
        .map(|at| &problem.constraints[at])
    else {
        return Some(Quantity::length(problem, problem.distances[index].points));
    };
    let names = constraint.items.iter().map(|item| match *item {
        Item::Point(p) => Some(problem.points[p].name.as_str()),
        Item::Object(o) => Some(problem.objects[o].name.as_str()),
        Item::Axis(_) => None,
    });
    let names: Vec<&str> = names.collect::<Option<_>>()?;
    let word = match constraint.kind.as_str() {
        "angles" => "angle",
        "turns" => "turn",
        "torsions" => "torsion",
        "travels" => "travel",
        "radii" => "radius",
        "values" => "value",
        axis @ ("x" | "y" | "z") => axis,
        _ => return None,
    };
    Quantity::parse(problem, &format!("{word} {}", names.join(" "))).ok()
}

/// Lengths that no distance gives, those that are asked for first, and then those that were drawn longest.
pub(crate) fn lengths(problem: &Problem, quantities: &[Quantity]) -> Vec<[usize; 2]> {
    let in_order = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let given = problem.distances.iter().map(|d| in_order(d.points));
    let mut known: HashSet<[usize; 2]> = given.collect();
    let count = problem.points.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
    let mut others: Vec<(f64, [usize; 2])> =
        pairs.map(|ends| (drawn(problem, ends), ends)).collect();
    others.order_by(|a, b| b.0.total_cmp(&a.0));
    let asked = quantities.iter().filter_map(Quantity::ends);
    let asked = asked.map(|ends| (drawn(problem, ends), ends));
    asked
        .chain(others)
        .filter(|&(length, ends)| length > 0.0 && known.insert(in_order(ends)))
        .map(|(_, ends)| ends)
        .collect()
}

/// A length as it is drawn.
fn drawn(problem: &Problem, ends: [usize; 2]) -> f64 {
    let [a, b] = ends.map(|p| problem.points[p].place());
    distance(a, b)
}

/// A path that was followed.
struct Followed {
    round: Round,
    /// The length that was led along it.
    driver: [usize; 2],
    /// The distances that were left out, by index.
    left_out: Vec<usize>,
    /// The problem with that length, and what it was led to.
    driven: (Problem, Setting),
}

impl Followed {
    /// How much is known of it.
    fn rank(&self) -> usize {
        match &self.round.ends[..] {
            [] => LOOP,
            ends => ends.iter().filter(|end| end.is_told).count(),
        }
    }
}

/// More than any other [`Followed::rank`].
const LOOP: usize = 3;

/// Follows the path along which one of some lengths changes: the first of which it closes. `drawn`: the points where they are drawn.
fn follow(
    (problem, drawn): (&Problem, &[Point]),
    lengths: &[[usize; 2]],
    options: &Options,
    control: &mut Control,
) -> Result<Followed, String> {
    let is_of_distances = problem.is_distances_only();
    if is_of_distances {
        match surplus::freedom(problem) {
            0 => return Err(RIGID.to_owned()),
            1 => {}
            n => {
                return Err(format!(
                    "a motion is of a figure with one degree of freedom, and as it is drawn this one can begin to move in {n} ways: give {} more, or, if \
                     it is drawn flat or at a dead centre, draw it a little bent",
                    counted(n - 1, "dimension")
                ));
            }
        }
    }
    let mut best: Option<Followed> = None;
    let (mut tried, mut fault) = (0, None);
    let attempts =
        (0..CHOICES).flat_map(|choice| lengths.iter().map(move |&driver| (choice, driver)));
    for (choice, driver) in attempts {
        if tried == TRIED || control.is_interrupted() {
            break;
        }
        // Of each choice of what is left out a few lengths.
        let has_surplus = best.as_ref().is_some_and(|best| !best.left_out.is_empty());
        if has_surplus && tried >= EACH * (choice + 1) {
            continue;
        }
        let left_out = match is_of_distances {
            true => surplus::surplus(problem, driver, choice),
            false => Some(Vec::new()),
        };
        let Some(left_out) = left_out else {
            continue;
        };
        if left_out.is_empty() && choice > 0 {
            break;
        }
        let used = match &left_out[..] {
            [] => problem.clone(),
            left_out => leave_out(problem, left_out),
        };
        let (driven, setting) = driven(&used, driver);
        let round = match driven.check() {
            Ok(()) => {
                let round = Round::new((&driven, drawn), &setting, options, control);
                round.map_err(|e| e.to_string())
            }
            Err(error) => Err(error.to_string()),
        };
        let round = match round {
            Ok(round) => round,
            Err(error) => {
                fault.get_or_insert(error);
                continue;
            }
        };
        // A length that does not change sets nothing in motion.
        if round.trace.tubes() == 0 {
            fault.get_or_insert_with(|| round.ends.iter().map(|end| end.words.clone()).collect());
            continue;
        }
        tried += 1;
        let followed = Followed {
            round,
            driver,
            left_out,
            driven: (driven, setting),
        };
        if best
            .as_ref()
            .is_none_or(|best| followed.rank() > best.rank())
        {
            best = Some(followed);
        }
        if best.as_ref().is_some_and(|best| best.rank() == LOOP) {
            break;
        }
    }
    best.ok_or_else(|| rigid(problem, fault))
}

/// The problem with one more distance, and a value for it to be led to.
fn driven(problem: &Problem, ends: [usize; 2]) -> (Problem, Setting) {
    let mut out = problem.clone();
    let length = drawn(problem, ends);
    let decimal = |x: f64| Decimal::try_from(x).unwrap_or(Decimal::from(1));
    // As in a problem's text, lengths before squared lengths.
    let is_squared = |d: &Distance| matches!(d.target, Target::SquaredLength(_));
    let index = out.distances.iter().position(is_squared);
    let index = index.unwrap_or(out.distances.len());
    let driver = Distance {
        points: ends,
        target: Target::Length(decimal(length)),
    };
    out.distances.insert(index, driver);
    // Nothing is bent, but problems of distances name one that may be; the reference is chosen among the others.
    out.homotopy.bend = match problem.is_distances_only() {
        true => index,
        false => out.distances.len(),
    };
    // Labels of constraints stand behind those of distances.
    let labels = std::mem::take(&mut out.labels).into_iter();
    let moved = labels.map(|(at, label)| (at + usize::from(at >= index), label));
    out.labels = moved.collect();
    let target = Target::Length(decimal(1.25 * length));
    // The reference that there is stands still, if it can.
    let has_reference = !out.homotopy.reference.is_empty() && out.check().is_ok();
    let out = match has_reference {
        true => out,
        false => out.up_to_motions(),
    };
    (out, Setting { index, target })
}

const NO_LENGTHS: &str = "there are no two points between which a length is free: give bodies points, one of the body that stands and one of a body that moves, as \
     `ground = { G = [0, 0] }` and `crank = { P = [1, 0] }`";

const RIGID: &str =
    "the figure cannot move while all its dimensions stand still: set one free with `--free NAME`";

/// That there is no motion, and why.
fn rigid(problem: &Problem, fault: Option<String>) -> String {
    match fault {
        _ if problem.check().is_ok() && problem.is_distances_only() => RIGID.to_owned(),
        _ if problem.check().is_ok() => {
            "with the dimensions that stand still there are as many equations as unknowns, and a motion is followed with one less: set one more free with \
             `--free NAME`; a loop that moves for all that, as Bennett's, is followed by `krawl limits` and `krawl sweep`, which leave out what follows \
             from the rest"
                .to_owned()
        }
        Some(fault) => format!(
            "a motion is of a figure with one degree of freedom, all of whose constraints are needed. It could not be set in motion as it is drawn: \
             where constraints of joints follow from each other, as in loops of hinges, see `krawl limits` and `krawl sweep`, which leave these out; if it is \
             at a dead centre draw it a little bent, and if it is far from its dimensions nearer to them. With one more length given: {fault}"
        ),
        None => "as it is drawn no length begins to change: if it is at a dead centre, with points on one line, draw it a little bent".to_owned(),
    }
}

/// Whether a quantity is not the same in all frames.
fn changes(frames: &[Frame], quantity: &Quantity) -> bool {
    let mut values = frames.iter().map(|of| quantity.of(&of.points, &of.objects));
    let first = values.next().unwrap_or(Interval::ENTIRE);
    let common = values.try_fold(first, |common, value| {
        let both = common.intersection(value);
        (!both.is_empty()).then_some(both)
    });
    common.is_none()
}

/// Figures at equal lengths of the path.
fn frames(round: &Round) -> Vec<Frame> {
    let (start, end) = (round.trace.start(), round.trace.length());
    let place = |k: usize| start + (end - start) * (k as f64 / (FRAMES - 1) as f64);
    let frames = (0..FRAMES).filter_map(|k| {
        let here = round.trace.place_at(place(k))?;
        let points = round.in_problem(&here.points());
        let unknown = |i: usize| here.entry_in_middle(i);
        Some(Frame {
            at: place(k),
            objects: round.homotopy().locate(&points, &unknown),
            points,
        })
    });
    frames.collect()
}
