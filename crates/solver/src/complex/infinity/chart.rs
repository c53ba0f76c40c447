//! The coordinates in which a figure at infinity is a place like all others, and the proof of one.
//!
//! What a path's last point is taken for (`far`, `coordinates`) is a guess, on which no proof rests; [`prove`] rests on the parts (no edge
//! joins S and O, where the fixed triangle is), on what [`Split::new`] finds exactly, on the equations ([`system`]) with the proof of their
//! zero, and on [`is_regular`].

use super::Graph;
use super::split::{Parts, Split, parts};
use crate::certificate::complex::infinity::{LAMBDA, NU, Part, SIGMA, rows, unknown};
use crate::complex::boxes::SolutionBox;
use crate::complex::ends::EndProver;
use crate::complex::exact::Exact;
use crate::complex::system::{Equation, Kind, System, Unknown, segment};
use crate::complex::vector::{Z, cross, dot, minus, plus};
use crate::interval::complex::Number;
use crate::interval::{DoubleDouble, Interval, enclose_rational, point};
use crate::order::InOrder;

/// A point belongs to those that go where it is so much farther than the next nearer one, in typical lengths.
const GAP: f64 = 1e3;

/// Finds how the points go of which these are the places shortly before, and a box around the figure at infinity.
pub fn prove(graph: &Graph, last: &[[Z; 3]]) -> Option<(Split, SolutionBox)> {
    let parts = parts(graph.points, &graph.edges, &far(last)?)?;
    let [inside, _, outside] = &parts;
    // The fixed triangle does not go, and one of its corners is none of the neighbours: see the module's text.
    let is_fixed = |p: &usize| graph.fixed.contains(p);
    if inside.iter().any(is_fixed) || !outside.iter().any(is_fixed) {
        return None;
    }
    let mut near = coordinates(last, &parts)?;
    let rough = |p: usize| near[p][NU].re.rough();
    let split = Split::new(parts, &graph.edges, rough)?;
    // Whether it is the mirror image that has these signs.
    let highest = split.heights.iter().position(|h| !h.is_zero())?;
    if rough(split.link[highest]) < 0.0 {
        for place in &mut near {
            place[NU] = -place[NU];
        }
    }
    let system = system(graph, &split)?;
    let rights = segment(&system.target(), &system.target(), None);
    let near: Vec<DoubleDouble> = near.iter().flatten().flat_map(|z| [z.re, z.im]).collect();
    let found = EndProver::new(&system, &rights).prove(&near).ok()?;
    is_regular(&split, &found).then_some((split, found))
}

/// Which points are far away. `None`: none is clearly farther than others.
fn far(last: &[[Z; 3]]) -> Option<Vec<bool>> {
    let of = |place: &[Z; 3]| place.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
    let sizes: Vec<f64> = last.iter().map(of).collect();
    let mut sorted: Vec<f64> = sizes.iter().map(|size| size.max(1.0)).collect();
    sorted.order_by(f64::total_cmp);
    let gaps = sorted.windows(2).map(|pair| (pair[1] / pair[0], pair[1]));
    let (gap, from) = gaps.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (gap >= GAP).then(|| sizes.iter().map(|&size| size >= from).collect())
}

/// About the coordinates of all points: those of the module's text, for the ε that they have.
fn coordinates(last: &[[Z; 3]], [inside, link, outside]: &Parts) -> Option<Vec<[Z; 3]>> {
    let origin = last[link[0]];
    let from_origin = |p: usize| minus(last[p], origin);
    let (near, away) = (from_origin(outside[0]), from_origin(inside[0]));
    // The isotropic directions in the plane of both: one nearly that of the point far away, the other nearly that of the
    // point that stays, or as far from it as its length is from zero beside its product with the former.
    let product = dot(near, away);
    let towards = plus(
        &away,
        small_root(dot(near, near), product, dot(away, away)),
        &near,
    );
    let other = plus(
        &near,
        small_root(dot(away, away), product, dot(near, near)),
        &away,
    );
    let normal = cross(near, away);
    let scale = dot(normal, normal).sqrt().inverse();
    // σ of the point that stays is 1.
    let of_sigma = dot(towards, near).inverse();
    let of_lambda = dot(towards, near) * dot(towards, other).inverse();
    let of_lambda = of_lambda.times(2.0.into());
    let coordinates = |p: usize| {
        let v = from_origin(p);
        [
            dot(other, v) * of_lambda,
            dot(normal, v) * scale,
            dot(towards, v) * of_sigma,
        ]
    };
    let mut all: Vec<[Z; 3]> = (0..last.len()).map(coordinates).collect();
    // Λ of the point far away is 1.
    let per_epsilon = all[inside[0]][LAMBDA];
    let epsilon = per_epsilon.inverse();
    for &p in inside {
        all[p][LAMBDA] = all[p][LAMBDA] * epsilon;
    }
    for &p in inside.iter().chain(link) {
        all[p][SIGMA] = all[p][SIGMA] * per_epsilon;
    }
    let is_number = |z: &Z| z.sum_of_sizes().is_finite();
    all.iter().flatten().all(is_number).then_some(all)
}

/// The root of a x² + 2 b x + c that is near zero.
fn small_root(a: Z, b: Z, c: Z) -> Z {
    // c / (−b ∓ √(b² − a c)), with the sign that makes it small.
    let root = (b * b - a * c).sqrt();
    let below = [b + root, b - root];
    let larger = if below[0].norm_sqr() > below[1].norm_sqr() {
        below[0]
    } else {
        below[1]
    };
    -(c * larger.inverse())
}

/// The equations at ε = 0. `None`: there are not as many as unknowns.
fn system(graph: &Graph, split: &Split) -> Option<System> {
    let names =
        |p: usize| ["lambda", "nu", "sigma"].map(|which| format!("{which} of point {}", p + 1));
    let unknowns = (0..graph.points).flat_map(names).map(|name| Unknown {
        name,
        power: 0,
        flips: [false; 3],
    });
    let part = |p: usize| match split.inside.contains(&p) {
        true => Part::Goes,
        false if split.link.contains(&p) => Part::Link,
        false => Part::Stays,
    };
    let (edges, heights) = (graph.edges.iter(), split.link.iter().zip(&split.heights));
    let rows = rows(
        edges.map(|edge| (edge.points, edge.squared.clone())),
        part,
        heights.map(|(&p, height)| (p, height.clone())),
        [split.link[0], split.outside[0], split.inside[0]],
    );
    let equation = |(terms, value)| Equation {
        name: String::new(),
        terms,
        power: 0,
        right: Kind::Fixed(Exact::real(value)),
        bows: false,
    };
    let system = System {
        dimension: 3,
        unknowns: unknowns.collect(),
        equations: rows.into_iter().map(equation).collect(),
        unit: 1.0,
        positions: 1,
        ..System::default()
    };
    (system.equations.len() == system.unknowns.len()).then_some(system)
}

/// Whether Λ is not zero where points go, nor σ where they stay, and the sum around the cycle is not zero either.
fn is_regular(split: &Split, found: &SolutionBox) -> bool {
    let part = |p: usize, which: usize| -> [Interval; 2] {
        let at = 2 * unknown(p, which);
        [found.parts[at], found.parts[at + 1]]
    };
    let is_nonzero = |z: [Interval; 2]| z.iter().any(|x| !x.contains(0.0));
    let goes = split.inside.iter().all(|&p| is_nonzero(part(p, LAMBDA)));
    let stays = split.outside.iter().all(|&p| is_nonzero(part(p, SIGMA)));
    let mut sum = [point(0.0); 2];
    for [from, to] in split.around() {
        let (Some(a), Some(b)) = (split.height(to), split.height(from)) else {
            return false;
        };
        let rise = a - b;
        if rise.is_zero() {
            return false;
        }
        let difference = |which: usize| {
            let (a, b) = (part(to, which), part(from, which));
            [a[0] - b[0], a[1] - b[1]]
        };
        let ([a, b], [c, d]) = (difference(LAMBDA), difference(SIGMA));
        let per_rise = enclose_rational(&rise.recip());
        sum = [
            sum[0] + (a * c - b * d) * per_rise,
            sum[1] + (a * d + b * c) * per_rise,
        ];
    }
    goes && stays && is_nonzero(sum)
}
