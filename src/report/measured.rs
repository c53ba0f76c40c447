//! What is measured of figures: lengths, angles, coordinates, areas and numbers of objects that no constraint has to give.

use super::certain_digits;
use super::document::Measured;
use crate::interval::Interval;
use crate::problem::{Problem, Shape};
use crate::system::{Located, Quantity, with_a_name};

/// A figure: enclosures of its points, and where its objects are.
pub type Placed<'f> = (&'f [[Interval; 3]], &'f [Located]);

/// What is measured of each figure of a problem.
#[derive(Debug, Clone, Default)]
pub struct Measures {
    all: Vec<Measure>,
}

#[derive(Debug, Clone)]
enum Measure {
    /// Of points.
    Quantity(Quantity),
    /// A number that an object has: its name as it was given, and the object.
    Number(String, Part, usize),
}

/// Which number of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    /// By how many degrees a joint is turned.
    Turn,
    /// How far a joint has travelled.
    Travel,
    /// The radius of a circle, sphere or arc.
    Radius,
    /// The value of an unknown number.
    Value,
}

impl Part {
    /// The part that a word names, and what has it.
    fn named(word: &str) -> Option<(Part, &'static str)> {
        Some(match word {
            "turn" => (Part::Turn, "joint that turns about one axis"),
            "travel" => (Part::Travel, "joint that travels along its axis"),
            "radius" => (Part::Radius, "circle, sphere or arc"),
            "value" => (Part::Value, "unknown"),
            _ => return None,
        })
    }

    fn is_of(self, shape: &Shape) -> bool {
        match (self, shape) {
            (Part::Turn, Shape::Joint { sort, .. }) => sort.turns(),
            (Part::Travel, Shape::Joint { sort, .. }) => sort.travels(),
            (Part::Radius, Shape::Round { .. } | Shape::Arc { .. })
            | (Part::Value, Shape::Number { .. }) => true,
            _ => false,
        }
    }

    fn of(self, object: &Located) -> Option<Interval> {
        match (self, object) {
            (Part::Turn, Located::Joint { turn, .. }) => *turn,
            (Part::Travel, Located::Joint { travel, .. }) => *travel,
            (Part::Radius | Part::Value, object) => object.number(),
            _ => None,
        }
    }
}

impl Measure {
    fn parse(problem: &Problem, text: &str) -> Result<Self, String> {
        let call = |found: &mut Self, own| match found {
            Measure::Quantity(quantity) => quantity.name = own,
            Measure::Number(name, ..) => *name = own,
        };
        with_a_name(text, |text| Self::unnamed(problem, text), call)
    }

    fn unnamed(problem: &Problem, text: &str) -> Result<Self, String> {
        // Names of points may be anything.
        let why = match Quantity::parse(problem, text) {
            Ok(quantity) => return Ok(Measure::Quantity(quantity)),
            Err(why) => why,
        };
        let named = text.split_once(char::is_whitespace);
        let Some((part, what, name)) = named.and_then(|(word, name)| {
            let (part, what) = Part::named(word)?;
            Some((part, what, name.trim()))
        }) else {
            return Err(why);
        };
        let mut objects = problem.objects.iter();
        match objects.position(|o| o.name == name && part.is_of(&o.shape)) {
            Some(object) => Ok(Measure::Number(text.to_owned(), part, object)),
            // `turn A B C` is of points.
            None if part == Part::Turn && name.contains(char::is_whitespace) => Err(why),
            None => Err(format!("--measure \"{text}\": there is no {what} `{name}`")),
        }
    }

    fn name(&self) -> &str {
        match self {
            Measure::Quantity(quantity) => &quantity.name,
            Measure::Number(name, ..) => name,
        }
    }

    fn of(&self, (points, objects): Placed) -> Interval {
        match self {
            Measure::Quantity(quantity) => quantity.of(points),
            // An object that is nowhere told of may have any number.
            Measure::Number(_, part, object) => {
                let number = objects.get(*object).and_then(|object| part.of(object));
                number.unwrap_or(Interval::ENTIRE)
            }
        }
    }
}

impl Measures {
    /// From texts such as `A-B`, `angle A B C` and `turn J` of a joint.
    ///
    /// # Errors
    /// Which text is none, and why.
    pub fn parse(problem: &Problem, texts: &[String]) -> Result<Self, String> {
        let all = texts.iter().map(|text| Measure::parse(problem, text));
        Ok(Measures {
            all: all.collect::<Result<_, _>>()?,
        })
    }

    /// The first measure that is of no points, as it was given.
    pub fn of_an_object(&self) -> Option<&str> {
        let mut all = self.all.iter();
        all.find_map(|measure| match measure {
            Measure::Quantity(_) => None,
            Measure::Number(name, ..) => Some(name.as_str()),
        })
    }

    /// Whether nothing is measured.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The names, as they were given.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(Measure::name)
    }

    /// Enclosures of all for a figure.
    pub fn of(&self, figure: Placed) -> Vec<Interval> {
        self.all.iter().map(|measure| measure.of(figure)).collect()
    }

    /// For JSON: the measures, each with its bounds for each figure.
    pub fn told<'f>(&self, figures: impl Iterator<Item = Placed<'f>> + Clone) -> Vec<Measured> {
        let all = self.all.iter().map(|measure| Measured {
            name: measure.name().to_owned(),
            values: figures
                .clone()
                .map(|figure| measure.of(figure))
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
        let is_of_points = |text: &str| match Measure::parse(&problem, text) {
            Ok(Measure::Quantity(_)) => true,
            Ok(Measure::Number(..)) => false,
            Err(error) => panic!("{error}"),
        };
        assert!(is_of_points("radius a-b") && is_of_points("turn a b c"));
        assert!(!is_of_points("radius a b c"));
        let radius = Measure::parse(&problem, "radius a b c").unwrap();
        let round = |radius: f64| Located::Round {
            center: [point(0.0); 3],
            radius: point(radius),
        };
        assert_eq!(radius.of((&[], &[round(2.0), round(1.0)])), point(1.0));
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
