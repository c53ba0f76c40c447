//! Hinges in a chain, and bars that close it.

use super::frame::{Frame, Hinge, Structure, V3, cross, distance, dot, minus, plus, times};
use crate::places::Each as _;
use crate::random::Random;

/// The angle at the first hinge between its levers, to either end of the closing bar, where the
/// bar is shortest at 0: in the sketch, in the target, and as far as the bend lets it go.
const ANGLES: [f64; 3] = [0.45, 0.5, 0.75];

/// The angle at the other hinges: far from where their closing bars are shortest or longest.
const OTHERS: f64 = 1.4;

/// How much the other closing bars change.
const CHANGE: f64 = 0.01;

/// Opens a frame at `loops` hinges and closes it by as many bars. The bend goes from the first
/// body to the last one; every other bar braces two neighbouring bodies.
pub(super) fn close(mut frame: Frame, loops: usize, random: &mut Random) -> Structure {
    let hinges: Vec<Hinge> = (1..=loops)
        .map(|j| frame.hinges[(j * frame.hinges.len() - 1) / (loops + 1)])
        .collect();
    let start = |j: usize| if j == 0 { 0 } else { hinges[j - 1].first };
    let end = |j: usize| {
        hinges
            .get(j)
            .map_or(frame.points.len(), |hinge| hinge.first)
    };
    let bodies: Vec<[usize; 2]> = (0..=loops).map(|j| [start(j), end(j)]).collect();

    let mut closing = vec![[0; 2]; loops];
    // The first hinge last: its levers depend on the angles at the others.
    for j in (0..loops).rev() {
        let hinge = &hinges[j];
        let [from, to] = bodies[j];
        let [next_from, next_to] = if j == 0 { bodies[loops] } else { bodies[j + 1] };
        // The far halves of the bodies; no point is the end of two bars, which would place it.
        let free = |range: std::ops::Range<usize>| {
            range.filter(|p| !closing[j + 1..].as_flattened().contains(p))
        };
        let next_half = free(next_from.midpoint(next_to)..next_to);
        let far = lever(&frame, hinge, next_half, f64::INFINITY);
        let reach = distance_to_axis(&frame, hinge, far);
        let half = free(from..from.midpoint(to));
        let near = lever(&frame, hinge, half, 0.6 * reach);
        let angle = match j {
            0 => ANGLES[0],
            _ if j % 2 == 0 => -OTHERS + 0.2 * random.symmetric(),
            _ => OTHERS + 0.2 * random.symmetric(),
        };
        turn(&mut frame, hinge, near, far, angle);
        closing[j] = [near, far];
    }

    // The lengths of the first closing bar, turned to where the target is, and to its limit.
    let [near, far] = closing[0];
    let [sketch, target, limit] = ANGLES.each(|angle| {
        turn(&mut frame, &hinges[0], near, far, angle);
        distance(frame.points[near], frame.points[far])
    });
    turn(&mut frame, &hinges[0], near, far, ANGLES[0]);

    let removed: Vec<usize> = hinges.iter().map(|hinge| hinge.bar).collect();
    let regular = (0..frame.bars.len()).filter(|bar| !removed.contains(bar));
    let mut bars: Vec<([usize; 2], Option<f64>)> =
        regular.map(|bar| (frame.bars[bar], None)).collect();
    for &bar in &closing[1..] {
        bars.push((bar, Some(1.0 + CHANGE * random.symmetric())));
    }
    bars.push((closing[0], Some(target / sketch)));
    Structure {
        dimension: frame.dimension,
        points: frame.points,
        bars,
        // With it the bend's largest length is `limit`, but for the way to the target.
        bend_coefficient: 4.0 * (limit - sketch),
    }
}

/// The point whose distance to the hinge's axis is nearest to the one wanted.
fn lever(frame: &Frame, hinge: &Hinge, among: impl Iterator<Item = usize>, wanted: f64) -> usize {
    let off = |p: usize| {
        let distance = distance_to_axis(frame, hinge, p);
        if wanted.is_finite() {
            (distance - wanted).abs()
        } else {
            -distance
        }
    };
    among
        .min_by(|&p, &q| off(p).total_cmp(&off(q)))
        .expect("a body has points")
}

/// A unit vector along the axis; upwards in the plane.
fn direction(frame: &Frame, hinge: &Hinge) -> V3 {
    let [a, b] = hinge.axis.each(|p| frame.points[p]);
    if hinge.axis[0] == hinge.axis[1] {
        [0.0, 0.0, 1.0]
    } else {
        times(1.0 / distance(a, b), minus(b, a))
    }
}

/// From the axis to a point, at a right angle.
fn arm(frame: &Frame, hinge: &Hinge, p: usize) -> V3 {
    let u = minus(frame.points[p], frame.points[hinge.axis[0]]);
    let n = direction(frame, hinge);
    minus(u, times(dot(u, n), n))
}

fn distance_to_axis(frame: &Frame, hinge: &Hinge, p: usize) -> f64 {
    let u = arm(frame, hinge, p);
    dot(u, u).sqrt()
}

/// Turns everything behind the hinge so that `angle` is between the levers to `near` and `far`.
fn turn(frame: &mut Frame, hinge: &Hinge, near: usize, far: usize, angle: f64) {
    let n = direction(frame, hinge);
    let (u, v) = (arm(frame, hinge, near), arm(frame, hinge, far));
    let (sin, cos) = (angle - dot(n, cross(u, v)).atan2(dot(u, v))).sin_cos();
    let centre = frame.points[hinge.axis[0]];
    for p in &mut frame.points[hinge.first..] {
        // Rodrigues' formula.
        let w = minus(*p, centre);
        let along = times((1.0 - cos) * dot(n, w), n);
        let across = times(sin, cross(n, w));
        *p = plus(centre, plus(times(cos, w), plus(across, along)));
    }
}
