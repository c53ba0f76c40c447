//! What `krawl tolerance` writes.

use super::{Bounds, Document, Drawing, Points, Undecided, Verb, all, bounds, points};
use crate::blocks::Account;
use crate::edit::Limits;
use crate::problem::Problem;
use crate::report::tolerance::{tolerance_set_in_words, tolerances_in_words, why_within};
use crate::tolerance::{Measured, OfSet, Set, Study};

keys! {
    /// What tolerances do to the figure drawn.
    Tolerance(problem: &Problem, study: &Study) {
        /// `proved`.
        status: String = "proved".into(),
        /// What is proved.
        words: String = tolerances_in_words(problem, study),
        /// Of what.
        account: Account = study.account.clone(),
        /// The limits of dimensions.
        limits: Vec<ToleranceLimits> = all(&study.limits, |limits| ToleranceLimits::new(problem, limits)),
        /// The figure with nominal dimensions.
        figure: Points<Bounds> = points(problem, &study.figure),
        /// Where each point stays.
        bands: Points<Bounds> = points(problem, &study.bands),
        /// What was measured.
        measured: Vec<ToleranceMeasured> = all(&study.measured, ToleranceMeasured::new),
    }
}

keys! {
    /// What tolerances do to all figures.
    Tolerances(problem: &Problem, set: &Set) {
        /// `complete` or `partial`.
        status: String = if set.undecided.is_empty() { "complete" } else { "partial" }.into(),
        /// What is proved.
        words: String = tolerance_set_in_words(problem, set),
        /// Of what.
        account: Account = set.account.clone(),
        /// The limits of dimensions.
        limits: Vec<ToleranceLimits> = all(&set.limits, |limits| ToleranceLimits::new(problem, limits)),
        /// Lines and planes of which either direction is meant.
        both_ways: Vec<String> = set.both_ways.clone(),
        /// Parts of the search that are not decided.
        undecided: Vec<Undecided> = all(&set.undecided, |part| Undecided::new(part, why_within(part.why))),
        /// The figures.
        figures: Vec<FigureWithin> = all(&set.figures, |figure| FigureWithin::new(problem, figure)),
    }
}

keys! {
    /// Between which values a dimension is.
    ToleranceLimits(problem: &Problem, limits: &Limits) {
        /// Its name.
        name: String = problem.dimension_name(limits.index),
        /// Its number.
        constraint: usize = limits.index,
        /// The least value, a decimal.
        least: String = limits.values[0].to_string(),
        /// The greatest value.
        greatest: String = limits.values[1].to_string(),
    }
}

keys! {
    /// What was measured.
    ToleranceMeasured(measured: &Measured) {
        /// What it is called.
        name: String = measured.name.clone(),
        /// In what it is measured.
        unit: String = measured.unit.into(),
        /// With nominal dimensions.
        nominal: Bounds = bounds(&measured.nominal),
        /// The least that it can be.
        least: Bounds = bounds(&measured.bounds[0]),
        /// The greatest that it can be.
        greatest: Bounds = bounds(&measured.bounds[1]),
        /// For each of both the values of the dimensions, in the order of the limits, of a figure that comes so near to it as its bounds say; none: the nominal figure.
        corners: [Vec<String>; 2] = measured.corners.each_ref().map(|corner| all(corner, ToString::to_string)),
        /// The root of the sum of the squares of half the effects; null where there is no first order.
        root_of_squares: Option<f64> = measured.root_of_squares,
        /// What each dimension does alone, to first order; empty where there is none.
        effects: Vec<f64> = measured.effects.clone(),
    }
}

keys! {
    /// One of all figures.
    FigureWithin(problem: &Problem, figure: &OfSet) {
        /// Where each point stays.
        bands: Points<Bounds> = points(problem, &figure.bands),
    } or nothing {
        /// The figure with nominal dimensions.
        figure: Option<Points<Bounds>> = figure.study.as_ref().ok().map(|study| points(problem, &study.figure)),
        /// What was measured.
        measured: Option<Vec<ToleranceMeasured>> = figure.study.as_ref().ok().map(|study| all(&study.measured, ToleranceMeasured::new)),
        /// Why nothing is.
        reason: Option<String> = figure.study.as_ref().err().map(ToString::to_string),
    }
}

impl Document {
    /// What tolerances do to the figure drawn.
    pub fn tolerance(problem: &Problem, study: &Study) -> Document {
        let own = Verb::Tolerance(Tolerance::new(problem, study));
        Document::of(Drawing::new("tolerance", problem), own)
    }

    /// What they do to all figures.
    pub fn tolerances(problem: &Problem, set: &Set) -> Document {
        let own = Verb::Tolerances(Tolerances::new(problem, set));
        Document::of(Drawing::new("tolerance", problem), own)
    }
}
