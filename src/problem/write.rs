//! Writing problem files.

use super::{Decimal, Distance, Problem, Target};
use std::fmt::Write;

impl Problem {
    /// The problem as the text of a file, which [`Problem::parse`] reads back as an equal one.
    ///
    /// A file lists lengths before squared lengths. A problem built by hand that mixes them comes
    /// back with its distances in that order; those from [`Problem::build`] and from files have
    /// it already.
    ///
    /// ```
    /// # use krawl::problem::Problem;
    /// # let problem = Problem::build("bar", 2).point("a", [0, 0]).point("b", [1, 0])
    /// #     .distance("a", "b", 2).finish().unwrap();
    /// let again = Problem::parse(&problem.to_toml(), "again.toml").unwrap();
    /// assert_eq!(again, problem);
    /// ```
    pub fn to_toml(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_toml(&mut out);
        out
    }

    fn write_toml(&self, out: &mut String) -> std::fmt::Result {
        let name = |p: usize| quoted(&self.points[p].name);
        writeln!(out, "name = {}", quoted(&self.name))?;
        writeln!(out, "dimension = {}", self.dimension)?;
        if !self.source.is_empty() {
            writeln!(out, "source = {}", quoted(&self.source))?;
        }
        writeln!(out, "\n[points]")?;
        for point in &self.points {
            let coordinates = point.sketch.iter().take(self.dimension).map(number);
            let coordinates = coordinates.collect::<Vec<_>>().join(", ");
            let key = toml_edit::Key::new(&point.name);
            writeln!(out, "{key} = [{coordinates}]")?;
        }
        writeln!(out, "\n[constraints]")?;
        let is_length = |d: &&Distance| matches!(d.target, Target::Length(_));
        for (key, lengths) in [("distances", true), ("squared_distances", false)] {
            let mut distances = self
                .distances
                .iter()
                .filter(|d| is_length(d) == lengths)
                .peekable();
            if distances.peek().is_none() {
                continue;
            }
            writeln!(out, "{key} = [")?;
            for distance in distances {
                let [a, b] = distance.points.map(name);
                let (Target::Length(target) | Target::SquaredLength(target)) = &distance.target;
                writeln!(out, "    [{a}, {b}, {}],", number(target))?;
            }
            writeln!(out, "]")?;
        }
        let homotopy = &self.homotopy;
        let reference = homotopy.reference.iter().map(|&p| name(p));
        writeln!(out, "\n[homotopy]")?;
        writeln!(
            out,
            "reference = [{}]",
            reference.collect::<Vec<_>>().join(", ")
        )?;
        if let Some(bend) = self.distances.get(homotopy.bend) {
            let [a, b] = bend.points.map(name);
            writeln!(out, "bend = [{a}, {b}]")?;
        }
        writeln!(
            out,
            "bend_coefficient = {}",
            number(&homotopy.bend_coefficient)
        )
    }
}

fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}

/// The same decimal in TOML's grammar for floats: a digit on either side of the point, no zeros
/// in front.
fn number(decimal: &Decimal) -> String {
    let text = decimal.text();
    let (sign, unsigned) = match text.strip_prefix('-') {
        Some(unsigned) => ("-", unsigned),
        None => ("", text.strip_prefix('+').unwrap_or(text)),
    };
    let (mantissa, exponent) = match unsigned.find(['e', 'E']) {
        Some(at) => (&unsigned[..at], format!("e{}", &unsigned[at + 1..])),
        None => (unsigned, String::new()),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let or_zero = |digits: &str| {
        if digits.is_empty() {
            "0".to_owned()
        } else {
            digits.to_owned()
        }
    };
    let whole = or_zero(whole.trim_start_matches('0'));
    format!("{sign}{whole}.{}{exponent}", or_zero(fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_toml() {
        for (text, written) in [
            ("1.12", "1.12"),
            ("+.25", "0.25"),
            ("-3.", "-3.0"),
            ("007", "7.0"),
            ("00.5E-3", "0.5e-3"),
            ("1e5", "1.0e5"),
            ("0e0", "0.0"),
        ] {
            let decimal: Decimal = text.parse().unwrap();
            assert_eq!(number(&decimal), written);
            assert_eq!(written.parse::<Decimal>().unwrap(), decimal);
        }
    }
}
