//! The unknowns and equations of bodies with joints: see [`crate::constraint::assembly`].

use super::super::assembly::{Assembly, Exact, Turned, axes, drawn, exact, joints, out_of};
use super::super::frame::{self, Vector, dot, minus, plus};
use super::super::objects::turned;
use super::super::quadratic::{Entry, Form, Posed, Product, value};
use super::{Arrow, Fault, Lowering, Parity, Place};
use crate::interval::Real;
use crate::order::InOrder;
use crate::places::Each as _;
use crate::rational::Rational;
use crate::statement::{Constraint, Item, JointSort, Shape};
use num_traits::ToPrimitive;
use std::array::from_fn;
use std::rc::Rc;

/// Whole numbers up to this are factors of products.
const LARGEST: i64 = 100;

/// Bodies with joints, as equations see them.
pub struct Assembled {
    plan: Assembly,
    /// Of each group how it is turned.
    groups: Vec<Frame>,
    /// The axes of joints.
    axes: Vec<Arrow>,
    /// The origins of the bodies, in the order of the plan.
    origins: Vec<Origin>,
    /// Of joints with a travel that is an unknown, by number among the objects: it, and its value in the sketch.
    travels: Vec<(usize, Entry, Rational)>,
}

/// How bodies that always turn together are turned.
enum Frame {
    /// They stand: their axes in the user's frame.
    Stands(Turned),
    /// In the plane along a unit vector.
    Plane(Arrow),
    /// In space along two unit vectors, which have these coordinates in the group, and this product; with the cross product where it is used.
    Space {
        along: Box<[Arrow; 2]>,
        basis: [Exact; 2],
        product: Real,
    },
}

/// The origin of a body.
enum Origin {
    /// It stands.
    Stands(Exact),
    /// Its coordinates are unknowns.
    Moves(Place),
}

/// A vector: a constant, and multiples of others.
struct Sum {
    constant: Exact,
    parts: Vec<(Real, Arrow)>,
}

impl Sum {
    fn constant(constant: Exact) -> Self {
        Sum {
            constant,
            parts: Vec::new(),
        }
    }

    fn of(parts: Vec<(Real, Arrow)>) -> Self {
        Sum {
            constant: std::array::from_fn(|_| Real::zero()),
            parts: parts.into_iter().filter(|(c, _)| !c.is_zero()).collect(),
        }
    }

    fn one(arrow: Arrow) -> Self {
        Sum::of(vec![(Real::whole(1), arrow)])
    }

    fn minus(mut self, other: Sum) -> Self {
        let back = Real::whole(-1);
        self.constant = minus(&self.constant, &other.constant);
        let parts = other.parts.into_iter();
        self.parts
            .extend(parts.map(|(c, arrow)| (&back * &c, arrow)));
        self
    }

    fn plus(mut self, other: Sum) -> Self {
        self.constant = plus(&self.constant, &other.constant);
        self.parts.extend(other.parts);
        self
    }

    /// Where it is in the sketch, nearly.
    fn at(&self) -> Vector {
        let start = self.constant.each_ref().map(near);
        self.parts.iter().fold(start, |sum, (c, arrow)| {
            frame::plus(&sum, &frame::times(&near(c), &arrow.at))
        })
    }
}

/// A ratio next to a number: where a path begins need be no more exact.
fn near(of: &Real) -> Rational {
    match of.as_rational() {
        Some(exact) => exact.clone(),
        None => Rational::from_float(of.enclose().mid()).unwrap_or_default(),
    }
}

impl Lowering<'_> {
    /// The bodies with joints; their unknowns and equations come to be where they are asked for first.
    pub fn assembled(&mut self) -> Result<Rc<Assembled>, Fault> {
        if let Some(known) = &self.assembled {
            return Ok(known.clone());
        }
        let owner = self.owner;
        let plan = Assembly::of(self.problem).map_err(|(object, fault)| {
            let object = &self.problem.objects[object];
            match object.name
                == self.problem.objects[owner.min(self.problem.objects.len() - 1)].name
            {
                true => fault,
                false => format!("`{}`: {fault}", object.name),
            }
        })?;
        let made = Rc::new(self.assemble(plan)?);
        self.owner = owner;
        self.assembled = Some(made.clone());
        Ok(made)
    }

    fn assemble(&mut self, plan: Assembly) -> Result<Assembled, Fault> {
        let mut made = Assembled {
            plan,
            groups: Vec::new(),
            axes: Vec::new(),
            origins: Vec::new(),
            travels: Vec::new(),
        };
        for axis in 0..made.plan.axes.len() {
            let arrow = self.axis_of_joints(&made.plan, axis);
            made.axes.push(arrow);
        }
        // Axes of which the length is known: they stand, or equations told them before. One that tells another one before it is told itself has an equation
        // of its length, as otherwise two could tell each other, and be of any length.
        let mut is_told: Vec<bool> = made.plan.axes.iter().map(|a| a.stands.is_some()).collect();
        for group in made.plan.groups.iter().filter(|g| g.stands.is_some()) {
            group
                .again
                .iter()
                .for_each(|&(_, axis, _)| is_told[axis] = true);
        }
        for group in 0..made.plan.groups.len() {
            let frame = self.frame_of_group(&made, group, &mut is_told);
            made.groups.push(frame);
        }
        for member in 0..made.plan.members.len() {
            let origin = self.origin_of_body(&made.plan, member);
            made.origins.push(origin);
        }
        self.say_again(&made);
        for joint in 0..made.plan.joints.len() {
            self.join(&mut made, joint)?;
        }
        for member in 0..made.plan.members.len() {
            self.place_points(&made, member);
        }
        self.tell_poses(&made);
        Ok(made)
    }

    /// A place or direction of a body: unknowns. No reversal of an axis changes them: bodies with joints are where they are, and not mirrored.
    fn of_body(&mut self, name: &str, power: i32, at: Exact) -> [Entry; 3] {
        self.components(name, power, at, |_| [false; 3])
    }

    /// A vector that stands.
    fn standing(&mut self, name: &str, v: &Exact) -> Arrow {
        let forms = from_fn(|k| match v[k].as_rational() {
            _ if k >= self.dimension() => value(Entry::Zero),
            Some(x) if x.is_zero() => value(Entry::Zero),
            Some(x) if x.is_one() => Form::One,
            _ => {
                let name = format!("{name}, {}", ["x", "y", "z"][k]);
                value(self.coefficient(&name, 0, Parity::Even, vec![v[k].clone()]))
            }
        });
        unit_vector(name, forms, v.each_ref().map(near))
    }

    /// A unit vector that is an unknown, with where it is in the sketch.
    fn moving(&mut self, name: &str, at: Exact) -> Arrow {
        let at = at.each_ref().map(near);
        let seen = at.clone().map(Real::from);
        let entries = self.of_body(name, 0, seen);
        unit_vector(name, entries.each(value), at)
    }

    fn axis_of_joints(&mut self, plan: &Assembly, axis: usize) -> Arrow {
        let of = &plan.axes[axis];
        self.begin(of.joint);
        let name = format!("the axis of {}", self.problem.objects[of.joint].name);
        if let Some(stands) = &of.stands {
            return self.standing(&name, stands);
        }
        let mut groups = plan.groups.iter().enumerate();
        let (group, direction) = groups
            .find_map(|(g, group)| {
                let mut axes = group.axes.iter();
                let (_, direction) = axes.find(|&&(other, _)| other == axis)?;
                Some((g, direction))
            })
            .expect("an axis is one of a group");
        let at = out_of(&drawn(self.problem, plan.groups[group].body), direction);
        self.moving(&name, at)
    }

    fn has_length_one(&mut self, of: &Arrow) {
        let name = format!("{} has the length 1", of.name);
        let products = self.dot(1, &of.forms, &of.forms);
        self.say(&name, products, Real::whole(1), 0);
    }

    fn have_product(&mut self, a: &Arrow, b: &Arrow, product: Real) {
        let name = format!("the angle between {} and {}", a.name, b.name);
        let products = self.dot(1, &a.forms, &b.forms);
        self.say(&name, products, product, 0);
    }

    /// How a group is turned, with the unknowns and equations that tell it.
    fn frame_of_group(&mut self, made: &Assembled, group: usize, is_told: &mut [bool]) -> Frame {
        let plan = &made.plan;
        let of = &plan.groups[group];
        if let Some(stands) = &of.stands {
            return Frame::Stands(stands.clone());
        }
        self.begin(of.body);
        let name = self.problem.objects[of.body].name.clone();
        let drawn = drawn(self.problem, of.body);
        if self.dimension() == 2 {
            let along = self.moving(&format!("the x axis of {name}"), drawn[0].clone());
            self.has_length_one(&along);
            return Frame::Plane(along);
        }
        let own = |low: &mut Self, direction: &Exact, which: &str| {
            let at = out_of(&drawn, direction);
            let arrow = low.moving(&format!("{which} of {name}"), at);
            low.has_length_one(&arrow);
            arrow
        };
        let zero = Real::zero();
        let stands = |axes: [usize; 2]| axes.map(|axis| plan.axes[axis].stands.is_some());
        // What is told already first, so that this group tells the others.
        let mut axes = of.axes.clone();
        axes.order_by_key(|&(axis, _)| !is_told[axis]);
        let (basis, along, product, by) = match &axes[..] {
            [] => {
                let basis = [0, 1].map(|k| from_fn(|i| Real::whole(i64::from(i == k))));
                let x = own(self, &basis[0], "the x axis");
                let y = own(self, &basis[1], "the y axis");
                self.have_product(&x, &y, zero.clone());
                (basis, [x, y], zero, 0)
            }
            // Where both are told their product is all that is left to say.
            [(first, e), (second, f), ..]
                if stands([*first, *second]) != [true, true]
                    && (are_apart(e, f, 0.75) || is_told[*second] && are_apart(e, f, 1.0)) =>
            {
                let product = dot(e, f);
                let arrows = [first, second].map(|&axis| made.axes[axis].clone());
                self.have_product(&arrows[0], &arrows[1], product.clone());
                ([e.clone(), f.clone()], arrows, product, 2)
            }
            [(axis, direction), ..] => {
                let across = plan.beside(self.problem, group, direction);
                let beside = own(self, &across, "a direction");
                let axis = made.axes[*axis].clone();
                self.have_product(&axis, &beside, zero.clone());
                ([direction.clone(), across], [axis, beside], zero, 1)
            }
        };
        for (axis, _) in axes.iter().take(by) {
            if !std::mem::replace(&mut is_told[*axis], true) {
                self.begin(plan.axes[*axis].joint);
                self.has_length_one(&made.axes[*axis].clone());
            }
        }
        let frame = Frame::Space {
            along: Box::new(along),
            basis,
            product,
        };
        for (axis, direction) in axes.iter().skip(by) {
            let arrow = made.axes[*axis].clone();
            let name = format!("{} in {name}", arrow.name);
            let told = Sum::one(arrow);
            self.begin(plan.axes[*axis].joint);
            let by = self.vector(&frame, direction);
            self.vanish_all(&name, told.minus(by), 0);
            is_told[*axis] = true;
        }
        frame
    }

    /// What is told in two ways that are not known to agree.
    fn say_again(&mut self, made: &Assembled) {
        for (group, of) in made.plan.groups.iter().enumerate() {
            for (joint, axis, direction) in &of.again {
                self.begin(*joint);
                let name = format!("{} again", made.axes[*axis].name);
                let told = Sum::one(made.axes[*axis].clone());
                let by = self.vector(&made.groups[group], direction);
                self.vanish_all(&name, told.minus(by), 0);
            }
        }
        for (joint, group, vector) in &made.plan.closing {
            self.begin(*joint);
            let name = format!("{} keeps directions", self.problem.objects[*joint].name);
            let sum = self.vector(&made.groups[*group], vector);
            self.vanish_all(&name, sum, 0);
        }
        for (body, vector) in &made.plan.standing {
            self.begin(*body);
            let name = format!("{} stands", self.problem.objects[*body].name);
            let sum = Sum::constant(vector.clone());
            self.vanish_all(&name, sum, 0);
        }
    }

    /// A vector of a group, by its coordinates in it.
    fn vector(&mut self, frame: &Frame, v: &Exact) -> Sum {
        match frame {
            Frame::Stands(turned) => Sum::constant(out_of(turned, v)),
            Frame::Plane(along) => {
                let [x, y, _] = along.forms;
                let turned = Arrow {
                    forms: [turned(y), x, value(Entry::Zero)],
                    at: [-&along.at[1], along.at[0].clone(), frame::zero()],
                    ..along.clone()
                };
                let parts = vec![(v[0].clone(), along.clone()), (v[1].clone(), turned)];
                Sum::of(parts)
            }
            Frame::Space {
                along,
                basis,
                product,
            } => {
                let [e, f] = &**along;
                let [on_e, on_f, on_both] = Assembly::along(basis, product, v);
                let mut parts = vec![(on_e, e.clone()), (on_f, f.clone())];
                if !on_both.is_zero() {
                    let name = format!("{} × {}", e.name, f.name);
                    parts.push((on_both, self.cross(e, f, name)));
                }
                Sum::of(parts)
            }
        }
    }

    /// A direction of a body, by its coordinates in the body's frame, as one vector.
    pub fn direction_of(&mut self, made: &Assembled, body: usize, v: &Exact) -> Arrow {
        let member = made.plan.member(body);
        let sum = self.vector(&made.groups[member.group], &out_of(&member.turned, v));
        let name = format!("a direction of {}", self.problem.objects[body].name);
        match &sum.parts[..] {
            [] => return self.standing(&name, &sum.constant),
            [(one, arrow)] if one.as_rational().is_some_and(Rational::is_one) => {
                return arrow.clone();
            }
            _ => {}
        }
        let at = sum.at().map(Real::from);
        let arrow = self.moving(&name, at);
        let told = Sum::one(arrow.clone());
        self.vanish_all(&name, told.minus(sum), 0);
        arrow
    }

    fn origin_of_body(&mut self, plan: &Assembly, member: usize) -> Origin {
        let body = plan.members[member].body;
        self.begin(body);
        let place = self.problem.objects[body].place();
        let at = exact(&place.expect("a body with joints").at);
        if self.problem.standing_bodies().contains(&body) {
            return Origin::Stands(at);
        }
        let name = format!("the origin of {}", self.problem.objects[body].name);
        let entries = self.of_body(&name, 1, at.clone());
        Origin::Moves(Place {
            entries,
            at: at.each_ref().map(near),
        })
    }

    /// A place of a body, by its coordinates in the body's frame.
    fn place_of(&mut self, made: &Assembled, body: usize, local: &Exact) -> Sum {
        let index = made.plan.members.iter().position(|m| m.body == body);
        let index = index.expect("a body with joints");
        let member = &made.plan.members[index];
        let from = self.vector(&made.groups[member.group], &out_of(&member.turned, local));
        let origin = match &made.origins[index] {
            Origin::Stands(at) => Sum::constant(at.clone()),
            Origin::Moves(place) => Sum::one(self.to(place)),
        };
        origin.plus(from)
    }

    /// From the user's origin to a place.
    fn to(&self, place: &Place) -> Arrow {
        Arrow {
            forms: place.entries.each(value),
            at: place.at.clone(),
            power: 1,
            axial: false,
            name: String::new(),
            known: None,
        }
    }

    /// A vector as three numbers that equations can multiply.
    fn as_place(&mut self, name: &str, sum: Sum) -> Place {
        let at = sum.at();
        let entries = self.of_body(name, 1, at.clone().map(Real::from));
        let place = Place { entries, at };
        let told = Sum::one(self.to(&place));
        self.vanish_all(name, told.minus(sum), 1);
        place
    }

    /// The equations of a joint.
    fn join(&mut self, made: &mut Assembled, number: usize) -> Result<(), Fault> {
        let (joint, ends) = made.plan.joints[number];
        self.begin(joint);
        let (_, sort, bodies, frames) = joints(self.problem)
            .find(|&(index, ..)| index == joint)
            .expect("a joint of the problem");
        let name = self.problem.objects[joint].name.clone();
        let at = frames.each_ref().map(|frame| exact(&frame.at));
        if let (JointSort::Universal, [Some((one, _)), Some((other, _))]) = (sort, ends) {
            let [one, other] = [one, other].map(|axis| made.axes[axis].clone());
            self.have_product(&one, &other, Real::zero());
        }
        let first = self.place_of(made, bodies[0], &at[0]);
        let second = self.place_of(made, bodies[1], &at[1]);
        let apart = second.minus(first);
        if matches!(sort, JointSort::Planar | JointSort::OnPlane) {
            let (axis, is_opposite) = ends[0].expect("a plane has a normal");
            self.is_in_plane(made, &name, (joint, axis, is_opposite), apart);
            return Ok(());
        }
        if !sort.travels() {
            self.vanish_all(&name, apart, 1);
            return Ok(());
        }
        let (along, sign) = match ends[0] {
            Some((axis, is_opposite)) => {
                (made.axes[axis].clone(), if is_opposite { -1 } else { 1 })
            }
            // In the plane the travel is along the x axis of the joint's frame.
            None => {
                let x = axes(&frames[0])?[0].clone();
                (self.direction_of(made, bodies[0], &x), 1)
            }
        };
        let travel = self.travel(made, joint, &apart, (&along.at, sign));
        self.vanish_with_travel(&name, apart, travel, (&along, sign));
        Ok(())
    }

    /// How far a vector goes along a unit vector in the sketch, or along the opposite one, as the travel of a joint: an unknown.
    fn travel(
        &mut self,
        made: &mut Assembled,
        joint: usize,
        apart: &Sum,
        (along, sign): (&Vector, i32),
    ) -> Entry {
        let at = dot(&apart.at(), along) * Rational::from_integer(sign.into());
        let name = format!("the travel of {}", self.problem.objects[joint].name);
        let entry = self.scalar(name, 1, Parity::Even, at.clone().into());
        made.travels.push((joint, entry, at));
        entry
    }

    /// Says that a place is in a plane through another one, or away from it by a travel where a constraint gives that.
    fn is_in_plane(
        &mut self,
        made: &mut Assembled,
        name: &str,
        (joint, axis, is_opposite): (usize, usize, bool),
        apart: Sum,
    ) {
        let sign = if is_opposite { -1 } else { 1 };
        let normal = made.axes[axis].clone();
        let is_given = |c: &Constraint| c.kind == "travels" && c.items == [Item::Object(joint)];
        let travel = match self.problem.constraints.iter().any(is_given) {
            true => Some(self.travel(made, joint, &apart, (&normal.at, sign))),
            false => None,
        };
        let across = self.as_place(&format!("across {name}"), apart);
        let mut products = self.dot(sign, &across.entries.each(value), &normal.forms);
        products.extend(travel.map(|travel| Product::new(-1, value(travel), Form::One)));
        self.say(name, products, Real::zero(), 1);
    }

    /// The travel of a joint, and what it is in the sketch.
    ///
    /// # Errors
    /// If it does not travel.
    pub fn travel_of_joint(&mut self, joint: usize) -> Result<(Entry, Real), Fault> {
        let made = self.assembled()?;
        let found = made.travels.iter().find(|&&(other, ..)| other == joint);
        match found {
            Some((_, entry, at)) => Ok((*entry, at.clone().into())),
            None => Err("the joint does not travel: name a prismatic, cylindrical or planar one, or a point on a plane".to_owned()),
        }
    }

    /// Says by how many degrees a joint is turned: the x axis of its second frame from that of the first, about z.
    ///
    /// # Errors
    /// If its bodies turn about no axis, or an edit would turn by too much at once.
    pub fn turn_of_joint(
        &mut self,
        name: &str,
        joint: usize,
        degrees: &Rational,
    ) -> Result<(), Fault> {
        let products = self.turned_products(joint)?;
        let now = products.each_ref().map(|products| self.at_sketch(products));
        self.turn_by(name, products, (now, &Real::whole(1), 0), degrees)
    }

    /// Products that are the cosine and the sine of a joint's turn.
    pub(super) fn turned_products(&mut self, joint: usize) -> Result<[Vec<Product>; 2], Fault> {
        let made = self.assembled()?;
        let (_, sort, bodies, frames) = joints(self.problem)
            .find(|&(index, ..)| index == joint)
            .expect("a joint of the problem");
        if !sort.turns() {
            return Err("the joint does not turn about one axis: name a revolute, cylindrical or planar one".to_owned());
        }
        let frames = [axes(&frames[0])?, axes(&frames[1])?];
        let x = self.direction_of(&made, bodies[0], &frames[0][0]);
        let y = self.direction_of(&made, bodies[0], &frames[0][1]);
        let other = self.direction_of(&made, bodies[1], &frames[1][0]);
        Ok([&x, &y].map(|along| self.dot(1, &along.forms, &other.forms)))
    }

    /// Points of a body are where its frame has them.
    fn place_points(&mut self, made: &Assembled, member: usize) {
        let body = made.plan.members[member].body;
        let Shape::Body { points, local, .. } = &self.problem.objects[body].shape else {
            unreachable!("a body")
        };
        for (&point, local) in points.iter().zip(local) {
            self.begin(body);
            let name = format!("{}: {}", self.problem.objects[body].name, self.name(point));
            let place = self.place(point);
            let there = Sum::one(self.to(&place));
            let by = self.place_of(made, body, &exact(local));
            self.vanish_all(&name, there.minus(by), 1);
        }
    }

    /// Tells results where bodies are.
    fn tell_poses(&mut self, made: &Assembled) {
        for (member, origin) in made.plan.members.iter().zip(&made.origins) {
            let enclosed = |v: &Exact| v.each_ref().map(Real::enclose);
            let origin = match origin {
                Origin::Stands(at) => Err(enclosed(at)),
                Origin::Moves(place) => Ok(place.entries),
            };
            let (along, axes) = match &made.groups[member.group] {
                Frame::Stands(turned) => {
                    let axes = member.turned.each_ref().map(|axis| out_of(turned, axis));
                    (Vec::new(), axes)
                }
                Frame::Plane(along) => (vec![along.forms], member.turned.clone()),
                Frame::Space {
                    along,
                    basis,
                    product,
                } => {
                    let turned = member.turned.each_ref();
                    let axes = turned.map(|axis| Assembly::along(basis, product, axis));
                    (along.each_ref().map(|arrow| arrow.forms).to_vec(), axes)
                }
            };
            let told = along.iter().flatten().flat_map(|form| form.entries());
            let told = told
                .map(|(entry, _)| entry)
                .chain(origin.into_iter().flatten());
            let told = told.filter(|entry| entry.unknown().is_some()).collect();
            self.objects.insert(member.body, told);
            self.tail.poses.push(Posed {
                body: member.body,
                origin,
                along,
                axes: axes.each_ref().map(enclosed),
            });
        }
    }

    /// Says that a vector is zero.
    fn vanish_all(&mut self, name: &str, sum: Sum, power: i32) {
        let products = self.products(name, &sum, power);
        self.vanish_each(name, products, &sum.constant, power);
    }

    /// Says that a vector is a travel along a unit vector, or along the opposite one.
    fn vanish_with_travel(
        &mut self,
        name: &str,
        sum: Sum,
        travel: Entry,
        (along, sign): (&Arrow, i32),
    ) {
        let mut products = self.products(name, &sum, 1);
        for (products, &form) in products.iter_mut().zip(&along.forms) {
            products.push(Product::new(-sign, value(travel), form));
        }
        self.vanish_each(name, products, &sum.constant, 1);
    }

    /// For each axis the products of a vector but for its constant.
    fn products(&mut self, name: &str, sum: &Sum, power: i32) -> Vec<Vec<Product>> {
        let mut products = vec![Vec::new(); self.dimension()];
        for (c, arrow) in &sum.parts {
            let whole = c.as_rational().filter(|c| c.is_integer());
            let whole = whole.and_then(|c| c.to_integer().to_i64());
            let whole = whole.filter(|c| c.abs() <= LARGEST && arrow.power == power);
            let by = match whole {
                Some(factor) => Err(factor as i32),
                None => {
                    let of = vec![c.clone()];
                    Ok(self.coefficient(
                        &format!("{name}, a length"),
                        power - arrow.power,
                        Parity::Even,
                        of,
                    ))
                }
            };
            for (products, &form) in products.iter_mut().zip(&arrow.forms) {
                products.push(match by {
                    Err(factor) => Product::new(factor, form, Form::One),
                    Ok(entry) => Product::new(1, value(entry), form),
                });
            }
        }
        products
    }

    /// Says that a vector is zero, of which the products are all but the constant.
    fn vanish_each(
        &mut self,
        name: &str,
        products: Vec<Vec<Product>>,
        constant: &Exact,
        power: i32,
    ) {
        for (products, constant) in products.into_iter().zip(constant) {
            self.say(name, products, -constant, power);
        }
    }

    /// The equation Σ products = `target`, led there from what it is in the sketch. Of numbers alone, where it does not hold by itself, it says of their
    /// difference, which has an equation of its own, that it is zero.
    fn say(&mut self, name: &str, products: Vec<Product>, target: Real, power: i32) {
        let start = self.at_sketch(&products);
        let mut factors = products.iter().flat_map(|p| [p.left, p.right]);
        if factors.any(|form| form != Form::One && form != value(Entry::Zero)) {
            return self.meet(name, products, &start, target, power);
        }
        let number = &start - &target;
        if !number.is_zero() {
            let entry = self.coefficient(name, power, Parity::Even, vec![number.clone()]);
            let products = vec![Product::new(1, value(entry), Form::One)];
            self.meet(name, products, &number, Real::zero(), power);
        }
    }
}

fn unit_vector(name: &str, forms: [Form; 3], at: Vector) -> Arrow {
    Arrow {
        forms,
        at,
        power: 0,
        axial: false,
        name: name.to_owned(),
        known: Some(vec![Real::whole(1)]),
    }
}

/// Whether the product of two unit vectors is certainly less than this: a frame is the better told along both the nearer they are to a right angle.
fn are_apart(a: &Exact, b: &Exact, than: f64) -> bool {
    dot(a, b).enclose().mag() < than
}
