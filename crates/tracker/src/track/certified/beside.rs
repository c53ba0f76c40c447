//! How far the figures of a path are off equations that are not among its own: those that were left out.

use super::link::{Frame, Tube};
use super::piece::{Along, Piece};
use crate::equations::Ring as _;
use crate::interval::{Interval, hull, point};
use crate::linalg::Vector;
use crate::system::{Beside, Homotopy};
use crate::track::arc::Off;

/// The equations, and what is known of them so far.
#[derive(Debug)]
pub struct Besides {
    all: Vec<(Beside, Off)>,
    piece: Piece,
}

impl Besides {
    /// Those of a homotopy.
    pub fn new(homotopy: &Homotopy, spare: &Vector) -> Self {
        let besides = homotopy.beside.iter().cloned();
        Besides {
            all: besides.map(|beside| (beside, Off::default())).collect(),
            piece: Piece::new(spare),
        }
    }

    /// Sets out again.
    pub fn begin(&mut self) {
        for (_, off) in &mut self.all {
            *off = Off::default();
        }
    }

    /// Follows them along a tube, between two parameters.
    pub fn follow<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, between: (f64, f64)) {
        let (piece, time) = (&mut self.piece, tube.time());
        for (beside, found) in &mut self.all {
            found.follow(between, beside.within, &mut |(a, b)| {
                piece.look(tube, a, b);
                (beside.off(piece), time.range(a, b))
            });
        }
    }

    /// What is known of each.
    pub fn account(&self) -> Vec<Off> {
        self.all.iter().map(|(_, off)| *off).collect()
    }
}

impl Beside {
    /// Its left-hand side less its right-hand side on a piece of path.
    fn off(&self, piece: &Piece) -> Interval {
        let zero = || Along::whole(0);
        let at = |entry: Option<usize>| entry.map_or_else(zero, |u| piece.at(u));
        let left = self.terms.iter().fold(zero(), |sum, term| {
            sum + Along::constant(0.5 * f64::from(term.factor), 0.0) * term.value(at)
        });
        let (t, right) = (piece.time(), &self.right);
        let coefficients = right.e.iter().zip(&right.e_radius).rev();
        let right = coefficients.fold(zero(), |sum, (&e, &radius)| {
            sum * t + Along::constant(e, radius)
        });
        // A product goes through 12 roundings at most and a sum through 5.
        let off = left - right;
        let reach = off.reach(17 * (self.terms.len() + self.right.e.len() + 4));
        point(off.value) + hull(-reach, reach)
    }
}

#[cfg(test)]
mod tests {
    use crate::constraint::{Entry, Equation, Role, Unknown, value};
    use crate::equations::{Form, Product};
    use crate::interval::{Real, point};
    use crate::system::{Homotopy, Part};
    use crate::track::arc::{ArcEnd, Figure};
    use crate::track::certified::arcs;
    use crate::track::{Control, Options, Space};

    fn equation(products: Vec<Product<Entry>>, right: &[Real]) -> Equation {
        Equation {
            name: "an equation".to_owned(),
            products,
            right: right.to_vec(),
            power: 0,
        }
    }

    /// Along x² = (1 + 2t)² with x = 1 at first x is 1 + 2t, which two equations beside it say, one of them with 0.001 t more: it is off by
    /// 0.0005 from t = 1/2 on.
    #[test]
    fn figures_are_as_far_off_as_they_are() {
        let x = Entry::Unknown(0);
        let whole = |numbers: &[i64]| numbers.iter().map(|&x| Real::whole(x)).collect::<Vec<_>>();
        let thousandth = &Real::whole(1) / &Real::whole(1000);
        let beside = [
            whole(&[1, 2]),
            vec![Real::whole(1), &Real::whole(2) + &thousandth],
        ];
        let square = Product::new(2, value(x), value(x));
        let linear = Product::new(2, value(x), Form::One);
        for radius in [1e-5, 1e-8] {
            let homotopy = Homotopy::of_part(Part {
                dimension: 2,
                coordinates: Vec::new(),
                unit: 1.0,
                unknowns: vec![Unknown {
                    name: "x".to_owned(),
                    sketch: point(1.0),
                    power: 0,
                    role: Role::Free,
                    flips: [false; 3],
                }],
                equations: vec![equation(vec![square], &whole(&[1, 4, 4]))],
                nonzero: Vec::new(),
                followed: Vec::new(),
                segments: Vec::new(),
                beside: beside
                    .iter()
                    .map(|right| (equation(vec![linear], right), [5e-4; 2]))
                    .collect(),
            });
            let options = Options {
                space: Space::Full,
                tube_radius: Some(radius),
                ..Options::certified()
            };
            let start = Figure::of_sketch(&homotopy);
            let run = arcs(homotopy, &options).follow(&start, &mut Control::default());
            assert!(matches!(run.end, ArcEnd::Reached(_)), "{:?}", run.end);
            let [met, missed] = &run.beside[..] else {
                panic!("two were asked for")
            };
            assert!(met.missed.is_none(), "{met:?}");
            let all = met.until().expect("there are figures");
            assert!(all.contains(0.0) && all.mag() < 5e-4, "{met:?}");
            let (off, t) = missed.missed.expect("it is missed");
            assert!(off.mig() > 5e-4 && off.sup() < 0.0, "{off:?}");
            assert!(t.1 > 0.5 && t.0 < 0.5 + 1e-2, "{t:?}");
            let before = missed.until().expect("it is met at first");
            assert!(before.mag() <= 5e-4 + 2.0 * radius, "{missed:?}");
        }
    }
}
