//! The polynomial system for other programs.

use super::system::{Kind, System};
use crate::interval::Real;
use crate::map::Map;
use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::One;

/// A program that reads systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Export {
    /// PHCpack: `phc -b`.
    PhcPack,
    /// Macaulay2.
    Macaulay2,
    /// msolve: exact, so all coefficients must be ratios.
    Msolve,
    /// HomotopyContinuation.jl.
    HomotopyContinuation,
    /// IBEX: `ibexsolve`. Real solutions in a box.
    Ibex,
    /// RealPaver. Real solutions in a box.
    RealPaver,
}

/// A polynomial of degree 2: coefficients by the unknowns of each monomial.
type Polynomial = Map<Vec<usize>, Real>;

/// Writes the system in the problem's unit of length, with the numbers of the instance. Solvers that search boxes get
/// unknowns from −`reach` to `reach`.
///
/// Fails where a coefficient is no ratio and the program takes no others.
pub fn export(system: &System, to: Export, reach: f64) -> Result<String, String> {
    let names = names(system);
    let mut polynomials = Vec::new();
    for e in 0..system.equations.len() {
        let mut text = String::new();
        for (monomial, coefficient) in polynomial(system, e) {
            let number = number(&coefficient, to).ok_or_else(|| {
                format!(
                    "the right-hand side of {} is no ratio, and msolve takes no other numbers",
                    system.equations[e].name
                )
            })?;
            let product = product(&monomial, &names);
            let (sign, size) = match number.strip_prefix('-') {
                Some(size) => ("-", size),
                None if text.is_empty() => ("", number.as_str()),
                None => ("+", number.as_str()),
            };
            text += sign;
            text += &match (size, product.is_empty()) {
                (_, true) => size.to_owned(),
                ("1", false) => product,
                (_, false) => format!("{size}*{product}"),
            };
        }
        polynomials.push(text);
    }
    let all = names.join(", ");
    let joined = |between: &str| polynomials.join(between);
    let n = names.len();
    let boxes = |between: &str| {
        let one = |name: &String| format!("  {name} in [-{reach}, {reach}]");
        names.iter().map(one).collect::<Vec<_>>().join(between)
    };
    Ok(match to {
        Export::PhcPack => format!("{n}\n{};\n", joined(";\n")),
        Export::Macaulay2 => format!("R = QQ[{all}]\nI = ideal(\n{}\n)\n", joined(",\n")),
        Export::Msolve => format!("{all}\n0\n{}\n", joined(",\n")),
        Export::HomotopyContinuation => format!(
            "using HomotopyContinuation\n@var {}\nF = System([\n{}\n])\nresult = solve(F)\n",
            names.join(" "),
            joined(",\n")
        ),
        Export::Ibex => {
            let lines = polynomials.iter().map(|p| format!("  {p} = 0;\n"));
            let equations: String = lines.collect();
            format!(
                "variables\n{};\nconstraints\n{equations}end\n",
                boxes(";\n")
            )
        }
        Export::RealPaver => {
            let lines: Vec<String> = polynomials.iter().map(|p| format!("  {p} = 0")).collect();
            format!(
                "Variables\n{};\nConstraints\n{};\n",
                boxes(",\n"),
                lines.join(",\n")
            )
        }
    })
}

/// Where the points are in the unknowns of an exported system, point by point in the problem's order: its coordinates, each an unknown or
/// 0; what the frame is stands ahead.
pub fn places(system: &System, points: &[String]) -> String {
    let names = names(system);
    let mut text = format!("{}\n", system.gauge);
    for (place, point) in system.points.iter().zip(points) {
        let coordinate = |k: &Option<usize>| k.map_or("0", |k| names[k].as_str());
        let place: Vec<&str> = place[..system.dimension].iter().map(coordinate).collect();
        text += &format!("{point} = ({})\n", place.join(", "));
    }
    let is_of_a_point = |k: &usize| {
        system
            .points
            .iter()
            .flatten()
            .any(|place| *place == Some(*k))
    };
    for (k, unknown) in system.unknowns.iter().enumerate() {
        if !is_of_a_point(&k) {
            text += &format!("{} is {}\n", names[k], unknown.name);
        }
    }
    text
}

/// `x4` for the first coordinate of the fourth point; other unknowns are `u1`, `u2`, ...
fn names(system: &System) -> Vec<String> {
    let mut names = vec![String::new(); system.unknowns.len()];
    for (p, place) in system.points.iter().enumerate() {
        for (unknown, letter) in place.iter().zip(["x", "y", "z"]) {
            if let Some(unknown) = unknown {
                names[*unknown] = format!("{letter}{}", p + 1);
            }
        }
    }
    let mut others = 0;
    for name in names.iter_mut().filter(|name| name.is_empty()) {
        others += 1;
        *name = format!("u{others}");
    }
    names
}

/// Twice the left-hand side less the right one, or half that where all coefficients stay whole.
fn polynomial(system: &System, equation: usize) -> Polynomial {
    let equation = &system.equations[equation];
    let terms = equation.terms.iter();
    let sums = Map::sums(terms.flat_map(|term| term.multiplied_out()));
    let whole = |(m, c): (Vec<usize>, i32)| (m, Real::whole(c.into()));
    let mut polynomial: Polynomial = sums.into_iter().map(whole).collect();
    let unit = Rational::from_float(system.unit.powi(equation.power)).expect("a power of two");
    let right = match &equation.right {
        Kind::Parameter([re, _]) => re * &Real::from(unit),
        Kind::Fixed(value) => value.re.clone().into(),
    };
    if !right.is_zero() {
        polynomial.insert(Vec::new(), &right * &Real::whole(-2));
    }
    polynomial
}

fn product(monomial: &[usize], names: &[String]) -> String {
    match monomial {
        [] => String::new(),
        [a] => names[*a].clone(),
        [a, b] if a == b => format!("{}^2", names[*a]),
        [a, b, ..] => format!("{}*{}", names[*a], names[*b]),
    }
}

/// A coefficient as the program reads it: exactly if it is a ratio, otherwise with thirty digits.
fn number(value: &Real, to: Export) -> Option<String> {
    if let Some(ratio) = value.as_rational() {
        if ratio.denom().is_one() {
            return Some(ratio.numer().to_string());
        }
        let between = if to == Export::HomotopyContinuation {
            "//"
        } else {
            "/"
        };
        return Some(format!("{}{between}{}", ratio.numer(), ratio.denom()));
    }
    if to == Export::Msolve {
        return None;
    }
    const DIGITS: u32 = 30;
    let scale = BigInt::from(10).pow(DIGITS);
    let middle = value.ball().middle;
    let scaled = (middle.abs() * Rational::from_integer(scale.clone()))
        .round()
        .to_integer();
    let sign = if middle.is_negative() { "-" } else { "" };
    let (whole, part) = (&scaled / &scale, &scaled % &scale);
    if to == Export::Macaulay2 {
        // Over the rational numbers, the nearest one with so many digits.
        return Some(format!("{sign}{scaled}/{scale}"));
    }
    Some(format!("{sign}{whole}.{part:0>30}"))
}

#[cfg(test)]
mod tests {
    use super::super::exact::{Exact, Random};
    use super::super::lower::{lower, lower_in_squares};
    use super::super::start::draw;
    use super::*;
    use crate::problem::Problem;

    #[test]
    fn expanded_polynomials_are_the_equations() {
        for (name, lower) in [
            ("octahedron", lower_in_squares as fn(&Problem) -> _),
            ("k33", lower_in_squares),
            // In a frame of lines, in which figures can be drawn.
            ("constraints/3p3l", lower),
            ("constraints/pentahedron", lower_in_squares),
        ] {
            let path = format!("{}/../../problems/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let system = lower(&Problem::read(path).unwrap()).unwrap().system;
            let figure = draw(&system, &mut Random::new(4)).unwrap();
            for e in 0..system.equations.len() {
                let mut sum = Exact::zero();
                for (monomial, coefficient) in polynomial(&system, e) {
                    let Some(ratio) = coefficient.as_rational().filter(|_| !monomial.is_empty())
                    else {
                        continue;
                    };
                    let scale = Exact::real(ratio.clone());
                    let value = monomial
                        .iter()
                        .fold(scale, |p, &u| p.times(&figure.values[u]));
                    sum = sum.plus(&value);
                }
                assert_eq!(
                    sum,
                    system.evaluate(e, |u| figure.values[u].clone()),
                    "{name} {e}"
                );
            }
        }
    }
}
