//! Bodies with joints: their tables in problem files, robots as tables of Denavit and Hartenberg, and where bodies are in the sketch.

use super::builder::{ProblemBuilder, number};
use super::cursor::At;
use super::draft::DraftShape;
use super::error::Place;
use super::file::{FileError, Reader};
use super::{Decimal, DecimalError, JointSort, Numeral, Object, Point, Pose, ProblemError, Shape};
use crate::constraint::{base_of, vector};
use crate::interval::vector::{cross, dot, length, minus, out_of};
use crate::map::Map;
use crate::order::InOrder as _;
use crate::places::{Each as _, array};
use std::collections::HashMap;

/// How a joint is written.
pub(super) const WANTED: &str = "{ revolute = [\"body\", \"body\"], at = [[0, 0, 0], [0, 0, 0]], z = [[0, 0, 1], [0, 0, 1]], x = [[1, 0, 0], [1, 0, 0]] }";

/// A frame in floats: the origin, and three axes.
type Motion = ([f64; 3], [[f64; 3]; 3]);

impl Pose {
    /// A frame, with what its origin, its z axis and its x axis are.
    ///
    /// # Errors
    /// If a number is no finite decimal.
    pub fn new<N: Numeral>(at: [N; 3], z: [N; 3], x: [N; 3]) -> Result<Self, DecimalError> {
        let three = |of: [N; 3]| -> Result<[Decimal; 3], DecimalError> {
            let [x, y, z] = of.map(number);
            Ok([x?, y?, z?])
        };
        Ok(Pose {
            at: three(at)?,
            z: three(z)?,
            x: three(x)?,
        })
    }

    /// The frame in which everything is given.
    pub fn identity() -> Self {
        Self::new([0, 0, 0], [0, 0, 1], [1, 0, 0]).expect("whole numbers are decimals")
    }

    /// Where z is along x, x is y: any direction across will do where none is given.
    fn turn_x_aside(&mut self) {
        if self.z[1..].iter().all(|c| *c == Decimal::from(0)) {
            self.x = [0, 1, 0].map(Decimal::from);
        }
    }

    fn floats(&self) -> Motion {
        let [at, z, x] = [&self.at, &self.z, &self.x].map(floats);
        (at, frame_of(z, x))
    }

    fn of_floats((at, axes): &Motion) -> Self {
        // Of directions fifteen digits: what should be 0 mostly is then.
        let rounded = |v: &[f64; 3]| v.map(|x| to_decimal((x * 1e15).round() / 1e15));
        Pose {
            at: at.map(to_decimal),
            z: rounded(&axes[2]),
            x: rounded(&axes[0]),
        }
    }
}

fn floats(of: &[Decimal; 3]) -> [f64; 3] {
    of.each_ref().each(|x| x.to_f64())
}

/// The axes of a frame with this z axis, and the x axis on that side of it; the identity's where the two are parallel.
fn frame_of(z: [f64; 3], x: [f64; 3]) -> [[f64; 3]; 3] {
    let y = cross(z, x);
    if length(y) == 0.0 {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let unit = |v: [f64; 3]| v.map(|x| x / length(v));
    let (y, z) = (unit(y), unit(z));
    [cross(y, z), y, z]
}

/// One frame in another.
fn then(first: &Motion, second: &Motion) -> Motion {
    let turned = |v: &[f64; 3]| out_of(&first.1, v);
    let at = turned(&second.0);
    (
        array(|k| first.0[k] + at[k]),
        second.1.each_ref().map(turned),
    )
}

/// What undoes a motion.
fn back((at, axes): &Motion) -> Motion {
    let turned: [[f64; 3]; 3] = array(|i| array(|k| axes[k][i]));
    let at = axes.each_ref().map(|axis| -dot(*axis, *at));
    (at, turned)
}

/// A turn about z by degrees, and a travel along it.
fn screw(degrees: f64, travel: f64) -> Motion {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    (
        [0.0, 0.0, travel],
        [[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]],
    )
}

/// What is said of joints beside what they are.
#[derive(Debug, Clone, Default)]
pub(super) struct Drawn {
    /// Where bodies are in the sketch, by name.
    places: Map<String, Pose>,
    /// What joints measure in the sketch, by name: degrees, of prismatic ones a length.
    values: HashMap<String, Decimal>,
}

impl ProblemBuilder {
    /// Adds a joint between two bodies, with its frame in either of them.
    ///
    /// ```
    /// use krawl::problem::{JointSort, Pose, Problem};
    /// let pin = |at| Pose::new(at, [0, 0, 1], [1, 0, 0]).unwrap();
    /// let crank = Problem::build("crank", 2)
    ///     .point("tip", [2, 1])
    ///     .body("ground", [("ground", [0, 0]); 0]).body("bar", [("tip", [3, 0])])
    ///     .joint("hinge", JointSort::Revolute, ["ground", "bar"], [pin([0, 0, 0]), pin([0, 0, 0])])
    ///     .dimension("turns", ["hinge"], 30)
    ///     .finish().unwrap();
    /// assert!(crank.has_joints());
    /// ```
    pub fn joint(self, name: &str, sort: JointSort, bodies: [&str; 2], frames: [Pose; 2]) -> Self {
        let bodies = bodies.map(str::to_owned);
        self.object(name, DraftShape::Joint(sort, bodies, Box::new(frames)))
    }

    /// Says where a body with joints is in the sketch. Left out, it is where joints have it.
    pub fn place(mut self, body: &str, place: Pose) -> Self {
        self.drawn.places.insert(body.to_owned(), place);
        self
    }

    /// Says how far a joint is turned in the sketch, in degrees, or how far a prismatic one is drawn out. Left out, it is 0.
    pub fn joint_in_sketch(mut self, joint: &str, value: Decimal) -> Self {
        self.drawn.values.insert(joint.to_owned(), value);
        self
    }

    /// Gives all bodies with joints their places in the sketch.
    pub(super) fn place_bodies(
        &self,
        points: &[Point],
        objects: &mut [Object],
    ) -> Result<(), ProblemError> {
        let mut known: HashMap<usize, Motion> = HashMap::new();
        for (index, (name, pose)) in self.drawn.places.iter().enumerate() {
            let is_it = |object: &Object| object.name == *name;
            match objects.iter().position(is_it) {
                Some(body) if matches!(objects[body].shape, Shape::Body { .. }) => {
                    known.insert(body, pose.floats());
                }
                _ => {
                    let is_body = |o: &&Object| matches!(o.shape, Shape::Body { .. });
                    let bodies = objects.iter().filter(is_body).map(|o| o.name.as_str());
                    let what = "the table of places";
                    let place = Place::Pose(index);
                    return Err(ProblemError::unknown(place, what, ("body", name), bodies));
                }
            }
        }
        let joints: Vec<(JointSort, [usize; 2], [Motion; 2], f64)> = objects
            .iter()
            .filter_map(|object| match &object.shape {
                Shape::Joint {
                    sort,
                    bodies,
                    frames,
                } => {
                    let value = self.drawn.values.get(&object.name);
                    let value = value.map_or(0.0, Decimal::to_f64);
                    let frames = frames.each_ref().map(Pose::floats);
                    Some((*sort, *bodies, frames, value))
                }
                _ => None,
            })
            .collect();
        let joined: Vec<usize> = (0..objects.len())
            .filter(|body| {
                let of = |joint: &(_, [usize; 2], _, _)| joint.1.contains(body);
                known.contains_key(body) || joints.iter().any(of)
            })
            .collect();
        for &body in &joined {
            if let (
                false,
                Shape::Body {
                    points: members,
                    local,
                    ..
                },
            ) = (known.contains_key(&body), &objects[body].shape)
                && let Some(motion) = fitted(self.dimension, points, members, local)
            {
                known.insert(body, motion);
            }
        }
        // From a body that stands on, along the joints.
        let is_fixed = |body: usize| self.is_fixed(&objects[body].name);
        let ground = joined.iter().copied().find(|&body| is_fixed(body));
        let Some(ground) = ground.or(joined.first().copied()) else {
            return Ok(());
        };
        let identity = Pose::identity().floats();
        let drawn = match &objects[ground].shape {
            // Points that do not tell how it is turned tell where it is.
            Shape::Body {
                points: members,
                local,
                ..
            } if !members.is_empty() => {
                let at = minus(points[members[0]].place(), floats(&local[0]));
                (at, identity.1)
            }
            _ => identity,
        };
        known.entry(ground).or_insert(drawn);
        let mut reached = vec![ground];
        let mut next = 0;
        loop {
            while next < reached.len() {
                let body = reached[next];
                next += 1;
                for (sort, bodies, frames, value) in &joints {
                    let Some(side) = bodies.iter().position(|&b| b == body) else {
                        continue;
                    };
                    let other = bodies[1 - side];
                    if reached.contains(&other) {
                        continue;
                    }
                    if !known.contains_key(&other) {
                        let between = between(*sort, *value, self.dimension);
                        let here = then(&known[&body], &frames[side]);
                        let there = match side {
                            0 => then(&here, &between),
                            _ => then(&here, &back(&between)),
                        };
                        known.insert(other, then(&there, &back(&frames[1 - side])));
                    }
                    reached.push(other);
                }
            }
            // What no joint connects with those.
            let left = joined.iter().find(|body| !reached.contains(body));
            let Some(&left) = left else { break };
            known.entry(left).or_insert(identity);
            reached.push(left);
        }
        for body in joined {
            let given = self.drawn.places.get(&objects[body].name).cloned();
            if let Shape::Body { place, .. } = &mut objects[body].shape {
                let pose = given.unwrap_or_else(|| Pose::of_floats(&known[&body]));
                *place = Some(Box::new(pose));
            }
        }
        Ok(())
    }
}

/// The second frame of a joint in the first one, where it measures `value`.
fn between(sort: JointSort, value: f64, dimension: usize) -> Motion {
    match sort {
        JointSort::Prismatic if dimension == 2 => ([value, 0.0, 0.0], screw(0.0, 0.0).1),
        JointSort::Prismatic => screw(0.0, value),
        // The second one's z axis is along the first one's y axis.
        JointSort::Universal => (
            [0.0; 3],
            [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
        ),
        sort if sort.turns() => screw(value, 0.0),
        _ => screw(0.0, 0.0),
    }
}

/// Where a body is whose points are drawn, if they tell it.
fn fitted(
    dimension: usize,
    points: &[Point],
    members: &[usize],
    local: &[[Decimal; 3]],
) -> Option<Motion> {
    let drawn: Vec<_> = members.iter().map(|&p| vector(&points[p].sketch)).collect();
    let own: Vec<_> = local.iter().map(vector).collect();
    let base = base_of(dimension, &own, &drawn).ok()?;
    let frame = |at: [f64; 3], others: &[[f64; 3]]| match *others {
        [one] => (at, frame_of([0.0, 0.0, 1.0], minus(one, at))),
        _ => {
            let [x, y] = [0, 1].map(|k| minus(others[k], at));
            (at, frame_of(cross(x, y), x))
        }
    };
    let there: Vec<_> = base.iter().map(|&k| points[members[k]].place()).collect();
    let here: Vec<_> = base.iter().map(|&k| floats(&local[k])).collect();
    let [there, here] = [there, here].map(|places| frame(places[0], &places[1..]));
    Some(then(&there, &back(&here)))
}

impl Reader<'_> {
    /// The table `places`.
    pub(super) fn places_of_bodies(&mut self) -> Result<(), FileError> {
        let Some(table) = self.root.get("places") else {
            return Ok(());
        };
        let wanted = "{ at = [0, 0, 0], z = [0, 0, 1], x = [1, 0, 0] }";
        let mut lines = Vec::new();
        for (name, at) in table.entries()? {
            let wrong = || at.wrong(wanted);
            if !at.item.is_table_like() {
                return Err(wrong());
            }
            at.known_keys(&["at", "z", "x"])?;
            let dimension = self.builder.dimension;
            let of = |part: &str| {
                let part = at.get(part);
                part.map(|part| three(&part, dimension, wrong)).transpose()
            };
            let identity = Pose::identity();
            let mut pose = Pose {
                at: of("at")?.unwrap_or(identity.at),
                z: of("z")?.unwrap_or(identity.z),
                x: identity.x,
            };
            match of("x")? {
                Some(x) => pose.x = x,
                None => pose.turn_x_aside(),
            }
            self.add(&at, |builder| Ok(builder.place(name, pose)))?;
            lines.push((name, at.line));
        }
        lines.order_by_key(|&(name, _)| name);
        let lines = lines.into_iter().enumerate();
        let places = lines.map(|(index, (_, line))| (Place::Pose(index), (String::new(), line)));
        self.places.extend(places);
        Ok(())
    }
}

/// A list of numbers: as many as there are dimensions, the rest zero; or three.
fn three(
    at: &At,
    dimension: usize,
    wrong: impl Fn() -> FileError,
) -> Result<[Decimal; 3], FileError> {
    let list = at.list("").map_err(|_| wrong())?;
    if list.len() != dimension && list.len() != 3 {
        return Err(wrong());
    }
    let mut three = [0, 0, 0].map(Decimal::from);
    for (three, value) in three.iter_mut().zip(&list) {
        *three = value.number()?;
    }
    Ok(three)
}

/// A joint of the table `joints`.
pub(super) fn joint(
    name: &str,
    at: &At,
    builder: ProblemBuilder,
) -> Result<ProblemBuilder, FileError> {
    let wrong = || at.wrong(WANTED);
    if !at.item.is_table_like() {
        return Err(wrong());
    }
    let sorts = JointSort::ALL.map(JointSort::name);
    let given = JointSort::ALL
        .into_iter()
        .filter_map(|sort| Some((sort, at.get(sort.name())?)));
    let given: Vec<(JointSort, At)> = given.collect();
    if given.is_empty() {
        return Err(at.wrong(&format!(
            "{WANTED}, with one of {} in front",
            sorts.join(", ")
        )));
    }
    at.known_keys(&[&sorts[..], &["at", "z", "x", "sketch"]].concat())?;
    let [(sort, bodies)] = &given[..] else {
        return Err(wrong());
    };
    let [first, second] = bodies.texts("").map_err(|_| wrong())?[..] else {
        return Err(wrong());
    };
    let identity = Pose::identity();
    let mut frames = [identity.clone(), identity];
    for (part, of) in [
        ("at", (|p| &mut p.at) as fn(&mut Pose) -> &mut [Decimal; 3]),
        ("z", |p| &mut p.z),
        ("x", |p| &mut p.x),
    ] {
        let Some(part) = at.get(part) else {
            continue;
        };
        let list = part.list("").map_err(|_| wrong())?;
        if list.len() != 2 {
            return Err(wrong());
        }
        for (frame, value) in frames.iter_mut().zip(&list) {
            *of(frame) = three(value, builder.dimension, wrong)?;
        }
    }
    // Where only the axis is given, any direction across it will do.
    if at.get("x").is_none() {
        frames.iter_mut().for_each(Pose::turn_x_aside);
    }
    let builder = builder.joint(name, *sort, [first, second], frames);
    Ok(match at.get("sketch") {
        Some(value) => builder.joint_in_sketch(name, value.number()?),
        None => builder,
    })
}

/// The robots of a file: of each joint its row of Denavit and Hartenberg.
pub(super) fn robots<'a>(root: &At<'a>) -> Result<Vec<Robot<'a>>, FileError> {
    let Some(table) = root.get("robots") else {
        return Ok(Vec::new());
    };
    let wanted = "a row for each joint, [{ d = 0.4, alpha = 90 }, { a = 0.3, theta = 20 }, { prismatic = true, d = 0.1 }]";
    let robots = table.entries()?.into_iter().map(|(name, at)| {
        let wrong = || at.wrong(wanted);
        let rows = at.list(wanted)?.into_iter().map(|row| {
            if !row.item.is_table_like() {
                return Err(wrong());
            }
            row.known_keys(&["theta", "d", "a", "alpha", "prismatic"])?;
            let of = |part: &str| match row.get(part) {
                None => Ok(Decimal::from(0)),
                Some(value) => value.number(),
            };
            let is_prismatic = match row.get("prismatic") {
                None => false,
                Some(value) => value.item.as_bool().ok_or_else(wrong)?,
            };
            Ok(Row {
                theta: of("theta")?,
                d: of("d")?,
                a: of("a")?,
                alpha: of("alpha")?,
                is_prismatic,
            })
        });
        let rows = rows.collect::<Result<Vec<_>, FileError>>()?;
        match rows.is_empty() {
            true => Err(wrong()),
            false => Ok(Robot { name, at, rows }),
        }
    });
    robots.collect()
}

/// A robot whose joints are given as a table.
pub(super) struct Robot<'a> {
    name: &'a str,
    /// Where it is in the file.
    pub at: At<'a>,
    rows: Vec<Row>,
}

/// A joint and the link behind it (J. Denavit and R. S. Hartenberg 1955): a turn by theta about z, a travel d along it, a travel a along the new x axis,
/// a turn by alpha about that.
struct Row {
    theta: Decimal,
    d: Decimal,
    a: Decimal,
    alpha: Decimal,
    is_prismatic: bool,
}

impl Robot<'_> {
    /// Adds its bodies: `name_0`, which is the first, to `name_n`.
    pub fn add_bodies(&self, builder: ProblemBuilder) -> ProblemBuilder {
        (0..=self.rows.len()).fold(builder, |builder, k| {
            builder.body(&format!("{}_{k}", self.name), [("", [0]); 0])
        })
    }

    /// Adds its joints: `name_j1` to `name_jn`. In the link behind a joint its frame is where the link's own frame, which is that of the next joint, sees
    /// it.
    pub fn add_joints(&self, builder: ProblemBuilder) -> ProblemBuilder {
        let zero = || Decimal::from(0);
        let mut builder = builder;
        for (k, row) in self.rows.iter().enumerate() {
            let [sine, cosine] = sine_and_cosine(&row.alpha);
            // Seen from the link's frame, z goes back by alpha; x is the same.
            let z = [zero(), sine.clone(), cosine.clone()];
            // −a x − d z; of a prismatic joint d is its travel.
            let d = match row.is_prismatic {
                true => zero(),
                false => row.d.clone(),
            };
            let at = [
                negated(&row.a),
                product(&negated(&d), &sine),
                product(&negated(&d), &cosine),
            ];
            let behind = Pose {
                at,
                z,
                x: [1, 0, 0].map(Decimal::from),
            };
            let mut before = Pose::identity();
            let (sort, value) = match row.is_prismatic {
                true => {
                    let [sine, cosine] = sine_and_cosine(&row.theta);
                    before.x = [cosine, sine, zero()];
                    (JointSort::Prismatic, &row.d)
                }
                false => (JointSort::Revolute, &row.theta),
            };
            let name = format!("{}_j{}", self.name, k + 1);
            let bodies = [k, k + 1].map(|k| format!("{}_{k}", self.name));
            let bodies = bodies.each_ref().map(|body| &**body);
            builder = builder.joint(&name, sort, bodies, [before, behind]);
            builder = builder.joint_in_sketch(&name, value.clone());
        }
        builder
    }
}

fn negated(of: &Decimal) -> Decimal {
    let text = of.text();
    let text = match text.strip_prefix('-') {
        Some(text) => text.to_owned(),
        None => format!("-{}", text.strip_prefix('+').unwrap_or(text)),
    };
    text.parse()
        .expect("a decimal with its sign changed is one")
}

/// A product of decimals, to 17 digits where one of them is no 0, 1 or −1.
fn product(a: &Decimal, b: &Decimal) -> Decimal {
    if *b == Decimal::from(0) {
        Decimal::from(0)
    } else if *b == Decimal::from(1) {
        a.clone()
    } else if *b == Decimal::from(-1) {
        negated(a)
    } else {
        to_decimal(a.to_f64() * b.to_f64())
    }
}

fn to_decimal(x: f64) -> Decimal {
    // Not −0.
    Decimal::try_from(x + 0.0).unwrap_or(Decimal::from(0))
}

/// The sine and the cosine of an angle in degrees: exact where it is a multiple of 90, and otherwise to 17 digits.
fn sine_and_cosine(degrees: &Decimal) -> [Decimal; 2] {
    let x = degrees.to_f64();
    match x.rem_euclid(360.0) {
        0.0 => [0, 1].map(Decimal::from),
        90.0 => [1, 0].map(Decimal::from),
        180.0 => [0, -1].map(Decimal::from),
        270.0 => [-1, 0].map(Decimal::from),
        _ => [x.to_radians().sin(), x.to_radians().cos()].map(to_decimal),
    }
}
