//! Elimination through the R-structure at one point: what refines and expands the path.

use super::layout::{Layout, Order};
use super::passes::{Derivative, Inverses};
use super::substitution::Substitution;
use crate::linalg::rstructure::{
    Blocks, Elimination as Reduced, MAX_KEYS, Row, Solves, add, zeros,
};
use crate::linalg::{Singular, Vector, dot, is_odd};
use crate::track::full::{Differences, Equations, Lengths};
use std::sync::Arc;

/// What is kept from one point to the next.
#[derive(Debug, Clone)]
pub struct Maker {
    order: Order,
    layout: Arc<Layout>,
    /// Work space.
    candidate: Layout,
    alpha: f64,
    /// Whether a layout is chosen at the next point; otherwise that of the point before is taken.
    pub chooses: bool,
}

impl Maker {
    /// Nothing is chosen until the first point.
    pub fn new(order: Order, alpha: f64) -> Self {
        let alpha = (SINES * alpha).min(0.5);
        Maker {
            order,
            layout: Arc::new(Layout::default()),
            candidate: Layout::default(),
            alpha,
            chooses: true,
        }
    }
}

/// Directions of distances are told apart by their sines, of which so many times α is asked: measured,
/// see docs/how/tubes.md.
const SINES: f64 = 2.5;

/// The factors at one point.
#[derive(Debug, Clone)]
pub struct Elimination {
    pub layout: Arc<Layout>,
    pub inverses: Inverses,
    /// K₀ = −A⁻¹H, a row per unknown and one of zeros, and S₀⁻¹ transposed, the normal's row last.
    pub reduced: Reduced,
    d: Vec<Vector>,
    slope: Vector,
    normal: Vector,
    /// Values of the tail's entries.
    entries: Vec<f64>,
    /// Where there are other equations than distances.
    substitution: Substitution,
}

impl Elimination {
    /// Room for one.
    pub fn new(equations: &Equations) -> Self {
        Elimination {
            layout: Arc::new(Layout::default()),
            inverses: Inverses::default(),
            reduced: Reduced::default(),
            d: equations.per_axis(),
            slope: equations.per_edge(),
            normal: equations.vector(),
            entries: vec![0.0; equations.tail.entries()],
            substitution: Substitution::default(),
        }
    }

    /// Factors [J; c] at a point, with the layout that suits it, or as it was if the maker does not
    /// choose.
    pub fn make(
        &mut self,
        maker: &mut Maker,
        equations: &Equations,
        at: (&Differences, &Lengths, &Vector),
    ) -> Result<(), Singular> {
        if !maker.chooses {
            let layout = self.layout.clone();
            return self.make_like(&layout, equations, at);
        }
        maker
            .order
            .choose(equations, at.0, maker.alpha, &mut maker.candidate);
        if maker.candidate != *maker.layout {
            maker.layout = Arc::new(maker.candidate.clone());
        }
        self.make_like(&maker.layout, equations, at)
    }

    /// Factors [J; c] at a point with the given layout, whatever its pivots are.
    pub fn make_like(
        &mut self,
        layout: &Arc<Layout>,
        equations: &Equations,
        (d, lengths, normal): (&Differences, &Lengths, &Vector),
    ) -> Result<(), Singular> {
        self.layout = layout.clone();
        for (kept, d) in self.d.iter_mut().zip(&d.axes) {
            kept.copy_from_slice(d);
        }
        self.slope.copy_from_slice(&lengths.terms[1]);
        self.normal.copy_from_slice(normal);
        equations.tail.row_values(&d.forms, &mut self.entries);
        let mut inverses = std::mem::take(&mut self.inverses);
        if equations.tail.is_empty() {
            inverses.make(layout, &self.jacobian(equations));
        } else {
            let mut substitution = std::mem::take(&mut self.substitution);
            substitution.make(layout, &self.jacobian(equations), &mut inverses);
            self.substitution = substitution;
        }
        self.inverses = inverses;
        if !layout.is_square() {
            return Err(Singular);
        }
        let mut reduced = std::mem::take(&mut self.reduced);
        let made = reduced.make(&self.bordered(equations), 0);
        self.reduced = reduced;
        made
    }

    /// [J; c] at this point, its diagonal blocks inverted.
    fn bordered<'a>(&'a self, equations: &'a Equations) -> Bordered<'a> {
        Bordered {
            jacobian: self.jacobian(equations),
            layout: &self.layout,
            inverses: &self.inverses,
            substitution: &self.substitution,
            normal: &self.normal[..equations.n()],
            equations: equations.m,
        }
    }

    /// Why none could be made last, where that is not because the matrix is singular.
    pub fn obstacle(&self) -> Option<String> {
        let keys = self.layout.keys();
        (keys > MAX_KEYS).then(|| {
            format!(
                "the construction plan has {keys} key unknowns, more than the {MAX_KEYS} that the reduced \
                 space has room for"
            )
        })
    }

    /// Whether det [J; c] is negative, as floats see it: A's blocks times S₀, and the order of rows and
    /// columns.
    pub fn is_negative(&self, equations: &Equations) -> bool {
        let layout = &*self.layout;
        let mut negative = self.reduced.is_negative;
        for (at, block) in layout.blocks.iter().enumerate() {
            negative ^= self.inverses.is_negative(at, block);
        }
        let blocks = || layout.blocks.iter();
        let rows = blocks().flat_map(|b| b.rows[..b.size].iter().copied());
        let rows = rows.chain(layout.ignored.iter().copied());
        let columns = blocks().flat_map(|b| b.unknowns[..b.size].iter().copied());
        let columns = columns.chain(layout.keys.iter().copied());
        let rows = rows.chain([equations.m as u32]);
        let [rows, columns]: [Vec<usize>; 2] = [
            rows.map(|row| row as usize).collect(),
            columns.map(|column| column as usize).collect(),
        ];
        let mut seen = Vec::new();
        negative ^ is_odd(&rows, &mut seen) ^ is_odd(&columns, &mut seen)
    }

    /// The Jacobian at this point.
    pub fn jacobian<'a>(&'a self, equations: &'a Equations) -> Derivative<'a> {
        Derivative {
            ends: &equations.ends,
            d: &self.d,
            slope: &self.slope,
            t: equations.m,
            tail: &equations.tail,
            entries: &self.entries,
        }
    }

    /// `x = [J; c]⁻¹ f`; entries of `f` beyond its end are zero.
    pub fn solve(&self, equations: &Equations, f: &[f64], x: &mut Vector) {
        self.reduced.solve(&self.bordered(equations), f, x);
    }
}

/// [J; c] with its diagonal blocks inverted, as elimination reads it.
struct Bordered<'a> {
    jacobian: Derivative<'a>,
    layout: &'a Layout,
    inverses: &'a Inverses,
    substitution: &'a Substitution,
    normal: &'a [f64],
    /// The number of equations, that of the normal's row.
    equations: usize,
}

impl Blocks<f64> for Bordered<'_> {
    fn keys(&self) -> usize {
        self.layout.keys()
    }

    fn unknowns(&self) -> usize {
        self.normal.len()
    }

    /// One for each unknown, and one of zeros for fixed coordinates.
    fn rows(&self) -> usize {
        self.normal.len() + 1
    }

    fn key(&self, at: usize) -> usize {
        self.layout.keys[at] as usize
    }

    fn substitute<const W: usize>(&self, rows: &mut [Row<W>]) {
        self.jacobian
            .substitute_alone(self.layout, self.inverses, rows);
    }

    #[inline(always)]
    fn ignored_row<const W: usize>(&self, at: usize, rows: &[Row<W>]) -> Row<W> {
        if let Some(&e) = self.layout.ignored.get(at) {
            return self.jacobian.any_row(e as usize, rows);
        }
        let mut sum = zeros();
        for (c, row) in self.normal.iter().zip(rows) {
            add(&mut sum, *c, row);
        }
        sum
    }
}

impl Solves<f64> for Bordered<'_> {
    fn substitute_one(&self, f: &[f64], x: &mut [f64]) {
        if self.jacobian.tail.is_empty() {
            self.jacobian.solve(self.layout, self.inverses, f, x);
        } else {
            self.substitution.solve(self.layout, self.inverses, f, x);
        }
    }

    #[inline(always)]
    fn ignored_rest(&self, at: usize, f: &[f64], x: &[f64]) -> f64 {
        match self.layout.ignored.get(at) {
            Some(&e) => f[e as usize] - self.jacobian.any_row_of(e as usize, x),
            None => {
                let given = f.get(self.equations).copied().unwrap_or(0.0);
                given - dot(self.normal, &x[..self.normal.len()])
            }
        }
    }
}
