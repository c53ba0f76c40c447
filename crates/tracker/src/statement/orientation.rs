//! Signs of figures: which way round points are.

use super::Problem;

/// The sign that a determinant has in the figures that are wanted: in the plane of (b − a) × (c − a), in space of
/// det(b − a, c − a, d − a). It is no equation: it says which figures of the equations are figures of the problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orientation {
    /// Indices into [`Problem::points`], one more than there are dimensions.
    pub points: Vec<usize>,
    /// Whether the determinant is greater than 0, or less.
    pub is_positive: bool,
}

impl Orientation {
    /// The same said of the points in the order of their indices: each swap of two changes the sign.
    pub fn in_order(&self) -> Self {
        let mut out = self.clone();
        let n = out.points.len();
        for end in (1..n).rev() {
            for k in 0..end {
                if out.points[k] > out.points[k + 1] {
                    out.points.swap(k, k + 1);
                    out.is_positive = !out.is_positive;
                }
            }
        }
        out
    }

    /// The sign as it is written.
    pub fn sign(&self) -> &'static str {
        match self.is_positive {
            true => "+",
            false => "-",
        }
    }
}

impl Problem {
    /// The problem without the signs that it asks for: all figures of its equations, and their mirror images.
    pub fn unsigned(&self) -> Problem {
        Problem {
            orientations: Vec::new(),
            ..self.clone()
        }
    }

    /// An orientation as it is written in messages: `orientation: a, b, c, +`.
    pub fn orientation_name(&self, index: usize) -> String {
        let one = &self.orientations[index];
        let names = one.points.iter().map(|&p| self.points[p].name.as_str());
        let names: Vec<&str> = names.chain([one.sign()]).collect();
        format!("orientation: {}", names.join(", "))
    }
}
