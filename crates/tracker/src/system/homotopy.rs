//! H(X, t), as the trackers see it.

use super::{Beside, ExactLength, Gauge, GaugeError, Length, Right, Segment};
use crate::constraint::{self, Entry, Equation, Role, Tail};
use crate::equations::{Form, Product, Ring, left_side, slopes};
use crate::interval::vector::distance;
use crate::interval::{Interval, ZERO, enclose, enclose_rational, point};
use crate::places::array;
use crate::problem::{Decimal, Distance, Problem, Shape};

/// Two points at a given distance, as places: `point * dimension` of either.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// First point and second point.
    pub points: [usize; 2],
}

/// A term of 2 q_e(X): a product of differences of unknowns, by number; `None` is the number 0.
pub type Term = Product<Option<usize>>;

/// The homotopy H(X, t) = F(X, a(t)) = 0 of a problem (RR 8705, section 2.2): m equations
/// q_e(X) − E_e(t) = 0 in m unknowns and t. The first equations are the distances, in the problem's
/// order, q_e = ½|p_i − p_j|², E_e = ½ a_e²; then come those of all other constraints. The first
/// unknowns are the free coordinates; then come the auxiliary ones.
///
/// All lengths and coordinates in here are divided by [`Homotopy::unit`], a power of two near the
/// problem's typical length, so that results do not depend on the scale of the input. A *figure*
/// is a vector of `points * dimension` places, in which fixed coordinates are zero.
#[derive(Debug, Clone)]
pub struct Homotopy {
    /// 2 or 3.
    pub dimension: usize,
    /// The number of points.
    pub points: usize,
    /// The number m of equations, and of unknowns without t.
    pub equations: usize,
    /// The length that 1 stands for in here: a power of two.
    pub unit: f64,
    /// Which coordinates are free.
    pub gauge: Gauge,
    /// The distances, in the problem's order.
    pub edges: Vec<Edge>,
    /// Their lengths, in the same order.
    pub lengths: Vec<Length>,
    /// What other constraints there are, and their unknowns.
    pub tail: Tail,
    /// Of sets: the equations that were left out, as there are more than unknowns.
    pub spare: Vec<constraint::Spare>,
    /// The problem's objects.
    pub shapes: Vec<Shape>,
    /// 2 q_e of the equations behind the distances.
    terms: Vec<Vec<Term>>,
    /// The right-hand sides E_e(t) of all equations.
    pub rights: Vec<Right>,
    /// What people call the equations.
    pub names: Vec<String>,
    /// What they call the points.
    pub point_names: Vec<String>,
    /// An enclosure of the sketch, all places.
    pub sketch_box: Vec<Interval>,
    /// Its middle.
    pub sketch: Vec<f64>,
    /// Enclosures of the auxiliary unknowns in the sketch.
    auxiliary: Vec<Interval>,
    /// Points whose orientation is followed along arcs, beside those that distances join.
    pub followed: Vec<Vec<usize>>,
    /// Lines and arcs that are followed along arcs of path, as they must not shrink to nothing and come out turned round.
    pub segments: Vec<Segment>,
    /// Equations that are not among these, of which is looked how far the figures along arcs are off them.
    pub beside: Vec<Beside>,
}

impl Homotopy {
    /// Sets up the homotopy of a checked problem.
    ///
    /// Fails where the sketch cannot be seen from the reference.
    pub fn new(problem: &Problem) -> Result<Self, GaugeError> {
        Self::with_unit(problem, typical_length(problem))
    }

    /// Sets up the homotopy in the lengths of the problem, as the paper has it: the steps of RR 8705, section 7,
    /// are in them. Where the typical length is beyond 1/64 or 64 the paper's numbers would make no
    /// sense, and the unit is the typical length.
    pub fn for_the_paper(problem: &Problem) -> Result<Self, GaugeError> {
        let typical = typical_length(problem);
        let unit = if (1.0 / 64.0..=64.0).contains(&typical) {
            1.0
        } else {
            typical
        };
        Self::with_unit(problem, unit)
    }

    /// Sets up the homotopy in a unit of one's own choice.
    ///
    /// # Panics
    /// If `unit` is not a power of two: only divisions by such are exact.
    pub fn with_unit(problem: &Problem, unit: f64) -> Result<Self, GaugeError> {
        Self::with_constraints(problem, unit, |sketch| constraint::lower(problem, sketch))
    }

    /// Sets up the equations for sets of all figures, which mean something at t = 1 alone: vectors of which the lengths are no
    /// dimensions are divided by these, so that where they nearly vanish equations still say something.
    ///
    /// # Panics
    /// If `unit` is not a power of two.
    pub fn for_sets_in(problem: &Problem, unit: f64) -> Result<Self, GaugeError> {
        Self::for_sets_without(problem, unit, |_, _, _| Ok(Vec::new()))
    }

    /// The same, where `leave_out` takes equations out if there are more than unknowns; it is given the equations, the gauge, and
    /// the sketch as seen from the reference.
    #[doc(hidden)]
    pub fn for_sets_without(
        problem: &Problem,
        unit: f64,
        leave_out: impl Fn(
            &mut constraint::Lowered,
            &Gauge,
            &[[Interval; 3]],
        ) -> Result<Vec<constraint::Spare>, String>,
    ) -> Result<Self, GaugeError> {
        let distances = match constraint::has_distances_in_sets(problem) {
            true => &[],
            false => &problem.distances[..],
        };
        let gauge = Gauge::new(problem);
        let sketch = gauge.sketch(problem)?;
        let lowered = constraint::try_lower_for_sets(problem, |lowered| {
            let unknowns = gauge.place.len() + lowered.tail.unknowns.len();
            match distances.len() + lowered.tail.equations.len() > unknowns && distances.is_empty()
            {
                true => leave_out(lowered, &gauge, &sketch),
                false => Ok(Vec::new()),
            }
        });
        let (tail, spare) = lowered.map_err(GaugeError::Constraints)?;
        if gauge.place.len() + tail.unknowns.len() != distances.len() + tail.equations.len() {
            let what = "there are not as many equations as unknowns".to_owned();
            return Err(GaugeError::Constraints(what));
        }
        let mut homotopy = Self::with_equations(problem, unit, distances, |_| tail)?;
        homotopy.spare = spare;
        Ok(homotopy)
    }

    /// Sets up the homotopy with other constraints in place of the problem's own: `lower` makes their equations from
    /// the sketch as it is seen from the reference.
    #[doc(hidden)]
    pub fn with_constraints(
        problem: &Problem,
        unit: f64,
        lower: impl FnOnce(&[[Interval; 3]]) -> Tail,
    ) -> Result<Self, GaugeError> {
        Self::with_equations(problem, unit, &problem.distances, lower)
    }

    /// The same with some distances in place of the problem's own.
    fn with_equations(
        problem: &Problem,
        unit: f64,
        distances: &[Distance],
        lower: impl FnOnce(&[[Interval; 3]]) -> Tail,
    ) -> Result<Self, GaugeError> {
        assert!(
            unit.is_normal() && unit > 0.0 && unit.to_bits() << 12 == 0,
            "the unit {unit} is not a power of two"
        );
        let mut gauge = Gauge::new(problem);
        let sketch = gauge.sketch(problem)?;
        let tail = lower(&sketch);
        let equations = gauge.place.len() + tail.unknowns.len();
        assert_eq!(
            equations,
            distances.len() + tail.equations.len(),
            "as many equations as unknowns"
        );
        gauge.append(tail.unknowns.len());
        let per_unit = point(1.0 / unit);
        let sketch_box: Vec<Interval> = sketch
            .into_iter()
            .flat_map(|p| p.into_iter().take(problem.dimension))
            .map(|x| x * per_unit)
            .collect();
        let mut homotopy = Homotopy {
            edges: distances
                .iter()
                .map(|d| Edge { points: d.points })
                .collect(),
            names: (0..distances.len())
                .map(|d| problem.distance_name(d))
                .collect(),
            point_names: problem.points.iter().map(|p| p.name.clone()).collect(),
            sketch: sketch_box.iter().map(|x| x.mid()).collect(),
            sketch_box,
            shapes: problem.objects.iter().map(|o| o.shape.clone()).collect(),
            ..Homotopy::without_equations(gauge, unit, tail)
        };
        homotopy.add_distances(problem, distances);
        homotopy.add_constraints();
        Ok(homotopy)
    }

    /// A homotopy of the same distances with another tail, of no fewer auxiliary unknowns.
    pub(super) fn with_other_tail(&self, tail: Tail) -> Self {
        let mut other = self.clone();
        let head = self.edges.len();
        let places = self.gauge.place.len();
        other.equations = places + tail.unknowns.len();
        assert_eq!(
            other.equations,
            head + tail.equations.len(),
            "as many equations as unknowns"
        );
        // Coordinates that the reference fixes have the number of all unknowns.
        for variable in &mut other.gauge.variable {
            if *variable == self.equations {
                *variable = other.equations;
            }
        }
        other.tail = tail;
        other.terms.clear();
        other.rights.truncate(head);
        other.names.truncate(head);
        other.auxiliary.clear();
        other.add_constraints();
        other
    }

    /// What has the unknowns of a gauge and a tail, and nothing else.
    fn without_equations(gauge: Gauge, unit: f64, tail: Tail) -> Self {
        let places = gauge.variable.len();
        Homotopy {
            dimension: gauge.dimension,
            points: places / gauge.dimension,
            equations: gauge.place.len() + tail.unknowns.len(),
            unit,
            edges: Vec::new(),
            lengths: Vec::new(),
            terms: Vec::new(),
            rights: Vec::new(),
            names: Vec::new(),
            point_names: Vec::new(),
            sketch: vec![0.0; places],
            sketch_box: vec![point(0.0); places],
            auxiliary: Vec::new(),
            followed: Vec::new(),
            spare: Vec::new(),
            segments: Vec::new(),
            beside: Vec::new(),
            shapes: Vec::new(),
            gauge,
            tail,
        }
    }

    /// The homotopy of a tail alone, all unknowns being its own. `variable`: see [`Gauge::variable`].
    pub(super) fn without_distances(
        dimension: usize,
        variable: Vec<usize>,
        unit: f64,
        tail: Tail,
    ) -> Self {
        let gauge = Gauge {
            dimension,
            reference: Vec::new(),
            place: Vec::new(),
            variable,
        };
        let mut homotopy = Homotopy::without_equations(gauge, unit, tail);
        homotopy.add_constraints();
        homotopy
    }

    /// The homotopy of equations that are about no points: all its unknowns are those of `tail`.
    ///
    /// # Panics
    /// If there are not as many equations as unknowns, or one of them is about a point.
    pub fn of_equations(tail: Tail) -> Self {
        assert_eq!(
            tail.unknowns.len(),
            tail.equations.len(),
            "as many equations as unknowns"
        );
        Self::without_distances(2, Vec::new(), 1.0, tail)
    }

    fn add_distances(&mut self, problem: &Problem, distances: &[Distance]) {
        let per_unit = point(1.0 / self.unit);
        for (index, distance) in distances.iter().enumerate() {
            let squared = problem.squared_in_sketch(distance.points);
            let sketch = enclose_rational(&squared).sqrt();
            let target = distance.target.enclose();
            let bend = (index == problem.homotopy.bend)
                .then(|| enclose(&problem.homotopy.bend_coefficient) * per_unit);
            let exact = ExactLength {
                sketch_squared: squared,
                target: distance.target.clone(),
                bend: (index == problem.homotopy.bend)
                    .then(|| problem.homotopy.bend_coefficient.clone()),
                unit: self.unit,
            };
            let length = Length::new(sketch * per_unit, target * per_unit, bend);
            self.rights.push(Right::half_square(&length, exact));
            self.lengths.push(length);
        }
    }

    fn add_constraints(&mut self) {
        for equation in &self.tail.equations {
            let (terms, right) = self.terms_of(equation);
            assert!(!terms.is_empty(), "an equation has a left-hand side");
            self.terms.push(terms);
            self.rights.push(right);
            self.names.push(equation.name.clone());
        }
        for unknown in &self.tail.unknowns {
            // Division by a power of two is exact.
            let unit = point(1.0 / self.unit.powi(unknown.power));
            self.auxiliary.push(unknown.sketch * unit);
        }
    }

    /// Twice the left-hand side of an equation in these unknowns, and its right-hand side.
    pub(super) fn terms_of(&self, equation: &Equation) -> (Vec<Term>, Right) {
        let terms = equation.products.iter().map(|product| {
            assert!(
                (1..=1000).contains(&product.factor.abs()),
                "factors are small whole numbers"
            );
            product.map(|entry| self.entry(entry))
        });
        let unit = self.unit.powi(equation.power);
        (terms.collect(), Right::polynomial(&equation.right, unit))
    }

    /// The unknown that an entry is, or `None` if it is zero.
    #[doc(hidden)]
    pub fn entry(&self, entry: Entry) -> Option<usize> {
        match entry {
            Entry::Zero => None,
            Entry::Unknown(k) => {
                assert!(k < self.tail.unknowns.len(), "an auxiliary unknown");
                Some(self.gauge.place.len() + k)
            }
            Entry::Coordinate { point, axis } => self.coordinate(point, axis),
        }
    }

    /// The power of the unit of length that an unknown has.
    pub fn power(&self, unknown: usize) -> i32 {
        let auxiliary = unknown.checked_sub(self.gauge.place.len());
        auxiliary.map_or(1, |k| self.tail.unknowns[k].power)
    }

    /// The unknowns that are an object's own, in the order in which they are made; entries that are zero are left out.
    pub fn object_unknowns(&self, object: usize) -> impl Iterator<Item = usize> + '_ {
        let entries = self.tail.objects[object].iter();
        entries.filter_map(|&entry| self.entry(entry))
    }

    /// The unknown that a point's coordinate is, or `None` where it is zero.
    pub fn coordinate(&self, point: usize, axis: usize) -> Option<usize> {
        (axis < self.dimension)
            .then(|| self.gauge.variable[point * self.dimension + axis])
            .filter(|&v| v < self.equations)
    }

    /// The place of a point where unknowns have these values.
    pub fn place<T: Ring>(&self, point: usize, at: impl Fn(usize) -> T) -> [T; 3] {
        let coordinate = |axis| self.coordinate(point, axis);
        std::array::from_fn(|axis| coordinate(axis).map_or_else(|| T::whole(0), &at))
    }

    /// The points of the equations that have half the square of a distance on the left: of the distances, and of the
    /// constraints that come next to them and are of the same form.
    pub fn half_squares(&self) -> impl Iterator<Item = Edge> + '_ {
        let tail = self.tail.equations.iter();
        let alike = tail.map_while(|equation| equation.ends(self.dimension));
        let distances = self.edges.iter().copied();
        distances.chain(alike.map(|points| Edge { points }))
    }

    /// The terms of 2 q_e of any equation: the squares of a distance's differences, or what a
    /// constraint has.
    pub fn terms(&self, equation: usize) -> Vec<Term> {
        let head = self.edges.len();
        if equation >= head {
            return self.terms[equation - head].clone();
        }
        let of_axis = |axis: usize| {
            let [a, b] = self.edges[equation].points;
            let form = Form::Difference(self.coordinate(a, axis), self.coordinate(b, axis));
            Term::new(1, form, form)
        };
        (0..self.dimension).map(of_axis).collect()
    }

    /// Whether a box (all unknowns, and t) may hold a zero of each equation, as far as intervals tell: false where one
    /// is certainly not zero anywhere in it.
    pub fn may_hold(&self, z: &[Interval]) -> bool {
        let m = self.equations;
        (0..m).all(|e| {
            let missed = self.left_side(e, |i| z[i]) - self.rights[e].enclose(z[m]);
            missed.contains(0.0)
        })
    }

    /// An enclosure of q_e, the left-hand side of an equation, where unknowns have these values.
    pub fn left_side(&self, equation: usize, at: impl Fn(usize) -> Interval) -> Interval {
        let at = |entry: Option<usize>| entry.map_or(ZERO, &at);
        left_side(&self.terms(equation), at)
    }

    /// Enclosures of its derivatives by all unknowns.
    pub fn slopes(&self, equation: usize, at: impl Fn(usize) -> Interval) -> Vec<Interval> {
        let at = |entry: Option<usize>| entry.map_or(ZERO, &at);
        let mut out = vec![ZERO; self.equations];
        slopes(&self.terms(equation), at, |entry, slope| {
            entry.into_iter().for_each(|i| out[i] += slope);
        });
        out
    }

    /// The numbers of the auxiliary unknowns among all.
    pub fn auxiliary_unknowns(&self) -> std::ops::Range<usize> {
        self.gauge.place.len()..self.equations
    }

    /// An enclosure of each unknown in the sketch.
    pub fn sketch_of_unknowns(&self) -> impl Iterator<Item = Interval> + '_ {
        let coordinates = self.gauge.place.iter().map(|&p| self.sketch_box[p]);
        coordinates.chain(self.auxiliary.iter().copied())
    }

    /// The auxiliary unknowns that have to be proved positive, lengths and radii: their numbers among all
    /// unknowns.
    pub fn positive_unknowns(&self) -> Vec<usize> {
        let first = self.gauge.place.len();
        let unknowns = self.tail.unknowns.iter().enumerate();
        let positive = unknowns.filter(|(_, unknown)| unknown.role == Role::Positive);
        positive.map(|(k, _)| first + k).collect()
    }

    /// The vectors that must not vanish along the path: per coordinate the unknowns of which it is the difference,
    /// where m + 1 stands for zero.
    pub fn nonzero_vectors(&self) -> Vec<Vec<[usize; 2]>> {
        let zero = self.equations + 1;
        let form = |form: &constraint::Form| match form.map(|e| self.entry(e).unwrap_or(zero)) {
            Form::One => unreachable!("a coordinate of a vector is a difference"),
            Form::Difference(from, to) => [from, to],
        };
        let vectors = self.tail.nonzero.iter();
        vectors
            .map(|vector| vector.forms[..self.dimension].iter().map(form).collect())
            .collect()
    }

    /// Whether in a figure, given by all unknowns in floats, the lengths and radii among them are positive and no
    /// vector vanishes that must not.
    pub fn is_proper(&self, x: &[f64]) -> bool {
        let size = x.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        let at = |i: usize| if i > self.equations { 0.0 } else { x[i] };
        let is_there = |vector: &Vec<[usize; 2]>| {
            let mut coordinates = vector.iter().map(|&[i, j]| at(i) - at(j));
            // Far above what Newton's method leaves of zero.
            coordinates.any(|d| d.abs() > 1e-13 * size)
        };
        self.positive_unknowns().iter().all(|&i| x[i] > 0.0)
            && self.nonzero_vectors().iter().all(is_there)
    }

    /// Whether that is so all over a box of the unknowns, proved.
    pub fn is_proper_over(&self, at: impl Fn(usize) -> Interval) -> bool {
        let known = |i: usize| if i > self.equations { ZERO } else { at(i) };
        let is_there = |vector: &Vec<[usize; 2]>| {
            let mut coordinates = vector.iter().map(|&[i, j]| known(i) - known(j));
            coordinates.any(|x| !x.contains(0.0))
        };
        self.positive_unknowns().iter().all(|&i| at(i).inf() > 0.0)
            && self.nonzero_vectors().iter().all(is_there)
    }

    /// All changes of sign of unknowns with which a figure stays as it is: sums of those of the tail, beginning with
    /// none. `None`: there are too many.
    pub fn twins(&self) -> Option<Vec<Vec<bool>>> {
        const LARGEST: usize = 10;
        let basis = &self.tail.twins;
        if basis.len() > LARGEST {
            return None;
        }
        let first = self.gauge.place.len();
        let sum = |mask: usize| {
            let mut changes = vec![false; self.equations];
            for (k, change) in basis.iter().enumerate() {
                if mask >> k & 1 == 1 {
                    let pairs = changes[first..].iter_mut().zip(change);
                    pairs.for_each(|(x, y)| *x ^= y);
                }
            }
            changes
        };
        Some((0..1 << basis.len()).map(sum).collect())
    }

    /// Whether an unknown changes its sign where an axis is reversed.
    pub fn flips(&self, unknown: usize, axis: usize) -> bool {
        match self.gauge.place.get(unknown) {
            Some(place) => place % self.dimension == axis,
            None => self.tail.unknowns[unknown - self.gauge.place.len()].flips[axis],
        }
    }

    /// Where a length is nearly zero at t, beside what it is at either end, a remark for people who
    /// wonder why the run ended there: where two joined points coincide the equations are singular.
    pub fn remark_on_lengths(&self, t: f64) -> String {
        let part =
            |length: &Length| length.value(t).abs() / length.value(0.0).max(length.value(1.0));
        let parts = self.lengths.iter().map(part).enumerate();
        match parts.min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((index, part)) if part < 1e-3 => {
                let length = self.lengths[index].value(t).abs() * self.unit;
                format!(
                    "; the length of {} goes to zero there ({length:.1e})",
                    self.names[index]
                )
            }
            _ => String::new(),
        }
    }
}

/// The power of two nearest to the mean target length; where there are no distances, to the mean
/// distance of the sketch's points from their middle.
pub fn typical_length(problem: &Problem) -> f64 {
    let mean = if problem.distances.is_empty() {
        let mut places = problem.places();
        let bodies = problem.objects.iter().filter_map(|o| o.place());
        places.extend(bodies.map(|place| place.at.each_ref().map(Decimal::to_f64)));
        let n = places.len().max(1) as f64;
        let middle: [f64; 3] = array(|k| places.iter().map(|p| p[k]).sum::<f64>() / n);
        let mean = places.iter().map(|p| distance(*p, middle)).sum::<f64>() / n;
        if mean > 0.0 { mean } else { 1.0 }
    } else {
        let lengths = problem.distances.iter().map(|d| d.target.to_f64());
        lengths.sum::<f64>() / problem.distances.len() as f64
    };
    2f64.powi(mean.log2().round() as i32)
}
