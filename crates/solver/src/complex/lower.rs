//! The complex system of a problem.

use super::bound::{self, Bound};
use super::exact::{Exact, zero};
use super::infinity::Graph;
use super::system::{Equation, Kind, Start, System, Unknown};
use super::{lines, own_frame};
use crate::constraint::MAX_DEGREE;
use crate::equations::Form;
use crate::interval::Real;
use crate::places::array;
use crate::problem::{Object, Problem, Shape, Target, list};
use crate::rational::Rational;
use crate::system::{GaugeError, Homotopy, Term};

/// Why a problem has no complex system.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum Unserved {
    /// The sketch cannot be seen from the reference.
    #[error(transparent)]
    Gauge(#[from] GaugeError),
    /// Something else, in words.
    #[error("{0}")]
    Other(String),
}

crate::debug_in_words!(Unserved);

/// A problem's complex system, and a bound on the number of its solutions up to rotation where one is known. (In a frame of
/// the problem's own no two solutions are the same up to rotation, and the bound is on their number.)
#[derive(Debug, Clone, Default)]
pub struct Lowered {
    /// The system.
    pub system: System,
    /// The bound.
    pub bound: Option<Bound>,
    /// The points that stand on places of their own, where the problem has distances only.
    pub placed: Option<Vec<usize>>,
    /// The distances, where figures at infinity can be told and counted.
    pub graph: Option<Graph>,
}

impl Lowered {
    /// Whether it is a problem of unknown numbers alone.
    pub fn is_of_numbers(&self) -> bool {
        self.system.points.is_empty()
    }

    /// Takes a bound on the number of solutions, up to rotation unless the frame is the problem's own, that somebody cites, unless a smaller one is proved.
    pub fn cite(&mut self, count: u128) {
        if self.bound.as_ref().is_some_and(|own| own.count <= count) {
            return;
        }
        self.bound = Some(Bound {
            count,
            source: "the bound that you cite".to_owned(),
            counts_curves: false,
            is_cited: true,
            fixed: Vec::new(),
        });
    }

    /// The number of orbits under the system's group that the bound allows, for instances of which no solution is
    /// its own image.
    pub fn enough(&self) -> Option<usize> {
        let bound = usize::try_from(self.bound.as_ref()?.count).ok()?;
        match self.system.group.iter().any(|signs| signs.mirrors) {
            true => (bound % 2 == 0).then_some(bound / 2),
            false => Some(bound),
        }
    }
}

/// Most real unknowns: the trackers keep square matrices of them.
const MOST: usize = 400;

/// Makes the complex system of a checked problem.
pub fn lower(problem: &Problem) -> Result<Lowered, Unserved> {
    in_a_frame(problem).unwrap_or_else(|| checked(general(problem, true)?))
}

/// Makes the complex system of a checked problem as a template has it, if it has the problem's equations in one of the frames that these
/// can be told in; otherwise in the best frame.
pub fn lower_for(problem: &Problem, template: &str) -> Result<Lowered, Unserved> {
    let frames = lines::frames(problem);
    if frames.is_empty() {
        return lower(problem);
    }
    let wanted = super::template::structure_of(template);
    let mut systems = frames
        .into_iter()
        .filter_map(|frame| lines::lower(problem, frame));
    let fitting = systems.find(|system| wanted.as_ref() == Some(&system.structure()));
    fitting.map_or_else(|| lower(problem), |system| checked(without_bound(system)))
}

/// Makes the complex system of a checked problem with an equation for the square of every distance, those of the
/// reference too: then all coefficients of a problem of distances are ratios. Where it can be, it is that of the unknowns of
/// real paths, seen from the problem's own reference.
pub fn lower_in_squares(problem: &Problem) -> Result<Lowered, Unserved> {
    let own = general(problem, false).and_then(checked);
    own.or_else(|unserved| in_a_frame(problem).unwrap_or(Err(unserved)))
}

/// In a frame that lines of their own make, if there is one.
fn in_a_frame(problem: &Problem) -> Option<Result<Lowered, Unserved>> {
    let frame = lines::frames(problem).into_iter().next()?;
    let system = lines::lower(problem, frame)?;
    Some(checked(without_bound(system)))
}

fn without_bound(system: System) -> Lowered {
    Lowered {
        system,
        ..Lowered::default()
    }
}

/// What is not too large.
fn checked(lowered: Lowered) -> Result<Lowered, Unserved> {
    let unknowns = 2 * lowered.system.unknowns.len();
    if unknowns > MOST {
        return Err(Unserved::Other(format!(
            "there are {unknowns} real unknowns, and at most {MOST} are served"
        )));
    }
    Ok(lowered)
}

/// From the equations that real paths follow.
fn general(problem: &Problem, placed: bool) -> Result<Lowered, Unserved> {
    let mut problem = problem.clone();
    let mut bound = None;
    if problem.is_distances_only() {
        let edges: Vec<[usize; 2]> = problem.distances.iter().map(|d| d.points).collect();
        bound = bound::bound(problem.dimension, problem.points.len(), &edges);
        // The figure stands on what the bound holds fixed.
        if let Some(bound) = bound.as_ref().filter(|_| placed) {
            let mut placed = problem.clone();
            placed.homotopy.reference = bound.fixed.clone();
            if Homotopy::new(&placed).is_ok() {
                problem = placed;
            }
        }
    }
    let homotopy = Homotopy::new(&problem)?;
    if let Some(name) = constrained_sign(&homotopy) {
        return Err(Unserved::Other(format!(
            "complex solutions have no signs, and {name} must be positive"
        )));
    }
    let is_absolute = problem.is_absolute();
    if is_absolute {
        own_frame::check(&problem, &homotopy)?;
    }
    let n = homotopy.equations;
    let places = homotopy.gauge.place.len();
    let d = homotopy.dimension;
    let unknowns = (0..n).map(|k| {
        let (name, power) = match homotopy.gauge.place.get(k) {
            Some(place) => {
                let axis = ["x", "y", "z"][place % d];
                (format!("{axis} of {}", problem.points[place / d].name), 1)
            }
            None => {
                let unknown = &homotopy.tail.unknowns[k - places];
                (unknown.name.clone(), unknown.power)
            }
        };
        Unknown {
            name,
            power,
            flips: array(|axis| !is_absolute && axis < d && homotopy.flips(k, axis)),
        }
    });
    let unknowns = unknowns.collect();
    let head = homotopy.edges.len();
    let equations = (0..n).map(|e| {
        let (power, right) = match problem.distances.get(e) {
            Some(distance) if e < head => (
                2,
                Kind::Parameter([half_square(&distance.target), Real::zero()]),
            ),
            _ => {
                let equation = &homotopy.tail.equations[e - head];
                // An equation of one's own may have anything on the right.
                let is_own = problem.constraints.iter().any(|constraint| {
                    let text = constraint.formula.as_ref().map(|formula| &formula.text);
                    text == Some(&equation.name)
                });
                let is_place = is_absolute && own_frame::is_place(equation);
                let right = match is_own || is_place {
                    true => dimension(&equation.right),
                    false => right_of(&equation.right),
                };
                (equation.power, right)
            }
        };
        Equation {
            name: homotopy.names[e].clone(),
            terms: homotopy.terms(e),
            power,
            right: in_unit(right, homotopy.unit, power),
            bows: true,
        }
    });
    let mut equations: Vec<Equation> = equations.collect();
    let points = (0..problem.points.len())
        .map(|p| array(|axis| homotopy.coordinate(p, axis)))
        .collect();
    let (mut start, mut positions) = (Start::Any, 1);
    if let Some(bound) = bound
        .as_ref()
        .filter(|bound| bound.fixed == problem.homotopy.reference)
        && placed
        && let Some(unknowns) = place(&problem, &homotopy, &bound.fixed, &mut equations)
    {
        start = Start::Placed(unknowns, if d == 2 { 1 } else { 3 });
        // The signs of the reference's coordinates.
        positions = if d == 2 { 2 } else { 4 };
    }
    let names = problem
        .homotopy
        .reference
        .iter()
        .map(|&p| problem.points[p].name.as_str());
    let names: Vec<&str> = names.collect();
    let Some(turns) = homotopy.twins() else {
        return Err(Unserved::Other(
            "there are too many lines and planes with directions of their own".to_owned(),
        ));
    };
    let system = System {
        dimension: d,
        unknowns,
        equations,
        points,
        unit: homotopy.unit,
        start,
        positions,
        is_absolute,
        nonzero: nonzero(&homotopy),
        gauge: match d {
            _ if is_absolute => "the coordinates of the file".to_owned(),
            2 => format!("{} at the origin, {} on the x axis", names[0], names[1]),
            _ => format!(
                "{} at the origin, {} on the x axis, {} in the xy plane",
                names[0], names[1], names[2]
            ),
        },
        ..System::default()
    }
    .with_groups(&turns);
    if is_absolute {
        own_frame::check_directions(&system, &problem, &homotopy)?;
    }
    let of_numbers = |object: &Object| matches!(object.shape, Shape::Number { .. });
    if problem.points.is_empty() && problem.objects.iter().all(of_numbers) {
        bound = bound::of_equations(&system);
    }
    // The bound is about figures that stand on what it holds fixed.
    let bound = bound.filter(|bound| {
        bound.fixed == problem.homotopy.reference
            && (problem.points.is_empty() || is_proper(&problem, &bound.fixed))
    });
    let graph = bound
        .as_ref()
        .filter(|_| problem.is_distances_only())
        .and_then(|bound| Graph::new(&problem, &bound.fixed, system.unit));
    Ok(Lowered {
        graph,
        placed: matches!(system.start, Start::Placed(..))
            .then(|| problem.homotopy.reference.clone()),
        system,
        bound,
    })
}

/// The vectors that must not vanish in a figure.
fn nonzero(homotopy: &Homotopy) -> Vec<(String, Vec<[usize; 2]>)> {
    let names = homotopy.tail.nonzero.iter();
    let names = names.map(|vector| vector.name.clone());
    names.zip(homotopy.nonzero_vectors()).collect()
}

/// The distance between two points, by index.
fn edge(problem: &Problem, a: usize, b: usize) -> Option<usize> {
    let mut distances = problem.distances.iter();
    distances.position(|d| d.points == [a, b] || d.points == [b, a])
}

/// Of a triangle with these squares of its sides: twice the product of the first two sides as vectors from their common corner, and sixteen
/// times the squared area.
fn area(u: &Rational, v: &Rational, w: &Rational) -> (Rational, Rational) {
    let twice = u + v - w;
    let area = Rational::from_integer(4.into()) * u * v - &twice * &twice;
    (twice, area)
}

/// Makes the distances in the reference equations that say where it stands, instead of equations for squares: lengths
/// may then go anywhere and the figure never comes to a place where the gauge is singular. Returns the unknowns that
/// are the reference's coordinates.
///
/// `None`, and nothing is changed, where the reference is no proper triangle with real coordinates.
fn place(
    problem: &Problem,
    homotopy: &Homotopy,
    fixed: &[usize],
    equations: &mut [Equation],
) -> Option<[usize; 3]> {
    let edge = |a: usize, b: usize| edge(problem, a, b);
    let squared = |e: usize| problem.distances[e].target.squared();
    let mut put = |e: usize, unknown: usize, value: Real| {
        let per_unit = Rational::from_float(1.0 / homotopy.unit).expect("a power of two");
        let equation = &mut equations[e];
        equation.terms = vec![Term::new(
            2,
            Form::Difference(Some(unknown), None),
            Form::One,
        )];
        equation.power = 1;
        equation.right = Kind::Parameter([&value * &Real::from(per_unit), Real::zero()]);
        equation.bows = false;
    };
    match *fixed {
        [a, b] => {
            let ab = edge(a, b)?;
            let x = homotopy.coordinate(b, 0)?;
            put(ab, x, Real::from(squared(ab)).sqrt());
            Some([x; 3])
        }
        [a, b, c] => {
            let (ab, ac, bc) = (edge(a, b)?, edge(a, c)?, edge(b, c)?);
            let (u, v, w) = (squared(ab), squared(ac), squared(bc));
            let (twice, area) = area(&u, &v, &w);
            if !area.is_positive() || !u.is_positive() {
                return None;
            }
            let unknowns = [
                homotopy.coordinate(b, 0)?,
                homotopy.coordinate(c, 0)?,
                homotopy.coordinate(c, 1)?,
            ];
            let length = Real::from(u).sqrt();
            let below = &length * &Real::whole(2);
            put(ab, unknowns[0], length);
            put(ac, unknowns[1], &Real::from(twice) / &below);
            put(bc, unknowns[2], &Real::from(area).sqrt() / &below);
            Some(unknowns)
        }
        _ => None,
    }
}

/// The name of an unknown that is a length or a radius.
fn constrained_sign(homotopy: &Homotopy) -> Option<String> {
    let positive = homotopy.positive_unknowns();
    let places = homotopy.gauge.place.len();
    let names: Vec<&str> = positive
        .iter()
        .map(|&u| homotopy.tail.unknowns[u - places].name.as_str())
        .collect();
    (!names.is_empty()).then(|| list(&names, 3))
}

/// Whether a triangle with these sides is no degenerate one: no complex figure of it is isotropic.
fn is_proper(problem: &Problem, fixed: &[usize]) -> bool {
    let squared = |a: usize, b: usize| -> Option<Rational> {
        Some(problem.distances[edge(problem, a, b)?].target.squared())
    };
    let zero = Rational::zero();
    match *fixed {
        [a, b] => squared(a, b).is_some_and(|s| s != zero),
        [a, b, c] => {
            let (Some(u), Some(v), Some(w)) = (squared(a, b), squared(a, c), squared(b, c)) else {
                return false;
            };
            u != zero && area(&u, &v, &w).1 != zero
        }
        _ => false,
    }
}

/// Half the square of a target.
pub(super) fn half_square(target: &Target) -> Real {
    (target.squared() / Rational::from_integer(2.into())).into()
}

/// What a right-hand side is: zero throughout, or a dimension.
fn right_of(coefficients: &[Real]) -> Kind {
    assert!(coefficients.len() <= MAX_DEGREE + 1);
    if coefficients.iter().all(Real::is_zero) {
        return Kind::Fixed(Exact::zero());
    }
    dimension(coefficients)
}

/// A dimension, whatever it is.
fn dimension(coefficients: &[Real]) -> Kind {
    Kind::Parameter([at_target(coefficients), zero()[1].clone()])
}

/// What a right-hand side is at t = 1.
pub(super) fn at_target(coefficients: &[Real]) -> Real {
    coefficients.iter().fold(Real::zero(), |sum, c| &sum + c)
}

/// A right-hand side that is given in the problem's unit of length, in the system's, `unit`; `power`: the power of
/// the unit of length that it has.
pub(super) fn in_unit(right: Kind, unit: f64, power: i32) -> Kind {
    let Kind::Parameter(value) = right else {
        return right;
    };
    let per_unit = Rational::from_float(unit.powi(-power)).expect("a unit is a power of two");
    let per_unit = Real::from(per_unit);
    Kind::Parameter(value.map(|part| &part * &per_unit))
}
