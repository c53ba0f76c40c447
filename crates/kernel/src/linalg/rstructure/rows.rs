//! Rows with one number for each key unknown, in whole lanes.

use super::Scalar;
use crate::linalg::LANE;

/// Four numbers, in one register where they are floats.
pub type Lane<T = f64> = [T; LANE];
/// The numbers of one row.
pub type Row<const W: usize, T = f64> = [Lane<T>; W];

/// A row of zeros.
#[inline(always)]
pub fn zeros<const W: usize, T: Scalar>() -> Row<W, T> {
    [[T::zero(); LANE]; W]
}

/// `sum += factor · row`.
#[inline(always)]
pub fn add<const W: usize, T: Scalar>(sum: &mut Row<W, T>, factor: T, row: &Row<W, T>) {
    for w in 0..W {
        for i in 0..LANE {
            sum[w][i] = sum[w][i].plus_product(row[w][i], factor);
        }
    }
}

/// Calls a function generic over the number of lanes in a row.
#[doc(hidden)]
#[macro_export]
macro_rules! with_width {
    ($width:expr, $self:ident . $f:ident ( $($arg:expr),* $(,)? )) => {
        match $width {
            1 => $self.$f::<1>($($arg),*),
            2 => $self.$f::<2>($($arg),*),
            4 => $self.$f::<4>($($arg),*),
            _ => $self.$f::<8>($($arg),*),
        }
    };
}
pub use with_width;

/// The largest number of key unknowns that rows have room for.
pub const MAX_KEYS: usize = 8 * LANE;

/// Lanes for so many columns, those that there is code for; `None`: too many.
pub fn width_for(columns: usize) -> Option<usize> {
    match columns.div_ceil(LANE) {
        0 | 1 => Some(1),
        2 => Some(2),
        3 | 4 => Some(4),
        5..=8 => Some(8),
        _ => None,
    }
}
