//! Systems written for other programs, read back: krawl's own solutions are zeros of them, in every format.

use crate::common::shipped;
use krawl::complex::{Export, export, lower_in_squares, places};
use krawl::track::{Control, Options, solve};
use std::collections::HashMap;

/// The polynomials of a system in one of the formats.
fn polynomials(text: &str, to: Export) -> Vec<String> {
    let between = |from: &str, until: &str| {
        let start = text.find(from).unwrap() + from.len();
        text[start..start + text[start..].find(until).unwrap()].to_owned()
    };
    let (body, separator) = match to {
        Export::PhcPack => (text.split_once('\n').unwrap().1.to_owned(), ";"),
        Export::Macaulay2 => (between("ideal(\n", "\n)"), ","),
        Export::Msolve => (text.splitn(3, '\n').nth(2).unwrap().to_owned(), ","),
        Export::HomotopyContinuation => (between("System([\n", "\n])"), ","),
        Export::Ibex => (between("constraints\n", "end"), ";"),
        Export::RealPaver => (between("Constraints\n", ";"), ","),
    };
    let all = body
        .split(separator)
        .map(|p| p.trim().trim_end_matches("= 0").trim().to_owned());
    all.filter(|p| !p.is_empty()).collect()
}

/// What a polynomial is at these values, and the sum of the sizes of its terms.
fn value(polynomial: &str, values: &HashMap<String, f64>) -> (f64, f64) {
    let number = |text: &str| match text.split_once('/') {
        Some((above, below)) => {
            above.parse::<f64>().unwrap() / below.trim_start_matches('/').parse::<f64>().unwrap()
        }
        None => text.parse().unwrap(),
    };
    let factor = |text: &str| match text.split_once('^') {
        Some((name, power)) => values[name].powi(power.parse().unwrap()),
        None => values.get(text).copied().unwrap_or_else(|| number(text)),
    };
    let spaced = polynomial.replace('-', " -").replace('+', " ");
    let (mut sum, mut size) = (0.0, 0.0);
    for term in spaced.split_whitespace() {
        let (sign, term) = match term.strip_prefix('-') {
            Some(term) => (-1.0, term),
            None => (1.0, term),
        };
        let product: f64 = term.split('*').map(factor).product();
        sum += sign * product;
        size += product.abs();
    }
    (sum, size)
}

#[test]
fn krawls_solutions_are_zeros_of_exported_systems() {
    let mut tried = 0;
    for name in [
        "octahedron",
        "k33",
        "disulfide",
        "constraints/pentahedron",
        "constraints/3p3l",
        "constraints/6p7d3a2c-closed",
    ] {
        let mut problem = shipped(name);
        // Another reference than the one that krawl would take, where there is a choice.
        for turn in 0..2 {
            if turn == 1 {
                problem.homotopy.reference.reverse();
                if problem.check().is_err() || problem.homotopy.reference.is_empty() {
                    continue;
                }
            }
            let Ok(lowered) = lower_in_squares(&problem) else {
                continue;
            };
            let outcome = solve(&problem, &Options::certified(), &mut Control::default()).unwrap();
            let names: Vec<String> = problem.points.iter().map(|p| p.name.clone()).collect();
            let said = places(&lowered.system, &names);
            for solution in &outcome.solutions {
                let mut values = HashMap::new();
                for (p, place) in solution.points.iter().enumerate() {
                    for (k, letter) in ["x", "y", "z"].iter().enumerate() {
                        values.insert(format!("{letter}{}", p + 1), place[k].mid());
                    }
                }
                let system = &lowered.system;
                let is_of_a_point =
                    |k: &usize| system.points.iter().flatten().any(|p| *p == Some(*k));
                let others = (0..system.unknowns.len()).filter(|k| !is_of_a_point(k));
                for (k, (other, unknown)) in others.zip(&solution.auxiliary).enumerate() {
                    let scale = system.unit.powi(system.unknowns[other].power);
                    values.insert(format!("u{}", k + 1), scale * unknown.mid());
                }
                // What is said to be 0 is.
                for (line, place) in said.lines().skip(1).zip(&solution.points) {
                    let inside = line.split_once(" = (").unwrap().1.trim_end_matches(')');
                    for (word, x) in inside.split(", ").zip(place) {
                        let at = values.get(word).copied().unwrap_or(0.0);
                        assert_eq!(at, x.mid(), "{name}: {line}");
                    }
                }
                for to in [
                    Export::PhcPack,
                    Export::Macaulay2,
                    Export::Msolve,
                    Export::HomotopyContinuation,
                    Export::Ibex,
                    Export::RealPaver,
                ] {
                    let Ok(text) = export(&lowered.system, to, 100.0) else {
                        assert_eq!(to, Export::Msolve, "{name}");
                        continue;
                    };
                    let all = polynomials(&text, to);
                    assert_eq!(all.len(), lowered.system.equations.len(), "{name}: {text}");
                    for polynomial in all {
                        let (sum, size) = value(&polynomial, &values);
                        assert!(
                            sum.abs() <= 1e-10 * size.max(1e-3),
                            "{name} {to:?}: {polynomial} is {sum}"
                        );
                        tried += 1;
                    }
                }
            }
        }
    }
    assert!(tried > 2000, "{tried}");
}
