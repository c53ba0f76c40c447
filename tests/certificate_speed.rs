//! How long a check takes beside the run. Not part of the test command:
//! `cargo test --release --test certificate_speed -- --ignored --nocapture`

mod common;

use krawl::certificate::{Outcome, Settings, verify};
use krawl::track::Options;
use std::time::Instant;

#[test]
#[ignore = "measures"]
fn check_beside_run() {
    for name in common::certificate::SHIPPED {
        let problem = common::shipped(name);
        let bytes = common::certificate::shipped(name);
        let best = |work: &dyn Fn()| {
            let times = (0..15).map(|_| {
                let clock = Instant::now();
                work();
                clock.elapsed().as_secs_f64()
            });
            1e3 * times.fold(f64::INFINITY, f64::min)
        };
        let run = best(&|| {
            common::solve(&problem, &Options::certified());
        });
        let check = best(&|| {
            let verdict = verify(&bytes[..], &Settings { threads: 1 }, &mut |_| ()).unwrap();
            assert_eq!(verdict.outcome, Outcome::Verified);
        });
        println!(
            "{name}: run {run:.2} ms, check {check:.2} ms, {:.1} times",
            check / run
        );
    }
}
