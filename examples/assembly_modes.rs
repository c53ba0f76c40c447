//! All assembly modes of a planar platform, and the proof that there is no other: the mobile triangle of the
//! prism hangs on the base by three bars.
//!
//! ```sh
//! cargo run --release --example assembly_modes
//! ```

use krawl::complete::{Options, Status, all};
use krawl::problem::Problem;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let platform = Problem::read("problems/prism.toml")?;
    let modes = all(&platform, &Options::default())?;
    match modes.status {
        Status::Complete => println!(
            "{} assembly modes up to reflection, and there is no other: proved in {:.1} ms",
            modes.solutions.len(),
            modes.seconds * 1e3
        ),
        Status::Partial => println!(
            "{} are proved, and parts are undecided",
            modes.solutions.len()
        ),
        Status::Flexible => println!("the platform can move"),
    }
    for (k, mode) in modes.solutions.iter().enumerate() {
        // Points of nalgebra's, the middles of boxes that hold one figure each.
        let figure = mode.figure();
        let middle = figure
            .iter()
            .fold(krawl::nalgebra::Vector3::zeros(), |sum, p| sum + p.coords)
            / figure.len() as f64;
        println!(
            "  {k}: centroid ({:.6}, {:.6}), boxes of relative width {:.0e}",
            middle.x, middle.y, mode.width
        );
    }
    Ok(())
}
