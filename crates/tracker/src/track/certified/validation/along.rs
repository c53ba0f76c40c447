//! What tests of both spaces look at along a chain: where it starts, and its links.

use super::super::link::Frame;
use super::precise::big::{Big, dot};
use super::precise::{Figure, at};
use super::*;

/// The sketch, with t = 0.
pub fn sketch(homotopy: &Homotopy, equations: &Equations) -> Vector {
    let mut z = equations.vector();
    for (z, exact) in z.iter_mut().zip(homotopy.sketch_of_unknowns()) {
        *z = exact.mid();
    }
    z
}

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

/// If two tubes are linked, then the first one's exit is in the second where it is said to be,
/// and both run the same way there.
pub fn link_is_true<const N: usize, Y>(
    figure: &Figure,
    from: &Tube<N, Y>,
    to: &Tube<N, Y>,
    entry: (f64, f64),
) -> bool {
    let point = |tube: &Tube<N, Y>, s: f64| {
        let (through, _) = at(tube, &Big::of(s));
        figure
            .point_near(&through, &tube.local.normal)
            .expect("a regular point")
    };
    let (exit, ahead) = point(from, from.exit_at);
    let (there, along) = point(to, 0.5 * (entry.0 + entry.1));
    // The entry's width moves the point by about as much, the weights aside.
    let allowed = Big::of(1e-9 + 2.0 * (entry.1 - entry.0));
    let mut pairs = exit.iter().zip(&there);
    pairs.all(|(a, b)| (a - b).abs() <= allowed) && dot(&ahead, &along) > Big::of(0.0)
}

/// Whether a tube is found to lead to another; if so that is true.
#[track_caller]
pub fn leads_truly<const N: usize, Y: Frame>(
    figure: &Figure,
    from: &Tube<N, Y>,
    to: &Tube<N, Y>,
) -> bool {
    let link = from.leads_to(to);
    let is_true = link.is_none_or(|entry| link_is_true(figure, from, to, entry));
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
