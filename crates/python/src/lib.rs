//! What the Python package is made of: `krawl._krawl`, functions that take the text of a problem and give
//! JSON, as the command line writes it. The package around it, with classes and arrays, is beside this file.

mod work;

use krawl::certificate::{self, Contents, Settings, Writer, cover};
use krawl::complete;
use krawl::edit;
use krawl::motion::Motion;
use krawl::problem::Problem;
use krawl::report::document::Answer;
use krawl::report::{self, Document};
use krawl::track::{self, Control, Options, Progress, Space, Status, Witness};
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::Duration;
use work::{interruptible, interruptible_by, tell};

create_exception!(
    krawl,
    Error,
    PyValueError,
    "Bad input: what is wrong, where, and what to do."
);

fn bad(error: impl std::fmt::Display) -> PyErr {
    Error::new_err(error.to_string())
}

fn unwritten(path: &Path, error: &std::io::Error) -> PyErr {
    PyOSError::new_err(format!("{}: {error}", path.display()))
}

fn parse(text: &str, name: &str) -> PyResult<Problem> {
    Problem::parse(text, name).map_err(bad)
}

/// A run that a flag ends.
fn until(cancel: &AtomicBool) -> Control<'_> {
    Control {
        cancel: Some(cancel),
        ..Control::default()
    }
}

fn space(name: Option<&str>) -> PyResult<Option<Space>> {
    match name {
        None => Ok(None),
        Some("full") => Ok(Some(Space::Full)),
        Some("reduced") => Ok(Some(Space::Reduced)),
        Some(other) => Err(bad(format!(
            "space: {other:?} is neither \"full\" nor \"reduced\""
        ))),
    }
}

/// The path through the sketch: JSON as of `krawl solve --json`.
#[pyfunction]
#[pyo3(signature = (text, name, *, mode, space, reverse, extended, samples, certificate, progress))]
#[allow(clippy::too_many_arguments)] // Python gives all of them by name.
fn solve(
    py: Python<'_>,
    text: &str,
    name: &str,
    mode: &str,
    space: Option<&str>,
    reverse: bool,
    extended: bool,
    samples: usize,
    certificate: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let problem = parse(text, name)?;
    let options = match mode {
        "certified" => Options::certified(),
        "float" => Options::float(Space::Reduced),
        other => {
            let what = format!("mode: {other:?} is neither \"certified\" nor \"float\"");
            return Err(bad(what));
        }
    };
    if mode == "float" && (certificate.is_some() || samples > 0) {
        return Err(bad(
            "float mode proves nothing: it has no certificates and no samples",
        ));
    }
    let chosen = self::space(space)?;
    let options = Options {
        space: chosen.unwrap_or(options.space),
        reverse,
        extended,
        ..options
    };
    let proof = certificate.as_deref().map(|path| {
        let file = File::create(path).map_err(|error| unwritten(path, &error))?;
        Ok::<_, PyErr>(Writer::new(BufWriter::new(file), &problem))
    });
    let mut proof = proof.transpose()?;
    let work = |cancel: &_| -> PyResult<String> {
        let mut show = |now: Progress| tell(&progress, (now.steps, now.t, now.solutions));
        let mut control = Control {
            progress: progress.is_some().then_some(&mut show),
            witness: proof.as_mut().map(|writer| writer as &mut dyn Witness),
            ..until(cancel)
        };
        let outcome = match chosen {
            Some(_) => track::solve(&problem, &options, &mut control),
            None => track::solve_in_best_space(&problem, &options, &mut control),
        };
        let outcome = outcome.map_err(bad)?;
        let mut trace = None;
        if samples > 0 && !matches!(outcome.status, Status::Stopped(_)) {
            let mut control = until(cancel);
            trace = track::trace_path(&problem, &options, &mut control).ok();
        }
        let run = report::Run {
            trace: trace.as_ref().map(|(_, trace)| trace),
            samples,
            ..report::Run::new(&problem, &options, &outcome)
        };
        Ok(Document::solve(&run).to_json())
    };
    let json = interruptible(py, work);
    // After Ctrl-C too: what was proved by then is kept.
    if let (Some(writer), Some(path)) = (proof, &certificate) {
        writer.finish().map_err(|error| unwritten(path, &error))?;
    }
    json?
}

/// All figures with the distances: JSON as of `krawl all --json`.
#[pyfunction]
#[pyo3(signature = (text, name, *, threads, time, certificate, progress))]
fn complete_set(
    py: Python<'_>,
    text: &str,
    name: &str,
    threads: usize,
    time: Option<f64>,
    certificate: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let problem = parse(text, name)?;
    let time = time
        .map(|seconds| {
            Duration::try_from_secs_f64(seconds)
                .map_err(|_| bad("time: a number of seconds from 0 on"))
        })
        .transpose()?;
    let result = interruptible(py, |cancel: &_| {
        let show = |now: complete::Progress| tell(&progress, (now.share, now.boxes));
        let options = complete::Options {
            cancel: Some(cancel),
            time,
            threads,
            cover: certificate.is_some(),
            progress: progress.is_some().then_some(&show),
            ..complete::Options::default()
        };
        complete::all(&problem, &options)
    })?;
    let result = result.map_err(bad)?;
    if let (Some(path), Some(cover)) = (&certificate, &result.cover) {
        fs::write(path, cover).map_err(|error| unwritten(path, &error))?;
    }
    Ok(Document::all(&problem, &result, &Default::default()).to_json())
}

/// A linkage followed all the way round: JSON as of `krawl motion --json`.
#[pyfunction]
#[pyo3(signature = (text, name, *, free, measure))]
fn motion(
    py: Python<'_>,
    text: &str,
    name: &str,
    free: Vec<String>,
    measure: Vec<String>,
) -> PyResult<String> {
    let problem = Problem::parse_loosely(text, name).map_err(bad)?;
    let found = interruptible(py, |cancel: &_| {
        let mut control = until(cancel);
        Motion::of(
            &problem,
            &free,
            &measure,
            &Options::certified(),
            &mut control,
        )
    })?;
    Ok(Document::motion(&found.map_err(bad)?).to_json())
}

/// Runs a verb with the arguments of the command line: its exit code, and what it would print on standard output and on standard
/// error.
#[pyfunction]
fn call(py: Python<'_>, arguments: Vec<String>) -> PyResult<(u8, String, String)> {
    let run = || krawl::cli::call(&arguments);
    let called = interruptible_by(py, krawl::cli::end_call, run)?;
    Ok((called.code, called.output, called.messages))
}

/// Checks a certificate: what came of it ("verified", "refuted", "not proved", "incomplete"), in words, and
/// whether it is about the problem, if one is given.
#[pyfunction]
fn verify(
    py: Python<'_>,
    path: PathBuf,
    problem: Option<(String, String)>,
) -> PyResult<(&'static str, String, bool)> {
    let problem = problem
        .map(|(text, name)| parse(&text, &name))
        .transpose()?;
    let problem = problem.as_ref();
    let bytes = fs::read(&path).map_err(|error| unwritten(&path, &error))?;
    let in_file = |error: &dyn std::fmt::Display| bad(format!("{}: {error}", path.display()));
    let begin = std::time::Instant::now();
    let contents = certificate::contents(&bytes[..]).map(|(contents, _)| contents);
    if matches!(contents, Ok(Contents::Cover)) {
        let verdict = interruptible(py, |_| cover::verify_cover(&bytes))?;
        let verdict = verdict.map_err(|error| in_file(&error))?;
        let what = match verdict.proves_all() {
            _ if verdict.flaw.is_some() => "not proved",
            true => "verified",
            false => "incomplete",
        };
        let same = problem.is_none_or(|problem| verdict.is_about(problem));
        return Ok((what, report::cover_theorem(&verdict, begin.elapsed()), same));
    }
    if matches!(contents, Ok(Contents::ComplexSet)) {
        return Err(bad(format!(
            "{}: a set of complex solutions, which `krawl verify` checks",
            path.display()
        )));
    }
    let settings = Settings { threads: 0 };
    let verdict = interruptible(py, |_| {
        certificate::verify(bytes.as_slice(), &settings, &mut |_| ())
    })?;
    let verdict = verdict.map_err(|error| in_file(&error))?;
    let what = match verdict.outcome {
        certificate::Outcome::Verified => "verified",
        certificate::Outcome::Refuted(_) => "refuted",
        certificate::Outcome::NotProved(_) => "not proved",
        certificate::Outcome::Partial(_) => "incomplete",
    };
    let same = problem.is_none_or(|problem| verdict.is_about(problem));
    Ok((what, report::theorem(&verdict, begin.elapsed()), same))
}

/// A figure and the edits of it, one after the other.
#[pyclass]
struct Session(Mutex<edit::Session>);

#[pymethods]
impl Session {
    #[new]
    fn new(py: Python<'_>, text: &str, name: &str, to_drag: bool) -> PyResult<Self> {
        let problem = Problem::parse_loosely(text, name).map_err(bad)?;
        let opened = interruptible(py, |cancel: &_| {
            let mut control = until(cancel);
            match to_drag {
                true => edit::Session::open_to_drag(&problem, &Options::certified(), &mut control),
                false => edit::Session::open_with(&problem, &Options::certified(), &mut control),
            }
        })?;
        Ok(Session(Mutex::new(opened.map_err(bad)?)))
    }

    /// Changes dimensions, given as `name=value`: JSON as of `krawl edit --json`.
    fn edit(&self, py: Python<'_>, settings: Vec<String>) -> PyResult<String> {
        interruptible(py, |cancel: &_| -> PyResult<String> {
            let mut session = self.0.lock().map_err(bad)?;
            let settings = settings
                .iter()
                .map(|text| edit::Setting::parse(session.problem(), text))
                .collect::<Result<Vec<_>, _>>()
                .map_err(bad)?;
            edit::Setting::check(session.problem(), &settings).map_err(bad)?;
            let mut control = until(cancel);
            let edited = session.edit_with(&settings, &mut control);
            Ok(Answer::of(&session, &edited).to_json())
        })?
    }

    /// Drags points, given as `name=x,y`: JSON as of `krawl edit --json`.
    fn drag(&self, py: Python<'_>, places: Vec<String>) -> PyResult<String> {
        interruptible(py, |cancel: &_| -> PyResult<String> {
            let mut session = self.0.lock().map_err(bad)?;
            if !session.can_drag() {
                return Err(bad(
                    "points are dragged in a session that is opened to do so: Session(problem, drag=True)",
                ));
            }
            let drags = places
                .iter()
                .map(|text| edit::Drag::parse(session.problem(), text));
            let drags = drags.collect::<Result<Vec<_>, _>>().map_err(bad)?;
            let mut control = until(cancel);
            let edited = session.drag(&drags, &mut control);
            Ok(Answer::of(&session, &edited).to_json())
        })?
    }

    /// The figure: name, lower and upper ends of its coordinates, point by point.
    fn points(&self) -> PyResult<Vec<(String, [f64; 3], [f64; 3])>> {
        let session = self.0.lock().map_err(bad)?;
        let points = session.problem().points.iter().zip(session.points());
        Ok(points
            .map(|(point, place)| {
                let (lower, upper) = (place.map(|x| x.inf()), place.map(|x| x.sup()));
                (point.name.clone(), lower, upper)
            })
            .collect())
    }
}

/// The compiled part of krawl.
#[pymodule]
fn _krawl(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<Error>())?;
    module.add_function(wrap_pyfunction!(solve, module)?)?;
    module.add_function(wrap_pyfunction!(complete_set, module)?)?;
    module.add_function(wrap_pyfunction!(motion, module)?)?;
    module.add_function(wrap_pyfunction!(call, module)?)?;
    module.add_function(wrap_pyfunction!(verify, module)?)?;
    module.add_class::<Session>()
}
