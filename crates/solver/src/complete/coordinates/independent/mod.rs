//! Equations that fall apart: parts of which every zero goes with every zero of the others.
//!
//! Holes of a plate, each at distances from two fixed corners, have nothing to do with each other: n of them have 2ⁿ places, of which each hole has two. Nor have points of a row,
//! each of which is measured from the one before: equations are about differences of entries, and what one of them says of its differences is the same
//! wherever the others are.
//!
//! Blocks with one zero alone come first, the *base*: its unknowns are numbers in what follows. All others are nodes of a graph, with one for the number 0 and
//! the base; each difference in an equation is an edge. In a spanning tree of it each difference is a sum of differences along tree edges, so that tree edges are unknowns
//! as good as the nodes. Tree edges that meet in an equation, or in a condition on figures, are of one part; then the parts are systems beside each other, and figures are all
//! combinations of their zeros. (The check's own words: `certificate/cover/coordinates/independent.rs`.)
//!
//! Each part is searched with all differences of the others as they are in one figure, the *reference*: blocks of the part as always, others moved along with what they hang on.

mod apart;
mod base;
mod combinations;
mod slices;

use super::{Cut, Figures, Judged, MOST_FIGURES, State};
use crate::certificate::cover::coordinates::{Case as ToldCase, Independent};
use crate::complete::{Choice, Why};
use crate::equations::Form;
use crate::interval::{Interval, ZERO};
use crate::places::Each as _;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::system::told::Told;
use crate::track::FigureBox;
use apart::Apart;
use slices::Sought;
use std::sync::atomic::Ordering;

/// The parts of an answer.
#[derive(Default)]
pub struct Parts {
    /// The unknowns of the base.
    pub base: Vec<usize>,
    /// What the equations fall apart into, for each zero of the base that figures have.
    pub cases: Vec<Case>,
    /// The reference of each case, and for each other zero of a part the figure that has it and is the reference otherwise.
    pub representatives: Vec<FigureBox>,
    /// The first combinations, or all if they are not too many, each in a box of its own.
    pub listed: Vec<FigureBox>,
    /// How many combinations there are; `None` where that has no place in 64 bits.
    pub count: Option<u64>,
    /// The unknowns of the blocks of the base that have several zeros.
    pub decided: Vec<usize>,
}

/// The parts beside one zero of the base.
pub struct Case {
    /// The reference, by its number among the representatives; it is in each of the parts.
    pub first: usize,
    /// Each with its equations and unknowns and its zeros.
    pub parts: Vec<One>,
}

/// One of the parts.
pub struct One {
    /// Its equations.
    pub equations: Vec<usize>,
    /// The unknowns that it places, beside what they hang on.
    pub unknowns: Vec<usize>,
    /// Its zeros but the reference's.
    pub figures: Vec<usize>,
}

impl Case {
    /// How many combinations there are; `None` where that has no place in 64 bits.
    pub fn count(&self) -> Option<u64> {
        let mut parts = self.parts.iter();
        parts.try_fold(1u64, |all, part| {
            all.checked_mul(part.figures.len() as u64 + 1)
        })
    }
}

impl Parts {
    /// The names of what some unknowns place.
    fn names(problem: &Problem, homotopy: &Homotopy, of: &[usize]) -> Vec<String> {
        let is_placed = |i: usize| of.contains(&i);
        let points = problem.points.iter().enumerate().filter(|(p, _)| {
            let mut axes = 0..homotopy.dimension;
            axes.any(|axis| homotopy.coordinate(*p, axis).is_some_and(is_placed))
        });
        let objects = problem.objects.iter().zip(&homotopy.tail.objects);
        let objects = objects.filter(|(_, entries)| {
            let mut entries = entries.iter().filter_map(|&entry| homotopy.entry(entry));
            entries.any(is_placed)
        });
        let points = points.map(|(_, point)| point.name.clone());
        points
            .chain(objects.map(|(object, _)| object.name.clone()))
            .collect()
    }

    /// The parts that have more than one zero: what they place, by name, and how many zeros they have. Where there are several cases, none.
    pub fn choices(&self, problem: &Problem, homotopy: &Homotopy) -> Vec<Choice> {
        let [case] = &self.cases[..] else {
            return Vec::new();
        };
        let choices = case.parts.iter().filter(|part| !part.figures.is_empty());
        let choices = choices.map(|part| Choice {
            names: Parts::names(problem, homotopy, &part.unknowns),
            count: part.figures.len() + 1,
        });
        choices.collect()
    }

    /// Where there are several cases: what is decided by them, by name, and how many there are.
    pub fn first_choice(&self, problem: &Problem, homotopy: &Homotopy) -> Option<Choice> {
        (self.cases.len() > 1).then(|| Choice {
            names: Parts::names(problem, homotopy, &self.decided),
            count: self.cases.len(),
        })
    }

    /// As a cover tells them.
    pub fn told(&self) -> Vec<ToldCase> {
        let cases = self.cases.iter().map(|case| {
            let parts = case.parts.iter().map(|part| Independent {
                equations: part.equations.clone(),
                figures: part.figures.clone(),
            });
            ToldCase {
                first: case.first,
                parts: parts.collect(),
            }
        });
        cases.collect()
    }
}

/// What came of one case.
enum Solved {
    /// Its reference first, and its parts, of which zeros are numbered among these.
    Figures(Vec<FigureBox>, Vec<One>),
    /// There is no figure.
    Nothing,
}

impl Figures<'_> {
    /// Finds the figures part by part, where the equations fall apart into two parts or more that have more than one zero, perhaps beside each of several zeros of a base. `None`: they do not, or that it is so could not be shown.
    pub(super) fn fall_apart(&mut self, x: &[Interval], pivots: &[usize]) -> Option<Parts> {
        let is_simple = self.homotopy.tail.twins.is_empty()
            && !self.homotopy.has_directions()
            && self.kept.is_none_or(|kept| kept.keep.is_all());
        if !is_simple || self.blocks.len() < 2 {
            return None;
        }
        let begin = State {
            x: x.to_vec(),
            told: Told::default(),
            chosen: Vec::new(),
        };
        let mut in_base: Vec<bool> = Vec::new();
        let mut state = begin.clone();
        for b in 0..self.blocks.len() {
            let is_next = self.blocks[b].needs.iter().all(|&need| in_base[need]);
            let found = is_next.then(|| self.solve(b, &state, 1.0));
            let found = found.filter(|found| found.zeros.len() == 1 && found.undecided.is_empty());
            in_base.push(found.is_some());
            if let Some(found) = found {
                self.take(b, (&found, 0), &mut state);
            }
        }
        let signed = self.held.iter().map(|held| held.unknown);
        let signed = signed.chain(self.homotopy.positive_unknowns());
        let m = self.system.unknowns;
        let signed = signed.chain(pivots.iter().copied()).map(|i| vec![[i, m]]);
        // Of a vector, what is not zero in all figures.
        let names = self.system.names();
        let vectors = self.homotopy.nonzero_vectors().into_iter();
        let vectors = vectors.map(|mut vector| {
            vector.retain(|ends| {
                let [a, b] = ends.each(|i| names[i.min(m)]);
                a != b
            });
            vector
        });
        let conditions: Vec<_> = vectors.chain(signed).collect();
        let apart = Apart::new(self, &in_base, conditions.clone())?;
        let before = self.undecided.clone();
        let others = self.others.len();
        let wider = self.wider_base((&in_base, &apart), &conditions, &begin);
        if let Some((in_base, apart, zeros)) = wider {
            let parts = self.of_cases(&apart, (&in_base, &zeros), &begin);
            if parts.is_some() {
                return parts;
            }
            self.undecided.clone_from(&before);
            self.others.truncate(others);
        }
        if apart.parts < 2 {
            return None;
        }
        let only = vec![vec![0; self.blocks.len()]];
        let parts = self.of_cases(&apart, (&in_base, &only), &begin);
        if parts.is_none() {
            self.undecided = before;
            self.others.truncate(others);
        }
        parts
    }

    /// The figures of all cases: of each of these zeros of the base.
    fn of_cases(
        &mut self,
        apart: &Apart,
        (in_base, zeros): (&[bool], &[Vec<usize>]),
        begin: &State,
    ) -> Option<Parts> {
        let is_only = zeros.len() == 1;
        let share = 1.0 / zeros.len() as f64;
        let mut representatives: Vec<FigureBox> = Vec::new();
        let mut cases = Vec::new();
        for zeros in zeros {
            if self.run.stop.load(Ordering::Relaxed) && !is_only {
                super::leave(&mut self.undecided, Why::Unfinished, 1, share);
                continue;
            }
            let solved = self.of_parts(apart, (zeros, is_only), (begin, share));
            let (mut figures, mut parts) = match solved {
                Some(Solved::Figures(figures, parts)) => (figures, parts),
                Some(Solved::Nothing) => continue,
                // What was found of other cases stays.
                None if self.run.stop.load(Ordering::Relaxed) && !is_only => {
                    super::leave(&mut self.undecided, Why::Unfinished, 1, share);
                    continue;
                }
                None => return None,
            };
            let first = representatives.len();
            representatives.append(&mut figures);
            if representatives.len() > MOST_FIGURES {
                return None;
            }
            for figure in parts.iter_mut().flat_map(|part| &mut part.figures) {
                *figure += first;
            }
            cases.push(Case { first, parts });
        }
        if cases.is_empty() {
            // No figure, as far as all is decided.
            return Some(Parts {
                count: Some(0),
                ..Parts::default()
            });
        }
        let mut counts = cases.iter();
        let count = counts.try_fold(0u64, |all, case| all.checked_add(case.count()?));
        let of_base = |b: &usize| in_base[*b];
        let base = (0..in_base.len()).filter(of_base);
        let decided = (0..in_base.len()).filter(of_base);
        let decided = decided.filter(|&b| zeros.iter().any(|other| other[b] != zeros[0][b]));
        let unknowns = |b: usize| self.blocks[b].unknowns.clone();
        let mut parts = Parts {
            base: base.flat_map(unknowns).collect(),
            decided: decided.flat_map(unknowns).collect(),
            cases,
            representatives,
            listed: Vec::new(),
            count,
        };
        if !self.are_different(&parts) {
            return None;
        }
        parts.listed = self.combinations(&parts)?;
        Some(parts)
    }

    /// The figures of each part, where the base's blocks have given zeros. `is_only`: the base has no others. `share`: of what is searched.
    fn of_parts(
        &mut self,
        apart: &Apart,
        (zeros, is_only): (&[usize], bool),
        (begin, share): (&State, f64),
    ) -> Option<Solved> {
        let (mut zeros, mut steps) = (zeros.to_vec(), 0);
        let mut is_passed = false;
        let (reference, first) = loop {
            match self.reference(apart, &mut zeros, &mut steps, (begin, 0.0)) {
                Sought::Unknown => return None,
                // Zeros that are no figures were passed over.
                Sought::Nothing(_) if is_passed => return None,
                Sought::Nothing(part) => {
                    // Then there is no figure.
                    self.leave_of(apart, part);
                    return Some(Solved::Nothing);
                }
                Sought::Found(state, at) => {
                    let branching = self.branching(apart, &state);
                    if is_only && branching < 2 {
                        return None;
                    }
                    zeros = at;
                    match self.judge(&state.x) {
                        Judged::Figure(figure) => break (state, *figure),
                        Judged::Undecided(_) => return None,
                        Judged::Other(_) => {
                            // The next one of the part in which a vector vanishes.
                            let is_bad = |(condition, _): &&(Vec<[usize; 2]>, usize)| {
                                let m = self.system.unknowns;
                                let x = |i: usize| if i < m { state.x[i] } else { ZERO };
                                condition.iter().all(|&[i, j]| (x(i) - x(j)).contains(0.0))
                            };
                            let part = apart.conditions.iter().find(is_bad)?.1;
                            let last = (0..zeros.len()).rfind(|&b| apart.part[b] == Some(part))?;
                            zeros[last] += 1;
                            is_passed = true;
                        }
                    }
                }
            }
        };
        let mut representatives = vec![first];
        let mut parts: Vec<One> = Vec::new();
        for k in 0..apart.parts {
            let mut found = Vec::new();
            let at = (&*reference, &*zeros);
            self.slice((apart, k), at, (0, begin.clone()), share, &mut found);
            let mut figures: Vec<usize> = Vec::new();
            let mut is_first = false;
            for (state, share) in found {
                let mut chosen = state.chosen.iter();
                if chosen.all(|&(b, zero)| zeros[b] == zero) {
                    // The reference, again.
                    is_first = true;
                    continue;
                }
                if self.run.stop.load(Ordering::Relaxed) {
                    super::leave(&mut self.undecided, Why::Unfinished, 1, share);
                    continue;
                }
                match self.judge(&state.x) {
                    Judged::Figure(figure) => {
                        figures.push(representatives.len());
                        representatives.push(*figure);
                    }
                    Judged::Other(exact) => self.others.extend(exact),
                    Judged::Undecided(why) => super::leave(&mut self.undecided, why, 1, share),
                }
            }
            // It is one of them, wherever the search was not ended before.
            if !is_first && !self.run.stop.load(Ordering::Relaxed) {
                return None;
            }
            let blocks = self.blocks.iter().zip(&apart.part);
            let own = blocks
                .filter(|(_, part)| **part == Some(k))
                .map(|(block, _)| block);
            let own: Vec<&Cut> = own.collect();
            let one = One {
                equations: own
                    .iter()
                    .flat_map(|block| block.equations.clone())
                    .collect(),
                unknowns: own
                    .iter()
                    .flat_map(|block| block.unknowns.clone())
                    .collect(),
                figures,
            };
            // Those with one zero are one part.
            match parts.iter_mut().find(|known| known.figures.is_empty()) {
                Some(known) if one.figures.is_empty() => {
                    known.equations.extend(one.equations);
                    known.unknowns.extend(one.unknowns);
                }
                _ => parts.push(one),
            }
        }
        Some(Solved::Figures(representatives, parts))
    }
}

/// The ends of the differences in an equation; the number behind that of t is 0.
fn forms(homotopy: &Homotopy, e: usize) -> Vec<[usize; 2]> {
    let zero = homotopy.equations + 1;
    let forms = homotopy.terms(e).into_iter().flat_map(|term| term.forms());
    let ends = forms.filter_map(|form| match form.map(|i| i.unwrap_or(zero)) {
        Form::Difference(a, b) => Some([a, b]),
        Form::One => None,
    });
    ends.collect()
}
