//! How a rigid body on six legs is turned, part by part.
//!
//! The body's points are moved by one rotation R and one translation, as it keeps its shape and its orientation; six of its points (some perhaps
//! the same) have given distances from points that are no points of the body. With βᵢ from the first leg's point to another's in the
//! body's own coordinates, αᵢ from where the first leg stands to where the other does, and p from there to the first leg's point,
//! |p + R βᵢ − αᵢ|² = lᵢ² and |p|² = l₀². With R = Q/N for a quaternion q, N = |q|², the difference of both is linear in p:
//! (Q βᵢ − N αᵢ) · p = N kᵢ + αᵢ · Q βᵢ, where 2 kᵢ = lᵢ² − l₀² − |αᵢ|² − |βᵢ|².
//!
//! These are A p = b, five equations. Let p̃ be any polynomials, r = b − A p̃ and p = p̃ + δ, so that A δ = r. For any numbers Y with Y A = 1 + E
//! and ‖E‖ < 1, δ = Y r − E δ, so that |δ| ≤ max |Y r|/(1 − ‖E‖), and |δ_j| ≤ |(Y r)_j| + Σ |E_jk| |δ|. With any Z the equations
//! Z r − (Z A) δ = 0 are without p, and |p|² = l₀² is another. Where one coordinate of p is a symbol of its own, the two others are
//! eliminated in the same way.

use super::super::plan::{MAX_SYMBOLS, Model, contracted};
use super::format::Body as Line;
use super::space::Part;
use crate::certificate::checker::equations::{Equations, Product};
use crate::certificate::checker::guess::invert;
use crate::interval::rounding::largest;
use crate::interval::{Interval, UNIT, ZERO, checked, enclose, halves, hull, point};
use crate::problem::{Problem, Shape};

/// A body on legs.
pub struct Body {
    /// Its points, and where each is from the first leg's point, in its own coordinates.
    points: Vec<(usize, [Interval; 3])>,
    /// For each leg where its point is from the first one's in the body's coordinates, the entries of where it stands, and its length's square.
    legs: Vec<([Interval; 3], [usize; 3], Interval)>,
}

/// A box of rotations, and perhaps of one coordinate of p.
///
/// A rotation is that of a quaternion, of which one of the greatest components is 1, so that the others are from −1 to 1.
#[derive(Debug, Clone)]
pub struct Turn {
    /// The component that is 1.
    chart: usize,
    /// The ranges of the other components in order, then that of the coordinate.
    ranges: [Interval; 4],
    /// The axis of the coordinate.
    height: Option<usize>,
}

/// What the legs say of a box of rotations.
pub struct Look {
    symbols: usize,
    /// p, if the linear equations tell it.
    place: Option<[Model; 3]>,
    turned: [[Model; 3]; 3],
    square: Model,
    equations: Vec<Model>,
    /// About along which axis the linear equations tell least: a guess, for who chooses what is looked at.
    pub untold: usize,
}

/// The components of a quaternion that have ranges: all but the one that is 1.
const COMPONENTS: usize = 3;

impl Body {
    /// The body of a line: all that it says is compared with the problem.
    pub fn new(problem: &Problem, eq: &Equations, line: &Line) -> Result<Body, String> {
        let Some(Shape::Body {
            points,
            local,
            place: None,
        }) = problem.objects.get(line.object).map(|object| &object.shape)
        else {
            return Err("what is called a body is none".to_owned());
        };
        let unfit = || "a body has not six legs as they are listed".to_owned();
        let mut sorted = line.legs.clone();
        sorted.sort_unstable();
        sorted.dedup();
        if problem.dimension != 3 || line.legs.len() != 6 || sorted.len() != 6 {
            return Err(unfit());
        }
        let coordinate = |p: usize, axis: usize| eq.homotopy.coordinate(p, axis);
        // Three squares of differences of a point's coordinates and other entries, those of where the leg stands: their sum is the square of its
        // length, whatever entries these are.
        let stands = |products: &[Product], p: usize| -> Option<[usize; 3]> {
            let other = |axis: usize| match products[axis] {
                (1, [left, right]) if left == right => {
                    let [i, j] = eq.forms[left];
                    let ends = [(i, j), (j, i)].into_iter();
                    let mut other = ends.filter(|(own, _)| coordinate(p, axis) == Some(*own));
                    other.next().map(|(_, other)| other)
                }
                _ => None,
            };
            Some([other(0)?, other(1)?, other(2)?])
        };
        let mut ends = Vec::new();
        for &e in &line.legs {
            let products = eq.products.get(e).filter(|all| all.len() == 3);
            let products = products.ok_or_else(unfit)?;
            let mut found = points.iter().enumerate();
            let found = found.find_map(|(k, &p)| Some((k, stands(products, p)?)));
            let (own, other) = found.ok_or_else(unfit)?;
            // ½ |a − b|² = E(1).
            let square = point(2.0) * eq.right_at(e, point(1.0))[0];
            ends.push((own, other, square));
        }
        let per_unit = point(1.0 / eq.homotopy.unit);
        let first = ends[0].0;
        let from = |k: usize| -> [Interval; 3] {
            let at = |k: usize, axis: usize| enclose(&local[k][axis]);
            std::array::from_fn(|axis| match k == first {
                true => ZERO,
                false => (at(k, axis) - at(first, axis)) * per_unit,
            })
        };
        let points = points.iter().enumerate();
        let legs = ends.into_iter();
        Ok(Body {
            points: points.map(|(k, &p)| (p, from(k))).collect(),
            legs: legs.map(|(k, at, square)| (from(k), at, square)).collect(),
        })
    }

    /// Where a leg stands in a part of the space, if all its coordinates are bounded.
    fn at(part: &Part, entries: [usize; 3]) -> Option<[Interval; 3]> {
        let at = entries.map(|entry| part.entries()[entry]);
        at.iter().all(|x| x.is_common_interval()).then_some(at)
    }

    /// Whether it is known about where the legs stand.
    pub fn stands(&self, part: &Part) -> bool {
        let mut legs = self.legs.iter();
        legs.all(|leg| Self::at(part, leg.1).is_some())
    }

    /// What the legs say of a box of rotations, for all figures in a part in which it is known where the legs stand
    /// ([`Body::stands`]). `None`: there is no figure with such a rotation.
    pub fn look(&self, part: &Part, turn: &Turn) -> Option<Look> {
        let symbols = COMPONENTS + usize::from(turn.height.is_some());
        let number = |x: Interval| Model::constant(symbols, x);
        let (turned, square) = turn.matrix(symbols);
        let foot = Self::at(part, self.legs[0].1)?;
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for (holds, p, length) in &self.legs[1..] {
            let stands = Self::at(part, *p)?;
            let stands: [Interval; 3] = std::array::from_fn(|k| stands[k] - foot[k]);
            let held: [Model; 3] = std::array::from_fn(|k| {
                (0..3).fold(number(ZERO), |sum, j| sum.plus(holds[j], &turned[k][j]))
            });
            let sizes = holds
                .iter()
                .chain(&stands)
                .fold(ZERO, |sum, x| sum + x.sqr());
            let constant = (*length - self.legs[0].2 - sizes) * point(0.5);
            let right = square.by(constant);
            b.push((0..3).fold(right, |sum, k| sum.plus(stands[k], &held[k])));
            let row: [Model; 3] = std::array::from_fn(|k| held[k].plus(-stands[k], &square));
            a.push(row);
        }
        // |b| ≤ |A| l₀, row by row.
        let reach = self.legs[0].2.sqrt();
        for (row, b) in a.iter().zip(&b) {
            let size = row.iter().fold(ZERO, |sum, x| sum + size(x).sqr());
            let most = (size.sqrt() * reach).sup();
            if most.is_finite() && b.range().disjoint(hull(-most, most)) {
                return None;
            }
        }
        let axes: Vec<usize> = match turn.height {
            Some(axis) => vec![(axis + 1) % 3, (axis + 2) % 3],
            None => vec![0, 1, 2],
        };
        if let Some(axis) = turn.height {
            let height = turn.symbol(symbols, COMPONENTS);
            for (b, row) in b.iter_mut().zip(&a) {
                *b = b.plus(point(-1.0), &row[axis].times(&height));
            }
        }
        let mut look = Look {
            symbols,
            place: None,
            turned,
            square,
            equations: Vec::new(),
            untold: untold(&a),
        };
        let told: Vec<Vec<Model>> = a
            .iter()
            .map(|row| axes.iter().map(|&k| row[k]).collect())
            .collect();
        if let Some((near, equations)) = eliminated(symbols, &told, &b) {
            let mut place = [number(ZERO); 3];
            for (&axis, near) in axes.iter().zip(near) {
                place[axis] = near;
            }
            if let Some(axis) = turn.height {
                place[axis] = turn.symbol(symbols, COMPONENTS);
            }
            let start = number(-self.legs[0].2);
            let sum = place
                .iter()
                .fold(start, |sum, x| sum.plus(point(1.0), &x.times(x)));
            look.equations = equations;
            look.equations.push(sum);
            look.place = Some(place);
        }
        Some(look)
    }

    /// The part where the body's points are as a box of rotations allows. `None`: the place is not told.
    pub fn placed(
        &self,
        eq: &Equations,
        part: &Part,
        look: &Look,
    ) -> Option<Result<Part, super::Empty>> {
        let place = look.place.as_ref()?;
        let over = look.square.reciprocal()?;
        let foot = Self::at(part, self.legs[0].1)?;
        let mut out = part.clone();
        for (p, from) in &self.points {
            for axis in 0..3 {
                let Some(u) = eq.homotopy.coordinate(*p, axis) else {
                    continue;
                };
                let zero = Model::constant(look.symbols, foot[axis]);
                let turned = (0..3).fold(zero.by(ZERO), |sum, k| {
                    sum.plus(from[k], &look.turned[axis][k])
                });
                let at = zero
                    .plus(point(1.0), &place[axis])
                    .plus(point(1.0), &turned.times(&over));
                if out.narrow(u, at.range()).is_err() {
                    return Some(Err(super::Empty));
                }
            }
        }
        Some(Ok(out))
    }

    /// The greatest size of a coordinate of p.
    pub fn reach(&self) -> Interval {
        let most = self.legs[0].2.sqrt().sup();
        hull(-most, most)
    }
}

impl Look {
    /// Whether the linear equations tell where the body is.
    pub fn is_told(&self) -> bool {
        self.place.is_some()
    }

    /// What the equations leave of the symbols' ranges; `None`: nothing.
    pub fn contracted(&self) -> Option<[Interval; MAX_SYMBOLS]> {
        contracted(self.symbols, &self.equations)
    }
}

impl Turn {
    /// All rotations.
    pub fn all() -> [Turn; 4] {
        [0, 1, 2, 3].map(|chart| Turn {
            chart,
            ranges: [UNIT, UNIT, UNIT, ZERO],
            height: None,
        })
    }

    /// The ranges of the components, and of the coordinate if there is one.
    pub fn ranges(&self) -> &[Interval] {
        &self.ranges[..COMPONENTS + usize::from(self.height.is_some())]
    }

    /// Both halves of a range, which share a border, the lower one first.
    pub fn halved(&self, i: usize) -> Option<[Turn; 2]> {
        let with = |range| {
            let mut half = self.clone();
            half.ranges[i] = range;
            half
        };
        Some(halves(*self.ranges().get(i)?)?.map(with))
    }

    /// The same with the coordinate along an axis, in a range that holds all that it may be.
    pub fn with_height(&self, axis: usize, range: Interval) -> Option<Turn> {
        let is_new = self.height.is_none() && axis < 3 && range.is_common_interval();
        is_new.then(|| {
            let mut out = self.clone();
            (out.height, out.ranges[COMPONENTS]) = (Some(axis), range);
            out
        })
    }

    /// The box that is left where the symbols are in parts of their ranges; `None` if that is nothing, or all of it.
    pub fn within(&self, u: &[Interval]) -> Option<Turn> {
        let mut out = self.clone();
        for i in 0..self.ranges().len() {
            let (middle, radius) = self.middle(i);
            let range = self.ranges[i].intersection(point(middle) + point(radius) * u[i]);
            out.ranges[i] = (!range.is_empty()).then_some(range)?;
        }
        (out.ranges() != self.ranges()).then_some(out)
    }

    /// The middle of a range, and how far it goes from there at most.
    fn middle(&self, i: usize) -> (f64, f64) {
        let x = self.ranges[i];
        let middle = x.mid();
        (middle, (x - point(middle)).mag())
    }

    fn symbol(&self, symbols: usize, i: usize) -> Model {
        let (middle, radius) = self.middle(i);
        Model::symbol(symbols, i, middle, radius)
    }

    /// Q and N (Rodrigues).
    fn matrix(&self, symbols: usize) -> ([[Model; 3]; 3], Model) {
        let mut next = 0;
        let q: [Model; 4] = std::array::from_fn(|i| {
            if i == self.chart {
                return Model::constant(symbols, point(1.0));
            }
            next += 1;
            self.symbol(symbols, next - 1)
        });
        let (plus, minus) = (point(1.0), point(-1.0));
        let square = |i: usize| q[i].times(&q[i]);
        let diagonal = |k: usize| {
            let others = 1..4;
            others.fold(square(0), |sum, i| {
                sum.plus(if i == k { plus } else { minus }, &square(i))
            })
        };
        // 2 (q_i q_j ± q_0 q_k).
        let side = |i: usize, j: usize, sign: Interval, k: usize| {
            let both = q[i].times(&q[j]).plus(sign, &q[0].times(&q[k]));
            both.by(point(2.0))
        };
        let matrix = [
            [diagonal(1), side(1, 2, minus, 3), side(1, 3, plus, 2)],
            [side(1, 2, plus, 3), diagonal(2), side(2, 3, minus, 1)],
            [side(1, 3, minus, 2), side(2, 3, plus, 1), diagonal(3)],
        ];
        let sum = (1..4).fold(square(0), |sum, i| sum.plus(plus, &square(i)));
        (matrix, sum)
    }
}

/// A bound of a function's size, which may be infinite.
fn size(f: &Model) -> Interval {
    let size = f.distance(0.0);
    checked(size, size).unwrap_or(Interval::ENTIRE)
}

/// A x = b solved for x, and the equations that are left. `None`: the matrix does not tell x.
fn eliminated(symbols: usize, a: &[Vec<Model>], b: &[Model]) -> Option<(Vec<Model>, Vec<Model>)> {
    let (rows, count) = (a.len(), a[0].len());
    let zero = Model::constant(symbols, ZERO);
    let one = |is: bool| point(if is { 1.0 } else { 0.0 });
    let middle = |i: usize, k: usize| a[i][k].at_middle();
    // Y = (AᵀA)⁻¹Aᵀ and Z = 1 − A Y in the middle: floats, which may be any.
    let gram = |j: usize, k: usize| (0..rows).map(|i| middle(i, j) * middle(i, k)).sum::<f64>();
    let columns: Vec<Vec<(usize, f64)>> = (0..count)
        .map(|k| (0..count).map(|j| (j, gram(j, k))).collect())
        .collect();
    let inverse = invert(&columns)?;
    let y = |j: usize, i: usize| -> f64 {
        let terms = (0..count).map(|k| inverse.entries[k * count + j] * middle(i, k));
        terms.sum()
    };
    let y: Vec<Vec<f64>> = (0..count)
        .map(|j| (0..rows).map(|i| y(j, i)).collect())
        .collect();
    if !y.iter().flatten().all(|y| y.is_finite()) {
        return None;
    }
    let z = |l: usize, i: usize| -> f64 {
        let own = if l == i { 1.0 } else { 0.0 };
        own - (0..count).map(|k| middle(l, k) * y[k][i]).sum::<f64>()
    };
    let z: Vec<Vec<f64>> = (0..rows)
        .map(|l| (0..rows).map(|i| z(l, i)).collect())
        .collect();
    if !z.iter().flatten().all(|z| z.is_finite()) {
        return None;
    }
    let combined = |row: &[f64], f: &dyn Fn(usize) -> Model| {
        (0..rows).fold(zero, |sum, i| sum.plus(point(row[i]), &f(i)))
    };
    // E.
    let off: Vec<Vec<Model>> = (0..count)
        .map(|j| {
            let entry = |k: usize| {
                let identity = Model::constant(symbols, one(j == k));
                combined(&y[j], &|i| a[i][k]).plus(point(-1.0), &identity)
            };
            (0..count).map(entry).collect()
        })
        .collect();
    let norms = off
        .iter()
        .map(|row| row.iter().fold(ZERO, |sum, e| sum + size(e)).sup());
    let norm = norms.fold(0.0, largest);
    if !(norm < 0.7) {
        return None;
    }
    // p̃.
    let start: Vec<Model> = y
        .iter()
        .map(|row| combined(row, &|i| b[i]).polynomial())
        .collect();
    let mut near = start.clone();
    for _ in 0..2 {
        let next = |j: usize| {
            let moved = (0..count).fold(start[j], |sum, k| {
                sum.plus(point(-1.0), &off[j][k].times(&near[k]))
            });
            moved.polynomial()
        };
        near = (0..count).map(next).collect();
    }
    let rest: Vec<Model> = (0..rows)
        .map(|i| {
            (0..count).fold(b[i], |rest, k| {
                rest.plus(point(-1.0), &a[i][k].times(&near[k]))
            })
        })
        .collect();
    // δ.
    let moved: Vec<Interval> = y
        .iter()
        .map(|row| size(&combined(row, &|i| rest[i])))
        .collect();
    let most = moved.iter().fold(0.0, |max, x| largest(max, x.sup()));
    if !most.is_finite() {
        return None;
    }
    let most = point(most) / (point(1.0) - point(norm));
    let delta: Vec<Interval> = (0..count)
        .map(|j| {
            let sum = off[j].iter().fold(moved[j], |sum, e| sum + size(e) * most);
            UNIT * sum
        })
        .collect();
    let left = |row: &Vec<f64>| {
        let start = combined(row, &|i| rest[i]);
        (0..count).fold(start, |left, k| {
            let by = size(&combined(row, &|i| a[i][k]));
            left.widened(by * delta[k])
        })
    };
    let equations = z.iter().map(left).collect();
    let near = near
        .iter()
        .zip(&delta)
        .map(|(near, &delta)| near.widened(delta));
    Some((near.collect(), equations))
}

/// The axis along which five linear equations tell least, about: that of the column that is least where the others are taken out.
fn untold(a: &[[Model; 3]]) -> usize {
    let dot = |j: usize, k: usize| -> f64 {
        let terms = a.iter().map(|row| row[j].at_middle() * row[k].at_middle());
        terms.sum()
    };
    // The squares of the columns' heights over the plane of the others are the reciprocals of the diagonal of the inverse of AᵀA: its
    // minors over its determinant.
    let minor = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        dot(i, i) * dot(j, j) - dot(i, j) * dot(i, j)
    };
    let mut best = 0;
    for k in 1..3 {
        if minor(k) > minor(best) {
            best = k;
        }
    }
    best
}
