//! Random problems of mixed kinds, what their constraints mean, and the same problems written in other ways.

use krawl::problem::Problem;

/// Which constraints a problem may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kinds {
    All,
}

/// What a constraint names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name {
    Point(usize),
    Line(usize),
    Plane(usize),
    Circle(usize),
}

/// A number, in thousandths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    Length(i64),
    Degrees(i64),
}

#[derive(Debug, Clone)]
pub struct Constraint {
    pub kind: &'static str,
    pub names: Vec<Name>,
    pub number: Option<Number>,
}

/// A problem. Coordinates are in hundredths, lengths in thousandths.
#[derive(Debug, Clone)]
pub struct Spec {
    pub dimension: usize,
    pub points: Vec<[i64; 3]>,
    pub distances: Vec<(usize, usize, i64)>,
    pub lines: Vec<[usize; 2]>,
    pub planes: Vec<[usize; 3]>,
    /// Centre and radius.
    pub circles: Vec<(usize, i64)>,
    pub constraints: Vec<Constraint>,
    pub bend: usize,
    /// The coefficient, in hundredths.
    pub c: i64,
    /// Fixed points, in the user's own frame.
    pub fixed: Vec<usize>,
}

/// A way to write a problem.
#[derive(Debug, Clone)]
pub struct View {
    /// Where each point stands in the file.
    places: Vec<usize>,
    prefix: &'static str,
    scale: i64,
    turned: bool,
}

impl View {
    pub fn same(spec: &Spec) -> View {
        View {
            places: (0..spec.points.len()).collect(),
            prefix: "p",
            scale: 1,
            turned: false,
        }
    }

    pub fn scaled(spec: &Spec) -> View {
        View {
            scale: 1000,
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
        self.scale as f64
    }
}

/// A number given in some part of 1, as a decimal.
fn decimal(x: i64, parts: i64) -> String {
    let digits = parts.ilog10() as usize;
    let sign = if x < 0 { "-" } else { "" };
    format!("{sign}{}.{:0digits$}", x.abs() / parts, x.abs() % parts)
}

type Vector = [f64; 3];

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn size(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn angle(a: Vector, b: Vector) -> f64 {
    size(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// The smaller one of the two angles of lines.
fn acute(a: Vector, b: Vector) -> f64 {
    let x = angle(a, b);
    x.min(180.0 - x)
}

impl Spec {
    /// A random problem that krawl takes, if there is one among some tries.
    pub fn random(
        dimension: usize,
        _kinds: Kinds,
        below: &mut dyn FnMut(usize) -> usize,
    ) -> Option<(Spec, Problem)> {
        (0..20).find_map(|_| {
            let spec = Spec::draw(dimension, below);
            // Constraints that say where a point is relative to others, and that the sketch does not meet, are led to that
            // in the frame of the reference: another reference has another path.
            if spec.fixed.is_empty() && spec.reference().is_none() {
                return None;
            }
            let problem = Problem::parse(&spec.text(&View::same(&spec)), "random.toml").ok()?;
            Some((spec, problem))
        })
    }

    fn draw(dimension: usize, below: &mut dyn FnMut(usize) -> usize) -> Spec {
        let n = dimension + 1 + below(3);
        let mut coordinate = |axis: usize| match axis < dimension {
            true => below(401) as i64 - 200,
            false => 0,
        };
        let points: Vec<[i64; 3]> = (0..n)
            .map(|_| std::array::from_fn(&mut coordinate))
            .collect();
        let mut spec = Spec {
            dimension,
            points,
            distances: Vec::new(),
            lines: Vec::new(),
            planes: Vec::new(),
            circles: Vec::new(),
            constraints: Vec::new(),
            bend: 0,
            c: [200, 50, 10][below(3)],
            fixed: Vec::new(),
        };
        // Each point is joined to as many before it as there are dimensions.
        for p in 1..n {
            let mut before: Vec<usize> = (0..p).collect();
            while before.len() > dimension {
                before.swap_remove(below(before.len()));
            }
            for q in before {
                let length = spec.length(q, p) * (0.9 + 0.002 * below(101) as f64);
                spec.distances.push((q, p, (1000.0 * length) as i64));
            }
        }
        let is_absolute = below(4) == 0;
        if is_absolute {
            spec.fixed = (0..dimension).collect();
            spec.distances.retain(|&(_, q, _)| q >= dimension);
        }
        for _ in 0..1 + below(3) {
            spec.replace(is_absolute, below);
        }
        spec.bend = below(spec.distances.len().max(1));
        spec
    }

    fn length(&self, a: usize, b: usize) -> f64 {
        size(minus(self.at(a), self.at(b)))
    }

    fn at(&self, p: usize) -> Vector {
        self.points[p].map(|x| x as f64 / 100.0)
    }

    /// Takes away as many distances as a random constraint takes freedom away, and adds it.
    fn replace(&mut self, is_absolute: bool, below: &mut dyn FnMut(usize) -> usize) {
        let (n, d) = (self.points.len(), self.dimension);
        let mut all: Vec<usize> = (0..n).collect();
        let mut some: Vec<usize> = (0..n).map(|_| all.swap_remove(below(all.len()))).collect();
        some.resize(6, usize::MAX);
        let [p, q, r, s, u, v] = some[..] else {
            unreachable!()
        };
        use Name::*;
        let points = |names: &[usize]| names.iter().map(|&p| Point(p)).collect::<Vec<_>>();
        let near = |x: f64, below: &mut dyn FnMut(usize) -> usize| {
            (1000.0 * x * (0.9 + 0.002 * below(101) as f64)) as i64
        };
        let has = |count: usize| n >= count;
        let line = self.lines.len();
        let plane = self.planes.len();
        let at = |p: usize| self.at(p);
        let span = |a: usize, b: usize| minus(at(b), at(a));
        let (mut lines, mut planes, mut circles) = (vec![], vec![], vec![]);
        let mut add: Vec<Constraint> = Vec::new();
        let mut push = |kind: &'static str, names: Vec<Name>, number: Option<Number>| {
            add.push(Constraint {
                kind,
                names,
                number,
            });
        };
        let freedom = match below(22) {
            0 | 1 => {
                let degrees = near(angle(span(q, p), span(q, r)), below).clamp(2_000, 178_000);
                let degrees = if below(4) == 0 { 90_000 } else { degrees };
                push("angles", points(&[p, q, r]), Some(Number::Degrees(degrees)));
                1
            }
            2 if has(4) => {
                lines.extend([[p, q], [r, s]]);
                let degrees = near(angle(span(p, q), span(r, s)), below).clamp(2_000, 178_000);
                push(
                    "angles",
                    vec![Line(line), Line(line + 1)],
                    Some(Number::Degrees(degrees)),
                );
                1
            }
            3 => {
                lines.push([p, q]);
                let away = size(cross(span(p, q), span(p, r))) / size(span(p, q));
                let number = Some(Number::Length(near(away, below).max(1)));
                push("distances", vec![Point(r), Line(line)], number);
                1
            }
            4 if d == 3 && has(4) => {
                lines.extend([[p, q], [r, s]]);
                let normal = cross(span(p, q), span(r, s));
                let away = dot(normal, span(p, r)).abs() / size(normal);
                let number = Some(Number::Length(near(away, below).max(1)));
                push("distances", vec![Line(line), Line(line + 1)], number);
                1
            }
            5 if d == 3 && has(4) => {
                planes.push([p, q, r]);
                let normal = cross(span(p, q), span(p, r));
                let away = dot(normal, span(p, s)).abs() / size(normal);
                let number = Some(Number::Length(near(away, below).max(1)));
                push("distances", vec![Point(s), Plane(plane)], number);
                1
            }
            6 if has(4) => {
                lines.extend([[p, q], [r, s]]);
                push("perpendicular", vec![Line(line), Line(line + 1)], None);
                1
            }
            7 if has(4) => {
                lines.extend([[p, q], [r, s]]);
                push("parallel", vec![Line(line), Line(line + 1)], None);
                d - 1
            }
            8 => {
                lines.push([p, q]);
                push("on", vec![Point(r), Line(line)], None);
                d - 1
            }
            9 => {
                push("collinear", points(&[p, q, r]), None);
                d - 1
            }
            10 => {
                push("midpoint", points(&[p, q, r]), None);
                d
            }
            11 if has(4) => {
                lines.extend([[p, q], [r, s]]);
                push("equal", vec![Line(line), Line(line + 1)], None);
                1
            }
            12 if d == 2 && has(4) => {
                lines.push([r, s]);
                push("symmetric", vec![Point(p), Point(q), Line(line)], None);
                2
            }
            13 if d == 3 && has(5) => {
                planes.push([r, s, u]);
                push("symmetric", vec![Point(p), Point(q), Plane(plane)], None);
                3
            }
            14 => {
                let circle = self.circles.len();
                let radius = near(size(span(p, q)), below);
                circles.push((p, radius));
                let size = ["radii", "diameters"][below(2)];
                let number = if size == "radii" { radius } else { 2 * radius };
                push(size, vec![Circle(circle)], Some(Number::Length(number)));
                push("on", vec![Point(q), Circle(circle)], None);
                1
            }
            15 if has(3) => {
                let circle = self.circles.len();
                let (kind, flat) = if d == 2 {
                    lines.push([q, r]);
                    ("tangent", Line(line))
                } else if has(4) {
                    planes.push([q, r, s]);
                    ("tangent", Plane(plane))
                } else {
                    return;
                };
                let radius = near(0.6 * size(span(p, q)), below);
                circles.push((p, radius));
                push("radii", vec![Circle(circle)], Some(Number::Length(radius)));
                push(kind, vec![flat, Circle(circle)], None);
                1
            }
            16 if has(3) => {
                let circle = self.circles.len();
                let (one, other) = (
                    near(0.5 * size(span(p, q)), below),
                    near(0.4 * size(span(p, q)), below),
                );
                circles.extend([(p, one), (q, other)]);
                push("radii", vec![Circle(circle)], Some(Number::Length(one)));
                push(
                    "radii",
                    vec![Circle(circle + 1)],
                    Some(Number::Length(other)),
                );
                push("tangent", vec![Circle(circle), Circle(circle + 1)], None);
                1
            }
            17 if d == 3 && has(4) => {
                let count = if has(5) && below(2) == 0 { 5 } else { 4 };
                push("coplanar", points(&[p, q, r, s, u][..count]), None);
                count - 3
            }
            18 if d == 3 && has(4) => {
                planes.push([p, q, r]);
                push("on", vec![Point(s), Plane(plane)], None);
                1
            }
            19 if d == 3 && has(5) => {
                if has(6) && below(2) == 0 {
                    planes.extend([[p, q, r], [s, u, v]]);
                    let normal = |a, b, c| cross(span(a, b), span(a, c));
                    let degrees =
                        near(angle(normal(p, q, r), normal(s, u, v)), below).clamp(2_000, 178_000);
                    push(
                        "angles",
                        vec![Plane(plane), Plane(plane + 1)],
                        Some(Number::Degrees(degrees)),
                    );
                } else {
                    planes.push([p, q, r]);
                    lines.push([s, u]);
                    let normal = cross(span(p, q), span(p, r));
                    let degrees =
                        near(90.0 - acute(normal, span(s, u)), below).clamp(2_000, 88_000);
                    push(
                        "angles",
                        vec![Line(line), Plane(plane)],
                        Some(Number::Degrees(degrees)),
                    );
                }
                1
            }
            20 if is_absolute => {
                let kind = ["x", "y", "z", "dx", "dy", "dz"]
                    [below(2 * d) % d + d * below(2) * 3 / d.max(1) % 6];
                let axis = ["x", "y", "z", "dx", "dy", "dz"]
                    .iter()
                    .position(|&k| k == kind)
                    .unwrap();
                let k = axis % 3;
                if k >= d {
                    return;
                }
                let (names, x) = if axis < 3 {
                    (vec![p], at(p)[k])
                } else {
                    (vec![p, q], span(p, q)[k])
                };
                push(
                    kind,
                    points(&names),
                    Some(Number::Length(
                        (1000.0 * x) as i64 + below(200) as i64 - 100,
                    )),
                );
                1
            }
            21 if d == 2 && is_absolute => {
                push(["horizontal", "vertical"][below(2)], points(&[p, q]), None);
                1
            }
            21 if d == 2 && has(4) => {
                lines.push([r, s]);
                lines.push([q, r]);
                push(
                    "equal_distances",
                    vec![Point(p), Line(line), Point(s), Line(line + 1)],
                    None,
                );
                1
            }
            _ => return,
        };
        // Distances go in pairs of points that the constraint names, as far as there are such.
        for _ in 0..freedom {
            if self.distances.len() <= 1 {
                break;
            }
            let concerns = |&(a, b, _): &(usize, usize, i64)| {
                [p, q, r].contains(&a) && [p, q, r, s].contains(&b)
            };
            let index = self.distances.iter().position(concerns);
            let index = index.unwrap_or_else(|| below(self.distances.len()));
            self.distances.swap_remove(index);
        }
        self.lines.extend(lines);
        self.planes.extend(planes);
        self.circles.extend(circles);
        self.constraints.extend(add);
    }

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
            // Hundredths, or 2500ths, are ten thousandths.
            let mut at = self.points[p].map(|x| 100 * x);
            if view.turned {
                let [x, y, z] = self.points[p];
                let (x, y) = (3 * x - 4 * y, 4 * x + 3 * y);
                at = match self.dimension {
                    2 => [20 * x + 17_500, 20 * y - 31_000, 0],
                    _ => [
                        20 * x + 17_500,
                        4 * (3 * y - 20 * z) - 31_000,
                        4 * (4 * y + 15 * z) + 1_250,
                    ],
                };
            }
            let at = at.map(|x| decimal(x * view.scale, 10_000));
            let at = at[..self.dimension].join(", ");
            text += &format!("{} = [{at}]\n", point(p));
        }
        let length = |x: i64| decimal(x * view.scale, 1000);
        let list = |items: &mut dyn Iterator<Item = String>| items.collect::<Vec<_>>().join(", ");
        let table = |title: &str, rows: Vec<String>| match rows.is_empty() {
            true => String::new(),
            false => format!("\n[{title}]\n{}\n", rows.join("\n")),
        };
        let rows = self.lines.iter().enumerate();
        let rows =
            rows.map(|(k, l)| format!("l{k} = [{}]", list(&mut l.iter().map(|&p| point(p)))));
        text += &table("lines", rows.collect());
        let rows = self.planes.iter().enumerate();
        let rows =
            rows.map(|(k, l)| format!("e{k} = [{}]", list(&mut l.iter().map(|&p| point(p)))));
        text += &table("planes", rows.collect());
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
        };
        let mut by_kind: Vec<(&str, Vec<String>)> = vec![("distances", Vec::new())];
        for &(a, b, x) in &self.distances {
            by_kind[0]
                .1
                .push(format!("[{}, {}, {}]", point(a), point(b), length(x)));
        }
        for c in &self.constraints {
            let mut parts: Vec<String> = c.names.iter().map(name).collect();
            parts.extend(c.number.map(|number| match number {
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
        if !self.fixed.is_empty() {
            text += &format!(
                "fixed = [{}]\n",
                list(&mut self.fixed.iter().map(|&p| point(p)))
            );
        }
        if let Some(&(a, b, _)) = self.distances.get(self.bend) {
            let c = decimal(self.c * view.scale, 100);
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

    /// Points that are joined to each other, if there are enough.
    fn reference(&self) -> Option<Vec<usize>> {
        let joined = |a: usize, b: usize| {
            self.distances
                .iter()
                .any(|&(x, y, _)| (x, y) == (a.min(b), a.max(b)))
        };
        let n = self.points.len();
        let pairs = (0..n).flat_map(|b| (0..b).map(move |a| vec![a, b]));
        let mut pairs = pairs.filter(|p| joined(p[0], p[1]));
        match self.dimension {
            2 => pairs.next(),
            _ => pairs.find_map(|p| {
                let third =
                    (0..n).find(|&c| !p.contains(&c) && joined(p[0], c) && joined(p[1], c))?;
                Some(vec![p[0], p[1], third])
            }),
        }
    }

    /// Whether points meet all constraints, as people understand them. All lines and planes that are named must be some.
    pub fn holds(&self, points: &[Vector]) -> Result<(), String> {
        const TOLERANCE: f64 = 1e-7;
        let at = |p: usize| points[p];
        let span = |a: usize, b: usize| minus(at(b), at(a));
        let largest = points
            .iter()
            .flatten()
            .fold(1.0, |max: f64, x| max.max(x.abs()));
        let near = |what: &str, x: f64, wanted: f64| match (x - wanted).abs()
            <= TOLERANCE * largest * largest
        {
            true => Ok(()),
            false => Err(format!("{what}: {x} instead of {wanted}")),
        };
        for &(a, b, x) in &self.distances {
            near("distance", size(span(a, b)), x as f64 / 1000.0)?;
        }
        for &p in &self.fixed {
            near("fixed", size(minus(at(p), self.at(p))), 0.0)?;
        }
        let unit = |v: Vector, what: &str| match size(v) > 1e-9 * largest {
            true => Ok(v.map(|x| x / size(v))),
            false => Err(format!("{what} vanishes")),
        };
        let line = |k: usize| unit(span(self.lines[k][0], self.lines[k][1]), "a line");
        let normal = |k: usize| {
            let [a, b, c] = self.planes[k];
            unit(cross(span(a, b), span(a, c)), "a normal")
        };
        let radius = |k: usize| {
            let mut given = self
                .constraints
                .iter()
                .filter(|c| c.names == [Name::Circle(k)]);
            given.find_map(|c| match (c.kind, c.number) {
                ("radii", Some(Number::Length(x))) => Some(x as f64 / 1000.0),
                ("diameters", Some(Number::Length(x))) => Some(x as f64 / 2000.0),
                _ => None,
            })
        };
        for c in &self.constraints {
            use Name::*;
            let number = c.number.map(|number| match number {
                Number::Length(x) | Number::Degrees(x) => x as f64 / 1000.0,
            });
            let number = number.unwrap_or(f64::NAN);
            match (c.kind, &c.names[..]) {
                ("angles", &[Point(p), Point(q), Point(r)]) => {
                    let (u, v) = (unit(span(q, p), "a leg")?, unit(span(q, r), "a leg")?);
                    near("angle", dot(u, v), number.to_radians().cos())?;
                }
                ("angles", &[Line(a), Line(b)]) => {
                    let cos = dot(line(a)?, line(b)?).abs();
                    near("angle of lines", cos, number.to_radians().cos().abs())?;
                }
                ("angles", &[Plane(a), Plane(b)]) => {
                    let cos = dot(normal(a)?, normal(b)?).abs();
                    near("angle of planes", cos, number.to_radians().cos().abs())?;
                }
                ("angles", &[Line(a), Plane(b)]) => {
                    let sine = dot(line(a)?, normal(b)?).abs();
                    near(
                        "angle of a line and a plane",
                        sine,
                        number.to_radians().sin(),
                    )?;
                }
                ("distances", &[Point(p), Line(k)]) => {
                    let away = size(cross(line(k)?, span(self.lines[k][0], p)));
                    near("distance from a line", away, number)?;
                }
                ("distances", &[Point(p), Plane(k)]) => {
                    let away = dot(normal(k)?, span(self.planes[k][0], p)).abs();
                    near("distance from a plane", away, number)?;
                }
                ("distances", &[Line(a), Line(b)]) => {
                    let normal = unit(cross(line(a)?, line(b)?), "a common normal")?;
                    let away = dot(normal, span(self.lines[a][0], self.lines[b][0])).abs();
                    near("distance of lines", away, number)?;
                }
                ("perpendicular", &[Line(a), Line(b)]) => {
                    near("right angle", dot(line(a)?, line(b)?), 0.0)?
                }
                ("parallel", &[Line(a), Line(b)]) => {
                    near("parallel", size(cross(line(a)?, line(b)?)), 0.0)?;
                }
                ("on", &[Point(p), Line(k)]) => {
                    near(
                        "on a line",
                        size(cross(line(k)?, span(self.lines[k][0], p))),
                        0.0,
                    )?;
                }
                ("on", &[Point(p), Plane(k)]) => {
                    near(
                        "on a plane",
                        dot(normal(k)?, span(self.planes[k][0], p)),
                        0.0,
                    )?;
                }
                ("on", &[Point(p), Circle(k)]) => {
                    let radius = radius(k).ok_or("a radius")?;
                    near("on a circle", size(span(self.circles[k].0, p)), radius)?;
                }
                ("collinear", &[Point(p), Point(q), Point(r)]) => {
                    near("collinear", size(cross(span(p, q), span(p, r))), 0.0)?;
                }
                ("coplanar", names) => {
                    let mut all = names.iter().map(|name| match name {
                        Point(p) => at(*p),
                        _ => unreachable!(),
                    });
                    let first = all.next().unwrap();
                    let spans: Vec<Vector> = all.map(|x| minus(x, first)).collect();
                    for (i, &a) in spans.iter().enumerate() {
                        for (j, &b) in spans[..i].iter().enumerate() {
                            for &c in &spans[..j] {
                                near("coplanar", dot(cross(a, b), c) / largest, 0.0)?;
                            }
                        }
                    }
                }
                ("midpoint", &[Point(m), Point(a), Point(b)]) => {
                    let off = minus(span(m, a), span(b, m));
                    near("midpoint", size(off), 0.0)?;
                }
                ("equal", &[Line(a), Line(b)]) => {
                    let length = |k: usize| size(span(self.lines[k][0], self.lines[k][1]));
                    near("equal", length(a), length(b))?;
                }
                ("symmetric", &[Point(a), Point(b), ref third]) => {
                    let (base, n) = match *third {
                        Line(k) => {
                            let [x, y, _] = line(k)?;
                            (self.lines[k][0], [-y, x, 0.0])
                        }
                        Plane(k) => (self.planes[k][0], normal(k)?),
                        _ => unreachable!(),
                    };
                    near("symmetric", dot(n, span(base, a)), -dot(n, span(base, b)))?;
                    near("symmetric", size(cross(n, span(a, b))), 0.0)?;
                }
                ("radii" | "diameters", _) => {}
                ("tangent", &[Line(k), Circle(c)]) => {
                    let away = size(cross(line(k)?, span(self.lines[k][0], self.circles[c].0)));
                    near("tangent", away, radius(c).ok_or("a radius")?)?;
                }
                ("tangent", &[Plane(k), Circle(c)]) => {
                    let away = dot(normal(k)?, span(self.planes[k][0], self.circles[c].0)).abs();
                    near("tangent", away, radius(c).ok_or("a radius")?)?;
                }
                ("tangent", &[Circle(a), Circle(b)]) => {
                    let (r, s) = (radius(a).ok_or("a radius")?, radius(b).ok_or("a radius")?);
                    let apart = size(span(self.circles[a].0, self.circles[b].0));
                    let off = (apart - r - s).abs().min((apart - (r - s).abs()).abs());
                    near("tangent circles", off, 0.0)?;
                }
                ("x" | "y" | "z", &[Point(p)]) => {
                    let k = ["x", "y", "z"].iter().position(|&k| k == c.kind).unwrap();
                    near("coordinate", at(p)[k], number)?;
                }
                ("dx" | "dy" | "dz", &[Point(p), Point(q)]) => {
                    let k = ["dx", "dy", "dz"]
                        .iter()
                        .position(|&k| k == c.kind)
                        .unwrap();
                    near("difference", span(p, q)[k], number)?;
                }
                ("horizontal", &[Point(p), Point(q)]) => near("horizontal", span(p, q)[1], 0.0)?,
                ("vertical", &[Point(p), Point(q)]) => near("vertical", span(p, q)[0], 0.0)?,
                ("equal_distances", &[Point(p), Line(a), Point(q), Line(b)]) => {
                    let away = |p: usize, k: usize| -> Result<f64, String> {
                        Ok(size(cross(line(k)?, span(self.lines[k][0], p))))
                    };
                    near("equal distances", away(p, a)?, away(q, b)?)?;
                }
                other => return Err(format!("nobody knows what {other:?} means")),
            }
        }
        Ok(())
    }
}
