//! What people and programs get to see of a run.

mod blocks;
mod columns;
mod comparison;
mod complete;
mod complex;
mod conformers;
mod digits;
pub mod document;
mod edit;
#[cfg(feature = "explore")]
mod explore;
mod figures;
mod followed;
mod marks;
mod measured;
mod motion;
pub mod page;
#[cfg(feature = "cli")]
pub mod picture;
#[cfg(feature = "cli")]
mod progress;
mod run;
mod supposed;
mod sweep;
mod table;
mod theorem;
mod tolerance;

#[cfg(feature = "cli")]
pub(crate) use document::names;

#[doc(inline)]
pub use crate::interval::certain_digits;
pub use blocks::BlockRuns;
#[cfg(feature = "cli")]
pub use comparison::comparisons_to_csv;
pub use comparison::{Compared, comparison_to_table, comparisons_to_json};
pub use complete::{
    among_in_words, complete_in_words, complete_to_table, cover_theorem, made_in_words,
};
pub use complex::{
    complex_in_words, complex_set_theorem, complex_to_json, complex_to_table, named_numbers,
};
pub use conformers::{conformers_to_table, conformers_told};
pub use digits::digits_to_table;
pub use document::{Document, JSON_VERSION};
pub use edit::{
    account_in_words, alone_in_words, decomposition_in_words, edit_in_words, edit_to_table,
    freedom_of_sketch_in_words, limit_in_words,
};
#[cfg(feature = "explore")]
pub use explore::{AllReal, Explored, TracedPath, explore_to_table};
pub use figures::{Listed, figures_in_words, figures_to_summary, figures_to_table, first_in_words};
pub use followed::{followed_to_table, warnings_in_words};
pub use measured::{Measures, Placed};
pub use motion::{motion_in_words, motion_to_csv, motion_to_table};
#[cfg(feature = "cli")]
pub use progress::ProgressLine;
pub use run::Run;
pub use supposed::{signs_not_looked_at, signs_of_figure};
pub use sweep::{frames_to_csv, ranges_to_table, sweep_in_words, sweep_to_csv};
pub use table::{
    part_in_words, signed_in_words, to_first_table, to_no_first, to_short_table, to_summary,
    to_table,
};
pub use theorem::theorem;
pub use tolerance::{
    tolerance_set_in_words, tolerance_set_to_table, tolerances_in_words, tolerances_to_csv,
    tolerances_to_table,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::{Interval, hull, point};
    use crate::problem::Problem;
    use crate::track::{Mode, Options, Outcome, Solution, Space, Status, Stop, StopKind};
    use serde_json::Value;

    fn triangle() -> Problem {
        Problem::build("triangle", 2)
            .point("a", ["0", "0"])
            .point("b", ["1", "0"])
            .point("apex", ["0.4", "1.1"])
            .distance("a", "b", "1")
            .distance("b", "apex", "1.12")
            .distance("apex", "a", "1.3")
            .finish()
            .unwrap()
    }

    fn outcome(mode: Mode, status: Status) -> Outcome {
        let zero = point(0.0);
        let third = hull(1.0 / 3.0, (1.0f64 / 3.0).next_up());
        let solution = |y: Interval, class| Solution {
            width: 1.2e-16,
            ..Solution::placed(
                vec![[zero; 3], [point(1.0), zero, zero], [third, y, zero]],
                class,
            )
        };
        Outcome {
            solutions: vec![solution(hull(1.25, 1.2500001), 0), solution(-third, 1)],
            steps: 458,
            rejected: 3,
            length: 12.5,
            t_range: (-0.25, 1.0 + f64::EPSILON),
            seconds: 0.0029,
            switched_on: vec!["something".into()],
            ..Outcome::new(mode, Space::Full, status)
        }
    }

    fn to_json(problem: &Problem, outcome: &Outcome) -> String {
        let options = Options::certified();
        let written = Document::solve(&Run::new(problem, &options, outcome));
        let read: Document = serde_json::from_str(&written.to_json()).unwrap();
        let value = |document: &Document| serde_json::to_value(document).unwrap();
        assert_eq!(value(&read), value(&written));
        written.to_json()
    }

    #[test]
    fn numbers_in_json_round_trip() {
        let outcome = outcome(
            Mode::Certified,
            Status::Stopped(Stop::new(StopKind::NoStep, "too hard")),
        );
        let json: Value = serde_json::from_str(&to_json(&triangle(), &outcome)).unwrap();
        assert_eq!(json["version"], JSON_VERSION);
        assert_eq!(json["constraints"][1]["value"], "1.12");
        let c = triangle().homotopy.bend_coefficient.to_string();
        assert_eq!(json["options"]["bend_coefficient"], c);
        assert_eq!(json["sketch"]["apex"][1], 1.1);
        assert_eq!(json["problem"], "triangle");
        assert_eq!(
            (&json["mode"], &json["space"]),
            (&"certified".into(), &"full".into())
        );
        assert_eq!(
            (&json["status"], &json["reason"]),
            (&"stopped".into(), &"too hard".into())
        );
        assert_eq!(json["stopped_kind"], "no_step");
        assert_eq!(json["t_range"][1].as_f64(), Some(1.0 + f64::EPSILON));
        let apex = &json["solutions"][0]["points"]["apex"];
        assert_eq!(apex.as_array().unwrap().len(), 2);
        assert_eq!(apex[0][0].as_f64(), Some(1.0 / 3.0));
        assert_eq!(apex[0][1].as_f64(), Some((1.0f64 / 3.0).next_up()));
        assert_eq!(json["solutions"][1]["class"], 1);
        assert_eq!(json["driving"]["max"], 0);
    }

    #[test]
    fn json_lists_points_in_the_problems_order_and_holds_no_infinity() {
        let mut outcome = outcome(Mode::Float, Status::Closed);
        outcome.length = f64::INFINITY;
        let text = to_json(&triangle(), &outcome);
        let (_, solutions) = text.split_once("\"solutions\":").unwrap();
        let at = |name: &str| solutions.find(name).unwrap();
        assert!(at("\"a\"") < at("\"b\"") && at("\"b\"") < at("\"apex\""));
        assert!(!text.to_ascii_lowercase().contains("inf") && text.contains("\"length\":null"));
        assert!(
            text.contains("\"reason\":null,\"stopped_kind\":null")
                && text.contains("\"mode\":\"float\"")
        );
    }

    #[test]
    fn tables_claim_what_was_proved() {
        let closed = to_table(&triangle(), &outcome(Mode::Certified, Status::Closed), None);
        assert!(closed.starts_with(
            "triangle: Closed, proved: the 2 solutions listed are exactly the points of the path \
             through the sketch with t = 1. No two of them are congruent, even up to reflection.\n"
        ));
        assert!(
            closed.contains("\n  apex  0.3333333333333334  1.2500001\n"),
            "{closed}"
        );
        assert!(closed.contains("steps               458\n"));
        let observed = to_table(&triangle(), &outcome(Mode::Float, Status::Closed), None);
        assert!(observed.contains("Closed, observed") && observed.contains("not a proof"));
        assert!(!observed.contains("proved"));
        for mode in [Mode::Certified, Mode::Float] {
            let stopped = to_table(
                &triangle(),
                &outcome(
                    mode,
                    Status::Stopped(Stop::new(StopKind::NoStep, "too hard.")),
                ),
                None,
            );
            assert!(stopped.contains("Stopped: too hard. "), "{stopped}");
            assert!(stopped.contains("there may be more"));
            assert!(!stopped.contains("exactly the"));
        }
    }
}
