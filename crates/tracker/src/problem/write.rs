//! Writing problem files.

use super::{Decimal, Distance, Item, Pose, Problem, Shape, Target};
use crate::constraint::KINDS;

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
        let name = |p: usize| quoted(&self.points[p].name);
        let mut out = format!("name = {}\n", quoted(&self.name));
        out += &format!("dimension = {}\n", self.dimension);
        if !self.source.is_empty() {
            out += &format!("source = {}\n", quoted(&self.source));
        }
        out += "\n[points]\n";
        for point in &self.points {
            let coordinates = point.sketch.iter().take(self.dimension).map(number);
            let coordinates = coordinates.collect::<Vec<_>>().join(", ");
            let key = toml_edit::Key::new(&point.name);
            out += &format!("{key} = [{coordinates}]\n");
        }
        self.write_objects(&mut out);
        out += "\n[constraints]\n";
        let is_length = |d: &&Distance| matches!(d.target, Target::Length(_));
        let line = |distance: &Distance| {
            let [a, b] = distance.points.map(name);
            let (Target::Length(target) | Target::SquaredLength(target)) = &distance.target;
            format!("[{a}, {b}, {}]", with_limits(target))
        };
        let distances = self.distances.iter();
        let lengths: Vec<String> = distances.clone().filter(is_length).map(line).collect();
        let squares = distances.filter(|d| !is_length(d)).map(line).collect();
        write_list(
            &mut out,
            "distances",
            [lengths, self.entries("distances")].concat(),
        );
        write_list(&mut out, "squared_distances", squares);
        for kind in KINDS.iter().filter(|kind| kind.key != "distances") {
            write_list(&mut out, kind.key, self.entries(kind.key));
        }
        let orientations = self.orientations.iter().map(|one| {
            let points = one.points.iter().map(|&p| name(p));
            let parts: Vec<String> = points.chain([quoted(one.sign())]).collect();
            format!("[{}]", parts.join(", "))
        });
        write_list(&mut out, "orientation", orientations.collect());
        let homotopy = &self.homotopy;
        let reference = homotopy.reference.iter().map(|&p| name(p));
        out += "\n[homotopy]\n";
        if !self.is_absolute() {
            out += &format!(
                "reference = [{}]\n",
                reference.collect::<Vec<_>>().join(", ")
            );
        }
        if let Some(bend) = self.distances.get(homotopy.bend) {
            let [a, b] = bend.points.map(name);
            out += &format!("bend = [{a}, {b}]\n");
        }
        out += &format!(
            "bend_coefficient = {}\n",
            number(&homotopy.bend_coefficient)
        );
        if homotopy.detour != Decimal::from(0) {
            out += &format!("detour = {}\n", number(&homotopy.detour));
        }
        out
    }

    /// The entries of one kind of constraints.
    fn entries(&self, kind: &str) -> Vec<String> {
        let constraints = self.constraints.iter().filter(|c| c.kind == kind);
        constraints
            .map(|constraint| {
                if let Some(formula) = &constraint.formula {
                    return quoted(&formula.text);
                }
                let items = constraint.items.iter();
                let mut parts: Vec<String> = items
                    .map(|&item: &Item| quoted(self.item_name(item)))
                    .collect();
                parts.extend(constraint.value.as_ref().map(with_limits));
                format!("[{}]", parts.join(", "))
            })
            .collect()
    }

    /// The tables of objects. In each they stand in the problem's order; the tables themselves go by
    /// [`super::vocabulary::TABLES`].
    fn write_objects(&self, out: &mut String) {
        let name = |p: &usize| quoted(&self.points[*p].name);
        let names = |points: &[usize]| points.iter().map(name).collect::<Vec<_>>().join(", ");
        let numbers = |of: &[Decimal; 3]| {
            let numbers = of.iter().take(self.dimension).map(number);
            format!("[{}]", numbers.collect::<Vec<_>>().join(", "))
        };
        for table in super::vocabulary::TABLES {
            let objects = self.objects.iter().filter(|object| {
                let what = object.kind(self.dimension);
                table.strip_suffix('s') == Some(what) || (table, what) == ("bodies", "body")
            });
            for (index, object) in objects.enumerate() {
                if index == 0 {
                    *out += &format!("\n[{table}]\n");
                }
                let text = match &object.shape {
                    Shape::Line(points) => format!("[{}]", names(points)),
                    Shape::Plane(points) => format!("[{}]", names(points)),
                    Shape::FreeLine { point, direction } => {
                        let (point, direction) = (numbers(point), numbers(direction));
                        format!("{{ point = {point}, direction = {direction} }}")
                    }
                    Shape::FreePlane { point, normal } => {
                        let (point, normal) = (numbers(point), numbers(normal));
                        format!("{{ point = {point}, normal = {normal} }}")
                    }
                    Shape::Round { center, radius } => {
                        format!(
                            "{{ center = {}, radius = {} }}",
                            name(center),
                            number(radius)
                        )
                    }
                    Shape::Arc { center, start, end } => format!(
                        "{{ center = {}, start = {}, end = {} }}",
                        name(center),
                        name(start),
                        name(end)
                    ),
                    Shape::Number { sketch, within } => unknown(number(sketch), within),
                    Shape::Joint {
                        sort,
                        bodies,
                        frames,
                    } => {
                        let names = bodies.map(|body| quoted(&self.objects[body].name));
                        let pair = |of: fn(&Pose) -> &[Decimal; 3]| {
                            let [a, b] = frames.each_ref().map(|frame| all_three(of(frame)));
                            format!("[{a}, {b}]")
                        };
                        format!(
                            "{{ {} = [{}], at = {}, z = {}, x = {} }}",
                            sort.name(),
                            names.join(", "),
                            pair(|p| &p.at),
                            pair(|p| &p.z),
                            pair(|p| &p.x)
                        )
                    }
                    Shape::Body { points, local, .. } => {
                        let members = points.iter().zip(local).map(|(&p, local)| {
                            let key = toml_edit::Key::new(&self.points[p].name);
                            format!("{key} = {}", numbers(local))
                        });
                        format!("{{ {} }}", members.collect::<Vec<_>>().join(", "))
                    }
                };
                *out += &format!("{} = {text}\n", toml_edit::Key::new(&object.name));
            }
        }
        let placed = self.objects.iter();
        let placed = placed.filter_map(|object| Some((&object.name, object.place()?)));
        for (index, (name, pose)) in placed.enumerate() {
            if index == 0 {
                *out += "\n[places]\n";
            }
            *out += &format!(
                "{} = {{ at = {}, z = {}, x = {} }}\n",
                toml_edit::Key::new(name),
                all_three(&pose.at),
                all_three(&pose.z),
                all_three(&pose.x)
            );
        }
    }
}

/// A key and its entries, one a line, unless there are none.
fn write_list(out: &mut String, key: &str, entries: Vec<String>) {
    if entries.is_empty() {
        return;
    }
    *out += &format!("{key} = [\n");
    for entry in entries {
        *out += &format!("    {entry},\n");
    }
    *out += "]\n";
}

fn all_three(of: &[Decimal; 3]) -> String {
    let numbers: Vec<String> = of.iter().map(number).collect();
    format!("[{}]", numbers.join(", "))
}

fn with_limits(decimal: &Decimal) -> String {
    super::toml_with_limits(decimal, false)
}

fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}

/// An unknown with this value in the sketch, which is sought within a range, if it is, as files have it.
pub fn unknown(sketch: String, within: &[Option<Decimal>; 2]) -> String {
    let [low, high] = within.each_ref().map(|end| end.as_ref().map(number));
    match (low, high) {
        (None, None) => sketch,
        (low, high) => format!(
            "{{ value = {sketch}, within = [{}, {}] }}",
            low.unwrap_or("-inf".to_owned()),
            high.unwrap_or("inf".to_owned())
        ),
    }
}

/// A decimal in TOML's grammar for floats: a digit on either side of the point, no zeros
/// in front.
pub fn number(decimal: &Decimal) -> String {
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
