//! What constraints mean to people, evaluated from points alone.

use super::*;

const TOLERANCE: f64 = 1e-7;

/// A figure: a problem's, at some points.
struct Figure<'a> {
    spec: &'a Spec,
    points: Vec<Vector>,
    /// The largest coordinate, at least 1.
    largest: f64,
    /// Whether radii are those of the sketch.
    is_sketch: bool,
}

impl Spec {
    /// Whether points meet all constraints, as people understand them, on the side where the sketch is. All lines and
    /// planes that are named must be some.
    pub fn holds(&self, points: &[Vector]) -> Result<(), String> {
        let largest = |points: &[Vector]| {
            let all = points.iter().flatten();
            all.fold(1.0, |max: f64, x| max.max(x.abs()))
        };
        let figure = Figure {
            spec: self,
            points: points.to_vec(),
            largest: largest(points),
            is_sketch: false,
        };
        let drawn: Vec<Vector> = (0..self.points.len()).map(|p| self.at(p)).collect();
        let sketch = Figure {
            spec: self,
            largest: largest(&drawn),
            points: drawn,
            is_sketch: true,
        };
        figure.holds(&sketch)
    }
}

impl Spec {
    /// Whether two points are one, as they are said to be.
    fn are_one(&self, p: usize, q: usize) -> bool {
        let said = |names: &[Name]| match *names {
            [Name::Point(a), Name::Point(b)] => [a, b] == [p, q] || [b, a] == [p, q],
            _ => false,
        };
        let mut constraints = self.constraints.iter();
        p == q || constraints.any(|c| c.kind == "coincident" && said(&c.names))
    }
}

/// Which of the axes x, y, z a key is about.
fn axis(key: &str) -> usize {
    ["x", "y", "z"]
        .iter()
        .position(|&k| key.ends_with(k))
        .unwrap()
}

impl Figure<'_> {
    fn at(&self, p: usize) -> Vector {
        self.points[p]
    }

    fn span(&self, a: usize, b: usize) -> Vector {
        minus(self.at(b), self.at(a))
    }

    fn near(&self, what: &str, x: f64, wanted: f64) -> Result<(), String> {
        match (x - wanted).abs() <= TOLERANCE * self.largest * self.largest {
            true => Ok(()),
            false => Err(format!("{what}: {x} instead of {wanted}")),
        }
    }

    fn unit(&self, v: Vector, what: &str) -> Result<Vector, String> {
        match size(v) > 1e-9 * self.largest {
            true => Ok(v.map(|x| x / size(v))),
            false => Err(format!("{what} vanishes")),
        }
    }

    /// A point of a line, and its direction. That of a line of its own may be the opposite one.
    fn line(&self, name: Name) -> Result<(Vector, Vector), String> {
        let (a, b, what) = match name {
            Name::Axis(k) => {
                return Ok((
                    [0.0; 3],
                    std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 }),
                ));
            }
            Name::Line(k) => (self.spec.lines[k][0], self.spec.lines[k][1], "a line"),
            Name::FreeLine(k) => {
                let through = &self.spec.free_lines[k].through;
                (through[0], through[1], "a line of its own")
            }
            other => return Err(format!("{other:?} is no line")),
        };
        Ok((self.at(a), self.unit(self.span(a, b), what)?))
    }

    /// A point of a plane, and its normal. That of a plane of its own may be the opposite one.
    fn plane(&self, name: Name) -> Result<(Vector, Vector), String> {
        let ([a, b, c], what) = match name {
            Name::Plane(k) => (self.spec.planes[k], "a normal"),
            Name::FreePlane(k) => {
                let through = &self.spec.free_planes[k].through;
                ([through[0], through[1], through[2]], "a normal of its own")
            }
            other => return Err(format!("{other:?} is no plane")),
        };
        let normal = cross(self.span(a, b), self.span(a, c));
        Ok((self.at(a), self.unit(normal, what)?))
    }

    /// A centre and a radius: that of an arc, one given, or that to a point on it or on one that is equal.
    fn round(&self, name: Name) -> Result<(usize, f64), String> {
        let circle = match name {
            Name::Arc(k) => {
                let [center, start, _] = self.spec.arcs[k];
                return Ok((center, size(self.span(center, start))));
            }
            Name::Circle(k) => k,
            other => return Err(format!("{other:?} is no circle")),
        };
        let (center, drawn) = self.spec.circles[circle];
        if self.is_sketch {
            return Ok((center, drawn as f64 / 1000.0));
        }
        let radius =
            self.spec
                .constraints
                .iter()
                .find_map(|c| match (c.kind, &c.names[..], c.number) {
                    ("radii", &[of], Some(Number::Length(x))) if of == name => {
                        Some(x as f64 / 1000.0)
                    }
                    ("diameters", &[of], Some(Number::Length(x))) if of == name => {
                        Some(x as f64 / 2000.0)
                    }
                    ("on", &[Name::Point(p), of], _) if of == name => {
                        Some(size(self.span(center, p)))
                    }
                    _ => None,
                });
        Ok((center, radius.ok_or("a circle of which nothing is known")?))
    }

    /// How far a point is from a line or plane, with its side where it has one.
    fn height(&self, point: usize, name: Name) -> Result<f64, String> {
        if let Name::Plane(_) | Name::FreePlane(_) = name {
            let (base, normal) = self.plane(name)?;
            return Ok(dot(normal, minus(self.at(point), base)));
        }
        let (base, along) = self.line(name)?;
        let area = cross(along, minus(self.at(point), base));
        match self.spec.dimension {
            2 => Ok(area[2]),
            _ => Ok(size(area)),
        }
    }

    /// Whether the side that a number is on is the same in the sketch.
    fn side(&self, what: &str, name: Name, here: f64, there: f64) -> Result<(), String> {
        let free = matches!(name, Name::FreeLine(_) | Name::FreePlane(_));
        let clear = here.abs() > TOLERANCE * self.largest && there.abs() > 1e-9;
        match clear && !free && here * there < 0.0 {
            true => Err(format!(
                "{what}: on the other side, {here} where {there} was drawn"
            )),
            false => Ok(()),
        }
    }

    /// A cosine, of which only lines and planes of their own leave the sign open.
    fn cosine(
        &self,
        what: &str,
        names: [Name; 2],
        here: f64,
        there: f64,
        wanted: f64,
    ) -> Result<(), String> {
        self.near(what, here.abs(), wanted.abs())?;
        let other = names
            .into_iter()
            .find(|&name| matches!(name, Name::FreeLine(_) | Name::FreePlane(_)));
        self.side(what, other.unwrap_or(names[0]), here, there)
    }

    fn holds(&self, sketch: &Figure) -> Result<(), String> {
        for &(a, b, x) in &self.spec.distances {
            self.near("distance", size(self.span(a, b)), x as f64 / 1000.0)?;
        }
        for &p in &self.spec.fixed {
            self.near("fixed", size(minus(self.at(p), sketch.at(p))), 0.0)?;
        }
        for &[center, start, end] in &self.spec.arcs {
            let radii = [start, end].map(|p| size(self.span(center, p)));
            self.near("ends of an arc", radii[0], radii[1])?;
        }
        for body in &self.spec.bodies {
            self.is_rigid(body)?;
        }
        for c in &self.spec.constraints {
            let number = c.number.map(|number| match number {
                Number::Length(x) | Number::Degrees(x) => x as f64 / 1000.0,
            });
            self.meets(sketch, c, number.unwrap_or(f64::NAN))
                .map_err(|what| format!("{c:?}: {what}"))?;
        }
        Ok(())
    }

    /// Whether a body is neither bent nor mirrored: all its triangles or tetrahedra have their areas or volumes.
    fn is_rigid(&self, body: &Body) -> Result<(), String> {
        let local: Vec<Vector> = body
            .local
            .iter()
            .map(|x| x.map(|x| x as f64 / 1000.0))
            .collect();
        let here: Vec<Vector> = body.points.iter().map(|&p| self.at(p)).collect();
        let content = |places: &[Vector], corners: &[usize]| {
            let edges: Vec<Vector> = corners[1..]
                .iter()
                .map(|&k| minus(places[k], places[corners[0]]))
                .collect();
            match edges[..] {
                [a] => size(a),
                [a, b] => cross(a, b)[2],
                [a, b, c] => dot(cross(a, b), c),
                _ => unreachable!(),
            }
        };
        let count = local.len();
        for a in 0..count {
            for b in 0..a {
                let pair = [a, b];
                self.near("in a body", content(&here, &pair), content(&local, &pair))?;
                for c in 0..b {
                    if self.spec.dimension == 2 {
                        let all = [a, b, c];
                        self.near(
                            "area in a body",
                            content(&here, &all),
                            content(&local, &all),
                        )?;
                        continue;
                    }
                    for d in 0..c {
                        let all = [a, b, c, d];
                        let (is, wanted) = (content(&here, &all), content(&local, &all));
                        self.near("volume in a body", is / self.largest, wanted / self.largest)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn meets(&self, sketch: &Figure, c: &Constraint, number: f64) -> Result<(), String> {
        use Name::*;
        let cos = number.to_radians().cos();
        match (c.kind, &c.names[..]) {
            ("angles", &[Point(p), Point(q), Point(r)]) => {
                let u = self.unit(self.span(q, p), "a leg")?;
                let v = self.unit(self.span(q, r), "a leg")?;
                self.near("angle", dot(u, v), cos)?;
            }
            (
                "angles",
                &[
                    a @ (Line(_) | FreeLine(_) | Axis(_)),
                    b @ (Line(_) | FreeLine(_) | Axis(_)),
                ],
            ) => {
                let of = |figure: &Figure| -> Result<f64, String> {
                    Ok(dot(figure.line(a)?.1, figure.line(b)?.1))
                };
                self.cosine("angle of lines", [a, b], of(self)?, of(sketch)?, cos)?;
            }
            ("angles", &[a @ (Plane(_) | FreePlane(_)), b]) => {
                let of = |figure: &Figure| -> Result<f64, String> {
                    Ok(dot(figure.plane(a)?.1, figure.plane(b)?.1))
                };
                self.cosine("angle of planes", [a, b], of(self)?, of(sketch)?, cos)?;
            }
            ("angles", &[a, b]) => {
                let of = |figure: &Figure| -> Result<f64, String> {
                    Ok(dot(figure.line(a)?.1, figure.plane(b)?.1))
                };
                let sine = number.to_radians().sin();
                self.cosine(
                    "angle of line and plane",
                    [a, b],
                    of(self)?,
                    of(sketch)?,
                    sine,
                )?;
            }
            ("distances", &[Point(p), of]) => {
                let (here, there) = (self.height(p, of)?, sketch.height(p, of)?);
                self.near("distance", here.abs(), number)?;
                self.side("distance", of, here, there)?;
            }
            ("distances", &[a, b]) => {
                let of = |figure: &Figure| -> Result<f64, String> {
                    let ((p, u), (q, v)) = (figure.line(a)?, figure.line(b)?);
                    let normal = figure.unit(cross(u, v), "a common normal")?;
                    Ok(dot(normal, minus(q, p)))
                };
                let here = of(self)?;
                self.near("distance of lines", here.abs(), number)?;
                let free = [a, b].into_iter().find(|name| matches!(name, FreeLine(_)));
                self.side("distance of lines", free.unwrap_or(a), here, of(sketch)?)?;
            }
            (
                "perpendicular",
                &[
                    a @ (Line(_) | FreeLine(_) | Axis(_)),
                    b @ (Line(_) | FreeLine(_) | Axis(_)),
                ],
            ) => {
                self.near("right angle", dot(self.line(a)?.1, self.line(b)?.1), 0.0)?;
            }
            (
                "parallel",
                &[
                    a @ (Line(_) | FreeLine(_) | Axis(_)),
                    b @ (Line(_) | FreeLine(_) | Axis(_)),
                ],
            ) => {
                self.near(
                    "parallel",
                    size(cross(self.line(a)?.1, self.line(b)?.1)),
                    0.0,
                )?;
            }
            ("perpendicular", &[a @ (Plane(_) | FreePlane(_)), b]) => {
                self.near("right angle", dot(self.plane(a)?.1, self.plane(b)?.1), 0.0)?;
            }
            ("parallel", &[a @ (Plane(_) | FreePlane(_)), b]) => {
                self.near(
                    "parallel",
                    size(cross(self.plane(a)?.1, self.plane(b)?.1)),
                    0.0,
                )?;
            }
            ("perpendicular", &[a, b]) => {
                self.near(
                    "right angle",
                    size(cross(self.line(a)?.1, self.plane(b)?.1)),
                    0.0,
                )?;
            }
            ("parallel", &[a, b]) => {
                self.near("parallel", dot(self.line(a)?.1, self.plane(b)?.1), 0.0)?;
            }
            ("on", &[Point(p), of @ (Circle(_) | Arc(_))]) => {
                let (center, radius) = self.round(of)?;
                self.near("on a circle", size(self.span(center, p)), radius)?;
            }
            ("on", &[Point(p), of]) => self.near("on", self.height(p, of)?, 0.0)?,
            ("collinear", &[Point(p), Point(q), ref rest @ ..]) => {
                for (k, &other) in rest.iter().enumerate() {
                    let Point(r) = other else { unreachable!() };
                    self.near(
                        "collinear",
                        size(cross(self.span(p, q), self.span(p, r))),
                        0.0,
                    )?;
                    for &another in &rest[..k] {
                        let Point(s) = another else { unreachable!() };
                        self.near(
                            "collinear",
                            size(cross(self.span(p, s), self.span(p, r))),
                            0.0,
                        )?;
                    }
                }
            }
            ("coplanar", names) => {
                let mut all = names.iter().map(|name| match name {
                    Point(p) => self.at(*p),
                    _ => unreachable!(),
                });
                let first = all.next().unwrap();
                let spans: Vec<Vector> = all.map(|x| minus(x, first)).collect();
                for (i, &a) in spans.iter().enumerate() {
                    for (j, &b) in spans[..i].iter().enumerate() {
                        for &c in &spans[..j] {
                            self.near("coplanar", dot(cross(a, b), c) / self.largest, 0.0)?;
                        }
                    }
                }
            }
            ("coincident", &[Point(p), Point(q)]) => {
                self.near("coincident", size(self.span(p, q)), 0.0)?;
            }
            ("midpoint", &[Point(m), ref ends @ ..]) => {
                let [a, b] = match *ends {
                    [Point(a), Point(b)] => [a, b],
                    [Line(k)] => self.spec.lines[k],
                    _ => unreachable!(),
                };
                let off = minus(self.span(m, a), self.span(b, m));
                self.near("midpoint", size(off), 0.0)?;
            }
            ("equal", names @ [Line(_), ..]) => {
                let length = |name: &Name| match *name {
                    Line(k) => size(self.span(self.spec.lines[k][0], self.spec.lines[k][1])),
                    _ => unreachable!(),
                };
                for name in names {
                    self.near("equal", length(&names[0]), length(name))?;
                }
            }
            ("equal", &[a, b]) => self.near("equal radii", self.round(a)?.1, self.round(b)?.1)?,
            ("symmetric", &[Point(a), Point(b), Point(middle)]) => {
                let off = minus(self.span(middle, a), self.span(b, middle));
                self.near("symmetric", size(off), 0.0)?;
            }
            ("symmetric", &[Point(a), Point(b), Axis(k)]) => {
                let (a, b) = (self.at(a), self.at(b));
                self.near("symmetric", a[k], b[k])?;
                self.near("symmetric", a[1 - k], -b[1 - k])?;
            }
            ("symmetric", &[Point(a), Point(b), third]) => {
                let (base, n) = if let Line(_) | FreeLine(_) = third {
                    let (base, [x, y, _]) = self.line(third)?;
                    (base, [-y, x, 0.0])
                } else {
                    self.plane(third)?
                };
                let heights = [a, b].map(|p| dot(n, minus(self.at(p), base)));
                self.near("symmetric", heights[0], -heights[1])?;
                self.near("symmetric", size(cross(n, self.span(a, b))), 0.0)?;
            }
            ("radii", &[of]) => self.near("radius", self.round(of)?.1, number)?,
            ("diameters", &[of]) => self.near("diameter", 2.0 * self.round(of)?.1, number)?,
            ("tangent", &[a @ (Circle(_) | Arc(_)), b @ (Circle(_) | Arc(_))]) => {
                let ((p, r), (q, s)) = (self.round(a)?, self.round(b)?);
                if let (Arc(a), Arc(b)) = (a, b)
                    && self.spec.arcs[a][1..].iter().any(|&e| {
                        self.spec.arcs[b][1..]
                            .iter()
                            .any(|&f| self.spec.are_one(e, f))
                    })
                {
                    // At the end that both share, on either side.
                    let apart = size(self.span(p, q));
                    let off = (apart - r - s).abs().min((apart - (r - s).abs()).abs());
                    return self.near("tangent arcs", off, 0.0);
                }
                let ((c, x), (d, y)) = (sketch.round(a)?, sketch.round(b)?);
                let inside = size(sketch.span(c, d)).powi(2) < x * x + y * y;
                let wanted = if inside { (r - s).abs() } else { r + s };
                self.near("tangent circles", size(self.span(p, q)), wanted)?;
            }
            ("tangent", &[a, b]) => {
                let is_round = |name| matches!(name, Circle(_) | Arc(_));
                let (of, flat) = if is_round(a) { (a, b) } else { (b, a) };
                let (center, radius) = self.round(of)?;
                let (here, there) = (self.height(center, flat)?, sketch.height(center, flat)?);
                self.near("tangent", here.abs(), radius)?;
                let at_an_end = match (of, flat) {
                    (Arc(a), Line(l)) => {
                        let line = self.spec.lines[l];
                        let ends = self.spec.arcs[a][1..].iter();
                        ends.copied()
                            .any(|e| line.iter().any(|&p| self.spec.are_one(e, p)))
                    }
                    _ => false,
                };
                if !at_an_end {
                    self.side("tangent", flat, here, there)?;
                }
            }
            ("fixed", &[FreeLine(k)]) => {
                let Free {
                    point,
                    along,
                    through,
                } = &self.spec.free_lines[k];
                let [point, along] = [point, along].map(|x| x.map(|x| x as f64 / 100.0));
                let along = along.map(|x| x / size(along));
                for &p in through {
                    let away = size(cross(along, minus(self.at(p), point)));
                    self.near("on a fixed line", away, 0.0)?;
                }
            }
            ("ratios" | "differences", &[Line(a), Line(b)]) => {
                let length =
                    |k: usize| size(self.span(self.spec.lines[k][0], self.spec.lines[k][1]));
                let wanted = match c.kind {
                    "ratios" => number * length(b),
                    _ => length(b) + number,
                };
                self.near(c.kind, length(a), wanted)?;
            }
            ("along", &[Point(p), Point(q), line]) => {
                self.near("along", dot(self.line(line)?.1, self.span(p, q)), number)?;
            }
            ("equal_angles", &[Point(a), Point(b), Point(c), Point(d), Point(e), Point(f)]) => {
                let cosine = |a: usize, b: usize, c: usize| -> Result<f64, String> {
                    let u = self.unit(self.span(b, a), "a leg")?;
                    Ok(dot(u, self.unit(self.span(b, c), "a leg")?))
                };
                self.near("equal angles", cosine(a, b, c)?, cosine(d, e, f)?)?;
            }
            ("equal_angles", &[a, b, c, d]) => {
                let cosines = |figure: &Figure| -> Result<[f64; 2], String> {
                    let one = dot(figure.line(a)?.1, figure.line(b)?.1);
                    Ok([one, dot(figure.line(c)?.1, figure.line(d)?.1)])
                };
                let (here, there) = (cosines(self)?, cosines(sketch)?);
                let opposite = there[0] * there[1] < 0.0;
                let second = if opposite { -here[1] } else { here[1] };
                self.near("equal angles of lines", here[0], second)?;
            }
            ("x" | "y" | "z", &[Point(p)]) => {
                self.near("coordinate", self.at(p)[axis(c.kind)], number)?;
            }
            ("dx" | "dy" | "dz", &[Point(p), Point(q)]) => {
                self.near("difference", self.span(p, q)[axis(c.kind)], number)?;
            }
            ("horizontal", &[Point(p), Point(q)]) => {
                self.near("horizontal", self.span(p, q)[1], 0.0)?;
            }
            ("vertical", &[Point(p), Point(q)]) => {
                self.near("vertical", self.span(p, q)[0], 0.0)?;
            }
            ("equal_distances", &[Point(p), a, Point(q), b]) => {
                let of = |figure: &Figure| -> Result<[f64; 2], String> {
                    Ok([figure.height(p, a)?, figure.height(q, b)?])
                };
                let (here, there) = (of(self)?, of(sketch)?);
                self.near("equal distances", here[0].abs(), here[1].abs())?;
                let sides = [here, there].map(|[x, y]| x * y);
                self.side("equal distances", a, sides[0], sides[1])?;
            }
            other => return Err(format!("nobody knows what {other:?} means")),
        }
        Ok(())
    }
}
