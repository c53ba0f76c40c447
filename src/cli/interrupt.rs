//! Ctrl-C: once to stop cleanly, twice to stop at once.

use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// The shells' exit code for a program that an interrupt ended: 128 and the signal's number.
const INTERRUPTED: i32 = 130;

/// The flag that the first Ctrl-C (or termination signal) sets. The second ends the program.
pub fn flag() -> &'static AtomicBool {
    // Where no handler can be set, Ctrl-C ends the program the usual way.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    &REQUESTED
}
