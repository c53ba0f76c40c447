//! No step allocates in the steady state of a run.

use krawl::problem::Problem;
use krawl::track::{Control, Options, Progress, Space, solve};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Counts allocations.
struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations in each step in which no solution was found, but for the first ones.
fn quiet_stretches(file: &str, options: Options) -> Vec<usize> {
    let problem = Problem::read(Path::new(file)).expect("a shipped problem");
    let mut stretches = Vec::with_capacity(1_000_000);
    let (mut solutions, mut count) = (usize::MAX, 0);
    let mut progress = |now: Progress| {
        let seen = COUNT.load(Ordering::Relaxed);
        // The first steps make room.
        if now.solutions == solutions && now.steps > 64 {
            stretches.push(seen - count);
        }
        (solutions, count) = (now.solutions, seen);
    };
    let mut control = Control {
        progress: Some(&mut progress),
        pause: Some(Duration::ZERO),
        ..Control::default()
    };
    let options = Options {
        max_steps: 8000,
        ..options
    };
    solve(&problem, &options, &mut control).expect("a run");
    stretches
}

#[test]
fn steps_do_not_allocate() {
    for options in [Options::certified(), Options::float(Space::Full)] {
        let stretches = quiet_stretches("problems/icosahedron.toml", options.clone());
        assert!(
            stretches.len() > 10,
            "{options:?}: too few stretches without a solution"
        );
        assert!(
            stretches.iter().all(|&count| count == 0),
            "{options:?}: {stretches:?}"
        );
    }
    // A change of plan does allocate; with short steps there are long stretches without one.
    let options = Options::float(Space::Reduced).with_max_step(0.001);
    let stretches = quiet_stretches("problems/dodecagon.toml", options);
    let quiet = stretches.iter().filter(|&&count| count == 0).count();
    assert!(
        stretches.len() > 50 && 2 * quiet > stretches.len(),
        "{stretches:?}"
    );
}
