//! How a rigid body on six legs is turned, part by part.
//!
//! The body's points are moved by one rotation and one translation, as it keeps its shape and its orientation; six of its points (some perhaps
//! the same) have given distances from points that are no points of the body: what these say of rotations is in [`super::legs`].

use super::format::Body as Line;
use super::legs::{Leg, Legs, Look, Model};
use super::space::Part;
use crate::certificate::checker::equations::{Equations, Product};
use crate::interval::{Interval, UNIT, ZERO, enclose, halves, hull, point};
use crate::model::{Number, Range};
use crate::places::Each as _;
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
    pub chart: usize,
    /// The ranges of the other components in order, then that of the coordinate.
    ranges: [Interval; 4],
    /// The axis of the coordinate.
    pub height: Option<usize>,
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

    /// Where a leg stands in a part of the space.
    fn at(part: &Part, entries: [usize; 3]) -> [Interval; 3] {
        entries.each(|entry| part.entries()[entry])
    }

    /// Whether it is known about where the legs stand.
    pub fn stands(&self, part: &Part) -> bool {
        let mut all = self.legs.iter().flat_map(|leg| Self::at(part, leg.1));
        all.all(|x| x.is_common_interval())
    }

    /// What the legs say of a box of rotations, for all figures in a part in which it is known where the legs stand
    /// ([`Body::stands`]). `None`: there is no figure with such a rotation.
    pub fn look(&self, part: &Part, turn: &Turn) -> Option<Look> {
        let (_, entries, first) = self.legs[0];
        let foot = Self::at(part, entries);
        let leg = |(holds, entries, square): &([Interval; 3], [usize; 3], Interval)| {
            let stands = Self::at(part, *entries);
            let stands = [0, 1, 2].each(|k| stands[k] - foot[k]);
            Leg::new(*holds, stands, *square, first)
        };
        let legs = Legs::new(self.legs[1..].iter().map(leg), first);
        legs.expect("a body has six legs").look(turn)
    }

    /// The part where the body's points are as a box of rotations allows. `None`: the place is not told.
    pub fn placed(
        &self,
        eq: &Equations,
        part: &Part,
        look: &Look,
    ) -> Option<Result<Part, super::Empty>> {
        if !look.is_told() {
            return None;
        }
        let range = look.ranges(Self::at(part, self.legs[0].1));
        let mut out = part.clone();
        for (p, from) in &self.points {
            let from = from.each(Number::new);
            for axis in 0..3 {
                let Some(u) = eq.homotopy.coordinate(*p, axis) else {
                    continue;
                };
                if out.narrow(u, range(&from, axis)).is_err() {
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
    pub fn within(&self, u: &[Range]) -> Option<Turn> {
        let mut out = self.clone();
        for i in 0..self.ranges().len() {
            let (middle, radius) = self.middle(i);
            let range =
                self.ranges[i].intersection(point(middle) + point(radius) * u[i].interval());
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

    /// A component of the quaternion, counted without the one that is 1, or the coordinate (3), by its symbol.
    pub fn symbol(&self, i: usize) -> Model {
        let (middle, radius) = self.middle(i);
        Model::symbol(i, middle, radius)
    }
}
