//! Proof of a box around one complex solution in double-doubles, with exact residuals, where the tracker's own proof
//! (an extended residual, all else in floats) does not suffice: solutions that are large or nearly singular.
//!
//! With x the middle, J = F'(x), Y about J⁻¹ and Q the quadratic part of F, a zero x + h of F is a fixed point of
//! N(h) = h − Y F(x + h) = −Y F(x) + (I − Y J) h − Y Q(h), and the other way round where |I − Y J| < 1, as Y is invertible
//! then. In the norm max |h_k|, |h_k| being the size of a complex number, let
//!
//! - η bound |Y F(x)|, α bound |I − Y J|, and β bound |Y B(h, g)| for |h|, |g| ≤ 1, B being the symmetric bilinear form with
//!   Q(h) = B(h, h), so that |Y (Q(h) − Q(g))| = |Y B(h − g, h + g)| ≤ 2 β r |h − g| for |h|, |g| ≤ r.
//!
//! If α < 1, η + α r + β r² ≤ r and α + 2 β r < 1, N maps the ball of radius r into itself and contracts it: exactly one zero is in
//! it, where the Jacobian is regular, as |I − Y F'(x + h)| ≤ α + 2 β r. If α + 2 β R < 1 there is at most one in the ball of radius R.
//! (Kantorovich's theorem for quadratic maps.)
//!
//! The ball is of sizes of complex numbers; boxes have real and imaginary parts. Numbers both of whose parts are at most r are
//! at most √2 r < 1.5 r in size, so that 1.5 r has to be such an R; numbers both of whose parts are less than 0.7 R are less than 0.99 R in
//! size.
//!
//! F(x) is evaluated in exact ratios; Y, which may be any matrix, J and their product in double-doubles, with the bounds
//! of [`gamma_double`]. Sizes of complex numbers are bounded by |Re| + |Im|.

use super::boxes::SolutionBox;
use super::exact::Exact;
use super::matrix::Matrix;
use super::system::System;
use crate::equations::{Form, slopes};
use crate::interval::complex::Complex;
use crate::interval::rounding::{UNDERFLOW, in_range, largest, round_up};
use crate::interval::{DoubleDouble, gamma_double};
use crate::places::Each as _;
use crate::rational::Rational;
use crate::system::Right;
use crate::track::arc::Figure;

type Z = Complex<DoubleDouble>;

/// Newton's method is given up after so many corrections.
const MOST_CORRECTIONS: usize = 12;
/// Corrections below this part of the unknowns' size are as good as the numbers' last digit lets them be.
const SETTLED: f64 = 1e-29;

/// Proves boxes around solutions of one system.
#[derive(Debug)]
pub struct EndProver {
    system: System,
    /// The right-hand sides at t = 1, and how far the exact ones may be from them, in |Re| + |Im|.
    wanted: Vec<(Z, f64)>,
    matrix: Matrix<DoubleDouble>,
}

impl EndProver {
    /// For what these right-hand sides, of real and imaginary parts in turn, are at t = 1.
    pub fn new(system: &System, rights: &[Right]) -> Self {
        let wanted = rights.chunks(2).map(|parts| {
            let [(re, a), (im, b)] = [&parts[0], &parts[1]].each(Right::double_at_target);
            (Complex::new(re, im), round_up(a + b, 1))
        });
        EndProver {
            wanted: wanted.collect(),
            matrix: Matrix::new(system.unknowns.len()),
            system: system.clone(),
        }
    }

    /// Proves a box around the solution near a point: real and imaginary part of every unknown in turn.
    pub fn prove(&mut self, near: &[DoubleDouble]) -> Result<SolutionBox, String> {
        let mut x: Vec<Z> = near
            .chunks(2)
            .map(|parts| Complex::new(parts[0], parts[1]))
            .collect();
        self.refine(&mut x)?;
        let [eta, alpha, beta] = self.bounds(&x)?;
        let size = size_of(&x);
        let too_coarse = || {
            format!(
                "in twice a float's digits no box around it could be proved to hold one solution: its largest coordinate is \
                 {size:.1e} typical lengths, and its equations are nearly singular there"
            )
        };
        let contracts = |r: f64| contracts(alpha, beta, r);
        let radius = 2.0 * eta / (1.0 - alpha) + f64::MIN_POSITIVE.sqrt();
        let least = 1.5 * radius;
        if !has_one_zero([eta, alpha, beta], radius) {
            return Err(too_coarse());
        }
        // Any number for which the inequality holds will do.
        let most = 0.99 * (1.0 - alpha) / (2.0 * beta);
        let alone = if contracts(most) {
            most.max(least)
        } else {
            least
        };
        let parts = |part: fn(DoubleDouble) -> f64| {
            x.iter()
                .flat_map(|z| [part(z.re), part(z.im)])
                .collect::<Vec<f64>>()
        };
        let figure = Figure {
            centre: parts(|x| x.hi),
            low: parts(|x| x.lo),
            radius: vec![radius; 2 * x.len()],
        };
        Ok(SolutionBox::new(figure, 0.7 * alone))
    }

    /// Newton's method, with exact residuals.
    fn refine(&mut self, x: &mut [Z]) -> Result<(), String> {
        let mut before = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            self.eliminate(x)?;
            let (f, _) = self.residual(x)?;
            let mut step = f;
            self.matrix.solve(&mut step);
            let change = size_of(&step) / size_of(x);
            if !change.is_finite() {
                break;
            }
            if change >= before && before < 1e-20 {
                return Ok(());
            }
            for (x, step) in x.iter_mut().zip(step) {
                *x = *x - step;
            }
            if change < SETTLED {
                return Ok(());
            }
            before = change;
        }
        match before < 1e-20 {
            true => Ok(()),
            false => Err("Newton's method does not settle at the path's end".to_owned()),
        }
    }

    /// Tells what stands in the Jacobian: row, column, value.
    ///
    /// A value passes through a difference and a product before it is added to an entry.
    fn slopes(&self, x: &[Z], mut tell: impl FnMut(usize, usize, Z)) {
        let at = |entry: Option<usize>| entry.map(|i| x[i]).unwrap_or_default();
        for (e, equation) in self.system.equations.iter().enumerate() {
            slopes(&equation.terms, at, |unknown, slope| {
                unknown.into_iter().for_each(|u| tell(e, u, slope));
            });
        }
    }

    fn eliminate(&mut self, x: &[Z]) -> Result<(), String> {
        let mut matrix = std::mem::replace(&mut self.matrix, Matrix::new(0));
        matrix.clear();
        self.slopes(x, |e, unknown, slope| matrix.add(e, unknown, slope));
        let regular = matrix.eliminate();
        self.matrix = matrix;
        match regular {
            true => Ok(()),
            false => Err("the equations are singular at the path's end".to_owned()),
        }
    }

    /// F(x), rounded, and how far each exact value may be from that, in |Re| + |Im|.
    fn residual(&self, x: &[Z]) -> Result<(Vec<Z>, Vec<f64>), String> {
        let exact = |x: &DoubleDouble| -> Option<Rational> {
            Some(Rational::from_float(x.hi)? + Rational::from_float(x.lo)?)
        };
        let exactly = |z: &Z| -> Option<Exact> {
            Some(Exact {
                re: exact(&z.re)?,
                im: exact(&z.im)?,
            })
        };
        // So that their products are numbers.
        let are_in_range = x.iter().all(|z| in_range(z.sum_of_sizes()));
        let at: Option<Vec<Exact>> = x.iter().map(exactly).collect();
        let at = at
            .filter(|_| are_in_range)
            .ok_or("Newton's method does not settle at the path's end")?;
        let half = Rational::new(1.into(), 2.into());
        let (mut values, mut errors) = (Vec::new(), Vec::new());
        for (e, (wanted, radius)) in self.wanted.iter().enumerate() {
            let twice = self.system.evaluate(e, |u| at[u].clone());
            let wanted = exactly(wanted).ok_or("a dimension is no number")?;
            let (re, a) = DoubleDouble::near(&(twice.re * &half - wanted.re));
            let (im, b) = DoubleDouble::near(&(twice.im * &half - wanted.im));
            values.push(Complex::new(re, im));
            errors.push(round_up(a + b + radius, 2));
        }
        Ok((values, errors))
    }

    /// η, α and β of the module's text.
    fn bounds(&mut self, x: &[Z]) -> Result<[f64; 3], String> {
        let n = x.len();
        self.eliminate(x)?;
        // Y column by column.
        let mut columns = Vec::with_capacity(n);
        for e in 0..n {
            let mut column = vec![Z::default(); n];
            column[e] = Complex::real(1.0);
            self.matrix.solve(&mut column);
            if !column.iter().all(|y| in_range(y.sum_of_sizes())) {
                return Err("the equations are singular at the path's end".to_owned());
            }
            columns.push(column);
        }
        // J with |Re| + |Im| of all that is added up to each entry.
        let mut rows: Vec<Vec<(usize, Z, f64)>> = vec![Vec::new(); n];
        let mut longest = 0;
        self.slopes(x, |e, unknown, slope| {
            rows[e].push((unknown, slope, slope.sum_of_sizes()));
            longest = longest.max(rows[e].len());
        });
        let (f, errors) = self.residual(x)?;
        // A slope passes through a difference and a product with a real number before it is multiplied with an entry of Y,
        // which takes a product and a sum of two, and then is added to at most as many as there are slopes.
        let error = gamma_double(longest * n + 10);
        // In floats every bound is a sum of at most so many numbers that went through a few operations each.
        let operations = longest * n + 20;
        let (mut eta, mut alpha, mut beta) = (0.0f64, 0.0f64, 0.0f64);
        let weights = self.weights();
        for k in 0..n {
            let mut defect = vec![Z::default(); n];
            defect[k] = Complex::real(-1.0);
            let mut step = Z::default();
            let (mut of_step, mut of_defect, mut curved) = (0.0, 1.0, 0.0);
            for e in 0..n {
                let y = columns[e][k];
                let size = y.sum_of_sizes();
                for &(unknown, slope, slope_size) in &rows[e] {
                    defect[unknown] = defect[unknown] + y * slope;
                    of_defect += size * slope_size;
                }
                step = step + y * f[e];
                of_step += size * (error * f[e].sum_of_sizes() + errors[e]);
                curved += size * weights[e];
            }
            let off = defect.iter().map(|z| z.sum_of_sizes()).sum::<f64>() + error * of_defect;
            eta = largest(eta, step.sum_of_sizes() + of_step);
            alpha = largest(alpha, off);
            beta = largest(beta, curved);
        }
        Ok([eta, alpha, beta].each(|bound| round_up(bound, operations) + n as f64 * UNDERFLOW))
    }

    /// Bounds on |B_e(h, g)| for |h|, |g| ≤ 1.
    fn weights(&self) -> Vec<f64> {
        // How many unknowns there are in a form.
        let count = |form: Form<Option<usize>>| form.entries().filter(|(i, _)| i.is_some()).count();
        let of = |equation: &super::system::Equation| {
            let terms = equation.terms.iter().map(|term| {
                let product = count(term.left) * count(term.right);
                0.5 * f64::from(term.factor).abs() * product as f64
            });
            terms.sum()
        };
        self.system.equations.iter().map(of).collect()
    }
}

/// Whether α + 2 β r < 1, in at most five roundings.
fn contracts(alpha: f64, beta: f64, r: f64) -> bool {
    round_up(alpha + 2.0 * beta * r, 5) < 1.0
}

/// Whether the bounds prove that there is exactly one zero in the box of this radius.
fn has_one_zero([eta, alpha, beta]: [f64; 3], r: f64) -> bool {
    // So that no number is none.
    let are_numbers = [eta, alpha, beta, r].into_iter().all(in_range);
    let is_kept = round_up(eta + alpha * r + beta * r * r, 5) <= r;
    are_numbers && r > 0.0 && alpha < 1.0 && is_kept && contracts(alpha, beta, 1.5 * r)
}

/// About the size of the largest number.
fn size_of(x: &[Z]) -> f64 {
    x.iter().map(|z| z.norm_sqr()).fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::Random;
    use crate::complex::exact;
    use crate::complex::lower::lower;
    use crate::complex::start::draw;
    use crate::complex::system::segment;
    use crate::problem::Problem;

    #[test]
    fn bounds_that_prove_nothing_are_refused() {
        assert!(has_one_zero([0.01, 0.1, 1.0], 0.02));
        // α > 1, with a negative radius for which both inequalities hold.
        assert!(!has_one_zero([0.002, 1.1, 1.0], -0.04));
        assert!(!has_one_zero([0.01, 0.1, 100.0], 0.02));
        assert!(!has_one_zero([0.01, f64::NAN, 1.0], 0.02));
        assert!(!has_one_zero([0.0, 0.0, 0.0], f64::INFINITY));
    }

    /// Random figures whose coordinates are known exactly: each is in its box, which is narrower than floats are apart.
    #[test]
    fn a_figure_is_in_its_box_and_far_from_it_there_is_none() {
        let problem = Problem::read("../../problems/octahedron.toml").unwrap();
        let system = lower(&problem).unwrap().system;
        let mut random = Random::new(5);
        for _ in 0..10 {
            let Some(figure) = draw(&system, &mut random) else {
                continue;
            };
            let rights = segment(&figure.parameters, &figure.parameters, None);
            let parts = |value: &exact::Exact| [value.re.clone(), value.im.clone()];
            let exactly: Vec<Rational> = figure.values.iter().flat_map(parts).collect();
            // From a point that is wrong in the eighth digit.
            let near = exactly
                .iter()
                .map(|x| DoubleDouble::near(x).0 * DoubleDouble::from(1.0 + 1e-8));
            let near: Vec<DoubleDouble> = near.collect();
            let found = EndProver::new(&system, &rights).prove(&near).unwrap();
            assert!(found.radius() < 1e-22 && found.alone_within > 1e-6);
            for ((x, middle), radius) in
                exactly.iter().zip(found.middle()).zip(&found.figure.radius)
            {
                let exact = |x: f64| Rational::from_float(x).unwrap();
                let off = x - exact(middle.hi) - exact(middle.lo);
                assert!(off.abs() <= exact(*radius));
            }
        }
    }
}
