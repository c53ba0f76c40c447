//! What legs say of the poses of a body, over a box of rotations. Searches and checks look at the same.
//!
//! The body's point of leg i is at p + R βᵢ, with βᵢ from the first leg's point in the body's own coordinates, and p from where
//! the first leg stands to its point; the leg stands at αᵢ from there. With R = Q/N, N = |q|² and Q quadratic in q (Rodrigues), the first
//! leg says |p|² = l₀², and the difference of another's equation from it is linear in p:
//!
//! > (Q βᵢ − N αᵢ) · p = N kᵢ + αᵢ · Q βᵢ, with 2 kᵢ = lᵢ² − l₀² − |αᵢ|² − |βᵢ|².
//!
//! These are A p = b, five equations for three numbers. With floats Y and Z that make Y A nearly 1 and Z A nearly 0 in the
//! middle of the box, p is nearly a polynomial p̃ of the second order in the symbols, and exactly p̃ + δ with A δ = b − A p̃ =: r. With Y A = 1 + E that is
//! δ = Y r − E δ, so that |δ| ≤ max |Y r|/(1 − ‖E‖) where ‖E‖ < 1, and more sharply |δ_j| ≤ |(Y r)_j| + Σ |E_jk| |δ|. What is left
//! are equations without p: Z r − Z A δ = 0, and |p̃ + δ|² = l₀². Y, Z and p̃ may be any; how good they are decides what is seen.
//!
//! Where one coordinate of p is not told by the linear equations (a flat platform parallel to its flat base), it is a symbol of its own,
//! the two others are eliminated, and there is one more equation.

use super::turns::Turn;
use crate::interval::rounding::{UNDERFLOW, largest, round_up};
use crate::interval::{Interval, point};
use crate::linalg::weakest;
use crate::model::{self, Margin, Number, Range, contract, weighted};
use crate::places::{Each as _, array};

/// A leg beside the first one.
#[derive(Debug, Clone)]
pub struct Leg {
    /// α: where it stands, from where the first one does.
    stands: [Number; 3],
    /// β: its point, from the first one's, in the body's coordinates.
    holds: [Number; 3],
    /// k.
    constant: Number,
}

/// A body's legs.
#[derive(Debug)]
pub struct Legs {
    legs: [Leg; OTHERS],
    /// l₀².
    square: Number,
    /// At least l₀.
    pub reach: f64,
}

/// The most symbols: three of a rotation, and a coordinate of the place.
pub const SYMBOLS: usize = 4;
/// A function of them.
pub(super) type Model = model::Model<SYMBOLS, 15>;

/// Legs beside the first one.
const OTHERS: usize = 5;

/// What legs say of the poses with a rotation in a box.
pub struct Look {
    symbols: usize,
    /// Equations that hold for all of them: as many as symbols, or none where linear equations do not tell the place.
    equations: Vec<Model>,
    /// p, if there are equations.
    place: [Model; 3],
    /// Q.
    turned: [[Model; 3]; 3],
    /// N.
    square: Model,
    /// How much each symbol moves what matters.
    pub moves: [f64; SYMBOLS],
    /// Where there are no equations: the axis along which the linear equations tell the place least.
    pub untold: Option<usize>,
}

impl Look {
    /// Whether the linear equations tell where the body is.
    pub fn is_told(&self) -> bool {
        !self.equations.is_empty()
    }

    /// What the equations leave of the symbols' ranges, of −1 to 1 each; `None`: nothing.
    pub fn left(&self, margin: Margin) -> Option<Vec<Range>> {
        let mut left = [Range::SYMBOL; SYMBOLS];
        let result = contract(&self.equations, &mut Vec::new(), &mut left, margin);
        result.ok()?;
        Some(left[..self.symbols].to_vec())
    }

    /// Where points of the body may be along an axis, if the linear equations tell that: `foot` is where the first leg stands, and a
    /// point is told by where it is from that leg's point in the body's own coordinates.
    pub fn ranges(&self, foot: [Interval; 3]) -> impl Fn(&[Number; 3], usize) -> Interval {
        let over = self.square.reciprocal(self.square.range());
        let turned = self.turned.each_ref();
        let turned = turned.each(|row| row.each_ref().each(|entry| entry.times(&over)));
        let place = [0, 1, 2].each(|axis| self.place[axis].shifted(Number::new(foot[axis])));
        move |from, axis| {
            let terms = [0, 1, 2].each(|k| (from[k], &turned[axis][k]));
            weighted(&place[axis], terms).range().interval()
        }
    }
}

impl Leg {
    /// `holds`, `stands`: β and α; `square` and `first`: the squares of its length and the first one's.
    pub fn new(
        holds: [Interval; 3],
        stands: [Interval; 3],
        square: Interval,
        first: Interval,
    ) -> Self {
        let both = holds.iter().chain(&stands);
        let sizes = both.fold(point(0.0), |sum, x| sum + x.sqr());
        Leg {
            stands: stands.each(Number::new),
            holds: holds.each(Number::new),
            constant: Number::new((square - first - sizes) * point(0.5)),
        }
    }
}

impl Legs {
    /// From the legs beside the first one. `None`: they are not five.
    pub fn new(legs: impl Iterator<Item = Leg>, first_square: Interval) -> Option<Self> {
        let legs: Vec<Leg> = legs.collect();
        Some(Legs {
            legs: legs.try_into().ok()?,
            square: Number::new(first_square),
            reach: first_square.sqrt().sup(),
        })
    }

    /// What the legs say over a box of rotations. `None`: there is no pose with one of them.
    pub fn look(&self, turn: &Turn) -> Option<Look> {
        match turn.height {
            None => self.look_at::<3>(turn),
            Some(_) => self.look_at::<2>(turn),
        }
    }

    /// The same, where K numbers of the place are eliminated: all three, or two and the box's coordinate is the last symbol.
    fn look_at<const K: usize>(&self, turn: &Turn) -> Option<Look> {
        let (turned, square) = turned(turn);
        let mut a: [[Model; 3]; OTHERS] = [[Model::ZERO; 3]; OTHERS];
        let mut b: [Model; OTHERS] = [Model::ZERO; OTHERS];
        for (i, leg) in self.legs.iter().enumerate() {
            let [x, y, z] = leg.holds;
            let held = turned
                .each_ref()
                .each(|row| weighted(&Model::ZERO, [(x, &row[0]), (y, &row[1]), (z, &row[2])]));
            for k in 0..3 {
                a[i][k] = weighted(&held[k], [(leg.stands[k].negative(), &square)]);
            }
            let [u, v, w] = leg.stands;
            b[i] = weighted(
                &Model::ZERO,
                [
                    (leg.constant, &square),
                    (u, &held[0]),
                    (v, &held[1]),
                    (w, &held[2]),
                ],
            );
            // No place at a distance of l₀ is enough.
            let most: f64 = a[i].iter().map(|x| x.size().powi(2)).sum();
            let most = round_up(round_up(most, 6).sqrt() * self.reach, 4);
            let Range { lo, hi } = b[i].range();
            if lo > most || hi < -most {
                return None;
            }
        }
        let mut look = Look {
            symbols: turn.ranges().len(),
            equations: Vec::new(),
            place: [Model::ZERO; 3],
            turned,
            square,
            moves: [0.0; SYMBOLS],
            untold: None,
        };
        // The axes that are eliminated, and b without what the other one says.
        let axes: [usize; K] = match turn.height {
            Some(axis) => array(|k| (axis + 1 + k) % 3),
            None => array(|k| k),
        };
        let height = turn.height.map(|_| turn.symbol(3));
        if let Some(height) = &height {
            let axis = turn.height.unwrap_or_default();
            for (b, row) in b.iter_mut().zip(&a) {
                *b = b.minus(&row[axis].times(height));
            }
        }
        // The columns that are eliminated.
        let told: [[Model; K]; OTHERS] = a.each_ref().each(|row| axes.each(|axis| row[axis]));
        let middle: [[f64; K]; OTHERS] = told
            .each_ref()
            .each(|row| row.each_ref().each(|x| x.middle()));
        let Some(bases) = Bases::<K>::of(&middle) else {
            self.wide::<K>(&mut look, &a, None);
            return Some(look);
        };
        // E, and Z A.
        let mut off: [[Model; K]; K] = [[Model::ZERO; K]; K];
        for (j, row) in off.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                let start = Number::exact(if j == k { -1.0 } else { 0.0 });
                let column = told.each_ref().each(|row| &row[k]);
                *entry = combination(Model::constant(start), &bases.inverse[j], column);
            }
        }
        let sizes = off.each_ref().each(|row| row.each_ref().each(Model::size));
        let norm = sizes.iter().fold(0.0, |max: f64, row| {
            largest(max, round_up(row.iter().sum(), K + 2))
        });
        if !(norm < LIMIT) {
            self.wide::<K>(&mut look, &a, Some(&off));
            return Some(look);
        }
        let height = turn.height.zip(height.as_ref());
        self.narrow(
            &mut look,
            (&told, &b),
            &bases,
            (&off, &sizes, norm),
            (axes, height),
        );
        Some(look)
    }

    /// The equations that are left without the place.
    fn narrow<const K: usize>(
        &self,
        look: &mut Look,
        (a, b): (&[[Model; K]; OTHERS], &[Model; OTHERS]),
        bases: &Bases<K>,
        (off, sizes, norm): (&[[Model; K]; K], &[[f64; K]; K], f64),
        (axes, height): ([usize; K], Option<(usize, &Model)>),
    ) {
        // p̃: y − E (y − E y) with y = Y b, of which the polynomial alone is taken.
        let y: [Model; K] =
            array(|j| combination(Model::ZERO, &bases.inverse[j], b.each_ref()).without_rest());
        let mut near = y;
        for _ in 0..2 {
            let before = near;
            for j in 0..K {
                near[j] = y[j];
                for k in 0..K {
                    near[j] = near[j].minus(&off[j][k].times(&before[k]));
                }
                near[j] = near[j].without_rest();
            }
        }
        let rest: [Model; OTHERS] =
            array(|i| (0..K).fold(b[i], |rest, k| rest.minus(&a[i][k].times(&near[k]))));
        // δ.
        let size = |row: &[f64; OTHERS]| combination(Model::ZERO, row, rest.each_ref()).size();
        let moved: [f64; K] = array(|j| size(&bases.inverse[j]));
        let most = moved.iter().copied().fold(0.0, largest);
        let most = round_up(most / (1.0 - norm), 6);
        let delta: [f64; K] = array(|j| {
            let sum: f64 = sizes[j].iter().map(|e| e * most).sum();
            round_up(moved[j] + sum, K + 4)
        });
        for row in &bases.kernel {
            let mut left = combination(Model::ZERO, row, rest.each_ref());
            for k in 0..K {
                let column = a.each_ref().each(|row| &row[k]);
                let size = combination(Model::ZERO, row, column).size();
                left = left.widened(round_up(size * delta[k], 2));
            }
            look.equations.push(left);
        }
        for (near, delta) in near.iter_mut().zip(delta) {
            *near = near.without_rest().widened(delta);
        }
        for (axis, near) in axes.into_iter().zip(near) {
            look.place[axis] = near;
        }
        if let Some((axis, height)) = height {
            look.place[axis] = *height;
        }
        let squares = look.place.each_ref().each(Model::squared);
        let sum = squares[0].plus(&squares[1]).plus(&squares[2]);
        look.equations.push(sum.shifted(self.square.negative()));
        // What is not linear in an equation, beside what is, and how the matrix changes.
        for equation in &look.equations {
            let linear = equation.linear().max(UNDERFLOW);
            quadratic(equation, |i, size| look.moves[i] += size / linear);
        }
        for entry in off.iter().flatten() {
            for i in 0..SYMBOLS {
                look.moves[i] += entry.slope(i).abs();
            }
        }
    }

    /// Where linear equations do not tell the place: what moves them, and which direction they tell least.
    fn wide<const K: usize>(
        &self,
        look: &mut Look,
        a: &[[Model; 3]; OTHERS],
        off: Option<&[[Model; K]; K]>,
    ) {
        match off {
            Some(off) => {
                for entry in off.iter().flatten() {
                    for i in 0..SYMBOLS {
                        look.moves[i] += entry.slope(i).abs();
                    }
                    quadratic(entry, |i, size| look.moves[i] += size);
                }
            }
            None => {
                for entry in a.iter().flatten() {
                    for i in 0..SYMBOLS {
                        look.moves[i] += entry.slope(i).abs();
                    }
                }
            }
        }
        let mut gram = nalgebra::Matrix3::<f64>::zeros();
        for row in a {
            for j in 0..3 {
                for k in 0..3 {
                    gram[(j, k)] += row[j].middle() * row[k].middle();
                }
            }
        }
        look.untold = Some(weakest(gram));
    }
}

/// Where ‖E‖ is more, the place is not eliminated.
const LIMIT: f64 = 0.7;

/// start + Σ row_i f_i.
fn combination(start: Model, row: &[f64; OTHERS], f: [&Model; OTHERS]) -> Model {
    let mut i = 0;
    let terms = f.each(|f| {
        i += 1;
        (Number::exact(row[i - 1]), f)
    });
    weighted(&start, terms)
}

/// Tells for each symbol how large its terms of the second order are, those of two symbols half to each.
fn quadratic(f: &Model, mut tell: impl FnMut(usize, f64)) {
    for i in 0..SYMBOLS {
        for j in i..SYMBOLS {
            let size = 0.5 * f.bend(i, j).abs();
            tell(i, size);
            tell(j, size);
        }
    }
}

/// Q and N over a box of rotations (Rodrigues).
fn turned(turn: &Turn) -> ([[Model; 3]; 3], Model) {
    let mut next = 0;
    let q: [Model; 4] = array(|i| {
        if i == turn.chart {
            return Model::constant(Number::exact(1.0));
        }
        next += 1;
        turn.symbol(next - 1)
    });
    let of = |i: usize, j: usize| q[i].times(&q[j]);
    let squares: [Model; 4] = array(|i| q[i].squared());
    let diagonal = |k: usize| {
        let sign = |i: usize| Number::exact(if i == k { 1.0 } else { -1.0 });
        let others = [1, 2, 3].each(|i| (sign(i), &squares[i]));
        weighted(&squares[0], others)
    };
    // 2 (q_i q_j ± q_0 q_k).
    let side = |i: usize, j: usize, sign: f64, k: usize| {
        let (ij, zero_k) = (of(i, j), of(0, k));
        weighted(
            &Model::ZERO,
            [
                (Number::exact(2.0), &ij),
                (Number::exact(2.0 * sign), &zero_k),
            ],
        )
    };
    let matrix = [
        [diagonal(1), side(1, 2, -1.0, 3), side(1, 3, 1.0, 2)],
        [side(1, 2, 1.0, 3), diagonal(2), side(2, 3, -1.0, 1)],
        [side(1, 3, -1.0, 2), side(2, 3, 1.0, 1), diagonal(3)],
    ];
    let one = Number::exact(1.0);
    let others = [1, 2, 3].each(|i| (one, &squares[i]));
    (matrix, weighted(&squares[0], others))
}

/// Y and Z for K columns of a matrix of floats.
struct Bases<const K: usize> {
    /// Times the matrix nearly 1.
    inverse: [[f64; OTHERS]; K],
    /// Times the matrix nearly 0; rows nearly at right angles, of length 1.
    kernel: Vec<[f64; OTHERS]>,
}

impl<const K: usize> Bases<K> {
    /// By Gram and Schmidt, in floats. `None`: the columns depend on each other, nearly.
    fn of(matrix: &[[f64; K]; OTHERS]) -> Option<Self> {
        let dot = |a: &[f64; OTHERS], b: &[f64; OTHERS]| -> f64 {
            (0..OTHERS).map(|i| a[i] * b[i]).sum()
        };
        let mut q: Vec<[f64; OTHERS]> = Vec::new();
        let mut r = [[0.0; K]; K];
        for k in 0..K {
            let mut column: [f64; OTHERS] = array(|i| matrix[i][k]);
            let size = dot(&column, &column).sqrt();
            // Twice is enough.
            for _ in 0..2 {
                for (j, q) in q.iter().enumerate() {
                    let part = dot(q, &column);
                    r[j][k] += part;
                    (0..OTHERS).for_each(|i| column[i] -= part * q[i]);
                }
            }
            let left = dot(&column, &column).sqrt();
            if !(left > 1e-9 * size) {
                return None;
            }
            r[k][k] = left;
            q.push(column.each(|x| x / left));
        }
        // R⁻¹ Qᵀ, from the last row up.
        let mut inverse = [[0.0; OTHERS]; K];
        for k in (0..K).rev() {
            for i in 0..OTHERS {
                let behind: f64 = (k + 1..K).map(|j| r[k][j] * inverse[j][i]).sum();
                inverse[k][i] = (q[k][i] - behind) / r[k][k];
            }
        }
        while q.len() < OTHERS {
            // Of the unit vectors the one that has most that is new.
            let left = |i: usize| 1.0 - q.iter().map(|q| q[i] * q[i]).sum::<f64>();
            let best = (0..OTHERS).max_by(|&i, &j| left(i).total_cmp(&left(j)))?;
            let mut new = [0.0; OTHERS];
            new[best] = 1.0;
            for _ in 0..2 {
                for q in &q {
                    let part = dot(q, &new);
                    (0..OTHERS).for_each(|i| new[i] -= part * q[i]);
                }
            }
            let size = dot(&new, &new).sqrt();
            q.push(new.each(|x| x / size));
        }
        let is_finite = |rows: &[[f64; OTHERS]]| rows.iter().flatten().all(|x| x.is_finite());
        (is_finite(&inverse) && is_finite(&q)).then(|| Bases {
            inverse,
            kernel: q[K..].to_vec(),
        })
    }
}
