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
        let (a, b) = (&self.0, &x.0);
        Lanes([
            s.mul_add(b[0], a[0]),
            s.mul_add(b[1], a[1]),
            s.mul_add(b[2], a[2]),
            s.mul_add(b[3], a[3]),
        ])
    }

    /// self + x y, lane by lane.
    #[inline(always)]
    pub fn plus_product(self, x: Lanes, y: Lanes) -> Lanes {
        let (a, x, y) = (&self.0, &x.0, &y.0);
        Lanes([
            x[0].mul_add(y[0], a[0]),
            x[1].mul_add(y[1], a[1]),
            x[2].mul_add(y[2], a[2]),
            x[3].mul_add(y[3], a[3]),
        ])
    }

    /// s self.
    #[inline(always)]
    pub fn times(self, s: f64) -> Lanes {
        let a = &self.0;
        Lanes([s * a[0], s * a[1], s * a[2], s * a[3]])
    }

    /// self − x.
    #[inline(always)]
    pub fn minus(self, x: Lanes) -> Lanes {
        let (a, b) = (&self.0, &x.0);
        Lanes([a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]])
    }

    /// The sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        (self.0[0] + self.0[2]) + (self.0[1] + self.0[3])
    }
}
