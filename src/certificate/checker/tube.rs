//! One tube, proved again. The mathematics and its notation are in `certs/README.md`.

use super::equations::{Differences, Equations, HALF, ZERO, whole_row};
use super::whole::{Whole, exact, invert, size};
use crate::certificate::format::{TubeClaim, WEIGHT_UNIT};
use crate::interval::{Interval, point};

/// The degree of ẑ.
const ORDER: usize = 5;
/// The largest power of s in F(ẑ(s)), in which t occurs to the fourth.
const DEGREE: usize = 4 * ORDER;

/// A proved tube: for |s| ≤ h exactly one zero φ(s) of F in the cross-section c·(z − ẑ(s)) = 0
/// with |z − ẑ(s)|_u ≤ r, regular, at most `distance` from ẑ(s), φ' at most `slope_distance` from ẑ'.
pub struct Tube {
    /// Coefficients of ẑ, each with n entries and a zero.
    z: Vec<Vec<Interval>>,
    pub normal: Vec<Interval>,
    u: Vec<Interval>,
    h: f64,
    r: f64,
    pub exit: f64,
    /// Holds φ(exit).
    pub exit_box: Vec<Interval>,
    distance: Interval,
    slope_distance: Interval,
    /// c·ẑ'(s), positive.
    advance: Interval,
    /// 1 − q − η/r.
    pub margin: f64,
}

/// What fails in a tube.
type Fault = &'static str;
const LARGE: Fault = "its numbers are too large for the test";

impl Tube {
    pub fn prove(eq: &Equations, claim: &TubeClaim) -> Result<Tube, Fault> {
        let (m, n) = (eq.m, eq.m + 1);
        let spare = [0.0];
        let numbers = |x: &[f64]| {
            x.iter()
                .chain(&spare)
                .map(|&x| point(x))
                .collect::<Vec<_>>()
        };
        let c: Vec<f64> = claim.normal.iter().map(|&c| c.into()).collect();
        let u: Vec<f64> = claim
            .weights
            .iter()
            .map(|&u| WEIGHT_UNIT * f64::from(u))
            .collect();
        let (c, u, weights) = (numbers(&c), numbers(&u), &claim.weights);
        let mut z = vec![numbers(&claim.centre)];
        let (h, r) = (point(claim.h), point(claim.r.into()));
        let mut power = vec![point(1.0)];
        (0..DEGREE).for_each(|k| power.push(power[k] * h));

        // Y, any matrix near the inverse of [J₀; c].
        let mut d = vec![eq.differences(&z[0])];
        let half_square: Vec<[Interval; 5]> =
            (0..m).map(|e| eq.half_square_at(e, z[0][m])).collect();
        let time: Vec<Interval> = half_square.iter().map(|l| -l[1]).collect();
        let last: Vec<f64> = c.iter().map(|c| c.inf()).collect();
        let y_float =
            invert(n, eq.float_matrix(&d[0], &time, &last)).ok_or("its Jacobian is singular")?;
        let y = Whole::nearest(n, &y_float).ok_or(LARGE)?;

        // ẑ, any polynomial near the path, and the coefficients of F(ẑ(s)).
        let mut powers = [[ZERO; DEGREE + 1]; 5];
        let mut f = vec![eq.residual(&d[0], |e| half_square[e][0])];
        let mut beyond = vec![ZERO; n];
        for k in 1..=DEGREE {
            for j in 2..5 {
                for a in 1..k.min(ORDER + 1) {
                    let term = powers[1][a] * powers[j - 1][k - a];
                    powers[j][k] += term;
                }
            }
            // Beyond 2 ORDER there are only powers of t, in the one length that bends.
            if k > 2 * ORDER {
                let (e, l) = (eq.homotopy.bend, &half_square[eq.homotopy.bend]);
                let f = (2..5).fold(ZERO, |sum, j| sum - l[j] * powers[j][k]);
                beyond[e] += around(size(power[k] * f));
                continue;
            }
            // The products in which z_k does not occur.
            let mut rest: Vec<Interval> = (0..m)
                .map(|e| {
                    let degree = eq.homotopy.lengths[e].degree;
                    let l = &half_square[e];
                    (2..=degree).fold(product(&d, e, k), |sum, j| sum - l[j] * powers[j][k])
                })
                .collect();
            if k <= ORDER {
                let of_y = |i: usize| {
                    let row = &y_float[i * n..(i + 1) * n];
                    let sum: f64 = row.iter().zip(&rest).map(|(y, f)| y * f.mid()).sum();
                    exact(if k == 1 { row[m] - sum } else { -sum })
                };
                z.push((0..n).map(of_y).chain([ZERO]).collect());
                d.push(eq.differences(&z[k]));
                let t = z[k][m];
                powers[1][k] = t;
                for (e, rest) in rest.iter_mut().enumerate() {
                    let (a, b) = (&d[0][e], &d[k][e]);
                    *rest += a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - half_square[e][1] * t;
                }
            }
            f.push(rest);
        }

        // The Jacobian along ẑ: its entries of t, and all of its terms as whole numbers and rests.
        let slope_of_time = |e: usize, k: usize| {
            let degree = eq.homotopy.lengths[e].degree;
            (2..=degree).fold(ZERO, |sum, j| {
                sum - point(j as f64) * half_square[e][j] * powers[j - 1][k]
            })
        };
        let mut bounds = vec![ZERO; n];
        let mut whole = Vec::new();
        for k in 0..=2 {
            let entries: Vec<Interval> = match k {
                0 => time.clone(),
                _ => (0..m).map(|e| slope_of_time(e, k)).collect(),
            };
            let (rows, rests) = eq.whole_rows(&d[k], &entries).ok_or(LARGE)?;
            for (bound, rest) in bounds.iter_mut().zip(rests) {
                *bound += power[k] * rest;
            }
            whole.push(rows);
        }
        let (row, rest) = whole_row(&last[..n]).ok_or(LARGE)?;
        whole[0].push(row);
        bounds[m] += rest;
        for e in 0..m {
            let weight = eq.weight(e, &u);
            for k in 3..=ORDER {
                let change =
                    (0..3).fold(ZERO, |sum, axis| sum + size(d[k][e][axis]) * weight[axis]);
                bounds[e] += power[k] * change;
            }
            let degree = eq.homotopy.lengths[e].degree;
            for k in 3..=(degree - 1) * ORDER {
                bounds[e] += power[k] * size(slope_of_time(e, k)) * u[m];
            }
        }

        // |M|_u ≤ q for |s| ≤ h, |w|_u ≤ r.
        let r0 = y.defect(&whole[0], weights).ok_or(LARGE)?;
        let (a, r1) = y.moving(&whole[1], weights).ok_or(LARGE)?;
        let [square, a2] = a.square_minus(&y, &whole[2], weights).ok_or(LARGE)?;
        let a_norm = a.norm(weights).ok_or(LARGE)?;
        let norm = |v: &[Interval]| y.norm_of(v, weights).ok_or(LARGE);
        let moving = point(1.0) + h * a_norm;
        let stiff = moving * (r0 + h * r1 + norm(&magnitudes(&bounds))?)
            + power[2] * (square + h * a_norm * a2);
        let reach = around(h);
        let time_range = polynomial(&z, m, reach) + around(r * u[m]);
        let bend: Vec<Interval> = (0..m).map(|e| eq.bend_of(e, time_range)).collect();
        let mut width: Vec<Interval> = (0..m)
            .map(|e| {
                let squares = eq.weight(e, &u).iter().fold(ZERO, |sum, w| sum + w.sqr());
                squares + bend[e] * u[m].sqr()
            })
            .collect();
        width.push(ZERO);
        let width = moving * norm(&magnitudes(&width))?;
        let q = upper(stiff + width * r);

        // |Ỹ(s) F(ẑ(s))|_u ≤ η, and of its derivative by s without the factor of Ỹ.
        let (mut defect, mut defect_slope) = (ZERO, ZERO);
        for (k, mut f) in f.into_iter().enumerate() {
            f.iter_mut().for_each(|f| *f *= power[k]);
            f.push(ZERO);
            let norm = norm(&f)?;
            defect += norm;
            if k > 0 {
                defect_slope += point(k as f64) / h * norm;
            }
        }
        let beyond = norm(&beyond)?;
        defect += beyond;
        defect_slope += point(DEGREE as f64) / h * beyond;
        let defect = upper(moving * defect);
        let one = point(1.0);
        if !(q.sup() < 1.0) {
            return Err("the Krawczyk test fails: its map is no contraction of the box");
        }
        let margin = (one - q - defect / r).inf();
        if !(margin > 0.0) {
            return Err("the Krawczyk test fails: the box is not mapped into its inside");
        }
        let near = upper(defect / (one - q));
        let nearer_q = upper(stiff + width * near);
        let distance = upper(defect / (one - nearer_q));

        // φ' − ẑ' solves [J; c] x = −(J ẑ'; 0), with J ẑ' = F(ẑ)' + (J − J(ẑ)) ẑ'.
        let along = (1..=ORDER)
            .map(|k| dot(&c[..n], &z[k][..n]))
            .collect::<Vec<_>>();
        let advance = (1..=ORDER).fold(ZERO, |sum, k| {
            let range = if k == 1 { one } else { around(power[k - 1]) };
            sum + point(k as f64) * along[k - 1] * range
        });
        if !(advance.inf() > 0.5) {
            return Err("its cross-sections turn back");
        }
        let growth = (0..=ORDER).map(|k| point(k as f64) * power[k.saturating_sub(1)]);
        let growth: Vec<Interval> = growth.collect();
        let slope_of = |x: &dyn Fn(usize) -> Interval| {
            (1..=ORDER).fold(ZERO, |sum, k| sum + growth[k] * size(x(k)))
        };
        let t_slope = slope_of(&|k| z[k][m]);
        let mut turn: Vec<Interval> = (0..m)
            .map(|e| {
                let weight = eq.weight(e, &u);
                let sides = (0..3).fold(ZERO, |sum, axis| {
                    sum + weight[axis] * slope_of(&|k| d[k][e][axis])
                });
                size(distance * (sides + bend[e] * u[m] * t_slope))
            })
            .collect();
        turn.push(ZERO);
        let slope_distance =
            upper(moving * (defect_slope + norm(&magnitudes(&turn))?) / (one - nearer_q));

        let mut tube = Tube {
            z,
            normal: c,
            u,
            h: claim.h,
            r: claim.r.into(),
            exit: claim.exit,
            exit_box: Vec::new(),
            distance,
            slope_distance,
            advance,
            margin,
        };
        tube.exit_box = tube.enclose_exit(eq, &y, &y_float, &a, (moving / (one - q), weights))?;
        Ok(tube)
    }

    /// A box around φ(exit): a few steps w ← w − Ỹ G(w) come near it, and it is at most
    /// |Ỹ G(w)|_u / (1 − q) from any w in the box; `factor` bounds |I − sA|_u / (1 − q).
    fn enclose_exit(
        &self,
        eq: &Equations,
        y: &Whole,
        y_float: &[f64],
        a: &Whole,
        (factor, weights): (Interval, &[u16]),
    ) -> Result<Vec<Interval>, Fault> {
        let (m, n) = (eq.m, eq.m + 1);
        let middle = self.at(point(self.exit));
        let mut z: Vec<f64> = middle.iter().map(|x| x.mid()).collect();
        for _ in 0..2 {
            let mut g = eq.float_residual(&z);
            g.push(
                (0..n)
                    .map(|i| self.normal[i].inf() * (z[i] - middle[i].mid()))
                    .sum(),
            );
            let times = |matrix: &dyn Fn(usize) -> f64, v: &[f64]| -> Vec<f64> {
                let row = |i: usize| (0..n).map(|j| matrix(i * n + j) * v[j]).sum();
                (0..n).map(row).collect()
            };
            let step = times(&|k| y_float[k], &g);
            let turned = times(&|k| a.float(k), &step);
            (0..n).for_each(|i| z[i] -= step[i] - self.exit * turned[i]);
        }
        let z: Vec<Interval> = z.into_iter().map(exact).collect();
        let mut g = eq.residual(&eq.differences(&z), |e| eq.half_square_at(e, z[m])[0]);
        g.push((0..n).fold(ZERO, |sum, i| sum + self.normal[i] * (z[i] - middle[i])));
        let far = upper(factor * y.norm_of(&g, weights).ok_or(LARGE)?);
        let inside = |i: usize| size(z[i] - middle[i]).sup() <= (point(self.r) * self.u[i]).inf();
        if !(0..n).all(inside) || !(far.sup() < self.r) {
            return Err("its exit cannot be enclosed");
        }
        Ok((0..=n).map(|i| z[i] + around(far * self.u[i])).collect())
    }

    /// The parameters s with φ(s) = z, for a zero z of F that lies in a box. `None`: it could
    /// not be proved that there is one.
    ///
    /// g(s) = c·(z − ẑ(s)) falls with slope −c·ẑ'; Newton's interval holds its zero.
    pub fn locate(&self, z: &[Interval]) -> Option<Interval> {
        let n = z.len() - 1;
        let guess = (0..n).fold(0.0, |sum, i| {
            sum + self.normal[i].inf() * (z[i].mid() - self.z[0][i].inf())
        });
        if !(guess.abs() <= self.h) {
            return None;
        }
        let near = self.at(point(guess));
        let g = (0..n).fold(ZERO, |sum, i| sum + self.normal[i] * (z[i] - near[i]));
        let s = point(guess) + g / self.advance;
        if !(s.mag() <= self.h) {
            return None;
        }
        let there = self.at(s);
        let inside = |i: usize| size(z[i] - there[i]).sup() < (point(self.r) * self.u[i]).inf();
        (0..n).all(inside).then_some(s)
    }

    /// ẑ(s) for all s of a range.
    fn at(&self, s: Interval) -> Vec<Interval> {
        (0..self.u.len())
            .map(|i| polynomial(&self.z, i, s))
            .collect()
    }

    /// Whether φ' has a positive component along `normal` at all parameters of a range.
    pub fn goes_along(&self, s: Interval, normal: &[Interval]) -> bool {
        let n = self.u.len() - 1;
        let component = (0..n).fold(ZERO, |sum, i| {
            sum + normal[i] * (derivative(&self.z, i, s) + around(self.slope_distance * self.u[i]))
        });
        component.inf() > 0.0
    }

    /// t on the path for all parameters between two.
    pub fn time(&self, a: f64, b: f64) -> Interval {
        let t = self.u.len() - 2;
        let range = between(a, b);
        let middle = point(range.mid());
        let value =
            polynomial(&self.z, t, middle) + derivative(&self.z, t, range) * (range - middle);
        value + around(self.distance * self.u[t])
    }

    /// dt/ds on the path.
    fn time_slope(&self, a: f64, b: f64) -> Interval {
        let t = self.u.len() - 2;
        derivative(&self.z, t, between(a, b)) + around(self.slope_distance * self.u[t])
    }

    /// All crossings of t = 1 with parameters from `from` to `to`, and perhaps some a little
    /// outside: ranges with exactly one each. `None`: the signs of t − 1 and t' could not be told.
    pub fn crossings(&self, from: f64, to: f64) -> Option<Vec<(f64, f64)>> {
        if !self.time(from, to).contains(1.0) {
            return Some(Vec::new());
        }
        let (from, to) = (self.clear(from, -1.0)?, self.clear(to, 1.0)?);
        // Stretches on which t is monotone, true for rising, in order.
        let mut stretches: Vec<(f64, f64, bool)> = Vec::new();
        let mut stack = vec![(from, to, 0)];
        let mut pieces = 0;
        while let Some((a, b, depth)) = stack.pop() {
            pieces += 1;
            if !self.time(a, b).contains(1.0) {
                continue;
            }
            let slope = self.time_slope(a, b);
            if slope.contains(0.0) {
                if depth == 40 || pieces > 10_000 {
                    return None;
                }
                let middle = 0.5 * (a + b);
                stack.extend([(middle, b, depth + 1), (a, middle, depth + 1)]);
                continue;
            }
            let rising = slope.inf() > 0.0;
            match stretches.last_mut() {
                Some((_, end, way)) if *end == a && *way == rising => *end = b,
                _ => stretches.push((a, b, rising)),
            }
        }
        let mut crossings = Vec::new();
        for (a, b, rising) in stretches {
            // Next to a stretch t = 1 is ruled out, or the direction changes: then this fails.
            match (self.above(a)?, self.above(b)?) {
                (x, y) if x == y => {}
                (before, _) if before == rising => return None,
                _ => crossings.push((a, b)),
            }
        }
        Some(crossings)
    }

    /// Whether t > 1; `None` where that is not certain.
    fn above(&self, s: f64) -> Option<bool> {
        let t = self.time(s, s);
        (!t.contains(1.0)).then_some(t.inf() > 1.0)
    }

    /// Moves an end outwards until t ≠ 1 is certain there.
    fn clear(&self, end: f64, direction: f64) -> Option<f64> {
        let mut step = 0.0;
        loop {
            let s = end + direction * step;
            if !(s.abs() <= self.h) {
                return None;
            }
            if self.above(s).is_some() {
                return Some(s);
            }
            step = if step == 0.0 {
                1e-12 * self.h
            } else {
                2.0 * step
            };
        }
    }
}

/// Σ over the pairs a + b = k, a, b ≥ 1, of ½ d_a·d_b.
fn product(d: &[Differences], e: usize, k: usize) -> Interval {
    let mut sum = ZERO;
    for a in k.saturating_sub(ORDER).max(1)..=k / 2 {
        let (x, y) = (&d[a][e], &d[k - a][e]);
        let dot = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        sum += if 2 * a == k { HALF * dot } else { dot };
    }
    sum
}

fn polynomial(z: &[Vec<Interval>], i: usize, s: Interval) -> Interval {
    z.iter().rev().fold(ZERO, |sum, z| sum * s + z[i])
}

fn derivative(z: &[Vec<Interval>], i: usize, s: Interval) -> Interval {
    (1..=ORDER)
        .rev()
        .fold(ZERO, |sum, k| sum * s + point(k as f64) * z[k][i])
}

fn dot(a: &[Interval], b: &[Interval]) -> Interval {
    a.iter().zip(b).fold(ZERO, |sum, (a, b)| sum + *a * *b)
}

/// [−x, x] for the upper end of a non-negative x.
pub fn around(x: Interval) -> Interval {
    inari::interval!(-x.sup(), x.sup()).unwrap_or(Interval::ENTIRE)
}

/// The upper end.
pub fn upper(x: Interval) -> Interval {
    exact(x.sup())
}

fn between(a: f64, b: f64) -> Interval {
    inari::interval!(a, b).unwrap_or(Interval::ENTIRE)
}

/// [−x, x] for each: so that the sizes of Y's entries count, not their signs.
pub fn magnitudes(v: &[Interval]) -> Vec<Interval> {
    v.iter().map(|&x| around(size(x))).collect()
}
