//! The bend's coefficient where the user states none.

use super::{Decimal, Distance};

/// c is so much of the mean target length: docs/measured/tried.md has the measurements behind it.
const PART: f64 = 0.05;

/// Part of the mean target length, to six digits: the same path in any unit.
pub fn default_coefficient(distances: &[Distance]) -> Decimal {
    let lengths = distances.iter().map(|distance| distance.target.to_f64());
    let mean = lengths.sum::<f64>() / distances.len().max(1) as f64;
    // Without a distance nothing bends.
    if distances.is_empty() {
        return Decimal::from(0);
    }
    let text = format!("{:.5e}", PART * mean);
    // As people write it, where that is not long: the digits stay the same.
    let text = match text.parse::<f64>() {
        Ok(c) if (1e-4..1e6).contains(&c) => c.to_string(),
        _ => text,
    };
    text.parse().unwrap_or_else(|_| Decimal::from(0))
}

impl super::Problem {
    /// The bend that a problem has if its file names none: the last distance, by the default coefficient.
    pub fn bend_by_default(&mut self) {
        self.homotopy.bend = self.distances.len().saturating_sub(1);
        self.homotopy.bend_coefficient = default_coefficient(&self.distances);
    }
}

#[cfg(test)]
mod tests {
    use crate::problem::Problem;

    #[test]
    fn the_unit_does_not_matter() {
        let c = |power: i32| {
            let number = |x: &str| format!("{x}e{power}");
            let problem = Problem::build("triangle", 2)
                .point("a", [number("0").as_str(), "0"])
                .point("b", [number("4").as_str(), "0"])
                .point("c", [number("0.3").as_str(), number("3.1").as_str()])
                .distance("a", "b", number("4.1").as_str())
                .distance("b", "c", number("5.3").as_str())
                .distance("c", "a", number("3.07").as_str());
            problem.finish().unwrap().homotopy.bend_coefficient
        };
        let one = c(0);
        for power in [-3, 1, 3] {
            let scaled = format!("{}e{power}", one.to_f64()).parse().unwrap();
            assert_eq!(c(power), scaled);
        }
    }
}
