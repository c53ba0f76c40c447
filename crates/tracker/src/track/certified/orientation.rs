//! Which signs of triangles and tetrahedra a path keeps, by proof.
//!
//! A sign is that of the determinant of the differences of the points from the first one: twice a signed
//! area in the plane, six times a signed volume in space. Likewise which lines and arcs do not vanish.

use super::link::{Frame, Tube};
use super::piece::{Along, Piece};
use crate::constraint::{Form, Nonzero};
use crate::linalg::Vector;
use crate::order::each_once;
use crate::places::{Each as _, array};
use crate::system::{Extent, Homotopy, Segment, determinant, simplices};
use crate::track::arc::{Figure, Kept, Orientation};

/// A tube is cut into at most 2 to this power pieces to tell a sign.
const DEPTH: usize = 10;
/// And into so many to tell where a line or an arc vanishes, which ends an edit.
const DEEP: usize = 40;

/// Signs and what becomes of them.
#[derive(Debug)]
pub struct Orientations {
    all: Vec<Simplex>,
    /// Those whose sign is known so far.
    known: Vec<u32>,
    /// Lines and arcs likewise, counted after the others.
    unbroken: Vec<u32>,
    /// Where the points of a piece of path are.
    piece: Piece,
}

/// A triangle in the plane, a tetrahedron in space; or a line or arc.
#[derive(Debug)]
struct Simplex {
    /// The line or arc, or the two edges.
    segment: Option<Segment>,
    /// The entries of its points' coordinates, point by point, and of radii behind these.
    entries: [[u32; 3]; 6],
    what: Orientation,
}

impl Orientations {
    /// Of each point and as many of the points joined to it as there are dimensions.
    pub fn new(homotopy: &Homotopy, spare: &Vector) -> Self {
        let d = homotopy.dimension;
        let pairs: Vec<[usize; 2]> = homotopy.edges.iter().map(|edge| edge.points).collect();
        let mut all = simplices(d, homotopy.points, &pairs);
        all.extend(homotopy.followed.iter().cloned());
        for points in &mut all {
            points.sort_unstable();
        }
        let all = each_once(all);
        let entry = |p: usize, axis: usize| {
            let unknown = homotopy.coordinate(p, axis);
            unknown.unwrap_or(homotopy.equations + 1) as u32
        };
        let simplex = |points: Vec<usize>, segment: Option<Segment>| Simplex {
            entries: {
                let radii = segment.as_ref().map_or(&[][..], |s| s.extent.radii());
                array(
                    |k| match k.checked_sub(points.len()).and_then(|k| radii.get(k)) {
                        Some(&radius) => [radius as u32; 3],
                        None => array(|axis| entry(points[k.min(points.len() - 1)], axis)),
                    },
                )
            },
            segment,
            what: Orientation {
                points,
                sign: 0,
                lost: None,
            },
        };
        let segments = homotopy.segments.iter().map(|segment| {
            let points = segment.extent.points().to_vec();
            simplex(points, Some(segment.clone()))
        });
        let all = all.into_iter().map(|points| simplex(points, None));
        Orientations {
            all: all.chain(segments).collect(),
            known: Vec::new(),
            unbroken: Vec::new(),
            piece: Piece::new(spare),
        }
    }

    /// Finds the signs of a figure.
    pub fn begin(&mut self, figure: &Figure) {
        self.piece.stand(figure);
        self.known.clear();
        self.unbroken.clear();
        for (index, simplex) in self.all.iter_mut().enumerate() {
            simplex.what.lost = None;
            simplex.what.sign = simplex.sign(&self.piece);
            if simplex.what.sign != 0 {
                match simplex.segment {
                    None => self.known.push(index as u32),
                    Some(_) => self.unbroken.push(index as u32),
                }
            }
        }
    }

    /// Follows the signs along a tube, between two parameters.
    pub fn follow<const N: usize, Y: Frame>(&mut self, tube: &Tube<N, Y>, (from, to): (f64, f64)) {
        let known = std::mem::take(&mut self.known);
        let unbroken = std::mem::take(&mut self.unbroken);
        let mut keep = |mut known: Vec<u32>, depth: usize| {
            let mut doubtful = known.clone();
            self.split(tube, (from, to), depth, &mut doubtful);
            if !doubtful.is_empty() {
                known.retain(|index| !doubtful.contains(index));
            }
            known
        };
        let (known, unbroken) = (keep(known, DEPTH), keep(unbroken, DEEP));
        (self.known, self.unbroken) = (known, unbroken);
    }

    /// Leaves those that are lost between two parameters, and notes where.
    fn split<const N: usize, Y: Frame>(
        &mut self,
        tube: &Tube<N, Y>,
        (a, b): (f64, f64),
        depth: usize,
        doubtful: &mut Vec<u32>,
    ) {
        if doubtful.is_empty() {
            return;
        }
        self.piece.look(tube, a, b);
        let (piece, all) = (&self.piece, &mut self.all);
        doubtful.retain(|&index| {
            let simplex = &mut all[index as usize];
            let (sign, before) = (simplex.sign(piece), simplex.what.sign);
            match &simplex.segment {
                None => sign != before,
                Some(segment) if segment.extent.goes_with(before, sign) => {
                    simplex.what.sign = sign;
                    false
                }
                Some(_) => true,
            }
        });
        if doubtful.is_empty() {
            return;
        }
        let half = 0.5 * (a + b);
        if depth == 0 || !(a < half && half < b) {
            let t = tube.time().range(a, b);
            for &index in doubtful.iter() {
                self.all[index as usize].what.lost = Some(t);
            }
            return;
        }
        let mut first = doubtful.clone();
        self.split(tube, (a, half), depth - 1, &mut first);
        doubtful.retain(|index| !first.contains(index));
        self.split(tube, (half, b), depth - 1, doubtful);
        doubtful.extend(first);
    }

    /// What became of all triangles and tetrahedra.
    pub fn account(&self) -> Vec<Orientation> {
        let simplices = self.all.iter().filter(|simplex| simplex.segment.is_none());
        simplices.map(|simplex| simplex.what.clone()).collect()
    }

    /// What became of all lines and arcs. `vanishes`: the vector of which a run could not prove any more that it is not zero, at t; the line of
    /// which it is the direction is lost there.
    pub fn segments(&self, vanishes: Option<(&Nonzero, f64)>, homotopy: &Homotopy) -> Vec<Kept> {
        let segments = self.all.iter().filter_map(|simplex| {
            let segment = simplex.segment.as_ref()?;
            let vanishes = vanishes.filter(|(vector, _)| is_between(vector, segment, homotopy));
            let lost = simplex.what.lost;
            Some(Kept {
                object: segment.object,
                other: segment.other,
                sign: simplex.what.sign,
                lost: lost.or(vanishes.map(|(_, t)| (t, t))),
            })
        });
        segments.collect()
    }
}

/// Whether a vector is that from one end of a line along an axis to the other.
fn is_between(vector: &Nonzero, segment: &Segment, homotopy: &Homotopy) -> bool {
    let Extent::Along { ends, .. } = segment.extent else {
        return false;
    };
    (0..homotopy.dimension).all(|axis| {
        let Form::Difference(a, b) = vector.forms[axis] else {
            return false;
        };
        let [a, b] = [a, b].each(|entry| homotopy.entry(entry));
        let [from, to] = ends.each(|p| homotopy.coordinate(p, axis));
        (a, b) == (from, to) || (a, b) == (to, from) || a == b && from == to
    })
}

impl Simplex {
    /// The sign, where it is the same for every θ and within all radii; otherwise 0.
    fn sign(&self, piece: &Piece) -> i8 {
        let at = |k: usize| self.entries[k].each(|i| piece.at(i as usize));
        // A term of `rest` goes through two more roundings in a sum, and in a product through those of both factors and five more: 22 in a
        // determinant of four points, 37 at most of two edges (d⁴ of two arcs in `misses`), and one here.
        let certain = |value: Along| {
            let error = value.reach(60);
            i8::from(value.value > error) - i8::from(value.value < -error)
        };
        match &self.segment {
            Some(segment) => segment.extent.sign(at, certain),
            None => {
                let count = self.what.points.len();
                assert!(count == 4 || piece.is_last(self.entries[0][2] as usize));
                certain(determinant(count, at))
            }
        }
    }
}
