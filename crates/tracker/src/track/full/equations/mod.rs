//! H(X, t) laid out for the inner loops: one vector over all equations for each quantity.
//!
//! Distances are the *head*: their differences stand in lanes, one vector for each axis. All other
//! equations are the *tail*, a list of products of differences (`tail.rs`). Equations of the tail have a place
//! in the head's vectors too, where their differences are zero, so that one loop serves the right-hand sides
//! of all; what the tail adds costs one branch where there is none.

mod errors;
mod kernels;
mod patterns;
mod room;

use super::extended::Extended;
use super::tail::{Forms, Tail};
use crate::linalg::{Sparse, Vector};
use crate::places::Each as _;
use crate::system::Homotopy;

pub use room::{Differences, Lengths};

pub use crate::constraint::MAX_DEGREE;

/// E(t) of an equation in which it is of degree 4, as for a distance that bends.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// Which equation.
    pub edge: usize,
    /// The coefficients of E.
    pub e: [f64; 5],
    /// How far the exact ones may be away.
    pub e_radius: [f64; 5],
}

/// The m equations in n = m + 1 unknowns, t last, of a problem in the plane or in space.
///
/// A vector of unknowns has a spare entry n more, always zero, from which fixed coordinates are read.
#[derive(Debug, Clone)]
pub struct Equations {
    /// The number m of equations.
    pub m: usize,
    /// The entries of z for either point's coordinates, per axis and distance; for other equations the spare
    /// one.
    pub ends: Vec<Vec<[u32; 2]>>,
    /// The equations that are no distances.
    pub tail: Tail,
    /// The coefficients of E up to t², per equation (those of degree 4 too), and their radii.
    pub e: [Vector; 3],
    /// See `e`.
    pub e_radius: [Vector; 3],
    /// The equations with an E of degree 4: the distance that bends, if there is one, and more in the tail.
    pub bends: Vec<Bend>,
    /// The lengths in extended precision, once that was asked for.
    extended: Option<Box<Extended>>,
    /// The pattern of a derivative of the Jacobian.
    pattern: Sparse,
    /// The pattern of the Jacobian with the normal for its last row.
    bordered: Sparse,
    /// For each axis, which entries of these its differences are.
    sources: Vec<Vec<Source>>,
}

/// An entry that is a difference, or minus one.
#[derive(Debug, Clone, Copy)]
struct Source {
    edge: u32,
    /// Its place among the values of the pattern, and of the bordered one.
    plain: u32,
    bordered: u32,
    sign: f64,
}

impl Equations {
    /// Lays out a homotopy.
    pub fn new(homotopy: &Homotopy) -> Self {
        let (dimension, m) = (homotopy.dimension, homotopy.equations);
        let entry = |point: usize, axis: usize| homotopy.coordinate(point, axis).unwrap_or(m + 1);
        let of_axis = |axis: usize| {
            let head = homotopy.half_squares();
            let ends = head.map(|edge| edge.points.each(|p| entry(p, axis) as u32));
            let of_tail = std::iter::repeat([m as u32 + 1; 2]);
            ends.chain(of_tail).take(m).collect()
        };
        let ends: Vec<Vec<[u32; 2]>> = (0..dimension).map(of_axis).collect();
        let rights = &homotopy.rights;
        let coefficient = |pick: &dyn Fn(usize) -> f64| {
            let mut out = Vector::zeros(m);
            (0..m).for_each(|e| out[e] = pick(e));
            out
        };
        let mut tail = Tail::new(homotopy);
        // The edges of each column's entries, with axes and signs.
        let mut columns = vec![Vec::new(); m];
        for (axis, ends) in ends.iter().enumerate() {
            for (edge, &end) in ends.iter().enumerate() {
                for (end, sign) in end.into_iter().zip([1.0, -1.0]) {
                    if (end as usize) < m {
                        columns[end as usize].push((edge, axis, sign));
                    }
                }
            }
        }
        let mut sources = vec![Vec::new(); dimension];
        let mut plain = 0;
        for (column, entries) in columns.iter().enumerate() {
            for &(edge, axis, sign) in entries {
                sources[axis].push(Source {
                    edge: edge as u32,
                    plain,
                    // The normal has one entry in each column before.
                    bordered: plain + column as u32,
                    sign,
                });
                plain += 1;
            }
            plain += tail.place_column(column, plain);
        }
        let rows = |(column, entries): (usize, &Vec<(usize, usize, f64)>)| {
            let head = entries.iter().map(|entry| entry.0);
            head.chain(tail.rows_of_column(column)).collect()
        };
        let mut plain: Vec<Vec<usize>> = columns.iter().enumerate().map(rows).collect();
        plain.push((0..m).collect());
        let bordered: Vec<Vec<usize>> = plain
            .iter()
            .map(|column| column.iter().copied().chain([m]).collect())
            .collect();
        Equations {
            m,
            ends,
            e: std::array::from_fn(|k| coefficient(&|e| rights[e].e[k])),
            e_radius: std::array::from_fn(|k| coefficient(&|e| rights[e].e_radius[k])),
            bends: bends(homotopy).collect(),
            tail,
            extended: None,
            pattern: Sparse::new(&plain),
            bordered: Sparse::new(&bordered),
            sources,
        }
    }

    /// Takes the right-hand sides of another homotopy of the same equations, with no more of degree 4 than
    /// there were at first.
    pub fn set_rights(&mut self, homotopy: &Homotopy) {
        let rights = &homotopy.rights;
        for k in 0..3 {
            for (e, right) in rights.iter().enumerate() {
                self.e[k][e] = right.e[k];
                self.e_radius[k][e] = right.e_radius[k];
            }
        }
        self.bends.clear();
        self.bends.extend(bends(homotopy));
        self.extended = None;
    }

    /// Makes room for extended precision.
    pub fn extend(&mut self, homotopy: &Homotopy) {
        if self.extended.is_none() {
            self.extended = Some(Box::new(Extended::new(homotopy)));
        }
    }

    /// F in extended precision.
    ///
    /// # Panics
    /// If [`Equations::extend`] was not called before.
    pub fn in_extended(&self) -> &Extended {
        self.extended.as_deref().expect("extended precision")
    }

    /// F in extended precision, to be written on by tests that put errors into it.
    ///
    /// # Panics
    /// If [`Equations::extend`] was not called before.
    #[cfg(test)]
    pub fn in_extended_mut(&mut self) -> &mut Extended {
        self.extended.as_deref_mut().expect("extended precision")
    }

    /// The number n of unknowns.
    pub fn n(&self) -> usize {
        self.m + 1
    }

    /// The number of axes.
    pub fn dimension(&self) -> usize {
        self.ends.len()
    }

    /// A vector of n unknowns and the spare entry.
    pub fn vector(&self) -> Vector {
        Vector::zeros(self.m + 2)
    }

    /// A vector of one entry per distance.
    pub fn per_edge(&self) -> Vector {
        Vector::zeros(self.m)
    }

    /// For each axis a vector of one entry per distance.
    pub fn per_axis(&self) -> Vec<Vector> {
        vec![self.per_edge(); self.dimension()]
    }

    /// Room for the differences of a vector of unknowns.
    pub fn room(&self) -> Differences {
        Differences {
            axes: self.per_axis(),
            forms: Forms::new(&self.tail),
        }
    }
}

/// The right-hand sides of degree 4.
fn bends(homotopy: &Homotopy) -> impl Iterator<Item = Bend> + '_ {
    let rights = homotopy.rights.iter().enumerate();
    rights
        .filter(|(_, right)| right.degree > 2)
        .map(|(edge, right)| Bend {
            edge,
            e: right.e,
            e_radius: right.e_radius,
        })
}
