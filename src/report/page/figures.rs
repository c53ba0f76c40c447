//! The pages of verbs without a path to travel: complete sets and edits.

use super::{Figure, Page, Text, Tone};
use crate::complete::{Complete, Status};
use crate::edit::{Edited, Ending};
use crate::interval::Interval;
use crate::problem::Problem;
use crate::report::{Run, certain_digits, complete_to_table, edit_in_words};
use crate::track::{self, Mode, Options, Outcome, Space};

impl Page {
    /// The sketch of a problem, with its bars, and nothing else yet.
    pub fn of_sketch(problem: &Problem) -> Page {
        // A run that has not begun has the same sketch and bars.
        let outcome = Outcome {
            mode: Mode::Certified,
            space: Space::Full,
            status: track::Status::Stopped(String::new()),
            solutions: Vec::new(),
            steps: 0,
            rejected: 0,
            plan_changes: 0,
            driving: Default::default(),
            length: 0.0,
            t_range: (0.0, 0.0),
            seconds: 0.0,
            switched_on: Vec::new(),
        };
        let run = Run {
            problem,
            options: &Options::certified(),
            outcome: &outcome,
            trace: None,
            samples: 0,
        };
        let page = Page::from_result(&run.to_value());
        let mut page = page.expect("what is written can be read");
        page.rows.clear();
        page.text.clear();
        page
    }

    /// The page of a complete set: every figure in the place of the sketch's reference points, or, where the
    /// search had others, in the search's own.
    pub fn of_complete(problem: &Problem, result: &Complete) -> Page {
        let mut page = Page::of_sketch(problem);
        let placement = crate::system::Homotopy::new(problem)
            .and_then(|homotopy| homotopy.gauge.placement(problem))
            .ok()
            .filter(|_| problem.homotopy.reference == result.reference);
        for (k, solution) in result.solutions.iter().enumerate() {
            let there = |p: &[Interval; 3]| match &placement {
                Some(placement) => placement.to_problem_nearly(&p.map(|x| x.mid())),
                None => p.map(|x| x.mid()),
            };
            page.figures.push(Figure {
                name: format!("Solution {}", k + 1),
                note: format!("known up to {:.0e} of its size", solution.width),
                kind: "solution",
                class: Some(k),
                at: None,
                t: None,
                folds: None,
                points: solution.points.iter().flat_map(there).collect(),
                outlines: Vec::new(),
                digits: Some(digits(problem, &solution.points)),
            });
        }
        page.figures[0].note = "not a solution: drawn for comparison".into();
        (page.badge, page.tone) = match result.status {
            Status::Complete => ("proved · all there are".into(), Tone::Proved),
            Status::Partial | Status::Flexible => ("proved in part".into(), Tone::Stopped),
        };
        let table = complete_to_table(problem, result);
        let first = table.lines().next().unwrap_or("");
        page.verdict = first
            .trim_start_matches(&format!("{}: ", problem.name))
            .to_owned();
        page.text = vec![Text::Paragraph(
            "All figures with these dimensions were searched, wherever the sketch is: the parameters of a \
             construction plan were divided into boxes, and in each box that is not listed here it is proved that \
             there is no solution. Figures that can be moved or mirrored into one another are listed once."
                .into(),
        )];
        page.rows = vec![
            ("driving parameters".into(), result.driving.to_string()),
            ("boxes".into(), result.boxes.to_string()),
            ("seconds".into(), format!("{:.4}", result.seconds)),
        ];
        page.digits =
            "Every coordinate differs from the exact one by at most 1 in its last digit shown."
                .into();
        page
    }

    /// The page of an edit: the figure before and after.
    pub fn of_edit(problem: &Problem, edited: &Edited) -> Page {
        let mut page = Page::of_sketch(problem);
        page.figures[0].name = "Before".into();
        page.figures[0].note = "the figure in the file".into();
        let (name, badge, tone) = match edited.ending {
            Ending::Reached => ("After", "proved", Tone::Proved),
            Ending::Limit(_) => ("At the limit", "limit, proved", Tone::Proved),
            Ending::Passes(_) | Ending::Stopped(_) => ("", "stopped", Tone::Stopped),
        };
        (page.badge, page.tone) = (badge.into(), tone);
        page.verdict = edit_in_words(problem, edited);
        for dimension in &edited.dimensions {
            // Other dimensions than distances have no bar to stand on.
            let distance = problem.distances.get(dimension.index);
            let ends = distance.map(|distance| distance.points);
            for bar in page.bars.iter_mut().filter(|bar| Some(bar.ends) == ends) {
                bar.target = Some(dimension.value.mid());
                bar.label = certain_digits(dimension.value).chars().take(8).collect();
            }
        }
        if !name.is_empty() {
            page.figures.push(Figure {
                name: name.into(),
                note: "the one and only continuation".into(),
                kind: "solution",
                class: Some(0),
                at: None,
                t: None,
                folds: None,
                points: edited.points.iter().flatten().map(|x| x.mid()).collect(),
                outlines: Vec::new(),
                digits: Some(digits(problem, &edited.points)),
            });
        }
        page.text = vec![Text::Paragraph(
            match edited.ending {
                Ending::Reached => {
                    "The dimensions were led from the old values to the new ones together, with proof: all the way there is \
                     exactly one figure that continues the old one, and none of them is singular. So it cannot have \
                     flipped into another figure with the same dimensions."
                }
                Ending::Limit(_) => {
                    "The dimensions were led towards the new values, with proof: up to the figure shown there is exactly \
                     one that continues the old one, and beyond it there is none. There it can move for an instant with \
                     all its dimensions as they are."
                }
                Ending::Passes(_) | Ending::Stopped(_) => {
                    "The new values were not reached, so the figure stays what it was. What is said above is as far as \
                     the proof got."
                }
            }
            .to_owned(),
        )];
        let count = |n: usize, what: &str| (what.to_owned(), n.to_string());
        page.rows = vec![
            count(edited.orientations.kept.len(), "orientations kept, proved"),
            count(edited.orientations.lost.len(), "not proved to be kept"),
            count(edited.tubes, "tubes"),
            ("seconds".into(), format!("{:.6}", edited.seconds)),
        ];
        page.digits = "In the coordinates of the file. Every coordinate differs from the exact one by at most 1 \
                       in its last digit shown."
            .into();
        page
    }
}

pub(super) fn digits(problem: &Problem, points: &[[Interval; 3]]) -> Vec<Vec<String>> {
    let shown = |p: &[Interval; 3]| {
        let place = p.iter().take(problem.dimension);
        place.map(|&x| certain_digits(x)).collect()
    };
    points.iter().map(shown).collect()
}
