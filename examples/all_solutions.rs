//! All real and all complex solutions of a system of equations, proved.
//!
//! ```sh
//! cargo run --release --example all_solutions
//! ```

use krawl::algebra::System;

fn main() -> Result<(), String> {
    let system = System::parse("x^2 + y^2 + z^2 = 3; x*y*z = 1; x + y + 2*z = 4")?;
    let real = system.real()?;
    println!("{}", real.verdict);
    for solution in &real.solutions {
        for (name, x) in solution {
            println!("  {name} between {} and {}", x.inf(), x.sup());
        }
    }
    let complex = system.complex()?;
    println!("{}", complex.verdict);
    println!("{} complex solutions", complex.solutions.len());
    Ok(())
}
