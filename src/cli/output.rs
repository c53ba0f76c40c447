//! Writing, with no panic where nobody reads.

use krawl::certificate::Writer;
use krawl::problem::Problem;
use krawl::report::signs_not_looked_at;
use krawl::track::Control;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Says on standard error that the signs that a problem asks for are not looked at, where it asks for some.
pub fn say_if_signs_are_not_looked_at(problem: &Problem) {
    let words = signs_not_looked_at(problem);
    if !words.is_empty() {
        complain(&format!("{}:{words}", problem.name));
    }
}

/// Says in front of an error which file it is about.
pub fn in_file<E: std::fmt::Display>(file: &Path) -> impl Fn(E) -> String {
    move |error| format!("{}: {error}", file.display())
}

/// What a verb has said that another program runs within itself.
#[derive(Default)]
pub struct Said {
    /// What would stand on standard output.
    pub output: String,
    /// What would stand on standard error.
    pub messages: String,
}

static SAID: Mutex<Option<Said>> = Mutex::new(None);

/// Has what is said kept from now on, or no longer: what was kept until now.
pub fn keep(wanted: bool) -> Said {
    let begun = wanted.then(Said::default);
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    std::mem::replace(&mut *said, begun).unwrap_or_default()
}

/// Whether what is said is kept; then this is, too.
fn is_kept(say: impl FnOnce(&mut Said)) -> bool {
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    said.as_mut().map(say).is_some()
}

/// Prints one message on standard error. If that is closed there is nobody to tell.
pub fn complain(message: &str) {
    if is_kept(|said| said.messages += &format!("{message}\n")) {
        return;
    }
    let _ = writeln!(io::stderr().lock(), "krawl: {message}");
}

/// Why a verb came to nothing, and its exit code: that of bad input, unless something else is wrong.
pub struct Refusal {
    pub message: String,
    pub code: u8,
}

impl Refusal {
    /// Of a run about a file of which nothing was proved: it was interrupted before, or why.
    pub fn of_run(file: &Path, error: &str, control: &Control) -> Self {
        match control.is_interrupted() {
            true => Refusal {
                message: "interrupted before anything was proved".to_owned(),
                code: super::STOPPED,
            },
            false => in_file(file)(error).into(),
        }
    }
}

impl From<String> for Refusal {
    fn from(message: String) -> Self {
        let code = super::BAD_INPUT;
        Refusal { message, code }
    }
}

/// The exit code of a verb: its own, or that of a refusal after saying why.
pub fn exit_code(result: Result<u8, impl Into<Refusal>>) -> u8 {
    result.unwrap_or_else(|refusal| {
        let Refusal { message, code } = refusal.into();
        complain(&message);
        code
    })
}

/// The exit code of a run that came to this one, if all could be written.
pub fn code(is_written: bool, code: u8) -> u8 {
    match is_written {
        true => code,
        false => super::BAD_INPUT,
    }
}

/// Prints a text on standard output. A reader who left early has seen enough; any other failure
/// is complained about. Returns whether all is well.
pub fn print(text: &str) -> bool {
    if is_kept(|said| said.output += text) {
        return true;
    }
    let mut out = io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    is_well(&"standard output", written)
}

/// Whether all is well with what was written, complaining otherwise. A reader who left early is no fault.
fn is_well(what: &dyn std::fmt::Display, written: io::Result<()>) -> bool {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            complain(&format!("{what} cannot be written: {error}"));
            false
        }
        _ => true,
    }
}

/// `run 2 of 5: file`, or nothing where there is only one.
pub fn which_of((k, count): (usize, usize), file: &Path) -> String {
    match count {
        1 => String::new(),
        _ => format!("run {} of {count}: {}", k + 1, file.display()),
    }
}

/// Whether two paths lead to the same existing file.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    match (fs::canonicalize(one), fs::canonicalize(other)) {
        (Ok(one), Ok(other)) => one == other,
        _ => false,
    }
}

/// Refuses a file of results that is one of those that are read.
pub fn refuse_read<'f>(
    read: impl IntoIterator<Item = &'f PathBuf>,
    results: Option<&Path>,
) -> Result<(), String> {
    let mut read = read.into_iter();
    match results.filter(|results| read.any(|file| is_same_file(results, file))) {
        None => Ok(()),
        Some(results) => Err(format!(
            "{}: is read; name another file for the results",
            results.display()
        )),
    }
}

/// Where results go, which must not be what is read.
pub fn beside<'f>(
    read: impl IntoIterator<Item = &'f PathBuf>,
    results: Option<&Path>,
) -> Result<Option<Destination>, String> {
    refuse_read(read, results)?;
    results.map(Destination::new).transpose()
}

/// A number on the command line, if it is one that is wanted; `must`: what it has to be.
pub fn number<T: std::str::FromStr>(
    text: &str,
    is_wanted: impl FnOnce(&T) -> bool,
    must: &str,
) -> Result<T, String> {
    let number = text.parse().ok().filter(is_wanted);
    number.ok_or_else(|| must.to_owned())
}

/// Where a file of results goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Destination {
    /// Standard output.
    StandardOutput,
    /// A regular file, whether it exists or not.
    File(PathBuf),
    /// A pipe or a device, which is written to as it is.
    Device(PathBuf),
}

impl Destination {
    /// From an argument, `-` being standard output. Says early, and without creating anything,
    /// that a file cannot be where it is wanted.
    pub fn new(argument: &Path) -> Result<Self, String> {
        if argument == Path::new("-") {
            return Ok(Destination::StandardOutput);
        }
        let shown = argument.display();
        // What a link leads to is replaced, not the link.
        let path = fs::canonicalize(argument).unwrap_or_else(|_| argument.to_owned());
        match fs::metadata(&path) {
            Ok(found) if found.is_dir() => return Err(format!("{shown}: is a directory")),
            Ok(found) if !found.is_file() => return Ok(Destination::Device(path)),
            _ => {}
        }
        if path.file_name().is_none() {
            return Err(format!("{shown}: is not the name of a file"));
        }
        let folder = folder(&path);
        match fs::metadata(folder) {
            Ok(found) if found.is_dir() => Ok(Destination::File(path)),
            Ok(_) => Err(format!("{shown}: {} is not a directory", folder.display())),
            Err(error) => Err(format!("{shown}: {}: {error}", folder.display())),
        }
    }

    /// Writes the text. A file is written beside and then renamed, so that there is never half a
    /// file under its name. Returns whether all is well, having complained otherwise.
    pub fn write(&self, text: &str) -> bool {
        let (path, result) = match self {
            Destination::StandardOutput => return print(text),
            Destination::Device(path) => {
                let open = fs::OpenOptions::new().write(true).open(path);
                let written = open.and_then(|mut file| file.write_all(text.as_bytes()));
                (path, written)
            }
            Destination::File(path) => match Beside::begin(path.clone()) {
                Ok(beside) => return beside.write(text.as_bytes()),
                Err(error) => (path, Err(error)),
            },
        };
        is_well(&format_args!("{}:", path.display()), result)
    }
}

/// A certificate on its way into a file.
pub type Certificate<'a> = Writer<'a, BufWriter<&'a fs::File>>;

/// A file that is written beside the one wanted, which it replaces when it is complete. Dropped
/// before, it leaves nothing.
#[derive(Debug)]
pub struct Beside {
    file: fs::File,
    beside: PathBuf,
    path: PathBuf,
}

impl Beside {
    /// Begins a file in place of the one named.
    pub fn new(argument: &Path) -> Result<Self, String> {
        let Destination::File(path) = Destination::new(argument)? else {
            return Err(format!("{}: must be a regular file", argument.display()));
        };
        Self::begin(path)
            .map_err(|error| format!("{}: cannot be written: {error}", argument.display()))
    }

    fn begin(path: PathBuf) -> io::Result<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let beside = folder(&path).join(format!(".{name}.{}.tmp", std::process::id()));
        let file = fs::File::create_new(&beside)?;
        Ok(Beside { file, beside, path })
    }

    /// Begins a certificate about a problem as what is written.
    pub fn certificate<'a>(&'a self, problem: &'a Problem) -> Certificate<'a> {
        Writer::new(BufWriter::new(&self.file), problem)
    }

    /// Writes these bytes and puts the file in its place. Returns whether all is well, having complained otherwise.
    pub fn write(&self, bytes: &[u8]) -> bool {
        self.commit((&self.file).write_all(bytes))
    }

    /// Puts the file in its place if all was written. Returns whether all is well, having
    /// complained otherwise.
    pub fn commit(&self, written: io::Result<()>) -> bool {
        let done = written
            .and_then(|()| self.file.sync_all())
            .and_then(|()| fs::rename(&self.beside, &self.path));
        is_well(&format_args!("{}:", self.path.display()), done)
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // After a commit there is no such file.
        let _ = fs::remove_file(&self.beside);
    }
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_files_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.json");
        for text in ["first", "second"] {
            assert!(Destination::new(&path).unwrap().write(text));
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn refuses_impossible_places_without_creating_anything() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Destination::new(folder.path()).is_err());
        assert!(Destination::new(&folder.path().join("missing/out.json")).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn standard_output_is_a_dash() {
        assert_eq!(
            Destination::new(Path::new("-")),
            Ok(Destination::StandardOutput)
        );
    }

    #[cfg(unix)]
    #[test]
    fn devices_stay_devices() {
        let null = Path::new("/dev/null");
        let destination = Destination::new(null).unwrap();
        assert_eq!(destination, Destination::Device(null.to_owned()));
        assert!(destination.write("gone"));
        assert!(!fs::metadata(null).unwrap().is_file());
    }
}
