//! Problems as files: as they are, in another unit, under other names, in another place.

use super::{Free, Name, Number, Spec};

/// A way to write a problem.
#[derive(Debug, Clone)]
pub struct View {
    /// Where each point stands in the file.
    places: Vec<usize>,
    prefix: &'static str,
    /// Lengths are times the one and divided by the other.
    scale: [i64; 2],
    turned: bool,
}

impl View {
    pub fn same(spec: &Spec) -> View {
        View {
            places: (0..spec.points.len()).collect(),
            prefix: "p",
            scale: [1, 1],
            turned: false,
        }
    }

    /// In a unit that is 10 to this power smaller.
    pub fn scaled(spec: &Spec, exponent: i32) -> View {
        let factor = 10i64.pow(exponent.unsigned_abs());
        View {
            scale: if exponent < 0 {
                [1, factor]
            } else {
                [factor, 1]
            },
            ..View::same(spec)
        }
    }

    pub fn renamed(spec: &Spec) -> View {
        let n = spec.points.len();
        View {
            places: (0..n).map(|p| n - 1 - p).collect(),
            prefix: "other ",
            ..View::same(spec)
        }
    }

    pub fn moved(spec: &Spec) -> View {
        View {
            turned: true,
            ..View::same(spec)
        }
    }

    pub fn place(&self, point: usize) -> usize {
        self.places[point]
    }

    pub fn scale(&self) -> f64 {
        self.scale[0] as f64 / self.scale[1] as f64
    }

    /// The coordinates of a place, or of a direction, given in hundredths.
    fn coordinates(&self, dimension: usize, of: [i64; 3], is_place: bool) -> String {
        // Hundredths, or 2500ths, are ten thousandths.
        let mut at = of.map(|x| 100 * x);
        if self.turned {
            let [x, y, z] = of;
            let (x, y) = (3 * x - 4 * y, 4 * x + 3 * y);
            at = match dimension {
                2 => [20 * x, 20 * y, 0],
                _ => [20 * x, 4 * (3 * y - 20 * z), 4 * (4 * y + 15 * z)],
            };
            if is_place {
                let shift = [17_500, -31_000, if dimension == 2 { 0 } else { 1_250 }];
                at.iter_mut().zip(shift).for_each(|(x, by)| *x += by);
            }
        }
        // A direction has no unit.
        let [times, parts] = if is_place { self.scale } else { [1, 1] };
        let at = at.map(|x| decimal(x * times, 10_000 * parts));
        at[..dimension].join(", ")
    }
}

/// A number given in some part of 1, as a decimal.
fn decimal(x: i64, parts: i64) -> String {
    let digits = parts.ilog10() as usize;
    let sign = if x < 0 { "-" } else { "" };
    format!("{sign}{}.{:0digits$}", x.abs() / parts, x.abs() % parts)
}

impl Spec {
    /// The problem as a file.
    pub fn text(&self, view: &View) -> String {
        let point = |p: usize| format!("\"{}{p}\"", view.prefix);
        let mut text = format!(
            "name = \"random\"\ndimension = {}\n\n[points]\n",
            self.dimension
        );
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        order.sort_by_key(|&p| view.places[p]);
        for p in order {
            let at = view.coordinates(self.dimension, self.points[p], true);
            text += &format!("{} = [{at}]\n", point(p));
        }
        let length = |x: i64| decimal(x * view.scale[0], 1000 * view.scale[1]);
        let list = |items: &mut dyn Iterator<Item = String>| items.collect::<Vec<_>>().join(", ");
        let table = |title: &str, rows: Vec<String>| match rows.is_empty() {
            true => String::new(),
            false => format!("\n[{title}]\n{}\n", rows.join("\n")),
        };
        let through =
            |points: &[usize]| format!("[{}]", list(&mut points.iter().map(|&p| point(p))));
        let free = |free: &Free, along: &str| {
            format!(
                "{{ point = [{}], {along} = [{}] }}",
                view.coordinates(self.dimension, free.point, true),
                view.coordinates(self.dimension, free.along, false)
            )
        };
        let mut rows = Vec::new();
        for (k, points) in self.lines.iter().enumerate() {
            rows.push(format!("l{k} = {}", through(points)));
        }
        for (k, line) in self.free_lines.iter().enumerate() {
            rows.push(format!("f{k} = {}", free(line, "direction")));
        }
        text += &table("lines", rows);
        let mut rows = Vec::new();
        for (k, points) in self.planes.iter().enumerate() {
            rows.push(format!("e{k} = {}", through(points)));
        }
        for (k, plane) in self.free_planes.iter().enumerate() {
            rows.push(format!("g{k} = {}", free(plane, "normal")));
        }
        text += &table("planes", rows);
        let rows = self.arcs.iter().enumerate().map(|(k, &[c, a, b])| {
            let [c, a, b] = [c, a, b].map(point);
            format!("a{k} = {{ center = {c}, start = {a}, end = {b} }}")
        });
        text += &table("arcs", rows.collect());
        let rows = self.bodies.iter().enumerate().map(|(k, body)| {
            let mut pairs = body.points.iter().zip(&body.local).map(|(&p, local)| {
                let local = local.map(length);
                format!("{} = [{}]", point(p), local[..self.dimension].join(", "))
            });
            format!("b{k} = {{ {} }}", list(&mut pairs))
        });
        text += &table("bodies", rows.collect());
        let rows = self.circles.iter().enumerate();
        let rows = rows.map(|(k, &(p, r))| {
            format!("c{k} = {{ center = {}, radius = {} }}", point(p), length(r))
        });
        text += &table(
            if self.dimension == 2 {
                "circles"
            } else {
                "spheres"
            },
            rows.collect(),
        );
        text += "\n[constraints]\n";
        let name = |name: &Name| match *name {
            Name::Point(p) => point(p),
            Name::Line(k) => format!("\"l{k}\""),
            Name::Plane(k) => format!("\"e{k}\""),
            Name::Circle(k) => format!("\"c{k}\""),
            Name::Arc(k) => format!("\"a{k}\""),
            Name::FreeLine(k) => format!("\"f{k}\""),
            Name::FreePlane(k) => format!("\"g{k}\""),
            Name::Axis(k) => format!("\"{}-axis\"", ["x", "y", "z"][k]),
        };
        let mut by_kind: Vec<(&str, Vec<String>)> = vec![("distances", Vec::new())];
        for &(a, b, x) in &self.distances {
            by_kind[0]
                .1
                .push(format!("[{}, {}, {}]", point(a), point(b), length(x)));
        }
        if !self.fixed.is_empty() {
            by_kind.push(("fixed", self.fixed.iter().map(|&p| point(p)).collect()));
        }
        for c in &self.constraints {
            let mut parts: Vec<String> = c.names.iter().map(name).collect();
            parts.extend(c.number.map(|number| match number {
                Number::Length(x) if c.kind == "ratios" => decimal(x, 1000),
                Number::Length(x) => length(x),
                Number::Degrees(x) => decimal(x, 1000),
            }));
            let row = format!("[{}]", parts.join(", "));
            match by_kind.iter_mut().find(|(kind, _)| *kind == c.kind) {
                Some((_, rows)) => rows.push(row),
                None => by_kind.push((c.kind, vec![row])),
            }
        }
        for (kind, rows) in by_kind {
            text += &format!("{kind} = [{}]\n", rows.join(", "));
        }
        if let Some(&(a, b, _)) = self.distances.get(self.bend) {
            let c = decimal(self.c * view.scale[0], 100 * view.scale[1]);
            text += &format!(
                "\n[homotopy]\nbend = [{}, {}]\nbend_coefficient = {c}\n",
                point(a),
                point(b)
            );
            if self.fixed.is_empty() {
                // The same reference in all views.
                let first = self.reference();
                if let Some(first) = first {
                    text += &format!(
                        "reference = [{}]\n",
                        list(&mut first.iter().map(|&p| point(p)))
                    );
                }
            }
        }
        text
    }
}
