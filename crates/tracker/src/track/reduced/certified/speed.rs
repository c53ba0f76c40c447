//! How fast a fixed point moves through the box.

use super::COEFFICIENTS;
use super::bounds::Bounds;
use super::frame::Reduction;
use super::sides::{row_of, weigh};
use crate::interval::rounding::largest;
use crate::linalg::rstructure::{MAX_KEYS, Row};

/// How fast v = T(s)⁻¹ (z − ẑ(s)) changes with s for a fixed point z in the box, in the norm |·|_ρ.
/// `slope_of` bounds |ẑ_i'|.
///
/// v_K' = −ẑ_K'. As A (K ẑ_K' − ẑ_A') = E ẑ_K' − F_A(ẑ)', v_A' = A⁻¹ (E ẑ_K' − F_A(ẑ)') − K' v_K; and
/// |A⁻¹ E| ρ_K and |A⁻¹ F_A(ẑ)'| are among the things that the bounds bound.
pub fn speed<const W: usize>(
    y: &Reduction,
    rho: &[f64],
    bounds: &Bounds,
    slope_of: impl Fn(usize) -> f64,
) -> f64 {
    let layout = &y.elimination.layout;
    let mut sizes = [0.0; MAX_KEYS];
    let mut along = 0.0f64;
    for (size, &key) in sizes.iter_mut().zip(&layout.keys) {
        *size = rho[key as usize];
        along = largest(along, slope_of(key as usize) / *size);
    }
    let sizes: Row<W> = row_of(&sizes);
    let slope = y.k_slope.as_chunks::<W>().0;
    let mut turning = 0.0f64;
    for block in &layout.blocks {
        for &unknown in &block.unknowns[..block.size] {
            let i = unknown as usize;
            turning = largest(turning, weigh(&slope[i], &sizes) / rho[i]);
        }
    }
    let residual = bounds.low_slope + COEFFICIENTS as f64 * bounds.high / bounds.h;
    largest(
        along,
        along * (bounds.constant + bounds.cubic) + residual + turning,
    )
}
