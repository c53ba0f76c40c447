//! Newton's method from a guess to a figure that is proved.

use crate::certificate::cover::{Figure, Frame};
use crate::elimination::invert;
use crate::interval::rounding::largest;

/// Newton's method from a guess, then the proof. `None`: no figure was proved.
pub fn prove(frame: &Frame, guess: &[[f64; 3]]) -> Option<Figure> {
    let m = frame.m;
    let mut x = guess.to_vec();
    let (mut f, mut step) = (vec![0.0; m], vec![0.0; m]);
    let mut y = Vec::new();
    let mut last = f64::INFINITY;
    for round in 0..12 {
        // The last inverses differ by nothing that matters.
        if round < 5 {
            frame.jacobian(&x, &mut y);
            if !invert(&mut y, m) {
                return None;
            }
        }
        frame.residual(&x, &mut f);
        for (i, s) in step.iter_mut().enumerate() {
            *s = y[i * m..(i + 1) * m]
                .iter()
                .zip(&f)
                .map(|(a, b)| a * b)
                .sum();
        }
        let size = step.iter().fold(0.0, |a, x| largest(a, x.abs()));
        if !(size < 1.0) {
            return None;
        }
        frame.moved(&mut x, &step, -1.0);
        let done = size < 1e-15 || (size >= 0.5 * last && size < 1e-11);
        last = size;
        if done {
            break;
        }
    }
    if !(last < 1e-7) && m > 0 {
        return None;
    }
    frame.prove(&x)
}
