//! Hard cases.

mod common;

use common::boxes::check;
use common::hard::{Answer, FAMILIES};
use common::{FLOAT_SPACES, solve};
use krawl::track::{Options, Status};

#[test]
#[ignore = "prints the table of docs/hard.md"]
fn table() {
    for family in FAMILIES {
        if let Ok(only) = std::env::var("FAMILY") && !family.name.contains(&only) { continue; }
        println!("## {} ({})", family.name, family.parameter);
        for k in family.range.clone() {
            if let Ok(only) = std::env::var("K") && only != k.to_string() { continue; }
            let problem = (family.make)(k); let answer = if std::env::var("FAST").is_ok() { Answer::Unknown } else { (family.answer)(&problem) };
            let options = Options { max_steps: 100_000, ..Options::certified() };
            let outcome = solve(&problem, &options);
            let sound = check(&problem, &outcome.solutions);
            let float = FLOAT_SPACES.map(|space| {
                let o = solve(&problem, &Options { max_steps: 100_000, ..Options::float(space) });
                (o.status == Status::Closed, o.solutions.len(), o.steps)
            });
            println!("1e-{k}: {answer:?}; certified {:?} {} in {} + {} tubes, {:.1} ms {:?}{}; float {float:?}",
               outcome.status, outcome.solutions.len(), outcome.steps, outcome.rejected, outcome.seconds * 1e3, outcome.switched_on,
               sound.err().map(|e| format!(" CHECK {e}")).unwrap_or_default());
        }
    }
}
