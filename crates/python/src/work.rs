//! Long work that Python's Ctrl-C ends, and calls back into Python.

use pyo3::call::PyCallArgs;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked whether Ctrl-C was pressed.
const PAUSE: Duration = Duration::from_millis(50);

/// Does the work on a thread of its own, without Python's lock, and asks Python for signals meanwhile. After
/// Ctrl-C the work's flag is set, and when it has ended, `KeyboardInterrupt` is raised.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send,
) -> PyResult<T> {
    let cancel = AtomicBool::new(false);
    let end = || cancel.store(true, Ordering::Relaxed);
    interruptible_by(py, end, || work(&cancel))
}

/// The same of work that is asked for its end by `end`.
pub fn interruptible_by<T: Send>(
    py: Python<'_>,
    end: impl Fn() + Sync,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    py.detach(|| {
        std::thread::scope(|scope| {
            let (done, wait) = channel();
            let worker = scope.spawn(move || {
                let result = work();
                // Whoever waits has not gone: it ends with this scope.
                let _ = done.send(());
                result
            });
            let mut interrupt = Ok(());
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(PAUSE) {
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    interrupt = Err(error);
                    end();
                }
            }
            let result = worker.join();
            interrupt?;
            Ok(result.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        })
    })
}

/// Calls back, if there is somebody to call. What goes wrong there is printed, and the work goes on.
pub fn tell<A>(to: &Option<Py<PyAny>>, arguments: A)
where
    A: for<'py> PyCallArgs<'py>,
{
    if let Some(to) = to {
        Python::attach(|py| {
            if let Err(error) = to.call1(py, arguments) {
                error.print(py);
            }
        });
    }
}
