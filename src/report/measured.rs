//! What is measured of figures: lengths, angles, coordinates, areas and numbers of objects that no constraint has to give.

use super::certain_digits;
use super::document::Measured;
use crate::interval::Interval;
use crate::problem::Problem;
use crate::system::{Located, Quantity};

/// A figure: enclosures of its points, and where its objects are.
pub type Placed<'f> = (&'f [[Interval; 3]], &'f [Located]);

/// What is measured of each figure of a problem.
#[derive(Debug, Clone, Default)]
pub struct Measures {
    all: Vec<Quantity>,
}

impl Measures {
    /// From texts such as `A-B`, `angle A B C` and `turn J` of a joint.
    ///
    /// # Errors
    /// Which text is none, and why.
    pub fn parse(problem: &Problem, texts: &[String]) -> Result<Self, String> {
        let all = texts.iter().map(|text| Quantity::parse(problem, text));
        Ok(Measures {
            all: all.collect::<Result<_, _>>()?,
        })
    }

    /// Whether nothing is measured.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The names, as they were given.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(|quantity| &*quantity.name)
    }

    /// Enclosures of all for a figure.
    pub fn of(&self, (points, objects): Placed) -> Vec<Interval> {
        let all = self.all.iter();
        all.map(|quantity| quantity.of(points, objects)).collect()
    }

    /// For JSON: the measures, each with its bounds for each figure.
    pub fn told<'f>(&self, figures: impl Iterator<Item = Placed<'f>> + Clone) -> Vec<Measured> {
        let all = self.all.iter().map(|quantity| Measured {
            name: quantity.name.clone(),
            values: figures
                .clone()
                .map(|(points, objects)| quantity.of(points, objects))
                .map(|value| [Some(value.inf()), Some(value.sup())])
                .collect(),
        });
        all.collect()
    }

    /// Between which bounds each is at some figures, a line each.
    pub fn over<'f>(&self, figures: impl Iterator<Item = Placed<'f>>) -> String {
        let rows: Vec<Vec<Interval>> = figures.map(|figure| self.of(figure)).collect();
        let lines = self.names().enumerate().map(|(k, name)| {
            let all = rows.iter().map(|row| row[k]);
            let least = all.clone().min_by(|a, b| a.inf().total_cmp(&b.inf()));
            let most = all.max_by(|a, b| a.sup().total_cmp(&b.sup()));
            match (least, most) {
                (Some(least), Some(most)) => {
                    let (least, most) = (certain_digits(least), certain_digits(most));
                    format!("{name:<18}  between {least} and {most} at the frames\n")
                }
                _ => String::new(),
            }
        });
        lines.collect()
    }

    /// A table with a line for each figure, numbered from 1 as solutions are; a figure that is the only one has no number. Empty where nothing is measured.
    /// `of`: what is behind "Measured", where that is not plain.
    pub fn to_table<'f>(&self, of: &str, figures: impl Iterator<Item = Placed<'f>>) -> String {
        let rows: Vec<Vec<String>> = figures
            .map(|figure| self.of(figure).into_iter().map(certain_digits).collect())
            .collect();
        if self.is_empty() || rows.is_empty() {
            return String::new();
        }
        let wide = |k: usize, name: &str| {
            let cells = rows.iter().map(|row| row[k].chars().count());
            cells.fold(name.chars().count(), usize::max)
        };
        let widths: Vec<usize> = self
            .names()
            .enumerate()
            .map(|(k, name)| wide(k, name))
            .collect();
        let mut out = format!("\nMeasured{of}\n          ");
        for (name, width) in self.names().zip(&widths) {
            out += &format!("  {name:>width$}");
        }
        out.push('\n');
        for (number, row) in rows.iter().enumerate() {
            let first = match rows.len() {
                1 => String::new(),
                _ => format!("solution {}", number + 1),
            };
            out += &format!("{first:<10}");
            for (cell, width) in row.iter().zip(&widths) {
                out += &format!("  {cell:>width$}");
            }
            out.push('\n');
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::point;

    fn problem(dimension: usize) -> Problem {
        let z = |x: &str| {
            if dimension == 3 {
                format!(", {x}")
            } else {
                String::new()
            }
        };
        let text = format!(
            "name = \"m\"\ndimension = {dimension}\n[points]\na = [3, 0{}]\nb = [0, 0{}]\nc = [0, 4{}]\n\"d-e\" = [-1, 4{}]\n[constraints]\n\
             distances = [[\"a\", \"b\", 3]]\n",
            z("0"),
            z("0"),
            z("0"),
            z("1")
        );
        Problem::parse_loosely(&text, "m.toml").unwrap()
    }

    fn measured(dimension: usize, text: &str) -> Result<f64, String> {
        let problem = problem(dimension);
        let measures = Measures::parse(&problem, &[text.to_owned()])?;
        let points = problem.points.iter();
        let figure: Vec<_> = points
            .map(|p| p.sketch.each_ref().map(|x| point(x.to_f64())))
            .collect();
        let value = measures.of((&figure, &[]))[0];
        assert!(value.wid() < 1e-11, "{value:?}");
        Ok(value.mid())
    }

    #[test]
    fn measures_are_what_they_say() {
        for (dimension, text, value) in [
            (2, "a-c", 5.0),
            (2, "d-e-c", 1.0),
            (2, "angle a b c", 90.0),
            (2, "angle c b d-e", 14.036243467926479),
            (2, "turn c b a", -90.0),
            (2, "x d-e", -1.0),
            (2, "area a b c", 6.0),
            (2, "area a b c d-e", 4.0),
            (3, "torsion a b c d-e", -135.0),
            (3, "z d-e", 1.0),
        ] {
            let found = measured(dimension, text).unwrap();
            assert!((found - value).abs() < 1e-11, "{text}: {found}");
        }
    }

    /// What is a quantity of points stays one, whatever objects are called; an object is meant by its name and what it has.
    #[test]
    fn points_come_before_objects() {
        let text = "name = \"m\"\ndimension = 2\n[points]\na = [3, 0]\nb = [0, 0]\nc = [0, 4]\n\"radius a\" = [1, 0]\n\
                    [circles]\nk = { center = \"b\", radius = 2 }\n\"a b c\" = { center = \"a\", radius = 1 }\n\
                    [constraints]\ndistances = [[\"a\", \"b\", 3]]\n";
        let problem = Problem::parse_loosely(text, "m.toml");
        let problem = problem.unwrap_or_else(|error| panic!("{error}"));
        let parsed = |text: &str| Quantity::parse(&problem, text).unwrap();
        let is_of_points = |text: &str| parsed(text).object().is_none();
        assert!(is_of_points("radius a-b") && is_of_points("turn a b c"));
        assert!(!is_of_points("radius a b c"));
        let radius = parsed("radius a b c");
        let round = |radius: f64| Located::Round {
            center: [point(0.0); 3],
            radius: point(radius),
        };
        assert_eq!(radius.of(&[], &[round(2.0), round(1.0)]), point(1.0));
    }

    #[test]
    fn what_is_none_is_said() {
        for (text, why) in [
            ("a-q", "write `A-B`"),
            ("angle a b", "takes 3 points, and there are 2"),
            ("angle a b q", "no point `q`"),
            ("torsion a b c d-e", "in space"),
            ("area a b", "three points"),
            ("a-a", "write `A-B`"),
            ("angle a a b", "named twice"),
            ("", "write `A-B`"),
            ("turn q", "no joint that turns about one axis `q`"),
            ("radius a", "no circle, sphere or arc `a`"),
        ] {
            let error = measured(2, text).unwrap_err();
            assert!(error.contains(why), "{error}");
        }
    }
}
