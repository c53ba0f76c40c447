//! The bounds of the theorem in `test.rs` over a box that suits a given length, in two rounds: the
//! first finds what the box has to be, the second what depends on it.

use super::along::Along;
use super::bounds::Bounds;
use super::frame::{Locals, Reduction, Tubes};
use super::left_over;
use super::sides::weigh;
use super::speed::speed;
use super::test::ReducedTest;
use crate::interval::rounding::{gamma, largest, round_up};
use crate::linalg::LANE;
use crate::linalg::rstructure::{MAX_KEYS, Row};
use crate::places::Each as _;
use crate::track::full::Equations;
use crate::track::reduced::structure::layout::Layout;

/// The contraction that comes with the reference length may be that at most.
const TOO_LONG: f64 = 0.8;

/// What the four right-hand sides of the first round are.
mod first {
    /// F's orders that do not get smaller with s.
    pub const LOW: usize = 0;
    /// The Jacobian's that get smaller like s³.
    pub const CUBIC: usize = 1;
    /// Its change over the box.
    pub const WIDTH: usize = 2;
    /// F's that get smaller.
    pub const HIGH: usize = 3;
}

/// What those of the second round are.
mod second {
    /// The Jacobian's orders that do not get smaller with s.
    pub const CONSTANT: usize = 0;
    /// Its change over the box.
    pub const WIDTH: usize = 1;
    /// What the box adds to the right-hand side of the path's derivative.
    pub const TURN: usize = 2;
    /// The derivative by s of F's orders that do not get smaller.
    pub const SLOPE: usize = 3;
}

/// Where bounds are taken.
struct Place<'a, const W: usize> {
    equations: &'a Equations,
    local: &'a Locals,
    layout: &'a Layout,
    /// The key unknowns' weights, and what these are multiplied with for the box.
    kappa: Row<W>,
    scale: f64,
    /// The relative rounding of an entry of the Jacobian's series, and of sums over them.
    per_entry: f64,
    /// More roundings than any bound goes through.
    roundings: usize,
}

impl<const W: usize> Place<'_, W> {
    fn up(&self, x: f64) -> f64 {
        round_up(x, self.roundings)
    }

    /// What `value` makes of each unknown of A: it is given the unknown's position in A, and the
    /// unknown.
    fn each_of_a(&self, mut value: impl FnMut(usize, usize)) {
        for block in &self.layout.blocks {
            for c in 0..block.size {
                value(block.start + c, block.unknowns[c] as usize);
            }
        }
    }
}

impl ReducedTest {
    /// Bounds for |s| ≤ `h` in a box that suits that length, which is put into the tube's frame. `None`:
    /// the bound on A(s)⁻¹ does not exist, or nothing is left to contract.
    pub(super) fn bounds<const W: usize>(
        &mut self,
        equations: &Equations,
        tube: &mut Tubes,
        h: f64,
    ) -> Option<Bounds> {
        let per_entry = gamma(equations.roundings().of_reduced_entry(MAX_KEYS));
        let entries = &self.series.entries;
        self.along.measure(equations, &tube.local, entries, h);
        let entries = [&entries[0][..], &entries[1]];
        let local = &mut tube.local;
        if !bound_inverse(equations, local, (&self.along, entries), per_entry, h) {
            return None;
        }
        let layout = tube.local.y.elimination.layout.clone();
        let kappa = self.shape.kappa::<W>(&layout);
        self.shape.measure(&mut tube.local.y, &kappa, h);
        self.along.measure_residual(equations, &tube.local);
        let mut place = Place {
            equations,
            local: &tube.local,
            layout: &layout,
            kappa,
            scale: 0.0,
            per_entry,
            roundings: tube.local.y.resolvent.roundings()
                + equations.roundings().of_reduced_bound(),
        };
        let left = self.first_round(&mut place)?;
        self.shape.fill(&layout, &self.sides, place.scale);
        let mut bounds = Bounds {
            h,
            ..Bounds::default()
        };
        let left = self.add_first(&place, left, &mut bounds);
        self.second_round(&place);
        self.add_second(&place, left, &mut bounds);
        let slope_of = |i: usize| self.along.slope_of(place.local, i);
        let speed = place.up(speed::<W>(
            &place.local.y,
            &self.shape.rho,
            &bounds,
            slope_of,
        ));
        let width: [f64; MAX_KEYS] = self.sides.keys.each(|sides| sides[second::WIDTH]);
        self.shape
            .set_next_weights(&layout, kappa.as_flattened(), &width[..layout.keys()]);
        let y = &mut tube.local.y;
        y.rho.copy_from_slice(&self.shape.rho);
        y.speed = speed;
        self.last = bounds;
        (bounds.is_in_range() && speed.is_finite()).then_some(bounds)
    }

    /// What does not depend on the box of A's unknowns, the weights standing for that of the key ones:
    /// of F what does not get smaller with s, of J T what gets smaller like s³, its change over the
    /// box, and of F what gets smaller. Chooses the scale of the box, and returns what the key
    /// unknowns' rows leave over.
    fn first_round<const W: usize>(&mut self, place: &mut Place<W>) -> Option<left_over::Parts<W>> {
        let (equations, layout, y) = (place.equations, place.layout, &place.local.y);
        let (along, sides) = (&mut self.along, &mut self.sides);
        let t = equations.m;
        let [moved0, moved1, moved2] = self.shape.moved.each_ref().each(|moved| &moved[..]);
        let omega = &self.shape.omega[..];
        let first = equations.tail.first();
        if first < equations.m {
            along.tail.measure_in_box(equations, omega);
        }
        let along = &*along;
        for e in 0..equations.m {
            let (mut cubic, mut width) = (along.slope_tails[e] * omega[t], 0.0);
            for axis in 0..equations.dimension() {
                let ends = equations.ends[axis][e];
                cubic += along.from[5][axis][e] * both(moved0, ends)
                    + along.from[4][axis][e] * both(moved1, ends)
                    + along.from[3][axis][e] * both(moved2, ends);
                width += both(omega, ends).powi(2);
            }
            width += along.curvature[e] * (omega[t] * omega[t]);
            let g = &mut sides.g[e];
            (g[first::LOW], g[first::CUBIC]) = (along.low[e], cubic);
            (g[first::WIDTH], g[first::HIGH]) = (width, along.high[e]);
        }
        for e in first..equations.m {
            let [_, _, from3, from4, from5] = &along.tail.entries;
            let times = |entries, moved| along.tail.times(equations, e, entries, moved);
            sides.g[e][first::CUBIC] +=
                times(from5, moved0) + times(from4, moved1) + times(from3, moved2);
            sides.g[e][first::WIDTH] += along.tail.width[e];
        }
        sides.g[t] = [0.0; LANE];
        sides.gather(y);
        // For the key unknowns these are counted with their signs, see `left_over`.
        let [jk3, jk4] = [3, 4].each(|q| self.series.jk[q].as_chunks::<W>().0);
        let (h3, h4) = (along.powers[3], along.powers[4]);
        for block in &layout.blocks {
            for r in 0..block.size {
                let e = block.rows[r] as usize;
                sides.g_a[block.start + r][first::CUBIC] +=
                    h3 * weigh(&jk3[e], &place.kappa) + h4 * weigh(&jk4[e], &place.kappa);
            }
        }
        sides.bound(equations, y);
        let left = left_over::of_s(y, &self.series, along, &place.kappa);
        let (mut used, mut widest) = (0.0, 0.0);
        let kappa = place.kappa.as_flattened();
        for i in 0..layout.keys() {
            let [_, cubic, width, _] = &mut sides.keys[i];
            *cubic += left[1].as_flattened()[i];
            used = largest(used, *cubic / kappa[i]);
            widest = largest(widest, *width / kappa[i]);
        }
        if !(used < TOO_LONG && widest >= 0.0) {
            return None;
        }
        // |w_t| ≤ 1, see `Along::curvature`. That is all that limits the box where its width does not count in any key
        // unknown: where the only one is t, and no equation depends on it.
        place.scale = (0.5 * (1.0 - used) / widest).min(0.5 / omega[t]);
        Some(left)
    }

    /// The first round's shares of the bounds, once the box is known. Returns what does not get smaller
    /// in what the key unknowns' rows leave over.
    fn add_first<const W: usize>(
        &mut self,
        place: &Place<W>,
        left: left_over::Parts<W>,
        bounds: &mut Bounds,
    ) -> Row<W> {
        let (layout, scale, rho) = (place.layout, place.scale, &self.shape.rho);
        let [s_constant, _] = left;
        let [z_constant, z_cubic] = left_over::of_z::<W>(
            place.equations,
            &place.local.y,
            &self.series,
            &self.along,
            &self.shape.rho_a,
        );
        place.each_of_a(|at, i| {
            let [low, cubic, _, high] = self.sides.a[at];
            self.defect[i] = place.up(low + high);
            raise(&mut bounds.low, place.up(low / rho[i]));
            raise(&mut bounds.high, place.up(high / rho[i]));
            raise(&mut bounds.cubic, place.up(scale * cubic / rho[i]));
        });
        let mut constant = [[0.0; LANE]; W];
        for (i, &key) in layout.keys.iter().enumerate() {
            let [low, cubic, _, high] = self.sides.keys[i];
            let rho = rho[key as usize];
            let cubic = scale * cubic + z_cubic.as_flattened()[i];
            self.defect[key as usize] = place.up(low + high);
            raise(&mut bounds.low, place.up(low / rho));
            raise(&mut bounds.high, place.up(high / rho));
            raise(&mut bounds.cubic, place.up(cubic / rho));
            constant.as_flattened_mut()[i] =
                scale * s_constant.as_flattened()[i] + z_constant.as_flattened()[i];
        }
        constant
    }

    /// What depends on the whole box: of J T what does not get smaller with s, its change over the
    /// box, what the box adds to the right-hand side of the path's derivative, and of F' what does not
    /// get smaller.
    fn second_round<const W: usize>(&mut self, place: &Place<W>) {
        let (equations, layout, local) = (place.equations, place.layout, place.local);
        let (along, sides) = (&mut self.along, &mut self.sides);
        let (m, n) = (equations.m, equations.n());
        let omega = &self.shape.omega[..];
        let ut = omega[m];
        let first = equations.tail.first();
        if first < m {
            along.tail.measure_in_box(equations, omega);
        }
        let along = &*along;
        for e in 0..m {
            let (mut rounding, mut width, mut turn) = (0.0, 0.0, 0.0);
            for axis in 0..equations.dimension() {
                let both = both(omega, equations.ends[axis][e]);
                rounding += along.from[0][axis][e] * both;
                width += both * both;
                turn += along.slopes[axis][e] * both;
            }
            let curvature = along.curvature[e];
            width += curvature * (ut * ut);
            turn += curvature * along.time.speed * ut;
            let constant = place.per_entry * (rounding + along.slope_size[e] * ut)
                + along.slope_radius[e] * ut;
            let g = &mut sides.g[e];
            (g[second::CONSTANT], g[second::WIDTH]) = (constant, width);
            (g[second::TURN], g[second::SLOPE]) = (turn, along.low_slope[e]);
        }
        for e in first..m {
            let [all, ..] = &along.tail.entries;
            sides.g[e][second::CONSTANT] +=
                place.per_entry * along.tail.times(equations, e, all, omega);
            sides.g[e][second::WIDTH] += along.tail.width[e];
            sides.g[e][second::TURN] += along.tail.turn[e];
        }
        sides.g[m] = [
            place.per_entry * sum_of_sizes(&local.normal[..n], omega),
            0.0,
            0.0,
            0.0,
        ];
        let jk = [0, 1, 2].each(|q| self.series.jk[q].as_chunks::<W>().0);
        for block in &layout.blocks {
            for &e in &block.rows[..block.size] {
                let e = e as usize;
                for (jk, power) in jk.iter().zip(along.powers) {
                    sides.g[e][second::CONSTANT] +=
                        place.scale * power * weigh(&jk[e], &place.kappa);
                }
            }
        }
        sides.gather(&local.y);
        sides.bound(equations, &local.y);
    }

    /// The second round's shares.
    fn add_second<const W: usize>(&self, place: &Place<W>, left: Row<W>, bounds: &mut Bounds) {
        let n = place.equations.n();
        let (rho, omega) = (&self.shape.rho, &self.shape.omega);
        let mut add = |[constant, width, turn, slope]: [f64; LANE], left: f64, rho: f64| {
            raise(&mut bounds.constant, place.up((constant + left) / rho));
            raise(&mut bounds.width, place.up(width / rho));
            raise(&mut bounds.turn, place.up(turn / rho));
            raise(&mut bounds.low_slope, place.up(slope / rho));
        };
        place.each_of_a(|at, i| add(self.sides.a[at], 0.0, rho[i]));
        for (i, &key) in place.layout.keys.iter().enumerate() {
            add(
                self.sides.keys[i],
                left.as_flattened()[i],
                rho[key as usize],
            );
        }
        for i in 0..n {
            let slope = self.along.slope_of(place.local, i);
            raise(&mut bounds.slope, place.up(slope / omega[i]));
        }
        bounds.normal = sum_of_sizes(&place.local.normal[..n], omega);
        let top = omega[..n].iter().fold(0.0, |max: f64, &u| max.max(u));
        bounds.radius = (self.radius / top).next_down();
    }
}

/// |A(s)⁻¹| for |s| ≤ h, into the frame, with the values of the tail's entries at orders 0 and 1. False: no bound was found.
fn bound_inverse(
    equations: &Equations,
    local: &mut Locals,
    (along, entries): (&Along, [&[f64]; 2]),
    per_entry: f64,
    h: f64,
) -> bool {
    let Reduction {
        elimination,
        resolvent,
        ..
    } = &mut local.y;
    let (spreads, spread_of_tail) = resolvent.spread_mut();
    let [all, from2, ..] = &along.tail.entries;
    for (spread, (from2, all)) in spread_of_tail.iter_mut().zip(from2.iter().zip(all)) {
        *spread = from2 + per_entry * all;
    }
    for (axis, spread) in spreads.iter_mut().enumerate() {
        let terms = along.from[2][axis].iter().zip(along.from[0][axis].iter());
        for (spread, (from2, all)) in spread.iter_mut().zip(terms) {
            *spread = from2 + per_entry * all;
        }
    }
    let values = ([&local.d[0][..], &local.d[1]], entries);
    let layout = &elimination.layout;
    resolvent.make(equations, layout, &elimination.inverses, values, h)
}

#[inline(always)]
fn both(x: &[f64], ends: [u32; 2]) -> f64 {
    x[ends[0] as usize] + x[ends[1] as usize]
}

/// Σ |c_i| u_i.
fn sum_of_sizes(c: &[f64], u: &[f64]) -> f64 {
    c.iter().zip(u).map(|(c, u)| c.abs() * u).sum()
}

fn raise(bound: &mut f64, value: f64) {
    *bound = largest(*bound, value);
}
