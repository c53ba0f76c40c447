//! What happens between two points: solutions, and the return to the sketch.

use super::Tracker;
use super::cubic::Passages;
use super::path_point::{Piece, distance, dot};

/// Points nearer than this, relative to the figure, are the same.
const SAME: f64 = 2e-8;

/// What was found on a piece of the path.
pub(super) enum Events {
    /// Solutions, if any, were recorded; the path goes on.
    None,
    /// The piece passes through the sketch, at this arc length: the loop is closed.
    Closed(f64),
    /// Cannot be told: the piece is too long.
    Unclear,
}

impl Tracker<'_> {
    /// Looks at the piece from the current point to the next, `h` long. `error` is about how
    /// far it may be from the cubic.
    pub(super) fn look_between(&mut self, h: f64, error: f64) -> Events {
        let piece = Piece::new(&self.current, &self.next, h);
        let t = piece.t();
        let reach = |value: f64| {
            let near = (t.x[0] - value).abs().min((t.x[1] - value).abs());
            near <= h
        };
        let mut end = h;
        let mut closed = false;
        if reach(0.0) {
            match self.passes_sketch(h, error) {
                Ok(Some(s)) => (end, closed) = (s, true),
                Ok(None) => {}
                Err(()) => return Events::Unclear,
            }
        }
        if reach(1.0) {
            let Passages::At(passages, count) = t.passages(1.0, error) else {
                return Events::Unclear;
            };
            let known = self.solutions.len();
            for &s in passages[..count].iter().filter(|&&s| s <= end) {
                if !self.record_solution(s, h, error) {
                    self.solutions.truncate(known);
                    return Events::Unclear;
                }
            }
        }
        if closed {
            Events::Closed(end)
        } else {
            Events::None
        }
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
            found.truncate(places);
            self.solutions.push(found);
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
