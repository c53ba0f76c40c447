//! Reading problems from files and from standard input.

use super::output::{self, in_file};
use krawl::blocks::Account;
use krawl::complete::{Surplus, has_equations_to_spare};
use krawl::constraint::fix_frame;
use krawl::edit::{Decomposition, Setting, completed};
use krawl::import::{self, Figure, Followed, Format, Imported, Skeleton};
use krawl::interval::Interval;
use krawl::problem::{MAX_FILE_SIZE, Problem};
use krawl::system::Located;
use std::borrow::Cow;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// What `-` stands for, in messages.
const STANDARD_INPUT: &str = "standard input";

/// The file of a figure.
#[derive(clap::Args)]
pub struct Source {
    /// The problem file (TOML), or a sketch of SolveSpace (.slvs) or FreeCAD (.FCStd)
    pub file: PathBuf,
    #[command(flatten)]
    pub which: Which,
}

/// Which part of a file is meant, and whether all of it is read.
#[derive(Clone, Default, clap::Args)]
pub struct Which {
    /// Which sketch or molecule of a file that holds several (`krawl check` lists them)
    #[arg(long, value_name = "NAME")]
    pub sketch: Option<String>,
    /// Read a molecule without its hydrogens
    ///
    /// Files that are written have them, each turned as the other bonds of its atom are: nothing is proved of them
    #[arg(long, hide_short_help = true)]
    pub heavy: bool,
}

impl Source {
    /// Reads it.
    pub fn load(&self) -> Result<Loaded, String> {
        load(&self.file, &self.which)
    }
}

/// Reads a problem file, or standard input for `-`, or a sketch or molecule of another program's file. The text of the
/// error says what is wrong, and where.
pub fn read(file: &Path, which: &Which) -> Result<Problem, String> {
    load(file, which)?.whole(file)
}

/// What another program's file is in.
pub fn format(file: &Path) -> Option<Format> {
    Format::of(&file.display().to_string())
}

/// Reads a problem file, or what becomes one: nothing of which a part would be left out or held.
pub fn of_equations(file: &Path) -> Result<Problem, String> {
    match format(file) {
        Some(_) => Err(format!(
            "{}: problem files and systems of polynomials are read here, not sketches and molecules",
            file.display()
        )),
        None => read(file, &Which::default()),
    }
}

/// All of standard input.
fn standard_input() -> Result<String, String> {
    let mut text = String::new();
    io::stdin()
        .lock()
        // One byte more than allowed tells that there is too much.
        .take(MAX_FILE_SIZE + 1)
        .read_to_string(&mut text)
        .map_err(|error| format!("{STANDARD_INPUT}: cannot be read: {error}"))?;
    if text.len() as u64 > MAX_FILE_SIZE {
        return Err(format!(
            "{STANDARD_INPUT}: is larger than the {} KiB that are read",
            MAX_FILE_SIZE >> 10
        ));
    }
    Ok(text)
}

/// A problem of this file as certificates are about it, with as many equations as unknowns: of a sketch that is not so by
/// itself, coordinates that nothing determines are held where it has them, and constraints that seem to follow from others
/// are left out. Which these are comes back.
pub fn provable(file: &Path, problem: &Problem) -> Result<(Problem, Account), String> {
    if !is_sketch(file) && (!problem.is_absolute() || problem.check().is_ok()) {
        return Ok((problem.clone(), Account::default()));
    }
    let found = Decomposition::of(problem).map_err(in_file(file))?;
    Ok((completed(problem).map_err(in_file(file))?, found.account))
}

/// The problem of a file that was read as sets of all solutions are about it: of a problem file as it is, of a sketch of another program as
/// [`provable`] makes it.
pub fn whole(file: &Path, loaded: &Loaded) -> Result<(Problem, Account), String> {
    if is_sketch(file) {
        return provable(file, &loaded.problem);
    }
    if let Some(fault) = &loaded.fault {
        return Err(fault.clone());
    }
    let mut account = Account::default();
    loaded.add_left_out(&mut account, None);
    Ok((loaded.problem.clone(), account))
}

/// What a set of all solutions is about.
pub struct Asked {
    /// There may be more equations than unknowns.
    pub problem: Problem,
    /// What was made of a sketch of another program for it.
    pub made: Account,
    /// More distances than are needed, and nothing else; or those of bonds and bond angles of a molecule.
    pub surplus: Option<Surplus>,
    /// Of a molecule: its atoms and bonds.
    pub skeleton: Option<Skeleton>,
}

/// Reads what a set of all solutions is to be about, with the signs that are asked for or, with `any_signs`, without.
pub fn asked(
    (file, which): (&Path, &Which),
    tolerance: Option<f64>,
    any_signs: bool,
) -> Result<Asked, String> {
    let mut loaded = load(file, which)?.with_any_signs(any_signs);
    let imported = loaded.imported.as_mut();
    let skeleton = imported.and_then(|(imported, _)| imported.skeleton.take());
    let of = |(problem, made), surplus| Asked {
        problem,
        made,
        surplus,
        skeleton,
    };
    if is_sketch(file) {
        return Ok(of(provable(file, &loaded.problem)?, None));
    }
    if let Some(surplus) = loaded.surplus() {
        let surplus = surplus.into_owned().with_tolerance(tolerance);
        let problem = surplus.problem.clone();
        return Ok(of((problem, Account::default()), Some(surplus)));
    }
    let mut problem = loaded.problem;
    if let Some(fault) = loaded.fault {
        problem = problem.up_to_motions();
        if !has_equations_to_spare(&problem) {
            return Err(fault);
        }
    }
    Ok(of((problem, Account::default()), None))
}

/// Whether a file is a sketch in its own frame, of SolveSpace or FreeCAD.
pub fn is_sketch(file: &Path) -> bool {
    matches!(format(file), Some(Format::SolveSpace | Format::FreeCad))
}

/// A problem, and the sketch of another program that it is, if it is one.
pub struct Loaded {
    /// What was read.
    pub problem: Problem,
    /// Of a problem file that has not as many equations as unknowns: what is wrong with it where that is needed.
    pub fault: Option<String>,
    /// The sketch with the bytes of its file.
    imported: Option<(Imported, Vec<u8>)>,
}

/// Reads a sketch to be edited: a problem file, which may be under-constrained, or a sketch or molecule of another
/// program's file.
pub fn load(file: &Path, which: &Which) -> Result<Loaded, String> {
    let loaded = load_again(file, which)?;
    if let Some((imported, _)) = &loaded.imported
        && !imported.notes.is_empty()
    {
        let (of, notes) = (&imported.problem.name, imported.notes.join("; "));
        output::complain(&format!("{}: {of} was read {notes}", file.display()));
    }
    Ok(loaded)
}

/// The same of a file that was read before, of which nothing is said again.
pub fn load_again(file: &Path, which: &Which) -> Result<Loaded, String> {
    let name = file.display().to_string();
    if format(file).is_none() {
        if which.heavy {
            return Err(format!("{name}: --heavy is for molecules"));
        }
        if which.sketch.is_some() {
            return Err(format!(
                "{name}: --sketch is for files that hold several sketches or molecules"
            ));
        }
        let (text, read) = match file == Path::new("-") {
            true => {
                let text = standard_input()?;
                let made = import::polynomials::problem_file(&text);
                let name = match made {
                    Some(_) => format!("{STANDARD_INPUT}, as a problem file"),
                    None => STANDARD_INPUT.to_owned(),
                };
                let made = made.unwrap_or(Ok(text));
                let text = made.map_err(|error| format!("{STANDARD_INPUT}: {error}"))?;
                let problem = Problem::parse(&text, &name);
                (Some(text), problem)
            }
            false => match made(file) {
                None => (None, Problem::read(file)),
                Some(made) => {
                    let text = made?;
                    let problem = Problem::parse(&text, &format!("{name}, as a problem file"));
                    (Some(text), problem)
                }
            },
        };
        let loaded = |problem, fault| Loaded {
            problem,
            fault,
            imported: None,
        };
        return match read {
            Ok(problem) => Ok(loaded(problem, None)),
            Err(error) if error.is_about_structure() => {
                let text = match text {
                    Some(text) => text,
                    None => std::fs::read_to_string(file).map_err(|e| format!("{name}: {e}"))?,
                };
                let problem = Problem::parse_loosely(&text, &name);
                let problem = problem.map_err(|_| error.to_string())?;
                Ok(loaded(problem, Some(error.to_string())))
            }
            Err(error) => Err(error.to_string()),
        };
    }
    let (imported, bytes) = import(file, which)?;
    Ok(Loaded {
        problem: imported.problem.clone(),
        fault: None,
        imported: Some((imported, bytes)),
    })
}

/// The problem file that a file of another kind becomes, a robot in URDF or a system of polynomials; nothing for all other files.
pub fn made(file: &Path) -> Option<Result<String, String>> {
    let name = file.display().to_string();
    let has = |ending| {
        file.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(ending))
    };
    let is_other = has("toml") || format(file).is_some();
    // What can be read but once, as a pipe, is a problem file.
    let about = std::fs::metadata(file).ok().filter(|_| !is_other)?;
    if !about.is_file() || about.len() > MAX_FILE_SIZE {
        return None;
    }
    let text = std::fs::read_to_string(file).ok()?;
    let made = match has("urdf") {
        true => Some(import::urdf::problem_file(&text)),
        false => import::polynomials::problem_file(&text).map(|made| {
            let stem = file.file_stem().unwrap_or_default().to_string_lossy();
            let name = serde_json::Value::from(stem);
            Ok(format!("name = {name}\n{}", made?))
        }),
    };
    made.map(|made| made.map_err(|error| format!("{name}: {error}")))
}

/// Reads a sketch of another program's file.
pub fn import(file: &Path, which: &Which) -> Result<(Imported, Vec<u8>), String> {
    let name = file.display().to_string();
    let bytes = bytes(file)?;
    let read = match which.heavy {
        true => import::read_heavy,
        false => import::read,
    };
    let imported = read(&name, &bytes, which.sketch.as_deref());
    let imported = imported.map_err(|error| error.to_string())?;
    Ok((imported, bytes))
}

/// The bytes of another program's file.
pub fn bytes(file: &Path) -> Result<Vec<u8>, String> {
    let name = file.display();
    let size = std::fs::metadata(file).map_err(|e| format!("{name}: cannot be read: {e}"))?;
    if size.len() > import::MAX_SIZE as u64 {
        return Err(format!(
            "{name}: is larger than the {} MiB that are read",
            import::MAX_SIZE >> 20
        ));
    }
    std::fs::read(file).map_err(|e| format!("{name}: cannot be read: {e}"))
}

impl Loaded {
    /// What was read, with as many equations as unknowns. The text of the error says why it has not.
    pub fn whole(self, file: &Path) -> Result<Problem, String> {
        if is_sketch(file) {
            return completed(&self.problem).map_err(in_file(file));
        }
        self.fault.map_or(Ok(self.problem), Err)
    }

    /// The sketch or molecule of another program that it is.
    pub fn imported(&self) -> Option<&Imported> {
        self.imported.as_ref().map(|(imported, _)| imported)
    }

    /// The same, where `any` figure is wanted whatever its signs are.
    pub fn with_any_signs(mut self, any: bool) -> Self {
        let imported = self.imported.as_mut().map(|(imported, _)| imported);
        let surplus = imported.and_then(|imported| imported.surplus.as_mut());
        if any {
            self.problem.orientations.clear();
            if let Some(surplus) = surplus {
                surplus.problem.orientations.clear();
            }
        }
        self
    }

    /// The distances beside those that are searched or followed: of a molecule what was left out of it as it was read, of a problem file
    /// without a frame of its own those that are more than it needs.
    pub fn surplus(&self) -> Option<Cow<'_, Surplus>> {
        match (&self.imported, &self.fault) {
            (Some((imported, _)), _) => imported.surplus.as_ref().map(Cow::Borrowed),
            (None, Some(_)) if !fix_frame(&self.problem) => {
                Surplus::of(&self.problem.clone().up_to_motions(), None).map(Cow::Owned)
            }
            _ => None,
        }
    }

    /// Adds to what a claim is proved of what was left out of a molecule as it was read: how the figure that is printed stands to it, or,
    /// without one, that nothing is proved of it.
    pub fn add_left_out(&self, account: &mut Account, figure: Option<&[[Interval; 3]]>) {
        let imported = self.imported.as_ref();
        if let Some(surplus) = imported.and_then(|(imported, _)| imported.surplus.as_ref()) {
            surplus.add_to(account, figure);
        }
    }

    /// What follows where dimensions are set, and all others are as in `now`: see [`Imported::followed`].
    pub fn followed(&self, now: &Problem, settings: &[Setting]) -> Followed {
        let imported = self.imported.as_ref();
        imported.map_or_else(Followed::default, |(imported, _)| {
            imported.followed(now, settings)
        })
    }

    /// Sets a cell of a spreadsheet: see [`Imported::set_cell`].
    pub fn set_cell(&mut self, name: &str, value: &str) -> Option<Result<(), String>> {
        self.imported.as_mut()?.0.set_cell(name, value)
    }

    /// Whether a dimension, by index, has a number in the file: see [`Imported::has_number`].
    pub fn has_number(&self, index: usize) -> bool {
        let imported = self.imported.as_ref();
        imported.is_none_or(|(imported, _)| imported.has_number(index))
    }

    /// Refuses to lead dimensions, by index, of which the file has no number.
    pub fn check_numbers(&self, led: &[usize]) -> Result<(), String> {
        match led.iter().find(|index| !self.has_number(**index)) {
            Some(&index) => Err(format!(
                "`{}` stays as it is: there is no number of this sketch to change",
                self.problem.dimension_name(index)
            )),
            None => Ok(()),
        }
    }

    /// Says which of dimensions that are led, and are tied to these, the file's own program computes: see [`Imported::computed`].
    pub fn say_computed(&self, led: &[usize]) {
        let imported = self.imported.as_ref();
        if let Some(text) = imported.and_then(|(imported, _)| imported.computed(led)) {
            output::complain(&format!("{}: {text}", self.problem.name));
        }
    }

    /// The file with a new figure and new dimensions, in its own format.
    pub fn rewritten(
        &self,
        file: &Path,
        problem: &Problem,
        points: &[[f64; 3]],
        objects: &[Located],
    ) -> Result<Vec<u8>, String> {
        match &self.imported {
            Some((imported, bytes)) => {
                let radii: Vec<f64> = objects
                    .iter()
                    .map(|object| object.number().map_or(0.0, |radius| radius.mid()))
                    .collect();
                let radii = &radii;
                import::rewrite(imported, bytes, problem, &Figure { points, radii })
            }
            None => {
                let text = match made(file) {
                    Some(made) => made?,
                    None => {
                        let unreadable = |e| format!("{}: cannot be read: {e}", file.display());
                        std::fs::read_to_string(file).map_err(unreadable)?
                    }
                };
                let text = krawl::edit::rewrite(&text, problem, points, objects);
                Ok(text.map_err(|e| e.to_string())?.into_bytes())
            }
        }
    }
}

/// What a problem file is called in messages.
pub fn name(file: &Path) -> String {
    match file == Path::new("-") {
        true => STANDARD_INPUT.to_owned(),
        false => file.display().to_string(),
    }
}

/// Refuses `-` twice: standard input can be read once.
pub fn only_one_standard_input<'a>(
    files: impl IntoIterator<Item = &'a Path>,
) -> Result<(), String> {
    let dashes = files.into_iter().filter(|&file| file == Path::new("-"));
    match dashes.count() {
        0 | 1 => Ok(()),
        _ => Err(format!(
            "`-`, {STANDARD_INPUT}, is named twice: it can be read once"
        )),
    }
}
