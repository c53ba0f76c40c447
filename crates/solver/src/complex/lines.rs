//! Three lines with the angles between any two, and points with their distances from each other and from the lines
//! (Durand, Hoffmann, *Variational Constraints in 3D*: three points, three lines).
//!
//! The angles fix the directions of the lines up to a mirror image. With the first line for the x axis, the second
//! through (0, 0, h) with the direction (c₂, s₂, 0), and the third through (f, g, 0) with the direction (c₃, a, b), what is
//! left are h, f, g and the points: a point at p has |p − q|² − ((p − q)·u)² = d² from the line through q with the unit
//! direction u. Nothing spurious: no unit tangents on both sides, no closest points.
//!
//! Where the first two lines are nearly parallel the z axis, on which both are met at right angles, is far from the figure, and
//! where the third is nearly parallel to the plane z = 0 so is its place there. So the two lines that are nearest to a right angle
//! come first, and the third may be told where it meets x = 0 or y = 0 instead ([`Frame`]).
//!
//! Where the lines are orthogonal their directions are the axes, and all equations have whole numbers for
//! coefficients. Otherwise c₂, s₂, c₃, a, b are unknowns with c₂ and c₃ the cosines wanted and |u₂|² = |u₃|² = 1, and so is
//! (p − q)·u for each point and line: a change of the angles then moves the directions along.

use super::exact::{Exact, Random};
use super::lower::{half_square, in_unit};
use super::system::{Equation, Kind, Start, System, Unknown};
use super::vector::Z;
use crate::constraint::is_opposite_nearer;
use crate::equations::Form;
use crate::interval::{DoubleDouble, Real};
use crate::order::InOrder;
use crate::places::{Each as _, array};
use crate::problem::{Item, Problem, Shape, Target};
use crate::rational::Rational;
use crate::system::Term;

/// Where the unknowns stand: coordinates of points first, then these.
const HEIGHT: usize = 0;
const FOOT: [usize; 2] = [1, 2];
/// c₂, s₂, c₃, a, b.
const DIRECTIONS: [usize; 5] = [3, 4, 5, 6, 7];

fn value(of: usize) -> Form<Option<usize>> {
    Form::Difference(Some(of), None)
}

/// Which line stands where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame {
    /// The objects that are the first, the second and the third line.
    lines: [usize; 3],
    /// The third line is told by its place where this coordinate is 0.
    across: usize,
    /// The third line's direction is the opposite of the sketch's, so that it has a positive component there.
    is_reversed: bool,
}

/// What the constraints say, if they are of these kinds.
struct Given {
    /// The cosines between the directions of the objects 0 and 1, 0 and 2, 1 and 2 in the sketch; `None` for right angles.
    cosines: [Option<Real>; 3],
    /// Half the squared distances of points from lines, with their names.
    distances: Vec<(usize, usize, Real, String)>,
}

fn given(problem: &Problem) -> Option<Given> {
    let are_lines = problem
        .objects
        .iter()
        .all(|o| matches!(o.shape, Shape::FreeLine { .. }));
    let is_alike = problem.dimension == 3 && problem.objects.len() == 3 && are_lines;
    if !is_alike || problem.is_absolute() {
        return None;
    }
    let mut cosines: [Option<Option<Real>>; 3] = [None, None, None];
    let mut distances = Vec::new();
    for (index, constraint) in problem.constraints.iter().enumerate() {
        match (constraint.kind.as_str(), constraint.items.as_slice()) {
            ("angles" | "perpendicular", &[Item::Object(a), Item::Object(b)]) => {
                let slot = slot(a, b)?;
                let cosine = constraint.value.as_ref().map(|degrees| {
                    // Of a cosine and the opposite one that to which the sketch comes nearer, as along paths. (Whether all three lines
                    // can be given directions between which all cosines are positive depends on it.)
                    let cosine = Real::cosine_of_degrees(degrees.value().clone());
                    match is_opposite_nearer(&product_in_sketch(problem, a, b), &cosine) {
                        true => -&cosine,
                        false => cosine,
                    }
                });
                let cosine = cosine.filter(|cosine| !cosine.is_zero());
                if cosines[slot].replace(cosine).is_some() {
                    return None;
                }
            }
            ("distances", items) => {
                let (point, line) = match *items {
                    [Item::Point(p), Item::Object(l)] | [Item::Object(l), Item::Point(p)] => (p, l),
                    _ => return None,
                };
                let target = Target::Length(constraint.value.clone()?);
                let name = problem.constraint_name(index);
                distances.push((point, line, half_square(&target), name));
            }
            _ => return None,
        }
    }
    let [Some(a), Some(b), Some(c)] = cosines else {
        return None;
    };
    let unknowns = 3 * problem.points.len() + 3;
    (problem.distances.len() + distances.len() == unknowns).then_some(Given {
        cosines: [a, b, c],
        distances,
    })
}

/// The product of the directions of two lines of their own in the sketch.
fn product_in_sketch(problem: &Problem, a: usize, b: usize) -> Rational {
    let direction = |object: usize| match &problem.objects[object].shape {
        Shape::FreeLine { direction, .. } => direction.each_ref().map(|x| x.value().clone()),
        _ => unreachable!("only lines of their own are asked for"),
    };
    let (u, v) = (direction(a), direction(b));
    u.iter().zip(&v).map(|(x, y)| x * y).sum()
}

/// Where the angle of two of three lines stands.
fn slot(a: usize, b: usize) -> Option<usize> {
    match (a.min(b), a.max(b)) {
        (0, 1) => Some(0),
        (0, 2) => Some(1),
        (1, 2) => Some(2),
        _ => None,
    }
}

/// The least sine of the angle between a line and the plane on which a frame has its place: where it is less, the place is more than a
/// thousand million times as far away as the line, or there is none.
const NOT_THERE: f64 = 1e-9;

/// The frames that a problem of this kind can be told in, the best one first; none if it is another. In a template's equations
/// the frame is the one that was best where it was made.
pub fn frames(problem: &Problem) -> Vec<Frame> {
    let Some(given) = given(problem) else {
        return Vec::new();
    };
    let are_orthogonal = given.cosines.iter().all(Option::is_none);
    let cosine = |a: usize, b: usize| {
        let cosine = slot(a, b).and_then(|slot| given.cosines[slot].as_ref());
        cosine.map_or(0.0, |cosine| cosine.enclose().mid())
    };
    let mut frames = Vec::new();
    for lines in [[0, 1, 2], [0, 2, 1], [1, 2, 0]] {
        let [c2, c3, c23]: [f64; 3] =
            [(0, 1), (0, 2), (1, 2)].each(|(a, b): (usize, usize)| cosine(lines[a], lines[b]));
        let s2 = (1.0 - c2 * c2).sqrt();
        let along = (c23 - c2 * c3) / s2;
        let up = (1.0 - c3 * c3 - along * along).max(0.0).sqrt();
        // The sign of the last component is not told.
        for (across, size) in [(2, up), (0, c3), (1, along)] {
            // Orthogonal lines are the axes.
            let is_there = s2 > NOT_THERE && size.abs() > NOT_THERE;
            if is_there && (across == 2 || !are_orthogonal) {
                let frame = Frame {
                    lines,
                    across,
                    is_reversed: size < 0.0,
                };
                frames.push((s2, size.abs(), frame));
            }
        }
    }
    // Whichever angle is smaller counts; sorting is stable.
    frames.order_by(|a, b| b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1)));
    frames.into_iter().map(|(.., frame)| frame).collect()
}

/// The system of a problem of this kind in a frame; `None` if it is another problem.
pub fn lower(problem: &Problem, frame: Frame) -> Option<System> {
    let given = given(problem)?;
    let Frame {
        lines,
        across,
        is_reversed,
    } = frame;
    let points = problem.points.len();
    let first = 3 * points;
    let are_orthogonal = given.cosines.iter().all(Option::is_none);
    let unit = unit(problem);
    let name = |k: usize| problem.objects[lines[k]].name.as_str();

    let mut unknowns = Vec::new();
    let mut push = |name: String, power: i32, flips: [bool; 3]| {
        unknowns.push(Unknown { name, power, flips });
    };
    let along = |axis: usize| array(|k| k == axis);
    for point in &problem.points {
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("{letter} of {}", point.name), 1, along(axis));
        }
    }
    push(format!("height of {}", name(1)), 1, along(2));
    let letters = ["x", "y", "z"];
    let in_plane: Vec<usize> = (0..3).filter(|&axis| axis != across).collect();
    for &axis in &in_plane {
        let (letter, zero) = (letters[axis], letters[across]);
        let what = format!("{letter} of {} where {zero} is 0", name(2));
        push(what, 1, along(axis));
    }
    // What changes its sign where the direction of the second line is reversed, or of the third.
    let mut turned = [Vec::new(), Vec::new()];
    if !are_orthogonal {
        let [c2, s2, c3, a, b] = DIRECTIONS.each(|k| first + k);
        turned = [vec![c2, s2], vec![c3, a, b]];
        // Reversing the x axis and the directions of all lines: s₂, a and b change their signs, not c₂ and c₃.
        let (c, s) = ([false; 3], [true, true, false]);
        push(format!("x of the direction of {}", name(1)), 0, c);
        push(format!("y of the direction of {}", name(1)), 0, s);
        push(format!("x of the direction of {}", name(2)), 0, c);
        push(format!("y of the direction of {}", name(2)), 0, s);
        push(
            format!("z of the direction of {}", name(2)),
            0,
            [true, false, true],
        );
    }
    let height = first + HEIGHT;
    let foot = FOOT.each(|k| first + k);
    let directions = DIRECTIONS.each(|k| first + k);
    let coordinate = |p: usize, axis: usize| 3 * p + axis;

    let mut equations: Vec<Equation> = Vec::new();
    for (index, distance) in problem.distances.iter().enumerate() {
        let [a, b] = distance.points;
        let square = |axis: usize| {
            let [a, b] = [a, b].each(|p| Some(coordinate(p, axis)));
            let form = Form::Difference(a, b);
            Term::new(1, form, form)
        };
        equations.push(Equation {
            name: problem.distance_name(index),
            terms: (0..3).map(square).collect(),
            power: 2,
            right: Kind::Parameter([half_square(&distance.target), Real::zero()]),
            bows: true,
        });
    }
    for (point, line, half, constraint) in &given.distances {
        let [x, y, z] = [0, 1, 2].each(|axis| coordinate(*point, axis));
        let which = lines.iter().position(|l| l == line)?;
        // The differences of the point from the line's place.
        let from = match which {
            0 => [value(x), value(y), value(z)],
            1 => [value(x), value(y), Form::Difference(Some(z), Some(height))],
            _ => {
                let mut from = [value(x), value(y), value(z)];
                for (&axis, foot) in in_plane.iter().zip(foot) {
                    from[axis] = Form::Difference(Some([x, y, z][axis]), Some(foot));
                }
                from
            }
        };
        let square = |form: Form<Option<usize>>| Term::new(1, form, form);
        let mut terms: Vec<Term> = match (which, are_orthogonal) {
            (0, _) => vec![square(from[1]), square(from[2])],
            (1, true) => vec![square(from[0]), square(from[2])],
            (_, true) => vec![square(from[0]), square(from[1])],
            _ => from.into_iter().map(square).collect(),
        };
        if which > 0 && !are_orthogonal {
            let shadow = unknowns.len();
            turned[which - 1].push(shadow);
            unknowns.push(Unknown {
                name: format!("{} along {}", problem.points[*point].name, name(which)),
                power: 1,
                // As x does, which is multiplied by what does not change.
                flips: [true, false, false],
            });
            terms.push(Term::new(-1, value(shadow), value(shadow)));
            let [c2, s2, c3, a, b] = directions.each(value);
            let of = match which {
                1 => vec![(c2, from[0]), (s2, from[1])],
                _ => vec![(c3, from[0]), (a, from[1]), (b, from[2])],
            };
            let mut defined = vec![Term::new(2, value(shadow), Form::One)];
            defined.extend(of.into_iter().map(|(u, v)| Term::new(-2, u, v)));
            equations.push(Equation {
                name: format!("{} along {}", problem.points[*point].name, name(which)),
                terms: defined,
                power: 1,
                right: Kind::Fixed(Exact::zero()),
                bows: false,
            });
        }
        equations.push(Equation {
            name: constraint.clone(),
            terms,
            power: 2,
            right: Kind::Parameter([half.clone(), Real::zero()]),
            bows: true,
        });
    }
    if !are_orthogonal {
        let [c2, s2, c3, a, b] = directions.each(value);
        let wanted = |a: usize, b: usize| {
            let cosine = slot(lines[a], lines[b]).and_then(|slot| given.cosines[slot].clone());
            let cosine = cosine.unwrap_or_else(Real::zero);
            match is_reversed && b == 2 {
                true => -&cosine,
                false => cosine,
            }
        };
        let mut add = |what: String, terms: Vec<Term>, right: Kind| {
            equations.push(Equation {
                name: what,
                terms,
                power: 0,
                right,
                bows: false,
            });
        };
        let angle = |a: usize, b: usize| format!("angle of {} and {}", name(a), name(b));
        let parameter = |a, b| Kind::Parameter([wanted(a, b), Real::zero()]);
        let half = Exact::whole(1).over(&Exact::whole(2))?;
        add(
            angle(0, 1),
            vec![Term::new(2, c2, Form::One)],
            parameter(0, 1),
        );
        add(
            angle(0, 2),
            vec![Term::new(2, c3, Form::One)],
            parameter(0, 2),
        );
        add(
            angle(1, 2),
            vec![Term::new(2, c2, c3), Term::new(2, s2, a)],
            parameter(1, 2),
        );
        add(
            format!("length of the direction of {}", name(1)),
            vec![Term::new(1, c2, c2), Term::new(1, s2, s2)],
            Kind::Fixed(half.clone()),
        );
        add(
            format!("length of the direction of {}", name(2)),
            vec![Term::new(1, c3, c3), Term::new(1, a, a), Term::new(1, b, b)],
            Kind::Fixed(half),
        );
    }
    assert_eq!(unknowns.len(), equations.len());
    for equation in &mut equations {
        let right = std::mem::replace(&mut equation.right, Kind::Fixed(Exact::zero()));
        equation.right = in_unit(right, unit, equation.power);
    }
    let system = System {
        dimension: 3,
        unknowns,
        equations,
        points: (0..points)
            .map(|p| [0, 1, 2].each(|axis| Some(coordinate(p, axis))))
            .collect(),
        unit,
        start: if are_orthogonal {
            Start::Any
        } else {
            Start::Lines(across)
        },
        positions: 1,
        gauge: format!(
            "{} is the x axis, {} meets the z axis at a right angle",
            name(0),
            name(1)
        ),
        ..System::default()
    };
    // Those that the equations of the instance do not allow are left out.
    let turn = |reversed: [bool; 2]| {
        let mut changes = vec![false; system.unknowns.len()];
        for (own, _) in turned.iter().zip(reversed).filter(|(_, turn)| *turn) {
            own.iter().for_each(|&u| changes[u] = true);
        }
        changes
    };
    let turns = [[false, false], [true, false], [false, true], [true, true]];
    let turns = turns.map(turn);
    Some(system.with_groups(&turns))
}

/// The frame that a system of this kind is in, if it is one.
pub fn frame_of(problem: &Problem, system: &System) -> Option<Frame> {
    let structure = system.structure();
    let mut frames = frames(problem).into_iter();
    frames.find(|&frame| {
        lower(problem, frame)
            .is_some_and(|other| other.gauge == system.gauge && other.structure() == structure)
    })
}

/// Points, and of each of the problem's lines a place on it and its direction of length 1.
pub type Figure = (Vec<[Z; 3]>, Vec<([Z; 3], [Z; 3])>);

/// The points and lines of a solution, of which real and imaginary part of every unknown are given in turn: in the system's
/// unit.
pub fn figure(system: &System, frame: Frame, at: &[DoubleDouble]) -> Figure {
    let Frame { lines, across, .. } = frame;
    let count = system.points.len();
    let unknown = |k: usize| Z::new(at[2 * k], at[2 * k + 1]);
    let (zero, one) = (Z::default(), Z::real(1.0));
    let points = (0..count).map(|p| [0, 1, 2].each(|axis| unknown(3 * p + axis)));
    let own = |k: usize| unknown(3 * count + k);
    let mut directions = match system.start {
        Start::Lines(_) => {
            let [c2, s2, c3, a, b] = DIRECTIONS.each(own);
            [[one, zero, zero], [c2, s2, zero], [c3, a, b]]
        }
        _ => [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
    };
    if frame.is_reversed {
        directions[2] = directions[2].each(|x| -x);
    }
    let mut foot = [zero; 3];
    let in_plane = (0..3).filter(|&axis| axis != across);
    for (axis, k) in in_plane.zip(FOOT) {
        foot[axis] = own(k);
    }
    let places = [[zero; 3], [zero, zero, own(HEIGHT)], foot];
    let of = |object: usize| {
        let role = lines.iter().position(|&line| line == object);
        let role = role.expect("each line has a role");
        (places[role], directions[role])
    };
    (points.collect(), (0..3).map(of).collect())
}

/// How long the direction of a line of its own is in the sketch.
pub fn length(problem: &Problem, object: usize) -> Option<DoubleDouble> {
    let Shape::FreeLine { direction, .. } = &problem.objects[object].shape else {
        return None;
    };
    let square: Rational = direction.iter().map(|x| x.value() * x.value()).sum();
    Some(Real::from(square).sqrt().double().0)
}

/// The power of two nearest to the mean length.
fn unit(problem: &Problem) -> f64 {
    let between = problem.distances.iter().map(|d| d.target.to_f64());
    let from_lines = problem.constraints.iter().filter(|c| c.kind == "distances");
    let from_lines = from_lines.filter_map(|c| Some(c.value.as_ref()?.to_f64()));
    let all: Vec<f64> = between.chain(from_lines).collect();
    let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
    2f64.powi(mean.log2().round() as i32)
}

/// Draws the directions of the lines, exactly of length 1: rational points on the circle and on the sphere.
pub fn draw(
    system: &System,
    across: usize,
    random: &mut Random,
    values: &mut [Option<Exact>],
) -> Option<()> {
    let first = 3 * system.points.len();
    let one = Exact::whole(1);
    // Real directions: real figures' cosines are then reached along a straight way on which the directions stay real and
    // independent, as convex sums of positive definite matrices are so. The first two are about at a right angle, and the
    // third at right angles to both, or, where its place is told in another plane, some 37° from that plane's normal.
    let m = one.plus(&random.nearly_whole());
    let square = m.times(&m);
    let below = one.plus(&square);
    let c2 = one.minus(&square).over(&below)?;
    let s2 = m.plus(&m).over(&below)?;
    let half = Exact::whole(1).over(&Exact::whole(2))?;
    let mut near = |axis: usize| {
        let small = random.nearly_whole();
        match across == axis {
            true => small.plus(&half),
            false => small,
        }
    };
    let (p, q) = (near(0), near(1));
    let square = p.times(&p).plus(&q.times(&q));
    let below = one.plus(&square);
    let b = one.minus(&square).over(&below)?;
    let c3 = p.plus(&p).over(&below)?;
    let a = q.plus(&q).over(&below)?;
    for (k, direction) in DIRECTIONS.into_iter().zip([c2, s2, c3, a, b]) {
        values[first + k] = Some(direction);
    }
    Some(())
}
