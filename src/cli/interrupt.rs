//! Ctrl-C: once to stop cleanly, twice to stop at once; and `--time`, which is as Ctrl-C after so many seconds.

use super::output::Certificate;
use krawl::report::ProgressLine;
use krawl::track::{Control, Progress, Witness};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

static REQUESTED: AtomicBool = AtomicBool::new(false);
/// Of verbs that another program runs within itself, the number of the one that runs.
static RUN: AtomicU64 = AtomicU64::new(0);

/// The shells' exit code for a program that an interrupt ended: 128 and the signal's number.
const INTERRUPTED: i32 = 130;

/// The flag that the first Ctrl-C (or termination signal) sets. The second ends the program.
pub fn flag() -> &'static AtomicBool {
    // Another program has its own way.
    if RUN.load(Ordering::Relaxed) > 0 {
        return &REQUESTED;
    }
    // Where no handler can be set, Ctrl-C ends the program the usual way.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    &REQUESTED
}

/// A verb begins that another program runs within itself.
pub fn begin() {
    RUN.fetch_add(1, Ordering::Relaxed);
    REQUESTED.store(false, Ordering::Relaxed);
}

/// Asks for the end of what runs.
pub fn request() {
    REQUESTED.store(true, Ordering::Relaxed);
}

/// Whether the end of what runs was asked for.
pub fn is_requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// A run that the first Ctrl-C stops.
pub fn control<'a>() -> Control<'a> {
    Control {
        cancel: Some(flag()),
        ..Control::default()
    }
}

/// The same of one that writes a certificate, if there is one.
pub fn witnessed<'a>(certificate: Option<&'a mut Certificate>) -> Control<'a> {
    Control {
        witness: certificate.map(|writer| writer as &mut dyn Witness),
        ..control()
    }
}

/// Runs something that the first Ctrl-C stops, and shows where it is if that is `wanted`; `what` says what is at work.
pub fn shown<T>(wanted: bool, what: &str, run: impl FnOnce(&mut Control) -> T) -> T {
    let line = ProgressLine::new(wanted, what);
    let mut show = |now: Progress| line.show(now);
    let done = run(&mut Control {
        progress: Some(&mut show),
        ..control()
    });
    line.clear();
    done
}

/// When so many seconds are over.
pub fn deadline(seconds: Option<f64>) -> Option<Instant> {
    seconds.map(|s| Instant::now() + Duration::from_secs_f64(s))
}

/// How long a verb may take.
#[derive(clap::Args)]
pub struct Time {
    /// End after so many seconds, and keep what was found
    ///
    /// As Ctrl-C does: what was found up to there is kept, and said to be no more than that
    #[arg(long, value_name = "S", value_parser = super::all::seconds)]
    time: Option<f64>,
}

impl Time {
    /// Lets the time begin.
    pub fn begin(&self) {
        if let Some(seconds) = self.time {
            // Less than a thread takes to begin: a quick run would be done before it could tell.
            if seconds < 1e-6 {
                request();
                return;
            }
            // Where no thread can be had the run goes on to its end.
            let run = RUN.load(Ordering::Relaxed);
            let _ = std::thread::Builder::new().spawn(move || {
                std::thread::sleep(Duration::from_secs_f64(seconds));
                if RUN.load(Ordering::Relaxed) == run {
                    request();
                }
            });
        }
    }
}
