//! What tests of both spaces look at along a chain: where it starts, and its links.

use super::super::link::Frame;
use super::precise::big::{Big, dot};
use super::precise::{Figure, at};
use super::*;

/// How near points of the path are known that are compared to 1e-9.
const NEAR: f64 = 1e-24;

/// That point, its normal in the direction in which t rises. `None`: it is singular.
pub fn at_sketch(
    homotopy: &Homotopy,
    equations: &Equations,
    inverter: &mut InverseMaker,
) -> Option<Local> {
    let mut local = Local::new(equations);
    local.z[0].copy_from_slice(&sketch(homotopy, equations));
    first_normal(equations, inverter, &mut local, false).ok()?;
    Some(local)
}

/// The point of the path that a tube has at a place along it, and the path's direction there.
pub fn on_path<const N: usize, Y>(figure: &Figure, tube: &Tube<N, Y>, s: f64) -> [Vec<Big>; 2] {
    let (through, _) = at(tube, &Big::of(s));
    let found = figure.point_within(NEAR, &through, &tube.local.normal);
    found.expect("a regular point").into()
}

/// If a tube is linked to another, then its exit, [`on_path`], is in the other one where it is said to be, and both run the
/// same way there.
pub fn link_is_true<const N: usize, Y>(
    figure: &Figure,
    [exit, ahead]: &[Vec<Big>; 2],
    to: &Tube<N, Y>,
    entry: (f64, f64),
) -> bool {
    let [there, along] = on_path(figure, to, 0.5 * (entry.0 + entry.1));
    // The entry's width moves the point by about as much, the weights aside.
    let allowed = Big::of(1e-9 + 2.0 * (entry.1 - entry.0));
    let mut pairs = exit.iter().zip(&there);
    pairs.all(|(a, b)| (a - b).abs() <= allowed) && dot(ahead, &along) > Big::of(0.0)
}

/// Whether a tube, of which the exit is known, is found to lead to another; if so that is true.
#[track_caller]
pub fn leads_truly<const N: usize, Y: Frame>(
    figure: &Figure,
    (from, exit): (&Tube<N, Y>, &[Vec<Big>; 2]),
    to: &Tube<N, Y>,
) -> bool {
    let link = from.leads_to(to);
    let is_true = link.is_none_or(|entry| link_is_true(figure, exit, to, entry));
    assert!(is_true, "linked to a tube that it does not lead to");
    link.is_some()
}

/// The mirror image of a point or of a direction.
pub fn mirrored(homotopy: &Homotopy, v: &[f64]) -> Vec<f64> {
    let (m, axis) = (homotopy.equations, homotopy.dimension - 1);
    let is_turned = |i: usize| i < m && homotopy.flips(i, axis);
    let entry = |i: usize| if is_turned(i) { -v[i] } else { v[i] };
    (0..=m).map(entry).collect()
}
