//! Remarks as people read them.

use super::Remark;
use super::target::length_in_words;
use crate::blocks::list_of;
use crate::places::Each as _;
use crate::problem::{Problem, either};

/// A remark as a sentence without its end, with the names of points.
pub fn in_words(problem: &Problem, remark: &Remark) -> String {
    let name = |p: usize| problem.points[p].name.as_str();
    let list = |points: &[usize]| {
        let names = points.iter().map(|&p| problem.points[p].name.clone());
        list_of(&names.collect::<Vec<_>>(), 8)
    };
    let (line, triangle) = match problem.dimension {
        2 => ("on one line", "line"),
        _ => ("in one plane", "plane"),
    };
    match remark {
        Remark::TooLong {
            distance,
            way,
            length,
        } => {
            let way: Vec<&str> = way.iter().map(|&p| name(p)).collect();
            let shown = format!("{length:.9e}").parse::<f64>().unwrap_or(*length);
            format!(
                "no figure has these target lengths: {} is {}, and {} is only {shown} long",
                problem.distance_name(*distance),
                length_in_words(problem, *distance),
                way.join("-")
            )
        }
        Remark::NoTetrahedron(points) => format!(
            "no figure has these target lengths: there is no tetrahedron {} with them",
            list(points)
        ),
        Remark::LineInTarget(points) => format!(
            "with these target lengths {} are on one line, {} between the others: figures that meet them are \
             singular, and proofs end there; a length changed a little, or {} left out, makes them regular",
            list(points),
            name(points[1]),
            name(points[1])
        ),
        Remark::PlaneInTarget(points) => format!(
            "with these target lengths {} are in one plane: figures that meet them are singular, and proofs end \
             there; a length changed a little makes them regular",
            list(points)
        ),
        Remark::Loose { point, joined } => format!(
            "in the sketch {} is {line} with all points that it is joined to ({}), so that it can leave the \
             {triangle} for an instant: the sketch is singular, and a run may not set out from it; move {0} a little",
            name(*point),
            list(joined)
        ),
        Remark::FlatInSketch(points) => format!(
            "in the sketch {} are {}: the sketch is singular, and a run may not set out from it; move one of \
             them a little",
            list(points),
            if points.len() == 3 {
                "on one line"
            } else {
                "in one plane"
            }
        ),
        Remark::FlatPart { points, distances } => {
            let (flat, most) = match problem.dimension {
                2 => ("on a line", points.len() - 1),
                _ => ("in a plane", 2 * points.len() - 3),
            };
            let (who, advice) = match points.len() == problem.points.len() {
                true => (
                    "all points".to_owned(),
                    format!("move some of them out of the {triangle}"),
                ),
                false => (
                    list(points),
                    "if they are one rigid part of a shape that is known, write it as a body ([bodies]) in place of these \
                     distances; otherwise move one of them a little"
                        .to_owned(),
                ),
            };
            format!(
                "in the sketch {who} are {line}, with {distances} distances among them, of which no more than {most} are \
                 independent {flat}: the sketch is singular, and a run may not set out from it; {advice}"
            )
        }
        Remark::FlatSketch {
            conditions,
            heights,
        } => {
            let comes = match conditions == heights {
                true => {
                    "so the path stays in that plane, and all figures on it are flat; if figures in space are wanted, move \
                     points of the sketch out of the plane"
                }
                false => {
                    "the sketch is singular, and a run may not set out from it; move points of it out of the plane"
                }
            };
            format!(
                "in the sketch all points are in one plane, where the conditions that tell its two sides apart, such as \
                 coplanarities, hold whatever the figure is: {comes}"
            )
        }
        Remark::Twins { side, corners } => {
            let [a, b] = side.each(name);
            let [c, d] = corners.each(name);
            format!(
                "the triangles {a} {b} {c} and {a} {b} {d} have the same sides all along the path: where one comes \
                 to be on a line the other does too, branches meet, and a proof ends there; one point of the sketch \
                 moved a little keeps them apart"
            )
        }
        Remark::Redundant(names) => format!(
            "wherever they are met, any of {} follows from the others, as far as floats tell: figures that meet them are \
             singular, proofs end there, and something can still move; remove one of them and give another dimension",
            crate::problem::list(names, 8)
        ),
        Remark::Mirrored { part, hinge } => format!(
            "{} {} joined to the rest through {} only, and can be mirrored in their {}: every figure has another \
             one with the same dimensions",
            list(part),
            either(part.len(), "is", "are"),
            list(hinge),
            triangle
        ),
    }
}
