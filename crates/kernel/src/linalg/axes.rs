//! Inner loops over the axes of the plane or of space.

/// Runs code twice over: for two axes and for three, their number being a constant in it.
#[doc(hidden)]
#[macro_export]
macro_rules! with_axes {
    ($dimension:expr, $axes:ident => $code:expr) => {
        match $dimension {
            2 => {
                const $axes: usize = 2;
                $code
            }
            _ => {
                const $axes: usize = 3;
                $code
            }
        }
    };
}
pub use with_axes;
