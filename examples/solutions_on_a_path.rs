//! The path through a sketch with progress, a time limit and a proof on disk, and its figures brought back to where
//! the sketch is drawn.
//!
//! ```sh
//! cargo run --release --example solutions_on_a_path -- problems/octahedron.toml
//! ```

use krawl::problem::Problem;
use krawl::system::Placement;
use krawl::track::{Control, Options, Progress, Status, solve_in_best_space};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1);
    let problem = Problem::read(file.as_deref().unwrap_or("problems/octahedron.toml"))?;

    // Any thread may set this to end the run; what is proved by then is kept.
    let cancel = AtomicBool::new(false);
    let begin = Instant::now();
    let mut progress = |now: Progress| {
        eprintln!(
            "{} steps, t = {:.3}, {} solutions",
            now.steps, now.t, now.solutions
        );
        if begin.elapsed() > Duration::from_secs(60) {
            cancel.store(true, Ordering::Relaxed);
        }
    };
    let mut control = Control {
        cancel: Some(&cancel),
        progress: Some(&mut progress),
        ..Control::default()
    };
    let outcome = solve_in_best_space(&problem, &Options::certified(), &mut control)?;

    match &outcome.status {
        Status::Closed => println!(
            "{} solutions on the path, none missing: proved",
            outcome.solutions.len()
        ),
        Status::Open(_) => println!(
            "{} solutions on the arc between its ends",
            outcome.solutions.len()
        ),
        Status::Stopped(reason) => println!("stopped: {reason}"),
    }
    let motion = Placement::of(&problem)?.motion();
    for solution in &outcome.solutions {
        let folds = solution.place.and_then(|place| place.folds);
        println!("a figure, {folds:?} folds away from the sketch:");
        for (point, place) in problem.points.iter().zip(solution.figure()) {
            let p = motion * place;
            println!("  {:<4} {:12.8} {:12.8} {:12.8}", point.name, p.x, p.y, p.z);
        }
    }
    Ok(())
}
