//! How bodies with joints are told: which of them turn together, and along which vectors the frame of each is told.
//!
//! Where a body is turned is told by unit vectors: the axes of its joints, which it shares with the body at the other side, and where it has
//! fewer than two that are not parallel, by more of its own. Vectors in place of angles or of three points make equations of degree two, few
//! unknowns, and no length twice (J. García de Jalón and E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, chapter 2: natural
//! coordinates).

use super::frame::{cross, dot, minus, plus, times};
use super::lowering::Fault;
use crate::decimal::Decimal;
use crate::interval::Real;
use crate::statement::{JointSort, Pose, Problem, Shape};
use std::array::from_fn;
use std::collections::HashSet;

/// A vector of exact numbers.
pub type Exact = [Real; 3];
/// The axes of a frame, one after the other.
pub type Turned = [Exact; 3];

/// The vector of three decimals.
pub fn exact(of: &[Decimal; 3]) -> Exact {
    of.each_ref().map(|x| Real::from(x.value().clone()))
}

/// Whether two vectors are known to have one direction.
fn is_same_direction(a: &Exact, b: &Exact) -> bool {
    let is_parallel = is_zero(&cross(a, b)) || is_zero(&minus(a, b));
    is_parallel && dot(a, b).enclose().inf() > 0.0
}

/// Whether two vectors are not known not to be parallel. (Enclosures of exact numbers have some 70 digits.)
fn may_be_parallel(a: &Exact, b: &Exact) -> bool {
    let mut across = cross(a, b).into_iter();
    across.all(|x| {
        let ball = x.ball();
        ball.middle.abs() <= ball.radius
    })
}

/// The axes of the body at the other side of a joint that keeps directions, in the coordinates in which the body at this side has these.
fn carried(turned: &Turned, frames: &[Pose; 2], side: usize) -> Turned {
    let [here, there] = [side, 1 - side].map(|side| axes(&frames[side]).expect("checked before"));
    // The joint's axes, which both bodies have.
    let frame = here.each_ref().map(|axis| out_of(turned, axis));
    from_fn(|k| {
        let along: Exact = from_fn(|i| there[i][k].clone());
        out_of(&frame, &along)
    })
}

/// Whether all are known to be zero.
fn is_zero(a: &Exact) -> bool {
    a.iter().all(Real::is_zero)
}

/// a / |a|, where a is not zero.
fn unit(a: &Exact) -> Exact {
    let length = dot(a, a).sqrt();
    a.each_ref().map(|x| x / &length)
}

/// The vector in which a frame has these coordinates.
pub fn out_of(axes: &Turned, v: &Exact) -> Exact {
    let part = |k: usize| times(&v[k], &axes[k]);
    plus(&plus(&part(0), &part(1)), &part(2))
}

/// The axes of a pose.
///
/// # Errors
/// If two of its directions are parallel, or one is zero.
pub fn axes(pose: &Pose) -> Result<Turned, Fault> {
    let (z, x) = (exact(&pose.z), exact(&pose.x));
    let y = cross(&z, &x);
    if is_zero(&y) {
        return Err(
            "its z axis and its x axis are parallel, or one of them is zero: give two directions"
                .to_owned(),
        );
    }
    let (z, y) = (unit(&z), unit(&y));
    Ok([cross(&y, &z), y, z])
}

/// The axes of a body with joints in the sketch.
pub fn drawn(problem: &Problem, body: usize) -> Turned {
    let place = problem.objects[body].place();
    axes(place.expect("a body with joints")).expect("checked before")
}

/// A body: the bodies that turn with it, and how it is turned among them.
pub struct Member {
    /// Its number among the objects.
    pub body: usize,
    /// The number of its group.
    pub group: usize,
    /// Its axes in the coordinates of the group.
    pub turned: Turned,
}

/// Bodies that always turn together.
pub struct Group {
    /// The body whose axes its coordinates are along.
    pub body: usize,
    /// Its axes in the user's frame, where they stand.
    pub stands: Option<Turned>,
    /// The axes of joints in it that are not known to be parallel to each other, by number, and their directions in its coordinates. Where it does
    /// not stand it is told by the first two of them.
    pub axes: Vec<(usize, Exact)>,
    /// Directions that an axis has by another joint as well, which are not known to be the one above: the joint, the axis, the direction.
    pub again: Vec<(usize, usize, Exact)>,
}

/// An axis of joints: a unit vector.
pub struct Axis {
    /// The joint that it is called after, by number among the objects.
    pub joint: usize,
    /// Its direction, where that stands.
    pub stands: Option<Exact>,
}

/// All bodies with joints of a problem.
///
/// What two ways tell and is not known to be the same is told once here, and what the other way says is kept to be said, too
/// ([`Group::again`], [`Assembly::closing`], [`Assembly::standing`]): nothing is taken to agree.
pub struct Assembly {
    /// The bodies, in the order of the objects.
    pub members: Vec<Member>,
    /// The groups.
    pub groups: Vec<Group>,
    /// The axes.
    pub axes: Vec<Axis>,
    /// Of each joint its number among the objects, and of the axis along the z axis of its frame in either body the number and whether it is along the
    /// opposite direction. Joints that need none have none.
    pub joints: Vec<(usize, [Option<(usize, bool)>; 2])>,
    /// Vectors that are zero as a joint keeps directions between bodies that others have in one group already: the joint, the group, the coordinates.
    pub closing: Vec<(usize, usize, Exact)>,
    /// Vectors of the user's frame that are zero as a body stands in a group that stands already: the body, the vector.
    pub standing: Vec<(usize, Exact)>,
}

impl Assembly {
    /// That of a problem.
    ///
    /// # Errors
    /// The number of the object at fault, and what is wrong with it.
    pub fn of(problem: &Problem) -> Result<Self, (usize, Fault)> {
        let mut made = Assembly {
            members: Vec::new(),
            groups: Vec::new(),
            axes: Vec::new(),
            joints: Vec::new(),
            closing: Vec::new(),
            standing: Vec::new(),
        };
        for (index, object) in problem.objects.iter().enumerate() {
            let of = |pose: &Pose| axes(pose).map(|_| ()).map_err(|fault| (index, fault));
            object.poses().try_for_each(of)?;
        }
        made.gather(problem);
        made.stand(problem);
        if problem.dimension == 3 {
            made.find_axes(problem);
        } else {
            made.joints = joints(problem).map(|(j, ..)| (j, [None; 2])).collect();
        }
        for group in &mut made.groups {
            let moves = |&(axis, _): &(usize, Exact)| made.axes[axis].stands.is_none();
            // What stands first: then as few as can be have to be told.
            let (moving, standing): (Vec<_>, Vec<_>) = group.axes.drain(..).partition(moves);
            group.axes = [standing, moving].concat();
        }
        Ok(made)
    }

    /// The member that a body is.
    pub fn member(&self, body: usize) -> &Member {
        let mut members = self.members.iter();
        members
            .find(|m| m.body == body)
            .expect("a body with joints")
    }

    /// The groups: bodies that joints without a turn connect.
    fn gather(&mut self, problem: &Problem) {
        let identity: Turned = from_fn(|i| from_fn(|k| Real::whole(i64::from(i == k))));
        let mut used = HashSet::new();
        for (body, object) in problem.objects.iter().enumerate() {
            if object.place().is_none() || self.members.iter().any(|m| m.body == body) {
                continue;
            }
            let group = self.groups.len();
            self.groups.push(Group {
                body,
                stands: None,
                axes: Vec::new(),
                again: Vec::new(),
            });
            let mut next = vec![(body, identity.clone(), None)];
            while let Some((body, turned, by)) = next.pop() {
                if self.members.iter().any(|m| m.body == body) {
                    continue;
                }
                used.extend(by);
                for (joint, sort, bodies, frames) in joints(problem) {
                    let side = bodies.iter().position(|&b| b == body);
                    if let (Some(side), true) = (side, sort.keeps_directions()) {
                        let other = carried(&turned, frames, side);
                        next.push((bodies[1 - side], other, Some(joint)));
                    }
                }
                self.members.push(Member {
                    body,
                    group,
                    turned,
                });
            }
        }
        for (joint, sort, bodies, frames) in joints(problem) {
            if !sort.keeps_directions() || used.contains(&joint) {
                continue;
            }
            let (first, second) = (self.member(bodies[0]), self.member(bodies[1]));
            let other = carried(&first.turned, frames, 0);
            let apart = [0, 2].map(|k| minus(&other[k], &second.turned[k]));
            let group = first.group;
            let apart = apart.into_iter().filter(|v| !is_zero(v));
            self.closing.extend(apart.map(|v| (joint, group, v)));
        }
    }

    /// The groups that stand.
    fn stand(&mut self, problem: &Problem) {
        for body in problem.standing_bodies() {
            let here = drawn(problem, body);
            let member = self.member(body);
            let (group, turned) = (member.group, member.turned.clone());
            match &self.groups[group].stands {
                Some(stands) => {
                    let apart = [0, 2].map(|k| minus(&out_of(stands, &turned[k]), &here[k]));
                    let apart = apart.into_iter().filter(|v| !is_zero(v));
                    self.standing.extend(apart.map(|v| (body, v)));
                }
                None => {
                    let whole = from_fn(|k| {
                        let along: Exact = from_fn(|i| turned[i][k].clone());
                        out_of(&here, &along)
                    });
                    self.groups[group].stands = Some(whole);
                }
            }
        }
    }

    /// The axes of joints: one for all that are parallel in a body, and of each joint for both of its sides.
    fn find_axes(&mut self, problem: &Problem) {
        // Of each side of a joint the group and the direction in it, as it is given.
        let mut sides: Vec<(usize, usize, Exact)> = Vec::new();
        let mut of_joints = Vec::new();
        for (joint, sort, bodies, frames) in joints(problem) {
            let mut of = [None; 2];
            for side in 0..2 {
                let needs = match sort {
                    JointSort::Spherical | JointSort::Rigid => false,
                    // What keeps directions has one in the group.
                    JointSort::OnPlane | JointSort::Prismatic => side == 0,
                    _ => true,
                };
                if needs {
                    let member = self.member(bodies[side]);
                    of[side] = Some(sides.len());
                    let direction = out_of(&member.turned, &exact(&frames[side].z));
                    sides.push((joint, member.group, direction));
                }
            }
            of_joints.push((joint, sort, of));
        }
        // What is one axis, and which of them along the opposite direction.
        let mut axis: Vec<Option<(usize, bool)>> = vec![None; sides.len()];
        for first in 0..sides.len() {
            if axis[first].is_some() {
                continue;
            }
            let number = self.axes.len();
            self.axes.push(Axis {
                joint: sides[first].0,
                stands: None,
            });
            axis[first] = Some((number, false));
            let mut next = vec![first];
            while let Some(side) = next.pop() {
                let (_, is_opposite) = axis[side].expect("just said");
                let (_, group, direction) = &sides[side];
                for (other, (_, of, along)) in sides.iter().enumerate() {
                    if axis[other].is_none() && of == group && may_be_parallel(direction, along) {
                        let turns = dot(direction, along).enclose().sup() < 0.0;
                        axis[other] = Some((number, is_opposite ^ turns));
                        next.push(other);
                    }
                }
                let both = of_joints.iter().find(|(_, sort, of)| {
                    *sort != JointSort::Universal && of.contains(&Some(side))
                });
                if let Some((_, _, [Some(a), Some(b)])) = both {
                    for &end in [a, b] {
                        if axis[end].is_none() {
                            axis[end] = Some((number, is_opposite));
                            next.push(end);
                        }
                    }
                }
            }
        }
        // Of a joint both sides are along one vector: what its first side says.
        for (_, sort, of) in &of_joints {
            if let (false, [Some(a), Some(b)]) = (*sort == JointSort::Universal, of) {
                axis[*b] = axis[*a];
            }
        }
        let mut given: Vec<Vec<(usize, Exact)>> = vec![Vec::new(); self.groups.len()];
        for ((joint, group, direction), axis) in sides.iter().zip(&axis) {
            let (number, is_opposite) = axis.expect("all have one");
            let sign = Real::whole(if is_opposite { -1 } else { 1 });
            let direction = times(&sign, direction);
            let known = given[*group].iter().find(|&&(other, _)| other == number);
            match known {
                Some((_, known)) if is_same_direction(known, &direction) => {}
                Some(_) => {
                    let again = (*joint, number, unit(&direction));
                    self.groups[*group].again.push(again);
                }
                None => {
                    self.groups[*group].axes.push((number, unit(&direction)));
                    given[*group].push((number, direction));
                }
            }
        }
        // Axes of which groups that stand have one direction stand.
        for number in 0..self.axes.len() {
            let told = |group: &Group| {
                let stands = group.stands.as_ref()?;
                let (_, along) = group.axes.iter().find(|&&(other, _)| other == number)?;
                Some(out_of(stands, along))
            };
            let all: Vec<Exact> = self.groups.iter().filter_map(told).collect();
            let Some(first) = all.first() else { continue };
            if all.iter().all(|other| is_zero(&minus(first, other))) {
                self.axes[number].stands = Some(first.clone());
                continue;
            }
            let joint = self.axes[number].joint;
            for group in self.groups.iter_mut().filter(|g| g.stands.is_some()) {
                let along = group.axes.iter().find(|&&(other, _)| other == number);
                let again = along.map(|(_, along)| (joint, number, along.clone()));
                group.again.extend(again);
            }
        }
        let number = |side: &Option<usize>| side.and_then(|side| axis[side]);
        let joints = of_joints.iter();
        self.joints = joints
            .map(|(joint, sort, of)| {
                let [first, second] = of.each_ref().map(number);
                let second = match sort {
                    JointSort::Prismatic => first,
                    _ => second,
                };
                (*joint, [first, second])
            })
            .collect();
    }

    /// A direction in a group that is not along the given one, in its coordinates, at a right angle to it: toward another place of joints or points
    /// of a body in it, if there is one.
    pub fn beside(&self, problem: &Problem, group: usize, axis: &Exact) -> Exact {
        let mut found = Vec::new();
        for member in self.members.iter().filter(|m| m.group == group) {
            let mut places: Vec<Exact> = Vec::new();
            for (_, _, bodies, frames) in joints(problem) {
                let sides = (0..2).filter(|&side| bodies[side] == member.body);
                places.extend(sides.map(|side| exact(&frames[side].at)));
            }
            if let Shape::Body { local, .. } = &problem.objects[member.body].shape {
                places.extend(local.iter().map(exact));
            }
            let first = places.first().cloned().unwrap_or(from_fn(|_| Real::zero()));
            let apart = |place: &Exact| out_of(&member.turned, &minus(place, &first));
            found.extend(places.iter().map(apart));
        }
        found.extend((0..3).map(|k| from_fn(|i| Real::whole(i64::from(i == k)))));
        let across = found.iter().map(|v| {
            let along = dot(v, axis);
            minus(v, &times(&along, axis))
        });
        let is_far = |v: &Exact| {
            let square = dot(v, v).enclose();
            square.inf() > 0.0
        };
        let found = across.into_iter().find(is_far);
        unit(&found.expect("not all three axes are along one vector"))
    }

    /// The coordinates of a vector along e, f and e × f, where e and f are unit vectors with this product.
    pub fn along(basis: &[Exact; 2], product: &Real, v: &Exact) -> Exact {
        let [e, f] = basis;
        let (on_e, on_f) = (dot(v, e), dot(v, f));
        let across = &Real::whole(1) - &(product * product);
        let share = |a: &Real, b: &Real| &(a - &(product * b)) / &across;
        [
            share(&on_e, &on_f),
            share(&on_f, &on_e),
            &dot(v, &cross(e, f)) / &across,
        ]
    }
}

/// The joints: number among the objects, sort, bodies and frames.
pub fn joints(
    problem: &Problem,
) -> impl Iterator<Item = (usize, JointSort, [usize; 2], &[Pose; 2])> {
    let objects = problem.objects.iter().enumerate();
    objects.filter_map(|(index, object)| match &object.shape {
        Shape::Joint {
            sort,
            bodies,
            frames,
        } => Some((index, *sort, *bodies, &**frames)),
        _ => None,
    })
}
