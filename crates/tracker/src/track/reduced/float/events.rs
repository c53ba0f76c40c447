//! What happens between two points: solutions, and the return to the sketch.

use super::Tracker;
use super::cubic::Passages;
use super::path_point::{Piece, distance, dot};
use crate::linalg::Vector;

/// Points nearer than this, relative to the figure, are the same.
const SAME: f64 = 2e-8;

impl Tracker<'_> {
    /// Records the solutions on the piece from the current point to the next, `h` long. `error` is about how
    /// far it may be from the cubic. Tells at which arc length it passes through the sketch, if it does: the loop is
    /// closed. The error: that cannot be told, as the piece is too long.
    pub(super) fn look_between(&mut self, h: f64, error: f64) -> Result<Option<f64>, ()> {
        let piece = Piece::new(&self.current, &self.next, h);
        let t = piece.t();
        let reach = |value: f64| {
            let near = (t.x[0] - value).abs().min((t.x[1] - value).abs());
            near <= h
        };
        let end = match reach(0.0) {
            true => self.passes_sketch(h, error)?,
            false => None,
        };
        if reach(1.0) {
            let Passages::At(passages, count) = t.passages(1.0, error) else {
                return Err(());
            };
            let known = self.record.found.len();
            let last = end.unwrap_or(h);
            for &s in passages[..count].iter().filter(|&&s| s <= last) {
                if !self.record_solution(s, h, error) {
                    self.record.found.truncate(known);
                    return Err(());
                }
            }
        }
        Ok(end)
    }

    /// Finds the solution near arc length `s` of the piece in full precision, at t = 1.
    fn record_solution(&mut self, s: f64, h: f64, error: f64) -> bool {
        let places = self.homotopy.sketch.len();
        let piece = Piece::new(&self.current, &self.next, h);
        let guess = &mut self.predicted;
        piece.at(s, guess);
        guess[places] = 1.0;
        let mut found = guess.clone();
        let converged = self
            .corrector
            .refine(&mut self.evaluation, None, &mut found);
        // It is this piece's solution if it is where the piece is. Near a turning point of t a
        // small error of the cubic shifts the place by its square root.
        let near = distance(&found, guess) <= (10.0 * error + 0.1 * h).min(0.5 * h) + 1e-9;
        if converged && near {
            let free = &self.homotopy.gauge.place;
            let mut unknowns = Vector::zeros(free.len() + 1);
            let values = free.iter().chain([&places]).map(|&place| found[place]);
            unknowns.iter_mut().zip(values).for_each(|(x, z)| *x = z);
            self.record.found.push(unknowns);
        }
        converged && near
    }

    /// Where the piece passes through the sketch in the direction in which the path set off.
    fn passes_sketch(&mut self, h: f64, error: f64) -> Result<Option<f64>, ()> {
        let start = &self.start;
        let piece = Piece::new(&self.current, &self.next, h);
        if distance(&self.next.z, &start.z) > 2.0 * h + error {
            return Ok(None);
        }
        let height = piece.height(&start.tangent, &start.z);
        if !(height.x[0] < 0.0 && height.x[1] >= 0.0) {
            return Ok(None);
        }
        let Passages::At(passages, count) = height.passages(0.0, 0.0) else {
            return Err(());
        };
        for &s in &passages[..count] {
            let guess = &mut self.predicted;
            piece.at(s, guess);
            if distance(guess, &start.z) > 10.0 * error + 0.1 * h {
                continue;
            }
            if !self
                .corrector
                .refine(&mut self.evaluation, Some(&start.z), guess)
            {
                return Err(());
            }
            let same_way = dot(&self.next.tangent, &start.tangent) > 0.0;
            if same_way && distance(guess, &start.z) < SAME * dot(&start.z, &start.z).sqrt() {
                return Ok(Some(s));
            }
        }
        Ok(None)
    }
}
