//! Changes a dimension of a plate and keeps the figure, with proof; then asks for more than can be had.
//!
//! ```sh
//! cargo run --release --example edit_a_plate
//! ```

use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plate = Problem::read("docs/examples/plate.toml")?;
    // Corrects the drawing first, if it does not meet its own dimensions exactly.
    let mut session = Session::open(&plate)?;

    for length in ["45", "40", "120"] {
        let setting = Setting::named(session.problem(), "C-D", length)?;
        let edited = session.edit(&[setting]);
        match &edited.ending {
            Ending::Reached => {
                println!("C-D = {length}: the one and only continuation of the figure, proved");
                for (point, place) in plate.points.iter().zip(session.points()) {
                    println!(
                        "  {}  x in [{}, {}]",
                        point.name,
                        place[0].inf(),
                        place[0].sup()
                    );
                }
            }
            // The session's figure stays what it was.
            Ending::Limit(_) => {
                let reached = edited.dimensions[0].value;
                println!(
                    "C-D = {length} cannot be reached: it can go to between {} and {}, and no further",
                    reached.inf(),
                    reached.sup()
                );
            }
            other => println!("C-D = {length}: {other:?}"),
        }
    }
    Ok(())
}
