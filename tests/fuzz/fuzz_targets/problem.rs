//! Any text: an error or a problem that checks and reads back, and never a panic.
#![no_main]

use krawl::problem::Problem;
use krawl::track::{Control, Options, Space, solve};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(problem) = Problem::parse(text, "fuzzed.toml") else {
        return;
    };
    problem.check().expect("what was read is in order");
    assert_eq!(Problem::parse(&problem.to_toml(), "again.toml").unwrap(), problem);
    if problem.points.len() > 12 {
        return;
    }
    for options in [
        Options::certified(),
        Options::float(Space::Full),
        Options::float(Space::Reduced),
    ] {
        let options = Options {
            max_steps: 50,
            ..options
        };
        let _ = solve(&problem, &options, &mut Control::default());
    }
});
