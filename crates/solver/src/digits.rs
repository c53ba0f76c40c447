//! Solutions to many digits: the same figures that a box of floats holds, in ratios.
//!
//! Newton's method with one inverse in floats gains as many digits in each step as that has; the last step is a test of Krawczyk, K = x − Y F(x) +
//! (I − Y F'(X)) (X − x) within X, in which F(x) is exact and F'(X) in intervals. What it finds is a figure of the problem, and where it lies in a
//! box that holds exactly one, it is that one.
//!
//! ```
//! use krawl::digits::to_digits;
//! use krawl::problem::Problem;
//! use krawl::track::prove;
//!
//! let text = "name = \"root\"\ndimension = 2\n[unknowns]\nx = 1\n[constraints]\nequations = [\"x^2 = 2\"]\n";
//! let problem = Problem::parse(text, "root.toml")?;
//! let run = prove(&problem)?;
//! let positive = run.solutions.iter().find(|s| s.objects[0].number().unwrap().inf() > 0.0).unwrap();
//! let found = to_digits(&problem, &positive.points, &positive.objects, 40)?;
//! assert_eq!(found.numbers[0], ("x".to_owned(), "1.414213562373095048801688724209698078570".to_owned()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::complex::{Lowered, SolutionBox};
use crate::elimination::invert;
use crate::interval::{Ball, Interval, enclose_rational, point};
use crate::order::each_once;
use crate::problem::{Decimal, Problem, Shape};
use crate::rational::Rational;
use crate::system::{Homotopy, Located, Right};
use num_bigint::BigInt;

/// More digits are not told: right-hand sides that are no ratios are known to some more.
pub const MOST_DIGITS: u32 = 60;
/// Unknowns are known to 2 to minus this at least, so that what is found lies in the solution's box.
const LEAST_BITS: i64 = 160;
/// No more are tried, for numbers that are small.
const MOST_BITS: i64 = 3000;
/// Newton's method takes no more steps: it gains some digits in each.
const STEPS: usize = 40;

const NOT_SQUARE: &str =
    "there are not as many equations as unknowns there: constraints were left out of the search";
const DEPENDENT: &str = "the equations are nearly dependent there";
const UNKNOWN: &str = "it is not known to so many digits";
const NOT_IN_ITS_BOX: &str = "it is not proved that the figure found lies in the solution's box, which is narrower than what is known of it, \
                              or holds another one";

/// A solution to many digits, each number off by at most 1 in its last.
#[derive(Debug, Clone, PartialEq)]
pub struct Digits {
    /// The coordinates of the points.
    pub points: Vec<Vec<String>>,
    /// Unknowns and radii, with their names.
    pub numbers: Vec<(String, String)>,
}

/// A solution of a problem, whose points are seen from its reference, to so many digits: of its largest coordinate, and as many behind the
/// point for all others; of each unknown and radius.
///
/// # Errors
/// In words, why it is not told: a figure with other objects, or one at which the equations are nearly dependent.
pub fn to_digits(
    problem: &Problem,
    points: &[[Interval; 3]],
    objects: &[Located],
    digits: u32,
) -> Result<Digits, String> {
    let square = |problem: &Problem| match problem.check() {
        Ok(()) => Homotopy::new(problem).map_err(|error| error.to_string()),
        Err(_) => Err(NOT_SQUARE.to_owned()),
    };
    let homotopy = square(problem)?;
    let sketch = points.iter().map(|at| at.map(middle));
    let drawn = square(&drawn(problem, sketch, objects)?)?;
    if drawn.equations != homotopy.equations {
        return Err("the solution is a special figure, with other equations".to_owned());
    }
    let near: Vec<f64> = drawn.sketch_of_unknowns().map(|x| x.mid()).collect();
    let mut numbers = Vec::new();
    for (object, located) in objects.iter().enumerate() {
        let name = &problem.objects[object].name;
        // A radius is the first unknown of its circle.
        if let (Some(known), Some(i)) = (located.number(), homotopy.object_unknowns(object).next())
        {
            numbers.push((name, i, known));
        }
    }
    let told = numbers.iter().map(|&(_, i, _)| i);
    let (x, behind) = to_all_digits(&homotopy, near, told, digits)?;
    // The box of the solution holds it.
    let is_in = |i: usize, known: Interval| lies_in(&x[i], known);
    let coordinates = points.iter().enumerate();
    let mut coordinates =
        coordinates.flat_map(|(p, at)| (0..problem.dimension).map(move |k| (p, k, at[k])));
    let are_in = coordinates.all(|(p, axis, known)| match homotopy.coordinate(p, axis) {
        Some(i) => is_in(i, known),
        None => known.contains(0.0),
    });
    if !are_in || !numbers.iter().all(|&(_, i, known)| is_in(i, known)) {
        return Err(NOT_IN_ITS_BOX.to_owned());
    }
    let enclosed = |i: usize| {
        let Ball { middle, radius } = &x[i];
        let both = [middle - radius, middle + radius].map(|end| enclose_rational(&end));
        both[0].convex_hull(both[1]) * point(homotopy.unit.powi(-homotopy.power(i)))
    };
    if !homotopy.is_proper_over(enclosed) {
        return Err("a length or a vector may vanish there".to_owned());
    }
    let value = |i: usize| x[i].middle.clone();
    let of_point = |p: usize| {
        let all = homotopy.place(p, value).into_iter().take(problem.dimension);
        all.map(|x| written(&x, behind)).collect()
    };
    Ok(Digits {
        points: (0..homotopy.points).map(of_point).collect(),
        numbers: numbers
            .into_iter()
            .map(|(name, i, _)| {
                let x = value(i);
                (name.clone(), written(&x, digits as i32 - places(&x.abs())))
            })
            .collect(),
    })
}

/// All unknowns in the unit of the problem, so well known that the decimals that are told of coordinates, and of the numbers that are
/// told by themselves, are off by at most 1 in their last digits; and how many of these coordinates have behind the point.
fn to_all_digits(
    homotopy: &Homotopy,
    near: Vec<f64>,
    told: impl Iterator<Item = usize> + Clone,
    digits: u32,
) -> Result<(Vec<Ball>, i32), String> {
    let unit = Rational::from_float(homotopy.unit).expect("a power of two");
    let ten = Rational::from_integer(10.into());
    let mut bits = LEAST_BITS.max(i64::from(digits) * 10 / 3 + 40);
    loop {
        let rights = homotopy.rights.iter().map(Right::ball_at_target).collect();
        let found = refined(homotopy, rights, &near, bits).ok_or(DEPENDENT)?;
        let scaled = found.into_iter().enumerate().map(|(i, x)| {
            let unit = unit.pow(homotopy.power(i));
            Ball {
                middle: x.middle * &unit,
                radius: x.radius * &unit,
            }
        });
        let x: Vec<Ball> = scaled.collect();
        let coordinates =
            (0..homotopy.equations).filter(|i| !homotopy.auxiliary_unknowns().contains(i));
        let largest = coordinates.clone().map(|i| x[i].middle.abs());
        let largest = largest.fold(Rational::zero(), |a, b| if a < b { b } else { a });
        let behind = digits as i32 - places(&largest);
        // A decimal is off by half a unit of its last digit, and the ratio by no more.
        let half = |behind: i32| Rational::new(1.into(), 2.into()) * ten.pow(-behind.max(0));
        let is_known = |i: usize, behind: i32| x[i].radius <= half(behind);
        let own = |i: usize| digits as i32 - places(&x[i].middle.abs());
        let is_zero = |i: usize| x[i].middle.is_zero() && !x[i].radius.is_zero();
        let mut told = told.clone();
        if coordinates.clone().all(|i| is_known(i, behind))
            && told.all(|i| !is_zero(i) && is_known(i, own(i)))
        {
            return Ok((x, behind));
        }
        bits *= 2;
        if bits > MOST_BITS {
            return Err(UNKNOWN.to_owned());
        }
    }
}

/// A complex solution to so many digits, each number with as many as the larger of its real and imaginary part; the real part alone of one that `is_real`,
/// proved.
///
/// # Errors
/// In words, why it is not told.
pub fn complex_to_digits(
    (problem, lowered): (&Problem, &Lowered),
    one: &SolutionBox,
    is_real: bool,
    digits: u32,
) -> Result<Digits, String> {
    let system = &lowered.system;
    let homotopy = system.homotopy();
    let unit = Rational::from_float(system.unit).expect("a power of two");
    let half = Rational::new(1.into(), 2.into());
    let ten = Rational::from_integer(10.into());
    let mut bits = LEAST_BITS.max(i64::from(digits) * 10 / 3 + 40);
    loop {
        let rights = system.target().into_iter().flatten();
        let rights = rights.map(|part| part.ball()).collect();
        let found = refined(&homotopy, rights, &one.figure.centre, bits).ok_or(DEPENDENT)?;
        if !found
            .iter()
            .zip(&one.parts)
            .all(|(ball, &known)| lies_in(ball, known))
        {
            return Err(NOT_IN_ITS_BOX.to_owned());
        }
        let told = |unknown: usize| {
            let unit = unit.pow(system.unknowns[unknown].power);
            let [re, im] = [0, 1].map(|part| &found[2 * unknown + part]);
            let radius = (if re.radius < im.radius { im } else { re }).radius.clone() * &unit;
            let [re, im] = [re, im].map(|part| &part.middle * &unit);
            let im = if is_real { Rational::zero() } else { im };
            let size = if re.abs() < im.abs() {
                im.abs()
            } else {
                re.abs()
            };
            let behind = digits as i32 - places(&size);
            let is_known = radius <= &half * ten.pow(-behind.max(0));
            let sign = if im.is_negative() { '-' } else { '+' };
            let has_size = radius.is_zero() || !size.is_zero();
            (is_known && has_size).then(|| match is_real {
                true => written(&re, behind),
                false => format!(
                    "{} {sign} {}i",
                    written(&re, behind),
                    written(&im.abs(), behind)
                ),
            })
        };
        let of_point = |place: &[Option<usize>; 3]| -> Option<Vec<String>> {
            let axes = place.iter().take(problem.dimension);
            axes.map(|axis| axis.map_or(Some("0".to_owned()), told))
                .collect()
        };
        let points: Option<_> = system.points.iter().map(of_point).collect();
        // What people named.
        let own = system.unknowns.iter().enumerate();
        let own = own.filter(|(_, unknown)| {
            let mut objects = problem.objects.iter();
            objects.any(|object| object.name == unknown.name)
        });
        let numbers = own.map(|(u, unknown)| Some((unknown.name.clone(), told(u)?)));
        if let (Some(points), Some(numbers)) = (points, numbers.collect()) {
            return Ok(Digits { points, numbers });
        }
        bits *= 2;
        if bits > MOST_BITS {
            return Err(UNKNOWN.to_owned());
        }
    }
}

/// Whether all that a number may be is in its range.
fn lies_in(Ball { middle, radius }: &Ball, known: Interval) -> bool {
    let [low, high] = [known.inf(), known.sup()].map(Rational::from_float);
    low.is_none_or(|low| low <= middle - radius) && high.is_none_or(|high| middle + radius <= high)
}

/// The middle of a range, as it is written.
pub(crate) fn middle(x: Interval) -> Decimal {
    Decimal::try_from(x.mid()).unwrap_or(Decimal::from(0))
}

/// The problem drawn as a solution, for where its unknowns are about.
pub(crate) fn drawn(
    problem: &Problem,
    points: impl Iterator<Item = [Decimal; 3]>,
    objects: &[Located],
) -> Result<Problem, String> {
    let mut drawn = problem.clone();
    for (point, at) in drawn.points.iter_mut().zip(points) {
        point.sketch = at;
    }
    for (object, located) in drawn.objects.iter_mut().zip(objects) {
        match (&mut object.shape, located.number()) {
            (Shape::Number { sketch, .. }, Some(number)) => *sketch = middle(number),
            (Shape::Round { radius, .. }, Some(number)) => *radius = middle(number),
            // What is told by points.
            (Shape::Line(_) | Shape::Plane(_) | Shape::Arc { .. }, _) => {}
            (Shape::Body { place: None, .. }, _) => {}
            _ => {
                return Err(format!(
                    "{} is a line, plane, body or joint with a place of its own",
                    object.name
                ));
            }
        }
    }
    Ok(drawn)
}

/// A zero of the equations with these right-hand sides near some numbers, in the homotopy's unit, each unknown known to about 2 to minus `bits`: exactly one zero
/// is as near as that. `None`: that is not proved, or not so well.
fn refined(homotopy: &Homotopy, rights: Vec<Ball>, near: &[f64], bits: i64) -> Option<Vec<Ball>> {
    let m = homotopy.equations;
    let terms: Vec<_> = (0..m).map(|e| homotopy.terms(e)).collect();
    let jacobian = |at: &dyn Fn(usize) -> Interval| -> Vec<Vec<Interval>> {
        (0..m).map(|e| homotopy.slopes(e, at)).collect()
    };
    let middle = jacobian(&|i| point(near[i]));
    let mut inverse: Vec<f64> = middle.iter().flatten().map(|x| x.mid()).collect();
    if !invert(&mut inverse, m) || inverse.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let mut x: Vec<Rational> = near
        .iter()
        .filter_map(|&x| Rational::from_float(x))
        .collect();
    // F(x), and the step −Y F(x) with how far right-hand sides that are no ratios leave it open.
    let missed = |x: &[Rational]| -> Vec<Rational> {
        let at = |entry: Option<usize>| entry.map_or_else(Rational::zero, |i| x[i].clone());
        let half = Rational::new(1.into(), 2.into());
        let of = |e: usize| {
            let products = terms[e].iter();
            let doubled = products.fold(Rational::zero(), |sum, p| {
                sum + Rational::from_integer(p.factor.into()) * p.value(at)
            });
            doubled * &half - &rights[e].middle
        };
        (0..m).map(of).collect()
    };
    let step = |missed: &[Rational]| -> Vec<(Rational, Rational)> {
        let row = |i: usize| {
            let mut sum = (Rational::zero(), Rational::zero());
            for e in 0..m {
                let y = Rational::from_float(inverse[i * m + e]).expect("a finite float");
                sum.0 -= &y * &missed[e];
                sum.1 += y.abs() * &rights[e].radius;
            }
            sum
        };
        (0..m).map(row).collect()
    };
    let least = Rational::one().shifted(-bits);
    let greatest = |steps: &[(Rational, Rational)]| {
        let sizes = steps.iter().map(|(step, open)| step.abs() + open);
        sizes.fold(Rational::zero(), |a, b| if a < b { b } else { a })
    };
    let mut steps = step(&missed(&x));
    for _ in 0..STEPS {
        if greatest(&steps) <= least {
            break;
        }
        for (x, (step, _)) in x.iter_mut().zip(&steps) {
            *x = (&*x + step).shifted(bits + 8).round().shifted(-bits - 8);
        }
        steps = step(&missed(&x));
    }
    // What F(x) leaves takes up half of the radius, and (I − Y F'(X)) (X − x) has to be less than the other half.
    let radius = Rational::from_integer(2.into()) * greatest(&steps) + &least;
    if radius > least.shifted(8) {
        return None;
    }
    let jacobian = jacobian(&|i| around(&x[i], &radius));
    let is_contracted = (0..m).all(|i| {
        let all = (0..m).map(|j| {
            let products = (0..m).map(|e| point(inverse[i * m + e]) * jacobian[e][j]);
            let product = products.fold(point(0.0), |sum, x| sum + x);
            point((point(f64::from(u8::from(i == j))) - product).mag())
        });
        all.fold(point(0.0), |sum, x| sum + x).sup() < 0.5
    });
    if !is_contracted {
        return None;
    }
    // What meets all equations exactly is the zero, and so is a number that alone meets an equation, of which it is the only one so near.
    let missed = missed(&x);
    let is_met = |e: usize| missed[e].is_zero() && rights[e].radius.is_zero();
    let is_zero = (0..m).all(is_met);
    let alone: Vec<usize> = (0..m)
        .filter(|&e| is_met(e))
        .filter_map(|e| {
            let entries = terms[e].iter().flat_map(|p| p.entries()).flatten();
            match each_once(entries)[..] {
                [i] => (!jacobian[e][i].contains(0.0)).then_some(i),
                _ => None,
            }
        })
        .collect();
    let balls = x.into_iter().enumerate().map(|(i, middle)| Ball {
        middle,
        radius: match is_zero || alone.contains(&i) {
            true => Rational::zero(),
            false => radius.clone(),
        },
    });
    Some(balls.collect())
}

/// All numbers as near to one as that.
fn around(x: &Rational, radius: &Rational) -> Interval {
    enclose_rational(&(x - radius)).convex_hull(enclose_rational(&(x + radius)))
}

/// How many digits a number that is not negative has before the point; less than 0 where it begins with zeros behind it. Of 0 it is 0.
fn places(x: &Rational) -> i32 {
    if x.is_zero() {
        return 0;
    }
    let ten = Rational::from_integer(10.into());
    let mut places = 0;
    while *x >= ten.pow(places) {
        places += 1;
    }
    while *x < ten.pow(places - 1) {
        places -= 1;
    }
    places
}

/// The decimal nearest to a ratio with so many digits behind the point, none if that is less than 0.
fn written(x: &Rational, behind: i32) -> String {
    let behind = behind.max(0);
    let scaled = x.abs() * Rational::from_integer(10.into()).pow(behind);
    let whole: BigInt = scaled.round().to_integer();
    let digits = format!("{whole:0>width$}", width = behind as usize + 1);
    let (before, after) = digits.split_at(digits.len() - behind as usize);
    let is_zero = digits.bytes().all(|digit| digit == b'0');
    let sign = if x.is_negative() && !is_zero { "-" } else { "" };
    match after {
        "" => format!("{sign}{before}"),
        after => format!("{sign}{before}.{after}"),
    }
}
