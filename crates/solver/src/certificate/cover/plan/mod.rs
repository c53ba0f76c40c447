//! The check of covers of parameter spaces, which searches by a construction plan leave.
//!
//! A cover says of every part of the parameter space why it holds no figure but those listed. Here each reason is
//! proved again, by the constructions and models that the search has ([`construct`], [`crate::model`]), and one test of Krawczyk ([`Frame`]). Which parts there are follows from the marks alone, so
//! that they are read one after the other, and proved side by side.

pub mod construct;
mod figure;
mod format;
mod geometry;
mod pairs;
mod parts;
mod proof;

pub use format::{Cover, Kind, Left, MAX_SYMBOLS, Mark, Radius};

use super::{CoverError, CoverStage, CoverVerdict, ENDED};
use crate::problem::Problem;
pub use figure::{Figure, Frame, alone, alone_within};
pub use pairs::Pairs;

use geometry::Plan;
use parts::{Part, Parts};
use proof::Proof;
use rayon::prelude::*;

/// Parts that are read before they are proved.
const BATCH: usize = 4096;

/// For each step of a cover's plan the distances that close as its point stands. `None`: it is no plan of this problem by which every
/// figure is met.
pub fn closing(problem: &Problem, cover: &Cover) -> Option<Vec<Vec<usize>>> {
    Some(Plan::new(problem, cover).ok()?.closing)
}

/// Checks a cover.
pub fn verify(
    bytes: &[u8],
    goes_on: &mut dyn FnMut(CoverStage) -> bool,
) -> Result<CoverVerdict, CoverError> {
    let (cover, marks) = Cover::read(bytes)?;
    let mut verdict = CoverVerdict::about(&cover.problem, cover.figures.len())?;
    verdict.flaw = check((&cover, marks), &mut verdict, goes_on).err();
    Ok(verdict)
}

fn check(
    (cover, marks): (&Cover, &[u8]),
    verdict: &mut CoverVerdict,
    goes_on: &mut dyn FnMut(CoverStage) -> bool,
) -> Result<(), String> {
    if !verdict.problem.is_distances_only() {
        return Err("the problem has other constraints than distances".to_owned());
    }
    let plan = Plan::new(&verdict.problem, cover)?;
    let figures = figures(&plan)?;
    let proof = Proof::new(&plan, &figures);
    let mut parts = Parts::new(&plan, marks);
    loop {
        let batch: Vec<_> = parts.by_ref().take(BATCH).collect();
        let flaw = |part: &Result<Part, String>| match part {
            Ok(part) => proof.of(part).err(),
            Err(what) => Some(what.clone()),
        };
        let flaws = batch.par_iter().enumerate();
        let first = flaws.find_map_first(|(k, part)| Some((k, flaw(part)?)));
        if let Some((k, what)) = first {
            return Err(format!("part {}: {what}", verdict.parts + k as u64 + 1));
        }
        verdict.parts += batch.len() as u64;
        if batch.is_empty() {
            break;
        }
        if !goes_on(CoverStage::new(verdict.parts, parts.at, marks)) {
            return Err(ENDED.to_owned());
        }
    }
    verdict.undecided = parts.undecided;
    match parts.at == marks.len() {
        true => Ok(()),
        false => Err("there are more marks than parts".to_owned()),
    }
}

/// The figures that are listed, each proved to exist, no two the same up to a reflection.
fn figures(plan: &Plan) -> Result<Vec<Figure>, String> {
    let size = (plan.dimension, plan.points);
    let frame = Frame::new(size, &plan.edges, &plan.squares, &plan.cover.base);
    let mut figures: Vec<Figure> = Vec::new();
    for (index, centre) in plan.cover.figures.iter().enumerate() {
        let figure = frame
            .prove(centre)
            .ok_or_else(|| format!("solution {} is not proved to exist", index + 1))?;
        let image = figure.mirrored(plan.dimension);
        let apart = |known: &Figure| known.is_apart(&figure) && known.is_apart(&image);
        if let Some(same) = figures.iter().position(|known| !apart(known)) {
            return Err(format!(
                "the solutions {} and {} may be the same",
                same + 1,
                index + 1
            ));
        }
        figures.push(figure);
    }
    Ok(figures)
}
