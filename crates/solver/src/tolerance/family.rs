//! All figures that a figure becomes as right-hand sides of its equations go through ranges: exactly one for every choice of them, by one test of
//! Krawczyk.
//!
//! The equations are quadratic, left(x) = r. About a middle c with Jacobian J and Y ≈ J⁻¹, what u = x − c is of a zero x is
//!
//! u = Y (r − left(c)) − Y Q(u) + (I − Y J) u,
//!
//! with Q the part of second order, exactly. So u is linear in r but for a rest of second order, and the Jacobian and Q depend on nothing but the
//! differences of unknowns that are multiplied in the equations. Both are bounded difference by difference: what two points that are joined
//! do together, such as turning with all before them, is not counted as if each did it alone.

use crate::elimination::invert;
use crate::equations::Form;
use crate::interval::rounding::{gamma, in_range, round_up};
use crate::interval::{Interval, around, hull, point};
use crate::linalg::dot;
use crate::system::Homotopy;
use std::cell::OnceCell;
use std::rc::Rc;

/// The test is tried with so many boxes, each made after what the one before came to.
const ROUNDS: usize = 40;

/// What is bounded in the norm is bounded again so often, as what it is made of.
const TIMES: usize = 3;

/// Boxes in which there is one figure are at least so wide, of the figure's size, so that figures that are known almost as well are seen to be in
/// them.
const ROOM: f64 = 1e-11;

/// No figure is so far from a middle, in units of length: what comes to that is given up.
const FAR: f64 = 1e9;

/// Two unknowns, of which the first is taken less the second; `None` is the number 0.
type Difference = [Option<usize>; 2];

/// Half a factor times the product of two differences, by their numbers.
type Term = (Interval, usize, usize);

/// All figures with right-hand sides in ranges that are near a figure: for every choice exactly one.
pub(super) struct Family {
    /// What they are seen from.
    pub middle: Middle,
    /// The differences in the equations; before these each unknown itself.
    differences: Vec<Difference>,
    /// The terms of second order of each equation.
    terms: Vec<Vec<Term>>,
    /// By Y, what each equation adds to each difference, a row for each difference: each rounded once.
    applied: Vec<f64>,
    /// Bounds on their sizes.
    sizes: Vec<f64>,
    /// I − Y J in the middle: bounds.
    defect: Vec<f64>,
    /// The left-hand sides in the middle.
    left: Vec<Interval>,
    /// The right-hand sides less the left-hand ones in the middle, for all choices.
    grown: Vec<Interval>,
    /// Of each difference as seen from the middle the part of second order, so bounded that the figure with each choice is the only one for which
    /// all differences are so.
    only: Vec<Interval>,
    /// Of each difference as seen from the middle the part that is linear in the right-hand sides.
    linear: Vec<Interval>,
    /// A sharper bound of what is of second order.
    rest: Vec<Interval>,
    /// Of each difference as seen from the middle all that it can be.
    around: Vec<Interval>,
    /// A norm: the greatest of |difference| / weight. In it I − Y J, with J that of the middle between any two figures, is `contraction` at most.
    weights: Vec<f64>,
    /// See `weights`: less than 1.
    contraction: f64,
    /// See [`Family::movers`]: asked for seldom.
    movers: OnceCell<Rc<Vec<Vec<u64>>>>,
}

/// A middle and about the inverse of the Jacobian there.
pub(super) struct Middle {
    /// One entry per unknown, in the homotopy's unit.
    pub centre: Vec<f64>,
    /// Row by row.
    pub inverse: Vec<f64>,
}

impl Middle {
    /// A place that is known. `None`: the Jacobian is singular there.
    pub fn at(homotopy: &Homotopy, centre: Vec<f64>) -> Option<Self> {
        let m = homotopy.equations;
        let mut inverse = Vec::with_capacity(m * m);
        for e in 0..m {
            let slopes = homotopy.slopes(e, |i| point(centre[i]));
            inverse.extend(slopes.iter().map(|x| x.mid()));
        }
        let is_regular = invert(&mut inverse, m) && inverse.iter().all(|&x| in_range(x));
        is_regular.then_some(Middle { centre, inverse })
    }

    /// The zero with these right-hand sides that Newton's method comes to from here, in floats: no claim.
    fn zero(&self, homotopy: &Homotopy, rights: &[Interval]) -> Option<Vec<f64>> {
        const STEPS: usize = 30;
        let m = homotopy.equations;
        let mut renewed: Option<Middle> = None;
        let mut x = self.centre.clone();
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let missed: Vec<f64> = (0..m)
                .map(|e| rights[e].mid() - homotopy.left_side(e, |i| point(x[i])).mid())
                .collect();
            let inverse = renewed.as_ref().map_or(&self.inverse, |one| &one.inverse);
            let mut size = 0.0f64;
            for (row, x) in inverse.chunks(m.max(1)).zip(&mut x) {
                let step: f64 = row.iter().zip(&missed).map(|(y, f)| y * f).sum();
                *x += step;
                size = size.max(step.abs() / (1.0 + x.abs()));
            }
            // The greatest of numbers does not tell of one that is none.
            if !size.is_finite() || x.iter().any(|x| x.is_nan() || x.abs() > FAR) {
                return None;
            }
            if size <= 8.0 * f64::EPSILON || size <= 1e-12 && size >= before {
                break;
            }
            if size > 0.1 * before {
                renewed = Some(Self::at(homotopy, x.clone())?);
            }
            before = size;
        }
        Some(x)
    }

    /// A middle there.
    pub fn led(&self, homotopy: &Homotopy, rights: &[Interval]) -> Option<Self> {
        Self::at(homotopy, self.zero(homotopy, rights)?)
    }
}

impl Family {
    /// Proves that for every choice of right-hand sides in these ranges there is exactly one figure about a middle. `None`: that is not proved.
    pub fn prove(homotopy: &Homotopy, middle: Middle, rights: &[Interval]) -> Option<Self> {
        let Middle { centre, inverse } = &middle;
        let m = homotopy.equations;
        let mut differences: Vec<Difference> = (0..m).map(|i| [Some(i), None]).collect();
        let terms = (0..m)
            .map(|e| terms(homotopy, e, &mut differences))
            .collect();
        let at = |i: usize| point(centre[i]);
        let left: Vec<Interval> = (0..m).map(|e| homotopy.left_side(e, at)).collect();
        let grown = rights.iter().zip(&left).map(|(right, left)| *right - *left);
        let mut defect = vec![point(0.0); m * m];
        for e in 0..m {
            let slopes = homotopy.slopes(e, at).into_iter().enumerate();
            let slopes: Vec<_> = slopes.filter(|(_, x)| *x != point(0.0)).collect();
            for i in 0..m {
                let y = point(inverse[i * m + e]);
                if y != point(0.0) {
                    slopes.iter().for_each(|&(j, x)| defect[i * m + j] -= y * x);
                }
            }
        }
        (0..m).for_each(|i| defect[i * m + i] += point(1.0));
        let defect = defect.iter().map(|x| x.mag()).collect();
        let applied = differences.iter().flat_map(|ends| {
            let [a, b] = ends.map(|end| end.map(|i| &inverse[i * m..(i + 1) * m]));
            (0..m).map(move |e| {
                let [a, b] = [a, b].map(|row| row.map_or(0.0, |row| row[e]));
                a - b
            })
        });
        let applied: Vec<f64> = applied.collect();
        let size = |y: &f64| y.abs() * (1.0 + 4.0 * f64::EPSILON);
        let mut family = Family {
            middle,
            sizes: applied.iter().map(size).collect(),
            applied,
            terms,
            defect,
            grown: grown.collect(),
            left,
            only: Vec::new(),
            linear: Vec::new(),
            rest: Vec::new(),
            around: Vec::new(),
            weights: Vec::new(),
            contraction: 1.0,
            movers: OnceCell::new(),
            differences,
        };
        // While the norm is sought, figures may be wherever there may be one only.
        (family.is_mapped_into_itself() && family.contracts()).then_some(())?;
        family.around = sums(&family.linear, &family.rest);
        // Beyond, equations have zeros that are no figures.
        let at = |i: usize| point(family.middle.centre[i]) + family.around[i];
        homotopy.is_proper_over(at).then_some(family)
    }

    /// Looks for bounds of the rest that the equations' map keeps: of each choice's figures, which are those within them of a linear function of the
    /// choice, a convex set that is not empty, as 0 is among the bounds, the image lies in the set, and so a zero by Brouwer's theorem.
    fn is_mapped_into_itself(&mut self) -> bool {
        let wider = |x: &Interval, ends: &Difference| {
            let at = |end: &Option<usize>| end.map_or(0.0, |i| self.middle.centre[i].abs());
            let room = ROOM * (1.0 + ends.iter().map(at).fold(0.0, f64::max));
            hull(
                (1.1 * x.inf()).min(0.0) - room,
                (1.1 * x.sup()).max(0.0) + room,
            )
        };
        let Some(linear) = self.image(&self.grown, &[]) else {
            return false;
        };
        self.linear = linear;
        let mut image = vec![point(0.0); self.differences.len()];
        for _ in 0..ROUNDS {
            let all = image.iter().zip(&self.differences);
            self.only = all.map(|(x, ends)| wider(x, ends)).collect();
            self.around = sums(&self.linear, &self.only);
            let second = self.terms.iter().map(|terms| {
                -sum(terms.iter().map(|&(factor, a, b)| {
                    factor
                        * match a == b {
                            true => self.around[a].sqr(),
                            false => self.around[a] * self.around[b],
                        }
                }))
            });
            let second: Vec<Interval> = second.collect();
            let Some(next) = self.image(&second, &self.around) else {
                return false;
            };
            image = next;
            if image.iter().zip(&self.only).all(|(x, set)| x.subset(*set)) {
                self.rest = image;
                return true;
            }
        }
        false
    }

    /// Of Y f + (I − Y J) u each difference; the unknowns' u come first, and where there are none that part is left out. `None`: what comes of
    /// it is beyond [`FAR`].
    ///
    /// With ŷ the rounded entries of a row, off by less than 2 u |ŷ|, and f between f̂ ± r, the sum of the products differs from that of ŷ f̂ as
    /// computed by at most Σ |ŷ| (r + γ (|f̂| + r)), γ for as many products and four more (Higham, section 3.1).
    fn image(&self, f: &[Interval], u: &[Interval]) -> Option<Vec<Interval>> {
        let m = self.middle.centre.len();
        let gamma = gamma(m + 4);
        let middles: Vec<f64> = f.iter().map(|f| f.mid()).collect();
        let radii = f
            .iter()
            .map(|f| f.rad() + gamma * (f.mid().abs() + f.rad()));
        let sizes: Vec<f64> = u.iter().take(m).map(|u| u.mag()).collect();
        let bounds = self.bounds(&radii.collect::<Vec<_>>(), &sizes);
        let rows = self.applied.chunks(m.max(1)).zip(bounds);
        rows.map(|(row, bound)| {
            let middle = dot(row, &middles);
            let is_known = middle.abs() <= FAR && bound <= FAR;
            is_known.then(|| around(middle, bound))
        })
        .collect()
    }

    /// Bounds on |Y| f + |I − Y J| u for each difference, where no number is less than 0.
    fn bounds(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let m = self.middle.centre.len();
        let rows = self.defect.chunks(m.max(1));
        let from_middle: Vec<f64> = rows.map(|row| dot(row, u)).collect();
        let rows = self.differences.iter().zip(self.sizes.chunks(m.max(1)));
        rows.map(|(ends, row)| {
            let ends = ends.iter().flatten().map(|&i| from_middle[i]);
            // What is rounded: f, the size, a product and the sums.
            round_up(dot(row, f) + ends.sum::<f64>(), m + 10)
        })
        .collect()
    }

    /// Looks for a norm in which I − Y J is less than 1, J being the Jacobian in the middle between any two figures that are bounded alike: as F(ξ) −
    /// F(η) = J((ξ + η)/2) (ξ − η), there is one for each choice. It is sought as s = first + N s.
    fn contracts(&mut self) -> bool {
        /// Less than this is sought for a while.
        const ENOUGH: f64 = 0.5;
        /// Or until the next one is no less than this part of the one before.
        const SETTLED: f64 = 0.97;
        let sizes: Vec<f64> = self.around.iter().map(|x| x.mag()).collect();
        // What hardly moves is not weighed as if nothing about it could be wrong.
        let least = 1e-3 * sizes.iter().copied().fold(f64::EPSILON, f64::max);
        let first: Vec<f64> = sizes.iter().map(|size| size + least).collect();
        let mut weights = first.clone();
        for _ in 0..ROUNDS {
            let image = self.norm_of_image(&sizes, &weights);
            let norm = greatest_part(&image, &weights);
            let next = first.iter().zip(&image).map(|(a, b)| a + b).collect();
            let tried = std::mem::replace(&mut weights, next);
            let before = self.contraction;
            if norm < before {
                (self.weights, self.contraction) = (tried, norm);
            }
            // It does, and will not do much better.
            if before < 1.0 && norm > SETTLED * before {
                break;
            }
            let is_far = weights.iter().any(|s| s.is_nan() || *s > FAR);
            if norm < ENOUGH || norm.is_nan() || is_far {
                break;
            }
        }
        self.contraction < 1.0
    }

    /// Bounds of the differences of (I − Y J) v, where those of v are bounded, J the Jacobian at places whose differences, as seen from the middle,
    /// are no larger than `sizes`.
    fn norm_of_image(&self, sizes: &[f64], v: &[f64]) -> Vec<f64> {
        let turned = self.terms.iter().map(|terms| {
            let each = terms
                .iter()
                .map(|&(factor, a, b)| factor.mag() * (sizes[a] * v[b] + sizes[b] * v[a]));
            round_up(each.sum(), terms.len() + 5)
        });
        self.bounds(&turned.collect::<Vec<_>>(), &v[..self.middle.centre.len()])
    }

    /// How fast something changes with each right-hand side, over all figures, of which these are the derivatives by the unknowns.
    ///
    /// The differences' speeds with a right-hand side are v = Y e + (I − Y J) v. What changes at rates z with the differences does so at z v =
    /// z Y e + z (I − Y J) v, and z (I − Y J) are rates again. So it goes on, with each place between the middle and a figure in ranges, and what
    /// is left is bounded in the norm, where v is no more than Y e divided by 1 − `contraction`.
    pub fn speeds(&self, slopes: &[(usize, Interval)]) -> Vec<Interval> {
        /// Rates so small a part of those at first are bounded in the norm.
        const SMALL: f64 = 1e-9;
        let m = self.middle.centre.len();
        let mut speeds = vec![point(0.0); m];
        let mut rates = vec![point(0.0); self.differences.len()];
        slopes.iter().for_each(|&(i, slope)| rates[i] += slope);
        let size = |rates: &[Interval]| {
            let all = rates.iter().zip(&self.weights);
            round_up(all.map(|(z, s)| z.mag() * s).sum(), 2 * rates.len() + 5)
        };
        let first = size(&rates);
        let mut left = first;
        for _ in 0..TIMES {
            if !left.is_finite() || left <= SMALL * first {
                break;
            }
            let mut of_unknowns = vec![point(0.0); m];
            for (ends, &rate) in self.differences.iter().zip(&rates) {
                let [a, b] = *ends;
                a.into_iter().for_each(|i| of_unknowns[i] += rate);
                b.into_iter().for_each(|i| of_unknowns[i] -= rate);
            }
            let mut weights = vec![point(0.0); m];
            let mut from_middle = vec![0.0; m];
            let rows = self.middle.inverse.chunks(m.max(1));
            for ((row, defect), &rate) in rows.zip(self.defect.chunks(m.max(1))).zip(&of_unknowns) {
                if rate == point(0.0) {
                    continue;
                }
                let row = weights.iter_mut().zip(row).filter(|(_, y)| **y != 0.0);
                row.for_each(|(sum, &y)| *sum += rate * point(y));
                let row = from_middle.iter_mut().zip(defect);
                row.for_each(|(sum, x)| *sum += rate.mag() * x);
            }
            rates.fill(point(0.0));
            for (rate, &x) in rates.iter_mut().zip(&from_middle) {
                *rate = around(0.0, round_up(x, m + 5));
            }
            for (terms, &weight) in self.terms.iter().zip(&weights) {
                for &(factor, a, b) in terms {
                    rates[b] -= weight * factor * self.around[a];
                    rates[a] -= weight * factor * self.around[b];
                }
            }
            speeds
                .iter_mut()
                .zip(weights)
                .for_each(|(all, x)| *all += x);
            left = size(&rates);
        }
        let movers = self.movers.get_or_init(|| Rc::new(self.movers()));
        let rest = point(1.0) - point(self.contraction);
        for (e, speed) in speeds.iter_mut().enumerate() {
            let moves = |i: usize| movers[i][e / 64] >> (e % 64) & 1 == 1;
            if !slopes.iter().any(|&(i, _)| moves(i)) {
                *speed = point(0.0);
                continue;
            }
            let column = self.sizes.iter().skip(e).step_by(m);
            let norm = greatest_part(column, &self.weights);
            *speed = match left.is_finite() {
                true => *speed + around(0.0, (point(left) * point(norm) / rest).sup()),
                false => Interval::ENTIRE,
            };
        }
        speeds
    }

    /// The same figures, or some of those of another family, whose right-hand sides move no more than they do there.
    pub fn part_of(self, other: &Family) -> Self {
        let movers = other.movers.get_or_init(|| Rc::new(other.movers()));
        Family {
            movers: OnceCell::from(movers.clone()),
            ..self
        }
    }

    /// For each difference which right-hand sides can change it, a bit for each: those from which Y and I − Y J lead to it.
    fn movers(&self) -> Vec<Vec<u64>> {
        let m = self.middle.centre.len();
        let words = m.div_ceil(64);
        let all_of = |row: &[f64], sets: &[Vec<u64>]| {
            let mut all = vec![0; words];
            let led = row.iter().zip(sets).filter(|(x, _)| **x != 0.0);
            led.for_each(|(_, set)| join(&mut all, set));
            all
        };
        let mut movers = vec![vec![0; words]; self.differences.len()];
        loop {
            let turned = self.terms.iter().enumerate().map(|(e, terms)| {
                let mut all = vec![0; words];
                all[e / 64] |= 1 << (e % 64);
                for &(_, a, b) in terms {
                    join(&mut all, &movers[a]);
                    join(&mut all, &movers[b]);
                }
                all
            });
            let turned: Vec<Vec<u64>> = turned.collect();
            let off = self.defect.chunks(m).map(|row| all_of(row, &movers));
            let off: Vec<Vec<u64>> = off.collect();
            let rows = self.differences.iter().zip(self.applied.chunks(m));
            let next = rows.zip(&movers).map(|((ends, row), now)| {
                let mut all = all_of(row, &turned);
                join(&mut all, now);
                ends.iter().flatten().for_each(|&i| join(&mut all, &off[i]));
                all
            });
            let next: Vec<Vec<u64>> = next.collect();
            // All that follows is in it.
            if next == movers {
                return movers;
            }
            movers = next;
        }
    }

    /// Where the unknowns are in the one figure with these right-hand sides.
    ///
    /// It is x + d with d = Y (r − left(x)) + (I − Y J) d where x is near, and J that of the middle between both.
    pub fn figure(&self, homotopy: &Homotopy, rights: &[Interval]) -> Option<Vec<Interval>> {
        let x = self.middle.zero(homotopy, rights)?;
        let at = |i: usize| point(x[i]);
        let place: Vec<Interval> = (0..x.len()).map(at).collect();
        self.has(&place, rights).then_some(())?;
        let missed = rights.iter().enumerate();
        let missed: Vec<Interval> = missed
            .map(|(e, right)| *right - homotopy.left_side(e, at))
            .collect();
        let sizes: Vec<f64> = self.image(&missed, &[])?.iter().map(|x| x.mag()).collect();
        let norm = point(greatest_part(&sizes, &self.weights));
        let norm = norm / (point(1.0) - point(self.contraction));
        let bounds = self.weights.iter().map(|&s| (norm * point(s)).sup());
        let mut bounds: Vec<f64> = bounds.collect();
        // Places between both, as seen from the middle of all.
        let all = self.differences.iter().zip(&self.around);
        let seen = |end: Option<usize>| {
            end.map_or(point(0.0), |i| place[i] - point(self.middle.centre[i]))
        };
        let between: Vec<f64> = all
            .map(|(&[a, b], around)| around.convex_hull(seen(a) - seen(b)).mag())
            .collect();
        for _ in 0..TIMES {
            let image = self.norm_of_image(&between, &bounds);
            let all = bounds.iter_mut().zip(image.iter().zip(&sizes));
            all.for_each(|(bound, (a, b))| *bound = bound.min((a + b).next_up()));
        }
        let all = x.iter().zip(&bounds);
        let all = all.map(|(&x, &bound)| around(x, bound));
        Some(all.collect())
    }

    /// Whether a figure, with these right-hand sides, is certainly the one of the family that has them.
    pub fn has(&self, at: &[Interval], rights: &[Interval]) -> bool {
        let grown = rights
            .iter()
            .zip(&self.left)
            .map(|(right, left)| *right - *left);
        let Some(linear) = self.image(&grown.collect::<Vec<_>>(), &[]) else {
            return false;
        };
        let seen =
            |end: Option<usize>| end.map_or(point(0.0), |i| at[i] - point(self.middle.centre[i]));
        let all = self.differences.iter().zip(&linear).zip(&self.only);
        let mut rests = all.map(|((&[a, b], linear), set)| (seen(a) - seen(b) - *linear, set));
        rests.all(|(rest, set)| rest.subset(*set))
    }

    /// How many products of numbers it takes to find such a family, about.
    pub fn work(&self) -> usize {
        3 * self.applied.len() * self.middle.centre.len()
    }

    /// Where an unknown is, over all figures.
    pub fn enclosure(&self, i: usize) -> Interval {
        point(self.middle.centre[i]) + self.around[i]
    }

    /// By how much something changes over all figures, as seen from the middle, of which these are the derivatives by the unknowns that it
    /// depends on, over all figures and all between them and the middle.
    pub fn change(&self, slopes: &[(usize, Interval)]) -> Interval {
        let m = self.middle.centre.len();
        // What is linear in the right-hand sides is taken together, as each of these stands for itself.
        let weight = |e: usize| {
            sum(slopes
                .iter()
                .map(|(i, slope)| point(slope.mid()) * point(self.middle.inverse[i * m + e])))
        };
        let linear = sum((0..m).map(|e| weight(e) * self.grown[e]));
        let rest = sum(slopes.iter().map(|&(i, slope)| {
            let middle = point(slope.mid());
            middle * self.rest[i] + (slope - middle) * self.around[i]
        }));
        linear + rest
    }

    /// Where an unknown is, over all figures and all between them and the middle.
    pub fn near(&self, i: usize) -> Interval {
        point(self.middle.centre[i]) + self.around[i].convex_hull(point(0.0))
    }
}

/// The terms of second order of an equation, with the differences in them among all.
fn terms(homotopy: &Homotopy, e: usize, differences: &mut Vec<Difference>) -> Vec<Term> {
    let mut number = |form: Form<Option<usize>>| match form {
        Form::One => None,
        Form::Difference(a, b) => {
            let known = match b {
                None => a,
                Some(_) => differences.iter().position(|&other| other == [a, b]),
            };
            Some(known.unwrap_or_else(|| {
                differences.push([a, b]);
                differences.len() - 1
            }))
        }
    };
    let products = homotopy.terms(e).into_iter();
    let of = |product: crate::equations::Product<Option<usize>>| {
        let half = point(0.5) * point(product.factor.into());
        Some((half, number(product.left)?, number(product.right)?))
    };
    products.filter_map(of).collect()
}

/// The greatest of what each is of a weight, rounded up.
fn greatest_part<'f>(all: impl IntoIterator<Item = &'f f64>, weights: &[f64]) -> f64 {
    let parts = all.into_iter().zip(weights);
    let parts = parts.map(|(&x, &weight)| (x / weight).next_up());
    parts.fold(0.0, |greatest, part| {
        if greatest.is_nan() || part <= greatest {
            greatest
        } else {
            part
        }
    })
}

/// Puts the bits of a set into another one.
fn join(all: &mut [u64], set: &[u64]) {
    all.iter_mut().zip(set).for_each(|(all, set)| *all |= set);
}

fn sums(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}

/// A sum.
pub(super) fn sum(terms: impl Iterator<Item = Interval>) -> Interval {
    terms.fold(point(0.0), |sum, x| sum + x)
}
