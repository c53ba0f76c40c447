//! Random constraints in place of distances.

use super::*;

impl Spec {
    /// Takes away as many distances as a random constraint takes freedom away, and adds it.
    pub(super) fn replace(&mut self, is_absolute: bool, below: &mut dyn FnMut(usize) -> usize) {
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
        let (mut arcs, mut bodies, mut rigid) = (vec![], vec![], vec![]);
        let (mut free_lines, mut free_planes) = (vec![], vec![]);
        let mut beside: Option<usize> = None;
        let arc = self.arcs.len();
        let free_line = self.free_lines.len();
        let free_plane = self.free_planes.len();
        let circle = self.circles.len();
        let of_round = ["radii", "diameters"];
        // A point, and a vector, of the sketch in hundredths, a little off.
        let off = |x: [f64; 3], below: &mut dyn FnMut(usize) -> usize| -> [i64; 3] {
            std::array::from_fn(|k| match k < d {
                true => (100.0 * x[k]).round() as i64 + below(31) as i64 - 15,
                false => 0,
            })
        };
        let mut add: Vec<Constraint> = Vec::new();
        let mut push = |kind: &'static str, names: Vec<Name>, number: Option<Number>| {
            add.push(Constraint {
                kind,
                names,
                number,
            });
        };
        let freedom = match below(52) {
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
                let radius = near(size(span(p, q)), below);
                circles.push((p, radius));
                let size = ["radii", "diameters"][below(2)];
                let number = if size == "radii" { radius } else { 2 * radius };
                push(size, vec![Circle(circle)], Some(Number::Length(number)));
                push("on", vec![Point(q), Circle(circle)], None);
                1
            }
            15 if has(3) => {
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
            // A rigid body, its own coordinates turned and a little off.
            22..=24 => {
                let count = (2 + below(3)).max(d).min(n);
                let points = some[..count].to_vec();
                let mut local: Vec<[i64; 3]> = points
                    .iter()
                    .map(|&p| {
                        let [x, y, z] = off(at(p), below).map(|x| 10 * x);
                        [250 - y, x, z]
                    })
                    .collect();
                if d == 3 && count == 4 && below(2) == 0 {
                    // A flat one.
                    local[3] = std::array::from_fn(|k| local[1][k] + local[2][k] - local[0][k]);
                }
                rigid = points.clone();
                bodies.push(Body { points, local });
                d * count - d * (d + 1) / 2
            }
            // A point in the place of another, which takes one of its distances over.
            25 | 26 => {
                beside = Some(q);
                push("coincident", points(&[n, q]), None);
                0
            }
            27 if has(4) && below(2) == 0 => {
                push("collinear", points(&[p, q, r, s]), None);
                2 * (d - 1)
            }
            27 => {
                lines.push([p, q]);
                push("midpoint", vec![Point(r), Line(line)], None);
                d
            }
            // Arcs.
            28 if d == 2 => {
                arcs.push([p, q, r]);
                1
            }
            29 if d == 2 => {
                arcs.push([p, q, r]);
                let kind = of_round[below(2)];
                let radius = near(size(span(p, q)), below);
                let number = if kind == "radii" { radius } else { 2 * radius };
                push(kind, vec![Arc(arc)], Some(Number::Length(number)));
                2
            }
            30 if d == 2 && has(4) => {
                arcs.push([p, q, r]);
                lines.push([q, s]);
                push("tangent", vec![Arc(arc), Line(line)], None);
                2
            }
            31 if d == 2 && has(5) => {
                arcs.push([p, q, r]);
                if below(2) == 0 {
                    lines.push([s, u]);
                    push("tangent", vec![Line(line), Arc(arc)], None);
                } else {
                    arcs.push([s, r, u]);
                    push("tangent", vec![Arc(arc), Arc(arc + 1)], None);
                }
                1 + arcs.len()
            }
            32 if d == 2 && has(4) => {
                arcs.push([p, q, r]);
                push("on", vec![Point(s), Arc(arc)], None);
                2
            }
            33 if d == 2 && has(5) => {
                arcs.push([p, q, r]);
                let radius = near(0.4 * size(span(s, u)), below);
                circles.push((s, radius));
                let kind = ["equal", "tangent"][below(2)];
                push("on", vec![Point(u), Circle(circle)], None);
                push(kind, vec![Arc(arc), Circle(circle)], None);
                2
            }
            // Circles and spheres of which no radius is given.
            34 if has(4) => {
                let radius =
                    |a, b, below: &mut dyn FnMut(usize) -> usize| near(size(span(a, b)), below);
                circles.extend([(p, radius(p, q, below)), (r, radius(r, s, below))]);
                push("on", vec![Point(q), Circle(circle)], None);
                push("on", vec![Point(s), Circle(circle + 1)], None);
                let kind = ["equal", "tangent"][below(2)];
                push(kind, vec![Circle(circle), Circle(circle + 1)], None);
                1
            }
            35 => {
                push("symmetric", points(&[p, q, r]), None);
                d
            }
            36 if d == 2 && is_absolute => {
                push("symmetric", vec![Point(p), Point(q), Axis(below(2))], None);
                2
            }
            36 if has(4) => {
                lines.extend([[p, q], [q, r], [r, s]]);
                push("equal", (0..3).map(|k| Line(line + k)).collect(), None);
                2
            }
            // Lines of their own, on which two points are put.
            37..=39 => {
                let along = off(span(p, q), below);
                free_lines.push(Free {
                    point: off(at(p), below),
                    along,
                    through: vec![p, q],
                });
                if along == [0; 3] {
                    return;
                }
                push("on", vec![Point(p), FreeLine(free_line)], None);
                push("on", vec![Point(q), FreeLine(free_line)], None);
                match below(6) {
                    _ if is_absolute && below(3) == 0 => {
                        push("fixed", vec![FreeLine(free_line)], None);
                        2 * (d - 1)
                    }
                    0 => {
                        let away = size(cross(span(p, q), span(p, r))) / size(span(p, q));
                        let number = Some(Number::Length(near(away, below).max(1)));
                        push("distances", vec![Point(r), FreeLine(free_line)], number);
                        1
                    }
                    1 => {
                        push("on", vec![Point(r), FreeLine(free_line)], None);
                        d - 1
                    }
                    2 if has(4) => {
                        lines.push([r, s]);
                        let degrees = near(angle(span(p, q), span(r, s)), below);
                        let number = Some(Number::Degrees(degrees.clamp(2_000, 178_000)));
                        push("angles", vec![FreeLine(free_line), Line(line)], number);
                        1
                    }
                    3 if has(4) => {
                        lines.push([r, s]);
                        push("parallel", vec![Line(line), FreeLine(free_line)], None);
                        d - 1
                    }
                    4 if has(4) => {
                        lines.push([r, s]);
                        push("perpendicular", vec![FreeLine(free_line), Line(line)], None);
                        1
                    }
                    5 if d == 2 && has(4) => {
                        push(
                            "symmetric",
                            vec![Point(r), Point(s), FreeLine(free_line)],
                            None,
                        );
                        2
                    }
                    5 if d == 3 && has(4) => {
                        lines.push([r, s]);
                        let normal = cross(span(p, q), span(r, s));
                        let away = dot(normal, span(p, r)).abs() / size(normal);
                        let number = Some(Number::Length(near(away, below).max(1)));
                        push("distances", vec![FreeLine(free_line), Line(line)], number);
                        1
                    }
                    _ => {
                        circles.push((r, near(0.6 * size(span(p, r)), below)));
                        let number = Number::Length(circles[0].1);
                        push("radii", vec![Circle(circle)], Some(number));
                        if d == 3 {
                            return;
                        }
                        push("tangent", vec![Circle(circle), FreeLine(free_line)], None);
                        1
                    }
                }
            }
            // Planes of their own, on which three points are put.
            40 | 41 if d == 3 && has(4) => {
                let normal = cross(span(p, q), span(p, r));
                let along = off(normal.map(|x| x / size(normal)), below);
                if along == [0; 3] {
                    return;
                }
                free_planes.push(Free {
                    point: off(at(p), below),
                    along,
                    through: vec![p, q, r],
                });
                let plane = FreePlane(free_plane);
                for x in [p, q, r] {
                    push("on", vec![Point(x), plane], None);
                }
                match below(5) {
                    0 => {
                        let away = dot(normal, span(p, s)).abs() / size(normal);
                        let number = Some(Number::Length(near(away, below).max(1)));
                        push("distances", vec![Point(s), plane], number);
                        1
                    }
                    1 => {
                        push("on", vec![Point(s), plane], None);
                        1
                    }
                    2 if has(5) => {
                        push("symmetric", vec![Point(s), Point(u), plane], None);
                        3
                    }
                    3 => {
                        lines.push([p, s]);
                        let degrees = near(90.0 - acute(normal, span(p, s)), below);
                        let number = Some(Number::Degrees(degrees.clamp(2_000, 88_000)));
                        push("angles", vec![Line(line), plane], number);
                        1
                    }
                    _ => {
                        circles.push((s, near(0.6 * size(span(p, s)), below)));
                        let number = Number::Length(circles[0].1);
                        push("radii", vec![Circle(circle)], Some(number));
                        push("tangent", vec![plane, Circle(circle)], None);
                        1
                    }
                }
            }
            // Two planes, or a line and a plane, parallel or at a right angle.
            42 | 43 if d == 3 && has(5) => {
                planes.push([p, q, r]);
                let kind = ["parallel", "perpendicular"][below(2)];
                if has(6) && below(2) == 0 {
                    planes.push([s, u, v]);
                    push(kind, vec![Plane(plane), Plane(plane + 1)], None);
                    if kind == "parallel" { 2 } else { 1 }
                } else {
                    lines.push([s, u]);
                    push(kind, vec![Line(line), Plane(plane)], None);
                    if kind == "parallel" { 1 } else { 2 }
                }
            }
            // Lengths and angles compared.
            44 | 45 if has(4) => {
                lines.extend([[p, q], [r, s]]);
                let (long, short) = (size(span(p, q)), size(span(r, s)));
                let (kind, number) = match below(2) {
                    0 => ("ratios", near(long / short, below).max(1)),
                    _ => ("differences", near(long - short, below)),
                };
                push(
                    kind,
                    vec![Line(line), Line(line + 1)],
                    Some(Number::Length(number)),
                );
                1
            }
            46 if has(4) => {
                lines.push([r, s]);
                let along = dot(span(r, s), span(p, q)) / size(span(r, s));
                let number = Some(Number::Length(near(along, below)));
                push("along", vec![Point(p), Point(q), Line(line)], number);
                1
            }
            47 | 48 if has(4) => {
                if below(2) == 0 {
                    push("equal_angles", points(&[p, q, r, q, r, s]), None);
                } else {
                    lines.extend([[p, q], [q, r], [r, s], [p, s]]);
                    push(
                        "equal_angles",
                        (0..4).map(|k| Line(line + k)).collect(),
                        None,
                    );
                }
                1
            }
            // Coordinate axes as lines.
            49..=51 if is_absolute => {
                let k = below(d);
                let axis: [f64; 3] = std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
                match below(6) {
                    0 => {
                        let away = size(cross(axis, at(p)));
                        let number = Some(Number::Length(near(away, below).max(1)));
                        push("distances", vec![Point(p), Axis(k)], number);
                        1
                    }
                    1 => {
                        push("on", vec![Point(p), Axis(k)], None);
                        d - 1
                    }
                    2 => {
                        lines.push([p, q]);
                        push("parallel", vec![Axis(k), Line(line)], None);
                        d - 1
                    }
                    3 => {
                        lines.push([p, q]);
                        push("perpendicular", vec![Line(line), Axis(k)], None);
                        1
                    }
                    4 if d == 2 => {
                        circles.push((p, near(0.6 * size(span(p, q)), below)));
                        push("on", vec![Point(q), Circle(circle)], None);
                        push("tangent", vec![Circle(circle), Axis(k)], None);
                        1
                    }
                    _ => {
                        lines.push([p, q]);
                        let degrees = near(angle(axis, span(p, q)), below);
                        let number = Some(Number::Degrees(degrees.clamp(2_000, 178_000)));
                        push("angles", vec![Line(line), Axis(k)], number);
                        1
                    }
                }
            }
            _ => return,
        };
        // Distances go within a body first, then in pairs of points that the constraint names, as far as there are such.
        for _ in 0..freedom {
            if self.distances.len() <= 1 {
                break;
            }
            let within =
                |&(a, b, _): &(usize, usize, i64)| rigid.contains(&a) && rigid.contains(&b);
            let concerns = |&(a, b, _): &(usize, usize, i64)| {
                [p, q, r].contains(&a) && [p, q, r, s].contains(&b)
            };
            let index = self.distances.iter().position(within);
            let index = index.or_else(|| self.distances.iter().position(concerns));
            let index = index.unwrap_or_else(|| below(self.distances.len()));
            self.distances.swap_remove(index);
        }
        if let Some(q) = beside {
            let place = off(self.at(q), below);
            self.points.push(place);
            let mut distances = self.distances.iter_mut();
            if let Some((a, b, _)) = distances.find(|(a, b, _)| *a == q || *b == q) {
                let other = if *a == q { *b } else { *a };
                (*a, *b) = (other, n);
            }
        }
        self.arcs.extend(arcs);
        self.bodies.extend(bodies);
        self.free_lines.extend(free_lines);
        self.free_planes.extend(free_planes);
        self.lines.extend(lines);
        self.planes.extend(planes);
        self.circles.extend(circles);
        self.constraints.extend(add);
    }
}
