//! Four numbers side by side, one processor register.

/// Derivatives by four parameters at once.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Lanes(pub [f64; 4]);

impl Lanes {
    /// All lanes zero.
    pub const ZERO: Lanes = Lanes([0.0; 4]);

    /// The lanes that are 1 in one place and 0 elsewhere, by place.
    pub const UNIT: [Lanes; 4] = [
        Lanes([1.0, 0.0, 0.0, 0.0]),
        Lanes([0.0, 1.0, 0.0, 0.0]),
        Lanes([0.0, 0.0, 1.0, 0.0]),
        Lanes([0.0, 0.0, 0.0, 1.0]),
    ];

    /// self + s x.
    #[inline(always)]
    pub fn plus(self, s: f64, x: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|k| s.mul_add(x.0[k], self.0[k])))
    }

    /// self + x y, lane by lane.
    #[inline(always)]
    pub fn plus_product(self, x: Lanes, y: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|k| x.0[k].mul_add(y.0[k], self.0[k])))
    }

    /// s self.
    #[inline(always)]
    pub fn times(self, s: f64) -> Lanes {
        Lanes(self.0.map(|x| s * x))
    }

    /// self − x.
    #[inline(always)]
    pub fn minus(self, x: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|k| self.0[k] - x.0[k]))
    }

    /// The sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        (self.0[0] + self.0[2]) + (self.0[1] + self.0[3])
    }
}
