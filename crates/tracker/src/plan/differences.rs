//! Derivatives as RR 8705 takes them: finite differences that use the plan's order.

use super::Evaluation;

impl Evaluation {
    /// Derivatives of figure and removed constraints at `q` by forward differences of the given
    /// step, in place of [`Evaluation::differentiate`]. False if `q`, or a point a step from it,
    /// is outside the domain.
    ///
    /// For parameter k_j only the instructions from the one that uses it on are evaluated again, j
    /// going from d to 1 (RR 8705, section 7.2).
    pub fn difference(&mut self, q: &[f64], step: f64, scratch: &mut Differences) -> bool {
        if !self.evaluate(q) {
            return false;
        }
        scratch.places.clone_from(&self.places);
        scratch.residual.clone_from(&self.residual);
        let mut inside = true;
        for j in (0..self.driving).rev() {
            let lane = j + 1;
            let Some(first) = self.rows.iter().position(|row| row.lanes.contains(&lane)) else {
                continue;
            };
            self.set_driving(j, q[lane] + step);
            inside &= self.construct(first);
            self.store_differences(lane, first, step, scratch);
            self.set_driving(j, q[lane]);
        }
        self.set_time(q[0] + step);
        inside &= self.construct(0);
        self.store_differences(0, 0, step, scratch);
        self.evaluate(q) && inside
    }

    fn store_differences(&mut self, lane: usize, first: usize, step: f64, base: &Differences) {
        let (chunk, at) = (lane / 4, lane % 4);
        for row in &self.rows[first..] {
            for axis in 0..self.dimension {
                let p = row.point * self.dimension + axis;
                let of_point = (row.point * self.chunks + chunk) * self.dimension;
                self.sensitivity[of_point + axis].0[at] = (self.places[p] - base.places[p]) / step;
            }
        }
        for (k, (now, before)) in self.residual.iter().zip(&base.residual).enumerate() {
            self.jacobian[k * self.chunks + chunk].0[at] = (now - before) / step;
        }
    }
}

/// Room for the values that differences are taken from.
#[derive(Debug, Clone, Default)]
pub struct Differences {
    places: Vec<f64>,
    residual: Vec<f64>,
}
